/* SPDX-License-Identifier: MIT
 *
 * The two ways of a lens through a rasteriser that knows pinholes alone, beside rays through the lens.
 */
#include <cubemap/lens.h>
#include <cubemap/raster.h>

#include "tests/suite.h"
#include "lens_room.h"

static cm_camera *make(const cm_camera_options *options)
{
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(options, &camera), CM_OK);
    return camera;
}

static cm_camera_options without_lens(cm_camera_options options)
{
    memset(options.distortion, 0, sizeof options.distortion);
    return options;
}

/* A rasteriser of the pinhole: depth and quads of the room, whose vertices are where they are said to be. */
static void draw(const cm_camera *pinhole, const lens_room *room, const double *position,
                 float *depth, uint32_t *quad)
{
    cm_raster *raster = NULL;
    const cm_triangles triangles = {.size = sizeof triangles,
                                    .vertex_count = room->vertices,
                                    .position = position,
                                    .triangle_count = room->triangles,
                                    .index = room->index};
    ck_assert_int_eq(cm_raster_create(pinhole, 0.0, NULL, &raster), CM_OK);
    ck_assert_int_eq(cm_raster_triangles(raster, NULL, &triangles, 1), CM_OK);
    ck_assert_int_eq(cm_raster_read(raster, depth, quad), CM_OK);
    const size_t n = cm_raster_pixel_count(raster);
    for (size_t i = 0; i < n; i++)
    {
        quad[i] = quad[i] == CM_RASTER_NOTHING ? quad[i] : quad[i] / (uint32_t)room->per_quad;
    }
    cm_raster_destroy(raster);
}

/* What a way gives beside rays. */
typedef struct comparison
{
    double error; /* the greatest relative error of depth where both show one quad */
    double mean;
    size_t other; /* pixels of another quad */
    size_t holes; /* pixels that rays fill and the way does not */
} comparison;

static comparison compare_ways(size_t n, const float *depth, const uint32_t *quad,
                               const double *true_depth, const uint32_t *true_quad)
{
    comparison made = {0};
    size_t count = 0;
    for (size_t i = 0; i < n; i++)
    {
        made.holes += quad[i] == UINT32_MAX && true_quad[i] != UINT32_MAX;
        made.other += quad[i] != true_quad[i];
        if (quad[i] == true_quad[i] && quad[i] != UINT32_MAX)
        {
            const double error = fabs((double)depth[i] / true_depth[i] - 1.0);
            made.error = fmax(made.error, error);
            made.mean += error;
            count++;
        }
    }
    made.mean /= (double)count;
    return made;
}

typedef struct pictures
{
    size_t n;
    float *depth;
    uint32_t *quad;
    double *true_depth;
    uint32_t *true_quad;
} pictures;

static pictures make_pictures(size_t n)
{
    return (pictures){n, malloc(n * sizeof(float)), malloc(n * sizeof(uint32_t)),
                      malloc(n * sizeof(double)), malloc(n * sizeof(uint32_t))};
}

static void drop_pictures(pictures *p)
{
    free(p->depth);
    free(p->quad);
    free(p->true_depth);
    free(p->true_quad);
}

/* ---- vertices ---- */

static comparison try_vertices(int lens, size_t parts, double guard_change)
{
    const cm_camera_options options = lens_options(lens), plain = without_lens(options);
    cm_camera *camera = make(&options), *pinhole = make(&plain);
    lens_room room = make_room(parts);
    pictures p = make_pictures((size_t)options.width * options.height);
    double guard = 0.0;
    double *moved = malloc(3 * room.vertices * sizeof *moved);
    cast_room(camera, &room, p.true_depth, p.true_quad);
    ck_assert_int_eq(cm_lens_guard(camera, 0.1, &guard), CM_OK);
    ck_assert_int_eq(cm_lens_move_vertices(camera, guard + guard_change, room.vertices,
                                           room.plane[0], room.plane[1], room.plane[2],
                                           room.plane[0], room.plane[1], room.plane[2]),
                     CM_OK);
    for (size_t v = 0; v < 3 * room.vertices; v++)
    {
        moved[v] = room.plane[v % 3][v / 3];
    }
    draw(pinhole, &room, moved, p.depth, p.quad);
    const comparison made = compare_ways(p.n, p.depth, p.quad, p.true_depth, p.true_quad);
    free(moved);
    drop_pictures(&p);
    drop_room(&room);
    cm_camera_destroy(camera);
    cm_camera_destroy(pinhole);
    return made;
}

