/* SPDX-License-Identifier: MIT
 *
 * HEALPix maps between lists in one of their orders and the picture of their base pixels. Which pixel of the list a place of the
 * picture is, the library is asked by the place's direction, which is in the middle of the pixel.
 */
#include <cubemap/image.h>

#include <string.h>

#define BLOCK 256

/* Of a surface's picture. */
#define NSIDE_MOST (((int64_t)1 << 30) / 12)

typedef struct arrangement
{
    const cm_surface *surface;
    const cm_healpix *healpix;
    int to_list;
    size_t pixel_size;
    const unsigned char *from;
    unsigned char *to;
} arrangement;

/* Up to BLOCK pixels of a row of a square. */
static void arrange_run(const arrangement *job, unsigned plane, uint32_t row, uint32_t first,
                        uint32_t count)
{
    uint8_t planes[BLOCK];
    double columns[BLOCK];
    double rows[BLOCK];
    double z[BLOCK];
    int64_t pixel[BLOCK];
    const size_t nside = cm_surface_plane_width(job->surface);
    const size_t begin = ((size_t)row * 12 + plane) * nside + first;
    for (uint32_t i = 0; i < count; i++)
    {
        planes[i] = (uint8_t)plane;
        columns[i] = first + i + 0.5;
        rows[i] = row + 0.5;
    }
    cm_surface_directions(job->surface, count, planes, columns, rows, columns, rows, z);
    cm_healpix_pixel_from_direction_array(job->healpix, count, columns, rows, z, pixel);
    for (uint32_t i = 0; i < count; i++)
    {
        const size_t in_list = (size_t)pixel[i] * job->pixel_size;
        const size_t in_picture = (begin + i) * job->pixel_size;
        memcpy(job->to + (job->to_list ? in_list : in_picture),
               job->from + (job->to_list ? in_picture : in_list), job->pixel_size);
    }
}

cm_status cm_healpix_arrange(int64_t nside, cm_healpix_order order, int to_list, size_t pixel_size,
                             const void *from, void *to)
{
    cm_healpix *healpix = NULL;
    cm_surface *surface = NULL;
    if (pixel_size == 0 || from == NULL || to == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = cm_healpix_create(nside, order, NULL, &healpix);
    if (status != CM_OK || nside > NSIDE_MOST ||
        pixel_size > (size_t)PTRDIFF_MAX / (12 * (size_t)nside) / (size_t)nside)
    {
        cm_healpix_destroy(healpix);
        return status != CM_OK ? status : CM_ERROR_RANGE;
    }
    const cm_surface_options options = {
        .size = sizeof options, .width = (uint32_t)(12 * nside), .height = (uint32_t)nside};
    status = cm_surface_create("healpix", &options, &surface);
    if (status == CM_OK)
    {
        const arrangement job = {surface, healpix, to_list, pixel_size, from, to};
        for (uint32_t at = 0; at < 12 * (uint32_t)nside; at++)
        {
            for (uint32_t first = 0; first < nside; first += BLOCK)
            {
                const uint32_t rest = (uint32_t)nside - first;
                arrange_run(&job, at % 12, at / 12, first, rest < BLOCK ? rest : BLOCK);
            }
        }
    }
    cm_surface_destroy(surface);
    cm_healpix_destroy(healpix);
    return status;
}
