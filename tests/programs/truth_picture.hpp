// SPDX-License-Identifier: MIT
//
// What cubemap-scene says is true of pixels, and how far that may be off.

#ifndef TESTS_TRUTH_PICTURE_HPP
#define TESTS_TRUTH_PICTURE_HPP

#include <map>
#include <string>
#include <vector>

// A file of --truth, by the names of its channels.
class TruthPicture
{
public:
    explicit TruthPicture(const std::string &name);

    double at(const std::string &channel, int x, int y) const
    {
        const int place = (y * width + x) * channels + number.at(channel);
        return static_cast<double>(values[static_cast<std::size_t>(place)]);
    }

private:
    int width = 0;
    int channels = 0;
    std::map<std::string, int> number;
    std::vector<float> values;
};

// Throws what is seen at a pixel, and what is wanted.
[[noreturn]] void wrong_at(int x, int y, const std::string &what, double seen, double wanted);

// The same if they are farther apart.
void near(const std::string &what, int x, int y, double seen, double wanted, double within);

#endif
