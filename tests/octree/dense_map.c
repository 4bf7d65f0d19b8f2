/* SPDX-License-Identifier: MIT */
#include "dense_map.h"

dense_map dense_make(int levels)
{
    dense_map map = {.n = (int64_t)1 << levels};
    const size_t voxels = (size_t)1 << 3 * levels;
    map.alpha = malloc(voxels);
    map.color = calloc(voxels, sizeof *map.color);
    ck_assert(map.alpha != NULL && map.color != NULL);
    memset(map.alpha, 127, voxels);
    return map;
}

void dense_clear(dense_map *map)
{
    free(map->alpha);
    free(map->color);
    memset(map, 0, sizeof *map);
}

/* ---- reading ---- */

typedef struct dense_reading
{
    const cm_octree *octree;
    dense_map *map;
    uint64_t next; /* no voxel has a key below it */
} dense_reading;

static uint64_t key_of(const int64_t place[3])
{
    uint64_t key = 0;
    for (unsigned bit = 0; bit < 21; bit++)
    {
        for (unsigned axis = 0; axis < 3; axis++)
        {
            key |= ((uint64_t)place[axis] >> bit & 1u) << (3 * bit + axis);
        }
    }
    return key;
}

static int read_voxel(void *user, const cm_voxel *voxel)
{
    dense_reading *reading = user;
    dense_map *map = reading->map;
    const cm_octree_options *options = cm_octree_describe(reading->octree);
    const int64_t size = (int64_t)1 << voxel->level;
    const double centre[3] = {voxel->x, voxel->y, voxel->z};
    int64_t first[3];
    for (int axis = 0; axis < 3; axis++)
    {
        const double low =
            (centre[axis] - options->centre[axis]) / options->edge - 0.5 * (double)size;
        first[axis] = (int64_t)floor(low + 0.5) + map->n / 2;
        ck_assert_msg(fabs(low - floor(low + 0.5)) < 1e-3, "a voxel between voxels");
        ck_assert_msg(first[axis] >= 0 && first[axis] + size <= map->n, "a voxel beyond the map");
    }
    /* keys from the corner of the tree, which a small map is in the middle of */
    const int64_t more = map->n < 64 ? 32 - map->n / 2 : 0;
    const uint64_t key =
        key_of((const int64_t[3]){first[0] + more, first[1] + more, first[2] + more});
    ck_assert_msg(key >= reading->next, "voxels are not in the order of keys, or come twice");
    reading->next = key + 1;
    ck_assert(voxel->alpha != 127 && voxel->edge == ldexp(options->edge, voxel->level) &&
              voxel->distance == 0.0);
    ck_assert(voxel->state == (voxel->alpha > 127 ? CM_VOXEL_OCCUPIED : CM_VOXEL_FREE));
    const uint32_t color = voxel->has_color ? 1u << 24 | (uint32_t)voxel->color[0] << 16 |
                                                  (uint32_t)voxel->color[1] << 8 | voxel->color[2]
                                            : 0;
    for (int64_t z = first[2]; z < first[2] + size; z++)
    {
        for (int64_t y = first[1]; y < first[1] + size; y++)
        {
            const size_t at = dense_at(map, first[0], y, z);
            memset(map->alpha + at, voxel->alpha, (size_t)size);
            for (int64_t i = 0; i < size; i++)
            {
                map->color[at + (size_t)i] = color;
            }
        }
    }
    return 0;
}

void dense_read(const cm_octree *octree, dense_map *map)
{
    const size_t voxels = (size_t)(map->n * map->n * map->n);
    memset(map->alpha, 127, voxels);
    memset(map->color, 0, voxels * sizeof *map->color);
    dense_reading reading = {octree, map, 0};
    ck_assert_int_eq(cm_octree_walk_changes(octree, 0, read_voxel, &reading), CM_OK);
}

