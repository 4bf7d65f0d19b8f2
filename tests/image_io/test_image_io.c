/* SPDX-License-Identifier: MIT
 *
 * Image files by the table of functions: what is written is read again, in every type and format, in parts as in whole;
 * files that are damaged, and files byte by byte (small_files.h).
 */
#define _POSIX_C_SOURCE 200809L

#include "io_pictures.h"
#include "small_files.h"

#include <unistd.h>

/* ---------------------------------------------------------------- round trips */

static void round_trip(const char *format, cm_pixel_type type, uint32_t channels, uint32_t tile)
{
    static pixels written;
    static pixels read;
    char path[40];
    snprintf(path, sizeof path, "%s-%d-%u-%u", format, (int)type, (unsigned)channels,
             (unsigned)tile);
    cm_image_description description = describe(format, type, channels);
    description.tile_width = description.tile_height = tile;
    fill(&written, type, channels);
    write_picture(path, &description, &written);
    cm_image_reader *reader = open_picture(path);
    const cm_image_description *found = io->describe(reader);
    REQUIRE(strcmp(found->format, format) == 0, "%s: %s", path, found->format);
    REQUIRE(found->width == WIDTH && found->height == HEIGHT && found->channels == channels &&
                found->type == type && found->tile_width == tile && found->tile_height == tile,
            "%s: %u x %u, %u channels, type %d, tiles of %u", path, (unsigned)found->width,
            (unsigned)found->height, (unsigned)found->channels, (int)found->type,
            (unsigned)found->tile_width);
    ck_assert(found->whole_numbers == (type == CM_PIXEL_U8 || type == CM_PIXEL_U16));
    ck_assert(found->orientation == 1 && found->subimage_count == 1 && found->subimage == 0);
    ck_assert(found->left == 0 && found->top == 0 && found->window_width == WIDTH &&
              found->window_height == HEIGHT);
    read_all(reader, type, read.bytes, path);
    const size_t size = (size_t)WIDTH * HEIGHT * channels * size_of(type);
    REQUIRE(memcmp(read.bytes, written.bytes, size) == 0, "%s: other pixels", path);
    io->close(reader);
    unlink(path);
}

START_TEST(test_round_trips)
{
    for (uint32_t channels = 1; channels <= CHANNELS_MOST; channels++)
    {
        for (int type = CM_PIXEL_U8; type <= CM_PIXEL_FLOAT; type++)
        {
            const cm_pixel_type t = (cm_pixel_type)type;
            if (t != CM_PIXEL_HALF) /* which few programs read */
            {
                round_trip("tiff", t, channels, 0);
                round_trip("tiff", t, channels, 16);
            }
            if (t <= CM_PIXEL_U16 && channels <= 4)
            {
                round_trip("png", t, channels, 0);
            }
            if (t >= CM_PIXEL_HALF)
            {
                round_trip("openexr", t, channels, 0);
                round_trip("openexr", t, channels, 16);
            }
        }
    }
}
END_TEST

/* Formats that lose something: within what they lose. */
static void nearly(const char *format, double largest, double mean)
{
    static float written[WIDTH * HEIGHT * 3];
    static float read[WIDTH * HEIGHT * 3];
    cm_image_description description = describe(format, CM_PIXEL_FLOAT, 3);
    const bool jpeg = strcmp(format, "jpeg") == 0;
    description.type = jpeg ? CM_PIXEL_U8 : CM_PIXEL_FLOAT;
    description.compression = jpeg ? "jpeg:98" : NULL;
    for (size_t i = 0; i < WIDTH * HEIGHT * 3; i++)
    {
        const double angle = 0.1 * (double)(i / 3 % WIDTH) + 0.07 * (double)(i / 3 / WIDTH);
        written[i] = (float)(0.5 + 0.4 * sin(angle + (double)(i % 3)));
    }
    cm_image_writer *writer = NULL;
    char path[20];
    snprintf(path, sizeof path, "nearly.%s", format);
    expect_good(io->create(path, NULL, &description, &writer, message), format);
    expect_good(io->write(writer, 0, HEIGHT, CM_PIXEL_FLOAT, written, 0, 0, message), format);
    expect_good(io->finish(writer, message), format);
    io->drop(writer);
    cm_image_reader *reader = open_picture(path);
    ck_assert(io->describe(reader)->type == description.type);
    read_all(reader, CM_PIXEL_FLOAT, read, format);
    io->close(reader);
    double sum = 0;
    for (size_t i = 0; i < WIDTH * HEIGHT * 3; i++)
    {
        const double error = fabs((double)read[i] - (double)written[i]);
        REQUIRE(error <= largest, "%s: %g at %zu", format, error, i);
        sum += error;
    }
    REQUIRE(sum <= mean * WIDTH * HEIGHT * 3, "%s: %g in the mean", format,
            sum / (WIDTH * HEIGHT * 3));
    unlink(path);
}

