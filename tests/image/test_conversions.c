/* SPDX-License-Identifier: MIT
 *
 * Numbers of pixels from one type to another, in every instruction set: all halves, and hard floats.
 */
#include "sets_here.h"
#include "tests/suite.h"

#include "modules/image/sample_set.h"

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

static double true_half(uint16_t half)
{
    const int exponent = half >> 10 & 31;
    const double digits = half & 1023;
    const double size = exponent == 0    ? ldexp(digits, -24)
                        : exponent == 31 ? (digits == 0.0 ? (double)INFINITY : (double)NAN)
                                         : ldexp(1024.0 + digits, exponent - 25);
    return half & 0x8000 ? -size : size;
}

static int same(double a, double b)
{
    return isnan(a) ? isnan(b) : a == b && signbit(a) == signbit(b);
}

/* Programs may have the processor take floats below 2^-126 for 0; none is needed. */
static void flush_small_floats(int on)
{
#ifdef __SSE2__
    const unsigned flush = 0x8040; /* flush to zero, denormals are zeros */
    _mm_setcsr(on ? _mm_getcsr() | flush : _mm_getcsr() & ~flush);
#else
    (void)on;
#endif
}

START_TEST(halves_are_converted)
{
    enum
    {
        ALL = 65536
    };
    uint16_t *halves = malloc(ALL * sizeof *halves);
    uint16_t *back = malloc(ALL * sizeof *back);
    float *floats = malloc(ALL * sizeof *floats);
    ck_assert(halves != NULL && back != NULL && floats != NULL);
    for (int i = 0; i < ALL; i++)
    {
        halves[i] = (uint16_t)i;
    }
    for (size_t s = 0; s < 2 * cm_instructions_count(); s++)
    {
        const cm_sample_set *set = set_at(s / 2);
        flush_small_floats(s % 2);
        set->half_to_float(ALL, halves, 1.0f, floats);
        set->float_to_half(ALL, floats, 1.0f, back);
        flush_small_floats(0);
        for (int i = 0; i < ALL; i++)
        {
            REQUIRE(same((double)floats[i], true_half(halves[i])), "%s: %04x is %g", set->name, i,
                    (double)floats[i]);
            REQUIRE(back[i] == i || isnan(floats[i]), "%s: %04x is %04x", set->name, i, back[i]);
            REQUIRE(same(true_half(back[i]), (double)floats[i]), "%s: %04x", set->name, i);
        }
        /* between two halves the even one, and a float beside the middle the nearer one */
        for (unsigned i = 0; i < 0x7c00; i++)
        {
            const double above = i + 1 == 0x7c00 ? 65536.0 : true_half((uint16_t)(i + 1));
            const float middle = (float)(0.5 * (true_half((uint16_t)i) + above));
            const float at[3] = {nextafterf(middle, 0.0f), middle, nextafterf(middle, 1e9f)};
            uint16_t found[3];
            set->float_to_half(3, at, 1.0f, found);
            REQUIRE(found[0] == i && found[1] == (i & 1 ? i + 1 : i) && found[2] == i + 1,
                    "%s: %04x %04x %04x at %04x", set->name, found[0], found[1], found[2], i);
        }
    }
    free(halves);
    free(back);
    free(floats);
}
END_TEST

START_TEST(whole_numbers_are_converted)
{
    enum
    {
        N = 67
    };
    const float hard[] = {0.0f,
                          -0.0f,
                          0.5f,
                          1.5f,
                          2.5f,
                          254.5f,
                          255.0f,
                          255.5f,
                          256.0f,
                          65534.5f,
                          65535.0f,
                          65535.5f,
                          1e30f,
                          -1e30f,
                          (float)INFINITY,
                          -(float)INFINITY,
                          (float)NAN,
                          0.49999997f,
                          -0.5f,
                          1e-40f,
                          126.50001f,
                          126.49999f,
                          127.5f};
    float from[N];
    for (size_t i = 0; i < N; i++)
    {
        from[i] = hard[i % (sizeof hard / sizeof *hard)];
    }
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        const cm_sample_set *set = set_at(s);
        for (size_t n = 0; n <= N; n++)
        {
            uint8_t bytes[N + 1];
            uint16_t words[N + 1];
            float back[N];
            memset(bytes, 0xa5, sizeof bytes);
            memset(words, 0xa5, sizeof words);
            set->float_to_u8(n, from, 1.0f, bytes);
            set->float_to_u16(n, from, 1.0f, words);
            for (size_t i = 0; i < n; i++)
            {
                const double value = isnan(from[i]) ? 0.0 : rint(fmax((double)from[i], 0.0));
                REQUIRE(bytes[i] == fmin(value, 255.0), "%s: %g is %d", set->name, (double)from[i],
                        bytes[i]);
                REQUIRE(words[i] == fmin(value, 65535.0), "%s: %g is %d", set->name,
                        (double)from[i], words[i]);
            }
            REQUIRE(bytes[n] == 0xa5 && words[n] == 0xa5a5, "%s: %zu", set->name, n);
            set->u8_to_float(n, bytes, 0.5f, back);
            for (size_t i = 0; i < n; i++)
            {
                ck_assert(back[i] == 0.5f * (float)bytes[i]);
            }
            set->u16_to_float(n, words, 0.5f, back);
            for (size_t i = 0; i < n; i++)
            {
                ck_assert(back[i] == 0.5f * (float)words[i]);
            }
        }
    }
}
END_TEST

START_TEST(sets_are_found)
{
    ck_assert_ptr_null(cm_sample_set_find("no such set"));
    ck_assert_str_eq(cm_sample_set_find("Scalar")->name, "scalar");
    if (getenv("CUBEMAP_INSTRUCTIONS") == NULL)
    {
        const char *best = cm_instructions_at(cm_instructions_count() - 1);
        ck_assert_str_eq(cm_sample_set_find(NULL)->name, best);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {sets_are_found, halves_are_converted, whole_numbers_are_converted,
                                  NULL};
    return run_suite("conversions", tests);
}
