/* SPDX-License-Identifier: MIT
 *
 * WCSLIB (Calabretta): the quadrilateralized cubes TSC, CSC and QSC and the HEALPix projections HPX
 * and XPH.
 */
#include "truth/peers/peers.h"

#include <math.h>
#include <stdio.h>

#include <prj.h>
#include <wcs.h>

static int forward(const peer_subject *subject, const double sphere[3], peer_place *place)
{
    struct prjprm *projection = (struct prjprm *)subject->handle;
    int bad = 0;
    return projection->prjs2x(projection, 1, 1, 1, 1, &sphere[0], &sphere[1], &place->x, &place->y,
                              &bad) == 0 &&
           bad == 0;
}

static int inverse(const peer_subject *subject, const peer_place *place, double sphere[3])
{
    struct prjprm *projection = (struct prjprm *)subject->handle;
    int bad = 0;
    return projection->prjx2s(projection, 1, 1, 1, 1, &place->x, &place->y, &sphere[0], &sphere[1],
                              &bad) == 0 &&
           bad == 0;
}

/* the centres of the faces of FITS, in units of half a face */
static const int centre[6][2] = {{0, 2}, {0, 0}, {2, 0}, {4, 0}, {6, 0}, {0, -2}};

static void cube_to_plane(const peer_subject *subject, const peer_face_place *from,
                          peer_place *place)
{
    (void)subject;
    place->x = (double)(45.0L * (from->u + (long double)centre[from->face][0]));
    place->y = (double)(45.0L * (from->v + (long double)centre[from->face][1]));
}

static void cube_from_plane(const peer_subject *subject, const peer_place *place,
                            peer_face_place *to)
{
    (void)subject;
    long double x = (long double)place->x / 45.0L;
    long double y = (long double)place->y / 45.0L;
    to->face = CM_NO_FACE;
    if (!(x > -2.0L && x < 8.0L && fabsl(y) < 4.0L))
    {
        return;
    }
    int column = (int)floorl((x + 1.0L) / 2.0L);
    column = column < 0 ? 0 : column > 3 ? 3 : column;
    to->face = y > 1.0L ? 0 : y < -1.0L ? 5 : 1 + column;
    to->u = x - (long double)centre[to->face][0];
    to->v = y - (long double)centre[to->face][1];
}

static void hpx_to_plane(const peer_subject *subject, const peer_face_place *from,
                         peer_place *place)
{
    (void)subject;
    long double x;
    long double y;
    peer_healpix_plane(from, &x, &y);
    place->x = (double)(45.0L * x);
    place->y = (double)(45.0L * y);
}

static void hpx_from_plane(const peer_subject *subject, const peer_place *place,
                           peer_face_place *to)
{
    (void)subject;
    peer_healpix_face((long double)place->x / 45.0L, (long double)place->y / 45.0L, to);
}

/* The butterfly: quarter k of the plane, from longitude -180 + 90 k, turned about the pole. */
static void xph_to_plane(const peer_subject *subject, const peer_face_place *from,
                         peer_place *place)
{
    (void)subject;
    long double x;
    long double y;
    peer_healpix_plane(from, &x, &y);
    x = x >= 4.0L ? x - 8.0L : x;
    int quarter = (int)floorl((x + 4.0L) / 2.0L);
    long double xi = x - (2.0L * (long double)quarter - 3.0L);
    long double eta = y - 2.0L;
    long double scale = 45.0L * sqrtl(0.5L);
    long double sum = scale * (xi + eta);
    long double difference = scale * (xi - eta);
    place->x = (double)(quarter == 0   ? -difference
                        : quarter == 1 ? sum
                        : quarter == 2 ? difference
                                       : -sum);
    place->y = (double)(quarter == 0   ? -sum
                        : quarter == 1 ? -difference
                        : quarter == 2 ? sum
                                       : difference);
}

static void xph_from_plane(const peer_subject *subject, const peer_place *place,
                           peer_face_place *to)
{
    (void)subject;
    long double x = (long double)place->x * sqrtl(0.5L) / 45.0L;
    long double y = (long double)place->y * sqrtl(0.5L) / 45.0L;
    int quarter = x <= 0.0L && y > 0.0L ? 0 : x < 0.0L ? 1 : y < 0.0L ? 2 : 3;
    long double xi = quarter == 0 ? -x - y : quarter == 1 ? x - y : quarter == 2 ? x + y : -x + y;
    long double eta = quarter == 0 ? x - y : quarter == 1 ? x + y : quarter == 2 ? -x + y : -x - y;
    peer_healpix_face(xi + 2.0L * (long double)quarter - 3.0L, eta + 2.0L, to);
}

typedef struct projection
{
    const char *code;
    const char *specification;
    const char *published;
    const char *frame;
    int healpix;
    int (*set)(struct prjprm *);
    void (*to_plane)(const peer_subject *, const peer_face_place *, peer_place *);
    void (*from_plane)(const peer_subject *, const peer_place *, peer_face_place *);
    peer_record record;
} projection;

static const char arc_sine[] = "the latitude is an arc sine, which has lost it near a pole";

static const peer_failure tsc_failures[] = {
    {PEER_INVERSE, {0.0, 1.7760669268715663e-08, 1.0324151409151861e-08}, 0.131, arc_sine},
    {PEER_ROUND_TRIP, {-25.000000001220734, -89.999998846255195, 0.0}, 0.128, arc_sine},
};

