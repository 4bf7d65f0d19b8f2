/* SPDX-License-Identifier: MIT */
#include "harmonics_block.h"

#include <math.h>

/* 1 / sqrt(4 pi) */
#define CONSTANT 0.28209479177387814

static void put_direction(cm_harmonics_block *block, size_t i, double x, double y, double z)
{
    const double largest = fmax(fmax(fabs(x), fabs(y)), fabs(z));
    const int is_direction = largest > 0.0 && isfinite(x) && isfinite(y) && isfinite(z);
    const double a = is_direction ? x / largest : 0.0;
    const double b = is_direction ? y / largest : 0.0;
    const double c = is_direction ? z / largest : 1.0;
    const double across = sqrt(a * a + b * b);
    const double length = sqrt(a * a + b * b + c * c);
    /* far below 1e-154 the square vanishes, and the hypotenuse is a matter of the larger one */
    const double distance = across > 1e-140 ? across : hypot(a, b);
    block->cosine[i] = c / length;
    block->sine[i] = distance / length;
    block->along[i] = distance > 0.0 ? a / distance : 1.0;
    block->aside[i] = distance > 0.0 ? b / distance : 0.0;
    block->sector[i] = is_direction ? CONSTANT * CM_HARMONICS_SCALE : (double)NAN;
}

void cm_harmonics_block_begin(cm_harmonics_block *block, size_t n, const double *x, const double *y,
                              const double *z)
{
    for (size_t i = 0; i < CM_HARMONICS_BLOCK; i++)
    {
        put_direction(block, i, i < n ? x[i] : 0.0, i < n ? y[i] : 0.0, i < n ? z[i] : 1.0);
        block->previous[i] = 0.0;
        block->legendre[i] = block->sector[i];
        block->cosine_m[i] = 1.0;
        block->sine_m[i] = 0.0;
    }
    block->order = 0;
    block->degree = 0;
}

void cm_harmonics_block_next_order(cm_harmonics_block *block)
{
    const uint32_t order = block->order + 1;
    /* with sqrt(2) from order 1 on */
    const double factor = order == 1 ? sqrt(3.0) : sqrt((2.0 * order + 1.0) / (2.0 * order));
    for (size_t i = 0; i < CM_HARMONICS_BLOCK; i++)
    {
        const double cosine = block->cosine_m[i];
        const double sine = block->sine_m[i];
        block->cosine_m[i] = cosine * block->along[i] - sine * block->aside[i];
        block->sine_m[i] = sine * block->along[i] + cosine * block->aside[i];
        block->sector[i] *= factor * block->sine[i];
        block->previous[i] = 0.0;
        block->legendre[i] = block->sector[i];
    }
    block->order = order;
    block->degree = order;
}

void cm_harmonics_block_next_degree(cm_harmonics_block *block)
{
    const double l = block->degree + 1.0;
    const double m = block->order;
    const double a = sqrt((4.0 * l * l - 1.0) / (l * l - m * m));
    const double before = (l - 1.0) * (l - 1.0);
    const double b = l > m + 1.0 ? a * sqrt((before - m * m) / (4.0 * before - 1.0)) : 0.0;
    for (size_t i = 0; i < CM_HARMONICS_BLOCK; i++)
    {
        const double next = a * block->cosine[i] * block->legendre[i] - b * block->previous[i];
        block->previous[i] = block->legendre[i];
        block->legendre[i] = next;
    }
    block->degree++;
}
