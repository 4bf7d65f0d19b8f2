/* SPDX-License-Identifier: MIT
 *
 * What a second thread is worth: views a second of one process with one thread, of one with two, and of two processes with a
 * thread each, together. All have the same views of the analytic room, and maps of their own with voxels of 1 cm. They take
 * turns, so that what else the machine does befalls all alike.
 *
 *   process-speed [VIEWS [ROUNDS]]     180 in each turn, 7 turns
 *
 * Lines are words and the median of views a second, apart by a tab; the last is the share that two threads have of what two
 * processes reach, the median of the turns' shares.
 */
#define _POSIX_C_SOURCE 200809L

#include "bench/harness/harness.h"
#include "mapped_room.h"

#include <cubemap/pool.h>

#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

/* One map; when it is full of its first pass it says so, and waits until it may go on. */
static void work(const room_walk *walk, unsigned threads, size_t views, int ready, int go)
{
    const cm_octree_options options = {
        .size = sizeof options, .edge = 0.01, .levels = 12, .color = 1};
    cm_octree *octree = room_walk_map(walk, &options);
    cm_pool *pool = NULL;
    char byte = 0;
    if (threads > 1)
    {
        need(cm_pool_create(threads, &pool), "threads");
    }
    if (write(ready, &byte, 1) != 1 || read(go, &byte, 1) != 1)
    {
        _exit(1);
    }
    for (size_t i = 0; i < views; i++)
    {
        need(cm_octree_update(octree, &walk->view[i % walk->count], pool), "update");
    }
    _exit(write(ready, &byte, 1) == 1 ? 0 : 1);
}

static void await(int end, unsigned bytes)
{
    char byte;
    for (unsigned i = 0; i < bytes; i++)
    {
        need(read(end, &byte, 1) == 1 ? CM_OK : CM_ERROR_FILE, "a process has ended");
    }
}

/* Views a second of all processes together. */
static double speed_of(const room_walk *walk, unsigned processes, unsigned threads, size_t views)
{
    int ready[2], go[2];
    need(pipe(ready) == 0 && pipe(go) == 0 ? CM_OK : CM_ERROR_FILE, "pipes");
    for (unsigned i = 0; i < processes; i++)
    {
        const pid_t child = fork();
        need(child >= 0 ? CM_OK : CM_ERROR_MEMORY, "processes");
        if (child == 0)
        {
            close(ready[0]);
            close(go[1]);
            work(walk, threads, views, ready[1], go[0]);
        }
    }
    close(ready[1]);
    close(go[0]);
    await(ready[0], processes);
    const double begin = seconds();
    need(write(go[1], "goes", processes) == (ssize_t)processes ? CM_OK : CM_ERROR_FILE, "pipes");
    await(ready[0], processes);
    const double took = seconds() - begin;
    close(ready[0]);
    close(go[1]);
    while (wait(NULL) > 0)
    {
    }
    return (double)(views * processes) / took;
}

static double median_of(const double *value, size_t count)
{
    double *sorted = sorted_copy(value, count);
    const double median = sorted_median(sorted, count);
    free(sorted);
    return median;
}

int main(int count, char **word)
{
    enum
    {
        ROUNDS_MOST = 1000
    };
    static double one[ROUNDS_MOST], threads[ROUNDS_MOST], processes[ROUNDS_MOST],
        share[ROUNDS_MOST];
    name_program("process-speed");
    const size_t views = count > 1 ? (size_t)strtoul(word[1], NULL, 10) : 180;
    const size_t rounds = count > 2 ? (size_t)strtoul(word[2], NULL, 10) : 7;
    if (views == 0 || rounds == 0 || rounds > ROUNDS_MOST)
    {
        fprintf(stderr, "process-speed: a view and a turn at least, %d turns at most\n",
                ROUNDS_MOST);
        return 2;
    }
    room_walk walk = room_walk_make(NULL, 0, 0.0);
    for (size_t i = 0; i < rounds; i++)
    {
        one[i] = speed_of(&walk, 1, 1, views);
        threads[i] = speed_of(&walk, 1, 2, views);
        processes[i] = speed_of(&walk, 2, 1, views);
        share[i] = threads[i] / processes[i];
    }
    printf("one process, one thread\t%.1f\n", median_of(one, rounds));
    printf("one process, two threads\t%.1f\n", median_of(threads, rounds));
    printf("two processes, one thread each\t%.1f\n", median_of(processes, rounds));
    printf("threads / processes\t%.3f\n", median_of(share, rounds));
    room_walk_free(&walk);
    return close_standard_output();
}
