/* SPDX-License-Identifier: MIT
 *
 * Signs of zero, NaN, infinities, and what is just outside: what <cubemap/mapping.h> and
 * <cubemap/direction.h> promise, function by function and argument by argument.
 *
 * The tests speak double. A function in float gets its arguments narrowed and its results are
 * widened; both keep the sign of zero, and what a NaN is.
 */
#include "tests/suite.h"

#include "truth/parameter_ends.h"

#include <float.h>

#define HALF_PI 1.5707963267948966 /* and PI are the doubles below the true values */
#define PI 3.141592653589793
#define TOLERANCE 1e-9

/* ---- Numbers ---- */

static int same_bits(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static int same_sign(double a, double b)
{
    return !signbit(a) == !signbit(b);
}

static int all_nan(const double *values, int count)
{
    int all = 1;
    for (int i = 0; i < count; i++)
    {
        all &= isnan(values[i]) != 0;
    }
    return all;
}

/* The float next to a number; of a NaN the sign, whether it is quiet, and part of its payload, where
 * a conversion would make a quiet one of every NaN. */
static float narrow(double value)
{
    if (!isnan(value))
    {
        return (float)value;
    }
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    uint32_t low = (bits & 0x1fffffffu) != 0;
    uint32_t few = (uint32_t)(bits >> 63 << 31 | (bits >> 29 & 0x7fffffu)) | 0x7f800000u | low;
    float result;
    memcpy(&result, &few, sizeof result);
    return result;
}

static void narrow_all(int count, const double *from, float *to)
{
    for (int i = 0; i < count; i++)
    {
        to[i] = narrow(from[i]);
    }
}

static void widen_all(int count, const float *from, double *to)
{
    for (int i = 0; i < count; i++)
    {
        to[i] = (double)from[i];
    }
}

/* What is no number of every kind, or the far ends of those that are, and some in between. */
enum
{
    SPECIAL_NUMBERS = 21,
    SPECIALS = SPECIAL_NUMBERS + 6
};

static double special(size_t which)
{
    static const double numbers[SPECIAL_NUMBERS] = {
        0.0,      -0.0,  1.0,  -1.0, 0.5,      -0.75, 5e-324,  -5e-324,  1e-310,   -DBL_MIN, 1e-300,
        -1.5e-45, 1e-40, 1e-8, 1e38, -FLT_MAX, 1e300, DBL_MAX, -DBL_MAX, INFINITY, -INFINITY};
    static const uint64_t nans[SPECIALS - SPECIAL_NUMBERS] = {
        0x7ff8000000000000u, 0xfff8000000000000u, /* quiet */
        0x7ff4000000000000u, 0xfff4000000000000u, /* signalling */
        0x7ff0000000000001u, 0xffffffffffffffffu  /* the ends of what is a NaN */
    };
    double result = 0.0;
    if (which < SPECIAL_NUMBERS)
    {
        return numbers[which];
    }
    memcpy(&result, &nans[which - SPECIAL_NUMBERS], sizeof result);
    return result;
}

/* ---- Functions under test ---- */

typedef struct forward_function
{
    const char *name;
    int is_float;
    uint8_t (*call)(const cm_mapping *mapping, const double direction[3], double uv[2]);
} forward_function;

typedef struct inverse_function
{
    const char *name;
    int is_float;
    void (*call)(const cm_mapping *mapping, uint8_t face, const double uv[2], double direction[3]);
} inverse_function;

typedef struct warp_function
{
    const char *name;
    int is_float;
    cm_status (*call)(const cm_mapping *mapping, const double from[2], double to[2]);
} warp_function;

/* In arrays the point stands between two others, which must not mind. */
#define BESIDE 0.25

static uint8_t forward_f32(const cm_mapping *mapping, const double direction[3], double uv[2])
{
    float from[3];
    float to[2] = {7.0f, 7.0f};
    narrow_all(3, direction, from);
    uint8_t face = cm_forward_f32(mapping, from, to);
    widen_all(2, to, uv);
    return face;
}

static uint8_t forward_array(const cm_mapping *mapping, const double direction[3], double uv[2])
{
    double x[3] = {BESIDE, direction[0], BESIDE};
    double y[3] = {BESIDE, direction[1], BESIDE};
    double z[3] = {1.0, direction[2], 1.0};
    double u[3];
    double v[3];
    uint8_t face[3];
    cm_forward_array(mapping, 3, x, y, z, face, u, v);
    REQUIRE(face[0] < 6 && face[0] == face[2] && u[0] == u[2] && v[0] == v[2], "neighbours");
    uv[0] = u[1];
    uv[1] = v[1];
    return face[1];
}

static uint8_t forward_array_f32(const cm_mapping *mapping, const double direction[3], double uv[2])
{
    float x[3] = {(float)BESIDE, narrow(direction[0]), (float)BESIDE};
    float y[3] = {(float)BESIDE, narrow(direction[1]), (float)BESIDE};
    float z[3] = {1.0f, narrow(direction[2]), 1.0f};
    float u[3];
    float v[3];
    uint8_t face[3];
    cm_forward_array_f32(mapping, 3, x, y, z, face, u, v);
    REQUIRE(face[0] < 6 && face[0] == face[2] && u[0] == u[2] && v[0] == v[2], "neighbours");
    uv[0] = (double)u[1];
    uv[1] = (double)v[1];
    return face[1];
}

static uint8_t forward_strided(const cm_mapping *mapping, const double direction[3], double uv[2])
{
    double xyz[8] = {direction[0], direction[1], direction[2], (double)NAN,
                     BESIDE,       BESIDE,       1.0,          (double)NAN};
    double u[2];
    double v[2];
    uint8_t face[2];
    cm_forward_strided(mapping, 2, xyz, 4, face, u, v);
    REQUIRE(face[1] < 6 && fabs(u[1]) < 1.0 && fabs(v[1]) < 1.0, "neighbour");
    uv[0] = u[0];
    uv[1] = v[0];
    return face[0];
}

static uint8_t forward_strided_f32(const cm_mapping *mapping, const double direction[3],
                                   double uv[2])
{
    float xyz[8] = {0.0f, 0.0f, 0.0f, (float)NAN, (float)BESIDE, (float)BESIDE, 1.0f, (float)NAN};
    float u[2];
    float v[2];
    uint8_t face[2];
    narrow_all(3, direction, xyz);
    cm_forward_strided_f32(mapping, 2, xyz, 4, face, u, v);
    REQUIRE(face[1] < 6 && fabsf(u[1]) < 1.0f && fabsf(v[1]) < 1.0f, "neighbour");
    uv[0] = (double)u[0];
    uv[1] = (double)v[0];
    return face[0];
}

/* the result over the argument */
static uint8_t forward_in_place(const cm_mapping *mapping, const double direction[3], double uv[2])
{
    double point[3] = {direction[0], direction[1], direction[2]};
    uint8_t face = cm_forward(mapping, point, point);
    memcpy(uv, point, 2 * sizeof uv[0]);
    return face;
}

static uint8_t forward_in_place_f32(const cm_mapping *mapping, const double direction[3],
                                    double uv[2])
{
    float point[3];
    narrow_all(3, direction, point);
    uint8_t face = cm_forward_f32(mapping, point, point);
    widen_all(2, point, uv);
    return face;
}

static const forward_function forward_functions[] = {
    {"cm_forward", 0, cm_forward},
    {"cm_forward_f32", 1, forward_f32},
    {"cm_forward_array", 0, forward_array},
    {"cm_forward_array_f32", 1, forward_array_f32},
    {"cm_forward_strided", 0, forward_strided},
    {"cm_forward_strided_f32", 1, forward_strided_f32},
    {"cm_forward in place", 0, forward_in_place},
    {"cm_forward_f32 in place", 1, forward_in_place_f32},
};

static void inverse_f32(const cm_mapping *mapping, uint8_t face, const double uv[2],
                        double direction[3])
{
    float from[2];
    float to[3];
    narrow_all(2, uv, from);
    cm_inverse_f32(mapping, face, from, to);
    widen_all(3, to, direction);
}

static void inverse_array(const cm_mapping *mapping, uint8_t face, const double uv[2],
                          double direction[3])
{
    const uint8_t faces[3] = {1, face, 1};
    double u[3] = {BESIDE, uv[0], BESIDE};
    double v[3] = {BESIDE, uv[1], BESIDE};
    double xyz[3][3];
    cm_inverse_array(mapping, 3, faces, u, v, xyz[0], xyz[1], xyz[2]);
    for (int k = 0; k < 3; k++)
    {
        REQUIRE(fabs(xyz[k][0]) <= 1.0 && xyz[k][0] == xyz[k][2], "neighbours");
        direction[k] = xyz[k][1];
    }
}

static void inverse_array_f32(const cm_mapping *mapping, uint8_t face, const double uv[2],
                              double direction[3])
{
    const uint8_t faces[3] = {1, face, 1};
    float u[3] = {(float)BESIDE, narrow(uv[0]), (float)BESIDE};
    float v[3] = {(float)BESIDE, narrow(uv[1]), (float)BESIDE};
    float xyz[3][3];
    cm_inverse_array_f32(mapping, 3, faces, u, v, xyz[0], xyz[1], xyz[2]);
    for (int k = 0; k < 3; k++)
    {
        REQUIRE(fabsf(xyz[k][0]) <= 1.0f && xyz[k][0] == xyz[k][2], "neighbours");
        direction[k] = (double)xyz[k][1];
    }
}

static void inverse_strided(const cm_mapping *mapping, uint8_t face, const double uv[2],
                            double direction[3])
{
    const uint8_t faces[2] = {face, 1};
    double u[2] = {uv[0], BESIDE};
    double v[2] = {uv[1], BESIDE};
    double xyz[8] = {7.0, 7.0, 7.0, 7.0, 7.0, 7.0, 7.0, 7.0};
    cm_inverse_strided(mapping, 2, faces, u, v, xyz, 4);
    REQUIRE(fabs(xyz[4]) <= 1.0 && xyz[3] == 7.0 && xyz[7] == 7.0, "neighbour");
    memcpy(direction, xyz, 3 * sizeof xyz[0]);
}

static void inverse_strided_f32(const cm_mapping *mapping, uint8_t face, const double uv[2],
                                double direction[3])
{
    const uint8_t faces[2] = {face, 1};
    float u[2] = {narrow(uv[0]), (float)BESIDE};
    float v[2] = {narrow(uv[1]), (float)BESIDE};
    float xyz[8] = {7.0f, 7.0f, 7.0f, 7.0f, 7.0f, 7.0f, 7.0f, 7.0f};
    cm_inverse_strided_f32(mapping, 2, faces, u, v, xyz, 4);
    REQUIRE(fabsf(xyz[4]) <= 1.0f && xyz[3] == 7.0f && xyz[7] == 7.0f, "neighbour");
    widen_all(3, xyz, direction);
}

static void inverse_in_place(const cm_mapping *mapping, uint8_t face, const double uv[2],
                             double direction[3])
{
    memcpy(direction, uv, 2 * sizeof uv[0]);
    cm_inverse(mapping, face, direction, direction);
}

static void inverse_in_place_f32(const cm_mapping *mapping, uint8_t face, const double uv[2],
                                 double direction[3])
{
    float point[3];
    narrow_all(2, uv, point);
    cm_inverse_f32(mapping, face, point, point);
    widen_all(3, point, direction);
}

static const inverse_function inverse_functions[] = {
    {"cm_inverse", 0, cm_inverse},
    {"cm_inverse_f32", 1, inverse_f32},
    {"cm_inverse_array", 0, inverse_array},
    {"cm_inverse_array_f32", 1, inverse_array_f32},
    {"cm_inverse_strided", 0, inverse_strided},
    {"cm_inverse_strided_f32", 1, inverse_strided_f32},
    {"cm_inverse in place", 0, inverse_in_place},
    {"cm_inverse_f32 in place", 1, inverse_in_place_f32},
};

static cm_status warp_f32(const cm_mapping *mapping, const double from[2], double to[2])
{
    float narrow_from[2];
    float narrow_to[2] = {narrow(to[0]), narrow(to[1])};
    narrow_all(2, from, narrow_from);
    cm_status status = cm_warp_f32(mapping, narrow_from, narrow_to);
    widen_all(2, narrow_to, to);
    return status;
}

static cm_status unwarp_f32(const cm_mapping *mapping, const double from[2], double to[2])
{
    float narrow_from[2];
    float narrow_to[2] = {narrow(to[0]), narrow(to[1])};
    narrow_all(2, from, narrow_from);
    cm_status status = cm_unwarp_f32(mapping, narrow_from, narrow_to);
    widen_all(2, narrow_to, to);
    return status;
}

static const warp_function warp_functions[] = {{"cm_warp", 0, cm_warp},
                                               {"cm_warp_f32", 1, warp_f32},
                                               {"cm_unwarp", 0, cm_unwarp},
                                               {"cm_unwarp_f32", 1, unwarp_f32}};

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* An argument as the function sees it. */
static double as_seen(int is_float, double value)
{
    return is_float ? (double)narrow(value) : value;
}

/* ---- Mappings and frames ---- */

/* the parameters where a formula changes */
static const char *const variants[] = {"tangent:c=0.5", "tanh:c=0.5", "logistic:c=1"};

/* a frame of one's own: geo with u and v exchanged, counted backwards */
static cm_frame exchanged_frame(void)
{
    cm_frame frame = *cm_frame_find("geo");
    frame.identifier = "exchanged";
    for (int i = 0; i < 6; i++)
    {
        const cm_frame_face *face = &cm_frame_find("geo")->face[5 - i];
        frame.face[i] = (cm_frame_face){face->name, face->outward, face->v, face->u};
    }
    return frame;
}

/* Call check for every mapping, every variant and every end of a parameter, in every frame and in that one; unless it is
 * the long run, in every second of them, others for the next, and the ends, which are many, in one each. */
static void for_every_variant(void (*check)(const cm_mapping *))
{
    const cm_frame exchanged = exchanged_frame();
    const size_t frames = cm_frame_count() + 1;
    const parameter_ends ends = list_parameter_ends();
    for (size_t i = 0; i < COUNT(variants) + ends.count + cube_count(); i++)
    {
        const size_t end = i - COUNT(variants);
        const char *specification = i < COUNT(variants) ? variants[i]
                                    : end < ends.count
                                        ? ends.specification[end]
                                        : cm_catalogue_at(end - ends.count)->identifier;
        const int is_end = i >= COUNT(variants) && end < ends.count;
        const size_t step = long_step_of(is_end ? frames : 2, frames);
        for (size_t f = i % step; f < frames; f += step)
        {
            cm_mapping *mapping =
                make_mapping(specification, f < cm_frame_count() ? cm_frame_at(f) : &exchanged);
            check(mapping);
            cm_mapping_destroy(mapping);
        }
    }
}

static const char *name_of(const cm_mapping *mapping)
{
    return cm_mapping_describe(mapping)->identifier;
}

static const cm_frame_face *face_of(const cm_mapping *mapping, int face)
{
    return &cm_mapping_frame(mapping)->face[face];
}

static int is_hybrid(const cm_mapping *mapping)
{
    return cm_mapping_describe(mapping)->family == CM_FAMILY_HYBRID;
}

/* the two coordinates of continuous are not alike */
static int is_alike(const cm_mapping *mapping)
{
    return strcmp(name_of(mapping), "continuous") != 0 && strcmp(name_of(mapping), "arvo") != 0;
}

/* What a direction has along a signed axis. */
static double along(const double direction[3], int axis)
{
    return axis > 0 ? direction[axis - 1] : -direction[-axis - 1];
}

static void put_along(double direction[3], int axis, double value)
{
    direction[abs(axis) - 1] = axis > 0 ? value : -value;
}

/* ---- Directions ---- */

/* The face that the header promises for a good direction; -1 where healpix is within rounding errors
 * of the boundary of its caps. */
static int promised_face(const cm_mapping *mapping, const double direction[3])
{
    double size[3] = {fabs(direction[0]), fabs(direction[1]), fabs(direction[2])};
    long double largest = fmax(fmax(size[0], size[1]), size[2]);
    int axis = size[0] == (double)largest ? 1 : size[1] == (double)largest ? 2 : 3;
    if (is_hybrid(mapping))
    {
        long double x = size[0] / largest;
        long double y = size[1] / largest;
        long double z = size[2] / largest;
        long double beyond = 3.0L * z - 2.0L * sqrtl(x * x + y * y + z * z);
        axis = beyond > 0.0L ? 3 : size[0] >= size[1] ? 1 : 2;
        if (fabsl(beyond) < 1e-5L)
        {
            return -1;
        }
    }
    int outward = signbit(direction[axis - 1]) ? -axis : axis;
    int face = 0;
    while (face_of(mapping, face)->outward != outward)
    {
        face++;
    }
    return face;
}

/* Both coordinates have the signs of the direction's components, zeros included. */
static void check_good_direction(const cm_mapping *mapping, const forward_function *function,
                                 const double seen[3], uint8_t face, const double uv[2])
{
    int promised = promised_face(mapping, seen);
    REQUIRE(face < 6 && (face == promised || promised < 0) && fabs(uv[0]) <= 1.0 &&
                fabs(uv[1]) <= 1.0,
            "%s of %s, %s: %g %g %g: face %d, not %d, %g %g", function->name, name_of(mapping),
            cm_mapping_frame(mapping)->identifier, seen[0], seen[1], seen[2], face, promised, uv[0],
            uv[1]);
    REQUIRE(same_sign(uv[0], along(seen, face_of(mapping, face)->u)) &&
                same_sign(uv[1], along(seen, face_of(mapping, face)->v)),
            "%s of %s, %s: %g %g %g: face %d, %g %g: a sign", function->name, name_of(mapping),
            cm_mapping_frame(mapping)->identifier, seen[0], seen[1], seen[2], face, uv[0], uv[1]);
    double back[3];
    (function->is_float ? inverse_f32 : cm_inverse)(mapping, face, uv, back);
    for (int k = 0; k < 3; k++)
    {
        REQUIRE(fabs(back[k]) <= 1.0 && same_sign(back[k], seen[k]),
                "%s of %s, %s, and back: %g %g %g: %g %g %g", function->name, name_of(mapping),
                cm_mapping_frame(mapping)->identifier, seen[0], seen[1], seen[2], back[0], back[1],
                back[2]);
    }
}

static void check_direction(const cm_mapping *mapping, const forward_function *function,
                            const double direction[3])
{
    double seen[3];
    double uv[2] = {7.0, 7.0};
    int finite = 1;
    int zero = 1;
    for (int k = 0; k < 3; k++)
    {
        seen[k] = as_seen(function->is_float, direction[k]);
        finite &= isfinite(seen[k]) != 0;
        zero &= seen[k] == 0.0;
    }
    uint8_t face = function->call(mapping, direction, uv);
    if (finite && !zero)
    {
        check_good_direction(mapping, function, seen, face, uv);
    }
    else
    {
        REQUIRE(face == CM_NO_FACE && all_nan(uv, 2), "%s of %s: %g %g %g: face %d, %g %g",
                function->name, name_of(mapping), seen[0], seen[1], seen[2], face, uv[0], uv[1]);
    }
}

static void check_directions(const cm_mapping *mapping)
{
    for (size_t n = 0; n < SPECIALS * SPECIALS * SPECIALS; n++)
    {
        const double direction[3] = {special(n % SPECIALS), special(n / SPECIALS % SPECIALS),
                                     special(n / SPECIALS / SPECIALS)};
        for (size_t i = 0; i < COUNT(forward_functions); i++)
        {
            check_direction(mapping, &forward_functions[i], direction);
        }
    }
}

START_TEST(every_component_of_a_direction)
{
    for_every_variant(check_directions);
}
END_TEST

/* ---- Points of a face ---- */

/* 1 + 1e-9 is the edge; what follows it is nothing */
static double coordinate(size_t which)
{
    static const double magnitudes[] = {
        1.0 + 0x1p-52, 1.0 + 0x1p-23, 1.0 + 1e-12,   1.0 + 1e-10, 1.0 + TOLERANCE,
        1.0 + 1.1e-9,  1.0 + 1e-6,    1.0 + 0x1p-24, 2.0,         0.999};
    if (which < SPECIALS)
    {
        return special(which);
    }
    if (which < SPECIALS + 2)
    {
        double after = nextafter(1.0 + TOLERANCE, 2.0);
        return which % 2 ? after : -after;
    }
    double magnitude = magnitudes[(which - SPECIALS) / 2 - 1];
    return which % 2 ? magnitude : -magnitude;
}

#define COORDINATES (SPECIALS + 2 + 2 * 10)

/* What the function takes a coordinate for; NaN if it is none. */
static double clamped(int is_float, double value)
{
    double seen = as_seen(is_float, value);
    if (!(fabs(seen) <= 1.0 + TOLERANCE))
    {
        return (double)NAN;
    }
    return fmax(-1.0, fmin(1.0, seen));
}

static void check_point(const cm_mapping *mapping, const inverse_function *function, int face,
                        const double uv[2])
{
    double inside[2] = {clamped(function->is_float, uv[0]), clamped(function->is_float, uv[1])};
    double direction[3] = {7.0, 7.0, 7.0};
    double expected[3];
    function->call(mapping, (uint8_t)face, uv, direction);
    if (face > 5 || isnan(inside[0]) || isnan(inside[1]))
    {
        REQUIRE(all_nan(direction, 3), "%s of %s: %d %g %g: %g %g %g", function->name,
                name_of(mapping), face, uv[0], uv[1], direction[0], direction[1], direction[2]);
        return;
    }
    (function->is_float ? inverse_f32 : cm_inverse)(mapping, (uint8_t)face, inside, expected);
    const cm_frame_face *axes = face_of(mapping, face);
    double length = sqrt(direction[0] * direction[0] + direction[1] * direction[1] +
                         direction[2] * direction[2]);
    REQUIRE(memcmp(direction, expected, sizeof expected) == 0 &&
                fabs(length - 1.0) <= (function->is_float ? 4 * 0x1p-24 : 4 * 0x1p-53),
            "%s of %s: %d %.17g %.17g: %g %g %g", function->name, name_of(mapping), face, uv[0],
            uv[1], direction[0], direction[1], direction[2]);
    REQUIRE(same_sign(along(direction, axes->u), uv[0]) &&
                same_sign(along(direction, axes->v), uv[1]) &&
                along(direction, axes->outward) > 0.0,
            "%s of %s, %s: %d %g %g: %g %g %g: a sign", function->name, name_of(mapping),
            cm_mapping_frame(mapping)->identifier, face, uv[0], uv[1], direction[0], direction[1],
            direction[2]);
}

static void check_points(const cm_mapping *mapping)
{
    static const int faces[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 127, 128, 254, 255};
    for (size_t n = 0; n < COUNT(faces) * COORDINATES * COORDINATES; n++)
    {
        const double uv[2] = {coordinate(n % COORDINATES),
                              coordinate(n / COORDINATES % COORDINATES)};
        for (size_t i = 0; i < COUNT(inverse_functions); i++)
        {
            check_point(mapping, &inverse_functions[i], faces[n / COORDINATES / COORDINATES], uv);
        }
    }
}

START_TEST(every_coordinate_of_a_point)
{
    for_every_variant(check_points);
}
END_TEST

START_TEST(every_face_that_there_is_not)
{
    cm_mapping *mapping = make_mapping("qsc", NULL);
    const double uv[2] = {0.5, -0.5};
    for (int face = 0; face < 256; face++)
    {
        for (size_t i = 0; i < COUNT(inverse_functions); i++)
        {
            check_point(mapping, &inverse_functions[i], face, uv);
        }
    }
    cm_mapping_destroy(mapping);
}
END_TEST

/* u or v of -0 comes back as -0, and +0 as +0 */
static void check_zeros(const cm_mapping *mapping)
{
    static const double other[] = {0.0, -0.0, 5e-324, -1e-300, 1e-8, 0.5, -0.5, 0.75, -0.999};
    for (size_t n = 0; n < 6 * 2 * 2 * COUNT(other); n++)
    {
        uint8_t face = (uint8_t)(n % 6);
        size_t k = n / 6 % 2;
        double uv[2];
        uv[k] = n / 12 % 2 ? -0.0 : 0.0;
        uv[1 - k] = other[n / 24];
        for (int is_float = 0; is_float < 2; is_float++)
        {
            double direction[3];
            double back[2];
            (is_float ? inverse_f32 : cm_inverse)(mapping, face, uv, direction);
            uint8_t same = (is_float ? forward_f32 : cm_forward)(mapping, direction, back);
            REQUIRE(same == face && same_bits(back[k], uv[k]) && same_sign(back[1 - k], uv[1 - k]),
                    "%s, %s%s: %d %g %g: %d %g %g", name_of(mapping),
                    cm_mapping_frame(mapping)->identifier, is_float ? ", float" : "", face, uv[0],
                    uv[1], same, back[0], back[1]);
        }
    }
}

START_TEST(zeros_come_back)
{
    for_every_variant(check_zeros);
}
END_TEST

/* ---- The warp alone ---- */

/* edges and corners stay where they are */
static void check_good_warp(const cm_mapping *mapping, const warp_function *function,
                            const double from[2], const double inside[2], const double to[2])
{
    for (int k = 0; k < 2; k++)
    {
        REQUIRE(fabs(to[k]) <= 1.0 && same_sign(to[k], inside[k]) &&
                    (fabs(inside[k]) < 1.0 || to[k] == inside[k]) &&
                    (inside[k] != 0.0 || to[k] == 0.0),
                "%s of %s: %.17g %.17g: %.17g %.17g", function->name, name_of(mapping), from[0],
                from[1], to[0], to[1]);
    }
}

static void check_warp(const cm_mapping *mapping, const warp_function *function,
                       const double from[2])
{
    double inside[2] = {clamped(function->is_float, from[0]), clamped(function->is_float, from[1])};
    double to[2] = {7.0, -7.0};
    double expected[2];
    double in_place[2] = {from[0], from[1]};
    cm_status status = function->call(mapping, from, to);
    if (is_hybrid(mapping))
    {
        REQUIRE(status == CM_ERROR_UNSUPPORTED && to[0] == 7.0 && to[1] == -7.0, "%s of %s",
                function->name, name_of(mapping));
        return;
    }
    REQUIRE(status == CM_OK, "%s of %s: status %d", function->name, name_of(mapping), status);
    if (isnan(inside[0]) || isnan(inside[1]))
    {
        REQUIRE(all_nan(to, 2), "%s of %s: %g %g: %g %g", function->name, name_of(mapping), from[0],
                from[1], to[0], to[1]);
        return;
    }
    function->call(mapping, inside, expected);
    function->call(mapping, in_place, in_place);
    REQUIRE(memcmp(to, expected, sizeof to) == 0 && memcmp(to, in_place, sizeof to) == 0,
            "%s of %s: %.17g %.17g", function->name, name_of(mapping), from[0], from[1]);
    check_good_warp(mapping, function, from, inside, to);
}

static void check_warps(const cm_mapping *mapping)
{
    for (size_t i = 0; i < COUNT(warp_functions); i++)
    {
        for (size_t n = 0; n < COORDINATES * COORDINATES; n++)
        {
            const double from[2] = {coordinate(n % COORDINATES), coordinate(n / COORDINATES)};
            check_warp(mapping, &warp_functions[i], from);
        }
        for (int n = 0; n < 400; n++)
        {
            double end = n & 1 ? 1.0 : -1.0;
            double beside = (n / 4 - 50) / 50.0;
            const double from[2] = {n & 2 ? end : beside, n & 2 ? beside : end};
            check_warp(mapping, &warp_functions[i], from);
        }
    }
}

START_TEST(every_argument_of_a_warp)
{
    for_every_variant(check_warps);
}
END_TEST

/* ---- Symmetries, to the bit ---- */

/* a point of [0, 1]^2: of steps near the ends, then random */
static void quarter_point(size_t n, uint64_t *state, double point[2])
{
    static const double steps[] = {0.0,  5e-324, 1e-300,   1e-160,      1e-8,        0.25, 0.5,
                                   0.75, 0.9,    1 - 1e-8, 1 - 0x1p-24, 1 - 0x1p-53, 1.0};
    for (int k = 0; k < 2; k++)
    {
        size_t step = k == 0 ? n % COUNT(steps) : n / COUNT(steps);
        point[k] = n < COUNT(steps) * COUNT(steps) ? steps[step] : fabs(next_real(state));
    }
}

/* warp(-p, q) is (-u, v) and so on; if the coordinates are alike, warp(q, p) is (v, u) */
static void check_odd(const cm_mapping *mapping)
{
    uint64_t state = 3;
    for (size_t n = 0; n < 1500 && !is_hybrid(mapping); n++)
    {
        double first[2];
        quarter_point(n, &state, first);
        for (size_t i = 0; i < COUNT(warp_functions); i++)
        {
            double to[2];
            warp_functions[i].call(mapping, first, to);
            for (int turn = 1; turn < (is_alike(mapping) ? 8 : 4); turn++)
            {
                int swap = turn >> 2;
                double sign[2] = {turn & 1 ? -1.0 : 1.0, turn & 2 ? -1.0 : 1.0};
                const double from[2] = {sign[0] * first[swap], sign[1] * first[1 - swap]};
                double got[2];
                warp_functions[i].call(mapping, from, got);
                REQUIRE(same_bits(got[0], sign[0] * to[swap]) &&
                            same_bits(got[1], sign[1] * to[1 - swap]),
                        "%s of %s: %.17g %.17g: %.17g %.17g, but %.17g %.17g",
                        warp_functions[i].name, name_of(mapping), from[0], from[1], got[0], got[1],
                        to[swap], to[1 - swap]);
            }
        }
    }
}

START_TEST(warps_are_odd)
{
    for_every_variant(check_odd);
}
END_TEST

/* The point of the cube's surface that a direction is mapped to: u and v along their axes, 1 outward.
 * In these coordinates a symmetry of the sphere is the same symmetry of the cube. */
static int point_of_cube(const cm_mapping *mapping, int is_float, const double direction[3],
                         double point[3])
{
    double uv[2];
    uint8_t face = (is_float ? forward_f32 : cm_forward)(mapping, direction, uv);
    const cm_frame_face *axes = face_of(mapping, face);
    put_along(point, axes->outward, 1.0);
    put_along(point, axes->u, uv[0]);
    put_along(point, axes->v, uv[1]);
    return face;
}

static const int permutations[6][3] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1},
                                       {2, 1, 0}, {1, 2, 0}, {2, 0, 1}};

