/* SPDX-License-Identifier: MIT
 *
 * HEALPix pixels, this library's arrays and its functions for one point beside chealpix and healpix_cxx (Gorski, Reinecke
 * et al.), on the same points in one interleaved run on one core: nanoseconds a point, and beside them how many of the
 * points the arrays and chealpix put into a pixel that they are not in, or how far their centres are from the true ones,
 * by quadruple precision (truth/quad_healpix.h). That of a point alone is the arrays' to the bit, and
 * neighbours are healpix_cxx's: how many are not is said. Who takes a vector of three is given it where it is, as a
 * program has its points; healpix_cxx takes three numbers.
 *
 * Usage: pixels [--nside N] [--points N] [--repetitions N] [--set NAME] [--count]
 */
#include "bench/harness/harness.h"
#include "healpix_cxx.h"

#include "truth/quad_healpix.h"
#include "truth/sphere.h"

#include <chealpix.h>

#include <cubemap/cubemap.h>

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef HAVE_CALLGRIND
#include <valgrind/callgrind.h>
#endif

typedef struct settings
{
    int64_t nside;
    size_t points;
    size_t repetitions;
    const char *set;
    int count; /* for callgrind */
} settings;

/* What all functions read and write. */
typedef struct batch
{
    int64_t nside;
    size_t n;
    const cm_healpix *healpix[2]; /* by order */
    double *direction[3];
    double *theta;
    double *phi;
    int64_t *number[2];
    double *made[3];
    double (*vector)[3];      /* the directions again, as functions of one point take them */
    double (*made_vector)[3]; /* and as they give them: made is of who gives arrays */
    int are_vectors;          /* 1: the last centres are there */
    int64_t *pixel;
    int64_t (*around)[8];
} batch;

/* ---- What is measured: ours, then that of a point alone, then chealpix's, for each order ---- */

typedef void (*function)(batch *b, int order);

static void our_from_direction(batch *b, int order)
{
    cm_healpix_pixel_from_direction_array(b->healpix[order], b->n, b->direction[0], b->direction[1],
                                          b->direction[2], b->pixel);
}

static void alone_from_direction(batch *b, int order)
{
    for (size_t i = 0; i < b->n; i++)
    {
        (void)cm_healpix_pixel_from_direction(b->healpix[order], b->vector[i], &b->pixel[i]);
    }
}

static void their_from_direction(batch *b, int order)
{
    for (size_t i = 0; i < b->n; i++)
    {
        (order == CM_HEALPIX_RING ? vec2pix_ring64 : vec2pix_nest64)(b->nside, b->vector[i],
                                                                     &b->pixel[i]);
    }
}

static void our_from_angles(batch *b, int order)
{
    cm_healpix_pixel_from_angles_array(b->healpix[order], b->n, b->theta, b->phi, b->pixel);
}

static void alone_from_angles(batch *b, int order)
{
    for (size_t i = 0; i < b->n; i++)
    {
        (void)cm_healpix_pixel_from_angles(b->healpix[order], b->theta[i], b->phi[i], &b->pixel[i]);
    }
}

static void their_from_angles(batch *b, int order)
{
    for (size_t i = 0; i < b->n; i++)
    {
        (order == CM_HEALPIX_RING ? ang2pix_ring64 : ang2pix_nest64)(b->nside, b->theta[i],
                                                                     b->phi[i], &b->pixel[i]);
    }
}

static void our_to_direction(batch *b, int order)
{
    cm_healpix_direction_from_pixel_array(b->healpix[order], b->n, b->number[order], b->made[0],
                                          b->made[1], b->made[2]);
}

static void alone_to_direction(batch *b, int order)
{
    for (size_t i = 0; i < b->n; i++)
    {
        (void)cm_healpix_direction_from_pixel(b->healpix[order], b->number[order][i],
                                              b->made_vector[i]);
    }
    b->are_vectors = 1;
}

static void their_to_direction(batch *b, int order)
{
    for (size_t i = 0; i < b->n; i++)
    {
        (order == CM_HEALPIX_RING ? pix2vec_ring64 : pix2vec_nest64)(b->nside, b->number[order][i],
                                                                     b->made_vector[i]);
    }
    b->are_vectors = 1;
}

