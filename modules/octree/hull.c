/* SPDX-License-Identifier: MIT
 *
 * Visual hulls, coarse to fine: a cube that is outside of one mask dies whole, what is inside of all lives whole, and only blocks
 * in between are asked voxel by voxel.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "modules/memory/checked_size.h"
#include "block_access.h"
#include "hull_mask.h"
#include "octree_object.h"
#include "picture.h"

#define FREE 0
#define OCCUPIED 255

/* Blocks whose voxels are carved before they are written. */
#define BATCH 4096

/* A cube of 2^level voxels. */
typedef struct hull_cube
{
    int64_t corner[3]; /* in voxels from the root's centre */
    uint64_t inside;   /* bits of the first 64 masks that are known to have all of it */
    cm_hull_class class_of;
} hull_cube;

typedef struct hull
{
    cm_octree *octree;
    cm_pool *pool;
    const cm_hull_set *set;
    size_t count;
    cm_hull_mask *mask; /* those that know classes of cubes first */
    int level;          /* of cubes */
    hull_cube *cube;
    size_t cube_count;
    uint64_t (*alive)[8]; /* of a batch of blocks */
    size_t first;         /* of the batch */
} hull;

static int is_known(const hull_cube *cube, size_t mask)
{
    return mask < 64 && (cube->inside >> mask & 1) != 0;
}

static double centre_of(const hull *h, const hull_cube *cube, int axis, double voxels)
{
    return h->octree->options.centre[axis] +
           ((double)cube->corner[axis] + voxels) * h->octree->options.edge;
}

static void classify(size_t begin, size_t end, void *user)
{
    const hull *h = user;
    const double size = ldexp(1.0, h->level);
    for (size_t i = begin; i < end; i++)
    {
        hull_cube *cube = &h->cube[i];
        const double middle[3] = {centre_of(h, cube, 0, 0.5 * size),
                                  centre_of(h, cube, 1, 0.5 * size),
                                  centre_of(h, cube, 2, 0.5 * size)};
        cube->class_of = CM_HULL_INSIDE;
        for (size_t m = 0; m < h->count && cube->class_of != CM_HULL_OUTSIDE; m++)
        {
            if (is_known(cube, m))
            {
                continue;
            }
            const cm_hull_class is =
                cm_hull_classify(&h->mask[m], middle, 0.5 * (size - 1.0) * h->octree->options.edge);
            cube->inside |= (uint64_t)(is == CM_HULL_INSIDE && m < 64) << m % 64;
            cube->class_of = is == CM_HULL_INSIDE ? cube->class_of : is;
        }
    }
}

static void carve(size_t begin, size_t end, void *user)
{
    const hull *h = user;
    for (size_t i = begin; i < end; i++)
    {
        const hull_cube *cube = &h->cube[h->first + i];
        uint64_t *alive = h->alive[i];
        memset(alive, 0xff, sizeof h->alive[i]);
        uint64_t any = 1;
        for (size_t m = 0; m < h->count && any != 0; m++)
        {
            if (!is_known(cube, m))
            {
                cm_hull_carve_block(&h->mask[m], h->set, cube->corner, alive);
                any = alive[0] | alive[1] | alive[2] | alive[3] | alive[4] | alive[5] | alive[6] |
                      alive[7];
            }
        }
    }
}

static cm_status write_block(const hull *h, const hull_cube *cube, const uint64_t alive[8])
{
    uint8_t alpha[CM_BLOCK_CELLS];
    for (unsigned i = 0; i < CM_BLOCK_CELLS; i++)
    {
        alpha[i] = alive[i / 64] >> i % 64 & 1 ? OCCUPIED : FREE;
    }
    return cm_octree_set_block(h->octree, cube->corner, alpha, NULL);
}

static cm_status carve_blocks(hull *h)
{
    cm_status status = CM_OK;
    for (h->first = 0; status == CM_OK && h->first < h->cube_count; h->first += BATCH)
    {
        const size_t left = h->cube_count - h->first;
        const size_t count = left < BATCH ? left : BATCH;
        cm_pool_run(h->pool, count, 16, carve, h);
        for (size_t i = 0; status == CM_OK && i < count; i++)
        {
            status = write_block(h, &h->cube[h->first + i], h->alive[i]);
        }
    }
    return status;
}

/* What is decided is written; what is not becomes eight cubes each, or stays as it is where cubes are blocks. */
static cm_status settle(hull *h)
{
    size_t open = 0;
    cm_status status = CM_OK;
    for (size_t i = 0; i < h->cube_count; i++)
    {
        const hull_cube *cube = &h->cube[i];
        if (cube->class_of == CM_HULL_MIXED)
        {
            h->cube[open++] = *cube;
        }
        else if (status == CM_OK)
        {
            status = cm_octree_set_cube(h->octree, cube->corner, h->level,
                                        cube->class_of == CM_HULL_INSIDE ? OCCUPIED : FREE);
        }
    }
    h->cube_count = open;
    return status;
}

