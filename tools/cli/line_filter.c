/* SPDX-License-Identifier: MIT
 *
 * Memory is constant: one buffer of input, one batch of lines in it, one buffer of output. A batch
 * ends where the input that has already arrived ends, so that someone who types, or a program that
 * waits for an answer, gets it at once, and a file is worked off in array calls.
 */
#include "line_filter.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cubemap/number.h>

#include "descriptor.h"
#include "number_word.h"

/* ------------------------------------------------------------------------------- messages */

void line_complain(struct line_filter *filter, size_t index, const char *format, ...)
{
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    say(filter->err, "%s:%llu: %s", filter->name, (unsigned long long)(filter->first_line + index),
        text);
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

/* Written by its descriptor a stream that does not wait is waited for; what has none is memory. */
static void flush_output(struct line_filter *filter)
{
    const int descriptor = descriptor_of(filter->out);
    size_t written = 0;
    if (descriptor < 0)
    {
        fwrite(filter->output, 1, filter->output_length, filter->out);
        written = filter->output_length;
    }
    while (written < filter->output_length && filter->failure->status == 0)
    {
        const ptrdiff_t count =
            descriptor_write(descriptor, filter->output + written, filter->output_length - written);
        if (count >= 0)
        {
            written += (size_t)count;
        }
        else
        {
            fail(filter->failure, EXIT_FAILURE, "cannot write to standard output: %s",
                 strerror(errno));
        }
    }
    filter->output_length = 0;
}

void line_put_bytes(struct line_filter *filter, const char *text, size_t length)
{
    memcpy(filter->output + filter->output_length, text, length);
    filter->output_length += length;
}

void line_put_number(struct line_filter *filter, double value, bool first)
{
    char *const at = filter->output + filter->output_length;
    *at = ' ';
    filter->output_length += cm_number_write(value, filter->digits, at + !first) + (size_t)!first;
}

static void put_line(struct line_filter *filter, size_t index)
{
    const struct line *const line = &filter->line[index];
    if (filter->output_length > OUTPUT_BYTES - RESULT_BYTES_MAX - LINE_BYTES_MAX - 2)
    {
        flush_output(filter);
    }
    if (line->kind == LINE_POINT)
    {
        filter->work->put(filter->user, index);
    }
    else if (line->kind == LINE_BAD)
    {
        line_put_bytes(filter, filter->bad, strlen(filter->bad));
    }
    line_put_bytes(filter, line->rest, line->rest_length);
    line_put_bytes(filter, line->carriage_return ? "\r\n" : "\n", line->carriage_return ? 2 : 1);
}

/* Work the batch off and empty it. */
static void finish_batch(struct line_filter *filter)
{
    filter->work->compute(filter->user, filter->lines);
    for (size_t i = 0; i < filter->lines; i++)
    {
        if (filter->line[i].kind == LINE_POINT && !filter->work->check(filter->user, i))
        {
            filter->line[i].kind = LINE_BAD;
        }
        put_line(filter, i);
    }
    filter->first_line += filter->lines;
    filter->lines = 0;
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
static const char *read_numbers(struct line_filter *filter, size_t index, const char *text,
                                const char *end, double value[LINE_NUMBERS_MAX])
{
    const int count = filter->count;
    const char *const wanted = filter->wanted;
    for (int i = 0; i < count; i++)
    {
        text = skip_blanks(text, end);
        if (i > 0 && text < end && *text == ',')
        {
            text = skip_blanks(text + 1, end);
        }
        if (text == end)
        {
            line_complain(filter, index, "%d of %d numbers: a line is %s", i, count, wanted);
            return NULL;
        }
        const char *const next = number_or_word(text, end, &value[i]);
        if (next == NULL || (next < end && !is_blank(*next) && *next != ','))
        {
            line_complain(filter, index, "'%s' is not a number: a line is %s",
                          quote_word(text, end).text, wanted);
            return NULL;
        }
        text = next;
    }
    return text;
}

static const char *end_of_word(const char *text, const char *end)
{
    while (text < end && !is_blank(*text) && *text != ',')
    {
        text++;
    }
    return text;
}

/* What becomes of the line between text and end? Its rest and, if it is a point, the place index of
 * the batch are filled in. */
static line_kind take_line(struct line_filter *filter, size_t index, const char *text,
                           const char *end)
{
    struct line *const line = &filter->line[index];
    double value[LINE_NUMBERS_MAX] = {0};

    line->rest = text;
    line->rest_length = 0;
    if (memchr(text, '\0', (size_t)(end - text)) != NULL)
    {
        line_complain(filter, index, "a zero byte: the input is no text");
        return LINE_BAD;
    }
    const char *const word = skip_blanks(text, end);
    if (word == end || *word == '#')
    {
        line->rest_length = (size_t)(end - text);
        return LINE_THROUGH;
    }
    const bool takes_word = filter->work->take_word != NULL;
    const char *const rest =
        takes_word ? end_of_word(word, end) : read_numbers(filter, index, word, end, value);
    if (rest == NULL)
    {
        return LINE_BAD;
    }
    line->rest = rest;
    line->rest_length = (size_t)(end - rest);
    const bool taken =
        takes_word ? filter->work->take_word(filter->user, index, word, (size_t)(rest - word))
                   : filter->work->take(filter->user, index, value);
    return taken ? LINE_POINT : LINE_BAD;
}

/* Add a line, without its line feed, to the batch. */
static void add_line(struct line_filter *filter, const char *text, const char *end)
{
    const size_t index = filter->lines;
    struct line *const line = &filter->line[index];

    filter->work->clear(filter->user, index);
    line->carriage_return = end > text && end[-1] == '\r';
    end -= line->carriage_return;
    if (end - text > LINE_BYTES_MAX)
    {
        line->carriage_return = false; /* its end may not be here yet */
        line_complain(filter, index, "a line of more than %d bytes", LINE_BYTES_MAX);
        line->kind = LINE_BAD;
        line->rest_length = 0;
        line->rest = text;
    }
    else
    {
        line->kind = take_line(filter, index, text, end);
    }
    if (++filter->lines == BATCH_LINES)
    {
        finish_batch(filter);
    }
}

/* ------------------------------------------------------------------------------- input */

/* Take the line that begins at input_start, as far as it is there. False if the rest of it must be
 * read first. */
static bool take_next_line(struct line_filter *filter)
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
static void read_input(struct line_filter *filter)
{
    const size_t present = filter->input_end - filter->input_start;
    memmove(filter->input, filter->input + filter->input_start, present);
    filter->input_start = 0;
    filter->input_end = present;

    const int descriptor = descriptor_of(filter->in);
    char *const to = filter->input + present;
    const size_t room = sizeof filter->input - present;
    if (filter->output_length > 0 && descriptor >= 0 && !descriptor_has_input(descriptor))
    {
        flush_output(filter);
    }
    const ptrdiff_t count = descriptor >= 0 ? descriptor_read(descriptor, to, room)
                                            : (ptrdiff_t)fread(to, 1, room, filter->in);
    if (count >= 0)
    {
        filter->input_end += (size_t)count;
        filter->at_end = count == 0;
    }
    else
    {
        /* strerror's text must survive the flush */
        const int reason = errno;
        flush_output(filter);
        fail(filter->failure, EXIT_FAILURE, "cannot read %s: %s", filter->name, strerror(reason));
    }
}

bool line_filter_run(struct line_filter *filter)
{
    fflush(filter->out); /* what was written by the stream comes first */
    filter->first_line = 1;
    while (!filter->at_end && filter->failure->status == 0)
    {
        read_input(filter);
        while (take_next_line(filter))
        {
        }
        /* the lines of a batch are in the buffer, which the next reading moves */
        finish_batch(filter);
    }
    flush_output(filter);
    return !filter->any_bad && filter->failure->status == 0;
}
