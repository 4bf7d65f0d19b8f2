/* SPDX-License-Identifier: MIT
 *
 * cubemap-bench advise: the mappings that are good enough, the cheapest first, what the others would cost in
 * distortion, and how much is needed. Times are measured now, on this machine; the rest is the library's
 * (cubemap/advise.h).
 */
#include "advise_work.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/catalogue_name.h"
#include "tools/cli/failure.h"
#include "truth/sphere.h"

/* ---- Options ---- */

enum
{
    AREA = 1,
    AREA_RMSE,
    ISOTROPY,
    ISOTROPY_MEAN,
    ISOTROPY_RMSE,
    DEFORMATION,
    DEFORMATION_MEAN,
    DEFORMATION_RMSE,
    NS,
    ERROR,
    EQUAL,
    SMOOTH,
    EDGE,
    DIRECTION,
    PRECISION,
    FORM,
    ELLIPSOID,
    RESOLUTION,
    SOURCE,
    QUICK,
    JSON
};

static const char *const no_yes[] = {"no", "yes", NULL};
static const char *const smooth_names[] = {"torn", "c0", "c1", "c2", "analytic", NULL};
static const char *const both_directions[] = {"forward", "inverse", "both", NULL};
static const char *const edge_names[] = {"continuous", "smooth", NULL};

static const cm_option limits[] = {
    {.id = AREA,
     .name = "max-area-error",
     .kind = CM_OPTION_NUMBER,
     .argument = "E",
     .help = "greatest |D_A - 1|, D_A the area scale relative to its mean",
     .high = HUGE_VAL},
    {.id = AREA_RMSE,
     .name = "max-area-rmse",
     .kind = CM_OPTION_NUMBER,
     .argument = "E",
     .help = "root mean square of D_A - 1 over the face",
     .high = HUGE_VAL},
    {.id = ISOTROPY,
     .name = "max-isotropy",
     .kind = CM_OPTION_NUMBER,
     .argument = "R",
     .help = "greatest D_I = a / b",
     .low = 1.0,
     .high = HUGE_VAL},
    {.id = ISOTROPY_MEAN,
     .name = "max-isotropy-mean",
     .kind = CM_OPTION_NUMBER,
     .argument = "R",
     .help = "mean D_I over the face",
     .low = 1.0,
     .high = HUGE_VAL},
    {.id = ISOTROPY_RMSE,
     .name = "max-isotropy-rmse",
     .kind = CM_OPTION_NUMBER,
     .argument = "E",
     .help = "root mean square of D_I - 1 over the face",
     .high = HUGE_VAL},
    {.id = DEFORMATION,
     .name = "max-deformation",
     .kind = CM_OPTION_NUMBER,
     .argument = "W",
     .help = "greatest angular deformation in degrees",
     .high = 180.0},
    {.id = DEFORMATION_MEAN,
     .name = "max-deformation-mean",
     .kind = CM_OPTION_NUMBER,
     .argument = "W",
     .help = "its mean over the face",
     .high = 180.0},
    {.id = DEFORMATION_RMSE,
     .name = "max-deformation-rmse",
     .kind = CM_OPTION_NUMBER,
     .argument = "W",
     .help = "its root mean square",
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
     .help = "no torn edges from `c0` on, and at least so smooth on a face",
     .choices = smooth_names},
    {.id = EDGE,
     .name = "edge",
     .kind = CM_OPTION_CHOICE,
     .argument = "E",
     .help = "across the edges of faces",
     .more = "`smooth` is of continuous first derivatives.",
     .standard = "any, torn ones last",
     .choices = edge_names},
};

