/* SPDX-License-Identifier: MIT
 *
 * chealpix (Gorski, Reinecke et al.): pixels. It has no projection to compare with, so forward is
 * how far a point lies from the pixel that chealpix says it is in (0 inside), inverse how far
 * chealpix's centre of a pixel is from the true one. Where the pixels are, the plane of this
 * library's mapping healpix says: their edges are exact numbers there.
 */
#define _POSIX_C_SOURCE 200809L

#include "truth/length_text.h"
#include "truth/peers/peers.h"

#include "truth/sphere.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chealpix.h>

/* A pixel in the nested scheme: base pixel, and column and row in it. */
typedef struct pixel
{
    int64_t nside;
    int base;
    int64_t x;
    int64_t y;
} pixel;

/* Every second bit of a number, from the lowest. */
static int64_t every_second_bit(int64_t bits)
{
    int64_t result = 0;
    for (int i = 0; i < 31; i++)
    {
        result |= (bits >> 2 * i & 1) << i;
    }
    return result;
}

static pixel pixel_from_nest(int64_t nside, int64_t number)
{
    int64_t inside = number & (nside * nside - 1);
    pixel p = {nside, (int)(number / (nside * nside)), every_second_bit(inside),
               every_second_bit(inside >> 1)};
    return p;
}

static int64_t nest_from_pixel(const pixel *p)
{
    int64_t inside = 0;
    for (int i = 0; i < 30; i++)
    {
        inside |= (p->x >> i & 1) << 2 * i | (p->y >> i & 1) << (2 * i + 1);
    }
    return p->base * p->nside * p->nside + inside;
}

/* --------------------------------------------------------------------------------- the geometry */

static cm_mapping *healpix;

/* The middle of a base pixel in HEALPix's plane, in eighths of a turn. */
static void base_middle(int base, long double *x, long double *y)
{
    *x = (long double)(base % 4 * 2 + (base / 4 == 1 ? 0 : 1));
    *y = (long double)(1 - base / 4);
}

/* The direction, in the axes of the mapping, of a place in a base pixel, x and y in [0, 1]. */
static void direction_in_base(int base, long double x, long double y, double direction[3])
{
    long double middle_x;
    long double middle_y;
    peer_face_place place;
    base_middle(base, &middle_x, &middle_y);
    peer_healpix_face(middle_x + (x - y), middle_y + (x + y - 1.0L), &place);
    double uv[2] = {(double)place.u, (double)place.v};
    cm_inverse(healpix, (uint8_t)place.face, uv, direction);
}

/* Where a direction is in the coordinates of a base pixel: in [0, 1] if it is in it. */
static void place_in_base(int base, const double direction[3], long double *x, long double *y)
{
    double uv[2];
    long double plane_x;
    long double plane_y;
    long double middle_x;
    long double middle_y;
    peer_face_place place;
    place.face = cm_forward(healpix, direction, uv);
    place.u = uv[0];
    place.v = uv[1];
    peer_healpix_plane(&place, &plane_x, &plane_y);
    base_middle(base, &middle_x, &middle_y);
    long double across = remainderl(plane_x - middle_x, 8.0L);
    long double up = plane_y - middle_y;
    *x = (up + 1.0L + across) / 2.0L;
    *y = (up + 1.0L - across) / 2.0L;
}

/* The pixel that a direction is in. */
static pixel pixel_of_direction(int64_t nside, const double direction[3])
{
    pixel p = {nside, 0, 0, 0};
    for (; p.base < 12; p.base++)
    {
        long double x;
        long double y;
        place_in_base(p.base, direction, &x, &y);
        if (x >= 0.0L && x < 1.0L && y >= 0.0L && y < 1.0L)
        {
            p.x = (int64_t)(x * (long double)nside);
            p.y = (int64_t)(y * (long double)nside);
            break;
        }
    }
    return p;
}

