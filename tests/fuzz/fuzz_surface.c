/* SPDX-License-Identifier: MIT
 *
 * Specifications of surfaces: the input is one. What checks and what creates agree, a surface says what makes it again,
 * and positions and directions are each other's.
 */
#include <cubemap/cubemap.h>
#include <cubemap/image.h>

#include <math.h>

#include "fuzz.h"

enum
{
    MESSAGE_MAX = 300,
    WIDTH_MOST = 4096
};

static void check_message(const char *specification, const cm_surface_options *options,
                          cm_status status)
{
    char message[MESSAGE_MAX] = "untouched";
    char little[9];
    EXPECT(cm_surface_check(specification, options, message, sizeof message) == status, "status");
    EXPECT(status == CM_OK ? strcmp(message, "untouched") == 0 : is_one_line(message), "'%s'",
           message);
    EXPECT(cm_surface_check(specification, options, little, sizeof little) == status, "status");
    EXPECT(cm_surface_check(specification, options, NULL, 0) == status, "status");
}

static void check_kinds(void)
{
    for (size_t i = 0; i < cm_surface_kind_count(); i++)
    {
        EXPECT(cm_surface_kind_at(i)->identifier[0] != '\0', "kind %zu", i);
    }
    EXPECT(cm_surface_kind_at(cm_surface_kind_count()) == NULL, "one more");
}

/* A position of a plane, its direction, and the position of that. */
static void check_position(const cm_surface *surface, supply *from)
{
    const uint8_t plane = (uint8_t)(take_byte(from) % (cm_surface_plane_count(surface) + 1));
    const double width = cm_surface_plane_width(surface);
    const double height = cm_surface_plane_height(surface);
    const double column = width * (0.5 + 0.5 * take_fraction(from));
    const double row = height * (0.5 + 0.5 * take_fraction(from));
    double direction[3], x, y;
    uint8_t found;
    cm_surface_directions(surface, 1, &plane, &column, &row, &direction[0], &direction[1],
                          &direction[2]);
    cm_surface_positions(surface, 1, &direction[0], &direction[1], &direction[2], &found, &x, &y);
    if (isnan(direction[0]))
    {
        EXPECT(found == CM_NO_FACE && isnan(x) && isnan(y), "%s",
               cm_surface_specification(surface));
        return;
    }
    EXPECT(fabs(direction[0] * direction[0] + direction[1] * direction[1] +
                direction[2] * direction[2] - 1.0) < 1e-12,
           "%s: %d %a %a", cm_surface_specification(surface), plane, column, row);
    /* what is a little beyond the rim of a circle is no more on it */
    EXPECT(found == CM_NO_FACE || (found < cm_surface_plane_count(surface) && x >= 0.0 &&
                                   x <= width && y >= 0.0 && y <= height),
           "%s: %d %a %a: %d %a %a", cm_surface_specification(surface), plane, column, row, found,
           x, y);
}

/* Where a plane's pixel is, is inside of a picture; pixels that are none are refused. */
static void check_pixel(const cm_surface *surface, supply *from)
{
    const uint32_t plane = take_byte(from) % (uint32_t)cm_surface_plane_count(surface);
    const uint32_t width = cm_surface_plane_width(surface);
    const uint32_t height = cm_surface_plane_height(surface);
    const uint32_t column = take_word(from) % width, row = take_word(from) % height;
    uint32_t picture = 77, x = 77, y = 77;
    EXPECT(cm_surface_pixel(surface, plane, width, row, &picture, &x, &y) == CM_ERROR_RANGE &&
               cm_surface_pixel(surface, plane, column, height, &picture, &x, &y) ==
                   CM_ERROR_RANGE &&
               cm_surface_pixel(surface, 255, column, row, &picture, &x, &y) == CM_ERROR_RANGE &&
               picture == 77 && x == 77 && y == 77,
           "%s", cm_surface_specification(surface));
    EXPECT(cm_surface_pixel(surface, plane, column, row, &picture, &x, &y) == CM_OK &&
               picture < cm_surface_picture_count(surface) && x < cm_surface_width(surface) &&
               y < cm_surface_height(surface),
           "%s: %u %u of %u: %u %u of %u", cm_surface_specification(surface), column, row, plane, x,
           y, picture);
}

