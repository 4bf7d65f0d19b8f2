/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "round_faces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Cells are wider by so many of the side's pixels, since places in pictures are floats. */
#define CELL_MORE 0.03125

/* What a pixel reaches from its own centre is half of that to the pixels beside; where these lie further apart on one side than on the
 * other, more. */
#define REACH_INSIDE 0.625

/* At borders of pictures and faces, where nothing is known of what is beyond, it is an angle: twice the greatest to a pixel beside. Where
 * rays end, since a lens folds there, it is more: with the root of the distance from the fold up to 2.4 times that. */
#define REACH_BESIDE 2.0
#define REACH_OF_LAST 4.0

/* Pixels that reach farther, as the sine of an angle, may fall on all. */
#define REACH_MOST 0.3

/* Directions whose cosine to a side's middle is less are beyond its corners, by more than such an angle. */
#define COSINE_LEAST 0.16

/* ---- pixels on sides ---- */

/* What pixels at borders reach, as sines of angles: negative at the picture's border. 0: pixels are on all sides; NaN: there is no
 * ray. */
typedef struct pixel_reaches
{
    const cm_pixel_tree *tree;
    float *sine;
    float (*span)
        [4]; /* of each on a side that is made: from and to along the first axis, and along the second; NaN: nowhere */
} pixel_reaches;

/* Columns and rows of cells. */
typedef struct cell_box
{
    uint32_t first[2];
    uint32_t end[2];
} cell_box;

static int is_inside(const cm_pixel_tree *tree, uint32_t column, uint32_t row)
{
    const uint32_t in_face = row % tree->face_rows;
    return column > 0 && column + 1 < tree->width && in_face > 0 && in_face + 1 < tree->face_rows;
}

static double reach_of(const cm_pixel_tree *tree, uint32_t column, uint32_t row, int *border)
{
    const double beside = cm_pixel_angle_beside(tree, column, row, border);
    const double part = *border & CM_BORDER_OF_RAYS ? REACH_OF_LAST : REACH_BESIDE;
    const double angle = part * beside + 1e-6;
    return beside > 0.0 && angle < REACH_MOST ? sin(angle) : 1.0;
}

/* Have a pixel inside and all beside it rays? */
static int has_rays_beside(const cm_pixel_tree *tree, size_t pixel)
{
    const float *const x = tree->ray[0] + pixel;
    const ptrdiff_t width = (ptrdiff_t)tree->width;
    float sum = 0.0f; /* a NaN stays */
    for (ptrdiff_t row = -width; row <= width; row += width)
    {
        sum += x[row - 1] + x[row] + x[row + 1];
    }
    return !isnan(sum);
}

static void find_reaches(pixel_reaches *reaches)
{
    const cm_pixel_tree *tree = reaches->tree;
    for (uint32_t row = 0; row < tree->height; row++)
    {
        for (uint32_t column = 0; column < tree->width; column++)
        {
            const size_t pixel = (size_t)row * tree->width + column;
            int border = 0;
            reaches->sine[pixel] = isnan(tree->ray[0][pixel]) ? NAN : 0.0f;
            if (!isnan(tree->ray[0][pixel]) &&
                !(is_inside(tree, column, row) && has_rays_beside(tree, pixel)))
            {
                const float sine = (float)reach_of(tree, column, row, &border);
                reaches->sine[pixel] = border != 0 ? -sine : sine;
            }
        }
    }
}

/* Along a side's axes, of the camera's: faces 0 and 1 look along +x and -x. */
static void to_side(const pixel_reaches *reaches, size_t pixel, int face, double on_side[3])
{
    const int ahead = face / 2;
    const double z = (double)reaches->tree->ray[ahead][pixel];
    on_side[0] = (double)reaches->tree->ray[(ahead + 1) % 3][pixel];
    on_side[1] = (double)reaches->tree->ray[(ahead + 2) % 3][pixel];
    on_side[2] = face % 2 ? -z : z;
}

/* From where to where a cone around a pixel's ray falls on a side, at distance 1: along each axis as far as a plane through the other
 * that touches the cone. */
