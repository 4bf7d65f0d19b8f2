/* SPDX-License-Identifier: MIT
 *
 * HEALPix: resolutions, and points to pixels and back: any number of them is given to the loops of the
 * instruction set, what is left over of whole vectors in a vector of its own. A point alone takes a way without loops.
 */
#include "healpix_object.h"
#include "libcubemap/mapping/exception_flags.h"
#include "libcubemap/mapping/message.h"
#include "libcubemap/mapping/set_choice.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- Resolutions ---- */

static int is_power_of_two(int64_t n)
{
    return (n & (n - 1)) == 0;
}

cm_status cm_healpix_check(int64_t nside, cm_healpix_order order, char *message,
                           size_t message_size)
{
    if (order != CM_HEALPIX_RING && order != CM_HEALPIX_NESTED)
    {
        return cm_fail(CM_ERROR_ARGUMENT, message, message_size,
                       "the order of HEALPix is RING (0) or NESTED (1), not %d", (int)order);
    }
    if (nside < 1 || nside > CM_HEALPIX_NSIDE_MAX)
    {
        return cm_fail(CM_ERROR_PIXEL, message, message_size,
                       "nside is %" PRId64 ", but HEALPix has 1 to %d", nside,
                       CM_HEALPIX_NSIDE_MAX);
    }
    if (order == CM_HEALPIX_NESTED && !is_power_of_two(nside))
    {
        return cm_fail(CM_ERROR_PIXEL, message, message_size,
                       "nside is %" PRId64 ", but in the order NESTED it is a power of two", nside);
    }
    return CM_OK;
}

