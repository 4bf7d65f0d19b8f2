/* SPDX-License-Identifier: MIT
 *
 * Killpack 2016, sections 3.3 to 3.5: from a fine picture of depths to a coarse cloud of points.
 */
#include "modules/memory/checked_size.h"
#include "texel_canvas.h"
#include "vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- options ---- */

static uint32_t or_else(uint32_t given, uint32_t standard)
{
    return given != 0 ? given : standard > 0 ? standard : 1;
}

static int is_possible(const cm_texel_options *o)
{
    return o->field > 0.0 && o->field < PI && o->columns <= o->width && o->rows <= o->height &&
           o->window <= o->width && o->window <= o->height && o->oversampling <= 16 &&
           (double)o->width * o->height < 0x1p31 &&
           (o->spacing == CM_TEXEL_EVEN_SPACES || o->spacing == CM_TEXEL_EVEN_ANGLES) &&
           o->unit > 0.0 && o->unit <= 1e9;
}

cm_status cm_texel_completed(const cm_texel_options *options, cm_texel_options *complete)
{
    if (options == NULL || options->size != sizeof *options)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_texel_options made = *options;
    made.width = or_else(made.width, 1024);
    made.height = or_else(made.height, made.width);
    made.columns = or_else(made.columns, made.width / 16);
    made.rows = or_else(made.rows, made.height / 16);
    const uint32_t least = made.width < made.height ? made.width : made.height;
    made.window = or_else(made.window, least < 16 ? least : 16);
    made.oversampling = or_else(made.oversampling, 1);
    made.unit = made.unit == 0.0 ? 1.0 : made.unit;
    if (!is_possible(&made))
    {
        return CM_ERROR_RANGE;
    }
    *complete = made;
    return CM_OK;
}

cm_status cm_texel_complete(cm_texel_options *options)
{
    return cm_texel_completed(options, options);
}

double cm_texel_focal(const cm_texel_options *complete)
{
    return 0.5 * complete->width / tan(0.5 * complete->field);
}

/* ---- eq. 3.1 ---- */

cm_status cm_texel_linearise(double near, double far, size_t n, const float *z_buffer, float *depth)
{
    if (n > 0 && (z_buffer == NULL || depth == NULL))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!(near > 0.0 && near < far))
    {
        return CM_ERROR_RANGE;
    }
    /* eq. 3.1 divided by 2 far, so that far may be infinite: what is at 1 is at far then, whatever that is */
    const double ratio = near / far;
    for (size_t i = 0; i < n; i++)
    {
        const double z = (double)z_buffer[i];
        depth[i] = z >= 0.0 && z <= 1.0 ? (float)(near / ((1.0 - z) + z * ratio)) : (float)NAN;
    }
    return CM_OK;
}

/* ---- places ---- */

/* Sample i of n on z = 1, where the canvas goes from -half to half. */
static double place_of(cm_texel_spacing spacing, double half, uint32_t i, uint32_t n)
{
    const double part = (2.0 * i + 1.0) / n - 1.0;
    return spacing == CM_TEXEL_EVEN_ANGLES ? tan(part * atan(half)) : part * half;
}

static void make_places(const cm_texel_options *options, uint32_t side, uint32_t n, double *place,
                        double *ray)
{
    const double focal = cm_texel_focal(options);
    const double half = 0.5 * side / focal;
    for (uint32_t i = 0; i < n; i++)
    {
        const double at = place_of(options->spacing, half, i, n);
        if (ray != NULL)
        {
            ray[i] = at;
        }
        if (place != NULL)
        {
            place[i] = 0.5 * side + focal * at;
        }
    }
}

cm_status cm_texel_places(const cm_texel_options *options, double *column, double *row, double *x,
                          double *y)
{
    cm_texel_options complete;
    const cm_status status = cm_texel_completed(options, &complete);
    if (status == CM_OK)
    {
        make_places(&complete, complete.width, complete.columns, column, x);
        make_places(&complete, complete.height, complete.rows, row, y);
    }
    return status;
}

