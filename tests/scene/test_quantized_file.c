/* SPDX-License-Identifier: MIT
 *
 * glTF files with KHR_mesh_quantization: positions, normals and texture coordinates are bytes or shorts, normalised or not, and
 * the node's transform gives them their size.
 */
#define _POSIX_C_SOURCE 200809L

#include "read_meshes.h"
#include "written_files.h"

#include "tests/suite.h"

#include <unistd.h>

/* Four vertices of each kind, four numbers apart, as the extension wants its strides; normals and texture coordinates. */
typedef struct quantized_buffer
{
    int8_t byte[16];
    uint8_t whole_byte[16];
    int16_t shorts[16];
    uint16_t whole_short[16];
    int8_t normal[16];
    uint16_t texture[8];
    uint32_t longs[16];
    int16_t index[4];
} quantized_buffer;

static const quantized_buffer numbers = {
    {-128, -127, 127, 0, 0, 1, -1, 0, 64, -64, 2, 0, 3, 4, 5, 0},
    {0, 255, 51, 0, 1, 2, 3, 0, 254, 85, 0, 0, 128, 64, 32, 0},
    {-32768, -32767, 32767, 0, 0, 1, -1, 0, 16384, -16384, 2, 0, 3, 4, 5, 0},
    {0, 65535, 13107, 0, 1, 2, 3, 0, 256, 21845, 0, 0, 4096, 64, 32, 0},
    {0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, -128, 0},
    {0, 0, 65535, 0, 0, 65535, 65535, 65535},
    {0, 1, 2, 0, 3, 4, 5, 0, 6, 7, 8, 0, 9, 10, 11, 0},
    {0, 1, 2, -1}};

static const char quantization[] = "\"KHR_mesh_quantization\"";

/* The node's matrix doubles x, halves y, and moves z by 10. */
static void write_quantized(const char *extensions, const char *position, const char *others,
                            const char *parts)
{
    char text[4000];
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},%s\"scenes\":[{\"nodes\":[0]}],"
             "\"nodes\":[{\"mesh\":0,\"scale\":[2,0.5,1],\"translation\":[0,0,10]}],"
             "\"meshes\":[{\"primitives\":[{\"mode\":5,\"attributes\":{\"POSITION\":0,"
             "\"NORMAL\":1,\"TEXCOORD_0\":2%s}]}],\"accessors\":[{%s\"count\":4,\"type\":\"VEC3\"},"
             "{\"bufferView\":4,\"componentType\":5120,\"normalized\":true,\"count\":4,"
             "\"type\":\"VEC3\"},{\"bufferView\":5,\"componentType\":5123,\"normalized\":true,"
             "\"count\":4,\"type\":\"VEC2\"},{%s\"count\":4}],\"bufferViews\":["
             "{\"buffer\":0,\"byteLength\":16,\"byteStride\":4},"
             "{\"buffer\":0,\"byteOffset\":16,\"byteLength\":16,\"byteStride\":4},"
             "{\"buffer\":0,\"byteOffset\":32,\"byteLength\":32,\"byteStride\":8},"
             "{\"buffer\":0,\"byteOffset\":64,\"byteLength\":32,\"byteStride\":8},"
             "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":16,\"byteStride\":4},"
             "{\"buffer\":0,\"byteOffset\":112,\"byteLength\":16},"
             "{\"buffer\":0,\"byteOffset\":128,\"byteLength\":64,\"byteStride\":16},"
             "{\"buffer\":0,\"byteOffset\":192,\"byteLength\":8}],"
             "\"buffers\":[{\"uri\":\"quantized.bin\",\"byteLength\":200}]}",
             extensions, parts, position, others);
    write_file("quantized.bin", &numbers, sizeof numbers);
    write_text("quantized.gltf", text);
}

#define REQUIRED "\"extensionsRequired\":[\"KHR_mesh_quantization\"],"
#define USED "\"extensionsUsed\":[\"KHR_mesh_quantization\",\"KHR_texture_transform\"],"
#define FLOATS "\"bufferView\":6,\"componentType\":5126,\"type\":\"VEC3\","

