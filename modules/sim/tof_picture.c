/* SPDX-License-Identifier: MIT
 *
 * Adaptive sampling: where a cell and its eight neighbours see one smooth surface, the mean over the samples is that of the
 * quadratic through their middles; all samples are taken elsewhere.
 */
#include "tof_picture.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum
{
    TILE_COLUMNS = 32,
    TILE_ROWS = TOF_BLOCK / TILE_COLUMNS,
    CLEARED_AT_ONCE = 8192
};

/* Second differences of range, metres, and differences of normals that a quadratic follows to much less than 0.1 mm. */
#define SMOOTH_RANGE 5e-3
#define SMOOTH_NORMAL 0.1f
#define FLYING_APART 0.01  /* metres between surfaces in a pixel */
#define MOTION_APART 0.001 /* metres of range */

/* ---- memory ---- */

static size_t sums_room(size_t cells, size_t waves)
{
    return cells * (4 + 2 * waves);
}

static void put_sums(tof_sums *sums, double *from, size_t cells, size_t waves)
{
    sums->total = from;
    sums->ambient = from + cells;
    sums->direct_real = from + 2 * cells;
    sums->direct_imaginary = from + 3 * cells;
    sums->real = from + 4 * cells;
    sums->imaginary = sums->real + waves * cells;
}

/* A mask may leave one sample that lies elsewhere. */
static int is_middle_alone(const tof_sensor *sensor)
{
    return sensor->samples == 1 && sensor->sample[0].x == 0.0 && sensor->sample[0].y == 0.0;
}

static int needs_centres(const tof_sensor *sensor, const cm_tof_options *options)
{
    return !is_middle_alone(sensor) && !options->full;
}

/* Where the arrays of a picture are in one piece of memory; NULL: how large that is. */
static size_t put_arrays(const tof_sensor *sensor, const cm_tof_options *options,
                         tof_picture *picture, void *memory)
{
    const size_t cells = picture->cells, waves = picture->waves;
    double *const begin = memory;
    size_t next = sums_room(cells, waves);
    put_sums(&picture->sum, begin, cells, waves);
    if (needs_centres(sensor, options))
    {
        put_sums(&picture->centre, begin + next, cells, waves);
        next += sums_room(cells, waves);
    }
    picture->range = begin + next;
    picture->shadows = (uint64_t *)(void *)(begin + next + cells);
    next += 2 * cells;
    float *const floats = (float *)(void *)(begin + next);
    for (size_t k = 0; k < 3; k++)
    {
        picture->normal[k] = floats + k * cells;
    }
    picture->id = (uint32_t *)(void *)(floats + 3 * cells);
    next += 2 * cells;
    picture->flags = (uint8_t *)(void *)(begin + next);
    picture->needs_samples = picture->flags + cells;
    picture->smooth = picture->flags + 2 * cells;
    return next * sizeof(double) + 3 * cells;
}

size_t picture_size(const tof_sensor *sensor, const cm_tof_options *options)
{
    tof_picture picture = {.cells = (size_t)sensor->cells.columns * sensor->cells.rows,
                           .waves = sensor->waves.count};
    return picture.cells > SIZE_MAX / 16 / (sizeof(double) * (8 + 4 * picture.waves))
               ? 0
               : put_arrays(sensor, options, &picture, &picture);
}

typedef struct clearing
{
    const tof_picture *picture;
    int has_direct;
} clearing;

static void clear_cells(size_t begin, size_t end, void *user)
{
    const clearing *doing = user;
    const tof_sums *sum = &doing->picture->sum;
    const size_t bytes = (end - begin) * sizeof(double);
    memset(sum->total + begin, 0, bytes);
    memset(sum->ambient + begin, 0, bytes);
    if (doing->has_direct)
    {
        memset(sum->direct_real + begin, 0, bytes);
        memset(sum->direct_imaginary + begin, 0, bytes);
    }
    for (size_t j = 0; j < doing->picture->waves; j++)
    {
        memset(sum->real + j * doing->picture->cells + begin, 0, bytes);
        memset(sum->imaginary + j * doing->picture->cells + begin, 0, bytes);
    }
}

void picture_clear(tof_picture *picture, const cm_tof_options *options, cm_pool *pool)
{
    clearing doing = {picture, options->bounces > 0};
    cm_pool_run(pool, picture->cells, CLEARED_AT_ONCE, clear_cells, &doing);
}

