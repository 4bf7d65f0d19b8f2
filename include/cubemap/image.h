/* SPDX-License-Identifier: MIT
 *
 * Pictures of the sphere: how it lies on them, and from one to another. A library of its own, cubemap-image, which
 * knows no file.
 *
 *   picture     pixels in memory that belong to the caller (cm_image). Positions count pixels from the upper left
 *               corner: the first pixel is from 0 to 1 both ways, its centre at (0.5, 0.5)
 *   surface     how the sphere lies on one or more pictures: cm_surface_create
 *   plane       a part of the sphere in one piece: a face of the cube, the whole of an equirectangular picture
 *   plan        what resampling from one surface to another needs of geometry: cm_plan_create
 *   direction   as in mapping.h; axes of the Earth: x through lon 0, y through lon 90 E, z north
 *   results     the same bits for any number of threads, and for any part of the target alone; instruction sets may
 *               differ in the last ones (options.h)
 *   threads     surfaces and plans are constant after their creation: any number of threads may use one
 *   example     cm_surface_create("equirect", NULL, ...), cm_surface_create("cube:coupled", ...), cm_plan_create,
 *               cm_resample: docs/guide/images.md
 */
#ifndef CUBEMAP_IMAGE_H
#define CUBEMAP_IMAGE_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>
#include <cubemap/healpix.h>
#include <cubemap/mapping.h>
#include <cubemap/orientation.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- pictures ---- */

/* What a channel of a pixel is. Whole numbers stand for 0 to 1: 255, or 65535, is 1. */
typedef enum cm_pixel_type
{
    CM_PIXEL_U8 = 0,   /* uint8_t */
    CM_PIXEL_U16 = 1,  /* uint16_t */
    CM_PIXEL_HALF = 2, /* IEC 60559 binary16, in a uint16_t */
    CM_PIXEL_FLOAT = 3 /* float */
} cm_pixel_type;

/* No picture has more channels. */
#define CM_CHANNELS_MAX 64

/* A picture, which points to the caller's memory. The channels of a pixel are one beside the other; strides are in
 * bytes and may be negative: data points to the first pixel of the first row. */
typedef struct cm_image
{
    size_t size;          /* sizeof(cm_image) */
    void *data;           /* the first pixel; aligned as its type is */
    cm_pixel_type type;   /* of every channel */
    uint32_t width;       /* pixels, 1 or more */
    uint32_t height;      /* pixels, 1 or more */
    uint32_t channels;    /* 1 to CM_CHANNELS_MAX */
    ptrdiff_t row_stride; /* from a pixel to the one below it, in bytes; 0: rows are dense */
    ptrdiff_t
        pixel_stride; /* from a pixel to the one to its right, in bytes; 0: pixels are dense */
} cm_image;

/* The bytes of one channel; 0 for what is no type. */
CM_API size_t cm_pixel_size(cm_pixel_type type);

/* ---- surfaces ---- */

/* How the sphere lies on pictures, from cm_surface_create to cm_surface_destroy. */
typedef struct cm_surface cm_surface;

/* To be filled with zeros but for size, and for what is wanted. */
typedef struct cm_surface_options
{
    size_t size;     /* sizeof(cm_surface_options) */
    uint32_t width;  /* of each picture, in pixels; 0: as the specification says */
    uint32_t height; /* of each picture, in pixels; 0: as the specification says */
    const cm_rotation
        *rotation; /* how the surface's axes stand on the Earth; NULL: they are the Earth's */
    const char *instructions; /* as in cm_options */
} cm_surface_options;

/* Make a surface from a specification, KIND[:PARAMETERS][;KEY=VALUE...], e.g. "equirect", "cube:coupled",
 * "cube:qsc;frame=gl;layout=cross", "view:fov=90", "azimuthal:equidistant:fov=185", "octahedral". Upper and lower
 * case are the same. The key size is the edge of a face, or of a square picture, or the width of one that is twice as
 * wide as high; width and height of options are of the pictures as a whole, and stand for it. cm_surface_kind_at tells
 * the kinds with their parameters and keys. On success *surface is to be given to cm_surface_destroy. options may be NULL
 * if the specification has the size.
 * Errors: CM_ERROR_ARGUMENT, _SYNTAX, _MAPPING, _PARAMETER, _RANGE (a size that the kind cannot have), _FRAME,
 * _ORIENTATION, _MEMORY, _INSTRUCTIONS; cm_surface_check says what is wrong in words. */
