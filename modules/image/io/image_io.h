/* SPDX-License-Identifier: MIT
 *
 * Image files: what they say of themselves, their pixels, in rows or in parts, and writing them.
 *
 * The libraries that decode files are many and slow to load, so they are behind a table of functions, which
 * cm_image_io_get finds, in a library of its own that is opened at the first call.
 *
 *   picture     what is stored, from the upper left corner, before any orientation; channels one beside the other
 *   message     one line of CM_IMAGE_MESSAGE bytes at most, ended by a zero byte, of what went wrong, to follow the
 *               file's name: "is not an image that can be read: ...". Written on failure only
 *   threads     one file is used by one thread at a time, different files by any number
 *   failures    CM_ERROR_ARGUMENT, CM_ERROR_MEMORY, and CM_ERROR_UNSUPPORTED for what is wrong with a file; of open
 *               CM_ERROR_DATA where nobody else should try: the file is known, and a part of it is missing
 */
#ifndef CUBEMAP_MODULES_IMAGE_IO_H
#define CUBEMAP_MODULES_IMAGE_IO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cubemap/image.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The room for a message. */
#define CM_IMAGE_MESSAGE 600

/* Changes with every change of what stands below. */
#define CM_IMAGE_IO_VERSION 2

/* What the numbers of colours mean. */
typedef enum cm_image_color
{
    CM_IMAGE_COLOR_UNKNOWN = 0, /* the file does not say, or something else */
    CM_IMAGE_COLOR_LINEAR = 1,  /* proportional to light */
    CM_IMAGE_COLOR_SRGB = 2     /* with sRGB's curve */
} cm_image_color;

/* What a file says beside its pixels. */
typedef struct cm_image_tag
{
    const char *key;  /* "Copyright", "Exif:FNumber" */
    const char *text; /* the value for people */
    const char *
        type; /* "string", "int", "float[3]", "uint8[512]", "rational"; NULL: string, and text is the value */
    const void
        *data; /* the value as stored; of strings, const char * each; NULL only if type is NULL */
    size_t data_size; /* bytes of data */
} cm_image_tag;

/* The tags of a TIFF file that say where on Earth its pixels are, as they stand in the file: GeoTIFF 1.1, section 7.1.
 * What is not there has count 0, or is NULL. */
typedef struct cm_image_geo_tags
{
    const double *scale; /* ModelPixelScale: along x, y, z */
    size_t scale_count;
    const double *tie_points; /* ModelTiepoint: six numbers each, column, row, level and x, y, z */
    size_t tie_point_count;   /* of numbers */
    const double *transformation; /* ModelTransformation: 4 x 4 by rows */
    size_t transformation_count;
    const uint16_t *keys;  /* GeoKeyDirectory */
    size_t key_count;      /* of numbers */
    const double *numbers; /* GeoDoubleParams */
    size_t number_count;
    const char *texts;   /* GeoAsciiParams */
    const char *no_data; /* GDAL_NODATA: the value of pixels without one */
} cm_image_geo_tags;

/* A picture in a file. What is read belongs to the reader; what is written belongs to the caller. A writer does not look
 * at members that say "read". */
typedef struct cm_image_description
{
    /* "png", "jpeg", "tiff", "openexr", "hdr"; read: others, too */
    const char *format;
    /* of the picture, 1 or more each */
    uint32_t width;
    uint32_t height;
    uint32_t channels;
    /* that of the file, or the nearest that loses nothing, else float */
    cm_pixel_type type;
    /* the file's own: "uint8", "half", "uint", "double"; NULL to write that of type. A format that has no such type takes
     * the nearest that loses nothing, if it has one */
    const char *stored_type;
    /* read: does the file hold integers? */
    bool whole_numbers;
    /* "R", "Z"; NULL to write Y, or R G B A and numbers */
    const char *const *channel_names;
    /* the channel that is alpha, or -1 */
    int32_t alpha;
    /* are colours multiplied by alpha? PNG has none that are: they are divided when written */
    bool alpha_multiplied;
    /* what the numbers mean */
    cm_image_color color;
    /* read: as in Exif, 1 to 8; 1 is upright */
    uint32_t orientation;
    /* read: where the picture is in its window, which OpenEXR has; else 0 and the picture's size */
    int32_t left;
    int32_t top;
    uint32_t window_width;
    uint32_t window_height;
    /* read: which of the file's pictures this is, from 0, and how many there are */
    uint32_t subimage;
    uint32_t subimage_count;
    /* read: what the file calls this picture, as OpenEXR calls its parts; NULL if it has no name for it */
    const char *subimage_name;
    /* written: the names of all pictures of an OpenEXR file that has so many, each unlike the others. All else they have
     * in common. NULL and 0: the file is one picture */
    const char *const *part_names;
    uint32_t part_count;
    /* of tiles; 0: rows */
    uint32_t tile_width;
    uint32_t tile_height;
    /* "zip", "lzw", "none", "jpeg:90"; NULL to write what a tag of that name says, else the format's own, which of TIFF is
     * none */
    const char *compression;
    /* what else it says */
    const cm_image_tag *tags;
    size_t tag_count;
    /* read: NULL if there are none */
    const cm_image_geo_tags *geo_tags;
} cm_image_description;

