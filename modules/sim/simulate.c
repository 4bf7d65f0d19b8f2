/* SPDX-License-Identifier: MIT */
#include "charges.h"
#include "map_cells.h"
#include "reconstruct.h"
#include "seen_motion.h"
#include "tof_world.h"
#include "vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum
{
    MOST_TIMES = 16,
    PIXELS_AT_ONCE = 8192
};

#define MULTIPATH_APART 0.001 /* metres */
#define STEP_TURN 0.05        /* radians of phase: the mean over them is less by 1e-4 */
#define BEND_TURN 1e-4        /* radians that a mean over a bend of a motion may be off */

/* A frame while it is made. */
typedef struct frame
{
    const cm_tof_scene *scene;
    const cm_tof_light *light;
    size_t lights;
    const cm_trajectory *trajectory;
    double time;
    cm_tof_options options;
    cm_pool *pool;
    cm_tof_result *result;
    tof_sensor sensor;
    tof_picture picture;
    double **table;
    float *charge_a, *charge_b; /* series x phases x pixels */
    float *offset;
    uint8_t *flags;
    size_t pixels;
    void *memory;
    tof_sky *sky; /* NULL: no environment */
    int times;
    int is_beyond; /* some charge is more than a float holds */
    uint32_t virtual_lights;
} frame;

/* ---- what is asked ---- */

static cm_status check_environment(const cm_tof_environment *environment)
{
    if (environment == NULL)
    {
        return CM_OK;
    }
    if (environment->size != sizeof *environment ||
        (environment->radiance != NULL && (environment->mapping == NULL || environment->edge == 0)))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!(environment->constant >= 0.0) || !isfinite(environment->constant))
    {
        return CM_ERROR_RANGE;
    }
    const size_t faces =
        environment->radiance == NULL ? 0 : (size_t)map_faces(environment->mapping);
    for (size_t i = 0; i < faces * environment->edge * environment->edge; i++)
    {
        if (!(environment->radiance[i] >= 0.0f) || !isfinite(environment->radiance[i]))
        {
            return CM_ERROR_RANGE;
        }
    }
    return CM_OK;
}

static cm_status check_options(const cm_tof_options *options)
{
    if (options->size != sizeof *options)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (options->bounces < 0 || options->bounces > 1000 || options->sample_times > 1000 ||
        options->lights > 1u << 20 || options->paths > 1u << 20 || options->map_edge > 4096 ||
        (options->shot != CM_TOF_POISSON && options->shot != CM_TOF_FREEMAN_TUKEY))
    {
        return CM_ERROR_RANGE;
    }
    return check_environment(options->environment);
}

static cm_status check(const cm_tof_scene *scene, const cm_tof_light *light, size_t lights,
                       double time, const cm_tof_options *options, const cm_tof_result *result)
{
    if (scene == NULL || result == NULL || result->size != sizeof *result ||
        (result->report != NULL && result->report->size != sizeof *result->report))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (lights > SHADE_LAMPS || !isfinite(time))
    {
        return CM_ERROR_RANGE;
    }
    const cm_status status = lamps_check(light, lights);
    return status == CM_OK ? check_options(options) : status;
}

/* ---- one time ---- */

static int needs_virtual_lights(const cm_tof_options *options)
{
    return options->bounces == 1 && !options->traces;
}

/* Light at a time, times part, into the picture's sums; of one series' waves, or all (series below 0). */
static cm_status add_time(frame *doing, double time, int series, double part, int is_first)
{
    tof_scenery scenery = {.set = doing->scene->set,
                           .sensor = &doing->sensor,
                           .options = &doing->options,
                           .sky = doing->sky,
                           .lamps = doing->lights};
    tof_instant *instant = NULL;
    tof_virtual_lights *virtual_lights = NULL;
    for (size_t j = 0; j < doing->sensor.waves.count; j++)
    {
        if (series < 0 || doing->sensor.wave_series[j] == series)
        {
            scenery.waves.number[scenery.waves.count++] = doing->sensor.waves.number[j];
        }
    }
    cm_status status = tof_instant_create(doing->scene, time, &instant);
    if (status != CM_OK)
    {
        return status;
    }
    scenery.instant = instant;
    tof_pose_at(doing->trajectory, time, &scenery.camera);
    lamps_place(doing->light, doing->lights, doing->table, &scenery.camera, scenery.lamp);
    if (needs_virtual_lights(&doing->options))
    {
        status = tof_virtual_lights_create(instant, scenery.lamp, scenery.lamps, &doing->options,
                                           &scenery.waves, doing->pool, &virtual_lights);
        scenery.virtual_lights = virtual_lights;
    }
    if (status == CM_OK)
    {
        doing->virtual_lights =
            virtual_lights == NULL ? 0 : tof_virtual_lights_count(virtual_lights);
        status = picture_add(&scenery, part, is_first, doing->pool, &doing->picture);
    }
    tof_virtual_lights_destroy(virtual_lights);
    tof_instant_destroy(instant);
    return status;
}

