/* SPDX-License-Identifier: MIT
 *
 * From the numbers of a calibration to a lens.
 */
#include "camera_object.h"

#include <float.h>

#define QUARTER_TURN 1.5707963267948966

/* What its residual may be, in pixels: the contract is 1e-9. */
#define RESIDUAL 1e-10

static int are_finite(const double *number, size_t n)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
    {
        sum += 0.0 * number[i];
    }
    return sum == 0.0;
}

/* A focal length whose inverse has all its digits. */
static int is_focal_length(double f)
{
    return fabs(f) >= 1e-100 && fabs(f) <= 1e100;
}

/* OpenCV's computeTiltProjectionMatrix: about x by tau_x, about y by tau_y, then along the turned axis to the plane. */
static void make_tilt(double tau_x, double tau_y, cm_lens *lens)
{
    const double cx = cos(tau_x), sx = sin(tau_x), cy = cos(tau_y), sy = sin(tau_y);
    const double turn[9] = {cy, sy * sx, -sy * cx, 0.0, cx, sx, sy, -cy * sx, cy * cx};
    const double axis = turn[8];
    double *t = lens->tilt;
    for (int i = 0; i < 3; i++)
    {
        t[i] = axis * turn[i] - turn[2] * turn[6 + i];
        t[3 + i] = axis * turn[3 + i] - turn[5] * turn[6 + i];
        t[6 + i] = turn[6 + i];
    }
    /* t is a product with turn, whose inverse is its transpose */
    double *back = lens->level;
    for (int i = 0; i < 3; i++)
    {
        back[3 * i] = turn[i] / axis;
        back[3 * i + 1] = turn[3 + i] / axis;
        back[3 * i + 2] = (turn[i] * turn[2] + turn[3 + i] * turn[5]) / axis + turn[6 + i];
    }
    lens->tilt_size = axis * axis;
    lens->is_tilted = tau_x != 0.0 || tau_y != 0.0;
}

static int is_distorted(const double *k)
{
    for (int i = 0; i < 14; i++)
    {
        if (k[i] != 0.0)
        {
            return 1;
        }
    }
    return 0;
}

static void make_distortion(const double *k, cm_lens *lens)
{
    const double radial[6] = {k[0], k[1], k[4], k[5], k[6], k[7]};
    for (int i = 0; i < 6; i++)
    {
        lens->k[i] = radial[i];
    }
    lens->p1_twice = 2.0 * k[2];
    lens->p2_twice = 2.0 * k[3];
    lens->even[0] = k[3] + k[8];
    lens->steep[0] = k[9];
    lens->even[1] = k[2] + k[10];
    lens->steep[1] = k[11];
    lens->first = k[0] - k[5];
    lens->second = k[1] - k[6] - k[5] * lens->first;
    make_tilt(k[12], k[13], lens);
    lens->is_plain = !is_distorted(k);
}

/* Products of two stay finite. */
static int are_coefficients(const double *k)
{
    for (int i = 0; i < 14; i++)
    {
        if (!(fabs(k[i]) <= 1e150))
        {
            return 0;
        }
    }
    return 1;
}

cm_status cm_camera_make_lens(const cm_camera_options *options, cm_lens *lens)
{
    const double *k = options->distortion;
    if (!is_focal_length(options->fx) || !is_focal_length(options->fy) ||
        !are_finite(&options->cx, 1) || !are_finite(&options->cy, 1) || !are_coefficients(k) ||
        fabs(k[12]) >= QUARTER_TURN || fabs(k[13]) >= QUARTER_TURN)
    {
        return CM_ERROR_CAMERA;
    }
    lens->fx = options->fx;
    lens->fy = options->fy;
    lens->cx = options->cx;
    lens->cy = options->cy;
    lens->per_x = 1.0 / lens->fx;
    lens->per_y = 1.0 / lens->fy;
    make_distortion(k, lens);
    lens->slack = RESIDUAL / fmax(fabs(lens->fx), fabs(lens->fy));
    return CM_OK;
}
