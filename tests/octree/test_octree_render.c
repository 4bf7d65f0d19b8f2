/* SPDX-License-Identifier: MIT
 *
 * Pictures of maps that are known voxel by voxel: where things are seen, lit, in shadow, in front of and behind a mesh.
 */
#include <cubemap/octree.h>

#include "tests/suite.h"

enum
{
    WIDTH = 120,
    HEIGHT = 90,
    FACE = 24,
    PIXELS = WIDTH * HEIGHT, /* of the largest picture */
    KINDS = 4,               /* of cameras */
    POINTS_MOST = 80000
};

#define EDGE 0.05

typedef struct seen
{
    cm_camera *camera;
    cm_mapping *mapping;
    cm_pose pose;
    size_t width, height;
    float color[PIXELS][4];
    float depth[PIXELS];
    cm_image color_image;
    cm_image depth_image;
} seen;

/* ---- maps ---- */

typedef int solid(int x, int y, int z);

static int is_room(int x, int y, int z)
{
    const int is_shell = x == -41 || x == 40 || y == -41 || y == 40 || z == -41 || z == 40;
    return is_shell && x >= -41 && x <= 40 && y >= -41 && y <= 40 && z >= -41 && z <= 40;
}

/* A floor and a plate above it. */
static int is_table(int x, int y, int z)
{
    const int is_floor = z == -20 && x >= -40 && x < 40 && y >= -40 && y < 40;
    return is_floor || (z >= 10 && z < 12 && x >= -8 && x < 8 && y >= -8 && y < 8);
}

static int is_nothing(int x, int y, int z)
{
    return x < y && x > y + z && z > 100;
}

static cm_octree *make_map(solid *is, int color)
{
    static float xyz[POINTS_MOST][3];
    static uint8_t rgb[POINTS_MOST][3];
    const cm_octree_options options = {.size = sizeof options,
                                       .edge = EDGE,
                                       .levels = 9,
                                       .color = color,
                                       .centre = {0.3, -0.2, 0.1}};
    cm_octree *octree = NULL;
    size_t n = 0;
    ck_assert_int_eq(cm_octree_create(&options, &octree), CM_OK);
    for (int i = 0; i < 90 * 90 * 90; i++)
    {
        const int at[3] = {i % 90 - 45, i / 90 % 90 - 45, i / 8100 - 45};
        if (is(at[0], at[1], at[2]))
        {
            ck_assert_uint_lt(n, POINTS_MOST);
            for (int axis = 0; axis < 3; axis++)
            {
                xyz[n][axis] = (float)(options.centre[axis] + (at[axis] + 0.5) * EDGE);
                rgb[n][axis] = (uint8_t)(100 + 100 * (at[axis] > 0));
            }
            n++;
        }
    }
    const double origin[3] = {0.31, -0.21, 0.13};
    ck_assert_int_eq(cm_octree_update_points(octree, origin, n, xyz[0], color ? rgb[0] : NULL),
                     CM_OK);
    return octree;
}

/* ---- cameras ---- */

static const cm_pose from_inside = {{{{0.36, 0.48, -0.8}, {-0.8, 0.6, 0.0}, {0.48, 0.64, 0.6}}},
                                    {0.1, 0.2, -0.3}};

/* Down from above, or up. x is to the right. */
static cm_pose look_along_z(double x, double y, double z, int is_up)
{
    const double s = is_up ? 1.0 : -1.0;
    return (cm_pose){{{{1, 0, 0}, {0, s, 0}, {0, 0, s}}}, {x, y, z}};
}

