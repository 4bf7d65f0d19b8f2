/* SPDX-License-Identifier: MIT
 *
 * What the comparisons with other libraries share: points, distances and the report.
 *
 * A peer is described by four small functions; the common part feeds them random and hard points
 * and measures, in metres on Earth, how far from the truth it is in three directions:
 *
 *   forward     its place in the plane, taken back to the sphere by this library, against the point
 *               that it was given
 *   inverse     its point on the sphere against this library's, for the same place
 *   round trip  its inverse of its forward against the point that it was given; this library has no
 *               part in that
 *
 * The points that a peer is given are exact numbers in its own units, and long double turns them
 * into directions; what this library adds to a distance is its own error, 8 eps or some 5 nm. The
 * failures are checked with 60 digits by peer_truth.py.
 *
 * Two kinds of claims come out of it. Agreement, where a peer is right: within a bound, or the
 * program fails. And failures of the peer at single points, as docs/measured/peers.md has them: in the
 * version that docs/measured/peers.md names they must be what it says, in any other the program says what
 * has become of them.
 */
#ifndef TRUTH_PEERS_H
#define TRUTH_PEERS_H

#include <stddef.h>

#include <cubemap/cubemap.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Every program prints the table and the failures. Is it told, by its one argument "failures", to
 * print only those? */
int peer_failures_only(int argc, char **argv);

/* A place in a peer's plane; chart is for those whose faces are planes of their own. */
typedef struct peer_place
{
    int chart;
    double x;
    double y;
} peer_place;

/* A place on a face in this library's terms. long double, so that getting there costs nothing. */
typedef struct peer_face_place
{
    int face; /* CM_NO_FACE if the peer's place is on none */
    long double u;
    long double v;
} peer_face_place;

/* A comparison of one mapping of one peer. Functions return 0 where the peer refuses the point. */
typedef struct peer_subject
{
    const char *peer;          /* "WCSLIB" */
    const char *version;       /* "7.12" */
    const char *mapping;       /* the peer's name for it, "QSC" */
    const char *specification; /* ours, "qsc" */
    const char *published;     /* the specification of the inverse if it is another, else NULL */
    const cm_frame *frame;     /* ours */
    double unit; /* radians in the peer's unit of longitude and latitude; 0 if it takes vectors */
    int turned;  /* is its longitude ours plus 45 degrees, as HEALPix's is? */
    int charts;  /* 0: one plane; 6: a plane for each face, where forward is told the face */
    int (*forward)(const struct peer_subject *subject, const double sphere[3], peer_place *place);
    int (*inverse)(const struct peer_subject *subject, const peer_place *place, double sphere[3]);
    void (*to_plane)(const struct peer_subject *subject, const peer_face_place *from,
                     peer_place *place);
    void (*from_plane)(const struct peer_subject *subject, const peer_place *place,
                       peer_face_place *to);
    void *handle; /* the peer's own */
} peer_subject;

/* Where a peer is claimed to be right, by the true direction in this library's axes. */
typedef enum peer_region
{
    PEER_EVERYWHERE,
    PEER_NOWHERE,
    PEER_AWAY_FROM_POLES,   /* 10 degrees */
    PEER_AWAY_FROM_CENTRES, /* 10 degrees, of all six faces, the poles among them */
    PEER_INSIDE_SECTORS,    /* of HEALPix's plane: 1e-6 from the meridians where it is cut, and 10
                               degrees from the poles */
    PEER_IN_BELT            /* HEALPix's, |sin lat| < 2/3 */
} peer_region;

int peer_is_within(peer_region region, const double direction[3]);
const char *peer_region_words(peer_region region);

/* The three directions. */
enum
{
    PEER_FORWARD,
    PEER_INVERSE,
    PEER_ROUND_TRIP
};

typedef struct peer_claim
{
    peer_region region;
    double nanometres;
} peer_claim;

/* A failure that docs/measured/peers.md has. */
typedef struct peer_failure
{
    int direction;    /* PEER_FORWARD... */
    double input[3];  /* the point on the sphere, or face, u, v */
    double metres;    /* from the truth; INFINITY for a refusal or a NaN */
    const char *text; /* what happens there */
} peer_failure;

/* What docs/measured/peers.md says of a subject. */
typedef struct peer_record
{
    peer_claim claims[3]; /* by direction */
    const char *version;  /* of the peer, which the failures are of */
    size_t failure_count;
    const peer_failure *failures;
} peer_record;

enum
{
    PEER_RANDOM_POINTS = 100000
};

/* A row of the table. */
typedef struct peer_row
{
    const char *peer;
    const char *version;
    const char *mapping;
    const char *direction;
    const char *right;     /* the region in words */
    double right_metres;   /* the worst in the region */
    double random_metres;  /* the worst of the random points */
    double hard_metres;    /* the worst of the hard points */
    unsigned long refused; /* so many */
    unsigned long tried;   /* of so many */
    const char *at;        /* the worst hard point */
} peer_row;

void peer_table_head(void);
void peer_table_row(const peer_row *row);

/* Print the table row of each direction, and one of this library's own round trip at the same
 * points; compare the distances within the regions with the claims. The points where the peer is
 * recorded to fail are among the hard ones. The number of claims that are broken. */
int peer_compare(const peer_subject *subject, const peer_record *record);

/* Print what each recorded failure is in this version. If that is the record's, a distance that is
 * not within a factor of two of the recorded is an error; the number of those. */
int peer_failures(const peer_subject *subject, const peer_record *record);

/* Is this the version whose failures are recorded, on the machine of the record? Elsewhere sums may
 * be fused, and NaN converted to an integer is another one. */
int peer_is_recorded(const char *version, const char *documented_version);

/* The same for one that is none of those directions; the row's peer, version, mapping, direction
 * and at are used. INFINITY for a refusal. */
int peer_failure_line(const peer_row *row, const char *documented_version, double documented,
                      double observed, const char *text);

/* Longitude and latitude to direction and back, in units of the peer. */
typedef struct peer_lonlat
{
    const char *peer;
    const char *version;
    const char *name;
    double unit; /* radians in it */
    void (*to_direction)(const double lonlat[2], double direction[3]);
    void (*to_lonlat)(const double direction[3], double lonlat[2]);
} peer_lonlat;

/* Two rows for the peer and two for this library at the same places; both are held to the bound.
 * The number of broken bounds. */
int peer_compare_lonlat(const peer_lonlat *theirs, double nanometres);

/* The true direction of a point on the sphere in the units of the subject, as precise in each
 * component as long double allows. */
void peer_direction(const peer_subject *subject, const double sphere[3], double direction[3]);

/* Zeroed memory, or the end of the program. */
void *peer_allocate(size_t count, size_t size);

/* Points, to be freed. Spheres: random and hard points in units of the subject, three numbers each.
 * Places: face, u, v. */
double *peer_random_sphere(const peer_subject *subject, size_t count);
double *peer_hard_sphere(const peer_subject *subject, size_t *count);
double *peer_random_places(size_t count);
double *peer_hard_places(size_t *count);

/* Longitude and latitude in degrees of the centres of the faces of the frame geo. */
extern const double peer_geo_centre[6][2];

/* HEALPix's plane, x the longitude in eighths of a turn from -4 to 4, y from -2 to 2, from and to
 * the six faces of the mapping healpix. */
void peer_healpix_plane(const peer_face_place *from, long double *x, long double *y);
void peer_healpix_face(long double x, long double y, peer_face_place *to);

#ifdef __cplusplus
}
#endif

#endif
