/* SPDX-License-Identifier: MIT
 *
 * cubemap-bench advise: the mappings that are good enough, the cheapest first, and what those that are
 * cheaper would cost in distortion. Times are measured now, on this machine.
 */
#include "bench.h"

#include "truth/length_text.h"
#include "truth/sphere.h"

#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: cubemap-bench advise [OPTION]... [MAPPING]...\n"
    "\n"
    "List the mappings that keep every limit, the cheapest first; then those that are cheaper and "
    "do\n"
    "not, with what they exceed: no more than needed. The cost is the time a point of the slower "
    "of\n"
    "the directions that are asked for, in arrays, measured now. Without limits all are listed.\n"
    "MAPPING is as for cubemap-bench; default: the catalogue with its standard parameters.\n"
    "\n"
    "      --max-area-error E    greatest |D_A - 1|, D_A the area scale relative to its mean\n"
    "      --max-isotropy R      greatest D_I = a / b, 1 or more\n"
    "      --max-deformation W   greatest angular deformation in degrees\n"
    "      --max-ns T            nanoseconds a point\n"
    "      --max-error M         promised bound of a round trip, in metres on Earth\n"
    "      --equal-area yes|no   only those that are exactly equal-area; no: all (the default)\n"
    "      --smooth S            at least so smooth on a face: c0, c1 or analytic\n"
    "      --direction D         forward, inverse or both (the default)\n"
    "      --precision P         double (the default), float or fast\n"
    "      --quick               fewer repetitions\n"
    "      --json FILE           write the candidates there as JSON; - is standard output instead "
    "of\n"
    "                            the table\n"
    "  -h, --help                print this and stop\n"
    "\n"
    "Exit status: 0 if a mapping qualifies, 1 if none does, 2 for wrong usage.\n"
    "\n"
    "Example:\n"
    "  cubemap-bench advise --max-area-error 0.2 --max-isotropy 1.8 --max-ns 5 --equal-area no\n";

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

