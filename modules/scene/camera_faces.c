/* SPDX-License-Identifier: MIT
 *
 * Omnidirectional cameras: the six faces of a mapping one under another, or its one face. Rows are those of image files,
 * as pictures of surfaces have them (modules/image/surface_faces.c).
 */
#include "camera_object.h"

#include <cubemap/distortion.h>

#define BLOCK 256

cm_status cm_camera_take_mapping(cm_camera *camera, const cm_mapping *mapping)
{
    const cm_kind kind = cm_mapping_describe(mapping)->kind;
    camera->faces = kind == CM_KIND_CUBE ? 6 : 1;
    const uint64_t height = (uint64_t)camera->faces * camera->options.width;
    if (kind == CM_KIND_DISC_SQUARE || camera->options.height != height)
    {
        return CM_ERROR_CAMERA;
    }
    camera->half = 0.5 * camera->options.width;
    camera->first_v = camera->faces == 6 ? cm_mapping_frame(mapping)->first_row_v : 1.0;
    camera->shift = 0.5 - camera->options.pixel_centre;
    /* what a mapping stands instead of */
    camera->options.fx = camera->options.fy = camera->options.cx = camera->options.cy = 0.0;
    for (int i = 0; i < 14; i++)
    {
        camera->options.distortion[i] = 0.0;
    }
    cm_mapping *copy = NULL;
    const cm_status status = cm_mapping_copy(mapping, &copy);
    camera->options.mapping = copy;
    return status;
}

/* Behind a face's last pixel the next face begins: a place at that edge is told to be just before it, by more than its row is
 * rounded. NaN stays. */
static inline double before_edge(double place, double last)
{
    return place > last ? last : place;
}

void cm_camera_project_faces(const cm_camera *camera, size_t n, const double *x, const double *y,
                             const double *z, double *column, double *row)
{
    const double half = camera->half;
    const double down = -half * camera->first_v;
    const double last = 2.0 * half * (1.0 - 0x1p-48);
    for (size_t done = 0; done < n; done += BLOCK)
    {
        uint8_t face[BLOCK];
        double u[BLOCK];
        double v[BLOCK];
        const size_t count = n - done < BLOCK ? n - done : BLOCK;
        cm_forward_array(camera->options.mapping, count, x + done, y + done, z + done, face, u, v);
        for (size_t i = 0; i < count; i++)
        {
            column[done + i] = before_edge(half + half * u[i], last) - camera->shift;
            row[done + i] =
                2.0 * half * face[i] + before_edge(half + down * v[i], last) - camera->shift;
        }
    }
}

/* The face, u and v of pixels; no face where there is no picture. */
static void faces_of(const cm_camera *camera, size_t count, const double *column, const double *row,
                     uint8_t *face, double *u, double *v)
{
    const double half = camera->half;
    const double width = 2.0 * half;
    for (size_t i = 0; i < count; i++)
    {
        const double right = column[i] + camera->shift;
        const double down = row[i] + camera->shift;
        const int inside =
            right >= 0.0 && right <= width && down >= 0.0 && down <= width * camera->faces;
        const double which = inside ? fmin(floor(down / width), camera->faces - 1.0) : 0.0;
        face[i] = inside ? (uint8_t)which : CM_NO_FACE;
        u[i] = (right - half) / half;
        v[i] = camera->first_v * ((half - (down - width * which)) / half);
    }
}

void cm_camera_ray_faces(const cm_camera *camera, size_t n, const double *column, const double *row,
                         double *x, double *y, double *z)
{
    for (size_t done = 0; done < n; done += BLOCK)
    {
        uint8_t face[BLOCK];
        double u[BLOCK];
        double v[BLOCK];
        const size_t count = n - done < BLOCK ? n - done : BLOCK;
        faces_of(camera, count, column + done, row + done, face, u, v);
        cm_inverse_array(camera->options.mapping, count, face, u, v, x + done, y + done, z + done);
    }
}

/* A pixel is (1 / half)^2 of the map, whose area is so many times the sphere's. */
double cm_camera_angle_faces(const cm_camera *camera, double column, double row)
{
    uint8_t face;
    double uv[2];
    cm_distortion at;
    faces_of(camera, 1, &column, &row, &face, &uv[0], &uv[1]);
    cm_inverse_distortion(camera->options.mapping, face, uv, &at);
    return 1.0 / (camera->half * camera->half * at.scale);
}

void cm_camera_jacobian_faces(const cm_camera *camera, const double point[3], double jacobian[6])
{
    const double length = sqrt(point[0] * point[0] + point[1] * point[1] + point[2] * point[2]);
    const double across = camera->half / length;
    const double down = -across * camera->first_v;
    cm_forward_jacobian(camera->options.mapping, point, jacobian);
    for (int i = 0; i < 3; i++)
    {
        jacobian[i] *= across;
        jacobian[3 + i] *= down;
    }
}