static cm_status divide(hull *h)
{
    hull_cube *eighths = cm_array_of(h->cube_count + 1, 8 * sizeof *eighths);
    if (eighths == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    const int64_t half = (int64_t)1 << (h->level - 1);
    for (size_t i = 0; i < 8 * h->cube_count; i++)
    {
        eighths[i] = h->cube[i / 8];
        for (unsigned axis = 0; axis < 3; axis++)
        {
            eighths[i].corner[axis] += (i >> axis & 1) != 0 ? half : 0;
        }
    }
    free(h->cube);
    h->cube = eighths;
    h->cube_count *= 8;
    h->level--;
    return CM_OK;
}

/* The cubes around the centre: of blocks, if the map is smaller than they are, which keep what is not the map's unknown. */
static cm_status begin_cubes(hull *h)
{
    h->level = h->octree->options.levels - 1;
    h->level = h->level < 3 ? 3 : h->level;
    h->cube_count = 8;
    h->cube = calloc(h->cube_count, sizeof *h->cube);
    h->alive = cm_array_of(BATCH, sizeof *h->alive);
    for (unsigned i = 0; h->cube != NULL && i < 8; i++)
    {
        for (unsigned axis = 0; axis < 3; axis++)
        {
            h->cube[i].corner[axis] = (i >> axis & 1) != 0 ? 0 : -((int64_t)1 << h->level);
        }
    }
    return h->cube != NULL && h->alive != NULL ? CM_OK : CM_ERROR_MEMORY;
}

/* All is unknown again. */
static void undo(hull *h)
{
    free(h->cube);
    free(h->alive);
    if (begin_cubes(h) == CM_OK)
    {
        for (unsigned i = 0; i < 8; i++)
        {
            cm_octree_set_cube(h->octree, h->cube[i].corner, h->level, CM_UNKNOWN);
        }
    }
}

static cm_status carve_all(hull *h)
{
    cm_status status = begin_cubes(h);
    while (status == CM_OK)
    {
        cm_pool_run(h->pool, h->cube_count, 64, classify, h);
        status = settle(h);
        if (status != CM_OK || h->level == 3)
        {
            break;
        }
        status = divide(h);
    }
    return status == CM_OK ? carve_blocks(h) : status;
}

/* ---- masks ---- */

static cm_status check(const cm_octree *octree, size_t n, const cm_view *masks)
{
    if (octree == NULL || n == 0 || masks == NULL || !cm_octree_is_empty(octree))
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = CM_OK;
    for (size_t i = 0; status == CM_OK && i < n; i++)
    {
        if (masks[i].size != sizeof masks[i] || masks[i].camera == NULL)
        {
            return CM_ERROR_ARGUMENT;
        }
        const cm_camera_options *lens = cm_camera_describe(masks[i].camera);
        status = cm_picture_check(&masks[i].color, lens->width, lens->height, 1, CM_CHANNELS_MAX);
        status = status == CM_OK ? cm_pose_check(&masks[i].pose) : status;
    }
    return status;
}

typedef struct making
{
    hull *h;
    const cm_view *masks;
    int outside_survives;
} making;

static void make_masks(size_t begin, size_t end, void *user)
{
    const making *m = user;
    for (size_t i = begin; i < end; i++)
    {
        /* memory that is missing is found afterwards */
        (void)cm_hull_mask_make(&m->masks[i], &m->h->octree->options, m->outside_survives,
                                &m->h->mask[i]);
    }
}

/* Those that know of cubes come first: what they leave is less. */
static void sort_masks(hull *h)
{
    size_t plain = 0;
    for (size_t i = 0; i < h->count; i++)
    {
        if (h->mask[i].is_plain && i != plain)
        {
            const cm_hull_mask other = h->mask[plain];
            h->mask[plain] = h->mask[i];
            h->mask[i] = other;
        }
        plain += h->mask[i].is_plain ? 1 : 0;
    }
}

static cm_status prepare(hull *h, const cm_view *masks, int outside_survives)
{
    h->mask = calloc(h->count, sizeof *h->mask);
    if (h->mask == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    making m = {h, masks, outside_survives != 0};
    cm_pool_run(h->pool, h->count, 1, make_masks, &m);
    cm_status status = CM_OK;
    for (size_t i = 0; i < h->count; i++)
    {
        status = h->mask[i].bits == NULL || h->mask[i].sums == NULL ? CM_ERROR_MEMORY : status;
    }
    sort_masks(h);
    return status;
}

cm_status cm_hull_carve(cm_octree *octree, size_t n, const cm_view *masks, int outside_survives,
                        cm_pool *pool)
{
    cm_status status = check(octree, n, masks);
    if (status != CM_OK)
    {
        return status;
    }
    hull h = {
        .octree = octree, .pool = pool, .set = cm_hull_set_find(octree->set->name), .count = n};
    status = prepare(&h, masks, outside_survives);
    if (status == CM_OK)
    {
        status = carve_all(&h);
        if (status != CM_OK)
        {
            undo(&h);
        }
    }
    for (size_t i = 0; h.mask != NULL && i < n; i++)
    {
        cm_hull_mask_drop(&h.mask[i]);
    }
    free(h.mask);
    free(h.cube);
    free(h.alive);
    return status;
}
