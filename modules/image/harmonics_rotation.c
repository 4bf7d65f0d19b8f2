/* SPDX-License-Identifier: MIT
 *
 * Rotations of spherical harmonics, degree by degree. A rotation is one about z, one about x and one about z. About
 * z, pairs of coefficients turn like vectors. About x it is that about z between two turns by 90 degrees about y,
 * which takes z to x: one matrix for each degree, with the elements d(m, k) = d^l_mk(90 degrees) of Wigner's.
 *
 * The elements come from recursion in m downwards from m = l at each k, out of where they vanish to where they swing,
 * and so grow all the way (after Trapani and Navaza 2006, Acta Cryst. A62). The recursion in l of Ivanic and
 * Ruedenberg 1996 loses all digits before degree 256.
 *
 * In the real basis, cosines (m >= 0) and sines (m < 0) do not mix about y, and d(m, -k) = (-1)^(l+m) d(m, k) leaves
 * of each every other element: for cosines (-1)^l 2 d(m, k) where l + m + k is even, with 1 / sqrt(2) for each order
 * that is 0, and for sines -(-1)^l 2 d(m, k) where it is odd.
 */
#include <cubemap/environment.h>

#include "modules/memory/checked_size.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What elements carry too much: the least of degree 2000 is 2^-2000. */
#define SCALE 0x1p1000

/* The elements of one degree, without SCALE: those of order m, at all k from 0 to degree, are row m. */
typedef struct quarter_turn
{
    size_t degree;
    double *row;  /* (degree + 1)^2 */
    double *last; /* three rows for the recursion, with SCALE */
} quarter_turn;

/* d(l, k) = (-1)^(l-k) sqrt((2 l)! / ((l+k)! (l-k)!)) / 2^l */
static void make_top(size_t l, double *top)
{
    double value = SCALE;
    for (size_t k = 1; k <= l; k++)
    {
        value *= sqrt((2.0 * (double)k - 1.0) / (2.0 * (double)k));
    }
    for (size_t k = 0; k <= l; k++)
    {
        top[k] = (l - k) % 2 == 0 ? value : -value;
        value *= sqrt((double)(l - k) / (double)(l + k + 1));
    }
}

/* sqrt((l+m) (l-m+1)) d(m-1, k) = 2 k d(m, k) - sqrt((l-m) (l+m+1)) d(m+1, k) */
static void make_quarter_turn(quarter_turn *turn)
{
    const size_t l = turn->degree;
    double *above = turn->last;
    double *here = above + l + 1;
    double *below = here + l + 1;
    memset(above, 0, (l + 1) * sizeof *above);
    make_top(l, here);
    for (size_t m = l;; m--)
    {
        for (size_t k = 0; k <= l; k++)
        {
            turn->row[m * (l + 1) + k] = here[k] / SCALE;
        }
        if (m == 0)
        {
            return;
        }
        const double down = 1.0 / sqrt((double)(l + m) * (double)(l - m + 1));
        const double up = sqrt((double)(l - m) * (double)(l + m + 1)) * down;
        for (size_t k = 0; k <= l; k++)
        {
            below[k] = 2.0 * down * (double)k * here[k] - up * above[k];
        }
        double *room = above;
        above = here;
        here = below;
        below = room;
    }
}

/* Adds the quarter turn of one kind, or its inverse, which is its transpose: first is the least order, parity what
 * l + m + k is. */
static void turn_kind(const quarter_turn *turn, int is_inverse, size_t first, size_t parity,
                      double sign, const double *from, double *to)
{
    const size_t l = turn->degree;
    for (size_t m = first; m <= l; m++)
    {
        const double *row = turn->row + m * (l + 1);
        const double factor = sign * 2.0 * (m == 0 ? sqrt(0.5) : 1.0);
        double sum = 0.0;
        for (size_t k = first + (l + m + first + parity) % 2; k <= l; k += 2)
        {
            const double element = factor * row[k] * (k == 0 ? sqrt(0.5) : 1.0);
            if (is_inverse)
            {
                to[k] += element * from[m];
            }
            else
            {
                sum += element * from[k];
            }
        }
        if (!is_inverse)
        {
            to[m] = sum;
        }
    }
}

