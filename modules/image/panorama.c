/* SPDX-License-Identifier: MIT
 *
 * Panoramas and surfaces.
 */
#include "surface_specification.h"

#include <cubemap/number.h>
#include <cubemap/panorama.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Surfaces have no larger pictures. */
#define MOST 1073741824u

cm_status cm_panorama_check(const cm_panorama *panorama)
{
    if (panorama == NULL || panorama->size != sizeof *panorama)
    {
        return CM_ERROR_ARGUMENT;
    }
    const int is_whole = panorama->full_width == 0 && panorama->full_height == 0;
    const int is_inside =
        panorama->full_width <= MOST && panorama->full_height <= MOST &&
        panorama->cropped_width > 0 && panorama->cropped_height > 0 &&
        (uint64_t)panorama->cropped_left + panorama->cropped_width <= panorama->full_width &&
        (uint64_t)panorama->cropped_top + panorama->cropped_height <= panorama->full_height;
    const int heads =
        isnan(panorama->heading) || (panorama->heading >= 0.0 && panorama->heading < 360.0);
    return (is_whole || is_inside) && heads && fabs(panorama->pitch) <= 90.0 &&
                   panorama->roll > -180.0 && panorama->roll <= 180.0
               ? CM_OK
               : CM_ERROR_RANGE;
}

/* An edge in degrees, from the first one. */
static double edge(double first, double extent, uint32_t pixel, uint32_t whole)
{
    return first + extent * pixel / whole;
}

cm_status cm_panorama_surface(const cm_panorama *panorama, uint32_t width, uint32_t height,
                              char *specification, size_t size, cm_rotation *rotation)
{
    char number[4][CM_NUMBER_SIZE];
    const cm_status status = cm_panorama_check(panorama);
    if (status != CM_OK || specification == NULL)
    {
        return status == CM_OK ? CM_ERROR_ARGUMENT : status;
    }
    if (width == 0 || height == 0)
    {
        return CM_ERROR_RANGE;
    }
    const cm_panorama whole = {
        .full_width = 1, .full_height = 1, .cropped_width = 1, .cropped_height = 1};
    const cm_panorama *at = panorama->full_width == 0 ? &whole : panorama;
    const uint32_t right = at->cropped_left + at->cropped_width;
    const uint32_t bottom = at->cropped_top + at->cropped_height;
    cm_number_write_shortest(edge(-180.0, 360.0, at->cropped_left, at->full_width), number[0]);
    cm_number_write_shortest(edge(-180.0, 360.0, right, at->full_width), number[1]);
    cm_number_write_shortest(edge(90.0, -180.0, bottom, at->full_height), number[2]);
    cm_number_write_shortest(edge(90.0, -180.0, at->cropped_top, at->full_height), number[3]);
    char text[CM_SURFACE_TEXT];
    const int length =
        snprintf(text, sizeof text, "equirect;west=%s;east=%s;south=%s;north=%s;size=%u;height=%u",
                 number[0], number[1], number[2], number[3], (unsigned)width, (unsigned)height);
    if (length < 0 || (size_t)length >= size)
    {
        return CM_ERROR_SPACE;
    }
    memcpy(specification, text, (size_t)length + 1);
    if (rotation != NULL)
    {
        const double heading = isnan(panorama->heading) ? 0.0 : panorama->heading;
        cm_rotation_from_angles(heading, panorama->pitch, -panorama->roll, rotation);
    }
    return CM_OK;
}

/* A number of pixels, if it is one. */
static int is_whole(double value, uint32_t *pixels)
{
    const double nearest = floor(value + 0.5);
    *pixels = nearest >= 0.0 && nearest <= MOST ? (uint32_t)nearest : 0;
    return fabs(value - nearest) <= 1e-3 && nearest >= 0.0 && nearest <= MOST;
}

/* West, east, south and north of a specification. */
static void read_bounds(const char *specification, double bounds[4])
{
    static const char *const keys[4] = {"west", "east", "south", "north"};
    cm_surface_words words;
    const cm_complaint nobody = {NULL, 0};
    if (cm_surface_words_read(specification, &words, nobody) == CM_OK)
    {
        for (int i = 0; i < 4; i++)
        {
            cm_surface_key_number(&words, keys[i], -HUGE_VAL, HUGE_VAL, &bounds[i], nobody);
        }
    }
}

/* The axes of a surface after its own turn by lon about its vertical one. */
static cm_status turned_about(const cm_rotation *rotation, double lon, cm_rotation *turned)
{
    cm_rotation turn;
    const cm_status status = cm_rotation_from_angles(lon, 0.0, 0.0, &turn);
    for (int i = 0; status == CM_OK && i < 3; i++)
    {
        cm_rotate_back(rotation, turn.row[i], turned->row[i]);
    }
    return status;
}

/* The first column of a part in the whole picture, whose middle then is at a longitude. A whole picture does not go on
 * at its edges: a part that lies across 180 degrees is in the middle of a whole that is turned. */
static int place_columns(double west, double columns, cm_panorama *made, double *middle)
{
    const double full = made->full_width;
    double left = (west + 180.0) * columns;
    left -= full * floor((left + 1e-3) / full);
    *middle = 0.0;
    if (left + made->cropped_width > full + 1e-3)
    {
        left = floor(0.5 * (full - made->cropped_width));
        *middle = west + 180.0 - left / columns;
    }
    return is_whole(left, &made->cropped_left);
}

cm_status cm_panorama_of_surface(const cm_surface *surface, cm_panorama *panorama)
{
    double bounds[4] = {-180.0, 180.0, -90.0, 90.0};
    double middle, roll;
    if (surface == NULL || panorama == NULL || panorama->size != sizeof *panorama)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (strncmp(surface->specification, "equirect", 8) != 0)
    {
        return CM_ERROR_UNSUPPORTED;
    }
    read_bounds(surface->specification, bounds);
    cm_panorama made = {
        .size = sizeof made, .cropped_width = surface->width, .cropped_height = surface->height};
    const double columns = surface->width / (bounds[1] - bounds[0]); /* of a degree */
    const double rows = surface->height / (bounds[3] - bounds[2]);
    /* a whole picture may be a fraction of a pixel larger: then its pixels are not quite those of the part */
    if (!is_whole(360.0 * columns, &made.full_width) ||
        !is_whole(180.0 * rows, &made.full_height) ||
        !place_columns(bounds[0], columns, &made, &middle) ||
        !is_whole((90.0 - bounds[3]) * rows, &made.cropped_top))
    {
        return CM_ERROR_RANGE;
    }
    cm_rotation turned = surface->rotation;
    cm_status status = middle == 0.0 ? CM_OK : turned_about(&surface->rotation, middle, &turned);
    status =
        status == CM_OK ? cm_rotation_angles(&turned, &made.heading, &made.pitch, &roll) : status;
    if (status != CM_OK)
    {
        return status;
    }
    made.heading += made.heading < 0.0 ? 360.0 : 0.0;
    made.heading = made.heading >= 360.0 ? 0.0 : made.heading;
    made.roll = roll >= 180.0 ? 180.0 : -roll;
    if (cm_panorama_check(&made) != CM_OK)
    {
        return CM_ERROR_RANGE;
    }
    *panorama = made;
    return CM_OK;
}
