/* SPDX-License-Identifier: MIT
 *
 * Sequences: read again in each layout, what is left out, and what is refused.
 */
#define _DEFAULT_SOURCE

#include "modules/scene/io/camera_file.h"
#include "modules/scene/io/npy_file.h"
#include "modules/scene/io/sequence.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/suite.h"
#include "small_views.h"
#include "written_files.h"
static cm_sequence *open_views(const char *folder, const char *camera)
{
    const cm_sequence_options options = {.size = sizeof options, .camera = camera};
    cm_sequence *sequence = NULL;
    const cm_status status = cm_sequence_open(folder, &options, &sequence, message);
    REQUIRE(status == CM_OK, "%d %s", (int)status, message);
    return sequence;
}

/* The status of opening it and of all its views. */
static cm_status open_all(const char *folder, const char *camera)
{
    const cm_sequence_options options = {.size = sizeof options, .camera = camera};
    cm_sequence *sequence = NULL;
    message[0] = '\0';
    cm_status status = cm_sequence_open(folder, &options, &sequence, message);
    for (size_t k = 0; status == CM_OK && k < cm_sequence_count(sequence); k++)
    {
        const cm_view *view = NULL;
        status = cm_sequence_view(sequence, k, &view, message);
    }
    cm_sequence_close(sequence);
    return status;
}

static void check_view(const cm_view *view, unsigned k, double time, double unit)
{
    const cm_view wanted = make_view(view->camera, k, 0);
    REQUIRE(fabs(view->time - time) < 1e-12 && fabs(view->depth_unit - unit) < 1e-18, "%.17g %.17g",
            view->time, view->depth_unit);
    const uint16_t *stored = view->depth.data;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
    {
        REQUIRE(fabs(stored[i] * unit - depth_units[i] / 5000.0) < 1e-9, "view %u pixel %d: %d", k,
                i, stored[i]);
    }
    REQUIRE(view->color.type == CM_PIXEL_U8 && view->color.channels == 3 &&
                memcmp(view->color.data, colors, sizeof colors) == 0,
            "view %u: other colours", k);
    for (int i = 0; i < 9; i++)
    {
        REQUIRE(fabs(view->pose.rotation.row[i / 3][i % 3] -
                     wanted.pose.rotation.row[i / 3][i % 3]) < 1e-15,
                "view %u: another pose", k);
    }
    REQUIRE(fabs(view->pose.position[1] - wanted.pose.position[1]) < 1e-15, "another place");
    REQUIRE(view->depth_is_range == 0 && view->amplitude.data == NULL, "another kind");
}

START_TEST(views_come_back_in_each_layout)
{
    for (int i = 1; i < 7; i++)
    {
        const cm_sequence_layout layout = (cm_sequence_layout)((i + 1) / 2);
        const char *folder = write_views("round", layout, i % 2);
        cm_sequence *sequence = open_views(folder, NULL);
        const cm_sequence_report *report = cm_sequence_describe(sequence);
        REQUIRE(report->layout == layout && cm_sequence_count(sequence) == VIEWS &&
                    report->count == VIEWS && report->listed == VIEWS && report->absent == 0 &&
                    report->without_pose == 0 && report->without_color == 0 &&
                    report->poses == VIEWS,
                "layout %d", (int)layout);
        for (unsigned k = VIEWS; k-- > 0;)
        {
            const cm_view *view = NULL;
            cm_sequence_entry entry;
            REQUIRE(cm_sequence_view(sequence, k, &view, message) == CM_OK, "%s", message);
            const int tum = layout == CM_SEQUENCE_TUM, seven = layout == CM_SEQUENCE_SEVEN_SCENES;
            check_view(view, k, tum ? 100.25 + k : k / 30.0, seven ? 0.001 : 0.0002);
            REQUIRE(cm_sequence_entry_at(sequence, k, &entry, message) == CM_OK, "%s", message);
            REQUIRE(entry.time == view->time && entry.depth != NULL && entry.color != NULL,
                    "entry %u", k);
        }
        const cm_view *view = NULL;
        ck_assert_int_eq(cm_sequence_view(sequence, VIEWS, &view, message), CM_ERROR_RANGE);
        cm_sequence_close(sequence);
    }
}
END_TEST

