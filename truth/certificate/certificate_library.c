/* SPDX-License-Identifier: MIT
 *
 * The library in the precision that is measured, and the truth.
 */
#include "certificate.h"

#include <math.h>

/* ---- The two precisions under one roof; in float the numbers are floats already ---- */

void forward_block(const subject *s, size_t n, double (*d)[BLOCK], uint8_t *face,
                   double (*uv)[BLOCK])
{
    static float in[3][BLOCK];
    static float out[2][BLOCK];
    if (!s->narrow)
    {
        cm_forward_array(s->mapping, n, d[0], d[1], d[2], face, uv[0], uv[1]);
        return;
    }
    for (size_t i = 0; i < n; i++)
    {
        in[0][i] = (float)d[0][i];
        in[1][i] = (float)d[1][i];
        in[2][i] = (float)d[2][i];
    }
    cm_forward_array_f32(s->mapping, n, in[0], in[1], in[2], face, out[0], out[1]);
    for (size_t i = 0; i < n; i++)
    {
        uv[0][i] = (double)out[0][i];
        uv[1][i] = (double)out[1][i];
    }
}

void inverse_block(const subject *s, size_t n, const uint8_t *face, double (*uv)[BLOCK],
                   double (*d)[BLOCK])
{
    static float in[2][BLOCK];
    static float out[3][BLOCK];
    if (!s->narrow)
    {
        cm_inverse_array(s->mapping, n, face, uv[0], uv[1], d[0], d[1], d[2]);
        return;
    }
    for (size_t i = 0; i < n; i++)
    {
        in[0][i] = (float)uv[0][i];
        in[1][i] = (float)uv[1][i];
    }
    cm_inverse_array_f32(s->mapping, n, face, in[0], in[1], out[0], out[1], out[2]);
    for (size_t i = 0; i < n; i++)
    {
        d[0][i] = (double)out[0][i];
        d[1][i] = (double)out[1][i];
        d[2][i] = (double)out[2][i];
    }
}

/* The warp, or with back its inverse, of the library; 0 if the mapping has none. */
int warp_point(const subject *s, int back, const double from[2], double to[2])
{
    float in[2] = {(float)from[0], (float)from[1]};
    float out[2];
    if (!s->narrow)
    {
        return (back ? cm_unwarp : cm_warp)(s->mapping, from, to) == CM_OK;
    }
    if ((back ? cm_unwarp_f32 : cm_warp_f32)(s->mapping, in, out) != CM_OK)
    {
        return 0;
    }
    to[0] = (double)out[0];
    to[1] = (double)out[1];
    return 1;
}

/* ---- Truth ---- */

int true_forward(const subject *s, const double d[3], long double uv[2])
{
    if (s->precision != DOUBLE)
    {
        double wide[2];
        int face = cm_forward(s->exact, d, wide);
        uv[0] = (long double)wide[0];
        uv[1] = (long double)wide[1];
        return face;
    }
    quad in[3] = {(quad)d[0], (quad)d[1], (quad)d[2]};
    quad out[2];
    int face = quad_forward(&s->truth, in, out);
    uv[0] = (long double)out[0];
    uv[1] = (long double)out[1];
    return face;
}

/* u, v beyond the edge are on it. In double exact is the kernel's text, whatever the argument. */
void true_inverse(const subject *s, const cm_mapping *exact, int face, const double uv[2],
                  long double d[3])
{
    if (s->precision != DOUBLE)
    {
        double wide[3];
        cm_inverse(exact, (uint8_t)face, uv, wide);
        for (int k = 0; k < 3; k++)
        {
            d[k] = (long double)wide[k];
        }
        return;
    }
    quad in[2] = {(quad)fmax(-1.0, fmin(1.0, uv[0])), (quad)fmax(-1.0, fmin(1.0, uv[1]))};
    if (s->is_disc)
    {
        in[0] = (quad)uv[0];
        in[1] = (quad)uv[1];
    }
    quad out[3];
    quad_inverse(&s->truth, face, in, out);
    for (int k = 0; k < 3; k++)
    {
        d[k] = (long double)out[k];
    }
}

void true_warp(const subject *s, int back, const double from[2], long double to[2])
{
    if (s->precision != DOUBLE)
    {
        double wide[2];
        (void)(back ? cm_unwarp : cm_warp)(s->exact, from, wide);
        to[0] = (long double)wide[0];
        to[1] = (long double)wide[1];
        return;
    }
    quad in[2] = {(quad)fmax(-1.0, fmin(1.0, from[0])), (quad)fmax(-1.0, fmin(1.0, from[1]))};
    quad out[2];
    (back ? quad_unwarp : quad_warp)(&s->truth, in, out);
    to[0] = (long double)out[0];
    to[1] = (long double)out[1];
}
