/* SPDX-License-Identifier: MIT
 *
 * Where n samples are, so that neighbours are equally far apart in the map's space, across corners too.
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
 * A walk from the beginning, which takes the first place behind the corner that is far enough away, does not
 * suffice: where phi < 90 degrees, a may exceed 1, and there are two such places; the walk that always takes
 * the same of them jumps when the step grows, and for about every second n of a map with a sharp corner
 * comes to t = 1 with no step at all. But the ways across a corner are all on one curve, and along it these
 * numbers of the corner are continuous:
 *     m     its number in a count of samples that is half way between those of its two sides. If sample
 *           N = floor(m) is the last before it, p = 2 (m - N) - 1
 *     g     1 - s, of period 1 in m, 0 for a whole m. Seen from before the corner has the number m - g / 2,
 *           from behind m + g / 2.
 * With the corners at c_k, parts of the whole way, and X the number at its end, the equations of the runs
 * between them,
 *     (m_k - g_k / 2) - (m_j + g_j / 2) = (c_k - c_j) q,    j = k - 1,  m_0 = g_0 = 0,  m_end = X,
 * add up to q = X - sum of g, the number of steps that the whole way is long, and give
 *     m_k = c_k (X - sum of g_j) + sum of g_j with j < k + g_k / 2.
 * The right side is continuous in m, and bounded as g is, so there is a solution (Brouwer). With few corners
 * Newton's method finds it; with many, it is tried from several places, and in turn with walks, of all q and
 * with other choices at the corners, of which neighbours end on both sides of X.
 *
 * Pieces with several hues are curved. So the length of the line is then taken from the path itself, s
 * corrected by what it lacks, and the equations are solved again.
 */
#include "plan.h"

#include <math.h>

/* With more than 150 degrees between the directions before and behind, which leaves less than this of
 * sin(phi/2), a corner is a fold rather than a corner, and the tip that is cut off may be several steps long. */
#define SHARP 0.25881904510252076

/* So many times the largest leg must fit beside such a corner, or it is passed over as if there were none: a
 * map that loses more of its most vivid colours is worse than one with a short step. */
#define FOLD_ROOM 16.0

/* With more of sin(phi/2) a step across the corner is short by less than 1e-12 of itself. */
#define FLAT (1.0 - 1e-12)

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
    double legs; /* what a walk has for u: the difference of the legs it took */
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
    double last;   /* the number of the last sample */
    size_t count;
    bend corner[CM_COLORMAP_PIECES_MAX];
} way;

/* ---- the equations ---- */

/* s = cos(x) / sine and p = sin(x) / cosine run over the ellipse of solutions, so that no slope is ever
 * infinite. */
