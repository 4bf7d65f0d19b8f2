/* SPDX-License-Identifier: MIT
 *
 * What a specification says.
 */
#ifndef LIBCUBEMAP_MAPPING_SPECIFICATION_H
#define LIBCUBEMAP_MAPPING_SPECIFICATION_H

#include <cubemap/catalogue.h>
#include <cubemap/status.h>

#include <stddef.h>

/* A specification that has been read. */
typedef struct cm_specification
{
    size_t index; /* in the catalogue */
    double parameter[CM_PARAMETERS_MAX];
    size_t azimuthal; /* of a layout's parts, and of an azimuthal projection its own */
    size_t square;    /* the same of the mapping between disc and square */
} cm_specification;

/* Parse and check; on CM_OK *made is set, on failure message (if any) says why. */
cm_status cm_specification_parse(const char *specification, cm_specification *made, char *message,
                                 size_t message_size);

/* Does the layout put one hemisphere on the disc, and the other one on the same disc? */
int cm_is_folded(const cm_mapping_info *info);

#endif
