/* SPDX-License-Identifier: MIT
 *
 * A map whose pages are a store in a file, and whose process is killed while it updates: the map opens again, and is that of the
 * last commit, voxel for voxel.
 */
#define _GNU_SOURCE

#include <sys/stat.h>
#include <unistd.h>

#include "dense_map.h"
#include "modules/scene/io/store_file.h"
#include "tests/killed_child.h"

static char folder[40];
static char path[80];
static char message[CM_IMAGE_MESSAGE];
static cm_camera *camera;

static void journal_of(char journal[100])
{
    snprintf(journal, 100, "%s-journal", path);
}

static void forget_file(void)
{
    char journal[100];
    journal_of(journal);
    unlink(path);
    unlink(journal);
}

/* What a step does to a map: regions go to pages and come back within it. */
static cm_status step_map(cm_octree *octree, unsigned step)
{
    const cm_status status = update_drawn(octree, camera, 2 * (uint64_t)step);
    return status == CM_OK ? update_drawn(octree, camera, 2 * (uint64_t)step + 1) : status;
}

/* Every step is committed, with its number beside the map. */
static void update_until_killed(int pipe_end, unsigned step)
{
    const cm_store_file_options options = {.size = sizeof options, .create = 1};
    cm_store *store = NULL;
    cm_octree *octree = NULL;
    if (cm_store_file_open(path, &options, &store, message) != CM_OK)
    {
        _exit(3);
    }
    const cm_octree_options with = paged_options(store);
    cm_status status =
        step == 1 ? cm_octree_create(&with, &octree) : cm_octree_load(store, &with, &octree);
    for (; status == CM_OK; step++)
    {
        status = step_map(octree, step);
        status = status == CM_OK ? cm_octree_save(octree, store, &step, sizeof step) : status;
        if (status == CM_OK)
        {
            tell_step(pipe_end, step);
        }
    }
    _exit(6);
}

/* The step whose map the file has, which must be equal to the model after it: the last that was told, or one more. */
static unsigned check_map(cm_octree *model, unsigned told, unsigned done)
{
    cm_store *store = NULL;
    cm_octree *back = NULL;
    cm_status status = cm_store_file_open(path, NULL, &store, message);
    REQUIRE(status == CM_OK, "step %u: %d %s", told, (int)status, message);
    status = cm_octree_load(store, NULL, &back);
    REQUIRE(status == CM_OK, "step %u: %d %s", told, (int)status, cm_store_message(store));
    unsigned kept = 0;
    size_t count = 0;
    const void *user = cm_octree_user_data(back, &count);
    REQUIRE(count == sizeof kept, "step %u: %zu bytes", told, count);
    memcpy(&kept, user, sizeof kept);
    REQUIRE(kept == told || kept == told + 1, "step %u is kept, %u was told", kept, told);
    for (; done < kept; done++)
    {
        ck_assert_int_eq(step_map(model, done + 1), CM_OK);
    }
    const char *differs = maps_differ(back, model);
    REQUIRE(differs[0] == '\0', "step %u: %s", kept, differs);
    ck_assert_uint_eq(cm_octree_step(back), cm_octree_step(model));
    cm_octree_destroy(back);
    cm_store_destroy(store);
    return kept;
}

/* How many regions are in the file alone when a map goes on. */
static uint64_t paged_regions(void)
{
    cm_store *store = NULL;
    cm_octree *octree = NULL;
    ck_assert_int_eq(cm_store_file_open(path, NULL, &store, message), CM_OK);
    const cm_octree_options with = paged_options(store);
    ck_assert_int_eq(cm_octree_load(store, &with, &octree), CM_OK);
    ck_assert_int_eq(update_drawn(octree, camera, 1), CM_OK);
    cm_octree_count count = {.size = sizeof count};
    ck_assert_int_eq(cm_octree_count_voxels(octree, &count), CM_OK);
    cm_octree_destroy(octree);
    cm_store_destroy(store);
    return count.paged;
}

START_TEST(killed_map_is_that_of_its_last_commit)
{
    const unsigned kills = is_long() ? 500 : is_quick() ? 6 : 24;
    const cm_octree_options options = paged_options(NULL);
    const long pause = pause_within_step(update_until_killed);
    forget_file();
    cm_octree *model = make_map(&options);
    unsigned kept = 0, journals = 0, later = 0, random = 1;
    for (unsigned i = 0; i < kills; i++)
    {
        random = random * 1664525u + 1013904223u;
        /* the first must be kept, since there is no map before it */
        const unsigned steps = kept == 0 ? 1 : i % 3;
        const unsigned told =
            run_and_kill(update_until_killed, kept + 1, steps, (long)(random >> 8) % pause);
        char journal[100];
        struct stat status;
        journal_of(journal);
        journals += stat(journal, &status) == 0 && status.st_size > 0;
        const unsigned before = kept;
        kept = check_map(model, told, kept);
        later += kept > told;
        REQUIRE(kept >= before, "a step is lost");
    }
    printf("%u kills, %u within a step, %u after a commit that was not told; %u steps kept\n",
           kills, journals, later, kept);
    REQUIRE(kept > kills / 2 && journals > 0, "the children are killed before they write");
    REQUIRE(paged_regions() > 2, "nothing is in pages");
    cm_octree_destroy(model);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {killed_map_is_that_of_its_last_commit, NULL};
    make_quick_folder(folder, "cubemap-octree");
    snprintf(path, sizeof path, "%s/map", folder);
    camera = straight_camera(60, 44, 0.5);
    const int failed = run_suite("octree kills", tests);
    cm_camera_destroy(camera);
    forget_file();
    rmdir(folder);
    return failed;
}