static void our_to_angles(batch *b, int order)
{
    cm_healpix_angles_from_pixel_array(b->healpix[order], b->n, b->number[order], b->made[0],
                                       b->made[1]);
}

static void alone_to_angles(batch *b, int order)
{
    for (size_t i = 0; i < b->n; i++)
    {
        (void)cm_healpix_angles_from_pixel(b->healpix[order], b->number[order][i], &b->made[0][i],
                                           &b->made[1][i]);
    }
}

static void their_to_angles(batch *b, int order)
{
    for (size_t i = 0; i < b->n; i++)
    {
        (order == CM_HEALPIX_RING ? pix2ang_ring64 : pix2ang_nest64)(
            b->nside, b->number[order][i], &b->made[0][i], &b->made[1][i]);
    }
}

static void our_renumber(batch *b, int order)
{
    if (order == CM_HEALPIX_RING)
    {
        (void)cm_healpix_nested_from_ring_array(b->healpix[0], b->n, b->number[0], b->pixel);
    }
    else
    {
        (void)cm_healpix_ring_from_nested_array(b->healpix[0], b->n, b->number[1], b->pixel);
    }
}

static void alone_renumber(batch *b, int order)
{
    for (size_t i = 0; i < b->n; i++)
    {
        (void)(order == CM_HEALPIX_RING
                   ? cm_healpix_nested_from_ring
                   : cm_healpix_ring_from_nested)(b->healpix[0], b->number[order][i], &b->pixel[i]);
    }
}

static void their_renumber(batch *b, int order)
{
    for (size_t i = 0; i < b->n; i++)
    {
        (order == CM_HEALPIX_RING ? ring2nest64 : nest2ring64)(b->nside, b->number[order][i],
                                                               &b->pixel[i]);
    }
}

static void alone_neighbours(batch *b, int order)
{
    for (size_t i = 0; i < b->n; i++)
    {
        (void)cm_healpix_neighbours(b->healpix[order], b->number[order][i], b->around[i]);
    }
}

#ifdef HAVE_HEALPIX_CXX
static void cxx_from_direction(batch *b, int order)
{
    healpix_cxx_from_directions(order, b->n, b->direction, b->pixel);
}

static void cxx_from_angles(batch *b, int order)
{
    healpix_cxx_from_angles(order, b->n, b->theta, b->phi, b->pixel);
}

static void cxx_to_direction(batch *b, int order)
{
    healpix_cxx_to_directions(order, b->n, b->number[order], b->made);
}

static void cxx_to_angles(batch *b, int order)
{
    healpix_cxx_to_angles(order, b->n, b->number[order], b->made[0], b->made[1]);
}

static void cxx_renumber(batch *b, int order)
{
    healpix_cxx_renumber(order, b->n, b->number[order], b->pixel);
}

static void cxx_neighbours(batch *b, int order)
{
    healpix_cxx_neighbours(order, b->n, b->number[order], b->around);
}
#define CXX(function) function
#else
#define CXX(function) NULL
#endif

/* What was made as vectors, as arrays. */
static void run_and_spread(batch *b, function run, int order)
{
    b->are_vectors = 0;
    run(b, order);
    for (size_t i = 0; b->are_vectors && i < b->n; i++)
    {
        for (size_t k = 0; k < 3; k++)
        {
            b->made[k][i] = b->made_vector[i][k];
        }
    }
}

/* ---- Errors ---- */

static int64_t nested_of(const batch *b, int order, int64_t pixel)
{
    int64_t nested = pixel;
    if (order == CM_HEALPIX_RING)
    {
        (void)cm_healpix_nested_from_ring(b->healpix[0], pixel, &nested);
    }
    return nested;
}