START_TEST(ranges_become_depths)
{
    cm_camera *camera = make_camera(WIDTH);
    cm_sequence_writer *writer = NULL;
    const char *folder = in_folder("range");
    REQUIRE(cm_sequence_create(folder, CM_SEQUENCE_TUM, camera, 5000.0, &writer, message) == CM_OK,
            "%s", message);
    cm_view view = make_view(camera, 0, 1);
    for (unsigned i = 0; i < WIDTH * HEIGHT; i++)
    {
        const double x = (i % WIDTH - 3.5) / 9.0, y = (i / WIDTH - 2.5) / 9.0;
        depth_metres[i] = (float)(2.0 * sqrt(1.0 + x * x + y * y)); /* a wall at 2 m */
    }
    view.depth_is_range = 1;
    REQUIRE(cm_sequence_write(writer, &view, NULL, message) == CM_OK, "%s", message);
    REQUIRE(cm_sequence_finish(writer, message) == CM_OK, "%s", message);
    cm_sequence_drop(writer);
    cm_camera_destroy(camera);
    cm_sequence *sequence = open_views(folder, NULL);
    const cm_view *read = NULL;
    REQUIRE(cm_sequence_view(sequence, 0, &read, message) == CM_OK, "%s", message);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
    {
        ck_assert_int_eq(((const uint16_t *)read->depth.data)[i], 10000);
    }
    cm_sequence_close(sequence);
}
END_TEST

START_TEST(what_is_absent_is_counted)
{
    const char *folder = write_views("absent", CM_SEQUENCE_TUM, 0);
    remove_all(in_folder("absent/depth/101.250000.png"));
    remove_all(in_folder("absent/rgb/102.250000.png"));
    write_text("absent/groundtruth.txt", "100.25 0 0 0 0 0 0 1\n102.231 1 0 0 0 0 0 1\n"
                                         "103.271 2 0 0 0 0 0 1\n104.24 3 0 0 0 0 0 1\n"
                                         "104.255 4 0 0 0 0 0 1\n");
    cm_sequence *sequence = open_views(folder, NULL);
    const cm_sequence_report *report = cm_sequence_describe(sequence);
    REQUIRE(report->listed == 5 && report->absent == 1 && report->without_pose == 1 &&
                report->count == 3 && report->color_absent == 1 && report->without_color == 1,
            "%zu listed, %zu absent, %zu without pose, %zu views", report->listed, report->absent,
            report->without_pose, report->count);
    cm_sequence_entry entry;
    ck_assert_int_eq(cm_sequence_entry_at(sequence, 2, &entry, message), CM_OK);
    REQUIRE(entry.pose.position[0] == 4.0, "%g: not the nearest", entry.pose.position[0]);
    ck_assert_int_eq(cm_sequence_entry_at(sequence, 1, &entry, message), CM_OK);
    REQUIRE(entry.color == NULL && entry.time == 102.25, "%g", entry.time);
    const cm_view *view = NULL;
    REQUIRE(cm_sequence_view(sequence, 1, &view, message) == CM_OK && view->color.data == NULL,
            "%s", message);
    cm_sequence_close(sequence);
    remove_all(in_folder("absent/depth"));
    ck_assert_int_eq(open_all(folder, NULL), CM_ERROR_FILE);
    REQUIRE(strstr(message, "5 are absent") != NULL, "%s", message);
}
END_TEST

/* Where the depth of a view is; of TUM's layout the folder of all. */
static void name_depth(char file[60], unsigned layout, unsigned k)
{
    if (layout == CM_SEQUENCE_TUM)
    {
        strcpy(file, "depth");
        return;
    }
    snprintf(file, 60, "%s%0*u%s", layout == CM_SEQUENCE_OPEN3D ? "depth_" : "frame-",
             layout == CM_SEQUENCE_OPEN3D ? 5 : 6, k,
             layout == CM_SEQUENCE_OPEN3D ? ".png" : ".depth.png");
}

/* Who looks at colours alone needs no depth, in each layout; others do. */
START_TEST(colours_will_do)
{
    const cm_sequence_options options = {.size = sizeof options, .colors_will_do = 1};
    for (unsigned layout = CM_SEQUENCE_TUM; layout <= CM_SEQUENCE_SEVEN_SCENES; layout++)
    {
        const char *folder = write_views("colours", (cm_sequence_layout)layout, 0);
        for (unsigned k = 0; k < VIEWS; k++)
        {
            char name[100] = "colours/", file[60];
            name_depth(file, layout, k);
            strcat(name, file);
            remove_all(in_folder(name));
        }
        remove_all(in_folder("colours/depth.txt"));
        ck_assert_int_ne(open_all(folder, NULL), CM_OK);
        cm_sequence *sequence = NULL;
        REQUIRE(cm_sequence_open(folder, &options, &sequence, message) == CM_OK, "%s", message);
        ck_assert_uint_eq(cm_sequence_count(sequence), VIEWS);
        for (unsigned k = 0; k < VIEWS; k++)
        {
            cm_sequence_entry entry;
            const cm_view *view = NULL;
            ck_assert_int_eq(cm_sequence_entry_at(sequence, k, &entry, message), CM_OK);
            REQUIRE(entry.depth == NULL && entry.color != NULL, "view %u", k);
            REQUIRE(cm_sequence_view(sequence, k, &view, message) == CM_OK, "%s", message);
            const cm_view wanted = make_view(view->camera, k, 0);
            ck_assert(view->depth.data == NULL && view->color.data != NULL);
            ck_assert(fabs(view->pose.position[1] - wanted.pose.position[1]) < 1e-6);
        }
        cm_sequence_close(sequence);
    }
}
END_TEST

