/* SPDX-License-Identifier: MIT
 *
 * The loops over HEALPix's pixels for one instruction set, over whole vectors. Read by batch_precision.h in
 * double. Bad points and pixels are computed like all others and replaced at the end.
 */
#include "healpix.h"

#include "healpix_lattice.h"

CM_FN lanes_words pixels_load(const int64_t *pixel)
{
    return lanes_words_load((const uint64_t *)pixel);
}

CM_FN void pixels_store(int64_t *to, CM_BOOL good, lanes_words pixel)
{
    lanes_words_store((uint64_t *)to, lanes_words_select(good, pixel, lanes_words_all(UINT64_MAX)));
}

/* In the object's order, which is the same for all points. */
CM_FN lanes_words pixels_number_of_lattice(const cm_healpix *healpix, pixels_grid g,
                                           pixels_lattice at)
{
    if (healpix->order == CM_HEALPIX_NESTED)
    {
        return pixels_nested_of_square(g, pixels_square_of_lattice(g, at));
    }
    return pixels_ring_of_row(g, pixels_row_of_lattice(g, at));
}

CM_FN pixels_centre pixels_centre_of_number(const cm_healpix *healpix, pixels_grid g,
                                            lanes_words pixel)
{
    if (healpix->order == CM_HEALPIX_NESTED)
    {
        return pixels_centre_of_square(g, pixels_square_of_nested(g, pixel));
    }
    return pixels_centre_of_row(g, pixels_row_of_ring(g, pixel));
}

/* A point's way is long, and each step of it waits for the one before; so that a processor finds enough to do, so
 * many vectors take a part of the way before any takes the next. */
enum
{
    BATCH_NAME(pixels_points) = 64, /* of a part, and vectors */
    BATCH_NAME(pixels_stage) = BATCH_NAME(pixels_points) / LANES
};

/* How many of the vectors from i on are in a stage. */
CM_FN size_t pixels_of_stage(size_t n, size_t i)
{
    const size_t left = (n - i) / LANES;
    return left < BATCH_NAME(pixels_stage) ? left : BATCH_NAME(pixels_stage);
}

CM_FN void pixels_from_directions(const cm_healpix *healpix, size_t n, const double *x,
                                  const double *y, const double *z, int64_t *pixel)
{
    pixels_grid g = pixels_grid_of(healpix->nside, healpix->shift, 1);
    for (size_t i = 0; i < n; i += BATCH_NAME(pixels_points))
    {
        const size_t count = pixels_of_stage(n, i);
        CM_BOOL good[BATCH_NAME(pixels_stage)];
        CM_NAME(cm_healpix_place) places[BATCH_NAME(pixels_stage)];
        CM_NAME(cm_healpix_reach) reach[BATCH_NAME(pixels_stage)];
        for (size_t k = 0; k < count; k++)
        {
            CM_REAL dx = lanes_load(x + i + k * LANES);
            CM_REAL dy = lanes_load(y + i + k * LANES);
            CM_REAL dz = lanes_load(z + i + k * LANES);
            good[k] = CM_NAME(lanes_is_direction)(dx, dy, dz);
            places[k] = CM_NAME(cm_healpix_locate)(dx, dy, dz);
        }
        for (size_t k = 0; k < count; k++)
        {
            reach[k] = CM_NAME(cm_healpix_measure)(places[k]);
        }
        for (size_t k = 0; k < count; k++)
        {
            const size_t to = i + k * LANES;
            pixels_lattice at =
                pixels_lattice_of_reach(g, places[k].polar, reach[k], lanes_load(z + to));
            pixels_store(pixel + to, good[k], pixels_number_of_lattice(healpix, g, at));
        }
    }
}

