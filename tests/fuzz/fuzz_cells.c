/* SPDX-License-Identifier: MIT
 *
 * Cells: any number, place and text; points, neighbours and coverings in one of a few grids.
 */
#include "in_double.inc"
#include "fuzz_values.inc"

enum
{
    GRIDS = 9,
    LIST = 64
};

static cm_cell_grid *grid_at(size_t index)
{
    static const char *const mappings[GRIDS] = {
        "s2", "slice", "healpix", "coupled", "gnomonic", "conformal", "difference", "arvo", "s2"};
    const cm_latitude geographic = CM_LATITUDE_GEOGRAPHIC;
    const int is_s2 = index == GRIDS - 1; /* as S2 rounds */
    static cm_cell_grid *made[GRIDS];
    if (made[index] == NULL)
    {
        cm_grid *grid = NULL;
        cm_rotation rotation;
        EXPECT(cm_rotation_from_angles(17.0, -10.0, 32.0, &rotation) == CM_OK, "no rotation");
        const cm_grid_options options = {.size = sizeof options,
                                         .mapping = mappings[index],
                                         .frame = is_s2 ? cm_frame_find("s2")
                                                        : cm_frame_at(index % cm_frame_count()),
                                         .latitude = is_s2 ? &geographic : NULL,
                                         .rotation = index % 3 == 1 ? &rotation : NULL};
        const cm_curve curve = (cm_curve)(index / 2 % 2);
        EXPECT(cm_grid_create(&options, &grid) == CM_OK, "no grid");
        EXPECT((is_s2 ? cm_cell_grid_create_s2(grid, &made[index])
                      : cm_cell_grid_create(grid, curve, &made[index])) == CM_OK,
               "no cell grid");
        EXPECT(cm_cell_grid_of(made[index]) == grid && cm_cell_grid_curve(made[index]) == curve &&
                   cm_cell_grid_is_s2(made[index]) == is_s2,
               "another grid");
    }
    return made[index];
}

/* Any number, or one that is nearly a cell's. */
static cm_cell take_cell(supply *from)
{
    uint8_t kind = take_byte(from);
    cm_cell cell;
    take_bytes(from, &cell, sizeof cell);
    if (kind % 4 != 0)
    {
        int level = kind / 4 % 31;
        cell = cm_cell_at_index(level, cell % (6ull << (2 * level)));
        EXPECT(cm_cell_is_valid(cell) && cm_cell_level(cell) == level, "level %d", level);
    }
    return cell;
}

/* ---- Numbers ---- */

static void check_family(cm_cell cell, supply *from)
{
    int level = cm_cell_level(cell);
    int wanted = (int8_t)take_byte(from);
    int64_t steps;
    take_bytes(from, &steps, sizeof steps);
    cm_cell parent = cm_cell_parent(cell, wanted);
    EXPECT((parent != CM_NO_CELL) == (wanted >= 0 && wanted <= level), "%d of %d", wanted, level);
    EXPECT(parent == CM_NO_CELL || cm_cell_contains(parent, cell), "a parent");
    cm_cell child = cm_cell_child(cell, wanted);
    EXPECT((child != CM_NO_CELL) == (level >= 0 && level < 30 && wanted >= 0 && wanted < 4),
           "quarter %d of level %d", wanted, level);
    EXPECT(child == CM_NO_CELL || cm_cell_parent(child, level) == cell, "quarter %d", wanted);
    cm_cell other = cm_cell_advance(cell, steps);
    EXPECT(cm_cell_level(other) == level, "advance");
    if (level >= 0)
    {
        EXPECT(cm_cell_at_index(level, cm_cell_index(cell)) == cell, "index");
        EXPECT(cm_cell_first_leaf(cell) <= cell && cell <= cm_cell_last_leaf(cell), "range");
        EXPECT(cm_cell_advance(cm_cell_advance(other, -(steps / 2)), -(steps - steps / 2)) == cell,
               "there and back");
        cm_cell common = cm_cell_common_parent(cell, other);
        EXPECT((common != CM_NO_CELL) == (cm_cell_face(cell) == cm_cell_face(other)), "common");
        EXPECT(common == CM_NO_CELL ||
                   (cm_cell_contains(common, cell) && cm_cell_contains(common, other)),
               "common");
    }
    EXPECT(cm_cell_intersects(cell, other) == (level >= 0 && cell == other), "intersects");
}

