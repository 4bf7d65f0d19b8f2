/* SPDX-License-Identifier: MIT
 *
 * The other half of the split sum, against adaptive quadrature over the light, and what it must be.
 */
#include <cubemap/environment.h>

#include "tests/suite.h"

#define PI 3.14159265358979323846

/* ---------------------------------------------------------------- the reflection over directions of light */

typedef struct view
{
    cm_brdf_shadowing shadowing;
    double cosine;
    double alpha;
    double theta; /* of the light */
    int which;    /* 0: scale, 1: bias */
} view;

static double shadow(const view *w, double n_l)
{
    const double n_v = w->cosine;
    const double a = w->alpha * w->alpha;
    if (w->shadowing == CM_BRDF_SCHLICK)
    {
        const double k = w->alpha / 2.0;
        return n_l / (n_l * (1.0 - k) + k) * n_v / (n_v * (1.0 - k) + k);
    }
    /* 1 / (1 + lambda(v) + lambda(l)) */
    const double lambda_v = 0.5 * (sqrt(1.0 + a * (1.0 / (n_v * n_v) - 1.0)) - 1.0);
    const double lambda_l = 0.5 * (sqrt(1.0 + a * (1.0 / (n_l * n_l) - 1.0)) - 1.0);
    return 1.0 / (1.0 + lambda_v + lambda_l);
}

/* D G F / (4 n_l n_v) n_l sin(theta), for light at theta and phi, phi = pi being the mirror's side. */
static double reflected(double phi, const view *w)
{
    const double s = sqrt(1.0 - w->cosine * w->cosine);
    const double l[3] = {sin(w->theta) * cos(phi), sin(w->theta) * sin(phi), cos(w->theta)};
    double h[3] = {l[0] + s, l[1], l[2] + w->cosine};
    const double length = sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
    const double n_h = h[2] / length;
    const double v_h = (s * h[0] + w->cosine * h[2]) / length;
    const double a = w->alpha * w->alpha;
    const double below = n_h * n_h * (a - 1.0) + 1.0;
    const double fresnel = pow(1.0 - v_h, 5.0);
    return a / (PI * below * below) * shadow(w, l[2]) / (4.0 * w->cosine) * sin(w->theta) *
           (w->which == 0 ? 1.0 - fresnel : fresnel);
}

static double simpson(double (*f)(double, const view *), const view *w, double a, double b,
                      double fa, double fm, double fb, double tolerance, int depth)
{
    const double m = 0.5 * (a + b);
    const double left = f(0.5 * (a + m), w);
    const double right = f(0.5 * (m + b), w);
    const double whole = (b - a) / 6.0 * (fa + 4.0 * fm + fb);
    const double halves = (b - a) / 12.0 * (fa + 4.0 * left + 2.0 * fm + 4.0 * right + fb);
    if (depth == 0 || fabs(halves - whole) < 15.0 * tolerance)
    {
        return halves + (halves - whole) / 15.0;
    }
    return simpson(f, w, a, m, fa, left, fm, 0.5 * tolerance, depth - 1) +
           simpson(f, w, m, b, fm, right, fb, 0.5 * tolerance, depth - 1);
}

static double integrate(double (*f)(double, const view *), const view *w, double a, double b,
                        double tolerance)
{
    /* in pieces, so that a narrow peak is not missed */
    double sum = 0.0;
    for (int k = 0; k < 8; k++)
    {
        const double low = a + (b - a) * k / 8.0;
        const double high = a + (b - a) * (k + 1) / 8.0;
        sum += simpson(f, w, low, high, f(low, w), f(0.5 * (low + high), w), f(high, w),
                       tolerance / 8.0, 24);
    }
    return sum;
}

static double over_phi(double theta, const view *w)
{
    view one = *w;
    one.theta = theta;
    return 2.0 * integrate(reflected, &one, 0.0, PI, 2e-8);
}

static void check_integral(cm_brdf_shadowing shadowing, double cosine, double roughness,
                           double bound)
{
    cm_brdf_terms terms;
    ck_assert_int_eq(cm_brdf_integrate(shadowing, cosine, roughness, &terms), CM_OK);
    view w = {shadowing, cosine, roughness * roughness, 0.0, 0};
    const double scale = integrate(over_phi, &w, 1e-12, PI / 2.0 - 1e-12, 1e-7);
    w.which = 1;
    const double bias = integrate(over_phi, &w, 1e-12, PI / 2.0 - 1e-12, 1e-7);
    REQUIRE(fabs(terms.scale - scale) < bound && fabs(terms.bias - bias) < bound,
            "%d, %g, %g: %.9f %.9f, not %.9f %.9f", (int)shadowing, cosine, roughness, terms.scale,
            terms.bias, scale, bias);
}

