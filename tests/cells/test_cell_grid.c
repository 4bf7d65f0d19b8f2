/* SPDX-License-Identifier: MIT
 *
 * Cells on the Earth: points to cells at hard points and in arrays, centres and corners, bounding caps,
 * neighbours across edges and corners of faces.
 */
#include "cell_suite.h"

#include "truth/hard_points.h"

/* ---- Points ---- */

/* Column or row by the definition: floor is exact, and so is the product by a power of two. */
static uint32_t part_of(double w, int level)
{
    double half = ldexp(1.0, level) / 2.0;
    double whole = floor(w * half) + half;
    return (uint32_t)(whole >= 2.0 * half ? 2.0 * half - 1.0 : whole);
}

static void check_point(const subject *made, const double normal[3])
{
    double uv[2];
    uint8_t face = cm_grid_forward(made->grid, normal, uv);
    cm_cell leaf = cm_cell_forward(made->cells, CM_CELL_LEVEL_MAX, normal);
    if (face > 5)
    {
        REQUIRE(leaf == CM_NO_CELL, "%a %a %a has a cell", normal[0], normal[1], normal[2]);
        return;
    }
    for (int level = 0; level <= CM_CELL_LEVEL_MAX; level++)
    {
        cm_cell cell = cm_cell_forward(made->cells, level, normal);
        cm_cell_place place;
        REQUIRE(cell == cm_cell_parent(leaf, level), "%s: level %d of %a %a %a", mapping_of(made),
                level, normal[0], normal[1], normal[2]);
        REQUIRE(cm_cell_to_place(cm_cell_grid_curve(made->cells), cell, &place) == CM_OK &&
                    place.face == face && place.i == part_of(uv[0], level) &&
                    place.j == part_of(uv[1], level) && place.level == level,
                "%s: %a %a is not in %u %u of level %d", mapping_of(made), uv[0], uv[1], place.i,
                place.j, level);
    }
}

START_TEST(hard_points_have_their_cells)
{
    for (size_t m = 0; m < cube_count(); m++)
    {
        subject made = make_turn(m);
        for (uint64_t n = m; n < HARD_DIRECTIONS; n += 997)
        {
            double normal[3];
            hard_direction(n, normal);
            check_point(&made, normal);
        }
        drop_subject(&made);
    }
}
END_TEST

/* Both sides of each edge of a cell, by an ulp of u: what is below it is in the one before. */
START_TEST(ties_on_a_face)
{
    static const double edges[] = {0.0,     -0.0,    0x1p-1074, -0x1p-1074, 1e-300,
                                   -1e-300, 0x1p-60, -0x1p-60,  1.0,        -1.0,
                                   0.5,     -0.5,    0x1p-29,   -0x1p-29,   0.75};
    const cm_grid_options options = {
        .size = sizeof options,
        .mapping = "gnomonic",
        .ellipsoid = &(cm_ellipsoid){sizeof(cm_ellipsoid), "", "", "", 1.0, 0.0}};
    subject made = make_subject(&options, CM_CURVE_MORTON);
    for (size_t a = 0; a < 3 * sizeof edges / sizeof edges[0]; a++)
    {
        double w = edges[a / 3];
        w = a % 3 == 0 ? w : nextafter(w, a % 3 == 1 ? 2.0 : -2.0);
        for (int turn = 0; turn < 2 && fabs(w) <= 1.0; turn++)
        {
            const double normal[3] = {1.0, turn == 0 ? w : 0.25, turn == 0 ? 0.25 : w};
            check_point(&made, normal);
        }
    }
    /* no rounding on the way: the least number below 0 is in the lower half */
    cm_cell_place place;
    cm_cell_to_place(CM_CURVE_MORTON,
                     cm_cell_forward(made.cells, 30, (const double[3]){1.0, -1e-300, 0.0}), &place);
    ck_assert(place.i == (1u << 29) - 1 && place.j == 1u << 29);
    drop_subject(&made);
}
END_TEST

