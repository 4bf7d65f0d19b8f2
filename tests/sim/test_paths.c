/* SPDX-License-Identifier: MIT
 *
 * Paths: in a sphere, where the answer is known, for every number of bounces; the light of the surroundings; and the numbers
 * that both are drawn with.
 */
#include "modules/sim/low_discrepancy.h"
#include "modules/sim/map_cells.h"
#include "modules/sim/tof_world.h"
#include "tests/sim/sphere_of_light.h"

#include <time.h>

static void trace(const sphere_of_light *s, const cm_tof_options *options, size_t from, size_t n,
                  seen_places *seen)
{
    tof_points points = points_of(&s->seen, n);
    tof_radiance radiance = radiance_of(seen);
    for (int k = 0; k < 3; k++)
    {
        points.position[k] += from;
        points.normal[k] += from;
        points.to_camera[k] += from;
    }
    points.range += from;
    points.id += from;
    points.number += from;
    ck_assert_int_eq(tof_paths_add(s->instant, &s->lamp, 1, options, &s->waves, &points, &radiance),
                     CM_OK);
}

static double complex mean_of(const seen_places *seen)
{
    double complex sum = 0.0;
    for (int i = 0; i < PLACES; i++)
    {
        sum += seen->real[i] + I * seen->imaginary[i];
    }
    return sum / PLACES;
}

/* 1.216921 m of one bounce, 1.499765 m of all. */
START_TEST(bounces)
{
    static sphere_of_light s;
    static seen_places seen;
    static const int counts[] = {1, 2, 5, 30};
    make_sphere(&s, NULL);
    const double k = s.waves.number[0];
    for (int i = 0; i < 4; i++)
    {
        const cm_tof_options options = {
            .size = sizeof options, .bounces = counts[i], .paths = 128, .seed = 7};
        trace(&s, &options, 0, PLACES, &seen);
        const double complex truth = sphere_truth(k, counts[i]);
        const double measured = distance_with(k, mean_of(&seen));
        const double right = distance_with(k, truth);
        printf("%d bounces: %.6f m, %.6f\n", counts[i], measured, right);
        REQUIRE(fabs(measured - right) < 3e-4 && cabs(mean_of(&seen) - truth) < 1e-3 * cabs(truth),
                "%d bounces: %.6f m, not %.6f", counts[i], measured, right);
    }
    free_sphere(&s);
}
END_TEST

/* The same of facets that scatter nothing, and the same bits however places are handed over. */
START_TEST(same_bits)
{
    static sphere_of_light s;
    static seen_places all;
    static seen_places part;
    static const uint32_t paths[] = {1, 24, 2500};
    make_sphere(&s, NULL);
    for (int i = 0; i < 3; i++)
    {
        const cm_tof_options options = {.size = sizeof options, .bounces = 3, .paths = paths[i]};
        trace(&s, &options, 0, 40, &all);
        for (size_t from = 0; from < 40; from += 8)
        {
            trace(&s, &options, from, 8, &part);
            for (size_t j = 0; j < 8; j++)
            {
                REQUIRE(part.real[j] == all.real[from + j] &&
                            part.imaginary[j] == all.imaginary[from + j] &&
                            part.total[j] == all.total[from + j],
                        "place %zu of %u paths", from + j, (unsigned)paths[i]);
            }
        }
    }
    free_sphere(&s);
}
END_TEST

static void add_surroundings(const tof_instant *instant, const cm_tof_environment *environment,
                             const cm_tof_options *options, const tof_points *points,
                             tof_radiance *radiance)
{
    tof_sky *sky = NULL;
    ck_assert_int_eq(sky_create(environment, NULL, &sky), CM_OK);
    ck_assert_int_eq(tof_environment_add(instant, sky, options, points, radiance), CM_OK);
    sky_destroy(sky);
}

/* In a furnace that shines as surfaces do, facets of an open world show their albedo; below a plate a floor is dark where
 * it sees nothing else. */
