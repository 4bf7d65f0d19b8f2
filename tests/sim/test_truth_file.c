/* SPDX-License-Identifier: MIT
 *
 * Truth in files: what was written is read again, part by part; streams that are full are told.
 */
#define _POSIX_C_SOURCE 200809L /* mkstemp */

#include "modules/sim/io/truth_file.h"
#include "tests/memory_stream.h"
#include "tests/suite.h"

#include <string.h>
#include <unistd.h>

enum
{
    WIDTH = 37,
    HEIGHT = 29,
    PIXELS = WIDTH * HEIGHT,
    ROOM = 200 * PIXELS
};

static double position[3][PIXELS];
static float normal[3][PIXELS], next[3][PIXELS], before[3][PIXELS], depth[PIXELS], range[PIXELS];
static uint32_t object[PIXELS], shape[PIXELS], triangle[PIXELS];
static uint8_t flags[PIXELS];
static unsigned char bytes[ROOM];

static cm_tof_truth all_truth(void)
{
    cm_tof_truth truth = {.size = sizeof truth,
                          .object = object,
                          .shape = shape,
                          .triangle = triangle,
                          .depth = depth,
                          .range = range};
    for (int i = 0; i < PIXELS; i++)
    {
        for (int k = 0; k < 3; k++)
        {
            position[k][i] = i + 0.25 * k;
            normal[k][i] = (float)(1000 * k + i);
            next[k][i] = (float)(2000 * k + i);
            before[k][i] = (float)(3000 * k + i);
        }
        depth[i] = i == 5 ? NAN : (float)(i + 4000);
        range[i] = (float)(i + 5000);
        object[i] = i == 5 ? CM_SCENE_NOTHING : (uint32_t)(i + (1 << 24)); /* no float has it */
        shape[i] = (uint32_t)i % 5;
        triangle[i] = (uint32_t)i * 7;
        flags[i] = (uint8_t)(i % 32);
    }
    for (int k = 0; k < 3; k++)
    {
        truth.position[k] = position[k];
        truth.normal[k] = normal[k];
        truth.flow_next[k] = next[k];
        truth.flow_before[k] = before[k];
    }
    return truth;
}

/* A part by its name, whose channels lie side by side. */
static void read_part(const cm_image_io *io, const char *path, const char *name, cm_pixel_type type,
                      uint32_t channels, void *to)
{
    char message[CM_IMAGE_MESSAGE] = "";
    for (uint32_t part = 0;; part++)
    {
        cm_image_reader *reader = NULL;
        ck_assert_msg(io->open(path, part, &reader, message) == CM_OK, "%s: %s", name, message);
        const cm_image_description *is = io->describe(reader);
        if (strcmp(is->subimage_name, name) == 0)
        {
            const cm_image_region whole = {0, 0, WIDTH, HEIGHT};
            ck_assert_uint_eq(is->width, WIDTH);
            ck_assert_uint_eq(is->height, HEIGHT);
            ck_assert_uint_eq(is->channels, channels);
            ck_assert_int_eq(io->read(reader, &whole, type, to, 0, message), CM_OK);
            io->close(reader);
            return;
        }
        io->close(reader);
    }
}