/* The distance of a direction from the point at fraction t of an edge, 0..3, of a pixel. */
static double distance_from_edge(const pixel *p, int edge, long double t, const double direction[3])
{
    double corner[3];
    long double x = edge < 2 ? t : (long double)(edge - 2);
    long double y = edge < 2 ? (long double)edge : t;
    direction_in_base(p->base, ((long double)p->x + x) / (long double)p->nside,
                      ((long double)p->y + y) / (long double)p->nside, corner);
    return earth_metres(direction, corner);
}

/* Golden-section search for the nearest point of an edge. */
static double distance_from_whole_edge(const pixel *p, int edge, const double direction[3])
{
    const long double golden = 0.61803398874989484820L;
    long double low = 0.0L;
    long double high = 1.0L;
    double nearest = INFINITY;
    for (int i = 0; i < 60; i++)
    {
        long double a = high - golden * (high - low);
        long double b = low + golden * (high - low);
        double at_a = distance_from_edge(p, edge, a, direction);
        double at_b = distance_from_edge(p, edge, b, direction);
        nearest = fmin(nearest, fmin(at_a, at_b));
        if (at_a < at_b)
        {
            high = b;
        }
        else
        {
            low = a;
        }
    }
    return nearest;
}

static double distance_from_pixel(const pixel *p, const double direction[3])
{
    long double x;
    long double y;
    long double nside = (long double)p->nside;
    double nearest[3];
    place_in_base(p->base, direction, &x, &y);
    long double low_x = (long double)p->x / nside;
    long double low_y = (long double)p->y / nside;
    long double near_x = fminl(fmaxl(x, low_x), low_x + 1.0L / nside);
    long double near_y = fminl(fmaxl(y, low_y), low_y + 1.0L / nside);
    if (near_x == x && near_y == y)
    {
        return 0.0;
    }
    direction_in_base(p->base, near_x, near_y, nearest);
    double metres = earth_metres(direction, nearest);
    for (int edge = 0; edge < 4 && metres > 10e-9; edge++) /* the plane may be cut between them */
    {
        metres = fmin(metres, distance_from_whole_edge(p, edge, direction));
    }
    return metres;
}

/* ------------------------------------------------------------------------- chealpix's functions */

/* All as nested numbers. */
static int64_t forward_vector_nest(int64_t nside, const double v[3])
{
    long number;
    vec2pix_nest((long)nside, v, &number);
    return number;
}

static int64_t forward_vector_ring(int64_t nside, const double v[3])
{
    long number;
    vec2pix_ring((long)nside, v, &number);
    ring2nest((long)nside, number, &number);
    return number;
}

static int64_t forward_vector_nest64(int64_t nside, const double v[3])
{
    int64_t number;
    vec2pix_nest64(nside, v, &number);
    return number;
}

static int64_t forward_vector_ring64(int64_t nside, const double v[3])
{
    int64_t number;
    vec2pix_ring64(nside, v, &number);
    ring2nest64(nside, number, &number);
    return number;
}

static int64_t forward_angles_nest(int64_t nside, const double a[3])
{
    long number;
    ang2pix_nest((long)nside, a[1], a[0], &number);
    return number;
}

static int64_t forward_angles_nest64(int64_t nside, const double a[3])
{
    int64_t number;
    ang2pix_nest64(nside, a[1], a[0], &number);
    return number;
}

static void inverse_vector_nest(int64_t nside, int64_t number, double v[3])
{
    pix2vec_nest((long)nside, (long)number, v);
}

static void inverse_vector_ring(int64_t nside, int64_t number, double v[3])
{
    long ring;
    nest2ring((long)nside, (long)number, &ring);
    pix2vec_ring((long)nside, ring, v);
}

static void inverse_vector_nest64(int64_t nside, int64_t number, double v[3])
{
    pix2vec_nest64(nside, number, v);
}

static void inverse_vector_ring64(int64_t nside, int64_t number, double v[3])
{
    int64_t ring;
    nest2ring64(nside, number, &ring);
    pix2vec_ring64(nside, ring, v);
}

static void inverse_angles_nest(int64_t nside, int64_t number, double a[3])
{
    pix2ang_nest((long)nside, (long)number, &a[1], &a[0]);
}

