/* SPDX-License-Identifier: MIT */
#include "point_filter.h"

#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cubemap/direction.h>

#include "tools/cli/degrees.h"
#include "tools/cli/failure.h"
#include "tools/cli/line_filter.h"

/* What the numbers of a line are. */
typedef enum form
{
    FORM_LONLAT,
    FORM_XYZ,
    FORM_FACE,
    FORM_DISC,
    FORM_SQUARE,
    FORM_CELL,
    FORM_PIXEL
} form;

static const struct
{
    const char *text;
    int count; /* of numbers */
} forms[] = {[FORM_LONLAT] = {"LON LAT in degrees", 2},
             [FORM_XYZ] = {"X Y Z", 3},
             [FORM_FACE] = {"FACE U V", 3},
             [FORM_DISC] = {"U V", 2},
             [FORM_SQUARE] = {"X Y", 2},
             [FORM_CELL] = {"CELL", 1},
             [FORM_PIXEL] = {"PIXEL", 1}};

/* Lines that are worked off together. Point i is in place i of every array, which holds some point
 * that is harmless where line i is no point. Forward: a, b, c are x, y, z and become u, v; inverse:
 * a, b are u, v, and a, b, c become x, y, z. Between disc and square a, b stay in the plane. Cells and
 * pixels stand for faces and u, v. */
struct batch
{
    size_t count;
    uint8_t face[BATCH_LINES];
    cm_cell cell[BATCH_LINES];
    int64_t pixel[BATCH_LINES];
    double a[BATCH_LINES];
    double b[BATCH_LINES];
    double c[BATCH_LINES];
    float single_a[BATCH_LINES];
    float single_b[BATCH_LINES];
    float single_c[BATCH_LINES];
};

struct filter
{
    const struct filter_options *options;
    const cm_mapping *mapping;
    form from;
    form to;
    struct line_filter lines;
    struct batch batch;
};

/* Say what is wrong with the line that has place index of the batch. */
#define complain(filter, ...) line_complain(&(filter)->lines, __VA_ARGS__)

/* ------------------------------------------------------------------------------- output */

static void put_number(struct filter *filter, double value, bool first)
{
    line_put_number(&filter->lines, value, first);
}

static void put_lonlat(struct filter *filter, size_t index)
{
    const struct batch *const batch = &filter->batch;
    const double direction[3] = {batch->a[index], batch->b[index], batch->c[index]};
    double longitude;
    double latitude;
    degrees_from_direction(direction, &longitude, &latitude);
    put_number(filter, longitude, true);
    put_number(filter, latitude, false);
}

static void put_cell(struct filter *filter, size_t index)
{
    char token[CM_CELL_TOKEN_SIZE] = "";
    cm_cell_token(filter->batch.cell[index], token, sizeof token);
    line_put_bytes(&filter->lines, token, strlen(token));
}

static void put_pixel(struct filter *filter, size_t index)
{
    char text[24];
    const int length = snprintf(text, sizeof text, "%" PRId64, filter->batch.pixel[index]);
    line_put_bytes(&filter->lines, text, (size_t)length);
}

static void put_result(void *user, size_t index)
{
    struct filter *const filter = user;
    const struct batch *const batch = &filter->batch;
    switch (filter->to)
    {
    case FORM_LONLAT:
        put_lonlat(filter, index);
        return;
    case FORM_CELL:
        put_cell(filter, index);
        return;
    case FORM_PIXEL:
        put_pixel(filter, index);
        return;
    default:
        break;
    }
    if (filter->to == FORM_FACE)
    {
        const char face[2] = {(char)('0' + batch->face[index]), ' '};
        line_put_bytes(&filter->lines, face, 2);
    }
    put_number(filter, batch->a[index], true);
    put_number(filter, batch->b[index], false);
    if (filter->to == FORM_XYZ)
    {
        put_number(filter, batch->c[index], false);
    }
}

/* ------------------------------------------------------------------------------- computing */

/* A direction in float keeps its digits, and stays finite and not zero, if it is first brought to a
 * length near 1; a power of two does that without rounding. */
static void narrow_direction(struct batch *batch, size_t index)
{
    const double largest =
        fmax(fabs(batch->a[index]), fmax(fabs(batch->b[index]), fabs(batch->c[index])));
    int exponent;
    frexp(largest, &exponent);
    batch->single_a[index] = (float)ldexp(batch->a[index], -exponent);
    batch->single_b[index] = (float)ldexp(batch->b[index], -exponent);
    batch->single_c[index] = (float)ldexp(batch->c[index], -exponent);
}

