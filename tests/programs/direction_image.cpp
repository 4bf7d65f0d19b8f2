// SPDX-License-Identifier: MIT

#include "direction_image.hpp"

#include "modules/image/io/image_io.h"
#include "picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <list>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <cubemap/cubemap.h>

namespace
{

constexpr double half_turn = 3.14159265358979323846;

struct Tag
{
    std::string key;
    std::string text;
    int number;
};

struct Image
{
    int width = 0;
    int height = 0;
    std::vector<float> pixels; // three channels
};

// Where each face stands in the cross, {column, row}.
struct Cross
{
    const char *frame;
    int place[6][2];
};

constexpr Cross crosses[] = {
    {"geo", {{1, 1}, {2, 1}, {3, 1}, {0, 1}, {1, 0}, {1, 2}}},
    {"fits", {{1, 0}, {1, 1}, {2, 1}, {3, 1}, {0, 1}, {1, 2}}},
    {"gl", {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}},
};

const Cross &cross_of(const std::string &frame)
{
    for (const Cross &cross : crosses)
    {
        if (frame == cross.frame)
        {
            return cross;
        }
    }
    throw std::runtime_error("no cross is known for frame " + frame);
}

std::string face_name(const std::string &pattern, int face)
{
    std::string name = pattern;
    const std::size_t at = name.find("%f");
    return at == std::string::npos ? name : name.replace(at, 2, std::to_string(face));
}

Image read_image(const std::string &name)
{
    Picture picture(name);
    if (picture.channels != 3)
    {
        throw std::runtime_error(name + ": not an image of three channels");
    }
    return {picture.width, picture.height, std::move(picture.values)};
}

// The format that the name's extension stands for.
const char *format_of(const std::string &name)
{
    const std::string extension = name.substr(name.rfind('.') + 1);
    return extension == "jpg"   ? "jpeg"
           : extension == "tif" ? "tiff"
           : extension == "exr" ? "openexr"
           : extension == "ppm" ? "pnm"
           : extension == "hdr" ? "hdr"
                                : "png";
}

void write_image(const std::string &name, const cm_image_description &description,
                 const float *pixels)
{
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_image_io *const io = cm_image_io_get(message);
    cm_image_writer *writer = nullptr;
    const bool good =
        io != nullptr &&
        io->create(name.c_str(), nullptr, &description, &writer, message) == CM_OK &&
        io->write(writer, 0, description.height, CM_PIXEL_FLOAT, pixels, 0, 0, message) == CM_OK &&
        io->finish(writer, message) == CM_OK;
    if (writer != nullptr)
    {
        io->drop(writer);
    }
    if (!good)
    {
        throw std::runtime_error(name + ": " + message);
    }
}

cm_image_description describe(const std::string &name, int width, int height, int channels)
{
    cm_image_description description = {};
    description.format = format_of(name);
    description.width = static_cast<std::uint32_t>(width);
    description.height = static_cast<std::uint32_t>(height);
    description.channels = static_cast<std::uint32_t>(channels);
    description.type = CM_PIXEL_FLOAT;
    description.alpha = channels > 3 ? 3 : -1;
    description.alpha_multiplied = true;
    return description;
}

class Sphere
{
public:
    explicit Sphere(const Shape &shape) : of(shape)
    {
        const cm_frame *const frame = cm_frame_find(shape.frame.c_str());
        first_row_v = frame != nullptr ? frame->first_row_v : 1;
        if (shape.specification != "equirect" &&
            cm_mapping_create(shape.specification.c_str(), frame, &mapping) != CM_OK)
        {
            throw std::runtime_error(shape.specification + ": not a mapping");
        }
    }
    ~Sphere()
    {
        cm_mapping_destroy(mapping);
    }
    Sphere(const Sphere &) = delete;
    Sphere &operator=(const Sphere &) = delete;

    bool in_files() const
    {
        return mapping != nullptr && of.layout == "faces";
    }

    // The direction of a pixel's centre; false if there is none, as in the corners of a cross or
    // beside a disc.
    bool direction(int file, const Image &image, int column, int row, double out[3]) const
    {
        if (mapping == nullptr)
        {
            const double lon = ((column + 0.5) / image.width - 0.5) * 2 * half_turn;
            const double lat = (0.5 - (row + 0.5) / image.height) * half_turn;
            cm_direction_from_lonlat(lon, lat, out);
            return true;
        }
        const int columns = of.layout == "cross" ? 4 : of.layout == "strip" ? 6 : 1;
        const int size = image.width / columns;
        const int face = in_files() ? file : face_at(column / size, row / size);
        const double down = (2.0 * (row % size) + 1) / size - 1;
        const double uv[2] = {(2.0 * (column % size) + 1) / size - 1, -first_row_v * down};
        cm_inverse(mapping, static_cast<std::uint8_t>(face), uv, out);
        return face < 6 && !std::isnan(out[0]);
    }

private:
    int face_at(int column, int row) const
    {
        int face = of.layout == "strip" ? column : 0;
        while (of.layout == "cross" && face < 6 &&
               (cross_of(of.frame).place[face][0] != column ||
                cross_of(of.frame).place[face][1] != row))
        {
            ++face;
        }
        return face;
    }

