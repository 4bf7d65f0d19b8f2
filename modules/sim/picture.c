/* SPDX-License-Identifier: MIT
 *
 * Adaptive sampling: where a cell and its eight neighbours see one smooth surface, the mean over the samples is that of the
 * quadratic through their middles; all samples are taken elsewhere.
 */
#include "picture.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum
{
    TILE_COLUMNS = 32,
    TILE_ROWS = TOF_BLOCK / TILE_COLUMNS
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

static double *put_sums(tof_sums *sums, double *from, size_t cells, size_t waves)
{
    sums->total = from;
    sums->ambient = from + cells;
    sums->direct_real = from + 2 * cells;
    sums->direct_imaginary = from + 3 * cells;
    sums->real = from + 4 * cells;
    sums->imaginary = sums->real + waves * cells;
    return sums->imaginary + waves * cells;
}

static int needs_centres(const tof_sensor *sensor, const cm_tof_options *options)
{
    return sensor->samples > 1 && !options->full;
}

cm_status picture_create(const tof_sensor *sensor, const cm_tof_options *options,
                         tof_picture *picture)
{
    memset(picture, 0, sizeof *picture);
    const size_t cells = (size_t)sensor->cells.columns * sensor->cells.rows;
    const size_t waves = sensor->waves.count;
    picture->cells = cells;
    picture->waves = waves;
    const size_t sums = (needs_centres(sensor, options) ? 2 : 1) * sums_room(cells, waves);
    const size_t size = sums * sizeof(double) + cells * (2 * sizeof(double) + 4 * sizeof(float) +
                                                         2 * sizeof(uint8_t));
    if (cells > SIZE_MAX / 16 / (sizeof(double) * (8 + 4 * waves)))
    {
        return CM_ERROR_MEMORY;
    }
    picture->memory = calloc(1, size);
    if (picture->memory == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    double *next = put_sums(&picture->sum, picture->memory, cells, waves);
    if (needs_centres(sensor, options))
    {
        next = put_sums(&picture->centre, next, cells, waves);
    }
    picture->range = next;
    picture->shadows = (uint64_t *)(void *)(next + cells);
    float *floats = (float *)(void *)(picture->shadows + cells);
    for (int k = 0; k < 3; k++, floats += cells)
    {
        picture->normal[k] = floats;
    }
    picture->id = (uint32_t *)(void *)floats;
    picture->flags = (uint8_t *)(picture->id + cells);
    picture->needs_samples = picture->flags + cells;
    return CM_OK;
}

void picture_destroy(tof_picture *picture)
{
    free(picture->memory);
    picture->memory = NULL;
}

void picture_clear(tof_picture *picture)
{
    memset(picture->sum.total, 0, sums_room(picture->cells, picture->waves) * sizeof(double));
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
    size_t cell[TOF_BLOCK];
    double column[TOF_BLOCK];
    double row[TOF_BLOCK];
    uint32_t number[TOF_BLOCK];
} tile;

static void add_cell(const sensor_cells *cells, uint32_t column, uint32_t row, tile *to)
{
    const size_t k = to->n++;
    to->cell[k] = (size_t)row * cells->columns + column;
    to->column[k] = cells->first + ((double)column + 0.5) * cells->width;
    to->row[k] = cells->top + (double)row + 0.5;
    to->number[k] = (uint32_t)to->cell[k];
}

static void put_tile(const work *doing, size_t number, tile *to)
{
    const sensor_cells *cells = &doing->scenery->sensor->cells;
    const uint32_t left = (uint32_t)(number % doing->tile_columns) * TILE_COLUMNS;
    const uint32_t top = (uint32_t)(number / doing->tile_columns) * TILE_ROWS;
    to->n = 0;
    for (uint32_t row = top; row < top + TILE_ROWS && row < cells->rows; row++)
    {
        for (uint32_t column = left; column < left + TILE_COLUMNS && column < cells->columns;
             column++)
        {
            add_cell(cells, column, row, to);
        }
    }
}

static void keep_status(work *doing, cm_status status)
{
    if (status != CM_OK)
    {
        atomic_store(&doing->status, (int)status);
    }
}

static void add_values(const tile *at, const double *value, const double *weight, double *sum)
{
    for (size_t i = 0; i < at->n; i++)
    {
        sum[at->cell[i]] += weight[i] * value[i];
    }
}

static void add_places(const work *doing, const tile *at, const tof_light_block *light,
                       const double *weight)
{
    const tof_picture *picture = doing->picture;
    const tof_sums *sum = &picture->sum;
    add_values(at, light->total, weight, sum->total);
    if (doing->scenery->options->environment != NULL)
    {
        add_values(at, light->ambient, weight, sum->ambient);
    }
    if (doing->scenery->options->bounces > 0)
    {
        add_values(at, light->direct_real, weight, sum->direct_real);
        add_values(at, light->direct_imaginary, weight, sum->direct_imaginary);
    }
    for (size_t j = 0; j < doing->scenery->waves.count; j++)
    {
        add_values(at, light->real[j], weight, sum->real + j * picture->cells);
        add_values(at, light->imaginary[j], weight, sum->imaginary + j * picture->cells);
    }
}

static int is_odd(const tof_sensor *sensor, size_t cell)
{
    return sensor->cells.width < 1.0 ? (int)(cell % sensor->cells.columns % 2) : 0;
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
            picture->range[cell] = light->range[i];
        }
        else if (picture->id[cell] != light->id[i] ||
                 fabs(picture->range[cell] - light->range[i]) > MOTION_APART)
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
    _Alignas(64) tof_light_block light;
    for (size_t number = begin; number < end; number++)
    {
        put_tile(doing, number, &at);
        keep_status(doing, tof_shade(doing->scenery, at.n, at.column, at.row, at.number, &light));
        keep_middles(doing, &at, &light);
        atomic_fetch_add(&doing->rays, at.n);
        double weight[TOF_BLOCK];
        for (size_t i = 0; i < at.n; i++)
        {
            weight[i] = doing->part * sensor->sample[0].weight[is_odd(sensor, at.cell[i])];
        }
        add_places(doing, &at, &light, weight);
    }
}

/* ---- all samples ---- */

/* What the samples of a cell saw: more than one surface apart from each other? */
typedef struct seen
{
    double nearest, farthest;
    uint32_t id;
    int is_mixed;
} seen;

static void see(seen *so_far, const tof_light_block *light, size_t i, size_t sample)
{
    const double range = light->range[i];
    if (sample == 0)
    {
        so_far->nearest = so_far->farthest = range;
        so_far->id = light->id[i];
        so_far->is_mixed = 0;
    }
    so_far->nearest = fmin(so_far->nearest, range);
    so_far->farthest = fmax(so_far->farthest, range);
    so_far->is_mixed |= so_far->id != light->id[i];
}

/* Every sample of up to TOF_BLOCK cells, one sample of all cells at a time: so a block is of neighbours. */
static void sample_cells(work *doing, const tile *at, int keeps_middles)
{
    const tof_sensor *sensor = doing->scenery->sensor;
    double column[TOF_BLOCK], row[TOF_BLOCK], weight[TOF_BLOCK];
    uint32_t number[TOF_BLOCK];
    seen of[TOF_BLOCK];
    _Alignas(64) tof_light_block light;
    for (size_t s = 0; s < sensor->samples; s++)
    {
        for (size_t i = 0; i < at->n; i++)
        {
            column[i] = at->column[i] + sensor->sample[s].x * sensor->cells.width;
            row[i] = at->row[i] + sensor->sample[s].y;
            number[i] = at->number[i] * (uint32_t)sensor->samples + (uint32_t)s;
        }
        keep_status(doing, tof_shade(doing->scenery, at->n, column, row, number, &light));
        if (keeps_middles && s == sensor->samples / 2)
        {
            keep_middles(doing, at, &light);
        }
        for (size_t i = 0; i < at->n; i++)
        {
            see(&of[i], &light, i, s);
            weight[i] = doing->part * sensor->sample[s].weight[is_odd(sensor, at->cell[i])];
        }
        add_places(doing, at, &light, weight);
    }
    for (size_t i = 0; i < at->n; i++)
    {
        if (of[i].is_mixed && !(of[i].farthest - of[i].nearest <= FLYING_APART))
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

static void put_centres(size_t begin, size_t end, void *user)
{
    work *const doing = user;
    tof_picture *picture = doing->picture;
    tile at;
    _Alignas(64) tof_light_block light;
    for (size_t number = begin; number < end; number++)
    {
        put_tile(doing, number, &at);
        keep_status(doing, tof_shade(doing->scenery, at.n, at.column, at.row, at.number, &light));
        keep_middles(doing, &at, &light);
        atomic_fetch_add(&doing->rays, at.n);
        for (size_t i = 0; i < at.n; i++)
        {
            const size_t cell = at.cell[i];
            picture->id[cell] = light.id[i];
            picture->range[cell] = light.range[i];
            picture->shadows[cell] = light.shadows[i];
            for (int k = 0; k < 3; k++)
            {
                picture->normal[k][cell] = (float)light.normal[k][i];
            }
            picture->centre.total[cell] = light.total[i];
            picture->centre.ambient[cell] = light.ambient[i];
            picture->centre.direct_real[cell] = light.direct_real[i];
            picture->centre.direct_imaginary[cell] = light.direct_imaginary[i];
            for (size_t j = 0; j < doing->scenery->waves.count; j++)
            {
                picture->centre.real[j * picture->cells + cell] = light.real[j][i];
                picture->centre.imaginary[j * picture->cells + cell] = light.imaginary[j][i];
            }
        }
    }
}

/* Does a cell see the same smooth surface as its neighbours? step: cells of a row. */
static int is_smooth(const tof_picture *picture, size_t cell, size_t step)
{
    const size_t places[8] = {cell - step - 1, cell - step, cell - step + 1, cell - 1,
                              cell + 1,        cell + step - 1, cell + step, cell + step + 1};
    const double range = picture->range[cell];
    for (int i = 0; i < 8; i++)
    {
        const size_t at = places[i];
        if (picture->id[at] != picture->id[cell] || picture->shadows[at] != picture->shadows[cell])
        {
            return 0;
        }
        for (int k = 0; k < 3; k++)
        {
            if (!(fabsf(picture->normal[k][at] - picture->normal[k][cell]) <= SMOOTH_NORMAL))
            {
                return 0;
            }
        }
    }
    if (picture->id[cell] == CM_SCENE_NOTHING)
    {
        return 1;
    }
    for (int i = 0; i < 4; i++)
    {
        if (!(fabs(picture->range[places[i]] - 2.0 * range + picture->range[places[7 - i]]) <=
              SMOOTH_RANGE))
        {
            return 0;
        }
    }
    return 1;
}

/* The weighted mean over a cell of the quadratic through nine values. */
static double mean_of_quadratic(const double *value, size_t cell, size_t step,
                                const sensor_moments *moments)
{
    const double *at = value + cell;
    const double *above = at - step, *below = at + step;
    const double x = 0.5 * (at[1] - at[-1]);
    const double y = 0.5 * (below[0] - above[0]);
    const double xx = at[1] - 2.0 * at[0] + at[-1];
    const double yy = below[0] - 2.0 * at[0] + above[0];
    const double xy = 0.25 * (below[1] - below[-1] - above[1] + above[-1]);
    return moments->one * at[0] + moments->x * x + moments->y * y +
           0.5 * (moments->xx * xx + moments->yy * yy) + moments->xy * xy;
}

static void add_mean(const work *doing, size_t cell, size_t step)
{
    const tof_picture *picture = doing->picture;
    const tof_sums *from = &picture->centre, *to = &picture->sum;
    const sensor_moments *moments =
        &doing->scenery->sensor->moments[is_odd(doing->scenery->sensor, cell)];
    const double part = doing->part;
    to->total[cell] += part * mean_of_quadratic(from->total, cell, step, moments);
    to->ambient[cell] += part * mean_of_quadratic(from->ambient, cell, step, moments);
    to->direct_real[cell] += part * mean_of_quadratic(from->direct_real, cell, step, moments);
    to->direct_imaginary[cell] +=
        part * mean_of_quadratic(from->direct_imaginary, cell, step, moments);
    for (size_t j = 0; j < doing->scenery->waves.count; j++)
    {
        const size_t k = j * picture->cells + cell;
        to->real[k] += part * mean_of_quadratic(from->real, k, step, moments);
        to->imaginary[k] += part * mean_of_quadratic(from->imaginary, k, step, moments);
    }
}

/* Of each row what is smooth, and the samples of all else, gathered to blocks. */
static void add_rows(size_t begin, size_t end, void *user)
{
    work *const doing = user;
    const sensor_cells *cells = &doing->scenery->sensor->cells;
    const tof_picture *picture = doing->picture;
    tile rest = {.n = 0};
    for (size_t band = begin; band < end; band++)
    {
        for (size_t row = band * TILE_ROWS; row < (band + 1) * TILE_ROWS && row < cells->rows; row++)
        {
            for (uint32_t column = 0; column < cells->columns; column++)
            {
                const size_t cell = row * cells->columns + column;
                const int is_inside = row > 0 && row + 1 < cells->rows && column > 0 &&
                                      column + 1 < cells->columns;
                if (is_inside && !picture->needs_samples[cell] &&
                    is_smooth(picture, cell, cells->columns))
                {
                    add_mean(doing, cell, cells->columns);
                    continue;
                }
                add_cell(cells, column, (uint32_t)row, &rest);
                if (rest.n == TOF_BLOCK)
                {
                    sample_cells(doing, &rest, 0);
                    rest.n = 0;
                }
            }
        }
        /* blocks end with bands, so that they do not depend on who does which */
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
    if (scenery->sensor->samples == 1)
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
        mark_edges(scenery, picture->needs_samples);
        cm_pool_run(pool, bands, 1, add_rows, &doing);
    }
    picture->rays += atomic_load(&doing.rays);
    picture->oversampled += atomic_load(&doing.oversampled);
    return (cm_status)atomic_load(&doing.status);
}
