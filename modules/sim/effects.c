/* SPDX-License-Identifier: MIT
 *
 * What each effect does to distances here: a frame with it beside one without.
 */
#include "noise_spread.h"
#include "planned_frame.h"
#include "reconstruct.h"
#include "sampling_spread.h"
#include "sensor.h"
#include "vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum
{
    OVERSAMPLING = 0,
    MULTIPATH,
    VISIBILITY,
    FURTHER_BOUNCES,
    NOISE,
    DISTORTION,
    MOTION,
    BEYOND,
    SAMPLING,
    FURTHER = 4,         /* bounces that stand for all */
    SMALL_PIXELS = 5000, /* of the picture in which scattered light is measured */
    SMALL_PATHS = 32,
    MOTION_TIMES = 8
};

static const char *const names[CM_TOF_EFFECTS] = {"oversampling",
                                                  "multipath",
                                                  "visibility",
                                                  "further bounces",
                                                  "noise",
                                                  "distortion",
                                                  "motion",
                                                  "bounces beyond those given",
                                                  "sampling of scattered light"};

/* Milliseconds that are counted, not measured: how much noise a phase image's pixel takes, and what is least. */
#define MS_OF_NOISE 1.65e-4
#define MS_LEAST 1e-3

/* An effect as it is measured. */
typedef struct effect
{
    cm_budget_entry entry;
    double work;         /* what decides in place of its cost, which is by the clock */
    int is_beyond_given; /* fewer bounces are allowed than it needs */
} effect;

static double milliseconds_of(clock_t ticks)
{
    return 1e3 * (double)ticks / CLOCKS_PER_SEC;
}

/* The root mean square of the change. */
static double change(const planning *with, const planned_frame *a, const planned_frame *b)
{
    double squares = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < a->pixels; i++)
    {
        const double apart =
            planned_frame_apart(with, (double)a->distance[i], (double)b->distance[i]);
        squares += isnan(apart) ? 0.0 : apart * apart;
        count += isnan(apart) ? 0 : 1;
    }
    return count == 0 ? 0.0 : sqrt(squares / (double)count);
}

/* What the second options bring beyond the first. */
static cm_status compare(const planning *with, const cm_tof_sensor *sensor,
                         const cm_tof_sensor *other, const cm_tof_options *without,
                         const cm_tof_options *options, double scale, effect *of)
{
    planned_frame a = {0}, b = a;
    cm_status status = planned_frame_take(with, sensor, without, &a);
    status = status == CM_OK ? planned_frame_take(with, other, options, &b) : status;
    if (status == CM_OK)
    {
        of->entry.contribution = change(with, &a, &b);
        /* a tick at least: by chance the frame with it may take less */
        of->entry.cost = scale * fmax(milliseconds_of(1), b.milliseconds - a.milliseconds);
        of->work = scale * fmax(MS_LEAST, b.work - a.work);
    }
    planned_frame_drop(&a);
    planned_frame_drop(&b);
    return status;
}

/* ---- cameras ---- */

static int has_distortion(const cm_camera *camera)
{
    const cm_camera_options *options = cm_camera_describe(camera);
    int any = 0;
    for (int i = 0; options->mapping == NULL && i < 14; i++)
    {
        any |= options->distortion[i] != 0.0;
    }
    return any;
}

static cm_status make_plain(const cm_camera *camera, cm_camera **plain)
{
    cm_camera_options options = *cm_camera_describe(camera);
    memset(options.distortion, 0, sizeof options.distortion);
    return cm_camera_create(&options, plain);
}

/* ---- effects ---- */

/* From one number of bounces to another, by the same paths as far as both go. */
static cm_status compare_bounces(const planning *with, const cm_tof_sensor *sensor, int fewer,
                                 int more, double scale, effect *of)
{
    const cm_tof_options less = {
        .size = sizeof less, .bounces = fewer, .traces = 1, .paths = SMALL_PATHS};
    cm_tof_options all = less;
    all.bounces = more;
    return compare(with, sensor, sensor, &less, &all, scale, of);
}

