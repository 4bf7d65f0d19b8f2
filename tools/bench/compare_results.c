/* SPDX-License-Identifier: MIT
 *
 * cubemap-bench compare: medians of two runs with their intervals, and which differ by more than chance, as Go's
 * benchstat tells them.
 */
#include "compare_results.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "bench/harness/significance.h"
#include "tools/cli/input_file.h"

static const double confidence = 0.95;

/* ---- Options ---- */

enum
{
    GATE = 1,
    ALPHA
};

static const cm_option table[] = {
    {.id = GATE,
     .name = "gate",
     .kind = CM_OPTION_NUMBER,
     .argument = "PERCENT",
     .help = "exit status 1 if anything has become significantly slower by more than that",
     .more = "0 is for any difference, of which chance alone makes some.",
     .high = 1e6},
    {.id = ALPHA,
     .name = "alpha",
     .kind = CM_OPTION_NUMBER,
     .argument = "A",
     .help = "a difference is significant if equal runs would differ so much with a probability of "
             "at most that",
     .standard = "0.05",
     .high = 1.0,
     .flags = CM_OPTION_ABOVE},
};

static const cm_option_group groups[] = {{NULL, table, sizeof table / sizeof *table}};

const cm_command compare_command = {
    .name = "cubemap-bench compare",
    .usage = "[OPTION]... OLD.json NEW.json",
    .summary =
        "Tell what has become faster or slower from one run to another. Both are files of "
        "cubemap-bench --json; - is standard input. For each way and direction that both have: the "
        "median of the samples, how far the ends of its 95 % interval are from it, and the change "
        "of "
        "the median, or ~ where the two do not differ significantly by Mann and Whitney's U test; "
        "p "
        "is its probability, n the number of samples. The last row has the geometric means.",
    .groups = groups,
    .group_count = 1,
    .notes = "Samples of one run are of one process and some seconds: that the machine was slower "
             "in all "
             "of another run they cannot tell from slower code. Two runs of one build show how "
             "much that "
             "is; a gate should be beyond it.\n\n"
             "Exit status: 0; 1 past the gate, if that could not be, if a file cannot be read or "
             "if nothing can be compared; 2 for wrong usage.\n\n"
             "Example:\n"
             "  cubemap-bench --json old.json\n"
             "  cubemap-bench --json new.json\n"
             "  cubemap-bench compare --gate 5 old.json new.json\n",
    .operand = CM_OPTION_FILE};

/* ---- Comparison ---- */

typedef struct pair
{
    const series *side[2]; /* old, new */
    median_interval median[2];
    double probability;
    double change; /* of the median, relative */
    int significant;
} pair;

static pair compare_pair(const series *old, const series *new, double alpha)
{
    pair p = {.side = {old, new}};
    for (int k = 0; k < 2; k++)
    {
        p.median[k] = median_within(p.side[k]->samples, p.side[k]->count, confidence);
    }
    p.probability = rank_sum_probability(old->samples, old->count, new->samples, new->count);
    p.change = p.median[1].median / p.median[0].median - 1.0;
    p.significant = p.probability <= alpha;
    return p;
}

static const series *find(const results *r, const series *like)
{
    size_t from = 0;
    for (size_t to = r->count; from < to;)
    {
        const size_t middle = from + (to - from) / 2;
        const int order = compare_series(like, r->named[middle]);
        if (order == 0)
        {
            return r->named[middle];
        }
        from = order > 0 ? middle + 1 : from;
        to = order > 0 ? to : middle;
    }
    return NULL;
}

static void count_pair(verdict *v, const pair *p, double alpha, double gate)
{
    v->compared++;
    v->mute += least_rank_sum_probability(p->side[0]->count, p->side[1]->count) > alpha;
    if (!p->significant)
    {
        return;
    }
    v->slower += p->change > 0.0;
    v->faster += p->change < 0.0;
    if (p->change > gate)
    {
        v->past_gate++;
        if (v->worst == NULL || p->change > v->worst_change)
        {
            v->worst = p->side[0];
            v->worst_change = p->change;
        }
    }
}

/* ---- Table ---- */

typedef struct columns
{
    int mapping; /* characters */
    int label;   /* of all words */
} columns;

