/* SPDX-License-Identifier: MIT
 *
 * Depth images: cleaning, ranges, maps and halves against closed forms.
 */
#define _POSIX_C_SOURCE 200809L

#include "rough_image.h"

/* ---- cleaning ---- */

START_TEST(what_is_no_measurement_becomes_nan_and_is_counted)
{
    const float values[10] = {1.0f,  0.0f, NAN,  INFINITY, -INFINITY,
                              -2.0f, 0.1f, 9.0f, 1.7e7f,   4.0f};
    const float wanted[10] = {2.0f, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, 8.0f};
    float depth[10];
    const cm_image picture = {.size = sizeof picture,
                              .data = (void *)(uintptr_t)values,
                              .type = CM_PIXEL_FLOAT,
                              .width = 5,
                              .height = 2,
                              .channels = 1};
    const cm_depth_limits limits = {
        .size = sizeof limits, .unit = 2.0, .nearest = 0.5, .farthest = 10.0};
    cm_depth_count count = {.size = sizeof count};
    ck_assert_int_eq(cm_depth_clean(&picture, &limits, 1, depth, &count), CM_OK);
    for (int i = 0; i < 10; i++)
    {
        REQUIRE(isnan(wanted[i]) ? isnan(depth[i]) : depth[i] == wanted[i], "%d: %g", i,
                (double)depth[i]);
    }
    ck_assert_uint_eq(count.valid, 2);
    ck_assert_uint_eq(count.zero, 1);
    ck_assert_uint_eq(count.nan, 1);
    ck_assert_uint_eq(count.infinite, 2);
    ck_assert_uint_eq(count.negative, 1);
    ck_assert_uint_eq(count.near, 1);
    ck_assert_uint_eq(count.far, 2);
}
END_TEST

/* Floats of a picture's own unit that lie close, as most do, and apart: each times the unit, rounded once. */
START_TEST(floats_are_of_their_unit)
{
    enum
    {
        COLUMNS = 37,
        ROWS = 5
    };
    float stored[2 * COLUMNS * ROWS], depth[COLUMNS * ROWS];
    const double units[] = {0.001, 0.3048, 1.0};
    for (size_t way = 0; way < 6; way++)
    {
        const size_t step = 1 + way / 3;
        const double unit = units[way % 3];
        for (size_t i = 0; i < COLUMNS * ROWS; i++)
        {
            stored[step * i] = i % 11 == 3 ? NAN : 123.4f + 17.3f * (float)i;
        }
        const cm_image picture = {.size = sizeof picture,
                                  .data = stored,
                                  .type = CM_PIXEL_FLOAT,
                                  .width = COLUMNS,
                                  .height = ROWS,
                                  .channels = 1,
                                  .pixel_stride = (ptrdiff_t)(step * sizeof *stored)};
        const cm_depth_limits limits = {
            .size = sizeof limits, .unit = unit, .farthest = 3000.0 * unit};
        cm_depth_count count = {.size = sizeof count};
        ck_assert_int_eq(cm_depth_clean(&picture, &limits, 1, depth, &count), CM_OK);
        size_t valid = 0;
        for (size_t i = 0; i < COLUMNS * ROWS; i++)
        {
            const float wanted = (float)((double)stored[step * i] * unit);
            const int is_valid = wanted <= (float)(3000.0 * unit);
            REQUIRE(is_valid ? depth[i] == wanted : isnan(depth[i]), "unit %g, %zu: %g", unit, i,
                    (double)depth[i]);
            valid += (size_t)is_valid;
        }
        ck_assert_uint_eq(count.valid, valid);
        ck_assert(valid > 120 && valid < COLUMNS * ROWS - 17);
    }
}
END_TEST

