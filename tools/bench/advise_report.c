/* SPDX-License-Identifier: MIT
 *
 * The answer of cubemap-bench advise: a row for each mapping that qualifies, what others miss, and how much is needed.
 */
#include "advise_work.h"

#include "truth/length_text.h"
#include "truth/sphere.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

const way *way_of(const advice_work *work, const cm_advice_candidate *candidate)
{
    return &work->all.ways[candidate->index];
}

static const char *edge_word(const cm_advice_candidate *c)
{
    return c->info->smooth_edge == CM_SMOOTH_TORN ? "torn"
           : c->info->smooth_edge == CM_SMOOTH_C0 ? "continuous"
                                                  : "smooth";
}

static int is_limited(const advice_work *work, int limit)
{
    return (work->request.limited >> limit & 1u) != 0;
}

/* Means and RMSE, which have a column only where they are limited; with what they are divided by. */
static const struct
{
    cm_limit limit;
    const char *heading;
    double unit;
} means[] = {{CM_LIMIT_AREA_RMSE, "area RMSE", 1.0},
             {CM_LIMIT_ISOTROPY_MEAN, "D_I mean", 1.0},
             {CM_LIMIT_ISOTROPY_RMSE, "D_I RMSE", 1.0},
             {CM_LIMIT_DEFORMATION_MEAN, "deg mean", DEGREE},
             {CM_LIMIT_DEFORMATION_RMSE, "deg RMSE", DEGREE}};

enum
{
    MEANS = sizeof means / sizeof means[0]
};

/* ---- Rows ---- */

static void print_heading(const advice_work *work)
{
    FILE *out = harness_out();
    fprintf(out, "%-20s %13s   %10s %9s %11s   %-10s", "", "ns a point", "area error", "isotropy",
            "deformation", "round trip");
    for (int k = 0; k < MEANS; k++)
    {
        if (is_limited(work, (int)means[k].limit))
        {
            fprintf(out, " %9s", means[k].heading);
        }
    }
    fprintf(out, "\n%-20s %6s %6s   %10s %9s %11s   %-10s", "mapping", "fwd", "inv", "|D_A - 1|",
            "D_I", "degrees", "at most");
    for (int k = 0; k < MEANS; k++)
    {
        if (is_limited(work, (int)means[k].limit))
        {
            fprintf(out, " %9s", "");
        }
    }
    fprintf(out, "  %-9s  %s\n", "precision", "edges");
}

static void print_candidate(const advice_work *work, const cm_advice_candidate *c)
{
    FILE *out = harness_out();
    const timing *t = way_of(work, c)->time;
    double area = c->value[CM_LIMIT_AREA];
    double error = c->value[CM_LIMIT_ERROR];
    fprintf(out, "%-20s %6.2f %6.2f %3.0f%%  %10.4g %9.4f %11.2f   %-10s", c->specification,
            t[FORWARD].median, t[INVERSE].median, fmax(spread(&t[FORWARD]), spread(&t[INVERSE])),
            area < CM_ADVICE_ROUNDING ? 0.0 : area, c->value[CM_LIMIT_ISOTROPY],
            c->value[CM_LIMIT_DEFORMATION] / DEGREE, isnan(error) ? "-" : length_text(error));
    for (int k = 0; k < MEANS; k++)
    {
        if (is_limited(work, (int)means[k].limit))
        {
            fprintf(out, " %9.4f", c->value[means[k].limit] / means[k].unit);
        }
    }
    fprintf(out, "  %-9s  %s\n", cm_precision_name(c->precision), edge_word(c));
}

/* ---- What others miss ---- */

static void print_reason(const advice_work *work, size_t index)
{
    char text[CM_ADVICE_TEXT];
    cm_advice_reason(work->advice, index, text, sizeof text);
    fprintf(harness_out(), " %s\n", text);
}

static void name_candidate(const cm_advice_candidate *c)
{
    int is_double = c->precision == CM_PRECISION_DOUBLE;
    fprintf(harness_out(), "%-20s%s%s", c->specification, is_double ? "" : " in ",
            is_double ? "" : cm_precision_name(c->precision));
}

/* One line says that another precision would do; the others would be as many as there are mappings. */
static int is_told_once(const cm_advice_candidate *c, int *told)
{
    int is_precision = (c->missed >> CM_LIMIT_PRECISION & 1u) != 0;
    int is_alone = c->missed == 1u << CM_LIMIT_PRECISION && c->is_near;
    if (!is_precision)
    {
        return 0;
    }
    return !is_alone || (*told)++ > 0;
}

