/* SPDX-License-Identifier: MIT
 *
 * Files of OctoMap, byte by byte as their format is told: what they say is there, and what is wrong with them is told in one
 * line.
 */
#define _POSIX_C_SOURCE 200809L /* mkstemp */

#include "tests/suite.h"

#include "modules/octree/block_access.h"
#include "modules/octree/io/octomap_file.h"
#include "modules/octree/io/vdb_file.h"

#include <unistd.h>

enum
{
    ROOM = 4096,
    LEVELS = 16
};

typedef struct file
{
    unsigned char bytes[ROOM];
    size_t count;
} file;

static void put(file *to, const void *bytes, size_t count)
{
    ck_assert_uint_le(to->count + count, sizeof to->bytes);
    memcpy(to->bytes + to->count, bytes, count);
    to->count += count;
}

static void put_text(file *to, const char *text)
{
    put(to, text, strlen(text));
}

static file begin(const char *first, const char *id, const char *size)
{
    file made = {.count = 0};
    put_text(&made, first);
    put_text(&made,
             "# (feel free to add / change comments, but leave the first line as it is!)\n#\nid ");
    put_text(&made, id);
    put_text(&made, "\nsize ");
    put_text(&made, size);
    put_text(&made, "\nres 0.1\ndata\n");
    return made;
}

static file begin_bits(const char *size)
{
    return begin("# Octomap OcTree binary file\n", "OcTree", size);
}

/* Two bits a child: 1 free, 2 occupied, 3 with children. */
static void put_codes(file *to, const int code[8])
{
    unsigned bits = 0;
    for (int i = 0; i < 8; i++)
    {
        bits |= (unsigned)code[i] << 2 * i;
    }
    const unsigned char bytes[2] = {(unsigned char)bits, (unsigned char)(bits >> 8)};
    put(to, bytes, sizeof bytes);
}

static cm_status parse(const file *from, cm_octree **map, char *message)
{
    *map = NULL;
    message[0] = '\0';
    return cm_octomap_parse("it", from->bytes, from->count, map, message);
}

static cm_octree *map_of(const file *from)
{
    cm_octree *map;
    char message[CM_IMAGE_MESSAGE];
    ck_assert_msg(parse(from, &map, message) == CM_OK, "%s", message);
    return map;
}

static void expect_state(const cm_octree *map, double x, double y, double z, int state)
{
    const double point[3] = {x, y, z};
    ck_assert_msg(cm_octree_at(map, point, 0, NULL) == state, "%g %g %g", x, y, z);
}

/* From the root along +x +y +z down to the voxels beside the centre: child 7 has children, its child 0, that one's child 0... */
static file chain_of_bits(int depth, const int last[8], const char *size)
{
    file made = begin_bits(size);
    put_codes(&made, (const int[8]){0, 0, 0, 0, 0, 0, 0, 3});
    for (int i = 1; i < depth; i++)
    {
        put_codes(&made, (const int[8]){3, 0, 0, 0, 0, 0, 0, 0});
    }
    put_codes(&made, last);
    return made;
}

START_TEST(bits)
{
    /* 15 inner nodes below the root, and three voxels */
    const int last[8] = {2, 1, 0, 0, 0, 0, 0, 2};
    const file made = chain_of_bits(LEVELS - 1, last, "19");
    cm_octree *map = map_of(&made);
    expect_state(map, 0.05, 0.05, 0.05, CM_VOXEL_OCCUPIED);
    expect_state(map, 0.15, 0.05, 0.05, CM_VOXEL_FREE);
    expect_state(map, 0.05, 0.15, 0.05, CM_VOXEL_UNKNOWN);
    expect_state(map, 0.15, 0.15, 0.15, CM_VOXEL_OCCUPIED);
    expect_state(map, -0.05, 0.05, 0.05, CM_VOXEL_UNKNOWN);
    ck_assert_double_eq(cm_octree_describe(map)->edge, 0.1);
    cm_octree_count count = {.size = sizeof count};
    ck_assert_int_eq(cm_octree_count_voxels(map, &count), CM_OK);
    ck_assert_uint_eq(count.occupied, 2);
    ck_assert_uint_eq(count.free, 1);
    cm_octree_destroy(map);
}
END_TEST

