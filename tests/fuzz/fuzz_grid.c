/* SPDX-License-Identifier: MIT
 *
 * Grids of any mapping on any ellipsoid, with any latitude and rotation: round trips, one point as many, and
 * nothing but numbers for what is a point.
 */
#include "in_double.inc"
#include "fuzz_subject.h"
#include "fuzz_values.inc"

typedef struct grid_subject
{
    subject of;
    cm_grid *grid;
    double bound; /* of a round trip, radians; infinite where none is said */
} grid_subject;

static cm_ellipsoid take_ellipsoid(supply *from)
{
    cm_ellipsoid ellipsoid = *cm_ellipsoid_at(take_byte(from) % cm_ellipsoid_count());
    switch (take_byte(from) % 4)
    {
    case 0:
        ellipsoid.f = take_double(from);
        break;
    case 1:
        ellipsoid.f = take_fraction(from);
        break;
    case 2:
        ellipsoid.f = 0.02 * take_fraction(from);
        break;
    default:
        break;
    }
    return ellipsoid;
}

/* 0 if there is none of this kind. */
static int take_grid(supply *from, grid_subject *made)
{
    made->of = take_subject(from, NULL);
    cm_ellipsoid ellipsoid = take_ellipsoid(from);
    cm_latitude latitude = (cm_latitude)(take_byte(from) % (CM_LATITUDE_COUNT + 1));
    cm_rotation rotation;
    double lon = 180.0 * take_fraction(from);
    double lat = 90.0 * take_fraction(from);
    EXPECT(cm_rotation_from_angles(lon, lat, 180.0 * take_fraction(from), &rotation) == CM_OK,
           "%g %g", lon, lat);
    uint8_t choice = take_byte(from);
    cm_options options = {.size = sizeof options,
                          .instructions = cm_mapping_instructions(made->of.mapping)};
    cm_grid_options how = {.size = sizeof how,
                           .mapping = made->of.specification,
                           .frame = cm_mapping_frame(made->of.mapping),
                           .ellipsoid = &ellipsoid,
                           .latitude = choice & 1 ? &latitude : NULL,
                           .rotation = choice & 2 ? &rotation : NULL,
                           .options = &options};
    cm_status status = cm_grid_create(&how, &made->grid);
    cm_status expected = cm_ellipsoid_check(&ellipsoid) != CM_OK       ? CM_ERROR_ELLIPSOID
                         : choice & 1 && latitude == CM_LATITUDE_COUNT ? CM_ERROR_LATITUDE
                         : cm_mapping_describe(made->of.mapping)->kind == CM_KIND_DISC_SQUARE
                             ? CM_ERROR_UNSUPPORTED
                             : CM_OK;
    EXPECT(status == expected, "%s, f = %a: %d, not %d", made->of.specification, ellipsoid.f,
           (int)status, (int)expected);
    if (status != CM_OK)
    {
        return 0;
    }
    made->bound =
        fabs(ellipsoid.f) <= 0.02 ? 1.1 * made->of.bound + 16 * 0x1p-53 : (double)INFINITY;
    EXPECT(cm_grid_ellipsoid(made->grid)->f == ellipsoid.f, "%a", ellipsoid.f);
    EXPECT(!(choice & 1) || cm_grid_latitude(made->grid) == latitude, "%d", (int)latitude);
    EXPECT(cm_rotation_check(cm_grid_rotation(made->grid)) == CM_OK, "no rotation");
    EXPECT(cm_grid_mapping(made->grid) != NULL, "no mapping");
    return 1;
}

