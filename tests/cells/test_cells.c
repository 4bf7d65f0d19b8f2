/* SPDX-License-Identifier: MIT
 *
 * The numbers of cells: places on both curves, parents and children, ranges, tokens, sets.
 */
#include "tests/suite.h"

#define LEAF_SIDE ((uint64_t)1 << CM_CELL_LEVEL_MAX)

static const cm_curve curves[] = {CM_CURVE_HILBERT, CM_CURVE_MORTON};

/* What is no cell: no last bit at an even place, or no face. */
static const cm_cell none[] = {0,
                               2,
                               8,
                               0x8000000000000000ull,
                               UINT64_MAX,
                               UINT64_MAX - 1,
                               0xc000000000000001ull,
                               0xe000000000000000ull,
                               0xd000000000000000ull,
                               0x2000000000000000ull,
                               0x1000000000000002ull,
                               0x4000000000000008ull};

static cm_cell random_cell(uint64_t *state)
{
    int level = (int)(next_bits(state) % (CM_CELL_LEVEL_MAX + 1));
    return cm_cell_at_index(level, next_bits(state) % (6ull << (2 * level)));
}

static uint64_t cells_of(int level)
{
    return 6ull << (2 * level);
}

/* ---- Places ---- */

START_TEST(every_place_of_low_levels)
{
    for (size_t c = 0; c < 2; c++)
    {
        for (int level = 0; level <= 5; level++)
        {
            uint64_t sum = 0;
            for (uint64_t n = 0; n < cells_of(level); n++)
            {
                uint32_t side = (uint32_t)1 << level;
                cm_cell_place place = {(uint8_t)(n >> (2 * level)), (uint8_t)level,
                                       (uint32_t)(n / side) % side, (uint32_t)n % side};
                cm_cell_place back = {9, 99, 9, 9};
                cm_cell cell = cm_cell_from_place(curves[c], &place);
                REQUIRE(cm_cell_is_valid(cell) && cm_cell_level(cell) == level &&
                            cm_cell_face(cell) == place.face,
                        "level %d, %llu", level, (unsigned long long)n);
                REQUIRE(cm_cell_to_place(curves[c], cell, &back) == CM_OK &&
                            back.face == place.face && back.level == level && back.i == place.i &&
                            back.j == place.j,
                        "level %d, %llu: comes back elsewhere", level, (unsigned long long)n);
                uint64_t index = cm_cell_index(cell);
                REQUIRE(index < cells_of(level) && index >> (2 * level) == place.face &&
                            cm_cell_at_index(level, index) == cell,
                        "level %d, %llu: index %llu", level, (unsigned long long)n,
                        (unsigned long long)index);
                sum += index;
            }
            /* as each index names one place, that they are all different is that they are all there */
            ck_assert(sum == cells_of(level) * (cells_of(level) - 1) / 2);
        }
    }
}
END_TEST

/* Each quarter of a cell is in its place, and each place is one of the quarters. */
START_TEST(quarters)
{
    uint64_t state = 5;
    for (int n = 0; n < 100000; n++)
    {
        cm_curve curve = curves[n & 1];
        cm_cell cell = random_cell(&state);
        cm_cell_place place;
        unsigned seen = 0;
        int level = cm_cell_level(cell);
        if (level == CM_CELL_LEVEL_MAX)
        {
            REQUIRE(cm_cell_child(cell, 0) == CM_NO_CELL, "a quarter of a leaf");
            continue;
        }
        cm_cell_to_place(curve, cell, &place);
        for (int k = 0; k < 4; k++)
        {
            cm_cell child = cm_cell_child(cell, k);
            cm_cell_place at;
            REQUIRE(cm_cell_to_place(curve, child, &at) == CM_OK && at.level == level + 1 &&
                        at.i >> 1 == place.i && at.j >> 1 == place.j && at.face == place.face,
                    "quarter %d of %llx", k, (unsigned long long)cell);
            REQUIRE(cm_cell_parent(child, level) == cell && cm_cell_contains(cell, child) &&
                        !cm_cell_contains(child, cell) && cm_cell_intersects(child, cell),
                    "quarter %d of %llx has another parent", k, (unsigned long long)cell);
            REQUIRE(curve != CM_CURVE_MORTON || (unsigned)k == 2 * (at.j & 1) + (at.i & 1),
                    "quarter %d of %llx is not Morton's", k, (unsigned long long)cell);
            seen |= 1u << (2 * (at.i & 1) + (at.j & 1));
        }
        REQUIRE(seen == 15, "%llx has quarters twice", (unsigned long long)cell);
        REQUIRE(cm_cell_child(cell, 4) == CM_NO_CELL && cm_cell_child(cell, -1) == CM_NO_CELL,
                "a fifth quarter");
    }
}
END_TEST

