/* SPDX-License-Identifier: MIT */
#include "camera_field.h"

#include <stddef.h>
#include <stdint.h>

/* Along a direction signs are looked at in steps of an eighth of an octave, from 1e-4 to 4e5. */
#define STEPS (4 * CM_CAMERA_BLOCK)
#define FIRST 1e-4
#define STEPS_OF_OCTAVE 8

/* Between steps whose signs are above this none goes below 0. A fold may come and go between two steps: they are looked at
 * closer around one that is lower than its neighbours, if it is near 0 or by so much of itself. */
#define LOW 0.6
#define NEAR 0.25
#define SHARP 0.2

/* Evaluations between two radii: twice what halving takes. */
#define STEPS_MOST 200

/* What divides the border from beyond the fold is 2 % from the border at most, and so is a neighbour's: an end further away
 * than this changes nothing. */
#define END_ROOM 1.05

/* 2^(i/8) */
static const double eighths[STEPS_OF_OCTAVE] = {1.0,
                                                1.0905077326652577,
                                                1.189207115002721,
                                                1.2968395546510096,
                                                1.4142135623730951,
                                                1.5422108254079407,
                                                1.681792830507429,
                                                1.8340080864093424};

typedef struct direction
{
    const cm_lens *lens;
    double cosine, sine;
    double slack; /* of the radii of borders: a part of them */
} direction;

static double sign_at(const direction *along, double radius)
{
    return cm_lens_sign(along->lens, radius * along->cosine, radius * along->sine);
}

/* Good where the sign is, and what of it goes through 0 there: at a pole the determinant leaps, but not the divisor. */
static double crossing_at(const direction *along, double radius)
{
    const cm_lens_point at = cm_lens_at(along->lens, radius * along->cosine, radius * along->sine);
    return at.divisor > 0.0    ? cm_lens_sign_there(along->lens, &at)
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
    return moved > fmin(from, to) && moved < fmax(from, to) ? moved : middle;
}

/* Between a good radius and one that is not, or the other way round: where it changes, or a little before that, where it is as
 * at the first. By the secant, and by the middle whenever that has not made much of the way. */
static double change_between(const direction *along, double from, double to)
{
    double at_from = crossing_at(along, from);
    double at_to = crossing_at(along, to);
    const int good = at_from > 0.0;
    const double slack = along->slack * fmax(fabs(from), fabs(to));
    double pad = 0.5 * slack;
    int is_slow = (at_to > 0.0) == good;
    int last = -1;
    for (int i = 0; i < STEPS_MOST && fabs(to - from) > slack; i++)
    {
        const double width = fabs(to - from);
        const double next =
            is_slow ? 0.5 * (from + to) : crossing_between(from, to, at_from, at_to, pad);
        const double at_next = crossing_at(along, next);
        const int same = (at_next > 0.0) == good;
        from = same ? next : from;
        at_from = same ? at_next : at_from;
        to = same ? to : next;
        at_to = same ? at_to : at_next;
        pad *= same == last ? 4.0 : 1.0;
        last = same;
        is_slow = !is_slow && fabs(to - from) > 0.25 * width;
    }
    return from;
}

/* The lowest place between two, by golden sections, or the first that is not good. */
static double lowest_between(const direction *along, double from, double to)
{
    const double part = 0.38196601125010515;
    double low = from + part * (to - from);
    double high = to - part * (to - from);
    double at_low = sign_at(along, low);
    double at_high = sign_at(along, high);
    for (int i = 0; i < 40 && at_low > 0.0 && at_high > 0.0; i++)
    {
        if (at_low < at_high)
        {
            to = high;
            high = low;
            at_high = at_low;
            low = from + part * (to - from);
            at_low = sign_at(along, low);
        }
        else
        {
            from = low;
            low = high;
            at_low = at_high;
            high = to - part * (to - from);
            at_high = sign_at(along, high);
        }
    }
    return at_low < at_high ? low : high;
}

/* Signs along a direction, at as many steps as were asked for, from the first of them on; before that one they are calm. */
typedef struct steps
{
    const direction *along;
    const cm_camera_set *set;
    size_t first, known;
    int64_t low[STEPS / CM_CAMERA_BLOCK + 1]; /* of a block of steps: how many are LOW or less */
    double radius[STEPS + CM_CAMERA_BLOCK];
    double sign[STEPS + CM_CAMERA_BLOCK];
} steps;

static void begin_steps(steps *of, const direction *along, const cm_camera_set *set)
{
    of->along = along;
    of->set = set;
    of->first = 0;
    for (double next = 2.0 * FIRST; next <= along->lens->calm; next *= 2.0)
    {
        of->first += STEPS_OF_OCTAVE;
    }
    of->known = of->first;
}

