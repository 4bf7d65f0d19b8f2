/* SPDX-License-Identifier: MIT
 *
 * Cameras with distortion: there and back, derivatives, the valid field and what is beyond it.
 */
#define _POSIX_C_SOURCE 200809L

#include <cubemap/camera.h>
#include <cubemap/pool.h>

#include "tests/suite.h"
#include "lens_truth.h"

#define TURN 6.283185307179586

static uint64_t state = 1;

static double uniform(double low, double high)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(state >> 11) * 0x1p-53;
}

/* strength 1: what calibrations of wide lenses give; more: what folds in the picture. */
static cm_camera_options random_options(double strength)
{
    cm_camera_options options = {.size = sizeof options, .width = 640, .height = 480};
    static const double most[14] = {0.4,  0.15, 0.01, 0.01, 0.05, 0.2,  0.05,
                                    0.02, 0.02, 0.01, 0.02, 0.01, 0.06, 0.06};
    options.fx = uniform(250.0, 900.0);
    options.fy = options.fx * uniform(0.9, 1.1) * (uniform(0.0, 1.0) < 0.1 ? -1.0 : 1.0);
    options.pixel_centre = uniform(0.0, 1.0) < 0.5 ? 0.0 : 0.5;
    options.cx = 319.5 + options.pixel_centre + uniform(-20.0, 20.0);
    options.cy = 239.5 + options.pixel_centre + uniform(-20.0, 20.0);
    for (int i = 0; i < 14; i++)
    {
        options.distortion[i] = uniform(-strength, strength) * most[i];
    }
    return options;
}

static cm_camera *make(const cm_camera_options *options)
{
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(options, &camera), CM_OK);
    return camera;
}

static int ray_of(const cm_camera *camera, const double pixel[2], double ray[3])
{
    cm_camera_ray_array(camera, 1, &pixel[0], &pixel[1], &ray[0], &ray[1], &ray[2]);
    ck_assert(isnan(ray[0]) == isnan(ray[1]) && isnan(ray[0]) == isnan(ray[2]));
    ck_assert(isnan(ray[0]) || ray[2] == 1.0);
    return !isnan(ray[0]);
}

static int pixel_of(const cm_camera *camera, const double point[3], double pixel[2])
{
    cm_camera_project_array(camera, 1, &point[0], &point[1], &point[2], &pixel[0], &pixel[1]);
    ck_assert(isnan(pixel[0]) == isnan(pixel[1]));
    return !isnan(pixel[0]);
}

static double apart(const double a[2], const double b[2])
{
    return fmax(fabs(a[0] - b[0]), fabs(a[1] - b[1]));
}

/* Pixels of the picture, its corners and its middle among them. */
static void check_pixels(const cm_camera *camera, int count, int *missing)
{
    const cm_camera_options *options = cm_camera_describe(camera);
    for (int i = 0; i < count; i++)
    {
        const double edge = options->pixel_centre;
        double pixel[2] = {i < 4 ? edge + 639.0 * (i % 2) : floor(uniform(0.0, 640.0)) + edge,
                           i < 4 ? edge + 479.0 * (i / 2) : floor(uniform(0.0, 480.0)) + edge};
        if (i == 4)
        {
            pixel[0] = options->cx;
            pixel[1] = options->cy;
        }
        double ray[3];
        double again[2];
        ck_assert_int_eq(cm_camera_has_ray(camera, pixel[0], pixel[1]), ray_of(camera, pixel, ray));
        if (isnan(ray[0]))
        {
            REQUIRE(i != 4, "the axis");
            ++*missing;
            continue;
        }
        REQUIRE(pixel_of(camera, ray, again) && apart(again, pixel) <= 1e-9, "%a %a: %g", pixel[0],
                pixel[1], apart(again, pixel));
    }
}

