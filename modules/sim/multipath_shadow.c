/* SPDX-License-Identifier: MIT
 *
 * Shadow maps of virtual lights, small ones: a cell has not the distance of what is seen there, which changes within the cell,
 * but its plane.
 */
#include "map_cells.h"
#include "multipath_object.h"
#include "surface_ray.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

enum
{
    EDGE = 24,
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

static void draw_some_shadows(size_t from, size_t to, void *user)
{
    const shadow_job *const job = user;
    tof_virtual_lights *const lights = job->lights;
    for (size_t which = from; which < to; which++)
    {
        const virtual_light *l = lights->light + which;
        float(*const plane)[4] = lights->plane + which * lights->shadow_cells;
        shadow_rays r;
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
    }
}

cm_status draw_shadows(tof_virtual_lights *lights, cm_pool *pool)
{
    const size_t faces = (size_t)map_faces(lights->shadow_mapping);
    const size_t cells = faces * EDGE * EDGE;
    double *const number = malloc(5 * cells * sizeof *number);
    uint8_t *const face = malloc(cells);
    lights->plane = malloc(lights->count * cells * sizeof *lights->plane);
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
        face[i] = (uint8_t)(i / (EDGE * EDGE));
        u[i] = ((double)(i % EDGE) + 0.5) * 2.0 / EDGE - 1.0;
        v[i] = ((double)(i / EDGE % EDGE) + 0.5) * 2.0 / EDGE - 1.0;
    }
    cm_inverse_array(lights->shadow_mapping, cells, face, u, v, number, number + cells,
                     number + 2 * cells);
    lights->shadow_edge = EDGE;
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
    const float scale = 0.5f * EDGE;
    const int column = (int)(uv[0] * scale + scale);
    const int row = (int)(uv[1] * scale + scale);
    const float *const p = plane[(face * EDGE + (row < EDGE ? row : EDGE - 1)) * EDGE +
                                 (column < EDGE ? column : EDGE - 1)];
    const float height = p[0] * at[0] + p[1] * at[1] + p[2] * at[2] + p[3];
    return (double)height >= -(double)PLANE_REACH * sqrt(square);
}
