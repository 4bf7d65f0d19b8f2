/* SPDX-License-Identifier: MIT
 *
 * The tested path against the reference, at every input.
 */
#include "paths.h"

#include <stdarg.h>

enum
{
    BLOCK = 2048,
    NUMBER_SIZE = 32
};

static size_t complaints;

void complain(const subject *s, const precision *in, const path *p, const char *format, ...)
{
    va_list arguments;
    if (complaints++ >= COMPLAINTS_WRITTEN)
    {
        return;
    }
    printf("not ok: %s, %s, %s, %s, %s: ", cm_mapping_instructions(s->tested), s->specification,
           s->frame->identifier, in->name, p->name);
    va_start(arguments, format);
    vprintf(format, arguments);
    va_end(arguments);
    printf("\n");
}

size_t complaint_count(void)
{
    return complaints;
}

static size_t write_number(char *text, size_t size, char letter, number v)
{
    int length = letter == 'r' ? snprintf(text, size, " %.17g", v.real)
                               : snprintf(text, size, " %llu", (unsigned long long)v.word);
    return length < 0 ? 0 : (size_t)length;
}

static void write_numbers(char *text, size_t size, const char *letters, const number *numbers)
{
    size_t length = 0;
    text[0] = '\0';
    for (size_t k = 0; letters[k] != '\0' && length < size; k++)
    {
        length += write_number(text + length, size - length, letters[k], numbers[k]);
    }
}

static void report(const comparison *c, const char *wrong)
{
    char text[3][COLUMNS_MAX * NUMBER_SIZE];
    write_numbers(text[0], sizeof text[0], c->path->inputs, c->input);
    write_numbers(text[1], sizeof text[1], c->path->outputs, c->expected);
    write_numbers(text[2], sizeof text[2], c->path->outputs, c->got);
    complain(c->subject, c->in, c->path, "%s:%s:\n    scalar%s\n    tested%s", wrong, text[0],
             text[1], text[2]);
}

static void judge_point(const comparison *c, extreme *worst)
{
    double error = 0.0;
    const char *wrong = c->path->judge(c, &error);
    if (wrong != NULL)
    {
        report(c, wrong);
    }
    if (error > worst->error)
    {
        char where[COLUMNS_MAX * NUMBER_SIZE];
        worst->error = error;
        write_numbers(where, sizeof where, c->path->inputs, c->input);
        snprintf(worst->where, sizeof worst->where, "%s, %s:%.*s", c->subject->specification,
                 c->subject->frame->identifier, (int)sizeof where, where);
    }
}

static void get_values(const char *letters, const precision *in, void *const *columns, size_t i,
                       number *to)
{
    for (size_t k = 0; letters[k] != '\0'; k++)
    {
        to[k] = get_value(letters[k], in, columns[k], i);
    }
}

#define MARK(type)                                                                                 \
    for (size_t i = 0; i < n; i++)                                                                 \
    {                                                                                              \
        marks[i] |= ((const type *)a)[i] != ((const type *)b)[i];                                  \
    }

/* Points whose bits differ, of whole columns at once: element by element it would take as long as a path. */
static void mark_column(size_t size, const void *a, const void *b, size_t n, uint8_t *marks)
{
    switch (size)
    {
    case 8:
        MARK(uint64_t)
        break;
    case 4:
        MARK(uint32_t)
        break;
    default:
        MARK(uint8_t)
        break;
    }
}

static void mark_differences(const char *letters, const precision *in, void *const *a,
                             void *const *b, size_t n, uint8_t *marks)
{
    memset(marks, 0, n);
    for (size_t k = 0; letters[k] != '\0'; k++)
    {
        mark_column(element_size(letters[k], in), a[k], b[k], n, marks);
    }
}

/* The same path of the other table. */
static const path *float_twin(const path *p)
{
    return &paths_float.paths[p - paths_double.paths];
}