/* One step of the curve is a step over an edge, on every face and at every level that can be walked; and at the
 * 30th in pieces. */
START_TEST(hilbert_walks_over_edges)
{
    uint64_t state = 7;
    for (int n = 0; n < 300000; n++)
    {
        int level = n < 200000 ? n % 9 : CM_CELL_LEVEL_MAX - n % 3;
        uint64_t index = next_bits(&state) % cells_of(level);
        cm_cell_place a;
        cm_cell_place b;
        cm_cell here = cm_cell_at_index(level, index);
        cm_cell next = cm_cell_at_index(level, index + 1);
        if (next == CM_NO_CELL || cm_cell_face(next) != cm_cell_face(here))
        {
            continue;
        }
        cm_cell_to_place(CM_CURVE_HILBERT, here, &a);
        cm_cell_to_place(CM_CURVE_HILBERT, next, &b);
        int64_t di = (int64_t)a.i - b.i;
        int64_t dj = (int64_t)a.j - b.j;
        REQUIRE(di * di + dj * dj == 1, "level %d, index %llu", level, (unsigned long long)index);
    }
}
END_TEST

/* The table that the S2 library has for its curve, as a check of the prefix that this one computes: the digit by
 * (i, j) in each of four orientations, and how each digit changes the orientation. */
START_TEST(hilbert_by_table)
{
    static const unsigned digit_of[4][4] = {{0, 1, 3, 2}, {0, 3, 1, 2}, {2, 3, 1, 0}, {2, 1, 3, 0}};
    static const unsigned change[4] = {1, 0, 0, 3};
    uint64_t state = 11;
    for (int n = 0; n < 100000; n++)
    {
        cm_cell_place place = {(uint8_t)(n % 6), CM_CELL_LEVEL_MAX,
                               (uint32_t)(next_bits(&state) % LEAF_SIDE),
                               (uint32_t)(next_bits(&state) % LEAF_SIDE)};
        unsigned orientation = place.face & 1;
        uint64_t cell = place.face;
        for (int bit = CM_CELL_LEVEL_MAX - 1; bit >= 0; bit--)
        {
            unsigned digit = digit_of[orientation][2 * (place.i >> bit & 1) + (place.j >> bit & 1)];
            cell = cell << 2 | digit;
            orientation ^= change[digit];
        }
        REQUIRE(cm_cell_from_place(CM_CURVE_HILBERT, &place) == (cell << 1 | 1), "%d %x %x",
                place.face, place.i, place.j);
    }
}
END_TEST

START_TEST(squares)
{
    uint64_t state = 13;
    for (int n = 0; n < 20000; n++)
    {
        cm_curve curve = curves[n & 1];
        cm_cell cell = random_cell(&state);
        cm_cell_place place;
        uint8_t face;
        double low[2];
        double high[2];
        cm_cell_to_place(curve, cell, &place);
        REQUIRE(cm_cell_square(curve, cell, &face, low, high) == CM_OK && face == place.face,
                "%llx", (unsigned long long)cell);
        double side = ldexp(1.0, place.level);
        REQUIRE((low[0] + 1.0) * side == 2.0 * place.i && (low[1] + 1.0) * side == 2.0 * place.j &&
                    (high[0] - low[0]) * side == 2.0 && (high[1] - low[1]) * side == 2.0,
                "%llx: from %a %a to %a %a", (unsigned long long)cell, low[0], low[1], high[0],
                high[1]);
    }
}
END_TEST

/* ---- What follows from the number ---- */

