/* SPDX-License-Identifier: MIT
 *
 * Maps of HEALPix in FITS: those that chealpix writes are read, it reads what is written, both in both orders; parts,
 * pixels without a value, columns, and files that are damaged.
 */
#define _XOPEN_SOURCE 700

#include "modules/image/io/image_io.h"

#include <cubemap/healpix.h>

#include "tests/suite.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <chealpix.h>
#include <fitsio.h>
#include <unistd.h>

enum
{
    NSIDE = 16,
    PIXELS = 12 * NSIDE * NSIDE
};

static char message[CM_IMAGE_MESSAGE];
static const cm_image_io *io;
static float list[PIXELS];
static float pictured[2 * PIXELS];

/* The direction of a pixel's middle, as chealpix has it, as a number that tells it from all others. */
static float mark_of(long nside, int nested, long pixel)
{
    double at[3];
    if (nested)
    {
        pix2vec_nest(nside, pixel, at);
    }
    else
    {
        pix2vec_ring(nside, pixel, at);
    }
    return (float)(at[0] + 2.0 * at[1] + 3.0 * at[2]);
}

/* What the surface has in its picture there. */
static float mark_at(const cm_surface *surface, uint32_t plane, uint32_t column, uint32_t row)
{
    const uint8_t planes[1] = {(uint8_t)plane};
    const double columns[1] = {column + 0.5};
    const double rows[1] = {row + 0.5};
    double x;
    double y;
    double z;
    cm_surface_directions(surface, 1, planes, columns, rows, &x, &y, &z);
    return (float)(x + 2.0 * y + 3.0 * z);
}

static void expect_marks(const float *picture, uint32_t channels, float factor)
{
    cm_surface *surface = NULL;
    ck_assert_int_eq(cm_surface_create("healpix:16", NULL, &surface), CM_OK);
    for (uint32_t plane = 0; plane < 12; plane++)
    {
        for (uint32_t i = 0; i < NSIDE * NSIDE; i++)
        {
            const uint32_t column = i % NSIDE;
            const uint32_t row = i / NSIDE;
            const float wanted = factor * mark_at(surface, plane, column, row);
            const float found = picture[(row * 12 * NSIDE + plane * NSIDE + column) * channels];
            REQUIRE(fabsf(found - wanted) < 1e-5f, "plane %u, %u, %u: %g, not %g", plane, column,
                    row, (double)found, (double)wanted);
        }
    }
    cm_surface_destroy(surface);
}

static cm_image_reader *open_file(const char *name)
{
    cm_image_reader *reader = NULL;
    REQUIRE(io->open(name, 0, &reader, message) == CM_OK, "%s %s", name, message);
    return reader;
}

static void read_file(const char *name, uint32_t channels, float *to)
{
    cm_image_reader *reader = open_file(name);
    const cm_image_description *of = io->describe(reader);
    REQUIRE(strcmp(of->format, "fits") == 0 && of->width == 12 * NSIDE && of->height == NSIDE &&
                of->channels == channels && !of->whole_numbers,
            "%s: %u x %u, %u channels", of->format, of->width, of->height, of->channels);
    REQUIRE(of->tag_count > 0 && strcmp(of->tags[0].text, "healpix:16") == 0, "no surface");
    const cm_image_region whole = {0, 0, 12 * NSIDE, NSIDE};
    REQUIRE(io->read(reader, &whole, CM_PIXEL_FLOAT, to, 0, message) == CM_OK, "%s", message);
    io->close(reader);
}

START_TEST(test_reads_chealpix)
{
    for (int nested = 0; nested < 2; nested++)
    {
        for (long i = 0; i < PIXELS; i++)
        {
            list[i] = mark_of(NSIDE, nested, i);
        }
        remove("map.fits");
        write_healpix_map(list, NSIDE, "map.fits", (char)nested, "G");
        read_file("map.fits", 1, pictured);
        expect_marks(pictured, 1, 1.0f);
        cm_image_reader *reader = open_file("map.fits");
        const cm_image_description *of = io->describe(reader);
        REQUIRE(of->tag_count == 2 && strcmp(of->tags[1].key, "COORDSYS") == 0 &&
                    of->tags[1].text[0] == 'G',
                "axes");
        float part[6];
        const cm_image_region region = {5, 3, 8, 5};
        ck_assert_int_eq(io->read(reader, &region, CM_PIXEL_FLOAT, part, 0, message), CM_OK);
        for (int i = 0; i < 6; i++)
        {
            ck_assert(part[i] == pictured[(3 + i / 3) * 12 * NSIDE + 5 + i % 3]);
        }
        io->close(reader);
    }
}
END_TEST

