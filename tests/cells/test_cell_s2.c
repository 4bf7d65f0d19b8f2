/* SPDX-License-Identifier: MIT
 *
 * Cells as the S2 library rounds: what it made of points and cells, from a file, in every instruction set; what is no
 * point; which grids can have such cells.
 */
#include "cell_suite.h"

#include <inttypes.h>

static const char *vectors; /* the file */

static const cm_ellipsoid unit_sphere = {sizeof(cm_ellipsoid), "", "", "", 1.0, 0.0};

static cm_grid_options s2_options(void)
{
    return (cm_grid_options){.size = sizeof(cm_grid_options),
                             .mapping = "s2",
                             .frame = cm_frame_find("s2"),
                             .ellipsoid = &unit_sphere};
}

static subject make_s2(const char *instructions)
{
    const cm_options how = {.size = sizeof how, .instructions = instructions};
    cm_grid_options options = s2_options();
    subject made = {0};
    options.options = &how;
    ck_assert_int_eq(cm_grid_create(&options, &made.grid), CM_OK);
    ck_assert_int_eq(cm_cell_grid_create_s2(made.grid, &made.cells), CM_OK);
    return made;
}

/* ---- Vectors ---- */

enum
{
    LINES_MAX = 2000
};

/* What the file has, in columns. */
static struct
{
    size_t points;
    double x[LINES_MAX], y[LINES_MAX], z[LINES_MAX];
    cm_cell leaf[LINES_MAX];
    size_t cells;
    cm_cell cell[LINES_MAX];
    double place[LINES_MAX][5][3]; /* the centre, and the corners */
} of_file;

static int read_numbers(const char *text, size_t count, double *to)
{
    char *end;
    for (size_t i = 0; i < count; i++, text = end)
    {
        to[i] = strtod(text, &end);
        if (end == text)
        {
            return 0;
        }
    }
    return 1;
}

static void read_line(const char *line)
{
    double p[3];
    char *end;
    if (line[0] == 'P')
    {
        size_t n = of_file.points++;
        ck_assert(n < LINES_MAX && read_numbers(line + 1, 3, p));
        of_file.x[n] = p[0];
        of_file.y[n] = p[1];
        of_file.z[n] = p[2];
        ck_assert(sscanf(strrchr(line, ' '), "%" SCNx64, &of_file.leaf[n]) == 1);
    }
    else if (line[0] == 'C')
    {
        size_t n = of_file.cells++;
        ck_assert(n < LINES_MAX);
        of_file.cell[n] = strtoull(line + 1, &end, 16);
        ck_assert(read_numbers(end, 15, of_file.place[n][0]));
    }
}

static void read_vectors(void)
{
    char line[1000];
    FILE *file = fopen(vectors, "r");
    ck_assert_msg(file != NULL, "no file %s", vectors);
    of_file.points = of_file.cells = 0;
    while (fgets(line, sizeof line, file) != NULL)
    {
        read_line(line);
    }
    fclose(file);
    ck_assert_msg(of_file.points > 200 && of_file.cells > 50, "%zu points, %zu cells",
                  of_file.points, of_file.cells);
}

static void check_points(const subject *made, const char *set)
{
    static cm_cell cell[LINES_MAX];
    for (int level = 0; level <= CM_CELL_LEVEL_MAX; level += 5)
    {
        cm_cell_forward_array(made->cells, level, of_file.points, of_file.x, of_file.y, of_file.z,
                              cell);
        for (size_t n = 0; n < of_file.points; n++)
        {
            const double normal[3] = {of_file.x[n], of_file.y[n], of_file.z[n]};
            cm_cell wanted = cm_cell_parent(of_file.leaf[n], level);
            REQUIRE(cell[n] == wanted && cm_cell_forward(made->cells, level, normal) == wanted,
                    "%s, level %d: %a %a %a is in %" PRIx64 ", of S2 in %" PRIx64, set, level,
                    normal[0], normal[1], normal[2], cell[n], wanted);
        }
    }
}

