/* SPDX-License-Identifier: MIT */
#include <cubemap/environment.h>

#include <string.h>

#include "harmonics_block.h"

size_t cm_harmonics_count(uint32_t degree)
{
    return ((size_t)degree + 1) * ((size_t)degree + 1);
}

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* The place of order 0 of a degree. */
static size_t middle_of(uint32_t degree)
{
    return (size_t)degree * ((size_t)degree + 1);
}

static void put_basis(const cm_harmonics_block *block, size_t n, size_t count, double *value)
{
    const size_t middle = middle_of(block->degree);
    for (size_t i = 0; i < n; i++)
    {
        const double legendre = block->legendre[i] / CM_HARMONICS_SCALE;
        value[i * count + middle + block->order] = legendre * block->cosine_m[i];
        if (block->order > 0)
        {
            value[i * count + middle - block->order] = legendre * block->sine_m[i];
        }
    }
}

cm_status cm_harmonics_basis(uint32_t degree, size_t n, const double *x, const double *y,
                             const double *z, double *value)
{
    if (n > 0 && (x == NULL || y == NULL || z == NULL || value == NULL))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (degree > CM_HARMONICS_DEGREE_MAX)
    {
        return CM_ERROR_RANGE;
    }
    const size_t count = cm_harmonics_count(degree);
    cm_harmonics_block block;
    for (size_t first = 0; first < n; first += CM_HARMONICS_BLOCK)
    {
        const size_t some = least(n - first, CM_HARMONICS_BLOCK);
        cm_harmonics_block_begin(&block, some, x + first, y + first, z + first);
        for (uint32_t m = 0; m <= degree; m++)
        {
            put_basis(&block, some, count, value + first * count);
            while (block.degree < degree)
            {
                cm_harmonics_block_next_degree(&block);
                put_basis(&block, some, count, value + first * count);
            }
            cm_harmonics_block_next_order(&block);
        }
    }
    return CM_OK;
}

/* Sums of one order, before they are multiplied by its cosines and sines. */
typedef struct order_sums
{
    double even[CM_ENVIRONMENT_CHANNELS_MAX][CM_HARMONICS_BLOCK];
    double odd[CM_ENVIRONMENT_CHANNELS_MAX][CM_HARMONICS_BLOCK];
} order_sums;

static void add_degree(const cm_harmonics_block *block, uint32_t channels,
                       const double *coefficients, order_sums *sums)
{
    const size_t middle = middle_of(block->degree);
    for (uint32_t c = 0; c < channels; c++)
    {
        const double even = coefficients[(middle + block->order) * channels + c];
        const double odd = coefficients[(middle - block->order) * channels + c];
        double *restrict to_even = sums->even[c];
        double *restrict to_odd = sums->odd[c];
        for (size_t i = 0; i < CM_HARMONICS_BLOCK; i++)
        {
            to_even[i] += even * block->legendre[i];
            to_odd[i] += odd * block->legendre[i];
        }
    }
}

static void evaluate_block(uint32_t degree, uint32_t channels, const double *coefficients,
                           cm_harmonics_block *block,
                           double value[CM_ENVIRONMENT_CHANNELS_MAX][CM_HARMONICS_BLOCK])
{
    order_sums sums;
    memset(value, 0, sizeof(double[CM_ENVIRONMENT_CHANNELS_MAX][CM_HARMONICS_BLOCK]));
    for (uint32_t m = 0; m <= degree; m++)
    {
        memset(&sums, 0, sizeof sums);
        add_degree(block, channels, coefficients, &sums);
        while (block->degree < degree)
        {
            cm_harmonics_block_next_degree(block);
            add_degree(block, channels, coefficients, &sums);
        }
        for (uint32_t c = 0; c < channels; c++)
        {
            for (size_t i = 0; i < CM_HARMONICS_BLOCK; i++)
            {
                /* the sine of order 0 is 0 */
                value[c][i] +=
                    (sums.even[c][i] * block->cosine_m[i] + sums.odd[c][i] * block->sine_m[i]) /
                    CM_HARMONICS_SCALE;
            }
        }
        cm_harmonics_block_next_order(block);
    }
}

cm_status cm_harmonics_evaluate(uint32_t degree, uint32_t channels, const double *coefficients,
                                size_t n, const double *x, const double *y, const double *z,
                                double *value)
{
    if (coefficients == NULL || (n > 0 && (x == NULL || y == NULL || z == NULL || value == NULL)))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (degree > CM_HARMONICS_DEGREE_MAX || channels < 1 || channels > CM_ENVIRONMENT_CHANNELS_MAX)
    {
        return CM_ERROR_RANGE;
    }
    cm_harmonics_block block;
    double some_values[CM_ENVIRONMENT_CHANNELS_MAX][CM_HARMONICS_BLOCK];
    for (size_t first = 0; first < n; first += CM_HARMONICS_BLOCK)
    {
        const size_t some = least(n - first, CM_HARMONICS_BLOCK);
        cm_harmonics_block_begin(&block, some, x + first, y + first, z + first);
        evaluate_block(degree, channels, coefficients, &block, some_values);
        for (size_t i = 0; i < some; i++)
        {
            for (uint32_t c = 0; c < channels; c++)
            {
                value[(first + i) * channels + c] = some_values[c][i];
            }
        }
    }
    return CM_OK;
}