/* Rays up to the border come back from their pixels; those beyond have none. */
static void check_rays(const cm_camera *camera, int count)
{
    for (int i = 0; i < count; i++)
    {
        const double angle = uniform(0.0, TURN);
        const double border = cm_camera_border(camera, angle);
        const double most = fmin(border, 1.5);
        const double length = most * (i % 8 == 0 ? 1.0 - 1e-4 : sqrt(uniform(0.0, 0.99)));
        const double ray[3] = {length * cos(angle), length * sin(angle), 1.0};
        double pixel[2];
        double again[3];
        double there[2];
        REQUIRE(pixel_of(camera, ray, pixel), "%g of %g", length, border);
        REQUIRE(ray_of(camera, pixel, again), "no ray for %.17g %.17g: %g of %g", pixel[0],
                pixel[1], length, border);
        /* beside a pole pixels go to infinity, and an ulp of a ray is more than 1e-9 of them */
        const int is_far = fabs(pixel[0]) + fabs(pixel[1]) > 5000.0;
        REQUIRE(pixel_of(camera, again, there) && (is_far || apart(there, pixel) <= 1e-9), "%g",
                apart(there, pixel));
        REQUIRE(apart(again, ray) <= (is_far ? 1e-11 : 1e-4) * length, "%g", apart(again, ray));
        const double outer[3] = {border * 1.0001 * cos(angle), border * 1.0001 * sin(angle), 1.0};
        REQUIRE(border == (double)INFINITY || !pixel_of(camera, outer, pixel), "%g: %g", angle,
                border);
    }
}

START_TEST(pixels_come_back)
{
    const int cameras = is_quick() ? 60 : 1000;
    int missing = 0;
    state = 7;
    for (int i = 0; i < cameras; i++)
    {
        const cm_camera_options options = random_options(i % 4 == 3 ? 3.0 : 1.0);
        cm_camera *camera = make(&options);
        check_pixels(camera, 100, &missing);
        check_rays(camera, 40);
        cm_camera_destroy(camera);
    }
    REQUIRE(missing < 100 * cameras / 5, "%d pixels of %d have no ray", missing, 100 * cameras);
}
END_TEST

/* In long double, with the formula as it is printed: places, and their derivatives by central differences. */
START_TEST(forward_and_derivatives_are_the_model)
{
    state = 11;
    for (int i = 0; i < (is_quick() ? 40 : 400); i++)
    {
        const cm_camera_options options = random_options(1.0);
        cm_camera *camera = make(&options);
        const double angle = uniform(0.0, TURN);
        const double length = uniform(0.0, 0.9) * fmin(1.2, cm_camera_border(camera, angle));
        const double z = uniform(0.2, 8.0);
        const double point[3] = {z * length * cos(angle), z * length * sin(angle), z};
        double pixel[2];
        double jacobian[6];
        ck_assert(pixel_of(camera, point, pixel));
        cm_camera_jacobian(camera, point, jacobian);
        long double true_pixel[2];
        lens_project(&options, (const long double[3]){point[0], point[1], point[2]}, true_pixel);
        for (int k = 0; k < 2; k++)
        {
            REQUIRE(fabsl(pixel[k] - true_pixel[k]) < 2e-11L, "%Lg", pixel[k] - true_pixel[k]);
        }
        for (int j = 0; j < 3; j++)
        {
            const long double step = 1e-6L;
            long double more[3] = {point[0], point[1], point[2]}, less[3] = {point[0], point[1], z};
            long double up[2], low[2];
            more[j] += step;
            less[j] -= step;
            lens_project(&options, more, up);
            lens_project(&options, less, low);
            for (int k = 0; k < 2; k++)
            {
                const long double slope = (up[k] - low[k]) / (2 * step);
                REQUIRE(fabsl(jacobian[3 * k + j] - slope) <= 1e-7L * (1 + fabsl(slope)),
                        "d %d / d %d: %.17g, not %.17Lg", k, j, jacobian[3 * k + j], slope);
            }
        }
        cm_camera_destroy(camera);
    }
}
END_TEST

static long double determinant(const double *k, long double a, long double b)
{
    const long double h = 1e-7L * (1 + fabsl(a) + fabsl(b));
    long double e[2], w[2], n[2], s[2];
    lens_distort(k, a + h, b, e);
    lens_distort(k, a - h, b, w);
    lens_distort(k, a, b + h, n);
    lens_distort(k, a, b - h, s);
    return ((e[0] - w[0]) * (n[1] - s[1]) - (n[0] - s[0]) * (e[1] - w[1])) / (4 * h * h);
}

/* The border is where the determinant of differences first is none, looked for in small steps. */
START_TEST(border_is_the_first_fold)
{
    state = 13;
    for (int i = 0; i < (is_quick() ? 20 : 200); i++)
    {
        cm_camera_options options = random_options(3.0);
        options.distortion[TAU_X] = options.distortion[TAU_Y] = 0.0;
        cm_camera *camera = make(&options);
        const double angle = uniform(0.0, TURN);
        const double border = cm_camera_border(camera, angle);
        const double *k = options.distortion;
        double seen = 0.0;
        long double below = 1;
        const double step = 1e-3;
        for (; seen < 4.0 && below > 0; seen += step)
        {
            const double r2 = seen * seen;
            below = 1 + r2 * (k[K4] + r2 * (k[K5] + r2 * k[K6]));
            if (!(determinant(k, seen * cos(angle), seen * sin(angle)) > 0))
            {
                break;
            }
        }
        REQUIRE(seen >= 4.0 ? border >= 3.99 : fabs(border - seen) <= 1.1 * step,
                "camera %d, angle %g: %.17g, not %g", i, angle, border, seen);
        cm_camera_destroy(camera);
    }
}
END_TEST

