/* SPDX-License-Identifier: MIT */
#include "columns.h"

#include "harness.h"

#include "truth/sphere.h"

#include <stdlib.h>
#include <string.h>

enum
{
    ARRAYS = 20,
    PAGE =
        4096, /* addresses that are as many bytes apart, or twice as many, are in each other's way */
    LINE = 64,
    HEADER = 16 /* large blocks of malloc begin so far behind a page */
};

/* A part of a batch's memory, behind a gap of less than a page. */
static void *part_of(unsigned char **at, size_t bytes, uint64_t *state)
{
    unsigned char *const begin = *at + next_bits(state) % (PAGE / LINE) * LINE;
    *at = begin + (bytes + LINE - 1) / LINE * LINE;
    return begin;
}

void batch_scatter(batch *b, size_t room, uint64_t *state)
{
    const size_t bytes_a_point =
        9 * sizeof(double) + 8 * sizeof(float) + DIRECTIONS * sizeof(int) + 1;
    memset(b, 0, sizeof *b);
    b->memory = allocate(room * bytes_a_point + (ARRAYS + 1) * (PAGE + LINE), 1);
    unsigned char *at = b->memory;
    at += HEADER + PAGE - (uintptr_t)at % PAGE;
    for (int k = 0; k < 3; k++)
    {
        b->from[k] = part_of(&at, room * sizeof(double), state);
        b->back[k] = part_of(&at, room * sizeof(double), state);
        b->from_f32[k] = part_of(&at, room * sizeof(float), state);
        b->back_f32[k] = part_of(&at, room * sizeof(float), state);
    }
    for (int k = 0; k < 2; k++)
    {
        b->plane[k] = part_of(&at, room * sizeof(double), state);
        b->plane_f32[k] = part_of(&at, room * sizeof(float), state);
        b->status[k] = part_of(&at, room * sizeof(int), state);
    }
    b->face = part_of(&at, room, state);
    b->pixel = part_of(&at, room * sizeof(int64_t), state);
}

void batch_allocate(batch *b, size_t room)
{
    uint64_t state = 1;
    batch_scatter(b, room, &state);
}

void batch_free(batch *b)
{
    free(b->memory);
}

void batch_put(batch *b, size_t at, const double point[3])
{
    for (int k = 0; k < 3; k++)
    {
        b->from[k][at] = point[k];
        b->from_f32[k][at] = (float)point[k];
    }
}

void run_arrays(const cm_mapping *mapping, int narrow, batch *b, int direction)
{
    if (narrow && direction == FORWARD)
    {
        cm_forward_array_f32(mapping, b->count, b->from_f32[0], b->from_f32[1], b->from_f32[2],
                             b->face, b->plane_f32[0], b->plane_f32[1]);
    }
    else if (narrow)
    {
        cm_inverse_array_f32(mapping, b->count, b->face, b->plane_f32[0], b->plane_f32[1],
                             b->back_f32[0], b->back_f32[1], b->back_f32[2]);
    }
    else if (direction == FORWARD)
    {
        cm_forward_array(mapping, b->count, b->from[0], b->from[1], b->from[2], b->face,
                         b->plane[0], b->plane[1]);
    }
    else
    {
        cm_inverse_array(mapping, b->count, b->face, b->plane[0], b->plane[1], b->back[0],
                         b->back[1], b->back[2]);
    }
}

/* Of the batch a copy, which what is written to it cannot change: nobody's point pays for reading it again. */

static void forward_points(const cm_mapping *mapping, batch *b)
{
    const batch at = *b;
    for (size_t i = 0; i < at.count; i++)
    {
        const double direction[3] = {at.from[0][i], at.from[1][i], at.from[2][i]};
        double uv[2];
        at.face[i] = cm_forward(mapping, direction, uv);
        at.plane[0][i] = uv[0];
        at.plane[1][i] = uv[1];
    }
}

static void inverse_points(const cm_mapping *mapping, batch *b)
{
    const batch at = *b;
    for (size_t i = 0; i < at.count; i++)
    {
        const double uv[2] = {at.plane[0][i], at.plane[1][i]};
        double direction[3];
        cm_inverse(mapping, at.face[i], uv, direction);
        at.back[0][i] = direction[0];
        at.back[1][i] = direction[1];
        at.back[2][i] = direction[2];
    }
}

static void forward_points_f32(const cm_mapping *mapping, batch *b)
{
    const batch at = *b;
    for (size_t i = 0; i < at.count; i++)
    {
        const float direction[3] = {at.from_f32[0][i], at.from_f32[1][i], at.from_f32[2][i]};
        float uv[2];
        at.face[i] = cm_forward_f32(mapping, direction, uv);
        at.plane_f32[0][i] = uv[0];
        at.plane_f32[1][i] = uv[1];
    }
}

static void inverse_points_f32(const cm_mapping *mapping, batch *b)
{
    const batch at = *b;
    for (size_t i = 0; i < at.count; i++)
    {
        const float uv[2] = {at.plane_f32[0][i], at.plane_f32[1][i]};
        float direction[3];
        cm_inverse_f32(mapping, at.face[i], uv, direction);
        at.back_f32[0][i] = direction[0];
        at.back_f32[1][i] = direction[1];
        at.back_f32[2][i] = direction[2];
    }
}

void run_points(const cm_mapping *mapping, int narrow, batch *b, int direction)
{
    static void (*const one_by_one[DIRECTIONS][2])(const cm_mapping *, batch *) = {
        {forward_points, forward_points_f32}, {inverse_points, inverse_points_f32}};
    one_by_one[direction][narrow](mapping, b);
}
