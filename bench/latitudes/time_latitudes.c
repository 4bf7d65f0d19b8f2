/* SPDX-License-Identifier: MIT
 *
 * Speed beside accuracy of conversions between latitudes on WGS 84, this library beside GeographicLib, in one run:
 * nanoseconds a point, the best of interleaved repetitions over arrays that stay in cache, and the worst error over
 * latitudes of all kinds against quadruple precision, in units of 2^-53 radians. Writes tables in Markdown.
 *
 * Usage: latitudes [speed|accuracy|approximation] [REPETITIONS]
 */
#define _POSIX_C_SOURCE 200809L

#include "truth/quad_latitude.h"
#include "time_latitudes.h"

#include <math.h>
#include <string.h>
#include <time.h>

enum
{
    COUNT = 2048,
    JUDGED = 400,
    SETS_MAX = 6
};

static const double pole = 1.5707963267948966;
static const double degree = 0.017453292519943295;
static const double earth_radius = 6371007.2;

static double radians[COUNT], degrees[COUNT], other[COUNT];
static double direction[3][COUNT], turned[3][COUNT];

typedef struct pair
{
    cm_latitude from, to;
} pair;

static const pair pairs[] = {
    {CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_GEOCENTRIC},
    {CM_LATITUDE_GEOCENTRIC, CM_LATITUDE_GEOGRAPHIC},
    {CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_AUTHALIC},
    {CM_LATITUDE_AUTHALIC, CM_LATITUDE_GEOGRAPHIC},
    {CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_CONFORMAL},
    {CM_LATITUDE_CONFORMAL, CM_LATITUDE_GEOGRAPHIC},
    {CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_RECTIFYING},
    {CM_LATITUDE_RECTIFYING, CM_LATITUDE_GEOGRAPHIC},
};
#define PAIRS (sizeof pairs / sizeof *pairs)

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double random_number(void)
{
    static unsigned long long state = 88172645463325252ull;
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (double)(state >> 11) * 0x1p-53;
}

/* Places all over the sphere, and a tenth of them beside a pole and the equator. */
static void fill(void)
{
    for (int i = 0; i < COUNT; i++)
    {
        double small = pow(10.0, -12.0 * random_number());
        double latitude = i % 20 == 0 ? small : i % 20 == 1 ? pole - small : asin(random_number());
        double longitude = 6.283185307179586 * random_number();
        radians[i] = i % 2 == 0 ? latitude : -latitude;
        degrees[i] = radians[i] / degree;
        direction[0][i] = cos(radians[i]) * cos(longitude);
        direction[1][i] = cos(radians[i]) * sin(longitude);
        direction[2][i] = sin(radians[i]);
    }
}

static cm_latitude_conversion *make(pair p, const char *instructions, int exact, double tolerance)
{
    cm_latitude_conversion *made = NULL;
    cm_latitude_options o = {
        .size = sizeof o, .instructions = instructions, .exact = exact, .tolerance = tolerance};
    if (cm_latitude_conversion_create(cm_ellipsoid_find("WGS84"), p.from, p.to, &o, &made) != CM_OK)
    {
        fprintf(stderr, "latitudes: no conversion\n");
        exit(1);
    }
    return made;
}

/* ---- Accuracy ---- */

static latitude_quad truth_of(pair p, latitude_quad latitude)
{
    latitude_quad size = fabsq(latitude);
    if (size == 0.0Q || size >= M_PI_2q)
    {
        return latitude;
    }
    latitude_quad tangent = tanq(size);
    double f = cm_ellipsoid_find("WGS84")->f;
    latitude_quad found = atanq(quad_latitude(f, p.from, p.to, tangent, tangent));
    return latitude < 0.0Q ? -found : found;
}

/* The worst error of the first latitudes, whose unit has so many radians. */
static double worst_of(pair p, const double *from, const double *to, latitude_quad unit)
{
    double worst = 0.0;
    for (int i = 0; i < JUDGED; i++)
    {
        latitude_quad error = to[i] * unit - truth_of(p, from[i] * unit);
        worst = fmax(worst, (double)fabsq(error) * 0x1p53);
    }
    return worst;
}

/* ---- Speed ---- */

static double peer_seconds(pair p)
{
    double start = seconds();
    return peer_convert(p.from, p.to, COUNT, degrees, other) ? seconds() - start : HUGE_VAL;
}

static double angle_seconds(const cm_latitude_conversion *c)
{
    double start = seconds();
    cm_latitude_convert_array(c, COUNT, radians, other);
    return seconds() - start;
}

static double direction_seconds(const cm_latitude_conversion *c)
{
    double start = seconds();
    cm_latitude_convert_direction_array(c, COUNT, direction[0], direction[1], direction[2],
                                        turned[0], turned[1], turned[2]);
    return seconds() - start;
}

static void keep_least(double *least, double value)
{
    *least = value < *least ? value : *least;
}

static void print_time(double best)
{
    double ns = best * 1e9 / COUNT;
    printf(isfinite(best) ? " %.3g |" : " - |", ns);
}

