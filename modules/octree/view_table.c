/* SPDX-License-Identifier: MIT */
#include "view_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Slopes of noisy images are taken over more pixels. */
#define APART 1
#define APART_WITH_NOISE 4

/* How far a hit reaches along a ray at most, in edges: on a grazing surface the tangent plane would let it go on. */
#define REACH_MOST 8.0

/* Beyond half the edges that a plane crosses, in edges: pixels are not where the voxel's centre is. */
#define REACH_MORE 0.25

/* Sigmas around a noisy measurement that are hit, and more of them in front that are not missed. */
#define HIT_SIGMAS 1.0
#define FRONT_SIGMAS 1.0

#define ROWS_BESIDE APART_WITH_NOISE

void cm_view_desk_clear(cm_view_desk *desk)
{
    free(desk->memory);
    free(desk->rule);
    free(desk->word);
    free(desk->windows);
    free(desk->packed);
    cm_rays_destroy(desk->rays);
    memset(desk, 0, sizeof *desk);
}

int cm_camera_is_straight(const cm_camera_options *camera)
{
    int is_straight = camera->mapping == NULL;
    for (size_t i = 0; i < sizeof camera->distortion / sizeof *camera->distortion; i++)
    {
        is_straight &= camera->distortion[i] == 0.0;
    }
    return is_straight;
}

/* ---- memory ---- */

#define IMAGES 9

static size_t level_cells(uint32_t pixels, int level)
{
    return (size_t)(((uint64_t)pixels + (1u << level) - 1) >> level);
}

static int has_more_levels(const cm_view_desk *desk, int level)
{
    return level_cells(desk->width, level) > 2 || level_cells(desk->height, level) > 2;
}

static int take_images(cm_view_desk *desk)
{
    const size_t image = desk->stride * (desk->height + 2 * ROWS_BESIDE);
    desk->memory = malloc(IMAGES * image * sizeof *desk->memory);
    desk->rule = malloc(desk->stride * desk->height * sizeof *desk->rule);
    desk->word = malloc(desk->stride * desk->height * sizeof *desk->word);
    desk->packed = malloc((size_t)desk->width * desk->height * sizeof *desk->packed);
    if (desk->memory == NULL || desk->rule == NULL || desk->word == NULL || desk->packed == NULL)
    {
        return 0;
    }
    float **const images[IMAGES] = {&desk->depth,    &desk->inverse, &desk->reach,
                                    &desk->front,    &desk->five,    &desk->least[0],
                                    &desk->least[1], &desk->most[0], &desk->most[1]};
    for (size_t i = 0; i < IMAGES; i++)
    {
        *images[i] = desk->memory + i * image + ROWS_BESIDE * desk->stride + CM_OCTREE_SLACK;
    }
    return 1;
}

static int take_windows(cm_view_desk *desk)
{
    size_t floats = CM_OCTREE_SLACK;
    int levels = 0;
    do
    {
        floats += 2 * (level_cells(desk->width, levels) * level_cells(desk->height, levels) + CM_OCTREE_SLACK);
        levels++;
    } while (has_more_levels(desk, levels - 1));
    desk->windows = malloc(floats * sizeof *desk->windows);
    float *next = desk->windows;
    desk->table.levels = levels;
    for (int level = 0; desk->windows != NULL && level < levels; level++)
    {
        cm_window_level *at = &desk->table.level[level];
        at->width = (uint32_t)level_cells(desk->width, level);
        at->height = (uint32_t)level_cells(desk->height, level);
        const size_t cells = (size_t)at->width * at->height + CM_OCTREE_SLACK;
        at->least = next;
        at->most = next + cells;
        next += 2 * cells;
    }
    return desk->windows != NULL;
}

/* Around images nothing is measured, nothing in front and nothing to be hit. */
static void fill_around(const cm_view_desk *desk, float *image, float value)
{
    const size_t beside = (size_t)ROWS_BESIDE * desk->stride + CM_OCTREE_SLACK;
    float *first = image - beside;
    const size_t all = desk->stride * (desk->height + 2 * ROWS_BESIDE);
    for (size_t i = 0; i < all; i++)
    {
        first[i] = value;
    }
}

static cm_status desk_for(cm_view_desk *desk, uint32_t width, uint32_t height)
{
    if (desk->memory != NULL && desk->windows != NULL && desk->width == width && desk->height == height)
    {
        return CM_OK;
    }
    cm_view_desk_clear(desk);
    desk->width = width;
    desk->height = height;
    desk->stride = ((size_t)width + 15) / 16 * 16 + 2 * CM_OCTREE_SLACK;
    if (!take_images(desk) || !take_windows(desk))
    {
        cm_view_desk_clear(desk);
        return CM_ERROR_MEMORY;
    }
    fill_around(desk, desk->depth, NAN);
    fill_around(desk, desk->inverse, NAN);
    fill_around(desk, desk->reach, -1.0f);
    fill_around(desk, desk->front, INFINITY);
    fill_around(desk, desk->five, INFINITY);
    return CM_OK;
}

