// SPDX-License-Identifier: MIT

#include "sphere_files.hpp"
#include "face_names.hpp"
#include "face_parts.hpp"
#include "geo_reference.hpp"
#include "sidecar.hpp"
#include "texture_faces.hpp"
#include "tools/cli/program.hpp"

#include <cmath>
#include <filesystem>
#include <utility>

namespace
{

std::string size_text(const ImageFile &image)
{
    return std::to_string(image.width()) + " x " + std::to_string(image.height());
}

// Does the image have this shape, in squares?
bool has_shape(const ImageFile &image, int columns, int rows)
{
    return image.width() % columns == 0 && image.height() % rows == 0 &&
           image.width() / columns == image.height() / rows;
}

// Which of the two types holds the values of both: 16 bits of whole numbers do not fit into half, nor the other way round.
ImageDescription deeper(const ImageDescription &one, const ImageDescription &other)
{
    const bool none = (one.type == CM_PIXEL_U16 && other.type == CM_PIXEL_HALF) ||
                      (one.type == CM_PIXEL_HALF && other.type == CM_PIXEL_U16);
    ImageDescription deepest = one.type >= other.type ? one : other;
    if (none || one.type == other.type)
    {
        deepest.type = CM_PIXEL_FLOAT;
        deepest.stored_type = "float";
    }
    return deepest;
}

// Does the command line say what INPUT is?
bool is_said(const SurfaceOptions &from)
{
    return !from.specification.empty() || !from.layout.empty() || !from.frame.empty();
}

// With or without a border.
bool is_six(const std::string &layout)
{
    return layout.substr(0, layout.find(':')) == "faces";
}

std::string layout_of(const SurfaceOptions &from)
{
    return from.layout.empty() ? key_of(from.specification, "layout") : from.layout;
}

// What there is instead of a file that is not there.
void check_there(const std::string &name, const std::vector<std::string> &names,
                 const std::string &option)
{
    if (std::filesystem::exists(name))
    {
        return;
    }
    if (names.size() > 1)
    {
        throw Failure(in_quotes(name) +
                      " cannot be read: No such file or directory; all six faces are needed, " +
                      in_quotes(names.front()) + " to " + in_quotes(names.back()));
    }
    const std::string face = face_names(name).front();
    if (std::filesystem::exists(face) && names_faces(name))
    {
        throw Failure(in_quotes(name) + " cannot be read: No such file or directory, but " +
                      in_quotes(face) + " is; " + option +
                      " says that it is one image; layout=faces stands for six");
    }
    if (std::filesystem::exists(face))
    {
        const std::string extension = std::filesystem::path(name).extension().string();
        throw Failure(
            in_quotes(name) + " cannot be read: No such file or directory, but " + in_quotes(face) +
            " is; " +
            in_quotes(name.substr(0, name.size() - extension.size()) + "_%f" + extension) +
            " stands for six faces");
    }
}

// By GDAL if nothing else reads it.
ImageFile open_picture(const std::string &name, int threads)
{
    try
    {
        return ImageFile(name, threads);
    }
    catch (const UnreadableImage &failure)
    {
        return open_by_gdal(name, failure.what());
    }
}

// Why a picture cannot be taken as it stands: it is placed on the Earth as a surface cannot be. "": it can.
std::string why_by_gdal(const ImageFile &image, const SphereOptions &options)
{
    const GeoPlace place = geographic_place(image);
    if (place.otherwise.empty() || place.unit_is_unknown || is_said(options.from))
    {
        return "";
    }
    return in_quotes(image.path()) + " is placed on the Earth " + place.otherwise +
           "; make it EPSG:4326 (gdalwarp -t_srs EPSG:4326), or say " + options.option +
           " SPEC to take it as something else";
}

// Are there pixels without a value that only GDAL tells? Of several channels of whole numbers it does not tell them.
bool may_miss_values(const ImageFile &image, const SphereOptions &options)
{
    return geographic_place(image).misses_values && !is_said(options.from) &&
           (image.stored().channels == 1 || !image.stored().whole_numbers);
}

// Are pixels of both surfaces, which are of one size, in the same places, but for a tenth of a pixel?
bool shows_alike(const cm_surface &one, const cm_surface &other)
{
    const double width = cm_surface_plane_width(&one);
    const double height = cm_surface_plane_height(&one);
    for (const double right : {0.5, width / 2, width - 0.5})
    {
        for (const double down : {0.5, height / 2, height - 0.5})
        {
            const std::uint8_t first = 0;
            double at[3];
            std::uint8_t plane = 0;
            double x = 0;
            double y = 0;
            cm_surface_directions(&one, 1, &first, &right, &down, &at[0], &at[1], &at[2]);
            cm_surface_positions(&other, 1, &at[0], &at[1], &at[2], &plane, &x, &y);
            if (plane != 0 || std::fabs(x - right) > 0.1 || std::fabs(y - down) > 0.1)
            {
                return false;
            }
        }
    }
    return true;
}

// "cube:qsc;size=16, turned by 10,20,30"
std::string text_of(const SavedSurface &saved)
{
    return saved.specification +
           (saved.rotation ? ", turned by " + rotation_text(*saved.rotation) : "");
}

// Colours of inks are made light of by the library, which knows no profile.
bool has_inks(const ImageFile &image)
{
    const cm_image_description &of = image.stored();
    for (std::size_t i = 0; i < of.tag_count; ++i)
    {
        const std::string key = of.tags[i].key;
        const std::string space = of.tags[i].text;
        // most JPEG files of inks have three of the four as luminance and two differences
        if ((key == "tiff:ColorSpace" || key == "jpeg:ColorSpace") &&
            (space == "CMYK" || space == "YCbCrK"))
        {
            return true;
        }
    }
    return false;
}

} // namespace

