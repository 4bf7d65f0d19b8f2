/* SPDX-License-Identifier: MIT */
#include "analytic_scene.h"

#include "sphere.h"

#include <math.h>
#include <stdint.h>

#define PI 3.14159265358979323846

enum
{
    BLOCK = 256 /* directions that are computed together, for vectors and the cache */
};

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

analytic_scene scene_waves(double shortest, unsigned seed)
{
    analytic_scene made = {0};
    uint64_t state = seed == 0 ? 1 : seed;
    for (int i = 0; i < 16; i++)
    {
        (void)next_bits(&state); /* the first bits of a small seed are few */
    }
    for (int i = 0; i < SCENE_WAVES; i++)
    {
        const double period = shortest * pow(16.0, (double)i / (SCENE_WAVES - 1));
        double d[3];
        next_direction(&state, d);
        for (int c = 0; c < 3; c++)
        {
            made.wave[i].k[c] = d[c] / length_of(d) / period;
        }
        for (int c = 0; c < SCENE_CHANNELS; c++)
        {
            const double phase = PI * next_real(&state);
            made.wave[i].cosine[c] = SCENE_AMPLITUDE / SCENE_WAVES * cos(phase);
            made.wave[i].sine[c] = SCENE_AMPLITUDE / SCENE_WAVES * sin(phase);
        }
    }
    return made;
}

analytic_scene scene_zone_plate(const double axis[3], double frequency, double growth)
{
    analytic_scene made = {0};
    made.is_plate = 1;
    made.frequency = frequency;
    made.growth = growth;
    for (int c = 0; c < 3; c++)
    {
        made.axis[c] = axis[c] / length_of(axis);
    }
    return made;
}

/* sin and cos of pi x for |x| <= 1/2, by their Taylor series, whose first term left out is below 1e-16: a loop over
 * them is one that compilers vectorise. */
static double sine_of(double x)
{
    const double a = PI * x;
    const double s = a * a;
    double sum = 1.0;
    for (int i = 20; i >= 2; i -= 2)
    {
        sum = 1.0 - s * (1.0 / (double)(i * (i + 1))) * sum;
    }
    return a * sum;
}

static double cosine_of(double x)
{
    const double a = PI * x;
    const double s = a * a;
    double sum = 1.0;
    for (int i = 22; i >= 2; i -= 2)
    {
        sum = 1.0 - s * (1.0 / (double)(i * (i - 1))) * sum;
    }
    return sum;
}

/* Add one wave at up to BLOCK directions to the channels. */
static void add_wave(const scene_wave *w, size_t n, const double *x, const double *y,
                     const double *z, double sum[SCENE_CHANNELS][BLOCK])
{
    for (size_t i = 0; i < n; i++)
    {
        const double turns = w->k[0] * x[i] + w->k[1] * y[i] + w->k[2] * z[i];
        /* the nearest whole number, in the last bits of a sum */
        const double half = turns - ((turns + 0x1.8p52) - 0x1.8p52);
        const double s = sine_of(half);
        const double c = cosine_of(half);
        const double sine = 2.0 * s * c;
        const double cosine = 1.0 - 2.0 * s * s;
        sum[0][i] += w->cosine[0] * cosine - w->sine[0] * sine;
        sum[1][i] += w->cosine[1] * cosine - w->sine[1] * sine;
        sum[2][i] += w->cosine[2] * cosine - w->sine[2] * sine;
    }
}

static void wave_values(const analytic_scene *scene, size_t n, const double *x, const double *y,
                        const double *z, double *values)
{
    double sum[SCENE_CHANNELS][BLOCK];
    for (size_t i = 0; i < n; i++)
    {
        sum[0][i] = sum[1][i] = sum[2][i] = SCENE_MEAN;
    }
    for (int w = 0; w < SCENE_WAVES; w++)
    {
        add_wave(&scene->wave[w], n, x, y, z, sum);
    }
    for (size_t i = 0; i < n; i++)
    {
        for (int c = 0; c < SCENE_CHANNELS; c++)
        {
            values[SCENE_CHANNELS * i + (size_t)c] = sum[c][i];
        }
    }
}

double scene_cycles(const analytic_scene *scene, const double direction[3], double *angle)
{
    const double *a = scene->axis;
    const double *d = direction;
    const double cross[3] = {a[1] * d[2] - a[2] * d[1], a[2] * d[0] - a[0] * d[2],
                             a[0] * d[1] - a[1] * d[0]};
    *angle = atan2(length_of(cross), a[0] * d[0] + a[1] * d[1] + a[2] * d[2]);
    return (scene->frequency + 0.5 * scene->growth * *angle) * *angle;
}

void scene_values(const analytic_scene *scene, size_t n, const double *x, const double *y,
                  const double *z, double *values)
{
    if (!scene->is_plate)
    {
        for (size_t i = 0; i < n; i += BLOCK)
        {
            const size_t count = n - i < BLOCK ? n - i : BLOCK;
            wave_values(scene, count, x + i, y + i, z + i, values + SCENE_CHANNELS * i);
        }
        return;
    }
    for (size_t i = 0; i < n; i++)
    {
        const double d[3] = {x[i], y[i], z[i]};
        double angle;
        const double cycles = scene_cycles(scene, d, &angle);
        const double value = SCENE_MEAN + SCENE_AMPLITUDE * cos(2.0 * PI * (cycles - rint(cycles)));
        for (size_t c = 0; c < SCENE_CHANNELS; c++)
        {
            values[SCENE_CHANNELS * i + c] = value;
        }
    }
}
