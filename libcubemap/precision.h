/* SPDX-License-Identifier: MIT
 *
 * The public functions in one precision: they give any number of points to the loops of the mapping's
 * instruction set (batch.h), which take whole vectors. Read by double.c and by float.c, which say what
 * CM_BACKEND and CM_PUBLIC are.
 *
 * What is left over of n, and single points, go through a vector of their own, so that every point is
 * computed by the same instructions, wherever it stands.
 */
#include <cubemap/kernel/dialect.h>

#include <string.h>

/* One vector, with zeros or the same point where there is none. */
typedef CM_REAL rest[CM_LANES_MAX];
#define REST _Alignas(sizeof(rest)) rest

static void copy_to_rest(const cm_mapping *mapping, rest to, const CM_REAL *from, size_t n)
{
    size_t lanes = mapping->set->CM_NAME(lanes); /* in the fast tier those are half of a vector */
    for (size_t done = 0; done < mapping->CM_NAME(lanes); done += lanes)
    {
        size_t start = done < n ? done : n;
        size_t count = n - start < lanes ? n - start : lanes;
        mapping->set->CM_NAME(rest)(to + done, from + start, count);
    }
}

/* By one store, too. All machines with vectors here have the lower byte first. */
#if defined(__GNUC__)
typedef uint64_t faces_vector __attribute__((vector_size(CM_LANES_MAX)));
#else
typedef struct faces_vector
{
    uint64_t low, high;
} faces_vector;
#endif

static void copy_faces_to_rest(uint8_t to[CM_LANES_MAX], const uint8_t *from, size_t n)
{
    uint64_t low = 0;
    uint64_t high = 0;
    for (size_t i = n; i-- > 8;)
    {
        high = high << 8 | from[i];
    }
    for (size_t i = n < 8 ? n : 8; i-- > 0;)
    {
        low = low << 8 | from[i];
    }
    faces_vector faces = {low, high};
    memcpy(to, &faces, sizeof faces);
}

static void forward_points(const cm_mapping *mapping, size_t n, const CM_REAL *x, const CM_REAL *y,
                           const CM_REAL *z, uint8_t *face, CM_REAL *u, CM_REAL *v)
{
    size_t lanes = mapping->CM_NAME(lanes);
    size_t left = n % lanes;
    size_t whole = n - left;
    if (whole > 0)
    {
        mapping->CM_NAME(batch).forward(mapping, whole, x, y, z, face, u, v);
    }
    if (left > 0)
    {
        REST a, b, c;
        uint8_t faces[CM_LANES_MAX];
        copy_to_rest(mapping, a, x + whole, left);
        copy_to_rest(mapping, b, y + whole, left);
        copy_to_rest(mapping, c, z + whole, left);
        mapping->CM_NAME(batch).forward(mapping, lanes, a, b, c, faces, a, b);
        memcpy(face + whole, faces, left);
        memcpy(u + whole, a, left * sizeof *u);
        memcpy(v + whole, b, left * sizeof *v);
    }
}

static void inverse_points(const cm_mapping *mapping, size_t n, const uint8_t *face,
                           const CM_REAL *u, const CM_REAL *v, CM_REAL *x, CM_REAL *y, CM_REAL *z)
{
    size_t lanes = mapping->CM_NAME(lanes);
    size_t left = n % lanes;
    size_t whole = n - left;
    if (whole > 0)
    {
        mapping->CM_NAME(batch).inverse(mapping, whole, face, u, v, x, y, z);
    }
    if (left > 0)
    {
        REST a, b, c;
        uint8_t faces[CM_LANES_MAX];
        copy_faces_to_rest(faces, face + whole, left);
        copy_to_rest(mapping, a, u + whole, left);
        copy_to_rest(mapping, b, v + whole, left);
        mapping->CM_NAME(batch).inverse(mapping, lanes, faces, a, b, a, b, c);
        memcpy(x + whole, a, left * sizeof *x);
        memcpy(y + whole, b, left * sizeof *y);
        memcpy(z + whole, c, left * sizeof *z);
    }
}

/* ---- Public functions, documented in <cubemap/mapping.h> ---- */

void CM_PUBLIC(cm_forward_array)(const cm_mapping *mapping, size_t n, const CM_REAL *x,
                                 const CM_REAL *y, const CM_REAL *z, uint8_t *face, CM_REAL *u,
                                 CM_REAL *v)
{
    forward_points(mapping, n, x, y, z, face, u, v);
}

