/* SPDX-License-Identifier: MIT
 *
 * Names as people write them.
 */
#ifndef LIBCUBEMAP_MAPPING_CATALOGUE_WORDS_H
#define LIBCUBEMAP_MAPPING_CATALOGUE_WORDS_H

#include <cubemap/catalogue.h>

#include <stddef.h>

/* Equality of two ASCII words of given lengths, without upper and lower case. */
int cm_word_equal(const char *a, size_t a_length, const char *b, size_t b_length);

/* The mapping that a name stands for, NULL if there is none; *fixed is what an alias says after its colon,
 * else "". */
const cm_mapping_info *cm_catalogue_find_word(const char *name, size_t length, const char **fixed);

size_t cm_catalogue_index(const cm_mapping_info *info);

/* The length of the name in an alias of the catalogue, a word of whole characters: "asc:c=1" and
 * "peirce:stereographic,conformal" fix what is behind the last colon, "square:concentric" fixes nothing. */
size_t cm_alias_length(const char *word, size_t whole);

#endif
