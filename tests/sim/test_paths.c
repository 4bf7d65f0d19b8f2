/* SPDX-License-Identifier: MIT
 *
 * Paths: in a sphere, where the answer is known, for every number of bounces; the light of the surroundings; and the numbers
 * that both are drawn with.
 */
#include "modules/sim/low_discrepancy.h"
#include "tests/sim/sphere_of_light.h"

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
    ck_assert_int_eq(tof_environment_add(instant, &even, &options, &points, &radiance), CM_OK);
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
    ck_assert_int_eq(tof_environment_add(instant, &even, &options, &points, &radiance), CM_OK);
    REQUIRE(fabs(seen.ambient[2] - 1.5 / 5.0) < 5e-3, "%g", seen.ambient[2]);
    tof_instant_destroy(instant);
    cm_tof_scene_destroy(scene);
    cm_scene_destroy(world);
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
        ck_assert(tof_environment_radiance(&e, d) == i + 0.5);
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

int main(void)
{
    const TTest *const tests[] = {bounces, same_bits, surroundings, picture, even_numbers, NULL};
    return run_suite("paths", tests);
}
