/* SPDX-License-Identifier: MIT
 *
 * Comparing peers with this library, and the report of it.
 */
#include "peers.h"

#include "truth/length_text.h"

#include "truth/sphere.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int peer_failures_only(int argc, char **argv)
{
    return argc == 2 && strcmp(argv[1], "failures") == 0;
}

void *peer_allocate(size_t count, size_t size)
{
    void *memory = calloc(count, size);
    if (memory == NULL)
    {
        perror("peers");
        exit(1);
    }
    return memory;
}

/* ------------------------------------------------------------------------------------ distances */

/* Our mappings for a subject. */
typedef struct comparison
{
    const peer_subject *subject;
    cm_mapping *ours;      /* whose inverse takes the peer's forward back */
    cm_mapping *published; /* whose inverse the peer's should be */
    cm_mapping *cube;      /* the cube's faces, for peers that must be told the face */
} comparison;

/* What the peer answers: a place from forward, a point on the sphere from the others. */
typedef struct answer
{
    peer_place place;
    double sphere[3];
} answer;

/* The direction of a place on a face. A place beyond the edge, as a peer with an error there gives
 * it, is the edge; *excess is how far beyond, in metres. 0 if it is no place at all. */
static int direction_of_place(const cm_mapping *mapping, const peer_face_place *place,
                              double direction[3], double *excess)
{
    if (place->face == CM_NO_FACE || !(fabsl(place->u) < 1.5L) || !(fabsl(place->v) < 1.5L))
    {
        return 0;
    }
    double uv[2] = {(double)place->u, (double)place->v};
    *excess = 0.0;
    for (int i = 0; i < 2; i++)
    {
        double beyond = fabs(uv[i]) - 1.0;
        if (beyond > 0.0)
        {
            *excess += beyond * (acos(-1.0) / 4.0) * EARTH_RADIUS;
            uv[i] = copysign(1.0, uv[i]);
        }
    }
    cm_inverse(mapping, (uint8_t)place->face, uv, direction);
    return 1;
}

/* Call the peer's forward, telling it the face if it must be told. truth: the direction it gets. */
static int call_forward(const comparison *c, const double input[3], double truth[3], answer *a)
{
    double uv[2];
    peer_direction(c->subject, input, truth);
    a->place.chart = c->subject->charts == 0 ? 0 : cm_forward(c->cube, truth, uv);
    return c->subject->forward(c->subject, input, &a->place);
}

static double forward_distance(const comparison *c, const double input[3], answer *a)
{
    double truth[3];
    double found[3];
    double excess;
    peer_face_place at;
    if (!call_forward(c, input, truth, a))
    {
        return INFINITY;
    }
    c->subject->from_plane(c->subject, &a->place, &at);
    if (!direction_of_place(c->ours, &at, found, &excess))
    {
        return INFINITY;
    }
    return earth_metres(truth, found) + excess;
}

static double inverse_distance(const comparison *c, const double input[3], answer *a)
{
    const peer_subject *s = c->subject;
    peer_face_place at = {(int)input[0], input[1], input[2]};
    double truth[3];
    double found[3];
    double excess;
    s->to_plane(s, &at, &a->place);
    s->from_plane(s, &a->place, &at); /* the place that the rounded plane coordinates are */
    if (!s->inverse(s, &a->place, a->sphere) ||
        !direction_of_place(c->published, &at, truth, &excess))
    {
        return INFINITY;
    }
    peer_direction(s, a->sphere, found);
    return earth_metres(truth, found);
}

static double round_trip_distance(const comparison *c, const double input[3], answer *a)
{
    double truth[3];
    double found[3];
    if (!call_forward(c, input, truth, a) || !c->subject->inverse(c->subject, &a->place, a->sphere))
    {
        return INFINITY;
    }
    peer_direction(c->subject, a->sphere, found);
    return earth_metres(truth, found);
}

/* The distance of the peer's answer from the truth in metres, INFINITY if it refuses or if the
 * answer is nowhere. input is a point on the sphere or, for the inverse, face, u, v. */