void picture_create(const tof_sensor *sensor, const cm_tof_options *options, cm_pool *pool,
                    void *memory, tof_picture *picture)
{
    memset(picture, 0, sizeof *picture);
    picture->cells = (size_t)sensor->cells.columns * sensor->cells.rows;
    picture->waves = sensor->waves.count;
    put_arrays(sensor, options, picture, memory);
    memset(picture->flags, 0, picture->cells);
    picture_clear(picture, options, pool);
}

/* ---- tiles ---- */

typedef struct work
{
    const tof_scenery *scenery;
    tof_picture *picture;
    double part;
    int is_first;
    uint32_t tile_columns;
    atomic_int status;
    atomic_ullong rays;
    atomic_ullong oversampled;
} work;

/* Cells of a block, and their middles. */
typedef struct tile
{
    size_t n;
    size_t run; /* so many lie side by side, each time */
    size_t cell[TOF_BLOCK];
    double column[TOF_BLOCK];
    double row[TOF_BLOCK];
    uint32_t number[TOF_BLOCK];
} tile;

/* Cells side by side. */
static void add_cells(const sensor_cells *cells, uint32_t column, uint32_t row, size_t count,
                      tile *to)
{
    const size_t k = to->n, first = (size_t)row * cells->columns + column;
    for (size_t i = 0; i < count; i++)
    {
        to->cell[k + i] = first + i;
        to->column[k + i] = cells->first + ((double)(int32_t)(column + i) + 0.5) * cells->width;
        to->row[k + i] = cells->top + (double)row + 0.5;
        to->number[k + i] = (uint32_t)(first + i);
    }
    to->n += count;
}

static void put_tile(const work *doing, size_t number, tile *to)
{
    const sensor_cells *cells = &doing->scenery->sensor->cells;
    const uint32_t left = (uint32_t)(number % doing->tile_columns) * TILE_COLUMNS;
    const uint32_t top = (uint32_t)(number / doing->tile_columns) * TILE_ROWS;
    to->n = 0;
    to->run = cells->columns - left < TILE_COLUMNS ? cells->columns - left : TILE_COLUMNS;
    for (uint32_t row = top; row < top + TILE_ROWS && row < cells->rows; row++)
    {
        add_cells(cells, left, row, to->run, to);
    }
}

static void keep_status(work *doing, cm_status status)
{
    if (status != CM_OK)
    {
        atomic_store(&doing->status, (int)status);
    }
}

/* Of one plane. */
static void add_values(const work *doing, const tile *at, const double *value, const double *weight,
                       const double *lens, double *sum)
{
    if (at->run == 1)
    {
        for (size_t i = 0; i < at->n; i++)
        {
            sum[at->cell[i]] += weight[i] * (value[i] * lens[i]);
        }
        return;
    }
    for (size_t i = 0; i < at->n; i += at->run)
    {
        doing->scenery->set->add(at->run, weight + i, lens + i, value + i, sum + at->cell[i]);
    }
}

static void add_places(const work *doing, const tile *at, const tof_light_block *light,
                       const double *weight)
{
    const tof_picture *picture = doing->picture;
    const tof_sums *sum = &picture->sum;
    add_values(doing, at, light->total, weight, light->lens, sum->total);
    if (doing->scenery->options->environment != NULL)
    {
        add_values(doing, at, light->ambient, weight, light->lens, sum->ambient);
    }
    if (doing->scenery->options->bounces > 0)
    {
        add_values(doing, at, light->direct_real, weight, light->lens, sum->direct_real);
        add_values(doing, at, light->direct_imaginary, weight, light->lens, sum->direct_imaginary);
    }
    for (size_t j = 0; j < doing->scenery->waves.count; j++)
    {
        const size_t plane = j * picture->cells;
        add_values(doing, at, light->real[j], weight, light->lens, sum->real + plane);
        add_values(doing, at, light->imaginary[j], weight, light->lens, sum->imaginary + plane);
    }
}

