/* SPDX-License-Identifier: MIT
 *
 * How far from where it was does a point come back that goes to a face and to the sphere again, as
 * text, the way cubemap-project reads and writes it? Bound: 5 nm on Earth, for every mapping.
 *
 *   roundtrip [N [SEED]]           N random directions for every mapping, in this process, and as
 *                                  many numbers against the C library; exit status 1 if broken
 *   roundtrip points N SEED        print N random lines LON LAT
 *   roundtrip compare FILE FILE    print the largest distance between the same lines of two files;
 *                                  exit status 1 if it is above the bound
 */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cubemap/cubemap.h>

#include "tools/cli/degrees.h"
#include "tools/cli/number_word.h"
#include "tests/amount.h"
#include "truth/cube_count.h"

#define BOUND_NANOMETRES 5.0
#define EARTH_NANOMETRES 6371007.2e9
#define PI 3.14159265358979323846

enum
{
    BLOCK = 1024
};

typedef struct lonlat
{
    double longitude;
    double latitude;
} lonlat;

typedef struct extreme
{
    double distance; /* nm */
    lonlat where;
} extreme;

/* ------------------------------------------------------------------------------- random points */

/* SplitMix64 (Steele, Lea, Flood 2014). */
static uint64_t next_random(uint64_t *state)
{
    uint64_t value = *state += 0x9e3779b97f4a7c15u;
    value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
    value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
    return value ^ (value >> 31);
}

/* In [0, 1). */
static double next_uniform(uint64_t *state)
{
    return ldexp((double)(next_random(state) >> 11), -53);
}

/* Uniform on the sphere. */
static lonlat random_point(uint64_t *state)
{
    lonlat point;
    point.longitude = 360 * next_uniform(state) - 180;
    point.latitude = asin(2 * next_uniform(state) - 1) * (180 / PI);
    return point;
}

/* On or close to face centres, edges, corners, diagonals, poles and the antimeridian. */
static lonlat hard_point(uint64_t *state)
{
    const double latitude[] = {-90, -45, -35.264389682754654, 0, 35.264389682754654, 45, 90};
    const double away = pow(10, -16 * next_uniform(state));
    lonlat point;
    point.longitude = 45 * (double)(next_random(state) % 9) - 180;
    point.latitude = latitude[next_random(state) % 7];
    if (next_random(state) % 2 != 0)
    {
        point.longitude += away * (next_uniform(state) - 0.5);
    }
    if (next_random(state) % 2 != 0)
    {
        point.latitude += away * (next_uniform(state) - 0.5);
    }
    point.latitude = fmin(fmax(point.latitude, -90), 90);
    return point;
}

/* The haversine formula in differences that double has exactly: well-conditioned if near. */
static double distance_between(lonlat a, lonlat b)
{
    double turn = a.longitude - b.longitude;
    if (fabs(turn) > 180)
    {
        turn =
            (a.longitude - copysign(180, a.longitude)) - (b.longitude - copysign(180, b.longitude));
    }
    const double across = sin(turn * (PI / 360));
    const double along = sin((a.latitude - b.latitude) * (PI / 360));
    double cosine_a;
    double cosine_b;
    double sine;
    degrees_sine_cosine(a.latitude, &sine, &cosine_a);
    degrees_sine_cosine(b.latitude, &sine, &cosine_b);
    const double half = sqrt(along * along + cosine_a * cosine_b * across * across);
    return 2 * asin(fmin(half, 1)) * EARTH_NANOMETRES;
}

/* ------------------------------------------------------------------------------- round trip */

/* The value after it has been text. */
static double as_text(double value)
{
    char text[CM_NUMBER_SIZE];
    double again = (double)NAN;
    const size_t length = cm_number_write(value, CM_NUMBER_DIGITS, text);
    return cm_number_parse(text, length, &again) ? again : (double)NAN;
}

static void note(extreme *worst, double distance, lonlat where)
{
    /* a NaN is as bad as it gets */
    if (!(distance <= worst->distance))
    {
        worst->distance = isnan(distance) ? (double)INFINITY : distance;
        worst->where = where;
    }
}

static void round_trip_block(const cm_mapping *mapping, const lonlat *point, size_t count,
                             extreme *worst)
{
    static double x[BLOCK];
    static double y[BLOCK];
    static double z[BLOCK];
    static uint8_t face[BLOCK];

    for (size_t i = 0; i < count; i++)
    {
        double direction[3];
        degrees_to_direction(as_text(point[i].longitude), as_text(point[i].latitude), direction);
        x[i] = direction[0];
        y[i] = direction[1];
        z[i] = direction[2];
    }
    cm_forward_array(mapping, count, x, y, z, face, x, y);
    for (size_t i = 0; i < count; i++)
    {
        x[i] = as_text(x[i]);
        y[i] = as_text(y[i]);
    }
    cm_inverse_array(mapping, count, face, x, y, x, y, z);
    for (size_t i = 0; i < count; i++)
    {
        const double direction[3] = {x[i], y[i], z[i]};
        lonlat back;
        degrees_from_direction(direction, &back.longitude, &back.latitude);
        back.longitude = as_text(back.longitude);
        back.latitude = as_text(back.latitude);
        note(worst, distance_between(point[i], back), point[i]);
    }
}

