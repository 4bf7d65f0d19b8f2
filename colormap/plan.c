/* SPDX-License-Identifier: MIT
 *
 * Where n samples are, so that neighbours are equally far apart in CIELUV, across corners too.
 *
 * Between two corners the path is smooth, and equal steps of its length are equal distances. Across a corner
 * the straight line from sample to sample is a shortcut, so these two must be further apart along the path,
 * by as much as makes the line as long as the others. With distances in units of that step, a from the last
 * sample before the corner to it, b from it to the first sample behind it, and the angle phi inside the
 * corner,
 *     a^2 + b^2 - 2 a b cos(phi) = 1,
 * or, with p = a - b, in [-1, 1], and s = a + b,
 *     s^2 sin^2(phi/2) + p^2 cos^2(phi/2) = 1.
 * A corner thus swallows s - 1 >= 0 of the path.
 *
 * A walk from the beginning, which takes the first place behind the corner that is far enough away, cannot
 * serve: where phi < 90 degrees, a may exceed 1, and there are two such places; the walk that always takes
 * one of them jumps when the step grows, and for many n ends beyond t = 1 or before it with every step. But
 * all solutions lie on one curve, and what is continuous along it are these numbers of a corner:
 *     m     its number in a count of samples that is half way between those of its two sides. If sample
 *           N = floor(m) is the last before it, p = 2 (m - N) - 1
 *     g     1 - s, of period 1 in m, 0 for a whole m. Seen from before the corner has the number m - g / 2,
 *           from behind m + g / 2.
 * With the corners at c_k, parts of the whole way, and X the number at its end, the equations of the runs
 * between them,
 *     (m_k - g_k / 2) - (m_j + g_j / 2) = (c_k - c_j) q,    j = k - 1,  m_0 = g_0 = 0,  m_end = X,
 * add up to q = X - sum of g, the number of steps that the whole way is long, and give
 *     m_k = c_k (X - sum of g_j) + sum of g_j with j < k + g_k / 2.
 * The right side is continuous in m, and bounded as g is, so there is a solution (Brouwer). It is looked for
 * with Newton's method, from several places if need be.
 *
 * Pieces with several hues are curved. So the length of the line is then taken from the path itself, s
 * corrected by what it lacks, and the equations are solved again.
 */
#include "internal.h"

#include <math.h>

/* With more than 150 degrees between the directions before and behind, which leaves less than this of
 * sin(phi/2), a corner is a fold rather than a corner, and the tip that is cut off may be several steps long. */
#define SHARP 0.25881904510252076

/* So many times the largest leg must fit beside such a corner, or it is passed over as if there were none: a
 * map that loses more of its most vivid colours is worse than one with a short step. */
#define FOLD_ROOM 16.0

/* What is left of the difference between a step across a corner and the others. */
#define EVEN_ENOUGH 1e-3

/* A corner, and what is sought of it. */
typedef struct bend
{
    double at;   /* part of the way */
    double sine; /* of half the angle inside, and its cosine */
    double cosine;
    double span; /* asin(cosine) */
    double more; /* what s is above that of two straight legs */
    double base; /* a whole number close to m */
    double u;    /* position on the curve of solutions, above base; whole where m is */
    double m;    /* above base */
    double g;
    double dm; /* by du */
    double dg;
} bend;

/* The part of a map that is solved at once: the whole, or the first half of a mirrored one. */
typedef struct way
{
    double end;    /* t */
    double number; /* X */
    size_t count;
    bend corner[CM_COLORMAP_PIECES_MAX];
} way;

/* s = cos(x) / sine and p = sin(x) / cosine run over the ellipse of solutions, so that no slope is ever
 * infinite. */
