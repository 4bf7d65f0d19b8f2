/* SPDX-License-Identifier: MIT
 *
 * The points that a mapping is measured at: random ones and the hard ones, in its precision and where it is
 * defined.
 */
#include "certificate.h"

#include "truth/hard_points.h"
#include "truth/sphere.h"

#include <math.h>
#include <stdlib.h>

/* ---- Points ---- */

/* Onto rhealpix' belt of four squares, or, one point in three each, its caps. */
static void put_into_squares(const subject *s, size_t i, double *a, double *b)
{
    *b *= 0.25;
    if (i % 3 != 0)
    {
        double square = cm_mapping_parameter(s->exact, i % 3 - 1);
        *a = 0.25 * *a + (0.5 * square - 0.75);
        *b += i % 3 == 1 ? 0.5 : -0.5;
    }
}

/* In the subject's precision. What is outside the disc is moved to its rim, or beside it. */
static void put_point(const subject *s, const double point[2], size_t i, double (*uv)[BLOCK])
{
    double length = s->is_disc ? hypot(point[0], point[1]) : 0.0;
    double a = length > 1.0 ? point[0] / length : point[0];
    double b = length > 1.0 ? point[1] / length : point[1];
    if (s->has_gaps)
    {
        put_into_squares(s, i, &a, &b);
    }
    uv[0][i] = s->narrow ? (double)(float)a : a;
    uv[1][i] = s->narrow ? (double)(float)b : b;
}

void find_view(subject *s)
{
    const quad middle[2] = {(quad)0, (quad)0};
    quad centre[3];
    quad_inverse(&s->truth, 0, middle, centre);
    for (int k = 0; k < 3; k++)
    {
        s->centre[k] = (double)centre[k];
    }
    s->rim_cosine = 1.0 - 2.0 * (double)(s->truth.constants.k0 * s->truth.constants.k0);
}

/* Is the direction in the field of view? Quadruple precision is for what is near its rim. */
static int is_seen(const subject *s, double x, double y, double z)
{
    double scale = 1.0 / fmax(fabs(x), fmax(fabs(y), fabs(z)));
    double a = x * scale, b = y * scale, c = z * scale;
    double cosine =
        (a * s->centre[0] + b * s->centre[1] + c * s->centre[2]) / sqrt(a * a + b * b + c * c);
    if (fabs(cosine - s->rim_cosine) > 1e-6)
    {
        return cosine > s->rim_cosine;
    }
    const quad direction[3] = {(quad)x, (quad)y, (quad)z};
    return quad_inside(&s->truth, direction) >= 0;
}

/* Of n directions those that are in it; returns how many. */
size_t keep_seen(const subject *s, size_t n, double (*d)[BLOCK])
{
    size_t kept = 0;
    for (size_t i = 0; i < n && s->truth.kind == CM_KIND_AZIMUTHAL; i++)
    {
        if (is_seen(s, d[0][i], d[1][i], d[2][i]))
        {
            for (int k = 0; k < 3; k++)
            {
                d[k][kept] = d[k][i];
            }
            kept++;
        }
    }
    return s->truth.kind == CM_KIND_AZIMUTHAL ? kept : n;
}

void random_directions(subject *s, uint64_t *state, double (*d)[BLOCK])
{
    for (size_t i = 0; i < BLOCK; i++)
    {
        double direction[3];
        next_direction(state, direction);
        for (int k = 0; k < 3; k++)
        {
            d[k][i] = s->narrow ? (double)(float)direction[k] : direction[k];
        }
    }
}

/* One in four has a coordinate that is small, by up to 2^-60, or as near to the edge. */
void random_points(subject *s, uint64_t *state, uint8_t *face, double (*uv)[BLOCK])
{
    for (size_t i = 0; i < BLOCK; i++)
    {
        double point[2] = {next_real(state), next_real(state)};
        uint64_t bits = next_bits(state);
        double small = ldexp(point[bits & 1], -(int)(bits >> 8 & 63) % 60);
        switch (bits >> 1 & 7)
        {
        case 0:
            point[bits & 1] = small;
            break;
        case 1:
            point[bits & 1] = copysign(1.0 - fabs(small), small);
            break;
        default:
            break;
        }
        face[i] = (uint8_t)((bits >> 16) % (unsigned)s->faces);
        put_point(s, point, i, uv);
    }
}

/* Is it one for this precision? Not of zero length, nor for fast too short. */
static int is_wanted(const subject *s, double x, double y, double z)
{
    double length = fmax(fabs(x), fmax(fabs(y), fabs(z)));
    return s->precision == FAST ? length >= 0.1 && length <= 1e30 : length > 0.0;
}

/* From index on, one in so many. */
size_t hard_directions(const subject *s, uint64_t step, uint64_t *index, double (*d)[BLOCK])
{
    size_t n = 0;
    while (n < BLOCK && *index < HARD_DIRECTIONS)
    {
        double direction[3];
        float narrow[3];
        if (s->narrow)
        {
            hard_direction_f32(*index, narrow);
        }
        else
        {
            hard_direction(*index, direction);
        }
        *index += step;
        for (int k = 0; k < 3; k++)
        {
            d[k][n] = s->narrow ? (double)narrow[k] : direction[k];
        }
        n += (size_t)is_wanted(s, d[0][n], d[1][n], d[2][n]);
    }
    return n;
}

size_t hard_face_points(const subject *s, uint64_t step, uint64_t *index, double (*uv)[BLOCK])
{
    size_t n = 0;
    for (; n < BLOCK && *index < HARD_POINTS; n++)
    {
        double point[2];
        float narrow[2];
        if (s->narrow)
        {
            hard_point_f32(*index, narrow);
            point[0] = (double)narrow[0];
            point[1] = (double)narrow[1];
        }
        else
        {
            hard_point(*index, point);
        }
        *index += step;
        put_point(s, point, n, uv);
    }
    return n;
}
