/* SPDX-License-Identifier: MIT
 *
 * Arrays: any length, any offset, results over the arguments, any stride, any number of threads, and
 * Jacobians; equal to single points to the bit. Read by arrays_double.c and arrays_float.c, which name
 * the functions.
 *
 * Every array ends where its memory ends, so that the address sanitizer sees what goes beyond it.
 */
#include "values.h"

#include <cubemap/threads.h>

enum
{
    COUNT_MAX = 600, /* more than two blocks of the library */
    OFFSETS = 9,
    STRIDE_MAX = 9,
    DIFFERENT = 24 /* so many points are the input's own; the others are hard ones in a row */
};

#define GUARD ((REAL)77)
#define FACE_GUARD 77

/* Points: of arrays of so many numbers each, all that there is. */
typedef struct points
{
    size_t count;
    size_t offset; /* elements before the first one, which are guards */
    uint8_t *face;
    REAL *column[3];
} points;

static REAL *make_numbers(size_t count)
{
    REAL *numbers = malloc(count * sizeof(REAL) + (count == 0));
    EXPECT(numbers != NULL, "no memory");
    for (size_t i = 0; i < count; i++)
    {
        numbers[i] = GUARD;
    }
    return numbers;
}

static points make_points(size_t count, size_t offset)
{
    points made = {.count = count, .offset = offset};
    made.face = malloc(count + offset + (count + offset == 0));
    EXPECT(made.face != NULL, "no memory");
    memset(made.face, FACE_GUARD, count + offset);
    made.face += offset;
    for (int k = 0; k < 3; k++)
    {
        made.column[k] = make_numbers(count + offset) + offset;
    }
    return made;
}

static void drop_points(const points *made)
{
    free(made->face - made->offset);
    for (int k = 0; k < 3; k++)
    {
        free(made->column[k] - made->offset);
    }
}

static void expect_guards(const points *made)
{
    for (size_t i = 1; i <= made->offset; i++)
    {
        EXPECT(made->face[-(ptrdiff_t)i] == FACE_GUARD && made->column[0][-(ptrdiff_t)i] == GUARD &&
                   made->column[1][-(ptrdiff_t)i] == GUARD &&
                   made->column[2][-(ptrdiff_t)i] == GUARD,
               "written before the array");
    }
}

static void copy_points(const points *from, const points *to)
{
    memcpy(to->face, from->face, from->count);
    for (int k = 0; k < 3; k++)
    {
        memcpy(to->column[k], from->column[k], from->count * sizeof(REAL));
    }
}

/* Faces and the first columns, to the bit. */
static void expect_same(const subject *made, const points *expected, const uint8_t *face,
                        REAL *const column[3], int columns)
{
    for (size_t i = 0; i < expected->count; i++)
    {
        EXPECT(face[i] == expected->face[i], "%s: face %zu of %zu: %d, alone %d",
               made->specification, i, expected->count, face[i], expected->face[i]);
        for (int k = 0; k < columns; k++)
        {
            EXPECT(memcmp(&column[k][i], &expected->column[k][i], sizeof(REAL)) == 0,
                   "%s: number %d of point %zu of %zu: %a, alone %a", made->specification, k, i,
                   expected->count, (double)column[k][i], (double)expected->column[k][i]);
        }
    }
}

/* Directions in the columns, or points of faces in the first two of them and in face. */
static void fill_points(supply *from, const points *made, int inverse)
{
    uint32_t start = take_word(from);
    for (size_t i = 0; i < made->count; i++)
    {
        REAL value[3] = {GUARD, GUARD, GUARD};
        if (i < DIFFERENT && from->left > 0)
        {
            made->face[i] = inverse ? take_face(from) : CM_NO_FACE;
            (inverse ? take_point : take_direction)(from, value);
        }
        else
        {
            made->face[i] = (uint8_t)(i % 7);
            (inverse ? HARD_POINT : HARD_DIRECTION)(start + 977 * i, value);
        }
        for (int k = 0; k < 3; k++)
        {
            made->column[k][i] = value[k];
        }
    }
}

