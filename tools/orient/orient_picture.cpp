// SPDX-License-Identifier: MIT

#include "orient_picture.hpp"
#include "tools/image/cube_image.hpp"
#include "tools/image/lettering.hpp"
#include "tools/cli/image_file.hpp"
#include "tools/cli/image_writer.hpp"
#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

#include <cubemap/distortion.h>
#include <cubemap/image.h>

namespace
{

using Color = std::array<float, 3>;

constexpr Color paper = {1.0f, 1.0f, 1.0f};
constexpr Color outline = {0.15f, 0.15f, 0.2f};
constexpr Color sea = {0.80f, 0.86f, 0.91f};
// of the mask, from where nothing is deformed to 31 degrees, the corners of most mappings
constexpr std::array<Color, 4> land = {
    {{0.98f, 0.93f, 0.70f}, {0.95f, 0.69f, 0.29f}, {0.84f, 0.33f, 0.17f}, {0.45f, 0.04f, 0.15f}}};
constexpr double degree = 3.14159265358979 / 180.0;
constexpr double most_deformation = 31.0 * degree;
constexpr int title_letters = 26;
constexpr int least_with_words = 80; // pixels of a face

float mix(float a, float b, float part)
{
    return a + (b - a) * part;
}

Color land_color(double deformation)
{
    const double last = static_cast<double>(land.size() - 1);
    const double at = std::clamp(deformation / most_deformation, 0.0, 1.0) * last;
    const std::size_t k = std::min(static_cast<std::size_t>(at), land.size() - 2);
    const float part = static_cast<float>(at - static_cast<double>(k));
    Color color{};
    for (std::size_t i = 0; i < 3; ++i)
    {
        color[i] = mix(land[k][i], land[k + 1][i], part);
    }
    return color;
}

void check_shape(const ImageFile &file)
{
    if (file.width() != 2 * file.height())
    {
        throw Failure(in_quotes(file.path()) + " is " + std::to_string(file.width()) + " x " +
                      std::to_string(file.height()) +
                      ", but an equirectangular image is twice as wide as high");
    }
}

// The luminance of linear Rec. 709, of which files that hold grey have no need.
float gray_of(const float *pixel, int channels)
{
    return channels < 3 ? pixel[0] : 0.2126f * pixel[0] + 0.7152f * pixel[1] + 0.0722f * pixel[2];
}

// A picture of the library's, dense.
cm_image image_of(std::vector<float> &pixels, int width, int height, int channels)
{
    cm_image image = {};
    image.size = sizeof image;
    image.data = pixels.data();
    image.type = CM_PIXEL_FLOAT;
    image.width = static_cast<std::uint32_t>(width);
    image.height = static_cast<std::uint32_t>(height);
    image.channels = static_cast<std::uint32_t>(channels);
    return image;
}

void check(cm_status status)
{
    if (status == CM_ERROR_MEMORY)
    {
        throw std::bad_alloc();
    }
    if (status != CM_OK)
    {
        throw Failure(std::string("the picture: ") + cm_status_text(status));
    }
}

struct SurfaceDeleter
{
    void operator()(cm_surface *owned) const noexcept
    {
        cm_surface_destroy(owned);
    }
};

std::unique_ptr<cm_surface, SurfaceDeleter> surface_of(const std::string &specification,
                                                       const cm_rotation *rotation)
{
    cm_surface_options options = {};
    options.size = sizeof options;
    options.rotation = rotation;
    cm_surface *made = nullptr;
    check(cm_surface_create(specification.c_str(), &options, &made));
    return std::unique_ptr<cm_surface, SurfaceDeleter>(made);
}

using Faces = std::array<std::vector<float>, 6>;

// The faces of a cube that is turned so, size x size pixels each, from an image.
Faces faces_of(const WholeImage &image, const std::string &mapping, int size,
               const cm_rotation &turn, int threads)
{
    const auto from = surface_of("equirect;size=" + std::to_string(image.width), nullptr);
    const auto to =
        surface_of("cube:" + mapping + ";frame=geo;size=" + std::to_string(size), &turn);
    cm_plan_options options = {};
    options.size = sizeof options;
    options.filter = CM_FILTER_BILINEAR;
    cm_plan *plan = nullptr;
    check(cm_plan_create(from.get(), to.get(), &options, &plan));
    const std::unique_ptr<cm_plan, void (*)(cm_plan *)> owned(plan, cm_plan_destroy);
    cm_image whole = image_of(const_cast<std::vector<float> &>(image.pixels), image.width,
                              image.height, image.channels);
    cm_source *source = nullptr;
    check(cm_source_create(plan, &whole, CM_PIXEL_FLOAT, static_cast<unsigned>(threads), &source));
    const std::unique_ptr<cm_source, void (*)(cm_source *)> kept(source, cm_source_destroy);
    Faces faces;
    std::array<cm_image, 6> pictures;
    for (std::size_t i = 0; i < faces.size(); ++i)
    {
        faces[i].resize(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) *
                        static_cast<std::size_t>(image.channels));
        pictures[i] = image_of(faces[i], size, size, image.channels);
    }
    check(cm_resample_source(plan, source, pictures.data(), cm_rows{},
                             static_cast<unsigned>(threads)));
    return faces;
}

} // namespace

