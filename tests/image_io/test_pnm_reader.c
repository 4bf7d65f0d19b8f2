/* SPDX-License-Identifier: MIT
 *
 * PGM, PPM and PFM by the table of functions: their numbers in parts as in whole, what they say of themselves, files that
 * are cut anywhere and headers that are none.
 */
#define _POSIX_C_SOURCE 200809L

#include "io_pictures.h"

#include <unistd.h>

enum
{
    COLUMNS = 7,
    ROWS = 5,
    VALUES_MOST = COLUMNS * ROWS * 3,
    HEADER_MOST = 64
};

/* A kind of file: its first letters, how many bytes a sample has and in which order. */
typedef struct kind
{
    const char *letters;
    const char *last; /* of the header */
    uint32_t channels;
    uint32_t bytes;
    bool little_endian;
    bool bottom_up;
} kind;

static const kind kinds[] = {
    {"P5", "255", 1, 1, false, false},   {"P6", "255", 3, 1, false, false},
    {"P5", "65535", 1, 2, false, false}, {"P6", "65535", 3, 2, false, false},
    {"Pf", "1.0", 1, 4, false, true},    {"Pf", "-1.0", 1, 4, true, true},
    {"PF", "1", 3, 4, false, true},      {"PF", "-1.000000", 3, 4, true, true},
    {"PF", "-0.5", 3, 4, true, true},    {"Pf", "4", 1, 4, false, true}};

enum
{
    KINDS = sizeof kinds / sizeof kinds[0]
};

static cm_pixel_type type_of(const kind *of)
{
    return of->bytes == 1 ? CM_PIXEL_U8 : of->bytes == 2 ? CM_PIXEL_U16 : CM_PIXEL_FLOAT;
}

/* What the scale multiplies by: OpenImageIO's habit, which the format leaves open. */
static float scale_of(const kind *of)
{
    return of->bytes == 4 ? fabsf(strtof(of->last, NULL)) : 1.0F;
}

/* The bits that sample i has in the file: of floats any numbers, below zero and above one, too. */
static uint32_t bits_of(const kind *of, size_t i)
{
    const float number = (float)((double)i * 1.375 - 9.0);
    uint32_t bits = (uint32_t)(i * 40503 + 1234);
    if (of->bytes == 4)
    {
        memcpy(&bits, &number, sizeof bits);
    }
    return bits;
}

static size_t make_file(const kind *of, unsigned char *file)
{
    const int header = snprintf((char *)file, HEADER_MOST, "%s\n%d %d\n%s\n", of->letters,
                                (int)COLUMNS, (int)ROWS, of->last);
    unsigned char *at = file + header;
    const size_t row = COLUMNS * of->channels;
    for (size_t i = 0; i < ROWS * row; i++)
    {
        const size_t y = of->bottom_up ? ROWS - 1 - i / row : i / row;
        for (uint32_t byte = 0; byte < of->bytes; byte++)
        {
            const uint32_t place = of->little_endian ? byte : of->bytes - 1 - byte;
            *at++ = (unsigned char)(bits_of(of, y * row + i % row) >> 8 * place);
        }
    }
    return (size_t)(at - file);
}

static void save(const unsigned char *content, size_t size)
{
    FILE *const file = fopen("picture", "wb");
    ck_assert_ptr_nonnull(file);
    ck_assert(fwrite(content, 1, size, file) == size && fclose(file) == 0);
}

static float number_of(const kind *of, size_t i)
{
    const uint32_t bits = bits_of(of, i);
    float number;
    memcpy(&number, &bits, sizeof number);
    return of->bytes == 1   ? (float)(bits & 255) / 255.0F
           : of->bytes == 2 ? (float)(bits & 65535) / 65535.0F
                            : number * scale_of(of);
}

/* As floats, with a gap behind each row, and from the last row upwards. */
static void check_region(cm_image_reader *reader, const kind *of, const cm_image_region *region)
{
    float read[ROWS * (COLUMNS * 3 + 1)];
    const size_t across = (size_t)(region->x1 - region->x0) * of->channels;
    const uint32_t down = region->y1 - region->y0;
    const size_t stride = across + 1;
    for (size_t i = 0; i < sizeof read / sizeof *read; i++)
    {
        read[i] = -77.0F;
    }
    expect_good(io->read(reader, region, CM_PIXEL_FLOAT, read + stride * (down - 1),
                         -(ptrdiff_t)(stride * sizeof *read), message),
                of->last);
    for (uint32_t y = 0; y < down; y++)
    {
        const float *const row = read + stride * (down - 1 - y);
        const size_t first = ((size_t)(region->y0 + y) * COLUMNS + region->x0) * of->channels;
        for (size_t i = 0; i < across; i++)
        {
            const float wanted = number_of(of, first + i);
            REQUIRE(fabsf(row[i] - wanted) <= (of->bytes < 4 ? 0x1p-23F : 0.0F),
                    "%s %s: %g, not %g, in row %u", of->letters, of->last, (double)row[i],
                    (double)wanted, (unsigned)(region->y0 + y));
        }
        REQUIRE(row[across] == -77.0F, "%s %s: writes between rows", of->letters, of->last);
    }
}

