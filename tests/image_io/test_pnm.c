/* SPDX-License-Identifier: MIT
 *
 * PGM, PPM, PAM, PFM and bare samples: several pictures in one stream, the bytes of small files by Netpbm's specifications,
 * streams cut anywhere.
 */
#include "modules/image/io/header_lines.h"
#include "modules/image/io/pnm_file.h"

#include "tests/memory_stream.h"
#include "tests/suite.h"

enum
{
    WIDTH = 3,
    HEIGHT = 2,
    CHANNELS_MOST = 5,
    ROOM = 4096
};

static char message[CM_IMAGE_MESSAGE];
static unsigned char file[ROOM];
_Alignas(8) static unsigned char pixels[WIDTH * HEIGHT * CHANNELS_MOST * 4];
_Alignas(8) static unsigned char got[sizeof pixels];

/* A pipe gives a byte at a time. */
static size_t read_slowly(void *context, void *bytes, size_t count)
{
    return memory_read(context, bytes, count > 0 ? 1 : 0);
}

static cm_image make_image(cm_pixel_type type, uint32_t channels)
{
    for (size_t i = 0; i < sizeof pixels; i++)
    {
        pixels[i] = (unsigned char)(i * 37 + 11);
    }
    const cm_image image = {.size = sizeof image,
                            .data = pixels,
                            .type = type,
                            .width = WIDTH,
                            .height = HEIGHT,
                            .channels = channels};
    return image;
}

static const cm_pnm_picture cases[] = {
    {.kind = CM_PNM_PGM, .channels = 1, .type = CM_PIXEL_U8},
    {.kind = CM_PNM_PGM, .channels = 1, .type = CM_PIXEL_U16},
    {.kind = CM_PNM_PPM, .channels = 3, .type = CM_PIXEL_U8},
    {.kind = CM_PNM_PPM, .channels = 3, .type = CM_PIXEL_U16},
    {.kind = CM_PNM_PAM, .channels = 2, .type = CM_PIXEL_U8, .alpha = 1},
    {.kind = CM_PNM_PAM, .channels = 4, .type = CM_PIXEL_U16, .alpha = 1},
    {.kind = CM_PNM_PAM, .channels = 5, .type = CM_PIXEL_U8},
    {.kind = CM_PNM_PFM, .channels = 1, .type = CM_PIXEL_FLOAT},
    {.kind = CM_PNM_PFM, .channels = 3, .type = CM_PIXEL_FLOAT, .little_endian = 1},
    {.kind = CM_PNM_RAW, .channels = 2, .type = CM_PIXEL_HALF, .little_endian = 1},
    {.kind = CM_PNM_RAW, .channels = 3, .type = CM_PIXEL_FLOAT},
};

enum
{
    CASES = sizeof cases / sizeof cases[0]
};

static cm_status read_one(cm_pnm_reader *reader, cm_pnm_picture *picture, bool *more)
{
    const cm_status status = cm_pnm_next(reader, picture, more, message);
    if (status != CM_OK || !*more)
    {
        return status;
    }
    const size_t row = (size_t)picture->width * picture->channels * cm_pixel_size(picture->type);
    REQUIRE(row * picture->height <= sizeof got, "%u x %u", picture->width, picture->height);
    return picture->bottom_up
               ? cm_pnm_read(reader, picture->height, got + row * (picture->height - 1),
                             -(ptrdiff_t)row, message)
               : cm_pnm_read(reader, picture->height, got, 0, message);
}

/* Three pictures, one after another. */
START_TEST(test_round_trips)
{
    for (size_t i = 0; i < CASES; i++)
    {
        cm_pnm_picture picture = cases[i];
        picture.size = sizeof picture;
        const cm_image image = make_image(picture.type, picture.channels);
        memory_stream memory = {file, 0, ROOM, 0};
        cm_image_stream stream = stream_of(&memory);
        stream.seek = NULL;
        stream.size = NULL;
        for (int copy = 0; copy < 3; copy++)
        {
            REQUIRE(cm_pnm_write(&stream, &picture, &image, message) == CM_OK, "%s", message);
        }
        memory.at = 0;
        stream.read = read_slowly;
        cm_pnm_reader reader = {.size = sizeof reader, .stream = &stream};
        cm_pnm_picture read = {.size = sizeof read};
        if (picture.kind == CM_PNM_RAW)
        {
            read = picture;
            read.width = WIDTH;
            read.height = HEIGHT;
        }
        bool more = true;
        for (int copy = 0; copy < 3; copy++)
        {
            REQUIRE(read_one(&reader, &read, &more) == CM_OK && more, "%zu: %s", i, message);
            const size_t size =
                (size_t)WIDTH * HEIGHT * picture.channels * cm_pixel_size(picture.type);
            REQUIRE(read.kind == picture.kind && read.width == WIDTH && read.height == HEIGHT &&
                        read.channels == picture.channels && read.type == picture.type &&
                        read.alpha == picture.alpha && memcmp(got, pixels, size) == 0,
                    "case %zu, copy %d", i, copy);
        }
        REQUIRE(read_one(&reader, &read, &more) == CM_OK && !more, "the end: %s", message);
    }
}
END_TEST