static const cm_option uses[] = {
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
     .standard = "`double`; with --max-error each that keeps it",
     .choices = precision_names},
    {.id = FORM,
     .name = "form",
     .kind = CM_OPTION_CHOICE,
     .argument = "F",
     .help = "whose times count: of an `array`, or of `single` points, a call for each",
     .standard = "`array`",
     .choices = form_names,
     .flags = CM_OPTION_TOLD},
    {.id = ELLIPSOID,
     .name = "ellipsoid",
     .kind = CM_OPTION_TEXT,
     .argument = "E",
     .help = "points are geographic, on this ellipsoid: a name, or A,1/F",
     .more =
         "Conformal mappings get the conformal latitude, all others the authalic one. Times are "
         "from and to longitude and latitude; what the latitude adds to distortion and error "
         "is in the figures.",
     .choice_at = ellipsoid_name_at},
};

static const cm_option sizes[] = {
    {.id = RESOLUTION,
     .name = "resolution",
     .kind = CM_OPTION_TEXT,
     .argument = "ANGLE",
     .help = "how large a face is to be for pixels of this angle, such as 30arcsec, 0.5deg, "
             "1arcmin, 1e-3rad, 90m or 1km (on Earth)"},
    {.id = SOURCE,
     .name = "source",
     .kind = CM_OPTION_WHOLE,
     .argument = "W",
     .help = "the same for an equirectangular image so many pixels wide",
     .low = 2, /* pixels of half the way around: those of --resolution are no longer */
     .high = 1e12},
};

static const cm_option others[] = {
    {.id = QUICK, .name = "quick", .help = "fewer repetitions"},
    {.id = JSON,
     .name = "json",
     .kind = CM_OPTION_FILE,
     .argument = "FILE",
     .help = "write the candidates there as JSON; - is standard output instead of the table"},
};

#define GROUP(heading, options)                                                                    \
    {                                                                                              \
        heading, options, sizeof(options) / sizeof *(options)                                      \
    }
static const cm_option_group groups[] = {GROUP(NULL, others), GROUP("Limits", limits),
                                         GROUP("Use", uses), GROUP("How big", sizes)};

const cm_command advise_command = {
    .name = "cubemap-bench advise",
    .usage = "[OPTION]... [MAPPING]...",
    .summary =
        "List the mappings that keep every limit, the cheapest first; then those that are cheaper "
        "and do not, with what they miss, and those that are dearer and nearly do: no more than "
        "needed. The cost is the time a point of the slower of the directions that are asked for, "
        "measured now. Without limits all are listed. Distortion may be above its limit by "
        "rounding, 1e-12. MAPPING is as for cubemap-bench; default: the catalogue with its "
        "standard parameters and presets.",
    .groups = groups,
    .group_count = sizeof groups / sizeof *groups,
    .notes = "Exit status: 0 if a mapping qualifies, 1 if none does, 2 for wrong usage.\n\n"
             "Examples:\n"
             "  cubemap-bench advise --max-area-error 0.2 --max-isotropy 1.8 \\\n"
             "      --equal-area no\n"
             "  cubemap-bench advise --equal-area yes --ellipsoid WGS84 --max-error 0.01 \\\n"
             "      --resolution 30arcsec\n",
    .operand = CM_OPTION_TEXT,
    .choice_at = subject_name_at};

/* ---- Reading them ---- */

/* Options that are limits, and the unit that they are in. */
static const struct
{
    int id;
    cm_limit limit;
    double unit;
} limit_options[] = {{AREA, CM_LIMIT_AREA, 1.0},
                     {AREA_RMSE, CM_LIMIT_AREA_RMSE, 1.0},
                     {ISOTROPY, CM_LIMIT_ISOTROPY, 1.0},
                     {ISOTROPY_MEAN, CM_LIMIT_ISOTROPY_MEAN, 1.0},
                     {ISOTROPY_RMSE, CM_LIMIT_ISOTROPY_RMSE, 1.0},
                     {DEFORMATION, CM_LIMIT_DEFORMATION, DEGREE},
                     {DEFORMATION_MEAN, CM_LIMIT_DEFORMATION_MEAN, DEGREE},
                     {DEFORMATION_RMSE, CM_LIMIT_DEFORMATION_RMSE, DEGREE},
                     {NS, CM_LIMIT_COST, 1.0},
                     {ERROR, CM_LIMIT_ERROR, 1.0}};