/* The batch's numbers in float. */
static void narrow_batch(struct batch *batch, bool directions)
{
    for (size_t i = 0; i < batch->count; i++)
    {
        if (directions)
        {
            narrow_direction(batch, i);
        }
        else
        {
            batch->single_a[i] = (float)batch->a[i];
            batch->single_b[i] = (float)batch->b[i];
            batch->single_c[i] = 0;
        }
    }
}

static void widen_batch(struct batch *batch)
{
    for (size_t i = 0; i < batch->count; i++)
    {
        batch->a[i] = (double)batch->single_a[i];
        batch->b[i] = (double)batch->single_b[i];
        batch->c[i] = (double)batch->single_c[i];
    }
}

static void compute_single(const cm_mapping *mapping, struct batch *batch, bool inverse)
{
    const size_t n = batch->count;
    float *const a = batch->single_a;
    float *const b = batch->single_b;
    float *const c = batch->single_c;
    if (cm_mapping_describe(mapping)->kind == CM_KIND_DISC_SQUARE)
    {
        (inverse ? cm_unwarp_array_f32 : cm_warp_array_f32)(mapping, n, a, b, a, b);
    }
    else if (inverse)
    {
        cm_inverse_array_f32(mapping, n, batch->face, a, b, a, b, c);
    }
    else
    {
        cm_forward_array_f32(mapping, n, a, b, c, batch->face, a, b);
    }
}

static void compute_double(const cm_mapping *mapping, struct batch *batch, bool inverse)
{
    const size_t n = batch->count;
    double *const a = batch->a;
    double *const b = batch->b;
    double *const c = batch->c;
    if (cm_mapping_describe(mapping)->kind == CM_KIND_DISC_SQUARE)
    {
        (inverse ? cm_unwarp_array : cm_warp_array)(mapping, n, a, b, a, b);
    }
    else if (inverse)
    {
        cm_inverse_array(mapping, n, batch->face, a, b, a, b, c);
    }
    else
    {
        cm_forward_array(mapping, n, a, b, c, batch->face, a, b);
    }
}

/* Between the normals of the ellipsoid and the directions of the mapping's sphere. */
static void compute_grid(const struct filter *filter, struct batch *batch, bool back)
{
    if (filter->options->grid != NULL && filter->options->cells == NULL)
    {
        (back ? cm_grid_from_sphere_array
              : cm_grid_to_sphere_array)(filter->options->grid, batch->count, batch->a, batch->b,
                                         batch->c, batch->a, batch->b, batch->c);
    }
}

static void compute_cells(const struct filter_options *options, struct batch *batch)
{
    const size_t n = batch->count;
    if (options->inverse)
    {
        cm_cell_centre_array(options->cells, n, batch->cell, batch->a, batch->b, batch->c);
    }
    else
    {
        cm_cell_forward_array(options->cells, options->level, n, batch->a, batch->b, batch->c,
                              batch->cell);
    }
}

static void compute_pixels(const struct filter_options *options, struct batch *batch)
{
    const size_t n = batch->count;
    if (options->inverse)
    {
        cm_healpix_direction_from_pixel_array(options->pixels, n, batch->pixel, batch->a, batch->b,
                                              batch->c);
    }
    else
    {
        cm_healpix_pixel_from_direction_array(options->pixels, n, batch->a, batch->b, batch->c,
                                              batch->pixel);
    }
}

static void compute_mapping(const struct filter *filter, struct batch *batch)
{
    const bool inverse = filter->options->inverse;
    if (filter->options->single)
    {
        narrow_batch(batch, filter->from == FORM_LONLAT || filter->from == FORM_XYZ);
        compute_single(filter->mapping, batch, inverse);
        widen_batch(batch);
    }
    else
    {
        compute_double(filter->mapping, batch, inverse);
    }
}

static void compute(void *user, size_t count)
{
    struct filter *const filter = user;
    const struct filter_options *const options = filter->options;
    struct batch *const batch = &filter->batch;
    batch->count = count;
    if (!options->inverse)
    {
        compute_grid(filter, batch, false);
    }
    if (options->cells != NULL)
    {
        compute_cells(options, batch);
    }
    else if (options->pixels != NULL)
    {
        compute_pixels(options, batch);
    }
    else
    {
        compute_mapping(filter, batch);
    }
    if (options->inverse)
    {
        compute_grid(filter, batch, true);
    }
}

/* By contract a point that passed our checks has one; if a mapping breaks it, nobody is misled. */
static bool has_result(const struct filter *filter, size_t index)
{
    const struct batch *const batch = &filter->batch;
    switch (filter->to)
    {
    case FORM_CELL:
        return batch->cell[index] != CM_NO_CELL;
    case FORM_PIXEL:
        return batch->pixel[index] != CM_HEALPIX_NO_PIXEL;
    default:
        return batch->face[index] != CM_NO_FACE && !isnan(batch->a[index]) &&
               !isnan(batch->b[index]);
    }
}

