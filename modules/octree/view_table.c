/* SPDX-License-Identifier: MIT */
#include "view_table.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* Slopes of noisy images are taken over more pixels. */
#define APART 1
#define APART_WITH_NOISE 4

/* A voxel is no miss if anything nearer is seen this close to its centre, in edges: half its diagonal. Views of round cameras
 * take windows of 5 x 5 pixels, as many times one after the other as that needs for the nearest seen, but not more often. */
#define AROUND_EDGES 0.87
#define AROUND_MOST 4

/* So far behind a silhouette, in edges, the unseen side of the same body may cross voxels that reach over to it. */
#define HIDES_EDGES 8.0

/* Sigmas around a noisy measurement that are hit, and more of them in front that are not missed. */
#define HIT_SIGMAS 1.0
#define FRONT_SIGMAS 1.0

/* A surface bends where the depth of a pixel differs by so many edges from between its neighbours, or so many sigmas: four of the
 * difference, whose own sigma is sqrt(6). */
#define BEND_EDGES 0.1
#define BEND_SIGMAS 10.0

void cm_view_desk_clear(cm_view_desk *desk)
{
    free(desk->memory);
    free(desk->rule);
    free(desk->word);
    free(desk->windows);
    free(desk->packed);
    free(desk->gap);
    free(desk->kind);
    free(desk->is_taken);
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

#define IMAGES 8

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
    const size_t image = desk->stride * (desk->height + 3);
    desk->memory = malloc(IMAGES * image * sizeof *desk->memory);
    desk->rule = malloc(desk->stride * desk->height * sizeof *desk->rule);
    desk->word = malloc(desk->stride * desk->height * sizeof *desk->word);
    desk->packed =
        calloc((size_t)desk->width * desk->height + CM_OCTREE_SLACK, sizeof *desk->packed);
    desk->gap = malloc(desk->stride * desk->height * sizeof *desk->gap);
    desk->kind = malloc(desk->stride * desk->height);
    desk->is_taken = calloc(desk->stride / CM_BREAK_RUN, desk->height);
    if (desk->memory == NULL || desk->rule == NULL || desk->word == NULL || desk->packed == NULL ||
        desk->gap == NULL || desk->kind == NULL || desk->is_taken == NULL)
    {
        return 0;
    }
    float **const images[IMAGES] = {&desk->reach,    &desk->front,    &desk->back,
                                    &desk->least[0], &desk->least[1], &desk->most[0],
                                    &desk->most[1],  &desk->own_front};
    for (size_t i = 0; i < IMAGES; i++)
    {
        *images[i] = desk->memory + i * image + desk->stride + CM_OCTREE_SLACK;
    }
    /* cells of the second level are made after breaks have served */
    desk->near_front = desk->least[0];
    desk->near_back = desk->most[0];
    /* what is beside pictures joins everything */
    for (size_t i = 0; i < 3 * image; i++)
    {
        desk->memory[i] = NAN;
    }
    return 1;
}

