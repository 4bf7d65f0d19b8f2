/* SPDX-License-Identifier: MIT
 *
 * What the options of cubemap-reproject are called in its source.
 */
#ifndef CUBEMAP_TOOLS_REPROJECT_TABLE_H
#define CUBEMAP_TOOLS_REPROJECT_TABLE_H

enum
{
    REPROJECT_FROM = 1,
    REPROJECT_TO,
    REPROJECT_SIZE,
    REPROJECT_LAYOUT,
    REPROJECT_FROM_LAYOUT,
    REPROJECT_FRAME,
    REPROJECT_FROM_FRAME,
    REPROJECT_FILTER,
    REPROJECT_THREADS,
    REPROJECT_QUIET,
    /* The largest --size, for a cube or a chart, and for an equirectangular image. */
    REPROJECT_FACE_MAX = 65536,
    REPROJECT_EQUIRECT_MAX = 262144
};

#endif
