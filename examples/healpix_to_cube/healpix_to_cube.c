/* SPDX-License-Identifier: MIT
 *
 * A HEALPix map, as astronomers keep it in a FITS file, as the six faces of a cube.
 *
 *     cc healpix_to_cube.c $(pkg-config --cflags --libs cubemap-image cubemap cfitsio) -lm -o healpix_to_cube
 *     healpix_to_cube --make sky.fits                     a map to try it with: NSIDE 64, NESTED
 *     healpix_to_cube sky.fits coupled 256 faces.pgm      six faces side by side, black and white the map's ends
 *
 * The first column of the first table is read. UNSEEN pixels weigh nothing where others are beside them, else they are
 * black. Axes and faces are those of the frame geo (cubemap/frame.h), longitude is that of the map.
 */
#include <cubemap/cubemap.h>
#include <cubemap/image.h>

#include <fitsio.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum
{
    MADE_NSIDE = 64
};

/* A map as its file has it. */
typedef struct sky_map
{
    int64_t nside;
    cm_healpix_order order;
    float *value; /* 12 nside^2 */
} sky_map;

static int fail(const char *what, const char *why)
{
    fprintf(stderr, "%s: %s\n", what, why);
    return 1;
}

static int fail_fits(const char *name, int status)
{
    char text[FLEN_STATUS];
    fits_get_errstatus(status, text);
    return fail(name, text);
}

/* ---- Files ---- */

static int read_map(const char *name, sky_map *map)
{
    fitsfile *file;
    int status = 0;
    long nside = 0;
    char ordering[FLEN_VALUE] = "";
    if (fits_open_table(&file, name, READONLY, &status))
    {
        return fail_fits(name, status);
    }
    fits_read_key(file, TLONG, "NSIDE", &nside, NULL, &status);
    fits_read_key(file, TSTRING, "ORDERING", ordering, NULL, &status);
    map->nside = nside;
    map->order = strncmp(ordering, "NEST", 4) == 0 ? CM_HEALPIX_NESTED : CM_HEALPIX_RING;
    char message[200];
    int result = status != 0 ? fail_fits(name, status) : 0;
    if (result == 0 && cm_healpix_check(nside, map->order, message, sizeof message) != CM_OK)
    {
        result = fail(name, message);
    }
    if (result == 0)
    {
        const long count = 12 * nside * nside;
        float none = NAN;
        map->value = malloc((size_t)count * sizeof *map->value);
        fits_read_col(file, TFLOAT, 1, 1, 1, count, &none, map->value, NULL, &status);
        result = map->value == NULL ? fail(name, "no memory")
                 : status != 0      ? fail_fits(name, status)
                                    : 0;
    }
    status = 0;
    fits_close_file(file, &status);
    return result;
}

/* Something to look at: a wave around a tilted pole, a warm spot, and a hole. */
static float made_value(const double d[3])
{
    const double along = 0.6 * d[0] + 0.8 * d[2];
    const double spot = d[0] * 0.36 + d[1] * 0.8 + d[2] * 0.48;
    return spot < -0.995 ? (float)CM_HEALPIX_UNSEEN
                         : (float)(cos(9.0 * along) + 2.0 * exp(40.0 * (spot - 1.0)));
}

static int make_map(const char *name)
{
    enum
    {
        COUNT = 12 * MADE_NSIDE * MADE_NSIDE
    };
    static float value[COUNT];
    cm_healpix *healpix;
    if (cm_healpix_create(MADE_NSIDE, CM_HEALPIX_NESTED, NULL, &healpix) != CM_OK)
    {
        return fail(name, "no memory");
    }
    for (int64_t i = 0; i < COUNT; i++)
    {
        double direction[3];
        cm_healpix_direction_from_pixel(healpix, i, direction);
        value[i] = made_value(direction);
    }
    cm_healpix_destroy(healpix);

    fitsfile *file;
    int status = 0;
    long nside = MADE_NSIDE;
    char *names[] = {"SIGNAL"};
    char *forms[] = {"1E"};
    char *units[] = {"K"};
    remove(name);
    if (fits_create_file(&file, name, &status))
    {
        return fail_fits(name, status);
    }
    fits_create_tbl(file, BINARY_TBL, COUNT, 1, names, forms, units, "MAP", &status);
    fits_write_key(file, TSTRING, "PIXTYPE", "HEALPIX", NULL, &status);
    fits_write_key(file, TSTRING, "ORDERING", "NESTED", NULL, &status);
    fits_write_key(file, TLONG, "NSIDE", &nside, NULL, &status);
    fits_write_col(file, TFLOAT, 1, 1, 1, COUNT, value, &status);
    int closing = 0;
    fits_close_file(file, &closing);
    return status != 0 || closing != 0 ? fail_fits(name, status != 0 ? status : closing) : 0;
}

