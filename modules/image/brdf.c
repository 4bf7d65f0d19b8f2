/* SPDX-License-Identifier: MIT
 *
 * The integral of the GGX reflection over all light, over the normals of microfacets: h at the angle theta from n, with
 * tan(theta) = alpha tan(psi), whose sin^2(psi) is distributed evenly, and at the azimuth phi from v. What reflects
 * below the horizon is left out by limits, since the integrand ends there with a kink: n l > 0 where
 *     cos(phi) > -n_v cos(2 theta) / (s_v sin(2 theta)),
 * which is everywhere up to theta1, with tan(theta1) = n_v / (1 + s_v), and nowhere from theta2 = 90 degrees - theta1.
 */
#include <cubemap/environment.h>

#include <math.h>

#include "gauss_legendre.h"

#define PI 3.14159265358979323846

/* With twice the pieces the error is a third of it, and with twice the points of phi two thirds. */
#define STEP 8.0

/* What stays the same in one integral. */
typedef struct surface
{
    cm_brdf_shadowing shadowing;
    double cosine; /* n v */
    double sine;
    double alpha;
} surface;

/* G / (4 n_l n_v). */
static double visibility(const surface *s, double n_l)
{
    const double n_v = s->cosine;
    if (s->shadowing == CM_BRDF_SCHLICK)
    {
        const double k = 0.5 * s->alpha;
        return 0.25 / ((n_l * (1.0 - k) + k) * (n_v * (1.0 - k) + k));
    }
    const double a = s->alpha * s->alpha;
    return 0.5 / (n_l * sqrt(a + (1.0 - a) * n_v * n_v) + n_v * sqrt(a + (1.0 - a) * n_l * n_l));
}

/* Adds weight times the two integrands for a normal. */
static void add_normal(const surface *s, double n_h, double sine_h, double cosine_phi,
                       double weight, cm_brdf_terms *sum)
{
    const double v_h = s->cosine * n_h + s->sine * sine_h * cosine_phi;
    const double n_l = 2.0 * v_h * n_h - s->cosine;
    if (!(n_l > 0.0 && v_h > 0.0))
    {
        return; /* on the horizon, but for rounding */
    }
    const double back = 1.0 - fmin(v_h, 1.0);
    const double fresnel = back * back * back * back * back;
    const double value = weight * 4.0 * visibility(s, n_l) * n_l * v_h / n_h;
    sum->scale += value * (1.0 - fresnel);
    sum->bias += value * fresnel;
}

/* Adds the normals of one psi: the mean over phi from 0 to its limit, times the limit's part of pi. */
static void add_ring(const surface *s, double psi, double weight, cm_brdf_terms *sum)
{
    const double tangent = s->alpha * tan(psi);
    const double n_h = 1.0 / sqrt(1.0 + tangent * tangent);
    const double sine_h = tangent * n_h;
    const double above = s->cosine * (1.0 - tangent * tangent);
    const double below = 2.0 * s->sine * tangent;
    const double limit = above >= below ? PI : above <= -below ? 0.0 : acos(-above / below);
    const double part = weight * sin(2.0 * psi) * limit / PI;
    for (size_t k = 0; k < CM_GAUSS_NODES; k++)
    {
        add_normal(s, n_h, sine_h, cos(limit * cm_gauss_node[k]), part * cm_gauss_weight[k], sum);
    }
}

/* psi from low to high; more densely at the ends, where the limit of phi begins and ends like a root. */
static void add_rings(const surface *s, double low, double high, cm_brdf_terms *sum)
{
    for (size_t k = 0; k < CM_GAUSS_NODES; k++)
    {
        const double t = cm_gauss_node[k];
        const double root = sin(0.5 * PI * t);
        const double psi = low + (high - low) * root * root;
        const double jacobian = (high - low) * 0.5 * PI * sin(PI * t);
        add_ring(s, psi, jacobian * cm_gauss_weight[k], sum);
    }
}

/* All psi, in pieces: what is below depends on theta, so that from alpha on tan(theta) grows by STEP at most in each;
 * and tan(theta1) is between two of them. */
static void add_pieces(const surface *s, cm_brdf_terms *sum)
{
    const double first = s->cosine / (1.0 + s->sine);
    const double last = atan2(1.0 + s->sine, s->cosine * s->alpha);
    double tangent = s->alpha;
    double low = 0.0;
    for (int is_behind = first <= 0.0; low < last;)
    {
        double high = fmin(atan(tangent / s->alpha), last);
        if (!is_behind && first <= tangent)
        {
            high = atan(first / s->alpha);
            is_behind = 1;
        }
        else
        {
            tangent *= tangent < 1e3 ? STEP : (double)INFINITY;
        }
        add_rings(s, low, high, sum);
        low = high;
    }
}

cm_status cm_brdf_integrate(cm_brdf_shadowing shadowing, double cosine, double roughness,
                            cm_brdf_terms *terms)
{
    if (terms == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!(cosine >= 0.0 && cosine <= 1.0) || !(roughness >= 0.0 && roughness <= 1.0) ||
        (int)shadowing < CM_BRDF_CORRELATED || (int)shadowing > CM_BRDF_SCHLICK)
    {
        return CM_ERROR_RANGE;
    }
    cm_brdf_terms sum = {0.0, 0.0};
    const surface s = {shadowing, cosine, sqrt((1.0 - cosine) * (1.0 + cosine)),
                       roughness * roughness};
    if (s.alpha == 0.0)
    {
        sum.bias = pow(1.0 - cosine, 5.0);
        sum.scale = 1.0 - sum.bias;
    }
    else
    {
        add_pieces(&s, &sum);
    }
    *terms = sum;
    return CM_OK;
}

double cm_brdf_multiple(const cm_brdf_terms *terms, double f0)
{
    if (terms == NULL)
    {
        return (double)NAN;
    }
    const double single = f0 * terms->scale + terms->bias;
    const double lost = 1.0 - (terms->scale + terms->bias);
    const double mean = f0 + (1.0 - f0) / 21.0;
    return single * mean * lost / (1.0 - lost * mean);
}