enum
{
    AREA = 256,
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

static const struct option long_options[] = {
    {"max-area-error", required_argument, NULL, AREA},
    {"max-isotropy", required_argument, NULL, ISOTROPY},
    {"max-deformation", required_argument, NULL, DEFORMATION},
    {"max-ns", required_argument, NULL, NS},
    {"max-error", required_argument, NULL, ERROR},
    {"equal-area", required_argument, NULL, EQUAL},
    {"smooth", required_argument, NULL, SMOOTH},
    {"direction", required_argument, NULL, DIRECTION},
    {"precision", required_argument, NULL, PRECISION},
    {"quick", no_argument, NULL, QUICK},
    {"json", required_argument, NULL, JSON},
    {"help", no_argument, NULL, 'h'},
    {NULL, 0, NULL, 0},
};

/* 0 if the argument is no good */
static int take_word(advice *a, int option)
{
    static const char *const no_yes[] = {"no", "yes", NULL};
    static const char *const smooth[] = {"torn", "c0", "c1", "analytic", NULL};
    static const char *const directions[] = {"", "forward", "inverse", "both", NULL};
    int *to = option == EQUAL       ? &a->limit.equal_area
              : option == SMOOTH    ? &a->limit.smooth
              : option == DIRECTION ? &a->limit.directions
                                    : &a->precision;
    const char *const *words = option == EQUAL       ? no_yes
                               : option == SMOOTH    ? smooth
                               : option == DIRECTION ? directions
                                                     : precision_names;
    int index = find_word(optarg, words);
    if (index < 0 || (option == DIRECTION && index == 0))
    {
        return 0;
    }
    *to = index;
    return 1;
}

static int take_option(advice *a, int option)
{
    switch (option)
    {
    case AREA:
        return read_number(optarg, 0.0, HUGE_VAL, &a->limit.area_error);
    case ISOTROPY:
        return read_number(optarg, 1.0, HUGE_VAL, &a->limit.isotropy);
    case DEFORMATION:
        return read_number(optarg, 0.0, 180.0, &a->limit.deformation);
    case NS:
        return read_number(optarg, 0.0, HUGE_VAL, &a->limit.ns);
    case ERROR:
        return read_number(optarg, 0.0, HUGE_VAL, &a->limit.error);
    case QUICK:
        a->all.set.repetitions = 9;
        return 1;
    case JSON:
        a->json = optarg;
        return 1;
    default:
        return take_word(a, option);
    }
}

static const char *right_for(int option)
{
    switch (option)
    {
    case ISOTROPY:
        return "a number from 1 on";
    case DEFORMATION:
        return "a number from 0 to 180";
    case EQUAL:
        return "yes or no";
    case SMOOTH:
        return "c0, c1 or analytic";
    case DIRECTION:
        return "forward, inverse or both";
    case PRECISION:
        return "double, float or fast";
    default:
        return "a number from 0 on";
    }
}

/* -1 to go on, or the exit status */
static int read_options(advice *a, int argc, char **argv)
{
    int option;
    while ((option = getopt_long(argc, argv, "h", long_options, NULL)) != -1)
    {
        if (option == 'h')
        {
            fputs(help, stdout);
            return close_standard_output();
        }
        if (option == '?')
        {
            return 2; /* getopt_long has said why */
        }
        if (!take_option(a, option))
        {
            return usage_of(option_name(long_options, option), optarg, right_for(option));
        }
    }
    char why[200];
    if (cm_instructions_check(NULL, why, sizeof why) != CM_OK)
    {
        return usage(why, "");
    }
    for (int i = optind; i < argc; i++)
    {
        if (!suite_add(&a->all, argv[i]))
        {
            return 2;
        }
    }
    return optind < argc || suite_add(&a->all, "*") ? -1 : 2;
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
    printf("%-20s %6.2f %6.2f %3.0f%%  %10.4g %9.4f %11.2f   %s\n", c->subject->specification,
           t[FORWARD].median, t[INVERSE].median, fmax(spread(&t[FORWARD]), spread(&t[INVERSE])),
           c->value[0] < 1e-12 ? 0.0 : c->value[0], c->value[1], c->value[2],
           isnan(c->value[4]) ? "-" : length_text(c->value[4]));
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
            printf("%sno promise of its %s with these parameters", before, what[k]);
            before = "; ";
        }
        else if (c->value[k] > limit[k])
        {
            printf("%s%s %.4g, %.3g more than %g", before, what[k], c->value[k],
                   c->value[k] - limit[k], limit[k]);
            before = "; ";
        }
    }
    if (a->limit.equal_area && (info->properties & CM_EQUAL_AREA) == 0)
    {
        printf("%snot equal-area, area error %.4g", before, c->value[0]);
        before = "; ";
    }
    if ((int)info->smooth_face < a->limit.smooth)
    {
        printf("%snot so smooth", before);
    }
    printf("\n");
}

/* From the next cheaper one down. */
static void print_cheaper(const advice *a, size_t first_good)
{
    const candidate *good = &a->list[first_good];
    if (first_good == 0)
    {
        printf("\nNone is cheaper than %s.\n", good->subject->specification);
        return;
    }
    printf("\nCheaper than %s, but:\n", good->subject->specification);
    for (size_t i = first_good; i-- > 0;)
    {
        const candidate *c = &a->list[i];
        printf("%-20s %6.2f ns, %.0f %% less:", c->subject->specification, c->cost,
               100.0 * (1.0 - c->cost / good->cost));
        print_excess(a, c);
    }
}

static void print_failures(const advice *a)
{
    printf("\nNo mapping qualifies. What each exceeds:\n");
    for (size_t i = 0; i < a->count; i++)
    {
        printf("%-20s", a->list[i].subject->specification);
        print_excess(a, &a->list[i]);
    }
}

static void print_advice(const advice *a, size_t first_good)
{
    printf("%s, arrays of %zu points, %s; %s\n\n", precision_names[a->precision], a->all.set.points,
           cm_mapping_instructions(a->all.ways[0].mapping), system_cpu());
    printf("%-20s %13s   %10s %9s %11s   %s\n%-20s %6s %6s   %10s %9s %11s   %s\n", "",
           "ns a point", "area error", "isotropy", "deformation", "round trip", "mapping", "fwd",
           "inv", "|D_A - 1|", "D_I", "degrees", "at most");
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
    if (json.file != stdout)
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

int advise(int argc, char **argv)
{
    advice a = {.limit = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL, 0, 0, 3},
                .all = {.set = {.points = 8192, .repetitions = 30, .form = FORM_ARRAY}}};
    int status = read_options(&a, argc, argv);
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