void CM_PUBLIC(cm_inverse_array)(const cm_mapping *mapping, size_t n, const uint8_t *face,
                                 const CM_REAL *u, const CM_REAL *v, CM_REAL *x, CM_REAL *y,
                                 CM_REAL *z)
{
    inverse_points(mapping, n, face, u, v, x, y, z);
}

/* A stride that is known makes vectors of the copies. */
static inline void gather_by(const CM_REAL *xyz, ptrdiff_t stride, size_t n, CM_REAL *x, CM_REAL *y,
                             CM_REAL *z)
{
    for (size_t i = 0; i < n; i++)
    {
        const CM_REAL *point = xyz + (ptrdiff_t)i * stride;
        x[i] = point[0];
        y[i] = point[1];
        z[i] = point[2];
    }
}

static void gather(const CM_REAL *xyz, ptrdiff_t stride, size_t n, CM_REAL *restrict x,
                   CM_REAL *restrict y, CM_REAL *restrict z)
{
    if (stride == 3)
    {
        gather_by(xyz, 3, n, x, y, z);
    }
    else
    {
        gather_by(xyz, stride, n, x, y, z);
    }
}

static inline void scatter_by(const CM_REAL *x, const CM_REAL *y, const CM_REAL *z, size_t n,
                              CM_REAL *xyz, ptrdiff_t stride)
{
    for (size_t i = 0; i < n; i++)
    {
        CM_REAL *point = xyz + (ptrdiff_t)i * stride;
        point[0] = x[i];
        point[1] = y[i];
        point[2] = z[i];
    }
}

static void scatter(const CM_REAL *x, const CM_REAL *y, const CM_REAL *z, size_t n,
                    CM_REAL *restrict xyz, ptrdiff_t stride)
{
    if (stride == 3)
    {
        scatter_by(x, y, z, n, xyz, 3);
    }
    else
    {
        scatter_by(x, y, z, n, xyz, stride);
    }
}

void CM_PUBLIC(cm_forward_strided)(const cm_mapping *mapping, size_t n, const CM_REAL *xyz,
                                   ptrdiff_t stride, uint8_t *face, CM_REAL *u, CM_REAL *v)
{
    CM_REAL x[CM_BLOCK];
    CM_REAL y[CM_BLOCK];
    CM_REAL z[CM_BLOCK];
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        size_t count = n - done < CM_BLOCK ? n - done : CM_BLOCK;
        gather(xyz + (ptrdiff_t)done * stride, stride, count, x, y, z);
        forward_points(mapping, count, x, y, z, face + done, u + done, v + done);
    }
}

void CM_PUBLIC(cm_inverse_strided)(const cm_mapping *mapping, size_t n, const uint8_t *face,
                                   const CM_REAL *u, const CM_REAL *v, CM_REAL *xyz,
                                   ptrdiff_t stride)
{
    CM_REAL x[CM_BLOCK];
    CM_REAL y[CM_BLOCK];
    CM_REAL z[CM_BLOCK];
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        size_t count = n - done < CM_BLOCK ? n - done : CM_BLOCK;
        inverse_points(mapping, count, face + done, u + done, v + done, x, y, z);
        scatter(x, y, z, count, xyz + (ptrdiff_t)done * stride, stride);
    }
}

uint8_t CM_PUBLIC(cm_forward)(const cm_mapping *mapping, const CM_REAL direction[3], CM_REAL uv[2])
{
    uint8_t face;
    forward_points(mapping, 1, &direction[0], &direction[1], &direction[2], &face, &uv[0], &uv[1]);
    return face;
}

void CM_PUBLIC(cm_inverse)(const cm_mapping *mapping, uint8_t face, const CM_REAL uv[2],
                           CM_REAL direction[3])
{
    inverse_points(mapping, 1, &face, &uv[0], &uv[1], &direction[0], &direction[1], &direction[2]);
}

static void copy_jacobians(CM_REAL *const to[6], size_t at, rest from[6], size_t n)
{
    for (int k = 0; k < 6; k++)
    {
        memcpy(to[k] + at, from[k], n * sizeof(CM_REAL));
    }
}

