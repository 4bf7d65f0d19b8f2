/* SPDX-License-Identifier: MIT
 *
 * Meshes from files: what glTF says is what is read, and whatever is wrong is one line, the end of the reader too.
 */
#define _POSIX_C_SOURCE 200809L

#include "read_meshes.h"
#include "written_files.h"

#include "tests/suite.h"

#include <math.h>
#include <sys/stat.h>
#include <unistd.h>

/* Four corners of a square, then two triangles, then colours of a byte. */
typedef struct square_buffer
{
    float position[12];
    uint16_t index[6];
    uint8_t color[16];
} square_buffer;

static const square_buffer square = {
    {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0},
    {0, 1, 2, 1, 3, 2},
    {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 51, 51, 51, 255}};

/* Nodes, what the primitive has, and the buffer, as JSON. */
static void write_gltf_of_views(const char *name, const char *nodes, const char *primitive,
                                const char *views, const char *buffer)
{
    char text[4000];
    snprintf(
        text, sizeof text,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[%s],"
        "\"meshes\":[{\"primitives\":[{%s}]}],"
        "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.25,0.5,1,1]}}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"},"
        "{\"bufferView\":2,\"componentType\":5121,\"normalized\":true,\"count\":4,\"type\":"
        "\"VEC4\"}],"
        "\"bufferViews\":[%s],\"buffers\":[%s]}",
        nodes, primitive, views, buffer);
    write_text(name, text);
}

#define FIRST_VIEWS                                                                                \
    "{\"buffer\":0,\"byteOffset\":0,\"byteLength\":48},"                                           \
    "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":12}"

static void write_gltf(const char *name, const char *nodes, const char *primitive,
                       const char *buffer)
{
    write_gltf_of_views(name, nodes, primitive,
                        FIRST_VIEWS ",{\"buffer\":0,\"byteOffset\":60,\"byteLength\":16}", buffer);
}

#define NODES                                                                                      \
    "{\"children\":[1],\"translation\":[1,2,3]},{\"mesh\":0,\"scale\":[2,2,2],"                    \
    "\"rotation\":[0,0,0.70710678118654752,0.70710678118654752]}"
#define ONE_NODE "{\"mesh\":0}"
#define INDEXED "\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":0"
#define BUFFER "{\"uri\":\"square.bin\",\"byteLength\":76}"

START_TEST(nodes_move_what_they_have)
{
    write_file("square.bin", &square, sizeof square);
    write_gltf("a.gltf", NODES, INDEXED, BUFFER);
    cm_mesh *mesh = read_good("a.gltf");
    const cm_mesh_options *has = cm_mesh_describe(mesh);
    ck_assert_uint_eq(has->vertex_count, 4);
    ck_assert_uint_eq(has->triangle_count, 2);
    ck_assert_uint_eq(has->index[4], 3);
    check_vertex(mesh, 0, 1, 2, 3);
    check_vertex(mesh, 1, 1, 4, 3); /* x becomes y */
    check_vertex(mesh, 2, -1, 2, 3);
    check_color(mesh, 3, 0.25, 0.5, 1);
    cm_mesh_destroy(mesh);
}
END_TEST

START_TEST(strips_without_indices_and_their_colours)
{
    write_file("square.bin", &square, sizeof square);
    write_gltf("strip.gltf", "{\"mesh\":0,\"matrix\":[1,0,0,0, 0,0,1,0, 0,-1,0,0, 5,6,7,1]}",
               "\"attributes\":{\"POSITION\":0,\"COLOR_0\":2},\"mode\":5", BUFFER);
    cm_mesh *mesh = read_good("strip.gltf");
    const cm_mesh_options *has = cm_mesh_describe(mesh);
    ck_assert_uint_eq(has->triangle_count, 2);
    ck_assert(has->index[3] == 1 && has->index[4] == 2 && has->index[5] == 3);
    check_vertex(mesh, 3, 6, 6, 8); /* y becomes z */
    check_color(mesh, 0, 1, 0, 0);
    check_color(mesh, 3, 0.2, 0.2, 0.2);
    cm_mesh_destroy(mesh);
    write_gltf("points.gltf", ONE_NODE, "\"attributes\":{\"POSITION\":0},\"mode\":0", BUFFER);
    mesh = read_good("points.gltf");
    ck_assert_uint_eq(cm_mesh_describe(mesh)->triangle_count, 0);
    cm_mesh_destroy(mesh);
}
END_TEST

