/* SPDX-License-Identifier: MIT
 *
 * The loops over points and cells for one instruction set, over whole vectors. Read by batch_precision.h in
 * double, after lanes/words.h.
 */
/* Of vectors two points share a word in what needs 32 bits. */
#ifdef LANES_INTEGER
typedef uint32_t lanes_halves __attribute__((vector_size(LANES_BYTES)));
#define CURVE_HALF lanes_halves
#define CELL_POINTS (2 * LANES)
#else
#define CURVE_HALF lanes_words
#define CELL_POINTS LANES
#endif
#define CURVE_WORD lanes_words
#define CURVE_NAME(name) lanes_curve_##name
#include "curve.h"

#if defined(__GNUC__)
#define CELL_FN static inline __attribute__((always_inline))
#else
#define CELL_FN static inline
#endif

#define CELL_MAGIC 6755399441055744.0 /* 1.5 2^52: beside it numbers are whole, of both signs */
#define CELL_HALF 536870912.0         /* 2^29 */

/* The leaf along one coordinate: the whole part of 2^29 (w + 1), without rounding, 2^30 - 1 at most. */
CM_FN lanes_words lanes_leaf_of(CM_REAL w)
{
    CM_REAL magic = lanes_all(CELL_MAGIC);
    CM_REAL half = lanes_all(CELL_HALF);
    CM_REAL scaled = w * half;
    CM_REAL nearest = (scaled + magic) - magic;
    CM_REAL whole = nearest - CM_SELECT(cm_less(scaled, nearest), CM_LIT(1.0), CM_LIT(0.0));
    return lanes_words_of(cm_min(whole, half - CM_LIT(1.0)) + half);
}

/* A vector of points: faces, columns and rows. */
typedef struct lanes_leaves
{
    CM_REAL face;
    lanes_words f;
    lanes_words i;
    lanes_words j;
} lanes_leaves;

CELL_FN lanes_leaves lanes_read_leaves(int is_hilbert, const uint8_t *face, const double *u,
                                       const double *v)
{
    lanes_leaves p;
    p.face = lanes_load_faces(face);
    p.f = lanes_words_of(p.face);
    p.i = lanes_leaf_of(lanes_load(u));
    p.j = lanes_leaf_of(lanes_load(v));
    if (is_hilbert)
    {
        lanes_curve_mirror(p.f, &p.i, &p.j);
    }
    return p;
}

/* end: the last bit of cells of the level; place: on the curve. */
CELL_FN void lanes_write_cells(lanes_leaves p, lanes_words place, uint64_t end, cm_cell *cell)
{
    lanes_words leaf = lanes_curve_leaf(p.f, place);
    lanes_words found = (leaf & lanes_words_all(-end)) | lanes_words_all(end);
    lanes_words_store(
        cell, lanes_words_select(cm_less(p.face, CM_LIT(5.5)), found, lanes_words_all(CM_NO_CELL)));
}

/* The higher bits of the digits of two vectors of points. */
CELL_FN void lanes_hilbert_bits(lanes_leaves p, lanes_leaves q, lanes_words *of_p,
                                lanes_words *of_q)
{
#ifdef LANES_INTEGER
    lanes_words i = p.i | (q.i << 32);
    lanes_words j = p.j | (q.j << 32);
    lanes_words both = (lanes_words)lanes_curve_hilbert_bits((lanes_halves)i, (lanes_halves)j);
    *of_p = both & lanes_words_all(CURVE_ALL);
    *of_q = both >> 32;
#else
    *of_p = lanes_curve_hilbert_bits(p.i, p.j);
    *of_q = lanes_curve_hilbert_bits(q.i, q.j);
#endif
}

CELL_FN void cells_of_points(int is_hilbert, uint64_t end, size_t n, const uint8_t *face,
                             const double *u, const double *v, cm_cell *cell)
{
    for (size_t i = 0; i < n; i += CELL_POINTS)
    {
        /* the second of two vectors, the same again if there is none */
        size_t k = i + LANES < n ? i + (CELL_POINTS - LANES) : i;
        lanes_leaves p = lanes_read_leaves(is_hilbert, face + i, u + i, v + i);
        lanes_leaves q = lanes_read_leaves(is_hilbert, face + k, u + k, v + k);
        if (is_hilbert)
        {
            lanes_words a, b;
            lanes_hilbert_bits(p, q, &a, &b);
            lanes_write_cells(p, lanes_curve_hilbert(a, p.i ^ p.j), end, cell + i);
            lanes_write_cells(q, lanes_curve_hilbert(b, q.i ^ q.j), end, cell + k);
        }
        else
        {
            lanes_write_cells(p, lanes_curve_morton(p.i, p.j), end, cell + i);
            lanes_write_cells(q, lanes_curve_morton(q.i, q.j), end, cell + k);
        }
    }
}

static void lanes_cell_forward(cm_curve curve, int level, size_t n, const uint8_t *face,
                               const double *u, const double *v, cm_cell *cell)
{
    uint64_t end = 1ull << (2 * (CM_CELL_LEVEL_MAX - level));
    if (curve == CM_CURVE_HILBERT)
    {
        cells_of_points(1, end, n, face, u, v, cell);
    }
    else
    {
        cells_of_points(0, end, n, face, u, v, cell);
    }
}

CELL_FN void centres_of_cells(int is_hilbert, size_t n, const cm_cell *cell, uint8_t *face,
                              double *u, double *v)
{
    CM_REAL scale = lanes_all(0.5 / CELL_HALF);
    CM_REAL one = CM_LIT(1.0);
    for (size_t i = 0; i < n; i += LANES)
    {
        lanes_words f, low_i, low_j;
        lanes_words size =
            lanes_curve_corner(is_hilbert, lanes_words_load(cell + i), &f, &low_i, &low_j);
        lanes_store_faces(face + i, lanes_of_words(f));
        lanes_store(u + i, lanes_of_words(low_i + low_i + size) * scale - one);
        lanes_store(v + i, lanes_of_words(low_j + low_j + size) * scale - one);
    }
}

/* The middles of cells, which must be valid. */
static void lanes_cell_centre(cm_curve curve, size_t n, const cm_cell *cell, uint8_t *face,
                              double *u, double *v)
{
    if (curve == CM_CURVE_HILBERT)
    {
        centres_of_cells(1, n, cell, face, u, v);
    }
    else
    {
        centres_of_cells(0, n, cell, face, u, v);
    }
}

static const cm_cell_loops cell_loops = {lanes_cell_forward, lanes_cell_centre};

#undef CELL_POINTS
