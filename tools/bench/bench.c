/* SPDX-License-Identifier: MIT
 *
 * cubemap-bench: which part is to run.
 */
#include "bench.h"

#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: cubemap-bench [OPTION]... [MAPPING]...\n"
    "       cubemap-bench advise [OPTION]... [MAPPING]...\n"
    "       cubemap-bench papers [OPTION]... [TABLE]...\n"
    "\n"
    "Measure speed, accuracy and distortion of mappings in one run and print them as tables. "
    "MAPPING\n"
    "is NAME[:PARAMETER=VALUE,...], NAME:PRESET, or a pattern of names such as 'tan*'; default: "
    "the\n"
    "catalogue.\n"
    "advise lists the mappings that are good enough, the cheapest first; papers computes the "
    "tables\n"
    "that papers have printed; each has a --help of its own.\n"
    "\n"
    "      --quick            in some seconds: fewer points and repetitions, no maps, no lengths;\n"
    "                         wherever it stands, other options count before it\n"
    "      --json FILE        write all results there as JSON; - is standard output, without "
    "tables\n"
    "      --csv FILE         one line for each way and direction; - as before\n"
    "      --precision P      only double, float or fast (double, computed in float)\n"
    "      --form F           only array or single (point by point)\n"
    "      --instructions I   scalar, sse2, avx2, avx512 or neon; default: what "
    "CUBEMAP_INSTRUCTIONS\n"
    "                         says, else the best there is\n"
    "      --points N         points an array (8192)\n"
    "      --repetitions N    of everything (30)\n"
    "      --random N         random points for the errors (20000)\n"
    "      --hard N           hard points for the errors (20000)\n"
    "      --largest N        longest array for the cost against its length (1000000; 0 for none)\n"
    "      --map N            map of the errors over a face, N by N (64; 0 for none)\n"
    "      --tolerance T      of means of distortion, relative (1e-9)\n"
    "      --list             print the mappings that would be measured and stop\n"
    "  -h, --help             print this and stop\n"
    "      --version          print the version and stop\n"
    "\n"
    "Examples:\n"
    "  cubemap-bench --quick\n"
    "  cubemap-bench --json results.json coupled qsc 'tangent:c=1.1823'\n"
    "  cubemap-bench advise --max-area-error 0.2 --max-isotropy 1.8 --max-ns 5\n";

enum
{
    QUICK = 256,
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
    LIST,
    VERSION
};

static const struct option long_options[] = {
    {"quick", no_argument, NULL, QUICK},
    {"json", required_argument, NULL, JSON},
    {"csv", required_argument, NULL, CSV},
    {"precision", required_argument, NULL, PRECISION},
    {"form", required_argument, NULL, FORM},
    {"instructions", required_argument, NULL, INSTRUCTIONS},
    {"points", required_argument, NULL, POINTS},
    {"repetitions", required_argument, NULL, REPETITIONS},
    {"random", required_argument, NULL, RANDOM},
    {"hard", required_argument, NULL, HARD},
    {"largest", required_argument, NULL, LARGEST},
    {"map", required_argument, NULL, MAP},
    {"tolerance", required_argument, NULL, TOLERANCE},
    {"list", no_argument, NULL, LIST},
    {"help", no_argument, NULL, 'h'},
    {"version", no_argument, NULL, VERSION},
    {NULL, 0, NULL, 0},
};

typedef struct options
{
    suite all;
    const char *json;
    const char *csv;
    int list;
} options;

/* A whole number; 0 if the text is none. */
static int take_count(const char *text, double low, double high, size_t *count)
{
    double value;
    if (!read_number(text, low, high, &value) || value != floor(value))
    {
        return 0;
    }
    *count = (size_t)value;
    return 1;
}

static int take_word(const char *text, const char *const *words, int *index)
{
    int found = find_word(text, words);
    *index = found < 0 ? *index : found;
    return found >= 0;
}

static void be_quick(settings *set)
{
    set->points = 4096;
    set->repetitions = 9;
    set->random = 1000;
    set->hard = 1000;
    set->largest = 0;
    set->map_pixels = 0;
    set->tolerance = 1e-6;
}

