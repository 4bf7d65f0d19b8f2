/* SPDX-License-Identifier: MIT
 *
 * How the loops turn faces from the frame geo to a mapping's, and back.
 */
#ifndef LIBCUBEMAP_BATCH_TURN_H
#define LIBCUBEMAP_BATCH_TURN_H

#include <cubemap/frame.h>

#include <stdint.h>

/* How a frame differs from geo. A point (a, b) of a face of geo is on the face of that number in the
 * frame, at u = sign_u * (swap ? b : a), v = sign_v * (swap ? a : b). */
typedef struct cm_turn
{
    int identity; /* nothing changes at all */
    /* As tables that a vector of faces looks up: bit 63 - i for face i, and octal digit i. The first
     * four by face of geo, the others by face of the frame. */
    uint64_t swap_bits;
    uint64_t minus_u_bits;
    uint64_t minus_v_bits;
    uint64_t face_digits; /* of the frame */
    uint64_t swap_back_bits;
    uint64_t minus_u_back_bits;
    uint64_t minus_v_back_bits;
    uint64_t geo_face_digits;
} cm_turn;

#endif
