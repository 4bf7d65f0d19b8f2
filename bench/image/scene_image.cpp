// SPDX-License-Identifier: MIT
//
// Makes image files of an analytic scene (truth/analytic_scene.h), and says how far others are from it: what
// compare_engines gives to programs that resample, and how it judges what they make of it.
//
// Usage: scene-image make SCENE SURFACE TYPE FILE...
//        scene-image measure SCENE SURFACE RADIANS FILE...
//        scene-image plate SCENE SURFACE LOW HIGH FILE...
//        scene-image pass FILE SURFACE TYPE FILE
//
//   SCENE     waves:RADIANS, the shortest period; plate:FREQUENCY,GROWTH, in cycles a radian
//   SURFACE   equirect/WIDTH; cube/MAPPING/SIZE, in the frame geo. equirect-ends/WIDTH and cube-ends/MAPPING/SIZE are
//             those whose first and last pixels lie on the edges, as v360 has them
//   TYPE      uint8, uint16 or float
//   RADIANS   how wide regions are
//   FILE      one, which of a cube is a strip of six faces, or six. What is transparent in it is missing
//
// measure prints a line a region: its name, dB, values that are missing in millionths, the worst error, and the plane,
// column and row where it is. plate prints how many pixels have LOW to HIGH cycles, what deviates and the gain, in dB.
// pass reads the first file and writes the second as if it had made it from that, but makes nothing: what reading and
// writing alone take.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <cubemap/mapping.h>
#include <cubemap/number.h>

#include "modules/image/io/image_io.h"

#include "truth/scene_errors.h"

namespace
{

const double pi = 3.14159265358979323846;

// What an argument says, apart at a character.
std::vector<std::string> parts_of(const std::string &text, char at)
{
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (;;)
    {
        const std::size_t end = text.find(at, begin);
        parts.push_back(text.substr(begin, end - begin));
        if (end == std::string::npos)
        {
            return parts;
        }
        begin = end + 1;
    }
}

double number(const std::string &text)
{
    double value = 0.0;
    if (cm_number_parse(text.data(), text.size(), &value) == 0 || !std::isfinite(value))
    {
        throw std::runtime_error("'" + text + "' is no number");
    }
    return value;
}

std::size_t size_of(const std::string &text)
{
    const double value = number(text);
    if (value < 1.0 || value > 65536.0 || value != std::floor(value))
    {
        throw std::runtime_error("'" + text + "' is no size, 1 to 65536");
    }
    return static_cast<std::size_t>(value);
}

analytic_scene scene_of(const std::string &text)
{
    // far from axes, edges and corners
    const double axis[3] = {0.83, 0.29, 0.47};
    const std::size_t colon = text.find(':');
    const std::string kind = text.substr(0, colon);
    const auto words = parts_of(colon == std::string::npos ? "" : text.substr(colon + 1), ',');
    if (kind == "waves" && words.size() == 1)
    {
        return scene_waves(number(words[0]), 1);
    }
    if (kind == "plate" && words.size() == 2)
    {
        return scene_zone_plate(axis, number(words[0]), number(words[1]));
    }
    throw std::runtime_error("'" + text + "' is neither waves:RADIANS nor plate:FREQUENCY,GROWTH");
}

// Where a pixel is, from -1 to 1, if the first and the last are at the ends.
double between_ends(std::size_t index, std::size_t count)
{
    return count == 1 ? 0.0
                      : 2.0 * static_cast<double>(index) / static_cast<double>(count - 1) - 1.0;
}

void equirect_with_ends(const void *user, std::size_t, std::size_t row, double *x, double *y,
                        double *z)
{
    const auto *size = static_cast<const scene_size *>(user);
    const double lat = -0.5 * pi * between_ends(row, size->height);
    for (std::size_t i = 0; i < size->width; i++)
    {
        const double lon = pi * between_ends(i, size->width);
        x[i] = std::cos(lat) * std::cos(lon);
        y[i] = std::cos(lat) * std::sin(lon);
        z[i] = std::sin(lat);
    }
}

void faces_with_ends(const void *user, std::size_t plane, std::size_t row, double *x, double *y,
                     double *z)
{
    const auto *cube = static_cast<const scene_cube *>(user);
    for (std::size_t i = 0; i < cube->size; i++)
    {
        const double uv[2] = {between_ends(i, cube->size), -between_ends(row, cube->size)};
        double d[3];
        cm_inverse(cube->mapping, static_cast<std::uint8_t>(plane), uv, d);
        x[i] = d[0];
        y[i] = d[1];
        z[i] = d[2];
    }
}

// What reads and writes image files.
const cm_image_io &image_io()
{
    char message[CM_IMAGE_MESSAGE];
    const cm_image_io *const io = cm_image_io_get(message);
    if (io == nullptr)
    {
        throw std::runtime_error(message);
    }
    return *io;
}

cm_pixel_type pixel_type(const std::string &type)
{
    return type == "uint8" ? CM_PIXEL_U8 : type == "uint16" ? CM_PIXEL_U16 : CM_PIXEL_FLOAT;
}

// Of the names that are used here.
const char *format_of(const std::string &file)
{
    const std::string end = file.substr(file.rfind('.') + 1);
    return end == "png" ? "png" : end == "exr" ? "openexr" : end == "jpg" ? "jpeg" : "tiff";
}

void write_image(const std::string &file, const cm_image_description &description,
                 const void *pixels)
{
    char message[CM_IMAGE_MESSAGE];
    const cm_image_io &io = image_io();
    cm_image_writer *writer = nullptr;
    cm_status status = io.create(file.c_str(), nullptr, &description, &writer, message);
    status = status != CM_OK
                 ? status
                 : io.write(writer, 0, description.height, description.type, pixels, 0, 0, message);
    status = status != CM_OK ? status : io.finish(writer, message);
    io.drop(writer);
    if (status != CM_OK)
    {
        throw std::runtime_error(file + " " + message);
    }
}

// An image file that is open.
class Reader
{
public:
    explicit Reader(const std::string &file) : name(file)
    {
        char message[CM_IMAGE_MESSAGE];
        if (image_io().open(file.c_str(), 0, &reader, message) != CM_OK)
        {
            throw std::runtime_error("cannot read " + file + ": " + message);
        }
    }
    ~Reader()
    {
        image_io().close(reader);
    }
    Reader(const Reader &) = delete;
    Reader &operator=(const Reader &) = delete;