/* Coefficients of a degree: cosines of orders 0 to l, then sines of orders 0, which is none, to l. */
static void turn_about_y(const quarter_turn *turn, int is_inverse, const double *from, double *to)
{
    const size_t l = turn->degree;
    const double sign = l % 2 == 0 ? 1.0 : -1.0;
    memset(to, 0, 2 * (l + 1) * sizeof *to);
    turn_kind(turn, is_inverse, 0, 0, sign, from, to);
    turn_kind(turn, is_inverse, 1, 1, -sign, from + l + 1, to + l + 1);
}

static void turn_about_z(size_t l, double angle, double *values)
{
    for (size_t m = 1; m <= l; m++)
    {
        const double c = cos((double)m * angle);
        const double s = sin((double)m * angle);
        const double even = values[m];
        const double odd = values[l + 1 + m];
        values[m] = c * even - s * odd;
        values[l + 1 + m] = s * even + c * odd;
    }
}

/* The angles of R = Rz(first) Rx(middle) Rz(last). last comes from what the first leaves, so that their sum is right
 * where the middle one vanishes. */
typedef struct zxz
{
    double first;
    double middle;
    double last;
} zxz;

static zxz angles_of(const cm_rotation *rotation)
{
    const double(*r)[3] = rotation->row;
    const double across = hypot(r[0][2], r[1][2]);
    const double c = across > 0.0 ? -r[1][2] / across : 1.0;
    const double s = across > 0.0 ? r[0][2] / across : 0.0;
    zxz angles;
    angles.first = atan2(s, c);
    angles.middle = atan2(s * r[0][2] - c * r[1][2], r[2][2]);
    angles.last = atan2(-(c * r[0][1] + s * r[1][1]), c * r[0][0] + s * r[1][0]);
    return angles;
}

/* One degree of one channel. values and room have room for 2 (l + 1) each. */
static void turn_degree(const quarter_turn *turn, const zxz *angles, uint32_t channels,
                        const double *from, double *to, double *values, double *room)
{
    const size_t l = turn->degree;
    values[l + 1] = 0.0;
    for (size_t m = 0; m <= l; m++)
    {
        values[m] = from[(l + m) * channels];
        values[l + 1 + m] = m > 0 ? from[(l - m) * channels] : 0.0;
    }
    turn_about_z(l, angles->last, values);
    turn_about_y(turn, 1, values, room);
    turn_about_z(l, angles->middle, room);
    turn_about_y(turn, 0, room, values);
    turn_about_z(l, angles->first, values);
    for (size_t m = 0; m <= l; m++)
    {
        to[(l + m) * channels] = values[m];
        if (m > 0)
        {
            to[(l - m) * channels] = values[l + 1 + m];
        }
    }
}

cm_status cm_harmonics_rotate(uint32_t degree, uint32_t channels, const cm_rotation *rotation,
                              const double *from, double *to)
{
    if (rotation == NULL || from == NULL || to == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (degree > CM_HARMONICS_DEGREE_MAX || channels < 1 || channels > CM_ENVIRONMENT_CHANNELS_MAX)
    {
        return CM_ERROR_RANGE;
    }
    const cm_status status = cm_rotation_check(rotation);
    if (status != CM_OK)
    {
        return status;
    }
    const size_t width = (size_t)degree + 1;
    double *memory = cm_array_of((width + 7) * width, sizeof *memory);
    if (memory == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    double *values = memory + (width + 3) * width;
    const zxz angles = angles_of(rotation);
    for (size_t l = 0; l <= degree; l++)
    {
        quarter_turn turn = {l, memory, memory + width * width};
        make_quarter_turn(&turn);
        for (uint32_t c = 0; c < channels; c++)
        {
            const size_t at = l * l * channels + c;
            turn_degree(&turn, &angles, channels, from + at, to + at, values, values + 2 * width);
        }
    }
    free(memory);
    return CM_OK;
}
