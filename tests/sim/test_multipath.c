/* SPDX-License-Identifier: MIT
 *
 * Virtual lights: in a sphere, where the answer is known, by maps of every mapping; beside paths in a corner; by every
 * instruction set; and shadows.
 */
#include <cubemap/options.h>

#include "modules/sim/gather_set.h"
#include "tests/sim/sphere_of_light.h"

#include <cubemap/pool.h>

/* Mean of the phasors of all places. */
static double complex mean_of(const seen_places *s, size_t n)
{
    double complex sum = 0.0;
    for (size_t i = 0; i < n; i++)
    {
        sum += s->real[i] + I * s->imaginary[i];
    }
    return sum / (double)n;
}

static void gather(const tof_instant *instant, const tof_lamp *lamp, size_t lamps,
                   const cm_tof_options *options, const tof_waves *waves, cm_pool *pool,
                   seen_places *seen)
{
    tof_virtual_lights *lights = NULL;
    tof_radiance radiance = radiance_of(seen);
    const tof_points points = points_of(seen, PLACES);
    ck_assert_int_eq(tof_virtual_lights_create(instant, lamp, lamps, options, waves, pool, &lights),
                     CM_OK);
    ck_assert_uint_eq(tof_virtual_lights_count(lights), options->lights ? options->lights : 338);
    ck_assert_int_eq(tof_virtual_lights_add(lights, &points, &radiance), CM_OK);
    tof_virtual_lights_destroy(lights);
}

START_TEST(sphere)
{
    static sphere_of_light s;
    make_sphere(&s, NULL);
    const double k = s.waves.number[0];
    ck_assert(fabs(distance_with(k, 0.0) - 1.0) < 1e-12);
    ck_assert(fabs(distance_with(k, sphere_truth(k, 1)) - 1.216921) < 5e-7);
    ck_assert(fabs(distance_with(k, sphere_truth(k, 100)) - 1.499765) < 5e-7);
    for (int visibility = 0; visibility < 2; visibility++)
    {
        const cm_tof_options options = {.size = sizeof options, .visibility = visibility};
        gather(s.instant, &s.lamp, 1, &options, &s.waves, NULL, &s.seen);
        const double mean = distance_with(k, mean_of(&s.seen, PLACES));
        double worst = 0.0;
        for (size_t i = 0; i < PLACES; i++)
        {
            const double one = distance_with(k, s.seen.real[i] + I * s.seen.imaginary[i]);
            worst = fmax(worst, fabs(one - 1.216921));
            REQUIRE(fabs(s.seen.total[i] - 0.25 / PI) < 2e-3 * 0.25 / PI, "%g",
                    s.seen.total[i] * PI / 0.25);
        }
        REQUIRE(fabs(mean - 1.216921) < 1e-4 && worst < 3e-3, "visibility %d: %.6f, worst %g",
                visibility, mean, worst);
    }
    free_sphere(&s);
}
END_TEST

START_TEST(any_mapping)
{
    static sphere_of_light s;
    make_sphere(&s, NULL);
    const double k = s.waves.number[0];
    for (size_t m = 0; cm_catalogue_at(m) != NULL; m++)
    {
        const cm_mapping_info *info = cm_catalogue_at(m);
        if (info->kind != CM_KIND_CUBE)
        {
            continue;
        }
        cm_mapping *mapping = make_mapping(info->identifier, NULL);
        for (int visibility = 0; visibility < 2; visibility++)
        {
            const cm_tof_options options = {.size = sizeof options,
                                            .visibility = visibility,
                                            .mapping = mapping,
                                            .map_edge = 40};
            gather(s.instant, &s.lamp, 1, &options, &s.waves, NULL, &s.seen);
            const double mean = distance_with(k, mean_of(&s.seen, PLACES));
            REQUIRE(fabs(mean - 1.216921) < 5e-4, "%s, visibility %d: %.6f", info->identifier,
                    visibility, mean);
        }
        cm_mapping_destroy(mapping);
    }
    free_sphere(&s);
}
END_TEST

