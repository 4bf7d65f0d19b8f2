/* SPDX-License-Identifier: MIT
 *
 * Specifications of surfaces taken apart: KIND[:PARAMETERS][;KEY=VALUE...].
 */
#ifndef MODULES_IMAGE_SURFACE_SPECIFICATION_H
#define MODULES_IMAGE_SURFACE_SPECIFICATION_H

#include "surface_object.h"

/* A part of a text, which need not end with a zero byte. */
typedef struct cm_word
{
    const char *text; /* NULL: there is none */
    size_t length;
} cm_word;

/* No specification has more keys. */
#define CM_KEYS_MAX 16

/* A specification in its parts, which point into the text. */
typedef struct cm_surface_words
{
    cm_word kind;
    cm_word parameters; /* after the first colon */
    size_t key_count;
    cm_word key[CM_KEYS_MAX];
    cm_word value[CM_KEYS_MAX];
    unsigned used; /* bits of the keys that the kind has asked for */
} cm_surface_words;

/* Where a message goes; text may be NULL. */
typedef struct cm_complaint
{
    char *text;
    size_t size;
} cm_complaint;

/* Writes one line, whatever the words are, and returns the status. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
cm_status
cm_complain(cm_complaint to, cm_status status, const char *format, ...);

/* As much of a word as a message shows: the arguments of %.*s. */
#define CM_SHOWN(word) (word).length < 60 ? (int)(word).length : 60, (word).text

/* The word up to a stop or the end; *rest is what follows the stop, with a text of NULL at the end. */
cm_word cm_word_split(cm_word whole, char stop, cm_word *rest);

/* CM_OK or CM_ERROR_SYNTAX. */
cm_status cm_surface_words_read(const char *text, cm_surface_words *words, cm_complaint to);

/* The value of a key, which counts as used; its text is NULL if it is not there. */
cm_word cm_surface_key(cm_surface_words *words, const char *key);

/* The value of a key as a number in [low, high], or what it is if the key is not there. CM_OK, CM_ERROR_SYNTAX or
 * CM_ERROR_RANGE. */
cm_status cm_surface_key_number(cm_surface_words *words, const char *key, double low, double high,
                                double *value, cm_complaint to);

/* Are two words the same but for upper and lower case? */
int cm_word_is(cm_word word, const char *text);

/* A word as a text that ends, cut to size bytes: 1 if it fits, else 0. */
int cm_word_copy(cm_word word, char *text, size_t size);

#endif
