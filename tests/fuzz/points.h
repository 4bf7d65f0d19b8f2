/* SPDX-License-Identifier: MIT
 *
 * Single points: forward and inverse, and the warp of a face. Read by points_double.c and
 * points_float.c, which name the functions.
 */
#include "values.h"

static void check_direction(const subject *made, const REAL direction[3])
{
    REAL uv[2];
    REAL back[3];
    REAL over[3] = {direction[0], direction[1], direction[2]};
    uint8_t face = FORWARD(made->mapping, direction, uv);
    EXPECT(FORWARD(made->mapping, over, over) == face && memcmp(over, uv, sizeof uv) == 0,
           "%s: over its argument, and not", made->specification);
    INVERSE(made->mapping, face, uv, back);
    if (!is_direction(direction) || (is_partial(made) && face == CM_NO_FACE))
    {
        EXPECT(face == CM_NO_FACE && isnan(uv[0]) && isnan(uv[1]), "%s: %a %a %a on %d",
               made->specification, (double)direction[0], (double)direction[1],
               (double)direction[2], face);
        EXPECT(isnan(back[0]) && isnan(back[1]) && isnan(back[2]), "no face, but a direction");
        return;
    }
    EXPECT(face < (is_one_face(made) ? 1 : 6) && fabs((double)uv[0]) <= 1.0 &&
               fabs((double)uv[1]) <= 1.0,
           "%s: %a %a %a: %d %a %a", made->specification, (double)direction[0],
           (double)direction[1], (double)direction[2], face, (double)uv[0], (double)uv[1]);
    double error = angle_of(direction, back);
    /* what is beyond the rim by as much as it may be comes back on it */
    error -= is_partial(made) && fabs(hypot((double)uv[0], (double)uv[1]) - 1.0) < 8.0 * HALF_ULP
                 ? fmin(error, 8.0 * RIM_TOLERANCE)
                 : 0.0;
    EXPECT(error <= BOUND_OF(made), "%s: %a %a %a: %d %a %a: %g rad, bound %g", made->specification,
           (double)direction[0], (double)direction[1], (double)direction[2], face, (double)uv[0],
           (double)uv[1], error, BOUND_OF(made));
}

/* Forward of what inverse gave: on the same face u, v come back. */
static void check_return(const subject *made, uint8_t face, const REAL uv[2],
                         const REAL direction[3])
{
    const cm_mapping_info *info = cm_mapping_describe(made->mapping);
    REAL again[2];
    /* the square's corners and the borders of one face are stretched without bound */
    if (FORWARD(made->mapping, direction, again) != face || !made->standard || is_one_face(made))
    {
        return;
    }
    for (int k = 0; k < 2; k++)
    {
        double error = fabs((double)again[k] - (double)clamped(uv[k]));
        EXPECT(error <= info->bounds.plane_round_trip * HALF_ULP,
               "%s: %d %a %a: %a %a: %g eps, bound %g", made->specification, face, (double)uv[0],
               (double)uv[1], (double)again[0], (double)again[1], error / HALF_ULP,
               info->bounds.plane_round_trip);
    }
}

/* A little beyond the rim of a disc is on it. */
static int is_beside_disc(const subject *made, const REAL uv[2])
{
    return is_partial(made) && hypot((double)uv[0], (double)uv[1]) <= 1.0 + 4.0 * RIM_TOLERANCE;
}

static void check_point(const subject *made, uint8_t face, const REAL uv[2])
{
    REAL direction[3];
    INVERSE(made->mapping, face, uv, direction);
    if (face >= (is_one_face(made) ? 1 : 6) || !(is_point(uv) || is_beside_disc(made, uv)) ||
        (has_gaps(made) && isnan(direction[0])))
    {
        EXPECT(isnan(direction[0]) && isnan(direction[1]) && isnan(direction[2]),
               "%s: %d %a %a has a direction", made->specification, face, (double)uv[0],
               (double)uv[1]);
        return;
    }
    double square = 0.0;
    for (int k = 0; k < 3; k++)
    {
        square += (double)direction[k] * (double)direction[k];
    }
    EXPECT(fabs(sqrt(square) - 1.0) <= 8.0 * HALF_ULP, "%s: %d %a %a: length 1 %+g",
           made->specification, face, (double)uv[0], (double)uv[1], sqrt(square) - 1.0);
    check_direction(made, direction);
    check_return(made, face, uv, direction);
}

