/* SPDX-License-Identifier: MIT
 *
 * image_gdal.h by the functions in C of GDAL 3: its core, its warper, its programs as functions and its reference systems.
 */
#define _POSIX_C_SOURCE 200809L

#include "gdal_stages.h"
#include "image_gdal.h"
#include "image_io_entry.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum
{
    WGS84 = 4326,
    WEB_MERCATOR = 3857,
    KEY_COUNT = 16
};

/* Of datasets, each made from the one before it. */
#define STAGE_COUNT 5

/* What stands behind cm_image_reader. */
typedef struct raster
{
    GDALDatasetH stages
        [STAGE_COUNT]; /* the file, its colours, with alpha, warped, cut; NULL behind the last */
    GDALDatasetH last;
    GDALDataType type;
    cm_image_description description;
    cm_image_geo_tags geo_tags;
    double scale[3];
    double tie_points[6];
    uint16_t keys[KEY_COUNT];
    const char *channel_names[CM_CHANNELS_MAX];
    char numbers[CM_CHANNELS_MAX][12];
} raster;

static pthread_once_t registered = PTHREAD_ONCE_INIT;

/* From then on libtiff, which OpenImageIO has too, tells GDAL of its errors, which must not print them. */
static void register_drivers(void)
{
    CPLSetErrorHandler(CPLQuietErrorHandler);
    GDALAllRegister();
}

static cm_status fail(char *message, const char *what)
{
    const char *const reason = CPLGetLastErrorMsg();
    snprintf(message, CM_IMAGE_MESSAGE, "%s%s%.400s", what, *reason != '\0' ? ": " : "", reason);
    for (char *letter = message; *letter != '\0'; letter++)
    {
        const unsigned char byte = (unsigned char)*letter;
        *letter = byte < 0x20 || byte == 0x7f ? '?' : *letter;
    }
    return CM_ERROR_UNSUPPORTED;
}

/* One more, or what could not be done. */
static cm_status add_stage(raster *r, GDALDatasetH stage, const char *complaint, char *message)
{
    if (stage == NULL)
    {
        return fail(message, complaint);
    }
    size_t i = 0;
    while (r->stages[i] != NULL)
    {
        i++;
    }
    r->stages[i] = stage;
    r->last = stage;
    return CM_OK;
}

static void close_raster(raster *r)
{
    for (size_t i = STAGE_COUNT; i-- > 0;)
    {
        if (r->stages[i] != NULL)
        {
            GDALClose(r->stages[i]);
        }
    }
    free(r);
}

/* ---- colours ---- */

/* Indices are nothing that can be mixed. */
static cm_status expand_palette(raster *r, char *message)
{
    if (GDALGetRasterCount(r->last) != 1 ||
        GDALGetRasterColorTable(GDALGetRasterBand(r->last, 1)) == NULL)
    {
        return CM_OK;
    }
    return add_stage(r, cm_gdal_expanded(r->last), "has a palette that cannot be read", message);
}

/* Whole numbers are not NaN where there is none. */
static cm_status show_missing(raster *r, char *message)
{
    return cm_gdal_lacks_alpha(r->last) ? add_stage(r, cm_gdal_with_alpha(r->last),
                                                    "has a mask that cannot be read", message)
                                        : CM_OK;
}

/* ---- where it is ---- */

static bool has_code(OGRSpatialReferenceH system, int code)
{
    const char *const authority = OSRGetAuthorityName(system, NULL);
    const char *const number = OSRGetAuthorityCode(system, NULL);
    return authority != NULL && number != NULL && strcmp(authority, "EPSG") == 0 &&
           atoi(number) == code;
}

/* Longitudes and latitudes of another body are those of a sphere: there is nothing to turn them into. */
static bool is_of_another_body(OGRSpatialReferenceH system)
{
    const double earth = 6378137;
    OGRErr error = OGRERR_NONE;
    const double axis = OSRGetSemiMajor(system, &error);
    return error == OGRERR_NONE && OSRIsGeographic(system) && fabs(axis / earth - 1) > 0.01;
}

/* Not more than once around the Earth. */
static cm_status cut(raster *r, cm_gdal_extent most, char *message)
{
    return cm_gdal_goes_beyond(r->last, most)
               ? add_stage(r, cm_gdal_cut(r->last, most), "cannot be cut to the whole sphere",
                           message)
               : CM_OK;
}

static cm_status warp(raster *r, char *message)
{
    return add_stage(r, cm_gdal_warped(r->last), "cannot be warped to EPSG:4326", message);
}