START_TEST(parents_and_ranges)
{
    uint64_t state = 17;
    for (int n = 0; n < 100000; n++)
    {
        cm_cell a = random_cell(&state);
        cm_cell b = n % 3 == 0 ? random_cell(&state)
                               : cm_cell_parent(cm_cell_advance(cm_cell_first_leaf(a),
                                                                (int64_t)(next_bits(&state) % 64)),
                                                (int)(next_bits(&state) % 31));
        int level = cm_cell_level(a);
        for (int up = 0; up <= level; up++)
        {
            cm_cell parent = cm_cell_parent(a, up);
            REQUIRE(cm_cell_level(parent) == up && cm_cell_contains(parent, a) &&
                        cm_cell_index(parent) == cm_cell_index(a) >> (2 * (level - up)),
                    "%llx at level %d", (unsigned long long)a, up);
        }
        REQUIRE(cm_cell_parent(a, level + 1) == CM_NO_CELL && cm_cell_parent(a, -1) == CM_NO_CELL &&
                    cm_cell_parent(a, 31) == CM_NO_CELL && cm_cell_parent(a, level) == a,
                "a level that is none");
        cm_cell first = cm_cell_first_leaf(a);
        cm_cell last = cm_cell_last_leaf(a);
        REQUIRE(cm_cell_level(first) == 30 && cm_cell_level(last) == 30 &&
                    cm_cell_parent(first, level) == a && cm_cell_parent(last, level) == a &&
                    cm_cell_index(last) - cm_cell_index(first) + 1 == 1ull << (2 * (30 - level)),
                "the range of %llx", (unsigned long long)a);
        int contains = level <= cm_cell_level(b) && cm_cell_parent(b, level) == a;
        REQUIRE(cm_cell_contains(a, b) == contains && contains == (b >= first && b <= last),
                "%llx in %llx", (unsigned long long)b, (unsigned long long)a);
        cm_cell common = cm_cell_common_parent(a, b);
        cm_cell expected = CM_NO_CELL;
        for (int up = 0; up <= level && up <= cm_cell_level(b); up++)
        {
            expected =
                cm_cell_parent(a, up) == cm_cell_parent(b, up) ? cm_cell_parent(a, up) : expected;
        }
        REQUIRE(common == expected && cm_cell_common_parent(b, a) == common,
                "the common parent of %llx and %llx is %llx", (unsigned long long)a,
                (unsigned long long)b, (unsigned long long)common);
    }
}
END_TEST

START_TEST(steps_along_the_curve)
{
    static const int64_t steps[] = {
        0, 1, -1, 2, 5, -5, 23, INT64_MAX, INT64_MIN, INT64_MIN + 1, 1 << 20, -(1 << 20)};
    for (int level = 0; level <= CM_CELL_LEVEL_MAX; level++)
    {
        uint64_t count = cells_of(level);
        const uint64_t starts[] = {0, 1, count / 2, count - 2, count - 1};
        for (size_t s = 0; s < 5; s++)
        {
            for (size_t k = 0; k < sizeof steps / sizeof steps[0]; k++)
            {
                /* one at a time what 128 bits would do at once */
                uint64_t rest =
                    steps[k] < 0 ? (0 - (uint64_t)steps[k]) % count : (uint64_t)steps[k] % count;
                uint64_t at = steps[k] < 0                ? (starts[s] >= rest ? starts[s] - rest
                                                                               : starts[s] + (count - rest))
                              : starts[s] >= count - rest ? starts[s] - (count - rest)
                                                          : starts[s] + rest;
                cm_cell from = cm_cell_at_index(level, starts[s]);
                REQUIRE(cm_cell_advance(from, steps[k]) == cm_cell_at_index(level, at),
                        "level %d: %lld steps from %llu", level, (long long)steps[k],
                        (unsigned long long)starts[s]);
            }
        }
        ck_assert(cm_cell_at_index(level, count) == CM_NO_CELL);
        ck_assert(cm_cell_at_index(level, UINT64_MAX) == CM_NO_CELL);
    }
    ck_assert(cm_cell_at_index(-1, 0) == CM_NO_CELL && cm_cell_at_index(31, 0) == CM_NO_CELL);
}
END_TEST

