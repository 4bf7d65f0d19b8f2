/* SPDX-License-Identifier: MIT
 *
 * Of a number that is known to within an error only the digits that are known: the rule for every figure that
 * comes with an estimate of its error.
 */
#ifndef TOOLS_CLI_KNOWN_DIGITS_H
#define TOOLS_CLI_KNOWN_DIGITS_H

#ifdef __cplusplus
extern "C" {
#endif

#define KNOWN_TEXT_SIZE 344 /* the largest double, a point and 30 decimals */

/* How many decimals a value has that is off by error at most: the most of which half a unit of the last is no less than the error,
 * but not more than most, which is 0 to 30. -1 if not even whole units are known, or the error is no number. */
int known_decimals(double error, int most);

/* Write the value to so many decimals, with zeros at the end; "-" where none is known, or the value is no number; inf or -inf.
 * Returns text. */
const char *known_text(double value, double error, int most, char text[KNOWN_TEXT_SIZE]);

#ifdef __cplusplus
}
#endif

#endif
