/* SPDX-License-Identifier: MIT
 *
 * cubemap-bench: which part is to run.
 */
#include "bench.h"

#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/catalogue_name.h"
#include "tools/cli/failure.h"

/* ---- Options ---- */

enum
{
    QUICK = 1,
    JSON,
    CSV,
    PRECISION,
    FORM,
    INSTRUCTIONS,
    POINTS,
    REPETITIONS,
    RANDOM,
    HARD,
    LARGEST,
    MAP,
    TOLERANCE,
    LIST
};

static const char *instructions_at(size_t index)
{
    static const char *const names[] = {"scalar", "sse2", "avx2", "avx512", "neon"};
    return index < sizeof names / sizeof *names ? names[index] : NULL;
}

static const cm_option table[] = {
    {.id = QUICK,
     .name = "quick",
     .help =
         "in some seconds, which the table tells: fewer points and repetitions, no percentiles, no "
         "maps, no lengths; wherever it stands, other options count before it"},
    {.id = JSON,
     .name = "json",
     .kind = CM_OPTION_FILE,
     .argument = "FILE",
     .help = "write all results there as JSON; - is standard output, without tables",
     .more =
         "Date, commit, machine, compiler, flags and every sample are in it: compare reads it."},
    {.id = CSV,
     .name = "csv",
     .kind = CM_OPTION_FILE,
     .argument = "FILE",
     .help = "one line for each way and direction; - as before",
     .more = "Each has the distortion of its mapping."},
    {.id = PRECISION,
     .name = "precision",
     .kind = CM_OPTION_CHOICE,
     .argument = "P",
     .help = "only `double`, `float` or `fast` (double, computed in float)",
     .choices = precision_names,
     .flags = CM_OPTION_TOLD},
    {.id = FORM,
     .name = "form",
     .kind = CM_OPTION_CHOICE,
     .argument = "F",
     .help = "only `array` or `single` (point by point)",
     .choices = form_names,
     .flags = CM_OPTION_TOLD},
    {.id = INSTRUCTIONS,
     .name = "instructions",
     .kind = CM_OPTION_TEXT,
     .argument = "I",
     .help = "`scalar`, `sse2`, `avx2`, `avx512` or `neon`",
     .standard = "what CUBEMAP_INSTRUCTIONS says, else the best there is",
     .choice_at = instructions_at},
    {.id = POINTS,
     .name = "points",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "points an array",
     .standard = "8192",
     .low = 1,
     .high = 1e8},
    {.id = REPETITIONS,
     .name = "repetitions",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "repetitions of everything",
     .standard = "30",
     .low = 1,
     .high = 1e6},
    {.id = RANDOM,
     .name = "random",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "random points for the errors",
     .standard = "20000",
     .low = 1,
     .high = 1e8},
    {.id = HARD,
     .name = "hard",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "hard points for the errors",
     .standard = "20000",
     .low = 1,
     .high = 1e8},
    {.id = LARGEST,
     .name = "largest",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "longest array for the cost against its length",
     .standard = "1000000; 0 for none",
     .high = 1e8},
    {.id = MAP,
     .name = "map",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "map of the errors over a face, N by N",
     .more = "It is in the JSON.",
     .standard = "64; 0 for none",
     .high = 4096},
    {.id = TOLERANCE,
     .name = "tolerance",
     .kind = CM_OPTION_NUMBER,
     .argument = "T",
     .help = "of means of distortion, relative",
     .standard = "1e-9",
     .low = 1e-13,
     .high = 1e-2},
    {.id = LIST, .name = "list", .help = "print the mappings that would be measured and stop"},
};

static const cm_option_group groups[] = {{NULL, table, sizeof table / sizeof *table}};
static const cm_command *const commands[] = {&advise_command, &compare_command, &papers_command,
                                             NULL};

