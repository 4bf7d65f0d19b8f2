/* SPDX-License-Identifier: MIT
 *
 * The certificate: the worst errors of every mapping in double and in float, measured at all hard
 * points (truth/hard_points.h) and at random ones, where they occur, and the published bounds
 * (cm_mapping_info.bounds). Errors are in eps, 2^-53 in double and 2^-24 in float:
 *
 *   round trip        direction -> face, u, v -> direction: the angle, in rad / eps
 *   plane round trip  face, u, v -> direction -> face, u, v: the larger difference of u and of v; where
 *                     the face is another (beside an edge) the angle between what the two stand for
 *   forward           u and v of a direction, and of p, q, against the truth: absolute, and relative
 *                     where the truth is at least 1e-300 (1e-36 in float)
 *   inverse           x, y and z, and p and q, of u, v; likewise
 *
 * Maps with one face, and what is between disc and square:
 *   - round trips of the latter are disc -> square -> disc and square -> disc -> square, in lengths of the disc;
 *   - of the others a plane round trip is measured as the angle where that is less than the difference of u and
 *     of v: beside a corner of the square, and where the border meets itself, the map stretches without bound;
 *   - directions outside the field of view, and points outside the disc, are none and are left out;
 *   - where forward is on another side of a fold than the truth, that is as with another face;
 *   - a bound of 0 is none that is stated; with other than the standard parts or parameters the bounds are
 *     those of docs/measured/accuracy.md: 21 eps for round trips, 8 forward and inverse, and none relative to the truth.
 *
 * With parameters that are neither the standard ones nor a preset's the bounds are greater by the factor by which the condition
 * is: how much the warp, or its inverse, stretches a small difference at most; but those of forward and
 * inverse stay below 8 eps, and relative to the truth below 16.
 *
 * The tier fast (options.h) has the bounds of float and what the rounding of its arguments adds: an eps
 * for round trips; for forward and inverse, and relative to the truth, an eps and one more for the
 * condition. Its directions are of lengths near 1 or greater.
 *
 * The truth is the kernel's own text in quadruple precision (truth/quad.h) for double, and the library
 * in double for float and fast. The exit status is 1 if a bound does not hold.
 */
#define _POSIX_C_SOURCE 200809L

#include "certificate.h"

#include "truth/cube_count.h"
#include "truth/hard_points.h"
#include "truth/sphere.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const kind_names[KINDS] = {"round trip", "plane round trip",
                                              "forward",    "forward, relative",
                                              "inverse",    "inverse, relative"};

static const char *const precision_names[PRECISIONS] = {"double", "float", "fast"};

/* ---- The whole of one mapping ---- */

/* What is between disc and square; as many points of the one as of the other. */
static void measure_plane(subject *s, double round_trip_count, double truth_count)
{
    static double disc[2][BLOCK], square[2][BLOCK];
    static uint8_t face[BLOCK];
    uint64_t state = 77;
    double most = fmax(round_trip_count, truth_count);
    for (double done = 0.0; done < most; done += BLOCK)
    {
        s->is_disc = 1;
        random_points(s, &state, face, disc);
        s->is_disc = 0;
        random_points(s, &state, face, square);
        if (done < round_trip_count)
        {
            plane_trips(s, BLOCK, disc, square);
        }
        if (done < truth_count)
        {
            compare_planes(s, BLOCK, disc, square);
        }
    }
    size_t n;
    for (uint64_t index = 0, next; index < HARD_POINTS; index = next)
    {
        next = index;
        s->is_disc = 1;
        n = hard_face_points(s, 1, &next, disc);
        next = index;
        s->is_disc = 0;
        n = hard_face_points(s, 1, &next, square);
        plane_trips(s, n, disc, square);
        compare_planes(s, n, disc, square);
    }
}

enum
{
    THINNED = 100 /* from this stride on some of the hard points do */
};

/* The least number from least on that has no divisor of the radices of hard directions, so that one in so many has all
 * values of every digit with all of every other. */
