/* SPDX-License-Identifier: MIT
 *
 * Maps with one face, and what is between disc and square: against vectors of high precision
 * (FOLDER/charts/X.txt, made by research/vectors/vectors), in every instruction set; round trips, domains,
 * orientation, borders, symmetries and special cases.
 *
 * Bounds against the truth are 8 eps absolute for each coordinate, eps = 2^-53 in double, 2^-24 in float. The
 * truth in float is the library in double for the rounded input.
 */
#include "tests/suite.h"
#include "tests/text_files.h"

#include <cubemap/options.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))
#define EPS 0x1p-53
#define EPS_F32 0x1p-24
#define BOUND 8.0
#define PI 3.14159265358979324

/* 5 nm on Earth */
#define NEAR_ON_EARTH (5e-9 / EARTH_RADIUS)
#define NEAR_BY_PARTS (5.5e-9 / EARTH_RADIUS)

static const char *folder;

static cm_mapping *make_with(const char *specification, const char *instructions)
{
    const cm_options options = {.size = sizeof options, .instructions = instructions};
    cm_mapping *mapping = NULL;
    cm_status status = cm_mapping_create_with(specification, NULL, &options, &mapping);
    REQUIRE(status == CM_OK, "%s: %s", specification, cm_status_text(status));
    return mapping;
}

/* ---- Vectors ---- */

typedef struct vector
{
    char kind;
    int tie;
    int inputs;
    int outputs;
    double in[3];
    long double truth[3];
} vector;

static double worst_error;

static int read_vector(const char *text, vector *v)
{
    char *end;
    *v = (vector){.kind = text[0]};
    v->inputs = v->kind == 'D' ? 3 : 2;
    v->outputs = v->kind == 'R' ? 3 : 2;
    text++;
    for (int k = 0; k < v->inputs; k++, text = end)
    {
        v->in[k] = strtod(text, &end);
        REQUIRE(end != text, "not a number: %s", text);
    }
    for (int k = 0; k < v->outputs; k++, text = end)
    {
        v->truth[k] = strtold(text, &end);
        REQUIRE(end != text, "not a number: %s", text);
    }
    v->tie = strcmp(text, " tie\n") == 0;
    return strchr("FIDR", v->kind) != NULL && (v->tie || strcmp(text, "\n") == 0);
}

static void call(const cm_mapping *mapping, const vector *v, double out[3])
{
    int good = 1;
    switch (v->kind)
    {
    case 'F':
        good = cm_warp(mapping, v->in, out) == CM_OK;
        break;
    case 'I':
        good = cm_unwarp(mapping, v->in, out) == CM_OK;
        break;
    case 'D':
        good = cm_forward(mapping, v->in, out) == 0;
        break;
    default:
        cm_inverse(mapping, 0, v->in, out);
        break;
    }
    REQUIRE(good, "%c %.17g %.17g %.17g", v->kind, v->in[0], v->in[1], v->in[2]);
}

static void call_f32(const cm_mapping *mapping, const vector *v, double out[3])
{
    const float in[3] = {(float)v->in[0], (float)v->in[1], (float)v->in[2]};
    float to[3] = {0.0F, 0.0F, 0.0F};
    int good = 1;
    switch (v->kind)
    {
    case 'F':
        good = cm_warp_f32(mapping, in, to) == CM_OK;
        break;
    case 'I':
        good = cm_unwarp_f32(mapping, in, to) == CM_OK;
        break;
    case 'D':
        good = cm_forward_f32(mapping, in, to) == 0;
        break;
    default:
        cm_inverse_f32(mapping, 0, in, to);
        break;
    }
    REQUIRE(good, "float: %c %.17g %.17g %.17g", v->kind, (double)in[0], (double)in[1],
            (double)in[2]);
    for (int k = 0; k < 3; k++)
    {
        out[k] = (double)to[k];
    }
}

/* Where the border meets itself a point of the sphere has two places, which differ in a sign. */
static double error_of(const vector *v, const double got[3], double eps)
{
    double worst = 0.0;
    for (int k = 0; k < v->outputs; k++)
    {
        long double truth = v->tie ? fabsl(v->truth[k]) : v->truth[k];
        long double result = v->tie ? fabsl((long double)got[k]) : (long double)got[k];
        double error = (double)fabsl(result - truth) / eps;
        worst = error <= worst ? worst : error;
    }
    return worst;
}

static void check_double(const cm_mapping *mapping, const char *name, const char *text,
                         const vector *v)
{
    double got[3];
    call(mapping, v, got);
    double error = error_of(v, got, EPS);
    REQUIRE(error <= BOUND, "%s, %s: %s%g eps: %.17g %.17g %.17g", name,
            cm_mapping_instructions(mapping), text, error, got[0], got[1], got[2]);
    worst_error = fmax(worst_error, error);
}

/* Is the rounded input a point that both precisions take, and not a tie for one of them? */
static int is_usable_in_float(const vector *v, const vector *rounded)
{
    double most = 0.0;
    for (int k = 0; k < v->inputs; k++)
    {
        most = fmax(most, fabs(rounded->in[k]));
        if (fabs(v->in[k]) > 1e37 || (v->in[k] != 0.0 && fabs(v->in[k]) < 1e-37))
        {
            return 0;
        }
    }
    return most > 0.0 || v->kind != 'D';
}

static void check_float(const cm_mapping *mapping, const char *name, const char *text,
                        const vector *v)
{
    vector rounded = *v;
    double truth[3] = {0.0, 0.0, 0.0};
    double got[3];
    for (int k = 0; k < v->inputs; k++)
    {
        rounded.in[k] = (double)(float)v->in[k];
    }
    if (!is_usable_in_float(v, &rounded))
    {
        return;
    }
    int is_disc = strncmp(name, "azimuthal", 9) == 0 || v->kind == 'F';
    if (v->kind != 'D' && is_disc && hypot(rounded.in[0], rounded.in[1]) > 1.0 + 1e-9)
    {
        return; /* a float's rim is not a double's */
    }
    if (v->kind == 'D' && cm_forward(mapping, rounded.in, truth) != 0)
    {
        return;
    }
    call(mapping, &rounded, truth);
    call_f32(mapping, &rounded, got);
    for (int k = 0; k < 3; k++)
    {
        rounded.truth[k] = (long double)truth[k];
    }
    double error = error_of(&rounded, got, EPS_F32);
    REQUIRE(error <= BOUND, "%s, %s, float: %s%g eps: %.9g %.9g %.9g, not %.9g %.9g %.9g", name,
            cm_mapping_instructions(mapping), text, error, got[0], got[1], got[2], truth[0],
            truth[1], truth[2]);
}

