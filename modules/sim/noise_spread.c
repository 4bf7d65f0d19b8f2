/* SPDX-License-Identifier: MIT */
#include "noise_spread.h"
#include "reconstruct.h"
#include "shot_noise.h"
#include "vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum
{
    FIRST_ANGLES = 128, /* of the first series' noise */
    OTHER_ANGLES = 181, /* of the second's: prime, so that borders of wraps fall anywhere between */
    OFFSETS = 21,       /* of the pixels' own */
    RATIOS = 512        /* of signal to noise, STEP apart in their logarithm from LEAST on */
};

#define STEP 0.05
#define LEAST (-6.0)
#define REACH 12.0       /* deviations of noise that count */
#define OFFSET_REACH 5.0 /* the same of the pixels' own offsets */

/* A wrap of the first series that may be taken for its first one, and how far it is from a whole number of the second's. */
typedef struct wrap_rest
{
    double rest; /* metres */
    int wraps;
} wrap_rest;

/* How wrong distances are, by errors of phases; and the mean squares of that by the ratio of a phasor to its noise. */
typedef struct noise_model
{
    int series;
    series_mean mean;           /* of two; of one its first wave alone */
    double range;               /* in which distances are told apart, metres */
    double step;                /* between the rests of wraps, if both series repeat together */
    int wraps_a_step;           /* wraps of the first series to the next rest */
    wrap_rest rest[MOST_WRAPS]; /* if they do not; the least first */
    double pattern;             /* radians, standard deviation */
    double square[RATIOS];      /* NaN: not asked for yet */
} noise_model;

/* Of a phase image's circuits together, the mean over a series' images. */
static double variance_of_pixel(const cm_tof_sensor *sensor, int shot, size_t pixels,
                                const float *charge_a, const float *charge_b)
{
    double sum = 0.0;
    for (size_t k = 0; k < (size_t)sensor->phases; k++)
    {
        const double a = (double)charge_a[k * pixels], b = (double)charge_b[k * pixels];
        sum += shot == CM_TOF_FREEMAN_TUKEY
                   ? shot_noise_variance(sensor, a) + shot_noise_variance(sensor, b)
                   : a + b;
    }
    return sum / sensor->phases + 2.0 * sensor->read_noise * sensor->read_noise;
}

/* A phasor's length by the standard deviation of its noise in each direction: of both series, whose light is the same. */
static double ratio_of(const cm_tof_sensor *sensor, int shot, const noise_charges *of, int series,
                       size_t pixel)
{
    const double signal = (double)of->amplitude[pixel] / sensor->contrast;
    double variance = 0.0;
    for (int k = 0; k < series; k++)
    {
        const size_t first = (size_t)(k * sensor->phases) * of->pixels + pixel;
        variance += variance_of_pixel(sensor, shot, of->pixels, of->charge_a + first,
                                      of->charge_b + first) /
                    series;
    }
    const double spread = cm_tof_noise_of_distance(sensor, signal, variance - signal);
    return sensor_unambiguous(sensor, 0) / (2.0 * PI * spread);
}

/* ---- one pixel ---- */

/* How dense the angle of a phasor with noise in both directions is: no normal distribution, but where noise is small, and
 * wider than that at wraps' borders. Goodman 1985, "Statistical Optics", section 2.9, of a constant phasor and a random one. */
static double density_of(double ratio, double angle)
{
    const double along = ratio * cos(angle), across = ratio * sin(angle);
    return exp(-0.5 * ratio * ratio) / (2.0 * PI) +
           along * exp(-0.5 * across * across) * 0.5 * erfc(-along / sqrt(2.0)) / sqrt(2.0 * PI);
}

/* Angles evenly apart, as far as noise goes, and the parts of one that they have. */
static void put_angles(double ratio, size_t n, double *angle, double *part)
{
    const double half = fmin(PI, REACH / ratio);
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
    {
        angle[i] = half * ((2.0 * (double)i + 1.0) / (double)n - 1.0);
        part[i] = density_of(ratio, angle[i]);
        sum += part[i];
    }
    for (size_t i = 0; i < n; i++)
    {
        part[i] /= sum;
    }
}

/* What is told of distance 0 with these errors of two series that do not repeat together: the wrap whose rest is the nearest
 * to what they are apart, around the second's wrap. */
static double error_without_repeat(const noise_model *model, double first, double other)
{
    const series_mean *mean = &model->mean;
    const double around = mean->unambiguous[1];
    const double sought = remainder(other - first, around);
    size_t low = 0, high = (size_t)mean->wraps;
    while (low < high)
    {
        const size_t middle = low + (high - low) / 2;
        const int is_less = model->rest[middle].rest < sought;
        low = is_less ? middle + 1 : low;
        high = is_less ? high : middle;
    }
    const wrap_rest *above = &model->rest[low % (size_t)mean->wraps];
    const wrap_rest *below = &model->rest[(low == 0 ? (size_t)mean->wraps : low) - 1];
    const double up = remainder(above->rest - sought, around);
    const double down = remainder(below->rest - sought, around);
    const int is_up = fabs(up) < fabs(down);
    return first + (is_up ? above : below)->wraps * mean->unambiguous[0] -
           mean->weight * (is_up ? up : down);
}

