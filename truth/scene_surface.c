/* SPDX-License-Identifier: MIT */
#include "scene_surface.h"

#include <math.h>
#include <stdint.h>

#define PI 3.14159265358979323846

const char *scene_region_name(scene_region region)
{
    static const char *const names[SCENE_REGIONS] = {"all",    "interior", "seam",
                                                     "corner", "pole",     "dateline"};
    return (unsigned)region < SCENE_REGIONS ? names[region] : NULL;
}

scene_widths scene_widths_of_pixels(double pixels, double radians)
{
    const double width = pixels * radians;
    const scene_widths widths = {width, width, width, width};
    return widths;
}

/* The sine of the angle to the nearest plane through two edges is the difference of the two largest components over
 * sqrt(2); that of the angle to
 * the corner of the same octant, which is never beyond 55 degrees, is the length of the cross product with it. */
unsigned scene_regions_of_direction(const scene_widths *widths, const double direction[3])
{
    const double a = fabs(direction[0]);
    const double b = fabs(direction[1]);
    const double c = fabs(direction[2]);
    const double largest = fmax(a, fmax(b, c));
    const double least = fmin(a, fmin(b, c));
    const double middle = a + b + c - largest - least;
    const double from_corner =
        sqrt(((a - b) * (a - b) + (b - c) * (b - c) + (c - a) * (c - a)) / 3.0);
    const double from_axis = sqrt(direction[0] * direction[0] + direction[1] * direction[1]);
    unsigned regions = 0;
    if ((largest - middle) / sqrt(2.0) < sin(widths->seam))
    {
        regions |= 1u << SCENE_SEAM;
    }
    if (from_corner < sin(widths->corner))
    {
        regions |= 1u << SCENE_CORNER;
    }
    if (from_axis < sin(widths->pole))
    {
        regions |= 1u << SCENE_POLE;
    }
    if (direction[0] < 0.0 && b < sin(widths->dateline))
    {
        regions |= 1u << SCENE_DATELINE;
    }
    return regions;
}

void scene_regions_of_row(const scene_surface *surface, size_t plane, size_t row, const double *x,
                          const double *y, const double *z, unsigned *regions)
{
    if (surface->regions != NULL)
    {
        surface->regions(surface->user, plane, row, regions);
        return;
    }
    for (size_t i = 0; i < surface->width; i++)
    {
        const double d[3] = {x[i], y[i], z[i]};
        regions[i] = scene_regions_of_direction(&surface->widths, d);
    }
}

static void equirect_directions(const void *user, size_t plane, size_t row, double *x, double *y,
                                double *z)
{
    const scene_size *size = user;
    const double lat = PI * (0.5 - ((double)row + 0.5) / (double)size->height);
    (void)plane;
    for (size_t i = 0; i < size->width; i++)
    {
        const double lon = 2.0 * PI * (((double)i + 0.5) / (double)size->width - 0.5);
        x[i] = cos(lat) * cos(lon);
        y[i] = cos(lat) * sin(lon);
        z[i] = sin(lat);
    }
}

scene_surface scene_equirect(const scene_size *size, scene_widths widths)
{
    const scene_surface made = {1,    size->width, size->height, size, equirect_directions,
                                NULL, widths};
    return made;
}

static void face_directions(const void *user, size_t plane, size_t row, double *x, double *y,
                            double *z)
{
    const scene_cube *cube = user;
    const double pixels = (double)cube->size;
    const double first = cm_mapping_frame(cube->mapping)->first_row_v;
    const double v = first * (1.0 - (2.0 * (double)row + 1.0) / pixels);
    for (size_t i = 0; i < cube->size; i++)
    {
        const double uv[2] = {(2.0 * (double)i + 1.0) / pixels - 1.0, v};
        double d[3];
        cm_inverse(cube->mapping, (uint8_t)plane, uv, d);
        x[i] = d[0];
        y[i] = d[1];
        z[i] = d[2];
    }
}

scene_surface scene_faces(const scene_cube *cube, scene_widths widths)
{
    const scene_surface made = {6, cube->size, cube->size, cube, face_directions, NULL, widths};
    return made;
}