START_TEST(surroundings)
{
    const cm_cook_torrance metal = {sizeof metal, 0.2, 0.7, 0.4, 2.8, 8.45};
    const cm_tof_options options = {.size = sizeof options, .paths = 1024};
    cm_brdf *brdf = NULL;
    cm_scene *world = NULL;
    cm_tof_scene *scene = NULL;
    tof_instant *instant = NULL;
    static seen_places seen;
    ck_assert_int_eq(cm_brdf_create_cook_torrance(&metal, &brdf), CM_OK);
    ck_assert_int_eq(cm_scene_create(&world), CM_OK);
    const cm_primitive floor = {.size = sizeof floor,
                                .kind = CM_PRIMITIVE_PLANE,
                                .second = {0, 0, 1},
                                .material = {{1, 1, 1}, .reflectance = 0.5},
                                .brdf = brdf};
    const cm_primitive plate = {.size = sizeof plate,
                                .kind = CM_PRIMITIVE_CYLINDER,
                                .first = {10, 0, 1},
                                .second = {10, 0, 1.001},
                                .radius = 2.0,
                                .material = {{1, 1, 1}, .reflectance = 0.5}};
    ck_assert_int_eq(cm_scene_add(world, &floor, NULL), CM_OK);
    ck_assert_int_eq(cm_scene_add(world, &plate, NULL), CM_OK);
    ck_assert_int_eq(cm_tof_scene_create(world, &scene), CM_OK);
    ck_assert_int_eq(tof_instant_create(scene, 0.0, &instant), CM_OK);
    /* Far off on the floor; on the plate; below its middle, of Lambert's law. */
    static const double at[3][3] = {{-1000, 0, 0}, {10, 0, 1.001}, {10, 0, 0}};
    for (size_t i = 0; i < 3; i++)
    {
        for (int k = 0; k < 3; k++)
        {
            seen.position[k][i] = at[i][k];
            seen.normal[k][i] = k == 2 ? 1.0 : 0.0;
        }
        seen.to_camera[0][i] = 0.6;
        seen.to_camera[2][i] = 0.8;
        seen.range[i] = 1.0;
        seen.id[i] = i == 1 ? 1 : 0;
    }
    tof_radiance radiance = radiance_of(&seen);
    const tof_points points = points_of(&seen, 3);
    const cm_tof_environment even = {.size = sizeof even, .constant = 3.0};
    add_surroundings(instant, &even, &options, &points, &radiance);
    const double albedo = cm_brdf_albedo(brdf, acos(0.8));
    REQUIRE(fabs(seen.ambient[0] - 1.5 * albedo) < 0.01, "%g, not %g", seen.ambient[0],
            1.5 * albedo);
    REQUIRE(fabs(seen.ambient[1] - 1.5) < 1e-9, "%g", seen.ambient[1]);
    ck_assert(seen.ambient[2] > 0.0 && seen.ambient[2] < seen.ambient[0]);
    tof_instant_destroy(instant);
    cm_tof_scene_destroy(scene);
    cm_scene_destroy(world);
    /* By Lambert's law, of a disc of 2 m in 1 m: 1 / (1 + 4) of the light passes by. */
    cm_primitive dull = floor;
    dull.brdf = NULL;
    ck_assert_int_eq(cm_scene_create(&world), CM_OK);
    ck_assert_int_eq(cm_scene_add(world, &dull, NULL), CM_OK);
    ck_assert_int_eq(cm_scene_add(world, &plate, NULL), CM_OK);
    ck_assert_int_eq(cm_tof_scene_create(world, &scene), CM_OK);
    ck_assert_int_eq(tof_instant_create(scene, 0.0, &instant), CM_OK);
    radiance = radiance_of(&seen);
    add_surroundings(instant, &even, &options, &points, &radiance);
    REQUIRE(fabs(seen.ambient[2] - 1.5 / 5.0) < 5e-3, "%g", seen.ambient[2]);
    tof_instant_destroy(instant);
    cm_tof_scene_destroy(scene);
    cm_scene_destroy(world);
    cm_brdf_destroy(brdf);
}
END_TEST

