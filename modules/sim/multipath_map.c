/* SPDX-License-Identifier: MIT
 *
 * A reflective shadow map (Dachsbacher and Stamminger 2005) in a map of the sphere around a lamp, and lights drawn from it. A
 * cell has the lamp's intensity times its solid angle, whatever it falls onto. Cells are in the order of Hilbert's curve, along
 * which a systematic draw takes every so many watts: lights are spread evenly over the sphere.
 */
#include "modules/memory/checked_size.h"
#include "multipath_object.h"
#include "brdf_object.h"
#include "map_cells.h"

#include <cubemap/cell.h>

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum
{
    BLOCK = 512,
    CELLS_A_LIGHT = 4 /* at least, of a map in which lights are drawn */
};

/* Metres. Loops over lights are of single precision, which has no fourth power of much more; nothing is lit from there. */
#define FARTHEST 1e9

/* What all blocks of the map share. */
typedef struct map
{
    const tof_instant *instant;
    const cm_mapping *mapping;
    uint32_t edge;
    int level;   /* of the curve, whose cells are as many as the map's or more */
    size_t each; /* cells of the curve a lamp */
    const tof_lamp *lamp;
    uint32_t count;    /* of lights to draw */
    double *scattered; /* watts of each cell of each lamp */
    atomic_int status;
} map;

/* Rays of some cells. */
typedef struct rays
{
    size_t n;
    double origin[3][BLOCK];
    double direction[3][BLOCK];
    double angle[BLOCK];     /* solid */
    double intensity[BLOCK]; /* W/sr */
    double distance[BLOCK];
    double normal[3][BLOCK];
    uint32_t id[BLOCK];
    double share[BLOCK]; /* of light that is scattered: reflectance and albedo */
} rays;

/* Does the map have the cell of that number on the curve? */
static int place_of_cell(const map *m, size_t index, cm_cell_place *place)
{
    const cm_cell cell = cm_cell_at_index(m->level, index);
    return cm_cell_to_place(CM_CURVE_HILBERT, cell, place) == CM_OK && place->i < m->edge &&
           place->j < m->edge;
}

/* Of a thin cone the map of all directions has few cells, or none. */
static int is_of_cone(const map *m, const tof_lamp *lamp)
{
    const double cells = (double)map_faces(m->mapping) * m->edge * m->edge;
    return lamp->part * cells < (double)CELLS_A_LIGHT * m->count;
}

/* From all directions to those of the cone, each as much smaller: heights of a sphere's zones are as their areas. */
static void turn_into_cone(const tof_lamp *lamp, const double all[3], double within[3])
{
    const double height = lamp->part * (1.0 - all[2]), sine = sqrt(height * (2.0 - height));
    const double across = sqrt(all[0] * all[0] + all[1] * all[1]);
    const double cosine = across > 0.0 ? all[0] / across : 1.0;
    const double side = across > 0.0 ? all[1] / across : 0.0;
    double x[3], y[3];
    find_across(lamp->axis, x);
    cross(lamp->axis, x, y);
    for (int k = 0; k < 3; k++)
    {
        within[k] = (1.0 - height) * lamp->axis[k] + sine * (cosine * x[k] + side * y[k]);
    }
}

/* Directions of cells' middles, and solid angles by the inverse's Jacobian. */
static void find_rays(const map *m, size_t n, const size_t *cell, rays *r)
{
    double u[BLOCK];
    double v[BLOCK];
    uint8_t face[BLOCK];
    double column[6][BLOCK];
    double *const jacobian[6] = {column[0], column[1], column[2], column[3], column[4], column[5]};
    const double side = 2.0 / m->edge;
    r->n = n;
    for (size_t i = 0; i < n; i++)
    {
        cm_cell_place place;
        const int has = place_of_cell(m, cell[i] % m->each, &place);
        face[i] = has ? place.face : CM_NO_FACE;
        u[i] = has ? -1.0 + (place.i + 0.5) * side : 0.0;
        v[i] = has ? -1.0 + (place.j + 0.5) * side : 0.0;
        for (int k = 0; k < 3; k++)
        {
            r->origin[k][i] = m->lamp[cell[i] / m->each].position[k];
        }
    }
    cm_inverse_array(m->mapping, n, face, u, v, r->direction[0], r->direction[1], r->direction[2]);
    cm_inverse_jacobian_array(m->mapping, n, face, u, v, jacobian);
    for (size_t i = 0; i < n; i++)
    {
        const double at[6] = {column[0][i], column[1][i], column[2][i],
                              column[3][i], column[4][i], column[5][i]};
        r->angle[i] = map_stretch(at) * side * side;
        if (r->angle[i] == 0.0)
        {
            r->direction[0][i] = r->direction[1][i] = 0.0;
            r->direction[2][i] = 1.0;
        }
        const tof_lamp *lamp = m->lamp + cell[i] / m->each;
        if (is_of_cone(m, lamp))
        {
            const double all[3] = {r->direction[0][i], r->direction[1][i], r->direction[2][i]};
            double within[3];
            turn_into_cone(lamp, all, within);
            for (int k = 0; k < 3; k++)
            {
                r->direction[k][i] = within[k];
            }
            r->angle[i] *= lamp->part;
        }
    }
}

