// SPDX-License-Identifier: MIT
//
// Reading image files: upright, as floats, or one clear reason why not.

#ifndef CUBEMAP_TOOLS_IMAGE_FILE_HPP
#define CUBEMAP_TOOLS_IMAGE_FILE_HPP

#include "image_description.hpp"
#include "program.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

// Which values that are not finite numbers a reader lets pass.
enum class Finite
{
    all,     // NaN and infinities are failures
    not_nan, // infinities pass
    any      // all pass
};

// What reads and writes image files, which is opened at the first call. Failure if it cannot be.
const cm_image_io &image_io();

// Throws what a status of image_io() means; file is in_quotes() or says otherwise what the message is of.
[[noreturn]] void fail_image(const std::string &file, cm_status status, const char *message);

// There is such a file, but nothing that reads it.
class UnreadableImage : public Failure
{
public:
    using Failure::Failure;
};

// An image file that was opened. The orientation that
// a camera noted is applied; an OpenEXR image is its display window, with 0 where there is no data.
// The values of transparent pixels are as stored (neither multiplied nor divided by alpha).
class ImageFile
{
public:
    // Failure if there is no such file, it is not an image, or not one of this kind. From now on the
    // process reads and writes images in so many threads, and none may be read or written now; 0
    // leaves them as they are.
    // subimage: which of the file's pictures.
    explicit ImageFile(const std::string &path, int threads = 0, std::uint32_t subimage = 0);

    enum class Origin
    {
        file,
        stream // the name is words for people: no file is to be looked for by it
    };

    // A picture that is open already, by the functions of this table, of which describe, read and close are called; it
    // belongs to this from now on.
    ImageFile(const std::string &path, const cm_image_io &functions, cm_image_reader *opened,
              Origin origin = Origin::file);

    const std::string &path() const noexcept
    {
        return name;
    }
    bool is_stream() const noexcept
    {
        return origin == Origin::stream;
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
        return static_cast<int>(stored().channels);
    }

    // What the file says of itself. Width, height and window are before orientation.
    const cm_image_description &stored() const noexcept;
    std::string format() const
    {
        return stored().format;
    }
    std::string channel_name(int channel) const
    {
        return stored().channel_names[channel];
    }

    // "uint8", "half"
    std::string pixel_type() const
    {
        return stored().stored_type;
    }

    // Writes pixel (column, row) to pixels + row * row_stride + column * channels(). Failure if the
    // file is damaged or ends too early, or if there is a value that is not allowed.
    void read(float *pixels, std::size_t row_stride, Finite finite);

    // The same of the rows from first to before end, of which the first goes to pixels. From the top
    // downwards no part of the file is decoded twice.
    void read_rows(int first, int end, float *pixels, std::size_t row_stride, Finite finite);

    // All pixels upright, as a type that io has; row_stride is in bytes. NaN and infinities pass.
    void read_as(cm_pixel_type type, void *pixels, std::ptrdiff_t row_stride);

    // The same in bands of some rows, with little memory beside pixels; after each, advance is told of how many stored
    // rows.
    void read_in_bands(cm_pixel_type type, void *pixels, std::ptrdiff_t row_stride,
                       const std::function<void(int)> &advance);

    // How many rows of read_rows are read at a time without much memory or loss of time.
    int band_rows() const noexcept;

private:
    struct Closer
    {
        const cm_image_io *functions;
        void operator()(cm_image_reader *opened) const noexcept;
    };
    struct Place
    {
        int x;
        int y;
    };

    void open(int threads, std::uint32_t subimage);
    void find_size();
    const cm_image_io &table() const noexcept
    {
        return *reader.get_deleter().functions;
    }
    void round_wholes(int rows, float *pixels, std::ptrdiff_t row_stride) const;
    void read_stored(int first, int end, cm_pixel_type type, void *pixels,
                     std::ptrdiff_t row_stride);
    void read_and_place(cm_pixel_type type, char *pixels, std::ptrdiff_t row_stride,
                        const std::function<void(int)> &advance);
    int stored_band_rows(std::size_t row_bytes) const;
    Place after_orientation(int x, int y) const;
    void check_finite(int first, int end, const float *pixels, std::size_t row_stride,
                      Finite finite) const;
    bool is_plain() const;

    std::string name;
    Origin origin = Origin::file;
    std::unique_ptr<cm_image_reader, Closer> reader{nullptr, Closer{nullptr}};
    int upright_width = 0;
    int upright_height = 0;
    std::vector<float> upright; // of rows that are read while the image is not stored so
};

// The bytes of one channel.
std::size_t channel_bytes(cm_pixel_type type);

// Failure if these many pixels do not fit into this machine's memory; advice ends the message.
void check_memory(const std::string &what, std::int64_t pixels, int channels,
                  std::size_t channel_size = sizeof(float), const std::string &advice = "");

#endif
