/* SPDX-License-Identifier: MIT
 *
 * The areas of cells on the ellipsoid, against a line integral along their edges: with the area Q(phi) between the
 * equator and a parallel, for each radian of longitude,
 *     Q = b^2 / 2 (s / (1 - e^2 s^2) + atanh(e s) / e),  s = sin phi,
 * a cell's area is the integral of Q d lon around it, or of Q - Q(pole) if the pole is in it. Neither latitudes
 * of the library nor its area element have a part in that, but normals along the edges and the longitude's
 * derivative from the mapping's. In long double; what the normals' own rounding makes of it is some 1e-16 over
 * the cell's size.
 */
#include "cell_suite.h"

#define PI_L 3.14159265358979323846264338327950288L
#define NODES 12
#define PIECES 10

static long double node[NODES], weight[NODES];

/* Gauss and Legendre's rule on [0, 1], by Newton's method. */
static void make_rule(void)
{
    for (int k = 0; k < NODES; k++)
    {
        long double x = cosl(PI_L * (k + 0.75L) / (NODES + 0.5L));
        long double slope = 0.0L;
        for (int step = 0; step < 60; step++)
        {
            long double before = 1.0L, at = x;
            for (int n = 2; n <= NODES; n++)
            {
                long double next = ((2 * n - 1) * x * at - (n - 1) * before) / n;
                before = at;
                at = next;
            }
            slope = NODES * (x * at - before) / (x * x - 1.0L);
            x -= at / slope;
        }
        node[k] = 0.5L + 0.5L * x;
        weight[k] = 1.0L / ((1.0L - x * x) * slope * slope);
    }
}

/* Q, of the sine of geographic latitude, and of a whole ellipsoid 4 pi Q(1). */
static long double zone(const cm_ellipsoid *ellipsoid, long double s)
{
    long double a = ellipsoid->a;
    long double b = a * (1.0L - ellipsoid->f);
    long double square = ellipsoid->f * (2.0L - ellipsoid->f);
    long double e = sqrtl(fabsl(square));
    long double arc = e == 0.0L ? s : square > 0.0L ? atanhl(e * s) / e : atanl(e * s) / e;
    return b * b / 2.0L * (s / (1.0L - square * s * s) + arc);
}

/* Is the pole of that sign in the cell? -1: on its border, where the longitude has no derivative. */
static int has_pole(const subject *made, cm_cell cell, double sign)
{
    const double pole[3] = {0.0, 0.0, sign};
    uint8_t face;
    double low[2], high[2], uv[2];
    cm_cell_square(cm_cell_grid_curve(made->cells), cell, &face, low, high);
    if (cm_grid_forward(made->grid, pole, uv) != face || uv[0] < low[0] - 1e-9 ||
        uv[0] > high[0] + 1e-9 || uv[1] < low[1] - 1e-9 || uv[1] > high[1] + 1e-9)
    {
        return 0;
    }
    return uv[0] > low[0] + 1e-9 && uv[0] < high[0] - 1e-9 && uv[1] > low[1] + 1e-9 &&
                   uv[1] < high[1] - 1e-9
               ? 1
               : -1;
}

/* The integral along half a side, from its corner. In a corner of the cube conformal maps go with powers of the
 * cube root of what is left, so that is what is divided. */
