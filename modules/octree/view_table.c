/* SPDX-License-Identifier: MIT */
#include "view_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Slopes of noisy images are taken over more pixels. */
#define APART 1
#define APART_WITH_NOISE 4

/* A voxel is no miss if anything nearer is seen this close to its centre, in edges: half its diagonal. Least fronts are taken over
 * windows of 5 x 5 pixels, as many times one after the other as that needs for the nearest that is seen, but not more often. */
#define AROUND_EDGES 0.87
#define AROUND_MOST 4

/* Sigmas around a noisy measurement that are hit, and more of them in front that are not missed. */
#define HIT_SIGMAS 1.0
#define FRONT_SIGMAS 1.0

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

#define IMAGES 4

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
    const size_t image = desk->stride * (desk->height + 2);
    desk->memory = malloc(IMAGES * image * sizeof *desk->memory);
    desk->rule = malloc(desk->stride * desk->height * sizeof *desk->rule);
    desk->word = malloc(desk->stride * desk->height * sizeof *desk->word);
    desk->packed = malloc((size_t)desk->width * desk->height * sizeof *desk->packed);
    if (desk->memory == NULL || desk->rule == NULL || desk->word == NULL || desk->packed == NULL)
    {
        return 0;
    }
    float **const images[IMAGES] = {&desk->least[0], &desk->least[1], &desk->most[0],
                                    &desk->most[1]};
    for (size_t i = 0; i < IMAGES; i++)
    {
        *images[i] = desk->memory + i * image + CM_OCTREE_SLACK;
    }
    return 1;
}