/* Those on one side of the first in cost: all that are cheaper, and of the others those that are near. */
static size_t print_side(const advice_work *work, int cheaper)
{
    const cm_advice_candidate *first = cm_advice_at(work->advice, 0);
    double cost = first->value[CM_LIMIT_COST];
    size_t printed = 0;
    int told = 0;
    for (size_t i = cm_advice_qualified(work->advice); i < cm_advice_count(work->advice); i++)
    {
        const cm_advice_candidate *c = cm_advice_at(work->advice, i);
        double ratio = c->value[CM_LIMIT_COST] / cost;
        int is_wanted = cheaper ? ratio < 1.0 : ratio >= 1.0 && c->is_near;
        if (!is_wanted || is_told_once(c, &told))
        {
            continue;
        }
        if (printed++ == 0)
        {
            fprintf(harness_out(), "\n%s %s%s:\n",
                    cheaper ? "Cheaper than" : "Near, but dearer than", first->specification,
                    cheaper ? ", but" : "");
        }
        name_candidate(c);
        fprintf(harness_out(), " %6.2f ns, %.0f %% %s:", c->value[CM_LIMIT_COST],
                100.0 * fabs(ratio - 1.0), cheaper ? "less" : "more");
        print_reason(work, i);
    }
    return printed;
}

static void print_failures(const advice_work *work)
{
    const cm_advice_candidate *nearest = cm_advice_at(work->advice, 0);
    FILE *out = harness_out();
    fprintf(out, "\nNo mapping qualifies.");
    if (nearest->missed == 1u << CM_LIMIT_PRECISION && nearest->is_near)
    {
        fprintf(out, " But %s would do: %s, %.2f ns, error at most %s.",
                cm_precision_name(nearest->precision), nearest->specification,
                nearest->value[CM_LIMIT_COST], length_text(nearest->value[CM_LIMIT_ERROR]));
    }
    fprintf(out, " What each misses, the nearest first:\n");
    for (size_t i = 0; i < cm_advice_count(work->advice); i++)
    {
        name_candidate(cm_advice_at(work->advice, i));
        print_reason(work, i);
    }
}

/* Torn ones qualify only if nothing was said of edges; then it is said what that means. */
static void print_torn(const advice_work *work)
{
    for (size_t i = 0; i < cm_advice_qualified(work->advice); i++)
    {
        const cm_advice_candidate *c = cm_advice_at(work->advice, i);
        if (c->info->smooth_edge == CM_SMOOTH_TORN)
        {
            fprintf(harness_out(),
                    "\n%s is torn: across some edges of faces what is together on the sphere is "
                    "apart on the "
                    "map.\n--edge continuous leaves it out.\n",
                    c->specification);
            return;
        }
    }
}

/* ---- How big ---- */

static const char *angle_text(double radians)
{
    static char texts[2][40];
    static int next = 0;
    char *text = texts[next++ & 1];
    double arcseconds = radians / DEGREE * 3600.0;
    int unit = arcseconds < 60.0 ? 0 : arcseconds < 3600.0 ? 1 : 2;
    static const double size[] = {1.0, 60.0, 3600.0};
    static const char *const name[] = {"arcsec", "arcmin", "degrees"};
    snprintf(text, sizeof texts[0], "%.4g %s", arcseconds / size[unit], name[unit]);
    return text;
}

static void print_fewest(const advice_work *work)
{
    size_t best = 0;
    size_t count = cm_advice_qualified(work->advice);
    for (size_t i = 1; i < count; i++)
    {
        int is_less = work->pixels[best] == 0 || work->pixels[i] < work->pixels[best];
        best = work->pixels[i] > 0 && is_less ? i : best;
    }
    if (best > 0 && work->pixels[best] < work->pixels[0])
    {
        fprintf(harness_out(), "  fewer are enough with %s: %" PRIu64 ", %.3g %% of the area\n",
                cm_advice_at(work->advice, best)->specification, work->pixels[best],
                100.0 * pow((double)work->pixels[best] / (double)work->pixels[0], 2.0));
    }
}

