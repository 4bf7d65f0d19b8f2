/* SPDX-License-Identifier: MIT
 *
 * The shapes of a call: whatever n, the alignment of the arrays, what lies over what and the form of
 * the function, a point has the same bits, and nothing but the results is written; nor are the flags of
 * floating-point exceptions, by good points or bad ones.
 *
 * The points are those of a pool, which has been computed at once; point i of a call is point
 * start + i of the pool, so that it stands at another place of a vector. Inputs end where their memory
 * ends, so that the address sanitizer sees what is read behind them; outputs have guards on both sides.
 */
#include "paths.h"

#include <fenv.h>

enum
{
    POOL = 640, /* more than two blocks of the strided functions */
    LENGTHS = 3 * 16 + 2,
    OFFSETS = 16,
    GUARDS = 64, /* bytes */
    GUARD = 0xa5
};

typedef struct pool
{
    const subject *subject;
    const precision *in;
    const path *path;
    double input[COLUMNS_MAX][POOL]; /* memory for any kind of column */
    double expected[COLUMNS_MAX][POOL];
} pool;

/* One call. over[k]: the input that output k is written over, or -1. */
typedef struct trial
{
    const pool *pool;
    const form *form;
    size_t start;
    size_t n;
    size_t offset;
    int over[COLUMNS_MAX];
} trial;

typedef struct column
{
    char letter;
    size_t size; /* bytes, of an element */
    size_t before, after;
    unsigned char *memory;
    void *first;
} column;

static column make_column(const trial *t, char letter, size_t offset, int guarded)
{
    column made = {.letter = letter, .size = element_size(letter, t->pool->in)};
    made.before = (guarded ? GUARDS : 0) + offset * made.size;
    made.after = guarded ? GUARDS : 0;
    size_t whole = made.before + t->n * made.size + made.after;
    made.memory = need(malloc(whole + (whole == 0)));
    memset(made.memory, GUARD, whole);
    made.first = made.memory + made.before;
    return made;
}

static int is_guarded(const column *c, size_t n)
{
    int all = 1;
    for (size_t i = 0; i < c->before; i++)
    {
        all &= c->memory[i] == GUARD;
    }
    for (size_t i = 0; i < c->after; i++)
    {
        all &= c->memory[c->before + n * c->size + i] == GUARD;
    }
    return all;
}

/* The next piece of a call that is one piece of the pool, too. */
static size_t piece(const trial *t, size_t done, size_t *at)
{
    *at = (t->start + done) % POOL;
    size_t left = t->n - done;
    return left < POOL - *at ? left : POOL - *at;
}

static void copy_from_pool(const trial *t, const double *from, column *to)
{
    size_t at;
    for (size_t done = 0; done < t->n; done += piece(t, done, &at))
    {
        size_t count = piece(t, done, &at);
        memcpy((char *)to->first + done * to->size, (const char *)from + at * to->size,
               count * to->size);
    }
}

/* The first point whose bits are others, or n. */
static size_t first_difference(const trial *t, const double *from, const column *in)
{
    size_t at;
    for (size_t done = 0; done < t->n; done += piece(t, done, &at))
    {
        const char *got = (const char *)in->first + done * in->size;
        size_t count = piece(t, done, &at);
        const char *expected = (const char *)from + at * in->size;
        for (size_t i = 0; memcmp(got, expected, count * in->size) != 0; i++)
        {
            if (memcmp(got + i * in->size, expected + i * in->size, in->size) != 0)
            {
                return done + i;
            }
        }
    }
    return t->n;
}

static void complain_of(const trial *t, const char *wrong, size_t k, size_t i)
{
    char over[4 * COLUMNS_MAX] = "";
    for (size_t o = 0; t->pool->path->outputs[o] != '\0'; o++)
    {
        snprintf(over + strlen(over), sizeof over - strlen(over), " %d", t->over[o]);
    }
    complain(t->pool->subject, t->pool->in, t->pool->path,
             "%s: %s, column %zu, point %zu of %zu (%zu of the pool), offset %zu, over%s",
             t->form->name, wrong, k, i, t->n, (t->start + i) % POOL, t->offset, over);
}

