/* SPDX-License-Identifier: MIT
 *
 * cubemap-bench papers: the tables of papers beside the same figures computed here.
 */
#include "papers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/catalogue_name.h"

static const struct
{
    const char *name;
    const char *title;
    void (*compute)(table *t, resolution r);
} tables[] = {
    {"survey", "Lambers 2020, table 1: area D_A and isotropy D_I", compute_survey},
    {"optima", "Lambers 2020: optimal parameters", compute_optima},
    {"terrain", "Dimitrijevic, Lambers, Rancic 2016, table 5.1: texel aspect and area",
     compute_terrain},
    {"grid", "Dimitrijevic et al. 2020, table I: angular and areal distortion", compute_grid},
    {"s2", "s2geometry, s2coords.h: ratios of cells", compute_s2},
};

#define TABLES (sizeof tables / sizeof tables[0])

/* ---- Options ---- */

enum
{
    FINE = 1,
    MARKDOWN,
    CHECK
};

static const char *table_name_at(size_t index)
{
    return index < TABLES ? tables[index].name : NULL;
}

static const cm_option option_table[] = {
    {.id = FINE,
     .name = "fine",
     .help = "a finer grid for terrain: 8000 points along an edge instead of 4000"},
    {.id = MARKDOWN, .name = "markdown", .help = "as a table for documents"},
    {.id = CHECK,
     .name = "check",
     .help = "exit status 1 if a figure that should agree does not, or one agrees that should not"},
};

static const cm_option_group groups[] = {
    {NULL, option_table, sizeof option_table / sizeof *option_table}};

const cm_command papers_command = {
    .name = "cubemap-bench papers",
    .usage = "[OPTION]... [TABLE]...",
    .summary =
        "Compute the tables that papers have printed, and print each figure as it is there, as it "
        "is computed, the difference, and whether the two agree in the digits that are printed. "
        "Where they do not, a note says why.\n\n"
        "  survey    Lambers 2020, survey of cube mappings, table 1\n"
        "  optima    the same, the parameters that it calls optimal\n"
        "  terrain   Dimitrijevic, Lambers, Rancic 2016, planet-sized terrain, table 5.1\n"
        "  grid      Dimitrijevic et al. 2020, discrete global grids, table I\n"
        "  s2        s2geometry, s2coords.h, the table of projections\n",
    .groups = groups,
    .group_count = 1,
    .operand = CM_OPTION_TEXT,
    .choice_at = table_name_at};

/* ---- Figures ---- */

cm_mapping *paper_mapping(const char *specification)
{
    cm_mapping *mapping = NULL;
    cm_status status = cm_mapping_create(specification, cm_frame_find("geo"), &mapping);
    if (status != CM_OK)
    {
        fprintf(harness_err(), "%s: %s: %s\n", program_name(), specification,
                cm_status_text(status));
        harness_end();
    }
    return mapping;
}

void add_figure(table *t, const char *row, const char *column, const char *printed, double computed,
                const char *note)
{
    t->figures = grow(t->figures, t->count, sizeof *t->figures);
    figure *f = &t->figures[t->count++];
    *f = (figure){.computed = computed, .expected = note == NULL, .note = note};
    snprintf(f->row, sizeof f->row, "%s", row);
    snprintf(f->column, sizeof f->column, "%s", column);
    snprintf(f->printed, sizeof f->printed, "%s", printed);
}

/* ---- Verdicts ---- */

static int digits_of(const char *printed)
{
    const char *point = strchr(printed, '.');
    return point == NULL ? 0 : (int)strlen(point + 1);
}

static double printed_value(const figure *f)
{
    double value = (double)NAN;
    (void)cm_number_read(f->printed, strlen(f->printed), &value);
    return value;
}

/* The difference in units of the last digit that is printed. */
static double units_apart(const figure *f)
{
    double last = pow(10.0, -digits_of(f->printed));
    return fabs(f->computed - printed_value(f)) / last;
}

/* Does it round to what is printed, or did the paper cut, or round twice? */
static int agrees(const figure *f)
{
    return units_apart(f) <= 1.0 + 1e-6;
}

static int is_legible(const figure *f)
{
    return f->printed[0] != '\0' && f->printed[0] != '?';
}

static const char *verdict(const figure *f)
{
    return f->printed[0] == '\0'                  ? "not in it"
           : !is_legible(f)                       ? "not legible"
           : units_apart(f) <= 0.5 * (1.0 + 1e-6) ? "agrees"
           : agrees(f)                            ? "last digit"
                                                  : "differs";
}

static int is_as_expected(const figure *f)
{
    return !is_legible(f) || agrees(f) == f->expected;
}

/* ---- Printing ---- */

