/* SPDX-License-Identifier: MIT
 *
 * With N and D the lens's numerator and denominator, q the square of the length r, and W = N D + 2 q (N' D - N D'), the
 * determinant of cm_lens_at in the direction (c, s) is
 *
 *   D^3 det = N W + r (g D W + (2 g + m) N D^2) + q (g (2 g + m) + h n) D^3
 *   g = p1_twice s + p2_twice c             m = 2 (c even_x + s even_y) + 4 q (c steep_x + s steep_y)
 *   h = p2_twice s - p1_twice c             n = 2 (c even_y - s even_x) + 4 q (c steep_y - s steep_x)
 */
#include "camera_fold.h"

#include <string.h>

/* Halvings until a piece is as small as doubles are; and until one in which nothing but rounding is left is looked at itself. */
#define HALVINGS_MOST 50
#define HALVINGS_CALM 16
#define ROUNDING 1e-13

/* A change between lengths that differ by no more than this factor is found by secants. */
#define NEAR 4.0

/* Evaluations between two radii: twice what halving takes. */
#define STEPS_MOST 200

/* Of a border as well as doubles tell it: rounding moves it more. */
#define SLACK 1e-15

/* Polynomials of one direction in a span. */
typedef struct piece
{
    cm_span over;
    int degree[2];
    double of[2][CM_BERNSTEIN_COEFFICIENTS];
} piece;

typedef struct search
{
    const cm_fold *fold;
    const cm_fold_ray *ray;
    int is_pole; /* is the divisor alone looked for? */
    int is_whether; /* is any place where signs are not good enough, and none near to where they change? */
} search;

/* The powers of the determinant, and of the reach, of a direction. */
static void determinant_powers(const cm_fold *fold, double c, double s, double *power)
{
    const double g = fold->twice[1] * c + fold->twice[0] * s;
    const double h = fold->twice[1] * s - fold->twice[0] * c;
    const double m0 = 2.0 * (c * fold->even[0] + s * fold->even[1]);
    const double m1 = 4.0 * (c * fold->steep[0] + s * fold->steep[1]);
    const double n0 = 2.0 * (c * fold->even[1] - s * fold->even[0]);
    const double n1 = 4.0 * (c * fold->steep[1] - s * fold->steep[0]);
    const double low = g * (2.0 * g + m0) + h * n0;
    const double high = g * m1 + h * n1;
    memset(power, 0, CM_BERNSTEIN_COEFFICIENTS * sizeof *power);
    for (int j = 0; j < CM_FOLD_RADIAL; j++)
    {
        power[2 * j] += fold->square[j];
        power[2 * j + 1] += g * fold->bent[j] + (2.0 * g + m0) * fold->drawn[j];
        power[2 * j + 3] += m1 * fold->drawn[j];
        power[2 * j + 2] += low * fold->cube[j];
        power[2 * j + 4] += high * fold->cube[j];
    }
}

static void reach_powers(const cm_fold *fold, double c, double s, double *power)
{
    const double *tilt = fold->tilt;
    const double g = fold->twice[1] * c + fold->twice[0] * s;
    const double along = tilt[0] * c + tilt[1] * s;
    const double even = tilt[0] * fold->even[0] + tilt[1] * fold->even[1];
    const double steep = tilt[0] * fold->steep[0] + tilt[1] * fold->steep[1];
    memset(power, 0, CM_BERNSTEIN_COEFFICIENTS * sizeof *power);
    for (int j = 0; j < 4; j++)
    {
        power[2 * j] += tilt[2] * fold->below[j];
        power[2 * j + 1] += along * fold->above[j];
        power[2 * j + 2] += (along * g + even) * fold->below[j];
        power[2 * j + 4] += steep * fold->below[j];
    }
}

/* What is not linear in the direction: e, and a bound of b (camera_fold_between.c), by powers. */
static void shared_powers(const cm_fold *fold, double same[2][CM_BERNSTEIN_COEFFICIENTS],
                          double form[2][CM_BERNSTEIN_COEFFICIENTS])
{
    const double *tilt = fold->tilt;
    const double twice = hypot(fold->twice[0], fold->twice[1]);
    const double low = 2.0 * twice * (twice + hypot(fold->even[0], fold->even[1]));
    const double high = 4.0 * twice * hypot(fold->steep[0], fold->steep[1]);
    const double even = tilt[0] * fold->even[0] + tilt[1] * fold->even[1];
    const double steep = tilt[0] * fold->steep[0] + tilt[1] * fold->steep[1];
    memset(same, 0, 2 * sizeof *same);
    memset(form, 0, 2 * sizeof *form);
    for (int j = 0; j < CM_FOLD_RADIAL; j++)
    {
        same[0][2 * j] += fold->square[j];
        form[0][2 * j + 2] += low * fabs(fold->cube[j]);
        form[0][2 * j + 4] += high * fabs(fold->cube[j]);
    }
    for (int j = 0; j < 4; j++)
    {
        same[1][2 * j] += tilt[2] * fold->below[j];
        same[1][2 * j + 2] += even * fold->below[j];
        same[1][2 * j + 4] += steep * fold->below[j];
        form[1][2 * j + 2] += hypot(tilt[0], tilt[1]) * twice * fabs(fold->below[j]);
    }
}

