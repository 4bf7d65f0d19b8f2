/* SPDX-License-Identifier: MIT
 *
 * Factors of degrees: lobes and windows.
 */
#include <cubemap/environment.h>

#include <math.h>

#include "environment_lobe.h"
#include "gauss_legendre.h"

#define PI 3.14159265358979323846

cm_status cm_harmonics_cosine_lobe(uint32_t degree, double *factor)
{
    if (factor == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (degree > CM_HARMONICS_DEGREE_MAX)
    {
        return CM_ERROR_RANGE;
    }
    /* 2 pi (-1)^(l/2 - 1) / ((l + 2) (l - 1)) l! / (2^l (l/2)!^2) for even l: central is the last quotient */
    double central = 1.0;
    for (uint32_t l = 0; l <= degree; l++)
    {
        if (l % 2 == 1)
        {
            factor[l] = l == 1 ? 2.0 * PI / 3.0 : 0.0;
            continue;
        }
        central *= l > 0 ? (l - 1.0) / l : 1.0;
        factor[l] = 2.0 * PI * (l % 4 == 0 ? -1.0 : 1.0) / ((l + 2.0) * (l - 1.0)) * central;
    }
    return CM_OK;
}

/* With s = sin^2(theta / 2), where theta is the angle between n and l, D(h) n l is proportional to
 * (1 - 2 s) / (alpha^2 (1 - s) + s)^2 for s from 0 to 1/2. alpha^2 = 0 is the mirror. */
static double ggx_weight(double alpha_squared, double s)
{
    const double below = alpha_squared * (1.0 - s) + s;
    return (1.0 - 2.0 * s) / (below * below);
}

/* Adds, for the piece of s from alpha^2 (1 - r) / r at r0 down to that at r1, the moments of Legendre's polynomials. r goes
 * to 0 far from a narrow lobe's middle, where it has all its digits. */
static void add_moments(uint32_t degree, double alpha_squared, double r0, double r1, double *moment)
{
    for (size_t k = 0; k < CM_GAUSS_NODES; k++)
    {
        const double r = r0 + (r1 - r0) * cm_gauss_node[k];
        const double s = alpha_squared * (1.0 - r) / r;
        const double jacobian = alpha_squared / (r * r);
        const double weight =
            ggx_weight(alpha_squared, s) * jacobian * (r0 - r1) * cm_gauss_weight[k];
        const double x = 1.0 - 2.0 * s;
        double last = 0.0;
        double polynomial = 1.0;
        for (uint32_t l = 0; l <= degree; l++)
        {
            moment[l] += weight * polynomial;
            const double next = ((2.0 * l + 1.0) * x * polynomial - l * last) / (l + 1.0);
            last = polynomial;
            polynomial = next;
        }
    }
}

cm_status cm_harmonics_ggx_lobe(uint32_t degree, double roughness, double *factor)
{
    if (factor == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (degree > CM_HARMONICS_DEGREE_MAX || !(roughness >= 0.0 && roughness <= 1.0))
    {
        return CM_ERROR_RANGE;
    }
    const double alpha_squared = roughness * roughness * roughness * roughness;
    for (uint32_t l = 0; l <= degree; l++)
    {
        factor[l] = alpha_squared > CM_LOBE_MIRROR ? 0.0 : 1.0;
    }
    if (alpha_squared <= CM_LOBE_MIRROR)
    {
        return CM_OK;
    }
    /* the lobe's rim is where s = 1/2; pieces are so short that the polynomials turn less than once in each */
    const uint32_t pieces = 8 + degree / 4;
    for (uint32_t k = 0; k < pieces; k++)
    {
        /* evenly in the angle: s = sin^2(theta / 2) */
        const double s0 = pow(sin(PI / 4.0 * k / pieces), 2.0);
        const double s1 = pow(sin(PI / 4.0 * (k + 1.0) / pieces), 2.0);
        /* and more of them where the lobe is narrow */
        double from = s0;
        for (double to = s0; from < s1; from = to)
        {
            to = fmin(4.0 * from + 3.0 * alpha_squared, s1);
            add_moments(degree, alpha_squared, alpha_squared / (alpha_squared + from),
                        alpha_squared / (alpha_squared + to), factor);
        }
    }
    const double whole = factor[0];
    for (uint32_t l = 0; l <= degree; l++)
    {
        factor[l] /= whole;
    }
    return CM_OK;
}

cm_status cm_harmonics_window_factors(cm_harmonics_window window, double width, uint32_t degree,
                                      double *factor)
{
    if (factor == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (degree > CM_HARMONICS_DEGREE_MAX || !(width > 0.0 && isfinite(width)) ||
        (int)window < CM_WINDOW_NONE || (int)window > CM_WINDOW_LANCZOS)
    {
        return CM_ERROR_RANGE;
    }
    for (uint32_t l = 0; l <= degree; l++)
    {
        const double angle = PI * l / width;
        const double inside = l < width ? 1.0 : 0.0;
        factor[l] = window == CM_WINDOW_NONE      ? 1.0
                    : window == CM_WINDOW_HANNING ? inside * 0.5 * (1.0 + cos(angle))
                    : l == 0                      ? 1.0
                                                  : inside * sin(angle) / angle;
    }
    return CM_OK;
}

cm_status cm_harmonics_scale(uint32_t degree, uint32_t channels, const double *factor,
                             double *coefficients)
{
    if (factor == NULL || coefficients == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (degree > CM_HARMONICS_DEGREE_MAX || channels < 1 || channels > CM_ENVIRONMENT_CHANNELS_MAX)
    {
        return CM_ERROR_RANGE;
    }
    for (uint32_t l = 0; l <= degree; l++)
    {
        const size_t from = (size_t)l * l * channels;
        const size_t end = ((size_t)l + 1) * ((size_t)l + 1) * channels;
        for (size_t k = from; k < end; k++)
        {
            coefficients[k] *= factor[l];
        }
    }
    return CM_OK;
}
