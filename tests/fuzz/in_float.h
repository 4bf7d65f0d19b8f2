/* SPDX-License-Identifier: MIT
 *
 * Single precision, for the harnesses that stand once for both.
 */
#define REAL float
#define HALF_ULP 0x1p-24
#define NEXT_AFTER nextafterf
#define TOLERANCE 1e-9     /* less than the ulp of 1 */
#define RIM_TOLERANCE 1e-6 /* the same of the rim of a disc */
#define BOUND_OF(subject) ((subject)->bound_f32)
#define HARD_DIRECTION hard_direction_f32
#define HARD_POINT hard_point_f32
