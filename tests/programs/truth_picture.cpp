// SPDX-License-Identifier: MIT

#include "truth_picture.hpp"

#include "tools/cli/image_file.hpp"

#include <cmath>
#include <cstdio>
#include <stdexcept>

TruthPicture::TruthPicture(const std::string &name)
{
    ImageFile file(name);
    width = file.width();
    channels = file.channels();
    for (int i = 0; i < channels; ++i)
    {
        number[file.channel_name(i)] = i;
    }
    const std::size_t row = static_cast<std::size_t>(width * channels);
    values.resize(row * static_cast<std::size_t>(file.height()));
    file.read(values.data(), row, Finite::any);
}

void wrong_at(int x, int y, const std::string &what, double seen, double wanted)
{
    char text[300];
    std::snprintf(text, sizeof text, "%s at %d, %d is %.9g, not %.9g", what.c_str(), x, y, seen,
                  wanted);
    throw std::runtime_error(text);
}

void near(const std::string &what, int x, int y, double seen, double wanted, double within)
{
    if (!(std::fabs(seen - wanted) <= within))
    {
        wrong_at(x, y, what, seen, wanted);
    }
}