/* Good where the sign is, and what of it goes through 0 there: at a pole the determinant leaps, but not the divisor. */
static double crossing_at(const search *of, double length)
{
    const cm_lens *lens = of->fold->lens;
    const cm_lens_point at = cm_lens_at(lens, length * of->ray->cosine, length * of->ray->sine);
    return of->is_pole         ? at.divisor
           : at.divisor > 0.0  ? cm_lens_sign_there(lens, &at)
           : at.divisor <= 0.0 ? at.divisor
                               : -1.0;
}

/* Where a line through both crosses 0, moved towards the middle so that the far end comes near as well; or the middle. */
static double crossing_between(double from, double to, double at_from, double at_to, double pad)
{
    const double middle = 0.5 * (from + to);
    const double crossing = from + (to - from) * (at_from / (at_from - at_to));
    const double moved =
        crossing < middle ? fmin(crossing + pad, middle) : fmax(crossing - pad, middle);
    return moved > from && moved < to ? moved : middle;
}

/* Between a good length and one that is not: where it changes, or a little before that. By the secant, and by the middle
 * whenever that has not made much of the way. */
static double change_between(const search *of, double from, double to)
{
    double at_from = crossing_at(of, from);
    double at_to = crossing_at(of, to);
    const double slack = SLACK * to;
    double pad = 0.5 * slack;
    int is_slow = at_to > 0.0;
    int last = -1;
    for (int i = 0; i < STEPS_MOST && to - from > slack; i++)
    {
        const double width = to - from;
        const double next =
            is_slow ? 0.5 * (from + to) : crossing_between(from, to, at_from, at_to, pad);
        const double at_next = crossing_at(of, next);
        const int same = at_next > 0.0;
        from = same ? next : from;
        at_from = same ? at_next : at_from;
        to = same ? to : next;
        at_to = same ? at_to : at_next;
        pad *= same == last ? 4.0 : 1.0;
        last = same;
        is_slow = !is_slow && to - from > 0.25 * width;
    }
    return from;
}

/* Is there nothing in it but what rounding leaves of the sums of absolute values? */
static int is_rounding(const search *of, const piece *part, int which)
{
    double power[CM_BERNSTEIN_COEFFICIENTS];
    const int degree = part->degree[which];
    if (of->is_pole)
    {
        return 0;
    }
    if (which == 0)
    {
        determinant_powers(of->fold, of->ray->cosine, of->ray->sine, power);
    }
    else
    {
        reach_powers(of->fold, of->ray->cosine, of->ray->sine, power);
    }
    double most = 0.0;
    double sum = 0.0;
    double rests = 1.0;
    for (int k = degree; k >= 0; k--)
    {
        sum = sum * part->over.t[1] + fabs(power[k]) * rests;
        rests *= part->over.rest[1];
        most = fmax(most, fabs(part->of[which][k]));
    }
    return most <= ROUNDING * sum;
}

static int is_bad_at_end(const piece *part)
{
    return part->of[0][part->degree[0]] < 0.0 ||
           (part->degree[1] > 0 && part->of[1][part->degree[1]] < 0.0);
}

/* 1 and the ends between which signs change first, or 0 if they are good in all of the piece, which gets lost. */
static int find_change(const search *of, piece *part, int halvings, double change[2])
{
    int most = 0;
    for (int i = 0; i < 2; i++)
    {
        const int changes =
            part->degree[i] > 0 ? cm_bernstein_changes(part->of[i], part->degree[i]) : 0;
        most = changes > most ? changes : most;
    }
    if (most == 0)
    {
        return 0;
    }
    const double from = cm_fold_length(of->fold, part->over.t[0], part->over.rest[0]);
    const double to = cm_fold_length(of->fold, part->over.t[1], part->over.rest[1]);
    if (halvings >= HALVINGS_CALM && crossing_at(of, 0.5 * (from + to)) > 0.0 &&
        (is_rounding(of, part, 0) || (part->degree[1] > 0 && is_rounding(of, part, 1))))
    {
        return 0;
    }
    const int is_last = halvings == HALVINGS_MOST;
    const int is_asked = of->is_whether ? is_bad_at_end(part) : most == 1 && to <= NEAR * from;
    if (is_last || is_asked)
    {
        change[0] = from;
        change[1] = to;
        /* as the lens itself has it: the polynomial may be off by a rounding */
        const int is_change = !(crossing_at(of, to) > 0.0);
        if (is_last || is_change)
        {
            return is_change;
        }
    }
    piece left = {.degree = {part->degree[0], part->degree[1]}};
    cm_halve_span(&part->over, &left.over, &part->over);
    for (int i = 0; i < 2; i++)
    {
        cm_bernstein_halve(part->of[i], part->degree[i], left.of[i]);
    }
    return find_change(of, &left, halvings + 1, change) ||
           find_change(of, part, halvings + 1, change);
}

