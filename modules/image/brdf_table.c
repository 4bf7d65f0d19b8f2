/* SPDX-License-Identifier: MIT */
#include <cubemap/environment.h>

#include "environment_pixels.h"
#include "image_jobs.h"

typedef struct table_job
{
    cm_brdf_shadowing shadowing;
    const cm_image *to;
} table_job;

static void make_row(size_t row, void *user)
{
    const table_job *job = user;
    const double roughness = ((double)row + 0.5) / job->to->height;
    for (uint32_t column = 0; column < job->to->width; column++)
    {
        cm_brdf_terms terms = {0.0, 0.0};
        cm_brdf_integrate(job->shadowing, (column + 0.5) / job->to->width, roughness, &terms);
        const float value[3] = {(float)terms.scale, (float)terms.bias,
                                (float)(1.0 - terms.scale - terms.bias)};
        cm_pixel_store(job->to, (uint32_t)row, column, value);
    }
}

cm_status cm_brdf_table(cm_brdf_shadowing shadowing, unsigned threads, const cm_image *to)
{
    const cm_status status = cm_pixels_check(to, 3);
    if (status != CM_OK)
    {
        return status;
    }
    if (to->channels < 2 || (int)shadowing < CM_BRDF_CORRELATED || (int)shadowing > CM_BRDF_SCHLICK)
    {
        return CM_ERROR_RANGE;
    }
    table_job job = {shadowing, to};
    cm_run_pieces(threads, to->height, make_row, &job);
    return CM_OK;
}
