/* SPDX-License-Identifier: MIT
 *
 * Texts of cameras and trajectories: what is read, what is written is the same again, and what is wrong is told with file
 * and line.
 */
#define _POSIX_C_SOURCE 200809L

#include "modules/scene/io/camera_file.h"
#include "modules/scene/io/trajectory_file.h"

#include "tests/suite.h"
#include "written_files.h"

static char message[CM_IMAGE_MESSAGE];

typedef struct bad_text
{
    const char *text;
    cm_status status;
    const char *begin; /* of the message */
    const char *word;  /* in it */
} bad_text;

static void check_refusal(const bad_text *bad, cm_status status)
{
    REQUIRE(status == bad->status && strncmp(message, bad->begin, strlen(bad->begin)) == 0 &&
                strstr(message, bad->word) != NULL && strchr(message, '\n') == NULL,
            "%.60s: %d %s", bad->text, (int)status, message);
    message[0] = '\0';
}

#define PINHOLE "{\"width\":640,\"height\":480,\"fx\":525,\"fy\":525,\"cx\":319.5,\"cy\":239.5"

START_TEST(cameras_are_read)
{
    const char *const text = PINHOLE ",\n\"distortion\":[0.1,-0.2]}";
    cm_camera *camera = NULL;
    double scale = 0.0;
    cm_status status = cm_camera_file_parse("a.json", text, strlen(text), &camera, &scale, message);
    REQUIRE(status == CM_OK, "%s", message);
    const cm_camera_options *options = cm_camera_describe(camera);
    REQUIRE(options->width == 640 && options->height == 480 && options->cx == 319.5 &&
                options->pixel_centre == 0.0 && options->distortion[1] == -0.2 &&
                options->distortion[2] == 0.0 && options->mapping == NULL && scale == 5000.0,
            "other numbers");
    cm_camera_destroy(camera);
    const char *const mapped =
        "{\"mapping\":\"coupled\",\"frame\":\"gl\",\"size\":64,\"depth_scale\":1000}";
    status = cm_camera_file_parse("b.json", mapped, strlen(mapped), &camera, &scale, message);
    REQUIRE(status == CM_OK, "%s", message);
    options = cm_camera_describe(camera);
    REQUIRE(options->width == 64 && options->height == 384 && options->mapping != NULL &&
                strcmp(cm_mapping_frame(options->mapping)->identifier, "gl") == 0 &&
                scale == 1000.0,
            "other numbers");
    cm_camera_destroy(camera);
}
END_TEST

