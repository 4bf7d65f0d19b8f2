/* SPDX-License-Identifier: MIT
 *
 * How much a reader of meshes may take, and how long: signals and large numbers change nothing.
 */
#define _XOPEN_SOURCE 700

#include "read_meshes.h"
#include "written_files.h"

#include "tests/suite.h"

#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

START_TEST(a_reader_is_stopped_at_its_limits)
{
    FILE *file = fopen("long.obj", "w");
    ck_assert_ptr_nonnull(file);
    for (int i = 0; i < 400000; i++)
    {
        fprintf(file, "v %d 0 0\nv 0 %d 0\nv 0 0 %d\nf -1 -2 -3\n", i, i, i);
    }
    fclose(file);
    const cm_mesh_limits little = {sizeof little, 1 << 20, 0};
    refused_with("long.obj", &little, CM_ERROR_DATA, "more memory than a mesh may");
    cm_mesh *mesh = read_good("long.obj");
    ck_assert_uint_eq(cm_mesh_describe(mesh)->triangle_count, 400000);
    cm_mesh_destroy(mesh);
}
END_TEST

/* A mesh whose buffer is a pipe: whoever reads it waits until someone opens that for writing. */
static void write_waiting(void)
{
    unlink("pipe.bin");
    ck_assert_int_eq(mkfifo("pipe.bin", 0600), 0);
    write_text("waiting.gltf", "{\"asset\":{\"version\":\"2.0\"},"
                               "\"buffers\":[{\"uri\":\"pipe.bin\",\"byteLength\":4}]}");
}

static void pass(int number)
{
    (void)number;
}

static void pause_for(long microseconds)
{
    const struct timespec time = {microseconds / 1000000, microseconds % 1000000 * 1000};
    nanosleep(&time, NULL);
}

START_TEST(a_signal_does_not_end_the_limit)
{
    write_waiting();
    const struct sigaction action = {.sa_handler = pass}; /* without SA_RESTART */
    const struct itimerval once = {.it_value = {.tv_usec = 300000}};
    ck_assert_int_eq(sigaction(SIGALRM, &action, NULL), 0);
    ck_assert_int_eq(setitimer(ITIMER_REAL, &once, NULL), 0);
    const cm_mesh_limits brief = {sizeof brief, 0, 1};
    refused_with("waiting.gltf", &brief, CM_ERROR_DATA, "takes longer than a mesh may");
}
END_TEST

/* 2^32 milliseconds and 704 are 2 x 2147484 seconds. */
START_TEST(a_month_is_a_limit)
{
    write_waiting();
    const pid_t child = fork();
    ck_assert_int_ge(child, 0);
    if (child == 0)
    {
        pause_for(1500000);
        const int end = open("pipe.bin", O_RDWR);
        pause_for(20000000);
        _exit(end < 0);
    }
    const cm_mesh_limits long_one = {sizeof long_one, 0, 2147484};
    refused_with("waiting.gltf", &long_one, CM_ERROR_DATA, "cannot be read");
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
}
END_TEST

int main(void)
{
    if (chdir(test_folder()) != 0)
    {
        return 1;
    }
    const TTest *const tests[] = {a_reader_is_stopped_at_its_limits,
                                  a_signal_does_not_end_the_limit, a_month_is_a_limit, NULL};
    return run_suite("mesh time", tests);
}