const char *dense_differs(const dense_map *a, const dense_map *b)
{
    static char text[200];
    ck_assert(a->n == b->n);
    const size_t voxels = (size_t)(a->n * a->n * a->n);
    size_t different = 0, first = 0;
    for (size_t i = voxels; i-- > 0;)
    {
        if (a->alpha[i] != b->alpha[i] || a->color[i] != b->color[i])
        {
            different++;
            first = i;
        }
    }
    if (different == 0)
    {
        return "";
    }
    const size_t n = (size_t)a->n;
    snprintf(text, sizeof text, "%zu of %zu voxels, first %zu %zu %zu: %d %06x, not %d %06x",
             different, voxels, first % n, first / n % n, first / n / n, a->alpha[first],
             (unsigned)a->color[first], b->alpha[first], (unsigned)b->color[first]);
    return text;
}

const char *maps_differ(const cm_octree *a, const cm_octree *b)
{
    dense_map of_a = dense_make(cm_octree_describe(a)->levels),
              of_b = dense_make(cm_octree_describe(b)->levels);
    dense_read(a, &of_a);
    dense_read(b, &of_b);
    const char *text = dense_differs(&of_a, &of_b);
    dense_clear(&of_a);
    dense_clear(&of_b);
    return text;
}

/* ---- numbers ---- */

/* Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators, 2014. */
double throw_dice(dice *from)
{
    uint64_t z = from->state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

double dice_between(dice *from, double low, double high)
{
    return low + throw_dice(from) * (high - low);
}

/* ---- views ---- */

cm_camera *straight_camera(uint32_t width, uint32_t height, double pixel_centre)
{
    const cm_camera_options options = {.size = sizeof options,
                                       .width = width,
                                       .height = height,
                                       .fx = 0.9 * width,
                                       .fy = 0.87 * width,
                                       .cx = 0.48 * width,
                                       .cy = 0.53 * height,
                                       .pixel_centre = pixel_centre};
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(&options, &camera), CM_OK);
    return camera;
}

static void cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static void make_unit(double a[3])
{
    const double length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    for (int i = 0; i < 3; i++)
    {
        a[i] /= length;
    }
}

cm_pose look_at(const double place[3], const double at[3], double roll)
{
    double z[3], x[3], y[3];
    for (int i = 0; i < 3; i++)
    {
        z[i] = at[i] - place[i];
    }
    make_unit(z);
    const double about[3] = {cos(roll), sin(roll), 0.31};
    cross(about, z, x);
    make_unit(x);
    cross(z, x, y);
    cm_pose pose;
    for (int i = 0; i < 3; i++)
    {
        pose.rotation.row[0][i] = x[i];
        pose.rotation.row[1][i] = y[i];
        pose.rotation.row[2][i] = z[i];
        pose.position[i] = place[i];
    }
    ck_assert_int_eq(cm_pose_check(&pose), CM_OK);
    return pose;
}

/* 1 / depth of a plane is linear in the picture. */
static double plane_depth(const double plane[3], double u, double v)
{
    const double inverse = plane[0] + plane[1] * u + plane[2] * v;
    return inverse > 1e-3 ? 1.0 / inverse : 1000.0;
}

void draw_view(drawn_view *drawn, const cm_camera *camera, const cm_pose *pose, double middle,
               int has_color, dice *from)
{
    const cm_camera_options *options = cm_camera_describe(camera);
    const uint32_t width = options->width, height = options->height;
    const size_t pixels = (size_t)width * height;
    memset(drawn, 0, sizeof *drawn);
    drawn->depth = malloc(pixels * sizeof *drawn->depth);
    drawn->color = malloc(4 * pixels);
    double plane[4][3];
    for (int i = 0; i < 4; i++)
    {
        plane[i][0] = dice_between(from, 0.6, 1.6) / middle;
        plane[i][1] = dice_between(from, -0.9, 0.9) / middle;
        plane[i][2] = dice_between(from, -0.9, 0.9) / middle;
    }
    const double step = dice_between(from, -0.3, 0.3), noise = throw_dice(from) < 0.5 ? 0.0 : 0.02;
    const double holes = throw_dice(from) < 0.5 ? 0.0 : dice_between(from, 0.0, 0.1);
    for (size_t i = 0; i < pixels; i++)
    {
        const double u = (double)(i % width) / width - 0.5, v = (double)(i / width) / height - 0.5;
        const int which = (u > step) + 2 * (v > 0.7 * u + step);
        const double depth =
            plane_depth(plane[which], u, v) * (1.0 + noise * (throw_dice(from) - 0.5));
        drawn->depth[i] =
            throw_dice(from) < holes ? (throw_dice(from) < 0.5 ? NAN : 0.0f) : (float)depth;
        for (int k = 0; k < 4; k++)
        {
            drawn->color[4 * i + (size_t)k] = (uint8_t)(256.0 * throw_dice(from));
        }
    }
    drawn->view =
        (cm_view){.size = sizeof drawn->view, .camera = camera, .pose = *pose, .depth_unit = 1.0};
    drawn->view.depth = (cm_image){.size = sizeof(cm_image),
                                   .data = drawn->depth,
                                   .type = CM_PIXEL_FLOAT,
                                   .width = width,
                                   .height = height,
                                   .channels = 1};
    if (has_color)
    {
        drawn->view.color = drawn->view.depth;
        drawn->view.color.data = drawn->color;
        drawn->view.color.type = CM_PIXEL_U8;
        drawn->view.color.channels = 4;
    }
}