/* Within the face, and its edges stay where they are. */
static void expect_warped(const subject *made, const REAL from[2], const REAL to[2])
{
    for (int k = 0; k < 2; k++)
    {
        REAL edge = clamped(from[k]);
        EXPECT(fabs((double)to[k]) <= 1.0, "%s: %a %a: %a %a", made->specification, (double)from[0],
               (double)from[1], (double)to[0], (double)to[1]);
        EXPECT(fabs((double)edge) < 1.0 || to[k] == edge, "%s: %a %a: %a %a", made->specification,
               (double)from[0], (double)from[1], (double)to[0], (double)to[1]);
    }
}

/* Between disc and square: what is in the disc comes back. */
static void check_disc(const subject *made, const REAL pq[2], const REAL uv[2], const REAL back[2])
{
    double length = hypot((double)pq[0], (double)pq[1]);
    if (!(length <= 1.0))
    {
        int none = isnan(uv[0]) && isnan(uv[1]) && isnan(back[0]) && isnan(back[1]);
        EXPECT(none || length <= 1.0 + 4.0 * RIM_TOLERANCE, "%s: %a %a: %a %a", made->specification,
               (double)pq[0], (double)pq[1], (double)uv[0], (double)uv[1]);
        return;
    }
    for (int k = 0; k < 2; k++)
    {
        EXPECT(fabs((double)uv[k]) <= 1.0 &&
                   fabs((double)back[k] - (double)pq[k]) <= 16.0 * HALF_ULP,
               "%s: %a %a: %a %a: %a %a", made->specification, (double)pq[0], (double)pq[1],
               (double)uv[0], (double)uv[1], (double)back[0], (double)back[1]);
    }
}

static void check_warp(const subject *made, const REAL pq[2])
{
    REAL uv[2] = {7, 7};
    REAL back[2] = {7, 7};
    cm_status status = WARP(made->mapping, pq, uv);
    EXPECT(UNWARP(made->mapping, uv, back) == status, "%s: warp, but no unwarp",
           made->specification);
    if (is_hybrid(made))
    {
        EXPECT(status == CM_ERROR_UNSUPPORTED && uv[0] == 7 && back[0] == 7, "status %d", status);
        return;
    }
    EXPECT(status == CM_OK, "status %d", status);
    if (is_one_face(made))
    {
        check_disc(made, pq, uv, back);
        return;
    }
    if (!is_point(pq))
    {
        EXPECT(isnan(uv[0]) && isnan(uv[1]) && isnan(back[0]) && isnan(back[1]), "%s: %a %a: %a %a",
               made->specification, (double)pq[0], (double)pq[1], (double)uv[0], (double)uv[1]);
        return;
    }
    expect_warped(made, pq, uv);
    expect_warped(made, uv, back);
    const REAL ray[3] = {1, clamped(pq[0]), clamped(pq[1])};
    const REAL ray_back[3] = {1, back[0], back[1]};
    double error = angle_of(ray, ray_back);
    EXPECT(error <= BOUND_OF(made), "%s: %a %a: %a %a: %g rad", made->specification, (double)pq[0],
           (double)pq[1], (double)uv[0], (double)uv[1], error);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    subject made = take_subject(&from, NULL);
    while (from.left > 0)
    {
        REAL value[3];
        switch (take_byte(&from) % 3)
        {
        case 0:
            take_direction(&from, value);
            check_direction(&made, value);
            break;
        case 1:
            take_point(&from, value);
            check_point(&made, take_face(&from), value);
            break;
        default:
            take_point(&from, value);
            check_warp(&made, value);
            break;
        }
    }
    drop_subject(&made);
    return 0;
}
