/* SPDX-License-Identifier: MIT
 *
 * The recordings of others, TUM's and ICL's: what is listed, what is absent, that all that is there can be read, and what is
 * said where a camera is not given or is another. CUBEMAP_RGBD names their folder; without it the program ends with 77.
 */
#include "modules/scene/io/sequence.h"

#include "tests/suite.h"
#include "written_files.h"

static char message[CM_IMAGE_MESSAGE];
static char folder[400];

static const char *recording(const char *name)
{
    snprintf(folder, sizeof folder, "%s/%s", getenv("CUBEMAP_RGBD"), name);
    return folder;
}

static const char *write_camera(unsigned width, double scale)
{
    char text[200];
    snprintf(text, sizeof text,
             "{\"width\":%u,\"height\":480,\"fx\":525,\"fy\":525,\"cx\":319.5,\"cy\":239.5,"
             "\"depth_scale\":%g}",
             width, scale);
    return write_text("recording.json", text);
}

static cm_status open_recording(const char *name, const char *camera, cm_sequence **sequence)
{
    const cm_sequence_options options = {.size = sizeof options, .camera = camera};
    message[0] = '\0';
    return cm_sequence_open(recording(name), &options, sequence, message);
}

/* Between the nearest wall and the farthest: depths in metres, not in units. */
static void check_picture(const cm_view *view, unsigned k)
{
    const uint16_t *depth = view->depth.data;
    double most = 0.0;
    for (int i = 0; i < 640 * 480; i++)
    {
        most = fmax(most, depth[i] * view->depth_unit);
    }
    REQUIRE(view->depth.type == CM_PIXEL_U16 && most > 1.0 && most < 14.0, "view %u: %g m", k,
            most);
    REQUIRE(cm_pose_check(&view->pose) == CM_OK, "view %u: no pose", k);
    REQUIRE(view->color.data == NULL || view->color.channels == 3, "view %u: %u channels", k,
            view->color.channels);
}

static void check_recording(const char *name, double scale, size_t listed, size_t count)
{
    cm_sequence *sequence = NULL;
    REQUIRE(open_recording(name, write_camera(640, scale), &sequence) == CM_OK, "%s", message);
    const cm_sequence_report *report = cm_sequence_describe(sequence);
    REQUIRE(report->listed == listed && report->count == count && report->absent == listed - count,
            "%s: %zu of %zu, %zu absent, %zu without pose", name, report->count, report->listed,
            report->absent, report->without_pose);
    REQUIRE(report->without_color < count, "all without colours");
    double before = -INFINITY;
    for (unsigned k = 0; k < count; k++)
    {
        const cm_view *view = NULL;
        REQUIRE(cm_sequence_view(sequence, k, &view, message) == CM_OK, "%s", message);
        REQUIRE(view->time > before, "view %u: %g s", k, view->time);
        before = view->time;
        check_picture(view, k);
    }
    cm_sequence_close(sequence);
}

START_TEST(all_that_is_there_is_read)
{
    check_recording("tum_excerpt", 5000.0, 722, 40);
    check_recording("icl_livingroom1", 1000.0, 211, 31);
}
END_TEST

/* Entry N of trajectory.log is file N. */
START_TEST(entries_are_files)
{
    cm_sequence *sequence = NULL;
    cm_sequence_entry entry;
    REQUIRE(open_recording("icl_livingroom1", write_camera(640, 1000), &sequence) == CM_OK, "%s",
            message);
    for (size_t k = 0; k < 31; k++)
    {
        char wanted[40];
        snprintf(wanted, sizeof wanted, "depth_%05zu.png", 3 * k);
        ck_assert_int_eq(cm_sequence_entry_at(sequence, k, &entry, message), CM_OK);
        REQUIRE(strcmp(entry.depth, wanted) == 0, "%s, not %s", entry.depth, wanted);
        REQUIRE(fabs(entry.time - 3.0 * (double)k / 30.0) < 1e-12, "%g", entry.time);
    }
    cm_sequence_close(sequence);
}
END_TEST

START_TEST(cameras_are_needed_and_fit)
{
    cm_sequence *sequence = NULL;
    const cm_view *view = NULL;
    ck_assert_int_eq(open_recording("tum_excerpt", NULL, &sequence), CM_ERROR_CAMERA);
    REQUIRE(strstr(message, "camera.json") != NULL, "%s", message);
    REQUIRE(open_recording("tum_excerpt", write_camera(641, 5000), &sequence) == CM_OK, "%s",
            message);
    ck_assert_int_eq(cm_sequence_view(sequence, 0, &view, message), CM_ERROR_DATA);
    REQUIRE(strstr(message, "640 x 480") != NULL && strstr(message, "641 x 480") != NULL, "%s",
            message);
    cm_sequence_close(sequence);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {all_that_is_there_is_read, entries_are_files,
                                  cameras_are_needed_and_fit, NULL};
    if (getenv("CUBEMAP_RGBD") == NULL)
    {
        printf("CUBEMAP_RGBD names no folder of recordings\n");
        return 77;
    }
    return run_suite("recordings", tests);
}
