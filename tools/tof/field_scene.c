/* SPDX-License-Identifier: MIT */
#include "field_scene.h"

#include <cubemap/random.h>
#include <cubemap/world.h>

#include <math.h>

#define PI 3.14159265358979323846

/* Slow and fast, as in the paper's four scenes of a time-of-flight camera; so, too, of wavebands. */
static const field_scene scenes[] = {
    {"tof lateral slow", 1, 0, 1.0},   {"tof lateral fast", 1, 0, 3.0},
    {"tof turning slow", 1, 1, 1.0},   {"tof turning fast", 1, 1, 3.0},
    {"bands lateral slow", 0, 0, 1.0}, {"bands lateral fast", 0, 0, 3.0},
    {"bands turning slow", 0, 1, 1.0}, {"bands turning fast", 0, 1, 3.0},
};

size_t field_scene_count(void)
{
    return sizeof scenes / sizeof *scenes;
}

const field_scene *field_scene_at(size_t index)
{
    return &scenes[index];
}

/* ---- texture ---- */

/* In [0, 1], at a corner of a lattice. */
static double corner_value(int64_t x, int64_t y, uint32_t seed)
{
    uint32_t h = (uint32_t)x * 0x9E3779B1u ^ (uint32_t)y * 0x85EBCA77u ^ seed * 0xC2B2AE3Du;
    h = (h ^ h >> 15) * 0x2C1B3C6Du;
    h = (h ^ h >> 12) * 0x297A2D39u;
    return (double)(h ^ h >> 15) / 4294967295.0;
}

