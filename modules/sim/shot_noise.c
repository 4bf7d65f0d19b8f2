/* SPDX-License-Identifier: MIT */
#include "shot_noise.h"

#include <math.h>

enum
{
    MOST_TERMS = 32
};

#define MOST_VARIANCE 1e12 /* of transformed charges: noise of any charge stays a float */

/* Poisson's own, by research/papers/freeman-tukey-variance. */
static const double poisson_variance[] = {
    4.771516939621131,     -13.83473487118757,     15.004816739478704,  -7.991493010917511,
    2.471214223934399,     -0.4748640086099578,    0.05768131390261616, -0.004315778568995325,
    0.0001817511440052987, -3.2987968227990923e-06};

/* A polynomial of transformed charges, and where it holds. */
typedef struct shot_model
{
    size_t terms;
    const double *variance;
    double least, most;
} shot_model;

static shot_model model_of(const cm_tof_sensor *sensor)
{
    const shot_model poisson = {sizeof poisson_variance / sizeof *poisson_variance,
                                poisson_variance, 1.0, 10.0};
    const shot_model own = {sensor->shot_terms, sensor->shot_variance, sensor->shot_least,
                            sensor->shot_most};
    return sensor->shot_terms == 0 ? poisson : own;
}

cm_status shot_noise_check(const cm_tof_sensor *sensor)
{
    const size_t terms = sensor->shot_terms;
    double size = 0.0;
    if (terms == 0)
    {
        return CM_OK;
    }
    if (sensor->shot_variance == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (terms > MOST_TERMS || !(sensor->shot_least >= 1.0) ||
        !(sensor->shot_least < sensor->shot_most) || !isfinite(sensor->shot_most))
    {
        return CM_ERROR_RANGE;
    }
    for (size_t i = terms; i-- > 0;)
    {
        size = size * sensor->shot_most + fabs(sensor->shot_variance[i]);
    }
    return size <= MOST_VARIANCE ? CM_OK : CM_ERROR_RANGE;
}

/* Freeman and Tukey 1950. */
static double transformed(double charge)
{
    return sqrt(charge) + sqrt(charge + 1.0);
}

/* What has that transform; no electrons have 1. */
static double charge_of(double y)
{
    const double root = y > 1.0 ? 0.5 * (y - 1.0 / y) : 0.0;
    return root * root;
}

/* Bulczak, Lambers and Kolb 2018, section 3.4. Beyond what was measured the variance stays. */
static double variance_at(const shot_model *model, double y)
{
    const double inside = fmin(fmax(y, model->least), model->most);
    double variance = 0.0;
    for (size_t i = model->terms; i-- > 0;)
    {
        variance = variance * inside + model->variance[i];
    }
    return fmax(variance, 0.0);
}

void shot_noise_add(const cm_tof_sensor *sensor, size_t n, const double *normal, double *charge)
{
    const shot_model model = model_of(sensor);
    for (size_t i = 0; i < n; i++)
    {
        const double mean = transformed(charge[i]);
        charge[i] = charge_of(mean + sqrt(variance_at(&model, mean)) * normal[i]);
    }
}

double shot_noise_variance(const cm_tof_sensor *sensor, double charge)
{
    const shot_model model = model_of(sensor);
    const double y = transformed(charge);
    const double variance = variance_at(&model, y);
    const double slope = 0.5 * (y - 1.0 / (y * y * y));
    const double bend = 0.5 + 1.5 / (y * y * y * y);
    return slope * slope * variance + 0.5 * bend * bend * variance * variance;
}