static void inverse_angles_nest64(int64_t nside, int64_t number, double a[3])
{
    pix2ang_nest64(nside, number, &a[1], &a[0]);
}

typedef struct function
{
    const char *name;
    int64_t nside;
    int angles; /* longitude and colatitude in radians, else a vector */
    int64_t (*forward)(int64_t nside, const double sphere[3]);
    void (*inverse)(int64_t nside, int64_t number, double sphere[3]);
    peer_claim claim;
} function;

/* The direction, in the axes of the mapping, of what chealpix is given or gives. */
static void direction_of(const function *f, const double sphere[3], double direction[3])
{
    long double d[3] = {sphere[0], sphere[1], sphere[2]};
    if (f->angles)
    {
        long double s = sinl(sphere[1]);
        d[0] = s * cosl(sphere[0]);
        d[1] = s * sinl(sphere[0]);
        d[2] = cosl(sphere[1]);
    }
    long double half = sqrtl(0.5L);
    direction[0] = (double)(half * (d[0] + d[1]));
    direction[1] = (double)(half * (d[1] - d[0]));
    direction[2] = (double)d[2];
}

/* ------------------------------------------------------------------------------------ comparing */

static double forward_distance(const function *f, const double sphere[3])
{
    double direction[3];
    direction_of(f, sphere, direction);
    int64_t number = f->forward(f->nside, sphere);
    if (number < 0 || number >= 12 * f->nside * f->nside)
    {
        return INFINITY;
    }
    pixel p = pixel_from_nest(f->nside, number);
    return distance_from_pixel(&p, direction);
}

static double inverse_distance(const function *f, const pixel *p, double direction[3])
{
    double sphere[3];
    double found[3];
    long double nside = (long double)p->nside;
    direction_in_base(p->base, ((long double)p->x + 0.5L) / nside,
                      ((long double)p->y + 0.5L) / nside, direction);
    f->inverse(p->nside, nest_from_pixel(p), sphere);
    direction_of(f, sphere, found);
    return earth_metres(direction, found);
}

/* The worst of random points and of hard ones, and of those in the region. */
typedef struct extremes
{
    double worst[2];
    double within;
    char at[128];
    char within_at[128];
} extremes;

static void note(extremes *e, int hard, double metres, int within, const char *at)
{
    if (metres > e->worst[hard])
    {
        e->worst[hard] = metres;
        if (hard)
        {
            snprintf(e->at, sizeof e->at, "%s", at);
        }
    }
    if (within && metres > e->within)
    {
        e->within = metres;
        snprintf(e->within_at, sizeof e->within_at, "%s", at);
    }
}

static int report(const function *f, const extremes *e)
{
    char mapping[64];
    snprintf(mapping, sizeof mapping, "%s, nside %" PRId64, f->name, f->nside);
    peer_row row = {.peer = "chealpix",
                    .version = PEER_VERSION,
                    .mapping = mapping,
                    .direction = f->forward != NULL ? "forward" : "inverse",
                    .right = peer_region_words(f->claim.region),
                    .right_metres = e->within,
                    .random_metres = e->worst[0],
                    .hard_metres = e->worst[1],
                    .at = e->at};
    peer_table_row(&row);
    if (e->within <= f->claim.nanometres * 1e-9)
    {
        return 0;
    }
    fflush(stdout);
    fprintf(stderr, "%s: %s where %g nm are claimed, at %s\n", mapping, length_text(e->within),
            f->claim.nanometres, e->within_at);
    return 1;
}

static void note_forward(const function *f, extremes *e, int hard, const double *points,
                         size_t count)
{
    for (size_t i = 0; i < count; i++)
    {
        double sphere[3] = {points[3 * i], points[3 * i + 1], points[3 * i + 2]};
        double direction[3];
        char at[128];
        if (f->angles)
        {
            sphere[1] =
                fabs(sphere[1]); /* colatitude: as many near 0 as there are near the equator */
        }
        double metres = forward_distance(f, sphere);
        if (metres == 0.0)
        {
            continue;
        }
        direction_of(f, sphere, direction);
        snprintf(at, sizeof at, f->angles ? "phi %.17g theta %.17g" : "x %.17g y %.17g z %.17g",
                 sphere[0], sphere[1], sphere[2]);
        note(e, hard, metres, peer_is_within(f->claim.region, direction), at);
    }
}