static extreme round_trip(const cm_mapping *mapping, uint64_t count, uint64_t seed,
                          lonlat (*next_point)(uint64_t *))
{
    static lonlat point[BLOCK];
    extreme worst = {0, {0, 0}};
    for (uint64_t done = 0; done < count; done += BLOCK)
    {
        const size_t block = count - done < BLOCK ? (size_t)(count - done) : BLOCK;
        for (size_t i = 0; i < block; i++)
        {
            point[i] = next_point(&seed);
        }
        round_trip_block(mapping, point, block, &worst);
    }
    return worst;
}

static bool check_mapping(const char *name, const cm_frame *frame, uint64_t count, uint64_t seed)
{
    cm_mapping *mapping = NULL;
    if (cm_mapping_create(name, frame, &mapping) != CM_OK)
    {
        printf("%-12s %-5s cannot be created\n", name, frame->identifier);
        return false;
    }
    const extreme worst = round_trip(mapping, count, seed, random_point);
    const extreme hard = round_trip(mapping, (count + 3) / 4, seed, hard_point);
    const bool good = fmax(worst.distance, hard.distance) <= BOUND_NANOMETRES;
    printf("%-12s %-5s %9.3f  %24.17g %24.17g  %9.3f  %24.17g %24.17g%s\n", name, frame->identifier,
           worst.distance, worst.where.longitude, worst.where.latitude, hard.distance,
           hard.where.longitude, hard.where.latitude, good ? "" : "  TOO FAR");
    fflush(stdout);
    cm_mapping_destroy(mapping);
    return good;
}

static bool check_mappings(uint64_t count, uint64_t seed)
{
    bool good = true;
    printf("Round trip of %llu random and %llu hard points, seed %llu: worst distance in nm on "
           "Earth, and where; bound: %g\n\n",
           (unsigned long long)count, (unsigned long long)((count + 3) / 4),
           (unsigned long long)seed, BOUND_NANOMETRES);
    printf("%-12s %-5s %9s  %24s %24s  %9s  %24s %24s\n", "mapping", "frame", "random", "lon",
           "lat", "hard", "lon", "lat");
    for (size_t i = 0; i < cube_count(); i++)
    {
        const char *const name = cm_catalogue_at(i)->identifier;
        /* all mappings in the first frame, the recommended one in every frame */
        const size_t frames = strcmp(name, CM_MAPPING_RECOMMENDED) == 0 ? cm_frame_count() : 1;
        for (size_t j = 0; j < frames; j++)
        {
            good = check_mapping(name, cm_frame_at(j), count, seed) && good;
        }
    }
    return good;
}

/* ------------------------------------------------------------------------------- numbers */

/* The bits of any double, or a number as they occur here, or one with few digits or few bits. */
static double random_number(uint64_t *state)
{
    const uint64_t bits = next_random(state);
    double value;
    switch (next_random(state) % 4)
    {
    case 0:
        memcpy(&value, &bits, sizeof value);
        return value;
    case 1:
        return ldexp((double)(int64_t)bits, -(int)(next_random(state) % 110));
    case 2:
        return (double)(int64_t)(bits % 2000001) / pow(10, (double)(next_random(state) % 12));
    default:
        return ldexp((double)(int64_t)(bits % 2000001), -(int)(next_random(state) % 60));
    }
}

/* Is our reader in agreement with the C library about this text? */
static bool reads_alike(const char *text)
{
    double ours = 0;
    char *their_end;
    const double theirs = strtod(text, &their_end);
    const char *const our_end = number_or_word(text, text + strlen(text), &ours);
    if (our_end != their_end || (memcmp(&ours, &theirs, sizeof ours) != 0 && !isnan(theirs)))
    {
        printf("number_or_word: '%s' is %a, not %a\n", text, theirs, ours);
        return false;
    }
    return true;
}

static bool check_number(double value, int digits)
{
    char ours[CM_NUMBER_SIZE];
    char theirs[64];
    const size_t length = cm_number_write(value, digits, ours);
    snprintf(theirs, sizeof theirs, "%.*g", digits, value == 0 ? 0 : value);
    if (!isnan(value) && (strcmp(ours, theirs) != 0 || length != strlen(ours)))
    {
        printf("cm_number_write: %a with %d digits is %s, not %s\n", value, digits, theirs, ours);
        return false;
    }
    return reads_alike(theirs);
}

