/* SPDX-License-Identifier: MIT
 *
 * check-paths: compares each fast path of the library with the scalar reference, and times it on the
 * same data. What is compared is in path_compare.c and path_shapes.c, with what in path_subjects.c and path_inputs.c, and
 * the paths themselves are in path_calls.inc.
 *
 * The exit status is 0 if all is well, 1 if not, 2 for a wrong option, and 77, by which test programs say
 * that they were skipped, if this machine or this build has not the instruction set.
 */
#include "paths.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

static const char usage[] =
    "usage: check-paths [OPTION...]\n"
    "Compares each fast path with the scalar reference at hard points and random ones.\n"
    "  --set NAME               that instruction set (default: each that this machine has)\n"
    "  --mapping SPECIFICATION  that mapping only, as --list writes it\n"
    "  --kinds                  of the mappings only some of each kind: loops are a kind's\n"
    "  --all-shapes             all mappings in all shapes of a call, not some of each kind\n"
    "  --tier exact|fast        that tier of accuracy only\n"
    "  --one-in N               one in N of the 2.5 million hard directions (default: 61)\n"
    "  --thorough               all of them\n"
    "  --quick                  one in 20011 of them, in one frame of three\n"
    "  --bench                  compare only what is timed, and write the times\n"
    "  --list                   list instruction sets, mappings and paths\n"
    "  --help                   write this\n";

static const char *const of_each_kind[] = {"gnomonic",
                                           "qsc",
                                           "cobe:legacy=1",
                                           "zucker-cobe:forward=1",
                                           "zucker-quintic:forward=1",
                                           "healpix",
                                           "octahedral",
                                           "rhealpix",
                                           "square:elliptical",
                                           "azimuthal:mixture:beta=1",
                                           "border:lambert,conformal,lon=20,lat=30",
                                           "quincuncial",
                                           NULL};

typedef struct settings
{
    const char *set;
    const char *mapping;
    int kinds;
    int all_shapes;
    size_t one_in;
    int tiers[2]; /* by cm_tier */
    int quick;
    int bench;
} settings;

static settings chosen = {.one_in = 61, .tiers = {1, 1}};
static const path_table *const tables[2] = {&paths_double, &paths_float};

/* ---- The checks ---- */

static int is_of_kinds(const subject *s)
{
    int is_one = 0;
    for (size_t i = 0; of_each_kind[i] != NULL; i++)
    {
        is_one |= strcmp(of_each_kind[i], s->specification) == 0;
    }
    return is_one;
}

static int is_chosen(const subject *s)
{
    if (chosen.quick && !chosen.bench && strcmp(s->frame->identifier, "turned") != 0)
    {
        return 0;
    }
    return (!chosen.kinds || is_of_kinds(s)) &&
           (chosen.mapping == NULL || strcmp(chosen.mapping, s->specification) == 0);
}

/* Times do not depend on the frame, or hardly. */
static int is_timed(const subject *s)
{
    return is_chosen(s) && strcmp(s->frame->identifier, "geo") == 0 &&
           (s->standard || chosen.mapping != NULL);
}

static void check_subject(const subject *s, extreme (*worst)[PATHS_MAX])
{
    const int all_shapes = chosen.all_shapes || chosen.mapping != NULL || is_of_kinds(s);
    for (int t = 0; t < 2; t++)
    {
        for (size_t k = 0; tables[t]->paths[k].name != NULL; k++)
        {
            const path *p = &tables[t]->paths[k];
            precision judged;
            if (is_path_of(s, &tables[t]->in, p, &judged))
            {
                compare_inputs(s, &judged, p, chosen.one_in, &worst[t][k]);
                check_shapes(s, &judged, p, all_shapes);
            }
            else if (is_exact_in_fast(s, &tables[t]->in, p))
            {
                check_shapes(s, &tables[t]->in, p, all_shapes);
            }
        }
    }
}

static void write_worst(const char *set, cm_tier tier, extreme (*worst)[PATHS_MAX])
{
    for (int t = 0; t < (tier == CM_TIER_FAST ? 1 : 2); t++)
    {
        for (size_t k = 0; tables[t]->paths[k].name != NULL; k++)
        {
            const path *p = &tables[t]->paths[k];
            if (worst[t][k].points == 0)
            {
                continue;
            }
            printf("%-7s %-12s  %-17s %9zu points, apart by %5.1f %s", set,
                   tier == CM_TIER_FAST ? "double, fast" : tables[t]->in.name, p->name,
                   worst[t][k].points, worst[t][k].error, p->measure);
            printf(worst[t][k].error > 0.0 ? " at most, %s\n" : " at most\n", worst[t][k].where);
        }
    }
}

static void check_tier(const char *set, cm_tier tier)
{
    extreme worst[2][PATHS_MAX];
    memset(worst, 0, sizeof worst);
    for (size_t i = 0; i < subject_count(); i++)
    {
        subject s;
        if (make_subject(&s, i, tier, set) && is_chosen(&s))
        {
            check_subject(&s, worst);
        }
        drop_subject(&s);
    }
    write_worst(set, tier, worst);
}

static void check_set(const char *set)
{
    for (int tier = 0; tier < 2; tier++)
    {
        if (chosen.tiers[tier])
        {
            check_tier(set, (cm_tier)tier);
        }
    }
}

