/* SPDX-License-Identifier: MIT
 *
 * Octrees: maps of scenes from depth views, no larger than the scene. A library of its own, cubemap-octree.
 *
 *   voxel       at level 0 it is [k, k + 1) edges from the centre along each axis, k a whole number; at level n eight of
 *               level n - 1 make one. The root is at the level `levels`
 *   alpha       0 to 255: above 127 occupied, below 127 free, 127 unknown. Inner nodes have the average of what is below
 *               them, rounded to the nearest, halves away from 127. Where anything below is occupied, free counts as 127
 *               there and 128 is the least: what is occupied stays so at every level, however thin
 *   update      the pixel that a voxel's centre falls on decides: a hit where the surface seen there may cross the voxel, a
 *               miss where it is in front of that and reaches no silhouette or crease beside it, else nothing; but a hit
 *               where it reaches over a silhouette and a ray of a pixel beside its own ends in it (finest voxels, cameras
 *               without a lens). A view changes a voxel at most once
 *   counts      the chapter's rule: a hit adds 2 and a miss takes 2, saturating (Kotfis and Cozzi, Octree Mapping from a
 *               Depth Camera, 2014): 64 misses make what is surely occupied unknown
 *   color       the first counts whole, then a running average whose weights are the hits that alpha holds
 *   results     the same bits for any number of threads, any instruction set, and any order of what commutes
 *   threads     reading changes nothing the caller sees, but with pages it loads them: one thread at a time then, else any
 *   errors      CM_ERROR_ARGUMENT for NULL and a wrong size, CM_ERROR_MEMORY; outputs are untouched then
 */
#ifndef CUBEMAP_OCTREE_H
#define CUBEMAP_OCTREE_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/camera.h>
#include <cubemap/export.h>
#include <cubemap/image.h>
#include <cubemap/pool.h>
#include <cubemap/pose.h>
#include <cubemap/raster.h>
#include <cubemap/status.h>
#include <cubemap/store.h>
#include <cubemap/view.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A map, from cm_octree_create to cm_octree_destroy. */
typedef struct cm_octree cm_octree;

/* No tree has more levels. */
#define CM_OCTREE_LEVELS_MAX 20

/* How hits and misses are counted. */
typedef enum cm_octree_rule
{
    CM_OCTREE_COUNTS = 0,  /* the chapter's: 2 for a hit, 2 for a miss, from 0 to 255 */
    CM_OCTREE_LOG_ODDS = 1 /* hit, miss, low and high of the options */
} cm_octree_rule;

/* To be filled with zeros but for size, edge, levels and what is wanted. */
typedef struct cm_octree_options
{
    size_t size;      /* sizeof(cm_octree_options) */
    double edge;      /* of the finest voxel, in units of the world; above 0 */
    double centre[3]; /* of the root */
    int levels;       /* 1 to CM_OCTREE_LEVELS_MAX: the root has 2^levels voxels each way */
    int rule;         /* a cm_octree_rule */
    /* Of log-odds, in steps of which 127 fit between 0 and the farther of low and high; each is a whole step at least: */
    double hit;  /* what a hit adds, above 0 */
    double miss; /* what a miss adds, below 0 */
    double low;  /* the least, below 0 */
    double high; /* the greatest, above 0 */
    double near; /* depths, or ranges, that are nearer say nothing */
    /* What is farther is free up to here and no hit; 0: no limit; see cm_octree_update. */
    double far;
    int no_return_is_free; /* 1: pixels without a measurement are free up to far, which must be given */
    double noise;     /* of the sensor: sigma / range; hits reach 2 sigma around what is seen */
    double footprint; /* voxels are no finer than so many pixels, up to 8 edges; 0: one size */
    int color;        /* 1: voxels have colors */
    uint64_t memory;  /* bytes that regions may take before some go to pages; 0: no limit */
    cm_store *pages;  /* where they go; it must outlive the map. NULL: nowhere */
    const char *instructions; /* as in cm_options */
    /* 1: nothing is missed, so that no space becomes free and what moves away stays; updates take less time and maps less memory.
     * Not with no_return_is_free. */
    int endpoints_only;
} cm_octree_options;

