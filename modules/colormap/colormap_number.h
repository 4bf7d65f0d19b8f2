/* SPDX-License-Identifier: MIT
 *
 * Decimal numbers in specifications, with a point in every locale.
 */
#ifndef COLORMAP_NUMBER_H
#define COLORMAP_NUMBER_H

#include <stddef.h>

#define CM_COLORMAP_NUMBER_MAX 32

/* A decimal number that fills its text; 0 if it is not one. */
int cm_colormap_number_read(const char *text, size_t length, double *value);

/* With as few digits as bring back the same double. */
void cm_colormap_number_write(double value, char text[CM_COLORMAP_NUMBER_MAX]);

#endif