/* A pole nearer to the axis than the first step that is looked at: k4 r^2 = -1. */
START_TEST(poles_may_be_next_to_the_axis)
{
    for (double size = 1e8; size < 1e150; size *= 1e11)
    {
        const cm_camera_options options = {.size = sizeof options,
                                           .width = 640,
                                           .height = 480,
                                           .fx = 500.0,
                                           .fy = 500.0,
                                           .cx = 319.5,
                                           .cy = 239.5,
                                           .distortion = {[5] = -size}};
        cm_camera *camera = make(&options);
        const double pole = 1.0 / sqrt(size);
        const double border = cm_camera_border(camera, 0.7);
        REQUIRE(fabs(border / pole - 1.0) < 1e-12, "%g: %.17g, not %.17g", size, border, pole);
        const double inside[3] = {0.9 * pole, 0.0, 1.0};
        const double outside[3] = {1.1 * pole, 0.0, 1.0};
        double pixel[2];
        REQUIRE(pixel_of(camera, inside, pixel), "%g", size);
        REQUIRE(!pixel_of(camera, outside, pixel), "%g: %g", size, pixel[0]);
        cm_camera_destroy(camera);
    }
}
END_TEST

/* The radial model x = r (1 + k1 r^2) folds at r^2 = -1 / (3 k1), where x is two thirds of that. */
START_TEST(nothing_comes_from_beyond_a_fold)
{
    cm_camera_options options = {.size = sizeof options,
                                 .width = 640,
                                 .height = 480,
                                 .fx = 500.0,
                                 .fy = 500.0,
                                 .cx = 319.5,
                                 .cy = 239.5,
                                 .distortion = {-0.9}};
    cm_camera *camera = make(&options);
    const double fold = sqrt(1.0 / 2.7);
    const double end = 500.0 * fold * 2.0 / 3.0;
    for (int i = 0; i < 64; i++)
    {
        const double angle = TURN * i / 64.0 + 0.01;
        REQUIRE(fabs(cm_camera_border(camera, angle) - fold) < 1e-12, "%g",
                cm_camera_border(camera, angle) - fold);
        double ray[3];
        const double inside[2] = {319.5 + (end - 1e-7) * cos(angle),
                                  239.5 + (end - 1e-7) * sin(angle)};
        const double outside[2] = {319.5 + (end + 1e-7) * cos(angle),
                                   239.5 + (end + 1e-7) * sin(angle)};
        REQUIRE(ray_of(camera, inside, ray) && hypot(ray[0], ray[1]) <= fold, "%d: %g", i, ray[0]);
        REQUIRE(!ray_of(camera, outside, ray), "%d: %g %g", i, ray[0], ray[1]);
        /* the formula says that this one is in the middle of the picture */
        const double far = sqrt(1.0 / 0.9) * 0.98;
        const double point[3] = {far * cos(angle), far * sin(angle), 1.0};
        double pixel[2];
        REQUIRE(!pixel_of(camera, point, pixel), "%d: %g %g", i, pixel[0], pixel[1]);
    }
    cm_camera_destroy(camera);
    /* k2 > 0: signs are good again beyond the fold, and what is there is none of the field */
    options.distortion[K2] = 0.3;
    camera = make(&options);
    const double border = cm_camera_border(camera, 0.0);
    ck_assert(border > 0.6 && border < 0.8);
    const double beyond[3] = {2.0, 1.0, 1.0};
    double pixel[2];
    ck_assert(determinant(options.distortion, 2.0L, 1.0L) > 0);
    ck_assert(!pixel_of(camera, beyond, pixel));
    double ray[3];
    const double corner[2] = {639.0, 479.0};
    ck_assert(!ray_of(camera, corner, ray));
    cm_camera_destroy(camera);
}
END_TEST

/* How many pixels are marked that are so near each way. */
static int marks_around(const unsigned char *mark, int column, int row, int reach)
{
    int marks = 0;
    for (int i = row - reach; i <= row + reach; i++)
    {
        for (int k = column - reach; k <= column + reach; k++)
        {
            marks += mark[i * 640 + k];
        }
    }
    return marks;
}