CM_FN void pixels_from_angles(const cm_healpix *healpix, int latitudes, size_t n,
                              const double *theta, const double *phi, int64_t *pixel)
{
    pixels_grid g = pixels_grid_of(healpix->nside, healpix->shift, 1);
    CM_REAL least = lanes_all(latitudes ? -0.5 * PIXELS_PI : 0.0);
    CM_REAL greatest = lanes_all(latitudes ? 0.5 * PIXELS_PI : PIXELS_PI);
    CM_REAL zero = lanes_all(0.0);
    for (size_t i = 0; i < n; i += BATCH_NAME(pixels_points))
    {
        const size_t count = pixels_of_stage(n, i);
        pixels_lattice at[BATCH_NAME(pixels_stage)];
        for (size_t k = 0; k < count; k++)
        {
            at[k] = pixels_lattice_of_angles(g, latitudes, lanes_load(theta + i + k * LANES),
                                             lanes_load(phi + i + k * LANES));
        }
        for (size_t k = 0; k < count; k++)
        {
            CM_REAL t = lanes_load(theta + i + k * LANES);
            CM_REAL p = lanes_load(phi + i + k * LANES);
            CM_BOOL good = cm_both(cm_equal(p * zero, zero),
                                   cm_both(cm_at_least(t, least), cm_at_least(greatest, t)));
            pixels_store(pixel + i + k * LANES, good, pixels_number_of_lattice(healpix, g, at[k]));
        }
    }
}

/* The centres of the pixels of a stage. */
CM_FN void pixels_find_centres(const cm_healpix *healpix, pixels_grid g, size_t count,
                               const int64_t *pixel, pixels_centre *centre)
{
    for (size_t k = 0; k < count; k++)
    {
        centre[k] = pixels_centre_of_number(healpix, g, pixels_load(pixel + k * LANES));
    }
}

CM_FN void pixels_to_directions(const cm_healpix *healpix, size_t n, const int64_t *pixel,
                                double *x, double *y, double *z)
{
    pixels_grid g = pixels_grid_of(healpix->nside, healpix->shift, 1);
    CM_REAL nothing = lanes_all((double)NAN);
    for (size_t i = 0; i < n; i += BATCH_NAME(pixels_points))
    {
        const size_t count = pixels_of_stage(n, i);
        pixels_centre centre[BATCH_NAME(pixels_stage)];
        pixels_find_centres(healpix, g, count, pixel + i, centre);
        for (size_t k = 0; k < count; k++)
        {
            const size_t to = i + k * LANES;
            CM_BOOL none = pixels_is_none(g, pixels_load(pixel + to));
            CM_NAME(cm_xyz) d = pixels_direction_of_centre(g, centre[k]);
            lanes_store(x + to, CM_SELECT(none, nothing, d.x));
            lanes_store(y + to, CM_SELECT(none, nothing, d.y));
            lanes_store(z + to, CM_SELECT(none, nothing, d.z));
        }
    }
}

CM_FN void pixels_to_angles(const cm_healpix *healpix, int latitudes, size_t n,
                            const int64_t *pixel, double *theta, double *phi)
{
    pixels_grid g = pixels_grid_of(healpix->nside, healpix->shift, 1);
    CM_REAL nothing = lanes_all((double)NAN);
    for (size_t i = 0; i < n; i += BATCH_NAME(pixels_points))
    {
        const size_t count = pixels_of_stage(n, i);
        pixels_centre centre[BATCH_NAME(pixels_stage)];
        pixels_find_centres(healpix, g, count, pixel + i, centre);
        for (size_t k = 0; k < count; k++)
        {
            const size_t to = i + k * LANES;
            CM_BOOL none = pixels_is_none(g, pixels_load(pixel + to));
            pixels_angles a = pixels_angles_of_centre(g, centre[k]);
            lanes_store(theta + to, CM_SELECT(none, nothing, latitudes ? a.latitude : a.theta));
            lanes_store(phi + to, CM_SELECT(none, nothing, latitudes ? a.lon : a.phi));
        }
    }
}

/* ---- By what is the same for all points: branches on it are decided here ---- */

