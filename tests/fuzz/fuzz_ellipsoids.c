/* SPDX-License-Identifier: MIT
 *
 * Ellipsoids and names of latitudes: the input is a text.
 */
#include <cubemap/cubemap.h>

#include <math.h>

#include "fuzz.h"

static void check_table(size_t index)
{
    const cm_ellipsoid *known = cm_ellipsoid_at(index);
    EXPECT((known != NULL) == (index < cm_ellipsoid_count()), "%zu", index);
    EXPECT(known == NULL || cm_ellipsoid_find(known->identifier) == known, "%zu", index);
}

/* In no more than the room that there is. */
static void check_message(const char *text, cm_status expected, size_t room)
{
    cm_ellipsoid e;
    char *message = malloc(room + (room == 0));
    EXPECT(message != NULL, "no memory");
    memset(message, 'x', room);
    EXPECT(cm_ellipsoid_parse(text, &e, message, room) == expected, "%s", text);
    EXPECT(expected == CM_OK || room == 0 || memchr(message, '\0', room) != NULL, "no end in %zu",
           room);
    EXPECT(expected == CM_OK || room == 0 || is_one_line(message), "%s", message);
    free(message);
}

static void check_parsed(const char *text)
{
    cm_ellipsoid e = {.size = 77};
    cm_status status = cm_ellipsoid_parse(text, &e, NULL, 0);
    const cm_ellipsoid *known = cm_ellipsoid_find(text);
    check_message(text, status, strlen(text) % 90);
    if (status != CM_OK)
    {
        EXPECT(status == CM_ERROR_ELLIPSOID && e.size == 77 && known == NULL, "%s", text);
        return;
    }
    EXPECT(cm_ellipsoid_check(&e) == CM_OK, "%s", text);
    EXPECT(known == NULL || (e.a == known->a && e.f == known->f), "%s", text);
    double radius = cm_ellipsoid_authalic_radius(&e);
    double area = cm_ellipsoid_area(&e);
    double b = e.a * (1.0 - e.f);
    EXPECT(radius >= fmin(e.a, b) * (1.0 - 1e-15) && radius <= fmax(e.a, b) * (1.0 + 1e-15),
           "%s: %g", text, radius);
    EXPECT(area >= 0.0, "%s: %g", text, area);
}

static void check_name(const char *text)
{
    cm_latitude latitude = (cm_latitude)77;
    cm_status status = cm_latitude_find(text, &latitude);
    const char *name = cm_latitude_name(latitude);
    EXPECT((status == CM_OK) == (name != NULL), "%s", text);
    EXPECT(name == NULL || strlen(name) == strlen(text), "%s is %s", text, name);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    check_table(size);
    char *text = take_text(&from);
    check_parsed(text);
    check_name(text);
    free(text);
    return 0;
}
