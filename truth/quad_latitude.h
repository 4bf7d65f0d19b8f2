/* SPDX-License-Identifier: MIT
 *
 * Auxiliary latitudes in quadruple precision, by other formulas than the library's: the authalic and conformal
 * ones as Snyder (1987) has them, from the geographic latitude, and the rectifying one by quadrature. Where they
 * cancel they lose eight digits at most of 34, for flattenings from -99 to 0.99.
 */
#ifndef TRUTH_QUAD_LATITUDE_H
#define TRUTH_QUAD_LATITUDE_H

#include <cubemap/cubemap.h>
#include <quadmath.h>
#include <stdio.h>
#include <stdlib.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"

__extension__ typedef __float128 latitude_quad;

#define GAUSS_POINTS 24
#define GAUSS_PIECES 8

/* Gauss-Legendre on [-1, 1]. */
static latitude_quad gauss_node[GAUSS_POINTS];
static latitude_quad gauss_weight[GAUSS_POINTS];

static void gauss_prepare(void)
{
    for (int i = 0; i < GAUSS_POINTS; i++)
    {
        latitude_quad x = cosq(M_PIq * (i + 0.75Q) / (GAUSS_POINTS + 0.5Q));
        latitude_quad slope = 0.0Q;
        for (int step = 0; step < 12; step++)
        {
            latitude_quad before = 1.0Q;
            latitude_quad now = x;
            for (int k = 2; k <= GAUSS_POINTS; k++)
            {
                latitude_quad next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
                before = now;
                now = next;
            }
            slope = GAUSS_POINTS * (x * now - before) / (x * x - 1.0Q);
            x -= now / slope;
        }
        gauss_node[i] = x;
        gauss_weight[i] = 2.0Q / ((1.0Q - x * x) * slope * slope);
    }
}

/* The integral of sqrt(cos^2 t + r^2 sin^2 t) from 0 to an angle, whose singularities are near 0 and pi for large r,
 * near pi / 2 for small ones: in pieces that grow from there. */
static latitude_quad gauss_arc(latitude_quad angle, latitude_quad r)
{
    latitude_quad sum = 0.0Q;
    latitude_quad narrow = r > 1.0Q ? 1.0Q / r : r;
    latitude_quad least = r > 1.0Q ? 0.0Q : M_PI_2q - angle; /* distance of the nearer end */
    latitude_quad most = r > 1.0Q ? angle : M_PI_2q;
    /* t or its complement is narrow sinh(w), so that the pieces are equal in w */
    latitude_quad from = asinhq(least / narrow);
    latitude_quad width = (asinhq(most / narrow) - from) / GAUSS_PIECES;
    for (int piece = 0; piece < GAUSS_PIECES; piece++)
    {
        for (int i = 0; i < GAUSS_POINTS; i++)
        {
            latitude_quad w = from + width * (piece + 0.5Q * (1.0Q + gauss_node[i]));
            latitude_quad grown = expq(w);
            latitude_quad shrunk = 1.0Q / grown;
            latitude_quad near = 0.5Q * narrow * (grown - shrunk);
            latitude_quad s, c;
            sincosq(near, &s, &c);
            latitude_quad h =
                r > 1.0Q ? sqrtq(c * c + r * r * s * s) : sqrtq(s * s + r * r * c * c);
            sum += gauss_weight[i] * h * narrow * 0.5Q * (grown + shrunk);
        }
    }
    return 0.5Q * width * sum;
}

/* The meridian from the equator (or the pole, with the ratio of the axes inverse) to an angle. Where that is far from
 * the singularities the pieces above would lose a small angle. */
static latitude_quad meridian(latitude_quad angle, latitude_quad r)
{
    if (r > 1.0Q || angle > 0.5Q)
    {
        return gauss_arc(angle, r);
    }
    latitude_quad sum = 0.0Q;
    for (int i = 0; i < GAUSS_POINTS; i++)
    {
        latitude_quad t = 0.5Q * angle * (1.0Q + gauss_node[i]);
        latitude_quad s, c;
        sincosq(t, &s, &c);
        sum += gauss_weight[i] * sqrtq(c * c + r * r * s * s);
    }
    return 0.5Q * angle * sum;
}

