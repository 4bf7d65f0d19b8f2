/* SPDX-License-Identifier: MIT
 *
 * From charges to distances, as a camera's driver computes them.
 */
#include "sensor.h"

#include <math.h>

#define PI 3.14159265358979323846

enum
{
    MOST_PHASES = 64,
    MOST_WRAPS = 1000
};

typedef struct driver
{
    const cm_tof_sensor *sensor;
    int series;
    double cosine[MOST_PHASES], sine[MOST_PHASES];
    double unambiguous[2];
    int wraps; /* of the first series that are tried */
} driver;

/* Of one series. */
typedef struct phasor
{
    double real, imaginary; /* electrons */
    double intensity;
} phasor;

/* Sum of phase images times e^(-i tau): for four of them D0 - D2 and D3 - D1 (2015, eq. 3). */
static phasor sum_phases(const driver *with, size_t n, size_t i, const float *charge_a,
                         const float *charge_b)
{
    phasor sum = {0.0, 0.0, 0.0};
    const int phases = with->sensor->phases;
    for (int k = 0; k < phases; k++)
    {
        const double a = (double)charge_a[(size_t)k * n + i];
        const double b = (double)charge_b[(size_t)k * n + i];
        sum.real += (a - b) * with->cosine[k];
        sum.imaginary -= (a - b) * with->sine[k];
        sum.intensity += a + b;
    }
    sum.real *= 2.0 / phases;
    sum.imaginary *= 2.0 / phases;
    sum.intensity /= phases;
    return sum;
}

static double distance_of(const phasor *sum, double unambiguous)
{
    const double part = atan2(sum->imaginary, sum->real) / (2.0 * PI);
    const double distance = (part < 0.0 ? part + 1.0 : part) * unambiguous;
    return distance < unambiguous ? distance : 0.0;
}

/* The distance at which both series agree best, their mean weighted as their noise asks: by the squares of frequencies. */
static double agree(const driver *with, double first, double second)
{
    double best = INFINITY, distance = first;
    const double one = with->unambiguous[0], other = with->unambiguous[1];
    for (int k = 0; k < with->wraps; k++)
    {
        const double candidate = first + k * one;
        const double apart = (candidate - second) / other;
        const double rest = (apart - nearbyint(apart)) * other;
        if (fabs(rest) < best * (1.0 - 1e-6) && candidate - rest > -0.5 * other)
        {
            const double weight = one * one / (one * one + other * other);
            best = fabs(rest);
            distance = candidate - weight * rest;
        }
    }
    return distance;
}

/* How many wraps of the first series there are before both repeat together: the denominator of the frequencies' ratio by
 * continued fractions, as far as a thousandth of a wrap counts. */
static int wraps_of(double frequency, double second)
{
    const double ratio = frequency / second;
    for (int k = 1; k < MOST_WRAPS; k++)
    {
        /* k wraps of the first are a whole number of the second's */
        const double others = k / ratio;
        if (fabs(others - nearbyint(others)) < 1e-3 && nearbyint(others) > 0.0)
        {
            return k;
        }
    }
    return MOST_WRAPS;
}

cm_status cm_tof_reconstruct(const cm_tof_sensor *sensor, size_t n, const float *charge_a,
                             const float *charge_b, float *distance, float *amplitude,
                             float *intensity, uint8_t *flags)
{
    const cm_status status = sensor_check_signal(sensor);
    if (status != CM_OK || (n > 0 && (charge_a == NULL || charge_b == NULL)))
    {
        return status == CM_OK ? CM_ERROR_ARGUMENT : status;
    }
    driver with = {.sensor = sensor, .series = sensor->second_frequency > 0.0 ? 2 : 1};
    for (int k = 0; k < sensor->phases; k++)
    {
        with.cosine[k] = cos(2.0 * PI * k / sensor->phases);
        with.sine[k] = sin(2.0 * PI * k / sensor->phases);
    }
    with.unambiguous[0] = sensor_unambiguous(sensor, 0);
    if (with.series == 2)
    {
        with.unambiguous[1] = sensor_unambiguous(sensor, 1);
        with.wraps = wraps_of(sensor->frequency, sensor->second_frequency);
    }
    const size_t series_room = (size_t)sensor->phases * n;
    for (size_t i = 0; i < n; i++)
    {
        const phasor sum = sum_phases(&with, n, i, charge_a, charge_b);
        double found = distance_of(&sum, with.unambiguous[0]);
        int is_there = hypot(sum.real, sum.imaginary) > 0.0;
        if (with.series == 2)
        {
            const phasor second =
                sum_phases(&with, n, i, charge_a + series_room, charge_b + series_room);
            is_there = is_there && hypot(second.real, second.imaginary) > 0.0;
            found = agree(&with, found, distance_of(&second, with.unambiguous[1]));
        }
        if (distance != NULL)
        {
            distance[i] = is_there ? (float)found : NAN;
        }
        if (amplitude != NULL)
        {
            amplitude[i] = (float)hypot(sum.real, sum.imaginary);
        }
        if (intensity != NULL)
        {
            intensity[i] = (float)sum.intensity;
        }
        if (flags != NULL && !is_there)
        {
            flags[i] |= CM_TOF_NOTHING;
        }
    }
    return CM_OK;
}

/* Of Poisson's numbers: each phase image has the variance of all its electrons. */
double cm_tof_noise_of_distance(const cm_tof_sensor *sensor, double signal, double ambient)
{
    return CM_SPEED_OF_LIGHT / (4.0 * PI * sensor->frequency) *
           sqrt(2.0 / sensor->phases * (signal + ambient)) / (sensor->contrast * signal);
}
