/* SPDX-License-Identifier: MIT
 *
 * What all truth of a frame of 640 x 480 pixels in the analytic room costs, by one thread, ms of the processor, best and
 * median of several runs: finding it, and writing it as OpenEXR into memory.
 *
 *   truth-speed [RUNS]
 */
#include "modules/sim/io/truth_file.h"
#include "room_stage.h"

#include <string.h>
#include <time.h>

#define RUNS_MOST 101

enum
{
    ROOM = 100 * PIXELS
};

static double position[3][PIXELS];
static float normal[3][PIXELS], next[3][PIXELS], before[3][PIXELS], depth[PIXELS], range[PIXELS];
static uint32_t object[PIXELS], shape[PIXELS], triangle[PIXELS];
static uint8_t flags[PIXELS];
static unsigned char bytes[ROOM];
static size_t place, length;

static size_t write_bytes(void *context, const void *from, size_t count)
{
    (void)context;
    if (count > ROOM - place)
    {
        return 0;
    }
    memcpy(bytes + place, from, count);
    place += count;
    length = place > length ? place : length;
    return count;
}

static void seek_byte(void *context, int64_t to)
{
    (void)context;
    place = (size_t)to;
}

static double milliseconds_since(clock_t begin)
{
    return 1e3 * (double)(clock() - begin) / CLOCKS_PER_SEC;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void tell(const char *what, double *milliseconds, int runs)
{
    qsort(milliseconds, (size_t)runs, sizeof *milliseconds, compare);
    printf("%-24s %8.2f %8.2f\n", what, milliseconds[0], milliseconds[runs / 2]);
}

int main(int argc, char **argv)
{
    const int wanted = argc > 1 ? atoi(argv[1]) : 15;
    const int runs = wanted < 1 ? 1 : wanted > RUNS_MOST ? RUNS_MOST : wanted;
    double found[RUNS_MOST], written[RUNS_MOST];
    char message[CM_IMAGE_MESSAGE];
    room_stage stage = room_stage_make();
    cm_tof_truth truth = {.size = sizeof truth,
                          .object = object,
                          .shape = shape,
                          .triangle = triangle,
                          .depth = depth,
                          .range = range};
    for (int k = 0; k < 3; k++)
    {
        truth.position[k] = position[k];
        truth.normal[k] = normal[k];
        truth.flow_next[k] = next[k];
        truth.flow_before[k] = before[k];
    }
    for (int i = 0; i < runs; i++)
    {
        const cm_image_stream stream = {.write = write_bytes, .seek = seek_byte};
        place = length = 0;
        clock_t begin = clock();
        need(cm_tof_find_truth(stage.scene, stage.camera, stage.trajectory, 0.0, 0.1, -0.1, NULL,
                               &truth));
        found[i] = milliseconds_since(begin);
        begin = clock();
        need(cm_truth_file_write(&stream, WIDTH, HEIGHT, &truth, flags, message));
        written[i] = milliseconds_since(begin);
    }
    tell("all truth, found", found, runs);
    tell("and as OpenEXR", written, runs);
    printf("%.1f MB a frame\n", 1e-6 * (double)length);
    room_stage_free(&stage);
    return 0;
}