/* A pixel at a distance of any size from the corners and edges of its base pixel. */
static pixel hard_pixel(int64_t nside, uint64_t *state)
{
    double levels = 0.5 * log2((double)nside);
    int64_t x = (int64_t)exp2(levels * (1.0 + next_real(state))) - 1;
    int64_t y = (int64_t)exp2(levels * (1.0 + next_real(state))) - 1;
    pixel p;
    p.nside = nside;
    p.base = (int)(next_bits(state) % 12);
    p.x = next_bits(state) >> 63 ? x : nside - 1 - x;
    p.y = next_bits(state) >> 63 ? y : nside - 1 - y;
    return p;
}

/* A point on the edge of a hard pixel, or within 1e-17 to 1e-12 beside it. */
static void point_on_edge(const function *f, uint64_t *state, double sphere[3])
{
    double d[3];
    double size = pow(10.0, 2.5 * next_real(state) - 14.5);
    pixel p = hard_pixel(f->nside, state);
    int edge = (int)(next_bits(state) % 4);
    long double t = 0.5L + 0.5L * next_real(state);
    long double x = edge < 2 ? t : (long double)(edge - 2);
    long double y = edge < 2 ? (long double)edge : t;
    direction_in_base(p.base, ((long double)p.x + x) / (long double)p.nside,
                      ((long double)p.y + y) / (long double)p.nside, d);
    long double half = sqrtl(0.5L);
    sphere[0] = (double)(half * ((long double)d[0] - d[1])) + size * next_real(state);
    sphere[1] = (double)(half * ((long double)d[0] + d[1])) + size * next_real(state);
    sphere[2] = d[2];
    if (f->angles)
    {
        double theta = atan2(hypot(sphere[0], sphere[1]), sphere[2]);
        sphere[0] = atan2(sphere[1], sphere[0]);
        sphere[1] = theta;
    }
}

static int compare_forward(const function *f)
{
    peer_subject subject;
    memset(&subject, 0, sizeof subject);
    subject.unit = f->angles ? 1.0 : 0.0;
    size_t count;
    uint64_t state = 25;
    extremes e = {{0.0, 0.0}, 0.0, "", ""};
    double *random = peer_random_sphere(&subject, PEER_RANDOM_POINTS);
    double *hard = peer_hard_sphere(&subject, &count);
    note_forward(f, &e, 0, random, PEER_RANDOM_POINTS);
    note_forward(f, &e, 1, hard, count);
    for (size_t i = 0; i < count; i++)
    {
        point_on_edge(f, &state, hard + 3 * i);
    }
    note_forward(f, &e, 1, hard, count);
    free(random);
    free(hard);
    return report(f, &e);
}

static void note_inverse(const function *f, extremes *e, int hard, const pixel *p)
{
    double direction[3];
    char at[128];
    double metres = inverse_distance(f, p, direction);
    snprintf(at, sizeof at, "pixel %" PRId64 " (base %d x %" PRId64 " y %" PRId64 ")",
             nest_from_pixel(p), p->base, p->x, p->y);
    note(e, hard, metres, peer_is_within(f->claim.region, direction), at);
}

static int compare_inverse(const function *f)
{
    uint64_t state = 24;
    extremes e = {{0.0, 0.0}, 0.0, "", ""};
    pixel p = {f->nside, 0, 0, 0};
    for (int i = 0; i < 100000; i++)
    {
        p.base = (int)(next_bits(&state) % 12);
        p.x = (int64_t)(next_bits(&state) % (uint64_t)f->nside);
        p.y = (int64_t)(next_bits(&state) % (uint64_t)f->nside);
        note_inverse(f, &e, 0, &p);
    }
    for (int i = 0; i < 100000; i++)
    {
        p = hard_pixel(f->nside, &state);
        note_inverse(f, &e, 1, &p);
    }
    return report(f, &e);
}

