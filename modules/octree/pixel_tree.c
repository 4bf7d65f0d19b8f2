/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "pixel_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- cones ---- */

static void ray_of(const cm_pixel_tree *tree, size_t pixel, double ray[3])
{
    for (int axis = 0; axis < 3; axis++)
    {
        ray[axis] = (double)tree->ray[axis][pixel];
    }
}

static double chord_between(const double a[3], const double b[3])
{
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return 0.5 * sqrt(x * x + y * y + z * z);
}

static double angle_of(double chord)
{
    return 2.0 * asin(chord < 1.0 ? chord : 1.0);
}

static double angle_between(const double a[3], const double b[3])
{
    return angle_of(chord_between(a, b));
}

double cm_pixel_angle_beside(const cm_pixel_tree *tree, uint32_t column, uint32_t row, int *border)
{
    const uint32_t first = row / tree->face_rows * tree->face_rows;
    double own[3], most = 0.0;
    ray_of(tree, (size_t)row * tree->width + column, own);
    for (int y = -1; y <= 1; y++)
    {
        for (int x = -1; x <= 1; x++)
        {
            const int64_t c = (int64_t)column + x, r = (int64_t)row + y;
            if (c < 0 || c >= (int64_t)tree->width || r < (int64_t)first ||
                r >= (int64_t)first + (int64_t)tree->face_rows)
            {
                *border |= tree->faces == 1 ? CM_BORDER_OF_PICTURE : 0;
                continue;
            }
            double beside[3];
            ray_of(tree, (size_t)r * tree->width + (size_t)c, beside);
            const double chord = chord_between(own, beside);
            *border |= isnan(chord) ? CM_BORDER_OF_RAYS : 0;
            most = chord > most ? chord : most;
        }
    }
    return angle_of(most);
}

/* A cell around directions with angles. */
typedef struct cone_sum
{
    double axis[3];
    double angle;
    size_t count;
} cone_sum;

static void close_cone(cm_pixel_cell *cell, const cone_sum *sum)
{
    cell->is_empty = sum->count == 0;
    for (int axis = 0; axis < 3; axis++)
    {
        cell->axis[axis] = (float)sum->axis[axis];
    }
    const double angle = sum->angle * (1.0 + 1e-5) + 1e-5;
    cell->cosine = angle < 3.14159 ? (float)cos(angle) : -1.0f;
    cell->sine = angle < 3.14159 ? (float)sin(angle) : 0.0f;
}

static int normalise(double axis[3])
{
    const double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    for (int i = 0; i < 3; i++)
    {
        axis[i] = length > 1e-9 ? axis[i] / length : i == 2;
    }
    return length > 1e-9;
}

static void make_tile(const cm_pixel_tree *tree, uint32_t column, uint32_t row, uint32_t last_row,
                      cm_pixel_cell *cell)
{
    const uint32_t last_column =
        column + CM_TILE_EDGE < tree->width ? column + CM_TILE_EDGE : tree->width;
    cone_sum sum = {{0}, 0.0, 0};
    int border = 0;
    for (uint32_t r = row; r < last_row; r++)
    {
        for (uint32_t c = column; c < last_column; c++)
        {
            double ray[3];
            ray_of(tree, (size_t)r * tree->width + c, ray);
            const int is_ray = !isnan(ray[0]);
            sum.count += (size_t)is_ray;
            border |= is_ray ? 0 : CM_BORDER_OF_PICTURE;
            for (int axis = 0; is_ray && axis < 3; axis++)
            {
                sum.axis[axis] += ray[axis];
            }
        }
    }
    const int has_axis = normalise(sum.axis);
    sum.angle = has_axis || sum.count == 0 ? 0.0 : 3.2;
    for (uint32_t r = row; r < last_row; r++)
    {
        for (uint32_t c = column; c < last_column; c++)
        {
            double ray[3];
            ray_of(tree, (size_t)r * tree->width + c, ray);
            if (!isnan(ray[0]))
            {
                int own_border = 0;
                const double beside = cm_pixel_angle_beside(tree, c, r, &own_border);
                /* what the rays beside would be is not known */
                const double angle =
                    own_border & CM_BORDER_OF_RAYS ? 3.2 : angle_between(sum.axis, ray) + beside;
                border |= own_border;
                sum.angle = fmax(sum.angle, angle);
            }
        }
    }
    cell->is_border = border != 0;
    close_cone(cell, &sum);
}