/* The sign at a step. */
static double sign_of(steps *of, size_t step)
{
    while (of->known <= step)
    {
        double *const radius = of->radius + of->known;
        for (size_t octave = 0; octave < CM_CAMERA_BLOCK / STEPS_OF_OCTAVE; octave++)
        {
            const double scale = (double)(UINT64_C(1) << (of->known / STEPS_OF_OCTAVE + octave));
            for (size_t k = 0; k < STEPS_OF_OCTAVE; k++)
            {
                radius[octave * STEPS_OF_OCTAVE + k] = FIRST * eighths[k] * scale;
            }
        }
        of->low[(of->known - of->first) / CM_CAMERA_BLOCK] = of->set->signs(
            of->along->lens, of->along->cosine, of->along->sine, radius, LOW, of->sign + of->known);
        of->known += CM_CAMERA_BLOCK;
    }
    return of->sign[step];
}

/* The next step whose sign is LOW or less. */
static size_t next_low(steps *of, size_t step)
{
    while (step < STEPS)
    {
        sign_of(of, step);
        const size_t block = (step - of->first) / CM_CAMERA_BLOCK;
        const size_t end = of->first + (block + 1) * CM_CAMERA_BLOCK;
        while (of->low[block] > 0 && step < end)
        {
            if (!(of->sign[step] > LOW))
            {
                return step;
            }
            step++;
        }
        step = end;
    }
    return STEPS;
}

/* The end of what begins beyond a border at one of the steps, or a place before it; nothing where that is NULL. */
static void find_end(steps *of, size_t step, double bad, double *end)
{
    if (end == NULL)
    {
        return;
    }
    size_t i = step;
    double last = bad;
    while (i < STEPS && !(sign_of(of, i) > 0.0) && last <= END_ROOM * bad)
    {
        last = of->radius[i];
        i++;
    }
    *end = last > END_ROOM * bad ? last
           : i < STEPS           ? change_between(of->along, last, of->radius[i])
                                 : (double)INFINITY;
}

/* Before a pole a fold may begin and end within a step: looks once more, closer. 1 if there is something before the end.
 * end may be NULL. */
static int look_closer(const direction *along, const cm_camera_set *set, double from,
                       double *border, double *end)
{
    double radius[CM_CAMERA_BLOCK];
    double sign[CM_CAMERA_BLOCK];
    for (size_t i = 0; i < CM_CAMERA_BLOCK; i++)
    {
        radius[i] = from + (*border - from) * ((double)i / (CM_CAMERA_BLOCK - 1));
    }
    const int64_t bad = set->signs(along->lens, along->cosine, along->sine, radius, 0.0, sign);
    /* the last one is the border, which is good or not by a rounding */
    for (size_t i = 1; i + 1 < CM_CAMERA_BLOCK && bad > 0; i++)
    {
        if (!(sign[i] > 0.0))
        {
            const double old = *border;
            *border = change_between(along, radius[i - 1], radius[i]);
            if (end == NULL)
            {
                return 1;
            }
            size_t good = i + 1;
            while (good + 1 < CM_CAMERA_BLOCK && !(sign[good] > 0.0))
            {
                good++;
            }
            const double next = good + 1 < CM_CAMERA_BLOCK ? radius[good] : old;
            *end = change_between(along, radius[good - 1], next);
            return 1;
        }
    }
    return 0;
}

/* Before the first of the steps, which is not good: a border may be as near as doubles are. */
static double near_border(const direction *along, double bad)
{
    double good = 0.0625 * bad;
    while (good > 0.0 && !(sign_at(along, good) > 0.0))
    {
        bad = good;
        good *= 0.0625;
    }
    return good > 0.0 ? change_between(along, good, bad) : 0.0;
}

/* Of three steps, the lowest of which is the middle one. */
static int is_steep(double before, double sign, double after)
{
    return sign < before && sign <= after &&
           (sign < NEAR || before + after - 2.0 * sign > SHARP * sign);
}

/* The first border at the steps, and the end of the fold behind it, if that is asked for. */
static double first_border(steps *of, double *end)
{
    const direction *const along = of->along;
    const double *const radius = of->radius;
    if (!(sign_of(of, of->first) > 0.0))
    {
        find_end(of, of->first + 1, radius[of->first], end);
        return near_border(along, radius[of->first]);
    }
    for (size_t i = next_low(of, of->first); i < STEPS; i = next_low(of, i + 1))
    {
        const double sign = sign_of(of, i);
        double bad = radius[i];
        const int is_dip = i > of->first && i + 1 < STEPS && sign > 0.0 && sign < LOW &&
                           is_steep(of->sign[i - 1], sign, sign_of(of, i + 1));
        if (is_dip)
        {
            bad = lowest_between(along, radius[i - 1], radius[i + 1]);
        }
        if (is_dip ? !(sign_at(along, bad) > 0.0) : !(sign > 0.0))
        {
            find_end(of, bad >= radius[i] ? i + 1 : i, bad, end);
            return change_between(along, radius[i - 1], bad);
        }
    }
    find_end(of, STEPS, (double)INFINITY, end);
    return (double)INFINITY;
}

double cm_camera_field_border(const cm_lens *lens, const cm_camera_set *set, double cosine,
                              double sine, double slack, double *beyond)
{
    const direction along = {lens, cosine, sine, slack};
    steps of;
    begin_steps(&of, &along, set);
    double border = first_border(&of, beyond);
    for (int i = 0; border > 0.0 && border < (double)INFINITY && i < 3; i++)
    {
        if (!look_closer(&along, set, 0.8 * border, &border, beyond))
        {
            break;
        }
    }
    return border;
}

