/* SPDX-License-Identifier: MIT
 *
 * Numbers as people write them.
 */
#ifndef LIBCUBEMAP_MAPPING_NUMBER_TEXT_H
#define LIBCUBEMAP_MAPPING_NUMBER_TEXT_H

#include <stddef.h>

/* A decimal number that fills its text, *value; 0 if it is not one. Correctly rounded for up to 15 digits and
 * powers of ten to 22, else within an ulp; beyond the range of double infinite or 0. */
int cm_number_parse(const char *text, size_t length, double *value);

#endif