/* Component k of a turned vector is component permutations[..][k] of the vector, with a sign. */
static void turn_vector(int turn, const double from[3], double to[3])
{
    for (int k = 0; k < 3; k++)
    {
        double value = from[permutations[turn >> 3][k]];
        to[k] = turn >> k & 1 ? -value : value;
    }
}

/* Is a turned point of a face on the other face with u as u, v as v? */
static int keeps_coordinates(const cm_mapping *mapping, int turn, int face, int turned_face)
{
    int axis = abs(face_of(mapping, turned_face)->u) - 1;
    return permutations[turn >> 3][axis] == abs(face_of(mapping, face)->u) - 1;
}

/* Returns how many of the turns were found not to be symmetries of the mapping though they are of the
 * cube, which only happens where u and v change places. */
static int check_turns(const cm_mapping *mapping, int is_float, const double direction[3])
{
    int others = 0;
    double point[3];
    int face = point_of_cube(mapping, is_float, direction, point);
    for (int turn = 1; turn < 48; turn++)
    {
        double turned[3];
        double expected[3];
        double got[3];
        if (is_hybrid(mapping) && turn >= 16) /* its poles are on the z axis */
        {
            break;
        }
        turn_vector(turn, direction, turned);
        turn_vector(turn, point, expected);
        int turned_face = point_of_cube(mapping, is_float, turned, got);
        int same = memcmp(got, expected, sizeof got) == 0;
        int alike = is_alike(mapping) || keeps_coordinates(mapping, turn, face, turned_face);
        REQUIRE(same || !alike,
                "%s, %s%s: %.17g %.17g %.17g: %.17g %.17g %.17g, but turn %d: %.17g %.17g %.17g",
                name_of(mapping), cm_mapping_frame(mapping)->identifier, is_float ? ", float" : "",
                direction[0], direction[1], direction[2], point[0], point[1], point[2], turn,
                got[0], got[1], got[2]);
        others += !same;
    }
    return others;
}