/* A text: how many pixels are wrong, or how far centres are. */
static void error_of_points(const batch *b, int order, int angles, char *text, size_t size)
{
    size_t wrong = 0;
    for (size_t i = 0; i < b->n; i++)
    {
        const double d[3] = {b->direction[0][i], b->direction[1][i], b->direction[2][i]};
        healpix_quad_place truth =
            angles ? healpix_quad_place_of_angles(b->nside, b->theta[i], b->phi[i])
                   : healpix_quad_place_of_direction(b->nside, d);
        wrong += nested_of(b, order, b->pixel[i]) != healpix_quad_nested(b->nside, &truth);
    }
    (void)snprintf(text, size, "%zu wrong", wrong);
}

static void error_of_centres(const batch *b, int angles, char *text, size_t size)
{
    double worst = 0.0;
    for (size_t i = 0; i < b->n; i++)
    {
        healpix_quad truth_angles[2];
        healpix_quad truth[3];
        const double d[3] = {b->made[0][i], b->made[1][i], b->made[2][i]};
        healpix_quad_centre(b->nside, b->number[CM_HEALPIX_NESTED][i], truth_angles, truth);
        double metres = angles ? healpix_quad_metres_of_angles(d[0], d[1], truth)
                               : healpix_quad_metres_of_direction(d, truth);
        worst = fmax(worst, metres);
    }
    (void)snprintf(text, size, "%.2f nm", worst * 1e9);
}

static void error_of_numbers(const batch *b, int order, char *text, size_t size)
{
    size_t wrong = 0;
    for (size_t i = 0; i < b->n; i++)
    {
        wrong += b->pixel[i] != b->number[1 - order][i];
    }
    (void)snprintf(text, size, "%zu wrong", wrong);
}

enum
{
    OF_DIRECTIONS,
    OF_ANGLES,
    TO_DIRECTIONS,
    TO_ANGLES,
    OF_NUMBERS,
    NEIGHBOURS
};

enum
{
    ARRAYS,
    ALONE,
    CHEALPIX,
    HEALPIX_CXX,
    CONTESTANTS
};

static const char *const contestants[CONTESTANTS] = {"arrays", "alone", "chealpix", "healpix_cxx"};

static const struct
{
    const char *name[2];       /* as chealpix calls it, by order */
    function run[CONTESTANTS]; /* NULL: it has none */
    int kind;
} rows[] = {
    {{"vec2pix_ring", "vec2pix_nest"},
     {our_from_direction, alone_from_direction, their_from_direction, CXX(cxx_from_direction)},
     OF_DIRECTIONS},
    {{"ang2pix_ring", "ang2pix_nest"},
     {our_from_angles, alone_from_angles, their_from_angles, CXX(cxx_from_angles)},
     OF_ANGLES},
    {{"pix2vec_ring", "pix2vec_nest"},
     {our_to_direction, alone_to_direction, their_to_direction, CXX(cxx_to_direction)},
     TO_DIRECTIONS},
    {{"pix2ang_ring", "pix2ang_nest"},
     {our_to_angles, alone_to_angles, their_to_angles, CXX(cxx_to_angles)},
     TO_ANGLES},
    {{"ring2nest", "nest2ring"},
     {our_renumber, alone_renumber, their_renumber, CXX(cxx_renumber)},
     OF_NUMBERS},
    {{"neighbors_ring", "neighbors_nest"},
     {NULL, alone_neighbours, NULL, CXX(cxx_neighbours)},
     NEIGHBOURS},
};

enum
{
    ROWS = sizeof rows / sizeof *rows
};

static void error_text(const batch *b, int kind, int order, char *text, size_t size)
{
    switch (kind)
    {
    case OF_DIRECTIONS:
    case OF_ANGLES:
        error_of_points(b, order, kind == OF_ANGLES, text, size);
        break;
    case TO_DIRECTIONS:
    case TO_ANGLES:
        error_of_centres(b, kind == TO_ANGLES, text, size);
        break;
    default:
        error_of_numbers(b, order, text, size);
    }
}

/* ---- Runs ---- */

static double time_once(batch *b, function run, int order)
{
    double start = seconds();
    run(b, order);
    return (seconds() - start) * 1e9 / (double)b->n;
}

