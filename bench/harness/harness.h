/* SPDX-License-Identifier: MIT
 *
 * What the programs that measure share: the machine, the clock, samples, progress, and files of results.
 */
#ifndef BENCH_HARNESS_HARNESS_H
#define BENCH_HARNESS_HARNESS_H

#include <setjmp.h>
#include <stddef.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The name of the program, for messages: every program says it first of all. The text must stay. */
void name_program(const char *name);
const char *program_name(void);

/* The number that a word is, and NAN if it is none. */
double number_of(const char *word);

/* A program that is a function says where its results and its messages go, instead of to stdout and stderr, and where
 * it goes on when there is no memory, instead of ending. All NULL: as at the beginning. */
void harness_begin(FILE *out, FILE *err, jmp_buf *end);
FILE *harness_out(void);
FILE *harness_err(void);

/* The end of the work, after something has been said. */
#if defined(__GNUC__)
__attribute__((noreturn))
#endif
void harness_end(void);

/* What the figures are of; texts are static. */
const char *system_cpu(void);
const char *system_name(void);
const char *system_compiler(void);
const char *system_flags(void);
const char *system_commit(
    void); /* what git calls the sources, "-dirty" if they were changed; "unknown" without git */
double system_free_memory(void); /* bytes; 0 if unknown */

double seconds(void);
/* Of this process, which others do not make longer by their waiting. */
double processor_seconds(void);

enum
{
    DATE_SIZE = 24
};

/* ISO 8601, the date and time now, UTC. */
void date_now(char text[DATE_SIZE]);

/* What the clock can tell apart, in seconds: its tick, or the time of reading it where that is longer. Measured once. */
double clock_tick(void);

/* So many calls took so many seconds: as many again if that is a thousand ticks or more, else how many should be tried
 * next. */
size_t calls_for_sample(size_t calls, double took);

/* The seconds that so many calls of something take. */
typedef double (*calls_timer)(void *user, size_t calls);

/* How many calls a sample is of, so that it is a thousand ticks long. Of each number the least of three times counts: what
 * interrupts one, or the first call's pages, would otherwise pass for work. */
size_t calls_a_sample(calls_timer timer, void *user);

/* Increasing, to be freed. */
double *sorted_copy(const double *samples, size_t count);

/* Of one or more; of an even count the mean of the two in the middle. */
double sorted_median(const double *sorted, size_t count);

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

/* A line that the next one overwrites, where messages go if that is a terminal. NULL clears it. */
void progress(const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 1, 2)))
#endif
    ;

/* Such a line with a bar before the text; done of total. */
void progress_bar(double done, double total, const char *text);

/* Zeroed memory, or the end of the program. */
void *allocate(size_t count, size_t size);

/* A list of count elements, NULL if there is none, made long enough for one more, or the end of the program. */
void *grow(void *list, size_t count, size_t size);

/* "key": "text" and "key": number (null if it is not finite), each followed by a comma and a blank. */
void json_text(FILE *out, const char *key, const char *text);
void json_number(FILE *out, const char *key, double value);

/* The machine, system, compiler and flags, as four of those. */
void json_machine(FILE *out);

/* The date, the commit, and the clock's tick in nanoseconds, as three of those. */
void json_run(FILE *out, const char *date);

/* "key": [numbers], followed by a comma and a blank. */
void json_numbers(FILE *out, const char *key, const double *values, size_t count);

#define OUTPUT_NAME_MAX 4200

/* A file of results, written beside the target and given its name at the end; what is no regular file is
 * written as it is. - is standard output, NULL none. Two at most may be open at a time: those are removed
 * when a signal ends the program. */
typedef struct output
{
    const char *name;
    char target[OUTPUT_NAME_MAX];
    char part[OUTPUT_NAME_MAX];
    FILE *file;
} output;

/* 0 if it cannot be done, which has been said. */
int output_open(output *o, const char *name);
int output_close(output *o);
void output_drop(output *o);

/* What is left of all of them goes, after harness_end. */
void outputs_abandon(void);

/* Are they two files, as far as one can tell before they are there? NULL is none. */
int outputs_differ(const char *a, const char *b);

/* 0, or 1 after it has said what is wrong: the exit status. */
int close_standard_output(void);

#ifdef __cplusplus
}
#endif

#endif