static void take_limit(cm_advice_request *request, const cm_option_reader *reader, int id)
{
    for (size_t i = 0; i < sizeof limit_options / sizeof *limit_options; i++)
    {
        if (limit_options[i].id == id)
        {
            request->limited |= 1u << limit_options[i].limit;
            request->limit[limit_options[i].limit] = reader->number * limit_options[i].unit;
        }
    }
}

/* The angle that a text says; 0 if it says none. */
static double angle_of(const char *text)
{
    static const struct
    {
        const char *name;
        double radians;
    } units[] = {{"deg", DEGREE}, {"arcmin", DEGREE / 60.0}, {"arcsec", DEGREE / 3600.0},
                 {"rad", 1.0},    {"m", 1.0 / EARTH_RADIUS}, {"km", 1e3 / EARTH_RADIUS}};
    double number = 0.0;
    size_t length = cm_number_read(text, strlen(text), &number);
    double angle = 0.0;
    for (size_t i = 0; i < sizeof units / sizeof *units && length > 0; i++)
    {
        angle = strcmp(text + length, units[i].name) == 0 ? number * units[i].radians : angle;
    }
    return angle > 1e-12 && angle <= 180.0 * DEGREE ? angle : 0.0;
}

/* 0, or what is wrong has been put into the reader's message. */
static int take_text(advice_work *work, cm_option_reader *reader, int id)
{
    char why[200];
    if (id == RESOLUTION)
    {
        work->angle = angle_of(reader->text);
        return work->angle > 0.0
                   ? 0
                   : cm_options_refuse(reader, "an angle above 1e-12 rad and up to 180 degrees "
                                               "with its unit: deg, arcmin, arcsec, rad, m or km");
    }
    if (cm_ellipsoid_parse(reader->text, &work->ellipsoid, why, sizeof why) != CM_OK)
    {
        const cm_nearest nearest = nearest_name(reader->text, ellipsoid_name_at);
        snprintf(reader->message, sizeof reader->message, "%s", why);
        cm_nearest_append(&nearest, reader->message, sizeof reader->message);
        return CM_OPTIONS_WRONG;
    }
    work->request.ellipsoid = &work->ellipsoid;
    return 0;
}

static int take_option(advice_work *work, cm_option_reader *reader, int id)
{
    cm_advice_request *request = &work->request;
    take_limit(request, reader, id);
    switch (id)
    {
    case EQUAL:
        request->equal_area = reader->choice == 1;
        break;
    case SMOOTH:
        request->smooth = (cm_smoothness)reader->choice;
        break;
    case EDGE:
        request->edge = reader->choice == 0 ? CM_SMOOTH_C0 : CM_SMOOTH_C1;
        break;
    case DIRECTION:
        request->directions = (unsigned)reader->choice + 1u;
        break;
    case PRECISION:
        work->precision = (int)reader->choice;
        break;
    case FORM:
        work->all.set.form = (int)reader->choice;
        break;
    case ELLIPSOID:
    case RESOLUTION:
        return take_text(work, reader, id);
    case SOURCE:
        work->angle = 360.0 * DEGREE / reader->number;
        break;
    case QUICK:
        work->all.set.repetitions = 9;
        break;
    case JSON:
        work->json = reader->text;
        break;
    default:
        break;
    }
    return 0;
}

/* What is measured: other precisions than double where they may be an answer. */
static void choose_ways(advice_work *work)
{
    settings *set = &work->all.set;
    cm_advice_request *request = &work->request;
    int has_error = (request->limited >> CM_LIMIT_ERROR & 1u) != 0;
    set->precision = work->precision < 0 && !has_error ? PRECISION_DOUBLE : -1;
    set->all_tiers = work->precision == PRECISION_FAST;
    request->precisions = work->precision < 0 ? 0 : 1u << work->precision;
    request->single = set->form == FORM_SINGLE;
}

