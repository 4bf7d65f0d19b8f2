/* SPDX-License-Identifier: MIT
 *
 * Closed forms of latitudes, for any flattening. All go through the parametric latitude beta, and all work on
 * tangents, so that nothing is lost at poles and equator: each latitude has the ratio of its tangent to that of
 * beta, which is a smooth function between two constants. Every sum here is one of numbers of one sign; so
 * no digit cancels, whatever the flattening. With h = sqrt(cos^2 beta + (a / b)^2 sin^2 beta):
 *
 *   authalic     sin xi = I(sin beta) / I(1), I(s) the integral of sqrt(1 + m t^2) up to s, m = (a / b)^2 - 1;
 *                with t = sinh u / sqrt m, or for prolate ones sin u / sqrt |m|, elementary, and so is
 *                I(1) - I(s), which cos xi comes from
 *   conformal    asinh tan chi = asinh tan phi - e atanh(e sin phi); for oblate ones as
 *                (atanh sin phi - atanh(e sin phi)) + (1 - e) atanh(e sin phi)
 *   rectifying   mu is the arc, the integral of h, in quadrants, taken from the nearer end: Carlson's R_F and
 *                R_D in those forms of DLMF 19.25.9 and .10 that have no difference
 *
 * Back by Newton's method on the logarithms of the tangents, whose slope is 1 at both ends, in a bracket.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "latitude_shape.h"

static const double half_pi = 1.5707963267948966;
static const double half_pi_rest = 6.123233995736766e-17;

/* A parametric latitude. */
typedef struct place
{
    double tangent;
    double sine;
    double cosine;
    double stretch; /* h */
} place;

/* The tangent of another latitude there, and how its logarithm changes with that of beta's. */
typedef struct value
{
    double tangent;
    double slope;
} value;

static place place_of(const cm_latitude_shape *shape, double tangent)
{
    place p = {.tangent = tangent};
    double length = sqrt(1.0 + tangent * tangent);
    p.sine = tangent / length;
    p.cosine = 1.0 / length;
    p.stretch = hypot(p.cosine, shape->ratio * p.sine);
    return p;
}

/* ---- Authalic ---- */

/* u / t where t = sinh u or sin u; cosine is cos u. */
static double angle_over(const cm_latitude_shape *shape, double t, double cosine)
{
    if (t == 0.0)
    {
        return 1.0;
    }
    return (shape->m > 0.0 ? asinh(t) : atan2(t, cosine)) / t;
}

/* u / sin u - 1 by the Taylor series of u - sin u, u at most pi / 2. */
static double arc_excess(double sine, double cosine)
{
    double u = atan2(sine, cosine);
    double z = u * u;
    double series = 1.0;
    for (int i = 21; i >= 3; i -= 2)
    {
        series = 1.0 - z / ((i + 1) * (i + 2)) * series;
    }
    return sine > 0.0 ? z / 6.0 * series * (u / sine) : 0.0;
}

/* I(s) / s */
static double zone_over_sine(const cm_latitude_shape *shape, place p)
{
    return 0.5 * (p.stretch + angle_over(shape, shape->root_m * p.sine, p.stretch));
}

/* (I(1) - I(s)) / cos^2 beta. Over the difference of u(1) and u(s), whose sinh or sin is root_m times the
 * first factor. */
static double cap_over_square(const cm_latitude_shape *shape, place p)
{
    double r = shape->ratio;
    double part = 1.0 / (p.stretch + r * p.sine);
    double t = shape->root_m * p.cosine * p.cosine * part;
    if (shape->m > 0.0)
    {
        return 0.5 * part * (angle_over(shape, t, 0.0) + (p.stretch * r + shape->m * p.sine));
    }
    double cosine = p.stretch * r - shape->m * p.sine;
    double sum = p.stretch + r;
    return 0.5 * part * (arc_excess(t, cosine) + sum * sum / (1.0 + cosine));
}

static value authalic(const cm_latitude_shape *shape, place p)
{
    double over_sine = zone_over_sine(shape, p);
    double over_square = cap_over_square(shape, p);
    double both = over_square * (shape->zone + over_sine * p.sine);
    value v;
    v.tangent = p.tangent * (over_sine / sqrt(both));
    v.slope = p.stretch / over_sine * (shape->zone * shape->zone / both);
    return v;
}