static double distance(const comparison *c, int direction, const double input[3], answer *a)
{
    double metres = direction == PEER_FORWARD   ? forward_distance(c, input, a)
                    : direction == PEER_INVERSE ? inverse_distance(c, input, a)
                                                : round_trip_distance(c, input, a);
    return isnan(metres) ? INFINITY : metres;
}

/* The true direction that belongs to an input, for the regions. */
static void direction_of_input(const comparison *c, int direction, const double input[3],
                               double truth[3])
{
    if (direction == PEER_INVERSE)
    {
        double uv[2] = {input[1], input[2]};
        cm_inverse(c->published, (uint8_t)input[0], uv, truth);
    }
    else
    {
        peer_direction(c->subject, input, truth);
    }
}

static cm_mapping *make(const char *specification, const cm_frame *frame)
{
    cm_mapping *mapping = NULL;
    if (cm_mapping_create(specification, frame, &mapping) != CM_OK)
    {
        fprintf(stderr, "no mapping %s\n", specification);
        exit(1);
    }
    return mapping;
}

static comparison start(const peer_subject *subject)
{
    comparison c;
    const char *published = subject->published;
    c.subject = subject;
    c.ours = make(subject->specification, subject->frame);
    c.published = make(published != NULL ? published : subject->specification, subject->frame);
    c.cube = make("gnomonic", subject->frame);
    return c;
}

static void finish(comparison *c)
{
    cm_mapping_destroy(c->ours);
    cm_mapping_destroy(c->published);
    cm_mapping_destroy(c->cube);
}

/* ----------------------------------------------------------------------------------- the report */

static const char *const direction_names[] = {"forward", "inverse", "round trip"};

void peer_table_head(void)
{
    puts("| peer | mapping | direction | right | worst there | random points, worst | hard points, "
         "worst | refused | the worst hard point |");
    puts("|---|---|---|---|---|---|---|---|---|");
}

void peer_table_row(const peer_row *row)
{
    char refusals[48] = "";
    if (row->refused != 0)
    {
        snprintf(refusals, sizeof refusals, "%lu of %lu", row->refused, row->tried);
    }
    printf("| %s %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", row->peer, row->version,
           row->mapping, row->direction, row->right,
           row->right[0] == '\0' ? "" : length_text(row->right_metres),
           length_text(row->random_metres), length_text(row->hard_metres), refusals, row->at);
}

static void print_input(char *text, size_t size, const peer_subject *subject, int direction,
                        const double input[3])
{
    if (direction == PEER_INVERSE)
    {
        snprintf(text, size, "face %d u %.17g v %.17g", (int)input[0], input[1], input[2]);
    }
    else if (subject->unit == 0.0)
    {
        snprintf(text, size, "x %.17g y %.17g z %.17g", input[0], input[1], input[2]);
    }
    else
    {
        snprintf(text, size, "lon %.17g lat %.17g %s", input[0], input[1],
                 subject->unit == 1.0 ? "radians" : "degrees");
    }
}

static void print_place(char *text, size_t size, const peer_place *place)
{
    snprintf(text, size, "chart %d x %.17g y %.17g", place->chart, place->x, place->y);
}

/* The longitude and latitude of a direction, in units of the subject. */
static void sphere_of_direction(const peer_subject *subject, const double direction[3],
                                double sphere[3])
{
    double turn = subject->turned ? acos(-1.0) / 4.0 : 0.0;
    double lon = remainder(atan2(direction[1], direction[0]) + turn, 2.0 * acos(-1.0));
    sphere[0] = lon / subject->unit;
    sphere[1] = atan2(direction[2], hypot(direction[0], direction[1])) / subject->unit;
    sphere[2] = 0.0;
}

/* ------------------------------------------------------------------------------------ comparing */

typedef struct extreme
{
    double worst; /* of the distances that are finite */
    size_t at;
    double within; /* the worst in the region; INFINITY for a refusal there */
    size_t within_at;
    unsigned long refused;
} extreme;

