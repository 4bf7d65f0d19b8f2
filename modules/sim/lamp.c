/* SPDX-License-Identifier: MIT */
#include "lamp.h"
#include "vector.h"

#include <math.h>
#include <stdlib.h>

#define LEAST_APERTURE 1e-6 /* cosines tell rays of thinner cones no more apart */
#define FARTHEST 1e100      /* nothing is lit from there, and squares of it are finite */

static int is_number(const double vector[3])
{
    return isfinite(vector[0]) && isfinite(vector[1]) && isfinite(vector[2]);
}

static int is_even(const cm_tof_light *light)
{
    return light->n < 2;
}

cm_status lamps_check(const cm_tof_light *light, size_t lights)
{
    if (light == NULL || lights == 0)
    {
        return CM_ERROR_ARGUMENT;
    }
    for (size_t i = 0; i < lights; i++)
    {
        const cm_tof_light *each = &light[i];
        if (each->size != sizeof *each || (each->n > 0 && each->intensity == NULL))
        {
            return CM_ERROR_ARGUMENT;
        }
        if (!is_number(each->position) || !is_number(each->direction) || !(each->power >= 0.0) ||
            !isfinite(each->power) || !(each->aperture >= LEAST_APERTURE) ||
            !(each->aperture <= 2.0 * PI * (1.0 + 1e-9)))
        {
            return CM_ERROR_RANGE;
        }
        for (size_t k = 0; k < each->n; k++)
        {
            if (!(each->intensity[k] >= 0.0f) || !isfinite(each->intensity[k]))
            {
                return CM_ERROR_RANGE;
            }
        }
    }
    return CM_OK;
}

static double step_of(const cm_tof_light *light)
{
    return 0.5 * light->aperture / (double)(light->n - 1);
}

/* sin x - x cos x, the integral of t sin t to x, whose terms are nearly the same where x is small. */
static double sine_moment(double x)
{
    const double square = x * x;
    return x > 0.1 ? sin(x) - x * cos(x)
                   : x * square *
                         (1.0 / 3.0 -
                          square * (1.0 / 30.0 - square * (1.0 / 840.0 - square / 45360.0)));
}

/* The integral over the cone of a table that is linear between its values: of each piece about its middle, which thin cones
 * need, whose cosines are 1. */
static double integral_of(const cm_tof_light *light)
{
    const double step = step_of(light), half = 0.5 * step;
    double sum = 0.0;
    for (size_t k = 0; k + 1 < light->n; k++)
    {
        const double middle = step * ((double)k + 0.5);
        const double first = (double)light->intensity[k], last = (double)light->intensity[k + 1];
        sum += (first + last) * sin(middle) * sin(half) +
               2.0 * (last - first) / step * cos(middle) * sine_moment(half);
    }
    return 2.0 * PI * sum;
}

double **lamps_tables(const cm_tof_light *light, size_t lights)
{
    double **table = calloc(lights, sizeof *table);
    for (size_t i = 0; table != NULL && i < lights; i++)
    {
        if (is_even(&light[i]))
        {
            continue;
        }
        table[i] = calloc(light[i].n, sizeof **table);
        if (table[i] == NULL)
        {
            lamps_free_tables(table, lights);
            return NULL;
        }
        const double sum = integral_of(&light[i]);
        for (size_t k = 0; k < light[i].n; k++)
        {
            table[i][k] = sum > 0.0 ? light[i].power * (double)light[i].intensity[k] / sum : 0.0;
        }
    }
    return table;
}

void lamps_free_tables(double **table, size_t lights)
{
    for (size_t i = 0; table != NULL && i < lights; i++)
    {
        free(table[i]);
    }
    free(table);
}

/* Of length 1, whatever length is given: squares of the greatest would be infinite. */
static void put_axis(const double direction[3], double axis[3])
{
    const double most = fmax(fabs(direction[0]), fmax(fabs(direction[1]), fabs(direction[2])));
    double square = 0.0;
    for (int k = 0; k < 3; k++)
    {
        axis[k] = most > 0.0 ? direction[k] / most : (double)(k == 2);
        square += axis[k] * axis[k];
    }
    for (int k = 0; k < 3; k++)
    {
        axis[k] /= sqrt(square);
    }
}

void lamps_place(const cm_tof_light *light, size_t lights, double *const *table,
                 const cm_pose *camera, tof_lamp *lamp)
{
    for (size_t i = 0; i < lights; i++)
    {
        double axis[3], place[3];
        put_axis(light[i].direction, axis);
        for (int k = 0; k < 3; k++)
        {
            place[k] = fmin(fmax(light[i].position[k], -FARTHEST), FARTHEST);
        }
        cm_pose_apply_back(camera, place, lamp[i].position);
        cm_rotate_back(&camera->rotation, axis, lamp[i].axis);
        /* beyond the rim by what rounding may take of a cosine, and all of it where it shines everywhere */
        const double rim = cos(0.5 * light[i].aperture);
        lamp[i].least_cosine = light[i].aperture >= 2.0 * PI * (1.0 - 1e-9) ? -2.0 : rim;
        /* 1 - cos, of small angles too */
        const double sine = sin(0.25 * light[i].aperture);
        lamp[i].part = sine * sine;
        const int is_dark = light[i].n == 1 && light[i].intensity[0] == 0.0f;
        lamp[i].intensity = is_dark ? 0.0 : light[i].power / (4.0 * PI * lamp[i].part);
        lamp[i].n = is_even(&light[i]) ? 0 : light[i].n;
        lamp[i].table = table[i];
        lamp[i].step = is_even(&light[i]) ? 0.0 : step_of(&light[i]);
    }
}

double tof_lamp_intensity(const tof_lamp *lamp, double cosine)
{
    if (!(cosine >= lamp->least_cosine))
    {
        return 0.0;
    }
    if (lamp->n == 0)
    {
        return lamp->intensity;
    }
    const double place = acos(fmin(fmax(cosine, -1.0), 1.0)) / lamp->step;
    const double floor_place = fmin(floor(place), (double)(lamp->n - 2));
    const size_t k = (size_t)floor_place;
    const double part = fmin(place - floor_place, 1.0);
    return lamp->table[k] + part * (lamp->table[k + 1] - lamp->table[k]);
}

int lamp_is_beside(const tof_lamp *lamp, const double camera[3])
{
    for (int k = 0; k < 3; k++)
    {
        if (lamp->position[k] != camera[k])
        {
            return 1;
        }
    }
    return 0;
}