static void set_place(bend *c, double u)
{
    const double whole = floor(u);
    const double swing = 2.0 * (u - whole) - 1.0;
    c->u = u;
    if (c->cosine < 1e-6)
    {
        c->m = u;
        c->dm = 1.0;
        c->g = -c->more;
        c->dg = 0.0;
        return;
    }
    const double x = c->span * swing;
    c->m = whole + 0.5 + 0.5 * sin(x) / c->cosine;
    c->dm = c->span * cos(x) / c->cosine;
    c->g = 1.0 - cos(x) / c->sine - c->more;
    c->dg = 2.0 * c->span * sin(x) / c->sine;
}

/* How far the equations are from being solved: *worst is the largest of failure[]. */
static void take_failure(const way *w, double failure[], double *worst)
{
    double sum = 0.0;
    for (size_t k = 0; k < w->count; k++)
    {
        sum += w->corner[k].g;
    }
    double passed = 0.0;
    *worst = 0.0;
    for (size_t k = 0; k < w->count; k++)
    {
        const bend *c = &w->corner[k];
        failure[k] = c->m + c->base - c->at * (w->number - sum) - passed - 0.5 * c->g;
        passed += c->g;
        *worst = fmax(*worst, fabs(failure[k]));
    }
}

/* Solve the equations of Newton's step by elimination; right becomes the step. */
static int eliminate(size_t count, double left[][CM_COLORMAP_PIECES_MAX], double right[])
{
    for (size_t k = 0; k < count; k++)
    {
        size_t pivot = k;
        for (size_t i = k + 1; i < count; i++)
        {
            pivot = fabs(left[i][k]) > fabs(left[pivot][k]) ? i : pivot;
        }
        if (!(fabs(left[pivot][k]) > 1e-12))
        {
            return 0;
        }
        for (size_t j = k; j < count; j++)
        {
            const double swapped = left[k][j];
            left[k][j] = left[pivot][j];
            left[pivot][j] = swapped;
        }
        const double swapped = right[k];
        right[k] = right[pivot];
        right[pivot] = swapped;
        for (size_t i = k + 1; i < count; i++)
        {
            const double factor = left[i][k] / left[k][k];
            for (size_t j = k; j < count; j++)
            {
                left[i][j] -= factor * left[k][j];
            }
            right[i] -= factor * right[k];
        }
    }
    for (size_t k = count; k-- > 0;)
    {
        for (size_t j = k + 1; j < count; j++)
        {
            right[k] -= left[k][j] * right[j];
        }
        right[k] /= left[k][k];
    }
    return 1;
}

static int newton_step(const way *w, const double failure[], double step[])
{
    double left[CM_COLORMAP_PIECES_MAX][CM_COLORMAP_PIECES_MAX];
    for (size_t k = 0; k < w->count; k++)
    {
        for (size_t j = 0; j < w->count; j++)
        {
            const double before = j < k ? 1.0 : j == k ? 0.5 : 0.0;
            left[k][j] = (w->corner[k].at - before) * w->corner[j].dg;
        }
        left[k][k] += w->corner[k].dm;
        step[k] = -failure[k];
    }
    return eliminate(w->count, left, step);
}

/* From where it is, as long as that brings it closer. A part of a step is taken where the whole one does
 * not, and no step goes far. */
static int improve(way *w)
{
    const double good = 1e-12 + 1e-15 * w->number;
    double failure[CM_COLORMAP_PIECES_MAX];
    double step[CM_COLORMAP_PIECES_MAX];
    double worst;
    for (size_t k = 0; k < w->count; k++)
    {
        set_place(&w->corner[k], w->corner[k].u); /* more may be another */
    }
    take_failure(w, failure, &worst);
    for (int i = 0; i < 60 && worst > good; i++)
    {
        double before[CM_COLORMAP_PIECES_MAX];
        double longest = 0.5;
        if (!newton_step(w, failure, step))
        {
            return 0;
        }
        for (size_t k = 0; k < w->count; k++)
        {
            before[k] = w->corner[k].u;
            longest = fmax(longest, fabs(step[k]));
        }
        const double worst_before = worst;
        double part = 0.5 / longest;
        do
        {
            for (size_t k = 0; k < w->count; k++)
            {
                set_place(&w->corner[k], before[k] + part * step[k]);
            }
            take_failure(w, failure, &worst);
            part *= 0.5;
        } while (!(worst < worst_before) && part > 1e-3);
        if (!(worst < worst_before))
        {
            return 0;
        }
    }
    return worst <= good;
}