/* Perspective without and with distortion, a cube, a disc. */
static seen *make_camera(int kind, cm_pose pose)
{
    static const char *const mappings[KINDS] = {NULL, NULL, "coupled", "azimuthal:equidistant"};
    seen *s = calloc(1, sizeof *s);
    cm_camera_options lens = {.size = sizeof lens,
                              .width = WIDTH,
                              .height = HEIGHT,
                              .fx = 100.0,
                              .fy = 101.0,
                              .cx = 59.3,
                              .cy = 44.2};
    lens.distortion[0] = kind == 1 ? -0.12 : 0.0;
    lens.distortion[3] = kind == 1 ? 0.002 : 0.0;
    if (kind >= 2)
    {
        s->mapping = make_mapping(mappings[kind], NULL);
        lens.mapping = s->mapping;
        lens.width = kind == 2 ? FACE : 61;
        lens.height = kind == 2 ? 6 * FACE : 61;
        lens.pixel_centre = 0.5;
    }
    ck_assert_int_eq(cm_camera_create(&lens, &s->camera), CM_OK);
    s->pose = pose;
    s->width = lens.width;
    s->height = lens.height;
    const cm_image image = {
        .size = sizeof image, .type = CM_PIXEL_FLOAT, .width = lens.width, .height = lens.height};
    s->color_image = image;
    s->color_image.data = s->color;
    s->color_image.channels = 4;
    s->depth_image = image;
    s->depth_image.data = s->depth;
    s->depth_image.channels = 1;
    return s;
}

static void drop_camera(seen *s)
{
    cm_camera_destroy(s->camera);
    cm_mapping_destroy(s->mapping);
    free(s);
}

static void render(const cm_octree *octree, seen *s, const cm_octree_shading *shading)
{
    memset(s->color, 0x77, sizeof s->color);
    memset(s->depth, 0x77, sizeof s->depth);
    ck_assert_int_eq(
        cm_octree_render(octree, s->camera, &s->pose, shading, &s->color_image, &s->depth_image),
        CM_OK);
}

/* The ray of a pixel in the world, of a length so that depth, or range, times it is the point; 0: there is none. */
static int ray_of(const seen *s, size_t pixel, double direction[3])
{
    const double centre = cm_camera_describe(s->camera)->pixel_centre;
    const double column = (double)(pixel % s->width) + centre;
    const double row = (double)(pixel / s->width) + centre;
    double ray[3];
    cm_camera_ray_array(s->camera, 1, &column, &row, &ray[0], &ray[1], &ray[2]);
    for (int k = 0; k < 3; k++)
    {
        direction[k] = s->pose.rotation.row[0][k] * ray[0] + s->pose.rotation.row[1][k] * ray[1] +
                       s->pose.rotation.row[2][k] * ray[2];
    }
    return !isnan(ray[0]);
}

/* The pixel that a point of the world is seen at. */
static size_t pixel_of(const seen *s, double x, double y, double z)
{
    const double centre = cm_camera_describe(s->camera)->pixel_centre, world[3] = {x, y, z};
    double at[3], column, row;
    cm_pose_apply(&s->pose, world, at);
    cm_camera_project_array(s->camera, 1, &at[0], &at[1], &at[2], &column, &row);
    const double c = floor(column - centre + 0.5), r = floor(row - centre + 0.5);
    ck_assert(c >= 0.0 && r >= 0.0 && c < (double)s->width && r < (double)s->height);
    return (size_t)r * s->width + (size_t)c;
}

/* ---- where things are ---- */

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* How many pixels are farther than a length from where rays meet the map. */
static size_t count_off(const cm_octree *octree, const seen *s, double by)
{
    size_t off = 0;
    for (size_t i = 0; i < s->width * s->height; i++)
    {
        double direction[3];
        cm_voxel voxel = {.distance = NAN};
        const int has_ray = ray_of(s, i, direction);
        const int meets =
            has_ray && cm_octree_ray(octree, s->pose.position, direction, 10.0, &voxel);
        const double range = s->depth[i] * length_of(direction);
        off += (meets ? !(fabs(range - voxel.distance) <= by) : !isnan(s->depth[i])) ? 1u : 0u;
    }
    return off;
}

START_TEST(depths_are_where_rays_end)
{
    for (int map = 0; map < 2; map++)
    {
        cm_octree *octree = make_map(map == 0 ? is_room : is_table, 1);
        for (int kind = 0; kind < KINDS; kind++)
        {
            seen *s = make_camera(kind, from_inside);
            render(octree, s, NULL);
            const size_t off = count_off(octree, s, 1e-5);
            ck_assert_msg(kind > 1 || off <= 2, "map %d, camera %d: %zu", map, kind, off);
            /* where cones are wider than voxels, as the level's: to a diagonal of two voxels each way, and by half of what is covered */
            const size_t far_off = count_off(octree, s, 3.5 * EDGE);
            ck_assert_msg(far_off <= s->width * s->height / (map == 0 ? 1000 : 25),
                          "map %d, camera %d: %zu", map, kind, far_off);
            drop_camera(s);
        }
        cm_octree_destroy(octree);
    }
}
END_TEST

