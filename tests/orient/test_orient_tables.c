/* SPDX-License-Identifier: MIT
 *
 * The tables that the search for an orientation bounds boxes by, against all that they stand for: masks of odd
 * sizes and of more columns than erosion keeps, and fields with places that have no value.
 */
#include "tests/suite.h"

#include "mask_pixel.h"

#include "libcubemap/mapping/set_choice.h"
#include "libcubemap/orient/orient_edges.h"
#include "libcubemap/orient/orient_field.h"
#include "libcubemap/orient/orient_mask.h"
#include "libcubemap/orient/orient_survey.h"
#include "libcubemap/orient/orient_value.h"

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* A mask with values from 0 to 1, so that most of its neighbours differ. */
static cm_mask make_mask(size_t width, size_t height)
{
    uint64_t state = 3 + width * 1000 + height;
    float *value = malloc(width * height * sizeof *value);
    ck_assert_ptr_nonnull(value);
    for (size_t i = 0; i < width * height; i++)
    {
        value[i] = (float)(0.5 + 0.5 * next_real(&state));
    }
    value[0] = 1.0f;
    return (cm_mask){sizeof(cm_mask), width, height, value};
}

static void drop_mask(cm_mask *mask)
{
    free((float *)mask->value);
}

/* ---- A mask's pixels ---- */

/* A piece of the table is the mean of what its parts are in, which a search of edges begins with. */
START_TEST(masks_as_tables)
{
    static const size_t sizes[][2] = {{1, 1}, {1, 7}, {2, 1}, {37, 19}, {1441, 5}};
    enum
    {
        SIDE = 9
    };
    for (size_t n = 0; n < COUNT(sizes); n++)
    {
        cm_mask mask = make_mask(sizes[n][0], sizes[n][1]);
        const cm_orient_task task = {.mask = &mask, .largest = 2.0};
        cm_orient_table table;
        ck_assert(cm_table_make(&table, SIDE));
        cm_plain_table(&task, &table);
        for (unsigned i = 0; i < 6 * SIDE * SIDE; i++)
        {
            double sum = 0.0;
            for (int k = 0; k < 16; k++)
            {
                const double u = (i / SIDE % SIDE + (k / 4 + 0.5) / 4.0) * 2.0 / SIDE - 1.0;
                const double v = (i % SIDE + (k % 4 + 0.5) / 4.0) * 2.0 / SIDE - 1.0;
                double d[3];
                cm_table_direction(i / SIDE / SIDE, u, v, d);
                sum += pixel_at(&mask, d);
            }
            REQUIRE(fabs((double)table.piece[i].base - sum / 32.0) < 1e-6,
                    "%zu x %zu, piece %u: %g, not %g", mask.width, mask.height, i,
                    (double)table.piece[i].base, sum / 32.0);
        }
        cm_table_free(&table);
        drop_mask(&mask);
    }
}
END_TEST

/* ---- Pieces ---- */

static void piece_centre(const cm_orient_table *table, size_t i, double d[3])
{
    const size_t side = table->side;
    cm_table_direction((unsigned)(i / side / side),
                       (2.0 * (double)(i / side % side) + 1.0) / (double)side - 1.0,
                       (2.0 * (double)(i % side) + 1.0) / (double)side - 1.0, d);
}

/* Every direction is in the piece that is said, and no further from its centre than is said. */
START_TEST(pieces)
{
    static const unsigned sides[] = {1, 2, 33, 64};
    uint64_t state = 11;
    for (size_t n = 0; n < COUNT(sides); n++)
    {
        cm_orient_table table;
        double centre[3];
        const int count = (int)(6 * sides[n] * sides[n]);
        ck_assert(cm_table_make(&table, sides[n]));
        for (int i = 0; i < count; i++)
        {
            piece_centre(&table, (size_t)i, centre);
            REQUIRE(cm_table_locate(centre, sides[n]) == i, "side %u, piece %d", sides[n], i);
        }
        for (int i = 0; i < 20000; i++)
        {
            /* corners, middles of edges and faces, and any */
            double d[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 % 3 - 1};
            if (i >= 27 || i == 13)
            {
                next_direction(&state, d);
            }
            const int found = cm_table_locate(d, sides[n]);
            REQUIRE(found >= 0 && found < count, "side %u: %g %g %g in %d", sides[n], d[0], d[1],
                    d[2], found);
            piece_centre(&table, (size_t)found, centre);
            REQUIRE(angle_between(d, centre) <= table.half_diagonal + 1e-12,
                    "side %u: %g %g %g in %d", sides[n], d[0], d[1], d[2], found);
        }
        cm_table_free(&table);
    }
}
END_TEST

