/* SPDX-License-Identifier: MIT
 *
 * A region around a camera that is not straight: cubes of blocks, blocks and groups of 64 voxels are compared with the sides around the
 * camera; of the voxels of those that a surface may be in the camera says which pixel they fall on.
 */
#include "update_round.h"

#include <math.h>
#include <string.h>

#include "interleave.h"

/* ---- details ---- */

static unsigned detail_of(const cm_round_work *work, cm_region *region, unsigned block,
                          const uint32_t place[3])
{
    const cm_update *update = work->update;
    const double at[3] = {place[0] + 3.5, place[1] + 3.5, place[2] + 3.5};
    double centre[3];
    cm_update_place(update, at, centre);
    const double distance =
        sqrt(centre[0] * centre[0] + centre[1] * centre[1] + centre[2] * centre[2]);
    return cm_update_detail(update, region, block, update->pixel * distance);
}

/* ---- voxels ---- */

/* Terms of the centres of a block's cells, so that their sums are those of cm_update_place. */
static void make_terms(const cm_update *update, const uint32_t place[3], unsigned detail,
                       cm_round_terms *terms)
{
    const double half = 0.5 * ((1u << detail) - 1u);
    const unsigned cells = 8u >> detail, pairs = cells > 1 ? cells / 2 : 1;
    for (unsigned map_axis = 0; map_axis < 3; map_axis++)
    {
        for (unsigned axis = 0; axis < 3; axis++)
        {
            for (unsigned pair = 0; pair < pairs; pair++)
            {
                double of[2];
                for (unsigned side = 0; side < 2; side++)
                {
                    const double at =
                        place[map_axis] + (double)((2 * pair + side) << detail) + half;
                    const double term = at * update->step[map_axis][axis];
                    of[side] = map_axis == 0 ? update->origin[axis] + term : term;
                }
                for (unsigned k = 0; k < CM_ROUND_EIGHT; k++)
                {
                    terms->of[axis][map_axis][pair][k] = of[k >> map_axis & 1u];
                }
            }
        }
    }
}

/* What is known of a block before its pixels are asked. */
typedef struct block_view
{
    unsigned detail;
    const uint8_t *group_class; /* of eight groups */
    const cm_cube_bounds *bounds;
    cm_ray_ends ends;
} block_view;

/* Cells whose pixels are to be asked; all others are missed or nothing happens to them. */
static void choose_cells(const cm_round_work *work, const uint32_t place[3], const block_view *view,
                         cm_round_cells *cells, cm_block_change *change)
{
    const cm_update *update = work->update;
    const size_t count = cm_cell_count(view->detail);
    cm_round_terms terms;
    make_terms(update, place, view->detail, &terms);
    cells->eights = 0;
    for (unsigned group = 0; 64 * group < count; group++)
    {
        const unsigned class_of =
            view->detail == 0 ? view->group_class[group] : (unsigned)CM_CUBE_PART;
        if (cm_update_is_left_out(update, class_of))
        {
            continue;
        }
        if (class_of == CM_CUBE_FREE)
        {
            change->misses[group] = ~(uint64_t)0;
            continue;
        }
        const int is_known = view->detail == 0;
        const cm_round_group of = {.first_eight = 8 * group,
                                   .eights = count < 64 ? (unsigned)(count + 7) / 8 : 8,
                                   .is_range = work->round->is_range,
                                   .is_inside = class_of == CM_CUBE_BAND,
                                   .near = update->octree->options.near,
                                   .least = is_known ? view->bounds[group].least : -INFINITY,
                                   .most = is_known ? view->bounds[group].most : INFINITY};
        change->misses[group] = update->set->round_eights(&terms, &of, cells);
    }
}

/* Loops are of whole vectors: what is behind the last cell falls nowhere. */
static size_t pad_cells(cm_round_cells *cells, size_t count)
{
    for (; count % 16 != 0; count++)
    {
        cells->column[count] = cells->row[count] = 0.0;
        cells->value[count] = NAN;
    }
    return count;
}

