/* SPDX-License-Identifier: MIT
 *
 * Frames: the tables, and that the faces meet where they should.
 */
#include "tests/suite.h"

typedef struct axes
{
    signed char of[3]; /* outward, u, v */
} axes;

static axes axes_of(const cm_frame *frame, int face)
{
    const cm_frame_face *table = &frame->face[face];
    return (axes){{table->outward, table->u, table->v}};
}

static void add_axis(double direction[3], signed char axis, double length)
{
    direction[abs(axis) - 1] += axis > 0 ? length : -length;
}

START_TEST(tables_are_frames)
{
    static const char *const names[] = {"geo", "gl", "fits", "s2"};
    ck_assert_uint_eq(cm_frame_count(), 4);
    ck_assert_ptr_null(cm_frame_at(4));
    for (size_t i = 0; i < 4; i++)
    {
        const cm_frame *frame = cm_frame_find(names[i]);
        ck_assert_ptr_nonnull(frame);
        ck_assert_ptr_eq(frame, cm_frame_at(i));
        ck_assert_int_eq(cm_frame_check(frame), CM_OK);
    }
    ck_assert_ptr_eq(cm_frame_find("GL"), cm_frame_find("gl"));
    ck_assert_ptr_null(cm_frame_find("geos"));
    ck_assert_ptr_null(cm_frame_find(NULL));
}
END_TEST

START_TEST(broken_tables_are_refused)
{
    cm_mapping *mapping = NULL;
    cm_frame frame = *cm_frame_find("geo");
    ck_assert_int_eq(cm_frame_check(NULL), CM_ERROR_ARGUMENT);
    frame.face[2].outward = CM_AXIS_X; /* twice */
    ck_assert_int_eq(cm_frame_check(&frame), CM_ERROR_FRAME);
    ck_assert_int_eq(cm_mapping_create("qsc", &frame, &mapping), CM_ERROR_FRAME);
    ck_assert_ptr_null(mapping);
    frame = *cm_frame_find("geo");
    frame.face[2].u = CM_AXIS_X; /* along outward */
    ck_assert_int_eq(cm_frame_check(&frame), CM_ERROR_FRAME);
    frame = *cm_frame_find("geo");
    frame.face[2].v = frame.face[2].u;
    ck_assert_int_eq(cm_frame_check(&frame), CM_ERROR_FRAME);
    frame = *cm_frame_find("geo");
    frame.face[0].v = 4;
    ck_assert_int_eq(cm_frame_check(&frame), CM_ERROR_FRAME);
    frame = *cm_frame_find("geo");
    frame.first_row_v = 0;
    ck_assert_int_eq(cm_frame_check(&frame), CM_ERROR_FRAME);
    frame = *cm_frame_find("geo");
    frame.size = 3;
    ck_assert_int_eq(cm_frame_check(&frame), CM_ERROR_FRAME);
    static const signed char no_axes[] = {0, 4, -4, 100, -100};
    for (size_t i = 0; i < 4 * sizeof no_axes / sizeof no_axes[0]; i++)
    {
        frame = *cm_frame_find("geo");
        cm_frame_face *face = &frame.face[3];
        /* a word that is no axis in each place, or v along outward */
        switch (i % 4)
        {
        case 0:
            face->outward = no_axes[i / 4];
            break;
        case 1:
            face->u = no_axes[i / 4];
            break;
        case 2:
            face->v = no_axes[i / 4];
            break;
        default:
            face->v = -face->outward;
            break;
        }
        ck_assert_int_eq(cm_frame_check(&frame), CM_ERROR_FRAME);
    }
}
END_TEST

/* With right-handed axes every frame's pictures show the sphere from outside: to the right (u) times
 * up (v, or -v where the first row is v = -1) is outward. */
