/* SPDX-License-Identifier: MIT
 *
 * Tears: where a map jumps, however small the step. For a direction beside one the answer may be on the other side, and
 * stand for a direction that is next to it.
 */
#include "certificate.h"

#include <math.h>
#include <quadmath.h>

enum
{
    CORNERS = 8, /* of a box of directions */
    FARTHEST =
        64, /* roundings from a direction to what is meant: more is an error, beside a tear as well */
    HALVINGS = 50 /* of a few roundings; quadruple precision has 60 bits more than double */
};

/* A direction and where the truth has it. */
typedef struct beside
{
    quad d[3];
    quad uv[2];
} beside;

static void place_truly(const subject *s, beside *at)
{
    (void)quad_forward(&s->truth, at->d, at->uv);
}

static quad jump_of(const beside *a, const beside *b)
{
    return fmaxq(fabsq(a->uv[0] - b->uv[0]), fabsq(a->uv[1] - b->uv[1]));
}

/* A corner of the box about d whose half sides are reach. */
static beside corner_of(const subject *s, const double d[3], quad reach, int which)
{
    beside at;
    for (int k = 0; k < 3; k++)
    {
        at.d[k] = (quad)d[k] + (which >> k & 1 ? reach : -reach);
    }
    place_truly(s, &at);
    return at;
}

/* Does the map jump between two directions? Then *far is where it has just jumped. Of a half and the other the one with
 * the larger jump is kept: where nothing is torn, it shrinks with the step; a tear's stays. */
static int find_tear(const subject *s, beside near, beside *far)
{
    const quad whole = jump_of(&near, far);
    for (int i = 0; i < HALVINGS; i++)
    {
        beside middle;
        for (int k = 0; k < 3; k++)
        {
            middle.d[k] = (quad)0.5 * (near.d[k] + far->d[k]);
        }
        place_truly(s, &middle);
        if (jump_of(&near, &middle) > jump_of(&middle, far))
        {
            *far = middle;
        }
        else
        {
            near = middle;
        }
    }
    return jump_of(&near, far) > (quad)0.5 * whole;
}

static quad longest_of(const quad d[3])
{
    return fmaxq(fabsq(d[0]), fmaxq(fabsq(d[1]), fabsq(d[2])));
}

/* From d, which is so long, as far as to what is meant, of any length. */
static quad step_to(const double d[3], quad length, const long double meant[3])
{
    const quad to[3] = {(quad)meant[0], (quad)meant[1], (quad)meant[2]};
    quad step[3];
    for (int k = 0; k < 3; k++)
    {
        step[k] = to[k] / longest_of(to) - (quad)d[k] / length;
    }
    return longest_of(step);
}

static quad distance_of(const quad a[2], const double b[2])
{
    return fmaxq(fabsq(a[0] - (quad)b[0]), fabsq(a[1] - (quad)b[1]));
}

/* Is there a tear between d and what got stands for, of which got is on the other side: is it nearer to a place there than
 * to truth? However wide the tear is; beside its ends it is as thin as one likes. */
int is_across_tear(const subject *s, const double d[3], const long double meant[3],
                   const long double truth[2], const double got[2])
{
    const quad on_this_side[2] = {(quad)truth[0], (quad)truth[1]};
    beside here = {.d = {(quad)d[0], (quad)d[1], (quad)d[2]}};
    const quad length = longest_of(here.d), step = step_to(d, length, meant);
    if (!(step <= FARTHEST * (quad)s->eps))
    {
        return 0;
    }
    /* twice as far, and a rounding of the precision under test */
    const quad reach = (quad)2.0 * length * (step + (quad)s->eps);
    place_truly(s, &here);
    for (int i = 0; i < CORNERS; i++)
    {
        beside other = corner_of(s, d, reach, i);
        if (find_tear(s, here, &other) &&
            distance_of(other.uv, got) < distance_of(on_this_side, got))
        {
            return 1;
        }
    }
    return 0;
}
