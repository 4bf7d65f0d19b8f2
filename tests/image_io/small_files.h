/* SPDX-License-Identifier: MIT
 *
 * Image files byte by byte, by what the formats' documents say: TIFF 6.0, and OpenEXR's "File Layout". What reads them is
 * not asked how they should look.
 */
#ifndef TESTS_SMALL_FILES_H
#define TESTS_SMALL_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Pixels of the pages and parts below: so many columns and rows. */
enum
{
    SMALL_WIDTH = 5,
    SMALL_HEIGHT = 3
};

/* Of TIFF files. */
typedef struct small_tiff
{
    bool big_endian;
    bool big_tiff;
    uint32_t pages; /* grey, 8 bits; pixel i of page p is 16 p + i */
    bool
        geo_tags; /* of page p: scale p + 0.5, p + 0.25, 0, a tie point, three keys, a number, two texts */
    uint32_t cut; /* so many bytes are missing at the end */
} small_tiff;

/* Is it written? */
bool write_small_tiff(const char *path, const small_tiff *what);

/* OpenEXR of so many parts of rows, each with one channel, Y, of floats: pixel i of part p is 100 p + i. The display window
 * is one pixel wider than the data on each side. */
bool write_small_exr(const char *path, uint32_t parts);

/* TIFF with one row of numbers of 32 bits. */
bool write_wide_tiff(const char *path, const uint32_t *numbers, uint32_t count);

#endif