cm_status cm_healpix_create(int64_t nside, cm_healpix_order order, const cm_options *options,
                            cm_healpix **healpix)
{
    if (healpix == NULL ||
        (options != NULL && (options->size != sizeof *options || (int)options->tier < 0 ||
                             options->tier > CM_TIER_FAST)))
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = cm_healpix_check(nside, order, NULL, 0);
    if (status != CM_OK)
    {
        return status;
    }
    const cm_batch_set *set = cm_batch_set_find(options == NULL ? NULL : options->instructions);
    if (set == NULL)
    {
        return CM_ERROR_INSTRUCTIONS;
    }
    cm_healpix *made = malloc(sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    *made = (cm_healpix){.nside = nside,
                         .count = 12 * nside * nside,
                         .order = order,
                         .is_power = is_power_of_two(nside),
                         .set = set};
    while (made->is_power && nside >> made->shift > 1)
    {
        made->shift++;
    }
    *healpix = made;
    return CM_OK;
}

void cm_healpix_destroy(cm_healpix *healpix)
{
    free(healpix);
}

int64_t cm_healpix_nside(const cm_healpix *healpix)
{
    return healpix->nside;
}

cm_healpix_order cm_healpix_order_of(const cm_healpix *healpix)
{
    return healpix->order;
}

const char *cm_healpix_instructions(const cm_healpix *healpix)
{
    return healpix->set->name;
}

int64_t cm_healpix_pixel_count(const cm_healpix *healpix)
{
    return healpix->count;
}

int64_t cm_healpix_ring_count(const cm_healpix *healpix)
{
    return 4 * healpix->nside - 1;
}

/* ---- Arrays ---- */

/* One vector, with the first point again where there is none. */
typedef double numbers[CM_LANES_MAX];
typedef int64_t pixels[CM_LANES_MAX];
#define REST(type) _Alignas(sizeof(type)) type

static void fill_numbers(const cm_healpix *healpix, numbers to, const double *from, size_t n)
{
    healpix->set->rest_f64(to, from, n);
}

static void fill_pixels(const cm_healpix *healpix, pixels to, const int64_t *from, size_t n)
{
    for (size_t i = 0; i < healpix->set->lanes_f64; i++)
    {
        to[i] = from[i < n ? i : 0];
    }
}

void cm_healpix_pixel_from_direction_array(const cm_healpix *healpix, size_t n, const double *x,
                                           const double *y, const double *z, int64_t *pixel)
{
    const cm_exceptions held = cm_exceptions_hold();
    const cm_healpix_loops *loops = healpix->set->healpix;
    size_t lanes = healpix->set->lanes_f64;
    size_t left = n % lanes;
    size_t whole = n - left;
    loops->from_directions(healpix, whole, x, y, z, pixel);
    if (left > 0)
    {
        REST(numbers) a, b, c;
        REST(pixels) p;
        fill_numbers(healpix, a, x + whole, left);
        fill_numbers(healpix, b, y + whole, left);
        fill_numbers(healpix, c, z + whole, left);
        loops->from_directions(healpix, lanes, a, b, c, p);
        memcpy(pixel + whole, p, left * sizeof *pixel);
    }
    cm_exceptions_restore(held);
}

static void pixels_of_angles(const cm_healpix *healpix, int latitudes, size_t n,
                             const double *theta, const double *phi, int64_t *pixel)
{
    const cm_healpix_loops *loops = healpix->set->healpix;
    size_t lanes = healpix->set->lanes_f64;
    size_t left = n % lanes;
    size_t whole = n - left;
    loops->from_angles(healpix, latitudes, whole, theta, phi, pixel);
    if (left > 0)
    {
        REST(numbers) a, b;
        REST(pixels) p;
        fill_numbers(healpix, a, theta + whole, left);
        fill_numbers(healpix, b, phi + whole, left);
        loops->from_angles(healpix, latitudes, lanes, a, b, p);
        memcpy(pixel + whole, p, left * sizeof *pixel);
    }
}

/* The loops bring longitudes up to this to one turn, further ones the C library does. */
static const double far_longitude = 0x1p50;

/* Within one turn, if it is that far. */
static double near_longitude(double phi)
{
    return fabs(phi) > far_longitude && isfinite(phi) ? atan2(sin(phi), cos(phi)) : phi;
}

static void pixels_of_any_angles(const cm_healpix *healpix, int latitudes, size_t n,
                                 const double *theta, const double *phi, int64_t *pixel)
{
    const cm_exceptions held = cm_exceptions_hold();
    pixels_of_angles(healpix, latitudes, n, theta, phi, pixel);
    int far = 0;
    for (size_t i = 0; i < n; i++)
    {
        far |= fabs(phi[i]) > far_longitude;
    }
    for (size_t i = 0; far && i < n; i++)
    {
        if (fabs(phi[i]) > far_longitude)
        {
            pixel[i] = healpix->set->healpix_lone->from_angles(healpix, latitudes, theta[i],
                                                               near_longitude(phi[i]));
        }
    }
    cm_exceptions_restore(held);
}

void cm_healpix_pixel_from_angles_array(const cm_healpix *healpix, size_t n, const double *theta,
                                        const double *phi, int64_t *pixel)
{
    pixels_of_any_angles(healpix, 0, n, theta, phi, pixel);
}

void cm_healpix_pixel_from_lonlat_array(const cm_healpix *healpix, size_t n, const double *lon,
                                        const double *lat, int64_t *pixel)
{
    pixels_of_any_angles(healpix, 1, n, lat, lon, pixel);
}

void cm_healpix_direction_from_pixel_array(const cm_healpix *healpix, size_t n,
                                           const int64_t *pixel, double *x, double *y, double *z)
{
    const cm_exceptions held = cm_exceptions_hold();
    const cm_healpix_loops *loops = healpix->set->healpix;
    size_t lanes = healpix->set->lanes_f64;
    size_t left = n % lanes;
    size_t whole = n - left;
    loops->to_directions(healpix, whole, pixel, x, y, z);
    if (left > 0)
    {
        REST(numbers) a, b, c;
        REST(pixels) p;
        fill_pixels(healpix, p, pixel + whole, left);
        loops->to_directions(healpix, lanes, p, a, b, c);
        memcpy(x + whole, a, left * sizeof *x);
        memcpy(y + whole, b, left * sizeof *y);
        memcpy(z + whole, c, left * sizeof *z);
    }
    cm_exceptions_restore(held);
}

static void angles_of_pixels(const cm_healpix *healpix, int latitudes, size_t n,
                             const int64_t *pixel, double *theta, double *phi)
{
    const cm_exceptions held = cm_exceptions_hold();
    const cm_healpix_loops *loops = healpix->set->healpix;
    size_t lanes = healpix->set->lanes_f64;
    size_t left = n % lanes;
    size_t whole = n - left;
    loops->to_angles(healpix, latitudes, whole, pixel, theta, phi);
    if (left > 0)
    {
        REST(numbers) a, b;
        REST(pixels) p;
        fill_pixels(healpix, p, pixel + whole, left);
        loops->to_angles(healpix, latitudes, lanes, p, a, b);
        memcpy(theta + whole, a, left * sizeof *theta);
        memcpy(phi + whole, b, left * sizeof *phi);
    }
    cm_exceptions_restore(held);
}

void cm_healpix_angles_from_pixel_array(const cm_healpix *healpix, size_t n, const int64_t *pixel,
                                        double *theta, double *phi)
{
    angles_of_pixels(healpix, 0, n, pixel, theta, phi);
}

void cm_healpix_lonlat_from_pixel_array(const cm_healpix *healpix, size_t n, const int64_t *pixel,
                                        double *lon, double *lat)
{
    angles_of_pixels(healpix, 1, n, pixel, lat, lon);
}

static cm_status renumber(const cm_healpix *healpix,
                          void (*loop)(const cm_healpix *, size_t, const int64_t *, int64_t *),
                          size_t n, const int64_t *from, int64_t *to)
{
    if (!healpix->is_power)
    {
        return CM_ERROR_PIXEL;
    }
    const cm_exceptions held = cm_exceptions_hold();
    size_t lanes = healpix->set->lanes_f64;
    size_t left = n % lanes;
    size_t whole = n - left;
    loop(healpix, whole, from, to);
    if (left > 0)
    {
        REST(pixels) p;
        fill_pixels(healpix, p, from + whole, left);
        loop(healpix, lanes, p, p);
        memcpy(to + whole, p, left * sizeof *to);
    }
    cm_exceptions_restore(held);
    return CM_OK;
}

cm_status cm_healpix_nested_from_ring_array(const cm_healpix *healpix, size_t n,
                                            const int64_t *ring, int64_t *nested)
{
    return renumber(healpix, healpix->set->healpix->to_nested, n, ring, nested);
}

cm_status cm_healpix_ring_from_nested_array(const cm_healpix *healpix, size_t n,
                                            const int64_t *nested, int64_t *ring)
{
    return renumber(healpix, healpix->set->healpix->to_ring, n, nested, ring);
}

/* ---- Single points ---- */

/* A pixel that has been made, unless it is none. */
static cm_status give(int64_t made, int64_t *pixel)
{
    if (made == CM_HEALPIX_NO_PIXEL)
    {
        return CM_ERROR_PIXEL;
    }
    *pixel = made;
    return CM_OK;
}

/* Nothing is raised but inexact, so that nothing must wait for the flags. */
cm_status cm_healpix_pixel_from_direction(const cm_healpix *healpix, const double direction[3],
                                          int64_t *pixel)
{
    const cm_healpix_lone *lone = healpix->set->healpix_lone;
    int64_t made = lone->short_from_direction(healpix, direction);
    if (made != CM_HEALPIX_NO_PIXEL)
    {
        *pixel = made;
        return CM_OK;
    }
    const cm_exceptions held = cm_exceptions_hold();
    made = lone->from_direction(healpix, direction);
    cm_exceptions_restore(held);
    return give(made, pixel);
}

static cm_status pixel_from_angles(const cm_healpix *healpix, int latitudes, double theta,
                                   double phi, int64_t *pixel)
{
    const cm_healpix_lone *lone = healpix->set->healpix_lone;
    int64_t made = lone->short_from_angles(healpix, latitudes, theta, phi);
    if (made != CM_HEALPIX_NO_PIXEL)
    {
        *pixel = made;
        return CM_OK;
    }
    const cm_exceptions held = cm_exceptions_hold();
    made = lone->from_angles(healpix, latitudes, theta, near_longitude(phi));
    cm_exceptions_restore(held);
    return give(made, pixel);
}

cm_status cm_healpix_pixel_from_angles(const cm_healpix *healpix, double theta, double phi,
                                       int64_t *pixel)
{
    return pixel_from_angles(healpix, 0, theta, phi, pixel);
}

cm_status cm_healpix_pixel_from_lonlat(const cm_healpix *healpix, double lon, double lat,
                                       int64_t *pixel)
{
    return pixel_from_angles(healpix, 1, lat, lon, pixel);
}

cm_status cm_healpix_direction_from_pixel(const cm_healpix *healpix, int64_t pixel,
                                          double direction[3])
{
    if (!cm_healpix_has(healpix, pixel))
    {
        return CM_ERROR_PIXEL;
    }
    healpix->set->healpix_lone->to_direction(healpix, pixel, direction);
    return CM_OK;
}

cm_status cm_healpix_angles_from_pixel(const cm_healpix *healpix, int64_t pixel, double *theta,
                                       double *phi)
{
    if (!cm_healpix_has(healpix, pixel))
    {
        return CM_ERROR_PIXEL;
    }
    healpix->set->healpix_lone->to_angles(healpix, 0, pixel, theta, phi);
    return CM_OK;
}

cm_status cm_healpix_lonlat_from_pixel(const cm_healpix *healpix, int64_t pixel, double lonlat[2])
{
    if (!cm_healpix_has(healpix, pixel))
    {
        return CM_ERROR_PIXEL;
    }
    healpix->set->healpix_lone->to_angles(healpix, 1, pixel, &lonlat[1], &lonlat[0]);
    return CM_OK;
}

cm_status cm_healpix_nested_from_ring(const cm_healpix *healpix, int64_t ring, int64_t *nested)
{
    if (!cm_healpix_has(healpix, ring) || !healpix->is_power)
    {
        return CM_ERROR_PIXEL;
    }
    *nested = healpix->set->healpix_lone->to_nested(healpix, ring);
    return CM_OK;
}

cm_status cm_healpix_ring_from_nested(const cm_healpix *healpix, int64_t nested, int64_t *ring)
{
    if (!cm_healpix_has(healpix, nested) || !healpix->is_power)
    {
        return CM_ERROR_PIXEL;
    }
    *ring = healpix->set->healpix_lone->to_ring(healpix, nested);
    return CM_OK;
}
