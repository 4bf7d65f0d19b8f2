// SPDX-License-Identifier: MIT

#include "image_threads.hpp"

#include <OpenImageIO/imageio.h>

ImageThreads::ImageThreads(int threads)
{
    OIIO::getattribute("threads", before);
    OIIO::getattribute("exr_threads", exr_before);
    OIIO::attribute("threads", threads);
    OIIO::attribute("exr_threads", threads > 1 ? threads : -1);
}

ImageThreads::~ImageThreads()
{
    OIIO::attribute("threads", before);
    OIIO::attribute("exr_threads", exr_before);
}
