/* SPDX-License-Identifier: MIT
 *
 * Drawing: each pixel of a closed surface once, in every camera; depth against the closed form; the same bits however.
 */
#define _POSIX_C_SOURCE 200809L

#include <cubemap/depth.h>
#include <cubemap/raster.h>

#include "tests/suite.h"

/* A camera, with what it was made of. */
typedef struct some_camera
{
    const char *name;
    cm_camera *camera;
    cm_mapping *mapping;
    size_t width;
    size_t height;
} some_camera;

enum
{
    CAMERAS = 7
};

/* Perspective without and with distortion, and both centres; faces of several mappings; a fisheye. */
static some_camera camera_at(int which)
{
    static const char *const names[CAMERAS] = {"plain",       "halves",  "distorted",  "coupled",
                                               "equiangular", "healpix", "equidistant"};
    some_camera c = {.name = names[which]};
    cm_camera_options options = {.size = sizeof options,
                                 .width = 160,
                                 .height = 120,
                                 .fx = 130.0,
                                 .fy = 131.0,
                                 .cx = 79.5,
                                 .cy = 59.5,
                                 .pixel_centre = which == 1 ? 0.5 : 0.0};
    options.distortion[0] = which == 2 ? -0.12 : 0.0;
    options.distortion[3] = which == 2 ? 0.002 : 0.0;
    if (which > 2)
    {
        if (cm_mapping_create(names[which], NULL, &c.mapping) != CM_OK)
        {
            return c;
        }
        options.mapping = c.mapping;
        options.width = which == 6 ? 101 : 50; /* faces that tiles do not fit */
        options.height = which == 6 ? 101 : 300;
        options.pixel_centre = 0.5;
    }
    ck_assert_msg(cm_camera_create(&options, &c.camera) == CM_OK, "%s", c.name);
    c.width = options.width;
    c.height = options.height;
    return c;
}

static void drop(some_camera *c)
{
    cm_camera_destroy(c->camera);
    cm_mapping_destroy(c->mapping);
}

static cm_raster *canvas(const some_camera *c, const char *instructions)
{
    cm_raster *raster = NULL;
    ck_assert_int_eq(cm_raster_create(c->camera, 0.0, instructions, &raster), CM_OK);
    return raster;
}

static void ray_of(const some_camera *c, size_t i, double ray[3])
{
    const double centre = cm_camera_describe(c->camera)->pixel_centre;
    const double column = (double)(i % c->width) + centre;
    const double row = (double)(i / c->width) + centre;
    cm_camera_ray_array(c->camera, 1, &column, &row, &ray[0], &ray[1], &ray[2]);
}

static double next_random(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) * 0x1p-23 - 1.0;
}

/* ---- coverage ---- */

/* A box around the camera, each side of n x n squares of two triangles. */
typedef struct closed_box
{
    cm_triangles triangles;
    double *position;
    uint32_t *index;
} closed_box;

static closed_box make_box(size_t n, double size)
{
    closed_box box = {.triangles = {.size = sizeof box.triangles}};
    const size_t side = (n + 1) * (n + 1);
    box.position = calloc(6 * side * 3, sizeof *box.position);
    box.index = calloc(6 * n * n * 6, sizeof *box.index);
    size_t count = 0;
    for (size_t f = 0; f < 6; f++)
    {
        for (size_t i = 0; i < side; i++)
        {
            double *p = box.position + 3 * (f * side + i);
            const double u = 2.0 * (double)(i % (n + 1)) / (double)n - 1.0;
            const double v = 2.0 * (double)(i / (n + 1)) / (double)n - 1.0;
            p[f % 3] = f < 3 ? size : -size;
            p[(f + 1) % 3] = u * size;
            p[(f + 2) % 3] = v * size;
        }
        for (size_t i = 0; i < n * n; i++)
        {
            const uint32_t at = (uint32_t)(f * side + i / n * (n + 1) + i % n);
            const uint32_t below = at + (uint32_t)n + 1;
            const uint32_t corners[6] = {at, at + 1, below, below, at + 1, below + 1};
            memcpy(box.index + count, corners, sizeof corners);
            count += 6;
        }
    }
    box.triangles.vertex_count = 6 * side;
    box.triangles.position = box.position;
    box.triangles.index = box.index;
    box.triangles.triangle_count = count / 3;
    return box;
}

static void drop_box(closed_box *box)
{
    free(box->position);
    free(box->index);
}