/* Triangles a quarter as long leave a sixteenth of the error. */
START_TEST(vertices_are_right_where_triangles_are_small)
{
    for (int lens = 0; lens < ROOM_LENSES; lens++)
    {
        const comparison coarse = try_vertices(lens, 16, 0.0);
        const comparison fine = try_vertices(lens, 64, 0.0);
        REQUIRE(coarse.mean < 1e-3, "%d: %g", lens, coarse.mean);
        REQUIRE(fine.mean < coarse.mean / 12.0, "%d: %g of %g", lens, fine.mean, coarse.mean);
        REQUIRE(fine.error < 1e-3, "%d: %g", lens, fine.error);
        REQUIRE(fine.other <= 5, "%d: %zu", lens, fine.other);
        REQUIRE(fine.holes == 0, "%d: %zu", lens, fine.holes);
    }
}
END_TEST

/* A barrel brings in what is beyond the frustum: without D there are holes in the corners. */
START_TEST(the_guard_is_needed)
{
    const cm_camera_options options = lens_options(0);
    cm_camera *camera = make(&options);
    double guard = 0.0;
    ck_assert_int_eq(cm_lens_guard(camera, 0.1, &guard), CM_OK);
    REQUIRE(guard > 1.15, "%g", guard);
    REQUIRE(try_vertices(0, 64, 1.0 - guard).holes > 50, "no hole");
    cm_camera_destroy(camera);
}
END_TEST

/* D of the corners, as the paper prints it, and that of edges whose middles are further out. */
START_TEST(the_guard_is_that_of_the_corners_or_more)
{
    for (int lens = 0; lens < ROOM_LENSES; lens++)
    {
        const cm_camera_options options = lens_options(lens);
        cm_camera *camera = make(&options);
        double guard = 0.0, frustum[4], corners = 1.0;
        ck_assert_int_eq(cm_lens_guard(camera, 0.0, &guard), CM_OK);
        ck_assert_int_eq(cm_lens_frustum(camera, frustum), CM_OK);
        for (int i = 0; i < 4; i++)
        {
            const double edge = options.pixel_centre - 0.5;
            const double column = edge + (i % 2) * 200.0, row = edge + (i / 2) * 150.0;
            double ray[3];
            cm_camera_ray_array(camera, 1, &column, &row, &ray[0], &ray[1], &ray[2]);
            const double x = (2.0 * ray[0] - frustum[0] - frustum[1]) / (frustum[1] - frustum[0]);
            const double y = (2.0 * ray[1] - frustum[2] - frustum[3]) / (frustum[3] - frustum[2]);
            corners = fmax(corners, fmax(fabs(x), fabs(y)));
        }
        REQUIRE(guard >= corners - 1e-12, "%d: %g of %g", lens, guard, corners);
        REQUIRE(lens != 0 || guard <= corners + 1e-12, "%g of %g", guard, corners);
        cm_camera_destroy(camera);
    }
}
END_TEST

/* l = -(cx + 0.5) / fx and so on, as printed, where centres are at integers; rows go down here. */
START_TEST(the_frustum_is_as_printed)
{
    const cm_camera_options options = lens_options(1);
    cm_camera *camera = make(&options);
    double frustum[4];
    ck_assert_int_eq(cm_lens_frustum(camera, frustum), CM_OK);
    REQUIRE(fabs(frustum[0] + (options.cx + 0.5) / options.fx) < 1e-15, "%g", frustum[0]);
    REQUIRE(fabs(frustum[1] - frustum[0] - options.width / options.fx) < 1e-15, "%g", frustum[1]);
    REQUIRE(fabs(frustum[2] + (options.cy + 0.5) / options.fy) < 1e-15, "%g", frustum[2]);
    REQUIRE(fabs(frustum[3] - frustum[2] - options.height / options.fy) < 1e-15, "%g", frustum[3]);
    cm_camera_destroy(camera);
}
END_TEST