/* The pixels of a direction's rays, which all have some. */
static void mark_direction(const cm_camera *camera, double angle, double most, unsigned char *mark)
{
    enum
    {
        STEPS = 1300
    };
    double ray[3][STEPS];
    double pixel[2][STEPS];
    const size_t rays = (size_t)fmin(ceil(most * 1e3), STEPS);
    for (size_t i = 0; i < STEPS; i++)
    {
        ray[0][i] = (double)i * 1e-3 * cos(angle);
        ray[1][i] = (double)i * 1e-3 * sin(angle);
        ray[2][i] = 1.0;
    }
    cm_camera_project_array(camera, rays, ray[0], ray[1], ray[2], pixel[0], pixel[1]);
    for (size_t i = 0; i < rays; i++)
    {
        const double column = pixel[0][i] + 0.5;
        const double row = pixel[1][i] + 0.5;
        REQUIRE(!isnan(column), "%g of %g", (double)i * 1e-3, most);
        if (column > 0.0 && column < 640.0 && row > 0.0 && row < 480.0)
        {
            mark[(int)row * 640 + (int)column] = 1;
        }
    }
}

/* A lens that folds to one side, where its border leaps to infinity: pixels have rays just where close rays have pixels. */
START_TEST(one_side_may_fold)
{
    const cm_camera_options options = {
        .size = sizeof options,
        .width = 640,
        .height = 480,
        .fx = 525.0,
        .fy = 525.0,
        .cx = 319.5,
        .cy = 239.5,
        .distortion = {-0.6, 0.3, 0.05, -0.1, 0.0, 0.0, 0.0, 0.0, 0.1, -0.05, 0.05}};
    cm_camera *camera = make(&options);
    unsigned char *mark = calloc(640 * 480, 1);
    const int turns = 4000;
    int folds = 0;
    int seen[2] = {0, 0};
    for (int i = 0; i < turns; i++)
    {
        const double angle = TURN * i / turns;
        const double border = cm_camera_border(camera, angle);
        folds += border < (double)INFINITY;
        mark_direction(camera, angle, border, mark);
    }
    for (int row = 2; row < 478; row++)
    {
        for (int column = 2; column < 638; column++)
        {
            double ray[3];
            const int has_ray = ray_of(camera, (const double[2]){column, row}, ray);
            seen[has_ray]++;
            REQUIRE(has_ray || marks_around(mark, column, row, 1) < 9, "%d %d", column, row);
            REQUIRE(!has_ray || marks_around(mark, column, row, 2) > 0, "%d %d", column, row);
        }
    }
    REQUIRE(folds > turns / 8 && folds < turns / 2 && seen[0] > 40000 && seen[1] > 200000,
            "%d of %d, %d, %d", folds, turns, seen[0], seen[1]);
    free(mark);
    cm_camera_destroy(camera);
}
END_TEST

static cm_camera *make_distorted(double focal, const double lens[14])
{
    cm_camera_options options = {.size = sizeof options,
                                 .width = 640,
                                 .height = 480,
                                 .fx = focal,
                                 .fy = focal,
                                 .cx = 319.5,
                                 .cy = 239.5};
    memcpy(options.distortion, lens, sizeof options.distortion);
    return make(&options);
}

/* From the axis the way to these rays leaves the field; that there are some the border's image tells, a part of which is 1e16
 * away, before a pole. */
START_TEST(rays_come_back_where_borders_have_poles)
{
    static const double lenses[][14] = {
        {-0.1777, 0.01063, 0, -0.2378, 0, 0, -0.04094, 0.1137, 0.2057, 0.1763},
        {-1.451, 0, 0.1447, 0.8464, -0.7533, 1.015, 0.4981, 0.8134, -1.411, -0.919}};
    state = 23;
    for (size_t i = 0; i < sizeof lenses / sizeof *lenses; i++)
    {
        cm_camera *camera = make_distorted(500.0, lenses[i]);
        int seen = 0;
        for (int k = 0; k < 4000; k++)
        {
            const double ray[3] = {uniform(-1.5, 1.5), uniform(-1.5, 1.5), 1.0};
            const double border = cm_camera_border(camera, atan2(ray[1], ray[0]));
            double pixel[2];
            double again[3];
            if (hypot(ray[0], ray[1]) < 0.95 * border && pixel_of(camera, ray, pixel) &&
                pixel[0] > 0.0 && pixel[0] < 640.0 && pixel[1] > 0.0 && pixel[1] < 480.0)
            {
                seen++;
                REQUIRE(ray_of(camera, pixel, again), "lens %zu: (%g, %g) at %g, %g", i, ray[0],
                        ray[1], pixel[0], pixel[1]);
            }
        }
        REQUIRE(seen > 300, "lens %zu: %d rays", i, seen);
        cm_camera_destroy(camera);
    }
}
END_TEST

