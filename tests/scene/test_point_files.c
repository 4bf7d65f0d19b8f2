/* SPDX-License-Identifier: MIT
 *
 * NPY and PLY: what is written is the same again, what others write is read, and what is wrong is told.
 */
#define _POSIX_C_SOURCE 200809L

#include "modules/scene/io/npy_file.h"
#include "modules/scene/io/ply_file.h"

#include "tests/suite.h"
#include "written_files.h"

static char message[CM_IMAGE_MESSAGE];

static size_t make_npy(char *bytes, const char *dictionary, const void *data, size_t count)
{
    const size_t length = strlen(dictionary);
    memcpy(bytes, "\x93NUMPY\x01\x00", 8);
    bytes[8] = (char)(length % 256);
    bytes[9] = (char)(length / 256);
    memcpy(bytes + 10, dictionary, length);
    memcpy(bytes + 10 + length, data, count);
    return 10 + length + count;
}

START_TEST(arrays_come_back)
{
    uint16_t whole[6] = {0, 1, 2, 40000, 65535, 7};
    float real[6] = {0.0f, -1.5f, NAN, 1e30f, 3.25f, 1e-40f};
    const cm_image images[] = {{.size = sizeof images[0],
                                .data = whole,
                                .type = CM_PIXEL_U16,
                                .width = 3,
                                .height = 2,
                                .channels = 1},
                               {.size = sizeof images[0],
                                .data = real,
                                .type = CM_PIXEL_FLOAT,
                                .width = 2,
                                .height = 3,
                                .channels = 1}};
    for (size_t i = 0; i < 2; i++)
    {
        const char *path = in_folder("a.npy");
        REQUIRE(cm_npy_write(path, &images[i], message) == CM_OK, "%s", message);
        cm_image again = {.size = 0};
        REQUIRE(cm_npy_read(path, &again, message) == CM_OK, "%s", message);
        REQUIRE(again.width == images[i].width && again.height == images[i].height &&
                    again.type == images[i].type &&
                    memcmp(again.data, images[i].data, 6 * cm_pixel_size(again.type)) == 0,
                "%zu", i);
        free(again.data);
    }
}
END_TEST

START_TEST(arrays_of_others_are_read)
{
    const unsigned char halves[] = {0x00, 0x3c, 0x00, 0xc0, 0xff, 0x7b, 0x01, 0x00};
    const double doubles[] = {1.0, -2.0, 65504.0, 0x1p-24};
    const unsigned char big[] = {0x3f, 0x80, 0,    0, 0xc0, 0,    0, 0,
                                 0x47, 0x7f, 0xe0, 0, 0x33, 0x80, 0, 0};
    const struct
    {
        const char *dictionary;
        const void *data;
        size_t count;
        int turned;
    } cases[] = {
        {"{'descr': '<f2', 'fortran_order': False, 'shape': (2, 2), }", halves, 8, 0},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }", doubles, 32, 0},
        {"{'shape': (2,2),'fortran_order':True,'descr':'<f8'}", doubles, 32, 1},
        {"{'descr': '>f4', 'fortran_order': False, 'shape': (2, 2), }", big, 16, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
    {
        char bytes[400];
        const size_t size = make_npy(bytes, cases[i].dictionary, cases[i].data, cases[i].count);
        cm_image image = {.size = 0};
        REQUIRE(cm_npy_parse("n", bytes, size, &image, message) == CM_OK, "%zu: %s", i, message);
        const float *values = image.data;
        REQUIRE(image.width == 2 && image.height == 2 && values[0] == 1.0f &&
                    values[cases[i].turned ? 2 : 1] == -2.0f &&
                    values[cases[i].turned ? 1 : 2] == 65504.0f && values[3] == 0x1p-24f,
                "%zu", i);
        free(image.data);
    }
}
END_TEST

START_TEST(bad_arrays_are_refused)
{
    const struct
    {
        const char *dictionary;
        const char *word;
    } cases[] = {
        {"{'descr': '|u1', 'fortran_order': False, 'shape': (2, 2), }", "type"},
        {"{'descr': '<i4', 'fortran_order': False, 'shape': (2, 2), }", "type"},
        {"{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (2, 2), }", "type"},
        {"{'fortran_order': False, 'shape': (2, 2), }", "descr"},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (4,), }", "dimensions"},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2, 1), }", "dimensions"},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 0), }", "dimensions"},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", "bytes"},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (65536, 65536), }", "2^31"},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (4294967296, 4294967296), }", "2^31"},
        {"", "descr"}};
    const float data[4] = {0};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
    {
        char bytes[400];
        const size_t size = make_npy(bytes, cases[i].dictionary, data, sizeof data);
        cm_image image = {.size = 0};
        const cm_status status = cm_npy_parse("n.npy", bytes, size, &image, message);
        REQUIRE(status == CM_ERROR_DATA && strstr(message, cases[i].word) != NULL &&
                    strncmp(message, "n.npy: ", 7) == 0 && image.data == NULL,
                "%zu: %d %s", i, (int)status, message);
    }
    char bytes[400];
    const size_t size =
        make_npy(bytes, "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2), }", data, 16);
    cm_image image;
    for (size_t i = 0; i < size; i++)
    {
        ck_assert_int_eq(cm_npy_parse("n", bytes, i, &image, message), CM_ERROR_DATA);
    }
    bytes[6] = 9;
    ck_assert_int_eq(cm_npy_parse("n", bytes, size, &image, message), CM_ERROR_VERSION);
}
END_TEST

