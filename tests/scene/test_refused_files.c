/* SPDX-License-Identifier: MIT
 *
 * Files of scenes where the system has no memory: each allocation of what is read or written fails once, those of SQLite,
 * zstd and cJSON among them. That is told as what it is, or nothing was lost by it; outputs stay as they were, all blocks are
 * given back, no file is left behind. The C library's own functions are replaced, as glibc allows. OpenImageIO has what it asks
 * for: it ends the program otherwise.
 */
#define _POSIX_C_SOURCE 200809L

#include "modules/scene/io/camera_file.h"
#include "modules/scene/io/npy_file.h"
#include "modules/scene/io/ply_file.h"
#include "modules/scene/io/sequence.h"
#include "modules/scene/io/store_file.h"
#include "modules/scene/io/trajectory_file.h"
#include "modules/scene/io/view_stream.h"
#ifdef HAVE_MESHES
#include "modules/scene/io/mesh_file.h"
#endif

#include <unistd.h>

#include "tests/memory_stream.h"
#include "tests/suite.h"
#include "tests/refused_allocation.h"
#include "written_files.h"

/* ---- pictures, whose library is linked with --wrap ---- */

const cm_image_io *__real_cm_image_io_get(char *message);
const cm_image_io *__wrap_cm_image_io_get(char *message);

static const cm_image_io *pictures;

/* What is called between has its memory. */
#define AT_EASE(type, call)                                                                        \
    const int kept = blocks_until_refusal;                                                         \
    blocks_until_refusal = -1;                                                                     \
    const type result = pictures->call;                                                            \
    blocks_until_refusal = kept;                                                                   \
    return result

static cm_status open_picture(const char *path, uint32_t subimage, cm_image_reader **reader,
                              char *message)
{
    AT_EASE(cm_status, open(path, subimage, reader, message));
}

static cm_status read_picture(cm_image_reader *reader, const cm_image_region *region,
                              cm_pixel_type type, void *pixels, ptrdiff_t row_stride, char *message)
{
    AT_EASE(cm_status, read(reader, region, type, pixels, row_stride, message));
}

static cm_status create_picture(const char *path, const cm_image_stream *stream,
                                const cm_image_description *description, cm_image_writer **writer,
                                char *message)
{
    AT_EASE(cm_status, create(path, stream, description, writer, message));
}

static cm_status write_picture(cm_image_writer *writer, uint32_t first, uint32_t end,
                               cm_pixel_type type, const void *pixels, ptrdiff_t pixel_stride,
                               ptrdiff_t row_stride, char *message)
{
    AT_EASE(cm_status, write(writer, first, end, type, pixels, pixel_stride, row_stride, message));
}

static cm_status finish_picture(cm_image_writer *writer, char *message)
{
    AT_EASE(cm_status, finish(writer, message));
}

const cm_image_io *__wrap_cm_image_io_get(char *message)
{
    static cm_image_io table;
    pictures = __real_cm_image_io_get(message);
    if (pictures != NULL)
    {
        table = *pictures;
        table.open = open_picture;
        table.read = read_picture;
        table.create = create_picture;
        table.write = write_picture;
        table.finish = finish_picture;
    }
    return pictures == NULL ? NULL : &table;
}

enum
{
    WIDTH = 8,
    HEIGHT = 6,
    VIEWS = 2,
    ROOM = 1 << 16
};

static char text[CM_IMAGE_MESSAGE];
static uint16_t depth[WIDTH * HEIGHT];
static unsigned char color[3 * WIDTH * HEIGHT];
static cm_camera *camera;
static unsigned char stream_bytes[ROOM];
static size_t stream_size;