START_TEST(test_lossy)
{
    nearly("jpeg", 0.06, 0.008);
    nearly("hdr", 0.004, 0.002);
}
END_TEST

/* Whole numbers stand for 0 to 1, halves for themselves; float to whole numbers rounds and cuts. */
START_TEST(test_other_types)
{
    static unsigned char written[WIDTH * HEIGHT];
    static float read[WIDTH * HEIGHT];
    static uint16_t wide[WIDTH * HEIGHT];
    for (size_t i = 0; i < sizeof written; i++)
    {
        written[i] = (unsigned char)i;
    }
    cm_image_description description = describe("png", CM_PIXEL_U8, 1);
    cm_image_writer *writer = NULL;
    expect_good(io->create("grey", NULL, &description, &writer, message), "grey");
    expect_good(io->write(writer, 0, HEIGHT, CM_PIXEL_U8, written, 0, 0, message), "grey");
    expect_good(io->finish(writer, message), "grey");
    io->drop(writer);
    cm_image_reader *reader = open_picture("grey");
    read_all(reader, CM_PIXEL_FLOAT, read, "grey");
    read_all(reader, CM_PIXEL_U16, wide, "grey");
    for (size_t i = 0; i < sizeof written; i++)
    {
        REQUIRE(fabsf(read[i] - (float)written[i] / 255.0F) <= 0x1p-24F, "%zu: %g", i,
                (double)read[i]);
        REQUIRE(wide[i] == written[i] * 257, "%zu: %u", i, (unsigned)wide[i]);
    }
    io->close(reader);
    const float outside[4] = {-0.5F, 0.4999F / 255.0F, 0.5001F / 255.0F, 7.0F};
    const unsigned char wanted[4] = {0, 0, 1, 255};
    unsigned char found[4];
    description.width = 4;
    description.height = 1;
    expect_good(io->create("grey", NULL, &description, &writer, message), "grey");
    expect_good(io->write(writer, 0, 1, CM_PIXEL_FLOAT, outside, 0, 0, message), "grey");
    expect_good(io->finish(writer, message), "grey");
    io->drop(writer);
    reader = open_picture("grey");
    read_all(reader, CM_PIXEL_U8, found, "grey");
    io->close(reader);
    ck_assert(memcmp(found, wanted, 4) == 0);
    unlink("grey");
}
END_TEST

/* Halves in TIFF, which become floats, of the same values. */
START_TEST(test_half_tiff)
{
    static pixels written;
    static pixels read;
    fill(&written, CM_PIXEL_HALF, 1);
    const cm_image_description description = describe("tiff", CM_PIXEL_HALF, 1);
    write_picture("half.tif", &description, &written);
    cm_image_reader *reader = open_picture("half.tif");
    ck_assert(io->describe(reader)->type == CM_PIXEL_FLOAT);
    read_all(reader, CM_PIXEL_HALF, read.bytes, "half.tif");
    ck_assert(memcmp(read.bytes, written.bytes, (size_t)2 * WIDTH * HEIGHT) == 0);
    io->close(reader);
    unlink("half.tif");
}
END_TEST

