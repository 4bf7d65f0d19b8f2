/* SPDX-License-Identifier: MIT
 *
 * Resampling between small pictures of any surfaces, types and meanings: nothing is read or written beyond them, a
 * part has the bits of the whole, and so with levels, borders and values at directions.
 */
#include <cubemap/cubemap.h>
#include <cubemap/image.h>
#include <cubemap/mips.h>

#include <math.h>

#include "fuzz.h"

static const char *const surfaces[] = {
    "equirect",
    "equal-area",
    "mercator",
    "equirect;west=-20;east=70;south=-10;north=85",
    "cube:coupled",
    "cube:qsc;layout=strip",
    "cube:gnomonic;frame=gl;layout=3x2",
    "cube:healpix;frame=s2",
    "cube:conformal;layout=column",
    "azimuthal:equidistant:fov=200",
    "azimuthal:lambert",
    "octahedral",
    "rhealpix",
    "peirce",
    "view",
    "view:fov=130,lon=40,lat=70,roll=10",
    "view:vfov=60,shift-x=0.5,shift-y=-0.25;aspect=1.5",
    "fisheye",
    "fisheye:equisolid:fov=220;aspect=1.5",
    "fisheye:breusing:fov=360",
    "dual-fisheye",
    "dual-fisheye:lambert:fov=190",
    "dual-paraboloid",
    "healpix",
    "cube:s2;layout=cross",
    "cube:tangent;frame=s2;layout=cross:north=0,south=2",
    "cube;frame=fits;layout=vcross",
    "cube:tangent;frame=geo;layout=eac",
    "cube:tangent;layout=eac:pad=3",
};

enum
{
    EDGE_MOST = 21,
    CHANNELS_MOST = 5,
    BORDER_MOST = 12,
    POINTS = 4
};

typedef struct scene
{
    cm_surface *surface;
    cm_image image[6];
} scene;

/* Memory ends with the last pixel, so that the sanitizer sees what is beyond. */
static scene make_scene(supply *from, cm_pixel_type type, uint32_t channels)
{
    scene made = {0};
    cm_rotation rotation;
    char text[160];
    cm_rotation_from_angles(180.0 * take_fraction(from), 90.0 * take_fraction(from), 40.0,
                            &rotation);
    const int turned = take_byte(from) % 2;
    const cm_surface_options options = {.size = sizeof options,
                                        .rotation = turned ? &rotation : NULL};
    const char *kind = surfaces[take_byte(from) % (sizeof surfaces / sizeof *surfaces)];
    const unsigned edge = 1u + take_byte(from) % EDGE_MOST;
    const int is_pair = strncmp(kind, "dual", 4) == 0; /* two circles: an even width */
    snprintf(text, sizeof text, "%s;size=%u", kind, is_pair ? 2 * edge : edge);
    EXPECT(cm_surface_create(text, &options, &made.surface) == CM_OK, "%s", text);
    for (size_t i = 0; i < cm_surface_picture_count(made.surface); i++)
    {
        const uint32_t width = cm_surface_width(made.surface);
        const uint32_t height = cm_surface_height(made.surface);
        const size_t bytes = (size_t)width * height * channels * cm_pixel_size(type);
        made.image[i] = (cm_image){.size = sizeof(cm_image),
                                   .data = malloc(bytes),
                                   .type = type,
                                   .width = width,
                                   .height = height,
                                   .channels = channels};
        EXPECT(made.image[i].data != NULL, "no memory");
        memset(made.image[i].data, 0, bytes);
    }
    return made;
}

static size_t bytes_of(const cm_image *image)
{
    return (size_t)image->width * image->height * image->channels * cm_pixel_size(image->type);
}

static void free_scene(scene *made)
{
    for (size_t i = 0; i < 6; i++)
    {
        free(made->image[i].data);
    }
    cm_surface_destroy(made->surface);
}

static cm_plan_options take_options(supply *from, uint32_t channels)
{
    static const double tolerances[] = {0.0, -1.0, 0.5, 1e-9};
    cm_plan_options options = {.size = sizeof options};
    options.filter = (cm_filter)(take_byte(from) % 9);
    options.tolerance = tolerances[take_byte(from) % 4];
    options.pixels_most = take_byte(from);
    options.transfer = (cm_transfer)(take_byte(from) % 3);
    options.gamma = 2.2;
    options.alpha = take_byte(from) % (channels + 1);
    options.alpha_multiplied = take_byte(from) % 2;
    options.vector = options.alpha == 0 && channels >= 3 ? take_byte(from) % (channels - 1) : 0;
    options.not_finite = (cm_not_finite)(take_byte(from) % 3);
    options.dither = take_byte(from) % 2;
    EXPECT(cm_filter_name(options.filter) != NULL, "filter");
    return options;
}

