/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "whole_png.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

static const unsigned char signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

/* A chunk is its length, its name, its content and a check sum: is there one called IEND, and whole? */
static bool has_end(FILE *file, int64_t size)
{
    for (int64_t position = 8; position + 12 <= size;)
    {
        unsigned char head[8];
        if (fseeko(file, (off_t)position, SEEK_SET) != 0 || fread(head, 1, 8, file) != 8)
        {
            return false;
        }
        const uint32_t length = (uint32_t)head[0] << 24 | (uint32_t)head[1] << 16 |
                                (uint32_t)head[2] << 8 | (uint32_t)head[3];
        position += 12 + (int64_t)length;
        if (memcmp(head + 4, "IEND", 4) == 0 && position <= size)
        {
            return true;
        }
    }
    return false;
}

bool cm_png_is_whole(const char *path)
{
    FILE *const file = fopen(path, "rb");
    if (file == NULL)
    {
        return true;
    }
    unsigned char begin[8];
    bool whole = true;
    if (fread(begin, 1, 8, file) == 8 && memcmp(begin, signature, 8) == 0)
    {
        const int64_t size = fseeko(file, 0, SEEK_END) == 0 ? (int64_t)ftello(file) : -1;
        whole = has_end(file, size);
    }
    fclose(file);
    return whole;
}
