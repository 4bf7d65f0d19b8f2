/* SPDX-License-Identifier: MIT
 *
 * The results as a table for people, as CSV and as JSON. Angles are in degrees here.
 */
#include "bench.h"

#include "tools/cli/known_digits.h"
#include "truth/length_text.h"

#include <math.h>
#include <string.h>

static const cm_mapping_info *info_of(const subject *s)
{
    return cm_mapping_describe(s->mapping);
}

/* What a quantity is divided by to be written. */
static double unit_of(int quantity)
{
    return quantity == CM_QUANTITY_DEFORMATION ? DEGREE : 1.0;
}

static double worst_of(const errors *e)
{
    return fmax(e->worst_random, e->worst_hard);
}

/* ---- Table ---- */

static const char *error_text(double metres)
{
    return isnan(metres) ? "-" : length_text(metres);
}

static void print_direction(FILE *out, const way *w, int direction)
{
    const timing *t = &w->time[direction];
    if (!w->offered[direction])
    {
        fprintf(out, "  %7s %4s %9s %9s", "-", "-", "-", "-");
        return;
    }
    fprintf(out, "  %7.2f %3.0f%% %9s %9s", t->median, spread(t),
            error_text(worst_of(&w->error[direction])), error_text(w->error[direction].rms_random));
}

static void print_ways(FILE *out, const suite *all)
{
    fprintf(out, "\n%-36s  %-32s  %s\n", "", "forward", "inverse");
    fprintf(out, "%-20s %-6s %-8s", "mapping", "", "");
    for (int direction = 0; direction < DIRECTIONS; direction++)
    {
        fprintf(out, "  %7s %4s %9s %9s", "ns", "+-", "worst", "RMS");
    }
    fprintf(out, "\n");
    for (size_t i = 0; i < all->way_count; i++)
    {
        const way *w = &all->ways[i];
        int first = i == 0 || all->ways[i - 1].subject != w->subject;
        fprintf(out, "%-20s %-6s %-8s", first ? all->subjects[w->subject].specification : "",
                precision_names[w->precision], form_names[w->form]);
        print_direction(out, w, FORWARD);
        print_direction(out, w, INVERSE);
        fprintf(out, "\n");
    }
}

static void print_distortion(FILE *out, const suite *all)
{
    fprintf(out,
            "\nDistortion; means over the face, equal areas of the map alike\n"
            "%-20s %-29s  %-20s  %-12s  %-13s  %s\n"
            "%-20s %7s %6s %7s %6s  %6s %6s %6s  %5s %6s  %6s %6s  %6s %6s\n",
            "", "area D_A", "isotropy D_I", "deformation", "texel aspect", "texel area", "mapping",
            "least", "most", "error", "RMSE", "mean", "most", "RMSE", "mean", "most", "least",
            "most", "least", "most");
    for (size_t i = 0; i < all->subject_count; i++)
    {
        const subject *s = &all->subjects[i];
        const cm_statistics *area = &s->distortion.of[CM_QUANTITY_AREA][CM_OVER_FACE];
        const cm_statistics *isotropy = &s->distortion.of[CM_QUANTITY_ISOTROPY][CM_OVER_FACE];
        const cm_statistics *bent = &s->distortion.of[CM_QUANTITY_DEFORMATION][CM_OVER_FACE];
        const cm_statistics *aspect = &s->distortion.of[CM_QUANTITY_TEXEL_ASPECT][CM_OVER_FACE];
        const cm_statistics *texel = &s->distortion.of[CM_QUANTITY_TEXEL_AREA][CM_OVER_FACE];
        char area_rmse[KNOWN_TEXT_SIZE];
        char isotropy_mean[KNOWN_TEXT_SIZE];
        char isotropy_rmse[KNOWN_TEXT_SIZE];
        char bent_mean[KNOWN_TEXT_SIZE];
        fprintf(out,
                "%-20s %7.4f %6.4f %7.4f %6s  %6s %6.4g %6s  %5s %6.2f  %6.4f %6.4f  "
                "%6.4f %6.4f\n",
                s->specification, area->minimum, area->maximum, area->maximum_error,
                known_text(area->rmse, area->rmse_error, 4, area_rmse),
                known_text(isotropy->mean, isotropy->mean_error, 4, isotropy_mean),
                isotropy->maximum,
                known_text(isotropy->rmse, isotropy->rmse_error, 4, isotropy_rmse),
                known_text(bent->mean / DEGREE, bent->mean_error / DEGREE, 2, bent_mean),
                bent->maximum / DEGREE, aspect->minimum, aspect->maximum, texel->minimum,
                texel->maximum);
    }
}