/* ---- how things move ---- */

static int moves(const frame *doing, double begin, double end)
{
    double first = 0.0, last = 0.0;
    const size_t count = doing->trajectory == NULL ? 0 : cm_trajectory_count(doing->trajectory);
    if (count > 1)
    {
        (void)cm_trajectory_at(doing->trajectory, 0, &first, NULL);
        (void)cm_trajectory_at(doing->trajectory, count - 1, &last, NULL);
    }
    return (count > 1 && begin < last && end > first) || tof_scene_moves(doing->scene, begin, end);
}

/* What moves in an exposure, whose ends do not say it where trajectories bend between. */
static cm_status find_movement_from(const frame *doing, double begin, int bends,
                                    seen_movement *whole)
{
    const double exposure = doing->sensor.given.exposure;
    const int pieces = bends ? MOST_TIMES : 1;
    cm_status status = CM_OK;
    for (int k = 0; status == CM_OK && k < pieces; k++)
    {
        seen_movement piece = {0.0, 0.0};
        status =
            seen_motion(doing->scene, doing->trajectory, &doing->sensor,
                        begin + k * exposure / pieces, begin + (k + 1) * exposure / pieces, &piece);
        whole->angle += piece.angle;
        whole->range += piece.range;
    }
    return status;
}

/* The most that moves in any of the exposures, and of those in which trajectories bend. */
static cm_status find_movement(const frame *doing, seen_movement *most, seen_movement *bent)
{
    const cm_tof_sensor *given = &doing->sensor.given;
    cm_status status = CM_OK;
    for (int image = 0; status == CM_OK && image < doing->sensor.series * given->phases; image++)
    {
        const double begin = doing->time + image * (given->exposure + given->readout);
        const double end = begin + given->exposure;
        if (moves(doing, begin, end))
        {
            const int bends = tof_trajectory_bends(doing->trajectory, begin, end) ||
                              tof_scene_bends(doing->scene, begin, end);
            seen_movement whole = {0.0, 0.0};
            status = find_movement_from(doing, begin, bends, &whole);
            most->angle = fmax(most->angle, whole.angle);
            most->range = fmax(most->range, whole.range);
            bent->range = fmax(bent->range, bends ? whole.range : 0.0);
        }
    }
    return status;
}

/* Steps of an exposure: in one no sample is to move by more than its width, and no phase by more than STEP_TURN. Where motion
 * bends, the middle of one of N steps is a quarter of its turn from its mean, which counts as one of N. */
static cm_status find_times(frame *doing)
{
    doing->times = (int)doing->options.sample_times;
    if (doing->times > 0)
    {
        return CM_OK;
    }
    seen_movement most = {0.0, 0.0}, bent = most;
    const cm_status status = find_movement(doing, &most, &bent);
    const double solid_angle =
        cm_camera_solid_angle(doing->sensor.given.camera, 0.5 * (double)doing->sensor.width,
                              0.5 * (double)doing->sensor.height);
    const double fineness = fmax((double)doing->sensor.sample_columns / doing->sensor.cells.width,
                                 (double)doing->sensor.sample_rows);
    const double samples = most.angle / sqrt(solid_angle > 0.0 ? solid_angle : 1e-6) * fineness;
    double number = 0.0;
    for (size_t wave = 0; wave < doing->sensor.waves.count; wave++)
    {
        number = fmax(number, doing->sensor.waves.number[wave]);
    }
    const double turns = 2.0 * number * most.range / STEP_TURN;
    const double bends = sqrt(2.0 * number * bent.range / (4.0 * BEND_TURN));
    doing->times = (int)fmin(fmax(1.0, ceil(fmax(fmax(samples, turns), bends))), MOST_TIMES);
    return status;
}

/* ---- scattered light ---- */

/* Of a pixel's cells: its own, or the first of three between which circuits are. */
static size_t first_cell(const tof_sensor *sensor, size_t pixel)
{
    return sensor->given.single_readout
               ? pixel / sensor->width * sensor->cells.columns + 2 * (pixel % sensor->width)
               : pixel;
}

