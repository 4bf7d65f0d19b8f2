/* SPDX-License-Identifier: MIT
 *
 * The pixels of HEALPix in quadruple precision, from the printed formulas (Gorski et al. 2005, sections 4 and
 * 5, and the numbering of NESTED), by no text of this library: the truth about where a point is, and where a
 * centre. nside is a power of two. Needs gcc's libquadmath.
 */
#ifndef TRUTH_QUAD_HEALPIX_H
#define TRUTH_QUAD_HEALPIX_H

#include "sphere.h"

#include <math.h>
#include <quadmath.h>
#include <stdint.h>

/* the suffix Q of literals */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"

__extension__ typedef __float128 healpix_quad;

/* Where a point is: base pixel, column and row; and how far from the nearest border of its pixel, in sides of
 * a pixel. */
typedef struct healpix_quad_place
{
    int base;
    int64_t x;
    int64_t y;
    double margin;
} healpix_quad_place;

static inline int64_t healpix_quad_nested(int64_t nside, const healpix_quad_place *at)
{
    int64_t number = 0;
    for (int i = 0; i < 30; i++)
    {
        number |= (at->x >> i & 1) << 2 * i | (at->y >> i & 1) << (2 * i + 1);
    }
    return at->base * nside * nside + number;
}

/* What differs from a whole number by less than these formulas' own rounding is one: a border. */
static inline healpix_quad healpix_quad_snapped(healpix_quad a)
{
    healpix_quad whole = roundq(a);
    healpix_quad scale = fmaxq(1.0Q, fabsq(a));
    return fabsq(a - whole) < 1e-30Q * scale ? whole : a;
}

static inline double healpix_quad_distance(healpix_quad a)
{
    return (double)fabsq(a - roundq(a));
}

/* From |z|'s sign, |z| and the distance from the axis, on the unit sphere, and the longitude: the nearest quarter
 * of a turn and what there is from there, in quarters, from -1/2 to 1/2. */
static inline healpix_quad_place healpix_quad_locate(int64_t nside, int south, healpix_quad z,
                                                     healpix_quad rho, int nearest, healpix_quad h)
{
    healpix_quad n = (healpix_quad)nside;
    healpix_quad_place at;
    if (z <= 2.0Q / 3.0Q)
    {
        healpix_quad latitude = (south ? -0.75Q : 0.75Q) * z;
        healpix_quad ascending = healpix_quad_snapped(n * (4.5Q + h - latitude));
        healpix_quad descending = healpix_quad_snapped(n * (4.5Q + h + latitude));
        at.margin = fmin(healpix_quad_distance(ascending), healpix_quad_distance(descending));
        int64_t up = (int64_t)floorq(ascending) + nearest * nside;
        int64_t down = (int64_t)floorq(descending) + nearest * nside;
        int64_t base_up = up / nside;
        int64_t base_down = down / nside;
        at.base = (int)(base_up == base_down  ? 4 + base_up % 4
                        : base_up < base_down ? base_up % 4
                                              : 8 + base_down % 4);
        at.x = down % nside;
        at.y = nside - 1 - up % nside;
        return at;
    }
    int quarter = (nearest + (h < 0.0Q ? 3 : 4)) % 4;
    healpix_quad part = h < 0.0Q ? 1.0Q + h : h;
    healpix_quad rest = h < 0.0Q ? -h : 1.0Q - h;
    healpix_quad sigma = n * rho * sqrtq(3.0Q / (1.0Q + z));
    healpix_quad along = healpix_quad_snapped(part * sigma);
    healpix_quad back = healpix_quad_snapped(rest * sigma);
    at.margin = fmin(healpix_quad_distance(along), healpix_quad_distance(back));
    int64_t a = (int64_t)floorq(along);
    int64_t b = (int64_t)floorq(back);
    at.base = south ? 8 + quarter : quarter;
    at.x = south ? a : nside - 1 - b;
    at.y = south ? b : nside - 1 - a;
    return at;
}

static inline healpix_quad_place healpix_quad_place_of_direction(int64_t nside, const double d[3])
{
    healpix_quad x = (healpix_quad)d[0];
    healpix_quad y = (healpix_quad)d[1];
    healpix_quad z = (healpix_quad)d[2];
    healpix_quad rho = sqrtq(x * x + y * y);
    healpix_quad length = sqrtq(rho * rho + z * z);
    int is_x = fabsq(x) >= fabsq(y);
    int is_minus = signbitq(is_x ? x : y) != 0;
    healpix_quad along = is_x ? y : -x;
    healpix_quad h = atan2q(is_minus ? -along : along, fabsq(is_x ? x : y)) / M_PI_2q;
    return healpix_quad_locate(nside, z < 0.0Q, fabsq(z) / length, rho / length,
                               (is_x ? 0 : 1) + (is_minus ? 2 : 0), h);
}

