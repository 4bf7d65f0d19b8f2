/* SPDX-License-Identifier: MIT */
#include "npy_head.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

enum
{
    BEFORE_WORDS = 10 /* magic, version, length of 16 bits */
};

size_t cm_npy_head(const char *type, size_t rank, const uint64_t *shape, char *head)
{
    char *const words = head + BEFORE_WORDS;
    const size_t room = CM_NPY_HEAD - BEFORE_WORDS;
    size_t size =
        (size_t)snprintf(words, room, "{'descr': '%s', 'fortran_order': False, 'shape': (", type);
    for (size_t i = 0; i < rank; i++)
    {
        size += (size_t)snprintf(words + size, room - size,
                                 i + 1 < rank ? "%" PRIu64 ", " : "%" PRIu64, shape[i]);
    }
    size += (size_t)snprintf(words + size, room - size, rank == 1 ? ",), }" : "), }");
    /* the numbers begin at a multiple of 64 */
    const size_t blanks = 63 - (BEFORE_WORDS + size) % 64;
    memset(words + size, ' ', blanks);
    size += blanks;
    words[size++] = '\n';
    memcpy(head, "\x93NUMPY\x01\x00", 8);
    head[8] = (char)(size % 256);
    head[9] = (char)(size / 256);
    return BEFORE_WORDS + size;
}
