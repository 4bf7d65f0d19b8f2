/* SPDX-License-Identifier: MIT
 *
 * Specifications and what they say.
 */
#ifndef COLORMAP_SPECIFICATION_H
#define COLORMAP_SPECIFICATION_H

#include "colormap_catalogue.h"

/* On CM_OK *parameters is set; on failure message (if any) says why. */
cm_status cm_colormap_parse(const char *specification, cm_colormap_parameters *parameters,
                            char *message, size_t message_size);

/* The specification of these parameters, all of them; the same as cm_colormap_specification. */
size_t cm_colormap_write(const cm_colormap_parameters *parameters, char *text, size_t size);

#endif
