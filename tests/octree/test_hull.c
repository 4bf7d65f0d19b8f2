/* SPDX-License-Identifier: MIT
 *
 * Visual hulls of bodies that formulas describe: equal to asking each voxel, around the body, and no wider than a voxel where the
 * masks look.
 */
#include <cubemap/octree.h>
#include <cubemap/world.h>

#include "tests/suite.h"

enum
{
    VIEWS_MOST = 6,
    WIDTH = 160,
    HEIGHT = 120,
    FACE = 32,
    BODIES = 200
};

typedef struct mask_view
{
    cm_camera *camera;
    cm_mapping *mapping;
    cm_view view;
    uint8_t pixel[WIDTH * HEIGHT > FACE *FACE * 6 ? WIDTH *HEIGHT : FACE *FACE * 6];
} mask_view;

static uint32_t state;

static double fraction(void)
{
    state = state * 1664525u + 1013904223u;
    return (double)(state >> 8) * 0x1p-24;
}

static double between(double least, double most)
{
    return least + (most - least) * fraction();
}

/* One to three of boxes, spheres and cylinders within 0.35 of the middle, so that cameras see all of it. */
static cm_scene *make_body(void)
{
    cm_scene *scene = NULL;
    ck_assert_int_eq(cm_scene_create(&scene), CM_OK);
    const int count = 1 + (int)(3.0 * fraction());
    for (int i = 0; i < count; i++)
    {
        cm_primitive p = {.size = sizeof p, .radius = between(0.03, 0.1)};
        p.kind = i == 0 && fraction() < 0.3 ? CM_PRIMITIVE_BOX
                 : fraction() < 0.5         ? CM_PRIMITIVE_SPHERE
                                            : CM_PRIMITIVE_CYLINDER;
        for (int axis = 0; axis < 3; axis++)
        {
            p.first[axis] = between(-0.1, 0.1);
            p.second[axis] = p.first[axis] + between(0.05, 0.1);
        }
        ck_assert_int_eq(cm_scene_add(scene, &p, NULL), CM_OK);
    }
    return scene;
}

/* From somewhere around, towards the middle. */
static cm_pose look_at_middle(void)
{
    cm_pose pose;
    double axis[3][3] = {{0}};
    const double longitude = between(-3.1, 3.1), z = between(-0.7, 0.7), range = between(1.5, 2.2);
    pose.position[0] = range * sqrt(1.0 - z * z) * cos(longitude);
    pose.position[1] = range * sqrt(1.0 - z * z) * sin(longitude);
    pose.position[2] = range * z;
    for (int k = 0; k < 3; k++)
    {
        axis[2][k] = -pose.position[k] / range;
    }
    const double flat = hypot(axis[2][0], axis[2][1]);
    axis[0][0] = -axis[2][1] / flat;
    axis[0][1] = axis[2][0] / flat;
    for (int k = 0; k < 3; k++)
    {
        axis[1][k] = axis[2][(k + 1) % 3] * axis[0][(k + 2) % 3] -
                     axis[2][(k + 2) % 3] * axis[0][(k + 1) % 3];
    }
    memcpy(pose.rotation.row, axis, sizeof axis);
    return pose;
}

static void draw_mask(mask_view *v, const cm_scene *scene)
{
    const cm_camera_options *lens = cm_camera_describe(v->camera);
    const size_t n = (size_t)lens->width * lens->height;
    double *d = malloc(9 * n * sizeof *d);
    uint32_t *id = malloc(n * sizeof *id);
    for (size_t i = 0; i < n; i++)
    {
        d[6 * n + i] = (double)(i % lens->width) + lens->pixel_centre;
        d[7 * n + i] = (double)(i / lens->width) + lens->pixel_centre;
    }
    cm_camera_ray_array(v->camera, n, d + 6 * n, d + 7 * n, d, d + n, d + 2 * n);
    for (size_t i = 0; i < n; i++)
    {
        const double ray[3] = {d[i], d[n + i], d[2 * n + i]};
        for (size_t k = 0; k < 3; k++)
        {
            double sum = 0.0;
            for (size_t a = 0; a < 3; a++)
            {
                sum += v->view.pose.rotation.row[a][k] * ray[a];
            }
            d[k * n + i] = sum;
            d[(3 + k) * n + i] = v->view.pose.position[k];
        }
    }
    const cm_hit_arrays hit = {.size = sizeof hit, .distance = d + 8 * n, .id = id};
    cm_scene_cast_array(scene, n, d + 3 * n, d + 4 * n, d + 5 * n, d, d + n, d + 2 * n, &hit);
    for (size_t i = 0; i < n; i++)
    {
        v->pixel[i] = id[i] != CM_SCENE_NOTHING ? 200 : 0;
    }
    free(d);
    free(id);
}

