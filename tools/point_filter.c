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

/* What the numbers of a line are. */
typedef enum form
{
    FORM_LONLAT,
    FORM_XYZ,
    FORM_FACE,
    FORM_DISC,
    FORM_SQUARE
} form;

static const struct
{
    const char *text;
    int count; /* of numbers */
} forms[] = {[FORM_LONLAT] = {"LON LAT in degrees", 2},
             [FORM_XYZ] = {"X Y Z", 3},
             [FORM_FACE] = {"FACE U V", 3},
             [FORM_DISC] = {"U V", 2},
             [FORM_SQUARE] = {"X Y", 2}};

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
 * a, b are u, v, and a, b, c become x, y, z. Between disc and square a, b stay in the plane. */
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
    form from;
    form to;
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

static void put_lonlat(struct filter *filter, size_t index)
{
    const struct batch *const batch = &filter->batch;
    const double direction[3] = {batch->a[index], batch->b[index], batch->c[index]};
    double longitude;
    double latitude;
    degrees_from_direction(direction, &longitude, &latitude);
    put_number(filter, longitude, true);
    put_number(filter, latitude, false);
}

static void put_result(struct filter *filter, size_t index)
{
    const struct batch *const batch = &filter->batch;
    if (filter->to == FORM_LONLAT)
    {
        put_lonlat(filter, index);
        return;
    }
    if (filter->to == FORM_FACE)
    {
        const char face[2] = {(char)('0' + batch->face[index]), ' '};
        put_bytes(filter, face, 2);
    }
    put_number(filter, batch->a[index], true);
    put_number(filter, batch->b[index], false);
    if (filter->to == FORM_XYZ)
    {
        put_number(filter, batch->c[index], false);
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
        put_bytes(filter, "nan nan nan", forms[filter->to].count == 3 ? 11 : 7);
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

/* The batch's numbers in float. */
static void narrow_batch(struct batch *batch, bool directions)
{
    for (size_t i = 0; i < batch->count; i++)
    {
        if (directions)
        {
            narrow_direction(batch, i);
        }
        else
        {
            batch->single_a[i] = (float)batch->a[i];
            batch->single_b[i] = (float)batch->b[i];
            batch->single_c[i] = 0;
        }
    }
}

static void widen_batch(struct batch *batch)
{
    for (size_t i = 0; i < batch->count; i++)
    {
        batch->a[i] = (double)batch->single_a[i];
        batch->b[i] = (double)batch->single_b[i];
        batch->c[i] = (double)batch->single_c[i];
    }
}

static void compute_single(const cm_mapping *mapping, struct batch *batch, bool inverse)
{
    const size_t n = batch->count;
    float *const a = batch->single_a;
    float *const b = batch->single_b;
    float *const c = batch->single_c;
    if (cm_mapping_describe(mapping)->kind == CM_KIND_DISC_SQUARE)
    {
        (inverse ? cm_unwarp_array_f32 : cm_warp_array_f32)(mapping, n, a, b, a, b);
    }
    else if (inverse)
    {
        cm_inverse_array_f32(mapping, n, batch->face, a, b, a, b, c);
    }
    else
    {
        cm_forward_array_f32(mapping, n, a, b, c, batch->face, a, b);
    }
}

static void compute_double(const cm_mapping *mapping, struct batch *batch, bool inverse)
{
    const size_t n = batch->count;
    double *const a = batch->a;
    double *const b = batch->b;
    double *const c = batch->c;
    if (cm_mapping_describe(mapping)->kind == CM_KIND_DISC_SQUARE)
    {
        (inverse ? cm_unwarp_array : cm_warp_array)(mapping, n, a, b, a, b);
    }
    else if (inverse)
    {
        cm_inverse_array(mapping, n, batch->face, a, b, a, b, c);
    }
    else
    {
        cm_forward_array(mapping, n, a, b, c, batch->face, a, b);
    }
}

static void compute(struct filter *filter)
{
    struct batch *const batch = &filter->batch;
    const bool inverse = filter->options->inverse;
    if (filter->options->single)
    {
        narrow_batch(batch, filter->from == FORM_LONLAT || filter->from == FORM_XYZ);
        compute_single(filter->mapping, batch, inverse);
        widen_batch(batch);
    }
    else
    {
        compute_double(filter->mapping, batch, inverse);
    }
}

/* By contract a point that passed our checks has one; if a mapping breaks it, nobody is misled. */
static bool has_result(const struct batch *batch, size_t index)
{
    return batch->face[index] != CM_NO_FACE && !isnan(batch->a[index]) && !isnan(batch->b[index]);
}

static double parameter_called(const cm_mapping *mapping, const char *name)
{
    const cm_mapping_info *const info = cm_mapping_describe(mapping);
    size_t index = 0;
    while (index < info->parameter_count && strcmp(info->parameter[index].name, name) != 0)
    {
        index++;
    }
    return cm_mapping_parameter(mapping, index);
}

/* Of a point that is one, but not on the map. */
static void complain_of_result(struct filter *filter, size_t index)
{
    if (filter->to == FORM_DISC && cm_mapping_describe(filter->mapping)->kind == CM_KIND_AZIMUTHAL)
    {
        complain(filter, index, "the direction is not in the field of view of %g degrees",
                 parameter_called(filter->mapping, "full") == 1
                     ? 360
                     : parameter_called(filter->mapping, "fov"));
    }
    else
    {
        complain(filter, index, "the mapping gives no result here");
    }
}

/* Work the batch off and empty it. */
static void finish_batch(struct filter *filter)
{
    struct batch *const batch = &filter->batch;
    compute(filter);
    for (size_t i = 0; i < batch->count; i++)
    {
        if (batch->line[i].kind == LINE_POINT && !has_result(batch, i))
        {
            complain_of_result(filter, i);
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

/* Read the numbers of a line, apart by blanks or by one comma with or without blanks. Returns what
 * follows them, or NULL after a complaint. */
static const char *read_numbers(struct filter *filter, size_t index, const char *text,
                                const char *end, double value[3])
{
    const int count = forms[filter->from].count;
    const char *const wanted = forms[filter->from].text;
    for (int i = 0; i < count; i++)
    {
        text = skip_blanks(text, end);
        if (i > 0 && text < end && *text == ',')
        {
            text = skip_blanks(text + 1, end);
        }
        if (text == end)
        {
            complain(filter, index, "%d of %d numbers: a line is %s", i, count, wanted);
            return NULL;
        }
        const char *const next = number_read(text, end, &value[i]);
        if (next == NULL || (next < end && !is_blank(*next) && *next != ','))
        {
            complain(filter, index, "'%s' is not a number: a line is %s",
                     quote_word(text, end).text, wanted);
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

/* Two coordinates, whose names are the letters of a text of two. */
static bool take_square(struct filter *filter, size_t index, const double value[2],
                        const char *names)
{
    for (int i = 0; i < 2; i++)
    {
        if (!(fabs(value[i]) <= 1 + 1e-9))
        {
            complain(filter, index, "%c, %.17g, is not in [-1, 1]", names[i], value[i]);
            return false;
        }
    }
    filter->batch.a[index] = value[0];
    filter->batch.b[index] = value[1];
    return true;
}

/* What is written in float may be outside by its rounding. */
static bool take_disc(struct filter *filter, size_t index, const double value[2])
{
    const double tolerance = filter->options->single ? 1e-6 : 1e-9;
    if (!(hypot(value[0], value[1]) <= 1 + tolerance))
    {
        complain(filter, index, "the point %.17g %.17g is outside the disc", value[0], value[1]);
        return false;
    }
    filter->batch.a[index] = value[0];
    filter->batch.b[index] = value[1];
    return true;
}

static bool take_face(struct filter *filter, size_t index, const double value[3])
{
    if (!(value[0] >= 0 && value[0] <= 5) || value[0] != floor(value[0]))
    {
        complain(filter, index, "the face, %.17g, is not a whole number from 0 to 5", value[0]);
        return false;
    }
    filter->batch.face[index] = (uint8_t)value[0];
    return take_square(filter, index, value + 1, "uv");
}

static bool take_point(struct filter *filter, size_t index, const double value[3])
{
    switch (filter->from)
    {
    case FORM_LONLAT:
        return take_lonlat(filter, index, value);
    case FORM_XYZ:
        return take_xyz(filter, index, value);
    case FORM_FACE:
        return take_face(filter, index, value);
    case FORM_DISC:
        return take_disc(filter, index, value);
    case FORM_SQUARE:
        return take_square(filter, index, value, "xy");
    }
    return false;
}

/* What becomes of the line between text and end? Its rest and, if it is a point, the place index of
 * the batch are filled in. */
static line_kind take_line(struct filter *filter, size_t index, const char *text, const char *end)
{
    struct line *const line = &filter->batch.line[index];
    double value[3] = {0, 0, 0};

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
    return take_point(filter, index, value) ? LINE_POINT : LINE_BAD;
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

/* What is read and what is written, by the kind of the mapping. */
static void choose_forms(struct filter *filter)
{
    const form sphere = filter->options->xyz ? FORM_XYZ : FORM_LONLAT;
    form from = sphere;
    form to = FORM_FACE;
    switch (cm_mapping_describe(filter->mapping)->kind)
    {
    case CM_KIND_CUBE:
        break;
    case CM_KIND_DISC_SQUARE:
        from = FORM_DISC;
        to = FORM_SQUARE;
        break;
    case CM_KIND_AZIMUTHAL:
        to = FORM_DISC;
        break;
    case CM_KIND_LAYOUT:
        to = FORM_SQUARE;
        break;
    }
    filter->from = filter->options->inverse ? to : from;
    filter->to = filter->options->inverse ? from : to;
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
    choose_forms(filter);
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