START_TEST(sixteen_bits_are_rounded_once)
{
    enum
    {
        ALL = 65536
    };
    uint16_t *stored = calloc(ALL, sizeof *stored);
    float *depth = floats(ALL);
    for (size_t i = 0; i < ALL; i++)
    {
        stored[ALL - 1 - i] = (uint16_t)i; /* upside down: strides may be negative */
    }
    const cm_image picture = {.size = sizeof picture,
                              .data = stored + ALL - 1,
                              .type = CM_PIXEL_U16,
                              .width = 256,
                              .height = 256,
                              .channels = 1,
                              .row_stride = -512,
                              .pixel_stride = -2};
    const cm_depth_limits limits = {.size = sizeof limits, .unit = 1.0 / 5000.0};
    ck_assert_int_eq(cm_depth_clean(&picture, &limits, 2, depth, NULL), CM_OK);
    REQUIRE(isnan(depth[0]), "0 is %g", (double)depth[0]);
    for (size_t i = 1; i < ALL; i++)
    {
        REQUIRE(depth[i] == (float)((double)i * (1.0 / 5000.0)), "%zu", i);
    }
    free(stored);
    free(depth);
}
END_TEST

START_TEST(bad_limits_and_pictures_are_refused)
{
    float depth[1] = {5.0f};
    uint8_t byte[4] = {0};
    cm_image picture = {.size = sizeof picture,
                        .data = byte,
                        .type = CM_PIXEL_U8,
                        .width = 1,
                        .height = 1,
                        .channels = 1};
    cm_depth_limits limits = {.size = sizeof limits, .unit = 1.0};
    ck_assert_int_eq(cm_depth_clean(&picture, &limits, 1, depth, NULL), CM_ERROR_RANGE);
    picture.type = CM_PIXEL_U16;
    const double bad[] = {0.0, -1.0, (double)NAN, (double)INFINITY};
    for (int i = 0; i < 4; i++)
    {
        limits.unit = bad[i];
        ck_assert_int_eq(cm_depth_clean(&picture, &limits, 1, depth, NULL), CM_ERROR_RANGE);
    }
    limits.unit = 1.0;
    limits.farthest = 1.0;
    limits.nearest = 2.0;
    ck_assert_int_eq(cm_depth_clean(&picture, &limits, 1, depth, NULL), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_depth_clean(NULL, &limits, 1, depth, NULL), CM_ERROR_ARGUMENT);
    REQUIRE(depth[0] == 5.0f, "written");
}
END_TEST

/* ---- a plane, end to end ---- */

/* Columns and rows of all pixels' centres, and room for three numbers each. */
static double *all_pixels(const cm_camera_options *options, size_t pixels)
{
    double *all = calloc(5 * pixels, sizeof *all);
    ck_assert_ptr_nonnull(all);
    for (size_t i = 0; i < pixels; i++)
    {
        all[i] = (double)(i % options->width) + options->pixel_centre;
        all[pixels + i] = (double)(i / options->width) + options->pixel_centre;
    }
    return all;
}

/* Depth (or range) where the rays that the camera itself tells meet the plane normal x = distance. */
static float *image_of_plane(const cm_camera_options *options, const double normal[3],
                             double distance, int is_range)
{
    cm_camera *camera = camera_of(options);
    const size_t pixels = (size_t)options->width * options->height;
    float *image = floats(pixels);
    double *all = all_pixels(options, pixels);
    double *x = all + 2 * pixels;
    double *y = all + 3 * pixels;
    double *z = all + 4 * pixels;
    cm_camera_ray_array(camera, pixels, all, all + pixels, x, y, z);
    for (size_t i = 0; i < pixels; i++)
    {
        const double t = distance / (normal[0] * x[i] + normal[1] * y[i] + normal[2] * z[i]);
        const double length = is_range ? sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]) : 1.0;
        image[i] = t > 0.0 && t < 50.0 ? (float)(t * length) : NAN;
    }
    free(all);
    cm_camera_destroy(camera);
    return image;
}

