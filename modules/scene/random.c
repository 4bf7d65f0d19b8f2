/* SPDX-License-Identifier: MIT
 *
 * Counted random numbers, alone and in arrays.
 */
#include <cubemap/random.h>

#include "random_set.h"

#define CM_SET_IS_SCALAR 1
#include "random_lanes.inc"

#include "exact_logarithm.inc"
#include "normal_numbers.inc"
#include "philox.inc"
#include "poisson_numbers.inc"

/* So many are made before an instruction set is found. */
#define FEW 24

void cm_random_block(uint64_t seed, uint32_t view, uint32_t pixel, uint32_t sample, uint32_t block,
                     uint32_t words[4])
{
    const cm_random_place of = {seed, view, sample};
    const philox_words w = philox(&of, pixel, block);
    for (int i = 0; i < 4; i++)
    {
        words[i] = (uint32_t)w.at[i];
    }
}

/* NULL: without one, for few, and where the library is to be small. Where the environment names a set that is none, numbers are
 * the same without it. */
static const cm_random_set *set_for(size_t n)
{
#ifdef CM_SMALL
    (void)n;
    return NULL;
#else
    const cm_random_set *set = n <= FEW ? NULL : cm_random_set_find(NULL);
    return n > FEW && set == NULL ? &cm_random_scalar : set;
#endif
}

/* ---- Uniform numbers ---- */

static double uniform_of(const cm_random_place *of, uint32_t pixel, uint32_t block)
{
    const philox_words w = philox(of, pixel, block);
    return fraction_of(w.at[0], w.at[1]);
}

double cm_random_uniform(uint64_t seed, uint32_t view, uint32_t pixel, uint32_t sample)
{
    const cm_random_place of = {seed, view, sample};
    return uniform_of(&of, pixel, UNIFORM_BLOCKS);
}

void cm_random_uniform_array(uint64_t seed, uint32_t view, uint32_t first, uint32_t sample,
                             size_t n, double *value)
{
    const cm_random_place of = {seed, view, sample};
    const cm_random_set *set = set_for(n);
    if (set != NULL)
    {
        set->uniform(&of, first, n, value);
        return;
    }
    for (size_t i = 0; i < n; i++)
    {
        value[i] = uniform_of(&of, first + (uint32_t)i, UNIFORM_BLOCKS);
    }
}

/* ---- Normal numbers ---- */

static double normal_of(const cm_random_place *of, uint32_t pixel)
{
    const double p = uniform_of(of, pixel, NORMAL_BLOCKS);
    return is_in_middle(p) ? middle_of(p) : side_of(p);
}

double cm_random_normal(uint64_t seed, uint32_t view, uint32_t pixel, uint32_t sample)
{
    const cm_random_place of = {seed, view, sample};
    return normal_of(&of, pixel);
}

void cm_random_normal_array(uint64_t seed, uint32_t view, uint32_t first, uint32_t sample, size_t n,
                            double *value)
{
    const cm_random_place of = {seed, view, sample};
    const cm_random_set *set = set_for(n);
    if (set != NULL)
    {
        set->normal(&of, first, n, value);
        return;
    }
    for (size_t i = 0; i < n; i++)
    {
        value[i] = normal_of(&of, first + (uint32_t)i);
    }
}

/* ---- Counts of Poisson's distribution ---- */

static double by_rejection(const cm_random_place *of, uint32_t pixel, double mean)
{
    for (uint32_t turn = 0; turn < TURNS_MOST; turn++)
    {
        const hat_points p = points_of(of, pixel, mean, turn);
        if (p.is_inside || (!p.is_outside && are_under(mean, p.k, p.edge, p.v)))
        {
            return p.k;
        }
    }
    return floor(mean); /* never met */
}

static double poisson_of(const cm_random_place *of, uint32_t pixel, double mean)
{
    if (!(mean >= 0.0 && mean < (double)INFINITY))
    {
        return (double)NAN;
    }
    if (mean >= INVERSION_BELOW)
    {
        return by_rejection(of, pixel, mean);
    }
    return by_inversion(uniform_of(of, pixel, POISSON_BLOCKS), mean, exact_exp(-mean));
}

double cm_random_poisson(uint64_t seed, uint32_t view, uint32_t pixel, uint32_t sample, double mean)
{
    const cm_random_place of = {seed, view, sample};
    return poisson_of(&of, pixel, mean);
}

void cm_random_poisson_array(uint64_t seed, uint32_t view, uint32_t first, uint32_t sample,
                             size_t n, const double *mean, double *count)
{
    const cm_random_place of = {seed, view, sample};
    const cm_random_set *set = set_for(n);
    if (set != NULL)
    {
        set->poisson(&of, first, n, mean, count);
        return;
    }
    for (size_t i = 0; i < n; i++)
    {
        count[i] = poisson_of(&of, first + (uint32_t)i, mean[i]);
    }
}