/* Arrays are what single points are, to the bit, in every length and from any place. */
START_TEST(arrays)
{
    enum
    {
        MOST = 700
    };
    static double x[MOST + 8], y[MOST + 8], z[MOST + 8], lon[MOST + 8], lat[MOST + 8];
    static cm_cell cell[MOST + 8];
    uint64_t state = 3;
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        const cm_options how = {.size = sizeof how, .instructions = cm_instructions_at(s)};
        const cm_grid_options options = {.size = sizeof options,
                                         .mapping = "slice",
                                         .frame = cm_frame_find("gl"),
                                         .options = &how};
        subject made = make_subject(&options, s % 2 == 0 ? CM_CURVE_HILBERT : CM_CURVE_MORTON);
        for (size_t n = 0; n < MOST; n += n < 40 ? 1 : 97)
        {
            size_t offset = n % 7;
            int level = (int)(next_bits(&state) % 31);
            double *const at[3] = {x + offset, y + offset, z + offset};
            for (size_t i = 0; i < n; i++)
            {
                double normal[3];
                hard_direction(next_bits(&state), normal);
                for (int k = 0; k < 3; k++)
                {
                    at[k][i] = normal[k];
                }
                lon[offset + i] = 4.0 * next_real(&state);
                lat[offset + i] = 1.5707963267948966 * next_real(&state);
            }
            cell[offset + n] = 77;
            cm_cell_forward_array(made.cells, level, n, at[0], at[1], at[2], cell + offset);
            REQUIRE(cell[offset + n] == 77, "written beyond %zu", n);
            for (size_t i = 0; i < n; i++)
            {
                const double normal[3] = {at[0][i], at[1][i], at[2][i]};
                REQUIRE(cell[offset + i] == cm_cell_forward(made.cells, level, normal),
                        "%s: %zu of %zu", how.instructions, i, n);
            }
            cm_cell_centre_array(made.cells, n, cell + offset, at[0], at[1], at[2]);
            for (size_t i = 0; i < n; i++)
            {
                double centre[3];
                const double got[3] = {at[0][i], at[1][i], at[2][i]};
                cm_cell_centre(made.cells, cell[offset + i], centre);
                REQUIRE(memcmp(got, centre, sizeof got) == 0 ||
                            (isnan(got[0]) && isnan(centre[0]) && isnan(got[2])),
                        "%s: centre %zu of %zu", how.instructions, i, n);
                REQUIRE((cell[offset + i] == CM_NO_CELL) == (isnan(got[0]) != 0), "%zu of %zu", i,
                        n);
            }
            cm_cell_forward_lonlat_array(made.cells, level, n, lon + offset, lat + offset,
                                         cell + offset);
            for (size_t i = 0; i < n; i++)
            {
                REQUIRE(cell[offset + i] == cm_cell_forward_lonlat(made.cells, level,
                                                                   lon[offset + i],
                                                                   lat[offset + i]),
                        "%s: lon lat %zu of %zu", how.instructions, i, n);
            }
            cm_cell_centre_lonlat_array(made.cells, n, cell + offset, lon + offset, lat + offset);
            for (size_t i = 0; i < n; i++)
            {
                double lonlat[2];
                cm_cell_centre_lonlat(made.cells, cell[offset + i], lonlat);
                REQUIRE(lonlat[0] == lon[offset + i] && lonlat[1] == lat[offset + i] &&
                            cm_cell_forward_lonlat(made.cells, level, lonlat[0], lonlat[1]) ==
                                cell[offset + i],
                        "%s: centre in lon lat %zu of %zu", how.instructions, i, n);
            }
        }
        drop_subject(&made);
    }
}
END_TEST