START_TEST(handedness)
{
    for (size_t i = 0; i < cm_frame_count(); i++)
    {
        const cm_frame *frame = cm_frame_at(i);
        for (int f = 0; f < 6; f++)
        {
            double u[3] = {0.0, 0.0, 0.0};
            double up[3] = {0.0, 0.0, 0.0};
            double outward[3] = {0.0, 0.0, 0.0};
            double triple = 0.0;
            add_axis(outward, axes_of(frame, f).of[0], 1.0);
            add_axis(u, axes_of(frame, f).of[1], 1.0);
            add_axis(up, axes_of(frame, f).of[2], frame->first_row_v);
            for (int k = 0; k < 3; k++)
            {
                int l = (k + 1) % 3;
                int m = (k + 2) % 3;
                triple += (u[l] * up[m] - u[m] * up[l]) * outward[k];
            }
            ck_assert_msg(triple == 1.0, "%s face %d", frame->identifier, f);
        }
    }
}
END_TEST

/* the direction of any (u, v) on a face of gnomonic is outward + u * axis + v * axis */
START_TEST(forward_and_inverse_follow_the_table)
{
    uint64_t state = 11;
    for (size_t i = 0; i < cm_frame_count(); i++)
    {
        const cm_frame *frame = cm_frame_at(i);
        cm_mapping *mapping = make_mapping("gnomonic", frame);
        for (int n = 0; n < 6000; n++)
        {
            int f = n % 6;
            double uv[2] = {0.999 * next_real(&state), 0.999 * next_real(&state)};
            double expected[3] = {0.0, 0.0, 0.0};
            double direction[3];
            double back[2];
            add_axis(expected, axes_of(frame, f).of[0], 1.0);
            add_axis(expected, axes_of(frame, f).of[1], uv[0]);
            add_axis(expected, axes_of(frame, f).of[2], uv[1]);
            cm_inverse(mapping, (uint8_t)f, uv, direction);
            ck_assert(angle_between(direction, expected) < 4e-16);
            ck_assert_int_eq(cm_forward(mapping, expected, back), f);
            ck_assert(back[0] == uv[0] && back[1] == uv[1]);
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* A step over the edge of a face, for every mapping, frame, face and edge: the neighbour is the face
 * whose outward axis is the one that was crossed, and both faces give the edge's point the same
 * direction. */
static void check_edge(const cm_mapping *mapping, int face, int edge, double along)
{
    const cm_frame *frame = cm_mapping_frame(mapping);
    const axes own = axes_of(frame, face);
    double uv[2];
    double here[3];
    double there[3];
    int upper = edge & 1;
    uv[edge >> 1] = upper ? 1.0 : -1.0;
    uv[1 - (edge >> 1)] = along;
    signed char crossed = (signed char)((upper ? 1 : -1) * own.of[1 + (edge >> 1)]);
    signed char beside = own.of[2 - (edge >> 1)];
    int neighbour = 0;
    while (axes_of(frame, neighbour).of[0] != crossed)
    {
        neighbour++;
    }
    /* on the neighbour the same point: one coordinate at the end that looks to us, the other along */
    const axes theirs = axes_of(frame, neighbour);
    double other[2];
    for (int k = 0; k < 2; k++)
    {
        signed char axis = theirs.of[1 + k];
        other[k] = axis == own.of[0]    ? 1.0
                   : axis == -own.of[0] ? -1.0
                   : axis == beside     ? along
                                        : -along;
    }
    cm_inverse(mapping, (uint8_t)face, uv, here);
    cm_inverse(mapping, (uint8_t)neighbour, other, there);
    /* by how much a torn edge's sides may part */
    double tear = cm_mapping_describe(mapping)->smooth_edge == CM_SMOOTH_TORN ? 0.04 : 0.0;
    ck_assert_msg(angle_between(here, there) < tear + 2e-15, "%s %s face %d edge %d at %g: %g rad",
                  cm_mapping_describe(mapping)->identifier, frame->identifier, face, edge, along,
                  angle_between(here, there));
    /* a hair outside, along the normal of the edge, is the neighbour */
    double step[3];
    double back[2];
    for (int k = 0; k < 3; k++)
    {
        step[k] = here[k];
    }
    add_axis(step, crossed, 1e-9);
    add_axis(step, (signed char)-own.of[0], 1e-9);
    ck_assert_int_eq(cm_forward(mapping, step, back), neighbour);
    ck_assert(fabs(back[0] - other[0]) < tear + 1e-7 && fabs(back[1] - other[1]) < tear + 1e-7);
}

START_TEST(edges_meet_the_right_neighbour)
{
    for (size_t m = 0; m < cube_count(); m++)
    {
        for (size_t i = 0; i < cm_frame_count(); i++)
        {
            cm_mapping *mapping = make_mapping(cm_catalogue_at(m)->identifier, cm_frame_at(i));
            for (int n = 0; n < 24; n++)
            {
                for (int k = -9; k <= 9; k += 2)
                {
                    check_edge(mapping, n / 4, n % 4, k / 10.0);
                }
            }
            cm_mapping_destroy(mapping);
        }
    }
}
END_TEST

/* A frame of one's own: the cube seen with z as the first face. */
START_TEST(custom_frame)
{
    cm_frame frame = {sizeof frame,
                      "mine",
                      "a test",
                      1,
                      {{"a", CM_AXIS_Z, CM_AXIS_X, -CM_AXIS_Y},
                       {"b", -CM_AXIS_Z, -CM_AXIS_X, CM_AXIS_Y},
                       {"c", CM_AXIS_Y, CM_AXIS_Z, CM_AXIS_X},
                       {"d", -CM_AXIS_Y, CM_AXIS_Z, CM_AXIS_X},
                       {"e", -CM_AXIS_X, CM_AXIS_Y, CM_AXIS_Z},
                       {"f", CM_AXIS_X, CM_AXIS_Z, -CM_AXIS_Y}}};
    cm_mapping *mapping = make_mapping("coupled", &frame);
    memset(frame.face, 0, sizeof frame.face); /* the table was copied */
    const double direction[3] = {0.1, -0.2, 1.0};
    double uv[2];
    double back[3];
    ck_assert_int_eq(cm_forward(mapping, direction, uv), 0);
    ck_assert(uv[0] > 0.0 && uv[1] > uv[0]);
    cm_inverse(mapping, 0, uv, back);
    ck_assert(earth_metres(direction, back) < 2e-9);
    cm_mapping_destroy(mapping);
}
END_TEST

/* geo with u, or with v, the other way */
START_TEST(frames_that_differ_in_one_axis_only)
{
    for (int axis = 0; axis < 2; axis++)
    {
        cm_frame frame = *cm_frame_find("geo");
        for (int i = 0; i < 6; i++)
        {
            signed char *turned_axis = axis == 0 ? &frame.face[i].u : &frame.face[i].v;
            *turned_axis = (signed char)-*turned_axis;
        }
        cm_mapping *turned = make_mapping("coupled", &frame);
        cm_mapping *plain = make_mapping("coupled", NULL);
        uint64_t state = 23;
        for (int i = 0; i < 1000; i++)
        {
            double direction[3];
            double uv[2];
            double plain_uv[2];
            double back[3];
            next_direction(&state, direction);
            uint8_t face = cm_forward(turned, direction, uv);
            ck_assert_int_eq(cm_forward(plain, direction, plain_uv), face);
            ck_assert(uv[axis] == -plain_uv[axis] && uv[1 - axis] == plain_uv[1 - axis]);
            cm_inverse(turned, face, uv, back);
            ck_assert(earth_metres(direction, back) < 5e-9);
        }
        cm_mapping_destroy(turned);
        cm_mapping_destroy(plain);
    }
}
END_TEST

int main(void)
{
    const TTest *tests[] = {tables_are_frames,
                            broken_tables_are_refused,
                            handedness,
                            forward_and_inverse_follow_the_table,
                            edges_meet_the_right_neighbour,
                            custom_frame,
                            frames_that_differ_in_one_axis_only,
                            NULL};
    return run_suite("frames", tests);
}
