/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "io_pictures.h"

#include <errno.h>
#include <unistd.h>

const cm_image_io *io;
char message[CM_IMAGE_MESSAGE];

size_t size_of(cm_pixel_type type)
{
    return type == CM_PIXEL_U8 ? 1 : type == CM_PIXEL_FLOAT ? 4 : 2;
}

void expect_good(cm_status status, const char *what)
{
    REQUIRE(status == CM_OK, "%s: %s", what, message);
}

/* A line that says something. */
void expect_line(const char *what)
{
    REQUIRE(strlen(message) > 10 && strpbrk(message, "\r\n") == NULL, "%s: '%s'", what, message);
    message[0] = '\0';
}

void expect_failure(cm_status status, cm_status wanted, const char *words, const char *what)
{
    REQUIRE(status == wanted, "%s: status %d, '%s'", what, (int)status, message);
    REQUIRE(strstr(message, words) != NULL, "%s: '%s'", what, message);
    expect_line(what);
}

cm_image_description describe(const char *format, cm_pixel_type type, uint32_t channels)
{
    const cm_image_description description = {.format = format,
                                              .width = WIDTH,
                                              .height = HEIGHT,
                                              .channels = channels,
                                              .type = type,
                                              .alpha = -1,
                                              .alpha_multiplied = true};
    return description;
}

void fill(pixels *of, cm_pixel_type type, uint32_t channels)
{
    uint32_t state = 12345 + (uint32_t)type;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT * channels; i++)
    {
        state = state * 1664525 + 1013904223;
        const uint32_t bits = state >> 8;
        if (type == CM_PIXEL_U8)
        {
            of->bytes[i] = (unsigned char)bits;
        }
        else if (type == CM_PIXEL_FLOAT)
        {
            const float number = ldexpf((float)(bits | 1), -23);
            memcpy(of->bytes + 4 * i, &number, 4);
        }
        else
        {
            const uint16_t number =
                type == CM_PIXEL_HALF ? (uint16_t)(0x0800 + bits % 0x3800) : (uint16_t)bits;
            memcpy(of->bytes + 2 * i, &number, 2);
        }
    }
}

void write_picture(const char *path, const cm_image_description *description, const pixels *from)
{
    cm_image_writer *writer = NULL;
    expect_good(io->create(path, NULL, description, &writer, message), path);
    const size_t row = WIDTH * description->channels * size_of(description->type);
    for (uint32_t first = 0; first < HEIGHT; first += 10)
    {
        const uint32_t end = first + 10 < HEIGHT ? first + 10 : HEIGHT;
        expect_good(io->write(writer, first, end, description->type, from->bytes + row * first, 0,
                              0, message),
                    path);
    }
    expect_good(io->finish(writer, message), path);
    io->drop(writer);
}

cm_image_reader *open_picture(const char *path)
{
    cm_image_reader *reader = NULL;
    expect_good(io->open(path, 0, &reader, message), path);
    return reader;
}

void read_all(cm_image_reader *reader, cm_pixel_type type, void *to, const char *path)
{
    const cm_image_description *of = io->describe(reader);
    const cm_image_region all = {0, 0, of->width, of->height};
    expect_good(io->read(reader, &all, type, to, 0, message), path);
}

unsigned char *content_of(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    ck_assert_ptr_nonnull(file);
    fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    unsigned char *content = malloc(*size + 1);
    ck_assert(content != NULL && fread(content, 1, *size, file) == *size);
    fclose(file);
    return content;
}

int run_in_folder(const char *suite, const TTest *const *tests)
{
    char folder[] = "/tmp/image-io-XXXXXX";
    if (mkdtemp(folder) == NULL || chdir(folder) != 0)
    {
        perror(folder);
        return 1;
    }
    io = cm_image_io_get(message);
    if (io == NULL)
    {
        printf("%s\n", message);
        return 1;
    }
    const int status = run_suite(suite, tests);
    if (chdir("/") != 0 || rmdir(folder) != 0)
    {
        printf("%s: %s\n", folder, strerror(errno));
        return 1;
    }
    return status;
}
