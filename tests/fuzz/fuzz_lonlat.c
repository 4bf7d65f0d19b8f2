/* SPDX-License-Identifier: MIT
 *
 * Longitude and latitude, against the C library's long double.
 */
#include "in_double.inc"
#include "fuzz_values.inc"

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

/* Half a unit in the last place, which does not get smaller where numbers are subnormal. */
static double rounding(double value)
{
    return fmax(0x1p-53 * fabs(value), 0x1p-1074);
}

/* In arrays: one point as many, and what the C library gives but for rounding. */
static void check_direction_arrays(double lon, double lat, const double direction[3])
{
    const double lons[3] = {0.5, lon, lon};
    const double lats[3] = {0.25, lat, lat};
    const double xs[3] = {1.0, direction[0], direction[0]};
    const double ys[3] = {0.5, direction[1], direction[1]};
    const double zs[3] = {0.25, direction[2], direction[2]};
    double truth[3], found[3][3], through[2], longitudes[3], latitudes[3];
    cm_direction_from_lonlat_array(3, lons, lats, found[0], found[1], found[2]);
    cm_direction_from_lonlat(lon, lat, truth);
    cm_lonlat_from_direction_array(3, xs, ys, zs, longitudes, latitudes);
    cm_lonlat_from_direction(direction, through);
    for (int k = 0; k < 3; k++)
    {
        EXPECT(memcmp(&found[k][1], &found[k][2], sizeof(double)) == 0, "%a %a", lon, lat);
        EXPECT(isnan(truth[k]) ? isnan(found[k][1]) : fabs(found[k][1] - truth[k]) <= 8 * 0x1p-53,
               "%a %a: component %d is %a, not %a", lon, lat, k, found[k][1], truth[k]);
    }
    EXPECT(memcmp(&longitudes[1], &longitudes[2], sizeof(double)) == 0 &&
               memcmp(&latitudes[1], &latitudes[2], sizeof(double)) == 0,
           "%a %a %a", direction[0], direction[1], direction[2]);
    EXPECT(isnan(through[0]) ? isnan(longitudes[1]) && isnan(latitudes[1])
                             : fabs(longitudes[1] - through[0]) <= 8 * rounding(through[0]) &&
                                   fabs(latitudes[1] - through[1]) <= 8 * rounding(through[1]),
           "%a %a %a: %a %a, not %a %a", direction[0], direction[1], direction[2], longitudes[1],
           latitudes[1], through[0], through[1]);
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

/* In arrays: one point as many, and what a direction gives but for rounding. */
static void check_forward(const subject *made, double lon, double lat)
{
    const double lons[3] = {0.5, lon, lon};
    const double lats[3] = {0.25, lat, lat};
    double direction[3], back[3], uv[2], u[3], v[3];
    uint8_t faces[3];
    uint8_t face;
    cm_forward_lonlat_array(made->mapping, 1, &lon, &lat, &face, &uv[0], &uv[1]);
    cm_forward_lonlat_array(made->mapping, 3, lons, lats, faces, u, v);
    for (int i = 1; i < 3; i++)
    {
        EXPECT(faces[i] == face && memcmp(&u[i], &uv[0], sizeof u[i]) == 0 &&
                   memcmp(&v[i], &uv[1], sizeof v[i]) == 0,
               "%s: %a %a", made->specification, lon, lat);
    }
    EXPECT(is_lonlat(lon, lat) || face == CM_NO_FACE, "%s: %a %a", made->specification, lon, lat);
    if (face != CM_NO_FACE)
    {
        cm_direction_from_lonlat(lon, lat, direction);
        cm_inverse(made->mapping, face, uv, back);
        /* what is up to 1e-9 of a radius beyond the rim of a field of view is put on it */
        double rim = is_partial(made) ? 4e-9 : 0.0;
        EXPECT(angle_between(direction, back) <= made->bound + 8 * 0x1p-53 + rim, "%s: %a %a",
               made->specification, lon, lat);
    }
    else
    {
        EXPECT(isnan(uv[0]) && isnan(uv[1]) && (!is_lonlat(lon, lat) || is_partial(made)),
               "%s: %a %a", made->specification, lon, lat);
    }
}

static void check_inverse(const subject *made, uint8_t face, const double point[2])
{
    const uint8_t faces[3] = {0, face, face};
    const double u[3] = {0.0, point[0], point[0]};
    const double v[3] = {0.0, point[1], point[1]};
    double direction[3], through[2], lonlat[2], lon[3], lat[3];
    cm_inverse_lonlat_array(made->mapping, 1, &face, &point[0], &point[1], &lonlat[0], &lonlat[1]);
    cm_inverse_lonlat_array(made->mapping, 3, faces, u, v, lon, lat);
    for (int i = 1; i < 3; i++)
    {
        EXPECT(memcmp(&lon[i], &lonlat[0], sizeof lon[i]) == 0 &&
                   memcmp(&lat[i], &lonlat[1], sizeof lat[i]) == 0,
               "%s: %d %a %a", made->specification, face, point[0], point[1]);
    }
    cm_inverse(made->mapping, face, point, direction);
    cm_lonlat_from_direction(direction, through);
    for (int k = 0; k < 2; k++)
    {
        EXPECT(isnan(through[k])
                   ? isnan(lonlat[k])
                   : fabs(lonlat[k] - through[k]) <= 8 * 0x1p-53 * fabs(through[k]) + 0x1p-1060,
               "%s: %d %a %a: %a, not %a", made->specification, face, point[0], point[1], lonlat[k],
               through[k]);
    }
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
        check_direction_arrays(lon, lat, direction);
        check_mapping(&made, lon, lat, point);
        check_forward(&made, lon, lat);
        check_inverse(&made, (uint8_t)(take_byte(&from) % 7), point);
    }
    drop_subject(&made);
    return 0;
}
