/* SPDX-License-Identifier: MIT
 *
 * Cameras: what is one, where pixel centres are, and omnidirectional ones through every mapping of the catalogue.
 */
#define _POSIX_C_SOURCE 200809L

#include <cubemap/camera.h>
#include <cubemap/image.h>

#include "tests/instructions_variable.h"
#include "tests/suite.h"

#ifdef WRAPS_ALLOCATION
void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);

static int left_to_give = -1; /* below 0: all */

static int is_exhausted(void)
{
    const int is_empty = left_to_give == 0;
    left_to_give -= left_to_give > 0;
    return is_empty;
}

void *__wrap_malloc(size_t size)
{
    return is_exhausted() ? NULL : __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size)
{
    return is_exhausted() ? NULL : __real_calloc(count, size);
}
#endif

static const cm_camera_options plain = {.size = sizeof plain,
                                        .width = 640,
                                        .height = 480,
                                        .fx = 525.0,
                                        .fy = 525.0,
                                        .cx = 319.5,
                                        .cy = 239.5};

static char nothing;

static void refuse(const cm_camera_options *options, cm_status wanted)
{
    cm_camera *camera = (cm_camera *)(void *)&nothing;
    const cm_status status = cm_camera_create(options, &camera);
    REQUIRE(status == wanted, "%d, not %d", status, wanted);
    ck_assert_ptr_eq(camera, (cm_camera *)(void *)&nothing);
}

static void refuse_number(double *number, cm_camera_options *options, double value)
{
    const double kept = *number;
    *number = value;
    refuse(options, CM_ERROR_CAMERA);
    *number = kept;
}

