/* SPDX-License-Identifier: MIT
 *
 * What is promised of any update: the same bits for any instruction set and any threads, and what counts and colors become.
 */
#include "dense_map.h"

#include <cubemap/mapping.h>

static cm_octree *updated(const char *instructions, unsigned threads, double footprint,
                          int is_round)
{
    const cm_octree_options options = {.size = sizeof options,
                                       .levels = 7,
                                       .edge = 0.04,
                                       .noise = 0.01,
                                       .color = 1,
                                       .footprint = footprint,
                                       .instructions = instructions};
    cm_octree *octree = NULL;
    const cm_status status = cm_octree_create(&options, &octree);
    ck_assert(status == CM_OK || status == CM_ERROR_INSTRUCTIONS);
    /* threads share windows of pictures that are large enough and end with a vector */
    const int threads_share = footprint > 0.0;
    cm_camera_options lens = {.size = sizeof lens,
                              .width = threads_share ? 64 : 61,
                              .height = threads_share ? 141 : 47,
                              .fx = 50.0,
                              .fy = 50.0,
                              .cx = 30.0,
                              .cy = 23.0};
    lens.distortion[0] = is_round ? 0.05 : 0.0;
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(&lens, &camera), CM_OK);
    cm_pool *pool = make_pool(threads);
    dice from = {17};
    for (int i = 0; octree != NULL && i < 5; i++)
    {
        const double place[3] = {dice_between(&from, -2.0, 2.0), dice_between(&from, -2.0, 2.0),
                                 -2.3};
        const double at[3] = {0.1, 0.2, 0.3};
        const cm_pose pose = look_at(place, at, 0.4 * i);
        drawn_view drawn;
        draw_view(&drawn, camera, &pose, 2.0, 1, &from);
        ck_assert_int_eq(cm_octree_update(octree, &drawn.view, pool), CM_OK);
        clear_view(&drawn);
    }
    cm_pool_destroy(pool);
    cm_camera_destroy(camera);
    return octree;
}

START_TEST(bits_are_the_same)
{
    const char *const sets[] = {"scalar", "sse2", "avx2", "avx512", "neon", NULL};
    const unsigned threads[] = {1, 2, 7};
    for (int which = 0; which < 4; which++)
    {
        const double footprint = which & 1 ? 2.0 : 0.0;
        cm_octree *first = updated("scalar", 1, footprint, which / 2);
        for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
        {
            cm_octree *octree = updated(sets[i], threads[i % 3], footprint, which / 2);
            if (octree != NULL)
            {
                const char *text = maps_differ(octree, first);
                ck_assert_msg(text[0] == '\0', "%s, %u threads: %s",
                              sets[i] == NULL ? "best" : sets[i], threads[i % 3], text);
            }
            cm_octree_destroy(octree);
        }
        cm_octree_destroy(first);
    }
}
END_TEST

/* ---- one wall, and a thing in front of it ---- */

typedef struct wall
{
    cm_octree *octree;
    cm_camera *camera;
    drawn_view drawn;
    int updates;
} wall;

static void show(wall *seen, float depth, const uint8_t rgb[3], int times)
{
    for (size_t i = 0; i < (size_t)40 * 30; i++)
    {
        seen->drawn.depth[i] = depth;
        memcpy(seen->drawn.color + 4 * i, rgb, 3);
    }
    for (int i = 0; i < times; i++)
    {
        ck_assert_int_eq(cm_octree_update(seen->octree, &seen->drawn.view, NULL), CM_OK);
        seen->updates++;
    }
}

static wall make_wall(const cm_octree_options *options)
{
    wall seen = {.octree = make_map(options), .camera = straight_camera(40, 30, 0.5)};
    const cm_pose pose = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0.0, 0.0, 0.0}};
    dice from = {1};
    draw_view(&seen.drawn, seen.camera, &pose, 1.0, 1, &from);
    return seen;
}

static void clear_wall(wall *seen)
{
    clear_view(&seen->drawn);
    cm_camera_destroy(seen->camera);
    cm_octree_destroy(seen->octree);
}

