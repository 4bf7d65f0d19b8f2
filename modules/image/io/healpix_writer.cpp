// SPDX-License-Identifier: MIT
//
// Maps of HEALPix in FITS, as HEALPix's own programs write them: a binary table with a column of floats a channel, all
// pixels in their order. "HEALPix Primer", section 4.

#include "healpix_words.hpp"
#include "row_writer.hpp"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <fitsio.h>

#include <OpenImageIO/imageio.h>

namespace
{

constexpr std::int64_t pixels_a_row = 1024; // where they are a multiple of it
constexpr std::size_t written_at_once = std::size_t{1} << 20;

const char *tag_of(const cm_image_description &description, const char *key)
{
    for (std::size_t i = 0; i < description.tag_count; ++i)
    {
        if (std::strcmp(description.tags[i].key, key) == 0)
        {
            return description.tags[i].text;
        }
    }
    return "";
}

// A FITS file in memory, which CFITSIO lets grow.
struct FitsMemory
{
    ~FitsMemory()
    {
        if (file != nullptr)
        {
            int status = 0;
            fits_close_file(file, &status);
            fits_clear_errmsg();
        }
        std::free(bytes);
    }
    fitsfile *file = nullptr;
    void *bytes = nullptr;
    std::size_t size = 0;
};

class HealpixWriter final : public cm_image_writer
{
public:
    HealpixWriter(const cm_image_stream &to, const cm_image_description &description);
    void write(std::uint32_t first, std::uint32_t end, cm_pixel_type type, const char *pixels,
               std::ptrdiff_t pixel_stride, std::ptrdiff_t row_stride) override;
    void finish() override;

private:
    void make_table(fitsfile *file) const;
    void write_keys(fitsfile *file) const;
    void write_column(fitsfile *file, std::size_t channel, const std::vector<float> &list) const;

