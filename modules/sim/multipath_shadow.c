/* SPDX-License-Identifier: MIT
 *
 * Shadow maps of virtual lights, small ones: a cell has not the distance of what is seen there, which changes within the cell,
 * but its plane.
 */
#include "modules/memory/checked_size.h"
#include "map_cells.h"
#include "multipath_object.h"
#include "surface_ray.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum
{
    CUBE_EDGE = 24,
    SQUARE_EDGE = 59, /* of a map that is one square: about as many cells */
    CELLS = SQUARE_EDGE * SQUARE_EDGE,
    BLOCK = 256
};

typedef struct shadow_job
{
    tof_virtual_lights *lights;
    const double *direction[3]; /* of cells */
} shadow_job;

typedef struct shadow_rays
{
    size_t n;
    size_t cell[BLOCK];
    double origin[3][BLOCK];
    double direction[3][BLOCK];
    double distance[BLOCK];
    double normal[3][BLOCK];
} shadow_rays;

static void put_planes(const tof_virtual_lights *lights, shadow_rays *r, float (*plane)[4])
{
    const double *const origin[3] = {r->origin[0], r->origin[1], r->origin[2]};
    const double *const direction[3] = {r->direction[0], r->direction[1], r->direction[2]};
    const tof_hits hits = {.distance = r->distance,
                           .normal = {r->normal[0], r->normal[1], r->normal[2]}};
    tof_cast(lights->instant, r->n, origin, direction, &hits);
    for (size_t i = 0; i < r->n; i++)
    {
        float *const to = plane[r->cell[i]];
        double number = 0.0;
        for (int k = 0; k < 3 && isfinite(r->distance[i]); k++)
        {
            const double at = r->origin[k][i] + r->distance[i] * r->direction[k][i];
            number -= r->normal[k][i] * (at - lights->origin[k]);
            to[k] = (float)r->normal[k][i];
            to[3] = (float)number;
        }
    }
    r->n = 0;
}

/* ---- cells of curved surfaces ---- */

static float height_above(const float plane[4], const float at[3])
{
    return plane[0] * at[0] + plane[1] * at[1] + plane[2] * at[2] + plane[3];
}

static int is_flat(const float one[4], const float other[4])
{
    return one[0] == other[0] && one[1] == other[1] && one[2] == other[2];
}

/* Where a cell's ray meets its plane. */
static void find_place(const shadow_job *job, const float from[3], const float plane[4],
                       size_t cell, float at[3])
{
    float along = 0.0f;
    for (int k = 0; k < 3; k++)
    {
        along += plane[k] * (float)job->direction[k][cell];
    }
    const float distance = -height_above(plane, from) / along;
    for (int k = 0; k < 3; k++)
    {
        at[k] = from[k] + distance * (float)job->direction[k][cell];
    }
}

/* Of two cells beside each other on a convex surface, whose places are each below the other's plane: how far it falls from a
 * cell's plane to the other's place, and half of that to the cell's corner. What throws a shadow onto another is above. */
static void find_fall(const shadow_job *job, const float from[3], float (*plane)[4], size_t cell,
                      size_t beside, float *fall)
{
    float here[3], there[3];
    if (is_flat(plane[cell], plane[beside]))
    {
        return;
    }
    find_place(job, from, plane[cell], cell, here);
    find_place(job, from, plane[beside], beside, there);
    const float there_below = -height_above(plane[cell], there);
    const float here_below = -height_above(plane[beside], here);
    if (there_below > 0.0f && here_below > 0.0f)
    {
        fall[cell] = fmaxf(fall[cell], 0.5f * there_below);
        fall[beside] = fmaxf(fall[beside], 0.5f * here_below);
    }
}

/* Convex surfaces would else shadow themselves: planes of cells go down to where the surface is at the cell's corner. */
static void lower_planes(const shadow_job *job, size_t which, float *fall, float (*plane)[4])
{
    const tof_virtual_lights *lights = job->lights;
    const float *const from = lights->fast[which].position;
    const size_t edge = (size_t)lights->shadow_edge;
    memset(fall, 0, lights->shadow_cells * sizeof *fall);
    for (size_t cell = 0; cell < lights->shadow_cells; cell++)
    {
        if (cell % edge + 1 < edge)
        {
            find_fall(job, from, plane, cell, cell + 1, fall);
        }
        if (cell / edge % edge + 1 < edge)
        {
            find_fall(job, from, plane, cell, cell + edge, fall);
        }
    }
    for (size_t cell = 0; cell < lights->shadow_cells; cell++)
    {
        plane[cell][3] += fall[cell];
    }
}