/* Poses and colours 0.02 s from the depth, as they are written; a millionth more is too much. */
START_TEST(times_are_near_as_written)
{
    static const struct
    {
        const char *pose, *color;
        size_t views, without_color;
    } cases[] = {{"1.02", "0.98", VIEWS, 0},
                 {"0.98", "1.02", VIEWS, 0},
                 {"1.020001", "1", VIEWS - 1, 0},
                 {"1", "1.020001", VIEWS, 1}};
    const char *folder = write_views("near", CM_SEQUENCE_TUM, 0);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
    {
        char poses[400], list[400];
        snprintf(poses, sizeof poses,
                 "%s 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n3 0 0 0 0 0 0 1\n4 0 0 0 0 0 0 1\n"
                 "5 0 0 0 0 0 0 1\n",
                 cases[i].pose);
        snprintf(list, sizeof list,
                 "%s rgb/100.250000.png\n2 rgb/101.250000.png\n3 rgb/102.250000.png\n"
                 "4 rgb/103.250000.png\n5 rgb/104.250000.png\n",
                 cases[i].color);
        write_text("near/groundtruth.txt", poses);
        write_text("near/rgb.txt", list);
        write_text("near/depth.txt", "1 depth/100.250000.png\n2 depth/101.250000.png\n"
                                     "3 depth/102.250000.png\n4 depth/103.250000.png\n"
                                     "5 depth/104.250000.png\n");
        cm_sequence *sequence = open_views(folder, NULL);
        const cm_sequence_report *report = cm_sequence_describe(sequence);
        REQUIRE(report->count == cases[i].views && report->without_color == cases[i].without_color,
                "%s and %s: %zu views, %zu without colours", cases[i].pose, cases[i].color,
                report->count, report->without_color);
        cm_sequence_close(sequence);
    }
}
END_TEST

/* A sequence of one view whose depth is this file. */
static const char *one_view(const char *depth_name)
{
    static char folder[300];
    char list[200];
    cm_camera *camera = make_camera(WIDTH);
    snprintf(list, sizeof list, "1 %s\n", depth_name);
    write_text("one/depth.txt", list);
    write_text("one/groundtruth.txt", "1 0 0 0 0 0 0 1\n");
    REQUIRE(cm_camera_file_write(in_folder("one/camera.json"), camera, 1.0, message) == CM_OK, "%s",
            message);
    cm_camera_destroy(camera);
    snprintf(folder, sizeof folder, "%s", in_folder("one"));
    return folder;
}

START_TEST(bad_pictures_are_refused)
{
    const char *folder = write_views("bad", CM_SEQUENCE_TUM, 0);
    size_t count = 0;
    char *bytes = read_file(in_folder("bad/depth/100.250000.png"), &count);
    const char *one = one_view("d.png");
    REQUIRE(bytes != NULL, "no picture");
    for (size_t i = 0; i < count; i += 7)
    {
        write_file("one/d.png", bytes, i);
        ck_assert_int_eq(open_all(one, NULL), CM_ERROR_DATA);
        REQUIRE(strstr(message, "one/d.png") != NULL && strchr(message, '\n') == NULL, "%s",
                message);
    }
    write_file("one/d.png", bytes, count);
    REQUIRE(open_all(one, NULL) == CM_OK, "%s", message);
    free(bytes);
    /* another camera's size */
    cm_camera *wide = make_camera(WIDTH + 1);
    const char *camera = in_folder("wide.json");
    REQUIRE(cm_camera_file_write(camera, wide, 5000.0, message) == CM_OK, "%s", message);
    cm_camera_destroy(wide);
    ck_assert_int_eq(open_all(folder, camera), CM_ERROR_DATA);
    REQUIRE(strstr(message, "8 x 6") != NULL && strstr(message, "9 x 6") != NULL, "%s", message);
    /* colours are no depth: 8 bits of three channels */
    bytes = read_file(in_folder("bad/rgb/100.250000.png"), &count);
    write_file("one/d.png", bytes, count);
    free(bytes);
    ck_assert_int_eq(open_all(one, NULL), CM_ERROR_DATA);
    REQUIRE(strstr(message, "3 channels") != NULL, "%s", message);
    /* 8 bits */
    char grey[100] = "P5 8 6 255\n";
    write_file("one/d.pgm", grey, 11 + WIDTH * HEIGHT);
    ck_assert_int_eq(open_all(one_view("d.pgm"), NULL), CM_ERROR_DATA);
    REQUIRE(strstr(message, "8") != NULL && strstr(message, "16 bits") != NULL, "%s", message);
}
END_TEST

