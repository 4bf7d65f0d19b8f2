/* SPDX-License-Identifier: MIT
 *
 * disc: points of the closed unit disc. Not a mapping: what the azimuthal projections and the mappings
 * between disc and square stand on.
 *
 * Beside the corners of the square, and beside the rim, which is a pole or the equator, mappings depend on
 * roots of differences that the coordinates u and v of a point do not tell any more: in double sqrt(eps) is
 * a metre on Earth. So a point has those differences with it, and an azimuthal projection followed by a
 * mapping to the square loses nothing between the two.
 */
#ifndef CM_DESCRIPTORS

CM_STRUCT(cm_disc_point)
{
    CM_REAL u;
    CM_REAL v;
    CM_REAL rim; /* 1 - u^2 - v^2, not less than 0, relatively accurate */
    CM_REAL gap; /* |u| - |v|, relatively accurate */
}
CM_STRUCT_END(cm_disc_point)

/* x^2 - s for s = x^2 rounded: the rest, exact (Dekker 1971). If the compiler contracts, it stays exact. */
CM_FN CM_REAL CM_NAME(cm_square_rest)(CM_REAL x, CM_REAL s)
{
#ifdef CM_FUSED
    return cm_mad(x, x, -s);
#else
#if CM_REAL_BITS == 64
    CM_REAL wide = CM_LIT(134217729.0) * x; /* 2^27 + 1 */
#elif CM_REAL_BITS == 32
    CM_REAL wide = CM_LIT(4097.0) * x; /* 2^12 + 1 */
#else
    CM_REAL wide = CM_LIT(144115188075855873.0) * x; /* 2^57 + 1 */
#endif
    CM_REAL head = wide - (wide - x);
    CM_REAL tail = x - head;
    return ((head * head - s) + CM_LIT(2.0) * (head * tail)) + tail * tail;
#endif
}

/* 1 - u^2 - v^2 for a point that is inside the disc, or outside by little, as if rounded once: the squares
 * are exact sums of two numbers, and so are the differences. */
CM_FN CM_REAL CM_NAME(cm_disc_rim)(CM_REAL u, CM_REAL v)
{
    CM_REAL a = u * u;
    CM_REAL b = v * v;
    CM_REAL a_rest = CM_NAME(cm_square_rest)(u, a);
    CM_REAL b_rest = CM_NAME(cm_square_rest)(v, b);
    CM_REAL s = CM_LIT(1.0) - a;
    CM_REAL s_rest = (CM_LIT(1.0) - s) - a;
    CM_REAL d = s - b;
    CM_REAL part = d - s;
    CM_REAL d_rest = (s - (d - part)) - (b + part);
    /* d and the rests may cancel, so that the rests' sum has its own */
    CM_REAL first = (d_rest + s_rest) - a_rest;
    CM_REAL first_part = first - (d_rest + s_rest);
    CM_REAL first_rest = ((d_rest + s_rest) - (first - first_part)) - (a_rest + first_part);
    CM_REAL sum = first - b_rest;
    CM_REAL sum_part = sum - first;
    CM_REAL sum_rest = (first - (sum - sum_part)) - (b_rest + sum_part);
    return (d + sum) + (first_rest + sum_rest);
}

/* A point given by its coordinates; one outside is put on the rim, to which it is moved. */
CM_FN CM_NAME(cm_disc_point) CM_NAME(cm_make_disc_point)(CM_REAL u, CM_REAL v)
{
    CM_REAL rim = CM_NAME(cm_disc_rim)(u, v);
    CM_BOOL outside = cm_less(rim, CM_LIT(0.0));
    CM_REAL scale = CM_SELECT(outside, CM_LIT(1.0) / cm_sqrt(CM_LIT(1.0) - rim), CM_LIT(1.0));
    CM_NAME(cm_disc_point) r;
    r.u = u * scale;
    r.v = v * scale;
    r.rim = CM_SELECT(outside, CM_LIT(0.0), rim);
    r.gap = cm_abs(r.u) - cm_abs(r.v);
    return r;
}