/* kind 0: perspective, 1: with distortion, 2: a cube of faces. */
static void make_view(mask_view *v, int kind, const cm_scene *scene)
{
    cm_camera_options lens = {.size = sizeof lens,
                              .width = WIDTH,
                              .height = HEIGHT,
                              .fx = between(140.0, 200.0),
                              .fy = between(140.0, 200.0),
                              .cx = between(75.0, 85.0),
                              .cy = between(56.0, 64.0),
                              .pixel_centre = fraction() < 0.5 ? 0.5 : 0.0};
    lens.distortion[0] = kind == 1 ? -0.15 : 0.0;
    v->mapping = NULL;
    if (kind == 2)
    {
        v->mapping = make_mapping("coupled", NULL);
        lens.mapping = v->mapping;
        lens.width = FACE;
        lens.height = 6 * FACE;
        lens.pixel_centre = 0.5;
    }
    ck_assert_int_eq(cm_camera_create(&lens, &v->camera), CM_OK);
    v->view = (cm_view){.size = sizeof v->view,
                        .camera = v->camera,
                        .pose = look_at_middle(),
                        .color = {.size = sizeof(cm_image),
                                  .data = v->pixel,
                                  .type = CM_PIXEL_U8,
                                  .width = lens.width,
                                  .height = lens.height,
                                  .channels = 1}};
    draw_mask(v, scene);
}

static void drop_view(mask_view *v)
{
    cm_camera_destroy(v->camera);
    cm_mapping_destroy(v->mapping);
}

static cm_octree *empty_map(double edge, int levels)
{
    const cm_octree_options options = {.size = sizeof options, .edge = edge, .levels = levels};
    cm_octree *octree = NULL;
    ck_assert_int_eq(cm_octree_create(&options, &octree), CM_OK);
    return octree;
}

/* What the definition says of one point: 1 inside, 0 outside. */
static int is_kept(const mask_view *v, const double point[3], int outside_survives)
{
    const cm_camera_options *lens = cm_camera_describe(v->camera);
    double at[3], column, row;
    cm_pose_apply(&v->view.pose, point, at);
    cm_camera_project_array(v->camera, 1, &at[0], &at[1], &at[2], &column, &row);
    const double c = floor(column - lens->pixel_centre + 0.5);
    const double r = floor(row - lens->pixel_centre + 0.5);
    if (!(c >= 0.0 && r >= 0.0 && c < lens->width && r < lens->height))
    {
        return outside_survives;
    }
    return v->pixel[(size_t)r * lens->width + (size_t)c] != 0;
}

static void compare_all(const cm_octree *octree, const mask_view *views, size_t count,
                        int outside_survives)
{
    const cm_octree_options *o = cm_octree_describe(octree);
    const int half = 1 << (o->levels - 1);
    for (int i = 0; i < 8 * half * half * half; i++)
    {
        const int place[3] = {i % (2 * half), i / (2 * half) % (2 * half), i / (4 * half * half)};
        double point[3];
        for (int axis = 0; axis < 3; axis++)
        {
            point[axis] = o->centre[axis] + (place[axis] - half + 0.5) * o->edge;
        }
        int expected = CM_VOXEL_OCCUPIED;
        for (size_t v = 0; v < count && expected == CM_VOXEL_OCCUPIED; v++)
        {
            expected =
                is_kept(&views[v], point, outside_survives) ? CM_VOXEL_OCCUPIED : CM_VOXEL_FREE;
        }
        ck_assert_msg(cm_octree_at(octree, point, 0, NULL) == expected, "voxel %d %d %d", place[0],
                      place[1], place[2]);
    }
}