void CM_PUBLIC(cm_forward_jacobian_array)(const cm_mapping *mapping, size_t n, const CM_REAL *x,
                                          const CM_REAL *y, const CM_REAL *z,
                                          CM_REAL *const jacobian[6])
{
    size_t lanes = mapping->CM_NAME(lanes);
    size_t left = n % lanes;
    size_t whole = n - left;
    if (whole > 0)
    {
        mapping->CM_NAME(batch).forward_jacobian(mapping, whole, x, y, z, jacobian);
    }
    if (left > 0)
    {
        REST r[6];
        CM_REAL *const to[6] = {r[0], r[1], r[2], r[3], r[4], r[5]};
        copy_to_rest(mapping, r[0], x + whole, left);
        copy_to_rest(mapping, r[1], y + whole, left);
        copy_to_rest(mapping, r[2], z + whole, left);
        mapping->CM_NAME(batch).forward_jacobian(mapping, lanes, r[0], r[1], r[2], to);
        copy_jacobians(jacobian, whole, r, left);
    }
}

void CM_PUBLIC(cm_inverse_jacobian_array)(const cm_mapping *mapping, size_t n, const uint8_t *face,
                                          const CM_REAL *u, const CM_REAL *v,
                                          CM_REAL *const jacobian[6])
{
    size_t lanes = mapping->CM_NAME(lanes);
    size_t left = n % lanes;
    size_t whole = n - left;
    if (whole > 0)
    {
        mapping->CM_NAME(batch).inverse_jacobian(mapping, whole, face, u, v, jacobian);
    }
    if (left > 0)
    {
        REST r[6];
        CM_REAL *const to[6] = {r[0], r[1], r[2], r[3], r[4], r[5]};
        uint8_t faces[CM_LANES_MAX];
        copy_faces_to_rest(faces, face + whole, left);
        copy_to_rest(mapping, r[0], u + whole, left);
        copy_to_rest(mapping, r[1], v + whole, left);
        mapping->CM_NAME(batch).inverse_jacobian(mapping, lanes, faces, r[0], r[1], to);
        copy_jacobians(jacobian, whole, r, left);
    }
}

void CM_PUBLIC(cm_forward_jacobian)(const cm_mapping *mapping, const CM_REAL direction[3],
                                    CM_REAL jacobian[6])
{
    CM_REAL *const to[6] = {&jacobian[0], &jacobian[1], &jacobian[2],
                            &jacobian[3], &jacobian[4], &jacobian[5]};
    CM_PUBLIC(cm_forward_jacobian_array)
    (mapping, 1, &direction[0], &direction[1], &direction[2], to);
}

void CM_PUBLIC(cm_inverse_jacobian)(const cm_mapping *mapping, uint8_t face, const CM_REAL uv[2],
                                    CM_REAL jacobian[6])
{
    CM_REAL *const to[6] = {&jacobian[0], &jacobian[1], &jacobian[2],
                            &jacobian[3], &jacobian[4], &jacobian[5]};
    CM_PUBLIC(cm_inverse_jacobian_array)(mapping, 1, &face, &uv[0], &uv[1], to);
}

/* ---- Distortion, documented in <cubemap/distortion.h> ---- */

typedef CM_REAL block[CM_BLOCK];

typedef struct distortion_blocks
{
    _Alignas(sizeof(rest)) block jacobian[6];
    block column[CM_DISTORTION_COLUMNS];
} distortion_blocks;

#define SIX_BLOCKS(b)                                                                              \
    {                                                                                              \
        (b)->jacobian[0], (b)->jacobian[1], (b)->jacobian[2], (b)->jacobian[3], (b)->jacobian[4],  \
            (b)->jacobian[5]                                                                       \
    }

/* From the Jacobians of whole vectors of points, of which n are kept, to their places from at on: straight
 * there, or where the vectors are more than n by way of the blocks. */
static void distort_block(const cm_mapping *mapping, int of_tangents, size_t padded, size_t n,
                          size_t at, distortion_blocks *b,
                          const CM_PUBLIC(cm_distortion_arrays) * to)
{
    CM_REAL *const wanted[CM_DISTORTION_COLUMNS] = {to->major,    to->minor,        to->orientation,
                                                    to->scale,    to->deformation,  to->area,
                                                    to->isotropy, to->texel_aspect, to->texel_area};
    CM_REAL *const jacobian[6] = SIX_BLOCKS(b);
    CM_REAL *column[CM_DISTORTION_COLUMNS];
    for (int k = 0; k < CM_DISTORTION_COLUMNS; k++)
    {
        column[k] = wanted[k] != NULL && n == padded ? wanted[k] + at : b->column[k];
    }
    mapping->set->CM_NAME(indicatrices)(of_tangents, padded, jacobian, column);
    for (size_t i = 0; i < padded && mapping->area_scale != 1.0; i++)
    {
        column[5][i] *= (CM_REAL)mapping->area_scale;
    }
    for (int k = 0; k < CM_DISTORTION_COLUMNS && n < padded; k++)
    {
        if (wanted[k] != NULL)
        {
            memcpy(wanted[k] + at, column[k], n * sizeof(CM_REAL));
        }
    }
}

