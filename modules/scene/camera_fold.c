/* SPDX-License-Identifier: MIT
 *
 * With N and D the lens's numerator and denominator, q the square of the length r, and W = N D + 2 q (N' D - N D'), the
 * determinant of cm_lens_at in the direction (c, s) is
 *
 *   D^3 det = N W + r (g D W + (2 g + m) N D^2) + q (g (2 g + m) + h n) D^3
 *   g = p1_twice s + p2_twice c             m = 2 (c even_x + s even_y) + 4 q (c steep_x + s steep_y)
 *   h = p2_twice s - p1_twice c             n = 2 (c even_y - s even_x) + 4 q (c steep_y - s steep_x)
 *
 * Lengths are counted by t = r / (1 + r), which is below 1: Bernstein's coefficients up to infinity are those of powers divided by
 * binomials.
 *
 * Powers of r have a part e that is the same in all directions, one that is linear in (c, s), and a square form b. Of a direction
 * between two that are d apart, with weights w of which the sum is from 1 to 1 / cos(d / 2), linear parts are exact means, and
 * the rest differs from the mean by no more than d^2 (e / 8 + 3 b / 8).
 */
#include "camera_fold.h"

#include <string.h>

#define COEFFICIENTS (CM_FOLD_DEGREE + 1)

/* Halvings until a piece is as small as doubles are; and until one in which nothing but rounding is left is looked at itself. */
#define HALVINGS_MOST 50
#define HALVINGS_CALM 16
#define ROUNDING 1e-13

/* A change between lengths that differ by no more than this factor is found by secants. */
#define NEAR 4.0

/* Halvings of what is between two directions. */
#define HALVINGS_BETWEEN 10

/* Evaluations between two radii: twice what halving takes. */
#define STEPS_MOST 200

/* Of a border as well as doubles tell it: rounding moves it more. */
#define SLACK 1e-15

/* A line is no further behind a border, and borders of neighbours that are further apart have none. */
#define LINE_ROOM 1.02
#define LINE_APART 1.05

/* The shares of d^2 above, with room for the squares of the weights. */
#define SAME_SHARE 0.127
#define FORM_SHARE 0.38

/* Parts of lengths t, and what is left of 1. */
typedef struct span
{
    double t[2], rest[2];
} span;

/* Polynomials of one direction in a span. */
typedef struct piece
{
    span over;
    int degree[2];
    double of[2][COEFFICIENTS];
} piece;

typedef struct search
{
    const cm_fold *fold;
    const cm_fold_ray *ray;
    int is_pole; /* is the divisor alone looked for? */
    int is_whether; /* is any place where signs are not good enough, and none near to where they change? */
} search;

static double length_at(const cm_fold *fold, double t, double rest)
{
    const double furthest = fold->most;
    return t < rest * (furthest / fold->unit) ? fold->unit * (t / rest) : furthest;
}

/* Powers to Bernstein's coefficients up to infinity. */
static void from_powers(double *of, int degree)
{
    double choices = 1.0;
    for (int k = 0; k <= degree; k++)
    {
        of[k] /= choices;
        choices = choices * (degree - k) / (k + 1);
    }
}

/* De Casteljau: what is from 0 to t of the whole stays. */
static void keep_left(double *of, int degree, double t, double rest)
{
    double left[COEFFICIENTS];
    for (int j = 0; j < degree; j++)
    {
        left[j] = of[0];
        for (int i = 0; i < degree - j; i++)
        {
            of[i] = rest * of[i] + t * of[i + 1];
        }
    }
    left[degree] = of[0];
    memcpy(of, left, ((size_t)degree + 1) * sizeof *of);
}

/* The same with t = 1/2: the half before goes to left, the other stays. What is halved is halved at the end, which no rounding
 * sees. */
static void halve(double *of, int degree, double *left)
{
    double share = 1.0;
    for (int j = 0; j < degree; j++)
    {
        left[j] = share * of[0];
        for (int i = 0; i < degree - j; i++)
        {
            of[i] += of[i + 1];
        }
        of[degree - j] *= share;
        share *= 0.5;
    }
    left[degree] = of[0] *= share;
}

