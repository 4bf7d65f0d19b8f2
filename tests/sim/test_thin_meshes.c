/* SPDX-License-Identifier: MIT
 *
 * Meshes and adaptive sampling: wires that are thinner than a pixel are as with all samples; surfaces of many triangles are
 * sampled where they end, and nowhere else.
 */
#include "tof_stage.h"

#include <stdlib.h>

enum
{
    MOST_TRIANGLES = 40000
};

/* Triangles whose vertices are their own, or an array's. */
typedef struct soup
{
    size_t triangles;
    double position[9 * MOST_TRIANGLES];
    uint32_t index[3 * MOST_TRIANGLES];
} soup;

static void add_triangle(soup *to, const double a[3], const double b[3], const double c[3])
{
    const double *const corner[3] = {a, b, c};
    ck_assert_uint_lt(to->triangles, MOST_TRIANGLES);
    for (size_t k = 0; k < 3; k++)
    {
        const size_t v = 3 * to->triangles + k;
        memcpy(to->position + 3 * v, corner[k], 3 * sizeof(double));
        to->index[v] = (uint32_t)v;
    }
    to->triangles++;
}

static void add_quad(soup *to, const double a[3], const double b[3], const double c[3],
                     const double d[3])
{
    add_triangle(to, a, b, c);
    add_triangle(to, a, c, d);
}

static cm_mesh *make_mesh(const soup *of)
{
    const cm_mesh_options options = {.size = sizeof options,
                                     .vertex_count = 3 * of->triangles,
                                     .position = of->position,
                                     .triangle_count = of->triangles,
                                     .index = of->index,
                                     .material = {{1, 1, 1}, 0.5}};
    cm_mesh *mesh = NULL;
    ck_assert_int_eq(cm_mesh_create(&options, &mesh), CM_OK);
    return mesh;
}

/* A flat wire from one place to another, across the view. */
static void add_wire(soup *to, double x, double y, double length, double angle, double width)
{
    const double along[2] = {cos(angle), sin(angle)};
    double corner[4][3];
    for (int i = 0; i < 4; i++)
    {
        const double far = (i == 1 || i == 2 ? 1.0 : 0.0) * length;
        const double side = (i < 2 ? -0.5 : 0.5) * width;
        corner[i][0] = x + far * along[0] - side * along[1];
        corner[i][1] = y + far * along[1] + side * along[0];
        corner[i][2] = 1.2;
    }
    add_quad(to, corner[0], corner[1], corner[2], corner[3]);
}

/* The same with three sides: closed, so that no edge has one triangle alone. */
static void add_needle(soup *to, double x, double y, double length, double angle, double width)
{
    double ring[2][3][3];
    for (int end = 0; end < 2; end++)
    {
        for (int k = 0; k < 3; k++)
        {
            const double turn = 2.0 * PI / 3.0 * k;
            const double across = 0.5 * width * cos(turn);
            ring[end][k][0] = x + end * length * cos(angle) - across * sin(angle);
            ring[end][k][1] = y + end * length * sin(angle) + across * cos(angle);
            ring[end][k][2] = 1.2 + 0.5 * width * sin(turn);
        }
    }
    for (int k = 0; k < 3; k++)
    {
        const int next = (k + 1) % 3;
        add_quad(to, ring[0][k], ring[0][next], ring[1][next], ring[1][k]);
    }
    add_triangle(to, ring[0][0], ring[0][1], ring[0][2]);
    add_triangle(to, ring[1][2], ring[1][1], ring[1][0]);
}

/* Pixels with all samples, after the distances were found as with all of them in all pixels. */
static uint64_t compare_stage(const stage *at, cm_pool *pool, const char *what)
{
    static float full[PIXELS];
    cm_tof_options options = {
        .size = sizeof options, .sample_columns = 3, .sample_rows = 3, .full = 1};
    ck_assert_int_eq(simulate(at, &options), CM_OK);
    memcpy(full, distance, sizeof full);
    options.full = 0;
    cm_tof_report report = {.size = sizeof report};
    cm_tof_result result = {.size = sizeof result, .distance = distance, .report = &report};
    ck_assert_int_eq(
        cm_tof_simulate(at->scene, &at->sensor, &at->light, 1, NULL, 0.0, &options, pool, &result),
        CM_OK);
    for (size_t i = 0; i < PIXELS; i++)
    {
        REQUIRE(fabs((double)distance[i] - (double)full[i]) <= 1e-4,
                "%s, pixel %zu %zu: %g m, %g with all samples", what, i % WIDTH, i / WIDTH,
                (double)distance[i], (double)full[i]);
    }
    return report.oversampled;
}

/* The same of a mesh before the wall. */
static uint64_t compare_with_full(const cm_mesh *mesh, cm_pool *pool, const char *what)
{
    const cm_primitive both[2] = {wall,
                                  {.size = sizeof(cm_primitive),
                                   .kind = CM_PRIMITIVE_MESH,
                                   .mesh = mesh,
                                   .pose = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}},
                                   .material = {{1, 1, 1}, 1.0}}};
    stage at = make_stage(both, 2);
    const uint64_t oversampled = compare_stage(&at, pool, what);
    free_stage(&at);
    return oversampled;
}