/* The results, point by point. */
static void map_alone(const subject *made, const points *input, const points *output, int inverse)
{
    for (size_t i = 0; i < input->count; i++)
    {
        const REAL value[3] = {input->column[0][i], input->column[1][i], input->column[2][i]};
        REAL result[3] = {GUARD, GUARD, GUARD};
        output->face[i] = input->face[i];
        if (inverse)
        {
            INVERSE(made->mapping, input->face[i], value, result);
        }
        else
        {
            output->face[i] = FORWARD(made->mapping, value, result);
        }
        for (int k = 0; k < 3; k++)
        {
            output->column[k][i] = result[k];
        }
    }
}

/* Each of the results goes over an argument, or into a column of its own. */
static void choose_places(supply *from, const points *input, int inputs, const points *own,
                          REAL *place[3])
{
    int taken[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++)
    {
        int over = take_byte(from) % 4;
        place[k] = own->column[k];
        if (over < inputs && !taken[over])
        {
            place[k] = input->column[over];
            taken[over] = 1;
        }
    }
}

/* What is not written is as it was. */
static void expect_arguments(const points *input, const points *before, REAL *const place[3],
                             int results)
{
    for (int k = 0; k < 3; k++)
    {
        int written = 0;
        for (int r = 0; r < results; r++)
        {
            written |= place[r] == input->column[k];
        }
        EXPECT(written ||
                   memcmp(input->column[k], before->column[k], input->count * sizeof(REAL)) == 0,
               "an argument was changed");
    }
}

/* Arrays in chunks, for cm_run_threads. */
typedef struct split
{
    const subject *made;
    const points *input;
    uint8_t *face;
    REAL *const *place;
    int inverse;
} split;

static void map_chunk(size_t begin, size_t end, void *user)
{
    const split *s = user;
    const points *input = s->input;
    if (s->inverse)
    {
        INVERSE_ARRAY(s->made->mapping, end - begin, input->face + begin, input->column[0] + begin,
                      input->column[1] + begin, s->place[0] + begin, s->place[1] + begin,
                      s->place[2] + begin);
    }
    else
    {
        FORWARD_ARRAY(s->made->mapping, end - begin, input->column[0] + begin,
                      input->column[1] + begin, input->column[2] + begin, s->face + begin,
                      s->place[0] + begin, s->place[1] + begin);
    }
}

/* At once; by the function with threads, which makes none for so few points; or in chunks of 64. */
static void call_arrays(const subject *made, uint8_t way, const points *input, uint8_t *face,
                        REAL *const place[3], int inverse)
{
    split whole = {made, input, face, place, inverse};
    unsigned threads = way / 3;
    size_t n = input->count;
    if (way % 3 == 0)
    {
        map_chunk(0, n, &whole);
    }
    else if (way % 3 == 1)
    {
        cm_run_threads(threads % 8, n, 64, map_chunk, &whole);
    }
    else if (inverse)
    {
        INVERSE_ARRAY_THREADS(made->mapping, threads, n, input->face, input->column[0],
                              input->column[1], place[0], place[1], place[2]);
    }
    else
    {
        FORWARD_ARRAY_THREADS(made->mapping, threads, n, input->column[0], input->column[1],
                              input->column[2], face, place[0], place[1]);
    }
}

static void check_arrays(const subject *made, supply *from, const points *input,
                         const points *expected, int inverse)
{
    points own = make_points(input->count, take_byte(from) % OFFSETS);
    points before = make_points(input->count, 0);
    REAL *place[3];
    copy_points(input, &before);
    choose_places(from, input, inverse ? 2 : 3, &own, place);
    call_arrays(made, take_byte(from), input, own.face, place, inverse);
    expect_same(made, expected, inverse ? input->face : own.face, place, inverse ? 3 : 2);
    expect_arguments(input, &before, place, inverse ? 3 : 2);
    expect_guards(&own);
    expect_guards(input);
    copy_points(&before, input);
    drop_points(&before);
    drop_points(&own);
}

