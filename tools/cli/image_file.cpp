// SPDX-License-Identifier: MIT

#include "image_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include <sys/stat.h>
#include <unistd.h>

namespace
{

// Rows are read in bands of about so many floats, but at least so many rows: as many as OpenEXR compresses together.
constexpr std::size_t band_floats = std::size_t{1} << 20;
constexpr std::size_t band_rows_least = 256;

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

} // namespace

const cm_image_io &image_io()
{
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_image_io *const io = cm_image_io_get(message);
    if (io == nullptr)
    {
        throw Failure(message);
    }
    return *io;
}

void fail_image(const std::string &file, cm_status status, const char *message)
{
    if (status == CM_ERROR_MEMORY)
    {
        throw std::bad_alloc();
    }
    throw Failure(file + " " + message);
}

void ImageFile::Closer::operator()(cm_image_reader *opened) const noexcept
{
    functions->close(opened);
}

ImageFile::ImageFile(const std::string &path, int threads, std::uint32_t subimage) : name(path)
{
    check_readable(path);
    open(threads, subimage);
    find_size();
}

ImageFile::ImageFile(const std::string &path, const cm_image_io &functions, cm_image_reader *opened,
                     Origin from)
    : name(path), origin(from), reader(opened, Closer{&functions})
{
    find_size();
}

void ImageFile::find_size()
{
    upright_width = static_cast<int>(stored().window_width);
    upright_height = static_cast<int>(stored().window_height);
    if (stored().orientation > 4)
    {
        std::swap(upright_width, upright_height);
    }
}

void ImageFile::open(int threads, std::uint32_t subimage)
{
    const cm_image_io &functions = image_io();
    if (threads > 0)
    {
        functions.set_threads(threads);
    }
    cm_image_reader *opened = nullptr;
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_status status = functions.open(name.c_str(), subimage, &opened, message);
    if (status == CM_ERROR_UNSUPPORTED)
    {
        throw UnreadableImage(in_quotes(name) + " " + message);
    }
    if (status != CM_OK)
    {
        fail_image(in_quotes(name), status, message);
    }
    reader = {opened, Closer{&functions}};
}

const cm_image_description &ImageFile::stored() const noexcept
{
    return *table().describe(reader.get());
}

void ImageFile::read(float *pixels, std::size_t row_stride, Finite finite)
{
    read_as(CM_PIXEL_FLOAT, pixels, static_cast<std::ptrdiff_t>(row_stride * sizeof(float)));
    check_finite(0, upright_height, pixels, row_stride, finite);
}

void ImageFile::read_as(cm_pixel_type type, void *pixels, std::ptrdiff_t row_stride)
{
    if (is_plain())
    {
        read_stored(0, upright_height, type, pixels, row_stride);
    }
    else
    {
        read_and_place(type, static_cast<char *>(pixels), row_stride, [](int) {});
    }
}

void ImageFile::read_in_bands(cm_pixel_type type, void *pixels, std::ptrdiff_t row_stride,
                              const std::function<void(int)> &advance)
{
    if (!is_plain())
    {
        read_and_place(type, static_cast<char *>(pixels), row_stride, advance);
        return;
    }
    const std::size_t row = static_cast<std::size_t>(stored().width) *
                            static_cast<std::size_t>(channels()) * channel_bytes(type);
    const int rows = stored_band_rows(row);
    for (int first = 0; first < upright_height; first += rows)
    {
        const int end = std::min(first + rows, upright_height);
        read_stored(first, end, type, static_cast<char *>(pixels) + first * row_stride, row_stride);
        advance(end - first);
    }
}

void ImageFile::read_rows(int first, int end, float *pixels, std::size_t row_stride, Finite finite)
{
    if (is_plain())
    {
        read_stored(first, end, CM_PIXEL_FLOAT, pixels,
                    static_cast<std::ptrdiff_t>(row_stride * sizeof(float)));
    }
    else
    {
        const std::size_t row =
            static_cast<std::size_t>(upright_width) * static_cast<std::size_t>(channels());
        if (upright.empty())
        {
            check_memory(in_quotes(name), std::int64_t{upright_width} * upright_height, channels());
            std::vector<float> whole(row * static_cast<std::size_t>(upright_height));
            read_and_place(CM_PIXEL_FLOAT, reinterpret_cast<char *>(whole.data()),
                           static_cast<std::ptrdiff_t>(row * sizeof(float)), [](int) {});
            upright = std::move(whole);
        }
        for (int y = first; y < end; ++y)
        {
            const float *const from = upright.data() + static_cast<std::size_t>(y) * row;
            std::copy(from, from + row, pixels + static_cast<std::size_t>(y - first) * row_stride);
        }
    }
    check_finite(first, end, pixels, row_stride, finite);
}

int ImageFile::band_rows() const noexcept
{
    const std::size_t row =
        static_cast<std::size_t>(upright_width) * static_cast<std::size_t>(channels());
    const std::size_t rows = std::max(band_rows_least, band_floats / row);
    return static_cast<int>(std::min(rows, static_cast<std::size_t>(upright_height)));
}

// Are the stored pixels the image, in its order?
bool ImageFile::is_plain() const
{
    const cm_image_description &of = stored();
    return of.orientation == 1 && of.window_width == of.width && of.window_height == of.height &&
           of.left == 0 && of.top == 0;
}

// Whole numbers as parts of the greatest, each the float nearest to that. Readers multiply by a rounded factor, after which
// 20 of 255 and 5140 of 65535 would be apart.
void ImageFile::round_wholes(int rows, float *pixels, std::ptrdiff_t row_stride) const
{
    const double most = stored().type == CM_PIXEL_U8 ? 255 : 65535;
    const std::size_t count = static_cast<std::size_t>(stored().width) * stored().channels;
    for (int row = 0; row < rows; ++row)
    {
        auto *const value =
            reinterpret_cast<float *>(reinterpret_cast<char *>(pixels) + row * row_stride);
        for (std::size_t i = 0; i < count; ++i)
        {
            const double whole = std::nearbyint(value[i] * most);
            value[i] = std::fabs(value[i] * most - whole) < 0.01 ? static_cast<float>(whole / most)
                                                                 : value[i];
        }
    }
}

