/* SPDX-License-Identifier: MIT
 *
 * The results as a table for people, as CSV and as JSON.
 */
#include "side_by_side.h"

#include "truth/length_text.h"

#include <math.h>
#include <string.h>

static const char *const direction_names[DIRECTIONS] = {"forward", "inverse"};

/* ---- Table ---- */

static void print_direction(FILE *out, const contestant *c, int direction)
{
    const timing *t = &c->time[direction];
    if (c->absent >> direction & 1u) /* it is the exact one again */
    {
        fprintf(out, "  %8s %8s %5s %7s", "-", "-", "-", "-");
        return;
    }
    fprintf(out, "  %8.2f %8.2f %4.0f%% %7.2f", t->best, t->median, spread(t), c->ratio[direction]);
}

static void print_row(FILE *out, const contestant *c)
{
    char label[128];
    char refused[32] = "";
    contestant_label(c, label, sizeof label);
    if (c->refused != 0)
    {
        snprintf(refused, sizeof refused, "%lu", c->refused);
    }
    fprintf(out, "%-34s %-5s", label, c->unit == 0.0 ? "xyz" : c->unit == 1.0 ? "rad" : "deg");
    print_direction(out, c, FORWARD);
    print_direction(out, c, INVERSE);
    fprintf(out, "  %10s %10s %7s\n", length_text(c->worst_random), length_text(c->worst_hard),
            refused);
}

static void print_notes(FILE *out, const roster *all, const char *group)
{
    for (size_t i = 0; i < all->count; i++)
    {
        const contestant *c = &all->list[i];
        if (strcmp(c->group, group) == 0 && c->note[0] != '\0')
        {
            fprintf(out, "    %s %s: %s\n", c->library, c->name, c->note);
        }
    }
}

static void print_group(FILE *out, const roster *all, const char *group)
{
    fprintf(out, "\n%-40s  %-31s  %-31s  %s\n", group, "forward", "inverse", "worst round trip");
    fprintf(out, "%-34s %-5s", "", "takes");
    for (int direction = 0; direction < DIRECTIONS; direction++)
    {
        fprintf(out, "  %8s %8s %5s %7s", "best", "median", "+-", "ratio");
    }
    fprintf(out, "  %10s %10s %7s\n", "random", "hard", "refused");
    for (size_t i = 0; i < all->count; i++)
    {
        if (strcmp(all->list[i].group, group) == 0)
        {
            print_row(out, &all->list[i]);
        }
    }
    print_notes(out, all, group);
}

/* Is it the first of its library? */
static int is_first(const roster *all, size_t index)
{
    for (size_t i = 0; i < index; i++)
    {
        if (strcmp(all->list[i].library, all->list[index].library) == 0)
        {
            return 0;
        }
    }
    return 1;
}

static void print_versions(FILE *out, const roster *all)
{
    fprintf(out, "libcubemap %s", cm_version());
    for (size_t i = 0; i < all->count; i++)
    {
        if (!all->list[i].own && is_first(all, i))
        {
            fprintf(out, ", %s %s", all->list[i].library, all->list[i].version);
        }
    }
    fprintf(out, "\n");
}

void print_table(FILE *out, const roster *all, const settings *set)
{
    print_versions(out, all);
    fprintf(out, "%s; %s\n%s %s\n", system_cpu(), system_name(), system_compiler(), system_flags());
    fprintf(
        out,
        "\n"
        "Arrays of %zu points on one core, %zu interleaved repetitions, with other points each,\n"
        "up to 2^17: processors learn by heart what comes again. Nanoseconds a point: the best,\n"
        "the median, and half the distance of the quartiles in per cent of it; ratio: to\n"
        "libcubemap's fastest exact double path in the same repetition, the median. Worst round\n"
        "trip: the angle between a direction and what comes back, on Earth, at %zu random points\n"
        "and at hard ones; refused: so many of these have no answer. takes: unit vectors, or\n"
        "longitude and latitude in radians or degrees, as each library's own functions do;\n"
        "nothing is converted in the time but in \"from lon, lat\", which is libcubemap with its\n"
        "conversions both ways.\n",
        set->points, set->repetitions, set->random_count);
    for (size_t i = 0; i < all->group_count; i++)
    {
        print_group(out, all, all->groups[i]);
    }
}

/* Of the short ones 1, 2, 3, 4, 6, 8, 12, ...; JSON has them all. */
static int is_printed(size_t points)
{
    size_t odd = points;
    while (odd % 2 == 0)
    {
        odd /= 2;
    }
    return points > 64 || odd == 1 || odd == 3;
}

static void print_scaling_head(FILE *out, const scaling *rows, size_t first, size_t end)
{
    fprintf(out, "%10s", "points");
    for (size_t i = first; i < end; i++)
    {
        fprintf(out, " %9.9s", rows->rows[i].who->specification);
    }
    fprintf(out, "\n%10s", "");
    for (size_t i = first; i < end; i++)
    {
        fprintf(out, " %9.9s", rows->rows[i].who->path);
    }
    fprintf(out, "\n");
}