/* Directions so many elements apart, from the last to the first if stride is negative. */
typedef struct strided
{
    size_t size;
    REAL *memory;
    REAL *first;
} strided;

static strided make_strided(size_t count, ptrdiff_t stride)
{
    size_t span = count == 0 ? 0 : (count - 1) * (size_t)llabs(stride);
    strided made = {.size = count == 0 ? 0 : span + 3};
    made.memory = make_numbers(made.size);
    made.first = made.memory + (stride < 0 ? span : 0);
    return made;
}

/* stride may be less than 3 here, and directions share numbers then. */
static void check_forward_strided(const subject *made, supply *from, const points *input)
{
    ptrdiff_t stride = take_byte(from) % (2 * STRIDE_MAX + 1) - STRIDE_MAX;
    strided packed = make_strided(input->count, stride);
    points expected = make_points(input->count, 0);
    points read = make_points(input->count, 0);
    for (int pass = 0; pass < 2; pass++)
    {
        for (size_t i = 0; i < input->count; i++)
        {
            for (int k = 0; k < 3; k++)
            {
                REAL *number = packed.first + (ptrdiff_t)i * stride + k;
                *number = pass == 0 ? input->column[k][i] : *number;
                read.column[k][i] = *number;
            }
        }
    }
    map_alone(made, &read, &expected, 0);
    FORWARD_STRIDED(made->mapping, input->count, packed.first, stride, read.face, read.column[0],
                    read.column[1]);
    expect_same(made, &expected, read.face, read.column, 2);
    FORWARD_STRIDED_THREADS(made->mapping, take_byte(from), input->count, packed.first, stride,
                            read.face, read.column[0], read.column[1]);
    expect_same(made, &expected, read.face, read.column, 2);
    drop_points(&read);
    drop_points(&expected);
    free(packed.memory);
}

static void check_inverse_strided(const subject *made, supply *from, const points *input,
                                  const points *expected)
{
    ptrdiff_t stride = 3 + take_byte(from) % (STRIDE_MAX - 2);
    stride = take_byte(from) % 2 == 0 ? stride : -stride;
    strided packed = make_strided(input->count, stride);
    uint8_t threads = take_byte(from);
    if (threads % 2 == 0)
    {
        INVERSE_STRIDED(made->mapping, input->count, input->face, input->column[0],
                        input->column[1], packed.first, stride);
    }
    else
    {
        INVERSE_STRIDED_THREADS(made->mapping, threads, input->count, input->face, input->column[0],
                                input->column[1], packed.first, stride);
    }
    for (size_t i = 0; i < input->count; i++)
    {
        for (int k = 0; k < 3; k++)
        {
            REAL *number = packed.first + (ptrdiff_t)i * stride + k;
            EXPECT(memcmp(number, &expected->column[k][i], sizeof *number) == 0,
                   "%s: stride %td: number %d of point %zu of %zu: %a, alone %a",
                   made->specification, stride, k, i, input->count, (double)*number,
                   (double)expected->column[k][i]);
            *number = GUARD;
        }
    }
    for (size_t i = 0; i < packed.size; i++)
    {
        EXPECT(packed.memory[i] == GUARD, "written between the points");
    }
    free(packed.memory);
}

/* ---- Jacobians ---- */

/* Six arrays of their own, in two sets of points. */
static void call_jacobians(const subject *made, uint8_t way, const points *input, REAL *const to[6],
                           int inverse)
{
    size_t n = input->count;
    REAL *const *column = input->column;
    if (inverse && way % 2 == 0)
    {
        INVERSE_JACOBIAN_ARRAY(made->mapping, n, input->face, column[0], column[1], to);
    }
    else if (inverse)
    {
        INVERSE_JACOBIAN_ARRAY_THREADS(made->mapping, way, n, input->face, column[0], column[1],
                                       to);
    }
    else if (way % 2 == 0)
    {
        FORWARD_JACOBIAN_ARRAY(made->mapping, n, column[0], column[1], column[2], to);
    }
    else
    {
        FORWARD_JACOBIAN_ARRAY_THREADS(made->mapping, way, n, column[0], column[1], column[2], to);
    }
}