static void check_file(const char *path)
{
    char text[512];
    char specification[128] = "";
    size_t lines = 0;
    const char *name = strrchr(path, '/') + 1;
    FILE *file = fopen(path, "r");
    REQUIRE(file != NULL, "%s", path);
    cm_mapping *mapping[16] = {NULL};
    size_t sets = cm_instructions_count();
    worst_error = 0.0;
    while (fgets(text, sizeof text, file) != NULL)
    {
        if (text[0] == '#')
        {
            int named = sscanf(text, "# specification %127s", specification) == 1;
            for (size_t i = 0; named && i < sets; i++)
            {
                mapping[i] = make_with(specification, cm_instructions_at(i));
            }
            continue;
        }
        vector v;
        REQUIRE(mapping[0] != NULL && read_vector(text, &v), "%s: %s", name, text);
        for (size_t i = 0; i < sets; i++)
        {
            check_double(mapping[i], name, text, &v);
            check_float(mapping[i], name, text, &v);
        }
        lines++;
    }
    fclose(file);
    for (size_t i = 0; i < sets; i++)
    {
        cm_mapping_destroy(mapping[i]);
    }
    REQUIRE(lines >= 100, "%s: %zu lines", name, lines);
    printf("%-42s %4zu lines, %.2f eps at most\n", specification, lines, worst_error);
}

START_TEST(vectors_hold)
{
    char charts[512];
    text_files found = {0};
    snprintf(charts, sizeof charts, "%s/charts", folder);
    text_files_add(&found, charts);
    REQUIRE(found.count >= 40, "%s has %zu files", charts, found.count);
    for (size_t i = 0; i < found.count; i++)
    {
        check_file(found.path[i]);
    }
    free(found.path);
}
END_TEST

/* ---- Directions ---- */

/* Hard ones first, in number 9973, then random ones; 0 after the last. */
static int next_test_direction(size_t *index, uint64_t *state, double d[3])
{
    enum
    {
        HARD = 20000,
        RANDOM = 20000
    };
    static const double scales[] = {1.0, 3.0, 1e300, 1e-300, 0x1p-1060};
    static const double parts[] = {0.0,   1.0,  -1.0, 0.5,    -0.5,  1e-8, -1e-8, 1e-160,
                                   1e-16, -0.3, 0.3,  1e-300, 1e-12, 1e-4, -1e-4};
    size_t i = (*index)++;
    if (i >= HARD)
    {
        next_direction(state, d);
        return i < HARD + RANDOM;
    }
    do
    {
        for (int k = 0; k < 3; k++)
        {
            uint64_t bits = next_bits(state) >> 32;
            d[k] = parts[bits % COUNT(parts)];
            d[k] += bits >> 16 & 1 ? 0.0 : 0x1p-52 * d[k];
        }
    } while (d[0] == 0.0 && d[1] == 0.0 && d[2] == 0.0);
    for (int k = 0; k < 3; k++)
    {
        d[k] *= scales[i % COUNT(scales)];
    }
    return 1;
}

static double angle_of(const double a[3], const double b[3])
{
    int exponent;
    double scaled[3];
    frexp(fmax(fabs(a[0]), fmax(fabs(a[1]), fabs(a[2]))), &exponent);
    for (int k = 0; k < 3; k++)
    {
        scaled[k] = ldexp(a[k], -exponent);
    }
    return angle_between(scaled, b);
}

/* Those that come back within 5 nm wherever they see. */
static const char *const exact_charts[] = {"azimuthal:lambert",
                                           "azimuthal:stereographic",
                                           "azimuthal:breusing",
                                           "azimuthal:mixture",
                                           "azimuthal:equidistant",
                                           "azimuthal:gnomonic",
                                           "azimuthal:lambert:fov=60",
                                           "azimuthal:orthographic:fov=60",
                                           "quincuncial",
                                           "quincuncial:lambert,shirley",
                                           "quincuncial:mixture,squircle",
                                           "quincuncial:breusing,elliptical",
                                           "octahedral",
                                           "octahedral:clarberg"};