/* A point folded to 0 <= minor <= major by signs and a swap, as all mappings between disc and square are
 * symmetric. */
CM_STRUCT(cm_disc_octant)
{
    CM_REAL major;
    CM_REAL minor;
    CM_REAL slope;  /* minor / major, 0 at the centre */
    CM_BOOL u_wins; /* is major that of u? */
}
CM_STRUCT_END(cm_disc_octant)

/* a, b and the sign of |a| - |b|: those of a point of the disc, or of the square */
CM_FN CM_NAME(cm_disc_octant) CM_NAME(cm_disc_fold)(CM_REAL a, CM_REAL b, CM_REAL gap)
{
    CM_NAME(cm_disc_octant) r;
    r.u_wins = cm_at_least(gap, CM_LIT(0.0));
    r.major = CM_SELECT(r.u_wins, cm_abs(a), cm_abs(b));
    r.minor = CM_SELECT(r.u_wins, cm_abs(b), cm_abs(a));
    r.slope = r.minor / CM_SELECT(cm_less(CM_LIT(0.0), r.major), r.major, CM_LIT(1.0));
    return r;
}

/* The pair (major, minor) where (a, b) was folded, with its signs. */
CM_FN CM_NAME(cm_uv)
    CM_NAME(cm_disc_unfold)(CM_BOOL u_wins, CM_REAL major, CM_REAL minor, CM_REAL a, CM_REAL b)
{
    return CM_NAME(cm_make_uv)(cm_copysign(CM_SELECT(u_wins, major, minor), a),
                               cm_copysign(CM_SELECT(u_wins, minor, major), b));
}

/* The same for a point of the disc; gap is major - minor. */
CM_FN CM_NAME(cm_disc_point)
    CM_NAME(cm_disc_unfold_point)(CM_BOOL u_wins, CM_REAL major, CM_REAL minor, CM_REAL rim,
                                  CM_REAL gap, CM_REAL a, CM_REAL b)
{
    CM_NAME(cm_uv) uv = CM_NAME(cm_disc_unfold)(u_wins, major, minor, a, b);
    CM_NAME(cm_disc_point) r;
    r.u = uv.u;
    r.v = uv.v;
    r.rim = rim;
    r.gap = CM_SELECT(u_wins, gap, -gap);
    return r;
}

/* The Jacobian of an octant, d(major, minor) by d(major, minor), for where (a, b) was folded. */
CM_FN CM_NAME(cm_jacobian)
    CM_NAME(cm_disc_unfold_jacobian)(CM_BOOL u_wins, CM_NAME(cm_jacobian) j, CM_REAL a, CM_REAL b)
{
    CM_REAL sign = cm_copysign(CM_LIT(1.0), a) * cm_copysign(CM_LIT(1.0), b);
    return CM_NAME(cm_make_jacobian)(
        CM_SELECT(u_wins, j.u_p, j.v_q), sign * CM_SELECT(u_wins, j.u_q, j.v_p),
        sign * CM_SELECT(u_wins, j.v_p, j.u_q), CM_SELECT(u_wins, j.v_q, j.u_p));
}

/* The distance from the centre. */
CM_FN CM_REAL CM_NAME(cm_disc_radius)(CM_NAME(cm_disc_octant) at, CM_REAL rim)
{
    CM_REAL near_centre = at.major * cm_sqrt(CM_LIT(1.0) + at.slope * at.slope);
    return CM_SELECT(cm_less(rim, CM_LIT(0.5)), cm_sqrt(CM_LIT(1.0) - rim), near_centre);
}

/* 1 / sqrt(1 + t^2) */
CM_FN CM_REAL CM_NAME(cm_disc_cosine)(CM_REAL t)
{
    return CM_NAME(cm_inverse_root)(CM_LIT(1.0) + t * t);
}

#endif