enum
{
    SKY_EDGE = 64,
    SKY_CELLS = 6 * SKY_EDGE * SKY_EDGE
};

/* A floor under an open sky, and places on it. */
typedef struct open_floor
{
    cm_scene *world;
    cm_tof_scene *scene;
    tof_instant *instant;
    seen_places seen;
} open_floor;

static void make_floor(open_floor *made, const cm_brdf *brdf)
{
    const cm_primitive floor = {.size = sizeof floor,
                                .kind = CM_PRIMITIVE_PLANE,
                                .second = {0, 0, 1},
                                .material = {{1, 1, 1}, .reflectance = 0.5},
                                .brdf = brdf};
    memset(made, 0, sizeof *made);
    ck_assert_int_eq(cm_scene_create(&made->world), CM_OK);
    ck_assert_int_eq(cm_scene_add(made->world, &floor, NULL), CM_OK);
    ck_assert_int_eq(cm_tof_scene_create(made->world, &made->scene), CM_OK);
    ck_assert_int_eq(tof_instant_create(made->scene, 0.0, &made->instant), CM_OK);
    for (int i = 0; i < PLACES; i++)
    {
        made->seen.position[0][i] = 0.1 * i;
        made->seen.normal[2][i] = 1.0;
        made->seen.to_camera[0][i] = 0.6;
        made->seen.to_camera[2][i] = 0.8;
        made->seen.range[i] = 1.0;
        made->seen.number[i] = (uint32_t)i;
    }
}

static void free_floor(open_floor *made)
{
    tof_instant_destroy(made->instant);
    cm_tof_scene_destroy(made->scene);
    cm_scene_destroy(made->world);
}

/* Of radiance 1 in one cell, whose sides are great circles: the integral of the cosine by Lambert's formula for polygons
 * (1760), half the sum of the sides' angles times the upward part of their planes' normals. */
