// SPDX-License-Identifier: MIT

#include "image_file.hpp"
#include "program.hpp"
#include "whole_png.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

namespace
{

// Failure if this is not a file that can be read and has something in it.
void check_readable(const std::string &path)
{
    struct stat status;
    if (stat(path.c_str(), &status) != 0 || access(path.c_str(), R_OK) != 0)
    {
        throw Failure(in_quotes(path) + " cannot be read: " + std::strerror(errno));
    }
    if (!S_ISREG(status.st_mode))
    {
        throw Failure(in_quotes(path) + " is " +
                      (S_ISDIR(status.st_mode) ? "a folder" : "not a file") +
                      "; give the name of an image file");
    }
    if (status.st_size == 0)
    {
        throw Failure(in_quotes(path) + " is empty; an image file is needed");
    }
}

std::string reason(const std::string &message)
{
    const std::string line = first_line(message);
    return line.empty() ? "it is damaged or ends too early" : line;
}

std::unique_ptr<OIIO::ImageInput> open_image(const std::string &path)
{
    check_readable(path);
    check_whole_png(path);
    OIIO::ImageSpec request;
    request.attribute("oiio:UnassociatedAlpha", 1);
    std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path, &request);
    if (!input)
    {
        throw Failure(in_quotes(path) +
                      " is not an image that can be read: " + reason(OIIO::geterror()));
    }
    const OIIO::ImageSpec &spec = input->spec();
    if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0)
    {
        throw Failure(in_quotes(path) + " has no pixels: it is " + std::to_string(spec.width) +
                      " x " + std::to_string(spec.height) + " with " +
                      std::to_string(spec.nchannels) + " channels");
    }
    if (spec.depth > 1 || spec.deep)
    {
        throw Failure(in_quotes(path) + " is a volume or a deep image; a flat one is needed");
    }
    return input;
}

// A file was decoded, but with this message: does it mean that pixels are missing or wrong? Of JPEG
// files, many that are whole bring complaints about bytes that stand between their parts.
bool pixels_are_missing(const std::string &format, const std::string &message)
{
    return format == "jpeg" ? message.find("remature end") != std::string::npos : !message.empty();
}

} // namespace

ImageFile::ImageFile(const std::string &path) : name(path), input(open_image(path))
{
    const OIIO::ImageSpec &stored = input->spec();
    orientation = stored.get_int_attribute("Orientation", 1);
    if (orientation < 1 || orientation > 8)
    {
        orientation = 1;
    }
    const bool windows = format() == "openexr";
    upright_width = windows ? stored.full_width : stored.width;
    upright_height = windows ? stored.full_height : stored.height;
    if (upright_width <= 0 || upright_height <= 0)
    {
        throw Failure(in_quotes(name) + " has an empty display window");
    }
    if (orientation > 4)
    {
        std::swap(upright_width, upright_height);
    }
}

std::string ImageFile::pixel_type() const
{
    return input->spec().format.c_str();
}

bool ImageFile::unassociated_alpha() const
{
    const OIIO::ImageSpec &stored = input->spec();
    return stored.alpha_channel >= 0 && stored.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0;
}

void ImageFile::read(float *pixels, std::size_t row_stride, Finite finite)
{
    if (is_plain())
    {
        read_stored(pixels, row_stride);
    }
    else
    {
        read_and_place(pixels, row_stride);
    }
    if (finite != Finite::any && spec().format.is_floating_point())
    {
        check_finite(pixels, row_stride, finite);
    }
}

// Are the stored pixels the image, in its order?
bool ImageFile::is_plain() const
{
    const OIIO::ImageSpec &stored = input->spec();
    return orientation == 1 && upright_width == stored.width && upright_height == stored.height &&
           (format() != "openexr" || (stored.x == stored.full_x && stored.y == stored.full_y));
}

