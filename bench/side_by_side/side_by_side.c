/* SPDX-License-Identifier: MIT
 *
 * Speed and accuracy of this library beside others': what to run and where to write it.
 */
#include "truth/cube_count.h"

#include "side_by_side.h"

#include <getopt.h>
#include <stdlib.h>
#include <string.h>

enum
{
    GROUPS_MAX = 64
};

typedef struct options
{
    settings set;
    int scaling;
    size_t largest;
    int list;
    int count;
    const char *json;
    const char *csv;
    size_t group_count;
    const char *groups[GROUPS_MAX];
} options;

static const char help[] =
    "Usage: side-by-side [OPTION]... [MAPPING]...\n"
    "\n"
    "Time this library's mappings, all to the cube or those named, by every path that this\n"
    "machine can run, beside the other libraries that the program was built with, on the same "
    "points\n"
    "in one interleaved run on one core; and print each one's worst error beside its time.\n"
    "\n"
    "  --points N        points an array (8192)\n"
    "  --repetitions N   of everything (30)\n"
    "  --random N        random points for the errors (100000)\n"
    "  --quick           few repetitions and points, for a look: 10, and 10000\n"
    "  --scaling         also the cost against the length of the array, for gnomonic, coupled and\n"
    "                    tangent, from 1 point to 10^8 or what memory allows\n"
    "  --largest N       longest array for --scaling (100000000)\n"
    "  --json FILE       write all results there as JSON; - is standard output, without the table\n"
    "  --csv FILE        the same as CSV, without --scaling\n"
    "  --list            list the contestants and stop\n"
    "  --count           run each once for callgrind, which scripts/speed --callgrind uses\n"
    "  --help            print this and stop\n";

static int usage(const char *what, const char *text)
{
    fprintf(stderr, "side-by-side: %s%s; try --help\n", what, text);
    return 2;
}

static int read_count(const char *text, size_t *count)
{
    double value;
    if (!cm_number_parse(text, strlen(text), &value) || !(value >= 1.0) || !(value <= 1e9))
    {
        return 0;
    }
    *count = (size_t)value;
    return 1;
}

enum
{
    POINTS = 256,
    REPETITIONS,
    RANDOM,
    QUICK,
    SCALING,
    LARGEST,
    JSON,
    CSV,
    LIST,
    COUNT,
    HELP
};

static const struct option long_options[] = {
    {"points", required_argument, NULL, POINTS},
    {"repetitions", required_argument, NULL, REPETITIONS},
    {"random", required_argument, NULL, RANDOM},
    {"quick", no_argument, NULL, QUICK},
    {"scaling", no_argument, NULL, SCALING},
    {"largest", required_argument, NULL, LARGEST},
    {"json", required_argument, NULL, JSON},
    {"csv", required_argument, NULL, CSV},
    {"list", no_argument, NULL, LIST},
    {"count", no_argument, NULL, COUNT},
    {"help", no_argument, NULL, HELP},
    {NULL, 0, NULL, 0},
};

/* 0 if the option's argument is no good */
static int take_option(options *o, int option)
{
    switch (option)
    {
    case POINTS:
        return read_count(optarg, &o->set.points);
    case REPETITIONS:
        return read_count(optarg, &o->set.repetitions);
    case RANDOM:
        return read_count(optarg, &o->set.random_count);
    case LARGEST:
        return read_count(optarg, &o->largest);
    case QUICK:
        o->set.repetitions = 10;
        o->set.random_count = 10000;
        o->set.hard_step = 50;
        return 1;
    case SCALING:
        o->scaling = 1;
        return 1;
    case JSON:
        o->json = optarg;
        return 1;
    case CSV:
        o->csv = optarg;
        return 1;
    case LIST:
        o->list = 1;
        return 1;
    default:
        o->count = 1;
        return 1;
    }
}