    const cm_image_description &stored() const
    {
        return *image_io().describe(reader);
    }

    void read(cm_pixel_type type, void *pixels) const
    {
        char message[CM_IMAGE_MESSAGE];
        const cm_image_region all = {0, 0, stored().width, stored().height};
        if (image_io().read(reader, &all, type, pixels, 0, message) != CM_OK)
        {
            throw std::runtime_error("cannot read " + name + ": " + message);
        }
    }

private:
    std::string name;
    cm_image_reader *reader = nullptr;
};

// A surface with what it points to, and pictures of it in files.
class Pictures
{
public:
    explicit Pictures(const std::string &text)
    {
        const auto words = parts_of(text, '/');
        const bool has_ends = words[0] == "equirect-ends" || words[0] == "cube-ends";
        if (words.size() == 2 && (words[0] == "equirect" || words[0] == "equirect-ends"))
        {
            size.width = size_of(words[1]);
            size.height = size.width / 2;
            on_sphere = scene_equirect(&size, scene_widths{});
            on_sphere.directions = has_ends ? equirect_with_ends : on_sphere.directions;
            return;
        }
        if (words.size() != 3 || (words[0] != "cube" && words[0] != "cube-ends"))
        {
            throw std::runtime_error("'" + text +
                                     "' is neither equirect/WIDTH nor cube/MAPPING/SIZE");
        }
        cube.size = size_of(words[2]);
        if (cm_mapping_create(words[1].c_str(), nullptr, &mapping) != CM_OK)
        {
            throw std::runtime_error("there is no mapping '" + words[1] + "'");
        }
        cube.mapping = mapping;
        on_sphere = scene_faces(&cube, scene_widths{});
        on_sphere.directions = has_ends ? faces_with_ends : on_sphere.directions;
    }
    Pictures(const Pictures &) = delete;
    Pictures &operator=(const Pictures &) = delete;
    ~Pictures()
    {
        cm_mapping_destroy(mapping);
    }

    const scene_surface &surface() const
    {
        return on_sphere;
    }
    void set_regions(double radians)
    {
        on_sphere.widths = scene_widths_of_pixels(1.0, radians);
    }