static void print_figure(const figure *f, int markdown)
{
    char difference[24] = "";
    int digits = is_legible(f) ? digits_of(f->printed) + 1 : 4;
    if (is_legible(f))
    {
        double apart = f->computed - printed_value(f);
        double least = 0.5 * pow(10.0, -digits - 1);
        snprintf(difference, sizeof difference, "%+.*f", digits + 1,
                 fabs(apart) < least ? 0.0 : apart);
    }
    fprintf(harness_out(),
            markdown ? "| %s | %s | %s | %.*f | %s | %s |\n" : "%-22s %-18s %8s %10.*f %9s  %s\n",
            f->row, f->column, f->printed, digits, f->computed, difference, verdict(f));
}

/* Each note once, with a number of its own. */
static void print_notes(const table *t, int markdown)
{
    for (size_t i = 0; i < t->count; i++)
    {
        size_t j = 0;
        while (j < i && t->figures[j].note != t->figures[i].note)
        {
            j++;
        }
        if (j == i && t->figures[i].note != NULL)
        {
            fprintf(harness_out(), markdown ? "\n%s, %s: %s\n" : "  %s, %s: %s\n",
                    t->figures[i].row, t->figures[i].column, t->figures[i].note);
        }
    }
}

/* Returns how many figures are not as they should be. */
static size_t print_table(size_t index, resolution r, int markdown)
{
    table t = {0};
    size_t agreeing = 0;
    size_t legible = 0;
    size_t bad = 0;
    progress("%s", tables[index].title);
    tables[index].compute(&t, r);
    progress(NULL);
    fprintf(
        harness_out(),
        markdown
            ? "\n## %s\n\n| | | printed | computed | difference | |\n|---|---|---|---|---|---|\n"
            : "\n%s\n\n%-22.0s %-18.0s  printed   computed difference\n",
        tables[index].title, "", "");
    for (size_t i = 0; i < t.count; i++)
    {
        print_figure(&t.figures[i], markdown);
        legible += (size_t)is_legible(&t.figures[i]);
        agreeing += is_legible(&t.figures[i]) && agrees(&t.figures[i]);
        bad += !is_as_expected(&t.figures[i]);
    }
    fprintf(harness_out(), "%s%zu of %zu legible figures agree.\n", markdown ? "\n" : "  ",
            agreeing, legible);
    print_notes(&t, markdown);
    free(t.figures);
    return bad;
}

/* ---- Program ---- */

typedef struct options
{
    int markdown;
    int check;
    resolution resolution;
    unsigned wanted; /* bits of tables */
} options;

static int take_table(options *o, const char *name)
{
    for (size_t i = 0; i < TABLES; i++)
    {
        if (strcmp(name, tables[i].name) == 0)
        {
            o->wanted |= 1u << i;
            return 1;
        }
    }
    return 0;
}

static void take_option(options *o, int id)
{
    switch (id)
    {
    case FINE:
        o->resolution = (resolution){512, 8000};
        break;
    case MARKDOWN:
        o->markdown = 1;
        break;
    default:
        o->check = 1;
        break;
    }
}

/* -1 to go on, or the exit status */
static int read_options(options *o, int argc, char **argv, const cm_streams *streams)
{
    cm_option_reader reader = cm_options_begin(&papers_command, argc, argv, streams);
    int id;
    while ((id = cm_options_next(&reader)) > 0)
    {
        take_option(o, id);
    }
    if (id != CM_OPTIONS_END)
    {
        return id == CM_OPTIONS_WRONG ? complain(&reader) : close_standard_output();
    }
    for (int i = 0; i < reader.operand_count; i++)
    {
        if (!take_table(o, reader.operands[i]))
        {
            const cm_nearest nearest = nearest_name(reader.operands[i], table_name_at);
            return usage_of_name("no table is called ", reader.operands[i], &nearest);
        }
    }
    char why[200];
    if (cm_instructions_check(NULL, why, sizeof why) != CM_OK)
    {
        return usage(why, "");
    }
    o->wanted = o->wanted == 0 ? (1u << TABLES) - 1 : o->wanted;
    return -1;
}

int papers(int argc, char **argv, const cm_streams *streams)
{
    options o = {.resolution = {512, 4000}};
    int status = read_options(&o, argc, argv, streams);
    size_t bad = 0;
    if (status >= 0)
    {
        return status;
    }
    for (size_t i = 0; i < TABLES; i++)
    {
        if ((o.wanted >> i & 1u) != 0)
        {
            bad += print_table(i, o.resolution, o.markdown);
        }
    }
    if (bad > 0 && o.check)
    {
        fprintf(harness_err(), "%s: %zu figures are not what they were found to be\n",
                program_name(), bad);
    }
    return close_standard_output() != 0 || (o.check && bad > 0);
}