START_TEST(test_numbers)
{
    unsigned char file[HEADER_MOST + VALUES_MOST * 4];
    for (size_t k = 0; k < KINDS; k++)
    {
        save(file, make_file(&kinds[k], file));
        cm_image_reader *const reader = open_picture("picture");
        for (uint32_t y0 = ROWS; y0-- > 0;)
        {
            for (uint32_t x0 = 0; x0 < COLUMNS; x0 += 3)
            {
                const cm_image_region part = {x0, y0, x0 == 3 ? 5 : COLUMNS, y0 == 1 ? 3 : ROWS};
                check_region(reader, &kinds[k], &part);
            }
        }
        io->close(reader);
    }
    unlink("picture");
}
END_TEST

/* The file's own samples, bit by bit: those of floats, signalling NaN among them, are not touched. */
START_TEST(test_samples)
{
    unsigned char file[HEADER_MOST + VALUES_MOST * 4];
    for (size_t k = 0; k < KINDS; k++)
    {
        const kind *const of = &kinds[k];
        if (scale_of(of) != 1.0F)
        {
            continue;
        }
        save(file, make_file(of, file));
        cm_image_reader *const reader = open_picture("picture");
        unsigned char read[VALUES_MOST * 4];
        read_all(reader, type_of(of), read, of->letters);
        for (size_t i = 0; i < COLUMNS * ROWS * of->channels; i++)
        {
            uint16_t word = 0;
            uint32_t bits = 0;
            memcpy(&word, read + 2 * (of->bytes == 2 ? i : 0), sizeof word);
            memcpy(&bits, read + 4 * (of->bytes == 4 ? i : 0), sizeof bits);
            const uint32_t found = of->bytes == 1 ? read[i] : of->bytes == 2 ? word : bits;
            const uint32_t kept = of->bytes == 4 ? UINT32_MAX : (1U << 8 * of->bytes) - 1;
            REQUIRE(found == (bits_of(of, i) & kept), "%s %s: sample %zu is %x", of->letters,
                    of->last, i, (unsigned)found);
        }
        io->close(reader);
    }
    static const char nan[] = "Pf\n1 1\n1.0\n\x7f\x80\x00\x01";
    const uint32_t signalling = 0x7f800001;
    uint32_t bits = 0;
    save((const unsigned char *)nan, sizeof nan - 1);
    cm_image_reader *const reader = open_picture("picture");
    read_all(reader, CM_PIXEL_FLOAT, &bits, "NaN");
    io->close(reader);
    ck_assert_uint_eq(bits, signalling);
    unlink("picture");
}
END_TEST

static const char *text_of(const cm_image_description *of, const char *key)
{
    for (size_t i = 0; i < of->tag_count; i++)
    {
        if (strcmp(of->tags[i].key, key) == 0)
        {
            return of->tags[i].text;
        }
    }
    return "none";
}

/* Whoever reads it: PFM with a scale is OpenImageIO's. */
START_TEST(test_descriptions)
{
    unsigned char file[HEADER_MOST + VALUES_MOST * 4];
    for (size_t k = 0; k < KINDS; k++)
    {
        const kind *const is = &kinds[k];
        save(file, make_file(is, file));
        cm_image_reader *const reader = open_picture("picture");
        const cm_image_description *const of = io->describe(reader);
        REQUIRE(strcmp(of->format, "pnm") == 0 && of->width == COLUMNS && of->height == ROWS &&
                    of->channels == is->channels && of->type == type_of(is) &&
                    of->whole_numbers == (is->bytes < 4) && of->alpha == -1 &&
                    of->color == CM_IMAGE_COLOR_UNKNOWN && of->orientation == 1 &&
                    of->subimage_count == 1 && of->window_width == COLUMNS &&
                    of->window_height == ROWS && of->tile_width == 0,
                "%s %s", is->letters, is->last);
        ck_assert_str_eq(of->stored_type, is->bytes == 1   ? "uint8"
                                          : is->bytes == 2 ? "uint16"
                                                           : "float");
        ck_assert_str_eq(of->channel_names[0], is->channels == 1 ? "Y" : "R");
        ck_assert_str_eq(text_of(of, "oiio:ColorSpace"), "Rec709");
        ck_assert_str_eq(text_of(of, "pnm:bigendian"), is->bytes < 4       ? "none"
                                                       : is->little_endian ? "0"
                                                                           : "1");
        ck_assert_str_eq(text_of(of, "pnm:binary"), is->bytes < 4 ? "1" : "none");
        io->close(reader);
    }
    unlink("picture");
}
END_TEST