START_TEST(counts_and_colors_are_the_chapters)
{
    const cm_octree_options options = {.size = sizeof options,
                                       .levels = 6,
                                       .edge = 0.05,
                                       .color = 1,
                                       .far = 1.5,
                                       .no_return_is_free = 1};
    const uint8_t red[3] = {240, 10, 20}, grey[3] = {100, 100, 100}, black[3] = {0, 0, 0};
    const double at[3] = {0.01, 0.01, 1.02}, before[3] = {0.01, 0.01, 0.52},
                 behind[3] = {0.01, 0.01, 1.42};
    cm_voxel voxel;
    wall seen = make_wall(&options);
    show(&seen, 1.02f, red, 1);
    ck_assert(cm_octree_at(seen.octree, at, 0, &voxel) == CM_VOXEL_OCCUPIED && voxel.alpha == 129 &&
              voxel.has_color);
    ck_assert(voxel.color[0] == 240 && voxel.color[1] == 10 && voxel.color[2] == 20);
    show(&seen, 1.02f, grey, 3);
    cm_octree_at(seen.octree, at, 0, &voxel);
    ck_assert(abs(voxel.color[0] - 135) <= 1 && abs(voxel.color[1] - 78) <= 1 &&
              abs(voxel.color[2] - 80) <= 1);
    show(&seen, 1.02f, black, 100);
    cm_octree_at(seen.octree, at, 0, &voxel);
    ck_assert_msg(voxel.alpha == 255 && voxel.color[0] < 45, "%d %d", voxel.alpha, voxel.color[0]);
    ck_assert(cm_octree_at(seen.octree, before, 0, &voxel) == CM_VOXEL_FREE && voxel.alpha == 0);
    ck_assert(cm_octree_at(seen.octree, behind, 0, &voxel) == CM_VOXEL_UNKNOWN);
    /* the thing is taken away, and nothing is behind it */
    show(&seen, NAN, red, 63);
    ck_assert(cm_octree_at(seen.octree, at, 0, &voxel) == CM_VOXEL_OCCUPIED && voxel.alpha == 129);
    show(&seen, NAN, red, 1);
    ck_assert_int_eq(cm_octree_at(seen.octree, at, 0, &voxel), CM_VOXEL_UNKNOWN);
    show(&seen, NAN, red, 1);
    ck_assert_int_eq(cm_octree_at(seen.octree, at, 0, &voxel), CM_VOXEL_FREE);
    show(&seen, NAN, red, 100);
    ck_assert(cm_octree_at(seen.octree, at, 0, &voxel) == CM_VOXEL_FREE && voxel.alpha == 0 &&
              !voxel.has_color);
    ck_assert_int_eq((int)cm_octree_step(seen.octree), seen.updates);
    clear_wall(&seen);
}
END_TEST

/* Grey of one channel, grey with what hides, and red, green, blue with it; no more. */
START_TEST(colors_of_all_channels)
{
    const cm_octree_options options = {
        .size = sizeof options, .levels = 6, .edge = 0.05, .color = 1};
    const uint8_t red[3] = {240, 10, 20};
    const double at[3] = {0.01, 0.01, 1.02};
    for (unsigned channels = 1; channels <= 5; channels++)
    {
        wall seen = make_wall(&options);
        show(&seen, 1.02f, red, 0);
        cm_image *color = &seen.drawn.view.color;
        const size_t pixels = (size_t)color->width * color->height;
        uint8_t *bytes = malloc(pixels * channels);
        ck_assert_ptr_nonnull(bytes);
        for (size_t i = 0; i < pixels * channels; i++)
        {
            bytes[i] = (uint8_t)(40 * (i % channels) + 60);
        }
        color->data = bytes;
        color->channels = channels;
        color->row_stride = 0;
        ck_assert_int_eq(cm_octree_update(seen.octree, &seen.drawn.view, NULL),
                         channels <= 4 ? CM_OK : CM_ERROR_RANGE);
        cm_voxel voxel;
        ck_assert_int_eq(cm_octree_at(seen.octree, at, 0, &voxel),
                         channels <= 4 ? CM_VOXEL_OCCUPIED : CM_VOXEL_UNKNOWN);
        ck_assert(channels > 4 || (voxel.has_color && voxel.color[0] == 60));
        ck_assert(channels > 4 || voxel.color[1] == (channels < 3 ? 60 : 100));
        ck_assert(channels > 4 || voxel.color[2] == (channels < 3 ? 60 : 140));
        free(bytes);
        clear_wall(&seen);
    }
}
END_TEST