/* -1 to go on, or the exit status */
static int read_options(advice_work *work, int argc, char **argv, const cm_streams *streams)
{
    cm_option_reader reader = cm_options_begin(&advise_command, argc, argv, streams);
    int id;
    while ((id = cm_options_next(&reader)) > 0)
    {
        int status = take_option(work, &reader, id);
        if (status != 0)
        {
            return complain(&reader);
        }
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
    choose_ways(work);
    if (work->all.set.form == FORM_SINGLE && work->precision == PRECISION_FAST)
    {
        return usage("--precision fast has no single points: they gain nothing from it", "");
    }
    return suite_add_all(&work->all, reader.operand_count, reader.operands) ? -1 : EXIT_USAGE;
}

/* ---- Program ---- */

static void set_times(const way *w, double ns[DIRECTIONS])
{
    for (int direction = 0; direction < DIRECTIONS; direction++)
    {
        int is_known = w->samples[direction] != NULL;
        ns[direction] = is_known ? w->time[direction].median : (double)NAN;
    }
}

/* A row for each way. 0 if it cannot be done, which has been said. */
static int ask(advice_work *work)
{
    const suite *all = &work->all;
    cm_advice_cost *rows = allocate(all->way_count + 1, sizeof *rows);
    for (size_t i = 0; i < all->way_count; i++)
    {
        const way *w = &all->ways[i];
        rows[i] = (cm_advice_cost){.specification = all->subjects[w->subject].specification,
                                   .precision = (cm_precision)w->precision};
        set_times(w, rows[i].ns);
        set_times(w, rows[i].single_ns);
    }
    const cm_advice_costs costs = {.size = sizeof costs, .count = all->way_count, .cost = rows};
    cm_status status = cm_advise(&work->request, &costs, &work->advice);
    free(rows);
    if (status != CM_OK)
    {
        fprintf(harness_err(), "%s: %s\n", program_name(), cm_status_text(status));
    }
    return status == CM_OK;
}

/* Of each mapping once: the precisions of one have the same. */
static void find_sizes(advice_work *work)
{
    size_t count = cm_advice_qualified(work->advice);
    work->pixels = allocate(count + 1, sizeof *work->pixels);
    for (size_t i = 0; i < count; i++)
    {
        const cm_advice_candidate *c = cm_advice_at(work->advice, i);
        cm_advice_size s = {.size = sizeof s};
        if (cm_advise_size(way_of(work, c)->mapping, work->angle, &s) == CM_OK)
        {
            work->pixels[i] = s.pixels;
        }
    }
}

static int run(advice_work *work)
{
    output json;
    if (!output_open(&json, work->json))
    {
        return 1;
    }
    if (work->request.ellipsoid != NULL)
    {
        measure_grid_times(work, (stage){0.0, 0.5});
    }
    else
    {
        measure_times(&work->all, (stage){0.0, 0.5});
    }
    stage_progress((stage){0.5, 1.0}, 0, 1, "distortion");
    int good = ask(work);
    progress(NULL);
    if (!good)
    {
        output_drop(&json);
        return 1;
    }
    if (work->angle > 0.0)
    {
        find_sizes(work);
    }
    if (json.file != harness_out())
    {
        print_advice(work);
    }
    if (json.file != NULL)
    {
        write_advice(json.file, work);
    }
    good = output_close(&json);
    good &= close_standard_output() == 0;
    return !good || cm_advice_qualified(work->advice) == 0;
}

int advise(int argc, char **argv, const cm_streams *streams)
{
    advice_work work = {.request = {.size = sizeof work.request},
                        .precision = -1,
                        .all = {.set = {.points = 8192, .repetitions = 30, .form = FORM_ARRAY}}};
    int status = read_options(&work, argc, argv, streams);
    if (status < 0)
    {
        status = suite_prepare(&work.all) ? run(&work) : 1;
    }
    cm_advice_destroy(work.advice);
    free(work.pixels);
    suite_close(&work.all);
    return status;
}
