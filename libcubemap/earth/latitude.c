/* SPDX-License-Identifier: MIT
 *
 * Conversions between latitudes: which way one takes, and the public functions, which give any number of
 * points to the loops of the instruction set (latitude_loops.inc), or one by one to the closed forms.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "libcubemap/mapping/set_choice.h"
#include "libcubemap/mapping/catalogue_words.h"
#include "latitude_shape.h"
#include "libcubemap/mapping/exception_flags.h"

#include <stdlib.h>
#include <string.h>

#include "latitude_series.h"

struct cm_latitude_conversion
{
    cm_latitude from;
    cm_latitude to;
    int order;
    double error;
    int exact; /* by closed forms, one by one; else in vectors: */
    cm_latitude_shape shape;
    cm_latitude_way way;
    cm_latitude_constants_f64 constants;
    const cm_batch_set *set;
};

static const double pole = 1.5707963267948966;

/* ---- Names ---- */

static const char *const names[CM_LATITUDE_COUNT] = {"geographic",
                                                     "geocentric",
                                                     "parametric",
                                                     "authalic",
                                                     "conformal",
                                                     "rectifying",
                                                     "authalic-approximation"};

const char *cm_latitude_name(cm_latitude latitude)
{
    return (unsigned)latitude < CM_LATITUDE_COUNT ? names[latitude] : NULL;
}

