/* SPDX-License-Identifier: MIT
 *
 * From charges to distances, as a camera's driver computes them.
 */
#include "reconstruct.h"
#include "vector.h"

#include <math.h>
#include <string.h>

typedef struct driver
{
    const cm_tof_sensor *sensor;
    int series;
    double cosine[TOF_PHASES], sine[TOF_PHASES];
    double unambiguous;
    series_mean mean; /* of two series */
    const tof_set *set;
    size_t stride; /* pixels of a phase image */
    const float *charge_a, *charge_b;
    float *phase, *distance, *amplitude, *intensity;
    uint8_t *flags;
} driver;

/* The distance at which both series agree best, their mean weighted as their noise asks: by the squares of frequencies. */
static double agree(const driver *with, double first, double second)
{
    double best = INFINITY, distance = first;
    const double one = with->mean.unambiguous[0], other = with->mean.unambiguous[1];
    for (int k = 0; k < with->mean.wraps; k++)
    {
        const double candidate = first + k * one;
        const double apart = (candidate - second) / other;
        const double rest = (apart - nearbyint(apart)) * other;
        if (fabs(rest) < best * (1.0 - 1e-6) && candidate - rest > -0.5 * other)
        {
            best = fabs(rest);
            distance = candidate - with->mean.weight * rest;
        }
    }
    return distance;
}

/* May frequencies be others' whose ratio is that of first to other, rounded to the decimals that they have: 33.33e6 beside
 * 100e6, which are 1 to 3? As far as a thousandth of a wrap; and not where they would be the same, but are not. */
static int is_rounded_ratio(double frequency, double second, double first, double other)
{
    double unit = 1.0; /* of the last decimal that either has, hertz */
    while (fmod(frequency, 10.0 * unit) == 0.0 && fmod(second, 10.0 * unit) == 0.0)
    {
        unit *= 10.0;
    }
    const double off = fabs(first * second - other * frequency);
    return first != other && off <= 0.5 * unit * (first + other) && off < 1e-3 * frequency;
}

/* The wraps of the first series before both repeat together are the denominator of the frequencies' ratio, as exactly as
 * doubles have it. Where that is beyond the most, a smaller one that they may have been rounded from. */
static void put_wraps(double frequency, double second, series_mean *mean)
{
    for (int is_rounded = 0; is_rounded < 2; is_rounded++)
    {
        for (int k = 1; k <= MOST_WRAPS; k++)
        {
            /* k wraps of the first are a whole number of the second's */
            const double others = k * (second / frequency), whole = nearbyint(others);
            if (whole > 0.0 && (is_rounded ? is_rounded_ratio(frequency, second, k, whole)
                                           : fabs(others - whole) <= 1e-9 * whole))
            {
                mean->wraps = k;
                mean->repeats = 1;
                return;
            }
        }
    }
    mean->wraps = MOST_WRAPS;
    mean->repeats = 0;
}

series_mean series_mean_of(const cm_tof_sensor *sensor)
{
    const double one = sensor_unambiguous(sensor, 0), other = sensor_unambiguous(sensor, 1);
    series_mean made = {.unambiguous = {one, other},
                        .weight = one * one / (one * one + other * other)};
    put_wraps(sensor->frequency, sensor->second_frequency, &made);
    return made;
}

double reconstruct_range(const cm_tof_sensor *sensor)
{
    return sensor_unambiguous(sensor, 0) *
           (sensor->second_frequency > 0.0 ? series_mean_of(sensor).wraps : 1);
}

static void prepare(const cm_tof_sensor *sensor, driver *with)
{
    with->sensor = sensor;
    with->series = sensor->second_frequency > 0.0 ? 2 : 1;
    for (int k = 0; k < sensor->phases; k++)
    {
        with->cosine[k] = cos(2.0 * PI * k / sensor->phases);
        with->sine[k] = sin(2.0 * PI * k / sensor->phases);
    }
    with->unambiguous = sensor_unambiguous(sensor, 0);
    if (with->series == 2)
    {
        with->mean = series_mean_of(sensor);
    }
}

/* Distances of a block from its phasors; NaN where there is none. */
static void put_distances(const driver *with, size_t n, const tof_phasors *one,
                          const tof_phasors *other, float *distance)
{
    for (size_t i = 0; i < n; i++)
    {
        distance[i] = (float)(one->turns[i] * with->unambiguous);
    }
    for (size_t i = 0; with->series == 2 && i < n; i++)
    {
        const double found = agree(with, one->turns[i] * with->unambiguous,
                                   other->turns[i] * with->mean.unambiguous[1]);
        distance[i] = isnan(one->turns[i]) || isnan(other->turns[i]) ? NAN : (float)found;
    }
}

