/* SPDX-License-Identifier: MIT
 *
 * Virtual lights: places that lamps light, and which scatter it.
 */
#ifndef CUBEMAP_SIM_MULTIPATH_OBJECT_H
#define CUBEMAP_SIM_MULTIPATH_OBJECT_H

#include "gather_set.h"
#include "tof_object.h"

typedef struct virtual_light
{
    double position[3];
    double normal[3];  /* on the lamp's side */
    double to_lamp[3]; /* of length 1 */
    double length;     /* of the way from the lamp */
    double flux;       /* watts that fall onto what it stands for, times the reflectance */
    double area;       /* of what it stands for */
    uint32_t id;       /* of the primitive */
} virtual_light;

struct tof_virtual_lights
{
    const tof_instant *instant;
    const cm_mapping *mapping; /* of the map */
    const cm_mapping *shadow_mapping;
    cm_mapping *own;            /* NULL: the caller's */
    cm_mapping *own_of_shadows; /* NULL: the caller's, or no shadows */
    const gather_set *set;
    tof_waves waves;
    uint32_t count;
    uint32_t lambert; /* so many of them, the first, scatter by Lambert's law */
    virtual_light *light;
    double origin[3]; /* floats are from here */
    gather_light *fast;
    float *begun;        /* turns: count x waves */
    float per_metre[32]; /* turns a metre: waves->number by 2 pi */
    int shadow_edge;     /* 0: no shadows */
    size_t shadow_cells; /* of a light */
    float (*plane)[4];   /* count x shadow_cells; from origin */
};

/* Draws count lights by what the lamps' light that falls onto surfaces is scattered; fewer, none, if there is none. */
cm_status draw_virtual_lights(const tof_instant *instant, const cm_mapping *mapping, uint32_t edge,
                              const tof_lamp *lamp, size_t lamps, uint32_t count, cm_pool *pool,
                              virtual_light *light, uint32_t *drawn);

/* Shadow maps of all lights. */
cm_status draw_shadows(tof_virtual_lights *lights, cm_pool *pool);

/* Does the light see the place, as its shadow map has it? */
int is_seen(const tof_virtual_lights *lights, uint32_t which, const double position[3]);

#endif
