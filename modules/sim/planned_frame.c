/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "planned_frame.h"
#include "tof_object.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

/* Milliseconds, about, of docs/measured/sim.md: what a frame takes is counted by them where a choice depends on it. */
#define MS_OF_RAY 5e-5 /* from the camera, with its direct light */
#define MS_OF_PAIR 8e-7
#define MS_OF_SHADOWED_PAIR 4.3e-6
#define MS_OF_PATH 2e-4 /* a bounce */

static double work_of(const cm_tof_options *options, const cm_tof_report *report)
{
    const double rays = (double)report->rays;
    double each = MS_OF_RAY;
    if (options->bounces == 1 && !options->traces)
    {
        each += report->lights * (options->visibility ? MS_OF_SHADOWED_PAIR : MS_OF_PAIR);
    }
    else if (options->bounces > 0)
    {
        const double paths = options->paths != 0 ? options->paths : TOF_PATHS;
        each += paths * options->bounces * MS_OF_PATH;
    }
    return rays * each;
}

cm_status planned_frame_take(const planning *with, const cm_tof_sensor *sensor,
                             const cm_tof_options *options, planned_frame *frame)
{
    const cm_camera_options *camera = cm_camera_describe(sensor->camera);
    frame->pixels = (size_t)camera->width * camera->height;
    frame->distance = cm_array_of(frame->pixels, sizeof(float));
    if (frame->distance == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    cm_tof_report report = {.size = sizeof report};
    cm_tof_result result = {.size = sizeof result, .distance = frame->distance, .report = &report};
    const clock_t begin = clock();
    const cm_status status =
        cm_tof_simulate(with->scene, sensor, with->light, with->lights, with->trajectory,
                        with->time, options, with->pool, &result);
    frame->milliseconds = 1e3 * (double)(clock() - begin) / CLOCKS_PER_SEC;
    if (status != CM_OK)
    {
        planned_frame_drop(frame);
        return status;
    }
    frame->work = work_of(options, &report);
    return CM_OK;
}

void planned_frame_drop(planned_frame *frame)
{
    free(frame->distance);
    frame->distance = NULL;
}

double planned_frame_apart(const planning *with, double one, double other)
{
    if (isnan(one) || isnan(other))
    {
        return isnan(one) ? other : one;
    }
    const double apart = one - other;
    return apart - with->unambiguous * round(apart / with->unambiguous);
}

cm_status planned_frame_make_small(const cm_camera *camera, double most, double *scale,
                                   cm_camera **small)
{
    cm_camera_options options = *cm_camera_describe(camera);
    const double pixels = (double)options.width * options.height;
    const uint32_t part = (uint32_t)fmax(1.0, ceil(sqrt(pixels / most)));
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
