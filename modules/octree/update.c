/* SPDX-License-Identifier: MIT
 *
 * A view into a map: what is wholly in front of all that it sees is counted in the tree, what is behind or beside is left, and
 * regions in between go to threads, each to one.
 */
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "modules/memory/checked_size.h"
#include "color_word.h"
#include "interleave.h"
#include "paging.h"
#include "ray_index.h"
#include "update_desk.h"
#include "update_round.h"

/* ---- the desk ---- */

static void destroy_desk(void *memory)
{
    cm_update_desk *desk = memory;
    if (desk->rounds_destroy != NULL)
    {
        desk->rounds_destroy(desk->rounds);
    }
    cm_view_desk_clear(&desk->view);
    free(desk->list);
    free(desk->missed);
    free(desk);
}

cm_update_desk *cm_update_desk_of(cm_octree *octree)
{
    if (octree->desk == NULL)
    {
        octree->desk = calloc(1, sizeof(cm_update_desk));
        octree->desk_destroy = destroy_desk;
    }
    return octree->desk;
}

/* ---- places ---- */

void cm_update_half(const cm_update *update, int level, double distance, float half[3])
{
    const double edges = 0.5 * (ldexp(1.0, level) - 1.0);
    const double more = 1e-4 * update->octree->options.edge + 4e-7 * distance;
    for (int axis = 0; axis < 3; axis++)
    {
        half[axis] = (float)(edges * (fabs(update->step[0][axis]) + fabs(update->step[1][axis]) +
                                      fabs(update->step[2][axis])) +
                             more);
    }
}

static void make_offsets(cm_update *update)
{
    for (unsigned detail = 0; detail < CM_DETAILS; detail++)
    {
        for (unsigned cell = 0; cell < 512; cell++)
        {
            const size_t last = cm_cell_count(detail) - 1;
            unsigned in[3];
            cm_divide_3((unsigned)(cell < last ? cell : last) << 3 * detail, in);
            const double half = 0.5 * ((1u << detail) - 1u);
            float *const to[3] = {update->offset[detail].x, update->offset[detail].y,
                                  update->offset[detail].z};
            for (int axis = 0; axis < 3; axis++)
            {
                to[axis][cell] = (float)((in[0] + half) * update->step[0][axis] +
                                         (in[1] + half) * update->step[1][axis] +
                                         (in[2] + half) * update->step[2][axis]);
            }
        }
    }
    for (unsigned block = 0; block < CM_REGION_BLOCKS; block++)
    {
        unsigned in[3];
        cm_divide_3(block, in);
        float *const to[3] = {update->block.x, update->block.y, update->block.z};
        for (int axis = 0; axis < 3; axis++)
        {
            to[axis][block] = (float)((8 * in[0] + 3.5) * update->step[0][axis] +
                                      (8 * in[1] + 3.5) * update->step[1][axis] +
                                      (8 * in[2] + 3.5) * update->step[2][axis]);
        }
    }
}

void cm_update_make_parts(cm_update *update)
{
    const cm_count_rule *rule = &update->octree->rule;
    for (unsigned alpha = 0; alpha < 256; alpha++)
    {
        const unsigned sum = alpha + rule->hit;
        const unsigned hits = cm_hits_of(rule, sum < rule->high ? sum : rule->high);
        const uint32_t part = cm_color_part[hits < 255 ? hits : 255];
        update->hit.part_of[alpha] = hits > 0 && alpha <= CM_UNKNOWN ? 65536u : part;
    }
}

static void begin(cm_update *update, cm_octree *octree, cm_update_desk *desk, const cm_view *view)
{
    const cm_octree_options *options = &octree->options;
    const double half = ldexp(options->edge, octree->tree_level - 1);
    double corner[3];
    update->octree = octree;
    update->desk = desk;
    update->view = view;
    update->set = octree->set;
    update->failed = 0;
    for (int axis = 0; axis < 3; axis++)
    {
        corner[axis] = options->centre[axis] - half + 0.5 * options->edge;
    }
    cm_pose_apply(&view->pose, corner, update->origin);
    for (int axis = 0; axis < 3; axis++)
    {
        for (int i = 0; i < 3; i++)
        {
            update->step[axis][i] = options->edge * view->pose.rotation.row[i][axis];
        }
    }
    update->has_color = options->color && view->color.data != NULL;
    update->hit.word = desk->view.word;
    cm_update_make_parts(update);
    desk->count = 0;
    desk->missed_count = 0;
    update->ends.first = update->ends.end = NULL;
    make_offsets(update);
}

/* ---- the tree ---- */

