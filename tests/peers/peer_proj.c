/* SPDX-License-Identifier: MIT
 *
 * PROJ (OSGeo): qsc, s2 and healpix, on a sphere. On an ellipsoid PROJ's cubes take the geocentric
 * latitude where others take another; that is not compared.
 */
#include "truth/peers/peers.h"

#include <math.h>
#include <stdio.h>

#include <proj.h>

#define RADIUS 6371007.2L
#define QUARTER_PI 0.785398163397448309615660845819875721L

/* One projection, or one for each face. */
typedef struct planes
{
    PJ *projection[6];
} planes;

static int transform(const peer_subject *subject, int chart, PJ_DIRECTION direction,
                     const double from[2], double to[2])
{
    PJ *projection = ((const planes *)subject->handle)->projection[chart];
    proj_errno_reset(projection);
    PJ_COORD result = proj_trans(projection, direction, proj_coord(from[0], from[1], 0.0, 0.0));
    to[0] = result.v[0];
    to[1] = result.v[1];
    return proj_errno(projection) == 0 && isfinite(to[0]) && isfinite(to[1]);
}

static int forward(const peer_subject *subject, const double sphere[3], peer_place *place)
{
    double xy[2];
    int done = transform(subject, place->chart, PJ_FWD, sphere, xy);
    place->x = xy[0];
    place->y = xy[1];
    return done;
}

static int inverse(const peer_subject *subject, const peer_place *place, double sphere[3])
{
    double xy[2] = {place->x, place->y};
    return transform(subject, place->chart, PJ_INV, xy, sphere);
}

/* qsc: metres, half a face is a radius. */
static void qsc_to_plane(const peer_subject *subject, const peer_face_place *from,
                         peer_place *place)
{
    (void)subject;
    place->chart = from->face;
    place->x = (double)(RADIUS * from->u);
    place->y = (double)(RADIUS * from->v);
}

static void qsc_from_plane(const peer_subject *subject, const peer_place *place,
                           peer_face_place *to)
{
    (void)subject;
    to->face = place->chart;
    to->u = (long double)place->x / RADIUS;
    to->v = (long double)place->y / RADIUS;
}

/* s2: S2's (s, t) in [0, 1], whatever the radius is. */
static void s2_to_plane(const peer_subject *subject, const peer_face_place *from, peer_place *place)
{
    (void)subject;
    place->chart = from->face;
    place->x = (double)((from->u + 1.0L) / 2.0L);
    place->y = (double)((from->v + 1.0L) / 2.0L);
}

static void s2_from_plane(const peer_subject *subject, const peer_place *place, peer_face_place *to)
{
    (void)subject;
    to->face = place->chart;
    to->u = 2.0L * (long double)place->x - 1.0L;
    to->v = 2.0L * (long double)place->y - 1.0L;
}

/* healpix: metres along the equator. */
static void healpix_to_plane(const peer_subject *subject, const peer_face_place *from,
                             peer_place *place)
{
    (void)subject;
    long double x;
    long double y;
    peer_healpix_plane(from, &x, &y);
    place->chart = 0;
    place->x = (double)(RADIUS * QUARTER_PI * x);
    place->y = (double)(RADIUS * QUARTER_PI * y);
}

static void healpix_from_plane(const peer_subject *subject, const peer_place *place,
                               peer_face_place *to)
{
    (void)subject;
    peer_healpix_face((long double)place->x / (RADIUS * QUARTER_PI),
                      (long double)place->y / (RADIUS * QUARTER_PI), to);
}

typedef struct projection
{
    const char *name; /* PROJ's and ours */
    const char *frame;
    int healpix;
    void (*to_plane)(const peer_subject *, const peer_face_place *, peer_place *);
    void (*from_plane)(const peer_subject *, const peer_place *, peer_face_place *);
    peer_record record;
} projection;

/* Each face is a projection of its own, named by its centre. */
static int open_planes(const projection *p, const cm_frame *frame, planes *opened)
{
    for (int i = 0; i < 6; i++)
    {
        static const int lon[] = {0, 0, 90, 180, -90, 0}; /* of the axes +z, +x, ... -z */
        static const int lat[] = {90, 0, 0, 0, 0, -90};
        int axis = frame->face[i].outward;
        int k = axis == CM_AXIS_Z    ? 0
                : axis == CM_AXIS_X  ? 1
                : axis == CM_AXIS_Y  ? 2
                : axis == -CM_AXIS_X ? 3
                : axis == -CM_AXIS_Y ? 4
                                     : 5;
        char text[96];
        snprintf(text, sizeof text, "+proj=%s +lat_0=%d +lon_0=%d +R=6371007.2", p->name,
                 p->healpix ? 0 : lat[k], p->healpix ? 0 : lon[k]);
        opened->projection[i] = proj_create(PJ_DEFAULT_CTX, text);
        if (opened->projection[i] == NULL)
        {
            fprintf(stderr, "PROJ does not know %s\n", text);
            return 0;
        }
    }
    return 1;
}