static void put_word(uint8_t *to, uint32_t word)
{
    memcpy(to, &word, sizeof word);
}

/* The text as a binary file of at most so many bytes, with the square's; how many it has. */
static size_t make_binary(uint8_t *bytes, size_t room)
{
    memset(bytes, 0, room);
    write_gltf("text.gltf", NODES, INDEXED, "{\"byteLength\":76}");
    FILE *file = fopen("text.gltf", "rb");
    ck_assert_ptr_nonnull(file);
    size_t length = fread(bytes + 20, 1, room - 100 - sizeof square, file);
    fclose(file);
    while (length % 4 != 0)
    {
        bytes[20 + length++] = ' ';
    }
    const size_t whole = 20 + length + 8 + sizeof square;
    put_word(bytes, 0x46546c67);
    put_word(bytes + 4, 2);
    put_word(bytes + 8, (uint32_t)whole);
    put_word(bytes + 12, (uint32_t)length);
    put_word(bytes + 16, 0x4e4f534a);
    put_word(bytes + 20 + length, sizeof square);
    put_word(bytes + 24 + length, 0x004e4942);
    memcpy(bytes + 28 + length, &square, sizeof square);
    return whole;
}

START_TEST(a_binary_file_is_the_same)
{
    uint8_t bytes[5000];
    const size_t whole = make_binary(bytes, sizeof bytes);
    write_file("b.glb", bytes, whole);
    cm_mesh *mesh = read_good("b.glb");
    check_vertex(mesh, 1, 1, 4, 3);
    cm_mesh_destroy(mesh);
    for (size_t cut = 0; cut < whole; cut += 7) /* whatever is left is no mesh, or one */
    {
        char message[CM_IMAGE_MESSAGE] = "";
        write_file("cut.glb", bytes, cut);
        mesh = NULL;
        const cm_status status = cm_mesh_file_read("cut.glb", NULL, &mesh, message);
        REQUIRE(status == CM_ERROR_DATA && message[0] != '\0', "%zu: %d", cut, (int)status);
    }
}
END_TEST

