/* SPDX-License-Identifier: MIT
 *
 * Longitude and latitude to direction and back for any number of points, and what mapping.h offers in them.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "libcubemap/batch/mapping_object.h"
#include "libcubemap/mapping/exception_flags.h"
#include "libcubemap/mapping/set_choice.h"
#include "lonlat_block.h"

#include <string.h>

/* CM_BLOCK points at most, in room for whole vectors. */
typedef double block[CM_BLOCK];

static size_t whole_vectors(const cm_batch_set *set, size_t n)
{
    return (n + set->lanes_f64 - 1) / set->lanes_f64 * set->lanes_f64;
}

/* n numbers and zeros up to whole vectors. */
static void fill(block to, const double *from, size_t n, size_t whole)
{
    memcpy(to, from, n * sizeof *to);
    memset(to + n, 0, (whole - n) * sizeof *to);
}

void cm_block_of_lonlats(const cm_batch_set *set, size_t n, const double *lon, const double *lat,
                         double *x, double *y, double *z)
{
    block a, b;
    size_t whole = whole_vectors(set, n);
    fill(a, lon, n, whole);
    fill(b, lat, n, whole);
    set->lonlat->directions(whole, a, b, x, y, z);
    for (size_t i = 0; i < n; i++)
    {
        if (x[i] != x[i] && fabs(a[i]) > CM_LONLAT_WHOLE)
        {
            double direction[3];
            cm_direction_from_lonlat(a[i], b[i], direction);
            x[i] = direction[0];
            y[i] = direction[1];
            z[i] = direction[2];
        }
    }
}

void cm_block_to_lonlats(const cm_batch_set *set, size_t n, double *x, double *y, double *z,
                         double *lon, double *lat)
{
    block a, b;
    size_t whole = whole_vectors(set, n);
    memset(x + n, 0, (whole - n) * sizeof *x);
    memset(y + n, 0, (whole - n) * sizeof *y);
    memset(z + n, 0, (whole - n) * sizeof *z);
    set->lonlat->lonlats(whole, x, y, z, a, b);
    memcpy(lon, a, n * sizeof *lon);
    memcpy(lat, b, n * sizeof *lat);
}

/* What the environment names, or the best. */
static const cm_batch_set *any_set(void)
{
    const cm_batch_set *set = cm_batch_set_find(NULL);
    return set != NULL ? set : cm_batch_set_find(cm_instructions_at(cm_instructions_count() - 1));
}

/* Lengths whose squares neither overflow nor lose digits; NaN is none. */
static int is_plain(double x, double y, double z)
{
    const double square = x * x + y * y + z * z;
    return square > 1e-200 && square < 1e200;
}

/* Are all? In numbers, of which every machine has vectors. */
static int are_plain(size_t n, const double *x, const double *y, const double *z)
{
    double good[2] = {0.0, 0.0};
    for (size_t i = 0; i + 2 <= n; i += 2)
    {
        for (size_t k = 0; k < 2; k++)
        {
            const size_t at = i + k;
            const double square = x[at] * x[at] + y[at] * y[at] + z[at] * z[at];
            good[k] += square > 1e-200 ? 1.0 : 0.0;
            good[k] += square < 1e200 ? 1.0 : 0.0;
        }
    }
    return good[0] + good[1] == 2.0 * (double)(n / 2 * 2) &&
           (n % 2 == 0 || is_plain(x[n - 1], y[n - 1], z[n - 1]));
}

/* n <= CM_BLOCK directions of any length. */
static void lonlats_of_block(const cm_batch_set *set, size_t n, const double *x, const double *y,
                             const double *z, double *lon, double *lat)
{
    block a, b, c;
    memcpy(a, x, n * sizeof *a);
    memcpy(b, y, n * sizeof *b);
    memcpy(c, z, n * sizeof *c);
    block along, height;
    const int good = are_plain(n, x, y, z);
    cm_block_to_lonlats(set, n, a, b, c, along, height);
    for (size_t i = 0; !good && i < n; i++)
    {
        if (!is_plain(x[i], y[i], z[i]))
        {
            const double direction[3] = {x[i], y[i], z[i]};
            double lonlat[2];
            cm_lonlat_from_direction(direction, lonlat);
            along[i] = lonlat[0];
            height[i] = lonlat[1];
        }
    }
    memcpy(lon, along, n * sizeof *lon);
    memcpy(lat, height, n * sizeof *lat);
}

/* ---- Public functions, documented in <cubemap/direction.h> and <cubemap/mapping.h> ---- */

void cm_direction_from_lonlat_array(size_t n, const double *lon, const double *lat, double *x,
                                    double *y, double *z)
{
    const cm_exceptions held = cm_exceptions_hold();
    const cm_batch_set *set = any_set();
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        block a, b, c;
        size_t count = n - done < CM_BLOCK ? n - done : CM_BLOCK;
        cm_block_of_lonlats(set, count, lon + done, lat + done, a, b, c);
        memcpy(x + done, a, count * sizeof *x);
        memcpy(y + done, b, count * sizeof *y);
        memcpy(z + done, c, count * sizeof *z);
    }
    cm_exceptions_restore(held);
}

void cm_lonlat_from_direction_array(size_t n, const double *x, const double *y, const double *z,
                                    double *lon, double *lat)
{
    const cm_exceptions held = cm_exceptions_hold();
    const cm_batch_set *set = any_set();
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        size_t count = n - done < CM_BLOCK ? n - done : CM_BLOCK;
        lonlats_of_block(set, count, x + done, y + done, z + done, lon + done, lat + done);
    }
    cm_exceptions_restore(held);
}

uint8_t cm_forward_lonlat(const cm_mapping *mapping, double lon, double lat, double uv[2])
{
    double direction[3];
    cm_direction_from_lonlat(lon, lat, direction);
    return cm_forward(mapping, direction, uv);
}

void cm_inverse_lonlat(const cm_mapping *mapping, uint8_t face, const double uv[2],
                       double lonlat[2])
{
    double direction[3];
    cm_inverse(mapping, face, uv, direction);
    cm_lonlat_from_direction(direction, lonlat);
}

void cm_forward_lonlat_array(const cm_mapping *mapping, size_t n, const double *lon,
                             const double *lat, uint8_t *face, double *u, double *v)
{
    const cm_exceptions held = cm_exceptions_hold();
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        block x, y, z;
        size_t count = n - done < CM_BLOCK ? n - done : CM_BLOCK;
        cm_block_of_lonlats(mapping->set, count, lon + done, lat + done, x, y, z);
        cm_forward_array(mapping, count, x, y, z, face + done, u + done, v + done);
    }
    cm_exceptions_restore(held);
}

void cm_inverse_lonlat_array(const cm_mapping *mapping, size_t n, const uint8_t *face,
                             const double *u, const double *v, double *lon, double *lat)
{
    const cm_exceptions held = cm_exceptions_hold();
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        block x, y, z;
        size_t count = n - done < CM_BLOCK ? n - done : CM_BLOCK;
        cm_inverse_array(mapping, count, face + done, u + done, v + done, x, y, z);
        cm_block_to_lonlats(mapping->set, count, x, y, z, lon + done, lat + done);
    }
    cm_exceptions_restore(held);
}
