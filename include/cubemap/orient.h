/* SPDX-License-Identifier: MIT
 *
 * The best orientation of the base cube for a mask: the rotation for which land, people or whatever a raster says suffer
 * least from a mapping, or are cut least by the edges of faces.
 *
 * What is least, over the whole group of rotations, is a mean over the mask or a length:
 *   deformation   the mean of omega, radians (distortion.h)
 *   isotropy      the mean of D_I = a / b
 *   area          the mean of |ln D_A|: how far areas are from their mean scale, as a factor, either way
 *   scale         the mean of s = a b, whose mean over the sphere is 6/pi: how much of the map is spent on the mask
 *   edges         the length of the edges of faces over the mask, radians on the sphere (times 6371.0072: km),
 *                 times its values: each point of an edge has that of the pixel that it is in, of a border between two
 *                 the mean of both. Edges that are no great circles, healpix's, are chords of 0.2 degrees
 * Means count equal areas of the sphere alike (CM_OVER_SPHERE: what there is on Earth), or of the map (CM_OVER_FACE:
 * what there is in memory). Pixels in whose middle the mapping has no value do not count; a mean over none is infinite.
 *
 * A survey of all rotations on a grid finds valleys, which are followed downhill; bounds by boxes say how good any other
 * rotation can be. docs/guide/orientation.md tells how, and what we find for land. The task is that of Dimitrijevic,
 * Strobl, Lambers, Milosavljevic, Rancic, Distortion optimized spherical cube mapping, 2020, section III C.
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

/* What is to be least. */
typedef enum cm_orient_measure
{
    CM_ORIENT_DEFORMATION = 0, /* mean omega */
    CM_ORIENT_ISOTROPY = 1,    /* mean D_I */
    CM_ORIENT_AREA = 2,        /* mean |ln D_A| */
    CM_ORIENT_SCALE = 3,       /* mean s */
    CM_ORIENT_EDGES = 4        /* a length */
} cm_orient_measure;

/* A raster of the whole sphere, equirectangular: value[row * width + column], the first row at the north
 * pole, the first column at longitude -180, pixels of 360 / width by 180 / height degrees. Values
 * are finite and not negative, and not all zero: how much of a pixel counts. Latitudes are those of the sphere that is
 * mapped: of a raster in geographic latitude that is as if the Earth were a sphere. */
typedef struct cm_mask
{
    size_t size;        /* sizeof(cm_mask) */
    size_t width;       /* pixels, 1 to CM_MASK_MAX */
    size_t height;      /* pixels, 1 to CM_MASK_MAX */
    const float *value; /* width height numbers, row by row */
} cm_mask;

/* The largest width and height of a mask. */
#define CM_MASK_MAX 65536

/* To be filled with zeros but for size, which is sizeof(cm_orient_options), and for what is wanted. */
typedef struct cm_orient_options
{
    size_t size;               /* sizeof(cm_orient_options) */
    cm_orient_measure measure; /* what is to be least */
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
    void *user; /* what progress is given */
} cm_orient_options;

/* No result has more rivals. */
#define CM_ORIENT_RIVALS_MAX 8

/* A local optimum. */
typedef struct cm_orient_rival
{
    cm_rotation rotation; /* of the cube */
    double value;         /* of the measure */
} cm_orient_rival;

/* size must be sizeof(cm_orient_result) before the call. */
typedef struct cm_orient_result
{
    size_t size;          /* sizeof(cm_orient_result) */
    cm_rotation rotation; /* of those that are as good by symmetry, the least turned */
    double lon;           /* its angles, degrees */
    double lat;           /* of the middle of the front */
    double roll;          /* about it */
    double before;        /* the measure without rotation */
    double after;         /* and with it, over the whole mask */
    double gap;           /* no rotation at all has a measure below after - gap */
    double radius;        /* degrees: each rotation farther than this from rotation, and
                                         from those as good by symmetry, has a measure of after or more;
                                         180 if that cannot be said of any */
    unsigned symmetries;  /* rotations of the cube that keep the measure, 1 to 24 */
    size_t boxes;         /* of rotations that were looked at */
    size_t rival_count;   /* the best local optima that were met, by value: the first is rotation */
    cm_orient_rival rival[CM_ORIENT_RIVALS_MAX]; /* rival_count of them */
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
 * 16 bytes for each pixel that counts and some 200 MB are allocated.
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
