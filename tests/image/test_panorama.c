/* SPDX-License-Identifier: MIT
 *
 * Photo Sphere metadata: from text to fields to surfaces, and back.
 */
#include <cubemap/panorama.h>

#include "tests/suite.h"

static cm_panorama read_good(const char *text)
{
    cm_panorama panorama = {.size = sizeof panorama};
    REQUIRE(cm_panorama_read(text, strlen(text), &panorama) == CM_OK, "%s", text);
    return panorama;
}

/* As a telephone writes it; as elements; with another prefix, and quotes; with a name that is the beginning of another one. */
static const char attributes[] =
    "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:Description rdf:about=\"\"\n"
    " xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\" GPano:UsePanoramaViewer=\"True\"\n"
    " GPano:ProjectionType=\"equirectangular\" GPano:PoseHeadingDegrees=\"122.5\"\n"
    " GPano:CroppedAreaImageWidthPixels=\"2000\" GPano:CroppedAreaImageHeightPixels=\"750\"\n"
    " GPano:FullPanoWidthPixels=\"4000\" GPano:FullPanoHeightPixels=\"2000\"\n"
    " GPano:CroppedAreaLeftPixels=\"1000\" GPano:CroppedAreaTopPixels=\"500\"/></x:xmpmeta>";
static const char elements[] =
    "<r "
    "xmlns:p='http://ns.google.com/photos/1.0/panorama/'><p:ProjectionType>Equirectangular</"
    "p:ProjectionType>"
    "<p:PoseHeadingDegrees> 122.5 "
    "</p:PoseHeadingDegrees><p:FullPanoWidthPixels>4000</p:FullPanoWidthPixels>"
    "<p:FullPanoHeightPixels>2000\n</p:FullPanoHeightPixels><p:CroppedAreaLeftPixels>1000</"
    "p:CroppedAreaLeftPixels>"
    "<p:CroppedAreaTopPixels >500</p:CroppedAreaTopPixels "
    "><p:CroppedAreaImageWidthPixelsMore>1</p:x>"
    "<p:CroppedAreaImageWidthPixels>2000</p:CroppedAreaImageWidthPixels>"
    "<q:CroppedAreaImageHeightPixels>7</q:x><p:CroppedAreaImageHeightPixels = '750'/></r>";

START_TEST(test_reading)
{
    const char *const texts[] = {attributes, elements};
    for (int i = 0; i < 2; i++)
    {
        const cm_panorama panorama = read_good(texts[i]);
        ck_assert_uint_eq(panorama.full_width, 4000);
        ck_assert_uint_eq(panorama.full_height, 2000);
        ck_assert_uint_eq(panorama.cropped_left, 1000);
        ck_assert_uint_eq(panorama.cropped_top, 500);
        ck_assert_uint_eq(panorama.cropped_width, 2000);
        ck_assert_uint_eq(panorama.cropped_height, 750);
        ck_assert_double_eq(panorama.heading, 122.5);
        ck_assert_double_eq(panorama.pitch, 0.0);
        ck_assert_double_eq(panorama.roll, 0.0);
    }
    const cm_panorama whole = read_good("GPano:ProjectionType=\"equirectangular\"");
    ck_assert_uint_eq(whole.full_width, 0);
    ck_assert_double_nan(whole.heading);
    const cm_panorama uncropped =
        read_good("GPano:FullPanoWidthPixels=\"400\" GPano:FullPanoHeightPixels=\"200\"");
    ck_assert_uint_eq(uncropped.cropped_width, 400);
    ck_assert_uint_eq(uncropped.cropped_height, 200);
}
END_TEST

