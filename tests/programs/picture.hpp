// SPDX-License-Identifier: MIT
//
// Pixels of a picture as numbers, as they are stored.

#ifndef TESTS_PICTURE_HPP
#define TESTS_PICTURE_HPP

#include <string>
#include <vector>

class Picture
{
public:
    // One of a file's pictures. std::runtime_error if it cannot be read.
    explicit Picture(const std::string &name, unsigned which = 0);

    // Channels of a pixel; rows from the top.
    const float *at(int x, int y) const
    {
        return values.data() +
               (std::size_t(y) * std::size_t(width) + std::size_t(x)) * std::size_t(channels);
    }
    double first(int x, int y) const
    {
        return static_cast<double>(*at(x, y));
    }

    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<float> values;
};

#endif
