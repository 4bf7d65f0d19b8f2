/* SPDX-License-Identifier: MIT
 *
 * Decimal numbers in text, as the command-line tools read and write them: exact like strtod and
 * printf, several times faster for numbers of everyday size, and with a point in every locale.
 */
#ifndef CUBEMAP_TOOLS_NUMBER_H
#define CUBEMAP_TOOLS_NUMBER_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A longer text is no number to number_read. */
#define NUMBER_READ_MAX 4096

/* Room for what number_write writes, its zero byte included. */
#define NUMBER_WRITE_MAX 32

#define NUMBER_DIGITS_MAX 17

/* Read the number that begins at text and ends before end at the latest: [+-]DIGITS[.DIGITS]
 * [e[+-]DIGITS], digits before or after the point, or inf, infinity or nan in upper or lower case.
 * No zero byte is needed at its end. The value is rounded to nearest, ties to even; beyond the
 * range of double it is an infinity or zero. Returns the first character after the number, or NULL
 * (value untouched) if no number begins there. */
const char *number_read(const char *text, const char *end, double *value);

/* Write value as printf's %.*g does in the C locale, but -0 as 0 and every NaN as nan. digits is in
 * [1, 17]; 17 identify every double, 9 every float. Returns the length without the zero byte. */
size_t number_write(double value, int digits, char text[NUMBER_WRITE_MAX]);

/* Write a value with as few digits as bring back the same double (at least 15 are tried). */
size_t number_write_shortest(double value, char text[NUMBER_WRITE_MAX]);

#ifdef __cplusplus
}
#endif

#endif
