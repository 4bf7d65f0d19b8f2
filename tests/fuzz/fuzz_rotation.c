/* SPDX-License-Identifier: MIT
 *
 * Rotations from angles, from any table of nine numbers and from a text: what is none is refused and nothing is
 * written; what is one comes back from its angles, and keeps the length of a direction.
 */
#include "in_double.inc"
#include "fuzz_values.inc"

/* Raw, or a multiple of a quarter turn and a few ulp. */
static double take_angle(supply *from)
{
    uint8_t kind = take_byte(from);
    return kind % 3 == 0 ? take_double(from) : beside(90.0 * (double)(kind / 3 % 9 - 4), from);
}

static double apart(const cm_rotation *a, const cm_rotation *b)
{
    double worst = 0.0;
    for (int i = 0; i < 9; i++)
    {
        worst = fmax(worst, fabs(a->row[i / 3][i % 3] - b->row[i / 3][i % 3]));
    }
    return worst;
}

/* slack is what the matrix may be off orthonormal */
static void check_rotation(const cm_rotation *rotation, double slack, const double direction[3])
{
    double angles[3], to[3], back[3];
    EXPECT(cm_rotation_check(rotation) == CM_OK, "no rotation");
    EXPECT(cm_rotation_angles(rotation, &angles[0], &angles[1], &angles[2]) == CM_OK, "no angles");
    EXPECT(fabs(angles[0]) <= 180.0 && fabs(angles[1]) <= 90.0 && fabs(angles[2]) <= 180.0,
           "%.17g %.17g %.17g", angles[0], angles[1], angles[2]);
    cm_rotation again;
    EXPECT(cm_rotation_from_angles(angles[0], angles[1], angles[2], &again) == CM_OK, "angles");
    EXPECT(apart(rotation, &again) <= slack + 8 * 0x1p-53, "%.17g %.17g %.17g: %g", angles[0],
           angles[1], angles[2], apart(rotation, &again));
    double size = fmax(fabs(direction[0]), fmax(fabs(direction[1]), fabs(direction[2])));
    memcpy(back, direction, sizeof back);
    cm_rotate(rotation, back, to);
    cm_rotate_back(rotation, to, back);
    int finite = isfinite(direction[0] + direction[1] + direction[2]);
    for (int k = 0; k < 3 && finite && size > 1e-290 && size < 1e300; k++)
    {
        EXPECT(fabs(back[k] - direction[k]) <= (24 * 0x1p-53 + 4 * slack) * size, "%g, not %g",
               back[k], direction[k]);
    }
}

static void check_angles(supply *from, const double direction[3])
{
    const double lon = take_angle(from);
    const double lat = take_angle(from);
    const double roll = take_angle(from);
    cm_rotation rotation = {{{7.0}}};
    cm_status status = cm_rotation_from_angles(lon, lat, roll, &rotation);
    int good = isfinite(lon) && fabs(lat) <= 90.0 && isfinite(roll);
    EXPECT(status == (good ? CM_OK : CM_ERROR_ORIENTATION), "%g %g %g: %d", lon, lat, roll,
           (int)status);
    if (good)
    {
        check_rotation(&rotation, 0.0, direction);
    }
    else
    {
        EXPECT(rotation.row[0][0] == 7.0, "touched");
    }
    int which = take_byte(from) % 9;
    rotation.row[which / 3][which % 3] = take_double(from);
    if (good && cm_rotation_check(&rotation) == CM_OK)
    {
        check_rotation(&rotation, 1e-11, direction);
    }
}

static void check_text(const char *text)
{
    cm_rotation rotation = {{{7.0}}};
    char message[200] = "";
    cm_status status = cm_rotation_parse(text, &rotation, message, sizeof message);
    const cm_orientation *named = cm_orientation_find(text);
    if (status == CM_OK)
    {
        EXPECT(message[0] == '\0' && cm_rotation_check(&rotation) == CM_OK, "'%s'", text);
        EXPECT(named != NULL || strchr(text, ',') != NULL, "'%s'", text);
    }
    else
    {
        EXPECT(status == CM_ERROR_ORIENTATION && rotation.row[0][0] == 7.0 && named == NULL, "'%s'",
               text);
        EXPECT(message[0] != '\0' && is_one_line(message), "'%s'", message);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    double direction[3];
    take_direction(&from, direction);
    check_angles(&from, direction);
    const cm_orientation *any = cm_orientation_at(take_byte(&from));
    EXPECT(any == NULL || cm_orientation_find(any->identifier) == any, "not found");
    EXPECT(cm_orientation_at(cm_orientation_count()) == NULL, "one too many");
    char *text = take_text(&from);
    check_text(text);
    free(text);
    return 0;
}
