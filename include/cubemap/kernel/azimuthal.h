/* SPDX-License-Identifier: MIT
 *
 * azimuthal: what the azimuthal projections have in common. Not a mapping.
 *
 * About the centre, the north pole, a direction at the angle t from it goes to the disc's point at the radius
 * r(t) in its own longitude: u = r sin lon, v = -r cos lon, which for other centres is east and north. A map ends
 * at the angle t0, half the field of view, where r is 1. A projection is its law: r from t and back, both by
 * the sine and cosine of t / 2, of which one keeps its digits at the centre and the other at the antipode.
 * So that nothing is lost beside the rim, laws speak of the margin m = cos^2(t / 2) - cos^2(t0 / 2), which is
 * half the difference of the cosines of t and t0.
 */
#ifndef CM_DESCRIPTORS

/* The angle of a direction from the centre. */
CM_STRUCT(cm_colatitude)
{
    CM_REAL half_sine;   /* sin(t / 2) */
    CM_REAL half_cosine; /* cos(t / 2) */
    CM_REAL cosine;      /* cos t */
    CM_REAL margin;      /* m; relatively accurate for t0 of a quarter or a half turn */
}
CM_STRUCT_END(cm_colatitude)

/* What a law makes of it. */
CM_STRUCT(cm_radius)
{
    CM_REAL ratio;  /* r / sin(t / 2) */
    CM_REAL radius; /* r where it is more accurate so than by ratio, else 0 */
    CM_REAL rim;    /* 1 - r^2 */
    CM_REAL slope;  /* dr / dt */
}
CM_STRUCT_END(cm_radius)

/* The radius of most laws. In the outer part of the disc it is taken from the rim, which is the more accurate: an
 * error of it moves a direction by as much more as the law is flat there. */
CM_FN CM_REAL CM_NAME(cm_azimuthal_radius)(CM_REAL rim)
{
    CM_BOOL outer = cm_less(rim, CM_LIT(0.5));
    CM_REAL from_rim = cm_sqrt(CM_LIT(1.0) - CM_SELECT(outer, rim, CM_LIT(0.0)));
    return CM_SELECT(outer, from_rim, CM_LIT(0.0));
}

/* What a law makes of r and of 1 - r^2. */
CM_STRUCT(cm_angle)
{
    CM_REAL ratio;  /* sin t / r */
    CM_REAL cosine; /* cos t */
    CM_REAL slope;  /* dt / dr */
}
CM_STRUCT_END(cm_angle)

/* k0 = the field of view in degrees, (0, 360]; k0 = sin(t0 / 2), k1 = cos(t0 / 2), k2 = cos t0 afterwards,
 * exact for 180 and 360; k3 and more belong to the laws. */
CM_FN CM_NAME(cm_constants) CM_NAME(cm_azimuthal_prepare)(CM_NAME(cm_constants) k)
{
    CM_REAL quarter_turn = CM_LIT(1.570796326794896619231321691639751442099);
    CM_REAL part = k.k0 / CM_LIT(360.0);
    CM_BOOL wide = cm_less(CM_LIT(0.5), part);
    CM_REAL angle = quarter_turn * CM_SELECT(wide, CM_LIT(1.0) - part, part);
    CM_REAL sine = CM_NAME(cm_sin_quarter)(angle);
    CM_REAL cosine = CM_LIT(1.0) - CM_NAME(cm_versine_quarter)(angle);
    CM_BOOL hemisphere = cm_equal(part, CM_LIT(0.5));
    CM_REAL half_root2 = CM_LIT(0.7071067811865475244008443621048490392848);
    k.k0 = CM_SELECT(hemisphere, half_root2, CM_SELECT(wide, cosine, sine));
    k.k1 = CM_SELECT(hemisphere, half_root2, CM_SELECT(wide, sine, cosine));
    k.k2 = CM_SELECT(hemisphere, CM_LIT(0.0), (k.k1 - k.k0) * (k.k1 + k.k0));
    return k;
}

