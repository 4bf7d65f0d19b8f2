/* SPDX-License-Identifier: MIT
 *
 * Drawing: depth against the closed form; the same bits however; bad input.
 */
#define _POSIX_C_SOURCE 200809L

#include "drawn_box.h"

/* ---- depth ---- */

START_TEST(depth_is_that_of_the_closed_form)
{
    for (int which = 0; which < CAMERAS; which++)
    {
        some_camera c = camera_at(which);
        closed_box box = make_box(4, 2.0);
        const size_t pixels = c.width * c.height;
        float *image = calloc(3 * pixels, sizeof *image);
        cm_raster *raster = canvas(&c, NULL);
        ck_assert_int_eq(cm_raster_triangles(raster, NULL, &box.triangles, 1), CM_OK);
        cm_raster_read(raster, image, NULL);
        ck_assert_int_eq(
            cm_raster_weights(raster, NULL, &box.triangles, image + pixels, image + 2 * pixels),
            CM_OK);
        for (size_t i = 0; i < pixels; i++)
        {
            double r[3];
            ray_of(&c, i, r);
            const double wanted = 2.0 / fmax(fabs(r[0]), fmax(fabs(r[1]), fabs(r[2])));
            REQUIRE(isnan(r[0]) ? isnan(image[i]) : fabs((double)image[i] - wanted) <= 1e-6,
                    "%s %zu: %.9g not %.9g", c.name, i, (double)image[i], wanted);
            REQUIRE(isnan(r[0]) || image[pixels + i] + image[2 * pixels + i] <= 1.000001f, "%zu",
                    i);
        }
        cm_raster_destroy(raster);
        free(image);
        drop_box(&box);
        drop(&c);
    }
}
END_TEST

/* Discs of a plane, and points, against rays and planes done plainly. */
START_TEST(discs_are_where_rays_meet_them)
{
    for (int which = 0; which < CAMERAS; which++)
    {
        some_camera c = camera_at(which);
        uint32_t state = 11;
        const size_t pixels = c.width * c.height;
        float *image = calloc(pixels, sizeof *image);
        cm_raster *raster = canvas(&c, NULL);
        for (int k = 0; k < 180; k++)
        {
            float v[7];
            for (int j = 0; j < 6; j++)
            {
                v[j] = (float)(2.0 * next_random(&state));
            }
            v[6] = (float)(0.3 + 0.25 * next_random(&state)) * (k < 60 ? 1.0f : 0.05f);
            v[2] = k % 3 == 0 ? v[2] : fabsf(v[2]) + 1.0f;
            const cm_discs disc = {.size = sizeof disc,
                                   .count = 1,
                                   .centre = {v, v + 1, v + 2},
                                   .normal = {v + 3, v + 4, v + 5},
                                   .radius = v + 6};
            ck_assert_uint_eq(cm_raster_pixel_count(raster), pixels);
            cm_raster_clear(raster);
            ck_assert_int_eq(cm_raster_discs(raster, NULL, &disc, 1), CM_OK);
            cm_raster_read(raster, image, NULL);
            for (size_t i = 0; i < pixels; i++)
            {
                double r[3];
                ray_of(&c, i, r);
                double to = 0.0;
                double across = 0.0;
                for (int j = 0; j < 3; j++)
                {
                    to += (double)v[3 + j] * (double)v[j];
                    across += (double)v[3 + j] * r[j];
                }
                const double t = to / across;
                const double off = hypot(hypot(t * r[0] - (double)v[0], t * r[1] - (double)v[1]),
                                         t * r[2] - (double)v[2]);
                const double radius = (double)v[6];
                const int is_in = t > 0.0 && off < radius * (1.0 - 1e-4);
                const int is_out = !(t > 0.0 && off < radius * (1.0 + 1e-4));
                REQUIRE(!is_in || fabs((double)image[i] - t) <= 3e-5 * t,
                        "%s disc %d pixel %zu: %g not %g", c.name, k, i, (double)image[i], t);
                REQUIRE(!is_out || isnan(image[i]), "%s disc %d pixel %zu: %g", c.name, k, i,
                        (double)image[i]);
            }
        }
        cm_raster_destroy(raster);
        free(image);
        drop(&c);
    }
}
END_TEST

