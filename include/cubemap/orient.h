/* SPDX-License-Identifier: MIT
 *
 * The best orientation of the base cube for a mask: the rotation for which land, people or whatever a raster
 * says suffer least from a mapping, or are cut least by the edges of faces.
 *
 * What is least, over the whole group of rotations, is a mean over the mask or a length:
 *   deformation   the mean of omega, radians (distortion.h)
 *   isotropy      the mean of D_I = a / b
 *   area          the mean of |ln D_A|: how far areas are from their mean scale, as a factor, either way
 *   scale         the mean of s = a b, whose mean over the sphere is 6/pi: how much of the map is spent on the mask
 *   edges         the length of the edges of faces over the mask, radians on the sphere (times 6371.0072: km),
 *                 each piece, a fifth of a pixel long but 0.02 to 0.2 degrees, times the mask's value there
 * Means count equal areas of the sphere alike (CM_OVER_SPHERE: what there is on Earth), or of the map
 * (CM_OVER_FACE: what there is in memory), as statistics.h says. Pixels in whose middle the mapping has no value, as at
 * the corners of some, do not count; a mean over none is infinite.
 *
 * How it is found: the rotations, less those that only exchange faces that look alike, are cut into boxes. The middles
 * of small ones are a grid, at whose nodes the measure is found over a reduced mask (of land: 5000 points; of edges,
 * pieces of 0.4 degrees). All nodes that are no more than their neighbours, across the borders of what is
 * exchanged, too, are followed downhill by it. The valleys where they end are followed by the whole mask in the
 * order of what the reduced one says, until no other could be among the two best: the reduced mask is then taken to
 * be off by as much as twice the range that was seen, and following to gain as much as twice what it did. At most
 * 24 valleys are followed so; margin below says how far that went.
 * What all others can be, a lower bound for each box says: the field of distortion is replaced by linear pieces
 * and what it can be below them within the box's reach, so that bound and value differ as the square of
 * the box's size; for edges the mask is eroded by that reach. Boxes that are no better than the best
 * rotation known are left out, the others halved along each axis. What the field can be below
 * a linear piece is found by samples, as dense as the pieces: the bounds are numerical, not
 * interval arithmetic.
 *
 * Source of the task: Dimitrijevic, Strobl, Lambers, Milosavljevic, Rancic, Distortion optimized spherical cube
 * mapping for discrete global grid systems, 2020, section III C. docs/guide/orientation.md has what we find
 * for land, beside their figures.
 */
#ifndef CUBEMAP_ORIENT_H
#define CUBEMAP_ORIENT_H

#include <stddef.h>

#include <cubemap/export.h>
#include <cubemap/mapping.h>
#include <cubemap/orientation.h>
#include <cubemap/statistics.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum cm_orient_measure
{
    CM_ORIENT_DEFORMATION = 0,
    CM_ORIENT_ISOTROPY = 1,
    CM_ORIENT_AREA = 2,
    CM_ORIENT_SCALE = 3,
    CM_ORIENT_EDGES = 4
} cm_orient_measure;

/* A raster of the whole sphere, equirectangular: value[row * width + column], the first row at the north
 * pole, the first column at longitude -180, pixels of 360 / width by 180 / height degrees. Values
 * are finite and not negative, and not all zero: how much of a pixel counts. Latitudes are those of the sphere that is
 * mapped: of a raster in geographic latitude that is as if the Earth were a sphere. */
typedef struct cm_mask
{
    size_t size; /* sizeof(cm_mask) */
    size_t width;
    size_t height; /* 1 to CM_MASK_MAX each */
    const float *value;
} cm_mask;

#define CM_MASK_MAX 65536