static int is_overwritten(const trial *t, size_t input)
{
    int any = 0;
    for (size_t k = 0; t->pool->path->outputs[k] != '\0'; k++)
    {
        any |= t->over[k] == (int)input;
    }
    return any;
}

static void check_results(const trial *t, const column *input, const column *output)
{
    const path *p = t->pool->path;
    for (size_t k = 0; p->outputs[k] != '\0'; k++)
    {
        size_t i = first_difference(t, t->pool->expected[k], &output[k]);
        if (i < t->n)
        {
            complain_of(t, "other bits than in the pool", k, i);
        }
        if (!is_guarded(&output[k], t->n))
        {
            complain_of(t, "written outside the array", k, t->n);
        }
    }
    for (size_t k = 0; p->inputs[k] != '\0'; k++)
    {
        if (!is_overwritten(t, k) && first_difference(t, t->pool->input[k], &input[k]) < t->n)
        {
            complain_of(t, "an argument was changed", k, 0);
        }
    }
}

/* The offsets of columns differ, and each column has all of them in turn. */
static void make_columns(const trial *t, column *input, column *output)
{
    const path *p = t->pool->path;
    for (size_t k = 0; p->inputs[k] != '\0'; k++)
    {
        size_t offset = t->offset * (2 * k + 1) % OFFSETS;
        input[k] = make_column(t, p->inputs[k], offset, is_overwritten(t, k));
        copy_from_pool(t, t->pool->input[k], &input[k]);
    }
    for (size_t k = 0; p->outputs[k] != '\0'; k++)
    {
        size_t offset = t->offset * (2 * k + 7) % OFFSETS;
        output[k] = t->over[k] >= 0 ? input[t->over[k]] : make_column(t, p->outputs[k], offset, 1);
    }
}

static void run_trial(const trial *t)
{
    const path *p = t->pool->path;
    column input[COLUMNS_MAX], output[COLUMNS_MAX];
    void *in[COLUMNS_MAX] = {NULL}, *out[COLUMNS_MAX] = {NULL};
    make_columns(t, input, output);
    for (size_t k = 0; k < COLUMNS_MAX && t->n > 0; k++) /* of none, arrays may be NULL */
    {
        in[k] = k < strlen(p->inputs) ? input[k].first : NULL;
        out[k] = k < strlen(p->outputs) ? output[k].first : NULL;
    }
    /* none or all of them raised before */
    const int raised = t->n % 2 == 0 ? 0 : FE_ALL_EXCEPT;
    feclearexcept(FE_ALL_EXCEPT);
    feraiseexcept(raised);
    const char *wrong = t->form->call(t->pool->subject->tested, t->n, in, out, t->form->argument);
    if (wrong != NULL)
    {
        complain_of(t, wrong, 0, 0);
    }
    const int asked = t->form->inexact ? FE_ALL_EXCEPT & ~FE_INEXACT : FE_ALL_EXCEPT;
    if (fetestexcept(asked) != (raised & asked))
    {
        complain_of(t, "other exception flags than before", 0, 0);
    }
    check_results(t, input, output);
    for (size_t k = 0; p->outputs[k] != '\0'; k++)
    {
        free(t->over[k] < 0 ? output[k].memory : NULL);
    }
    for (size_t k = 0; p->inputs[k] != '\0'; k++)
    {
        free(input[k].memory);
    }
}

/* ---- What is tried ---- */

static trial plain_trial(const pool *from, const form *with, size_t n)
{
    trial t = {.pool = from, .form = with, .start = 11 * n, .n = n};
    for (int k = 0; k < COLUMNS_MAX; k++)
    {
        t.over[k] = -1;
    }
    return t;
}

/* All pairs of a length and an offset, or each length at one, so that each offset has three of them. */
static void try_lengths(const pool *from, int all_shapes)
{
    const size_t step = all_shapes ? 1 : OFFSETS;
    for (size_t n = 0; n < LENGTHS; n++)
    {
        trial t = plain_trial(from, &from->path->forms[0], n);
        for (t.offset = all_shapes ? 0 : 5 * n % OFFSETS; t.offset < OFFSETS; t.offset += step)
        {
            t.start = 7 * n + 37 * t.offset;
            run_trial(&t);
        }
    }
}