START_TEST(cameras_are_the_same_when_read_again)
{
    const char *const texts[] = {
        PINHOLE ",\"distortion\":[0.1,-0.2,1e-3,0.3333333333333333],\"pixel_centre\":0.5}",
        "{\"mapping\":\"tangent:c=0.7\",\"size\":16,\"depth_scale\":333.25}",
        "{\"mapping\":\"azimuthal:equidistant\",\"size\":16}",
        "{\"mapping\":\"border\",\"size\":16}",
        "{\"mapping\":\"border:lambert,radial\",\"size\":16}",
        "{\"mapping\":\"border:lon=30.5\",\"frame\":\"gl\",\"size\":16}",
        "{\"mapping\":\"quincuncial:mixture,elliptical,lat=10,beta=0.25\",\"size\":16}"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
    {
        cm_camera *camera = NULL, *again = NULL;
        double scale, scale_again;
        cm_status status =
            cm_camera_file_parse("x", texts[i], strlen(texts[i]), &camera, &scale, message);
        REQUIRE(status == CM_OK, "%s", message);
        const char *path = in_folder("again.json");
        REQUIRE(cm_camera_file_write(path, camera, scale, message) == CM_OK, "%s", message);
        REQUIRE(cm_camera_file_read(path, &again, &scale_again, message) == CM_OK, "%s", message);
        cm_camera_options a = *cm_camera_describe(camera), b = *cm_camera_describe(again);
        REQUIRE((a.mapping == NULL) == (b.mapping == NULL) && scale == scale_again, "%zu", i);
        if (a.mapping != NULL)
        {
            REQUIRE(cm_mapping_describe(a.mapping) == cm_mapping_describe(b.mapping) &&
                        (cm_mapping_describe(a.mapping)->parameter_count == 0 ||
                         cm_mapping_parameter(a.mapping, 0) == cm_mapping_parameter(b.mapping, 0)),
                    "%zu", i);
        }
        const double point[3] = {0.3, -0.5, 0.7};
        double place[2], place_again[2];
        cm_camera_project_array(camera, 1, &point[0], &point[1], &point[2], &place[0], &place[1]);
        cm_camera_project_array(again, 1, &point[0], &point[1], &point[2], &place_again[0],
                                &place_again[1]);
        REQUIRE(memcmp(place, place_again, sizeof place) == 0 && place[0] == place[0], "%zu", i);
        a.mapping = b.mapping = NULL;
        REQUIRE(memcmp(&a, &b, sizeof a) == 0, "camera %zu is another one", i);
        cm_camera_destroy(camera);
        cm_camera_destroy(again);
    }
}
END_TEST

START_TEST(bad_cameras_are_refused)
{
    const bad_text bad[] = {
        {"", CM_ERROR_DATA, "c.json:1: ", "JSON"},
        {"[1]", CM_ERROR_DATA, "c.json:1: ", "object"},
        {"{\"width\":\n\n1,,}", CM_ERROR_DATA, "c.json:3: ", "JSON"},
        {PINHOLE "} {}", CM_ERROR_DATA, "c.json:1: ", "no JSON object"},
        {"{\"width\":640}", CM_ERROR_CAMERA, "c.json:1: ", "height is missing"},
        {PINHOLE ",\n\"distorsion\":[]}", CM_ERROR_CAMERA, "c.json:2: ", "distorsion"},
        {PINHOLE ",\n\"distortion\":[1,\"a\"]}", CM_ERROR_CAMERA, "c.json:2: ", "finite"},
        {PINHOLE ",\"distortion\":[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0]}", CM_ERROR_CAMERA,
         "c.json:1: ", "14"},
        {PINHOLE ",\"depth_scale\":0}", CM_ERROR_CAMERA, "c.json:1: ", "depth_scale"},
        {PINHOLE ",\"depth_scale\":-1}", CM_ERROR_CAMERA, "c.json:1: ", "depth_scale"},
        {PINHOLE ",\"depth_scale\":1e999}", CM_ERROR_CAMERA, "c.json:1: ", "finite"},
        {PINHOLE ",\"width\":640}", CM_ERROR_CAMERA, "c.json:1: ", "twice"},
        {PINHOLE ",\"size\":640}", CM_ERROR_CAMERA, "c.json:1: ", "mapping"},
        {"{\"width\":640,\"height\":480,\n\"fx\":0,\"fy\":525,\"cx\":1,\"cy\":1}", CM_ERROR_CAMERA,
         "c.json:2: ", "focal length of 0"},
        {"{\"width\":65536,\"height\":32768,\"fx\":1,\"fy\":1,\"cx\":1,\"cy\":1}", CM_ERROR_CAMERA,
         "c.json:1: ", "2^31"},
        {"{\"width\":640.5,\"height\":480,\"fx\":1,\"fy\":1,\"cx\":1,\"cy\":1}", CM_ERROR_CAMERA,
         "c.json:1: ", "whole"},
        {"{\"mapping\":\"coupled\"}", CM_ERROR_CAMERA, "c.json:1: ", "size is missing"},
        {"{\"mapping\":\"coupled\",\"size\":20000}", CM_ERROR_CAMERA, "c.json:1: ", "2^31"},
        {"{\"mapping\":\"no such\",\"size\":2}", CM_ERROR_CAMERA, "c.json:1: ", "mapping"},
        {"{\"mapping\":\"coupled\",\"frame\":\"x\",\"size\":2}", CM_ERROR_CAMERA,
         "c.json:1: ", "frame"},
        {"{\"mapping\":\"coupled\",\"size\":2,\"fx\":1}", CM_ERROR_CAMERA, "c.json:1: ", "fx"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
    {
        cm_camera *camera = NULL;
        double scale = 7.0;
        check_refusal(&bad[i], cm_camera_file_parse("c.json", bad[i].text, strlen(bad[i].text),
                                                    &camera, &scale, message));
        REQUIRE(camera == NULL && scale == 7.0, "touched");
    }
    cm_camera *camera = NULL;
    double scale;
    ck_assert_int_eq(cm_camera_file_read(in_folder("none.json"), &camera, &scale, message),
                     CM_ERROR_FILE);
    REQUIRE(strncmp(message, test_folder(), strlen(test_folder())) == 0, "%s", message);
    ck_assert_int_eq(cm_camera_file_read(test_folder(), &camera, &scale, message), CM_ERROR_FILE);
}
END_TEST

START_TEST(trajectories_are_the_same_when_read_again)
{
    enum
    {
        COUNT = 200
    };
    double time[COUNT];
    cm_pose pose[COUNT];
    for (int i = 0; i < COUNT; i++)
    {
        const double quaternion[4] = {sin(i * 0.7), cos(i * 1.3), sin(2.0 + i), i % 7 - 3.0};
        double length = 0.0, unit[4];
        for (int k = 0; k < 4; k++)
        {
            length += quaternion[k] * quaternion[k];
        }
        for (int k = 0; k < 4; k++)
        {
            unit[k] = quaternion[k] / sqrt(length);
        }
        const double position[3] = {i / 3.0, -1e6 / (i + 1), 1e-300 * i};
        time[i] = 1305031232.834645 + i / 30.0;
        ck_assert_int_eq(cm_pose_from_quaternion(position, unit, &pose[i]), CM_OK);
    }
    cm_pose_list lines = {0, NULL, NULL}, log = {0, NULL, NULL};
    const char *path = in_folder("poses.txt");
    REQUIRE(cm_trajectory_file_write(path, COUNT, time, pose, message) == CM_OK, "%s", message);
    REQUIRE(cm_trajectory_file_read(path, &lines, message) == CM_OK, "%s", message);
    path = in_folder("trajectory.log");
    REQUIRE(cm_trajectory_log_write(path, COUNT, pose, message) == CM_OK, "%s", message);
    REQUIRE(cm_trajectory_log_read(path, &log, message) == CM_OK, "%s", message);
    REQUIRE(lines.count == COUNT && log.count == COUNT && log.time == NULL, "%zu %zu", lines.count,
            log.count);
    for (int i = 0; i < COUNT; i++)
    {
        REQUIRE(lines.time[i] == time[i], "%.17g", lines.time[i]);
        for (int k = 0; k < 9; k++)
        {
            const double is = pose[i].rotation.row[k / 3][k % 3];
            REQUIRE(fabs(lines.pose[i].rotation.row[k / 3][k % 3] - is) <= 1e-15 &&
                        fabs(log.pose[i].rotation.row[k / 3][k % 3] - is) <= 1e-15,
                    "pose %d", i);
        }
        REQUIRE(memcmp(lines.pose[i].position, pose[i].position, sizeof pose[i].position) == 0 &&
                    memcmp(log.pose[i].position, pose[i].position, sizeof pose[i].position) == 0,
                "pose %d", i);
    }
    cm_pose_list_clear(&lines);
    cm_pose_list_clear(&log);
    cm_pose_list_clear(NULL);
}
END_TEST

START_TEST(bad_trajectories_are_refused)
{
    const bad_text bad[] = {
        {"", CM_ERROR_DATA, "t.txt: ", "no pose"},
        {"# nothing\n", CM_ERROR_DATA, "t.txt: ", "no pose"},
        {"1 0 0 0 0 0 0\n", CM_ERROR_DATA, "t.txt:1: ", "8 numbers"},
        {"1 0 0 0 0 0 0 1 2\n", CM_ERROR_DATA, "t.txt:1: ", "8 numbers"},
        {"#\n\n1 0 0 nan 0 0 0 1\n", CM_ERROR_DATA, "t.txt:3: ", "no number"},
        {"1 0 0 1e999 0 0 0 1\n", CM_ERROR_DATA, "t.txt:1: ", "finite"},
        {"1 0 0 0x1 0 0 0 1\n", CM_ERROR_DATA, "t.txt:1: ", "no number"},
        {"1 0 0 0 0 0 0 0\n", CM_ERROR_CAMERA, "t.txt:1: ", "quaternion"},
        {"1 0 0 0 0 0 0 1.0011\n", CM_ERROR_CAMERA, "t.txt:1: ", "quaternion"},
        {"1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n", CM_ERROR_DATA, "t.txt:2: ", "after"},
        {"1 0 0 0 0 0 0 1\n0.5 0 0 0 0 0 0 1\n", CM_ERROR_DATA, "t.txt:2: ", "after"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
    {
        cm_pose_list list = {0, NULL, NULL};
        check_refusal(&bad[i], cm_trajectory_file_parse("t.txt", bad[i].text, strlen(bad[i].text),
                                                        &list, message));
        REQUIRE(list.count == 0 && list.pose == NULL, "touched");
    }
    const bad_text bad_log[] = {
        {"", CM_ERROR_DATA, "t.log: ", "no pose"},
        {"0 0 1\n", CM_ERROR_DATA, "t.log:", "without its matrix"},
        {"0 0\n", CM_ERROR_DATA, "t.log:1: ", "3 numbers"},
        {"0 0 1\n1 0 0 0\n0 1 0 0\n", CM_ERROR_DATA, "t.log:", "ends"},
        {"0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1\n0 0 0 1\n", CM_ERROR_DATA, "t.log:4: ", "4 numbers"},
        {"0 0 1\n1 0 0 0\n0 1 0 0\n0 0 -1 0\n0 0 0 1\n", CM_ERROR_CAMERA, "t.log:5: ", "no pose"},
        {"0 0 1\n1 0 0 0\n0 1 0 0\n0 0 2 0\n0 0 0 1\n", CM_ERROR_CAMERA, "t.log:5: ", "no pose"},
        {"0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 2\n", CM_ERROR_CAMERA, "t.log:5: ", "no pose"},
    };
    for (size_t i = 0; i < sizeof bad_log / sizeof bad_log[0]; i++)
    {
        cm_pose_list list = {0, NULL, NULL};
        check_refusal(&bad_log[i],
                      cm_trajectory_log_parse("t.log", bad_log[i].text, strlen(bad_log[i].text),
                                              &list, message));
        REQUIRE(list.count == 0 && list.pose == NULL, "touched");
    }
    const char *const two = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 1 1 1\n";
    cm_pose pose;
    ck_assert_int_eq(cm_pose_file_parse("p.txt", two, strlen(two), &pose, message), CM_ERROR_DATA);
    REQUIRE(strncmp(message, "p.txt:5: ", 9) == 0, "%s", message);
}
END_TEST

START_TEST(thousands_of_equal_stamps_are_one_line)
{
    char *text = malloc(20 * 5000 + 1);
    REQUIRE(text != NULL, "no memory");
    for (int i = 0; i < 5000; i++)
    {
        memcpy(text + 20 * i, "1.00 0 0 0 0 0 0 1 \n", 20);
    }
    cm_pose_list list = {0, NULL, NULL};
    ck_assert_int_eq(cm_trajectory_file_parse("t.txt", text, 20 * 5000, &list, message),
                     CM_ERROR_DATA);
    REQUIRE(strncmp(message, "t.txt:2: ", 9) == 0, "%s", message);
    free(text);
}
END_TEST

START_TEST(nearly_unit_quaternions_are_normalised)
{
    const char *const text = "1 0 0 0 0 0 0 1.0009\n";
    cm_pose_list list = {0, NULL, NULL};
    REQUIRE(cm_trajectory_file_parse("t", text, strlen(text), &list, message) == CM_OK, "%s",
            message);
    REQUIRE(list.pose[0].rotation.row[0][0] == 1.0, "%.17g", list.pose[0].rotation.row[0][0]);
    cm_pose_list_clear(&list);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {cameras_are_read,
                                  cameras_are_the_same_when_read_again,
                                  bad_cameras_are_refused,
                                  trajectories_are_the_same_when_read_again,
                                  bad_trajectories_are_refused,
                                  thousands_of_equal_stamps_are_one_line,
                                  nearly_unit_quaternions_are_normalised,
                                  NULL};
    return run_suite("pose files", tests);
}