CM_API cm_status cm_surface_create(const char *specification, const cm_surface_options *options,
                                   cm_surface **surface);

/* NULL is allowed. */
CM_API void cm_surface_destroy(cm_surface *surface);

/* As cm_surface_create, without making anything. If the status is not CM_OK, and message is not NULL, at most
 * message_size bytes of one line that says what is wrong and what would be right are written to it, always ended by a
 * zero byte if message_size > 0. Sizes are looked at only if options has some. */
CM_API cm_status cm_surface_check(const char *specification, const cm_surface_options *options,
                                  char *message, size_t message_size);

/* A kind of surface. Read through pointers that the library gives out; it may grow at its end. */
typedef struct cm_surface_kind
{
    const char *identifier; /* "equirect" */
    const char *name;       /* one line for people */
    const char
        *parameters;  /* what may follow the identifier, one line for people; "" for nothing */
    const char *keys; /* the keys, apart by blanks */
} cm_surface_kind;

/* The number of kinds, and the kind at an index below it (else NULL), in a fixed order. */
CM_API size_t cm_surface_kind_count(void);
CM_API const cm_surface_kind *cm_surface_kind_at(size_t index);

/* The specification that makes this surface again, with all that is not as it is without a word, size included; lives as
 * long as the surface. Rotations are the caller's: they are not in it. */
CM_API const char *cm_surface_specification(const cm_surface *surface);

/* The pictures of a surface, one or six of a cube, and the size of each. */
CM_API size_t cm_surface_picture_count(const cm_surface *surface);
CM_API uint32_t cm_surface_width(const cm_surface *surface);
CM_API uint32_t cm_surface_height(const cm_surface *surface);

/* The planes of a surface, and the size of each. */
CM_API size_t cm_surface_plane_count(const cm_surface *surface);
CM_API uint32_t cm_surface_plane_width(const cm_surface *surface);
CM_API uint32_t cm_surface_plane_height(const cm_surface *surface);

/* Where the pixel of a plane is: in which picture, and at which column and row of it. Pixels of pictures that are on no
 * plane, the empty parts of a cross or a pad, are never read, and never written: who wants them black clears the pictures.
 * No pointer may be NULL. CM_OK, or CM_ERROR_RANGE if there is no such pixel. */
CM_API cm_status cm_surface_pixel(const cm_surface *surface, uint32_t plane, uint32_t column,
                                  uint32_t row, uint32_t *picture, uint32_t *picture_column,
                                  uint32_t *picture_row);

/* The mapping behind a surface of faces, or NULL. It lives as long as the surface. */
CM_API const cm_mapping *cm_surface_mapping(const cm_surface *surface);

/* n directions to positions on planes, and back. No plane is CM_NO_FACE with NaN, no direction three NaN. Directions
 * from positions are of unit length; positions up to 1e-9 outside a plane are on its edge. Arrays as in mapping.h. */
CM_API void cm_surface_positions(const cm_surface *surface, size_t n, const double *x,
                                 const double *y, const double *z, uint8_t *plane, double *column,
                                 double *row);
CM_API void cm_surface_directions(const cm_surface *surface, size_t n, const uint8_t *plane,
                                  const double *column, const double *row, double *x, double *y,
                                  double *z);

/* How a program or an interface wants its pictures of the sphere, where the picture "equirect" has in its middle what is
 * ahead. Read through pointers that the library gives out; it may grow at its end. docs/guide/images.md says what is known
 * of each. */
typedef struct cm_surface_preset
{
    const char *identifier;    /* "unreal" */
    const char *name;          /* one line for people: which axis is up, which one ahead */
    const char *source;        /* where that is said */
    const char *specification; /* without a size */
    cm_rotation rotation;      /* for cm_surface_options */
} cm_surface_preset;

/* The number of presets, and the preset at an index below it (else NULL), in a fixed order; and the one of an identifier
 * (upper and lower case are the same), or NULL. The tables are constant and live as long as the program. */
CM_API size_t cm_surface_preset_count(void);
CM_API const cm_surface_preset *cm_surface_preset_at(size_t index);
CM_API const cm_surface_preset *cm_surface_preset_find(const char *identifier);

/* The 12 nside^2 pixels of a HEALPix map, pixel_size bytes each, from a list in an order to the picture of the surface
 * "healpix", 12 nside wide and nside high, both dense; or from the picture to the list if to_list is not 0. from and to do
 * not overlap.
 * Errors: CM_ERROR_ARGUMENT (NULL, pixel_size 0), CM_ERROR_RANGE (no picture is so large), and those of
 * cm_healpix_create. */