/* Directions are numbered along the square whose corners are on the axes: that needs no angles. */
void cm_camera_field_direction(double side, double *cosine, double *sine)
{
    const double along = side < CM_FIELD_SIDES ? side * (4.0 / CM_FIELD_SIDES) : 0.0;
    const double a = fabs(along - 2.0) - 1.0;
    const double b = along < 2.0 ? 1.0 - fabs(along - 1.0) : fabs(along - 3.0) - 1.0;
    const double length = sqrt(a * a + b * b);
    *cosine = a / length;
    *sine = b / length;
}

static double side_of(double a, double b)
{
    const double part = b / (fabs(a) + fabs(b));
    const double along = a < 0.0 ? 2.0 - part : part < 0.0 ? 4.0 + part : part;
    const double side = along * (CM_FIELD_SIDES / 4.0);
    return side >= 0.0 ? side : 0.0; /* NaN: the axis */
}

/* Does the lower of two neighbours' lines stay between both borders and what is beyond both folds? */
static int divides(const cm_field_end *one, const cm_field_end *next, double beyond)
{
    const double low = fmin(one->divide, next->divide);
    const int none = one->border == (double)INFINITY;
    return none == (next->border == (double)INFINITY) &&
           (none || (fmax(one->border, next->border) < low && low < beyond));
}

/* Borders of directions, n from the first on and one more, so far from each other; and what divides them from the rest. */
static void find_ends(const cm_lens *lens, const cm_camera_set *set, double first, double distance,
                      size_t n, cm_field_end *end)
{
    double last_beyond = 0.0;
    for (size_t i = 0; i <= n; i++)
    {
        double cosine;
        double sine;
        double beyond;
        cm_camera_field_direction(first + distance * (double)i, &cosine, &sine);
        const double border =
            cm_camera_field_border(lens, set, cosine, sine, CM_FIELD_SLACK, &beyond);
        /* close to the border, since before a pole steps may miss what is good again */
        end[i] = (cm_field_end){border, fmin(sqrt(border * beyond), 1.02 * border), 0, -1};
        if (i > 0)
        {
            end[i - 1].is_plain = divides(&end[i - 1], &end[i], fmin(last_beyond, beyond));
        }
        last_beyond = beyond;
    }
}

static void find_borders(const cm_lens *lens, const cm_camera_set *set, cm_camera_field *field)
{
    double within = (double)INFINITY;
    int splits = 0;
    find_ends(lens, set, 0.0, 1.0, CM_FIELD_SIDES, field->end);
    for (size_t i = 0; i < CM_FIELD_SIDES; i++)
    {
        cm_field_end *end = &field->end[i];
        const double line = fmin(end[0].divide, end[1].divide);
        const double border = fmin(end[0].border, end[1].border);
        within = fmin(within, end->is_plain ? line : 0.98 * border);
        if (!end->is_plain && splits < CM_FIELD_SPLITS)
        {
            end->split = splits++;
            find_ends(lens, set, (double)i, 1.0 / CM_FIELD_PARTS, CM_FIELD_PARTS,
                      field->part[end->split]);
        }
    }
    field->within = within * within;
}

void cm_camera_field_find(const cm_lens *lens, const cm_camera_set *set, cm_camera_field *field)
{
    field->furthest = (double)INFINITY;
    if (lens->is_plain)
    {
        for (size_t i = 0; i <= CM_FIELD_SIDES; i++)
        {
            field->end[i] = (cm_field_end){(double)INFINITY, (double)INFINITY, 1, -1};
        }
        field->within = (double)INFINITY;
        return;
    }
    find_borders(lens, set, field);
}

int cm_camera_field_joins(const cm_lens *lens, const cm_camera_set *set,
                          const cm_camera_field *field, double a, double b)
{
    const double square = LENS_MAD(a, a, b * b);
    if (square < field->within)
    {
        return 1;
    }
    const double radius = sqrt(square);
    const double side = side_of(a, b);
    const size_t i = side < CM_FIELD_SIDES ? (size_t)side : CM_FIELD_SIDES - 1;
    const cm_field_end *end = &field->end[i];
    if (end->split >= 0)
    {
        const double part = (side - (double)i) * CM_FIELD_PARTS;
        end = &field->part[end->split][part < CM_FIELD_PARTS ? (size_t)part : CM_FIELD_PARTS - 1];
    }
    if (end[0].is_plain)
    {
        return radius < fmin(end[0].divide, end[1].divide);
    }
    /* not beside the border both neighbours are enough; beside it the direction itself is looked along */
    const double low = fmin(end[0].border, end[1].border);
    const double high = fmax(end[0].border, end[1].border);
    return radius < 0.98 * low ||
           (radius <= 1.05 * high &&
            radius <=
                cm_camera_field_border(lens, set, a / radius, b / radius, CM_FIELD_SLACK, NULL));
}