static double irradiance_of_cell(const cm_mapping *mapping, size_t cell)
{
    static const int step[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    double corner[4][3], sum = 0.0;
    for (int i = 0; i < 4; i++)
    {
        const double uv[2] = {2.0 * ((double)(cell % SKY_EDGE) + step[i][0]) / SKY_EDGE - 1.0,
                              2.0 * ((double)(cell / SKY_EDGE % SKY_EDGE) + step[i][1]) / SKY_EDGE -
                                  1.0};
        cm_inverse(mapping, (uint8_t)(cell / SKY_EDGE / SKY_EDGE), uv, corner[i]);
    }
    for (int i = 0; i < 4; i++)
    {
        const double *a = corner[i], *b = corner[(i + 1) % 4];
        const double across[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                  a[0] * b[1] - a[1] * b[0]};
        const double sine =
            sqrt(across[0] * across[0] + across[1] * across[1] + across[2] * across[2]);
        const double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        sum += 0.5 * atan2(sine, cosine) * across[2] / sine;
    }
    return fabs(sum);
}

static size_t cell_towards(const cm_mapping *mapping, double x, double y, double z)
{
    const double direction[3] = {x, y, z};
    double uv[2];
    const uint8_t face = cm_forward(mapping, direction, uv);
    const size_t column = (size_t)(0.5 * (uv[0] + 1.0) * SKY_EDGE);
    const size_t row = (size_t)(0.5 * (uv[1] + 1.0) * SKY_EDGE);
    return (face * (size_t)SKY_EDGE + row) * SKY_EDGE + column;
}

/* A sun of one cell, 1.4 degrees wide: every place sees all of it, though its rays are few. */
START_TEST(small_sun)
{
    static open_floor at;
    static float radiance[SKY_CELLS];
    static const double towards[3][3] = {{0.3, 0.2, 0.9}, {-0.9, 0.2, 0.4}, {0.1, -0.99, 0.08}};
    make_floor(&at, NULL);
    cm_mapping *mapping = make_mapping("tangent", NULL);
    for (int dim = 0; dim < 2; dim++)
    {
        for (int i = 0; i < 3; i++)
        {
            const size_t cell = cell_towards(mapping, towards[i][0], towards[i][1], towards[i][2]);
            const double sun = 1e5;
            for (size_t k = 0; k < SKY_CELLS; k++)
            {
                radiance[k] = dim ? 2.0f : 0.0f;
            }
            radiance[cell] = (float)sun;
            const cm_tof_environment e = {.size = sizeof e,
                                          .mapping = mapping,
                                          .edge = SKY_EDGE,
                                          .radiance = radiance,
                                          .constant = dim ? 3.0 : 0.0};
            const cm_tof_options options = {.size = sizeof options};
            const tof_points points = points_of(&at.seen, PLACES);
            tof_radiance found = radiance_of(&at.seen);
            add_surroundings(at.instant, &e, &options, &points, &found);
            const double bright = (sun - (dim ? 2.0 : 0.0)) * irradiance_of_cell(mapping, cell);
            const double truth = 0.5 / PI * (bright + (dim ? PI * 5.0 : 0.0));
            double sum = 0.0;
            for (int k = 0; k < PLACES; k++)
            {
                sum += at.seen.ambient[k];
                REQUIRE(fabs(at.seen.ambient[k] - truth) < (dim ? 0.05 : 0.01) * truth,
                        "sun %d, %d, place %d: %g, not %g", i, dim, k, at.seen.ambient[k], truth);
            }
            REQUIRE(fabs(sum / PLACES - truth) < 2e-3 * truth, "sun %d, %d: %g, not %g", i, dim,
                    sum / PLACES, truth);
        }
    }
    cm_mapping_destroy(mapping);
    free_floor(&at);
}
END_TEST

/* Radiance 1 + z / 2 above a floor: its irradiance is pi (1 + 1 / 3), rays to the brighter half or not. */
START_TEST(slope)
{
    static open_floor at;
    static float radiance[SKY_CELLS];
    make_floor(&at, NULL);
    cm_mapping *mapping = make_mapping("coupled", NULL);
    for (size_t k = 0; k < SKY_CELLS; k++)
    {
        const double uv[2] = {2.0 * ((double)(k % SKY_EDGE) + 0.5) / SKY_EDGE - 1.0,
                              2.0 * ((double)(k / SKY_EDGE % SKY_EDGE) + 0.5) / SKY_EDGE - 1.0};
        double d[3];
        cm_inverse(mapping, (uint8_t)(k / SKY_EDGE / SKY_EDGE), uv, d);
        radiance[k] = (float)(1.0 + 0.5 * d[2]);
    }
    const cm_tof_environment e = {
        .size = sizeof e, .mapping = mapping, .edge = SKY_EDGE, .radiance = radiance};
    const cm_tof_options options = {.size = sizeof options};
    const tof_points points = points_of(&at.seen, PLACES);
    tof_radiance found = radiance_of(&at.seen);
    const double truth = 0.5 * (1.0 + 1.0 / 3.0);
    double sum = 0.0;
    add_surroundings(at.instant, &e, &options, &points, &found);
    for (int k = 0; k < PLACES; k++)
    {
        sum += at.seen.ambient[k] / PLACES;
        REQUIRE(fabs(at.seen.ambient[k] - truth) < 0.1 * truth, "place %d: %g, not %g", k,
                at.seen.ambient[k], truth);
    }
    REQUIRE(fabs(sum - truth) < 3e-3 * truth, "%g, not %g", sum, truth);
    cm_mapping_destroy(mapping);
    free_floor(&at);
}
END_TEST

/* A picture of one radiance, in a mapping to six faces or to one, is as what is everywhere. */
START_TEST(even_picture)
{
    const cm_cook_torrance metal = {sizeof metal, 0.2, 0.7, 0.4, 2.8, 8.45};
    static const char *const names[] = {"coupled", "healpix", "octahedral"};
    static open_floor at;
    static seen_places other;
    static float radiance[SKY_CELLS];
    cm_brdf *brdf = NULL;
    ck_assert_int_eq(cm_brdf_create_cook_torrance(&metal, &brdf), CM_OK);
    make_floor(&at, brdf);
    for (size_t k = 0; k < SKY_CELLS; k++)
    {
        radiance[k] = 3.0f;
    }
    for (int i = 0; i < 3; i++)
    {
        cm_mapping *mapping = make_mapping(names[i], NULL);
        const cm_tof_environment e = {
            .size = sizeof e, .mapping = mapping, .edge = SKY_EDGE, .radiance = radiance};
        const cm_tof_options options = {.size = sizeof options, .paths = 256};
        const tof_points points = points_of(&at.seen, PLACES);
        tof_radiance found = radiance_of(&at.seen);
        double sum = 0.0;
        add_surroundings(at.instant, &e, &options, &points, &found);
        for (int k = 0; k < PLACES; k++)
        {
            sum += at.seen.ambient[k] / PLACES;
        }
        const double truth = 1.5 * cm_brdf_albedo(brdf, acos(0.8));
        REQUIRE(fabs(sum - truth) < 5e-3 * truth, "%s: %g, not %g", names[i], sum, truth);
        const cm_tof_environment everywhere = {.size = sizeof everywhere, .constant = 3.0};
        found = radiance_of(&other);
        add_surroundings(at.instant, &everywhere, &options, &points, &found);
        for (int k = 0; k < PLACES; k++)
        {
            REQUIRE(fabs(other.ambient[k] - at.seen.ambient[k]) < 1e-9 * truth,
                    "%s, place %d: %g, not %g", names[i], k, at.seen.ambient[k], other.ambient[k]);
        }
        cm_mapping_destroy(mapping);
    }
    free_floor(&at);
    cm_brdf_destroy(brdf);
}
END_TEST

/* A picture is shown where its cells are. */
START_TEST(picture)
{
    cm_mapping *mapping = make_mapping("tangent", NULL);
    float radiance[6 * 4 * 4];
    for (size_t i = 0; i < sizeof radiance / sizeof *radiance; i++)
    {
        radiance[i] = (float)i;
    }
    const cm_tof_environment e = {
        .size = sizeof e, .mapping = mapping, .edge = 4, .radiance = radiance, .constant = 0.5};
    for (int i = 0; i < 6 * 16; i++)
    {
        const double uv[2] = {(i % 4 + 0.5) / 2.0 - 1.0, (i / 4 % 4 + 0.5) / 2.0 - 1.0};
        double d[3];
        cm_inverse(mapping, (uint8_t)(i / 16), uv, d);
        ck_assert(sky_radiance(&e, d) == i + 0.5);
    }
    cm_mapping_destroy(mapping);
}
END_TEST

/* Of the first 256 points one is in each of 256 parts, however the square is divided; also of each scrambling. */
START_TEST(even_numbers)
{
    for (uint32_t seed = 0; seed < 20; seed++)
    {
        const uint32_t words[4] = {seed * 77, seed * 1234567, seed * 987654321, seed};
        for (int bits = 0; bits <= 8; bits++)
        {
            uint8_t has[256] = {0};
            uint8_t column[256] = {0};
            for (uint32_t i = 0; i < 256; i++)
            {
                double u[3];
                low_discrepancy_point(words, i, u);
                const int across = (int)(u[0] * (1 << bits));
                const int down = (int)(u[1] * (1 << (8 - bits)));
                has[across << (8 - bits) | down]++;
                column[(int)(u[2] * 256)]++;
            }
            for (int i = 0; i < 256; i++)
            {
                REQUIRE(has[i] == 1 && column[i] == 1, "seed %u, %d bits", (unsigned)seed, bits);
            }
        }
    }
}
END_TEST

/* Two texels of the first row shine alike: the density of drawing one is by both their solid angles. */
static void check_texels(const tof_sky *sky, const cm_mapping *mapping, int column)
{
    const int shines[2] = {column, SKY_EDGE / 2};
    double stretches = 0.0, direction[3], jacobian[6], density = -1.0;
    for (int i = 1; i >= 0; i--)
    {
        const double uv[2] = {(2 * shines[i] + 1.0) / SKY_EDGE - 1.0, 1.0 / SKY_EDGE - 1.0};
        cm_inverse(mapping, 0, uv, direction);
        cm_inverse_jacobian(mapping, 0, uv, jacobian);
        stretches += map_stretch(jacobian);
    }
    ck_assert(sky_look(sky, direction, &density) == 1.0);
    ck_assert_double_eq_tol(density * stretches, SKY_EDGE * SKY_EDGE / 4.0, 1e-6);
}

/* Returns the processor's time. */
static clock_t take_and_return(cm_tof_scene *scene, const cm_tof_environment *around, int column)
{
    tof_sky *taken = NULL;
    const clock_t begin = clock();
    ck_assert_int_eq(tof_scene_take_sky(scene, around, NULL, &taken), CM_OK);
    const clock_t took = clock() - begin;
    check_texels(taken, around->mapping, column);
    tof_scene_return_sky(scene, taken);
    return took;
}

/* Fills the picture, in which but two texels are dark. */
static void light_texels(float *radiance, int column)
{
    memset(radiance, 0, SKY_CELLS * sizeof *radiance);
    radiance[column] = radiance[SKY_EDGE / 2] = 1.0f;
}

/* Surroundings that stay as they are, wherever they lie in memory, are made ready once; another mapping's or a changed
 * picture's anew. */
START_TEST(kept_surroundings)
{
    static float radiance[SKY_CELLS], copied[SKY_CELLS];
    static const char *const names[] = {"tangent", "coupled", "tangent"};
    const cm_primitive floor = {
        .size = sizeof floor, .kind = CM_PRIMITIVE_PLANE, .second = {0, 0, 1}};
    cm_scene *world = NULL;
    cm_tof_scene *scene = NULL;
    tof_sky *kept = NULL;
    ck_assert_int_eq(cm_scene_create(&world), CM_OK);
    ck_assert_int_eq(cm_scene_add(world, &floor, NULL), CM_OK);
    ck_assert_int_eq(cm_tof_scene_create(world, &scene), CM_OK);
    for (int i = 0; i < 3; i++)
    {
        cm_mapping *mapping = make_mapping(names[i], NULL), *same = NULL;
        ck_assert_int_eq(cm_mapping_copy(mapping, &same), CM_OK);
        light_texels(radiance, 3);
        memcpy(copied, radiance, sizeof copied);
        const cm_tof_environment e = {
            .size = sizeof e, .mapping = mapping, .edge = SKY_EDGE, .radiance = radiance};
        cm_tof_environment again = e;
        again.mapping = same;
        again.radiance = copied;
        const clock_t first = take_and_return(scene, &e, 3);
        ck_assert_int_lt(take_and_return(scene, &again, 3), first / 4 + 1);
        light_texels(radiance, 0); /* in the same memory */
        (void)take_and_return(scene, &e, 0);
        (void)take_and_return(scene, &again, 3);
        cm_mapping_destroy(mapping);
        cm_mapping_destroy(same);
    }
    const cm_tof_environment even = {.size = sizeof even, .constant = 2.0};
    ck_assert_int_eq(tof_scene_take_sky(scene, &even, NULL, &kept), CM_OK);
    ck_assert(sky_constant(kept) == 2.0 && sky_contrast(kept) == 0.0);
    tof_scene_return_sky(scene, kept);
    cm_tof_scene_destroy(scene);
    cm_scene_destroy(world);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {bounces,      same_bits, surroundings, small_sun,         slope,
                                  even_picture, picture,   even_numbers, kept_surroundings, NULL};
    return run_suite("paths", tests);
}
