/* SPDX-License-Identifier: MIT
 *
 * Memory is constant: one buffer of input, one batch of lines in it, one buffer of output. A batch
 * ends where the input that has already arrived ends, so that someone who types, or a program that
 * waits for an answer, gets it at once, and a file is worked off in array calls.
 */
#define _POSIX_C_SOURCE 200809L

#include "point_filter.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "degrees.h"
#include "failure.h"
#include "number.h"

enum
{
    LINE_BYTES_MAX = 4096, /* a longer line is an error */
    INPUT_BYTES = 1 << 16,
    OUTPUT_BYTES = 1 << 16,
    RESULT_BYTES_MAX = 3 * NUMBER_WRITE_MAX, /* of one line, besides its rest */
    BATCH_LINES = 1024
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

/* Lines that are worked off together. Point i is in place i of every array, which holds some point
 * that is harmless where line i is no point. Forward: a, b, c are x, y, z and become u, v; inverse:
 * a, b are u, v, and a, b, c become x, y, z. */
struct batch
{
    size_t count;
    uint64_t first_line; /* the number of line[0] */
    struct line line[BATCH_LINES];
    uint8_t face[BATCH_LINES];
    double a[BATCH_LINES];
    double b[BATCH_LINES];
    double c[BATCH_LINES];
    float single_a[BATCH_LINES];
    float single_b[BATCH_LINES];
    float single_c[BATCH_LINES];
};

struct filter
{
    const struct filter_options *options;
    const cm_mapping *mapping;
    const char *name; /* of the input, for messages */
    int descriptor;
    bool any_bad;
    bool skipping; /* inside a line that is too long, up to its end */
    bool at_end;
    size_t input_start; /* input[input_start .. input_end) is still to be worked off */
    size_t input_end;
    size_t output_length;
    struct batch batch;
    char input[INPUT_BYTES];
    char output[OUTPUT_BYTES];
};

/* ------------------------------------------------------------------------------- messages */

/* Say what is wrong with the line that has place index of the batch. */
PRINTF_LIKE(3, 4) static void complain(struct filter *filter, size_t index, const char *format, ...)
{
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    say("%s:%llu: %s", filter->name, (unsigned long long)(filter->batch.first_line + index), text);
    filter->any_bad = true;
}

/* The first bytes of what stands between text and the next separator, fit to be printed. */
typedef struct excerpt
{
    char text[44];
} excerpt;

static bool is_blank(char character)
{
    return character == ' ' || character == '\t';
}

static excerpt quote_word(const char *text, const char *end)
{
    const size_t most = 36;
    excerpt quoted;
    size_t length = 0;
    while (text < end && !is_blank(*text) && *text != ',' && length < most)
    {
        const unsigned char character = (unsigned char)*text++;
        quoted.text[length++] = character < ' ' || character == 127 ? '?' : (char)character;
    }
    const bool cut = text < end && !is_blank(*text) && *text != ',';
    memcpy(quoted.text + length, cut ? "..." : "", cut ? 4 : 1);
    return quoted;
}

/* ------------------------------------------------------------------------------- output */

static void flush_output(struct filter *filter)
{
    size_t written = 0;
    while (written < filter->output_length)
    {
        const ssize_t count =
            write(STDOUT_FILENO, filter->output + written, filter->output_length - written);
        if (count >= 0)
        {
            written += (size_t)count;
        }
        else if (errno == EAGAIN)
        {
            struct pollfd ready = {STDOUT_FILENO, POLLOUT, 0};
            poll(&ready, 1, -1);
        }
        else if (errno != EINTR)
        {
            die(EXIT_FAILURE, "cannot write to standard output: %s", strerror(errno));
        }
    }
    filter->output_length = 0;
}

static void put_bytes(struct filter *filter, const char *text, size_t length)
{
    memcpy(filter->output + filter->output_length, text, length);
    filter->output_length += length;
}

/* A number and, if it is not the first of its line, a blank before it. */
static void put_number(struct filter *filter, double value, bool first)
{
    char *const at = filter->output + filter->output_length;
    *at = ' ';
    filter->output_length +=
        number_write(value, filter->options->digits, at + !first) + (size_t)!first;
}

static void put_result(struct filter *filter, size_t index)
{
    const struct batch *const batch = &filter->batch;
    if (!filter->options->inverse)
    {
        const char face[2] = {(char)('0' + batch->face[index]), ' '};
        put_bytes(filter, face, 2);
        put_number(filter, batch->a[index], true);
        put_number(filter, batch->b[index], false);
    }
    else if (filter->options->xyz)
    {
        put_number(filter, batch->a[index], true);
        put_number(filter, batch->b[index], false);
        put_number(filter, batch->c[index], false);
    }
    else
    {
        const double direction[3] = {batch->a[index], batch->b[index], batch->c[index]};
        double longitude;
        double latitude;
        degrees_from_direction(direction, &longitude, &latitude);
        put_number(filter, longitude, true);
        put_number(filter, latitude, false);
    }
}

static void put_line(struct filter *filter, size_t index)
{
    const struct line *const line = &filter->batch.line[index];
    if (filter->output_length > OUTPUT_BYTES - RESULT_BYTES_MAX - LINE_BYTES_MAX - 2)
    {
        flush_output(filter);
    }
    if (line->kind == LINE_POINT)
    {
        put_result(filter, index);
    }
    else if (line->kind == LINE_BAD)
    {
        const bool three = !filter->options->inverse || filter->options->xyz;
        put_bytes(filter, "nan nan nan", three ? 11 : 7);
    }
    put_bytes(filter, line->rest, line->rest_length);
    put_bytes(filter, line->carriage_return ? "\r\n" : "\n", line->carriage_return ? 2 : 1);
}

/* ------------------------------------------------------------------------------- computing */

/* A direction in float keeps its digits, and stays finite and not zero, if it is first brought to a
 * length near 1; a power of two does that without rounding. */
static void narrow_direction(struct batch *batch, size_t index)
{
    const double largest =
        fmax(fabs(batch->a[index]), fmax(fabs(batch->b[index]), fabs(batch->c[index])));
    int exponent;
    frexp(largest, &exponent);
    batch->single_a[index] = (float)ldexp(batch->a[index], -exponent);
    batch->single_b[index] = (float)ldexp(batch->b[index], -exponent);
    batch->single_c[index] = (float)ldexp(batch->c[index], -exponent);
}

static void compute_single(const cm_mapping *mapping, struct batch *batch, bool inverse)
{
    const size_t count = batch->count;
    float *const a = batch->single_a;
    float *const b = batch->single_b;
    float *const c = batch->single_c;
    for (size_t i = 0; i < count && !inverse; i++)
    {
        narrow_direction(batch, i);
    }
    for (size_t i = 0; i < count && inverse; i++)
    {
        a[i] = (float)batch->a[i];
        b[i] = (float)batch->b[i];
        c[i] = 0;
    }
    if (inverse)
    {
        cm_inverse_array_f32(mapping, count, batch->face, a, b, a, b, c);
    }
    else
    {
        cm_forward_array_f32(mapping, count, a, b, c, batch->face, a, b);
    }
    for (size_t i = 0; i < count; i++)
    {
        batch->a[i] = (double)a[i];
        batch->b[i] = (double)b[i];
        batch->c[i] = (double)c[i];
    }
}

static void compute_double(const cm_mapping *mapping, struct batch *batch, bool inverse)
{
    if (inverse)
    {
        cm_inverse_array(mapping, batch->count, batch->face, batch->a, batch->b, batch->a, batch->b,
                         batch->c);
    }
    else
    {
        cm_forward_array(mapping, batch->count, batch->a, batch->b, batch->c, batch->face, batch->a,
                         batch->b);
    }
}

/* By contract a point that passed our checks has one; if a mapping breaks it, nobody is misled. */
static bool has_result(const struct batch *batch, size_t index)
{
    return batch->face[index] != CM_NO_FACE && !isnan(batch->a[index]) && !isnan(batch->b[index]);
}

/* Work the batch off and empty it. */
static void finish_batch(struct filter *filter)
{
    struct batch *const batch = &filter->batch;
    if (filter->options->single)
    {
        compute_single(filter->mapping, batch, filter->options->inverse);
    }
    else
    {
        compute_double(filter->mapping, batch, filter->options->inverse);
    }
    for (size_t i = 0; i < batch->count; i++)
    {
        if (batch->line[i].kind == LINE_POINT && !has_result(batch, i))
        {
            complain(filter, i, "the mapping gives no result here");
            batch->line[i].kind = LINE_BAD;
        }
        put_line(filter, i);
    }
    batch->first_line += batch->count;
    batch->count = 0;
}

/* ------------------------------------------------------------------------------- parsing */

static const char *skip_blanks(const char *text, const char *end)
{
    while (text < end && is_blank(*text))
    {
        text++;
    }
    return text;
}

static const char *form_of_line(const struct filter_options *options)
{
    return options->inverse ? "FACE U V" : options->xyz ? "X Y Z" : "LON LAT in degrees";
}

/* Read the numbers of a line, apart by blanks or by one comma with or without blanks. Returns what
 * follows them, or NULL after a complaint. */
static const char *read_numbers(struct filter *filter, size_t index, const char *text,
                                const char *end, double value[3])
{
    const int count = filter->options->inverse || filter->options->xyz ? 3 : 2;
    const char *const form = form_of_line(filter->options);
    for (int i = 0; i < count; i++)
    {
        text = skip_blanks(text, end);
        if (i > 0 && text < end && *text == ',')
        {
            text = skip_blanks(text + 1, end);
        }
        if (text == end)
        {
            complain(filter, index, "%d of %d numbers: a line is %s", i, count, form);
            return NULL;
        }
        const char *const next = number_read(text, end, &value[i]);
        if (next == NULL || (next < end && !is_blank(*next) && *next != ','))
        {
            complain(filter, index, "'%s' is not a number: a line is %s",
                     quote_word(text, end).text, form);
            return NULL;
        }
        text = next;
    }
    return text;
}

/* The functions that take the numbers of a line into place index of the batch; false after a
 * complaint. */
static bool take_lonlat(struct filter *filter, size_t index, const double value[3])
{
    double direction[3];
    if (!isfinite(value[0]))
    {
        complain(filter, index, "the longitude, %g, is not finite", value[0]);
        return false;
    }
    if (!(fabs(value[1]) <= 90))
    {
        complain(filter, index, "the latitude, %.17g, is not in [-90, 90]", value[1]);
        return false;
    }
    degrees_to_direction(value[0], value[1], direction);
    filter->batch.a[index] = direction[0];
    filter->batch.b[index] = direction[1];
    filter->batch.c[index] = direction[2];
    return true;
}

static bool take_xyz(struct filter *filter, size_t index, const double value[3])
{
    if (!isfinite(value[0]) || !isfinite(value[1]) || !isfinite(value[2]))
    {
        complain(filter, index, "the direction, %g %g %g, is not finite", value[0], value[1],
                 value[2]);
        return false;
    }
    if (value[0] == 0 && value[1] == 0 && value[2] == 0)
    {
        complain(filter, index, "the direction 0 0 0 has no length");
        return false;
    }
    filter->batch.a[index] = value[0];
    filter->batch.b[index] = value[1];
    filter->batch.c[index] = value[2];
    return true;
}

static bool take_face(struct filter *filter, size_t index, const double value[3])
{
    if (!(value[0] >= 0 && value[0] <= 5) || value[0] != floor(value[0]))
    {
        complain(filter, index, "the face, %.17g, is not a whole number from 0 to 5", value[0]);
        return false;
    }
    for (int i = 1; i <= 2; i++)
    {
        if (!(fabs(value[i]) <= 1 + 1e-9))
        {
            complain(filter, index, "%c, %.17g, is not in [-1, 1]", i == 1 ? 'u' : 'v', value[i]);
            return false;
        }
    }
    filter->batch.face[index] = (uint8_t)value[0];
    filter->batch.a[index] = value[1];
    filter->batch.b[index] = value[2];
    return true;
}

/* What becomes of the line between text and end? Its rest and, if it is a point, the place index of
 * the batch are filled in. */
static line_kind take_line(struct filter *filter, size_t index, const char *text, const char *end)
{
    const struct filter_options *const options = filter->options;
    struct line *const line = &filter->batch.line[index];
    double value[3] = {0, 0, 0};
    bool taken;

    line->rest = text;
    line->rest_length = 0;
    if (memchr(text, '\0', (size_t)(end - text)) != NULL)
    {
        complain(filter, index, "a zero byte: the input is no text");
        return LINE_BAD;
    }
    const char *const word = skip_blanks(text, end);
    if (word == end || *word == '#')
    {
        line->rest_length = (size_t)(end - text);
        return LINE_THROUGH;
    }
    const char *const rest = read_numbers(filter, index, word, end, value);
    if (rest == NULL)
    {
        return LINE_BAD;
    }
    line->rest = rest;
    line->rest_length = (size_t)(end - rest);
    if (options->inverse)
    {
        taken = take_face(filter, index, value);
    }
    else
    {
        taken = options->xyz ? take_xyz(filter, index, value) : take_lonlat(filter, index, value);
    }
    return taken ? LINE_POINT : LINE_BAD;
}

/* Add a line, without its line feed, to the batch. */
static void add_line(struct filter *filter, const char *text, const char *end)
{
    struct batch *const batch = &filter->batch;
    const size_t index = batch->count;
    struct line *const line = &batch->line[index];

    batch->face[index] = 0;
    batch->a[index] = 1;
    batch->b[index] = 0;
    batch->c[index] = 0;
    line->carriage_return = end > text && end[-1] == '\r';
    end -= line->carriage_return;
    if (end - text > LINE_BYTES_MAX)
    {
        line->carriage_return = false; /* its end may not be here yet */
        complain(filter, index, "a line of more than %d bytes", LINE_BYTES_MAX);
        line->kind = LINE_BAD;
        line->rest_length = 0;
        line->rest = text;
    }
    else
    {
        line->kind = take_line(filter, index, text, end);
    }
    if (++batch->count == BATCH_LINES)
    {
        finish_batch(filter);
    }
}

/* ------------------------------------------------------------------------------- input */

/* Take the line that begins at input_start, as far as it is there. False if the rest of it must be
 * read first. */
static bool take_next_line(struct filter *filter)
{
    const char *const text = filter->input + filter->input_start;
    const size_t present = filter->input_end - filter->input_start;
    const char *const line_feed = memchr(text, '\n', present);
    const size_t length = line_feed != NULL ? (size_t)(line_feed - text) : present;
    const bool too_long = length > LINE_BYTES_MAX + 1; /* one for a carriage return */

    if (line_feed == NULL && !too_long && !filter->skipping && !(filter->at_end && present > 0))
    {
        return false;
    }
    if (!filter->skipping)
    {
        add_line(filter, text, text + length);
    }
    /* whatever comes before the next line feed still belongs to this line */
    filter->skipping = line_feed == NULL;
    filter->input_start += length + (size_t)(line_feed != NULL);
    return filter->input_start < filter->input_end;
}

/* Read what there is, after the input that is still to be worked off. */
static void read_input(struct filter *filter)
{
    const size_t present = filter->input_end - filter->input_start;
    memmove(filter->input, filter->input + filter->input_start, present);
    filter->input_start = 0;
    filter->input_end = present;

    struct pollfd ready = {filter->descriptor, POLLIN, 0};
    if (filter->output_length > 0 && poll(&ready, 1, 0) <= 0)
    {
        flush_output(filter);
    }
    const ssize_t count =
        read(filter->descriptor, filter->input + present, sizeof filter->input - present);
    if (count >= 0)
    {
        filter->input_end += (size_t)count;
        filter->at_end = count == 0;
    }
    else if (errno == EAGAIN)
    {
        poll(&ready, 1, -1);
    }
    else if (errno != EINTR)
    {
        /* strerror's text must survive the flush */
        const int reason = errno;
        flush_output(filter);
        die(EXIT_FAILURE, "cannot read %s: %s", filter->name, strerror(reason));
    }
}

bool filter_points(const struct filter_options *options, const cm_mapping *mapping, int descriptor,
                   const char *name)
{
    struct filter *const filter = calloc(1, sizeof *filter);
    if (filter == NULL)
    {
        die(EXIT_FAILURE, "no memory");
    }
    filter->options = options;
    filter->mapping = mapping;
    filter->name = name;
    filter->descriptor = descriptor;
    filter->batch.first_line = 1;
    while (!filter->at_end)
    {
        read_input(filter);
        while (take_next_line(filter))
        {
        }
        /* the lines of a batch are in the buffer, which the next reading moves */
        finish_batch(filter);
    }
    flush_output(filter);
    const bool all_good = !filter->any_bad;
    free(filter);
    return all_good;
}