void CM_PUBLIC(cm_forward_distortion_array)(const cm_mapping *mapping, size_t n, const CM_REAL *x,
                                            const CM_REAL *y, const CM_REAL *z,
                                            const CM_PUBLIC(cm_distortion_arrays) * distortion)
{
    distortion_blocks b;
    CM_REAL *const to[6] = SIX_BLOCKS(&b);
    size_t lanes = mapping->CM_NAME(lanes);
    size_t left = n % lanes;
    size_t whole = n - left;
    for (size_t done = 0; done < whole; done += CM_BLOCK)
    {
        size_t count = whole - done < CM_BLOCK ? whole - done : CM_BLOCK;
        mapping->CM_NAME(batch).forward_jacobian(mapping, count, x + done, y + done, z + done, to);
        distort_block(mapping, 0, count, count, done, &b, distortion);
    }
    if (left > 0)
    {
        REST p, q, r;
        copy_to_rest(mapping, p, x + whole, left);
        copy_to_rest(mapping, q, y + whole, left);
        copy_to_rest(mapping, r, z + whole, left);
        mapping->CM_NAME(batch).forward_jacobian(mapping, lanes, p, q, r, to);
        distort_block(mapping, 0, lanes, left, whole, &b, distortion);
    }
}

void CM_PUBLIC(cm_inverse_distortion_array)(const cm_mapping *mapping, size_t n,
                                            const uint8_t *face, const CM_REAL *u, const CM_REAL *v,
                                            const CM_PUBLIC(cm_distortion_arrays) * distortion)
{
    distortion_blocks b;
    CM_REAL *const to[6] = SIX_BLOCKS(&b);
    size_t lanes = mapping->CM_NAME(lanes);
    size_t left = n % lanes;
    size_t whole = n - left;
    for (size_t done = 0; done < whole; done += CM_BLOCK)
    {
        size_t count = whole - done < CM_BLOCK ? whole - done : CM_BLOCK;
        mapping->CM_NAME(batch).inverse_jacobian(mapping, count, face + done, u + done, v + done,
                                                 to);
        distort_block(mapping, 1, count, count, done, &b, distortion);
    }
    if (left > 0)
    {
        REST p, q;
        uint8_t faces[CM_LANES_MAX];
        copy_faces_to_rest(faces, face + whole, left);
        copy_to_rest(mapping, p, u + whole, left);
        copy_to_rest(mapping, q, v + whole, left);
        mapping->CM_NAME(batch).inverse_jacobian(mapping, lanes, faces, p, q, to);
        distort_block(mapping, 1, lanes, left, whole, &b, distortion);
    }
}

#define ARRAYS_OF(d)                                                                               \
    {                                                                                              \
        .major = &(d)->major, .minor = &(d)->minor, .orientation = &(d)->orientation,              \
        .scale = &(d)->scale, .deformation = &(d)->deformation, .area = &(d)->area,                \
        .isotropy = &(d)->isotropy, .texel_aspect = &(d)->texel_aspect,                            \
        .texel_area = &(d)->texel_area                                                             \
    }

void CM_PUBLIC(cm_forward_distortion)(const cm_mapping *mapping, const CM_REAL direction[3],
                                      CM_PUBLIC(cm_distortion) * distortion)
{
    const CM_PUBLIC(cm_distortion_arrays) to = ARRAYS_OF(distortion);
    CM_PUBLIC(cm_forward_distortion_array)
    (mapping, 1, &direction[0], &direction[1], &direction[2], &to);
}

void CM_PUBLIC(cm_inverse_distortion)(const cm_mapping *mapping, uint8_t face, const CM_REAL uv[2],
                                      CM_PUBLIC(cm_distortion) * distortion)
{
    const CM_PUBLIC(cm_distortion_arrays) to = ARRAYS_OF(distortion);
    CM_PUBLIC(cm_inverse_distortion_array)(mapping, 1, &face, &uv[0], &uv[1], &to);
}

