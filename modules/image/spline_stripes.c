/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "spline_stripes.h"
#include "filter_set.h"
#include "past_caches.h"
#include "spline_holes.h"

#include <cubemap/threads.h>

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* Rows of the border above and below. */
#define BEYOND_MOST (CM_SPLINE_START + CM_FILTER_TAPS_MAX / 2)

/* What recursions have reached, of CM_BUNDLE_COLUMNS columns. */
#define STATE ((size_t)2 * CM_BUNDLE_COLUMNS)

/* A row beyond an edge has the pixels of another one, so many columns further. */
typedef struct row_copy
{
    int32_t further;
    int32_t same;
} row_copy;

struct cm_spline_stripes
{
    const cm_surface *surface;
    const cm_filter_set *set;
    cm_level pictures;
    cm_level_reader reader;
    cm_padded shape; /* of all coefficients at once, without memory */
    size_t floats;   /* of a row with its border */
    uint32_t rows;   /* of a stripe inside the plane */
    unsigned count;
    int32_t below;
    row_copy copy[2 * BEYOND_MOST];  /* above, then below, where columns come again */
    float *frame;                    /* else the plane's border */
    cm_padded side[CM_BORDER_SIDES]; /* which lies there */
    float *window_memory;
    float *window; /* begins where a line of memory does */
    float *forth;  /* before each stripe */
    float *back;
    unsigned plane; /* under way, and its stripe */
    unsigned stripe;
    int32_t first; /* rows that are made, from the first one of the window on */
    int32_t end;
    cm_level level;
    int may_have_holes;
    atomic_int has_holes;
    atomic_int failed;
};

/* ---- sizes ---- */

static int32_t begin_of(const cm_spline_stripes *stripes, unsigned stripe)
{
    return stripe == 0 ? -stripes->shape.beyond : (int32_t)(stripe * stripes->rows);
}

static int32_t end_of(const cm_spline_stripes *stripes, unsigned stripe)
{
    return stripe + 1 == stripes->count ? (int32_t)stripes->shape.height + stripes->shape.beyond
                                        : (int32_t)((stripe + 1) * stripes->rows);
}

static size_t bundles_of(const cm_spline_stripes *stripes)
{
    return (stripes->floats + CM_BUNDLE_COLUMNS - 1) / CM_BUNDLE_COLUMNS;
}

static int has_period(const cm_surface *surface)
{
    return surface->period == (double)surface->width;
}

/* The numbers of a border that stands alone. */
static size_t frame_floats(const cm_spline_stripes *stripes)
{
    const cm_padded *shape = &stripes->shape;
    return has_period(stripes->surface)
               ? 0
               : 2 * ((size_t)shape->beyond * stripes->floats +
                      (size_t)shape->beside * shape->channels * shape->height);
}

static size_t window_floats(const cm_spline_stripes *stripes)
{
    const size_t rows = stripes->rows + 2 * (size_t)stripes->shape.beyond + (size_t)stripes->below;
    return cm_size_product(rows, (size_t)stripes->shape.row);
}

static size_t state_floats(const cm_spline_stripes *stripes)
{
    return bundles_of(stripes) * STATE;
}

static size_t all_floats(const cm_spline_stripes *stripes)
{
    const size_t states = cm_size_product(state_floats(stripes), stripes->count + (size_t)1);
    return cm_size_sum(cm_size_sum(frame_floats(stripes), window_floats(stripes)), states);
}

/* The highest stripes that memory has room for; rows of a bundle are filtered together. */
static void choose_rows(cm_spline_stripes *stripes, size_t bytes)
{
    const uint32_t least = 4 * CM_BUNDLE_ROWS;
    const uint32_t height = stripes->shape.height;
    uint32_t rows = (height + least - 1) / least * least;
    for (;; rows -= CM_BUNDLE_ROWS)
    {
        stripes->rows = rows;
        stripes->count = (height + rows - 1) / rows;
        if (rows <= least || all_floats(stripes) <= bytes / sizeof(float))
        {
            return;
        }
    }
}

static void lay_out(cm_spline_stripes *stripes, const cm_surface *surface, const cm_values *values,
                    int32_t below, size_t bytes)
{
    stripes->surface = surface;
    stripes->below = below;
    cm_padded_shape(surface, surface->width, surface->height, values->working, BEYOND_MOST,
                    BEYOND_MOST, CM_PADDED_PIXELS, &stripes->shape);
    stripes->floats =
        (surface->width + 2 * (size_t)stripes->shape.beside) * stripes->shape.channels;
    choose_rows(stripes, bytes);
}

size_t cm_spline_bytes(const cm_surface *surface, const cm_values *values)
{
    cm_padded shape;
    cm_padded_shape(surface, surface->width, surface->height, values->working, BEYOND_MOST,
                    BEYOND_MOST, CM_PADDED_PIXELS, &shape);
    return shape.plane_floats * shape.planes * sizeof(float);
}