START_TEST(points_are_at_their_pixels)
{
    for (int which = 0; which < CAMERAS; which++)
    {
        some_camera c = camera_at(which);
        const size_t pixels = c.width * c.height;
        float *image = calloc(pixels, sizeof *image);
        uint32_t *id = calloc(pixels, sizeof *id);
        double *position = calloc(3 * pixels, sizeof *position);
        for (size_t i = 0; i < pixels; i++)
        {
            ray_of(&c, i, position + 3 * i);
            for (int k = 0; k < 3; k++)
            {
                position[3 * i + (size_t)k] *= 5.0;
            }
        }
        const cm_points points = {
            .size = sizeof points, .count = pixels, .position = position, .first_id = 7};
        cm_raster *raster = canvas(&c, NULL);
        ck_assert_int_eq(cm_raster_points(raster, NULL, &points, 1), CM_OK);
        cm_raster_read(raster, image, id);
        for (size_t i = 0; i < pixels; i++)
        {
            REQUIRE(isnan(position[3 * i]) ? id[i] == CM_RASTER_NOTHING
                                           : id[i] == i + 7 && fabsf(image[i] - 5.0f) <= 2e-6f,
                    "%s %zu: id %u", c.name, i, id[i]);
        }
        cm_raster_destroy(raster);
        free(image);
        free(id);
        free(position);
        drop(&c);
    }
}
END_TEST

/* ---- threads, order, bad input ---- */

enum
{
    MANY = 3000
};

static void draw_many(const some_camera *c, cm_pool *pool, unsigned threads, int is_back,
                      float *image, uint32_t *id)
{
    static float v[7][MANY];
    static double position[MANY][3];
    uint32_t state = 5;
    for (size_t i = 0; i < MANY; i++)
    {
        for (size_t k = 0; k < 6; k++)
        {
            v[k][i] = (float)(3.0 * next_random(&state));
        }
        for (size_t k = 0; k < 3; k++)
        {
            position[i][k] = 3.0 * next_random(&state);
        }
        v[6][i] = (float)(0.1 + 0.09 * next_random(&state));
        if (i % 8 == 0) /* seen from the edge, but for rounding */
        {
            v[5][i] = -(v[3][i] * v[0][i] + v[4][i] * v[1][i]) / v[2][i];
        }
    }
    /* two that are the same: the smaller id wins, whichever comes first */
    const cm_discs discs = {.size = sizeof discs,
                            .count = MANY,
                            .centre = {v[0], v[1], v[2]},
                            .normal = {v[3], v[4], v[5]},
                            .radius = v[6],
                            .first_id = 10000};
    cm_discs again = discs;
    again.first_id = 20000;
    const cm_triangles triangles = {.size = sizeof triangles,
                                    .vertex_count = MANY,
                                    .position = position[0],
                                    .triangle_count = MANY / 3};
    const cm_points points = {
        .size = sizeof points, .count = MANY, .position = position[0], .first_id = 30000};
    cm_raster *raster = canvas(c, NULL);
    ck_assert_int_eq(cm_raster_use_pool(raster, pool), CM_OK);
    ck_assert_int_eq(cm_raster_discs(raster, NULL, is_back ? &again : &discs, threads), CM_OK);
    ck_assert_int_eq(cm_raster_points(raster, NULL, &points, threads), CM_OK);
    ck_assert_int_eq(cm_raster_triangles(raster, NULL, &triangles, threads), CM_OK);
    ck_assert_int_eq(cm_raster_discs(raster, NULL, is_back ? &discs : &again, threads), CM_OK);
    cm_raster_read(raster, image, id);
    cm_raster_destroy(raster);
}

START_TEST(threads_and_order_do_not_matter)
{
    for (int which = 0; which < CAMERAS; which += (int)step_of(2))
    {
        some_camera c = camera_at(which);
        const size_t pixels = c.width * c.height;
        float *image = calloc(2 * pixels, sizeof *image);
        uint32_t *id = calloc(2 * pixels, sizeof *id);
        const unsigned threads[] = {1, 2, 7, 1, 0};
        cm_pool *pool = NULL;
        ck_assert_int_eq(cm_pool_create(3, &pool), CM_OK);
        size_t seen = 0;
        draw_many(&c, NULL, 1, 0, image, id);
        for (int i = 0; i < 5; i++)
        {
            draw_many(&c, i < 3 ? NULL : pool, threads[i], i % 2, image + pixels, id + pixels);
            REQUIRE(memcmp(image, image + pixels, pixels * sizeof *image) == 0 &&
                        memcmp(id, id + pixels, pixels * sizeof *id) == 0,
                    "%s, %u threads", c.name, threads[i]);
        }
        cm_pool_destroy(pool);
        for (size_t i = 0; i < pixels; i++)
        {
            seen += id[i] != CM_RASTER_NOTHING;
            REQUIRE(id[i] == CM_RASTER_NOTHING || id[i] < 20000 || id[i] >= 30000, "%u", id[i]);
        }
        REQUIRE(seen > pixels / 8, "%zu of %zu", seen, pixels);
        free(image);
        free(id);
        drop(&c);
    }
}
END_TEST