static void flag_nothing(const driver *with, size_t n, const tof_phasors *one,
                         const tof_phasors *other, uint8_t *flags)
{
    for (size_t i = 0; i < n; i++)
    {
        if (isnan(one->turns[i]) || (with->series == 2 && isnan(other->turns[i])))
        {
            flags[i] |= CM_TOF_NOTHING;
        }
    }
}

/* What a camera gives of each phase image. */
static void put_phases(const driver *with, size_t begin, size_t end)
{
    const size_t images = (size_t)(with->series * with->sensor->phases);
    for (size_t k = 0; with->phase != NULL && k < images; k++)
    {
        const size_t last = k * with->stride + end;
        for (size_t i = k * with->stride + begin; i < last; i++)
        {
            with->phase[i] = with->charge_a[i] - with->charge_b[i];
        }
    }
}

/* Up to TOF_BLOCK pixels: what they have of charges stays near the processor. */
static void put_block(const driver *with, size_t first, size_t n)
{
    _Alignas(64) tof_phasors one, other;
    const size_t series = (size_t)with->sensor->phases * with->stride;
    put_phases(with, first, first + n);
    int is_missing =
        with->set->phasors(with->sensor->phases, with->cosine, with->sine, n, with->stride,
                           with->charge_a + first, with->charge_b + first, &one);
    if (with->series == 2)
    {
        is_missing |= with->set->phasors(with->sensor->phases, with->cosine, with->sine, n,
                                         with->stride, with->charge_a + series + first,
                                         with->charge_b + series + first, &other);
    }
    if (with->distance != NULL)
    {
        put_distances(with, n, &one, &other, with->distance + first);
    }
    if (with->flags != NULL && is_missing)
    {
        flag_nothing(with, n, &one, &other, with->flags + first);
    }
    if (with->amplitude != NULL)
    {
        memcpy(with->amplitude + first, one.amplitude, n * sizeof(float));
    }
    if (with->intensity != NULL)
    {
        memcpy(with->intensity + first, one.intensity, n * sizeof(float));
    }
}

static void put_pixels(size_t begin, size_t end, void *user)
{
    for (size_t first = begin; first < end; first += TOF_BLOCK)
    {
        put_block(user, first, end - first < TOF_BLOCK ? end - first : TOF_BLOCK);
    }
}

void reconstruct(const tof_set *set, const cm_tof_sensor *sensor, size_t n, const float *charge_a,
                 const float *charge_b, cm_pool *pool, const cm_tof_result *result, uint8_t *flags)
{
    driver with = {.set = set,
                   .stride = n,
                   .charge_a = charge_a,
                   .charge_b = charge_b,
                   .phase = result->phase,
                   .distance = result->distance,
                   .amplitude = result->amplitude,
                   .intensity = result->intensity,
                   .flags = flags};
    prepare(sensor, &with);
    cm_pool_run(pool, n, 16 * TOF_BLOCK, put_pixels, &with);
}

cm_status cm_tof_reconstruct(const cm_tof_sensor *sensor, size_t n, const float *charge_a,
                             const float *charge_b, float *distance, float *amplitude,
                             float *intensity, uint8_t *flags)
{
    cm_status status = sensor_check_signal(sensor);
    if (status == CM_OK && n > 0 && (charge_a == NULL || charge_b == NULL))
    {
        status = CM_ERROR_ARGUMENT;
    }
    const tof_set *set = NULL;
    status = status == CM_OK ? tof_set_choose(&set) : status;
    if (status == CM_OK)
    {
        const cm_tof_result result = {.size = sizeof result,
                                      .distance = distance,
                                      .amplitude = amplitude,
                                      .intensity = intensity};
        reconstruct(set, sensor, n, charge_a, charge_b, NULL, &result, flags);
    }
    return status;
}

/* Of Poisson's numbers: each phase image has the variance of all its electrons. */
double cm_tof_noise_of_distance(const cm_tof_sensor *sensor, double signal, double ambient)
{
    return CM_SPEED_OF_LIGHT / (4.0 * PI * sensor->frequency) *
           sqrt(2.0 / sensor->phases * (signal + ambient)) / (sensor->contrast * signal);
}