/* ---------------------------------------------------------------- parts */

static void check_region(cm_image_reader *reader, const pixels *whole,
                         const cm_image_region *region, const char *path)
{
    static pixels part;
    const cm_image_description *of = io->describe(reader);
    const size_t pixel = of->channels * size_of(of->type);
    const size_t row = pixel * (region->x1 - region->x0);
    const uint32_t rows = region->y1 - region->y0;
    memset(part.bytes, 0xa5, sizeof part.bytes);
    /* from the last row upwards, with a gap between rows */
    const size_t stride = row + 8;
    ck_assert(stride * rows <= sizeof part.bytes);
    expect_good(io->read(reader, region, of->type, part.bytes + stride * (rows - 1),
                         -(ptrdiff_t)stride, message),
                path);
    for (uint32_t y = 0; y < rows; y++)
    {
        const unsigned char *found = part.bytes + stride * (rows - 1 - y);
        const unsigned char *wanted =
            whole->bytes + ((size_t)(region->y0 + y) * of->width + region->x0) * pixel;
        REQUIRE(memcmp(found, wanted, row) == 0, "%s: row %u of columns %u to %u, rows %u to %u",
                path, (unsigned)y, (unsigned)region->x0, (unsigned)region->x1, (unsigned)region->y0,
                (unsigned)region->y1);
        REQUIRE(y == 0 || found[row] == 0xa5, "%s: writes between rows", path);
    }
}

static void check_regions(const char *format, cm_pixel_type type, uint32_t channels, uint32_t tile)
{
    static pixels whole;
    cm_image_description description = describe(format, type, channels);
    description.tile_width = description.tile_height = tile;
    fill(&whole, type, channels);
    char path[20];
    snprintf(path, sizeof path, "parts.%s", format);
    write_picture(path, &description, &whole);
    cm_image_reader *reader = open_picture(path);
    read_all(reader, type, whole.bytes, format); /* JPEG has others than were written */
    const uint32_t columns[] = {0, 1, 15, 16, 17, 31, 32, 44, WIDTH};
    const uint32_t rows[] = {0, 1, 16, 20, 32, HEIGHT};
    /* backwards, so that readers of rows in order begin anew */
    for (size_t y0 = 5; y0-- > 0;)
    {
        for (size_t y1 = y0 + 1; y1 < 6; y1 += step_of(2))
        {
            for (size_t x0 = 0; x0 < 8; x0 += 1 + y0 % 2)
            {
                const cm_image_region region = {columns[x0], rows[y0],
                                                columns[x0 + 1 + (x0 + y1) % (8 - x0)], rows[y1]};
                check_region(reader, &whole, &region, format);
            }
        }
    }
    io->close(reader);
    unlink(path);
}

START_TEST(test_regions)
{
    check_regions("png", CM_PIXEL_U8, 3, 0);
    check_regions("png", CM_PIXEL_U16, 4, 0);
    check_regions("jpeg", CM_PIXEL_U8, 3, 0);
    check_regions("tiff", CM_PIXEL_U8, 3, 0);
    check_regions("tiff", CM_PIXEL_FLOAT, 2, 16);
    check_regions("openexr", CM_PIXEL_HALF, 3, 0);
    check_regions("openexr", CM_PIXEL_FLOAT, 1, 16);
}
END_TEST