static double cell_angle(const cm_pixel_cell *cell)
{
    return atan2((double)cell->sine, (double)cell->cosine);
}

static void make_cell(const cm_pixel_level *below, uint32_t column, uint32_t row, uint32_t last_row,
                      cm_pixel_cell *cell)
{
    cone_sum sum = {{0}, 0.0, 0};
    cell->is_border = 0;
    for (int pass = 0; pass < 2; pass++)
    {
        for (uint32_t r = row; r < last_row; r++)
        {
            for (uint32_t c = column; c < column + 2 && c < below->width; c++)
            {
                const cm_pixel_cell *part = &below->cell[(size_t)r * below->width + c];
                const double axis[3] = {(double)part->axis[0], (double)part->axis[1],
                                        (double)part->axis[2]};
                cell->is_border |= part->is_border;
                if (part->is_empty)
                {
                    continue;
                }
                sum.count += pass == 0;
                for (int i = 0; pass == 0 && i < 3; i++)
                {
                    sum.axis[i] += axis[i];
                }
                if (pass == 1)
                {
                    sum.angle = fmax(sum.angle, angle_between(sum.axis, axis) + cell_angle(part));
                }
            }
        }
        if (pass == 0 && !normalise(sum.axis) && sum.count > 0)
        {
            sum.angle = 3.2;
        }
    }
    close_cone(cell, &sum);
}

/* ---- making it ---- */

static uint32_t divided(uint32_t a, uint32_t by)
{
    return (uint32_t)(((uint64_t)a + by - 1) / by);
}

