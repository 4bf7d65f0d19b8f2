/* SPDX-License-Identifier: MIT */
#include <cubemap/compensate.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "compensate_warp.h"

#define RADIUS_MOST 1000u
#define BINS_MOST 65536u
#define TILES_MOST 64u
#define BINS_OF_A_TILE 256u
/* A deviation below this part of the greatest value is rounding. */
#define ROUNDING 1e-6

static cm_status check_pictures(uint32_t width, uint32_t height, const float *from, const float *to,
                                int is_in_range)
{
    if (from == NULL || to == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    return cm_is_picture_size(width, height) && is_in_range ? CM_OK : CM_ERROR_RANGE;
}

/* ---- the range of a picture ---- */

/* Of the finite values; nothing is between them if there are none. */
typedef struct value_range
{
    double least;
    double most;
} value_range;

static value_range range_of(size_t n, const float *value)
{
    value_range range = {DBL_MAX, -DBL_MAX};
    for (size_t i = 0; i < n; i++)
    {
        if (isfinite(value[i]))
        {
            const double v = (double)value[i];
            range.least = v < range.least ? v : range.least;
            range.most = v > range.most ? v : range.most;
        }
    }
    return range;
}

/* From 0 to 1; NaN of what is not finite. */
static double place_in(const value_range *range, float value)
{
    if (!isfinite(value))
    {
        return (double)NAN;
    }
    const double width = range->most - range->least;
    return width > 0.0 ? ((double)value - range->least) / width : 0.0;
}

cm_status cm_channel_normalize(uint32_t width, uint32_t height, const float *picture, double most,
                               float *to)
{
    const cm_status status =
        check_pictures(width, height, picture, to, most > 0.0 && most <= (double)FLT_MAX);
    if (status != CM_OK)
    {
        return status;
    }
    const size_t pixels = cm_pixels_of((cm_picture_size){width, height});
    const value_range range = range_of(pixels, picture);
    for (size_t i = 0; i < pixels; i++)
    {
        to[i] = (float)(most * place_in(&range, picture[i]));
    }
    return CM_OK;
}

/* ---- windows ---- */

/* Sums of the finite values in a column of a window, from their mean on, which keeps rounding small. */
typedef struct column_sum
{
    double sum;
    double squares;
    double count;
} column_sum;

static void add_value(column_sum *to, float value, double middle, double sign)
{
    if (isfinite(value))
    {
        const double v = (double)value - middle;
        to->sum += sign * v;
        to->squares += sign * v * v;
        to->count += sign;
    }
}

static void add_row(column_sum *columns, uint32_t width, const float *row, double middle,
                    double sign)
{
    for (uint32_t i = 0; i < width; i++)
    {
        add_value(&columns[i], row[i], middle, sign);
    }
}

static void add_column(column_sum *to, const column_sum *column, double sign)
{
    to->sum += sign * column->sum;
    to->squares += sign * column->squares;
    to->count += sign * column->count;
}

static float score_of(float value, const column_sum *window, const value_range *range)
{
    if (!isfinite(value))
    {
        return NAN;
    }
    const double middle = 0.5 * (range->least + range->most);
    const double mean = window->sum / window->count;
    const double variance = window->squares / window->count - mean * mean;
    const double smallest = ROUNDING * (range->most - range->least);
    return variance > smallest * smallest
               ? (float)(((double)value - middle - mean) / sqrt(variance))
               : 0.0f;
}

static void score_row(const column_sum *columns, uint32_t width, uint32_t radius, const float *row,
                      const value_range *range, float *to)
{
    column_sum window = {0};
    for (uint32_t i = 0; i < width && i < radius; i++)
    {
        add_column(&window, &columns[i], 1.0);
    }
    for (uint32_t i = 0; i < width; i++)
    {
        if (i + radius < width)
        {
            add_column(&window, &columns[i + radius], 1.0);
        }
        if (i > radius)
        {
            add_column(&window, &columns[i - radius - 1], -1.0);
        }
        to[i] = score_of(row[i], &window, range);
    }
}

cm_status cm_channel_normalize_locally(uint32_t width, uint32_t height, const float *picture,
                                       uint32_t radius, float *to)
{
    const cm_status status =
        check_pictures(width, height, picture, to, radius > 0 && radius <= RADIUS_MOST);
    if (status != CM_OK)
    {
        return status;
    }
    column_sum *columns = calloc(width, sizeof *columns);
    if (columns == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    const value_range range = range_of(cm_pixels_of((cm_picture_size){width, height}), picture);
    const double middle = 0.5 * (range.least + range.most);
    for (uint32_t row = 0; row < height && row < radius; row++)
    {
        add_row(columns, width, picture + (size_t)row * width, middle, 1.0);
    }
    for (uint32_t row = 0; row < height; row++)
    {
        if (row + radius < height)
        {
            add_row(columns, width, picture + (size_t)(row + radius) * width, middle, 1.0);
        }
        if (row > radius)
        {
            add_row(columns, width, picture + (size_t)(row - radius - 1) * width, middle, -1.0);
        }
        const size_t begin = (size_t)row * width;
        score_row(columns, width, radius, picture + begin, &range, to + begin);
    }
    free(columns);
    return CM_OK;
}

/* ---- equalization ---- */

static uint32_t bin_of(const value_range *range, float value, uint32_t bins)
{
    const uint32_t bin = (uint32_t)(place_in(range, value) * bins);
    return bin < bins ? bin : bins - 1;
}

/* Counts become how many are in a bin or in one before it, as a part of all: eq. 9. */
static void accumulate(double *bin, uint32_t bins)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < bins; i++)
    {
        sum += bin[i];
        bin[i] = sum;
    }
    for (uint32_t i = 0; i < bins && sum > 0.0; i++)
    {
        bin[i] /= sum;
    }
}

