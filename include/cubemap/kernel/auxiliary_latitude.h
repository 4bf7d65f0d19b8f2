/* SPDX-License-Identifier: MIT
 *
 * latitude: from one latitude of an ellipsoid to another. Not a mapping.
 *
 * Two ways, each for an angle and for a direction whose latitude it is. A series, for flattenings up to 1/50:
 * the other latitude is the one, phi, plus
 *
 *     d = sum C_k sin 2k phi = sin 2phi P(cos 2phi)
 *
 * P a polynomial, which research/earth/latitude-series has the coefficients for (Karney, On auxiliary latitudes,
 * Survey Review 56, 2024). And a ratio of tangents, for any flattening. The number of terms, or whether the
 * ratio is near 1, is the same for all points, so that the branches on it are none.
 *
 * Angles are added to, so that what rounding there is stands in the sum; sine and cosine become
 *
 *     sin (phi + d) = sin phi (cos d + 2 cos^2 phi P sin d / d)
 *     cos (phi + d) = cos phi (cos d - 2 sin^2 phi P sin d / d)
 *
 * which are relatively accurate at the poles and at the equator.
 */
#ifndef CM_DESCRIPTORS

#define CM_LATITUDE_TERMS_MAX 12

/* p0, p1, ... are those of P(x), 0 beyond the last term; or ratio is that of the tangents. */
CM_STRUCT(cm_latitude_constants)
{
    CM_REAL p0;
    CM_REAL p1;
    CM_REAL p2;
    CM_REAL p3;
    CM_REAL p4;
    CM_REAL p5;
    CM_REAL p6;
    CM_REAL p7;
    CM_REAL p8;
    CM_REAL p9;
    CM_REAL p10;
    CM_REAL p11;
    CM_REAL ratio;
}
CM_STRUCT_END(cm_latitude_constants)

/* A quarter turn, as a number and what it lacks. */
#if CM_REAL_BITS == 32
#define CM_LATITUDE_POLE CM_LIT(1.57079637050628662)
#define CM_LATITUDE_POLE_REST CM_LIT(-4.37113900018624283e-8)
#elif CM_REAL_BITS == 64
#define CM_LATITUDE_POLE CM_LIT(1.5707963267948965579989817342721)
#define CM_LATITUDE_POLE_REST CM_LIT(6.1232339957367658e-17)
#else
#define CM_LATITUDE_POLE CM_LIT(1.57079632679489661923132169163975140)
#define CM_LATITUDE_POLE_REST CM_LIT(4.33590506506189051239852201302167613e-35)
#endif

/* The square root of CM_AZIMUTHAL_DOWN. */
#if CM_REAL_BITS == 32
#define CM_LATITUDE_DOWN CM_LIT(2.842170943040401e-14) /* 2^-45 */
#else
#define CM_LATITUDE_DOWN CM_LIT(4.360150876168346337187895005437244260605e-106) /* 2^-350 */
#endif

/* P(x) with 3, 6 or 12 terms. */
CM_FN CM_REAL CM_NAME(cm_latitude_sum)(CM_REAL x, int terms, CM_NAME(cm_latitude_constants) k)
{
    CM_REAL a = cm_mad(x, cm_mad(x, k.p2, k.p1), k.p0);
    if (terms > 3)
    {
        CM_REAL x3 = x * x * x;
        CM_REAL b = cm_mad(x, cm_mad(x, k.p5, k.p4), k.p3);
        if (terms > 6)
        {
            CM_REAL c = cm_mad(x, cm_mad(x, k.p8, k.p7), k.p6);
            CM_REAL d = cm_mad(x, cm_mad(x, k.p11, k.p10), k.p9);
            b = cm_mad(x3, cm_mad(x3, d, c), b);
        }
        a = cm_mad(x3, b, a);
    }
    return a;
}

/* The sine and cosine of a latitude in [0, pi / 2], of which the lesser is that of an angle t in [0, pi / 4]. */
CM_STRUCT(cm_latitude_sines)
{
    CM_BOOL polar; /* above 45 degrees? */
    CM_REAL lesser;
    CM_REAL greater;
}
CM_STRUCT_END(cm_latitude_sines)

CM_FN CM_NAME(cm_latitude_sines) CM_NAME(cm_latitude_sine_cosine)(CM_REAL latitude)
{
    CM_REAL colatitude = (CM_LATITUDE_POLE - latitude) + CM_LATITUDE_POLE_REST;
    CM_NAME(cm_latitude_sines) r;
    r.polar = cm_less(CM_LIT(0.785398163397448309615660845819875721), latitude);
    CM_REAL t = CM_SELECT(r.polar, colatitude, latitude);
    r.lesser = CM_NAME(cm_sin_quarter)(t);
    r.greater = CM_LIT(1.0) - CM_NAME(cm_versine_quarter)(t);
    return r;
}

/* |latitude| at most pi / 2, which stays what it is. */
CM_FN CM_REAL CM_NAME(cm_latitude_series_angle)(CM_REAL latitude, int terms,
                                                CM_NAME(cm_latitude_constants) k)
{
    CM_REAL size = cm_abs(latitude);
    CM_NAME(cm_latitude_sines) s = CM_NAME(cm_latitude_sine_cosine)(size);
    CM_REAL twice = CM_LIT(2.0) * s.lesser;
    CM_REAL cosine = cm_mad(-twice, s.lesser, CM_LIT(1.0)); /* of 2 t */
    CM_REAL x = CM_SELECT(s.polar, -cosine, cosine);
    CM_REAL sum = CM_NAME(cm_latitude_sum)(x, terms, k);
    return cm_copysign(cm_mad(twice * s.greater, sum, size), latitude);
}

