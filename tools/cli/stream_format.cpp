// SPDX-License-Identifier: MIT

#include "stream_format.hpp"

#include <algorithm>
#include <iterator>

namespace
{

constexpr StreamFormat stream_formats[] = {
    {"pgm", CM_PNM_PGM, 1, CM_PIXEL_U8, false, false},
    {"ppm", CM_PNM_PPM, 3, CM_PIXEL_U8, false, false},
    {"pam", CM_PNM_PAM, 0, CM_PIXEL_U8, false, false},
    {"pfm", CM_PNM_PFM, -1, CM_PIXEL_FLOAT, false, false},
    {"gray", CM_PNM_RAW, 1, CM_PIXEL_U8, false, false},
    {"gray16le", CM_PNM_RAW, 1, CM_PIXEL_U16, false, false},
    {"grayf32le", CM_PNM_RAW, 1, CM_PIXEL_FLOAT, false, false},
    {"rgb24", CM_PNM_RAW, 3, CM_PIXEL_U8, false, false},
    {"rgb48le", CM_PNM_RAW, 3, CM_PIXEL_U16, false, false},
    {"gbrpf32le", CM_PNM_RAW, 3, CM_PIXEL_FLOAT, false, true},
    {"rgba", CM_PNM_RAW, 4, CM_PIXEL_U8, true, false},
    {"rgba64le", CM_PNM_RAW, 4, CM_PIXEL_U16, true, false},
    {"gbrapf32le", CM_PNM_RAW, 4, CM_PIXEL_FLOAT, true, true},
};

} // namespace

const StreamFormat *find_stream_format(const std::string &name)
{
    const auto is_it = [&name](const StreamFormat &format) { return name == format.name; };
    const auto *const found =
        std::find_if(std::begin(stream_formats), std::end(stream_formats), is_it);
    return found == std::end(stream_formats) ? nullptr : found;
}

std::string stream_format_names(bool bare)
{
    std::string names;
    for (const StreamFormat &format : stream_formats)
    {
        if ((format.kind == CM_PNM_RAW) == bare)
        {
            names += (names.empty() ? "" : " ") + std::string(format.name);
        }
    }
    return names;
}

const StreamFormat &best_stream_format(const ImageDescription &source)
{
    if (source.type == CM_PIXEL_HALF || source.type == CM_PIXEL_FLOAT)
    {
        return *find_stream_format("pfm");
    }
    return *find_stream_format(source.channels == 1 ? "pgm" : source.channels == 3 ? "ppm" : "pam");
}

int held_channels(const StreamFormat &format, const ImageDescription &source)
{
    const int all = source.channels;
    const int colors = source.alpha >= 0 && source.alpha == all - 1 ? all - 1 : all;
    if (format.channels == 0)
    {
        return all;
    }
    const auto fits = [&format](int count)
    { return format.channels > 0 ? count == format.channels : count == 1 || count == 3; };
    return fits(all) ? all : fits(colors) ? colors : 0;
}

cm_pixel_type held_type(const StreamFormat &format, cm_pixel_type wanted)
{
    if (format.kind == CM_PNM_RAW || format.kind == CM_PNM_PFM)
    {
        return format.type;
    }
    return wanted == CM_PIXEL_U8 ? CM_PIXEL_U8 : CM_PIXEL_U16;
}