static long double along_half(const subject *made, uint8_t face, const double from[2],
                              const double to[2], long double base)
{
    const cm_mapping *mapping = cm_grid_mapping(made->grid);
    long double sum = 0.0L;
    for (int k = 0; k < NODES * PIECES; k++)
    {
        long double root = (k / NODES + node[k % NODES]) / PIECES;
        double t = (double)(root * root * root);
        const double uv[2] = {from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])};
        double normal[3], direction[3], j[6];
        double tangent[3];
        cm_grid_inverse(made->grid, face, uv, normal);
        cm_inverse(mapping, face, uv, direction);
        cm_inverse_jacobian(mapping, face, uv, j);
        for (int i = 0; i < 3; i++)
        {
            tangent[i] = j[2 * i] * (to[0] - from[0]) + j[2 * i + 1] * (to[1] - from[1]);
        }
        /* the longitude is the same on the mapping's sphere */
        cm_rotate_back(cm_grid_rotation(made->grid), direction, direction);
        cm_rotate_back(cm_grid_rotation(made->grid), tangent, tangent);
        long double x = direction[0], y = direction[1];
        long double turn = (x * tangent[1] - y * tangent[0]) / (x * x + y * y);
        long double length =
            sqrtl((long double)normal[0] * normal[0] + (long double)normal[1] * normal[1] +
                  (long double)normal[2] * normal[2]);
        sum += 3.0L * root * root * weight[k % NODES] / PIECES * turn *
               (zone(cm_grid_ellipsoid(made->grid), normal[2] / length) - base);
    }
    return sum;
}

/* NaN where a pole is on the border. */
static long double area_by_sides(const subject *made, cm_cell cell)
{
    uint8_t face;
    double low[2], high[2];
    int north = has_pole(made, cell, 1.0);
    int south = has_pole(made, cell, -1.0);
    long double sum = 0.0L;
    long double base = 0.0L;
    if (north < 0 || south < 0)
    {
        return (long double)NAN;
    }
    if (north > 0 || south > 0)
    {
        base = zone(cm_grid_ellipsoid(made->grid), north > 0 ? 1.0L : -1.0L);
    }
    cm_cell_square(cm_cell_grid_curve(made->cells), cell, &face, low, high);
    const double corner[5][2] = {{low[0], low[1]},
                                 {high[0], low[1]},
                                 {high[0], high[1]},
                                 {low[0], high[1]},
                                 {low[0], low[1]}};
    for (int k = 0; k < 4; k++)
    {
        /* maps have creases in the middle of a face's edges */
        const double middle[2] = {0.5 * (corner[k][0] + corner[k + 1][0]),
                                  0.5 * (corner[k][1] + corner[k + 1][1])};
        sum += along_half(made, face, corner[k], middle, base);
        sum -= along_half(made, face, corner[k + 1], middle, base);
    }
    /* anticlockwise is the negative of Q d lon */
    return fabsl(sum);
}

static double worst;

static void compare(const subject *made, cm_cell cell, double bound)
{
    long double expected = area_by_sides(made, cell);
    double area = cm_cell_area(made->cells, cell);
    if (!isnan(expected))
    {
        double apart = (double)fabsl(area / expected - 1.0L);
        worst = fmax(worst, apart);
        REQUIRE(apart <= bound, "%s, %s: %llx has %.17g, by its sides %.17Lg: %g", mapping_of(made),
                cm_latitude_name(cm_grid_latitude(made->grid)), (unsigned long long)cell, area,
                expected, apart);
    }
    REQUIRE(area > 0.0, "%llx has %g", (unsigned long long)cell, area);
}

static cm_ellipsoid ellipsoid_of(const char *text)
{
    cm_ellipsoid ellipsoid;
    ck_assert_int_eq(cm_ellipsoid_parse(text, &ellipsoid, NULL, 0), CM_OK);
    return ellipsoid;
}