static double smooth(double t)
{
    return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

static double lattice_value(double x, double y, uint32_t seed)
{
    const double column = floor(x), row = floor(y);
    const double right = smooth(x - column), down = smooth(y - row);
    const int64_t i = (int64_t)column, j = (int64_t)row;
    const double above =
        corner_value(i, j, seed) * (1.0 - right) + corner_value(i + 1, j, seed) * right;
    const double below =
        corner_value(i, j + 1, seed) * (1.0 - right) + corner_value(i + 1, j + 1, seed) * right;
    return above + down * (below - above);
}

/* In [0, 1], rough down to 5 pixels. */
static double texture_at(double x, double y, uint32_t seed)
{
    return 0.5 * lattice_value(x / 23.0, y / 23.0, seed) +
           0.3 * lattice_value(x / 11.0, y / 11.0, seed + 1) +
           0.2 * lattice_value(x / 5.0, y / 5.0, seed + 2);
}

/* ---- what moves ---- */

/* A place of the picture in the thing's own coordinates, from its middle. */
static void to_own(const field_scene *scene, double time, double x, double y, double own[2])
{
    if (!scene->turns)
    {
        own[0] = x + 30.0 - scene->speed * time;
        own[1] = y;
        return;
    }
    const double angle = scene->speed * time * PI / 180.0;
    own[0] = cos(angle) * x + sin(angle) * y;
    own[1] = cos(angle) * y - sin(angle) * x;
}

/* ---- wavebands ---- */

enum
{
    ARMS = 5
};

static int is_in_thing(const field_scene *scene, const double own[2])
{
    if (!scene->turns)
    {
        return fabs(own[0]) < 55.0 && fabs(own[1]) < 70.0;
    }
    const double radius = hypot(own[0], own[1]), angle = atan2(own[1], own[0]);
    return radius < 65.0 + 35.0 * cos(ARMS * angle);
}

/* Two pigments, of which each band sees its own parts; the last is dark. */
static double band_at(const field_scene *scene, uint32_t channel, double time, double x, double y)
{
    static const double share[FIELD_CHANNELS][3] = {
        {10.0, 200.0, 40.0}, {20.0, 130.0, 95.0}, {30.0, 50.0, 150.0}, {8.0, 45.0, 35.0}};
    double own[2];
    to_own(scene, time, x, y, own);
    const int is_in = is_in_thing(scene, own);
    const double *at = is_in ? own : (const double[2]){x, y};
    const uint32_t seed = is_in ? 100 : 200;
    return share[channel][0] + share[channel][1] * texture_at(at[0], at[1], seed) +
           share[channel][2] * texture_at(at[0], at[1], seed + 50);
}

enum
{
    SAMPLES = 3 /* of a pixel, each way */
};

static double offset_of(int sample)
{
    return (sample + 0.5) / SAMPLES - 0.5;
}

static cm_status draw_band(const field_scene *scene, uint32_t channel, double time, float *picture)
{
    for (size_t i = 0; i < FIELD_PIXELS; i++)
    {
        const double x = (double)(i % FIELD_WIDTH) - FIELD_WIDTH / 2.0;
        const double y = (double)(i / FIELD_WIDTH) - FIELD_HEIGHT / 2.0;
        double sum = 0.0;
        for (int k = 0; k < SAMPLES * SAMPLES; k++)
        {
            sum += band_at(scene, channel, time, x + offset_of(k % SAMPLES),
                           y + offset_of(k / SAMPLES));
        }
        picture[i] = (float)(sum / (SAMPLES * SAMPLES));
    }
    return CM_OK;
}

/* ---- phases ---- */

#define FOCAL_LENGTH 300.0 /* pixels */
#define WALL 3.0           /* metres before the camera */
#define THING 1.5
#define ELECTRONS 20000.0 /* a phase image, at 1 m of a white surface */
#define CONTRAST 0.8
#define FREQUENCY 20e6
#define LIGHT 299792458.0

static void add(cm_scene *world, cm_primitive p)
{
    p.size = sizeof p;
    cm_scene_add(world, &p, NULL);
}

/* A box that goes to the right, or a star of cylinders, before a wall. NULL: there is no memory. */
static cm_scene *world_at(const field_scene *scene, double time)
{
    cm_scene *world = NULL;
    if (cm_scene_create(&world) != CM_OK)
    {
        return NULL;
    }
    add(world,
        (cm_primitive){.kind = CM_PRIMITIVE_PLANE, .first = {0, 0, WALL}, .second = {0, 0, -1}});
    const double scale = THING / FOCAL_LENGTH;
    if (!scene->turns)
    {
        const double x = (scene->speed * time - 30.0) * scale;
        add(world, (cm_primitive){.kind = CM_PRIMITIVE_BOX,
                                  .first = {x - 55.0 * scale, -70.0 * scale, THING},
                                  .second = {x + 55.0 * scale, 70.0 * scale, THING + 0.3}});
        return world;
    }
    for (int arm = 0; arm < ARMS; arm++)
    {
        const double angle = (scene->speed * time + 360.0 * arm / ARMS) * PI / 180.0;
        add(world, (cm_primitive){.kind = CM_PRIMITIVE_CYLINDER,
                                  .first = {0, 0, THING + 0.1},
                                  .second = {95.0 * scale * cos(angle), 95.0 * scale * sin(angle),
                                             THING + 0.1},
                                  .radius = 16.0 * scale});
    }
    return world;
}

enum
{
    ROW_SAMPLES = FIELD_WIDTH * SAMPLES
};

/* N (1 + C cos(tau + 4 pi f r / c)) of a ray that has met something: N falls with the square of the range, and has the
 * surface's colour and slant. */
static double phase_value(const field_scene *scene, uint32_t channel, double time, double x,
                          double y, double depth, uint32_t id, double cosine)
{
    const double range = depth * sqrt(x * x + y * y + 1.0);
    double own[2] = {x * FOCAL_LENGTH, y * FOCAL_LENGTH};
    if (id != 0)
    {
        to_own(scene, time, x * depth * FOCAL_LENGTH / THING, y * depth * FOCAL_LENGTH / THING,
               own);
    }
    const double albedo = 0.15 + 0.8 * texture_at(own[0], own[1], id == 0 ? 200 : 100);
    const double electrons = ELECTRONS * albedo * cosine / (range * range);
    const double tau = 2.0 * PI * channel / FIELD_CHANNELS;
    return electrons * (1.0 + CONTRAST * cos(tau + 4.0 * PI * FREQUENCY * range / LIGHT));
}

static cm_status draw_phase(const field_scene *scene, uint32_t channel, double time, float *picture)
{
    static double origin[ROW_SAMPLES], x[ROW_SAMPLES], y[ROW_SAMPLES], z[ROW_SAMPLES];
    static double distance[ROW_SAMPLES], normal[3][ROW_SAMPLES];
    static uint32_t id[ROW_SAMPLES];
    const cm_hit_arrays hit = {.size = sizeof hit,
                               .distance = distance,
                               .id = id,
                               .normal = {normal[0], normal[1], normal[2]}};
    cm_scene *world = world_at(scene, time);
    if (world == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    for (size_t i = 0; i < FIELD_PIXELS; i++)
    {
        picture[i] = 0.0f;
    }
    for (size_t line = 0; line < (size_t)FIELD_HEIGHT * SAMPLES; line++)
    {
        const double down = ((double)line + 0.5) / SAMPLES - 0.5 - FIELD_HEIGHT / 2.0;
        for (size_t i = 0; i < ROW_SAMPLES; i++)
        {
            x[i] = (((double)i + 0.5) / SAMPLES - 0.5 - FIELD_WIDTH / 2.0) / FOCAL_LENGTH;
            y[i] = down / FOCAL_LENGTH;
            z[i] = 1.0;
        }
        cm_scene_cast_array(world, ROW_SAMPLES, origin, origin, origin, x, y, z, &hit);
        for (size_t i = 0; i < ROW_SAMPLES; i++)
        {
            const double length = sqrt(x[i] * x[i] + y[i] * y[i] + 1.0);
            const double cosine =
                fabs(normal[0][i] * x[i] + normal[1][i] * y[i] + normal[2][i]) / length;
            picture[line / SAMPLES * FIELD_WIDTH + i / SAMPLES] +=
                (float)(phase_value(scene, channel, time, x[i], y[i], distance[i], id[i], cosine) /
                        (SAMPLES * SAMPLES));
        }
    }
    cm_scene_destroy(world);
    return CM_OK;
}

cm_status draw_channel(const field_scene *scene, uint32_t channel, double time, float *picture)
{
    return (scene->is_tof ? draw_phase : draw_band)(scene, channel, time, picture);
}

/* ---- true flows ---- */

/* Whether a row's pixels see the thing at their centres. */
static void find_thing(const field_scene *scene, const cm_scene *world, double time, size_t row,
                       uint8_t *is_thing)
{
    static double origin[FIELD_WIDTH], x[FIELD_WIDTH], y[FIELD_WIDTH], z[FIELD_WIDTH];
    static uint32_t id[FIELD_WIDTH];
    const cm_hit_arrays hit = {.size = sizeof hit, .id = id};
    for (size_t i = 0; i < FIELD_WIDTH; i++)
    {
        x[i] = (double)i - FIELD_WIDTH / 2.0;
        y[i] = (double)row - FIELD_HEIGHT / 2.0;
        z[i] = FOCAL_LENGTH;
        double own[2];
        to_own(scene, time, x[i], y[i], own);
        is_thing[i] = (uint8_t)is_in_thing(scene, own);
    }
    if (world != NULL)
    {
        cm_scene_cast_array(world, FIELD_WIDTH, origin, origin, origin, x, y, z, &hit);
        for (size_t i = 0; i < FIELD_WIDTH; i++)
        {
            is_thing[i] = id[i] != 0;
        }
    }
}

/* Where a place of the picture that belongs to the thing is some steps later. */
static void follow(const field_scene *scene, double steps, double x, double y, double to[2])
{
    const double angle = scene->turns ? scene->speed * steps * PI / 180.0 : 0.0;
    to[0] = cos(angle) * x - sin(angle) * y + (scene->turns ? 0.0 : scene->speed * steps);
    to[1] = sin(angle) * x + cos(angle) * y;
}

cm_status draw_flow(const field_scene *scene, double from, double to, float *flow)
{
    cm_scene *world = scene->is_tof ? world_at(scene, from) : NULL;
    if (scene->is_tof && world == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    for (size_t row = 0; row < FIELD_HEIGHT; row++)
    {
        uint8_t is_thing[FIELD_WIDTH];
        find_thing(scene, world, from, row, is_thing);
        for (size_t i = 0; i < FIELD_WIDTH; i++)
        {
            const double x = (double)i - FIELD_WIDTH / 2.0, y = (double)row - FIELD_HEIGHT / 2.0;
            double place[2];
            follow(scene, to - from, x, y, place);
            float *d = flow + 2 * (row * FIELD_WIDTH + i);
            d[0] = is_thing[i] ? (float)(place[0] - x) : 0.0f;
            d[1] = is_thing[i] ? (float)(place[1] - y) : 0.0f;
        }
    }
    cm_scene_destroy(world);
    return CM_OK;
}

/* ---- noise ---- */

void add_noise(const field_scene *scene, uint32_t shot, float *picture)
{
    for (uint32_t i = 0; i < FIELD_PIXELS; i++)
    {
        const double mean = (double)picture[i];
        picture[i] = (float)(scene->is_tof ? cm_random_poisson(7, shot, i, 0, mean)
                                           : mean + cm_random_normal(7, shot, i, 0));
    }
}