static int has_room(uint32_t **list, size_t count, size_t *room)
{
    if (count == *room)
    {
        const size_t wanted = *room == 0 ? 256 : 2 * *room;
        uint32_t *more = cm_array_resized(*list, wanted, sizeof *more);
        if (more == NULL)
        {
            return 0;
        }
        *list = more;
        *room = wanted;
    }
    return 1;
}

cm_status cm_update_list_miss(cm_update *update, uint32_t node)
{
    cm_update_desk *desk = update->desk;
    if (!has_room(&desk->missed, desk->missed_count, &desk->missed_room))
    {
        return CM_ERROR_MEMORY;
    }
    desk->missed[desk->missed_count++] = node;
    return CM_OK;
}

void cm_update_end_lists(cm_update *update, cm_status status)
{
    cm_update_desk *desk = update->desk;
    update->octree->step -= status != CM_OK;
    for (size_t i = 0; status == CM_OK && i < desk->missed_count; i++)
    {
        cm_node_miss(update->octree, desk->missed[i], 1);
    }
}

cm_status cm_update_list_region(cm_update *update, uint32_t node, const uint32_t place[3])
{
    cm_update_desk *desk = update->desk;
    if (!has_room(&desk->list, desk->count, &desk->room))
    {
        return CM_ERROR_MEMORY;
    }
    cm_region *region = NULL;
    const cm_status status = cm_node_region(update->octree, node, place, &region);
    if (status == CM_OK)
    {
        desk->list[desk->count++] = node;
    }
    return status;
}

/* Classes of the eight children of a cube at a place. */
static void classify_eight(const cm_update *update, const uint32_t place[3], int level,
                           uint8_t class_of[16])
{
    float x[16] = {0}, y[16] = {0}, z[16] = {0}, half[3];
    const double middle = 0.5 * (ldexp(1.0, level) - 1.0);
    double farthest = 0.0;
    for (unsigned child = 0; child < 8; child++)
    {
        double at[3], centre[3];
        for (int axis = 0; axis < 3; axis++)
        {
            at[axis] =
                (double)place[axis] + ((child >> axis & 1u) ? ldexp(1.0, level) : 0.0) + middle;
        }
        cm_update_place(update, at, centre);
        x[child] = (float)centre[0];
        y[child] = (float)centre[1];
        z[child] = (float)centre[2];
        farthest = fmax(farthest, fabs(centre[0]) + fabs(centre[1]) + fabs(centre[2]));
    }
    cm_update_half(update, level, farthest, half);
    update->set->classify(&update->desk->view.table, 8, x, y, z, half, class_of, NULL);
}

/* Does a small map not fill a cube? Then misses are not counted for all of it. */
static int is_whole(const cm_octree *octree)
{
    return octree->options.levels >= CM_REGION_LEVEL;
}

static cm_status go_down(cm_update *update, uint32_t node, const uint32_t place[3], int level,
                         unsigned class_of, cm_ray_ends above)
{
    cm_octree *octree = update->octree;
    const cm_ray_ends ends = cm_ray_ends_in(above, place, level);
    const int has_ends = ends.first != ends.end;
    if (!has_ends && cm_update_is_left_out(update, class_of))
    {
        return CM_OK;
    }
    if (!has_ends && class_of == CM_CUBE_FREE && is_whole(octree))
    {
        return cm_update_list_miss(update, node);
    }
    if (level == CM_REGION_LEVEL)
    {
        const cm_node *at = &octree->node[node];
        if (!has_ends && at->kind == CM_NODE_LEAF &&
            !cm_update_may_change(update, place, at->value))
        {
            return CM_OK;
        }
        return cm_update_list_region(update, node, place);
    }
    if (!cm_node_divide(octree, node))
    {
        return CM_ERROR_MEMORY;
    }
    uint8_t classes[16];
    classify_eight(update, place, level - 1, classes);
    cm_status status = CM_OK;
    for (unsigned child = 0; status == CM_OK && child < 8; child++)
    {
        uint32_t below[3];
        for (int axis = 0; axis < 3; axis++)
        {
            below[axis] = place[axis] + ((child >> axis & 1u) << (level - 1));
        }
        status = go_down(update, octree->node[node].link + child, below, level - 1, classes[child],
                         ends);
    }
    return status;
}

/* ---- regions ---- */

static void update_regions(size_t first, size_t end, void *user)
{
    cm_update *update = user;
    for (size_t i = first; i < end; i++)
    {
        const cm_node *node = &update->octree->node[update->desk->list[i]];
        cm_update_region(update, update->octree->region[node->link]);
    }
}

/* What is even again needs no region. */
cm_status cm_update_close_regions(cm_update *update, cm_status status)
{
    cm_octree *octree = update->octree;
    status = status == CM_OK && update->failed ? CM_ERROR_MEMORY : status;
    for (size_t i = 0; i < update->desk->count; i++)
    {
        const cm_status closed = cm_node_close_even(octree, update->desk->list[i]);
        status = status == CM_OK ? closed : status;
    }
    return status;
}

