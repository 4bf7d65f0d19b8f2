/* SPDX-License-Identifier: MIT
 *
 * Worlds: planes, boxes, spheres, cylinders and meshes, and what rays meet among them. Of the library cubemap-scene.
 *
 *   surfaces    have two sides: a box is a room for who is inside
 *   rays        begin at an origin and have a direction of any length but 0. Distances are in lengths of the direction:
 *               where a direction's z is 1 in a camera's axes, the distance is depth, where its length is 1, range
 *   beginning   what is met has a distance above 0. Where a ray begins on a surface, to rounding, that surface may be met
 *               at a distance of some 1e-15 of the coordinates
 *   edges       triangles that share an edge leave no crack between them, nor do walls and caps of a cylinder
 *   bad input   NaN, infinities and direction 0 give distance NaN
 *   threads     casting changes nothing: any number of threads may, as long as none adds
 */
#ifndef CUBEMAP_WORLD_H
#define CUBEMAP_WORLD_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>
#include <cubemap/mesh.h>
#include <cubemap/pose.h>
#include <cubemap/status.h>
#include <cubemap/trajectory.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How a surface scatters light, of the library cubemap-sim (brdf.h). */
typedef struct cm_brdf cm_brdf;

/* A world, from cm_scene_create to cm_scene_destroy. */
typedef struct cm_scene cm_scene;

/* The id where a ray meets nothing. */
#define CM_SCENE_NOTHING UINT32_MAX

/* What a world is made of. */
typedef enum cm_primitive_kind
{
    CM_PRIMITIVE_PLANE = 0, /* endless: a point (first) and a normal (second) of any length but 0 */
    CM_PRIMITIVE_BOX = 1,   /* along the axes: least (first) and greatest (second) coordinates */
    CM_PRIMITIVE_SPHERE = 2,   /* centre (first) and radius */
    CM_PRIMITIVE_CYLINDER = 3, /* from (first) to (second) along its axis, radius; closed by caps */
    CM_PRIMITIVE_MESH = 4      /* a mesh and how it stands */
} cm_primitive_kind;

/* To be filled with zeros but for size and what the kind needs. */
typedef struct cm_primitive
{
    size_t size;            /* sizeof(cm_primitive) */
    cm_primitive_kind kind; /* which numbers are read */
    double first[3];        /* as the kind says */
    double second[3];       /* as the kind says */
    double radius;          /* above 0 */
    const cm_mesh *mesh;    /* not copied: it must outlive the world */
    cm_pose pose;           /* of a mesh: x_mesh = rotation (x_world - position) */
    cm_material material;   /* of a mesh, its colours and reflectance are multiplied */
    /* The next two are kept for who simulates, not copied, and must outlive the world; casting below does not read them. */
    const cm_trajectory *
        motion; /* poses that take it, as it stands above, to its place at their times; NULL: none */
    const cm_brdf *brdf; /* NULL: Lambert's, of the reflectance */
} cm_primitive;

/* An empty world. CM_OK; CM_ERROR_ARGUMENT (NULL); CM_ERROR_MEMORY. */
CM_API cm_status cm_scene_create(cm_scene **scene);
CM_API void cm_scene_destroy(cm_scene *scene);

/* One of the analytic worlds with a name: "room", "corridor", "spheres"; z is up, metres.
 * CM_OK; CM_ERROR_ARGUMENT (NULL, no such name); CM_ERROR_MEMORY. */
CM_API cm_status cm_scene_create_named(const char *name, cm_scene **scene);

/* The name of such a world: "room" at index 0, and so on; NULL behind the last. */
CM_API const char *cm_scene_name_at(size_t index);

/* Adds a copy of a primitive; its id is the number of those before it, and goes to id if that is not NULL.
 * CM_OK; CM_ERROR_ARGUMENT (NULL, size, kind, no mesh, 2^31 primitives); CM_ERROR_RANGE (numbers that are not finite or
 * from 1e100, no normal, no axis, a box of no thickness or turned over, radius, colours, a pose whose rotation is none);
 * CM_ERROR_MEMORY. */
CM_API cm_status cm_scene_add(cm_scene *scene, const cm_primitive *primitive, uint32_t *id);

/* How many there are, and the one of an id; NULL for others. Normals have length 1 there. It lives until the next is
 * added. */
CM_API size_t cm_scene_count(const cm_scene *scene);
CM_API const cm_primitive *cm_scene_at(const cm_scene *scene, uint32_t id);

/* What rays met, one value a ray; arrays that are NULL are left out. */
typedef struct cm_hit_arrays
{
    size_t size;        /* sizeof(cm_hit_arrays) */
    double *distance;   /* in lengths of the direction; infinite where nothing is met */
    uint32_t *id;       /* of the primitive; CM_SCENE_NOTHING */
    uint32_t *triangle; /* of its mesh; 0 of other kinds */
    double *normal
        [3]; /* of length 1, towards the ray's origin; of triangles that of their plane. NaN for nothing */
    double *color[3];    /* 0..1; 0 for nothing */
    double *reflectance; /* 0..1; 0 for nothing */
} cm_hit_arrays;

/* The nearest surface along each ray. Of two at one distance the lower id is met. */
CM_API void cm_scene_cast_array(const cm_scene *scene, size_t n, const double *origin_x,
                                const double *origin_y, const double *origin_z,
                                const double *direction_x, const double *direction_y,
                                const double *direction_z, const cm_hit_arrays *hit);

#ifdef __cplusplus
}
#endif

#endif
