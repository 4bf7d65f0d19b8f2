/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "flip_exposure.h"
#include "flip_color.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Where the tone mapping is to end: the authors' choice for both ends. */
static const double bright = 0.85;

/* Of Rec. 709, as the authors have it. */
static const double of_red = 0.2126;
static const double of_green = 0.7152;
static const double of_blue = 0.0722;

enum
{
    RUN = 256,   /* pixels that are read at a time */
    HALF = 65536 /* values of half a float's bits */
};

/* Luminances of count pixels as floats' bits, which grow with them; of those that do not count, count is less. */
static size_t read_luminances(const cm_compare_pair *pair, uint32_t row, uint32_t column,
                              size_t count, uint32_t bits[RUN])
{
    const cm_image *const reference = &pair->reference;
    const int is_grey = reference->channels < 3;
    double color[3][RUN];
    double weight[RUN];
    size_t found = 0;
    for (uint32_t c = 0; c < 3; c++)
    {
        cm_compare_read(reference, row, column, count, is_grey ? 0 : c, color[c]);
    }
    cm_compare_read_weights(pair, row, column, count, weight);
    for (size_t i = 0; i < count; i++)
    {
        const int is_finite =
            isfinite(color[0][i]) && isfinite(color[1][i]) && isfinite(color[2][i]);
        const double red = color[0][i] > 0.0 ? color[0][i] : 0.0;
        const double green = color[1][i] > 0.0 ? color[1][i] : 0.0;
        const double blue = color[2][i] > 0.0 ? color[2][i] : 0.0;
        const float luminance =
            (float)(is_grey ? red : of_red * red + of_green * green + of_blue * blue);
        if (is_finite && weight[i] > 0.0)
        {
            memcpy(&bits[found++], &luminance, sizeof luminance);
        }
    }
    return found;
}

/* How many luminances there are: of their upper halves, if upper is HALF, or of the lower ones of those with that upper
 * half. The greatest is left in *greatest. */
static void count_luminances(const cm_compare_pair *pair, const cm_compare_options *options,
                             uint32_t upper, uint64_t count[HALF], uint32_t *greatest)
{
    const uint64_t border = options->border;
    const cm_image *const picture = &pair->reference;
    memset(count, 0, HALF * sizeof *count);
    for (uint64_t row = border; row + border < picture->height; row++)
    {
        for (uint64_t column = border; column + border < picture->width; column += RUN)
        {
            const uint64_t left = picture->width - border - column;
            uint32_t bits[RUN];
            const size_t found = read_luminances(pair, (uint32_t)row, (uint32_t)column,
                                                 left < RUN ? (size_t)left : RUN, bits);
            for (size_t i = 0; i < found; i++)
            {
                count[upper == HALF ? bits[i] >> 16 : bits[i] & 0xffff] +=
                    upper == HALF || bits[i] >> 16 == upper;
                *greatest = bits[i] > *greatest ? bits[i] : *greatest;
            }
        }
    }
}

/* The index of the half that has the luminance of a rank, which becomes its rank among those. */
static uint32_t find_rank(const uint64_t count[HALF], uint64_t *rank)
{
    uint32_t half = 0;
    while (*rank >= count[half])
    {
        *rank -= count[half++];
    }
    return half;
}

static double luminance_of(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

/* The luminance of a rank, by its upper and then its lower half. */
static double luminance_at(const cm_compare_pair *pair, const cm_compare_options *options,
                           uint64_t rank, uint64_t count[HALF])
{
    uint32_t greatest = 0;
    count_luminances(pair, options, HALF, count, &greatest);
    const uint32_t upper = find_rank(count, &rank);
    count_luminances(pair, options, upper, count, &greatest);
    return luminance_of(upper << 16 | find_rank(count, &rank));
}

static uint64_t sum_of(const uint64_t count[HALF])
{
    uint64_t sum = 0;
    for (uint32_t i = 0; i < HALF; i++)
    {
        sum += count[i];
    }
    return sum;
}

/* The mean of the two in the middle, which are one if they are an odd number; of n from first on. */
static double median_of(const cm_compare_pair *pair, const cm_compare_options *options,
                        uint64_t first, uint64_t n, uint64_t count[HALF])
{
    const double low = luminance_at(pair, options, first + (n - 1) / 2, count);
    const double high = n % 2 == 1 ? low : luminance_at(pair, options, first + n / 2, count);
    return 0.5 * (low + high);
}

static void find_by_reference(const cm_compare_pair *pair, const cm_compare_options *options,
                              uint64_t count[HALF], cm_flip_exposures *exposures)
{
    uint32_t greatest = 0;
    count_luminances(pair, options, HALF, count, &greatest);
    const uint64_t n = sum_of(count);
    if (greatest == 0)
    {
        *exposures = (cm_flip_exposures){0.0, 0.0, 1};
        return;
    }
    double median = median_of(pair, options, 0, n, count);
    if (median == 0.0)
    {
        count_luminances(pair, options, 0, count, &greatest);
        const uint64_t zeros = count[0];
        median = median_of(pair, options, zeros, n - zeros, count);
    }
    const double target = cm_flip_tone_inverse(bright);
    exposures->start = log2(target / luminance_of(greatest));
    exposures->stop = log2(target / median);
    const double steps = ceil(exposures->stop - exposures->start);
    exposures->count = steps > 2.0 ? (uint32_t)steps : 2;
}

cm_status cm_flip_find_exposures(const cm_compare_pair *pair, const cm_compare_options *options,
                                 cm_flip_exposures *exposures)
{
    if (options->exposure_count > 0)
    {
        *exposures = (cm_flip_exposures){options->exposure_start, options->exposure_stop,
                                         options->exposure_count};
        return CM_OK;
    }
    uint64_t *const count = cm_array_of(HALF, sizeof *count);
    if (count == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    find_by_reference(pair, options, count, exposures);
    free(count);
    return CM_OK;
}

double cm_flip_exposure_at(const cm_flip_exposures *exposures, uint32_t index)
{
    const double step =
        exposures->count > 1 ? (exposures->stop - exposures->start) / (exposures->count - 1) : 0.0;
    return exp2(exposures->start + index * step);
}