/* A column for each contestant, a line for each length; the rows of a length follow one another. */
static void print_scaling_of(FILE *out, const scaling *rows, int narrow, int direction)
{
    int begun = 0;
    size_t end;
    for (size_t first = 0; first < rows->count; first = end)
    {
        size_t points = rows->rows[first].points;
        for (end = first; end < rows->count && rows->rows[end].points == points; end++)
        {
        }
        if (rows->rows[first].who->narrow != narrow || !is_printed(points))
        {
            continue;
        }
        if (!begun)
        {
            fprintf(out, "\nns a point against the length of the array, %s, %s\n",
                    narrow ? "float" : "double", direction_names[direction]);
            print_scaling_head(out, rows, first, end);
            begun = 1;
        }
        fprintf(out, "%10zu", points);
        for (size_t i = first; i < end; i++)
        {
            fprintf(out, " %9.2f", rows->rows[i].best[direction]);
        }
        fprintf(out, "\n");
    }
}

void print_scaling(FILE *out, const scaling *rows)
{
    for (int narrow = 0; narrow < 2; narrow++)
    {
        for (int direction = 0; direction < DIRECTIONS; direction++)
        {
            print_scaling_of(out, rows, narrow, direction);
        }
    }
}

/* ---- CSV ---- */

void print_csv(FILE *out, const roster *all)
{
    fprintf(out, "library,version,mapping,specification,name,precision,path,tier,takes,direction,"
                 "ns_best,ns_lower_quartile,ns_median,ns_upper_quartile,ratio,worst_random_m,"
                 "worst_hard_m,refused,tried,note\n");
    for (size_t i = 0; i < all->count; i++)
    {
        const contestant *c = &all->list[i];
        for (int direction = 0; direction < DIRECTIONS; direction++)
        {
            const timing *t = &c->time[direction];
            fprintf(out,
                    "%s,%s,%s,\"%s\",\"%s\",%s,%s,%s,\"%s\",%s,%.4f,%.4f,%.4f,%.4f,%.4f,%.4g,"
                    "%.4g,%lu,%lu,\"%s\"\n",
                    c->library, c->version, c->group, c->specification, c->name,
                    c->narrow ? "float" : "double", c->path, c->tier, contestant_takes(c),
                    direction_names[direction], t->best, t->lower_quartile, t->median,
                    t->upper_quartile, c->ratio[direction], c->worst_random, c->worst_hard,
                    c->refused, c->tried, c->note);
        }
    }
}

/* ---- JSON ---- */

static void json_who(FILE *out, const contestant *c)
{
    char label[128];
    contestant_label(c, label, sizeof label);
    json_text(out, "label", label);
    json_text(out, "library", c->library);
    json_text(out, "version", c->version);
    json_text(out, "name", c->name);
    json_text(out, "mapping", c->group);
    json_text(out, "specification", c->specification);
    json_text(out, "precision", c->narrow ? "float" : "double");
    json_text(out, "path", c->path);
    json_text(out, "tier", c->tier);
}

static void json_contestant(FILE *out, const contestant *c, int direction, size_t repetitions)
{
    const timing *t = &c->time[direction];
    fprintf(out, "    {");
    json_who(out, c);
    json_text(out, "takes", contestant_takes(c));
    json_text(out, "note", c->note);
    json_text(out, "direction", direction_names[direction]);
    json_number(out, "ns_best", t->best);
    json_number(out, "ns_lower_quartile", t->lower_quartile);
    json_number(out, "ns_median", t->median);
    json_number(out, "ns_upper_quartile", t->upper_quartile);
    json_numbers(out, "ns_samples", c->samples[direction], repetitions);
    json_number(out, "ratio", c->ratio[direction]);
    json_number(out, "worst_random_m", c->worst_random);
    json_number(out, "worst_hard_m", c->worst_hard);
    fprintf(out,
            "\"pixels\": %s, \"array\": %s, \"offered\": %s, \"refused\": %lu, \"tried\": %lu}",
            c->pixels ? "true" : "false", c->array ? "true" : "false",
            c->absent >> direction & 1u ? "false" : "true", c->refused, c->tried);
}

static void json_scaling(FILE *out, const scaling_row *row, int direction)
{
    fprintf(out, "    {");
    json_who(out, row->who);
    json_text(out, "direction", direction_names[direction]);
    json_number(out, "ns", row->best[direction]);
    fprintf(out, "\"points\": %zu}", row->points);
}

static void json_head(FILE *out, const settings *set)
{
    fprintf(out, "{\n  ");
    json_text(out, "program", "side-by-side");
    json_text(out, "version", cm_version());
    json_run(out, set->date);
    fprintf(out, "\n  \"machine\": {");
    json_machine(out);
    fprintf(out, "\"cores_used\": 1},\n");
    fprintf(out,
            "  \"points\": %zu, \"repetitions\": %zu, \"random_points\": %zu, "
            "\"hard_step\": %zu,\n",
            set->points, set->repetitions, set->random_count, set->hard_step);
}

void print_json(FILE *out, const roster *all, const settings *set, const scaling *rows)
{
    json_head(out, set);
    fprintf(out, "  \"contestants\": [");
    for (size_t i = 0; i < DIRECTIONS * all->count; i++)
    {
        fprintf(out, i == 0 ? "\n" : ",\n");
        json_contestant(out, &all->list[i / DIRECTIONS], (int)(i % DIRECTIONS), set->repetitions);
    }
    fprintf(out, "\n  ],\n  \"scaling\": [");
    for (size_t i = 0; i < DIRECTIONS * rows->count; i++)
    {
        fprintf(out, i == 0 ? "\n" : ",\n");
        json_scaling(out, &rows->rows[i / DIRECTIONS], (int)(i % DIRECTIONS));
    }
    fprintf(out, "\n  ]\n}\n");
}