static void call_float(const subject *s, const path *p, size_t n, void *const *in, void *const *out)
{
    static float columns[2 * COLUMNS_MAX][BLOCK];
    const path *twin = float_twin(p);
    void *from[COLUMNS_MAX] = {NULL}, *to[COLUMNS_MAX] = {NULL};
    for (size_t k = 0; p->inputs[k] != '\0'; k++)
    {
        from[k] = p->inputs[k] == 'r' ? columns[k] : in[k];
        for (size_t i = 0; p->inputs[k] == 'r' && i < n; i++)
        {
            columns[k][i] = (float)((const double *)in[k])[i];
        }
    }
    for (size_t k = 0; p->outputs[k] != '\0'; k++)
    {
        to[k] = p->outputs[k] == 'r' ? columns[COLUMNS_MAX + k] : out[k];
    }
    (void)twin->forms[0].call(s->reference, n, from, to, twin->forms[0].argument);
    for (size_t k = 0; p->outputs[k] != '\0'; k++)
    {
        for (size_t i = 0; p->outputs[k] == 'r' && i < n; i++)
        {
            ((double *)out[k])[i] = (double)columns[COLUMNS_MAX + k][i];
        }
    }
}

void call_reference(const subject *s, const path *p, size_t n, void *const *in, void *const *out)
{
    if (s->tier == CM_TIER_FAST && (cm_mapping_describe(s->reference)->fast & p->fast) != 0)
    {
        call_float(s, p, n, in, out);
    }
    else
    {
        (void)p->forms[0].call(s->reference, n, in, out, p->forms[0].argument);
    }
}

static void compare_block(const subject *s, const precision *in, const path *p, size_t n,
                          void *const *input, extreme *worst)
{
    static double expected[COLUMNS_MAX][BLOCK];
    static double got[COLUMNS_MAX][BLOCK];
    static uint8_t differs[BLOCK];
    void *to_expected[COLUMNS_MAX], *to_got[COLUMNS_MAX];
    for (size_t k = 0; k < COLUMNS_MAX; k++)
    {
        to_expected[k] = expected[k];
        to_got[k] = got[k];
    }
    call_reference(s, p, n, input, to_expected);
    (void)p->forms[0].call(s->tested, n, input, to_got, p->forms[0].argument);
    mark_differences(p->outputs, in, to_expected, to_got, n, differs);
    comparison c = {.subject = s, .in = in, .path = p};
    for (size_t i = 0; i < n; i++)
    {
        if (differs[i])
        {
            get_values(p->inputs, in, input, i, c.input);
            get_values(p->outputs, in, to_expected, i, c.expected);
            get_values(p->outputs, in, to_got, i, c.got);
            judge_point(&c, worst);
        }
    }
    worst->points += n;
}

void compare_points(const subject *s, const precision *in, const path *p, size_t n,
                    void *const *input, extreme *worst)
{
    for (size_t done = 0; done < n; done += BLOCK)
    {
        void *from[COLUMNS_MAX] = {NULL};
        for (size_t k = 0; p->inputs[k] != '\0'; k++)
        {
            from[k] = (char *)input[k] + done * element_size(p->inputs[k], in);
        }
        compare_block(s, in, p, n - done < BLOCK ? n - done : BLOCK, from, worst);
    }
}

/* All inputs of a kind, in columns, which are the same for every subject. */
typedef struct inputs
{
    size_t one_in;
    size_t count;
    void *column[COLUMNS_MAX];
} inputs;

static void make_inputs(inputs *made, const precision *in, const path *p, size_t one_in)
{
    made->one_in = one_in;
    made->count = input_count(p->kind, one_in);
    for (size_t k = 0; p->inputs[k] != '\0'; k++)
    {
        free(made->column[k]);
        made->column[k] = need(malloc(made->count * element_size(p->inputs[k], in)));
    }
    for (size_t i = 0; i < made->count; i++)
    {
        number point[COLUMNS_MAX];
        input_at(p->kind, in, one_in, i, point);
        for (size_t k = 0; p->inputs[k] != '\0'; k++)
        {
            put_value(p->inputs[k], in, made->column[k], i, point[k]);
        }
    }
}

void compare_inputs(const subject *s, const precision *in, const path *p, size_t one_in,
                    extreme *worst)
{
    static inputs kept[INPUT_KINDS][2];
    inputs *all = &kept[p->kind][in->narrow];
    if (all->one_in != one_in)
    {
        make_inputs(all, in, p, one_in);
    }
    compare_points(s, in, p, all->count, all->column, worst);
}