START_TEST(test_bad_text)
{
    static const struct
    {
        const char *text;
        cm_status status;
    } bad[] = {
        {"", CM_ERROR_UNSUPPORTED},
        {"ProjectionType=\"equirectangular\"", CM_ERROR_UNSUPPORTED},
        {"GPano:ProjectionType", CM_ERROR_UNSUPPORTED},
        {"GPano:ProjectionType=equirectangular", CM_ERROR_UNSUPPORTED},
        {"GPano:ProjectionType=\"equirectangular", CM_ERROR_UNSUPPORTED},
        {"GPano:ProjectionType=\"cylindrical\"", CM_ERROR_UNSUPPORTED},
        {"GPano:ProjectionType=\"equirectangular2\"", CM_ERROR_UNSUPPORTED},
        {"GPano:FullPanoWidthPixels=\"wide\"", CM_ERROR_SYNTAX},
        {"GPano:FullPanoWidthPixels=\"\"", CM_ERROR_SYNTAX},
        {"GPano:FullPanoWidthPixels=\"400\"", CM_ERROR_RANGE},
        {"GPano:FullPanoWidthPixels=\"400.5\" GPano:FullPanoHeightPixels=\"200\"", CM_ERROR_RANGE},
        {"GPano:FullPanoWidthPixels=\"4e99\" GPano:FullPanoHeightPixels=\"200\"", CM_ERROR_RANGE},
        {"GPano:FullPanoWidthPixels=\"400\" GPano:FullPanoHeightPixels=\"200\" "
         "GPano:CroppedAreaLeftPixels=\"1\"",
         CM_ERROR_RANGE},
        {"GPano:FullPanoWidthPixels=\"400\" GPano:FullPanoHeightPixels=\"200\" "
         "GPano:CroppedAreaTopPixels=\"-1\"",
         CM_ERROR_RANGE},
        {"GPano:ProjectionType=\"equirectangular\" GPano:PosePitchDegrees=\"91\"", CM_ERROR_RANGE},
        {"GPano:ProjectionType=\"equirectangular\" GPano:PoseHeadingDegrees=\"361\"",
         CM_ERROR_RANGE},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
    {
        cm_panorama panorama = {.size = sizeof panorama, .full_width = 77};
        const cm_status status = cm_panorama_read(bad[i].text, strlen(bad[i].text), &panorama);
        REQUIRE(status == bad[i].status && panorama.full_width == 77, "%s is %d, not %d",
                bad[i].text, status, bad[i].status);
    }
    cm_panorama panorama = {.size = 1};
    ck_assert_int_eq(cm_panorama_read("", 0, &panorama), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_panorama_read(NULL, 0, &panorama), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_panorama_check(NULL), CM_ERROR_ARGUMENT);
}
END_TEST

/* Every beginning of a text is read without a step beyond its end, which a sanitizer sees. */
START_TEST(test_cut_text)
{
    const char *const texts[] = {attributes, elements};
    for (int i = 0; i < 2; i++)
    {
        for (size_t length = 0; length <= strlen(texts[i]); length++)
        {
            char *text = malloc(length + 1);
            ck_assert_ptr_nonnull(text);
            memcpy(text, texts[i], length);
            cm_panorama panorama = {.size = sizeof panorama};
            char *exact = realloc(text, length > 0 ? length : 1);
            ck_assert_ptr_nonnull(exact);
            const cm_status status = cm_panorama_read(exact, length, &panorama);
            ck_assert(status == CM_OK || status == CM_ERROR_UNSUPPORTED ||
                      status == CM_ERROR_RANGE || status == CM_ERROR_SYNTAX);
            free(exact);
        }
    }
}
END_TEST

START_TEST(test_surface_of_a_part)
{
    const cm_panorama panorama = read_good(attributes);
    char text[256];
    cm_rotation rotation;
    /* scaled to a half since it was cropped */
    ck_assert_int_eq(cm_panorama_surface(&panorama, 1000, 375, text, sizeof text, &rotation),
                     CM_OK);
    ck_assert_str_eq(text, "equirect;west=-90;east=90;south=-22.5;north=45;size=1000;height=375");
    const cm_surface_options options = {.size = sizeof options, .rotation = &rotation};
    cm_surface *surface = NULL;
    ck_assert_int_eq(cm_surface_create(text, &options, &surface), CM_OK);
    /* the middle of the whole looks to its heading */
    const double heading = 122.5 * (3.14159265358979323846 / 180.0);
    const double d[3] = {cos(heading), sin(heading), 0.0};
    uint8_t plane;
    double column, row;
    cm_surface_positions(surface, 1, &d[0], &d[1], &d[2], &plane, &column, &row);
    ck_assert_double_eq_tol(column, 500.0, 1e-9);
    ck_assert_double_eq_tol(row, 250.0, 1e-9);

    cm_panorama again = {.size = sizeof again};
    ck_assert_int_eq(cm_panorama_of_surface(surface, &again), CM_OK);
    ck_assert_uint_eq(again.full_width, 2000);
    ck_assert_uint_eq(again.full_height, 1000);
    ck_assert_uint_eq(again.cropped_left, 500);
    ck_assert_uint_eq(again.cropped_top, 250);
    ck_assert_uint_eq(again.cropped_width, 1000);
    ck_assert_uint_eq(again.cropped_height, 375);
    ck_assert_double_eq_tol(again.heading, 122.5, 1e-12);
    cm_surface_destroy(surface);

    ck_assert_int_eq(cm_panorama_surface(&panorama, 0, 1, text, sizeof text, NULL), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_panorama_surface(&panorama, 1, 1, text, 10, NULL), CM_ERROR_SPACE);
    ck_assert_int_eq(cm_panorama_surface(&panorama, 1, 1, NULL, 10, NULL), CM_ERROR_ARGUMENT);
}
END_TEST

/* Where the horizon is in a picture that is rolled: higher to its right, as it has turned anticlockwise. */
START_TEST(test_pose)
{
    cm_panorama panorama =
        read_good("GPano:ProjectionType=\"equirectangular\" "
                  "GPano:PosePitchDegrees=\"10\" GPano:PoseHeadingDegrees=\"0\"");
    const double ahead[3] = {1.0, 0.0, 0.0}, right[3] = {0.0, 1.0, 0.0};
    char text[256];
    uint8_t plane;
    double column, row;
    for (int rolled = 0; rolled < 2; rolled++)
    {
        cm_rotation rotation;
        cm_surface *surface = NULL;
        panorama.roll = rolled ? 20.0 : 0.0;
        panorama.pitch = rolled ? 0.0 : 10.0;
        ck_assert_int_eq(cm_panorama_surface(&panorama, 360, 180, text, sizeof text, &rotation),
                         CM_OK);
        const cm_surface_options options = {.size = sizeof options, .rotation = &rotation};
        ck_assert_int_eq(cm_surface_create(text, &options, &surface), CM_OK);
        const double *d = rolled ? right : ahead;
        cm_surface_positions(surface, 1, &d[0], &d[1], &d[2], &plane, &column, &row);
        /* pitched up, the horizon ahead is below the middle */
        ck_assert_double_eq_tol(row, rolled ? 70.0 : 100.0, 1e-9);
        cm_panorama again = {.size = sizeof again};
        ck_assert_int_eq(cm_panorama_of_surface(surface, &again), CM_OK);
        ck_assert_double_eq_tol(again.roll, panorama.roll, 1e-12);
        ck_assert_double_eq_tol(again.pitch, panorama.pitch, 1e-12);
        ck_assert_double_eq_tol(again.heading, 0.0, 1e-12);
        cm_surface_destroy(surface);
    }
}
END_TEST

START_TEST(test_writing)
{
    cm_panorama panorama = read_good(attributes);
    char text[2048];
    ck_assert_int_eq(cm_panorama_write(&panorama, text, sizeof text), CM_OK);
    const cm_panorama again = read_good(text);
    ck_assert_uint_eq(again.full_width, panorama.full_width);
    ck_assert_uint_eq(again.cropped_top, panorama.cropped_top);
    ck_assert_uint_eq(again.cropped_height, panorama.cropped_height);
    ck_assert_double_eq(again.heading, panorama.heading);
    const size_t length = strlen(text);
    ck_assert_int_eq(cm_panorama_write(&panorama, text, length), CM_ERROR_SPACE);
    ck_assert_int_eq(cm_panorama_write(&panorama, text, length + 1), CM_OK);
    ck_assert_int_eq(cm_panorama_write(&panorama, NULL, 0), CM_ERROR_ARGUMENT);
    panorama.full_width = panorama.full_height = 0;
    ck_assert_int_eq(cm_panorama_write(&panorama, text, sizeof text), CM_ERROR_RANGE);
}
END_TEST

/* The fields that say how the picture stands are written if there is something to say; an unknown heading stays unknown,
 * beside pitch and roll, too. */
START_TEST(test_writing_without_heading)
{
    static const struct
    {
        double heading, pitch, roll;
        int has_heading, has_pose;
    } cases[] = {{(double)NAN, 0.0, 0.0, 0, 0},
                 {(double)NAN, 10.0, 0.0, 0, 1},
                 {(double)NAN, 0.0, -30.0, 0, 1},
                 {0.0, 0.0, 0.0, 1, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
        cm_panorama panorama = read_good(attributes);
        char text[2048];
        panorama.heading = cases[i].heading;
        panorama.pitch = cases[i].pitch;
        panorama.roll = cases[i].roll;
        ck_assert_int_eq(cm_panorama_write(&panorama, text, sizeof text), CM_OK);
        ck_assert_int_eq(strstr(text, "PoseHeadingDegrees") != NULL, cases[i].has_heading);
        ck_assert_int_eq(strstr(text, "PosePitchDegrees") != NULL, cases[i].has_pose);
        ck_assert_int_eq(strstr(text, "PoseRollDegrees") != NULL, cases[i].has_pose);
        ck_assert_ptr_null(strstr(text, "nan"));
        const cm_panorama again = read_good(text);
        ck_assert((isnan(again.heading) != 0) == !cases[i].has_heading);
        ck_assert(!cases[i].has_heading || again.heading == cases[i].heading);
        ck_assert_double_eq(again.pitch, cases[i].pitch);
        ck_assert_double_eq(again.roll, cases[i].roll);
        ck_assert_uint_eq(again.cropped_width, panorama.cropped_width);
    }
}
END_TEST

/* What lies across longitude 180 is a part of a whole that is turned: the surface of its fields has the same directions at
 * the same pixels, whichever way the first one stands. */
START_TEST(test_parts_across_the_antimeridian)
{
    static const struct
    {
        const char *text;
        uint32_t full_width, left;
        int turned;
    } parts[] = {{"equirect;west=170;east=190;south=0;north=10;size=80", 1440, 680, 1},
                 {"equirect;west=-200;east=-170;south=-90;north=0;size=45", 540, 247, 1},
                 {"equirect;west=0;east=360;size=80", 80, 0, 1},
                 {"equirect;west=100;east=440;south=-90;north=90;size=68", 72, 2, 1},
                 {"equirect;west=370;east=380;south=0;north=10;size=20", 720, 380, 0},
                 {"equirect;west=180;east=540;size=80", 80, 0, 0}};
    cm_rotation rotation;
    ck_assert_int_eq(cm_rotation_from_angles(30.0, 50.0, -70.0, &rotation), CM_OK);
    for (size_t i = 0; i < 2 * sizeof parts / sizeof *parts; i++)
    {
        const cm_surface_options options = {.size = sizeof options,
                                            .rotation = i % 2 == 0 ? NULL : &rotation};
        cm_surface *surface = NULL, *again = NULL;
        cm_panorama panorama = {.size = sizeof panorama};
        cm_rotation stands;
        char text[256];
        ck_assert_int_eq(cm_surface_create(parts[i / 2].text, &options, &surface), CM_OK);
        REQUIRE(cm_panorama_of_surface(surface, &panorama) == CM_OK, "%s", parts[i / 2].text);
        ck_assert_uint_eq(panorama.full_width, parts[i / 2].full_width);
        ck_assert_uint_eq(panorama.cropped_left, parts[i / 2].left);
        ck_assert(i % 2 == 1 || (panorama.heading != 0.0) == parts[i / 2].turned);
        const uint32_t width = cm_surface_width(surface), height = cm_surface_height(surface);
        ck_assert_int_eq(cm_panorama_surface(&panorama, width, height, text, sizeof text, &stands),
                         CM_OK);
        const cm_surface_options standing = {.size = sizeof standing, .rotation = &stands};
        ck_assert_int_eq(cm_surface_create(text, &standing, &again), CM_OK);
        for (int k = 0; k < 9; k++)
        {
            double d[3], e[3], column = width * (0.5 + k % 3) / 3, row = height * (0.5 + k / 3) / 3;
            const uint8_t plane = 0;
            cm_surface_directions(surface, 1, &plane, &column, &row, &d[0], &d[1], &d[2]);
            cm_surface_directions(again, 1, &plane, &column, &row, &e[0], &e[1], &e[2]);
            REQUIRE(fabs(d[0] - e[0]) < 1e-12 && fabs(d[1] - e[1]) < 1e-12 &&
                        fabs(d[2] - e[2]) < 1e-12,
                    "%s: %g,%g,%g is %g,%g,%g", text, d[0], d[1], d[2], e[0], e[1], e[2]);
        }
        cm_surface_destroy(again);
        cm_surface_destroy(surface);
    }
}
END_TEST

START_TEST(test_surfaces_without_fields)
{
    cm_panorama panorama = {.size = sizeof panorama, .full_width = 77};
    static const struct
    {
        const char *text;
        cm_status status;
    } none[] = {{"cube;size=8", CM_ERROR_UNSUPPORTED},
                {"mercator;size=8", CM_ERROR_UNSUPPORTED},
                {"equirect;west=0.1;east=90;size=100", CM_ERROR_RANGE}};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
    {
        cm_surface *surface = NULL;
        ck_assert_int_eq(cm_surface_create(none[i].text, NULL, &surface), CM_OK);
        ck_assert_int_eq(cm_panorama_of_surface(surface, &panorama), none[i].status);
        ck_assert_uint_eq(panorama.full_width, 77);
        cm_surface_destroy(surface);
    }
    ck_assert_int_eq(cm_panorama_of_surface(NULL, &panorama), CM_ERROR_ARGUMENT);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {test_reading,
                                  test_bad_text,
                                  test_cut_text,
                                  test_surface_of_a_part,
                                  test_pose,
                                  test_writing,
                                  test_writing_without_heading,
                                  test_parts_across_the_antimeridian,
                                  test_surfaces_without_fields,
                                  NULL};
    return run_suite("panorama", tests);
}
