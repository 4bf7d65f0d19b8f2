/* SPDX-License-Identifier: MIT
 *
 * The frames, and what follows from their tables.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "frame_turn.h"
#include "catalogue_words.h"

#include <stdlib.h>
#include <string.h>

#define X CM_AXIS_X
#define Y CM_AXIS_Y
#define Z CM_AXIS_Z

static const cm_frame frames[] = {
    {
        sizeof(cm_frame),
        "geo",
        "x through lon 0, y through 90 E, z north; front right back left top bottom",
        +1,
        {
            {"front", +X, +Y, +Z},
            {"right", +Y, -X, +Z},
            {"back", -X, -Y, +Z},
            {"left", -Y, +X, +Z},
            {"top", +Z, +Y, -X},
            {"bottom", -Z, +Y, +X},
        },
    },
    {
        sizeof(cm_frame),
        "gl",
        "cube map of OpenGL, Vulkan, Direct3D: +x -x +y -y +z -z, v down",
        -1,
        {
            {"+x", +X, -Z, -Y},
            {"-x", -X, +Z, -Y},
            {"+y", +Y, +X, +Z},
            {"-y", -Y, +X, -Z},
            {"+z", +Z, +X, -Y},
            {"-z", -Z, -X, -Y},
        },
    },
    {
        sizeof(cm_frame),
        "fits",
        "FITS WCS paper II: 0 top, 1..4 equatorial from lon 0 eastward, 5 bottom; axes as geo",
        +1,
        {
            {"top", +Z, +Y, -X},
            {"front", +X, +Y, +Z},
            {"right", +Y, -X, +Z},
            {"back", -X, -Y, +Z},
            {"left", -Y, +X, +Z},
            {"bottom", -Z, +Y, +X},
        },
    },
    {
        sizeof(cm_frame),
        "s2",
        "S2 geometry library: +x +y +z -x -y -z, each turned so that a curve runs through all six",
        +1,
        {
            {"0", +X, +Y, +Z},
            {"1", +Y, -X, +Z},
            {"2", +Z, -X, -Y},
            {"3", -X, -Z, -Y},
            {"4", -Y, -Z, +X},
            {"5", -Z, +Y, +X},
        },
    },
};

#undef X
#undef Y
#undef Z

size_t cm_frame_count(void)
{
    return sizeof frames / sizeof frames[0];
}

const cm_frame *cm_frame_at(size_t index)
{
    return index < cm_frame_count() ? &frames[index] : NULL;
}

const cm_frame *cm_frame_find(const char *identifier)
{
    if (identifier == NULL)
    {
        return NULL;
    }
    for (size_t i = 0; i < cm_frame_count(); i++)
    {
        const char *name = frames[i].identifier;
        if (cm_word_equal(name, strlen(name), identifier, strlen(identifier)))
        {
            return &frames[i];
        }
    }
    return NULL;
}

/* 0..5 for +x +y -x -y +z -z, the numbers of the faces of geo; -1 for no axis */
static int geo_face_of(int axis)
{
    switch (axis)
    {
    case CM_AXIS_X:
        return 0;
    case CM_AXIS_Y:
        return 1;
    case -CM_AXIS_X:
        return 2;
    case -CM_AXIS_Y:
        return 3;
    case CM_AXIS_Z:
        return 4;
    case -CM_AXIS_Z:
        return 5;
    default:
        return -1;
    }
}

