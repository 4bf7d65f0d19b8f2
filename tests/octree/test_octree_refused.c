/* SPDX-License-Identifier: MIT
 *
 * Maps where the system has no memory: each allocation fails once, which is told; nothing leaks, and the map can be asked, updated
 * and kept afterwards.
 */
#include <cubemap/store.h>

#include "dense_map.h"

#include "tests/refused_allocation.h"

static cm_camera *straight, *bent;
static drawn_view seen[2];
static cm_store *store;
static cm_octree *other;

static const cm_octree_options options = {
    .size = sizeof options, .levels = 7, .edge = 0.05, .color = 1, .instructions = "scalar"};

/* Blocks that the library of stores made, which are not counted, and that maps have given back: bytes of the user. */
static int blocks_given;

typedef cm_status (*trial)(cm_octree *octree);

static cm_status update_straight(cm_octree *octree)
{
    return cm_octree_update(octree, &seen[0].view, NULL);
}
static cm_status update_bent(cm_octree *octree)
{
    return cm_octree_update(octree, &seen[1].view, NULL);
}
static cm_status update_points(cm_octree *octree)
{
    const double origin[3] = {-1.0, -1.0, -1.0};
    const float xyz[2][3] = {{1.0f, 0.5f, 0.7f}, {-0.3f, 1.0f, 0.2f}};
    const uint8_t rgb[6] = {1, 2, 3, 4, 5, 6};
    return cm_octree_update_points(octree, origin, 2, xyz[0], rgb);
}
static cm_status merge(cm_octree *octree)
{
    return cm_octree_merge(octree, other, NULL);
}
static cm_status merge_sampled(cm_octree *octree)
{
    const double place[3] = {0.1, 0.2, 0.3}, at[3] = {1.0, 0.0, 0.0};
    const cm_pose pose = look_at(place, at, 0.2);
    return cm_octree_merge(octree, other, &pose);
}
static cm_status compact(cm_octree *octree)
{
    return cm_octree_compact(octree);
}
static cm_status save(cm_octree *octree)
{
    return cm_octree_save(octree, store, "user", 4);
}
static cm_status load(cm_octree *octree)
{
    cm_octree *back = NULL;
    (void)octree;
    const cm_status status = cm_octree_load(store, NULL, &back);
    ck_assert((status == CM_OK) == (back != NULL));
    blocks_given += status == CM_OK;
    cm_octree_destroy(back);
    return status;
}
static cm_status create(cm_octree *octree)
{
    cm_octree *made = NULL;
    (void)octree;
    const cm_status status = cm_octree_create(&options, &made);
    ck_assert((status == CM_OK) == (made != NULL));
    cm_octree_destroy(made);
    return status;
}

/* is_old: something is in the map before. */
static void refuse_each(const char *name, trial try_it, int is_old)
{
    cm_status status = CM_ERROR_MEMORY;
    int refused = 0;
    for (int blocks = 0; status != CM_OK; blocks += (blocks < 100 ? 1 : 37) * (int)step_of(4))
    {
        const int before = blocks_alive() + blocks_given;
        cm_octree *octree = NULL;
        ck_assert_int_eq(cm_octree_create(&options, &octree), CM_OK);
        ck_assert_int_eq(is_old ? update_straight(octree) : CM_OK, CM_OK);
        const uint64_t step = cm_octree_step(octree);
        blocks_until_refusal = blocks;
        status = try_it(octree);
        const int is_refused = blocks_until_refusal < 0;
        blocks_until_refusal = -1;
        ck_assert_msg(status == (is_refused ? CM_ERROR_MEMORY : CM_OK), "%s, block %d: %d", name,
                      blocks, (int)status);
        ck_assert(cm_octree_step(octree) <= step + 1);
        refused += is_refused;
        cm_octree_count number = {.size = sizeof number};
        ck_assert_int_eq(cm_octree_count_voxels(octree, &number), CM_OK);
        ck_assert_int_eq(update_straight(octree), CM_OK);
        ck_assert_int_eq(cm_octree_compact(octree), CM_OK);
        cm_octree_destroy(octree);
        const int after = blocks_alive() + blocks_given;
        ck_assert_msg(after == before, "%s, block %d: %d blocks leak", name, blocks,
                      after - before);
    }
    ck_assert_msg(refused > 0, "%s", name);
}

START_TEST(refused_memory_is_told)
{
    refuse_each("create", create, 0);
    refuse_each("straight", update_straight, 0);
    refuse_each("straight, again", update_bent, 1);
    refuse_each("bent", update_bent, 0);
    refuse_each("points", update_points, 0);
    refuse_each("points, again", update_points, 1);
    refuse_each("merge", merge, 1);
    refuse_each("merge into nothing", merge, 0);
    refuse_each("sampled", merge_sampled, 1);
    refuse_each("compact", compact, 1);
    refuse_each("save", save, 1);
    ck_assert_int_eq(save(other), CM_OK);
    refuse_each("load", load, 0);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {refused_memory_is_told, NULL};
    const double place[3] = {0.0, 0.1, -1.4}, at[3] = {0.1, 0.2, 0.3};
    const cm_pose pose = look_at(place, at, 0.3);
    cm_camera_options lens = {.size = sizeof lens,
                              .width = 40,
                              .height = 30,
                              .fx = 36.0,
                              .fy = 36.0,
                              .cx = 20.0,
                              .cy = 15.0};
    straight = straight_camera(40, 30, 0.5);
    lens.distortion[0] = 0.05;
    if (cm_camera_create(&lens, &bent) != CM_OK || cm_store_create_in_memory(&store) != CM_OK ||
        cm_octree_create(&options, &other) != CM_OK)
    {
        return 1;
    }
    dice from = {1};
    draw_view(&seen[0], straight, &pose, 1.5, 1, &from);
    draw_view(&seen[1], bent, &pose, 1.2, 1, &from);
    if (update_bent(other) != CM_OK)
    {
        return 1;
    }
    const int result = run_suite("octree refused", tests);
    cm_octree_destroy(other);
    cm_store_destroy(store);
    clear_view(&seen[0]);
    clear_view(&seen[1]);
    cm_camera_destroy(straight);
    cm_camera_destroy(bent);
    return result;
}