START_TEST(test_wrong_regions)
{
    static pixels whole;
    cm_image_description description = describe("png", CM_PIXEL_U8, 1);
    fill(&whole, CM_PIXEL_U8, 1);
    write_picture("wrong", &description, &whole);
    cm_image_reader *reader = open_picture("wrong");
    const cm_image_region wrong[] = {
        {0, 0, 0, 1},          {0, 0, 1, 0},          {5, 0, 5, 9},
        {9, 0, 5, 9},          {0, 9, 5, 8},          {0, 0, WIDTH + 1, 1},
        {0, 0, 1, HEIGHT + 1}, {0, 0, UINT32_MAX, 1}, {UINT32_MAX, 0, 1, 1}};
    unsigned char untouched = 0x5a;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
    {
        expect_failure(io->read(reader, &wrong[i], CM_PIXEL_U8, &untouched, 0, message),
                       CM_ERROR_ARGUMENT, "no such part", "region");
    }
    const cm_image_region one = {0, 0, 1, 1};
    expect_failure(io->read(reader, &one, (cm_pixel_type)9, &untouched, 0, message),
                   CM_ERROR_ARGUMENT, "no such type", "type");
    ck_assert(untouched == 0x5a);
    io->close(reader);
    io->close(NULL);
    cm_image_reader *none = reader = NULL;
    expect_failure(io->open("wrong", 1, &none, message), CM_ERROR_ARGUMENT,
                   "has no picture 1; it has 1", "subimage");
    ck_assert(none == NULL);
    unlink("wrong");
}
END_TEST

/* ---------------------------------------------------------------- what files say */

static const cm_image_tag *tag_of(const cm_image_description *of, const char *key)
{
    for (size_t i = 0; i < of->tag_count; i++)
    {
        if (strcmp(of->tags[i].key, key) == 0)
        {
            return &of->tags[i];
        }
    }
    return NULL;
}

static void expect_tag(const cm_image_description *of, const char *key, const char *text)
{
    const cm_image_tag *tag = tag_of(of, key);
    REQUIRE(tag != NULL, "%s: no %s", of->format, key);
    REQUIRE(strcmp(tag->text, text) == 0, "%s: %s is '%s'", of->format, key, tag->text);
}

START_TEST(test_tags)
{
    static pixels any;
    fill(&any, CM_PIXEL_FLOAT, 3);
    const int number = 42;
    const float three[3] = {0.5F, 1.5F, -2.0F};
    const char *const words[1] = {"a text as data"};
    const cm_image_tag tags[] = {{"Copyright", "Somebody, 2024", NULL, NULL, 0},
                                 {"ImageDescription", "caf\xc3\xa9", NULL, NULL, 0},
                                 {"a:number", "", "int", &number, sizeof number},
                                 {"a:triple", "", "float[3]", three, sizeof three},
                                 {"a:word", "", "string", words, sizeof words}};
    cm_image_description description = describe("openexr", CM_PIXEL_FLOAT, 3);
    description.tags = tags;
    description.tag_count = 5;
    const char *const names[3] = {"depth", "A", "X"};
    description.channel_names = names;
    description.compression = "zip";
    write_picture("tags.exr", &description, &any);
    cm_image_reader *reader = open_picture("tags.exr");
    const cm_image_description *found = io->describe(reader);
    expect_tag(found, "Copyright", "Somebody, 2024");
    expect_tag(found, "ImageDescription", "caf\xc3\xa9");
    expect_tag(found, "a:number", "42");
    expect_tag(found, "a:word", "a text as data");
    const cm_image_tag *triple = tag_of(found, "a:triple");
    REQUIRE(triple != NULL && triple->data_size == 12 && memcmp(triple->data, three, 12) == 0, "%s",
            triple == NULL ? "none" : triple->type);
    ck_assert_str_eq(found->compression, "zip");
    ck_assert(found->color == CM_IMAGE_COLOR_LINEAR);
    int known = 0;
    for (uint32_t i = 0; i < 3; i++)
    {
        for (size_t k = 0; k < 3; k++)
        {
            known += strcmp(found->channel_names[i], names[k]) == 0;
        }
    }
    ck_assert_int_eq(known, 3);
    io->close(reader);
    unlink("tags.exr");
}
END_TEST

static void check_compression(const char *given, const char *wanted)
{
    static pixels any;
    fill(&any, CM_PIXEL_U8, 3);
    cm_image_description description = describe("tiff", CM_PIXEL_U8, 3);
    description.compression = given;
    write_picture("packed.tif", &description, &any);
    cm_image_reader *reader = open_picture("packed.tif");
    const char *found = io->describe(reader)->compression;
    REQUIRE(found != NULL && strcmp(found, wanted) == 0, "%s",
            found == NULL ? "none is said" : found);
    io->close(reader);
    unlink("packed.tif");
}

