// SPDX-License-Identifier: MIT
//
// Reading image files: whole, upright, as floats, or one clear reason why not.

#ifndef CUBEMAP_TOOLS_IMAGE_FILE_HPP
#define CUBEMAP_TOOLS_IMAGE_FILE_HPP

#include <memory>
#include <string>

#include <OpenImageIO/imageio.h>

// Which values that are not finite numbers a reader lets pass.
enum class Finite
{
    all,     // NaN and infinities are failures
    not_nan, // infinities pass
    any      // all pass
};

// An image file that was opened. The first image counts if there are several. The orientation that
// a camera noted is applied; an OpenEXR image is its display window, with 0 where there is no data.
// The values of transparent pixels are as stored (neither multiplied nor divided by alpha).
class ImageFile
{
public:
    // Failure if there is no such file, it is not an image, or not one of this kind.
    explicit ImageFile(const std::string &path);

    const std::string &path() const noexcept
    {
        return name;
    }
    int width() const noexcept
    {
        return upright_width;
    }
    int height() const noexcept
    {
        return upright_height;
    }
    int channels() const noexcept
    {
        return input->spec().nchannels;
    }

    // What the file says of itself. Its width and height are before orientation.
    const OIIO::ImageSpec &spec() const noexcept
    {
        return input->spec();
    }
    std::string format() const
    {
        return input->format_name();
    }

    // "uint8", "half"
    std::string pixel_type() const;

    // Is there an alpha channel that the colours are not multiplied by?
    bool unassociated_alpha() const;

    // Writes pixel (column, row) to pixels + row * row_stride + column * channels(). Failure if the
    // file is damaged or ends too early, or if there is a value that is not allowed.
    void read(float *pixels, std::size_t row_stride, Finite finite);

private:
    struct Place
    {
        int x;
        int y;
    };

    Place before_orientation(int column, int row) const;
    void read_stored(float *pixels, std::size_t row_stride);
    void read_and_place(float *pixels, std::size_t row_stride);
    void check_finite(const float *pixels, std::size_t row_stride, Finite finite) const;
    bool is_plain() const;

    std::string name;
    std::unique_ptr<OIIO::ImageInput> input;
    int orientation = 1; // as in EXIF
    int upright_width = 0;
    int upright_height = 0;
};

// Failure if these many pixels, in floats, do not fit into this machine's memory.
void check_memory(const std::string &what, std::int64_t pixels, int channels);

#endif
