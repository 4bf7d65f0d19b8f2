/* SPDX-License-Identifier: MIT
 *
 * What rays meet in worlds of primitives, against quadruple precision at the hard points: grazing, inside, on the surface,
 * along the axes, and what is no ray.
 */
#define _POSIX_C_SOURCE 200809L

#include <cubemap/threads.h>
#include <cubemap/world.h>

#include "tests/suite.h"
#include "truth/scenes/ray_truth.h"

enum
{
    RAYS = 2000
};

/* One ray's answer. */
typedef struct answer
{
    double distance, normal[3], color[3], reflectance;
    uint32_t id, triangle;
} answer;

static answer cast(const cm_scene *scene, const double origin[3], const double direction[3])
{
    answer found;
    const cm_hit_arrays hit = {sizeof hit,
                               &found.distance,
                               &found.id,
                               &found.triangle,
                               {&found.normal[0], &found.normal[1], &found.normal[2]},
                               {&found.color[0], &found.color[1], &found.color[2]},
                               &found.reflectance};
    cm_scene_cast_array(scene, 1, &origin[0], &origin[1], &origin[2], &direction[0], &direction[1],
                        &direction[2], &hit);
    return found;
}

static cm_scene *empty_world(void)
{
    cm_scene *scene = NULL;
    ck_assert_int_eq(cm_scene_create(&scene), CM_OK);
    return scene;
}

static cm_primitive primitive_of(cm_primitive_kind kind)
{
    cm_primitive made = {.size = sizeof made, .kind = kind, .material = {{0.2, 0.4, 0.6}, 0.5}};
    made.pose.rotation = (cm_rotation){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    return made;
}

static cm_scene *world_of(cm_primitive primitive)
{
    cm_scene *scene = empty_world();
    uint32_t id = 7;
    ck_assert_int_eq(cm_scene_add(scene, &primitive, &id), CM_OK);
    ck_assert_uint_eq(id, 0);
    return scene;
}

/* The distance is the truth's to a part of the way that the ray has gone; how well the place is determined where a ray
 * grazes is the root of that. Where the truth itself changes by more than the bound from one piece to the next, either is
 * right. Returns how far it is off. */
static double check_ray(const cm_scene *scene, const double origin[3], const double direction[3],
                        double bound)
{
    uint32_t id;
    double next;
    const double truth = ray_truth(scene, origin, direction, &id, &next);
    const answer found = cast(scene, origin, direction);
    if (isinf(truth))
    {
        ck_assert_msg(isinf(found.distance) || bound > 1e-12, "%.17g, not infinite",
                      found.distance);
        return 0.0;
    }
    const double off = fabs(found.distance - truth);
    ck_assert_msg(off <= bound * fmax(1.0, truth), "%.17g, not %.17g (%g), next %.17g",
                  found.distance, truth, off, next);
    ck_assert_msg(found.id == id || fabs(next - truth) <= bound, "%u, not %u", found.id, id);
    double length = 0.0, side = 0.0;
    for (int i = 0; i < 3; i++)
    {
        length += found.normal[i] * found.normal[i];
        side += found.normal[i] * direction[i];
    }
    ck_assert_msg(fabs(length - 1.0) < 1e-14 && side <= 1e-15, "normal of %g, %g", length, side);
    return off;
}

START_TEST(named_worlds_are_as_the_truth_has_them)
{
    uint64_t state = 20;
    for (size_t i = 0; cm_scene_name_at(i) != NULL; i++)
    {
        cm_scene *scene = NULL;
        ck_assert_int_eq(cm_scene_create_named(cm_scene_name_at(i), &scene), CM_OK);
        double worst = 0.0;
        for (int k = 0; k < RAYS; k++)
        {
            const double origin[3] = {0.9 * next_real(&state), 0.8 * next_real(&state),
                                      1.4 + next_real(&state)};
            double direction[3];
            next_direction(&state, direction);
            if (k % 3 == 0)
            {
                direction[k / 3 % 3] = 0.0;
            }
            worst = fmax(worst, check_ray(scene, origin, direction, 1e-12));
        }
        printf("%s: %.2g m\n", cm_scene_name_at(i), worst);
        cm_scene_destroy(scene);
    }
    cm_scene *scene = NULL;
    ck_assert_int_eq(cm_scene_create_named("Room", &scene), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_scene_create_named(NULL, &scene), CM_ERROR_ARGUMENT);
    ck_assert_ptr_null(scene);
}
END_TEST

/* Past a sphere of radius 1, so many times 2^-52 inside or outside its rim, from far and near. */
START_TEST(grazing_rays_are_off_by_the_root_of_an_ulp)
{
    cm_primitive sphere = primitive_of(CM_PRIMITIVE_SPHERE);
    sphere.radius = 1.0;
    cm_scene *scene = world_of(sphere);
    for (int k = 1; k < 50; k++)
    {
        for (double far = 1.0; far < 1e7; far *= 10.0)
        {
            const double origin[3] = {-far, 1.0 - ldexp(1.0, -k), 0.0};
            const double direction[3] = {1.0, 0.0, 0.0};
            /* the ray is along an axis, so that nothing is lost on the way to the sphere */
            check_ray(scene, origin, direction, 1e-15);
            const double past[3] = {-far, 1.0 + ldexp(1.0, -k), 0.0};
            ck_assert(isinf(cast(scene, past, direction).distance));
            const double askew[3] = {far, ldexp(1.0, -k), ldexp(0.7, -k)};
            check_ray(scene, (const double[3]){-far, 0.0, 1.0}, askew, 2e-8);
        }
    }
    cm_scene_destroy(scene);
}
END_TEST

/* The equation of the sphere loses all digits here if it is solved as it is printed. */
START_TEST(small_spheres_far_away_and_large_ones_nearby)
{
    for (int k = 0; k < 12; k++)
    {
        cm_primitive sphere = primitive_of(CM_PRIMITIVE_SPHERE);
        sphere.radius = pow(10.0, -k);
        sphere.first[0] = 1000.0;
        cm_scene *scene = world_of(sphere);
        check_ray(scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0}, 4e-16);
        check_ray(scene, (const double[3]){0, 0.3 * sphere.radius, 0}, (const double[3]){3, 0, 0},
                  4e-16);
        cm_scene_destroy(scene);
        sphere.radius = pow(10.0, k);
        sphere.first[0] = sphere.radius + 1.0;
        scene = world_of(sphere);
        check_ray(scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0}, 4e-16);
        check_ray(scene, (const double[3]){0, 0, 0}, (const double[3]){1, 1e-3, 1e-4},
                  4e-16 * sphere.radius + 4e-16);
        cm_scene_destroy(scene);
    }
}
END_TEST