static void time_set(const char *set)
{
    printf("ns a point, arrays in cache, random points\n");
    for (size_t k = 0; tables[0]->paths[k].name != NULL; k++)
    {
        if (tables[0]->paths[k].timed)
        {
            time_path(tables, k, set, is_timed);
        }
    }
    printf("\n");
}

/* ---- Command line ---- */

static int is_here(const char *set)
{
    cm_options options = {.size = sizeof options, .instructions = set};
    cm_mapping *mapping = NULL;
    cm_status status = cm_mapping_create_with("gnomonic", NULL, &options, &mapping);
    cm_mapping_destroy(mapping);
    return status == CM_OK;
}

static int is_mapping(const char *specification)
{
    int found = 0;
    for (size_t i = 0; i < subject_count(); i++)
    {
        subject s;
        make_subject(&s, i, CM_TIER_EXACT, "scalar");
        found |= strcmp(s.specification, specification) == 0;
        drop_subject(&s);
    }
    return found;
}

static int is_tier(const char *name)
{
    return strcmp(name, "exact") == 0 || strcmp(name, "fast") == 0;
}

static void list(void)
{
    printf("instruction sets:");
    for (size_t i = 0; i < cm_instructions_count(); i++)
    {
        printf(" %s", cm_instructions_at(i));
    }
    printf("\nmappings:");
    for (size_t i = 0; i < subject_count(); i++)
    {
        subject s;
        make_subject(&s, i, CM_TIER_EXACT, "scalar");
        if (strcmp(s.frame->identifier, "geo") == 0)
        {
            printf(" %s", s.specification);
        }
        drop_subject(&s);
    }
    printf("\npaths:\n");
    for (size_t k = 0; tables[0]->paths[k].name != NULL; k++)
    {
        printf("  %s:", tables[0]->paths[k].name);
        for (const form *f = tables[0]->paths[k].forms; f->name != NULL; f++)
        {
            printf("%s %s", f == tables[0]->paths[k].forms ? "" : ";", f->name);
        }
        printf("\n");
    }
}

static int wrong_option(const char *text)
{
    fprintf(stderr, "check-paths: '%s' is not right\n%s", text, usage);
    return 2;
}

/* The exit status if the program is to end at once, else -1. */
static int read_options(int argc, char **argv)
{
    for (int i = 1; i < argc; i++)
    {
        const char *value = i + 1 < argc ? argv[i + 1] : NULL;
        if (strcmp(argv[i], "--help") == 0)
        {
            fputs(usage, stdout);
            return 0;
        }
        if (strcmp(argv[i], "--list") == 0)
        {
            list();
            return 0;
        }
        if (strcmp(argv[i], "--bench") == 0)
        {
            chosen.bench = 1;
        }
        else if (strcmp(argv[i], "--thorough") == 0)
        {
            chosen.one_in = 1;
        }
        else if (strcmp(argv[i], "--kinds") == 0)
        {
            chosen.kinds = 1;
        }
        else if (strcmp(argv[i], "--all-shapes") == 0)
        {
            chosen.all_shapes = 1;
        }
        else if (strcmp(argv[i], "--quick") == 0)
        {
            chosen.quick = 1;
            chosen.one_in = 20011;
        }
        else if (strcmp(argv[i], "--set") == 0 && value != NULL)
        {
            chosen.set = argv[++i];
        }
        else if (strcmp(argv[i], "--mapping") == 0 && value != NULL && is_mapping(value))
        {
            chosen.mapping = argv[++i];
        }
        else if (strcmp(argv[i], "--tier") == 0 && value != NULL && is_tier(value))
        {
            chosen.tiers[CM_TIER_EXACT] = strcmp(value, "exact") == 0;
            chosen.tiers[CM_TIER_FAST] = strcmp(argv[++i], "fast") == 0;
        }
        else if (strcmp(argv[i], "--one-in") == 0 && value != NULL && atoll(value) > 0)
        {
            chosen.one_in = (size_t)atoll(argv[++i]);
        }
        else
        {
            return wrong_option(argv[i]);
        }
    }
    return -1;
}

/* Thousands of arrays are made and dropped, each to end where its memory ends; most of the time would go to the system,
 * which gives pages and takes them back. */
static void keep_memory(void)
{
#ifdef __GLIBC__
    (void)mallopt(M_MMAP_THRESHOLD, 1 << 30);
    (void)mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

int main(int argc, char **argv)
{
    int status = read_options(argc, argv);
    keep_memory();
    if (status >= 0)
    {
        return status;
    }
    if (chosen.set != NULL && !is_here(chosen.set))
    {
        printf("this machine or this build has no %s\n", chosen.set);
        return 77;
    }
    for (size_t i = 0; i < cm_instructions_count(); i++)
    {
        const char *set = cm_instructions_at(i);
        if (chosen.set == NULL ? i > 0 : strcmp(chosen.set, set) == 0)
        {
            (chosen.bench ? time_set : check_set)(set);
        }
    }
    if (complaint_count() > 0)
    {
        printf("%zu complaints, of which the first %d are above\n", complaint_count(),
               COMPLAINTS_WRITTEN);
    }
    return complaint_count() > 0;
}