START_TEST(views_that_say_nothing_change_nothing)
{
    const cm_octree_options options = {
        .size = sizeof options, .levels = 10, .edge = 0.05, .far = 3.0};
    const uint8_t red[3] = {240, 10, 20};
    wall seen = make_wall(&options);
    show(&seen, NAN, red, 2);
    show(&seen, 0.0f, red, 2);
    ck_assert_int_eq((int)cm_octree_step(seen.octree), 0);
    cm_octree_count usual = {.size = sizeof usual}, after = usual;
    show(&seen, 2.0f, red, 1);
    ck_assert_int_eq(cm_octree_count_voxels(seen.octree, &usual), CM_OK);
    seen.drawn.depth[600] = 1.7e7f;
    ck_assert_int_eq(cm_octree_update(seen.octree, &seen.drawn.view, NULL), CM_OK);
    ck_assert_int_eq(cm_octree_count_voxels(seen.octree, &after), CM_OK);
    ck_assert_msg(after.bytes < 2 * usual.bytes, "one far pixel makes %d of %d bytes",
                  (int)after.bytes, (int)usual.bytes);
    /* poses beyond the map, and none */
    seen.drawn.view.pose.position[0] = 1e6;
    ck_assert_int_eq(cm_octree_update(seen.octree, &seen.drawn.view, NULL), CM_OK);
    const uint64_t step = cm_octree_step(seen.octree);
    seen.drawn.view.pose.rotation.row[0][0] = NAN;
    ck_assert_int_eq(cm_octree_update(seen.octree, &seen.drawn.view, NULL), CM_ERROR_CAMERA);
    ck_assert_int_eq(cm_octree_update(seen.octree, NULL, NULL), CM_ERROR_ARGUMENT);
    seen.drawn.view.pose.rotation.row[0][0] = 1.0;
    seen.drawn.view.depth.width = 39;
    ck_assert_int_eq(cm_octree_update(seen.octree, &seen.drawn.view, NULL), CM_ERROR_ARGUMENT);
    ck_assert_uint_eq(cm_octree_step(seen.octree), step);
    clear_wall(&seen);
}
END_TEST

static cm_camera *camera_all_around(uint32_t edge)
{
    cm_mapping *mapping = NULL;
    ck_assert_int_eq(cm_mapping_create("octahedral", NULL, &mapping), CM_OK);
    const cm_camera_options options = {.size = sizeof options,
                                       .width = edge,
                                       .height = edge,
                                       .pixel_centre = 0.5,
                                       .mapping = mapping};
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(&options, &camera), CM_OK);
    cm_mapping_destroy(mapping);
    return camera;
}

/* A view along the world's axes, whose pixels are these. */
static cm_view view_of_image(const cm_camera *camera, float *image, int is_range)
{
    const cm_camera_options *shape = cm_camera_describe(camera);
    const cm_view view = {.size = sizeof view,
                          .camera = camera,
                          .pose = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0.0, 0.0, 0.0}},
                          .depth = {.size = sizeof view.depth,
                                    .data = image,
                                    .type = CM_PIXEL_FLOAT,
                                    .width = shape->width,
                                    .height = shape->height,
                                    .channels = 1},
                          .depth_is_range = is_range,
                          .depth_unit = 1.0};
    return view;
}

/* Of one such view. */
static cm_octree *map_of_image(const cm_octree_options *options, const cm_camera *camera,
                               float *image, int is_range)
{
    const cm_view view = view_of_image(camera, image, is_range);
    cm_octree *octree = make_map(options);
    ck_assert_int_eq(cm_octree_update(octree, &view, NULL), CM_OK);
    return octree;
}

/* What a view of one depth makes of the voxels of a map. */
static cm_octree_count count_after(const cm_octree_options *options, const cm_camera *camera,
                                   float depth)
{
    const cm_camera_options *shape = cm_camera_describe(camera);
    const size_t pixels = (size_t)shape->width * shape->height;
    float *image = malloc(pixels * sizeof *image);
    ck_assert(image != NULL);
    for (size_t i = 0; i < pixels; i++)
    {
        image[i] = depth;
    }
    cm_octree *octree = map_of_image(options, camera, image, shape->mapping != NULL);
    cm_octree_count count = {.size = sizeof count};
    ck_assert_int_eq(cm_octree_count_voxels(octree, &count), CM_OK);
    cm_octree_destroy(octree);
    free(image);
    return count;
}