static double positions[12] = {0, 1, 2, 0.1, -1e-300, 1e300, 3, 4, 5, -0.5, 1.0 / 3.0, 7};
static float normals[12] = {0, 0, 1, 0.1f, 0.2f, 0.3f, 1, 0, 0, 0, 1, 0};
static unsigned char colors[12] = {0, 1, 2, 255, 254, 253, 7, 8, 9, 10, 11, 12};
static uint32_t corners[6] = {0, 1, 2, 2, 1, 3};

START_TEST(points_come_back)
{
    for (int i = 0; i < 16; i++)
    {
        const cm_ply ply = {4,
                            positions,
                            i & 1 ? normals : NULL,
                            i & 2 ? colors : NULL,
                            i & 4 ? 2 : 0,
                            i & 4 ? corners : NULL};
        const char *path = in_folder("a.ply");
        REQUIRE(cm_ply_write(path, &ply, i & 8, message) == CM_OK, "%s", message);
        cm_ply again = {.point_count = 0};
        REQUIRE(cm_ply_read(path, &again, message) == CM_OK, "%d: %s", i, message);
        REQUIRE(again.point_count == 4 && again.triangle_count == ply.triangle_count, "%d", i);
        REQUIRE(memcmp(again.position, positions, sizeof positions) == 0, "%d", i);
        REQUIRE(
            (i & 1 ? memcmp(again.normal, normals, sizeof normals) == 0 : again.normal == NULL) &&
                (i & 2 ? memcmp(again.color, colors, sizeof colors) == 0 : again.color == NULL) &&
                (i & 4 ? memcmp(again.corner, corners, sizeof corners) == 0 : again.corner == NULL),
            "%d", i);
        cm_ply_clear(&again);
    }
    const cm_ply none = {0, NULL, NULL, NULL, 0, NULL};
    const cm_ply beyond = {2, positions, NULL, NULL, 2, corners};
    ck_assert_int_eq(cm_ply_write(in_folder("b.ply"), &beyond, true, message), CM_ERROR_ARGUMENT);
    cm_ply again = {.point_count = 9};
    REQUIRE(cm_ply_write(in_folder("b.ply"), &none, false, message) == CM_OK &&
                cm_ply_read(in_folder("b.ply"), &again, message) == CM_OK && again.point_count == 0,
            "%s", message);
    cm_ply_clear(&again);
}
END_TEST

START_TEST(points_of_others_are_read)
{
    const char *const text = "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\n"
                             "element vertex 4\r\nproperty float x\r\nproperty float y\r\n"
                             "property float z\r\nproperty float red\r\nproperty float green\r\n"
                             "property float blue\r\nproperty list uchar int more\r\n"
                             "element edge 1\r\nproperty int a\r\nelement face 1\r\n"
                             "property list uchar int vertex_index\r\nend_header\r\n"
                             "0 0 0 1 0.5 0 0\r\n1 0 0 0 0 0 2 5 6\r\n1 1 0 0 0 0 0\r\n"
                             "0 1 0 0 0 0 0\r\n7\r\n4 0 1 2 3\r\n\r\n";
    cm_ply ply = {.point_count = 0};
    REQUIRE(cm_ply_parse("p", text, strlen(text), &ply, message) == CM_OK, "%s", message);
    REQUIRE(ply.point_count == 4 && ply.triangle_count == 2 && ply.corner[3] == 0 &&
                ply.corner[4] == 2 && ply.corner[5] == 3 && ply.color[0] == 255 &&
                ply.color[1] == 128 && ply.normal == NULL,
            "%zu %zu", ply.point_count, ply.triangle_count);
    cm_ply_clear(&ply);
}
END_TEST