static cm_status read_text(const char *text, size_t size, cm_pnm_picture *read)
{
    memory_stream memory = {(unsigned char *)(uintptr_t)text, size, size, 0};
    const cm_image_stream stream = stream_of(&memory);
    cm_pnm_reader reader = {.size = sizeof reader, .stream = &stream};
    bool more = false;
    *read = (cm_pnm_picture){.size = sizeof *read};
    message[0] = '\0';
    return read_one(&reader, read, &more);
}

/* By the specifications: comments, other largest values, the high byte first; PFM's rows from the lowest. */
START_TEST(test_bytes)
{
    cm_pnm_picture read;
    static const char grey[] = "P5 # made by hand\n#\n2\t1 15\n\x0f\x05";
    REQUIRE(read_text(grey, sizeof grey - 1, &read) == CM_OK, "%s", message);
    REQUIRE(read.maximum == 15 && got[0] == 255 && got[1] == 85, "%u %u", got[0], got[1]);
    static const char wide[] = "P5\n1 1\n1000\n\x03\xe8";
    REQUIRE(read_text(wide, sizeof wide - 1, &read) == CM_OK, "%s", message);
    uint16_t word;
    memcpy(&word, got, 2);
    ck_assert_uint_eq(word, 65535);
    static const char pam[] =
        "P7\n# c\nWIDTH 1\nHEIGHT 1\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\nabcd";
    REQUIRE(read_text(pam, sizeof pam - 1, &read) == CM_OK && read.alpha == 1 &&
                memcmp(got, "abcd", 4) == 0,
            "%s", message);
    static const char pfm[] = "Pf\n1 2\n-1.0\n\0\0\0\x40\0\0\x80\x3f"; /* 2 below 1 */
    REQUIRE(read_text(pfm, sizeof pfm - 1, &read) == CM_OK, "%s", message);
    float numbers[2];
    memcpy(numbers, got, sizeof numbers);
    REQUIRE(numbers[0] == 1.0F && numbers[1] == 2.0F, "%g %g", (double)numbers[0],
            (double)numbers[1]);
}
END_TEST

START_TEST(test_written_bytes)
{
    const uint16_t words[2] = {0x0102, 0xfffe};
    const cm_image image = {.size = sizeof image,
                            .data = (void *)(uintptr_t)words,
                            .type = CM_PIXEL_U16,
                            .width = 2,
                            .height = 1,
                            .channels = 1};
    const cm_pnm_picture picture = {.size = sizeof picture, .kind = CM_PNM_PGM};
    memory_stream memory = {file, 0, ROOM, 0};
    const cm_image_stream stream = stream_of(&memory);
    static const char wanted[] = "P5\n2 1\n65535\n\x01\x02\xff\xfe";
    REQUIRE(cm_pnm_write(&stream, &picture, &image, message) == CM_OK, "%s", message);
    REQUIRE(memory.size == sizeof wanted - 1 && memcmp(file, wanted, memory.size) == 0, "bytes");
    cm_pnm_picture noted = picture;
    noted.comments = "# one\n# two\n";
    static const char longer[] = "P5\n# one\n# two\n2 1\n65535\n\x01\x02\xff\xfe";
    memory = (memory_stream){file, 0, ROOM, 0};
    REQUIRE(cm_pnm_write(&stream, &noted, &image, message) == CM_OK, "%s", message);
    REQUIRE(memory.size == sizeof longer - 1 && memcmp(file, longer, memory.size) == 0, "comments");
    const float light = 1.0F;
    cm_image one = image;
    one.data = (void *)(uintptr_t)&light;
    one.type = CM_PIXEL_FLOAT;
    one.width = 1;
    noted.kind = CM_PNM_PFM;
    memory = (memory_stream){file, 0, ROOM, 0};
    REQUIRE(cm_pnm_write(&stream, &noted, &one, message) == CM_OK, "%s", message);
    REQUIRE(memcmp(file, "Pf\n1 1\n", 7) == 0, "PFM has no comments");
}
END_TEST