START_TEST(test_compressions)
{
    check_compression(NULL, "none");
    check_compression("zip", "zip");
    check_compression("lzw", "lzw");
}
END_TEST

static void check_color(const char *format, cm_pixel_type type, cm_image_color color)
{
    static pixels any;
    fill(&any, type, 3);
    cm_image_description description = describe(format, type, 3);
    description.color = color;
    write_picture("color", &description, &any);
    cm_image_reader *reader = open_picture("color");
    const cm_image_color found = io->describe(reader)->color;
    REQUIRE(found == color, "%s: %d, not %d", format, (int)found, (int)color);
    io->close(reader);
    unlink("color");
}

START_TEST(test_colors)
{
    check_color("png", CM_PIXEL_U8, CM_IMAGE_COLOR_SRGB);
    check_color("png", CM_PIXEL_U16, CM_IMAGE_COLOR_LINEAR);
    check_color("jpeg", CM_PIXEL_U8, CM_IMAGE_COLOR_SRGB);
    check_color("openexr", CM_PIXEL_HALF, CM_IMAGE_COLOR_LINEAR);
    check_color("hdr", CM_PIXEL_FLOAT, CM_IMAGE_COLOR_LINEAR);
}
END_TEST

/* Values are as stored, whatever alpha is. */
static void check_alpha(const char *format, cm_pixel_type type, bool multiplied)
{
    static pixels written;
    static pixels read;
    memset(&written, 0, sizeof written);
    const float quarter[4] = {0.125F, 0.25F, 0.0625F, 0.5F};
    cm_image_description description = describe(format, CM_PIXEL_FLOAT, 4);
    description.stored_type = type == CM_PIXEL_U8 ? "uint8" : "float";
    description.alpha = 3;
    description.alpha_multiplied = multiplied;
    for (size_t i = 0; i < WIDTH * HEIGHT; i++)
    {
        memcpy(written.bytes + 16 * i, quarter, 16);
    }
    write_picture("alpha", &description, &written);
    cm_image_reader *reader = open_picture("alpha");
    const cm_image_description *found = io->describe(reader);
    ck_assert_int_eq(found->alpha, 3);
    ck_assert(found->type == type);
    /* PNG knows no other alpha: colours that are multiplied are divided when written */
    const bool divided = strcmp(format, "png") == 0;
    ck_assert(found->alpha_multiplied == (multiplied && !divided));
    read_all(reader, CM_PIXEL_FLOAT, read.bytes, "alpha");
    float first[4];
    memcpy(first, read.bytes, sizeof first);
    for (size_t c = 0; c < 4; c++)
    {
        const float wanted = quarter[c] * (multiplied && divided && c < 3 ? 2.0F : 1.0F);
        REQUIRE(fabsf(first[c] - wanted) < 0.004F, "%s: channel %zu is %g", format, c,
                (double)first[c]);
    }
    io->close(reader);
    unlink("alpha");
}

START_TEST(test_alpha)
{
    check_alpha("tiff", CM_PIXEL_U8, false);
    check_alpha("tiff", CM_PIXEL_U8, true);
    check_alpha("tiff", CM_PIXEL_FLOAT, false);
    check_alpha("openexr", CM_PIXEL_FLOAT, true);
    check_alpha("png", CM_PIXEL_U8, false);
    check_alpha("png", CM_PIXEL_U8, true);
}
END_TEST

/* ---------------------------------------------------------------- files byte by byte */