/* However thin a cone is, what it lights in a sphere scatters the same light to everywhere: all that the lamp has. */
START_TEST(cones)
{
    static const double apertures[] = {1e-6, 1e-3, 0.02, 0.1, 0.3, 1.5, 4.0};
    static sphere_of_light s;
    make_sphere(&s, NULL);
    for (size_t n = 0; n < sizeof apertures / sizeof *apertures; n++)
    {
        const double axis[3] = {0.6, 0.0, 0.8};
        const double sine = sin(0.25 * apertures[n]);
        const cm_tof_options options = {.size = sizeof options};
        tof_lamp lamp = s.lamp;
        memcpy(lamp.axis, axis, sizeof axis);
        lamp.least_cosine = cos(0.5 * apertures[n]);
        lamp.part = sine * sine;
        lamp.intensity = 1.0 / lamp.part;
        gather(s.instant, &lamp, 1, &options, &s.waves, NULL, &s.seen);
        double sum = 0.0;
        for (size_t i = 0; i < PLACES; i++)
        {
            sum += s.seen.total[i] * PI / 0.25 / PLACES;
        }
        printf("a cone of %g: %.6f of its light\n", apertures[n], sum);
        REQUIRE(fabs(sum - 1.0) < 0.01, "a cone of %g: %g", apertures[n], sum);
    }
    free_sphere(&s);
}
END_TEST

/* Several waves at once are each alone; facets that scatter nothing are Lambert's law by the slow way. */
START_TEST(ways)
{
    static sphere_of_light s;
    static sphere_of_light slow;
    const cm_cook_torrance dull = {sizeof dull, 1.0, 0.0, 0.5, 1.5, 0.0};
    cm_brdf *brdf = NULL;
    ck_assert_int_eq(cm_brdf_create_cook_torrance(&dull, &brdf), CM_OK);
    make_sphere(&s, NULL);
    make_sphere(&slow, brdf);
    const cm_tof_options options = {.size = sizeof options, .lights = 100};
    gather(s.instant, &s.lamp, 1, &options, &s.waves, NULL, &s.seen);
    slow.waves.count = 3;
    slow.waves.number[1] = 1.7;
    slow.waves.number[2] = slow.waves.number[0];
    gather(slow.instant, &slow.lamp, 1, &options, &slow.waves, NULL, &slow.seen);
    for (size_t i = 0; i < PLACES; i++)
    {
        const double one = s.seen.real[i];
        REQUIRE(fabs(slow.seen.real[i] - one) < 1e-5 &&
                    fabs(slow.seen.total[i] - s.seen.total[i]) < 1e-5 &&
                    fabs(slow.seen.imaginary[i] - s.seen.imaginary[i]) < 1e-5,
                "%zu: %g %g", i, slow.seen.real[i], one);
        ck_assert(slow.seen.real[2 * PLACES + i] == slow.seen.real[i]);
        ck_assert(slow.seen.real[PLACES + i] != slow.seen.real[i]);
    }
    free_sphere(&slow);
    s.waves = slow.waves;
    gather(s.instant, &s.lamp, 1, &options, &s.waves, NULL, &s.seen);
    for (size_t i = 0; i < 3 * PLACES; i++)
    {
        REQUIRE(fabs(slow.seen.real[i] - s.seen.real[i]) < 1e-5, "%zu: %g %g", i, slow.seen.real[i],
                s.seen.real[i]);
    }
    free_sphere(&s);
    cm_brdf_destroy(brdf);
}
END_TEST

/* A corner: two walls and a floor, 2 m wide, lit by a lamp beside the camera. */
typedef struct corner
{
    cm_scene *world;
    cm_tof_scene *scene;
    tof_instant *instant;
    seen_places seen;
} corner;

static void add_box(cm_scene *world, const double least[3], const double most[3])
{
    cm_primitive box = {
        .size = sizeof box, .kind = CM_PRIMITIVE_BOX, .material = {{1, 1, 1}, .reflectance = 0.6}};
    memcpy(box.first, least, sizeof box.first);
    memcpy(box.second, most, sizeof box.second);
    ck_assert_int_eq(cm_scene_add(world, &box, NULL), CM_OK);
}

static void make_corner(corner *made, int with_cube)
{
    static const double camera[3] = {1.2, 1.3, 1.1};
    static const double room[2][3] = {{0, 0, 0}, {2, 2, 2}};
    static const double cube[2][3] = {{0.3, 0.4, 0.0}, {0.7, 0.8, 0.5}};
    ck_assert_int_eq(cm_scene_create(&made->world), CM_OK);
    add_box(made->world, room[0], room[1]);
    if (with_cube)
    {
        add_box(made->world, cube[0], cube[1]);
    }
    ck_assert_int_eq(cm_tof_scene_create(made->world, &made->scene), CM_OK);
    ck_assert_int_eq(tof_instant_create(made->scene, 0.0, &made->instant), CM_OK);
    look_around(made->instant, camera, &made->seen);
}

static void free_corner(corner *made)
{
    tof_instant_destroy(made->instant);
    cm_tof_scene_destroy(made->scene);
    cm_scene_destroy(made->world);
}

