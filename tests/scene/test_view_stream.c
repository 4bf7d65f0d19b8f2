/* SPDX-License-Identifier: MIT
 *
 * Views through a stream: the same at its other end, and what is cut or damaged is told.
 */
#define _POSIX_C_SOURCE 200809L

#include "modules/scene/io/check_sum.h"
#include "modules/scene/io/view_stream.h"

#include "tests/memory_stream.h"
#include "tests/suite.h"
#include "written_files.h"

enum
{
    WIDTH = 6,
    HEIGHT = 4,
    VIEWS = 3,
    ROOM = 8192
};

static char message[CM_IMAGE_MESSAGE];
static uint16_t whole[WIDTH * HEIGHT];
static float real[WIDTH * HEIGHT];
static unsigned char color[WIDTH * HEIGHT * 3];

static cm_camera *make_camera(void)
{
    const cm_camera_options options = {.size = sizeof options,
                                       .width = WIDTH,
                                       .height = HEIGHT,
                                       .fx = 5,
                                       .fy = 5,
                                       .cx = 2.5,
                                       .cy = 1.5};
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(&options, &camera), CM_OK);
    return camera;
}

static cm_view make_view(const cm_camera *camera, unsigned k)
{
    for (unsigned i = 0; i < WIDTH * HEIGHT; i++)
    {
        whole[i] = (uint16_t)(i * 1000 + k);
        real[i] = i == 3 ? NAN : (float)i / 3.0f;
        color[3 * i] = color[3 * i + 1] = color[3 * i + 2] = (unsigned char)(i + k);
    }
    const cm_image depth = {.size = sizeof depth,
                            .data = k % 2 ? (void *)real : (void *)whole,
                            .type = k % 2 ? CM_PIXEL_FLOAT : CM_PIXEL_U16,
                            .width = WIDTH,
                            .height = HEIGHT,
                            .channels = 1};
    cm_view view = {.size = sizeof view,
                    .time = 1.5 * k,
                    .camera = camera,
                    .depth = depth,
                    .depth_is_range = (int)(k % 2),
                    .depth_unit = 0.001};
    ck_assert_int_eq(cm_rotation_from_angles(10.0 * k, 5, 3, &view.pose.rotation), CM_OK);
    view.pose.position[1] = k;
    if (k > 0)
    {
        /* upside down, so that strides count */
        view.color = (cm_image){.size = sizeof view.color,
                                .data = color + (HEIGHT - 1) * WIDTH * 3,
                                .type = CM_PIXEL_U8,
                                .width = WIDTH,
                                .height = HEIGHT,
                                .channels = 3,
                                .row_stride = -WIDTH * 3};
    }
    return view;
}

/* So many of the views that make_view makes; with times, all like the first but at those. */
static size_t write_views(unsigned char *bytes, size_t count, const double *time)
{
    cm_camera *camera = make_camera();
    memory_stream memory = {bytes, 0, ROOM, 0};
    const cm_image_stream stream = stream_of(&memory);
    cm_view_writer *writer = NULL;
    REQUIRE(cm_view_writer_create("out", &stream, camera, 1000.0, &writer, message) == CM_OK, "%s",
            message);
    for (size_t i = 0; i < count; i++)
    {
        cm_view view = make_view(camera, time == NULL ? (unsigned)i : 0);
        view.time = time == NULL ? view.time : time[i];
        REQUIRE(cm_view_writer_put(writer, &view, message) == CM_OK, "%s", message);
    }
    REQUIRE(cm_view_writer_finish(writer, message) == CM_OK, "%s", message);
    cm_view_writer_destroy(writer);
    cm_camera_destroy(camera);
    return memory.size;
}

static size_t write_stream(unsigned char *bytes)
{
    return write_views(bytes, VIEWS, NULL);
}