static void check_symmetry(const cm_mapping *mapping)
{
    static const double sizes[] = {0.0, 5e-324, 1e-300, 1e-8, 0.3, 0.5, 1.0, 1.0 - 0x1p-53, 3.0};
    uint64_t state = 8;
    int others = 0;
    for (size_t n = 1; n < COUNT(sizes) * COUNT(sizes) * COUNT(sizes) + 500; n++)
    {
        double direction[3] = {sizes[n % COUNT(sizes)], sizes[n / COUNT(sizes) % COUNT(sizes)],
                               sizes[n / COUNT(sizes) / COUNT(sizes) % COUNT(sizes)]};
        if (n >= COUNT(sizes) * COUNT(sizes) * COUNT(sizes))
        {
            next_direction(&state, direction);
        }
        others += check_turns(mapping, 0, direction);
        /* what is zero as a float is no direction */
        if (direction[0] > 1e-30 || direction[1] > 1e-30 || direction[2] > 1e-30)
        {
            others += check_turns(mapping, 1, direction);
        }
    }
    REQUIRE((others == 0) == is_alike(mapping), "%s: %d", name_of(mapping), others);
}

START_TEST(symmetries_of_the_cube)
{
    for_every_variant(check_symmetry);
}
END_TEST

/* A direction times a power of two gives the same bits, down to where it loses digits. */
static void check_lengths(const cm_mapping *mapping)
{
    static const int exponents[] = {1020, 500, 1, -1, -500, -1000, -1040};
    for (int n = 1; n < 1000; n++)
    {
        /* few digits, so that subnormals have them all */
        const double direction[3] = {n % 10 - 4, n / 10 % 10 - 4, n / 100 - 4};
        double uv[2];
        uint8_t face = cm_forward(mapping, direction, uv);
        for (size_t e = 0; e < COUNT(exponents) && face != CM_NO_FACE; e++)
        {
            double scaled[3];
            double got[2];
            for (int k = 0; k < 3; k++)
            {
                scaled[k] = ldexp(direction[k], exponents[e]);
            }
            REQUIRE(cm_forward(mapping, scaled, got) == face && same_bits(got[0], uv[0]) &&
                        same_bits(got[1], uv[1]),
                    "%s: %g %g %g", name_of(mapping), scaled[0], scaled[1], scaled[2]);
        }
        for (int exponent = -145; exponent < 125; exponent += 9)
        {
            double scaled[3];
            double got[2];
            for (int k = 0; k < 3; k++)
            {
                scaled[k] = ldexp(direction[k], exponent);
            }
            uint8_t narrow_face = forward_f32(mapping, direction, uv);
            REQUIRE(forward_f32(mapping, scaled, got) == narrow_face &&
                        (narrow_face == CM_NO_FACE ||
                         (same_bits(got[0], uv[0]) && same_bits(got[1], uv[1]))),
                    "%s, float: %g %g %g", name_of(mapping), scaled[0], scaled[1], scaled[2]);
        }
    }
}