/* Free is what no return says, and what is far; a thing that is nearer than near hides what is behind it. */
START_TEST(behind_what_is_too_near_nothing_is_free)
{
    const cm_octree_options options = {.size = sizeof options,
                                       .levels = 6,
                                       .edge = 0.05,
                                       .near = 0.3,
                                       .far = 1.2,
                                       .no_return_is_free = 1};
    cm_camera *const cameras[] = {straight_camera(40, 30, 0.5), camera_all_around(31)};
    for (size_t i = 0; i < sizeof cameras / sizeof *cameras; i++)
    {
        const cm_octree_count hidden = count_after(&options, cameras[i], 0.2f);
        ck_assert_msg(hidden.free == 0 && hidden.occupied == 0, "camera %d: %d voxels are free",
                      (int)i, (int)hidden.free);
        ck_assert(count_after(&options, cameras[i], NAN).free > 1000);
        ck_assert(count_after(&options, cameras[i], 0.0f).free > 1000);
        ck_assert(count_after(&options, cameras[i], 5.0f).free > 1000);
        cm_camera_destroy(cameras[i]);
    }
}
END_TEST

/* A wall three units before a straight camera, as an image of ranges, which are 3.5 and more towards its border. */
static cm_octree *map_of_ranges(const cm_octree_options *options, const cm_camera *camera)
{
    const cm_camera_options *shape = cm_camera_describe(camera);
    const size_t pixels = (size_t)shape->width * shape->height;
    float *image = malloc(pixels * sizeof *image);
    ck_assert(image != NULL);
    for (size_t i = 0; i < pixels; i++)
    {
        const double column = (double)(i % shape->width) + shape->pixel_centre;
        const double row = (double)(i / shape->width) + shape->pixel_centre;
        double ray[3];
        cm_camera_ray_array(camera, 1, &column, &row, ray, ray + 1, ray + 2);
        image[i] =
            (float)(3.0 * sqrt(ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2]) / ray[2]);
    }
    cm_octree *octree = map_of_image(options, camera, image, 1);
    free(image);
    return octree;
}

/* Straight cameras and lenses have an optical axis. */
START_TEST(limits_are_of_depth_where_there_is_an_axis)
{
    cm_camera *cameras[] = {straight_camera(80, 60, 0.5), NULL};
    cm_camera_options lens = *cm_camera_describe(cameras[0]);
    lens.distortion[0] = 1e-3;
    ck_assert_int_eq(cm_camera_create(&lens, &cameras[1]), CM_OK);
    const double beside[3] = {1.42, 0.03, 3.02}, before[3] = {1.32, 0.03, 2.77};
    for (int i = 0; i < 2; i++)
    {
        cm_octree_options options = {.size = sizeof options, .levels = 8, .edge = 0.05};
        options.far = 3.1; /* the range of the wall is 3.32 there */
        cm_octree *octree = map_of_ranges(&options, cameras[i]);
        ck_assert_int_eq(cm_octree_at(octree, beside, 0, NULL), CM_VOXEL_OCCUPIED);
        ck_assert_int_eq(cm_octree_at(octree, before, 0, NULL), CM_VOXEL_FREE);
        cm_octree_destroy(octree);
        options.far = 0.0;
        options.near = 2.9; /* and 3.07 before it */
        octree = map_of_ranges(&options, cameras[i]);
        ck_assert_int_eq(cm_octree_at(octree, beside, 0, NULL), CM_VOXEL_OCCUPIED);
        ck_assert_int_eq(cm_octree_at(octree, before, 0, NULL), CM_VOXEL_UNKNOWN);
        cm_octree_destroy(octree);
        options.near = 3.2;
        octree = map_of_ranges(&options, cameras[i]);
        ck_assert_int_eq(cm_octree_at(octree, beside, 0, NULL), CM_VOXEL_UNKNOWN);
        cm_octree_destroy(octree);
        cm_camera_destroy(cameras[i]);
    }
}
END_TEST

