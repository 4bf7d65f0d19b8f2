/* SPDX-License-Identifier: MIT
 *
 * Writing image files by the table of functions: what cannot be written is refused, strides, and streams, which have the
 * same bytes as files.
 */
#define _POSIX_C_SOURCE 200809L

#include "io_pictures.h"

#include <ctype.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---------------------------------------------------------------- what cannot be written */

static void refuses(const cm_image_description *description, const char *path, const char *words,
                    const char *what)
{
    cm_image_writer *writer = NULL;
    const cm_status status = io->create(path, NULL, description, &writer, message);
    REQUIRE(status != CM_OK && writer == NULL, "%s is written", what);
    REQUIRE(strstr(message, words) != NULL, "%s: '%s'", what, message);
    expect_line(what);
    unlink("refused");
}

START_TEST(test_wrong_descriptions)
{
    const cm_image_description good = describe("png", CM_PIXEL_U8, 3);
    cm_image_description wrong = good;
    wrong.format = "nonesuch";
    refuses(&wrong, "refused", "cannot be written", "format");
    wrong = good;
    wrong.width = 0;
    refuses(&wrong, "refused", "no picture has", "width");
    wrong = good;
    wrong.height = UINT32_MAX;
    refuses(&wrong, "refused", "no picture has", "height");
    wrong = good;
    wrong.alpha = 3;
    refuses(&wrong, "refused", "no picture has", "alpha");
    wrong = good;
    wrong.tile_width = 16;
    refuses(&wrong, "refused", "no picture has", "tiles without height");
    wrong.tile_height = 16;
    refuses(&wrong, "refused", "png has no tiles", "tiles");
    wrong = good;
    wrong.type = (cm_pixel_type)9;
    refuses(&wrong, "refused", "no such type", "type");
    wrong = good;
    wrong.stored_type = "float[3]";
    refuses(&wrong, "refused", "no such type", "type of the file");
    const cm_image_tag tag = {"key", "", "int", "123", 3};
    wrong = good;
    wrong.tags = &tag;
    wrong.tag_count = 1;
    refuses(&wrong, "refused", "the tag key is not of its type, int", "tag");
    refuses(&good, "no/such/folder", "cannot be written", "folder");
}
END_TEST

START_TEST(test_wrong_rows)
{
    static pixels any;
    fill(&any, CM_PIXEL_U8, 3);
    for (uint32_t tile = 0; tile <= 16; tile += 16)
    {
        cm_image_description description = describe("tiff", CM_PIXEL_U8, 3);
        description.tile_width = description.tile_height = tile;
        cm_image_writer *writer = NULL;
        expect_good(io->create("rows.tif", NULL, &description, &writer, message), "rows");
        expect_failure(io->write(writer, 1, 2, CM_PIXEL_U8, any.bytes, 0, 0, message),
                       CM_ERROR_ARGUMENT, "in order", "begin");
        expect_failure(io->write(writer, 0, 0, CM_PIXEL_U8, any.bytes, 0, 0, message),
                       CM_ERROR_ARGUMENT, "in order", "no rows");
        expect_failure(io->write(writer, 0, HEIGHT + 1, CM_PIXEL_U8, any.bytes, 0, 0, message),
                       CM_ERROR_ARGUMENT, "in order", "end");
        expect_failure(io->write(writer, 0, 1, (cm_pixel_type)4, any.bytes, 0, 0, message),
                       CM_ERROR_ARGUMENT, "no such type", "type");
        expect_good(io->write(writer, 0, 5, CM_PIXEL_U8, any.bytes, 0, 0, message), "rows");
        expect_failure(io->write(writer, 0, 5, CM_PIXEL_U8, any.bytes, 0, 0, message),
                       CM_ERROR_ARGUMENT, "in order", "again");
        expect_failure(io->finish(writer, message), CM_ERROR_ARGUMENT, "rows are missing", "end");
        io->drop(writer);
        unlink("rows.tif");
    }
    io->drop(NULL);
}
END_TEST

