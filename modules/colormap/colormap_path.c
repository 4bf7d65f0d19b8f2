/* SPDX-License-Identifier: MIT
 *
 * The paths of the models through CIELUV, and their lengths; those through CAM16-UCS are made in uniform_path.
 *
 * Why chroma is linear. The paper asks of the colour at s between two anchors A and B, whose distance is D,
 *     d(s, A) = s D,    d(s, B) = (1 - s) D.
 * The two add up to D, so the triangle inequality d(A, B) <= d(A, s) + d(s, B) is an equality: the colour is
 * on the straight line from A to B, at the part s of it. With one hue the line lies in the half-plane of
 * that hue, whose coordinates are L and C, and both are linear in s. That fits the linear lightness that
 * the paper starts from; it is the solution, and the only one.
 * With several hues no C satisfies both conditions, and the paper takes the one that fails least. Here C
 * stays linear, and what the path's parameter s lacks in evenness is mended by its length.
 */
#include "colormap_path.h"

#include "color_spaces.h"

#include <math.h>
#include <stdlib.h>

/* ---- the length of a piece ---- */

/* Along a piece, x from 0 to 1, the speed is
 *     |dLUV / dx| = sqrt(a + w^2),   a = (dL / dx)^2 + (dC / dx)^2,   w = C |dH / dx|,
 * and w is linear in x. Its mean between w0 and w1 is the difference quotient of
 *     (w sqrt(a + w^2) + a asinh(w / sqrt(a))) / 2,
 * written so that nothing cancels when w0 and w1 are close: with v = sqrt(a + w^2),
 *     v1 - v0 = (w1^2 - w0^2) / (v1 + v0),
 *     asinh(w1 / sqrt(a)) - asinh(w0 / sqrt(a)) = asinh((w1^2 - w0^2) / (w1 v0 + w0 v1)). */
static double mean_speed(double a, double w0, double w1)
{
    const double v0 = sqrt(a + w0 * w0);
    const double v1 = sqrt(a + w1 * w1);
    const double sum = w0 + w1;
    const double cross = w1 * v0 + w0 * v1;
    if (!(cross > 0.0))
    {
        return v0;
    }
    const double argument = (w1 - w0) * sum / cross;
    const double part = argument == 0.0 ? 1.0 : asinh(argument) / argument;
    return 0.5 * (v1 + w0 * sum / (v0 + v1) + a * part * sum / cross);
}

/* What mean_speed takes. */
typedef struct motion
{
    double a;
    double w_from;
    double w_to;
} motion;

static motion motion_of(const cm_colormap_piece *piece)
{
    const double lightness = piece->to.lightness - piece->from.lightness;
    const double chroma = piece->chroma_to - piece->chroma_from;
    const double turn = fabs(piece->to.hue - piece->from.hue) * (CM_COLORMAP_PI / 180.0);
    return (motion){.a = lightness * lightness + chroma * chroma,
                    .w_from = turn * piece->chroma_from,
                    .w_to = turn * piece->chroma_to};
}

/* The x up to which a part of a piece's length lies. The length is convex in x where the speed grows, else
 * concave: after one of Newton's steps all others go the same way and become shorter, until rounding
 * stops that. */
static double place_of_length(const cm_colormap_piece *piece, double part)
{
    const motion m = motion_of(piece);
    if (m.w_from == m.w_to || part <= 0.0 || part >= 1.0)
    {
        return part;
    }
    const double wanted = part * piece->length;
    double x = part;
    double before = (double)INFINITY;
    for (int i = 0; i < 200; i++)
    {
        const double w = cm_colormap_mix(m.w_from, m.w_to, x);
        const double step = (x * mean_speed(m.a, m.w_from, w) - wanted) / sqrt(m.a + w * w);
        if (!(fabs(step) < before))
        {
            break;
        }
        before = fabs(step);
        x = fmin(fmax(x - step, 0.0), 1.0);
    }
    return x;
}

void cm_colormap_lch_in_piece(const cm_colormap_piece *piece, double x, double lch[3])
{
    const double hue = fmod(cm_colormap_mix(piece->from.hue, piece->to.hue, x), 360.0);
    lch[0] = cm_colormap_mix(piece->from.lightness, piece->to.lightness, x);
    lch[1] = cm_colormap_mix(piece->chroma_from, piece->chroma_to, x);
    lch[2] = hue < 0.0 ? hue + 360.0 : hue + 0.0;
    if (lch[2] >= 360.0)
    {
        lch[2] = 0.0;
    }
}