/* A moved vertex projects through the pinhole to where the lens has it. */
START_TEST(vertices_go_where_the_lens_has_them)
{
    const double x[4] = {0.3, -1.2, 0.1, 50.0}, y[4] = {0.2, 0.7, 0.3, 0.0};
    const double z[4] = {1.0, 2.5, -1.0, 1.0};
    for (int lens = 0; lens < ROOM_LENSES; lens++)
    {
        const cm_camera_options options = lens_options(lens), plain = without_lens(options);
        cm_camera *camera = make(&options), *pinhole = make(&plain);
        double to[3][4], column[2][4], row[2][4];
        ck_assert_int_eq(cm_lens_move_vertices(camera, 1.5, 4, x, y, z, to[0], to[1], to[2]),
                         CM_OK);
        cm_camera_project_array(camera, 4, x, y, z, column[0], row[0]);
        cm_camera_project_array(pinhole, 4, to[0], to[1], to[2], column[1], row[1]);
        for (int i = 0; i < 4; i++)
        {
            REQUIRE(i < 2 ? fabs(column[0][i] - column[1][i]) + fabs(row[0][i] - row[1][i]) < 1e-11
                          : isnan(to[0][i]) && isnan(to[1][i]) && isnan(to[2][i]),
                    "%d %d: %g %g", lens, i, column[0][i], column[1][i]);
            REQUIRE(i >= 2 || to[2][i] == z[i], "%g", to[2][i]);
        }
        cm_camera_destroy(camera);
        cm_camera_destroy(pinhole);
    }
}
END_TEST

/* ---- images ---- */

typedef struct image_way
{
    cm_camera *camera, *pinhole;
    cm_lens_map *map;
    float *depth; /* through the pinhole */
    uint32_t *quad;
    size_t pixels; /* of the pinhole */
} image_way;

static image_way begin_images(int lens, double scale, const lens_room *room)
{
    const cm_camera_options options = lens_options(lens);
    image_way way = {.camera = make(&options)};
    cm_camera_options wide = {.size = sizeof wide};
    ck_assert_int_eq(cm_lens_pinhole(way.camera, scale, &wide), CM_OK);
    way.pinhole = make(&wide);
    way.pixels = (size_t)wide.width * wide.height;
    way.depth = malloc(way.pixels * sizeof *way.depth);
    way.quad = malloc(way.pixels * sizeof *way.quad);
    draw(way.pinhole, room, room->position, way.depth, way.quad);
    ck_assert_int_eq(cm_lens_map_create(way.camera, way.pinhole, NULL, &way.map), CM_OK);
    return way;
}

static void end_images(image_way *way)
{
    cm_lens_map_destroy(way->map);
    cm_camera_destroy(way->pinhole);
    cm_camera_destroy(way->camera);
    free(way->depth);
    free(way->quad);
}

START_TEST(images_are_right_on_planes)
{
    lens_room room = make_room(1);
    for (int lens = 0; lens < ROOM_LENSES; lens++)
    {
        image_way way = begin_images(lens, 0.0, &room);
        pictures p = make_pictures(200 * 150);
        const uint32_t nothing = UINT32_MAX;
        cast_room(way.camera, &room, p.true_depth, p.true_quad);
        ck_assert_int_eq(cm_lens_map_depth(way.map, 0.0, way.depth, p.depth, NULL), CM_OK);
        ck_assert_int_eq(cm_lens_map_labels(way.map, 4, way.quad, &nothing, p.quad, NULL), CM_OK);
        ck_assert_uint_eq(cm_lens_map_unfilled(way.map), 0);
        const comparison made = compare_ways(p.n, p.depth, p.quad, p.true_depth, p.true_quad);
        /* beside folds of the room four pixels are of two planes, and mixed: there alone is there an error */
        REQUIRE(made.mean < 2e-4, "%d: %g", lens, made.mean);
        REQUIRE(made.error < 0.05, "%d: %g", lens, made.error);
        REQUIRE(made.other < 700, "%d: %zu", lens, made.other);
        REQUIRE(made.holes == 0, "%d: %zu", lens, made.holes);
        size_t exact = 0;
        for (size_t i = 0; i < p.n; i++)
        {
            exact += fabs((double)p.depth[i] / p.true_depth[i] - 1.0) < 1e-6;
        }
        REQUIRE(exact > p.n * 93 / 100, "%d: %zu of %zu", lens, exact, p.n);
        drop_pictures(&p);
        end_images(&way);
    }
    drop_room(&room);
}
END_TEST