START_TEST(large_voxels_of_bits)
{
    for (int depth = 1; depth < LEVELS; depth++)
    {
        char size[20];
        snprintf(size, sizeof size, "%d", depth + 3);
        const file made = chain_of_bits(depth, (const int[8]){1, 2, 0, 0, 0, 0, 0, 0}, size);
        cm_octree *map = map_of(&made);
        const double edge = 0.1 * (double)(1 << (LEVELS - 1 - depth));
        expect_state(map, 0.5 * edge, 0.5 * edge, 0.5 * edge, CM_VOXEL_FREE);
        expect_state(map, 0.05, 0.05, 0.05, CM_VOXEL_FREE);
        expect_state(map, edge - 0.05, edge - 0.05, edge - 0.05, CM_VOXEL_FREE);
        expect_state(map, edge + 0.05, 0.05, 0.05, CM_VOXEL_OCCUPIED);
        expect_state(map, 2.0 * edge - 0.05, edge - 0.05, edge - 0.05, CM_VOXEL_OCCUPIED);
        expect_state(map, 0.05, edge + 0.05, 0.05, CM_VOXEL_UNKNOWN);
        expect_state(map, 0.05, 0.05, -0.05, CM_VOXEL_UNKNOWN);
        cm_octree_count count = {.size = sizeof count};
        ck_assert_int_eq(cm_octree_count_voxels(map, &count), CM_OK);
        const uint64_t voxels = (uint64_t)1 << 3 * (LEVELS - 1 - depth);
        ck_assert_uint_eq(count.occupied, voxels);
        ck_assert_uint_eq(count.free, voxels);
        cm_octree_destroy(map);
    }
}
END_TEST

/* The root alone: all of the map is one occupied voxel, as OctoMap reads it. */
static int add_occupied(void *user, const cm_voxel *voxel)
{
    ck_assert_int_eq(voxel->state, CM_VOXEL_OCCUPIED);
    *(double *)user += voxel->edge * voxel->edge * voxel->edge;
    return 0;
}

START_TEST(a_root_without_children_is_occupied)
{
    file made = begin_bits("1");
    put_codes(&made, (const int[8]){0});
    cm_octree *map = map_of(&made);
    const double half = 0.1 * (1 << (LEVELS - 1)), middle[3] = {0.05, 0.05, 0.05};
    expect_state(map, 0.05, 0.05, 0.05, CM_VOXEL_OCCUPIED);
    expect_state(map, 0.05 - half, half - 0.05, 0.05, CM_VOXEL_OCCUPIED);
    expect_state(map, half + 0.05, 0.05, 0.05, CM_VOXEL_UNKNOWN);
    cm_octree_count count = {.size = sizeof count};
    ck_assert_int_eq(cm_octree_count_voxels(map, &count), CM_OK);
    ck_assert_uint_eq(count.occupied, (uint64_t)1 << 3 * LEVELS);
    ck_assert_uint_eq(count.free, 0);
    cm_voxel voxel;
    ck_assert_int_eq(cm_octree_nearest(map, middle, 1.0, &voxel), 1);
    const double outside[3] = {half + 5.0, 0.05, 0.05}, left[3] = {-1.0, 0.0, 0.0};
    ck_assert_int_eq(cm_octree_nearest(map, outside, 6.0, &voxel), 1);
    ck_assert_int_eq(cm_octree_nearest(map, outside, 4.5, &voxel), 0);
    ck_assert_int_eq(cm_octree_ray(map, outside, left, 100.0, &voxel), 1);
    ck_assert_double_eq_tol(voxel.distance, 5.0, 1e-6);
    double volume = 0.0;
    const double low[3] = {1.0, 1.0, 1.0}, high[3] = {1.25, 1.25, 1.25};
    ck_assert_int_eq(cm_octree_walk_box(map, low, high, add_occupied, &volume), CM_OK);
    ck_assert_double_gt(volume, 0.25 * 0.25 * 0.25 - 1e-9);
    cm_octree_destroy(map);
    /* one node that says it has children has more than one */
    made = begin_bits("1");
    put_codes(&made, (const int[8]){1});
    char message[CM_IMAGE_MESSAGE];
    ck_assert_int_eq(parse(&made, &map, message), CM_ERROR_DATA);
}
END_TEST