/* The mappings named, each once, or the catalogue. */
static int take_mappings(options *o, char **names, int count)
{
    char why[160];
    for (int i = 0; i < count; i++)
    {
        if (cm_specification_check(names[i], why, sizeof why) != CM_OK)
        {
            return usage(why, "");
        }
        roster so_far = {.groups = o->groups, .group_count = o->group_count};
        if (!roster_wants(&so_far, names[i]) && o->group_count < GROUPS_MAX)
        {
            o->groups[o->group_count++] = names[i];
        }
    }
    for (size_t i = 0; count == 0 && i < cube_count() && i < GROUPS_MAX; i++)
    {
        o->groups[o->group_count++] = cm_catalogue_at(i)->identifier;
    }
    return 0;
}

/* -1 to go on, or the exit status */
static int read_options(options *o, int argc, char **argv)
{
    int option;
    while ((option = getopt_long(argc, argv, "h", long_options, NULL)) != -1)
    {
        if (option == HELP || option == 'h')
        {
            fputs(help, stdout);
            return 0;
        }
        if (option == '?')
        {
            return 2; /* getopt_long has said why */
        }
        if (!take_option(o, option))
        {
            return usage("not a number from 1 to 1e9: ", optarg);
        }
    }
    int bad = take_mappings(o, argv + optind, argc - optind);
    return bad != 0 ? bad : -1;
}

/* The libraries that the program is built with. */
static int add_all(roster *all)
{
    return add_own(all) && add_kernels(all)
#ifdef HAVE_WCSLIB
           && add_wcslib(all)
#endif
#ifdef HAVE_PROJ
           && add_proj(all)
#endif
#ifdef HAVE_CHEALPIX
           && add_chealpix(all)
#endif
#ifdef HAVE_S2
           && add_s2(all)
#endif
#ifdef HAVE_GEOGRAPHICLIB
           && add_geographiclib(all)
#endif
        ;
}

static void list_contestants(const roster *all)
{
    for (size_t i = 0; i < all->count; i++)
    {
        char label[128];
        contestant_label(&all->list[i], label, sizeof label);
        printf("%-12s %s\n", all->list[i].group, label);
    }
}

static int measure(const options *o, roster *all)
{
    output json;
    output csv;
    scaling lengths = {0};
    if (!output_open(&json, o->json) || !output_open(&csv, o->csv))
    {
        return 1;
    }
    time_all(all, o->set.points, o->set.repetitions);
    measure_accuracy(all, o->set.random_count, o->set.hard_step);
    if (o->scaling)
    {
        measure_scaling(all, o->largest, o->set.repetitions, &lengths);
    }
    if (json.file != stdout && csv.file != stdout)
    {
        print_table(stdout, all, &o->set);
        print_scaling(stdout, &lengths);
    }
    if (json.file != NULL)
    {
        print_json(json.file, all, &o->set, &lengths);
    }
    if (csv.file != NULL)
    {
        print_csv(csv.file, all);
    }
    free(lengths.rows);
    int good = output_close(&json);
    good &= output_close(&csv);
    return !good || fflush(stdout) != 0;
}

int main(int argc, char **argv)
{
    name_program("side-by-side");
    static options o = {.set = {8192, 30, 100000, 1, ""}, .largest = 100000000};
    int status = read_options(&o, argc, argv);
    if (status >= 0)
    {
        return status;
    }
    roster all = {.groups = o.groups, .group_count = o.group_count};
    int good = add_all(&all);
    roster_sort(&all);
    if (!good)
    {
        status = 1;
    }
    else if (o.list)
    {
        list_contestants(&all);
        status = 0;
    }
    else if (o.count)
    {
        status = !count_all(&all, o.set.points);
        if (status != 0)
        {
            fprintf(stderr, "side-by-side: built without valgrind/callgrind.h, cannot --count\n");
        }
    }
    else
    {
        date_now(o.set.date);
        status = measure(&o, &all);
    }
    roster_close(&all);
    return status;
}