void clear_view(drawn_view *drawn)
{
    free(drawn->depth);
    free(drawn->color);
    memset(drawn, 0, sizeof *drawn);
}

void add_drawn_view(cm_octree *octree, const cm_camera *camera, int number, dice *from)
{
    const double place[3] = {dice_between(from, -1.0, 1.0), dice_between(from, -1.0, 1.0), -1.2};
    const double at[3] = {0.1, 0.2, 0.3};
    const cm_pose pose = look_at(place, at, 0.3 * number);
    drawn_view drawn;
    draw_view(&drawn, camera, &pose, 1.2, number != 3, from);
    ck_assert_int_eq(cm_octree_update(octree, &drawn.view, NULL), CM_OK);
    clear_view(&drawn);
}

/* ---- maps ---- */

cm_octree *make_map(const cm_octree_options *options)
{
    cm_octree *octree = NULL;
    ck_assert_int_eq(cm_octree_create(options, &octree), CM_OK);
    return octree;
}

cm_octree *even_map(const cm_octree_options *options, int is_occupied)
{
    cm_octree *octree = make_map(options);
    cm_camera *camera = straight_camera(4, 3, 0.5);
    uint8_t inside[12] = {0};
    const cm_view mask = {
        .size = sizeof mask,
        .camera = camera,
        .pose = {.rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, .position = {0.0, 0.0, 1e12}},
        .color = {.size = sizeof mask.color,
                  .data = inside,
                  .type = CM_PIXEL_U8,
                  .width = 4,
                  .height = 3,
                  .channels = 1}};
    ck_assert_int_eq(cm_hull_carve(octree, 1, &mask, is_occupied, NULL), CM_OK);
    cm_camera_destroy(camera);
    return octree;
}

cm_pool *make_pool(unsigned threads)
{
    cm_pool *pool = NULL;
    if (threads > 1)
    {
        ck_assert_int_eq(cm_pool_create(threads, &pool), CM_OK);
    }
    return pool;
}

cm_octree_options paged_options(cm_store *pages)
{
    return (cm_octree_options){.size = sizeof(cm_octree_options),
                               .levels = 7,
                               .edge = 0.06,
                               .color = 1,
                               .far = 6.0,
                               .memory = pages != NULL ? 30000 : 0,
                               .pages = pages};
}

cm_status update_drawn(cm_octree *octree, const cm_camera *camera, uint64_t seed)
{
    dice from = {seed};
    const double place[3] = {dice_between(&from, -2.0, 2.0), dice_between(&from, -2.0, 2.0), -2.5};
    const double at[3] = {0.1, 0.2, 0.3};
    const cm_pose pose = look_at(place, at, 6.28 * throw_dice(&from));
    drawn_view drawn;
    draw_view(&drawn, camera, &pose, 2.2, 1, &from);
    const cm_status status = cm_octree_update(octree, &drawn.view, NULL);
    clear_view(&drawn);
    return status;
}
