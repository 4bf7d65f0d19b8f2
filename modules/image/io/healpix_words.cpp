// SPDX-License-Identifier: MIT

#include "healpix_words.hpp"
#include "oiio_words.hpp"

#include <new>

#include <fitsio.h>

void arrange_map(std::int64_t nside, bool nested, bool to_list, std::size_t channels,
                 const float *from, float *to)
{
    const cm_status status =
        cm_healpix_arrange(nside, nested ? CM_HEALPIX_NESTED : CM_HEALPIX_RING, to_list ? 1 : 0,
                           channels * sizeof(float), from, to);
    if (status == CM_ERROR_MEMORY)
    {
        throw std::bad_alloc();
    }
    if (status != CM_OK)
    {
        throw ImageFailure("has NSIDE " + std::to_string(nside) + (nested ? " in NESTED" : "") +
                               ", which is none: " + cm_status_text(status),
                           status == CM_ERROR_RANGE ? CM_ERROR_UNSUPPORTED : status);
    }
}

void check_fits(int status, const std::string &what)
{
    if (status == MEMORY_ALLOCATION)
    {
        throw std::bad_alloc();
    }
    if (status != 0)
    {
        char text[FLEN_STATUS] = "";
        fits_get_errstatus(status, text);
        fits_clear_errmsg();
        throw ImageFailure(what + ": " + text);
    }
}