/* No depth is between the board and the wall behind it. */
START_TEST(nothing_comes_between_surfaces)
{
    lens_room room = make_room(1);
    image_way way = begin_images(1, 0.0, &room);
    float *depth = malloc(200 * 150 * sizeof *depth);
    ck_assert_int_eq(cm_lens_map_depth(way.map, 0.0, way.depth, depth, NULL), CM_OK);
    static double column[200 * 150], row[200 * 150];
    ck_assert_int_eq(cm_lens_map_places(way.map, column, row), CM_OK);
    const cm_camera_options *wide = cm_camera_describe(way.pinhole);
    size_t jumps = 0;
    for (size_t i = 0; i < 200 * 150; i++)
    {
        const size_t at = (size_t)(row[i] - wide->pixel_centre) * wide->width +
                          (size_t)(column[i] - wide->pixel_centre);
        const float four[4] = {way.depth[at], way.depth[at + 1], way.depth[at + wide->width],
                               way.depth[at + wide->width + 1]};
        float least = four[0], most = four[0];
        for (int k = 1; k < 4; k++)
        {
            least = fminf(least, four[k]);
            most = fmaxf(most, four[k]);
        }
        if (most > least * 1.05f)
        {
            jumps++;
            REQUIRE(depth[i] == four[0] || depth[i] == four[1] || depth[i] == four[2] ||
                        depth[i] == four[3],
                    "%zu: %g", i, (double)depth[i]);
        }
    }
    REQUIRE(jumps > 100, "%zu", jumps);
    free(depth);
    end_images(&way);
    drop_room(&room);
}
END_TEST

/* Where one of the four was not measured the nearest pixel is taken, and that may be none. */
START_TEST(holes_do_not_grow)
{
    lens_room room = make_room(1);
    image_way way = begin_images(1, 0.0, &room);
    const cm_camera_options *wide = cm_camera_describe(way.pinhole);
    float *depth = malloc(200 * 150 * sizeof *depth);
    static double column[200 * 150], row[200 * 150];
    for (size_t i = 0; i < way.pixels; i += 5)
    {
        way.depth[i] = i % 2 ? NAN : i % 4 ? 0.0f : INFINITY;
    }
    ck_assert_int_eq(cm_lens_map_places(way.map, column, row), CM_OK);
    ck_assert_int_eq(cm_lens_map_depth(way.map, 0.0, way.depth, depth, NULL), CM_OK);
    size_t holes = 0;
    for (size_t i = 0; i < 200 * 150; i++)
    {
        const size_t at = (size_t)(row[i] - wide->pixel_centre + 0.5) * wide->width +
                          (size_t)(column[i] - wide->pixel_centre + 0.5);
        REQUIRE((at % 5 == 0) == (isnan(depth[i]) != 0), "%zu: %g", i, (double)depth[i]);
        holes += at % 5 == 0;
    }
    REQUIRE(holes > 3000 && holes < 9000, "%zu", holes);
    free(depth);
    end_images(&way);
    drop_room(&room);
}
END_TEST