/* ---- values */

static void put_value(file *to, float value, const unsigned char *color, unsigned char children)
{
    put(to, &value, sizeof value);
    if (color != NULL)
    {
        put(to, color, 3);
    }
    put(to, &children, 1);
}

static file chain_of_values(const char *id, int depth, const unsigned char *color, const char *size)
{
    file made = begin("# Octomap OcTree file\n", id, size);
    put_value(&made, 0.0f, color, 128);
    for (int i = 1; i < depth; i++)
    {
        put_value(&made, 0.0f, color, 1);
    }
    return made;
}

START_TEST(values)
{
    const float value[5] = {3.5f, 0.0f, -0.4f, -9.0f, 40.0f};
    const int alpha[5] = {254, 128, 112, 54, 254};
    file made = chain_of_values("OcTree", LEVELS - 1, NULL, "21");
    put_value(&made, 0.0f, NULL, 31);
    for (int i = 0; i < 5; i++)
    {
        put_value(&made, value[i], NULL, 0);
    }
    cm_octree *map = map_of(&made);
    for (int i = 0; i < 5; i++)
    {
        const double point[3] = {0.05 + 0.1 * (i & 1), 0.05 + 0.1 * (i >> 1 & 1),
                                 0.05 + 0.1 * (i >> 2)};
        cm_voxel voxel;
        cm_octree_at(map, point, 0, &voxel);
        ck_assert_int_eq(voxel.alpha, alpha[i]);
    }
    ck_assert_int_eq(cm_octree_describe(map)->rule, CM_OCTREE_LOG_ODDS);
    cm_octree_destroy(map);
}
END_TEST

START_TEST(colors)
{
    const unsigned char color[3] = {200, 100, 50};
    const unsigned char white[3] = {255, 255, 255};
    for (int depth = LEVELS - 6; depth < LEVELS; depth++)
    {
        char size[20];
        snprintf(size, sizeof size, "%d", depth + 4);
        file made = chain_of_values("ColorOcTree", depth, white, size);
        put_value(&made, 0.0f, white, 7);
        put_value(&made, 1.0f, color, 0);
        put_value(&made, 1.0f, white, 0);
        put_value(&made, -1.0f, color, 0);
        cm_octree *map = map_of(&made);
        const double edge = 0.1 * (double)(1 << (LEVELS - 1 - depth));
        cm_voxel voxel;
        cm_octree_at(map, (const double[3]){0.05, 0.05, edge - 0.05}, 0, &voxel);
        ck_assert_int_eq(voxel.state, CM_VOXEL_OCCUPIED);
        ck_assert_msg(voxel.has_color && abs(voxel.color[0] - 200) <= 1 &&
                          abs(voxel.color[2] - 50) <= 1,
                      "depth %d: %d %d", depth, voxel.color[0], voxel.color[2]);
        cm_octree_at(map, (const double[3]){edge + 0.05, 0.05, 0.05}, 0, &voxel);
        ck_assert(voxel.state == CM_VOXEL_OCCUPIED && voxel.has_color && voxel.color[1] >= 254);
        expect_state(map, 0.05, edge + 0.05, 0.05, CM_VOXEL_FREE);
        cm_octree_destroy(map);
    }
}
END_TEST

/* A colored leaf of 32 voxels each way has 8 bytes in a file: what is read must not take kilobytes for each of its 64 blocks until
 * all of the file is read. */