static void span_of_cone(const double on_side[3], double sine, double span[2][2])
{
    for (int axis = 0; axis < 2; axis++)
    {
        const double z = on_side[2], at = on_side[axis] / z;
        const double part = sine / sqrt(on_side[axis] * on_side[axis] + z * z);
        const double wide = part < 0.999 ? part / sqrt(1.0 - part * part) : 1e3;
        const double below = 1.0 + at * wide, above = 1.0 - at * wide;
        span[axis][0] = below > 1e-3 ? (at - wide) / below : -1e3;
        span[axis][1] = above > 1e-3 ? (at + wide) / above : 1e3;
    }
}

/* The same of a pixel that has some all around; 0 if it is better to take its cone. */
static int span_of_pixel(const pixel_reaches *reaches, size_t pixel, int face,
                         const double on_side[3], double span[2][2])
{
    const size_t width = reaches->tree->width;
    const size_t beside[4] = {pixel - 1, pixel + 1, pixel - width, pixel + width};
    double most[2][2] = {{0.0, 0.0}, {0.0, 0.0}}; /* of those along rows and columns */
    const double own[2] = {on_side[0] / on_side[2], on_side[1] / on_side[2]};
    for (int i = 0; i < 4; i++)
    {
        double other[3];
        to_side(reaches, beside[i], face, other);
        if (!(other[2] > 0.5 * COSINE_LEAST))
        {
            return 0;
        }
        const double inverse = 1.0 / other[2];
        for (int axis = 0; axis < 2; axis++)
        {
            const double away = fabs(other[axis] * inverse - own[axis]);
            most[axis][i / 2] = away > most[axis][i / 2] ? away : most[axis][i / 2];
        }
    }
    for (int axis = 0; axis < 2; axis++)
    {
        const double reach = REACH_INSIDE * (most[axis][0] + most[axis][1]);
        span[axis][0] = own[axis] - reach;
        span[axis][1] = own[axis] + reach;
    }
    return 1;
}

/* From where to where on a side, at distance 1, a pixel may fall: 0 if nowhere. */
static int span_on_side(const pixel_reaches *reaches, size_t pixel, int face, double span[2][2])
{
    double sine = fabs((double)reaches->sine[pixel]), on_side[3];
    if (isnan(sine))
    {
        return 0;
    }
    if (sine > REACH_MOST)
    {
        span[0][0] = span[1][0] = -1e3;
        span[0][1] = span[1][1] = 1e3;
        return 1;
    }
    to_side(reaches, pixel, face, on_side);
    if (!(on_side[2] > COSINE_LEAST))
    {
        return 0;
    }
    if (sine > 0.0 || !span_of_pixel(reaches, pixel, face, on_side, span))
    {
        const size_t width = reaches->tree->width;
        int border = 0;
        if (!(sine > 0.0))
        {
            sine = reach_of(reaches->tree, (uint32_t)(pixel % width), (uint32_t)(pixel / width),
                            &border);
        }
        span_of_cone(on_side, sine, span);
    }
    return span[0][0] < CM_ROUND_SIDE && span[0][1] > -CM_ROUND_SIDE &&
           span[1][0] < CM_ROUND_SIDE && span[1][1] > -CM_ROUND_SIDE;
}

/* Where all pixels fall on a side; NaN, NaN if none does. */
typedef struct side_span
{
    double at[2][2];
} side_span;

static side_span find_spans(const pixel_reaches *reaches, int face, double most)
{
    const size_t pixels = (size_t)reaches->tree->width * reaches->tree->height;
    side_span all = {{{NAN, NAN}, {NAN, NAN}}};
    for (size_t pixel = 0; pixel < pixels; pixel++)
    {
        double span[2][2];
        float *to = reaches->span[pixel];
        to[0] = NAN;
        if (!span_on_side(reaches, pixel, face, span))
        {
            continue;
        }
        for (int axis = 0; axis < 2; axis++)
        {
            const double from = span[axis][0] > -most ? span[axis][0] : -most,
                         end = span[axis][1] < most ? span[axis][1] : most;
            to[2 * axis] = (float)from;
            to[2 * axis + 1] = (float)end;
            all.at[axis][0] = from > all.at[axis][0] ? all.at[axis][0] : from;
            all.at[axis][1] = end < all.at[axis][1] ? all.at[axis][1] : end;
        }
    }
    return all;
}

/* ---- cells ---- */