/* A span's halves. */
static void halve_span(const span *whole, span *left, span *right)
{
    const double t = 0.5 * (whole->t[0] + whole->t[1]);
    const double rest = 0.5 * (whole->rest[0] + whole->rest[1]);
    const span one = {{whole->t[0], t}, {whole->rest[0], rest}};
    const span next = {{t, whole->t[1]}, {rest, whole->rest[1]}};
    *left = one;
    *right = next;
}

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
    memset(power, 0, COEFFICIENTS * sizeof *power);
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
    memset(power, 0, COEFFICIENTS * sizeof *power);
    for (int j = 0; j < 4; j++)
    {
        power[2 * j] += tilt[2] * fold->below[j];
        power[2 * j + 1] += along * fold->above[j];
        power[2 * j + 2] += (along * g + even) * fold->below[j];
        power[2 * j + 4] += steep * fold->below[j];
    }
}

/* What is not linear in the direction: e, and a bound of b, by powers. */
static void shared_powers(const cm_fold *fold, double same[2][COEFFICIENTS],
                          double form[2][COEFFICIENTS])
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

/* How often coefficients change their sign: so many zeros there are at most, and one if it is one. */
static int changes_of(const double *of, int degree)
{
    int changes = of[0] > 0.0 ? 0 : 1;
    int is_below = of[0] <= 0.0;
    for (int k = 1; k <= degree; k++)
    {
        const int turns = is_below ? of[k] > 0.0 : of[k] < 0.0;
        changes += turns;
        is_below ^= turns;
    }
    return changes;
}

