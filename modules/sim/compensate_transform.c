/* SPDX-License-Identifier: MIT */
#include <cubemap/compensate.h>

#include <math.h>

#include "compensate_warp.h"

/* The rows above, of and below a pixel, and the columns beside it; at borders the border's own. */
typedef struct window
{
    const float *row[3];
    size_t column[3];
} window;

static window window_at(cm_picture_size size, const float *picture, uint32_t column, uint32_t row)
{
    const size_t above = row == 0 ? 0 : row - 1;
    const size_t below = row + 1 < size.height ? row + 1 : row;
    window w = {
        {picture + above * size.width, picture + (size_t)row * size.width,
         picture + below * size.width},
        {column == 0 ? 0 : column - 1, column, column + 1 < size.width ? column + 1 : column}};
    return w;
}

static double value_in(const window *w, int row, int column)
{
    return (double)w->row[row][w->column[column]];
}

/* Sobel's operator, divided by 8: of a slope of 1 a pixel it is 1. */
static double gradient_at(const window *w)
{
    const double across = value_in(w, 0, 2) - value_in(w, 0, 0) +
                          2.0 * (value_in(w, 1, 2) - value_in(w, 1, 0)) + value_in(w, 2, 2) -
                          value_in(w, 2, 0);
    const double down = value_in(w, 2, 0) - value_in(w, 0, 0) +
                        2.0 * (value_in(w, 2, 1) - value_in(w, 0, 1)) + value_in(w, 2, 2) -
                        value_in(w, 0, 2);
    return sqrt(across * across + down * down) / 8.0;
}

static uint8_t census_at(const window *w)
{
    const float own = w->row[1][w->column[1]];
    unsigned bits = 0, bit = 1;
    for (int k = 0; k < 9; k++)
    {
        if (k != 4)
        {
            bits |= w->row[k / 3][w->column[k % 3]] < own ? bit : 0;
            bit <<= 1;
        }
    }
    return (uint8_t)bits;
}

static cm_status check_pictures(uint32_t width, uint32_t height, const void *from, const void *to)
{
    if (from == NULL || to == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    return cm_is_picture_size(width, height) ? CM_OK : CM_ERROR_RANGE;
}

cm_status cm_channel_gradient(uint32_t width, uint32_t height, const float *picture,
                              float *gradient)
{
    const cm_status status = check_pictures(width, height, picture, gradient);
    for (uint32_t row = 0; row < height && status == CM_OK; row++)
    {
        for (uint32_t column = 0; column < width; column++)
        {
            const window w = window_at((cm_picture_size){width, height}, picture, column, row);
            gradient[(size_t)row * width + column] = (float)gradient_at(&w);
        }
    }
    return status;
}

cm_status cm_channel_census(uint32_t width, uint32_t height, const float *picture, uint8_t *census)
{
    const cm_status status = check_pictures(width, height, picture, census);
    for (uint32_t row = 0; row < height && status == CM_OK; row++)
    {
        for (uint32_t column = 0; column < width; column++)
        {
            const window w = window_at((cm_picture_size){width, height}, picture, column, row);
            census[(size_t)row * width + column] = census_at(&w);
        }
    }
    return status;
}
