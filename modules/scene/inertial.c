/* SPDX-License-Identifier: MIT
 *
 * What an accelerometer and a gyroscope on a trajectory measure. Noise as Kalibr and IEEE 952 have it: white noise of a
 * density, whose samples have the density times the root of the rate, and a bias that walks.
 */
#include <cubemap/random.h>
#include <cubemap/trajectory.h>

#include <math.h>
#include <string.h>

#include "motion_span.h"

#define SAMPLES_MOST 2147483648.0

/* Views of random.h: what a number is of. */
enum
{
    ACCELEROMETER = 0,
    GYROSCOPE = 2,
    WHITE = 0,
    WALK = 1
};

static int is_noise(const cm_inertial_noise *noise)
{
    double sum = fabs(noise->bias[0]) + fabs(noise->bias[1]) + fabs(noise->bias[2]);
    sum += noise->density + noise->walk;
    return noise->density >= 0.0 && noise->walk >= 0.0 && sum < (double)INFINITY;
}

static int is_finite_vector(const double v[3])
{
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

static cm_status check(const cm_motion *motion, const cm_inertial_options *options, double *samples)
{
    double first;
    double last;
    if (motion == NULL || options == NULL || options->size != sizeof *options)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!(options->rate > 0.0) || !isfinite(options->rate) || !isfinite(options->latency) ||
        !is_finite_vector(options->gravity) || !is_noise(&options->accelerometer) ||
        !is_noise(&options->gyroscope))
    {
        return CM_ERROR_RANGE;
    }
    cm_motion_span(motion, &first, &last);
    *samples = floor((last - first) * options->rate) + 1.0;
    return *samples <= SAMPLES_MOST ? CM_OK : CM_ERROR_RANGE;
}

static cm_status state_of(const cm_motion *motion, double rate, size_t index, double *time,
                          cm_motion_state *state)
{
    double first;
    double last;
    cm_motion_span(motion, &first, &last);
    *time = fmin(first + (double)index / rate, last);
    return cm_motion_at(motion, *time, state);
}

/* Add bias and noise to a sample, and let the bias walk on to the next. */
static void disturb(const cm_inertial_options *options, const cm_inertial_noise *noise,
                    uint32_t sensor, size_t index, double bias[3], double value[3])
{
    const uint32_t pixel = (uint32_t)index;
    const double root = sqrt(options->rate);
    for (uint32_t axis = 0; axis < 3; axis++)
    {
        value[axis] += bias[axis];
        if (noise->density > 0.0)
        {
            value[axis] += noise->density * root *
                           cm_random_normal(options->seed, sensor + WHITE, pixel, axis);
        }
        if (noise->walk > 0.0)
        {
            bias[axis] +=
                noise->walk / root * cm_random_normal(options->seed, sensor + WALK, pixel, axis);
        }
    }
}

static void measure(const cm_motion *motion, const cm_inertial_options *options, size_t count,
                    double *stamp, double *acceleration, double *rate)
{
    double acceleration_bias[3];
    double rate_bias[3];
    memcpy(acceleration_bias, options->accelerometer.bias, sizeof acceleration_bias);
    memcpy(rate_bias, options->gyroscope.bias, sizeof rate_bias);
    for (size_t k = 0; k < count; k++)
    {
        double time;
        cm_motion_state state = {.size = sizeof state};
        state_of(motion, options->rate, k, &time, &state);
        stamp[k] = time + options->latency;
        for (int i = 0; i < 3; i++)
        {
            state.acceleration[i] -= options->gravity[i];
        }
        cm_rotate(&state.pose.rotation, state.acceleration, &acceleration[3 * k]);
        memcpy(&rate[3 * k], state.rate, sizeof state.rate);
        disturb(options, &options->accelerometer, ACCELEROMETER, k, acceleration_bias,
                &acceleration[3 * k]);
        disturb(options, &options->gyroscope, GYROSCOPE, k, rate_bias, &rate[3 * k]);
    }
}

cm_status cm_motion_inertial(const cm_motion *motion, const cm_inertial_options *options,
                             size_t room, double *stamp, double *acceleration, double *rate,
                             size_t *count)
{
    if (count == NULL || (room > 0 && (stamp == NULL || acceleration == NULL || rate == NULL)))
    {
        return CM_ERROR_ARGUMENT;
    }
    double samples;
    cm_status status = check(motion, options, &samples);
    if (status != CM_OK)
    {
        return status;
    }
    const size_t all = (size_t)samples;
    if (all > room)
    {
        *count = all;
        return CM_ERROR_SPACE;
    }
    /* outputs stay as they are on failure, so that all are looked at first */
    for (size_t k = 0; k < all; k++)
    {
        double time;
        cm_motion_state state = {.size = sizeof state};
        status = state_of(motion, options->rate, k, &time, &state);
        if (status != CM_OK)
        {
            return status;
        }
    }
    *count = all;
    measure(motion, options, all, stamp, acceleration, rate);
    return CM_OK;
}
