/* SPDX-License-Identifier: MIT
 *
 * Is a map inside sRGB, and how colourful may it be?
 *
 * With lightness and hue fixed, the colours of sRGB are convex in u and v (an affine slice of a cube, seen
 * in a projective map of it) and have grey among them. So a colour is inside if its chroma is no more than
 * the largest, and what is inside stays so with less chroma.
 */
#include "colormap_path.h"

#include <math.h>

/* Chroma that is beyond the gamut by no more than this is rounding; it moves a linear channel by much less
 * than the 1e-9 that count as inside there. */
#define CM_COLORMAP_CHROMA_ROUNDING 1e-9

/* A number of a place of the path, of which the least is looked for; infinite where it does not matter. */
typedef double measure(const cm_colormap *map, const cm_colormap_piece *piece, double x);

/* Closer than this to an end a quotient of two numbers that vanish there is left out: it is mostly
 * rounding, and has its limit nearby. */
#define BESIDE_END 1e-6

static double chroma_limit(const cm_colormap_piece *piece, double x)
{
    double lch[3];
    cm_colormap_lch_in_piece(piece, x, lch);
    return cm_colormap_largest_chroma(fmin(fmax(lch[0], 0.0), 100.0), lch[2]);
}

static double base_at(const cm_colormap *map, const cm_colormap_piece *piece, double x)
{
    return map->ends * cm_colormap_mix(piece->from.base, piece->to.base, x);
}

static double margin(const cm_colormap *map, const cm_colormap_piece *piece, double x)
{
    (void)map;
    return chroma_limit(piece, x) - cm_colormap_mix(piece->chroma_from, piece->chroma_to, x);
}

static double margin_of_base(const cm_colormap *map, const cm_colormap_piece *piece, double x)
{
    return chroma_limit(piece, x) - base_at(map, piece, x);
}

/* The saturation times saturation range that reaches the limit. Half of the rounding that is allowed keeps
 * the result sane where the base touches the limit. */
static double strength_limit(const cm_colormap *map, const cm_colormap_piece *piece, double x)
{
    const double vivid = cm_colormap_mix(piece->from.vivid, piece->to.vivid, x);
    if (!(vivid > 0.0) || x < BESIDE_END || x > 1.0 - BESIDE_END)
    {
        return vivid > 0.0 && (x == 0.0 || x == 1.0) ? margin_of_base(map, piece, x) / vivid
                                                     : (double)INFINITY;
    }
    return (margin_of_base(map, piece, x) + 0.5 * CM_COLORMAP_CHROMA_ROUNDING) / vivid;
}

/* The saturation of the ends with which the base, at its largest in this piece, is below the limit
 * everywhere; what it leaves free grows as fast as the rest does. */
static double ends_limit(const cm_colormap *map, const cm_colormap_piece *piece, double x)
{
    (void)map;
    const double base = fmax(piece->from.base, piece->to.base);
    return base > 0.0 ? chroma_limit(piece, x) / base : (double)INFINITY;
}

/* The least between low and high, where there is one minimum: by the golden section. */
static double least_between(const cm_colormap *map, const cm_colormap_piece *piece, measure *of,
                            double low, double high)
{
    const double golden = 0.61803398874989484820;
    double left = high - golden * (high - low);
    double right = low + golden * (high - low);
    double at_left = of(map, piece, left);
    double at_right = of(map, piece, right);
    double least = fmin(at_left, at_right);
    while (high - low > 1e-10)
    {
        if (at_left < at_right)
        {
            high = right;
            right = left;
            at_right = at_left;
            left = high - golden * (high - low);
            at_left = of(map, piece, left);
        }
        else
        {
            low = left;
            left = right;
            at_left = at_right;
            right = low + golden * (high - low);
            at_right = of(map, piece, right);
        }
        least = fmin(least, fmin(at_left, at_right));
    }
    return least;
}

static double least_in_piece(const cm_colormap *map, const cm_colormap_piece *piece, measure *of)
{
    const int places = 1024;
    const double width = 1.0 / places;
    double before = (double)INFINITY;
    double here = of(map, piece, 0.0);
    double least = here;
    for (int i = 0; i <= places; i++)
    {
        const double behind = i < places ? of(map, piece, (i + 1) * width) : (double)INFINITY;
        if (here <= before && here <= behind && here < (double)INFINITY)
        {
            least = fmin(least, least_between(map, piece, of, fmax(0.0, (i - 1) * width),
                                              fmin(1.0, (i + 1) * width)));
            least = fmin(least, here);
        }
        before = here;
        here = behind;
    }
    return least;
}

static double least_on_path(const cm_colormap *map, measure *of)
{
    double least = (double)INFINITY;
    for (size_t i = 0; i < map->piece_count; i++)
    {
        least = fmin(least, least_in_piece(map, &map->piece[i], of));
    }
    return least;
}

/* Of a uniform map: how far inside the cube of linear sRGB a colour is. */
static double room(const cm_colormap *map, const cm_colormap_piece *piece, double x)
{
    double linear[3];
    cm_colormap_linear_in_piece(map, piece, x, linear);
    double least = (double)INFINITY;
    for (int i = 0; i < 3; i++)
    {
        least = fmin(least, fmin(linear[i], 1.0 - linear[i]));
    }
    return least;
}

int cm_colormap_inside(const cm_colormap *map)
{
    if (map->is_uniform)
    {
        return least_on_path(map, room) >= 0.0;
    }
    return least_on_path(map, margin) >= -CM_COLORMAP_CHROMA_ROUNDING;
}

double cm_colormap_largest_saturation(const cm_colormap *map)
{
    if (map->is_uniform)
    {
        return (double)INFINITY;
    }
    if (least_on_path(map, margin_of_base) < -CM_COLORMAP_CHROMA_ROUNDING)
    {
        return (double)NAN;
    }
    const double range = cm_colormap_value(&map->parameters, "saturation-range", 1.0);
    return fmax(least_on_path(map, strength_limit), 0.0) / range;
}

cm_status cm_colormap_fit(const cm_colormap *map, cm_colormap **fitted)
{
    if (map == NULL || fitted == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_colormap candidate = *map;
    if (!cm_colormap_inside(&candidate))
    {
        double saturation = cm_colormap_largest_saturation(&candidate);
        if (isnan(saturation))
        {
            const double ends = fmin(map->ends, least_on_path(map, ends_limit));
            cm_colormap_set_value(&candidate.parameters, "saturation-range", 1.0 - ends);
            cm_colormap_build(&candidate);
            saturation = cm_colormap_largest_saturation(&candidate);
        }
        const double given = cm_colormap_value(&map->parameters, "saturation", 0.0);
        cm_colormap_set_value(&candidate.parameters, "saturation", fmin(given, saturation));
    }
    return cm_colormap_make(&candidate.parameters, fitted);
}
