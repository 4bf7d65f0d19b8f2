// SPDX-License-Identifier: MIT

#include "direction_image.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>

#include <cubemap/cubemap.h>

namespace
{

constexpr double pi = 3.14159265358979323846;

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
    auto input = OIIO::ImageInput::open(name);
    if (!input || input->spec().nchannels != 3)
    {
        throw std::runtime_error(name + ": not an image of three channels");
    }
    Image image;
    image.width = input->spec().width;
    image.height = input->spec().height;
    image.pixels.resize(std::size_t(image.width) * std::size_t(image.height) * 3);
    if (!input->read_image(0, 0, 0, 3, OIIO::TypeFloat, image.pixels.data()))
    {
        throw std::runtime_error(name + ": " + input->geterror());
    }
    return image;
}

void write_image(const std::string &name, const OIIO::ImageSpec &spec, const float *pixels)
{
    auto output = OIIO::ImageOutput::create(name);
    if (!output || !output->open(name, spec) || !output->write_image(OIIO::TypeFloat, pixels) ||
        !output->close())
    {
        throw std::runtime_error(name + ": cannot be written");
    }
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
            const double lon = ((column + 0.5) / image.width - 0.5) * 2 * pi;
            const double lat = (0.5 - (row + 0.5) / image.height) * pi;
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
        write_image(face_name(name, file),
                    OIIO::ImageSpec(image.width, image.height, 3, OIIO::TypeFloat),
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
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc(type));
    for (const std::string &text : metadata)
    {
        const std::size_t equals = text.find('=');
        const std::string words = text.substr(equals + 1);
        if (words.find_first_not_of("0123456789") == std::string::npos)
        {
            spec.attribute(text.substr(0, equals), std::atoi(words.c_str()));
        }
        else
        {
            spec.attribute(text.substr(0, equals), words);
        }
    }
    const std::vector<float> pixels(
        std::size_t(width) * std::size_t(height) * std::size_t(channels), value);
    write_image(name, spec, pixels.data());
}

std::string describe_image(const std::string &name)
{
    const auto input = OIIO::ImageInput::open(name);
    if (!input)
    {
        return name + ": " + OIIO::geterror();
    }
    const OIIO::ImageSpec &spec = input->spec();
    std::string text = std::to_string(spec.width) + " x " + std::to_string(spec.height) + ", " +
                       std::to_string(spec.nchannels) + " channels, " + spec.format.c_str() + "\n";
    for (const OIIO::ParamValue &value : spec.extra_attribs)
    {
        text += value.name().string() + "=" + value.get_string() + "\n";
    }
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