void cm_colormap_linear_in_piece(const cm_colormap *map, const cm_colormap_piece *piece, double x,
                                 double linear[3])
{
    double ucs[3];
    cm_uniform_point(&piece->uniform, x, ucs);
    cm_cam16_linear_from_ucs(&map->seen, ucs, linear);
}

/* Of t in [0, 1] the piece, and in *x the part of the way on it; beyond that the last piece goes on. */
static const cm_colormap_piece *piece_at(const cm_colormap *map, double t, double *x)
{
    const cm_colormap_piece *piece = map->piece;
    while (t > piece->t_to && piece < map->piece + map->piece_count - 1)
    {
        piece++;
    }
    const double width = piece->t_to - piece->t_from;
    const double part = width > 0.0 ? (t - piece->t_from) / width : 0.0;
    *x = map->is_uniform ? cm_uniform_place(&piece->uniform, part) : place_of_length(piece, part);
    return piece;
}

static void lch_at(const cm_colormap *map, double t, double lch[3])
{
    double x;
    const cm_colormap_piece *piece = piece_at(map, t, &x);
    cm_colormap_lch_in_piece(piece, x, lch);
}

void cm_colormap_luv_at(const cm_colormap *map, double t, double luv[3])
{
    double lch[3];
    lch_at(map, t, lch);
    cm_colormap_luv_from_lch(lch, luv);
}

/* lch, luv and linear of the colour at t in [0, 1]. */
static void take_color(const cm_colormap *map, double t, cm_colormap_color *color)
{
    if (map->is_uniform)
    {
        double x;
        const cm_colormap_piece *piece = piece_at(map, t, &x);
        cm_colormap_linear_in_piece(map, piece, x, color->linear);
        cm_colormap_luv_from_linear(color->linear, color->luv);
        cm_colormap_lch_from_luv(color->luv, color->lch);
        return;
    }
    lch_at(map, t, color->lch);
    cm_colormap_luv_from_lch(color->lch, color->luv);
    cm_colormap_linear_from_luv(color->luv, color->linear);
}

void cm_colormap_color_at(const cm_colormap *map, double t, cm_colormap_color *color)
{
    const double tolerance = 1e-9;
    if (!(t >= -tolerance && t <= 1.0 + tolerance))
    {
        for (int i = 0; i < 3; i++)
        {
            color->lch[i] = color->luv[i] = color->linear[i] = color->srgb[i] = (double)NAN;
        }
        color->inside = 0;
        return;
    }
    take_color(map, fmin(fmax(t, 0.0), 1.0), color);
    cm_colormap_srgb_from_linear(color->linear, color->srgb);
    color->inside = 1;
    for (int i = 0; i < 3; i++)
    {
        color->inside &= color->linear[i] >= -1e-9 && color->linear[i] <= 1.0 + 1e-9;
    }
}

/* ---- building a path ---- */

static void add_piece(cm_colormap *map, cm_colormap_anchor from, cm_colormap_anchor to)
{
    cm_colormap_piece *piece = &map->piece[map->piece_count++];
    *piece = (cm_colormap_piece){
        .from = from,
        .to = to,
        .chroma_from = map->strength * from.vivid + map->ends * from.base,
        .chroma_to = map->strength * to.vivid + map->ends * to.base,
    };
    const motion m = motion_of(piece);
    piece->length = mean_speed(m.a, m.w_from, m.w_to);
}

/* The hue at a place of the way, by the model. Custom hues are already unwrapped: neighbours are no more
 * than half a turn apart. */
static double hue_at(const cm_colormap *map, double place)
{
    const cm_colormap_parameters *p = &map->parameters;
    if (p->stop_count == 0)
    {
        return cm_colormap_value(p, "hue", 0.0) +
               place * 360.0 * cm_colormap_value(p, "rotations", 0.0);
    }
    size_t i = 0;
    while (i < p->stop_count && p->place[i] < place)
    {
        i++;
    }
    double hue = p->hue[0];
    for (size_t k = 1; k <= i && k < p->stop_count; k++)
    {
        const double turn = remainder(p->hue[k] - p->hue[k - 1], 360.0);
        const double reach =
            k < i ? 1.0 : (place - p->place[k - 1]) / (p->place[k] - p->place[k - 1]);
        hue += (turn == -180.0 ? 180.0 : turn) * reach;
    }
    return hue;
}