static uint64_t step_of_directions(uint64_t least)
{
    while (least > 1 && (least % HARD_STEPS == 0 || least % HARD_SCALES == 0))
    {
        least++;
    }
    return least;
}

static void measure_hard_directions(subject *s, uint64_t stride)
{
    static double d[3][BLOCK];
    const uint64_t step = step_of_directions(stride >= THINNED ? 7 : 1);
    const uint64_t compared = step_of_directions(stride);
    size_t n;
    for (uint64_t index = 0; (n = hard_directions(s, step, &index, d)) > 0;)
    {
        hard_round_trips(s, keep_seen(s, n, d), d);
    }
    for (uint64_t index = 0; (n = hard_directions(s, compared, &index, d)) > 0;)
    {
        compare_forward(s, keep_seen(s, n, d), d);
    }
}

/* Round trips of all; of those that are compared with the truth, where they are thinned, every second one, which has each
 * coordinate with every second other. */
static void measure_hard_points(subject *s, uint64_t stride)
{
    static double uv[2][BLOCK];
    static uint8_t face[BLOCK];
    size_t n;
    for (uint64_t index = 0; (n = hard_face_points(s, 1, &index, uv)) > 0;)
    {
        face_round_trips(s, n, uv);
    }
    uint64_t index = 0;
    for (int block = 0; (n = hard_face_points(s, stride >= THINNED ? 2 : 1, &index, uv)) > 0;
         block++)
    {
        compare_warps(s, n, uv);
        for (int f = 0; f < s->faces; f++)
        {
            if (stride == 1 || block % s->faces == f)
            {
                memset(face, f, sizeof face);
                compare_inverse(s, n, face, uv);
            }
        }
    }
}

/* stride: of the hard directions one in so many is compared with the truth; above 1 a block of hard points of a face
 * is compared on one face, each in turn, else on all */
static void measure(subject *s, double round_trip_count, double truth_count, uint64_t stride)
{
    static double d[3][BLOCK], uv[2][BLOCK];
    static uint8_t face[BLOCK];
    uint64_t state = 77;
    if (s->is_plane)
    {
        measure_plane(s, round_trip_count, truth_count);
        return;
    }
    for (double done = 0.0; done < round_trip_count; done += BLOCK)
    {
        random_directions(s, &state, d);
        round_trips(s, keep_seen(s, BLOCK, d), d);
    }
    for (double done = 0.0; done < truth_count; done += BLOCK)
    {
        random_directions(s, &state, d);
        compare_forward(s, keep_seen(s, BLOCK, d), d);
        random_points(s, &state, face, uv);
        compare_inverse(s, BLOCK, face, uv);
        random_points(s, &state, face, uv);
        compare_warps(s, BLOCK / 4, uv);
    }
    measure_hard_directions(s, stride);
    measure_hard_points(s, stride);
}

/* The published inverse of cobe is none. */
static int is_no_inverse(const cm_mapping *mapping)
{
    return strcmp(cm_mapping_describe(mapping)->identifier, "cobe") == 0 &&
           cm_mapping_parameter(mapping, 0) == 1.0;
}

static double bound_of(const subject *s, kind which)
{
    const cm_bounds *bounds = &cm_mapping_describe(s->mapping)->bounds;
    const double of[KINDS] = {bounds->round_trip, bounds->plane_round_trip, bounds->forward,
                              bounds->relative,   bounds->inverse,          bounds->relative};
    if (is_no_inverse(s->mapping) && (which == ROUND_TRIP || which == PLANE_ROUND_TRIP))
    {
        return (double)INFINITY;
    }
    const double most[KINDS] = {INFINITY, INFINITY, 8.0, 16.0, 8.0, 16.0};
    int is_round_trip = which == ROUND_TRIP || which == PLANE_ROUND_TRIP;
    /* what docs/measured/accuracy.md promises of them; relative to the truth nothing */
    const double of_other[KINDS] = {21.0, 16.0, 8.0, 0.0, 8.0, 0.0};
    int is_open =
        (s->is_flat && which == ROUND_TRIP) || (s->is_drawn_out && which == PLANE_ROUND_TRIP);
    if (s->is_other && !is_open && of_other[which] > 0.0)
    {
        return of_other[which];
    }
    if (s->is_other || of[which] == 0.0)
    {
        return (double)INFINITY;
    }
    double rounding = s->precision != FAST ? 0.0 : is_round_trip ? 1.0 : 1.0 + s->condition;
    return fmin(of[which] * s->widening, most[which]) + rounding;
}