SphereFiles::SphereFiles(SphereOptions options, int threads, std::vector<ImageFile> opened)
    : asked(std::move(options)), images(std::move(opened))
{
    open(threads);
    choose_type();
    if (!asked.as_it_stands)
    {
        open_placed();
    }
    if (has_inks(images.front()))
    {
        remarks.push_back(in_quotes(images.front().path()) +
                          " is CMYK; its colours are converted without a profile");
    }
}

void SphereFiles::open(int threads)
{
    const SurfaceOptions &from = asked.from;
    const bool cube = from.specification.empty() || is_cube(from.specification);
    const std::string layout = layout_of(from);
    faces = cube && (is_six(layout) || (layout.empty() && names_faces(asked.name)));
    const std::vector<std::string> names =
        faces ? face_names(asked.name) : std::vector<std::string>{asked.name};
    if (faces && !images.empty())
    {
        throw UsageFailure("INPUT is a pipe, through which the six faces of a cube come as one "
                           "picture; --from-layout says how");
    }
    for (std::size_t i = images.size(); i < names.size(); ++i)
    {
        check_there(names[i], names, asked.option);
        images.push_back(open_picture(names[i], threads));
    }
    if (images.size() == 1 && has_six_faces(images.front()))
    {
        for (std::uint32_t face = 1; face < 6; ++face)
        {
            images.emplace_back(asked.name, 0, face);
        }
        faces = true;
        texture = true;
    }
    else if (images.size() == 1 && images.front().stored().subimage_count > 1)
    {
        open_parts(cube && (layout.empty() || is_six(layout)));
    }
    if (faces)
    {
        check_faces();
        if (!is_said(from))
        {
            check_tags();
        }
    }
}

void SphereFiles::open_placed()
{
    const std::string why = images.size() == 1 ? why_by_gdal(images.front(), asked) : "";
    const bool may_miss = images.size() == 1 && may_miss_values(images.front(), asked);
    if (!why.empty() || (may_miss && has_gdal()))
    {
        images.front() = open_by_gdal(images.front().path(), why);
        remarks.clear(); // they were of the picture that GDAL has read otherwise
        choose_type();
    }
    else if (may_miss)
    {
        remarks.push_back(in_quotes(images.front().path()) +
                          " has a value that stands for none, which is taken as a value: these "
                          "programs were built without GDAL");
    }
}

// The parts of an OpenEXR file may be six faces; of all other files with several pictures the first one is taken.
void SphereFiles::open_parts(bool may_be_faces)
{
    const cm_image_description &first = images.front().stored();
    if (may_be_faces && first.subimage_count == 6 && images.front().format() == "openexr")
    {
        std::vector<ImageFile> parts;
        for (std::uint32_t i = 0; i < first.subimage_count; ++i)
        {
            parts.emplace_back(asked.name, 0, i);
        }
        faces = are_faces(parts);
        if (faces)
        {
            // who tells faces by axes has y up, as for a texture
            const bool tagged = saved_surface(parts.front()).has_value();
            texture = !tagged && order_parts(parts) == PartOrder::gl;
            images = std::move(parts);
            return;
        }
    }
    remarks.push_back(
        in_quotes(asked.name) + " has " + std::to_string(first.subimage_count) +
        " pictures; the first is taken" +
        (first.subimage_name == nullptr ? "" : ", " + in_quotes(first.subimage_name)));
}