START_TEST(what_is_no_point_or_level)
{
    const cm_grid_options options = {.size = sizeof options};
    subject made = make_subject(&options, CM_CURVE_HILBERT);
    static const double bad[][3] = {
        {0.0, 0.0, 0.0}, {NAN, 1.0, 1.0}, {1.0, INFINITY, 1.0}, {1.0, 1.0, -INFINITY}};
    for (size_t k = 0; k < 4; k++)
    {
        ck_assert(cm_cell_forward(made.cells, 5, bad[k]) == CM_NO_CELL);
    }
    const double good[3] = {1.0, 2.0, 3.0};
    static const int levels[] = {-1, 31, 255, INT32_MIN, INT32_MAX};
    for (size_t k = 0; k < 5; k++)
    {
        cm_cell two[2] = {7, 7};
        ck_assert(cm_cell_forward(made.cells, levels[k], good) == CM_NO_CELL);
        ck_assert(cm_cell_forward_lonlat(made.cells, levels[k], 0.0, 0.0) == CM_NO_CELL);
        cm_cell_forward_array(made.cells, levels[k], 1, &good[0], &good[1], &good[2], two);
        ck_assert(two[0] == CM_NO_CELL && two[1] == 7);
        two[0] = 7;
        cm_cell_forward_lonlat_array(made.cells, levels[k], 1, &good[0], &good[0], two);
        ck_assert(two[0] == CM_NO_CELL && two[1] == 7);
    }
    ck_assert(cm_cell_forward_lonlat(made.cells, 5, 0.0, 2.0) == CM_NO_CELL);
    ck_assert(cm_cell_forward_lonlat(made.cells, 5, NAN, 0.0) == CM_NO_CELL);
    cm_cell_forward_array(made.cells, 5, 0, NULL, NULL, NULL, NULL);
    cm_cell_forward_lonlat_array(made.cells, 5, 0, NULL, NULL, NULL);
    cm_cell_centre_array(made.cells, 0, NULL, NULL, NULL, NULL);
    cm_cell_centre_lonlat_array(made.cells, 0, NULL, NULL, NULL);
    static const cm_cell none[] = {0, 2, UINT64_MAX, 0xd000000000000000ull};
    for (size_t k = 0; k < 4; k++)
    {
        double corners[4][3], lonlats[4][2], lonlat[2], normal[3], radius;
        cm_cell to[8] = {7, 7, 7, 7, 7, 7, 7, 7};
        size_t count = 99;
        cm_cell_corners(made.cells, none[k], corners);
        cm_cell_corners_lonlat(made.cells, none[k], lonlats);
        cm_cell_centre_lonlat(made.cells, none[k], lonlat);
        cm_cell_bounding_cap(made.cells, none[k], normal, &radius);
        ck_assert(isnan(corners[0][0]) && isnan(corners[3][2]) && isnan(lonlats[2][1]) &&
                  isnan(lonlat[0]) && isnan(normal[1]) && isnan(radius));
        ck_assert(isnan(cm_cell_area(made.cells, none[k])));
        ck_assert_int_eq(cm_cell_edge_neighbours(made.cells, none[k], to), 0);
        ck_assert_int_eq(cm_cell_neighbours(made.cells, none[k], to), 0);
        ck_assert_int_eq(cm_cell_neighbours_at(made.cells, none[k], 9, 8, to, &count),
                         CM_ERROR_CELL);
        ck_assert(count == 99 && to[0] == 7 && to[7] == 7);
    }
    drop_subject(&made);
}
END_TEST

