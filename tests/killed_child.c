/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE

#include "killed_child.h"

#include <signal.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "tests/suite.h"

void tell_step(int pipe_end, unsigned step)
{
    if (write(pipe_end, &step, sizeof step) != (ssize_t)sizeof step)
    {
        _exit(4);
    }
}

unsigned run_and_kill(endless_work work, unsigned first, unsigned steps, long microseconds)
{
    int ends[2];
    REQUIRE(pipe(ends) == 0, "no pipe");
    const pid_t child = fork();
    REQUIRE(child >= 0, "no child");
    if (child == 0)
    {
        close(ends[0]);
        work(ends[1], first);
        _exit(5);
    }
    close(ends[1]);
    unsigned last = first - 1, told;
    while (steps-- > 0 && read(ends[0], &told, sizeof told) == (ssize_t)sizeof told)
    {
        last = told;
    }
    const struct timespec wait = {0, microseconds * 1000};
    nanosleep(&wait, NULL);
    kill(child, SIGKILL);
    while (read(ends[0], &told, sizeof told) == (ssize_t)sizeof told)
    {
        last = told;
    }
    close(ends[0]);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child && WIFSIGNALED(status),
            "the child ended itself: %d", status);
    return last;
}

long pause_within_step(endless_work work)
{
    struct timespec begin, end;
    clock_gettime(CLOCK_MONOTONIC, &begin);
    run_and_kill(work, 1, 4, 0);
    clock_gettime(CLOCK_MONOTONIC, &end);
    const long pause = (end.tv_sec - begin.tv_sec) * 400000 + (end.tv_nsec - begin.tv_nsec) / 2500;
    return pause % 1000000 + 1;
}

void make_quick_folder(char folder[40], const char *name)
{
    snprintf(folder, 40, "/dev/shm/%s-XXXXXX", name);
    if (mkdtemp(folder) == NULL)
    {
        snprintf(folder, 40, "/tmp/%s-XXXXXX", name);
        REQUIRE(mkdtemp(folder) != NULL, "no folder");
    }
}
