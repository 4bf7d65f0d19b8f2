/* SPDX-License-Identifier: MIT
 *
 * What OBJ and its materials say is what is read, and wrong lines are named.
 */
#define _POSIX_C_SOURCE 200809L

#include "read_meshes.h"
#include "written_files.h"

#include "tests/suite.h"

#include <sys/stat.h>
#include <unistd.h>

/* "\\" at a line's end: the next is a part of it, and lines keep their numbers. Comments do not go on. */
START_TEST(lines_of_obj_may_go_on)
{
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    static const char *const lines[] = {"# of C:\\",
                                        "v 0 0 \\",
                                        "0",
                                        "v 2 \\",
                                        "0 \\",
                                        "0 1 0 0",
                                        "v 2 2 0",
                                        "f 1 \\",
                                        "2 \\",
                                        "3",
                                        "usemtl with, comma",
                                        "f 3 2 1",
                                        "#\\",
                                        "f 1 2 3"};
    for (size_t i = 0; i < 3; i++)
    {
        char text[300] = "";
        for (size_t k = 0; k < sizeof lines / sizeof lines[0]; k++)
        {
            strcat(strcat(text, lines[k]), ends[i]);
        }
        write_text("on.obj", text);
        cm_mesh *mesh = read_good("on.obj");
        ck_assert_uint_eq(cm_mesh_describe(mesh)->triangle_count, 3);
        check_vertex(mesh, 1, 2, 0, 0);
        check_color(mesh, 1, 1, 0, 0);
        cm_mesh_destroy(mesh);
        write_text("on.obj", strcat(text, "v 1 \\"));
        refused("on.obj", CM_ERROR_DATA, "on.obj:15: a vertex");
    }
}
END_TEST

/* Behind numbers, with a space before and without. They do not go on. */
START_TEST(comments_of_obj_end_lines)
{
    static const char text[] = "o a # b\nv 0 0 0 # 1 1 1\nv 2 0 0#2\nv 2 2 0 1 0 0#red\n"
                               "vt 0 0 # of a texture\nvt 0 1# of it\nvn 0 0 1 # up\n"
                               "f 1 2 3 # lower right\nf 1 2 3#c\nf 1/1/1 2/2/1 3/1/1 # in C:\\\n"
                               "\tf 1//1 2//1 \\\n3//1 # 4\nf 3 2 1\t#\nl 1 2 # no face\n"
                               "s off # smooth\n\\\n# C:\\\nf 2 3 1#";
    write_text("comments.obj", text);
    cm_mesh *mesh = read_good("comments.obj");
    const cm_mesh_options *has = cm_mesh_describe(mesh);
    ck_assert_uint_eq(has->triangle_count, 6);
    ck_assert_uint_eq(has->vertex_count, 3);
    check_vertex(mesh, 1, 2, 0, 0);
    check_color(mesh, 0, 1, 1, 1);
    check_color(mesh, 2, 1, 0, 0);
    cm_mesh_destroy(mesh);
    write_text("comments.obj", "v 0 0 0\nf 1 1 # 1\n");
    refused("comments.obj", CM_ERROR_DATA, ":2: a face of fewer than 3");
    write_text("comments.obj", "v 0 0 # 0\nf 1 1 1\n");
    refused("comments.obj", CM_ERROR_DATA, ":1: a vertex of fewer than 3");
}
END_TEST

