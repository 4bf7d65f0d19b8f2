/* SPDX-License-Identifier: MIT
 *
 * Sparse accessors of glTF files: some numbers stand elsewhere than the rest, or than 0.
 */
#define _POSIX_C_SOURCE 200809L

#include "read_meshes.h"
#include "written_files.h"

#include "tests/suite.h"

#include <unistd.h>

/* Corners of a square; indices of all three kinds, of the second and the last corner; where these are moved to; two triangles,
 * and what the second one's last index is instead; and white of shorts. */
typedef struct sparse_buffer
{
    float position[12];
    uint32_t long_which[2];
    uint16_t short_which[2];
    uint8_t byte_which[4];
    float moved[6];
    uint16_t index[6];
    uint16_t other[2];
    uint16_t white[4];
} sparse_buffer;

static const sparse_buffer numbers = {{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0},
                                      {1, 3},
                                      {1, 3},
                                      {1, 3, 5, 4},
                                      {5, 6, 7, 8, 9, 10},
                                      {0, 1, 2, 1, 3, 0},
                                      {2, 0},
                                      {65535, 65535, 65535, 65535}};

enum
{
    POSITIONS,
    LONG_WHICH,
    SHORT_WHICH,
    BYTE_WHICH,
    MOVED,
    INDICES,
    OTHER,
    WHITE
};

static void write_sparse(const char *accessors, const char *primitive)
{
    char text[4000];
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],"
             "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{%s}}]}],"
             "\"accessors\":[%s],\"bufferViews\":["
             "{\"buffer\":0,\"byteLength\":48},"
             "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":8},"
             "{\"buffer\":0,\"byteOffset\":56,\"byteLength\":4},"
             "{\"buffer\":0,\"byteOffset\":60,\"byteLength\":4},"
             "{\"buffer\":0,\"byteOffset\":64,\"byteLength\":24},"
             "{\"buffer\":0,\"byteOffset\":88,\"byteLength\":12},"
             "{\"buffer\":0,\"byteOffset\":100,\"byteLength\":4},"
             "{\"buffer\":0,\"byteOffset\":104,\"byteLength\":8}],"
             "\"buffers\":[{\"uri\":\"sparse.bin\",\"byteLength\":112}]}",
             primitive, accessors);
    write_file("sparse.bin", &numbers, sizeof numbers);
    write_text("sparse.gltf", text);
}

/* The accessor of positions: `base` is its buffer view and a comma, or nothing. */
static void write_positions(const char *base, unsigned long long count, const char *sparse)
{
    char accessor[1000];
    snprintf(accessor, sizeof accessor,
             "{%s\"componentType\":5126,\"count\":%llu,\"type\":\"VEC3\",\"sparse\":{%s}},"
             "{\"bufferView\":5,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\","
             "\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":3,\"byteOffset\":2,"
             "\"componentType\":5121},\"values\":{\"bufferView\":6}}}",
             base, count, sparse);
    write_sparse(accessor, "\"POSITION\":0},\"indices\":1,\"extras\":{");
}

#define BASE "\"bufferView\":0,"

static void words_of(char *to, size_t room, int count, int view, int offset, int type,
                     const char *values)
{
    snprintf(to, room,
             "\"count\":%d,\"indices\":{\"bufferView\":%d,\"byteOffset\":%d,"
             "\"componentType\":%d},\"values\":{%s}",
             count, view, offset, type, values);
}

START_TEST(some_numbers_stand_elsewhere)
{
    static const int kinds[][2] = {{LONG_WHICH, 5125}, {SHORT_WHICH, 5123}, {BYTE_WHICH, 5121}};
    char sparse[400];
    for (int i = 0; i < 3; i++)
    {
        words_of(sparse, sizeof sparse, 2, kinds[i][0], 0, kinds[i][1], "\"bufferView\":4");
        write_positions(BASE, 4, sparse);
        cm_mesh *mesh = read_good("sparse.gltf");
        const cm_mesh_options *has = cm_mesh_describe(mesh);
        ck_assert_uint_eq(has->vertex_count, 4);
        check_vertex(mesh, 0, 0, 0, 0);
        check_vertex(mesh, 1, 5, 6, 7);
        check_vertex(mesh, 2, 0, 1, 0);
        check_vertex(mesh, 3, 8, 9, 10);
        check_color(mesh, 1, 1, 1, 1);
        ck_assert(has->index[4] == 3 && has->index[5] == 2); /* 0 in the list of all */
        cm_mesh_destroy(mesh);
    }
    words_of(sparse, sizeof sparse, 1, LONG_WHICH, 4, 5125, "\"bufferView\":4,\"byteOffset\":12");
    write_positions(BASE, 4, sparse);
    cm_mesh *mesh = read_good("sparse.gltf");
    check_vertex(mesh, 1, 1, 0, 0);
    check_vertex(mesh, 3, 8, 9, 10);
    cm_mesh_destroy(mesh);
}
END_TEST