static columns widths_of(const results *old)
{
    columns w = {7, 0};
    for (size_t i = 0; i < old->count; i++)
    {
        const int length = (int)fmin(60.0, (double)strlen(old->list[i].word[0]));
        w.mapping = length > w.mapping ? length : w.mapping;
    }
    w.label = w.mapping + 3 + 9 + 6 + 9;
    return w;
}

/* The farther end of the interval, in per cent of the median. */
static const char *spread_text(const median_interval *m, char text[16])
{
    const double away = fmax(m->high - m->median, m->median - m->low) / m->median;
    if (isinf(away))
    {
        return "inf";
    }
    snprintf(text, 16, "%.0f%%", fmin(100.0 * away, 1e9));
    return text;
}

static const char *change_text(double change, char text[32])
{
    snprintf(text, 32, "%+.2f%%", 100.0 * change);
    return text;
}

static void print_pair(FILE *out, const pair *p, columns w)
{
    char text[32];
    const series *const s = p->side[0];
    fprintf(out, "%-*s %-9s %-6s %-9s", w.mapping, s->word[0], s->word[1], s->word[2], s->word[3]);
    for (int k = 0; k < 2; k++)
    {
        fprintf(out, "  %9.4g %5s", p->median[k].median, spread_text(&p->median[k], text));
    }
    fprintf(out, "  %10s  p=%.3f n=%zu", p->significant ? change_text(p->change, text) : "~",
            p->probability, p->side[0]->count);
    fprintf(out, p->side[1]->count == p->side[0]->count ? "\n" : "+%zu\n", p->side[1]->count);
}

static void print_runs(FILE *out, const results *old, const results *new)
{
    const results *const run[] = {old, new};
    for (int k = 0; k < 2; k++)
    {
        fprintf(out, "%s: %s, commit %s\n", k == 0 ? "old" : "new", run[k]->date, run[k]->commit);
    }
    for (int i = 0; i < CONDITIONS; i++)
    {
        if (strcmp(old->condition[i], new->condition[i]) == 0)
        {
            fprintf(out, "%s: %s\n", condition_names[i], old->condition[i]);
        }
        else
        {
            fprintf(out, "%s, not the same: %s -> %s\n", condition_names[i], old->condition[i],
                    new->condition[i]);
        }
    }
}

static void print_heading(FILE *out, columns w)
{
    fprintf(out, "\n%-*s  %15s  %15s\n", w.label, "ns a point", "old", "new");
    fprintf(out, "%-*s %-9s %-6s %-9s", w.mapping, "mapping", "precision", "form", "direction");
    fprintf(out, "  %9s %5s  %9s %5s  %10s\n", "median", "+-", "median", "+-", "change");
}

static void print_means(FILE *out, columns w, size_t compared, const double log_sum[2])
{
    char text[32];
    const double old = exp(log_sum[0] / (double)compared);
    const double new = exp(log_sum[1] / (double)compared);
    fprintf(out, "%-*s  %9.4g %5s  %9.4g %5s  %10s\n", w.label, "geometric mean", old, "", new, "",
            change_text(new / old - 1.0, text));
}

/* Those of the one that the other has not. */
static void print_others(FILE *out, const char *which, const results *of, const results *other)
{
    for (size_t i = 0; i < of->count; i++)
    {
        const char *const *const word = of->list[i].word;
        if (find(other, &of->list[i]) == NULL)
        {
            fprintf(out, "only in %s: %s %s %s %s\n", which, word[0], word[1], word[2], word[3]);
        }
    }
}

static int has_interval(const pair *p)
{
    return isfinite(p->median[0].high) && isfinite(p->median[1].high);
}

static void print_notes(FILE *out, const verdict *v, size_t without_interval, double alpha)
{
    fprintf(out, "\n%zu slower, %zu faster, %zu neither, at alpha %g", v->slower, v->faster,
            v->compared - v->slower - v->faster, alpha);
    fprintf(out, "; of %zu that are equal some %.3g would seem to differ\n", v->compared,
            alpha * (double)v->compared);
    if (without_interval > 0)
    {
        fprintf(out, "%zu with too few samples for an interval at 95 %%: 6 are needed\n",
                without_interval);
    }
    if (v->mute > 0)
    {
        fprintf(out, "%zu with too few samples for any difference to show at alpha %g\n", v->mute,
                alpha);
    }
}