static void check_plane(const cm_camera_options *options, int is_range)
{
    const double normal[3] = {0.36, -0.48, 0.8};
    const double distance = 1.6;
    const size_t pixels = (size_t)options->width * options->height;
    float *image = image_of_plane(options, normal, distance, is_range);
    float *planes = floats(6 * pixels);
    cm_rays *rays = rays_of(options, NULL);
    cm_camera *camera = camera_of(options);
    const cm_depth_maps maps = {
        .size = sizeof maps,
        .is_range = is_range,
        .vertex = {planes, planes + pixels, planes + 2 * pixels},
        .normal = {planes + 3 * pixels, planes + 4 * pixels, planes + 5 * pixels}};
    ck_assert_int_eq(cm_depth_make_maps(rays, image, 1, &maps), CM_OK);
    size_t seen = 0;
    double *at = all_pixels(options, pixels);
    for (size_t i = 0; i < 3 * pixels; i++)
    {
        at[2 * pixels + i] = (double)planes[i];
    }
    double *column = calloc(2 * pixels, sizeof *column);
    double *row = column + pixels;
    cm_camera_project_array(camera, pixels, at + 2 * pixels, at + 3 * pixels, at + 4 * pixels,
                            column, row);
    for (size_t i = 0; i < pixels; i++)
    {
        const double v[3] = {(double)maps.vertex[0][i], (double)maps.vertex[1][i],
                             (double)maps.vertex[2][i]};
        if (!is_measured(image[i]))
        {
            REQUIRE(isnan(v[0]) && isnan(v[2]), "%zu", i);
            continue;
        }
        /* the vertex is on the plane, and in the middle of its pixel by whichever centres */
        const double off = v[0] * normal[0] + v[1] * normal[1] + v[2] * normal[2] - distance;
        const double size = fabs(v[0]) + fabs(v[1]) + fabs(v[2]);
        REQUIRE(fabs(off) <= 3e-7 * size, "%zu: %g", i, off);
        REQUIRE(fabs(column[i] - at[i]) <= 1e-3 && fabs(row[i] - at[pixels + i]) <= 1e-3,
                "%zu: %g %g", i, column[i], row[i]);
        const double n =
            -((double)maps.normal[0][i] * normal[0] + (double)maps.normal[1][i] * normal[1] +
              (double)maps.normal[2][i] * normal[2]);
        if (!isnan(n) && (double)image[i] < 5.0)
        {
            seen++;
            REQUIRE(n >= 1.0 - 1e-6, "%zu: normal off by %g", i, 1.0 - n);
        }
    }
    REQUIRE(seen > pixels / 8, "%zu normals of %zu", seen, pixels);
    free(at);
    free(column);
    cm_camera_destroy(camera);
    cm_rays_destroy(rays);
    free(image);
    free(planes);
}

START_TEST(a_plane_has_its_vertices_and_normals)
{
    cm_camera_options options = plain;
    check_plane(&options, 0);
    check_plane(&options, 1);
    options.pixel_centre = 0.5;
    check_plane(&options, 0);
    options.distortion[0] = -0.1;
    options.distortion[2] = 0.001;
    check_plane(&options, 0);
    check_plane(&options, 1);
}
END_TEST