START_TEST(cylinders_along_and_across)
{
    uint64_t state = 5;
    for (int k = 0; k < RAYS; k++)
    {
        cm_primitive cylinder = primitive_of(CM_PRIMITIVE_CYLINDER);
        for (int i = 0; i < 3; i++)
        {
            cylinder.first[i] = next_real(&state);
            cylinder.second[i] =
                cylinder.first[i] + (k % 4 == 0 ? (double)(i == k / 4 % 3) : next_real(&state));
        }
        cylinder.radius = 0.3 + 0.2 * next_real(&state);
        cm_scene *scene = world_of(cylinder);
        double origin[3], direction[3];
        for (int i = 0; i < 3; i++)
        {
            origin[i] = 3.0 * next_real(&state);
            /* near a point of the axis; or along it, nearly or fully */
            direction[i] = k % 3 == 0 ? cylinder.second[i] - cylinder.first[i] +
                                            (k % 2 == 0 ? 0.0 : 1e-9 * next_real(&state))
                                      : cylinder.first[i] + 0.2 * next_real(&state) - origin[i];
            origin[i] = k % 3 == 0
                            ? cylinder.first[i] + 0.1 * next_real(&state) - 2.0 * direction[i]
                            : origin[i];
        }
        check_ray(scene, origin, direction, 1e-11);
        for (int i = 0; i < 3; i++) /* from inside */
        {
            origin[i] = 0.5 * (cylinder.first[i] + cylinder.second[i]) + 0.05 * next_real(&state);
        }
        check_ray(scene, origin, direction, 1e-11);
        cm_scene_destroy(scene);
    }
}
END_TEST