static const peer_failure csc_failures[] = {
    {PEER_FORWARD,
     {-135.86687010839134, -20.559673156274929, 0.0},
     1.81,
     "the polynomial is evaluated in single precision"},
    {PEER_INVERSE,
     {4.0, -0.9999964236317419, -0.7000000781825364},
     1.48,
     "the polynomial is evaluated in single precision"},
    {PEER_ROUND_TRIP,
     {-165.51089272670785, -0.3525300931588688, 0.0},
     1390.0,
     "the published inverse, which FITS gives, is not the inverse of the forward direction"},
};

static const peer_failure qsc_failures[] = {
    {PEER_FORWARD,
     {89.989999999999995, 1e-6, 0.0},
     3.44e-6,
     "1 - cos loses digits before the formula for small angles takes over"},
    {PEER_INVERSE, {5.0, -1.3758357658879698e-08, -1.449304916955544e-10}, 0.067, arc_sine},
    {PEER_ROUND_TRIP, {109.99999999912683, -89.999999396339916, 0.0}, 0.067, arc_sine},
};

static const peer_failure hpx_failures[] = {
    {PEER_FORWARD,
     {109.99999999912683, -89.999999396339916, 0.0},
     0.067,
     "1 - |sin lat| is 0 near a pole"},
    {PEER_INVERSE, {4.0, 1.0768252962790379e-09, 1.2904360660278666e-08}, 0.067, arc_sine},
    {PEER_ROUND_TRIP,
     {-180.0, 89.99, 0.0},
     INFINITY,
     "it refuses its own output: the longitude comes out 5e-12 degrees below -180"},
};

static const peer_failure xph_failures[] = {
    {PEER_FORWARD,
     {179.99999999999997, -1e-12, 0.0},
     10007543.4,
     "one ulp from longitude 180: the sum with 180 rounds to 360, and the point is put at 90"},
    {PEER_FORWARD,
     {109.99999999912683, -89.999999396339916, 0.0},
     0.067,
     "1 - |sin lat| is 0 near the south pole; near the north pole it has another formula"},
    {PEER_INVERSE, {4.0, 0.0, 1e-16}, INFINITY, "longitude NaN with status 0"},
    {PEER_INVERSE, {5.0, 0.0, 0.0}, INFINITY, "longitude NaN with status 0"},
};

#define FAILURES(list) "7.12", sizeof(list) / sizeof((list)[0]), list

/* The plane is in degrees, up to 315 of them on a cube, where an ulp is 6 nm: hence the nanometres.
 * */
static const projection projections[] = {
    {"TSC",
     "gnomonic",
     NULL,
     "fits",
     0,
     tscset,
     cube_to_plane,
     cube_from_plane,
     {{{PEER_EVERYWHERE, 15.0}, {PEER_AWAY_FROM_POLES, 15.0}, {PEER_AWAY_FROM_POLES, 20.0}},
      FAILURES(tsc_failures)}},
    {"CSC",
     "cobe",
     "cobe:legacy=1",
     "fits",
     0,
     cscset,
     cube_to_plane,
     cube_from_plane,
     {{{PEER_EVERYWHERE, 2.5e9}, {PEER_EVERYWHERE, 2.5e9}, {PEER_NOWHERE, 0.0}},
      FAILURES(csc_failures)}},
    {"QSC",
     "qsc",
     NULL,
     "fits",
     0,
     qscset,
     cube_to_plane,
     cube_from_plane,
     {{{PEER_AWAY_FROM_CENTRES, 15.0},
       {PEER_AWAY_FROM_POLES, 15.0},
       {PEER_AWAY_FROM_CENTRES, 20.0}},
      FAILURES(qsc_failures)}},
    {"HPX",
     "healpix",
     NULL,
     "geo",
     1,
     hpxset,
     hpx_to_plane,
     hpx_from_plane,
     {{{PEER_AWAY_FROM_POLES, 15.0}, {PEER_AWAY_FROM_POLES, 15.0}, {PEER_AWAY_FROM_POLES, 20.0}},
      FAILURES(hpx_failures)}},
    {"XPH",
     "healpix",
     NULL,
     "geo",
     1,
     xphset,
     xph_to_plane,
     xph_from_plane,
     {{{PEER_INSIDE_SECTORS, 15.0}, {PEER_AWAY_FROM_POLES, 15.0}, {PEER_INSIDE_SECTORS, 20.0}},
      FAILURES(xph_failures)}},
};

static int compare(const projection *p, const char *version, int failures)
{
    struct prjprm parameters;
    prjini(&parameters);
    p->set(&parameters);
    peer_subject subject = {"WCSLIB",
                            version,
                            p->code,
                            p->specification,
                            p->published,
                            cm_frame_find(p->frame),
                            acos(-1.0) / 180.0,
                            p->healpix,
                            0,
                            forward,
                            inverse,
                            p->to_plane,
                            p->from_plane,
                            &parameters};
    return failures ? peer_failures(&subject, &p->record) : peer_compare(&subject, &p->record);
}

int main(int argc, char **argv)
{
    int parts[3] = {0, 0, 0};
    char version[32];
    int broken = 0;
    wcslib_version(parts);
    snprintf(version, sizeof version, "%d.%d", parts[0], parts[1]);
    int only = peer_failures_only(argc, argv);
    if (!only)
    {
        peer_table_head();
    }
    for (int failures = only; failures < 2; failures++)
    {
        for (size_t i = 0; i < sizeof projections / sizeof projections[0]; i++)
        {
            broken += compare(&projections[i], version, failures);
        }
    }
    return broken != 0;
}