/* ---- Warps alone ---- */

typedef void (*warp_loop)(const cm_mapping *, size_t, CM_REAL *, CM_REAL *);

/* The points are copied to a block, which is padded to whole vectors: loops work in place. */
static cm_status warp_points(warp_loop warp, const cm_mapping *mapping, size_t n, const CM_REAL *a,
                             const CM_REAL *b, CM_REAL *to_a, CM_REAL *to_b)
{
    _Alignas(sizeof(rest)) block first, second;
    size_t lanes = mapping->CM_NAME(lanes);
    if (warp == NULL)
    {
        return CM_ERROR_UNSUPPORTED;
    }
    for (size_t done = 0; done < n; done += CM_BLOCK)
    {
        size_t count = n - done < CM_BLOCK ? n - done : CM_BLOCK;
        size_t left = count % lanes;
        size_t whole = count - left;
        memcpy(first, a + done, whole * sizeof *a);
        memcpy(second, b + done, whole * sizeof *b);
        if (left > 0)
        {
            copy_to_rest(mapping, first + whole, a + done + whole, left);
            copy_to_rest(mapping, second + whole, b + done + whole, left);
        }
        warp(mapping, whole + (left > 0 ? lanes : 0), first, second);
        memcpy(to_a + done, first, count * sizeof *to_a);
        memcpy(to_b + done, second, count * sizeof *to_b);
    }
    return CM_OK;
}

cm_status CM_PUBLIC(cm_warp_array)(const cm_mapping *mapping, size_t n, const CM_REAL *p,
                                   const CM_REAL *q, CM_REAL *u, CM_REAL *v)
{
    return warp_points(mapping->CM_NAME(batch).warp, mapping, n, p, q, u, v);
}

cm_status CM_PUBLIC(cm_unwarp_array)(const cm_mapping *mapping, size_t n, const CM_REAL *u,
                                     const CM_REAL *v, CM_REAL *p, CM_REAL *q)
{
    return warp_points(mapping->CM_NAME(batch).unwarp, mapping, n, u, v, p, q);
}

cm_status CM_PUBLIC(cm_warp)(const cm_mapping *mapping, const CM_REAL pq[2], CM_REAL uv[2])
{
    return CM_PUBLIC(cm_warp_array)(mapping, 1, &pq[0], &pq[1], &uv[0], &uv[1]);
}

cm_status CM_PUBLIC(cm_unwarp)(const cm_mapping *mapping, const CM_REAL uv[2], CM_REAL pq[2])
{
    return CM_PUBLIC(cm_unwarp_array)(mapping, 1, &uv[0], &uv[1], &pq[0], &pq[1]);
}

cm_status CM_PUBLIC(cm_warp_jacobian_array)(const cm_mapping *mapping, size_t n, const CM_REAL *p,
                                            const CM_REAL *q, CM_REAL *const jacobian[4])
{
    size_t lanes = mapping->CM_NAME(lanes);
    size_t left = n % lanes;
    size_t whole = n - left;
    if (mapping->CM_NAME(batch).warp_jacobian == NULL)
    {
        return CM_ERROR_UNSUPPORTED;
    }
    if (whole > 0)
    {
        mapping->CM_NAME(batch).warp_jacobian(mapping, whole, p, q, jacobian);
    }
    if (left > 0)
    {
        REST r[4];
        CM_REAL *const to[4] = {r[0], r[1], r[2], r[3]};
        copy_to_rest(mapping, r[0], p + whole, left);
        copy_to_rest(mapping, r[1], q + whole, left);
        mapping->CM_NAME(batch).warp_jacobian(mapping, lanes, r[0], r[1], to);
        for (int k = 0; k < 4; k++)
        {
            memcpy(jacobian[k] + whole, r[k], left * sizeof(CM_REAL));
        }
    }
    return CM_OK;
}

cm_status CM_PUBLIC(cm_warp_jacobian)(const cm_mapping *mapping, const CM_REAL pq[2],
                                      CM_REAL jacobian[4])
{
    CM_REAL *const to[4] = {&jacobian[0], &jacobian[1], &jacobian[2], &jacobian[3]};
    return CM_PUBLIC(cm_warp_jacobian_array)(mapping, 1, &pq[0], &pq[1], to);
}