/* The six faces side by side, 16 bits, from the least value of the map to the greatest. */
static int write_faces(const char *name, const float *value, uint32_t size, float low, float high)
{
    FILE *file = fopen(name, "wb");
    if (file == NULL)
    {
        return fail(name, "cannot be written");
    }
    fprintf(file, "P5\n# %.9g is 0, %.9g is 65535\n%u %u\n65535\n", (double)low, (double)high,
            6 * size, size);
    for (size_t i = 0; i < (size_t)6 * size * size; i++)
    {
        /* row by row through all faces; the first row of a face's picture is at the top */
        const size_t row = i / (6 * size);
        const size_t face = i / size % 6;
        const float light = (value[(face * size + row) * size + i % size] - low) / (high - low);
        const unsigned stored =
            light >= 0.0f ? (unsigned)(fminf(light, 1.0f) * 65535.0f + 0.5f) : 0;
        const unsigned char bytes[2] = {(unsigned char)(stored >> 8),
                                        (unsigned char)(stored & 255)};
        fwrite(bytes, 1, sizeof bytes, file);
    }
    const int is_bad = ferror(file);
    return fclose(file) != 0 || is_bad ? fail(name, "cannot be written") : 0;
}

/* ---- From the one to the other ---- */

static cm_image picture(float *data, uint32_t width, uint32_t height)
{
    return (cm_image){.size = sizeof(cm_image),
                      .data = data,
                      .type = CM_PIXEL_FLOAT,
                      .width = width,
                      .height = height,
                      .channels = 1};
}

/* faces: six of size x size, one behind the other. */
static cm_status resample(const sky_map *map, const char *specification, uint32_t size,
                          float *faces)
{
    const uint32_t nside = (uint32_t)map->nside;
    const size_t count = 12 * (size_t)nside * nside;
    float *squares = malloc(count * sizeof *squares);
    cm_surface *from = NULL;
    cm_surface *to = NULL;
    cm_plan *plan = NULL;
    char of_cube[128];
    snprintf(of_cube, sizeof of_cube, "cube:%s", specification);
    const cm_surface_options from_size = {
        .size = sizeof from_size, .width = 12 * nside, .height = nside};
    const cm_surface_options to_size = {.size = sizeof to_size, .width = size, .height = size};
    const cm_plan_options options = {
        .size = sizeof options, .filter = CM_FILTER_CATMULL_ROM, .not_finite = CM_NOT_FINITE_SKIP};
    cm_status status =
        squares == NULL ? CM_ERROR_MEMORY : cm_surface_create("healpix", &from_size, &from);
    if (status == CM_OK)
    {
        for (size_t i = 0; i < count; i++)
        {
            if (fabsf(map->value[i] / (float)CM_HEALPIX_UNSEEN - 1.0f) < 1e-5f)
            {
                map->value[i] = NAN;
            }
        }
        status =
            cm_healpix_arrange(map->nside, map->order, 0, sizeof *squares, map->value, squares);
    }
    status = status == CM_OK ? cm_surface_create(of_cube, &to_size, &to) : status;
    status = status == CM_OK ? cm_plan_create(from, to, &options, &plan) : status;
    if (status == CM_OK)
    {
        const cm_image source = picture(squares, 12 * nside, nside);
        cm_image target[6];
        for (size_t i = 0; i < 6; i++)
        {
            target[i] = picture(faces + i * size * size, size, size);
        }
        status = cm_resample(plan, &source, target, (cm_rows){0});
    }
    cm_plan_destroy(plan);
    cm_surface_destroy(to);
    cm_surface_destroy(from);
    free(squares);
    return status;
}

int main(int argc, char **argv)
{
    if (argc == 3 && strcmp(argv[1], "--make") == 0)
    {
        return make_map(argv[2]);
    }
    const long size = argc == 5 ? strtol(argv[3], NULL, 10) : 0;
    if (size < 1 || size > 16384)
    {
        fprintf(
            stderr,
            "usage: %s MAP.fits MAPPING SIZE FACES.pgm, or --make MAP.fits; SIZE is 1 to 16384\n",
            argv[0]);
        return 2;
    }
    sky_map map = {0};
    float *faces = malloc((size_t)(6 * size * size) * sizeof *faces);
    int result = faces == NULL ? fail(argv[4], "no memory") : read_map(argv[1], &map);
    cm_status status = result == 0 ? resample(&map, argv[2], (uint32_t)size, faces) : CM_OK;
    if (status != CM_OK)
    {
        result = fail(argv[2], cm_status_text(status));
    }
    if (result == 0)
    {
        float low = INFINITY;
        float high = -INFINITY;
        for (int64_t i = 0; i < 12 * map.nside * map.nside; i++)
        {
            low = map.value[i] < low ? map.value[i] : low;
            high = map.value[i] > high ? map.value[i] : high;
        }
        result = write_faces(argv[4], faces, (uint32_t)size, low, high);
    }
    free(faces);
    free(map.value);
    return result;
}
