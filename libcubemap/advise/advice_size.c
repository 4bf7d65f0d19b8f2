/* SPDX-License-Identifier: MIT
 *
 * How much is needed: pixels along a face's edge, a precision, terms of a latitude's series; and what the next
 * cheaper choice would lose.
 */
#include <math.h>

#include "advice_object.h"

#define PI 3.14159265358979324

/* ---- Pixels ---- */

enum
{
    GRID = 65,
    HALVINGS = 40,
    SAMPLES = 96 /* along a face's edge, for shares of the sphere */
};

static double clamp(double x)
{
    return fmin(fmax(x, -1.0), 1.0);
}

/* Where a map stands still there is no minor axis, but NaN. */
static double minor_at(const cm_mapping *mapping, int face, double u, double v)
{
    const double uv[2] = {clamp(u), clamp(v)};
    cm_distortion d;
    cm_inverse_distortion(mapping, (uint8_t)face, uv, &d);
    return isnan(d.minor) ? 0.0 : d.minor;
}

/* Downhill from a point, to the best of eight around it, or else by half the way. */
static double descend(const cm_mapping *mapping, int face, double u, double v, double least)
{
    double step = 1.0 / (GRID - 1);
    for (int halvings = 0; halvings < HALVINGS;)
    {
        int best = 4;
        for (int k = 0; k < 9; k++)
        {
            double value = minor_at(mapping, face, u + step * (k % 3 - 1), v + step * (k / 3 - 1));
            best = value < least ? k : best;
            least = fmin(value, least);
        }
        u = clamp(u + step * (best % 3 - 1));
        v = clamp(v + step * (best / 3 - 1));
        step = best == 4 ? step / 2.0 : step;
        halvings += best == 4;
    }
    return least;
}

static double least_minor(const cm_mapping *mapping)
{
    double least = (double)INFINITY;
    for (int face = 0; face < 6; face++)
    {
        double on_face = (double)INFINITY;
        int best = 0;
        for (int i = 0; i < GRID * GRID; i++)
        {
            double value = minor_at(mapping, face, 2.0 * (i % GRID) / (GRID - 1) - 1.0,
                                    2.0 * (i / GRID) / (GRID - 1) - 1.0);
            best = value < on_face ? i : best;
            on_face = fmin(on_face, value);
        }
        least = fmin(least, descend(mapping, face, 2.0 * (best % GRID) / (GRID - 1) - 1.0,
                                    2.0 * (best / GRID) / (GRID - 1) - 1.0, on_face));
    }
    return least;
}

/* The part of the sphere on which the minor axis is less. */
static double share_below(const cm_mapping *mapping, double minor)
{
    double all = 0.0;
    double below = 0.0;
    for (int i = 0; i < 6 * SAMPLES * SAMPLES; i++)
    {
        const double uv[2] = {(2.0 * (i % SAMPLES) + 1.0) / SAMPLES - 1.0,
                              (2.0 * (i / SAMPLES % SAMPLES) + 1.0) / SAMPLES - 1.0};
        cm_distortion d;
        cm_inverse_distortion(mapping, (uint8_t)(i / (SAMPLES * SAMPLES)), uv, &d);
        all += 1.0 / d.scale;
        below += d.minor < minor ? 1.0 / d.scale : 0.0;
    }
    return below / all;
}

/* The least whole number that is not less, but for rounding. */
static uint64_t whole_above(double number)
{
    return (uint64_t)fmax(1.0, ceil(number * (1.0 - CM_ADVICE_ROUNDING)));
}

