/* SPDX-License-Identifier: MIT
 *
 * Levels prefiltered by GGX, from samples of the lobe that are as large as their share of it (Krivanek and Colbert
 * 2008, Real-time shading with filtered importance sampling).
 */
#include <math.h>
#include <stdlib.h>

#include "environment_angles.h"
#include "environment_cells.h"
#include "environment_levels.h"
#include "environment_lobe.h"
#include "environment_lookup.h"
#include "environment_pixels.h"
#include "environment_whole.h"
#include "image_jobs.h"

/* So many samples are mapped at once. */
#define SOME 256

typedef struct prefilter_job
{
    const cm_environment *environment;
    cm_lobe lobe;
    int is_one_face; /* is environment->edge of one face? */
    int is_filtered;
    const float
        *target_edge; /* roughness 0: like environment->edge, of pixels of the target; else NULL */
    int is_one_target;
    const cm_mapping *mapping;
    const cm_image *to;
} prefilter_job;

/* Two directions at right angles to a third and each other (Duff et al. 2017, Building an orthonormal basis,
 * revisited). */
static void make_basis(const float n[3], float tangent[3], float bitangent[3])
{
    const float sign = copysignf(1.0F, n[2]);
    const float a = -1.0F / (sign + n[2]);
    const float b = n[0] * n[1] * a;
    tangent[0] = 1.0F + sign * n[0] * n[0] * a;
    tangent[1] = sign * b;
    tangent[2] = -sign * n[0];
    bitangent[0] = b;
    bitangent[1] = sign + n[1] * n[1] * a;
    bitangent[2] = -n[1];
}

/* Samples first to first + some - 1, turned to n. */
static void add_samples(const prefilter_job *job, const float n[3], const float tangent[3],
                        const float bitangent[3], size_t first, size_t some, float sum[CM_TEXEL])
{
    const cm_lobe *lobe = &job->lobe;
    const cm_environment *environment = job->environment;
    const float *restrict a = lobe->x + first;
    const float *restrict b = lobe->y + first;
    const float *restrict c = lobe->z + first;
    uint8_t face[SOME];
    float x[SOME];
    float y[SOME];
    float z[SOME];
    for (size_t k = 0; k < some; k++)
    {
        x[k] = a[k] * tangent[0] + b[k] * bitangent[0] + c[k] * n[0];
        y[k] = a[k] * tangent[1] + b[k] * bitangent[1] + c[k] * n[1];
        z[k] = a[k] * tangent[2] + b[k] * bitangent[2] + c[k] * n[2];
    }
    cm_forward_array_f32(environment->mapping, some, x, y, z, face, x, y);
    for (size_t k = 0; k < some; k++)
    {
        const float level = job->is_filtered ? lobe->edge[first + k] -
                                                   cm_edge_at(environment->edge, job->is_one_face,
                                                              face[k], x[k], y[k])
                                             : 0.0F;
        cm_environment_add(environment, face[k], x[k], y[k], level, lobe->weight[first + k], sum);
    }
}

/* The mean over the lobe around a direction. Sums of blocks are added in double. */
static void add_lobe(const prefilter_job *job, const double direction[3], float value[CM_TEXEL])
{
    const float n[3] = {(float)direction[0], (float)direction[1], (float)direction[2]};
    float tangent[3];
    float bitangent[3];
    double sum[CM_TEXEL] = {0.0, 0.0, 0.0, 0.0};
    make_basis(n, tangent, bitangent);
    for (size_t first = 0; first < job->lobe.count; first += SOME)
    {
        const size_t rest = job->lobe.count - first;
        float part[CM_TEXEL] = {0.0F, 0.0F, 0.0F, 0.0F};
        add_samples(job, n, tangent, bitangent, first, rest < SOME ? rest : SOME, part);
        for (size_t c = 0; c < CM_TEXEL; c++)
        {
            sum[c] += (double)part[c];
        }
    }
    for (size_t c = 0; c < CM_TEXEL; c++)
    {
        value[c] = (float)sum[c];
    }
}

/* The environment in one direction, as large as the target's pixel there. */
static void add_mirrored(const prefilter_job *job, const double direction[3], uint8_t target,
                         const double target_uv[2], float value[CM_TEXEL])
{
    double uv[2];
    const uint8_t face = cm_forward(job->environment->mapping, direction, uv);
    const float u = (float)uv[0];
    const float v = (float)uv[1];
    const float level = cm_edge_at(job->target_edge, job->is_one_target, target,
                                   (float)target_uv[0], (float)target_uv[1]) -
                        cm_edge_at(job->environment->edge, job->is_one_face, face, u, v);
    for (size_t c = 0; c < CM_TEXEL; c++)
    {
        value[c] = 0.0F;
    }
    cm_environment_add(job->environment, face, u, v, level, 1.0F, value);
}