/* Of a change that is certain the first end is good, but for rounding. */
static double settle(const search *of, const double change[2])
{
    double good = change[0];
    double step = SLACK * change[1];
    while (good > 0.0 && !(crossing_at(of, good) > 0.0))
    {
        good = fmax(good - step, 0.0);
        step *= 4.0;
    }
    return change_between(of, good, change[1]);
}

/* The first zero of the divisor, before which alone the rest is looked at. */
static void find_pole(cm_fold *fold)
{
    const cm_fold_ray along = {.cosine = 1.0, .sine = 0.0};
    const search of = {fold, &along, 1, 0};
    piece whole = {.over = cm_fold_up_to(fold, fold->most), .degree = {6, 0}};
    for (int j = 0; j < 4; j++)
    {
        whole.of[0][2 * j] = fold->below[j];
    }
    cm_bernstein_from_powers(whole.of[0], 6);
    cm_bernstein_keep_left(whole.of[0], 6, whole.over.t[1], whole.over.rest[1]);
    double change[2];
    fold->has_pole = find_change(&of, &whole, 0, change);
    fold->most = fold->has_pole ? settle(&of, change) : fold->most;
}

/* No power above has a coefficient. */
static int degree_of(const double *power)
{
    int degree = CM_BERNSTEIN_DEGREE;
    while (degree > 1 && power[degree] == 0.0)
    {
        degree--;
    }
    return degree;
}

/* Products of two polynomials, of 4 and of 7 coefficients at most. */
static void multiply(const double one[4], const double *other, int count, double *product)
{
    memset(product, 0, CM_FOLD_RADIAL * sizeof *product);
    for (int i = 0; i < 4; i++)
    {
        for (int j = 0; j < count; j++)
        {
            product[i + j] += one[i] * other[j];
        }
    }
}

static double least_unit(double unit, double coefficient, double power)
{
    const double size = fabs(coefficient);
    return size > 1.0 ? fmin(unit, pow(size, -1.0 / power)) : unit;
}

/* A power of two, by which no coefficient is above 1. */
static double find_unit(const cm_lens *lens)
{
    double unit = 1.0;
    for (int i = 0; i < 6; i++)
    {
        unit = least_unit(unit, lens->k[i], 2.0 * (i % 3 + 1));
    }
    unit = least_unit(least_unit(unit, lens->p1_twice, 1.0), lens->p2_twice, 1.0);
    for (int i = 0; i < 2; i++)
    {
        unit = least_unit(least_unit(unit, lens->even[i], 1.0), lens->steep[i], 3.0);
    }
    int exponent;
    frexp(unit, &exponent);
    return ldexp(1.0, exponent - 1);
}

static void take_lens(const cm_lens *lens, cm_fold *fold)
{
    const double unit = fold->unit = find_unit(lens);
    double scale = 1.0;
    fold->above[0] = fold->below[0] = 1.0;
    for (int i = 0; i < 3; i++)
    {
        scale *= unit * unit;
        fold->above[i + 1] = lens->k[i] * scale;
        fold->below[i + 1] = lens->k[i + 3] * scale;
    }
    fold->twice[0] = lens->p1_twice * unit;
    fold->twice[1] = lens->p2_twice * unit;
    for (int i = 0; i < 2; i++)
    {
        fold->even[i] = lens->even[i] * unit;
        fold->steep[i] = lens->steep[i] * unit * unit * unit;
        fold->tilt[i] = lens->tilt[6 + i] * unit;
    }
    fold->tilt[2] = lens->tilt[8];
}

