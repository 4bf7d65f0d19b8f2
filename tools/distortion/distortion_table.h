/* SPDX-License-Identifier: MIT
 *
 * What the options of cubemap-distortion are called in its source.
 */
#ifndef CUBEMAP_TOOLS_DISTORTION_TABLE_H
#define CUBEMAP_TOOLS_DISTORTION_TABLE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum
{
    DISTORTION_MAPPING = 1,
    DISTORTION_FRAME,
    DISTORTION_QUANTITY,
    DISTORTION_LAYOUT,
    DISTORTION_FACE,
    DISTORTION_SIZE,
    DISTORTION_COLORS,
    DISTORTION_REVERSE,
    DISTORTION_RANGE,
    DISTORTION_ISOLINES,
    DISTORTION_VALUES,
    DISTORTION_LEGEND,
    DISTORTION_THREADS,
    DISTORTION_QUIET,
    DISTORTION_FACE_MAX = 65536
};

/* The quantities; NULL behind the last. */
const char *quantity_name_at(size_t index);

#ifdef __cplusplus
}
#endif

#endif