START_TEST(lengths_do_not_matter)
{
    for_every_variant(check_lengths);
}
END_TEST

/* ---- Longitude and latitude ---- */

static int is_unit(const double direction[3])
{
    double square =
        direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2];
    return fabs(square - 1.0) < 1e-15;
}

static double latitude(size_t which)
{
    double end = HALF_PI + TOLERANCE;
    const double ends[] = {HALF_PI,
                           nextafter(HALF_PI, 2.0),
                           HALF_PI + 5e-10,
                           end,
                           nextafter(end, 2.0),
                           HALF_PI + 1.1e-9,
                           1.5708,
                           PI};
    if (which < SPECIALS)
    {
        return special(which);
    }
    double value = ends[(which - SPECIALS) / 2];
    return which % 2 ? value : -value;
}

#define LATITUDES (SPECIALS + 2 * 8)

static void check_direction_from_lonlat(double lon, double lat)
{
    double direction[3] = {7.0, 7.0, 7.0};
    double expected[3];
    cm_direction_from_lonlat(lon, lat, direction);
    if (!isfinite(lon) || !(fabs(lat) <= HALF_PI + TOLERANCE))
    {
        REQUIRE(all_nan(direction, 3), "lon %g lat %g: %g %g %g", lon, lat, direction[0],
                direction[1], direction[2]);
        return;
    }
    /* beyond the pole is the pole, to the bit */
    cm_direction_from_lonlat(lon, fmax(-HALF_PI, fmin(HALF_PI, lat)), expected);
    REQUIRE(memcmp(direction, expected, sizeof expected) == 0, "lon %g lat %g", lon, lat);
    REQUIRE(is_unit(direction) && same_sign(direction[2], lat) &&
                (fabs(lon) > 1.0 || (same_sign(direction[1], lon) && direction[0] > 0.0)),
            "lon %g lat %g: %g %g %g", lon, lat, direction[0], direction[1], direction[2]);
}