static void check_places(cm_cell cell, supply *from)
{
    cm_cell_place place;
    uint8_t face = 9;
    double low[2], high[2];
    for (int curve = -1; curve < 3; curve++)
    {
        cm_status expected = curve < 0 || curve > 1   ? CM_ERROR_ARGUMENT
                             : cm_cell_is_valid(cell) ? CM_OK
                                                      : CM_ERROR_CELL;
        EXPECT(cm_cell_to_place((cm_curve)curve, cell, &place) == expected, "%d", curve);
        EXPECT(cm_cell_square((cm_curve)curve, cell, &face, low, high) == expected, "%d", curve);
        EXPECT((cm_curve_name((cm_curve)curve) != NULL) == (curve == 0 || curve == 1), "%d", curve);
        if (expected == CM_OK)
        {
            EXPECT(cm_cell_from_place((cm_curve)curve, &place) == cell, "there and back");
            EXPECT(face == place.face && low[0] >= -1.0 && high[0] <= 1.0 && low[0] < high[0],
                   "%g to %g", low[0], high[0]);
        }
    }
    take_bytes(from, &place, sizeof place);
    cm_cell made = cm_cell_from_place(CM_CURVE_HILBERT, &place);
    int good = place.face < 6 && place.level <= 30 && place.i >> (place.level % 32) == 0 &&
               place.j >> (place.level % 32) == 0;
    EXPECT(cm_cell_is_valid(made) == good, "%u %u %u %u", place.face, place.level, place.i,
           place.j);
}

static void check_token(cm_cell cell, supply *from)
{
    char token[CM_CELL_TOKEN_SIZE];
    size_t size = take_byte(from) % 20;
    cm_cell back = 1;
    cm_status status = cm_cell_token(cell, token, size < sizeof token ? size : sizeof token);
    if (status == CM_OK)
    {
        EXPECT(strlen(token) < size && cm_cell_parse(token, &back, NULL, 0) == CM_OK &&
                   back == cell,
               "'%s'", token);
    }
    else
    {
        EXPECT(status == CM_ERROR_SPACE ? size < sizeof token
                                        : status == CM_ERROR_CELL && !cm_cell_is_valid(cell),
               "%d", status);
    }
}

static void check_text(supply *from)
{
    char message[64];
    char *text = take_text(from);
    cm_cell cell = 77;
    cm_curve curve;
    cm_status status = cm_cell_parse(text, &cell, message, sizeof message);
    EXPECT(status == CM_OK ? cell == CM_NO_CELL || cm_cell_is_valid(cell)
                           : status == CM_ERROR_CELL && cell == 77 && strlen(message) > 0 &&
                                 strchr(message, '\n') == NULL,
           "'%s': %d", text, status);
    EXPECT(cm_curve_find(text, &curve) == CM_ERROR_CELL || cm_curve_name(curve) != NULL, "%s",
           text);
    free(text);
}

static void check_union(supply *from)
{
    cm_cell cells[LIST], kept[LIST];
    size_t count = take_byte(from) % (LIST + 1);
    for (size_t i = 0; i < count; i++)
    {
        cells[i] = kept[i] = take_cell(from);
    }
    size_t left = cm_cell_union_normalise(count, kept);
    EXPECT(left <= count, "%zu of %zu", left, count);
    for (size_t i = 0; i < count; i++)
    {
        EXPECT(cm_cell_union_contains(left, kept, cells[i]) == cm_cell_is_valid(cells[i]) &&
                   cm_cell_union_intersects(left, kept, cells[i]) == cm_cell_is_valid(cells[i]),
               "%llx", (unsigned long long)cells[i]);
    }
}

