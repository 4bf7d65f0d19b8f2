/* SPDX-License-Identifier: MIT
 *
 * Texel images of any options: what is none is refused, depths are means of what was measured, and worlds are seen.
 */
#include "fuzz.h"

#include <cubemap/texel.h>

#include <math.h>

enum
{
    SIDE = 32
};

static uint32_t take_small(supply *from, uint32_t most)
{
    const uint8_t value = take_byte(from);
    return value == 255 ? take_word(from) : value % (most + 1);
}

static cm_texel_options take_options(supply *from)
{
    cm_texel_options options = {.size = take_byte(from) == 1 ? 5 : sizeof options};
    options.field = take_byte(from) % 8 == 0 ? take_double(from) : 1.5 + 1.4 * take_fraction(from);
    options.width = take_small(from, SIDE);
    options.height = take_small(from, SIDE);
    options.columns = take_small(from, SIDE);
    options.rows = take_small(from, SIDE);
    options.window = take_small(from, SIDE);
    options.oversampling = take_small(from, 3);
    options.spacing = (cm_texel_spacing)(take_byte(from) % 3);
    options.unit = take_byte(from) % 8 == 0 ? take_double(from) : 0.01;
    return options;
}

static void check_buffer(supply *from)
{
    float z[4];
    const double near = take_double(from), far = take_double(from);
    take_bytes(from, z, sizeof z);
    if (cm_texel_linearise(near, far, 4, z, z) == CM_OK)
    {
        for (int i = 0; i < 4; i++)
        {
            EXPECT(isnan(z[i]) ||
                       ((double)z[i] >= near * 0.999 - 1e-44 && (double)z[i] <= far * 1.001) ||
                       isinf(z[i]),
                   "%g of %g to %g", (double)z[i], near, far);
        }
    }
}

static void check_samples(supply *from, const cm_texel_options *options)
{
    static float canvas[SIDE * SIDE], depth[SIDE * SIDE], range[SIDE * SIDE];
    double place[4][SIDE];
    unsigned char values[5];
    take_bytes(from, values, sizeof values);
    for (int i = 0; i < SIDE * SIDE; i++)
    {
        const unsigned char value = values[i % 5];
        canvas[i] = value < 3 ? NAN : value == 3 ? INFINITY : 0.1f * value;
    }
    const cm_texel_image image = {.size = sizeof image, .range = range};
    EXPECT(cm_texel_places(options, place[0], place[1], place[2], place[3]) == CM_OK, "places");
    EXPECT(cm_texel_sample(options, canvas, depth) == CM_OK, "samples");
    EXPECT(cm_texel_points(options, depth, &image) == CM_OK, "points");
    for (uint32_t i = 0; i < options->columns * options->rows; i++)
    {
        EXPECT(isnan(depth[i]) || (depth[i] > 0.39f && depth[i] < 25.6f), "%g", (double)depth[i]);
        EXPECT(isnan(depth[i]) ? isnan(range[i]) : range[i] >= depth[i], "%g", (double)range[i]);
    }
}

static void check_world(supply *from, const cm_texel_options *options)
{
    static float color[3 * SIDE * SIDE], depth[SIDE * SIDE];
    const cm_texel_image image = {.size = sizeof image, .color = color, .depth = depth};
    cm_scene *scene = NULL;
    cm_pose base, scan;
    double twist[12], matrix[16];
    for (int i = 0; i < 12; i++)
    {
        twist[i] = take_byte(from) == 0 ? take_double(from) : take_fraction(from);
    }
    cm_pose_exp(twist, &base);
    cm_pose_exp(twist + 6, &scan);
    if (cm_texel_matrix(&base, &scan, 1.0, matrix) == CM_OK)
    {
        EXPECT(matrix[15] == 1.0 && matrix[12] == 0.0, "%g", matrix[15]);
    }
    EXPECT(cm_scene_create_named(cm_scene_name_at(take_byte(from) % 3), &scene) == CM_OK,
           "a world");
    if (cm_texel_render(scene, &scan, options, NULL, &image) == CM_OK)
    {
        for (uint32_t i = 0; i < 3 * options->width * options->height; i++)
        {
            EXPECT(color[i] >= 0.0f && color[i] <= 1.0f, "%g", (double)color[i]);
        }
    }
    cm_scene_destroy(scene);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    cm_texel_options options = take_options(&from);
    check_buffer(&from);
    if (cm_texel_complete(&options) == CM_OK && options.width <= SIDE && options.height <= SIDE)
    {
        check_samples(&from, &options);
        check_world(&from, &options);
    }
    return 0;
}