/* Whole principal points, and poses whose axes are the world's: the middle row and column look along planes of the world, and a
 * coordinate of theirs never changes. It may grow or fall by nothing, and begin on a border of voxels. */
START_TEST(rays_along_axes)
{
    cm_octree *octree = make_map(is_room, 1);
    const cm_camera_options lens = {.size = sizeof lens,
                                    .width = WIDTH,
                                    .height = HEIGHT,
                                    .fx = 100.0,
                                    .fy = 101.0,
                                    .cx = 59.0,
                                    .cy = 44.0};
    for (int view = 0; view < 12; view++)
    {
        cm_pose pose = {.position = {0.1, 0.2, -0.3}};
        pose.position[view % 3] = view % 2 ? 0.3 : pose.position[view % 3];
        for (int row = 0; row < 3; row++)
        {
            pose.rotation.row[row][(row + view) % 3] = view / 3 % 2 && row > 0 ? -1.0 : 1.0;
        }
        seen *s = make_camera(0, pose);
        cm_camera_destroy(s->camera);
        ck_assert_int_eq(cm_camera_create(&lens, &s->camera), CM_OK);
        render(octree, s, NULL);
        const size_t off = count_off(octree, s, 1e-5);
        ck_assert_msg(off == 0, "view %d: %zu", view, off);
        drop_camera(s);
    }
    cm_octree_destroy(octree);
}
END_TEST

START_TEST(coarse_levels_are_near)
{
    cm_octree *octree = make_map(is_room, 1);
    for (int level = 1; level <= 4; level++)
    {
        seen *s = make_camera(0, from_inside);
        const cm_octree_shading shading = {.size = sizeof shading, .coarsest = level};
        render(octree, s, &shading);
        /* a cell's diagonal */
        ck_assert_uint_eq(count_off(octree, s, ldexp(1.7321 * EDGE, level)), 0);
        for (size_t i = 0; i < PIXELS; i++)
        {
            ck_assert_msg(s->color[i][3] > 0.99f, "level %d: a wall lets through %g", level,
                          1.0 - (double)s->color[i][3]);
        }
        drop_camera(s);
    }
    cm_octree_destroy(octree);
}
END_TEST

START_TEST(colors_are_those_of_voxels)
{
    cm_octree *octree = make_map(is_room, 1);
    seen *s = make_camera(0, from_inside);
    render(octree, s, NULL);
    for (size_t i = 0; i < PIXELS; i++)
    {
        double direction[3];
        cm_voxel voxel;
        ck_assert(ray_of(s, i, direction));
        ck_assert_int_eq(cm_octree_ray(octree, s->pose.position, direction, 0.0, &voxel), 1);
        int same = 0;
        for (int c = 0; c < 3; c++)
        {
            same += fabs(s->color[i][c] * 255.0 - voxel.color[c]) < 0.01;
        }
        ck_assert_msg(same == 3 || i % 1000 == 999, "pixel %zu", i);
    }
    drop_camera(s);
    cm_octree_destroy(octree);
}
END_TEST

/* ---- the same everywhere ---- */

START_TEST(threads_do_not_matter)
{
    static const unsigned threads[] = {1, 2, 7};
    cm_octree *octree = make_map(is_table, 1);
    for (int kind = 0; kind < KINDS; kind++)
    {
        seen *first = make_camera(kind, from_inside);
        cm_octree_shading shading = {
            .size = sizeof shading, .light = 1, .light_position = {1, 0, 2}};
        render(octree, first, &shading);
        for (int t = 0; t < 3; t++)
        {
            seen *s = make_camera(kind, from_inside);
            ck_assert_int_eq(cm_pool_create(threads[t], &shading.pool), CM_OK);
            render(octree, s, &shading);
            ck_assert_int_eq(memcmp(s->color, first->color, sizeof s->color), 0);
            ck_assert_int_eq(memcmp(s->depth, first->depth, sizeof s->depth), 0);
            cm_pool_destroy(shading.pool);
            drop_camera(s);
        }
        drop_camera(first);
    }
    cm_octree_destroy(octree);
}
END_TEST