START_TEST(what_is_no_camera_is_refused)
{
    cm_camera_options options = plain;
    cm_camera *camera = NULL;
    refuse(NULL, CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_camera_create(&options, NULL), CM_ERROR_ARGUMENT);
    options.size--;
    refuse(&options, CM_ERROR_ARGUMENT);
    options = plain;
    const double none[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    for (size_t i = 0; i < 3; i++)
    {
        refuse_number(&options.fx, &options, none[i]);
        refuse_number(&options.fy, &options, none[i]);
        refuse_number(&options.cx, &options, none[i]);
        refuse_number(&options.cy, &options, none[i]);
        refuse_number(&options.pixel_centre, &options, none[i]);
        for (int k = 0; k < 14; k++)
        {
            refuse_number(&options.distortion[k], &options, none[i]);
        }
    }
    refuse_number(&options.fx, &options, 0.0);
    refuse_number(&options.fy, &options, -0.0);
    refuse_number(&options.fy, &options, 5e-324);
    refuse_number(&options.pixel_centre, &options, -1e-9);
    refuse_number(&options.pixel_centre, &options, 1.0 + 1e-9);
    refuse_number(&options.distortion[2], &options, -1.1e150);
    refuse_number(&options.distortion[11], &options, 7.8e307);
    refuse_number(&options.distortion[12], &options, 1.5708);
    refuse_number(&options.distortion[13], &options, -1.5708);
    const uint32_t sizes[][2] = {
        {0, 480}, {640, 0}, {0, 0}, {65536, 32768}, {UINT32_MAX, UINT32_MAX}, {UINT32_MAX, 1}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
    {
        options.width = sizes[i][0];
        options.height = sizes[i][1];
        refuse(&options, CM_ERROR_CAMERA);
    }
    options.width = 65536;
    options.height = 32767;
    ck_assert_int_eq(cm_camera_create(&options, &camera), CM_OK);
    cm_camera_destroy(camera);
    cm_camera_destroy(NULL);
}
END_TEST

#ifdef WRAPS_ALLOCATION
START_TEST(without_memory_there_is_no_camera)
{
    cm_mapping *mapping = make_mapping("coupled", NULL);
    const cm_camera_options around = {
        .size = sizeof around, .width = 4, .height = 24, .mapping = mapping};
    for (int given = 0; given < 2; given++)
    {
        char untouched;
        cm_camera *camera = (cm_camera *)(void *)&untouched;
        left_to_give = given;
        const cm_status status = cm_camera_create(given == 0 ? &plain : &around, &camera);
        left_to_give = -1;
        REQUIRE(status == CM_ERROR_MEMORY, "%d", (int)status);
        ck_assert_ptr_eq(camera, (cm_camera *)(void *)&untouched);
    }
    cm_mapping_destroy(mapping);
}
END_TEST
#endif

START_TEST(sizes_fit_the_mapping)
{
    cm_mapping *cube = make_mapping("coupled", NULL);
    cm_mapping *fisheye = make_mapping("azimuthal:equidistant", NULL);
    cm_mapping *disc = make_mapping("square:shirley", NULL);
    cm_camera_options options = {.size = sizeof options, .width = 64, .height = 64};
    cm_camera *camera = NULL;
    options.mapping = cube;
    refuse(&options, CM_ERROR_CAMERA);
    options.mapping = disc; /* disc to square: no sphere */
    refuse(&options, CM_ERROR_CAMERA);
    options.mapping = fisheye;
    options.height = 384;
    refuse(&options, CM_ERROR_CAMERA);
    options.mapping = cube;
    options.width = 18919; /* 2^31 pixels and some */
    options.height = 6 * 18919;
    refuse(&options, CM_ERROR_CAMERA);
    options.width = 64;
    options.height = 384;
    ck_assert_int_eq(cm_camera_create(&options, &camera), CM_OK);
    ck_assert(isnan(cm_camera_border(camera, 0.0)));
    cm_camera_destroy(camera);
    cm_mapping_destroy(cube);
    cm_mapping_destroy(fisheye);
    cm_mapping_destroy(disc);
}
END_TEST

/* The same camera by both conventions: pixel (i, j) has one ray, and what is half a pixel off is a mistake (Open3D#7580). */
START_TEST(pixel_centres_are_where_they_are_said_to_be)
{
    cm_camera_options halves = plain;
    halves.pixel_centre = 0.5;
    halves.cx += 0.5;
    halves.cy += 0.5;
    cm_camera *at_integers = NULL;
    cm_camera *at_halves = NULL;
    ck_assert_int_eq(cm_camera_create(&plain, &at_integers), CM_OK);
    ck_assert_int_eq(cm_camera_create(&halves, &at_halves), CM_OK);
    for (int j = 0; j < 480; j += 37)
    {
        for (int i = 0; i < 640; i += 29)
        {
            double column = i + cm_camera_describe(at_integers)->pixel_centre;
            double row = j + cm_camera_describe(at_integers)->pixel_centre;
            double one[3];
            double other[3];
            cm_camera_ray_array(at_integers, 1, &column, &row, &one[0], &one[1], &one[2]);
            ck_assert(fabs(one[0] - (i - 319.5) / 525.0) < 1e-15 && one[2] == 1.0);
            column = i + cm_camera_describe(at_halves)->pixel_centre;
            row = j + cm_camera_describe(at_halves)->pixel_centre;
            cm_camera_ray_array(at_halves, 1, &column, &row, &other[0], &other[1], &other[2]);
            ck_assert(fabs(one[0] - other[0]) < 1e-15 && fabs(one[1] - other[1]) < 1e-15);
            /* a surface seen by one at depth 3 falls onto the same pixel of the other */
            for (int k = 0; k < 3; k++)
            {
                other[k] = 3.0 * one[k];
            }
            cm_camera_project_array(at_halves, 1, &other[0], &other[1], &other[2], &column, &row);
            REQUIRE(fabs(column - 0.5 - i) < 1e-9 && fabs(row - 0.5 - j) < 1e-9, "%d %d: %g %g", i,
                    j, column, row);
        }
    }
    cm_camera_destroy(at_integers);
    cm_camera_destroy(at_halves);
}
END_TEST

START_TEST(nothing_is_behind)
{
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(&plain, &camera), CM_OK);
    const double z[] = {0.0, -0.0, -1.0, -1e-300, (double)NAN, -(double)INFINITY};
    for (size_t i = 0; i < sizeof z / sizeof *z; i++)
    {
        const double x = 0.1;
        double column = 7.0;
        double row = 7.0;
        cm_camera_project_array(camera, 1, &x, &x, &z[i], &column, &row);
        REQUIRE(isnan(column) && isnan(row), "%g: %g %g", z[i], column, row);
    }
    /* outside of the picture, inside of the field: given */
    const double side[3] = {-30.0, 40.0, 1.0};
    double column, row, back[3];
    cm_camera_project_array(camera, 1, &side[0], &side[1], &side[2], &column, &row);
    ck_assert(fabs(column + 15430.5) < 1e-9 && fabs(row - 21239.5) < 1e-9);
    cm_camera_ray_array(camera, 1, &column, &row, &back[0], &back[1], &back[2]);
    ck_assert(fabs(back[0] + 30.0) < 1e-12 && fabs(back[1] - 40.0) < 1e-12);
    ck_assert(cm_camera_border(camera, 1.0) == (double)INFINITY);
    ck_assert(isnan(cm_camera_border(camera, (double)NAN)));
    const double nowhere = (double)NAN;
    cm_camera_ray_array(camera, 1, &nowhere, &row, &back[0], &back[1], &back[2]);
    ck_assert(isnan(back[0]) && isnan(back[1]) && isnan(back[2]));
    ck_assert(isnan(cm_camera_solid_angle(camera, nowhere, row)));
    cm_camera_project_array(camera, 0, NULL, NULL, NULL, NULL, NULL);
    cm_camera_ray_array(camera, 0, NULL, NULL, NULL, NULL, NULL);
    cm_camera_destroy(camera);
}
END_TEST

enum
{
    MANY = 1000
};

/* In one call, in pieces that begin anywhere, one by one, and in place. */
START_TEST(bits_do_not_depend_on_the_call)
{
    cm_camera_options options = plain;
    const double bent[14] = {-0.5, 0.1, 0.03, -0.02, 0.0, 0.1, 0.0, 0.0, 0.02, 0.0, 0.01, 0.0, 0.1};
    memcpy(options.distortion, bent, sizeof bent);
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(&options, &camera), CM_OK);
    static double column[MANY], row[MANY], x[MANY], y[MANY], z[MANY], part[3][MANY], place[2][MANY];
    for (int i = 0; i < MANY; i++)
    {
        column[i] = (i * 7919) % 641 - 0.25;
        row[i] = (i * 104729) % 483 - 1.5;
    }
    cm_camera_ray_array(camera, MANY, column, row, x, y, z);
    const size_t pieces[] = {1, 3, 64, 65, 143};
    for (size_t p = 0; p < sizeof pieces / sizeof *pieces; p++)
    {
        for (size_t i = 0; i < MANY; i += pieces[p])
        {
            const size_t n = MANY - i < pieces[p] ? MANY - i : pieces[p];
            cm_camera_ray_array(camera, n, column + i, row + i, part[0] + i, part[1] + i,
                                part[2] + i);
        }
        ck_assert_mem_eq(part[0], x, sizeof x);
        ck_assert_mem_eq(part[1], y, sizeof y);
        ck_assert_mem_eq(part[2], z, sizeof z);
    }
    cm_camera_project_array(camera, MANY, x, y, z, place[0], place[1]);
    cm_camera_project_array(camera, MANY, part[0], part[1], part[2], part[1], part[2]);
    ck_assert_mem_eq(part[1], place[0], sizeof place[0]);
    ck_assert_mem_eq(part[2], place[1], sizeof place[1]);
    cm_camera_destroy(camera);
}
END_TEST