static int take_windows(cm_view_desk *desk)
{
    size_t floats = CM_OCTREE_SLACK;
    int levels = 1;
    do
    {
        floats += 2 * (level_cells(desk->width, levels) * level_cells(desk->height, levels) +
                       CM_OCTREE_SLACK);
        levels++;
    } while (has_more_levels(desk, levels - 1));
    desk->windows = malloc(floats * sizeof *desk->windows);
    float *next = desk->windows;
    desk->table.levels = levels;
    for (int level = 1; desk->windows != NULL && level < levels; level++)
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

static cm_status desk_for(cm_view_desk *desk, uint32_t width, uint32_t height)
{
    if (desk->memory != NULL && desk->windows != NULL && desk->width == width &&
        desk->height == height)
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
    return CM_OK;
}

/* ---- from the view's picture to a clean image ---- */

typedef struct clean_work
{
    cm_view_desk *desk;
    const cm_view *view;
    const cm_depth_limits *limits;
    atomic_size_t valid;
    atomic_int status;
} clean_work;

static void clean_rows(size_t first, size_t end, void *user)
{
    clean_work *work = user;
    cm_image rows = work->view->depth;
    const ptrdiff_t apart =
        rows.pixel_stride != 0 ? rows.pixel_stride : (ptrdiff_t)cm_pixel_size(rows.type);
    rows.row_stride = rows.row_stride != 0 ? rows.row_stride : apart * (ptrdiff_t)rows.width;
    rows.data = (char *)rows.data + (ptrdiff_t)first * rows.row_stride;
    rows.height = (uint32_t)(end - first);
    cm_depth_count count = {.size = sizeof count};
    const cm_status status =
        cm_depth_clean(&rows, work->limits, 1, work->desk->packed + first * rows.width, &count);
    if (status != CM_OK)
    {
        atomic_store(&work->status, (int)status);
    }
    atomic_fetch_add(&work->valid, count.valid);
}

cm_status cm_view_desk_clean(cm_view_desk *desk, const cm_octree *octree, const cm_view *view,
                             cm_pool *pool, size_t *valid)
{
    const cm_camera_options *camera = cm_camera_describe(view->camera);
    if (view->depth.width != camera->width || view->depth.height != camera->height)
    {
        return CM_ERROR_ARGUMENT;
    }
    const cm_status status = desk_for(desk, camera->width, camera->height);
    if (status != CM_OK)
    {
        return status;
    }
    const cm_depth_limits limits = {
        .size = sizeof limits, .unit = view->depth_unit, .nearest = octree->options.near};
    clean_work work = {.desk = desk, .view = view, .limits = &limits};
    cm_pool_run(pool, camera->height, 64, clean_rows, &work);
    *valid = atomic_load(&work.valid);
    return (cm_status)atomic_load(&work.status);
}

int cm_view_desk_around(const cm_view_desk *desk, double focal_edges)
{
    float nearest = INFINITY;
    const size_t pixels = (size_t)desk->width * desk->height;
    for (size_t i = 0; i < pixels; i++)
    {
        nearest = desk->packed[i] < nearest ? desk->packed[i] : nearest;
    }
    const double around = ceil(0.5 * AROUND_EDGES * focal_edges / (double)nearest);
    return around < 1.0 ? 1 : around > AROUND_MOST ? AROUND_MOST : (int)around;
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

/* Rows that are made one after the other and forgotten soon, so that they stay near: a power of two of them. */
typedef struct row_ring
{
    float *rows;
    size_t stride;
    size_t mask;
    const float *beyond; /* of rows that the picture does not have */
    size_t height;
} row_ring;

static float *ring_row(const row_ring *ring, size_t row)
{
    return ring->rows + (row & ring->mask) * ring->stride;
}

static const float *ring_row_or_beyond(const row_ring *ring, ptrdiff_t row)
{
    return row < 0 || row >= (ptrdiff_t)ring->height ? ring->beyond : ring_row(ring, (size_t)row);
}

/* Bands of rows, each of one thread with rings of its own. */
typedef struct fill_work
{
    cm_view_desk *desk;
    const cm_octree_set *set;
    cm_rule_row row; /* what is the same of all */
    size_t bands;
    float first_column;
    double first_row;
    float *rings;        /* ring_floats each */
    cm_break_runs *runs; /* a list each */
    atomic_int failed;
} fill_work;

typedef struct fill_band
{
    const fill_work *work;
    row_ring inverse;
} fill_band;

/* A power of two above twice what rows are apart; six rows at least, which bounds take later. */
static size_t ring_length(const fill_work *work)
{
    return work->row.apart == APART ? 8 : 16;
}

/* A ring, and a row of what is beyond. */
static size_t ring_floats(const fill_work *work)
{
    return (ring_length(work) + 1) * work->desk->stride;
}

static row_ring make_ring(const fill_band *band, float **next, size_t rows, const float *beyond)
{
    const cm_view_desk *desk = band->work->desk;
    const row_ring ring = {*next + CM_OCTREE_SLACK, desk->stride, rows - 1, beyond, desk->height};
    *next += rows * desk->stride;
    return ring;
}

static void begin_band(fill_band *band, const fill_work *work, size_t index)
{
    float *next = work->rings + index * ring_floats(work);
    const float *const beyond = next + CM_OCTREE_SLACK;
    /* what is beside rows is never written again: nothing measured */
    for (size_t i = 0; i < ring_floats(work); i++)
    {
        next[i] = NAN;
    }
    next += work->desk->stride;
    band->work = work;
    band->inverse = make_ring(band, &next, ring_length(work), beyond);
}

static void invert_row(fill_band *band, size_t row)
{
    const cm_view_desk *desk = band->work->desk;
    band->work->set->invert(desk->width, desk->packed + row * desk->width,
                            ring_row(&band->inverse, row));
}

static void reach_row(fill_band *band, size_t row)
{
    const fill_work *work = band->work;
    cm_view_desk *desk = work->desk;
    const size_t first = row * desk->stride, padded = desk->stride - 2 * CM_OCTREE_SLACK;
    cm_rule_row at = work->row;
    at.depth = desk->packed + row * desk->width;
    at.at = ring_row(&band->inverse, row);
    at.above = ring_row_or_beyond(&band->inverse, (ptrdiff_t)row - (ptrdiff_t)at.apart);
    at.below = ring_row_or_beyond(&band->inverse, (ptrdiff_t)row + (ptrdiff_t)at.apart);
    at.column_place = work->first_column;
    at.row_place = (float)((double)row + work->first_row);
    work->set->reaches(padded, &at, desk->reach + first, desk->front + first, desk->back + first);
    work->set->bends(desk->width, &at, desk->kind + first);
    for (size_t i = desk->width; i < padded; i++)
    {
        desk->front[first + i] = desk->back[first + i] = NAN;
    }
    memset(desk->kind + first + desk->width, 0, desk->stride - desk->width);
}

/* Bands begin at even rows: cells of the first level are of two. */
static size_t band_begin(const fill_work *work, size_t index)
{
    const size_t pairs = (work->desk->height + 1) / 2, row = 2 * (pairs * index / work->bands);
    return row < work->desk->height ? row : work->desk->height;
}

static size_t behind(size_t row, size_t rows)
{
    return row > rows ? row - rows : 0;
}

static void reach_bands(size_t first, size_t end, void *user)
{
    const fill_work *work = user;
    const size_t height = work->desk->height, apart = work->row.apart;
    for (size_t index = first; index < end; index++)
    {
        fill_band band;
        begin_band(&band, work, index);
        const size_t to = band_begin(work, index + 1);
        size_t row = band_begin(work, index), inverted = behind(row, apart);
        for (; row < to; row++)
        {
            for (; inverted < height && inverted < row + apart + 1; inverted++)
            {
                invert_row(&band, inverted);
            }
            reach_row(&band, row);
        }
    }
}

static void break_bands(size_t first, size_t end, void *user)
{
    const fill_work *work = user;
    const cm_view_desk *desk = work->desk;
    for (size_t row = first; row < end; row++)
    {
        const size_t at = row * desk->stride;
        work->set->breaks(desk->width, desk->stride, desk->front + at, desk->back + at,
                          desk->kind + at);
    }
}

static void find_bands(size_t first, size_t end, void *user)
{
    fill_work *work = user;
    for (size_t index = first; index < end; index++)
    {
        if (!cm_breaks_find(work->desk, work->set, band_begin(work, index),
                            band_begin(work, index + 1), &work->runs[index]))
        {
            atomic_store(&work->failed, 1);
        }
    }
}

/* Bounds of two rows of pixels, and after them of what is beyond the picture. */
typedef struct bound_rows
{
    float *least[3];
    float *most[3];
} bound_rows;

/* The rings of a band have served. */
static bound_rows make_bounds(const fill_work *work, size_t index)
{
    const size_t stride = work->desk->stride;
    float *next = work->rings + index * ring_floats(work);
    bound_rows rows;
    for (size_t k = 0; k < 3; k++)
    {
        rows.least[k] = next + 2 * k * stride + CM_OCTREE_SLACK;
        rows.most[k] = rows.least[k] + stride;
        for (size_t i = 0; i < stride - CM_OCTREE_SLACK; i++)
        {
            rows.least[k][i] = INFINITY;
            rows.most[k][i] = -INFINITY;
        }
    }
    return rows;
}

/* Rules of two rows, and the cells of the first level that are theirs. */
static void rule_rows(const fill_work *work, size_t row, const bound_rows *bounds)
{
    cm_view_desk *desk = work->desk;
    const size_t to = row / 2 * desk->stride;
    const size_t second = row + 1 < desk->height ? 1 : 2;
    for (size_t k = 0; k < 2 && row + k < desk->height; k++)
    {
        const size_t at = (row + k) * desk->stride;
        work->set->rules(desk->width, desk->packed + (row + k) * desk->width, desk->reach + at,
                         desk->front + at, work->row.far, work->row.free_far, desk->rule + at,
                         bounds->least[k], bounds->most[k]);
    }
    const float *const leasts[2] = {bounds->least[0], bounds->least[second]};
    const float *const mosts[2] = {bounds->most[0], bounds->most[second]};
    work->set->halve(desk->table.level[1].width, leasts, mosts, desk->least[1] + to,
                     desk->most[1] + to);
}

static void rule_bands(size_t first, size_t end, void *user)
{
    const fill_work *work = user;
    for (size_t index = first; index < end; index++)
    {
        const size_t to = band_begin(work, index + 1);
        const bound_rows bounds = make_bounds(work, index);
        cm_breaks_heed(work->desk, &work->runs[index]);
        for (size_t row = band_begin(work, index); row < to; row += 2)
        {
            rule_rows(work, row, &bounds);
        }
        cm_breaks_gaps(work->desk, &work->runs[index]);
        free(work->runs[index].first);
    }
}

/* Of a table that is described. */
static void describe_rows(fill_work *work, const cm_octree *octree, const cm_view *view)
{
    const cm_octree_options *options = &octree->options;
    const cm_view_table *table = &work->desk->table;
    const cm_camera_options *camera = cm_camera_describe(view->camera);
    cm_rule_row *row = &work->row;
    const int is_noisy = options->noise > 0.0;
    row->apart = is_noisy ? APART_WITH_NOISE : APART;
    row->step = 1.0f / (float)row->apart;
    memcpy(row->focal, table->focal, sizeof row->focal);
    memcpy(row->axes, table->axes, sizeof row->axes);
    row->half = table->half;
    row->hit_aside = (float)CM_HIT_ASIDE;
    row->hit_more = (float)(CM_HIT_MORE * options->edge);
    row->front_aside = (float)CM_FRONT_ASIDE;
    row->front_more = (float)(CM_FRONT_MORE * options->edge);
    row->relative = (float)(HIT_SIGMAS * options->noise);
    row->most = (float)(CM_REACH_MOST * options->edge);
    row->front_relative = (float)(FRONT_SIGMAS * options->noise);
    row->far = options->far > 0.0 ? (float)options->far : INFINITY;
    row->free_far = options->no_return_is_free ? (float)options->far : NAN;
    work->first_column = (float)(camera->pixel_centre - camera->cx);
    work->first_row = camera->pixel_centre - camera->cy;
}

static void describe_table(cm_view_desk *desk, const cm_octree *octree, const cm_view *view)
{
    const cm_camera_options *camera = cm_camera_describe(view->camera);
    cm_view_table *table = &desk->table;
    table->width = desk->width;
    table->height = desk->height;
    table->stride = (uint32_t)desk->stride;
    table->focal[0] = (float)camera->fx;
    table->focal[1] = (float)camera->fy;
    table->centre[0] = (float)(camera->cx - camera->pixel_centre);
    table->centre[1] = (float)(camera->cy - camera->pixel_centre);
    table->near = (float)octree->options.near;
    table->half = (float)(0.5 * octree->options.edge);
    table->widest = fmaxf(fabsf(table->focal[0]), fabsf(table->focal[1]));
    for (int i = 0; i < 9; i++)
    {
        table->axes[i / 3][i % 3] = (float)view->pose.rotation.row[i / 3][i % 3];
    }
    table->rule = desk->rule;
    table->gap = desk->gap;
}

/* How far half a voxel reaches across the planes through the camera and the picture's borders: what is crossed by rays in the
 * picture is missed, even if its centre is not seen. */
static void describe_border(cm_view_table *table, double edge, const cm_pose *pose)
{
    const uint32_t size[2] = {table->width, table->height};
    for (int axis = 0; axis < 2; axis++)
    {
        for (int side = 0; side < 2; side++)
        {
            const double at = side == 0 ? -0.5 : size[axis] - 0.5;
            const double slope = (double)table->centre[axis] - at;
            double sum = 0.0;
            for (int i = 0; i < 3; i++)
            {
                sum += fabs((double)table->focal[axis] * pose->rotation.row[axis][i] +
                            slope * pose->rotation.row[2][i]);
            }
            table->beside[axis][side] = (float)(0.5 * edge * sum);
        }
    }
}

cm_status cm_view_desk_fill(cm_view_desk *desk, const cm_octree *octree, const cm_view *view,
                            cm_pool *pool)
{
    cm_status status = to_depth(desk, octree, view);
    if (status != CM_OK)
    {
        return status;
    }
    fill_work work = {.desk = desk, .set = octree->set, .bands = cm_pool_threads(pool)};
    describe_table(desk, octree, view);
    describe_rows(&work, octree, view);
    const float focal_edges = (float)octree->options.edge * desk->table.widest;
    desk->heed = (float)AROUND_EDGES * focal_edges;
    desk->hides = (float)(HIDES_EDGES * octree->options.edge);
    describe_border(&desk->table, octree->options.edge, &view->pose);
    work.row.bend = (float)(BEND_EDGES * octree->options.edge);
    work.row.bend_relative = (float)(BEND_SIGMAS * octree->options.noise);
    const size_t pairs = (desk->height + 1) / 2;
    work.bands = work.bands < pairs ? work.bands : pairs;
    work.rings = malloc(work.bands * ring_floats(&work) * sizeof *work.rings);
    work.runs = calloc(work.bands, sizeof *work.runs);
    if (work.rings == NULL || work.runs == NULL)
    {
        free(work.rings);
        free(work.runs);
        return CM_ERROR_MEMORY;
    }
    cm_pool_run(pool, work.bands, 1, reach_bands, &work);
    cm_pool_run(pool, desk->height, 16, break_bands, &work);
    cm_pool_run(pool, work.bands, 1, find_bands, &work);
    cm_pool_run(pool, work.bands, 1, rule_bands, &work);
    free(work.rings);
    free(work.runs);
    if (atomic_load(&work.failed))
    {
        return CM_ERROR_MEMORY;
    }
    cm_view_desk_windows(desk, octree->set, pool);
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
    const ptrdiff_t apart =
        color->pixel_stride != 0 ? color->pixel_stride : (ptrdiff_t)color->channels;
    const ptrdiff_t stride =
        color->row_stride != 0 ? color->row_stride : (ptrdiff_t)color->width * apart;
    for (size_t row = first; row < end; row++)
    {
        const uint8_t *rgb = (const uint8_t *)color->data + (ptrdiff_t)row * stride;
        work->set->words(color->width, rgb, apart, work->desk->word + row * work->desk->stride);
    }
}

void cm_view_desk_colors(cm_view_desk *desk, const cm_octree *octree, const cm_view *view,
                         cm_pool *pool)
{
    color_work work = {desk, octree->set, &view->color};
    cm_pool_run(pool, desk->height, 16, color_rows, &work);
}
