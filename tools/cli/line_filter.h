/* SPDX-License-Identifier: MIT
 *
 * What the filters have in common: lines of numbers are read, worked off in batches, and written with
 * what follows the numbers, in constant memory. What the numbers are and what is made of them is the
 * business of whoever runs a filter, told by struct line_work.
 */
#ifndef CUBEMAP_TOOLS_LINE_FILTER_H
#define CUBEMAP_TOOLS_LINE_FILTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "failure.h"

enum
{
    LINE_BYTES_MAX = 4096, /* a longer line is an error */
    LINE_NUMBERS_MAX = 3,
    RESULT_BYTES_MAX = 256, /* of one line, besides its rest */
    INPUT_BYTES = 1 << 16,
    OUTPUT_BYTES = 1 << 16,
    BATCH_LINES = 1024
};

/* The work on the points of a batch. Each has a place in it, an index below BATCH_LINES; user is what
 * line_filter_run was given. */
struct line_work
{
    /* Whatever is in that place, let it be harmless: its line may be no point. */
    void (*clear)(void *user, size_t index);
    /* Take the numbers of a line; false after a complaint. */
    bool (*take)(void *user, size_t index, const double value[LINE_NUMBERS_MAX]);
    /* Instead of take, where a line begins with one word: take that, which is not empty. */
    bool (*take_word)(void *user, size_t index, const char *word, size_t length);
    /* Compute the first count places. */
    void (*compute)(void *user, size_t count);
    /* Has the point a result? false after a complaint. */
    bool (*check)(void *user, size_t index);
    /* Write the result, RESULT_BYTES_MAX at most. */
    void (*put)(void *user, size_t index);
};

/* What becomes of a line. */
typedef enum line_kind
{
    LINE_THROUGH, /* a comment or a blank line: rest is all of it */
    LINE_POINT,   /* rest is what follows its numbers */
    LINE_BAD      /* it has no result; rest as for a point, or empty */
} line_kind;

struct line
{
    line_kind kind;
    const char *rest;
    size_t rest_length;
    bool carriage_return; /* does it end with CR LF? */
};

/* To be filled with zeros but for the first members. */
struct line_filter
{
    const struct line_work *work;
    void *user;
    const char *name; /* of the input, for messages */
    FILE *in; /* by whose descriptor it reads, if it has one: nothing may be in its buffer */
    FILE *out;
    FILE *err;
    cm_failure *failure; /* where reading or writing fails */
    int digits;          /* significant ones to write, 1 to 17 */
    int count;           /* of the numbers of a line, LINE_NUMBERS_MAX at most */
    const char *wanted;  /* what they are, for messages */
    const char *bad;     /* what stands for the result of a line that has none */
    /* the filter's own */
    bool any_bad;
    bool skipping; /* inside a line that is too long, up to its end */
    bool at_end;
    size_t input_start; /* input[input_start .. input_end) is still to be worked off */
    size_t input_end;
    size_t output_length;
    uint64_t first_line; /* the number of line[0] */
    size_t lines;        /* in the batch */
    struct line line[BATCH_LINES];
    char input[INPUT_BYTES];
    char output[OUTPUT_BYTES];
};

/* Read the input to its end and write the results. What is wrong with a line is told at once, with the
 * input's name; false if any was wrong, or input or output failed. */
bool line_filter_run(struct line_filter *filter);

/* Say what is wrong with the line that has place index of the batch. */
PRINTF_LIKE(3, 4)
void line_complain(struct line_filter *filter, size_t index, const char *format, ...);

/* For put: bytes; and a number and, if it is not the first of its line, a blank before it. */
void line_put_bytes(struct line_filter *filter, const char *text, size_t length);
void line_put_number(struct line_filter *filter, double value, bool first);

#endif