START_TEST(colored_blocks_are_small_at_once)
{
    const cm_octree_options options = {
        .size = sizeof options, .edge = 0.1, .levels = LEVELS, .color = 1};
    cm_octree *map;
    uint8_t alpha[CM_BLOCK_CELLS], color[CM_BLOCK_CELLS][3];
    ck_assert_int_eq(cm_octree_create(&options, &map), CM_OK);
    memset(alpha, 200, sizeof alpha);
    memset(color, 90, sizeof color);
    for (int64_t block = 0; block < 64; block++)
    {
        const int64_t corner[3] = {block % 4 * CM_BLOCK_EDGE, block / 4 % 4 * CM_BLOCK_EDGE,
                                   block / 16 * CM_BLOCK_EDGE};
        ck_assert_int_eq(cm_octree_set_block(map, corner, alpha, (const uint8_t(*)[3])color),
                         CM_OK);
    }
    cm_octree_count count = {.size = sizeof count};
    ck_assert_int_eq(cm_octree_count_voxels(map, &count), CM_OK);
    ck_assert_uint_eq(count.occupied, 64 * CM_BLOCK_CELLS);
    ck_assert_uint_lt(count.bytes, 30000);
    cm_voxel voxel;
    cm_octree_at(map, (const double[3]){3.15, 3.15, 3.15}, 0, &voxel);
    ck_assert(voxel.alpha == 200 && abs(voxel.color[1] - 90) <= 1);
    cm_octree_destroy(map);
}
END_TEST

START_TEST(empty_maps)
{
    const file none = begin_bits("0");
    cm_octree *map = map_of(&none);
    expect_state(map, 0.05, 0.05, 0.05, CM_VOXEL_UNKNOWN);
    cm_octree_destroy(map);
    file whole = begin("# Octomap OcTree file\n", "OcTree", "1");
    put_value(&whole, -1.0f, NULL, 0);
    map = map_of(&whole);
    expect_state(map, -3000.0, 3000.0, 12.0, CM_VOXEL_FREE);
    expect_state(map, 3300.0, 0.0, 0.0, CM_VOXEL_UNKNOWN);
    cm_octree_destroy(map);
}
END_TEST

/* ---- what is wrong */

static void refuses(const file *from, cm_status status, const char *words)
{
    cm_octree *map;
    char message[CM_IMAGE_MESSAGE];
    const cm_status got = parse(from, &map, message);
    ck_assert_msg(got == status, "%d: %s", (int)got, message);
    ck_assert_ptr_null(map);
    ck_assert_msg(strncmp(message, "it: ", 4) == 0 && strstr(message, words) != NULL &&
                      strchr(message, '\n') == NULL,
                  "%s", message);
}

START_TEST(files_that_are_cut)
{
    const file whole = chain_of_bits(LEVELS - 1, (const int[8]){2, 1, 0, 0, 0, 0, 0, 2}, "19");
    for (size_t count = 0; count < whole.count; count++)
    {
        file cut = whole;
        cut.count = count;
        refuses(&cut, CM_ERROR_DATA, "");
    }
    file more = whole;
    put(&more, "", 1);
    refuses(&more, CM_ERROR_DATA, "goes on behind its last node");
}
END_TEST

