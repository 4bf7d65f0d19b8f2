/* SPDX-License-Identifier: MIT
 *
 * Where pixels of a target lie on a source: what is interpolated is as near to what is exact as is asked, parts are the
 * bits of the whole, and derivatives are those of the positions.
 */
#include "modules/image/geometry.h"

#include "tests/suite.h"

#include <cubemap/orientation.h>

/* Blocks of a plane that are asked for, at most. */
#define BLOCKS 150

/* ---- what is asked ---- */

typedef struct pair
{
    cm_surface *from;
    cm_surface *to;
    char words[200];
} pair;

static cm_surface *make_surface(const char *specification, unsigned size,
                                const cm_rotation *rotation)
{
    const cm_surface_options options = {.size = sizeof options, .rotation = rotation};
    char text[160];
    char message[300] = "";
    cm_surface *surface = NULL;
    snprintf(text, sizeof text, "%s;size=%u", specification, size);
    cm_surface_check(text, NULL, message, sizeof message);
    REQUIRE(cm_surface_create(text, &options, &surface) == CM_OK, "%s: %s", text, message);
    return surface;
}

static pair make_pair(const char *from, unsigned from_size, const char *to, unsigned to_size)
{
    pair made;
    cm_rotation rotation;
    ck_assert_int_eq(cm_rotation_from_angles(20.0, 33.0, -41.0, &rotation), CM_OK);
    const int is_turned = (from_size + to_size) / 16 % 2 == 0;
    made.from = make_surface(from, from_size, is_turned ? &rotation : NULL);
    made.to = make_surface(to, to_size, NULL);
    snprintf(made.words, sizeof made.words, "%s %u -> %s %u%s", from, from_size, to, to_size,
             is_turned ? ", turned" : "");
    return made;
}

static void free_pair(pair *made)
{
    cm_surface_destroy(made->from);
    cm_surface_destroy(made->to);
}

static cm_plan *make_plan(const pair *of, double tolerance)
{
    const cm_plan_options options = {.size = sizeof options, .tolerance = tolerance};
    cm_plan *plan = NULL;
    REQUIRE(cm_plan_create(of->from, of->to, &options, &plan) == CM_OK, "%s", of->words);
    return plan;
}

/* ---- blocks pixel by pixel ---- */

/* Where each pixel of a block is; the plane is CM_NO_FACE where it is nowhere. */
typedef struct places
{
    uint8_t plane[CM_BLOCK_PIXELS];
    double x[CM_BLOCK_PIXELS];
    double y[CM_BLOCK_PIXELS];
    double slope[4][CM_BLOCK_PIXELS]; /* of x and y by the column, then by the row */
} places;

static cm_group groups[CM_GROUPS_MAX];

/* Every pixel is in one group at most, and none that the target does not have. */
static void places_of_block(cm_geometry *geometry, const pair *of, unsigned plane, uint32_t column,
                            uint32_t row, int derivatives, places *at)
{
    memset(at->plane, CM_NO_FACE, sizeof at->plane);
    const unsigned count = cm_geometry_block(geometry, plane, column, row, groups);
    REQUIRE(count <= CM_GROUPS_MAX, "%s: %u groups", of->words, count);
    for (unsigned g = 0; g < count; g++)
    {
        const cm_group *group = &groups[g];
        REQUIRE(group->count > 0 && group->plane < of->from->planes, "%s", of->words);
        for (unsigned i = 0; i < group->count; i++)
        {
            const unsigned k = group->pixel[i];
            REQUIRE(at->plane[k] == CM_NO_FACE, "%s: pixel %u twice", of->words, k);
            REQUIRE(i == 0 || k > group->pixel[i - 1], "%s: order", of->words);
            at->plane[k] = group->plane;
            at->x[k] = group->column + 0.5 + (double)group->x[i];
            at->y[k] = group->row + 0.5 + (double)group->y[i];
            for (int s = 0; derivatives && s < 4; s++)
            {
                at->slope[s][k] = (double)(s < 2 ? group->by_column : group->by_row)[s % 2][i];
            }
            const int is_there = column * CM_BLOCK_EDGE + k % CM_BLOCK_EDGE < of->to->width &&
                                 row * CM_BLOCK_EDGE + k / CM_BLOCK_EDGE < of->to->height;
            REQUIRE(is_there, "%s: pixel %u of block %u, %u", of->words, k, column, row);
        }
    }
}

