/* SPDX-License-Identifier: MIT */
#include "noise_spread.h"
#include "reconstruct.h"
#include "shot_noise.h"
#include "vector.h"

#include <math.h>
#include <string.h>

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

/* How distances spread in a series, but for the fixed pattern. */
static double spread_of_series(const cm_tof_sensor *sensor, int shot, const noise_charges *of,
                               int series, size_t pixel)
{
    const size_t first = (size_t)series * (size_t)sensor->phases * of->pixels + pixel;
    const double signal = (double)of->amplitude[pixel] / sensor->contrast;
    const double variance =
        variance_of_pixel(sensor, shot, of->pixels, of->charge_a + first, of->charge_b + first);
    cm_tof_sensor one = *sensor;
    one.frequency = series == 0 ? sensor->frequency : sensor->second_frequency;
    return fmin(cm_tof_noise_of_distance(&one, signal, variance - signal),
                sensor_unambiguous(sensor, series));
}

/* How far the distance jumps where noise lets the wrap beside be chosen: that whose rest is nearest, of all wraps' rests, which
 * lie evenly in the second series' wave. Around the circle of distances. */
static double jump_of(const series_mean *mean)
{
    const double step = 1.0 / mean->wraps;
    double jump = mean->weight * mean->unambiguous[1] * step, best = INFINITY;
    for (int k = 1; k < mean->wraps; k++)
    {
        const double waves = k * mean->unambiguous[0] / mean->unambiguous[1];
        const double apart = fabs(waves - floor(waves) - step);
        if (apart < best)
        {
            best = apart;
            jump = (k < mean->wraps - k ? k : mean->wraps - k) * mean->unambiguous[0];
        }
    }
    return jump;
}

/* The mean square of a mean of both series, of which noise is independent and the pattern the same, and of wrong wraps. */
static double square_of_mean(const series_mean *mean, const double spread[2], double pattern,
                             double jump)
{
    const double one = (1.0 - mean->weight) * spread[0], other = mean->weight * spread[1];
    const double moved = pattern * ((1.0 - mean->weight) * mean->unambiguous[0] +
                                    mean->weight * mean->unambiguous[1]);
    const double apart = pattern * (mean->unambiguous[0] - mean->unambiguous[1]);
    const double rest = sqrt(spread[0] * spread[0] + spread[1] * spread[1] + apart * apart);
    const double margin = 0.5 * mean->unambiguous[1] / mean->wraps;
    const double wrong = rest > 0.0 ? erfc(margin / (sqrt(2.0) * rest)) : 0.0;
    const double range = mean->wraps * mean->unambiguous[0];
    return one * one + other * other + moved * moved +
           fmin(wrong * jump * jump, range * range / 12.0);
}

double noise_spread(const cm_tof_sensor *sensor, int shot, const noise_charges *of)
{
    const double pattern = sensor->fixed_pattern / (2.0 * PI); /* turns */
    const double moved = pattern * sensor_unambiguous(sensor, 0);
    const int has_two = sensor->second_frequency > 0.0;
    series_mean mean;
    memset(&mean, 0, sizeof mean);
    if (has_two)
    {
        mean = series_mean_of(sensor);
    }
    const double jump = has_two ? jump_of(&mean) : 0.0;
    double squares = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < of->pixels; i++)
    {
        if (!(of->amplitude[i] > 0.0f))
        {
            continue;
        }
        double spread[2] = {spread_of_series(sensor, shot, of, 0, i), 0.0};
        if (has_two)
        {
            spread[1] = spread_of_series(sensor, shot, of, 1, i);
        }
        squares += has_two ? square_of_mean(&mean, spread, pattern, jump)
                           : spread[0] * spread[0] + moved * moved;
        count++;
    }
    return count == 0 ? 0.0 : sqrt(squares / (double)count);
}
