/* SPDX-License-Identifier: MIT
 *
 * jacobian: what a warp's Jacobian makes of the derivatives between directions and gnomonic
 * coordinates, for every mapping that is a warp of the cube's faces.
 */
#ifndef CM_DESCRIPTORS

/* du dv over dp dq */
CM_FN CM_REAL CM_NAME(cm_jacobian_determinant)(CM_NAME(cm_jacobian) j)
{
    return j.u_p * j.v_q - j.u_q * j.v_p;
}

/* The derivatives of the unit direction by (u, v) from those by (p, q), by the inverse of the Jacobian.
 * Where the Jacobian is singular, at the edges of smoothstep with c = 1 and nowhere else, they are
 * infinite or NaN. */
CM_FN CM_NAME(cm_tangents)
    CM_NAME(cm_jacobian_tangents)(CM_NAME(cm_jacobian) j, CM_NAME(cm_tangents) t)
{
    CM_REAL scale = CM_LIT(1.0) / CM_NAME(cm_jacobian_determinant)(j);
    CM_REAL p_u = j.v_q * scale;
    CM_REAL p_v = -(j.u_q * scale);
    CM_REAL q_u = -(j.v_p * scale);
    CM_REAL q_v = j.u_p * scale;
    CM_NAME(cm_tangents) r;
    r.x_a = t.x_a * p_u + t.x_b * q_u;
    r.y_a = t.y_a * p_u + t.y_b * q_u;
    r.z_a = t.z_a * p_u + t.z_b * q_u;
    r.x_b = t.x_a * p_v + t.x_b * q_v;
    r.y_b = t.y_a * p_v + t.y_b * q_v;
    r.z_b = t.z_a * p_v + t.z_b * q_v;
    return r;
}

/* The gradients of u and v from those of p and q. */
CM_FN CM_NAME(cm_gradients)
    CM_NAME(cm_jacobian_gradients)(CM_NAME(cm_jacobian) j, CM_NAME(cm_gradients) g)
{
    CM_NAME(cm_gradients) r;
    r.a_x = j.u_p * g.a_x + j.u_q * g.b_x;
    r.a_y = j.u_p * g.a_y + j.u_q * g.b_y;
    r.a_z = j.u_p * g.a_z + j.u_q * g.b_z;
    r.b_x = j.v_p * g.a_x + j.v_q * g.b_x;
    r.b_y = j.v_p * g.a_y + j.v_q * g.b_y;
    r.b_z = j.v_p * g.a_z + j.v_q * g.b_z;
    return r;
}

#endif
