/* SPDX-License-Identifier: MIT
 *
 * Numbers as people write them to programs: those of <cubemap/number.h>, and the words for what is none or infinite.
 */
#ifndef TOOLS_CLI_NUMBER_WORD_H
#define TOOLS_CLI_NUMBER_WORD_H

#ifdef __cplusplus
extern "C" {
#endif

/* Read the number that begins at text and ends before end at the latest, or inf, infinity or nan in upper or lower
 * case, with a sign. Returns what follows it, or NULL (value untouched) if there is none. */
const char *number_or_word(const char *text, const char *end, double *value);

#ifdef __cplusplus
}
#endif

#endif
