/* SPDX-License-Identifier: MIT
 *
 * The names of colour maps, for tables of options and for suggestions.
 */
#ifndef TOOLS_CLI_COLORMAP_NAME_H
#define TOOLS_CLI_COLORMAP_NAME_H

#include "nearest.h"

#ifdef __cplusplus
extern "C" {
#endif

/* NULL behind the last. */
const char *colormap_name_at(size_t index);

/* The map that a specification of none seems to begin with, by its name or another that it has. */
cm_nearest nearest_colormap(const char *specification);

#ifdef __cplusplus
}
#endif

#endif