/* The times of a length in one precision; NULL if it was not measured. */
static const length_row *row_of(const subject *s, size_t points, int precision)
{
    for (size_t i = 0; i < s->length_count; i++)
    {
        if (s->lengths[i].points == points && s->lengths[i].precision == precision)
        {
            return &s->lengths[i];
        }
    }
    return NULL;
}

static void print_lengths(FILE *out, const subject *s)
{
    if (s->lengths == NULL)
    {
        return;
    }
    fprintf(out, "\n%s: ns a point against the length of the array, the best of some\n%10s",
            s->specification, "points");
    for (int k = 0; k < 2 * DIRECTIONS; k++)
    {
        fprintf(out, " %8s %-7s", precision_names[k / DIRECTIONS], direction_names[k % DIRECTIONS]);
    }
    fprintf(out, "\n");
    for (size_t i = 0; i < s->length_count; i++)
    {
        size_t points = s->lengths[i].points;
        if (s->lengths[i].precision != s->lengths[0].precision)
        {
            break; /* the other precision's lengths are the same */
        }
        fprintf(out, "%10zu", points);
        for (int precision = PRECISION_DOUBLE; precision <= PRECISION_FLOAT; precision++)
        {
            const length_row *l = row_of(s, points, precision);
            for (int direction = 0; direction < DIRECTIONS; direction++)
            {
                char text[32] = "-";
                if (l != NULL)
                {
                    snprintf(text, sizeof text, "%.2f", l->ns[direction]);
                }
                fprintf(out, " %16s", text);
            }
        }
        fprintf(out, "\n");
    }
}

void write_table(FILE *out, const suite *all)
{
    const settings *set = &all->set;
    fprintf(out, "cubemap-bench (libcubemap) %s, commit %s; %s, %.1f s\n", cm_version(),
            system_commit(), all->date, seconds() - all->began);
    fprintf(out, "%s; %s; instructions %s\n%s %s\n\n", system_cpu(), system_name(),
            cm_mapping_instructions(all->subjects[0].mapping), system_compiler(), system_flags());
    fprintf(
        out,
        "Times: nanoseconds a point, the median of %zu interleaved repetitions over %zu points\n"
        "on one core, and half the distance of the quartiles in per cent of it. Errors: angles\n"
        "on Earth from the truth, the worst of %zu random and %zu hard points, and the RMS of\n"
        "the random ones. fast: arrays of double, computed in float.\n",
        set->repetitions, set->points, set->random, set->hard);
#ifndef HAVE_QUADMATH
    fprintf(out, "This build has no quadruple precision, which errors are measured by.\n");
#endif
    print_ways(out, all);
    print_distortion(out, all);
    for (size_t i = 0; i < all->subject_count; i++)
    {
        print_lengths(out, &all->subjects[i]);
    }
}

/* ---- CSV ---- */

/* "," and the number, or nothing for it if it is none */
static void csv_number(FILE *out, double value)
{
    if (isfinite(value))
    {
        fprintf(out, ",%.9g", value);
    }
    else
    {
        fprintf(out, ",%s", isinf(value) ? "inf" : "");
    }
}

/* The same of a number that is known to within an error. */
static void csv_known(FILE *out, double value, double error)
{
    char text[KNOWN_TEXT_SIZE];
    known_text(value, error, 9, text);
    fprintf(out, ",%s", strcmp(text, "-") == 0 ? "" : text);
}