void ImageFile::read_stored(float *pixels, std::size_t row_stride)
{
    const OIIO::stride_t x_stride = static_cast<OIIO::stride_t>(sizeof(float)) * channels();
    const OIIO::stride_t y_stride = static_cast<OIIO::stride_t>(row_stride * sizeof(float));
    const bool good = input->read_image(0, 0, 0, channels(), OIIO::TypeFloat, pixels, x_stride,
                                        y_stride, OIIO::AutoStride);
    const std::string message = input->geterror();
    if (!good || pixels_are_missing(format(), message))
    {
        throw Failure(in_quotes(name) + " is damaged or ends too early" +
                      (message.empty() ? "" : ": " + first_line(message)));
    }
}

void ImageFile::read_and_place(float *pixels, std::size_t row_stride)
{
    const OIIO::ImageSpec &stored = input->spec();
    check_memory(in_quotes(name), std::int64_t{stored.width} * stored.height, channels());
    const std::size_t count = static_cast<std::size_t>(channels());
    const std::size_t stored_stride = static_cast<std::size_t>(stored.width) * count;
    std::vector<float> buffer(stored_stride * static_cast<std::size_t>(stored.height));
    read_stored(buffer.data(), stored_stride);
    const bool windows = format() == "openexr";
    const int left = windows ? stored.x - stored.full_x : 0;
    const int top = windows ? stored.y - stored.full_y : 0;
    for (int row = 0; row < upright_height; ++row)
    {
        for (int column = 0; column < upright_width; ++column)
        {
            const Place place = before_orientation(column, row);
            const int x = place.x - left;
            const int y = place.y - top;
            float *const to = pixels + static_cast<std::size_t>(row) * row_stride +
                              static_cast<std::size_t>(column) * count;
            if (x < 0 || y < 0 || x >= stored.width || y >= stored.height)
            {
                std::fill(to, to + count, 0.0f);
                continue;
            }
            const float *const from = buffer.data() + static_cast<std::size_t>(y) * stored_stride +
                                      static_cast<std::size_t>(x) * count;
            std::copy(from, from + count, to);
        }
    }
}

// Where a pixel of the upright image lies in the display window as it is stored.
ImageFile::Place ImageFile::before_orientation(int column, int row) const
{
    const bool turned = orientation > 4;
    Place place = turned ? Place{row, column} : Place{column, row};
    if (orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8)
    {
        place.x = (turned ? upright_height : upright_width) - 1 - place.x;
    }
    if (orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7)
    {
        place.y = (turned ? upright_width : upright_height) - 1 - place.y;
    }
    return place;
}

void ImageFile::check_finite(const float *pixels, std::size_t row_stride, Finite finite) const
{
    const std::size_t count = static_cast<std::size_t>(channels());
    for (int row = 0; row < upright_height; ++row)
    {
        const float *const values = pixels + static_cast<std::size_t>(row) * row_stride;
        for (std::size_t i = 0; i < count * static_cast<std::size_t>(upright_width); ++i)
        {
            const bool not_a_number = std::isnan(values[i]);
            if (not_a_number || (finite == Finite::all && std::isinf(values[i])))
            {
                throw Failure(
                    in_quotes(name) + " has " + (not_a_number ? "a NaN" : "an infinite value") +
                    " at x = " + std::to_string(i / count) + ", y = " + std::to_string(row) +
                    ", channel " + std::string(spec().channel_name(static_cast<int>(i % count))) +
                    (not_a_number ? "; only numbers can be resampled"
                                  : "; only --filter nearest can resample it"));
            }
        }
    }
}

void check_memory(const std::string &what, std::int64_t pixels, int channels)
{
    const double needed = static_cast<double>(pixels) * channels * sizeof(float);
    const double present =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    if (present > 0 && needed > present)
    {
        char text[100];
        std::snprintf(text, sizeof text, " needs %.1f GB of memory, this machine has %.1f GB",
                      needed / 1e9, present / 1e9);
        throw Failure(what + text);
    }
}