/* As GeoTIFF has it; without keys where code is 0. */
static void note_place(raster *r, int code)
{
    double transform[6];
    if (GDALGetGeoTransform(r->last, transform) != CE_None)
    {
        return;
    }
    const bool degrees = code == WGS84;
    const uint16_t keys[KEY_COUNT] = {1,
                                      1,
                                      0,
                                      3,
                                      1024,
                                      0,
                                      1,
                                      degrees ? 2 : 1,
                                      1025,
                                      0,
                                      1,
                                      1,
                                      degrees ? 2048 : 3072,
                                      0,
                                      1,
                                      (uint16_t)code};
    memcpy(r->keys, keys, sizeof keys);
    r->scale[0] = transform[1];
    r->scale[1] = -transform[5];
    r->tie_points[3] = transform[0];
    r->tie_points[4] = transform[3];
    r->geo_tags = (cm_image_geo_tags){.scale = r->scale,
                                      .scale_count = 3,
                                      .tie_points = r->tie_points,
                                      .tie_point_count = 6,
                                      .keys = r->keys,
                                      .key_count = code != 0 ? KEY_COUNT : 0};
    r->description.geo_tags = &r->geo_tags;
}

static cm_status find_place(raster *r, char *message)
{
    double transform[6];
    const OGRSpatialReferenceH system = GDALGetSpatialRef(r->last);
    const bool has_system = system != NULL && *GDALGetProjectionRef(r->last) != '\0';
    const bool has_transform = GDALGetGeoTransform(r->last, transform) == CE_None;
    const bool placed = has_system && has_transform;
    const bool upright = has_transform && cm_gdal_is_upright(transform);
    if (!placed && GDALGetGCPCount(r->last) == 0)
    {
        if (upright)
        {
            note_place(r, 0); /* numbers in nobody knows what */
        }
        return CM_OK;
    }
    const bool in_degrees =
        placed && upright && (has_code(system, WGS84) || is_of_another_body(system));
    const bool in_metres = placed && upright && has_code(system, WEB_MERCATOR);
    cm_status status = in_degrees || in_metres ? CM_OK : warp(r, message);
    if (status == CM_OK)
    {
        status = cut(r, in_metres ? cm_gdal_web_metres : cm_gdal_degrees, message);
    }
    if (status == CM_OK)
    {
        note_place(r, in_metres ? WEB_MERCATOR : WGS84);
    }
    return status;
}

/* ---- what it is ---- */

static void name_channels(raster *r)
{
    static const char *const colors[] = {"R", "G", "B", "A"};
    static const char *const grays[] = {"Y", "A"};
    const uint32_t channels = r->description.channels;
    for (uint32_t i = 0; i < channels; i++)
    {
        snprintf(r->numbers[i], sizeof r->numbers[i], "%u", (unsigned)i + 1);
        r->channel_names[i] = channels > 4 ? r->numbers[i] : channels > 2 ? colors[i] : grays[i];
    }
    r->description.channel_names = r->channel_names;
}

static cm_status describe_raster(raster *r, char *message)
{
    cm_image_description *const is = &r->description;
    const int channels = GDALGetRasterCount(r->last);
    if (channels < 1 || channels > CM_CHANNELS_MAX)
    {
        CPLErrorReset();
        char text[100];
        snprintf(text, sizeof text, "has %d channels, not 1 to %d", channels, CM_CHANNELS_MAX);
        return fail(message, text);
    }
    r->type = GDALGetRasterDataType(GDALGetRasterBand(r->last, 1));
    if (r->type != GDT_Byte && r->type != GDT_UInt16)
    {
        r->type = GDT_Float32;
    }
    is->format = "gdal";
    is->width = is->window_width = (uint32_t)GDALGetRasterXSize(r->last);
    is->height = is->window_height = (uint32_t)GDALGetRasterYSize(r->last);
    is->channels = (uint32_t)channels;
    is->whole_numbers = r->type != GDT_Float32;
    is->type = r->type == GDT_Byte     ? CM_PIXEL_U8
               : r->type == GDT_UInt16 ? CM_PIXEL_U16
                                       : CM_PIXEL_FLOAT;
    is->stored_type = r->type == GDT_Byte ? "uint8" : r->type == GDT_UInt16 ? "uint16" : "float";
    const GDALRasterBandH top = GDALGetRasterBand(r->last, channels);
    is->alpha = GDALGetRasterColorInterpretation(top) == GCI_AlphaBand ? channels - 1 : -1;
    is->orientation = 1;
    is->subimage_count = 1;
    name_channels(r);
    return CM_OK;
}

static cm_status open_raster(const char *path, raster *r, char *message)
{
    const GDALDatasetH file = GDALOpenEx(path, GDAL_OF_RASTER | GDAL_OF_READONLY, NULL, NULL, NULL);
    cm_status status = add_stage(r, file, "is not a raster that GDAL reads", message);
    status = status == CM_OK ? expand_palette(r, message) : status;
    status = status == CM_OK ? show_missing(r, message) : status;
    status = status == CM_OK ? find_place(r, message) : status;
    return status == CM_OK ? describe_raster(r, message) : status;
}