/* The pinhole of the camera itself leaves a rim; the enlarged one leaves none, whatever its scale. */
START_TEST(the_enlarged_frustum_leaves_no_rim)
{
    for (int lens = 0; lens < ROOM_LENSES; lens++)
    {
        const cm_camera_options options = lens_options(lens), plain = without_lens(options);
        cm_camera *camera = make(&options), *narrow = make(&plain);
        cm_lens_map *map = NULL;
        ck_assert_int_eq(cm_lens_map_create(camera, narrow, NULL, &map), CM_OK);
        REQUIRE(lens != 0 || cm_lens_map_unfilled(map) > 500, "%zu", cm_lens_map_unfilled(map));
        cm_lens_map_destroy(map);
        for (int s = 0; s < 4; s++)
        {
            static const double scales[4] = {0.0, 0.25, 1.0, 1.7};
            cm_camera_options wide = {.size = sizeof wide};
            ck_assert_int_eq(cm_lens_pinhole(camera, scales[s], &wide), CM_OK);
            cm_camera *pinhole = make(&wide);
            ck_assert_int_eq(cm_lens_map_create(camera, pinhole, NULL, &map), CM_OK);
            ck_assert_uint_eq(cm_lens_map_unfilled(map), 0);
            cm_lens_map_destroy(map);
            cm_camera_destroy(pinhole);
        }
        cm_camera_destroy(narrow);
        cm_camera_destroy(camera);
    }
}
END_TEST

/* With scale 0 neighbours are a pixel apart, or more; somewhere just that. */
START_TEST(the_pinhole_is_as_fine_as_the_lens)
{
    for (int lens = 0; lens < ROOM_LENSES; lens++)
    {
        lens_room room = make_room(1);
        image_way way = begin_images(lens, 0.0, &room);
        static double column[200 * 150], row[200 * 150];
        double least = INFINITY;
        ck_assert_int_eq(cm_lens_map_places(way.map, column, row), CM_OK);
        for (size_t i = 0; i < 200 * 149; i++)
        {
            least = fmin(least, hypot(column[i + 200] - column[i], row[i + 200] - row[i]));
            least = i % 200 == 199
                        ? least
                        : fmin(least, hypot(column[i + 1] - column[i], row[i + 1] - row[i]));
        }
        for (size_t i = 200 * 149; i < 200 * 150 - 1; i++)
        {
            least = fmin(least, hypot(column[i + 1] - column[i], row[i + 1] - row[i]));
        }
        REQUIRE(fabs(least - 1.0) < 1e-9, "%d: %.17g", lens, least);
        end_images(&way);
        drop_room(&room);
    }
}
END_TEST

/* Colours that are linear on the undistorted picture stay so; NaN does not spread; ids are some pixel's. */
START_TEST(colors_are_interpolated_and_labels_are_not)
{
    lens_room room = make_room(1);
    image_way way = begin_images(1, 1.0, &room);
    const cm_camera_options *wide = cm_camera_describe(way.pinhole);
    float *color = malloc(2 * way.pixels * sizeof *color);
    float *to = malloc(2 * 200 * 150 * sizeof *to);
    unsigned char *label = malloc(3 * way.pixels), *taken = malloc(3 * 200 * 150);
    for (size_t i = 0; i < way.pixels; i++)
    {
        color[2 * i] = (float)(i % wide->width) + 2.0f * (float)(i / wide->width);
        color[2 * i + 1] = i % 7 == 0 ? NAN : 1.0f;
        label[3 * i] = (unsigned char)(i % wide->width);
        label[3 * i + 1] = (unsigned char)(i / wide->width);
        label[3 * i + 2] = 7;
    }
    static double column[200 * 150], row[200 * 150];
    ck_assert_int_eq(cm_lens_map_places(way.map, column, row), CM_OK);
    ck_assert_int_eq(cm_lens_map_color(way.map, 2, color, to, NULL), CM_OK);
    ck_assert_int_eq(cm_lens_map_labels(way.map, 3, label, "...", taken, NULL), CM_OK);
    size_t none = 0;
    for (size_t i = 0; i < 200 * 150; i++)
    {
        const double at[2] = {column[i] - wide->pixel_centre, row[i] - wide->pixel_centre};
        REQUIRE(fabs((double)to[2 * i] - at[0] - 2.0 * at[1]) < 1e-4, "%g", (double)to[2 * i]);
        REQUIRE(isnan(to[2 * i + 1]) || to[2 * i + 1] == 1.0f, "%g", (double)to[2 * i + 1]);
        none += isnan(to[2 * i + 1]) ? 1u : 0u;
        REQUIRE(taken[3 * i] == (unsigned char)floor(at[0] + 0.5) &&
                    taken[3 * i + 1] == (unsigned char)floor(at[1] + 0.5) && taken[3 * i + 2] == 7,
                "%zu: %d of %g", i, taken[3 * i], at[0]);
    }
    REQUIRE(none > 2000 && none < 7000, "%zu", none);
    free(color);
    free(to);
    free(label);
    free(taken);
    end_images(&way);
    drop_room(&room);
}
END_TEST

