/* SPDX-License-Identifier: MIT
 *
 * Sizes of pictures, from the keys of a specification or from what the caller has; and other numbers that kinds have.
 */
#include "surface_kinds.h"

#include <cubemap/number.h>

#include <math.h>
#include <stdio.h>

/* "4N", "3N + 8": what a size may be for a whole N. */
static void write_multiple(uint32_t times, uint32_t more, char *text, size_t size)
{
    char factor[16] = "";
    char rest[24] = "";
    if (times != 1)
    {
        snprintf(factor, sizeof factor, "%u", (unsigned)times);
    }
    if (more != 0)
    {
        snprintf(rest, sizeof rest, " + %u", (unsigned)more);
    }
    snprintf(text, size, "%sN%s", factor, rest);
}

cm_status cm_surface_grid_size(cm_surface *surface, const cm_surface_wish *wish,
                               const cm_plane_grid *grid)
{
    double edge = grid->edge;
    const cm_surface_options *options = wish->options;
    const cm_status status =
        cm_surface_key_number(wish->words, "size", 1.0, CM_PICTURE_MOST, &edge, wish->complaint);
    if (status != CM_OK)
    {
        return status;
    }
    if (grid->edge != 0.0 && edge != grid->edge)
    {
        return cm_complain(wish->complaint, CM_ERROR_RANGE, "the size is %.17g, and %.17g",
                           grid->edge, edge);
    }
    if (edge == 0.0)
    {
        edge = options->width != 0
                   ? floor(((double)options->width - grid->more_columns) / grid->columns)
                   : floor(((double)options->height - grid->more_rows) / grid->rows);
        edge = fmax(edge, 0.0);
    }
    const double width = grid->columns * edge + grid->more_columns;
    const double height = grid->rows * edge + grid->more_rows;
    if (edge != floor(edge) || width > CM_PICTURE_MOST || height > CM_PICTURE_MOST)
    {
        return cm_complain(wish->complaint, CM_ERROR_RANGE, "%.17g x %.17g is no size of a picture",
                           width, height);
    }
    if ((options->width != 0 && options->width != width) ||
        (options->height != 0 && options->height != height))
    {
        char across[40];
        char down[40];
        write_multiple(grid->columns, grid->more_columns, across, sizeof across);
        write_multiple(grid->rows, grid->more_rows, down, sizeof down);
        return cm_complain(wish->complaint, CM_ERROR_RANGE, "%u x %u is not %s x %s",
                           (unsigned)options->width, (unsigned)options->height, across, down);
    }
    if (edge == 0.0 && wish->sizes_matter)
    {
        return cm_complain(wish->complaint, CM_ERROR_RANGE, "the size is missing, as in size=1024");
    }
    surface->width = surface->height = (uint32_t)edge;
    surface->picture_width = (uint32_t)width;
    surface->picture_height = (uint32_t)height;
    return CM_OK;
}

cm_status cm_surface_free_size(cm_surface *surface, const cm_surface_wish *wish, double aspect)
{
    const cm_surface_options *options = wish->options;
    double width = 0.0;
    double height = 0.0;
    cm_status status =
        cm_surface_key_number(wish->words, "size", 1.0, CM_PICTURE_MOST, &width, wish->complaint);
    status = status != CM_OK ? status
                             : cm_surface_key_number(wish->words, "height", 1.0, CM_PICTURE_MOST,
                                                     &height, wish->complaint);
    status = status != CM_OK ? status
                             : cm_surface_key_number(wish->words, "aspect", 1e-3, 1e3, &aspect,
                                                     wish->complaint);
    if (status != CM_OK)
    {
        return status;
    }
    if ((options->width != 0 && width != 0.0 && width != options->width) ||
        (options->height != 0 && height != 0.0 && height != options->height))
    {
        return cm_complain(wish->complaint, CM_ERROR_RANGE,
                           "the pictures are %u x %u, not %.17g x %.17g", (unsigned)options->width,
                           (unsigned)options->height, width, height);
    }
    width = options->width != 0 ? options->width : width;
    height = options->height != 0 ? options->height : height;
    if (width == 0.0 && height == 0.0 && wish->sizes_matter)
    {
        return cm_complain(wish->complaint, CM_ERROR_RANGE, "the size is missing, as in size=1024");
    }
    if (width != 0.0 || height != 0.0)
    {
        width = width == 0.0 ? fmax(floor(height * aspect + 0.5), 1.0) : width;
        height = height == 0.0 ? fmax(floor(width / aspect + 0.5), 1.0) : height;
    }
    if (width > CM_PICTURE_MOST || height > CM_PICTURE_MOST || width != floor(width) ||
        height != floor(height))
    {
        return cm_complain(wish->complaint, CM_ERROR_RANGE, "%.17g x %.17g is no size of a picture",
                           width, height);
    }
    surface->width = surface->picture_width = (uint32_t)width;
    surface->height = surface->picture_height = (uint32_t)height;
    return CM_OK;
}

cm_status cm_surface_say_size(cm_surface *surface)
{
    return surface->picture_width == 0
               ? CM_OK
               : cm_surface_say(surface, ";size=%u;height=%u", (unsigned)surface->picture_width,
                                (unsigned)surface->picture_height);
}