size_t cm_spline_stripes_bytes(const cm_surface *surface, const cm_values *values, int32_t below,
                               size_t bytes)
{
    cm_spline_stripes stripes = {0};
    lay_out(&stripes, surface, values, below, bytes);
    return all_floats(&stripes) * sizeof(float);
}

int cm_spline_stripes_are_one(const cm_surface *surface, const cm_values *values, int32_t below,
                              size_t bytes)
{
    cm_spline_stripes stripes = {0};
    lay_out(&stripes, surface, values, below, bytes);
    return stripes.count == 1;
}

unsigned cm_spline_stripes_count(const cm_spline_stripes *stripes)
{
    return stripes->count;
}

unsigned cm_spline_stripes_of(const cm_spline_stripes *stripes, int32_t row)
{
    const uint32_t stripe = row < 0 ? 0 : (uint32_t)row / stripes->rows;
    return stripe < stripes->count ? stripe : stripes->count - 1;
}

/* ---- life ---- */

/* The pixels of a row beyond an edge; 0 if they are no pixels. */
static int find_copies(const cm_surface *surface, int32_t beyond, row_copy *copy)
{
    const double pixel[2] = {1.0, 1.0};
    for (int32_t k = 0; k < 2 * beyond; k++)
    {
        const int32_t row = k < beyond ? k - beyond : (int32_t)surface->height + k - beyond;
        if (!cm_surface_same_row(surface, pixel, row, &copy[k].further, &copy[k].same))
        {
            return 0;
        }
    }
    return 1;
}

int cm_spline_stripes_suit(const cm_surface *surface)
{
    row_copy copy[2 * BEYOND_MOST];
    const uint32_t least = 4 * BEYOND_MOST;
    const int is_cube = surface->mapping != NULL && surface->planes == 6;
    if (surface->has_gaps || surface->width < least || surface->height < least)
    {
        return 0;
    }
    return is_cube || (has_period(surface) && find_copies(surface, BEYOND_MOST, copy));
}

static void lay_side(cm_padded *side, const cm_padded *shape, float *memory, size_t row,
                     int32_t column, int32_t line)
{
    *side = *shape;
    side->row = (ptrdiff_t)row;
    for (unsigned plane = 0; plane < shape->planes; plane++)
    {
        side->first[plane] = memory - line * side->row - column * side->pixel;
    }
}

/* Rows above and below, columns to the left and to the right, of whatever plane is under way. */
static void lay_frame(cm_spline_stripes *stripes)
{
    const cm_padded *shape = &stripes->shape;
    const int32_t height = (int32_t)shape->height;
    const size_t rows = (size_t)shape->beyond * stripes->floats;
    const size_t ends = (size_t)shape->beside * shape->channels;
    float *left = stripes->frame + 2 * rows;
    lay_side(&stripes->side[0], shape, stripes->frame, stripes->floats, -shape->beside,
             -shape->beyond);
    lay_side(&stripes->side[1], shape, stripes->frame + rows, stripes->floats, -shape->beside,
             height);
    lay_side(&stripes->side[2], shape, left, ends, -shape->beside, 0);
    lay_side(&stripes->side[3], shape, left + ends * shape->height, ends, (int32_t)shape->width, 0);
}

static float *allocate(size_t floats)
{
    return cm_array_of(floats > 0 ? floats : 1, sizeof(float));
}