/* A solution, at first near where the corners would be if none swallowed anything. */
static int solve(way *w, int anew)
{
    uint32_t state = 1;
    if (!anew && improve(w))
    {
        return 1;
    }
    for (int attempt = 0; attempt < 200; attempt++)
    {
        for (size_t k = 0; k < w->count; k++)
        {
            bend *c = &w->corner[k];
            const double m = c->at * w->number;
            state = state * 1664525u + 1013904223u;
            const double away = attempt == 0 ? 0.0 : (double)(state >> 8) / 0x1p24 - 0.5;
            c->base = floor(m);
            set_place(c, m - c->base + (attempt < 20 ? 1.0 : 3.0) * away);
        }
        if (improve(w))
        {
            return 1;
        }
    }
    return 0;
}

/* The whole number of the last sample before a corner. */
static double last_before(const bend *c)
{
    return c->base + floor(c->u);
}

/* a and b. */
static void legs_of(const bend *c, double legs[2])
{
    const double p = 2.0 * (c->m - floor(c->u)) - 1.0;
    legs[0] = 0.5 * (1.0 - c->g + p);
    legs[1] = 0.5 * (1.0 - c->g - p);
}

static double step_of(const way *w)
{
    double steps = w->number;
    for (size_t k = 0; k < w->count; k++)
    {
        steps -= w->corner[k].g;
    }
    return w->end / steps;
}

/* Correct each corner by the line across it. Returns how far the worst line is from the step, as a part of
 * it; infinite if there is no room. */
static double correct(const cm_colormap *map, way *w)
{
    const double step = step_of(w);
    double worst = 0.0;
    for (size_t k = 0; k < w->count; k++)
    {
        bend *c = &w->corner[k];
        double legs[2];
        double from[3];
        double to[3];
        legs_of(c, legs);
        const double t = c->at * w->end;
        if (!(t - legs[0] * step >= 0.0 && t + legs[1] * step <= 1.0))
        {
            return (double)INFINITY;
        }
        cm_colormap_luv_at(map, t - legs[0] * step, from);
        cm_colormap_luv_at(map, t + legs[1] * step, to);
        const double line =
            hypot(from[0] - to[0], hypot(from[1] - to[1], from[2] - to[2])) / (step * map->length);
        c->more += (1.0 - line) / (c->sine * c->sine * (legs[0] + legs[1]));
        worst = fmax(worst, fabs(1.0 - line));
    }
    return worst;
}

/* Is there a sample before the first corner, behind the last, and between any two? */
static int has_room(const way *w)
{
    double before = -1.0;
    for (size_t k = 0; k < w->count; k++)
    {
        const double last = last_before(&w->corner[k]);
        if (last < before + 1.0)
        {
            return 0;
        }
        before = last;
    }
    return before + 1.0 <= w->number;
}

static int arrange(const cm_colormap *map, way *w)
{
    double worst = (double)INFINITY;
    for (int i = 0; i < 30; i++)
    {
        if (!solve(w, i == 0) || !has_room(w))
        {
            return 0;
        }
        worst = correct(map, w);
        if (worst < 1e-9 || !(worst < (double)INFINITY))
        {
            break;
        }
    }
    return worst < EVEN_ENOUGH;
}

/* ---- the plan ---- */

static bend bend_at(const cm_colormap *map, size_t index, double end)
{
    const double sine = map->corner_sine[index];
    const double cosine = sqrt(fmax(0.0, 1.0 - sine * sine));
    return (bend){.at = map->corner[index] / end,
                  .sine = sine,
                  .cosine = cosine,
                  .span = atan2(cosine, sine)};
}