static cm_view make_view(unsigned k)
{
    for (unsigned i = 0; i < WIDTH * HEIGHT; i++)
    {
        depth[i] = (uint16_t)(1000 + 10 * i + k);
        color[3 * i] = (unsigned char)i;
    }
    cm_view view = {.size = sizeof view,
                    .time = 1.0 + k,
                    .camera = camera,
                    .pose.rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                    .depth_unit = 0.001};
    view.depth = (cm_image){.size = sizeof view.depth,
                            .data = depth,
                            .type = CM_PIXEL_U16,
                            .width = WIDTH,
                            .height = HEIGHT,
                            .channels = 1};
    view.color = (cm_image){.size = sizeof view.color,
                            .data = color,
                            .type = CM_PIXEL_U8,
                            .width = WIDTH,
                            .height = HEIGHT,
                            .channels = 3};
    return view;
}

/* ---- what is tried: each gives back all that it takes; *wrong says what should not be ---- */

typedef cm_status (*trial)(const char **wrong);

static cm_status read_camera(const char **wrong)
{
    cm_camera *made = NULL;
    double scale = 0.0;
    const cm_status status = cm_camera_file_read(in_folder("camera.json"), &made, &scale, text);
    *wrong = status != CM_OK && (made != NULL || scale != 0.0) ? "an output" : NULL;
    cm_camera_destroy(made);
    return status;
}

static cm_status read_mapping(const char **wrong)
{
    cm_camera *made = NULL;
    double scale = 0.0;
    const cm_status status = cm_camera_file_read(in_folder("cube.json"), &made, &scale, text);
    *wrong = status != CM_OK && made != NULL ? "an output" : NULL;
    cm_camera_destroy(made);
    return status;
}

static cm_status write_camera(const char **wrong)
{
    (void)wrong;
    return cm_camera_file_write(in_folder("camera.json"), camera, 1000.0, text);
}

static cm_status read_poses(const char **wrong)
{
    cm_pose_list list = {.count = 0};
    const cm_status status = cm_trajectory_file_read(in_folder("path.txt"), &list, text);
    *wrong = status != CM_OK && list.pose != NULL ? "an output" : NULL;
    cm_pose_list_clear(&list);
    return status;
}

static cm_status read_log(const char **wrong)
{
    cm_pose_list list = {.count = 0};
    const cm_status status = cm_trajectory_log_read(in_folder("trajectory.log"), &list, text);
    *wrong = status != CM_OK && list.pose != NULL ? "an output" : NULL;
    cm_pose_list_clear(&list);
    return status;
}

static cm_status write_poses(const char **wrong)
{
    (void)wrong;
    const double time[] = {1.0, 2.0};
    const cm_pose pose = make_view(0).pose;
    const cm_pose all[] = {pose, pose};
    return cm_trajectory_file_write(in_folder("path.txt"), 2, time, all, text);
}

static cm_status write_log(const char **wrong)
{
    (void)wrong;
    const cm_pose pose = make_view(0).pose;
    return cm_trajectory_log_write(in_folder("trajectory.log"), 1, &pose, text);
}

static cm_status write_npy(const char **wrong)
{
    (void)wrong;
    const cm_view view = make_view(0);
    return cm_npy_write(in_folder("a.npy"), &view.depth, text);
}

static cm_status read_npy(const char **wrong)
{
    cm_image picture = {.size = 0};
    const cm_status status = cm_npy_read(in_folder("a.npy"), &picture, text);
    *wrong = status != CM_OK && picture.data != NULL ? "an output" : NULL;
    free(picture.data);
    return status;
}

