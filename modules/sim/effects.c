/* SPDX-License-Identifier: MIT
 *
 * What each effect does to distances here: a frame with it beside one without.
 */
#include "sensor.h"
#include "shot_noise.h"
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
    FURTHER = 4,         /* bounces that stand for all */
    SMALL_PIXELS = 5000, /* of the picture in which scattered light is measured */
    SMALL_PATHS = 32,
    MOTION_TIMES = 8
};

static const char *const names[CM_TOF_EFFECTS] = {
    "oversampling", "multipath", "visibility", "further bounces", "noise", "distortion", "motion"};

typedef struct planning
{
    const cm_tof_scene *scene;
    const cm_tof_light *light;
    size_t lights;
    const cm_trajectory *trajectory;
    double time;
    cm_pool *pool;
    double unambiguous;
} planning;

/* A frame of one of the cameras. */
typedef struct measured
{
    float *distance;
    size_t pixels;
    double milliseconds;
} measured;

/* Of a frame. */
typedef struct charges
{
    size_t pixels;
    float *charge_a, *charge_b; /* series x phases x pixels */
    float *amplitude;
} charges;

static void drop(measured *frame)
{
    free(frame->distance);
    frame->distance = NULL;
}

static double milliseconds_of(clock_t ticks)
{
    return 1e3 * (double)ticks / CLOCKS_PER_SEC;
}

static cm_status take(const planning *with, const cm_tof_sensor *sensor,
                      const cm_tof_options *options, measured *frame)
{
    const cm_camera_options *camera = cm_camera_describe(sensor->camera);
    frame->pixels = (size_t)camera->width * camera->height;
    frame->distance = malloc(frame->pixels * sizeof(float));
    if (frame->distance == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    cm_tof_result result = {.size = sizeof result, .distance = frame->distance};
    const clock_t begin = clock();
    const cm_status status =
        cm_tof_simulate(with->scene, sensor, with->light, with->lights, with->trajectory,
                        with->time, options, with->pool, &result);
    frame->milliseconds = milliseconds_of(clock() - begin);
    if (status != CM_OK)
    {
        drop(frame);
    }
    return status;
}

/* The root mean square of the change, around the circle of distances; what one of them alone sees counts as its whole. */
static double change(const planning *with, const measured *a, const measured *b)
{
    double squares = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < a->pixels; i++)
    {
        const double one = (double)a->distance[i], other = (double)b->distance[i];
        if (isnan(one) && isnan(other))
        {
            continue;
        }
        double apart = isnan(one) ? other : isnan(other) ? one : fabs(one - other);
        apart = fmod(apart, with->unambiguous);
        apart = fmin(apart, with->unambiguous - apart);
        squares += apart * apart;
        count++;
    }
    return count == 0 ? 0.0 : sqrt(squares / (double)count);
}

/* What the second options bring beyond the first. */
static cm_status compare(const planning *with, const cm_tof_sensor *sensor,
                         const cm_tof_sensor *other, const cm_tof_options *without,
                         const cm_tof_options *options, double scale, cm_budget_entry *entry)
{
    measured a = {NULL, 0, 0.0}, b = a;
    cm_status status = take(with, sensor, without, &a);
    status = status == CM_OK ? take(with, other, options, &b) : status;
    if (status == CM_OK)
    {
        entry->contribution = change(with, &a, &b);
        /* a tick at least: by chance the frame with it may take less, and what costs nothing would always be kept */
        entry->cost = scale * fmax(milliseconds_of(1), b.milliseconds - a.milliseconds);
    }
    drop(&a);
    drop(&b);
    return status;
}

/* ---- cameras ---- */

static cm_status make_small(const cm_camera *camera, double *scale, cm_camera **small)
{
    cm_camera_options options = *cm_camera_describe(camera);
    const double pixels = (double)options.width * options.height;
    const uint32_t part = (uint32_t)fmax(1.0, ceil(sqrt(pixels / SMALL_PIXELS)));
    const uint32_t width = options.width / part == 0 ? 1 : options.width / part;
    const uint32_t rows =
        options.mapping == NULL ? options.height / part : options.height / options.width * width;
    const double shift = options.pixel_centre - 0.5;
    *scale = pixels / ((double)width * (rows == 0 ? 1 : rows));
    options.width = width;
    options.height = rows == 0 ? 1 : rows;
    options.fx /= part;
    options.fy /= part;
    options.cx = (options.cx - shift) / part + shift;
    options.cy = (options.cy - shift) / part + shift;
    return cm_camera_create(&options, small);
}

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

static cm_status measure_scattering(const planning *with, const cm_tof_sensor *sensor,
                                    const cm_tof_options *most, cm_budget_entry *entry)
{
    cm_camera *camera = NULL;
    double scale = 1.0;
    cm_status status = make_small(sensor->camera, &scale, &camera);
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
    cm_tof_options traced = none, further = none;
    traced.bounces = 1;
    traced.traces = 1;
    further.bounces = FURTHER;
    traced.paths = further.paths = SMALL_PATHS;
    status = compare(with, &small, &small, &none, &one, scale, &entry[MULTIPATH]);
    if (status == CM_OK)
    {
        status = compare(with, &small, &small, &one, &seen, scale, &entry[VISIBILITY]);
    }
    if (status == CM_OK)
    {
        status = compare(with, &small, &small, &traced, &further, scale, &entry[FURTHER_BOUNCES]);
    }
    cm_camera_destroy(camera);
    return status;
}

