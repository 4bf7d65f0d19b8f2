/* SPDX-License-Identifier: MIT
 *
 * Structural similarity: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image quality assessment: from error
 * visibility to structural similarity", IEEE Transactions on Image Processing 13, 2004, equation 13.
 */
#include "compare_tile.h"

#include <math.h>
#include <stdlib.h>

enum
{
    RADIUS = 5,
    AROUND = CM_TILE + 2 * RADIUS, /* the edge of what a tile looks at */
    AROUND_PIXELS = AROUND * AROUND
};

static const double sigma = 1.5;
static const double k1 = 0.01;
static const double k2 = 0.03;

typedef struct ssim
{
    double c1;
    double c2;
    double window[RADIUS + 1]; /* along an axis, the sum of all 11 is 1 */
} ssim;

/* The windows of a tile: their sums along the axes, 1 unless an edge of the picture cuts them, and room. */
typedef struct tile_windows
{
    const ssim *how;
    const cm_compare_tile *tile;
    double across[CM_TILE];
    double down[CM_TILE];
    double *product; /* AROUND_PIXELS */
    double *middle;  /* AROUND_PIXELS */
} tile_windows;

static void weigh_windows(const ssim *how, uint32_t first, uint32_t length, uint32_t count,
                          double whole[CM_TILE])
{
    double is_there[AROUND];
    for (int64_t i = 0; i < (int64_t)length + 2 * RADIUS; i++)
    {
        const int64_t at = (int64_t)first + i - RADIUS;
        is_there[i] = at >= 0 && at < (int64_t)count ? 1.0 : 0.0;
    }
    cm_compare_filter(length, is_there + RADIUS, 1, RADIUS, how->window, 1.0, whole);
}

/* The windows' weighted means of the products of what is in one and in other, which may be NULL. */
static void blur(const tile_windows *windows, const double *one, const double *other, double *to)
{
    const size_t width = windows->tile->width;
    const size_t height = windows->tile->height;
    const size_t stride = width + 2 * RADIUS;
    const size_t rows = height + 2 * RADIUS;
    for (size_t i = 0; i < stride * rows; i++)
    {
        windows->product[i] = other == NULL ? one[i] : one[i] * other[i];
    }
    for (size_t y = 0; y < rows; y++)
    {
        cm_compare_filter(width, windows->product + y * stride + RADIUS, 1, RADIUS,
                          windows->how->window, 1.0, windows->middle + y * width);
    }
    for (size_t y = 0; y < height; y++)
    {
        double *const row = to + y * width;
        cm_compare_filter(width, windows->middle + (y + RADIUS) * width, (ptrdiff_t)width, RADIUS,
                          windows->how->window, 1.0, row);
        for (size_t x = 0; x < width; x++)
        {
            row[x] /= windows->across[x] * windows->down[y];
        }
    }
}

/* Of two means, two mean squares and the mean product. Where values are far above the peak, variances are differences
 * of large numbers: they are not below 0, and twice the covariance not above their sum, as true ones are. */
static double similarity(const ssim *how, const double moments[5])
{
    const double a = moments[0];
    const double b = moments[1];
    const double variance_one = moments[2] - a * a;
    const double variance_other = moments[3] - b * b;
    const double sum = (variance_one < 0.0 ? 0.0 : variance_one) +
                       (variance_other < 0.0 ? 0.0 : variance_other); /* NaN stays */
    const double twice = 2.0 * (moments[4] - a * b);
    const double covariances = twice > sum ? sum : twice < -sum ? -sum : twice;
    const double luminance = (2.0 * a * b + how->c1) / (a * a + b * b + how->c1);
    return luminance * (covariances + how->c2) / (sum + how->c2);
}

