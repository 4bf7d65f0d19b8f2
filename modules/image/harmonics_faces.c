/* SPDX-License-Identifier: MIT
 *
 * Coefficients as pictures of faces.
 */
#include <cubemap/environment.h>

#include "environment_pixels.h"
#include "image_jobs.h"

typedef struct face_job
{
    const cm_mapping *mapping;
    const cm_image *to;
    const double *coefficients;
    uint32_t degree;
    uint32_t channels;
} face_job;

/* Rows of all faces are counted through. */
static void evaluate_row(size_t index, void *user)
{
    enum
    {
        SOME = 64
    };
    const face_job *job = user;
    const uint32_t n = job->to[0].width;
    const uint8_t face = (uint8_t)(index / n);
    const uint32_t row = (uint32_t)(index % n);
    uint8_t faces[SOME];
    double x[SOME];
    double y[SOME];
    double z[SOME];
    double value[SOME * CM_ENVIRONMENT_CHANNELS_MAX];
    for (uint32_t first = 0; first < n; first += SOME)
    {
        const uint32_t some = n - first < SOME ? n - first : SOME;
        for (uint32_t i = 0; i < some; i++)
        {
            faces[i] = face;
            x[i] = (2.0 * (first + i) + 1.0) / n - 1.0;
            y[i] = (2.0 * row + 1.0) / n - 1.0;
        }
        cm_inverse_array(job->mapping, some, faces, x, y, x, y, z);
        cm_harmonics_evaluate(job->degree, job->channels, job->coefficients, some, x, y, z, value);
        for (uint32_t i = 0; i < some; i++)
        {
            float pixel[CM_ENVIRONMENT_CHANNELS_MAX];
            for (uint32_t c = 0; c < job->channels; c++)
            {
                pixel[c] = (float)value[i * job->channels + c];
            }
            cm_pixel_store(&job->to[face], cm_face_row(job->mapping, n, row), first + i, pixel);
        }
    }
}

cm_status cm_harmonics_faces(uint32_t degree, uint32_t channels, const double *coefficients,
                             const cm_mapping *mapping, unsigned threads, const cm_image to[6])
{
    if (coefficients == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    const cm_status status = cm_faces_check(mapping, to);
    if (status != CM_OK)
    {
        return status;
    }
    if (degree > CM_HARMONICS_DEGREE_MAX || channels != to[0].channels)
    {
        return CM_ERROR_RANGE;
    }
    face_job job = {mapping, to, coefficients, degree, channels};
    cm_run_pieces(threads, 6 * (size_t)to[0].width, evaluate_row, &job);
    return CM_OK;
}