/* Of another version, or with chunks that are longer than the file by as little as 4 bytes. */
START_TEST(binary_files_are_what_they_say)
{
    uint8_t bytes[5000];
    const size_t whole = make_binary(bytes, sizeof bytes);
    const size_t chunk = whole - sizeof square - 8;
    const struct
    {
        size_t place;
        uint32_t word;
        const char *words;
    } cases[] = {{4, 1, ": is a binary file of version 1, which is not read; 2 is"},
                 {4, 3, ": is a binary file of version 3, which is not read; 2 is"},
                 {8, (uint32_t)whole + 1, " as it says"},
                 {chunk, sizeof square + 4, ": has a chunk that ends behind the file"},
                 {chunk, UINT32_MAX, ": has a chunk that ends behind the file"},
                 {12, (uint32_t)whole, ": has a chunk that ends behind the file"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
    {
        uint8_t was[4];
        memcpy(was, bytes + cases[i].place, sizeof was);
        put_word(bytes + cases[i].place, cases[i].word);
        write_file("said.glb", bytes, whole);
        refused("said.glb", CM_ERROR_DATA, cases[i].words);
        memcpy(bytes + cases[i].place, was, sizeof was);
    }
    memcpy(bytes + whole, "\4\0\0\0MORE1234", 12); /* chunks of other kinds are passed over */
    put_word(bytes + 8, (uint32_t)whole + 12);
    write_file("said.glb", bytes, whole + 12);
    cm_mesh_destroy(read_good("said.glb"));
}
END_TEST

START_TEST(what_is_wrong_is_one_line)
{
    write_file("square.bin", &square, sizeof square);
    refused("absent.gltf", CM_ERROR_FILE, "cannot be opened");
    write_text("mesh.fbx", "x");
    refused("mesh.fbx", CM_ERROR_UNSUPPORTED, "is no mesh that is read");
    write_text("empty.obj", "");
    cm_mesh_destroy(read_good("empty.obj")); /* without triangles */
    write_text("huge.obj", "v 1e200 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    refused("huge.obj", CM_ERROR_DATA, "no numbers");
    write_text("no.gltf", "{\"asset\"");
    refused("no.gltf", CM_ERROR_DATA, "is no glTF");
    write_text("empty.glb", "");
    refused("empty.glb", CM_ERROR_DATA, "is empty");
    write_gltf("outside.gltf", ONE_NODE, INDEXED, "{\"uri\":\"../x.bin\",\"byteLength\":76}");
    refused("outside.gltf", CM_ERROR_DATA, "is no glTF");
    write_gltf("absolute.gltf", ONE_NODE, INDEXED, "{\"uri\":\"/dev/zero\",\"byteLength\":76}");
    refused("absolute.gltf", CM_ERROR_DATA, "outside its folder");
    write_gltf("short.gltf", ONE_NODE, "\"attributes\":{\"POSITION\":0},\"indices\":7", BUFFER);
    refused("short.gltf", CM_ERROR_DATA, "is no glTF");
    write_gltf("ring.gltf", "{\"children\":[1]},{\"children\":[0]}", INDEXED, BUFFER);
    refused("ring.gltf", CM_ERROR_DATA, "no tree");
    square_buffer wrong = square;
    wrong.index[2] = 4;
    write_file("wrong.bin", &wrong, sizeof wrong);
    write_gltf("index.gltf", ONE_NODE, INDEXED, "{\"uri\":\"wrong.bin\",\"byteLength\":76}");
    refused("index.gltf", CM_ERROR_DATA, "out of range");
    wrong = square;
    wrong.position[5] = NAN;
    write_file("wrong.bin", &wrong, sizeof wrong);
    write_gltf("nan.gltf", ONE_NODE, INDEXED, "{\"uri\":\"wrong.bin\",\"byteLength\":76}");
    refused("nan.gltf", CM_ERROR_DATA, "no numbers");
    ck_assert_int_eq(mkdir("folder.obj", 0700), 0);
    refused("folder.obj", CM_ERROR_FILE, "is no file");
    ck_assert_int_eq(rmdir("folder.obj"), 0);
    char message[CM_IMAGE_MESSAGE];
    cm_mesh *mesh = NULL;
    ck_assert_int_eq(cm_mesh_file_read(NULL, NULL, &mesh, message), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_mesh_file_read("a.obj", NULL, NULL, message), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_mesh_file_read("a.obj", NULL, &mesh, NULL), CM_ERROR_ARGUMENT);
}
END_TEST

/* Compressed meshes have accessors and buffers that a loader takes for damaged: the extension is named all the same. */
START_TEST(needs_are_named_before_what_lacks)
{
    static const struct
    {
        const char *needs, *parts, *words;
    } files[] = {
        {"\"version\":\"2.0\"},\"extensionsRequired\":[\"KHR_draco_mesh_compression\"",
         "{\"attributes\":{\"POSITION\":0},\"indices\":1}",
         "needs the extension KHR_draco_mesh_compression"},
        {"\"version\":\"2.0\"},\"extensionsRequired\":[\"KHR_materials_unlit\",\"EXT_meshopt_"
         "compression\"",
         "{\"attributes\":{\"POSITION\":0}}", "needs the extension EXT_meshopt_compression"},
        {"\"version\":\"1.0\"},\"extensionsRequired\":[", "", "is of glTF 1.0, which is not read"},
        {"\"version\":\"2.1\",\"minVersion\":\"2.1\"},\"extensionsRequired\":[", "",
         "is of glTF 2.1, which is not read"},
        {"\"version\":\"2.1\"},\"extensionsRequired\":[",
         "{\"attributes\":{\"POSITION\":0},\"indices\":1}", "is no glTF"}};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
    {
        char text[1000];
        snprintf(text, sizeof text,
                 "{\"asset\":{%s],\"accessors\":[{\"componentType\":5126,\"count\":4,\"type\":"
                 "\"VEC3\"},{\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"}],"
                 "\"meshes\":[{\"primitives\":[%s]}],\"buffers\":[{\"byteLength\":76}]}",
                 files[i].needs, files[i].parts);
        write_text("needs.gltf", text);
        refused("needs.gltf", CM_ERROR_DATA, files[i].words);
    }
}
END_TEST

START_TEST(indices_are_whole_numbers)
{
    square_buffer fractions = square;
    const float index[3] = {0, 1, 2.5F};
    memcpy(fractions.index, index, sizeof index);
    write_file("square.bin", &fractions, sizeof fractions);
    static const char *const accessors[] = {
        "\"componentType\":5126,\"count\":3,\"type\":\"SCALAR\"",
        "\"componentType\":5123,\"count\":2,\"type\":\"VEC3\""};
    for (size_t i = 0; i < sizeof accessors / sizeof accessors[0]; i++)
    {
        char text[1000];
        snprintf(
            text, sizeof text,
            "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[" ONE_NODE
            "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
            "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}"
            ","
            "{\"bufferView\":1,%s}],\"bufferViews\":[" FIRST_VIEWS "],\"buffers\":[" BUFFER "]}",
            accessors[i]);
        write_text("indices.gltf", text);
        refused("indices.gltf", CM_ERROR_DATA, "has indices that are no whole numbers");
    }
}
END_TEST

START_TEST(a_name_of_two_dots_in_its_midst_is_beside)
{
    write_file("square..bin", &square, sizeof square);
    write_gltf("dots.gltf", ONE_NODE, INDEXED, "{\"uri\":\"square..bin\",\"byteLength\":76}");
    cm_mesh_destroy(read_good("dots.gltf"));
}
END_TEST

START_TEST(a_library_of_parts_has_no_scene)
{
    static const char *const scenes[] = {"", ",\"scenes\":[]"};
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
    {
        char text[200];
        snprintf(text, sizeof text, "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{}]%s}",
                 scenes[i]);
        write_text("parts.gltf", text);
        refused("parts.gltf", CM_ERROR_DATA, "has no scene");
    }
    write_text("parts.gltf", "{\"asset\":{\"version\":\"2.0\"},\"scene\":0}");
    refused("parts.gltf", CM_ERROR_DATA, "names a scene that is not there");
}
END_TEST

START_TEST(endings_may_be_in_capitals)
{
    write_file("square.bin", &square, sizeof square);
    static const char *const names[] = {"capitals.GLTF", "capitals.GlTf"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
    {
        write_gltf(names[i], ONE_NODE, INDEXED, BUFFER);
        cm_mesh_destroy(read_good(names[i]));
    }
    uint8_t bytes[5000];
    write_file("capitals.Glb", bytes, make_binary(bytes, sizeof bytes));
    cm_mesh_destroy(read_good("capitals.Glb"));
}
END_TEST

/* glTF 2.0, 3.6.1.1: a file has at least as many bytes as its buffer. */
START_TEST(files_may_be_longer_than_their_buffers)
{
    uint8_t longer[sizeof square + 3] = {0};
    memcpy(longer, &square, sizeof square);
    write_file("longer.bin", longer, sizeof longer);
    write_gltf("longer.gltf", ONE_NODE, INDEXED,
               "{\"uri\":\"longer.bin\",\"byteLength\":76},"
               "{\"uri\":\"data:application/octet-stream;base64,AAAA\",\"byteLength\":3},"
               "{\"uri\":\"longer.bin\",\"byteLength\":4}");
    cm_mesh *mesh = read_good("longer.gltf");
    ck_assert_uint_eq(cm_mesh_describe(mesh)->triangle_count, 2);
    check_vertex(mesh, 3, 1, 1, 0);
    cm_mesh_destroy(mesh);
    write_file("shorter.bin", &square, sizeof square - 1);
    write_gltf("shorter.gltf", ONE_NODE, INDEXED, "{\"uri\":\"shorter.bin\",\"byteLength\":76}");
    refused("shorter.gltf", CM_ERROR_DATA, "shorter.bin, requestedBytes 76, but got 75");
}
END_TEST

START_TEST(views_stay_in_their_buffers)
{
    static const struct
    {
        const char *views, *words;
    } wrong_views[] = {
        {FIRST_VIEWS ",{\"buffer\":0,\"byteOffset\":61,\"byteLength\":16}",
         "has buffer view 2, which ends behind its buffer"}, /* which nothing reads */
        {FIRST_VIEWS ",{\"buffer\":0,\"byteOffset\":1000,\"byteLength\":0}",
         "has buffer view 2, which ends behind its buffer"},
        {FIRST_VIEWS ",{\"buffer\":0,\"byteOffset\":8,\"byteLength\":18446744073709551612}",
         "has buffer view 2, which ends behind its buffer"},
        {FIRST_VIEWS ",{\"buffer\":1,\"byteOffset\":0,\"byteLength\":4}",
         "names a buffer that is not there"},
        {"{\"buffer\":0,\"byteLength\":47},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":12}",
         "has accessor 0, which ends behind its buffer view"},
        {"{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":11}",
         "has accessor 1, which ends behind its buffer view"}};
    write_file("square.bin", &square, sizeof square);
    write_gltf_of_views("views.gltf", ONE_NODE, INDEXED, FIRST_VIEWS, BUFFER);
    cm_mesh_destroy(read_good("views.gltf"));
    for (size_t i = 0; i < sizeof wrong_views / sizeof wrong_views[0]; i++)
    {
        write_gltf_of_views("views.gltf", ONE_NODE, INDEXED, wrong_views[i].views, BUFFER);
        refused("views.gltf", CM_ERROR_DATA, wrong_views[i].words);
    }
}
END_TEST

