/* SPDX-License-Identifier: MIT */
#include "camera_field.h"

#include <stddef.h>

#define TURN 6.283185307179586476925286766559

/* Along a direction signs are looked at in steps of an eighth of an octave, from 1e-4 to 4e5. */
#define STEPS (4 * CM_CAMERA_BLOCK)
#define FIRST 1e-4
#define STEPS_OF_OCTAVE 8.0

typedef struct direction
{
    const cm_lens *lens;
    double cosine, sine;
} direction;

static double sign_at(const direction *along, double radius)
{
    return cm_lens_sign(along->lens, radius * along->cosine, radius * along->sine);
}

/* Between a good radius and one that is not, or the other way round: the last double that is as the first. */
static double change_between(const direction *along, double from, double to)
{
    const int good = sign_at(along, from) > 0.0;
    for (int i = 0; i < 80; i++)
    {
        const double middle = 0.5 * (from + to);
        if (middle == from || middle == to)
        {
            break;
        }
        const int same = (sign_at(along, middle) > 0.0) == good;
        from = same ? middle : from;
        to = same ? to : middle;
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

static void look_along(const direction *along, const cm_camera_set *set, double *radius,
                       double *sign)
{
    for (size_t i = 0; i < STEPS; i += CM_CAMERA_BLOCK)
    {
        double a[CM_CAMERA_BLOCK];
        double b[CM_CAMERA_BLOCK];
        for (size_t k = 0; k < CM_CAMERA_BLOCK; k++)
        {
            radius[i + k] = FIRST * exp2((double)(i + k) / STEPS_OF_OCTAVE);
            a[k] = radius[i + k] * along->cosine;
            b[k] = radius[i + k] * along->sine;
        }
        set->signs(along->lens, a, b, sign + i);
    }
}

/* The end of what begins beyond a border at one of the steps, or a place before it. */
static double end_of_fold(const direction *along, const double *radius, const double *sign,
                          size_t step, double bad)
{
    for (size_t i = step; i < STEPS; i++)
    {
        if (sign[i] > 0.0)
        {
            return change_between(along, i > step ? radius[i - 1] : bad, radius[i]);
        }
    }
    return (double)INFINITY;
}

/* Before a pole a fold may begin and end within a step: looks once more, closer. 1 if there is something before the end. */
static int look_closer(const direction *along, const cm_camera_set *set, double from,
                       double *border, double *end)
{
    double radius[CM_CAMERA_BLOCK];
    double a[CM_CAMERA_BLOCK];
    double b[CM_CAMERA_BLOCK];
    double sign[CM_CAMERA_BLOCK];
    for (size_t i = 0; i < CM_CAMERA_BLOCK; i++)
    {
        radius[i] = from + (*border - from) * ((double)i / (CM_CAMERA_BLOCK - 1));
        a[i] = radius[i] * along->cosine;
        b[i] = radius[i] * along->sine;
    }
    set->signs(along->lens, a, b, sign);
    /* the last one is the border, which is good or not by a rounding */
    for (size_t i = 1; i + 1 < CM_CAMERA_BLOCK; i++)
    {
        if (!(sign[i] > 0.0))
        {
            const double old = *border;
            *border = change_between(along, radius[i - 1], radius[i]);
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

double cm_camera_field_border(const cm_lens *lens, const cm_camera_set *set, double cosine,
                              double sine, double *beyond)
{
    const direction along = {lens, cosine, sine};
    double radius[STEPS];
    double sign[STEPS];
    look_along(&along, set, radius, sign);
    double border = sign[0] > 0.0 ? (double)INFINITY : change_between(&along, 0.0, radius[0]);
    double end = sign[0] > 0.0 ? (double)INFINITY : end_of_fold(&along, radius, sign, 1, radius[0]);
    for (size_t i = 1; i < STEPS && border == (double)INFINITY; i++)
    {
        double bad = radius[i];
        const int is_dip = sign[i] > 0.0 && i + 1 < STEPS && sign[i] < sign[i - 1] &&
                           sign[i] <= sign[i + 1] && sign[i] < 0.25;
        if (is_dip)
        {
            bad = lowest_between(&along, radius[i - 1], radius[i + 1]);
        }
        if (is_dip ? !(sign_at(&along, bad) > 0.0) : !(sign[i] > 0.0))
        {
            border = change_between(&along, radius[i - 1], bad);
            end = end_of_fold(&along, radius, sign, bad >= radius[i] ? i + 1 : i, bad);
        }
    }
    for (int i = 0; border > 0.0 && border < (double)INFINITY && i < 3; i++)
    {
        if (!look_closer(&along, set, 0.8 * border, &border, &end))
        {
            break;
        }
    }
    if (beyond != NULL)
    {
        *beyond = end;
    }
    return border;
}

/* Do the dividing lines of two neighbours stay between both borders and what is beyond both folds? */
static int divides(const cm_camera_field *field, const double *beyond, size_t i)
{
    const double low = fmin(field->divide[i], field->divide[i + 1]);
    const double high = fmax(field->divide[i], field->divide[i + 1]);
    const int none = field->border[i] == (double)INFINITY;
    return none == (field->border[i + 1] == (double)INFINITY) &&
           (none || (fmax(field->border[i], field->border[i + 1]) < low &&
                     high < fmin(beyond[i], beyond[i + 1])));
}

/* Borders of all directions, and what divides them from the rest. */
static void find_borders(const cm_lens *lens, const cm_camera_set *set, cm_camera_field *field)
{
    double beyond[CM_FIELD_SIDES + 1];
    double within = (double)INFINITY;
    for (size_t i = 0; i <= CM_FIELD_SIDES; i++)
    {
        const double angle = TURN * (double)(i % CM_FIELD_SIDES) / CM_FIELD_SIDES;
        field->border[i] = cm_camera_field_border(lens, set, cos(angle), sin(angle), &beyond[i]);
        /* close to the border, since before a pole steps may miss what is good again */
        field->divide[i] = fmin(sqrt(field->border[i] * beyond[i]), 1.02 * field->border[i]);
    }
    for (size_t i = 0; i < CM_FIELD_SIDES; i++)
    {
        field->is_plain[i] = (unsigned char)divides(field, beyond, i);
        const double line = fmin(field->divide[i], field->divide[i + 1]);
        const double border = fmin(field->border[i], field->border[i + 1]);
        within = fmin(within, field->is_plain[i] ? line : 0.98 * border);
    }
    field->within = within * within;
}

/* What the lens makes of the border, and how far that is from a chain of straight lines. */
static void find_image(const cm_lens *lens, const cm_camera_set *set, cm_camera_field *field)
{
    double furthest = 0.0;
    double sag = 0.0;
    for (size_t i = 0; i < CM_FIELD_SIDES; i++)
    {
        const double angle = TURN * (double)i / CM_FIELD_SIDES;
        const cm_lens_point at =
            cm_lens_at(lens, field->border[i] * cos(angle), field->border[i] * sin(angle));
        field->image[i][0] = at.x;
        field->image[i][1] = at.y;
        furthest = fmax(furthest, at.x * at.x + at.y * at.y);
    }
    for (size_t i = 0; i < CM_FIELD_SIDES; i++)
    {
        const double angle = TURN * ((double)i + 0.5) / CM_FIELD_SIDES;
        const double border = cm_camera_field_border(lens, set, cos(angle), sin(angle), NULL);
        const cm_lens_point at = cm_lens_at(lens, border * cos(angle), border * sin(angle));
        const double *one = field->image[i];
        const double *next = field->image[(i + 1) % CM_FIELD_SIDES];
        const double off = hypot(at.x - 0.5 * (one[0] + next[0]), at.y - 0.5 * (one[1] + next[1]));
        sag = off <= sag ? sag : off;
    }
    field->sag = 4.0 * sag;
    const double most = sqrt(furthest) + field->sag;
    field->furthest = most * most < 1e200 ? most * most : 1e200;
}

void cm_camera_field_find(const cm_lens *lens, const cm_camera_set *set, cm_camera_field *field)
{
    if (lens->is_plain)
    {
        for (size_t i = 0; i <= CM_FIELD_SIDES; i++)
        {
            field->border[i] = (double)INFINITY;
        }
        field->within = field->furthest = field->sag = (double)INFINITY;
        return;
    }
    find_borders(lens, set, field);
    double most = 0.0;
    for (size_t i = 0; i < CM_FIELD_SIDES; i++)
    {
        most = fmax(most, field->border[i]);
    }
    if (most < (double)INFINITY)
    {
        find_image(lens, set, field);
    }
    else
    {
        field->sag = (double)INFINITY;
        field->furthest = 1e200;
    }
}

int cm_camera_field_joins(const cm_lens *lens, const cm_camera_set *set,
                          const cm_camera_field *field, double a, double b)
{
    if (LENS_MAD(a, a, b * b) < field->within)
    {
        return 1;
    }
    const double radius = hypot(a, b);
    double turns = atan2(b, a) / TURN;
    turns -= floor(turns);
    const double place = turns * CM_FIELD_SIDES;
    const size_t i = place < CM_FIELD_SIDES ? (size_t)place : CM_FIELD_SIDES - 1;
    if (field->is_plain[i])
    {
        const double share = place - (double)i;
        const double line = field->border[i] == (double)INFINITY
                                ? (double)INFINITY
                                : (1.0 - share) * field->divide[i] + share * field->divide[i + 1];
        return radius < line;
    }
    /* not beside the border both neighbours are enough; beside it the direction itself is looked along */
    const double low = fmin(field->border[i], field->border[i + 1]);
    const double high = fmax(field->border[i], field->border[i + 1]);
    return radius < 0.98 * low ||
           (radius <= 1.05 * high &&
            radius <= cm_camera_field_border(lens, set, a / radius, b / radius, NULL));
}

/* Rays inside are mapped with their side kept, so the border's image goes around each of their images (the degree of a
 * map), and around nothing else. */
cm_camera_reach cm_camera_field_reaches(const cm_camera_field *field, double x, double y)
{
    if (!(field->sag < (double)INFINITY))
    {
        return CM_FIELD_UNKNOWN;
    }
    int winding = 0;
    double nearest = (double)INFINITY;
    for (size_t i = 0; i < CM_FIELD_SIDES; i++)
    {
        const double *from = field->image[i];
        const double *to = field->image[(i + 1) % CM_FIELD_SIDES];
        const double way[2] = {to[0] - from[0], to[1] - from[1]};
        const double off[2] = {x - from[0], y - from[1]};
        const double side = way[0] * off[1] - way[1] * off[0];
        const double length = way[0] * way[0] + way[1] * way[1];
        double share = length > 0.0 ? (way[0] * off[0] + way[1] * off[1]) / length : 0.0;
        share = share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
        const double gap[2] = {off[0] - share * way[0], off[1] - share * way[1]};
        nearest = fmin(nearest, gap[0] * gap[0] + gap[1] * gap[1]);
        winding += from[1] <= y && to[1] > y && side > 0.0 ? 1 : 0;
        winding -= from[1] > y && to[1] <= y && side < 0.0 ? 1 : 0;
    }
    return nearest <= field->sag * field->sag ? CM_FIELD_UNKNOWN
           : winding != 0                     ? CM_FIELD_REACHED
                                              : CM_FIELD_MISSED;
}
