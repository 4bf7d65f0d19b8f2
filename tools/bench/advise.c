/* SPDX-License-Identifier: MIT
 *
 * cubemap-bench advise: the mappings that are good enough, the cheapest first, and what those that are
 * cheaper would cost in distortion. Times are measured now, on this machine.
 */
#include "bench.h"

#include "truth/sphere.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/catalogue_name.h"
#include "tools/cli/failure.h"

typedef struct limits
{
    double area_error;
    double isotropy;
    double deformation;
    double ns;
    double error;
    int equal_area;
    int smooth;
    int directions; /* bits */
} limits;

typedef struct candidate
{
    const subject *subject;
    const way *way;
    double cost;
    double value[5]; /* area error, isotropy, deformation in degrees, ns, error in metres */
    int good;
} candidate;

typedef struct advice
{
    suite all;
    limits limit;
    int precision;
    const char *json;
    size_t count;
    candidate *list;
} advice;

/* ---- Options ---- */

enum
{
    AREA = 1,
    ISOTROPY,
    DEFORMATION,
    NS,
    ERROR,
    EQUAL,
    SMOOTH,
    DIRECTION,
    PRECISION,
    QUICK,
    JSON
};

static const char *const no_yes[] = {"no", "yes", NULL};
static const char *const smooth_names[] = {"torn", "c0", "c1", "analytic", NULL};
static const char *const both_directions[] = {"forward", "inverse", "both", NULL};

static const cm_option table[] = {
    {.id = AREA,
     .name = "max-area-error",
     .kind = CM_OPTION_NUMBER,
     .argument = "E",
     .help = "greatest |D_A - 1|, D_A the area scale relative to its mean",
     .high = HUGE_VAL},
    {.id = ISOTROPY,
     .name = "max-isotropy",
     .kind = CM_OPTION_NUMBER,
     .argument = "R",
     .help = "greatest D_I = a / b",
     .low = 1.0,
     .high = HUGE_VAL},
    {.id = DEFORMATION,
     .name = "max-deformation",
     .kind = CM_OPTION_NUMBER,
     .argument = "W",
     .help = "greatest angular deformation in degrees",
     .high = 180.0},
    {.id = NS,
     .name = "max-ns",
     .kind = CM_OPTION_NUMBER,
     .argument = "T",
     .help = "nanoseconds a point",
     .high = HUGE_VAL},
    {.id = ERROR,
     .name = "max-error",
     .kind = CM_OPTION_NUMBER,
     .argument = "M",
     .help = "promised bound of a round trip, in metres on Earth",
     .high = HUGE_VAL},
    {.id = EQUAL,
     .name = "equal-area",
     .kind = CM_OPTION_CHOICE,
     .argument = "yes|no",
     .help = "only those that are exactly equal-area; `no`: all",
     .standard = "`no`",
     .choices = no_yes,
     .flags = CM_OPTION_TOLD},
    {.id = SMOOTH,
     .name = "smooth",
     .kind = CM_OPTION_CHOICE,
     .argument = "S",
     .help = "at least so smooth on a face",
     .choices = smooth_names},
    {.id = DIRECTION,
     .name = "direction",
     .kind = CM_OPTION_CHOICE,
     .argument = "D",
     .help = "which directions are asked for",
     .standard = "`both`",
     .choices = both_directions},
    {.id = PRECISION,
     .name = "precision",
     .kind = CM_OPTION_CHOICE,
     .argument = "P",
     .help = "how it computes",
     .standard = "`double`",
     .choices = precision_names},
    {.id = QUICK, .name = "quick", .help = "fewer repetitions"},
    {.id = JSON,
     .name = "json",
     .kind = CM_OPTION_FILE,
     .argument = "FILE",
     .help = "write the candidates there as JSON; - is standard output instead of the table"},
};

static const cm_option_group groups[] = {{NULL, table, sizeof table / sizeof *table}};