static void check_lonlat_from_direction(const double direction[3])
{
    double lonlat[2] = {7.0, 7.0};
    cm_lonlat_from_direction(direction, lonlat);
    if (!isfinite(direction[0]) || !isfinite(direction[1]) || !isfinite(direction[2]) ||
        (direction[0] == 0.0 && direction[1] == 0.0 && direction[2] == 0.0))
    {
        REQUIRE(all_nan(lonlat, 2), "%g %g %g: %g %g", direction[0], direction[1], direction[2],
                lonlat[0], lonlat[1]);
        return;
    }
    REQUIRE(same_bits(lonlat[0], atan2(direction[1], direction[0])) &&
                same_sign(lonlat[1], direction[2]) && fabs(lonlat[1]) <= HALF_PI,
            "%g %g %g: %g %g", direction[0], direction[1], direction[2], lonlat[0], lonlat[1]);
    double flat = fmax(fabs(direction[0]), fabs(direction[1]));
    double height = fabs(direction[2]);
    REQUIRE((flat != 0.0 || fabs(lonlat[1]) == HALF_PI) && (height != 0.0 || lonlat[1] == 0.0) &&
                (flat < height || fabs(lonlat[1]) < 0.7853982) &&
                (flat > height / 2.0 || fabs(lonlat[1]) > 0.7853981),
            "%g %g %g: lat %g", direction[0], direction[1], direction[2], lonlat[1]);
}