static void note(extreme *e, double metres, int within, size_t i)
{
    if (!isfinite(metres))
    {
        e->refused++;
        metres = INFINITY;
    }
    else if (metres > e->worst)
    {
        e->worst = metres;
        e->at = i;
    }
    if (within && metres > e->within)
    {
        e->within = metres;
        e->within_at = i;
    }
}

static extreme worst_of(const comparison *c, int direction, peer_region region,
                        const double *points, size_t count)
{
    extreme e = {0.0, 0, 0.0, 0, 0};
    for (size_t i = 0; i < count; i++)
    {
        answer a;
        double truth[3];
        double metres = distance(c, direction, points + 3 * i, &a);
        direction_of_input(c, direction, points + 3 * i, truth);
        note(&e, metres, peer_is_within(region, truth), i);
    }
    return e;
}

static int is_broken(const char *who, const char *what, double metres, double nanometres,
                     const char *at)
{
    if (metres <= nanometres * 1e-9)
    {
        return 0;
    }
    fflush(stdout);
    fprintf(stderr, "%s, %s: %s where %g nm are claimed, at %s\n", who, what, length_text(metres),
            nanometres, at);
    return 1;
}

/* This library's own round trip, with the same mapping at the same points: 5 nm are promised. */
static int compare_own_round_trip(const comparison *c, const double *const points[2],
                                  const size_t count[2])
{
    const char *name = cm_mapping_describe(c->ours)->identifier;
    extreme e[2] = {{0.0, 0, 0.0, 0, 0}, {0.0, 0, 0.0, 0, 0}};
    for (int hard = 0; hard < 2; hard++)
    {
        for (size_t i = 0; i < count[hard]; i++)
        {
            double truth[3];
            double back[3];
            double uv[2];
            peer_direction(c->subject, points[hard] + 3 * i, truth);
            uint8_t face = cm_forward(c->ours, truth, uv);
            cm_inverse(c->ours, face, uv, back);
            note(&e[hard], earth_metres(truth, back), 1, i);
        }
    }
    char at[128];
    print_input(at, sizeof at, c->subject, PEER_ROUND_TRIP, points[1] + 3 * e[1].at);
    double within = fmax(e[0].within, e[1].within);
    peer_row row = {.peer = "libcubemap",
                    .version = cm_version(),
                    .mapping = name,
                    .direction = direction_names[PEER_ROUND_TRIP],
                    .right = peer_region_words(PEER_EVERYWHERE),
                    .right_metres = within,
                    .random_metres = e[0].worst,
                    .hard_metres = e[1].worst,
                    .at = at};
    peer_table_row(&row);
    return is_broken("libcubemap", name, within, 5.0, at);
}

/* The hard points of a direction, and those where the record has failures. */
static double *hard_points(const comparison *c, int direction, const peer_record *record,
                           size_t *count)
{
    double *points =
        direction == PEER_INVERSE ? peer_hard_places(count) : peer_hard_sphere(c->subject, count);
    size_t room = *count + record->failure_count;
    double *more = (double *)peer_allocate(room, 3 * sizeof more[0]);
    memcpy(more, points, *count * 3 * sizeof more[0]);
    free(points);
    for (size_t i = 0; i < record->failure_count; i++)
    {
        if (record->failures[i].direction == direction)
        {
            memcpy(more + 3 * (*count)++, record->failures[i].input, 3 * sizeof more[0]);
        }
    }
    return more;
}

static int report(const comparison *c, int direction, const peer_claim *claim,
                  const double *const points[2], const size_t count[2], const extreme e[2])
{
    const peer_subject *s = c->subject;
    char who[64];
    char at[128] = "";
    if (e[1].worst > 0.0)
    {
        print_input(at, sizeof at, s, direction, points[1] + 3 * e[1].at);
    }
    peer_row row = {.peer = s->peer,
                    .version = s->version,
                    .mapping = s->mapping,
                    .direction = direction_names[direction],
                    .right = peer_region_words(claim->region),
                    .right_metres = fmax(e[0].within, e[1].within),
                    .random_metres = e[0].worst,
                    .hard_metres = e[1].worst,
                    .refused = e[0].refused + e[1].refused,
                    .tried = (unsigned long)(count[0] + count[1]),
                    .at = at};
    peer_table_row(&row);
    snprintf(who, sizeof who, "%s %s", s->peer, s->mapping);
    int broken = 0;
    for (int hard = 0; hard < 2; hard++)
    {
        print_input(at, sizeof at, s, direction, points[hard] + 3 * e[hard].within_at);
        broken += is_broken(who, direction_names[direction], e[hard].within, claim->nanometres, at);
    }
    return broken;
}

