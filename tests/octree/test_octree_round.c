/* SPDX-License-Identifier: MIT
 *
 * Updates by lenses and by cameras of whole surroundings: every voxel against what the pixel says that cm_camera_project_array
 * finds for it, without cones and without misses that wait; and what a pixel's ray ends in is hit.
 */
#include "dense_map.h"

#include "modules/octree/update_round.h"

/* ---- cameras ---- */

static cm_camera *lens(const double *distortion, size_t count)
{
    cm_camera_options options = {.size = sizeof options,
                                 .width = 72,
                                 .height = 50,
                                 .fx = 44.0,
                                 .fy = 45.0,
                                 .cx = 35.1,
                                 .cy = 25.7};
    memcpy(options.distortion, distortion, count * sizeof *distortion);
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(&options, &camera), CM_OK);
    return camera;
}

static cm_camera *surroundings(const char *name, const char *frame, uint32_t edge, int faces)
{
    cm_mapping *mapping = make_mapping(name, frame == NULL ? NULL : cm_frame_find(frame));
    const cm_camera_options options = {.size = sizeof options,
                                       .width = edge,
                                       .height = edge * (uint32_t)faces,
                                       .pixel_centre = 0.5,
                                       .mapping = mapping};
    cm_camera *camera = NULL;
    ck_assert_msg(cm_camera_create(&options, &camera) == CM_OK, "%s", name);
    cm_mapping_destroy(mapping);
    return camera;
}

/* ---- voxel by voxel ---- */