/* From each pixel at a face's border on, over it: what is there is as far, to what a wall may differ in a pixel and some voxels. */
START_TEST(faces_agree_at_seams)
{
    cm_octree *octree = make_map(is_room, 1);
    seen *s = make_camera(2, from_inside);
    render(octree, s, NULL);
    size_t crossed = 0;
    for (size_t i = 0; i < s->width * s->height; i++)
    {
        const size_t column = i % FACE, row = i / FACE % FACE;
        double ray[3], other[3], c, r;
        ck_assert(!isnan(s->depth[i]) && s->color[i][3] > 0.99f);
        if (column != 0 && column != FACE - 1 && row != 0 && row != FACE - 1)
        {
            continue;
        }
        const size_t inward = i + (column == 0          ? 1
                                   : column == FACE - 1 ? -(size_t)1
                                   : row == 0           ? FACE
                                                        : -(size_t)FACE);
        const double here[2] = {(double)(i % FACE) + 0.5, (double)(i / FACE) + 0.5};
        const double in[2] = {(double)(inward % FACE) + 0.5, (double)(inward / FACE) + 0.5};
        cm_camera_ray_array(s->camera, 1, &here[0], &here[1], &ray[0], &ray[1], &ray[2]);
        cm_camera_ray_array(s->camera, 1, &in[0], &in[1], &other[0], &other[1], &other[2]);
        for (int k = 0; k < 3; k++)
        {
            ray[k] = 2.0 * ray[k] - other[k];
        }
        cm_camera_project_array(s->camera, 1, &ray[0], &ray[1], &ray[2], &c, &r);
        const size_t beyond = (size_t)r * FACE + (size_t)c;
        crossed += beyond / FACE / FACE != i / FACE / FACE;
        const double range = s->depth[i], there = s->depth[beyond];
        ck_assert_msg(fabs(range - there) < 0.25 * fmin(range, there) + 4.0 * EDGE,
                      "pixel %zu: %g, %zu: %g", i, range, beyond, there);
    }
    ck_assert_uint_gt(crossed, 6 * 3 * FACE);
    drop_camera(s);
    cm_octree_destroy(octree);
}
END_TEST

/* ---- light ---- */

START_TEST(shadows_fall_where_they_must)
{
    cm_octree *octree = make_map(is_table, 0);
    /* the plate is from z 0.6 to 0.7, its middle at 0.3, -0.2; the floor's top at -0.85 */
    const double lamp[3] = {0.3, -0.2, 2.6}, floor_z = -0.85;
    cm_octree_shading shading = {.size = sizeof shading,
                                 .light = 1,
                                 .light_position = {lamp[0], lamp[1], lamp[2]},
                                 .ambient = 0.25};
    for (int i = 0; i < 12; i++)
    {
        const double angle = 0.5 + 6.28318 * i / 12.0;
        for (int is_far = 0; is_far < 2; is_far++)
        {
            /* the shadow's half width is 0.4 * 3.45 / 2.0 = 0.69, and as far again along diagonals */
            const double range = is_far ? 1.25 : 0.45;
            const double x = lamp[0] + range * cos(angle), y = lamp[1] + range * sin(angle);
            seen *s = make_camera(0, look_along_z(x, y, 0.3, 0));
            render(octree, s, &shading);
            const float *color = s->color[pixel_of(s, x, y, floor_z)];
            const double cosine = 3.45 / hypot(3.45, range);
            const double lit = 178.0 / 255.0 * (is_far ? 0.25 + 0.75 * cosine : 0.25);
            ck_assert_msg(fabs(color[0] - lit) < 0.02, "%d %d: %g, %g", i, is_far, (double)color[0],
                          lit);
            drop_camera(s);
        }
    }
    cm_octree_destroy(octree);
}
END_TEST