START_TEST(what_is_no_primitive_is_left_out)
{
    const double bad[] = {(double)NAN, (double)INFINITY, 1.7e308, -1e200, 0.0};
    for (int which = 0; which < 4; which += 3)
    {
        some_camera c = camera_at(which);
        const size_t pixels = c.width * c.height;
        uint32_t *id = calloc(pixels, sizeof *id);
        cm_raster *raster = canvas(&c, NULL);
        for (int i = 0; i < 5; i++)
        {
            const double position[3][3] = {{bad[i], 0, 1}, {bad[i], 1, bad[i]}, {0, 0, 0}};
            const float value = (float)bad[i];
            const float zero = 0.0f;
            const cm_triangles triangle = {.size = sizeof triangle,
                                           .vertex_count = 3,
                                           .position = position[0],
                                           .triangle_count = 1};
            const cm_discs disc = {.size = sizeof disc,
                                   .count = 1,
                                   .centre = {&value, &value, &value},
                                   .normal = {&value, &zero, &zero},
                                   .radius = &value};
            ck_assert_int_eq(cm_raster_triangles(raster, NULL, &triangle, 1), CM_OK);
            ck_assert_int_eq(cm_raster_discs(raster, NULL, &disc, 1), CM_OK);
        }
        cm_raster_read(raster, NULL, id);
        for (size_t i = 0; i < pixels; i++)
        {
            REQUIRE(id[i] == CM_RASTER_NOTHING, "%s %zu", c.name, i);
        }
        const uint32_t index[3] = {0, 1, 3};
        const double position[3][3] = {{0}};
        cm_triangles triangle = {.size = sizeof triangle,
                                 .vertex_count = 3,
                                 .position = position[0],
                                 .triangle_count = 1,
                                 .index = index};
        ck_assert_int_eq(cm_raster_triangles(raster, NULL, &triangle, 1), CM_ERROR_ARGUMENT);
        triangle.index = NULL;
        triangle.first_id = CM_RASTER_NOTHING;
        ck_assert_int_eq(cm_raster_triangles(raster, NULL, &triangle, 1), CM_ERROR_RANGE);
        ck_assert_int_eq(cm_raster_triangles(NULL, NULL, &triangle, 1), CM_ERROR_ARGUMENT);
        ck_assert_int_eq(cm_raster_use_pool(NULL, NULL), CM_ERROR_ARGUMENT);
        cm_raster *refused = NULL;
        ck_assert_int_eq(cm_raster_create(c.camera, -1.0, NULL, &refused), CM_ERROR_RANGE);
        ck_assert_int_eq(cm_raster_create(c.camera, 0.0, "abacus", &refused),
                         CM_ERROR_INSTRUCTIONS);
        cm_raster_destroy(raster);
        free(id);
        drop(&c);
    }
}
END_TEST

/* A triangle that reaches behind the camera, far and near. */
START_TEST(planes_may_pass_the_camera)
{
    some_camera c = camera_at(0);
    const size_t pixels = c.width * c.height;
    const double position[3][3] = {{-1e7, 1.0, -1e7}, {1e7, 1.0, -1e7}, {0.0, 1.0, 1.7e7}};
    const cm_triangles floor_below = {.size = sizeof floor_below,
                                      .vertex_count = 3,
                                      .position = position[0],
                                      .triangle_count = 1};
    float *image = calloc(pixels, sizeof *image);
    cm_raster *raster = NULL;
    ck_assert_int_eq(cm_raster_create(c.camera, 3.0, NULL, &raster), CM_OK);
    ck_assert_int_eq(cm_raster_triangles(raster, NULL, &floor_below, 1), CM_OK);
    cm_raster_read(raster, image, NULL);
    for (size_t i = 0; i < pixels; i++)
    {
        double r[3];
        ray_of(&c, i, r);
        const double t = 1.0 / r[1];
        REQUIRE(r[1] > 0.0 && t >= 3.0 ? fabs((double)image[i] - t) <= 2e-7 * t : isnan(image[i]),
                "%zu: %g", i, (double)image[i]);
    }
    cm_raster_destroy(raster);
    free(image);
    drop(&c);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {depth_is_that_of_the_closed_form,
                                  discs_are_where_rays_meet_them,
                                  points_are_at_their_pixels,
                                  threads_and_order_do_not_matter,
                                  what_is_no_primitive_is_left_out,
                                  planes_may_pass_the_camera,
                                  NULL};
    return run_suite("raster", tests);
}