START_TEST(nodes_have_all_their_numbers)
{
    static const struct
    {
        const char *node, *words;
    } wrong_nodes[] = {
        {"\"matrix\":[1,0,0,0,1,0,0,0,1]", "has node 0, whose matrix is of 9 numbers, not 16"},
        {"\"matrix\":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1, 0]", "is of 17 numbers, not 16"},
        {"\"translation\":[1,2]", "has node 0, whose translation is of 2 numbers, not 3"},
        {"\"rotation\":[0,0,1]", "has node 0, whose rotation is of 3 numbers, not 4"},
        {"\"rotation\":[0,0,0,2]", "has node 0, whose rotation's length is more than 0.001 off 1"},
        {"\"scale\":[1]", "has node 0, whose scale is of 1 numbers, not 3"}};
    write_file("square.bin", &square, sizeof square);
    for (size_t i = 0; i < sizeof wrong_nodes / sizeof wrong_nodes[0]; i++)
    {
        char node[200];
        snprintf(node, sizeof node, "{\"mesh\":0,%s}", wrong_nodes[i].node);
        write_gltf("nodes.gltf", node, INDEXED, BUFFER);
        refused("nodes.gltf", CM_ERROR_DATA, wrong_nodes[i].words);
    }
}
END_TEST

/* What tinygltf cannot read it takes for absent. */
START_TEST(numbers_that_cannot_be_read_are_refused)
{
    static const struct
    {
        const char *node, *primitive, *views, *words;
    } wrong[] = {
        {ONE_NODE, INDEXED, "{\"buffer\":0,\"byteOffset\":-4,\"byteLength\":48}",
         ":1: has buffer view 0, whose byteOffset is -4, not a whole number of 0 or more"},
        {ONE_NODE, INDEXED, "{\"buffer\":0,\"byteOffset\":4.5,\"byteLength\":48}",
         "whose byteOffset is 4.5, not a whole"},
        {ONE_NODE, INDEXED, "{\"buffer\":0,\"byteOffset\":0,\"byteLength\":48,\"byteStride\":12.0}",
         "whose byteStride is 12, not a whole number of 0 or more, in digits alone"},
        {ONE_NODE, INDEXED, "{\"buffer\":0,\"byteOffset\":\"4\",\"byteLength\":48}",
         "whose byteOffset is not a whole"},
        {ONE_NODE, INDEXED, "{\"buffer\":0,\"byteLength\":48,\"byteStride\":-12}",
         "whose byteStride is -12, not"},
        {"{\"mesh\":-1}", INDEXED, NULL, "has node 0, whose mesh is -1, not a whole"},
        {"{\"mesh\":4294967296}", INDEXED, NULL, "has node 0, whose mesh is 4294967296, not"},
        {"{\"mesh\":0,\"scale\":2}", INDEXED, NULL, "whose scale is 2, not a list of numbers"},
        {"{\"mesh\":0,\"translation\":[\"1\",0,0]}", INDEXED, NULL,
         "whose translation is not a list of numbers"},
        {"{\"mesh\":0,\"children\":[0.5]}", INDEXED, NULL,
         "whose children is not a list of whole numbers"},
        {ONE_NODE, "\"attributes\":{\"POSITION\":0},\"indices\":-1", NULL,
         "has mesh 0, whose indices is -1, not a whole"},
        {ONE_NODE, "\"attributes\":{\"POSITION\":0},\"mode\":7", NULL,
         "has a primitive of mode 7, which is none"},
        {ONE_NODE, "\"attributes\":{\"POSITION\":0},\"mode\":\"4\"", NULL,
         "has mesh 0, whose mode is not a whole"},
        {ONE_NODE, "\"attributes\":{\"POSITION\":\"0\"},\"indices\":1", NULL,
         "has mesh 0, whose primitives is not a list"}};
    write_file("square.bin", &square, sizeof square);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
    {
        char views[300];
        snprintf(views, sizeof views, "%s,{\"buffer\":0,\"byteOffset\":48,\"byteLength\":12}",
                 wrong[i].views == NULL ? "{\"buffer\":0,\"byteLength\":48}" : wrong[i].views);
        write_gltf_of_views("numbers.gltf", wrong[i].node, wrong[i].primitive, views, BUFFER);
        refused("numbers.gltf", CM_ERROR_DATA, wrong[i].words);
    }
}
END_TEST