static double parameter_called(const cm_mapping *mapping, const char *name)
{
    const cm_mapping_info *const info = cm_mapping_describe(mapping);
    size_t index = 0;
    while (index < info->parameter_count && strcmp(info->parameter[index].name, name) != 0)
    {
        index++;
    }
    return cm_mapping_parameter(mapping, index);
}

/* Of a point that is one, but not on the map. */
static void complain_of_result(struct filter *filter, size_t index)
{
    if (filter->to == FORM_DISC && cm_mapping_describe(filter->mapping)->kind == CM_KIND_AZIMUTHAL)
    {
        complain(filter, index, "the direction is not in the field of view of %g degrees",
                 parameter_called(filter->mapping, "full") == 1
                     ? 360
                     : parameter_called(filter->mapping, "fov"));
    }
    else
    {
        complain(filter, index, "the mapping gives no result here");
    }
}

static bool check_result(void *user, size_t index)
{
    struct filter *const filter = user;
    if (!has_result(filter, index))
    {
        complain_of_result(filter, index);
        return false;
    }
    return true;
}

/* ------------------------------------------------------------------------------- parsing */

/* The functions that take the numbers of a line into place index of the batch; false after a
 * complaint. */
static bool take_lonlat(struct filter *filter, size_t index, const double value[3])
{
    double direction[3];
    if (!isfinite(value[0]))
    {
        complain(filter, index, "the longitude, %g, is not finite", value[0]);
        return false;
    }
    if (!(fabs(value[1]) <= 90))
    {
        complain(filter, index, "the latitude, %.17g, is not in [-90, 90]", value[1]);
        return false;
    }
    if (filter->options->cells != NULL && cm_cell_grid_is_s2(filter->options->cells))
    {
        /* by way of radians, as S2LatLng::FromDegrees goes */
        const double radians = 3.14159265358979323846 / 180;
        cm_direction_from_lonlat(radians * value[0], radians * value[1], direction);
    }
    else
    {
        degrees_to_direction(value[0], value[1], direction);
    }
    filter->batch.a[index] = direction[0];
    filter->batch.b[index] = direction[1];
    filter->batch.c[index] = direction[2];
    return true;
}

static bool take_xyz(struct filter *filter, size_t index, const double value[3])
{
    if (!isfinite(value[0]) || !isfinite(value[1]) || !isfinite(value[2]))
    {
        complain(filter, index, "the direction, %g %g %g, is not finite", value[0], value[1],
                 value[2]);
        return false;
    }
    if (value[0] == 0 && value[1] == 0 && value[2] == 0)
    {
        complain(filter, index, "the direction 0 0 0 has no length");
        return false;
    }
    filter->batch.a[index] = value[0];
    filter->batch.b[index] = value[1];
    filter->batch.c[index] = value[2];
    return true;
}

/* Two coordinates, whose names are the letters of a text of two. */
static bool take_square(struct filter *filter, size_t index, const double value[2],
                        const char *names)
{
    for (int i = 0; i < 2; i++)
    {
        if (!(fabs(value[i]) <= 1 + 1e-9))
        {
            complain(filter, index, "%c, %.17g, is not in [-1, 1]", names[i], value[i]);
            return false;
        }
    }
    filter->batch.a[index] = value[0];
    filter->batch.b[index] = value[1];
    return true;
}

/* What is written in float may be outside by its rounding. */
static bool take_disc(struct filter *filter, size_t index, const double value[2])
{
    const double tolerance = filter->options->single ? 1e-6 : 1e-9;
    if (!(hypot(value[0], value[1]) <= 1 + tolerance))
    {
        complain(filter, index, "the point %.17g %.17g is outside the disc", value[0], value[1]);
        return false;
    }
    filter->batch.a[index] = value[0];
    filter->batch.b[index] = value[1];
    return true;
}

static bool take_face(struct filter *filter, size_t index, const double value[3])
{
    if (!(value[0] >= 0 && value[0] <= 5) || value[0] != floor(value[0]))
    {
        complain(filter, index, "the face, %.17g, is not a whole number from 0 to 5", value[0]);
        return false;
    }
    filter->batch.face[index] = (uint8_t)value[0];
    return take_square(filter, index, value + 1, "uv");
}

static bool take_cell(struct filter *filter, size_t index, const char *word, size_t length)
{
    char token[CM_CELL_TOKEN_SIZE + 1];
    char message[200];
    /* what is too long stays too long */
    const size_t kept = length < sizeof token - 1 ? length : sizeof token - 1;
    memcpy(token, word, kept);
    token[kept] = '\0';
    if (cm_cell_parse(token, &filter->batch.cell[index], message, sizeof message) != CM_OK)
    {
        complain(filter, index, "%s", message);
        return false;
    }
    if (filter->batch.cell[index] == CM_NO_CELL)
    {
        complain(filter, index, "'%s' means no cell", token);
        return false;
    }
    return true;
}