/* NaN if the point is none; and a number if it is one and its mapping has no edge without slope. */
static void expect_jacobian(const subject *made, const REAL value[3], const REAL jacobian[6],
                            int good)
{
    for (int k = 0; k < 6; k++)
    {
        EXPECT(good ? isfinite(jacobian[k]) || !made->standard || is_one_face(made)
                    : isnan(jacobian[k]),
               "%s: %a %a %a: %d of the Jacobian is %a", made->specification, (double)value[0],
               (double)value[1], (double)value[2], k, (double)jacobian[k]);
    }
}

static void check_jacobians(const subject *made, supply *from, const points *input, int inverse)
{
    points first = make_points(input->count, take_byte(from) % OFFSETS);
    points second = make_points(input->count, take_byte(from) % OFFSETS);
    REAL *const to[6] = {first.column[0],  first.column[1],  first.column[2],
                         second.column[0], second.column[1], second.column[2]};
    call_jacobians(made, take_byte(from), input, to, inverse);
    for (size_t i = 0; i < input->count; i++)
    {
        const REAL value[3] = {input->column[0][i], input->column[1][i], input->column[2][i]};
        REAL jacobian[6];
        if (inverse)
        {
            INVERSE_JACOBIAN(made->mapping, input->face[i], value, jacobian);
        }
        else
        {
            FORWARD_JACOBIAN(made->mapping, value, jacobian);
        }
        expect_jacobian(made, value, jacobian,
                        inverse ? input->face[i] < 6 && is_point(value) : is_direction(value));
        for (int k = 0; k < 6; k++)
        {
            EXPECT(memcmp(&to[k][i], &jacobian[k], sizeof(REAL)) == 0,
                   "%s: %d of Jacobian %zu of %zu: %a, alone %a", made->specification, k, i,
                   input->count, (double)to[k][i], (double)jacobian[k]);
        }
    }
    expect_guards(&first);
    expect_guards(&second);
    drop_points(&first);
    drop_points(&second);
}

/* ---- Distortion ---- */

/* Columns that are given, of two sets of points; the others are not wanted. */
static void check_distortion(const subject *made, supply *from, const points *input, int inverse)
{
    points into = make_points(input->count, take_byte(from) % OFFSETS);
    const DISTORTION_ARRAYS to = {
        .deformation = into.column[0], .isotropy = into.column[1], .texel_area = into.column[2]};
    size_t n = input->count;
    if (inverse)
    {
        INVERSE_DISTORTION_ARRAY(made->mapping, n, input->face, input->column[0], input->column[1],
                                 &to);
    }
    else
    {
        FORWARD_DISTORTION_ARRAY(made->mapping, n, input->column[0], input->column[1],
                                 input->column[2], &to);
    }
    for (size_t i = 0; i < n; i++)
    {
        const REAL value[3] = {input->column[0][i], input->column[1][i], input->column[2][i]};
        int good = inverse ? input->face[i] < 6 && is_point(value) : is_direction(value);
        DISTORTION d;
        if (inverse)
        {
            INVERSE_DISTORTION(made->mapping, input->face[i], value, &d);
        }
        else
        {
            FORWARD_DISTORTION(made->mapping, value, &d);
        }
        EXPECT(good ? (d.isotropy >= 1 && isfinite(d.texel_area)) || !made->standard ||
                          is_one_face(made)
                    : isnan(d.isotropy) && isnan(d.major) && isnan(d.orientation),
               "%s: %a %a %a: isotropy %a", made->specification, (double)value[0], (double)value[1],
               (double)value[2], (double)d.isotropy);
        EXPECT(memcmp(&into.column[0][i], &d.deformation, sizeof(REAL)) == 0 &&
                   memcmp(&into.column[1][i], &d.isotropy, sizeof(REAL)) == 0 &&
                   memcmp(&into.column[2][i], &d.texel_area, sizeof(REAL)) == 0,
               "%s: distortion %zu of %zu is another alone", made->specification, i, n);
    }
    expect_guards(&into);
    drop_points(&into);
}