START_TEST(it_is_the_integral_over_light)
{
    static const double cosines[] = {0.02, 0.1, 0.35, 0.7, 0.95, 1.0};
    static const double roughness[] = {0.25, 0.4, 0.7, 1.0};
    for (size_t i = 0; i < 6; i += step_of(4))
    {
        for (size_t j = step_of(2) - 1; j < 4; j += step_of(2))
        {
            check_integral(CM_BRDF_CORRELATED, cosines[i], roughness[j], 2e-6);
            check_integral(CM_BRDF_SCHLICK, cosines[i], roughness[j], 2e-6);
        }
    }
}
END_TEST

/* ---------------------------------------------------------------- the reflection over normals, by many points */

/* Even in psi, with tan(theta) = alpha tan(psi), and in phi. Of narrow lobes, which the above misses. */
enum
{
    STEPS_MAX = 2500
};

static void over_normals(double cosine, double roughness, int steps, double value[2])
{
    double along[STEPS_MAX];
    for (int j = 0; j < steps; j++)
    {
        along[j] = cos(PI * (j + 0.5) / steps);
    }
    const double alpha = roughness * roughness;
    const double s = sqrt(1.0 - cosine * cosine);
    value[0] = value[1] = 0.0;
    for (int i = 0; i < steps; i++)
    {
        const double psi = PI / 2.0 * (i + 0.5) / steps;
        const double tangent = alpha * tan(psi);
        const double density = PI / 2.0 * sin(2.0 * psi);
        const double n_h = 1.0 / sqrt(1.0 + tangent * tangent);
        for (int j = 0; j < steps; j++)
        {
            const double v_h = cosine * n_h + s * tangent * n_h * along[j];
            const double n_l = 2.0 * v_h * n_h - cosine;
            if (n_l > 0.0)
            {
                const view w = {CM_BRDF_CORRELATED, cosine, alpha, 0.0, 0};
                const double weight =
                    density * shadow(&w, n_l) * v_h / (n_h * cosine) / ((double)steps * steps);
                const double left = 1.0 - v_h, fresnel = left * left * (left * left) * left;
                value[0] += weight * (1.0 - fresnel);
                value[1] += weight * fresnel;
            }
        }
    }
}

/* From mpmath in 20 digits, over normals with limits. */
START_TEST(grazing_views)
{
    cm_brdf_terms terms;
    cm_brdf_integrate(CM_BRDF_CORRELATED, 0.02, 0.25, &terms);
    ck_assert(fabs(terms.scale - 0.458036925546) < 1e-6 &&
              fabs(terms.bias - 0.481241112479) < 1e-6);
    cm_brdf_integrate(CM_BRDF_CORRELATED, 0.004, 0.02, &terms);
    ck_assert(fabs(terms.scale - 0.020678603628) < 1e-6 &&
              fabs(terms.bias - 0.973503974451) < 1e-6);
}
END_TEST

START_TEST(narrow_lobes)
{
    static const double cosines[] = {0.05, 0.2, 0.5, 0.99};
    static const double roughness[] = {0.002, 0.02, 0.08, 0.2};
    for (size_t i = 0; i < 4; i++)
    {
        for (size_t j = 0; j < 4; j++)
        {
            double expected[2];
            cm_brdf_terms terms;
            over_normals(cosines[i], roughness[j], is_quick() ? 300 : STEPS_MAX, expected);
            cm_brdf_integrate(CM_BRDF_CORRELATED, cosines[i], roughness[j], &terms);
            REQUIRE(fabs(terms.scale - expected[0]) < (is_quick() ? 2e-3 : 1e-4) &&
                        fabs(terms.bias - expected[1]) < (is_quick() ? 2e-3 : 1e-4),
                    "%g, %g: %.9f %.9f, not %.9f %.9f", cosines[i], roughness[j], terms.scale,
                    terms.bias, expected[0], expected[1]);
        }
    }
}
END_TEST

/* ---------------------------------------------------------------- what it must be */

START_TEST(a_mirror_is_fresnels_term)
{
    for (int i = 0; i <= 20; i++)
    {
        const double cosine = i / 20.0;
        cm_brdf_terms terms;
        cm_brdf_integrate(CM_BRDF_CORRELATED, cosine, 0.0, &terms);
        ck_assert(fabs(terms.bias - pow(1.0 - cosine, 5.0)) < 1e-15);
        ck_assert(fabs(terms.scale + terms.bias - 1.0) < 1e-15);
        /* and nearly so a little beside */
        cm_brdf_terms near;
        cm_brdf_integrate(CM_BRDF_CORRELATED, cosine, 1e-4, &near);
        REQUIRE(cosine == 0.0 || fabs(near.scale - terms.scale) < 1e-5, "%g: %.9f, not %.9f",
                cosine, near.scale, terms.scale);
    }
}
END_TEST