void ImageFile::read_stored(int first, int end, cm_pixel_type type, void *pixels,
                            std::ptrdiff_t row_stride)
{
    const cm_image_region rows = {0, static_cast<std::uint32_t>(first), stored().width,
                                  static_cast<std::uint32_t>(end)};
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_status status = table().read(reader.get(), &rows, type, pixels, row_stride, message);
    if (status != CM_OK)
    {
        fail_image(in_quotes(name), status, message);
    }
    if (type == CM_PIXEL_FLOAT && (stored().type == CM_PIXEL_U8 || stored().type == CM_PIXEL_U16))
    {
        round_wholes(end - first, static_cast<float *>(pixels), row_stride);
    }
}

// Rows that are read together: whole strips or rows of tiles, so that none is decoded twice.
int ImageFile::stored_band_rows(std::size_t row_bytes) const
{
    const cm_image_description &of = stored();
    std::size_t together = of.tile_height > 0 ? of.tile_height : 16;
    for (std::size_t i = 0; i < of.tag_count; ++i)
    {
        if (std::strcmp(of.tags[i].key, "tiff:RowsPerStrip") == 0)
        {
            together = std::strtoul(of.tags[i].text, nullptr, 10);
        }
    }
    const std::size_t fitting = std::max<std::size_t>(band_floats * sizeof(float) / row_bytes, 1);
    together = together == 0 || together > of.height ? 1 : together;
    const std::size_t rows = (fitting + together - 1) / together * together;
    return static_cast<int>(std::min<std::size_t>(rows, of.height));
}

// Band by band, each pixel to where it belongs, 0 elsewhere.
void ImageFile::read_and_place(cm_pixel_type type, char *pixels, std::ptrdiff_t row_stride,
                               const std::function<void(int)> &advance)
{
    const cm_image_description &of = stored();
    const std::size_t pixel = static_cast<std::size_t>(channels()) * channel_bytes(type);
    const int columns = static_cast<int>(of.width);
    const std::size_t stride = static_cast<std::size_t>(of.width) * pixel;
    const int rows = stored_band_rows(stride);
    for (int row = 0; row < upright_height; ++row)
    {
        std::memset(pixels + row * row_stride, 0, pixel * static_cast<std::size_t>(upright_width));
    }
    std::vector<char> band(stride * static_cast<std::size_t>(rows));
    for (int first = 0; first < static_cast<int>(of.height); first += rows)
    {
        const int end = std::min(first + rows, static_cast<int>(of.height));
        read_stored(first, end, type, band.data(), static_cast<std::ptrdiff_t>(stride));
        for (int i = 0; i < (end - first) * columns; ++i)
        {
            const int y = first + i / columns;
            const Place to = after_orientation(i % columns + of.left, y + of.top);
            if (to.x >= 0 && to.y >= 0 && to.x < upright_width && to.y < upright_height)
            {
                std::memcpy(pixels + to.y * row_stride + static_cast<std::ptrdiff_t>(pixel) * to.x,
                            band.data() + static_cast<std::size_t>(i) * pixel, pixel);
            }
        }
        advance(end - first);
    }
}

// Where a pixel of the display window as it is stored lies in the upright image.
ImageFile::Place ImageFile::after_orientation(int x, int y) const
{
    const std::uint32_t orientation = stored().orientation;
    const int across = static_cast<int>(stored().window_width);
    const int down = static_cast<int>(stored().window_height);
    if (orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8)
    {
        x = across - 1 - x;
    }
    if (orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7)
    {
        y = down - 1 - y;
    }
    return orientation > 4 ? Place{y, x} : Place{x, y};
}

void ImageFile::check_finite(int first, int end, const float *pixels, std::size_t row_stride,
                             Finite finite) const
{
    if (finite == Finite::any || stored().whole_numbers)
    {
        return;
    }
    const std::size_t count = static_cast<std::size_t>(channels());
    for (int row = first; row < end; ++row)
    {
        const float *const values = pixels + static_cast<std::size_t>(row - first) * row_stride;
        for (std::size_t i = 0; i < count * static_cast<std::size_t>(upright_width); ++i)
        {
            const bool not_a_number = std::isnan(values[i]);
            if (not_a_number || (finite == Finite::all && std::isinf(values[i])))
            {
                throw Failure(
                    in_quotes(name) + " has " + (not_a_number ? "a NaN" : "an infinite value") +
                    " at x = " + std::to_string(i / count) + ", y = " + std::to_string(row) +
                    ", channel " + channel_name(static_cast<int>(i % count)) +
                    (not_a_number ? "; only numbers can be resampled"
                                  : "; only --filter nearest can resample it"));
            }
        }
    }
}

std::size_t channel_bytes(cm_pixel_type type)
{
    return type == CM_PIXEL_U8 ? 1 : type == CM_PIXEL_FLOAT ? 4 : 2;
}

void check_memory(const std::string &what, std::int64_t pixels, int channels,
                  std::size_t channel_size, const std::string &advice)
{
    const double needed =
        static_cast<double>(pixels) * channels * static_cast<double>(channel_size);
    const double present =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    if (present > 0 && needed > present)
    {
        char text[100];
        std::snprintf(text, sizeof text, " needs %.1f GB of memory, this machine has %.1f GB",
                      needed / 1e9, present / 1e9);
        throw Failure(what + text + advice);
    }
}