static cm_status make_room(cm_spline_stripes *stripes)
{
    stripes->frame = allocate(frame_floats(stripes));
    stripes->window_memory = allocate(cm_size_sum(window_floats(stripes), CM_LINE / sizeof(float)));
    stripes->forth = allocate(cm_size_product(state_floats(stripes), stripes->count));
    stripes->back = allocate(state_floats(stripes));
    if (stripes->frame == NULL || stripes->window_memory == NULL || stripes->forth == NULL ||
        stripes->back == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    stripes->window = cm_next_line(stripes->window_memory);
    lay_frame(stripes);
    return CM_OK;
}

cm_status cm_spline_stripes_create(const cm_surface *surface, const cm_image *pictures,
                                   const cm_values *values, const cm_sample_set *set, int32_t below,
                                   size_t bytes, unsigned threads, cm_spline_stripes **stripes)
{
    cm_spline_stripes *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    lay_out(made, surface, values, below, bytes);
    made->set = cm_filter_set_find(set->name);
    made->may_have_holes = values->type == CM_PIXEL_HALF || values->type == CM_PIXEL_FLOAT;
    atomic_init(&made->has_holes, 0);
    atomic_init(&made->failed, CM_OK);
    cm_status status =
        cm_level_of_pictures(surface, pictures, values, set, 0, 0, NULL, threads, &made->pictures);
    status = status == CM_OK ? make_room(made) : status;
    if (status != CM_OK)
    {
        cm_spline_stripes_destroy(made);
        return status;
    }
    made->reader = cm_level_reader_of(&made->pictures, surface, set);
    if (has_period(surface))
    {
        find_copies(surface, made->shape.beyond, made->copy);
    }
    cm_spline_look_at(&made->shape, values, &made->level);
    *stripes = made;
    return CM_OK;
}

void cm_spline_stripes_destroy(cm_spline_stripes *stripes)
{
    if (stripes != NULL)
    {
        cm_level_free(&stripes->pictures);
        free(stripes->frame);
        free(stripes->window_memory);
        free(stripes->forth);
        free(stripes->back);
        free(stripes);
    }
}

/* ---- rows ---- */

static void copy_part(const cm_spline_stripes *stripes, unsigned side, int32_t column, int32_t row,
                      int32_t count, float *to)
{
    const cm_padded *from = &stripes->side[side];
    memcpy(to, from->first[stripes->plane] + row * from->row + column * from->pixel,
           (size_t)count * (size_t)from->pixel * sizeof *to);
}

/* A row of pixels with its border. */
static void load_row(const cm_spline_stripes *stripes, int32_t row, float *to)
{
    const cm_padded *shape = &stripes->shape;
    const int32_t width = (int32_t)shape->width, height = (int32_t)shape->height;
    const int32_t beside = shape->beside, wide = width + 2 * beside;
    const int is_inside = row >= 0 && row < height;
    if (has_period(stripes->surface))
    {
        const int32_t k = row < 0 ? row + shape->beyond : row - height + shape->beyond;
        const row_copy none = {0, row};
        const row_copy at = is_inside ? none : stripes->copy[k];
        cm_level_read(&stripes->reader, 0, at.further - beside, at.same, wide, to);
    }
    else if (!is_inside)
    {
        copy_part(stripes, row < 0 ? 0 : 1, -beside, row, wide, to);
    }
    else
    {
        copy_part(stripes, 2, -beside, row, beside, to);
        cm_level_read(&stripes->reader, stripes->plane, 0, row, width, to + beside * shape->pixel);
        copy_part(stripes, 3, width, row, beside, to + (beside + width) * shape->pixel);
    }
    memset(to + stripes->floats, 0, ((size_t)shape->row - stripes->floats) * sizeof *to);
}

static int has_hole(const float *from, size_t n)
{
    int found = 0;
    for (size_t i = 0; i < n; i++)
    {
        found |= !(fabsf(from[i]) <= CM_SPLINE_MOST);
    }
    return found;
}

/* Rows along which coefficients are made. */
static void do_rows(size_t begin, size_t end, void *user)
{
    cm_spline_stripes *stripes = user;
    const ptrdiff_t stride = stripes->shape.row;
    const int32_t first = stripes->first, end_row = stripes->end;
    int found = 0;
    float *memory = allocate(CM_BUNDLE_ROWS * stripes->floats + CM_LINE / sizeof(float));
    if (memory == NULL)
    {
        atomic_store(&stripes->failed, CM_ERROR_MEMORY);
        return;
    }
    float *desk = cm_next_line(memory);
    for (size_t at = begin / CM_TASK; at < end / CM_TASK; at++)
    {
        const int32_t row = first + (int32_t)at * CM_BUNDLE_ROWS;
        const int32_t rows = end_row - row < CM_BUNDLE_ROWS ? end_row - row : CM_BUNDLE_ROWS;
        float *to = stripes->window + (row - first) * stride;
        for (int32_t i = 0; i < rows; i++)
        {
            load_row(stripes, row + i, to + i * stride);
            found |= stripes->may_have_holes && has_hole(to + i * stride, stripes->floats);
        }
        stripes->set->spline_rows(to, (size_t)rows, stride, stripes->floats,
                                  stripes->shape.channels, desk);
    }
    if (found)
    {
        atomic_store(&stripes->has_holes, 1);
    }
    free(memory);
}

/* Rows from `first` on, to the first ones of the window. */
static void make_rows(cm_spline_stripes *stripes, int32_t first, int32_t end, unsigned threads)
{
    const size_t bundles = ((size_t)(end - first) + CM_BUNDLE_ROWS - 1) / CM_BUNDLE_ROWS;
    stripes->first = first;
    stripes->end = end;
    cm_run_threads(threads, bundles * CM_TASK, CM_TASK, do_rows, stripes);
}

/* ---- columns ---- */

/* A bundle of the columns of rows that have been made; is_begin: are they the first ones of the plane that go this way? */
static void go(const cm_spline_stripes *stripes, size_t bundle, cm_spline_way way, int is_begin,
               float *state)
{
    const size_t first = bundle * CM_BUNDLE_COLUMNS;
    const size_t left = stripes->floats - first;
    stripes->set->spline_columns_part(
        stripes->window + first, left < CM_BUNDLE_COLUMNS ? left : CM_BUNDLE_COLUMNS,
        (size_t)(stripes->end - stripes->first), stripes->shape.row, way, is_begin, state);
}

/* What is reached after a stripe is what the next one begins with. */
static void do_pass(size_t begin, size_t end, void *user)
{
    const cm_spline_stripes *stripes = user;
    float *reached = stripes->forth + (stripes->stripe + 1) * state_floats(stripes);
    const int is_begin = stripes->first == begin_of(stripes, 0);
    for (size_t at = begin / CM_TASK; at < end / CM_TASK; at++)
    {
        go(stripes, at, CM_SPLINE_PASS, is_begin, reached + at * STATE);
    }
}

static void do_both(size_t begin, size_t end, void *user)
{
    const cm_spline_stripes *stripes = user;
    const unsigned stripe = stripes->stripe;
    float *forth = stripes->forth + stripe * state_floats(stripes);
    for (size_t at = begin / CM_TASK; at < end / CM_TASK; at++)
    {
        go(stripes, at, CM_SPLINE_FORTH, stripe == 0, forth + at * STATE);
        go(stripes, at, CM_SPLINE_BACK, stripe + 1 == stripes->count, stripes->back + at * STATE);
    }
}

/* The walk down a stripe. One thread alone does a bundle of rows after the other, which stay in a near cache. */
static void pass_stripe(cm_spline_stripes *stripes, unsigned stripe, unsigned threads)
{
    const int32_t end = end_of(stripes, stripe);
    const size_t floats = state_floats(stripes);
    int32_t row = begin_of(stripes, stripe);
    const int32_t step = threads == 1 ? CM_BUNDLE_ROWS : end - row;
    stripes->stripe = stripe;
    if (stripe > 0)
    {
        memcpy(stripes->forth + (stripe + 1) * floats, stripes->forth + stripe * floats,
               floats * sizeof *stripes->forth);
    }
    for (; row < end; row += step)
    {
        make_rows(stripes, row, end - row < step ? end : row + step, threads);
        cm_run_threads(threads, bundles_of(stripes) * CM_TASK, CM_TASK, do_pass, stripes);
    }
}

/* ---- stripes ---- */

cm_status cm_spline_stripes_begin(cm_spline_stripes *stripes, unsigned plane, unsigned threads)
{
    stripes->plane = plane;
    if (!has_period(stripes->surface))
    {
        cm_padded_border_alone(&stripes->shape, stripes->surface, stripes->set, &stripes->reader,
                               plane, stripes->side, threads);
    }
    for (unsigned i = 0; i + 1 < stripes->count && !cm_spline_stripes_have_holes(stripes); i++)
    {
        pass_stripe(stripes, i, threads);
    }
    stripes->stripe = stripes->count;
    return (cm_status)atomic_load(&stripes->failed);
}

/* The first rows of the window become those below a new stripe. */
static void keep_below(const cm_spline_stripes *stripes, int32_t rows)
{
    const size_t row = (size_t)stripes->shape.row;
    memmove(stripes->window + (size_t)rows * row, stripes->window,
            (size_t)stripes->below * row * sizeof(float));
}

static void look_at(cm_spline_stripes *stripes)
{
    cm_level_plane *at = &stripes->level.plane[stripes->plane];
    const cm_padded *shape = &stripes->shape;
    const int32_t first = begin_of(stripes, stripes->stripe);
    const float *origin = stripes->window - first * shape->row + shape->beside * shape->pixel;
    at->pixels = (const unsigned char *)origin;
    at->end = (const unsigned char *)(stripes->window + window_floats(stripes));
}

cm_status cm_spline_stripes_next(cm_spline_stripes *stripes, unsigned threads)
{
    const int is_last = stripes->stripe == stripes->count;
    stripes->stripe--;
    if (!is_last)
    {
        keep_below(stripes, end_of(stripes, stripes->stripe) - begin_of(stripes, stripes->stripe));
    }
    make_rows(stripes, begin_of(stripes, stripes->stripe), end_of(stripes, stripes->stripe),
              threads);
    cm_run_threads(threads, bundles_of(stripes) * CM_TASK, CM_TASK, do_both, stripes);
    look_at(stripes);
    return (cm_status)atomic_load(&stripes->failed);
}

int cm_spline_stripes_have_holes(const cm_spline_stripes *stripes)
{
    return atomic_load(&stripes->has_holes);
}

const cm_level *cm_spline_stripes_level(const cm_spline_stripes *stripes)
{
    return &stripes->level;
}