/* Does scattered light move the distance of the first series? */
static int is_multipath(const frame *doing, size_t cell, double per_turn)
{
    const tof_sums *sum = &doing->picture.sum;
    const double real = sum->direct_real[cell], imaginary = sum->direct_imaginary[cell];
    const double all_real = sum->real[cell], all_imaginary = sum->imaginary[cell];
    const double turn = atan2(all_imaginary * real - all_real * imaginary,
                              all_real * real + all_imaginary * imaginary);
    return fabs(turn * per_turn) > MULTIPATH_APART;
}

static void flag_multipath_of(size_t begin, size_t end, void *user)
{
    const frame *doing = user;
    const size_t middle = doing->sensor.given.single_readout ? 1 : 0;
    const double per_turn = sensor_unambiguous(&doing->sensor.given, 0) / (2.0 * PI);
    for (size_t i = begin; i < end; i++)
    {
        if (is_multipath(doing, first_cell(&doing->sensor, i) + middle, per_turn))
        {
            doing->flags[i] |= CM_TOF_MULTIPATH;
        }
    }
}

/* While the picture has the first series' light: of what moves, that of its last phase image. */
static void flag_multipath(frame *doing)
{
    if (doing->options.bounces > 0)
    {
        cm_pool_run(doing->pool, doing->pixels, PIXELS_AT_ONCE, flag_multipath_of, doing);
    }
}

/* ---- all of a frame ---- */

static void keep_charges(frame *doing, size_t picture_wave, int series, int phase, int count)
{
    const size_t image = (size_t)series * (size_t)doing->sensor.given.phases + (size_t)phase;
    doing->is_beyond |= charges_of_phases(doing->scene->set, &doing->sensor, &doing->picture,
                                          picture_wave, series, phase, count, doing->offset,
                                          doing->pool, doing->charge_a + image * doing->pixels,
                                          doing->charge_b + image * doing->pixels);
}

/* Nothing moves: one sum for all phases and frequencies. */
static cm_status take_still(frame *doing)
{
    doing->times = 1;
    const cm_status status = add_time(doing, doing->time, -1, 1.0, 1);
    if (status == CM_OK)
    {
        flag_multipath(doing);
    }
    for (int series = 0; status == CM_OK && series < doing->sensor.series; series++)
    {
        size_t wave = 0;
        while (doing->sensor.wave_series[wave] != series)
        {
            wave++;
        }
        keep_charges(doing, wave, series, 0, doing->sensor.given.phases);
    }
    return status;
}

static cm_status take_moving(frame *doing)
{
    const cm_tof_sensor *given = &doing->sensor.given;
    cm_status status = find_times(doing);
    doing->picture.watches = 1;
    for (int image = 0; status == CM_OK && image < doing->sensor.series * given->phases; image++)
    {
        const double begin = doing->time + image * (given->exposure + given->readout);
        picture_clear(&doing->picture, &doing->options, doing->pool);
        for (int step = 0; status == CM_OK && step < doing->times; step++)
        {
            const double time = begin + ((double)step + 0.5) / doing->times * given->exposure;
            status = add_time(doing, time, image / given->phases, 1.0 / doing->times,
                              image == 0 && step == 0);
        }
        keep_charges(doing, 0, image / given->phases, image % given->phases, 1);
        if (status == CM_OK && image + 1 == given->phases)
        {
            flag_multipath(doing);
        }
    }
    return status;
}

/* Of the cells of each pixel: one, or three between which circuits are. */
static void flag_pixels(size_t begin, size_t end, void *user)
{
    const frame *doing = user;
    const uint8_t *const from = doing->picture.flags;
    uint8_t *const to = doing->flags;
    if (!doing->sensor.given.single_readout)
    {
        for (size_t i = begin; i < end; i++)
        {
            to[i] |= from[i];
        }
        return;
    }
    for (size_t i = begin; i < end; i++)
    {
        const size_t k = first_cell(&doing->sensor, i);
        to[i] |= (uint8_t)(from[k] | from[k + 1] | from[k + 2]);
    }
}

static void disturb(frame *doing)
{
    for (int image = 0; image < doing->sensor.series * doing->sensor.given.phases; image++)
    {
        float *const a = doing->charge_a + (size_t)image * doing->pixels;
        float *const b = doing->charge_b + (size_t)image * doing->pixels;
        if (doing->options.noise)
        {
            charges_add_noise(&doing->sensor, &doing->options, image, doing->pool, a, b);
        }
        if (doing->is_beyond || doing->sensor.given.full_well > 0.0)
        {
            charges_fill(&doing->sensor, doing->pool, a, doing->flags);
            charges_fill(&doing->sensor, doing->pool, b, doing->flags);
        }
    }
}