START_TEST(what_is_no_cell)
{
    for (size_t k = 0; k < sizeof none / sizeof none[0]; k++)
    {
        cm_cell cell = none[k];
        cm_cell_place place = {9, 99, 9, 9};
        uint8_t face = 9;
        double low[2] = {9.0, 9.0};
        double high[2] = {9.0, 9.0};
        ck_assert_msg(!cm_cell_is_valid(cell), "%llx", (unsigned long long)cell);
        ck_assert_int_eq(cm_cell_level(cell), -1);
        ck_assert_int_eq(cm_cell_face(cell), CM_NO_FACE);
        ck_assert(cm_cell_parent(cell, 0) == CM_NO_CELL && cm_cell_child(cell, 0) == CM_NO_CELL);
        ck_assert(cm_cell_first_leaf(cell) == CM_NO_CELL && cm_cell_last_leaf(cell) == CM_NO_CELL);
        ck_assert(!cm_cell_contains(cell, cell) && !cm_cell_contains(1, cell) &&
                  !cm_cell_contains(cell, 1) && !cm_cell_intersects(cell, 1));
        ck_assert(cm_cell_common_parent(cell, 1) == CM_NO_CELL &&
                  cm_cell_common_parent(1, cell) == CM_NO_CELL);
        ck_assert(cm_cell_index(cell) == UINT64_MAX && cm_cell_advance(cell, 1) == CM_NO_CELL);
        for (size_t c = 0; c < 2; c++)
        {
            ck_assert_int_eq(cm_cell_to_place(curves[c], cell, &place), CM_ERROR_CELL);
            ck_assert_int_eq(cm_cell_square(curves[c], cell, &face, low, high), CM_ERROR_CELL);
        }
        ck_assert(place.face == 9 && place.level == 99 && face == 9 && low[0] == 9.0 &&
                  high[1] == 9.0);
    }
}
END_TEST

START_TEST(what_is_no_place)
{
    const cm_cell_place bad[] = {{6, 0, 0, 0},           {255, 3, 0, 0},      {0, 31, 0, 0},
                                 {0, 255, 0, 0},         {0, 0, 1, 0},        {0, 0, 0, 1},
                                 {1, 5, 32, 0},          {1, 5, 0, 32},       {1, 30, 1u << 30, 0},
                                 {1, 5, UINT32_MAX, 31}, {1, 30, 0, 1u << 30}};
    cm_cell_place place;
    double uv[2];
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++)
    {
        ck_assert(cm_cell_from_place(CM_CURVE_HILBERT, &bad[k]) == CM_NO_CELL);
        ck_assert(cm_cell_from_place(CM_CURVE_MORTON, &bad[k]) == CM_NO_CELL);
    }
    ck_assert(cm_cell_from_place(CM_CURVE_HILBERT, NULL) == CM_NO_CELL);
    ck_assert(cm_cell_from_place((cm_curve)2, &(cm_cell_place){0, 0, 0, 0}) == CM_NO_CELL);
    ck_assert_int_eq(cm_cell_to_place((cm_curve)2, 1, &place), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_cell_to_place(CM_CURVE_HILBERT, 1, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_cell_square(CM_CURVE_HILBERT, 1, NULL, uv, uv), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_cell_square(CM_CURVE_HILBERT, 1, &place.face, NULL, uv), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_cell_square(CM_CURVE_HILBERT, 1, &place.face, uv, NULL), CM_ERROR_ARGUMENT);
}
END_TEST

