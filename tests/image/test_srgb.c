/* SPDX-License-Identifier: MIT
 *
 * The transfer function of sRGB.
 */
#include "tests/suite.h"

#include <cubemap/srgb.h>

/* With the places at which the standard has the branches part. */
static double light_of_standard(double srgb)
{
    return srgb <= 0.04045 ? srgb / 12.92 : pow((srgb + 0.055) / 1.055, 2.4);
}

static double srgb_of_standard(double light)
{
    return light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1.0 / 2.4) - 0.055;
}

static void check_near(double found, double wanted, double most, double at)
{
    REQUIRE(fabs(found - wanted) <= most * fabs(wanted), "at %.17g: %.17g, not %.17g", at, found,
            wanted);
}

START_TEST(whole_numbers_are_as_the_standard_has_them)
{
    for (int i = 0; i <= 65535; i++)
    {
        const double number = i / 65535.0;
        const double light = cm_light_from_srgb(number);
        ck_assert(light == light_of_standard(number));
        ck_assert(cm_srgb_from_light(number) == srgb_of_standard(number));
        check_near(cm_srgb_from_light(light), number, 1e-14, number);
        /* 16 bits survive single precision */
        const float single = cm_light_from_srgb_float((float)number);
        check_near((double)single, light, 1e-6, number);
        check_near((double)cm_srgb_from_light_float((float)number), srgb_of_standard(number), 1e-6,
                   number);
        ck_assert_int_eq((int)lrint(65535.0 * (double)cm_srgb_from_light_float(single)), i);
    }
    ck_assert(cm_light_from_srgb(1.0) == 1.0 && cm_light_from_srgb_float(1.0f) == 1.0f);
}
END_TEST

START_TEST(branches_meet)
{
    const double above = nextafter(CM_SRGB_JOINT, 1.0);
    check_near(cm_srgb_from_light(above), cm_srgb_from_light(CM_SRGB_JOINT), 1e-15, above);
    const double stored = 12.92 * CM_SRGB_JOINT;
    check_near(cm_light_from_srgb(nextafter(stored, 1.0)), CM_SRGB_JOINT, 1e-15, stored);
    const float single = (float)CM_SRGB_JOINT;
    check_near((double)cm_srgb_from_light_float(nextafterf(single, 1.0f)),
               (double)cm_srgb_from_light_float(single), 3e-7, CM_SRGB_JOINT);
}
END_TEST

/* Beyond 0 and 1, and what is no number. */
START_TEST(curves_go_on)
{
    const double numbers[] = {0.0, 1e-300, 1e-3, 0.5, 7.0, 1e30, (double)INFINITY};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
    {
        const double x = numbers[i];
        const float single = (float)x;
        ck_assert(cm_srgb_from_light(-x) == -cm_srgb_from_light(x));
        ck_assert(cm_light_from_srgb(-x) == -cm_light_from_srgb(x));
        ck_assert(cm_srgb_from_light_float(-single) == -cm_srgb_from_light_float(single));
        ck_assert(cm_light_from_srgb_float(-single) == -cm_light_from_srgb_float(single));
        ck_assert(signbit(cm_srgb_from_light(-x)) && signbit(cm_light_from_srgb_float(-single)));
    }
    ck_assert(isinf(cm_srgb_from_light((double)INFINITY)));
    ck_assert(isinf(cm_light_from_srgb_float((float)INFINITY)));
    ck_assert(isnan(cm_srgb_from_light((double)NAN)) && isnan(cm_light_from_srgb((double)NAN)));
    ck_assert(isnan(cm_srgb_from_light_float((float)NAN)));
    ck_assert(isnan(cm_light_from_srgb_float((float)NAN)));
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {whole_numbers_are_as_the_standard_has_them, branches_meet,
                                  curves_go_on, NULL};
    return run_suite("srgb", tests);
}
