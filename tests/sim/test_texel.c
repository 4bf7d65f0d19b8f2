/* SPDX-License-Identifier: MIT
 *
 * Texel images: the z-buffer, places of samples, means, points, matrices, and all of it of a world whose truth is known.
 */
#include <cubemap/texel.h>

#include "tests/suite.h"

static const cm_pose at_origin = {.rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};

static cm_texel_options some_options(cm_texel_spacing spacing)
{
    return (cm_texel_options){.size = sizeof(cm_texel_options),
                              .field = 0.85,
                              .width = 128,
                              .height = 96,
                              .columns = 8,
                              .rows = 6,
                              .spacing = spacing};
}

/* ---- eq. 3.1 ---- */

/* As it is printed, in long double; and against the buffer of a projection matrix. */
START_TEST(the_buffer_is_linearised)
{
    const double near = 0.1, far = 20.0;
    for (int i = 0; i <= 1000; i++)
    {
        const float z = (float)i / 1000.0f;
        float depth;
        ck_assert_int_eq(cm_texel_linearise(near, far, 1, &z, &depth), CM_OK);
        const long double printed =
            2.0L * near * far / (far + near - (2.0L * z - 1.0L) * (far - near));
        REQUIRE(fabs((double)depth - (double)printed) <= 1e-7 * (double)printed, "%g: %g",
                (double)z, (double)depth);
        const double depth_there = near + (far - near) * i / 1000.0;
        const double clip =
            (far + near) / (far - near) - 2.0 * far * near / (far - near) / depth_there;
        const float buffer = (float)(0.5 * clip + 0.5);
        ck_assert_int_eq(cm_texel_linearise(near, far, 1, &buffer, &depth), CM_OK);
        /* a float near 1 knows the buffer to 6e-8, which far away is a deal of depth */
        REQUIRE(fabs((double)depth - depth_there) <=
                    1e-7 * depth_there * (1.0 + depth_there / near),
                "%g: %g", depth_there, (double)depth);
    }
}
END_TEST