/* ---- from the view's picture to a clean image ---- */

cm_status cm_view_desk_clean(cm_view_desk *desk, const cm_octree *octree, const cm_view *view, size_t *valid)
{
    const cm_camera_options *camera = cm_camera_describe(view->camera);
    if (view->depth.width != camera->width || view->depth.height != camera->height)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = desk_for(desk, camera->width, camera->height);
    const cm_depth_limits limits = {
        .size = sizeof limits, .unit = view->depth_unit, .nearest = octree->options.near};
    cm_depth_count count = {.size = sizeof count};
    if (status == CM_OK)
    {
        status = cm_depth_clean(&view->depth, &limits, 1, desk->packed, &count);
    }
    *valid = count.valid;
    return status;
}

/* Depth of what is range, by the rays of the camera. */
static cm_status to_depth(cm_view_desk *desk, const cm_octree *octree, const cm_view *view)
{
    if (!view->depth_is_range)
    {
        return CM_OK;
    }
    cm_rays *rays = NULL;
    cm_status status = cm_rays_create(view->camera, octree->set->name, &rays);
    if (status == CM_OK)
    {
        status = cm_depth_from_range(rays, desk->packed, 1, desk->packed);
    }
    cm_rays_destroy(rays);
    return status;
}

/* ---- rules ---- */

typedef struct fill_work
{
    cm_view_desk *desk;
    const cm_octree_set *set;
    cm_rule_row row; /* what is the same of all */
    float free_far;
    double first_column;
    double first_row;
} fill_work;

static void invert_rows(size_t first, size_t end, void *user)
{
    const fill_work *work = user;
    cm_view_desk *desk = work->desk;
    for (size_t row = first; row < end; row++)
    {
        float *depth = desk->depth + row * desk->stride;
        memcpy(depth, desk->packed + row * desk->width, desk->width * sizeof *depth);
        work->set->invert(desk->stride - 2 * CM_OCTREE_SLACK, depth, desk->inverse + row * desk->stride);
    }
}

static void reach_rows(size_t first, size_t end, void *user)
{
    const fill_work *work = user;
    cm_view_desk *desk = work->desk;
    const size_t padded = desk->stride - 2 * CM_OCTREE_SLACK;
    for (size_t row = first; row < end; row++)
    {
        cm_rule_row at = work->row;
        at.depth = desk->depth + row * desk->stride;
        at.at = desk->inverse + row * desk->stride;
        at.above = at.at - (ptrdiff_t)at.apart * (ptrdiff_t)desk->stride;
        at.below = at.at + (size_t)at.apart * desk->stride;
        at.column_place = (float)work->first_column;
        at.row_place = (float)((double)row + work->first_row);
        work->set->reaches(padded, &at, desk->reach + row * desk->stride, desk->front + row * desk->stride);
    }
}

/* The least of 5 x 5 is that of five rows, then of five columns. */
static void rule_rows(size_t first, size_t end, void *user)
{
    const fill_work *work = user;
    cm_view_desk *desk = work->desk;
    const size_t padded = desk->stride - 2 * CM_OCTREE_SLACK;
    const ptrdiff_t stride = (ptrdiff_t)desk->stride;
    for (size_t row = first; row < end; row++)
    {
        const size_t at = row * desk->stride;
        const float *front = desk->front + at;
        float *five = desk->five + at;
        const float *rows[5];
        const float *columns[5];
        for (ptrdiff_t i = 0; i < 5; i++)
        {
            rows[i] = front + (i - 2) * stride;
            columns[i] = five + i - 2;
        }
        work->set->least_of_five(padded, rows, five);
        work->set->least_of_five(padded, columns, desk->least[1] + at);
        work->set->rules(desk->width, desk->depth + at, desk->reach + at, desk->least[1] + at, work->row.far,
                         work->free_far, desk->rule + at, desk->least[0] + at, desk->most[0] + at);
    }
}

static void describe_rows(fill_work *work, const cm_octree *octree, const cm_view *view)
{
    const cm_octree_options *options = &octree->options;
    const cm_camera_options *camera = cm_camera_describe(view->camera);
    cm_rule_row *row = &work->row;
    const int is_noisy = options->noise > 0.0;
    row->apart = is_noisy ? APART_WITH_NOISE : APART;
    row->step = 1.0f / (float)row->apart;
    row->focal[0] = (float)camera->fx;
    row->focal[1] = (float)camera->fy;
    for (int i = 0; i < 9; i++)
    {
        row->axes[i / 3][i % 3] = (float)view->pose.rotation.row[i / 3][i % 3];
    }
    row->half = (float)(0.5 * options->edge);
    row->more = (float)(REACH_MORE * options->edge);
    row->relative = (float)(HIT_SIGMAS * options->noise);
    row->most = (float)(REACH_MOST * options->edge);
    row->front_relative = (float)(FRONT_SIGMAS * options->noise);
    row->far = options->far > 0.0 ? (float)options->far : INFINITY;
    work->free_far = options->no_return_is_free ? (float)options->far : NAN;
    work->first_column = camera->pixel_centre - camera->cx;
    work->first_row = camera->pixel_centre - camera->cy;
}

