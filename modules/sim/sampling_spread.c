/* SPDX-License-Identifier: MIT
 *
 * Paths are judged by themselves: two frames of other random numbers are apart by twice the variance of one. Virtual lights
 * have none; they are judged by paths, whose own spread cancels: the error's square is the mean of the product of what two
 * such frames, independent of each other, are away from the lights'. That mean is of few pixels, of which a few may have
 * most: two of its standard deviations are added.
 */
#include "sampling_spread.h"
#include "tof_object.h"

#include <math.h>

enum
{
    PATH_PIXELS = 1200, /* of the picture in which that is measured */
    LIGHT_PIXELS = 4800,
    MOST_PATHS = 4096,
    MOST_LIGHTS = 16 * TOF_LIGHTS,
    MORE_LIGHTS = 4,      /* times as many, the next time */
    MORE_PATHS = 16,      /* the same, at most */
    REFERENCE_PATHS = 256 /* a pixel, by which lights are judged */
};

#define OTHER_SEED UINT64_C(0x9e3779b97f4a7c15)

/* A camera of few pixels, and how it is simulated but for numbers of samples. */
typedef struct sampled
{
    const planning *with;
    cm_tof_sensor sensor;
    cm_tof_options options;
    double scale; /* of costs */
} sampled;

typedef struct sampling
{
    uint32_t number; /* of paths or lights */
    double error;
    double cost;
} sampling;

/* Two frames of paths, each with random numbers of its own. */
static cm_status take_pair(const sampled *at, uint32_t paths, planned_frame frame[2])
{
    cm_tof_options options = at->options;
    options.paths = paths;
    cm_status status = CM_OK;
    for (int i = 0; i < 2 && status == CM_OK; i++)
    {
        options.seed ^= i == 0 ? 0 : OTHER_SEED;
        status = planned_frame_take(at->with, &at->sensor, &options, &frame[i]);
    }
    return status;
}

static cm_status measure_paths(const sampled *at, uint32_t paths, sampling *made)
{
    planned_frame frame[2] = {{0}};
    double squares = 0.0;
    size_t count = 0;
    const cm_status status = take_pair(at, paths, frame);
    for (size_t i = 0; status == CM_OK && i < frame[0].pixels; i++)
    {
        const double apart = planned_frame_apart(at->with, (double)frame[0].distance[i],
                                                 (double)frame[1].distance[i]);
        squares += isnan(apart) ? 0.0 : 0.5 * apart * apart;
        count += isnan(apart) ? 0 : 1;
    }
    if (status == CM_OK)
    {
        made->number = paths;
        made->error = count == 0 ? 0.0 : sqrt(squares / (double)count);
        made->cost = at->scale * 0.5 * (frame[0].milliseconds + frame[1].milliseconds);
    }
    planned_frame_drop(&frame[0]);
    planned_frame_drop(&frame[1]);
    return status;
}

/* So many that the next error, by the root of their number, is about the limit; powers of two of the first. */
static uint32_t more_paths(uint32_t paths, double beyond, uint32_t most)
{
    const double needed = fmin((double)paths * MORE_PATHS, (double)paths * beyond * beyond);
    uint32_t more = 2 * paths;
    while (more < needed)
    {
        more *= 2;
    }
    return more < most ? more : most;
}

static cm_status choose_paths(const sampled *at, uint32_t given, double limit, sampling *made)
{
    const uint32_t most = given != 0 ? given : MOST_PATHS;
    uint32_t paths = given != 0 ? given : TOF_PATHS;
    cm_status status = measure_paths(at, paths, made);
    while (status == CM_OK && limit > 0.0 && made->error > limit && paths < most)
    {
        paths = more_paths(paths, made->error / limit, most);
        status = measure_paths(at, paths, made);
    }
    return status;
}

/* The root of a mean, of that many numbers with this sum and sum of squares, and of twice what it may be off. */
static double error_at_most(double sum, double squares, double count)
{
    const double mean = sum / count;
    const double variance = fmax(0.0, squares / count - mean * mean);
    return sqrt(fmax(0.0, mean) + 2.0 * sqrt(variance / count));
}