/* A part again, into pictures that have the whole: nothing changes. */
static void check_part(const cm_plan *plan, const cm_source *source, scene *to, supply *from)
{
    const uint32_t width = cm_surface_plane_width(to->surface);
    const uint32_t height = cm_surface_plane_height(to->surface);
    cm_rows rows = {.plane = (uint32_t)(take_byte(from) % cm_surface_plane_count(to->surface)),
                    .first_row = take_byte(from) % height,
                    .first_column = take_byte(from) % width};
    rows.row_count = 1 + take_byte(from) % (height - rows.first_row);
    rows.column_count = 1 + take_byte(from) % (width - rows.first_column);
    unsigned char *before[6] = {NULL};
    for (size_t i = 0; i < cm_surface_picture_count(to->surface); i++)
    {
        before[i] = malloc(bytes_of(&to->image[i]));
        memcpy(before[i], to->image[i].data, bytes_of(&to->image[i]));
    }
    EXPECT(cm_resample_source(plan, source, to->image, rows, 1) == CM_OK, "part");
    for (size_t i = 0; i < cm_surface_picture_count(to->surface); i++)
    {
        EXPECT(memcmp(before[i], to->image[i].data, bytes_of(&to->image[i])) == 0, "%s to %s",
               cm_surface_specification(to->surface), cm_filter_name(cm_source_filter(source)));
        free(before[i]);
    }
}

/* Levels down to one pixel of a plane, each half of the one before. */
static void check_levels(const scene *of, const cm_plan_options *options, cm_status wanted)
{
    cm_mips *mips = NULL;
    const cm_status status = cm_mips_create(of->surface, of->image, options, 1, &mips);
    EXPECT(status == CM_OK || wanted == CM_ERROR_RANGE, "%s: status %d",
           cm_surface_specification(of->surface), (int)status);
    if (status != CM_OK)
    {
        EXPECT(mips == NULL, "made");
        return;
    }
    const uint32_t count = cm_mips_count(mips);
    uint32_t width = cm_surface_plane_width(of->surface);
    uint32_t height = cm_surface_plane_height(of->surface);
    for (uint32_t level = 0; level < count; level++)
    {
        const cm_image *picture = cm_mips_pictures(mips, level);
        EXPECT(picture != NULL && picture->type == of->image->type && picture->width >= width &&
                   picture->height >= height && picture->channels == of->image->channels,
               "%s: level %u", cm_surface_specification(of->surface), level);
        EXPECT((width == 1 && height == 1) == (level + 1 == count), "%s: level %u of %u",
               cm_surface_specification(of->surface), level, count);
        width = (width + 1) / 2;
        height = (height + 1) / 2;
    }
    EXPECT(cm_mips_pictures(mips, count) == NULL, "one more");
    cm_mips_destroy(mips);
}

/* Has the middle of a plane's pixel a direction? */
static int is_on_map(const scene *of, uint32_t plane, uint32_t column, uint32_t row)
{
    const uint8_t number = (uint8_t)plane;
    const double x = column + 0.5;
    const double y = row + 0.5;
    double direction[3];
    cm_surface_directions(of->surface, 1, &number, &x, &y, &direction[0], &direction[1],
                          &direction[2]);
    return !isnan(direction[0]);
}

/* What is inside of the border are the plane's own pixels, but beside a map what the sphere has there. */
static void check_inside(const scene *of, uint32_t plane, uint32_t border, const cm_image *to)
{
    const size_t pixel = cm_pixel_size(to->type) * to->channels;
    for (uint32_t row = 0; row < cm_surface_plane_height(of->surface); row++)
    {
        for (uint32_t column = 0; column < cm_surface_plane_width(of->surface); column++)
        {
            uint32_t picture = 9, x = 0, y = 0;
            EXPECT(cm_surface_pixel(of->surface, plane, column, row, &picture, &x, &y) == CM_OK &&
                       picture < cm_surface_picture_count(of->surface) && x < of->image->width &&
                       y < of->image->height,
                   "%u: %u %u", picture, x, y);
            const size_t from = (size_t)y * of->image->width + x;
            const size_t at = (size_t)(row + border) * to->width + column + border;
            EXPECT(!is_on_map(of, plane, column, row) ||
                       memcmp((unsigned char *)of->image[picture].data + from * pixel,
                              (unsigned char *)to->data + at * pixel, pixel) == 0,
                   "%s: plane %u, %u %u", cm_surface_specification(of->surface), plane, column,
                   row);
        }
    }
}