/* ------------------------------------------------------------------------------------- failures */

static const char documented_version[] = "3.30.0";

/* A vector that chealpix puts into a pixel in which it is not. */
typedef struct misplaced
{
    const char *name;
    int64_t nside;
    int64_t (*forward)(int64_t nside, const double sphere[3]);
    double vector[3];
    double metres;
    const char *text;
} misplaced;

static const char squares[] =
    "the length is the root of a sum of squares, which underflows or overflows";

static const misplaced misplaced_vectors[] = {
    {"vec2pix_ring64",
     (int64_t)1 << 29,
     forward_vector_ring64,
     {-6.5426316436689353e-09, -0.7452360785863763, 0.66680071023747445},
     0.0084,
     "the index in a ring is longitude times ring, rounded to 1e-7 of a pixel at such a ring"},
    {"vec2pix_nest64", 64, forward_vector_nest64, {1e-200, 2e-200, 1e-200}, 7.2e6, squares},
    {"vec2pix_nest64", 64, forward_vector_nest64, {1e200, 2e200, 1e200}, 2.6e6, squares},
};

static int misplaced_failures(void)
{
    int wrong = 0;
    for (size_t i = 0; i < sizeof misplaced_vectors / sizeof misplaced_vectors[0]; i++)
    {
        const misplaced *m = &misplaced_vectors[i];
        function f = {m->name, m->nside, 0, m->forward, NULL, {PEER_NOWHERE, 0.0}};
        char at[256];
        char mapping[64];
        double direction[3];
        double metres = forward_distance(&f, m->vector);
        direction_of(&f, m->vector, direction);
        pixel right = pixel_of_direction(m->nside, direction);
        snprintf(mapping, sizeof mapping, "%s, nside %" PRId64, m->name, m->nside);
        snprintf(at, sizeof at, "x %.17g y %.17g z %.17g; nested %" PRId64 "; nested %" PRId64,
                 m->vector[0], m->vector[1], m->vector[2], m->forward(m->nside, m->vector),
                 nest_from_pixel(&right));
        peer_row row = {.peer = "chealpix",
                        .version = PEER_VERSION,
                        .mapping = mapping,
                        .direction = "forward",
                        .right = "",
                        .at = at};
        wrong += peer_failure_line(&row, documented_version, m->metres, metres, m->text);
    }
    return wrong;
}

/* What is outside the domain, and what comes of it. */
typedef struct stray
{
    const char *name;
    int angles;
    int64_t (*forward)(int64_t nside, const double sphere[3]);
    double sphere[3];
    int outcome;
} stray;

enum
{
    A_PIXEL,
    NO_PIXEL,       /* a number that none has */
    END_OF_PROCESS, /* by exit */
    KILLED,         /* by a signal */
    UNKNOWN
};

static const char *const outcomes[] = {"the number of a pixel", "a number that no pixel has",
                                       "the process ends", "the process is killed",
                                       "not to be found out"};

static const stray strays[] = {
    {"ang2pix_nest64", 1, forward_angles_nest64, {0.0, NAN, 0.0}, END_OF_PROCESS},
    {"ang2pix_nest64", 1, forward_angles_nest64, {0.0, -5e-324, 0.0}, END_OF_PROCESS},
    {"ang2pix_nest64", 1, forward_angles_nest64, {0.0, 3.1415926535897936, 0.0}, END_OF_PROCESS},
    {"ang2pix_nest", 1, forward_angles_nest, {0.0, NAN, 0.0}, END_OF_PROCESS},
    {"ang2pix_nest64", 1, forward_angles_nest64, {NAN, 1.0, 0.0}, A_PIXEL},
    {"vec2pix_nest64", 0, forward_vector_nest64, {NAN, 0.0, 0.0}, NO_PIXEL},
    {"vec2pix_ring64", 0, forward_vector_ring64, {NAN, 0.0, 0.0}, A_PIXEL},
};