static bool take_pixel(struct filter *filter, size_t index, const char *word, size_t length)
{
    const int64_t count = cm_healpix_pixel_count(filter->options->pixels);
    int64_t pixel = 0;
    size_t digits = 0;
    while (digits < length && word[digits] >= '0' && word[digits] <= '9' && pixel < count)
    {
        pixel = 10 * pixel + (word[digits++] - '0');
    }
    if (length == 0 || digits < length || pixel >= count)
    {
        complain(filter, index, "'%.*s' is not a pixel, from 0 to %" PRId64,
                 (int)(length < 40 ? length : 40), word, count - 1);
        return false;
    }
    filter->batch.pixel[index] = pixel;
    return true;
}

static bool take_word(void *user, size_t index, const char *word, size_t length)
{
    struct filter *const filter = user;
    return filter->from == FORM_CELL ? take_cell(filter, index, word, length)
                                     : take_pixel(filter, index, word, length);
}

static void clear_point(void *user, size_t index)
{
    struct batch *const batch = &((struct filter *)user)->batch;
    batch->face[index] = 0;
    batch->cell[index] = CM_NO_CELL;
    batch->pixel[index] = 0;
    batch->a[index] = 1;
    batch->b[index] = 0;
    batch->c[index] = 0;
}

static bool take_point(void *user, size_t index, const double value[LINE_NUMBERS_MAX])
{
    struct filter *const filter = user;
    switch (filter->from)
    {
    case FORM_LONLAT:
        return take_lonlat(filter, index, value);
    case FORM_XYZ:
        return take_xyz(filter, index, value);
    case FORM_FACE:
        return take_face(filter, index, value);
    case FORM_DISC:
        return take_disc(filter, index, value);
    case FORM_SQUARE:
        return take_square(filter, index, value, "xy");
    case FORM_CELL:
    case FORM_PIXEL:
        break;
    }
    return false;
}

/* What is read and what is written, by the kind of the mapping. */
static void choose_forms(struct filter *filter)
{
    const form sphere = filter->options->xyz ? FORM_XYZ : FORM_LONLAT;
    form from = sphere;
    form to = FORM_FACE;
    switch (cm_mapping_describe(filter->mapping)->kind)
    {
    case CM_KIND_CUBE:
        break;
    case CM_KIND_DISC_SQUARE:
        from = FORM_DISC;
        to = FORM_SQUARE;
        break;
    case CM_KIND_AZIMUTHAL:
        to = FORM_DISC;
        break;
    case CM_KIND_LAYOUT:
        to = FORM_SQUARE;
        break;
    }
    to = filter->options->cells != NULL    ? FORM_CELL
         : filter->options->pixels != NULL ? FORM_PIXEL
                                           : to;
    filter->from = filter->options->inverse ? to : from;
    filter->to = filter->options->inverse ? from : to;
}

static const struct line_work work_on_numbers = {.clear = clear_point,
                                                 .take = take_point,
                                                 .compute = compute,
                                                 .check = check_result,
                                                 .put = put_result};

static const struct line_work work_on_words = {.clear = clear_point,
                                               .take_word = take_word,
                                               .compute = compute,
                                               .check = check_result,
                                               .put = put_result};

/* So many nan. */
static const char *const no_numbers[] = {"", "nan", "nan nan", "nan nan nan"};

bool filter_points(const struct filter_options *options, const cm_mapping *mapping,
                   const cm_streams *streams, const char *name, cm_failure *failure)
{
    struct filter *const filter = calloc(1, sizeof *filter);
    if (filter == NULL)
    {
        return fail(failure, EXIT_FAILURE, "no memory");
    }
    filter->options = options;
    filter->mapping = mapping;
    choose_forms(filter);
    const bool words = filter->from == FORM_CELL || filter->from == FORM_PIXEL;
    filter->lines.work = words ? &work_on_words : &work_on_numbers;
    filter->lines.user = filter;
    filter->lines.name = name;
    filter->lines.in = streams->in;
    filter->lines.out = streams->out;
    filter->lines.err = streams->err;
    filter->lines.failure = failure;
    filter->lines.digits = options->digits;
    filter->lines.count = forms[filter->from].count;
    filter->lines.wanted = forms[filter->from].text;
    filter->lines.bad = no_numbers[forms[filter->to].count];
    const bool all_good = line_filter_run(&filter->lines);
    free(filter);
    return all_good;
}