typedef struct disk
{
    FILE *file;
} disk;

static size_t write_disk(void *context, const void *bytes, size_t count)
{
    return fwrite(bytes, 1, count, ((disk *)context)->file);
}

static void seek_disk(void *context, int64_t position)
{
    fseek(((disk *)context)->file, (long)position, SEEK_SET);
}

static void write_file(const char *name, cm_image_description *description, const float *pixels)
{
    disk to = {fopen(name, "wb")};
    const cm_image_stream stream = {&to, NULL, write_disk, seek_disk, NULL};
    cm_image_writer *writer = NULL;
    ck_assert_ptr_nonnull(to.file);
    REQUIRE(io->create(name, &stream, description, &writer, message) == CM_OK, "%s", message);
    const ptrdiff_t row = (ptrdiff_t)(description->width * description->channels);
    for (uint32_t i = 0; i < description->height; i += 5)
    {
        const uint32_t end = i + 5 < description->height ? i + 5 : description->height;
        REQUIRE(io->write(writer, i, end, CM_PIXEL_FLOAT, pixels + row * i, 0, 0, message) == CM_OK,
                "%s", message);
    }
    REQUIRE(io->finish(writer, message) == CM_OK, "%s", message);
    io->drop(writer);
    fclose(to.file);
}

static cm_image_description description_of(uint32_t nside, uint32_t channels,
                                           const cm_image_tag *tags, size_t count)
{
    const cm_image_description description = {.format = "fits",
                                              .width = 12 * nside,
                                              .height = nside,
                                              .channels = channels,
                                              .type = CM_PIXEL_FLOAT,
                                              .alpha = -1,
                                              .tags = tags,
                                              .tag_count = count};
    return description;
}