/* Nearer to an edge between walls than lights are to each other single ones count: their form factor is cut there. */
static int is_near_edge(const seen_places *s, size_t i)
{
    double edge = 1.0;
    const double *const x = s->position[0], *const y = s->position[1];
    for (int k = 0; k < 3; k++)
    {
        if (fabs(s->normal[k][i]) < 0.5)
        {
            edge = fmin(edge, fmin(s->position[k][i], 2.0 - s->position[k][i]));
        }
    }
    return edge < 0.15 ||
           (x[i] > 0.15 && x[i] < 0.85 && y[i] > 0.25 && y[i] < 0.95 && s->position[2][i] < 0.15);
}

/* Root mean square of what lights and paths differ in away from edges, by that of what paths bring. */
static double apart_from_paths(const corner *c, const cm_tof_options *options)
{
    static seen_places seen;
    static seen_places traced;
    const tof_lamp lamp = lamp_at(1.2, 1.3, 1.2);
    const tof_waves waves = {1, {2.0 * PI * 20e6 / CM_SPEED_OF_LIGHT}};
    cm_tof_options by_paths = *options;
    double difference = 0.0;
    double all = 0.0;
    seen = traced = c->seen;
    gather(c->instant, &lamp, 1, options, &waves, NULL, &seen);
    by_paths.bounces = 1;
    by_paths.paths = 1024;
    tof_radiance radiance = radiance_of(&traced);
    const tof_points points = points_of(&traced, PLACES);
    ck_assert_int_eq(tof_paths_add(c->instant, &lamp, 1, &by_paths, &waves, &points, &radiance),
                     CM_OK);
    for (size_t i = 0; i < PLACES; i++)
    {
        const double complex one = seen.real[i] + I * seen.imaginary[i];
        const double complex other = traced.real[i] + I * traced.imaginary[i];
        if (is_near_edge(&seen, i))
        {
            continue;
        }
        difference += creal((one - other) * conj(one - other));
        all += creal(other * conj(other));
    }
    return sqrt(difference / all);
}

START_TEST(beside_paths)
{
    static corner c;
    const cm_tof_options few = {.size = sizeof few};
    const cm_tof_options many = {.size = sizeof many, .lights = 8000, .map_edge = 128};
    make_corner(&c, 0);
    const double by_few = apart_from_paths(&c, &few);
    const double by_many = apart_from_paths(&c, &many);
    printf("empty room: %.4f by 338 lights, %.4f by 8000\n", by_few, by_many);
    REQUIRE(by_few < 0.1 && by_many < 0.03, "%g %g", by_few, by_many);
    free_corner(&c);
}
END_TEST

START_TEST(shadows)
{
    static corner c;
    cm_tof_options options = {.size = sizeof options, .lights = 2000};
    make_corner(&c, 1);
    const double without = apart_from_paths(&c, &options);
    options.visibility = 1;
    const double with = apart_from_paths(&c, &options);
    printf("room with a cube: %.4f without, %.4f with shadows\n", without, with);
    REQUIRE(with < 0.06 && with < 0.5 * without, "%g without, %g with", without, with);
    free_corner(&c);
}
END_TEST

/* Of a ball of 30 cm between a lamp and a wall, all places of the ball. */
static void make_ball(corner *made)
{
    const cm_primitive both[2] = {{.size = sizeof *both,
                                   .kind = CM_PRIMITIVE_PLANE,
                                   .first = {0, 0, 2},
                                   .second = {0, 0, 1},
                                   .material = {{1, 1, 1}, .reflectance = 0.6}},
                                  {.size = sizeof *both,
                                   .kind = CM_PRIMITIVE_SPHERE,
                                   .first = {0, 0, 1.4},
                                   .radius = 0.3,
                                   .material = {{1, 1, 1}, .reflectance = 0.6}}};
    ck_assert_int_eq(cm_scene_create(&made->world), CM_OK);
    ck_assert_int_eq(cm_scene_add(made->world, &both[0], NULL), CM_OK);
    ck_assert_int_eq(cm_scene_add(made->world, &both[1], NULL), CM_OK);
    ck_assert_int_eq(cm_tof_scene_create(made->world, &made->scene), CM_OK);
    ck_assert_int_eq(tof_instant_create(made->scene, 0.0, &made->instant), CM_OK);
    look_around(made->instant, both[1].first, &made->seen);
    for (int k = 0; k < 3; k++)
    {
        for (size_t i = 0; i < PLACES; i++)
        {
            made->seen.normal[k][i] = -made->seen.normal[k][i];
            made->seen.to_camera[k][i] = -made->seen.to_camera[k][i];
        }
    }
}