/* Of a sample, in each cell: only half pixels differ, the even and the odd ones. */
static void put_weights(const work *doing, const sensor_sample *sample, const tile *at,
                        double *weight)
{
    const sensor_cells *cells = &doing->scenery->sensor->cells;
    const double both[2] = {doing->part * sample->weight[0], doing->part * sample->weight[1]};
    for (size_t i = 0; cells->width == 1.0 && i < at->n; i++)
    {
        weight[i] = both[0];
    }
    for (size_t i = 0; cells->width < 1.0 && i < at->n; i++)
    {
        weight[i] = both[at->cell[i] % cells->columns % 2];
    }
}

/* What the middle sees is kept, and compared with what it saw before. */
static void keep_middles(const work *doing, const tile *at, const tof_light_block *light)
{
    tof_picture *picture = doing->picture;
    for (size_t i = 0; picture->watches && i < at->n; i++)
    {
        const size_t cell = at->cell[i];
        if (doing->is_first)
        {
            picture->id[cell] = light->id[i];
            picture->range[cell] = light->rays.distance[i];
        }
        else if (picture->id[cell] != light->id[i] ||
                 fabs(picture->range[cell] - light->rays.distance[i]) > MOTION_APART)
        {
            picture->flags[cell] |= CM_TOF_MOTION;
        }
    }
}

/* One sample a cell. */
static void add_middles(size_t begin, size_t end, void *user)
{
    work *const doing = user;
    const tof_sensor *sensor = doing->scenery->sensor;
    tile at;
    double weight[TOF_BLOCK];
    _Alignas(64) tof_light_block light;
    for (size_t number = begin; number < end; number++)
    {
        put_tile(doing, number, &at);
        keep_status(doing, tof_shade(doing->scenery, at.n, at.column, at.row, at.number, &light));
        keep_middles(doing, &at, &light);
        atomic_fetch_add(&doing->rays, at.n);
        put_weights(doing, &sensor->sample[0], &at, weight);
        add_places(doing, &at, &light, weight);
    }
}

/* ---- all samples ---- */

/* What the samples of cells saw: more than one surface apart from each other? */
typedef struct seen
{
    double nearest[TOF_BLOCK], farthest[TOF_BLOCK];
    uint32_t id[TOF_BLOCK];
    uint32_t differs[TOF_BLOCK]; /* bits in which ids do */
} seen;

static void see(seen *so_far, const tof_light_block *light, size_t n, size_t sample)
{
    const double *const range = light->rays.distance;
    if (sample == 0)
    {
        memcpy(so_far->nearest, range, n * sizeof *range);
        memcpy(so_far->farthest, range, n * sizeof *range);
        memcpy(so_far->id, light->id, n * sizeof *light->id);
        memset(so_far->differs, 0, n * sizeof *so_far->differs);
        return;
    }
    for (size_t i = 0; i < n; i++)
    {
        const double near = so_far->nearest[i], far = so_far->farthest[i];
        so_far->nearest[i] = range[i] < near ? range[i] : near;
        so_far->farthest[i] = range[i] > far ? range[i] : far;
    }
    for (size_t i = 0; i < n; i++)
    {
        so_far->differs[i] |= so_far->id[i] ^ light->id[i];
    }
}

/* Every sample of up to TOF_BLOCK cells, one sample of all cells at a time: so a block is of neighbours. */
static void sample_cells(work *doing, const tile *at, int keeps_middles)
{
    const tof_sensor *sensor = doing->scenery->sensor;
    double column[TOF_BLOCK], row[TOF_BLOCK], weight[TOF_BLOCK];
    uint32_t number[TOF_BLOCK];
    seen of;
    _Alignas(64) tof_light_block light;
    for (size_t s = 0; s < sensor->samples; s++)
    {
        const double across = sensor->sample[s].x * sensor->cells.width, down = sensor->sample[s].y;
        for (size_t i = 0; i < at->n; i++)
        {
            column[i] = at->column[i] + across;
            row[i] = at->row[i] + down;
            number[i] = at->number[i] * (uint32_t)sensor->samples + (uint32_t)s;
        }
        keep_status(doing, tof_shade(doing->scenery, at->n, column, row, number, &light));
        if (keeps_middles && s == sensor->samples / 2)
        {
            keep_middles(doing, at, &light);
        }
        see(&of, &light, at->n, s);
        put_weights(doing, &sensor->sample[s], at, weight);
        add_places(doing, at, &light, weight);
    }
    for (size_t i = 0; i < at->n; i++)
    {
        if (of.differs[i] != 0 && !(of.farthest[i] - of.nearest[i] <= FLYING_APART))
        {
            doing->picture->flags[at->cell[i]] |= CM_TOF_FLYING;
        }
    }
    atomic_fetch_add(&doing->rays, at->n * sensor->samples);
    atomic_fetch_add(&doing->oversampled, at->n);
}

