/* SPDX-License-Identifier: MIT
 *
 * What a walk over changes tells, against all voxels before and after.
 */
#include "dense_map.h"

static cm_camera *camera;

typedef struct change_walk
{
    const cm_octree *octree;
    dense_map *seen;
} change_walk;

static int see_voxel(void *user, const cm_voxel *voxel)
{
    change_walk *walk = user;
    const cm_octree_options *options = cm_octree_describe(walk->octree);
    const int64_t size = (int64_t)1 << voxel->level;
    int64_t first[3];
    for (int axis = 0; axis < 3; axis++)
    {
        const double centre = axis == 0 ? voxel->x : axis == 1 ? voxel->y : voxel->z;
        first[axis] = (int64_t)floor((centre - options->centre[axis]) / options->edge -
                                     0.5 * (double)size + 0.5) +
                      walk->seen->n / 2;
    }
    for (int64_t i = 0; i < size * size * size; i++)
    {
        walk->seen->alpha[dense_at(walk->seen, first[0] + i % size, first[1] + i / size % size,
                                   first[2] + i / size / size)] = 1;
    }
    return 0;
}

START_TEST(changes_are_in_what_is_walked)
{
    const cm_octree_options options = {.size = sizeof options, .levels = 7, .edge = 0.05};
    cm_octree *octree = make_map(&options);
    dense_map before = dense_make(7), after = dense_make(7), seen = dense_make(7);
    dice from = {9};
    for (int i = 0; i < 8; i += (int)step_of(4))
    {
        const double place[3] = {dice_between(&from, -3.0, 3.0), dice_between(&from, -3.0, 3.0),
                                 -3.0};
        const double at[3] = {0.1, 0.2, 0.3};
        const cm_pose pose = look_at(place, at, 0.3 * i);
        drawn_view drawn;
        draw_view(&drawn, camera, &pose, 2.0, 0, &from);
        dense_read(octree, &before);
        ck_assert_int_eq(cm_octree_update(octree, &drawn.view, NULL), CM_OK);
        clear_view(&drawn);
        dense_read(octree, &after);
        memset(seen.alpha, 0, (size_t)1 << 21);
        change_walk walk = {octree, &seen};
        ck_assert_int_eq(
            cm_octree_walk_changes(octree, cm_octree_step(octree) - 1, see_voxel, &walk), CM_OK);
        size_t walked = 0, unseen = 0;
        for (size_t k = 0; k < (size_t)1 << 21; k++)
        {
            unseen += cm_octree_step(octree) > 1 && before.alpha[k] != after.alpha[k] &&
                      after.alpha[k] != 127 && !seen.alpha[k];
            walked += seen.alpha[k];
        }
        ck_assert_msg(unseen == 0, "view %d: %zu changes are not walked", i, unseen);
        memset(seen.alpha, 0, (size_t)1 << 21);
        ck_assert_int_eq(cm_octree_walk_changes(octree, cm_octree_step(octree), see_voxel, &walk),
                         CM_OK);
        for (size_t k = 0; k < (size_t)1 << 21; k++)
        {
            ck_assert(!seen.alpha[k]);
        }
        ck_assert(walked > 0);
    }
    dense_clear(&before);
    dense_clear(&after);
    dense_clear(&seen);
    cm_octree_destroy(octree);
}
END_TEST

/* A view of a wall, from one of three places, in one color. */
static void add_wall(cm_octree *octree, int place_number, float away, uint8_t grey)
{
    const cm_camera_options *shape = cm_camera_describe(camera);
    const size_t pixels = (size_t)shape->width * shape->height;
    const double place[3] = {0.8 * (place_number - 1), 0.1, -3.0};
    const double at[3] = {0.1 * place_number, 0.2, 0.3};
    float *depth = malloc(pixels * sizeof *depth);
    uint8_t *color = malloc(pixels);
    ck_assert(depth != NULL && color != NULL);
    for (size_t i = 0; i < pixels; i++)
    {
        depth[i] = away;
    }
    memset(color, grey, pixels);
    cm_view view = {.size = sizeof view,
                    .camera = camera,
                    .pose = look_at(place, at, 0.4 * place_number),
                    .depth_unit = 1.0,
                    .depth = {.size = sizeof view.depth,
                              .data = depth,
                              .type = CM_PIXEL_FLOAT,
                              .width = shape->width,
                              .height = shape->height,
                              .channels = 1}};
    view.color = view.depth;
    view.color.data = color;
    view.color.type = CM_PIXEL_U8;
    ck_assert_int_eq(cm_octree_update(octree, &view, NULL), CM_OK);
    free(depth);
    free(color);
}

/* How many blocks have what changed between two maps, and how many were walked over; all that changed must be. */
static void count_blocks(const dense_map *before, const dense_map *after, const dense_map *seen,
                         size_t *changed, size_t *walked)
{
    const int64_t blocks = after->n / 8;
    for (int64_t block = 0; block < blocks * blocks * blocks; block++)
    {
        int has_changed = 0, is_seen = 0;
        for (int64_t i = 0; i < 512; i++)
        {
            const size_t k = dense_at(after, 8 * (block % blocks) + i % 8,
                                      8 * (block / blocks % blocks) + i / 8 % 8,
                                      8 * (block / blocks / blocks) + i / 64);
            const int is_other =
                before->alpha[k] != after->alpha[k] || before->color[k] != after->color[k];
            ck_assert(!is_other || after->alpha[k] == 127 || seen->alpha[k]);
            has_changed |= is_other;
            is_seen |= seen->alpha[k];
        }
        *changed += (size_t)has_changed;
        *walked += (size_t)is_seen;
    }
}

/* What is at the lowest and is missed again has not changed, however its block or node is stored; a wall that is surely there and
 * has another color has. */
START_TEST(only_changes_are_walked)
{
    const cm_octree_options options = {
        .size = sizeof options, .levels = 7, .edge = 0.05, .color = 1};
    dense_map before = dense_make(7), after = dense_make(7), seen = dense_make(7);
    for (int compacts = 0; compacts < 2; compacts++)
    {
        cm_octree *octree = make_map(&options);
        for (int i = 0; i < 6 * 70; i++)
        {
            const uint64_t step = cm_octree_step(octree);
            const int is_asked = i >= 210 && i % 23 == 5;
            if (is_asked)
            {
                dense_read(octree, &before);
            }
            add_wall(octree, i / 70 % 3, 5.0f, (uint8_t)(is_asked ? 250 : 20));
            if (is_asked)
            {
                dense_read(octree, &after);
                memset(seen.alpha, 0, (size_t)1 << 21);
                change_walk walk = {octree, &seen};
                ck_assert_int_eq(cm_octree_walk_changes(octree, step, see_voxel, &walk), CM_OK);
                size_t changed = 0, walked = 0;
                count_blocks(&before, &after, &seen, &changed, &walked);
                ck_assert_msg(walked == changed && changed > 0,
                              "view %d: %zu blocks are walked, %zu have changed", i, walked,
                              changed);
            }
            if (compacts && i % 70 == 40)
            {
                ck_assert_int_eq(cm_octree_compact(octree), CM_OK);
            }
        }
        cm_octree_destroy(octree);
    }
    dense_clear(&before);
    dense_clear(&after);
    dense_clear(&seen);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {changes_are_in_what_is_walked, only_changes_are_walked, NULL};
    camera = straight_camera(60, 44, 0.5);
    const int result = run_suite("octree changes", tests);
    cm_camera_destroy(camera);
    return result;
}