static void describe_side(cm_view_desk *desk, double focal, const side_span *span)
{
    cm_view_table *table = &desk->table;
    double size[2];
    for (int axis = 0; axis < 2; axis++)
    {
        const double first = span->at[axis][0] * focal - 1.0;
        table->focal[axis] = (float)focal;
        table->centre[axis] = (float)(-first - 0.5);
        size[axis] = 2.0 * ceil((span->at[axis][1] * focal + 1.0 - first) / 2.0);
    }
    desk->width = table->width = (uint32_t)size[0];
    desk->height = table->height = (uint32_t)size[1];
}

static uint32_t cell_of(double place, uint32_t cells)
{
    const double cell = floor(0.5 * place);
    return cell < 0.0 ? 0 : cell < (double)cells ? (uint32_t)cell : cells;
}

/* The cells that a pixel may fall on; none if it falls nowhere. */
static cell_box box_of(const cm_round_face *face, const pixel_reaches *reaches, size_t pixel)
{
    const cm_window_level *cells = &face->desk.table.level[1];
    const uint32_t size[2] = {cells->width, cells->height};
    const float *span = reaches->span[pixel];
    cell_box box = {{0, 0}, {0, 0}};
    if (isnan(span[0]))
    {
        return box;
    }
    for (int axis = 0; axis < 2; axis++)
    {
        const double focal = (double)face->desk.table.focal[axis],
                     centre = (double)face->desk.table.centre[axis] + 0.5;
        box.first[axis] = cell_of((double)span[2 * axis] * focal + centre - CELL_MORE, size[axis]);
        const uint32_t last =
            cell_of((double)span[2 * axis + 1] * focal + centre + CELL_MORE, size[axis]);
        box.end[axis] = last < size[axis] ? last + 1 : size[axis];
    }
    return box;
}

/* Runs of cells as pixels come in their order: counted while there is no room for them. */
typedef struct run_writer
{
    cm_round_face *face;
    uint32_t *count; /* of runs of each cell */
    uint32_t *end;   /* behind the last pixel of each cell; 0: none */
} run_writer;

static void add_pixel(run_writer *writer, size_t cell, uint32_t pixel, int begins_row)
{
    const int goes_on = writer->end[cell] == pixel && pixel > 0 && !begins_row;
    if (!goes_on)
    {
        writer->count[cell]++;
    }
    if (writer->face->run != NULL)
    {
        cm_pixel_run *run = &writer->face->run[writer->face->start[cell] + writer->count[cell] - 1];
        *run = goes_on ? (cm_pixel_run){run->first, run->count + 1} : (cm_pixel_run){pixel, 1};
    }
    writer->end[cell] = pixel + 1;
}

/* A pixel, and those beside one at a border whose centres have no ray: parts of them may have some, up to where a lens folds. */
typedef struct pixel_group
{
    size_t count;
    uint32_t pixel[9];
} pixel_group;

static pixel_group group_of(const pixel_reaches *reaches, size_t pixel)
{
    const cm_pixel_tree *tree = reaches->tree;
    pixel_group group = {1, {(uint32_t)pixel}};
    if (!(reaches->sine[pixel] < 0.0f))
    {
        return group;
    }
    const int64_t column = (int64_t)(pixel % tree->width),
                  in_face = (int64_t)(pixel / tree->width) % tree->face_rows;
    for (int64_t down = -1; down <= 1; down++)
    {
        for (int64_t right = -1; right <= 1; right++)
        {
            const int is_there = column + right >= 0 && column + right < tree->width &&
                                 in_face + down >= 0 && in_face + down < tree->face_rows;
            const size_t beside = (size_t)((int64_t)pixel + down * tree->width + right);
            if (is_there && isnan(tree->ray[0][beside]))
            {
                group.pixel[group.count++] = (uint32_t)beside;
            }
        }
    }
    return group;
}

static void add_to_cell(run_writer *writer, const pixel_group *group, size_t cell, int begins_row)
{
    for (size_t i = 0; i < group->count; i++)
    {
        add_pixel(writer, cell, group->pixel[i], begins_row || i > 0);
    }
}

