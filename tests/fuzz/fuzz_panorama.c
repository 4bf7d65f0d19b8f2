/* SPDX-License-Identifier: MIT
 *
 * Panoramas: any text is read without a look beyond it; what is read is one, is written, and reads as the same again; and
 * what a surface is made of comes back from the surface.
 */
#include <cubemap/cubemap.h>
#include <cubemap/panorama.h>

#include <math.h>

#include "fuzz.h"

enum
{
    PACKET_SIZE = 2048,
    SPECIFICATION_SIZE = 400,
    WHOLE_MOST = 65536, /* pixels: far more of them are as narrow as an angle's rounding */
    EDGE_MOST = 64
};

static int alike(double one, double other)
{
    return one == other || (isnan(one) && isnan(other));
}

static void check_alike(const cm_panorama *one, const cm_panorama *other)
{
    EXPECT(one->full_width == other->full_width && one->full_height == other->full_height &&
               one->cropped_left == other->cropped_left && one->cropped_top == other->cropped_top &&
               one->cropped_width == other->cropped_width &&
               one->cropped_height == other->cropped_height,
           "%u x %u, not %u x %u", other->full_width, other->full_height, one->full_width,
           one->full_height);
    EXPECT(alike(one->heading, other->heading) && one->pitch == other->pitch &&
               one->roll == other->roll,
           "%g %g %g, not %g %g %g", other->heading, other->pitch, other->roll, one->heading,
           one->pitch, one->roll);
}

/* Written into no more than it takes, and read again. */
static void check_text(const cm_panorama *panorama)
{
    char packet[PACKET_SIZE];
    const cm_status status = cm_panorama_write(panorama, packet, sizeof packet);
    EXPECT((status == CM_OK) == (cm_panorama_check(panorama) == CM_OK && panorama->full_width > 0),
           "status %d", (int)status);
    if (status != CM_OK)
    {
        return;
    }
    const size_t length = strlen(packet);
    char *little = malloc(length + 1);
    EXPECT(little != NULL, "no memory");
    EXPECT(cm_panorama_write(panorama, little, length) == CM_ERROR_SPACE, "too little");
    EXPECT(cm_panorama_write(panorama, little, length + 1) == CM_OK, "just enough");
    cm_panorama again = {.size = sizeof again};
    EXPECT(cm_panorama_read(little, length, &again) == CM_OK, "'%s'", little);
    free(little);
    check_alike(panorama, &again);
}

static void check_angles(const cm_panorama *one, const cm_panorama *other)
{
    const double heading = isnan(one->heading) ? 0.0 : one->heading;
    EXPECT(fabs(one->pitch) > 89.0 || (fabs(remainder(heading - other->heading, 360.0)) < 1e-9 &&
                                       fabs(one->pitch - other->pitch) < 1e-9 &&
                                       fabs(remainder(one->roll - other->roll, 360.0)) < 1e-9),
           "%g %g %g, not %g %g %g", other->heading, other->pitch, other->roll, heading, one->pitch,
           one->roll);
}

/* The surface of a picture of that size, which has not been scaled if it is as large as the rectangle. */
static void check_surface(const cm_panorama *panorama, uint32_t width, uint32_t height)
{
    char text[SPECIFICATION_SIZE];
    cm_rotation rotation;
    cm_surface *surface = NULL;
    const cm_status status =
        cm_panorama_surface(panorama, width, height, text, sizeof text, &rotation);
    EXPECT((status == CM_OK) == (cm_panorama_check(panorama) == CM_OK && width > 0 && height > 0),
           "status %d", (int)status);
    if (status != CM_OK)
    {
        return;
    }
    const cm_surface_options options = {.size = sizeof options, .rotation = &rotation};
    EXPECT(cm_panorama_surface(panorama, width, height, text, strlen(text), NULL) == CM_ERROR_SPACE,
           "'%s'", text);
    EXPECT(cm_surface_create(text, &options, &surface) == CM_OK, "'%s'", text);
    EXPECT(cm_surface_width(surface) == width && cm_surface_height(surface) == height, "'%s'",
           text);
    cm_panorama again = {.size = sizeof again};
    const cm_status back = cm_panorama_of_surface(surface, &again);
    EXPECT(back == CM_OK || back == CM_ERROR_RANGE, "status %d", (int)back);
    EXPECT(back != CM_OK || cm_panorama_check(&again) == CM_OK, "'%s'", text);
    if (width == panorama->cropped_width && height == panorama->cropped_height &&
        panorama->full_width <= WHOLE_MOST && panorama->full_height <= WHOLE_MOST &&
        panorama->full_width > 0)
    {
        EXPECT(back == CM_OK, "'%s': status %d", text, (int)back);
        check_angles(panorama, &again);
        again.heading = panorama->heading;
        again.pitch = panorama->pitch;
        again.roll = panorama->roll;
        check_alike(panorama, &again);
    }
    cm_surface_destroy(surface);
}