/* ---- Conformal ---- */

/* For prolate ones: e atan(e s) as a number and what it lacks. Where it is large its error would be that of
 * the tangent, times its size. */
static double growth(const cm_latitude_shape *shape, double sine, double *rest)
{
    double t = shape->e * sine;
    *rest = 0.0;
    if (t <= 1.0)
    {
        return shape->e * atan(t);
    }
    double whole = shape->e * half_pi;
    double whole_rest =
        fma(shape->e, half_pi, -whole) + (shape->e * half_pi_rest + shape->e_rest * half_pi);
    double lacking = shape->e * atan(1.0 / t);
    double sum = whole - lacking;
    *rest = ((whole - sum) - lacking) + whole_rest;
    return sum;
}

static value conformal(const cm_latitude_shape *shape, place p)
{
    double tangent = p.tangent * shape->ratio; /* of phi */
    double length = sqrt(1.0 + tangent * tangent);
    double sine = tangent / length;
    double w = hypot(1.0 / length, shape->axes * sine); /* sqrt(1 - e^2 sin^2 phi) */
    value v;
    if (shape->m > 0.0)
    {
        double less = (1.0 - shape->e) - shape->e_rest;
        double first = less * tangent / w;
        double second = less * asinh(shape->e * sine / w);
        v.tangent = first * cosh(second) + sqrt(1.0 + first * first) * sinh(second);
    }
    else
    {
        double rest;
        double g = growth(shape, sine, &rest);
        double up = sinh(g);
        double along = cosh(g);
        v.tangent = tangent * (along + rest * up) + length * (up + rest * along);
    }
    double part = shape->axes / w;
    v.slope = part * part * sine * (hypot(1.0, v.tangent) / v.tangent);
    return v;
}

/* ---- Rectifying ---- */

/* Carlson, Numerical computation of real or complex elliptic integrals, Numer. Algorithms 10 (1995): duplication
 * until a series of order 7 has full double precision. No argument is below 0, and one at most is 0. */
#define CARLSON_STEPS 40 /* some six are taken */

typedef struct carlson
{
    double x, y, z;
    double mean; /* with weights */
    double part; /* of the first distances from the mean, those that are left */
    double over; /* the sum of R_D's terms outside the series */
} carlson;

/* mean is that of x, y and z with weights. */
static carlson carlson_duplicate(double x, double y, double z, double mean)
{
    carlson at = {x, y, z, mean, 1.0, 0.0};
    const double wide = fmax(fabs(mean - x), fmax(fabs(mean - y), fabs(mean - z))) * 150.0;
    for (int i = 0; i < CARLSON_STEPS && wide * at.part > at.mean; i++)
    {
        const double a = sqrt(at.x);
        const double b = sqrt(at.y);
        const double c = sqrt(at.z);
        const double lambda = a * b + a * c + b * c;
        at.over += at.part / (c * (at.z + lambda));
        at.mean = 0.25 * (at.mean + lambda);
        at.x = 0.25 * (at.x + lambda);
        at.y = 0.25 * (at.y + lambda);
        at.z = 0.25 * (at.z + lambda);
        at.part *= 0.25;
    }
    return at;
}

static double carlson_f(double x, double y, double z)
{
    const double mean = (x + y + z) / 3.0;
    const carlson at = carlson_duplicate(x, y, z, mean);
    const double u = (mean - x) * at.part / at.mean;
    const double v = (mean - y) * at.part / at.mean;
    double w = -(u + v);
    double e2 = u * v - w * w;
    double e3 = u * v * w;
    double series = 1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - 3.0 * e2 * e3 / 44.0 -
                    5.0 * e2 * e2 * e2 / 208.0 + 3.0 * e3 * e3 / 104.0 + e2 * e2 * e3 / 16.0;
    return series / sqrt(at.mean);
}

