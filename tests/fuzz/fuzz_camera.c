/* SPDX-License-Identifier: MIT
 *
 * Cameras of any numbers: what is none is refused and nothing is written; of what is one rays come back to their
 * pixels, none from beyond the border.
 */
#include <cubemap/camera.h>

#include "in_double.inc"
#include "fuzz_values.inc"

static double take_size(supply *from, double scale)
{
    return take_byte(from) % 8 == 0 ? take_double(from) : scale * take_fraction(from);
}

static void take_options(supply *from, cm_camera_options *options)
{
    options->size = sizeof *options;
    options->width = take_byte(from) % 16 == 0 ? take_word(from) : 640;
    options->height = take_byte(from) % 16 == 0 ? take_word(from) : 480;
    options->fx = take_size(from, 1000.0);
    options->fy = take_size(from, 1000.0);
    options->cx = take_size(from, 700.0);
    options->cy = take_size(from, 700.0);
    options->pixel_centre = take_byte(from) % 8 == 0 ? take_double(from) : 0.5;
    const uint8_t count = take_byte(from) % 15;
    for (int i = 0; i < count; i++)
    {
        options->distortion[i] = take_size(from, i < 12 ? 1.0 : 0.3);
    }
}

/* Made, or refused without a trace. */
static cm_camera *make_camera(const cm_camera_options *options)
{
    char nothing;
    cm_camera *camera = (cm_camera *)(void *)&nothing;
    const cm_status status = cm_camera_create(options, &camera);
    EXPECT(status == CM_OK || camera == (cm_camera *)(void *)&nothing, "touched");
    EXPECT(status == CM_OK || status == CM_ERROR_CAMERA, "%d", (int)status);
    return status == CM_OK ? camera : NULL;
}

/* The same camera as in the last runs, if one was of the same numbers: the valid field of one takes longer to find than all else
 * here, and what comes behind the numbers is changed as often as they are. */
static cm_camera *take_camera(const cm_camera_options *options)
{
    enum
    {
        KEPT = 64
    };
    static struct
    {
        cm_camera_options asked;
        cm_camera *made;
    } kept[KEPT];
    static size_t next = 0;
    for (size_t i = 0; i < KEPT; i++)
    {
        if (kept[i].made != NULL && memcmp(&kept[i].asked, options, sizeof *options) == 0)
        {
            return kept[i].made;
        }
    }
    cm_camera *made = make_camera(options);
    if (made != NULL)
    {
        cm_camera_destroy(kept[next].made);
        kept[next].asked = *options;
        kept[next].made = made;
        next = (next + 1) % KEPT;
    }
    return made;
}

static void check_place(const cm_camera *camera, double column, double row)
{
    double ray[3], again[2], jacobian[6];
    cm_camera_ray_array(camera, 1, &column, &row, &ray[0], &ray[1], &ray[2]);
    EXPECT(isnan(ray[0]) == isnan(ray[1]) && isnan(ray[0]) == isnan(ray[2]), "%g %g %g", ray[0],
           ray[1], ray[2]);
    EXPECT(cm_camera_has_ray(camera, column, row) == !isnan(ray[0]), "has_ray");
    const double angle = cm_camera_solid_angle(camera, column, row);
    EXPECT(!isnan(ray[0]) || isnan(angle), "%g", angle);
    if (isnan(ray[0]))
    {
        return;
    }
    EXPECT(!(angle < 0.0), "%g", angle);
    cm_camera_project_array(camera, 1, &ray[0], &ray[1], &ray[2], &again[0], &again[1]);
    cm_camera_jacobian(camera, ray, jacobian);
    if (cm_camera_describe(camera)->mapping == NULL)
    {
        const double length = hypot(ray[0], ray[1]);
        const double border = cm_camera_border(camera, atan2(ray[1], ray[0]));
        EXPECT(ray[2] == 1.0 && (length <= 1.03 * border || length > 1e5), "%g, beyond %g", length,
               border);
        EXPECT(!isnan(again[0]) || length >= 0.99 * border || length > 1e5, "%g of %g", length,
               border);
    }
}

static void check_point(const cm_camera *camera, const double point[3])
{
    double pixel[2];
    cm_camera_project_array(camera, 1, &point[0], &point[1], &point[2], &pixel[0], &pixel[1]);
    EXPECT(isnan(pixel[0]) == isnan(pixel[1]), "%g %g", pixel[0], pixel[1]);
    EXPECT(cm_camera_describe(camera)->mapping != NULL || isnan(pixel[0]) || point[2] > 0.0, "%g",
           point[2]);
}

static void check_camera(const cm_camera *camera, supply *from)
{
    const cm_camera_options *options = cm_camera_describe(camera);
    for (int i = 0; i < 4; i++)
    {
        double point[3];
        take_direction(from, point);
        check_point(camera, point);
        check_place(camera, take_size(from, 2.0 * options->width),
                    take_size(from, 2.0 * options->height));
    }
}

static void check_faces(supply *from)
{
    const subject made = take_subject(from, NULL);
    const cm_kind kind = cm_mapping_describe(made.mapping)->kind;
    const uint32_t width = 1u + take_byte(from);
    const cm_camera_options options = {.size = sizeof options,
                                       .width = width,
                                       .height = kind == CM_KIND_CUBE ? 6 * width : width,
                                       .pixel_centre = 0.5,
                                       .mapping = made.mapping};
    cm_mapping *copy = NULL;
    cm_camera *camera = make_camera(&options);
    EXPECT((camera == NULL) == (kind == CM_KIND_DISC_SQUARE), "%s", made.specification);
    EXPECT(cm_mapping_copy(made.mapping, &copy) == CM_OK, "copy");
    EXPECT(cm_mapping_describe(copy) == cm_mapping_describe(made.mapping), "copy");
    EXPECT(cm_mapping_copy(NULL, &copy) == CM_ERROR_ARGUMENT, "NULL");
    cm_mapping_destroy(copy);
    drop_subject(&made);
    if (camera != NULL)
    {
        EXPECT(isnan(cm_camera_border(camera, 0.0)), "a border");
        check_camera(camera, from);
    }
    cm_camera_destroy(camera);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    cm_camera *camera = NULL;
    EXPECT(cm_camera_create(NULL, &camera) == CM_ERROR_ARGUMENT, "NULL");
    if (take_byte(&from) % 2 == 0)
    {
        check_faces(&from);
        return 0;
    }
    cm_camera_options options;
    memset(&options, 0, sizeof options); /* what lies between its members, too */
    take_options(&from, &options);
    const cm_camera *const taken = take_camera(&options);
    if (taken != NULL)
    {
        const double border = cm_camera_border(taken, take_size(&from, 4.0));
        EXPECT(isnan(border) || border >= 0.0, "%g", border);
        check_camera(taken, &from);
    }
    options.size = take_byte(&from);
    camera = NULL;
    EXPECT(cm_camera_create(&options, &camera) ==
                   (options.size == sizeof options ? CM_OK : CM_ERROR_ARGUMENT) ||
               options.size == sizeof options,
           "size");
    cm_camera_destroy(camera);
    return 0;
}
