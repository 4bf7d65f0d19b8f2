/* SPDX-License-Identifier: MIT
 *
 * The loops from longitude and latitude to directions and back, for one instruction set in double. Read by
 * batch_precision.h after lanes/words.h. n is a multiple of LANES.
 */

CM_STRUCT(lonlat_sine_cosine)
{
    CM_REAL sine;
    CM_REAL cosine;
}
CM_STRUCT_END(lonlat_sine_cosine)

/* For |x| <= CM_LONLAT_WHOLE, radians. x is reduced by a multiple k of pi / 2 in three parts of 33, 33 and
 * 53 bits (Cody and Waite 1980), so that the products with k < 2^20 are exact; what the second difference
 * loses is kept. Within 0.9 ulp of 1 each, and relatively accurate for small x. */
CM_FN CM_NAME(lonlat_sine_cosine) CM_NAME(lonlat_turn)(CM_REAL x)
{
    CM_REAL magic = CM_LIT(6755399441055744.0); /* 1.5 * 2^52: rounds, for either sign */
    CM_REAL shifted = cm_mad(x, CM_LIT(0.63661977236758134308), magic);
    CM_REAL k = shifted - magic;
    lanes_words quadrant = lanes_words_of_bits(shifted);
    CM_REAL first = x - k * CM_LIT(0x1.921fb544p0);
    CM_REAL product = k * CM_LIT(0x1.0b4611a6p-34);
    CM_REAL head = first - product;
    CM_REAL tail = ((first - head) - product) - k * CM_LIT(0x1.3198a2e037073p-69);
    CM_REAL s = CM_NAME(cm_sin_quarter)(head);
    CM_REAL versine = CM_NAME(cm_versine_quarter)(head);
    CM_REAL c = CM_LIT(1.0) - cm_mad(tail, s, versine);
    s = CM_SELECT(cm_equal(tail, CM_LIT(0.0)), s, cm_mad(tail, CM_LIT(1.0) - versine, s));

    lanes_words sign = lanes_words_all(0x8000000000000000u);
    lanes_words swapped = lanes_words_all(0) - (quadrant & lanes_words_all(1));
    lanes_words words_s = lanes_words_of_bits(s);
    lanes_words words_c = lanes_words_of_bits(c);
    lanes_words exchange = (words_s ^ words_c) & swapped;
    lanes_words sine = words_s ^ exchange ^ ((quadrant << 62) & sign);
    lanes_words cosine = words_c ^ exchange ^ (((quadrant + lanes_words_all(1)) << 62) & sign);
    CM_NAME(lonlat_sine_cosine) r;
    r.sine = lanes_bits_of_words(sine);
    r.cosine = lanes_bits_of_words(cosine);
    return r;
}

/* The angle of the point (x, y), as C's atan2; x and y so large that their quotient is exact to rounding.
 * Within 1.5 ulp. */
CM_FN CM_REAL CM_NAME(lonlat_angle)(CM_REAL y, CM_REAL x)
{
    CM_REAL a = cm_abs(x);
    CM_REAL b = cm_abs(y);
    CM_BOOL steep = cm_less(a, b);
    CM_REAL major = CM_SELECT(steep, b, a);
    CM_REAL minor = CM_SELECT(steep, a, b);
    CM_REAL t = minor / CM_SELECT(cm_less(CM_LIT(0.0), major), major, CM_LIT(1.0));
    CM_REAL angle = cm_mad(t, CM_NAME(cm_atan_excess)(t * t), t);
    angle = CM_SELECT(cm_equal(t, CM_LIT(0.0)), t, angle);
    /* from the nearest axis, which is a number and what it lacks */
    CM_BOOL behind = cm_less(cm_copysign(CM_LIT(1.0), x), CM_LIT(0.0));
    CM_REAL none = CM_LIT(0.0);
    CM_REAL axis = CM_SELECT(steep, CM_LIT(1.5707963267948966),
                             CM_SELECT(behind, CM_LIT(3.1415926535897931), none));
    CM_REAL rest = CM_SELECT(steep, CM_LIT(6.123233995736766e-17),
                             CM_SELECT(behind, CM_LIT(1.2246467991473532e-16), none));
    CM_REAL opposite = CM_SELECT(behind, angle, -angle);
    angle = axis + (CM_SELECT(steep, opposite, -opposite) + rest);
    return cm_copysign(angle, y);
}

/* Directions of length 1; NaN for what is none, and for longitudes beyond CM_LONLAT_WHOLE. */
static void BATCH_NAME(directions_of_lonlat)(size_t n, const double *lon, const double *lat,
                                             double *x, double *y, double *z)
{
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_REAL along = lanes_load(lon + i);
        CM_REAL height = lanes_load(lat + i);
        CM_REAL pole = CM_LIT(1.5707963267948966);
        CM_BOOL good = cm_both(cm_at_least(CM_LIT(CM_LONLAT_WHOLE), cm_abs(along)),
                               cm_at_least(pole + CM_LIT(1.0e-9), cm_abs(height)));
        height = cm_copysign(cm_min(cm_abs(height), pole), height);
        CM_NAME(lonlat_sine_cosine) a = CM_NAME(lonlat_turn)(along);
        CM_NAME(lonlat_sine_cosine) b = CM_NAME(lonlat_turn)(height);
        lanes_store(x + i, lanes_or_nan(good, b.cosine * a.cosine));
        lanes_store(y + i, lanes_or_nan(good, b.cosine * a.sine));
        lanes_store(z + i, lanes_or_nan(good, b.sine));
    }
}

/* Of directions of length 1 or NaN. */
static void BATCH_NAME(lonlats_of_direction)(size_t n, const double *x, const double *y,
                                             const double *z, double *lon, double *lat)
{
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_REAL a = lanes_load(x + i);
        CM_REAL b = lanes_load(y + i);
        CM_REAL c = lanes_load(z + i);
        lanes_store(lon + i, CM_NAME(lonlat_angle)(b, a));
        lanes_store(lat + i, CM_NAME(lonlat_angle)(c, cm_sqrt(cm_mad(a, a, b * b))));
    }
}

static const cm_lonlat_loops BATCH_NAME(lonlat_loops) = {
    .directions = BATCH_NAME(directions_of_lonlat),
    .lonlats = BATCH_NAME(lonlats_of_direction),
};