/* A text of which the reader knows what another one does not. */
START_TEST(texts_of_odd_shapes_are_read_or_told)
{
    enum
    {
        DEEP = 1001
    };
    write_file("square.bin", &square, sizeof square);
    /* the last of two members of a name counts */
    write_gltf("twice.gltf", "{\"mesh\":-1,\"mesh\":7,\"mesh\":0}", INDEXED, BUFFER);
    cm_mesh_destroy(read_good("twice.gltf"));
    write_gltf("twice.gltf", "{\"mesh\":0,\n\"mesh\":-7}", INDEXED, BUFFER);
    refused("twice.gltf", CM_ERROR_DATA, ":2: has node 0, whose mesh is -7, not a whole");
    char node[2 * DEEP + 40] = "{\"mesh\":0,\n\"extras\":";
    const size_t begin = strlen(node);
    memset(node + begin, '[', DEEP);
    memset(node + begin + DEEP, ']', DEEP);
    strcpy(node + begin + (size_t)2 * DEEP, "}");
    write_gltf("nested.gltf", node, INDEXED, BUFFER);
    refused("nested.gltf", CM_ERROR_DATA, ":2: has JSON of more than 1000 lists and objects");
}
END_TEST

/* So many nodes, each within the one before, that the reader's stack ends. */
/* A tree of nodes each in the other, the last of which has the mesh. */
START_TEST(trees_of_nodes_may_be_deep)
{
    enum
    {
        DEEP = 300000
    };
    FILE *file = fopen("tree.gltf", "w");
    ck_assert_ptr_nonnull(file);
    fprintf(file, "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[");
    for (int i = 1; i < DEEP; i++)
    {
        fprintf(file, "{\"translation\":[0,0,1],\"children\":[%d]},", i);
    }
    fprintf(
        file,
        "{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,"
        "\"uri\":\"data:application/"
        "octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA\"}]}");
    fclose(file);
    cm_mesh *mesh = read_good("tree.gltf");
    ck_assert_uint_eq(cm_mesh_describe(mesh)->triangle_count, 1);
    const double deep = cm_mesh_describe(mesh)->position[2];
    REQUIRE(fabs(deep - (DEEP - 1)) < 1e-3, "%g", deep);
    cm_mesh_destroy(mesh);
}
END_TEST