START_TEST(every_argument_of_lonlat)
{
    for (size_t n = 0; n < SPECIALS * LATITUDES; n++)
    {
        check_direction_from_lonlat(special(n % SPECIALS), latitude(n / SPECIALS));
    }
    for (size_t n = 0; n < SPECIALS * SPECIALS * SPECIALS; n++)
    {
        const double direction[3] = {special(n % SPECIALS), special(n / SPECIALS % SPECIALS),
                                     special(n / SPECIALS / SPECIALS)};
        check_lonlat_from_direction(direction);
    }
}
END_TEST

/* the functions in lon/lat are those of directions with these two beside them */
static void check_lonlat_functions(const cm_mapping *mapping)
{
    for (size_t n = 0; n < SPECIALS * LATITUDES; n++)
    {
        double lon = special(n % SPECIALS);
        double lat = latitude(n / SPECIALS);
        double direction[3];
        double uv[2] = {7.0, 7.0};
        double expected[2];
        uint8_t face = cm_forward_lonlat(mapping, lon, lat, uv);
        cm_direction_from_lonlat(lon, lat, direction);
        int good = cm_forward(mapping, direction, expected) == face &&
                   (face == CM_NO_FACE ? isnan(direction[0]) && all_nan(uv, 2)
                                       : memcmp(uv, expected, sizeof uv) == 0);
        REQUIRE(good, "%s: lon %g lat %g: %d %g %g", name_of(mapping), lon, lat, face, uv[0],
                uv[1]);
    }
    for (size_t n = 0; n < 8 * COORDINATES * COORDINATES; n++)
    {
        uint8_t face = (uint8_t)(n % 8);
        const double uv[2] = {coordinate(n / 8 % COORDINATES), coordinate(n / 8 / COORDINATES)};
        double lonlat[2] = {7.0, 7.0};
        double in_place[2] = {uv[0], uv[1]};
        double direction[3];
        double expected[2];
        cm_inverse_lonlat(mapping, face, uv, lonlat);
        cm_inverse_lonlat(mapping, face, in_place, in_place);
        cm_inverse(mapping, face, uv, direction);
        cm_lonlat_from_direction(direction, expected);
        int good = isnan(direction[0]) ? all_nan(lonlat, 2) && all_nan(in_place, 2)
                                       : memcmp(lonlat, expected, sizeof lonlat) == 0 &&
                                             memcmp(in_place, expected, sizeof lonlat) == 0;
        REQUIRE(good, "%s: %d %g %g: %g %g", name_of(mapping), face, uv[0], uv[1], lonlat[0],
                lonlat[1]);
    }
}