static int compare_direction(const comparison *c, int direction, const peer_record *record)
{
    const peer_claim *claim = &record->claims[direction];
    size_t count[2] = {PEER_RANDOM_POINTS, 0};
    double *random = direction == PEER_INVERSE ? peer_random_places(count[0])
                                               : peer_random_sphere(c->subject, count[0]);
    double *hard = hard_points(c, direction, record, &count[1]);
    const double *const points[2] = {random, hard};
    extreme e[2];
    for (int i = 0; i < 2; i++)
    {
        e[i] = worst_of(c, direction, claim->region, points[i], count[i]);
    }
    int broken = report(c, direction, claim, points, count, e);
    if (direction == PEER_ROUND_TRIP)
    {
        broken += compare_own_round_trip(c, points, count);
    }
    free(random);
    free(hard);
    return broken;
}

int peer_compare(const peer_subject *subject, const peer_record *record)
{
    comparison c = start(subject);
    int broken = 0;
    for (int direction = 0; direction < 3; direction++)
    {
        broken += compare_direction(&c, direction, record);
    }
    finish(&c);
    return broken;
}

/* ------------------------------------------------------------------------------------- failures */

int peer_is_recorded(const char *version, const char *documented_version)
{
#if defined(__x86_64__)
    return strcmp(version, documented_version) == 0;
#else
    (void)version;
    (void)documented_version;
    return 0;
#endif
}

int peer_failure_line(const peer_row *row, const char *documented_version, double documented,
                      double observed, const char *text)
{
    static const double right = 20e-9;
    int as_documented = isinf(documented) || isinf(observed)
                            ? isinf(documented) && isinf(observed)
                            : observed >= documented / 2.0 && observed <= documented * 2.0;
    int wrong = !as_documented && peer_is_recorded(row->version, documented_version);
    printf("failure; %s %s; %s; %s; %s; %s; %s; %s\n", row->peer, row->version, row->mapping,
           row->direction, row->at, length_text(observed),
           as_documented      ? "as documented"
           : observed < right ? "fixed in this version"
                              : "not as documented",
           text);
    if (wrong)
    {
        fflush(stdout);
        fprintf(stderr, "%s %s, %s: documented are %s\n", row->peer, row->version, row->mapping,
                length_text(documented));
    }
    return wrong;
}

/* What the peer is given, what it answers and what is right, in the form that peer_truth.py reads. */
static void print_question(const comparison *c, const peer_failure *f, const answer *a, char *text,
                           size_t size)
{
    const peer_subject *s = c->subject;
    char input[128];
    char place[128];
    char there[128];
    char right[128];
    double truth[3];
    double sphere[3];
    double excess;
    peer_face_place at;
    peer_place right_place;
    print_input(input, sizeof input, s, f->direction, f->input);
    print_place(place, sizeof place, &a->place);
    if (f->direction == PEER_FORWARD)
    {
        double uv[2];
        peer_direction(s, f->input, truth);
        at.face = cm_forward(c->ours, truth, uv);
        at.u = uv[0];
        at.v = uv[1];
        right_place = a->place;
        s->to_plane(s, &at, &right_place);
        print_place(right, sizeof right, &right_place);
        snprintf(text, size, "%s; %s; %s", input, place, right);
        return;
    }
    s->from_plane(s, &a->place, &at);
    if (f->direction == PEER_ROUND_TRIP || !direction_of_place(c->published, &at, truth, &excess))
    {
        peer_direction(s, f->input, truth);
    }
    sphere_of_direction(s, truth, sphere);
    print_input(there, sizeof there, s, PEER_FORWARD, a->sphere);
    print_input(right, sizeof right, s, PEER_FORWARD, sphere);
    snprintf(text, size, "%s; %s, %s; %s", input, place, there, right);
}