/* CM_OK; CM_ERROR_ARGUMENT (memory without pages too); CM_ERROR_RANGE (a number that cannot be: edge, levels, low not below
 * high, near not below far, ...); CM_ERROR_INSTRUCTIONS; CM_ERROR_MEMORY. */
CM_API cm_status cm_octree_create(const cm_octree_options *options, cm_octree **octree);

/* NULL is allowed. What was not saved is lost. */
CM_API void cm_octree_destroy(cm_octree *octree);

/* What it was made of; lives as long as the map. */
CM_API const cm_octree_options *cm_octree_describe(const cm_octree *octree);

/* ---- making it ---- */

/* Integrate a view, of any camera; what has no color leaves colors as they are; colors are CM_PIXEL_U8 of one channel to four, grey
 * ones, of less than three, are three alike. Depths are those of cm_depth_clean. pool may be
 * NULL. A view without a valid pixel changes nothing. near and far of the options are depths for every camera that has an optical
 * axis, even where its image is of ranges; ranges for whole surroundings, and for points.
 * CM_OK; CM_ERROR_ARGUMENT (no depth, or images that are not the camera's size); CM_ERROR_CAMERA (no such pose);
 * CM_ERROR_RANGE (unit, type; depths beyond 2^20 edges, as of a background of 1e10, in a map of more than 13 levels without far:
 * all in front of them would be free, and take all memory. The map is as before); CM_ERROR_FILE, _DATA, _SPACE (pages: the map is as before the view, or whole with it);
 * CM_ERROR_MEMORY. */
CM_API cm_status cm_octree_update(cm_octree *octree, const cm_view *view, cm_pool *pool);

/* Integrate points of the world seen from an origin: voxels with a point are hit, those that a ray crosses before it are
 * missed, each once. NaN points are left out. rgb, three bytes a point, may be NULL.
 * Errors as of cm_octree_update; CM_ERROR_RANGE (an origin that is not finite). */
CM_API cm_status cm_octree_update_points(cm_octree *octree, const double origin[3], size_t n,
                                         const float *xyz, const uint8_t *rgb);

/* Add a map to another of the same rule: alphas add, less 127, and colors are averaged by their hits. With pose, which takes
 * points of `from` to points of `to`, and where edge or centre differ by more than whole voxels, each voxel of `to` takes
 * what is at its centre in `from`; NULL: the axes are the same. It may be cut at the root of `to`. What is even may be so large
 * that its borders are more than memory has room for: without pages that is CM_ERROR_MEMORY, and `to` is as it was.
 * CM_OK; CM_ERROR_ARGUMENT (to is from, too); CM_ERROR_UNSUPPORTED (other rules); CM_ERROR_CAMERA; CM_ERROR_FILE, _DATA,
 * _SPACE; CM_ERROR_MEMORY. Where pages or memory fail midway, `to` has some voxels of `from` and can be used as before. */
CM_API cm_status cm_octree_merge(cm_octree *to, const cm_octree *from, const cm_pose *pose);

/* Give memory back that equal voxels need not have. Nothing that is asked changes.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_FILE (pages: the map is whole); CM_ERROR_MEMORY. */
CM_API cm_status cm_octree_compact(cm_octree *octree);

/* ---- asking it ---- */

/* What a voxel can be. */
typedef enum cm_voxel_state
{
    CM_VOXEL_UNKNOWN = 0, /* alpha is 127 */
    CM_VOXEL_FREE = 1,    /* below */
    CM_VOXEL_OCCUPIED = 2 /* above */
} cm_voxel_state;