/* A wall that moves aside: flow through the pinhole is the same everywhere, flow through the lens is not. */
START_TEST(flows_go_through_the_lens)
{
    lens_room room = make_room(1);
    image_way way = begin_images(1, 0.0, &room);
    const cm_camera_options *wide = cm_camera_describe(way.pinhole),
                            *options = cm_camera_describe(way.camera);
    const double move[2] = {0.05, -0.03}; /* of rays at z = 1 */
    float *flow = malloc(2 * way.pixels * sizeof *flow), *to = malloc(2 * 200 * 150 * sizeof *to);
    for (size_t i = 0; i < way.pixels; i++)
    {
        flow[2 * i] = (float)(wide->fx * move[0]);
        flow[2 * i + 1] = (float)(wide->fy * move[1]);
    }
    flow[0] = NAN;
    ck_assert_int_eq(cm_lens_map_flow(way.map, flow, to, NULL), CM_OK);
    double least = INFINITY, most = 0.0;
    for (size_t i = 0; i < 200 * 150; i++)
    {
        const double column = options->pixel_centre + (double)(i % 200);
        const double row = options->pixel_centre + (double)(i / 200);
        double ray[3], end[2];
        cm_camera_ray_array(way.camera, 1, &column, &row, &ray[0], &ray[1], &ray[2]);
        ray[0] += move[0];
        ray[1] += move[1];
        cm_camera_project_array(way.camera, 1, &ray[0], &ray[1], &ray[2], &end[0], &end[1]);
        REQUIRE(isnan(end[0]) ? isnan(to[2 * i])
                              : fabs((double)to[2 * i] - (end[0] - column)) < 1e-4 &&
                                    fabs((double)to[2 * i + 1] - (end[1] - row)) < 1e-4,
                "%zu: %g, not %g", i, (double)to[2 * i], end[0] - column);
        least = fmin(least, (double)to[2 * i]);
        most = fmax(most, (double)to[2 * i]);
    }
    REQUIRE(most > 1.2 * least, "%g to %g", least, most);
    free(flow);
    free(to);
    end_images(&way);
    drop_room(&room);
}
END_TEST

/* A camera whose corners see nothing, as its lens folds: they stay empty, and are not called unfilled. */
START_TEST(beyond_the_fold_nothing_is_shown)
{
    cm_camera_options options = lens_options(0);
    options.distortion[0] = -0.4;
    cm_camera *camera = make(&options);
    ck_assert_int_eq(cm_camera_has_ray(camera, 0.5, 0.5), 0);
    cm_camera_options wide = {.size = sizeof wide};
    double guard = 0.0;
    ck_assert_int_eq(cm_lens_guard(camera, 0.1, &guard), CM_OK);
    ck_assert_int_eq(cm_lens_pinhole(camera, 1.0, &wide), CM_OK);
    cm_camera *pinhole = make(&wide);
    cm_lens_map *map = NULL;
    ck_assert_int_eq(cm_lens_map_create(camera, pinhole, NULL, &map), CM_OK);
    ck_assert_uint_eq(cm_lens_map_unfilled(map), 0);
    float *depth = malloc((size_t)wide.width * wide.height * sizeof *depth);
    float *to = malloc(200 * 150 * sizeof *to);
    for (size_t i = 0; i < (size_t)wide.width * wide.height; i++)
    {
        depth[i] = 2.0f;
    }
    ck_assert_int_eq(cm_lens_map_depth(map, 0.0, depth, to, NULL), CM_OK);
    for (size_t i = 0; i < 200 * 150; i++)
    {
        const double column = 0.5 + (double)(i % 200), row = 0.5 + (double)(i / 200);
        REQUIRE(isnan(to[i]) != cm_camera_has_ray(camera, column, row), "%zu", i);
    }
    free(depth);
    free(to);
    cm_lens_map_destroy(map);
    cm_camera_destroy(pinhole);
    cm_camera_destroy(camera);
}
END_TEST