/* What pixels say of the cells whose centres fall on them, and which pixels hit. */
static void ask_pixels(const cm_round_work *work, const uint32_t place[3], const block_view *view,
                       cm_block_change *change)
{
    const cm_update *update = work->update;
    cm_round_cells cells;
    uint64_t hits[8], misses[8];
    choose_cells(work, place, view, &cells, change);
    const size_t count = CM_ROUND_EIGHT * cells.eights;
    if (count == 0)
    {
        return;
    }
    cm_camera_project_array(update->view->camera, count, cells.x, cells.y, cells.z, cells.column,
                            cells.row);
    const cm_round_picture picture = cm_round_picture_of(update, work->round);
    update->set->round_ask(&picture, pad_cells(&cells, count), cells.column, cells.row,
                           (float)(1u << view->detail), cells.value, cells.pixel, hits, misses);
    for (size_t i = 0; i < cells.eights; i++)
    {
        const unsigned group = cells.eight[i] / 8u, in_group = cells.eight[i] % 8u * 8u;
        const unsigned from = (unsigned)(i % 8) * 8u;
        change->hits[group] |= (hits[i / 8] >> from & 255u) << in_group;
        change->misses[group] |= (misses[i / 8] >> from & 255u) << in_group;
        memcpy(change->pixel[group] + in_group, cells.pixel + CM_ROUND_EIGHT * i,
               CM_ROUND_EIGHT * sizeof *cells.pixel);
    }
}

static void visit_block(const cm_round_work *work, cm_region *region, unsigned block,
                        const uint32_t place[3], const block_view *view)
{
    cm_update *update = work->update;
    cm_block_change change;
    change.detail = view->detail;
    memset(change.hits, 0, sizeof change.hits);
    memset(change.misses, 0, sizeof change.misses);
    ask_pixels(work, place, view, &change);
    if (view->detail == 0) /* coarser cells are large enough for their own pixel */
    {
        cm_ray_ends_hit(view->ends, change.hits, change.pixel);
    }
    const size_t cells = cm_cell_count(view->detail);
    const uint64_t all = cells < 64 ? ((uint64_t)1 << cells) - 1 : ~(uint64_t)0;
    const int is_whole = cm_update_is_within(update->octree, region, block);
    uint64_t any = 0, every_miss = all;
    for (unsigned group = 0; 64 * group < cells; group++)
    {
        const uint64_t valid =
            is_whole ? all
                     : cm_update_valid(update->octree, region, block, view->detail, group) & all;
        change.hits[group] &= valid;
        change.misses[group] &=
            update->octree->options.endpoints_only ? 0 : valid & ~change.hits[group];
        any |= change.hits[group] | change.misses[group];
        every_miss &= change.misses[group];
    }
    if (every_miss == all && region->form[block] == CM_BLOCK_EVEN)
    {
        cm_update_free_block(update, region, block);
    }
    else if (any != 0 && !cm_update_block(update, region, block, &change))
    {
        update->failed = 1;
    }
}

/* ---- cubes ---- */

/* Centres of cubes in the camera's axes, and what is known of them. */
typedef struct cube_places
{
    float at[3][CM_REGION_GROUPS];
    uint8_t class_of[CM_REGION_GROUPS];
    cm_cube_bounds bounds[CM_REGION_GROUPS];
} cube_places;

static void classify(const cm_round_work *work, size_t count, const float half[3],
                     cube_places *places, cm_cube_bounds *bounds)
{
    const cm_round_cubes cubes = {.count = count,
                                  .at = {places->at[0], places->at[1], places->at[2]},
                                  .half = half,
                                  .is_range = work->round->is_range,
                                  .nearest =
                                      fmaxf((float)work->update->octree->options.near, 0.0f)};
    cm_round_faces_classify(&work->round->faces, work->update->set, &cubes, places->class_of,
                            bounds);
}

/* Blocks of a region that are looked at voxel by voxel, in the order of their numbers. */
typedef struct chosen_blocks
{
    size_t count;
    uint16_t listed[CM_REGION_BLOCKS];
    cm_ray_ends ends[CM_REGION_BLOCKS];
} chosen_blocks;

static void first_voxel(const cm_update *update, const cm_region *region, double in_camera[3])
{
    const double place[3] = {region->place[0], region->place[1], region->place[2]};
    cm_update_place(update, place, in_camera);
}

