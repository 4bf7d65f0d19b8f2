/* SPDX-License-Identifier: MIT
 *
 * Lenses, texel images and measures where the system has no memory: each allocation fails once, which is told; nothing is
 * written then, and nothing leaks.
 */
#include <cubemap/depth_error.h>
#include <cubemap/lens.h>
#include <cubemap/texel.h>

#include "tests/refused_allocation.h"
#include "tests/suite.h"

enum
{
    SIDE = 16
};

static cm_camera *camera, *pinhole;
static cm_scene *scene;
static const cm_pose at_origin = {.rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
static const cm_texel_options options = {
    .size = sizeof options, .field = 0.8, .width = SIDE, .columns = 4, .rows = 4, .window = 4};
static float input[SIDE * SIDE];

/* What trials write: untouched after a refusal. */
static float output[3 * SIDE * SIDE];
static double number[2];

static cm_status find_guard(void)
{
    return cm_lens_guard(camera, 0.1, number);
}
static cm_status find_pinhole(void)
{
    cm_camera_options wide = {.size = sizeof wide};
    const cm_status status = cm_lens_pinhole(camera, 0.0, &wide);
    number[0] += wide.width;
    return status;
}
static cm_status make_map(void)
{
    cm_lens_map *map = NULL;
    const cm_status status = cm_lens_map_create(camera, pinhole, NULL, &map);
    ck_assert((status == CM_OK) == (map != NULL));
    number[0] += status == CM_OK;
    cm_lens_map_destroy(map);
    return status;
}
static cm_status sample(void)
{
    return cm_texel_sample(&options, input, output);
}
static cm_status make_points(void)
{
    const cm_texel_image image = {.size = sizeof image, .range = output};
    return cm_texel_points(&options, input, &image);
}
static cm_status render(void)
{
    const cm_texel_image image = {.size = sizeof image, .color = output};
    return cm_texel_render(scene, &at_origin, &options, NULL, &image);
}
static cm_status measure(void)
{
    cm_depth_error error = {.size = sizeof error};
    const cm_status status = cm_depth_error_measure(SIDE * SIDE, input, input, &error);
    number[0] += (double)error.count;
    return status;
}
static cm_status find_quantile(void)
{
    const double half = 0.5;
    const cm_status status =
        cm_depth_error_quantiles(SIDE * SIDE, input, input, 1, &half, &number[0]);
    number[0] += status == CM_OK;
    return status;
}
static cm_status sparsify(void)
{
    const double half = 0.5;
    const cm_status status =
        cm_depth_error_sparsify(SIDE * SIDE, input, input, input, CM_SPARSIFICATION_MAE, 1, &half,
                                &number[0], NULL, &number[1]);
    number[0] += status == CM_OK;
    return status;
}
static cm_status find_edges(void)
{
    cm_depth_edges edges = {.size = sizeof edges};
    const cm_status status = cm_depth_error_edges(SIDE, SIDE, input, input, 0.01, 1, &edges);
    number[0] += (double)edges.measured;
    return status;
}

static int is_written(void)
{
    int written = number[0] != -1.0 || number[1] != -1.0;
    for (int i = 0; i < 3 * SIDE * SIDE; i++)
    {
        written |= output[i] != -1.0f;
    }
    return written;
}

static void refuse_each(const char *name, cm_status (*try_it)(void))
{
    cm_status status = CM_ERROR_MEMORY;
    for (int blocks = 0; status != CM_OK; blocks++)
    {
        const int before = blocks_alive();
        for (int i = 0; i < 3 * SIDE * SIDE; i++)
        {
            output[i] = -1.0f;
        }
        number[0] = number[1] = -1.0;
        blocks_until_refusal = blocks;
        status = try_it();
        const int is_refused = blocks_until_refusal < 0;
        blocks_until_refusal = -1;
        REQUIRE(status == (is_refused ? CM_ERROR_MEMORY : CM_OK), "%s, block %d: %d", name, blocks,
                (int)status);
        REQUIRE(is_written() == (status == CM_OK), "%s, block %d", name, blocks);
        REQUIRE(blocks_alive() == before, "%s, block %d: %d leak", name, blocks,
                blocks_alive() - before);
        REQUIRE(blocks > 0 || is_refused, "%s asks for nothing", name);
    }
}

START_TEST(refused_memory_is_told)
{
    refuse_each("guard", find_guard);
    refuse_each("pinhole", find_pinhole);
    refuse_each("map", make_map);
    refuse_each("sample", sample);
    refuse_each("points", make_points);
    refuse_each("render", render);
    refuse_each("measure", measure);
    refuse_each("quantile", find_quantile);
    refuse_each("sparsify", sparsify);
    refuse_each("edges", find_edges);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {refused_memory_is_told, NULL};
    cm_camera_options lens = {.size = sizeof lens,
                              .width = SIDE,
                              .height = SIDE,
                              .fx = 16.0,
                              .fy = 16.0,
                              .cx = 8.0,
                              .cy = 8.0};
    for (int i = 0; i < SIDE * SIDE; i++)
    {
        input[i] = 1.0f + 0.1f * (float)(i % 7);
    }
    if (cm_camera_create(&lens, &pinhole) != CM_OK)
    {
        return 1;
    }
    lens.distortion[0] = -0.1;
    if (cm_camera_create(&lens, &camera) != CM_OK || cm_scene_create_named("room", &scene) != CM_OK)
    {
        return 1;
    }
    const int result = run_suite("lens refused", tests);
    cm_camera_destroy(camera);
    cm_camera_destroy(pinhole);
    cm_scene_destroy(scene);
    return result;
}
