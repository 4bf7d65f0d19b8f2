/* SPDX-License-Identifier: MIT
 *
 * on_sphere: what a renderer asks of a mapping, from the kernels that the mapping has: a direction's face, u and v, the
 * way back, the areal scale, and the direction to look up in the hardware's cube map, which knows the gnomonic mapping
 * only. The macros make these functions for one mapping, under names that their user gives.
 */
#ifndef CM_DESCRIPTORS

/* s = |grad u x grad v|: du dv per steradian. Samples that are uniform in (u, v) on six faces have the density
 * s / 24 on the sphere. */
CM_FN CM_REAL CM_NAME(cm_areal_scale)(CM_NAME(cm_gradients) g)
{
    CM_REAL x = g.a_y * g.b_z - g.a_z * g.b_y;
    CM_REAL y = g.a_z * g.b_x - g.a_x * g.b_z;
    CM_REAL z = g.a_x * g.b_y - g.a_y * g.b_x;
    return cm_sqrt(x * x + y * y + z * z);
}

/* The coordinates of a face along the axes of the frame gl, which cube maps of all hardware have, but for signs, which
 * no warp sees; and back. On four faces gl's u is geo's b. */
CM_FN CM_NAME(cm_face_point) CM_NAME(cm_cube_turn_gl)(CM_NAME(cm_face_point) at)
{
    CM_BOOL same = cm_equal(cm_abs(at.face - CM_LIT(2.0)), CM_LIT(1.0));
    CM_NAME(cm_face_point) r;
    r.face = at.face;
    r.a = CM_SELECT(same, at.a, at.b);
    r.b = CM_SELECT(same, at.b, at.a);
    return r;
}

/* How the coordinates of a face, whose gradients these are, move when the direction x, y, z moves by x_step, y_step,
 * z_step. */
CM_FN CM_NAME(cm_face_point)
    CM_NAME(cm_face_step)(CM_REAL x, CM_REAL y, CM_REAL z, CM_REAL x_step, CM_REAL y_step,
                          CM_REAL z_step, CM_REAL face, CM_NAME(cm_gradients) g)
{
    CM_REAL over = CM_NAME(cm_inverse_root)(x * x + y * y + z * z);
    CM_NAME(cm_face_point) r;
    r.face = face;
    r.a = (g.a_x * x_step + g.a_y * y_step + g.a_z * z_step) * over;
    r.b = (g.b_x * x_step + g.b_y * y_step + g.b_z * z_step) * over;
    return r;
}

/* For a warp of the cube's faces. */
#define CM_WARP_ON_SPHERE(project, unproject, gradients, forward, inverse, jacobian)               \
    CM_FN CM_NAME(cm_face_point)                                                                   \
        CM_NAME(project)(CM_REAL x, CM_REAL y, CM_REAL z, CM_NAME(cm_constants) k)                 \
    {                                                                                              \
        CM_NAME(cm_face_point) at = CM_NAME(cm_cube_project)(x, y, z);                             \
        CM_NAME(cm_uv) uv = CM_NAME(forward)(at.a, at.b, k);                                       \
        at.a = uv.u;                                                                               \
        at.b = uv.v;                                                                               \
        return at;                                                                                 \
    }                                                                                              \
    CM_FN CM_NAME(cm_xyz)                                                                          \
        CM_NAME(unproject)(CM_REAL face, CM_REAL u, CM_REAL v, CM_NAME(cm_constants) k)            \
    {                                                                                              \
        CM_NAME(cm_pq) pq = CM_NAME(inverse)(u, v, k);                                             \
        return CM_NAME(cm_cube_unproject)(face, pq.p, pq.q);                                       \
    }                                                                                              \
    CM_FN CM_NAME(cm_gradients)                                                                    \
        CM_NAME(gradients)(CM_REAL x, CM_REAL y, CM_REAL z, CM_NAME(cm_constants) k)               \
    {                                                                                              \
        CM_NAME(cm_face_point) at = CM_NAME(cm_cube_project)(x, y, z);                             \
        CM_NAME(cm_uv) uv = CM_NAME(forward)(at.a, at.b, k);                                       \
        return CM_NAME(cm_jacobian_gradients)(CM_NAME(jacobian)(at.a, at.b, uv.u, uv.v, k),        \
                                              CM_NAME(cm_cube_gradients)(x, y, z));                \
    }

/* For any mapping of directions. */
#define CM_SCALE_ON_SPHERE(scale, gradients)                                                       \
    CM_FN CM_REAL CM_NAME(scale)(CM_REAL x, CM_REAL y, CM_REAL z, CM_NAME(cm_constants) k)         \
    {                                                                                              \
        return CM_NAME(cm_areal_scale)(CM_NAME(gradients)(x, y, z, k));                            \
    }