START_TEST(what_is_no_grid)
{
    cm_grid *grid = NULL;
    cm_cell_grid *cells = NULL;
    const cm_grid_options one_face = {.size = sizeof one_face, .mapping = "octahedral"};
    ck_assert_int_eq(cm_grid_create(NULL, &grid), CM_OK);
    ck_assert_int_eq(cm_cell_grid_create(NULL, CM_CURVE_HILBERT, &cells), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_cell_grid_create(grid, (cm_curve)2, &cells), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_cell_grid_create(grid, CM_CURVE_HILBERT, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_cell_grid_create(grid, CM_CURVE_MORTON, &cells), CM_OK);
    ck_assert_ptr_eq(cm_cell_grid_of(cells), grid);
    ck_assert_int_eq(cm_cell_grid_curve(cells), CM_CURVE_MORTON);
    cm_cell_grid_destroy(cells);
    cm_grid_destroy(grid);
    cells = NULL;
    ck_assert_int_eq(cm_grid_create(&one_face, &grid), CM_OK);
    ck_assert_int_eq(cm_cell_grid_create(grid, CM_CURVE_HILBERT, &cells), CM_ERROR_UNSUPPORTED);
    ck_assert_ptr_null(cells);
    cm_grid_destroy(grid);
    cm_cell_grid_destroy(NULL);
}
END_TEST

/* ---- Where cells are ---- */

START_TEST(centres_come_back)
{
    uint64_t state = 29;
    for (size_t m = 0; m < cube_count(); m++)
    {
        subject made = make_turn(m);
        for (int n = 0; n < 3000; n++)
        {
            int level = n % 31;
            cm_cell cell = random_cell(&state, level);
            double normal[3];
            double lonlat[2];
            cm_cell_centre(made.cells, cell, normal);
            cm_cell_centre_lonlat(made.cells, cell, lonlat);
            REQUIRE(cm_cell_forward(made.cells, level, normal) == cell &&
                        cm_cell_forward_lonlat(made.cells, level, lonlat[0], lonlat[1]) == cell,
                    "%s: %llx", mapping_of(&made), (unsigned long long)cell);
            REQUIRE(fabs(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2] -
                         1.0) < 1e-15,
                    "%s: %llx", mapping_of(&made), (unsigned long long)cell);
        }
        drop_subject(&made);
    }
}
END_TEST

/* The corners are those of the square, and the same in both forms. */
START_TEST(corners_of_squares)
{
    uint64_t state = 31;
    for (size_t m = 0; m < cube_count(); m++)
    {
        subject made = make_turn(m);
        for (int n = 0; n < 500; n++)
        {
            cm_cell cell = random_cell(&state, n % 31);
            uint8_t face;
            double low[2], high[2], corners[4][3], lonlats[4][2];
            cm_cell_square(cm_cell_grid_curve(made.cells), cell, &face, low, high);
            cm_cell_corners(made.cells, cell, corners);
            cm_cell_corners_lonlat(made.cells, cell, lonlats);
            for (int k = 0; k < 4; k++)
            {
                const double uv[2] = {k == 1 || k == 2 ? high[0] : low[0],
                                      k >= 2 ? high[1] : low[1]};
                double normal[3], lonlat[2];
                cm_grid_inverse(made.grid, face, uv, normal);
                cm_grid_inverse_lonlat(made.grid, face, uv, lonlat);
                REQUIRE(memcmp(normal, corners[k], sizeof normal) == 0 &&
                            memcmp(lonlat, lonlats[k], sizeof lonlat) == 0,
                        "%s: corner %d of %llx", mapping_of(&made), k, (unsigned long long)cell);
            }
        }
        drop_subject(&made);
    }
}
END_TEST

/* No point of a cell is outside its cap: many points along its edges, and in it. */
START_TEST(bounding_caps)
{
    uint64_t state = 37;
    double closest = 0.0; /* to the radius, of the points */
    for (size_t m = 0; m < cube_count(); m++)
    {
        subject made = make_turn(m);
        for (int n = 0; n < 2500; n++)
        {
            int level = n < 1500 ? n % 9 : n % 31;
            uint64_t middle = (2ull << (2 * level)) / 3 + next_bits(&state) % 3;
            /* random cells, and those about the middle and the corners of a face, where maps have creases */
            cm_cell_place place = {(uint8_t)(n % 6), (uint8_t)level,
                                   n % 5 == 0 ? ((1u << level) - 1) / 2 : 0,
                                   n % 5 == 0 ? (1u << level) / 2 : 0};
            cm_cell cell = n % 5 < 2    ? cm_cell_from_place(cm_cell_grid_curve(made.cells), &place)
                           : n % 5 == 2 ? cm_cell_at_index(level, middle % (6ull << (2 * level)))
                                        : random_cell(&state, level);
            uint8_t face;
            double low[2], high[2], normal[3], radius;
            cm_cell_square(cm_cell_grid_curve(made.cells), cell, &face, low, high);
            cm_cell_bounding_cap(made.cells, cell, normal, &radius);
            for (int k = 0; k < 64; k++)
            {
                double s = k % 3 == 0 ? (k & 1) : 0.5 + 0.5 * next_real(&state);
                double t = k % 3 == 1 ? (k & 1) : 0.5 + 0.5 * next_real(&state);
                const double uv[2] = {low[0] + s * (high[0] - low[0]),
                                      low[1] + t * (high[1] - low[1])};
                double at[3];
                cm_grid_inverse(made.grid, face, uv, at);
                double angle = angle_between(at, normal);
                closest = fmax(closest, angle / radius);
                REQUIRE(angle <= radius, "%s, level %d: %llx at %g %g: %.17g beyond %.17g",
                        mapping_of(&made), level, (unsigned long long)cell, s, t, angle, radius);
            }
        }
        drop_subject(&made);
    }
    printf("bounding caps: a point at %.6f of the radius\n", closest);
}
END_TEST