static void measure(const void *user, const cm_compare_pair *pair, const cm_compare_tile *tile,
                    double *work, double *value)
{
    const ssim *const how = user;
    tile_windows windows = {.how = how, .tile = tile};
    double *const one = work;
    double *const other = one + AROUND_PIXELS;
    double *const mean_one = other + AROUND_PIXELS;
    double *const mean_other = mean_one + CM_TILE_PIXELS;
    double *const square_one = mean_other + CM_TILE_PIXELS;
    double *const square_other = square_one + CM_TILE_PIXELS;
    double *const product = square_other + CM_TILE_PIXELS;
    windows.product = product + CM_TILE_PIXELS;
    windows.middle = windows.product + AROUND_PIXELS;
    weigh_windows(how, tile->column, tile->width, pair->picture.width, windows.across);
    weigh_windows(how, tile->row, tile->height, pair->picture.height, windows.down);
    for (uint32_t c = 0; c < pair->picture.channels; c++, value += CM_TILE_PIXELS)
    {
        cm_compare_load(&pair->reference, tile, RADIUS, c, 0, one);
        cm_compare_load(&pair->picture, tile, RADIUS, c, 0, other);
        blur(&windows, one, NULL, mean_one);
        blur(&windows, other, NULL, mean_other);
        blur(&windows, one, one, square_one);
        blur(&windows, other, other, square_other);
        blur(&windows, one, other, product);
        for (size_t i = 0; i < (size_t)tile->width * tile->height; i++)
        {
            const double moments[5] = {mean_one[i], mean_other[i], square_one[i], square_other[i],
                                       product[i]};
            value[i] = similarity(how, moments);
        }
    }
}

/* The greatest finite value of the reference that counts, as the header has it. */
static double peak_of(const cm_compare_pair *pair, const cm_compare_options *options)
{
    const cm_image *const reference = &pair->reference;
    double peak = 0.0;
    if (options->peak > 0.0 || cm_compare_is_whole(reference->type))
    {
        return options->peak > 0.0 ? options->peak : 1.0;
    }
    const uint64_t border = options->border;
    for (uint64_t row = border; row + border < reference->height; row++)
    {
        for (uint64_t column = border; column + border < reference->width; column += CM_TILE)
        {
            const uint64_t left = reference->width - border - column;
            const size_t count = left < CM_TILE ? (size_t)left : CM_TILE;
            double value[CM_TILE];
            double weight[CM_TILE];
            cm_compare_read_weights(pair, row, (uint32_t)column, count, weight);
            for (uint32_t c = 0; c < reference->channels; c++)
            {
                cm_compare_read(reference, row, (uint32_t)column, count, c, value);
                for (size_t i = 0; i < count; i++)
                {
                    const int is_more = weight[i] > 0.0 && isfinite(value[i]) && value[i] > peak;
                    peak = is_more ? value[i] : peak;
                }
            }
        }
    }
    return peak > 0.0 ? peak : 1.0;
}

cm_status cm_ssim(const cm_image *reference, const cm_image *picture,
                  const cm_compare_options *options, cm_map_figures *figures, const cm_image *map,
                  double *channel_means)
{
    cm_compare_request request;
    ssim how;
    const cm_status status =
        cm_compare_request_of(reference, picture, options, figures, map, &request);
    if (status != CM_OK)
    {
        return status;
    }
    const double peak = peak_of(&request.pair, &request.options);
    double sum = 0.0;
    how.c1 = k1 * peak * (k1 * peak);
    how.c2 = k2 * peak * (k2 * peak);
    for (int i = 0; i <= RADIUS; i++)
    {
        how.window[i] = exp(-(double)(i * i) / (2.0 * sigma * sigma));
        sum += i == 0 ? how.window[i] : 2.0 * how.window[i];
    }
    for (int i = 0; i <= RADIUS; i++)
    {
        how.window[i] /= sum;
    }
    const cm_compare_task task = {.pair = &request.pair,
                                  .options = &request.options,
                                  .map = request.map_wanted,
                                  .values = request.pair.picture.channels,
                                  .work = 4 * AROUND_PIXELS + 5 * CM_TILE_PIXELS,
                                  .call = measure,
                                  .measure = &how};
    return cm_compare_tiles(&task, figures, channel_means);
}