/* A background of 1e10 that is not marked would free a large map in its finest voxels: no memory is enough. */
START_TEST(depths_beyond_all_maps_are_refused)
{
    cm_camera *cameras[] = {straight_camera(40, 30, 0.5), NULL, camera_all_around(31)};
    cm_camera_options lens = *cm_camera_describe(cameras[0]);
    lens.distortion[0] = 1e-3;
    ck_assert_int_eq(cm_camera_create(&lens, &cameras[1]), CM_OK);
    cm_octree_options large = {.size = sizeof large, .levels = 20, .edge = 0.05};
    cm_octree_options small = large, near = large;
    small.levels = 6;
    near.far = 1.0;
    float *image = malloc(40 * 31 * sizeof *image);
    ck_assert(image != NULL);
    for (size_t i = 0; i < sizeof cameras / sizeof *cameras; i++)
    {
        for (size_t k = 0; k < 40 * 31; k++)
        {
            image[k] = k % 3 == 0 ? 1e10f : 1.0f;
        }
        cm_octree_destroy(map_of_image(&small, cameras[i], image, i == 2));
        cm_octree_destroy(map_of_image(&near, cameras[i], image, i == 2));
        const cm_view view = view_of_image(cameras[i], image, i == 2);
        cm_octree *octree = make_map(&large);
        ck_assert_int_eq(cm_octree_update(octree, &view, NULL), CM_ERROR_RANGE);
        ck_assert_uint_eq(cm_octree_step(octree), 0);
        cm_octree_count count = {.size = sizeof count};
        ck_assert_int_eq(cm_octree_count_voxels(octree, &count), CM_OK);
        ck_assert(count.free == 0 && count.occupied == 0);
        for (size_t k = 0; k < 40 * 31; k++)
        {
            image[k] = 1.0f;
        }
        ck_assert_int_eq(cm_octree_update(octree, &view, NULL), CM_OK);
        ck_assert_int_eq(cm_octree_count_voxels(octree, &count), CM_OK);
        ck_assert(count.free > 0 && count.occupied > 0);
        cm_octree_destroy(octree);
        cm_camera_destroy(cameras[i]);
    }
    free(image);
}
END_TEST

/* A wall whose voxels are six pixels wide; the pixel that one's centre falls on, or more, measured nothing. */
START_TEST(pixels_beside_holes_hit)
{
    const cm_octree_options options = {.size = sizeof options, .levels = 6, .edge = 0.1};
    cm_camera_options shape = {.size = sizeof shape,
                               .width = 64,
                               .height = 64,
                               .fx = 60.0,
                               .fy = 60.0,
                               .cx = 32.0,
                               .cy = 32.0,
                               .pixel_centre = 0.5};
    const double centre[3] = {0.05, 0.05, 1.05};
    for (int which = 0; which < 6; which++)
    {
        shape.distortion[0] = which % 2 == 0 ? 0.0 : 0.01;
        cm_camera *camera = NULL;
        ck_assert_int_eq(cm_camera_create(&shape, &camera), CM_OK);
        double column, row;
        cm_camera_project_array(camera, 1, &centre[0], &centre[1], &centre[2], &column, &row);
        float *image = malloc(64 * 64 * sizeof *image);
        ck_assert(image != NULL);
        for (int i = 0; i < 64 * 64; i++)
        {
            const int aside = abs(i % 64 - (int)column), below = abs(i / 64 - (int)row);
            image[i] = aside <= which / 2 && below <= which / 2 ? 0.0f : 1.03f;
        }
        cm_octree *octree = map_of_image(&options, camera, image, 0);
        ck_assert_msg(cm_octree_at(octree, centre, 0, NULL) == CM_VOXEL_OCCUPIED,
                      "%s camera, %d pixels around it without depth",
                      which % 2 == 0 ? "straight" : "bent", which / 2);
        cm_octree_destroy(octree);
        cm_camera_destroy(camera);
        free(image);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {bits_are_the_same,
                                  counts_and_colors_are_the_chapters,
                                  colors_of_all_channels,
                                  views_that_say_nothing_change_nothing,
                                  behind_what_is_too_near_nothing_is_free,
                                  limits_are_of_depth_where_there_is_an_axis,
                                  depths_beyond_all_maps_are_refused,
                                  pixels_beside_holes_hit,
                                  NULL};
    return run_suite("octree promises", tests);
}