/* Nside that is no power of two, too, which RING may have, and for which rows of the table have one pixel. */
START_TEST(test_chealpix_reads)
{
    static const struct
    {
        uint32_t nside;
        const char *order;
    } cases[] = {{NSIDE, "RING"}, {NSIDE, "NESTED"}, {15, "RING"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
    {
        const uint32_t nside = cases[k].nside;
        char specification[40];
        cm_surface *surface = NULL;
        snprintf(specification, sizeof specification, "healpix:%u", nside);
        ck_assert_int_eq(cm_surface_create(specification, NULL, &surface), CM_OK);
        for (uint32_t i = 0; i < 12 * nside * nside; i++)
        {
            const uint32_t column = i % (12 * nside);
            pictured[i] = mark_at(surface, column / nside, column % nside, i / (12 * nside));
        }
        pictured[7] = NAN;
        cm_surface_destroy(surface);
        const cm_image_tag tags[] = {{"ORDERING", cases[k].order, NULL, NULL, 0},
                                     {"COORDSYS", "C", NULL, NULL, 0}};
        cm_image_description description = description_of(nside, 1, tags, 2);
        write_file("ours.fits", &description, pictured);
        long found = 0;
        char axes[80] = "";
        char order[80] = "";
        float *map = read_healpix_map("ours.fits", &found, axes, order);
        REQUIRE(map != NULL && found == (long)nside && axes[0] == 'C' &&
                    order[0] == *cases[k].order,
                "nside %ld, %s, %s", found, axes, order);
        unsigned unseen = 0;
        for (long i = 0; i < 12 * found * found; i++)
        {
            const float wanted = mark_of(found, order[0] == 'N', i);
            const int none = map[i] < -1.6e30f && map[i] > -1.64e30f;
            REQUIRE(none || fabsf(map[i] - wanted) < 1e-5f, "pixel %ld: %g, not %g", i,
                    (double)map[i], (double)wanted);
            unseen += (unsigned)none;
        }
        ck_assert_uint_eq(unseen, 1);
        free(map);
    }
}
END_TEST

/* A part with numbers of its pixels, in the nested order; one column of doubles, one of floats; one pixel has no value. */
static void write_part(const char *name, LONGLONG wrong)
{
    char *types[] = {"PIXEL", "I_STOKES", "Q_STOKES"};
    char *forms[] = {"1J", "1D", "1E"};
    LONGLONG numbers[100];
    double first[100];
    float second[100];
    for (int i = 0; i < 100; i++)
    {
        numbers[i] = 3 * i + 1;
        first[i] = mark_of(NSIDE, 1, 3 * i + 1);
        second[i] = i == 4 ? -1.63750e30f : (float)i;
    }
    numbers[50] += wrong;
    fitsfile *file = NULL;
    int status = 0;
    remove(name);
    fits_create_diskfile(&file, name, &status);
    fits_create_tbl(file, BINARY_TBL, 100, 3, types, forms, NULL, "xtension", &status);
    fits_write_key_str(file, "PIXTYPE", "HEALPIX", NULL, &status);
    fits_write_key_str(file, "ORDERING", "NESTED", NULL, &status);
    fits_write_key_lng(file, "NSIDE", NSIDE, NULL, &status);
    fits_write_key_str(file, "INDXSCHM", "EXPLICIT", NULL, &status);
    fits_write_col(file, TLONGLONG, 1, 1, 1, 100, numbers, &status);
    fits_write_col(file, TDOUBLE, 2, 1, 1, 100, first, &status);
    fits_write_col(file, TFLOAT, 3, 1, 1, 100, second, &status);
    fits_close_file(file, &status);
    ck_assert_int_eq(status, 0);
}

START_TEST(test_parts)
{
    write_part("part.fits", 0);
    read_file("part.fits", 2, pictured);
    cm_image_reader *reader = open_file("part.fits");
    REQUIRE(strcmp(io->describe(reader)->channel_names[1], "Q_STOKES") == 0 &&
                strcmp(io->describe(reader)->stored_type, "double") == 0,
            "names and types");
    io->close(reader);
    unsigned there = 0;
    unsigned second = 0;
    for (int i = 0; i < PIXELS; i++)
    {
        const int is_there = !isnan(pictured[2 * i]);
        there += (unsigned)is_there;
        second += (unsigned)!isnan(pictured[2 * i + 1]);
        /* base pixel 0 has the numbers below 256 */
        ck_assert(!is_there || i % (12 * NSIDE) < 2 * NSIDE);
    }
    ck_assert_uint_eq(there, 100);
    ck_assert_uint_eq(second, 99);
    static float back[2 * PIXELS];
    ck_assert_int_eq(
        cm_healpix_arrange(NSIDE, CM_HEALPIX_NESTED, 1, 2 * sizeof(float), pictured, back), CM_OK);
    for (int i = 0; i < 100; i++)
    {
        const int pixel = 3 * i + 1;
        REQUIRE(fabsf(back[2 * pixel] - mark_of(NSIDE, 1, pixel)) < 1e-6f &&
                    (i == 4 ? isnan(back[2 * pixel + 1]) : back[2 * pixel + 1] == (float)i),
                "pixel %d", pixel);
    }
    write_part("wrong.fits", 1000000);
    ck_assert_int_eq(io->open("wrong.fits", 0, &reader, message), CM_OK);
    const cm_image_region whole = {0, 0, 12 * NSIDE, NSIDE};
    REQUIRE(io->read(reader, &whole, CM_PIXEL_FLOAT, pictured, 0, message) ==
                    CM_ERROR_UNSUPPORTED &&
                strstr(message, "has no pixel 1000151") != NULL,
            "%s", message);
    io->close(reader);
}
END_TEST

static void set_key(const char *name, const char *key, const char *text, long number)
{
    fitsfile *file = NULL;
    int status = 0;
    int type = 0;
    fits_open_diskfile(&file, name, READWRITE, &status);
    fits_movabs_hdu(file, 2, &type, &status);
    if (text != NULL)
    {
        fits_update_key_str(file, key, text, NULL, &status);
    }
    else
    {
        fits_update_key_lng(file, key, number, NULL, &status);
    }
    fits_close_file(file, &status);
    ck_assert_int_eq(status, 0);
}

static void expect_refused(const char *name, const char *words)
{
    cm_image_reader *reader = NULL;
    message[0] = '\0';
    REQUIRE(io->open(name, 0, &reader, message) == CM_ERROR_UNSUPPORTED &&
                strstr(message, words) != NULL,
            "%s: %s", words, message);
}

START_TEST(test_damaged)
{
    for (long i = 0; i < PIXELS; i++)
    {
        list[i] = (float)i;
    }
    static const struct
    {
        const char *key;
        const char *text;
        long number;
        const char *words;
    } wrong[] = {{"ORDERING", "SPIRAL", 0, "neither RING nor NESTED"},
                 {"NSIDE", NULL, 8, "another number of them"},
                 {"NSIDE", NULL, 0, "NSIDE 0"},
                 {"NSIDE", NULL, 2000000000, "no picture"},
                 {"FIRSTPIX", NULL, 5, "another number of them"},
                 {"INDXSCHM", "EXPLICIT", 0, "without columns"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
    {
        remove("map.fits");
        write_healpix_map(list, NSIDE, "map.fits", 0, "G");
        set_key("map.fits", wrong[i].key, wrong[i].text, wrong[i].number);
        expect_refused("map.fits", wrong[i].words);
    }
    remove("map.fits");
    write_healpix_map(list, NSIDE, "map.fits", 0, "G");
    ck_assert_int_eq(truncate("map.fits", 8000), 0);
    cm_image_reader *reader = NULL;
    const cm_image_region whole = {0, 0, 12 * NSIDE, NSIDE};
    cm_status status = io->open("map.fits", 0, &reader, message);
    if (status == CM_OK)
    {
        status = io->read(reader, &whole, CM_PIXEL_FLOAT, pictured, 0, message);
        io->close(reader);
    }
    REQUIRE(status == CM_ERROR_UNSUPPORTED && strlen(message) > 5, "%d %s", (int)status, message);
}
END_TEST

START_TEST(test_writer_refuses)
{
    cm_image_writer *writer = NULL;
    disk to = {NULL};
    const cm_image_stream stream = {&to, NULL, write_disk, seek_disk, NULL};
    const cm_image_tag nested = {"ORDERING", "NESTED", NULL, NULL, 0};
    cm_image_description description = description_of(15, 1, &nested, 1);
    REQUIRE(io->create("a", &stream, &description, &writer, message) == CM_ERROR_ARGUMENT &&
                strstr(message, "power of two") != NULL,
            "%s", message);
    REQUIRE(io->create("a", NULL, &description, &writer, message) == CM_ERROR_ARGUMENT,
            "no stream");
    description.width = 100;
    REQUIRE(io->create("a", &stream, &description, &writer, message) == CM_ERROR_ARGUMENT &&
                strstr(message, "12 NSIDE x NSIDE") != NULL,
            "%s", message);
    description = description_of(2, 1, NULL, 0);
    ck_assert_int_eq(io->create("a", &stream, &description, &writer, message), CM_OK);
    ck_assert_int_eq(io->write(writer, 1, 2, CM_PIXEL_FLOAT, list, 0, 0, message),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(io->finish(writer, message), CM_ERROR_ARGUMENT);
    io->drop(writer);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {test_reads_chealpix, test_chealpix_reads, test_parts,
                                  test_damaged,        test_writer_refuses, NULL};
    char folder[] = "/tmp/cubemap-healpix-XXXXXX";
    io = cm_image_io_get(message);
    if (io == NULL || mkdtemp(folder) == NULL || chdir(folder) != 0)
    {
        fprintf(stderr, "no folder, or %s\n", message);
        return EXIT_FAILURE;
    }
    const int status = run_suite("HEALPix files", tests);
    remove("map.fits");
    remove("ours.fits");
    remove("part.fits");
    remove("wrong.fits");
    return chdir("/") == 0 && rmdir(folder) == 0 ? status : EXIT_FAILURE;
}
