/* SPDX-License-Identifier: MIT
 *
 * Tiles of HiPS: each pixel of a tile, asked by its direction, is the HEALPix pixel that section 4.1 of HiPS 1.0 puts there;
 * names, preview, properties, FITS.
 */
#include "modules/image/io/hips.h"

#include "tests/memory_stream.h"
#include "tests/suite.h"

enum
{
    WIDTH = 4,
    ORDER = 2, /* of tiles; planes have 16 pixels along an edge */
    EDGE = WIDTH << ORDER
};

static char message[CM_IMAGE_MESSAGE];

/* The nested number of a pixel of a plane of the surface, by its direction. */
static int64_t pixel_at(const cm_surface *surface, const cm_healpix *healpix, uint8_t plane,
                        uint32_t column, uint32_t row)
{
    const double c = column + 0.5;
    const double r = row + 0.5;
    double direction[3];
    int64_t pixel = -1;
    cm_surface_directions(surface, 1, &plane, &c, &r, &direction[0], &direction[1], &direction[2]);
    ck_assert_int_eq(cm_healpix_pixel_from_direction(healpix, direction, &pixel), CM_OK);
    return pixel;
}

/* Going down in PNG is x, going right y: the number's even and odd bits. */
static int64_t wanted_at(uint64_t tile, uint32_t column, uint32_t row)
{
    int64_t inside = 0;
    for (unsigned bit = 0; bit < 2; bit++)
    {
        inside |= (int64_t)(row >> bit & 1) << 2 * bit | (int64_t)(column >> bit & 1)
                                                             << (2 * bit + 1);
    }
    return (int64_t)tile * WIDTH * WIDTH + inside;
}

START_TEST(test_orientation)
{
    cm_surface *surface = NULL;
    cm_healpix *healpix = NULL;
    const cm_surface_options options = {.size = sizeof options, .width = 12 * EDGE, .height = EDGE};
    ck_assert_int_eq(cm_surface_create("healpix", &options, &surface), CM_OK);
    ck_assert_int_eq(cm_healpix_create(EDGE, CM_HEALPIX_NESTED, NULL, &healpix), CM_OK);
    static float plane[EDGE * EDGE];
    for (uint64_t number = 0; number < 12 << 2 * ORDER; number++)
    {
        cm_hips_window place;
        ck_assert_int_eq(cm_hips_place(ORDER, number, WIDTH, &place), CM_OK);
        ck_assert_uint_eq(place.planes, EDGE);
        for (uint32_t i = 0; i < EDGE * EDGE; i++)
        {
            plane[i] = (float)pixel_at(surface, healpix, (uint8_t)place.plane, i % EDGE, i / EDGE);
        }
        const cm_image window = {.size = sizeof window,
                                 .data = plane + place.row * EDGE + place.column,
                                 .type = CM_PIXEL_FLOAT,
                                 .width = WIDTH,
                                 .height = WIDTH,
                                 .channels = 1,
                                 .row_stride = EDGE * (ptrdiff_t)sizeof(float)};
        cm_image tile;
        ck_assert_int_eq(cm_hips_tile(&window, &tile), CM_OK);
        for (uint32_t i = 0; i < WIDTH * WIDTH; i++)
        {
            float value;
            memcpy(&value,
                   (char *)tile.data + tile.row_stride * (ptrdiff_t)(i / WIDTH) +
                       tile.pixel_stride * (ptrdiff_t)(i % WIDTH),
                   sizeof value);
            REQUIRE((int64_t)value == wanted_at(number, i % WIDTH, i / WIDTH), "tile %u, pixel %u",
                    (unsigned)number, i);
        }
    }
    cm_surface_destroy(surface);
    cm_healpix_destroy(healpix);
}
END_TEST