/* ---- Neighbours ---- */

static int is_torn(const subject *made)
{
    return cm_mapping_describe(cm_grid_mapping(made->grid))->smooth_edge == CM_SMOOTH_TORN;
}

/* How many corners do two cells share? */
static int shared_corners(const subject *made, cm_cell a, cm_cell b)
{
    double of_a[4][3], of_b[4][3];
    int shared = 0;
    double apart = 4e-15;
    cm_cell_corners(made->cells, a, of_a);
    cm_cell_corners(made->cells, b, of_b);
    for (int k = 0; k < 16; k++)
    {
        shared += angle_between(of_a[k / 4], of_b[k % 4]) <= apart;
    }
    return shared;
}

static int has(const cm_cell *cells, size_t count, cm_cell cell)
{
    for (size_t i = 0; i < count; i++)
    {
        if (cells[i] == cell)
        {
            return 1;
        }
    }
    return 0;
}

/* Neighbours touch, know each other, and none is there twice; those over edges share two corners. */
static void check_neighbours(const subject *made, cm_cell cell, int by_corners)
{
    cm_cell edge[4], all[8];
    ck_assert_int_eq(cm_cell_edge_neighbours(made->cells, cell, edge), 4);
    int count = cm_cell_neighbours(made->cells, cell, all);
    int level = cm_cell_level(cell);
    REQUIRE(count >= (level == 0 ? 4 : 7) && count <= 8, "%d neighbours", count);
    for (int k = 0; k < count; k++)
    {
        cm_cell theirs[8];
        int is_over_edge = has(edge, 4, all[k]);
        int count_theirs = cm_cell_neighbours(made->cells, all[k], theirs);
        REQUIRE(cm_cell_level(all[k]) == level && all[k] != cell && !has(all, (size_t)k, all[k]),
                "%llx: neighbour %d", (unsigned long long)cell, k);
        REQUIRE(has(theirs, (size_t)count_theirs, cell), "%llx does not know %llx",
                (unsigned long long)all[k], (unsigned long long)cell);
        int shared = by_corners ? shared_corners(made, cell, all[k]) : is_over_edge ? 2 : 1;
        REQUIRE(shared == (is_over_edge ? 2 : 1), "%s %s: %llx and %llx share %d corners",
                mapping_of(made), made->frame->identifier, (unsigned long long)cell,
                (unsigned long long)all[k], shared);
    }
    for (int k = 0; k < 4; k++)
    {
        REQUIRE(has(all, (size_t)count, edge[k]), "%llx: edge %d", (unsigned long long)cell, k);
    }
}