/* A ray (a, b, 1), and the lens it is seen through. */
typedef struct seen_ray
{
    double ray[2];
    double lens[14];
} seen_ray;

/* A ray goes to a pixel, and that to a ray of the same pixel. */
static void check_return(const cm_camera *camera, const double ray[3])
{
    double pixel[2];
    double again[3];
    double there[2];
    REQUIRE(pixel_of(camera, ray, pixel), "(%.17g, %.17g)", ray[0], ray[1]);
    REQUIRE(ray_of(camera, pixel, again), "no ray for %.17g %.17g: (%.17g, %.17g)", pixel[0],
            pixel[1], ray[0], ray[1]);
    REQUIRE(pixel_of(camera, again, there) && apart(there, pixel) <= 1e-9, "(%.17g, %.17g): %g",
            ray[0], ray[1], apart(there, pixel));
}

/* The straight way to these from the axis and those from eight places around leave the field, or the border's image is not
 * known; that to the last ended far beyond, where pixels are dense. */
START_TEST(rays_come_back_where_no_way_is_straight)
{
    static const seen_ray seen[] = {
        {{-0.8248, 0.4352}, {0.5613, 0, 0, 0.5259, 0, 0, 0, 0, -0.4718, 0.1565, 0.1294, -0.8511}},
        {{0.5439, 0.6804},
         {0, 0, 0, -0.5015, -0.1955, 0.02633, -0.4302, 0, 0.1535, 0.2204, 0, -0.5745}},
        {{-0.2661, 1.423},
         {0, -0.1783, 0, -0.6521, 0, 0, 0, -0.07616, -0.2301, 0.6303, 0, -0.3224}},
        {{0.6031, 1.172}, {0, 0, -0.2656, 0.2373, -0.3071, 0, 0, 0, -0.1505, 0, 0, 0.555}},
        {{0.498, -1.305},
         {0, -0.1402, 0.3079, 0.4442, 0, -0.2443, 0, 0, 0.07218, -0.2762, -0.1899}},
        {{-1.447, -0.5284},
         {-0.5183, -0.3821, -0.4662, -0.3016, 0.07712, -0.2818, 0, 0, 0.1229, -0.6564}},
        {{1.097, 1.16},
         {-0.2569, -0.2951, 0.2278, 0, 0, 0.002518, 0, -0.004966, 0.198, 0.2086, 0, 0.0839}},
        {{-0.8381, -0.6296},
         {0, -0.5389, 0.2439, -0.05999, -0.08491, 0, -0.2097, 0.2931, 0, -0.005814, -0.06559,
          -0.5604, 0.009064, -0.08855}},
        {{-0.8896, -0.6174},
         {0, 0.09109, 0, 0.4733, -0.3077, -0.03733, -0.07454, -0.094, 0, -0.5499, 0, 0.03466, 0,
          0.06657}},
        {{-0.03347, 0.3748},
         {-0.4238, 1.26, 0, 0.2401, 0, 0, 0.9117, 0, -1.285, -0.4502, 0.9673, -0.5369}}};
    for (size_t i = 0; i < sizeof seen / sizeof *seen; i++)
    {
        cm_camera *camera = make_distorted(500.0, seen[i].lens);
        check_return(camera, (const double[3]){seen[i].ray[0], seen[i].ray[1], 1.0});
        cm_camera_destroy(camera);
    }
}
END_TEST

/* Rays in the picture, nearly up to the border. */
static int check_drawn_rays(const cm_camera *camera, int count)
{
    int seen = 0;
    for (int i = 0; i < count; i++)
    {
        const double ray[3] = {uniform(-1.5, 1.5), uniform(-1.5, 1.5), 1.0};
        const double border = cm_camera_border(camera, atan2(ray[1], ray[0]));
        double pixel[2];
        if (hypot(ray[0], ray[1]) < 0.999 * border && pixel_of(camera, ray, pixel) &&
            pixel[0] > 0.0 && pixel[0] < 640.0 && pixel[1] > 0.0 && pixel[1] < 480.0)
        {
            check_return(camera, ray);
            seen++;
        }
    }
    return seen;
}

