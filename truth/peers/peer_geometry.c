/* SPDX-License-Identifier: MIT
 *
 * Where a peer is right, exact directions of the points that it is given, and planes that several
 * peers share.
 */
#include "peers.h"

#include <math.h>
#include <string.h>

#define PI_L 3.14159265358979323846264338327950288L

/* -------------------------------------------------------------------------------------- regions */

static const double sine_of_margin = 0.17364817766693034885; /* sin 10 degrees */

static double length_of(const double direction[3])
{
    return sqrt(direction[0] * direction[0] + direction[1] * direction[1] +
                direction[2] * direction[2]);
}

static int is_away_from_axis(const double direction[3], int axis)
{
    double across = hypot(direction[(axis + 1) % 3], direction[(axis + 2) % 3]);
    return across >= sine_of_margin * length_of(direction);
}

int peer_is_within(peer_region region, const double direction[3])
{
    switch (region)
    {
    case PEER_EVERYWHERE:
        return 1;
    case PEER_AWAY_FROM_POLES:
        return is_away_from_axis(direction, 2);
    case PEER_AWAY_FROM_CENTRES:
        return is_away_from_axis(direction, 0) && is_away_from_axis(direction, 1) &&
               is_away_from_axis(direction, 2);
    case PEER_INSIDE_SECTORS:
        return is_away_from_axis(direction, 2) &&
               fabs(fabs(direction[0]) - fabs(direction[1])) >= 1e-6 * length_of(direction);
    case PEER_IN_BELT:
        return 3.0 * fabs(direction[2]) < 2.0 * length_of(direction);
    default:
        return 0;
    }
}

const char *peer_region_words(peer_region region)
{
    static const char *const words[] = {"everywhere",
                                        "",
                                        "10 degrees from the poles",
                                        "10 degrees from the faces' centres",
                                        "10 degrees from the poles, 1e-6 from the cut meridians",
                                        "on the belt"};
    return words[region];
}

/* ----------------------------------------------------------------------------- exact directions */

/* sine and cosine of an angle in degrees, reduced exactly: exact in multiples of 90 degrees, and as
 * precise beside them */
static void sine_cosine_degrees(long double degrees, long double *sine, long double *cosine)
{
    int quarters;
    long double rest = remquol(degrees, 90.0L, &quarters) * (PI_L / 180.0L);
    long double s = sinl(rest);
    long double c = cosl(rest);
    int swap = quarters & 1;
    *sine = swap ? c : s;
    *cosine = swap ? s : c;
    if (quarters & 2)
    {
        *sine = -*sine;
    }
    if ((quarters + 1) & 2)
    {
        *cosine = -*cosine;
    }
}

void peer_direction(const peer_subject *subject, const double sphere[3], double direction[3])
{
    long double lon[2]; /* sine, cosine */
    long double lat[2];
    if (subject->unit == 0.0)
    {
        memcpy(direction, sphere, 3 * sizeof direction[0]);
        return;
    }
    if (subject->unit == 1.0)
    {
        lon[0] = sinl(sphere[0]);
        lon[1] = cosl(sphere[0]);
        lat[0] = sinl(sphere[1]);
        lat[1] = cosl(sphere[1]);
    }
    else
    {
        sine_cosine_degrees(sphere[0], &lon[0], &lon[1]);
        sine_cosine_degrees(sphere[1], &lat[0], &lat[1]);
    }
    if (subject->turned)
    {
        long double half = sqrtl(0.5L);
        long double sine = half * (lon[0] - lon[1]);
        lon[1] = half * (lon[0] + lon[1]);
        lon[0] = sine;
    }
    direction[0] = (double)(lat[1] * lon[1]);
    direction[1] = (double)(lat[1] * lon[0]);
    direction[2] = (double)lat[0];
}

/* --------------------------------------------------------------------------------- other planes */

const double peer_geo_centre[6][2] = {{0.0, 0.0},   {90.0, 0.0}, {180.0, 0.0},
                                      {-90.0, 0.0}, {0.0, 90.0}, {0.0, -90.0}};

/* The sector of a cap by the larger coordinate, and along and sigma in it, as the mapping's kernel
 * has them. */
void peer_healpix_plane(const peer_face_place *from, long double *x, long double *y)
{
    if (from->face < 4)
    {
        *x = 1.0L + from->u + 2.0L * (long double)from->face;
        *y = from->v;
    }
    else
    {
        long double w = from->face == 5 ? -from->v : from->v;
        int along_x = fabsl(w) >= fabsl(from->u);
        long double sigma = along_x ? fabsl(w) : fabsl(from->u);
        long double sign = copysignl(1.0L, along_x ? -w : from->u);
        long double along = sign * (along_x ? from->u : w);
        long double sector = along_x ? 1.0L - sign : 2.0L - sign;
        *x = 1.0L + 2.0L * sector + along;
        *y = from->face == 5 ? sigma - 2.0L : 2.0L - sigma;
    }
    if (*x > 4.0L)
    {
        *x -= 8.0L;
    }
}

void peer_healpix_face(long double x, long double y, peer_face_place *to)
{
    if (x < 0.0L)
    {
        x += 8.0L;
    }
    to->face = CM_NO_FACE;
    if (!(x >= 0.0L && x <= 8.0L && fabsl(y) <= 2.0L + 1e-9L))
    {
        return;
    }
    int sector = (int)(x / 2.0L) & 3;
    long double along = (x >= 8.0L ? x - 8.0L : x) - (2.0L * (long double)sector + 1.0L);
    if (fabsl(y) <= 1.0L)
    {
        to->face = sector;
        to->u = along;
        to->v = y;
        return;
    }
    /* sector k is sector 0 turned by k right angles; sector 0 of the north has v = -sigma */
    long double sigma = fmaxl(2.0L - fabsl(y), 0.0L);
    static const int quarter_cosine[] = {1, 0, -1, 0};
    static const int quarter_sine[] = {0, 1, 0, -1};
    long double c = (long double)quarter_cosine[sector];
    long double s = (long double)quarter_sine[sector];
    to->face = y > 0.0L ? 4 : 5;
    to->u = c * along + s * sigma;
    to->v = s * along - c * sigma;
    if (y < 0.0L)
    {
        to->v = -to->v;
    }
}
