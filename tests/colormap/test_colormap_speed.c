/* SPDX-License-Identifier: MIT
 *
 * Colour maps of constant speed, measured from their sRGB values by conversions of the tests' own.
 */
#include "many_colormaps.h"

static double worst_step;

/* All steps of 20001 samples, as parts of the length that t says is between them; across a corner they are
 * shorter than that. */
static void check_steps(const cm_colormap *map, const char *text)
{
    const size_t n = 20001;
    double *srgb = malloc(3 * n * sizeof *srgb);
    double mean = cm_colormap_length(map) / (double)(n - 1);
    double sum = 0.0;
    ck_assert_ptr_nonnull(srgb);
    ck_assert(cm_colormap_inside(map));
    cm_colormap_samples(map, n, srgb, NULL);
    double before[3], here[3];
    own_point(map, srgb, before);
    for (size_t i = 1; i < n; i++)
    {
        double from = cm_colormap_position(map, n, i - 1), to = cm_colormap_position(map, n, i);
        double even = mean * (to - from) * (double)(n - 1);
        own_point(map, srgb + 3 * i, here);
        double step = distance(before, here);
        double deviation = fabs(step / even - 1.0);
        int corner = crosses_corner(map, from, to);
        REQUIRE(step < even * (1.0 + 1e-6) + 1e-11 && (corner || deviation < 1e-6),
                "%s: step %zu is off by %g", text, i, deviation);
        worst_step = corner ? worst_step : fmax(worst_step, deviation);
        sum += step;
        memcpy(before, here, sizeof here);
    }
    REQUIRE(fabs(sum / cm_colormap_position(map, n, n - 1) - mean * (double)(n - 1)) <
                3e-4 * sum + 1e-9,
            "%s: %g", text, sum);
    free(srgb);
}

START_TEST(standard_maps_have_constant_speed)
{
    for_many_maps(0, make, check_steps);
    printf("standard maps, steps of 20001 samples: worst deviation %.3g\n", worst_step);
}
END_TEST

/* Differences between places so close that neither the path's curvature nor rounding matters. */
static void check_speed(const cm_colormap *map, const char *text)
{
    const double dt = 2e-6;
    double length = cm_colormap_length(map);
    for (int i = 0; i < 500; i++)
    {
        double t = uniform(0.0, 1.0 - dt), from[3], to[3];
        if (crosses_corner(map, t, t + dt) || length < 1.0)
        {
            continue;
        }
        own_point(map, color_at(map, t).srgb, from);
        own_point(map, color_at(map, t + dt).srgb, to);
        double deviation = fabs(distance(from, to) / (length * dt) - 1.0);
        REQUIRE(deviation < 1e-6, "%s: t = %.17g, speed is off by %g", text, t, deviation);
        worst_step = fmax(worst_step, deviation);
    }
}

START_TEST(other_maps_have_constant_speed)
{
    state = 2;
    worst_step = 0.0;
    for_many_maps(60, make_fitted, check_speed);
    printf("other maps, speed: worst deviation %.3g\n", worst_step);
}
END_TEST

/* In the space of the map, from before the colour became sRGB. */
static void path_point(const cm_colormap *map, const cm_colormap_color *color, double point[3])
{
    if (is_uniform(map))
    {
        cm_colormap_ucs_from_linear(color->linear, point);
    }
    else
    {
        memcpy(point, color->luv, sizeof color->luv);
    }
}

/* A difference quotient of fourth order. */
static void check_speed_closely(const cm_colormap *map, const char *text)
{
    const double h = 1e-4;
    double length = cm_colormap_length(map);
    for (int i = 3; i < 9997; i += (int)long_step_of(4, 20))
    {
        double t = i / 1e4, velocity[3], at[4][3];
        if (crosses_corner(map, t - 3.0 * h, t + 3.0 * h))
        {
            continue;
        }
        for (int k = 0; k < 4; k++)
        {
            cm_colormap_color color = color_at(map, t + h * (k < 2 ? k - 2 : k - 1));
            path_point(map, &color, at[k]);
        }
        for (int k = 0; k < 3; k++)
        {
            velocity[k] = (8.0 * (at[2][k] - at[1][k]) - (at[3][k] - at[0][k])) / (12.0 * h);
        }
        double speed =
            sqrt(velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2]);
        double deviation = fabs(speed / length - 1.0);
        REQUIRE(deviation < 1e-9, "%s: t = %.17g, speed is off by %g", text, t, deviation);
        worst_step = fmax(worst_step, deviation);
    }
}

START_TEST(the_speed_is_constant_to_nine_digits)
{
    worst_step = 0.0;
    for_many_maps(0, make, check_speed_closely);
    printf("standard maps, speed: worst deviation %.3g\n", worst_step);
}
END_TEST

/* Out of the gamut sRGB goes below 0, where the conversion back is another one: from LUV. */
static void check_luv_speed(const cm_colormap *map, const char *text)
{
    const double dt = 2e-6;
    double length = cm_colormap_length(map);
    for (int i = 0; i < 500 && length >= 1.0; i++)
    {
        double t = uniform(0.0, 1.0 - dt);
        cm_colormap_color from = color_at(map, t), to = color_at(map, t + dt);
        double start[3], end[3];
        path_point(map, &from, start);
        path_point(map, &to, end);
        double deviation = fabs(distance(start, end) / (length * dt) - 1.0);
        REQUIRE(crosses_corner(map, t, t + dt) || deviation < 1e-6, "%s: t = %.17g, off by %g",
                text, t, deviation);
    }
}

START_TEST(maps_out_of_gamut_have_constant_speed)
{
    state = 3;
    for_many_maps(60, make, check_luv_speed);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        standard_maps_have_constant_speed, the_speed_is_constant_to_nine_digits,
        other_maps_have_constant_speed, maps_out_of_gamut_have_constant_speed, NULL};
    return run_suite("colormap speed", tests);
}
