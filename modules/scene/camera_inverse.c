/* SPDX-License-Identifier: MIT */
#include "camera_inverse.h"

#include <stddef.h>

/* A residual that no step makes smaller may be larger by this. */
#define ROOM 4.0

enum
{
    STARTS_MOST = 9,
    NET_STARTS_MOST = 12,
    NET_FIRST = 4
};

/* Where to begin, and the square of how far the lens is from the aim there. */
typedef struct start
{
    double error;
    double ray[2];
} start;

/* How a way is gone: so many steps at most, none of which is cut to less, within the field or wherever signs are good. */
typedef struct way
{
    int steps;
    double least;
    int is_free;
} way;

static const way far_way = {60, 1e-3, 0};
static const way near_way = {20, 1e-2, 1};

static double off_aim(const cm_camera_search *of, const cm_lens_point *at, double off[2])
{
    off[0] = at->x - of->aim[0];
    off[1] = at->y - of->aim[1];
    return off[0] * off[0] + off[1] * off[1];
}

static int has_sign(const cm_camera_search *of, const cm_lens_point *at)
{
    return at->determinant > 0.0 && at->divisor > 0.0 &&
           cm_lens_reach(of->lens, at->x, at->y) > 0.0;
}

static int is_inside(const cm_camera_search *of, const double ray[2])
{
    return cm_camera_field_joins(of->field, ray[0], ray[1]);
}

/* A step of Newton's method, halved until it stays inside and comes nearer (Armijo's rule). 0 if it finds none. */
static int come_nearer(const cm_camera_search *of, way how, double ray[2], cm_lens_point *at)
{
    double off[2];
    const double error = off_aim(of, at, off);
    const double move[2] = {(at->y_by_b * off[0] - at->x_by_b * off[1]) / at->determinant,
                            (at->x_by_a * off[1] - at->y_by_a * off[0]) / at->determinant};
    /* near a pole the axis's slope says nothing of what is far: no step is longer than the ray and a half */
    const double longest = 0.5 + hypot(ray[0], ray[1]);
    const double first = fmin(1.0, longest / hypot(move[0], move[1]));
    for (double share = first; share > how.least * first; share *= 0.5)
    {
        const double next[2] = {ray[0] - share * move[0], ray[1] - share * move[1]};
        const cm_lens_point there = cm_lens_at(of->lens, next[0], next[1]);
        double left[2];
        if (off_aim(of, &there, left) <= (1.0 - 0.5 * share) * error && has_sign(of, &there) &&
            (how.is_free || is_inside(of, next)))
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

static int descend(const cm_camera_search *of, way how, double ray[2])
{
    cm_lens_point at = cm_lens_at(of->lens, ray[0], ray[1]);
    for (int i = 0; i < how.steps; i++)
    {
        double off[2];
        off_aim(of, &at, off);
        const double most = fmax(fabs(off[0]), fabs(off[1]));
        if (most <= of->slack)
        {
            return 1;
        }
        if (!come_nearer(of, how, ray, &at))
        {
            return is_still(&at, off, ray) || most <= ROOM * of->slack;
        }
    }
    return 0;
}

int cm_camera_is_off(const cm_camera_search *search, const double ray[2])
{
    const cm_lens_point at = cm_lens_at(search->lens, ray[0], ray[1]);
    double off[2];
    off_aim(search, &at, off);
    return !(fmax(fabs(off[0]), fabs(off[1])) <= ROOM * search->slack);
}

/* Puts a ray among those that are ordered by what the lens makes of them, nearest to the aim first; drops the last. */
static void insert_start(const cm_camera_search *search, const double ray[2], start *list)
{
    const cm_lens_point at = cm_lens_at(search->lens, ray[0], ray[1]);
    double off[2];
    start added = {off_aim(search, &at, off), {ray[0], ray[1]}};
    for (size_t i = 0; i < NET_STARTS_MOST && added.error < (double)INFINITY; i++)
    {
        if (added.error < list[i].error)
        {
            const start last = list[i];
            list[i] = added;
            added = last;
        }
    }
}

static int solve_from_knots(const cm_camera_search *search, double ray[2])
{
    const cm_lens_point at = cm_lens_at(search->lens, ray[0], ray[1]);
    return has_sign(search, &at) && descend(search, near_way, ray) && is_inside(search, ray);
}

/* From the triangles of the net in or beside which the pixel is: from the first ones as they come, since mostly one of these
 * does, or from the nearest of all. */
static int solve_from_net(const cm_camera_search *search, double ray[2])
{
    const cm_lens *lens = search->lens;
    const double place[2] = {(search->pixel[0] - lens->cx) * lens->per_x,
                             (search->pixel[1] - lens->cy) * lens->per_y};
    start list[NET_STARTS_MOST];
    for (size_t i = 0; i < NET_STARTS_MOST; i++)
    {
        list[i].error = (double)INFINITY;
    }
    size_t next = 0;
    cm_camera_net_make(lens, search->set, search->field, search->net);
    for (int i = 0; cm_camera_net_find(search->net, place, &next, ray); i++)
    {
        insert_start(search, ray, list);
        if (i < NET_FIRST && solve_from_knots(search, ray))
        {
            return 1;
        }
    }
    for (size_t i = 0; i < NET_STARTS_MOST && list[i].error < (double)INFINITY; i++)
    {
        ray[0] = list[i].ray[0];
        ray[1] = list[i].ray[1];
        if (solve_from_knots(search, ray))
        {
            return 1;
        }
    }
    return 0;
}

/* From the axis the way goes straight to the aim, as long as it does not leave the field: to all that there is if the field's
 * image is seen from the axis. Else from the net, and where there must be something from places around, which takes longest. */
int cm_camera_solve(const cm_camera_search *search, cm_camera_reach reach, double ray[2])
{
    const size_t starts = reach == CM_IMAGE_REACHED ? STARTS_MOST : 1;
    for (size_t i = 0; i < starts; i++)
    {
        const size_t side = i * (CM_FIELD_SIDES / 8) % CM_FIELD_SIDES;
        const double angle = 6.283185307179586 * (double)i / 8.0;
        const double radius = i == 0 ? 0.0 : fmin(0.5 * search->field->end[side].border, 1.0);
        ray[0] = radius * cos(angle);
        ray[1] = radius * sin(angle);
        if (descend(search, far_way, ray) || (i == 0 && solve_from_net(search, ray)))
        {
            return 1;
        }
    }
    return 0;
}