/* The same of any series, as reconstruct.c tells it: the wrap is that whose rest is least. */
static double error_of(const noise_model *model, double first, double other)
{
    const series_mean *mean = &model->mean;
    double error = first;
    if (model->series == 2 && !mean->repeats)
    {
        return error_without_repeat(model, first, other);
    }
    if (model->series == 2)
    {
        const double steps = nearbyint((first - other) / model->step);
        const double wraps = -steps * model->wraps_a_step;
        error += (wraps - mean->wraps * nearbyint(wraps / mean->wraps)) * mean->unambiguous[0] -
                 mean->weight * (first - other - steps * model->step);
    }
    return error - model->range * nearbyint(error / model->range);
}

/* The mean square of the errors with an offset of both phases. */
static double square_at(const noise_model *model, double offset, const double *angle,
                        const double *part, const double *other_angle, const double *other_part)
{
    const double one = model->mean.unambiguous[0] / (2.0 * PI);
    const double two = model->mean.unambiguous[1] / (2.0 * PI);
    const size_t others = model->series == 2 ? OTHER_ANGLES : 1;
    double square = 0.0;
    for (size_t k = 0; k < others; k++)
    {
        const double other = model->series == 2 ? two * (other_angle[k] + offset) : 0.0;
        double sum = 0.0;
        for (size_t i = 0; i < FIRST_ANGLES; i++)
        {
            const double error = error_of(model, one * (angle[i] + offset), other);
            sum += part[i] * error * error;
        }
        square += model->series == 2 ? other_part[k] * sum : sum;
    }
    return square;
}

/* The same over the pixels' own offsets, which are normal. */
static double square_of(const noise_model *model, double ratio)
{
    double angle[FIRST_ANGLES], part[FIRST_ANGLES], other_angle[OTHER_ANGLES],
        other_part[OTHER_ANGLES], square = 0.0, sum = 0.0;
    put_angles(ratio, FIRST_ANGLES, angle, part);
    put_angles(ratio, OTHER_ANGLES, other_angle, other_part);
    const int offsets = model->pattern > 0.0 ? OFFSETS : 1;
    for (int i = 0; i < offsets; i++)
    {
        const double deviations = OFFSET_REACH * ((2.0 * i + 1.0) / offsets - 1.0);
        const double weight = exp(-0.5 * deviations * deviations);
        square += weight * square_at(model, deviations * model->pattern, angle, part, other_angle,
                                     other_part);
        sum += weight;
    }
    return square / sum;
}

/* ---- all pixels ---- */

static void put_wraps(noise_model *model)
{
    const series_mean *mean = &model->mean;
    const double one = mean->unambiguous[0], other = mean->unambiguous[1];
    const double waves = nearbyint(mean->wraps * one / other);
    model->step = waves > 0.0 ? other / mean->wraps : one;
    model->wraps_a_step = 1;
    while (waves > 0.0 && model->wraps_a_step < mean->wraps &&
           fmod(model->wraps_a_step * waves, mean->wraps) != 1.0)
    {
        model->wraps_a_step++;
    }
}

static int compare_rests(const void *one, const void *other)
{
    const double a = ((const wrap_rest *)one)->rest, b = ((const wrap_rest *)other)->rest;
    return (a > b) - (a < b);
}

static void put_rests(noise_model *model)
{
    const series_mean *mean = &model->mean;
    for (int k = 0; k < mean->wraps; k++)
    {
        model->rest[k] = (wrap_rest){remainder(k * mean->unambiguous[0], mean->unambiguous[1]), k};
    }
    qsort(model->rest, (size_t)mean->wraps, sizeof *model->rest, compare_rests);
}

static void prepare(const cm_tof_sensor *sensor, noise_model *model)
{
    memset(model, 0, sizeof *model);
    model->series = sensor->second_frequency > 0.0 ? 2 : 1;
    model->mean.unambiguous[0] = sensor_unambiguous(sensor, 0);
    model->range = reconstruct_range(sensor);
    model->pattern = sensor->fixed_pattern;
    if (model->series == 2)
    {
        model->mean = series_mean_of(sensor);
        put_wraps(model);
        if (!model->mean.repeats)
        {
            put_rests(model);
        }
    }
    for (size_t i = 0; i < RATIOS; i++)
    {
        model->square[i] = NAN;
    }
}

static double square_of_node(noise_model *model, size_t node)
{
    if (isnan(model->square[node]))
    {
        model->square[node] = square_of(model, exp(LEAST + STEP * (double)node));
    }
    return model->square[node];
}

/* Between two ratios, and beyond the last, as a power of it. */
static double square_between(noise_model *model, double ratio)
{
    const double place = fmax((log(ratio) - LEAST) / STEP, 0.0);
    const size_t node = (size_t)fmin(place, RATIOS - 2);
    const double part = place - (double)node;
    const double low = square_of_node(model, node), high = square_of_node(model, node + 1);
    return low * pow(high / low, part);
}

double noise_spread(const cm_tof_sensor *sensor, int shot, const noise_charges *of)
{
    noise_model model;
    double squares = 0.0;
    size_t count = 0;
    prepare(sensor, &model);
    for (size_t i = 0; i < of->pixels; i++)
    {
        if (of->amplitude[i] > 0.0f)
        {
            squares += square_between(&model, ratio_of(sensor, shot, of, model.series, i));
            count++;
        }
    }
    return count == 0 ? 0.0 : sqrt(squares / (double)count);
}