static void check_cells(const subject *made, const char *set)
{
    static double x[LINES_MAX], y[LINES_MAX], z[LINES_MAX];
    cm_cell_centre_array(made->cells, of_file.cells, of_file.cell, x, y, z);
    for (size_t n = 0; n < of_file.cells; n++)
    {
        const double centre[3] = {x[n], y[n], z[n]};
        double alone[3], corners[4][3];
        cm_cell_centre(made->cells, of_file.cell[n], alone);
        cm_cell_corners(made->cells, of_file.cell[n], corners);
        REQUIRE(memcmp(centre, of_file.place[n][0], sizeof centre) == 0 &&
                    memcmp(alone, of_file.place[n][0], sizeof alone) == 0 &&
                    memcmp(corners, of_file.place[n][1], sizeof corners) == 0,
                "%s: the places of %" PRIx64, set, of_file.cell[n]);
    }
}

START_TEST(what_s2_makes)
{
    read_vectors();
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        const char *set = cm_instructions_at(s);
        subject made = make_s2(set);
        check_points(&made, set);
        check_cells(&made, set);
        drop_subject(&made);
    }
}
END_TEST

/* The rule of the mapping is another: of the file's points some are on other faces. */
START_TEST(what_the_mapping_makes)
{
    const cm_grid_options options = s2_options();
    subject made = make_subject(&options, CM_CURVE_HILBERT);
    size_t apart = 0;
    read_vectors();
    for (size_t n = 0; n < of_file.points; n++)
    {
        const double normal[3] = {of_file.x[n], of_file.y[n], of_file.z[n]};
        apart += cm_cell_forward(made.cells, 0, normal) != cm_cell_parent(of_file.leaf[n], 0);
    }
    ck_assert_msg(apart > 20, "%zu", apart);
    ck_assert_int_eq(cm_cell_grid_is_s2(made.cells), 0);
    drop_subject(&made);
}
END_TEST

/* ---- Longitude and latitude ---- */

START_TEST(longitudes_and_latitudes)
{
    enum
    {
        MANY = 600
    };
    static double lon[MANY], lat[MANY], back[2][MANY];
    static cm_cell cell[MANY];
    subject made = make_s2(NULL);
    uint64_t state = 11;
    for (size_t n = 0; n < MANY; n++)
    {
        double d[3];
        lon[n] = 3.1 * next_real(&state);
        lat[n] = 1.55 * next_real(&state);
        cm_direction_from_lonlat(lon[n], lat[n], d);
        cell[n] = cm_cell_forward(made.cells, 20, d);
        REQUIRE(cm_cell_forward_lonlat(made.cells, 20, lon[n], lat[n]) == cell[n], "%zu", n);
    }
    cm_cell made_of[MANY];
    cm_cell_forward_lonlat_array(made.cells, 20, MANY, lon, lat, made_of);
    ck_assert(memcmp(made_of, cell, sizeof cell) == 0);
    cm_cell_centre_lonlat_array(made.cells, MANY, cell, back[0], back[1]);
    for (size_t n = 0; n < MANY; n++)
    {
        double alone[2], centre[3], wanted[2], corners[4][3], corner[4][2];
        cm_cell_centre_lonlat(made.cells, cell[n], alone);
        cm_cell_centre(made.cells, cell[n], centre);
        cm_lonlat_from_direction(centre, wanted);
        REQUIRE(alone[0] == back[0][n] && alone[1] == back[1][n] &&
                    fabs(alone[0] - wanted[0]) < 1e-15 && fabs(alone[1] - wanted[1]) < 1e-15,
                "%zu: %a %a, not %a %a", n, alone[0], alone[1], wanted[0], wanted[1]);
        cm_cell_corners(made.cells, cell[n], corners);
        cm_cell_corners_lonlat(made.cells, cell[n], corner);
        cm_lonlat_from_direction(corners[n % 4], wanted);
        REQUIRE(fabs(corner[n % 4][0] - wanted[0]) < 1e-15 &&
                    fabs(corner[n % 4][1] - wanted[1]) < 1e-15,
                "%zu: a corner", n);
    }
    drop_subject(&made);
}
END_TEST

/* ---- What is none ---- */