START_TEST(depths_of_floating_point_are_read)
{
    cm_camera *camera = make_camera(WIDTH);
    const cm_view view = make_view(camera, 0, 1);
    cm_camera_destroy(camera);
    const char *folder = one_view("d.npy");
    REQUIRE(cm_npy_write(in_folder("one/d.npy"), &view.depth, message) == CM_OK, "%s", message);
    cm_sequence *sequence = open_views(folder, NULL);
    const cm_view *read = NULL;
    REQUIRE(cm_sequence_view(sequence, 0, &read, message) == CM_OK, "%s", message);
    REQUIRE(read->depth.type == CM_PIXEL_FLOAT && read->depth_unit == 1.0 &&
                memcmp(read->depth.data, depth_metres, sizeof depth_metres) == 0,
            "another depth");
    cm_sequence_close(sequence);
    folder = one_view("d.NPY");
    REQUIRE(cm_npy_write(in_folder("one/d.NPY"), &view.depth, message) == CM_OK, "%s", message);
    sequence = open_views(folder, NULL);
    REQUIRE(cm_sequence_view(sequence, 0, &read, message) == CM_OK, "%s", message);
    cm_sequence_close(sequence);
    /* EXR */
    const cm_image_io *io = cm_image_io_get(message);
    REQUIRE(io != NULL, "%s", message);
    cm_image_description description = {.format = "openexr",
                                        .width = WIDTH,
                                        .height = HEIGHT,
                                        .channels = 1,
                                        .type = CM_PIXEL_FLOAT,
                                        .alpha = -1,
                                        .orientation = 1};
    cm_image_writer *writer = NULL;
    folder = one_view("d.exr");
    REQUIRE(io->create(in_folder("one/d.exr"), NULL, &description, &writer, message) == CM_OK &&
                io->write(writer, 0, HEIGHT, CM_PIXEL_FLOAT, depth_metres, 0, 0, message) ==
                    CM_OK &&
                io->finish(writer, message) == CM_OK,
            "%s", message);
    io->drop(writer);
    sequence = open_views(folder, NULL);
    REQUIRE(cm_sequence_view(sequence, 0, &read, message) == CM_OK, "%s", message);
    REQUIRE(memcmp(read->depth.data, depth_metres, sizeof depth_metres) == 0, "another depth");
    cm_sequence_close(sequence);
}
END_TEST

