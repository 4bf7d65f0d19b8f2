// SPDX-License-Identifier: MIT
//
// Maps of HEALPix in FITS: a binary table, each column a channel. "HEALPix Primer", section 4; Calabretta & Roukema 2007
// for what the pixels are. Read as the picture of the surface "healpix".

#include "healpix_words.hpp"
#include "image_reader.hpp"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <deque>
#include <limits>
#include <vector>

#include <fitsio.h>

#include <OpenImageIO/imageio.h>

namespace
{

// Pixels are read in pieces of so many.
constexpr std::int64_t read_at_once = 1 << 16;

struct FitsCloser
{
    void operator()(fitsfile *opened) const noexcept
    {
        int status = 0;
        fits_close_file(opened, &status);
        fits_clear_errmsg();
    }
};

using FitsPointer = std::unique_ptr<fitsfile, FitsCloser>;

std::string key_text(fitsfile *file, const char *key)
{
    char value[FLEN_VALUE] = "";
    int status = 0;
    fits_read_key(file, TSTRING, key, value, nullptr, &status);
    fits_clear_errmsg();
    return status == 0 ? value : "";
}

std::int64_t key_number(fitsfile *file, const char *key, std::int64_t otherwise)
{
    LONGLONG value = 0;
    int status = 0;
    fits_read_key(file, TLONGLONG, key, &value, nullptr, &status);
    fits_clear_errmsg();
    return status == 0 ? value : otherwise;
}

struct Column
{
    int number = 0; // from 1
    int type = 0;   // of CFITSIO
    std::int64_t repeat = 0;
    std::string name;
};

std::vector<Column> columns_of(fitsfile *file)
{
    int count = 0;
    int status = 0;
    fits_get_num_cols(file, &count, &status);
    std::vector<Column> columns;
    for (int i = 1; i <= count; ++i)
    {
        Column column;
        LONGLONG repeat = 0;
        LONGLONG width = 0;
        column.number = i;
        fits_get_coltypell(file, i, &column.type, &repeat, &width, &status);
        check_fits(status, "is a damaged FITS table");
        column.repeat = repeat;
        column.name = key_text(file, ("TTYPE" + std::to_string(i)).c_str());
        const bool number = column.type == TBYTE || column.type == TSBYTE ||
                            column.type == TSHORT || column.type == TUSHORT ||
                            column.type == TINT || column.type == TUINT || column.type == TLONG ||
                            column.type == TULONG || column.type == TLONGLONG ||
                            column.type == TFLOAT || column.type == TDOUBLE;
        if (number && repeat > 0)
        {
            columns.push_back(column);
        }
    }
    return columns;
}

// Goes to the table of a map. False if there is none.
bool find_map(fitsfile *file)
{
    int count = 0;
    int status = 0;
    fits_get_num_hdus(file, &count, &status);
    for (int i = 1; i <= count && status == 0; ++i)
    {
        int type = 0;
        fits_movabs_hdu(file, i, &type, &status);
        if (status == 0 && type == BINARY_TBL &&
            (key_text(file, "PIXTYPE") == "HEALPIX" || key_number(file, "NSIDE", 0) > 0))
        {
            return true;
        }
    }
    fits_clear_errmsg();
    return false;
}

class HealpixReader final : public cm_image_reader
{
public:
    explicit HealpixReader(FitsPointer opened);
    void read(const cm_image_region &region, cm_pixel_type type, char *pixels,
              std::ptrdiff_t row_stride) override;

private:
    void find_order();
    void find_columns();
    void describe();
    void load();
    void read_all(const Column &column, std::size_t channel, std::vector<float> &list);
    void read_some(const Column &column, std::size_t channel, std::vector<float> &list);
    float value_of(float stored) const;
    const char *keep(const std::string &text);

