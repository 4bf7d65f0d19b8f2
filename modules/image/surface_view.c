/* SPDX-License-Identifier: MIT
 *
 * What a camera without distortion sees: the tangent plane of the sphere, through a window. Before the turn by lon, lat
 * and roll the camera looks along x, with z upwards, and y, to which longitudes grow, to the right.
 */
#include "surface_kinds.h"

#include <cubemap/number.h>

#include <float.h>
#include <math.h>

#define PI 3.14159265358979323846

/* What number keeps. */
enum
{
    LEFT,   /* of the window, in the tangent plane */
    TOP,    /* z there */
    SCALE,  /* of a pixel */
    MATRIX, /* nine numbers: camera's axes in the surface's by rows */
};

/* The parameters, in degrees but for the last three. */
enum
{
    FOV,
    VFOV,
    FOCAL,
    LON,
    LAT,
    ROLL,
    SHIFT_X,
    SHIFT_Y,
    PARAMETERS
};

static const cm_surface_parameter parameters[PARAMETERS] = {
    {"fov", 1e-6, 179.999999},  {"vfov", 1e-6, 179.999999}, {"focal", 1e-3, 1e9},
    {"lon", -DBL_MAX, DBL_MAX}, {"lat", -90.0, 90.0},       {"roll", -DBL_MAX, DBL_MAX},
    {"shift-x", -1e3, 1e3},     {"shift-y", -1e3, 1e3}};

/* The width of the film to which 35 mm equivalents refer, in mm (ISO 1007: 36 x 24). */
#define FILM_WIDTH 36.0

static void directions(const cm_surface *surface, unsigned plane, size_t n, const double *column,
                       const double *row, double *x, double *y, double *z)
{
    const double *number = surface->number;
    const double *m = number + MATRIX;
    (void)plane;
    for (size_t i = 0; i < n; i++)
    {
        const double right = number[LEFT] + column[i] * number[SCALE];
        const double up = number[TOP] - row[i] * number[SCALE];
        const double length = sqrt(1.0 + right * right + up * up);
        x[i] = (m[0] + right * m[3] + up * m[6]) / length;
        y[i] = (m[1] + right * m[4] + up * m[7]) / length;
        z[i] = (m[2] + right * m[5] + up * m[8]) / length;
    }
}

static void positions(const cm_surface *surface, size_t n, const double *x, const double *y,
                      const double *z, uint8_t *plane, double *column, double *row)
{
    const double *number = surface->number;
    const double *m = number + MATRIX;
    const double slack = 1e-9;
    for (size_t i = 0; i < n; i++)
    {
        /* of any length, without overflow */
        const double scale = fmax(fmax(fabs(x[i]), fabs(y[i])), fabs(z[i]));
        const double d[3] = {x[i] / scale, y[i] / scale, z[i] / scale};
        const double ahead = m[0] * d[0] + m[1] * d[1] + m[2] * d[2];
        const double right = (m[3] * d[0] + m[4] * d[1] + m[5] * d[2]) / ahead;
        const double up = (m[6] * d[0] + m[7] * d[1] + m[8] * d[2]) / ahead;
        const double at = (right - number[LEFT]) / number[SCALE];
        const double down = (number[TOP] - up) / number[SCALE];
        const int inside = ahead > 0.0 && at >= -slack && at <= surface->width + slack &&
                           down >= -slack && down <= surface->height + slack;
        plane[i] = inside ? 0 : CM_NO_FACE;
        column[i] = inside ? fmin(fmax(at, 0.0), surface->width) : (double)NAN;
        row[i] = inside ? fmin(fmax(down, 0.0), surface->height) : (double)NAN;
    }
}

static const cm_surface_methods methods = {
    .directions = directions, .positions = positions, .can_go_beyond = 1};

/* Half the width of the unshifted window, at distance 1. */
static double half_width(const cm_surface *surface, const double *value)
{
    if (isfinite(value[FOCAL]))
    {
        return 0.5 * FILM_WIDTH / value[FOCAL];
    }
    return isfinite(value[VFOV])
               ? tan(value[VFOV] * (PI / 360.0)) * surface->width / surface->height
               : tan(value[FOV] * (PI / 360.0));
}

static void take_window(cm_surface *surface, const double *value)
{
    double *number = surface->number;
    cm_rotation turn;
    const double half = half_width(surface, value);
    number[SCALE] = 2.0 * half / surface->width;
    number[LEFT] = (value[SHIFT_X] - 1.0) * half;
    number[TOP] = (value[SHIFT_Y] + 1.0) * (0.5 * number[SCALE] * surface->height);
    cm_rotation_from_angles(value[LON], value[LAT], value[ROLL], &turn);
    for (int i = 0; i < 9; i++)
    {
        number[MATRIX + i] = turn.row[i / 3][i % 3];
    }
}

static cm_status say(cm_surface *surface, const double *value)
{
    char stop = ':';
    cm_status status = cm_surface_say(surface, "view");
    for (int i = 0; i < PARAMETERS && status == CM_OK; i++)
    {
        if (isfinite(value[i]) && (i <= FOCAL || value[i] != 0.0))
        {
            char number[CM_NUMBER_SIZE];
            cm_number_write_shortest(value[i], number);
            status = cm_surface_say(surface, "%c%s=%s", stop, parameters[i].name, number);
            stop = ',';
        }
    }
    return status == CM_OK ? cm_surface_say_size(surface) : status;
}

cm_status cm_surface_make_view(cm_surface *surface, const cm_surface_wish *wish)
{
    const double none = (double)NAN;
    double value[PARAMETERS] = {none, none, none, 0.0, 0.0, 0.0, 0.0, 0.0};
    cm_status status = cm_surface_parameters(wish, parameters, PARAMETERS, value);
    if (status != CM_OK)
    {
        return status;
    }
    const int given = isfinite(value[FOV]) + isfinite(value[VFOV]) + isfinite(value[FOCAL]);
    if (given > 1)
    {
        return cm_complain(wish->complaint, CM_ERROR_PARAMETER,
                           "one of fov, vfov and focal says how wide a view is, not %d of them",
                           given);
    }
    value[FOV] = given == 0 ? 90.0 : value[FOV];
    status = cm_surface_free_size(surface, wish, 4.0 / 3.0);
    if (status == CM_OK && surface->width > 0)
    {
        take_window(surface, value);
    }
    surface->methods = &methods;
    return status == CM_OK ? say(surface, value) : status;
}