/* A direction without its length. */
CM_STRUCT(cm_bearing)
{
    CM_NAME(cm_colatitude) t;
    CM_REAL east;  /* sin lon sin(t / 2) */
    CM_REAL south; /* cos lon sin(t / 2) */
    CM_REAL gap;   /* |east| - |south|, relatively accurate */
    CM_REAL sine;  /* sin t */
    CM_REAL unit_east;
    CM_REAL unit_south; /* at the centre and its antipode those of longitude 0 */
}
CM_STRUCT_END(cm_bearing)

/* Powers of two by which directions of all lengths are brought to where squares are normal numbers, and
 * those that it takes for the distance from the axis of one beside it. What is too long becomes 2^38 in float
 * and 2^324 in double, which is not too long: who scales twice loses nothing of a small component. */
#if CM_REAL_BITS == 32
#define CM_AZIMUTHAL_SMALL CM_LIT(9.313225746154785e-10) /* 2^-30 */
#define CM_AZIMUTHAL_LARGE CM_LIT(1.099511627776e12)     /* 2^40 */
#define CM_AZIMUTHAL_UP CM_LIT(1.237940039285380e27)     /* 2^90 */
#define CM_AZIMUTHAL_DOWN CM_LIT(8.077935669463161e-28)  /* 2^-90 */
#else
#define CM_AZIMUTHAL_SMALL CM_LIT(3.8725919148493182728180306332863518475702e-121) /* 2^-400 */
#define CM_AZIMUTHAL_LARGE CM_LIT(2.5822498780869085896559191720030118743297e120)  /* 2^400 */
#define CM_AZIMUTHAL_UP CM_LIT(5.2601359015483735072409898828801286655503e210)     /* 2^700 */
#define CM_AZIMUTHAL_DOWN CM_LIT(1.9010915662951598235150724058351031092649e-211)  /* 2^-700 */
#endif

/* The power of two for a magnitude. */
CM_FN CM_REAL CM_NAME(cm_azimuthal_scale)(CM_REAL magnitude)
{
    return CM_SELECT(
        cm_less(magnitude, CM_AZIMUTHAL_SMALL), CM_AZIMUTHAL_UP,
        CM_SELECT(cm_less(CM_AZIMUTHAL_LARGE, magnitude), CM_AZIMUTHAL_DOWN, CM_LIT(1.0)));
}

/* x, y, z finite and not all zero. */
CM_FN CM_NAME(cm_bearing)
    CM_NAME(cm_azimuthal_bearing)(CM_REAL x, CM_REAL y, CM_REAL z, CM_NAME(cm_constants) k)
{
    CM_REAL one = CM_LIT(1.0);
    CM_REAL none = CM_LIT(0.0);
    CM_REAL scale = CM_NAME(cm_azimuthal_scale)(CM_NAME(cm_magnitude)(x, y, z));
    x = x * scale;
    y = y * scale;
    z = z * scale;
    CM_REAL beside = CM_NAME(cm_azimuthal_scale)(cm_max(cm_abs(x), cm_abs(y)));
    CM_REAL x1 = x * beside;
    CM_REAL y1 = y * beside;
    CM_REAL from_axis = cm_sqrt(x1 * x1 + y1 * y1); /* the distance times beside */
    CM_REAL distance = from_axis / beside;
    CM_BOOL on_axis = cm_equal(from_axis, none);
    CM_REAL length = cm_sqrt((x * x + y * y) + z * z);
    CM_REAL sum = length + cm_abs(z);
    CM_REAL over = CM_NAME(cm_inverse_root)(CM_LIT(2.0) * (length * sum));
    CM_REAL greater = sum * over;
    CM_REAL smaller = distance * over;
    CM_REAL lacking = CM_LIT(0.5) * CM_NAME(cm_disc_rim)(greater, smaller);
    over = over + over * lacking;
    greater = greater + greater * lacking;
    smaller = smaller + smaller * lacking;

    CM_NAME(cm_bearing) r;
    CM_BOOL is_far = cm_less(z, none);
    r.t.half_sine = CM_SELECT(is_far, greater, smaller);
    r.t.half_cosine = CM_SELECT(is_far, smaller, greater);
    r.t.cosine = CM_LIT(2.0) * ((z * over) * greater);
    r.sine = CM_LIT(2.0) * (smaller * greater);
    CM_REAL of_cosines = (r.t.half_cosine - k.k1) * (r.t.half_cosine + k.k1);
    CM_REAL of_sines = (k.k0 - r.t.half_sine) * (k.k0 + r.t.half_sine);
    r.t.margin = CM_SELECT(cm_equal(k.k2, none), CM_LIT(0.5) * r.t.cosine,
                           CM_SELECT(cm_less(k.k1, k.k0), of_cosines, of_sines));

    CM_REAL to_unit = one / CM_SELECT(on_axis, one, from_axis);
    r.unit_east = y1 * to_unit;
    r.unit_south = CM_SELECT(on_axis, one, x1 * to_unit);
    r.east = CM_SELECT(is_far, r.unit_east * greater, y * over);
    r.south = CM_SELECT(is_far, r.unit_south * greater, x * over);
    /* x and y are exact, and what is made of them is not */
    CM_REAL apart = cm_abs(y1) - cm_abs(x1);
    r.gap = CM_SELECT(is_far, CM_SELECT(on_axis, -greater, (apart * to_unit) * greater),
                      (cm_abs(y) - cm_abs(x)) * over);
    return r;
}