START_TEST(names_of_curves)
{
    cm_curve curve = (cm_curve)7;
    ck_assert_str_eq(cm_curve_name(CM_CURVE_HILBERT), "hilbert");
    ck_assert_str_eq(cm_curve_name(CM_CURVE_MORTON), "morton");
    ck_assert_ptr_null(cm_curve_name((cm_curve)2));
    ck_assert_int_eq(cm_curve_find("peano", &curve), CM_ERROR_CELL);
    ck_assert_int_eq(cm_curve_find(NULL, &curve), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_curve_find("morton", NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(curve, 7);
    ck_assert_int_eq(cm_curve_find("Morton", &curve), CM_OK);
    ck_assert_int_eq(curve, CM_CURVE_MORTON);
    ck_assert_int_eq(cm_curve_find("hilbert", &curve), CM_OK);
    ck_assert_int_eq(curve, CM_CURVE_HILBERT);
}
END_TEST

/* ---- Text ---- */

START_TEST(tokens)
{
    uint64_t state = 19;
    char text[CM_CELL_TOKEN_SIZE];
    char before[CM_CELL_TOKEN_SIZE] = "";
    for (int n = 0; n < 100000; n++)
    {
        cm_cell cell = random_cell(&state);
        cm_cell back = 1;
        REQUIRE(cm_cell_token(cell, text, sizeof text) == CM_OK &&
                    cm_cell_parse(text, &back, NULL, 0) == CM_OK && back == cell,
                "%llx is %s", (unsigned long long)cell, text);
        char expected[20];
        snprintf(expected, sizeof expected, "%016llx", (unsigned long long)cell);
        for (size_t end = strlen(expected); expected[end - 1] == '0'; end--)
        {
            expected[end - 1] = '\0';
        }
        REQUIRE(strcmp(text, expected) == 0, "%llx is %s", (unsigned long long)cell, text);
        REQUIRE(cm_cell_token(cell, text, strlen(expected)) == CM_ERROR_SPACE &&
                    cm_cell_token(cell, text, strlen(expected) + 1) == CM_OK,
                "%s in too little room", expected);
        for (char *c = text; *c != '\0'; c++)
        {
            *c = (char)(*c >= 'a' ? *c - 'a' + 'A' : *c);
        }
        back = 1;
        REQUIRE(cm_cell_parse(text, &back, NULL, 0) == CM_OK && back == cell, "%s", text);
    }
    /* texts sort as numbers do */
    for (uint64_t k = 0; k < cells_of(4); k++)
    {
        cm_cell_token(cm_cell_at_index(4, k), text, sizeof text);
        REQUIRE(strcmp(before, text) < 0, "%s is not before %s", before, text);
        memcpy(before, text, sizeof before);
    }
    cm_cell cell = 1;
    ck_assert_int_eq(cm_cell_token(CM_NO_CELL, text, 2), CM_OK);
    ck_assert_str_eq(text, "X");
    ck_assert_int_eq(cm_cell_token(CM_NO_CELL, text, 1), CM_ERROR_SPACE);
    ck_assert_int_eq(cm_cell_parse("X", &cell, NULL, 0), CM_OK);
    ck_assert(cell == CM_NO_CELL);
    cell = 1;
    ck_assert_int_eq(cm_cell_parse("x", &cell, NULL, 0), CM_OK);
    ck_assert(cell == CM_NO_CELL);
    ck_assert_int_eq(cm_cell_token(1, NULL, 20), CM_ERROR_ARGUMENT);
    for (size_t k = 1; k < sizeof none / sizeof none[0]; k++)
    {
        ck_assert_int_eq(cm_cell_token(none[k], text, sizeof text), CM_ERROR_CELL);
    }
    ck_assert_str_eq(text, "X");
}
END_TEST

START_TEST(texts_of_no_cell)
{
    static const char *const texts[] = {"",
                                        " ",
                                        "g",
                                        "1 ",
                                        " 1",
                                        "0x1",
                                        "-1",
                                        "XX",
                                        "1.0",
                                        "0",
                                        "00",
                                        "c01",
                                        "ffff",
                                        "2",
                                        "1\n",
                                        "10000000000000001",
                                        "0000000000000002",
                                        "89c259\xc3\xa9",
                                        "89c259c1111111111111111111"};
    char message[120];
    for (size_t k = 0; k < sizeof texts / sizeof texts[0]; k++)
    {
        cm_cell cell = 77;
        memset(message, 'z', sizeof message);
        ck_assert_msg(cm_cell_parse(texts[k], &cell, message, sizeof message) == CM_ERROR_CELL &&
                          cell == 77 && strlen(message) > 10 && strchr(message, '\n') == NULL,
                      "'%s': %s", texts[k], message);
        ck_assert_int_eq(cm_cell_parse(texts[k], &cell, message, 1), CM_ERROR_CELL);
        ck_assert_str_eq(message, "");
    }
    cm_cell cell = 77;
    ck_assert_int_eq(cm_cell_parse(NULL, &cell, message, sizeof message), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_cell_parse("1", NULL, NULL, 0), CM_ERROR_ARGUMENT);
    ck_assert(cell == 77);
}
END_TEST

/* ---- Sets ---- */

#define SET_LEVEL 4
#define SET_CELLS (6 << (2 * SET_LEVEL))

/* Which cells of a level are in one of the set? */
static void paint(size_t n, const cm_cell *cells, char painted[SET_CELLS])
{
    for (uint64_t k = 0; k < SET_CELLS; k++)
    {
        cm_cell small = cm_cell_at_index(SET_LEVEL, k);
        painted[k] = 0;
        for (size_t i = 0; i < n; i++)
        {
            painted[k] = (char)(painted[k] | cm_cell_contains(cells[i], small));
        }
    }
}

static void check_set(size_t n, const cm_cell *cells, const char painted[SET_CELLS])
{
    for (size_t i = 0; i < n; i++)
    {
        REQUIRE(cm_cell_is_valid(cells[i]) && (i == 0 || cells[i - 1] < cells[i]) &&
                    (i == 0 || !cm_cell_intersects(cells[i - 1], cells[i])),
                "not in order");
        cm_cell parent = cm_cell_parent(cells[i], cm_cell_level(cells[i]) - 1);
        REQUIRE(i + 3 >= n || parent == CM_NO_CELL || cells[i + 1] != cm_cell_child(parent, 1) ||
                    cells[i + 2] != cm_cell_child(parent, 2) ||
                    cells[i + 3] != cm_cell_child(parent, 3) ||
                    cells[i] != cm_cell_child(parent, 0),
                "four quarters");
    }
    for (int level = 0; level <= SET_LEVEL; level++)
    {
        for (uint64_t k = 0; k < cells_of(level); k++)
        {
            size_t size = (size_t)1 << (2 * (SET_LEVEL - level));
            size_t inside = 0;
            for (size_t i = 0; i < size; i++)
            {
                inside += painted[k * size + i] != 0 ? 1u : 0u;
            }
            cm_cell cell = cm_cell_at_index(level, k);
            REQUIRE(cm_cell_union_contains(n, cells, cell) == (inside == size) &&
                        cm_cell_union_intersects(n, cells, cell) == (inside > 0),
                    "%llx", (unsigned long long)cell);
        }
    }
}

START_TEST(sets)
{
    uint64_t state = 23;
    for (int n = 0; n < 60; n++)
    {
        cm_cell cells[400];
        char before[SET_CELLS];
        char after[SET_CELLS];
        size_t count = 1 + (size_t)(next_bits(&state) % 400);
        for (size_t i = 0; i < count; i++)
        {
            int level = SET_LEVEL - (next_bits(&state) % 8 == 0) - (next_bits(&state) % 32 == 0);
            /* close together, so that there are quarters to merge */
            uint64_t range = n % 3 == 0 ? cells_of(level) : 96;
            cells[i] = next_bits(&state) % 50 == 0
                           ? none[next_bits(&state) % (sizeof none / sizeof none[0])]
                           : cm_cell_at_index(level, next_bits(&state) % range);
        }
        paint(count, cells, before);
        size_t left = cm_cell_union_normalise(count, cells);
        ck_assert(left <= count);
        paint(left, cells, after);
        ck_assert(memcmp(before, after, sizeof before) == 0);
        check_set(left, cells, after);
        ck_assert(cm_cell_union_normalise(left, cells) == left);
    }
    cm_cell all[SET_CELLS];
    for (size_t i = 0; i < SET_CELLS; i++)
    {
        all[SET_CELLS - 1 - i] = cm_cell_at_index(SET_LEVEL, i);
    }
    ck_assert(cm_cell_union_normalise(SET_CELLS, all) == 6);
    ck_assert(cm_cell_union_normalise(0, NULL) == 0 && cm_cell_union_normalise(3, NULL) == 0);
    ck_assert(!cm_cell_union_contains(0, NULL, 1) && !cm_cell_union_intersects(0, NULL, 1));
    ck_assert(!cm_cell_union_contains(6, all, 2) && !cm_cell_union_intersects(6, all, 2));
}
END_TEST

int main(void)
{
    const TTest *tests[] = {every_place_of_low_levels,
                            quarters,
                            hilbert_walks_over_edges,
                            hilbert_by_table,
                            squares,
                            parents_and_ranges,
                            steps_along_the_curve,
                            what_is_no_cell,
                            what_is_no_place,
                            names_of_curves,
                            tokens,
                            texts_of_no_cell,
                            sets,
                            NULL};
    return run_suite("cells", tests);
}