/* Is there nothing in it but what rounding leaves of the sums of absolute values? */
static int is_rounding(const search *of, const piece *part, int which)
{
    double power[COEFFICIENTS];
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
        const int changes = part->degree[i] > 0 ? changes_of(part->of[i], part->degree[i]) : 0;
        most = changes > most ? changes : most;
    }
    if (most == 0)
    {
        return 0;
    }
    const double from = length_at(of->fold, part->over.t[0], part->over.rest[0]);
    const double to = length_at(of->fold, part->over.t[1], part->over.rest[1]);
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
    halve_span(&part->over, &left.over, &part->over);
    for (int i = 0; i < 2; i++)
    {
        halve(part->of[i], part->degree[i], left.of[i]);
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

static span up_to(const cm_fold *fold, double length)
{
    const double units = length / fold->unit;
    const double rest = 1.0 / (1.0 + units);
    return (span){{0.0, units < 1e300 ? units * rest : 1.0}, {1.0, rest}};
}

/* The first zero of the divisor, before which alone the rest is looked at. */
static void find_pole(cm_fold *fold)
{
    const cm_fold_ray along = {.cosine = 1.0, .sine = 0.0};
    const search of = {fold, &along, 1, 0};
    piece whole = {.over = up_to(fold, fold->most), .degree = {6, 0}};
    for (int j = 0; j < 4; j++)
    {
        whole.of[0][2 * j] = fold->below[j];
    }
    from_powers(whole.of[0], 6);
    keep_left(whole.of[0], 6, whole.over.t[1], whole.over.rest[1]);
    double change[2];
    fold->has_pole = find_change(&of, &whole, 0, change);
    fold->most = fold->has_pole ? settle(&of, change) : fold->most;
}

/* No power above has a coefficient. */
static int degree_of(const double *power)
{
    int degree = CM_FOLD_DEGREE;
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
    double power[COEFFICIENTS];
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
    const span all = up_to(fold, fold->most);
    shared_powers(fold, fold->same, fold->form);
    for (int i = 0; i < 2; i++)
    {
        const int degree = i == 0 ? fold->degree : fold->reach_degree;
        from_powers(fold->same[i], degree);
        from_powers(fold->form[i], degree);
        keep_left(fold->same[i], degree, all.t[1], all.rest[1]);
        keep_left(fold->form[i], degree, all.t[1], all.rest[1]);
    }
}

void cm_fold_turn(const cm_fold *fold, double cosine, double sine, cm_fold_ray *ray)
{
    const span all = up_to(fold, fold->most);
    ray->cosine = cosine;
    ray->sine = sine;
    determinant_powers(fold, cosine, sine, ray->determinant);
    from_powers(ray->determinant, fold->degree);
    keep_left(ray->determinant, fold->degree, all.t[1], all.rest[1]);
    ray->reach[0] = 0.0;
    if (fold->reach_degree > 0)
    {
        reach_powers(fold, cosine, sine, ray->reach);
        from_powers(ray->reach, fold->reach_degree);
        keep_left(ray->reach, fold->reach_degree, all.t[1], all.rest[1]);
    }
}

double cm_fold_first(const cm_fold *fold, const cm_fold_ray *ray)
{
    const search of = {fold, ray, 0, 0};
    piece whole = {.over = up_to(fold, fold->most), .degree = {fold->degree, fold->reach_degree}};
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
    piece whole = {.over = up_to(fold, end), .degree = {fold->degree, fold->reach_degree}};
    determinant_powers(fold, cosine, sine, whole.of[0]);
    reach_powers(fold, cosine, sine, whole.of[1]);
    for (int i = 0; i < 2; i++)
    {
        from_powers(whole.of[i], whole.degree[i]);
        keep_left(whole.of[i], whole.degree[i], whole.over.t[1], whole.over.rest[1]);
    }
    double change[2];
    return (end == length || !fold->has_pole) && !find_change(&of, &whole, 0, change);
}

/* Polynomials of two directions in a span, the shares in which those between may differ, and how fast the latter may change. */
typedef struct pair
{
    double of[2][COEFFICIENTS];
    double same[COEFFICIENTS], form[COEFFICIENTS];
    double slope[COEFFICIENTS];
    int degree;
} pair;

typedef struct between
{
    span over;
    double whole; /* t up to which the polynomials were given */
    int may_fall;
    pair part[2]; /* the determinant; the reach, if its degree is not 0 */
} between;

/* square is that of how far the directions are apart. */
static void take_pair(const cm_fold *fold, int which, const double *one, const double *next,
                      double square, pair *taken)
{
    const double *same = fold->same[which];
    const double *form = fold->form[which];
    const int degree = taken->degree = which == 0 ? fold->degree : fold->reach_degree;
    for (int k = 0; k <= degree; k++)
    {
        taken->of[0][k] = one[k];
        taken->of[1][k] = next[k];
        taken->same[k] = SAME_SHARE * square * same[k];
        taken->form[k] = FORM_SHARE * square * form[k];
        taken->slope[k] = k < degree ? FORM_SHARE * square * degree * (form[k] + form[k + 1]) : 0.0;
    }
}

static int is_above(const pair *of)
{
    int is = 1;
    for (int k = 0; k <= of->degree; k++)
    {
        is &= fmin(of->of[0][k], of->of[1][k]) > fabs(of->same[k]) + of->form[k];
    }
    return is;
}

/* In a part of the whole. */
static int is_falling(const pair *of, double width)
{
    int is = 1;
    for (int k = 0; k < of->degree; k++)
    {
        const double rise = fmax(of->of[0][k + 1] - of->of[0][k], of->of[1][k + 1] - of->of[1][k]);
        const double bend = fabs(of->same[k + 1] - of->same[k]);
        is &= of->degree * (rise + bend) + width * of->slope[k] < 0.0;
    }
    return is;
}

static void split_pair(pair *of, pair *left)
{
    left->degree = of->degree;
    halve(of->of[0], of->degree, left->of[0]);
    halve(of->of[1], of->degree, left->of[1]);
    halve(of->same, of->degree, left->same);
    halve(of->form, of->degree, left->form);
    halve(of->slope, of->degree - 1, left->slope);
}

/* Is each of the polynomials first above 0, then falling if it may, in all directions between? Pieces get lost. falls has those that
 * do; sure becomes the end of the last piece where all are above 0. */
static int look_through(between *of, int halvings, int falls[2], span *sure)
{
    int is_above_all = 1;
    int is_good = 1;
    int begins[2] = {falls[0], falls[1]};
    for (int i = 0; i < 2 && of->part[i].degree > 0; i++)
    {
        const int above = !falls[i] && is_above(&of->part[i]);
        begins[i] = !above;
        is_good &= above || (of->may_fall &&
                             is_falling(&of->part[i], (of->over.t[1] - of->over.t[0]) / of->whole));
        is_above_all &= above;
    }
    if (is_good)
    {
        falls[0] = begins[0];
        falls[1] = begins[1];
        *sure = is_above_all ? of->over : *sure;
        return 1;
    }
    if (halvings == 0)
    {
        return 0;
    }
    between left;
    halve_span(&of->over, &left.over, &of->over);
    left.whole = of->whole;
    left.may_fall = of->may_fall;
    left.part[1].degree = 0;
    for (int i = 0; i < 2 && of->part[i].degree > 0; i++)
    {
        split_pair(&of->part[i], &left.part[i]);
    }
    return look_through(&left, halvings - 1, falls, sure) &&
           look_through(of, halvings - 1, falls, sure);
}

static int is_below_at_end(const between *of)
{
    int is = 0;
    for (int i = 0; i < 2 && of->part[i].degree > 0; i++)
    {
        const pair *part = &of->part[i];
        const int n = part->degree;
        const double room = fabs(part->same[n]) + part->form[n];
        is |= fmax(part->of[0][n], part->of[1][n]) + room < 0.0;
    }
    return is;
}

/* Does the divisor fall through a pole, so that there is none of the field up to a little behind it? */
static int is_simple_pole(const cm_fold *fold, double behind)
{
    const double *k = fold->below;
    int is = 1;
    for (int i = 0; i < 2; i++)
    {
        const double length = (i == 0 ? fold->most : behind) / fold->unit;
        const double q = length * length;
        is &= k[1] + q * (2.0 * k[2] + 3.0 * q * k[3]) < -1e-3 / q;
    }
    return is;
}

static void take_between(const cm_fold *fold, const cm_fold_ray *one, const cm_fold_ray *next,
                         double end, between *of)
{
    const double apart[2] = {next->cosine - one->cosine, next->sine - one->sine};
    const double square = apart[0] * apart[0] + apart[1] * apart[1];
    const span all = up_to(fold, fold->most);
    take_pair(fold, 0, one->determinant, next->determinant, square, &of->part[0]);
    take_pair(fold, 1, one->reach, next->reach, square, &of->part[1]);
    of->whole = all.t[1];
    of->over = up_to(fold, fmin(end, fold->most));
    if (end < fold->most)
    {
        const double t = of->over.t[1] / all.t[1];
        /* 1 - t without what cancels: (most - end) / (most (1 + end)) in units */
        const double rest = (fold->most - end) / (fold->most * (1.0 + end / fold->unit));
        for (int i = 0; i < 2 && of->part[i].degree > 0; i++)
        {
            pair *part = &of->part[i];
            keep_left(part->of[0], part->degree, t, rest);
            keep_left(part->of[1], part->degree, t, rest);
            keep_left(part->same, part->degree, t, rest);
            keep_left(part->form, part->degree, t, rest);
            keep_left(part->slope, part->degree - 1, t, rest);
        }
    }
}

/* Up to an end that is not 0: are they divided there? The length up to which all are above 0. */
static double look_up_to(const cm_fold *fold, const cm_fold_ray *ray[2], double end, int may_fall,
                         int *is_divided)
{
    between of;
    take_between(fold, ray[0], ray[1], fmin(end, fold->most), &of);
    of.may_fall = may_fall;
    const int is_below = is_below_at_end(&of);
    int falls[2] = {0, 0};
    span sure = {{0.0, 0.0}, {1.0, 1.0}};
    *is_divided = look_through(&of, HALVINGS_BETWEEN, falls, &sure) && (!may_fall || is_below);
    return length_at(fold, sure.t[1], sure.rest[1]);
}

cm_fold_between cm_fold_look_between(const cm_fold *fold, const cm_fold_ray *one,
                                     const cm_fold_ray *next, double one_first, double next_first)
{
    const cm_fold_ray *ray[2] = {one, next};
    const double low = fmin(one_first, next_first);
    const double high = fmax(one_first, next_first);
    const int has_none = low == (double)INFINITY;
    const int is_pole = fold->has_pole && low >= fold->most * (1.0 - 1e-12);
    cm_fold_between found = {0.0, 0.0, 0};
    if (has_none || is_pole)
    {
        found.line = has_none ? (double)INFINITY : fold->most * (1.0 + 1e-6);
        found.sure = look_up_to(fold, ray, fold->most, 0, &found.is_divided);
        found.is_divided &= has_none || is_simple_pole(fold, found.line);
        return found;
    }
    if (high <= LINE_APART * low && low > 0.0)
    {
        found.line = fmin(LINE_ROOM * high, 0.5 * (high + fold->most));
        found.sure = look_up_to(fold, ray, found.line, 1, &found.is_divided);
    }
    if (!found.is_divided && low > 0.0)
    {
        int is_all;
        found.sure = look_up_to(fold, ray, low, 0, &is_all);
    }
    return found;
}
