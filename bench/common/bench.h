/* SPDX-License-Identifier: MIT
 *
 * What the programs that measure share: the machine, the clock, samples, progress, and files of results.
 */
#ifndef BENCH_COMMON_BENCH_H
#define BENCH_COMMON_BENCH_H

#include <stddef.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Of the program, for messages; every program defines it. */
extern const char program_name[];

/* What the figures are of; texts are static. */
const char *system_cpu(void);
const char *system_name(void);
const char *system_compiler(void);
const char *system_flags(void);
double system_free_memory(void); /* bytes; 0 if unknown */

double seconds(void);

/* Nanoseconds a point. */
typedef struct timing
{
    double best;
    double lower_quartile;
    double median;
    double upper_quartile;
} timing;

timing summary(const double *samples, size_t count);

/* Half the distance of the quartiles, in per cent of the median. */
double spread(const timing *t);

/* A line that the next one overwrites, on stderr if that is a terminal. NULL clears it. */
void progress(const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 1, 2)))
#endif
    ;

/* Such a line with a bar before the text; done of total. */
void progress_bar(double done, double total, const char *text);

/* Zeroed memory, or the end of the program. */
void *allocate(size_t count, size_t size);

/* A length in the unit that people read, "0.12 m"; INFINITY is "refused". The text is valid until the fourth
 * call after. */
const char *length_text(double metres);

/* "key": "text" and "key": number (null if it is not finite), each followed by a comma and a blank. */
void json_text(FILE *out, const char *key, const char *text);
void json_number(FILE *out, const char *key, double value);

/* A file of results that is there from the beginning, so that one that cannot be written is known before
 * the long run, and that gets its name at the end. - is standard output, NULL none. */
typedef struct output
{
    const char *name;
    char part[1024];
    FILE *file;
} output;

/* 0 if it cannot be done, which has been said. */
int output_open(output *o, const char *name);
int output_close(output *o);
void output_drop(output *o);

#ifdef __cplusplus
}
#endif

#endif