static void fill(batch *b)
{
    uint64_t state = 29;
    for (int k = 0; k < 3; k++)
    {
        b->direction[k] = allocate(b->n, sizeof(double));
        b->made[k] = allocate(b->n, sizeof(double));
    }
    b->theta = allocate(b->n, sizeof(double));
    b->phi = allocate(b->n, sizeof(double));
    b->pixel = allocate(b->n, sizeof(int64_t));
    b->around = allocate(b->n, sizeof *b->around);
    b->vector = allocate(b->n, sizeof *b->vector);
    b->made_vector = allocate(b->n, sizeof *b->made_vector);
    b->number[0] = allocate(b->n, sizeof(int64_t));
    b->number[1] = allocate(b->n, sizeof(int64_t));
    for (size_t i = 0; i < b->n; i++)
    {
        double d[3];
        next_direction(&state, d);
        for (int k = 0; k < 3; k++)
        {
            b->direction[k][i] = b->vector[i][k] = d[k];
        }
        b->theta[i] = atan2(hypot(d[0], d[1]), d[2]);
        b->phi[i] = atan2(d[1], d[0]);
        b->phi[i] += b->phi[i] < 0.0 ? 6.283185307179586 : 0.0;
        b->number[1][i] = (int64_t)(next_bits(&state) % (uint64_t)(12 * b->nside * b->nside));
        nest2ring64(b->nside, b->number[1][i], &b->number[0][i]);
    }
}

/* The best of interleaved repetitions. */
static void time_row(batch *b, size_t row, int order, size_t repetitions, double best[CONTESTANTS])
{
    for (int c = 0; c < CONTESTANTS; c++)
    {
        best[c] = (double)INFINITY;
    }
    for (size_t r = 0; r < repetitions; r++)
    {
        for (int c = 0; c < CONTESTANTS; c++)
        {
            if (rows[row].run[c] != NULL)
            {
                best[c] = fmin(best[c], time_once(b, rows[row].run[c], order));
            }
        }
    }
}

/* How many of the results are another's, to the bit. */
static size_t count_apart(batch *b, size_t row, int order, int one, int other)
{
    const size_t bytes = b->n * sizeof(int64_t);
    const function runs[2] = {rows[row].run[one], rows[row].run[other]};
    int64_t *kept[2];
    size_t apart = 0;
    for (int k = 0; k < 2; k++)
    {
        kept[k] = allocate(12 * b->n, sizeof(int64_t));
        run_and_spread(b, runs[k], order);
        memcpy(kept[k], b->pixel, bytes);
        for (size_t c = 0; c < 3; c++)
        {
            memcpy(kept[k] + (c + 1) * b->n, b->made[c], bytes);
        }
        memcpy(kept[k] + 4 * b->n, b->around, 8 * bytes);
    }
    for (size_t i = 0; i < 12 * b->n; i++)
    {
        apart += kept[0][i] != kept[1][i];
    }
    free(kept[0]);
    free(kept[1]);
    return apart;
}

static void print_row(batch *b, size_t row, int order, const double best[CONTESTANTS])
{
    printf("%-14s", rows[row].name[order]);
    for (int c = 0; c < CONTESTANTS; c++)
    {
        char text[32] = "";
        if (isfinite(best[c]))
        {
            (void)snprintf(text, sizeof text, "%.2f", best[c]);
        }
        printf(" %11s", text);
    }
    for (int c = ARRAYS; c <= CHEALPIX; c += CHEALPIX)
    {
        char text[32] = "";
        if (rows[row].run[c] != NULL)
        {
            run_and_spread(b, rows[row].run[c], order);
            error_text(b, rows[row].kind, order, text, sizeof text);
        }
        printf("   %-12s", text);
    }
    const int other = rows[row].run[ARRAYS] != NULL ? ARRAYS : HEALPIX_CXX;
    if (rows[row].run[other] != NULL)
    {
        printf("   %zu", count_apart(b, row, order, ALONE, other));
    }
    printf("\n");
}