static float half_of(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static int word_of(const cm_pixel_rule *rule, float value)
{
    const float reach = half_of(rule->reach_front << 16),
                front = half_of(rule->reach_front & 0xffff0000u);
    const float away = value - rule->depth;
    return fabsf(away) <= reach ? 1 : away + front < 0.0f ? -1 : 0;
}

static void centres_of_row(const cm_octree *octree, const cm_pose *pose, int64_t y, int64_t z,
                           double *to[3])
{
    const cm_octree_options *options = &octree->options;
    const int64_t n = (int64_t)1 << options->levels;
    double corner[3], origin[3];
    for (int axis = 0; axis < 3; axis++)
    {
        corner[axis] = options->centre[axis] - ldexp(options->edge, octree->tree_level - 1) +
                       0.5 * options->edge;
    }
    cm_pose_apply(pose, corner, origin);
    for (int64_t x = 0; x < n; x++)
    {
        const double place[3] = {(double)(x + octree->first[0]), (double)(y + octree->first[1]),
                                 (double)(z + octree->first[2])};
        for (int i = 0; i < 3; i++)
        {
            const double *row = pose->rotation.row[i];
            to[i][x] = origin[i] + place[0] * (options->edge * row[0]) +
                       place[1] * (options->edge * row[1]) + place[2] * (options->edge * row[2]);
        }
    }
}

/* ---- what rays end in ---- */

/* A pixel's ray as the update knows it, in single precision, at depth 1 or range 1; 0: none. */
static int known_ray(const cm_round_desk *round, const cm_camera *camera, size_t pixel,
                     double ray[3])
{
    const double column = (double)(pixel % round->tree.width) + round->camera.pixel_centre,
                 row = (double)(pixel / round->tree.width) + round->camera.pixel_centre;
    double exact[3];
    cm_camera_ray_array(camera, 1, &column, &row, exact, exact + 1, exact + 2);
    const double along = round->is_range ? 1.0 : (double)round->tree.ray[2][pixel];
    for (int axis = 0; axis < 3 && !isnan(exact[0]); axis++)
    {
        ray[axis] = (double)round->tree.ray[axis][pixel] / along;
        ck_assert_double_eq_tol(ray[axis], exact[axis], 1e-6);
    }
    return !isnan(exact[0]);
}

/* Voxels that pixels which hit something see a point of. */
static void mark_ends(uint8_t *mark, const dense_map *map, const cm_octree *octree,
                      const cm_view *view)
{
    const cm_round_desk *round = ((const cm_update_desk *)octree->desk)->rounds;
    const cm_octree_options *options = &octree->options;
    memset(mark, 0, (size_t)(map->n * map->n * map->n));
    for (size_t pixel = 0; pixel < (size_t)round->tree.width * round->tree.height; pixel++)
    {
        double ray[3], point[3];
        if (!(half_of(round->rule[pixel].reach_front << 16) >= 0.0f) ||
            !known_ray(round, view->camera, pixel, ray))
        {
            continue;
        }
        for (int axis = 0; axis < 3; axis++)
        {
            ray[axis] *= (double)round->rule[pixel].depth;
        }
        cm_pose_apply_back(&view->pose, ray, point);
        int64_t voxel[3];
        int is_inside = 1;
        for (int axis = 0; axis < 3; axis++)
        {
            voxel[axis] = (int64_t)floor((point[axis] - options->centre[axis]) / options->edge +
                                         0.5 * (double)map->n);
            is_inside &= voxel[axis] >= 0 && voxel[axis] < map->n;
        }
        if (is_inside)
        {
            mark[dense_at(map, voxel[0], voxel[1], voxel[2])] = 1;
        }
    }
}

/* Returns how many voxels change; *ended: how many of them are hit only because rays end in them. */
static size_t update_dense(dense_map *map, const cm_octree *octree, const cm_view *view,
                           size_t *ended)
{
    const cm_update_desk *desk = octree->desk;
    const cm_round_desk *round = desk->rounds;
    const cm_camera_options *camera = cm_camera_describe(view->camera);
    const int64_t n = map->n;
    double memory[5][256], *const at[3] = {memory[0], memory[1], memory[2]};
    size_t changed = 0;
    ck_assert(n <= 256);
    uint8_t *mark = malloc((size_t)(n * n * n));
    ck_assert_ptr_nonnull(mark);
    mark_ends(mark, map, octree, view);
    for (int64_t row = 0; row < n * n; row++)
    {
        centres_of_row(octree, &view->pose, row % n, row / n, (double **)(uintptr_t)at);
        cm_camera_project_array(view->camera, (size_t)n, at[0], at[1], at[2], memory[3], memory[4]);
        for (int64_t x = 0; x < n; x++)
        {
            const double c = floor(memory[3][x] - camera->pixel_centre + 0.5);
            const double r = floor(memory[4][x] - camera->pixel_centre + 0.5);
            const double value =
                camera->mapping == NULL
                    ? at[2][x]
                    : sqrt(at[0][x] * at[0][x] + at[1][x] * at[1][x] + at[2][x] * at[2][x]);
            if (!(value > octree->options.near))
            {
                continue;
            }
            const size_t at_voxel = dense_at(map, x, row % n, row / n);
            const int is_seen = c >= 0.0 && c < camera->width && r >= 0.0 && r < camera->height;
            const int own =
                is_seen ? word_of(&round->rule[(size_t)r * camera->width + (size_t)c], (float)value)
                        : 0;
            const int word = mark[at_voxel] ? 1 : own;
            *ended += word != own;
            uint8_t *alpha = &map->alpha[at_voxel];
            const int now = *alpha + (word > 0   ? octree->rule.hit
                                      : word < 0 ? -octree->rule.miss
                                                 : 0);
            *alpha = (uint8_t)(now < octree->rule.low    ? octree->rule.low
                               : now > octree->rule.high ? octree->rule.high
                                                         : now);
            changed += word != 0;
        }
    }
    free(mark);
    return changed;
}

/* Returns how many voxels were hit only because rays end in them. */
static size_t check_camera(cm_camera *camera, const char *name, int levels, double middle,
                           uint64_t seed)
{
    dice from = {seed};
    cm_octree_options options = {
        .size = sizeof options, .levels = levels, .edge = ldexp(4.0, -levels)};
    options.centre[0] = dice_between(&from, -3.0, 3.0);
    options.near = seed % 2 ? 0.3 : 0.0;
    options.far = seed % 3 == 0 ? 1.7 : 0.0;
    options.no_return_is_free = seed % 6 == 0;
    options.noise = seed % 4 == 0 ? 0.01 : 0.0;
    cm_octree *octree = make_map(&options);
    dense_map map = dense_make(levels), read = dense_make(levels);
    cm_pool *pool = make_pool(seed % 2 ? 2 : 1);
    size_t changed = 0, ended = 0;
    for (int i = 0; i < 4; i++)
    {
        double place[3], at[3];
        for (int axis = 0; axis < 3; axis++)
        {
            place[axis] = options.centre[axis] + dice_between(&from, -1.5, 1.5);
            at[axis] = options.centre[axis] + dice_between(&from, -1.5, 1.5);
        }
        const cm_pose pose = look_at(place, at, 6.28 * throw_dice(&from));
        drawn_view drawn;
        draw_view(&drawn, camera, &pose, middle, 0, &from);
        for (int k = 0; k < 1 + 69 * (i == 2 && levels < 4); k++)
        {
            ck_assert_int_eq(cm_octree_update(octree, &drawn.view, pool), CM_OK);
            changed += update_dense(&map, octree, &drawn.view, &ended);
        }
        dense_read(octree, &read);
        const char *text = dense_differs(&read, &map);
        ck_assert_msg(text[0] == '\0', "%s, levels %d, view %d: %s", name, levels, i, text);
        clear_view(&drawn);
    }
    ck_assert_msg(changed > 0, "%s: nothing happens", name);
    cm_pool_destroy(pool);
    dense_clear(&map);
    dense_clear(&read);
    cm_octree_destroy(octree);
    return ended;
}

START_TEST(lenses_are_exact)
{
    const double all[][8] = {
        {0.1, -0.05}, {-0.3, 0.1, 0.002, -0.001}, {0.4, 0.2, 0.0, 0.0, -0.1, 0.1, 0.0, 0.05}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    {
        cm_camera *camera = lens(all[i], 8);
        size_t ended = 0;
        for (int levels = is_quick() ? 1 + (int)(i % 2) : 1; levels <= 6; levels += (int)step_of(2))
        {
            ended += check_camera(camera, "lens", levels, 1.3, 10 * i + (uint64_t)levels);
        }
        ck_assert_uint_gt(ended, 0);
        cm_camera_destroy(camera);
    }
}
END_TEST

/* Where a lens folds inside the picture, parts of pixels are seen whose centres are not. */
START_TEST(folded_lenses_are_exact)
{
    dice from = {3};
    for (int i = 0; i < 24; i += (int)step_of(4))
    {
        double distortion[5];
        for (int k = 0; k < 5; k++)
        {
            const double most = k == 0 ? 0.5 : k == 2 || k == 3 ? 0.05 : 0.4;
            distortion[k] = dice_between(&from, -most, most) - (k == 0 ? 0.6 : 0.0);
        }
        cm_camera *camera = lens(distortion, 5);
        check_camera(camera, "folded lens", 5 + i % 2, 1.3, (uint64_t)i);
        cm_camera_destroy(camera);
    }
}
END_TEST

START_TEST(surroundings_are_exact)
{
    const struct
    {
        const char *name, *frame;
        int faces;
    } all[] = {{"gnomonic", NULL, 6},   {"coupled", "gl", 6},    {"tangent", "fits", 6},
               {"conformal", "s2", 6},  {"octahedral", NULL, 1}, {"azimuthal:equidistant", NULL, 1},
               {"quincuncial", "gl", 1}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    {
        cm_camera *camera =
            surroundings(all[i].name, all[i].frame, all[i].faces == 6 ? 23 : 61, all[i].faces);
        size_t ended = 0;
        for (int levels = 1 + (int)(i % 2); levels <= 6; levels += 2 * (int)step_of(2))
        {
            ended += check_camera(camera, all[i].name, levels, 1.3, 10 * i + (uint64_t)levels);
        }
        ck_assert_uint_gt(ended, 0);
        cm_camera_destroy(camera);
    }
}
END_TEST

/* A distortion that is nothing is the other way to nearly the same map: a lens heeds all that is seen nearby, a straight camera only
 * what voxels reach, so that the lens knows less. */
START_TEST(a_lens_of_no_distortion_is_nearly_straight)
{
    const double none = 0.0, almost = 1e-15;
    cm_camera *camera[2] = {lens(&none, 1), lens(&almost, 1)};
    cm_octree_options options = {.size = sizeof options, .levels = 6, .edge = 0.05, .far = 2.5};
    dense_map map[2] = {dense_make(6), dense_make(6)};
    for (int i = 0; i < 2; i++)
    {
        dice from = {5};
        cm_octree *octree = make_map(&options);
        for (int k = 0; k < 3; k++)
        {
            const double place[3] = {dice_between(&from, -0.5, 0.5), 0.1 * k, -1.2},
                         at[3] = {0.1, 0.2, 0.3};
            const cm_pose pose = look_at(place, at, 0.2 * k);
            drawn_view drawn;
            draw_view(&drawn, camera[i], &pose, 1.3, 0, &from);
            ck_assert_int_eq(cm_octree_update(octree, &drawn.view, NULL), CM_OK);
            clear_view(&drawn);
        }
        dense_read(octree, &map[i]);
        cm_octree_destroy(octree);
        cm_camera_destroy(camera[i]);
    }
    size_t different = 0, opposed = 0, known = 0, missing = 0;
    for (size_t i = 0; i < (size_t)1 << 18; i++)
    {
        const int a = map[0].alpha[i] - 127, b = map[1].alpha[i] - 127;
        known += a != 0;
        different += b != 0 && a != b;
        missing += b != 0 && a == 0;
        opposed += a * b < 0;
    }
    ck_assert_msg(known > 20000, "%zu known", known);
    ck_assert_msg(different < known / 10 && opposed < known / 400 && missing < known / 60,
                  "%zu of %zu differ, %zu opposed, %zu missing", different, known, opposed,
                  missing);
    dense_clear(&map[0]);
    dense_clear(&map[1]);
}
END_TEST

/* The depths of a lens as ranges along its rays; NaN and 0 stay. */
static void make_range(drawn_view *drawn, const cm_camera *camera)
{
    const cm_camera_options *options = cm_camera_describe(camera);
    for (size_t i = 0; i < (size_t)options->width * options->height; i++)
    {
        const double column = (double)(i % options->width) + options->pixel_centre;
        const double row = (double)(i / options->width) + options->pixel_centre;
        double x, y, z;
        cm_camera_ray_array(camera, 1, &column, &row, &x, &y, &z);
        drawn->depth[i] = (float)((double)drawn->depth[i] * sqrt(x * x + y * y + z * z) / z);
    }
    drawn->view.depth_is_range = 1;
}

/* But for rounding of the ranges, which some voxels on the border of being hit tell. */
START_TEST(ranges_of_a_lens_are_its_depths)
{
    const double distortion[] = {0.1, -0.05};
    cm_camera *camera = lens(distortion, 2);
    const cm_octree_options options = {.size = sizeof options, .levels = 6, .edge = 0.05};
    dense_map map[2] = {dense_make(6), dense_make(6)};
    for (int i = 0; i < 2; i++)
    {
        dice from = {7};
        cm_octree *octree = make_map(&options);
        for (int k = 0; k < 3; k++) /* a lens's rays stay from view to view */
        {
            const double place[3] = {0.2 * k - 0.3, 0.1, -1.2}, at[3] = {0.1, 0.2, 0.3};
            const cm_pose pose = look_at(place, at, 0.2 * k);
            drawn_view drawn;
            draw_view(&drawn, camera, &pose, 1.3, 0, &from);
            if (i == 1)
            {
                make_range(&drawn, camera);
            }
            ck_assert_int_eq(cm_octree_update(octree, &drawn.view, NULL), CM_OK);
            clear_view(&drawn);
        }
        dense_read(octree, &map[i]);
        cm_octree_destroy(octree);
    }
    size_t different = 0, known = 0;
    for (size_t i = 0; i < (size_t)1 << 18; i++)
    {
        known += map[0].alpha[i] != 127;
        different += map[0].alpha[i] != map[1].alpha[i];
    }
    ck_assert_uint_gt(known, 20000);
    ck_assert_msg(different < known / 1000, "%zu of %zu differ", different, known);
    dense_clear(&map[0]);
    dense_clear(&map[1]);
    cm_camera_destroy(camera);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {lenses_are_exact,
                                  folded_lenses_are_exact,
                                  surroundings_are_exact,
                                  a_lens_of_no_distortion_is_nearly_straight,
                                  ranges_of_a_lens_are_its_depths,
                                  NULL};
    return run_suite("octree round", tests);
}