/* Columns from x0 to before x1, rows from y0 to before y1. */
typedef struct cm_image_region
{
    uint32_t x0;
    uint32_t y0;
    uint32_t x1;
    uint32_t y1;
} cm_image_region;

/* Where a writer's bytes go. None of these fails: what went wrong is asked of whoever gave them. */
typedef struct cm_image_stream
{
    void *context;
    size_t (*read)(void *context, void *bytes, size_t count);
    size_t (*write)(void *context, const void *bytes, size_t count);
    void (*seek)(void *context, int64_t position); /* from the begin */
    size_t (*size)(void *context);
} cm_image_stream;

typedef struct cm_image_reader cm_image_reader;
typedef struct cm_image_writer cm_image_writer;

/* The functions. On failure outputs are untouched, but for pixels, of which some may be there.
 *
 *   cm_image_reader *reader;
 *   const cm_image_io *io = cm_image_io_get(message);
 *   if (io != NULL && io->open("earth.png", 0, &reader, message) == CM_OK) { io->read(...); io->close(reader); } */
typedef struct cm_image_io
{
    uint32_t version; /* CM_IMAGE_IO_VERSION */
    uint32_t size;    /* sizeof(cm_image_io) */

    /* From now on the process decodes and encodes in so many threads; without this, one for each core. Not while a file
     * is read or written. */
    void (*set_threads)(int32_t threads);

    /* Open one of a file's pictures, counted from 0. */
    cm_status (*open)(const char *path, uint32_t subimage, cm_image_reader **reader, char *message);
    /* What the file says; lives as long as the reader. */
    const cm_image_description *(*describe)(const cm_image_reader *reader);
    /* A part of the picture, as pixels of a type: whole numbers stand for 0 to 1. row_stride is in bytes, and may be
     * negative; 0: rows are dense. */
    cm_status (*read)(cm_image_reader *reader, const cm_image_region *region, cm_pixel_type type,
                      void *pixels, ptrdiff_t row_stride, char *message);
    /* NULL is allowed. */
    void (*close)(cm_image_reader *reader);

    /* Begin a file: into stream, or where that cannot be or is NULL under the name path. The file stays a part of one
     * until finish. stream must live as long as the writer. */
    cm_status (*create)(const char *path, const cm_image_stream *stream,
                        const cm_image_description *description, cm_image_writer **writer,
                        char *message);
    /* Rows from first to before end, in order from the top: first is where the last call ended, or 0 behind the last row
     * of a part that is followed by another. Strides are in bytes; 0: dense. Of each pixel the description's channels
     * are taken. */
    cm_status (*write)(cm_image_writer *writer, uint32_t first, uint32_t end, cm_pixel_type type,
                       const void *pixels, ptrdiff_t pixel_stride, ptrdiff_t row_stride,
                       char *message);
    /* Complete the file, behind its last row, of the last part. */
    cm_status (*finish)(cm_image_writer *writer, char *message);
    /* With or without finish; NULL is allowed. */
    void (*drop)(cm_image_writer *writer);
} cm_image_io;

/* The table, from a library that is opened at the first call and stays open: the file that the environment variable
 * CUBEMAP_IMAGE_IO names; without it cubemap-image-io.so where the running program's folder has it, installed or just
 * built, or where it was to be installed. NULL if there is none: the message, a whole sentence, says which was looked
 * for and why not. Any thread may call. */
const cm_image_io *cm_image_io_get(char *message);

#ifdef __cplusplus
}
#endif

#endif
