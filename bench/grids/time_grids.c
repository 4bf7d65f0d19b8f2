/* SPDX-License-Identifier: MIT
 *
 * Mappings on WGS84: how far areas on a face are from areas on the ellipsoid by the latitude that is taken, and
 * what a point costs, beside PROJ where that is installed.
 *
 *   grids areas    the table of areas
 *   grids speed    the table of times
 */
#include "bench/harness/harness.h"

#include <cubemap/cubemap.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef HAVE_PROJ
#include <proj.h>
#endif

#include "truth/sphere.h"

enum
{
    POINTS = 10000,
    SIDE = 200, /* points a side of a face */
    REPETITIONS = 41
};

static cm_grid *make_grid(const char *mapping, const char *ellipsoid, const cm_latitude *latitude,
                          const cm_rotation *rotation)
{
    cm_grid_options options = {.size = sizeof options,
                               .mapping = mapping,
                               .ellipsoid = cm_ellipsoid_find(ellipsoid),
                               .latitude = latitude,
                               .rotation = rotation};
    cm_grid *grid = NULL;
    cm_status status = cm_grid_create(&options, &grid);
    if (status != CM_OK)
    {
        fprintf(stderr, "grids: %s on %s: %s\n", mapping, ellipsoid, cm_status_text(status));
        exit(EXIT_FAILURE);
    }
    return grid;
}

/* ---- Areas ---- */

static void area_row(const char *mapping, const char *ellipsoid, cm_latitude latitude)
{
    cm_grid *grid = make_grid(mapping, ellipsoid, &latitude, NULL);
    double mean = cm_ellipsoid_area(cm_grid_ellipsoid(grid)) / 24.0;
    double least = (double)INFINITY;
    double most = 0.0;
    for (int face = 0; face < 6; face++)
    {
        for (int i = 0; i < SIDE * SIDE; i++)
        {
            const double uv[2] = {(2 * (i % SIDE) + 1.0) / SIDE - 1.0,
                                  (2 * (i / SIDE) + 1.0) / SIDE - 1.0};
            double area = cm_grid_area_element(grid, (uint8_t)face, uv) / mean;
            least = fmin(least, area);
            most = fmax(most, area);
        }
    }
    /* what is rounding is shown as such */
    if (most - least < 1e-13)
    {
        printf("| %s | %s | %s | < 1e-13 | < 1e-13 |\n", mapping, ellipsoid,
               cm_latitude_name(latitude));
    }
    else
    {
        printf("| %s | %s | %s | %+.2g %% | %+.2g %% |\n", mapping, ellipsoid,
               cm_latitude_name(latitude), 100.0 * (least - 1.0), 100.0 * (most - 1.0));
    }
    cm_grid_destroy(grid);
}

static void print_areas(void)
{
    static const char *const mappings[] = {"qsc", "seamless", "healpix"};
    static const char *const on[] = {"WGS84", "Mars", "Saturn"};
    printf("| mapping | ellipsoid | latitude | least area | most |\n|---|---|---|---:|---:|\n");
    for (int e = 0; e < 3; e++)
    {
        for (int m = 0; m < (e == 0 ? 3 : 1); m++)
        {
            area_row(mappings[m], on[e], CM_LATITUDE_AUTHALIC);
            area_row(mappings[m], on[e], CM_LATITUDE_AUTHALIC_APPROXIMATION);
            area_row(mappings[m], on[e], CM_LATITUDE_GEOCENTRIC);
            area_row(mappings[m], on[e], CM_LATITUDE_GEOGRAPHIC);
        }
    }
}

/* ---- Times ---- */

typedef struct points
{
    double lon[POINTS];
    double lat[POINTS];
    double x[POINTS];
    double y[POINTS];
    double z[POINTS];
    double u[POINTS];
    double v[POINTS];
    double to[3][POINTS];
    uint8_t face[POINTS];
} points;

typedef struct contestant
{
    const char *name;
    void (*run)(const struct contestant *c, points *p);
    const void *handle;
    double samples[REPETITIONS];
} contestant;

static void mapping_forward(const contestant *c, points *p)
{
    cm_forward_array(cm_grid_mapping(c->handle), POINTS, p->x, p->y, p->z, p->face, p->u, p->v);
}

static void forward(const contestant *c, points *p)
{
    cm_grid_forward_array(c->handle, POINTS, p->x, p->y, p->z, p->face, p->u, p->v);
}

static void forward_lonlat(const contestant *c, points *p)
{
    cm_grid_forward_lonlat_array(c->handle, POINTS, p->lon, p->lat, p->face, p->u, p->v);
}

static void mapping_inverse(const contestant *c, points *p)
{
    cm_inverse_array(cm_grid_mapping(c->handle), POINTS, p->face, p->u, p->v, p->to[0], p->to[1],
                     p->to[2]);
}

static void inverse(const contestant *c, points *p)
{
    cm_grid_inverse_array(c->handle, POINTS, p->face, p->u, p->v, p->to[0], p->to[1], p->to[2]);
}