static cm_status write_ply(const char **wrong)
{
    (void)wrong;
    double position[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    uint32_t corner[3] = {0, 1, 2};
    const cm_ply ply = {
        .point_count = 3, .position = position, .triangle_count = 1, .corner = corner};
    return cm_ply_write(in_folder("a.ply"), &ply, true, text);
}

static cm_status read_ply(const char **wrong)
{
    cm_ply ply = {.point_count = 0};
    const cm_status status = cm_ply_read(in_folder("a.ply"), &ply, text);
    *wrong = status != CM_OK && ply.position != NULL ? "an output" : NULL;
    cm_ply_clear(&ply);
    return status;
}

static cm_status write_stream(const char **wrong)
{
    memory_stream memory = {stream_bytes, 0, ROOM, 0};
    const cm_image_stream stream = stream_of(&memory);
    cm_view_writer *writer = NULL;
    const cm_view view = make_view(0);
    cm_status status = cm_view_writer_create("it", &stream, camera, 1000.0, &writer, text);
    *wrong = status != CM_OK && writer != NULL ? "an output" : NULL;
    status = status == CM_OK ? cm_view_writer_put(writer, &view, text) : status;
    status = status == CM_OK ? cm_view_writer_finish(writer, text) : status;
    cm_view_writer_destroy(writer);
    stream_size = memory.size;
    return status;
}

static cm_status read_stream(const char **wrong)
{
    memory_stream memory = {stream_bytes, stream_size, ROOM, 0};
    const cm_image_stream stream = stream_of(&memory);
    cm_view_reader *reader = NULL;
    const cm_view *view = NULL;
    cm_status status = cm_view_reader_create("it", &stream, &reader, text);
    *wrong = status != CM_OK && reader != NULL ? "an output" : NULL;
    status = status == CM_OK ? cm_view_reader_next(reader, &view, text) : status;
    *wrong = status != CM_OK && view != NULL ? "a view" : *wrong;
    cm_view_reader_destroy(reader);
    return status;
}

static cm_status write_sequence(const char *name, cm_sequence_layout layout, const char **wrong)
{
    cm_sequence_writer *writer = NULL;
    cm_status status = cm_sequence_create(name, layout, camera, 1000.0, &writer, text);
    *wrong = status != CM_OK && writer != NULL ? "an output" : NULL;
    for (unsigned k = 0; k < VIEWS && status == CM_OK; k++)
    {
        const cm_view view = make_view(k);
        status = cm_sequence_write(writer, &view, NULL, text);
    }
    status = status == CM_OK ? cm_sequence_finish(writer, text) : status;
    cm_sequence_drop(writer);
    const int kept = blocks_until_refusal;
    blocks_until_refusal = -1;
    const int entries = count_entries(name);
    *wrong = status != CM_OK && entries >= 0 ? "a folder is there" : *wrong;
    remove_all(name);
    blocks_until_refusal = kept;
    return status;
}

static cm_status write_tum(const char **wrong)
{
    return write_sequence(in_folder("new"), CM_SEQUENCE_TUM, wrong);
}

static cm_status write_open3d(const char **wrong)
{
    return write_sequence(in_folder("new"), CM_SEQUENCE_OPEN3D, wrong);
}

static cm_status write_seven_scenes(const char **wrong)
{
    return write_sequence(in_folder("new"), CM_SEQUENCE_SEVEN_SCENES, wrong);
}

static cm_status read_sequence(const char *name, const char **wrong)
{
    cm_sequence *sequence = NULL;
    cm_status status = cm_sequence_open(name, NULL, &sequence, text);
    *wrong = status != CM_OK && sequence != NULL ? "an output" : NULL;
    for (size_t k = 0; k < VIEWS && status == CM_OK; k++)
    {
        const cm_view *view = NULL;
        status = cm_sequence_view(sequence, k, &view, text);
        *wrong = status != CM_OK && view != NULL ? "a view" : *wrong;
        *wrong = status == CM_OK && view->color.data == NULL ? "no colours" : *wrong;
    }
    cm_sequence_close(sequence);
    return status;
}

static cm_status read_tum(const char **wrong)
{
    return read_sequence(in_folder("tum"), wrong);
}

static cm_status read_open3d(const char **wrong)
{
    return read_sequence(in_folder("open3d"), wrong);
}

static cm_status read_seven_scenes(const char **wrong)
{
    return read_sequence(in_folder("7scenes"), wrong);
}

static cm_status put_blob(cm_store *store, unsigned char byte)
{
    unsigned char data[3000];
    memset(data, byte, sizeof data);
    const cm_store_key key = {"a", 1};
    const cm_blob blob = {sizeof blob, 1, 1, data, sizeof data};
    return cm_store_put(store, &key, &blob);
}

/* What was committed is there, whatever came after it. */
static const char *check_store(void)
{
    const int kept = blocks_until_refusal;
    blocks_until_refusal = -1;
    cm_store *store = NULL;
    const cm_store_key key = {"a", 1};
    cm_blob blob = {.size = sizeof blob};
    cm_status status = cm_store_file_open(in_folder("store"), NULL, &store, text);
    status = status == CM_OK ? cm_store_get(store, &key, 1, 1, &blob) : status;
    const unsigned char *bytes = blob.data;
    const char *wrong = status != CM_OK                       ? "it is not opened"
                        : bytes == NULL || blob.count != 3000 ? "no blob"
                        : bytes[0] != 7 && bytes[0] != 8      ? "another blob"
                                                              : NULL;
    cm_blob_clear(&blob);
    cm_store_destroy(store);
    blocks_until_refusal = kept;
    return wrong;
}

static cm_status make_store(const char **wrong)
{
    const cm_store_file_options options = {.size = sizeof options, .create = 1};
    cm_store *store = NULL;
    const char *path = in_folder("new-store");
    cm_status status = cm_store_file_open(path, &options, &store, text);
    *wrong = status != CM_OK && store != NULL ? "an output" : NULL;
    status = status == CM_OK ? put_blob(store, 1) : status;
    status = status == CM_OK ? cm_store_commit(store) : status;
    cm_store_destroy(store);
    unlink(path);
    unlink(in_folder(
        "new-store-journal")); /* empty; it stays if there is no memory to close the store */
    return status;
}

static cm_status use_store(const char **wrong)
{
    cm_store *store = NULL;
    const cm_store_key key = {"a", 1};
    cm_blob blob = {.size = sizeof blob};
    unsigned char found[CM_STORE_KEY_MAX];
    size_t count = 0;
    cm_status status = cm_store_file_open(in_folder("store"), NULL, &store, text);
    status = status == CM_OK ? cm_store_get(store, &key, 1, 1, &blob) : status;
    status = status == CM_OK ? cm_store_next(store, NULL, found, &count) : status;
    status = status == CM_OK ? put_blob(store, 9) : status;
    status = status == CM_OK ? cm_store_rollback(store) : status;
    status = status == CM_OK ? put_blob(store, 8) : status;
    status = status == CM_OK ? cm_store_commit(store) : status;
    if (status != CM_OK && store != NULL)
    {
        *wrong = cm_store_message(store)[0] == '\0' ? "no message" : NULL;
        const int kept = blocks_until_refusal;
        blocks_until_refusal = -1;
        *wrong = cm_store_rollback(store) != CM_OK ? "no rollback" : *wrong;
        blocks_until_refusal = kept;
    }
    cm_blob_clear(&blob);
    cm_store_destroy(store);
    const char *damage = check_store();
    *wrong = damage != NULL ? damage : *wrong;
    return status;
}

#ifdef HAVE_MESHES
static cm_status read_mesh(const char *name, const char **wrong)
{
    cm_mesh *mesh = NULL;
    const cm_status status = cm_mesh_file_read(name, NULL, &mesh, text);
    *wrong = status != CM_OK && mesh != NULL ? "an output" : NULL;
    cm_mesh_destroy(mesh);
    return status;
}

static cm_status read_obj(const char **wrong)
{
    return read_mesh(in_folder("a.obj"), wrong);
}
#endif

/* ---- */

static int bad;

static void complain(const char *name, int which, const char *what)
{
    bad++;
    printf("%s, allocation %d: %s: %s\n", name, which, what, text);
}

/* Returns how many allocations there are to fail. */
static int fail_each(const char *name, trial call)
{
    const char *ignored = NULL;
    /* what libraries make once, and keep */
    REQUIRE(call(&ignored) == CM_OK && ignored == NULL, "%s: %s", name, text);
    REQUIRE(call(&ignored) == CM_OK && ignored == NULL, "%s: %s", name, text);
    const int entries = count_entries(test_folder());
    for (int i = 0;; i++)
    {
        const char *wrong = NULL;
        const int before = blocks_alive();
        text[0] = '\0';
        blocks_until_refusal = i;
        const cm_status status = call(&wrong);
        const int met = blocks_until_refusal < 0;
        blocks_until_refusal = -1;
        if (wrong != NULL)
        {
            complain(name, i, wrong);
        }
        if (status != CM_ERROR_MEMORY && status != CM_OK)
        {
            complain(name, i, cm_status_text(status));
        }
        if (blocks_alive() != before)
        {
            complain(name, i, "blocks are lost");
        }
        if (count_entries(test_folder()) != entries)
        {
            complain(name, i, "a file is left behind");
        }
        if (!met)
        {
            return i;
        }
    }
}

static void make_files(void)
{
    const cm_camera_options options = {.size = sizeof options,
                                       .width = WIDTH,
                                       .height = HEIGHT,
                                       .fx = 9,
                                       .fy = 9,
                                       .cx = 3.5,
                                       .cy = 2.5};
    const cm_store_file_options made = {.size = sizeof made, .create = 1};
    cm_store *store = NULL;
    const char *wrong = NULL;
    ck_assert_int_eq(cm_camera_create(&options, &camera), CM_OK);
    write_text("cube.json", "{\"mapping\":\"coupled\",\"frame\":\"geo\",\"size\":4}\n");
    write_text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    REQUIRE(write_camera(&wrong) == CM_OK && write_poses(&wrong) == CM_OK &&
                write_log(&wrong) == CM_OK && write_npy(&wrong) == CM_OK &&
                write_ply(&wrong) == CM_OK,
            "%s", text);
    const char *const folders[] = {"tum", "open3d", "7scenes"};
    for (int i = 0; i < 3; i++)
    {
        cm_sequence_writer *writer = NULL;
        REQUIRE(cm_sequence_create(in_folder(folders[i]), (cm_sequence_layout)(i + 1), camera,
                                   1000.0, &writer, text) == CM_OK,
                "%s", text);
        for (unsigned k = 0; k < VIEWS; k++)
        {
            const cm_view view = make_view(k);
            ck_assert_int_eq(cm_sequence_write(writer, &view, NULL, text), CM_OK);
        }
        REQUIRE(cm_sequence_finish(writer, text) == CM_OK, "%s", text);
        cm_sequence_drop(writer);
    }
    REQUIRE(cm_store_file_open(in_folder("store"), &made, &store, text) == CM_OK, "%s", text);
    ck_assert_int_eq(put_blob(store, 7), CM_OK);
    ck_assert_int_eq(cm_store_commit(store), CM_OK);
    cm_store_destroy(store);
}

START_TEST(each_allocation_fails_once)
{
    static const struct
    {
        const char *name;
        trial call;
    } calls[] = {{"camera", read_camera},
                 {"camera with a mapping", read_mapping},
                 {"camera written", write_camera},
                 {"trajectory", read_poses},
                 {"trajectory written", write_poses},
                 {"log", read_log},
                 {"log written", write_log},
                 {"NPY", read_npy},
                 {"NPY written", write_npy},
                 {"PLY", read_ply},
                 {"PLY written", write_ply},
                 {"stream written", write_stream},
                 {"stream", read_stream},
                 {"new store", make_store},
                 {"store", use_store},
#ifdef HAVE_MESHES
                 {"OBJ", read_obj},
#endif
                 {"TUM", read_tum},
                 {"Open3D", read_open3d},
                 {"7-Scenes", read_seven_scenes},
                 {"TUM written", write_tum},
                 {"Open3D written", write_open3d},
                 {"7-Scenes written", write_seven_scenes}};
    spare_children();
    make_files();
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++)
    {
        const int met = fail_each(calls[i].name, calls[i].call);
        printf("%s: %d allocations\n", calls[i].name, met);
        REQUIRE(met >= 1, "%s", calls[i].name);
    }
    cm_camera_destroy(camera);
    ck_assert_int_eq(bad, 0);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {each_allocation_fails_once, NULL};
    return run_suite("refused files", tests);
}
