/* SPDX-License-Identifier: MIT
 *
 * Maps that are made of parts, in one precision: the loops of charts.h in a row, block by block, as the
 * functions of cm_batch. Read by double.c and by float.c, which say what CM_BACKEND is, before precision.h.
 */
#include <cubemap/kernel/dialect.h>

#include <string.h>

enum
{
    CHART_BLOCK = 64 /* a multiple of CM_LANES_MAX */
};

typedef CM_REAL chart_column[CHART_BLOCK];

typedef struct chart_blocks
{
    _Alignas(64) chart_column disc[CM_DISC_COLUMNS];
    chart_column a;
    chart_column b;
    chart_column by_disc[4];
} chart_blocks;

#define DISC_COLUMNS(c)                                                                            \
    {                                                                                              \
        (c)->disc[0], (c)->disc[1], (c)->disc[2], (c)->disc[3], (c)->disc[4]                       \
    }
#define FOUR_COLUMNS(c)                                                                            \
    {                                                                                              \
        (c)->by_disc[0], (c)->by_disc[1], (c)->by_disc[2], (c)->by_disc[3]                         \
    }
#define SIX_AT(to, at)                                                                             \
    {                                                                                              \
        (to)[0] + (at), (to)[1] + (at), (to)[2] + (at), (to)[3] + (at), (to)[4] + (at),            \
            (to)[5] + (at)                                                                         \
    }

static const CM_NAME(cm_azimuthal_loops) *azimuthal_of(const cm_mapping *mapping)
{
    return &mapping->set->CM_NAME(charts)->azimuthal[mapping->azimuthal];
}

static const CM_NAME(cm_square_loops) *square_of(const cm_mapping *mapping)
{
    return &mapping->set->CM_NAME(charts)->square[mapping->square];
}

static size_t block_of(size_t n, size_t done)
{
    return n - done < CHART_BLOCK ? n - done : CHART_BLOCK;
}

static void azimuthal_forward(const cm_mapping *mapping, size_t n, const CM_REAL *x,
                              const CM_REAL *y, const CM_REAL *z, uint8_t *face, CM_REAL *u,
                              CM_REAL *v)
{
    chart_blocks c;
    CM_REAL *const disc[CM_DISC_COLUMNS] = DISC_COLUMNS(&c);
    for (size_t at = 0; at < n; at += CHART_BLOCK)
    {
        size_t count = block_of(n, at);
        azimuthal_of(mapping)->forward(mapping, count, x + at, y + at, z + at, disc);
        mapping->set->CM_NAME(charts)->face_out(count, disc[0], disc[1], face + at, u + at, v + at);
    }
}

static void azimuthal_inverse(const cm_mapping *mapping, size_t n, const uint8_t *face,
                              const CM_REAL *u, const CM_REAL *v, CM_REAL *x, CM_REAL *y,
                              CM_REAL *z)
{
    chart_blocks c;
    CM_REAL *const disc[CM_DISC_COLUMNS] = DISC_COLUMNS(&c);
    for (size_t at = 0; at < n; at += CHART_BLOCK)
    {
        size_t count = block_of(n, at);
        mapping->set->CM_NAME(charts)->face_in(count, face + at, u + at, v + at, c.a, c.b);
        mapping->set->CM_NAME(charts)->disc_in(count, c.a, c.b, disc);
        azimuthal_of(mapping)->inverse(mapping, count, disc, x + at, y + at, z + at);
    }
}

/* The directions are those of forward, so that bad ones and those beyond the rim are NaN as they are. */
static void azimuthal_forward_jacobian(const cm_mapping *mapping, size_t n, const CM_REAL *x,
                                       const CM_REAL *y, const CM_REAL *z,
                                       CM_REAL *const jacobian[6])
{
    chart_blocks c;
    CM_REAL *const disc[CM_DISC_COLUMNS] = DISC_COLUMNS(&c);
    for (size_t at = 0; at < n; at += CHART_BLOCK)
    {
        size_t count = block_of(n, at);
        CM_REAL *const to[6] = SIX_AT(jacobian, at);
        azimuthal_of(mapping)->forward(mapping, count, x + at, y + at, z + at, disc);
        azimuthal_of(mapping)->gradients(mapping, count, x + at, y + at, z + at, to);
        mapping->set->CM_NAME(charts)->keep(count, disc[0], to);
    }
}

