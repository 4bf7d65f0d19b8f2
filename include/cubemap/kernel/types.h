/* SPDX-License-Identifier: MIT
 *
 * The small structs that kernels take and return.
 */
/* A point of a face before the warp: gnomonic coordinates, [-1, 1] each. */
CM_STRUCT(cm_pq)
{
    CM_REAL p;
    CM_REAL q;
}
CM_STRUCT_END(cm_pq)

/* A point of a face after the warp: the coordinates of the map, [-1, 1] each. */
CM_STRUCT(cm_uv)
{
    CM_REAL u;
    CM_REAL v;
}
CM_STRUCT_END(cm_uv)

/* What a mapping precomputes from its parameters. Before preparation k0, k1, ... are the parameters
 * in the order of the mapping's descriptor; after it they are whatever the room says.
 * variant is 0 or 1: which of two formulas a mapping with these parameters takes. It is all that a
 * kernel may branch on, so that a loop over points can be made once for each and has no branch. */
CM_STRUCT(cm_constants)
{
    CM_REAL k0;
    CM_REAL k1;
    CM_REAL k2;
    CM_REAL k3;
    CM_REAL k4;
    CM_REAL k5;
    CM_REAL k6;
    CM_REAL variant;
}
CM_STRUCT_END(cm_constants)

/* A mapping's first two parameters, to be prepared; 0 for those that it does not have. k2, k3, ... are the
 * others. */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_make_parameters)(CM_REAL first, CM_REAL second)
{
    CM_NAME(cm_constants) r;
    r.k0 = first;
    r.k1 = second;
    r.k2 = CM_LIT(0.0);
    r.k3 = CM_LIT(0.0);
    r.k4 = CM_LIT(0.0);
    r.k5 = CM_LIT(0.0);
    r.k6 = CM_LIT(0.0);
    r.variant = CM_LIT(0.0);
    return r;
}

CM_FN CM_NAME(cm_pq) CM_NAME(cm_make_pq)(CM_REAL p, CM_REAL q)
{
    CM_NAME(cm_pq) r;
    r.p = p;
    r.q = q;
    return r;
}

CM_FN CM_NAME(cm_uv) CM_NAME(cm_make_uv)(CM_REAL u, CM_REAL v)
{
    CM_NAME(cm_uv) r;
    r.u = u;
    r.v = v;
    return r;
}

/* The derivatives of (u, v) by (p, q). */
CM_STRUCT(cm_jacobian)
{
    CM_REAL u_p;
    CM_REAL u_q;
    CM_REAL v_p;
    CM_REAL v_q;
}
CM_STRUCT_END(cm_jacobian)

CM_FN CM_NAME(cm_jacobian)
    CM_NAME(cm_make_jacobian)(CM_REAL u_p, CM_REAL u_q, CM_REAL v_p, CM_REAL v_q)
{
    CM_NAME(cm_jacobian) r;
    r.u_p = u_p;
    r.u_q = u_q;
    r.v_p = v_p;
    r.v_q = v_q;
    return r;
}
