/* SPDX-License-Identifier: MIT
 *
 * How pictures of a scene lie on the sphere, and which of their pixels are hard. A surface is nothing but the
 * directions of the centres of its pixels, which anybody can give, and their regions.
 */
#ifndef TRUTH_SCENE_SURFACE_H
#define TRUTH_SCENE_SURFACE_H

#include <stddef.h>

#include <cubemap/mapping.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Where pixels are; one may be in several. */
typedef enum scene_region
{
    SCENE_ALL,
    SCENE_INTERIOR, /* in none of those below */
    SCENE_SEAM,     /* beside an edge of the cube */
    SCENE_CORNER,   /* beside a corner of the cube */
    SCENE_POLE,     /* beside a pole */
    SCENE_DATELINE, /* beside the antimeridian */
    SCENE_REGIONS
} scene_region;

const char *scene_region_name(scene_region region);

/* How far they reach, in radians. */
typedef struct scene_widths
{
    double seam;
    double corner;
    double pole;
    double dateline;
} scene_widths;

/* All of them so many pixels, which are so large, in radians. */
scene_widths scene_widths_of_pixels(double pixels, double radians);

/* The bits 1 << SCENE_SEAM, ... of a unit direction, for the cube that stands on the Earth's axes. */
unsigned scene_regions_of_direction(const scene_widths *widths, const double direction[3]);

/* Pictures of the same size. */
typedef struct scene_surface
{
    size_t planes;
    size_t width;
    size_t height;
    const void *user;
    /* The unit directions of the centres of the pixels of one row, in arrays of width elements; the first row is the
     * upper one. NaN for those that show nothing. */
    void (*directions)(const void *user, size_t plane, size_t row, double *x, double *y, double *z);
    /* The regions' bits of the pixels of one row, for other edges than those of the cube on the Earth's axes; NULL:
     * scene_regions_of_direction with widths. */
    void (*regions)(const void *user, size_t plane, size_t row, unsigned *regions);
    scene_widths widths;
} scene_surface;

/* The regions of the pixels of one row, whose directions are x, y, z. */
void scene_regions_of_row(const scene_surface *surface, size_t plane, size_t row, const double *x,
                          const double *y, const double *z, unsigned *regions);

/* An equirectangular picture, from lon -180 on the left and the north pole above. The size must stay. */
typedef struct scene_size
{
    size_t width;
    size_t height;
} scene_size;

scene_surface scene_equirect(const scene_size *size, scene_widths widths);

/* The six faces of a mapping in its frame. Both must stay. */
typedef struct scene_cube
{
    const cm_mapping *mapping;
    size_t size; /* of a face, in pixels */
} scene_cube;

scene_surface scene_faces(const scene_cube *cube, scene_widths widths);

#ifdef __cplusplus
}
#endif

#endif
