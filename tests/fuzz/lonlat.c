/* SPDX-License-Identifier: MIT
 *
 * Longitude and latitude, against the C library's long double.
 */
#include "in_double.h"
#include "values.h"

static const double half_pi = 1.5707963267948966;

static int is_lonlat(double lon, double lat)
{
    return isfinite(lon) && fabs(lat) <= half_pi + 1e-9;
}

/* Any of: raw, an angle around a multiple of a quarter turn, a little beyond a pole. */
static double take_angle(supply *from)
{
    uint8_t kind = take_byte(from);
    double angle = half_pi * (double)(kind / 4 % 9 - 4);
    switch (kind % 4)
    {
    case 0:
        return take_double(from);
    case 1:
        return 2.0 * half_pi * take_fraction(from);
    case 2:
        return beside(angle, from);
    default:
        return angle + 1e-10 * (take_byte(from) - 128);
    }
}

static void check_direction_from(double lon, double lat)
{
    double direction[3];
    cm_direction_from_lonlat(lon, lat, direction);
    if (!is_lonlat(lon, lat))
    {
        EXPECT(isnan(direction[0]) && isnan(direction[1]) && isnan(direction[2]),
               "%a %a has a direction", lon, lat);
        return;
    }
    long double height = fabs(lat) > half_pi ? copysign(half_pi, lat) : lat;
    const long double truth[3] = {cosl(height) * cosl(lon), cosl(height) * sinl(lon), sinl(height)};
    for (int k = 0; k < 3; k++)
    {
        EXPECT(fabsl(direction[k] - truth[k]) <= 2 * 0x1p-52L, "%a %a: component %d is %a, not %La",
               lon, lat, k, direction[k], truth[k]);
    }
}

static void check_lonlat_from(const double direction[3])
{
    double lonlat[2];
    cm_lonlat_from_direction(direction, lonlat);
    if (!is_direction(direction))
    {
        EXPECT(isnan(lonlat[0]) && isnan(lonlat[1]), "%a %a %a has lon/lat", direction[0],
               direction[1], direction[2]);
        return;
    }
    long double truth[2] = {atan2l(direction[1], direction[0]),
                            atan2l(direction[2], hypotl(direction[0], direction[1]))};
    for (int k = 0; k < 2; k++)
    {
        EXPECT(error_in_ulp(lonlat[k], truth[k], DBL_MIN_EXP) <= 2.0, "%a %a %a: %s is %a, not %La",
               direction[0], direction[1], direction[2], k == 0 ? "lon" : "lat", lonlat[k],
               truth[k]);
    }
    EXPECT(fabs(lonlat[0]) <= 2.0 * half_pi && fabs(lonlat[1]) <= half_pi, "%a %a", lonlat[0],
           lonlat[1]);
}

/* The functions of a mapping are those of a direction, to the bit. */
static void check_mapping(const subject *made, double lon, double lat, const double point[2])
{
    double direction[3];
    double through[2];
    double uv[2];
    double lonlat[2];
    uint8_t face = cm_forward_lonlat(made->mapping, lon, lat, uv);
    cm_direction_from_lonlat(lon, lat, direction);
    EXPECT(cm_forward(made->mapping, direction, through) == face &&
               memcmp(uv, through, sizeof uv) == 0,
           "%s: %a %a", made->specification, lon, lat);
    cm_inverse_lonlat(made->mapping, face, point, lonlat);
    cm_inverse(made->mapping, face, point, direction);
    cm_lonlat_from_direction(direction, through);
    EXPECT(memcmp(lonlat, through, sizeof lonlat) == 0, "%s: %d %a %a", made->specification, face,
           point[0], point[1]);
    EXPECT(isnan(lonlat[0]) == !(face < 6 && is_point(point)) || is_one_face(made), "%s: %d %a %a",
           made->specification, face, point[0], point[1]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    subject made = take_subject(&from, NULL);
    while (from.left > 0)
    {
        double lon = take_angle(&from);
        double lat = take_angle(&from);
        double direction[3];
        double point[2];
        take_direction(&from, direction);
        take_point(&from, point);
        check_direction_from(lon, lat);
        check_lonlat_from(direction);
        check_mapping(&made, lon, lat, point);
    }
    drop_subject(&made);
    return 0;
}