/* The blocks of a plane, or some of many, which are spread over it. */
typedef struct block_walk
{
    uint32_t columns;
    uint32_t count;
    uint32_t step;
} block_walk;

static block_walk walk_of(const cm_surface *to)
{
    const uint32_t columns = (to->width + CM_BLOCK_EDGE - 1) / CM_BLOCK_EDGE;
    const uint32_t rows = (to->height + CM_BLOCK_EDGE - 1) / CM_BLOCK_EDGE;
    const uint32_t most = (uint32_t)(BLOCKS / step_of(10));
    const uint32_t count = columns * rows;
    /* no multiple of the columns */
    const uint32_t step = count <= most ? 1 : count / most;
    return (block_walk){columns, count, step > 1 && columns % step == 0 ? step + 1 : step};
}

/* ---- nearness ---- */

/* What is no number counts for nothing, as with fmin and fmax, which at the optimization of tests are calls. */
static double lesser(double a, double limit)
{
    return a < limit ? a : limit;
}

static double greater(double most, double b)
{
    return b > most ? b : most;
}

/* Without hypot's care for what is huge or tiny, which places in pixels are not. */
static double far_by(double x, double y)
{
    return sqrt(x * x + y * y);
}

static double wrapped(double difference, double period)
{
    return period > 0.0 ? difference - period * floor(difference / period + 0.5) : difference;
}

/* How far a place is from the nearest edge of its plane. */
static double to_edge(const cm_surface *from, double x, double y)
{
    return fmin(fmin(fabs(x), fabs(from->width - x)), fmin(fabs(y), fabs(from->height - y)));
}

/* Exact positions of a block's pixels, those the target does not have left out. */
static void find_exactly(const pair *of, unsigned plane, uint32_t column, uint32_t row, places *at)
{
    double right[CM_BLOCK_PIXELS], down[CM_BLOCK_PIXELS], z[CM_BLOCK_PIXELS];
    for (unsigned i = 0; i < CM_BLOCK_PIXELS; i++)
    {
        right[i] = lesser(column * CM_BLOCK_EDGE + i % CM_BLOCK_EDGE + 0.5, of->to->width - 0.5);
        down[i] = lesser(row * CM_BLOCK_EDGE + i / CM_BLOCK_EDGE + 0.5, of->to->height - 0.5);
    }
    cm_surface_own_directions(of->to, plane, CM_BLOCK_PIXELS, right, down, at->x, at->y, z);
    cm_surface_find(of->from, CM_BLOCK_PIXELS, at->x, at->y, z, at->plane, at->x, at->y);
    for (unsigned i = 0; i < CM_BLOCK_PIXELS; i++)
    {
        const int is_there = column * CM_BLOCK_EDGE + i % CM_BLOCK_EDGE < of->to->width &&
                             row * CM_BLOCK_EDGE + i / CM_BLOCK_EDGE < of->to->height;
        at->plane[i] = is_there ? at->plane[i] : CM_NO_FACE;
    }
}

/* The greatest distance between places of two blocks. A pixel may be on another plane if it is at an edge: by as much
 * as it is beyond it. */
static double distance(const pair *of, const places *near, const places *exact)
{
    double most = 0.0;
    for (unsigned i = 0; i < CM_BLOCK_PIXELS; i++)
    {
        double off = 0.0;
        if (near->plane[i] != CM_NO_FACE && near->plane[i] == exact->plane[i])
        {
            off = far_by(wrapped(near->x[i] - exact->x[i], of->from->period),
                         near->y[i] - exact->y[i]);
        }
        else if (near->plane[i] != exact->plane[i])
        {
            off = near->plane[i] == CM_NO_FACE || exact->plane[i] == CM_NO_FACE
                      ? INFINITY
                      : to_edge(of->from, near->x[i], near->y[i]);
        }
        most = greater(most, off);
    }
    return most;
}

typedef struct tally
{
    cm_geometry_count count;
    double worst; /* in tolerances */
} tally;

