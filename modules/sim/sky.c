/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "sky.h"
#include "map_cells.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum
{
    CELLS_AT_ONCE = 4096,
    PROBES = 64
};

struct tof_sky
{
    const cm_tof_environment *environment;
    size_t cells;
    double *until; /* what all cells to each one have more than the mean; NULL: no picture */
    double whole;
    double light; /* of all of the picture */
    /* by which a later environment is known to be the same one */
    uint32_t edge;
    float *radiance;
    double probe[PROBES][3]; /* directions of places on the mapping's faces */
};

/* What is more than the mean by rounding alone is not. */
#define ROUNDING 1e-6

/* ---- cells ---- */

static void place_in_cell(const cm_tof_environment *environment, size_t cell, double u, double v,
                          uint8_t *face, double uv[2])
{
    const size_t edge = environment->edge;
    *face = (uint8_t)(cell / edge / edge);
    uv[0] = 2.0 * ((double)(cell % edge) + u) / (double)edge - 1.0;
    uv[1] = 2.0 * ((double)(cell / edge % edge) + v) / (double)edge - 1.0;
}

/* SIZE_MAX: a direction that the map has not. */
static size_t cell_of(const cm_tof_environment *environment, const double direction[3],
                      uint8_t *face, double uv[2])
{
    *face = cm_forward(environment->mapping, direction, uv);
    if (*face == CM_NO_FACE)
    {
        return SIZE_MAX;
    }
    const uint32_t edge = environment->edge;
    const double column = fmax(0.0, 0.5 * (uv[0] + 1.0) * edge);
    const double row = fmax(0.0, 0.5 * (uv[1] + 1.0) * edge);
    const size_t i = column < edge ? (size_t)column : edge - 1;
    const size_t j = row < edge ? (size_t)row : edge - 1;
    return (*face * (size_t)edge + j) * edge + i;
}

static double stretch_at(const cm_tof_environment *environment, uint8_t face, const double uv[2])
{
    double jacobian[6];
    cm_inverse_jacobian(environment->mapping, face, uv, jacobian);
    return map_stretch(jacobian);
}

/* What of a map's plane is behind a cell, times solid angle. */
static void find_stretches(size_t begin, size_t end, void *user)
{
    tof_sky *const sky = user;
    for (size_t i = begin; i < end; i++)
    {
        double uv[2];
        uint8_t face;
        place_in_cell(sky->environment, i, 0.5, 0.5, &face, uv);
        sky->until[i] = stretch_at(sky->environment, face, uv);
    }
}

/* From the cells' solid angles to what they have more than the mean, summed. */
static void sum_cells(tof_sky *sky)
{
    double area = 0.0;
    for (size_t i = 0; i < sky->cells; i++)
    {
        area += sky->until[i];
        sky->light += sky->until[i] * (double)sky->environment->radiance[i];
    }
    const double mean = area > 0.0 ? sky->light / area * (1.0 + ROUNDING) : 0.0;
    for (size_t i = 0; i < sky->cells; i++)
    {
        const double more = (double)sky->environment->radiance[i] - mean;
        sky->whole += more > 0.0 ? more * sky->until[i] : 0.0;
        sky->until[i] = sky->whole;
    }
}

/* Places that no symmetry of faces takes to each other; of all faces in turn. */
static void probe_mapping(const cm_mapping *mapping, double direction[PROBES][3])
{
    for (int i = 0; i < PROBES; i++)
    {
        const double uv[2] = {2.0 * fmod(0.7548776662466927 * (i + 1), 1.0) - 1.0,
                              2.0 * fmod(0.5698402909980532 * (i + 1), 1.0) - 1.0};
        cm_inverse(mapping, (uint8_t)(i % map_faces(mapping)), uv, direction[i]);
    }
}

