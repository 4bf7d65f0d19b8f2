/* SPDX-License-Identifier: MIT
 *
 * Conversions between latitudes: any ellipsoid, any pair, any options, any latitudes and directions.
 */
#include "in_double.inc"
#include "fuzz_values.inc"

static const double half_pi = 1.5707963267948966;

static double take_flattening(supply *from)
{
    static const double some[] = {
        1.0 / 298.257223563, 0.02, -0.02, 0.0, 0.99, -99.0, 1e-300, -1e-17};
    uint8_t kind = take_byte(from);
    return kind % 3 == 0   ? take_double(from)
           : kind % 3 == 1 ? 0.05 * take_fraction(from)
                           : some[kind / 3 % 8];
}

static double take_tolerance(supply *from)
{
    uint8_t kind = take_byte(from);
    return kind % 4 == 0 ? take_double(from) : kind % 4 == 1 ? exp(-(double)(kind / 4)) : 0.0;
}

/* Any of: raw, inside, beside a multiple of a quarter turn, a little beyond a pole. */
static double take_latitude(supply *from)
{
    uint8_t kind = take_byte(from);
    double angle = half_pi * (double)(kind / 4 % 3 - 1);
    switch (kind % 4)
    {
    case 0:
        return take_double(from);
    case 1:
        return half_pi * take_fraction(from);
    case 2:
        return beside(angle, from);
    default:
        return angle + 1e-10 * (take_byte(from) - 128);
    }
}

static void check_latitude(const cm_latitude_conversion *conversion, double latitude)
{
    double other = cm_latitude_convert(conversion, latitude);
    double again = 0.0;
    cm_latitude_convert_array(conversion, 1, &latitude, &again);
    EXPECT(memcmp(&other, &again, sizeof other) == 0, "%a: %a and %a", latitude, other, again);
    if (!(fabs(latitude) <= half_pi + 1e-9))
    {
        EXPECT(isnan(other), "%a becomes %a", latitude, other);
        return;
    }
    EXPECT(fabs(other) <= half_pi && signbit(other) == signbit(latitude), "%a becomes %a", latitude,
           other);
    EXPECT((latitude == 0.0) <= (other == 0.0), "%a becomes %a", latitude, other);
    EXPECT(cm_latitude_convert(conversion, -latitude) == -other, "%a is not odd", latitude);
}

static void check_direction(const cm_latitude_conversion *conversion, const double direction[3])
{
    double to[3];
    double again[3];
    cm_latitude_convert_direction(conversion, direction, to);
    cm_latitude_convert_direction_array(conversion, 1, &direction[0], &direction[1], &direction[2],
                                        &again[0], &again[1], &again[2]);
    EXPECT(memcmp(to, again, sizeof to) == 0, "an array is another");
    if (!is_direction(direction))
    {
        EXPECT(isnan(to[0]) && isnan(to[1]) && isnan(to[2]), "%a %a %a becomes %a %a %a",
               direction[0], direction[1], direction[2], to[0], to[1], to[2]);
        return;
    }
    double length = hypot(hypot(to[0], to[1]), to[2]);
    EXPECT(fabs(length - 1.0) <= 1e-14, "%a %a %a has the length %a", direction[0], direction[1],
           direction[2], length);
    for (int k = 0; k < 3; k++)
    {
        EXPECT(signbit(to[k]) == signbit(direction[k]), "%a becomes %a", direction[k], to[k]);
    }
}

static void check_conversion(const cm_latitude_conversion *conversion, double tolerance,
                             supply *from)
{
    int order = cm_latitude_conversion_order(conversion);
    double error = cm_latitude_conversion_error(conversion);
    EXPECT(order >= 0 && order <= 12, "%d terms", order);
    EXPECT(error >= 0.0 && error <= fmax(tolerance, 0x1p-54), "error %g, tolerance %g", error,
           tolerance);
    double constants[CM_LATITUDE_CONSTANTS];
    int terms = -1;
    cm_status status = cm_latitude_conversion_constants(conversion, constants, &terms);
    EXPECT(status == CM_OK ? terms >= order && terms <= 12
                           : status == CM_ERROR_UNSUPPORTED && terms == -1,
           "status %d, %d terms for %d", (int)status, terms, order);
    for (int i = 0; i < 4; i++)
    {
        double direction[3];
        check_latitude(conversion, take_latitude(from));
        take_direction(from, direction);
        check_direction(conversion, direction);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    cm_latitude_conversion *conversion = NULL;
    cm_ellipsoid e = {.size = sizeof e, .a = 1.0};
    uint8_t odd = take_byte(&from);
    e.f = take_flattening(&from);
    e.size -= odd == 255;
    cm_latitude first = (cm_latitude)(take_byte(&from) % 29 % 8);
    cm_latitude second = (cm_latitude)(take_byte(&from) % 29 % 8);
    cm_latitude_options options = {
        .size = sizeof options,
        .tolerance = take_tolerance(&from),
        .exact = odd & 1,
        .instructions = cm_instructions_at(take_byte(&from) % (cm_instructions_count() + 1))};
    options.size -= odd == 254;
    cm_status status = cm_latitude_conversion_create(&e, first, second,
                                                     odd % 4 == 3 ? NULL : &options, &conversion);
    int good_options =
        odd % 4 == 3 || (odd != 254 && options.tolerance >= 0.0 && isfinite(options.tolerance));
    cm_status expected = !good_options                     ? CM_ERROR_ARGUMENT
                         : cm_ellipsoid_check(&e) != CM_OK ? CM_ERROR_ELLIPSOID
                         : cm_latitude_name(first) == NULL || cm_latitude_name(second) == NULL
                             ? CM_ERROR_LATITUDE
                             : CM_OK;
    EXPECT(status == expected && (conversion != NULL) == (status == CM_OK), "status %d", status);
    if (status == CM_OK)
    {
        check_conversion(conversion, odd % 4 == 3 ? 0.0 : options.tolerance, &from);
    }
    cm_latitude_conversion_destroy(conversion);
    return 0;
}
