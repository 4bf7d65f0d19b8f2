/* SPDX-License-Identifier: MIT
 *
 * Longitude and latitude to direction and back for any number of points, and what mapping.h offers in them.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "libcubemap/batch/mapping_object.h"
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

/* ---- Public functions, documented in <cubemap/mapping.h> ---- */

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
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        block x, y, z;
        size_t count = n - done < CM_BLOCK ? n - done : CM_BLOCK;
        cm_block_of_lonlats(mapping->set, count, lon + done, lat + done, x, y, z);
        cm_forward_array(mapping, count, x, y, z, face + done, u + done, v + done);
    }
}

void cm_inverse_lonlat_array(const cm_mapping *mapping, size_t n, const uint8_t *face,
                             const double *u, const double *v, double *lon, double *lat)
{
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        block x, y, z;
        size_t count = n - done < CM_BLOCK ? n - done : CM_BLOCK;
        cm_inverse_array(mapping, count, face + done, u + done, v + done, x, y, z);
        cm_block_to_lonlats(mapping->set, count, x, y, z, lon + done, lat + done);
    }
}
