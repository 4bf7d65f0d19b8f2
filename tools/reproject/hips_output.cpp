// SPDX-License-Identifier: MIT

#include "hips_output.hpp"
#include "file_checksum.hpp"
#include "pixel_mean.hpp"
#include "tile_file.hpp"
#include "tools/cli/image_file.hpp"
#include "tools/cli/number_pattern.hpp"
#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"

#include "modules/image/io/temporary_name.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>

#include <sys/stat.h>
#include <unistd.h>

namespace
{

// Section 4.2.1: tiles of 512 pixels are the usual ones; smaller ones where the sphere has few pixels.
constexpr std::uint32_t usual_width = 512;
constexpr std::uint32_t least_width = 64;
// Sections 4.1 and 4.3.2: viewers begin with order 3, or with its preview of tiles of 64 pixels.
constexpr std::uint32_t usual_order = 3;
constexpr std::uint32_t tile_in_preview = 64;

// Of folders that are not complete; so many of one process are looked for.
constexpr const char *unfinished = ".hips";
constexpr int folders_most = 1000;

std::filesystem::path folder_of(const std::filesystem::path &path)
{
    return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

std::string without_stroke(std::string path)
{
    while (path.size() > 1 && path.back() == '/')
    {
        path.pop_back();
    }
    return path;
}

std::string tag_of(const ImageDescription &description, const std::string &key)
{
    for (const ImageTag &tag : description.tags)
    {
        if (tag.key == key)
        {
            return tag.text;
        }
    }
    return "";
}

// Now, or when SOURCE_DATE_EPOCH says; section 4.4.1: YYYY-mm-ddTHH:MMZ.
std::string release_date()
{
    const char *const said = std::getenv("SOURCE_DATE_EPOCH");
    const std::time_t now = said != nullptr
                                ? static_cast<std::time_t>(std::strtoll(said, nullptr, 10))
                                : std::time(nullptr);
    std::tm parts = {};
    char text[32] = "";
    gmtime_r(&now, &parts);
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%MZ", &parts);
    return text;
}

std::uint32_t log2_of(std::uint32_t number)
{
    std::uint32_t power = 0;
    while (number >> (power + 1) > 0)
    {
        ++power;
    }
    return power;
}

std::uint32_t tile_width(const Options &options, std::uint32_t nside)
{
    if (options.tile_width > 0)
    {
        return static_cast<std::uint32_t>(options.tile_width);
    }
    const std::uint32_t order =
        options.order ? static_cast<std::uint32_t>(*options.order) : usual_order;
    return std::clamp(nside >> order, least_width, usual_width);
}

// Section 4.4.1: an IVOA identifier, whose authority and path the standard asks for.
void check_creator(const std::string &creator)
{
    const std::string begin = "ivo://";
    const std::size_t stroke = creator.find('/', begin.size());
    const auto is_visible = [](unsigned char letter) { return letter > ' ' && letter < 0x7f; };
    const bool good = creator.compare(0, begin.size(), begin) == 0 && stroke != std::string::npos &&
                      stroke > begin.size() && stroke + 1 < creator.size() &&
                      std::all_of(creator.begin(), creator.end(), is_visible);
    if (!creator.empty() && !good)
    {
        throw UsageFailure("--creator-did is " + in_quotes(creator) +
                           ", not an identifier such as ivo://authority/P/name");
    }
}

// The extension of files of such tiles.
std::string tile_extension(const std::string &format)
{
    return format == "jpeg" ? "jpg" : format;
}

} // namespace

bool is_hips_name(const std::string &path)
{
    return path.size() > 1 && path.back() == '/';
}

void take_hips_rules(Options &options)
{
    SurfaceOptions &to = options.to;
    if (!is_hips_name(options.output))
    {
        const char *const only_tiles = options.order                  ? "--order"
                                       : !options.tiles.empty()       ? "--tiles"
                                       : !options.creator_did.empty() ? "--creator-did"
                                                                      : nullptr;
        if (only_tiles != nullptr)
        {
            throw UsageFailure(std::string(only_tiles) +
                               " is for HiPS tiles; for these OUTPUT is a folder, whose "
                               "name ends in /");
        }
        return;
    }
    if (!to.specification.empty() || !to.layout.empty() || !to.frame.empty() || options.mips ||
        options.sidecar || options.overlay.wanted() || options.parts || options.border > 0)
    {
        throw UsageFailure(in_quotes(options.output) +
                           " is a folder of HiPS tiles; leave --to, --for, --layout, --frame, "
                           "--mips, --border, --parts, --sidecar and lines out, or the / at its "
                           "end");
    }
    if (!options.manifest.empty() || is_pipe(options.input) || number_pattern(options.input) ||
        number_pattern(options.output))
    {
        throw UsageFailure("a folder of HiPS tiles is made of one picture in files; leave "
                           "--manifest, pipes and numbers in names out");
    }
    check_creator(options.creator_did);
    if (options.size)
    {
        const int width = *options.size;
        if ((width & (width - 1)) != 0 || width < 8 || width > 4096)
        {
            throw UsageFailure("--size: " + std::to_string(width) +
                               " is no edge of a HiPS tile: a power of two from 8 to 4096");
        }
        options.tile_width = width;
        options.size.reset();
    }
    to.specification = "healpix";
    if (options.order)
    {
        const std::int64_t width = options.tile_width > 0 ? options.tile_width : usual_width;
        const std::int64_t nside = width << *options.order;
        to.specification += ":" + std::to_string(nside);
    }
}

SurfacePointer hips_surface(const Options &options, SurfacePointer wanted)
{
    const std::uint32_t nside = cm_surface_plane_width(wanted.get());
    const std::uint32_t least = tile_width(options, nside) << (options.order ? 0 : usual_order);
    if (!is_hips_name(options.output) || options.order || nside >= least)
    {
        return wanted;
    }
    std::string message;
    SurfacePointer larger =
        make_surface("healpix:" + std::to_string(least), 0, 0, options.to.rotation, message);
    if (!larger)
    {
        throw UsageFailure("OUTPUT, healpix:" + std::to_string(least) + ": " + message);
    }
    return larger;
}

std::string hips_format(const Options &options, const ImageDescription &source)
{
    if (options.tiles == "fits" && source.channels != 1)
    {
        throw UsageFailure("--tiles: a tile in FITS has one channel, and INPUT has " +
                           std::to_string(source.channels) + "; take jpeg or png");
    }
    const bool numbers = source.channels == 1 && source.type != CM_PIXEL_U8;
    return !options.tiles.empty() ? options.tiles : numbers ? "fits" : "png";
}

void plan_hips(ImagePlan &plan)
{
    plan.description.type = plan.format == "fits" ? CM_PIXEL_FLOAT : CM_PIXEL_U8;
    plan.description.stored_type.clear();
}

HipsOutput::HipsOutput(const Options &options, const cm_surface &surface,
                       const ImagePlan &image_plan, const cm_image &kind, int alpha,
                       WorkFolder *kept)
    : name(without_stroke(options.output)), creator_did(options.creator_did), plan(image_plan),
      work(kept), type(kind.type), channels(kind.channels),
      weighing(image_plan.description.alpha_multiplied ? -1 : alpha),
      width(tile_width(options, cm_surface_plane_width(&surface))),
      order(log2_of(cm_surface_plane_width(&surface) / width)),
      preview_order(std::min(order, usual_order)), preview_width(std::min(width, tile_in_preview))
{
    namespace fs = std::filesystem;
    const fs::path path(name);
    std::error_code error;
    if (fs::exists(path, error) && !(fs::is_directory(path, error) && fs::is_empty(path, error)))
    {
        throw Failure(in_quotes(name) + " is there already; remove it, or give another name");
    }
    if (work != nullptr)
    {
        temporary = work->tiles();
    }
    else
    {
        check_folder(path);
    }
    cm_hips_preview(preview_order, &preview_columns, &preview_rows);
    preview.resize(std::size_t{preview_columns} * preview_rows * preview_width * preview_width *
                   channels * cm_pixel_size(type));
}

// Before anything is read: signals act as ever as long as there is nothing to remove.
void HipsOutput::check_folder(const std::filesystem::path &path) const
{
    const std::filesystem::path folder = folder_of(path);
    if (access((folder / ".").c_str(), W_OK | X_OK) != 0)
    {
        throw Failure(in_quotes(name) + " cannot be written: folder " + in_quotes(folder.string()) +
                      ": " + std::strerror(errno));
    }
}

void HipsOutput::make_temporary(const std::filesystem::path &path)
{
    const std::filesystem::path folder = folder_of(path);
    held.emplace();
    remove_left_over_folders(folder.string(), unfinished);
    for (int attempt = 0; descriptor < 0; ++attempt)
    {
        std::string wanted = (folder / own_temporary_name(attempt, unfinished)).string();
        descriptor = make_temporary_folder(wanted);
        if (descriptor >= 0)
        {
            temporary = std::move(wanted);
        }
        else if (errno != EEXIST || attempt == folders_most)
        {
            throw Failure(in_quotes(name) + " cannot be written: folder " +
                          in_quotes(folder.string()) + ": " + std::strerror(errno));
        }
    }
}

HipsOutput::~HipsOutput()
{
    std::error_code error;
    if (!temporary.empty() && work == nullptr)
    {
        std::filesystem::remove_all(temporary, error);
    }
    if (descriptor >= 0)
    {
        close(descriptor);
    }
}

cm_image HipsOutput::picture_of(Pixels &pixels, std::uint32_t columns, std::uint32_t rows) const
{
    cm_image picture = {};
    picture.size = sizeof picture;
    picture.data = pixels.data();
    picture.type = type;
    picture.width = columns;
    picture.height = rows;
    picture.channels = channels;
    picture.pixel_stride = static_cast<std::ptrdiff_t>(channels * cm_pixel_size(type));
    picture.row_stride = picture.pixel_stride * static_cast<std::ptrdiff_t>(columns);
    return picture;
}

// ---- tiles

// A tile that is not of the greatest order is the mean of its four: pixels have equal areas, and each is the sum of four.
HipsOutput::Pixels HipsOutput::make_tile(std::uint32_t level, std::uint64_t number,
                                         const Render &render)
{
    cm_hips_window window = {};
    cm_hips_place(level, number, width, &window);
    Pixels pixels(std::size_t{width} * width * channels * cm_pixel_size(type));
    check_held_signal();
    const bool kept = work != nullptr && level == preview_order;
    if (kept && load_tiles(level, number, pixels))
    {
        return pixels;
    }
    if (level == order)
    {
        render(window, pixels.data());
    }
    for (std::uint64_t child = 4 * number; level < order && child < 4 * number + 4; ++child)
    {
        add_quarter(window, level, child, make_tile(level + 1, child, render), pixels);
    }
    write_tile(level, number, pixels);
    if (kept)
    {
        store_tiles(level, number, pixels);
    }
    return pixels;
}

// ---- tiles that are kept: one of the preview's order with all that it is the mean of

// Of the files of a tile and of those that it is the mean of; 0 if one is not there.
std::uint32_t HipsOutput::sum_of_tiles(std::uint32_t level, std::uint64_t number) const
{
    const std::string path = tile_path(level, number);
    if (!std::filesystem::exists(path))
    {
        return 0;
    }
    std::uint32_t sums[5] = {sum_of_file(path, name).checksum};
    for (std::uint64_t i = 0; level < order && i < 4; ++i)
    {
        sums[i + 1] = sum_of_tiles(level + 1, 4 * number + i);
        if (sums[i + 1] == 0)
        {
            return 0;
        }
    }
    return checksum_of(sums, sizeof sums) | 1u;
}

// The pixels, and behind them the sum of the files.
void HipsOutput::store_tiles(std::uint32_t level, std::uint64_t number, Pixels pixels)
{
    const std::uint32_t sum = sum_of_tiles(level, number);
    const auto *const bytes = reinterpret_cast<const unsigned char *>(&sum);
    pixels.insert(pixels.end(), bytes, bytes + sizeof sum);
    const int row = static_cast<int>(number);
    work->store(0, row, row + 1, pixels.data(), pixels.size());
}

bool HipsOutput::load_tiles(std::uint32_t level, std::uint64_t number, Pixels &pixels)
{
    const int row = static_cast<int>(number);
    Pixels there(pixels.size() + sizeof(std::uint32_t));
    if (!work->load(0, row, row + 1, there.data(), there.size()))
    {
        return false;
    }
    std::uint32_t sum = 0;
    std::memcpy(&sum, there.data() + pixels.size(), sizeof sum);
    if (sum != sum_of_tiles(level, number))
    {
        return false;
    }
    std::copy_n(there.begin(), pixels.size(), pixels.begin());
    preview_tile(number, pixels);
    return true;
}

// ---- files

void HipsOutput::add_quarter(const cm_hips_window &parent, std::uint32_t level, std::uint64_t child,
                             const Pixels &from, Pixels &to) const
{
    cm_hips_window window = {};
    cm_hips_place(level + 1, child, width, &window);
    const std::uint32_t column = (window.column - 2 * parent.column) / 2;
    const std::uint32_t row = (window.row - 2 * parent.row) / 2;
    Pixels copy = from;
    const cm_image picture = picture_of(copy, width, width);
    const std::size_t pixel = channels * cm_pixel_size(type);
    for (std::uint32_t y = 0; y < width / 2; ++y)
    {
        for (std::uint32_t x = 0; x < width / 2; ++x)
        {
            put_mean(picture, 2 * x, 2 * y, 2, weighing,
                     to.data() + (std::size_t{row + y} * width + column + x) * pixel);
        }
    }
}

void HipsOutput::write_tile(std::uint32_t level, std::uint64_t number, Pixels &pixels)
{
    const cm_image window = picture_of(pixels, width, width);
    cm_image tile = {};
    cm_hips_tile(&window, &tile);
    if (level == preview_order)
    {
        preview_tile(number, pixels);
    }
    const std::string file_name = tile_path(level, number);
    if (plan.format != "fits")
    {
        write_picture(file_name, tile);
        return;
    }
    TileFile file(file_name);
    const cm_image_stream stream = file.stream();
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_status status = cm_hips_write_fits(&stream, level, number, &tile, message);
    file.finish(name);
    if (status != CM_OK)
    {
        fail_image(in_quotes(name), status, message);
    }
}

std::string HipsOutput::tile_path(std::uint32_t level, std::uint64_t number) const
{
    char path[CM_HIPS_PATH] = "";
    cm_hips_tile_path(level, number, tile_extension(plan.format).c_str(), path);
    return temporary + "/" + path;
}

// Tiles of the preview are other threads' at other places.
void HipsOutput::preview_tile(std::uint64_t number, Pixels &pixels)
{
    const cm_image window = picture_of(pixels, width, width);
    cm_image tile = {};
    cm_hips_tile(&window, &tile);
    const std::size_t pixel = channels * cm_pixel_size(type);
    const std::uint32_t step = width / preview_width;
    const std::size_t left = number % preview_columns * preview_width;
    const std::size_t top = number / preview_columns * preview_width;
    const std::size_t row = std::size_t{preview_columns} * preview_width;
    for (std::uint32_t y = 0; y < preview_width; ++y)
    {
        for (std::uint32_t x = 0; x < preview_width; ++x)
        {
            put_mean(tile, x * step, y * step, step, weighing,
                     preview.data() + ((top + y) * row + left + x) * pixel);
        }
    }
}

void HipsOutput::write_picture(const std::string &file_name, const cm_image &picture) const
{
    const std::size_t pixel = channels * cm_pixel_size(type);
    Pixels dense(std::size_t{picture.width} * picture.height * pixel);
    for (std::size_t i = 0; i < std::size_t{picture.width} * picture.height; ++i)
    {
        const auto x = static_cast<std::ptrdiff_t>(i % picture.width);
        const auto y = static_cast<std::ptrdiff_t>(i / picture.width);
        std::memcpy(dense.data() + i * pixel,
                    static_cast<const unsigned char *>(picture.data) + y * picture.row_stride +
                        x * picture.pixel_stride,
                    pixel);
    }
    ImageDescription description = plan.description;
    // of what tiles say, only how they are compressed
    const auto is_other = [](const ImageTag &tag)
    { return tag.key != "png:compressionLevel" && tag.key != "jpeg:subsampling"; };
    description.tags.erase(
        std::remove_if(description.tags.begin(), description.tags.end(), is_other),
        description.tags.end());
    const DescriptionView view(description, plan.format, static_cast<int>(picture.width),
                               static_cast<int>(picture.height));
    TileFile file(file_name);
    const cm_image_stream stream = file.stream();
    const cm_image_io &io = image_io();
    cm_image_writer *writer = nullptr;
    char message[CM_IMAGE_MESSAGE] = "";
    cm_status status = io.create(file_name.c_str(), &stream, &view.get(), &writer, message);
    status = status == CM_OK ? io.write(writer, 0, picture.height, type, dense.data(),
                                        static_cast<std::ptrdiff_t>(pixel), 0, message)
                             : status;
    status = status == CM_OK ? io.finish(writer, message) : status;
    io.drop(writer);
    file.finish(name);
    if (status != CM_OK)
    {
        fail_image(in_quotes(name), status, message);
    }
}

// ---- what is beside them

// Of FITS tiles there is none: their previews are pictures of FITS of another shape, which viewers do without.
void HipsOutput::write_preview()
{
    char path[CM_HIPS_PATH] = "";
    if (plan.format == "fits")
    {
        return;
    }
    cm_hips_preview_path(preview_order, tile_extension(plan.format).c_str(), path);
    write_picture(temporary + "/" + path, picture_of(preview, preview_columns * preview_width,
                                                     preview_rows * preview_width));
}

void HipsOutput::write_properties()
{
    const std::string title = std::filesystem::path(name).filename().string();
    std::string identifier = "ivo://UNK.AUTH/P/";
    for (const char letter : title)
    {
        const bool plain = std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
                           std::strchr("-_.", letter) != nullptr;
        identifier += plain ? letter : '_';
    }
    const std::string axes = tag_of(plan.description, "COORDSYS").substr(0, 1);
    const std::string copyright = tag_of(plan.description, "Copyright");
    const std::string date = release_date();
    cm_hips_properties properties = {};
    properties.size = sizeof properties;
    properties.creator_did = creator_did.empty() ? identifier.c_str() : creator_did.c_str();
    properties.title = title.c_str();
    properties.frame = axes == "G" ? "galactic" : axes == "E" ? "ecliptic" : "equatorial";
    properties.tile_format = plan.format.c_str();
    properties.release = date.c_str();
    properties.copyright = copyright.empty() ? nullptr : copyright.c_str();
    properties.builder = "cubemap-reproject";
    properties.order = order;
    properties.tile_width = width;
    std::size_t length = 0;
    cm_hips_write_properties(&properties, 0, nullptr, &length);
    std::string text(length + 1, '\0');
    if (cm_hips_write_properties(&properties, text.size(), text.data(), &length) != CM_OK)
    {
        throw Failure(in_quotes(name) + " cannot be written: its name, or the copyright of INPUT, "
                                        "has control characters");
    }
    TileFile file(temporary + "/properties");
    const cm_image_stream stream = file.stream();
    stream.write(stream.context, text.data(), length);
    file.finish(name);
}

void HipsOutput::write(const Render &render, int threads)
{
    if (work == nullptr)
    {
        make_temporary(name);
    }
    parallel_for(12, threads,
                 [&](int base) { make_tile(0, static_cast<std::uint64_t>(base), render); });
    write_preview();
    write_properties();
    appear();
}

void HipsOutput::appear()
{
    const mode_t mask = umask(0);
    umask(mask);
    if (chmod(temporary.c_str(), 0777 & ~mask) != 0 ||
        std::rename(temporary.c_str(), name.c_str()) != 0)
    {
        throw Failure(in_quotes(name) + " cannot be written: " + std::strerror(errno));
    }
    temporary.clear();
}

std::string HipsOutput::description() const
{
    return "; HiPS tiles of " + std::to_string(width) + "x" + std::to_string(width) +
           " pixels, orders 0 to " + std::to_string(order) + ", " + plan.format;
}
