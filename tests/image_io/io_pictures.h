/* SPDX-License-Identifier: MIT
 *
 * Pictures that tests of image files write and read, and what they expect of the table of functions.
 */
#ifndef TESTS_IO_PICTURES_H
#define TESTS_IO_PICTURES_H

#include "modules/image/io/image_io.h"
#include "tests/suite.h"

enum
{
    WIDTH = 45,
    HEIGHT = 37,
    CHANNELS_MOST = 5,
    BYTES_MOST = WIDTH * HEIGHT * CHANNELS_MOST * 4
};

typedef struct pixels
{
    _Alignas(8) unsigned char bytes[BYTES_MOST];
} pixels;

extern const cm_image_io *io;
extern char message[CM_IMAGE_MESSAGE];

/* Bytes of a channel. */
size_t size_of(cm_pixel_type type);

/* The message is said if it is not; otherwise, that the message is one line that says something. */
void expect_good(cm_status status, const char *what);
void expect_line(const char *what);
/* And has these words. */
void expect_failure(cm_status status, cm_status wanted, const char *words, const char *what);

/* A picture without alpha. */
cm_image_description describe(const char *format, cm_pixel_type type, uint32_t channels);

/* Any bits that are a number: halves and floats from 2^-13 to 2. */
void fill(pixels *of, cm_pixel_type type, uint32_t channels);

/* In bands of rows, as a program does. */
void write_picture(const char *path, const cm_image_description *description, const pixels *from);

/* The file's first picture. */
cm_image_reader *open_picture(const char *path);
void read_all(cm_image_reader *reader, cm_pixel_type type, void *to, const char *path);

/* The caller frees it. */
unsigned char *content_of(const char *path, size_t *size);

/* In a folder of their own, which must be empty in the end. Returns what main should. */
int run_in_folder(const char *suite, const TTest *const *tests);

#endif