static cm_octree *carve(const mask_view *views, size_t count, double edge, int levels,
                        int outside_survives, cm_pool *pool)
{
    cm_octree *octree = empty_map(edge, levels);
    cm_view masks[VIEWS_MOST];
    for (size_t v = 0; v < count; v++)
    {
        masks[v] = views[v].view;
    }
    ck_assert_int_eq(cm_hull_carve(octree, count, masks, outside_survives, pool), CM_OK);
    return octree;
}

/* Is a point inside of a primitive by more than a length? */
static int is_deep(const cm_primitive *p, const double point[3], double by)
{
    double along = 0.0, squared = 0.0, length = 0.0, low = INFINITY;
    for (int axis = 0; axis < 3; axis++)
    {
        const double from = point[axis] - p->first[axis], way = p->second[axis] - p->first[axis];
        low = fmin(low, fmin(from, p->second[axis] - point[axis]));
        squared += from * from;
        along += from * way;
        length += way * way;
    }
    length = sqrt(length);
    switch (p->kind)
    {
    case CM_PRIMITIVE_BOX:
        return low > by;
    case CM_PRIMITIVE_SPHERE:
        return sqrt(squared) < p->radius - by;
    default:
        along /= length;
        return along > by && along < length - by &&
               sqrt(fmax(squared - along * along, 0.0)) < p->radius - by;
    }
}

/* What is deeper in the body than a pixel is wide is in the hull. */
static void contains_body(const cm_octree *octree, const cm_scene *scene, double pixel)
{
    for (int i = 0; i < 300; i++)
    {
        const cm_primitive *p = cm_scene_at(scene, (uint32_t)(i % (int)cm_scene_count(scene)));
        double point[3];
        for (int axis = 0; axis < 3; axis++)
        {
            point[axis] = p->first[axis] + between(-0.1, 0.1);
        }
        if (is_deep(p, point, pixel))
        {
            ck_assert_int_eq(cm_octree_at(octree, point, 0, NULL), CM_VOXEL_OCCUPIED);
        }
    }
}

/* Are all pixels around one inside of the mask, and is any? */
static void look_around(const mask_view *v, size_t column, size_t row, double reach, int *all,
                        int *any)
{
    const int c = (int)column, r = (int)row, by = (int)ceil(reach);
    *all = 1;
    *any = 0;
    for (int j = r - by; j <= r + by; j++)
    {
        for (int i = c - by; i <= c + by; i++)
        {
            const int is =
                i >= 0 && j >= 0 && i < WIDTH && j < HEIGHT && v->pixel[j * WIDTH + i] != 0;
            *all = *all && is;
            *any = *any || is;
        }
    }
}

/* Rays through pixels meet the hull where the mask is inside for a voxel's width and a half around, and do not meet it where it is
 * outside as far. Rays that come near to what the picture does not have are left out. */
static void silhouette_is_the_mask(const cm_octree *octree, const mask_view *v)
{
    const cm_camera_options *lens = cm_camera_describe(v->camera);
    const double edge = cm_octree_describe(octree)->edge;
    const double reach = 1.0 + 1.5 * edge * fmax(lens->fx, lens->fy) / 1.15;
    for (size_t i = (size_t)(3.0 * fraction()); i < WIDTH * HEIGHT; i += 3)
    {
        int all, any;
        look_around(v, i % WIDTH, i / WIDTH, reach, &all, &any);
        const double column = (double)(i % WIDTH) + lens->pixel_centre;
        const double row = (double)(i / WIDTH) + lens->pixel_centre;
        double ray[3], direction[3] = {0};
        cm_camera_ray_array(v->camera, 1, &column, &row, &ray[0], &ray[1], &ray[2]);
        for (int k = 0; k < 9; k++)
        {
            direction[k % 3] += v->view.pose.rotation.row[k / 3][k % 3] * ray[k / 3];
        }
        const int meets = cm_octree_ray(octree, v->view.pose.position, direction, 0.0, NULL);
        ck_assert_msg(!(all && !meets) && !(!any && meets), "pixel %zu: all %d, any %d, met %d", i,
                      all, any, meets);
    }
}