const cm_command advise_command = {
    .name = "cubemap-bench advise",
    .usage = "[OPTION]... [MAPPING]...",
    .summary =
        "List the mappings that keep every limit, the cheapest first; then those that are cheaper "
        "and do not, with what they exceed: no more than needed. The cost is the time a point of "
        "the slower of the directions that are asked for, in arrays, measured now. Without limits "
        "all are listed. MAPPING is as for cubemap-bench; default: the catalogue with its standard "
        "parameters.",
    .groups = groups,
    .group_count = 1,
    .notes = "Exit status: 0 if a mapping qualifies, 1 if none does, 2 for wrong usage.\n\n"
             "Example:\n"
             "  cubemap-bench advise --max-area-error 0.2 --max-isotropy 1.8 --max-ns 5 \\\n"
             "      --equal-area no\n",
    .operand = CM_OPTION_TEXT,
    .choice_at = mapping_name_at};

static void take_option(advice *a, const cm_option_reader *reader, int id)
{
    limits *limit = &a->limit;
    const struct
    {
        int id;
        double *number;
        int *choice;
    } places[] = {{AREA, &limit->area_error, NULL},
                  {ISOTROPY, &limit->isotropy, NULL},
                  {DEFORMATION, &limit->deformation, NULL},
                  {NS, &limit->ns, NULL},
                  {ERROR, &limit->error, NULL},
                  {EQUAL, NULL, &limit->equal_area},
                  {SMOOTH, NULL, &limit->smooth},
                  {PRECISION, NULL, &a->precision}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
    {
        if (places[i].id == id && places[i].number != NULL)
        {
            *places[i].number = reader->number;
        }
        else if (places[i].id == id)
        {
            *places[i].choice = (int)reader->choice;
        }
    }
    limit->directions = id == DIRECTION ? (int)reader->choice + 1 : limit->directions;
    a->all.set.repetitions = id == QUICK ? 9 : a->all.set.repetitions;
    a->json = id == JSON ? reader->text : a->json;
}

/* -1 to go on, or the exit status */
static int read_options(advice *a, int argc, char **argv, const cm_streams *streams)
{
    cm_option_reader reader = cm_options_begin(&advise_command, argc, argv, streams);
    int id;
    while ((id = cm_options_next(&reader)) > 0)
    {
        take_option(a, &reader, id);
    }
    if (id != CM_OPTIONS_END)
    {
        return id == CM_OPTIONS_WRONG ? complain(&reader) : close_standard_output();
    }
    char why[200];
    if (cm_instructions_check(NULL, why, sizeof why) != CM_OK)
    {
        return usage(why, "");
    }
    return suite_add_all(&a->all, reader.operand_count, reader.operands) ? -1 : EXIT_USAGE;
}

/* ---- Candidates ---- */

/* A round trip on Earth, as the descriptor promises it; NaN for parameters that it promises nothing for.
 * The fast tier falls back to the exact one where it has no direction. */
static double promised_error(const subject *s, const way *w)
{
    const cm_mapping_info *info = cm_mapping_describe(s->mapping);
    int narrow = w->precision == PRECISION_FLOAT ||
                 (w->precision == PRECISION_FAST && (w->offered[FORWARD] || w->offered[INVERSE]));
    double more = narrow && w->precision == PRECISION_FAST ? 1.0 : 0.0;
    for (size_t i = 0; i < info->parameter_count; i++)
    {
        if (cm_mapping_parameter(s->mapping, i) != info->parameter[i].standard)
        {
            return (double)NAN;
        }
    }
    return (info->bounds.round_trip + more) * (narrow ? 0x1p-24 : 0x1p-53) * EARTH_RADIUS;
}

static int keeps(const advice *a, const candidate *c)
{
    const cm_mapping_info *info = cm_mapping_describe(c->subject->mapping);
    const limits *l = &a->limit;
    return c->value[0] <= l->area_error && c->value[1] <= l->isotropy &&
           c->value[2] <= l->deformation && c->value[3] <= l->ns &&
           (c->value[4] <= l->error || isinf(l->error)) &&
           (!l->equal_area || (info->properties & CM_EQUAL_AREA) != 0) &&
           (int)info->smooth_face >= l->smooth;
}

static candidate make_candidate(const advice *a, const way *w)
{
    const subject *s = &a->all.subjects[w->subject];
    const cm_statistics(*of)[MEASURES] = s->distortion.of;
    candidate c = {.subject = s, .way = w};
    for (int direction = 0; direction < DIRECTIONS; direction++)
    {
        if ((a->limit.directions >> direction & 1) != 0)
        {
            c.cost = fmax(c.cost, w->time[direction].median);
        }
    }
    c.value[0] = of[CM_QUANTITY_AREA][CM_OVER_FACE].maximum_error;
    c.value[1] = of[CM_QUANTITY_ISOTROPY][CM_OVER_FACE].maximum;
    c.value[2] = of[CM_QUANTITY_DEFORMATION][CM_OVER_FACE].maximum / DEGREE;
    c.value[3] = c.cost;
    c.value[4] = promised_error(s, w);
    c.good = keeps(a, &c);
    return c;
}

static int compare(const void *a, const void *b)
{
    double x = ((const candidate *)a)->cost;
    double y = ((const candidate *)b)->cost;
    return (x > y) - (x < y);
}

static void find_candidates(advice *a)
{
    a->list = allocate(a->all.way_count, sizeof *a->list);
    for (size_t i = 0; i < a->all.way_count; i++)
    {
        a->list[a->count++] = make_candidate(a, &a->all.ways[i]);
    }
    qsort(a->list, a->count, sizeof *a->list, compare);
}

/* ---- Table ---- */

static void print_candidate(const candidate *c)
{
    const timing *t = c->way->time;
    fprintf(harness_out(), "%-20s %6.2f %6.2f %3.0f%%  %10.4g %9.4f %11.2f   %s\n",
            c->subject->specification, t[FORWARD].median, t[INVERSE].median,
            fmax(spread(&t[FORWARD]), spread(&t[INVERSE])), c->value[0] < 1e-12 ? 0.0 : c->value[0],
            c->value[1], c->value[2], isnan(c->value[4]) ? "-" : length_text(c->value[4]));
}

/* What a candidate exceeds, as a sentence's end. */
static void print_excess(const advice *a, const candidate *c)
{
    static const char *const what[] = {"area error", "isotropy", "deformation", "ns", "error"};
    const double limit[] = {a->limit.area_error, a->limit.isotropy, a->limit.deformation,
                            a->limit.ns, a->limit.error};
    const cm_mapping_info *info = cm_mapping_describe(c->subject->mapping);
    const char *before = " ";
    for (int k = 0; k < 5; k++)
    {
        if (isnan(c->value[k]) && !isinf(limit[k]))
        {
            fprintf(harness_out(), "%sno promise of its %s with these parameters", before, what[k]);
            before = "; ";
        }
        else if (c->value[k] > limit[k])
        {
            fprintf(harness_out(), "%s%s %.4g, %.3g more than %g", before, what[k], c->value[k],
                    c->value[k] - limit[k], limit[k]);
            before = "; ";
        }
    }
    if (a->limit.equal_area && (info->properties & CM_EQUAL_AREA) == 0)
    {
        fprintf(harness_out(), "%snot equal-area, area error %.4g", before, c->value[0]);
        before = "; ";
    }
    if ((int)info->smooth_face < a->limit.smooth)
    {
        fprintf(harness_out(), "%snot so smooth", before);
    }
    fprintf(harness_out(), "\n");
}

/* From the next cheaper one down. */
static void print_cheaper(const advice *a, size_t first_good)
{
    const candidate *good = &a->list[first_good];
    if (first_good == 0)
    {
        fprintf(harness_out(), "\nNone is cheaper than %s.\n", good->subject->specification);
        return;
    }
    fprintf(harness_out(), "\nCheaper than %s, but:\n", good->subject->specification);
    for (size_t i = first_good; i-- > 0;)
    {
        const candidate *c = &a->list[i];
        fprintf(harness_out(), "%-20s %6.2f ns, %.0f %% less:", c->subject->specification, c->cost,
                100.0 * (1.0 - c->cost / good->cost));
        print_excess(a, c);
    }
}

static void print_failures(const advice *a)
{
    fprintf(harness_out(), "\nNo mapping qualifies. What each exceeds:\n");
    for (size_t i = 0; i < a->count; i++)
    {
        fprintf(harness_out(), "%-20s", a->list[i].subject->specification);
        print_excess(a, &a->list[i]);
    }
}

static void print_advice(const advice *a, size_t first_good)
{
    fprintf(harness_out(), "%s, arrays of %zu points, %s; %s\n\n", precision_names[a->precision],
            a->all.set.points, cm_mapping_instructions(a->all.ways[0].mapping), system_cpu());
    fprintf(harness_out(), "%-20s %13s   %10s %9s %11s   %s\n%-20s %6s %6s   %10s %9s %11s   %s\n",
            "", "ns a point", "area error", "isotropy", "deformation", "round trip", "mapping",
            "fwd", "inv", "|D_A - 1|", "D_I", "degrees", "at most");
    for (size_t i = 0; i < a->count; i++)
    {
        if (a->list[i].good)
        {
            print_candidate(&a->list[i]);
        }
    }
    if (first_good < a->count)
    {
        print_cheaper(a, first_good);
    }
    else
    {
        print_failures(a);
    }
}

/* ---- JSON ---- */

static void write_advice(FILE *out, const advice *a)
{
    static const char *const keys[] = {"area_error", "isotropy", "deformation_deg", "cost_ns",
                                       "round_trip_bound_m"};
    const double limit[] = {a->limit.area_error, a->limit.isotropy, a->limit.deformation,
                            a->limit.ns, a->limit.error};
    fprintf(out, "{\n  ");
    json_text(out, "program", "cubemap-bench advise");
    json_text(out, "version", cm_version());
    json_machine(out);
    json_text(out, "instructions", cm_mapping_instructions(a->all.subjects[0].mapping));
    json_text(out, "precision", precision_names[a->precision]);
    fprintf(out, "\n  \"limits\": {");
    for (int k = 0; k < 5; k++)
    {
        json_number(out, keys[k], limit[k]);
    }
    fprintf(out, "\"equal_area\": %s},\n  \"candidates\": [",
            a->limit.equal_area ? "true" : "false");
    for (size_t i = 0; i < a->count; i++)
    {
        const candidate *c = &a->list[i];
        const cm_mapping_info *info = cm_mapping_describe(c->subject->mapping);
        fprintf(out, "%s\n    {", i == 0 ? "" : ",");
        json_text(out, "specification", c->subject->specification);
        for (int k = 0; k < 5; k++)
        {
            json_number(out, keys[k], c->value[k]);
        }
        json_number(out, "ns_forward", c->way->time[FORWARD].median);
        json_number(out, "ns_inverse", c->way->time[INVERSE].median);
        fprintf(out, "\"equal_area\": %s, \"qualifies\": %s}",
                info->properties & CM_EQUAL_AREA ? "true" : "false", c->good ? "true" : "false");
    }
    fprintf(out, "\n  ]\n}\n");
}

/* ---- Program ---- */

static int run(advice *a)
{
    output json;
    if (!output_open(&json, a->json))
    {
        return 1;
    }
    measure_times(&a->all, (stage){0.0, 0.6});
    for (size_t i = 0; i < a->all.subject_count; i++)
    {
        distort(a->all.subjects[i].mapping, 1e-2, 0, &a->all.subjects[i].distortion);
        stage_progress((stage){0.6, 1.0}, i + 1, a->all.subject_count, "distortion");
    }
    progress(NULL);
    find_candidates(a);
    size_t first_good = 0;
    while (first_good < a->count && !a->list[first_good].good)
    {
        first_good++;
    }
    if (json.file != harness_out())
    {
        print_advice(a, first_good);
    }
    if (json.file != NULL)
    {
        write_advice(json.file, a);
    }
    int good = output_close(&json);
    good &= close_standard_output() == 0;
    return !good || first_good == a->count;
}

int advise(int argc, char **argv, const cm_streams *streams)
{
    advice a = {.limit = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL, 0, 0, 3},
                .all = {.set = {.points = 8192, .repetitions = 30, .form = FORM_ARRAY}}};
    int status = read_options(&a, argc, argv, streams);
    if (status < 0)
    {
        a.all.set.precision = a.precision;
        a.all.set.all_tiers = 1;
        status = suite_prepare(&a.all) ? run(&a) : 1;
    }
    free(a.list);
    suite_close(&a.all);
    return status;
}
