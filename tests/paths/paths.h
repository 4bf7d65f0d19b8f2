/* SPDX-License-Identifier: MIT
 *
 * What the files of check-paths share. Every fast path is compared with the scalar reference and then
 * timed on the same data:
 *
 *   a path      a function of the library from columns of numbers to columns of numbers, in one
 *               precision; one entry of the tables in path_calls.inc, with all forms that it has (arrays,
 *               single points, strides, threads), which must give the same bits
 *   a subject   a mapping in a frame and a tier of accuracy, made twice: scalar, and with the
 *               instruction set under test
 *
 * A new family of functions is one more entry of the table: the letters of its columns, its callers,
 * and the judge of its results. path_compare.c, path_shapes.c and path_speed.c know nothing else of it.
 */
#ifndef TESTS_PATHS_H
#define TESTS_PATHS_H

#include <cubemap/cubemap.h>
#include <cubemap/options.h>
#include <cubemap/threads.h>

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum
{
    COLUMNS_MAX = 6,
    FORMS_MAX = 10
};

typedef struct precision
{
    const char *name;
    int narrow; /* float */
    double eps;
    double least; /* where relative bounds begin */
} precision;

/* The kinds of points that a path takes (path_inputs.c); each has three columns at most. */
typedef enum input_kind
{
    DIRECTIONS, /* x y z */
    POINTS,     /* face u v */
    PLANE       /* p q, or u v, of the warp alone */
} input_kind;

enum
{
    INPUT_KINDS = PLANE + 1
};

/* The letters of columns: b for bytes, r for reals of the precision, w for words of 64 bits. A value of
 * b and w is a word, one of r is real whatever the precision. */
typedef union number
{
    double real;
    uint64_t word;
} number;

/* ---- Subjects (path_subjects.c) ---- */

typedef struct subject
{
    const char *specification;
    const cm_frame *frame;
    cm_tier tier;
    int standard;          /* are all parameters the standard ones? */
    double widening;       /* of the bounds, if they are not */
    cm_mapping *reference; /* scalar */
    cm_mapping *tested;
} subject;

size_t subject_count(void);

/* 1 if it was made, 0 if this machine or build has no such instruction set. Everything else that goes
 * wrong ends the program. To be given to drop_subject. */
int make_subject(subject *made, size_t index, cm_tier tier, const char *set);
void drop_subject(const subject *made);

/* How far two paths may be apart, both of which err, in eps: absolute, and of a number's own size. */
double forward_bound(const subject *s);
double inverse_bound(const subject *s);
double relative_bound(const subject *s);
double jacobian_bound(const subject *s);

/* Is there where derivatives have no bound: at a pole or corner of one face, or at an edge where the warp has no slope? */
int is_steep(const subject *s);

/* Radians, between what two results of forward stand for. */
double angle_bound(const subject *s, const precision *in);

/* ---- Paths (path_calls.inc, path_judges.c) ---- */

/* All calls have one signature: columns as pointers. argument is the stride or the number of threads.
 * Returns what went wrong besides the results, or NULL. */
typedef const char *(*caller)(const cm_mapping *mapping, size_t n, void *const *in,
                              void *const *out, int argument);

typedef struct form
{
    const char *name;
    caller call;
    int argument;
    size_t most; /* the largest n to be tried */
    int inexact; /* may that flag be raised? */
} form;

typedef struct path path;

/* One point of two results. */
typedef struct comparison
{
    const subject *subject;
    const precision *in;
    const path *path;
    number input[COLUMNS_MAX];
    number expected[COLUMNS_MAX];
    number got[COLUMNS_MAX];
} comparison;

/* What is wrong with a point, or NULL; error is the largest difference in the judge's own measure. */
typedef const char *(*judge)(const comparison *c, double *error);

const char *judge_map(const comparison *c, double *error);
const char *judge_direction(const comparison *c, double *error);
const char *judge_warped(const comparison *c, double *error);
const char *judge_unwarped(const comparison *c, double *error);
const char *judge_jacobian(const comparison *c, double *error);
const char *judge_distortion(const comparison *c, double *error);

int has_warp(const cm_mapping *mapping);