/* Planes with what is around them, as they are stored. */
static void check_border(const scene *of, supply *from)
{
    cm_image to[12];
    const uint32_t border = take_byte(from) % (BORDER_MOST + 1);
    const size_t planes = cm_surface_plane_count(of->surface);
    EXPECT(planes <= sizeof to / sizeof *to, "%zu planes", planes);
    for (size_t i = 0; i < planes; i++)
    {
        to[i] = (cm_image){.size = sizeof *to,
                           .type = of->image->type,
                           .width = cm_surface_plane_width(of->surface) + 2 * border,
                           .height = cm_surface_plane_height(of->surface) + 2 * border,
                           .channels = of->image->channels};
        to[i].data = malloc(bytes_of(&to[i]));
        EXPECT(to[i].data != NULL, "no memory");
    }
    const cm_status status = cm_border(of->surface, of->image, border, NULL, 1, to);
    EXPECT(status == CM_OK || (status == CM_ERROR_RANGE && border > 6), "%s, %u: status %d",
           cm_surface_specification(of->surface), border, (int)status);
    for (size_t i = 0; i < planes; i++)
    {
        if (status == CM_OK && to[i].type != CM_PIXEL_FLOAT && to[i].type != CM_PIXEL_HALF)
        {
            check_inside(of, (uint32_t)i, border, &to[i]);
        }
        free(to[i].data);
    }
}

/* Values at directions, of which some are none. */
static void check_sample(const scene *of, cm_filter filter, supply *from)
{
    double x[POINTS], y[POINTS], z[POINTS];
    float *out = malloc(POINTS * of->image->channels * sizeof *out);
    EXPECT(out != NULL, "no memory");
    for (int i = 0; i < POINTS; i++)
    {
        const int is_raw = take_byte(from) % 4 == 0;
        x[i] = is_raw ? take_double(from) : take_fraction(from);
        y[i] = is_raw ? take_double(from) : take_fraction(from);
        z[i] = is_raw ? take_double(from) : take_fraction(from);
    }
    const cm_status status = cm_sample(of->surface, of->image, filter, POINTS, x, y, z, out);
    EXPECT(status == (filter == CM_FILTER_EWA ? CM_ERROR_ARGUMENT : CM_OK), "%s, %s: status %d",
           cm_surface_specification(of->surface), cm_filter_name(filter), (int)status);
    for (size_t i = 0; status == CM_OK && i < POINTS * of->image->channels; i++)
    {
        EXPECT(of->image->type > CM_PIXEL_U16 || isfinite(out[i]), "%g", (double)out[i]);
    }
    free(out);
}

/* A plan of any text is none, or writes a text of which it is made again. */
static void check_text(const char *text, size_t size)
{
    char one[4096], other[4096];
    cm_plan *plan = NULL;
    cm_plan *again = NULL;
    size_t length = 0;
    const cm_status status = cm_plan_read(text, size, NULL, &plan);
    EXPECT((status == CM_OK) == (plan != NULL), "status %d", (int)status);
    if (plan == NULL)
    {
        return;
    }
    EXPECT(cm_plan_write(plan, one, sizeof one, &length) == CM_OK, "%zu bytes", length);
    EXPECT(cm_plan_read(one, length, NULL, &again) == CM_OK, "%s", one);
    EXPECT(cm_plan_write(again, other, sizeof other, NULL) == CM_OK, "%s", one);
    EXPECT(strcmp(one, other) == 0, "%s is not %s", one, other);
    cm_plan_destroy(plan);
    cm_plan_destroy(again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    check_text((const char *)data, size);
    const uint32_t channels = 1 + take_byte(&from) % CHANNELS_MOST;
    const cm_plan_options options = take_options(&from, channels);
    scene one = make_scene(&from, (cm_pixel_type)(take_byte(&from) % 4), channels);
    scene other = make_scene(&from, (cm_pixel_type)(take_byte(&from) % 4), channels);
    cm_plan *plan = NULL;
    cm_source *source = NULL;
    for (size_t i = 0; i < cm_surface_picture_count(one.surface); i++)
    {
        take_bytes(&from, one.image[i].data, bytes_of(&one.image[i]));
    }
    const cm_status status = cm_plan_create(one.surface, other.surface, &options, &plan);
    EXPECT(status == CM_OK || status == CM_ERROR_RANGE, "status %d", (int)status);
    if (status == CM_OK)
    {
        char text[4096];
        size_t length;
        EXPECT(cm_plan_write(plan, text, sizeof text, &length) == CM_OK, "text");
        check_text(text, length);
        EXPECT(cm_source_create(plan, one.image, other.image->type, 1, &source) == CM_OK, "source");
        EXPECT(cm_resample_source(plan, source, other.image, (cm_rows){0}, 1) == CM_OK, "resample");
        check_part(plan, source, &other, &from);
        EXPECT(cm_resample(plan, one.image, other.image, (cm_rows){0}) == CM_OK, "at once");
        cm_source_destroy(source);
    }
    cm_plan_destroy(plan);
    check_levels(&one, &options, status);
    check_border(&one, &from);
    check_sample(&one, options.filter, &from);
    free_scene(&one);
    free_scene(&other);
    return 0;
}