/* What an option's argument can be. */
static const char *right_for(int option)
{
    switch (option)
    {
    case PRECISION:
        return "double, float or fast";
    case FORM:
        return "array or single";
    case TOLERANCE:
        return "a number from 1e-13 to 1e-2";
    case LARGEST:
        return "a whole number from 0 to 100000000";
    case MAP:
        return "a whole number from 0 to 4096";
    case REPETITIONS:
        return "a whole number from 1 to 1000000";
    default:
        return "a whole number from 1 to 100000000";
    }
}

/* 0 if the option's argument is no good */
static int take_option(options *o, int option)
{
    settings *set = &o->all.set;
    switch (option)
    {
    case JSON:
        o->json = optarg;
        return 1;
    case CSV:
        o->csv = optarg;
        return 1;
    case PRECISION:
        return take_word(optarg, precision_names, &set->precision);
    case FORM:
        return take_word(optarg, form_names, &set->form);
    case INSTRUCTIONS:
        set->instructions = optarg;
        return 1;
    case POINTS:
        return take_count(optarg, 1.0, 1e8, &set->points);
    case REPETITIONS:
        return take_count(optarg, 1.0, 1e6, &set->repetitions);
    case RANDOM:
        return take_count(optarg, 1.0, 1e8, &set->random);
    case HARD:
        return take_count(optarg, 1.0, 1e8, &set->hard);
    case LARGEST:
        return take_count(optarg, 0.0, 1e8, &set->largest);
    case MAP:
        return take_count(optarg, 0.0, 4096.0, &set->map_pixels);
    case TOLERANCE:
        return read_number(optarg, 1e-13, 1e-2, &set->tolerance);
    case LIST:
        o->list = 1;
        return 1;
    default:
        return 1; /* QUICK has been taken before */
    }
}

/* First of all, so that other options count wherever it stands. */
static void take_quick(options *o, int argc, char **argv)
{
    int option;
    opterr = 0;
    while ((option = getopt_long(argc, argv, "h", long_options, NULL)) != -1)
    {
        if (option == QUICK)
        {
            be_quick(&o->all.set);
        }
    }
    opterr = 1;
    optind = 1;
}

/* -1 to go on, or the exit status */
static int read_options(options *o, int argc, char **argv)
{
    int option;
    take_quick(o, argc, argv);
    while ((option = getopt_long(argc, argv, "h", long_options, NULL)) != -1)
    {
        if (option == 'h' || option == VERSION)
        {
            printf("%s", option == 'h' ? help : "cubemap-bench (libcubemap) ");
            printf("%s", option == 'h' ? "" : cm_version());
            printf("%s", option == 'h' ? "" : "\n");
            return close_standard_output();
        }
        if (option == '?')
        {
            return 2; /* getopt_long has said why */
        }
        if (!take_option(o, option))
        {
            return usage_of(option_name(long_options, option), optarg, right_for(option));
        }
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
    for (int i = optind; i < argc; i++)
    {
        if (!suite_add(&o->all, argv[i]))
        {
            return 2;
        }
    }
    return optind < argc || suite_add(&o->all, "*") ? -1 : 2;
}

static void measure(suite *all)
{
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
    if (json.file != stdout && csv.file != stdout)
    {
        write_table(stdout, &o->all);
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

static int bench(int argc, char **argv)
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
    int status = read_options(&o, argc, argv);
    if (status < 0 && o.list)
    {
        for (size_t i = 0; i < o.all.subject_count; i++)
        {
            printf("%s\n", o.all.subjects[i].specification);
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

int main(int argc, char **argv)
{
    name_program("cubemap-bench");
    if (argc > 1 && strcmp(argv[1], "advise") == 0)
    {
        argv[1] = argv[0]; /* for messages */
        return advise(argc - 1, argv + 1);
    }
    if (argc > 1 && strcmp(argv[1], "papers") == 0)
    {
        argv[1] = argv[0];
        return papers(argc - 1, argv + 1);
    }
    return bench(argc, argv);
}