START_TEST(without_a_view_the_rest_is_zero)
{
    char sparse[400];
    words_of(sparse, sizeof sparse, 2, BYTE_WHICH, 0, 5121, "\"bufferView\":4");
    write_positions("", 4, sparse);
    cm_mesh *mesh = read_good("sparse.gltf");
    check_vertex(mesh, 1, 5, 6, 7);
    check_vertex(mesh, 2, 0, 0, 0);
    cm_mesh_destroy(mesh);
    write_sparse("{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
                 "{\"componentType\":5123,\"normalized\":true,\"count\":4,\"type\":\"VEC4\","
                 "\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":3,\"componentType\":5121},"
                 "\"values\":{\"bufferView\":7}}}",
                 "\"POSITION\":0,\"COLOR_0\":1");
    mesh = read_good("sparse.gltf");
    check_color(mesh, 0, 0, 0, 0);
    check_color(mesh, 1, 1, 1, 1);
    cm_mesh_destroy(mesh);
}
END_TEST

START_TEST(what_is_wrong_is_one_line)
{
    static const struct
    {
        int count, view, offset, type;
        const char *values, *words;
    } wrong[] = {
        {3, BYTE_WHICH, 0, 5121, "\"bufferView\":0", "do not rise below its count"}, /* 5 */
        {2, BYTE_WHICH, 2, 5121, "\"bufferView\":4", "do not rise below its count"}, /* 5, 4 */
        {2, INDICES, 0, 5121, "\"bufferView\":4", "do not rise below its count"},    /* 0, 0 */
        {2, LONG_WHICH, 0, 5126, "\"bufferView\":4", "no whole numbers"},
        {3, LONG_WHICH, 0, 5125, "\"bufferView\":0", "indices, which ends behind"},
        {2, LONG_WHICH, 4, 5125, "\"bufferView\":4", "indices, which ends behind"},
        {2, LONG_WHICH, 0, 5125, "\"bufferView\":4,\"byteOffset\":4", "values, which ends behind"},
        {2, LONG_WHICH, 0, 5125, "\"bufferView\":8", "buffer view that is not there"},
        {2, 8, 0, 5125, "\"bufferView\":4", "buffer view that is not there"},
        {-1, LONG_WHICH, 0, 5125, "\"bufferView\":4", "whose count is -1"},
        {2, LONG_WHICH, -4, 5125, "\"bufferView\":4", "whose byteOffset is -4"},
        {2, LONG_WHICH, 0, 5125, "\"bufferView\":4,\"byteOffset\":0.5", "whose byteOffset is 0.5"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
    {
        char sparse[400];
        words_of(sparse, sizeof sparse, wrong[i].count, wrong[i].view, wrong[i].offset,
                 wrong[i].type, wrong[i].values);
        write_positions(BASE, 4, sparse);
        refused("sparse.gltf", CM_ERROR_DATA, wrong[i].words);
    }
}
END_TEST

/* Few bytes may ask for very many vertices. */
START_TEST(zeros_are_not_too_many)
{
    char sparse[400];
    words_of(sparse, sizeof sparse, 2, BYTE_WHICH, 0, 5121, "\"bufferView\":4");
    write_positions("", (1 << 24) + 1, sparse);
    refused("sparse.gltf", CM_ERROR_DATA, "of more than 16777216 elements without");
    write_positions("", 2000000000, sparse);
    refused("sparse.gltf", CM_ERROR_DATA, "of more than 16777216 elements without");
    write_positions("", 1ull << 40, sparse);
    refused("sparse.gltf", CM_ERROR_DATA, "has an accessor that is none");
}
END_TEST

int main(void)
{
    if (chdir(test_folder()) != 0)
    {
        return 1;
    }
    const TTest *const tests[] = {some_numbers_stand_elsewhere, without_a_view_the_rest_is_zero,
                                  what_is_wrong_is_one_line, zeros_are_not_too_many, NULL};
    return run_suite("sparse file", tests);
}
