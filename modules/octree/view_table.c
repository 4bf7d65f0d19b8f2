/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "view_table.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "color_word.h"
#include "huge_pages.h"

/* A voxel is no miss if anything nearer is seen this close to its centre, in edges: half its diagonal. */
#define AROUND_EDGES 0.87

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
    free(desk->windows);
    free(desk->gap);
    free(desk->may_end);
    free(desk->end);
    free(desk->too_near);
    cm_view_bands_clear(desk);
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

/* One piece of memory for all, in which the rest begins at whole lines. */
static int take_images(cm_view_desk *desk)
{
    const size_t cells = cm_view_cells(desk);
    const size_t pixels = desk->stride * desk->height;
    const size_t dense = (size_t)desk->width * desk->height, packed = dense / 16 * 16 + 32;
    float **const images[] = {&desk->least[0], &desk->least[1], &desk->most[0], &desk->most[1]};
    const size_t count = sizeof images / sizeof *images;
    const size_t marks = cm_size_product(pixels, sizeof *desk->rule + sizeof *desk->word);
    const size_t floats = cm_size_sum(packed, cm_size_product(count, cells));
    desk->memory =
        cm_huge_allocate(cm_size_sum(marks, cm_size_product(floats, sizeof *desk->packed)));
    desk->gap = cm_huge_allocate(cm_size_product(pixels, sizeof *desk->gap));
    desk->may_end = malloc(pixels / CM_BREAK_RUN);
    if (desk->memory == NULL || desk->gap == NULL || desk->may_end == NULL)
    {
        return 0;
    }
    desk->rule = desk->memory;
    desk->word = (uint32_t *)(desk->rule + pixels);
    desk->packed = (float *)(desk->word + pixels);
    /* what is behind the last pixel is read in vectors with it */
    memset(desk->packed + dense, 0, (packed - dense) * sizeof *desk->packed);
    float *const first = desk->packed + packed;
    for (size_t i = 0; i < count; i++)
    {
        *images[i] = first + i * cells + CM_OCTREE_SLACK;
    }
    return 1;
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
    desk->stride = cm_view_stride(width);
    if (!take_images(desk) || !cm_view_windows_take(desk))
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

static void mark_numbers(size_t n, const float *depth, uint8_t *mark)
{
    for (size_t i = 0; i < n; i++)
    {
        mark[i] = (uint8_t)!isnan(depth[i]);
    }
}

static void unmark_numbers(size_t n, const float *depth, uint8_t *mark)
{
    for (size_t i = 0; i < n; i++)
    {
        mark[i] = isnan(depth[i]) ? mark[i] : 0;
    }
}

static void clean_rows(size_t first, size_t end, void *user)
{
    clean_work *work = user;
    cm_image rows = work->view->depth;
    const ptrdiff_t apart =
        rows.pixel_stride != 0 ? rows.pixel_stride : (ptrdiff_t)cm_pixel_size(rows.type);
    rows.row_stride = rows.row_stride != 0 ? rows.row_stride : apart * (ptrdiff_t)rows.width;
    rows.data = (char *)rows.data + (ptrdiff_t)first * rows.row_stride;
    rows.height = (uint32_t)(end - first);
    float *const to = work->desk->packed + first * rows.width;
    uint8_t *const too_near =
        work->desk->too_near == NULL ? NULL : work->desk->too_near + first * rows.width;
    const size_t pixels = (end - first) * rows.width;
    cm_status status = CM_OK;
    if (too_near != NULL)
    {
        const cm_depth_limits all = {.size = sizeof all, .unit = work->limits->unit};
        status = cm_depth_clean(&rows, &all, 1, to, NULL);
        if (status == CM_OK)
        {
            mark_numbers(pixels, to, too_near);
        }
    }
    cm_depth_count count = {.size = sizeof count};
    status = status == CM_OK ? cm_depth_clean(&rows, work->limits, 1, to, &count) : status;
    if (status != CM_OK)
    {
        atomic_store(&work->status, (int)status);
    }
    else if (too_near != NULL)
    {
        unmark_numbers(pixels, to, too_near);
    }
    atomic_fetch_add(&work->valid, count.valid);
}

/* What is too near is told from what was not measured only where that is free. */
static cm_status too_near_for(cm_view_desk *desk, const cm_octree_options *options)
{
    const int is_told = options->no_return_is_free && options->near > 0.0;
    if (is_told && desk->too_near == NULL)
    {
        desk->too_near = cm_array_of(desk->width, desk->height);
        return desk->too_near == NULL ? CM_ERROR_MEMORY : CM_OK;
    }
    return CM_OK;
}

cm_status cm_view_desk_clean(cm_view_desk *desk, const cm_octree *octree, const cm_view *view,
                             cm_pool *pool, size_t *valid)
{
    const cm_camera_options *camera = cm_camera_describe(view->camera);
    if (view->depth.width != camera->width || view->depth.height != camera->height)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = desk_for(desk, camera->width, camera->height);
    status = status == CM_OK ? too_near_for(desk, &octree->options) : status;
    if (status != CM_OK)
    {
        return status;
    }
    const cm_depth_limits limits = {
        .size = sizeof limits, .unit = view->depth_unit, .nearest = octree->options.near};
    clean_work work = {.desk = desk, .view = view, .limits = &limits};
    cm_pool_run(pool, camera->height, 64, clean_rows, &work);
    *valid = atomic_load(&work.valid);
    desk->has_holes = *valid < (size_t)desk->width * desk->height;
    return (cm_status)atomic_load(&work.status);
}

void cm_view_desk_silence(const cm_view_desk *desk, size_t row, cm_pixel_rule *rule, float *least,
                          float *most)
{
    for (size_t i = 0; desk->too_near != NULL && i < desk->width; i++)
    {
        if (desk->too_near[row * desk->width + i])
        {
            rule[i].depth = NAN;
            least[i] = most[i] = -INFINITY;
        }
    }
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
    return around < 1.0 ? 1 : around > CM_AROUND_MOST ? CM_AROUND_MOST : (int)around;
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

/* Bands of rows, each of one thread with rows of its own. */
typedef struct fill_work
{
    cm_view_desk *desk;
    const cm_octree_set *set;
    cm_rule_row row; /* what is the same of all */
    size_t bands;
    float first_column;
    double first_row;
} fill_work;

/* A row of a ring of the band's, or what is beyond the picture. */
static float *row_or_beyond(const cm_view_desk *desk, const cm_view_band *band, float *ring,
                            ptrdiff_t row)
{
    return row < 0 || row >= (ptrdiff_t)desk->height ? band->beyond
                                                     : ring + cm_view_row(desk, (size_t)row);
}

static void invert_row(const fill_work *work, const cm_view_band *band, size_t row)
{
    const cm_view_desk *desk = work->desk;
    work->set->invert(desk->width, desk->packed + row * desk->width,
                      band->inverse + cm_view_row(desk, row));
}

/* Behind the last pixel of a row nothing is measured. Vectors are whole, and what follows there in memory is of the next row. */
static void close_row(const cm_view_desk *desk, const cm_rule_row *at, float *front, float *back,
                      uint16_t *is_break)
{
    const size_t padded = desk->stride - 2 * CM_OCTREE_SLACK;
    for (size_t i = desk->width; i < padded; i++)
    {
        front[i] = back[i] = at->below[i] = NAN;
    }
    if (desk->width < padded)
    {
        is_break[padded / CM_BREAK_RUN - 1] &= (uint16_t)((1u << desk->width % CM_BREAK_RUN) - 1u);
    }
}

static void reach_row(const fill_work *work, const cm_view_band *band, size_t row)
{
    const cm_view_desk *desk = work->desk;
    const size_t first = cm_view_row(desk, row), padded = desk->stride - 2 * CM_OCTREE_SLACK;
    const ptrdiff_t place = (ptrdiff_t)row, apart = (ptrdiff_t)work->row.apart;
    cm_rule_row at = work->row;
    at.depth = desk->packed + row * desk->width;
    at.at = band->inverse + first;
    at.above = row_or_beyond(desk, band, band->inverse, place - apart);
    at.below = row_or_beyond(desk, band, band->inverse, place + apart);
    at.next =
        row + work->row.apart < desk->height ? at.depth + work->row.apart * desk->width : NULL;
    at.column_place = work->first_column;
    at.row_place = (float)((double)row + work->first_row);
    uint16_t *const is_break = band->is_break + first / CM_BREAK_RUN;
    work->set->reaches(padded, &at, band->reach + first, band->front + first, band->back + first,
                       is_break);
    for (size_t i = 0; desk->too_near != NULL && i < desk->width; i++)
    {
        const int is_silent = desk->too_near[row * desk->width + i];
        band->front[first + i] = is_silent ? NAN : band->front[first + i];
    }
    close_row(desk, &at, band->front + first, band->back + first, is_break);
}

static void break_row(const fill_work *work, const cm_view_band *band, size_t row)
{
    const cm_view_desk *desk = work->desk;
    const size_t first = cm_view_row(desk, row), padded = desk->stride - 2 * CM_OCTREE_SLACK;
    const float *const fronts[3] = {row_or_beyond(desk, band, band->front, (ptrdiff_t)row - 1),
                                    band->front + first,
                                    row_or_beyond(desk, band, band->front, (ptrdiff_t)row + 1)};
    work->set->breaks(padded, fronts, band->back + first, band->is_break + first / CM_BREAK_RUN);
}

static cm_ruled_row ruled_row(const fill_work *work, const cm_view_band *band, size_t row)
{
    const cm_view_desk *desk = work->desk;
    const size_t from = cm_view_row(desk, row), to = row * desk->stride;
    return (cm_ruled_row){.depth = desk->packed + row * desk->width,
                          .reach = band->reach + from,
                          .front = band->front + from,
                          .own_front = band->heard.own_front + from,
                          .near_front = band->heard.near_front + from,
                          .near_back = band->heard.near_back + from,
                          .is_taken = band->heard.is_taken + from / CM_BREAK_RUN,
                          .may_end = desk->may_end + to / CM_BREAK_RUN,
                          .rule = desk->rule + to,
                          .gap = desk->gap + to,
                          .far = work->row.far,
                          .free_far = work->row.free_far,
                          .most_reach = work->row.most};
}

/* Rules of two rows, the cells of the first level that are theirs, and windows of those above, of the same band. */
static void rule_rows(const fill_work *work, const cm_view_band *band, size_t begin, size_t row)
{
    const cm_view_desk *desk = work->desk;
    const size_t to = row / 2 * desk->stride;
    const int rows = row + 1 < desk->height ? 2 : 1;
    const cm_ruled_row at[2] = {ruled_row(work, band, row), ruled_row(work, band, row + 1)};
    work->set->band_rules(desk->width, at, rows, desk->least[1] + to, desk->most[1] + to);
    for (int k = 0; k < rows; k++)
    {
        cm_ray_ends_mark(desk, row + (size_t)k);
    }
    cm_view_windows_close(desk, row / 2);
    if (row > begin)
    {
        cm_view_windows_row(desk, work->set, row / 2 - 1);
    }
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

static size_t before(const cm_view_desk *desk, size_t row, size_t rows)
{
    return row + rows < desk->height ? row + rows : desk->height;
}

/* One row after the other goes through all that is to be done, so that it is still near. A row tells others when all of them have
 * their fronts, and has its rules when all have told it; rows of neighbouring bands that have a say are made here once more. */
static void fill_one(const fill_work *work, const cm_view_band *band, size_t begin, size_t end)
{
    const cm_view_desk *desk = work->desk;
    const size_t radius = CM_BREAK_RADIUS;
    const size_t first_teller = behind(begin, radius), end_teller = before(desk, end, radius);
    const size_t first_reach = behind(first_teller, 1), end_reach = before(desk, end_teller, 1);
    size_t broken = first_teller, told = first_teller, ruled = begin;
    for (size_t row = behind(first_reach, work->row.apart);
         row < before(desk, first_reach, work->row.apart); row++)
    {
        invert_row(work, band, row);
    }
    for (size_t row = first_reach; ruled < end; row++)
    {
        if (row < end_reach)
        {
            reach_row(work, band, row);
        }
        for (; broken < end_teller && broken < row; broken++)
        {
            break_row(work, band, broken);
        }
        for (; told < end_teller && told + radius <= row; told++)
        {
            cm_breaks_tell(desk, work->set, band, told, begin, end);
        }
        for (; ruled < end && ruled + 2 * radius + 1 <= row; ruled += 2)
        {
            rule_rows(work, band, begin, ruled);
        }
    }
}

static void fill_bands(size_t first, size_t end, void *user)
{
    const fill_work *work = user;
    for (size_t index = first; index < end; index++)
    {
        fill_one(work, &work->desk->band[index], band_begin(work, index),
                 band_begin(work, index + 1));
    }
}

/* The last row of each band and the first of the next have windows, too. */
static void make_windows(const fill_work *work)
{
    cm_view_desk *desk = work->desk;
    cm_view_windows_close(desk, desk->table.level[1].height);
    for (size_t index = 0; index < work->bands; index++)
    {
        cm_view_windows_row(desk, work->set, (band_begin(work, index + 1) + 1) / 2 - 1);
    }
    cm_view_windows_above(desk, work->set);
}

/* Of a table that is described. */
static void describe_rows(fill_work *work, const cm_octree *octree, const cm_view *view)
{
    const cm_octree_options *options = &octree->options;
    const cm_view_table *table = &work->desk->table;
    const cm_camera_options *camera = cm_camera_describe(view->camera);
    cm_rule_row *row = &work->row;
    const int is_noisy = options->noise > 0.0;
    row->apart = is_noisy ? CM_APART_WITH_NOISE : CM_APART;
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
    if (!cm_view_bands_take(desk, work.bands))
    {
        return CM_ERROR_MEMORY;
    }
    cm_pool_run(pool, work.bands, 1, fill_bands, &work);
    make_windows(&work);
    return CM_OK;
}

/* ---- colors ---- */

typedef struct color_work
{
    cm_view_desk *desk;
    const cm_octree_set *set;
    const cm_image *color;
} color_work;

/* Of one channel, or two of which the other says what hides. */
static void grey_words(size_t n, const uint8_t *grey, ptrdiff_t apart, uint32_t *word)
{
    for (size_t i = 0; i < n; i++)
    {
        const uint8_t value = grey[(ptrdiff_t)i * apart];
        word[i] = cm_color_word((const uint8_t[3]){value, value, value});
    }
}

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
        const uint8_t *from = (const uint8_t *)color->data + (ptrdiff_t)row * stride;
        uint32_t *const word = work->desk->word + row * work->desk->stride;
        (color->channels < 3 ? grey_words : work->set->words)(color->width, from, apart, word);
    }
}

void cm_view_desk_colors(cm_view_desk *desk, const cm_octree *octree, const cm_view *view,
                         cm_pool *pool)
{
    color_work work = {desk, octree->set, &view->color};
    cm_pool_run(pool, desk->height, 16, color_rows, &work);
}