static void inverse_lonlat(const contestant *c, points *p)
{
    cm_grid_inverse_lonlat_array(c->handle, POINTS, p->face, p->u, p->v, p->to[0], p->to[1]);
}

#ifdef HAVE_PROJ
/* Over the results of the run before: forward from copies of lon and lat, inverse from what it left. */
static void proj_forward(const contestant *c, points *p)
{
    memcpy(p->to[0], p->lon, sizeof p->lon);
    memcpy(p->to[1], p->lat, sizeof p->lat);
    proj_trans_generic((PJ *)c->handle, PJ_FWD, p->to[0], sizeof(double), POINTS, p->to[1],
                       sizeof(double), POINTS, NULL, 0, 0, NULL, 0, 0);
}

static PJ *open_proj(const char *text)
{
    PJ *projection = proj_create(PJ_DEFAULT_CTX, text);
    if (projection == NULL)
    {
        fprintf(stderr, "grids: PROJ does not know %s\n", text);
        exit(EXIT_FAILURE);
    }
    return projection;
}
#endif

static double median_of(const contestant *c)
{
    return summary(c->samples, REPETITIONS).median;
}

static void print_speed(void)
{
    static points p;
    uint64_t state = 1;
    for (int i = 0; i < POINTS; i++)
    {
        /* on the front face, which is one projection for PROJ */
        double lonlat[2];
        double d[3] = {1.0, next_real(&state), next_real(&state)};
        cm_lonlat_from_direction(d, lonlat);
        p.lon[i] = lonlat[0];
        p.lat[i] = 0.98 * lonlat[1];
        cm_direction_from_lonlat(p.lon[i], p.lat[i], d);
        p.x[i] = d[0];
        p.y[i] = d[1];
        p.z[i] = d[2];
    }
    cm_rotation rotation;
    cm_rotation_from_angles(0.01, 0.01, 0.01, &rotation);
    cm_grid *plain = make_grid("qsc", "WGS84", NULL, NULL);
    cm_grid *turned = make_grid("qsc", "WGS84", NULL, &rotation);
    cm_grid *healpix = make_grid("healpix", "WGS84", NULL, NULL);
    contestant all[16] = {
        {"qsc alone, from directions", mapping_forward, plain, {0}},
        {"qsc on WGS84 (authalic), from normals", forward, plain, {0}},
        {"the same, rotated", forward, turned, {0}},
        {"qsc on WGS84 (authalic), from lon, lat", forward_lonlat, plain, {0}},
        {"healpix on WGS84 (authalic), from lon, lat", forward_lonlat, healpix, {0}},
        {"qsc alone, to directions", mapping_inverse, plain, {0}},
        {"qsc on WGS84 (authalic), to normals", inverse, plain, {0}},
        {"the same, rotated", inverse, turned, {0}},
        {"qsc on WGS84 (authalic), to lon, lat", inverse_lonlat, plain, {0}},
    };
    size_t count = 9;
#ifdef HAVE_PROJ
    PJ *qsc = open_proj("+proj=qsc +lat_0=0 +lon_0=0 +ellps=WGS84");
    PJ *s2 = open_proj("+proj=s2 +lat_0=0 +lon_0=0 +ellps=WGS84");
    PJ *their_healpix = open_proj("+proj=healpix +ellps=WGS84");
    all[count++] =
        (contestant){"PROJ: qsc on WGS84 (geocentric), from lon, lat", proj_forward, qsc, {0}};
    all[count++] =
        (contestant){"PROJ: s2 on WGS84 (geocentric), from lon, lat", proj_forward, s2, {0}};
    all[count++] = (contestant){
        "PROJ: healpix on WGS84 (authalic), from lon, lat", proj_forward, their_healpix, {0}};
#endif
    for (int r = -1; r < REPETITIONS; r++)
    {
        for (size_t i = 0; i < count; i++)
        {
            double start = seconds();
            all[i].run(&all[i], &p);
            all[i].samples[r < 0 ? 0 : r] = (seconds() - start) * 1e9 / POINTS;
        }
    }
    printf("| path | ns a point | over qsc from lon, lat |\n|---|---:|---:|\n");
    for (size_t i = 0; i < count; i++)
    {
        printf("| %s | %.1f | %.2f |\n", all[i].name, median_of(&all[i]),
               median_of(&all[i]) / median_of(&all[3]));
    }
#ifdef HAVE_PROJ
    proj_destroy(qsc);
    proj_destroy(s2);
    proj_destroy(their_healpix);
#endif
    cm_grid_destroy(plain);
    cm_grid_destroy(turned);
    cm_grid_destroy(healpix);
}

int main(int argc, char **argv)
{
    name_program("grids");
    const char *what = argc == 2 ? argv[1] : "";
    if (strcmp(what, "areas") == 0)
    {
        print_areas();
    }
    else if (strcmp(what, "speed") == 0)
    {
        print_speed();
    }
    else
    {
        fputs("usage: grids areas | speed\n", stderr);
        return 2;
    }
    return 0;
}
