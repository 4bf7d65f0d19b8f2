/* SPDX-License-Identifier: MIT
 *
 * What has a name in the library, for tables of options and for suggestions. Each function gives NULL behind the last.
 */
#ifndef TOOLS_CLI_CATALOGUE_NAME_H
#define TOOLS_CLI_CATALOGUE_NAME_H

#include "nearest.h"

#ifdef __cplusplus
extern "C" {
#endif

const char *mapping_name_at(size_t index);
const char *frame_name_at(size_t index);
const char *ellipsoid_name_at(size_t index);
const char *latitude_name_at(size_t index);
const char *orientation_name_at(size_t index);

/* Among those, the one that a word is most like. */
cm_nearest nearest_name(const char *text, const char *(*name_at)(size_t index));

/* The mapping that a specification of none seems to begin with, by its name or another that it has. */
cm_nearest nearest_mapping(const char *specification);

#ifdef __cplusplus
}
#endif

#endif