/* A pixel is 24 mm wide there. */
START_TEST(wires_thinner_than_a_pixel_are_never_missed)
{
    static soup wires;
    static const double widths[] = {0.0005, 0.003, 0.01, 0.02, 0.03};
    for (int closed = 0; closed < 2; closed++)
    {
        for (size_t w = 0; w < sizeof widths / sizeof *widths; w++)
        {
            char what[80];
            wires.triangles = 0;
            for (int i = 0; i < 12; i++)
            {
                (closed ? add_needle : add_wire)(&wires, -0.6 + 0.1 * i, -0.5 + 0.011 * i, 1.0,
                                                 0.7 + 0.13 * i, widths[w]);
                (closed ? add_needle : add_wire)(&wires, -0.7, -0.5 + 0.083 * i, 1.4, 0.01 * i,
                                                 widths[w]);
            }
            cm_mesh *mesh = make_mesh(&wires);
            (void)snprintf(what, sizeof what, "%s of %g m", closed ? "needles" : "wires",
                           widths[w]);
            ck_assert_uint_gt(compare_with_full(mesh, NULL, what), 0);
            cm_mesh_destroy(mesh);
        }
    }
}
END_TEST

/* Of wires, rods, boxes and balls, from several places of the lamp. */
START_TEST(thin_shadows_are_never_missed)
{
    static soup wires;
    static const double places[][3] = {{-0.4, 0, 0}, {0.2, 0.3, 0.1}, {0, -0.5, -0.2}};
    wires.triangles = 0;
    for (int i = 0; i < 8; i++)
    {
        add_wire(&wires, -0.6 + 0.15 * i, -0.5 + 0.011 * i, 1.0, 0.7 + 0.13 * i, 0.004);
    }
    cm_mesh *mesh = make_mesh(&wires);
    const cm_primitive all[5] = {wall,
                                 {.size = sizeof(cm_primitive),
                                  .kind = CM_PRIMITIVE_MESH,
                                  .mesh = mesh,
                                  .pose = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}},
                                  .material = {{1, 1, 1}, 1.0}},
                                 {.size = sizeof(cm_primitive),
                                  .kind = CM_PRIMITIVE_CYLINDER,
                                  .first = {-0.5, 0.3, 1.0},
                                  .second = {0.5, 0.1, 1.3},
                                  .radius = 0.003,
                                  .material = {{1, 1, 1}, 0.5}},
                                 {.size = sizeof(cm_primitive),
                                  .kind = CM_PRIMITIVE_BOX,
                                  .first = {-0.3, -0.4, 0.9},
                                  .second = {-0.295, 0.2, 0.905},
                                  .material = {{1, 1, 1}, 0.5}},
                                 {.size = sizeof(cm_primitive),
                                  .kind = CM_PRIMITIVE_SPHERE,
                                  .first = {0.3, -0.2, 1.1},
                                  .radius = 0.008,
                                  .material = {{1, 1, 1}, 0.5}}};
    stage at = make_stage(all, 5);
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
    {
        memcpy(at.light.position, places[i], sizeof at.light.position);
        ck_assert_uint_lt(compare_stage(&at, NULL, "shadows"), PIXELS);
    }
    free_stage(&at);
    cm_mesh_destroy(mesh);
}
END_TEST

/* A plate of 80 x 80 squares, each of two triangles with vertices of their own; every other one winds the other way. */
START_TEST(triangles_of_one_surface_are_no_edges)
{
    static soup plate;
    const double step = 0.01;
    plate.triangles = 0;
    for (int r = 0; r < 80; r++)
    {
        for (int c = 0; c < 80; c++)
        {
            const double x = -0.4 + step * c, y = -0.4 + step * r;
            const double a[3] = {x, y, 1.2}, b[3] = {x + step, y, 1.2},
                         c_[3] = {x + step, y + step, 1.2}, d[3] = {x, y + step, 1.2};
            if ((r + c) % 2 == 0)
            {
                add_quad(&plate, a, b, c_, d);
            }
            else
            {
                add_quad(&plate, a, d, c_, b);
            }
        }
    }
    /* corners are sums: those that are one place are made one number */
    for (size_t i = 0; i < 9 * plate.triangles; i++)
    {
        plate.position[i] = round(plate.position[i] * 1000.0) / 1000.0;
    }
    cm_mesh *mesh = make_mesh(&plate);
    const uint64_t oversampled = compare_with_full(mesh, NULL, "plate");
    /* its rim has 4 x 33 pixels, and the picture's border 220 */
    ck_assert_uint_lt(oversampled, 220 + 4 * 33 * 4);
    cm_mesh_destroy(mesh);
}
END_TEST

static void ball_place(int ring, int sector, double to[3])
{
    const double polar = PI * ring / 60.0, azimuth = 2.0 * PI * (sector % 120) / 120.0;
    to[0] = 0.3 * sin(polar) * cos(azimuth);
    to[1] = 0.3 * sin(polar) * sin(azimuth);
    to[2] = 1.2 + 0.3 * cos(polar);
}

/* A ball of 14,400 triangles, two of them of no area at each pole's sectors, by several threads. */
START_TEST(balls_are_sampled_at_their_outline)
{
    static soup ball;
    cm_pool *pool = NULL;
    ball.triangles = 0;
    for (int r = 0; r < 60; r++)
    {
        for (int c = 0; c < 120; c++)
        {
            double a[3], b[3], d[3], e[3];
            ball_place(r, c, a);
            ball_place(r, c + 1, b);
            ball_place(r + 1, c + 1, d);
            ball_place(r + 1, c, e);
            add_quad(&ball, a, b, d, e);
        }
    }
    ck_assert_int_eq(cm_pool_create(7, &pool), CM_OK);
    cm_mesh *mesh = make_mesh(&ball);
    const uint64_t oversampled = compare_with_full(mesh, pool, "ball");
    ck_assert_uint_lt(oversampled, PIXELS / 2);
    cm_mesh_destroy(mesh);
    cm_pool_destroy(pool);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        wires_thinner_than_a_pixel_are_never_missed, thin_shadows_are_never_missed,
        triangles_of_one_surface_are_no_edges, balls_are_sampled_at_their_outline, NULL};
    return run_suite("thin meshes", tests);
}