#define PIXELS_BY_ORDER(call)                                                                      \
    do                                                                                             \
    {                                                                                              \
        cm_healpix known = *healpix;                                                               \
        if (known.order == CM_HEALPIX_NESTED)                                                      \
        {                                                                                          \
            known.order = CM_HEALPIX_NESTED;                                                       \
            call;                                                                                  \
        }                                                                                          \
        else                                                                                       \
        {                                                                                          \
            known.order = CM_HEALPIX_RING;                                                         \
            call;                                                                                  \
        }                                                                                          \
    } while (0)

static void healpix_from_directions(const cm_healpix *healpix, size_t n, const double *x,
                                    const double *y, const double *z, int64_t *pixel)
{
    PIXELS_BY_ORDER(pixels_from_directions(&known, n, x, y, z, pixel));
}

static void healpix_from_angles(const cm_healpix *healpix, int latitudes, size_t n,
                                const double *theta, const double *phi, int64_t *pixel)
{
    if (latitudes)
    {
        PIXELS_BY_ORDER(pixels_from_angles(&known, 1, n, theta, phi, pixel));
    }
    else
    {
        PIXELS_BY_ORDER(pixels_from_angles(&known, 0, n, theta, phi, pixel));
    }
}

static void healpix_to_directions(const cm_healpix *healpix, size_t n, const int64_t *pixel,
                                  double *x, double *y, double *z)
{
    PIXELS_BY_ORDER(pixels_to_directions(&known, n, pixel, x, y, z));
}

static void healpix_to_angles(const cm_healpix *healpix, int latitudes, size_t n,
                              const int64_t *pixel, double *theta, double *phi)
{
    if (latitudes)
    {
        PIXELS_BY_ORDER(pixels_to_angles(&known, 1, n, pixel, theta, phi));
    }
    else
    {
        PIXELS_BY_ORDER(pixels_to_angles(&known, 0, n, pixel, theta, phi));
    }
}

static void healpix_to_nested(const cm_healpix *healpix, size_t n, const int64_t *ring,
                              int64_t *nested)
{
    pixels_grid g = pixels_grid_of(healpix->nside, healpix->shift, 1);
    lanes_words bad = lanes_words_all(UINT64_MAX);
    for (size_t i = 0; i < n; i += BATCH_NAME(pixels_points))
    {
        const size_t count = pixels_of_stage(n, i);
        pixels_row row[BATCH_NAME(pixels_stage)];
        for (size_t k = 0; k < count; k++)
        {
            row[k] = pixels_row_of_ring(g, pixels_load(ring + i + k * LANES));
        }
        for (size_t k = 0; k < count; k++)
        {
            const size_t to = i + k * LANES;
            CM_BOOL none = pixels_is_none(g, pixels_load(ring + to));
            pixels_square square = pixels_square_of_lattice(g, pixels_lattice_of_row(g, row[k]));
            lanes_words made = pixels_nested_of_square(g, square);
            lanes_words_store((uint64_t *)(nested + to), lanes_words_select(none, bad, made));
        }
    }
}

static void healpix_to_ring(const cm_healpix *healpix, size_t n, const int64_t *nested,
                            int64_t *ring)
{
    pixels_grid g = pixels_grid_of(healpix->nside, healpix->shift, 1);
    lanes_words bad = lanes_words_all(UINT64_MAX);
    for (size_t i = 0; i < n; i += LANES)
    {
        lanes_words number = pixels_load(nested + i);
        pixels_square square = pixels_square_of_nested(g, number);
        pixels_row row = pixels_row_of_centre(pixels_centre_of_square(g, square));
        lanes_words made = pixels_ring_of_row(g, row);
        lanes_words_store((uint64_t *)(ring + i),
                          lanes_words_select(pixels_is_none(g, number), bad, made));
    }
}

static const cm_healpix_loops healpix_loops = {.from_directions = healpix_from_directions,
                                               .from_angles = healpix_from_angles,
                                               .to_directions = healpix_to_directions,
                                               .to_angles = healpix_to_angles,
                                               .to_nested = healpix_to_nested,
                                               .to_ring = healpix_to_ring};