/* From below nothing of a floor is lit that has its light above. */
START_TEST(backs_are_dark)
{
    cm_octree *octree = make_map(is_table, 0);
    const cm_octree_shading shading = {
        .size = sizeof shading, .light = 1, .light_position = {0, 0, 2}, .ambient = 0.5};
    seen *s = make_camera(0, look_along_z(0.3, -0.2, -2.0, 1));
    render(octree, s, &shading);
    for (size_t i = 0; i < PIXELS; i++)
    {
        ck_assert_msg(isnan(s->depth[i]) ||
                          fabs(s->color[i][0] - 0.5 * s->color[i][3] * 178.0 / 255.0) < 0.01,
                      "pixel %zu: %g", i, (double)s->color[i][0]);
    }
    drop_camera(s);
    cm_octree_destroy(octree);
}
END_TEST

/* ---- a mesh ---- */

START_TEST(meshes_hide_and_are_hidden)
{
    cm_octree *octree = make_map(is_table, 0);
    for (int kind = 0; kind < 3; kind += 2)
    {
        /* over the floor and through the plate, which hides a part of it from above */
        static const double corners[3][3] = {{-1, -1.6, 0.2}, {1.6, -1.6, 0.2}, {0.3, 1.2, 1.2}};
        seen *s = make_camera(kind, look_along_z(0.3, -0.2, 2.2, 0));
        float *mesh_color = calloc(3 * PIXELS, sizeof *mesh_color);
        float *mesh = calloc(PIXELS, sizeof *mesh);
        cm_raster *raster = NULL;
        const cm_triangles triangles = {.size = sizeof triangles,
                                        .vertex_count = 3,
                                        .position = corners[0],
                                        .triangle_count = 1};
        ck_assert_int_eq(cm_raster_create(s->camera, 0.0, NULL, &raster), CM_OK);
        ck_assert_int_eq(cm_raster_triangles(raster, &s->pose, &triangles, 1), CM_OK);
        ck_assert_int_eq(cm_raster_read(raster, mesh, NULL), CM_OK);
        for (size_t i = 0; i < PIXELS; i++)
        {
            mesh_color[3 * i] = 0.1f;
        }
        render(octree, s, NULL);
        seen *alone = malloc(sizeof *alone);
        memcpy(alone, s, sizeof *alone);
        const cm_octree_shading shading = {
            .size = sizeof shading, .mesh = raster, .mesh_color = mesh_color};
        render(octree, s, &shading);
        size_t front = 0, behind = 0;
        for (size_t i = 0; i < s->width * s->height; i++)
        {
            const int is_front = mesh[i] > 0.0f && !(alone->depth[i] <= mesh[i]);
            const float nearest = is_front ? mesh[i] : alone->depth[i];
            ck_assert_msg((isnan(nearest) && isnan(s->depth[i])) ||
                              fabsf(nearest - s->depth[i]) < 1e-4f,
                          "pixel %zu: %g, %g", i, (double)nearest, (double)s->depth[i]);
            ck_assert(!is_front || s->color[i][3] == 1.0f);
            ck_assert(!is_front || alone->color[i][3] < 0.999f ||
                      fabsf(s->color[i][0] - 0.1f) < 1e-6f || kind == 2);
            ck_assert(is_front || alone->color[i][3] < 0.999f ||
                      memcmp(s->color[i], alone->color[i], sizeof s->color[i]) == 0);
            front += (size_t)is_front;
            behind += (size_t)(mesh[i] > 0.0f && !is_front);
        }
        ck_assert_uint_gt(front, 10);
        ck_assert_uint_gt(behind, 10);
        cm_raster_destroy(raster);
        free(mesh);
        free(mesh_color);
        free(alone);
        drop_camera(s);
    }
    cm_octree_destroy(octree);
}
END_TEST

/* ---- what there is beside ---- */

START_TEST(canvas_of_another_camera)
{
    cm_octree *octree = make_map(is_table, 0);
    seen *s = make_camera(0, look_along_z(0.3, -0.2, 2.2, 0));
    const cm_camera_options small = {
        .size = sizeof small, .width = 4, .height = 3, .fx = 3, .fy = 3, .cx = 1.5, .cy = 1};
    cm_camera *other = NULL;
    cm_raster *raster = NULL;
    float depth[PIXELS];
    cm_image image = {.size = sizeof image,
                      .data = depth,
                      .type = CM_PIXEL_FLOAT,
                      .width = (uint32_t)s->width,
                      .height = (uint32_t)s->height,
                      .channels = 1};
    ck_assert_int_eq(cm_camera_create(&small, &other), CM_OK);
    ck_assert_int_eq(cm_raster_create(other, 0.0, NULL, &raster), CM_OK);
    const cm_octree_shading shading = {.size = sizeof shading, .mesh = raster};
    ck_assert_int_eq(cm_octree_render(octree, s->camera, &s->pose, &shading, NULL, &image),
                     CM_ERROR_ARGUMENT);
    cm_raster_destroy(raster);
    cm_camera_destroy(other);
    drop_camera(s);
    cm_octree_destroy(octree);
}
END_TEST

