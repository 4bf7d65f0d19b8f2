/* SPDX-License-Identifier: MIT
 *
 * chealpix (Gorski, Reinecke et al.) and this library's pixels, number by number: they must be the same but for
 * points within rounding of a border, and there this library must be right at least as often, by quadruple
 * precision. Points on borders that doubles can name must be the same everywhere.
 */
#include "bench/harness/harness.h"
#include "truth/peers/peers.h"

#include "truth/hard_points.h"
#include "truth/length_text.h"
#include "truth/quad_healpix.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include <chealpix.h>

static const double pi = 3.14159265358979323846;

/* Both, in NESTED; chealpix ends the process where theta is none, so that nobody asks it. */
typedef struct pair
{
    int64_t ours;
    int64_t theirs;
} pair;

typedef struct comparison
{
    const char *name;
    int is_angles;
    cm_healpix_order order;
} comparison;

static const comparison comparisons[] = {
    {"vec2pix_ring64", 0, CM_HEALPIX_RING},
    {"vec2pix_nest64", 0, CM_HEALPIX_NESTED},
    {"ang2pix_ring64", 1, CM_HEALPIX_RING},
    {"ang2pix_nest64", 1, CM_HEALPIX_NESTED},
};

static int64_t their_number(const comparison *c, int64_t nside, const double at[3])
{
    int64_t pixel = -1;
    if (c->is_angles)
    {
        (c->order == CM_HEALPIX_RING ? ang2pix_ring64 : ang2pix_nest64)(nside, at[0], at[1],
                                                                        &pixel);
    }
    else
    {
        (c->order == CM_HEALPIX_RING ? vec2pix_ring64 : vec2pix_nest64)(nside, at, &pixel);
    }
    return pixel;
}

static int64_t our_number(const comparison *c, const cm_healpix *healpix, const double at[3])
{
    int64_t pixel = -1;
    (void)(c->is_angles ? cm_healpix_pixel_from_angles(healpix, at[0], at[1], &pixel)
                        : cm_healpix_pixel_from_direction(healpix, at, &pixel));
    return pixel;
}

static int64_t nested_of(const comparison *c, const cm_healpix *healpix, int64_t pixel)
{
    int64_t nested = pixel;
    if (c->order == CM_HEALPIX_RING)
    {
        (void)cm_healpix_nested_from_ring(healpix, pixel, &nested);
    }
    return nested;
}

typedef struct tally
{
    size_t points;
    size_t different;
    size_t ours_right;
    size_t theirs_right;
    size_t undecided;
    double metres; /* of different ones from a border, at most */
} tally;

static void compare_point(const comparison *c, const cm_healpix *healpix, const double at[3],
                          tally *t)
{
    int64_t nside = cm_healpix_nside(healpix);
    int64_t ours = our_number(c, healpix, at);
    int64_t theirs = their_number(c, nside, at);
    t->points++;
    if (ours == theirs)
    {
        return;
    }
    healpix_quad_place place = c->is_angles ? healpix_quad_place_of_angles(nside, at[0], at[1])
                                            : healpix_quad_place_of_direction(nside, at);
    int64_t truth = healpix_quad_nested(nside, &place);
    t->different++;
    t->undecided += place.margin < 1e-25;
    if (place.margin < 1e-25) /* on the border to all digits of the judge */
    {
        return;
    }
    t->ours_right += nested_of(c, healpix, ours) == truth;
    t->theirs_right += nested_of(c, healpix, theirs) == truth;
    t->metres = fmax(t->metres, 1.3 * place.margin * EARTH_RADIUS / (double)nside);
}

static void random_point(const comparison *c, uint64_t *state, double at[3])
{
    next_direction(state, at);
    if (c->is_angles)
    {
        at[0] = atan2(hypot(at[0], at[1]), at[2]);
        at[1] = pi * (1.0 + next_real(state));
    }
}

static int64_t near_end(int64_t n, uint64_t *state)
{
    int64_t small = (int64_t)exp2(0.5 * log2((double)n) * (1.0 + next_real(state))) - 1;
    return next_bits(state) >> 63 ? small : n - 1 - small;
}

/* Within rounding of a border, at any distance from the corners of base pixels. */
static void border_point(const comparison *c, int64_t nside, uint64_t *state, double at[3])
{
    healpix_quad angles[2];
    healpix_quad direction[3];
    healpix_quad x = (healpix_quad)near_end(nside, state);
    healpix_quad y = (healpix_quad)near_end(nside, state);
    healpix_quad along = (healpix_quad)(0.5 + 0.5 * next_real(state));
    int is_x = (int)(next_bits(state) >> 63);
    healpix_quad none = 0;
    healpix_quad_point(nside, (int)(next_bits(state) % 12), x + (is_x ? along : none),
                       y + (is_x ? none : along), angles, direction);
    for (int k = 0; k < 3; k++)
    {
        at[k] = (double)(c->is_angles && k < 2 ? angles[k] : direction[k]);
    }
}

