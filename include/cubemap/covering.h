/* SPDX-License-Identifier: MIT
 *
 * Coverings: the cells that a region of the Earth takes, all of one level or as many of all levels as are allowed.
 *
 * Regions lie on the sphere of normals: a point is the normal of the ellipsoid there, which is geographic longitude
 * and latitude on a sphere of radius 1. Angles are in radians. A cap is what is within an angle of a normal
 * (cm_cap_radius makes the angle from metres), a box what is between two meridians and two parallels, and a polygon
 * has edges that are great circles of that sphere, which on the ellipsoid are not geodesics (docs/guide/cells.md).
 *
 * An outer covering has the whole region in it, and its border too; each cell of it comes within a quarter of the
 * radius of its bounding cap (cell_grid.h) of the region, a leaf within the radius. Of the cells of an inner covering
 * each is wholly in the region. Both rest on bounding caps: see there on what their radius rests. Borders are taken
 * to be 1e-14 rad wider, meridians of boxes twice that.
 *
 *   memory      coverings allocate as much as their result takes, and up to 16 MB more; nothing is kept
 *   threads     regions are constant after their creation: any number of threads may use one
 */
#ifndef CUBEMAP_COVERING_H
#define CUBEMAP_COVERING_H

#include <stddef.h>

#include <cubemap/cell_grid.h>
#include <cubemap/ellipsoid.h>
#include <cubemap/export.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A region, from cm_region_cap and the like to cm_region_destroy. */
typedef struct cm_region cm_region;

/* The cap about a normal of any length, or about a place. radius: from 0, which is one point, to pi and more,
 * which is everything.
 * CM_OK; CM_ERROR_ARGUMENT (NULL, no point, a radius that is negative or NaN), CM_ERROR_MEMORY. */
CM_API cm_status cm_region_cap(const double normal[3], double radius, cm_region **region);
CM_API cm_status cm_region_cap_lonlat(double lon, double lat, double radius, cm_region **region);

/* The least angle of a cap that contains what is so many metres, along geodesics, from its middle, wherever that
 * is: metres divided by the least radius of curvature of the ellipsoid, which on a sphere is exact. NaN for a bad ellipsoid, or metres that are negative or NaN. */
CM_API double cm_cap_radius(const cm_ellipsoid *ellipsoid, double metres);

/* From the meridian of west eastward to that of east, and from the parallel of south to that of north. east may
 * be less than west, when the box goes over the antimeridian; if it is 2 pi or more above, it is a whole zone.
 * Latitudes are in [-pi/2, pi/2], up to 1e-9 beyond which is the pole.
 * CM_OK; CM_ERROR_ARGUMENT (NULL, what is not finite, latitudes that are none or north below south),
 * CM_ERROR_MEMORY. */
CM_API cm_status cm_region_box(double west, double south, double east, double north,
                               cm_region **region);

/* A polygon of rings: ring k has ring_length[k] corners, each lon, lat, the first of which comes after the last
 * by itself (it may be given again). The region is to the left of the edges, seen from outside: outer rings go
 * anticlockwise, holes clockwise, and a ring the other way round is all but what it encloses. Edges may
 * not cross or lie on each other; if they do, what is covered is not defined, but it ends. Corners within 1e-13 of
 * the one before count as the same, and where a ring turns back onto itself, as near, what is there and back is left
 * out.
 * CM_OK; CM_ERROR_ARGUMENT (NULL, no ring, a ring of which less than three corners are left, what is no point, two
 * neighbours that are opposite each other to 0.01), CM_ERROR_MEMORY. */
CM_API cm_status cm_region_polygon(size_t ring_count, const size_t *ring_length,
                                   const double *lonlat, cm_region **region);

/* NULL is allowed. */
CM_API void cm_region_destroy(cm_region *region);

/* Is a point in the region, or on its border? 1 or 0, which is for what is no point, too. */
CM_API int cm_region_contains(const cm_region *region, const double normal[3]);

/* Which cells a covering has. */
typedef enum cm_cover_kind
{
    CM_COVER_OUTER = 0, /* all that the region needs */
    CM_COVER_INNER = 1  /* those wholly in it */
} cm_cover_kind;

/* To be filled with zeros but for size, which is sizeof(cm_cover_options), and for what is wanted. */
typedef struct cm_cover_options
{
    size_t size;   /* sizeof(cm_cover_options) */
    int level_min; /* cells are of these levels; of one if both are the same */
    int level_max; /* at most CM_CELL_LEVEL_MAX */
    size_t
        cells_most; /* 0: as many as there are; else the largest cells are divided as long as there are no more,
                          and more than that only if level_min asks for them, or up to six for the faces */
    cm_cover_kind kind; /* outer or inner */
} cm_cover_options;

/* The covering of a region, sorted, none in another, and without four quarters of a cell that level_min allows.
 * to has room for capacity cells, which is not a budget: nothing is left out for its sake.
 * CM_OK, and *count is how many there are; CM_ERROR_ARGUMENT (NULL, to with a capacity above 0; options, kind
 * or levels that are none); CM_ERROR_SPACE: then *count is how many are needed, or, if that is more than 2^20
 * and the capacity, how many had been found when the search was given up; to is untouched. CM_ERROR_MEMORY. An
 * inner covering with a budget looks at 2^16 cells, and 64 times the budget, at most, so that where hardly a
 * cell fits into the region there may be fewer than there could be. */
CM_API cm_status cm_cover(const cm_cell_grid *cells, const cm_region *region,
                          const cm_cover_options *options, size_t capacity, cm_cell *to,
                          size_t *count);

#ifdef __cplusplus
}
#endif

#endif
