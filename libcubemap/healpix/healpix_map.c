/* SPDX-License-Identifier: MIT
 *
 * HEALPix: maps of another resolution or order. A map of any size is made in blocks, through numbers in
 * NESTED, in which the parts of a pixel stand in a row.
 */
#include "healpix_object.h"

#include <float.h>

/* A map of either precision. */
typedef struct map_values
{
    const void *values;
    int is_narrow; /* float, else double */
} map_values;

static double value_at(map_values map, int64_t pixel)
{
    return map.is_narrow ? (double)((const float *)map.values)[pixel]
                         : ((const double *)map.values)[pixel];
}

static void put_value(void *map, int is_narrow, int64_t pixel, double value)
{
    if (is_narrow)
    {
        ((float *)map)[pixel] = (float)value;
    }
    else
    {
        ((double *)map)[pixel] = value;
    }
}

static int is_good(double value)
{
    return isfinite(value) && !(fabs(value - CM_HEALPIX_UNSEEN) <= -1e-5 * CM_HEALPIX_UNSEEN);
}

/* What is common to the pixels of a result. */
typedef struct regrading
{
    const cm_healpix *from;
    const cm_healpix *to;
    map_values map;
    int is_pessimistic;
    double bad;
    double divisor;
    int coarser; /* two to this is the number of parts of a pixel of the result */
    int finer;   /* or of one of the map */
} regrading;

typedef int64_t pixels[CM_BLOCK];
typedef double values[CM_BLOCK];

/* From NESTED to the map's order. */
static void to_map_order(const regrading *r, size_t n, int64_t *pixel)
{
    if (r->from->order == CM_HEALPIX_RING)
    {
        cm_healpix_ring_from_nested_array(r->from, n, pixel, pixel);
    }
}

/* pixel: of the result, in NESTED. */
static void give_to_parts(const regrading *r, size_t n, const int64_t *pixel, double *result)
{
    pixels whole;
    for (size_t i = 0; i < n; i++)
    {
        whole[i] = pixel[i] >> r->finer;
    }
    to_map_order(r, n, whole);
    for (size_t i = 0; i < n; i++)
    {
        double value = value_at(r->map, whole[i]);
        result[i] = is_good(value) ? value / r->divisor : r->bad;
    }
}

/* A sum and what rounding took from it: by Knuth's sum, as which of two is larger nobody can foretell. */
typedef struct exact_sum
{
    double sum;
    double rest;
    int64_t count;
} exact_sum;

static void add_to(exact_sum *to, double value)
{
    double sum = to->sum + value;
    double taken = sum - to->sum;
    to->rest += (to->sum - (sum - taken)) + (value - taken);
    to->sum = sum;
    to->count++;
}

static double mean_of(const regrading *r, const exact_sum *sum)
{
    int64_t parts = (int64_t)1 << r->coarser;
    if (sum->count == 0 || (r->is_pessimistic && sum->count < parts))
    {
        return r->bad;
    }
    double total = sum->sum + sum->rest;
    /* sums beyond all numbers have no rest */
    return (isfinite(total) ? total : sum->sum) / (double)sum->count / r->divisor;
}

/* The parts of a pixel in NESTED, which stand in the map beside each other. */
static double mean_of_row(const regrading *r, int64_t pixel)
{
    exact_sum sum = {0.0, 0.0, 0};
    int64_t first = pixel << r->coarser;
    int64_t end = (pixel + 1) << r->coarser;
    for (int64_t part = first; part < end; part++)
    {
        double value = value_at(r->map, part);
        if (is_good(value))
        {
            add_to(&sum, value);
        }
    }
    return mean_of(r, &sum);
}

/* pixel: of the result, in NESTED. The parts of all of them are one row, which is taken in blocks. */
static void gather_parts(const regrading *r, size_t n, const int64_t *pixel, double *result)
{
    if (r->from->order == CM_HEALPIX_NESTED)
    {
        for (size_t i = 0; i < n; i++)
        {
            result[i] = mean_of_row(r, pixel[i]);
        }
        return;
    }
    exact_sum sums[CM_BLOCK] = {{0.0, 0.0, 0}};
    pixels part;
    int64_t parts = (int64_t)1 << r->coarser;
    int64_t total = (int64_t)n << r->coarser;
    for (int64_t done = 0; done < total; done += CM_BLOCK)
    {
        size_t count = total - done < CM_BLOCK ? (size_t)(total - done) : CM_BLOCK;
        for (size_t i = 0; i < count; i++)
        {
            int64_t at = done + (int64_t)i;
            part[i] = (pixel[at >> r->coarser] << r->coarser) + (at & (parts - 1));
        }
        cm_healpix_ring_from_nested_array(r->from, count, part, part);
        for (size_t i = 0; i < count; i++)
        {
            double value = value_at(r->map, part[i]);
            if (is_good(value))
            {
                add_to(&sums[(done + (int64_t)i) >> r->coarser], value);
            }
        }
    }
    for (size_t i = 0; i < n; i++)
    {
        result[i] = mean_of(r, &sums[i]);
    }
}

