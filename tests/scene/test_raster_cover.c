/* SPDX-License-Identifier: MIT
 *
 * Drawing: each pixel of a closed surface once, in every camera; who has pixels on edges and at corners.
 */
#define _POSIX_C_SOURCE 200809L

#include "drawn_box.h"

/* ---- coverage ---- */

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

int main(void)
{
    const TTest *const tests[] = {a_closed_box_covers_each_pixel_once, fans_around_pixel_centres,
                                  upper_and_left_edges_belong_to_it, NULL};
    return run_suite("raster cover", tests);
}