/* With an equal-area mapping and authalic latitude all cells of a level are equal in area on WGS84. */
START_TEST(equal_area_on_the_ellipsoid)
{
    static const char *const ellipsoids[] = {"WGS84", "6378137,50", "6378137,-50"};
    uint64_t state = 59;
    worst = 0.0;
    int count = 0;
    for (size_t m = 0; m < cube_count(); m++)
    {
        for (size_t e = 0; e < 3; e++)
        {
            cm_ellipsoid ellipsoid = ellipsoid_of(ellipsoids[e]);
            const cm_grid_options options = {.size = sizeof options,
                                             .mapping = cm_catalogue_at(m)->identifier,
                                             .frame = cm_frame_at(m % cm_frame_count()),
                                             .ellipsoid = &ellipsoid};
            if (!(cm_catalogue_at(m)->properties & CM_EQUAL_AREA))
            {
                continue;
            }
            subject made = make_subject(&options, CM_CURVE_HILBERT);
            ck_assert_int_eq(cm_grid_latitude(made.grid), CM_LATITUDE_AUTHALIC);
            for (int n = 0; n < 6 + 24 + 60; n += (int)step_of(7))
            {
                int level = n < 6 ? 0 : n < 30 ? 1 : 2 + n % 4;
                cm_cell cell = n < 6    ? cm_cell_at_index(0, (uint64_t)n)
                               : n < 30 ? cm_cell_at_index(1, (uint64_t)n - 6)
                                        : random_cell(&state, level);
                double share = (double)(4.0L * PI_L * zone(&ellipsoid, 1.0L) /
                                        (long double)(6ull << (2 * level)));
                compare(&made, cell, 1e-12);
                REQUIRE(fabs(cm_cell_area(made.cells, cell) / share - 1.0) <= 2e-15, "%s",
                        mapping_of(&made));
            }
            drop_subject(&made);
            count++;
        }
    }
    printf("equal-area mappings: %d grids, cells within %.3g of their share by their sides\n",
           count, worst);
    ck_assert_int_ge(count, 3 * 5);
}
END_TEST

/* Two with singularities, whose cells take 20 to 50 ms. */
static int is_slow(const char *mapping)
{
    return strcmp(mapping, "difference") == 0 || strcmp(mapping, "conformal") == 0;
}

/* All others, of any latitude, ellipsoid and rotation. */
START_TEST(areas_by_sides)
{
    uint64_t state = 61;
    cm_rotation rotation;
    ck_assert_int_eq(cm_rotation_from_angles(17.0, -10.0, 32.0, &rotation), CM_OK);
    static const char *const ellipsoids[] = {"WGS84",  "6378137,50", "6378137,-50",
                                             "1000,0", "1000,1.25",  "10,-2"};
    worst = 0.0;
    for (size_t m = 0; m < cube_count(); m += step_of(5))
    {
        for (int l = 0; l < CM_LATITUDE_COUNT; l++)
        {
            cm_latitude latitude = (cm_latitude)l;
            cm_ellipsoid ellipsoid = ellipsoid_of(ellipsoids[(m + (size_t)l) % 6]);
            const char *name = cm_catalogue_at(m)->identifier;
            const cm_grid_options options = {.size = sizeof options,
                                             .mapping = name,
                                             .frame = cm_frame_at(m % cm_frame_count()),
                                             .ellipsoid = &ellipsoid,
                                             .latitude = &latitude,
                                             .rotation = l % 2 == 1 ? &rotation : NULL};
            if (is_slow(name) && l % 3 != 0)
            {
                continue;
            }
            subject made = make_subject(&options, CM_CURVE_MORTON);
            for (int n = 0; n < 5; n++)
            {
                /* the middle of a face, its corners, its diagonals, and others; whole faces cost most */
                int level = n == 0 && m % CM_LATITUDE_COUNT != (size_t)l ? 2 : n;
                uint32_t side = 1u << level;
                cm_cell_place place = {(uint8_t)(next_bits(&state) % 6), (uint8_t)level,
                                       (uint32_t)next_bits(&state) % side, 0};
                place.j = n % 2 == 0   ? place.i
                          : n % 3 == 0 ? side - 1 - place.i
                                       : (uint32_t)next_bits(&state) % side;
                cm_cell cell = cm_cell_from_place(CM_CURVE_MORTON, &place);
                /* on the flattest ellipsoids the sides' rounding is more, by what latitudes are drawn out */
                compare(&made, cell, fabs(ellipsoid.f) > 0.1 ? 5e-12 : 1e-12);
            }
            drop_subject(&made);
        }
    }
    printf("all mappings and latitudes: areas within %.3g of those by sides\n", worst);
}
END_TEST