/* A sequential map by lightness at a place: at both ends the saturation is that of the ends, in the middle
 * the other. */
static cm_colormap_anchor lightness_anchor(const cm_colormap *map, double place)
{
    const double range = cm_colormap_value(&map->parameters, "lightness-range", 1.0);
    const double dark = (1.0 - range) * 100.0;
    const double light = range * 100.0;
    const double away = fabs(2.0 * place - 1.0);
    return (cm_colormap_anchor){
        .lightness = cm_colormap_mix(dark, light, place),
        .hue = hue_at(map, place),
        .vivid = (1.0 - away) * 50.0,
        .base = away * (place < 0.5 ? dark : light),
    };
}

/* Pieces between 0, 0.5, 1 and the stops. */
static void build_lightness(cm_colormap *map)
{
    const cm_colormap_parameters *p = &map->parameters;
    double place = 0.0;
    while (place < 1.0)
    {
        double next = place < 0.5 ? 0.5 : 1.0;
        for (size_t i = 0; i < p->stop_count; i++)
        {
            next = p->place[i] > place ? fmin(next, p->place[i]) : next;
        }
        add_piece(map, lightness_anchor(map, place), lightness_anchor(map, next));
        place = next;
    }
}

/* Both halves are the dark to light map of one hue, but neutral at its light end, where they meet. */
static void build_diverging_lightness(cm_colormap *map)
{
    const double divergence = cm_colormap_value(&map->parameters, "divergence", 0.0);
    cm_colormap_anchor dark = lightness_anchor(map, 0.0);
    cm_colormap_anchor middle = lightness_anchor(map, 0.5);
    cm_colormap_anchor light = lightness_anchor(map, 1.0);
    light.base = 0.0;
    add_piece(map, dark, middle);
    add_piece(map, middle, light);
    dark.hue = middle.hue = light.hue = dark.hue + divergence;
    add_piece(map, light, middle);
    add_piece(map, middle, dark);
}

static void build_constant_lightness(cm_colormap *map, cm_colormap_model model)
{
    const cm_colormap_parameters *p = &map->parameters;
    const double divergence = cm_colormap_value(p, "divergence", 0.0);
    const double lightness = cm_colormap_value(p, "lightness", 50.0);
    cm_colormap_anchor pale = {.lightness = lightness, .hue = cm_colormap_value(p, "hue", 0.0)};
    cm_colormap_anchor vivid = pale;
    cm_colormap_anchor other = pale;
    pale.base = lightness;
    vivid.vivid = other.vivid = lightness;
    other.hue += divergence;
    if (model == CM_COLORMAP_SATURATION)
    {
        add_piece(map, pale, vivid);
    }
    else if (model == CM_COLORMAP_HUES)
    {
        add_piece(map, vivid, other);
    }
    else
    {
        cm_colormap_anchor neutral = {.lightness = lightness, .hue = vivid.hue};
        add_piece(map, vivid, neutral);
        neutral.hue = other.hue;
        add_piece(map, neutral, other);
    }
}

/* The lengths of both halves of a diverging one are equal but for rounding. */
static void build_uniform(cm_colormap *map, cm_colormap_model model)
{
    cm_uniform_piece piece[CM_UNIFORM_PIECES_MAX];
    map->piece_count = cm_uniform_pieces(model, piece);
    for (size_t i = 0; i < map->piece_count; i++)
    {
        map->piece[i] =
            (cm_colormap_piece){.uniform = piece[i], .length = cm_uniform_length(&piece[i], 1.0)};
    }
    cm_cam16_prepare_srgb(&map->seen);
}

/* ---- t along the path ---- */

/* t by length. A diverging map is its own mirror image, and gets the same bits on both sides; of a uniform one only the
 * lengths of the halves are the same, not those of their pieces. */
