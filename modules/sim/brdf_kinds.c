/* SPDX-License-Identifier: MIT
 *
 * BRDFs of any kind, and Lambert's.
 */
#include "brdf_object.h"

#include <math.h>
#include <stdlib.h>

cm_brdf *brdf_make(const brdf_kind *kind)
{
    cm_brdf *brdf = calloc(1, sizeof *brdf);
    if (brdf != NULL)
    {
        brdf->kind = kind;
    }
    return brdf;
}

cm_status cm_brdf_create_lambert(cm_brdf **brdf)
{
    if (brdf == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    *brdf = brdf_make(NULL);
    return *brdf == NULL ? CM_ERROR_MEMORY : CM_OK;
}

void cm_brdf_destroy(cm_brdf *brdf)
{
    if (brdf != NULL)
    {
        brdf_table_destroy(brdf->table);
        free(brdf);
    }
}

int brdf_is_lambert(const cm_brdf *brdf)
{
    return brdf == NULL || brdf->kind == NULL;
}

static double in_range(double cosine)
{
    return fmin(1.0, fmax(-1.0, cosine));
}

/* 0 where one of them is not on the normal's side. */
static int find_angles(const double normal[3], const double in[3], const double out[3],
                       brdf_angles *at)
{
    at->in = fmin(1.0, dot(normal, in));
    at->out = fmin(1.0, dot(normal, out));
    at->between = in_range(dot(in, out));
    return at->in > 0.0 && at->out > 0.0;
}

double cm_brdf_value(const cm_brdf *brdf, const double normal[3], const double in[3],
                     const double out[3])
{
    brdf_angles at;
    if (!find_angles(normal, in, out, &at))
    {
        return 0.0;
    }
    return brdf_is_lambert(brdf) ? 1.0 / PI : brdf->kind->value(brdf, &at);
}

double cm_brdf_density(const cm_brdf *brdf, const double normal[3], const double in[3],
                       const double out[3])
{
    brdf_angles at;
    if (!find_angles(normal, in, out, &at))
    {
        return 0.0;
    }
    return brdf_is_lambert(brdf) ? at.in / PI : brdf->kind->density(brdf, &at);
}

double cm_brdf_albedo(const cm_brdf *brdf, double theta_in)
{
    if (!(theta_in >= 0.0 && theta_in <= 0.5 * PI))
    {
        return 0.0;
    }
    return brdf_is_lambert(brdf) ? 1.0 : brdf->kind->albedo(brdf, theta_in);
}

/* ---- Directions ---- */

double brdf_draw_cosine(const double u[2], double in[3])
{
    const double sine = sqrt(u[0]);
    const double azimuth = 2.0 * PI * u[1];
    in[0] = sine * cos(azimuth);
    in[1] = sine * sin(azimuth);
    in[2] = sqrt(1.0 - u[0]);
    return in[2];
}

/* x and y of axes whose z is the normal and whose x is on the other direction's side. */
static void find_axes(const double normal[3], const double out[3], double x[3], double y[3])
{
    const double cosine = dot(normal, out);
    double length = 0.0;
    for (int k = 0; k < 3; k++)
    {
        x[k] = out[k] - cosine * normal[k];
    }
    length = sqrt(dot(x, x));
    if (!(length > 1e-8))
    {
        find_across(normal, x);
        length = 1.0;
    }
    for (int k = 0; k < 3; k++)
    {
        x[k] /= length;
    }
    cross(normal, x, y);
}

double cm_brdf_sample_direction(const cm_brdf *brdf, const double normal[3], const double out[3],
                                const double u[3], double in[3], double *density)
{
    const double cosine_out = fmin(1.0, dot(normal, out));
    double local[3];
    double x[3];
    double y[3];
    *density = 0.0;
    if (!(cosine_out > 0.0))
    {
        in[0] = in[1] = in[2] = 0.0;
        return 0.0;
    }
    if (brdf_is_lambert(brdf))
    {
        brdf_draw_cosine(u, local);
    }
    else
    {
        brdf->kind->draw(brdf, cosine_out, u, local);
    }
    find_axes(normal, out, x, y);
    for (int k = 0; k < 3; k++)
    {
        in[k] = local[0] * x[k] + local[1] * y[k] + local[2] * normal[k];
    }
    const double scale = 1.0 / sqrt(dot(in, in));
    for (int k = 0; k < 3; k++)
    {
        in[k] *= scale;
    }
    brdf_angles at;
    if (!find_angles(normal, in, out, &at))
    {
        return 0.0;
    }
    if (brdf_is_lambert(brdf))
    {
        *density = at.in / PI;
        return 1.0;
    }
    *density = brdf->kind->density(brdf, &at);
    return *density > 0.0 ? brdf->kind->value(brdf, &at) * at.in / *density : 0.0;
}