START_TEST(directions_come_back)
{
    for (size_t i = 0; i < COUNT(exact_charts); i++)
    {
        cm_mapping *mapping = make_mapping(exact_charts[i], NULL);
        uint64_t state = 5;
        double d[3];
        double worst = 0.0;
        size_t seen = 0;
        for (size_t k = 0; next_test_direction(&k, &state, d);)
        {
            double uv[2];
            double back[3];
            uint8_t face = cm_forward(mapping, d, uv);
            REQUIRE(face == 0 || face == CM_NO_FACE, "%s: %d", exact_charts[i], face);
            if (face != 0)
            {
                REQUIRE(isnan(uv[0]) && isnan(uv[1]), "%s: no face, but a point", exact_charts[i]);
                continue;
            }
            REQUIRE(fabs(uv[0]) <= 1.0 && fabs(uv[1]) <= 1.0, "%s: %.17g %.17g", exact_charts[i],
                    uv[0], uv[1]);
            cm_inverse(mapping, 0, uv, back);
            double angle = angle_of(d, back);
            /* what is beyond the rim by up to 1e-9 comes back on it */
            double slack = angle < 4e-9 && angle > 1e-12 &&
                                   fabs(hypot(uv[0], uv[1]) - 1.0) < 1e-15 &&
                                   cm_mapping_describe(mapping)->kind == CM_KIND_AZIMUTHAL
                               ? angle
                               : 0.0;
            worst = fmax(worst, angle - slack);
            int has_parts = cm_mapping_describe(mapping)->parts != NULL;
            REQUIRE(angle - slack <= (has_parts ? NEAR_BY_PARTS : NEAR_ON_EARTH),
                    "%s: %.17g %.17g %.17g: %.17g %.17g: %g nm", exact_charts[i], d[0], d[1], d[2],
                    uv[0], uv[1], angle * EARTH_RADIUS * 1e9);
            seen++;
        }
        REQUIRE(seen > 1000, "%s: %zu", exact_charts[i], seen);
        printf("%-34s %6zu directions come back within %.2f nm\n", exact_charts[i], seen,
               worst * EARTH_RADIUS * 1e9);
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* Where a law is flat a rounding of u and v is far more on the sphere: beside the antipode r = sin(t / 2) has no
 * slope, and beside the equator r = sin t. There an error e of the radius is sqrt(2 e) and more as an angle. In
 * any map of the whole sphere an error of the radius is pi and more times as much. */
START_TEST(flat_laws_lose_what_they_must)
{
    static const struct
    {
        const char *specification;
        double worst;  /* radians */
        double inside; /* cosine from which it is 10 nm */
    } flat[] = {
        {"azimuthal:equidistant:full=1", 2e-15, 0.0}, {"azimuthal:breusing:full=1", 2e-15, 0.0},
        {"azimuthal:orthographic", 8e-8, 0.75},       {"azimuthal:lambert:full=1", 8e-8, 0.0},
        {"azimuthal:mixture:full=1", 8e-8, 0.0},      {"border:lambert,shirley", 8e-8, 0.3},
        {"border:equidistant,elliptical", 8e-8, 0.3}};
    for (size_t i = 0; i < COUNT(flat); i++)
    {
        cm_mapping *mapping = make_mapping(flat[i].specification, NULL);
        uint64_t state = 6;
        double d[3];
        double worst = 0.0;
        for (size_t k = 0; next_test_direction(&k, &state, d);)
        {
            double uv[2];
            double back[3];
            static const double pole[3] = {0.0, 0.0, 1.0};
            if (cm_forward(mapping, d, uv) != 0)
            {
                continue;
            }
            cm_inverse(mapping, 0, uv, back);
            double angle = angle_of(d, back);
            worst = fmax(worst, angle);
            REQUIRE(angle <= flat[i].worst, "%s: %.17g %.17g %.17g: %g rad", flat[i].specification,
                    d[0], d[1], d[2], angle);
            REQUIRE(cos(angle_of(d, pole)) < flat[i].inside || angle <= 2.0 * NEAR_ON_EARTH,
                    "%s: %.17g %.17g %.17g: %g nm", flat[i].specification, d[0], d[1], d[2],
                    angle * EARTH_RADIUS * 1e9);
        }
        printf("%-34s comes back within %.3g m\n", flat[i].specification, worst * EARTH_RADIUS);
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* ---- Between disc and square ---- */

/* Those of the catalogue of one kind, which main has gathered. */
enum
{
    OF_KIND_MAX = 64
};

typedef struct gathered
{
    size_t count;
    const char *name[OF_KIND_MAX];
} gathered;

static gathered squares;
static gathered azimuthal;

static void gather(cm_kind kind, gathered *all)
{
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        if (cm_catalogue_at(i)->kind == kind && all->count < OF_KIND_MAX)
        {
            all->name[all->count++] = cm_catalogue_at(i)->identifier;
        }
    }
}

START_TEST(discs_and_squares_come_back)
{
    for (size_t i = 0; i < squares.count; i++)
    {
        cm_mapping *mapping = make_mapping(squares.name[i], NULL);
        uint64_t state = 8;
        for (int n = 0; n < 40000; n++)
        {
            double pq[2] = {next_real(&state), next_real(&state)};
            double length = hypot(pq[0], pq[1]);
            double uv[2];
            double back[2];
            double again[2];
            pq[0] /= length > 1.0 || n % 8 == 0 ? length : 1.0;
            pq[1] /= length > 1.0 || n % 8 == 0 ? length : 1.0;
            ck_assert_int_eq(cm_warp(mapping, pq, uv), CM_OK);
            ck_assert_int_eq(cm_unwarp(mapping, uv, back), CM_OK);
            REQUIRE(fabs(uv[0]) <= 1.0 && fabs(uv[1]) <= 1.0, "%s: %.17g %.17g", squares.name[i],
                    uv[0], uv[1]);
            REQUIRE(fabs(back[0] - pq[0]) <= BOUND * EPS && fabs(back[1] - pq[1]) <= BOUND * EPS,
                    "%s: %.17g %.17g: %.17g %.17g", squares.name[i], pq[0], pq[1], back[0],
                    back[1]);
            /* away from the corners the square comes back, too */
            const double square[2] = {next_real(&state), next_real(&state)};
            ck_assert_int_eq(cm_unwarp(mapping, square, back), CM_OK);
            ck_assert_int_eq(cm_warp(mapping, back, again), CM_OK);
            double corner = 2.0 - fabs(square[0]) - fabs(square[1]);
            double bound = 16.0 * EPS / fmin(1.0, corner);
            REQUIRE(fabs(again[0] - square[0]) <= bound && fabs(again[1] - square[1]) <= bound,
                    "%s: %.17g %.17g: %.17g %.17g", squares.name[i], square[0], square[1], again[0],
                    again[1]);
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

static int same_bits(const double a[2], const double b[2])
{
    return memcmp(a, b, 2 * sizeof a[0]) == 0;
}

/* Signs and swaps of the two coordinates, to the bit; the diagonals stay where they are. */
START_TEST(squares_are_symmetric)
{
    static cm_status (*const ways[2])(const cm_mapping *, const double *, double *) = {cm_warp,
                                                                                       cm_unwarp};
    for (size_t i = 0; i < squares.count * cm_instructions_count(); i++)
    {
        cm_mapping *mapping =
            make_with(squares.name[i % squares.count], cm_instructions_at(i / squares.count));
        uint64_t state = 9;
        for (int n = 0; n < 4000; n++)
        {
            const double from[2] = {0.7 * next_real(&state),
                                    n % 16 == 0 ? 0.0 : 0.7 * next_real(&state)};
            const double mirrored[2] = {-from[0], from[1]};
            const double swapped[2] = {from[1], from[0]};
            const double diagonal[2] = {from[0], -from[0]};
            double to[2];
            double other[2];
            cm_status (*way)(const cm_mapping *, const double *, double *) = ways[n % 2];
            (void)way(mapping, from, to);
            (void)way(mapping, mirrored, other);
            other[0] = -other[0];
            REQUIRE(same_bits(to, other), "%s: %.17g %.17g mirrored",
                    squares.name[i % squares.count], from[0], from[1]);
            (void)way(mapping, swapped, other);
            REQUIRE(to[0] == other[1] && to[1] == other[0], "%s: %.17g %.17g swapped",
                    squares.name[i % squares.count], from[0], from[1]);
            (void)way(mapping, diagonal, other);
            REQUIRE(other[0] == -other[1], "%s: %.17g on the diagonal",
                    squares.name[i % squares.count], from[0]);
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* ---- Domains ---- */

static void expect_none(const cm_mapping *mapping, double x, double y, double z)
{
    const double d[3] = {x, y, z};
    double uv[2] = {7.0, 7.0};
    double jacobian[6];
    uint8_t face = cm_forward(mapping, d, uv);
    REQUIRE(face == CM_NO_FACE && isnan(uv[0]) && isnan(uv[1]), "%s: %g %g %g: %d %g %g",
            cm_mapping_describe(mapping)->identifier, x, y, z, face, uv[0], uv[1]);
    cm_forward_jacobian(mapping, d, jacobian);
    for (int k = 0; k < 6; k++)
    {
        REQUIRE(isnan(jacobian[k]), "%s: %g %g %g: a Jacobian",
                cm_mapping_describe(mapping)->identifier, x, y, z);
    }
}

static void expect_no_direction(const cm_mapping *mapping, uint8_t face, double u, double v)
{
    const double uv[2] = {u, v};
    double d[3] = {7.0, 7.0, 7.0};
    double jacobian[6];
    cm_inverse(mapping, face, uv, d);
    REQUIRE(isnan(d[0]) && isnan(d[1]) && isnan(d[2]), "%s: %d %.17g %.17g: %g %g %g",
            cm_mapping_describe(mapping)->identifier, face, u, v, d[0], d[1], d[2]);
    cm_inverse_jacobian(mapping, face, uv, jacobian);
    for (int k = 0; k < 6; k++)
    {
        REQUIRE(isnan(jacobian[k]), "%s: %d %g %g: a Jacobian",
                cm_mapping_describe(mapping)->identifier, face, u, v);
    }
}

START_TEST(what_is_no_point)
{
    static const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    for (size_t m = cube_count(); m < cm_catalogue_count(); m++)
    {
        cm_mapping *mapping = make_mapping(cm_catalogue_at(m)->identifier, NULL);
        expect_none(mapping, 0.0, -0.0, 0.0);
        for (size_t i = 0; i < COUNT(bad); i++)
        {
            expect_none(mapping, bad[i], 0.5, 1.0);
            expect_none(mapping, 0.5, bad[i], 1.0);
            expect_none(mapping, 0.5, 0.25, bad[i]);
            expect_no_direction(mapping, 0, bad[i], 0.5);
            expect_no_direction(mapping, 0, 0.5, bad[i]);
        }
        for (int face = 1; face < 256; face++)
        {
            expect_no_direction(mapping, (uint8_t)face, 0.25, 0.5);
        }
        expect_no_direction(mapping, 0, 1.0 + 1e-8, 0.0);
        expect_no_direction(mapping, 0, 0.0, -1.0 - 1e-8);
        expect_no_direction(mapping, 0, 1e300, 0.0);
        cm_mapping_destroy(mapping);
    }
    for (size_t i = 0; i < squares.count; i++)
    {
        cm_mapping *mapping = make_mapping(squares.name[i], NULL);
        const double off[][2] = {
            {0.8, 0.7}, {1.0 + 1e-8, 0.0}, {(double)NAN, 0.0}, {0.0, (double)INFINITY}};
        for (size_t k = 0; k < COUNT(off); k++)
        {
            double to[2] = {7.0, 7.0};
            ck_assert_int_eq(cm_warp(mapping, off[k], to), CM_OK);
            REQUIRE(isnan(to[0]) && isnan(to[1]), "%s: %g %g", squares.name[i], off[k][0],
                    off[k][1]);
        }
        const double beside[2] = {0.6 * (1.0 + 9e-10), 0.8 * (1.0 + 9e-10)};
        const double rim[2] = {0.6, 0.8};
        double to[2];
        double of_rim[2];
        cm_warp(mapping, beside, to);
        cm_warp(mapping, rim, of_rim);
        REQUIRE(fabs(to[0] - of_rim[0]) < 4e-15 && fabs(to[1] - of_rim[1]) < 4e-15, "%s: rim",
                squares.name[i]);
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* Half a field of view ends at 30 degrees, in every direction from the centre; what is beyond by 1e-9 of the
 * radius, 1e-6 in float, is on the rim. */
START_TEST(fields_of_view)
{
    for (size_t i = 0; i < azimuthal.count; i++)
    {
        char text[64];
        snprintf(text, sizeof text, "%s:fov=60", azimuthal.name[i]);
        cm_mapping *mapping = make_mapping(text, NULL);
        for (int n = 0; n < 720; n++)
        {
            static const struct
            {
                double beyond;
                int in_double;
                int in_float;
            } cases[] = {{-1e-4, 1, 1}, {-1e-10, 1, 1}, {3e-10, 1, 1}, {4e-9, 0, 1}, {1e-5, 0, 0}};
            for (size_t k = 0; k < COUNT(cases); k++)
            {
                double t = PI / 6.0 * (1.0 + cases[k].beyond);
                double lon = n * PI / 360.0;
                const double d[3] = {sin(t) * cos(lon), sin(t) * sin(lon), cos(t)};
                const float narrow[3] = {(float)d[0], (float)d[1], (float)d[2]};
                double uv[2];
                float uv_f32[2];
                uint8_t face = cm_forward(mapping, d, uv);
                REQUIRE((face == 0) == cases[k].in_double, "%s: %g beyond: %d", text,
                        cases[k].beyond, face);
                REQUIRE(face != 0 || cases[k].beyond < 0.0 ||
                            fabs(hypot(uv[0], uv[1]) - 1.0) < 1e-15,
                        "%s: not on the rim", text);
                face = cm_forward_f32(mapping, narrow, uv_f32);
                REQUIRE((face == 0) == cases[k].in_float, "%s: %g beyond in float: %d", text,
                        cases[k].beyond, face);
            }
        }
        expect_none(mapping, 0.0, 0.0, -1.0);
        expect_none(mapping, 1.0, 0.0, 0.0);
        expect_no_direction(mapping, 0, 0.8, 0.7);
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* ---- Orientation and centres ---- */

/* u = r sin lon, v = -r cos lon */
START_TEST(orientation)
{
    for (size_t i = 0; i < azimuthal.count; i++)
    {
        char text[64];
        snprintf(text, sizeof text, "%s", azimuthal.name[i]);
        cm_mapping *mapping = make_mapping(text, NULL);
        for (int n = 0; n < 360; n += 5)
        {
            double lon = n * PI / 180.0;
            const double d[3] = {0.5 * cos(lon), 0.5 * sin(lon), 1.0};
            double uv[2];
            ck_assert_int_eq(cm_forward(mapping, d, uv), 0);
            double r = hypot(uv[0], uv[1]);
            REQUIRE(r > 0.1 && fabs(uv[0] - r * sin(lon)) < 1e-15 &&
                        fabs(uv[1] + r * cos(lon)) < 1e-15,
                    "%s: %d degrees: %g %g", text, n, uv[0], uv[1]);
        }
        cm_mapping_destroy(mapping);
    }
    /* about another centre u is east and v is north */
    cm_mapping *mapping = make_mapping("azimuthal:equidistant:lon=30,lat=20", NULL);
    double uv[2];
    double degree = PI / 180.0;
    ck_assert_int_eq(cm_forward_lonlat(mapping, 30.0 * degree, 20.0 * degree, uv), 0);
    REQUIRE(fabs(uv[0]) < 1e-15 && fabs(uv[1]) < 1e-15, "%g %g", uv[0], uv[1]);
    cm_forward_lonlat(mapping, 30.0 * degree, 29.0 * degree, uv);
    REQUIRE(fabs(uv[0]) < 1e-15 && fabs(uv[1] - 0.1) < 1e-15, "%g %g", uv[0], uv[1]);
    cm_forward_lonlat(mapping, 31.0 * degree, 20.0 * degree, uv);
    REQUIRE(uv[0] > 0.009 && fabs(uv[1]) < 1e-4, "%g %g", uv[0], uv[1]);
    cm_mapping_destroy(mapping);
}
END_TEST

/* A map about another centre is that about the pole of turned directions. */
START_TEST(centres_are_turned_directions)
{
    static const char *const names[] = {"azimuthal:lambert:full=1", "azimuthal:gnomonic",
                                        "border:lambert,squircle",
                                        "quincuncial:breusing,conformal"};
    static const double centres[][2] = {{0.0, 90.0},    {30.0, 90.0}, {-71.5, 12.25},
                                        {180.0, -90.0}, {90.0, 0.0},  {360.0, -45.0}};
    for (size_t i = 0; i < COUNT(names) * COUNT(centres); i++)
    {
        char text[128];
        const char *name = names[i % COUNT(names)];
        const double *centre = centres[i / COUNT(names)];
        snprintf(text, sizeof text, "%s%slon=%g,lat=%g", name,
                 strchr(strchr(name, ':') + 1, ':') != NULL || strchr(name, ',') != NULL ? ","
                                                                                         : ":",
                 centre[0], centre[1]);
        cm_mapping *turned = make_mapping(text, NULL);
        cm_mapping *plain = make_mapping(name, NULL);
        double sl = sin(centre[0] * PI / 180.0), cl = cos(centre[0] * PI / 180.0);
        double sb = sin(centre[1] * PI / 180.0), cb = cos(centre[1] * PI / 180.0);
        uint64_t state = 10;
        for (int n = 0; n < 2000; n++)
        {
            double d[3];
            double uv[2];
            double expected[2];
            next_direction(&state, d);
            const double about[3] = {(cl * d[0] + sl * d[1]) * sb - cb * d[2],
                                     cl * d[1] - sl * d[0],
                                     (cl * d[0] + sl * d[1]) * cb + sb * d[2]};
            uint8_t face = cm_forward(turned, d, uv);
            REQUIRE(face == cm_forward(plain, about, expected), "%s: %.17g %.17g %.17g", text, d[0],
                    d[1], d[2]);
            REQUIRE(face != 0 ||
                        (fabs(uv[0] - expected[0]) < 1e-13 && fabs(uv[1] - expected[1]) < 1e-13),
                    "%s: %.17g %.17g %.17g", text, d[0], d[1], d[2]);
        }
        cm_mapping_destroy(plain);
        cm_mapping_destroy(turned);
    }
}
END_TEST

/* ---- Borders ---- */

/* The whole border is the south pole. */
START_TEST(border_is_a_pole)
{
    static const char *const laws[] = {"lambert", "equidistant", "breusing", "mixture"};
    for (size_t i = 0; i < COUNT(laws) * squares.count; i++)
    {
        char text[64];
        snprintf(text, sizeof text, "border:%s,%s", laws[i % COUNT(laws)],
                 strchr(squares.name[i / COUNT(laws)], ':') + 1);
        for (size_t set = 0; set < cm_instructions_count(); set++)
        {
            cm_mapping *mapping = make_with(text, cm_instructions_at(set));
            for (int n = 0; n <= 400; n++)
            {
                double t = n / 200.0 - 1.0;
                const double points[4][2] = {{t, 1.0}, {t, -1.0}, {1.0, t}, {-1.0, t}};
                for (int k = 0; k < 4; k++)
                {
                    const float narrow[2] = {(float)points[k][0], (float)points[k][1]};
                    double d[3];
                    float d_f32[3];
                    cm_inverse(mapping, 0, points[k], d);
                    REQUIRE(d[0] == 0.0 && d[1] == 0.0 && d[2] == -1.0,
                            "%s: %.17g %.17g: %g %g %.17g", text, points[k][0], points[k][1], d[0],
                            d[1], d[2]);
                    cm_inverse_f32(mapping, 0, narrow, d_f32);
                    REQUIRE(d_f32[0] == 0.0F && d_f32[1] == 0.0F && d_f32[2] == -1.0F,
                            "%s: %g %g in float: %g %g %.9g", text, points[k][0], points[k][1],
                            (double)d_f32[0], (double)d_f32[1], (double)d_f32[2]);
                }
            }
            const double south[3] = {0.0, 0.0, -1.0};
            double uv[2];
            ck_assert_int_eq(cm_forward(mapping, south, uv), 0);
            REQUIRE(uv[0] == 0.0 && uv[1] == -1.0, "%s: %.17g %.17g", text, uv[0], uv[1]);
            cm_mapping_destroy(mapping);
        }
    }
}
END_TEST

/* The border meets itself: (t, 1) and (-t, 1) are the same direction. */
START_TEST(folded_borders_meet_themselves)
{
    static const char *const names[] = {"quincuncial",
                                        "quincuncial:lambert,shirley",
                                        "quincuncial:mixture,squircle",
                                        "quincuncial:breusing,elliptical",
                                        "quincuncial:orthographic,radial",
                                        "octahedral",
                                        "octahedral:clarberg"};
    for (size_t i = 0; i < COUNT(names); i++)
    {
        cm_mapping *mapping = make_mapping(names[i], NULL);
        for (int n = 0; n <= 500; n++)
        {
            double t = n / 500.0;
            const double points[4][2] = {{t, 1.0}, {t, -1.0}, {1.0, t}, {-1.0, t}};
            for (int k = 0; k < 4; k++)
            {
                const double other[2] = {k < 2 ? -points[k][0] : points[k][0],
                                         k < 2 ? points[k][1] : -points[k][1]};
                double d[3];
                double same[3];
                cm_inverse(mapping, 0, points[k], d);
                cm_inverse(mapping, 0, other, same);
                REQUIRE(d[0] == same[0] && d[1] == same[1] && d[2] == same[2],
                        "%s: %.17g %.17g: %.17g %.17g %.17g, %.17g %.17g %.17g", names[i],
                        points[k][0], points[k][1], d[0], d[1], d[2], same[0], same[1], same[2]);
                REQUIRE(d[2] <= 0.0 && (t == 0.0 ? fabs(d[2]) <= 1e-15 : 1), "%s: %g: %g", names[i],
                        t, d[2]);
            }
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* ---- Special cases ---- */

/* Two maps are the same within some eps, where the first one has a point. */
static void expect_equal(const char *one, const char *other, double bound)
{
    cm_mapping *a = make_mapping(one, NULL);
    cm_mapping *b = make_mapping(other, NULL);
    uint64_t state = 12;
    for (int n = 0; n < 5000; n++)
    {
        double d[3];
        double uv[2];
        double expected[2];
        next_direction(&state, d);
        REQUIRE(cm_forward(a, d, uv) == cm_forward(b, d, expected), "%s, %s", one, other);
        REQUIRE(isnan(uv[0]) || (fabs(uv[0] - expected[0]) <= bound * EPS &&
                                 fabs(uv[1] - expected[1]) <= bound * EPS),
                "%s, %s: %.17g %.17g, %.17g %.17g", one, other, uv[0], uv[1], expected[0],
                expected[1]);
    }
    cm_mapping_destroy(a);
    cm_mapping_destroy(b);
}

START_TEST(special_cases)
{
    expect_equal("azimuthal:mixture:beta=0", "azimuthal:stereographic", 12.0);
    expect_equal("azimuthal:mixture:beta=0,fov=100", "azimuthal:stereographic:fov=100", 12.0);
    expect_equal("azimuthal:mixture:beta=1", "azimuthal:lambert", 12.0);
    expect_equal("azimuthal:mixture:beta=1,full=1", "azimuthal:lambert:full=1", 12.0);
    expect_equal("quincuncial:mixture,shirley,beta=0", "quincuncial:stereographic,shirley", 12.0);
    expect_equal("border:mixture,radial,beta=1", "border:lambert,radial", 12.0);
    expect_equal("peirce", "quincuncial:stereographic,conformal", 0.0);
    expect_equal("quincuncial", "peirce", 0.0);
    expect_equal("border", "border:lambert,shirley", 0.0);
    expect_equal("azimuthal:breusing:full=1", "azimuthal:breusing:fov=360", 0.0);
    expect_equal("azimuthal:laea", "azimuthal:equisolid", 0.0);
    expect_equal("oct", "octahedral", 0.0);
    expect_equal("clarberg", "octahedral:clarberg", 0.0);
}
END_TEST

/* octahedral:clarberg(d) = (-Y, X) of (X, Y) = quincuncial:lambert,shirley of d turned by 45 degrees */
START_TEST(clarberg_is_a_turned_quincuncial)
{
    cm_mapping *clarberg = make_mapping("octahedral:clarberg", NULL);
    cm_mapping *quincuncial = make_mapping("quincuncial:lambert,shirley", NULL);
    uint64_t state = 13;
    for (int n = 0; n < 20000; n++)
    {
        double d[3];
        double uv[2];
        double xy[2];
        next_direction(&state, d);
        const double turned[3] = {(d[0] - d[1]) * sqrt(0.5), (d[0] + d[1]) * sqrt(0.5), d[2]};
        cm_forward(clarberg, d, uv);
        cm_forward(quincuncial, turned, xy);
        REQUIRE(fabs(uv[0] + xy[1]) < 16.0 * EPS && fabs(uv[1] - xy[0]) < 16.0 * EPS,
                "%.17g %.17g %.17g: %.17g %.17g, %.17g %.17g", d[0], d[1], d[2], uv[0], uv[1],
                -xy[1], xy[0]);
    }
    cm_mapping_destroy(quincuncial);
    cm_mapping_destroy(clarberg);
}
END_TEST

/* ---- Areas and angles ---- */

/* Equal-area maps have one scale, conformal ones isotropy 1, everywhere. */
START_TEST(areas_and_angles)
{
    static const struct
    {
        const char *specification;
        double scale; /* area of the map over that of the sphere; 0 for a conformal map */
    } maps[] = {
        {"azimuthal:lambert", 0.5},
        {"azimuthal:lambert:full=1", 0.25},
        {"azimuthal:lambert:fov=60,lon=20,lat=30", 3.7320508075688772}, /* pi over that of a cap */
        {"azimuthal:mixture:beta=1", 0.5},
        {"border:lambert,shirley", 1.0 / PI},
        {"border:lambert,shirley,lat=10", 1.0 / PI},
        {"quincuncial:lambert,shirley", 1.0 / PI},
        {"octahedral:clarberg", 1.0 / PI},
        {"azimuthal:stereographic", 0.0},
        {"azimuthal:stereographic:fov=300", 0.0},
        {"quincuncial", 0.0}};
    for (size_t i = 0; i < COUNT(maps); i++)
    {
        cm_mapping *mapping = make_mapping(maps[i].specification, NULL);
        uint64_t state = 14;
        for (int n = 0; n < 20000; n++)
        {
            const double uv[2] = {next_real(&state), next_real(&state)};
            double d[3];
            cm_distortion there;
            cm_distortion back;
            cm_inverse(mapping, 0, uv, d);
            /* beside a corner and the antipode the second digits of a direction are lost */
            if (isnan(d[0]) || fabs(uv[0]) + fabs(uv[1]) > 1.99 || d[2] < -0.999)
            {
                continue;
            }
            cm_inverse_distortion(mapping, 0, uv, &back);
            cm_forward_distortion(mapping, d, &there);
            if (maps[i].scale > 0.0)
            {
                REQUIRE(fabs(back.scale / maps[i].scale - 1.0) < 1e-11, "%s: %.17g %.17g: %.17g",
                        maps[i].specification, uv[0], uv[1], back.scale);
                REQUIRE(fabs(there.scale / maps[i].scale - 1.0) < 1e-11, "%s: %.17g %.17g: %.17g",
                        maps[i].specification, uv[0], uv[1], there.scale);
            }
            else
            {
                REQUIRE(fabs(back.isotropy - 1.0) < 1e-13 && fabs(there.isotropy - 1.0) < 1e-11,
                        "%s: %.17g %.17g: 1 + %g, 1 + %g", maps[i].specification, uv[0], uv[1],
                        back.isotropy - 1.0, there.isotropy - 1.0);
            }
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* ---- Arrays ---- */

/* Arrays of any length, in place, by steps and alone: the same bits. */
START_TEST(arrays_are_single_points)
{
    enum
    {
        N = 150
    };
    static const char *const names[] = {
        "azimuthal:lambert", "azimuthal:breusing:full=1,lon=3,lat=4", "border:mixture,squircle",
        "quincuncial", "octahedral:clarberg"};
    for (size_t i = 0; i < COUNT(names); i++)
    {
        cm_mapping *mapping = make_mapping(names[i], NULL);
        uint64_t state = 15;
        for (size_t n = 0; n <= N; n += n < 20 ? 1 : 43)
        {
            double x[N + 1], y[N + 1], z[N + 1], u[N + 1], v[N + 1], a[N + 1], b[N + 1], c[N + 1];
            double xyz[4 * N + 4], u_strided[N + 1], v_strided[N + 1];
            uint8_t face[N + 1], face_strided[N + 1];
            for (size_t k = 0; k <= N; k++)
            {
                double d[3];
                next_direction(&state, d);
                xyz[4 * k] = x[k] = d[0];
                xyz[4 * k + 1] = y[k] = d[1];
                xyz[4 * k + 2] = z[k] = d[2];
                u[k] = v[k] = 77.0;
                face[k] = 77;
            }
            cm_forward_array(mapping, n, x, y, z, face, u, v);
            cm_forward_strided(mapping, n, xyz, 4, face_strided, u_strided, v_strided);
            cm_inverse_array(mapping, n, face, u, v, a, b, c);
            REQUIRE(u[n] == 77.0 && v[n] == 77.0 && face[n] == 77, "%s: written beyond", names[i]);
            for (size_t k = 0; k < n; k++)
            {
                const double d[3] = {x[k], y[k], z[k]};
                double uv[2];
                double back[3];
                REQUIRE(cm_forward(mapping, d, uv) == face[k] && face_strided[k] == face[k] &&
                            memcmp(&uv[0], &u[k], sizeof uv[0]) == 0 &&
                            memcmp(&uv[1], &v[k], sizeof uv[1]) == 0 &&
                            memcmp(&u_strided[k], &u[k], sizeof u[k]) == 0 &&
                            memcmp(&v_strided[k], &v[k], sizeof v[k]) == 0,
                        "%s: %zu of %zu", names[i], k, n);
                cm_inverse(mapping, face[k], uv, back);
                REQUIRE(memcmp(&back[0], &a[k], sizeof back[0]) == 0 &&
                            memcmp(&back[1], &b[k], sizeof back[1]) == 0 &&
                            memcmp(&back[2], &c[k], sizeof back[2]) == 0,
                        "%s: %zu of %zu", names[i], k, n);
            }
            double p[N + 1], q[N + 1];
            memcpy(p, u, sizeof p);
            memcpy(q, v, sizeof q);
            cm_forward_array(mapping, n, x, y, z, face, x, y);
            REQUIRE(memcmp(x, u, n * sizeof x[0]) == 0 && memcmp(y, v, n * sizeof y[0]) == 0,
                    "%s: in place", names[i]);
            cm_inverse_array(mapping, n, face, p, q, q, p, z);
            REQUIRE(memcmp(q, a, n * sizeof q[0]) == 0 && memcmp(p, b, n * sizeof p[0]) == 0 &&
                        memcmp(z, c, n * sizeof z[0]) == 0,
                    "%s: inverse in place", names[i]);
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* The arrays of warps and their derivatives, of every mapping: single points, to the bit; where there is no warp
 * they say so and write nothing. */
START_TEST(arrays_of_warps)
{
    enum
    {
        N = 77
    };
    for (size_t m = 0; m < cm_catalogue_count(); m++)
    {
        cm_mapping *mapping = make_mapping(cm_catalogue_at(m)->identifier, NULL);
        uint64_t state = 16;
        double p[N], q[N], u[N], v[N], back_p[N], back_q[N], j[4][N];
        float p_f32[N], q_f32[N], u_f32[N], v_f32[N], j_f32[4][N];
        double *const to[4] = {j[0], j[1], j[2], j[3]};
        float *const to_f32[4] = {j_f32[0], j_f32[1], j_f32[2], j_f32[3]};
        for (size_t k = 0; k < N; k++)
        {
            p_f32[k] = (float)(p[k] = next_real(&state));
            q_f32[k] = (float)(q[k] = next_real(&state));
            u[k] = v[k] = back_p[k] = j[0][k] = 7.0;
            u_f32[k] = j_f32[0][k] = 7.0F;
        }
        int none = cm_mapping_describe(mapping)->family == CM_FAMILY_HYBRID;
        cm_status expected = none ? CM_ERROR_UNSUPPORTED : CM_OK;
        ck_assert_int_eq(cm_warp_array(mapping, N, p, q, u, v), expected);
        ck_assert_int_eq(cm_warp_array(mapping, 0, NULL, NULL, NULL, NULL), expected);
        ck_assert_int_eq(cm_unwarp_array(mapping, N, u, v, back_p, back_q), expected);
        ck_assert_int_eq(cm_warp_jacobian_array(mapping, N, p, q, to), expected);
        ck_assert_int_eq(cm_warp_array_f32(mapping, N, p_f32, q_f32, u_f32, v_f32), expected);
        ck_assert_int_eq(cm_warp_jacobian_array_f32(mapping, N, p_f32, q_f32, to_f32), expected);
        for (size_t k = 0; k < N; k++)
        {
            if (none)
            {
                REQUIRE(u[k] == 7.0 && back_p[k] == 7.0 && j[0][k] == 7.0 && u_f32[k] == 7.0F &&
                            j_f32[0][k] == 7.0F,
                        "%s: written", cm_catalogue_at(m)->identifier);
                continue;
            }
            const double pq[2] = {p[k], q[k]};
            const float pq_f32[2] = {p_f32[k], q_f32[k]};
            const double uv_of[2] = {u[k], v[k]};
            double uv[2], back[2], jacobian[4];
            float uv_f32[2], jacobian_f32[4];
            cm_warp(mapping, pq, uv);
            cm_unwarp(mapping, uv_of, back);
            cm_warp_jacobian(mapping, pq, jacobian);
            cm_warp_f32(mapping, pq_f32, uv_f32);
            cm_warp_jacobian_f32(mapping, pq_f32, jacobian_f32);
            int same = memcmp(&uv[0], &u[k], sizeof uv[0]) == 0 &&
                       memcmp(&uv[1], &v[k], sizeof uv[1]) == 0 &&
                       memcmp(&back[0], &back_p[k], sizeof back[0]) == 0 &&
                       memcmp(&back[1], &back_q[k], sizeof back[1]) == 0 &&
                       memcmp(&uv_f32[0], &u_f32[k], sizeof uv_f32[0]) == 0 &&
                       memcmp(&uv_f32[1], &v_f32[k], sizeof uv_f32[1]) == 0;
            for (int e = 0; e < 4; e++)
            {
                same &= memcmp(&jacobian[e], &j[e][k], sizeof jacobian[e]) == 0 &&
                        memcmp(&jacobian_f32[e], &j_f32[e][k], sizeof jacobian_f32[e]) == 0;
            }
            REQUIRE(same, "%s: %zu", cm_catalogue_at(m)->identifier, k);
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* Derivatives of warps against central differences; shirley's determinant is 4 / pi, conformal is
 * conformal. */
START_TEST(derivatives_of_warps)
{
    const double step = 1e-5;
    for (size_t m = 0; m < cm_catalogue_count(); m++)
    {
        cm_mapping *mapping = make_mapping(cm_catalogue_at(m)->identifier, NULL);
        const char *name = cm_catalogue_at(m)->identifier;
        uint64_t state = 17;
        for (int n = 0; n < 2000 && cm_catalogue_at(m)->family != CM_FAMILY_HYBRID; n++)
        {
            const double pq[2] = {0.69 * next_real(&state), 0.69 * next_real(&state)};
            double jacobian[4];
            ck_assert_int_eq(cm_warp_jacobian(mapping, pq, jacobian), CM_OK);
            double creases = fmin(fabs(fabs(pq[0]) - fabs(pq[1])), fmin(fabs(pq[0]), fabs(pq[1])));
            for (int k = 0; k < 2 && creases > 2.0 * step; k++)
            {
                double low[2] = {pq[0], pq[1]};
                double high[2] = {pq[0], pq[1]};
                low[k] -= step;
                high[k] += step;
                (void)cm_warp(mapping, low, low);
                (void)cm_warp(mapping, high, high);
                for (int row = 0; row < 2; row++)
                {
                    double slope = (high[row] - low[row]) / (2.0 * step);
                    REQUIRE(fabs(jacobian[2 * row + k] - slope) < 2e-6 * (1.0 + fabs(slope)),
                            "%s: %.17g %.17g: %d: %.17g, %.17g", name, pq[0], pq[1], 2 * row + k,
                            jacobian[2 * row + k], slope);
                }
            }
            double determinant = jacobian[0] * jacobian[3] - jacobian[1] * jacobian[2];
            REQUIRE(strcmp(name, "square:shirley") != 0 ||
                        fabs(determinant * PI / 4.0 - 1.0) < 1e-14,
                    "%.17g %.17g: %.17g", pq[0], pq[1], determinant);
            REQUIRE(strcmp(name, "square:conformal") != 0 ||
                        (fabs(jacobian[0] - jacobian[3]) < 1e-14 &&
                         fabs(jacobian[1] + jacobian[2]) < 1e-14),
                    "%.17g %.17g: not conformal", pq[0], pq[1]);
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* D_A and D_I of Lambers 2016, section 5.1, at a pixel centre of the map: NaN outside the disc. */
static void paper_distortion(const cm_mapping *mapping, const double uv[2], double *area,
                             double *isotropy)
{
    if (cm_mapping_describe(mapping)->kind != CM_KIND_DISC_SQUARE)
    {
        cm_distortion d;
        cm_inverse_distortion(mapping, 0, uv, &d);
        *area = 2.0 * d.scale; /* the disc has half the area of the hemisphere */
        *isotropy = d.isotropy;
        return;
    }
    double pq[2];
    double j[4];
    (void)cm_unwarp(mapping, uv, pq);
    (void)cm_warp_jacobian(mapping, pq, j);
    double determinant = fabs(j[0] * j[3] - j[1] * j[2]);
    double major = 0.5 * (hypot(j[0] + j[3], j[1] - j[2]) + hypot(j[0] - j[3], j[1] + j[2]));
    *area = determinant * PI / 4.0;
    *isotropy = major * major / determinant;
}

/* The figures that research/papers/disc-square-paper has from the printed formulas, over 128 x 128 pixel centres, to
 * their last digit; 0 is none. */
START_TEST(figures_of_the_paper)
{
    static const struct
    {
        const char *specification;
        double area_rmse;
        double area_most;
        double isotropy_rmse;
        double isotropy_most;
        double digit;
    } maps[] = {{"square:radial", 0.2396, 0.5708, 0.8396, 1.6180, 1e-4},
                {"square:shirley", 0.0, 0.0, 0.7949, 1.433, 1e-3},
                {"square:squircle", 1.3788, 49.46, 0.9444, 31.63, 1e-2},
                {"square:elliptical", 0.6960, 24.62, 1.903, 63.25, 1e-2},
                {"square:conformal", 36.1, 2177.3, 0.0, 0.0, 1e-1},
                {"azimuthal:breusing", 0.2014, 0.4134, 0.2283, 0.4138, 1e-4},
                {"azimuthal:mixture", 0.2154, 0.4278, 0.2119, 0.3995, 1e-4},
                {"azimuthal:equidistant", 0.1342, 0.2727, 0.3036, 0.5701, 1e-4}};
    for (size_t i = 0; i < COUNT(maps); i++)
    {
        enum
        {
            PIXELS = 128
        };
        cm_mapping *mapping = make_mapping(maps[i].specification, NULL);
        double squares_of_errors[2] = {0.0, 0.0};
        double most[2] = {0.0, 0.0};
        double count = 0.0;
        for (int n = 0; n < PIXELS * PIXELS; n++)
        {
            const double uv[2] = {(2.0 * (n % PIXELS) + 1.0) / PIXELS - 1.0,
                                  (2.0 * (double)(n / PIXELS) + 1.0) / PIXELS - 1.0};
            double d[2];
            paper_distortion(mapping, uv, &d[0], &d[1]);
            for (int k = 0; k < 2 && !isnan(d[0]); k++)
            {
                squares_of_errors[k] += (d[k] - 1.0) * (d[k] - 1.0);
                most[k] = fmax(most[k], fabs(d[k] - 1.0));
                count += k;
            }
        }
        const double got[4] = {sqrt(squares_of_errors[0] / count), most[0],
                               sqrt(squares_of_errors[1] / count), most[1]};
        const double expected[4] = {maps[i].area_rmse, maps[i].area_most, maps[i].isotropy_rmse,
                                    maps[i].isotropy_most};
        for (int k = 0; k < 4; k++)
        {
            REQUIRE(fabs(got[k] - expected[k]) <= 0.6 * maps[i].digit, "%s: %d: %.6f, not %.6f",
                    maps[i].specification, k, got[k], expected[k]);
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

int main(int argc, char **argv)
{
    const TTest *tests[] = {vectors_hold,
                            directions_come_back,
                            flat_laws_lose_what_they_must,
                            discs_and_squares_come_back,
                            squares_are_symmetric,
                            what_is_no_point,
                            fields_of_view,
                            orientation,
                            centres_are_turned_directions,
                            border_is_a_pole,
                            folded_borders_meet_themselves,
                            special_cases,
                            clarberg_is_a_turned_quincuncial,
                            areas_and_angles,
                            arrays_are_single_points,
                            arrays_of_warps,
                            derivatives_of_warps,
                            figures_of_the_paper,
                            NULL};
    gather(CM_KIND_DISC_SQUARE, &squares);
    gather(CM_KIND_AZIMUTHAL, &azimuthal);
    if (argc != 2)
    {
        fprintf(stderr, "usage: test-charts FOLDER\n");
        return 2;
    }
    folder = argv[1];
    return run_suite("charts", tests);
}