/* Strides: every second pixel of every second row, of four channels the first three. */
START_TEST(test_strides)
{
    static float wide[2 * HEIGHT][2 * WIDTH][4];
    static float read[HEIGHT][WIDTH][3];
    for (size_t i = 0; i < sizeof wide / sizeof(float); i++)
    {
        wide[i / (2 * WIDTH * 4)][i / 4 % (2 * WIDTH)][i % 4] = (float)i;
    }
    for (uint32_t tile = 0; tile <= 16; tile += 16)
    {
        cm_image_description description = describe("openexr", CM_PIXEL_FLOAT, 3);
        description.tile_width = description.tile_height = tile;
        cm_image_writer *writer = NULL;
        expect_good(io->create("strides.exr", NULL, &description, &writer, message), "strides");
        for (uint32_t y = 0; y < HEIGHT; y += 12)
        {
            const uint32_t end = y + 12 < HEIGHT ? y + 12 : HEIGHT;
            expect_good(io->write(writer, y, end, CM_PIXEL_FLOAT, wide[2 * y], 8 * sizeof(float),
                                  2 * (ptrdiff_t)sizeof wide[0], message),
                        "strides");
        }
        expect_good(io->finish(writer, message), "strides");
        io->drop(writer);
        cm_image_reader *reader = open_picture("strides.exr");
        read_all(reader, CM_PIXEL_FLOAT, read, "strides");
        io->close(reader);
        for (size_t y = 0; y < HEIGHT; y++)
        {
            for (size_t x = 0; x < WIDTH; x++)
            {
                REQUIRE(memcmp(read[y][x], wide[2 * y][2 * x], sizeof read[y][x]) == 0, "%zu %zu",
                        x, y);
            }
        }
    }
    unlink("strides.exr");
}
END_TEST

/* ---------------------------------------------------------------- streams */

static size_t stream_read(void *context, void *bytes, size_t count)
{
    return fread(bytes, 1, count, context);
}

static size_t stream_write(void *context, const void *bytes, size_t count)
{
    return fwrite(bytes, 1, count, context);
}

static void stream_seek(void *context, int64_t position)
{
    (void)fseek(context, (long)position, SEEK_SET);
}

static size_t stream_size(void *context)
{
    struct stat status;
    fflush(context);
    return fstat(fileno(context), &status) == 0 ? (size_t)status.st_size : 0;
}

/* TIFF and OpenEXR have the day and the time of writing in their heads, "2026:01:31 23:59:59". */
static int differ_by_time(const unsigned char *one, const unsigned char *other, size_t size)
{
    enum
    {
        TIME_LENGTH = 19
    };
    size_t first = size;
    for (size_t i = 0; i < size; i++)
    {
        if (one[i] == other[i])
        {
            continue;
        }
        first = i < first ? i : first;
        if (!isdigit(one[i]) || !isdigit(other[i]) || i - first >= TIME_LENGTH)
        {
            return 0;
        }
    }
    return 1;
}

/* The same bytes as by name. */
static void check_stream(const char *format, cm_pixel_type type)
{
    static pixels any;
    fill(&any, type, 3);
    const cm_image_description description = describe(format, type, 3);
    write_picture("by-name", &description, &any);
    FILE *file = fopen("streamed", "w+b");
    const cm_image_stream stream = {file, stream_read, stream_write, stream_seek, stream_size};
    cm_image_writer *writer = NULL;
    expect_good(io->create("streamed", &stream, &description, &writer, message), format);
    expect_good(io->write(writer, 0, HEIGHT, type, any.bytes, 0, 0, message), format);
    expect_good(io->finish(writer, message), format);
    io->drop(writer);
    fclose(file);
    size_t size = 0;
    size_t named_size = 0;
    unsigned char *streamed = content_of("streamed", &size);
    unsigned char *named = content_of("by-name", &named_size);
    REQUIRE(size == named_size, "%s: %zu bytes, by name %zu", format, size, named_size);
    REQUIRE(differ_by_time(streamed, named, size), "%s is not the same by name", format);
    free(streamed);
    free(named);
    unlink("streamed");
    unlink("by-name");
}

START_TEST(test_streams)
{
    check_stream("png", CM_PIXEL_U8);
    check_stream("jpeg", CM_PIXEL_U8);
    check_stream("openexr", CM_PIXEL_HALF);
    check_stream("tiff", CM_PIXEL_U8); /* which takes the name all the same */
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {test_wrong_descriptions, test_wrong_rows, test_strides,
                                  test_streams, NULL};
    return run_in_folder("image writers", tests);
}