    const Shape of;
    int first_row_v = 1;
    cm_mapping *mapping = nullptr;
};

struct Errors
{
    double largest = 0;
    double sum = 0;
    double count = 0;
    std::string where = "nowhere";
};

void add_errors(const Sphere &sphere, int file, const std::string &name, Errors &errors)
{
    const Image image = read_image(name);
    for (std::size_t i = 0; i < image.pixels.size() / 3; ++i)
    {
        const int column = static_cast<int>(i % std::size_t(image.width));
        const int row = static_cast<int>(i / std::size_t(image.width));
        double direction[3];
        const bool there = sphere.direction(file, image, column, row, direction);
        double error = 0;
        for (std::size_t c = 0; c < 3; ++c)
        {
            const double wanted = there ? direction[c] : 0;
            error =
                std::fmax(error, std::fabs(static_cast<double>(image.pixels[3 * i + c]) - wanted));
        }
        errors.sum += error;
        ++errors.count;
        if (!(error <= errors.largest))
        {
            errors.largest = error;
            errors.where = name + " " + std::to_string(column) + " " + std::to_string(row);
        }
    }
}

} // namespace

void make_direction_image(const Shape &shape, int size, const std::string &name)
{
    const Sphere sphere(shape);
    const bool equirect = shape.specification == "equirect";
    const int columns = shape.layout == "cross" ? 4 : shape.layout == "strip" ? 6 : 1;
    const int rows = shape.layout == "cross" ? 3 : 1;
    for (int file = 0; file < (sphere.in_files() ? 6 : 1); ++file)
    {
        Image image;
        image.width = equirect ? size : columns * size;
        image.height = equirect ? size / 2 : rows * size;
        image.pixels.resize(std::size_t(image.width) * std::size_t(image.height) * 3);
        for (std::size_t i = 0; i < image.pixels.size() / 3; ++i)
        {
            const int column = static_cast<int>(i % std::size_t(image.width));
            const int row = static_cast<int>(i / std::size_t(image.width));
            double direction[3];
            const bool there = sphere.direction(file, image, column, row, direction);
            for (std::size_t c = 0; c < 3; ++c)
            {
                image.pixels[3 * i + c] = there ? static_cast<float>(direction[c]) : 0.0f;
            }
        }
        write_image(face_name(name, file), describe(name, image.width, image.height, 3),
                    image.pixels.data());
    }
}

void check_direction_image(const Shape &shape, const std::string &name, double largest, double mean)
{
    const Sphere sphere(shape);
    Errors errors;
    for (int file = 0; file < (sphere.in_files() ? 6 : 1); ++file)
    {
        add_errors(sphere, file, face_name(name, file), errors);
    }
    const double found_mean = errors.sum / errors.count;
    if (!(errors.largest <= largest && found_mean <= mean))
    {
        char text[400];
        std::snprintf(text, sizeof text, "largest error %.3g at %s, mean %.3g", errors.largest,
                      errors.where.c_str(), found_mean);
        throw std::runtime_error(text);
    }
}

void make_constant(int width, int height, int channels, const std::string &type, float value,
                   const std::string &name, const std::vector<std::string> &metadata)
{
    cm_image_description description = describe(name, width, height, channels);
    description.stored_type = type.c_str();
    std::list<Tag> tags;
    std::vector<cm_image_tag> given;
    for (const std::string &text : metadata)
    {
        const std::size_t equals = text.find('=');
        tags.push_back({text.substr(0, equals), text.substr(equals + 1), 0});
        Tag &tag = tags.back();
        tag.number = std::atoi(tag.text.c_str());
        const bool whole = tag.text.find_first_not_of("0123456789") == std::string::npos;
        if (tag.key == "oiio:UnassociatedAlpha")
        {
            description.alpha_multiplied = tag.number == 0;
            continue;
        }
        given.push_back({tag.key.c_str(), tag.text.c_str(), whole ? "int" : nullptr, &tag.number,
                         sizeof tag.number});
    }
    description.tags = given.data();
    description.tag_count = given.size();
    const std::vector<float> pixels(
        std::size_t(width) * std::size_t(height) * std::size_t(channels), value);
    write_image(name, description, pixels.data());
}

std::string describe_image(const std::string &name)
{
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_image_io *const io = cm_image_io_get(message);
    cm_image_reader *reader = nullptr;
    if (io == nullptr || io->open(name.c_str(), 0, &reader, message) != CM_OK)
    {
        return name + ": " + message;
    }
    const cm_image_description &stored = *io->describe(reader);
    std::string text = std::to_string(stored.width) + " x " + std::to_string(stored.height) + ", " +
                       std::to_string(stored.channels) + " channels, " + stored.stored_type + "\n";
    for (std::size_t i = 0; i < stored.tag_count; ++i)
    {
        text += std::string(stored.tags[i].key) + "=" + stored.tags[i].text + "\n";
    }
    io->close(reader);
    return text;
}

std::vector<std::string> catalogue_names(bool charts)
{
    std::vector<std::string> names;
    for (std::size_t i = 0; i < cm_catalogue_count(); ++i)
    {
        const cm_mapping_info *const info = cm_catalogue_at(i);
        const bool chart = info->kind == CM_KIND_AZIMUTHAL || info->kind == CM_KIND_LAYOUT;
        if (charts ? chart : info->kind == CM_KIND_CUBE)
        {
            names.emplace_back(info->identifier);
        }
    }
    return names;
}