WholeImage read_equirect(const std::string &path, bool gray)
{
    ImageFile file(path);
    check_shape(file);
    check_memory(in_quotes(path), std::int64_t{file.width()} * file.height(), file.channels() + 3);
    const std::size_t channels = static_cast<std::size_t>(file.channels());
    const std::size_t row = static_cast<std::size_t>(file.width()) * channels;
    std::vector<float> stored(row * static_cast<std::size_t>(file.height()));
    file.read(stored.data(), row, Finite::all);
    WholeImage image{file.width(), file.height(), gray ? 1 : 3, {}};
    image.pixels.reserve(stored.size() / channels * static_cast<std::size_t>(image.channels));
    for (std::size_t at = 0; at < stored.size(); at += channels)
    {
        for (std::size_t i = 0; i < static_cast<std::size_t>(image.channels); ++i)
        {
            image.pixels.push_back(gray ? gray_of(&stored[at], file.channels())
                                        : stored[at + (channels < 3 ? 0 : i)]);
        }
    }
    return image;
}

struct OrientPicture::Parts
{
    Parts(const OrientOptions &options, const WholeImage &mask_image)
        : mask(mask_image), mapping_name(options.mapping),
          cube(options.mapping, *cm_frame_find("geo"), options.size),
          mapping(make_mapping(options.mapping, *cm_frame_find("geo"))), size(options.size),
          name(options.picture)
    {
        format = output_format(name);
        if (!options.image.empty())
        {
            image = std::make_unique<WholeImage>(read_equirect(options.image, false));
        }
        files.push_back(std::make_unique<AtomicFile>(name));
    }

    int gap() const
    {
        return std::max(size / 16, 2);
    }
    int width() const
    {
        return 4 * size + 2 * gap();
    }
    int height() const
    {
        return 6 * size + 3 * gap();
    }

    // The dots of letters, of which a line fits beside a face of the cross.
    int dot() const
    {
        return size / least_with_words;
    }
    int words_left() const
    {
        return 2 * gap() + 2 * size;
    }

    void write_lines(const Canvas &canvas, int top, const std::vector<std::string> &lines) const;
    void draw_lengths(const Canvas &canvas, int top) const;
    void draw_colors(const Canvas &canvas, int top) const;
    void draw_row(const Faces &shown, int face, int row, float *pixels) const;
    void color_mask(int face, int row, const float *values, float *pixels) const;

    const WholeImage &mask;
    std::string mapping_name;
    CubeImage cube;
    MappingPointer mapping;
    int size;
    std::string name;
    std::string format;
    std::unique_ptr<WholeImage> image; // that is shown in place of the mask
    std::vector<std::unique_ptr<AtomicFile>> files;
};

// How much a row of a face counts, and how much it is deformed.
void OrientPicture::Parts::color_mask(int face, int row, const float *values, float *pixels) const
{
    thread_local PointBatch batch;
    thread_local std::array<double, PointBatch::capacity> deformation;
    for (int column = 0; column < size;)
    {
        const std::size_t count =
            std::min(PointBatch::capacity, static_cast<std::size_t>(size - column));
        cube.directions(face, row, column, count, batch);
        cm_distortion_arrays arrays{};
        arrays.deformation = deformation.data();
        cm_forward_distortion_array(mapping.get(), count, batch.direction_x.data(),
                                    batch.direction_y.data(), batch.direction_z.data(), &arrays);
        for (std::size_t i = 0; i < count; ++i, ++column)
        {
            const Color full = land_color(deformation[i]);
            const float part = std::clamp(values[column], 0.0f, 1.0f);
            for (std::size_t k = 0; k < 3; ++k)
            {
                pixels[3 * column + static_cast<int>(k)] = mix(sea[k], full[k], part);
            }
        }
    }
}

void OrientPicture::Parts::draw_row(const Faces &shown, int face, int row, float *pixels) const
{
    const std::size_t width = static_cast<std::size_t>(size) * (image ? 3 : 1);
    const float *const values =
        shown[static_cast<std::size_t>(face)].data() + width * static_cast<std::size_t>(row);
    if (image)
    {
        std::copy_n(values, width, pixels);
    }
    else
    {
        color_mask(face, row, values, pixels);
    }
    for (int column = 0; column < size; ++column)
    {
        if (row == 0 || row == size - 1 || column == 0 || column == size - 1)
        {
            std::copy(outline.begin(), outline.end(), pixels + 3 * column);
        }
    }
}

