/* SPDX-License-Identifier: MIT
 *
 * Views of lenses and of whole surroundings: cubes are compared with cones around tiles of pixels, and voxels are asked of the camera
 * one by one. What a pixel says of a voxel is as for straight cameras, but that pixels beside its own are asked only for the least of
 * their fronts.
 */
#include "update_round.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "interleave.h"

typedef struct round_work
{
    cm_update *update;
    cm_round_desk *round;
} round_work;

static void clear_round(cm_round_desk *round)
{
    cm_pixel_tree_clear(&round->tree);
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
    round->memory = malloc(own * pixels * sizeof *round->memory);
    round->rule = malloc(pixels * sizeof *round->rule);
    if (round->memory == NULL || round->rule == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    for (size_t i = 0; i < own; i++)
    {
        *images[i] = round->memory + i * pixels;
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
    const cm_status status = cm_pixel_tree_make(camera, &round->tree);
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

/* The class of a cube of 2^level voxels at a place. */
static unsigned class_of_cube(const round_work *work, const uint32_t place[3], int level)
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

/* ---- voxels ---- */

static void cell_centres(const cm_update *update, const uint32_t place[3], unsigned detail,
                         size_t cells, double *x, double *y, double *z)
{
    const double half = 0.5 * ((1u << detail) - 1u);
    for (size_t cell = 0; cell < cells; cell++)
    {
        unsigned in[3];
        cm_divide_3((unsigned)cell << 3 * detail, in);
        const double at[3] = {place[0] + in[0] + half, place[1] + in[1] + half,
                              place[2] + in[2] + half};
        double centre[3];
        cm_update_place(update, at, centre);
        x[cell] = centre[0];
        y[cell] = centre[1];
        z[cell] = centre[2];
    }
}

/* What pixels say of the cells whose centres fall on them, and which pixels hit. */
static void ask_pixels(const round_work *work, const uint32_t place[3], cm_block_change *change)
{
    const cm_round_desk *round = work->round;
    const size_t cells = cm_cell_count(change->detail), width = round->tree.width;
    const double near = work->update->octree->options.near;
    const float scale = (float)(1u << change->detail);
    double x[512] = {0}, y[512] = {0}, z[512] = {0}, column[512], row[512];
    cell_centres(work->update, place, change->detail, cells, x, y, z);
    cm_camera_project_array(work->update->view->camera, cells, x, y, z, column, row);
    for (size_t cell = 0; cell < cells; cell++)
    {
        const double value = cm_round_value(round, (const double[3]){x[cell], y[cell], z[cell]});
        const size_t pixel = cm_round_pixel(round, column[cell], row[cell]);
        if (pixel == SIZE_MAX || !(value > near))
        {
            continue;
        }
        const int word = cm_round_word(&round->rule[pixel], (float)value, scale);
        if (word > 0)
        {
            change->pixel[cell / 64][cell % 64] =
                (int32_t)(pixel / width * work->update->desk->view.stride + pixel % width);
        }
        change->hits[cell / 64] |= (uint64_t)(word > 0) << cell % 64;
        change->misses[cell / 64] |= (uint64_t)(word < 0) << cell % 64;
    }
}

static void visit_block(round_work *work, cm_region *region, unsigned block,
                        const uint32_t place[3], unsigned detail, cm_ray_ends ends)
{
    cm_update *update = work->update;
    cm_block_change change;
    memset(&change, 0, sizeof change);
    change.detail = detail;
    ask_pixels(work, place, &change);
    if (detail == 0) /* coarser cells are large enough for their own pixel */
    {
        cm_ray_ends_hit(ends, change.hits, change.pixel);
    }
    uint64_t any = 0;
    for (unsigned group = 0; group < 8; group++)
    {
        const uint64_t valid = cm_update_valid(update->octree, region, block, detail, group);
        change.hits[group] &= valid;
        change.misses[group] &=
            update->octree->options.endpoints_only ? 0 : valid & ~change.hits[group];
        any |= change.hits[group] | change.misses[group];
    }
    if (any != 0 && !cm_update_block(update, region, block, &change))
    {
        update->failed = 1;
    }
}

static unsigned detail_of(const round_work *work, cm_region *region, unsigned block,
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

static void update_region(round_work *work, cm_region *region)
{
    cm_ray_ends ends = cm_ray_ends_in(work->update->ends, region->place, CM_REGION_LEVEL);
    for (unsigned block = 0; block < CM_REGION_BLOCKS; block++)
    {
        unsigned in[3];
        cm_divide_3(block, in);
        const uint32_t place[3] = {region->place[0] + 8 * in[0], region->place[1] + 8 * in[1],
                                   region->place[2] + 8 * in[2]};
        const cm_ray_ends here = cm_ray_ends_take_block(&ends, block);
        const unsigned class_of = here.first != here.end
                                      ? (unsigned)CM_CUBE_PART
                                      : class_of_cube(work, place, CM_BLOCK_LEVEL);
        if (cm_update_is_left_out(work->update, class_of))
        {
            continue;
        }
        if (class_of == CM_CUBE_FREE &&
            cm_update_valid(work->update->octree, region, block, 0, 0) == UINT64_MAX &&
            cm_update_valid(work->update->octree, region, block, 0, 7) == UINT64_MAX)
        {
            cm_update_free_block(work->update, region, block);
        }
        else
        {
            visit_block(work, region, block, place, detail_of(work, region, block, place), here);
        }
    }
    region->is_dirty = 1;
}

static void update_regions(size_t first, size_t end, void *user)
{
    round_work *work = user;
    const cm_octree *octree = work->update->octree;
    for (size_t i = first; i < end; i++)
    {
        update_region(work, octree->region[octree->node[work->update->desk->list[i]].link]);
    }
}

/* ---- the tree ---- */

static cm_status go_down(round_work *work, uint32_t node, const uint32_t place[3], int level,
                         cm_ray_ends above)
{
    cm_octree *octree = work->update->octree;
    const cm_ray_ends ends = cm_ray_ends_in(above, place, level);
    /* in what rays end in something may happen, wherever its centre is */
    const unsigned class_of =
        ends.first != ends.end ? (unsigned)CM_CUBE_PART : class_of_cube(work, place, level);
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
    round_work work = {.update = update};
    cm_status status = round_of(update, &work.round);
    status = status == CM_OK ? cm_round_rules_make(update, work.round, pool) : status;
    status = status == CM_OK ? cm_round_ends_find(update, work.round, pool, &update->ends) : status;
    if (status != CM_OK)
    {
        update->octree->step--;
        return status;
    }
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
    cm_update_close_regions(update);
    return status != CM_OK ? status : update->failed ? CM_ERROR_MEMORY : CM_OK;
}