static int take_windows(cm_view_desk *desk)
{
    size_t floats = CM_OCTREE_SLACK;
    int levels = 0;
    do
    {
        floats += 2 * (level_cells(desk->width, levels) * level_cells(desk->height, levels) +
                       CM_OCTREE_SLACK);
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

cm_status cm_view_desk_clean(cm_view_desk *desk, const cm_octree *octree, const cm_view *view,
                             size_t *valid)
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
    float free_far;
    double first_column;
    double first_row;
    size_t bands;
    float *rings; /* ring_floats each */
} fill_work;

typedef struct fill_band
{
    const fill_work *work;
    row_ring depth, inverse, reach, front;
    float *five, *columns;
} fill_band;

static size_t ring_length(const fill_work *work)
{
    return work->row.apart == APART ? 4 : 16;
}

static size_t front_length(const fill_work *work)
{
    return work->desk->around == 1 ? 8 : 32;
}

/* Rings, rows of what is beyond, and two rows for the least of five. */
static size_t ring_floats(const fill_work *work)
{
    return (2 * ring_length(work) + 2 * front_length(work) + 4) * work->desk->stride;
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
    const size_t stride = work->desk->stride, length = ring_length(work),
                 fronts = front_length(work);
    float *next = work->rings + index * ring_floats(work);
    float *no_inverse = next, *no_front = next + stride;
    for (size_t i = 0; i < stride; i++)
    {
        no_inverse[i] = NAN;
        no_front[i] = INFINITY;
    }
    next += 2 * stride;
    /* what is beside rows is never written again: nothing measured, nothing in front */
    for (size_t i = 0; i < 2 * length * stride; i++)
    {
        next[i] = NAN;
    }
    for (size_t i = 2 * length * stride; i < (2 * length + 2 * fronts + 2) * stride; i++)
    {
        next[i] = INFINITY;
    }
    band->work = work;
    band->depth = make_ring(band, &next, length, no_inverse + CM_OCTREE_SLACK);
    band->inverse = make_ring(band, &next, length, no_inverse + CM_OCTREE_SLACK);
    band->reach = make_ring(band, &next, fronts, no_front + CM_OCTREE_SLACK);
    band->front = make_ring(band, &next, fronts, no_front + CM_OCTREE_SLACK);
    band->five = next + CM_OCTREE_SLACK;
    band->columns = next + stride + CM_OCTREE_SLACK;
}

static void invert_row(fill_band *band, size_t row)
{
    const cm_view_desk *desk = band->work->desk;
    float *depth = ring_row(&band->depth, row);
    memcpy(depth, desk->packed + row * desk->width, desk->width * sizeof *depth);
    band->work->set->invert(desk->stride - 2 * CM_OCTREE_SLACK, depth,
                            ring_row(&band->inverse, row));
}

static void reach_row(fill_band *band, size_t row)
{
    const fill_work *work = band->work;
    cm_rule_row at = work->row;
    at.depth = ring_row(&band->depth, row);
    at.at = ring_row(&band->inverse, row);
    at.above = ring_row_or_beyond(&band->inverse, (ptrdiff_t)row - (ptrdiff_t)at.apart);
    at.below = ring_row_or_beyond(&band->inverse, (ptrdiff_t)row + (ptrdiff_t)at.apart);
    at.column_place = (float)work->first_column;
    at.row_place = (float)((double)row + work->first_row);
    work->set->reaches(work->desk->stride - 2 * CM_OCTREE_SLACK, &at, ring_row(&band->reach, row),
                       ring_row(&band->front, row));
}

/* The least front around: of rows, four more at a time, then of columns. */
static float *least_around(fill_band *band, size_t row)
{
    const cm_octree_set *set = band->work->set;
    const size_t padded = band->work->desk->stride - 2 * CM_OCTREE_SLACK;
    const int around = band->work->desk->around;
    float *from = band->five, *to = band->columns;
    const float *five[5];
    ptrdiff_t next = (ptrdiff_t)row - 2 * around;
    for (int i = 0; i < 5; i++)
    {
        five[i] = ring_row_or_beyond(&band->front, next++);
    }
    set->least_of_five(padded, five, from);
    for (int more = 1; more < around; more++)
    {
        five[0] = from;
        for (int i = 1; i < 5; i++)
        {
            five[i] = ring_row_or_beyond(&band->front, next++);
        }
        set->least_of_five(padded, five, from);
    }
    for (int time = 0; time < around; time++)
    {
        for (ptrdiff_t i = 0; i < 5; i++)
        {
            five[i] = from + i - 2;
        }
        set->least_of_five(padded, five, to);
        float *const swapped = from;
        from = to;
        to = swapped;
    }
    return from;
}

static void rule_row(fill_band *band, size_t row)
{
    const fill_work *work = band->work;
    const cm_view_desk *desk = work->desk;
    const size_t at = row * desk->stride;
    work->set->rules(desk->width, desk->packed + row * desk->width, ring_row(&band->reach, row),
                     least_around(band, row), work->row.far, work->free_far, desk->rule + at,
                     desk->least[0] + at, desk->most[0] + at);
}

static size_t behind(size_t row, size_t rows)
{
    return row > rows ? row - rows : 0;
}

static void fill_bands(size_t first, size_t end, void *user)
{
    const fill_work *work = user;
    const size_t height = work->desk->height, apart = work->row.apart;
    const size_t beside = 2 * (size_t)work->desk->around;
    for (size_t index = first; index < end; index++)
    {
        fill_band band;
        begin_band(&band, work, index);
        const size_t from = height * index / work->bands, to = height * (index + 1) / work->bands;
        size_t inverted = behind(from, beside + apart), reached = behind(from, beside);
        for (size_t row = from; row < to; row++)
        {
            for (; reached < height && reached < row + beside + 1; reached++)
            {
                for (; inverted < height && inverted < reached + apart + 1; inverted++)
                {
                    invert_row(&band, inverted);
                }
                reach_row(&band, reached);
            }
            rule_row(&band, row);
        }
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
    row->more = (float)(CM_REACH_MORE * options->edge);
    row->relative = (float)(HIT_SIGMAS * options->noise);
    row->most = (float)(CM_REACH_MOST * options->edge);
    row->front_relative = (float)(FRONT_SIGMAS * options->noise);
    row->far = options->far > 0.0 ? (float)options->far : INFINITY;
    work->free_far = options->no_return_is_free ? (float)options->far : NAN;
    work->first_column = camera->pixel_centre - camera->cx;
    work->first_row = camera->pixel_centre - camera->cy;
}

static void describe_table(cm_view_desk *desk, const cm_octree *octree,
                           const cm_camera_options *camera)
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

cm_status cm_view_desk_fill(cm_view_desk *desk, const cm_octree *octree, const cm_view *view,
                            cm_pool *pool)
{
    cm_status status = to_depth(desk, octree, view);
    if (status != CM_OK)
    {
        return status;
    }
    fill_work work = {.desk = desk, .set = octree->set, .bands = cm_pool_threads(pool)};
    describe_rows(&work, octree, view);
    describe_table(desk, octree, cm_camera_describe(view->camera));
    desk->around =
        cm_view_desk_around(desk, octree->options.edge * fmax(fabs((double)work.row.focal[0]),
                                                              fabs((double)work.row.focal[1])));
    work.bands = work.bands < desk->height ? work.bands : desk->height;
    work.rings = malloc(work.bands * ring_floats(&work) * sizeof *work.rings);
    if (work.rings == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    cm_pool_run(pool, work.bands, 1, fill_bands, &work);
    free(work.rings);
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
        set->windows(at->width, leasts, mosts, at->least + row * at->width,
                     at->most + row * at->width);
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
