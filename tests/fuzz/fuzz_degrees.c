/* SPDX-License-Identifier: MIT
 *
 * The degrees of cubemap-project, against the C library's long double: the errors that degrees.h
 * states.
 */
#include "tools/cli/degrees.h"

#include "in_double.inc"
#include "fuzz_values.inc"

static const long double degree = 3.14159265358979323846264338327950288L / 180.0L;

/* Below this, what is computed on the way loses bits to the smallest double, or to the smallest
 * float: there the stated errors are not meant to the last bit. */
enum
{
    LEAST_EXPONENT = -960,
    LEAST_EXPONENT_IN_FLOAT = -120
};

static int is_tiny(long double value)
{
    return fabsl(value) < ldexpl(1.0L, LEAST_EXPONENT_IN_FLOAT);
}

static void check_sine_cosine(double degrees)
{
    double value[2];
    int quadrant;
    degrees_sine_cosine(degrees, &value[0], &value[1]);
    if (!isfinite(degrees))
    {
        EXPECT(isnan(value[0]) && isnan(value[1]), "%a", degrees);
        return;
    }
    long double reduced = remquol(degrees, 90.0L, &quadrant);
    const long double turns[4] = {sinl(reduced * degree), cosl(reduced * degree),
                                  -sinl(reduced * degree), -cosl(reduced * degree)};
    for (int k = 0; k < 2; k++)
    {
        long double truth = turns[((unsigned)quadrant + (unsigned)k) % 4];
        double error = error_in_ulp(value[k], truth, LEAST_EXPONENT);
        EXPECT(error <= (is_tiny(reduced) ? 1.0 : 0.8), "%s of %a is %a, not %La: %g ulp",
               k == 0 ? "sine" : "cosine", degrees, value[k], truth, error);
    }
    EXPECT(fabsl(reduced) != 45.0L || fabs(value[0]) == fabs(value[1]), "%a: %a %a", degrees,
           value[0], value[1]);
}

static void check_atan2(double y, double x)
{
    double angle = degrees_atan2(y, x);
    long double truth = atan2l(y == 0.0 ? 0.0 : y, x) / degree;
    double bound = fabsl(truth) > 90.0L ? 0.75 : fabsl(truth) > 45.0L ? 1.0 : 1.5;
    double error = error_in_ulp(angle, truth, LEAST_EXPONENT);
    EXPECT(error <= (is_tiny(truth) ? 2.0 : bound) && fabs(angle) <= 180.0,
           "atan2 of %a %a is %a, not %La: %g ulp", y, x, angle, truth, error);
}

static void check_direction(const double direction[3])
{
    double lon;
    double lat;
    double back[3];
    int good = is_direction(direction);
    degrees_from_direction(direction, &lon, &lat);
    EXPECT(isnan(lon) == !good && isnan(lat) == !good, "%a %a %a: %g %g", direction[0],
           direction[1], direction[2], lon, lat);
    degrees_to_direction(lon, lat, back);
    if (good)
    {
        EXPECT(fabs(lon) <= 180.0 && fabs(lat) <= 90.0, "%a %a", lon, lat);
        EXPECT(earth_metres(direction, back) <= 5e-9, "%a %a %a: %.17g %.17g: %g m off",
               direction[0], direction[1], direction[2], lon, lat, earth_metres(direction, back));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    while (from.left > 0)
    {
        double direction[3];
        double multiple = 45.0 * (take_byte(&from) % 64 - 32);
        take_direction(&from, direction);
        check_direction(direction);
        check_sine_cosine(direction[0]);
        check_sine_cosine(beside(multiple, &from));
        if (is_direction(direction) && (direction[0] != 0.0 || direction[1] != 0.0))
        {
            check_atan2(direction[0], direction[1]);
        }
    }
    return 0;
}
