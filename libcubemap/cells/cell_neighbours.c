/* SPDX-License-Identifier: MIT
 *
 * Neighbours of cells. Where the faces of a frame join follows from its table of axes: cells are walked as
 * whole points of the surface of a cube of 2^(level + 1) units a side, of which a cell is two.
 */
#include "cell_shape.h"

#include <stdlib.h>

/* The cell in column i and row j of a face, counted on over one edge: what is beyond the edge is on the face of
 * that side, as deep in it as it was beyond. CM_NO_CELL beyond two edges at once, where three faces meet. */
static cm_cell cell_beyond(const cm_cell_grid *cells, const cm_cell_place *from, int64_t i,
                           int64_t j)
{
    const cm_frame *frame = cm_mapping_frame(cm_grid_mapping(cells->grid));
    const cm_frame_face *face = &frame->face[from->face];
    int64_t side = (int64_t)1 << from->level;
    int is_beyond_u = i < 0 || i >= side;
    int is_beyond_v = j < 0 || j >= side;
    cm_cell_place place = {from->face, from->level, (uint32_t)i, (uint32_t)j};
    if (is_beyond_u && is_beyond_v)
    {
        return CM_NO_CELL;
    }
    if (is_beyond_u || is_beyond_v)
    {
        /* the middle of the cell, by the numbers of the axes; side - 1 deep on the next face */
        int64_t point[4] = {0, 0, 0, 0};
        int crossed = is_beyond_u ? (i < 0 ? -face->u : face->u) : j < 0 ? -face->v : face->v;
        int beside = is_beyond_u ? face->v : face->u;
        int64_t along = 2 * (is_beyond_u ? j : i) + 1 - side;
        point[abs(beside)] = beside > 0 ? along : -along;
        point[abs(face->outward)] = face->outward > 0 ? side - 1 : 1 - side;
        place.face = 0;
        while (frame->face[place.face].outward != crossed)
        {
            place.face++;
        }
        int u = frame->face[place.face].u;
        int v = frame->face[place.face].v;
        place.i = (uint32_t)(((u > 0 ? point[u] : -point[-u]) + side - 1) / 2);
        place.j = (uint32_t)(((v > 0 ? point[v] : -point[-v]) + side - 1) / 2);
    }
    return cm_cell_from_place(cells->curve, &place);
}

int cm_cell_edge_neighbours(const cm_cell_grid *cells, cm_cell cell, cm_cell to[4])
{
    cm_cell_place place;
    if (cm_cell_to_place(cells->curve, cell, &place) != CM_OK)
    {
        return 0;
    }
    int64_t i = place.i;
    int64_t j = place.j;
    to[0] = cell_beyond(cells, &place, i, j - 1);
    to[1] = cell_beyond(cells, &place, i + 1, j);
    to[2] = cell_beyond(cells, &place, i, j + 1);
    to[3] = cell_beyond(cells, &place, i - 1, j);
    return 4;
}

/* The ring of cells about a square of them: step k of 4 (size + 1), from the corner before i and j on. */
static cm_cell cell_of_ring(const cm_cell_grid *cells, const cm_cell_place *first, int64_t size,
                            int64_t k)
{
    int64_t along = k % (size + 1);
    int64_t low_i = (int64_t)first->i - 1;
    int64_t low_j = (int64_t)first->j - 1;
    int64_t high_i = first->i + size;
    int64_t high_j = first->j + size;
    switch (k / (size + 1))
    {
    case 0:
        return cell_beyond(cells, first, low_i + along, low_j);
    case 1:
        return cell_beyond(cells, first, high_i, low_j + along);
    case 2:
        return cell_beyond(cells, first, high_i - along, high_j);
    default:
        return cell_beyond(cells, first, low_i, high_j - along);
    }
}

int cm_cell_neighbours(const cm_cell_grid *cells, cm_cell cell, cm_cell to[8])
{
    cm_cell_place place;
    int count = 0;
    if (cm_cell_to_place(cells->curve, cell, &place) != CM_OK)
    {
        return 0;
    }
    for (int k = 0; k < 8; k++)
    {
        cm_cell found = cell_of_ring(cells, &place, 1, k);
        if (found != CM_NO_CELL)
        {
            to[count++] = found;
        }
    }
    return count;
}

/* How many corners of the cell are those of the cube? */
static size_t cube_corners(const cm_cell_place *place)
{
    uint32_t last = ((uint32_t)1 << place->level) - 1;
    size_t ends_i = (size_t)(place->i == 0) + (size_t)(place->i == last);
    size_t ends_j = (size_t)(place->j == 0) + (size_t)(place->j == last);
    return ends_i * ends_j;
}

cm_status cm_cell_neighbours_at(const cm_cell_grid *cells, cm_cell cell, int level, size_t capacity,
                                cm_cell *to, size_t *count)
{
    cm_cell_place place;
    if (count == NULL || (to == NULL && capacity > 0))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (cm_cell_to_place(cells->curve, cell, &place) != CM_OK || level < place.level ||
        level > CM_CELL_LEVEL_MAX)
    {
        return CM_ERROR_CELL;
    }
    int finer = level - place.level;
    int64_t size = (int64_t)1 << finer;
    size_t needed = 4 * (size_t)size + 4 - cube_corners(&place);
    *count = needed;
    if (needed > capacity)
    {
        return CM_ERROR_SPACE;
    }
    cm_cell_place first = {place.face, (uint8_t)level, place.i << finer, place.j << finer};
    for (int64_t k = 0; k < 4 * (size + 1); k++)
    {
        cm_cell found = cell_of_ring(cells, &first, size, k);
        if (found != CM_NO_CELL)
        {
            *to++ = found;
        }
    }
    return CM_OK;
}