/* Lenses as no calibration gives them. */
START_TEST(rays_of_drawn_lenses_come_back)
{
    const int lenses = is_quick() ? 15 : 60;
    int seen = 0;
    state = 11;
    for (int i = 0; i < lenses; i++)
    {
        double lens[14] = {-0.5146, 0, 0.4088, 0,       -0.11,    0,
                           0,       0, 0.3353, -0.7681, -0.03558, 0.06125};
        for (int k = 0; k < 14 && i > 0; k++)
        {
            const double most = k < 12 ? uniform(-1.0, 1.0) : uniform(-0.2, 0.2);
            lens[k] = uniform(0.0, 1.0) < 0.35 ? 0.0 : most * uniform(0.0, 1.0);
        }
        cm_camera *camera = make_distorted(500.0, lens);
        seen += check_drawn_rays(camera, i > 0 ? 100 : 2000);
        cm_camera_destroy(camera);
    }
    REQUIRE(seen > 10 * lenses, "%d", seen);
}
END_TEST

/* A fold that comes and goes between two of the steps at which a direction is looked at ends the field, too. */
START_TEST(narrow_folds_end_the_field)
{
    static const seen_ray folded[] = {
        {{1.144, 0.6658},
         {0.5287, 0, -0.1601, 0.1893, -0.2894, -0.2689, 0.03905, 0, -0.2241, 0, -0.04954, 0.9267}},
        {{1.337, 1.04},
         {0.3687, -0.3758, 0.5168, 0.701, 0, -0.1416, 0, 0, 0, 0.04515, -0.1087, 0.8818, 0,
          -0.004003}},
        {{-1.018, -0.2657},
         {0.7308, 0.9458, -0.8925, 0, -2.15, 2.923e-05, 0, 0, -1.102, -0.3256, 0.6719, 0.2927}},
        {{-0.5958, 1.176},
         {1.329, -0.3411, 0, 0, -0.4073, 0, 0.1054, 0, -0.8724, 0, 1.732, 0.4281}},
        {{1.144, 0.6658},
         {0.5287, 0, -0.1601, 0.1893, -0.2894, -0.2689, 0.03905, 0, -0.2241, 0, -0.04954, 0.9267}},
        {{-0.1496, -1.452},
         {-0.5545, 0.3057, -0.5848, 0.05878, -0.2626, 0, 0, 0, 0.001349, -0.2122, 0.6355, -0.6213}},
        {{-0.4311, -1.355},
         {-0.5545, 0.3057, -0.5848, 0.05878, -0.2626, 0, 0, 0, 0.001349, -0.2122, 0.6355, -0.6213}},
        {{-0.08295, 1.221},
         {0.3785, 0.3809, 0.621, 0, -0.1185, -0.709, -0.1384, 0.4333, 0.04163, -0.09932, 0,
          0.1002}},
        {{-1.181, 0.7993},
         {0.6954, 0.03071, -0.1078, -0.423, -0.2598, 0, -0.04782, 0, -0.3952, 0.2476, 0, 0.6713}}};
    for (size_t i = 0; i < sizeof folded / sizeof *folded; i++)
    {
        cm_camera *camera = make_distorted(500.0, folded[i].lens);
        const double point[3] = {folded[i].ray[0], folded[i].ray[1], 1.0};
        const double border = cm_camera_border(camera, atan2(point[1], point[0]));
        double pixel[2];
        ck_assert(!(determinant(folded[i].lens, point[0], point[1]) > 0));
        REQUIRE(border < hypot(point[0], point[1]), "%zu: %g", i, border);
        REQUIRE(!pixel_of(camera, point, pixel), "%zu: %g %g", i, pixel[0], pixel[1]);
        cm_camera_destroy(camera);
    }
}
END_TEST

/* Is the ray one that the lens keeps on its side, before the tilt and after it? In long double, with the formula as printed. */
static int is_kept(const double *k, double a, double b)
{
    const double r2 = a * a + b * b;
    long double place[2];
    lens_distort(k, a, b, place);
    const double below = 1 + r2 * (k[K4] + r2 * (k[K5] + r2 * k[K6]));
    const long double reach =
        sinl(k[TAU_Y]) * place[0] + cosl(k[TAU_Y]) * (cosl(k[TAU_X]) - sinl(k[TAU_X]) * place[1]);
    return below > 0 && reach > 0 && determinant(k, a, b) > 0;
}