static void azimuthal_inverse_jacobian(const cm_mapping *mapping, size_t n, const uint8_t *face,
                                       const CM_REAL *u, const CM_REAL *v,
                                       CM_REAL *const jacobian[6])
{
    chart_blocks c;
    CM_REAL *const disc[CM_DISC_COLUMNS] = DISC_COLUMNS(&c);
    for (size_t at = 0; at < n; at += CHART_BLOCK)
    {
        size_t count = block_of(n, at);
        CM_REAL *const to[6] = SIX_AT(jacobian, at);
        mapping->set->CM_NAME(charts)->face_in(count, face + at, u + at, v + at, c.a, c.b);
        mapping->set->CM_NAME(charts)->disc_in(count, c.a, c.b, disc);
        azimuthal_of(mapping)->tangents(mapping, count, disc, to);
        mapping->set->CM_NAME(charts)->keep(count, disc[0], to);
    }
}

static void layout_forward(const cm_mapping *mapping, size_t n, const CM_REAL *x, const CM_REAL *y,
                           const CM_REAL *z, uint8_t *face, CM_REAL *u, CM_REAL *v)
{
    chart_blocks c;
    CM_REAL *const disc[CM_DISC_COLUMNS] = DISC_COLUMNS(&c);
    for (size_t at = 0; at < n; at += CHART_BLOCK)
    {
        size_t count = block_of(n, at);
        azimuthal_of(mapping)->forward(mapping, count, x + at, y + at, z + at, disc);
        square_of(mapping)->forward(count, disc, c.a, c.b);
        mapping->set->CM_NAME(charts)->square_out(mapping, count, disc[4], c.a, c.b);
        mapping->set->CM_NAME(charts)->face_out(count, c.a, c.b, face + at, u + at, v + at);
    }
}

static void layout_inverse(const cm_mapping *mapping, size_t n, const uint8_t *face,
                           const CM_REAL *u, const CM_REAL *v, CM_REAL *x, CM_REAL *y, CM_REAL *z)
{
    chart_blocks c;
    CM_REAL *const disc[CM_DISC_COLUMNS] = DISC_COLUMNS(&c);
    for (size_t at = 0; at < n; at += CHART_BLOCK)
    {
        size_t count = block_of(n, at);
        mapping->set->CM_NAME(charts)->face_in(count, face + at, u + at, v + at, c.a, c.b);
        mapping->set->CM_NAME(charts)->square_in(mapping, count, c.a, c.b, c.a, c.b, disc[4]);
        square_of(mapping)->inverse(count, c.a, c.b, disc);
        azimuthal_of(mapping)->inverse(mapping, count, disc, x + at, y + at, z + at);
    }
}

static void layout_forward_jacobian(const cm_mapping *mapping, size_t n, const CM_REAL *x,
                                    const CM_REAL *y, const CM_REAL *z, CM_REAL *const jacobian[6])
{
    chart_blocks c;
    CM_REAL *const disc[CM_DISC_COLUMNS] = DISC_COLUMNS(&c);
    CM_REAL *const by_disc[4] = FOUR_COLUMNS(&c);
    for (size_t at = 0; at < n; at += CHART_BLOCK)
    {
        size_t count = block_of(n, at);
        CM_REAL *const to[6] = SIX_AT(jacobian, at);
        azimuthal_of(mapping)->forward(mapping, count, x + at, y + at, z + at, disc);
        square_of(mapping)->forward(count, disc, c.a, c.b);
        square_of(mapping)->jacobian(count, disc, c.a, c.b, by_disc);
        azimuthal_of(mapping)->gradients(mapping, count, x + at, y + at, z + at, to);
        mapping->set->CM_NAME(charts)->gradients_out(mapping, count, disc[4], c.a, c.b, by_disc,
                                                     to);
        mapping->set->CM_NAME(charts)->keep(count, disc[0], to);
    }
}