/* The faces are the ellipsoid, and quarters their cell, down to the last level. */
START_TEST(sums)
{
    uint64_t state = 67;
    double whole_apart = 0.0;
    double part_apart = 0.0;
    for (size_t m = 0; m < cube_count(); m += step_of(4))
    {
        subject made = make_turn(m);
        double sum = 0.0;
        for (uint64_t k = 0; k < 6; k++)
        {
            sum += cm_cell_area(made.cells, cm_cell_at_index(0, k));
        }
        double whole = cm_ellipsoid_area(cm_grid_ellipsoid(made.grid));
        whole_apart = fmax(whole_apart, fabs(sum / whole - 1.0));
        REQUIRE(fabs(sum / whole - 1.0) <= 1e-12, "%s: faces are %.17g, all is %.17g",
                mapping_of(&made), sum, whole);
        sum = 0.0;
        for (uint64_t k = 0; k < 6 * 16 && m % 4 == 0; k++)
        {
            sum += cm_cell_area(made.cells, cm_cell_at_index(2, k));
        }
        REQUIRE(m % 4 != 0 || fabs(sum / whole - 1.0) <= 1e-12,
                "%s: cells of level 2 are %.17g, all is %.17g", mapping_of(&made), sum, whole);
        for (int n = 0; n < 30; n += is_slow(mapping_of(&made)) ? 7 : 1)
        {
            cm_cell cell = random_cell(&state, n);
            double parts = 0.0;
            for (int k = 0; k < 4; k++)
            {
                parts += cm_cell_area(made.cells, cm_cell_child(cell, k));
            }
            double area = cm_cell_area(made.cells, cell);
            part_apart = fmax(part_apart, fabs(parts / area - 1.0));
            REQUIRE(fabs(parts / area - 1.0) <= 1e-12, "%s: %llx is %.17g, its quarters %.17g",
                    mapping_of(&made), (unsigned long long)cell, area, parts);
        }
        drop_subject(&made);
    }
    printf("sums of faces: %.3g, of quarters %.3g\n", whole_apart, part_apart);
}
END_TEST

/* Beside a corner where the map is singular the rounding of u and v says how well an area can be known; dividing on and
 * on against that took minutes for a cell. */
START_TEST(corners_of_faces)
{
    const cm_grid_options options = {.size = sizeof options, .mapping = "conformal"};
    cm_grid *grid = NULL;
    cm_cell_grid *cells = NULL;
    ck_assert_int_eq(cm_grid_create(&options, &grid), CM_OK);
    ck_assert_int_eq(cm_cell_grid_create(grid, CM_CURVE_MORTON, &cells), CM_OK);
    for (int level = 11; level < 30; level += 3)
    {
        for (uint32_t away = 0; away < 601; away += 300)
        {
            uint32_t last = ((uint32_t)1 << level) - 1;
            const cm_cell_place place = {2, (uint8_t)level, away, last - away / 2};
            cm_cell cell = cm_cell_from_place(CM_CURVE_MORTON, &place);
            double distance = ldexp(1.0 + away / 2, 1 - level);
            double parts = 0.0;
            for (int k = 0; k < 4; k++)
            {
                parts += cm_cell_area(cells, cm_cell_child(cell, k));
            }
            double area = cm_cell_area(cells, cell);
            REQUIRE(fabs(parts / area - 1.0) <= 1e-12 + 0x1p-49 / distance,
                    "level %d, %u cells from the corner: %.17g, its quarters %.17g", level, away,
                    area, parts);
        }
    }
    cm_cell_grid_destroy(cells);
    cm_grid_destroy(grid);
}
END_TEST

int main(void)
{
    const TTest *tests[] = {equal_area_on_the_ellipsoid, areas_by_sides, sums, corners_of_faces,
                            NULL};
    make_rule();
    return run_suite("cell area", tests);
}