/* The library ends names at spaces, and reads the first of several files. */
START_TEST(materials_of_obj_may_have_spaces)
{
    write_text("two words.mtl", "newmtl old red\nKd 1 0 0\nnewmtl  old  \nKd 0 1 0\n");
    write_text("s1.mtl", "newmtl Material #25\nKd 0 0 1\n");
    write_text("s2.mtl", "newmtl grey\nKd 0.5 0.5 0.5\n");
    write_text(
        "s.obj",
        "mtllib two words.mtl\nmtllib none.mtl s1.mtl s2.mtl # both\nv 0 0 0\nv 1 0 0\n"
        "v 0 1 0\nusemtl old red\nf 1 2 3\nusemtl old # red\nf 1 2 3\n"
        "usemtl\tMaterial #25 \nf 1 2 3\nusemtl grey# 2\nf 1 2 3\nusemtl grey\nf 1 2 3\n   ");
    const double colors[5][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {0.5, 0.5, 0.5}};
    cm_mesh *mesh = read_good("s.obj");
    ck_assert_uint_eq(cm_mesh_describe(mesh)->triangle_count, 5);
    for (size_t i = 0; i < 5; i++)
    {
        check_color(mesh, cm_mesh_describe(mesh)->index[3 * i], colors[i][0], colors[i][1],
                    colors[i][2]);
    }
    cm_mesh_destroy(mesh);
    write_text("s.obj", "mtllib none.mtl ../s1.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    refused("s.obj", CM_ERROR_DATA, "outside its folder");
}
END_TEST

START_TEST(polygons_and_materials_of_obj)
{
    write_text("c.mtl", "newmtl red\nKd 1 0.25 0\nnewmtl blue\nKd 0 0 1\n");
    write_text("c.obj", "mtllib c.mtl\nv 0 0 0.1\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 3 0\n"
                        "usemtl red\nf 1 2 3 4\nusemtl blue\nf -3 -1 -2\n");
    cm_mesh *mesh = read_good("c.obj");
    const cm_mesh_options *has = cm_mesh_describe(mesh);
    ck_assert_uint_eq(has->triangle_count, 3);
    ck_assert_uint_eq(has->vertex_count, 7); /* two are of both materials */
    ck_assert(has->position[2] == 0.1);      /* in double */
    check_color(mesh, has->index[0], 1, 0.25, 0);
    check_color(mesh, has->index[6], 0, 0, 1);
    check_vertex(mesh, has->index[6], 2, 2, 0);
    check_vertex(mesh, has->index[7], 1, 3, 0);
    cm_mesh_destroy(mesh);
}
END_TEST

/* Twice the area of a triangle in the plane of x and y, with the side on which it turns. */
static double turned_area(const cm_mesh_options *has, size_t triangle)
{
    const double *corner[3];
    for (size_t i = 0; i < 3; i++)
    {
        corner[i] = has->position + 3 * (size_t)has->index[3 * triangle + i];
    }
    return (corner[1][0] - corner[0][0]) * (corner[2][1] - corner[0][1]) -
           (corner[1][1] - corner[0][1]) * (corner[2][0] - corner[0][0]);
}

/* A square with a notch, from any of its corners, either way around: its triangles lie side by side, in it alone. */
START_TEST(polygons_of_obj_may_be_hollow)
{
    for (int first = 0; first < 10; first++)
    {
        const int way = first < 5 ? 1 : 4;
        char text[200];
        int number[5];
        for (int i = 0; i < 5; i++)
        {
            number[i] = 1 + (first + way * i) % 5;
        }
        snprintf(text, sizeof text,
                 "v -1 -1 2\nv 1 -1 2\nv 1 1 2\nv 0 -0.5 2\nv -1 1 2\nf %d %d %d %d %d\n",
                 number[0], number[1], number[2], number[3], number[4]);
        write_text("hollow.obj", text);
        cm_mesh *mesh = read_good("hollow.obj");
        const cm_mesh_options *has = cm_mesh_describe(mesh);
        ck_assert_uint_eq(has->triangle_count, 3);
        double sum = 0.0;
        for (size_t i = 0; i < 3; i++)
        {
            const double area = first < 5 ? turned_area(has, i) : -turned_area(has, i);
            REQUIRE(area > 0.0, "from %d: triangle %zu: %g", first, i, area);
            sum += area;
        }
        REQUIRE(sum == 5.0, "from %d: %g", first, sum);
        cm_mesh_destroy(mesh);
    }
}
END_TEST

/* Of a disc in the plane z = 2, and after it a triangle beside it; areas are twice as much. */
START_TEST(polygons_of_obj_may_have_many_corners)
{
    static const int corners[] = {255, 256, 259, 300, 1000};
    for (size_t k = 0; k < sizeof corners / sizeof *corners; k++)
    {
        const int n = corners[k];
        const double turn = 2.0 * 3.14159265358979323846 / n;
        char *text = calloc(1, 64 * ((size_t)n + 8));
        char *end = text;
        for (int i = 0; i < n; i++)
        {
            end += sprintf(end, "v %.12f %.12f 2\n", cos(turn * i), sin(turn * i));
        }
        end += sprintf(end, "v 2 0 2\nv 6 0 2\nv 6 4 2\nf");
        for (int i = 1; i <= n; i++)
        {
            end += sprintf(end, " %d", i);
        }
        sprintf(end, "\nf %d %d %d\n", n + 1, n + 2, n + 3);
        write_text("disc.obj", text);
        free(text);
        cm_mesh *mesh = read_good("disc.obj");
        const cm_mesh_options *has = cm_mesh_describe(mesh);
        ck_assert_uint_eq(has->triangle_count, (size_t)n - 1);
        double sum = 0.0;
        for (size_t i = 0; i < has->triangle_count; i++)
        {
            sum += turned_area(has, i);
        }
        const double wanted = n * sin(turn) + 16.0;
        REQUIRE(fabs(sum - wanted) < 1e-5, "%d corners: area %g, not %g", n, sum, wanted);
        ck_assert(turned_area(has, has->triangle_count - 1) == 16.0);
        cm_mesh_destroy(mesh);
    }
}
END_TEST

/* A mark of UTF-8 hides no vertex, which would give all faces other ones, and no material. */
START_TEST(marked_texts_of_obj_are_whole)
{
    write_text("marked.mtl", "\xef\xbb\xbfnewmtl red\nKd 1 0 0\n");
    write_text("marked.obj",
               "\xef\xbb\xbfv 7 0 0\nmtllib marked.mtl\nusemtl red\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
               "f 1 2 3\n");
    cm_mesh *mesh = read_good("marked.obj");
    check_vertex(mesh, cm_mesh_describe(mesh)->index[0], 7, 0, 0);
    check_vertex(mesh, cm_mesh_describe(mesh)->index[2], 0, 1, 0);
    check_color(mesh, cm_mesh_describe(mesh)->index[0], 1, 0, 0);
    cm_mesh_destroy(mesh);
}
END_TEST

START_TEST(materials_of_obj_are_nearby)
{
    static const char *const faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
    char text[200];
    ck_assert_int_eq(mkdir("below", 0700), 0);
    write_text("below/a.mtl", "newmtl red\nKd 1 0 0\n");
    snprintf(text, sizeof text, "mtllib below/a.mtl\n%s", faces);
    write_text("below.obj", text);
    cm_mesh *mesh = read_good("below.obj");
    check_color(mesh, 0, 1, 0, 0);
    cm_mesh_destroy(mesh);
    snprintf(text, sizeof text, "mtllib ../below/a.mtl\n%s", faces);
    write_text("below/up.obj", text);
    refused("below/up.obj", CM_ERROR_DATA, "names a file of materials outside its folder");
    snprintf(text, sizeof text, "mtllib /dev/zero\n%s", faces);
    write_text("root.obj", text);
    mesh = read_good("root.obj"); /* no such file is in the folder */
    check_color(mesh, 0, 1, 1, 1);
    cm_mesh_destroy(mesh);
}
END_TEST

START_TEST(wrong_lines_are_named)
{
    static const struct
    {
        const char *text, *words;
    } wrong_lines[] = {{"v 0 0 0\nv 1 0 0\nf 1 2 3\n", ":3: a face of a vertex that is not there"},
                       {"v 0 0 0\r\nf -1 -1 -2\r\n", ":2: a face of what is no vertex"},
                       {"f 1 2 3\nf 1 2 4\rv 0 0 0\nv 1 0 0\nv 0 1 0\n", ":2: a face of a vertex"},
                       {"v 0 0 0\nf 1 0 1\n", ":2: a face of what is no vertex"},
                       {"v 0 0 0\nf 1 1.5 1\n", ":2: a face of what is no vertex"},
                       {"v 0 0 0\nf 1 1\n", ":2: a face of fewer than 3"},
                       {"# nan\nv nan 0 0\n", ":2: a vertex with what is no finite"},
                       {"v 0 0 0\nv 0 1e999 0\n", ":2: a vertex with what is no finite"},
                       {"v a b c\n", ":1: a vertex with what is no finite"},
                       {"v 0 0\n", ":1: a vertex of fewer than 3"}};
    for (size_t i = 0; i < sizeof wrong_lines / sizeof wrong_lines[0]; i++)
    {
        write_text("wrong.obj", wrong_lines[i].text);
        refused("wrong.obj", CM_ERROR_DATA, wrong_lines[i].words);
    }
}
END_TEST

int main(void)
{
    if (chdir(test_folder()) != 0)
    {
        return 1;
    }
    const TTest *const tests[] = {lines_of_obj_may_go_on,
                                  comments_of_obj_end_lines,
                                  materials_of_obj_may_have_spaces,
                                  polygons_and_materials_of_obj,
                                  polygons_of_obj_may_be_hollow,
                                  polygons_of_obj_may_have_many_corners,
                                  marked_texts_of_obj_are_whole,
                                  materials_of_obj_are_nearby,
                                  wrong_lines_are_named,
                                  NULL};
    return run_suite("OBJ file", tests);
}