/* A preset is found by its name, and makes a surface. */
static void check_preset(const char *specification, supply *from)
{
    const cm_surface_preset *found = cm_surface_preset_find(specification);
    const cm_surface_preset *one =
        cm_surface_preset_at(take_byte(from) % cm_surface_preset_count());
    const cm_surface_options options = {.size = sizeof options, .rotation = &one->rotation};
    char text[200];
    cm_surface *surface = NULL;
    EXPECT(found == NULL || strlen(found->identifier) == strlen(specification), "%s",
           specification);
    EXPECT(cm_surface_preset_find(one->identifier) == one, "%s", one->identifier);
    EXPECT(cm_surface_preset_at(cm_surface_preset_count()) == NULL, "one more");
    snprintf(text, sizeof text, "%s;size=12", one->specification);
    EXPECT(cm_surface_create(text, &options, &surface) == CM_OK, "%s", text);
    check_position(surface, from);
    check_pixel(surface, from);
    cm_surface_destroy(surface);
}

/* A map of HEALPix to its picture and back, any pixels. */
static void check_arrangement(supply *from)
{
    enum
    {
        NSIDE_MOST = 9,
        BYTES_MOST = 5
    };
    unsigned char list[12 * NSIDE_MOST * NSIDE_MOST * BYTES_MOST], picture[sizeof list],
        again[sizeof list];
    const int64_t nside = (int64_t)take_byte(from) % (NSIDE_MOST + 2) - 1;
    const cm_healpix_order order = (cm_healpix_order)(take_byte(from) % 3);
    const size_t bytes = take_byte(from) % (BYTES_MOST + 1);
    const size_t size = nside > 0 ? (size_t)(12 * nside * nside) * bytes : 0;
    take_bytes(from, list, size);
    const cm_status status = cm_healpix_arrange(nside, order, 0, bytes, list, picture);
    EXPECT((status == CM_OK) == (bytes > 0 && cm_healpix_check(nside, order, NULL, 0) == CM_OK),
           "nside %d: status %d", (int)nside, (int)status);
    if (status == CM_OK)
    {
        EXPECT(cm_healpix_arrange(nside, order, 1, bytes, picture, again) == CM_OK, "back");
        EXPECT(memcmp(list, again, size) == 0, "nside %d", (int)nside);
    }
}

static void check_surface(const cm_surface *surface, const cm_rotation *rotation, supply *from)
{
    const cm_surface_options options = {.size = sizeof options, .rotation = rotation};
    cm_surface *again;
    EXPECT(cm_surface_create(cm_surface_specification(surface), &options, &again) == CM_OK, "%s",
           cm_surface_specification(surface));
    EXPECT(strcmp(cm_surface_specification(surface), cm_surface_specification(again)) == 0 &&
               cm_surface_picture_count(surface) == cm_surface_picture_count(again) &&
               cm_surface_width(surface) == cm_surface_width(again) &&
               cm_surface_height(surface) == cm_surface_height(again),
           "%s, not %s", cm_surface_specification(again), cm_surface_specification(surface));
    const cm_mapping *mapping = cm_surface_mapping(surface);
    EXPECT(mapping == NULL || cm_mapping_describe(mapping) != NULL, "no mapping");
    for (int i = 0; i < 8 && from->left > 0; i++)
    {
        check_position(surface, from);
    }
    check_pixel(surface, from);
    cm_surface_destroy(again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    cm_rotation rotation;
    char specification[200];
    const int turned = take_byte(&from) % 2;
    cm_rotation_from_angles(180.0 * take_fraction(&from), 90.0 * take_fraction(&from),
                            180.0 * take_fraction(&from), &rotation);
    const uint32_t width = take_word(&from) % WIDTH_MOST;
    const uint32_t height = take_word(&from) % WIDTH_MOST;
    const size_t length = take_byte(&from) % sizeof specification;
    take_bytes(&from, specification, length);
    specification[length] = '\0';
    const cm_surface_options options = {.size = sizeof options,
                                        .width = width,
                                        .height = height,
                                        .rotation = turned ? &rotation : NULL};
    cm_surface *surface = NULL;
    const cm_status status = cm_surface_create(specification, &options, &surface);
    EXPECT((status == CM_OK) == (surface != NULL), "status %d", (int)status);
    if (status != CM_OK)
    {
        if (width != 0 || height != 0)
        {
            check_message(specification, &options, status);
        }
    }
    else
    {
        check_message(specification, &options, CM_OK);
        check_surface(surface, options.rotation, &from);
    }
    cm_surface_destroy(surface);
    check_kinds();
    check_preset(specification, &from);
    check_arrangement(&from);
    return 0;
}