/* The number of a kind's vertex as the file means it. */
static double meant(int kind, int normalized, size_t which)
{
    const double stored[] = {numbers.byte[which], numbers.whole_byte[which], numbers.shorts[which],
                             numbers.whole_short[which]};
    const double one[] = {127, 255, 32767, 65535};
    const double value = normalized ? stored[kind] / one[kind] : stored[kind];
    return normalized && value < -1 ? -1 : value;
}

START_TEST(bytes_and_shorts_are_positions)
{
    static const int types[] = {5120, 5121, 5122, 5123};
    static const char *const normalized[] = {"", "\"normalized\":true,", "\"normalized\":false,"};
    for (int i = 0; i < 4 * 3 * 2; i++)
    {
        const int kind = i % 4, is_normalized = i / 4 % 3 == 1;
        char position[200];
        snprintf(position, sizeof position, "\"bufferView\":%d,%s\"componentType\":%d,", kind,
                 normalized[i / 4 % 3], types[kind]);
        write_quantized(i < 12 ? REQUIRED : USED, position, FLOATS, "}");
        cm_mesh *mesh = read_good("quantized.gltf");
        const cm_mesh_options *has = cm_mesh_describe(mesh);
        ck_assert_uint_eq(has->vertex_count, 4);
        ck_assert_uint_eq(has->triangle_count, 2);
        for (size_t v = 0; v < 4; v++)
        {
            check_vertex(mesh, v, 2 * meant(kind, is_normalized, 4 * v),
                         0.5 * meant(kind, is_normalized, 4 * v + 1),
                         10 + meant(kind, is_normalized, 4 * v + 2));
        }
        cm_mesh_destroy(mesh);
    }
}
END_TEST

/* The largest numbers by hand: -128 and -127 are both -1, 127 is 1. */
START_TEST(normalised_numbers_end_at_one)
{
    write_quantized(REQUIRED, "\"bufferView\":0,\"normalized\":true,\"componentType\":5120,",
                    FLOATS, "}");
    cm_mesh *mesh = read_good("quantized.gltf");
    check_vertex(mesh, 0, -2, -0.5, 11);
    cm_mesh_destroy(mesh);
    write_quantized(REQUIRED, "\"bufferView\":3,\"normalized\":true,\"componentType\":5123,",
                    FLOATS, "}");
    mesh = read_good("quantized.gltf");
    check_vertex(mesh, 0, 0, 0.5, 10.2);
    cm_mesh_destroy(mesh);
}
END_TEST

/* Some of them stand elsewhere, as numbers of the same kind. */
START_TEST(sparse_positions_are_quantized_too)
{
    write_quantized(REQUIRED,
                    "\"bufferView\":2,\"componentType\":5122,\"sparse\":{\"count\":1,\"indices\":{"
                    "\"bufferView\":7,\"byteOffset\":2,\"componentType\":5123},\"values\":{"
                    "\"bufferView\":2,\"byteOffset\":16}},",
                    FLOATS, "}");
    cm_mesh *mesh = read_good("quantized.gltf");
    check_vertex(mesh, 1, 32768, -8192, 12);
    check_vertex(mesh, 2, 32768, -8192, 12);
    check_vertex(mesh, 3, 6, 2, 15);
    cm_mesh_destroy(mesh);
}
END_TEST