void SphereFiles::check_faces() const
{
    const ImageFile &first = images.front();
    for (const ImageFile &image : images)
    {
        if (image.width() != image.height())
        {
            throw Failure(in_quotes(image.path()) + " is " + size_text(image) +
                          "; the face of a cube must be square");
        }
        if (image.width() != first.width() || image.channels() != first.channels())
        {
            throw Failure(in_quotes(image.path()) + " is " + size_text(image) + " with " +
                          std::to_string(image.channels()) +
                          (image.channels() == 1 ? " channel, " : " channels, ") +
                          in_quotes(first.path()) + " is " + size_text(first) + " with " +
                          std::to_string(first.channels()) + "; all six faces must be alike");
        }
    }
}

// Faces that say of themselves that they are of different cubes are of none.
void SphereFiles::check_tags() const
{
    const auto said_by = [](const ImageFile &image)
    {
        const std::optional<SavedSurface> saved = saved_surface(image);
        return saved ? text_of(*saved) : std::string();
    };
    const std::string first = said_by(images.front());
    for (const ImageFile &image : images)
    {
        const std::string other = said_by(image);
        if (!first.empty() && !other.empty() && other != first)
        {
            throw Failure(in_quotes(image.path()) + " says that it is " + other + ", " +
                          in_quotes(images.front().path()) + " " + first +
                          "; take faces of one cube, or say " + asked.option + " SPEC");
        }
    }
}

// Of faces that differ in depth the deepest holds what is in all of them.
void SphereFiles::choose_type()
{
    pixels = ImageDescription(images.front().stored());
    types = images.front().pixel_type();
    if (images.front().format() == "pnm" && !images.front().stored().whole_numbers)
    {
        pixels.color = CM_IMAGE_COLOR_LINEAR; // PFM, which cannot say so
    }
    for (const ImageFile &image : images)
    {
        const ImageDescription other(image.stored());
        if (other.alpha != pixels.alpha || other.alpha_multiplied != pixels.alpha_multiplied)
        {
            throw Failure(in_quotes(image.path()) + " has alpha otherwise than " +
                          in_quotes(images.front().path()) + "; all six faces must be alike");
        }
        if (image.pixel_type() == pixels.stored_type)
        {
            continue;
        }
        types +=
            types.find(image.pixel_type()) == std::string::npos ? " and " + image.pixel_type() : "";
        const ImageDescription deepest = deeper(pixels, other);
        pixels.type = deepest.type;
        pixels.stored_type = deepest.stored_type;
    }
    types += types.find(' ') == std::string::npos ? "" : ", taken as " + pixels.stored_type;
}

// ---- what it is

void SphereFiles::find_surface()
{
    std::optional<SavedSurface> saved = find_saved();
    if (texture && !saved && !is_said(asked.from))
    {
        saved = texture_surface();
    }
    if (is_said(asked.from))
    {
        const std::string &said = asked.from.specification;
        const bool usual = texture && is_cube(said) && asked.from.frame.empty() &&
                           !asked.from.rotation && key_of(said, "frame").empty();
        take(said.empty() || is_cube(said) ? cube_by_shape() : said,
             usual ? texture_surface().rotation : asked.from.rotation);
        if (saved)
        {
            compare_with(*saved, *sphere, turned);
        }
        return;
    }
    if (!saved && !faces)
    {
        tell_ignored();
    }
    const std::optional<std::string> place = find_place(saved);
    if (saved && !(place && is_elsewhere(*saved, *place)) && take_saved(*saved, place.has_value()))
    {
        return;
    }
    take(place ? *place : cube_by_shape(), asked.from.rotation);
}

void SphereFiles::tell_ignored()
{
    const std::string numbers = geographic_place(images.front()).ignored;
    if (!numbers.empty())
    {
        remarks.push_back(in_quotes(images.front().path()) + " has " + numbers +
                          " and no system of coordinates; they are ignored, unless " +
                          asked.option + " says what it covers");
    }
}