/* ---- Edges ---- */

START_TEST(edges)
{
    const struct
    {
        const char *mapping;
        int kept;
        double length; /* 0: not known */
    } cases[] = {{"coupled", 24, 12.0 * acos(1.0 / 3.0)},
                 {"conformal", 24, 12.0 * acos(1.0 / 3.0)},
                 {"healpix", 8, 0.0}};
    for (size_t n = 0; n < COUNT(cases); n++)
    {
        cm_mapping *mapping = make_mapping(cases[n].mapping, NULL);
        cm_mask mask = make_mask(4, 2);
        cm_orient_task task = {.mapping = mapping, .measure = CM_ORIENT_EDGES, .mask = &mask};
        cm_orient_points points;
        cm_symmetries all;
        double whole;
        double weight = 0.0;
        int kept = 0;
        ck_assert(cm_edge_points(mapping, 0.01, &points, &whole));
        for (size_t i = 0; i < points.count; i++)
        {
            const double d[3] = {(double)points.x[i], (double)points.y[i], (double)points.z[i]};
            double uv[2];
            cm_forward(mapping, d, uv);
            REQUIRE(fmax(fabs(uv[0]), fabs(uv[1])) > 1.0 - 1e-5, "%s: %g %g is on no edge",
                    cases[n].mapping, uv[0], uv[1]);
            weight += (double)points.weight[i];
        }
        REQUIRE(fabs(weight - 1.0) < 1e-5 && points.reach <= 0.01, "%g, %g", weight, points.reach);
        ck_assert(cm_edges_make(&task));
        REQUIRE(fabs(task.edges_length - whole) < 1e-5, "%s: %.9g, not %.9g", cases[n].mapping,
                task.edges_length, whole);
        REQUIRE(cases[n].length == 0.0 ||
                    (fabs(task.edges_length - cases[n].length) < 1e-12 && task.arc_count == 12),
                "%s: %.15g", cases[n].mapping, task.edges_length);
        cm_all_symmetries(&all);
        ck_assert_uint_eq(all.count, 24);
        for (unsigned i = 0; i < all.count; i++)
        {
            kept += cm_field_is_kept(&task, &all.turn[i]);
        }
        ck_assert_int_eq(kept, cases[n].kept);
        cm_edges_free(&task);
        cm_points_free(&points);
        drop_mask(&mask);
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* ---- What a mask is no less than ---- */

/* The point at an angle from another, in a random azimuth. */
static void beside(uint64_t *state, const double from[3], double angle, double to[3])
{
    double any[3], side[3];
    double square = 0.0;
    next_direction(state, any);
    for (int k = 0; k < 3; k++)
    {
        side[k] = from[(k + 1) % 3] * any[(k + 2) % 3] - from[(k + 2) % 3] * any[(k + 1) % 3];
        square += side[k] * side[k];
    }
    for (int k = 0; k < 3; k++)
    {
        to[k] = from[k] * cos(angle) + side[k] / sqrt(square) * sin(angle);
    }
}

static void check_eroded(const cm_mask *mask, double largest, unsigned side, double reach)
{
    const double best = 0.25;
    const cm_orient_task task = {.mask = mask, .largest = largest};
    cm_orient_table table;
    uint64_t state = side;
    ck_assert(cm_table_make(&table, side));
    ck_assert(cm_mask_table(&task, reach, best, &table));
    for (size_t i = 0; i < (size_t)6 * side * side; i++)
    {
        /* all about it, most at the end of its reach */
        double centre[3], at[3];
        piece_centre(&table, i, centre);
        for (int k = 0; k < 12; k++)
        {
            const double share = k % 3 == 0 ? 0.5 + 0.5 * next_real(&state) : 1.0;
            beside(&state, centre, share * reach, at);
            REQUIRE((double)table.piece[i].base <= pixel_at(mask, at) / largest - best,
                    "%zu x %zu, side %u, reach %g: piece %zu is %g above the mask", mask->width,
                    mask->height, side, reach, i,
                    (double)table.piece[i].base - pixel_at(mask, at) / largest + best);
        }
        REQUIRE(table.piece[i].x == 0.0f && table.piece[i].y == 0.0f && table.piece[i].z == 0.0f,
                "a slope");
    }
    cm_table_free(&table);
}

START_TEST(masks_are_eroded)
{
    static const struct
    {
        size_t width;
        size_t height;
        unsigned side;
        double reach;
    } cases[] = {
        {1, 1, 4, 0.1},        {2, 1, 16, 0.01},       {2, 3, 5, 0.3},       {3, 2, 33, 0.001},
        {5, 7, 33, 0.01},      {36, 18, 32, 0.12},     {90, 45, 9, 3.0},     {1440, 4, 16, 0.02},
        {1441, 720, 32, 0.03}, {1441, 721, 33, 0.004}, {1500, 2, 1, 0.01},   {1600, 801, 64, 0.001},
        {2000, 1, 16, 0.02},   {2881, 90, 17, 0.02},   {4321, 3, 16, 0.004}, {7, 3000, 31, 0.003}};
    for (size_t n = 0; n < COUNT(cases); n++)
    {
        cm_mask mask = make_mask(cases[n].width, cases[n].height);
        check_eroded(&mask, 1.0, cases[n].side, cases[n].reach);
        drop_mask(&mask);
    }
}
END_TEST

/* It is a little less only, and nowhere far from a pixel that is. */
START_TEST(masks_are_eroded_no_more_than_is_needed)
{
    static const size_t sizes[][2] = {{360, 180}, {1441, 721}, {2881, 1440}, {3000, 500}};
    const double reach = 0.05;
    for (size_t n = 0; n < COUNT(sizes); n++)
    {
        cm_mask mask = make_mask(sizes[n][0], sizes[n][1]);
        float *value = (float *)mask.value;
        const size_t blocks = (mask.width + 1439) / 1440;
        const double size =
            (double)blocks * hypot(2.0 * PI / (double)mask.width, PI / (double)mask.height);
        for (size_t hole = 0; hole < 3; hole++)
        {
            const size_t row = hole == 0 ? 0 : hole == 1 ? mask.height / 3 : mask.height - 1;
            const size_t column = hole == 1 ? mask.width - 1 : mask.width / 4;
            const cm_orient_task task = {.mask = &mask, .largest = 2.0};
            cm_orient_table table;
            double d[3], centre[3];
            int near = 0;
            int far = 0;
            for (size_t i = 0; i < mask.width * mask.height; i++)
            {
                value[i] = 2.0f;
            }
            value[row * mask.width + column] = 1.0f;
            cm_direction_from_lonlat(2.0 * PI * (((double)column + 0.5) / (double)mask.width - 0.5),
                                     PI * (0.5 - ((double)row + 0.5) / (double)mask.height), d);
            ck_assert(cm_table_make(&table, 64));
            ck_assert(cm_mask_table(&task, reach, 0.0, &table));
            for (size_t i = 0; i < (size_t)6 * 64 * 64; i++)
            {
                piece_centre(&table, i, centre);
                const double angle = angle_between(centre, d);
                const double is = (double)table.piece[i].base;
                if (angle <= reach)
                {
                    near++;
                    REQUIRE(fabs(is - 0.5) < 1e-6, "%zu columns: %g near the hole", mask.width, is);
                }
                else if (angle > reach + 4.0 * size)
                {
                    far++;
                    REQUIRE(fabs(is - 1.0) < 1e-6, "%zu columns: %g at %g from the hole",
                            mask.width, is, angle);
                }
            }
            REQUIRE(near > 5 && far > 20000, "%d and %d", near, far);
            cm_table_free(&table);
        }
        drop_mask(&mask);
    }
}
END_TEST

/* ---- What a field is no less than ---- */

static double field_at(const cm_orient_task *task, double best, const double d[3])
{
    double field, scale;
    cm_field_values(task, 1, &d[0], &d[1], &d[2], &field, &scale);
    return scale * (field - best);
}

static double worth(const cm_orient_piece *piece, const double d[3])
{
    return (double)piece->base + (double)piece->x * d[0] + (double)piece->y * d[1] +
           (double)piece->z * d[2];
}

/* Within reach pieces are not above the field, but for little at few points between samples: the bounds are
 * numerical. At their centres they are not far below it. */
static void check_field(const cm_orient_task *task, const char *what, unsigned side, double reach,
                        double most_below)
{
    enum
    {
        POINTS = 8
    };
    const double best = 1.1;
    uint64_t state = 9;
    double least_scale;
    double below = 0.0;
    double worst = 0.0;
    int above = 0;
    int count = 0;
    cm_orient_table table;
    ck_assert(cm_table_make(&table, side));
    ck_assert(cm_field_table(task, reach, 0.0, best, &table, &least_scale));
    for (size_t i = 0; i < (size_t)6 * side * side; i += side / 19, count++)
    {
        double centre[3], at[3];
        piece_centre(&table, i, centre);
        const double there = field_at(task, best, centre);
        REQUIRE(isfinite(there) && isfinite(worth(&table.piece[i], centre)), "%s: piece %zu", what,
                i);
        below += there - worth(&table.piece[i], centre);
        for (int k = 0; k < POINTS; k++)
        {
            beside(&state, centre, k % 4 == 0 ? 0.7 * reach : reach, at);
            const double value = field_at(task, best, at);
            const double over = worth(&table.piece[i], at) - value;
            above += over > 1e-6;
            worst = fmax(worst, over);
        }
    }
    below /= count;
    printf("%s: %.3g below on average; of %d points %d are above, by %.2g\n", what, below,
           count * POINTS, above, worst);
    REQUIRE(below > 0.0 && below < most_below, "%s: %g below", what, below);
    REQUIRE(above <= count * POINTS / 1000 && worst <= 0.04, "%s: %d above, by %g", what, above,
            worst);
    cm_table_free(&table);
}

START_TEST(fields)
{
    static const struct
    {
        const char *mapping;
        cm_orient_measure measure;
        cm_measure over;
        double most_below;
    } cases[] = {{"gnomonic", CM_ORIENT_ISOTROPY, CM_OVER_SPHERE, 0.09},
                 {"coupled", CM_ORIENT_SCALE, CM_OVER_FACE, 0.0065},
                 {"healpix", CM_ORIENT_DEFORMATION, CM_OVER_SPHERE, 0.14},
                 {"conformal", CM_ORIENT_SCALE, CM_OVER_SPHERE, 0.45},
                 {"arvo", CM_ORIENT_ISOTROPY, CM_OVER_FACE, 0.31},
                 {"smoothstep:c=1", CM_ORIENT_ISOTROPY, CM_OVER_SPHERE, 14.0},
                 {"smoothstep:c=1", CM_ORIENT_AREA, CM_OVER_SPHERE, 1.8},
                 {"smoothstep:c=1", CM_ORIENT_AREA, CM_OVER_FACE, 1.1}};
    for (size_t n = 0; n < COUNT(cases); n++)
    {
        cm_mapping *mapping = make_mapping(cases[n].mapping, NULL);
        cm_symmetries all;
        cm_orient_task task = {
            .mapping = mapping, .measure = cases[n].measure, .over = cases[n].over, .threads = 1};
        cm_all_symmetries(&all);
        for (unsigned i = 0; i < all.count; i++)
        {
            if (cm_field_is_kept(&task, &all.turn[i]))
            {
                task.symmetries.turn[task.symmetries.count++] = all.turn[i];
            }
        }
        ck_assert(task.symmetries.count > 0 && task.symmetries.turn[0].q[0] == 1.0);
        check_field(&task, cases[n].mapping, 96, 0.12, cases[n].most_below);
        if (n == 0)
        {
            check_field(&task, "gnomonic, near", 224, 0.025, 0.012);
        }
        cm_mapping_destroy(mapping);
    }
}
END_TEST

/* Where there is no value a piece is flat: here nowhere is one. */
START_TEST(fields_without_values)
{
    static const double bests[] = {(double)INFINITY, -(double)INFINITY, (double)NAN};
    cm_mapping *mapping = make_mapping("coupled", NULL);
    const cm_orient_task task = {.mapping = mapping, .over = CM_OVER_SPHERE, .threads = 1};
    for (size_t n = 0; n < COUNT(bests); n++)
    {
        cm_orient_table table;
        double least_scale;
        ck_assert(cm_table_make(&table, 32));
        ck_assert(cm_field_table(&task, 0.1, 0.05, bests[n], &table, &least_scale));
        for (size_t i = 0; i < (size_t)6 * 32 * 32; i++)
        {
            const cm_orient_piece *piece = &table.piece[i];
            REQUIRE(piece->x == 0.0f && piece->y == 0.0f && piece->z == 0.0f &&
                        piece->base <= 0.0f && (bests[n] > 0.0 || piece->base > -1e-3f),
                    "best %g, piece %zu: %g, %g %g %g", bests[n], i, (double)piece->base,
                    (double)piece->x, (double)piece->y, (double)piece->z);
        }
        cm_table_free(&table);
    }
    cm_mapping_destroy(mapping);
}
END_TEST

/* Beside places without a value pieces are numbers: here floats end where the scale is larger than somewhere. */
START_TEST(fields_with_few_values)
{
    const double somewhere[3] = {1.0, 0.3, 0.2};
    cm_mapping *mapping = make_mapping("coupled", NULL);
    const cm_orient_task task = {.mapping = mapping, .over = CM_OVER_FACE, .threads = 1};
    const double best =
        -3.4028234e38 / (field_at(&task, -1.0, somewhere) - field_at(&task, 0.0, somewhere));
    cm_orient_table table;
    double least_scale;
    int with = 0;
    ck_assert(cm_table_make(&table, 64));
    ck_assert(cm_field_table(&task, 0.05, 0.02, best, &table, &least_scale));
    for (size_t i = 0; i < (size_t)6 * 64 * 64; i++)
    {
        const cm_orient_piece *piece = &table.piece[i];
        double centre[3];
        piece_centre(&table, i, centre);
        const double value = field_at(&task, best, centre);
        with += value < 3.4028234e38;
        REQUIRE(isfinite(piece->x) && isfinite(piece->y) && isfinite(piece->z) &&
                    worth(piece, centre) <= value,
                "piece %zu: %g, %g %g %g", i, (double)piece->base, (double)piece->x,
                (double)piece->y, (double)piece->z);
    }
    REQUIRE(with > 2000 && with < 22000, "%d", with);
    cm_table_free(&table);
    cm_mapping_destroy(mapping);
}
END_TEST

/* ---- Sums ---- */

/* In the plain way, of a turned point what its piece says. */
static double plain_sum(const cm_orient_points *points, const cm_orient_table *table,
                        const cm_rotation *turn, double torque[3])
{
    double sum = 0.0;
    torque[0] = torque[1] = torque[2] = 0.0;
    for (size_t i = 0; i < points->count; i++)
    {
        const double w = (double)points->weight[i];
        double v[3] = {(double)points->x[i], (double)points->y[i], (double)points->z[i]};
        cm_rotate(turn, v, v);
        const cm_orient_piece *piece = &table->piece[cm_table_locate(v, table->side)];
        const double g[3] = {(double)piece->x, (double)piece->y, (double)piece->z};
        sum += w * ((double)piece->base + g[0] * v[0] + g[1] * v[1] + g[2] * v[2]);
        for (int k = 0; k < 3; k++)
        {
            torque[k] += w * (v[(k + 1) % 3] * g[(k + 2) % 3] - v[(k + 2) % 3] * g[(k + 1) % 3]);
        }
    }
    return sum;
}

/* A table that is smooth, so that it is no matter in which of two pieces a point near a border is. */
static void fill_table(cm_orient_table *table)
{
    ck_assert_int_eq(cm_table_make(table, 64), 1);
    for (unsigned i = 0; i < 6 * 64 * 64; i++)
    {
        double d[3];
        cm_table_direction(i / 4096, (i / 64 % 64 + 0.5) / 32.0 - 1.0, (i % 64 + 0.5) / 32.0 - 1.0,
                           d);
        table->piece[i] = (cm_orient_piece){(float)(0.3 + 0.05 * d[0] * d[1]), (float)(0.2 * d[2]),
                                            (float)(0.1 * d[0]), (float)(-0.1 * d[1])};
    }
}

/* Of every set of instructions, as the plain sum and bit by bit like the scalar one, for numbers of points that are no
 * multiples of anything, too. */
START_TEST(sums)
{
    static const size_t counts[] = {1, 3, 4, 255, 257, 1000};
    cm_mapping *mapping = make_mapping("coupled", NULL);
    cm_orient_points points;
    cm_orient_table table;
    double whole;
    uint64_t state = 9;
    ck_assert_int_eq(cm_edge_points(mapping, 0.02, &points, &whole), 1);
    ck_assert_uint_gt(points.count, counts[COUNT(counts) - 1]);
    fill_table(&table);
    for (size_t n = 0; n < COUNT(counts) * 20; n++)
    {
        cm_rotation turn;
        float rounded[9];
        double expected[3], torque[2][3];
        points.count = counts[n / 20];
        cm_rotation_from_angles(180.0 * next_real(&state), 90.0 * next_real(&state),
                                180.0 * next_real(&state), &turn);
        for (int k = 0; k < 9; k++)
        {
            rounded[k] = (float)turn.row[k / 3][k % 3];
        }
        const double plain = plain_sum(&points, &table, &turn, expected);
        const double scalar =
            cm_batch_set_find("scalar")->orient_sum(&points, &table, rounded, torque[0]);
        REQUIRE(fabs(scalar - plain) < 1e-4 * plain, "%.9g, not %.9g", scalar, plain);
        for (int k = 0; k < 3; k++)
        {
            REQUIRE(fabs(torque[0][k] - expected[k]) < 1e-4 * plain, "torque %d: %.9g, not %.9g", k,
                    torque[0][k], expected[k]);
        }
        for (size_t i = 0; i < cm_instructions_count(); i++)
        {
            const cm_batch_set *set = cm_batch_set_find(cm_instructions_at(i));
            REQUIRE(set->orient_sum(&points, &table, rounded, torque[1]) == scalar &&
                        set->orient_sum(&points, &table, rounded, NULL) == scalar &&
                        memcmp(torque[0], torque[1], sizeof torque[0]) == 0,
                    "%s differs from scalar", set->name);
        }
    }
    cm_points_free(&points);
    cm_table_free(&table);
    cm_mapping_destroy(mapping);
}
END_TEST

/* ---- Downhill ---- */

/* How far a rotation is from another, which is the lowest place; and rough besides if that is wanted. */
typedef struct well
{
    cm_quaternion bottom;
    cm_symmetries none;
    double roughness;
    int calls;
} well;

static double depth(const void *of, const cm_quaternion *at)
{
    well *w = (well *)of; /* to count */
    w->calls++;
    const double far = cm_rotations_apart(at, &w->bottom, &w->none);
    return far + w->roughness * (1.0 + sin(3000.0 * at->q[1]) * sin(2000.0 * at->q[2]));
}

static well make_well(double x, double y, double z, double roughness)
{
    const double length = sqrt(1.0 + x * x + y * y + z * z);
    well w = {.bottom = {{1.0 / length, x / length, y / length, z / length}},
              .roughness = roughness};
    w.none.count = 1;
    w.none.turn[0] = (cm_quaternion){{1.0, 0.0, 0.0, 0.0}};
    return w;
}

static double flat(const void *of, const cm_quaternion *at)
{
    (void)of;
    (void)at;
    return 1.0;
}

static double none(const void *of, const cm_quaternion *at)
{
    (void)of;
    (void)at;
    return (double)NAN;
}

START_TEST(ways_down)
{
    well smooth = make_well(0.02, -0.05, 0.03, 0.0);
    cm_quaternion at = smooth.none.turn[0];
    const double value = cm_descend(depth, &smooth, 0.01, 1e-5, &at);
    REQUIRE(value < 2e-5 && value == cm_rotations_apart(&at, &smooth.bottom, &smooth.none), "%g",
            value);
    REQUIRE(smooth.calls < 3000, "%d calls", smooth.calls);

    /* where a way down ends at once, looking about finds the bottom's neighbour, and follows it and others */
    well rough = make_well(0.003, -0.002, 0.001, 0.002);
    const cm_orient_grid grid = {.step = 0.001, .steps = 8, .bottoms = 1, .least = 1.0};
    at = rough.none.turn[0];
    const double about = cm_look_about(depth, &rough, 1, &grid, &at);
    REQUIRE(rough.calls >= 17 * 17 * 17 && rough.calls < 17 * 17 * 17 + 100, "%d calls",
            rough.calls);
    const double far = cm_rotations_apart(&at, &rough.bottom, &rough.none);
    REQUIRE(far < 0.0045 && about == depth(&rough, &at), "%g, value %g", far, about);
    const cm_orient_grid fine = {.step = 0.001, .steps = 8, .bottoms = 20000, .least = 1e-6};
    at = rough.none.turn[0];
    const double followed = cm_look_about(depth, &rough, 1, &fine, &at);
    REQUIRE(followed < about && followed == depth(&rough, &at), "%g, not less than %g", followed,
            about);

    /* of what is the same everywhere the middle stays */
    well level = make_well(0.0, 0.0, 0.0, 0.0);
    at = rough.none.turn[0];
    REQUIRE(cm_look_about(flat, &level, 1, &fine, &at) == 1.0 && at.q[0] == 1.0, "%g", at.q[0]);
    REQUIRE(isnan(cm_look_about(none, &level, 1, &fine, &at)), "no memory");
}
END_TEST

int main(void)
{
    const TTest *tests[] = {ways_down,
                            sums,
                            masks_as_tables,
                            pieces,
                            edges,
                            masks_are_eroded,
                            masks_are_eroded_no_more_than_is_needed,
                            fields,
                            fields_without_values,
                            fields_with_few_values,
                            NULL};
    return run_suite("tables of orientations", tests);
}