START_TEST(a_plane_around_an_omnidirectional_camera)
{
    const char *const names[] = {"coupled", "healpix", "azimuthal:equidistant"};
    for (int i = 0; i < 3; i++)
    {
        cm_mapping *mapping = make_mapping(names[i], NULL);
        const uint32_t faces = i < 2 ? 6 : 1;
        cm_camera_options options = {.size = sizeof options,
                                     .width = 64,
                                     .height = 64 * faces,
                                     .pixel_centre = 0.5,
                                     .mapping = mapping};
        check_plane(&options, 1);
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* One that a seeded fault finds: half a pixel off is 1e-3 of depth here. */
START_TEST(halves_of_a_plane_lie_on_it)
{
    const double normal[3] = {0.6, 0.0, 0.8};
    for (int half = 0; half < 2; half++)
    {
        cm_camera_options options = plain;
        options.pixel_centre = half * 0.5;
        cm_camera_options small;
        ck_assert_int_eq(cm_depth_halve_camera(&options, &small), CM_OK);
        float *image = image_of_plane(&options, normal, 2.0, 0);
        float *wanted = image_of_plane(&small, normal, 2.0, 0);
        float *got = floats((size_t)small.width * small.height);
        cm_rays *rays = rays_of(&options, NULL);
        ck_assert_int_eq(cm_depth_halve(rays, image, 0.1, 1, got), CM_OK);
        for (size_t i = 0; i < (size_t)small.width * small.height; i++)
        {
            REQUIRE(fabsf(got[i] - wanted[i]) <= 4e-6f * wanted[i] * wanted[i], "%zu: %g not %g", i,
                    (double)got[i], (double)wanted[i]);
        }
        cm_rays_destroy(rays);
        free(image);
        free(wanted);
        free(got);
    }
}
END_TEST

START_TEST(halves_do_not_mix_surfaces)
{
    cm_camera_options options = plain;
    options.width = 4;
    options.height = 2;
    const float image[8] = {1.0f, 3.0f, NAN, -1.0f, 1.02f, 1.01f, 0.0f, INFINITY};
    float half[2];
    cm_rays *rays = rays_of(&options, NULL);
    ck_assert_int_eq(cm_depth_halve(rays, image, 0.05, 1, half), CM_OK);
    REQUIRE(fabsf(half[0] - 1.01f) <= 1e-6f, "%g", (double)half[0]);
    REQUIRE(isnan(half[1]), "%g", (double)half[1]);
    cm_rays_destroy(rays);
}
END_TEST

/* ---- ranges, radii ---- */

START_TEST(ranges_go_there_and_back)
{
    cm_rays *rays = rays_of(&plain, NULL);
    float *image = rough_image(PIXELS, WIDTH);
    float *range = floats(PIXELS);
    float *back = floats(PIXELS);
    ck_assert_int_eq(cm_depth_to_range(rays, image, 1, range), CM_OK);
    ck_assert_int_eq(cm_depth_from_range(rays, range, 1, back), CM_OK);
    for (size_t i = 0; i < PIXELS; i++)
    {
        const double x = ((double)(i % WIDTH) - plain.cx) / plain.fx;
        const double y = ((double)(i / WIDTH) - plain.cy) / plain.fy;
        const double wanted = (double)image[i] * sqrt(1.0 + x * x + y * y);
        REQUIRE(is_measured(image[i]) == is_measured(range[i]), "%zu", i);
        REQUIRE(!is_measured(image[i]) || (fabs((double)range[i] - wanted) <= 3e-7 * wanted &&
                                           fabsf(back[i] - image[i]) <= 4e-7f * image[i]),
                "%zu: %g not %g", i, (double)range[i], wanted);
    }
    cm_rays_destroy(rays);
    free(image);
    free(range);
    free(back);
}
END_TEST

START_TEST(radii_cover_pixels)
{
    float *image = floats(PIXELS);
    float *planes = floats(7 * (size_t)PIXELS);
    for (size_t i = 0; i < PIXELS; i++)
    {
        image[i] = 2.0f;
    }
    cm_rays *rays = rays_of(&plain, NULL);
    cm_depth_maps maps = {.size = sizeof maps, .radius = planes + 6 * (size_t)PIXELS};
    for (size_t k = 0; k < 3; k++)
    {
        maps.vertex[k] = planes + k * PIXELS;
        maps.normal[k] = planes + (3 + k) * PIXELS;
    }
    ck_assert_int_eq(cm_depth_make_maps(rays, image, 1, &maps), CM_OK);
    const double wanted = 2.0 * sqrt(2.0) / (0.5 * (plain.fx + plain.fy));
    for (size_t i = 0; i < PIXELS; i++)
    {
        REQUIRE(fabsf(maps.normal[2][i] + 1.0f) <= 4e-7f, "%zu: %g", i, (double)maps.normal[2][i]);
        REQUIRE(fabs((double)maps.radius[i] - wanted) <= 1e-6 * wanted, "%zu", i);
    }
    maps.normal[1] = NULL;
    ck_assert_int_eq(cm_depth_make_maps(rays, image, 1, &maps), CM_ERROR_ARGUMENT);
    cm_rays_destroy(rays);
    free(image);
    free(planes);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {what_is_no_measurement_becomes_nan_and_is_counted,
                                  floats_are_of_their_unit,
                                  sixteen_bits_are_rounded_once,
                                  bad_limits_and_pictures_are_refused,
                                  a_plane_has_its_vertices_and_normals,
                                  a_plane_around_an_omnidirectional_camera,
                                  halves_of_a_plane_lie_on_it,
                                  halves_do_not_mix_surfaces,
                                  ranges_go_there_and_back,
                                  radii_cover_pixels,
                                  NULL};
    return run_suite("depth", tests);
}
