/* SPDX-License-Identifier: MIT
 *
 * OpenCV's lens as its documentation prints it ("Detailed Description" of calib3d), in long double and term by term, and its
 * way back as that documentation and undistortPoints have it: ten rounds of a fixed point. What cameras are judged by.
 */
#ifndef TESTS_SCENE_LENS_TRUTH_H
#define TESTS_SCENE_LENS_TRUTH_H

#include <math.h>

#include <cubemap/camera.h>

enum
{
    K1,
    K2,
    P1,
    P2,
    K3,
    K4,
    K5,
    K6,
    S1,
    S2,
    S3,
    S4,
    TAU_X,
    TAU_Y
};

/* (x', y') to (x'', y''), the sensor not yet tilted. */
static inline void lens_distort(const double *k, long double x, long double y, long double to[2])
{
    const long double r2 = x * x + y * y;
    const long double r4 = r2 * r2;
    const long double r6 = r4 * r2;
    const long double radial =
        (1 + k[K1] * r2 + k[K2] * r4 + k[K3] * r6) / (1 + k[K4] * r2 + k[K5] * r4 + k[K6] * r6);
    to[0] = x * radial + 2 * k[P1] * x * y + k[P2] * (r2 + 2 * x * x) + k[S1] * r2 + k[S2] * r4;
    to[1] = y * radial + k[P1] * (r2 + 2 * y * y) + 2 * k[P2] * x * y + k[S3] * r2 + k[S4] * r4;
}

/* (x'', y'') to (x''', y'''). */
static inline void lens_tilt(const double *k, long double place[2])
{
    const long double cx = cosl(k[TAU_X]), sx = sinl(k[TAU_X]);
    const long double cy = cosl(k[TAU_Y]), sy = sinl(k[TAU_Y]);
    const long double about_x[3][3] = {{1, 0, 0}, {0, cx, sx}, {0, -sx, cx}};
    const long double about_y[3][3] = {{cy, 0, -sy}, {0, 1, 0}, {sy, 0, cy}};
    const long double from[3] = {place[0], place[1], 1};
    long double turn[3][3] = {{0}};
    long double turned[3] = {0};
    for (int i = 0; i < 3; i++)
    {
        for (int j = 0; j < 3; j++)
        {
            for (int l = 0; l < 3; l++)
            {
                turn[i][j] += about_y[i][l] * about_x[l][j];
            }
            turned[i] += turn[i][j] * from[j];
        }
    }
    place[0] = (turn[2][2] * turned[0] - turn[0][2] * turned[2]) / turned[2];
    place[1] = (turn[2][2] * turned[1] - turn[1][2] * turned[2]) / turned[2];
}

static inline void lens_project(const cm_camera_options *camera, const long double point[3],
                                long double pixel[2])
{
    long double place[2];
    lens_distort(camera->distortion, point[0] / point[2], point[1] / point[2], place);
    lens_tilt(camera->distortion, place);
    pixel[0] = camera->fx * place[0] + camera->cx;
    pixel[1] = camera->fy * place[1] + camera->cy;
}

/* Without tilt. */
static inline void lens_ten_rounds(const cm_camera_options *camera, double column, double row,
                                   double ray[2])
{
    const double *k = camera->distortion;
    const double aim[2] = {(column - camera->cx) / camera->fx, (row - camera->cy) / camera->fy};
    double x = aim[0];
    double y = aim[1];
    for (int i = 0; i < 10; i++)
    {
        const double r2 = x * x + y * y;
        const double inverse = (1 + ((k[K6] * r2 + k[K5]) * r2 + k[K4]) * r2) /
                               (1 + ((k[K3] * r2 + k[K2]) * r2 + k[K1]) * r2);
        const double move_x =
            2 * k[P1] * x * y + k[P2] * (r2 + 2 * x * x) + k[S1] * r2 + k[S2] * r2 * r2;
        const double move_y =
            k[P1] * (r2 + 2 * y * y) + 2 * k[P2] * x * y + k[S3] * r2 + k[S4] * r2 * r2;
        x = (aim[0] - move_x) * inverse;
        y = (aim[1] - move_y) * inverse;
    }
    ray[0] = x;
    ray[1] = y;
}

#endif