/* Of given bounces, 0 for any number, further ones are those up to it, or all where none of them may be taken. */
static cm_status measure_further(const planning *with, const cm_tof_sensor *small, int given,
                                 double scale, effect *of)
{
    const int most = given > 1 ? given : FURTHER;
    cm_status status = compare_bounces(with, small, 1, most, scale, &of[FURTHER_BOUNCES]);
    if (status == CM_OK && most < FURTHER)
    {
        status = compare_bounces(with, small, most, FURTHER, scale, &of[BEYOND]);
    }
    of[MULTIPATH].is_beyond_given = of[VISIBILITY].is_beyond_given = given < 0;
    of[FURTHER_BOUNCES].is_beyond_given = given < 0 || given == 1;
    of[BEYOND].is_beyond_given = most < FURTHER;
    return status;
}

static cm_status measure_scattering(const planning *with, const cm_tof_sensor *sensor,
                                    const cm_tof_options *most, effect *of)
{
    cm_camera *camera = NULL;
    double scale = 1.0;
    cm_status status = planned_frame_make_small(sensor->camera, SMALL_PIXELS, &scale, &camera);
    if (status != CM_OK)
    {
        return status;
    }
    cm_tof_sensor small = *sensor;
    small.camera = camera;
    const cm_tof_options none = {.size = sizeof none};
    cm_tof_options one = none;
    one.bounces = 1;
    one.lights = most->lights;
    one.mapping = most->mapping;
    one.map_edge = most->map_edge;
    cm_tof_options seen = one;
    seen.visibility = 1;
    status = compare(with, &small, &small, &none, &one, scale, &of[MULTIPATH]);
    if (status == CM_OK)
    {
        status = compare(with, &small, &small, &one, &seen, scale, &of[VISIBILITY]);
    }
    if (status == CM_OK)
    {
        status = measure_further(with, &small, most->bounces, scale, of);
    }
    cm_camera_destroy(camera);
    return status;
}

