/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "environment_lobe.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846

/* The turn from one direction of the spiral to the next: 2 pi over the square of the golden ratio. */
#define GOLDEN_ANGLE 2.39996322972865332

/* What each method is blurred by, in levels: GPU Gems 3, chapter 20, adds one. The spiral's samples lie evenly and need
 * less, as bench/image/time_environments.c shows. */
#define BLUR_HAMMERSLEY 1.0
#define BLUR_SPIRAL 0.25

static double weight_at(double a, double s)
{
    const double below = a + (1.0 - a) * s;
    return (1.0 - 2.0 * s) / (below * below);
}

/* The integral of that from 0 to s, in closed form; near a = 1 to the second order. */
static double weight_until(double a, double s)
{
    const double e = 1.0 - a;
    if (e < 1e-4)
    {
        return s - s * s + 2.0 * e * (s - 1.5 * s * s + 2.0 / 3.0 * s * s * s);
    }
    const double grown = e * s / a;
    return ((1.0 + a) * grown / (a + e * s) - 2.0 * log1p(grown)) / (e * e);
}

/* The s with so much of the lobe's weight inside, by halving in t, s = a t / (1 - t), where the lobe is nearly even. */
static double place_of(double a, double part)
{
    const double wanted = part * weight_until(a, 0.5);
    double low = 0.0;
    double high = 0.5 / (a + 0.5);
    for (int k = 0; k < 52; k++)
    {
        const double middle = 0.5 * (low + high);
        if (weight_until(a, a * middle / (1.0 - middle)) < wanted)
        {
            low = middle;
        }
        else
        {
            high = middle;
        }
    }
    const double t = 0.5 * (low + high);
    return fmin(a * t / (1.0 - t), 0.5);
}

/* angle: of the sphere that the sample stands for. */
static void put(cm_lobe *lobe, double s, double azimuth, double weight, double angle, double blur)
{
    const size_t k = lobe->count;
    const double across = 2.0 * sqrt(s * (1.0 - s));
    lobe->x[k] = (float)(across * cos(azimuth));
    lobe->y[k] = (float)(across * sin(azimuth));
    lobe->z[k] = (float)(1.0 - 2.0 * s);
    lobe->weight[k] = (float)weight;
    lobe->edge[k] = (float)(0.5 * log2(angle) + blur);
    lobe->count++;
}

/* All of the same weight: at the middles of rings of equal weight, each turned from the last by the golden angle. A
 * ring of ds has 4 pi ds. */
static void make_spiral(double a, uint32_t samples, double blur, cm_lobe *lobe)
{
    const double whole = weight_until(a, 0.5);
    for (uint32_t k = 0; k < samples; k++)
    {
        const double s = place_of(a, (k + 0.5) / samples);
        const double angle = 4.0 * PI * whole / (samples * weight_at(a, s));
        put(lobe, s, fmod(GOLDEN_ANGLE * k, 2.0 * PI), 1.0 / samples, fmin(angle, 4.0 * PI), blur);
    }
}

/* The bits of a number behind the point, in reverse (van der Corput). */
static double radical_inverse(uint32_t number)
{
    double sum = 0.0;
    double bit = 0.5;
    for (uint32_t rest = number; rest != 0; rest >>= 1, bit *= 0.5)
    {
        sum += (rest & 1) != 0 ? bit : 0.0;
    }
    return sum;
}

/* Normals of GGX as Karis 2013 samples them, whose density is D n h: that of l is D / 4. */
static void make_hammersley(double a, uint32_t samples, double blur, cm_lobe *lobe)
{
    double sum = 0.0;
    for (uint32_t k = 0; k < samples; k++)
    {
        const double part = radical_inverse(k);
        const double s = a * part / (1.0 + (a - 1.0) * part);
        if (s >= 0.5)
        {
            continue;
        }
        const double below = a + (1.0 - a) * s;
        const double density = a / (4.0 * PI * below * below);
        put(lobe, s, 2.0 * PI * k / samples, 1.0 - 2.0 * s, 1.0 / (samples * density), blur);
        sum += 1.0 - 2.0 * s;
    }
    for (size_t k = 0; k < lobe->count; k++)
    {
        lobe->weight[k] = (float)((double)lobe->weight[k] / sum);
    }
}

cm_status cm_lobe_make(cm_prefilter_method method, double alpha_squared, uint32_t samples,
                       double blur, cm_lobe *lobe)
{
    float *memory = cm_array_of(samples, 5 * sizeof *memory);
    if (memory == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    *lobe = (cm_lobe){0,
                      memory,
                      memory + samples,
                      memory + 2 * (size_t)samples,
                      memory + 3 * (size_t)samples,
                      memory + 4 * (size_t)samples,
                      memory};
    if (method == CM_PREFILTER_SPIRAL || method == CM_PREFILTER_AUTO)
    {
        make_spiral(alpha_squared, samples, blur + BLUR_SPIRAL, lobe);
    }
    else
    {
        make_hammersley(alpha_squared, samples, blur + BLUR_HAMMERSLEY, lobe);
    }
    return CM_OK;
}
