/* SPDX-License-Identifier: MIT */
#include "degrees.h"

#include <math.h>
#include <stdbool.h>

/* A sum of two doubles, the second much smaller than the first. */
struct pair
{
    double high;
    double low;
};

/* value times a constant, to about twice the precision of a double. The constant is leading + rest,
 * leading with 24 bits at most, so that its products with both halves of value are exact. */
static struct pair times_constant(double value, double leading, double rest)
{
    struct pair product;
    const double upper = (double)(float)value;
    const double lower = value - upper;
    product.high = value * (leading + rest);
    product.low = ((upper * leading - product.high) + lower * leading) + value * rest;
    return product;
}

/* pi/180 and 180/pi. */
static struct pair degrees_to_radians(double degrees)
{
    return times_constant(degrees, 0x1.1df46ap-6, 0x1.294e9c8ae0ec6p-33);
}

static struct pair radians_to_degrees(double radians)
{
    return times_constant(radians, 0x1.ca5dc2p+5, -0x1.670f8211e7ab4p-21);
}

/* degrees = result + 90 * quadrant, exactly, with |result| <= 45; quadrant is right modulo 4. */
static double reduce(double degrees, int *quadrant)
{
    if (fabs(degrees) < 1e9)
    {
        /* both the product and the difference are exact: remquo without its price */
        *quadrant = (int)(degrees / 90 + copysign(0.5, degrees));
        return degrees - 90.0 * *quadrant;
    }
    return remquo(degrees, 90, quadrant);
}

/* Sine and cosine of an angle in [-pi/4, pi/4] by their Taylor series, of which 2e-19 is left off.
 * The large terms, x and 1 - x^2/2, are known to more than a double, so that the sum rounds once:
 * the C library's functions, which take no pair, would round before the correction. */
static void sine_cosine_series(struct pair x, double *sine, double *cosine)
{
    const double upper = (double)(float)x.high;
    const double lower = x.high - upper;
    const double square = x.high * x.high;
    const double square_low = ((upper * upper - square) + 2 * upper * lower) + lower * lower;

    double s = 1.0 / 355687428096000.0;
    s = s * square - 1.0 / 1307674368000.0;
    s = s * square + 1.0 / 6227020800.0;
    s = s * square - 1.0 / 39916800.0;
    s = s * square + 1.0 / 362880.0;
    s = s * square - 1.0 / 5040.0;
    s = s * square + 1.0 / 120.0;
    s = s * square - 1.0 / 6.0;
    *sine = x.high + (x.high * square * s + x.low * (1 - 0.5 * square));

    double c = 1.0 / 20922789888000.0;
    c = c * square - 1.0 / 87178291200.0;
    c = c * square + 1.0 / 479001600.0;
    c = c * square - 1.0 / 3628800.0;
    c = c * square + 1.0 / 40320.0;
    c = c * square - 1.0 / 720.0;
    c = c * square + 1.0 / 24.0;
    const double start = 1 - 0.5 * square;
    const double lost = (1 - start) - 0.5 * square;
    *cosine = start + (lost + (square * square * c - (0.5 * square_low + x.high * x.low)));
}

void degrees_sine_cosine(double degrees, double *sine, double *cosine)
{
    const double square_root_half = 0x1.6a09e667f3bcdp-1;
    int quadrant = 0;
    const double reduced = reduce(degrees, &quadrant);
    double s = copysign(square_root_half, reduced);
    double c = square_root_half;
    if (fabs(reduced) != 45)
    {
        sine_cosine_series(degrees_to_radians(reduced), &s, &c);
    }
    /* adding zero turns -0 into 0 */
    const bool odd = ((unsigned)quadrant & 1) != 0;
    const bool half_turn = ((unsigned)quadrant & 2) != 0;
    const double turned_sine = odd ? c : s;
    const double turned_cosine = odd ? -s : c;
    *sine = (half_turn ? -turned_sine : turned_sine) + 0.0;
    *cosine = (half_turn ? -turned_cosine : turned_cosine) + 0.0;
}

double degrees_atan2(double y, double x)
{
    const double up = fabs(y);
    const double along = fabs(x);
    const bool steep = up > along;
    /* in [0, 45], as a sum, so that what follows rounds only once */
    const struct pair angle = radians_to_degrees(steep ? atan2(along, up) : atan2(up, along));
    const double base = steep ? 90.0 : (x < 0 ? 180.0 : 0.0);
    const double sign = steep == (x < 0) ? 1.0 : -1.0;
    /* base + high is exact or its rounding error is found exactly: base is 0 or larger than high */
    const double sum = base + sign * angle.high;
    const double lost = base == 0 ? 0.0 : (base - sum) + sign * angle.high;
    const double magnitude = sum + (lost + sign * angle.low);
    return y < 0 ? -magnitude : magnitude;
}

void degrees_to_direction(double longitude, double latitude, double direction[3])
{
    double sine_longitude;
    double cosine_longitude;
    double sine_latitude;
    double cosine_latitude;
    if (!(fabs(latitude) <= 90) || !isfinite(longitude))
    {
        direction[0] = direction[1] = direction[2] = (double)NAN;
        return;
    }
    degrees_sine_cosine(longitude, &sine_longitude, &cosine_longitude);
    degrees_sine_cosine(latitude, &sine_latitude, &cosine_latitude);
    direction[0] = cosine_latitude * cosine_longitude + 0.0;
    direction[1] = cosine_latitude * sine_longitude + 0.0;
    direction[2] = sine_latitude;
}

void degrees_from_direction(const double direction[3], double *longitude, double *latitude)
{
    const double largest = fmax(fabs(direction[0]), fmax(fabs(direction[1]), fabs(direction[2])));
    if (isnan(direction[0]) || isnan(direction[1]) || isnan(direction[2]) || isinf(largest) ||
        largest == 0)
    {
        *longitude = *latitude = (double)NAN;
        return;
    }
    /* a subnormal distance from the axis has lost digits, and one of huge components is infinite */
    const double scale = largest < 1e-290 ? 0x1p600 : (largest > 1e290 ? 0x1p-600 : 1.0);
    const double x = direction[0] * scale;
    const double y = direction[1] * scale;
    const double z = direction[2] * scale;
    const double squares = x * x + y * y;
    /* hypot where squares would leave the range of double */
    const double across = squares > 1e-290 && squares < 1e290 ? sqrt(squares) : hypot(x, y);
    *longitude = x == 0 && y == 0 ? 0.0 : degrees_atan2(y, x);
    *latitude = degrees_atan2(z, across);
}
