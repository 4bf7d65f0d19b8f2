/* SPDX-License-Identifier: MIT
 *
 * The pixels of a disc, in NESTED: squares of pixels that are inside or outside as a whole are told by their middles, from the
 * base pixels on; of single pixels what was found in RING.
 */
#include "pixel_disc.h"

#include <math.h>

#define LEVELS 30
#define FARTHEST                                                                                   \
    1.1 /* radians from a pixel's centre to its points, by nside; 1.07 of the smallest */

struct descent
{
    const struct disc_runs *ring;
    const struct disc *disc;
    struct disc_runs *runs;
    cm_healpix *grid[LEVELS]; /* of nside, and of half of it each time */
    double inside[LEVELS];    /* squares of chords of middles, up to which all is inside */
    double outside[LEVELS];   /* and from which on nothing is */
    int count;
};

static int has(const struct disc_runs *runs, int64_t pixel)
{
    size_t low = 0; /* the last run that begins before, or there */
    for (size_t n = runs->run_count; n > 1;)
    {
        const size_t half = n / 2;
        low += runs->run[low + half].first <= pixel ? half : 0;
        n -= half;
    }
    return runs->run_count && runs->run[low].first <= pixel &&
           pixel - runs->run[low].first < runs->run[low].count;
}

/* The pixels of one of a coarser grid; 0 without memory. */
static int descend(const struct descent *to, int level, int64_t number)
{
    if (level == 0)
    {
        int64_t pixel = CM_HEALPIX_NO_PIXEL;
        (void)cm_healpix_ring_from_nested(to->disc->healpix, number, &pixel);
        return !has(to->ring, pixel) || disc_add(to->runs, number, 1);
    }
    double middle[3];
    (void)cm_healpix_direction_from_pixel(to->grid[level], number, middle);
    const double apart = disc_squared_chord(to->disc, middle);
    if (apart <= to->inside[level])
    {
        const int64_t count = (int64_t)1 << (2 * level);
        return disc_add(to->runs, number * count, count);
    }
    int is_good = 1;
    for (int64_t k = 0; k < 4 && is_good && apart <= to->outside[level]; k++)
    {
        is_good = descend(to, level - 1, 4 * number + k);
    }
    return is_good;
}

int disc_find_nested(const struct disc *disc, const struct disc_runs *ring, struct disc_runs *runs)
{
    struct descent to = {.ring = ring, .disc = disc, .runs = runs};
    const int64_t nside = cm_healpix_nside(disc->healpix);
    int is_good = 1;
    /* the border of what overlaps is no farther than the lines that it is looked for on */
    const double more = disc->lines > 0 ? 1.0 / (double)nside : 0.0;
    for (int64_t side = nside; side > 0 && is_good; side /= 2)
    {
        const double far = FARTHEST / (double)side;
        const double least = disc->radius - far;
        to.inside[to.count] = least > 0.0 ? disc_square_of_chord(least) : -1.0;
        to.outside[to.count] = disc_square_of_chord(disc->radius + more + far);
        is_good = cm_healpix_create(side, CM_HEALPIX_NESTED, NULL, &to.grid[to.count]) == CM_OK;
        to.count += is_good;
    }
    for (int64_t base = 0; base < 12 && is_good; base++)
    {
        is_good = descend(&to, to.count - 1, base);
    }
    while (to.count > 0)
    {
        cm_healpix_destroy(to.grid[--to.count]);
    }
    return is_good;
}