static void add_pixels(run_writer *writer, const pixel_reaches *reaches)
{
    cm_round_face *face = writer->face;
    const size_t width = face->desk.table.level[1].width;
    const cm_pixel_tree *tree = reaches->tree;
    for (size_t pixel = 0; pixel < (size_t)tree->width * tree->height; pixel++)
    {
        const cell_box box = box_of(face, reaches, pixel);
        const pixel_group group = group_of(reaches, pixel);
        for (uint32_t row = box.first[1]; row < box.end[1]; row++)
        {
            for (uint32_t column = box.first[0]; column < box.end[0]; column++)
            {
                const size_t cell = row * width + column;
                add_to_cell(writer, &group, cell, pixel % tree->width == 0);
                face->is_border[cell] |= (uint8_t)(reaches->sine[pixel] < 0.0f);
            }
        }
    }
}

static cm_status take_runs(cm_round_face *face, const pixel_reaches *reaches)
{
    const cm_window_level *level = &face->desk.table.level[1];
    const size_t cells = (size_t)level->width * level->height;
    face->start = cm_array_of(cells + 1, sizeof *face->start);
    face->is_border = calloc(cells, 1);
    run_writer writer = {face, calloc(cells, sizeof *writer.count),
                         calloc(cells, sizeof *writer.end)};
    int has_memory = face->start != NULL && face->is_border != NULL && writer.count != NULL &&
                     writer.end != NULL;
    if (has_memory)
    {
        add_pixels(&writer, reaches);
        size_t runs = 0;
        for (size_t cell = 0; cell < cells; cell++)
        {
            face->start[cell] = (uint32_t)runs;
            runs += writer.count[cell];
        }
        face->start[cells] = (uint32_t)runs;
        has_memory = runs < UINT32_MAX;
        face->run = has_memory ? cm_array_of(runs + 1, sizeof *face->run) : NULL;
        has_memory = face->run != NULL;
    }
    if (has_memory)
    {
        memset(writer.count, 0, cells * sizeof *writer.count);
        memset(writer.end, 0, cells * sizeof *writer.end);
        add_pixels(&writer, reaches);
    }
    free(writer.count);
    free(writer.end);
    return has_memory ? CM_OK : CM_ERROR_MEMORY;
}

/* Not many more cells of a side than a fourth of the pixels: where these are much smaller in some places than in others, cells are
 * not. */
static double focal_of(const pixel_reaches *reaches, double mean_pixel, const side_span *span)
{
    const double enough = 0.5 * reaches->tree->width * reaches->tree->height + 16384.0;
    const double wide = span->at[0][1] - span->at[0][0], high = span->at[1][1] - span->at[1][0];
    double focal = 1.0 / mean_pixel;
    while (0.25 * (wide * focal + 4.0) * (high * focal + 4.0) > enough)
    {
        focal *= 0.7;
    }
    return focal;
}

static cm_status make_face(const pixel_reaches *reaches, double mean_pixel, int which,
                           cm_round_face *face)
{
    const side_span span = find_spans(reaches, which, CM_ROUND_SIDE + 2.0 * mean_pixel);
    face->is_used = !isnan(span.at[0][0]);
    if (!face->is_used)
    {
        return CM_OK;
    }
    describe_side(&face->desk, focal_of(reaches, mean_pixel, &span), &span);
    return cm_view_cells_take(&face->desk) ? take_runs(face, reaches) : CM_ERROR_MEMORY;
}

cm_status cm_round_faces_make(const cm_pixel_tree *tree, double mean_pixel, cm_round_faces *faces)
{
    const size_t pixels = (size_t)tree->width * tree->height;
    pixel_reaches reaches = {tree, cm_array_of(pixels, sizeof *reaches.sine),
                             cm_array_of(pixels, sizeof *reaches.span)};
    memset(faces, 0, sizeof *faces);
    cm_status status = reaches.sine == NULL || reaches.span == NULL ? CM_ERROR_MEMORY : CM_OK;
    if (status == CM_OK)
    {
        find_reaches(&reaches);
    }
    for (int which = 0; status == CM_OK && which < CM_ROUND_FACES; which++)
    {
        status = make_face(&reaches, mean_pixel, which, &faces->face[which]);
    }
    free(reaches.sine);
    free(reaches.span);
    if (status != CM_OK)
    {
        cm_round_faces_clear(faces);
    }
    return status;
}

void cm_round_faces_clear(cm_round_faces *faces)
{
    for (int which = 0; which < CM_ROUND_FACES; which++)
    {
        cm_round_face *face = &faces->face[which];
        cm_view_desk_clear(&face->desk);
        free(face->start);
        free(face->run);
        free(face->is_border);
    }
    memset(faces, 0, sizeof *faces);
}