START_TEST(parts_are_read_as_they_were_written)
{
    static float three[3 * PIXELS], one[PIXELS], five[5 * PIXELS];
    static const unsigned effect[5] = {CM_TOF_FLYING, CM_TOF_MOTION, CM_TOF_MULTIPATH,
                                       CM_TOF_NOTHING, CM_TOF_SATURATED};
    char message[CM_IMAGE_MESSAGE] = "";
    char path[] = "/tmp/truth-XXXXXX";
    memory_stream memory = {.bytes = bytes, .room = sizeof bytes};
    const cm_image_stream stream = stream_of(&memory);
    const cm_tof_truth truth = all_truth();
    const cm_status status = cm_truth_file_write(&stream, WIDTH, HEIGHT, &truth, flags, message);
    if (status == CM_ERROR_UNSUPPORTED)
    {
        return;
    }
    ck_assert_msg(status == CM_OK, "%s", message);
    const int file = mkstemp(path);
    ck_assert_int_ge(file, 0);
    ck_assert_int_eq(write(file, bytes, memory.size), (ssize_t)memory.size);
    close(file);
    const cm_image_io *io = cm_image_io_get(message);
    ck_assert_msg(io != NULL, "%s", message);
    read_part(io, path, "position", CM_PIXEL_FLOAT, 3, three);
    ck_assert(three[3 * 100 + 1] == 100.25f && three[3 * (PIXELS - 1)] == PIXELS - 1);
    read_part(io, path, "normal", CM_PIXEL_FLOAT, 3, three);
    ck_assert(three[3 * 100 + 2] == 2100.0f);
    read_part(io, path, "flow_next", CM_PIXEL_FLOAT, 3, three);
    ck_assert(three[3 * 100 + 1] == 2100.0f);
    read_part(io, path, "flow_before", CM_PIXEL_FLOAT, 3, three);
    ck_assert(three[3 * 100 + 2] == 6100.0f);
    read_part(io, path, "depth", CM_PIXEL_FLOAT, 1, one);
    ck_assert(isnan(one[5]) && one[6] == 4006.0f);
    read_part(io, path, "range", CM_PIXEL_FLOAT, 1, one);
    ck_assert_mem_eq(one, range, sizeof one);
    read_part(io, path, "effects", CM_PIXEL_FLOAT, 5, five);
    for (int i = 0; i < 5 * PIXELS; i++)
    {
        ck_assert((five[i] == 1.0f) == ((flags[i / 5] & effect[i % 5]) != 0));
    }
    unlink(path);
}
END_TEST

/* Whole numbers stand in the file as they are, packed or not: of a part without packing they are found in its bytes. */
START_TEST(whole_numbers_keep_all_bits)
{
    static uint32_t apart[PIXELS];
    char message[CM_IMAGE_MESSAGE] = "";
    memory_stream memory = {.bytes = bytes, .room = sizeof bytes};
    const cm_image_stream stream = stream_of(&memory);
    cm_tof_truth truth = {.size = sizeof truth, .object = apart};
    uint32_t random = 1;
    for (int i = 0; i < PIXELS; i++)
    {
        apart[i] = random = random * 1664525u + 1013904223u; /* nothing to pack */
    }
    const cm_status status = cm_truth_file_write(&stream, WIDTH, HEIGHT, &truth, NULL, message);
    if (status == CM_ERROR_UNSUPPORTED)
    {
        return;
    }
    ck_assert_msg(status == CM_OK, "%s", message);
    int found = 0;
    for (size_t at = 0; at + sizeof(uint32_t) * WIDTH <= memory.size; at++)
    {
        found |= memcmp(bytes + at, apart + (size_t)11 * WIDTH, sizeof(uint32_t) * WIDTH) == 0;
    }
    ck_assert(found);
}
END_TEST

START_TEST(full_streams_and_bad_arguments_are_told)
{
    char message[CM_IMAGE_MESSAGE] = "";
    memory_stream memory = {.bytes = bytes, .room = 3000};
    const cm_image_stream stream = stream_of(&memory);
    cm_tof_truth truth = all_truth();
    const cm_status status = cm_truth_file_write(&stream, WIDTH, HEIGHT, &truth, flags, message);
    ck_assert(status == CM_ERROR_FILE || status == CM_ERROR_UNSUPPORTED);
    ck_assert(message[0] != '\0' && strchr(message, '\n') == NULL);
    ck_assert_int_eq(cm_truth_file_write(NULL, WIDTH, HEIGHT, &truth, flags, NULL),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_truth_file_write(&stream, 0, HEIGHT, &truth, flags, message),
                     CM_ERROR_ARGUMENT);
    truth.size = 1;
    ck_assert_int_eq(cm_truth_file_write(&stream, WIDTH, HEIGHT, &truth, flags, message),
                     CM_ERROR_ARGUMENT);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {parts_are_read_as_they_were_written, whole_numbers_keep_all_bits,
                                  full_streams_and_bad_arguments_are_told, NULL};
    return run_suite("truth file", tests);
}