/* All sets have the same field and the same places, but for rounding. */
START_TEST(instruction_sets_agree)
{
    cm_camera_options options = plain;
    const double bent[14] = {-0.9, 0.3,  0.03, -0.02, 0.0, 0.1,  0.0,
                             0.0,  0.02, 0.0,  0.01,  0.0, 0.05, 0.02};
    memcpy(options.distortion, bent, sizeof bent);
    static double column[MANY], row[MANY], x[MANY], y[MANY], z[MANY], place[2][MANY],
        first[3][MANY];
    for (int i = 0; i < MANY; i++)
    {
        column[i] = (i * 7919) % 641 - 0.25;
        row[i] = (i * 104729) % 483 - 1.5;
    }
    const char *kept = getenv("CUBEMAP_INSTRUCTIONS");
    char before[32] = "";
    snprintf(before, sizeof before, "%s", kept != NULL ? kept : "");
    for (size_t set = 0; set < cm_instructions_count(); set++)
    {
        cm_camera *camera = NULL;
        set_instructions_variable(cm_instructions_at(set));
        ck_assert_int_eq(cm_camera_create(&options, &camera), CM_OK);
        cm_camera_ray_array(camera, MANY, column, row, x, y, z);
        cm_camera_project_array(camera, MANY, x, y, z, place[0], place[1]);
        if (set == 0)
        {
            memcpy(first[0], x, sizeof x);
            memcpy(first[1], y, sizeof y);
        }
        for (int i = 0; i < MANY; i++)
        {
            REQUIRE(isnan(x[i]) == isnan(first[0][i]), "%s: %d", cm_instructions_at(set), i);
            REQUIRE(isnan(x[i]) || (fabs(place[0][i] - column[i]) <= 1e-9 &&
                                    fabs(place[1][i] - row[i]) <= 1e-9 &&
                                    fabs(x[i] - first[0][i]) + fabs(y[i] - first[1][i]) < 1e-9),
                    "%s: %d", cm_instructions_at(set), i);
        }
        cm_camera_destroy(camera);
    }
    set_instructions_variable(before);
}
END_TEST