static double take_angle(supply *from, double most)
{
    const uint8_t kind = take_byte(from);
    return kind == 0   ? take_double(from)
           : kind == 1 ? 0.0
           : kind == 2 ? most
                       : most * take_fraction(from);
}

static cm_panorama take_panorama(supply *from)
{
    cm_panorama made = {.size = sizeof made};
    const uint32_t most = take_byte(from) % 4 == 0 ? UINT32_MAX - 3 : WHOLE_MOST;
    made.full_width = take_word(from) % most;
    made.full_height = take_word(from) % most;
    made.cropped_left = take_word(from) % (made.full_width + (made.full_width < UINT32_MAX));
    made.cropped_top = take_word(from) % (made.full_height + (made.full_height < UINT32_MAX));
    made.cropped_width = take_word(from) % (made.full_width - made.cropped_left + 2u);
    made.cropped_height = take_word(from) % (made.full_height - made.cropped_top + 2u);
    made.heading = take_angle(from, 360.0);
    made.pitch = take_angle(from, 90.0);
    made.roll = take_angle(from, 180.0);
    made.heading += made.heading < 0.0 ? 360.0 : 0.0;
    return made;
}

static void check_one(const cm_panorama *panorama, uint32_t width, uint32_t height)
{
    check_text(panorama);
    check_surface(panorama, width, height);
    check_surface(panorama, panorama->cropped_width, panorama->cropped_height);
}

/* Any surface has fields, or none. */
static void check_specification(const char *specification)
{
    const cm_surface_options options = {.size = sizeof options, .width = EDGE_MOST};
    cm_surface *surface = NULL;
    cm_panorama panorama = {.size = sizeof panorama};
    if (cm_surface_create(specification, &options, &surface) == CM_OK &&
        cm_panorama_of_surface(surface, &panorama) == CM_OK)
    {
        EXPECT(cm_panorama_check(&panorama) == CM_OK, "%s", specification);
        check_text(&panorama);
    }
    cm_surface_destroy(surface);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    if (take_byte(&from) % 2 == 0)
    {
        const uint32_t width = take_word(&from), height = take_word(&from);
        const cm_panorama panorama = take_panorama(&from);
        check_one(&panorama, width % (1u << 30), height % (1u << 30));
        return 0;
    }
    const size_t length = from.left;
    char *text = take_text(&from);
    check_specification(text);
    /* without the zero byte at its end, so that the sanitizer sees what is beyond */
    char *exact = malloc(length > 0 ? length : 1);
    EXPECT(exact != NULL, "no memory");
    memcpy(exact, text, length);
    cm_panorama panorama = {.size = sizeof panorama, .full_width = 7};
    if (cm_panorama_read(exact, length, &panorama) == CM_OK)
    {
        EXPECT(cm_panorama_check(&panorama) == CM_OK, "'%s'", text);
        check_one(&panorama, EDGE_MOST, EDGE_MOST);
    }
    else
    {
        EXPECT(panorama.full_width == 7, "touched");
    }
    free(exact);
    free(text);
    return 0;
}
