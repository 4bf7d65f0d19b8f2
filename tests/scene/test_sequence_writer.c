/* SPDX-License-Identifier: MIT
 *
 * Sequences that are written: all of a folder or nothing, on full disks and after kills too.
 */
#define _DEFAULT_SOURCE

#include "modules/scene/io/camera_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/suite.h"
#include "small_views.h"
#include "written_files.h"

START_TEST(writers_leave_all_or_nothing)
{
    const char *folder = in_folder("dropped");
    cm_camera *camera = make_camera(WIDTH);
    cm_sequence_writer *writer = NULL;
    const int before = count_entries(test_folder());
    REQUIRE(cm_sequence_create(folder, CM_SEQUENCE_TUM, camera, 5000.0, &writer, message) == CM_OK,
            "%s", message);
    cm_view view = make_view(camera, 0, 1);
    depth_metres[1] = 14.0f; /* beyond 65535 units */
    size_t beyond = 0;
    REQUIRE(cm_sequence_write(writer, &view, &beyond, message) == CM_OK && beyond == 1, "%s %zu",
            message, beyond);
    ck_assert_int_eq(cm_sequence_write(writer, &view, NULL, message),
                     CM_ERROR_CAMERA); /* no later */
    view.time += 1.0;
    view.depth.width--;
    ck_assert_int_eq(cm_sequence_write(writer, &view, NULL, message), CM_ERROR_CAMERA);
    cm_sequence_drop(writer);
    ck_assert_int_eq(count_entries(test_folder()), before);
    write_text("full/a", "a");
    ck_assert_int_eq(
        cm_sequence_create(in_folder("full"), CM_SEQUENCE_TUM, camera, 5000.0, &writer, message),
        CM_ERROR_FILE);
    ck_assert_int_eq(cm_sequence_create(in_folder("no/such/folder"), CM_SEQUENCE_TUM, camera,
                                        5000.0, &writer, message),
                     CM_ERROR_FILE);
    ck_assert_int_eq(cm_sequence_create(folder, CM_SEQUENCE_ANY, camera, 5000.0, &writer, message),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_sequence_create(folder, CM_SEQUENCE_TUM, camera, 0.0, &writer, message),
                     CM_ERROR_ARGUMENT);
    cm_camera_destroy(camera);
}
END_TEST