cm_status cm_channel_equalize(uint32_t width, uint32_t height, const float *picture, uint32_t bins,
                              float *to)
{
    const cm_status status =
        check_pictures(width, height, picture, to, bins >= 2 && bins <= BINS_MOST);
    if (status != CM_OK)
    {
        return status;
    }
    double *bin = calloc(bins, sizeof *bin);
    if (bin == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    const size_t pixels = cm_pixels_of((cm_picture_size){width, height});
    const value_range range = range_of(pixels, picture);
    for (size_t i = 0; i < pixels; i++)
    {
        if (isfinite(picture[i]))
        {
            bin[bin_of(&range, picture[i], bins)] += 1.0;
        }
    }
    accumulate(bin, bins);
    for (size_t i = 0; i < pixels; i++)
    {
        to[i] = isfinite(picture[i]) ? (float)bin[bin_of(&range, picture[i], bins)] : NAN;
    }
    free(bin);
    return CM_OK;
}

/* ---- in tiles ---- */

typedef struct tiling
{
    cm_picture_size size;
    uint32_t tiles;
    value_range range;
    double *bin; /* BINS_OF_A_TILE of each tile */
} tiling;

static uint32_t tile_begin(uint32_t tile, uint32_t tiles, uint32_t count)
{
    return (uint32_t)((uint64_t)tile * count / tiles);
}

static void cut_bins(double *bin, double limit)
{
    double sum = 0.0, above = 0.0;
    for (uint32_t i = 0; i < BINS_OF_A_TILE; i++)
    {
        sum += bin[i];
    }
    const double most = limit * sum / BINS_OF_A_TILE;
    for (uint32_t i = 0; i < BINS_OF_A_TILE; i++)
    {
        above += bin[i] > most ? bin[i] - most : 0.0;
        bin[i] = bin[i] > most ? most : bin[i];
    }
    for (uint32_t i = 0; i < BINS_OF_A_TILE; i++)
    {
        bin[i] += above / BINS_OF_A_TILE;
    }
}

static void fill_tile(const tiling *t, uint32_t column, uint32_t row, double limit,
                      const float *picture)
{
    double *bin = t->bin + ((size_t)row * t->tiles + column) * BINS_OF_A_TILE;
    const uint32_t right = tile_begin(column + 1, t->tiles, t->size.width);
    const uint32_t bottom = tile_begin(row + 1, t->tiles, t->size.height);
    for (uint32_t y = tile_begin(row, t->tiles, t->size.height); y < bottom; y++)
    {
        for (uint32_t x = tile_begin(column, t->tiles, t->size.width); x < right; x++)
        {
            const float value = picture[(size_t)y * t->size.width + x];
            if (isfinite(value))
            {
                bin[bin_of(&t->range, value, BINS_OF_A_TILE)] += 1.0;
            }
        }
    }
    cut_bins(bin, limit);
    accumulate(bin, BINS_OF_A_TILE);
}

/* Between which tiles' centres a pixel is, and how far. */
static double between_tiles(uint32_t pixel, uint32_t count, uint32_t tiles, uint32_t tile[2])
{
    const double at = ((double)pixel + 0.5) * tiles / count - 0.5;
    const double inside = at > 0.0 ? at : 0.0;
    tile[0] = (uint32_t)inside;
    tile[1] = tile[0] + 1 < tiles ? tile[0] + 1 : tile[0];
    return inside - tile[0];
}

/* Of the four tiles around a pixel, the one that stands for a corner: its own, or the next in the row, the column, or across where
 * nothing is in it. In one of them is the pixel. */
static double part_at(const tiling *t, const uint32_t x[2], const uint32_t y[2], size_t corner,
                      uint32_t bin)
{
    for (size_t k = 0; k < 4; k++)
    {
        const size_t other = corner ^ k;
        const double *tile =
            t->bin + ((size_t)y[other / 2] * t->tiles + x[other % 2]) * BINS_OF_A_TILE;
        if (tile[BINS_OF_A_TILE - 1] > 0.0)
        {
            return tile[bin];
        }
    }
    return 0.0;
}

static float equalized(const tiling *t, uint32_t column, uint32_t row, float value)
{
    if (!isfinite(value))
    {
        return NAN;
    }
    uint32_t x[2], y[2];
    const double right = between_tiles(column, t->size.width, t->tiles, x);
    const double down = between_tiles(row, t->size.height, t->tiles, y);
    const uint32_t bin = bin_of(&t->range, value, BINS_OF_A_TILE);
    double part[4];
    for (size_t k = 0; k < 4; k++)
    {
        part[k] = part_at(t, x, y, k, bin);
    }
    const double above = part[0] + right * (part[1] - part[0]);
    const double below = part[2] + right * (part[3] - part[2]);
    return (float)(above + down * (below - above));
}

cm_status cm_channel_equalize_locally(uint32_t width, uint32_t height, const float *picture,
                                      uint32_t tiles, double limit, float *to)
{
    const int is_in_range = tiles > 0 && tiles <= TILES_MOST && tiles <= width && tiles <= height &&
                            limit >= 1.0 && isfinite(limit);
    const cm_status status = check_pictures(width, height, picture, to, is_in_range);
    if (status != CM_OK)
    {
        return status;
    }
    tiling t = {.size = {width, height}, .tiles = tiles};
    t.range = range_of(cm_pixels_of(t.size), picture);
    t.bin = calloc((size_t)tiles * tiles * BINS_OF_A_TILE, sizeof *t.bin);
    if (t.bin == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    for (uint32_t tile = 0; tile < tiles * tiles; tile++)
    {
        fill_tile(&t, tile % tiles, tile / tiles, limit, picture);
    }
    for (uint32_t row = 0; row < height; row++)
    {
        for (uint32_t column = 0; column < width; column++)
        {
            const size_t i = (size_t)row * width + column;
            to[i] = equalized(&t, column, row, picture[i]);
        }
    }
    free(t.bin);
    return CM_OK;
}