START_TEST(what_is_no_point_or_level)
{
    static const double bad[][3] = {{0.0, 0.0, 0.0},
                                    {-0.0, 0.0, 0.0},
                                    {(double)NAN, 1.0, 0.0},
                                    {1.0, (double)NAN, 0.0},
                                    {(double)INFINITY, 1.0, 0.0},
                                    {1.0, 2.0, -(double)INFINITY}};
    subject made = make_s2(NULL);
    for (size_t n = 0; n < sizeof bad / sizeof bad[0]; n++)
    {
        cm_cell cell = 1;
        ck_assert(cm_cell_forward(made.cells, 3, bad[n]) == CM_NO_CELL);
        cm_cell_forward_array(made.cells, 3, 1, &bad[n][0], &bad[n][1], &bad[n][2], &cell);
        ck_assert(cell == CM_NO_CELL);
    }
    const double good[3] = {1.0, 0.5, 0.25};
    ck_assert(cm_cell_forward(made.cells, -1, good) == CM_NO_CELL &&
              cm_cell_forward(made.cells, 31, good) == CM_NO_CELL);
    ck_assert(cm_cell_forward_lonlat(made.cells, 5, (double)NAN, 0.0) == CM_NO_CELL &&
              cm_cell_forward_lonlat(made.cells, 5, 0.0, 2.0) == CM_NO_CELL);
    double d[3], lonlat[2], corners[4][2];
    cm_cell_centre(made.cells, CM_NO_CELL, d);
    cm_cell_centre_lonlat(made.cells, CM_NO_CELL, lonlat);
    cm_cell_corners_lonlat(made.cells, CM_NO_CELL, corners);
    ck_assert(isnan(d[0]) && isnan(d[1]) && isnan(d[2]) && isnan(lonlat[0]) && isnan(lonlat[1]) &&
              isnan(corners[3][0]) && isnan(corners[0][1]));
    drop_subject(&made);
}
END_TEST

static cm_status try_grid(const cm_grid_options *options)
{
    cm_grid *grid = NULL;
    cm_cell_grid *cells = NULL;
    ck_assert_int_eq(cm_grid_create(options, &grid), CM_OK);
    cm_status status = cm_cell_grid_create_s2(grid, &cells);
    ck_assert((status == CM_OK) == (cells != NULL));
    ck_assert(cells == NULL || (cm_cell_grid_is_s2(cells) && cm_cell_grid_of(cells) == grid &&
                                cm_cell_grid_curve(cells) == CM_CURVE_HILBERT));
    cm_cell_grid_destroy(cells);
    cm_grid_destroy(grid);
    return status;
}

START_TEST(which_grids)
{
    const cm_latitude geographic = CM_LATITUDE_GEOGRAPHIC;
    cm_rotation rotation;
    cm_frame turned = *cm_frame_find("s2");
    cm_cell_grid *cells;
    cm_grid_options options = s2_options();
    ck_assert_int_eq(try_grid(&options), CM_OK);
    options.ellipsoid = NULL;
    ck_assert_int_eq(try_grid(&options), CM_ERROR_UNSUPPORTED);
    options.latitude = &geographic;
    ck_assert_int_eq(try_grid(&options), CM_OK);
    options = s2_options();
    options.mapping = "coupled";
    ck_assert_int_eq(try_grid(&options), CM_ERROR_UNSUPPORTED);
    options = s2_options();
    options.frame = NULL;
    ck_assert_int_eq(try_grid(&options), CM_ERROR_UNSUPPORTED);
    turned.identifier = "one's own";
    options.frame = &turned;
    ck_assert_int_eq(try_grid(&options), CM_OK);
    turned.face[3].v = (signed char)-turned.face[3].v;
    ck_assert_int_eq(try_grid(&options), CM_ERROR_UNSUPPORTED);
    turned.face[3].v = (signed char)-turned.face[3].v;
    turned.face[5].u = (signed char)-turned.face[5].u;
    ck_assert_int_eq(try_grid(&options), CM_ERROR_UNSUPPORTED);
    options = s2_options();
    options.rotation = &rotation;
    ck_assert_int_eq(cm_rotation_from_angles(1.0, 0.0, 0.0, &rotation), CM_OK);
    ck_assert_int_eq(try_grid(&options), CM_ERROR_UNSUPPORTED);
    ck_assert_int_eq(cm_cell_grid_create_s2(NULL, &cells), CM_ERROR_ARGUMENT);
    subject made = make_s2(NULL);
    ck_assert_int_eq(cm_cell_grid_create_s2(made.grid, NULL), CM_ERROR_ARGUMENT);
    drop_subject(&made);
}
END_TEST

int main(int argc, char **argv)
{
    const TTest *tests[] = {what_s2_makes,
                            what_the_mapping_makes,
                            longitudes_and_latitudes,
                            what_is_no_point_or_level,
                            which_grids,
                            NULL};
    if (argc != 2)
    {
        fprintf(stderr, "usage: test-cell_s2 FILE\n");
        return 2;
    }
    vectors = argv[1];
    return run_suite("S2's cells", tests);
}