cm_status cm_frame_check(const cm_frame *frame)
{
    if (frame == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (frame->size != sizeof(cm_frame) || (frame->first_row_v != 1 && frame->first_row_v != -1))
    {
        return CM_ERROR_FRAME;
    }
    unsigned seen = 0;
    for (int i = 0; i < 6; i++)
    {
        const cm_frame_face *face = &frame->face[i];
        int outward = geo_face_of(face->outward);
        if (outward < 0 || geo_face_of(face->u) < 0 || geo_face_of(face->v) < 0 ||
            abs(face->outward) == abs(face->u) || abs(face->outward) == abs(face->v) ||
            abs(face->u) == abs(face->v))
        {
            return CM_ERROR_FRAME;
        }
        seen |= 1u << outward;
    }
    return seen == 0x3fu ? CM_OK : CM_ERROR_FRAME;
}

static void fill_turn_face(int swap, uint64_t minus_a, uint64_t minus_b, unsigned face,
                           cm_turn_face *turn)
{
    const uint32_t signs[2] = {(uint32_t)minus_a << 31, (uint32_t)minus_b << 31};
    *turn = (cm_turn_face){.swap = {swap ? UINT64_MAX : 0, swap ? UINT64_MAX : 0},
                           .minus_f64 = {minus_a << 63, minus_b << 63},
                           .minus_f32 = {signs[0], signs[1], signs[0], signs[1]},
                           .face = face};
}

static void fill_turn_axes(const cm_frame_face *face, unsigned number, cm_turn_axes *turn)
{
    const int axis[3] = {face->u, face->v, face->outward};
    turn->face = number;
    for (int k = 0; k < 3; k++)
    {
        turn->axis[k] = (uint32_t)abs(axis[k]) - 1;
        turn->minus_f64[k] = (uint64_t)(axis[k] < 0) << 63;
        turn->minus_f32[k == 2 ? 4 : k] = (uint32_t)(axis[k] < 0) << 31;
    }
    turn->minus_f32[2] = turn->minus_f32[0];
    turn->minus_f32[3] = turn->minus_f32[1];
}

static void fill_turn_ahead(const cm_turn_axes *axes, cm_turn_ahead *turn)
{
    for (int lane = 0; lane < 4; lane++)
    {
        const int k = lane % 2;
        turn->of_f32[axes->axis[k]][lane] = UINT32_MAX;
        turn->minus_f32[lane] = axes->minus_f32[k];
        turn->of_f64[axes->axis[k]][k] = UINT64_MAX;
        turn->minus_f64[k] = axes->minus_f64[k];
    }
}

void cm_turn_from_frame(const cm_frame *frame, cm_turn *turn)
{
    const cm_frame *geo = cm_frame_find("geo");
    *turn = (cm_turn){.identity = 1};
    for (unsigned i = 0; i < 6; i++)
    {
        const cm_frame_face *to = &frame->face[i];
        unsigned g = (unsigned)geo_face_of(to->outward);
        const cm_frame_face *from = &geo->face[g];
        int swap = abs(to->u) != abs(from->u);
        int first = swap ? from->v : from->u;
        int second = swap ? from->u : from->v;
        uint64_t minus_u = to->u != first;
        uint64_t minus_v = to->v != second;
        turn->swap_bits |= (uint64_t)swap << (63u - g);
        turn->minus_u_bits |= minus_u << (63u - g);
        turn->minus_v_bits |= minus_v << (63u - g);
        turn->face_digits |= (uint64_t)i << (3u * g);
        turn->swap_back_bits |= (uint64_t)swap << (63u - i);
        turn->minus_u_back_bits |= minus_u << (63u - i);
        turn->minus_v_back_bits |= minus_v << (63u - i);
        turn->geo_face_digits |= (uint64_t)g << (3u * i);
        fill_turn_face(swap, minus_u, minus_v, i, &turn->to_frame[g]);
        fill_turn_face(swap, swap ? minus_v : minus_u, swap ? minus_u : minus_v, g,
                       &turn->to_geo[i]);
        fill_turn_axes(to, i, &turn->axes[i]);
        const int ahead = 2 * (3 - abs(to->outward)) + (to->outward < 0);
        fill_turn_ahead(&turn->axes[i], &turn->ahead[ahead]);
        turn->face_ahead[ahead] = (uint8_t)i;
        if (i != g || swap || minus_u || minus_v)
        {
            turn->identity = 0;
        }
    }
}
