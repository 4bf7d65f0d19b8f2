/* SPDX-License-Identifier: MIT
 *
 * CAM16 and CAM16-UCS: C. Li et al., Comprehensive color solutions: CAM16, CAT16, and CAM16-UCS, Color Research
 * and Application 42, 2017.
 *
 * The paper adds 0.1 to each response, and takes 2.05 of them, or 0.305, away from their sums. Here responses
 * are without it: nothing cancels near black.
 */
#include "cam16.h"

#include "color_spaces.h"

#include <math.h>

/* M_16 of the paper, and its inverse, from the same six digits. */
static const double cones_from_xyz[3][3] = {
    {0.401288, 0.650173, -0.051461},
    {-0.250268, 1.204414, 0.045854},
    {-0.002079, 0.048952, 0.953127},
};
static const double xyz_from_cones[3][3] = {
    {1.862067855087232673, -1.0112546305316843954, 0.14918677544445172243},
    {0.38752654323613715981, 0.62144744193147535846, -0.008973985167612518275},
    {-0.01584149884933385532, -0.034122938028515563619, 1.0499644368778494189},
};

/* Surround "average" of the paper's table: F = 1, c = 0.69, N_c = 1. */
#define IMPACT 0.69

/* c_1 and c_2 of CAM16-UCS; J' is (1 + 100 c_1) J / (1 + c_1 J). */
#define UCS_LIGHTNESS 0.007
#define UCS_CHROMA 0.0228

/* ---- viewing conditions ---- */

static double compress(double level, double cone)
{
    const double power = pow(level * fabs(cone) / 100.0, 0.42);
    return copysign(400.0 * power / (power + 27.13), cone);
}

/* NaN for a response that no light has. */
static double expand(double level, double response)
{
    const double size = fabs(response);
    const double power = 27.13 * size / (400.0 - size);
    return size < 400.0 ? copysign(100.0 / level * pow(power, 1.0 / 0.42), response) : (double)NAN;
}

static double achromatic(const cm_cam16_conditions *conditions, const double response[3])
{
    return (2.0 * response[0] + response[1] + response[2] / 20.0) * conditions->brightness;
}

static void responses_of(const cm_cam16_conditions *conditions, const double xyz[3],
                         double response[3])
{
    cm_colormap_multiply(cones_from_xyz, xyz, response);
    for (int i = 0; i < 3; i++)
    {
        response[i] = compress(conditions->level, conditions->gain[i] * response[i]);
    }
}

void cm_cam16_prepare(const cm_colormap_viewing *viewing, cm_cam16_conditions *conditions)
{
    const double adapting = viewing->luminance;
    const double background = viewing->background / viewing->white[1]; /* n */
    const double degree = fmin(fmax(1.0 - exp((-adapting - 42.0) / 92.0) / 3.6, 0.0), 1.0);
    const double k = 1.0 / (5.0 * adapting + 1.0);
    const double fourth = k * k * k * k;
    double white[3];
    cm_colormap_multiply(cones_from_xyz, viewing->white, white);
    for (int i = 0; i < 3; i++)
    {
        conditions->gain[i] = degree * viewing->white[1] / white[i] + 1.0 - degree;
    }
    conditions->level = 0.2 * fourth * 5.0 * adapting +
                        0.1 * (1.0 - fourth) * (1.0 - fourth) * cbrt(5.0 * adapting);
    conditions->exponent = IMPACT * (1.48 + sqrt(background));
    conditions->brightness = 0.725 * pow(background, -0.2);
    conditions->chroma = pow(1.64 - pow(0.29, background), 0.73);
    responses_of(conditions, viewing->white, white);
    conditions->of_white = achromatic(conditions, white);
}

/* The 64 lux of IEC 61966-2-1, of which what is in view reflects a fifth. */
static const cm_colormap_viewing viewing_of_srgb = {
    .white = {100.0 * CM_COLORMAP_WHITE_X, 100.0, 100.0 * CM_COLORMAP_WHITE_Z},
    .luminance = 64.0 / CM_COLORMAP_PI / 5.0,
    .background = 20.0,
};

void cm_cam16_prepare_srgb(cm_cam16_conditions *conditions)
{
    cm_cam16_prepare(&viewing_of_srgb, conditions);
}

/* ---- CAM16 ---- */

/* 50000 / 13 N_c N_cb e_t, of a hue in radians. */
static double hue_strength(const cm_cam16_conditions *conditions, double hue)
{
    return 50000.0 / 13.0 * conditions->brightness * 0.25 * (cos(hue + 2.0) + 3.8);
}

/* The hue is in radians here, from -pi to pi. */
static void appearance_of(const cm_cam16_conditions *conditions, const double xyz[3],
                          cm_colormap_appearance *appearance)
{
    double response[3];
    responses_of(conditions, xyz, response);
    const double red = response[0], green = response[1], blue = response[2];
    const double a = red - 12.0 * green / 11.0 + blue / 11.0;
    const double b = (red + green - 2.0 * blue) / 9.0;
    const double part = achromatic(conditions, response) / conditions->of_white;
    const double sum = red + green + 1.05 * blue + 0.305;
    const double hue = atan2(b, a);
    const double t = hue_strength(conditions, hue) * hypot(a, b) / sum;
    const double lightness = 100.0 * pow(part, conditions->exponent);
    appearance->lightness = lightness;
    appearance->chroma = pow(t, 0.9) * sqrt(lightness / 100.0) * conditions->chroma;
    appearance->hue = hue;
    appearance->colorfulness = appearance->chroma * sqrt(sqrt(conditions->level));
}