static void regrade_block(const regrading *r, size_t n, int64_t first, double *result)
{
    pixels pixel;
    for (size_t i = 0; i < n; i++)
    {
        pixel[i] = first + (int64_t)i;
    }
    if (r->to->order == CM_HEALPIX_RING)
    {
        cm_healpix_nested_from_ring_array(r->to, n, pixel, pixel);
    }
    if (r->coarser > 0)
    {
        gather_parts(r, n, pixel, result);
    }
    else
    {
        give_to_parts(r, n, pixel, result);
    }
}

/* The same pixels, of which (nside / nside)^power is 1: by vectors, as nothing but memory is to be waited for. */
static void copy_doubles(int64_t n, const double *map, double bad, double *result)
{
    for (int64_t i = 0; i < n; i++)
    {
        result[i] = is_good(map[i]) ? map[i] : bad;
    }
}

/* The least and the greatest float that are taken for CM_HEALPIX_UNSEEN: so that floats need not become doubles. */
static void find_unseen_floats(float ends[2])
{
    for (int side = 0; side < 2; side++)
    {
        const float beyond = side == 0 ? -INFINITY : INFINITY;
        ends[side] = (float)CM_HEALPIX_UNSEEN;
        for (float next = ends[side]; !is_good((double)next); next = nextafterf(next, beyond))
        {
            ends[side] = next;
        }
    }
}

static void copy_floats(int64_t n, const float *map, float bad, float *result)
{
    float unseen[2];
    find_unseen_floats(unseen);
    const float least = unseen[0], most = unseen[1];
    for (int64_t i = 0; i < n; i++)
    {
        const int is_unseen = (map[i] >= least) & (map[i] <= most);
        const int is_taken = (fabsf(map[i]) <= FLT_MAX) & !is_unseen;
        result[i] = is_taken ? map[i] : bad;
    }
}

static void regrade_blocks(const regrading *r, void *result)
{
    for (int64_t done = 0; done < r->to->count; done += CM_BLOCK)
    {
        values made;
        size_t n = r->to->count - done < CM_BLOCK ? (size_t)(r->to->count - done) : CM_BLOCK;
        regrade_block(r, n, done, made);
        for (size_t i = 0; i < n; i++)
        {
            put_value(result, r->map.is_narrow, done + (int64_t)i, made[i]);
        }
    }
}

static cm_status regrade(const cm_healpix *from, map_values map, const cm_healpix *to, void *result,
                         const cm_healpix_regrade_options *options)
{
    static const cm_healpix_regrade_options none = {.size = sizeof none};
    const cm_healpix_regrade_options *o = options == NULL ? &none : options;
    if (from == NULL || to == NULL || map.values == NULL || result == NULL ||
        o->size != sizeof *o || !isfinite(o->power))
    {
        return CM_ERROR_ARGUMENT;
    }
    int is_same = from->nside == to->nside;
    /* what is no power of two is in RING */
    if (!(from->is_power && to->is_power) && !is_same)
    {
        return CM_ERROR_PIXEL;
    }
    int shift = 2 * ((int)from->shift - (int)to->shift);
    const regrading r = {
        .from = from,
        .to = to,
        .map = map,
        .is_pessimistic = o->is_pessimistic,
        .bad = o->bad_is_nan ? (double)NAN : CM_HEALPIX_UNSEEN,
        .divisor = o->power == 0.0 ? 1.0 : pow((double)from->nside / (double)to->nside, o->power),
        .coarser = shift > 0 ? shift : 0,
        .finer = shift < 0 ? -shift : 0};
    if (!is_same || from->order != to->order)
    {
        regrade_blocks(&r, result);
    }
    else if (map.is_narrow)
    {
        copy_floats(from->count, map.values, (float)r.bad, result);
    }
    else
    {
        copy_doubles(from->count, map.values, r.bad, result);
    }
    return CM_OK;
}

cm_status cm_healpix_regrade(const cm_healpix *from, const double *map, const cm_healpix *to,
                             double *result, const cm_healpix_regrade_options *options)
{
    return regrade(from, (map_values){map, 0}, to, result, options);
}

cm_status cm_healpix_regrade_f32(const cm_healpix *from, const float *map, const cm_healpix *to,
                                 float *result, const cm_healpix_regrade_options *options)
{
    return regrade(from, (map_values){map, 1}, to, result, options);
}
