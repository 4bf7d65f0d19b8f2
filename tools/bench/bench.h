/* SPDX-License-Identifier: MIT
 *
 * cubemap-bench: speed, accuracy and distortion of mappings, measured in one run.
 *
 * A subject is a mapping with its parameters; it has distortion. A way is one of computing it: in double, in
 * float, or in double by the fast tier; by arrays or point by point; it has times and errors.
 */
#ifndef TOOLS_BENCH_BENCH_H
#define TOOLS_BENCH_BENCH_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cubemap/cubemap.h>

#include "bench/harness/columns.h"
#include "bench/harness/harness.h"
#include "bench_command.h"
#include "tools/cli/nearest.h"

enum
{
    PRECISION_DOUBLE,
    PRECISION_FLOAT,
    PRECISION_FAST, /* double, by the fast tier */
    PRECISIONS
};

enum
{
    FORM_ARRAY,
    FORM_SINGLE,
    FORMS
};

enum
{
    QUANTITIES = 6,
    MEASURES = 2,
    PERCENTILES = 5
};

extern const char *const direction_names[DIRECTIONS];     /* "forward", "inverse" */
extern const char *const precision_names[PRECISIONS + 1]; /* "double", "float", "fast", NULL */
extern const char *const form_names[FORMS + 1];           /* "array", "single", NULL */
extern const char *const measure_names[MEASURES];         /* "face", "sphere" */
extern const double percentiles[PERCENTILES];

/* Angles between what should come out and what does, in metres on Earth; NaN if not measured. */
typedef struct errors
{
    double worst_random;
    double rms_random;
    double worst_hard;
    double rms_hard;
} errors;

typedef struct way
{
    size_t subject;
    int precision;
    int form;
    int offered[DIRECTIONS]; /* the fast tier may lack one */
    cm_mapping *mapping;
    double *samples[DIRECTIONS]; /* ns a point, one a repetition */
    size_t calls[DIRECTIONS];    /* that a sample is of */
    timing time[DIRECTIONS];
    errors error[DIRECTIONS];
} way;

typedef struct distortion
{
    cm_statistics of[QUANTITIES][MEASURES];
    double percentile[QUANTITIES][MEASURES][PERCENTILES]; /* NaN if not computed */
    double doubt[QUANTITIES]
                [MEASURES]; /* of the percentiles, the largest: rounded alike they stay in order */
} distortion;

typedef struct length_row
{
    size_t points;
    int precision;
    double ns[DIRECTIONS];
} length_row;

typedef struct subject
{
    char specification[128];
    cm_mapping *mapping;
    distortion distortion;
    size_t length_count;
    length_row *lengths;           /* NULL if not measured */
    double *error_map[DIRECTIONS]; /* pixels x pixels, the first row v = +1; NULL if not measured */
} subject;

typedef struct settings
{
    size_t points;      /* of an array */
    size_t repetitions; /* interleaved */
    size_t random;      /* points for errors */
    size_t hard;
    size_t largest;    /* longest array for the cost against n; 0 for none */
    size_t map_pixels; /* of the map of errors; 0 for none */
    double tolerance;  /* of distortion */
    int one_face;      /* for distortion, where all are alike */
    int percentiles;   /* of it, too? */
    int precision;     /* only this one; -1 for all */
    int form;
    const char *instructions;
    int all_tiers; /* keep mappings without a fast tier among the fast ways: their exact one */
} settings;

typedef struct suite
{
    settings set;
    char date[DATE_SIZE]; /* when the run began */
    double began;         /* the same by the clock */
    size_t subject_count;
    subject *subjects;
    size_t way_count;
    way *ways;
} suite;

/* Adds the mappings that a word names: a specification, or a pattern like "tan*" of identifiers. 0 if there
 * is none or it is no good, which has been said. */
int suite_add(suite *all, const char *word);

/* The same of some words; without any, of the catalogue. */
int suite_add_all(suite *all, int count, char **words);

/* The mappings that can be measured, for tables of options; NULL behind the last. */
const char *subject_name_at(size_t index);

/* All ways of all subjects. 0 if the machine cannot, which has been said. */
int suite_prepare(suite *all);
void suite_close(suite *all);

/* What part of the whole run a stage is, for the bar. */
typedef struct stage
{
    double begin;
    double end;
} stage;

void measure_times(suite *all, stage part);
void measure_lengths(suite *all, stage part);
void measure_errors(suite *all, stage part); /* leaves NaN where this build has no truth */
void measure_distortion(suite *all, stage part);

/* Distortion of one mapping, with percentiles or without. */
void distort(const cm_mapping *mapping, double tolerance, int with_percentiles, distortion *d);

void stage_progress(stage part, size_t done, size_t total, const char *text);

void write_table(FILE *out, const suite *all);
void write_csv(FILE *out, const suite *all);
void write_json(FILE *out, const suite *all);

/* Programs of their own behind the first argument; they return exit statuses. */
int advise(int argc, char **argv, const cm_streams *streams);
int compare_results(int argc, char **argv, const cm_streams *streams);
int papers(int argc, char **argv, const cm_streams *streams);
extern const cm_command advise_command;
extern const cm_command compare_command;
extern const cm_command papers_command;

/* The exit status 2, after a line that says what is wrong. */
int usage(const char *what, const char *text);

/* The same for what the table of options refuses. */
int complain(const cm_option_reader *reader);

/* The same of a name, with that of several that was meant, if there is one. */
int usage_of_name(const char *what, const char *name, const cm_nearest *nearest);

/* Degrees in a radian's unit: what an angle is divided by to be written. */
#define DEGREE (3.14159265358979324 / 180.0)

#endif
