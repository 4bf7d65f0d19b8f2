/* SPDX-License-Identifier: MIT */
#include "hull_mask.h"

#include <math.h>
#include <stdlib.h>

#include "interleave.h"
#include "picture.h"
#include "seen_tree.h"

/* What a float is off by, at most, of its size; and how many such errors a pixel's place may have. */
#define FLOAT_ERROR 0x1p-24
#define ERRORS 16.0

/* Where directions are steeper nothing is said of pixels without asking the camera. */
#define STEEPEST 1e4

/* Borders of pixels are moved by so many pixels, for what doubles are off. */
#define BORDER 1e-6

/* ---- making them ---- */

static int is_plain(const cm_camera_options *lens)
{
    int is = lens->mapping == NULL;
    for (size_t i = 0; i < sizeof lens->distortion / sizeof *lens->distortion; i++)
    {
        is = is && lens->distortion[i] == 0.0;
    }
    const double columns = fabs(lens->cx) + lens->width, rows = fabs(lens->cy) + lens->height;
    return is && columns < STEEPEST * fabs(lens->fx) && rows < STEEPEST * fabs(lens->fy) &&
           columns < 1e6 && rows < 1e6;
}

/* The bits of a row, the first of them at the second word. */
static void fill_row(const cm_image *image, size_t row, uint32_t *bits)
{
    const int are_bytes =
        image->type == CM_PIXEL_U8 && image->channels == 1 && image->pixel_stride <= 1;
    const uint8_t *bytes = are_bytes ? cm_picture_at(image, 0, row) : NULL;
    for (size_t first = 0; first < image->width; first += 32)
    {
        const size_t count = image->width - first < 32 ? image->width - first : 32;
        uint32_t word = 0;
        for (size_t i = 0; i < count; i++)
        {
            const int is =
                are_bytes ? bytes[first + i] != 0 : cm_picture_is_set(image, first + i, row);
            word |= (uint32_t)is << i;
        }
        bits[1 + first / 32] = word;
    }
}

static void fill_sums(cm_hull_mask *mask)
{
    const size_t columns = mask->squares[0];
    for (size_t v = 1; v < mask->squares[1]; v++)
    {
        uint32_t sum = 0;
        for (size_t u = 1; u < columns; u++)
        {
            const size_t column = CM_HULL_SQUARE * (u - 1);
            for (size_t row = CM_HULL_SQUARE * (v - 1);
                 row < CM_HULL_SQUARE * v && row < mask->lens->height; row++)
            {
                const uint32_t word = mask->bits[(row + 1) * mask->stride + 1 + column / 32];
                sum += cm_bit_count(word >> column % 32 & (cm_bits_below(CM_HULL_SQUARE)));
            }
            mask->sums[v * columns + u] = sum + mask->sums[(v - 1) * columns + u];
        }
    }
}

static void fill_table(cm_hull_mask *mask)
{
    const cm_camera_options *lens = mask->lens;
    cm_hull_table *table = &mask->table;
    *table = (cm_hull_table){
        .bits = mask->bits,
        .stride = (int32_t)mask->stride,
        .width = (float)lens->width,
        .height = (float)lens->height,
        .focal = {(float)lens->fx, (float)lens->fy},
        .centre = {(float)(lens->cx - lens->pixel_centre), (float)(lens->cy - lens->pixel_centre)},
        .outside_survives = mask->outside_survives};
    float *to[3] = {table->x, table->y, table->z};
    for (unsigned cell = 0; cell < 512; cell++)
    {
        unsigned place[3];
        cm_divide_3(cell, place);
        for (int axis = 0; axis < 3; axis++)
        {
            const double *row = mask->view->pose.rotation.row[axis];
            to[axis][cell] = (float)(mask->map->edge *
                                     (row[0] * place[0] + row[1] * place[1] + row[2] * place[2]));
        }
    }
}