static cm_status find_cells(const cm_tof_environment *environment, cm_pool *pool, tof_sky *sky)
{
    const size_t edge = environment->edge;
    sky->edge = environment->edge;
    sky->cells = (size_t)map_faces(environment->mapping) * edge * edge;
    sky->until = cm_array_of(sky->cells, sizeof *sky->until);
    sky->radiance = cm_array_of(sky->cells, sizeof *sky->radiance);
    if (sky->until == NULL || sky->radiance == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    memcpy(sky->radiance, environment->radiance, sky->cells * sizeof *sky->radiance);
    probe_mapping(environment->mapping, sky->probe);
    cm_pool_run(pool, sky->cells, CELLS_AT_ONCE, find_stretches, sky);
    sum_cells(sky);
    return CM_OK;
}

cm_status sky_create(const cm_tof_environment *environment, cm_pool *pool, tof_sky **made)
{
    tof_sky *sky = calloc(1, sizeof *sky);
    if (sky == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    sky->environment = environment;
    if (environment->radiance != NULL && find_cells(environment, pool, sky) != CM_OK)
    {
        sky_destroy(sky);
        return CM_ERROR_MEMORY;
    }
    *made = sky;
    return CM_OK;
}

void sky_destroy(tof_sky *sky)
{
    if (sky != NULL)
    {
        free(sky->until);
        free(sky->radiance);
        free(sky);
    }
}

int sky_turn_to(const cm_tof_environment *environment, tof_sky *sky)
{
    int is_same = (environment->radiance == NULL) == (sky->radiance == NULL);
    if (is_same && sky->radiance != NULL)
    {
        double probe[PROBES][3];
        probe_mapping(environment->mapping, probe);
        is_same =
            environment->edge == sky->edge &&
            (size_t)map_faces(environment->mapping) * sky->edge * sky->edge == sky->cells &&
            memcmp(probe, sky->probe, sizeof probe) == 0 &&
            memcmp(environment->radiance, sky->radiance, sky->cells * sizeof *sky->radiance) == 0;
    }
    if (is_same)
    {
        sky->environment = environment;
    }
    return is_same;
}

double sky_constant(const tof_sky *sky)
{
    return sky->environment->constant;
}

double sky_contrast(const tof_sky *sky)
{
    return sky->whole > 0.0 ? sky->whole / sky->light : 0.0;
}

/* ---- directions ---- */

int sky_draw(const tof_sky *sky, const double u[3], double direction[3])
{
    const double light = u[0] * sky->whole;
    size_t cell = 0, end = sky->cells - 1;
    while (cell < end) /* the first that has more until it */
    {
        const size_t middle = cell + (end - cell) / 2;
        if (sky->until[middle] > light)
        {
            end = middle;
        }
        else
        {
            cell = middle + 1;
        }
    }
    double uv[2], square = 0.0;
    uint8_t face;
    place_in_cell(sky->environment, cell, u[1], u[2], &face, uv);
    cm_inverse(sky->environment->mapping, face, uv, direction);
    for (int k = 0; k < 3; k++)
    {
        square += direction[k] * direction[k];
    }
    for (int k = 0; k < 3; k++)
    {
        direction[k] /= sqrt(square);
    }
    return square > 0.0 && isfinite(square);
}

double sky_look(const tof_sky *sky, const double direction[3], double *density)
{
    double uv[2];
    uint8_t face;
    *density = 0.0;
    if (sky->until == NULL)
    {
        return 0.0;
    }
    const size_t cell = cell_of(sky->environment, direction, &face, uv);
    if (cell == SIZE_MAX)
    {
        return 0.0;
    }
    const double part = sky->until[cell] - (cell > 0 ? sky->until[cell - 1] : 0.0);
    const double stretch = part > 0.0 ? stretch_at(sky->environment, face, uv) : 0.0;
    const double half = 0.5 * (double)sky->environment->edge;
    *density = stretch > 0.0 ? part / sky->whole * half * half / stretch : 0.0;
    return (double)sky->environment->radiance[cell];
}

double sky_radiance(const cm_tof_environment *environment, const double direction[3])
{
    double uv[2];
    uint8_t face;
    const size_t cell =
        environment->radiance == NULL ? SIZE_MAX : cell_of(environment, direction, &face, uv);
    return environment->constant + (cell == SIZE_MAX ? 0.0 : (double)environment->radiance[cell]);
}
