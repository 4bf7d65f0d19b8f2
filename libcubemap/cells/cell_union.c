/* SPDX-License-Identifier: MIT
 *
 * Sets of cells: sorted, none in another, no four quarters of one cell.
 */
#include "cell_shape.h"

#include <stdlib.h>

int cm_cell_compare(const void *a, const void *b)
{
    cm_cell left = *(const cm_cell *)a;
    cm_cell right = *(const cm_cell *)b;
    return left < right ? -1 : left > right;
}

int cm_cell_are_quarters(const cm_cell *four)
{
    int level = cm_cell_level(four[3]);
    cm_cell parent = cm_cell_parent(four[3], level - 1);
    for (int k = 0; k < 4; k++)
    {
        if (parent == CM_NO_CELL || four[k] != cm_cell_child(parent, k))
        {
            return 0;
        }
    }
    return 1;
}

size_t cm_cell_union_normalise(size_t n, cm_cell *cells)
{
    size_t kept = 0;
    if (n == 0 || cells == NULL)
    {
        return 0;
    }
    qsort(cells, n, sizeof *cells, cm_cell_compare);
    for (size_t i = 0; i < n; i++)
    {
        cm_cell cell = cells[i];
        if (!cm_cell_is_valid(cell) || (kept > 0 && cm_cell_contains(cells[kept - 1], cell)))
        {
            continue;
        }
        /* a cell's number is in the middle of those of what is in it */
        while (kept > 0 && cm_cell_contains(cell, cells[kept - 1]))
        {
            kept--;
        }
        cells[kept++] = cell;
        while (kept >= 4 && cm_cell_are_quarters(cells + kept - 4))
        {
            kept -= 4;
            cells[kept] = cm_cell_parent(cells[kept], cm_cell_level(cells[kept]) - 1);
            kept++;
        }
    }
    return kept;
}

/* How many of the cells are less than that one? */
static size_t count_below(size_t n, const cm_cell *cells, cm_cell cell)
{
    size_t low = 0;
    while (n > 0)
    {
        size_t half = n / 2;
        if (cells[low + half] < cell)
        {
            low += half + 1;
            n -= half + 1;
        }
        else
        {
            n = half;
        }
    }
    return low;
}

int cm_cell_union_contains(size_t n, const cm_cell *cells, cm_cell cell)
{
    if (n == 0 || cells == NULL || !cm_cell_is_valid(cell))
    {
        return 0;
    }
    size_t at = count_below(n, cells, cell);
    return (at < n && cm_cell_contains(cells[at], cell)) ||
           (at > 0 && cm_cell_contains(cells[at - 1], cell));
}

int cm_cell_union_intersects(size_t n, const cm_cell *cells, cm_cell cell)
{
    if (n == 0 || cells == NULL || !cm_cell_is_valid(cell))
    {
        return 0;
    }
    size_t at = count_below(n, cells, cell);
    return (at < n && cm_cell_intersects(cells[at], cell)) ||
           (at > 0 && cm_cell_intersects(cells[at - 1], cell));
}