static int compare(const projection *p, int failures)
{
    const cm_frame *frame = cm_frame_find(p->frame);
    planes opened;
    if (!open_planes(p, frame, &opened))
    {
        return 1;
    }
    peer_subject subject = {
        "PROJ",     proj_info().version, p->name, p->name, NULL,        frame,         1.0,
        p->healpix, p->healpix ? 0 : 6,  forward, inverse, p->to_plane, p->from_plane, &opened};
    int broken =
        failures ? peer_failures(&subject, &p->record) : peer_compare(&subject, &p->record);
    for (int i = 0; i < 6; i++)
    {
        proj_destroy(opened.projection[i]);
    }
    return broken;
}

static const peer_failure qsc_failures[] = {
    {PEER_FORWARD,
     {-1.0473235197156148e-08, 1.0340907153909791e-08, 0.0},
     0.094,
     "the angle from the centre is an arc cosine, which has lost it near the centre of a face"},
    {PEER_INVERSE,
     {1.0, 1.3227924196361833e-08, 5.5343198499711135e-09},
     0.067,
     "1 - cos^2 is 0 near the centre of a face"},
    {PEER_INVERSE,
     {4.0, 1.3227924196361833e-08, 5.5343198499711135e-09},
     0.067,
     "the same by an arc cosine"},
    {PEER_ROUND_TRIP, {-1.0473235197156148e-08, 1.0340907153909791e-08, 0.0}, 0.094, "as forward"},
};

static const peer_failure s2_failures[] = {
    {PEER_INVERSE,
     {2.0, 2.6606846956380472e-08, 1.4250164335488334e-08},
     0.128,
     "the latitude is an arc cosine, which has lost it near a pole"},
    {PEER_ROUND_TRIP, {1.134464020465398, -1.5707963066593544, 0.0}, 0.128, "as the inverse"},
};

static const peer_failure healpix_failures[] = {
    {PEER_FORWARD,
     {2.3561920331520083, 1.5707963162583582, 0.0},
     0.067,
     "1 - |sin lat| is 0 near a pole"},
    {PEER_INVERSE,
     {4.0, 1.0768252962790379e-09, 1.2904360660278666e-08},
     0.067,
     "the latitude is an arc sine, which has lost it near a pole"},
    {PEER_ROUND_TRIP,
     {-3.1415926535897931, -0.78539816339745827, 0.0},
     INFINITY,
     "it refuses its own output, which its test finds outside the outline of the map"},
};

#define FAILURES(list) "9.1.1", sizeof(list) / sizeof((list)[0]), list

static const projection projections[] = {
    {"qsc",
     "geo",
     0,
     qsc_to_plane,
     qsc_from_plane,
     {{{PEER_AWAY_FROM_CENTRES, 15.0},
       {PEER_AWAY_FROM_CENTRES, 15.0},
       {PEER_AWAY_FROM_CENTRES, 20.0}},
      FAILURES(qsc_failures)}},
    {"s2",
     "s2",
     0,
     s2_to_plane,
     s2_from_plane,
     {{{PEER_EVERYWHERE, 8.0}, {PEER_AWAY_FROM_POLES, 15.0}, {PEER_AWAY_FROM_POLES, 15.0}},
      FAILURES(s2_failures)}},
    {"healpix",
     "geo",
     1,
     healpix_to_plane,
     healpix_from_plane,
     {{{PEER_AWAY_FROM_POLES, 10.0}, {PEER_INSIDE_SECTORS, 10.0}, {PEER_INSIDE_SECTORS, 10.0}},
      FAILURES(healpix_failures)}},
};

int main(int argc, char **argv)
{
    int broken = 0;
    int only = peer_failures_only(argc, argv);
    if (!only)
    {
        peer_table_head();
    }
    for (int failures = only; failures < 2; failures++)
    {
        for (size_t i = 0; i < sizeof projections / sizeof projections[0]; i++)
        {
            broken += compare(&projections[i], failures);
        }
    }
    return broken != 0;
}
