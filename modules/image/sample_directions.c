/* SPDX-License-Identifier: MIT
 *
 * Values at directions.
 */
#include "modules/memory/checked_size.h"
#include "source.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Positions farther apart than this are in different windows. */
#define APART 64.0

/* Directions that are found at once. */
#define BLOCK 256

typedef struct sample_desk
{
    const cm_source *source;
    cm_scratch scratch;
    cm_group group;
    size_t place[CM_BLOCK_PIXELS]; /* of each pixel of the group in the output */
    float *pixels;
} sample_desk;

static cm_status flush(sample_desk *desk, float *out)
{
    const uint32_t channels = desk->source->level.channels;
    cm_group *group = &desk->group;
    if (group->count == 0)
    {
        return CM_OK;
    }
    const cm_status status = cm_source_sample(desk->source, group, &desk->scratch,
                                              (unsigned char *)(void *)desk->pixels);
    for (unsigned i = 0; status == CM_OK && i < group->count; i++)
    {
        memcpy(out + desk->place[i] * channels, desk->pixels + (size_t)i * channels,
               channels * sizeof(float));
    }
    group->count = 0;
    return status;
}

static int belongs(const cm_group *group, uint8_t plane, double x, double y)
{
    return group->count > 0 && group->count < CM_BLOCK_PIXELS && group->plane == plane &&
           fabs(x - group->column) < APART && fabs(y - group->row) < APART;
}

static cm_status add(sample_desk *desk, uint8_t plane, double x, double y, size_t place, float *out)
{
    cm_group *group = &desk->group;
    cm_status status = CM_OK;
    if (!belongs(group, plane, x, y))
    {
        status = flush(desk, out);
        group->is_bounded = 0;
        group->plane = plane;
        group->column = (int32_t)floor(x);
        group->row = (int32_t)floor(y);
    }
    group->x[group->count] = (float)(x - 0.5 - group->column);
    group->y[group->count] = (float)(y - 0.5 - group->row);
    desk->place[group->count++] = place;
    return status;
}

static cm_status sample_all(const cm_surface *surface, sample_desk *desk, size_t n, const double *x,
                            const double *y, const double *z, float *out)
{
    const uint32_t channels = desk->source->level.channels;
    cm_status status = CM_OK;
    for (size_t done = 0; done < n && status == CM_OK; done += BLOCK)
    {
        uint8_t plane[BLOCK];
        double column[BLOCK], row[BLOCK];
        const size_t count = n - done < BLOCK ? n - done : BLOCK;
        cm_surface_positions(surface, count, x + done, y + done, z + done, plane, column, row);
        for (size_t i = 0; i < count && status == CM_OK; i++)
        {
            if (plane[i] == CM_NO_FACE)
            {
                memset(out + (done + i) * channels, 0, channels * sizeof(float));
                continue;
            }
            status = add(desk, plane[i], column[i], row[i], done + i, out);
        }
    }
    return status == CM_OK ? flush(desk, out) : status;
}

cm_status cm_sample(const cm_surface *surface, const cm_image *pictures, cm_filter filter, size_t n,
                    const double *x, const double *y, const double *z, float *out)
{
    cm_plan *plan;
    cm_source *source = NULL;
    const cm_plan_options options = {
        .size = sizeof options, .filter = filter == CM_FILTER_AUTO ? CM_FILTER_BSPLINE5 : filter};
    if (surface == NULL || pictures == NULL || filter == CM_FILTER_EWA ||
        (n > 0 && (x == NULL || y == NULL || z == NULL || out == NULL)))
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = cm_plan_create(surface, surface, &options, &plan);
    if (status != CM_OK)
    {
        return status;
    }
    status = cm_source_create(plan, pictures, CM_PIXEL_FLOAT, 1, &source);
    if (status == CM_OK)
    {
        status = cm_source_complete(source, 1);
    }
    if (status == CM_OK)
    {
        sample_desk *desk = calloc(1, sizeof *desk);
        status = desk == NULL ? CM_ERROR_MEMORY : CM_OK;
        if (desk != NULL)
        {
            desk->source = source;
            desk->pixels = cm_array_of(source->level.pixel_size, CM_BLOCK_PIXELS + CM_WINDOW_SLACK);
            status =
                desk->pixels == NULL ? CM_ERROR_MEMORY : sample_all(surface, desk, n, x, y, z, out);
            free(desk->pixels);
            free(desk->scratch.bytes);
            free(desk);
        }
    }
    cm_source_destroy(source);
    cm_plan_destroy(plan);
    return status;
}