/* The disc's point for a bearing and its radius. What is beyond the rim is put on it. */
CM_FN CM_NAME(cm_disc_point)
    CM_NAME(cm_azimuthal_point)(CM_NAME(cm_bearing) b, CM_NAME(cm_radius) r)
{
    CM_BOOL beyond = cm_less(b.t.margin, CM_LIT(0.0));
    /* by as much longer as the unit vector is too short */
    CM_REAL lacking = CM_LIT(0.5) * CM_NAME(cm_disc_rim)(b.unit_east, b.unit_south);
    CM_REAL radius = CM_SELECT(beyond, CM_LIT(1.0), r.radius);
    CM_BOOL by_ratio = cm_equal(radius, CM_LIT(0.0));
    radius = radius + radius * lacking;
    CM_NAME(cm_disc_point) d;
    d.rim = CM_SELECT(beyond, CM_LIT(0.0), cm_max(r.rim, CM_LIT(0.0)));
    d.u = CM_SELECT(by_ratio, b.east * r.ratio, b.unit_east * radius);
    d.v = -CM_SELECT(by_ratio, b.south * r.ratio, b.unit_south * radius);
    d.gap = b.gap * CM_SELECT(beyond, CM_LIT(1.0) / b.t.half_sine, r.ratio);
    return d;
}

/* The unit direction of a disc's point whose angle is known. Its sine and cosine have errors of their own, and
 * what these have in common is the length's. A zero keeps its sign. */
CM_FN CM_NAME(cm_xyz)
    CM_NAME(cm_azimuthal_direction)(CM_NAME(cm_disc_point) d, CM_NAME(cm_angle) angle)
{
    CM_REAL x = -(d.v * angle.ratio);
    CM_REAL y = d.u * angle.ratio;
    CM_REAL z = angle.cosine;
    CM_REAL lacking = CM_LIT(0.5) * ((CM_LIT(1.0) - z * z) - (x * x + y * y));
    CM_NAME(cm_xyz) r;
    r.x = cm_copysign(x + x * lacking, x);
    r.y = cm_copysign(y + y * lacking, y);
    r.z = cm_copysign(z + z * lacking, z);
    return r;
}