/* One line a kind, fields apart by tabs. */
static int report(const subject *s, const char *specification)
{
    int broken = 0;
    for (int which = 0; which < KINDS; which++)
    {
        const extreme *worst = &s->worst[which];
        double bound = bound_of(s, (kind)which);
        int held = worst->error <= bound;
        printf("%s\t%s\t%.2f\t%s\t%.3f\t%.3g\t%s\t%s\n", specification,
               precision_names[s->precision], s->condition, kind_names[which], worst->error, bound,
               worst->where, held ? "held" : "BROKEN");
        broken |= !held;
    }
    fflush(stdout);
    return broken;
}

/* What the bounds of one mapping depend on, whatever the precision. */
typedef struct scale
{
    double condition;
    double widening;
} scale;

/* The condition, and by which factor it is above that with the standard parameters. */
static scale scale_of(const char *specification)
{
    cm_mapping *made = NULL;
    cm_mapping *standard = NULL;
    scale found = {1.0, 1.0};
    if (cm_mapping_create(specification, NULL, &made) == CM_OK)
    {
        const char *identifier = cm_mapping_describe(made)->identifier;
        quad_mapping truth = quad_from_text(made, specification);
        double least = 1.0;
        found.condition = condition_of(made, &truth);
        if (cm_mapping_has_bounds(made))
        {
            least = found.condition;
        }
        else if (cm_mapping_create(identifier, NULL, &standard) == CM_OK)
        {
            quad_mapping standard_truth = quad_from(standard);
            least = condition_of(standard, &standard_truth);
        }
        found.widening = fmax(1.0, found.condition / least);
    }
    cm_mapping_destroy(made);
    cm_mapping_destroy(standard);
    return found;
}

/* As docs/guide/conventions.md tells it. */
static void note_where_it_is_flat(subject *s, const char *specification)
{
    int is_border = strncmp(specification, "border:", 7) == 0;
    int is_whole = is_border || strstr(specification, "full=1") != NULL;
    s->is_flat = strstr(specification, "orthographic") != NULL ||
                 (is_whole && (strstr(specification, "lambert") != NULL ||
                               strstr(specification, "mixture") != NULL));
    s->is_drawn_out = is_border && strstr(specification, "conformal") != NULL;
}

/* What is asked for. */
typedef struct amounts
{
    double round_trips;
    double comparisons;
    double stride;
} amounts;

static int certify(const char *specification, const char *instructions, precision_kind precision,
                   const scale *bounds, const amounts *of)
{
    cm_options options = {.size = sizeof options,
                          .instructions = instructions,
                          .tier = precision == FAST ? CM_TIER_FAST : CM_TIER_EXACT};
    subject s = {.precision = precision,
                 .narrow = precision == FLOAT,
                 .eps = precision == DOUBLE ? 0x1p-53 : 0x1p-24,
                 .least = precision == DOUBLE ? 1e-300 : 1e-36,
                 .condition = bounds->condition,
                 .widening = bounds->widening};
    cm_status status = cm_mapping_create_with(specification, NULL, &options, &s.mapping);
    if (status != CM_OK || cm_mapping_create(specification, NULL, &s.exact) != CM_OK ||
        cm_mapping_create(is_no_inverse(s.exact) ? "cobe" : specification, NULL, &s.undo) != CM_OK)
    {
        fprintf(stderr, "certificate: %s: %s\n", specification, cm_status_text(status));
        cm_mapping_destroy(s.mapping);
        cm_mapping_destroy(s.exact);
        return 2;
    }
    int broken = 0;
    if (precision != FAST || cm_mapping_tier(s.mapping) == CM_TIER_FAST)
    {
        s.truth = quad_from_text(s.exact, specification);
        s.faces = s.truth.kind == CM_KIND_CUBE ? 6 : 1;
        s.is_disc = s.truth.kind == CM_KIND_AZIMUTHAL;
        s.has_gaps = strncmp(specification, "rhealpix", 8) == 0;
        s.is_other = s.faces == 1 && cm_catalogue_find(specification) == NULL;
        note_where_it_is_flat(&s, specification);
        s.is_plane = s.truth.kind == CM_KIND_DISC_SQUARE;
        if (s.is_disc)
        {
            find_view(&s);
        }
        measure(&s, of->round_trips, of->comparisons, (uint64_t)of->stride);
        broken = report(&s, specification);
    }
    cm_mapping_destroy(s.mapping);
    cm_mapping_destroy(s.exact);
    cm_mapping_destroy(s.undo);
    return broken;
}