static void print_size(const advice_work *work, const cm_advice_candidate *c,
                       const cm_mapping *mapping)
{
    FILE *out = harness_out();
    cm_advice_size s = {.size = sizeof s};
    cm_advice_precision p = {.size = sizeof p};
    fprintf(out, "\nHow big, for %s a pixel (%s on Earth) with %s:\n", angle_text(work->angle),
            length_text(work->angle * EARTH_RADIUS), c->specification);
    if (cm_advise_size(mapping, work->angle, &s) != CM_OK)
    {
        fprintf(out, "  no size is enough: the map stands still somewhere\n");
        return;
    }
    fprintf(out,
            "  faces of %" PRIu64 " pixels, the coarsest %s; %" PRIu64
            " as a power of two, %" PRIu64 " on average\n",
            s.pixels, angle_text(s.coarsest), s.power, s.mean_pixels);
    if (s.cheaper > 0)
    {
        fprintf(out,
                "  %" PRIu64 " instead: the coarsest %s, %.3g times what is asked; %.3g %% of the "
                "sphere is coarser\n",
                s.cheaper, angle_text(s.cheaper_coarsest), s.cheaper_coarsest / work->angle,
                100.0 * s.cheaper_share);
    }
    print_fewest(work);
    if (cm_advise_precision(mapping, HUGE_VAL, &p) == CM_OK)
    {
        fprintf(out, "  a round trip in float is off by %s at most, %.2g %% of a pixel\n",
                length_text(p.error), 100.0 * p.error / (work->angle * EARTH_RADIUS));
    }
}

static void print_precision(const advice_work *work, const cm_mapping *mapping)
{
    FILE *out = harness_out();
    cm_advice_precision p = {.size = sizeof p};
    double limit = work->request.limit[CM_LIMIT_ERROR];
    if (work->request.ellipsoid != NULL || !is_limited(work, CM_LIMIT_ERROR) ||
        cm_advise_precision(mapping, limit, &p) != CM_OK)
    {
        return;
    }
    fprintf(out, "\nPrecision, for %s: %s, %s at most", length_text(limit),
            cm_precision_name(p.precision), length_text(p.error));
    if (p.cheaper_error > 0.0)
    {
        fprintf(out, "; float instead: %s", length_text(p.cheaper_error));
    }
    fprintf(out, "\n");
}

static void print_terms(const advice_work *work, const cm_advice_candidate *c)
{
    FILE *out = harness_out();
    cm_advice_terms t = {.size = sizeof t};
    if (work->request.ellipsoid == NULL ||
        cm_advise_terms(&work->ellipsoid, CM_LATITUDE_GEOGRAPHIC, c->latitude, latitude_error(work),
                        &t) != CM_OK)
    {
        return;
    }
    fprintf(out, "\nLatitude: %s, ", cm_latitude_name(c->latitude));
    if (t.terms == 0)
    {
        fprintf(out, "in closed form\n");
        return;
    }
    fprintf(out, "%d term%s of its series, %s cut off, for a tolerance of %.3g rad", t.terms,
            t.terms == 1 ? "" : "s", length_text(t.error), t.tolerance);
    if (t.cheaper_terms > 0)
    {
        fprintf(out, "; with %d %s", t.cheaper_terms, length_text(t.cheaper_error));
    }
    fprintf(out, "\n");
}

static void print_sizes(const advice_work *work)
{
    const cm_advice_candidate *first = cm_advice_at(work->advice, 0);
    const cm_mapping *mapping = way_of(work, first)->mapping;
    if (work->angle > 0.0)
    {
        print_size(work, first, mapping);
    }
    print_precision(work, mapping);
    print_terms(work, first);
}

void print_advice(const advice_work *work)
{
    const suite *all = &work->all;
    size_t qualified = cm_advice_qualified(work->advice);
    fprintf(harness_out(), "%s, %s of %zu points, %s; %s\n\n",
            work->precision < 0 && all->set.precision < 0 ? "all precisions"
            : work->precision < 0                         ? "double"
                                                          : precision_names[work->precision],
            work->request.single ? "calls for each" : "arrays", all->set.points,
            cm_mapping_instructions(all->ways[0].mapping), system_cpu());
    print_heading(work);
    for (size_t i = 0; i < qualified; i++)
    {
        print_candidate(work, cm_advice_at(work->advice, i));
    }
    if (qualified == 0)
    {
        print_failures(work);
        return;
    }
    print_torn(work);
    if (print_side(work, 1) == 0)
    {
        fprintf(harness_out(), "\nNone is cheaper than %s.\n",
                cm_advice_at(work->advice, 0)->specification);
    }
    print_side(work, 0);
    print_sizes(work);
}

/* ---- JSON ---- */

