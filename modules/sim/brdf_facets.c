/* SPDX-License-Identifier: MIT
 *
 * Cook and Torrance 1982, "A reflectance model for computer graphics". Its denominator has 4 for the printed pi: with
 * Beckmann's distribution as they define it, energy is conserved so (Walter and others 2007).
 */
#include "brdf_object.h"

#include <math.h>

/* Of light that is not polarised: what a plane of eta + i absorption reflects. */
static double fresnel(double cosine, double eta, double absorption)
{
    const double c2 = fmax(cosine, 1e-9) * fmax(cosine, 1e-9);
    const double s2 = 1.0 - c2;
    const double twice = eta * absorption;
    const double real = eta * eta - absorption * absorption - s2;
    const double size = sqrt(real * real + 4.0 * twice * twice); /* a^2 + b^2 */
    const double a = sqrt(fmax(0.0, 0.5 * (size + real)));
    const double mixed = 2.0 * a * sqrt(c2);
    const double across = (size + c2 - mixed) / (size + c2 + mixed);
    const double square = c2 * size + s2 * s2;
    const double along = across * (square - mixed * s2) / (square + mixed * s2);
    return 0.5 * (across + along);
}

/* The facets that reflect one direction into the other: cosines of their normal. */
typedef struct halfway
{
    double normal; /* from the surface's */
    double in;     /* from both directions */
} halfway;

static halfway halfway_of(const brdf_angles *at)
{
    const double length = sqrt(fmax(1e-300, 2.0 + 2.0 * at->between));
    const halfway h = {fmin(1.0, (at->in + at->out) / length), 0.5 * length};
    return h;
}

/* Beckmann's distribution, facets a steradian: its integral times cosine is 1. */
static double beckmann(double cosine, double roughness)
{
    const double c2 = cosine * cosine;
    const double m2 = roughness * roughness;
    return exp(-(1.0 - c2) / (c2 * m2)) / (PI * m2 * c2 * c2);
}

static double value(const cm_brdf *brdf, const brdf_angles *at)
{
    const cm_cook_torrance *f = &brdf->facets;
    const halfway h = halfway_of(at);
    const double seen = 2.0 * h.normal * fmin(at->in, at->out) / h.in; /* of the V-grooves' sides */
    return f->diffuse / PI + f->specular * fresnel(h.in, f->eta, f->absorption) *
                                 beckmann(h.normal, f->roughness) * fmin(1.0, seen) /
                                 (4.0 * at->in * at->out);
}

static double density(const cm_brdf *brdf, const brdf_angles *at)
{
    const halfway h = halfway_of(at);
    const double of_facets = beckmann(h.normal, brdf->facets.roughness) * h.normal / (4.0 * h.in);
    return brdf->specular_part * of_facets + (1.0 - brdf->specular_part) * at->in / PI;
}

static void draw(const cm_brdf *brdf, double cosine_out, const double u[3], double in[3])
{
    if (u[2] >= brdf->specular_part)
    {
        brdf_draw_cosine(u, in);
        return;
    }
    const double m = brdf->facets.roughness;
    const double cosine = 1.0 / sqrt(1.0 - m * m * log1p(-u[0]));
    const double sine = sqrt(fmax(0.0, 1.0 - cosine * cosine));
    const double azimuth = 2.0 * PI * u[1];
    const double normal[3] = {sine * cos(azimuth), sine * sin(azimuth), cosine};
    const double out[3] = {sqrt(fmax(0.0, 1.0 - cosine_out * cosine_out)), 0.0, cosine_out};
    const double along = out[0] * normal[0] + out[2] * normal[2];
    for (int k = 0; k < 3; k++)
    {
        in[k] = 2.0 * along * normal[k] - out[k];
    }
}

static double albedo(const cm_brdf *brdf, double theta)
{
    const double place = theta / (0.5 * PI) * (BRDF_ALBEDOS - 1);
    const int i = place < BRDF_ALBEDOS - 2 ? (int)place : BRDF_ALBEDOS - 2;
    const double part = place - i;
    return (1.0 - part) * brdf->albedo[i] + part * brdf->albedo[i + 1];
}

static const brdf_kind facets = {value, density, draw, albedo};

/* By directions on a lattice of golden ratios (Roberts 2018), from facets alone: Lambert's part is known. */
static void tabulate_albedo(cm_brdf *brdf)
{
    enum
    {
        DRAWS = 1024
    };
    cm_brdf mirror = *brdf;
    mirror.facets.diffuse = 0.0;
    mirror.specular_part = 1.0;
    for (int i = 0; i < BRDF_ALBEDOS; i++)
    {
        const double theta = 0.5 * PI * fmin(i, BRDF_ALBEDOS - 1.001) / (BRDF_ALBEDOS - 1);
        const double out[3] = {sin(theta), 0.0, cos(theta)};
        double sum = 0.0;
        for (int j = 0; j < DRAWS; j++)
        {
            const double u[3] = {(j + 0.5) / DRAWS, fmod(0.5 + j * 0.6180339887498949, 1.0), 0.0};
            double in[3];
            draw(&mirror, out[2], u, in);
            const brdf_angles at = {fmin(1.0, in[2]), out[2],
                                    fmin(1.0, out[0] * in[0] + out[2] * in[2])};
            sum += at.in > 0.0 ? value(&mirror, &at) * at.in / density(&mirror, &at) : 0.0;
        }
        brdf->albedo[i] = brdf->facets.diffuse + sum / DRAWS;
    }
}

cm_status cm_brdf_create_cook_torrance(const cm_cook_torrance *options, cm_brdf **brdf)
{
    if (brdf == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    *brdf = NULL;
    if (options == NULL || options->size != sizeof *options)
    {
        return CM_ERROR_ARGUMENT;
    }
    const int is_right = options->diffuse >= 0.0 && options->specular >= 0.0 &&
                         options->diffuse + options->specular <= 1.0 + 1e-12 &&
                         options->roughness >= 0.01 && options->roughness <= 1.0 &&
                         options->eta > 0.0 && options->eta <= 1e6 && options->absorption >= 0.0 &&
                         options->absorption <= 1e6;
    if (!is_right)
    {
        return CM_ERROR_RANGE;
    }
    cm_brdf *made = brdf_make(&facets);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    made->facets = *options;
    const double mirrored = options->specular * fresnel(1.0, options->eta, options->absorption);
    const double all = mirrored + options->diffuse;
    /* Never none of one, as grazing light is reflected more. */
    made->specular_part = options->specular == 0.0  ? 0.0
                          : options->diffuse == 0.0 ? 1.0
                                                    : fmin(0.9, fmax(0.1, mirrored / all));
    tabulate_albedo(made);
    *brdf = made;
    return CM_OK;
}