static int measure(batch *b, const settings *s)
{
    printf("nside %" PRId64 ", %zu points, %s, %s\n", b->nside, b->n,
           cm_healpix_instructions(b->healpix[0]), system_cpu());
    printf("%-14s", "ns a point");
    for (int c = 0; c < CONTESTANTS; c++)
    {
        printf(" %11s", contestants[c]);
    }
    printf("   %-12s   %-12s   %s\n", "arrays", "chealpix", "alone is other");
    for (size_t i = 0; i < ROWS; i++)
    {
        for (int order = 0; order < 2; order++)
        {
            double best[CONTESTANTS];
            time_row(b, i, order, s->repetitions, best);
            print_row(b, i, order, best);
        }
    }
    return 0;
}

#ifdef HAVE_CALLGRIND
/* Each function once, for callgrind; its counts are dumped under the name. */
static int count_all(batch *b)
{
    CALLGRIND_START_INSTRUMENTATION;
    for (size_t i = 0; i < ROWS; i++)
    {
        for (int k = 0; k < 2 * CONTESTANTS; k++)
        {
            char name[64];
            const int order = k / CONTESTANTS;
            const function run = rows[i].run[k % CONTESTANTS];
            if (run == NULL)
            {
                continue;
            }
            run(b, order);
            CALLGRIND_ZERO_STATS;
            run(b, order);
            (void)snprintf(name, sizeof name, "%s %s", rows[i].name[order],
                           contestants[k % CONTESTANTS]);
            CALLGRIND_DUMP_STATS_AT(name);
        }
    }
    return 0;
}
#else
static int count_all(batch *b)
{
    (void)b;
    fputs("pixels: built without valgrind/callgrind.h, cannot --count\n", stderr);
    return 1;
}
#endif

static int usage(const char *what)
{
    fprintf(stderr,
            "pixels: %s; usage: pixels [--nside N] [--points N] [--repetitions N] [--set NAME] "
            "[--count]\n",
            what);
    return 2;
}

static int read_settings(settings *s, int argc, char **argv)
{
    for (int i = 1; i < argc; i++)
    {
        if (strcmp(argv[i], "--count") == 0)
        {
            s->count = 1;
            continue;
        }
        if (i + 1 == argc)
        {
            return usage(argv[i]);
        }
        double number = 0.0;
        int is_number = cm_number_parse(argv[i + 1], strlen(argv[i + 1]), &number) &&
                        number >= 1.0 && number <= 1e9 && number == floor(number);
        long value = is_number ? (long)number : 0;
        if (strcmp(argv[i], "--set") == 0)
        {
            s->set = argv[i + 1];
        }
        else if (strcmp(argv[i], "--nside") == 0 && is_number)
        {
            s->nside = value;
        }
        else if (strcmp(argv[i], "--points") == 0 && is_number)
        {
            s->points = (size_t)value;
        }
        else if (strcmp(argv[i], "--repetitions") == 0 && is_number)
        {
            s->repetitions = (size_t)value;
        }
        else
        {
            return usage(argv[i]);
        }
        i++;
    }
    return 0;
}

int main(int argc, char **argv)
{
    name_program("pixels");
    settings s = {.nside = CM_HEALPIX_NSIDE_MAX, .points = 8192, .repetitions = 100};
    int status = read_settings(&s, argc, argv);
    if (status != 0)
    {
        return status;
    }
    const cm_options options = {.size = sizeof options, .instructions = s.set};
    cm_healpix *made[2];
    for (int order = 0; order < 2; order++)
    {
        if (cm_healpix_create(s.nside, (cm_healpix_order)order, &options, &made[order]) != CM_OK)
        {
            return usage("no such nside (a power of two) or instruction set");
        }
    }
    batch b = {.nside = s.nside, .n = s.points, .healpix = {made[0], made[1]}};
#ifdef HAVE_HEALPIX_CXX
    healpix_cxx_prepare(s.nside);
#endif
    fill(&b);
    status = s.count ? count_all(&b) : measure(&b, &s);
    cm_healpix_destroy(made[0]);
    cm_healpix_destroy(made[1]);
    for (int k = 0; k < 3; k++)
    {
        free(b.direction[k]);
        free(b.made[k]);
    }
    free(b.theta);
    free(b.phi);
    free(b.pixel);
    free(b.around);
    free(b.vector);
    free(b.made_vector);
    free(b.number[0]);
    free(b.number[1]);
    return status;
}