/* A row of the target; rows of all faces are counted through. */
static void prefilter_row(size_t index, void *user)
{
    const prefilter_job *job = user;
    const uint32_t n = job->to[0].width;
    const uint8_t face = (uint8_t)(index / n);
    const uint32_t row = (uint32_t)(index % n);
    for (uint32_t column = 0; column < n; column++)
    {
        const double uv[2] = {(2.0 * column + 1.0) / n - 1.0, (2.0 * row + 1.0) / n - 1.0};
        double direction[3];
        float value[CM_TEXEL];
        cm_inverse(job->mapping, face, uv, direction);
        if (job->target_edge != NULL)
        {
            add_mirrored(job, direction, face, uv, value);
        }
        else
        {
            add_lobe(job, direction, value);
        }
        cm_pixel_store(&job->to[face], cm_face_row(job->mapping, n, row), column, value);
    }
}

static cm_status prefilter_lobe(prefilter_job *job, const cm_prefilter_options *options,
                                double alpha_squared)
{
    const uint32_t samples = options->samples != 0 ? options->samples : 256;
    const cm_status status =
        cm_lobe_make(options->method, alpha_squared, samples, options->blur, &job->lobe);
    if (status == CM_OK)
    {
        job->is_filtered = options->method != CM_PREFILTER_UNFILTERED;
        cm_run_pieces(options->threads, 6 * (size_t)job->to[0].width, prefilter_row, job);
        free(job->lobe.memory);
    }
    return status;
}

static cm_status prefilter_mirror(prefilter_job *job, unsigned threads)
{
    float *edge = NULL;
    const cm_status status = cm_angle_edges_make(job->mapping, job->to[0].width, threads, &edge);
    if (status == CM_OK)
    {
        job->target_edge = edge;
        job->is_one_target = cm_angle_faces(job->mapping) == 1;
        cm_run_pieces(threads, 6 * (size_t)job->to[0].width, prefilter_row, job);
        free(edge);
    }
    return status;
}

static double coarseness_of(const cm_prefilter_options *options)
{
    return options->coarseness != 0.0 ? options->coarseness : CM_CELLS_COARSENESS;
}

static cm_status check_options(const cm_environment *environment, double roughness,
                               const cm_prefilter_options *options)
{
    if (options->size != sizeof *options)
    {
        return CM_ERROR_ARGUMENT;
    }
    const int is_method =
        (int)options->method >= CM_PREFILTER_AUTO && (int)options->method <= CM_PREFILTER_ALL;
    const uint32_t subdivision = options->subdivision != 0 ? options->subdivision : 1;
    const double coarseness = coarseness_of(options);
    if (!(roughness >= 0.0 && roughness <= 1.0) || !is_method || options->samples > 65536 ||
        !(coarseness >= 1e-3 && coarseness <= 10.0) || !(fabs(options->blur) <= 16.0) ||
        options->level >= environment->level_count || subdivision > 16 ||
        subdivision * environment->level[options->level].size > CM_ENVIRONMENT_SIZE_MAX)
    {
        return CM_ERROR_RANGE;
    }
    return CM_OK;
}

cm_status cm_environment_prefilter(const cm_environment *environment, double roughness,
                                   const cm_prefilter_options *options, const cm_mapping *mapping,
                                   const cm_image to[6])
{
    const cm_prefilter_options standard = {.size = sizeof standard};
    const cm_prefilter_options *o = options != NULL ? options : &standard;
    if (environment == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = cm_faces_check(mapping, to);
    status = status == CM_OK ? check_options(environment, roughness, o) : status;
    if (status == CM_OK && to[0].channels != environment->channels)
    {
        status = CM_ERROR_RANGE;
    }
    if (status != CM_OK)
    {
        return status;
    }
    const double alpha_squared = roughness * roughness * roughness * roughness;
    prefilter_job job = {.environment = environment, .mapping = mapping, .to = to};
    job.is_one_face = cm_angle_faces(environment->mapping) == 1;
    if (alpha_squared <= CM_LOBE_MIRROR)
    {
        return prefilter_mirror(&job, o->threads);
    }
    if (o->method == CM_PREFILTER_ALL)
    {
        return cm_environment_whole(environment, alpha_squared, o->level,
                                    o->subdivision != 0 ? o->subdivision : 1, mapping, o->threads,
                                    to);
    }
    if (o->method == CM_PREFILTER_CELLS ||
        (o->method == CM_PREFILTER_AUTO &&
         cm_cells_suffice(environment, alpha_squared, coarseness_of(o))))
    {
        return cm_environment_cells(environment, alpha_squared, coarseness_of(o), mapping,
                                    o->threads, to);
    }
    return prefilter_lobe(&job, o, alpha_squared);
}

cm_status cm_environment_irradiance(const cm_environment *environment, const cm_mapping *mapping,
                                    unsigned threads, const cm_image to[6])
{
    if (environment == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    const cm_status status = cm_faces_check(mapping, to);
    if (status != CM_OK)
    {
        return status;
    }
    if (to[0].channels != environment->channels)
    {
        return CM_ERROR_RANGE;
    }
    return cm_environment_whole(environment, -1.0, 0, 1, mapping, threads, to);
}