/* Of one mapping: every pixel there and back, where surfaces of images have it, and solid angles. */
static void check_mapping(const cm_mapping *mapping, double centre)
{
    const cm_mapping_info *info = cm_mapping_describe(mapping);
    const unsigned faces = info->kind == CM_KIND_CUBE ? 6 : 1;
    enum
    {
        EDGE = 24
    };
    cm_camera_options options = {.size = sizeof options,
                                 .width = EDGE,
                                 .height = EDGE * faces,
                                 .pixel_centre = centre,
                                 .mapping = mapping};
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(&options, &camera), CM_OK);
    ck_assert_ptr_ne(cm_camera_describe(camera)->mapping, mapping);
    double sum = 0.0;
    for (unsigned j = 0; j < EDGE * faces; j++)
    {
        for (unsigned i = 0; i < EDGE; i++)
        {
            const double column = i + centre;
            const double row = j + centre;
            const double uv[2] = {(2.0 * i + 1.0) / EDGE - 1.0,
                                  1.0 - (2.0 * (j % EDGE) + 1.0) / EDGE};
            const int first_v = faces == 6 ? cm_mapping_frame(mapping)->first_row_v : 1;
            double ray[3], wanted[3], again[2];
            cm_inverse(mapping, (uint8_t)(j / EDGE), (const double[2]){uv[0], first_v * uv[1]},
                       wanted);
            cm_camera_ray_array(camera, 1, &column, &row, &ray[0], &ray[1], &ray[2]);
            if (isnan(wanted[0]))
            {
                ck_assert(isnan(ray[0]) && !cm_camera_has_ray(camera, column, row));
                ck_assert(isnan(cm_camera_solid_angle(camera, column, row)));
                continue;
            }
            for (int k = 0; k < 3; k++)
            {
                REQUIRE(fabs(ray[k] - wanted[k]) < 1e-14, "%s %u %u", info->identifier, i, j);
            }
            cm_camera_project_array(camera, 1, &ray[0], &ray[1], &ray[2], &again[0], &again[1]);
            REQUIRE(fabs(again[0] - column) <= 1e-9 && fabs(again[1] - row) <= 1e-9,
                    "%s %u %u: %.12g %.12g", info->identifier, i, j, again[0], again[1]);
            sum += cm_camera_solid_angle(camera, column, row);
        }
    }
    const double whole = 4.0 * 3.14159265358979323846;
    REQUIRE(faces == 1 || fabs(sum - whole) < 0.05 * whole, "%s: %g", info->identifier,
            sum / whole);
    cm_camera_destroy(camera);
}