    const cm_image_stream stream;
    std::int64_t nside;
    std::size_t channels;
    bool nested;
    std::string axes;
    std::string rotation;
    std::vector<std::string> names;
    std::vector<float> picture;
    std::uint32_t next_row = 0;
};

HealpixWriter::HealpixWriter(const cm_image_stream &to, const cm_image_description &description)
    : stream(to), nside(description.height), channels(description.channels),
      nested(std::strcmp(tag_of(description, "ORDERING"), "NESTED") == 0),
      axes(tag_of(description, "COORDSYS")), rotation(tag_of(description, "cubemap:rotation"))
{
    if (nside < 1 || description.width != 12 * nside || nside > INT32_MAX / 12 || channels < 1 ||
        channels > CM_CHANNELS_MAX)
    {
        throw ImageFailure("cannot be written: it is " + std::to_string(description.width) + " x " +
                               std::to_string(description.height) +
                               ", and a HEALPix map is 12 NSIDE x NSIDE",
                           CM_ERROR_ARGUMENT);
    }
    if (nested && (nside & (nside - 1)) != 0)
    {
        throw ImageFailure("cannot be written: NSIDE " + std::to_string(nside) +
                               " is no power of two, which NESTED needs",
                           CM_ERROR_ARGUMENT);
    }
    for (std::size_t i = 0; i < channels; ++i)
    {
        names.push_back(description.channel_names != nullptr ? description.channel_names[i]
                                                             : "SIGNAL" + std::to_string(i + 1));
    }
    picture.resize(static_cast<std::size_t>(12 * nside * nside) * channels);
}

void HealpixWriter::write(std::uint32_t first, std::uint32_t end, cm_pixel_type type,
                          const char *pixels, std::ptrdiff_t pixel_stride,
                          std::ptrdiff_t row_stride)
{
    if (first != next_row || end <= first || end > nside)
    {
        throw ImageFailure("cannot be written: rows must come in order, each once",
                           CM_ERROR_ARGUMENT);
    }
    const int count = static_cast<int>(channels);
    const std::ptrdiff_t x_stride = pixel_stride == 0 ? size_of(type) * count : pixel_stride;
    const int width = static_cast<int>(12 * nside);
    const std::size_t row = static_cast<std::size_t>(width) * channels;
    if (!OIIO::convert_image(count, width, static_cast<int>(end - first), 1, pixels, type_of(type),
                             x_stride, row_stride == 0 ? x_stride * width : row_stride,
                             OIIO::AutoStride, picture.data() + first * row, OIIO::TypeFloat,
                             OIIO::AutoStride, OIIO::AutoStride, OIIO::AutoStride))
    {
        throw ImageFailure("cannot be written: pixels of that type are no floats");
    }
    next_row = end;
}

void HealpixWriter::make_table(fitsfile *file) const
{
    const std::int64_t pixels = 12 * nside * nside;
    const std::int64_t repeat = pixels % pixels_a_row == 0 ? pixels_a_row : 1;
    const std::string form = std::to_string(repeat) + "E";
    std::vector<char *> types;
    std::vector<char *> forms;
    for (const std::string &name : names)
    {
        types.push_back(const_cast<char *>(name.c_str())); // which CFITSIO does not change
        forms.push_back(const_cast<char *>(form.c_str()));
    }
    int status = 0;
    fits_create_img(file, BYTE_IMG, 0, nullptr, &status);
    fits_create_tbl(file, BINARY_TBL, pixels / repeat, static_cast<int>(channels), types.data(),
                    forms.data(), nullptr, nullptr, &status);
    check_fits(status, "cannot be written");
}

void HealpixWriter::write_keys(fitsfile *file) const
{
    int status = 0;
    const auto text = [&](const char *key, const std::string &value, const char *comment)
    { fits_write_key_str(file, key, value.c_str(), comment, &status); };
    const auto number = [&](const char *key, std::int64_t value, const char *comment)
    { fits_write_key_lng(file, key, value, comment, &status); };
    text("PIXTYPE", "HEALPIX", "HEALPix pixelisation");
    text("ORDERING", nested ? "NESTED" : "RING", "order of the pixels: RING or NESTED");
    number("NSIDE", nside, "pixels along the edge of a base pixel");
    number("FIRSTPIX", 0, "the first pixel");
    number("LASTPIX", 12 * nside * nside - 1, "the last pixel");
    text("INDXSCHM", "IMPLICIT", "all pixels are there, in their order");
    text("OBJECT", "FULLSKY", "the whole sphere");
    if (!axes.empty())
    {
        text("COORDSYS", axes, "G: galactic, E: ecliptic, C: celestial");
    }
    if (!rotation.empty())
    {
        text(rotation_key, rotation, "lon, lat, roll of the axes, degrees");
    }
    fits_write_key_flt(file, "BAD_DATA", unseen_value, 5, "value of pixels without one", &status);
    check_fits(status, "cannot be written");
}

void HealpixWriter::write_column(fitsfile *file, std::size_t channel,
                                 const std::vector<float> &list) const
{
    const std::size_t pixels = list.size() / channels;
    const std::size_t repeat = pixels % pixels_a_row == 0 ? pixels_a_row : 1;
    std::vector<float> values;
    for (std::size_t done = 0; done < pixels; done += values.size())
    {
        values.resize(std::min(written_at_once, pixels - done));
        for (std::size_t i = 0; i < values.size(); ++i)
        {
            const float value = list[(done + i) * channels + channel];
            values[i] = std::isnan(value) ? unseen_value : value;
        }
        int status = 0;
        fits_write_col(file, TFLOAT, static_cast<int>(channel + 1),
                       static_cast<LONGLONG>(done / repeat + 1),
                       static_cast<LONGLONG>(done % repeat + 1),
                       static_cast<LONGLONG>(values.size()), values.data(), &status);
        check_fits(status, "cannot be written");
    }
}

void HealpixWriter::finish()
{
    if (next_row != nside)
    {
        throw ImageFailure("cannot be written: rows are missing", CM_ERROR_ARGUMENT);
    }
    std::vector<float> list(picture.size());
    arrange_map(nside, nested, true, channels, picture.data(), list.data());
    picture = {};
    FitsMemory memory;
    int status = 0;
    fits_create_memfile(&memory.file, &memory.bytes, &memory.size, std::size_t{1} << 20,
                        std::realloc, &status);
    check_fits(status, "cannot be written");
    make_table(memory.file);
    write_keys(memory.file);
    for (std::size_t channel = 0; channel < channels; ++channel)
    {
        write_column(memory.file, channel, list);
    }
    // whole blocks of 2880 bytes are the file, the rest is room
    LONGLONG begin = 0;
    LONGLONG data = 0;
    LONGLONG end = 0;
    fits_flush_file(memory.file, &status);
    fits_get_hduaddrll(memory.file, &begin, &data, &end, &status);
    check_fits(status, "cannot be written");
    stream.seek(stream.context, 0);
    stream.write(stream.context, memory.bytes, static_cast<std::size_t>(end));
}

} // namespace

WriterPointer begin_healpix(const cm_image_stream *stream, const cm_image_description &description)
{
    return std::make_unique<HealpixWriter>(*stream, description);
}