cm_status cm_latitude_find(const char *name, cm_latitude *latitude)
{
    if (name == NULL || latitude == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    for (int i = 0; i < CM_LATITUDE_COUNT; i++)
    {
        if (cm_word_equal(name, strlen(name), names[i], strlen(names[i])))
        {
            *latitude = (cm_latitude)i;
            return CM_OK;
        }
    }
    return CM_ERROR_LATITUDE;
}

/* ---- The way from one to another ---- */

/* The tangent is that of geographic latitude times (1 - f) to so many thirds; those that have none are in the table of
 * series. */
static const int thirds_of_axes[CM_LATITUDE_COUNT] = {[CM_LATITUDE_GEOGRAPHIC] = 0,
                                                      [CM_LATITUDE_GEOCENTRIC] = 6,
                                                      [CM_LATITUDE_PARAMETRIC] = 3,
                                                      [CM_LATITUDE_AUTHALIC_APPROXIMATION] = 4};

/* To the power of so many thirds. What a third lacks as a double counts where the base is far from 1. */
static double power_of_thirds(double base, int thirds)
{
    double power = thirds / 3.0;
    double lacking = fma(-3.0, power, thirds) / 3.0;
    double near = pow(base, power);
    return near + near * (lacking * log(base));
}

static void choose_tangents(cm_latitude_conversion *made, double ratio)
{
    made->constants.ratio = ratio;
    made->way = fabs(ratio - 1.0) <= 0.25 ? CM_LATITUDE_TANGENT_NEAR : CM_LATITUDE_TANGENT_FAR;
}

/* C_1, C_2, ... for a flattening, and a bound on what their series in n leave off: each goes on with terms that
 * fall like 4 n and faster. */
static double evaluate_series(const double *row, double f, double c[LATITUDE_SERIES_ORDER])
{
    double n = f / (2.0 - f);
    double power = 1.0;
    double last = 0.0;
    for (int k = 1; k <= LATITUDE_SERIES_ORDER; k++)
    {
        int count = LATITUDE_SERIES_ORDER - k + 1;
        double sum = 0.0;
        for (int i = count; i-- > 0;)
        {
            sum = sum * n + row[i];
        }
        power *= n;
        c[k - 1] = power * sum;
        last += fabs(row[count - 1]);
        row += count;
    }
    return last * fabs(power) * 4.0 * fabs(n) / (1.0 - 4.0 * fabs(n));
}

/* sum C_k sin 2k phi / sin 2 phi, which is sum C_k U_(k-1)(x), to powers of x = cos 2 phi. */
static void powers_from_sines(const double *c, int terms, double p[LATITUDE_SERIES_ORDER])
{
    double before[LATITUDE_SERIES_ORDER] = {0.0};
    double now[LATITUDE_SERIES_ORDER] = {1.0};
    memset(p, 0, LATITUDE_SERIES_ORDER * sizeof *p);
    for (int k = 0; k < terms; k++)
    {
        double next[LATITUDE_SERIES_ORDER] = {0.0};
        for (int i = 0; i <= k; i++)
        {
            p[i] += c[k] * now[i];
        }
        for (int i = 0; i < LATITUDE_SERIES_ORDER; i++)
        {
            next[i] = (i > 0 ? 2.0 * now[i - 1] : 0.0) - before[i];
        }
        memcpy(before, now, sizeof before);
        memcpy(now, next, sizeof now);
    }
}

/* With a tolerance, what is cut off is to be less; without one, it is to be less than half the rounding unit of
 * the latitude, also beside the equator and the poles, where sin 2k phi is 2k times the distance. */
static void choose_series(cm_latitude_conversion *made, const double *row, double f,
                          double tolerance)
{
    const double full = 0x1p-54;
    double c[LATITUDE_SERIES_ORDER];
    double p[LATITUDE_SERIES_ORDER];
    double error = evaluate_series(row, f, c);
    double relative = 0.0;
    int terms = LATITUDE_SERIES_ORDER;
    while (terms > 1)
    {
        double size = fabs(c[terms - 1]);
        if (relative + 2.0 * terms * size > full && error + size > tolerance)
        {
            break;
        }
        error += size;
        relative += 2.0 * terms * size;
        terms--;
    }
    made->order = terms;
    made->error = error;
    made->way = terms <= 3   ? CM_LATITUDE_SERIES_3
                : terms <= 6 ? CM_LATITUDE_SERIES_6
                             : CM_LATITUDE_SERIES_12;
    powers_from_sines(c, terms, p);
    made->constants = (cm_latitude_constants_f64){.p0 = p[0],
                                                  .p1 = p[1],
                                                  .p2 = p[2],
                                                  .p3 = p[3],
                                                  .p4 = p[4],
                                                  .p5 = p[5],
                                                  .p6 = p[6],
                                                  .p7 = p[7],
                                                  .p8 = p[8],
                                                  .p9 = p[9],
                                                  .p10 = p[10],
                                                  .p11 = p[11]};
}

static void choose_way(cm_latitude_conversion *made, double f, const cm_latitude_options *options)
{
    int row = latitude_series_of[made->from][made->to];
    if (made->from == made->to || f == 0.0)
    {
        choose_tangents(made, 1.0);
    }
    else if (row < 0)
    {
        choose_tangents(
            made, power_of_thirds(1.0 - f, thirds_of_axes[made->to] - thirds_of_axes[made->from]));
    }
    else if ((options != NULL && options->exact) || !(fabs(f) <= CM_LATITUDE_SERIES_FLATTENING))
    {
        made->exact = 1;
        cm_latitude_shape_make(f, &made->shape);
    }
    else
    {
        choose_series(made, latitude_series[row], f, options == NULL ? 0.0 : options->tolerance);
    }
}

static int are_options(const cm_latitude_options *options)
{
    return options == NULL || (options->size == sizeof *options && options->tolerance >= 0.0 &&
                               isfinite(options->tolerance));
}

cm_status cm_latitude_conversion_create(const cm_ellipsoid *ellipsoid, cm_latitude from,
                                        cm_latitude to, const cm_latitude_options *options,
                                        cm_latitude_conversion **conversion)
{
    cm_status status = cm_ellipsoid_check(ellipsoid);
    if (conversion == NULL || !are_options(options) || status == CM_ERROR_ARGUMENT)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (status != CM_OK)
    {
        return status;
    }
    if (cm_latitude_name(from) == NULL || cm_latitude_name(to) == NULL)
    {
        return CM_ERROR_LATITUDE;
    }
    cm_latitude_conversion made = {.from = from, .to = to};
    made.set = cm_batch_set_find(options == NULL ? NULL : options->instructions);
    if (made.set == NULL)
    {
        return CM_ERROR_INSTRUCTIONS;
    }
    choose_way(&made, ellipsoid->f, options);
    cm_latitude_conversion *kept = malloc(sizeof *kept);
    if (kept == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    *kept = made;
    *conversion = kept;
    return CM_OK;
}

void cm_latitude_conversion_destroy(cm_latitude_conversion *conversion)
{
    free(conversion);
}

int cm_latitude_conversion_order(const cm_latitude_conversion *conversion)
{
    return conversion->order;
}

double cm_latitude_conversion_error(const cm_latitude_conversion *conversion)
{
    return conversion->error;
}

cm_status cm_latitude_conversion_constants(const cm_latitude_conversion *conversion,
                                           double constants[CM_LATITUDE_CONSTANTS], int *terms)
{
    static const int terms_of[CM_LATITUDE_WAYS] = {
        [CM_LATITUDE_SERIES_3] = 3, [CM_LATITUDE_SERIES_6] = 6, [CM_LATITUDE_SERIES_12] = 12};
    if (conversion == NULL || constants == NULL || terms == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (conversion->exact)
    {
        return CM_ERROR_UNSUPPORTED;
    }
    const cm_latitude_constants_f64 *k = &conversion->constants;
    const double numbers[CM_LATITUDE_CONSTANTS] = {k->p0,  k->p1,  k->p2,   k->p3, k->p4,
                                                   k->p5,  k->p6,  k->p7,   k->p8, k->p9,
                                                   k->p10, k->p11, k->ratio};
    memcpy(constants, numbers, sizeof numbers);
    *terms = terms_of[conversion->way];
    return CM_OK;
}

/* ---- One by one ---- */

static double exact_angle(const cm_latitude_conversion *conversion, double latitude)
{
    double size = fabs(latitude);
    if (!(size <= pole + 1e-9))
    {
        return (double)NAN;
    }
    if (size >= pole || size == 0.0)
    {
        return copysign(fmin(size, pole), latitude);
    }
    double sine = sin(size);
    double cosine = cos(size);
    double ratio =
        cm_latitude_ratio(&conversion->shape, conversion->from, conversion->to, sine, cosine);
    double other =
        fabs(ratio - 1.0) <= 0.25
            ? size + atan((ratio - 1.0) * sine * cosine / (cosine * cosine + ratio * (sine * sine)))
            : atan2(ratio * sine, cosine);
    return copysign(other, latitude);
}

static void exact_direction(const cm_latitude_conversion *conversion, double x, double y, double z,
                            double to[3])
{
    double magnitude = cm_magnitude_f64(x, y, z);
    if (!isfinite(x) || !isfinite(y) || !isfinite(z) || !(magnitude > 0.0))
    {
        to[0] = to[1] = to[2] = (double)NAN;
        return;
    }
    /* as in cm_latitude_length_of, by hypot, because a ratio may be 1e68 */
    double scale = cm_azimuthal_scale_f64(magnitude);
    double before = scale < 1.0 ? 0x1p-350 : scale;
    double sine = fabs(z * scale);
    double cosine = hypot(x * scale, y * scale);
    double ratio =
        cm_latitude_ratio(&conversion->shape, conversion->from, conversion->to, sine, cosine);
    double after = (scale < 1.0 ? 0x1p-350 : 1.0) / hypot(cosine, ratio * sine);
    to[0] = (x * before) * after;
    to[1] = (y * before) * after;
    to[2] = (z * before) * (ratio * after);
}

/* ---- Arrays: whole vectors, and what is left over in one of its own ---- */

typedef double rest[CM_LANES_MAX];
#define REST _Alignas(sizeof(rest)) rest

void cm_latitude_convert_array(const cm_latitude_conversion *conversion, size_t n,
                               const double *from, double *to)
{
    const cm_exceptions held = cm_exceptions_hold();
    if (conversion->exact)
    {
        for (size_t i = 0; i < n; i++)
        {
            to[i] = exact_angle(conversion, from[i]);
        }
        cm_exceptions_restore(held);
        return;
    }
    const cm_batch_set *set = conversion->set;
    size_t left = n % set->lanes_f64;
    size_t whole = n - left;
    if (whole > 0)
    {
        set->latitudes->angles[conversion->way](&conversion->constants, whole, from, to);
    }
    if (left > 0)
    {
        REST a;
        set->rest_f64(a, from + whole, left);
        set->latitudes->angles[conversion->way](&conversion->constants, set->lanes_f64, a, a);
        memcpy(to + whole, a, left * sizeof *to);
    }
    cm_exceptions_restore(held);
}

void cm_latitude_convert_direction_array(const cm_latitude_conversion *conversion, size_t n,
                                         const double *x, const double *y, const double *z,
                                         double *to_x, double *to_y, double *to_z)
{
    const cm_exceptions held = cm_exceptions_hold();
    if (conversion->exact)
    {
        for (size_t i = 0; i < n; i++)
        {
            double to[3];
            exact_direction(conversion, x[i], y[i], z[i], to);
            to_x[i] = to[0];
            to_y[i] = to[1];
            to_z[i] = to[2];
        }
        cm_exceptions_restore(held);
        return;
    }
    const cm_batch_set *set = conversion->set;
    size_t left = n % set->lanes_f64;
    size_t whole = n - left;
    if (whole > 0)
    {
        set->latitudes->directions[conversion->way](&conversion->constants, whole, x, y, z, to_x,
                                                    to_y, to_z);
    }
    if (left > 0)
    {
        REST a, b, c;
        set->rest_f64(a, x + whole, left);
        set->rest_f64(b, y + whole, left);
        set->rest_f64(c, z + whole, left);
        set->latitudes->directions[conversion->way](&conversion->constants, set->lanes_f64, a, b, c,
                                                    a, b, c);
        memcpy(to_x + whole, a, left * sizeof *to_x);
        memcpy(to_y + whole, b, left * sizeof *to_y);
        memcpy(to_z + whole, c, left * sizeof *to_z);
    }
    cm_exceptions_restore(held);
}

double cm_latitude_convert(const cm_latitude_conversion *conversion, double latitude)
{
    double to;
    cm_latitude_convert_array(conversion, 1, &latitude, &to);
    return to;
}

void cm_latitude_convert_direction(const cm_latitude_conversion *conversion, const double from[3],
                                   double to[3])
{
    cm_latitude_convert_direction_array(conversion, 1, &from[0], &from[1], &from[2], &to[0], &to[1],
                                        &to[2]);
}
