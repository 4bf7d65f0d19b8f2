/* SPDX-License-Identifier: MIT
 *
 * Measures the worst error of every elementary function in ulp and holds it against a bound.
 *
 *     elementary_accuracy [points | full]
 *
 * Double: against libquadmath, on `points` random inputs a function (default 1000000) and on the
 * hard points: the ends of the domain and their neighbours, 1e-8, 1e-300, subnormals.
 * Float: against the double math library, on every float from 2^-5 to the end of the domain and on
 * every 1009th below; with "full" on every float of the positive domain.
 * Negative inputs must give the same bits but for the sign, zero its sign, NaN a NaN.
 *
 * The bounds hold with contraction and without; the worst without is stated in the header.
 *
 * Needs gcc's libquadmath; returns 77 (skipped) where the compiler has none.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(__has_include)
#if __has_include(<quadmath.h>)
#define HAVE_QUADMATH 1
#endif
#endif

#ifndef HAVE_QUADMATH

int main(void)
{
    puts("elementary_accuracy: skipped, no libquadmath");
    return 77;
}

#else

#include <quadmath.h>

#define CM_BACKEND 1
#include <cubemap/kernel/dialect.h>
#include <cubemap/kernel/elementary.h>
#undef CM_BACKEND
#define CM_BACKEND 2
#include <cubemap/kernel/dialect.h>
#include <cubemap/kernel/elementary.h>

__extension__ typedef __float128 quad;

/* f(x) as its users make it from the excess: x + x E(x^2) */
#define FROM_EXCESS(name)                                                                          \
    static double name##_f64(double x)                                                             \
    {                                                                                              \
        return copysign(x + x * cm_##name##_excess_f64(x * x), x);                                 \
    }                                                                                              \
    static float name##_f32(float x)                                                               \
    {                                                                                              \
        return copysignf(x + x * cm_##name##_excess_f32(x * x), x);                                \
    }
/* as its user calls it, for y of both signs */
static double trisect_f64(double y)
{
    return copysign(cm_trisect_f64(fabs(y), sqrt(1.0 - fabs(y))), y);
}

static float trisect_f32(float y)
{
    return copysignf(cm_trisect_f32(fabsf(y), sqrtf(1.0f - fabsf(y))), y);
}

FROM_EXCESS(atan)
FROM_EXCESS(tan)
FROM_EXCESS(tanh)
FROM_EXCESS(atanh)

static quad quad_versine(quad x)
{
    quad h = sinq(x / 2);
    return 2 * h * h;
}

static quad quad_trisect(quad y)
{
    return 2 * sinq(asinq(y) / 3);
}

static double double_versine(double x)
{
    double h = sin(x / 2);
    return 2 * h * h;
}

static double double_trisect(double y)
{
    return 2 * sin(asin(y) / 3);
}

struct function
{
    const char *name;
    double (*f64)(double);
    float (*f32)(float);
    quad (*ref64)(quad);
    double (*ref32)(double);
    double end;  /* of the domain, in double */
    float end32; /* and in float */
    int even;
    double bound64; /* ulp */
    double bound32;
};

static const struct function functions[] = {
    {"atan_excess", atan_f64, atan_f32, atanq, atan, 1.0, 1.0f, 0, 1.0, 1.0},
    /* pi / 4 rounds down in double and up in float; one ulp more in double */
    {"tan_excess", tan_f64, tan_f32, tanq, tan, 0x1.921fb54442d19p-1, 0x1.921fb6p-1f, 0, 1.2, 1.2},
    {"sin_quarter", cm_sin_quarter_f64, cm_sin_quarter_f32, sinq, sin, 0x1.921fb54442d19p-1,
     0x1.921fb6p-1f, 0, 0.85, 0.8},
    {"versine_quarter", cm_versine_quarter_f64, cm_versine_quarter_f32, quad_versine,
     double_versine, 0x1.921fb54442d19p-1, 0x1.921fb6p-1f, 1, 1.0, 1.0},
    {"tanh_excess", tanh_f64, tanh_f32, tanhq, tanh, 1.0, 1.0f, 0, 1.05, 1.05},
    {"atanh_excess", atanh_f64, atanh_f32, atanhq, atanh, 0.7616, 0.7616f, 0, 1.25, 1.25},
    /* 2^-28.8 and 2^-14.9, relative: the start of a Newton step */
    {"trisect", trisect_f64, trisect_f32, quad_trisect, double_trisect, 1.0, 1.0f, 0, 0x1.2p24,
     0x1.1p9},
};
enum
{
    FUNCTIONS = sizeof functions / sizeof functions[0]
};

struct worst
{
    double ulp;
    double input;
    int broken; /* symmetry, sign of zero, NaN */
};

/* splitmix64: the same inputs on every run */
static uint64_t random_state;

static uint64_t random_bits(void)
{
    uint64_t z = (random_state += UINT64_C(0x9e3779b97f4a7c15));
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

static double random_unit(void)
{
    return (double)(random_bits() >> 11) * 0x1p-53;
}

/* ulp of the binade that `value` lies in, for a format with that many bits and that least exponent
 * (of the smallest subnormal), from the word: frexp and ldexp would take as long as the functions */
static double ulp_of(double value, int bits, int least)
{
    uint64_t word;
    int e;
    memcpy(&word, &value, sizeof word);
    /* of zero and of subnormals less than any format has */
    e = (int)(word >> 52 & 0x7ff) - 1022 - bits;
    e = e < least ? least : e;
    word = e < -1022 ? UINT64_C(1) << (e + 1074) : (uint64_t)(e + 1023) << 52;
    memcpy(&value, &word, sizeof value);
    return value;
}

static int same64(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static int same32(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static void try64(const struct function *f, double x, struct worst *w)
{
    double got, ulp, error;
    quad want;
    if (!(x >= 0 && x <= f->end))
    {
        return;
    }
    got = f->f64(x);
    want = f->ref64((quad)x);
    /* rounding the reference to double must not lift it into the next binade */
    ulp = ulp_of((double)(want * (1 - (quad)0x1p-54)), 53, -1074);
    error = (double)(fabsq((quad)got - want) / (quad)ulp);
    if (!(error <= w->ulp)) /* NaN counts as worst */
    {
        w->ulp = error;
        w->input = x;
    }
    if (!same64(f->f64(-x), f->even ? got : -got) || (x == 0 && !same64(got, 0.0)))
    {
        w->broken = 1;
    }
}

static struct worst measure64(const struct function *f, long points)
{
    static const double hard[] = {0.0,     0x1p-1074, 0x1.8p-1073, 0x1p-1023, 0x1p-1022, 1e-300,
                                  1e-160,  1e-154,    1e-16,       1e-8,      0x1p-27,   0x1p-26,
                                  0x1p-18, 0x1p-17,   0x1p-16,     0.25,      0.3125,    0.5,
                                  0.5625,  0.6875,    0.75};
    struct worst w = {0, 0, 0};
    size_t h;
    long i;
    for (h = 0; h < sizeof hard / sizeof hard[0]; h++)
    {
        double up = hard[h], down = hard[h];
        for (i = 0; i < 100; i++)
        {
            try64(f, up, &w);
            try64(f, down, &w);
            up = nextafter(up, 2.0);
            down = nextafter(down, -1.0);
        }
    }
    {
        double x = f->end;
        for (i = 0; i < 1000; i++)
        {
            try64(f, x, &w);
            x = nextafter(x, 0.0);
        }
    }
    random_state = 1;
    for (i = 0; i < points; i++)
    {
        double far = ldexp(1.0 + random_unit(), -(int)(random_bits() % 1075));
        double near = f->end * ldexp(1.0 + random_unit(), -(int)(random_bits() % 54));
        if (i % 16 == 0)
        {
            try64(f, far, &w);
        }
        try64(f, i % 4 == 1 ? near : i % 4 == 2 ? f->end - near : f->end * random_unit(), &w);
    }
    if (!isnan(f->f64((double)NAN)))
    {
        w.broken = 1;
    }
    return w;
}

static struct worst measure32(const struct function *f, int full)
{
    struct worst w = {0, 0, 0};
    uint32_t bits, top, dense;
    float start = 0x1p-5f;
    memcpy(&top, &f->end32, sizeof top);
    memcpy(&dense, &start, sizeof dense);
    for (bits = 0; bits <= top; bits += full || bits >= dense ? 1 : 1009)
    {
        float x, got;
        double want, error;
        memcpy(&x, &bits, sizeof x);
        got = f->f32(x);
        want = f->ref32((double)x);
        error = fabs((double)got - want) / ulp_of(want, 24, -149);
        if (!(error <= w.ulp))
        {
            w.ulp = error;
            w.input = (double)x;
        }
        if (!same32(f->f32(-x), f->even ? got : -got) || (bits == 0 && !same32(got, 0.0f)))
        {
            w.broken = 1;
        }
    }
    if (!isnan(f->f32((float)NAN)))
    {
        w.broken = 1;
    }
    return w;
}

static int report(const char *name, const char *precision, const struct worst *w, double bound)
{
    int bad = w->broken || !(w->ulp <= bound);
    printf("%-16s %-9s %8.4f  %-24a %7.2f  %s\n", name, precision, w->ulp, w->input, bound,
           w->broken ? "FAIL: sign, zero or NaN"
           : bad     ? "FAIL"
                     : "ok");
    fflush(stdout);
    return bad;
}

int main(int argc, char **argv)
{
    long points = 1000000;
    int full = 0, failures = 0, i;
    if (argc > 1)
    {
        full = strcmp(argv[1], "full") == 0;
        points = full ? 20000000 : strtol(argv[1], NULL, 10);
    }
    printf("%-16s %-9s %8s  %-24s %7s\n", "function", "precision", "ulp", "input", "bound");
    for (i = 0; i < FUNCTIONS; i++)
    {
        const struct function *f = &functions[i];
        struct worst w = measure64(f, points);
        failures += report(f->name, "double", &w, f->bound64);
        w = measure32(f, full);
        failures += report(f->name, "float", &w, f->bound32);
    }
    return failures > 0;
}

#endif
