/* SPDX-License-Identifier: MIT
 *
 * Poses: products, inverses, and rotations as quaternions.
 */
#include <cubemap/pose.h>

#include <float.h>
#include <math.h>
#include <string.h>

cm_status cm_pose_check(const cm_pose *pose)
{
    if (pose == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    const double *place = pose->position;
    const int is_finite = isfinite(place[0]) && isfinite(place[1]) && isfinite(place[2]);
    return is_finite && cm_rotation_check(&pose->rotation) == CM_OK ? CM_OK : CM_ERROR_CAMERA;
}

void cm_pose_apply(const cm_pose *pose, const double world[3], double camera[3])
{
    const double from[3] = {world[0] - pose->position[0], world[1] - pose->position[1],
                            world[2] - pose->position[2]};
    cm_rotate(&pose->rotation, from, camera);
}

void cm_pose_apply_back(const cm_pose *pose, const double camera[3], double world[3])
{
    cm_rotate_back(&pose->rotation, camera, world);
    for (int i = 0; i < 3; i++)
    {
        world[i] += pose->position[i];
    }
}

void cm_pose_compose(const cm_pose *outer, const cm_pose *inner, cm_pose *product)
{
    cm_pose made;
    cm_pose_apply_back(outer, inner->position, made.position);
    for (int i = 0; i < 3; i++)
    {
        cm_rotate_back(&outer->rotation, inner->rotation.row[i], made.rotation.row[i]);
    }
    *product = made;
}

void cm_pose_invert(const cm_pose *pose, cm_pose *inverse)
{
    cm_pose made;
    cm_rotate(&pose->rotation, pose->position, made.position);
    for (int i = 0; i < 3; i++)
    {
        made.position[i] = 0.0 - made.position[i];
        for (int k = 0; k < 3; k++)
        {
            made.rotation.row[i][k] = pose->rotation.row[k][i];
        }
    }
    *inverse = made;
}

void cm_pose_between(const cm_pose *from, const cm_pose *to, cm_pose *between)
{
    cm_pose made;
    cm_pose_apply(from, to->position, made.position);
    for (int i = 0; i < 3; i++)
    {
        cm_rotate(&from->rotation, to->rotation.row[i], made.rotation.row[i]);
    }
    *between = made;
}

/* The first that is not 0, from w on, is to be greater than 0. */
static int is_turned(const double q[4])
{
    for (int i = 0; i < 4; i++)
    {
        const double value = q[(i + 3) % 4];
        if (value != 0.0)
        {
            return value < 0.0;
        }
    }
    return 0;
}

/* From the largest component, which is 1/2 or more, and the sums and differences that hold the others times that
 * (Shepperd 1978): nothing cancels, so that even a rotation by 1e-300 keeps its axis. */
void cm_pose_quaternion(const cm_pose *pose, double quaternion[4])
{
    const double(*row)[3] = pose->rotation.row; /* its transpose is the rotation to the world */
    const double trace = row[0][0] + row[1][1] + row[2][2];
    int largest = 3;
    double greatest = trace;
    for (int i = 0; i < 3; i++)
    {
        if (row[i][i] > greatest)
        {
            largest = i;
            greatest = row[i][i];
        }
    }
    double q[4];
    for (int i = 0; i < 3; i++)
    {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        if (largest == 3)
        {
            q[i] = row[j][k] - row[k][j];
        }
        else if (largest == i)
        {
            q[i] = 1.0 + row[i][i] - row[j][j] - row[k][k];
            q[j] = row[i][j] + row[j][i];
            q[k] = row[i][k] + row[k][i];
            q[3] = row[j][k] - row[k][j];
        }
    }
    if (largest == 3)
    {
        q[3] = 1.0 + trace;
    }
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double scale = is_turned(q) ? -1.0 / length : 1.0 / length;
    for (int i = 0; i < 4; i++)
    {
        quaternion[i] = q[i] * scale + 0.0;
    }
}

cm_status cm_pose_from_quaternion(const double position[3], const double quaternion[4],
                                  cm_pose *pose)
{
    if (position == NULL || quaternion == NULL || pose == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    double square = 0.0;
    for (int i = 0; i < 4; i++)
    {
        square += quaternion[i] * quaternion[i];
    }
    const double length = sqrt(square);
    /* 0.999 and 1.001, which no double is, are 1e-3 off as well */
    if (!(fabs(length - 1.0) <= 1e-3 + 4.0 * DBL_EPSILON) || !isfinite(position[0]) ||
        !isfinite(position[1]) || !isfinite(position[2]))
    {
        return CM_ERROR_CAMERA;
    }
    const double scale = 2.0 / square; /* normalises both factors of each product */
    cm_pose made;
    for (int i = 0; i < 3; i++)
    {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        const double a = quaternion[i];
        const double b = quaternion[j];
        const double c = quaternion[k];
        const double w = quaternion[3];
        made.rotation.row[i][i] = 1.0 - scale * (b * b + c * c);
        made.rotation.row[i][j] = scale * (a * b + w * c);
        made.rotation.row[i][k] = scale * (a * c - w * b);
        made.position[i] = position[i];
    }
    *pose = made;
    return CM_OK;
}