static void speed_row(pair p, int repetitions)
{
    cm_latitude_conversion *own[SETS_MAX];
    size_t sets = cm_instructions_count();
    double best[SETS_MAX], best_direction = HUGE_VAL, best_exact = HUGE_VAL, best_peer = HUGE_VAL;
    cm_latitude_conversion *exact = make(p, NULL, 1, 0.0);
    for (size_t k = 0; k < sets; k++)
    {
        own[k] = make(p, cm_instructions_at(k), 0, 0.0);
        best[k] = HUGE_VAL;
    }
    for (int r = 0; r < repetitions; r++)
    {
        for (size_t k = 0; k < sets; k++)
        {
            keep_least(&best[k], angle_seconds(own[k]));
        }
        keep_least(&best_direction, direction_seconds(own[sets - 1]));
        if (r % 4 == 0)
        {
            keep_least(&best_peer, peer_seconds(p));
            keep_least(&best_exact, angle_seconds(exact));
        }
    }
    printf("| %s to %s | %d |", cm_latitude_name(p.from), cm_latitude_name(p.to),
           cm_latitude_conversion_order(own[0]));
    print_time(best_peer);
    peer_convert(p.from, p.to, COUNT, degrees, other);
    printf(isfinite(best_peer) ? " %.2g |" : " - |", worst_of(p, degrees, other, M_PIq / 180.0Q));
    for (size_t k = 0; k < sets; k++)
    {
        print_time(best[k]);
    }
    angle_seconds(own[sets - 1]);
    printf(" %.2g |", worst_of(p, radians, other, 1.0Q));
    print_time(best_direction);
    print_time(best_exact);
    printf(isfinite(best_peer) ? " %.0f |\n" : " - |\n", best_peer / best[sets - 1]);
    for (size_t k = 0; k < sets; k++)
    {
        cm_latitude_conversion_destroy(own[k]);
    }
    cm_latitude_conversion_destroy(exact);
}

static void print_speed(int repetitions)
{
    size_t sets = cm_instructions_count();
    printf("| conversion | terms | %s, ns | its error |",
           peer_name() == NULL ? "no peer" : peer_name());
    for (size_t k = 0; k < sets; k++)
    {
        printf(" %s, ns |", cm_instructions_at(k));
    }
    printf(" error | directions, ns | closed form, ns | times as fast |\n|---|---|---|---|");
    for (size_t k = 0; k < sets; k++)
    {
        printf("---|");
    }
    printf("---|---|---|---|\n");
    for (size_t i = 0; i < PAIRS; i++)
    {
        speed_row(pairs[i], repetitions);
    }
}

/* ---- Orders and their errors ---- */

static void accuracy_row(pair p, const char *name, double tolerance)
{
    cm_latitude_conversion *c = make(p, NULL, 0, tolerance);
    cm_latitude_convert_array(c, COUNT, radians, other);
    double worst = worst_of(p, radians, other, 1.0Q);
    printf("| %s to %s | %s | %d | %.2g m | %.2g m | %.3g |\n", cm_latitude_name(p.from),
           cm_latitude_name(p.to), name, cm_latitude_conversion_order(c),
           cm_latitude_conversion_error(c) * earth_radius, worst * 0x1p-53 * earth_radius, worst);
    cm_latitude_conversion_destroy(c);
}

static void print_accuracy(void)
{
    printf("| conversion | tolerance | terms | stated | measured | in 2^-53 rad "
           "|\n|---|---|---|---|---|---|\n");
    for (size_t i = 2; i < PAIRS; i++)
    {
        accuracy_row(pairs[i], "1 m", 1.0 / earth_radius);
        accuracy_row(pairs[i], "1 mm", 1e-3 / earth_radius);
        accuracy_row(pairs[i], "none: full double", 0.0);
    }
}

/* Where is the approximation of the authalic latitude worst? */
static void print_approximation(void)
{
    const pair approximation = {CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_AUTHALIC_APPROXIMATION};
    const pair authalic = {CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_AUTHALIC};
    double worst[2] = {0.0, 0.0};
    double at[2] = {0.0, 0.0};
    for (int i = 1; i < 9000; i++)
    {
        double latitude = i * 0.01 * degree;
        double error = (double)(truth_of(approximation, latitude) - truth_of(authalic, latitude));
        int side = error > 0.0;
        if (fabs(error) > fabs(worst[side]))
        {
            worst[side] = error;
            at[side] = i * 0.01;
        }
    }
    for (int side = 0; side < 2; side++)
    {
        printf("%+.5f\" = %+.3f m at %.2f degrees\n", worst[side] / degree * 3600.0,
               worst[side] * earth_radius, at[side]);
    }
}

int main(int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "speed";
    double repetitions = 200.0;
    if (argc > 2 && !cm_number_parse(argv[2], strlen(argv[2]), &repetitions))
    {
        repetitions = 0.0;
    }
    gauss_prepare();
    fill();
    if (strcmp(what, "speed") == 0 && repetitions >= 1.0 && repetitions <= 1e9)
    {
        print_speed((int)repetitions);
    }
    else if (strcmp(what, "accuracy") == 0)
    {
        print_accuracy();
    }
    else if (strcmp(what, "approximation") == 0)
    {
        print_approximation();
    }
    else
    {
        fprintf(stderr, "usage: %s [speed|accuracy|approximation] [REPETITIONS]\n", argv[0]);
        return 2;
    }
    return 0;
}