START_TEST(nothing_is_background)
{
    cm_octree *octree = make_map(is_nothing, 1);
    const cm_octree_shading shading = {
        .size = sizeof shading, .light = 1, .background = {0.5f, 2.0f, -1.0f}};
    for (int kind = 0; kind < KINDS; kind++)
    {
        seen *s = make_camera(kind, from_inside);
        render(octree, s, &shading);
        for (size_t i = 0; i < s->width * s->height; i++)
        {
            ck_assert(isnan(s->depth[i]) && s->color[i][0] == 0.5f && s->color[i][1] == 2.0f &&
                      s->color[i][2] == -1.0f && s->color[i][3] == 0.0f);
        }
        drop_camera(s);
    }
    cm_octree_destroy(octree);
}
END_TEST

START_TEST(far_ends_cones)
{
    cm_octree *octree = make_map(is_room, 1);
    seen *s = make_camera(2, from_inside);
    const cm_octree_shading shading = {.size = sizeof shading, .far = 1.9};
    render(octree, s, &shading);
    size_t near = 0, nothing = 0;
    for (size_t i = 0; i < s->width * s->height; i++)
    {
        ck_assert(isnan(s->depth[i]) || s->depth[i] <= 1.9f);
        near += isnan(s->depth[i]) ? 0u : 1u;
        nothing += isnan(s->depth[i]) ? 1u : 0u;
    }
    ck_assert(near > 50 && nothing > 50);
    drop_camera(s);
    cm_octree_destroy(octree);
}
END_TEST

/* Whole numbers are the floats, rounded; gaps between pixels stay as they are. */
/* A cube of 2^42 voxels, of which a pyramid of 10^9 is in view: it is drawn as it is, not block by block. */
START_TEST(large_cubes_are_drawn_as_they_are)
{
    const cm_octree_options options = {.size = sizeof options,
                                       .edge = 0.005,
                                       .levels = 14,
                                       .centre = {0.0, 0.0, 1.0 + 0.005 * 8192}};
    cm_octree *octree = NULL;
    seen *s = make_camera(0, from_inside);
    s->pose = (cm_pose){.rotation = {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}}};
    /* what no mask sees survives */
    cm_view mask = {.size = sizeof mask, .camera = s->camera, .pose = s->pose};
    static uint8_t nothing[PIXELS];
    mask.pose.position[2] = 1e6;
    mask.color = s->color_image;
    mask.color.data = nothing;
    mask.color.type = CM_PIXEL_U8;
    mask.color.channels = 1;
    ck_assert_int_eq(cm_octree_create(&options, &octree), CM_OK);
    ck_assert_int_eq(cm_hull_carve(octree, 1, &mask, 1, NULL), CM_OK);
    render(octree, s, NULL);
    for (size_t i = 0; i < (size_t)s->width * (size_t)s->height; i++)
    {
        ck_assert_msg(fabs((double)s->depth[i] - 1.0) < 0.03, "pixel %d: %g", (int)i,
                      (double)s->depth[i]);
    }
    drop_camera(s);
    cm_octree_destroy(octree);
}
END_TEST