/* How many triangles have each pixel, each drawn alone. */
static void count_covers(const some_camera *c, const closed_box *box, const cm_pose *pose,
                         unsigned *covers)
{
    cm_raster *raster = canvas(c, NULL);
    uint32_t *id = calloc(c->width * c->height, sizeof *id);
    memset(covers, 0, c->width * c->height * sizeof *covers);
    for (size_t t = 0; t < box->triangles.triangle_count; t++)
    {
        cm_triangles one = box->triangles;
        one.index += 3 * t;
        one.triangle_count = 1;
        cm_raster_clear(raster);
        ck_assert_int_eq(cm_raster_triangles(raster, pose, &one, 1), CM_OK);
        ck_assert_int_eq(cm_raster_read(raster, NULL, id), CM_OK);
        for (size_t i = 0; i < c->width * c->height; i++)
        {
            covers[i] += id[i] == 0;
        }
    }
    free(id);
    cm_raster_destroy(raster);
}

static void check_covers(const some_camera *c, size_t n, const cm_pose *pose)
{
    closed_box box = make_box(n, 2.0);
    unsigned *covers = calloc(c->width * c->height, sizeof *covers);
    count_covers(c, &box, pose, covers);
    for (size_t i = 0; i < c->width * c->height; i++)
    {
        double ray[3];
        ray_of(c, i, ray);
        REQUIRE(covers[i] == (isnan(ray[0]) ? 0 : 1), "%s, box of %zu: pixel %zu, %zu has %u",
                c->name, n, i % c->width, i / c->width, covers[i]);
    }
    free(covers);
    drop_box(&box);
}

/* Edges go through pixel centres where the box stands straight: along face diagonals of cubes, and through corners. */
START_TEST(a_closed_box_covers_each_pixel_once)
{
    for (int which = 0; which < CAMERAS; which++)
    {
        some_camera c = camera_at(which);
        cm_pose pose = {.position = {0.3, -0.2, 0.1}};
        if (c.camera == NULL)
        {
            continue;
        }
        check_covers(&c, 1, NULL);
        check_covers(&c, 2, NULL);
        check_covers(&c, 5, NULL);
        ck_assert_int_eq(cm_rotation_from_angles(20.0, 30.0, 40.0, &pose.rotation), CM_OK);
        check_covers(&c, 3, &pose);
        drop(&c);
    }
}
END_TEST

/* Vertices exactly at pixel centres: fans around them, of which one triangle has the centre. */
START_TEST(fans_around_pixel_centres)
{
    some_camera c = camera_at(0);
    uint32_t state = 1;
    for (int k = 0; k < 200; k++)
    {
        double ray[3];
        double position[8][3];
        const size_t pixel = 60 * c.width + 40 + (size_t)k % 80;
        ray_of(&c, pixel, ray);
        for (int j = 0; j < 3; j++)
        {
            position[0][j] = 3.0 * ray[j];
        }
        /* half of them go through other centres, but for rounding */
        static const int apart[7][2] = {{5, 0}, {5, 5}, {0, 5}, {-5, 5}, {-5, 0}, {0, -5}, {5, -5}};
        for (int j = 0; j < 7; j++)
        {
            const double angle = 6.283185307179586 * (j + 0.3 * next_random(&state)) / 7.0;
            position[1 + j][0] =
                position[0][0] + (k % 2 ? apart[j][0] * 3.0 / 130.0 : 0.1 * cos(angle));
            position[1 + j][1] =
                position[0][1] + (k % 2 ? apart[j][1] * 3.0 / 131.0 : 0.1 * sin(angle));
            position[1 + j][2] = 3.0;
        }
        unsigned covers = 0;
        cm_raster *raster = canvas(&c, NULL);
        for (uint32_t j = 0; j < 7; j++)
        {
            const uint32_t index[3] = {0, 1 + j, 1 + (j + 1) % 7};
            const cm_triangles one = {.size = sizeof one,
                                      .vertex_count = 8,
                                      .position = position[0],
                                      .triangle_count = 1,
                                      .index = index};
            uint32_t id[160 * 120];
            cm_raster_clear(raster);
            ck_assert_int_eq(cm_raster_triangles(raster, NULL, &one, 1), CM_OK);
            cm_raster_read(raster, NULL, id);
            covers += id[pixel] == 0;
        }
        REQUIRE(covers == 1, "fan %d: %u", k, covers);
        cm_raster_destroy(raster);
    }
    drop(&c);
}
END_TEST

