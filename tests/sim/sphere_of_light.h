/* SPDX-License-Identifier: MIT
 *
 * Lamp and camera in the middle of a sphere of 1 m that scatters half of all light by Lambert's law: every bounce multiplies
 * the phasor by rho K, K = int_0^2R r / (2 R^2) e^(ikr) dr, whose integral is known.
 */
#ifndef TESTS_SIM_SPHERE_OF_LIGHT_H
#define TESTS_SIM_SPHERE_OF_LIGHT_H

#include <complex.h>

#include "modules/sim/tof_object.h"
#include "tests/suite.h"

#define PI 3.14159265358979323846

enum
{
    PLACES = 300
};

/* Places that a camera sees, and what comes of them. */
typedef struct seen_places
{
    double position[3][PLACES];
    double normal[3][PLACES];
    double to_camera[3][PLACES];
    double range[PLACES];
    uint32_t id[PLACES];
    uint32_t number[PLACES];
    double total[PLACES];
    double real[32 * PLACES];
    double imaginary[32 * PLACES];
    double ambient[PLACES];
} seen_places;

static inline tof_points points_of(const seen_places *s, size_t n)
{
    const tof_points p = {n,
                          {s->position[0], s->position[1], s->position[2]},
                          {s->normal[0], s->normal[1], s->normal[2]},
                          {s->to_camera[0], s->to_camera[1], s->to_camera[2]},
                          s->range,
                          s->id,
                          s->number};
    return p;
}

/* Nothing has come. */
static inline tof_radiance radiance_of(seen_places *s)
{
    const tof_radiance r = {s->total, s->real, s->imaginary, s->ambient};
    memset(s->total, 0, sizeof s->total);
    memset(s->real, 0, sizeof s->real);
    memset(s->imaginary, 0, sizeof s->imaginary);
    memset(s->ambient, 0, sizeof s->ambient);
    return r;
}

typedef struct sphere_of_light
{
    cm_scene *world;
    cm_tof_scene *scene;
    tof_instant *instant;
    tof_lamp lamp;
    tof_waves waves;
    seen_places seen;
} sphere_of_light;

/* A lamp that shines everywhere, 1 W/sr. */
static inline tof_lamp lamp_at(double x, double y, double z)
{
    const tof_lamp lamp = {.position = {x, y, z},
                           .axis = {0, 0, 1},
                           .least_cosine = -1.0,
                           .part = 1.0,
                           .intensity = 1.0};
    return lamp;
}

/* Rays of golden angles from a camera: what they meet. */
static inline void look_around(const tof_instant *instant, const double camera[3], seen_places *s)
{
    double origin[3][PLACES], direction[3][PLACES], distance[PLACES];
    for (int i = 0; i < PLACES; i++)
    {
        const double z = 1.0 - (2.0 * i + 1.0) / PLACES, azimuth = 2.39996322972865332 * i;
        direction[0][i] = sqrt(1.0 - z * z) * cos(azimuth);
        direction[1][i] = sqrt(1.0 - z * z) * sin(azimuth);
        direction[2][i] = z;
        for (int k = 0; k < 3; k++)
        {
            origin[k][i] = camera[k];
        }
    }
    const double *const from[3] = {origin[0], origin[1], origin[2]};
    const double *const way[3] = {direction[0], direction[1], direction[2]};
    const tof_hits hits = {
        .distance = distance, .id = s->id, .normal = {s->normal[0], s->normal[1], s->normal[2]}};
    tof_cast(instant, PLACES, from, way, &hits);
    for (int i = 0; i < PLACES; i++)
    {
        ck_assert_uint_ne(s->id[i], CM_SCENE_NOTHING);
        for (int k = 0; k < 3; k++)
        {
            s->position[k][i] = camera[k] + distance[i] * direction[k][i];
            s->to_camera[k][i] = -direction[k][i];
        }
        s->range[i] = distance[i];
        s->number[i] = (uint32_t)i;
    }
}

static inline void make_sphere(sphere_of_light *made, const cm_brdf *brdf)
{
    const cm_primitive sphere = {.size = sizeof sphere,
                                 .kind = CM_PRIMITIVE_SPHERE,
                                 .radius = 1.0,
                                 .material = {{1, 1, 1}, .reflectance = 0.5},
                                 .brdf = brdf};
    const double middle[3] = {0, 0, 0};
    ck_assert_int_eq(cm_scene_create(&made->world), CM_OK);
    ck_assert_int_eq(cm_scene_add(made->world, &sphere, NULL), CM_OK);
    ck_assert_int_eq(cm_tof_scene_create(made->world, &made->scene), CM_OK);
    ck_assert_int_eq(tof_instant_create(made->scene, 0.0, &made->instant), CM_OK);
    made->lamp = lamp_at(0, 0, 0);
    made->waves.count = 1;
    made->waves.number[0] = 2.0 * PI * 20e6 / CM_SPEED_OF_LIGHT;
    look_around(made->instant, middle, &made->seen);
}

static inline void free_sphere(sphere_of_light *made)
{
    tof_instant_destroy(made->instant);
    cm_tof_scene_destroy(made->scene);
    cm_scene_destroy(made->world);
}

/* What bounces 1 to n bring beside direct light, rho / pi e^(2ik). */
static inline double complex sphere_truth(double k, int bounces)
{
    /* of r e^(ikr) / 2: (e^(2ik) (1 - 2ik) - 1) / (2 k^2) */
    const double complex factor =
        0.5 * (cexp(2.0 * I * k) * (1.0 - 2.0 * I * k) - 1.0) / (2.0 * k * k);
    const double complex direct = 0.5 / PI * cexp(2.0 * I * k);
    double complex sum = 0.0;
    double complex power = 1.0;
    for (int i = 0; i < bounces; i++)
    {
        power *= factor;
        sum += direct * power;
    }
    return sum;
}

static inline double distance_with(double k, double complex scattered)
{
    return carg(0.5 / PI * cexp(2.0 * I * k) + scattered) / (2.0 * k);
}

#endif
