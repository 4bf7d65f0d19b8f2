/* SPDX-License-Identifier: MIT
 *
 * Rotations of the base cube.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "libcubemap/mapping/message.h"
#include "libcubemap/mapping/angle.h"

#include <math.h>
#include <string.h>

#define DEGREE 0.017453292519943295769

/* In [-180, 180], and 180 rather than -180 where y is a zero; exact on the axes. */
static double atan2_degrees(double y, double x)
{
    return atan2(y + 0.0, x) / DEGREE;
}

cm_status cm_rotation_from_angles(double lon, double lat, double roll, cm_rotation *rotation)
{
    if (rotation == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!isfinite(lon) || !(fabs(lat) <= 90.0) || !isfinite(roll))
    {
        return CM_ERROR_ORIENTATION;
    }
    double sine_lon, cosine_lon, sine_lat, cosine_lat, sine_roll, cosine_roll;
    cm_sine_cosine_degrees(lon, &sine_lon, &cosine_lon);
    cm_sine_cosine_degrees(lat, &sine_lat, &cosine_lat);
    cm_sine_cosine_degrees(roll, &sine_roll, &cosine_roll);
    const double front[3] = {cosine_lat * cosine_lon, cosine_lat * sine_lon, sine_lat};
    const double east[3] = {-sine_lon, cosine_lon, 0.0};
    const double north[3] = {-sine_lat * cosine_lon, -sine_lat * sine_lon, cosine_lat};
    for (int i = 0; i < 3; i++)
    {
        rotation->row[0][i] = front[i] + 0.0;
        rotation->row[1][i] = cosine_roll * east[i] + sine_roll * north[i] + 0.0;
        rotation->row[2][i] = cosine_roll * north[i] - sine_roll * east[i] + 0.0;
    }
    return CM_OK;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

cm_status cm_rotation_check(const cm_rotation *rotation)
{
    if (rotation == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    const double(*row)[3] = rotation->row;
    for (int i = 0; i < 3; i++)
    {
        for (int j = 0; j <= i; j++)
        {
            if (!(fabs(dot(row[i], row[j]) - (i == j ? 1.0 : 0.0)) <= 1e-12))
            {
                return CM_ERROR_ORIENTATION;
            }
        }
    }
    const double third[3] = {row[0][1] * row[1][2] - row[0][2] * row[1][1],
                             row[0][2] * row[1][0] - row[0][0] * row[1][2],
                             row[0][0] * row[1][1] - row[0][1] * row[1][0]};
    return dot(third, row[2]) > 0.0 ? CM_OK : CM_ERROR_ORIENTATION;
}

cm_status cm_rotation_angles(const cm_rotation *rotation, double *lon, double *lat, double *roll)
{
    if (rotation == NULL || lon == NULL || lat == NULL || roll == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = cm_rotation_check(rotation);
    if (status != CM_OK)
    {
        return status;
    }
    const double *front = rotation->row[0];
    double sine_lon, cosine_lon;
    *lon = front[0] == 0.0 && front[1] == 0.0 ? 0.0 : atan2_degrees(front[1], front[0]);
    *lat = atan2_degrees(front[2], hypot(front[0], front[1]));
    /* Against east in that longitude, and not against the north pole, so that beside the poles, where neither
     * longitude nor roll is known well, their sum or difference is. */
    cm_sine_cosine_degrees(*lon, &sine_lon, &cosine_lon);
    const double east[3] = {-sine_lon, cosine_lon, 0.0};
    *roll = atan2_degrees(-dot(rotation->row[2], east), dot(rotation->row[1], east));
    return CM_OK;
}

void cm_rotate(const cm_rotation *rotation, const double from[3], double to[3])
{
    const double x = from[0];
    const double y = from[1];
    const double z = from[2];
    for (int i = 0; i < 3; i++)
    {
        const double *row = rotation->row[i];
        to[i] = row[0] * x + row[1] * y + row[2] * z;
    }
}

void cm_rotate_back(const cm_rotation *rotation, const double from[3], double to[3])
{
    const double x = from[0];
    const double y = from[1];
    const double z = from[2];
    for (int i = 0; i < 3; i++)
    {
        to[i] = rotation->row[0][i] * x + rotation->row[1][i] * y + rotation->row[2][i] * z;
    }
}

/* ---- Texts ---- */

/* Two or three numbers apart by commas; returns how many there are, 0 if one is none or there are more. */
static int parse_angles(const char *text, double angles[3])
{
    for (int count = 0; count < 3;)
    {
        size_t length = strcspn(text, ",");
        if (!cm_number_parse(text, length, &angles[count++]))
        {
            return 0;
        }
        if (text[length] == '\0')
        {
            return count;
        }
        text += length + 1;
    }
    return 0;
}

cm_status cm_rotation_parse(const char *text, cm_rotation *rotation, char *message,
                            size_t message_size)
{
    if (text == NULL || rotation == NULL)
    {
        return cm_fail(CM_ERROR_ARGUMENT, message, message_size,
                       text == NULL ? "no orientation is given" : "no place for a rotation");
    }
    const cm_orientation *named = cm_orientation_find(text);
    if (named != NULL)
    {
        return cm_rotation_from_angles(named->lon, named->lat, named->roll, rotation);
    }
    double angles[3] = {0.0, 0.0, 0.0};
    if (strchr(text, ',') == NULL)
    {
        return cm_fail(CM_ERROR_ORIENTATION, message, message_size,
                       "no orientation is called '%.60s'; it is LON,LAT[,ROLL] in degrees, or the "
                       "name of one",
                       text);
    }
    if (parse_angles(text, angles) < 2)
    {
        return cm_fail(CM_ERROR_ORIENTATION, message, message_size,
                       "'%.60s' is not LON,LAT[,ROLL] in degrees, as in -20.5,10,30", text);
    }
    if (cm_rotation_from_angles(angles[0], angles[1], angles[2], rotation) != CM_OK)
    {
        return cm_fail(CM_ERROR_ORIENTATION, message, message_size,
                       "'%.60s': LAT must be in [-90, 90], and LON and ROLL finite", text);
    }
    return CM_OK;
}