/* ---- In a grid ---- */

static void check_points(const cm_cell_grid *cells, supply *from)
{
    enum
    {
        MANY = 9
    };
    double x[MANY], y[MANY], z[MANY], lon[MANY], lat[MANY];
    cm_cell cell[MANY], by_lonlat[MANY];
    int level = (int8_t)take_byte(from);
    level = level < 0 ? level : level % 33;
    for (size_t i = 0; i < MANY; i++)
    {
        double normal[3];
        take_direction(from, normal);
        x[i] = normal[0];
        y[i] = normal[1];
        z[i] = normal[2];
        lon[i] = normal[0];
        lat[i] = normal[1];
    }
    cm_cell_forward_array(cells, level, MANY, x, y, z, cell);
    cm_cell_forward_lonlat_array(cells, level, MANY, lon, lat, by_lonlat);
    for (size_t i = 0; i < MANY; i++)
    {
        const double normal[3] = {x[i], y[i], z[i]};
        EXPECT(cell[i] == cm_cell_forward(cells, level, normal) &&
                   by_lonlat[i] == cm_cell_forward_lonlat(cells, level, lon[i], lat[i]),
               "%zu is another alone", i);
        EXPECT((cell[i] != CM_NO_CELL) == (is_direction(normal) && level >= 0 && level <= 30),
               "%a %a %a: %llx", x[i], y[i], z[i], (unsigned long long)cell[i]);
    }
    cm_cell_centre_array(cells, MANY, cell, x, y, z);
    cm_cell_centre_lonlat_array(cells, MANY, cell, lon, lat);
    for (size_t i = 0; i < MANY; i++)
    {
        double centre[3], lonlat[2];
        cm_cell_centre(cells, cell[i], centre);
        cm_cell_centre_lonlat(cells, cell[i], lonlat);
        EXPECT(cell[i] == CM_NO_CELL ? isnan(x[i]) && isnan(lat[i])
                                     : x[i] == centre[0] && lat[i] == lonlat[1] &&
                                           cm_cell_forward(cells, level, centre) == cell[i],
               "the centre of %llx", (unsigned long long)cell[i]);
    }
}

static void check_neighbours(const cm_cell_grid *cells, cm_cell cell)
{
    cm_cell edge[4], all[8], ring[LIST];
    size_t count = 99;
    int valid = cm_cell_is_valid(cell);
    double corners[4][3], lonlats[4][2], normal[3], radius;
    EXPECT(cm_cell_edge_neighbours(cells, cell, edge) == (valid ? 4 : 0), "edges");
    int near = cm_cell_neighbours(cells, cell, all);
    EXPECT(valid ? near >= 4 && near <= 8 : near == 0, "%d", near);
    for (int k = 0; k < near; k++)
    {
        EXPECT(cm_cell_level(all[k]) == cm_cell_level(cell) && all[k] != cell, "%d", k);
    }
    cm_status status =
        cm_cell_neighbours_at(cells, cell, cm_cell_level(cell) + 3, LIST, ring, &count);
    EXPECT(status == (valid && cm_cell_level(cell) <= 27 ? CM_OK : CM_ERROR_CELL), "%d", status);
    cm_cell_corners(cells, cell, corners);
    cm_cell_corners_lonlat(cells, cell, lonlats);
    cm_cell_bounding_cap(cells, cell, normal, &radius);
    EXPECT(valid ? radius > 0.0 && isfinite(corners[3][2]) && isfinite(lonlats[2][0])
                 : isnan(radius) && isnan(corners[3][2]) && isnan(lonlats[2][0]),
           "%g", radius);
    /* the first levels take long */
    if (!valid || cm_cell_level(cell) > 12)
    {
        double area = cm_cell_area(cells, cell);
        EXPECT(valid ? area > 0.0 : isnan(area), "%g", area);
    }
}

