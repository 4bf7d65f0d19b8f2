/* SPDX-License-Identifier: MIT */
#include "camera_inverse.h"

#include <stddef.h>

enum
{
    STEPS_MOST = 60,
    STARTS_MOST = 9
};

/* What is solved: where, for what, and how well. */
typedef struct search
{
    const cm_lens *lens;
    const cm_camera_set *set;
    const cm_camera_field *field;
    double aim[2];
    double slack;
} search;

static double off_aim(const search *of, const cm_lens_point *at, double off[2])
{
    off[0] = at->x - of->aim[0];
    off[1] = at->y - of->aim[1];
    return off[0] * off[0] + off[1] * off[1];
}

static int is_inside(const search *of, const cm_lens_point *at, const double ray[2])
{
    return at->determinant > 0.0 && at->divisor > 0.0 &&
           cm_lens_reach(of->lens, at->x, at->y) > 0.0 &&
           cm_camera_field_joins(of->lens, of->set, of->field, ray[0], ray[1]);
}

/* A step of Newton's method, halved until it stays inside and comes nearer (Armijo's rule). 0 if it finds none. */
static int come_nearer(const search *of, double ray[2], cm_lens_point *at)
{
    double off[2];
    const double error = off_aim(of, at, off);
    const double move[2] = {(at->y_by_b * off[0] - at->x_by_b * off[1]) / at->determinant,
                            (at->x_by_a * off[1] - at->y_by_a * off[0]) / at->determinant};
    /* near a pole the axis's slope says nothing of what is far: no step is longer than the ray and a half */
    const double longest = 0.5 + hypot(ray[0], ray[1]);
    const double first = fmin(1.0, longest / hypot(move[0], move[1]));
    for (double share = first; share > 1e-3 * first; share *= 0.5)
    {
        const double next[2] = {ray[0] - share * move[0], ray[1] - share * move[1]};
        const cm_lens_point there = cm_lens_at(of->lens, next[0], next[1]);
        double left[2];
        if (off_aim(of, &there, left) <= (1.0 - 0.5 * share) * error && is_inside(of, &there, next))
        {
            ray[0] = next[0];
            ray[1] = next[1];
            *at = there;
            return 1;
        }
    }
    return 0;
}

/* Where rounding ends it, a step is next to nothing. */
static int is_still(const cm_lens_point *at, const double off[2], const double ray[2])
{
    const double move = fabs(at->y_by_b * off[0] - at->x_by_b * off[1]) +
                        fabs(at->x_by_a * off[1] - at->y_by_a * off[0]);
    return move <= 16.0 * CM_CAMERA_STILL * at->determinant * (fabs(ray[0]) + fabs(ray[1]));
}

static int descend(const search *of, double ray[2])
{
    cm_lens_point at = cm_lens_at(of->lens, ray[0], ray[1]);
    for (int i = 0; i < STEPS_MOST; i++)
    {
        double off[2];
        off_aim(of, &at, off);
        const double most = fmax(fabs(off[0]), fabs(off[1]));
        if (most <= of->slack)
        {
            return 1;
        }
        if (!come_nearer(of, ray, &at))
        {
            return is_still(&at, off, ray) || most <= 4.0 * of->slack;
        }
    }
    return 0;
}

int cm_camera_solve(const cm_lens *lens, const cm_camera_set *set, const cm_camera_field *field,
                    cm_camera_reach reach, const double aim[2], double slack, double ray[2])
{
    const search of = {lens, set, field, {aim[0], aim[1]}, slack};
    /* From the axis the way goes straight to the aim, as long as it does not leave the field: to all that there is if the
     * field's image is seen from the axis. Where there must be something else, from places around. */
    const size_t starts = reach == CM_IMAGE_REACHED ? STARTS_MOST : 1;
    for (size_t i = 0; i < starts; i++)
    {
        const size_t side = i * (CM_FIELD_SIDES / 8) % CM_FIELD_SIDES;
        const double angle = 6.283185307179586 * (double)i / 8.0;
        const double radius = i == 0 ? 0.0 : fmin(0.5 * field->end[side].border, 1.0);
        double at[2] = {radius * cos(angle), radius * sin(angle)};
        if (descend(&of, at))
        {
            ray[0] = at[0];
            ray[1] = at[1];
            return 1;
        }
    }
    return 0;
}