static void describe_table(cm_view_desk *desk, const cm_octree *octree, const cm_camera_options *camera)
{
    cm_view_table *table = &desk->table;
    table->width = desk->width;
    table->height = desk->height;
    table->stride = (uint32_t)desk->stride;
    table->focal[0] = (float)camera->fx;
    table->focal[1] = (float)camera->fy;
    table->centre[0] = (float)(camera->cx - camera->pixel_centre);
    table->centre[1] = (float)(camera->cy - camera->pixel_centre);
    table->near = (float)octree->options.near;
    table->rule = desk->rule;
}

cm_status cm_view_desk_fill(cm_view_desk *desk, const cm_octree *octree, const cm_view *view, cm_pool *pool)
{
    cm_status status = to_depth(desk, octree, view);
    if (status != CM_OK)
    {
        return status;
    }
    fill_work work = {.desk = desk, .set = octree->set};
    describe_rows(&work, octree, view);
    describe_table(desk, octree, cm_camera_describe(view->camera));
    cm_pool_run(pool, desk->height, 16, invert_rows, &work);
    cm_pool_run(pool, desk->height, 16, reach_rows, &work);
    cm_pool_run(pool, desk->height, 16, rule_rows, &work);
    cm_view_desk_windows(desk, octree->set);
    return CM_OK;
}

/* ---- colors ---- */

typedef struct color_work
{
    cm_view_desk *desk;
    const cm_octree_set *set;
    const cm_image *color;
} color_work;

static void color_rows(size_t first, size_t end, void *user)
{
    const color_work *work = user;
    const cm_image *color = work->color;
    const ptrdiff_t apart = color->pixel_stride != 0 ? color->pixel_stride : (ptrdiff_t)color->channels;
    const ptrdiff_t stride = color->row_stride != 0 ? color->row_stride : (ptrdiff_t)color->width * apart;
    for (size_t row = first; row < end; row++)
    {
        const uint8_t *rgb = (const uint8_t *)color->data + (ptrdiff_t)row * stride;
        work->set->words(color->width, rgb, apart, work->desk->word + row * work->desk->stride);
    }
}

void cm_view_desk_colors(cm_view_desk *desk, const cm_octree *octree, const cm_view *view, cm_pool *pool)
{
    color_work work = {desk, octree->set, &view->color};
    cm_pool_run(pool, desk->height, 16, color_rows, &work);
}

/* ---- windows ---- */

/* One cell more to the right and below, where nothing is: windows there are of what there is. */
static void close_cells(cm_view_desk *desk, int which, size_t width, size_t height)
{
    float *least = desk->least[which], *most = desk->most[which];
    for (size_t row = 0; row < height; row++)
    {
        for (size_t i = width; i < width + CM_OCTREE_SLACK; i++)
        {
            least[row * desk->stride + i] = INFINITY;
            most[row * desk->stride + i] = -INFINITY;
        }
    }
    for (size_t i = 0; i < width + CM_OCTREE_SLACK; i++)
    {
        least[height * desk->stride + i] = INFINITY;
        most[height * desk->stride + i] = -INFINITY;
    }
}

static void make_windows(cm_view_desk *desk, const cm_octree_set *set, int level)
{
    cm_window_level *at = &desk->table.level[level];
    const int which = level & 1;
    for (size_t row = 0; row < at->height; row++)
    {
        const float *least = desk->least[which] + row * desk->stride;
        const float *most = desk->most[which] + row * desk->stride;
        const float *const leasts[2] = {least, least + desk->stride};
        const float *const mosts[2] = {most, most + desk->stride};
        set->windows(at->width, leasts, mosts, at->least + row * at->width, at->most + row * at->width);
    }
}

static void make_cells(cm_view_desk *desk, const cm_octree_set *set, int level)
{
    const cm_window_level *at = &desk->table.level[level];
    const int from = (level - 1) & 1, to = level & 1;
    for (size_t row = 0; row < at->height; row++)
    {
        const float *least = desk->least[from] + 2 * row * desk->stride;
        const float *most = desk->most[from] + 2 * row * desk->stride;
        const float *const leasts[2] = {least, least + desk->stride};
        const float *const mosts[2] = {most, most + desk->stride};
        set->halve(at->width, leasts, mosts, desk->least[to] + row * desk->stride,
                   desk->most[to] + row * desk->stride);
    }
}

void cm_view_desk_windows(cm_view_desk *desk, const cm_octree_set *set)
{
    close_cells(desk, 0, desk->width, desk->height);
    make_windows(desk, set, 0);
    for (int level = 1; level < desk->table.levels; level++)
    {
        const cm_window_level *at = &desk->table.level[level];
        make_cells(desk, set, level);
        close_cells(desk, level & 1, at->width, at->height);
        make_windows(desk, set, level);
    }
    const cm_window_level *last = &desk->table.level[desk->table.levels - 1];
    desk->greatest = last->most[0];
}
