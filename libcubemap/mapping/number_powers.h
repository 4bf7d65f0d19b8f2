/* SPDX-License-Identifier: MIT
 *
 * Powers that reading and writing decimal numbers share.
 */
#ifndef LIBCUBEMAP_MAPPING_NUMBER_POWERS_H
#define LIBCUBEMAP_MAPPING_NUMBER_POWERS_H

#include <stdint.h>

#ifdef __SIZEOF_INT128__
__extension__ typedef unsigned __int128 cm_wide;

/* 5^27 is the largest power of five below 2^64. */
#define CM_POWERS_OF_FIVE 28

static const uint64_t cm_power_of_five[CM_POWERS_OF_FIVE] = {
    1ULL,
    5ULL,
    25ULL,
    125ULL,
    625ULL,
    3125ULL,
    15625ULL,
    78125ULL,
    390625ULL,
    1953125ULL,
    9765625ULL,
    48828125ULL,
    244140625ULL,
    1220703125ULL,
    6103515625ULL,
    30517578125ULL,
    152587890625ULL,
    762939453125ULL,
    3814697265625ULL,
    19073486328125ULL,
    95367431640625ULL,
    476837158203125ULL,
    2384185791015625ULL,
    11920928955078125ULL,
    59604644775390625ULL,
    298023223876953125ULL,
    1490116119384765625ULL,
    7450580596923828125ULL,
};
#endif

#endif