/* A voxel. This struct will not change. */
typedef struct cm_voxel
{
    double x;          /* its centre */
    double y;          /* and its second coordinate */
    double z;          /* and its third */
    double edge;       /* its length */
    double distance;   /* of cm_octree_ray and cm_octree_nearest: to it; else 0 */
    int32_t level;     /* of its size: edge = 2^level finest edges */
    uint8_t state;     /* a cm_voxel_state */
    uint8_t alpha;     /* 0 to 255 */
    uint8_t has_color; /* 1: color is of hits */
    uint8_t color[3];  /* red, green, blue; 0 where there is none */
} cm_voxel;

/* The voxel of a level that has the point; at level 0 with a footprint, the larger one that was updated as one. Returns its
 * state; outside of the root, for NaN, or if pages fail, CM_VOXEL_UNKNOWN with edge 0. voxel may be NULL. */
CM_API int cm_octree_at(const cm_octree *octree, const double point[3], int level, cm_voxel *voxel);

/* The first occupied voxel along a ray of any length but 0, at level 0: 1, with the distance, in units of the world, to where
 * the ray enters it (0 if it begins inside); a larger cube of equal ones may be told for it, as walks do. 0 if there is none
 * up to far (0: no limit), numbers are not finite, or pages fail (cm_octree_walk_ray says so). Unknown and free voxels are
 * passed. When many rays have gone through a map without pages, an index makes those to come faster, until the map changes or
 * is compacted: some seven bytes for each occupied voxel of a surface, a hundred for one alone. */
CM_API int cm_octree_ray(const cm_octree *octree, const double origin[3], const double direction[3],
                         double far, cm_voxel *voxel);

/* The occupied voxel of level 0 whose centre is the nearest within a radius, of equals the first in the order of keys: 1, with
 * its distance; 0 if there is none, or pages fail. */
CM_API int cm_octree_nearest(const cm_octree *octree, const double point[3], double radius,
                             cm_voxel *voxel);

/* Called for a voxel; what is not 0 ends the walk with CM_ERROR_STOPPED. It may read the octree, but not change or destroy it. */
typedef int (*cm_voxel_job)(void *user, const cm_voxel *voxel);

/* All known voxels of level 0 along a ray up to far, in its order; of a box [least, greatest], those whose centre is in it,
 * in the order of keys; and those in blocks of 8^3 voxels in which a view changed something after the step `since`
 * (cm_octree_step), in the order of keys. Equal voxels may come as one larger voxel.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_STOPPED; CM_ERROR_FILE, _DATA, _MEMORY (pages). */
CM_API cm_status cm_octree_walk_ray(const cm_octree *octree, const double origin[3],
                                    const double direction[3], double far, cm_voxel_job job,
                                    void *user);
CM_API cm_status cm_octree_walk_box(const cm_octree *octree, const double least[3],
                                    const double greatest[3], cm_voxel_job job, void *user);
CM_API cm_status cm_octree_walk_changes(const cm_octree *octree, uint64_t since, cm_voxel_job job,
                                        void *user);

/* How many updates and merges there were. */
CM_API uint64_t cm_octree_step(const cm_octree *octree);

/* The occupied voxels of a level in the order of keys. *count is how many there are, also when there is no room for them:
 * so voxel may be NULL if capacity is 0. CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE (level); CM_ERROR_SPACE, which sets *count;
 * CM_ERROR_FILE, _DATA, _MEMORY (pages). */
CM_API cm_status cm_octree_extract(const cm_octree *octree, int level, size_t capacity,
                                   cm_voxel *voxel, size_t *count);

/* What a map holds. size is to be set before the call. */
typedef struct cm_octree_count
{
    size_t size;       /* sizeof(cm_octree_count) */
    uint64_t occupied; /* voxels of level 0 */
    uint64_t free;     /* voxels of level 0 */
    uint64_t nodes; /* of the tree that are in memory: inner ones, blocks and voxels on their own */
    uint64_t bytes; /* that regions, nodes and colors take in memory */
    uint64_t paged; /* regions that are in pages alone */
} cm_octree_count;

/* CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_FILE, _DATA, _MEMORY (pages). */
CM_API cm_status cm_octree_count_voxels(const cm_octree *octree, cm_octree_count *count);