const cm_command cm_bench_command = {
    .name = "cubemap-bench",
    .usage = "[OPTION]... [MAPPING]...\n"
             "advise [OPTION]... [MAPPING]...\n"
             "compare [OPTION]... OLD.json NEW.json\n"
             "papers [OPTION]... [TABLE]...",
    .summary =
        "Measure speed, accuracy and distortion of mappings in one run and print them as tables. "
        "MAPPING is NAME[:PARAMETER=VALUE,...], NAME:PRESET, or a pattern of names such as 'tan*'; "
        "default: the catalogue.\n\n"
        "advise lists the mappings that are good enough, the cheapest first; compare tells what "
        "has "
        "become faster or slower from one run to another; papers computes the tables that papers "
        "have "
        "printed; each has a --help of its own.",
    .groups = groups,
    .group_count = 1,
    .notes = "Examples:\n"
             "  cubemap-bench --quick\n"
             "  cubemap-bench --json results.json coupled qsc 'tangent:c=1.1823'\n"
             "  cubemap-bench compare --gate 5 results.json results-now.json\n"
             "  cubemap-bench advise --max-area-error 0.2 --max-isotropy 1.8\n",
    .operand = CM_OPTION_TEXT,
    .choice_at = subject_name_at,
    .commands = commands};

int usage(const char *what, const char *text)
{
    say(harness_err(), "%s: %s%s; see --help", program_name(), what, text);
    return EXIT_USAGE;
}

int usage_of_name(const char *what, const char *name, const cm_nearest *nearest)
{
    char message[FAILURE_TEXT_MAX];
    snprintf(message, sizeof message, "%s%s", what, name);
    if (nearest->best == NULL)
    {
        return usage(message, "");
    }
    cm_nearest_append(nearest, message, sizeof message);
    say(harness_err(), "%s: %s", program_name(), message);
    return EXIT_USAGE;
}

int complain(const cm_option_reader *reader)
{
    say(harness_err(), "%s: %s", program_name(), reader->message);
    return EXIT_USAGE;
}

typedef struct options
{
    suite all;
    const char *json;
    const char *csv;
    int list;
    unsigned given; /* bits of options */
} options;

/* Other options count before it. */
static void be_quick(settings *set, unsigned given)
{
    const struct
    {
        int id;
        size_t *count;
        size_t quick;
    } counts[] = {{POINTS, &set->points, 4096}, {REPETITIONS, &set->repetitions, 9},
                  {RANDOM, &set->random, 500},  {HARD, &set->hard, 500},
                  {LARGEST, &set->largest, 0},  {MAP, &set->map_pixels, 0}};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
    {
        *counts[i].count = given >> counts[i].id & 1u ? *counts[i].count : counts[i].quick;
    }
    set->tolerance = given >> TOLERANCE & 1u ? set->tolerance : 1e-4;
    set->percentiles = 0;
    set->one_face = 1;
}

/* Where the whole number of an option goes. */
static size_t *count_of(settings *set, int id)
{
    switch (id)
    {
    case POINTS:
        return &set->points;
    case REPETITIONS:
        return &set->repetitions;
    case RANDOM:
        return &set->random;
    case HARD:
        return &set->hard;
    case LARGEST:
        return &set->largest;
    default:
        return &set->map_pixels;
    }
}

static void take_option(options *o, const cm_option_reader *reader, int id)
{
    settings *set = &o->all.set;
    o->given |= 1u << id;
    switch (id)
    {
    case QUICK:
        break; /* when all is known */
    case JSON:
        o->json = reader->text;
        break;
    case CSV:
        o->csv = reader->text;
        break;
    case PRECISION:
        set->precision = (int)reader->choice;
        break;
    case FORM:
        set->form = (int)reader->choice;
        break;
    case INSTRUCTIONS:
        set->instructions = reader->text;
        break;
    case TOLERANCE:
        set->tolerance = reader->number;
        break;
    case LIST:
        o->list = 1;
        break;
    default:
        *count_of(set, id) = (size_t)reader->number;
        break;
    }
}