/* Which input each output goes over, as the digits of code; 0 if two of them go over the same, or an
 * input is of another kind. */
static int decode_over(const path *p, size_t code, int *over)
{
    size_t inputs = strlen(p->inputs);
    for (size_t k = 0; p->outputs[k] != '\0'; k++, code /= inputs + 1)
    {
        over[k] = (int)(code % (inputs + 1)) - 1;
        for (size_t before = 0; before < k && over[k] >= 0; before++)
        {
            if (over[before] == over[k])
            {
                return 0;
            }
        }
        if (over[k] >= 0 && p->inputs[over[k]] != p->outputs[k])
        {
            return 0;
        }
    }
    return code == 0;
}

static void try_over(const pool *from, size_t code, size_t n)
{
    trial t = plain_trial(from, &from->path->forms[0], n);
    if (decode_over(from->path, code, t.over))
    {
        run_trial(&t);
    }
}

/* Of six outputs one or two adjacent ones go over inputs at a time, because all combinations would be
 * too many. */
static void try_places(const pool *from)
{
    static const size_t lengths[] = {1, 3, 16, 37};
    size_t inputs = strlen(from->path->inputs) + 1;
    size_t codes = 1;
    size_t limit = strlen(from->path->outputs) > 3 ? inputs * inputs : SIZE_MAX;
    for (size_t k = 0; from->path->outputs[k] != '\0'; k++)
    {
        codes *= inputs;
    }
    for (size_t shift = 1; shift < codes && from->path->in_place; shift *= inputs)
    {
        for (size_t code = 1; code < limit && code * shift < codes; code++)
        {
            for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++)
            {
                try_over(from, code * shift, lengths[i]);
            }
        }
        shift = limit == SIZE_MAX ? codes : shift;
    }
}

static void try_forms(const pool *from, int all_shapes)
{
    static const size_t lengths[] = {0, 1, 2, 17, 49, 256, 257};
    for (const form *f = from->path->forms + 1; f->name != NULL; f++)
    {
        for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++)
        {
            trial t = plain_trial(from, f, lengths[i]);
            run_trial(&t);
        }
        /* many points, for the threads, in one frame of three: how they share points no mapping knows */
        if (f->most > 0 &&
            (f->most <= POOL ||
             (all_shapes && strcmp(from->subject->frame->identifier, "turned") == 0)))
        {
            trial t = plain_trial(from, f, f->most);
            run_trial(&t);
        }
    }
}

/* A third of the pool are bad points, a third hard and a third random ones. */
static void fill_pool(pool *made)
{
    const path *p = made->path;
    size_t count = input_count(p->kind, 1);
    size_t easy = count - input_count(p->kind, SIZE_MAX / 2);
    for (size_t i = 0; i < POOL; i++)
    {
        number point[COLUMNS_MAX];
        size_t index = i * 7919;
        if (i % 3 == 2)
        {
            random_input(p->kind, i, 0, point);
        }
        else
        {
            input_at(p->kind, made->in, 1, i % 3 == 0 ? index % (count - easy) : index % count,
                     point);
        }
        for (size_t k = 0; p->inputs[k] != '\0'; k++)
        {
            put_value(p->inputs[k], made->in, made->input[k], i, point[k]);
        }
    }
    void *in[COLUMNS_MAX], *out[COLUMNS_MAX];
    for (size_t k = 0; k < COLUMNS_MAX; k++)
    {
        in[k] = made->input[k];
        out[k] = made->expected[k];
    }
    (void)p->forms[0].call(made->subject->tested, POOL, in, out, p->forms[0].argument);
}

void check_shapes(const subject *s, const precision *in, const path *p, int all_shapes)
{
    static pool made;
    made.subject = s;
    made.in = in;
    made.path = p;
    fill_pool(&made);
    try_lengths(&made, all_shapes);
    try_places(&made);
    try_forms(&made, all_shapes);
}