/* In a process of its own. What chealpix writes to stderr goes to stdout, in its place. */
static int outcome_of(const stray *s)
{
    enum
    {
        NSIDE = 64,
        STATUS = 77 /* that chealpix does not exit with */
    };
    int status = 0;
    fflush(stdout);
    pid_t child = fork();
    if (child == 0)
    {
        dup2(STDOUT_FILENO, STDERR_FILENO);
        int64_t number = s->forward(NSIDE, s->sphere);
        _exit(STATUS + (number >= 0 && number < 12 * NSIDE * NSIDE ? A_PIXEL : NO_PIXEL));
    }
    if (child < 0 || waitpid(child, &status, 0) != child)
    {
        return UNKNOWN;
    }
    if (!WIFEXITED(status))
    {
        return KILLED;
    }
    return WEXITSTATUS(status) >= STATUS ? WEXITSTATUS(status) - STATUS : END_OF_PROCESS;
}

static int stray_failures(void)
{
    int wrong = 0;
    for (size_t i = 0; i < sizeof strays / sizeof strays[0]; i++)
    {
        const stray *s = &strays[i];
        int outcome = outcome_of(s);
        char at[128];
        snprintf(at, sizeof at, s->angles ? "phi %.17g theta %.17g" : "x %.17g y %.17g z %.17g",
                 s->sphere[0], s->sphere[1], s->sphere[2]);
        printf("failure; chealpix %s; %s, nside 64; call; %s; ; ; ; %s; %s\n", PEER_VERSION,
               s->name, at, outcome == s->outcome ? "as documented" : "not as documented",
               outcomes[outcome]);
        wrong += outcome != s->outcome && peer_is_recorded(PEER_VERSION, documented_version);
    }
    return wrong;
}

static const function functions[] = {
    {"vec2pix_nest64", (int64_t)1 << 29, 0, forward_vector_nest64, NULL, {PEER_EVERYWHERE, 15.0}},
    {"vec2pix_ring64", (int64_t)1 << 29, 0, forward_vector_ring64, NULL, {PEER_IN_BELT, 15.0}},
    {"ang2pix_nest64", (int64_t)1 << 29, 1, forward_angles_nest64, NULL, {PEER_EVERYWHERE, 15.0}},
    {"pix2vec_nest64", (int64_t)1 << 29, 0, NULL, inverse_vector_nest64, {PEER_EVERYWHERE, 10.0}},
    {"pix2vec_ring64", (int64_t)1 << 29, 0, NULL, inverse_vector_ring64, {PEER_EVERYWHERE, 10.0}},
    {"pix2ang_nest64", (int64_t)1 << 29, 1, NULL, inverse_angles_nest64, {PEER_EVERYWHERE, 10.0}},
    {"vec2pix_nest", 8192, 0, forward_vector_nest, NULL, {PEER_AWAY_FROM_POLES, 15.0}},
    {"vec2pix_ring", 8192, 0, forward_vector_ring, NULL, {PEER_AWAY_FROM_POLES, 15.0}},
    {"ang2pix_nest", 8192, 1, forward_angles_nest, NULL, {PEER_AWAY_FROM_POLES, 15.0}},
    {"pix2vec_nest", 8192, 0, NULL, inverse_vector_nest, {PEER_AWAY_FROM_POLES, 10.0}},
    {"pix2vec_ring", 8192, 0, NULL, inverse_vector_ring, {PEER_AWAY_FROM_POLES, 10.0}},
    {"pix2ang_nest", 8192, 1, NULL, inverse_angles_nest, {PEER_AWAY_FROM_POLES, 10.0}},
};

static int compare_all(void)
{
    int broken = 0;
    peer_table_head();
    for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++)
    {
        const function *f = &functions[i];
        broken += f->forward != NULL ? compare_forward(f) : compare_inverse(f);
    }
    return broken;
}

int main(int argc, char **argv)
{
    int broken = 0;
    if (cm_mapping_create("healpix", NULL, &healpix) != CM_OK)
    {
        return 1;
    }
    broken += peer_failures_only(argc, argv) ? 0 : compare_all();
    broken += misplaced_failures() + stray_failures();
    cm_mapping_destroy(healpix);
    return broken != 0;
}