/* A random text with up to 24 digits, which may lie between two doubles. */
static bool check_text(uint64_t *state)
{
    char text[48];
    const unsigned count = (unsigned)(next_random(state) % 24) + 1;
    const unsigned point = (unsigned)(next_random(state) % (count + 2));
    size_t length = 0;
    for (unsigned i = 0; i < count; i++)
    {
        if (i == point)
        {
            text[length++] = '.';
        }
        text[length++] = (char)('0' + next_random(state) % 10);
    }
    const uint64_t range = next_random(state) % 8 == 0 ? 700 : 50;
    snprintf(text + length, sizeof text - length, "e%d",
             (int)(next_random(state) % range) - (int)(range / 2));
    return reads_alike(text);
}

/* A number and its neighbours, with every count of digits. */
static bool check_around(double centre)
{
    bool good = true;
    double up = centre;
    double down = centre;
    for (int step = 0; step < 5 && good; step++)
    {
        for (int digits = 1; digits <= CM_NUMBER_DIGITS; digits++)
        {
            good = good && check_number(up, digits) && check_number(-down, digits);
        }
        up = nextafter(up, (double)INFINITY);
        down = nextafter(down, 0);
    }
    return good;
}

/* Powers of two and ten, every one or one of so many. */
static bool check_powers(int one_in)
{
    bool good = true;
    for (int exponent = -1080; exponent < 1025 && good; exponent += one_in)
    {
        good = check_around(ldexp(1, exponent));
    }
    for (int exponent = -360; exponent < 342 && good; exponent += one_in)
    {
        char text[16];
        snprintf(text, sizeof text, "1e%d", exponent);
        good = check_around(strtod(text, NULL));
    }
    return good;
}

static bool check_numbers(uint64_t count, uint64_t seed)
{
    const char *const texts[] = {
        "0",
        "-0",
        "+1",
        ".5",
        "5.",
        "-.5e1",
        "1e",
        "1e+",
        "1e5x",
        "1.e-2",
        "9007199254740993",
        "9007199254740992.5",
        "9007199254740993.0000000000000000001",
        "1e400",
        "-1e400",
        "1e-400",
        "4.9406564584124654e-324",
        "2.4703282292062327208e-324",
        "1.7976931348623159e308",
        "inf",
        "-Infinity",
        "NaN",
        "1e99999999999999999999",
        "0e99999999999999999999",
        "0.00000000000000000000000000000000000000000000000000000000000000000000000000001e77",
        "100000000000000000000000000000000000000000000000000000000000000000000000000e-74"};
    bool good = check_powers((int)step_of(7));
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
    {
        good = reads_alike(texts[i]) && good;
    }
    for (uint64_t i = 0; i < count && good; i++)
    {
        good = check_number(random_number(&seed), (int)(next_random(&seed) % 17) + 1) &&
               check_number(random_number(&seed), CM_NUMBER_DIGITS) && check_text(&seed);
    }
    printf("numbers: %s\n", good ? "as the C library reads and writes them" : "WRONG");
    return good;
}

/* ------------------------------------------------------------------------------- degrees */