/* tan of a latitude from that of the geographic one, above 0. */
static latitude_quad quad_authalic(latitude_quad f, latitude_quad tangent)
{
    latitude_quad e2 = f * (2.0Q - f);
    latitude_quad e = sqrtq(fabsq(e2));
    latitude_quad c2 = 1.0Q / (1.0Q + tangent * tangent);
    latitude_quad s = tangent * sqrtq(c2);
    latitude_quad d = c2 / (1.0Q + s);
    latitude_quad k = (1.0Q - f) * (1.0Q - f);
    latitude_quad w2 = c2 + k * s * s;
    latitude_quad whole = e2 > 0.0Q ? atanhq(e) / e : atanq(e) / e;
    latitude_quad part = e2 > 0.0Q ? atanhq(e * s) / e : atanq(e * s) / e;
    latitude_quad y = e * d / (d + k * s);
    latitude_quad left = e2 > 0.0Q ? atanhq(y) / e : atanq(y) / e;
    latitude_quad zone = k * (s / w2 + part);
    latitude_quad all = 1.0Q + k * whole;
    latitude_quad cap = k * (d * (1.0Q + e2 * s) / (k * w2) + left);
    return zone / sqrtq(cap * (all + zone));
}

static latitude_quad quad_conformal(latitude_quad f, latitude_quad tangent)
{
    latitude_quad e2 = f * (2.0Q - f);
    latitude_quad e = sqrtq(fabsq(e2));
    latitude_quad length = sqrtq(1.0Q + tangent * tangent);
    latitude_quad s = tangent / length;
    latitude_quad g = e2 > 0.0Q ? e * atanhq(e * s) : -e * atanq(e * s);
    latitude_quad sigma = sinhq(g);
    return tangent * coshq(g) - sigma * length;
}

static latitude_quad quad_rectifying(latitude_quad f, latitude_quad tangent)
{
    latitude_quad r = 1.0Q / (1.0Q - f);
    latitude_quad beta = tangent / r;
    static latitude_quad known_r, known_whole;
    if (r != known_r)
    {
        known_r = r;
        known_whole = gauss_arc(M_PI_2q, r);
    }
    latitude_quad low = M_PI_2q * meridian(atanq(beta), r) / known_whole;
    if (low < M_PI_4q)
    {
        return tanq(low);
    }
    return 1.0Q / tanq(M_PI_2q * r * meridian(atanq(1.0Q / beta), 1.0Q / r) / known_whole);
}

static latitude_quad quad_from_geographic(latitude_quad f, cm_latitude to, latitude_quad tangent)
{
    switch (to)
    {
    case CM_LATITUDE_GEOGRAPHIC:
        return tangent;
    case CM_LATITUDE_GEOCENTRIC:
        return tangent * (1.0Q - f) * (1.0Q - f);
    case CM_LATITUDE_PARAMETRIC:
        return tangent * (1.0Q - f);
    case CM_LATITUDE_AUTHALIC_APPROXIMATION:
        return tangent * powq(1.0Q - f, 4.0Q / 3.0Q);
    case CM_LATITUDE_AUTHALIC:
        return f == 0.0Q ? tangent : quad_authalic(f, tangent);
    case CM_LATITUDE_CONFORMAL:
        return f == 0.0Q ? tangent : quad_conformal(f, tangent);
    case CM_LATITUDE_RECTIFYING:
        return f == 0.0Q ? tangent : quad_rectifying(f, tangent);
    }
    abort();
}

/* By secants between logarithms, from a start that double precision knows. */
static latitude_quad quad_to_geographic(latitude_quad f, cm_latitude from, latitude_quad tangent,
                                        latitude_quad start)
{
    if (from == CM_LATITUDE_GEOGRAPHIC)
    {
        return tangent;
    }
    latitude_quad wanted = logq(tangent);
    latitude_quad at = logq(start);
    latitude_quad before = at + 1e-15Q;
    latitude_quad lack_before = logq(quad_from_geographic(f, from, expq(before))) - wanted;
    for (int i = 0; i < 60; i++)
    {
        latitude_quad lack = logq(quad_from_geographic(f, from, expq(at))) - wanted;
        if (fabsq(lack) < 1e-29Q * (1.0Q + fabsq(wanted)))
        {
            return expq(at);
        }
        latitude_quad next = at - lack * (at - before) / (lack - lack_before);
        before = at;
        lack_before = lack;
        at = next;
    }
    fprintf(stderr, "no root: f %g, latitude %d, tan %g\n", (double)f, (int)from, (double)tangent);
    abort();
}

/* tan(to) from tan(from), both above 0; start is about that of the geographic latitude. */
static inline latitude_quad quad_latitude(double f, cm_latitude from, cm_latitude to,
                                          latitude_quad tangent, latitude_quad start)
{
    if (from == to || f == 0.0)
    {
        return tangent;
    }
    latitude_quad geographic = quad_to_geographic((latitude_quad)f, from, tangent, start);
    return quad_from_geographic((latitude_quad)f, to, geographic);
}

#endif
