/* SPDX-License-Identifier: MIT
 *
 * The twelve base pixels of HEALPix as squares of nside by nside pixels, side by side: 0 to 3 in the north, 4 to 7 on
 * the equator, 8 to 11 in the south (Gorski et al. 2005, figure 4). A square's upper right corner is the north, its upper left one
 * the west, so that x of a pixel is its column and y its row from below.
 *
 * The projection is the mapping "healpix", which is the same 45 degrees further: four squares of longitude, of which the
 * base pixels' are the diagonals, and two caps (Calabretta & Roukema 2007).
 */
#include "surface_kinds.h"

#include <cubemap/direction.h>
#include <cubemap/number.h>
#include <cubemap/options.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define HALF_ROOT2 0.70710678118654752440
#define QUARTER 0.78539816339744830962 /* pi / 4 */

/* How far beyond its sector a cap's formula is used and not the next ones': in half sectors from its middle. */
#define TURN_MOST 2.0

#define BLOCK 256

/* A place in HEALPix's plane: across is from the middle of the sector of longitude, from -1 to 1, up from the equator,
 * where a pole is 2. */
typedef struct plane_place
{
    unsigned sector; /* 0 to 3, from longitude 0 */
    double across;
    double up;
} plane_place;

/* ---- the mapping's faces ---- */

static plane_place place_of_face(uint8_t face, double u, double v)
{
    if (face < 4)
    {
        return (plane_place){face, u, v};
    }
    const double w = face == 4 ? v : -v;
    const double sign = face == 4 ? 1.0 : -1.0;
    const double sigma = fmax(fabs(u), fabs(w));
    plane_place at = {0, u, sign * (2.0 - sigma)};
    if (fabs(w) >= fabs(u))
    {
        at.sector = w > 0.0 ? 2 : 0;
        at.across = w > 0.0 ? -u : u;
    }
    else
    {
        at.sector = u > 0.0 ? 1 : 3;
        at.across = u > 0.0 ? w : -w;
    }
    return at;
}

static uint8_t face_of_place(plane_place at, double *u, double *v)
{
    if (fabs(at.up) <= 1.0)
    {
        *u = at.across;
        *v = at.up;
        return (uint8_t)at.sector;
    }
    const double sigma = 2.0 - fabs(at.up);
    const double sign = at.up > 0.0 ? 1.0 : -1.0;
    const double turned[4][2] = {
        {at.across, -sigma}, {sigma, at.across}, {-at.across, sigma}, {-sigma, -at.across}};
    *u = turned[at.sector][0];
    *v = sign * turned[at.sector][1];
    return at.up > 0.0 ? 4 : 5;
}

/* ---- base pixels ---- */

/* The base pixel of a place, and where in it: right and up are from its middle, -1 to 1 together. */
static uint8_t base_of_place(plane_place at, double *right, double *up)
{
    const int north = fabs(at.across) <= at.up;
    const int south = fabs(at.across) <= -at.up;
    if (north || south)
    {
        *right = at.across;
        *up = north ? at.up - 1.0 : at.up + 1.0;
        return (uint8_t)(north ? at.sector : 8 + at.sector);
    }
    *right = at.across < 0.0 ? at.across + 1.0 : at.across - 1.0;
    *up = at.up;
    return (uint8_t)(4 + (at.across < 0.0 ? at.sector : (at.sector + 1) % 4));
}

static plane_place place_of_base(unsigned base, double right, double up)
{
    if (base < 4 || base > 7)
    {
        return (plane_place){base % 4, right, base < 4 ? up + 1.0 : up - 1.0};
    }
    return right >= 0.0 ? (plane_place){base - 4, right - 1.0, up}
                        : (plane_place){(base - 1) % 4, right + 1.0, up};
}

/* ---- methods ---- */

/* Rounding may leave a square; NaN stays. */
static double within(double place)
{
    return place > 1.0 ? 1.0 : place < -1.0 ? -1.0 : place;
}

/* Beyond a square's edges the formulas of the belt and of the sector of the cap go on, so that there is no crease on the
 * way; the squares of the equator are of the belt alone. */
static void go_on(unsigned base, double right, double up, double direction[3])
{
    const int is_polar = base < 4 || base > 7;
    const double sign = base < 4 ? 1.0 : -1.0;
    const double height = is_polar ? sign * up + 1.0 : up;
    const double middle = is_polar ? 2.0 * (base % 4) + 1.0 : 2.0 * (base - 4.0);
    const double sigma = 2.0 - height;
    if (!is_polar || height <= 1.0)
    {
        const double z = fmax(-1.0, fmin(1.0, height * (2.0 / 3.0)));
        cm_direction_from_lonlat((middle + right) * QUARTER, is_polar ? sign * asin(z) : asin(z),
                                 direction);
        return;
    }
    if (fabs(right) <= TURN_MOST * sigma)
    {
        const double colatitude = 2.0 * asin(sigma / sqrt(6.0));
        cm_direction_from_lonlat((middle + right / sigma) * QUARTER,
                                 sign * (2.0 * QUARTER - colatitude), direction);
        return;
    }
    /* beside a pole, the next sectors */
    const double turn = atan2(right, sigma) / (2.0 * QUARTER);
    const double sector = floor(turn + 0.5);
    const double angle = (turn - sector) * (2.0 * QUARTER);
    const double own = hypot(right, sigma) * cos(angle);
    const double colatitude = 2.0 * asin(fmin(own / sqrt(6.0), 1.0));
    cm_direction_from_lonlat((middle + 2.0 * sector + tan(angle)) * QUARTER,
                             sign * (2.0 * QUARTER - colatitude), direction);
}