static void csv_head(FILE *out)
{
    fprintf(out, "mapping,precision,form,direction,ns_best,ns_lower_quartile,ns_median,"
                 "ns_upper_quartile,worst_random_m,rms_random_m,worst_hard_m,rms_hard_m");
    for (size_t k = 0; k < QUANTITIES; k++)
    {
        char name[32];
        snprintf(name, sizeof name, "%s%s", cm_quantity_name(k),
                 k == CM_QUANTITY_DEFORMATION ? "_deg" : "");
        for (char *c = name; *c != '\0'; c++)
        {
            *c = *c == '-' ? '_' : *c;
        }
        fprintf(
            out,
            ",%s_min,%s_max,%s_max_error,%s_mean_face,%s_rmse_face,%s_mean_sphere,%s_rmse_sphere",
            name, name, name, name, name, name, name);
    }
    fprintf(out, ",version,cpu,system,compiler,flags,instructions\n");
}

/* "," and a text between quotation marks */
static void csv_text(FILE *out, const char *text)
{
    fputs(",\"", out);
    for (; *text != '\0'; text++)
    {
        fputs(*text == '"' ? "\"\"" : (char[]){*text, '\0'}, out);
    }
    fputc('"', out);
}

static void csv_machine(FILE *out, const way *w)
{
    const char *const texts[] = {cm_version(),   system_cpu(),
                                 system_name(),  system_compiler(),
                                 system_flags(), cm_mapping_instructions(w->mapping)};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
    {
        csv_text(out, texts[i]);
    }
}

static void csv_distortion(FILE *out, const distortion *d)
{
    for (int k = 0; k < QUANTITIES; k++)
    {
        const cm_statistics *face = &d->of[k][CM_OVER_FACE];
        const cm_statistics *sphere = &d->of[k][CM_OVER_SPHERE];
        const double extremes[] = {face->minimum, face->maximum, face->maximum_error};
        for (size_t i = 0; i < sizeof extremes / sizeof extremes[0]; i++)
        {
            csv_number(out, extremes[i] / unit_of(k));
        }
        csv_known(out, face->mean / unit_of(k), face->mean_error / unit_of(k));
        csv_known(out, face->rmse / unit_of(k), face->rmse_error / unit_of(k));
        csv_known(out, sphere->mean / unit_of(k), sphere->mean_error / unit_of(k));
        csv_known(out, sphere->rmse / unit_of(k), sphere->rmse_error / unit_of(k));
    }
}

void write_csv(FILE *out, const suite *all)
{
    csv_head(out);
    for (size_t i = 0; i < all->way_count * DIRECTIONS; i++)
    {
        const way *w = &all->ways[i / DIRECTIONS];
        int direction = (int)(i % DIRECTIONS);
        const timing *t = &w->time[direction];
        const errors *e = &w->error[direction];
        const double values[] = {t->best,           t->lower_quartile, t->median,
                                 t->upper_quartile, e->worst_random,   e->rms_random,
                                 e->worst_hard,     e->rms_hard};
        if (!w->offered[direction])
        {
            continue;
        }
        fprintf(out, "\"%s\",%s,%s,%s", all->subjects[w->subject].specification,
                precision_names[w->precision], form_names[w->form], direction_names[direction]);
        for (size_t k = 0; k < sizeof values / sizeof values[0]; k++)
        {
            csv_number(out, values[k]);
        }
        csv_distortion(out, &all->subjects[w->subject].distortion);
        csv_machine(out, w);
        fprintf(out, "\n");
    }
}

/* ---- JSON ---- */

/* "key": number, 15 digits, null if it is not finite; before says what comes before */
static void json_exact(FILE *out, const char *before, const char *key, double value)
{
    fprintf(out, isfinite(value) ? "%s\"%s\": %.15g" : "%s\"%s\": null", before, key, value);
}

/* The same of a number that is known to within an error: its known decimals, and null if it has none. */
static void json_known(FILE *out, const char *before, const char *key, double value, double error)
{
    char text[KNOWN_TEXT_SIZE];
    known_text(value, error, 15, text);
    fprintf(out, "%s\"%s\": %s", before, key,
            isfinite(value) && strcmp(text, "-") != 0 ? text : "null");
}