START_TEST(test_wrong)
{
    static const char *const texts[] = {"P4\n1 1\nx",
                                        "P5\n0 1\n255\n",
                                        "P5\n1 1\n65536\n",
                                        "P5\n1 99999999999\n255\n",
                                        "P5\n1 -1\n255\n",
                                        "P5\n1 1\n15\n\x10",
                                        "Pf\n1 1\n0\n\1\1\1\1",
                                        "Pf\n1 1\n1e99\n\1\1\1\1",
                                        "P7\nWIDTH 1\nHEIGHT 1\nDEPTH 1\nENDHDR\nx",
                                        "P7\nWIDTH 1\nDEPTH 65\n",
                                        "P7\nNAME 1\n",
                                        "P7 \nWIDTH 1\n",
                                        "P6\n1048576 1048577\n255\n",
                                        "GIF89a",
                                        "P6\n1 1\n12345678901234567890\n"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
    {
        cm_pnm_picture read;
        REQUIRE(read_text(texts[i], strlen(texts[i]), &read) == CM_ERROR_UNSUPPORTED &&
                    strlen(message) > 10 && strpbrk(message, "\r\n") == NULL,
                "%zu: '%s'", i, message);
    }
}
END_TEST

START_TEST(test_truncated)
{
    for (size_t i = 0; i < CASES; i++)
    {
        cm_pnm_picture picture = cases[i];
        picture.size = sizeof picture;
        const cm_image image = make_image(picture.type, picture.channels);
        memory_stream memory = {file, 0, ROOM, 0};
        cm_image_stream stream = stream_of(&memory);
        REQUIRE(cm_pnm_write(&stream, &picture, &image, message) == CM_OK, "%s", message);
        const size_t size = memory.size;
        for (size_t cut = 1; cut < size; cut++)
        {
            memory = (memory_stream){file, cut, cut, 0};
            cm_pnm_reader reader = {.size = sizeof reader, .stream = &stream};
            cm_pnm_picture read = picture;
            read.width = WIDTH;
            read.height = HEIGHT;
            bool more = false;
            REQUIRE(read_one(&reader, &read, &more) == CM_ERROR_UNSUPPORTED, "%zu of %zu", cut,
                    size);
            memory = (memory_stream){file, 0, cut, 0};
            REQUIRE(cm_pnm_write(&stream, &picture, &image, message) == CM_ERROR_UNSUPPORTED,
                    "room for %zu of %zu", cut, size);
        }
    }
}
END_TEST

START_TEST(test_lines_of_tags)
{
    static const char header[] = "P5\n# made by hand\n#\n# cubemap:\ncubemap:a=1\n"
                                 "#cubemap:b=2=3\n# cubemap:c=\n# cubemap:d=4";
    static const char *const wanted[][2] = {
        {"cubemap:b", "2=3"}, {"cubemap:c", ""}, {"cubemap:d", "4"}};
    const char *at = header;
    const char *const end = header + sizeof header - 1;
    cm_header_line line;
    for (size_t i = 0; i < 3; i++)
    {
        REQUIRE(cm_header_lines_next(&at, end, &line), "line %zu", i);
        REQUIRE(line.key_size == strlen(wanted[i][0]) &&
                    memcmp(line.key, wanted[i][0], line.key_size) == 0 &&
                    line.value_size == strlen(wanted[i][1]) &&
                    memcmp(line.value, wanted[i][1], line.value_size) == 0,
                "%.*s, not %s", (int)(line.key_size + 1 + line.value_size), line.key, wanted[i][0]);
    }
    REQUIRE(!cm_header_lines_next(&at, end, &line) && at == end, "one more");
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        test_round_trips,   test_bytes, test_written_bytes, test_wrong, test_truncated,
        test_lines_of_tags, NULL};
    return run_suite("pnm", tests);
}
