/* SPDX-License-Identifier: MIT
 *
 * OpenEXR files of several pictures with names: each is read again as it was written, and what cannot be such a file is
 * refused.
 */
#define _POSIX_C_SOURCE 200809L

#include "io_pictures.h"

#include <unistd.h>

enum
{
    CHANNELS = 3,
    PARTS = 3,
    VALUES = WIDTH * HEIGHT * CHANNELS
};

static const char *const names[PARTS] = {"+x", "left one", "bottom"};
static const char *const path = "parts.exr";

static cm_image_description describe_parts(uint32_t tile)
{
    cm_image_description description = describe("openexr", CM_PIXEL_FLOAT, CHANNELS);
    description.tile_width = tile;
    description.tile_height = tile;
    description.part_names = names;
    description.part_count = PARTS;
    return description;
}

/* Another number for each part and place. */
static float value_of(uint32_t part, size_t index)
{
    return (float)(index + 1) + 10000.0f * (float)part;
}

/* Rows of a part, in bands of so many. */
static void write_part(cm_image_writer *writer, uint32_t part, uint32_t end, uint32_t band)
{
    static float values[VALUES];
    for (size_t i = 0; i < VALUES; i++)
    {
        values[i] = value_of(part, i);
    }
    for (uint32_t first = 0; first < end; first += band)
    {
        const uint32_t last = first + band < end ? first + band : end;
        expect_good(io->write(writer, first, last, CM_PIXEL_FLOAT,
                              values + (size_t)first * WIDTH * CHANNELS, 0, 0, message),
                    "rows");
    }
}

static void check_part(uint32_t part)
{
    static float values[VALUES];
    cm_image_reader *reader = NULL;
    expect_good(io->open(path, part, &reader, message), "open");
    const cm_image_description *const is = io->describe(reader);
    REQUIRE(is->subimage == part && is->subimage_count == PARTS, "part %u of %u", is->subimage,
            is->subimage_count);
    REQUIRE(is->subimage_name != NULL && strcmp(is->subimage_name, names[part]) == 0, "'%s'",
            is->subimage_name == NULL ? "" : is->subimage_name);
    ck_assert(is->width == WIDTH && is->height == HEIGHT && is->channels == CHANNELS);
    const cm_image_region all = {0, 0, WIDTH, HEIGHT};
    expect_good(io->read(reader, &all, CM_PIXEL_FLOAT, values, 0, message), "read");
    io->close(reader);
    for (size_t i = 0; i < VALUES; i++)
    {
        REQUIRE(values[i] == value_of(part, i), "part %u, value %zu: %g", part, i,
                (double)values[i]);
    }
}

static void round_trip(uint32_t tile, uint32_t band)
{
    const cm_image_description description = describe_parts(tile);
    cm_image_writer *writer = NULL;
    expect_good(io->create(path, NULL, &description, &writer, message), "create");
    for (uint32_t part = 0; part < PARTS; part++)
    {
        write_part(writer, part, HEIGHT, band);
    }
    expect_good(io->finish(writer, message), "finish");
    io->drop(writer);
    for (uint32_t part = 0; part < PARTS; part++)
    {
        check_part(part);
    }
}

START_TEST(test_parts_return)
{
    round_trip(0, 7);
    round_trip(0, HEIGHT);
    round_trip(8, 5);
    unlink(path);
}
END_TEST

/* Every part has all of its rows, in their order. */
START_TEST(test_rows_are_missing)
{
    static float row[WIDTH * CHANNELS];
    const cm_image_description description = describe_parts(0);
    cm_image_writer *writer = NULL;
    expect_good(io->create(path, NULL, &description, &writer, message), "create");
    write_part(writer, 0, HEIGHT - 1, 4);
    expect_failure(io->write(writer, 0, 1, CM_PIXEL_FLOAT, row, 0, 0, message), CM_ERROR_ARGUMENT,
                   "in order", "parts");
    expect_good(io->write(writer, HEIGHT - 1, HEIGHT, CM_PIXEL_FLOAT, row, 0, 0, message), "row");
    expect_failure(io->finish(writer, message), CM_ERROR_ARGUMENT, "rows are missing", "parts");
    write_part(writer, 1, HEIGHT, 4);
    write_part(writer, 2, HEIGHT, 4);
    expect_failure(io->write(writer, 0, 1, CM_PIXEL_FLOAT, row, 0, 0, message), CM_ERROR_ARGUMENT,
                   "in order", "parts");
    expect_good(io->finish(writer, message), "finish");
    io->drop(writer);
    unlink(path);
}
END_TEST

START_TEST(test_other_formats_have_none)
{
    cm_image_description description = describe_parts(0);
    for (size_t i = 0; i < 3; i++)
    {
        description.format = (const char *const[]){"tiff", "png", "hdr"}[i];
        cm_image_writer *writer = NULL;
        expect_failure(io->create("parts.other", NULL, &description, &writer, message),
                       CM_ERROR_ARGUMENT, "no parts", "parts");
        ck_assert_ptr_null(writer);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {test_parts_return, test_rows_are_missing,
                                  test_other_formats_have_none, NULL};
    return run_in_folder("image parts", tests);
}
