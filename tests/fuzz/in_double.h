/* SPDX-License-Identifier: MIT
 *
 * Double precision, for the harnesses that stand once for both.
 */
#define REAL double
#define HALF_ULP 0x1p-53
#define NEXT_AFTER nextafter
#define TOLERANCE 1e-9     /* how far outside [-1, 1] a coordinate is taken as the edge */
#define RIM_TOLERANCE 1e-9 /* the same of the rim of a disc */
#define BOUND_OF(subject) ((subject)->bound)
#define HARD_DIRECTION hard_direction
#define HARD_POINT hard_point