/* Noise is added to a frame of direct light and the surroundings'. */
static cm_status measure_noise(const planning *with, const cm_tof_sensor *sensor,
                               const cm_tof_options *most, effect *of_noise)
{
    const cm_camera_options *camera = cm_camera_describe(sensor->camera);
    const size_t pixels = (size_t)camera->width * camera->height;
    const size_t images = (size_t)sensor->phases * (sensor->second_frequency > 0.0 ? 2 : 1);
    float *const memory = calloc(pixels, (2 * images + 1) * sizeof *memory);
    if (memory == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    float *const amplitude = memory + 2 * images * pixels;
    const noise_charges of = {pixels, memory, memory + images * pixels, amplitude};
    cm_tof_options options = {.size = sizeof options};
    options.environment = most->environment;
    options.paths = most->paths;
    cm_tof_result result = {.size = sizeof result,
                            .charge_a = memory,
                            .charge_b = memory + images * pixels,
                            .amplitude = amplitude};
    const clock_t begin = clock();
    const cm_status status =
        cm_tof_simulate(with->scene, sensor, with->light, with->lights, with->trajectory,
                        with->time, &options, with->pool, &result);
    if (status == CM_OK)
    {
        /* numbers take about as long as a frame */
        of_noise->entry.cost = fmax(milliseconds_of(1), milliseconds_of(clock() - begin));
        of_noise->entry.contribution = noise_spread(sensor, most->shot, &of);
        of_noise->work = (double)(pixels * images) * MS_OF_NOISE;
    }
    free(memory);
    return status;
}

static cm_status measure_distortion(const planning *with, const cm_tof_sensor *sensor, effect *of)
{
    cm_camera *plain = NULL;
    const cm_tof_options none = {.size = sizeof none};
    if (!has_distortion(sensor->camera))
    {
        return CM_OK;
    }
    cm_status status = make_plain(sensor->camera, &plain);
    if (status == CM_OK)
    {
        cm_tof_sensor other = *sensor;
        other.camera = plain;
        status = compare(with, &other, sensor, &none, &none, 1.0, of);
    }
    cm_camera_destroy(plain);
    return status;
}

static cm_status measure_all(const planning *with, const cm_tof_sensor *sensor,
                             const cm_tof_options *most, effect *of)
{
    const cm_tof_options none = {.size = sizeof none};
    cm_tof_options samples = none, times = none, once = none;
    samples.sample_columns = most->sample_columns;
    samples.sample_rows = most->sample_rows;
    once.sample_times = 1;
    times.sample_times = MOTION_TIMES;
    cm_status status = compare(with, sensor, sensor, &none, &samples, 1.0, &of[OVERSAMPLING]);
    status = status == CM_OK ? measure_scattering(with, sensor, most, of) : status;
    status = status == CM_OK ? measure_noise(with, sensor, most, &of[NOISE]) : status;
    status = status == CM_OK ? measure_distortion(with, sensor, &of[DISTORTION]) : status;
    return status == CM_OK ? compare(with, sensor, sensor, &once, &times, 1.0, &of[MOTION])
                           : status;
}

/* ---- what is kept ---- */

/* What is left of a limit by what may not be taken; if that alone is beyond, the limit is for what may. */
static double limit_of_rest(const effect *of, double limit)
{
    double beyond = 0.0;
    for (int i = 0; i < CM_TOF_EFFECTS; i++)
    {
        beyond += of[i].is_beyond_given ? of[i].entry.contribution : 0.0;
    }
    return beyond < limit ? limit - beyond : limit;
}

/* Which of those that may be taken are needed; *error is that of the others. Work decides, no clock. */
static cm_status keep(effect *of, double limit, double *error)
{
    cm_budget_entry entry[CM_TOF_EFFECTS];
    cm_budget budget = {.size = sizeof budget, .unit = "m", .entry = entry};
    for (int i = 0; i < SAMPLING; i++)
    {
        if (!of[i].is_beyond_given)
        {
            entry[budget.count] = of[i].entry;
            entry[budget.count++].cost = of[i].work;
        }
    }
    const cm_status status = cm_budget_limit_error(&budget, limit);
    for (int i = SAMPLING; status == CM_OK && i-- > 0;)
    {
        const cm_budget_entry *from = of[i].is_beyond_given ? NULL : &entry[--budget.count];
        of[i].entry.is_kept = from != NULL && from->is_kept;
        of[i].entry.reason = from != NULL                   ? from->reason
                             : of[i].entry.contribution > 0 ? "dropped: limit given"
                                                            : "contributes nothing";
    }
    *error = budget.error;
    return status;
}

static void choose(const effect *of, const cm_tof_options *most, cm_tof_options *chosen)
{
    const int further = most->bounces > 1 ? most->bounces : FURTHER;
    *chosen = *most;
    chosen->noise = of[NOISE].entry.is_kept;
    const int is_scattered = of[MULTIPATH].entry.is_kept || of[VISIBILITY].entry.is_kept;
    chosen->bounces = of[FURTHER_BOUNCES].entry.is_kept ? further : is_scattered;
    chosen->visibility = of[VISIBILITY].entry.is_kept;
    chosen->sample_times = of[MOTION].entry.is_kept ? 0 : 1;
    if (!of[OVERSAMPLING].entry.is_kept)
    {
        chosen->sample_columns = 1;
        chosen->sample_rows = 1;
    }
}

static void take_along(effect *of, const char *reason, double *error)
{
    if (!of->entry.is_kept && of->entry.contribution > 0.0)
    {
        of->entry.is_kept = 1;
        of->entry.reason = reason;
        *error -= of->entry.contribution;
    }
}

/* What comes with what is chosen: paths have shadows, and shadows of scattered light, or its further bounces, the first. What it
 * would cost by virtual lights is no cost of paths. */
static void follow(effect *of, cm_tof_options *chosen, double *error)
{
    if (chosen->bounces > 0)
    {
        take_along(&of[MULTIPATH], "comes with what is kept", error);
    }
    if (chosen->bounces > 1 || (chosen->bounces == 1 && chosen->traces))
    {
        take_along(&of[VISIBILITY], "paths have it", error);
        of[VISIBILITY].entry.cost = 0.0;
        of[MULTIPATH].entry.cost = 0.0;
        chosen->visibility = 1;
    }
}

/* Scattered light that is kept is sampled, and half of the limit is for that. */
static cm_status choose_all(const planning *with, const cm_tof_sensor *sensor,
                            const cm_tof_options *most, double limit, effect *of,
                            cm_tof_options *chosen)
{
    double error = 0.0;
    cm_status status = keep(of, limit, &error);
    choose(of, most, chosen);
    if (status == CM_OK && chosen->bounces > 0)
    {
        status = keep(of, 0.5 * limit, &error);
        choose(of, most, chosen);
    }
    if (status == CM_OK)
    {
        follow(of, chosen, &error);
        status = sampling_choose(with, sensor, most, limit - error, chosen, &of[SAMPLING].entry);
    }
    if (status == CM_OK && chosen->bounces > 0)
    {
        follow(of, chosen, &error); /* lights may have become paths */
        /* it is the cost of one effect, and counts once */
        of[chosen->bounces > 1 ? FURTHER_BOUNCES : MULTIPATH].entry.cost = of[SAMPLING].entry.cost;
        of[SAMPLING].entry.cost = 0.0;
    }
    return status;
}

/* An array of its own for the caller, untouched if anything fails. */
static cm_status put(const effect *of, cm_budget *budget)
{
    cm_budget made = *budget;
    cm_budget_entry entry[CM_TOF_EFFECTS];
    for (int i = 0; i < CM_TOF_EFFECTS; i++)
    {
        entry[i] = of[i].entry;
    }
    made.entry = entry;
    made.subject = "time-of-flight frame";
    made.unit = "m";
    made.cost_unit = "ms";
    made.count = CM_TOF_EFFECTS;
    const cm_status status = cm_budget_sum(&made);
    if (status == CM_OK)
    {
        memcpy(budget->entry, entry, sizeof entry);
        made.entry = budget->entry;
        *budget = made;
    }
    return status;
}

cm_status cm_tof_plan(const cm_tof_scene *scene, const cm_tof_sensor *sensor,
                      const cm_tof_light *light, size_t lights, const cm_trajectory *trajectory,
                      double time, double limit, const cm_tof_options *most, cm_pool *pool,
                      cm_tof_options *chosen, cm_budget *budget)
{
    static const cm_tof_options plain = {
        .size = sizeof plain, .sample_columns = 3, .sample_rows = 3};
    const cm_tof_options *const given = most == NULL ? &plain : most;
    cm_status status = sensor_check_signal(sensor);
    if (status != CM_OK || sensor->camera == NULL || chosen == NULL || budget == NULL ||
        budget->size != sizeof *budget || budget->entry == NULL || given->size != sizeof *given)
    {
        return status == CM_OK ? CM_ERROR_ARGUMENT : status;
    }
    if (!(limit >= 0.0))
    {
        return CM_ERROR_RANGE;
    }
    const planning with = {scene, light, lights, trajectory, time, pool, reconstruct_range(sensor)};
    cm_tof_options made;
    effect of[CM_TOF_EFFECTS];
    memset(of, 0, sizeof of);
    for (int i = 0; i < CM_TOF_EFFECTS; i++)
    {
        of[i].entry.size = sizeof of[i].entry;
        of[i].entry.name = names[i];
    }
    status = measure_all(&with, sensor, given, of);
    status = status == CM_OK ? choose_all(&with, sensor, given, limit_of_rest(of, limit), of, &made)
                             : status;
    status = status == CM_OK ? put(of, budget) : status;
    if (status == CM_OK)
    {
        *chosen = made;
    }
    return status;
}