/* The gradients of u and v, which stand as a and b, by a direction of unit length. */
CM_FN CM_NAME(cm_gradients)
    CM_NAME(cm_azimuthal_gradients_of)(CM_NAME(cm_bearing) b, CM_NAME(cm_radius) r)
{
    CM_REAL across = r.ratio / (CM_LIT(2.0) * b.t.half_cosine); /* r / sin t */
    CM_REAL outwards = r.slope * b.t.cosine;
    CM_REAL down = -(r.slope * b.sine);
    CM_REAL east = b.unit_east;
    CM_REAL south = b.unit_south;
    CM_NAME(cm_gradients) g;
    g.a_x = (outwards - across) * (east * south);
    g.a_y = outwards * (east * east) + across * (south * south);
    g.a_z = down * east;
    g.b_x = -(outwards * (south * south) + across * (east * east));
    g.b_y = -((outwards - across) * (east * south));
    g.b_z = -(down * south);
    return g;
}

/* The derivatives of the unit direction by u and v, which stand as a and b. */
CM_FN CM_NAME(cm_tangents)
    CM_NAME(cm_azimuthal_tangents_of)(CM_NAME(cm_disc_point) d, CM_NAME(cm_angle) angle)
{
    CM_REAL none = CM_LIT(0.0);
    CM_REAL scale = CM_NAME(cm_azimuthal_scale)(cm_max(cm_abs(d.u), cm_abs(d.v)));
    CM_REAL u = d.u * scale;
    CM_REAL v = d.v * scale;
    CM_REAL length = cm_sqrt(u * u + v * v);
    CM_BOOL at_centre = cm_equal(length, none);
    CM_REAL over = CM_LIT(1.0) / CM_SELECT(at_centre, CM_LIT(1.0), length);
    CM_REAL east = u * over;
    CM_REAL north = CM_SELECT(at_centre, CM_LIT(-1.0), v * over);
    CM_REAL radius = length / scale;
    CM_REAL outwards = angle.cosine * angle.slope;
    CM_REAL down = -((angle.ratio * radius) * angle.slope);
    CM_NAME(cm_tangents) t;
    t.x_a = (angle.ratio - outwards) * (east * north);
    t.x_b = -(outwards * (north * north) + angle.ratio * (east * east));
    t.y_a = outwards * (east * east) + angle.ratio * (north * north);
    t.y_b = (outwards - angle.ratio) * (east * north);
    t.z_a = down * east;
    t.z_b = down * north;
    return t;
}

/* The kernels of a projection from its law. */
#define CM_LAW_KERNELS(point, direction, gradients, tangents, radius, angle)                       \
    CM_FN CM_NAME(cm_disc_point)                                                                   \
        CM_NAME(point)(CM_REAL x, CM_REAL y, CM_REAL z, CM_NAME(cm_constants) k)                   \
    {                                                                                              \
        CM_NAME(cm_bearing) b = CM_NAME(cm_azimuthal_bearing)(x, y, z, k);                         \
        return CM_NAME(cm_azimuthal_point)(b, CM_NAME(radius)(b.t, k));                            \
    }                                                                                              \
    CM_FN CM_NAME(cm_xyz) CM_NAME(direction)(CM_NAME(cm_disc_point) d, CM_NAME(cm_constants) k)    \
    {                                                                                              \
        return CM_NAME(cm_azimuthal_direction)(d,                                                  \
                                               CM_NAME(angle)(d.u * d.u + d.v * d.v, d.rim, k));   \
    }                                                                                              \
    CM_FN CM_NAME(cm_gradients)                                                                    \
        CM_NAME(gradients)(CM_REAL x, CM_REAL y, CM_REAL z, CM_NAME(cm_constants) k)               \
    {                                                                                              \
        CM_NAME(cm_bearing) b = CM_NAME(cm_azimuthal_bearing)(x, y, z, k);                         \
        return CM_NAME(cm_azimuthal_gradients_of)(b, CM_NAME(radius)(b.t, k));                     \
    }                                                                                              \
    CM_FN CM_NAME(cm_tangents)                                                                     \
        CM_NAME(tangents)(CM_NAME(cm_disc_point) d, CM_NAME(cm_constants) k)                       \
    {                                                                                              \
        return CM_NAME(cm_azimuthal_tangents_of)(d,                                                \
                                                 CM_NAME(angle)(d.u * d.u + d.v * d.v, d.rim, k)); \
    }

#endif
