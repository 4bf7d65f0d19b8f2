/* SPDX-License-Identifier: MIT
 *
 * Depth images of any numbers: what is none is nowhere, maps and smoothed images hold numbers or NaN, bounds hold what
 * is in a box, and two threads have the bits of one.
 */
#include "fuzz.h"

#include <cubemap/cubemap.h>
#include <cubemap/depth.h>

#include <float.h>
#include <math.h>

enum
{
    SIDE_MOST = 40,
    PIXELS_MOST = SIDE_MOST * SIDE_MOST
};

/* Of the second time that something is done. Making threads takes long: not where the input is short and has ended. */
static unsigned threads;

/* A number of any kind, of which many are depths. */
static float take_value(supply *from)
{
    const uint8_t kind = take_byte(from);
    float value;
    if (kind < 200)
    {
        return (float)(2.0 + take_fraction(from) * (kind % 2 ? 1e-2 : 1.9));
    }
    take_bytes(from, &value, sizeof value);
    return kind < 210 ? NAN : kind < 220 ? 1.7e7f : value;
}

static int is_measured(float value)
{
    return value > 0.0f && value <= FLT_MAX;
}

/* Cameras are made once: the valid field of one takes longer to find than all else here. */
static const cm_camera *take_camera(supply *from)
{
    static const uint32_t sizes[][2] = {{1, 1},  {2, 3},  {17, 5},  {40, 40},
                                        {33, 2}, {5, 40}, {16, 16}, {39, 37}};
    static cm_camera *made[32];
    const uint8_t which = take_byte(from) % 32;
    cm_camera_options options = {.size = sizeof options,
                                 .width = sizes[which % 8][0],
                                 .height = sizes[which % 8][1],
                                 .fx = 20.0,
                                 .fy = 21.0,
                                 .cx = 10.0,
                                 .cy = 11.0};
    options.pixel_centre = which & 8 ? 0.5 : 0.0;
    options.distortion[0] = which & 16 ? -0.1 : 0.0;
    if (made[which] == NULL)
    {
        EXPECT(cm_camera_create(&options, &made[which]) == CM_OK, "%d", which);
    }
    return made[which];
}

static cm_rays *take_rays(supply *from, cm_camera_options *options)
{
    const cm_camera *camera = take_camera(from);
    cm_rays *rays = NULL;
    const char *set = cm_instructions_at(take_byte(from) % cm_instructions_count());
    EXPECT(cm_rays_create(NULL, set, &rays) == CM_ERROR_ARGUMENT, "no camera");
    EXPECT(cm_rays_create(camera, set, &rays) == CM_OK, "%s", set);
    EXPECT(cm_rays_use_pool(rays, NULL) == CM_OK, "pool");
    EXPECT(cm_rays_pixel_count(NULL) + cm_rays_halved_pixel_count(NULL) +
                   cm_depth_pyramid_pixel_count(NULL) ==
               0,
           "pixels of nothing");
    EXPECT(cm_rays_halved_pixel_count(rays) * 4 <= cm_rays_pixel_count(rays), "half of each side");
    EXPECT(cm_rays_use_pool(NULL, NULL) == CM_ERROR_ARGUMENT, "no rays");
    *options = *cm_camera_describe(camera);
    return rays;
}

static void check_clean(supply *from, const float *image, uint32_t width, uint32_t height)
{
    const size_t pixels = (size_t)width * height;
    float clean[PIXELS_MOST];
    const cm_image picture = {.size = sizeof picture,
                              .data = (void *)(uintptr_t)image,
                              .type = (cm_pixel_type)(take_byte(from) % 5),
                              .width = width,
                              .height = height / 2, /* of shorts there are twice as many */
                              .channels = 1};
    const cm_depth_limits limits = {.size = sizeof limits,
                                    .unit = take_double(from),
                                    .nearest = take_double(from),
                                    .farthest = take_double(from)};
    cm_depth_count count = {.size = sizeof count};
    const cm_status status =
        height < 2 ? CM_ERROR_RANGE : cm_depth_clean(&picture, &limits, 1, clean, &count);
    if (status == CM_OK)
    {
        size_t valid = 0;
        for (size_t i = 0; i < (size_t)width * (height / 2); i++)
        {
            EXPECT(isnan(clean[i]) || is_measured(clean[i]), "%g", (double)clean[i]);
            valid += !isnan(clean[i]);
        }
        EXPECT(valid == count.valid, "%zu", valid);
        EXPECT(count.valid + count.zero + count.nan + count.infinite + count.negative + count.near +
                       count.far ==
                   pixels / height * (height / 2),
               "%zu", count.valid);
    }
}