// Where its georeference has it; numbers in an unknown unit are degrees if the tag says the same.
std::optional<std::string> SphereFiles::find_place(const std::optional<SavedSurface> &saved) const
{
    const GeoPlace place = faces ? GeoPlace() : geographic_place(images.front());
    if (place.specification || !place.unit_is_unknown)
    {
        return place.specification;
    }
    if (saved && !place.in_degrees.empty() && is_there(*saved, place.in_degrees))
    {
        return place.in_degrees;
    }
    throw Failure(in_quotes(images.front().path()) + " is placed on the Earth " + place.otherwise +
                  "; say " + asked.option + " " +
                  (place.in_degrees.empty()
                       ? "SPEC, what it covers in degrees, or give it the system that they are of "
                         "(gdal_edit.py -a_srs EPSG:CODE)"
                       : in_quotes(place.in_degrees) +
                             " if they are degrees, or give it a system (gdal_edit.py -a_srs "
                             "EPSG:4326)"));
}

bool SphereFiles::is_there(const SavedSurface &saved, const std::string &place) const
{
    const ImageFile &image = images.front();
    std::string message;
    const SurfacePointer said = make_surface(without_size(saved.specification), image.width(),
                                             image.height(), saved.rotation, message);
    const SurfacePointer there = make_surface(place, image.width(), image.height(), {}, message);
    return said && there && shows_alike(*said, *there);
}

// A raster that somebody has cut, moved or warped still has the tag of the picture that it was made from.
bool SphereFiles::is_elsewhere(const SavedSurface &saved, const std::string &place)
{
    if (is_there(saved, place))
    {
        return false;
    }
    remarks.push_back(says(saved) + saved.specification + ", and its georeference that it is " +
                      place + "; the georeference counts, unless " + asked.option +
                      " says otherwise");
    return true;
}

// What a file beside the picture says of it. A stream has none.
std::optional<SavedSurface> SphereFiles::saved_beside() const
{
    const ImageFile &image = images.front();
    return image.is_stream() ? std::nullopt : surface_beside(asked.name, image.path());
}

// What the picture says counts more than what a file beside it does.
std::optional<SavedSurface> SphereFiles::find_saved()
{
    const ImageFile &image = images.front();
    std::optional<SavedSurface> own = saved_surface(image);
    std::optional<SavedSurface> beside = saved_beside();
    if (!own || !beside)
    {
        return own ? own : beside;
    }
    if (text_of(*own) != text_of(*beside))
    {
        remarks.push_back(says(*own) + text_of(*own) + ", and " + in_quotes(beside->where) + " " +
                          text_of(*beside) + "; what the picture says counts");
    }
    return own;
}

std::string SphereFiles::says(const SavedSurface &saved) const
{
    const std::string image = in_quotes(images.front().path());
    return saved.where.empty() ? image + " says that it is "
                               : in_quotes(saved.where) + " says that " + image + " is ";
}

// False if the picture does not have the shape that its tag means: somebody has cut or scaled it since.
bool SphereFiles::take_saved(const SavedSurface &saved, bool is_placed)
{
    const ImageFile &image = images.front();
    const std::string name = says(saved);
    const SizeThen size = size_of_then(saved, image);
    const bool of_six = is_six(key_of(saved.specification, "layout"));
    if (of_six && !faces)
    {
        throw Failure(name + "one of six faces, " + saved.specification +
                      "; give the name of all, with %f, or say " + asked.option + " SPEC");
    }
    const std::optional<cm_rotation> rotation =
        asked.from.rotation ? asked.from.rotation : saved.rotation;
    const std::string specification = without_size(saved.specification);
    const std::string but_is =
        (saved.where.empty() ? ", but is " : ", but that is ") + size_text(image);
    std::string message;
    if (of_six == faces && size != SizeThen::cut)
    {
        sphere = make_surface(specification, image.width(), image.height(), rotation, message);
    }
    if (!sphere)
    {
        remarks.push_back(name + saved.specification + but_is + "; its shape counts, unless " +
                          asked.option + " says otherwise");
        return false;
    }
    if (size == SizeThen::scaled && !is_placed)
    {
        const bool can_be_part = kind_of(specification) == "equirect";
        remarks.push_back(name + saved.specification + but_is +
                          "; it is taken as scaled; if it is a part, say " + asked.option + " " +
                          (can_be_part ? "'equirect;west=W;east=E;south=S;north=N'" : "SPEC"));
    }
    turned = rotation;
    return true;
}

void SphereFiles::take(const std::string &specification, const std::optional<cm_rotation> &rotation)
{
    const ImageFile &image = images.front();
    std::string message;
    if (is_chart(specification) && image.width() != image.height())
    {
        throw Failure(in_quotes(image.path()) + " is " + size_text(image) + "; an image in " +
                      head_of(specification) + " must be square");
    }
    sphere = make_surface(specification, image.width(), image.height(), rotation, message);
    if (!sphere)
    {
        throw Failure(in_quotes(image.path()) + " is " + size_text(image) + ", no image in " +
                      specification + ": " + message);
    }
    turned = rotation;
}