START_TEST(boxes_have_two_sides)
{
    cm_primitive box = primitive_of(CM_PRIMITIVE_BOX);
    for (int i = 0; i < 3; i++)
    {
        box.first[i] = -1.0 - i;
        box.second[i] = 2.0 + i;
    }
    cm_scene *scene = world_of(box);
    for (int axis = 0; axis < 3; axis++)
    {
        double direction[3] = {0.0, 0.0, 0.0}, origin[3] = {0.0, 0.0, 0.0};
        direction[axis] = 0.5;
        answer found = cast(scene, origin, direction);
        ck_assert_double_eq(found.distance, 2.0 * box.second[axis]);
        ck_assert_double_eq(found.normal[axis], -1.0);
        origin[axis] = -10.0;
        found = cast(scene, origin, direction);
        ck_assert_double_eq(found.distance, 2.0 * (box.first[axis] + 10.0));
        ck_assert_double_eq(found.normal[axis], -1.0);
        /* in the plane of a face, and an ulp outside */
        const int other = (axis + 1) % 3;
        origin[other] = box.second[other];
        ck_assert_double_eq(cast(scene, origin, direction).distance, found.distance);
        origin[other] = nextafter(box.second[other], 10.0);
        ck_assert(isinf(cast(scene, origin, direction).distance));
        /* on the surface: outwards nothing, inwards the other side */
        origin[other] = 0.0;
        origin[axis] = box.second[axis];
        ck_assert(isinf(cast(scene, origin, direction).distance));
        direction[axis] = -1.0;
        ck_assert_double_eq(cast(scene, origin, direction).distance,
                            box.second[axis] - box.first[axis]);
    }
    cm_scene_destroy(scene);
}
END_TEST

START_TEST(rays_that_begin_on_a_surface)
{
    cm_primitive sphere = primitive_of(CM_PRIMITIVE_SPHERE);
    sphere.radius = 2.0;
    cm_scene *scene = world_of(sphere);
    const double origin[3] = {2.0, 0.0, 0.0};
    ck_assert(isinf(cast(scene, origin, (const double[3]){1, 0, 0}).distance));
    ck_assert(isinf(cast(scene, origin, (const double[3]){0, 1, 0}).distance));
    ck_assert_double_eq(cast(scene, origin, (const double[3]){-1, 0, 0}).distance, 4.0);
    cm_scene_destroy(scene);
    cm_primitive plane = primitive_of(CM_PRIMITIVE_PLANE);
    plane.second[2] = -3.0;
    scene = world_of(plane);
    ck_assert_double_eq(cm_scene_at(scene, 0)->second[2], -1.0);
    ck_assert(isinf(cast(scene, origin, (const double[3]){1, 0, 1}).distance));
    ck_assert(isinf(cast(scene, origin, (const double[3]){1, 0, 0}).distance));
    const answer found = cast(scene, (const double[3]){0, 0, -2}, (const double[3]){0, 0, 4});
    ck_assert_double_eq(found.distance, 0.5);
    ck_assert_double_eq(found.normal[2], -1.0);
    ck_assert_double_eq(found.color[1], 0.4);
    ck_assert_double_eq(found.reflectance, 0.5);
    cm_scene_destroy(scene);
}
END_TEST

START_TEST(what_is_no_ray_gives_nan)
{
    cm_scene *scene = NULL;
    ck_assert_int_eq(cm_scene_create_named("room", &scene), CM_OK);
    const double bad[] = {NAN, INFINITY, -INFINITY, 1e100};
    for (int i = 0; i < 24; i++)
    {
        double numbers[6] = {0.0, 0.0, 1.0, 1.0, 2.0, 3.0};
        numbers[i % 6] = bad[i / 6];
        const answer found = cast(scene, numbers, numbers + 3);
        const int fine = i / 6 == 3 && i % 6 >= 3; /* a long direction is one */
        ck_assert_msg((isnan(found.distance) != 0) == !fine, "%d: %g", i, found.distance);
        ck_assert(fine || (found.id == CM_SCENE_NOTHING && isnan(found.normal[0])));
    }
    const double origin[3] = {0, 0, 1};
    ck_assert(isnan(cast(scene, origin, (const double[3]){0, 0, 0}).distance));
    /* any length but 0 */
    const double unit = cast(scene, origin, (const double[3]){1, 0, 0}).distance;
    for (int k = -1070; k < 1020; k += 10)
    {
        const double direction[3] = {ldexp(1.0, k), 0, 0};
        const double distance = cast(scene, origin, direction).distance;
        ck_assert_double_eq(distance, ldexp(unit, -k));
    }
    cm_scene_cast_array(scene, 0, NULL, NULL, NULL, NULL, NULL, NULL,
                        &(cm_hit_arrays){.size = sizeof(cm_hit_arrays)});
    cm_scene_destroy(scene);
}
END_TEST

