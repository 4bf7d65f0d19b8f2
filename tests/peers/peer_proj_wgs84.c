/* SPDX-License-Identifier: MIT
 *
 * PROJ (OSGeo) on WGS84 beside grids: its qsc, which takes the geocentric latitude, and its rhealpix, which
 * takes the authalic one, by a series of three terms. Places of the plane in metres, at random points more than
 * a degree from the poles, where PROJ loses digits (docs/measured/peers.md).
 */
#include <cubemap/cubemap.h>

#include "truth/sphere.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <proj.h>

#define DEGREE 0.017453292519943295769

enum
{
    POINTS = 100000
};

/* PROJ's metres from a place on the face, or on the square. */
typedef struct subject
{
    const char *proj;
    const char *mapping;
    cm_latitude latitude;
    double bound; /* metres */
    void (*place)(const cm_grid *grid, uint8_t face, const double uv[2], double xy[2]);
} subject;

static void qsc_place(const cm_grid *grid, uint8_t face, const double uv[2], double xy[2])
{
    double a = cm_grid_ellipsoid(grid)->a;
    (void)face;
    xy[0] = a * uv[0];
    xy[1] = a * uv[1];
}

/* The square of this library has half of the authalic sphere's circumference for 1. */
static void rhealpix_place(const cm_grid *grid, uint8_t face, const double uv[2], double xy[2])
{
    double radius = cm_ellipsoid_authalic_radius(cm_grid_ellipsoid(grid));
    (void)face;
    xy[0] = radius * 3.14159265358979323846 * uv[0];
    xy[1] = radius * 3.14159265358979323846 * uv[1];
}

static const subject subjects[] = {
    {"+proj=qsc +lat_0=0 +lon_0=0 +ellps=WGS84", "qsc", CM_LATITUDE_GEOCENTRIC, 1e-7, qsc_place},
    {"+proj=rhealpix +north_square=0 +south_square=0 +ellps=WGS84", "rhealpix",
     CM_LATITUDE_AUTHALIC, 1e-6, rhealpix_place},
};

/* The worst distance in metres; negative if PROJ has no such projection. */
static double worst_of(const subject *s)
{
    cm_grid_options options = {
        .size = sizeof options, .mapping = s->mapping, .latitude = &s->latitude};
    cm_grid *grid = NULL;
    PJ *projection = proj_create(PJ_DEFAULT_CTX, s->proj);
    if (projection == NULL || cm_grid_create(&options, &grid) != CM_OK)
    {
        return -1.0;
    }
    double worst = 0.0;
    uint64_t state = 4;
    for (int i = 0; i < POINTS; i++)
    {
        double uv[2], xy[2];
        double lon = 3.14159 * next_real(&state);
        double lat = 89.0 * DEGREE * next_real(&state);
        uint8_t face = cm_grid_forward_lonlat(grid, lon, lat, uv);
        if (face != 0)
        {
            continue;
        }
        PJ_COORD theirs = proj_trans(projection, PJ_FWD, proj_coord(lon, lat, 0.0, 0.0));
        s->place(grid, face, uv, xy);
        worst = fmax(worst, hypot(theirs.v[0] - xy[0], theirs.v[1] - xy[1]));
    }
    cm_grid_destroy(grid);
    proj_destroy(projection);
    return worst;
}

int main(void)
{
    int failures = 0;
    printf("PROJ %s\n", proj_info().version);
    for (size_t i = 0; i < sizeof subjects / sizeof *subjects; i++)
    {
        double worst = worst_of(&subjects[i]);
        int good = worst >= 0.0 && worst <= subjects[i].bound;
        printf("%s%s: %.3g m apart from %s on WGS84, %s latitude\n",
               good ? "" : "not ok: ", subjects[i].proj, worst, subjects[i].mapping,
               cm_latitude_name(subjects[i].latitude));
        failures += !good;
    }
    return failures;
}