START_TEST(neighbours_touch)
{
    uint64_t state = 41;
    for (size_t m = 0; m < cube_count(); m++)
    {
        for (size_t f = 0; f < cm_frame_count(); f++)
        {
            cm_cell_place place;
            const cm_grid_options options = {.size = sizeof options,
                                             .mapping = cm_catalogue_at(m)->identifier,
                                             .frame = cm_frame_at(f)};
            subject made = make_subject(&options, f % 2 == 0 ? CM_CURVE_HILBERT : CM_CURVE_MORTON);
            for (int n = 0; n < 400; n++)
            {
                int level = n < 126 ? n < 6 ? 0 : n < 30 ? 1 : 2 : 3 + n % 18;
                uint32_t last = (1u << level) - 1;
                cm_cell cell = n < 6     ? cm_cell_at_index(0, (uint64_t)n)
                               : n < 30  ? cm_cell_at_index(1, (uint64_t)n - 6)
                               : n < 126 ? cm_cell_at_index(2, (uint64_t)n - 30)
                                         : random_cell(&state, level);
                cm_cell_to_place(cm_cell_grid_curve(made.cells), cell, &place);
                /* along the edges and in the corners of faces */
                place.i = n % 3 == 0 ? (n & 1 ? last : 0) : place.i;
                place.j = n % 6 == 0 ? (n & 2 ? last : 0) : place.j;
                cell = n < 126 ? cell : cm_cell_from_place(cm_cell_grid_curve(made.cells), &place);
                check_neighbours(&made, cell, !is_torn(&made));
                cm_cell_to_place(cm_cell_grid_curve(made.cells), cell, &place);
                cm_cell to[8];
                int is_in_corner =
                    (place.i == 0 || place.i == last) && (place.j == 0 || place.j == last);
                ck_assert_int_eq(cm_cell_neighbours(made.cells, cell, to), level == 0     ? 4
                                                                           : is_in_corner ? 7
                                                                                          : 8);
            }
            drop_subject(&made);
        }
    }
}
END_TEST

/* Any table that is a frame: the faces in any order, their axes any way round. */
START_TEST(neighbours_in_frames_of_ones_own)
{
    uint64_t state = 43;
    for (int n = 0; n < 60; n++)
    {
        signed char outward[6] = {1, -1, 2, -2, 3, -3};
        cm_frame frame = {sizeof frame, "own", "a test", 1, {{0}}};
        for (int i = 5; i >= 0; i--)
        {
            uint64_t bits = next_bits(&state) >> 16;
            int chosen = (int)(bits % (unsigned)(i + 1));
            int axis = outward[chosen];
            int u = abs(axis) % 3 + 1;
            int v = u % 3 + 1;
            outward[chosen] = outward[i];
            frame.face[i] = (cm_frame_face){
                "", (signed char)axis, (signed char)((bits & 64 ? u : v) * (bits & 128 ? 1 : -1)),
                (signed char)((bits & 64 ? v : u) * (bits & 256 ? 1 : -1))};
        }
        const cm_grid_options options = {
            .size = sizeof options, .mapping = n % 2 == 0 ? "coupled" : "healpix", .frame = &frame};
        subject made = make_subject(&options, CM_CURVE_HILBERT);
        for (int k = 0; k < 126 + 100; k++)
        {
            check_neighbours(&made,
                             k < 6     ? cm_cell_at_index(0, (uint64_t)k)
                             : k < 30  ? cm_cell_at_index(1, (uint64_t)k - 6)
                             : k < 126 ? cm_cell_at_index(2, (uint64_t)k - 30)
                                       : random_cell(&state, 1 + k % 12),
                             1);
        }
        drop_subject(&made);
    }
}
END_TEST

/* At the thirtieth level corners are closer than their own errors: by the numbers alone. */
START_TEST(neighbours_of_leaves)
{
    const cm_grid_options options = {.size = sizeof options, .frame = cm_frame_find("s2")};
    subject made = make_subject(&options, CM_CURVE_HILBERT);
    uint64_t state = 47;
    for (int n = 0; n < 20000; n++)
    {
        uint32_t last = (1u << 30) - 1;
        cm_cell_place place = {(uint8_t)(n % 6), 30, (uint32_t)next_bits(&state) & last,
                               (uint32_t)next_bits(&state) & last};
        place.i = n % 3 == 0 ? (n & 1 ? last : 0) : place.i;
        place.j = n % 9 < 5 ? (n & 2 ? last : 0) : place.j;
        check_neighbours(&made, cm_cell_from_place(CM_CURVE_HILBERT, &place), 0);
    }
    drop_subject(&made);
}
END_TEST