cm_status cm_hull_mask_make(const cm_view *view, const cm_octree_options *map, int outside_survives,
                            cm_hull_mask *mask)
{
    const cm_camera_options *lens = cm_camera_describe(view->camera);
    mask->view = view;
    mask->lens = lens;
    mask->map = map;
    mask->outside_survives = outside_survives;
    mask->is_plain = is_plain(lens);
    mask->stride = (size_t)lens->width / 32 + 3;
    mask->squares[0] = ((size_t)lens->width + CM_HULL_SQUARE - 1) / CM_HULL_SQUARE + 1;
    mask->squares[1] = ((size_t)lens->height + CM_HULL_SQUARE - 1) / CM_HULL_SQUARE + 1;
    mask->bits = calloc(mask->stride * ((size_t)lens->height + 2), sizeof *mask->bits);
    mask->sums = calloc(mask->squares[0] * mask->squares[1], sizeof *mask->sums);
    if (mask->bits == NULL || mask->sums == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    for (size_t row = 0; row < lens->height; row++)
    {
        fill_row(&view->color, row, mask->bits + (row + 1) * mask->stride);
    }
    fill_sums(mask);
    fill_table(mask);
    return CM_OK;
}

void cm_hull_mask_drop(cm_hull_mask *mask)
{
    free(mask->bits);
    free(mask->sums);
    mask->bits = NULL;
    mask->sums = NULL;
}

/* ---- cubes ---- */

/* The bounds of the pixels that points of a box may fall on: the corners' do. */
static void bounds_of(const cm_hull_mask *mask, const double middle[3], double half,
                      double least[2], double most[2])
{
    const cm_camera_options *lens = mask->lens;
    const double(*row)[3] = mask->view->pose.rotation.row;
    least[0] = least[1] = INFINITY;
    most[0] = most[1] = -INFINITY;
    for (int corner = 0; corner < 8; corner++)
    {
        const double x = corner & 1 ? half : -half, y = corner & 2 ? half : -half,
                     z = corner & 4 ? half : -half;
        const double at[3] = {middle[0] + row[0][0] * x + row[0][1] * y + row[0][2] * z,
                              middle[1] + row[1][0] * x + row[1][1] * y + row[1][2] * z,
                              middle[2] + row[2][0] * x + row[2][1] * y + row[2][2] * z};
        const double inverse = 1.0 / at[2];
        const double place[2] = {lens->fx * at[0] * inverse, lens->fy * at[1] * inverse};
        for (int k = 0; k < 2; k++)
        {
            least[k] = place[k] < least[k] ? place[k] : least[k];
            most[k] = place[k] > most[k] ? place[k] : most[k];
        }
    }
}

/* Squares from the one that has pixel `least` to the one behind that of pixel `most`, within the picture. */
static int squares_of(double least, double most, size_t pixels, size_t range[2])
{
    const double last = (double)pixels - 1.0;
    const double a = floor(least + 0.5 - BORDER), b = floor(most + 0.5 + BORDER);
    const double first = a > 0.0 ? a : 0.0, end = b < last ? b : last;
    if (!(first <= end))
    {
        range[0] = range[1] = 0;
        return 0;
    }
    range[0] = (size_t)first / CM_HULL_SQUARE;
    range[1] = (size_t)end / CM_HULL_SQUARE + 1;
    return a >= 0.0 && b <= last;
}

static size_t pixels_to(size_t square, size_t pixels)
{
    return square * CM_HULL_SQUARE < pixels ? square * CM_HULL_SQUARE : pixels;
}

static cm_hull_class class_of_bounds(const cm_hull_mask *mask, const double least[2],
                                     const double most[2])
{
    const size_t width = mask->lens->width, height = mask->lens->height, columns = mask->squares[0];
    size_t u[2], v[2];
    const double left = mask->lens->cx - mask->lens->pixel_centre;
    const double up = mask->lens->cy - mask->lens->pixel_centre;
    const int whole_columns = squares_of(least[0] + left, most[0] + left, width, u);
    const int whole_rows = squares_of(least[1] + up, most[1] + up, height, v);
    const int is_whole = whole_columns && whole_rows;
    const int is_seen = u[1] > 0 && v[1] > 0;
    const uint32_t *sums = mask->sums;
    const uint32_t inside = !is_seen
                                ? 0
                                : sums[v[1] * columns + u[1]] - sums[v[0] * columns + u[1]] -
                                      sums[v[1] * columns + u[0]] + sums[v[0] * columns + u[0]];
    const size_t area = !is_seen ? 0
                                 : (pixels_to(u[1], width) - pixels_to(u[0], width)) *
                                       (pixels_to(v[1], height) - pixels_to(v[0], height));
    if (inside == 0 && (is_whole || !mask->outside_survives || !is_seen))
    {
        return is_seen || !mask->outside_survives ? CM_HULL_OUTSIDE : CM_HULL_INSIDE;
    }
    return inside == area && (is_whole || mask->outside_survives) ? CM_HULL_INSIDE : CM_HULL_MIXED;
}

cm_hull_class cm_hull_classify(const cm_hull_mask *mask, const double middle[3], double half)
{
    double at[3], least[2], most[2];
    if (!mask->is_plain)
    {
        return CM_HULL_MIXED;
    }
    cm_pose_apply(&mask->view->pose, middle, at);
    const double *row = mask->view->pose.rotation.row[2];
    const double deep = half * (fabs(row[0]) + fabs(row[1]) + fabs(row[2]));
    const double size = fabs(at[0]) + fabs(at[1]) + fabs(at[2]) + 3.0 * half;
    if (at[2] + deep < -1e-9 * size)
    {
        return mask->outside_survives ? CM_HULL_INSIDE : CM_HULL_OUTSIDE;
    }
    if (!(at[2] - deep > 1e-6 * size))
    {
        return CM_HULL_MIXED;
    }
    bounds_of(mask, at, half, least, most);
    return class_of_bounds(mask, least, most);
}

/* ---- voxels ---- */

static int is_inside(const cm_hull_mask *mask, double column, double row)
{
    const double c = floor(column - mask->lens->pixel_centre + 0.5);
    const double r = floor(row - mask->lens->pixel_centre + 0.5);
    if (!(c >= 0.0 && c < mask->lens->width && r >= 0.0 && r < mask->lens->height))
    {
        return mask->outside_survives;
    }
    const size_t u = (size_t)c;
    return (int)(mask->bits[((size_t)r + 1) * mask->stride + 1 + u / 32] >> u % 32 & 1);
}

/* The centre of a voxel at a corner, one formula for all, since who asks on the border of two pixels has its rounding. */
static double centre_of(const cm_hull_mask *mask, int axis, int64_t corner)
{
    return mask->map->centre[axis] + ((double)corner + 0.5) * mask->map->edge;
}

/* Those of a word's voxels that are asked for, as the camera has them. */
static uint64_t ask_camera(const cm_hull_mask *mask, const int64_t corner[3], unsigned word,
                           uint64_t asked)
{
    double x[64], y[64], z[64], column[64], row[64];
    unsigned cells[64], count = 0;
    for (unsigned i = 0; i < 64; i++)
    {
        if (asked >> i & 1)
        {
            unsigned place[3];
            double at[3];
            cm_divide_3(64 * word + i, place);
            for (int axis = 0; axis < 3; axis++)
            {
                at[axis] = centre_of(mask, axis, corner[axis] + place[axis]);
            }
            cm_pose_apply(&mask->view->pose, at, at);
            x[count] = at[0];
            y[count] = at[1];
            z[count] = at[2];
            cells[count++] = i;
        }
    }
    uint64_t inside = 0;
    cm_camera_project_array(mask->view->camera, count, x, y, z, column, row);
    for (unsigned i = 0; i < count; i++)
    {
        inside |= (uint64_t)is_inside(mask, column[i], row[i]) << cells[i];
    }
    return inside;
}

/* How far off floats may be in pixels, for a block that begins there; what is above 0.5 is doubtful altogether. */
static double margin_of(const cm_hull_mask *mask, const double at[3])
{
    const double length = 7.0 * 1.7320508075688773 * mask->map->edge;
    const double near = at[2] - length;
    const double size = fabs(at[0]) + fabs(at[1]) + fabs(at[2]) + length;
    const double focal = fmax(fabs(mask->lens->fx), fabs(mask->lens->fy));
    const double centre = fmax(fabs(mask->lens->cx), fabs(mask->lens->cy)) + 1.0;
    const double steep = size / near;
    return near > 0.0 ? ERRORS * FLOAT_ERROR * (focal * steep * steep + centre) : INFINITY;
}

void cm_hull_carve_block(const cm_hull_mask *mask, const cm_hull_set *set, const int64_t corner[3],
                         uint64_t alive[8])
{
    const double first[3] = {centre_of(mask, 0, corner[0]), centre_of(mask, 1, corner[1]),
                             centre_of(mask, 2, corner[2])};
    double at[3];
    uint64_t doubtful[8] = {0}, before[8];
    cm_pose_apply(&mask->view->pose, first, at);
    const double margin = mask->is_plain ? margin_of(mask, at) : INFINITY;
    for (unsigned w = 0; w < 8; w++)
    {
        before[w] = alive[w];
        doubtful[w] = margin < 0.25 ? 0 : alive[w];
    }
    if (margin < 0.25)
    {
        const float start[3] = {(float)at[0], (float)at[1], (float)at[2]};
        set->carve(&mask->table, start, (float)margin, alive, doubtful);
    }
    for (unsigned w = 0; w < 8; w++)
    {
        if (doubtful[w] != 0)
        {
            alive[w] = (alive[w] & ~doubtful[w]) |
                       (before[w] & ask_camera(mask, corner, w, doubtful[w]) & doubtful[w]);
        }
    }
}
