/* SPDX-License-Identifier: MIT
 *
 * What the suites about HEALPix's pixels share.
 */
#ifndef TESTS_HEALPIX_SUITE_H
#define TESTS_HEALPIX_SUITE_H

#include "tests/suite.h"

static inline cm_healpix *make_healpix(int64_t nside, cm_healpix_order order, const char *set)
{
    const cm_options options = {.size = sizeof options, .instructions = set};
    cm_healpix *healpix = NULL;
    REQUIRE(cm_healpix_create(nside, order, &options, &healpix) == CM_OK,
            "nside %lld, order %d, %s", (long long)nside, (int)order, set == NULL ? "" : set);
    return healpix;
}

static inline int is_power_of_two(int64_t n)
{
    return (n & (n - 1)) == 0;
}

/* Call check for nside 1 to 16, both orders, every instruction set. */
static inline void for_small(void (*check)(const cm_healpix *))
{
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        for (int64_t nside = 1; nside <= 16; nside++)
        {
            for (int order = 0; order < 1 + is_power_of_two(nside); order++)
            {
                cm_healpix *healpix =
                    make_healpix(nside, (cm_healpix_order)order, cm_instructions_at(s));
                check(healpix);
                cm_healpix_destroy(healpix);
            }
        }
    }
}

/* For messages. */
#define PIXEL_FORMAT "%s, nside %lld, order %d, pixel %lld"
#define PIXEL_OF(healpix, pixel)                                                                   \
    cm_healpix_instructions(healpix), (long long)cm_healpix_nside(healpix),                        \
        (int)cm_healpix_order_of(healpix), (long long)(pixel)

static inline int64_t pixel_of(const cm_healpix *healpix, const double direction[3])
{
    int64_t pixel = -7;
    REQUIRE(cm_healpix_pixel_from_direction(healpix, direction, &pixel) == CM_OK, "%g %g %g",
            direction[0], direction[1], direction[2]);
    return pixel;
}

static inline void centre_of(const cm_healpix *healpix, int64_t pixel, double direction[3])
{
    REQUIRE(cm_healpix_direction_from_pixel(healpix, pixel, direction) == CM_OK, PIXEL_FORMAT,
            PIXEL_OF(healpix, pixel));
}

#endif