static int is_viewing(const cm_colormap_viewing *viewing)
{
    double sum = viewing->luminance + viewing->background;
    int good = viewing->luminance > 0.0 && viewing->background > 0.0;
    for (int i = 0; i < 3; i++)
    {
        good &= viewing->white[i] > 0.0;
        sum += viewing->white[i];
    }
    return good && isfinite(sum);
}

void cm_colormap_cam16(const double xyz[3], const cm_colormap_viewing *viewing,
                       cm_colormap_appearance *appearance)
{
    const cm_colormap_viewing *seen = viewing == NULL ? &viewing_of_srgb : viewing;
    cm_cam16_conditions conditions;
    const double nothing = (double)NAN;
    *appearance = (cm_colormap_appearance){nothing, nothing, nothing, nothing};
    if (!is_viewing(seen))
    {
        return;
    }
    cm_cam16_prepare(seen, &conditions);
    appearance_of(&conditions, xyz, appearance);
    const double degrees = appearance->hue * (180.0 / CM_COLORMAP_PI);
    const double hue = degrees < 0.0 ? degrees + 360.0 : degrees;
    appearance->hue = hue >= 360.0 ? 0.0 : hue;
    if (!isfinite(appearance->lightness + appearance->chroma + appearance->hue))
    {
        *appearance = (cm_colormap_appearance){nothing, nothing, nothing, nothing};
    }
}

/* ---- CAM16-UCS ---- */

void cm_colormap_ucs_from_linear(const double linear[3], double ucs[3])
{
    cm_cam16_conditions conditions;
    cm_colormap_appearance seen;
    double xyz[3];
    cm_cam16_prepare_srgb(&conditions);
    cm_colormap_xyz_from_linear(linear, xyz);
    for (int i = 0; i < 3; i++)
    {
        xyz[i] *= 100.0;
    }
    appearance_of(&conditions, xyz, &seen);
    const double chroma = log1p(UCS_CHROMA * seen.colorfulness) / UCS_CHROMA;
    ucs[0] =
        (1.0 + 100.0 * UCS_LIGHTNESS) * seen.lightness / (1.0 + UCS_LIGHTNESS * seen.lightness);
    ucs[1] = chroma * cos(seen.hue);
    ucs[2] = chroma * sin(seen.hue);
    if (!isfinite(ucs[0] + ucs[1] + ucs[2]))
    {
        ucs[0] = ucs[1] = ucs[2] = (double)NAN;
    }
}

/* With gamma the distance of (a, b) from grey, responses are linear in it: of (A, a, b) they are
 *     (460 A + 451 a + 288 b) / 1403,  (460 A - 891 a - 261 b) / 1403,  (460 A - 220 a - 6300 b) / 1403,
 * and t = strength gamma / (R + G + 1.05 B + 0.305) is solved for gamma. */
static void responses_from(const cm_cam16_conditions *conditions, double lightness, double chroma,
                           double hue, double response[3])
{
    const double cosine = cos(hue), sine = sin(hue);
    const double slope[3] = {(451.0 * cosine + 288.0 * sine) / 1403.0,
                             (-891.0 * cosine - 261.0 * sine) / 1403.0,
                             (-220.0 * cosine - 6300.0 * sine) / 1403.0};
    const double grey = 460.0 / 1403.0 * conditions->of_white / conditions->brightness *
                        pow(lightness / 100.0, 1.0 / conditions->exponent);
    const double t = pow(chroma / (sqrt(lightness / 100.0) * conditions->chroma), 1.0 / 0.9);
    const double rest = hue_strength(conditions, hue) - t * (slope[0] + slope[1] + 1.05 * slope[2]);
    const double gamma = rest > 0.0 ? t * (3.05 * grey + 0.305) / rest : (double)NAN;
    for (int i = 0; i < 3; i++)
    {
        response[i] = grey + gamma * slope[i];
    }
}

void cm_cam16_linear_from_ucs(const cm_cam16_conditions *conditions, const double ucs[3],
                              double linear[3])
{
    double cone[3];
    const double light = ucs[0];
    const double most = (1.0 + 100.0 * UCS_LIGHTNESS) / UCS_LIGHTNESS;
    const double distance = hypot(ucs[1], ucs[2]);
    if (!(light >= 0.0 && light < most && isfinite(distance)))
    {
        linear[0] = linear[1] = linear[2] = (double)NAN;
        return;
    }
    if (light == 0.0)
    {
        linear[0] = linear[1] = linear[2] = 0.0;
        return;
    }
    const double lightness = light / (UCS_LIGHTNESS * (most - light));
    const double chroma = expm1(UCS_CHROMA * distance) / UCS_CHROMA / sqrt(sqrt(conditions->level));
    responses_from(conditions, lightness, chroma, atan2(ucs[2], ucs[1]), cone);
    for (int i = 0; i < 3; i++)
    {
        cone[i] = expand(conditions->level, cone[i]) / (100.0 * conditions->gain[i]);
    }
    cm_colormap_multiply(xyz_from_cones, cone, linear);
    cm_colormap_linear_from_xyz(linear, linear);
}

void cm_colormap_linear_from_ucs(const double ucs[3], double linear[3])
{
    cm_cam16_conditions conditions;
    cm_cam16_prepare_srgb(&conditions);
    cm_cam16_linear_from_ucs(&conditions, ucs, linear);
    if (!isfinite(linear[0] + linear[1] + linear[2]))
    {
        linear[0] = linear[1] = linear[2] = (double)NAN;
    }
}