START_TEST(energy_is_lost_and_comes_back)
{
    for (int i = 0; i <= 20; i++)
    {
        double last = 1.0;
        for (int j = 0; j <= 20; j++)
        {
            cm_brdf_terms terms;
            ck_assert_int_eq(cm_brdf_integrate(CM_BRDF_CORRELATED, i / 20.0, j / 20.0, &terms),
                             CM_OK);
            const double all = terms.scale + terms.bias;
            REQUIRE(terms.scale >= 0.0 && terms.bias >= 0.0 && all <= 1.0 + 1e-9, "%d, %d: %g", i,
                    j, all);
            /* more roughness loses more, away from grazing views */
            REQUIRE(i < 10 || all <= last + 1e-6, "%d, %d: %g, %g", i, j, all, last);
            last = all;
            /* nothing is lost of white, and of no colour more than all comes back */
            ck_assert(fabs(all + cm_brdf_multiple(&terms, 1.0) - 1.0) < 1e-12);
            for (int k = 0; k <= 4; k++)
            {
                const double f0 = k / 4.0;
                const double more = cm_brdf_multiple(&terms, f0);
                ck_assert(more >= -1e-9 && f0 * terms.scale + terms.bias + more <= 1.0 + 1e-9);
            }
        }
    }
    ck_assert(isnan(cm_brdf_multiple(NULL, 0.5)));
}
END_TEST

START_TEST(tables)
{
    float three[5 * 7 * 3];
    uint16_t two[5 * 7 * 2];
    cm_image image = {sizeof image, three, CM_PIXEL_FLOAT, 7, 5, 3, 0, 0};
    ck_assert_int_eq(cm_brdf_table(CM_BRDF_SCHLICK, 2, &image), CM_OK);
    image.data = two;
    image.type = CM_PIXEL_U16;
    image.channels = 2;
    ck_assert_int_eq(cm_brdf_table(CM_BRDF_SCHLICK, 1, &image), CM_OK);
    for (int j = 0; j < 5; j++)
    {
        for (int i = 0; i < 7; i++)
        {
            cm_brdf_terms terms;
            const float *value = three + 3 * (7 * j + i);
            const uint16_t *whole = two + 2 * (7 * j + i);
            cm_brdf_integrate(CM_BRDF_SCHLICK, (i + 0.5) / 7.0, (j + 0.5) / 5.0, &terms);
            ck_assert(value[0] == (float)terms.scale && value[1] == (float)terms.bias);
            ck_assert(value[2] == (float)(1.0 - terms.scale - terms.bias));
            ck_assert(fabs(whole[0] / 65535.0 - terms.scale) < 0.51 / 65535.0);
            ck_assert(fabs(whole[1] / 65535.0 - terms.bias) < 0.51 / 65535.0);
        }
    }
}
END_TEST

START_TEST(wrong_arguments)
{
    cm_brdf_terms terms = {7.0, 7.0};
    float pixels[8] = {7.0F};
    cm_image image = {sizeof image, pixels, CM_PIXEL_FLOAT, 2, 1, 2, 0, 0};
    static const double bad[] = {-1e-9, 1.0 + 1e-9};
    for (size_t i = 0; i < 2; i++)
    {
        ck_assert_int_eq(cm_brdf_integrate(CM_BRDF_CORRELATED, bad[i], 0.5, &terms),
                         CM_ERROR_RANGE);
        ck_assert_int_eq(cm_brdf_integrate(CM_BRDF_CORRELATED, 0.5, bad[i], &terms),
                         CM_ERROR_RANGE);
    }
    ck_assert_int_eq(cm_brdf_integrate(CM_BRDF_CORRELATED, (double)NAN, 0.5, &terms),
                     CM_ERROR_RANGE);
    ck_assert_int_eq(cm_brdf_integrate((cm_brdf_shadowing)2, 0.5, 0.5, &terms), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_brdf_integrate(CM_BRDF_CORRELATED, 0.5, 0.5, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_brdf_table(CM_BRDF_CORRELATED, 1, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_brdf_table((cm_brdf_shadowing)-1, 1, &image), CM_ERROR_RANGE);
    image.channels = 4;
    ck_assert_int_eq(cm_brdf_table(CM_BRDF_CORRELATED, 1, &image), CM_ERROR_RANGE);
    image.channels = 1;
    ck_assert_int_eq(cm_brdf_table(CM_BRDF_CORRELATED, 1, &image), CM_ERROR_RANGE);
    image.channels = 2;
    image.size = 4;
    ck_assert_int_eq(cm_brdf_table(CM_BRDF_CORRELATED, 1, &image), CM_ERROR_ARGUMENT);
    ck_assert(terms.scale == 7.0 && terms.bias == 7.0 && pixels[0] == 7.0F);
}
END_TEST

int main(void)
{
    const TTest *tests[] = {
        it_is_the_integral_over_light, grazing_views, narrow_lobes,    a_mirror_is_fresnels_term,
        energy_is_lost_and_comes_back, tables,        wrong_arguments, NULL};
    return run_suite("brdf", tests);
}