START_TEST(nothing_is_met_in_an_empty_world)
{
    cm_scene *scene = empty_world();
    const answer found = cast(scene, (const double[3]){0, 0, 0}, (const double[3]){0, 0, 1});
    ck_assert(isinf(found.distance) && found.id == CM_SCENE_NOTHING && found.color[0] == 0.0);
    ck_assert_uint_eq(cm_scene_count(scene), 0);
    ck_assert_ptr_null(cm_scene_at(scene, 0));
    cm_scene_destroy(scene);
    cm_scene_destroy(NULL);
    ck_assert_int_eq(cm_scene_create(NULL), CM_ERROR_ARGUMENT);
}
END_TEST

START_TEST(what_is_no_primitive_is_refused)
{
    cm_scene *scene = empty_world();
    uint32_t id = 7;
    cm_primitive one = primitive_of(CM_PRIMITIVE_PLANE);
    ck_assert_int_eq(cm_scene_add(scene, &one, &id), CM_ERROR_RANGE); /* no normal */
    one = primitive_of(CM_PRIMITIVE_BOX);
    ck_assert_int_eq(cm_scene_add(scene, &one, &id), CM_ERROR_RANGE); /* no thickness */
    one = primitive_of(CM_PRIMITIVE_SPHERE);
    ck_assert_int_eq(cm_scene_add(scene, &one, &id), CM_ERROR_RANGE); /* radius 0 */
    one.radius = NAN;
    ck_assert_int_eq(cm_scene_add(scene, &one, &id), CM_ERROR_RANGE);
    one.radius = 1.0;
    one.first[1] = INFINITY;
    ck_assert_int_eq(cm_scene_add(scene, &one, &id), CM_ERROR_RANGE);
    one.first[1] = 0.0;
    one.material.color[2] = 1.5;
    ck_assert_int_eq(cm_scene_add(scene, &one, &id), CM_ERROR_RANGE);
    one = primitive_of(CM_PRIMITIVE_CYLINDER);
    one.radius = 1.0;
    ck_assert_int_eq(cm_scene_add(scene, &one, &id), CM_ERROR_RANGE); /* no axis */
    one = primitive_of(CM_PRIMITIVE_MESH);
    ck_assert_int_eq(cm_scene_add(scene, &one, &id), CM_ERROR_ARGUMENT); /* no mesh */
    one.kind = (cm_primitive_kind)5;
    ck_assert_int_eq(cm_scene_add(scene, &one, &id), CM_ERROR_ARGUMENT);
    one.size = 8;
    ck_assert_int_eq(cm_scene_add(scene, &one, &id), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_scene_add(scene, NULL, &id), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_scene_add(NULL, &one, &id), CM_ERROR_ARGUMENT);
    ck_assert_uint_eq(id, 7);
    ck_assert_uint_eq(cm_scene_count(scene), 0);
    cm_scene_destroy(scene);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {named_worlds_are_as_the_truth_has_them,
                                  grazing_rays_are_off_by_the_root_of_an_ulp,
                                  small_spheres_far_away_and_large_ones_nearby,
                                  cylinders_along_and_across,
                                  boxes_have_two_sides,
                                  rays_that_begin_on_a_surface,
                                  what_is_no_ray_gives_nan,
                                  nothing_is_met_in_an_empty_world,
                                  what_is_no_primitive_is_refused,
                                  NULL};
    return run_suite("world", tests);
}