static cm_status take_memory(cm_pixel_tree *tree)
{
    uint32_t width = divided(tree->width, CM_TILE_EDGE),
             rows = divided(tree->face_rows, CM_TILE_EDGE);
    size_t cells = 0;
    tree->levels = 0;
    for (;;)
    {
        tree->level[tree->levels].width = width;
        tree->level[tree->levels].height = rows * tree->faces;
        cells += (size_t)width * rows * tree->faces;
        tree->levels++;
        if (width == 1 && rows == 1)
        {
            break;
        }
        width = divided(width, 2);
        rows = divided(rows, 2);
    }
    const size_t apart = (size_t)tree->width * tree->height + 2 * CM_PIXEL_SLACK;
    tree->memory = calloc(cells, sizeof *tree->memory);
    tree->rays = calloc(apart, 3 * sizeof *tree->rays);
    if (tree->memory == NULL || tree->rays == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    for (size_t axis = 0; axis < 3; axis++)
    {
        tree->ray[axis] = tree->rays + axis * apart + CM_PIXEL_SLACK;
    }
    cm_pixel_cell *next = tree->memory;
    for (int level = 0; level < tree->levels; level++)
    {
        tree->level[level].cell = next;
        next += (size_t)tree->level[level].width * tree->level[level].height;
    }
    return CM_OK;
}

static cm_status take_rays(const cm_camera *camera, cm_pixel_tree *tree)
{
    const double centre = cm_camera_describe(camera)->pixel_centre;
    double *row_of = cm_array_of(tree->width, 5 * sizeof *row_of);
    if (row_of == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    double *const column = row_of, *const row = column + tree->width, *const x = row + tree->width,
                  *const y = x + tree->width, *const z = y + tree->width;
    for (uint32_t r = 0; r < tree->height; r++)
    {
        for (uint32_t c = 0; c < tree->width; c++)
        {
            column[c] = c + centre;
            row[c] = r + centre;
        }
        cm_camera_ray_array(camera, tree->width, column, row, x, y, z);
        for (uint32_t c = 0; c < tree->width; c++)
        {
            const double length = sqrt(x[c] * x[c] + y[c] * y[c] + z[c] * z[c]);
            const size_t pixel = (size_t)r * tree->width + c;
            tree->ray[0][pixel] = (float)(x[c] / length);
            tree->ray[1][pixel] = (float)(y[c] / length);
            tree->ray[2][pixel] = (float)(z[c] / length);
        }
    }
    free(row_of);
    return CM_OK;
}

static void make_cones(cm_pixel_tree *tree)
{
    for (int level = 0; level < tree->levels; level++)
    {
        const cm_pixel_level *at = &tree->level[level];
        const uint32_t rows = at->height / tree->faces;
        const uint32_t below_rows =
            level == 0 ? tree->face_rows : tree->level[level - 1].height / tree->faces;
        const uint32_t step = level == 0 ? CM_TILE_EDGE : 2;
        for (uint32_t row = 0; row < at->height; row++)
        {
            const uint32_t face = row / rows, first = face * below_rows + row % rows * step;
            const uint32_t end = (face + 1) * below_rows,
                           last = first + step < end ? first + step : end;
            for (uint32_t column = 0; column < at->width; column++)
            {
                cm_pixel_cell *cell = &at->cell[(size_t)row * at->width + column];
                if (level == 0)
                {
                    make_tile(tree, column * step, first, last, cell);
                }
                else
                {
                    make_cell(&tree->level[level - 1], column * step, first, last, cell);
                }
            }
        }
    }
}

cm_status cm_pixel_tree_make(const cm_camera *camera, cm_pixel_tree *tree)
{
    const cm_camera_options *options = cm_camera_describe(camera);
    *tree = (cm_pixel_tree){.width = options->width, .height = options->height};
    tree->faces = options->mapping != NULL && options->height > options->width ? 6 : 1;
    tree->face_rows = options->height / tree->faces;
    cm_status status = take_memory(tree);
    status = status == CM_OK ? take_rays(camera, tree) : status;
    if (status != CM_OK)
    {
        cm_pixel_tree_clear(tree);
        return status;
    }
    make_cones(tree);
    return CM_OK;
}

void cm_pixel_tree_clear(cm_pixel_tree *tree)
{
    free(tree->memory);
    free(tree->rays);
    memset(tree, 0, sizeof *tree);
}

/* ---- what pixels say ---- */

static void fill_tiles(const cm_pixel_tree *tree, const float *least, const float *most)
{
    const cm_pixel_level *at = &tree->level[0];
    const uint32_t rows = at->height / tree->faces;
    for (uint32_t row = 0; row < at->height; row++)
    {
        const uint32_t face = row / rows,
                       first = face * tree->face_rows + row % rows * CM_TILE_EDGE;
        const uint32_t end = (face + 1) * tree->face_rows;
        for (uint32_t column = 0; column < at->width; column++)
        {
            cm_pixel_cell *cell = &at->cell[(size_t)row * at->width + column];
            cell->least = INFINITY;
            cell->most = -INFINITY;
            for (uint32_t r = first; r < first + CM_TILE_EDGE && r < end; r++)
            {
                for (uint32_t c = column * CM_TILE_EDGE;
                     c < (column + 1) * CM_TILE_EDGE && c < tree->width; c++)
                {
                    const size_t pixel = (size_t)r * tree->width + c;
                    cell->least = least[pixel] < cell->least ? least[pixel] : cell->least;
                    cell->most = most[pixel] > cell->most ? most[pixel] : cell->most;
                }
            }
        }
    }
}

void cm_pixel_tree_fill(cm_pixel_tree *tree, const float *least, const float *most)
{
    fill_tiles(tree, least, most);
    for (int level = 1; level < tree->levels; level++)
    {
        const cm_pixel_level *at = &tree->level[level], *below = &tree->level[level - 1];
        const uint32_t rows = at->height / tree->faces, below_rows = below->height / tree->faces;
        for (uint32_t row = 0; row < at->height; row++)
        {
            const uint32_t first = row / rows * below_rows + row % rows * 2;
            const uint32_t end = (row / rows + 1) * below_rows;
            for (uint32_t column = 0; column < at->width; column++)
            {
                cm_pixel_cell *cell = &at->cell[(size_t)row * at->width + column];
                cell->least = INFINITY;
                cell->most = -INFINITY;
                for (uint32_t r = first; r < first + 2 && r < end; r++)
                {
                    for (uint32_t c = 2 * column; c < 2 * column + 2 && c < below->width; c++)
                    {
                        const cm_pixel_cell *part = &below->cell[(size_t)r * below->width + c];
                        cell->least = part->least < cell->least ? part->least : cell->least;
                        cell->most = part->most > cell->most ? part->most : cell->most;
                    }
                }
            }
        }
    }
}

/* ---- asking ---- */

typedef struct cone_question
{
    const cm_pixel_tree *tree;
    const float *axis;
    float cosine;
    float sine;
    cm_cone_bounds bounds;
} cone_question;

/* Do two cones meet? cos(a + b) <= cos of the angle between the axes; those of more than half a turn together always do. */
static int meet(const cone_question *question, const cm_pixel_cell *cell)
{
    const float between = question->axis[0] * cell->axis[0] + question->axis[1] * cell->axis[1] +
                          question->axis[2] * cell->axis[2];
    const float both_sine = question->sine * cell->cosine + question->cosine * cell->sine;
    const float both_cosine = question->cosine * cell->cosine - question->sine * cell->sine;
    return both_sine < 0.0f || question->cosine <= -1.0f || cell->cosine <= -1.0f ||
           between >= both_cosine - 1e-6f;
}

static void ask(cone_question *question, int level, uint32_t column, uint32_t row)
{
    const cm_pixel_tree *tree = question->tree;
    const cm_pixel_level *at = &tree->level[level];
    const cm_pixel_cell *cell = &at->cell[(size_t)row * at->width + column];
    if (cell->is_empty || !meet(question, cell))
    {
        return;
    }
    cm_cone_bounds *bounds = &question->bounds;
    const int tells_nothing = !bounds->is_empty && cell->least >= bounds->least &&
                              cell->most <= bounds->most && (bounds->is_border || !cell->is_border);
    if (tells_nothing)
    {
        return;
    }
    if (level == 0 || cell->cosine > question->cosine)
    {
        bounds->least = cell->least < bounds->least ? cell->least : bounds->least;
        bounds->most = cell->most > bounds->most ? cell->most : bounds->most;
        bounds->is_border |= cell->is_border;
        bounds->is_empty = 0;
        return;
    }
    const cm_pixel_level *below = &tree->level[level - 1];
    const uint32_t rows = at->height / tree->faces, below_rows = below->height / tree->faces;
    const uint32_t first = row / rows * below_rows + row % rows * 2,
                   end = (row / rows + 1) * below_rows;
    for (uint32_t r = first; r < first + 2 && r < end; r++)
    {
        for (uint32_t c = 2 * column; c < 2 * column + 2 && c < below->width; c++)
        {
            ask(question, level - 1, c, r);
        }
    }
}

cm_cone_bounds cm_pixel_tree_ask(const cm_pixel_tree *tree, const float axis[3], float cosine,
                                 float sine)
{
    cone_question question = {tree, axis, cosine, sine, {INFINITY, -INFINITY, 0, 1}};
    for (uint32_t face = 0; face < tree->faces; face++)
    {
        ask(&question, tree->levels - 1, 0, face);
    }
    return question.bounds;
}