/* Of a phase image's circuits together, the mean over the first series' images. */
static double variance_of_pixel(const cm_tof_sensor *sensor, int shot, size_t pixels,
                                const float *charge_a, const float *charge_b)
{
    double sum = 0.0;
    for (size_t k = 0; k < (size_t)sensor->phases; k++)
    {
        const double a = (double)charge_a[k * pixels], b = (double)charge_b[k * pixels];
        sum += shot == CM_TOF_FREEMAN_TUKEY
                   ? shot_noise_variance(sensor, a) + shot_noise_variance(sensor, b)
                   : a + b;
    }
    return sum / sensor->phases + 2.0 * sensor->read_noise * sensor->read_noise;
}

/* The root mean square over pixels, by the formula: one frame's noise is one of many. What is not modulated light is noise
 * alone. */
static double spread_by_formula(const planning *with, const cm_tof_sensor *sensor, int shot,
                                const charges *of)
{
    const double pattern = sensor->fixed_pattern * with->unambiguous / (2.0 * PI);
    double squares = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < of->pixels; i++)
    {
        const double signal = (double)of->amplitude[i] / sensor->contrast;
        if (signal > 0.0)
        {
            const double variance =
                variance_of_pixel(sensor, shot, of->pixels, of->charge_a + i, of->charge_b + i);
            const double spread = fmin(cm_tof_noise_of_distance(sensor, signal, variance - signal),
                                       with->unambiguous);
            squares += spread * spread + pattern * pattern;
            count++;
        }
    }
    return count == 0 ? 0.0 : sqrt(squares / (double)count);
}

/* Noise is added to a frame of direct light and the surroundings'. */
static cm_status measure_noise(const planning *with, const cm_tof_sensor *sensor,
                               const cm_tof_options *most, cm_budget_entry *entry)
{
    const cm_camera_options *camera = cm_camera_describe(sensor->camera);
    const size_t pixels = (size_t)camera->width * camera->height;
    const size_t images = (size_t)sensor->phases * (sensor->second_frequency > 0.0 ? 2 : 1);
    float *const memory = calloc(pixels, (2 * images + 1) * sizeof *memory);
    if (memory == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    const charges of = {pixels, memory, memory + images * pixels, memory + 2 * images * pixels};
    cm_tof_options options = {.size = sizeof options};
    options.environment = most->environment;
    options.paths = most->paths;
    cm_tof_result result = {.size = sizeof result,
                            .charge_a = of.charge_a,
                            .charge_b = of.charge_b,
                            .amplitude = of.amplitude};
    const clock_t begin = clock();
    const cm_status status =
        cm_tof_simulate(with->scene, sensor, with->light, with->lights, with->trajectory,
                        with->time, &options, with->pool, &result);
    if (status == CM_OK)
    {
        /* numbers take about as long as a frame */
        entry->cost = fmax(milliseconds_of(1), milliseconds_of(clock() - begin));
        entry->contribution = spread_by_formula(with, sensor, most->shot, &of);
    }
    free(memory);
    return status;
}

static cm_status measure_distortion(const planning *with, const cm_tof_sensor *sensor,
                                    cm_budget_entry *entry)
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
        status = compare(with, &other, sensor, &none, &none, 1.0, entry);
    }
    cm_camera_destroy(plain);
    return status;
}

static cm_status measure_all(const planning *with, const cm_tof_sensor *sensor,
                             const cm_tof_options *most, cm_budget_entry *entry)
{
    const cm_tof_options none = {.size = sizeof none};
    cm_tof_options samples = none, times = none, once = none;
    samples.sample_columns = most->sample_columns;
    samples.sample_rows = most->sample_rows;
    once.sample_times = 1;
    times.sample_times = MOTION_TIMES;
    cm_status status = compare(with, sensor, sensor, &none, &samples, 1.0, &entry[OVERSAMPLING]);
    status = status == CM_OK ? measure_scattering(with, sensor, most, entry) : status;
    status = status == CM_OK ? measure_noise(with, sensor, most, &entry[NOISE]) : status;
    status = status == CM_OK ? measure_distortion(with, sensor, &entry[DISTORTION]) : status;
    return status == CM_OK ? compare(with, sensor, sensor, &once, &times, 1.0, &entry[MOTION])
                           : status;
}

static void choose(const cm_budget_entry *entry, const cm_tof_options *most, cm_tof_options *chosen)
{
    *chosen = *most;
    chosen->noise = entry[NOISE].is_kept;
    chosen->bounces = entry[FURTHER_BOUNCES].is_kept ? FURTHER : entry[MULTIPATH].is_kept;
    chosen->visibility = entry[VISIBILITY].is_kept;
    chosen->sample_times = entry[MOTION].is_kept ? 0 : 1;
    if (!entry[OVERSAMPLING].is_kept)
    {
        chosen->sample_columns = 1;
        chosen->sample_rows = 1;
    }
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
    const planning with = {
        scene, light, lights, trajectory, time, pool, sensor_unambiguous(sensor, 0)};
    cm_budget_entry entry[CM_TOF_EFFECTS];
    memset(entry, 0, sizeof entry);
    for (int i = 0; i < CM_TOF_EFFECTS; i++)
    {
        entry[i].size = sizeof entry[i];
        entry[i].name = names[i];
    }
    status = measure_all(&with, sensor, given, entry);
    if (status == CM_OK)
    {
        memcpy(budget->entry, entry, sizeof entry);
        budget->subject = "time-of-flight frame";
        budget->unit = "m";
        budget->cost_unit = "ms";
        budget->count = CM_TOF_EFFECTS;
        status = cm_budget_limit_error(budget, limit);
    }
    if (status == CM_OK)
    {
        choose(budget->entry, given, chosen);
    }
    return status;
}