static void check_bounds(supply *from, const float *image, uint32_t width, uint32_t height)
{
    cm_depth_pyramid *pyramid = NULL;
    cm_depth_bounds bounds;
    cm_depth_level level = {.size = sizeof level};
    uint32_t box[4];
    take_bytes(from, box, sizeof box);
    const int is_any = take_byte(from) % 4 == 0;
    for (int k = 0; k < 4 && !is_any; k++)
    {
        box[k] %= k % 2 ? height : width;
    }
    EXPECT(cm_depth_pyramid_create(box[0], 0, NULL, &pyramid) == CM_ERROR_RANGE, "no rows");
    EXPECT(cm_depth_pyramid_create(width, height, NULL, &pyramid) == CM_OK, "%u", width);
    EXPECT(cm_depth_pyramid_use_pool(pyramid, NULL) == CM_OK, "pool");
    EXPECT(cm_depth_pyramid_fill(pyramid, image, threads) == CM_OK, "fill");
    const uint32_t last = cm_depth_pyramid_last(pyramid);
    EXPECT(cm_depth_pyramid_level(pyramid, last + 1, &level) == CM_ERROR_ARGUMENT, "%u", last);
    EXPECT(cm_depth_pyramid_level(pyramid, last, &level) == CM_OK, "%u", last);
    if (cm_depth_pyramid_bounds(pyramid, box[0], box[1], box[2], box[3], &bounds) == CM_OK)
    {
        for (uint32_t row = box[1]; row <= box[3]; row++)
        {
            for (uint32_t column = box[0]; column <= box[2]; column++)
            {
                const float value = image[row * width + column];
                EXPECT(is_measured(value) ? value >= bounds.least && value <= bounds.most
                                          : bounds.has_unmeasured,
                       "%g", (double)value);
            }
        }
    }
    cm_depth_pyramid_destroy(pyramid);
}

static void check_maps(supply *from, const cm_rays *rays, const float *image, size_t pixels)
{
    static float one[8 * PIXELS_MOST];
    static float two[8 * PIXELS_MOST];
    const int is_range = take_byte(from) % 2;
    const double gap = take_byte(from) % 2 ? take_double(from) : 0.1;
    const double sigma = take_byte(from) % 2 ? take_double(from) : 0.05;
    cm_status status[2];
    cm_status smooth[2];
    memset(one, 0, 8 * pixels * sizeof *one);
    memset(two, 0, 8 * pixels * sizeof *two);
    for (int i = 0; i < 2; i++)
    {
        float *to = i == 0 ? one : two;
        cm_depth_maps maps = {.size = sizeof maps, .is_range = is_range, .gap = gap};
        for (size_t k = 0; k < 3; k++)
        {
            maps.vertex[k] = to + k * pixels;
            maps.normal[k] = to + (3 + k) * pixels;
        }
        maps.radius = to + 6 * pixels;
        status[i] = cm_depth_make_maps(rays, image, i == 0 ? 1 : threads, &maps);
        smooth[i] = cm_depth_smooth(rays, image, 1.0, sigma, i == 0 ? 1 : threads, to + 7 * pixels);
    }
    EXPECT(status[0] == status[1] && smooth[0] == smooth[1], "%d", (int)status[0]);
    EXPECT(memcmp(one, two, 8 * pixels * sizeof *one) == 0, "threads");
    for (size_t i = 0; i < pixels && smooth[0] == CM_OK; i++)
    {
        const float value = one[7 * pixels + i];
        EXPECT(image[i] == FLT_MAX || isnan(value) == !is_measured(image[i]), "%g from %g",
               (double)value, (double)image[i]);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    static float image[PIXELS_MOST];
    static float other[PIXELS_MOST];
    cm_camera_options options;
    cm_camera_options half;
    cm_rays *rays = take_rays(&from, &options);
    const size_t pixels = (size_t)options.width * options.height;
    for (size_t i = 0; i < pixels; i++)
    {
        image[i] = take_value(&from);
    }
    threads = take_byte(&from) % 64 == 1 ? 2 : 1;
    check_clean(&from, image, options.width, options.height);
    check_bounds(&from, image, options.width, options.height);
    if (rays != NULL)
    {
        check_maps(&from, rays, image, pixels);
        const cm_status halved = cm_depth_halve(rays, image, take_double(&from), 1, other);
        EXPECT(halved == CM_OK || halved == CM_ERROR_RANGE, "%d", (int)halved);
        EXPECT(cm_depth_to_range(rays, image, 1, other) == CM_OK &&
                   cm_depth_from_range(rays, other, 1, other) == CM_OK,
               "ranges");
    }
    const cm_status status = cm_depth_halve_camera(&options, &half);
    EXPECT((status == CM_OK) == (options.width > 1 && options.height > 1), "%d", (int)status);
    cm_rays_destroy(rays);
    return 0;
}