static void directions(const cm_surface *surface, unsigned plane, size_t n, const double *column,
                       const double *row, double *x, double *y, double *z)
{
    const double size = surface->width;
    for (size_t done = 0; done < n; done += BLOCK)
    {
        uint8_t face[BLOCK];
        double u[BLOCK];
        double v[BLOCK];
        /* directions may be where positions were */
        double easts[BLOCK];
        double souths[BLOCK];
        const size_t count = n - done < BLOCK ? n - done : BLOCK;
        for (size_t i = 0; i < count; i++)
        {
            const double east = column[done + i] / size;
            const double south = row[done + i] / size;
            easts[i] = east;
            souths[i] = south;
            face[i] = face_of_place(place_of_base(plane, east + (south - 1.0), east - south), &u[i],
                                    &v[i]);
        }
        cm_inverse_array(surface->mapping, count, face, u, v, x + done, y + done, z + done);
        for (size_t i = done; i < done + count; i++)
        {
            const double ahead = x[i];
            const double east = easts[i - done];
            const double south = souths[i - done];
            x[i] = HALF_ROOT2 * (ahead - y[i]);
            y[i] = HALF_ROOT2 * (ahead + y[i]);
            if (east < 0.0 || east > 1.0 || south < 0.0 || south > 1.0)
            {
                double direction[3];
                go_on(plane, east + (south - 1.0), east - south, direction);
                x[i] = direction[0];
                y[i] = direction[1];
                z[i] = direction[2];
            }
        }
    }
}

static void positions(const cm_surface *surface, size_t n, const double *x, const double *y,
                      const double *z, uint8_t *plane, double *column, double *row)
{
    const double half = 0.5 * surface->width;
    for (size_t done = 0; done < n; done += BLOCK)
    {
        double ahead[BLOCK];
        double beside[BLOCK];
        double u[BLOCK];
        double v[BLOCK];
        const size_t count = n - done < BLOCK ? n - done : BLOCK;
        for (size_t i = 0; i < count; i++)
        {
            /* halves first, which do not overflow */
            ahead[i] = HALF_ROOT2 * x[done + i] + HALF_ROOT2 * y[done + i];
            beside[i] = HALF_ROOT2 * y[done + i] - HALF_ROOT2 * x[done + i];
        }
        cm_forward_array(surface->mapping, count, ahead, beside, z + done, plane + done, u, v);
        for (size_t i = 0; i < count; i++)
        {
            double right = (double)NAN;
            double up = (double)NAN;
            if (plane[done + i] != CM_NO_FACE)
            {
                plane[done + i] =
                    base_of_place(place_of_face(plane[done + i], u[i], v[i]), &right, &up);
            }
            column[done + i] = half + half * within(right + up);
            row[done + i] = half + half * within(right - up);
        }
    }
}

static const cm_surface_methods methods = {
    .directions = directions, .positions = positions, .can_go_beyond = 1};

cm_status cm_surface_make_healpix(cm_surface *surface, const cm_surface_wish *wish)
{
    const cm_word nside = wish->words->parameters;
    const cm_options options = {.size = sizeof options,
                                .instructions = wish->options->instructions};
    double number = 0.0;
    if (nside.text != NULL && (!cm_number_parse(nside.text, nside.length, &number) ||
                               number < 1.0 || number != floor(number)))
    {
        return cm_complain(wish->complaint, CM_ERROR_SYNTAX,
                           "healpix:%.*s: NSIDE is a whole number, as in healpix:64",
                           CM_SHOWN(nside));
    }
    cm_status status = cm_mapping_create_with("healpix", NULL, &options, &surface->mapping);
    if (status != CM_OK)
    {
        return status;
    }
    surface->methods = &methods;
    surface->planes = 12;
    surface->creased = 1;
    status = cm_surface_grid_size(surface, wish, &(cm_plane_grid){12, 1, 0, 0, number});
    for (uint32_t plane = 0; plane < 12; plane++)
    {
        surface->placement[plane].column = plane * surface->width;
    }
    return status != CM_OK       ? status
           : surface->width == 0 ? cm_surface_say(surface, "healpix")
                                 : cm_surface_say(surface, "healpix:%u", (unsigned)surface->width);
}