static void json_place(FILE *out, const char *key, uint8_t face, const double uv[2])
{
    fprintf(out, ", \"%s\": {\"face\": %d, \"u\": %.9g, \"v\": %.9g}", key, face, uv[0], uv[1]);
}

static void json_means(FILE *out, const distortion *d, int quantity, int measure)
{
    const cm_statistics *s = &d->of[quantity][measure];
    double unit = unit_of(quantity);
    fprintf(out, ", \"over_%s\": {", measure_names[measure]);
    json_known(out, "", "mean", s->mean / unit, s->mean_error / unit);
    json_exact(out, ", ", "mean_error", s->mean_error / unit);
    json_known(out, ", ", "rmse", s->rmse / unit, s->rmse_error / unit);
    json_exact(out, ", ", "rmse_error", s->rmse_error / unit);
    fprintf(out, ", \"percentiles\": {");
    for (int i = 0; i < PERCENTILES; i++)
    {
        char key[16];
        snprintf(key, sizeof key, "%g", percentiles[i]);
        json_known(out, i == 0 ? "" : ", ", key, d->percentile[quantity][measure][i] / unit,
                   d->doubt[quantity][measure] / unit);
    }
    fprintf(out, "}");
    json_exact(out, ", ", "percentiles_error", d->doubt[quantity][measure] / unit);
    fprintf(out, "}");
}

static void json_quantity(FILE *out, const distortion *d, int quantity)
{
    const cm_statistics *s = &d->of[quantity][CM_OVER_FACE];
    double unit = unit_of(quantity);
    fprintf(out, "        \"%s\": {\"unit\": \"%s\"", cm_quantity_name((size_t)quantity),
            quantity == CM_QUANTITY_DEFORMATION ? "degree" : "1");
    json_exact(out, ", ", "ideal", s->ideal / unit);
    json_exact(out, ", ", "minimum", s->minimum / unit);
    json_exact(out, ", ", "maximum", s->maximum / unit);
    json_exact(out, ", ", "maximum_error", s->maximum_error / unit);
    /* a least value of 0 is rounding */
    json_exact(out, ", ", "ratio", s->ideal == 0.0 ? (double)NAN : s->ratio);
    json_place(out, "minimum_at", s->minimum_face, s->minimum_uv);
    json_place(out, "maximum_at", s->maximum_face, s->maximum_uv);
    json_means(out, d, quantity, CM_OVER_FACE);
    json_means(out, d, quantity, CM_OVER_SPHERE);
    fprintf(out, "}");
}

static void json_way(FILE *out, const suite *all, const way *w, int direction, const char *before)
{
    const timing *t = &w->time[direction];
    const errors *e = &w->error[direction];
    fprintf(out, "%s\n        {", before);
    json_text(out, "precision", precision_names[w->precision]);
    json_text(out, "form", form_names[w->form]);
    json_text(out, "direction", direction_names[direction]);
    json_text(out, "instructions", cm_mapping_instructions(w->mapping));
    json_number(out, "ns_best", t->best);
    json_number(out, "ns_lower_quartile", t->lower_quartile);
    json_number(out, "ns_median", t->median);
    json_number(out, "ns_upper_quartile", t->upper_quartile);
    json_number(out, "ns_spread_percent", spread(t));
    json_number(out, "calls_a_sample", (double)w->calls[direction]);
    json_numbers(out, "ns_samples", w->samples[direction], all->set.repetitions);
    json_number(out, "worst_random_m", e->worst_random);
    json_number(out, "rms_random_m", e->rms_random);
    json_number(out, "worst_hard_m", e->worst_hard);
    json_exact(out, "", "rms_hard_m", e->rms_hard);
    fprintf(out, "}");
}

static void json_ways(FILE *out, const suite *all, size_t index)
{
    const char *before = "";
    fprintf(out, "      \"speed\": [");
    for (size_t i = 0; i < all->way_count * DIRECTIONS; i++)
    {
        const way *w = &all->ways[i / DIRECTIONS];
        if (w->subject == index && w->offered[i % DIRECTIONS])
        {
            json_way(out, all, w, (int)(i % DIRECTIONS), before);
            before = ",";
        }
    }
    fprintf(out, "\n      ]");
}