/* The latitude whose tangent is ratio times that of this one. With is_near, for a ratio within a quarter of 1,
 * it is the sum of this one and the difference; else it is an angle of its own. */
CM_FN CM_REAL CM_NAME(cm_latitude_tangent_angle)(CM_REAL latitude, int is_near,
                                                 CM_NAME(cm_latitude_constants) k)
{
    CM_REAL none = CM_LIT(0.0);
    CM_REAL size = cm_abs(latitude);
    CM_NAME(cm_latitude_sines) s = CM_NAME(cm_latitude_sine_cosine)(size);
    CM_REAL sine = CM_SELECT(s.polar, s.greater, s.lesser);
    CM_REAL cosine = CM_SELECT(s.polar, s.lesser, s.greater);
    CM_REAL up = k.ratio * sine;
    CM_REAL along = cosine;
    CM_REAL base = none;
    if (is_near != 0)
    {
        up = (k.ratio - CM_LIT(1.0)) * (sine * cosine);
        along = cm_mad(cosine, cosine, k.ratio * (sine * sine));
        base = size;
    }
    CM_BOOL steep = cm_less(along, cm_abs(up));
    CM_REAL tangent = CM_SELECT(steep, along, up) / CM_SELECT(steep, up, along);
    CM_REAL angle = cm_mad(tangent, CM_NAME(cm_atan_excess)(tangent * tangent), tangent);
    CM_REAL turned = CM_LATITUDE_POLE - (angle - CM_LATITUDE_POLE_REST);
    CM_REAL other = base + CM_SELECT(steep, turned, angle);
    other = CM_SELECT(cm_less(size, CM_LATITUDE_POLE), other, CM_LATITUDE_POLE);
    return cm_copysign(other, latitude);
}

/* A direction's inverse length without over- and underflow, as two factors, powers of two in them. */
CM_STRUCT(cm_latitude_length)
{
    CM_REAL before; /* for the components; exact but where the result is next to nothing */
    CM_REAL after;  /* for what then has become of them */
    CM_REAL across; /* cos^2 of the latitude */
    CM_REAL along;  /* sin^2 */
}
CM_STRUCT_END(cm_latitude_length)

CM_FN CM_NAME(cm_latitude_length)
    CM_NAME(cm_latitude_length_of)(CM_REAL x, CM_REAL y, CM_REAL z, CM_REAL ratio)
{
    CM_REAL one = CM_LIT(1.0);
    CM_REAL scale = CM_NAME(cm_azimuthal_scale)(CM_NAME(cm_magnitude)(x, y, z));
    x = x * scale;
    y = y * scale;
    z = (z * scale) * ratio;
    CM_REAL across = cm_mad(x, x, y * y);
    CM_REAL over = CM_NAME(cm_inverse_root)(cm_mad(z, z, across));
    CM_REAL over2 = over * over;
    CM_NAME(cm_latitude_length) r;
    CM_BOOL is_long = cm_less(scale, one);
    r.before = CM_SELECT(is_long, CM_LATITUDE_DOWN, scale);
    r.after = over * CM_SELECT(is_long, CM_LATITUDE_DOWN, one);
    r.across = across * over2;
    r.along = (z * z) * over2;
    return r;
}

/* x, y, z finite and not all zero, of any length; the result has length 1. */
CM_FN CM_NAME(cm_xyz)
    CM_NAME(cm_latitude_series_direction)(CM_REAL x, CM_REAL y, CM_REAL z, int terms,
                                          CM_NAME(cm_latitude_constants) k)
{
    CM_NAME(cm_latitude_length) l = CM_NAME(cm_latitude_length_of)(x, y, z, CM_LIT(1.0));
    CM_REAL sum = CM_LIT(2.0) * CM_NAME(cm_latitude_sum)(l.across - l.along, terms, k);
    CM_REAL d2 = (l.across * l.along) * (sum * sum);
    /* Taylor's series: d is 0.021 at most */
    CM_REAL versine =
        cm_mad(d2, cm_mad(d2, CM_LIT(1.388888888888888889e-3), CM_LIT(-4.166666666666666667e-2)),
               CM_LIT(0.5)) *
        d2;
    CM_REAL sinc = cm_mad(
        d2,
        cm_mad(d2, cm_mad(d2, CM_LIT(-1.984126984126984127e-4), CM_LIT(8.333333333333333333e-3)),
               CM_LIT(-0.1666666666666666667)),
        CM_LIT(1.0));
    CM_REAL turn = sum * sinc;
    CM_REAL beside = CM_LIT(1.0) + cm_mad(-l.along, turn, -versine);
    CM_REAL up = CM_LIT(1.0) + cm_mad(l.across, turn, -versine);
    beside = beside * l.after;
    CM_NAME(cm_xyz) r;
    r.x = (x * l.before) * beside;
    r.y = (y * l.before) * beside;
    r.z = (z * l.before) * (up * l.after);
    return r;
}

CM_FN CM_NAME(cm_xyz) CM_NAME(cm_latitude_tangent_direction)(CM_REAL x, CM_REAL y, CM_REAL z,
                                                             CM_NAME(cm_latitude_constants) k)
{
    CM_NAME(cm_latitude_length) l = CM_NAME(cm_latitude_length_of)(x, y, z, k.ratio);
    CM_NAME(cm_xyz) r;
    r.x = (x * l.before) * l.after;
    r.y = (y * l.before) * l.after;
    r.z = (z * l.before) * (k.ratio * l.after);
    return r;
}

#endif