static void add_all_samples(size_t begin, size_t end, void *user)
{
    work *const doing = user;
    tile at;
    for (size_t number = begin; number < end; number++)
    {
        put_tile(doing, number, &at);
        sample_cells(doing, &at, 1);
    }
}

/* ---- as many as needed ---- */

/* What passes the lens, of cells side by side. */
static void put_plane(size_t n, const double *value, const double *lens, double *to)
{
    for (size_t i = 0; i < n; i++)
    {
        to[i] = value[i] * lens[i];
    }
}

/* What the middles of cells side by side saw: of the block's, from i on. */
static void put_run(const work *doing, const tof_light_block *light, size_t i, size_t n,
                    size_t cell)
{
    const tof_picture *picture = doing->picture;
    const tof_sums *centre = &picture->centre;
    const double *const lens = light->lens + i;
    memcpy(picture->id + cell, light->id + i, n * sizeof *picture->id);
    memcpy(picture->range + cell, light->rays.distance + i, n * sizeof *picture->range);
    memcpy(picture->shadows + cell, light->shadows + i, n * sizeof *picture->shadows);
    for (int k = 0; k < 3; k++)
    {
        for (size_t m = 0; m < n; m++)
        {
            picture->normal[k][cell + m] = (float)light->rays.normal[k][i + m];
        }
    }
    put_plane(n, light->total + i, lens, centre->total + cell);
    if (doing->scenery->options->environment != NULL)
    {
        put_plane(n, light->ambient + i, lens, centre->ambient + cell);
    }
    if (doing->scenery->options->bounces > 0)
    {
        put_plane(n, light->direct_real + i, lens, centre->direct_real + cell);
        put_plane(n, light->direct_imaginary + i, lens, centre->direct_imaginary + cell);
    }
    for (size_t j = 0; j < doing->scenery->waves.count; j++)
    {
        const size_t plane = j * picture->cells + cell;
        put_plane(n, light->real[j] + i, lens, centre->real + plane);
        put_plane(n, light->imaginary[j] + i, lens, centre->imaginary + plane);
    }
}

static void put_centres(size_t begin, size_t end, void *user)
{
    work *const doing = user;
    tile at;
    _Alignas(64) tof_light_block light;
    for (size_t number = begin; number < end; number++)
    {
        put_tile(doing, number, &at);
        keep_status(doing, tof_shade(doing->scenery, at.n, at.column, at.row, at.number, &light));
        find_outside_cones(doing->scenery, at.n, &light);
        keep_middles(doing, &at, &light);
        atomic_fetch_add(&doing->rays, at.n);
        for (size_t i = 0; i < at.n; i += at.run)
        {
            put_run(doing, &light, i, at.run, at.cell[i]);
        }
    }
}

/* One plane of what the middles saw, into the sums of a row's smooth cells. */
static void add_means(const work *doing, size_t row, size_t n, const double *from, double *to)
{
    const tof_sensor *sensor = doing->scenery->sensor;
    const size_t step = sensor->cells.columns;
    const double *const middle = from + row * step + 1;
    const double *const rows[3] = {middle - step, middle, middle + step};
    const int is_half = sensor->cells.width < 1.0;
    const tof_moments moments[2] = {sensor->moments[0], sensor->moments[is_half]};
    doing->scenery->set->add_means(n, rows, moments, is_half, doing->part,
                                   doing->picture->needs_samples + row * step + 1,
                                   to + row * step + 1);
}