CM_API cm_status cm_healpix_arrange(int64_t nside, cm_healpix_order order, int to_list,
                                    size_t pixel_size, const void *from, void *to);

/* ---- resampling ---- */

/* How values between pixels come about. */
typedef enum cm_filter
{
    CM_FILTER_AUTO = 0,     /* the cheapest that is good enough for the picture: cm_source_filter */
    CM_FILTER_NEAREST = 1,  /* the value of the pixel */
    CM_FILTER_BILINEAR = 2, /* of 2 x 2 pixels */
    CM_FILTER_CATMULL_ROM = 3, /* cubic through 4 x 4 pixels */
    CM_FILTER_MITCHELL = 4,    /* cubic of 4 x 4 pixels, B = C = 1/3, which blurs a little */
    CM_FILTER_LANCZOS3 = 5,    /* windowed sinc of 6 x 6 pixels, its weights brought to the sum 1 */
    CM_FILTER_SPLINE36 = 6,    /* piecewise cubic of 6 x 6 pixels */
    CM_FILTER_BSPLINE5 = 7,    /* the quintic B-spline that goes through all pixels */
    CM_FILTER_EWA = 8          /* the elliptic footprint of each target pixel, by the Jacobian */
} cm_filter;

/* "auto", "nearest", ...; NULL for what is no cm_filter. */
CM_API const char *cm_filter_name(cm_filter filter);

/* What the values of pixels are, and so how they are mixed. */
typedef enum cm_transfer
{
    CM_TRANSFER_STORED = 0, /* as they are stored */
    CM_TRANSFER_SRGB = 1,   /* sRGB, mixed as linear light */
    CM_TRANSFER_GAMMA = 2   /* a power, mixed as linear light */
} cm_transfer;

/* What becomes of numbers that are not finite. */
typedef enum cm_not_finite
{
    CM_NOT_FINITE_SPREAD =
        0, /* as arithmetic has it: what a filter touches becomes NaN or infinite */
    CM_NOT_FINITE_SKIP =
        1, /* they weigh nothing: what is left of the footprint counts; NaN where nothing is */
    CM_NOT_FINITE_ZERO = 2 /* they are 0 */
} cm_not_finite;

/* Who gives memory for planes that filters need beside the pictures: coefficients of splines, 4 bytes a channel and
 * pixel of the source, and levels of EWA, as much and a third. A program may put them into files. */
typedef struct cm_memory
{
    size_t size; /* sizeof(cm_memory) */
    /* So many bytes of any value, 1 or more, aligned to 64; NULL if there are none. Only the thread that creates or
     * destroys what they are for calls. */
    void *(*allocate)(void *context, size_t bytes);
    /* What allocate has returned for so many bytes. */
    void (*release)(void *context, void *pointer, size_t bytes);
    void *context; /* the caller's own */
    /* NULL, or what every thread calls that has read or written about so many bytes more of what allocate has returned, or
     * of pictures while a source is made: a program that keeps them in files may give pages back then. It must not call this library. */
    void (*touched)(void *context, size_t bytes);
} cm_memory;

/* To be filled with zeros but for size, and for what is wanted. */
typedef struct cm_plan_options
{
    size_t size;      /* sizeof(cm_plan_options) */
    cm_filter filter; /* of the values */
    double
        tolerance; /* of positions, in source pixels: 0 for 1/4096, negative for as exact as a double is. EWA, whose
                      footprints are as wide as target pixels, takes four times so much of one of these */
    double pixels_most; /* of one EWA footprint; 0 for 4096. A longer ellipse is shortened to it */
    cm_transfer transfer; /* of all channels but alpha and the vector */
    double
        gamma; /* of CM_TRANSFER_GAMMA, 2.2 say: linear light is the stored value to this power */
    uint32_t alpha;       /* the channel of opacity, counted from 1; 0 for none */
    int alpha_multiplied; /* are the others multiplied by it? */
    uint32_t
        vector; /* the first of three channels that are a vector in the source's axes, counted from 1, which is
                            turned into the target's; 0 for none. Whole numbers hold it as normal maps do: 0 to 1,
                            which is 0 to 255, say, stands for -1 to 1 */
    cm_not_finite not_finite; /* what becomes of NaN and infinities */
    int dither;               /* are whole numbers dithered? */
    const char *instructions; /* as in cm_options */
    const cm_memory *
        memory; /* copied; NULL: the system's. Its context must live as long as the plan and its sources */
} cm_plan_options;