/* Files that may have no more than so many bytes are as a full disk is. */
static cm_status write_little(const char *folder, cm_sequence_layout layout,
                              const cm_camera *camera, rlim_t bytes)
{
    struct rlimit old;
    getrlimit(RLIMIT_FSIZE, &old);
    const struct rlimit small = {bytes, old.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    cm_sequence_writer *writer = NULL;
    const cm_view view = make_view(camera, 0, 0);
    cm_status status = cm_sequence_create(folder, layout, camera, 5000.0, &writer, message);
    status = status != CM_OK ? status : cm_sequence_write(writer, &view, NULL, message);
    status = status != CM_OK ? status : cm_sequence_finish(writer, message);
    cm_sequence_drop(writer);
    setrlimit(RLIMIT_FSIZE, &old);
    return status;
}

START_TEST(full_disks_are_told_under_the_name_that_was_asked_for)
{
    const char *folder = in_folder("little");
    cm_camera *camera = make_camera(WIDTH);
    const int before = count_entries(test_folder());
    signal(SIGXFSZ, SIG_IGN);
    for (int layout = CM_SEQUENCE_TUM; layout <= CM_SEQUENCE_SEVEN_SCENES; layout++)
    {
        int failures = 0;
        for (rlim_t bytes = 0; bytes < 400; bytes += 20)
        {
            message[0] = '\0';
            if (write_little(folder, (cm_sequence_layout)layout, camera, bytes) == CM_OK)
            {
                break;
            }
            failures++;
            REQUIRE(strncmp(message, folder, strlen(folder)) == 0 &&
                        strstr(message, ".cubemap-") == NULL,
                    "%d bytes: %s", (int)bytes, message);
            ck_assert_int_eq(count_entries(test_folder()), before);
        }
        ck_assert_int_gt(failures, 2);
        remove_all(folder);
    }
    cm_camera_destroy(camera);
}
END_TEST

/* A child begins a folder and is killed. */
static void leave_unfinished(const char *folder, const cm_camera *camera)
{
    const pid_t child = fork();
    if (child == 0)
    {
        cm_sequence_writer *writer = NULL;
        const cm_view view = make_view(camera, 0, 0);
        if (cm_sequence_create(folder, CM_SEQUENCE_TUM, camera, 5000.0, &writer, message) ==
                CM_OK &&
            cm_sequence_write(writer, &view, NULL, message) == CM_OK)
        {
            raise(SIGKILL);
        }
        _exit(1);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child && WIFSIGNALED(status), "the child ended itself");
}

START_TEST(what_was_killed_is_gone_with_the_next)
{
    cm_camera *camera = make_camera(WIDTH);
    const char *folder = in_folder("killed");
    const int before = count_entries(test_folder());
    leave_unfinished(folder, camera);
    ck_assert_int_eq(count_entries(test_folder()), before + 1);
    /* whose process is gone but who is locked, who lives, and who is none of ours, stay */
    const char *const kept[] = {".cubemap-999999999-0.sequence", ".cubemap-999999998-0",
                                ".cubemap-notes.sequence", ".cubemap-999999997-0.sequence.old",
                                "aim"};
    for (size_t i = 0; i < sizeof kept / sizeof kept[0]; i++)
    {
        char name[100];
        snprintf(name, sizeof name, "%s/mine", kept[i]);
        write_text(name, "mine");
    }
    const int locked = open(in_folder(kept[0]), O_RDONLY);
    ck_assert_int_eq(flock(locked, LOCK_EX | LOCK_NB), 0);
    ck_assert_int_eq(symlink("aim", in_folder(".cubemap-999999996-0.sequence")), 0);
    cm_sequence_writer *living = NULL;
    ck_assert_int_eq(
        cm_sequence_create(in_folder("living"), CM_SEQUENCE_TUM, camera, 5000.0, &living, message),
        CM_OK);
    ck_assert_int_eq(count_entries(test_folder()), before + 5 + 1 + 1);
    write_views("killed", CM_SEQUENCE_TUM, 0);
    ck_assert_int_eq(count_entries(test_folder()), before + 5 + 1 + 1 + 1);
    ck_assert_int_eq(count_entries(in_folder("aim")), 1);
    REQUIRE(cm_sequence_finish(living, message) == CM_OK, "%s", message);
    cm_sequence_drop(living);
    close(locked);
    write_views("killed", CM_SEQUENCE_TUM, 0);
    ck_assert_int_lt(count_entries(in_folder(kept[0])), 0); /* its lock is gone */
    for (size_t i = 1; i < sizeof kept / sizeof kept[0]; i++)
    {
        ck_assert_int_eq(count_entries(in_folder(kept[i])), 1);
    }
    cm_camera_destroy(camera);
}
END_TEST

/* In a container each process may have the number of the one that was killed. */
START_TEST(what_was_killed_had_our_number)
{
    char name[100];
    snprintf(name, sizeof name, ".cubemap-%ld-900.sequence/mine", (long)getpid());
    write_text(name, "mine");
    *strrchr(name, '/') = '\0';
    write_views("numbered", CM_SEQUENCE_TUM, 0);
    ck_assert_int_lt(count_entries(in_folder(name)), 0);
    for (int i = 1000; i < 1100; i++)
    {
        snprintf(name, sizeof name, ".cubemap-%ld-%d", (long)getpid(), i);
        write_text(name, "mine");
    }
    cm_camera *camera = make_camera(WIDTH);
    REQUIRE(cm_camera_file_write(in_folder("camera.json"), camera, 5000.0, message) == CM_OK, "%s",
            message);
    ck_assert_int_eq(access(in_folder("camera.json"), R_OK), 0);
    cm_camera_destroy(camera);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        writers_leave_all_or_nothing,
        full_disks_are_told_under_the_name_that_was_asked_for,
        what_was_killed_is_gone_with_the_next,
        what_was_killed_had_our_number,
        NULL,
    };
    return run_suite("sequence writer", tests);
}