/* To be filled with zeros but for size, which is sizeof(cm_orient_options), and for what is wanted. */
typedef struct cm_orient_options
{
    size_t size;
    cm_orient_measure measure;
    cm_measure over;   /* CM_OVER_SPHERE, or CM_OVER_FACE, which is 0; of no matter to edges */
    double resolution; /* degrees, 0.01 to 10, to which the best rotation is followed; 0: 0.1 */
    unsigned threads;  /* as in threads.h; 0: as many as there are */
    size_t
        boxes_max; /* where the bounds stop splitting; 0: 100000, of edges 600000. The grid is of 0.7
                          degrees, or 1.4, 2.8 or 5.6 where a finer one has more than four nodes for each of
                          these; if this is 0 of 1.4 degrees for a cube, of edges 0.7 */
    /* Called now and then from the calling thread with the part that is done, 0 to 1; the search ends with
     * CM_ERROR_STOPPED if it returns other than 0. NULL: not called */
    int (*progress)(double done, void *user);
    void *user;
} cm_orient_options;

#define CM_ORIENT_RIVALS_MAX 8

typedef struct cm_orient_rival
{
    cm_rotation rotation;
    double value;
} cm_orient_rival;

/* size must be sizeof(cm_orient_result) before the call. */
typedef struct cm_orient_result
{
    size_t size;
    cm_rotation rotation;  /* of those that are as good by symmetry, the least turned */
    double lon, lat, roll; /* its angles, degrees */
    double before;         /* the measure without rotation */
    double after;          /* and with it, over the whole mask */
    double gap;            /* no rotation at all has a measure below after - gap */
    double radius;         /* degrees: each rotation farther than this from rotation, and
                                         from those as good by symmetry, has a measure of after or more;
                                         180 if that cannot be said of any */
    unsigned symmetries;   /* rotations of the cube that keep the measure, 1 to 24 */
    size_t boxes;          /* of rotations that were looked at */
    size_t rival_count; /* the best local optima that were met, by value: the first is rotation */
    cm_orient_rival rival[CM_ORIENT_RIVALS_MAX];
    /* The survey; all 0 if the measure is the same for every rotation. */
    size_t nodes;   /* of the grid of rotations, at all of which the reduced mask was measured */
    double spacing; /* degrees from one to the next along an axis of the grid, at most */
    size_t minima; /* nodes that are no more than any neighbour: all were followed downhill by it */
    size_t valleys;  /* ends of that that are 2 degrees apart or more */
    size_t followed; /* of these, the best by the reduced mask, were followed by the whole one: */
    double margin;   /* all that the reduced mask has less than this above its best; if that is all
                              valleys, how far above the worst of them is */
    double error;    /* the range of whole less reduced at their ends */
    double drop;     /* the most that following any of them by the whole mask gained */
    cm_orient_rival
        other; /* the best of those 5 degrees or more from rotation: the second-best valley */
    double
        other_apart; /* degrees from it to rotation; 0 if there is none, and other is the rotation */
} cm_orient_result;

/* "deformation", "isotropy", "area", "scale", "edges" at 0 to 4, NULL at others; and the measure of a name (upper
 * and lower case are the same), -1 if it is none. */
CM_API const char *cm_orient_measure_name(size_t index);
CM_API int cm_orient_measure_find(const char *name);

/* The best orientation of a mapping to six faces for a mask. If the measure is the same for every rotation
 * (deformation of a conformal mapping, area of an equal-area one) that is none at all: the cube stays.
 * The same bits for any number of threads.
 * Cost: 15 to 65 s of one processor for land of 1440 x 720 pixels, of edges 90 s; 16 bytes for each pixel that counts
 * and some 200 MB.
 * CM_OK; CM_ERROR_ARGUMENT (NULL, a size or a number outside its range, a mask that is none);
 * CM_ERROR_UNSUPPORTED if the mapping has not six faces; CM_ERROR_MEMORY; CM_ERROR_STOPPED. */
CM_API cm_status cm_orient(const cm_mapping *mapping, const cm_mask *mask,
                           const cm_orient_options *options, cm_orient_result *result);

/* The measure in a given orientation, over the whole mask: what before and after are. Of the options measure,
 * over and threads matter. Errors as cm_orient, and CM_ERROR_ORIENTATION as cm_rotation_check. */
CM_API cm_status cm_orient_value(const cm_mapping *mapping, const cm_mask *mask,
                                 const cm_orient_options *options, const cm_rotation *rotation,
                                 double *value);

#ifdef __cplusplus
}
#endif

#endif