static void check_normal(const grid_subject *made, const double normal[3])
{
    double uv[2], back[3], sphere[3], u[2], v[2], to[3][2];
    const double x[2] = {normal[0], normal[0]};
    const double y[2] = {normal[1], normal[1]};
    const double z[2] = {normal[2], normal[2]};
    uint8_t faces[2];
    cm_distortion d;
    uint8_t face = cm_grid_forward(made->grid, normal, uv);
    cm_grid_forward_array(made->grid, 2, x, y, z, faces, u, v);
    EXPECT(faces[1] == face && memcmp(&u[1], &uv[0], sizeof u[1]) == 0 &&
               memcmp(&v[1], &uv[1], sizeof v[1]) == 0,
           "%s: %a %a %a", made->of.specification, normal[0], normal[1], normal[2]);
    cm_grid_to_sphere(made->grid, normal, sphere);
    cm_grid_to_sphere_array(made->grid, 2, x, y, z, to[0], to[1], to[2]);
    EXPECT(memcmp(&to[2][1], &sphere[2], sizeof sphere[2]) == 0, "%a", sphere[2]);
    cm_grid_forward_distortion(made->grid, normal, &d);
    if (!is_direction(normal))
    {
        EXPECT(face == CM_NO_FACE && isnan(uv[0]) && isnan(uv[1]) && isnan(d.scale),
               "%a %a %a has a face", normal[0], normal[1], normal[2]);
        return;
    }
    const double *const lasts[3] = {to[0], to[1], to[2]};
    cm_grid_from_sphere(made->grid, sphere, back);
    cm_grid_from_sphere_array(made->grid, 2, lasts[0], lasts[1], lasts[2], to[0], to[1], to[2]);
    EXPECT(memcmp(&to[0][1], &back[0], sizeof back[0]) == 0, "%a", back[0]);
    EXPECT(!(made->bound < 1.0) || angle_between(normal, back) <= 16 * 0x1p-53, "%a %a %a",
           normal[0], normal[1], normal[2]);
    EXPECT(face != CM_NO_FACE || is_partial(&made->of), "%a %a %a", normal[0], normal[1],
           normal[2]);
    if (face != CM_NO_FACE)
    {
        EXPECT(fabs(uv[0]) <= 1.0 && fabs(uv[1]) <= 1.0, "%a %a", uv[0], uv[1]);
        cm_grid_inverse(made->grid, face, uv, back);
        /* what is up to 1e-9 of a radius beyond the rim of a field of view is put on it */
        double rim = is_partial(&made->of) ? 4e-9 : 0.0;
        EXPECT(angle_between(normal, back) <= made->bound + rim, "%s: %a %a %a: %g",
               made->of.specification, normal[0], normal[1], normal[2],
               angle_between(normal, back));
    }
}

static void check_point(const grid_subject *made, uint8_t face, const double point[2])
{
    double normal[3], lonlat[2], through[2];
    double lon[2], lat[2], x[2], y[2], z[2], area[2];
    const uint8_t faces[2] = {face, face};
    const double u[2] = {point[0], point[0]};
    const double v[2] = {point[1], point[1]};
    cm_distortion d;
    cm_grid_inverse(made->grid, face, point, normal);
    cm_grid_inverse_array(made->grid, 2, faces, u, v, x, y, z);
    EXPECT(memcmp(&z[1], &normal[2], sizeof z[1]) == 0, "%d %a %a", face, point[0], point[1]);
    cm_grid_inverse_lonlat(made->grid, face, point, lonlat);
    cm_grid_inverse_lonlat_array(made->grid, 2, faces, u, v, lon, lat);
    EXPECT(memcmp(&lon[1], &lonlat[0], sizeof lon[1]) == 0 &&
               memcmp(&lat[1], &lonlat[1], sizeof lat[1]) == 0,
           "%d %a %a", face, point[0], point[1]);
    cm_grid_inverse_distortion(made->grid, face, point, &d);
    double one = cm_grid_area_element(made->grid, face, point);
    cm_grid_area_element_array(made->grid, 2, faces, u, v, area);
    EXPECT(memcmp(&area[1], &one, sizeof one) == 0 && !(one < 0.0), "%g", one);
    if (isnan(normal[0]))
    {
        EXPECT(isnan(lonlat[0]) && isnan(lonlat[1]) && isnan(one), "%d %a %a", face, point[0],
               point[1]);
        return;
    }
    cm_lonlat_from_direction(normal, through);
    EXPECT(fabs(lonlat[1] - through[1]) <= 4 * 0x1p-53, "%a, not %a", lonlat[1], through[1]);
}

static void check_lonlat(const grid_subject *made, double lon, double lat)
{
    double uv[2], u[2], v[2];
    const double lons[2] = {lon, lon};
    const double lats[2] = {lat, lat};
    uint8_t faces[2];
    uint8_t face = cm_grid_forward_lonlat(made->grid, lon, lat, uv);
    cm_grid_forward_lonlat_array(made->grid, 2, lons, lats, faces, u, v);
    EXPECT(faces[1] == face && memcmp(&u[1], &uv[0], sizeof u[1]) == 0 &&
               memcmp(&v[1], &uv[1], sizeof v[1]) == 0,
           "%a %a", lon, lat);
    int good = isfinite(lon) && fabs(lat) <= 1.5707963267948966 + 1e-9;
    EXPECT(good ? face != CM_NO_FACE || is_partial(&made->of) : face == CM_NO_FACE, "%a %a", lon,
           lat);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    grid_subject made;
    if (take_grid(&from, &made))
    {
        while (from.left > 0)
        {
            double normal[3], point[2];
            take_direction(&from, normal);
            take_point(&from, point);
            check_normal(&made, normal);
            check_point(&made, (uint8_t)(take_byte(&from) % 7), point);
            double lon = take_byte(&from) % 2 ? take_double(&from) : 4.0 * take_fraction(&from);
            check_lonlat(&made, lon, 1.6 * take_fraction(&from));
        }
        cm_grid_destroy(made.grid);
    }
    drop_subject(&made.of);
    return 0;
}
