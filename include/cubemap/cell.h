/* SPDX-License-Identifier: MIT
 *
 * Cells: the squares that a face falls into when it is halved both ways again and again, as numbers of 64 bits. Level
 * 0 are the six faces, level L has 6 4^L cells, level 30 the leaves, whose edges on Earth are some 9 mm long.
 *
 * A cell's number is, from the highest bit: the face in 3 bits, 2 bits for each level that say which quarter, a bit
 * that is 1, and zeros. So the number alone tells its level; the cells of a level are in the order of a curve through
 * the faces; and what lies in a cell is one range of numbers.
 *
 * Which quarter the 2 bits mean is a matter of the curve, which a number does not tell. Hilbert's is that of the S2
 * library (s2geometry, s2cell_id.h): each cell shares an edge with the one before it. With the frame and the mapping s2
 * numbers of cells are S2's, and those of points with cm_cell_grid_create_s2. Morton's digit is 2 j + i.
 *
 * A cell's place is its face, its level and the column i along u and the row j along v, both from 0 to 2^level - 1. It
 * is what is between 2 i / 2^level - 1 and 2 (i + 1) / 2^level - 1 in u, its lower edges included, the upper ones only
 * at u = 1 and v = 1.
 *
 * What is no cell is answered with CM_NO_CELL or what is said below. Nothing here has a state, and nothing allocates
 * but what the C library's qsort takes in cm_cell_union_normalise. Points, neighbours on other faces: cell_grid.h.
 */
#ifndef CUBEMAP_CELL_H
#define CUBEMAP_CELL_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A cell's number. */
typedef uint64_t cm_cell;

/* The number of no cell. */
#define CM_NO_CELL 0

/* The level of leaves. */
#define CM_CELL_LEVEL_MAX 30

/* The order of a cell's quarters. */
typedef enum cm_curve
{
    CM_CURVE_HILBERT = 0, /* S2's */
    CM_CURVE_MORTON = 1   /* 2 j + i */
} cm_curve;

/* "hilbert", "morton"; NULL for what is none. find takes upper and lower case as the same: CM_OK,
 * CM_ERROR_ARGUMENT (NULL), CM_ERROR_CELL. */
CM_API const char *cm_curve_name(cm_curve curve);
CM_API cm_status cm_curve_find(const char *name, cm_curve *curve);

/* 1 or 0. */
CM_API int cm_cell_is_valid(cm_cell cell);

/* -1 for none. */
CM_API int cm_cell_level(cm_cell cell);

/* CM_NO_FACE for none. */
CM_API uint8_t cm_cell_face(cm_cell cell);

/* The cell of that level that the cell is in, itself at its own level. CM_NO_CELL for a level that is
 * negative or beyond the cell's. */
CM_API cm_cell cm_cell_parent(cm_cell cell, int level);

/* The quarter of that number, 0 to 3, in the order of the curve; CM_NO_CELL for other numbers and for
 * leaves. */
CM_API cm_cell cm_cell_child(cm_cell cell, int which);

/* The least and the greatest number of the leaves in the cell. Every cell in it, itself too, lies between
 * them, and no other does. */
CM_API cm_cell cm_cell_first_leaf(cm_cell cell);
CM_API cm_cell cm_cell_last_leaf(cm_cell cell);

/* Is the other in the cell, or the same? 1 or 0. Does one of them contain the other? */
CM_API int cm_cell_contains(cm_cell cell, cm_cell other);
CM_API int cm_cell_intersects(cm_cell cell, cm_cell other);

/* The smallest cell that contains both; CM_NO_CELL if they are on two faces. */
CM_API cm_cell cm_cell_common_parent(cm_cell cell, cm_cell other);

/* The place of a cell on the curve through the cells of its level, from 0 to 6 4^level - 1 (UINT64_MAX for none),
 * and the cell of that place. */
CM_API uint64_t cm_cell_index(cm_cell cell);
CM_API cm_cell cm_cell_at_index(int level, uint64_t index);

/* The cell of the same level so many steps further along the curve, or back; behind the last comes the
 * first. */
CM_API cm_cell cm_cell_advance(cm_cell cell, int64_t steps);

/* Where a cell is on its face. */
typedef struct cm_cell_place
{
    uint8_t face;  /* 0 to 5 */
    uint8_t level; /* 0 to CM_CELL_LEVEL_MAX */
    uint32_t i;    /* along u, from 0 to 2^level - 1 */
    uint32_t j;    /* along v */
} cm_cell_place;

/* CM_NO_CELL for a curve, a face, a level, i or j out of range, or NULL. */
CM_API cm_cell cm_cell_from_place(cm_curve curve, const cm_cell_place *place);

/* CM_OK, CM_ERROR_ARGUMENT (NULL, or no curve), CM_ERROR_CELL. */
CM_API cm_status cm_cell_to_place(cm_curve curve, cm_cell cell, cm_cell_place *place);

/* The square of a cell on its face, exactly: u from low[0] to high[0], v from low[1] to high[1].
 * CM_OK, CM_ERROR_ARGUMENT (NULL, or no curve), CM_ERROR_CELL. */
CM_API cm_status cm_cell_square(cm_curve curve, cm_cell cell, uint8_t *face, double low[2],
                                double high[2]);

/* ---- Text ---- */

/* A token with the zero byte at its end, at most. */
#define CM_CELL_TOKEN_SIZE 17

/* The token of a cell: the number in 16 hexadecimal digits without the zeros at their end, "X" for
 * CM_NO_CELL. Tokens of cells sort as the cells do. CM_OK; CM_ERROR_ARGUMENT (NULL), CM_ERROR_CELL (neither a cell nor
 * CM_NO_CELL), CM_ERROR_SPACE (size is too small for it: CM_CELL_TOKEN_SIZE always is enough). */
CM_API cm_status cm_cell_token(cm_cell cell, char *text, size_t size);

/* The cell of a token, in upper or lower case; of "X", or "x", CM_NO_CELL.
 * CM_OK; CM_ERROR_ARGUMENT or CM_ERROR_CELL, and then, if message is not NULL, at most message_size bytes of
 * one line that says what is wrong, always ended by a zero byte if message_size > 0. */
CM_API cm_status cm_cell_parse(const char *text, cm_cell *cell, char *message, size_t message_size);

/* ---- Sets of cells ---- */

/* Sorts n cells in place, takes out those that are none or in others, and puts a cell in the place of its
 * four quarters as often as there are all four. The number that is left. */
CM_API size_t cm_cell_union_normalise(size_t n, cm_cell *cells);

/* Of n cells as cm_cell_union_normalise leaves them: is the whole cell in one of them, does it have
 * anything in common with one? By halving. */
CM_API int cm_cell_union_contains(size_t n, const cm_cell *cells, cm_cell cell);
CM_API int cm_cell_union_intersects(size_t n, const cm_cell *cells, cm_cell cell);

#ifdef __cplusplus
}
#endif

#endif
