/* SPDX-License-Identifier: MIT
 *
 * Where in their triangles pixels lie: a point of the ray is a sum of the corners, whose weights are as the products of the
 * ray with the planes of the other two.
 */
#include "raster_object.h"

#include <math.h>

static double product(const double r[3], const double a[3], const double b[3])
{
    return r[0] * (a[1] * b[2] - a[2] * b[1]) + r[1] * (a[2] * b[0] - a[0] * b[2]) +
           r[2] * (a[0] * b[1] - a[1] * b[0]);
}

static double within(double weight)
{
    return weight < 0.0 ? 0.0 : weight > 1.0 ? 1.0 : weight;
}

cm_status cm_raster_weights(const cm_raster *raster, const cm_pose *pose,
                            const cm_triangles *triangles, float *second, float *third)
{
    const cm_status status = raster == NULL || second == NULL || third == NULL
                                 ? CM_ERROR_ARGUMENT
                                 : cm_raster_check_triangles(triangles);
    if (status != CM_OK)
    {
        return status;
    }
    for (size_t i = 0; i < raster->width * raster->height; i++)
    {
        const size_t row = i / raster->width;
        const size_t column = i % raster->width;
        const uint32_t id = cm_raster_id(raster->key[cm_raster_place(raster->stride, column, row)]);
        double corner[3][3];
        second[i] = third[i] = NAN;
        if (id == CM_RASTER_NOTHING || id < triangles->first_id ||
            id - triangles->first_id >= triangles->triangle_count ||
            !cm_raster_take_corners(pose, triangles, id - triangles->first_id, corner))
        {
            continue;
        }
        const cm_raster_rays rays = cm_raster_rays_at(raster, column, row);
        const double ray[3] = {rays.x[0], rays.y == NULL ? rays.y_all : rays.y[0],
                               rays.y == NULL ? 1.0 : rays.z[0]};
        const double a = product(ray, corner[1], corner[2]);
        const double b = product(ray, corner[2], corner[0]);
        const double c = product(ray, corner[0], corner[1]);
        second[i] = (float)within(b / (a + b + c));
        third[i] = (float)within(c / (a + b + c));
    }
    return CM_OK;
}