static void check_page(const char *path, uint32_t page, uint32_t pages)
{
    cm_image_reader *reader = NULL;
    unsigned char read[SMALL_WIDTH * SMALL_HEIGHT];
    expect_good(io->open(path, page, &reader, message), path);
    ck_assert(io->describe(reader)->subimage == page &&
              io->describe(reader)->subimage_count == pages);
    read_all(reader, CM_PIXEL_U8, read, path);
    for (uint32_t i = 0; i < sizeof read; i++)
    {
        ck_assert_uint_eq(read[i], 16 * page + i);
    }
    const cm_image_geo_tags *tags = io->describe(reader)->geo_tags;
    ck_assert_ptr_nonnull(tags);
    ck_assert(tags->scale_count == 3 && tags->scale[0] == page + 0.5 &&
              tags->scale[1] == page + 0.25);
    ck_assert(tags->tie_point_count == 6 && tags->tie_points[3] == -180.0 &&
              tags->tie_points[4] == 90.0);
    ck_assert(tags->key_count == 8 && tags->keys[0] == 1000 && tags->keys[7] == 1007);
    ck_assert(tags->number_count == 2 && tags->numbers[0] == 6378137.0 &&
              tags->numbers[1] == 298.25);
    ck_assert(tags->transformation == NULL && tags->transformation_count == 0);
    ck_assert_str_eq(tags->texts, "WGS 84|page");
    ck_assert_str_eq(tags->no_data, "-9999.5");
    io->close(reader);
}

START_TEST(test_geo_tags)
{
    for (int kind = 0; kind < 4; kind++)
    {
        const small_tiff what = {.big_endian = kind % 2 == 1,
                                 .big_tiff = kind > 1,
                                 .pages = 3,
                                 .geo_tags = true,
                                 .cut = 0};
        ck_assert(write_small_tiff("geo.tif", &what));
        for (uint32_t page = 0; page < 3; page++)
        {
            check_page("geo.tif", page, 3);
        }
    }
    const small_tiff plain = {
        .big_endian = false, .big_tiff = false, .pages = 1, .geo_tags = false, .cut = 0};
    ck_assert(write_small_tiff("geo.tif", &plain));
    cm_image_reader *reader = open_picture("geo.tif");
    ck_assert_ptr_null(io->describe(reader)->geo_tags);
    io->close(reader);
    unlink("geo.tif");
}
END_TEST

START_TEST(test_parts)
{
    ck_assert(write_small_exr("parts.exr", 3));
    for (uint32_t part = 0; part < 3; part++)
    {
        cm_image_reader *reader = NULL;
        float read[SMALL_WIDTH * SMALL_HEIGHT];
        expect_good(io->open("parts.exr", part, &reader, message), "parts.exr");
        const cm_image_description *of = io->describe(reader);
        ck_assert(of->subimage == part && of->subimage_count == 3 && of->channels == 1);
        ck_assert(of->left == 1 && of->top == 1 && of->window_width == SMALL_WIDTH + 2 &&
                  of->window_height == SMALL_HEIGHT + 2);
        read_all(reader, CM_PIXEL_FLOAT, read, "parts.exr");
        for (uint32_t i = 0; i < SMALL_WIDTH * SMALL_HEIGHT; i++)
        {
            ck_assert(read[i] == (float)(100 * part + i));
        }
        io->close(reader);
    }
    cm_image_reader *none = NULL;
    expect_failure(io->open("parts.exr", 3, &none, message), CM_ERROR_ARGUMENT,
                   "has no picture 3; it has 3", "part");
    unlink("parts.exr");
}
END_TEST

/* A type that is none of the four is float, and says what it was. */
START_TEST(test_wide_numbers)
{
    const uint32_t numbers[3] = {0, 0x80000000, UINT32_MAX};
    float read[3];
    ck_assert(write_wide_tiff("wide.tif", numbers, 3));
    cm_image_reader *reader = open_picture("wide.tif");
    const cm_image_description *of = io->describe(reader);
    ck_assert(of->type == CM_PIXEL_FLOAT && of->whole_numbers);
    ck_assert_str_eq(of->stored_type, "uint");
    read_all(reader, CM_PIXEL_FLOAT, read, "wide.tif");
    ck_assert(read[0] == 0.0F && fabsf(read[1] - 0.5F) < 1e-6F && read[2] == 1.0F);
    io->close(reader);
    unlink("wide.tif");
}
END_TEST

