/* SPDX-License-Identifier: MIT
 *
 * Speed beside accuracy, this library beside others: what the parts of the program share.
 *
 * A contestant is a way to map points to faces and back: a mapping of this library by one of its
 * paths, or another library's (a peer's) function for the same mapping. All are fed the same points,
 * each in the form that it takes, and the same two functions of a contestant are timed (timing.c) and
 * held against the truth (accuracy.c), so that a time and an error always belong to the same code.
 */
#ifndef BENCH_SIDE_BY_SIDE_H
#define BENCH_SIDE_BY_SIDE_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cubemap/cubemap.h>

#include "bench/harness/columns.h"
#include "bench/harness/harness.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct contestant
{
    const char *library;
    const char *version;
    const char *group;         /* the mapping of this library that it is compared with */
    const char *specification; /* the mapping itself, in its library's terms */
    const char *name;          /* the function, or the way of calling it */
    const char *path;          /* the instruction set of this library's paths, else "" */
    const char *tier;          /* the same */
    const char *note;          /* what one should know for a fair reading, or "" */
    int own;                   /* is it this library? */
    unsigned absent;           /* bits of directions that the tier does not have */
    int narrow;                /* in float? */
    int array;    /* this library's arrays of directions: what ratios and scaling are of */
    int by_face;  /* does it need the points sorted by face? Sorting is not timed */
    int in_place; /* does it overwrite its input? Copying it before is not timed */
    int pixels;   /* does it give pixels for places? */
    double unit;  /* radians in its longitude and latitude; 0 if it takes vectors */
    void (*forward)(const struct contestant *contestant, batch *points);
    void (*inverse)(const struct contestant *contestant, batch *points);
    void (*close)(struct contestant *contestant);
    void *handle; /* its own */

    double *samples[DIRECTIONS]; /* ns a point, one a repetition */
    timing time[DIRECTIONS];
    double ratio[DIRECTIONS]; /* to this library's fastest exact double path for the group */
    double worst_random;      /* of round trips, in metres on Earth */
    double worst_hard;
    unsigned long refused;
    unsigned long tried;
} contestant;

typedef struct roster
{
    const char *const *groups; /* the mappings that are asked for */
    size_t group_count;
    size_t count;
    contestant *list;
} roster;

int roster_wants(const roster *all, const char *group);
void roster_add(roster *all, const contestant *entrant);
/* Bring those of a group together, which are then timed one after the other. */
void roster_sort(roster *all);
void roster_close(roster *all);

/* "double, avx2", "WCSLIB TSC" */
void contestant_label(const contestant *c, char *text, size_t size);
/* "vectors", "lon, lat in degrees" */
const char *contestant_takes(const contestant *c);

/* The contestants. 0 if something that must work does not, which they have said. */
int add_own(roster *all);
int add_kernels(roster *all);
int add_wcslib(roster *all);
int add_proj(roster *all);
int add_chealpix(roster *all);
int add_s2(roster *all);
int add_geographiclib(roster *all);

/* Points of a list of three numbers each into a batch, in the form and order that the contestant takes. */
void batch_load(batch *b, const contestant *c, const double *points, size_t count);

/* Points in the contestant's form, to be freed: random ones, the same for all as far as their units
 * allow, and hard ones, of which every step-th. */
double *random_points(const contestant *c, size_t count);
double *hard_points(const contestant *c, size_t step, size_t *count);

/* One run over a batch, in this direction; the inverse is of what forward has left in it. */
void contestant_ready(const contestant *c, batch *b, int direction);
void contestant_run(const contestant *c, batch *b, int direction);

/* Fills in the times of all, in interleaved repetitions. */
void time_all(roster *all, size_t points, size_t repetitions);

/* Runs each once between the marks that callgrind counts from and to. 0 if built without them. */
int count_all(roster *all, size_t points);

/* Fills in the worst errors of all. */
void measure_accuracy(roster *all, size_t random_count, size_t hard_step);

/* The best time of an array of n points. */
typedef struct scaling_row
{
    const contestant *who;
    size_t points;
    double best[DIRECTIONS]; /* ns a point */
} scaling_row;

typedef struct scaling
{
    size_t count;
    scaling_row *rows;
} scaling;

/* Times from 1 point up to largest, as far as memory goes. */
void measure_scaling(const roster *all, size_t largest, size_t repetitions, scaling *result);

typedef struct settings
{
    size_t points;
    size_t repetitions;
    size_t random_count;
    size_t hard_step;
    char date[DATE_SIZE]; /* when the run began */
} settings;

void print_table(FILE *out, const roster *all, const settings *set);
void print_scaling(FILE *out, const scaling *rows);
void print_csv(FILE *out, const roster *all);
void print_json(FILE *out, const roster *all, const settings *set, const scaling *rows);

#ifdef __cplusplus
}
#endif

#endif