static void put_report(const frame *doing, cm_tof_report *report)
{
    report->rays = doing->picture.rays;
    report->oversampled = doing->picture.oversampled;
    report->times = (uint32_t)doing->times;
    report->lights = doing->virtual_lights;
    report->saturated = 0;
    for (size_t i = 0; i < doing->pixels; i++)
    {
        report->saturated += doing->flags[i] & CM_TOF_SATURATED ? 1u : 0u;
    }
}

static void put_result(frame *doing)
{
    cm_tof_result *const result = doing->result;
    const size_t images = (size_t)(doing->sensor.series * doing->sensor.given.phases);
    const size_t count = images * doing->pixels;
    if (result->charge_a != NULL)
    {
        memcpy(result->charge_a, doing->charge_a, count * sizeof(float));
    }
    if (result->charge_b != NULL)
    {
        memcpy(result->charge_b, doing->charge_b, count * sizeof(float));
    }
    reconstruct(doing->scene->set, &doing->sensor.given, doing->pixels, doing->charge_a,
                doing->charge_b, doing->pool, result, doing->flags);
    if (result->flags != NULL)
    {
        memcpy(result->flags, doing->flags, doing->pixels);
    }
    if (result->report != NULL)
    {
        put_report(doing, result->report);
    }
}

/* All arrays of a frame are in one piece, which the next frame of the scene uses again. */
static cm_status get_memory(frame *doing)
{
    const size_t images = (size_t)(doing->sensor.series * doing->sensor.given.phases);
    const int has_offsets = doing->options.noise && doing->sensor.given.fixed_pattern > 0.0;
    doing->pixels = (size_t)doing->sensor.width * doing->sensor.height;
    doing->table = lamps_tables(doing->light, doing->lights);
    const size_t size = picture_size(&doing->sensor, &doing->options);
    const size_t whole = (size + 63) / 64 * 64;
    if (doing->table == NULL || size == 0 ||
        doing->pixels > SIZE_MAX / 16 / (sizeof(float) * (2 * images + 2)))
    {
        return CM_ERROR_MEMORY;
    }
    doing->memory = tof_scene_take((cm_tof_scene *)(uintptr_t)doing->scene,
                                   whole + doing->pixels * ((2 * images + 1) * sizeof(float) + 1));
    if (doing->memory == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    picture_create(&doing->sensor, &doing->options, doing->pool, doing->memory, &doing->picture);
    doing->charge_a = (float *)(void *)((char *)doing->memory + whole);
    doing->charge_b = doing->charge_a + images * doing->pixels;
    float *const offset = doing->charge_b + images * doing->pixels;
    doing->flags = (uint8_t *)(void *)(offset + doing->pixels);
    memset(doing->flags, 0, doing->pixels);
    if (has_offsets)
    {
        charges_offsets(&doing->sensor, &doing->options, doing->pool, offset);
        doing->offset = offset;
    }
    return doing->options.environment == NULL
               ? CM_OK
               : tof_scene_take_sky((cm_tof_scene *)(uintptr_t)doing->scene,
                                    doing->options.environment, doing->pool, &doing->sky);
}

static void give_back(frame *doing)
{
    tof_scene_return_sky((cm_tof_scene *)(uintptr_t)doing->scene, doing->sky);
    tof_scene_return((cm_tof_scene *)(uintptr_t)doing->scene, doing->memory);
    lamps_free_tables(doing->table, doing->lights);
    sensor_release(&doing->sensor);
}

cm_status cm_tof_simulate(const cm_tof_scene *scene, const cm_tof_sensor *sensor,
                          const cm_tof_light *light, size_t lights, const cm_trajectory *trajectory,
                          double time, const cm_tof_options *options, cm_pool *pool,
                          cm_tof_result *result)
{
    static const cm_tof_options plain = {.size = sizeof plain};
    frame doing = {.scene = scene,
                   .light = light,
                   .lights = lights,
                   .trajectory = trajectory,
                   .time = time,
                   .options = options == NULL ? plain : *options,
                   .pool = pool,
                   .result = result};
    cm_status status = check(scene, light, lights, time, &doing.options, result);
    status = status == CM_OK ? sensor_prepare(sensor, &doing.options, &doing.sensor) : status;
    if (status != CM_OK)
    {
        return status;
    }
    status = get_memory(&doing);
    if (status == CM_OK)
    {
        const double end = time + cm_tof_frame_time(sensor) - sensor->pause - sensor->readout;
        status = moves(&doing, time, end) ? take_moving(&doing) : take_still(&doing);
    }
    if (status == CM_OK)
    {
        cm_pool_run(pool, doing.pixels, PIXELS_AT_ONCE, flag_pixels, &doing);
        disturb(&doing);
        put_result(&doing);
    }
    give_back(&doing);
    return status;
}
