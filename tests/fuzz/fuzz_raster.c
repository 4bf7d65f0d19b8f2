/* SPDX-License-Identifier: MIT
 *
 * Triangles, discs and points of any numbers into cameras of every kind: what is seen is in front, has an id that was
 * drawn, and the same bits by two threads, in any order.
 */
#include "fuzz.h"

#include <cubemap/cubemap.h>
#include <cubemap/raster.h>

#include <math.h>

enum
{
    COUNT = 12,
    SIDE_MOST = 24,
    PIXELS_MOST = 6 * SIDE_MOST * SIDE_MOST
};

static double take_number(supply *from)
{
    const uint8_t kind = take_byte(from);
    return kind < 120   ? 4.0 * take_fraction(from)
           : kind < 220 ? (double)(kind % 7) - 3.0
           : kind < 225 ? 1.7e7
                        : take_double(from);
}

/* Cameras are made once: the valid field of one takes longer to find than all else here. */
static const cm_camera *take_camera(supply *from)
{
    static const char *const names[] = {"coupled", "healpix", "azimuthal:equidistant", "tangent"};
    static const uint32_t widths[] = {1, 7, 16, SIDE_MOST};
    static cm_camera *made[48];
    const uint8_t which = take_byte(from) % 48;
    const uint32_t kind = which / 8;
    cm_mapping *mapping = NULL;
    cm_camera_options options = {.size = sizeof options,
                                 .width = widths[which % 4],
                                 .height = 19,
                                 .fx = 10.0,
                                 .fy = 11.0,
                                 .cx = 8.0,
                                 .cy = 8.0};
    options.pixel_centre = which & 4 ? 0.5 : 0.0;
    options.distortion[0] = kind == 1 ? -0.1 : 0.0;
    if (made[which] == NULL)
    {
        if (kind >= 2)
        {
            EXPECT(cm_mapping_create(names[kind - 2], NULL, &mapping) == CM_OK, "%u", kind);
            options.mapping = mapping;
            options.height = kind == 4 ? options.width : 6 * options.width;
        }
        EXPECT(cm_camera_create(&options, &made[which]) == CM_OK, "%d", which);
        cm_mapping_destroy(mapping);
    }
    return made[which];
}

static cm_raster *take_raster(supply *from, size_t *pixels)
{
    const cm_camera *camera = take_camera(from);
    const cm_camera_options *options = cm_camera_describe(camera);
    cm_raster *raster = NULL;
    const double nearest = take_byte(from) % 4 ? 0.0 : take_number(from);
    const char *set = cm_instructions_at(take_byte(from) % cm_instructions_count());
    *pixels = (size_t)options->width * options->height;
    const cm_status status = cm_raster_create(camera, nearest, set, &raster);
    EXPECT((status == CM_OK) == (nearest >= 0.0 && isfinite(nearest)), "%g: %d", nearest,
           (int)status);
    return raster;
}

/* Everything that is drawn. */
typedef struct all_shapes
{
    double position[COUNT][3];
    uint32_t index[COUNT * 3];
    float disc[7][COUNT];
    cm_triangles triangles;
    cm_discs discs;
    cm_points points;
} all_shapes;

static void take_shapes(supply *from, all_shapes *all)
{
    for (size_t i = 0; i < COUNT; i++)
    {
        for (size_t k = 0; k < 3; k++)
        {
            all->position[i][k] = take_number(from);
            all->index[3 * i + k] = take_byte(from) % COUNT;
        }
        for (size_t k = 0; k < 7; k++)
        {
            all->disc[k][i] = (float)take_number(from);
        }
    }
    all->triangles = (cm_triangles){.size = sizeof all->triangles,
                                    .vertex_count = COUNT,
                                    .position = all->position[0],
                                    .triangle_count = COUNT,
                                    .index = all->index};
    all->discs = (cm_discs){.size = sizeof all->discs,
                            .count = COUNT,
                            .centre = {all->disc[0], all->disc[1], all->disc[2]},
                            .normal = {all->disc[3], all->disc[4], all->disc[5]},
                            .radius = all->disc[6],
                            .first_id = COUNT};
    all->points = (cm_points){.size = sizeof all->points,
                              .count = COUNT,
                              .position = all->position[0],
                              .first_id = 2 * COUNT};
}