/* What is convex throws no shadow onto itself: no cell of a map, however it lies on the sphere, may have one there. */
START_TEST(no_shadows_of_itself)
{
    static const char *const names[] = {NULL, "gnomonic", "octahedral"};
    static corner c;
    const tof_lamp lamp = lamp_at(0.05, 0.0, 0.0);
    const tof_waves waves = {0};
    make_ball(&c);
    for (size_t m = 0; m < sizeof names / sizeof *names; m++)
    {
        cm_mapping *mapping = names[m] == NULL ? NULL : make_mapping(names[m], NULL);
        double sum[2] = {0.0, 0.0};
        for (int visibility = 0; visibility < 2; visibility++)
        {
            const cm_tof_options options = {
                .size = sizeof options, .visibility = visibility, .mapping = mapping};
            gather(c.instant, &lamp, 1, &options, &waves, NULL, &c.seen);
            for (size_t i = 0; i < PLACES; i++)
            {
                sum[visibility] += c.seen.total[i];
            }
        }
        printf("%s: %.4f of a ball's light with shadows\n", names[m] == NULL ? "-" : names[m],
               sum[1] / sum[0]);
        REQUIRE(sum[0] > 0.0 && sum[1] / sum[0] > 0.99, "%zu: %g of %g", m, sum[1], sum[0]);
        cm_mapping_destroy(mapping);
    }
    free_corner(&c);
}
END_TEST

START_TEST(same_bits)
{
    static corner c;
    static seen_places first;
    static seen_places other;
    const tof_lamp lamp[2] = {lamp_at(1.2, 1.3, 1.2), lamp_at(0.3, 1.7, 1.8)};
    const tof_waves waves = {2, {0.4, 2.1}};
    const cm_tof_options options = {.size = sizeof options, .visibility = 1, .lights = 200};
    make_corner(&c, 1);
    first = other = c.seen;
    gather(c.instant, lamp, 2, &options, &waves, NULL, &first);
    for (unsigned threads = 2; threads <= 7; threads += 5)
    {
        cm_pool *pool = NULL;
        ck_assert_int_eq(cm_pool_create(threads, &pool), CM_OK);
        gather(c.instant, lamp, 2, &options, &waves, pool, &other);
        cm_pool_destroy(pool);
        ck_assert(memcmp(first.real, other.real, sizeof first.real) == 0);
        ck_assert(memcmp(first.total, other.total, sizeof first.total) == 0);
    }
    free_corner(&c);
}
END_TEST

/* What an instruction set gathers, beside sums in double; a place beside the light, and one on it. */
START_TEST(instruction_sets)
{
    enum
    {
        ROOM = 64
    };
    float at[3][ROOM], normal[3][ROOM], height[ROOM], sum[5][ROOM];
    const gather_light light = {{0.1f, 0.2f, 0.3f}, {0.6f, 0.0f, 0.8f}, 2.0f, 3.0f};
    const float per_metre[2] = {0.07f, 1.3f}, begun[2] = {0.9f, 0.1f};
    for (int i = 0; i < ROOM; i++)
    {
        for (int k = 0; k < 3; k++)
        {
            at[k][i] = i == 0 ? light.position[k]
                              : (float)sin(1.0 + 7.0 * i + 2.0 * k) * (i == 1 ? 1e-5f : 3.0f);
            normal[k][i] = (float)(sin(3.0 * i + k) / 2.0);
        }
        height[i] = i % 5 == 0 ? -3.0f : 0.1f;
    }
    for (size_t which = 0; cm_instructions_at(which) != NULL; which++)
    {
        const gather_set *set = gather_set_find(cm_instructions_at(which));
        for (int kind = 0; kind < 4; kind++)
        {
            const gather_waves waves = {kind == 0 || kind == 3 ? 1 : 2, per_metre, begun};
            const gather_sum to = {sum[0], sum[1], sum[3], ROOM};
            const float *const position[3] = {at[0], at[1], at[2]};
            const float *const normals[3] = {normal[0], normal[1], normal[2]};
            memset(sum, 0, sizeof sum);
            set->gather(&light, &waves, ROOM, position, normals, kind >= 2 ? height : NULL, &to);
            for (int i = 0; i < ROOM; i++)
            {
                double square = 0.0, sent = 0.0, received = 0.0;
                for (int k = 0; k < 3; k++)
                {
                    const double d = (double)at[k][i] - (double)light.position[k];
                    square += d * d;
                    sent += d * (double)light.normal[k];
                    received -= d * (double)normal[k][i];
                }
                const double pair =
                    square > 0.0 ? fmax(0.0, sent) * fmax(0.0, received) / (square * square) : 0.0;
                const double flux =
                    2.0 * fmin(3.0, pair) * (kind >= 2 && height[i] < 0.0f ? 0.0 : 1.0);
                REQUIRE(fabs((double)sum[0][i] - flux) < 1e-5, "%s %d: %g, not %g", set->name, i,
                        (double)sum[0][i], flux);
                for (size_t j = 0; j < waves.count; j++)
                {
                    const double turns = (double)begun[j] + (double)per_metre[j] * sqrt(square);
                    REQUIRE(fabs((double)sum[1 + j][i] - flux * cos(2.0 * PI * turns)) < 3e-5 &&
                                fabs((double)sum[3 + j][i] - flux * sin(2.0 * PI * turns)) < 3e-5,
                            "%s, place %d, wave %zu", set->name, i, j);
                }
            }
        }
    }
}
END_TEST