static void check_pair(const pair *of, double tolerance, tally *sum)
{
    static places near, exact;
    cm_plan *plan = make_plan(of, tolerance);
    cm_geometry *geometry = cm_geometry_create(plan, 0);
    ck_assert_ptr_nonnull(geometry);
    const block_walk walk = walk_of(of->to);
    for (unsigned p = 0; p < of->to->planes; p++)
    {
        for (uint32_t b = 0; b < walk.count; b += walk.step)
        {
            const uint32_t column = b % walk.columns;
            const uint32_t row = b / walk.columns;
            const uint64_t before = cm_geometry_counted(geometry).exact;
            places_of_block(geometry, of, p, column, row, 0, &near);
            find_exactly(of, p, column, row, &exact);
            const int is_exact = cm_geometry_counted(geometry).exact != before;
            /* exact places are rounded to floats, from the block's first */
            const double allowed =
                is_exact ? 1e-9 + ldexp(of->from->width + of->from->height, -24) : tolerance;
            const double off = distance(of, &near, &exact) / allowed;
            REQUIRE(off <= 1.0, "%s: plane %u, block %u, %u%s: %g of what is allowed", of->words, p,
                    column, row, is_exact ? ", exact" : "", off);
            sum->worst = is_exact ? sum->worst : greater(sum->worst, off);
        }
    }
    const cm_geometry_count count = cm_geometry_counted(geometry);
    sum->count.exact += count.exact;
    sum->count.interpolated += count.interpolated;
    cm_geometry_destroy(geometry);
    cm_plan_destroy(plan);
}

/* A mapping of the catalogue as a surface; 0 if it is none. */
static int specification_of(size_t index, char text[120])
{
    const cm_mapping_info *info = cm_catalogue_at(index);
    snprintf(text, 120, "%s%s", info->kind == CM_KIND_CUBE ? "cube:" : "", info->identifier);
    return info->kind != CM_KIND_DISC_SQUARE;
}

static void check_both_ways(const char *specification, double tolerance, size_t turn, tally *sum)
{
    static const unsigned sizes[5][2] = {
        {16, 64}, {50, 64}, {256, 1024}, {1024, 4096}, {4096, 512}};
    for (size_t s = 0; s < 5; s++)
    {
        if ((s + turn) % step_of(5) != 0)
        {
            continue;
        }
        pair there = make_pair(specification, sizes[s][0], "equirect", sizes[s][1]);
        check_pair(&there, tolerance, sum);
        free_pair(&there);
        pair back = make_pair("equirect", sizes[s][1], specification, sizes[s][0]);
        check_pair(&back, tolerance, sum);
        free_pair(&back);
    }
}

START_TEST(test_nearness)
{
    static const double tolerances[2] = {1.0 / 256.0, 1.0 / 4096.0};
    for (int t = 0; t < 2; t++)
    {
        tally sum = {0};
        for (size_t i = 0; i < cm_catalogue_count(); i++)
        {
            char text[120];
            if (specification_of(i, text))
            {
                check_both_ways(text, tolerances[t], i, &sum);
            }
        }
        const double all = (double)(sum.count.exact + sum.count.interpolated);
        printf("tolerance 1/%.0f: %.1f %% of %.0f blocks exact, others off by %.2f of it at most\n",
               1.0 / tolerances[t], 100.0 * (double)sum.count.exact / all, all, sum.worst);
        ck_assert_uint_gt(sum.count.interpolated, sum.count.exact / 4);
    }
}
END_TEST

/* ---- parts ---- */

static int are_same(const cm_group *a, const cm_group *b)
{
    const size_t n = a->count;
    int same = a->plane == b->plane && a->count == b->count && a->column == b->column &&
               a->row == b->row && memcmp(a->x, b->x, n * sizeof *a->x) == 0 &&
               memcmp(a->y, b->y, n * sizeof *a->y) == 0 && memcmp(a->pixel, b->pixel, n) == 0;
    for (int k = 0; k < 2; k++)
    {
        same = same && memcmp(a->by_column[k], b->by_column[k], n * sizeof(float)) == 0 &&
               memcmp(a->by_row[k], b->by_row[k], n * sizeof(float)) == 0;
    }
    return same;
}