START_TEST(test_names)
{
    char path[CM_HIPS_PATH];
    uint32_t columns;
    uint32_t rows;
    cm_hips_window place;
    ck_assert_int_eq(cm_hips_tile_path(7, 10302, "png", path), CM_OK);
    ck_assert_str_eq(path, "Norder7/Dir10000/Npix10302.png");
    ck_assert_int_eq(cm_hips_tile_path(3, 768, "png", path), CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_hips_tile_path(3, 7, "gif", path), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_hips_preview_path(3, "jpg", path), CM_OK);
    ck_assert_str_eq(path, "Norder3/Allsky.jpg");
    ck_assert_int_eq(cm_hips_preview(3, &columns, &rows), CM_OK);
    REQUIRE(columns == 27 && rows == 29, "%u x %u", columns, rows); /* section 4.3.2 */
    ck_assert_int_eq(cm_hips_place(30, 0, 1, &place), CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_hips_place(29, 0, 512, &place), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_hips_place(3, 0, 500, &place), CM_ERROR_ARGUMENT);
}
END_TEST

START_TEST(test_properties)
{
    cm_hips_properties p = {.size = sizeof p,
                            .creator_did = "ivo://example/earth",
                            .title = "Earth",
                            .frame = "equatorial",
                            .tile_format = "png",
                            .release = "2026-01-01T00:00Z",
                            .order = 3,
                            .tile_width = 512};
    char text[1000];
    size_t length = 0;
    ck_assert_int_eq(cm_hips_write_properties(&p, 0, NULL, &length), CM_ERROR_SPACE);
    const size_t needed = length;
    ck_assert_int_eq(cm_hips_write_properties(&p, needed, text, &length), CM_ERROR_SPACE);
    ck_assert_int_eq(cm_hips_write_properties(&p, needed + 1, text, &length), CM_OK);
    ck_assert_uint_eq(strlen(text), needed);
    REQUIRE(strstr(text, "\nhips_order           = 3\n") != NULL &&
                strstr(text, "\nhips_tile_width      = 512\n") != NULL &&
                strstr(text, "\nhips_frame           = equatorial\n") != NULL,
            "%s", text);
    p.title = "two\nlines";
    ck_assert_int_eq(cm_hips_write_properties(&p, sizeof text, text, &length), CM_ERROR_ARGUMENT);
    p.title = NULL;
    ck_assert_int_eq(cm_hips_write_properties(&p, sizeof text, text, &length), CM_ERROR_ARGUMENT);
}
END_TEST

/* FITS 4.0, sections 3.3 and 5.2: rows from the lowest, the high byte first, unsigned by BZERO. */
START_TEST(test_fits)
{
    static unsigned char file[3 * 2880];
    uint16_t numbers[4] = {0, 1, 0x8000, 0xffff};
    const cm_image tile = {.size = sizeof tile,
                           .data = numbers,
                           .type = CM_PIXEL_U16,
                           .width = 2,
                           .height = 2,
                           .channels = 1};
    memory_stream memory = {file, 0, sizeof file, 0};
    const cm_image_stream stream = stream_of(&memory);
    ck_assert_int_eq(cm_hips_write_fits(&stream, 3, 5, &tile, message), CM_OK);
    ck_assert_uint_eq(memory.size, 2 * 2880);
    REQUIRE(memcmp(file, "SIMPLE  =                    T ", 31) == 0, "first card");
    REQUIRE(memcmp(file + 80, "BITPIX  =                   16 ", 31) == 0, "second card");
    REQUIRE(memcmp(file + 9 * 80, "END     ", 8) == 0, "last card");
    REQUIRE(memcmp(file + 2880, "\0\0\x7f\xff\x80\0\x80\x01\0", 9) == 0, "samples");
    memory = (memory_stream){file, 0, 3000, 0};
    ck_assert_int_eq(cm_hips_write_fits(&stream, 3, 5, &tile, message), CM_ERROR_UNSUPPORTED);
    ck_assert_int_eq(cm_hips_write_fits(&stream, 0, 12, &tile, message), CM_ERROR_PIXEL);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {test_orientation, test_names, test_properties, test_fits, NULL};
    return run_suite("hips", tests);
}
