// SPDX-License-Identifier: MIT
#include "healpix_cxx.h"

#include <healpix_base.h>

namespace
{

Healpix_Base2 pixels[2];

} // namespace

void healpix_cxx_prepare(int64_t nside)
{
    pixels[0].SetNside(nside, RING);
    pixels[1].SetNside(nside, NEST);
}

void healpix_cxx_from_directions(int order, size_t n, double *const direction[3], int64_t *pixel)
{
    for (size_t i = 0; i < n; i++)
    {
        pixel[i] = pixels[order].vec2pix(vec3(direction[0][i], direction[1][i], direction[2][i]));
    }
}

void healpix_cxx_from_angles(int order, size_t n, const double *theta, const double *phi,
                             int64_t *pixel)
{
    for (size_t i = 0; i < n; i++)
    {
        pixel[i] = pixels[order].ang2pix(pointing(theta[i], phi[i]));
    }
}

void healpix_cxx_to_directions(int order, size_t n, const int64_t *pixel, double *const made[3])
{
    for (size_t i = 0; i < n; i++)
    {
        const vec3 at = pixels[order].pix2vec(pixel[i]);
        made[0][i] = at.x;
        made[1][i] = at.y;
        made[2][i] = at.z;
    }
}

void healpix_cxx_to_angles(int order, size_t n, const int64_t *pixel, double *theta, double *phi)
{
    for (size_t i = 0; i < n; i++)
    {
        const pointing at = pixels[order].pix2ang(pixel[i]);
        theta[i] = at.theta;
        phi[i] = at.phi;
    }
}

void healpix_cxx_renumber(int order, size_t n, const int64_t *from, int64_t *to)
{
    for (size_t i = 0; i < n; i++)
    {
        to[i] = order == 0 ? pixels[0].ring2nest(from[i]) : pixels[1].nest2ring(from[i]);
    }
}

void healpix_cxx_neighbours(int order, size_t n, const int64_t *pixel, int64_t (*to)[8])
{
    for (size_t i = 0; i < n; i++)
    {
        fix_arr<int64, 8> found;
        pixels[order].neighbors(pixel[i], found);
        for (size_t k = 0; k < 8; k++)
        {
            to[i][k] = found[k];
        }
    }
}