START_TEST(every_mapping_is_a_camera)
{
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        if (cm_catalogue_at(i)->kind == CM_KIND_DISC_SQUARE)
        {
            continue;
        }
        for (size_t f = 0; f < cm_frame_count(); f++)
        {
            cm_mapping *mapping = make_mapping(cm_catalogue_at(i)->identifier, cm_frame_at(f));
            check_mapping(mapping, f % 2 == 0 ? 0.5 : 0.0);
            check_mapping(mapping, f % 2 == 0 ? 0.0 : 0.5);
            cm_mapping_destroy(mapping);
        }
    }
}
END_TEST

/* Column by column and row by row as the picture "cube:...;layout=column" of that mapping. */
START_TEST(faces_lie_as_in_pictures)
{
    for (size_t f = 0; f < cm_frame_count(); f++)
    {
        char text[100];
        snprintf(text, sizeof text, "cube:coupled;frame=%s;size=8", cm_frame_at(f)->identifier);
        cm_surface *surface = NULL;
        ck_assert_int_eq(cm_surface_create(text, NULL, &surface), CM_OK);
        cm_mapping *mapping = make_mapping("coupled", cm_frame_at(f));
        const cm_camera_options options = {.size = sizeof options,
                                           .width = 8,
                                           .height = 48,
                                           .pixel_centre = 0.5,
                                           .mapping = mapping};
        cm_camera *camera = NULL;
        ck_assert_int_eq(cm_camera_create(&options, &camera), CM_OK);
        cm_mapping_destroy(mapping); /* the camera has its own */
        for (int j = 0; j < 48; j++)
        {
            const uint8_t plane = (uint8_t)(j / 8);
            const double column = 2.5, row = j + 0.5, in_plane = j % 8 + 0.5;
            double ray[3], wanted[3];
            cm_camera_ray_array(camera, 1, &column, &row, &ray[0], &ray[1], &ray[2]);
            cm_surface_directions(surface, 1, &plane, &column, &in_plane, &wanted[0], &wanted[1],
                                  &wanted[2]);
            ck_assert(fabs(ray[0] - wanted[0]) < 1e-15 && fabs(ray[1] - wanted[1]) < 1e-15 &&
                      fabs(ray[2] - wanted[2]) < 1e-15);
        }
        cm_surface_destroy(surface);
        cm_camera_destroy(camera);
    }
}
END_TEST

static void check_edges(const cm_mapping *mapping, uint32_t width, double centre)
{
    const cm_camera_options options = {.size = sizeof options,
                                       .width = width,
                                       .height = 6 * width,
                                       .pixel_centre = centre,
                                       .mapping = mapping};
    const char *name = cm_mapping_describe(mapping)->identifier;
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(&options, &camera), CM_OK);
    for (int i = 0; i < 6 * 3 * 9; i++) /* along the edges of all faces, corners too */
    {
        const int axis = i / 9 % 3, along = (axis + 1) % 3, other = (axis + 2) % 3;
        double d[3], column, row, ray[3], uv[2];
        d[axis] = i / 27 % 2 ? 1.0 : -1.0;
        d[along] = i / 54 % 2 ? 1.0 : -1.0;
        d[other] = (i % 9 - 4) / 4.0 * (i / 108 ? 0.9 : 1.0);
        const uint8_t face = cm_forward(mapping, d, uv);
        cm_camera_project_array(camera, 1, &d[0], &d[1], &d[2], &column, &row);
        const double in_column = floor(column - centre + 0.5), in_row = floor(row - centre + 0.5);
        REQUIRE(in_column >= 0.0 && in_column < width, "%s: column %.17g", name, column);
        REQUIRE(in_row >= (double)face * width && in_row < (face + 1.0) * width,
                "%s: face %d, row %.17g of %u", name, face, row, width);
        cm_camera_ray_array(camera, 1, &column, &row, &ray[0], &ray[1], &ray[2]);
        const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        for (int k = 0; k < 3; k++)
        {
            REQUIRE(fabs(ray[k] - d[k] / length) < 1e-6, "%s: %d", name, i);
        }
    }
    cm_camera_destroy(camera);
}

