/* SPDX-License-Identifier: MIT
 *
 * Worlds as rays need them: at a time, in the world's axes; and what light they bring.
 */
#ifndef CUBEMAP_SIM_TOF_OBJECT_H
#define CUBEMAP_SIM_TOF_OBJECT_H

#include "sky.h"

#include <cubemap/sim.h>

/* Where options leave the numbers of scattered light at 0. */
enum
{
    TOF_LIGHTS = 338,
    TOF_PATHS = 64 /* a pixel */
};

/* A primitive that formulas give, in the world's axes at a time. */
typedef struct tof_solid
{
    cm_primitive_kind kind;
    uint32_t id; /* of the primitive */
    double
        centre[3]; /* of box and sphere; a point of the plane; the middle of the cylinder's axis */
    double axis[3][3]; /* of a box; [0] of a cylinder or the plane's normal; of length 1 */
    double half[3];    /* half edges of a box; [0] half the length of a cylinder */
    double radius;
} tof_solid;

/* What all that rays meet of a primitive share. */
typedef struct tof_surface
{
    double reflectance; /* of the mesh, too */
    const cm_brdf *brdf;
    cm_pose body; /* from the world to the axes in which the primitive was added, at this time */
} tof_surface;

/* The world at a time. */
typedef struct tof_instant tof_instant;

/* All as it stands at a time; CM_ERROR_MEMORY. */
cm_status tof_instant_create(const cm_tof_scene *scene, double time, tof_instant **made);
void tof_instant_destroy(tof_instant *instant);
const tof_surface *tof_instant_surfaces(const tof_instant *instant); /* by id */

/* Does anything move between two times? */
int tof_scene_moves(const cm_tof_scene *scene, double from, double to);

/* Has a trajectory, or one of a scene's, a stamp between two times? It may bend there. NULL has none. */
int tof_trajectory_bends(const cm_trajectory *trajectory, double from, double to);
int tof_scene_bends(const cm_tof_scene *scene, double from, double to);

/* What rays met, one value a ray; arrays that are NULL are left out. */
typedef struct tof_hits
{
    double *distance; /* infinite for nothing */
    uint32_t *id;     /* CM_SCENE_NOTHING */
    uint32_t *triangle;
    double *normal[3]; /* of length 1, towards the origin; 0 for nothing */
} tof_hits;

/* The nearest surface along n rays from beyond distance 0, of directions of length 1. Any number of threads may call.
 * Where a ray begins on a surface it may be met again at 1e-15: begin a little off, along the normal. */
void tof_cast(const tof_instant *instant, size_t n, const double *const origin[3],
              const double *const direction[3], const tof_hits *hits);

/* 1 where something is nearer than far[i], else 0. */
void tof_cast_shadows(const tof_instant *instant, size_t n, const double *const origin[3],
                      const double *const direction[3], const double *far, uint8_t *blocked);

/* A light, made ready; in the world's axes at a time. */
typedef struct tof_lamp
{
    double position[3], axis[3];
    double least_cosine; /* of the cone; -1: everywhere */
    double part;         /* of the sphere that the cone is */
    double intensity;    /* W/sr on the axis, even: everywhere in the cone */
    size_t n;            /* of the table; 0: even */
    const double *table; /* W/sr, evenly apart in angle */
    double step;         /* radians */
} tof_lamp;

/* W/sr where the cosine from the axis is that. */
double tof_lamp_intensity(const tof_lamp *lamp, double cosine);

/* What light carries: a wave j has wave_number[j] radians a metre of the whole path from lamp to camera. */
typedef struct tof_waves
{
    size_t count;
    double number[32];
} tof_waves;

/* n places on surfaces that the camera sees. */
typedef struct tof_points
{
    size_t n;
    const double *position[3];  /* in the world */
    const double *normal[3];    /* on the camera's side */
    const double *to_camera[3]; /* of length 1 */
    const double *range;        /* to the camera */
    const uint32_t *id;         /* never nothing */
    const uint32_t *number;     /* of the pixel, for random numbers */
} tof_points;

/* Radiance towards the camera, W/(m^2 sr), to which is added: total[i], and of wave j the sum of L e^(i phase) in
 * real[j n + i], imaginary[j n + i]; phase is number times the path's length, camera's leg included. */
typedef struct tof_radiance
{
    double *total;
    double *real;
    double *imaginary;
    double *ambient; /* of the environment, which has no waves */
} tof_radiance;

/* Light once scattered, by virtual lights (multipath.c). Creation may use the pool; adding is for any thread. */
typedef struct tof_virtual_lights tof_virtual_lights;
cm_status tof_virtual_lights_create(const tof_instant *instant, const tof_lamp *lamp, size_t lamps,
                                    const cm_tof_options *options, const tof_waves *waves,
                                    cm_pool *pool, tof_virtual_lights **made);
void tof_virtual_lights_destroy(tof_virtual_lights *lights);
uint32_t tof_virtual_lights_count(const tof_virtual_lights *lights);
cm_status tof_virtual_lights_add(const tof_virtual_lights *lights, const tof_points *points,
                                 tof_radiance *radiance);

/* Light scattered 1 to options->bounces times before the place that the camera sees scatters it, by paths (paths.c). */
cm_status tof_paths_add(const tof_instant *instant, const tof_lamp *lamp, size_t lamps,
                        const cm_tof_options *options, const tof_waves *waves,
                        const tof_points *points, tof_radiance *radiance);

/* Light of the surroundings that these places scatter to the camera (ambient.c). */
cm_status tof_environment_add(const tof_instant *instant, const tof_sky *sky,
                              const cm_tof_options *options, const tof_points *points,
                              tof_radiance *radiance);

#endif
