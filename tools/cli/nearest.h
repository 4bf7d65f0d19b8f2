/* SPDX-License-Identifier: MIT
 *
 * Which of the words that there are was meant by one that is not among them.
 *
 *     cm_nearest nearest = cm_nearest_to(text, strlen(text));
 *     for each word: cm_nearest_try(&nearest, word, strlen(word));
 *     cm_nearest_append(&nearest, message, sizeof message);
 */
#ifndef TOOLS_CLI_NEAREST_H
#define TOOLS_CLI_NEAREST_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The search for a word; best is NULL as long as none is like it. */
typedef struct cm_nearest
{
    const char *text;
    size_t length;
    const char *best; /* not ended by a zero byte, if what was tried is not */
    size_t best_length;
    size_t distance; /* of best; at first the least that is too far */
} cm_nearest;

cm_nearest cm_nearest_to(const char *text, size_t length);

/* Is this word nearer than those before? It is where fewer letters are to be put in, left out, changed or swapped
 * with their neighbour, whatever their case; and where it only goes on after the text. */
void cm_nearest_try(cm_nearest *nearest, const char *word, size_t length);

/* The word of a list that ends with NULL, or NULL if none is like the text. */
const char *cm_nearest_of(const char *text, const char *const *words);

/* "; did you mean tangent?" at the end of a message, if there is such a word. */
void cm_nearest_append(const cm_nearest *nearest, char *message, size_t size);

#ifdef __cplusplus
}
#endif

#endif