cm_status cm_texel_make_grid(const cm_texel_options *complete, cm_texel_grid *grid)
{
    const size_t columns = complete->columns, rows = complete->rows;
    grid->column = cm_array_of(columns + rows, 2 * sizeof *grid->column);
    if (grid->column == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    grid->x = grid->column + columns;
    grid->row = grid->x + columns;
    grid->y = grid->row + rows;
    make_places(complete, complete->width, complete->columns, grid->column, grid->x);
    make_places(complete, complete->height, complete->rows, grid->row, grid->y);
    return CM_OK;
}

void cm_texel_drop_grid(cm_texel_grid *grid)
{
    free(grid->column);
}

/* ---- means ---- */

/* The pixels of a window around a place, moved so that the canvas has it whole, and the parts of the first and the last. */
typedef struct span
{
    size_t first, last;
    double first_part, last_part;
} span;

static span span_of(double place, uint32_t window, uint32_t side)
{
    const double begin = fmin(fmax(place - 0.5 * window, 0.0), (double)(side - window));
    const double end = begin + window;
    /* a place beside a whole number by rounding has no part of one pixel more */
    const double from = floor(begin + 1e-9), to = ceil(end - 1e-9);
    span made = {(size_t)from, (size_t)to - 1, fmin(from + 1.0 - begin, 1.0),
                 fmin(end - (to - 1.0), 1.0)};
    return made;
}

static double part_of(const span *of, size_t i)
{
    return i == of->first ? of->first_part : i == of->last ? of->last_part : 1.0;
}

static int is_measured(float depth)
{
    return depth > 0.0f && !isinf(depth);
}

static float mean_of(const float *canvas, uint32_t width, const span *columns, const span *rows)
{
    double sum = 0.0, weight = 0.0;
    for (size_t j = rows->first; j <= rows->last; j++)
    {
        const double part = part_of(rows, j);
        for (size_t i = columns->first; i <= columns->last; i++)
        {
            const float depth = canvas[j * width + i];
            const double counts = is_measured(depth) ? part * part_of(columns, i) : 0.0;
            sum += counts > 0.0 ? counts * (double)depth : 0.0;
            weight += counts;
        }
    }
    return weight > 0.0 ? (float)(sum / weight) : (float)NAN;
}

void cm_texel_take_means(const cm_texel_options *complete, const cm_texel_grid *grid,
                         const float *canvas, float *depth)
{
    for (uint32_t j = 0; j < complete->rows; j++)
    {
        const span across = span_of(grid->row[j], complete->window, complete->height);
        for (uint32_t i = 0; i < complete->columns; i++)
        {
            const span along = span_of(grid->column[i], complete->window, complete->width);
            *depth++ = mean_of(canvas, complete->width, &along, &across);
        }
    }
}

cm_status cm_texel_sample(const cm_texel_options *options, const float *canvas, float *depth)
{
    cm_texel_options complete;
    cm_texel_grid grid;
    cm_status status = cm_texel_completed(options, &complete);
    if (status != CM_OK || canvas == NULL || depth == NULL)
    {
        return status != CM_OK ? status : CM_ERROR_ARGUMENT;
    }
    status = cm_texel_make_grid(&complete, &grid);
    if (status == CM_OK)
    {
        cm_texel_take_means(&complete, &grid, canvas, depth);
        cm_texel_drop_grid(&grid);
    }
    return status;
}

/* ---- points ---- */

static void put(float *array, size_t at, double value)
{
    if (array != NULL)
    {
        array[at] = (float)value;
    }
}

static void make_point(const cm_texel_image *image, size_t at, double x, double y, float depth)
{
    const double z = is_measured(depth) ? (double)depth : (double)NAN;
    put(image->depth, at, z);
    put(image->point[0], at, x * z);
    put(image->point[1], at, y * z);
    put(image->point[2], at, z);
    put(image->range, at, z * sqrt(1.0 + x * x + y * y)); /* Pythagoras, of the point */
}

void cm_texel_take_points(const cm_texel_options *complete, const cm_texel_grid *grid,
                          const float *depth, const cm_texel_image *image)
{
    size_t at = 0;
    for (uint32_t j = 0; j < complete->rows; j++)
    {
        for (uint32_t i = 0; i < complete->columns; i++)
        {
            make_point(image, at, grid->x[i], grid->y[j], depth[at]);
            put(image->uv[0], at, grid->column[i] / complete->width);
            put(image->uv[1], at, grid->row[j] / complete->height);
            at++;
        }
    }
}

cm_status cm_texel_points(const cm_texel_options *options, const float *depth,
                          const cm_texel_image *image)
{
    cm_texel_options complete;
    cm_texel_grid grid;
    cm_status status = cm_texel_completed(options, &complete);
    if (status != CM_OK || depth == NULL || image == NULL || image->size != sizeof *image)
    {
        return status != CM_OK ? status : CM_ERROR_ARGUMENT;
    }
    status = cm_texel_make_grid(&complete, &grid);
    if (status == CM_OK)
    {
        cm_texel_take_points(&complete, &grid, depth, image);
        cm_texel_drop_grid(&grid);
    }
    return status;
}

/* ---- matrices ---- */

cm_status cm_texel_matrix(const cm_pose *base, const cm_pose *scan, double unit, double matrix[16])
{
    if (base == NULL || scan == NULL || matrix == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (cm_pose_check(base) != CM_OK || cm_pose_check(scan) != CM_OK)
    {
        return CM_ERROR_CAMERA;
    }
    if (!(unit > 0.0) || isinf(unit))
    {
        return CM_ERROR_RANGE;
    }
    static const double identity[16] = {1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0,
                                        0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0};
    memcpy(matrix, identity, sizeof identity);
    if (memcmp(base, scan, sizeof *base) == 0)
    {
        return CM_OK;
    }
    cm_pose between;
    cm_pose_between(base, scan, &between);
    for (int i = 0; i < 3; i++)
    {
        for (int j = 0; j < 3; j++)
        {
            /* a pose's rotation is from the world, here base, to the camera: its transpose goes back */
            matrix[4 * j + i] = between.rotation.row[i][j];
        }
        matrix[4 * i + 3] = unit * between.position[i];
    }
    return CM_OK;
}