static const struct
{
    const char *key;
    double unit;
} values[CM_LIMIT_NUMBERS] = {[CM_LIMIT_AREA] = {"area_error", 1.0},
                              [CM_LIMIT_AREA_RMSE] = {"area_rmse", 1.0},
                              [CM_LIMIT_ISOTROPY] = {"isotropy", 1.0},
                              [CM_LIMIT_ISOTROPY_MEAN] = {"isotropy_mean", 1.0},
                              [CM_LIMIT_ISOTROPY_RMSE] = {"isotropy_rmse", 1.0},
                              [CM_LIMIT_DEFORMATION] = {"deformation_deg", DEGREE},
                              [CM_LIMIT_DEFORMATION_MEAN] = {"deformation_mean_deg", DEGREE},
                              [CM_LIMIT_DEFORMATION_RMSE] = {"deformation_rmse_deg", DEGREE},
                              [CM_LIMIT_COST] = {"cost_ns", 1.0},
                              [CM_LIMIT_ERROR] = {"round_trip_bound_m", 1.0}};

static void write_candidate(FILE *out, const advice_work *work, size_t index)
{
    const cm_advice_candidate *c = cm_advice_at(work->advice, index);
    const way *w = way_of(work, c);
    char reason[CM_ADVICE_TEXT];
    cm_advice_reason(work->advice, index, reason, sizeof reason);
    json_text(out, "specification", c->specification);
    for (int k = 0; k < CM_LIMIT_NUMBERS; k++)
    {
        json_number(out, values[k].key, c->value[k] / values[k].unit);
    }
    json_number(out, "ns_forward", w->time[FORWARD].median);
    json_number(out, "ns_inverse", w->time[INVERSE].median);
    json_text(out, "precision", cm_precision_name(c->precision));
    json_text(out, "edges", edge_word(c));
    json_text(out, "latitude", cm_latitude_name(c->latitude));
    if (work->pixels != NULL && c->missed == 0)
    {
        fprintf(out, "\"face_pixels\": %" PRIu64 ", ", work->pixels[index]);
    }
    json_number(out, "rank", c->missed == 0 ? (double)(index + 1) : (double)NAN);
    json_text(out, "misses", reason);
    fprintf(out, "\"near\": %s, \"equal_area\": %s, \"qualifies\": %s}",
            c->is_near ? "true" : "false", c->info->properties & CM_EQUAL_AREA ? "true" : "false",
            c->missed == 0 ? "true" : "false");
}

typedef struct place
{
    double cost;
    size_t index;
} place;

static int compare_places(const void *a, const void *b)
{
    const place *one = a;
    const place *other = b;
    return one->cost != other->cost ? (one->cost > other->cost ? 1 : -1)
                                    : (one->index > other->index) - (one->index < other->index);
}

void write_advice(FILE *out, const advice_work *work)
{
    size_t count = cm_advice_count(work->advice);
    place *by_cost = allocate(count + 1, sizeof *by_cost);
    for (size_t i = 0; i < count; i++)
    {
        by_cost[i] = (place){cm_advice_at(work->advice, i)->value[CM_LIMIT_COST], i};
    }
    qsort(by_cost, count, sizeof *by_cost, compare_places);
    fprintf(out, "{\n  ");
    json_text(out, "program", "cubemap-bench advise");
    json_text(out, "version", cm_version());
    json_machine(out);
    json_text(out, "instructions", cm_mapping_instructions(work->all.subjects[0].mapping));
    json_text(out, "precision", work->precision < 0 ? "any" : precision_names[work->precision]);
    json_text(out, "form", form_names[work->all.set.form]);
    json_text(out, "ellipsoid",
              work->request.ellipsoid == NULL ? "" : work->request.ellipsoid->identifier);
    json_number(out, "pixel_deg", work->angle > 0.0 ? work->angle / DEGREE : (double)NAN);
    fprintf(out, "\n  \"limits\": {");
    for (int k = 0; k < CM_LIMIT_NUMBERS; k++)
    {
        json_number(out, values[k].key,
                    is_limited(work, k) ? work->request.limit[k] / values[k].unit : (double)NAN);
    }
    fprintf(out, "\"equal_area\": %s},\n  \"candidates\": [",
            work->request.equal_area ? "true" : "false");
    for (size_t i = 0; i < count; i++)
    {
        fprintf(out, "%s\n    {", i == 0 ? "" : ",");
        write_candidate(out, work, by_cost[i].index);
    }
    fprintf(out, "\n  ]\n}\n");
    free(by_cost);
}