    FitsPointer file;
    std::int64_t nside = 0;
    bool nested = false;
    bool part = false; // with the numbers of its pixels
    std::int64_t rows = 0;
    std::int64_t first_pixel = 0;
    float bad = unseen_value;
    Column numbers; // of the pixels of a part
    std::vector<Column> columns;
    std::vector<float> picture;
    std::deque<std::string> texts; // which the description points to
    std::vector<const char *> names;
    std::vector<cm_image_tag> tags;
};

HealpixReader::HealpixReader(FitsPointer opened) : file(std::move(opened))
{
    find_order();
    find_columns();
    describe();
}

void HealpixReader::find_order()
{
    const std::string order = key_text(file.get(), "ORDERING");
    nside = key_number(file.get(), "NSIDE", 0);
    nested = order == "NESTED" || order == "NEST";
    if (!nested && order != "RING")
    {
        throw ImageFailure("is a HEALPix map whose ORDERING is '" + order +
                           "', neither RING nor NESTED");
    }
    if (nside < 1 || nside > INT32_MAX / 12 || (nested && (nside & (nside - 1)) != 0))
    {
        throw ImageFailure("is a HEALPix map of NSIDE " + std::to_string(nside) +
                           ", which no picture can have");
    }
    const std::string scheme = key_text(file.get(), "INDXSCHM");
    const std::string object = key_text(file.get(), "OBJECT");
    part = scheme == "EXPLICIT" || (scheme.empty() && object == "PARTIAL");
    int status = 0;
    LONGLONG count = 0;
    fits_get_num_rowsll(file.get(), &count, &status);
    check_fits(status, "is a damaged FITS table");
    rows = count;
    first_pixel = part ? 0 : key_number(file.get(), "FIRSTPIX", 0);
    float value = 0;
    fits_read_key(file.get(), TFLOAT, "BAD_DATA", &value, nullptr, &status);
    bad = status == 0 ? value : unseen_value;
    fits_clear_errmsg();
}

void HealpixReader::find_columns()
{
    columns = columns_of(file.get());
    if (part && !columns.empty())
    {
        numbers = columns.front();
        columns.erase(columns.begin());
    }
    const bool whole_type = numbers.type == TSHORT || numbers.type == TINT ||
                            numbers.type == TLONG || numbers.type == TLONGLONG;
    if (columns.empty() || columns.size() > CM_CHANNELS_MAX || (part && !whole_type))
    {
        throw ImageFailure("is a HEALPix map without columns of numbers that could be channels");
    }
    const std::int64_t pixels = 12 * nside * nside;
    for (const Column &column : columns)
    {
        // rows of a damaged file may be any number
        const bool fits = part ? column.repeat == numbers.repeat
                               : rows <= pixels && column.repeat <= pixels && first_pixel >= 0 &&
                                     first_pixel <= pixels &&
                                     column.repeat * rows <= pixels - first_pixel;
        if (!fits)
        {
            throw ImageFailure("is a HEALPix map of " + std::to_string(pixels) +
                               " pixels whose column " + std::to_string(column.number) +
                               " has another number of them");
        }
    }
}

const char *HealpixReader::keep(const std::string &text)
{
    texts.push_back(text);
    return texts.back().c_str();
}

void HealpixReader::describe()
{
    description.format = "fits";
    description.width = description.window_width = static_cast<std::uint32_t>(12 * nside);
    description.height = description.window_height = static_cast<std::uint32_t>(nside);
    description.channels = static_cast<std::uint32_t>(columns.size());
    description.type = CM_PIXEL_FLOAT;
    description.stored_type = "float";
    for (const Column &column : columns)
    {
        names.push_back(
            keep(column.name.empty() ? "column" + std::to_string(column.number) : column.name));
        description.stored_type = column.type == TDOUBLE ? "double" : description.stored_type;
    }
    description.channel_names = names.data();
    description.alpha = -1;
    description.color = CM_IMAGE_COLOR_UNKNOWN;
    description.orientation = 1;
    description.subimage_count = 1;
    tags.push_back(
        {"cubemap:surface", keep("healpix:" + std::to_string(nside)), nullptr, nullptr, 0});
    const std::string rotation = key_text(file.get(), rotation_key);
    if (!rotation.empty())
    {
        tags.push_back({"cubemap:rotation", keep(rotation), nullptr, nullptr, 0});
    }
    const std::string axes = key_text(file.get(), "COORDSYS");
    if (!axes.empty())
    {
        tags.push_back({"COORDSYS", keep(axes), nullptr, nullptr, 0});
    }
    description.tags = tags.data();
    description.tag_count = tags.size();
}

// Pixels without a value are NaN. Some files write the number with few digits.
float HealpixReader::value_of(float stored) const
{
    const bool none = std::fabs(stored - bad) <= 1e-5f * std::fabs(bad) && bad != 0.0f;
    return none ? std::numeric_limits<float>::quiet_NaN() : stored;
}

void HealpixReader::read_all(const Column &column, std::size_t channel, std::vector<float> &list)
{
    std::vector<float> values(static_cast<std::size_t>(read_at_once));
    float none = std::numeric_limits<float>::quiet_NaN();
    const std::int64_t count = column.repeat * rows;
    for (std::int64_t done = 0; done < count;)
    {
        const std::int64_t some = std::min(read_at_once, count - done);
        int status = 0;
        int any = 0;
        fits_read_col(file.get(), TFLOAT, column.number, done / column.repeat + 1,
                      done % column.repeat + 1, some, &none, values.data(), &any, &status);
        check_fits(status, "is damaged or ends too early");
        for (std::int64_t i = 0; i < some; ++i)
        {
            const auto pixel = static_cast<std::size_t>(first_pixel + done + i);
            list[pixel * columns.size() + channel] = value_of(values[static_cast<std::size_t>(i)]);
        }
        done += some;
    }
}

void HealpixReader::read_some(const Column &column, std::size_t channel, std::vector<float> &list)
{
    std::vector<float> values(static_cast<std::size_t>(read_at_once));
    std::vector<LONGLONG> pixels(static_cast<std::size_t>(read_at_once));
    float none = std::numeric_limits<float>::quiet_NaN();
    const std::int64_t count = column.repeat * rows;
    for (std::int64_t done = 0; done < count;)
    {
        const std::int64_t some = std::min(read_at_once, count - done);
        const std::int64_t row = done / column.repeat + 1;
        const std::int64_t at = done % column.repeat + 1;
        int status = 0;
        int any = 0;
        LONGLONG no_pixel = -1;
        fits_read_col(file.get(), TFLOAT, column.number, row, at, some, &none, values.data(), &any,
                      &status);
        fits_read_col(file.get(), TLONGLONG, numbers.number, row, at, some, &no_pixel,
                      pixels.data(), &any, &status);
        check_fits(status, "is damaged or ends too early");
        for (std::size_t i = 0; i < static_cast<std::size_t>(some); ++i)
        {
            if (pixels[i] < 0 || pixels[i] >= 12 * nside * nside)
            {
                throw ImageFailure("is a HEALPix map that has no pixel " +
                                   std::to_string(pixels[i]) + ", and a value for it");
            }
            list[static_cast<std::size_t>(pixels[i]) * columns.size() + channel] =
                value_of(values[i]);
        }
        done += some;
    }
}

void HealpixReader::load()
{
    if (!picture.empty())
    {
        return;
    }
    const std::size_t size = static_cast<std::size_t>(12 * nside * nside) * columns.size();
    std::vector<float> list(size, std::numeric_limits<float>::quiet_NaN());
    for (std::size_t channel = 0; channel < columns.size(); ++channel)
    {
        part ? read_some(columns[channel], channel, list)
             : read_all(columns[channel], channel, list);
    }
    std::vector<float> arranged(size);
    arrange_map(nside, nested, false, columns.size(), list.data(), arranged.data());
    picture = std::move(arranged);
}

void HealpixReader::read(const cm_image_region &region, cm_pixel_type type, char *pixels,
                         std::ptrdiff_t row_stride)
{
    load();
    const int channels = static_cast<int>(columns.size());
    const std::ptrdiff_t pixel = channels * static_cast<std::ptrdiff_t>(sizeof(float));
    const std::ptrdiff_t row = pixel * static_cast<std::ptrdiff_t>(description.width);
    const char *const first = reinterpret_cast<const char *>(picture.data()) +
                              static_cast<std::ptrdiff_t>(region.y0) * row +
                              static_cast<std::ptrdiff_t>(region.x0) * pixel;
    if (!OIIO::convert_image(channels, static_cast<int>(region.x1 - region.x0),
                             static_cast<int>(region.y1 - region.y0), 1, first, OIIO::TypeFloat,
                             pixel, row, OIIO::AutoStride, pixels, type_of(type),
                             channels * size_of(type), row_stride, OIIO::AutoStride))
    {
        throw ImageFailure("cannot be read as pixels of another type");
    }
}

// FITS, or something compressed that may be.
bool may_be_fits(const std::string &path)
{
    char begin[9] = "";
    std::FILE *const file = std::fopen(path.c_str(), "rb");
    if (file == nullptr)
    {
        return false;
    }
    const std::size_t count = std::fread(begin, 1, sizeof begin, file);
    std::fclose(file);
    return count == sizeof begin && (std::memcmp(begin, "SIMPLE  =", sizeof begin) == 0 ||
                                     std::memcmp(begin, "\x1f\x8b", 2) == 0);
}

} // namespace

// Pictures in FITS are for the library.
ReaderPointer open_healpix(const std::string &path, std::uint32_t which)
{
    fitsfile *opened = nullptr;
    int status = 0;
    if (!may_be_fits(path))
    {
        return nullptr;
    }
    fits_open_diskfile(&opened, path.c_str(), READONLY, &status);
    fits_clear_errmsg();
    FitsPointer file(status == 0 ? opened : nullptr);
    if (!file || !find_map(file.get()))
    {
        return nullptr;
    }
    if (which > 0)
    {
        throw ImageFailure("has no picture " + std::to_string(which) + "; it has 1, from 0",
                           CM_ERROR_ARGUMENT);
    }
    return std::make_unique<HealpixReader>(std::move(file));
}
