/* SPDX-License-Identifier: MIT
 *
 * Frames: any table, most of them nearly right. In those that are frames, forward follows from the
 * table: u, v are the warp of the ratios of the direction's components along the face's axes.
 */
#include "in_double.inc"
#include "fuzz_values.inc"

/* The texts may go away after creation, so nobody may look at them. */
static const char *const no_text = (const char *)(uintptr_t)1;

/* A right table: the outward axes in any order, the others any way round. */
static cm_frame take_frame(supply *from)
{
    cm_frame frame = {sizeof frame, no_text, no_text, take_byte(from) % 2 == 0 ? 1 : -1, {{0}}};
    signed char outward[6] = {1, -1, 2, -2, 3, -3};
    for (int i = 5; i >= 0; i--)
    {
        int chosen = take_byte(from) % (i + 1);
        uint8_t turn = take_byte(from);
        int axis = outward[chosen];
        int u = abs(axis) % 3 + 1;
        int v = u % 3 + 1;
        cm_frame_face *face = &frame.face[i];
        outward[chosen] = outward[i];
        face->name = no_text;
        face->outward = (signed char)axis;
        face->u = (signed char)((turn & 1 ? u : v) * (turn & 2 ? 1 : -1));
        face->v = (signed char)((turn & 1 ? v : u) * (turn & 4 ? 1 : -1));
    }
    return frame;
}

/* One number of it is made something else. */
static void spoil(supply *from, cm_frame *frame)
{
    uint8_t place = take_byte(from);
    cm_frame_face *face = &frame->face[place / 5 % 6];
    signed char value = (signed char)take_byte(from);
    switch (place % 5)
    {
    case 0:
        frame->size = (size_t)value;
        break;
    case 1:
        frame->first_row_v = value;
        break;
    case 2:
        face->outward = value;
        break;
    case 3:
        face->u = value;
        break;
    default:
        face->v = value;
        break;
    }
}

static int is_axis(int axis)
{
    return axis != 0 && axis >= -3 && axis <= 3;
}

static int is_frame(const cm_frame *frame)
{
    int good = frame->size == sizeof *frame && abs(frame->first_row_v) == 1;
    for (int i = 0; i < 6; i++)
    {
        const cm_frame_face *face = &frame->face[i];
        good = good && is_axis(face->outward) && is_axis(face->u) && is_axis(face->v) &&
               abs(face->outward) != abs(face->u) && abs(face->outward) != abs(face->v) &&
               abs(face->u) != abs(face->v);
        for (int k = 0; k < i; k++)
        {
            good = good && frame->face[k].outward != face->outward;
        }
    }
    return good;
}

/* The component along a signed axis. */
static double along(const double direction[3], int axis)
{
    return axis < 0 ? -direction[-axis - 1] : direction[axis - 1];
}

/* The signed axis of the largest component, the first if there are several. */
static int largest_axis(const double direction[3])
{
    int largest = 0;
    for (int k = 1; k < 3; k++)
    {
        largest = fabs(direction[k]) > fabs(direction[largest]) ? k : largest;
    }
    return direction[largest] < 0.0 ? -largest - 1 : largest + 1;
}

static void check_direction(const subject *made, const cm_frame *frame, const double direction[3])
{
    double uv[2];
    double back[3];
    double warped[2];
    uint8_t face = cm_forward(made->mapping, direction, uv);
    EXPECT((face < 6) == is_direction(direction) || is_partial(made), "%s: face %d",
           made->specification, face);
    if (face > 5)
    {
        return;
    }
    cm_inverse(made->mapping, face, uv, back);
    EXPECT(angle_of(direction, back) <= made->bound + (is_partial(made) ? 8e-9 : 0.0),
           "%s: %a %a %a: %d %a %a: %g rad", made->specification, direction[0], direction[1],
           direction[2], face, uv[0], uv[1], angle_of(direction, back));
    if (!is_hybrid(made))
    {
        const cm_frame_face *axes = &frame->face[face];
        double outward = along(direction, axes->outward);
        const double pq[2] = {along(direction, axes->u) / outward,
                              along(direction, axes->v) / outward};
        EXPECT(axes->outward == largest_axis(direction), "%s: %a %a %a: %d", made->specification,
               direction[0], direction[1], direction[2], face);
        EXPECT(cm_warp(made->mapping, pq, warped) == CM_OK && warped[0] == uv[0] &&
                   warped[1] == uv[1],
               "%s: %a %a %a: %d %a %a, not %a %a", made->specification, direction[0], direction[1],
               direction[2], face, uv[0], uv[1], warped[0], warped[1]);
    }
}

static void check_frame(supply *from, const cm_frame *frame)
{
    cm_mapping *mapping = NULL;
    cm_status expected = is_frame(frame) ? CM_OK : CM_ERROR_FRAME;
    EXPECT(cm_frame_check(frame) == expected, "status %d", cm_frame_check(frame));
    EXPECT(cm_mapping_create("gnomonic", frame, &mapping) == expected, "create does not agree");
    EXPECT((mapping != NULL) == (expected == CM_OK), "status %d", expected);
    cm_mapping_destroy(mapping);
    if (expected == CM_OK)
    {
        subject made = take_subject(from, frame);
        while (from->left > 0)
        {
            double direction[3];
            take_direction(from, direction);
            check_direction(&made, cm_mapping_frame(made.mapping), direction);
        }
        drop_subject(&made);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    uint8_t kind = take_byte(&from) % 4;
    cm_frame frame;
    if (kind == 0)
    {
        take_bytes(&from, &frame, sizeof frame);
        frame.size = sizeof frame;
    }
    else
    {
        frame = take_frame(&from);
    }
    if (kind == 1)
    {
        spoil(&from, &frame);
    }
    check_frame(&from, &frame);
    EXPECT(cm_frame_check(NULL) == CM_ERROR_ARGUMENT, "a frame of NULL");
    return 0;
}