/* Those of cubes of eight blocks in which something may happen. */
static size_t list_blocks(const cm_round_work *work, const double first[3], const uint64_t *ended,
                          cube_places *places, uint16_t listed[CM_REGION_BLOCKS])
{
    const cm_update *update = work->update;
    const float *const of[3] = {update->block.x, update->block.y, update->block.z};
    for (unsigned eight = 0; eight < CM_REGION_BLOCKS / 8; eight++)
    {
        const unsigned low = 8 * eight, high = low + 7;
        for (int axis = 0; axis < 3; axis++)
        {
            places->at[axis][eight] =
                (float)(first[axis] + 0.5 * ((double)of[axis][low] + (double)of[axis][high]));
        }
    }
    classify(work, CM_REGION_BLOCKS / 8, update->eight_half, places, NULL);
    size_t count = 0;
    for (unsigned block = 0; block < CM_REGION_BLOCKS; block++)
    {
        const int has_ends = (ended[block / 64] >> block % 64 & 1u) != 0;
        if (has_ends || !cm_update_is_left_out(update, places->class_of[block / 8]))
        {
            listed[count++] = (uint16_t)block;
        }
    }
    for (size_t i = 0; i < count; i++)
    {
        for (int axis = 0; axis < 3; axis++)
        {
            places->at[axis][i] = (float)(first[axis] + (double)of[axis][listed[i]]);
        }
    }
    classify(work, count, update->block_half, places, NULL);
    return count;
}

static void block_place(const cm_region *region, unsigned block, uint32_t place[3])
{
    unsigned in[3];
    cm_divide_3(block, in);
    for (int axis = 0; axis < 3; axis++)
    {
        place[axis] = region->place[axis] + 8 * in[axis];
    }
}

/* Chooses blocks; those that are wholly free are counted as such at once. */
static void choose_blocks(const cm_round_work *work, cm_region *region, const double first[3],
                          cube_places *places, chosen_blocks *chosen)
{
    cm_update *update = work->update;
    cm_ray_ends ends = cm_ray_ends_in(update->ends, region->place, CM_REGION_LEVEL);
    uint64_t ended[CM_REGION_BLOCKS / 64] = {0};
    for (const cm_ray_end *end = ends.first; end != ends.end; end++)
    {
        ended[end->key >> 15 & 7u] |= (uint64_t)1 << (end->key >> 9 & 63u);
    }
    const size_t count = list_blocks(work, first, ended, places, chosen->listed);
    chosen->count = 0;
    for (size_t i = 0; i < count; i++)
    {
        const unsigned block = chosen->listed[i];
        uint32_t place[3];
        block_place(region, block, place);
        const cm_ray_ends here = cm_ray_ends_take_block(&ends, block);
        unsigned class_of = here.first != here.end ? (unsigned)CM_CUBE_PART : places->class_of[i];
        if (class_of == CM_CUBE_UNKNOWN)
        {
            class_of = cm_round_class_of(work, place, CM_BLOCK_LEVEL);
        }
        if (cm_update_is_left_out(update, class_of))
        {
            continue;
        }
        if (class_of == CM_CUBE_FREE && cm_update_is_within(update->octree, region, block))
        {
            cm_update_free_block(update, region, block);
            continue;
        }
        chosen->ends[chosen->count] = here;
        chosen->listed[chosen->count++] = (uint16_t)block;
    }
}

/* Groups of 64 voxels of the chosen blocks. */
static void classify_groups(const cm_round_work *work, const double first[3],
                            const chosen_blocks *chosen, cube_places *places)
{
    const cm_update *update = work->update;
    const cm_cell_offsets *offset =
        &update->offset[2]; /* cells of 4^3 voxels are those of detail 2 */
    const float *const in_block[3] = {offset->x, offset->y, offset->z};
    const float *const of[3] = {update->block.x, update->block.y, update->block.z};
    for (int axis = 0; axis < 3; axis++)
    {
        /* from a block's centre to its first voxel's */
        const double back =
            3.5 * (update->step[0][axis] + update->step[1][axis] + update->step[2][axis]);
        for (size_t i = 0; i < chosen->count; i++)
        {
            const double at = first[axis] + (double)of[axis][chosen->listed[i]] - back;
            for (size_t group = 0; group < 8; group++)
            {
                places->at[axis][8 * i + group] = (float)(at + (double)in_block[axis][group]);
            }
        }
    }
    classify(work, 8 * chosen->count, update->group_half, places, places->bounds);
}

void cm_round_region(const cm_round_work *work, cm_region *region)
{
    cube_places places;
    chosen_blocks chosen;
    double first[3];
    first_voxel(work->update, region, first);
    choose_blocks(work, region, first, &places, &chosen);
    classify_groups(work, first, &chosen, &places);
    for (size_t i = 0; i < chosen.count; i++)
    {
        const unsigned block = chosen.listed[i];
        uint32_t place[3];
        block_place(region, block, place);
        const block_view view = {.detail = detail_of(work, region, block, place),
                                 .group_class = places.class_of + 8 * i,
                                 .bounds = places.bounds + 8 * i,
                                 .ends = chosen.ends[i]};
        visit_block(work, region, block, place, &view);
    }
    region->is_dirty = 1;
}