static double carlson_d(double x, double y, double z)
{
    const double mean = (x + y + 3.0 * z) / 5.0;
    const carlson at = carlson_duplicate(x, y, z, mean);
    const double u = (mean - x) * at.part / at.mean;
    const double v = (mean - y) * at.part / at.mean;
    double w = -(u + v) / 3.0;
    double e2 = u * v - 6.0 * w * w;
    double e3 = (3.0 * u * v - 8.0 * w * w) * w;
    double e4 = 3.0 * (u * v - w * w) * w * w;
    double e5 = u * v * w * w * w;
    double series = 1.0 - 3.0 * e2 / 14.0 + e3 / 6.0 + 9.0 * e2 * e2 / 88.0 - 3.0 * e4 / 22.0 -
                    9.0 * e2 * e3 / 52.0 + 3.0 * e5 / 26.0 - e2 * e2 * e2 / 16.0 +
                    3.0 * e3 * e3 / 40.0 + 3.0 * e2 * e4 / 20.0 + 45.0 * e2 * e2 * e3 / 272.0 -
                    9.0 * (e3 * e4 + e2 * e5) / 68.0;
    return 3.0 * at.over + at.part * series / (at.mean * sqrt(at.mean));
}

/* The integral of sqrt(cos^2 t + r^2 sin^2 t) from 0 to the angle of this sine and cosine; m = r^2 - 1. */
static double arc(double sine, double cosine, double r, double m)
{
    double x = cosine * cosine;
    double s2 = sine * sine;
    double r2 = r * r;
    double y = x + r2 * s2;
    if (m >= 0.0)
    {
        return sine * (carlson_f(x, y, 1.0) + m / 3.0 * s2 * carlson_d(x, y, 1.0));
    }
    return sine * (r2 * carlson_f(x, y, 1.0) - m * r2 / 3.0 * s2 * carlson_d(x, 1.0, y) -
                   m * cosine / sqrt(y));
}

/* The quadrant of the meridian over b. Of mild ellipsoids by Gauss and Kummer's series in n^2 = ((a - b) / (a + b))^2, which
 * has a third of the rounding. */
static double quadrant_of(const cm_latitude_shape *shape, double f)
{
    static const double series[] = {
        1.0, 1.0 / 4.0, 1.0 / 64.0, 1.0 / 256.0, 25.0 / 16384.0, 49.0 / 65536.0, 441.0 / 1048576.0};
    double n = f / (2.0 - f);
    double sum = 0.0;
    if (fabs(n) > 0.1)
    {
        return arc(1.0, 0.0, shape->ratio, shape->m);
    }
    for (size_t i = sizeof series / sizeof *series; i-- > 0;)
    {
        sum = sum * (n * n) + series[i];
    }
    return 0.5 * half_pi * (1.0 + shape->ratio) * sum;
}

static value rectifying(const cm_latitude_shape *shape, place p)
{
    double r = shape->ratio;
    double scale = half_pi / shape->quadrant;
    double mu = scale * arc(p.sine, p.cosine, r, shape->m);
    value v;
    if (mu < 0.5 * half_pi)
    {
        v.tangent = tan(mu);
    }
    else
    {
        double axes = shape->axes;
        v.tangent = 1.0 / tan(scale * r * arc(p.cosine, p.sine, axes, -shape->m * axes * axes));
    }
    v.slope = scale * p.stretch * (p.sine * p.cosine) * (1.0 / v.tangent + v.tangent);
    return v;
}

/* ---- All of them ---- */

static value value_at(const cm_latitude_shape *shape, cm_latitude latitude, double tangent)
{
    place p = place_of(shape, tangent);
    switch (latitude)
    {
    case CM_LATITUDE_AUTHALIC:
        return authalic(shape, p);
    case CM_LATITUDE_CONFORMAL:
        return conformal(shape, p);
    case CM_LATITUDE_RECTIFYING:
        return rectifying(shape, p);
    case CM_LATITUDE_GEOGRAPHIC:
    case CM_LATITUDE_GEOCENTRIC:
    case CM_LATITUDE_PARAMETRIC:
    case CM_LATITUDE_AUTHALIC_APPROXIMATION:
        break;
    }
    return (value){tangent * shape->least[latitude], 1.0};
}

static int has_constant_ratio(cm_latitude latitude)
{
    return latitude != CM_LATITUDE_AUTHALIC && latitude != CM_LATITUDE_CONFORMAL &&
           latitude != CM_LATITUDE_RECTIFYING;
}

