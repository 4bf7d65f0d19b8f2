/* SPDX-License-Identifier: MIT
 *
 * Decimal numbers in text, as everything here reads and writes them: correctly rounded, and with a point in
 * every locale, which strtod and printf have not.
 *
 * A number is [+-]DIGITS[.DIGITS][e[+-]DIGITS], e or E, with a digit before or after the point: 3, -.5, 2., 1e-9.
 * Blanks, hexadecimal digits, inf and nan are none.
 */
#ifndef CUBEMAP_NUMBER_H
#define CUBEMAP_NUMBER_H

#include <cubemap/export.h>

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Room for what is written, its zero byte included. */
#define CM_NUMBER_SIZE 32

/* Seventeen significant digits identify every double, nine every float. */
#define CM_NUMBER_DIGITS 17

/* Read the number that text begins with, of length bytes; no zero byte is needed. Returns how many bytes it has, and 0 if
 * none begins there: then *value is untouched. Of length 0 text may be NULL. What follows DIGITS e and is no exponent does not
 * belong to it. The value is the nearest double, ties to even, whatever the number of digits; beyond the range of double it is
 * an infinity, or zero. Its sign is kept with zero, too. */
CM_API size_t cm_number_read(const char *text, size_t length, double *value);

/* The same of a number that is all of the text: 1 if it is, else 0, and *value is untouched. */
CM_API int cm_number_parse(const char *text, size_t length, double *value);

/* Write a value to so many significant digits, of which zeros at the end are left away, as printf's %.*g does in the
 * C locale; but -0 as 0. An infinity is inf or -inf, what is no number nan. digits below 1 count as 1, above 17 as 17.
 * Returns the length without the zero byte. */
CM_API size_t cm_number_write(double value, int digits, char text[CM_NUMBER_SIZE]);

/* The same with the fewest digits, from 15 to 17, that bring back the same double. */
CM_API size_t cm_number_write_shortest(double value, char text[CM_NUMBER_SIZE]);

#ifdef __cplusplus
}
#endif

#endif