static void layout_inverse_jacobian(const cm_mapping *mapping, size_t n, const uint8_t *face,
                                    const CM_REAL *u, const CM_REAL *v, CM_REAL *const jacobian[6])
{
    chart_blocks c;
    CM_REAL *const disc[CM_DISC_COLUMNS] = DISC_COLUMNS(&c);
    CM_REAL *const by_disc[4] = FOUR_COLUMNS(&c);
    for (size_t at = 0; at < n; at += CHART_BLOCK)
    {
        size_t count = block_of(n, at);
        CM_REAL *const to[6] = SIX_AT(jacobian, at);
        mapping->set->CM_NAME(charts)->face_in(count, face + at, u + at, v + at, c.a, c.b);
        mapping->set->CM_NAME(charts)->square_in(mapping, count, c.a, c.b, c.a, c.b, disc[4]);
        square_of(mapping)->inverse(count, c.a, c.b, disc);
        square_of(mapping)->jacobian(count, disc, c.a, c.b, by_disc);
        azimuthal_of(mapping)->tangents(mapping, count, disc, to);
        mapping->set->CM_NAME(charts)->tangents_out(mapping, count, disc[4], c.a, c.b, by_disc, to);
        mapping->set->CM_NAME(charts)->keep(count, disc[0], to);
    }
}

/* ---- Between disc and square there is no sphere ---- */

static void square_warp(const cm_mapping *mapping, size_t n, CM_REAL *u, CM_REAL *v)
{
    chart_blocks c;
    CM_REAL *const disc[CM_DISC_COLUMNS] = DISC_COLUMNS(&c);
    for (size_t at = 0; at < n; at += CHART_BLOCK)
    {
        size_t count = block_of(n, at);
        mapping->set->CM_NAME(charts)->disc_in(count, u + at, v + at, disc);
        square_of(mapping)->forward(count, disc, u + at, v + at);
    }
}

static void square_unwarp(const cm_mapping *mapping, size_t n, CM_REAL *u, CM_REAL *v)
{
    chart_blocks c;
    CM_REAL *const disc[CM_DISC_COLUMNS] = DISC_COLUMNS(&c);
    for (size_t at = 0; at < n; at += CHART_BLOCK)
    {
        size_t count = block_of(n, at);
        mapping->set->CM_NAME(charts)->square_in(mapping, count, u + at, v + at, c.a, c.b, disc[4]);
        square_of(mapping)->inverse(count, c.a, c.b, disc);
        memcpy(u + at, c.disc[0], count * sizeof *u);
        memcpy(v + at, c.disc[1], count * sizeof *v);
    }
}

static void fill(CM_REAL *to, size_t n)
{
    for (size_t i = 0; i < n; i++)
    {
        to[i] = (CM_REAL)NAN;
    }
}

static void no_forward(const cm_mapping *mapping, size_t n, const CM_REAL *x, const CM_REAL *y,
                       const CM_REAL *z, uint8_t *face, CM_REAL *u, CM_REAL *v)
{
    (void)mapping, (void)x, (void)y, (void)z;
    memset(face, CM_NO_FACE, n);
    fill(u, n);
    fill(v, n);
}

static void no_inverse(const cm_mapping *mapping, size_t n, const uint8_t *face, const CM_REAL *u,
                       const CM_REAL *v, CM_REAL *x, CM_REAL *y, CM_REAL *z)
{
    (void)mapping, (void)face, (void)u, (void)v;
    fill(x, n);
    fill(y, n);
    fill(z, n);
}

static void no_forward_jacobian(const cm_mapping *mapping, size_t n, const CM_REAL *x,
                                const CM_REAL *y, const CM_REAL *z, CM_REAL *const jacobian[6])
{
    (void)mapping, (void)x, (void)y, (void)z;
    for (int k = 0; k < 6; k++)
    {
        fill(jacobian[k], n);
    }
}

static void no_inverse_jacobian(const cm_mapping *mapping, size_t n, const uint8_t *face,
                                const CM_REAL *u, const CM_REAL *v, CM_REAL *const jacobian[6])
{
    (void)mapping, (void)face, (void)u, (void)v;
    for (int k = 0; k < 6; k++)
    {
        fill(jacobian[k], n);
    }
}

/* By kind; cubes have loops of their own, and so have layouts that are one kernel. */
const CM_NAME(cm_batch) CM_NAME(cm_chart_batches)[] = {
    [CM_KIND_DISC_SQUARE] = {no_forward, no_inverse, no_forward_jacobian, no_inverse_jacobian,
                             square_warp, square_unwarp},
    [CM_KIND_AZIMUTHAL] = {azimuthal_forward, azimuthal_inverse, azimuthal_forward_jacobian,
                           azimuthal_inverse_jacobian, NULL, NULL},
    [CM_KIND_LAYOUT] = {layout_forward, layout_inverse, layout_forward_jacobian,
                        layout_inverse_jacobian, NULL, NULL}};
