/* SPDX-License-Identifier: MIT */
#include "read_results.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "bench/harness/harness.h"

const char *const condition_names[CONDITIONS] = {"version", "cpu",          "system", "compiler",
                                                 "flags",   "instructions", "points"};

int compare_series(const series *a, const series *b)
{
    int order = 0;
    for (size_t i = 0; i < sizeof a->word / sizeof *a->word && order == 0; i++)
    {
        order = strcmp(a->word[i], b->word[i]);
    }
    return order;
}

#ifdef HAVE_JANSSON
#include <jansson.h>

enum
{
    FORMAT = 1,
    WHERE_MAX = 96
};

/* What a point can take, in ns: enough for any processor, and nothing that overflows when it is divided. */
static const double least_time = 1e-9;
static const double greatest_time = 1e15;

typedef struct reading
{
    const char *name;
    cm_failure *failure;
} reading;

static bool refuse(const reading *of, const char *where, const char *what)
{
    return fail(of->failure, EXIT_FAILURE, "%s: %s is not %s, as cubemap-bench --json writes it",
                of->name, where, what);
}

/* Of ASCII, or of the 32 behind it, which UTF-8 writes as c2 80 to c2 9f: some terminals obey those, too. */
static bool is_control(const char *at)
{
    const unsigned char c = (unsigned char)at[0];
    return c < ' ' || c == 0x7f || (c == 0xc2 && (unsigned char)at[1] < 0xa0);
}

/* A text that may go to a terminal. */
static bool take_text(const reading *of, const json_t *from, const char *key, const char *where,
                      const char **text)
{
    *text = json_string_value(json_object_get(from, key));
    for (const char *at = *text; at != NULL && *at != '\0'; at++)
    {
        if (is_control(at))
        {
            *text = NULL;
            break;
        }
    }
    return *text != NULL || refuse(of, where, "a text of one line");
}

static bool take_samples(const reading *of, const json_t *from, const char *where, series *s)
{
    const json_t *const samples = json_object_get(from, "ns_samples");
    s->count = json_array_size(samples);
    if (s->count == 0)
    {
        return refuse(of, where, "a list of times");
    }
    s->samples = allocate(s->count, sizeof *s->samples);
    for (size_t i = 0; i < s->count; i++)
    {
        const json_t *const sample = json_array_get(samples, i);
        s->samples[i] = json_number_value(sample);
        if (!(s->samples[i] >= least_time && s->samples[i] <= greatest_time))
        {
            return refuse(of, where, "a list of times from 1e-9 to 1e15 ns");
        }
    }
    return true;
}

static bool take_series(const reading *of, const json_t *from, const char *where, results *r,
                        const char *mapping)
{
    static const char *const keys[] = {NULL, "precision", "form", "direction"};
    char place[2 * WHERE_MAX];
    r->list = grow(r->list, r->count, sizeof *r->list);
    series *const s = &r->list[r->count++];
    *s = (series){.word = {mapping}};
    for (size_t i = 1; i < sizeof keys / sizeof *keys; i++)
    {
        snprintf(place, sizeof place, "%s.%s", where, keys[i]);
        if (!take_text(of, from, keys[i], place, &s->word[i]))
        {
            return false;
        }
    }
    snprintf(place, sizeof place, "%s.ns_samples", where);
    return take_samples(of, from, place, s);
}

static bool take_mapping(const reading *of, const json_t *from, size_t index, results *r)
{
    char where[WHERE_MAX];
    const char *mapping;
    const json_t *const speed = json_object_get(from, "speed");
    snprintf(where, sizeof where, "mappings[%zu].specification", index);
    if (!take_text(of, from, "specification", where, &mapping))
    {
        return false;
    }
    snprintf(where, sizeof where, "mappings[%zu].speed", index);
    if (!json_is_array(speed))
    {
        return refuse(of, where, "a list");
    }
    for (size_t i = 0; i < json_array_size(speed); i++)
    {
        snprintf(where, sizeof where, "mappings[%zu].speed[%zu]", index, i);
        if (!take_series(of, json_array_get(speed, i), where, r, mapping))
        {
            return false;
        }
    }
    return true;
}