START_TEST(bodies_are_as_each_voxel_says)
{
    cm_pool *pool = NULL;
    ck_assert_int_eq(cm_pool_create(2, &pool), CM_OK);
    for (int body = 0; body < BODIES; body += (int)step_of(BODIES))
    {
        static mask_view views[VIEWS_MOST];
        state = (uint32_t)body + 1;
        cm_scene *scene = make_body();
        const size_t count = 2 + (size_t)(body % (VIEWS_MOST - 1));
        const int is_mixed = body % 4 == 3, survives = body % 2;
        for (size_t v = 0; v < count; v++)
        {
            make_view(&views[v], is_mixed ? (int)v % 3 : 0, scene);
        }
        const int levels = body % 8 == 7 ? 1 + body / 8 % 4 : 5 + (body % 16 == 0);
        cm_octree *octree = carve(views, count, 0.5 / (1 << levels), levels, survives, pool);
        compare_all(octree, views, count, survives);
        if (!is_mixed && !survives)
        {
            /* half a pixel beside its centre each way, as wide as it is at the farthest, along a diagonal; and the voxel's centre is off */
            contains_body(octree, scene, 0.75 * 2.5 / 140.0 + 0.87 * 0.5 / (1 << levels));
        }
        cm_octree_destroy(octree);
        for (size_t v = 0; v < count; v++)
        {
            drop_view(&views[v]);
        }
        cm_scene_destroy(scene);
    }
    cm_pool_destroy(pool);
}
END_TEST

START_TEST(silhouettes_are_the_masks)
{
    for (int body = 0; body < BODIES; body += (int)step_of(BODIES))
    {
        static mask_view views[VIEWS_MOST];
        state = (uint32_t)body + 1001;
        cm_scene *scene = make_body();
        for (size_t v = 0; v < 3; v++)
        {
            make_view(&views[v], 0, scene);
        }
        cm_octree *octree = carve(views, 3, 0.5 / 128, 7, 0, NULL);
        for (size_t v = 0; v < 3; v++)
        {
            silhouette_is_the_mask(octree, &views[v]);
            drop_view(&views[v]);
        }
        cm_octree_destroy(octree);
        cm_scene_destroy(scene);
    }
}
END_TEST

/* More masks than there are bits for, in a world of another unit and place; all alike but the last. */
START_TEST(many_masks)
{
    static mask_view views[2];
    static cm_view masks[70];
    state = 5;
    cm_scene *scene = make_body();
    make_view(&views[0], 0, scene);
    make_view(&views[1], 0, scene);
    for (size_t i = 0; i < 70; i++)
    {
        masks[i] = views[i == 69].view;
    }
    cm_octree *octree = empty_map(0.5 / 32, 5);
    ck_assert_int_eq(cm_hull_carve(octree, 70, masks, 0, NULL), CM_OK);
    compare_all(octree, views, 2, 0);
    cm_octree_destroy(octree);
    drop_view(&views[0]);
    drop_view(&views[1]);
    cm_scene_destroy(scene);
}
END_TEST

/* Centres of a layer of voxels that fall on borders of pixels, to the rounding of doubles; each pixel is the other of those beside
 * it. */
START_TEST(centres_on_borders)
{
    static mask_view view;
    cm_camera_options lens = {
        .size = sizeof lens, .width = WIDTH, .height = HEIGHT, .cx = 80.0, .cy = 60.0};
    for (size_t i = 0; i < WIDTH * HEIGHT; i++)
    {
        view.pixel[i] = (i + i / WIDTH) % 2 == 0;
    }
    for (int layer = -16; layer < 16; layer += 5)
    {
        const double edge = 0.1, depth = 3.7 + (layer + 0.5) * edge;
        lens.fx = lens.fy = 3.0 * depth / edge;
        ck_assert_int_eq(cm_camera_create(&lens, &view.camera), CM_OK);
        view.view = (cm_view){.size = sizeof view.view,
                              .camera = view.camera,
                              .pose = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0.0, 0.0, -3.7}},
                              .color = {.size = sizeof(cm_image),
                                        .data = view.pixel,
                                        .type = CM_PIXEL_U8,
                                        .width = WIDTH,
                                        .height = HEIGHT,
                                        .channels = 1}};
        for (int survives = 0; survives < 2; survives++)
        {
            cm_octree *octree = carve(&view, 1, edge, 5, survives, NULL);
            compare_all(octree, &view, 1, survives);
            cm_octree_destroy(octree);
        }
        cm_camera_destroy(view.camera);
    }
}
END_TEST

