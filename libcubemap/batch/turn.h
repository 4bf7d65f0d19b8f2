/* SPDX-License-Identifier: MIT
 *
 * How the loops turn faces from the frame geo to a mapping's, and back.
 */
#ifndef LIBCUBEMAP_BATCH_TURN_H
#define LIBCUBEMAP_BATCH_TURN_H

#include <cubemap/frame.h>

#include <stdint.h>

/* What becomes of a point (a, b) of a face: the two are swapped where all bits of swap are ones, and then change their
 * sign where those of minus are. Each word twice or four times, as one point alone fills a vector of 16 bytes. */
typedef struct cm_turn_face
{
    uint64_t swap[2];
    uint64_t minus_f64[2]; /* of a, of b */
    uint32_t minus_f32[4]; /* of a, of b, of a, of b */
    uint32_t face;
} cm_turn_face;

/* Where the components along outward, u and v of a face go: to which of x, y, z, and whether with the other sign. 64 bytes,
 * so that a table of them is indexed by a shift. */
typedef struct cm_turn_axes
{
    uint64_t minus_f64[3]; /* of u, of v, of outward, as are the others */
    uint32_t minus_f32[5]; /* of u, of v, of u, of v, of outward */
    uint32_t axis[3];
    uint32_t face; /* of the frame */
} cm_turn_axes;

/* The same the other way, for directions whose outward axis is known: in the lanes of u and v all bits are ones where they
 * are of x, of y, of z, and the sign is to change. By masks, since a component that was just written is not to be read
 * from a place that depends on the others. 128 bytes. */
typedef struct cm_turn_ahead
{
    uint64_t of_f64[3][2];
    uint64_t minus_f64[2];
    uint32_t of_f32[3][4];
    uint32_t minus_f32[4];
} cm_turn_ahead;

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
    /* The same for one point alone. */
    cm_turn_face to_frame[6]; /* by face of geo */
    cm_turn_face to_geo[6];   /* by face of the frame, as axes */
    cm_turn_axes axes[6];
    cm_turn_ahead ahead[6]; /* by the outward axis: +z -z +y -y +x -x */
    uint8_t face_ahead[8];  /* the same of the frame's faces */
} cm_turn;

#endif