/* -1 to go on, or the exit status */
static int read_options(options *o, int argc, char **argv, const cm_streams *streams)
{
    cm_option_reader reader = cm_options_begin(&cm_bench_command, argc, argv, streams);
    int id;
    while ((id = cm_options_next(&reader)) > 0)
    {
        take_option(o, &reader, id);
    }
    if (id == CM_OPTIONS_PRINTED)
    {
        return close_standard_output();
    }
    if (id == CM_OPTIONS_WRONG)
    {
        return complain(&reader);
    }
    o->all.set.percentiles = o->json != NULL; /* nothing else tells them */
    if (o->given >> QUICK & 1u)
    {
        be_quick(&o->all.set, o->given);
    }
    char why[200];
    if (cm_instructions_check(o->all.set.instructions, why, sizeof why) != CM_OK)
    {
        return usage(why, "");
    }
    if (!outputs_differ(o->json, o->csv))
    {
        return usage("--json and --csv name the same file: ", o->json);
    }
    return suite_add_all(&o->all, reader.operand_count, reader.operands) ? -1 : EXIT_USAGE;
}

/* ---- Program ---- */

static void measure(suite *all)
{
    date_now(all->date);
    all->began = seconds();
    int has_map = all->set.map_pixels > 0;
    int has_lengths = all->set.largest > 0;
    measure_times(all, (stage){0.0, 0.2});
    measure_errors(all, (stage){0.2, has_map ? 0.6 : 0.5});
    measure_distortion(all, (stage){has_map ? 0.6 : 0.5, has_lengths ? 0.8 : 1.0});
    measure_lengths(all, (stage){0.8, 1.0});
    progress(NULL);
}

static int run(options *o)
{
    output json;
    output csv = {0};
    if (!output_open(&json, o->json))
    {
        return 1;
    }
    if (!output_open(&csv, o->csv))
    {
        output_drop(&json);
        return 1;
    }
    measure(&o->all);
    if (json.file != harness_out() && csv.file != harness_out())
    {
        write_table(harness_out(), &o->all);
    }
    if (json.file != NULL)
    {
        write_json(json.file, &o->all);
    }
    if (csv.file != NULL)
    {
        write_csv(csv.file, &o->all);
    }
    int good = output_close(&json);
    good &= output_close(&csv);
    good &= close_standard_output() == 0;
    return !good;
}

static int bench(int argc, char **argv, const cm_streams *streams)
{
    options o = {.all = {.set = {.points = 8192,
                                 .repetitions = 30,
                                 .random = 20000,
                                 .hard = 20000,
                                 .largest = 1000000,
                                 .map_pixels = 64,
                                 .tolerance = 1e-9,
                                 .precision = -1,
                                 .form = -1}}};
    int status = read_options(&o, argc, argv, streams);
    if (status < 0 && o.list)
    {
        for (size_t i = 0; i < o.all.subject_count; i++)
        {
            fprintf(harness_out(), "%s\n", o.all.subjects[i].specification);
        }
        status = close_standard_output();
    }
    else if (status < 0 && !suite_prepare(&o.all))
    {
        status = 1;
    }
    else if (status < 0)
    {
        status = o.all.way_count > 0 ? run(&o)
                                     : usage("nothing is left with --precision and --form", "");
    }
    suite_close(&o.all);
    return status;
}

static int choose(int argc, char **argv, const cm_streams *streams)
{
    static const struct
    {
        const char *word;
        int (*run)(int argc, char **argv, const cm_streams *streams);
    } parts[] = {{"advise", advise}, {"compare", compare_results}, {"papers", papers}};
    for (size_t i = 0; argc > 1 && i < sizeof parts / sizeof *parts; i++)
    {
        if (strcmp(argv[1], parts[i].word) == 0)
        {
            return parts[i].run(argc - 1, argv + 1, streams);
        }
    }
    return bench(argc, argv, streams);
}

int cm_bench_main(int argc, char **argv, const cm_streams *streams)
{
    jmp_buf end;
    volatile int status = EXIT_FAILURE;
    name_program("cubemap-bench");
    harness_begin(streams->out, streams->err, &end);
    if (setjmp(end) == 0)
    {
        status = choose(argc, argv, streams);
    }
    else
    {
        outputs_abandon();
    }
    harness_begin(NULL, NULL, NULL);
    return status;
}