static void draw_some_shadows(size_t from, size_t to, void *user)
{
    const shadow_job *const job = user;
    tof_virtual_lights *const lights = job->lights;
    for (size_t which = from; which < to; which++)
    {
        const virtual_light *l = lights->light + which;
        float(*const plane)[4] = lights->plane + which * lights->shadow_cells;
        shadow_rays r;
        float fall[CELLS];
        double begin[3];
        r.n = 0;
        leave_surface(l->position, l->normal, begin);
        for (size_t cell = 0; cell < lights->shadow_cells; cell++)
        {
            const double d[3] = {job->direction[0][cell], job->direction[1][cell],
                                 job->direction[2][cell]};
            plane[cell][0] = plane[cell][1] = plane[cell][2] = 0.0f;
            plane[cell][3] = 1.0f;
            /* No light goes below the surface; NaN, where the map has no direction, neither. */
            if (d[0] * l->normal[0] + d[1] * l->normal[1] + d[2] * l->normal[2] > 0.0)
            {
                for (int k = 0; k < 3; k++)
                {
                    r.origin[k][r.n] = begin[k];
                    r.direction[k][r.n] = d[k];
                }
                r.cell[r.n++] = cell;
            }
            if (r.n == BLOCK || (r.n > 0 && cell + 1 == lights->shadow_cells))
            {
                put_planes(lights, &r, plane);
            }
        }
        lower_planes(job, which, fall, plane);
    }
}

cm_status draw_shadows(tof_virtual_lights *lights, cm_pool *pool)
{
    const size_t faces = (size_t)map_faces(lights->shadow_mapping);
    const size_t edge = faces == 1 ? SQUARE_EDGE : CUBE_EDGE;
    const size_t cells = faces * edge * edge;
    double *const number = cm_array_of(5 * cells, sizeof *number);
    uint8_t *const face = malloc(cells);
    lights->plane = cm_array_of(lights->count, cells * sizeof *lights->plane);
    if (number == NULL || face == NULL || lights->plane == NULL)
    {
        free(number);
        free(face);
        return CM_ERROR_MEMORY;
    }
    double *const u = number + 3 * cells;
    double *const v = number + 4 * cells;
    for (size_t i = 0; i < cells; i++)
    {
        face[i] = (uint8_t)(i / (edge * edge));
        u[i] = ((double)(i % edge) + 0.5) * 2.0 / (double)edge - 1.0;
        v[i] = ((double)(i / edge % edge) + 0.5) * 2.0 / (double)edge - 1.0;
    }
    cm_inverse_array(lights->shadow_mapping, cells, face, u, v, number, number + cells,
                     number + 2 * cells);
    lights->shadow_edge = (int)edge;
    lights->shadow_cells = cells;
    shadow_job job = {lights, {number, number + cells, number + 2 * cells}};
    cm_pool_run(pool, lights->count, 1, draw_some_shadows, &job);
    free(number);
    free(face);
    return CM_OK;
}

int is_seen(const tof_virtual_lights *lights, uint32_t which, const double position[3])
{
    const float(*const plane)[4] = (const float(*)[4])lights->plane + which * lights->shadow_cells;
    float at[3];
    float way[3];
    float uv[2];
    double square = 0.0;
    for (int k = 0; k < 3; k++)
    {
        at[k] = (float)(position[k] - lights->origin[k]);
        way[k] = at[k] - lights->fast[which].position[k];
        square += (double)way[k] * (double)way[k];
    }
    const uint8_t face = cm_forward_f32(lights->shadow_mapping, way, uv);
    if (face == CM_NO_FACE)
    {
        return 1;
    }
    const int edge = lights->shadow_edge;
    const float scale = 0.5f * (float)edge;
    const int column = (int)(uv[0] * scale + scale);
    const int row = (int)(uv[1] * scale + scale);
    const float *const p = plane[(face * edge + (row < edge ? row : edge - 1)) * edge +
                                 (column < edge ? column : edge - 1)];
    return (double)height_above(p, at) >= -(double)PLANE_REACH * sqrt(square);
}
