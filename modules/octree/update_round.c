/* SPDX-License-Identifier: MIT
 *
 * Views of lenses and of whole surroundings: cubes are compared with cones around tiles of pixels, and small ones in regions with
 * sides of a cube around the camera. What a pixel says of a voxel is as for straight cameras, but that pixels beside its own are asked only for the least of
 * their fronts.
 */
#include "modules/memory/checked_size.h"
#include "update_round.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void clear_round(cm_round_desk *round)
{
    cm_pixel_tree_clear(&round->tree);
    cm_round_faces_clear(&round->faces);
    cm_rays_destroy(round->rays);
    free(round->memory);
    free(round->rule);
    memset(round, 0, sizeof *round);
}

static void destroy_round(void *memory)
{
    if (memory != NULL)
    {
        clear_round(memory);
        free(memory);
    }
}

/* ---- the camera's cones, which stay from view to view ---- */

static int is_same_camera(const cm_round_desk *round, const cm_camera_options *camera)
{
    cm_camera_options other = *camera;
    other.mapping = NULL;
    /* mappings and their frames are told apart by rays of each face */
    return round->memory != NULL && round->is_range == (camera->mapping != NULL) &&
           memcmp(&round->camera, &other, sizeof other) == 0;
}

static int has_same_rays(const cm_round_desk *round, const cm_camera *camera)
{
    const cm_pixel_tree *tree = &round->tree;
    for (uint32_t face = 0; face < tree->faces; face++)
    {
        const uint32_t r = face * tree->face_rows + tree->face_rows / 3, c = tree->width / 4;
        const double column = c + round->camera.pixel_centre, row = r + round->camera.pixel_centre;
        double ray[3];
        cm_camera_ray_array(camera, 1, &column, &row, ray, ray + 1, ray + 2);
        const double length = sqrt(ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2]);
        for (int axis = 0; axis < 3; axis++)
        {
            const float now = (float)(ray[axis] / length);
            const float then = tree->ray[axis][(size_t)r * tree->width + c];
            if (memcmp(&now, &then, sizeof now) != 0)
            {
                return 0;
            }
        }
    }
    return 1;
}

/* A lens's rays at depth 1. */
static void take_rays(cm_round_desk *round, size_t pixels)
{
    for (size_t i = 0; i < pixels; i++)
    {
        const double along = (double)round->tree.ray[2][i];
        for (int axis = 0; axis < 3; axis++)
        {
            round->ray[axis][i] = (float)((double)round->tree.ray[axis][i] / along);
        }
    }
}