/* The geometry of resampling, from cm_plan_create to cm_plan_destroy. */
typedef struct cm_plan cm_plan;

/* A plan from one surface to another. Both are copied: they may be destroyed. options may be NULL. On success *plan is to
 * be given to cm_plan_destroy.
 * Errors: CM_ERROR_ARGUMENT, _RANGE (an option), _MEMORY, _INSTRUCTIONS. */
CM_API cm_status cm_plan_create(const cm_surface *from, const cm_surface *to,
                                const cm_plan_options *options, cm_plan **plan);

/* NULL is allowed. */
CM_API void cm_plan_destroy(cm_plan *plan);

/* A plan as text, to be kept in a file or sent elsewhere: lines of ASCII, ended by a zero byte that *length does not
 * count. length may be NULL; so may text if size is 0, which asks for the length alone.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_SPACE if there is more than size bytes have room for: *length says how much. */
CM_API cm_status cm_plan_write(const cm_plan *plan, char *text, size_t size, size_t *length);

/* The plan of such a text of length bytes, which gives the same bits. instructions as in cm_options.
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_SYNTAX (no such text, or cut), and those of cm_surface_create and
 * cm_plan_create. */
CM_API cm_status cm_plan_read(const char *text, size_t length, const char *instructions,
                              cm_plan **plan);

/* What part of the target is wanted: rows and columns of one plane. All zeros is all of it. */
typedef struct cm_rows
{
    uint32_t plane;        /* of the target */
    uint32_t first_row;    /* of the plane */
    uint32_t row_count;    /* 0: all planes, whole */
    uint32_t first_column; /* of the plane */
    uint32_t column_count; /* 0: whole rows */
} cm_rows;

/* A source made ready for resampling: what is beyond the edges of its planes, the coefficients of splines and the levels
 * of EWA, as the plan's filter needs them. The pictures must stay as they are until cm_source_destroy.
 * Coefficients of more than 32 MiB are made when a part of a target is asked for, unless the plan has cm_memory. All of a
 * target in one call does without: they are made stripe by stripe, of some 8 MiB, or of 16 where that is a whole plane,
 * with the same bits. */
typedef struct cm_source cm_source;

/* from points to the plan's pictures, cm_surface_picture_count of them; target_type is that of the targets to come. threads as in threads.h.
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_RANGE (pictures of another size than the surface's, or not alike), CM_ERROR_MEMORY. */
CM_API cm_status cm_source_create(const cm_plan *plan, const cm_image *from,
                                  cm_pixel_type target_type, unsigned threads, cm_source **source);

/* NULL is allowed. */
CM_API void cm_source_destroy(cm_source *source);

/* The filter that is taken: the plan's, or what auto has chosen for this source. */
CM_API cm_filter cm_source_filter(const cm_source *source);

/* The wanted part of the target from a source. to points to the pictures of the target, of the type that
 * cm_source_create was told, which may be another than the source's, and of as many channels; what is not wanted stays as it is. What the source does not show is 0.
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_RANGE (pictures of another size than the surface's, rows that the plane does not
 * have), CM_ERROR_MEMORY. */
CM_API cm_status cm_resample_source(const cm_plan *plan, const cm_source *source, cm_image *to,
                                    cm_rows rows, unsigned threads);

/* cm_source_create, cm_resample_source and cm_source_destroy in a row, on the calling thread. */
CM_API cm_status cm_resample(const cm_plan *plan, const cm_image *from, cm_image *to, cm_rows rows);

/* Values at n directions: channels floats for each in out, 0 where the surface has none. Whole numbers are 0 to 1.
 * filter must not be CM_FILTER_EWA, which has no footprint here; CM_FILTER_AUTO is the quintic B-spline. A call makes a
 * source of its own, which for that filter takes as long as a picture: ask for many directions at once.
 * Errors: those of cm_source_create (CM_FILTER_EWA is CM_ERROR_ARGUMENT), CM_ERROR_RANGE (no cm_filter). */
CM_API cm_status cm_sample(const cm_surface *surface, const cm_image *pictures, cm_filter filter,
                           size_t n, const double *x, const double *y, const double *z, float *out);

#ifdef __cplusplus
}
#endif

#endif