/* Every type of pixel: what is not 0 in any channel is inside. */
START_TEST(types_of_masks)
{
    static mask_view view;
    static uint16_t halves[WIDTH * HEIGHT];
    static float floats[WIDTH * HEIGHT][2];
    state = 6;
    cm_scene *scene = make_body();
    make_view(&view, 0, scene);
    for (size_t i = 0; i < WIDTH * HEIGHT; i++)
    {
        halves[i] = view.pixel[i] != 0 ? 1 : 0x8000;
        floats[i][0] = -0.0f;
        floats[i][1] = view.pixel[i] != 0 ? 1e-40f : 0.0f;
    }
    for (int type = 0; type < 3; type++)
    {
        cm_view mask = view.view;
        mask.color.type = type == 0 ? CM_PIXEL_HALF : type == 1 ? CM_PIXEL_FLOAT : CM_PIXEL_U8;
        mask.color.data = type == 0 ? (void *)halves : type == 1 ? (void *)floats : view.pixel;
        mask.color.channels = type == 1 ? 2 : 1;
        cm_octree *octree = empty_map(0.5 / 32, 5);
        ck_assert_int_eq(cm_hull_carve(octree, 1, &mask, 0, NULL), CM_OK);
        compare_all(octree, &view, 1, 0);
        cm_octree_destroy(octree);
    }
    drop_view(&view);
    cm_scene_destroy(scene);
}
END_TEST

START_TEST(refusals)
{
    static mask_view view;
    state = 7;
    cm_scene *scene = make_body();
    make_view(&view, 0, scene);
    cm_octree *octree = empty_map(0.05, 4);
    ck_assert_int_eq(cm_hull_carve(NULL, 1, &view.view, 0, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_hull_carve(octree, 0, &view.view, 0, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_hull_carve(octree, 1, NULL, 0, NULL), CM_ERROR_ARGUMENT);
    cm_view wrong = view.view;
    wrong.color.data = NULL;
    ck_assert_int_eq(cm_hull_carve(octree, 1, &wrong, 0, NULL), CM_ERROR_ARGUMENT);
    wrong = view.view;
    wrong.camera = NULL;
    ck_assert_int_eq(cm_hull_carve(octree, 1, &wrong, 0, NULL), CM_ERROR_ARGUMENT);
    wrong = view.view;
    wrong.size = 0;
    ck_assert_int_eq(cm_hull_carve(octree, 1, &wrong, 0, NULL), CM_ERROR_ARGUMENT);
    wrong = view.view;
    wrong.color.height--;
    ck_assert_int_eq(cm_hull_carve(octree, 1, &wrong, 0, NULL), CM_ERROR_RANGE);
    wrong = view.view;
    wrong.pose.rotation.row[0][0] += 0.1;
    ck_assert_int_eq(cm_hull_carve(octree, 1, &wrong, 0, NULL), CM_ERROR_CAMERA);
    const double middle[3] = {0.01, 0.01, 0.01};
    ck_assert_int_eq(cm_octree_at(octree, middle, 0, NULL), CM_VOXEL_UNKNOWN);
    ck_assert_int_eq(cm_hull_carve(octree, 1, &view.view, 0, NULL), CM_OK);
    ck_assert_int_eq(cm_hull_carve(octree, 1, &view.view, 0, NULL), CM_ERROR_ARGUMENT);
    cm_octree_destroy(octree);
    drop_view(&view);
    cm_scene_destroy(scene);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {bodies_are_as_each_voxel_says,
                                  silhouettes_are_the_masks,
                                  many_masks,
                                  centres_on_borders,
                                  types_of_masks,
                                  refusals,
                                  NULL};
    return run_suite("hull", tests);
}