START_TEST(every_argument_of_the_lonlat_functions)
{
    for_every_variant(check_lonlat_functions);
}
END_TEST

/* (-1, +0, z) is at lon +pi and (-1, -0, z) at -pi, before a round trip and after it */
static void check_antimeridian(const cm_mapping *mapping)
{
    static const double heights[] = {0.0,  -0.0,   5e-324, 1e-300, 0.25, -0.5,
                                     0.75, -0.999, 1.0,    -1.0,   3.0,  -1e300};
    for (size_t n = 0; n < 2 * COUNT(heights); n++)
    {
        double side = n % 2 ? -0.0 : 0.0;
        const double direction[3] = {-1.0, side, heights[n / 2]};
        double uv[2];
        double back[3];
        double lonlat[2];
        double before[2];
        cm_lonlat_from_direction(direction, before);
        uint8_t face = cm_forward(mapping, direction, uv);
        cm_inverse(mapping, face, uv, back);
        cm_inverse_lonlat(mapping, face, uv, lonlat);
        REQUIRE(same_bits(before[0], copysign(PI, side)) && same_bits(lonlat[0], before[0]) &&
                    same_bits(back[1], side) && same_sign(back[2], direction[2]) &&
                    same_sign(lonlat[1], direction[2]),
                "%s, %s: -1 %g %g: %d %g %g: %g %g %g, lon %g", name_of(mapping),
                cm_mapping_frame(mapping)->identifier, direction[1], direction[2], face, uv[0],
                uv[1], back[0], back[1], back[2], lonlat[0]);
    }
}

/* lon of the doubles +-pi, which are a little inside, comes back to the bit */
static void check_both_ends(const cm_mapping *mapping)
{
    for (int n = -150; n <= 150; n++)
    {
        double lon = n % 2 ? PI : -PI;
        double uv[2];
        double lonlat[2];
        uint8_t face = cm_forward_lonlat(mapping, lon, n / 100.0, uv);
        cm_inverse_lonlat(mapping, face, uv, lonlat);
        REQUIRE(lonlat[0] == lon, "%s, %s: lon %.17g lat %g: %.17g", name_of(mapping),
                cm_mapping_frame(mapping)->identifier, lon, n / 100.0, lonlat[0]);
    }
}

START_TEST(antimeridian)
{
    for_every_variant(check_antimeridian);
    for_every_variant(check_both_ends);
}
END_TEST

/* lon of a pole is that of the signs of x and y, before a round trip and after it */
static void check_poles(const cm_mapping *mapping)
{
    for (int n = 0; n < 8; n++)
    {
        const double direction[3] = {n & 1 ? -0.0 : 0.0, n & 2 ? -0.0 : 0.0, n & 4 ? -2.0 : 2.0};
        double lon = copysign(n & 1 ? PI : 0.0, direction[1]);
        double lat = copysign(HALF_PI, direction[2]);
        double before[2];
        double after[2];
        double uv[2];
        double back[3];
        cm_lonlat_from_direction(direction, before);
        uint8_t face = cm_forward(mapping, direction, uv);
        cm_inverse_lonlat(mapping, face, uv, after);
        REQUIRE(face_of(mapping, face)->outward == (n & 4 ? -CM_AXIS_Z : CM_AXIS_Z) &&
                    uv[0] == 0.0 && uv[1] == 0.0,
                "%s: pole %d: face %d, %g %g", name_of(mapping), n, face, uv[0], uv[1]);
        REQUIRE(same_bits(before[0], lon) && same_bits(before[1], lat) &&
                    same_bits(after[0], lon) && same_bits(after[1], lat),
                "%s: pole %d: %g %g, %g %g", name_of(mapping), n, before[0], before[1], after[0],
                after[1]);
        /* the double below pi/2 is so near the pole that lon is what it was */
        cm_forward_lonlat(mapping, 0.75, lat, uv);
        cm_inverse_lonlat(mapping, face, uv, after);
        REQUIRE(fabs(after[0] - 0.75) < 1e-14 && after[1] == lat, "%s: %g %g", name_of(mapping),
                after[0], after[1]);
        forward_f32(mapping, direction, uv);
        inverse_f32(mapping, face, uv, back);
        REQUIRE(same_bits(back[0], direction[0]) && same_bits(back[1], direction[1]) &&
                    fabs(back[2]) == 1.0,
                "%s, float: pole %d: %g %g %g", name_of(mapping), n, back[0], back[1], back[2]);
    }
}