/* Lenses of two thousand that were drawn, and a direction of each, in which a fold is so narrow that some thirty evaluations an
 * octave do not see it. Here small steps do. */
START_TEST(folds_of_drawn_lenses_end_the_field)
{
    static const struct
    {
        uint64_t lens;
        double angle;
    } folded[] = {
        {241, 4.2291220891911285},  {294, 0.16945640001480694},  {433, 4.8474099140648308},
        {542, 4.2516930678709377},  {718, 6.2343723919406298},   {813, 5.7961290843569433},
        {840, 5.2269957758913312},  {978, 3.0676500818166228},   {1495, 0.73502394003900917},
        {1534, 3.2517904614745414}, {1540, 0.21199653484219622}, {1548, 0.050985172041726902}};
    for (size_t i = 0; i < sizeof folded / sizeof *folded; i++)
    {
        static const double scales[] = {1.0, 1.5, 2.0, 0.5};
        double lens[14];
        state = 2000006 + folded[i].lens;
        uniform(0.0, 1.0);
        for (int k = 0; k < 14; k++)
        {
            const double most =
                k < 12 ? uniform(-1.0, 1.0) * scales[folded[i].lens % 4] : uniform(-0.2, 0.2);
            lens[k] = uniform(0.0, 1.0) < 0.35 ? 0.0 : most * uniform(0.0, 1.0);
        }
        cm_camera *camera = make_distorted(500.0, lens);
        const double cosine = cos(folded[i].angle);
        const double sine = sin(folded[i].angle);
        const double step = 1e-3;
        double bad = step;
        while (bad < 2.5 && is_kept(lens, bad * cosine, bad * sine))
        {
            bad += step;
        }
        double good = bad;
        while (good < 2.5 && !is_kept(lens, good * cosine, good * sine))
        {
            good += step;
        }
        ck_assert(bad < 2.5 && good < 2.5);
        const double border = cm_camera_border(camera, folded[i].angle);
        REQUIRE(border <= bad && border > bad - 1.001 * step, "lens %zu: %g, not %g", i, border,
                bad);
        const double beyond[3] = {good * cosine, good * sine, 1.0};
        double pixel[2];
        REQUIRE(!pixel_of(camera, beyond, pixel), "lens %zu: %g %g", i, pixel[0], pixel[1]);
        cm_camera_destroy(camera);
    }
}
END_TEST

/* Ten rounds of a fixed point, which undistortPoints does by default, are not enough beside a fold, and diverge where
 * distortion is strong (opencv#27916, #6091; kornia#4285). */
START_TEST(fixed_points_fail_where_newton_does_not)
{
    static const double lenses[][14] = {{-0.6}, {-0.9}, {-0.8, 0.12, 0.02, -0.01}, {2.0, 4.0}};
    for (size_t i = 0; i < sizeof lenses / sizeof *lenses; i++)
    {
        cm_camera *camera = make_distorted(800.0, lenses[i]);
        const cm_camera_options *options = cm_camera_describe(camera);
        const double angle = 0.6;
        const double length = fmin(0.98 * cm_camera_border(camera, angle), 0.9);
        const double ray[3] = {length * cos(angle), length * sin(angle), 1.0};
        double pixel[2];
        double ours[3];
        double theirs[2];
        long double there[2];
        ck_assert(pixel_of(camera, ray, pixel));
        ck_assert(ray_of(camera, pixel, ours));
        lens_project(options, (const long double[3]){ours[0], ours[1], 1}, there);
        REQUIRE(hypotl(there[0] - pixel[0], there[1] - pixel[1]) < 1e-9L, "ours");
        lens_ten_rounds(options, pixel[0], pixel[1], theirs);
        lens_project(options, (const long double[3]){theirs[0], theirs[1], 1}, there);
        const long double off = hypotl(there[0] - pixel[0], there[1] - pixel[1]);
        REQUIRE(!(off <= 1.0L), "lens %zu: ten rounds are off by %Lg pixels only", i, off);
        cm_camera_destroy(camera);
    }
}
END_TEST

/* The pixel's corners on the sphere make two triangles, whose angle Van Oosterom and Strackee 1983 give. */
static double triangle(const double a[3], const double b[3], const double c[3])
{
    const double volume = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                          a[2] * (b[0] * c[1] - b[1] * c[0]);
    const double la = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    const double lb = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    const double lc = sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
    const double ab = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const double bc = b[0] * c[0] + b[1] * c[1] + b[2] * c[2];
    const double ca = c[0] * a[0] + c[1] * a[1] + c[2] * a[2];
    return 2.0 * fabs(atan2(volume, la * lb * lc + ab * lc + bc * la + ca * lb));
}