verdict print_comparison(FILE *out, const results *old, const results *new, double alpha,
                         double gate)
{
    const columns w = widths_of(old);
    verdict v = {.compared = 0};
    size_t without_interval = 0;
    double log_sum[2] = {0.0, 0.0};
    print_runs(out, old, new);
    print_heading(out, w);
    for (size_t i = 0; i < old->count; i++)
    {
        const series *const other = find(new, &old->list[i]);
        if (other != NULL)
        {
            const pair p = compare_pair(&old->list[i], other, alpha);
            print_pair(out, &p, w);
            count_pair(&v, &p, alpha, gate);
            without_interval += !has_interval(&p);
            log_sum[0] += log(p.median[0].median);
            log_sum[1] += log(p.median[1].median);
        }
    }
    if (v.compared > 0)
    {
        print_means(out, w, v.compared, log_sum);
    }
    print_notes(out, &v, without_interval, alpha);
    print_others(out, "old", old, new);
    print_others(out, "new", new, old);
    return v;
}

/* ---- Program ---- */

typedef struct comparison
{
    double alpha;
    double gate; /* in per cent; below 0 if there is none */
    const char *name[2];
} comparison;

/* -1 to go on, or the exit status */
static int read_options(comparison *c, int argc, char **argv, const cm_streams *streams)
{
    cm_option_reader reader = cm_options_begin(&compare_command, argc, argv, streams);
    int id;
    while ((id = cm_options_next(&reader)) > 0)
    {
        *(id == GATE ? &c->gate : &c->alpha) = reader.number;
    }
    if (id != CM_OPTIONS_END)
    {
        return id == CM_OPTIONS_WRONG ? complain(&reader) : close_standard_output();
    }
    if (reader.operand_count != 2)
    {
        return usage("two files are compared, OLD.json and NEW.json", "");
    }
    for (int k = 0; k < 2; k++)
    {
        c->name[k] = reader.operands[k];
    }
    if (strcmp(c->name[0], "-") == 0 && strcmp(c->name[1], "-") == 0)
    {
        return usage("standard input can be one of the two files only", "");
    }
    return -1;
}

static bool open_and_read(const char *name, const cm_streams *streams, results *r,
                          cm_failure *failure)
{
    const int is_standard = strcmp(name, "-") == 0;
    FILE *const in = is_standard ? streams->in : open_input(name, failure);
    const bool good =
        in != NULL && read_results(in, is_standard ? "standard input" : name, r, failure);
    if (in != NULL && !is_standard)
    {
        fclose(in);
    }
    return good;
}

/* The exit status. */
static int judge(const comparison *c, const verdict *v)
{
    if (v->compared == 0)
    {
        say(harness_err(), "%s: nothing can be compared: no way of %s is in %s", program_name(),
            c->name[0], c->name[1]);
        return EXIT_FAILURE;
    }
    if (c->gate >= 0.0 && v->mute == v->compared)
    {
        say(harness_err(),
            "%s: nothing can be past the gate: all have too few samples for any difference to "
            "show at alpha %g",
            program_name(), c->alpha);
        return EXIT_FAILURE;
    }
    if (c->gate >= 0.0 && v->past_gate > 0)
    {
        const char *const *const word = v->worst->word;
        say(harness_err(),
            "%s: slower by more than %g %%: %zu of %zu, %s %s %s %s the most, by %.3g %%",
            program_name(), c->gate, v->past_gate, v->compared, word[0], word[1], word[2], word[3],
            100.0 * v->worst_change);
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}

int compare_results(int argc, char **argv, const cm_streams *streams)
{
    comparison c = {.alpha = 0.05, .gate = -1.0};
    int status = read_options(&c, argc, argv, streams);
    if (status >= 0)
    {
        return status;
    }
    static cm_failure failure;
    results run[2] = {{.count = 0}, {.count = 0}};
    failure.status = 0;
    if (open_and_read(c.name[0], streams, &run[0], &failure) &&
        open_and_read(c.name[1], streams, &run[1], &failure))
    {
        const verdict v =
            print_comparison(harness_out(), &run[0], &run[1], c.alpha, fmax(c.gate, 0.0) / 100.0);
        status = close_standard_output();
        status = status == 0 ? judge(&c, &v) : status;
    }
    else
    {
        say(harness_err(), "%s: %s", program_name(), failure.text);
        status = EXIT_FAILURE;
    }
    free_results(&run[0]);
    free_results(&run[1]);
    return status;
}