static void json_lengths(FILE *out, const subject *s)
{
    fprintf(out, ",\n      \"scaling\": [");
    for (size_t i = 0; i < s->length_count * DIRECTIONS; i++)
    {
        const length_row *l = &s->lengths[i / DIRECTIONS];
        fprintf(out,
                "%s\n        {\"precision\": \"%s\", \"direction\": \"%s\", \"points\": %zu, "
                "\"ns\": %.6g}",
                i == 0 ? "" : ",", precision_names[l->precision], direction_names[i % DIRECTIONS],
                l->points, l->ns[i % DIRECTIONS]);
    }
    fprintf(out, "\n      ]");
}

static void json_map(FILE *out, const suite *all, const subject *s)
{
    size_t pixels = all->set.map_pixels;
    if (s->error_map[FORWARD] == NULL)
    {
        return;
    }
    fprintf(out, ",\n      \"error_map\": {\"precision\": \"double\", \"face\": 0, \"pixels\": %zu",
            pixels);
    for (int direction = 0; direction < DIRECTIONS; direction++)
    {
        fprintf(out, ",\n        \"%s_m\": [", direction_names[direction]);
        for (size_t i = 0; i < pixels * pixels; i++)
        {
            double error = s->error_map[direction][i];
            fprintf(out, "%s", i == 0 ? "" : i % pixels == 0 ? ",\n          " : ", ");
            fprintf(out, isfinite(error) ? "%.3g" : "null", error);
        }
        fprintf(out, "]");
    }
    fprintf(out, "}");
}

static void json_subject(FILE *out, const suite *all, size_t index)
{
    static const char *const families[] = {"univariate", "bivariate", "hybrid"};
    const subject *s = &all->subjects[index];
    const cm_mapping_info *info = info_of(s);
    fprintf(out, "%s\n    {\n      ", index == 0 ? "" : ",");
    json_text(out, "specification", s->specification);
    json_text(out, "identifier", info->identifier);
    json_text(out, "name", info->name);
    json_text(out, "family", families[info->family]);
    json_text(out, "smooth_face", cm_smoothness_name(info->smooth_face));
    json_text(out, "smooth_edge", cm_smoothness_name(info->smooth_edge));
    json_text(out, "smooth_corner", cm_smoothness_name(info->smooth_corner));
    fprintf(out, "\"equal_area\": %s, \"conformal\": %s,\n      \"distortion\": {\n",
            info->properties & CM_EQUAL_AREA ? "true" : "false",
            info->properties & CM_CONFORMAL ? "true" : "false");
    for (int k = 0; k < QUANTITIES; k++)
    {
        json_quantity(out, &s->distortion, k);
        fprintf(out, k + 1 < QUANTITIES ? ",\n" : "\n      },\n");
    }
    json_ways(out, all, index);
    json_lengths(out, s);
    json_map(out, all, s);
    fprintf(out, "\n    }");
}

void write_json(FILE *out, const suite *all)
{
    const settings *set = &all->set;
    fprintf(out, "{\n  ");
    json_text(out, "program", program_name());
    json_text(out, "version", cm_version());
    json_run(out, all->date);
    json_number(out, "seconds", seconds() - all->began);
    fprintf(out, "\"format\": 1,\n  \"machine\": {");
    json_machine(out);
    json_text(out, "instructions", cm_mapping_instructions(all->subjects[0].mapping));
    fprintf(out,
            "\"cores_used\": 1},\n  \"settings\": {\"points\": %zu, \"repetitions\": %zu, "
            "\"random_points\": %zu, \"hard_points\": %zu, \"tolerance\": %g},\n  \"mappings\": [",
            set->points, set->repetitions, set->random, set->hard, set->tolerance);
    for (size_t i = 0; i < all->subject_count; i++)
    {
        json_subject(out, all, i);
    }
    fprintf(out, "\n  ]\n}\n");
}