static bool take_conditions(const reading *of, const json_t *root, results *r)
{
    const json_t *const machine = json_object_get(root, "machine");
    const json_t *const points = json_object_get(json_object_get(root, "settings"), "points");
    for (size_t i = 0; i < CONDITIONS - 1; i++)
    {
        char where[WHERE_MAX];
        snprintf(where, sizeof where, "%s%s", i == 0 ? "" : "machine.", condition_names[i]);
        if (!take_text(of, i == 0 ? root : machine, condition_names[i], where, &r->condition[i]))
        {
            return false;
        }
    }
    if (!json_is_integer(points))
    {
        return refuse(of, "settings.points", "a whole number");
    }
    snprintf(r->points, sizeof r->points, "%" JSON_INTEGER_FORMAT, json_integer_value(points));
    r->condition[CONDITIONS - 1] = r->points;
    return true;
}

static bool take_head(const reading *of, const json_t *root, results *r)
{
    const char *const program = json_string_value(json_object_get(root, "program"));
    const json_t *const format = json_object_get(root, "format");
    if (program == NULL || strcmp(program, "cubemap-bench") != 0)
    {
        return refuse(of, "program", "\"cubemap-bench\"");
    }
    if (!json_is_integer(format) || json_integer_value(format) != FORMAT)
    {
        return refuse(of, "format", "1");
    }
    return take_text(of, root, "date", "date", &r->date) &&
           take_text(of, root, "commit", "commit", &r->commit) && take_conditions(of, root, r);
}

static int compare_named(const void *a, const void *b)
{
    return compare_series(*(series *const *)a, *(series *const *)b);
}

static bool sort_series(const reading *of, results *r)
{
    r->named = allocate(r->count, sizeof *r->named);
    for (size_t i = 0; i < r->count; i++)
    {
        r->named[i] = &r->list[i];
    }
    qsort(r->named, r->count, sizeof *r->named, compare_named);
    for (size_t i = 1; i < r->count; i++)
    {
        if (compare_series(r->named[i - 1], r->named[i]) == 0)
        {
            const char *const *const word = r->named[i]->word;
            return fail(of->failure, EXIT_FAILURE, "%s: %s %s %s %s stands there twice", of->name,
                        word[0], word[1], word[2], word[3]);
        }
    }
    return true;
}

/* What is no JSON, or is cut off, or has a key twice, or is nested deeper than jansson goes. */
static json_t *load(const reading *of, FILE *in)
{
    json_error_t error;
    errno = 0;
    json_t *const root = json_loadf(in, JSON_REJECT_DUPLICATES, &error);
    if (root == NULL && ferror(in) != 0)
    {
        fail(of->failure, EXIT_FAILURE, "cannot read %s: %s", of->name, strerror(errno));
    }
    else if (root == NULL)
    {
        fail(of->failure, EXIT_FAILURE, "%s: line %d, column %d: %s", of->name, error.line,
             error.column, error.text);
    }
    return root;
}

bool read_results(FILE *in, const char *name, results *r, cm_failure *failure)
{
    const reading of = {name, failure};
    json_t *const root = load(&of, in);
    *r = (results){.document = root};
    if (root == NULL || !take_head(&of, root, r))
    {
        return false;
    }
    const json_t *const mappings = json_object_get(root, "mappings");
    if (!json_is_array(mappings))
    {
        return refuse(&of, "mappings", "a list");
    }
    for (size_t i = 0; i < json_array_size(mappings); i++)
    {
        if (!take_mapping(&of, json_array_get(mappings, i), i, r))
        {
            return false;
        }
    }
    return sort_series(&of, r);
}

static void free_document(results *r)
{
    json_decref(r->document);
}

#else

bool read_results(FILE *in, const char *name, results *r, cm_failure *failure)
{
    (void)in;
    *r = (results){.count = 0};
    return fail(failure, EXIT_FAILURE,
                "cannot read %s: this program was built without jansson, which reads JSON", name);
}

static void free_document(results *r)
{
    (void)r;
}

#endif

void free_results(results *r)
{
    for (size_t i = 0; i < r->count; i++)
    {
        free(r->list[i].samples);
    }
    free(r->list);
    free(r->named);
    free_document(r);
}