START_TEST(solid_angles_are_those_of_small_squares)
{
    state = 17;
    for (int i = 0; i < 100; i++)
    {
        const cm_camera_options options = random_options(0.5);
        cm_camera *camera = make(&options);
        const double pixel[2] = {uniform(100.0, 540.0), uniform(100.0, 380.0)};
        double corner[4][3];
        for (int k = 0; k < 4; k++)
        {
            const double at[2] = {pixel[0] + 0.01 * (k % 2 - 0.5), pixel[1] + 0.01 * (k / 2 - 0.5)};
            ck_assert(ray_of(camera, at, corner[k]));
        }
        const double angle = 1e4 * (triangle(corner[0], corner[1], corner[2]) +
                                    triangle(corner[1], corner[2], corner[3]));
        const double ours = cm_camera_solid_angle(camera, pixel[0], pixel[1]);
        REQUIRE(fabs(ours - angle) < 1e-5 * angle, "%g, not %g", ours, angle);
        cm_camera_destroy(camera);
    }
}
END_TEST

enum
{
    ASKED_WIDTH = 120,
    ASKED_HEIGHT = 90,
    ASKED = ASKED_WIDTH * ASKED_HEIGHT
};

typedef struct asked
{
    const cm_camera *camera;
    double column[ASKED], row[ASKED], ray[3][ASKED];
} asked;

static void ask_one_by_one(size_t begin, size_t end, void *user)
{
    asked *of = user;
    for (size_t i = begin; i < end; i++)
    {
        cm_camera_ray_array(of->camera, 1, &of->column[i], &of->row[i], &of->ray[0][i],
                            &of->ray[1][i], &of->ray[2][i]);
    }
}

/* What a camera keeps once a pixel has needed it changes nothing, whichever thread was first: of a lens with pixels to which no
 * straight way leads from the axis. */
START_TEST(threads_may_ask_one_camera_pixel_by_pixel)
{
    static asked all, each;
    const cm_camera_options options = {
        .size = sizeof options,
        .width = ASKED_WIDTH,
        .height = ASKED_HEIGHT,
        .fx = 45.0,
        .fy = 45.0,
        .cx = 60.0,
        .cy = 45.0,
        .distortion = {0.0, 0.0698612593366, -0.4206904137541, -0.1908341679417, -0.2634468057999,
                       -0.0520405689487, -0.0923025414603, 0.0, 0.4369750951822, 0.4963335714855,
                       -0.3377642943636, -0.1694050995941}};
    cm_camera *const camera[2] = {make(&options), make(&options)};
    for (size_t i = 0; i < ASKED; i++)
    {
        all.column[i] = each.column[i] = (double)(i % ASKED_WIDTH);
        all.row[i] = each.row[i] = (double)(i / ASKED_WIDTH);
    }
    cm_camera_ray_array(camera[0], ASKED, all.column, all.row, all.ray[0], all.ray[1], all.ray[2]);
    cm_pool *pool = NULL;
    ck_assert_int_eq(cm_pool_create(4, &pool), CM_OK);
    each.camera = camera[1];
    cm_pool_run(pool, ASKED, 1, ask_one_by_one, &each);
    cm_pool_destroy(pool);
    size_t rays = 0;
    for (size_t i = 0; i < ASKED; i++)
    {
        rays += isnan(all.ray[0][i]) ? 0 : 1;
    }
    ck_assert(rays > ASKED / 4 && rays < ASKED);
    ck_assert_mem_eq(all.ray, each.ray, sizeof all.ray);
    cm_camera_destroy(camera[0]);
    cm_camera_destroy(camera[1]);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {pixels_come_back,
                                  forward_and_derivatives_are_the_model,
                                  border_is_the_first_fold,
                                  nothing_comes_from_beyond_a_fold,
                                  poles_may_be_next_to_the_axis,
                                  one_side_may_fold,
                                  rays_come_back_where_borders_have_poles,
                                  rays_come_back_where_no_way_is_straight,
                                  rays_of_drawn_lenses_come_back,
                                  narrow_folds_end_the_field,
                                  folds_of_drawn_lenses_end_the_field,
                                  fixed_points_fail_where_newton_does_not,
                                  solid_angles_are_those_of_small_squares,
                                  threads_may_ask_one_camera_pixel_by_pixel,
                                  NULL};
    return run_suite("lens", tests);
}