/* Blocks that are asked for alone, by a geometry that has seen nothing else or something else, have the bits of those
 * in order. */
static void check_parts(const pair *of)
{
    static cm_group alone[CM_GROUPS_MAX];
    cm_plan *plan = make_plan(of, 0.0);
    cm_geometry *whole = cm_geometry_create(plan, 1);
    cm_geometry *part = cm_geometry_create(plan, 1);
    const block_walk walk = walk_of(of->to);
    const uint32_t rows = (of->to->height + CM_BLOCK_EDGE - 1) / CM_BLOCK_EDGE;
    for (uint32_t b = 0; b < walk.columns * rows; b++)
    {
        const uint32_t column = b % walk.columns;
        const uint32_t row = b / walk.columns;
        const unsigned plane = of->to->planes - 1;
        const unsigned count = cm_geometry_block(whole, plane, column, row, groups);
        if (b % (3 * step_of(5)) != 0)
        {
            continue;
        }
        /* somewhere else first: the row above, too, and other columns */
        const uint32_t other = b * 7919u % (walk.columns * rows);
        (void)cm_geometry_block(part, 0, other % walk.columns, other / walk.columns, alone);
        if (b % 2 == 0 && row > 0)
        {
            (void)cm_geometry_block(part, plane, column, row - 1, alone);
        }
        const unsigned same = cm_geometry_block(part, plane, column, row, alone);
        REQUIRE(same == count, "%s: block %u, %u: %u and %u groups", of->words, column, row, count,
                same);
        for (unsigned g = 0; g < count; g++)
        {
            REQUIRE(are_same(&groups[g], &alone[g]), "%s: block %u, %u", of->words, column, row);
        }
    }
    cm_geometry_destroy(whole);
    cm_geometry_destroy(part);
    cm_plan_destroy(plan);
}