/* ---------------------------------------------------------------- what is damaged */

static void save(const char *path, const unsigned char *content, size_t size)
{
    FILE *file = fopen(path, "wb");
    ck_assert_ptr_nonnull(file);
    ck_assert(fwrite(content, 1, size, file) == size);
    ck_assert(fclose(file) == 0);
}

/* Whether it fails, when it is opened or read, with a line. */
static bool fails(const char *path)
{
    static pixels read;
    cm_image_reader *reader = NULL;
    cm_status status = io->open(path, 0, &reader, message);
    if (status == CM_OK)
    {
        const cm_image_description *of = io->describe(reader);
        const cm_image_region all = {0, 0, of->width, of->height};
        const bool fits = (uint64_t)of->width * of->height * of->channels * 4 <= sizeof read;
        status = fits ? io->read(reader, &all, CM_PIXEL_FLOAT, read.bytes, 0, message) : CM_OK;
        io->close(reader);
    }
    if (status != CM_OK)
    {
        expect_line(path);
    }
    return status != CM_OK;
}

/* What libraries write to standard error by themselves is not wanted in the test's output. */
static void without_standard_error(void (*run)(const char *, cm_pixel_type), const char *format,
                                   cm_pixel_type type)
{
    fflush(stderr);
    const int kept = dup(STDERR_FILENO);
    ck_assert(kept >= 0 && freopen("/dev/null", "w", stderr) != NULL);
    run(format, type);
    fflush(stderr);
    ck_assert(dup2(kept, STDERR_FILENO) == STDERR_FILENO);
    close(kept);
}

static void cut_and_flip(const char *format, cm_pixel_type type)
{
    static pixels any;
    fill(&any, type, 3);
    const cm_image_description description = describe(format, type, 3);
    write_picture("whole", &description, &any);
    size_t size = 0;
    unsigned char *content = content_of("whole", &size);
    ck_assert(!fails("whole"));
    for (size_t kept = 0; kept < size; kept += 1 + size / (is_quick() ? 15 : 60))
    {
        save("part", content, kept);
        REQUIRE(fails("part"), "%s: %zu bytes of %zu are an image", format, kept, size);
    }
    /* one byte is another: anything but a crash or a failure without a word */
    for (size_t at = 0; at < size; at += 1 + at / (is_quick() ? 4 : 30))
    {
        content[at] ^= 0x55;
        save("part", content, size);
        (void)fails("part");
        content[at] ^= 0x55;
    }
    free(content);
    unlink("whole");
    unlink("part");
}

START_TEST(test_damaged_files)
{
    without_standard_error(cut_and_flip, "png", CM_PIXEL_U8);
    without_standard_error(cut_and_flip, "tiff", CM_PIXEL_U16);
    without_standard_error(cut_and_flip, "jpeg", CM_PIXEL_U8);
    without_standard_error(cut_and_flip, "openexr", CM_PIXEL_HALF);
}
END_TEST

START_TEST(test_no_images)
{
    cm_image_reader *none = NULL;
    expect_failure(io->open("nothing.png", 0, &none, message), CM_ERROR_UNSUPPORTED,
                   "is not an image", "no file");
    save("text.png", (const unsigned char *)"a text\n", 7);
    expect_failure(io->open("text.png", 0, &none, message), CM_ERROR_UNSUPPORTED, "is not an image",
                   "text");
    save("text.png", (const unsigned char *)"", 0);
    expect_failure(io->open("text.png", 0, &none, message), CM_ERROR_UNSUPPORTED, "is not an image",
                   "empty");
    ck_assert_ptr_null(none);
    unlink("text.png");
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        test_round_trips,  test_lossy,         test_other_types, test_half_tiff,
        test_regions,      test_wrong_regions, test_tags,        test_compressions,
        test_colors,       test_alpha,         test_geo_tags,    test_parts,
        test_wide_numbers, test_damaged_files, test_no_images,   NULL};
    return run_in_folder("image io", tests);
}