START_TEST(types_of_pictures)
{
    static uint8_t bytes[PIXELS][5];
    static uint16_t words[PIXELS][3];
    cm_octree *octree = make_map(is_table, 1);
    seen *s = make_camera(0, from_inside);
    render(octree, s, NULL);
    memset(bytes, 7, sizeof bytes);
    cm_image image = s->color_image;
    image.type = CM_PIXEL_U8;
    image.data = bytes;
    image.pixel_stride = 5;
    ck_assert_int_eq(cm_octree_render(octree, s->camera, &s->pose, NULL, &image, NULL), CM_OK);
    image.type = CM_PIXEL_U16;
    image.data = words;
    image.pixel_stride = 0;
    image.channels = 3;
    ck_assert_int_eq(cm_octree_render(octree, s->camera, &s->pose, NULL, &image, NULL), CM_OK);
    for (size_t i = 0; i < PIXELS; i++)
    {
        for (int c = 0; c < 4; c++)
        {
            const double value = s->color[i][c];
            ck_assert(fabs(bytes[i][c] - 255.0 * value) < 0.501);
            ck_assert(c == 3 || fabs(words[i][c] - 65535.0 * value) < 0.51);
        }
        ck_assert_int_eq(bytes[i][4], 7);
    }
    drop_camera(s);
    cm_octree_destroy(octree);
}
END_TEST

START_TEST(refusals)
{
    cm_octree *octree = make_map(is_table, 1);
    seen *s = make_camera(0, from_inside);
    cm_image wrong = s->color_image;
    cm_octree_shading shading = {.size = sizeof shading};
    cm_pose pose = s->pose;
#define RENDER(camera, pose, color, depth)                                                         \
    cm_octree_render(octree, camera, pose, &shading, color, depth)
    ck_assert_int_eq(cm_octree_render(NULL, s->camera, &pose, NULL, &wrong, NULL),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(RENDER(NULL, &pose, &wrong, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(RENDER(s->camera, NULL, &wrong, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(RENDER(s->camera, &pose, NULL, NULL), CM_OK);
    wrong.data = NULL;
    ck_assert_int_eq(RENDER(s->camera, &pose, &wrong, NULL), CM_ERROR_ARGUMENT);
    wrong = s->color_image;
    wrong.width--;
    ck_assert_int_eq(RENDER(s->camera, &pose, &wrong, NULL), CM_ERROR_RANGE);
    wrong = s->color_image;
    wrong.channels = 2;
    ck_assert_int_eq(RENDER(s->camera, &pose, &wrong, NULL), CM_ERROR_RANGE);
    wrong.channels = 4;
    wrong.type = CM_PIXEL_HALF;
    ck_assert_int_eq(RENDER(s->camera, &pose, &wrong, NULL), CM_ERROR_RANGE);
    wrong = s->depth_image;
    wrong.type = CM_PIXEL_U16;
    ck_assert_int_eq(RENDER(s->camera, &pose, NULL, &wrong), CM_ERROR_RANGE);
    shading.far = NAN;
    ck_assert_int_eq(RENDER(s->camera, &pose, &s->color_image, NULL), CM_ERROR_RANGE);
    shading = (cm_octree_shading){.size = sizeof shading, .coarsest = -1};
    ck_assert_int_eq(RENDER(s->camera, &pose, &s->color_image, NULL), CM_ERROR_RANGE);
    shading =
        (cm_octree_shading){.size = sizeof shading, .light = 1, .light_position = {0, INFINITY, 0}};
    ck_assert_int_eq(RENDER(s->camera, &pose, &s->color_image, NULL), CM_ERROR_RANGE);
    shading = (cm_octree_shading){.size = 1};
    ck_assert_int_eq(RENDER(s->camera, &pose, &s->color_image, NULL), CM_ERROR_ARGUMENT);
    shading = (cm_octree_shading){.size = sizeof shading};
    pose.rotation.row[0][0] = 2.0;
    ck_assert_int_eq(RENDER(s->camera, &pose, &s->color_image, NULL), CM_ERROR_CAMERA);
#undef RENDER
    drop_camera(s);
    cm_octree_destroy(octree);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {depths_are_where_rays_end,
                                  rays_along_axes,
                                  coarse_levels_are_near,
                                  colors_are_those_of_voxels,
                                  threads_do_not_matter,
                                  faces_agree_at_seams,
                                  shadows_fall_where_they_must,
                                  backs_are_dark,
                                  meshes_hide_and_are_hidden,
                                  canvas_of_another_camera,
                                  nothing_is_background,
                                  far_ends_cones,
                                  types_of_pictures,
                                  refusals,
                                  large_cubes_are_drawn_as_they_are,
                                  NULL};
    return run_suite("octree render", tests);
}
