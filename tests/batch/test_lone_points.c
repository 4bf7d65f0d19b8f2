/* SPDX-License-Identifier: MIT
 *
 * One point alone has the bits that it has in an array, and raises no exception but inexact: every mapping to a cube or of
 * one kernel, in every frame, with every instruction set, in double and in float, at coordinates that are equal, ones, zeros,
 * tiny, huge or bad, and beside where a way alone begins and ends (batch/lone_easy.inc) and conformal's zones meet.
 */
#include "tests/suite.h"

#include <fenv.h>

static const double special[] = {0.0,       -0.0,
                                 1.0,       0.5,
                                 2.0 / 3.0, 0.57735026918962576,
                                 0x1p-60,   0x1p-61,
                                 0x1p60,    0x1p61,
                                 0x1p-10,   0x1.fffffep-11,
                                 0x1p8,     0x1p9,
                                 1e-300,    1e300,
                                 3.0,       0.99999994039535522,
                                 1e-9,      1.0e-40,
                                 0.25,      0.70710678118654752,
                                 0x1p-6,    0.99609375,
                                 0.3,       0.25988532984559076};
static const double bad[] = {(double)NAN, (double)INFINITY};

enum
{
    TRIED = 4000 /* of each mapping, frame, set and precision */
};

static double lone_number(uint64_t *state)
{
    const uint64_t bits = next_bits(state) >> 20;
    const double sign = bits & 1 ? -1.0 : 1.0;
    const double from = special[bits / 16 % (sizeof special / sizeof special[0])];
    switch (bits / 2 % 8)
    {
    case 0:
        return sign * from;
    case 1:
        return sign * from * (1.0 + ldexp(next_real(state), -(int)(bits / 4096 % 50)));
    case 2:
        return bits % 1024 == 4 ? sign * bad[bits / 1024 % 2] : sign * from;
    case 3:
        return ldexp(next_real(state), -(int)(bits / 4096 % 14));
    default:
        return next_real(state);
    }
}

/* Three coordinates, of which some are equal but for their signs. */
static void lone_numbers(uint64_t *state, double x[3])
{
    for (int k = 0; k < 3; k++)
    {
        x[k] = lone_number(state);
    }
    const uint64_t bits = next_bits(state) >> 20;
    if (bits % 4 == 0)
    {
        x[1 + bits / 4 % 2] = bits & 64 ? x[0] : -x[0];
    }
    if (bits % 16 == 5)
    {
        x[2] = bits & 128 ? x[1] : -x[1];
    }
    if (bits % 32 == 7) /* beside a diagonal */
    {
        x[1] = (double)nextafterf((float)x[0], 2.0f);
    }
    if (bits % 32 == 9) /* beside a diagonal at a face's centre, where eighth powers underflow */
    {
        x[0] = ldexp(1.0, (int)(bits / 256 % 64));
        x[1] = ldexp(1.0, -(int)(bits / 16384 % 64));
        x[2] = nextafter(x[1], 0.0);
    }
}

static void expect_inexact_alone(const char *set, const char *name, const double x[3])
{
    const int raised = fetestexcept(FE_ALL_EXCEPT & ~FE_INEXACT);
    REQUIRE(raised == 0, "%s, %s: %a %a %a raises %#x", set, name, x[0], x[1], x[2],
            (unsigned)raised);
}

#define LONE_TRIALS(real, suffix)                                                                  \
    static void try_forward##suffix(const char *set, const cm_mapping *mapping, const double x[3]) \
    {                                                                                              \
        const char *name = cm_mapping_describe(mapping)->identifier;                               \
        const real d[3] = {(real)x[0], (real)x[1], (real)x[2]};                                    \
        real uv[2], u, v;                                                                          \
        uint8_t face;                                                                              \
        feclearexcept(FE_ALL_EXCEPT);                                                              \
        const uint8_t alone = cm_forward##suffix(mapping, d, uv);                                  \
        expect_inexact_alone(set, name, x);                                                        \
        cm_forward_array##suffix(mapping, 1, &d[0], &d[1], &d[2], &face, &u, &v);                  \
        REQUIRE(alone == face && memcmp(&uv[0], &u, sizeof u) == 0 &&                              \
                    memcmp(&uv[1], &v, sizeof v) == 0,                                             \
                "%s, %s forward of %a %a %a: %d %a %a, not %d %a %a", set, name, x[0], x[1], x[2], \
                alone, (double)uv[0], (double)uv[1], face, (double)u, (double)v);                  \
    }                                                                                              \
    static void try_inverse##suffix(const char *set, const cm_mapping *mapping, uint8_t face,      \
                                    const double x[3])                                             \
    {                                                                                              \
        const char *name = cm_mapping_describe(mapping)->identifier;                               \
        const real uv[2] = {(real)x[0], (real)x[1]};                                               \
        real alone[3], d[3];                                                                       \
        feclearexcept(FE_ALL_EXCEPT);                                                              \
        cm_inverse##suffix(mapping, face, uv, alone);                                              \
        expect_inexact_alone(set, name, x);                                                        \
        cm_inverse_array##suffix(mapping, 1, &face, &uv[0], &uv[1], &d[0], &d[1], &d[2]);          \
        REQUIRE(memcmp(alone, d, sizeof d) == 0,                                                   \
                "%s, %s inverse of %d %a %a: %a %a %a, not %a %a %a", set, name, face, x[0], x[1], \
                (double)alone[0], (double)alone[1], (double)alone[2], (double)d[0], (double)d[1],  \
                (double)d[2]);                                                                     \
    }
LONE_TRIALS(double, )
LONE_TRIALS(float, _f32)

static void try_mapping(const char *set, const cm_mapping *mapping)
{
    uint64_t state = 2024;
    const int count = is_quick() ? TRIED / 8 : TRIED; /* an emulator takes microseconds for flags */
    for (int i = 0; i < count; i++)
    {
        double x[3];
        lone_numbers(&state, x);
        const uint8_t face = (uint8_t)(next_bits(&state) >> 40) % 8;
        try_forward(set, mapping, x);
        try_inverse(set, mapping, face, x);
        /* the cast to float raises by itself */
        const double narrow[3] = {(double)(float)x[0], (double)(float)x[1], (double)(float)x[2]};
        try_forward_f32(set, mapping, narrow);
        try_inverse_f32(set, mapping, face, narrow);
    }
}

/* Beside the catalogue's, other parameters, which choose the other variants. */
static void try_specification(const char *specification)
{
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        const cm_options options = {.size = sizeof options, .instructions = cm_instructions_at(s)};
        for (size_t f = 0; f < cm_frame_count(); f++)
        {
            cm_mapping *mapping;
            ck_assert_int_eq(
                cm_mapping_create_with(specification, cm_frame_at(f), &options, &mapping), CM_OK);
            try_mapping(cm_instructions_at(s), mapping);
            cm_mapping_destroy(mapping);
        }
    }
}

START_TEST(alone_as_in_an_array)
{
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        try_specification(cm_catalogue_at(i)->identifier);
    }
}
END_TEST

START_TEST(variants_alone_as_in_an_array)
{
    static const char *const others[] = {"tangent:c=1.1823",
                                         "zucker-quintic:forward=1",
                                         "zucker-cobe:forward=1",
                                         "cobe:legacy=1",
                                         "tanh:c=1.5",
                                         "logistic:c=3"};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
    {
        try_specification(others[i]);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {alone_as_in_an_array, variants_alone_as_in_an_array, NULL};
    return run_suite("lone points", tests);
}
