/* SPDX-License-Identifier: MIT
 *
 * Options of several programs with pictures of the sphere: how the faces of a cube sit in pictures, and lines.
 */
#ifndef CUBEMAP_TOOLS_CUBE_TABLE_H
#define CUBEMAP_TOOLS_CUBE_TABLE_H

#include "tools/cli/option_table.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Beyond the ids of a program's own. */
enum
{
    OVERLAY_GRATICULE = 1000,
    OVERLAY_GRID,
    OVERLAY_INDICATRICES,
    OVERLAY_INDICATRICES_RADIUS,
    OVERLAY_LINE_WIDTH,
    OVERLAY_LINE_COLOR
};

/* Up to NULL, in the order of CubeLayout. */
extern const char *const cm_layout_names[];

/* What lies over pictures, for the groups of a command. */
extern const cm_option cm_overlay_options[];
enum
{
    OVERLAY_OPTION_COUNT = 4
};

/* How lines look: white and wide, for dark pictures; thin and black, for light ones. */
extern const cm_option cm_white_line_options[];
extern const cm_option cm_black_line_options[];
enum
{
    LINE_OPTION_COUNT = 2
};

#ifdef __cplusplus
}
#endif

#endif