START_TEST(what_the_extension_does_not_allow_is_refused)
{
    static const struct
    {
        const char *extensions, *position, *others, *parts, *words;
    } wrong[] = {{"", "\"bufferView\":2,\"componentType\":5122,", FLOATS, "}",
                  "does not name the extension KHR_mesh_quantization"},
                 {"\"extensionsUsed\":[\"KHR_texture_transform\"],",
                  "\"bufferView\":0,\"componentType\":5120,", FLOATS, "}",
                  "does not name the extension KHR_mesh_quantization"},
                 {REQUIRED, "\"bufferView\":6,\"componentType\":5125,", FLOATS, "}",
                  "has positions that are no three floats, bytes or shorts"},
                 {REQUIRED, "\"bufferView\":6,\"componentType\":5124,", FLOATS, "}",
                  "has positions that are no three floats, bytes or shorts"},
                 {REQUIRED, "\"bufferView\":0,\"componentType\":5120,\"normalized\":1,", FLOATS,
                  "}", ":1: has accessor 0, whose normalized is 1, not true or false"},
                 {REQUIRED, "\"bufferView\":0,\"componentType\":5120,\"normalized\":\"true\",",
                  FLOATS, "}", ":1: has accessor 0, whose normalized is not true or false"},
                 {REQUIRED, "\"bufferView\":0,\"byteOffset\":2,\"componentType\":5120,", FLOATS,
                  "}", "has accessor 0, which ends behind its buffer view"},
                 {REQUIRED, "\"bufferView\":0,\"componentType\":5120,",
                  "\"bufferView\":0,\"componentType\":5120,\"normalized\":true,\"type\":\"VEC3\",",
                  ",\"COLOR_0\":3}",
                  "has colours that are neither floats nor unsigned bytes or shorts"},
                 {REQUIRED, "\"bufferView\":0,\"componentType\":5120,",
                  "\"bufferView\":7,\"componentType\":5122,\"type\":\"SCALAR\",", "},\"indices\":3",
                  "has indices that are no whole numbers"},
                 {REQUIRED, "\"bufferView\":0,\"componentType\":5120,",
                  "\"bufferView\":7,\"componentType\":5120,\"type\":\"SCALAR\",", "},\"indices\":3",
                  "has indices that are no whole numbers"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
    {
        write_quantized(wrong[i].extensions, wrong[i].position, wrong[i].others, wrong[i].parts);
        refused("quantized.gltf", CM_ERROR_DATA, wrong[i].words);
    }
}
END_TEST

/* What changes looks alone is no reason to refuse a mesh; what changes geometry is named. */
START_TEST(extensions_of_looks_are_read_and_others_named)
{
    static const char *const looks[] = {"KHR_texture_transform", "KHR_texture_basisu",
                                        "EXT_texture_webp",      "EXT_texture_avif",
                                        "MSFT_texture_dds",      "KHR_materials_unlit"};
    static const char *const others[] = {"EXT_meshopt_compression", "KHR_draco_mesh_compression",
                                         "KHR_meshopt_compression", "EXT_mesh_gpu_instancing",
                                         "KHR_mesh_quantization2"};
    char extensions[200], words[200];
    for (size_t i = 0; i < sizeof looks / sizeof *looks; i++)
    {
        snprintf(extensions, sizeof extensions, "\"extensionsRequired\":[%s,\"%s\"],", quantization,
                 looks[i]);
        write_quantized(extensions, "\"bufferView\":0,\"componentType\":5120,", FLOATS, "}");
        cm_mesh_destroy(read_good("quantized.gltf"));
    }
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
    {
        snprintf(extensions, sizeof extensions, "\"extensionsRequired\":[%s,\"%s\"],", quantization,
                 others[i]);
        write_quantized(extensions, "\"bufferView\":0,\"componentType\":5120,", FLOATS, "}");
        snprintf(words, sizeof words, "needs the extension %s, which is not read", others[i]);
        refused("quantized.gltf", CM_ERROR_DATA, words);
    }
}
END_TEST

int main(void)
{
    if (chdir(test_folder()) != 0)
    {
        return 1;
    }
    const TTest *const tests[] = {bytes_and_shorts_are_positions,
                                  normalised_numbers_end_at_one,
                                  sparse_positions_are_quantized_too,
                                  what_the_extension_does_not_allow_is_refused,
                                  extensions_of_looks_are_read_and_others_named,
                                  NULL};
    return run_suite("quantized file", tests);
}