/* Is the corner a fold without enough room for so many samples? The longest leg is 1 / sin(phi). */
static int is_passed_over(const cm_colormap *map, size_t n, size_t index, int no_folds)
{
    const double sine = map->corner_sine[index];
    const double before = index == 0 ? 0.0 : map->corner[index - 1];
    const double behind = index + 1 == map->corner_count ? 1.0 : map->corner[index + 1];
    const double room = fmin(map->corner[index] - before, behind - map->corner[index]);
    const double both = 2.0 * sine * sqrt(fmax(0.0, 1.0 - sine * sine));
    return sine < SHARP && (no_folds || both * room * (double)(n - 1) < FOLD_ROOM);
}

/* The corners that the samples of 0 to w->end meet. A mirrored map is solved up to its middle, which is
 * sample (n - 1) / 2, or half way between two; then both are as far from it as its corner asks. */
static void set_out(const cm_colormap *map, size_t n, int no_folds, way *w)
{
    w->end = map->mirrored ? 0.5 : 1.0;
    w->number = (double)(n - 1) * w->end;
    w->count = 0;
    for (size_t i = 0; i < map->corner_count && map->corner[i] <= w->end; i++)
    {
        if (is_passed_over(map, n, i, no_folds))
        {
            continue;
        }
        if (map->corner[i] < w->end)
        {
            w->corner[w->count++] = bend_at(map, i, w->end);
        }
        else if (n % 2 == 0)
        {
            w->number += 0.5 * (1.0 / map->corner_sine[i] - 1.0);
        }
    }
}

void cm_colormap_make_plan(const cm_colormap *map, size_t n, cm_colormap_plan *plan)
{
    const double snap = 1e-9;
    const double most = 0x1p32; /* above that rounding is no longer small beside a step */
    way w;
    *plan = (cm_colormap_plan){.n = n};
    if (n < 2 || (double)n > most || map->corner_count == 0)
    {
        return;
    }
    set_out(map, n, 0, &w);
    plan->is_even = arrange(map, &w);
    if (!plan->is_even)
    {
        set_out(map, n, 1, &w);
        plan->is_even = arrange(map, &w);
    }
    if (!plan->is_even)
    {
        return;
    }
    plan->mirrored = map->mirrored;
    plan->step = step_of(&w);
    plan->run_count = 1;
    for (size_t k = 0; k < w.count; k++)
    {
        const bend *c = &w.corner[k];
        const double t = c->at * w.end;
        const size_t last = (size_t)last_before(c);
        double legs[2];
        legs_of(c, legs);
        const int is_on = fabs(legs[0]) * plan->step < snap;
        const int is_on_behind = fabs(legs[1]) * plan->step < snap;
        plan->run[plan->run_count++] =
            (cm_colormap_run){.first = is_on ? last : last + 1,
                              .t = is_on || is_on_behind ? t : t + legs[1] * plan->step};
    }
}

double cm_colormap_place(const cm_colormap *map, const cm_colormap_plan *plan, size_t index)
{
    const size_t n = plan->n;
    const double last = (double)(n - 1);
    if (n == 1)
    {
        return 0.0;
    }
    if (!plan->is_even)
    {
        const double circle = cm_colormap_value(&map->parameters, "divergence", 0.0) / 360.0;
        const int goes_round =
            map->parameters.index == CM_COLORMAP_HUES && circle * (double)n > last;
        return (double)index / (goes_round ? (double)n * circle : last);
    }
    if (plan->mirrored && index >= n - 1 - index)
    {
        return index == n - 1 - index ? 0.5 : 1.0 - cm_colormap_place(map, plan, n - 1 - index);
    }
    if (index == n - 1)
    {
        return 1.0;
    }
    size_t run = plan->run_count - 1;
    while (plan->run[run].first > index)
    {
        run--;
    }
    return plan->run[run].t + (double)(index - plan->run[run].first) * plan->step;
}