START_TEST(threads_have_the_same_bits)
{
    lens_room room = make_room(1);
    image_way way = begin_images(1, 0.0, &room);
    static const unsigned counts[2] = {2, 7};
    float *one = malloc(200 * 150 * sizeof *one), *many = malloc(200 * 150 * sizeof *many);
    ck_assert_int_eq(cm_lens_map_depth(way.map, 0.0, way.depth, one, NULL), CM_OK);
    for (int i = 0; i < 2; i++)
    {
        cm_pool *pool = NULL;
        cm_lens_map *map = NULL;
        ck_assert_int_eq(cm_pool_create(counts[i], &pool), CM_OK);
        ck_assert_int_eq(cm_lens_map_create(way.camera, way.pinhole, pool, &map), CM_OK);
        ck_assert_int_eq(cm_lens_map_depth(map, 0.0, way.depth, many, pool), CM_OK);
        ck_assert_int_eq(memcmp(one, many, 200 * 150 * sizeof *one), 0);
        cm_lens_map_destroy(map);
        cm_pool_destroy(pool);
    }
    free(one);
    free(many);
    end_images(&way);
    drop_room(&room);
}
END_TEST

/* ---- bad input ---- */

START_TEST(what_is_none_is_refused)
{
    lens_room room = make_room(1);
    image_way way = begin_images(0, 0.0, &room);
    cm_mapping *mapping = make_mapping("tangent", NULL);
    const cm_camera_options faces = {
        .size = sizeof faces, .width = 8, .height = 48, .mapping = mapping};
    cm_camera *round = make(&faces);
    double guard = 3.0, frustum[4] = {3.0}, x = 0.1;
    float value = 0.0f;
    cm_camera_options wide = {.size = sizeof wide};
    cm_lens_map *map = NULL;
    double place[1];
    ck_assert_int_eq(cm_lens_frustum(NULL, frustum), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_frustum(way.camera, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_frustum(round, frustum), CM_ERROR_UNSUPPORTED);
    ck_assert_int_eq(cm_lens_guard(NULL, 0.1, &guard), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_guard(way.camera, 0.1, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_guard(round, 0.1, &guard), CM_ERROR_UNSUPPORTED);
    ck_assert_int_eq(cm_lens_guard(way.camera, -0.1, &guard), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_lens_guard(way.camera, NAN, &guard), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_lens_guard(way.camera, INFINITY, &guard), CM_ERROR_RANGE);
    REQUIRE(guard == 3.0 && frustum[0] == 3.0, "written");
    ck_assert_int_eq(cm_lens_move_vertices(NULL, 0.0, 1, &x, &x, &x, &x, &x, &x),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_move_vertices(round, 0.0, 1, &x, &x, &x, &x, &x, &x),
                     CM_ERROR_UNSUPPORTED);
    ck_assert_int_eq(cm_lens_move_vertices(way.camera, 0.0, 1, &x, &x, &x, &x, &x, NULL),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_move_vertices(way.camera, -1.0, 1, &x, &x, &x, &x, &x, &x),
                     CM_ERROR_RANGE);
    ck_assert_int_eq(cm_lens_move_vertices(way.camera, NAN, 1, &x, &x, &x, &x, &x, &x),
                     CM_ERROR_RANGE);
    ck_assert_int_eq(cm_lens_move_vertices(way.camera, 0.0, 0, NULL, NULL, NULL, NULL, NULL, NULL),
                     CM_OK);
    ck_assert_int_eq(cm_lens_pinhole(NULL, 0.0, &wide), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_pinhole(way.camera, 0.0, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_pinhole(round, 0.0, &wide), CM_ERROR_UNSUPPORTED);
    ck_assert_int_eq(cm_lens_pinhole(way.camera, -1.0, &wide), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_lens_pinhole(way.camera, NAN, &wide), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_lens_pinhole(way.camera, 1e6, &wide), CM_ERROR_RANGE);
    ck_assert_uint_eq(wide.width, 0);
    wide.size = 3;
    ck_assert_int_eq(cm_lens_pinhole(way.camera, 1.0, &wide), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_map_create(NULL, way.pinhole, NULL, &map), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_map_create(way.camera, NULL, NULL, &map), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_map_create(way.camera, way.pinhole, NULL, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_map_create(way.camera, way.camera, NULL, &map), CM_ERROR_CAMERA);
    ck_assert_int_eq(cm_lens_map_create(way.camera, round, NULL, &map), CM_ERROR_UNSUPPORTED);
    ck_assert_ptr_null(map);
    ck_assert_uint_eq(cm_lens_map_unfilled(NULL), 0);
    ck_assert_uint_eq(cm_lens_map_pixel_count(NULL), 0);
    ck_assert_uint_eq(cm_lens_map_pinhole_pixel_count(NULL), 0);
    ck_assert_uint_eq(cm_lens_map_pixel_count(way.map), 200 * 150);
    ck_assert_uint_eq(cm_lens_map_pinhole_pixel_count(way.map), way.pixels);
    cm_lens_map_destroy(NULL);
    ck_assert_int_eq(cm_lens_map_places(NULL, place, place), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_map_places(way.map, place, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_map_color(NULL, 1, &value, &value, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_map_color(way.map, 1, NULL, &value, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_map_color(way.map, 0, way.depth, &value, NULL), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_lens_map_depth(way.map, 0.0, way.depth, NULL, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_map_depth(way.map, -1.0, way.depth, &value, NULL), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_lens_map_depth(way.map, NAN, way.depth, &value, NULL), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_lens_map_labels(way.map, 4, way.quad, NULL, &value, NULL),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_lens_map_labels(way.map, 0, way.quad, "", &value, NULL), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_lens_map_flow(NULL, &value, &value, NULL), CM_ERROR_ARGUMENT);
    cm_camera_destroy(round);
    cm_mapping_destroy(mapping);
    end_images(&way);
    drop_room(&room);
}
END_TEST

/* A picture that is wholly beyond the fold: no pixel has a ray. */
START_TEST(a_lens_that_shows_nothing_is_refused)
{
    cm_camera_options options = lens_options(0), wide = {.size = sizeof wide};
    double guard = 0.0;
    options.distortion[0] = -0.4;
    options.cx = -5000.0;
    cm_camera *camera = make(&options);
    ck_assert_int_eq(cm_lens_guard(camera, 0.1, &guard), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_lens_pinhole(camera, 1.0, &wide), CM_ERROR_RANGE);
    cm_camera_destroy(camera);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {vertices_are_right_where_triangles_are_small,
                                  the_guard_is_needed,
                                  the_guard_is_that_of_the_corners_or_more,
                                  the_frustum_is_as_printed,
                                  vertices_go_where_the_lens_has_them,
                                  images_are_right_on_planes,
                                  nothing_comes_between_surfaces,
                                  holes_do_not_grow,
                                  the_enlarged_frustum_leaves_no_rim,
                                  the_pinhole_is_as_fine_as_the_lens,
                                  colors_are_interpolated_and_labels_are_not,
                                  flows_go_through_the_lens,
                                  beyond_the_fold_nothing_is_shown,
                                  threads_have_the_same_bits,
                                  what_is_none_is_refused,
                                  a_lens_that_shows_nothing_is_refused,
                                  NULL};
    return run_suite("lens routes", tests);
}