START_TEST(a_reader_that_crashes_is_one_line)
{
    enum
    {
        DEEP = 300000
    };
    FILE *file = fopen("deep.gltf", "w");
    ck_assert_ptr_nonnull(file);
    fprintf(
        file,
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{}],\"extras\":");
    for (int i = 0; i < 2 * DEEP; i++)
    {
        fputc(i < DEEP ? '[' : ']', file);
    }
    fputc('}', file);
    fclose(file);
    refused("deep.gltf", CM_ERROR_DATA, "its reader");
}
END_TEST

int main(void)
{
    if (chdir(test_folder()) != 0)
    {
        return 1;
    }
    const TTest *const tests[] = {nodes_move_what_they_have,
                                  strips_without_indices_and_their_colours,
                                  a_binary_file_is_the_same,
                                  binary_files_are_what_they_say,
                                  what_is_wrong_is_one_line,
                                  needs_are_named_before_what_lacks,
                                  indices_are_whole_numbers,
                                  a_name_of_two_dots_in_its_midst_is_beside,
                                  a_library_of_parts_has_no_scene,
                                  endings_may_be_in_capitals,
                                  files_may_be_longer_than_their_buffers,
                                  views_stay_in_their_buffers,
                                  nodes_have_all_their_numbers,
                                  numbers_that_cannot_be_read_are_refused,
                                  texts_of_odd_shapes_are_read_or_told,
                                  trees_of_nodes_may_be_deep,
                                  a_reader_that_crashes_is_one_line,
                                  NULL};
    return run_suite("mesh file", tests);
}