/* Opening it or reading it. */
static cm_status status_of(void)
{
    static float read[VALUES_MOST];
    cm_image_reader *reader = NULL;
    cm_status status = io->open("picture", 0, &reader, message);
    if (status == CM_OK)
    {
        const cm_image_description *const of = io->describe(reader);
        const cm_image_region all = {0, 0, of->width, of->height};
        REQUIRE((uint64_t)of->width * of->height * of->channels <= VALUES_MOST, "%u x %u",
                (unsigned)of->width, (unsigned)of->height);
        status = io->read(reader, &all, CM_PIXEL_FLOAT, read, 0, message);
        io->close(reader);
    }
    return status;
}

START_TEST(test_cut_anywhere)
{
    unsigned char file[HEADER_MOST + VALUES_MOST * 4];
    for (size_t k = 0; k < KINDS; k++)
    {
        const size_t size = make_file(&kinds[k], file);
        for (size_t kept = 0; kept < size; kept += kept < 24 ? 1 : step_of(7) + 6)
        {
            save(file, kept);
            REQUIRE(status_of() == CM_ERROR_UNSUPPORTED, "%s %s: %zu bytes of %zu are a picture",
                    kinds[k].letters, kinds[k].last, kept, size);
            expect_line(kinds[k].letters);
        }
        save(file, size + 1); /* what stands behind it is nobody's */
        ck_assert_int_eq(status_of(), CM_OK);
    }
    unlink("picture");
}
END_TEST

/* A file that becomes shorter while it is open is not read beyond its end. */
START_TEST(test_cut_while_open)
{
    enum
    {
        EDGE = 300
    };
    static float values[EDGE * EDGE];
    static const char header[] = "Pf\n300 300\n-1.0\n";
    FILE *const file = fopen("picture", "wb");
    ck_assert_ptr_nonnull(file);
    ck_assert(fwrite(header, 1, sizeof header - 1, file) == sizeof header - 1 &&
              fwrite(values, 1, sizeof values, file) == sizeof values && fclose(file) == 0);
    cm_image_reader *const reader = open_picture("picture");
    ck_assert_int_eq(truncate("picture", sizeof values / 2), 0);
    const cm_image_region high = {0, 0, EDGE, 10}; /* which is at the file's end */
    const cm_image_region low = {0, EDGE - 10, EDGE, EDGE};
    expect_failure(io->read(reader, &high, CM_PIXEL_FLOAT, values, 0, message),
                   CM_ERROR_UNSUPPORTED, "ends too early", "the end");
    expect_good(io->read(reader, &low, CM_PIXEL_FLOAT, values, 0, message), "the begin");
    io->close(reader);
    unlink("picture");
}
END_TEST

START_TEST(test_crafted_headers)
{
    static const char *const headers[] = {"PF\n0 0\n-1.0\n",
                                          "PF\n-1 4\n-1.0\n",
                                          "PF\n4 -1\n-1.0\n",
                                          "PF\n1000000 1000000\n-1.0\n",
                                          "PF\n1 1\nscale\n",
                                          "PF\n1 1\n",
                                          "PF\n1\n",
                                          "Pf",
                                          "PF#\n",
                                          "PF\n# without an end",
                                          "P6\n1000000 1000000\n255\n",
                                          "P6\n1 1\n0\n",
                                          "P6\n1 1\n65536\n"};
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++)
    {
        unsigned char file[HEADER_MOST] = {0};
        const size_t size = strlen(headers[i]);
        memcpy(file, headers[i], size);
        save(file, size);
        cm_image_reader *reader = NULL;
        cm_status status = io->open("picture", 0, &reader, message);
        if (status == CM_OK)
        {
            const cm_image_region one = {0, 0, 1, 1};
            float read[3];
            status = io->read(reader, &one, CM_PIXEL_FLOAT, read, 0, message);
            io->close(reader);
        }
        REQUIRE(status == CM_ERROR_UNSUPPORTED, "%s", headers[i]);
        expect_line(headers[i]);
    }
    unlink("picture");
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {test_numbers,
                                  test_samples,
                                  test_descriptions,
                                  test_cut_anywhere,
                                  test_cut_while_open,
                                  test_crafted_headers,
                                  NULL};
    return run_in_folder("pnm reader", tests);
}