static void set_place(bend *c, double u)
{
    const double whole = floor(u);
    const double swing = 2.0 * (u - whole) - 1.0;
    c->u = u;
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

typedef double matrix[CM_COLORMAP_PIECES_MAX][CM_COLORMAP_PIECES_MAX];

/* Make row k that of those from k on that has the largest element in column k. */
static void bring_pivot(size_t count, size_t k, matrix left, double right[])
{
    size_t pivot = k;
    for (size_t i = k + 1; i < count; i++)
    {
        pivot = fabs(left[i][k]) > fabs(left[pivot][k]) ? i : pivot;
    }
    for (size_t j = k; j < count; j++)
    {
        const double element = left[k][j];
        left[k][j] = left[pivot][j];
        left[pivot][j] = element;
    }
    const double element = right[k];
    right[k] = right[pivot];
    right[pivot] = element;
}

/* Solve linear equations by elimination; right becomes the solution, or something finite if there is none. */
static void eliminate(size_t count, matrix left, double right[])
{
    for (size_t k = 0; k < count; k++)
    {
        bring_pivot(count, k, left, right);
        left[k][k] = copysign(fmax(fabs(left[k][k]), 1e-12), left[k][k]);
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
}

static void newton_step(const way *w, const double failure[], double step[])
{
    matrix left;
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
    eliminate(w->count, left, step);
}

/* Go along a step, or half of it, a quarter, ... so that that brings the way closer, and never far. */
static void go(way *w, const double step[], double failure[], double *worst)
{
    const double worst_before = *worst;
    double before[CM_COLORMAP_PIECES_MAX];
    double longest = 0.5;
    for (size_t k = 0; k < w->count; k++)
    {
        before[k] = w->corner[k].u;
        longest = fmax(longest, fabs(step[k]));
    }
    double part = 0.5 / longest;
    do
    {
        for (size_t k = 0; k < w->count; k++)
        {
            set_place(&w->corner[k], before[k] + part * step[k]);
        }
        take_failure(w, failure, worst);
        part *= 0.5;
    } while (!(*worst < worst_before) && part > 1e-3);
}

/* The whole number of the last sample before a corner. */
static double last_before(const bend *c)
{
    return c->base + floor(c->u);
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
    return before + 1.0 <= w->last;
}

/* Newton's method from where the way is. Is it a solution then, and has it room? */
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
    double before = (double)INFINITY;
    while (worst > good && worst < 0.98 * before)
    {
        newton_step(w, failure, step);
        before = worst;
        go(w, step, failure, &worst);
    }
    return worst <= good && has_room(w);
}

/* ---- a solution from nowhere ---- */

/* Where the way goes at a corner that has the number x from before. The place behind it that is a step away
 * from the last sample before it is the only one, or there is a choice: to go without the last samples
 * before it, at most so many, and then to the further or the nearer of two places. */
typedef struct choice
{
    int left_out;
    int is_near;
} choice;

static void cross(bend *c, double x, choice wanted)
{
    const double phi_cosine = 1.0 - 2.0 * c->sine * c->sine;
    const double phi_sine = 2.0 * c->sine * c->cosine;
    const double straight = x - 0.5 * c->more;
    double last = floor(straight);
    double a = straight - last;
    double side = 1.0;
    for (int i = 0; i < wanted.left_out && phi_cosine > 0.0 && (a + 1.0) * phi_sine < 1.0; i++)
    {
        last -= 1.0;
        a += 1.0;
        side = wanted.is_near ? -1.0 : 1.0;
    }
    const double b = a * phi_cosine + side * sqrt(1.0 - a * phi_sine * (a * phi_sine));
    c->base = last;
    c->legs = a - b;
    c->g = 1.0 - a - b - c->more;
}

/* Where the last walk went, as a position on the curve; of the many walks before it nobody asks. */
static void take_walk(way *w)
{
    for (size_t k = 0; k < w->count; k++)
    {
        bend *c = &w->corner[k];
        const double swing = asin(fmin(fmax(c->legs * c->cosine, -1.0), 1.0)) / c->span;
        c->u = fmin(fmax(0.5 + 0.5 * swing, 0.0), 1.0);
    }
}

/* How far beyond the end a walk of q steps comes. */
static double overshoot(way *w, double q, const choice choices[])
{
    double passed = 0.0;
    for (size_t k = 0; k < w->count; k++)
    {
        cross(&w->corner[k], w->corner[k].at * q + passed, choices[k]);
        passed += w->corner[k].g;
    }
    return q + passed - w->number;
}

/* From a walk that comes too short and one that comes too far to one that comes to the end, and from there
 * to the solution. It fails where the walk jumps over the end. */
static int close_in(way *w, double too_short, double too_far, const choice choices[])
{
    double past = (double)INFINITY;
    for (int i = 0; i < 60 && fabs(past) > 1e-9; i++)
    {
        const double middle = 0.5 * (too_short + too_far);
        past = overshoot(w, middle, choices);
        *(past < 0.0 ? &too_short : &too_far) = middle;
    }
    if (!(fabs(past) < 1e-3))
    {
        return 0;
    }
    take_walk(w);
    return improve(w);
}

/* The same numbers at each call. */
static uint32_t any_number(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

/* Walks of all lengths that come into question, with some choices. */
static int walk_over(way *w, uint32_t *state)
{
    const int walks = 64;
    double most = 0.0;
    choice choices[CM_COLORMAP_PIECES_MAX];
    for (size_t k = 0; k < w->count; k++)
    {
        const bend *c = &w->corner[k];
        const uint32_t leaps = (uint32_t)fmin(0.5 / (c->sine * c->cosine), 20.0);
        const uint32_t number = any_number(state) % (2 * leaps + 1);
        choices[k] = (choice){.left_out = (int)((number + 1) / 2), .is_near = number % 2 == 0};
        most += 1.0 / c->sine - 1.0 + fabs(c->more);
    }
    double before = w->number;
    double past_before = overshoot(w, before, choices);
    for (int i = 1; i <= walks; i++)
    {
        const double here = w->number + most * i / walks;
        const double past = overshoot(w, here, choices);
        if ((past < 0.0) != (past_before < 0.0) &&
            close_in(w, past < 0.0 ? here : before, past < 0.0 ? before : here, choices))
        {
            return 1;
        }
        before = here;
        past_before = past;
    }
    return 0;
}

/* From where the corners would be if none swallowed anything, or so far away. */
static int leap_in(way *w, double spread, uint32_t *state)
{
    for (size_t k = 0; k < w->count; k++)
    {
        bend *c = &w->corner[k];
        const double m = c->at * w->number + spread * ((double)any_number(state) / 0x1p24 - 0.5);
        c->base = floor(m);
        c->u = m - c->base;
    }
    return improve(w);
}

/* From the solution before, or from anywhere. */
static int solve(way *w, int anew)
{
    uint32_t state = 1;
    if (anew ? leap_in(w, 0.0, &state) : improve(w))
    {
        return 1;
    }
    for (int attempt = 0; attempt < 40; attempt++)
    {
        if (walk_over(w, &state) || leap_in(w, 3.0, &state) || leap_in(w, 3.0, &state))
        {
            return 1;
        }
    }
    return 0;
}

/* ---- the lines across corners ---- */

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

/* Only maps in CIELUV have corners to ask about: that of a uniform map is its middle, about which it is the same both ways. */
static void point_at(const cm_colormap *map, double t, double luv[3])
{
    cm_colormap_luv_at(map, fmin(fmax(t, 0.0), 1.0), luv);
}

/* The length of the line between two points, in steps. */
static double line_between(const cm_colormap *map, double step, const double one[3],
                           const double other[3])
{
    return hypot(one[0] - other[0], hypot(one[1] - other[1], one[2] - other[2])) /
           (step * map->length);
}

/* How much shorter the line across a corner is than those of the steps beside it, each of which counts as much
 * as its leg: where one of the legs vanishes, so does what is to be corrected. */
static double shortage(const cm_colormap *map, const way *w, const bend *c)
{
    const double step = step_of(w);
    const double t = c->at * w->end;
    double legs[2];
    legs_of(c, legs);
    /* the ends of the line across, and the corner between the ends of two whole steps */
    double end[2][3];
    double place[3][3];
    point_at(map, t - legs[0] * step, end[0]);
    point_at(map, t + legs[1] * step, end[1]);
    point_at(map, t - step, place[0]);
    point_at(map, t, place[1]);
    point_at(map, t + step, place[2]);
    const double across = line_between(map, step, end[0], end[1]);
    const double before = line_between(map, step, place[0], place[1]);
    const double behind = line_between(map, step, place[1], place[2]);
    return (legs[0] * before + legs[1] * behind) / (legs[0] + legs[1]) - across;
}

/* Correct each corner by a part of what the line across it lacks. Returns the worst of that. The limits are
 * far beyond what a solution has; where samples are few and nothing fits they keep numbers sane. */
static double correct(const cm_colormap *map, way *w, double part)
{
    double lacks[CM_COLORMAP_PIECES_MAX];
    double worst = 0.0;
    for (size_t k = 0; k < w->count; k++)
    {
        lacks[k] = shortage(map, w, &w->corner[k]);
        worst = fmax(worst, fabs(lacks[k]));
    }
    for (size_t k = 0; k < w->count; k++)
    {
        bend *c = &w->corner[k];
        const double change = part * lacks[k] / (c->sine * c->sine * (1.0 - c->g));
        c->more = fmin(fmax(c->more + change, -0.5), 1.0);
    }
    return worst;
}

/* The whole correction overshoots where m comes past a whole number; then a smaller part is taken. */
static int arrange(const cm_colormap *map, way *w)
{
    double part = 1.0;
    double before = (double)INFINITY;
    double worst = (double)INFINITY;
    for (int i = 0; i < 60 && worst > 1e-9; i++)
    {
        if (!solve(w, i == 0))
        {
            return 0;
        }
        before = worst;
        worst = correct(map, w, part);
        part *= worst < 0.8 * before ? 1.0 : 0.7;
    }
    return worst < EVEN_ENOUGH;
}

/* ---- the plan ---- */

static bend bend_at(const cm_colormap *map, size_t index, double end)
{
    const double sine = map->corner_sine[index];
    const double cosine = sqrt(1.0 - sine * sine);
    return (bend){.at = map->corner[index] / end,
                  .sine = sine,
                  .cosine = cosine,
                  .span = atan2(cosine, sine)};
}

/* Is the corner a fold without enough room for so many samples, or so flat that there is nothing to mend? The
 * longest leg of a fold is 1 / sin(phi). */
static int is_passed_over(const cm_colormap *map, size_t n, size_t index, int no_folds)
{
    const double sine = map->corner_sine[index];
    const double before = index == 0 ? 0.0 : map->corner[index - 1];
    const double behind = index + 1 == map->corner_count ? 1.0 : map->corner[index + 1];
    const double room = fmin(map->corner[index] - before, behind - map->corner[index]);
    const double both = 2.0 * sine * sqrt(1.0 - sine * sine);
    return sine > FLAT || (sine < SHARP && (no_folds || both * room * (double)(n - 1) < FOLD_ROOM));
}

/* The corners that the samples of 0 to w->end meet. A mirrored map is solved up to its middle, which is
 * sample (n - 1) / 2, or half way between two; then both are as far from it as its corner asks. */
static void set_out(const cm_colormap *map, size_t n, int no_folds, way *w)
{
    w->end = map->mirrored ? 0.5 : 1.0;
    w->number = (double)(n - 1) * w->end;
    w->last = floor(w->number);
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

/* The run that begins behind a corner, or on it, where rounding is all that is between. */
static cm_colormap_run run_behind(const way *w, const bend *c)
{
    const double snap = 1e-9;
    const double corner = c->at * w->end;
    const double step = step_of(w);
    const size_t last = (size_t)last_before(c);
    double legs[2];
    legs_of(c, legs);
    if (fabs(legs[0]) * step < snap)
    {
        return (cm_colormap_run){.first = last, .t = corner};
    }
    const double behind = legs[1] * step;
    return (cm_colormap_run){.first = last + 1,
                             .t = fabs(behind) < snap ? corner : corner + behind};
}

void cm_colormap_make_plan(const cm_colormap *map, size_t n, cm_colormap_plan *plan)
{
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
        plan->run[plan->run_count++] = run_behind(&w, &w.corner[k]);
    }
}

/* How many steps it is from t = 0 to t = 1 where all are equal. What goes round does not come to its first
 * colour again, nor closer to it than a step. */
static double steps_of(const cm_colormap *map, size_t n)
{
    const double circle = cm_colormap_value(&map->parameters, "divergence", 0.0) / 360.0;
    if (cm_colormap_at(map->parameters.index)->family == CM_COLORMAP_CYCLIC)
    {
        return (double)n;
    }
    return map->parameters.index == CM_COLORMAP_HUES && circle * (double)n > (double)(n - 1)
               ? (double)n * circle
               : (double)(n - 1);
}

double cm_colormap_place(const cm_colormap *map, const cm_colormap_plan *plan, size_t index)
{
    const size_t n = plan->n;
    if (n == 1)
    {
        return 0.0;
    }
    if (!plan->is_even)
    {
        return (double)index / steps_of(map, n);
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