cm_status cm_advise_size(const cm_mapping *mapping, double angle, cm_advice_size *size)
{
    if (mapping == NULL || size == NULL || size->size != sizeof *size ||
        !(angle > 1e-15 && angle <= PI * (1.0 + CM_ADVICE_ROUNDING)))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (cm_mapping_describe(mapping)->kind != CM_KIND_CUBE)
    {
        return CM_ERROR_UNSUPPORTED;
    }
    double minor = least_minor(mapping);
    if (minor == 0.0)
    {
        return CM_ERROR_UNSUPPORTED;
    }
    cm_advice_size made = {.size = sizeof made, .power = 1};
    made.pixels = whole_above(2.0 / (minor * angle));
    made.coarsest = 2.0 / (minor * (double)made.pixels);
    while (made.power < made.pixels)
    {
        made.power *= 2;
    }
    made.cheaper = made.power / 2;
    if (made.cheaper > 0)
    {
        made.cheaper_coarsest = 2.0 / (minor * (double)made.cheaper);
        made.cheaper_share = share_below(mapping, 2.0 / ((double)made.cheaper * angle));
    }
    made.mean_pixels = whole_above(sqrt(4.0 * PI / 6.0) / angle);
    *size = made;
    return CM_OK;
}

/* ---- Precision ---- */

cm_status cm_advise_precision(const cm_mapping *mapping, double metres,
                              cm_advice_precision *precision)
{
    if (mapping == NULL || precision == NULL || precision->size != sizeof *precision ||
        !(metres > 0.0))
    {
        return CM_ERROR_ARGUMENT;
    }
    double in_float = CM_ADVICE_EARTH * cm_advice_round_trip(mapping, CM_PRECISION_FLOAT);
    double in_double = CM_ADVICE_EARTH * cm_advice_round_trip(mapping, CM_PRECISION_DOUBLE);
    if (isnan(in_double))
    {
        return CM_ERROR_UNSUPPORTED;
    }
    if (in_double > metres)
    {
        return CM_ERROR_RANGE;
    }
    cm_advice_precision made = {.size = sizeof made};
    int is_enough = in_float <= metres;
    made.precision = is_enough ? CM_PRECISION_FLOAT : CM_PRECISION_DOUBLE;
    made.error = is_enough ? in_float : in_double;
    made.cheaper_error = is_enough ? 0.0 : in_float;
    *precision = made;
    return CM_OK;
}

/* ---- Terms ---- */

/* Terms and what they cut off for a tolerance. */
static cm_status terms_for(const cm_ellipsoid *ellipsoid, cm_latitude from, cm_latitude to,
                           double tolerance, int *terms, double *error)
{
    cm_latitude_conversion *conversion = NULL;
    const cm_latitude_options options = {.size = sizeof options, .tolerance = tolerance};
    cm_status status = cm_latitude_conversion_create(ellipsoid, from, to, &options, &conversion);
    if (status == CM_OK)
    {
        *terms = cm_latitude_conversion_order(conversion);
        *error = cm_latitude_conversion_error(conversion);
    }
    cm_latitude_conversion_destroy(conversion);
    return status;
}

cm_status cm_advise_terms(const cm_ellipsoid *ellipsoid, cm_latitude from, cm_latitude to,
                          double metres, cm_advice_terms *terms)
{
    if (terms == NULL || terms->size != sizeof *terms || !(metres >= 0.0) || isinf(metres))
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = cm_ellipsoid_check(ellipsoid);
    if (status != CM_OK)
    {
        return status;
    }
    /* the greatest radius of curvature of a meridian: at the poles if oblate, else at the equator */
    double flat = 1.0 - ellipsoid->f;
    double radius = ellipsoid->a * fmax(1.0 / flat, flat * flat);
    cm_advice_terms made = {.size = sizeof made, .tolerance = metres / radius};
    status = terms_for(ellipsoid, from, to, made.tolerance, &made.terms, &made.error);
    /* what the last term is cannot be asked for: the tolerance grows until it is left out */
    double wider = fmax(made.error, 0x1p-60);
    int fewer = made.terms;
    double more = 0.0;
    while (status == CM_OK && made.terms > 1 && fewer == made.terms)
    {
        wider *= 1.5;
        status = terms_for(ellipsoid, from, to, wider, &fewer, &more);
    }
    made.error *= radius;
    made.cheaper_terms = made.terms > 1 ? fewer : 0;
    made.cheaper_error = more * radius;
    if (status == CM_OK)
    {
        *terms = made;
    }
    return status;
}