/* ---- keeping it ---- */

/* Put what changed since the last time into a store, all if it is another store than options.pages, and commit. user_data of
 * at most 65536 bytes are kept with it, NULL for none. CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_FILE, _DATA, _SPACE, _MEMORY. */
CM_API cm_status cm_octree_save(cm_octree *octree, cm_store *store, const void *user_data,
                                size_t count);

/* The map that a store keeps; with memory and pages of the options, which may be NULL, and all else as it was saved. Without
 * options->pages all of it is loaded, else what is needed, from pages, which must be that store then.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_DATA (no map there, or a damaged one); CM_ERROR_VERSION; CM_ERROR_FILE; CM_ERROR_MEMORY. */
CM_API cm_status cm_octree_load(cm_store *store, const cm_octree_options *options,
                                cm_octree **octree);

/* What cm_octree_save was given: *count bytes, which live as long as the map; NULL and 0 for none. */
CM_API const void *cm_octree_user_data(const cm_octree *octree, size_t *count);

/* ---- seeing it ---- */

/* How a map looks: occupied voxels are opaque however sure they are, those without color are grey; what is above level 0 is as
 * opaque as what it hides along the ray. Without light colors are as they are kept. With it they are darker by ambient and the
 * cosine to the light, which does not grow weaker with distance; a mesh by its shadow alone. To be filled with zeros but for size
 * and what is wanted. */
typedef struct cm_octree_shading
{
    size_t size;              /* sizeof(cm_octree_shading) */
    int coarsest;             /* the finest level that is read: 0 for all */
    double far;               /* the length of cones in units of the world; 0: 10 */
    int light;                /* 1: one virtual light with a cone-traced shadow */
    double light_position[3]; /* where it is, in the world */
    double light_angle;       /* of the shadow's cone, full, in radians; 0: 0.1 */
    double ambient;           /* of the light that is everywhere, 0 to 1; 0: 0.3 */
    float background[3];      /* 0 to 1 */
    const cm_raster
        *mesh; /* a canvas in front of the same camera, whose pixels hide what is behind; NULL */
    const float *mesh_color; /* three floats a pixel of it, 0 to 1; NULL: white */
    cm_pool *pool;           /* NULL: the calling thread */
} cm_octree_shading;

/* Trace a cone for each pixel of a camera, whose solid angle says how wide it is: color of three or four channels, 0 to 1, of
 * CM_PIXEL_U8, _U16 or _FLOAT, the fourth what hides the background; and depth, or range of omnidirectional cameras, one channel of
 * CM_PIXEL_FLOAT, where half is hidden, NaN where it is not. Either may be NULL, and so may shading.
 * CM_OK; CM_ERROR_ARGUMENT (a canvas of another size, too); CM_ERROR_CAMERA; CM_ERROR_RANGE (types, sizes, numbers); CM_ERROR_FILE, _DATA (pages);
 * CM_ERROR_MEMORY. */
CM_API cm_status cm_octree_render(const cm_octree *octree, const cm_camera *camera,
                                  const cm_pose *pose, const cm_octree_shading *shading,
                                  cm_image *color, cm_image *depth);

/* ---- hulls ---- */

/* Carve the visual hull of n masks, the views' colors, inside where any channel is not 0, into an empty map: what all masks have
 * inside is occupied (255), the rest free (0). A voxel is inside a mask where its centre falls on such a pixel. outside_survives:
 * 1: a view that does not see the centre, behind it or beside the picture, says nothing; 0: what it does not see is outside.
 * CM_OK; CM_ERROR_ARGUMENT (no views, no masks, a map that is not empty); CM_ERROR_CAMERA; CM_ERROR_RANGE; CM_ERROR_MEMORY. */
CM_API cm_status cm_hull_carve(cm_octree *octree, size_t n, const cm_view *masks,
                               int outside_survives, cm_pool *pool);

#ifdef __cplusplus
}
#endif

#endif
