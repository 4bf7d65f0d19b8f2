/* SPDX-License-Identifier: MIT
 *
 * Where a text that is being written ends: what has no room is counted all the same.
 */
#ifndef MODULES_IMAGE_TEXT_END_H
#define MODULES_IMAGE_TEXT_END_H

#include <cubemap/number.h>

#include <stddef.h>
#include <string.h>

typedef struct cm_text_end
{
    char *text;    /* NULL if size is 0 */
    size_t size;   /* bytes there are, of which one is for the zero byte */
    size_t length; /* of all that was added, without a zero byte */
} cm_text_end;

/* All of it and a zero byte, or nothing. */
static inline void cm_text_add(cm_text_end *end, const char *text)
{
    const size_t length = strlen(text);
    if (end->length < end->size && length < end->size - end->length)
    {
        memcpy(end->text + end->length, text, length + 1);
    }
    end->length += length;
}

static inline void cm_text_add_number(cm_text_end *end, double value)
{
    char digits[CM_NUMBER_SIZE];
    cm_number_write_shortest(value, digits);
    cm_text_add(end, digits);
}

#endif
