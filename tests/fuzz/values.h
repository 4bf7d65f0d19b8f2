/* SPDX-License-Identifier: MIT
 *
 * Directions and points of a face that the input chooses, hard ones likely, and what the library
 * must take them for. In the precision of in_double.h or in_float.h, which is read before.
 */
#include "subject.h"

/* A few ulp beside a value. */
static inline REAL beside(REAL value, supply *from)
{
    int steps = take_byte(from) % 16 - 8;
    for (int i = 0; i < abs(steps); i++)
    {
        value = NEXT_AFTER(value, steps < 0 ? (REAL)-INFINITY : (REAL)INFINITY);
    }
    return value;
}

static inline void take_direction(supply *from, REAL direction[3])
{
    uint8_t kind = take_byte(from) % 5;
    if (kind >= 2)
    {
        uint32_t index = take_word(from);
        /* those of any size, at the end of the list, are few and would hardly be met */
        HARD_DIRECTION(kind == 2 ? HARD_NEAR + index % (HARD_DIRECTIONS - HARD_NEAR) : index,
                       direction);
    }
    for (int k = 0; k < 3; k++)
    {
        switch (kind)
        {
        case 0:
            take_bytes(from, &direction[k], sizeof direction[k]);
            break;
        case 1:
            direction[k] = (REAL)take_fraction(from);
            break;
        case 3:
            direction[k] = beside(direction[k], from);
            break;
        default:
            break;
        }
    }
}

/* u, v or p, q; some of them outside the face */
static inline void take_point(supply *from, REAL point[2])
{
    uint8_t kind = take_byte(from) % 5;
    if (kind >= 2)
    {
        HARD_POINT(take_word(from), point);
    }
    for (int k = 0; k < 2; k++)
    {
        switch (kind)
        {
        case 0:
            take_bytes(from, &point[k], sizeof point[k]);
            break;
        case 1:
            point[k] = (REAL)take_fraction(from);
            break;
        case 2:
            point[k] = beside(point[k], from);
            break;
        case 3: /* some of these are further outside than the tolerance */
            point[k] += (REAL)(1e-10 * (take_byte(from) - 128));
            break;
        default:
            break;
        }
    }
}

/* Mostly one that there is. */
static inline uint8_t take_face(supply *from)
{
    uint8_t face = take_byte(from);
    return face < 200 ? face % 6 : face;
}

/* What the library takes for a direction. */
static inline int is_direction(const REAL direction[3])
{
    int zero = direction[0] == 0 && direction[1] == 0 && direction[2] == 0;
    return isfinite(direction[0]) && isfinite(direction[1]) && isfinite(direction[2]) && !zero;
}

/* What the library takes for a point of a face. */
static inline int is_point(const REAL point[2])
{
    return fabs((double)point[0]) <= 1.0 + TOLERANCE && fabs((double)point[1]) <= 1.0 + TOLERANCE;
}

static inline REAL clamped(REAL coordinate)
{
    return coordinate < -1 ? -1 : coordinate > 1 ? 1 : coordinate;
}

static inline double angle_of(const REAL a[3], const REAL b[3])
{
    const double wide_a[3] = {(double)a[0], (double)a[1], (double)a[2]};
    const double wide_b[3] = {(double)b[0], (double)b[1], (double)b[2]};
    return angle_between(wide_a, wide_b);
}

/* In ulp of the truth, or of the power of two below which ulp shall no more shrink. */
static inline double error_in_ulp(double value, long double truth, int least_exponent)
{
    int exponent;
    frexpl(truth, &exponent);
    exponent = exponent < least_exponent ? least_exponent : exponent;
    return (double)(fabsl((long double)value - truth) / ldexpl(1.0L, exponent - DBL_MANT_DIG));
}
