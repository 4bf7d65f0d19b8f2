/* SPDX-License-Identifier: MIT
 *
 * Pictures through pipes, one after another, without seeking: PGM and PPM (P5, P6), PAM (P7), PFM (Pf, PF) and bare
 * samples. What "ffmpeg -f image2pipe -c:v ppm" or "-c:v pam" writes and reads.
 *
 *   rows        in the order of the stream: from the top, but of PFM from the bottom (bottom_up)
 *   samples     in the machine's order of bytes, as cm_pixel_type has them. Whole numbers with another largest value than
 *               255 and 65535 are scaled to these and rounded to nearest; cm_pnm_write writes these two
 *   stream      only read, or write, is called; the others may be NULL
 *   message     as in image_io.h; must not be NULL
 *   example     cm_pnm_reader reader = {.size = sizeof reader, .stream = &stream};
 *               cm_pnm_picture picture = {.size = sizeof picture};
 *               bool more;
 *               while (cm_pnm_next(&reader, &picture, &more, message) == CM_OK && more)
 *               {
 *                   cm_pnm_read(&reader, picture.height, pixels, 0, message);
 *               }
 */
#ifndef CUBEMAP_MODULES_IMAGE_PNM_FILE_H
#define CUBEMAP_MODULES_IMAGE_PNM_FILE_H

#include "image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Pixels along an edge at most. */
#define CM_PNM_SIZE_MOST 1048576

/* Bytes of a header that are kept, of its lines that say what we have said. */
#define CM_PNM_HEADER_MOST 1024

/* How a picture is written. */
typedef enum cm_pnm_kind
{
    CM_PNM_PGM = 0, /* P5: one channel of 8 or 16 bits */
    CM_PNM_PPM = 1, /* P6: three channels of 8 or 16 bits */
    CM_PNM_PAM = 2, /* P7: 1 to CM_CHANNELS_MAX channels of 8 or 16 bits */
    CM_PNM_PFM = 3, /* Pf, PF: one or three channels, floats */
    CM_PNM_RAW = 4  /* no header: what is in it only the caller knows */
} cm_pnm_kind;

/* A picture in a stream. */
typedef struct cm_pnm_picture
{
    size_t size; /* sizeof(cm_pnm_picture) */
    cm_pnm_kind kind;
    uint32_t width;     /* pixels, to CM_PNM_SIZE_MOST */
    uint32_t height;    /* pixels, to CM_PNM_SIZE_MOST */
    uint32_t channels;  /* as the kind can have them */
    cm_pixel_type type; /* of PGM, PPM and PAM U8 or U16, of PFM FLOAT, of raw any */
    int alpha;          /* PAM: is the last channel alpha? Of 2 or 4 channels */
    int little_endian;  /* PFM and raw: the order of bytes in the stream */
    uint32_t maximum;   /* read from PGM, PPM, PAM: the largest value; else 0 */
    float scale;        /* read from PFM: the scale, positive, which values are not multiplied by */
    int bottom_up;      /* read: is the first row the lowest? */
    /* written to PGM, PPM and PAM: lines of comments, each begun by '#' and ended, or NULL. Read: NULL, as they are passed over */
    const char *comments;
} cm_pnm_picture;

/* A stream that is read; to be filled with zeros but for size and stream. Members behind those are the functions'. */
typedef struct cm_pnm_reader
{
    size_t size; /* sizeof(cm_pnm_reader) */
    const cm_image_stream *stream;
    cm_pnm_picture picture; /* the one that is read */
    uint32_t rows_left;     /* of it */
    int held_count;         /* 0 or 1: the byte that was looked at */
    unsigned char held;
    size_t
        header_size; /* of those lines of its header that header_lines.h reads, whole ones with their ends; raw: 0 */
    size_t header_line;              /* bytes behind those, of a line that is not whole yet */
    int header_full;                 /* not 0: there is no room for that line */
    char header[CM_PNM_HEADER_MOST]; /* not ended */
} cm_pnm_reader;

/* The next picture, of which all rows of the last one must have been read. Of raw pictures the caller fills *picture and
 * sets kind to CM_PNM_RAW; else it is filled here. *more is false where the stream ends between pictures, and *picture is
 * left alone. CM_ERROR_ARGUMENT: a pointer, rows that are left, a raw picture that is none; CM_ERROR_UNSUPPORTED: no
 * such picture, or it ends too early. */
cm_status cm_pnm_next(cm_pnm_reader *reader, cm_pnm_picture *picture, bool *more, char *message);

/* The next rows, in the stream's order. row_stride is in bytes and may be negative; 0: dense. To have rows of PFM from the
 * top, give the last row's place and a negative stride. CM_ERROR_ARGUMENT: more rows than there are;
 * CM_ERROR_UNSUPPORTED: the stream ends, or a sample is above the largest value. */
cm_status cm_pnm_read(cm_pnm_reader *reader, uint32_t rows, void *pixels, ptrdiff_t row_stride,
                      char *message);

/* A whole picture: its header and all rows of image, from the top whatever the kind; width, height, channels and type are
 * those of image, and of *picture only kind, alpha and little_endian are looked at. CM_ERROR_ARGUMENT: what the kind cannot
 * have; CM_ERROR_MEMORY; CM_ERROR_UNSUPPORTED: the stream took no more. */
cm_status cm_pnm_write(const cm_image_stream *stream, const cm_pnm_picture *picture,
                       const cm_image *image, char *message);

/* The header alone, from all members of *picture that are not "read", for who writes rows by cm_pnm_write_rows. */
cm_status cm_pnm_write_header(const cm_image_stream *stream, const cm_pnm_picture *picture,
                              char *message);

/* The next rows in the stream's order: of PFM from the lowest. Of image only data, height, row_stride and pixel_stride are
 * looked at; the rest is as in *picture. Errors as of cm_pnm_write. */
cm_status cm_pnm_write_rows(const cm_image_stream *stream, const cm_pnm_picture *picture,
                            const cm_image *rows, char *message);

#ifdef __cplusplus
}
#endif

#endif