/* Heights above the planes of cells, also of places on a map's last rim and of one on none, beside sums in double. */
START_TEST(heights)
{
    enum
    {
        EDGE = 3,
        CELLS = 6 * EDGE * EDGE
    };
    float plane[CELLS][4], place[3][4 * GATHER_ROOM], u[4 * GATHER_ROOM], v[4 * GATHER_ROOM],
        height[4 * GATHER_ROOM];
    uint8_t face[4 * GATHER_ROOM];
    const gather_shadow shadow = {EDGE, (const float(*)[4])plane};
    const float *const position[3] = {place[0], place[1], place[2]};
    for (int i = 0; i < CELLS * 4; i++)
    {
        plane[i / 4][i % 4] = (float)sin(2.0 * i);
    }
    for (int i = 0; i < 4 * GATHER_ROOM; i++)
    {
        face[i] = i == 7 ? CM_NO_FACE : (uint8_t)(i % 6);
        u[i] = i == 7 ? NAN : (float)(i % 9) / 4.0f - 1.0f;
        v[i] = (float)(i % 5) / 2.0f - 1.0f;
        for (int k = 0; k < 3; k++)
        {
            place[k][i] = (float)cos(i + 7.0 * k);
        }
    }
    for (size_t which = 0; cm_instructions_at(which) != NULL; which++)
    {
        const gather_set *set = gather_set_find(cm_instructions_at(which));
        set->see(&shadow, 4 * GATHER_ROOM, position, face, u, v, height);
        for (int i = 0; i < 4 * GATHER_ROOM; i++)
        {
            if (face[i] == CM_NO_FACE)
            {
                REQUIRE(isfinite(height[i]), "%s: nowhere is at %g", set->name, (double)height[i]);
                continue;
            }
            const int column = i % 9 == 8 ? 2 : (int)((i % 9) / 8.0 * 3.0);
            const int row = i % 5 == 4 ? 2 : (int)((i % 5) / 4.0 * 3.0);
            const float *const p = plane[(face[i] * EDGE + row) * EDGE + column];
            double right = (double)p[3];
            for (int k = 0; k < 3; k++)
            {
                right += (double)p[k] * (double)place[k][i];
            }
            REQUIRE(fabs((double)height[i] - right) < 1e-6, "%s %d: %g, not %g", set->name, i,
                    (double)height[i], right);
        }
    }
}
END_TEST

/* A lamp that lights nothing leaves no lights. */
START_TEST(dark)
{
    static sphere_of_light s;
    tof_virtual_lights *lights = NULL;
    const cm_tof_options options = {.size = sizeof options};
    make_sphere(&s, NULL);
    s.lamp.intensity = 0.0;
    ck_assert_int_eq(
        tof_virtual_lights_create(s.instant, &s.lamp, 1, &options, &s.waves, NULL, &lights), CM_OK);
    ck_assert_uint_eq(tof_virtual_lights_count(lights), 0);
    tof_radiance radiance = radiance_of(&s.seen);
    const tof_points points = points_of(&s.seen, PLACES);
    ck_assert_int_eq(tof_virtual_lights_add(lights, &points, &radiance), CM_OK);
    ck_assert(s.seen.total[0] == 0.0);
    tof_virtual_lights_destroy(lights);
    free_sphere(&s);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {sphere,
                                  cones,
                                  any_mapping,
                                  ways,
                                  beside_paths,
                                  shadows,
                                  no_shadows_of_itself,
                                  same_bits,
                                  instruction_sets,
                                  heights,
                                  dark,
                                  NULL};
    return run_suite("multipath", tests);
}