void OrientPicture::Parts::write_lines(const Canvas &canvas, int top,
                                       const std::vector<std::string> &lines) const
{
    for (const std::string &line : lines)
    {
        write_text(canvas, words_left(), top, line.substr(0, title_letters), dot());
        top += text_height(dot()) * 3 / 2;
    }
}

// A bar as long as a face is wide.
void OrientPicture::Parts::draw_lengths(const Canvas &canvas, int top) const
{
    const int left = words_left();
    fill_box(canvas, left, top + 2 * dot(), left + size, top + 3 * dot(), outline);
    for (const int x : {left, left + size / 2, left + size - dot()})
    {
        fill_box(canvas, x, top, x + dot(), top + 5 * dot(), outline);
    }
    write_lines(canvas, top + 8 * dot(), {"90 degrees, 10008 km", "along the middle of a face"});
}

// What the colours of the mask mean.
void OrientPicture::Parts::draw_colors(const Canvas &canvas, int top) const
{
    const int left = words_left();
    const int width = 2 * size - 8 * gap() / 2;
    const int strip_bottom = top + 40 * dot();
    write_lines(canvas, top, {"angular deformation omega,", "degrees"});
    for (int x = 0; x < width; ++x)
    {
        fill_box(canvas, left + x, top + 24 * dot(), left + x + 1, strip_bottom,
                 land_color(most_deformation * (x + 0.5) / width));
    }
    for (const int degrees : {0, 10, 20, 31})
    {
        const std::string number = std::to_string(degrees);
        const int x =
            left + static_cast<int>(std::lround(degrees * degree / most_deformation * width));
        fill_box(canvas, x, strip_bottom, x + dot(), strip_bottom + 3 * dot(), outline);
        write_text(canvas, x - text_width(number, dot()) / 2, strip_bottom + 5 * dot(), number,
                   dot());
    }
}

OrientPicture::OrientPicture(const OrientOptions &options, const WholeImage &mask)
    : parts(std::make_unique<Parts>(options, mask))
{
}

OrientPicture::~OrientPicture() = default;

void OrientPicture::write(const cm_rotation &after,
                          const std::array<std::vector<std::string>, 2> &titles, int threads)
{
    const cm_rotation before = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const std::size_t row_floats = 3 * static_cast<std::size_t>(parts->width());
    std::vector<float> pixels(row_floats * static_cast<std::size_t>(parts->height()));
    for (std::size_t i = 0; i < pixels.size(); ++i)
    {
        pixels[i] = paper[i % 3];
    }
    const PictureLayout cross = cube_pictures(CubeLayout::cross, *cm_frame_find("geo")).front();
    const int size = parts->size;
    const WholeImage &from = parts->image ? *parts->image : parts->mask;
    const std::array<Faces, 2> shown = {faces_of(from, parts->mapping_name, size, before, threads),
                                        faces_of(from, parts->mapping_name, size, after, threads)};
    parallel_for(2 * 6 * size, threads,
                 [&](int job)
                 {
                     const Placement &place =
                         cross.placements[static_cast<std::size_t>(job / size % 6)];
                     const int half = job / size / 6;
                     const int row = job % size;
                     const int y =
                         parts->gap() + half * (3 * size + parts->gap()) + place.row * size + row;
                     const int x = parts->gap() + place.column * size;
                     parts->draw_row(shown[static_cast<std::size_t>(half)], place.plane, row,
                                     pixels.data() + static_cast<std::size_t>(y) * row_floats +
                                         3 * static_cast<std::size_t>(x));
                 });
    if (size >= least_with_words)
    {
        const Canvas canvas = {pixels.data(), parts->width(), parts->height()};
        const int second = 3 * size + parts->gap();
        parts->write_lines(canvas, 2 * parts->gap(), titles[0]);
        parts->write_lines(canvas, 2 * parts->gap() + second, titles[1]);
        parts->draw_lengths(canvas, 2 * size + 3 * parts->gap());
        if (!parts->image)
        {
            parts->draw_colors(canvas, 2 * size + 3 * parts->gap() + second);
        }
    }
    const std::string &format = parts->format;
    const ImageDescription description(3, CM_PIXEL_U8);
    ImageWriter writer(plan_image(format, description, format, parts->name), parts->width(),
                       parts->height(), parts->name, *parts->files.back(), threads);
    writer.write(0, parts->height(), pixels.data(), 3);
    writer.close();
    parts->files.back()->finish();
    appear_together(parts->files);
}
