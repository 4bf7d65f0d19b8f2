/* SPDX-License-Identifier: MIT
 *
 * The loops over the kernels of latitudes (kernel/latitude.h), in double, for one instruction set. Read by
 * batch_precision.h. n is a multiple of LANES; a vector is read whole before it is written.
 */
#if defined(__GNUC__)
#define LATITUDE_FN static inline __attribute__((always_inline))
#else
#define LATITUDE_FN static inline
#endif

LATITUDE_FN CM_NAME(cm_latitude_constants) latitude_constants(const cm_latitude_constants_f64 *k)
{
    CM_NAME(cm_latitude_constants) r;
    r.p0 = lanes_all(k->p0);
    r.p1 = lanes_all(k->p1);
    r.p2 = lanes_all(k->p2);
    r.p3 = lanes_all(k->p3);
    r.p4 = lanes_all(k->p4);
    r.p5 = lanes_all(k->p5);
    r.p6 = lanes_all(k->p6);
    r.p7 = lanes_all(k->p7);
    r.p8 = lanes_all(k->p8);
    r.p9 = lanes_all(k->p9);
    r.p10 = lanes_all(k->p10);
    r.p11 = lanes_all(k->p11);
    r.ratio = lanes_all(k->ratio);
    return r;
}

/* terms: of the series; 0 for a ratio near 1 and -1 for others. */
LATITUDE_FN void latitude_angles(int terms, const cm_latitude_constants_f64 *constants, size_t n,
                                 const double *from, double *to)
{
    CM_NAME(cm_latitude_constants) k = latitude_constants(constants);
    CM_REAL pole = CM_LIT(1.5707963267948966);
    CM_REAL limit = pole + CM_LIT(1.0e-9);
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_REAL angle = lanes_load(from + i);
        CM_BOOL good = cm_at_least(limit, cm_abs(angle));
        CM_REAL inside = cm_copysign(cm_min(cm_abs(angle), pole), angle);
        CM_REAL other = terms > 0 ? CM_NAME(cm_latitude_series_angle)(inside, terms, k)
                                  : CM_NAME(cm_latitude_tangent_angle)(inside, terms == 0, k);
        lanes_store(to + i, lanes_or_nan(good, other));
    }
}

LATITUDE_FN void latitude_directions(int terms, const cm_latitude_constants_f64 *constants,
                                     size_t n, const double *x, const double *y, const double *z,
                                     double *to_x, double *to_y, double *to_z)
{
    CM_NAME(cm_latitude_constants) k = latitude_constants(constants);
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_REAL dx = lanes_load(x + i);
        CM_REAL dy = lanes_load(y + i);
        CM_REAL dz = lanes_load(z + i);
        CM_BOOL good = CM_NAME(lanes_is_direction)(dx, dy, dz);
        CM_NAME(cm_xyz) r = terms > 0 ? CM_NAME(cm_latitude_series_direction)(dx, dy, dz, terms, k)
                                      : CM_NAME(cm_latitude_tangent_direction)(dx, dy, dz, k);
        lanes_store(to_x + i, lanes_or_nan(good, r.x));
        lanes_store(to_y + i, lanes_or_nan(good, r.y));
        lanes_store(to_z + i, lanes_or_nan(good, r.z));
    }
}

#define LATITUDE_ANGLES(name, terms)                                                               \
    static void latitude_angles_##name(const cm_latitude_constants_f64 *k, size_t n,               \
                                       const double *from, double *to)                             \
    {                                                                                              \
        latitude_angles(terms, k, n, from, to);                                                    \
    }
#define LATITUDE_DIRECTIONS(name, terms)                                                           \
    static void latitude_directions_##name(const cm_latitude_constants_f64 *k, size_t n,           \
                                           const double *x, const double *y, const double *z,      \
                                           double *to_x, double *to_y, double *to_z)               \
    {                                                                                              \
        latitude_directions(terms, k, n, x, y, z, to_x, to_y, to_z);                               \
    }

LATITUDE_ANGLES(series_3, 3)
LATITUDE_ANGLES(series_6, 6)
LATITUDE_ANGLES(series_12, 12)
LATITUDE_ANGLES(near, 0)
LATITUDE_ANGLES(far, -1)
LATITUDE_DIRECTIONS(series_3, 3)
LATITUDE_DIRECTIONS(series_6, 6)
LATITUDE_DIRECTIONS(series_12, 12)
LATITUDE_DIRECTIONS(tangent, 0)

static const cm_latitude_loops latitude_loops = {
    .angles = {[CM_LATITUDE_SERIES_3] = latitude_angles_series_3,
               [CM_LATITUDE_SERIES_6] = latitude_angles_series_6,
               [CM_LATITUDE_SERIES_12] = latitude_angles_series_12,
               [CM_LATITUDE_TANGENT_NEAR] = latitude_angles_near,
               [CM_LATITUDE_TANGENT_FAR] = latitude_angles_far},
    .directions = {[CM_LATITUDE_SERIES_3] = latitude_directions_series_3,
                   [CM_LATITUDE_SERIES_6] = latitude_directions_series_6,
                   [CM_LATITUDE_SERIES_12] = latitude_directions_series_12,
                   [CM_LATITUDE_TANGENT_NEAR] = latitude_directions_tangent,
                   [CM_LATITUDE_TANGENT_FAR] = latitude_directions_tangent}};

#undef LATITUDE_ANGLES
#undef LATITUDE_DIRECTIONS
#undef LATITUDE_FN