/* For an azimuthal projection, from the function of its law: as its gradients are beside the antipode, their product would
 * have nothing left. dr/dt by r / sin t. */
#define CM_AZIMUTHAL_SCALE(scale, radius)                                                          \
    CM_FN CM_REAL CM_NAME(scale)(CM_REAL x, CM_REAL y, CM_REAL z, CM_NAME(cm_constants) k)         \
    {                                                                                              \
        CM_NAME(cm_bearing) b = CM_NAME(cm_azimuthal_bearing)(x, y, z, k);                         \
        CM_NAME(cm_radius) r = CM_NAME(radius)(b.t, k);                                            \
        return r.slope * (r.ratio / (CM_LIT(2.0) * b.t.half_cosine));                              \
    }

/* The direction to look up, whose gnomonic coordinates in the frame gl are u and v in that frame, and how it moves. For
 * a warp: */
#define CM_WARP_LOOKUP(lookup, lookup_step, forward, jacobian)                                     \
    CM_FN CM_NAME(cm_xyz)                                                                          \
        CM_NAME(lookup)(CM_REAL x, CM_REAL y, CM_REAL z, CM_NAME(cm_constants) k)                  \
    {                                                                                              \
        CM_NAME(cm_face_point) at = CM_NAME(cm_cube_turn_gl)(CM_NAME(cm_cube_project)(x, y, z));   \
        CM_NAME(cm_uv) uv = CM_NAME(forward)(at.a, at.b, k);                                       \
        at.a = uv.u;                                                                               \
        at.b = uv.v;                                                                               \
        at = CM_NAME(cm_cube_turn_gl)(at);                                                         \
        return CM_NAME(cm_cube_from_axes)(at.face, CM_LIT(1.0), at.a, at.b);                       \
    }                                                                                              \
    CM_FN CM_NAME(cm_xyz)                                                                          \
        CM_NAME(lookup_step)(CM_REAL x, CM_REAL y, CM_REAL z, CM_REAL x_step, CM_REAL y_step,      \
                             CM_REAL z_step, CM_NAME(cm_constants) k)                              \
    {                                                                                              \
        CM_NAME(cm_face_point) at = CM_NAME(cm_cube_turn_gl)(CM_NAME(cm_cube_project)(x, y, z));   \
        CM_NAME(cm_uv) uv = CM_NAME(forward)(at.a, at.b, k);                                       \
        CM_NAME(cm_jacobian) j = CM_NAME(jacobian)(at.a, at.b, uv.u, uv.v, k);                     \
        CM_NAME(cm_gradients) g = CM_NAME(cm_cube_gradients)(x, y, z);                             \
        CM_NAME(cm_face_point) by = CM_NAME(cm_cube_turn_gl)(                                      \
            CM_NAME(cm_face_step)(x, y, z, x_step, y_step, z_step, at.face, g));                   \
        at.a = j.u_p * by.a + j.u_q * by.b;                                                        \
        at.b = j.v_p * by.a + j.v_q * by.b;                                                        \
        at = CM_NAME(cm_cube_turn_gl)(at);                                                         \
        return CM_NAME(cm_cube_from_axes)(at.face, CM_LIT(0.0), at.a, at.b);                       \
    }

/* For another mapping to six faces: */
#define CM_SPHERE_LOOKUP(lookup, lookup_step, project, gradients)                                  \
    CM_FN CM_NAME(cm_xyz)                                                                          \
        CM_NAME(lookup)(CM_REAL x, CM_REAL y, CM_REAL z, CM_NAME(cm_constants) k)                  \
    {                                                                                              \
        CM_NAME(cm_face_point) at = CM_NAME(project)(x, y, z, k);                                  \
        return CM_NAME(cm_cube_from_axes)(at.face, CM_LIT(1.0), at.a, at.b);                       \
    }                                                                                              \
    CM_FN CM_NAME(cm_xyz)                                                                          \
        CM_NAME(lookup_step)(CM_REAL x, CM_REAL y, CM_REAL z, CM_REAL x_step, CM_REAL y_step,      \
                             CM_REAL z_step, CM_NAME(cm_constants) k)                              \
    {                                                                                              \
        CM_NAME(cm_face_point) at = CM_NAME(project)(x, y, z, k);                                  \
        CM_NAME(cm_gradients) g = CM_NAME(gradients)(x, y, z, k);                                  \
        at = CM_NAME(cm_face_step)(x, y, z, x_step, y_step, z_step, at.face, g);                   \
        return CM_NAME(cm_cube_from_axes)(at.face, CM_LIT(0.0), at.a, at.b);                       \
    }

#endif