static inline healpix_quad_place healpix_quad_place_of(int64_t nside, int south, healpix_quad z,
                                                       healpix_quad rho, double phi)
{
    healpix_quad quarters = (healpix_quad)phi / M_PI_2q;
    healpix_quad nearest = roundq(quarters);
    int quarter = (int)(nearest - 4.0Q * floorq(nearest / 4.0Q));
    return healpix_quad_locate(nside, south, z, rho, quarter, quarters - nearest);
}

static inline healpix_quad_place healpix_quad_place_of_angles(int64_t nside, double theta,
                                                              double phi)
{
    healpix_quad z = cosq((healpix_quad)theta);
    return healpix_quad_place_of(nside, z < 0.0Q, fabsq(z), sinq((healpix_quad)theta), phi);
}

static inline healpix_quad_place healpix_quad_place_of_lonlat(int64_t nside, double lon, double lat)
{
    return healpix_quad_place_of(nside, lat < 0.0, fabsq(sinq((healpix_quad)lat)),
                                 cosq((healpix_quad)lat), lon);
}

static inline int64_t healpix_quad_even_bits(int64_t bits)
{
    int64_t result = 0;
    for (int i = 0; i < 31; i++)
    {
        result |= (bits >> 2 * i & 1) << i;
    }
    return result;
}

/* A point of a base pixel, x and y from its south corner in sides of a pixel: colatitude and longitude, and a
 * unit direction. */
static inline void healpix_quad_point(int64_t nside, int base, healpix_quad x, healpix_quad y,
                                      healpix_quad angles[2], healpix_quad direction[3])
{
    healpix_quad n = (healpix_quad)nside;
    healpix_quad ring = (healpix_quad)(base / 4 + 2) - (x + y) / n;
    healpix_quad across = (x - y) / n;
    healpix_quad eighths = (healpix_quad)(2 * (base % 4) + (base / 4 == 1 ? 0 : 1));
    healpix_quad from_pole = ring < 1.0Q ? ring : ring > 3.0Q ? 4.0Q - ring : 0.0Q;
    healpix_quad z;
    healpix_quad rho;
    if (ring < 1.0Q || ring > 3.0Q)
    {
        healpix_quad depth = from_pole * from_pole / 3.0Q;
        z = ring < 1.0Q ? 1.0Q - depth : depth - 1.0Q;
        rho = sqrtq(depth * (2.0Q - depth));
        eighths += from_pole > 0.0Q ? across / from_pole : 0.0Q;
    }
    else
    {
        z = 2.0Q * (2.0Q - ring) / 3.0Q;
        rho = sqrtq((1.0Q - z) * (1.0Q + z));
        eighths += across;
    }
    eighths += eighths < 0.0Q ? 8.0Q : 0.0Q;
    angles[0] = atan2q(rho, z);
    angles[1] = eighths * M_PI_4q;
    direction[0] = rho * cosq(angles[1]);
    direction[1] = rho * sinq(angles[1]);
    direction[2] = z;
}

/* The centre of a pixel, in NESTED. */
static inline void healpix_quad_centre(int64_t nside, int64_t nested, healpix_quad angles[2],
                                       healpix_quad direction[3])
{
    int64_t square = nside * nside;
    int64_t x = healpix_quad_even_bits(nested & (square - 1));
    int64_t y = healpix_quad_even_bits((nested & (square - 1)) >> 1);
    healpix_quad_point(nside, (int)(nested / square), (healpix_quad)x + 0.5Q,
                       (healpix_quad)y + 0.5Q, angles, direction);
}

/* The distance on Earth between a direction and a true one. */
static inline double healpix_quad_metres(const healpix_quad made[3], const healpix_quad truth[3])
{
    healpix_quad square = 0.0Q;
    for (int k = 0; k < 3; k++)
    {
        int i = (k + 1) % 3;
        int j = (k + 2) % 3;
        healpix_quad c = made[i] * truth[j] - made[j] * truth[i];
        square += c * c;
    }
    return EARTH_RADIUS * (double)sqrtq(square);
}

static inline double healpix_quad_metres_of_direction(const double made[3],
                                                      const healpix_quad truth[3])
{
    const healpix_quad wide[3] = {(healpix_quad)made[0], (healpix_quad)made[1],
                                  (healpix_quad)made[2]};
    return healpix_quad_metres(wide, truth);
}

static inline double healpix_quad_metres_of_angles(double theta, double phi,
                                                   const healpix_quad truth[3])
{
    healpix_quad rho = sinq((healpix_quad)theta);
    const healpix_quad wide[3] = {rho * cosq((healpix_quad)phi), rho * sinq((healpix_quad)phi),
                                  cosq((healpix_quad)theta)};
    return healpix_quad_metres(wide, truth);
}

#pragma GCC diagnostic pop

#endif