void SphereFiles::take_as(const cm_surface &surface)
{
    const std::optional<SavedSurface> saved = find_saved();
    if (saved)
    {
        compare_with(*saved, surface, {});
    }
}

void SphereFiles::compare_with(const SavedSurface &saved, const cm_surface &taken,
                               const std::optional<cm_rotation> &rotation)
{
    const std::string here = cm_surface_specification(&taken);
    const std::optional<cm_rotation> none;
    std::string message;
    const SurfacePointer other =
        make_surface(without_size(saved.specification), static_cast<int>(cm_surface_width(&taken)),
                     static_cast<int>(cm_surface_height(&taken)), none, message);
    const std::string there = other ? cm_surface_specification(other.get()) : saved.specification;
    const auto turn_of = [](const std::optional<cm_rotation> &turn)
    { return turn && is_turned(*turn) ? rotation_text(*turn) : "0,0,0"; };
    const std::string name = says(saved);
    if (here != there)
    {
        remarks.push_back(name + there + "; it is taken as " + here + ", as the command line says");
    }
    else if (turn_of(rotation) != turn_of(saved.rotation))
    {
        remarks.push_back(name + "turned by " + turn_of(saved.rotation) +
                          "; it is taken as turned by " + turn_of(rotation) +
                          ", as the command line says");
    }
}

// An equirectangular image, too, where nobody says that it is a cube.
std::string SphereFiles::cube_by_shape() const
{
    const SurfaceOptions &from = asked.from;
    const bool may_be_equirect = from.specification.empty() && from.layout.empty();
    if (!faces && may_be_equirect && has_shape(images.front(), 2, 1))
    {
        return "equirect";
    }
    std::string cube = from.specification.empty() ? "cube" : from.specification;
    if (key_of(cube, "frame").empty())
    {
        const std::string &frame = from.frame.empty() && !texture ? asked.other_frame : from.frame;
        cube += ";frame=" + (!frame.empty() ? frame : texture ? "gl" : "geo");
    }
    return key_of(cube, "layout").empty() ? cube + ";layout=" + layout_by_shape() : cube;
}

std::string SphereFiles::layout_by_shape() const
{
    struct Shape
    {
        const char *layout;
        int columns;
        int rows;
        bool alone; // does nothing else look like this?
    };
    static constexpr Shape shapes[] = {{"strip", 6, 1, true},
                                       {"cross", 4, 3, true},
                                       {"column", 1, 6, false},
                                       {"vcross", 3, 4, false}};
    const ImageFile &image = images.front();
    const std::string wanted = faces ? "faces" : asked.from.layout;
    const bool said = !asked.from.specification.empty();
    for (const Shape &shape : shapes)
    {
        const bool fits = has_shape(image, shape.columns, shape.rows);
        if (wanted.empty() && fits && (said || shape.alone))
        {
            return shape.layout;
        }
        if (head_of(wanted).substr(0, wanted.find(':')) == shape.layout && !fits)
        {
            const auto edges = [](int count)
            { return (count > 1 ? std::to_string(count) : "") + "N"; };
            throw Failure(in_quotes(image.path()) + " is " + size_text(image) + "; a " +
                          shape.layout + " must be " + edges(shape.columns) + " x " +
                          edges(shape.rows));
        }
    }
    if (!wanted.empty())
    {
        return wanted;
    }
    throw Failure(
        in_quotes(image.path()) + " is " + size_text(image) +
        (said ? "; a cube must be a strip, 6N x N, or a cross, 4N x 3N, or six faces, with "
                "%f in the name, or " +
                    asked.option + "-layout says what it is"
              : ", neither 2:1 (equirect), 6:1 (strip) nor 4:3 (cross); say " + asked.option +
                    " equirect if it is that all the same"));
}

bool SphereFiles::is_told() const
{
    return is_said(asked.from) || texture || saved_surface(images.front()) || saved_beside() ||
           is_georeferenced() ||
           (images.size() == 1 && !why_by_gdal(images.front(), asked).empty());
}

bool SphereFiles::is_georeferenced() const
{
    return geographic_place(images.front()).specification.has_value();
}

std::string SphereFiles::description() const
{
    const int channels = images.front().channels();
    return surface_description(*sphere, turned) + ", " + std::to_string(channels) +
           (channels == 1 ? " channel, " : " channels, ") + types;
}