/* The parametric latitude's tangent from another's: some five steps of Newton's method. A step that leaves the
 * bracket, or is not half as long as the one before, is replaced by bisection of the logarithm's bracket, so that
 * the end comes, after some 200 steps at the latest. */
static double parametric_tangent(const cm_latitude_shape *shape, cm_latitude latitude,
                                 double tangent)
{
    if (has_constant_ratio(latitude))
    {
        return tangent / shape->least[latitude];
    }
    double low = tangent / shape->greatest[latitude];
    double high = tangent / shape->least[latitude];
    double at = sqrt(low) * sqrt(high);
    double before = HUGE_VAL;
    for (int i = 0; i < 200; i++)
    {
        value v = value_at(shape, latitude, at);
        double step = log(tangent / v.tangent) / v.slope;
        if (fabs(step) < 1e-8)
        {
            return at + at * step;
        }
        low = step > 0.0 ? at : low;
        high = step < 0.0 ? at : high;
        double next = at * exp(step);
        if (!(next >= low && next <= high && fabs(step) <= 0.5 * before))
        {
            next = sqrt(low) * sqrt(high);
            step = log(next / at);
        }
        before = fabs(step);
        at = next;
    }
    return at;
}

/* A tangent beyond these has the ratio of the end: the next term is their square. */
#define TANGENT_LEAST 1e-100
#define TANGENT_GREATEST 1e100

double cm_latitude_ratio(const cm_latitude_shape *shape, cm_latitude from, cm_latitude to,
                         double sine, double cosine)
{
    double tangent = sine < TANGENT_LEAST * cosine   ? TANGENT_LEAST
                     : cosine < TANGENT_LEAST * sine ? TANGENT_GREATEST
                                                     : sine / cosine;
    double parametric = parametric_tangent(shape, from, tangent);
    return value_at(shape, to, parametric).tangent / tangent;
}

/* What the root of |f (2 - f)| lacks. */
static double root_rest(double f, double root)
{
    double sum = 2.0 - f;
    double sum_rest = fabs(f) > 2.0 ? 2.0 - (sum + f) : (2.0 - sum) - f;
    double product = f * sum;
    double product_rest = fma(f, sum, -product) + f * sum_rest;
    double left = fma(-root, root, fabs(product)) + (product < 0.0 ? -product_rest : product_rest);
    return left / (2.0 * root);
}

void cm_latitude_shape_make(double f, cm_latitude_shape *shape)
{
    cm_latitude_shape s = {.axes = 1.0 - f};
    double axes_rest = (1.0 - s.axes) - f;
    double e2 = f * (2.0 - f);
    double over = 1.0 / s.axes;
    s.ratio = over - over * (fma(over, s.axes, -1.0) + over * axes_rest);
    double beyond = f * s.ratio; /* a / b - 1 */
    s.m = beyond * (2.0 + beyond);
    s.root_m = sqrt(fabs(s.m));
    s.e = sqrt(fabs(e2));
    s.e_rest = root_rest(f, s.e);
    s.zone = zone_over_sine(&s, (place){.sine = 1.0, .stretch = s.ratio});
    s.quadrant = quadrant_of(&s, f);
    s.least[CM_LATITUDE_GEOGRAPHIC] = s.ratio;
    s.least[CM_LATITUDE_GEOCENTRIC] = s.axes;
    s.least[CM_LATITUDE_PARAMETRIC] = 1.0;
    s.least[CM_LATITUDE_AUTHALIC_APPROXIMATION] = cbrt(s.axes);
    for (int i = 0; i < CM_LATITUDE_COUNT; i++)
    {
        if (has_constant_ratio((cm_latitude)i))
        {
            s.greatest[i] = s.least[i];
            continue;
        }
        double first = value_at(&s, (cm_latitude)i, TANGENT_LEAST).tangent / TANGENT_LEAST;
        double last = value_at(&s, (cm_latitude)i, TANGENT_GREATEST).tangent / TANGENT_GREATEST;
        s.least[i] = fmin(first, last) * (1.0 - 1e-6);
        s.greatest[i] = fmax(first, last) * (1.0 + 1e-6);
    }
    *shape = s;
}