struct path
{
    const char *name;
    input_kind kind;
    const char *inputs; /* letters */
    const char *outputs;
    const char *measure; /* of judge's error */
    judge judge;
    int (*applies)(const cm_mapping *mapping); /* NULL: to all */
    unsigned fast; /* CM_FAST_FORWARD or _INVERSE: where there is a fast tier of it */
    int in_place;  /* may outputs be inputs? */
    int timed;
    form forms[FORMS_MAX]; /* ends with one that has no name; the first is the path itself */
};

#define PATHS_MAX 16

typedef struct path_table
{
    precision in;
    path paths[PATHS_MAX]; /* ends with one that has no name */
} path_table;

extern const path_table paths_double;
extern const path_table paths_float;

/* What is to be compared of a path: whether the mapping has it, and in the fast tier, whether that is
 * another path than the exact one. in is the table's precision; judged, that which results are held to,
 * which is float's in the fast tier. */
int is_path_of(const subject *s, const precision *in, const path *p, precision *judged);

/* Whether the subject has the path, exact in a mapping of the fast tier: its loops take longer rests there. */
int is_exact_in_fast(const subject *s, const precision *in, const path *p);

/* ---- Columns ---- */

static inline size_t element_size(char letter, const precision *in)
{
    return letter == 'b' ? 1 : letter == 'r' && in->narrow ? sizeof(float) : 8;
}

static inline number get_value(char letter, const precision *in, const void *column, size_t i)
{
    number v = {.word = 0};
    if (letter == 'b')
    {
        v.word = ((const uint8_t *)column)[i];
    }
    else if (letter == 'w')
    {
        v.word = ((const uint64_t *)column)[i];
    }
    else
    {
        v.real = in->narrow ? (double)((const float *)column)[i] : ((const double *)column)[i];
    }
    return v;
}

static inline void put_value(char letter, const precision *in, void *column, size_t i, number v)
{
    if (letter == 'b')
    {
        ((uint8_t *)column)[i] = (uint8_t)v.word;
    }
    else if (letter == 'w')
    {
        ((uint64_t *)column)[i] = v.word;
    }
    else if (in->narrow)
    {
        ((float *)column)[i] = (float)v.real;
    }
    else
    {
        ((double *)column)[i] = v.real;
    }
}

static inline void *need(void *memory)
{
    if (memory == NULL)
    {
        fprintf(stderr, "check-paths: no memory\n");
        exit(2);
    }
    return memory;
}

/* ---- Points to try (path_inputs.c) ---- */

/* one_in: of the hard points, one in so many. */
size_t input_count(input_kind kind, size_t one_in);
void input_at(input_kind kind, const precision *in, size_t one_in, size_t index, number *point);

/* A random point, the same for the same index; if not an ordinary one, then with a coordinate near 0 or an
 * edge now and then. Powers of the smallest underflow in float, which takes processors long. */
void random_input(input_kind kind, uint64_t index, int ordinary, number *point);

/* ---- The checks ---- */

enum
{
    COMPLAINTS_WRITTEN = 40
};

/* A line on what is wrong; counts it, and after some writes no more (path_compare.c). */
__attribute__((format(printf, 4, 5))) void complain(const subject *s, const precision *in,
                                                    const path *p, const char *format, ...);
size_t complaint_count(void);

/* The worst difference of a path and precision over all subjects. */
typedef struct extreme
{
    double error;
    size_t points;
    char where[256];
} extreme;

/* What is right (path_compare.c): the first form of the path by the scalar set; in the fast tier, that of float
 * from the same numbers in float. */
void call_reference(const subject *s, const path *p, size_t n, void *const *in, void *const *out);

/* Tested against reference at all inputs (path_compare.c). */
void compare_inputs(const subject *s, const precision *in, const path *p, size_t one_in,
                    extreme *worst);

/* Tested against reference at points that are there. */
void compare_points(const subject *s, const precision *in, const path *p, size_t n,
                    void *const *input, extreme *worst);

/* Every length, misalignment, overlap and form gives the same bits and writes nothing else (path_shapes.c). Without
 * all_shapes each length has one misalignment, and no call has so many points that threads share them. */
void check_shapes(const subject *s, const precision *in, const path *p, int all_shapes);

/* The table of times of one path (path_speed.c), for the subjects that are chosen. */
typedef int (*choice)(const subject *s);
void time_path(const path_table *const tables[2], size_t which, const char *set, choice chosen);

#endif