/* The cells of a row but its first and last; where samples are needed becomes where they are not. */
static void add_smooth(const work *doing, size_t row)
{
    const tof_picture *picture = doing->picture;
    const size_t step = doing->scenery->sensor->cells.columns, n = step - 2;
    const size_t first = row * step + 1;
    static const tof_smoothness than = {SMOOTH_NORMAL, SMOOTH_RANGE};
    tof_rows rows;
    uint8_t *const needs = picture->needs_samples + first;
    for (size_t r = 0; r < 3; r++)
    {
        const size_t at = first + r * step - step;
        rows.id[r] = picture->id + at;
        rows.shadows[r] = picture->shadows + at;
        rows.range[r] = picture->range + at;
        for (int k = 0; k < 3; k++)
        {
            rows.normal[r][k] = picture->normal[k] + at;
        }
    }
    uint8_t *const is_smooth = picture->smooth + first;
    doing->scenery->set->smooth(n, &rows, &than, is_smooth);
    for (size_t i = 0; i < n; i++)
    {
        needs[i] = (uint8_t)(is_smooth[i] & (needs[i] == 0));
    }
    const tof_sums *from = &picture->centre, *to = &picture->sum;
    add_means(doing, row, n, from->total, to->total);
    if (doing->scenery->options->environment != NULL)
    {
        add_means(doing, row, n, from->ambient, to->ambient);
    }
    if (doing->scenery->options->bounces > 0)
    {
        add_means(doing, row, n, from->direct_real, to->direct_real);
        add_means(doing, row, n, from->direct_imaginary, to->direct_imaginary);
    }
    for (size_t j = 0; j < doing->scenery->waves.count; j++)
    {
        const size_t plane = j * picture->cells;
        add_means(doing, row, n, from->real + plane, to->real + plane);
        add_means(doing, row, n, from->imaginary + plane, to->imaginary + plane);
    }
}

/* The cells of a row that are not smooth, gathered to blocks. */
static void sample_row(work *doing, size_t row, int has_smooth, tile *rest)
{
    const sensor_cells *cells = &doing->scenery->sensor->cells;
    for (uint32_t column = 0; column < cells->columns; column++)
    {
        const int is_inside = has_smooth && column > 0 && column + 1 < cells->columns;
        if (is_inside && doing->picture->needs_samples[row * cells->columns + column])
        {
            continue;
        }
        add_cells(cells, column, (uint32_t)row, 1, rest);
        if (rest->n == TOF_BLOCK)
        {
            sample_cells(doing, rest, 0);
            rest->n = 0;
        }
    }
}

/* Blocks end with bands, so that they do not depend on who does which. */
static void add_rows(size_t begin, size_t end, void *user)
{
    work *const doing = user;
    const sensor_cells *cells = &doing->scenery->sensor->cells;
    tile rest = {.n = 0, .run = 1};
    for (size_t band = begin; band < end; band++)
    {
        for (size_t row = band * TILE_ROWS; row < (band + 1) * TILE_ROWS && row < cells->rows;
             row++)
        {
            const int has_smooth = row > 0 && row + 1 < cells->rows && cells->columns > 2;
            if (has_smooth)
            {
                add_smooth(doing, row);
            }
            sample_row(doing, row, has_smooth, &rest);
        }
        if (rest.n > 0)
        {
            sample_cells(doing, &rest, 0);
            rest.n = 0;
        }
    }
}

cm_status picture_add(const tof_scenery *scenery, double part, int is_first, cm_pool *pool,
                      tof_picture *picture)
{
    const sensor_cells *cells = &scenery->sensor->cells;
    work doing = {.scenery = scenery, .picture = picture, .part = part, .is_first = is_first};
    doing.tile_columns = (cells->columns + TILE_COLUMNS - 1) / TILE_COLUMNS;
    const size_t bands = (cells->rows + TILE_ROWS - 1) / TILE_ROWS;
    const size_t tiles = bands * doing.tile_columns;
    if (is_middle_alone(scenery->sensor))
    {
        cm_pool_run(pool, tiles, 4, add_middles, &doing);
    }
    else if (scenery->options->full)
    {
        cm_pool_run(pool, tiles, 1, add_all_samples, &doing);
    }
    else
    {
        cm_pool_run(pool, tiles, 4, put_centres, &doing);
        memset(picture->needs_samples, 0, picture->cells);
        keep_status(&doing, mark_edges(scenery, pool, picture->needs_samples));
        cm_pool_run(pool, bands, 1, add_rows, &doing);
    }
    picture->rays += atomic_load(&doing.rays);
    picture->oversampled += atomic_load(&doing.oversampled);
    return (cm_status)atomic_load(&doing.status);
}