/* What does not depend on the direction. */
static void multiply_all(cm_fold *fold)
{
    double square[7] = {0.0};
    double swell[7] = {0.0};
    double product[CM_FOLD_RADIAL];
    for (int i = 0; i < 4; i++)
    {
        for (int j = 0; j < 4; j++)
        {
            square[i + j] += fold->below[i] * fold->below[j];
            swell[i + j] += (1 + 2 * (i - j)) * fold->above[i] * fold->below[j];
        }
    }
    multiply(fold->above, swell, 7, product);
    memcpy(fold->square, product, sizeof product);
    multiply(fold->below, swell, 7, fold->bent);
    multiply(fold->above, square, 7, fold->drawn);
    multiply(fold->below, square, 7, fold->cube);
}

/* The highest powers that some direction has. */
static void find_degrees(cm_fold *fold)
{
    double power[CM_BERNSTEIN_COEFFICIENTS];
    fold->degree = fold->reach_degree = 0;
    for (int i = 0; i < 8; i++)
    {
        determinant_powers(fold, cos(i + 0.3), sin(i + 0.3), power);
        const int degree = degree_of(power);
        fold->degree = degree > fold->degree ? degree : fold->degree;
        reach_powers(fold, cos(i + 0.3), sin(i + 0.3), power);
        const int reach = fold->lens->is_tilted ? degree_of(power) : 0;
        fold->reach_degree = reach > fold->reach_degree ? reach : fold->reach_degree;
    }
}

void cm_fold_prepare(const cm_lens *lens, double furthest, cm_fold *fold)
{
    memset(fold, 0, sizeof *fold);
    fold->lens = lens;
    fold->most = furthest;
    take_lens(lens, fold);
    multiply_all(fold);
    find_degrees(fold);
    find_pole(fold);
    const cm_span all = cm_fold_up_to(fold, fold->most);
    shared_powers(fold, fold->same, fold->form);
    for (int i = 0; i < 2; i++)
    {
        const int degree = i == 0 ? fold->degree : fold->reach_degree;
        cm_bernstein_from_powers(fold->same[i], degree);
        cm_bernstein_from_powers(fold->form[i], degree);
        cm_bernstein_keep_left(fold->same[i], degree, all.t[1], all.rest[1]);
        cm_bernstein_keep_left(fold->form[i], degree, all.t[1], all.rest[1]);
    }
}

void cm_fold_turn(const cm_fold *fold, double cosine, double sine, cm_fold_ray *ray)
{
    const cm_span all = cm_fold_up_to(fold, fold->most);
    ray->cosine = cosine;
    ray->sine = sine;
    determinant_powers(fold, cosine, sine, ray->determinant);
    cm_bernstein_from_powers(ray->determinant, fold->degree);
    cm_bernstein_keep_left(ray->determinant, fold->degree, all.t[1], all.rest[1]);
    ray->reach[0] = 0.0;
    if (fold->reach_degree > 0)
    {
        reach_powers(fold, cosine, sine, ray->reach);
        cm_bernstein_from_powers(ray->reach, fold->reach_degree);
        cm_bernstein_keep_left(ray->reach, fold->reach_degree, all.t[1], all.rest[1]);
    }
}

double cm_fold_first(const cm_fold *fold, const cm_fold_ray *ray)
{
    const search of = {fold, ray, 0, 0};
    piece whole = {.over = cm_fold_up_to(fold, fold->most),
                   .degree = {fold->degree, fold->reach_degree}};
    memcpy(whole.of[0], ray->determinant, ((size_t)fold->degree + 1) * sizeof(double));
    memcpy(whole.of[1], ray->reach, ((size_t)fold->reach_degree + 1) * sizeof(double));
    double change[2];
    if (find_change(&of, &whole, 0, change))
    {
        return settle(&of, change);
    }
    if (fold->has_pole)
    {
        return settle(&of, (const double[2]){fold->most, fold->most * (1.0 + 1e-12)});
    }
    return (double)INFINITY;
}

int cm_fold_is_clear(const cm_fold *fold, double cosine, double sine, double length)
{
    const cm_fold_ray ray = {.cosine = cosine, .sine = sine};
    const search of = {fold, &ray, 0, 1};
    const double end = fmin(length, fold->most);
    piece whole = {.over = cm_fold_up_to(fold, end), .degree = {fold->degree, fold->reach_degree}};
    determinant_powers(fold, cosine, sine, whole.of[0]);
    reach_powers(fold, cosine, sine, whole.of[1]);
    for (int i = 0; i < 2; i++)
    {
        cm_bernstein_from_powers(whole.of[i], whole.degree[i]);
        cm_bernstein_keep_left(whole.of[i], whole.degree[i], whole.over.t[1], whole.over.rest[1]);
    }
    double change[2];
    return (end == length || !fold->has_pole) && !find_change(&of, &whole, 0, change);
}