/* On the line of a rule: how often, who is right, how far at most. The number of broken claims. */
static int report(const comparison *c, int64_t nside, const char *points, const tally *t)
{
    printf("pixels; chealpix %s; %s, nside %" PRId64 "; %s; %zu of %zu differ; ours right %zu, "
           "chealpix %zu, undecided %zu; at most %s from a border\n",
           PEER_VERSION, c->name, nside, points, t->different, t->points, t->ours_right,
           t->theirs_right, t->undecided, length_text(t->metres));
    return t->ours_right < t->theirs_right;
}

enum
{
    POINTS = 100000
};

/* Of a resolution, as directions or as angles; quadruple precision, which makes them, takes longer than all else. */
typedef struct points
{
    double random[POINTS][3];
    double border[POINTS][3];
} points;

static void make_points(const comparison *c, int64_t nside, points *made)
{
    uint64_t state = 41;
    for (size_t i = 0; i < POINTS; i++)
    {
        random_point(c, &state, made->random[i]);
        border_point(c, nside, &state, made->border[i]);
    }
}

static int compare_points(const comparison *c, int64_t nside, const points *at)
{
    cm_healpix *healpix;
    tally random = {0, 0, 0, 0, 0, 0.0};
    tally border = {0, 0, 0, 0, 0, 0.0};
    int broken;
    if (cm_healpix_create(nside, c->order, NULL, &healpix) != CM_OK)
    {
        return 1;
    }
    for (size_t i = 0; i < POINTS; i++)
    {
        compare_point(c, healpix, at->random[i], &random);
        compare_point(c, healpix, at->border[i], &border);
    }
    broken = report(c, nside, "random", &random);
    broken += report(c, nside, "on borders", &border);
    /* what chealpix's own rounding of longitude in a ring costs is not known to be less than a pixel */
    broken += !(random.metres < 1e-6) && c->order == CM_HEALPIX_NESTED;
    cm_healpix_destroy(healpix);
    return broken;
}

/* Borders that doubles can name: multiples of an eighth of a turn and what nside halves it to, the equator, the
 * poles, |z| = 2 / 3 exactly; from 0 to one turn. */
static int compare_ties(const comparison *c, int64_t nside)
{
    static const double directions[][3] = {{1, 2, 2},    {2, 1, -2},    {-1, 2, -2},
                                           {-2, -1, 2},  {2, -2, 1},    {0, 0, 1},
                                           {-0.0, 0, 1}, {0, -0.0, -1}, {-0.0, -0.0, -1}};
    cm_healpix *healpix;
    tally t = {0, 0, 0, 0, 0, 0.0};
    if (cm_healpix_create(nside, c->order, NULL, &healpix) != CM_OK)
    {
        return 1;
    }
    for (size_t i = 0; !c->is_angles && i < sizeof directions / sizeof *directions; i++)
    {
        compare_point(c, healpix, directions[i], &t);
    }
    for (int x = -1; x <= 1 && !c->is_angles; x++)
    {
        for (int y = -1; y <= 1; y++)
        {
            const double flat[3] = {x, y, 0.0};
            const double negative[3] = {x == 0 ? -0.0 : x, y == 0 ? -0.0 : y, -0.0};
            if (x != 0 || y != 0)
            {
                compare_point(c, healpix, flat, &t);
                compare_point(c, healpix, negative, &t);
            }
        }
    }
    for (int i = 0; c->is_angles && i <= 64; i++)
    {
        static const double thetas[] = {0.0, 1e-300, 1.5707963267948966, 3.1415926535897931};
        double phi = i * (pi / 32.0);
        /* elsewhere chealpix's product is beside the border */
        int is_tie = phi * 0.63661977236758134308 == i / 16.0;
        for (size_t k = 0; is_tie && k < sizeof thetas / sizeof *thetas; k++)
        {
            const double at[3] = {thetas[k], phi, 0.0};
            compare_point(c, healpix, at, &t);
        }
    }
    int broken = report(c, nside, "ties", &t);
    cm_healpix_destroy(healpix);
    return broken + (t.different > 0);
}

int main(void)
{
    name_program("peer-chealpix-pixels");
    static const int64_t nsides[] = {1, 2, 64, 8192, (int64_t)1 << 20, (int64_t)1 << 29};
    static points made[sizeof nsides / sizeof *nsides]; /* both orders' */
    int broken = 0;
    for (size_t i = 0; i < sizeof comparisons / sizeof *comparisons; i++)
    {
        for (size_t k = 0; k < sizeof nsides / sizeof *nsides; k++)
        {
            if (i == 0 || comparisons[i].is_angles != comparisons[i - 1].is_angles)
            {
                make_points(&comparisons[i], nsides[k], &made[k]);
            }
            broken += compare_points(&comparisons[i], nsides[k], &made[k]);
            broken += compare_ties(&comparisons[i], nsides[k]);
        }
    }
    return broken != 0;
}
