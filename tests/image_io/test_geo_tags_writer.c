/* SPDX-License-Identifier: MIT
 *
 * Tags that are written into TIFF files of both orders of bytes and both sizes of offsets are those that the reader finds,
 * and nothing else changes.
 */
#include "modules/image/io/geo_tags.h"

#include "tests/memory_stream.h"
#include "small_files.h"
#include "tests/suite.h"

#include <stdio.h>
#include <unistd.h>

enum
{
    ROOM = 1 << 16
};

static const double scale[3] = {0.5, 0.25, 0};
static const double tie[6] = {0, 0, 0, -10.5, 70.25, 0};
static const uint16_t keys[8] = {1, 1, 0, 1, 1024, 0, 1, 2};
static const cm_image_geo_tags geo = {.scale = scale,
                                      .scale_count = 3,
                                      .tie_points = tie,
                                      .tie_point_count = 6,
                                      .keys = keys,
                                      .key_count = 8};

static unsigned char bytes[ROOM];
static char message[CM_IMAGE_MESSAGE];

static memory_stream content_of(const char *path)
{
    FILE *const file = fopen(path, "rb");
    ck_assert_ptr_nonnull(file);
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    return (memory_stream){bytes, size, ROOM, 0};
}

static void write_content(const char *path, const memory_stream *memory)
{
    FILE *const file = fopen(path, "wb");
    ck_assert_ptr_nonnull(file);
    ck_assert_uint_eq(fwrite(memory->bytes, 1, memory->size, file), memory->size);
    ck_assert_int_eq(fclose(file), 0);
}

/* Pixel i of page p is 16 p + i. */
static void check_picture(const cm_image_io *io, uint32_t page, bool placed)
{
    cm_image_reader *reader = NULL;
    ck_assert_int_eq(io->open("written.tif", page, &reader, message), CM_OK);
    const cm_image_region all = {0, 0, SMALL_WIDTH, SMALL_HEIGHT};
    unsigned char pixels[SMALL_WIDTH * SMALL_HEIGHT];
    ck_assert_int_eq(io->read(reader, &all, CM_PIXEL_U8, pixels, 0, message), CM_OK);
    for (uint32_t i = 0; i < SMALL_WIDTH * SMALL_HEIGHT; i++)
    {
        ck_assert_uint_eq(pixels[i], 16 * page + i);
    }
    const cm_image_geo_tags *const found = io->describe(reader)->geo_tags;
    ck_assert_int_eq(found != NULL && found->scale_count == 3, placed);
    if (placed)
    {
        ck_assert_uint_eq(found->tie_point_count, 6);
        ck_assert_uint_eq(found->key_count, 8);
        REQUIRE(memcmp(found->scale, scale, sizeof scale) == 0, "scale");
        REQUIRE(memcmp(found->tie_points, tie, sizeof tie) == 0, "tie points");
        REQUIRE(memcmp(found->keys, keys, sizeof keys) == 0, "keys");
    }
    io->close(reader);
}

START_TEST(test_kinds)
{
    const cm_image_io *const io = cm_image_io_get(message);
    for (int kind = 0; kind < 8; kind++)
    {
        const bool had = kind > 3;
        const small_tiff what = {.big_endian = kind % 2 == 1,
                                 .big_tiff = kind / 2 % 2 == 1,
                                 .pages = 2,
                                 .geo_tags = had,
                                 .cut = 0};
        ck_assert(write_small_tiff("plain.tif", &what));
        memory_stream memory = content_of("plain.tif");
        const cm_image_stream stream = stream_of(&memory);
        ck_assert_int_eq(cm_geo_tags_write(&stream, &geo, message), CM_OK);
        write_content("written.tif", &memory);
        check_picture(io, 0, true);
        if (!had)
        {
            check_picture(io, 1, false);
        }
    }
    unlink("plain.tif");
    unlink("written.tif");
}
END_TEST

START_TEST(test_failures)
{
    const small_tiff what = {
        .big_endian = false, .big_tiff = false, .pages = 1, .geo_tags = false, .cut = 0};
    ck_assert(write_small_tiff("plain.tif", &what));
    memory_stream memory = content_of("plain.tif");
    const cm_image_stream stream = stream_of(&memory);
    const cm_image_geo_tags nothing = {0};
    ck_assert_int_eq(cm_geo_tags_write(&stream, &nothing, message), CM_ERROR_ARGUMENT);
    const size_t size = memory.size;
    for (size_t room = size; room < size + 100; room += 7)
    {
        memory = content_of("plain.tif");
        memory.room = room;
        ck_assert_int_eq(cm_geo_tags_write(&stream, &geo, message), CM_ERROR_UNSUPPORTED);
        REQUIRE(strstr(message, "cannot be placed") != NULL, "%s", message);
    }
    for (size_t cut = 0; cut < 12; cut++)
    {
        memory = content_of("plain.tif");
        memory.size = cut;
        ck_assert_int_eq(cm_geo_tags_write(&stream, &geo, message), CM_ERROR_UNSUPPORTED);
    }
    memory = content_of("plain.tif");
    memory.bytes[7] = 0x7f; /* the directory is beyond the file */
    ck_assert_int_eq(cm_geo_tags_write(&stream, &geo, message), CM_ERROR_UNSUPPORTED);
    unlink("plain.tif");
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {test_kinds, test_failures, NULL};
    return run_suite("geo tags writer", tests);
}
