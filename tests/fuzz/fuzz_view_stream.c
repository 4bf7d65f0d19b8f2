/* SPDX-License-Identifier: MIT
 *
 * Views through a stream. Sums are made right when the first byte is odd, so that what they cover is fuzzed, too. What is
 * wrong is said in one line; what is read is the same after it was written.
 */
#include "modules/scene/io/check_sum.h"
#include "modules/scene/io/view_stream.h"

#include "modules/image/io/file_words.h"
#include "tests/memory_stream.h"

#include "fuzz.h"

enum
{
    ROOM = 1 << 16
};

static void mend(unsigned char *bytes, size_t from, size_t count, size_t to, size_t size)
{
    if (from <= size && count <= size - from && to + 8 <= size)
    {
        cm_file_put_u64(bytes + to, cm_check_sum(CM_CHECK_SUM_BEGIN, bytes + from, count));
    }
}

static void mend_all(unsigned char *bytes, size_t size)
{
    if (size < 24)
    {
        return;
    }
    const size_t text = cm_file_u32(bytes + 8);
    mend(bytes, 24, text, 16, size);
    for (size_t at = text < size ? 24 + text : size; at + 192 <= size;)
    {
        const uint64_t count = cm_file_u64(bytes + at + 160);
        mend(bytes, at + 192, count < size ? (size_t)count : size, at + 168, size);
        mend(bytes, at, 184, at + 184, size);
        at += 192 + (count < size ? (size_t)count : size);
    }
}

static void write_again(const cm_view *view, double scale)
{
    static unsigned char room[ROOM * 2];
    memory_stream memory = {room, 0, sizeof room, 0};
    const cm_image_stream stream = stream_of(&memory);
    char message[CM_IMAGE_MESSAGE] = "";
    cm_view_writer *writer = NULL;
    if (cm_view_writer_create("file", &stream, view->camera, scale, &writer, message) == CM_OK)
    {
        EXPECT(cm_view_writer_put(writer, view, message) == CM_OK, "%s", message);
        EXPECT(cm_view_writer_finish(writer, message) == CM_OK, "%s", message);
        cm_view_writer_destroy(writer);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static unsigned char bytes[ROOM];
    if (size == 0 || size > ROOM)
    {
        return 0;
    }
    memcpy(bytes, data + 1, size - 1);
    if (data[0] % 2 == 1)
    {
        mend_all(bytes, size - 1);
    }
    memory_stream memory = {bytes, size - 1, size - 1, 0};
    const cm_image_stream stream = stream_of(&memory);
    char message[CM_IMAGE_MESSAGE] = "";
    cm_view_reader *reader = NULL;
    const cm_view *view = NULL;
    cm_status status = cm_view_reader_create("file", &stream, &reader, message);
    while (status == CM_OK && (status = cm_view_reader_next(reader, &view, message)) == CM_OK)
    {
        double scale = 0.0;
        EXPECT(cm_view_reader_camera(reader, &scale) == view->camera, "another camera");
        write_again(view, scale);
    }
    EXPECT(strncmp(message, "file:", 5) == 0 && is_one_line(message), "%d: %s", (int)status,
           message);
    cm_view_reader_destroy(reader);
    return 0;
}