static void cast_rays(const map *m, const size_t *cell, rays *r)
{
    const tof_surface *surface = tof_instant_surfaces(m->instant);
    const tof_hits hits = {
        .distance = r->distance, .id = r->id, .normal = {r->normal[0], r->normal[1], r->normal[2]}};
    const double *const origin[3] = {r->origin[0], r->origin[1], r->origin[2]};
    const double *const direction[3] = {r->direction[0], r->direction[1], r->direction[2]};
    tof_cast(m->instant, r->n, origin, direction, &hits);
    for (size_t i = 0; i < r->n; i++)
    {
        const tof_lamp *lamp = m->lamp + cell[i] / m->each;
        double cosine = 0.0;
        double incidence = 0.0;
        double reach = r->distance[i];
        for (int k = 0; k < 3; k++)
        {
            cosine += r->direction[k][i] * lamp->axis[k];
            incidence -= r->direction[k][i] * r->normal[k][i];
            reach += fabs(r->origin[k][i]);
        }
        r->intensity[i] = tof_lamp_intensity(lamp, cosine);
        r->share[i] = 0.0;
        if (r->id[i] != CM_SCENE_NOTHING && incidence > 0.0 && r->angle[i] > 0.0 &&
            reach < FARTHEST)
        {
            const tof_surface *s = surface + r->id[i];
            r->share[i] = s->reflectance * cm_brdf_albedo(s->brdf, acos(fmin(1.0, incidence)));
        }
    }
}

static void measure_cells(size_t from, size_t to, void *user)
{
    map *const m = user;
    rays *const r = malloc(sizeof *r);
    if (r == NULL)
    {
        atomic_store(&m->status, CM_ERROR_MEMORY);
        return;
    }
    for (size_t begin = from; begin < to; begin += BLOCK)
    {
        size_t cell[BLOCK];
        const size_t n = to - begin < BLOCK ? to - begin : BLOCK;
        for (size_t i = 0; i < n; i++)
        {
            cell[i] = begin + i;
        }
        find_rays(m, n, cell, r);
        cast_rays(m, cell, r);
        for (size_t i = 0; i < n; i++)
        {
            m->scattered[begin + i] = r->intensity[i] * r->angle[i] * r->share[i];
        }
    }
    free(r);
}

/* One light from each of count equal parts of all watts, from the middle of the part. */
static void pick_cells(const map *m, size_t cells, double whole, uint32_t count, size_t *cell)
{
    double sum = 0.0;
    uint32_t picked = 0;
    size_t last = 0;
    for (size_t i = 0; i < cells && picked < count; i++)
    {
        sum += m->scattered[i];
        last = m->scattered[i] > 0.0 ? i : last;
        while (picked < count && sum > (picked + 0.5) * whole / count)
        {
            cell[picked++] = i;
        }
    }
    while (picked < count)
    {
        cell[picked++] = last;
    }
}

static void put_lights(const map *m, const rays *r, double watts, virtual_light *light)
{
    for (size_t i = 0; i < r->n; i++)
    {
        virtual_light *const l = light + i;
        const double share = r->share[i];
        double cosine = 0.0;
        for (int k = 0; k < 3; k++)
        {
            l->position[k] = r->origin[k][i] + r->distance[i] * r->direction[k][i];
            l->normal[k] = r->normal[k][i];
            l->to_lamp[k] = -r->direction[k][i];
            cosine += l->normal[k] * l->to_lamp[k];
        }
        const tof_surface *s = tof_instant_surfaces(m->instant) + r->id[i];
        l->length = r->distance[i];
        l->id = r->id[i];
        l->flux = watts / share * s->reflectance;
        l->area = watts / (share * r->intensity[i]) * l->length * l->length / cosine;
    }
}

static cm_status draw(map *m, size_t cells, uint32_t count, virtual_light *light, uint32_t *drawn)
{
    double whole = 0.0;
    for (size_t i = 0; i < cells; i++)
    {
        whole += m->scattered[i];
    }
    if (!(whole > 0.0))
    {
        return CM_OK;
    }
    size_t *const cell = cm_array_of(count, sizeof *cell);
    rays *const r = malloc(sizeof *r);
    if (cell == NULL || r == NULL)
    {
        free(cell);
        free(r);
        return CM_ERROR_MEMORY;
    }
    pick_cells(m, cells, whole, count, cell);
    for (size_t begin = 0; begin < count; begin += BLOCK)
    {
        const size_t n = count - begin < BLOCK ? count - begin : BLOCK;
        find_rays(m, n, cell + begin, r);
        cast_rays(m, cell + begin, r);
        put_lights(m, r, whole / count, light + begin);
    }
    *drawn = count;
    free(cell);
    free(r);
    return CM_OK;
}

cm_status draw_virtual_lights(const tof_instant *instant, const cm_mapping *mapping, uint32_t edge,
                              const tof_lamp *lamp, size_t lamps, uint32_t count, cm_pool *pool,
                              virtual_light *light, uint32_t *drawn)
{
    map m = {.instant = instant, .mapping = mapping, .edge = edge, .lamp = lamp, .count = count};
    *drawn = 0;
    while ((uint32_t)1 << m.level < edge)
    {
        m.level++;
    }
    m.each = (size_t)map_faces(mapping) << (2 * m.level);
    if (lamps > SIZE_MAX / sizeof(double) / m.each)
    {
        return CM_ERROR_MEMORY;
    }
    const size_t cells = m.each * lamps;
    m.scattered = cm_array_of(cells, sizeof *m.scattered);
    if (m.scattered == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    atomic_init(&m.status, CM_OK);
    cm_pool_run(pool, cells, BLOCK, measure_cells, &m);
    cm_status status = (cm_status)atomic_load(&m.status);
    if (status == CM_OK)
    {
        status = draw(&m, cells, count, light, drawn);
    }
    free(m.scattered);
    return status;
}