START_TEST(poles)
{
    for_every_variant(check_poles);
}
END_TEST

/* lon and lat of -0 give y and z of -0, and come back */
START_TEST(zeros_of_lon_and_lat)
{
    for (int n = 0; n < 4; n++)
    {
        double lon = n & 1 ? -0.0 : 0.0;
        double lat = n & 2 ? -0.0 : 0.0;
        double direction[3];
        double back[2];
        cm_direction_from_lonlat(lon, lat, direction);
        ck_assert(direction[0] == 1.0 && same_bits(direction[1], lon) &&
                  same_bits(direction[2], lat));
        cm_lonlat_from_direction(direction, back);
        ck_assert(same_bits(back[0], lon) && same_bits(back[1], lat));
        /* and on the meridians of +-pi, whose doubles are a little inside */
        cm_direction_from_lonlat(copysign(PI, lon), lat, direction);
        ck_assert(direction[0] == -1.0 && same_sign(direction[1], lon) &&
                  fabs(direction[1]) < 2e-16 && same_bits(direction[2], lat));
        cm_lonlat_from_direction(direction, back);
        ck_assert(same_bits(back[0], copysign(PI, lon)) && same_bits(back[1], lat));
    }
}
END_TEST

/* ---- What fails ---- */

/* *mapping is left alone, and a message is one line for what failed and nothing for what did not */
START_TEST(failures_leave_things_untouched)
{
    static const struct
    {
        const char *specification;
        cm_status status;
    } cases[] = {{NULL, CM_ERROR_ARGUMENT},
                 {"", CM_ERROR_SYNTAX},
                 {"tangent:c", CM_ERROR_SYNTAX},
                 {"nothing", CM_ERROR_MAPPING},
                 {"tangent:d=1", CM_ERROR_PARAMETER},
                 {"tangent:c=9", CM_ERROR_RANGE},
                 {"qsc", CM_ERROR_FRAME},
                 {"qsc", CM_OK}};
    int sentinel = 0;
    for (size_t i = 0; i < COUNT(cases); i++)
    {
        cm_frame broken = *cm_frame_find("geo");
        char message[80] = "untouched";
        broken.face[3].v = 0;
        void *kept = &sentinel;
        cm_mapping *mapping = kept;
        cm_status status = cm_mapping_create(
            cases[i].specification, cases[i].status == CM_ERROR_FRAME ? &broken : NULL, &mapping);
        ck_assert_int_eq(status, cases[i].status);
        if (status == CM_OK)
        {
            ck_assert_ptr_ne(mapping, kept);
            cm_mapping_destroy(mapping);
        }
        else
        {
            ck_assert_ptr_eq(mapping, kept);
            ck_assert_int_eq(cm_mapping_create(cases[i].specification, &broken, NULL),
                             CM_ERROR_ARGUMENT);
        }
        if (status != CM_ERROR_FRAME)
        {
            ck_assert_int_eq(cm_specification_check(cases[i].specification, message, 80), status);
            ck_assert((strcmp(message, "untouched") == 0) == (status == CM_OK));
            ck_assert_int_eq(cm_specification_check(cases[i].specification, NULL, 80), status);
            ck_assert_int_eq(cm_specification_check(cases[i].specification, NULL, 0), status);
        }
    }
}
END_TEST

START_TEST(null_where_it_is_allowed)
{
    ck_assert_ptr_null(cm_frame_find(NULL));
    ck_assert_ptr_null(cm_catalogue_find(NULL));
    ck_assert_int_eq(cm_frame_check(NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_specification_check(NULL, NULL, 0), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_mapping_create(NULL, NULL, NULL), CM_ERROR_ARGUMENT);
    cm_mapping_destroy(NULL);
    cm_mapping *mapping = make_mapping("qsc", NULL);
    ck_assert_str_eq(cm_mapping_frame(mapping)->identifier, "geo");
    ck_assert(isnan(cm_mapping_parameter(mapping, 0)) &&
              isnan(cm_mapping_parameter(mapping, SIZE_MAX)));
    cm_mapping_destroy(mapping);
    ck_assert_ptr_null(cm_frame_at(cm_frame_count()));
    ck_assert_ptr_null(cm_frame_at(SIZE_MAX));
    ck_assert_ptr_null(cm_catalogue_at(cm_catalogue_count()));
    ck_assert_ptr_null(cm_catalogue_at(SIZE_MAX));
}
END_TEST

/* One sentence without a full stop for each status; for numbers that are none, the same one. */
START_TEST(every_status_has_a_text)
{
    static const long none[] = {-1, -2147483647L - 1, (long)CM_ERROR_VERSION + 1, 255, 2147483647L};
    const char *unknown = cm_status_text((cm_status)none[0]);
    for (int i = CM_OK; i <= (int)CM_ERROR_VERSION; i++)
    {
        const char *text = cm_status_text((cm_status)i);
        ck_assert_ptr_nonnull(text);
        ck_assert_uint_gt(strlen(text), 3);
        /* a dot at the end of "..." in a pattern is not a full stop */
        ck_assert(text[strlen(text) - 1] != '.' && strchr(text, '\n') == NULL);
        ck_assert_str_ne(text, unknown);
        for (int k = CM_OK; k < i; k++)
        {
            ck_assert_str_ne(text, cm_status_text((cm_status)k));
        }
    }
    for (size_t i = 0; i < COUNT(none); i++)
    {
        ck_assert_str_eq(cm_status_text((cm_status)none[i]), unknown);
    }
}
END_TEST

int main(void)
{
    const TTest *tests[] = {every_component_of_a_direction,
                            every_coordinate_of_a_point,
                            every_face_that_there_is_not,
                            zeros_come_back,
                            every_argument_of_a_warp,
                            warps_are_odd,
                            symmetries_of_the_cube,
                            lengths_do_not_matter,
                            every_argument_of_lonlat,
                            every_argument_of_the_lonlat_functions,
                            antimeridian,
                            poles,
                            zeros_of_lon_and_lat,
                            failures_leave_things_untouched,
                            null_where_it_is_allowed,
                            every_status_has_a_text,
                            NULL};
    return run_suite("signs", tests);
}