/* ---- Warps ---- */

/* Into columns of their own, equal to single points to the bit; nothing where there is no warp. */
static void check_warps(const subject *made, supply *from, const points *input)
{
    points warped = make_points(input->count, take_byte(from) % OFFSETS);
    points first = make_points(input->count, take_byte(from) % OFFSETS);
    points second = make_points(input->count, 0);
    REAL *const to[4] = {first.column[0], first.column[1], second.column[0], second.column[1]};
    size_t n = input->count;
    cm_status expected = is_hybrid(made) ? CM_ERROR_UNSUPPORTED : CM_OK;
    EXPECT(WARP_ARRAY(made->mapping, n, input->column[0], input->column[1], warped.column[0],
                      warped.column[1]) == expected &&
               UNWARP_ARRAY(made->mapping, n, input->column[0], input->column[1], first.column[2],
                            second.column[2]) == expected &&
               WARP_JACOBIAN_ARRAY(made->mapping, n, input->column[0], input->column[1], to) ==
                   expected,
           "%s: a warp, or none", made->specification);
    for (size_t i = 0; i < n; i++)
    {
        const REAL pq[2] = {input->column[0][i], input->column[1][i]};
        REAL uv[2] = {GUARD, GUARD};
        REAL back[2] = {GUARD, GUARD};
        REAL jacobian[4] = {GUARD, GUARD, GUARD, GUARD};
        EXPECT(WARP(made->mapping, pq, uv) == expected &&
                   UNWARP(made->mapping, pq, back) == expected &&
                   WARP_JACOBIAN(made->mapping, pq, jacobian) == expected,
               "%s: alone another status", made->specification);
        int same = memcmp(&uv[0], &warped.column[0][i], sizeof(REAL)) == 0 &&
                   memcmp(&uv[1], &warped.column[1][i], sizeof(REAL)) == 0 &&
                   memcmp(&back[0], &first.column[2][i], sizeof(REAL)) == 0 &&
                   memcmp(&back[1], &second.column[2][i], sizeof(REAL)) == 0;
        for (int k = 0; k < 4; k++)
        {
            same &= memcmp(&jacobian[k], &to[k][i], sizeof(REAL)) == 0;
        }
        EXPECT(same, "%s: warp %zu of %zu is another alone", made->specification, i, n);
    }
    expect_guards(&warped);
    expect_guards(&first);
    drop_points(&second);
    drop_points(&first);
    drop_points(&warped);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    subject made = take_subject(&from, NULL);
    uint8_t many = take_byte(&from) % 4;
    size_t count = take_word(&from) % (many == 0 ? COUNT_MAX + 1 : DIFFERENT);
    int inverse = take_byte(&from) % 2;
    points input = make_points(count, take_byte(&from) % OFFSETS);
    points expected = make_points(count, 0);
    fill_points(&from, &input, inverse);
    map_alone(&made, &input, &expected, inverse);
    check_arrays(&made, &from, &input, &expected, inverse);
    if (inverse)
    {
        check_inverse_strided(&made, &from, &input, &expected);
    }
    else
    {
        check_forward_strided(&made, &from, &input);
    }
    check_jacobians(&made, &from, &input, inverse);
    check_distortion(&made, &from, &input, inverse);
    check_warps(&made, &from, &input);
    drop_points(&expected);
    drop_points(&input);
    drop_subject(&made);
    return 0;
}