/* Of a square whose edges go through centres the upper and the left are its own. */
START_TEST(upper_and_left_edges_belong_to_it)
{
    const cm_camera_options options = {.size = sizeof options,
                                       .width = 16,
                                       .height = 16,
                                       .fx = 1.0,
                                       .fy = 1.0,
                                       .cx = 0.0,
                                       .cy = 0.0};
    const double position[4][3] = {{4, 4, 1}, {8, 4, 1}, {4, 8, 1}, {8, 8, 1}};
    const uint32_t index[6] = {0, 1, 2, 2, 1, 3};
    const cm_triangles square = {.size = sizeof square,
                                 .vertex_count = 4,
                                 .position = position[0],
                                 .triangle_count = 2,
                                 .index = index};
    uint32_t id[256];
    some_camera c = {.width = 16, .height = 16};
    ck_assert_int_eq(cm_camera_create(&options, &c.camera), CM_OK);
    cm_raster *raster = canvas(&c, NULL);
    ck_assert_int_eq(cm_raster_triangles(raster, NULL, &square, 1), CM_OK);
    cm_raster_read(raster, NULL, id);
    for (int i = 0; i < 256; i++)
    {
        const int is_in = i % 16 >= 4 && i % 16 < 8 && i / 16 >= 4 && i / 16 < 8;
        REQUIRE((id[i] != CM_RASTER_NOTHING) == is_in, "pixel %d, %d", i % 16, i / 16);
    }
    cm_raster_destroy(raster);
    drop(&c);
}
END_TEST

/* ---- depth ---- */

START_TEST(depth_is_that_of_the_closed_form)
{
    for (int which = 0; which < CAMERAS; which++)
    {
        some_camera c = camera_at(which);
        closed_box box = make_box(4, 2.0);
        if (c.camera == NULL)
        {
            continue;
        }
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
        if (c.camera == NULL)
        {
            continue;
        }
        const size_t pixels = c.width * c.height;
        float *image = calloc(pixels, sizeof *image);
        for (int k = 0; k < 60; k++)
        {
            float v[7];
            for (int j = 0; j < 6; j++)
            {
                v[j] = (float)(2.0 * next_random(&state));
            }
            v[6] = (float)(0.3 + 0.25 * next_random(&state));
            v[2] = k % 3 == 0 ? v[2] : fabsf(v[2]) + 1.0f;
            const cm_discs disc = {.size = sizeof disc,
                                   .count = 1,
                                   .centre = {v, v + 1, v + 2},
                                   .normal = {v + 3, v + 4, v + 5},
                                   .radius = v + 6};
            cm_raster *raster = canvas(&c, NULL);
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
            cm_raster_destroy(raster);
        }
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
        if (c.camera == NULL)
        {
            continue;
        }
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

static void draw_many(const some_camera *c, unsigned threads, int is_back, float *image,
                      uint32_t *id)
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
    ck_assert_int_eq(cm_raster_discs(raster, NULL, is_back ? &again : &discs, threads), CM_OK);
    ck_assert_int_eq(cm_raster_points(raster, NULL, &points, threads), CM_OK);
    ck_assert_int_eq(cm_raster_triangles(raster, NULL, &triangles, threads), CM_OK);
    ck_assert_int_eq(cm_raster_discs(raster, NULL, is_back ? &discs : &again, threads), CM_OK);
    cm_raster_read(raster, image, id);
    cm_raster_destroy(raster);
}

START_TEST(threads_and_order_do_not_matter)
{
    for (int which = 0; which < CAMERAS; which++)
    {
        some_camera c = camera_at(which);
        if (c.camera == NULL)
        {
            continue;
        }
        const size_t pixels = c.width * c.height;
        float *image = calloc(2 * pixels, sizeof *image);
        uint32_t *id = calloc(2 * pixels, sizeof *id);
        const unsigned threads[] = {1, 2, 7, 1};
        size_t seen = 0;
        draw_many(&c, 1, 0, image, id);
        for (int i = 0; i < 4; i++)
        {
            draw_many(&c, threads[i], i % 2, image + pixels, id + pixels);
            REQUIRE(memcmp(image, image + pixels, pixels * sizeof *image) == 0 &&
                        memcmp(id, id + pixels, pixels * sizeof *id) == 0,
                    "%s, %u threads", c.name, threads[i]);
        }
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
    const TTest *const tests[] = {
        a_closed_box_covers_each_pixel_once, fans_around_pixel_centres,
        upper_and_left_edges_belong_to_it,   depth_is_that_of_the_closed_form,
        discs_are_where_rays_meet_them,      points_are_at_their_pixels,
        threads_and_order_do_not_matter,     what_is_no_primitive_is_left_out,
        planes_may_pass_the_camera,          NULL};
    return run_suite("raster", tests);
}