uint64_t cm_update_listed_bytes(const cm_update *update)
{
    uint64_t bytes = 0;
    for (size_t i = 0; i < update->desk->count; i++)
    {
        bytes += cm_region_size(
            update->octree->region[update->octree->node[update->desk->list[i]].link]);
    }
    return bytes;
}

/* ---- views ---- */

/* To free a map of so many takes seconds a view and some hundred megabytes. */
#define LEVELS_IN_SECONDS 13

cm_status cm_update_check_reach(const cm_octree *octree, float greatest)
{
    const cm_octree_options *options = &octree->options;
    const int is_bounded = options->far > 0.0 || options->levels <= LEVELS_IN_SECONDS;
    return is_bounded || (double)greatest <= ldexp(options->edge, CM_OCTREE_LEVELS_MAX)
               ? CM_OK
               : CM_ERROR_RANGE;
}

static cm_status check_color(const cm_octree *octree, const cm_view *view)
{
    const cm_image *color = &view->color;
    if (color->data == NULL || !octree->options.color)
    {
        return CM_OK;
    }
    if (color->size != sizeof *color || color->width != view->depth.width ||
        color->height != view->depth.height)
    {
        return CM_ERROR_ARGUMENT;
    }
    return color->type == CM_PIXEL_U8 && color->channels >= 1 && color->channels <= 4
               ? CM_OK
               : CM_ERROR_RANGE;
}

static cm_status check_view(const cm_octree *octree, const cm_view *view)
{
    if (octree == NULL || view == NULL || view->size != sizeof *view || view->camera == NULL ||
        view->depth.data == NULL || view->depth.size != sizeof view->depth)
    {
        return CM_ERROR_ARGUMENT;
    }
    const cm_status status = cm_pose_check(&view->pose);
    return status != CM_OK ? status : check_color(octree, view);
}

static cm_status update_straight(cm_update *update, cm_pool *pool)
{
    cm_octree *octree = update->octree;
    const cm_camera_options *camera = cm_camera_describe(update->view->camera);
    cm_status status = cm_view_desk_fill(&update->desk->view, octree, update->view, pool);
    status = status == CM_OK ? cm_update_check_reach(octree, update->desk->view.greatest) : status;
    status = status == CM_OK
                 ? cm_ray_ends_find(&update->desk->view, octree, update->view, pool, &update->ends)
                 : status;
    if (status != CM_OK)
    {
        octree->step--;
        return status;
    }
    const double focal = 0.5 * (fabs(camera->fx) + fabs(camera->fy));
    update->pixel = octree->options.footprint / (focal * octree->options.edge);
    const double reach = fmin((double)update->desk->view.greatest, 1e9);
    cm_update_half(update, CM_BLOCK_LEVEL, reach, update->block_half);
    cm_update_half(update, CM_BLOCK_LEVEL + 1, reach, update->eight_half);
    cm_update_half(update, 2, reach, update->group_half);
    const uint32_t first[3] = {0, 0, 0};
    status = go_down(update, 0, first, octree->tree_level, CM_CUBE_PART, update->ends);
    cm_update_end_lists(update, status);
    const uint64_t before = cm_update_listed_bytes(update);
    if (status == CM_OK)
    {
        cm_pool_run(pool, update->desk->count, 1, update_regions, update);
    }
    octree->bytes += cm_update_listed_bytes(update) - before;
    return cm_update_close_regions(update, status);
}

cm_status cm_octree_update(cm_octree *octree, const cm_view *view, cm_pool *pool)
{
    cm_status status = check_view(octree, view);
    if (status != CM_OK)
    {
        return status;
    }
    cm_update_desk *desk = cm_update_desk_of(octree);
    cm_update *update = malloc(sizeof *update);
    size_t valid = 0;
    status = desk == NULL || update == NULL
                 ? CM_ERROR_MEMORY
                 : cm_view_desk_clean(&desk->view, octree, view, pool, &valid);
    if (status == CM_OK && (valid > 0 || octree->options.no_return_is_free))
    {
        cm_ray_index_forget(octree);
        octree->step++;
        octree->clock++;
        begin(update, octree, desk, view);
        if (update->has_color)
        {
            cm_view_desk_colors(&desk->view, octree, view, pool);
        }
        status = cm_camera_is_straight(cm_camera_describe(view->camera))
                     ? update_straight(update, pool)
                     : cm_update_round(update, pool);
        const cm_status trimmed = cm_pages_trim(octree);
        status = status != CM_OK ? status : trimmed;
    }
    free(update);
    return status;
}