static cm_status measure_lights(const sampled *at, const planned_frame reference[2],
                                uint32_t lights, sampling *made)
{
    planned_frame frame = {0};
    double sum = 0.0, squares = 0.0;
    size_t count = 0;
    cm_tof_options options = at->options;
    options.traces = 0;
    options.lights = lights;
    options.visibility = 1; /* as paths have it: what shadows are worth is told by itself */
    const cm_status status = planned_frame_take(at->with, &at->sensor, &options, &frame);
    for (size_t i = 0; status == CM_OK && i < frame.pixels; i++)
    {
        double apart[2];
        for (int k = 0; k < 2; k++)
        {
            apart[k] = planned_frame_apart(at->with, (double)frame.distance[i],
                                           (double)reference[k].distance[i]);
        }
        const double product = apart[0] * apart[1];
        sum += isnan(product) ? 0.0 : product;
        squares += isnan(product) ? 0.0 : product * product;
        count += isnan(product) ? 0 : 1;
    }
    if (status == CM_OK)
    {
        made->number = lights;
        made->error = count == 0 ? 0.0 : error_at_most(sum, squares, (double)count);
        made->cost = at->scale * frame.milliseconds;
    }
    planned_frame_drop(&frame);
    return status;
}

static cm_status choose_lights(const sampled *at, uint32_t given, double limit, sampling *made)
{
    planned_frame reference[2] = {{0}};
    const uint32_t most = given != 0 ? given : MOST_LIGHTS;
    uint32_t lights = given != 0 ? given : TOF_LIGHTS;
    cm_status status = take_pair(at, REFERENCE_PATHS, reference);
    status = status == CM_OK ? measure_lights(at, reference, lights, made) : status;
    while (status == CM_OK && limit > 0.0 && made->error > limit && lights < most)
    {
        lights *= MORE_LIGHTS;
        status = measure_lights(at, reference, lights, made);
    }
    planned_frame_drop(&reference[0]);
    planned_frame_drop(&reference[1]);
    return status;
}

/* One bounce is by lights and, where they are not enough and no number of them is given, by paths. */
static cm_status choose_way(const sampled *at, const cm_tof_options *given, double limit,
                            cm_tof_options *chosen, sampling *made)
{
    sampling other = {0};
    if (chosen->bounces > 1 || chosen->traces)
    {
        const cm_status status = choose_paths(at, given->paths, limit, made);
        chosen->paths = made->number;
        return status;
    }
    cm_status status = choose_lights(at, given->lights, limit, made);
    chosen->lights = made->number;
    if (status == CM_OK && limit > 0.0 && made->error > limit && given->lights == 0)
    {
        status = choose_paths(at, given->paths, limit, &other);
        if (status == CM_OK && other.error < made->error)
        {
            *made = other;
            chosen->paths = other.number;
            chosen->traces = 1;
            chosen->lights = 0;
        }
    }
    return status;
}

static const char *reason_of(const cm_tof_options *given, const cm_tof_options *chosen,
                             double limit, double error)
{
    const int uses_paths = chosen->bounces > 1 || chosen->traces;
    if (error <= limit)
    {
        return "the error is within the limit with the samples that are chosen";
    }
    if (limit == 0.0)
    {
        return "beyond the limit: no number of samples has no error";
    }
    return (uses_paths ? given->paths : given->lights) != 0
               ? "beyond the limit: no more samples than are given"
               : "beyond the limit: it remains with the most samples that are tried";
}

cm_status sampling_choose(const planning *with, const cm_tof_sensor *sensor,
                          const cm_tof_options *given, double limit, cm_tof_options *chosen,
                          cm_budget_entry *entry)
{
    cm_camera *camera = NULL;
    sampled at = {.with = with, .sensor = *sensor, .options = *chosen};
    sampling made = {0};
    if (chosen->bounces == 0)
    {
        entry->reason = "no scattered light is sampled";
        return CM_OK;
    }
    const int uses_paths = chosen->bounces > 1 || chosen->traces;
    cm_status status = planned_frame_make_small(
        sensor->camera, uses_paths ? PATH_PIXELS : LIGHT_PIXELS, &at.scale, &camera);
    if (status != CM_OK)
    {
        return status;
    }
    at.sensor.camera = camera;
    at.options.noise = 0;
    at.options.environment = NULL; /* which is not modulated */
    at.options.traces = 1;
    at.options.sample_times = 1;
    if (!at.options.full) /* most pixels have one sample */
    {
        at.options.sample_columns = at.options.sample_rows = 1;
    }
    status = choose_way(&at, given, limit, chosen, &made);
    cm_camera_destroy(camera);
    if (status == CM_OK)
    {
        entry->contribution = made.error;
        entry->cost = made.cost;
        entry->reason = reason_of(given, chosen, limit, made.error);
    }
    return status;
}
