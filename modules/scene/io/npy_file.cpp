// SPDX-License-Identifier: MIT

#include "npy_file.h"

#include "file_failure.hpp"

#include "modules/image/io/file_words.h"
#include "modules/image/io/npy_head.h"

#include <cstdlib>
#include <cstring>
#include <memory>

namespace
{

constexpr std::uint64_t npy_pixels_most = std::uint64_t{1} << 31;
constexpr std::uint64_t npy_bytes_most = 8 * npy_pixels_most + 65536;
constexpr std::size_t npy_head = 10; // magic, version, length of 16 bits

struct NpyHead
{
    bool little = true;
    char letter = 'f'; // u, f
    std::size_t sample = 0;
    bool columns_first = false;
    std::uint64_t height = 0;
    std::uint64_t width = 0;
    std::size_t data = 0; // where the numbers begin
};

// The text of a dictionary: the value that follows a key, up to the comma or bracket that ends it.
class NpyWords
{
public:
    NpyWords(std::string file, std::string_view dictionary)
        : name(std::move(file)), text(dictionary)
    {
    }
    std::string_view value(const char *key) const
    {
        const std::string quoted = "'" + std::string(key) + "'";
        const std::size_t place = text.find(quoted);
        const std::size_t colon =
            place == std::string_view::npos ? place : text.find(':', place + quoted.size());
        const std::size_t begin =
            colon == std::string_view::npos ? colon : text.find_first_not_of(' ', colon + 1);
        if (begin == std::string_view::npos)
        {
            fail_file(name, "is no array of NumPy: its head has no " + std::string(key));
        }
        const char *const ends = text[begin] == '(' ? ")" : ",}";
        return text.substr(begin, std::min(text.find_first_of(ends, begin), text.size()) - begin);
    }

private:
    std::string name;
    std::string_view text;
};

void read_type(const std::string &name, std::string_view descr, NpyHead &head)
{
    const bool known = descr.size() == 5 && descr.front() == '\'' && descr.back() == '\'';
    const std::string type(known ? descr.substr(1, 3) : "");
    head.little = !known || type[0] != '>';
    head.letter = known ? type[1] : '?';
    head.sample = known ? static_cast<std::size_t>(type[2] - '0') : 0;
    const bool integer = head.letter == 'u' && head.sample == 2;
    const bool real =
        head.letter == 'f' && (head.sample == 2 || head.sample == 4 || head.sample == 8);
    const bool ordered = known && (type[0] == '<' || type[0] == '>');
    if (!ordered || (!integer && !real))
    {
        fail_file(name, "has numbers of type " + std::string(descr.substr(0, 20)) +
                            "; depth needs u2, f2, f4 or f8");
    }
}

void read_shape(const std::string &name, std::string_view shape, NpyHead &head)
{
    std::uint64_t *const to[2] = {&head.height, &head.width};
    std::size_t count = 0;
    for (std::size_t i = shape.find_first_of("0123456789"); i != std::string_view::npos; ++count)
    {
        const std::size_t end = std::min(shape.find_first_not_of("0123456789", i), shape.size());
        if (count < 2 && end - i <= 10)
        {
            *to[count] = std::strtoull(std::string(shape.substr(i, end - i)).c_str(), nullptr, 10);
        }
        i = shape.find_first_of("0123456789", end);
    }
    if (shape.front() != '(' || count != 2 || head.width == 0 || head.height == 0)
    {
        fail_file(name, "is not of two dimensions, rows and columns");
    }
    if (head.width >= npy_pixels_most || head.height >= npy_pixels_most / head.width)
    {
        fail_file(name, "has 2^31 numbers or more");
    }
}

NpyHead read_npy_head(const std::string &name, const unsigned char *bytes, std::size_t count)
{
    if (count < npy_head + 2 || std::memcmp(bytes, "\x93NUMPY", 6) != 0)
    {
        fail_file(name, "is no array of NumPy");
    }
    const bool longer = bytes[6] >= 2;
    const std::size_t begin = longer ? npy_head + 2 : npy_head;
    const std::size_t length =
        longer ? cm_file_u32(bytes + 8) : bytes[8] + std::size_t{256} * bytes[9];
    if (bytes[6] < 1 || bytes[6] > 3)
    {
        fail_file(name, "is an array of NumPy in version " + std::to_string(bytes[6]),
                  CM_ERROR_VERSION);
    }
    if (length > count - begin)
    {
        fail_file(name, "ends within its head");
    }
    const NpyWords words(name, {reinterpret_cast<const char *>(bytes) + begin, length});
    NpyHead head;
    read_type(name, words.value("descr"), head);
    read_shape(name, words.value("shape"), head);
    head.columns_first = words.value("fortran_order").substr(0, 4) == "True";
    head.data = begin + length;
    const std::uint64_t wanted = head.width * head.height * head.sample;
    if (count - head.data != wanted)
    {
        fail_file(name, "has " + std::to_string(count - head.data) + " bytes of numbers; " +
                            std::to_string(wanted) + " are wanted");
    }
    return head;
}

// Half to float (IEC 60559): a subnormal number is its significand by 2^-24.
float from_half(std::uint16_t half)
{
    const std::uint32_t exponent = half >> 10 & 31u;
    const std::uint32_t fraction = half & 1023u;
    float value = static_cast<float>(fraction) * 0x1p-24f;
    if (exponent != 0)
    {
        const std::uint32_t bits = (exponent == 31 ? 255u : exponent + 112u) << 23 | fraction << 13;
        std::memcpy(&value, &bits, sizeof value);
    }
    return (half & 0x8000u) != 0 ? -value : value;
}

float float_of(const unsigned char *at, std::size_t sample)
{
    if (sample == 2)
    {
        std::uint16_t half;
        std::memcpy(&half, at, sizeof half);
        return from_half(half);
    }
    if (sample == 4)
    {
        float value;
        std::memcpy(&value, at, sizeof value);
        return value;
    }
    double value;
    std::memcpy(&value, at, sizeof value);
    return static_cast<float>(value);
}

void parse_npy(const std::string &name, const unsigned char *bytes, std::size_t count,
               cm_image *picture)
{
    const NpyHead head = read_npy_head(name, bytes, count);
    const std::size_t pixels = static_cast<std::size_t>(head.width * head.height);
    const bool whole = head.letter == 'u';
    const std::size_t size = whole ? 2 : 4;
    std::unique_ptr<unsigned char, decltype(&std::free)> data(
        static_cast<unsigned char *>(std::malloc(pixels * size)), std::free);
    if (!data)
    {
        throw std::bad_alloc();
    }
    unsigned char sample[8];
    for (std::size_t i = 0; i < pixels; ++i)
    {
        const std::size_t row = i / head.width;
        const std::size_t from = head.columns_first ? i % head.width * head.height + row : i;
        std::memcpy(sample, bytes + head.data + from * head.sample, head.sample);
        cm_file_order(sample, 1, head.sample, head.little);
        const float value = whole ? 0.0f : float_of(sample, head.sample);
        std::memcpy(data.get() + i * size, whole ? static_cast<const void *>(sample) : &value,
                    size);
    }
    *picture = {};
    picture->size = sizeof *picture;
    picture->data = data.release();
    picture->type = whole ? CM_PIXEL_U16 : CM_PIXEL_FLOAT;
    picture->width = static_cast<std::uint32_t>(head.width);
    picture->height = static_cast<std::uint32_t>(head.height);
    picture->channels = 1;
}

std::string npy_bytes(const cm_image &picture)
{
    const std::size_t size = picture.type == CM_PIXEL_U16 ? 2 : 4;
    const std::uint64_t shape[2] = {picture.height, picture.width};
    char head[CM_NPY_HEAD];
    std::string bytes(head,
                      cm_npy_head(picture.type == CM_PIXEL_U16 ? "<u2" : "<f4", 2, shape, head));
    const std::ptrdiff_t across =
        picture.pixel_stride != 0 ? picture.pixel_stride : static_cast<std::ptrdiff_t>(size);
    const std::ptrdiff_t down =
        picture.row_stride != 0 ? picture.row_stride : across * std::ptrdiff_t{picture.width};
    char sample[4];
    for (std::uint32_t y = 0; y < picture.height; ++y)
    {
        const char *at = static_cast<const char *>(picture.data) + y * down;
        for (std::uint32_t x = 0; x < picture.width; ++x, at += across)
        {
            std::memcpy(sample, at, size);
            cm_file_order(sample, 1, size, true);
            bytes.append(sample, size);
        }
    }
    return bytes;
}

} // namespace

cm_status cm_npy_parse(const char *name, const void *bytes, size_t count, cm_image *picture,
                       char *message)
{
    if (name == nullptr || bytes == nullptr || picture == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(
        message,
        [&] { parse_npy(name, static_cast<const unsigned char *>(bytes), count, picture); });
}

cm_status cm_npy_read(const char *path, cm_image *picture, char *message)
{
    if (path == nullptr || picture == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message,
                        [&]
                        {
                            const std::string bytes = read_whole(path, npy_bytes_most);
                            parse_npy(path, reinterpret_cast<const unsigned char *>(bytes.data()),
                                      bytes.size(), picture);
                        });
}

cm_status cm_npy_write(const char *path, const cm_image *picture, char *message)
{
    if (path == nullptr || picture == nullptr || picture->data == nullptr ||
        picture->channels != 1 ||
        (picture->type != CM_PIXEL_U16 && picture->type != CM_PIXEL_FLOAT))
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message, [&] { write_whole(path, npy_bytes(*picture)); });
}