static double take_angle(supply *from)
{
    double angle = take_double(from);
    return take_byte(from) % 4 == 0 ? angle : 4.0 * take_fraction(from);
}

static cm_region *take_region(supply *from, size_t *rings)
{
    double angle[2 * 8];
    size_t length[2];
    cm_region *region = NULL;
    for (size_t k = 0; k < 16; k++)
    {
        angle[k] = take_angle(from) * (k % 2 == 1 ? 0.4 : 1.0);
    }
    switch (take_byte(from) % 4)
    {
    case 0:
        cm_region_cap(angle, fabs(angle[3]), &region);
        break;
    case 1:
        cm_region_cap_lonlat(angle[0], angle[1],
                             cm_cap_radius(cm_ellipsoid_find("WGS84"), 1e6 * angle[2]), &region);
        break;
    case 2:
        cm_region_box(angle[0], angle[1], angle[2], angle[3], &region);
        break;
    default:
        length[0] = 3 + take_byte(from) % 3;
        length[1] = 3;
        *rings = 1 + take_byte(from) % 2;
        cm_region_polygon(*rings, length, angle, &region);
        break;
    }
    return region;
}

static void check_covering(const cm_cell_grid *cells, supply *from)
{
    cm_cell found[LIST];
    size_t count = 0;
    size_t rings = 0;
    cm_region *region = take_region(from, &rings);
    const cm_cover_options options = {.size = sizeof options,
                                      .level_min = take_byte(from) % 4,
                                      .level_max = take_byte(from) % 32,
                                      .cells_most = 1 + take_byte(from) % LIST,
                                      .kind = (cm_cover_kind)(take_byte(from) % 2)};
    if (region == NULL)
    {
        return;
    }
    cm_status status = cm_cover(cells, region, &options, LIST, found, &count);
    EXPECT(status == CM_OK || status == CM_ERROR_SPACE ||
               (status == CM_ERROR_ARGUMENT &&
                (options.level_max > 30 || options.level_min > options.level_max)),
           "%d", status);
    for (size_t i = 0; i < count && status == CM_OK; i++)
    {
        int level = cm_cell_level(found[i]);
        EXPECT(level >= options.level_min && level <= options.level_max &&
                   (i == 0 || cm_cell_last_leaf(found[i - 1]) < cm_cell_first_leaf(found[i])),
               "cell %zu", i);
    }
    double normal[3];
    take_direction(from, normal);
    /* two rings that share an edge are undefined */
    if (status == CM_OK && options.kind == CM_COVER_OUTER && rings < 2 &&
        cm_region_contains(region, normal))
    {
        EXPECT(cm_cell_union_contains(count, found, cm_cell_forward(cells, 30, normal)),
               "%a %a %a is missed", normal[0], normal[1], normal[2]);
    }
    cm_region_destroy(region);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    const cm_cell_grid *cells = grid_at(take_byte(&from) % GRIDS);
    cm_cell cell = take_cell(&from);
    check_family(cell, &from);
    check_places(cell, &from);
    check_token(cell, &from);
    check_neighbours(cells, cell);
    check_points(cells, &from);
    check_covering(cells, &from);
    check_union(&from);
    check_text(&from);
    return 0;
}

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc;
    (void)argv;
    /* the tables of grids are kept; that they can be given back is seen once */
    cm_grid *grid = NULL;
    cm_cell_grid *cells = NULL;
    EXPECT(cm_grid_create(NULL, &grid) == CM_OK &&
               cm_cell_grid_create(grid, CM_CURVE_HILBERT, &cells) == CM_OK,
           "no grid");
    cm_cell_grid_destroy(cells);
    cm_grid_destroy(grid);
    return 0;
}
