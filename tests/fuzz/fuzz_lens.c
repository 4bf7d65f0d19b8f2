/* SPDX-License-Identifier: MIT
 *
 * Lenses of any numbers for rasterisers: what is none is refused, moved vertices are three numbers or three NaN, the enlarged
 * pinhole leaves nothing unfilled, and labels are some pixel's.
 */
#include "fuzz.h"

#include <cubemap/lens.h>

#include <math.h>

enum
{
    PIXELS_MOST = 1 << 16
};

/* A number of any kind, of which many are what a lens may have. */
static double take_number(supply *from, double scale)
{
    return take_byte(from) % 16 == 0 ? take_double(from) : scale * take_fraction(from);
}

static cm_camera *take_camera(supply *from)
{
    static const double scales[14] = {0.4, 0.2,  0.02, 0.02, 0.1,  0.2, 0.1,
                                      0.1, 0.02, 0.02, 0.02, 0.02, 0.1, 0.1};
    cm_camera *camera = NULL;
    cm_camera_options options = {.size = sizeof options};
    options.width = 1u + take_byte(from) % 24;
    options.height = 1u + take_byte(from) % 24;
    options.fx = take_byte(from) % 16 == 0 ? take_double(from) : 12.0 + 6.0 * take_fraction(from);
    options.fy = options.fx * (1.0 + 0.2 * take_fraction(from));
    options.cx = 0.5 * options.width + take_number(from, 3.0);
    options.cy = 0.5 * options.height + take_number(from, 3.0);
    options.pixel_centre = take_byte(from) % 2 * 0.5;
    const uint8_t count = take_byte(from) % 15;
    for (uint8_t i = 0; i < count; i++)
    {
        options.distortion[i] = take_number(from, scales[i]);
    }
    return cm_camera_create(&options, &camera) == CM_OK ? camera : NULL;
}

static void check_vertices(supply *from, const cm_camera *camera)
{
    double point[3][4], guard = 0.0, frustum[4];
    const double delta = take_number(from, 1.0);
    for (int i = 0; i < 12; i++)
    {
        point[i % 3][i / 3] = take_number(from, 3.0);
    }
    EXPECT(cm_lens_frustum(camera, frustum) == CM_OK, "a frustum");
    const cm_status status = cm_lens_guard(camera, delta, &guard);
    EXPECT(status == CM_OK ? guard >= 1.0 : guard == 0.0, "%d: %g", status, guard);
    guard = take_byte(from) % 2 ? guard : take_double(from);
    if (cm_lens_move_vertices(camera, guard, 4, point[0], point[1], point[2], point[0], point[1],
                              point[2]) == CM_OK)
    {
        for (int i = 0; i < 4; i++)
        {
            EXPECT(isnan(point[0][i]) == isnan(point[2][i]) &&
                       isnan(point[1][i]) == isnan(point[2][i]),
                   "%g %g %g", point[0][i], point[1][i], point[2][i]);
            EXPECT(!(point[2][i] <= 0.0), "%g", point[2][i]);
        }
    }
}

static void check_pictures(supply *from, const cm_lens_map *map)
{
    static float picture[2 * PIXELS_MOST], to[2 * PIXELS_MOST];
    static double column[PIXELS_MOST], row[PIXELS_MOST];
    static unsigned char label[PIXELS_MOST];
    const size_t source = cm_lens_map_pinhole_pixel_count(map), n = cm_lens_map_pixel_count(map);
    unsigned char values[7];
    take_bytes(from, values, sizeof values);
    for (size_t i = 0; i < source; i++)
    {
        const unsigned char value = values[i % sizeof values];
        picture[2 * i] = picture[2 * i + 1] = value == 0   ? NAN
                                              : value == 1 ? INFINITY
                                                           : 0.1f * value;
        label[i] = value;
    }
    EXPECT(cm_lens_map_places(map, column, row) == CM_OK, "places");
    EXPECT(cm_lens_map_color(map, 2, picture, to, NULL) == CM_OK, "colours");
    EXPECT(cm_lens_map_flow(map, picture, to, NULL) == CM_OK, "flow");
    const double gap = take_double(from);
    const cm_status status = cm_lens_map_depth(map, gap, picture, to, NULL);
    EXPECT(status == (gap >= 0.0 ? CM_OK : CM_ERROR_RANGE), "%g", gap);
    for (size_t i = 0; i < n && status == CM_OK; i++)
    {
        EXPECT(isnan(to[i]) || (to[i] > 0.19f && to[i] < 25.6f), "%g", (double)to[i]);
        EXPECT(isnan(column[i]) == isnan(row[i]), "%g %g", column[i], row[i]);
    }
    unsigned char taken[24 * 24];
    EXPECT(cm_lens_map_labels(map, 1, label, "\x80", taken, NULL) == CM_OK, "labels");
    for (size_t i = 0; i < n; i++)
    {
        EXPECT(isnan(column[i]) ? taken[i] == 0x80
                                : memchr(values, taken[i], sizeof values) != NULL,
               "%d", taken[i]);
    }
}

static void check_images(supply *from, const cm_camera *camera)
{
    cm_camera_options wide = {.size = sizeof wide};
    cm_camera *pinhole = NULL;
    cm_lens_map *map = NULL;
    const uint8_t kind = take_byte(from);
    const double scale = kind % 4 == 0 ? take_double(from) : kind % 4 == 1 ? 0.0 : 1.0;
    const cm_status status = cm_lens_pinhole(camera, scale, &wide);
    EXPECT(status == CM_OK || wide.width == 0, "%u", wide.width);
    if (status != CM_OK || (double)wide.width * wide.height > PIXELS_MOST ||
        cm_camera_create(&wide, &pinhole) != CM_OK)
    {
        return;
    }
    EXPECT(cm_lens_map_create(camera, pinhole, NULL, &map) == CM_OK, "a map");
    EXPECT(cm_lens_map_unfilled(map) == 0, "%zu", cm_lens_map_unfilled(map));
    check_pictures(from, map);
    cm_lens_map_destroy(map);
    cm_camera_destroy(pinhole);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    cm_camera *camera = take_camera(&from);
    if (camera != NULL)
    {
        check_vertices(&from, camera);
        check_images(&from, camera);
    }
    cm_camera_destroy(camera);
    return 0;
}