static void draw(cm_raster *raster, const cm_pose *pose, const all_shapes *all, int is_back,
                 float *image, uint32_t *id)
{
    const unsigned threads = is_back == 2 ? 2 : 1;
    EXPECT(cm_raster_use_pool(raster, NULL) == CM_OK, "pool");
    cm_raster_clear(raster);
    for (int i = 0; i < 3; i++)
    {
        const int which = is_back ? 2 - i : i;
        const cm_status status =
            which == 0   ? cm_raster_triangles(raster, pose, &all->triangles, threads)
            : which == 1 ? cm_raster_discs(raster, pose, &all->discs, threads)
                         : cm_raster_points(raster, pose, &all->points, threads);
        EXPECT(status == CM_OK, "%d", (int)status);
    }
    EXPECT(cm_raster_read(raster, image, id) == CM_OK, "read");
}

static void check_refusals(cm_raster *raster, const all_shapes *all)
{
    uint32_t index[3] = {0, 1, COUNT};
    cm_triangles triangles = all->triangles;
    cm_discs discs = all->discs;
    cm_points points = all->points;
    triangles.index = index;
    triangles.triangle_count = 1;
    discs.first_id = points.first_id = CM_RASTER_NOTHING;
    EXPECT(cm_raster_triangles(raster, NULL, &triangles, 1) == CM_ERROR_ARGUMENT, "index");
    EXPECT(cm_raster_discs(raster, NULL, &discs, 1) == CM_ERROR_RANGE, "ids");
    EXPECT(cm_raster_points(raster, NULL, &points, 1) == CM_ERROR_RANGE, "ids");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    static float image[2][PIXELS_MOST];
    static float weight[2][PIXELS_MOST];
    static uint32_t id[2][PIXELS_MOST];
    static all_shapes all;
    size_t pixels;
    cm_raster *raster = take_raster(&from, &pixels);
    if (raster != NULL)
    {
        cm_pose pose = {.position = {take_number(&from), take_number(&from), take_number(&from)}};
        cm_rotation_from_angles(90.0 * take_fraction(&from), 0.0, 0.0, &pose.rotation);
        const cm_pose *taken = take_byte(&from) % 2 ? &pose : NULL;
        take_shapes(&from, &all);
        check_refusals(raster, &all);
        EXPECT(cm_raster_pixel_count(raster) == pixels, "%zu", pixels);
        draw(raster, taken, &all, 0, image[0], id[0]);
        /* not where the input is short and has ended: making threads takes longer than all else here */
        draw(raster, taken, &all, take_byte(&from) % 64 == 1 ? 2 : 1, image[1], id[1]);
        EXPECT(memcmp(id[0], id[1], pixels * sizeof **id) == 0, "ids");
        EXPECT(memcmp(image[0], image[1], pixels * sizeof **image) == 0, "depths");
        EXPECT(cm_raster_weights(raster, taken, &all.triangles, weight[0], weight[1]) == CM_OK,
               "weights");
        for (size_t i = 0; i < pixels; i++)
        {
            EXPECT(id[0][i] == CM_RASTER_NOTHING ? isnan(image[0][i])
                                                 : id[0][i] < 3 * COUNT && image[0][i] > 0.0f,
                   "%u: %g", id[0][i], (double)image[0][i]);
            EXPECT(isnan(weight[0][i]) || (weight[0][i] >= 0.0f && weight[0][i] <= 1.0f), "%g",
                   (double)weight[0][i]);
        }
    }
    cm_raster_destroy(raster);
    return 0;
}