START_TEST(bad_folders_are_refused)
{
    const struct
    {
        const char *file;
        const char *text;
        cm_status status;
        const char *word;
    } cases[] = {
        {"depth.txt", "1 a b\n", CM_ERROR_DATA, "depth.txt:1: "},
        {"depth.txt", "1 a\n1 b\n", CM_ERROR_DATA, "depth.txt:2: "},
        {"depth.txt", "nan a\n", CM_ERROR_DATA, "depth.txt:1: "},
        {"depth.txt", "", CM_ERROR_FILE, "no view"},
        {"groundtruth.txt", "1 0 0 nan 0 0 0 1\n", CM_ERROR_DATA, "groundtruth.txt:1: "},
        {"groundtruth.txt", "1 0 0 0 0 0 0 0\n", CM_ERROR_CAMERA, "groundtruth.txt:1: "},
        {"groundtruth.txt", "2 0 0 0 0 0 0 1\n", CM_ERROR_FILE, "no view"},
        {"camera.json", "{", CM_ERROR_DATA, "camera.json:1: "},
        {"rgb.txt", "x y\n", CM_ERROR_DATA, "rgb.txt:1: "},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
    {
        char name[100];
        const char *folder = write_views("wrong", CM_SEQUENCE_TUM, 0);
        snprintf(name, sizeof name, "wrong/%s", cases[i].file);
        write_text(name, cases[i].text);
        const cm_status status = open_all(folder, NULL);
        REQUIRE(status == cases[i].status && strstr(message, cases[i].word) != NULL, "%zu: %d %s",
                i, (int)status, message);
    }
    const char *folder = write_views("wrong", CM_SEQUENCE_OPEN3D, 0);
    remove_all(in_folder("wrong/camera.json"));
    ck_assert_int_eq(open_all(folder, NULL), CM_ERROR_CAMERA);
    remove_all(in_folder("wrong/trajectory.log"));
    ck_assert_int_eq(open_all(folder, NULL), CM_ERROR_DATA);
    ck_assert_int_eq(open_all(in_folder("none"), NULL), CM_ERROR_FILE);
    folder = write_views("wrong", CM_SEQUENCE_SEVEN_SCENES, 0);
    write_text("wrong/frame-000002.pose.txt", "1 0 0 0\n0 1 0 0\n0 0 nan 0\n0 0 0 1\n");
    ck_assert_int_eq(open_all(folder, NULL), CM_ERROR_DATA);
    REQUIRE(strstr(message, "frame-000002.pose.txt:3: ") != NULL, "%s", message);
    ck_assert_int_eq(cm_sequence_open(NULL, NULL, NULL, message), CM_ERROR_ARGUMENT);
    cm_sequence_layout layout;
    ck_assert_int_eq(cm_sequence_layout_find("7scenes", &layout), CM_OK);
    REQUIRE(layout == CM_SEQUENCE_SEVEN_SCENES && cm_sequence_layout_name(layout) != NULL &&
                cm_sequence_layout_name((cm_sequence_layout)77) == NULL,
            "names");
    ck_assert_int_eq(cm_sequence_layout_find("x", &layout), CM_ERROR_ARGUMENT);
}
END_TEST

/* A child whose standard output is the file: it writes views there. */
static int write_output(const char *path)
{
    const pid_t child = fork();
    if (child == 0)
    {
        cm_camera *camera = make_camera(WIDTH);
        cm_sequence_writer *writer = NULL;
        int good =
            freopen(path, "wb", stdout) != NULL &&
            cm_sequence_create("-", CM_SEQUENCE_STREAM, camera, 5000.0, &writer, message) == CM_OK;
        for (unsigned k = 0; good && k < VIEWS; k++)
        {
            const cm_view view = make_view(camera, k, (int)(k % 2));
            good = cm_sequence_write(writer, &view, NULL, message) == CM_OK;
        }
        _exit(good && cm_sequence_finish(writer, message) == CM_OK ? 0 : 1);
    }
    int status = 1;
    return waitpid(child, &status, 0) == child ? status : 1;
}

/* A child whose standard input is the file: how many views it reads, or 99 if they do not end well. */
static int read_input(const char *path)
{
    const pid_t child = fork();
    if (child == 0)
    {
        cm_sequence *sequence = NULL;
        if (freopen(path, "rb", stdin) == NULL ||
            cm_sequence_open("-", NULL, &sequence, message) != CM_OK ||
            cm_sequence_count(sequence) != CM_SEQUENCE_UNKNOWN)
        {
            _exit(99);
        }
        const cm_view *view = NULL;
        unsigned k = 0;
        cm_status status = CM_OK;
        while ((status = cm_sequence_view(sequence, k, &view, message)) == CM_OK &&
               view->time == 100.25 + k)
        {
            k++;
        }
        const size_t count = cm_sequence_describe(sequence)->count;
        _exit(status == CM_ERROR_RANGE && count == k ? (int)k : 99);
    }
    int status = 99 << 8;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 99;
}

START_TEST(streams_are_sequences)
{
    char path[300];
    snprintf(path, sizeof path, "%s", in_folder("stream"));
    ck_assert_int_eq(write_output(path), 0);
    ck_assert_int_eq(read_input(path), VIEWS);
    size_t count = 0;
    char *bytes = read_file(path, &count);
    write_file("stream", bytes, count - 1);
    ck_assert_int_eq(read_input(path), 99);
    free(bytes);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {views_come_back_in_each_layout,
                                  ranges_become_depths,
                                  what_is_absent_is_counted,
                                  colours_will_do,
                                  times_are_near_as_written,
                                  bad_pictures_are_refused,
                                  depths_of_floating_point_are_read,
                                  bad_folders_are_refused,
                                  streams_are_sequences,
                                  NULL};
    return run_suite("sequence", tests);
}