/* Of a finer level: those outside of the cell that have a neighbour inside, and no others. */
START_TEST(finer_neighbours)
{
    const cm_grid_options options = {.size = sizeof options, .frame = cm_frame_find("gl")};
    subject made = make_subject(&options, CM_CURVE_HILBERT);
    uint64_t state = 53;
    for (int n = 0; n < 150; n++)
    {
        int level = n % 4;
        int finer = level + (int)(next_bits(&state) % (uint64_t)(6 - level));
        cm_cell cell = random_cell(&state, level);
        cm_cell found[300];
        size_t count = 0;
        size_t touching = 0;
        ck_assert_int_eq(cm_cell_neighbours_at(made.cells, cell, finer, 300, found, &count), CM_OK);
        for (uint64_t k = 0; k < 6ull << (2 * finer); k++)
        {
            cm_cell small = cm_cell_at_index(finer, k);
            cm_cell beside[8];
            int touches = 0;
            int count_beside = cm_cell_neighbours(made.cells, small, beside);
            for (int i = 0; i < count_beside && !cm_cell_contains(cell, small); i++)
            {
                touches |= cm_cell_contains(cell, beside[i]);
            }
            touching += (size_t)touches;
            REQUIRE(has(found, count, small) == touches, "%llx beside %llx",
                    (unsigned long long)small, (unsigned long long)cell);
        }
        ck_assert_uint_eq(touching, count);
        cm_cell one = 77;
        size_t needed = 99;
        ck_assert_int_eq(cm_cell_neighbours_at(made.cells, cell, finer, 1, &one, &needed),
                         CM_ERROR_SPACE);
        ck_assert(one == 77 && needed == count);
        ck_assert_int_eq(cm_cell_neighbours_at(made.cells, cell, finer, 0, NULL, &needed),
                         CM_ERROR_SPACE);
        ck_assert_int_eq(cm_cell_neighbours_at(made.cells, cell, finer, 1, NULL, &needed),
                         CM_ERROR_ARGUMENT);
        ck_assert_int_eq(cm_cell_neighbours_at(made.cells, cell, finer, 1, &one, NULL),
                         CM_ERROR_ARGUMENT);
        ck_assert_int_eq(cm_cell_neighbours_at(made.cells, cell, level - 1, 1, &one, &needed),
                         CM_ERROR_CELL);
        ck_assert_int_eq(cm_cell_neighbours_at(made.cells, cell, 31, 1, &one, &needed),
                         CM_ERROR_CELL);
    }
    drop_subject(&made);
}
END_TEST

/* In the frame s2 the curve goes on over an edge from each cell to the next, from face to face too, and from
 * the last to the first. */
START_TEST(one_curve_through_all_faces)
{
    const cm_grid_options options = {
        .size = sizeof options, .mapping = "s2", .frame = cm_frame_find("s2")};
    subject made = make_subject(&options, CM_CURVE_HILBERT);
    for (int level = 0; level <= 30; level++)
    {
        uint64_t count = 6ull << (2 * level);
        for (uint64_t k = 0; k < (level < 7 ? count : 6); k++)
        {
            cm_cell cell = cm_cell_at_index(level, level < 7 ? k : (k + 1) * (count / 6) - 1);
            cm_cell edge[4];
            cm_cell_edge_neighbours(made.cells, cell, edge);
            REQUIRE(has(edge, 4, cm_cell_advance(cell, 1)), "level %d: after %llx", level,
                    (unsigned long long)cell);
        }
    }
    drop_subject(&made);
}
END_TEST

int main(void)
{
    const TTest *tests[] = {hard_points_have_their_cells,
                            ties_on_a_face,
                            arrays,
                            what_is_no_point_or_level,
                            what_is_no_grid,
                            centres_come_back,
                            corners_of_squares,
                            bounding_caps,
                            neighbours_touch,
                            neighbours_in_frames_of_ones_own,
                            neighbours_of_leaves,
                            finer_neighbours,
                            one_curve_through_all_faces,
                            NULL};
    return run_suite("cell grid", tests);
}