static int usage(void)
{
    fprintf(
        stderr,
        "usage: certificate [-r ROUND_TRIPS] [-t COMPARISONS] [-s STRIDE] "
        "[-p double|float|fast] [-i INSTRUCTIONS] [SPECIFICATION...]\n"
        "  -r  random round trips a mapping (1000000)\n"
        "  -t  random comparisons with the truth, forward, inverse and warp (100000)\n"
        "  -s  compare one hard direction in so many with the truth, and above 1 hard\n"
        "      points of one face at a time, each in turn (1: all); from 100 on a seventh\n"
        "      of the hard directions makes round trips and every second hard point of a\n"
        "      face is compared\n"
        "  -p  only that precision, or the fast tier\n"
        "  Without a specification the mappings to six faces.\n"
        "  -i  scalar, sse2, avx2, avx512, neon; 77 is the exit status if this machine cannot\n");
    return 2;
}

static int is_runnable(const char *instructions)
{
    int found = instructions == NULL;
    for (size_t i = 0; i < cm_instructions_count(); i++)
    {
        found |= instructions != NULL && strcmp(instructions, cm_instructions_at(i)) == 0;
    }
    return found;
}

/* NaN, which no amount can be, if the text is none */
static double number_of(const char *text)
{
    double value = (double)NAN;
    (void)cm_number_parse(text, strlen(text), &value);
    return value;
}

int main(int argc, char **argv)
{
    amounts of = {1e6, 1e5, 1.0};
    const char *only = NULL;
    const char *instructions = NULL;
    int first = 1;
    for (; first + 1 < argc && argv[first][0] == '-'; first += 2)
    {
        const char *value = argv[first + 1];
        switch (argv[first][1])
        {
        case 'r':
            of.round_trips = number_of(value);
            break;
        case 't':
            of.comparisons = number_of(value);
            break;
        case 's':
            of.stride = number_of(value);
            break;
        case 'p':
            only = value;
            break;
        case 'i':
            instructions = value;
            break;
        default:
            return usage();
        }
    }
    if (!(of.round_trips >= 0.0 && of.comparisons >= 0.0 && of.stride >= 1.0) ||
        (first < argc && argv[first][0] == '-'))
    {
        return usage();
    }
    if (!is_runnable(instructions))
    {
        fprintf(stderr, "certificate: no instruction set %s here\n", instructions);
        return 77;
    }
    int broken = 0;
    size_t count = first < argc ? (size_t)(argc - first) : cube_count();
    for (size_t i = 0; i < count; i++)
    {
        const char *name = first < argc ? argv[(size_t)first + i] : cm_catalogue_at(i)->identifier;
        const scale bounds = scale_of(name);
        for (int k = 0; k < PRECISIONS; k++)
        {
            if (only == NULL || strcmp(only, precision_names[k]) == 0)
            {
                broken |= certify(name, instructions, (precision_kind)k, &bounds, &of);
            }
        }
    }
    return broken;
}
