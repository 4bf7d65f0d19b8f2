/* SPDX-License-Identifier: MIT
 *
 * Solid angles of pixels, and points that are evenly spread over the sphere.
 */
#include <cubemap/compare.h>
#include <cubemap/distortion.h>
#include <cubemap/threads.h>

#include <math.h>

static const double pi = 3.14159265358979323846;

cm_status cm_equirect_weights(uint32_t width, uint32_t height, float *weights)
{
    if (width == 0 || height == 0 || weights == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    /* of latitudes from a - h to a + h: (sin(a + h) - sin(a - h)) 2 pi / width = cos a sin h 4 pi / width */
    const double h = 0.5 * pi / height;
    const double factor = sin(h) * (4.0 * pi / width);
    for (uint32_t row = 0; row < height; row++)
    {
        /* the sine of the distance to the nearer pole, which is as exact there as elsewhere */
        const uint32_t from_pole = row < height - 1 - row ? row : height - 1 - row;
        weights[row] = (float)(sin((2.0 * from_pole + 1.0) * h) * factor);
    }
    return CM_OK;
}

/* ---- faces ---- */

typedef struct face_job
{
    const cm_mapping *mapping;
    uint8_t face;
    uint32_t edge;
    float *weights;
} face_job;

enum
{
    RUN = 64
};

static void weigh_pixels(size_t begin, size_t end, void *user)
{
    const face_job *const job = user;
    const double step = 2.0 / job->edge;
    for (size_t at = begin; at < end; at += RUN)
    {
        const size_t count = end - at < RUN ? end - at : RUN;
        uint8_t face[RUN];
        double u[RUN], v[RUN], j[6][RUN];
        double *const jacobian[6] = {j[0], j[1], j[2], j[3], j[4], j[5]};
        for (size_t i = 0; i < count; i++)
        {
            face[i] = job->face;
            u[i] = ((double)((at + i) % job->edge) + 0.5) * step - 1.0;
            v[i] = ((double)((at + i) / job->edge) + 0.5) * step - 1.0;
        }
        cm_inverse_jacobian_array(job->mapping, count, face, u, v, jacobian);
        for (size_t i = 0; i < count; i++)
        {
            const double x = j[2][i] * j[5][i] - j[4][i] * j[3][i];
            const double y = j[4][i] * j[1][i] - j[0][i] * j[5][i];
            const double z = j[0][i] * j[3][i] - j[2][i] * j[1][i];
            const double area = sqrt(x * x + y * y + z * z) * step * step;
            job->weights[at + i] = isfinite(area) ? (float)area : 0.0f;
        }
    }
}

cm_status cm_face_weights(const cm_mapping *mapping, uint8_t face, uint32_t edge, unsigned threads,
                          float *weights)
{
    const unsigned faces =
        mapping != NULL && cm_mapping_describe(mapping)->kind == CM_KIND_CUBE ? 6 : 1;
    if (mapping == NULL || weights == NULL || face >= faces || edge == 0 || edge > SIZE_MAX / edge)
    {
        return CM_ERROR_ARGUMENT;
    }
    face_job job = {mapping, face, edge, weights};
    cm_run_threads(threads, (size_t)edge * edge, CM_POINTS_PER_THREAD, weigh_pixels, &job);
    return CM_OK;
}

/* ---- points ---- */

/* 2^64 / golden ratio: products with an index, which wrap, are the fraction of a turn in units of 2^-64. */
static const uint64_t golden_turn = 0x9e3779b97f4a7c15u;

cm_status cm_sphere_points(uint64_t n, uint64_t first, size_t count, double *x, double *y,
                           double *z)
{
    if (x == NULL || y == NULL || z == NULL || first > n || count > n - first ||
        n > UINT64_C(1) << 52)
    {
        return CM_ERROR_ARGUMENT;
    }
    for (size_t i = 0; i < count; i++)
    {
        const uint64_t index = first + i;
        const double down = (2.0 * (double)index + 1.0) / (double)n; /* 1 - z */
        const double rho = sqrt(down * (2.0 - down));
        const double lon = ldexp((double)(index * golden_turn), -63) * pi;
        x[i] = rho * cos(lon);
        y[i] = rho * sin(lon);
        z[i] = 1.0 - down;
    }
    return CM_OK;
}