    void write(const analytic_scene &scene, const std::string &type,
               const std::vector<std::string> &files);
    scene_pictures read(const std::vector<std::string> &files);
    // One file, of any bytes.
    void write_bytes(const std::vector<unsigned char> &bytes, const std::string &type,
                     const std::string &file);

private:
    // Places for the planes in files.
    scene_pictures place(std::size_t files, scene_type type, std::size_t bytes);
    scene_pictures place(std::size_t files, const std::string &type);
    void write_files(const std::string &type, const std::vector<std::string> &files) const;
    void read_file(std::size_t index, const std::string &file);

    scene_size size{};
    scene_cube cube{};
    cm_mapping *mapping = nullptr;
    scene_surface on_sphere{};
    std::size_t wide = 0; // of one file, in pixels
    std::vector<std::vector<unsigned char>> memory;
    std::vector<void *> planes;
};

scene_pictures Pictures::place(std::size_t files, scene_type type, std::size_t bytes)
{
    if (files != 1 && files != on_sphere.planes)
    {
        throw std::runtime_error("there must be one file, or one for each face");
    }
    const std::size_t beside = files == 1 ? on_sphere.planes : 1;
    const std::size_t row = on_sphere.width * SCENE_CHANNELS * bytes;
    wide = beside * on_sphere.width;
    memory.assign(files, std::vector<unsigned char>(beside * row * on_sphere.height));
    planes.clear();
    for (std::size_t p = 0; p < on_sphere.planes; p++)
    {
        planes.push_back(files == 1 ? memory[0].data() + p * row : memory[p].data());
    }
    return {type, beside * row, planes.data()};
}

scene_pictures Pictures::place(std::size_t files, const std::string &type)
{
    if (type == "uint8")
    {
        return place(files, SCENE_U8, 1);
    }
    if (type == "uint16")
    {
        return place(files, SCENE_U16, 2);
    }
    if (type == "float")
    {
        return place(files, SCENE_FLOAT, sizeof(float));
    }
    throw std::runtime_error("'" + type + "' is neither uint8, uint16 nor float");
}

void Pictures::write_files(const std::string &type, const std::vector<std::string> &files) const
{
    cm_image_description description = {};
    description.width = static_cast<std::uint32_t>(wide);
    description.height = static_cast<std::uint32_t>(on_sphere.height);
    description.format = format_of(files.front());
    description.channels = SCENE_CHANNELS;
    description.type = pixel_type(type);
    description.alpha = -1;
    description.compression = "none";
    for (std::size_t i = 0; i < files.size(); i++)
    {
        write_image(files[i], description, memory[i].data());
    }
}

void Pictures::write(const analytic_scene &scene, const std::string &type,
                     const std::vector<std::string> &files)
{
    const scene_pictures pictures = place(files.size(), type);
    if (scene_fill(&scene, &on_sphere, &pictures) == 0)
    {
        throw std::runtime_error("no memory");
    }
    write_files(type, files);
}

void Pictures::write_bytes(const std::vector<unsigned char> &bytes, const std::string &type,
                           const std::string &file)
{
    place(1, type);
    std::copy_n(bytes.begin(), std::min(bytes.size(), memory[0].size()), memory[0].begin());
    write_files(type, {file});
}

// Whole or cropped, with or without alpha; what is beside it, or transparent, is NaN.
void Pictures::read_file(std::size_t index, const std::string &file)
{
    const Reader reader(file);
    const cm_image_description &stored = reader.stored();
    const std::size_t channels = stored.channels;
    const std::size_t width = stored.width;
    const std::size_t height = stored.height;
    const bool is_cropped = width != wide || height != on_sphere.height;
    const auto left = static_cast<std::size_t>(is_cropped ? stored.left : 0);
    const auto top = static_cast<std::size_t>(is_cropped ? stored.top : 0);
    if (channels < SCENE_CHANNELS || left + width > wide || top + height > on_sphere.height)
    {
        throw std::runtime_error(file + " has " + std::to_string(width) + " x " +
                                 std::to_string(height) + " pixels of " + std::to_string(channels) +
                                 " channels");
    }
    std::vector<float> pixels(width * height * channels);
    reader.read(CM_PIXEL_FLOAT, pixels.data());
    auto *to = reinterpret_cast<float *>(memory[index].data());
    for (std::size_t i = 0; i < wide * on_sphere.height * SCENE_CHANNELS; i++)
    {
        to[i] = std::numeric_limits<float>::quiet_NaN();
    }
    for (std::size_t i = 0; i < width * height; i++)
    {
        const std::size_t pixel = (i / width + top) * wide + i % width + left;
        const float *from = &pixels[i * channels];
        const bool is_there = stored.alpha < 0 || from[stored.alpha] > 0.0f;
        for (std::size_t c = 0; c < SCENE_CHANNELS && is_there; c++)
        {
            to[pixel * SCENE_CHANNELS + c] = from[c];
        }
    }
}

scene_pictures Pictures::read(const std::vector<std::string> &files)
{
    const scene_pictures pictures = place(files.size(), SCENE_FLOAT, sizeof(float));
    for (std::size_t i = 0; i < files.size(); i++)
    {
        read_file(i, files[i]);
    }
    return pictures;
}

void measure(const analytic_scene &scene, Pictures &pictures, const std::vector<std::string> &files)
{
    scene_errors errors;
    const scene_pictures read = pictures.read(files);
    if (scene_measure(&scene, &pictures.surface(), &read, &errors) == 0)
    {
        throw std::runtime_error("no memory");
    }
    for (int region = 0; region < SCENE_REGIONS; region++)
    {
        const scene_error &e = errors.region[region];
        const double values = static_cast<double>(e.count + e.missing);
        std::printf("%s %.3f %.1f %.6f %zu %zu %zu\n",
                    scene_region_name(static_cast<scene_region>(region)), scene_decibels(&e),
                    1e6 * static_cast<double>(e.missing) / values, e.worst, e.plane, e.column,
                    e.row);
    }
}

void measure_plate(const analytic_scene &plate, Pictures &pictures, const double frequencies[2],
                   const std::vector<std::string> &files)
{
    scene_response response;
    const scene_pictures read = pictures.read(files);
    if (scene_measure_plate(&plate, &pictures.surface(), &read, frequencies[0], frequencies[1],
                            &response) == 0)
    {
        throw std::runtime_error("no memory");
    }
    std::printf("%zu %.3f %.3f\n", response.count, 20.0 * std::log10(response.deviation),
                20.0 * std::log10(std::fabs(response.gain)));
}

void pass(const std::string &from, Pictures &pictures, const std::string &type,
          const std::string &to)
{
    const Reader reader(from);
    const cm_image_description &stored = reader.stored();
    std::vector<unsigned char> pixels(std::size_t{stored.width} * stored.height * stored.channels *
                                      cm_pixel_size(stored.type));
    reader.read(stored.type, pixels.data());
    pictures.write_bytes(pixels, type, to);
}

void run(const std::vector<std::string> &words)
{
    const std::string what = words.empty() ? "" : words[0];
    const std::size_t own = what == "plate" ? 5 : 4;
    if (what == "pass" && words.size() == 5)
    {
        Pictures pictures(words[2]);
        pass(words[1], pictures, words[3], words[4]);
        return;
    }
    if ((what != "make" && what != "measure" && what != "plate") || words.size() <= own)
    {
        throw std::runtime_error("usage: scene-image make SCENE SURFACE TYPE FILE...\n"
                                 "       scene-image measure SCENE SURFACE RADIANS FILE...\n"
                                 "       scene-image plate SCENE SURFACE LOW HIGH FILE...\n"
                                 "       scene-image pass FILE SURFACE TYPE FILE");
    }
    const std::vector<std::string> files(words.begin() + static_cast<std::ptrdiff_t>(own),
                                         words.end());
    const analytic_scene scene = scene_of(words[1]);
    Pictures pictures(words[2]);
    if (what == "make")
    {
        pictures.write(scene, words[3], files);
    }
    else if (what == "measure")
    {
        pictures.set_regions(number(words[3]));
        measure(scene, pictures, files);
    }
    else if (scene.is_plate == 0)
    {
        throw std::runtime_error("'" + words[1] + "' is no plate");
    }
    else
    {
        const double frequencies[2] = {number(words[3]), number(words[4])};
        measure_plate(scene, pictures, frequencies, files);
    }
}

} // namespace

int main(int argc, char **argv)
{
    try
    {
        run(std::vector<std::string>(argv + 1, argv + argc));
    }
    catch (const std::exception &failure)
    {
        std::fprintf(stderr, "scene-image: %s\n", failure.what());
        return 1;
    }
    return 0;
}
