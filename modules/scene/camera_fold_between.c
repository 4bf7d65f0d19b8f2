/* SPDX-License-Identifier: MIT
 *
 * Powers of r have a part e that is the same in all directions, one that is linear in (c, s), and a square form b. Of a direction
 * between two that are d apart, with weights w of which the sum is from 1 to 1 / cos(d / 2), linear parts are exact means, and
 * the rest differs from the mean by no more than d^2 (e / 8 + 3 b / 8).
 */
#include "camera_fold_between.h"

/* Halvings of what is between two directions. */
#define HALVINGS_BETWEEN 10

/* A line is no further behind a border, and borders of neighbours that are further apart have none. */
#define LINE_ROOM 1.02
#define LINE_APART 1.05

/* The shares of d^2 above, with room for the squares of the weights. */
#define SAME_SHARE 0.127
#define FORM_SHARE 0.38

/* Polynomials of two directions in a span, the shares in which those between may differ, and how fast the latter may change. */
typedef struct pair
{
    double of[2][CM_BERNSTEIN_COEFFICIENTS];
    double same[CM_BERNSTEIN_COEFFICIENTS], form[CM_BERNSTEIN_COEFFICIENTS];
    double slope[CM_BERNSTEIN_COEFFICIENTS];
    int degree;
} pair;

typedef struct between
{
    cm_span over;
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
    cm_bernstein_halve(of->of[0], of->degree, left->of[0]);
    cm_bernstein_halve(of->of[1], of->degree, left->of[1]);
    cm_bernstein_halve(of->same, of->degree, left->same);
    cm_bernstein_halve(of->form, of->degree, left->form);
    cm_bernstein_halve(of->slope, of->degree - 1, left->slope);
}

/* Is each of the polynomials first above 0, then falling if it may, in all directions between? Pieces get lost. falls has those that
 * do; sure becomes the end of the last piece where all are above 0. */
static int look_through(between *of, int halvings, int falls[2], cm_span *sure)
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
    cm_halve_span(&of->over, &left.over, &of->over);
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
    const cm_span all = cm_fold_up_to(fold, fold->most);
    take_pair(fold, 0, one->determinant, next->determinant, square, &of->part[0]);
    take_pair(fold, 1, one->reach, next->reach, square, &of->part[1]);
    of->whole = all.t[1];
    of->over = cm_fold_up_to(fold, fmin(end, fold->most));
    if (end < fold->most)
    {
        const double t = of->over.t[1] / all.t[1];
        /* 1 - t without what cancels: (most - end) / (most (1 + end)) in units */
        const double rest = (fold->most - end) / (fold->most * (1.0 + end / fold->unit));
        for (int i = 0; i < 2 && of->part[i].degree > 0; i++)
        {
            pair *part = &of->part[i];
            cm_bernstein_keep_left(part->of[0], part->degree, t, rest);
            cm_bernstein_keep_left(part->of[1], part->degree, t, rest);
            cm_bernstein_keep_left(part->same, part->degree, t, rest);
            cm_bernstein_keep_left(part->form, part->degree, t, rest);
            cm_bernstein_keep_left(part->slope, part->degree - 1, t, rest);
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
    cm_span sure = {{0.0, 0.0}, {1.0, 1.0}};
    *is_divided = look_through(&of, HALVINGS_BETWEEN, falls, &sure) && (!may_fall || is_below);
    return cm_fold_length(fold, sure.t[1], sure.rest[1]);
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