START_TEST(columns_and_elements_come_in_any_order)
{
    const char *const text = "ply\nformat ascii 1.0\nelement face 1\n"
                             "property list uchar int vertex_indices\nelement vertex 3\n"
                             "property uchar blue\nproperty float z\nproperty float red\n"
                             "property float y\nproperty double green\nproperty float x\n"
                             "end_header\n3 2 1 0\n128 3 0.5 2 1 1\n0 0 0 0 0 0\n9 0 0 1 0 1\n";
    cm_ply ply = {.point_count = 0};
    REQUIRE(cm_ply_parse("p", text, strlen(text), &ply, message) == CM_OK, "%s", message);
    REQUIRE(ply.point_count == 3 && ply.triangle_count == 1 && ply.corner[0] == 2 &&
                ply.position[0] == 1 && ply.position[1] == 2 && ply.position[2] == 3,
            "%zu %zu", ply.point_count, ply.triangle_count);
    REQUIRE(ply.color[0] == 128 && ply.color[1] == 255 && ply.color[2] == 128 && ply.color[8] == 9,
            "%d %d %d", ply.color[0], ply.color[1], ply.color[2]);
    cm_ply_clear(&ply);
}
END_TEST

#define HEAD "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"

START_TEST(bad_points_are_refused)
{
    const struct
    {
        const char *text;
        const char *begin;
    } cases[] = {
        {"", "p.ply:"},
        {"obj\n", "p.ply:1: is not a PLY"},
        {"ply\nformat ascii 2\nend_header", "p.ply:"},
        {"ply\nend_header\n", "p.ply:2: "},
        {"ply\nformat binary_big_endian 1.0\nend_header\n", "p.ply:2: big"},
        {HEAD "end_header\n1 2\n", "p.ply:"},
        {HEAD "property float z\nend_header\n1 2\n", "p.ply:8: a line has fewer"},
        {HEAD "property float z\nend_header\n1 2 3 4\n", "p.ply:8: there is more"},
        {HEAD "property float z\nend_header\n1 2 x\n", "p.ply:8: \"x\""},
        {HEAD "property float z\nend_header\n1 2 3\n4\n", "p.ply:"},
        {HEAD "property float z\nproperty float z\nend_header\n1 2 3\n", "p.ply:"},
        {HEAD "property quad z\nend_header\n1 2 3\n", "p.ply:6: "},
        {HEAD "property float z\nelement face 1\nproperty list uchar int vertex_index\n"
              "end_header\n1 2 3\n3 0 0 1\n",
         "p.ply:11: a face has a corner"},
        {HEAD "property float z\nelement face 1\nproperty list uchar int vertex_index\n"
              "end_header\n1 2 3\n2 0 0\n",
         "p.ply:11: a face has fewer"},
        {"ply\nformat ascii 1.0\nelement vertex 999999999999\nproperty float x\nproperty float y\n"
         "property float z\nend_header\n",
         "p.ply:7: the file is too short"},
        {"ply\nformat ascii 1.0\nelement vertex -1\nend_header\n", "p.ply:3: "},
        {HEAD "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
              "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
              "end_header\n0 0 0 0 0 1\n1 1 1\n",
         "p.ply:14: the head has the element vertex twice"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
    {
        cm_ply ply = {.point_count = 0};
        const cm_status status =
            cm_ply_parse("p.ply", cases[i].text, strlen(cases[i].text), &ply, message);
        REQUIRE((status == CM_ERROR_DATA || status == CM_ERROR_UNSUPPORTED) &&
                    strncmp(message, cases[i].begin, strlen(cases[i].begin)) == 0 &&
                    ply.position == NULL,
                "%zu: %d %s", i, (int)status, message);
    }
    const cm_ply ply = {4, positions, normals, colors, 2, corners};
    REQUIRE(cm_ply_write(in_folder("c.ply"), &ply, true, message) == CM_OK, "%s", message);
    size_t count = 0;
    char *bytes = read_file(in_folder("c.ply"), &count);
    for (size_t i = 0; i < count; i++)
    {
        cm_ply cut = {.point_count = 0};
        ck_assert_int_eq(cm_ply_parse("p", bytes, i, &cut, message), CM_ERROR_DATA);
    }
    free(bytes);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {arrays_come_back,          arrays_of_others_are_read,
                                  bad_arrays_are_refused,    points_come_back,
                                  points_of_others_are_read, columns_and_elements_come_in_any_order,
                                  bad_points_are_refused,    NULL};
    return run_suite("point files", tests);
}