static bool same(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

/* Multiples of 90 degrees give the axes to the bit, with +0, and back; 45 gives equal sizes. */
static bool check_axes(void)
{
    const double value[] = {0, 1, 0, -1};
    bool good = true;
    for (int turn = -9; turn <= 9; turn++)
    {
        double sine;
        double cosine;
        const double huge = turn * 0x1p60; /* 2^60 = 360 k + 136 */
        degrees_sine_cosine(90.0 * turn, &sine, &cosine);
        good = good && same(sine, value[(unsigned)turn & 3]) &&
               same(cosine, value[(unsigned)(turn + 1) & 3]);
        degrees_sine_cosine(90.0 * turn + 45, &sine, &cosine);
        good = good && same(fabs(sine), sqrt(0.5)) && same(fabs(cosine), sqrt(0.5));
        double small;
        degrees_sine_cosine(huge, &sine, &cosine);
        degrees_sine_cosine(136.0 * turn, &small, &cosine);
        good = good && same(sine, small);
        double pole[3];
        degrees_to_direction(7.5 * turn, turn < 0 ? -90 : 90, pole);
        good = good && same(pole[0], 0) && same(pole[1], 0) && fabs(pole[2]) == 1;
    }
    for (int turn = -4; turn <= 4; turn++)
    {
        double direction[3];
        lonlat back;
        degrees_to_direction(45.0 * turn, 0, direction);
        degrees_from_direction(direction, &back.longitude, &back.latitude);
        good = good && same(back.longitude, turn == -4 ? 180 : 45.0 * turn) && back.latitude == 0;
    }
    return good;
}

/* Sine and cosine against long double, where that has more digits than double. */
static bool check_sines(uint64_t count, uint64_t seed)
{
    double worst = 0;
    for (uint64_t i = 0; i < count; i++)
    {
        double sine;
        double cosine;
        const double angle = 90 * next_uniform(&seed) - 45;
        const long double radians =
            (long double)angle * (3.14159265358979323846264338327950288L / 180);
        degrees_sine_cosine(angle, &sine, &cosine);
        worst = fmax(worst, (double)fabsl((long double)sine - sinl(radians)) / fabs(sine) / 2);
        worst = fmax(worst, (double)fabsl((long double)cosine - cosl(radians)));
    }
    printf("degrees: sine and cosine within %.3g of the truth\n", worst);
    return worst < 1.2e-16;
}

/* Degrees to direction and back, without a mapping. */
static bool check_directions(uint64_t count, uint64_t seed)
{
    extreme worst = {0, {0, 0}};
    for (uint64_t i = 0; i < count; i++)
    {
        const lonlat point = i % 4 == 0 ? hard_point(&seed) : random_point(&seed);
        double direction[3];
        lonlat back;
        degrees_to_direction(point.longitude, point.latitude, direction);
        degrees_from_direction(direction, &back.longitude, &back.latitude);
        note(&worst, distance_between(point, back), point);
    }
    printf("degrees: there and back within %.3f nm, the worst at %.17g %.17g\n", worst.distance,
           worst.where.longitude, worst.where.latitude);
    return worst.distance < 3;
}

static bool check_degrees(uint64_t count, uint64_t seed)
{
    const bool axes = check_axes();
    printf("degrees: axes and diagonals %s\n", axes ? "exact" : "WRONG");
    const bool sines = check_sines(count, seed);
    return check_directions(count, seed) && sines && axes;
}

/* ------------------------------------------------------------------------------- main */

static int print_points(uint64_t count, uint64_t seed)
{
    for (uint64_t i = 0; i < count; i++)
    {
        char line[2 * CM_NUMBER_SIZE];
        const lonlat point = random_point(&seed);
        size_t length = cm_number_write(point.longitude, CM_NUMBER_DIGITS, line);
        line[length++] = ' ';
        length += cm_number_write(point.latitude, CM_NUMBER_DIGITS, line + length);
        line[length++] = '\n';
        if (fwrite(line, 1, length, stdout) != length)
        {
            return EXIT_FAILURE;
        }
    }
    return fflush(stdout) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

/* One line LON LAT, by the C library; false at the end or if it is none. */
static bool read_point(FILE *stream, lonlat *point)
{
    char line[256];
    char *end;
    if (fgets(line, sizeof line, stream) == NULL)
    {
        return false;
    }
    point->longitude = strtod(line, &end);
    char *const second = end;
    point->latitude = strtod(second, &end);
    return end != second;
}

static int compare_files(const char *first_name, const char *second_name)
{
    FILE *const first = fopen(first_name, "r");
    FILE *const second = fopen(second_name, "r");
    if (first == NULL || second == NULL)
    {
        fprintf(stderr, "roundtrip: cannot open %s\n", first == NULL ? first_name : second_name);
        return EXIT_FAILURE;
    }
    extreme worst = {0, {0, 0}};
    uint64_t count = 0;
    lonlat a;
    lonlat b;
    while (read_point(first, &a) && read_point(second, &b))
    {
        note(&worst, distance_between(a, b), a);
        count++;
    }
    const bool whole = feof(first) && fgetc(second) == EOF && count > 0;
    printf("%9.3f nm at most, at %.17g %.17g, in %llu lines%s\n", worst.distance,
           worst.where.longitude, worst.where.latitude, (unsigned long long)count,
           whole ? "" : ": THE FILES ARE NOT OF ONE LENGTH");
    fclose(first);
    fclose(second);
    return whole && worst.distance <= BOUND_NANOMETRES ? EXIT_SUCCESS : EXIT_FAILURE;
}

int main(int argc, char **argv)
{
    if (argc == 4 && strcmp(argv[1], "points") == 0)
    {
        return print_points(strtoull(argv[2], NULL, 10), strtoull(argv[3], NULL, 10));
    }
    if (argc == 4 && strcmp(argv[1], "compare") == 0)
    {
        return compare_files(argv[2], argv[3]);
    }
    const uint64_t count = argc > 1 ? strtoull(argv[1], NULL, 10) : 10000;
    const uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
    if (argc > 3 || count == 0)
    {
        fprintf(stderr, "usage: roundtrip [N [SEED]] | points N SEED | compare FILE FILE\n");
        return 2;
    }
    bool good = check_numbers(count, seed);
    good = check_degrees(count, seed) && good;
    good = check_mappings(count, seed) && good;
    printf("\n%s\n", good ? "passed" : "FAILED");
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