int peer_failures(const peer_subject *subject, const peer_record *record)
{
    comparison c = start(subject);
    int wrong = 0;
    for (size_t i = 0; i < record->failure_count; i++)
    {
        const peer_failure *f = &record->failures[i];
        char at[600];
        answer a;
        memset(&a, 0, sizeof a);
        double observed = distance(&c, f->direction, f->input, &a);
        print_question(&c, f, &a, at, sizeof at);
        peer_row row = {.peer = subject->peer,
                        .version = subject->version,
                        .mapping = subject->mapping,
                        .direction = direction_names[f->direction],
                        .right = "",
                        .at = at};
        wrong += peer_failure_line(&row, record->version, f->metres, observed, f->text);
    }
    finish(&c);
    return wrong;
}

/* ----------------------------------------------------------------------- longitude and latitude */

static double to_direction_distance(const peer_lonlat *p, const peer_subject *units,
                                    const double input[3])
{
    double truth[3];
    double found[3];
    peer_direction(units, input, truth);
    p->to_direction(input, found);
    return earth_metres(truth, found);
}

static double to_lonlat_distance(const peer_lonlat *p, const peer_subject *units,
                                 const double input[3])
{
    double found[3];
    double sphere[3] = {0.0, 0.0, 0.0};
    p->to_lonlat(input, sphere);
    peer_direction(units, sphere, found);
    return earth_metres(input, found);
}

static int compare_lonlat_direction(const peer_lonlat *p, int direction, double nanometres)
{
    peer_subject units; /* of the peer's longitudes, and of the points that it is given */
    peer_subject given;
    size_t count[2] = {PEER_RANDOM_POINTS, 0};
    extreme e[2] = {{0.0, 0, 0.0, 0, 0}, {0.0, 0, 0.0, 0, 0}};
    memset(&units, 0, sizeof units);
    units.unit = p->unit;
    given = units;
    given.unit = direction == PEER_FORWARD ? p->unit : 0.0;
    double *points[2];
    points[0] = peer_random_sphere(&given, count[0]);
    points[1] = peer_hard_sphere(&given, &count[1]);
    for (int hard = 0; hard < 2; hard++)
    {
        for (size_t i = 0; i < count[hard]; i++)
        {
            const double *point = points[hard] + 3 * i;
            double metres = direction == PEER_FORWARD ? to_direction_distance(p, &units, point)
                                                      : to_lonlat_distance(p, &units, point);
            note(&e[hard], metres, 1, i);
        }
    }
    char at[128];
    print_input(at, sizeof at, &given, PEER_FORWARD, points[1] + 3 * e[1].at);
    double within = fmax(e[0].within, e[1].within);
    peer_row row = {.peer = p->peer,
                    .version = p->version,
                    .mapping = p->name,
                    .direction = direction_names[direction],
                    .right = "everywhere",
                    .right_metres = within,
                    .random_metres = e[0].worst,
                    .hard_metres = e[1].worst,
                    .refused = e[0].refused + e[1].refused,
                    .tried = (unsigned long)(count[0] + count[1]),
                    .at = at};
    peer_table_row(&row);
    free(points[0]);
    free(points[1]);
    return is_broken(p->peer, p->name, within, nanometres, at);
}

static void own_to_direction(const double lonlat[2], double direction[3])
{
    cm_direction_from_lonlat(lonlat[0], lonlat[1], direction);
}

int peer_compare_lonlat(const peer_lonlat *theirs, double nanometres)
{
    const peer_lonlat ours = {"libcubemap", cm_version(),     "lon, lat",
                              1.0,          own_to_direction, cm_lonlat_from_direction};
    int broken = 0;
    for (int direction = PEER_FORWARD; direction <= PEER_INVERSE; direction++)
    {
        broken += compare_lonlat_direction(theirs, direction, nanometres);
        broken += compare_lonlat_direction(&ours, direction, nanometres);
    }
    return broken;
}