/* How many views are read before the status that is not CM_OK. */
static unsigned read_stream(unsigned char *bytes, size_t size, cm_status *status)
{
    memory_stream memory = {bytes, size, size, 0};
    const cm_image_stream stream = stream_of(&memory);
    cm_view_reader *reader = NULL;
    const cm_view *view = NULL;
    unsigned count = 0;
    message[0] = '\0';
    *status = cm_view_reader_create("in", &stream, &reader, message);
    while (*status == CM_OK && (*status = cm_view_reader_next(reader, &view, message)) == CM_OK)
    {
        count++;
    }
    REQUIRE(strncmp(message, "in: ", 4) == 0, "%s", message);
    cm_view_reader_destroy(reader);
    return count;
}

START_TEST(views_come_through)
{
    unsigned char bytes[ROOM];
    memory_stream memory = {bytes, write_stream(bytes), ROOM, 0};
    const cm_image_stream stream = stream_of(&memory);
    cm_view_reader *reader = NULL;
    REQUIRE(cm_view_reader_create("in", &stream, &reader, message) == CM_OK, "%s", message);
    double scale = 0.0;
    const cm_camera *camera = cm_view_reader_camera(reader, &scale);
    REQUIRE(cm_camera_describe(camera)->cx == 2.5 && scale == 1000.0, "another camera");
    for (unsigned k = 0; k < VIEWS; k++)
    {
        const cm_view *view = NULL;
        REQUIRE(cm_view_reader_next(reader, &view, message) == CM_OK, "%s", message);
        const cm_view wanted = make_view(camera, k);
        REQUIRE(view->time == wanted.time && view->camera == camera &&
                    memcmp(&view->pose, &wanted.pose, sizeof wanted.pose) == 0 &&
                    view->depth_unit == 0.001 && view->depth_is_range == wanted.depth_is_range &&
                    memcmp(view->depth.data, wanted.depth.data,
                           WIDTH * HEIGHT * cm_pixel_size(wanted.depth.type)) == 0,
                "view %u", k);
        REQUIRE((view->color.data == NULL) == (k == 0) && view->amplitude.data == NULL, "view %u",
                k);
        REQUIRE(k == 0 ||
                    memcmp(view->color.data, color + (HEIGHT - 1) * WIDTH * 3, WIDTH * 3) == 0,
                "view %u", k);
    }
    const cm_view *view = NULL;
    ck_assert_int_eq(cm_view_reader_next(reader, &view, message), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_view_reader_next(reader, &view, message), CM_ERROR_RANGE);
    cm_view_reader_destroy(reader);
}
END_TEST

START_TEST(cut_streams_are_told_from_whole_ones)
{
    unsigned char bytes[ROOM];
    const size_t size = write_stream(bytes);
    cm_status status;
    for (size_t i = 0; i < size; i++)
    {
        read_stream(bytes, i, &status);
        REQUIRE(status == CM_ERROR_DATA, "%zu of %zu bytes: %d", i, size, (int)status);
    }
    ck_assert_uint_eq(read_stream(bytes, size, &status), VIEWS);
    ck_assert_int_eq(status, CM_ERROR_RANGE);
}
END_TEST

START_TEST(damage_of_any_byte_is_told)
{
    unsigned char bytes[ROOM];
    const size_t size = write_stream(bytes);
    cm_status status;
    for (size_t i = 0; i < size; i++)
    {
        bytes[i] ^= 0x41;
        read_stream(bytes, size, &status);
        REQUIRE(status == CM_ERROR_DATA || (i == 7 && status == CM_ERROR_VERSION), "byte %zu: %d",
                i, (int)status);
        bytes[i] ^= 0x41;
    }
}
END_TEST

START_TEST(views_that_are_none_are_refused)
{
    unsigned char bytes[ROOM];
    cm_camera *camera = make_camera();
    memory_stream memory = {bytes, 0, ROOM, 0};
    const cm_image_stream stream = stream_of(&memory);
    cm_view_writer *writer = NULL;
    REQUIRE(cm_view_writer_create("out", &stream, camera, 1000.0, &writer, message) == CM_OK, "%s",
            message);
    const size_t before = memory.size;
    cm_view bad[7];
    for (size_t i = 0; i < 7; i++)
    {
        bad[i] = make_view(camera, 1);
    }
    bad[0].time = NAN;
    bad[1].depth_unit = 0.0;
    bad[2].pose.position[0] = NAN;
    bad[3].pose.rotation.row[0][0] = 3.0;
    bad[4].depth.width = WIDTH + 1;
    bad[5].color.height = 1;
    bad[6].depth.type = CM_PIXEL_U8;
    for (size_t i = 0; i < 7; i++)
    {
        ck_assert_int_eq(cm_view_writer_put(writer, &bad[i], message), CM_ERROR_CAMERA);
    }
    REQUIRE(memory.size == before, "something was written");
    cm_view_writer_destroy(writer);
    ck_assert_int_eq(cm_view_writer_create("out", &stream, camera, 0.0, &writer, message),
                     CM_ERROR_CAMERA);
    cm_camera_destroy(camera);
}
END_TEST

