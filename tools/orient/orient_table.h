/* SPDX-License-Identifier: MIT
 *
 * What the options of cubemap-orient are called in its source.
 */
#ifndef CUBEMAP_TOOLS_ORIENT_TABLE_H
#define CUBEMAP_TOOLS_ORIENT_TABLE_H

enum
{
    ORIENT_MAPPING = 1,
    ORIENT_MEASURE,
    ORIENT_OVER,
    ORIENT_THRESHOLD,
    ORIENT_INVERT,
    ORIENT_RESOLUTION,
    ORIENT_BOXES,
    ORIENT_EVALUATE,
    ORIENT_PICTURE,
    ORIENT_IMAGE,
    ORIENT_SIZE,
    ORIENT_THREADS,
    ORIENT_JSON,
    ORIENT_QUIET,
    ORIENT_LIST
};

#endif