START_TEST(test_parts)
{
    static const char *const pairs[][2] = {
        {"equirect", "cube:coupled"},  {"cube:qsc", "equirect"},
        {"equirect", "equirect"},      {"cube:gnomonic", "cube:algebraic;frame=gl"},
        {"mercator", "cube:gnomonic"}, {"equirect;west=-20;east=70", "cube:gnomonic"}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
    {
        pair made = make_pair(pairs[i][0], 1024, pairs[i][1], 520);
        check_parts(&made);
        free_pair(&made);
        made = make_pair(pairs[i][0], 256, pairs[i][1], 144);
        check_parts(&made);
        free_pair(&made);
    }
}
END_TEST

/* ---- all of it ---- */

/* Pixels without a place are those that the source does not show, and they alone. */
START_TEST(test_completeness)
{
    static const char *const pairs[][2] = {
        {"equirect", "cube:coupled"},
        {"cube:coupled", "equirect"},
        {"cube:qsc", "cube:gnomonic"},
        {"equirect;west=-20;east=70;south=-5;north=60", "equirect"},
        {"azimuthal:lambert", "equirect"},
        {"equirect", "azimuthal:lambert"},
        {"equirect", "mercator;west=3"}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
    {
        static places near, exact;
        pair made = make_pair(pairs[i][0], 300, pairs[i][1], 333);
        cm_plan *plan = make_plan(&made, 0.0);
        cm_geometry *geometry = cm_geometry_create(plan, 0);
        const uint32_t columns = walk_of(made.to).columns;
        const uint32_t rows = (made.to->height + CM_BLOCK_EDGE - 1) / CM_BLOCK_EDGE;
        size_t placed = 0;
        for (uint32_t b = 0; b < columns * rows * made.to->planes; b++)
        {
            const unsigned plane = b / (columns * rows);
            const uint32_t row = b / columns % rows;
            places_of_block(geometry, &made, plane, b % columns, row, 0, &near);
            find_exactly(&made, plane, b % columns, row, &exact);
            for (unsigned k = 0; k < CM_BLOCK_PIXELS; k++)
            {
                placed += near.plane[k] != CM_NO_FACE;
                REQUIRE((near.plane[k] == CM_NO_FACE) == (exact.plane[k] == CM_NO_FACE),
                        "%s: block %u, %u, pixel %u", made.words, b % columns, row, k);
            }
        }
        const size_t all = (size_t)made.to->width * made.to->height * made.to->planes;
        REQUIRE(placed > all / 100 && placed <= all, "%s: %zu of %zu", made.words, placed, all);
        cm_geometry_destroy(geometry);
        cm_plan_destroy(plan);
        free_pair(&made);
    }
}
END_TEST

/* ---- derivatives ---- */

/* Exact positions of pixels a little to the right or below, on their own planes; else NaN. */
static void find_beside(const pair *of, unsigned plane, uint32_t column, uint32_t row,
                        const places *at, double right, double down, double *x, double *y)
{
    double z[CM_BLOCK_PIXELS];
    uint8_t found[CM_BLOCK_PIXELS];
    for (unsigned i = 0; i < CM_BLOCK_PIXELS; i++)
    {
        x[i] = lesser(column * CM_BLOCK_EDGE + i % CM_BLOCK_EDGE + 0.5 + right, of->to->width);
        y[i] = lesser(row * CM_BLOCK_EDGE + i / CM_BLOCK_EDGE + 0.5 + down, of->to->height);
    }
    cm_surface_own_directions(of->to, plane, CM_BLOCK_PIXELS, x, y, x, y, z);
    cm_surface_find(of->from, CM_BLOCK_PIXELS, x, y, z, found, x, y);
    for (unsigned i = 0; i < CM_BLOCK_PIXELS; i++)
    {
        x[i] = found[i] == at->plane[i] ? x[i] : (double)NAN;
    }
}

/* Central differences, where both sides agree, and those of twice the step, so that there is a derivative. */
static size_t check_slopes(const pair *of, unsigned plane, uint32_t column, uint32_t row,
                           const places *at)
{
    static double x[5][CM_BLOCK_PIXELS], y[5][CM_BLOCK_PIXELS];
    static const double steps[5] = {-1.0 / 64.0, 1.0 / 64.0, -1.0 / 32.0, 1.0 / 32.0, 0.0};
    const double period = of->from->period;
    size_t checked = 0;
    for (int by = 0; by < 2; by++)
    {
        for (int s = 0; s < 5; s++)
        {
            find_beside(of, plane, column, row, at, by ? 0.0 : steps[s], by ? steps[s] : 0.0, x[s],
                        y[s]);
        }
        for (unsigned i = 0; i < CM_BLOCK_PIXELS; i++)
        {
            const double dx = 32.0 * wrapped(x[1][i] - x[0][i], period);
            const double dy = 32.0 * (y[1][i] - y[0][i]);
            const double wide = far_by(16.0 * wrapped(x[3][i] - x[2][i], period) - dx,
                                       16.0 * (y[3][i] - y[2][i]) - dy);
            const double side = far_by(64.0 * wrapped(x[1][i] - x[4][i], period) - dx,
                                       64.0 * (y[1][i] - y[4][i]) - dy);
            const double steep = far_by(dx, dy);
            if (at->plane[i] == CM_NO_FACE || !(wide <= 1e-4 * steep && side <= 1e-3 * steep))
            {
                continue;
            }
            const double off =
                far_by(at->slope[2 * by][i] - dx, at->slope[2 * by + 1][i] - dy) / steep;
            REQUIRE(off <= 5e-3, "%s: plane %u, block %u, %u, pixel %u: %g", of->words, plane,
                    column, row, i, off);
            checked++;
        }
    }
    return checked;
}

static void check_derivatives(const pair *of, double tolerance)
{
    static places near;
    cm_plan *plan = make_plan(of, tolerance);
    cm_geometry *geometry = cm_geometry_create(plan, 1);
    const block_walk walk = walk_of(of->to);
    size_t checked = 0;
    size_t all = 0;
    for (unsigned p = 0; p < of->to->planes; p++)
    {
        for (uint32_t b = 0; b < walk.count; b += walk.step)
        {
            places_of_block(geometry, of, p, b % walk.columns, b / walk.columns, 1, &near);
            checked += check_slopes(of, p, b % walk.columns, b / walk.columns, &near);
            for (unsigned i = 0; i < CM_BLOCK_PIXELS; i++)
            {
                all += near.plane[i] != CM_NO_FACE ? 2 : 0;
            }
        }
    }
    REQUIRE(checked > all / 4, "%s: %zu of %zu derivatives", of->words, checked, all);
    cm_geometry_destroy(geometry);
    cm_plan_destroy(plan);
}

START_TEST(test_derivatives)
{
    for (size_t i = 0; i < cm_catalogue_count(); i += step_of(4))
    {
        char text[120];
        if (specification_of(i, text))
        {
            const double tolerance = i % 3 == 0 ? -1.0 : i % 3 == 1 ? 1.0 / 256.0 : 0.0;
            pair made = make_pair(text, 300, "equirect", 600);
            check_derivatives(&made, tolerance);
            free_pair(&made);
            made = make_pair("equirect", 2000, text, 300);
            check_derivatives(&made, tolerance);
            free_pair(&made);
        }
    }
}
END_TEST

/* ---- beyond the edges ---- */

#define BEYOND 400

/* Pixels beyond the edges of a plane: along its four sides, and at its corners. */
static void draw_beyond(uint32_t size, double *column, double *row)
{
    for (unsigned i = 0; i < BEYOND; i++)
    {
        const double away = 0.5 + i % 3;
        const double along = i * 7919u / 3 % size + 0.5;
        const unsigned side = i / 97;
        column[i] = side == 0 ? -away : side == 1 ? size + away : along;
        row[i] = side == 2 ? -away : side == 3 ? size + away : side == 4 ? -away : along;
        column[i] = side == 4 ? size + away : column[i];
    }
}

/* The same bits for each place alone, and in another order. */
static void check_beyond_order(const cm_surface *surface, const double *column, const double *row,
                               double axis[3][BEYOND])
{
    for (unsigned i = 0; i < BEYOND; i++)
    {
        const unsigned k = i * 7u % BEYOND;
        const double columns[2] = {column[(k + 1) % BEYOND], column[k]};
        const double rows[2] = {row[(k + 1) % BEYOND], row[k]};
        double x[2], y[2], z[2];
        cm_surface_directions_beyond(surface, 2, 2, columns, rows, x, y, z);
        REQUIRE(x[1] == axis[0][k] && y[1] == axis[1][k] && z[1] == axis[2][k], "%s: place %u",
                cm_surface_specification(surface), k);
    }
}

/* A gnomonic face goes on along its plane. */
START_TEST(test_beyond)
{
    static const char *const kinds[3] = {"cube:gnomonic", "cube:qsc", "cube:coupled"};
    static double column[BEYOND], row[BEYOND], axis[3][BEYOND];
    for (int k = 0; k < 3; k++)
    {
        const uint32_t size = 256;
        cm_surface *surface = make_surface(kinds[k], size, NULL);
        draw_beyond(size, column, row);
        cm_surface_directions_beyond(surface, 2, BEYOND, column, row, axis[0], axis[1], axis[2]);
        check_beyond_order(surface, column, row, axis);
        for (unsigned i = 0; i < BEYOND; i++)
        {
            const double length = hypot(hypot(axis[0][i], axis[1][i]), axis[2][i]);
            REQUIRE(fabs(length - 1.0) < (surface->creased ? 1e-3 : 1e-6), "%s: place %u: %g",
                    kinds[k], i, length - 1.0);
        }
        /* the plane's axes, from its centre and the middles of two edges */
        double centre[3], right[3], down[3];
        const double half = 0.5 * size;
        const double whole = size;
        const double top = 0.0;
        cm_surface_own_directions(surface, 2, 1, &half, &half, centre, centre + 1, centre + 2);
        cm_surface_own_directions(surface, 2, 1, &whole, &half, right, right + 1, right + 2);
        cm_surface_own_directions(surface, 2, 1, &half, &top, down, down + 1, down + 2);
        for (unsigned i = 0; k == 0 && i < BEYOND; i++)
        {
            double along[3] = {0.0, 0.0, 0.0};
            for (int a = 0; a < 3; a++)
            {
                along[0] += centre[a] * axis[a][i];
                along[1] += (right[a] * sqrt(2.0) - centre[a]) * axis[a][i];
                along[2] += (centre[a] - down[a] * sqrt(2.0)) * axis[a][i];
            }
            const double x = half + half * along[1] / along[0];
            const double y = half + half * along[2] / along[0];
            REQUIRE(hypot(x - column[i], y - row[i]) < 1e-7, "place %u: %g, %g for %g, %g", i, x, y,
                    column[i], row[i]);
        }
        cm_surface_destroy(surface);
    }
}
END_TEST

/* Pixels of a run, so many beyond the last, by every set, against those that are asked one by one. */
static void check_edge_pixels(const cm_surface *surface, const cm_edge_run *run, int32_t away,
                              double *const other[3], const char *where)
{
    double own[3][CM_EDGE_RUN];
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        const char *name = cm_instructions_at(s);
        if (cm_instructions_check(name, NULL, 0) != CM_OK)
        {
            continue;
        }
        cm_surface_edge_directions(run, cm_filter_set_find(name), away, own[0], own[1], own[2]);
        for (int axis = 0; axis < 3; axis++)
        {
            REQUIRE(memcmp(own[axis], other[axis], run->count * sizeof(double)) == 0,
                    "%s, %s, %s: %d away", cm_surface_specification(surface), name, where,
                    (int)away);
        }
    }
}

/* A run along an edge. */
static void check_edge_run(const cm_surface *surface, unsigned plane, cm_edge edge, int32_t begin,
                           size_t count, unsigned *runs)
{
    static cm_edge_run run;
    const int is_row = edge == CM_EDGE_UPPER || edge == CM_EDGE_LOWER;
    const double last = is_row ? surface->height : surface->width;
    if (!cm_surface_edge_nodes(surface, plane, edge, begin, count, &run))
    {
        return;
    }
    ++*runs;
    for (int32_t away = 0; away < 21; away++)
    {
        double column[CM_EDGE_RUN], row[CM_EDGE_RUN], x[CM_EDGE_RUN], y[CM_EDGE_RUN],
            z[CM_EDGE_RUN];
        double *const other[3] = {x, y, z};
        char where[64];
        const double across =
            edge == CM_EDGE_LEFT || edge == CM_EDGE_UPPER ? -0.5 - away : last + away + 0.5;
        for (size_t i = 0; i < count; i++)
        {
            const double along = begin + (double)i + 0.5;
            column[i] = is_row ? along : across;
            row[i] = is_row ? across : along;
        }
        cm_surface_directions_beyond(surface, plane, count, column, row, x, y, z);
        snprintf(where, sizeof where, "plane %u, edge %d, from %d on", plane, (int)edge,
                 (int)begin);
        check_edge_pixels(surface, &run, away, other, where);
    }
}

/* Pixels along an edge have the same bits together as one by one, beside corners and creases, too. */
START_TEST(test_edge_runs)
{
    static const char *const kinds[] = {
        "cube:gnomonic", "cube:qsc",   "cube:coupled", "cube:slice",    "equirect", "dual-fisheye",
        "octahedral",    "healpix:64", "quincuncial",  "cube:seamless", "rhealpix"};
    static const uint32_t sizes[] = {7, 8, 9, 16, 150};
    unsigned runs = 0;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
    {
        for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++)
        {
            cm_surface *surface = NULL;
            const cm_surface_options options = {.size = sizeof options, .width = sizes[s]};
            if (cm_surface_create(kinds[k], &options, &surface) != CM_OK)
            {
                continue;
            }
            const int32_t least =
                (int32_t)(surface->width < surface->height ? surface->width : surface->height);
            for (unsigned task = 0; task < 4 * surface->planes; task++)
            {
                for (int32_t begin = 0; begin < least; begin += 7)
                {
                    const int32_t left = least - begin;
                    check_edge_run(surface, task / 4, (cm_edge)(task % 4), begin,
                                   (size_t)(left < CM_EDGE_RUN ? left : CM_EDGE_RUN), &runs);
                    check_edge_run(surface, task / 4, (cm_edge)(task % 4), begin, 1, &runs);
                }
            }
            cm_surface_destroy(surface);
        }
    }
    REQUIRE(runs > 1000, "%u runs", runs);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        test_nearness,  test_parts, test_completeness, test_derivatives, test_beyond,
        test_edge_runs, NULL};
    return run_suite("geometry", tests);
}