static void set_places(cm_colormap *map)
{
    const size_t count = map->piece_count;
    double sum = 0.0;
    for (size_t i = 0; i < count; i++)
    {
        sum += map->piece[i].length;
    }
    map->length = sum;
    double passed = 0.0;
    for (size_t i = 0; i < count; i++)
    {
        cm_colormap_piece *piece = &map->piece[i];
        passed += piece->length;
        piece->t_from = i == 0 ? 0.0 : map->piece[i - 1].t_to;
        piece->t_to = sum > 0.0 ? passed / sum : (double)(i + 1) / (double)count;
        if (i + 1 == count)
        {
            piece->t_to = 1.0;
        }
        else if (map->mirrored && 2 * (i + 1) == count)
        {
            piece->t_to = 0.5;
        }
        else if (map->mirrored && !map->is_uniform && 2 * (i + 1) > count)
        {
            piece->t_to = 1.0 - map->piece[count - i - 2].t_to;
        }
    }
}

/* The direction of a piece at its beginning or its end. */
static void uniform_tangent(const cm_uniform_piece *piece, int at_end, double direction[3])
{
    cm_uniform_velocity(piece, at_end ? 1.0 : 0.0, direction);
    const double speed = hypot(direction[0], hypot(direction[1], direction[2]));
    for (int i = 0; i < 3; i++)
    {
        direction[i] /= speed;
    }
}

static void tangent(const cm_colormap *map, const cm_colormap_piece *piece, int at_end,
                    double direction[3])
{
    if (map->is_uniform)
    {
        uniform_tangent(&piece->uniform, at_end, direction);
        return;
    }
    const cm_colormap_anchor *at = at_end ? &piece->to : &piece->from;
    const double angle = at->hue * (CM_COLORMAP_PI / 180.0);
    const double turn = (piece->to.hue - piece->from.hue) * (CM_COLORMAP_PI / 180.0);
    const double outward = piece->chroma_to - piece->chroma_from;
    const double around = (at_end ? piece->chroma_to : piece->chroma_from) * turn;
    const double upward = piece->to.lightness - piece->from.lightness;
    const double speed = hypot(upward, hypot(outward, around));
    direction[0] = upward / speed;
    direction[1] = (outward * cos(angle) - around * sin(angle)) / speed;
    direction[2] = (outward * sin(angle) + around * cos(angle)) / speed;
}

static void find_corners(cm_colormap *map)
{
    for (size_t i = 0; i + 1 < map->piece_count; i++)
    {
        const double straight = 1e-9;
        double before[3];
        double behind[3];
        tangent(map, &map->piece[i], 1, before);
        tangent(map, &map->piece[i + 1], 0, behind);
        const double turn =
            hypot(before[0] - behind[0], hypot(before[1] - behind[1], before[2] - behind[2]));
        if (turn > straight)
        {
            /* both directions are of length 1, and turn is 2 sin of half the angle between them */
            const double half = fmin(0.5 * turn, 1.0);
            map->corner_sine[map->corner_count] = sqrt((1.0 - half) * (1.0 + half));
            map->corner[map->corner_count++] = map->piece[i].t_to;
        }
    }
}

void cm_colormap_build(cm_colormap *map)
{
    const cm_colormap_parameters *p = &map->parameters;
    const cm_colormap_model model = (cm_colormap_model)p->index;
    const double range = cm_colormap_value(p, "saturation-range", 1.0);
    map->strength = range * cm_colormap_value(p, "saturation", 0.0);
    map->ends = 1.0 - range;
    map->is_uniform = cm_colormap_at(p->index)->space == CM_COLORMAP_CAM16_UCS;
    map->piece_count = 0;
    map->corner_count = 0;
    switch (model)
    {
    case CM_COLORMAP_SINGLE:
    case CM_COLORMAP_RAINBOW:
    case CM_COLORMAP_CUSTOM:
        build_lightness(map);
        break;
    case CM_COLORMAP_DIVERGING_LIGHTNESS:
        build_diverging_lightness(map);
        break;
    case CM_COLORMAP_SATURATION:
    case CM_COLORMAP_DIVERGING_SATURATION:
    case CM_COLORMAP_HUES:
        build_constant_lightness(map, model);
        break;
    default:
        build_uniform(map, model);
        break;
    }
    map->mirrored = cm_colormap_at(p->index)->family == CM_COLORMAP_DIVERGING;
    set_places(map);
    find_corners(map);
}

cm_status cm_colormap_make(const cm_colormap_parameters *parameters, cm_colormap **map)
{
    cm_colormap *made = malloc(sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    *made = (cm_colormap){.parameters = *parameters};
    cm_colormap_build(made);
    *map = made;
    return CM_OK;
}