static cm_status take_round_images(cm_round_desk *round, size_t pixels)
{
    float **const images[] = {&round->reach,    &round->front,    &round->five,
                              &round->bound[0], &round->bound[1], &round->inverse,
                              &round->ray[0],   &round->ray[1],   &round->ray[2]};
    const size_t all = sizeof images / sizeof *images, own = round->is_range ? all - 3 : all;
    const size_t apart = pixels + 2 * CM_PIXEL_SLACK;
    const size_t floats =
        cm_size_sum(cm_size_product(own, apart), (size_t)round->tree.width + CM_PIXEL_SLACK);
    round->memory = cm_array_of(floats, sizeof *round->memory);
    round->rule = cm_array_of(pixels, sizeof *round->rule);
    if (round->memory == NULL || round->rule == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    for (size_t i = 0; i < floats; i++)
    {
        round->memory[i] = NAN;
    }
    round->none = round->memory + own * apart;
    for (size_t i = 0; i < own; i++)
    {
        *images[i] = round->memory + i * apart + CM_PIXEL_SLACK;
    }
    if (round->is_range)
    {
        memcpy(round->ray, round->tree.ray, sizeof round->ray);
        return CM_OK;
    }
    take_rays(round, pixels);
    return CM_OK;
}

static cm_status make_round(cm_round_desk *round, const cm_camera *camera)
{
    const cm_camera_options *options = cm_camera_describe(camera);
    const size_t pixels = (size_t)options->width * options->height;
    clear_round(round);
    round->camera = *options;
    round->camera.mapping = NULL;
    round->is_range = options->mapping != NULL;
    cm_status status = cm_pixel_tree_make(camera, &round->tree);
    status = status == CM_OK
                 ? cm_round_faces_make(&round->tree, cm_round_mean_pixel(options), &round->faces)
                 : status;
    return status == CM_OK ? take_round_images(round, pixels) : status;
}

static cm_status round_of(cm_update *update, cm_round_desk **round)
{
    cm_update_desk *desk = update->desk;
    if (desk->rounds == NULL)
    {
        desk->rounds = calloc(1, sizeof(cm_round_desk));
        desk->rounds_destroy = destroy_round;
    }
    if (desk->rounds == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    *round = desk->rounds;
    const cm_camera *camera = update->view->camera;
    if (is_same_camera(*round, cm_camera_describe(camera)) && has_same_rays(*round, camera))
    {
        return CM_OK;
    }
    const cm_status status = make_round(*round, camera);
    if (status != CM_OK)
    {
        clear_round(*round);
    }
    return status;
}

/* ---- cubes ---- */

unsigned cm_round_class_of(const cm_round_work *work, const uint32_t place[3], int level)
{
    const cm_update *update = work->update;
    const double middle = 0.5 * (ldexp(1.0, level) - 1.0), edge = update->octree->options.edge;
    double at[3], centre[3], square = 0.0;
    for (int axis = 0; axis < 3; axis++)
    {
        at[axis] = place[axis] + middle;
    }
    cm_update_place(update, at, centre);
    for (int axis = 0; axis < 3; axis++)
    {
        square += centre[axis] * centre[axis];
    }
    const double distance = sqrt(square);
    const double radius = middle * sqrt(3.0) * edge + 1e-4 * edge + 1e-6 * distance;
    double near = distance - radius, far = distance + radius;
    if (!work->round->is_range)
    {
        float half[3];
        cm_update_half(update, level, distance, half);
        near = centre[2] - (double)half[2];
        far = centre[2] + (double)half[2];
    }
    if (far <= update->octree->options.near || (!work->round->is_range && far <= 0.0))
    {
        return CM_CUBE_OUTSIDE;
    }
    if (distance <= radius)
    {
        return CM_CUBE_PART;
    }
    const double sine = radius / distance;
    const float axis[3] = {(float)(centre[0] / distance), (float)(centre[1] / distance),
                           (float)(centre[2] / distance)};
    const cm_cone_bounds bounds =
        cm_pixel_tree_ask(&work->round->tree, axis, (float)sqrt(1.0 - sine * sine), (float)sine);
    if (bounds.is_empty || near > (double)bounds.most)
    {
        return CM_CUBE_OUTSIDE; /* also most of what the plane through a lens cuts */
    }
    return near > update->octree->options.near && !bounds.is_border && far < (double)bounds.least
               ? CM_CUBE_FREE
               : CM_CUBE_PART;
}

/* ---- regions ---- */

static void update_regions(size_t first, size_t end, void *user)
{
    cm_round_work *work = user;
    const cm_octree *octree = work->update->octree;
    for (size_t i = first; i < end; i++)
    {
        cm_round_region(work, octree->region[octree->node[work->update->desk->list[i]].link]);
    }
}

/* ---- the tree ---- */

static cm_status go_down(cm_round_work *work, uint32_t node, const uint32_t place[3], int level,
                         cm_ray_ends above)
{
    cm_octree *octree = work->update->octree;
    const cm_ray_ends ends = cm_ray_ends_in(above, place, level);
    /* in what rays end in something may happen, wherever its centre is */
    const unsigned class_of =
        ends.first != ends.end ? (unsigned)CM_CUBE_PART : cm_round_class_of(work, place, level);
    if (cm_update_is_left_out(work->update, class_of))
    {
        return CM_OK;
    }
    if (class_of == CM_CUBE_FREE && octree->options.levels >= CM_REGION_LEVEL)
    {
        return cm_update_list_miss(work->update, node);
    }
    if (level == CM_REGION_LEVEL)
    {
        return cm_update_list_region(work->update, node, place);
    }
    if (!cm_node_divide(octree, node))
    {
        return CM_ERROR_MEMORY;
    }
    cm_status status = CM_OK;
    for (unsigned child = 0; status == CM_OK && child < 8; child++)
    {
        uint32_t below[3];
        for (int axis = 0; axis < 3; axis++)
        {
            below[axis] = place[axis] + ((child >> axis & 1u) << (level - 1));
        }
        status = go_down(work, octree->node[node].link + child, below, level - 1, ends);
    }
    return status;
}

cm_status cm_update_round(cm_update *update, cm_pool *pool)
{
    const cm_octree_options *options = &update->octree->options;
    const cm_camera_options *camera = cm_camera_describe(update->view->camera);
    cm_round_work work = {.update = update};
    cm_status status = round_of(update, &work.round);
    status = status == CM_OK ? cm_round_rules_make(update, work.round, pool) : status;
    status = status == CM_OK ? cm_update_check_reach(update->octree, work.round->faces.greatest)
                             : status;
    status = status == CM_OK ? cm_round_ends_find(update, work.round, pool, &update->ends) : status;
    if (status != CM_OK)
    {
        update->octree->step--;
        return status;
    }
    const double reach = fmin(fmax((double)work.round->faces.greatest, 0.0), 1e9);
    cm_update_half(update, CM_BLOCK_LEVEL, reach, update->block_half);
    cm_update_half(update, CM_BLOCK_LEVEL + 1, reach, update->eight_half);
    cm_update_half(update, 2, reach, update->group_half);
    update->pixel = options->footprint * cm_round_mean_pixel(camera) / options->edge;
    const uint32_t first[3] = {0, 0, 0};
    status = go_down(&work, 0, first, update->octree->tree_level, update->ends);
    cm_update_end_lists(update, status);
    const uint64_t before = cm_update_listed_bytes(update);
    if (status == CM_OK)
    {
        cm_pool_run(pool, update->desk->count, 1, update_regions, &work);
    }
    update->octree->bytes += cm_update_listed_bytes(update) - before;
    return cm_update_close_regions(update, status);
}