START_TEST(views_come_in_time)
{
    static const double times[][3] = {{1, 2, 2}, {1, 2, 1.5}, {-1, 0, -0.0}};
    unsigned char bytes[ROOM];
    cm_status status;
    for (size_t i = 0; i < sizeof times / sizeof *times; i++)
    {
        const size_t size = write_views(bytes, 3, times[i]);
        ck_assert_uint_eq(read_stream(bytes, size, &status), 2);
        REQUIRE(status == CM_ERROR_DATA &&
                    strcmp(message, "in: view 2: its time is not after the one before") == 0,
                "%d %s", (int)status, message);
    }
    ck_assert_uint_eq(read_stream(bytes, write_views(bytes, 2, times[0]), &status), 2);
    ck_assert_int_eq(status, CM_ERROR_RANGE);
}
END_TEST

/* What a later version may say there is not passed over, though the sums are right. */
START_TEST(words_that_are_unknown_are_told)
{
    static const size_t places[] = {120, 124, 176};
    const double times[] = {1};
    unsigned char bytes[ROOM];
    cm_status status;
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
    {
        const size_t size = write_views(bytes, 1, times);
        unsigned char *head = bytes + size - 24 - WIDTH * HEIGHT * sizeof *whole - 192;
        ck_assert(memcmp(head, "VIEW", 4) == 0);
        head[places[i]] = 2;
        const uint64_t sum = cm_check_sum(CM_CHECK_SUM_BEGIN, head, 184);
        for (int k = 0; k < 8; k++)
        {
            head[184 + k] = (unsigned char)(sum >> (8 * k));
        }
        ck_assert_uint_eq(read_stream(bytes, size, &status), 0);
        REQUIRE(status == CM_ERROR_DATA && strstr(message, "in its head") != NULL, "%d %s",
                (int)status, message);
    }
}
END_TEST

/* Streams put one behind the other are not taken for the first of them. */
START_TEST(bytes_behind_the_end_are_told)
{
    unsigned char bytes[2 * ROOM] = {0};
    cm_status status;
    const size_t size = write_stream(bytes);
    ck_assert_uint_eq(write_stream(bytes + size), size);
    const size_t more[] = {1, 8, 24, size};
    for (size_t i = 0; i < sizeof more / sizeof *more; i++)
    {
        ck_assert_uint_eq(read_stream(bytes, size + more[i], &status), VIEWS);
        REQUIRE(status == CM_ERROR_DATA &&
                    strcmp(message, "in: bytes follow the end of the stream, after 3 views; one "
                                    "stream is read") == 0,
                "%zu more: %d %s", more[i], (int)status, message);
    }
    static const double none[1] = {0};
    const size_t empty = write_views(bytes, 0, none);
    bytes[empty] = '\n';
    ck_assert_uint_eq(read_stream(bytes, empty, &status), 0);
    ck_assert_int_eq(status, CM_ERROR_RANGE);
    ck_assert_uint_eq(read_stream(bytes, empty + 1, &status), 0);
    ck_assert_int_eq(status, CM_ERROR_DATA);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {views_come_through,
                                  cut_streams_are_told_from_whole_ones,
                                  damage_of_any_byte_is_told,
                                  views_that_are_none_are_refused,
                                  views_come_in_time,
                                  words_that_are_unknown_are_told,
                                  bytes_behind_the_end_are_told,
                                  NULL};
    return run_suite("view stream", tests);
}
