/* SPDX-License-Identifier: MIT
 *
 * Writing image files by the table of functions: what cannot be written is refused, strides, and streams, which have the
 * same bytes as files.
 */
#define _POSIX_C_SOURCE 200809L

#include "io_pictures.h"
#include "modules/image/io/header_lines.h"

#include <ctype.h>
#include <math.h>
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

/* ---------------------------------------------------------------- Radiance */

/* What its pixels cannot be: one exponent for three numbers, none of them below 0. */
START_TEST(test_light)
{
    static float written[HEIGHT][WIDTH][3];
    static float read[HEIGHT][WIDTH][3];
    const float most = 0x1.fep126f;
    const float values[][2] = {{-0.01f, 0.0f}, {-3e38f, 0.0f},   {-INFINITY, 0.0f}, {NAN, 0.0f},
                               {3e38f, most},  {INFINITY, most}, {most, most},      {0.5f, 0.5f}};
    const size_t count = sizeof values / sizeof *values;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++)
    {
        written[i / WIDTH][i % WIDTH][i % 3] = values[i % count][0];
    }
    const cm_image_description description = describe("hdr", CM_PIXEL_FLOAT, 3);
    cm_image_writer *writer = NULL;
    expect_good(io->create("light.hdr", NULL, &description, &writer, message), "light");
    expect_good(io->write(writer, 0, HEIGHT, CM_PIXEL_FLOAT, written, 0, 0, message), "light");
    expect_good(io->finish(writer, message), "light");
    io->drop(writer);
    cm_image_reader *reader = open_picture("light.hdr");
    read_all(reader, CM_PIXEL_FLOAT, read, "light");
    io->close(reader);
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++)
    {
        const float *const pixel = read[i / WIDTH][i % WIDTH];
        const double wanted = (double)values[i % count][1];
        REQUIRE(fabs((double)pixel[i % 3] - wanted) <= 0.004 * wanted && pixel[(i + 1) % 3] == 0 &&
                    pixel[(i + 2) % 3] == 0,
                "%g for %g", (double)pixel[i % 3], (double)values[i % count][0]);
    }
    unlink("light.hdr");
}
END_TEST

/* Our tags are lines behind the first one, of a stream, and all else is as it was. */
START_TEST(test_header_lines)
{
    static pixels any;
    fill(&any, CM_PIXEL_FLOAT, 3);
    char long_text[CM_HEADER_LINES_SIZE];
    memset(long_text, 'x', sizeof long_text - 1);
    long_text[sizeof long_text - 1] = '\0';
    const cm_image_tag tags[] = {{"Artist", "Anna", NULL, NULL, 0},
                                 {"cubemap:surface", "cube:qsc", NULL, NULL, 0},
                                 {"cubemap:more", long_text, NULL, NULL, 0},
                                 {"cubemap:lines", "two\nlines", NULL, NULL, 0},
                                 {"cubemap:rotation", "1,2,3", NULL, NULL, 0}};
    static const char lines[] = "# cubemap:surface=cube:qsc\n# cubemap:rotation=1,2,3\n";
    cm_image_description description = describe("hdr", CM_PIXEL_FLOAT, 3);
    write_picture("plain", &description, &any);
    description.tags = tags;
    description.tag_count = sizeof tags / sizeof *tags;
    FILE *file = fopen("tagged", "w+b");
    const cm_image_stream stream = {file, stream_read, stream_write, stream_seek, stream_size};
    cm_image_writer *writer = NULL;
    expect_good(io->create("tagged", &stream, &description, &writer, message), "tagged");
    expect_good(io->write(writer, 0, HEIGHT, CM_PIXEL_FLOAT, any.bytes, 0, 0, message), "tagged");
    expect_good(io->finish(writer, message), "tagged");
    io->drop(writer);
    fclose(file);
    size_t size = 0;
    size_t plain_size = 0;
    unsigned char *tagged = content_of("tagged", &size);
    unsigned char *plain = content_of("plain", &plain_size);
    const size_t first = strlen("#?RADIANCE\n");
    const size_t added = sizeof lines - 1;
    REQUIRE(size == plain_size + added, "%zu bytes, without tags %zu", size, plain_size);
    REQUIRE(memcmp(tagged, plain, first) == 0 && memcmp(tagged + first, lines, added) == 0 &&
                memcmp(tagged + first + added, plain + first, plain_size - first) == 0,
            "not the lines alone");
    free(tagged);
    free(plain);
    cm_image_reader *reader = open_picture("tagged");
    const cm_image_description *const read = io->describe(reader);
    REQUIRE(read->tag_count >= 2, "%zu tags", read->tag_count);
    const cm_image_tag *const last = read->tags + read->tag_count - 2;
    ck_assert_str_eq(last[0].key, "cubemap:surface");
    ck_assert_str_eq(last[0].text, "cube:qsc");
    ck_assert_str_eq(last[1].key, "cubemap:rotation");
    ck_assert_str_eq(last[1].text, "1,2,3");
    io->close(reader);
    unlink("tagged");
    unlink("plain");
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {test_wrong_descriptions,
                                  test_wrong_rows,
                                  test_strides,
                                  test_streams,
                                  test_light,
                                  test_header_lines,
                                  NULL};
    return run_in_folder("image writers", tests);
}