/* Otherwise what is seen at a face's last edge would be the next face's, or beside the picture. */
START_TEST(edges_belong_to_their_face)
{
    static const char *const names[] = {"gnomonic", "tangent", "coupled", "qsc", "cobe", "healpix"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
    {
        for (size_t f = 0; f < cm_frame_count(); f++)
        {
            cm_mapping *mapping = make_mapping(names[i], cm_frame_at(f));
            for (int k = 0; k < 5; k++)
            {
                const uint32_t widths[] = {1, 7, 64, 100, 4096};
                check_edges(mapping, widths[k], 0.25 * (k + (int)f) - floor(0.25 * (k + (int)f)));
                check_edges(mapping, widths[k], 0.5);
            }
            cm_mapping_destroy(mapping);
        }
    }
}
END_TEST

/* Parameters, parts and frame of a mapping are in its copy. */
START_TEST(copies_are_the_same_mapping)
{
    const char *const specifications[] = {"tangent:c=1.1", "quincuncial:lambert,elliptical",
                                          "azimuthal:stereographic,fov=200", "healpix"};
    ck_assert_int_eq(cm_mapping_copy(NULL, NULL), CM_ERROR_ARGUMENT);
    for (size_t i = 0; i < sizeof specifications / sizeof *specifications; i++)
    {
        cm_mapping *mapping = make_mapping(specifications[i], cm_frame_at(i));
        cm_mapping *copy = NULL;
        const double direction[3] = {0.3, -0.2, 0.6};
        double one[2], other[2];
        ck_assert_int_eq(cm_mapping_copy(mapping, NULL), CM_ERROR_ARGUMENT);
        ck_assert_int_eq(cm_mapping_copy(mapping, &copy), CM_OK);
        const uint8_t face = cm_forward(mapping, direction, one);
        cm_mapping_destroy(mapping);
        ck_assert_int_eq(cm_forward(copy, direction, other), face);
        ck_assert_mem_eq(one, other, sizeof one);
        cm_mapping_destroy(copy);
    }
}
END_TEST

/* Columns and rows move with the direction as differences say. */
START_TEST(derivatives_of_mappings_are_slopes)
{
    cm_mapping *mapping = make_mapping("coupled", cm_frame_find("gl"));
    const cm_camera_options options = {
        .size = sizeof options, .width = 100, .height = 600, .mapping = mapping};
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(&options, &camera), CM_OK);
    const double point[3] = {0.9, -2.0, 0.4};
    double jacobian[6];
    cm_camera_jacobian(camera, point, jacobian);
    for (int k = 0; k < 3; k++)
    {
        double more[3] = {point[0], point[1], point[2]}, less[3] = {point[0], point[1], point[2]};
        double up[2], low[2];
        more[k] += 1e-6;
        less[k] -= 1e-6;
        cm_camera_project_array(camera, 1, &more[0], &more[1], &more[2], &up[0], &up[1]);
        cm_camera_project_array(camera, 1, &less[0], &less[1], &less[2], &low[0], &low[1]);
        for (int i = 0; i < 2; i++)
        {
            REQUIRE(fabs(jacobian[3 * i + k] - (up[i] - low[i]) / 2e-6) < 1e-5, "%d %d", i, k);
        }
    }
    cm_camera_destroy(camera);
    cm_mapping_destroy(mapping);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {what_is_no_camera_is_refused,
#ifdef WRAPS_ALLOCATION
                                  without_memory_there_is_no_camera,
#endif
                                  sizes_fit_the_mapping,
                                  pixel_centres_are_where_they_are_said_to_be,
                                  nothing_is_behind,
                                  bits_do_not_depend_on_the_call,
                                  instruction_sets_agree,
                                  every_mapping_is_a_camera,
                                  faces_lie_as_in_pictures,
                                  edges_belong_to_their_face,
                                  copies_are_the_same_mapping,
                                  derivatives_of_mappings_are_slopes,
                                  NULL};
    return run_suite("camera", tests);
}