START_TEST(the_buffer_has_ends)
{
    const float z[6] = {0.0f, 1.0f, -0.1f, 1.1f, NAN, 0.5f};
    float depth[6];
    ck_assert_int_eq(cm_texel_linearise(2.0, 8.0, 6, z, depth), CM_OK);
    REQUIRE(depth[0] == 2.0f && depth[1] == 8.0f, "%g %g", (double)depth[0], (double)depth[1]);
    REQUIRE(isnan(depth[2]) && isnan(depth[3]) && isnan(depth[4]), "%g", (double)depth[2]);
    ck_assert_int_eq(cm_texel_linearise(2.0, INFINITY, 6, z, depth), CM_OK);
    REQUIRE(depth[0] == 2.0f && isinf(depth[1]) && depth[5] == 4.0f, "%g", (double)depth[5]);
    static const double wrong[5][2] = {{0, 1}, {-1, 1}, {2, 2}, {NAN, 1}, {INFINITY, INFINITY}};
    for (int i = 0; i < 5; i++)
    {
        ck_assert_int_eq(cm_texel_linearise(wrong[i][0], wrong[i][1], 6, z, depth), CM_ERROR_RANGE);
    }
    ck_assert_int_eq(cm_texel_linearise(1.0, 2.0, 1, NULL, depth), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_texel_linearise(1.0, 2.0, 1, z, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_texel_linearise(1.0, 2.0, 0, NULL, NULL), CM_OK);
}
END_TEST

/* ---- places ---- */

START_TEST(zeros_stand_for_the_camera_of_the_source)
{
    cm_texel_options options = {.size = sizeof options, .field = 0.85};
    ck_assert_int_eq(cm_texel_complete(&options), CM_OK);
    REQUIRE(options.width == 1024 && options.height == 1024 && options.columns == 64 &&
                options.rows == 64 && options.window == 16 && options.oversampling == 1 &&
                options.unit == 1.0,
            "%u", options.columns);
}
END_TEST

START_TEST(spaces_and_angles_are_even)
{
    for (int s = 0; s < 2; s++)
    {
        const cm_texel_options options = some_options((cm_texel_spacing)s);
        const double focal = 64.0 / tan(0.425);
        double column[8], row[6], x[8], y[6];
        ck_assert_int_eq(cm_texel_places(&options, column, row, x, y), CM_OK);
        for (int i = 0; i < 8; i++)
        {
            REQUIRE(fabs(column[i] - 64.0 - focal * x[i]) < 1e-12, "%d: %g", i, column[i]);
            REQUIRE(fabs(x[i] + x[7 - i]) < 1e-15, "%d: %g", i, x[i]);
        }
        for (int i = 0; i < 7; i++)
        {
            const double angle = atan(x[i + 1]) - atan(x[i]);
            REQUIRE(s == CM_TEXEL_EVEN_ANGLES ? fabs(angle - 0.85 / 8.0) < 1e-14
                                              : fabs(column[i + 1] - column[i] - 16.0) < 1e-12,
                    "%d: %g", i, angle);
        }
        REQUIRE(fabs(row[0] - 48.0 - focal * y[0]) < 1e-12, "%g", row[0]);
        const double high = 2.0 * atan(48.0 / focal);
        REQUIRE(s == CM_TEXEL_EVEN_SPACES || fabs(atan(y[1]) - atan(y[0]) - high / 6.0) < 1e-14,
                "%g", y[0]);
        ck_assert_int_eq(cm_texel_places(&options, NULL, NULL, NULL, NULL), CM_OK);
    }
}
END_TEST

/* ---- means ---- */

/* Even spaces of 16 pixels and a window of 16: blocks, whose means are exact. */
START_TEST(samples_are_means_of_blocks)
{
    const cm_texel_options options = some_options(CM_TEXEL_EVEN_SPACES);
    float canvas[96 * 128], depth[48];
    for (int i = 0; i < 96 * 128; i++)
    {
        canvas[i] = (float)(1 + (i * 7919) % 1024) / 256.0f;
    }
    canvas[0] = NAN;
    canvas[1] = 0.0f;
    canvas[2] = INFINITY;
    for (int i = 0; i < 16 * 16; i++)
    {
        canvas[(i / 16 + 16) * 128 + 16 + i % 16] = NAN;
    }
    ck_assert_int_eq(cm_texel_sample(&options, canvas, depth), CM_OK);
    for (int s = 0; s < 48; s++)
    {
        double sum = 0.0;
        int count = 0;
        for (int i = 0; i < 256; i++)
        {
            const float value = canvas[(s / 8 * 16 + i / 16) * 128 + s % 8 * 16 + i % 16];
            const int counts = value > 0.0f && value < 100.0f;
            sum += counts ? (double)value : 0.0;
            count += counts;
        }
        REQUIRE(s == 9 ? isnan(depth[s]) : depth[s] == (float)(sum / count), "%d: %g, not %g", s,
                (double)depth[s], sum / count);
    }
}
END_TEST

/* A slope's mean is its value in the middle, wherever the window is between pixels. */
START_TEST(windows_between_pixels_count_parts)
{
    cm_texel_options options = some_options(CM_TEXEL_EVEN_ANGLES);
    options.window = 5;
    float canvas[96 * 128], depth[48];
    double column[8], row[6];
    for (int i = 0; i < 96 * 128; i++)
    {
        canvas[i] = (float)(1.0 + 0.01 * (i % 128 + 0.5) + 0.02 * (i / 128 + 0.5));
    }
    ck_assert_int_eq(cm_texel_places(&options, column, row, NULL, NULL), CM_OK);
    ck_assert_int_eq(cm_texel_sample(&options, canvas, depth), CM_OK);
    for (int s = 0; s < 48; s++)
    {
        /* beside the middle by what the parts of the first and the last pixel do not know: an eighth of a pixel each */
        const double expected = 1.0 + 0.01 * column[s % 8] + 0.02 * row[s / 8];
        REQUIRE(fabs((double)depth[s] - expected) < 0.03 * 0.125 / 5.0 * 2.0, "%d: %g, not %g", s,
                (double)depth[s], expected);
    }
}
END_TEST

/* ---- points ---- */

START_TEST(points_lie_on_their_rays)
{
    const cm_texel_options options = some_options(CM_TEXEL_EVEN_ANGLES);
    float depth[48], got[48], range[48], point[3][48], uv[2][48];
    double column[8], row[6], x[8], y[6];
    const cm_texel_image image = {.size = sizeof image,
                                  .depth = got,
                                  .range = range,
                                  .point = {point[0], point[1], point[2]},
                                  .uv = {uv[0], uv[1]}};
    for (int i = 0; i < 48; i++)
    {
        depth[i] = i == 5 ? -1.0f : 1.0f + 0.03f * (float)i;
    }
    ck_assert_int_eq(cm_texel_places(&options, column, row, x, y), CM_OK);
    ck_assert_int_eq(cm_texel_points(&options, depth, &image), CM_OK);
    for (int i = 0; i < 48; i++)
    {
        const double z = (double)depth[i], a = x[i % 8], b = y[i / 8];
        REQUIRE(fabs((double)uv[0][i] - column[i % 8] / 128.0) < 1e-7, "%d", i);
        REQUIRE(fabs((double)uv[1][i] - row[i / 8] / 96.0) < 1e-7, "%d", i);
        if (i == 5)
        {
            REQUIRE(isnan(got[i]) && isnan(range[i]) && isnan(point[0][i]), "%g", (double)range[i]);
            continue;
        }
        REQUIRE(got[i] == depth[i] && point[2][i] == depth[i], "%d", i);
        REQUIRE(fabs((double)point[0][i] - a * z) < 1e-6 &&
                    fabs((double)point[1][i] - b * z) < 1e-6,
                "%d: %g", i, (double)point[0][i]);
        REQUIRE(fabs((double)range[i] - z * sqrt(1 + a * a + b * b)) < 1e-6, "%d", i);
    }
}
END_TEST

/* ---- matrices ---- */

/* A point of the world, seen by the scan and taken to the base's axes, is where the base sees it. */
START_TEST(matrices_are_of_the_base)
{
    const double twist[2][6] = {{0.3, -0.2, 0.5, 0.4, -0.7, 0.2}, {-1.3, 2.2, 0.1, 1.4, 0.3, -0.9}};
    cm_pose base, scan;
    double matrix[16], seen[3], wanted[3];
    const double world[3] = {1.3, -0.4, 2.9}, unit = 0.01;
    cm_pose_exp(twist[0], &base);
    cm_pose_exp(twist[1], &scan);
    ck_assert_int_eq(cm_texel_matrix(&base, &scan, unit, matrix), CM_OK);
    cm_pose_apply(&scan, world, seen);
    cm_pose_apply(&base, world, wanted);
    for (int i = 0; i < 3; i++)
    {
        const double *m = &matrix[4 * i];
        const double got = unit * (m[0] * seen[0] + m[1] * seen[1] + m[2] * seen[2]) + m[3];
        REQUIRE(fabs(got - unit * wanted[i]) < 1e-15, "%d: %g", i, got - unit * wanted[i]);
        REQUIRE(matrix[12 + i] == 0.0, "%g", matrix[12 + i]);
    }
    ck_assert_int_eq(cm_texel_matrix(&scan, &scan, unit, matrix), CM_OK);
    for (int i = 0; i < 16; i++)
    {
        REQUIRE(matrix[i] == (i % 5 == 0 ? 1.0 : 0.0), "%d: %g", i, matrix[i]);
    }
    cm_pose wrong = base;
    wrong.rotation.row[0][0] = 3.0;
    ck_assert_int_eq(cm_texel_matrix(&wrong, &scan, unit, matrix), CM_ERROR_CAMERA);
    ck_assert_int_eq(cm_texel_matrix(&base, &wrong, unit, matrix), CM_ERROR_CAMERA);
    ck_assert_int_eq(cm_texel_matrix(&base, &scan, 0.0, matrix), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_texel_matrix(&base, &scan, NAN, matrix), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_texel_matrix(NULL, &scan, unit, matrix), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_texel_matrix(&base, &scan, unit, NULL), CM_ERROR_ARGUMENT);
}
END_TEST

/* ---- worlds ---- */

static cm_scene *world_of(double wall, double box_left)
{
    cm_scene *scene = NULL;
    const cm_primitive plane = {.size = sizeof plane,
                                .kind = CM_PRIMITIVE_PLANE,
                                .first = {0.0, 0.0, wall},
                                .second = {0.0, 0.0, 1.0},
                                .material = {{0.25, 0.5, 1.0}, 1.0}};
    const cm_primitive box = {.size = sizeof box,
                              .kind = CM_PRIMITIVE_BOX,
                              .first = {box_left, -900.0, 0.5 * wall},
                              .second = {900.0, 900.0, 0.5001 * wall},
                              .material = {{1.0, 0.0, 0.0}, 1.0}};
    ck_assert_int_eq(cm_scene_create(&scene), CM_OK);
    ck_assert_int_eq(cm_scene_add(scene, &plane, NULL), CM_OK);
    ck_assert_int_eq(cm_scene_add(scene, &box, NULL), CM_OK);
    return scene;
}

/* A wall in centimetres, and a box before its right half whose edge is a quarter of a sample from the middle of one: there,
 * and there alone, depth is between both. */
START_TEST(worlds_are_seen_in_metres)
{
    for (int threads = 0; threads < 3; threads++)
    {
        cm_texel_options options = some_options(CM_TEXEL_EVEN_SPACES);
        options.unit = 0.01;
        options.oversampling = threads == 2 ? 2 : 1;
        const double edge = (4.0 * 16.0 + 4.0 - 64.0) / (64.0 / tan(0.425)) * 150.0;
        cm_scene *scene = world_of(300.0, edge);
        cm_pool *pool = NULL;
        static float color[96 * 128 * 3], depth[48], range[48], point[3][48];
        const cm_texel_image image = {.size = sizeof image,
                                      .color = color,
                                      .depth = depth,
                                      .range = range,
                                      .point = {point[0], point[1], point[2]}};
        ck_assert_int_eq(cm_pool_create((unsigned)threads + 1, &pool), CM_OK);
        ck_assert_int_eq(cm_texel_render(scene, &at_origin, &options, pool, &image), CM_OK);
        for (int i = 0; i < 48; i++)
        {
            const double expected = i % 8 < 4 ? 3.0 : i % 8 > 4 ? 1.5 : 0.25 * 3.0 + 0.75 * 1.5;
            REQUIRE(fabs((double)depth[i] - expected) < 1e-6, "%d: %g", i, (double)depth[i]);
            REQUIRE((double)range[i] >= expected - 1e-6, "%d: %g", i, (double)range[i]);
        }
        for (int i = 0; i < 96 * 128; i++)
        {
            const int is_box = i % 128 >= 68;
            REQUIRE(color[3 * i] == (is_box ? 1.0f : 0.25f) &&
                        color[3 * i + 1] == (is_box ? 0.0f : 0.5f),
                    "%d: %g", i, (double)color[3 * i]);
        }
        cm_pool_destroy(pool);
        cm_scene_destroy(scene);
    }
}
END_TEST

/* Clouds of two poses, brought together by their matrices, lie on the same wall. */
START_TEST(clouds_come_together)
{
    const double twist[6] = {0.2, 0.1, -0.3, 0.05, -0.2, 0.3};
    const cm_texel_options options = some_options(CM_TEXEL_EVEN_ANGLES);
    cm_scene *scene = world_of(3.0, 800.0);
    cm_pose scan;
    double matrix[16];
    float point[3][48];
    const cm_texel_image image = {.size = sizeof image, .point = {point[0], point[1], point[2]}};
    cm_pose_exp(twist, &scan);
    ck_assert_int_eq(cm_texel_matrix(&at_origin, &scan, 1.0, matrix), CM_OK);
    ck_assert_int_eq(cm_texel_render(scene, &scan, &options, NULL, &image), CM_OK);
    for (int i = 0; i < 48; i++)
    {
        const double z = matrix[8] * (double)point[0][i] + matrix[9] * (double)point[1][i] +
                         matrix[10] * (double)point[2][i] + matrix[11];
        /* 1 / depth is linear on the picture of a plane, so the mean of depth is a little off */
        REQUIRE(fabs(z - 3.0) < 3e-3, "%d: %g", i, z);
    }
    cm_scene_destroy(scene);
}
END_TEST

START_TEST(nothing_is_nan_and_black)
{
    const cm_texel_options options = some_options(CM_TEXEL_EVEN_SPACES);
    static float color[96 * 128 * 3], depth[48], u[48];
    const cm_texel_image image = {.size = sizeof image, .color = color, .depth = depth};
    const cm_texel_image places = {.size = sizeof places, .uv = {u}};
    cm_scene *scene = NULL;
    ck_assert_int_eq(cm_scene_create(&scene), CM_OK);
    color[7] = 3.0f;
    ck_assert_int_eq(cm_texel_render(scene, &at_origin, &options, NULL, &image), CM_OK);
    REQUIRE(isnan(depth[0]) && isnan(depth[47]) && color[7] == 0.0f, "%g", (double)depth[0]);
    ck_assert_int_eq(cm_texel_render(scene, &at_origin, &options, NULL, &places), CM_OK);
    REQUIRE(u[0] == 0.0625f, "%g", (double)u[0]);
    cm_scene_destroy(scene);
}
END_TEST

/* ---- bad input ---- */

START_TEST(options_that_cannot_be_are_refused)
{
    const cm_texel_options good = some_options(CM_TEXEL_EVEN_SPACES);
    cm_texel_options bad[12];
    float value[48] = {0};
    for (int i = 0; i < 12; i++)
    {
        bad[i] = good;
    }
    bad[0].field = 0.0;
    bad[1].field = 3.2;
    bad[2].field = NAN;
    bad[3].columns = 129;
    bad[4].rows = 97;
    bad[5].window = 97;
    bad[6].oversampling = 17;
    bad[7].width = bad[7].height = 65536;
    bad[8].spacing = (cm_texel_spacing)2;
    bad[9].unit = -1.0;
    bad[10].unit = INFINITY;
    bad[11].unit = NAN;
    cm_scene *scene = world_of(3.0, 800.0);
    const cm_texel_image image = {.size = sizeof image, .depth = value};
    for (int i = 0; i < 12; i++)
    {
        ck_assert_int_eq(cm_texel_complete(&bad[i]), CM_ERROR_RANGE);
        ck_assert_int_eq(cm_texel_places(&bad[i], NULL, NULL, NULL, NULL), CM_ERROR_RANGE);
        ck_assert_int_eq(cm_texel_sample(&bad[i], value, value), CM_ERROR_RANGE);
        ck_assert_int_eq(cm_texel_points(&bad[i], value, &image), CM_ERROR_RANGE);
        ck_assert_int_eq(cm_texel_render(scene, &at_origin, &bad[i], NULL, &image), CM_ERROR_RANGE);
    }
    cm_texel_options small = good;
    small.size = 4;
    cm_texel_image wrong = image;
    wrong.size = 4;
    cm_pose none = at_origin;
    none.position[1] = NAN;
    ck_assert_int_eq(cm_texel_complete(NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_texel_complete(&small), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_texel_places(NULL, NULL, NULL, NULL, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_texel_sample(&good, NULL, value), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_texel_sample(&good, value, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_texel_points(&good, NULL, &image), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_texel_points(&good, value, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_texel_points(&good, value, &wrong), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_texel_render(NULL, &at_origin, &good, NULL, &image), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_texel_render(scene, NULL, &good, NULL, &image), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_texel_render(scene, &at_origin, &good, NULL, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_texel_render(scene, &at_origin, &good, NULL, &wrong), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_texel_render(scene, &none, &good, NULL, &image), CM_ERROR_CAMERA);
    REQUIRE(value[0] == 0.0f, "written");
    cm_scene_destroy(scene);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {the_buffer_is_linearised,
                                  the_buffer_has_ends,
                                  zeros_stand_for_the_camera_of_the_source,
                                  spaces_and_angles_are_even,
                                  samples_are_means_of_blocks,
                                  windows_between_pixels_count_parts,
                                  points_lie_on_their_rays,
                                  matrices_are_of_the_base,
                                  worlds_are_seen_in_metres,
                                  clouds_come_together,
                                  nothing_is_nan_and_black,
                                  options_that_cannot_be_are_refused,
                                  NULL};
    return run_suite("texel", tests);
}