START_TEST(numbers_of_nodes)
{
    const int last[8] = {2, 1, 0, 0, 0, 0, 0, 2};
    const char *const wrong[] = {
        "18", "20", "4294967315", "18446744073709551616", "99999999999999999999999",
        "-1", "x",  "0"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
    {
        const file made = chain_of_bits(LEVELS - 1, last, wrong[i]);
        refuses(&made, CM_ERROR_DATA, "");
    }
}
END_TEST

START_TEST(nodes_below_the_finest)
{
    const file deep = chain_of_bits(LEVELS, (const int[8]){0}, "17");
    refuses(&deep, CM_ERROR_DATA, "below its finest voxels");
    file below = chain_of_values("OcTree", LEVELS + 1, NULL, "18");
    put_value(&below, 0.0f, NULL, 0);
    refuses(&below, CM_ERROR_DATA, "below its finest voxels");
}
END_TEST

START_TEST(heads)
{
    const char *const wrong[] = {"",
                                 "\n",
                                 "# Octomap\n",
                                 "# Octomap OcTree binary file",
                                 "# Octomap OcTree binary file\nid OcTree\nsize 1\ndata\n",
                                 "# Octomap OcTree binary file\nid OcTree\nres 0.1\ndata\n",
                                 "# Octomap OcTree binary file\nsize 1\nres 0\ndata\n",
                                 "# Octomap OcTree binary file\nsize 1\nres -0.1\ndata\n",
                                 "# Octomap OcTree binary file\nsize 1\nres nan\ndata\n",
                                 "# Octomap OcTree binary file\nsize 1\nres inf\ndata\n",
                                 "# Octomap OcTree binary file\nsize 0\nres 1e308\ndata\n",
                                 "# Octomap OcTree binary file\nsize 0\nres 1e-320\ndata\n",
                                 "# Octomap OcTree binary file\nsize\nres 0.1\ndata\n"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
    {
        file made = {.count = 0};
        put_text(&made, wrong[i]);
        refuses(&made, CM_ERROR_DATA, "");
    }
    file other = begin("# Octomap OcTree file\n", "CountingOcTree", "1");
    put_value(&other, 1.0f, NULL, 0);
    refuses(&other, CM_ERROR_UNSUPPORTED, "CountingOcTree");
    file bad = begin("# Octomap OcTree file\n", "OcTree", "1");
    put_value(&bad, (float)NAN, NULL, 0);
    refuses(&bad, CM_ERROR_DATA, "not finite");
}
END_TEST

START_TEST(arguments)
{
    cm_octree *map = NULL;
    char message[CM_IMAGE_MESSAGE];
    ck_assert_int_eq(cm_octomap_parse(NULL, "", 0, &map, message), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_octomap_parse("it", NULL, 1, &map, message), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_octomap_parse("it", "", 0, NULL, message), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_octomap_read(NULL, &map, message), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_octomap_read("/nonexistent/a.bt", &map, message), CM_ERROR_FILE);
    ck_assert_ptr_nonnull(strstr(message, "/nonexistent/a.bt"));
    ck_assert_int_eq(cm_octomap_read("/", &map, message), CM_ERROR_FILE);
    ck_assert_ptr_null(map);
    ck_assert_int_eq(cm_vdb_write(NULL, "it", NULL, 0, 0, NULL, message), CM_ERROR_ARGUMENT);
}
END_TEST

START_TEST(grids_of_openvdb)
{
    const cm_octree_options options = {
        .size = sizeof options, .edge = 0.1, .levels = 8, .color = 1};
    const cm_voxel voxel[2] = {{.x = 0.05,
                                .y = 0.05,
                                .z = -0.05,
                                .edge = 0.1,
                                .alpha = 255,
                                .state = CM_VOXEL_OCCUPIED,
                                .has_color = 1},
                               {.x = 0.2,
                                .y = 0.2,
                                .z = 0.2,
                                .edge = 0.2,
                                .level = 1,
                                .alpha = 200,
                                .state = CM_VOXEL_OCCUPIED}};
    char name[] = "/tmp/cubemap-octree-XXXXXX";
    const int descriptor = mkstemp(name);
    ck_assert_int_ge(descriptor, 0);
    close(descriptor);
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_status status = cm_vdb_write(name, "it", &options, 0, 2, voxel, message);
    if (cm_vdb_is_there())
    {
        ck_assert_msg(status == CM_OK, "%s", message);
        FILE *written = fopen(name, "rb");
        char head[4] = "";
        ck_assert_uint_eq(fread(head, 1, 4, written), 4);
        fclose(written);
        ck_assert_int_eq(memcmp(head, " BDV", 4), 0);
        ck_assert_int_eq(cm_vdb_write("/nonexistent/a.vdb", "it", &options, 0, 2, voxel, message),
                         CM_ERROR_FILE);
    }
    else
    {
        ck_assert_int_eq(status, CM_ERROR_UNSUPPORTED);
    }
    unlink(name);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {bits,
                                  large_voxels_of_bits,
                                  a_root_without_children_is_occupied,
                                  values,
                                  colors,
                                  colored_blocks_are_small_at_once,
                                  empty_maps,
                                  files_that_are_cut,
                                  numbers_of_nodes,
                                  nodes_below_the_finest,
                                  heads,
                                  arguments,
                                  grids_of_openvdb,
                                  NULL};
    return run_suite("octree files", tests);
}