static cm_status open_file(const char *path, uint32_t subimage, cm_image_reader **reader,
                           char *message)
{
    pthread_once(&registered, register_drivers);
    raster *const r = subimage == 0 ? calloc(1, sizeof *r) : NULL;
    if (r == NULL)
    {
        snprintf(message, CM_IMAGE_MESSAGE, "cannot be read: no memory, or no such picture in it");
        return subimage == 0 ? CM_ERROR_MEMORY : CM_ERROR_ARGUMENT;
    }
    CPLErrorReset();
    const cm_status status = open_raster(path, r, message);
    if (status != CM_OK)
    {
        close_raster(r);
        return status;
    }
    *reader = (cm_image_reader *)r;
    return CM_OK;
}

static const cm_image_description *describe(const cm_image_reader *reader)
{
    return &((const raster *)reader)->description;
}

/* ---- pixels ---- */

/* What is no data is NaN, for each channel by itself. */
static void mark_no_data(const raster *r, uint32_t width, uint32_t height, char *pixels,
                         ptrdiff_t row_stride)
{
    const uint32_t channels = r->description.channels;
    for (uint32_t c = 0; c < channels; c++)
    {
        int some = 0;
        const float none =
            (float)GDALGetRasterNoDataValue(GDALGetRasterBand(r->last, (int)c + 1), &some);
        for (uint32_t y = 0; some && y < height; y++)
        {
            float *const row = (float *)(void *)(pixels + row_stride * (ptrdiff_t)y) + c;
            for (size_t x = 0; x < width; x++)
            {
                row[x * channels] = row[x * channels] == none ? NAN : row[x * channels];
            }
        }
    }
}

/* Whole numbers as floats: their largest is 1. */
static void scale_to_unit(float most, uint32_t width, uint32_t height, uint32_t channels,
                          char *pixels, ptrdiff_t row_stride)
{
    for (uint32_t y = 0; y < height; y++)
    {
        float *const row = (float *)(void *)(pixels + row_stride * (ptrdiff_t)y);
        for (size_t i = 0; i < (size_t)width * channels; i++)
        {
            row[i] *= 1.0F / most;
        }
    }
}

static cm_status read_pixels(cm_image_reader *reader, const cm_image_region *region,
                             cm_pixel_type type, void *pixels, ptrdiff_t row_stride, char *message)
{
    const raster *const r = (const raster *)(const void *)reader;
    const cm_image_description *const is = &r->description;
    if ((type != is->type && type != CM_PIXEL_FLOAT) || region->x1 > is->width ||
        region->y1 > is->height || region->x0 >= region->x1 || region->y0 >= region->y1)
    {
        snprintf(message, CM_IMAGE_MESSAGE, "cannot be read so: there are no such pixels");
        return CM_ERROR_ARGUMENT;
    }
    const int width = (int)(region->x1 - region->x0);
    const int height = (int)(region->y1 - region->y0);
    const GDALDataType wanted = type == CM_PIXEL_FLOAT ? GDT_Float32 : r->type;
    const GSpacing sample = GDALGetDataTypeSizeBytes(wanted);
    const GSpacing pixel = sample * (GSpacing)is->channels;
    const ptrdiff_t down = row_stride != 0 ? row_stride : (ptrdiff_t)(pixel * width);
    CPLErrorReset();
    const CPLErr error = GDALDatasetRasterIOEx(r->last, GF_Read, (int)region->x0, (int)region->y0,
                                               width, height, pixels, width, height, wanted,
                                               (int)is->channels, NULL, pixel, down, sample, NULL);
    const cm_status status = error == CE_None ? CM_OK : fail(message, "is damaged");
    if (status == CM_OK && r->type == GDT_Float32)
    {
        mark_no_data(r, (uint32_t)width, (uint32_t)height, pixels, down);
    }
    else if (status == CM_OK && type == CM_PIXEL_FLOAT)
    {
        scale_to_unit(is->type == CM_PIXEL_U8 ? 255.0F : 65535.0F, (uint32_t)width,
                      (uint32_t)height, is->channels, pixels, down);
    }
    return status;
}

static void close_file(cm_image_reader *reader)
{
    if (reader != NULL)
    {
        close_raster((raster *)reader);
    }
}

__attribute__((visibility("default"))) const cm_image_io *cm_image_io_entry(uint32_t version)
{
    static const cm_image_io table = {.version = CM_IMAGE_IO_VERSION,
                                      .size = sizeof table,
                                      .open = open_file,
                                      .describe = describe,
                                      .read = read_pixels,
                                      .close = close_file};
    return version == CM_IMAGE_IO_VERSION ? &table : NULL;
}
