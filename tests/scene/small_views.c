/* SPDX-License-Identifier: MIT */
#include "small_views.h"

#include <math.h>

#include "tests/suite.h"
#include "written_files.h"

char message[CM_IMAGE_MESSAGE];
uint16_t depth_units[WIDTH * HEIGHT];
float depth_metres[WIDTH * HEIGHT];
unsigned char colors[WIDTH * HEIGHT * 3];

cm_camera *make_camera(uint32_t width)
{
    const cm_camera_options options = {.size = sizeof options,
                                       .width = width,
                                       .height = HEIGHT,
                                       .fx = 9,
                                       .fy = 9,
                                       .cx = 3.5,
                                       .cy = 2.5};
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(&options, &camera), CM_OK);
    return camera;
}

cm_view make_view(const cm_camera *camera, unsigned k, int metres)
{
    for (unsigned i = 0; i < WIDTH * HEIGHT; i++)
    {
        depth_units[i] = i % 7 == 0 ? 0 : (uint16_t)(5 * (i * 20 + k + 1));
        depth_metres[i] = i % 7 == 0 ? NAN : (float)depth_units[i] / 5000.0f;
        colors[3 * i] = (unsigned char)i;
        colors[3 * i + 1] = (unsigned char)(2 * i + k);
        colors[3 * i + 2] = (unsigned char)(255 - i);
    }
    cm_view view = {.size = sizeof view, .time = 100.25 + k, .camera = camera};
    view.depth = (cm_image){.size = sizeof view.depth,
                            .data = metres ? (void *)depth_metres : (void *)depth_units,
                            .type = metres ? CM_PIXEL_FLOAT : CM_PIXEL_U16,
                            .width = WIDTH,
                            .height = HEIGHT,
                            .channels = 1};
    view.color = (cm_image){.size = sizeof view.color,
                            .data = colors,
                            .type = CM_PIXEL_U8,
                            .width = WIDTH,
                            .height = HEIGHT,
                            .channels = 3};
    view.depth_unit = metres ? 1.0 : 1.0 / 5000.0;
    ck_assert_int_eq(cm_rotation_from_angles(10.0 * k, 5, 3, &view.pose.rotation), CM_OK);
    view.pose.position[1] = k / 3.0;
    return view;
}

const char *write_views(const char *name, cm_sequence_layout layout, int metres)
{
    const char *folder = in_folder(name);
    remove_all(folder);
    cm_camera *camera = make_camera(WIDTH);
    cm_sequence_writer *writer = NULL;
    cm_status status = cm_sequence_create(folder, layout, camera, 5000.0, &writer, message);
    REQUIRE(status == CM_OK, "%s", message);
    for (unsigned k = 0; k < VIEWS; k++)
    {
        const cm_view view = make_view(camera, k, metres);
        size_t beyond = 0;
        status = cm_sequence_write(writer, &view, &beyond, message);
        REQUIRE(status == CM_OK && beyond == 0, "%s", message);
    }
    REQUIRE(count_entries(folder) < 0, "it is there before it is complete");
    REQUIRE(cm_sequence_finish(writer, message) == CM_OK, "%s", message);
    cm_sequence_drop(writer);
    cm_camera_destroy(camera);
    return folder;
}
