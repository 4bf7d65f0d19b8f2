// SPDX-License-Identifier: MIT

#include "reproject_output.hpp"
#include "part_rules.hpp"
#include "tools/image/geo_reference.hpp"
#include "healpix_rules.hpp"
#include "output_surface.hpp"
#include "other_files.hpp"
#include "tools/image/sidecar.hpp"
#include "texture_rules.hpp"
#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"
#include "tools/image/face_names.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <new>

namespace
{

bool is_linear_format(const std::string &format)
{
    return format == "openexr" || format == "hdr" || format == "pfm";
}

// Formats whose colours nobody takes for light.
bool is_srgb_format(const std::string &format)
{
    return format == "png" || format == "jpeg" || format == "ppm" || format == "pgm" ||
           format == "pam";
}

// Through a pipe goes what holds the picture best.
std::string format_of(const std::string &name)
{
    std::error_code error;
    if (!is_pipe(name) && std::filesystem::path(name).extension().empty() &&
        std::filesystem::is_directory(name, error))
    {
        throw UsageFailure(in_quotes(name) + " is a folder; give the name of a file in it, as " +
                           in_quotes((std::filesystem::path(name) / "face_%f.png").string()) +
                           ", or of a new folder with / at its end, for HiPS tiles");
    }
    return is_pipe(name) ? "pnm" : reproject_format(name);
}

cm_not_finite engine_not_finite(const Options &options)
{
    const bool nearest = options.filter == CM_FILTER_NEAREST; // every value goes its own way
    switch (options.not_finite.value_or(nearest ? NotFinite::spread : NotFinite::skip))
    {
    case NotFinite::zero:
        return CM_NOT_FINITE_ZERO;
    case NotFinite::skip:
        return CM_NOT_FINITE_SKIP;
    default:
        return CM_NOT_FINITE_SPREAD;
    }
}

std::string not_finite_text(std::int64_t count, cm_not_finite what)
{
    return std::to_string(count) + (count == 1 ? " value that is" : " values that are") +
           " not finite " +
           (what == CM_NOT_FINITE_SKIP   ? "skipped"
            : what == CM_NOT_FINITE_ZERO ? "taken as 0"
                                         : "kept");
}

bool is_whole(cm_pixel_type type)
{
    return type == CM_PIXEL_U8 || type == CM_PIXEL_U16;
}

// Of values that OUTPUT cannot have; "" if it can have all.
std::string cut_text(const ValueCounts &counts, const ImagePlan &plan)
{
    const cm_pixel_type type = held_type(plan.format, plan.description.type);
    const bool whole = is_whole(type);
    const auto text_of = [](std::int64_t count, const char *where, const char *written)
    {
        return count == 0 ? ""
                          : "; " + std::to_string(count) + (count == 1 ? " value " : " values ") +
                                where + " written as " + written;
    };
    if (!whole)
    {
        return plan.format == "hdr" ? text_of(counts.below_zero, "below 0", "0") : "";
    }
    return text_of(counts.below_zero - counts.components_below_zero, "below 0", "0") +
           text_of(counts.above_one - counts.components_above_one, "above 1", "1") +
           text_of(counts.components_beyond_one, "of vectors beyond 1", "1");
}

// Of one file.
[[noreturn]] void refuse_face_mark(const std::string &name, const std::string &specification,
                                   bool is_texture)
{
    throw UsageFailure(
        in_quotes(name) + " has %f for six faces, but " +
        (is_texture ? "a texture holds them in one file; leave %f out"
         : is_cube(specification)
             ? "the layout is " + key_of(specification, "layout")
             : "OUTPUT is one picture, " + head_of(specification) + "; leave %f out"));
}

} // namespace

Output::Output(const Options &options, const Input &input)
    : whole(options, hips_surface(options, output_surface(options, input)),
            texture_format(options.output)),
      surface(&whole.computed()), rotation(options.to.rotation), places(plane_places(*surface))
{
    choose_names(options, input);
    chosen_mapping = options.mapping_reason.empty() ? "" : "; " + options.mapping_reason;
    kept_density = options.keep == Keep::mean   ? ", as many pixels as INPUT"
                   : options.keep == Keep::most ? ", as dense as INPUT where it is densest"
                                                : "";
    const bool tiles = is_hips_name(options.output);
    choose_format(options, input);
    channels = input.description_of_pixels().channels;
    choose_colors(options, input);
    choose_place(options, input);
    if (options.overlay.wanted())
    {
        lines = std::make_unique<SurfaceLines>(options.overlay, *surface, rotation, input);
    }
    choose_values(options, input);
    if (!is_pipe(options.output)) // who reads pictures from pipes may expect the shortest header
    {
        save_surface(plan, whole.surface(), rotation);
    }
    const auto keep_work = [&]
    { work = std::make_unique<WorkFolder>(options.output, work_identity(options, input, kind())); };
    if (options.resume && tiles)
    {
        keep_work(); // where its tiles are
    }
    make_files(options, input);
    if (options.resume && !tiles)
    {
        keep_work();
    }
}

void Output::choose_format(const Options &options, const Input &input)
{
    const ImageDescription &source = input.description_of_pixels();
    const bool tiles = is_hips_name(options.output);
    plan = plan_image(!options.pipe.empty() ? options.pipe
                      : tiles               ? hips_format(options, source)
                                            : format_of(options.output),
                      source, input.files().front().format(), names.front());
    if (is_texture(plan.format))
    {
        plan_texture(plan, names.front());
    }
    if (tiles)
    {
        plan_hips(plan);
    }
    else if (plan.format == "fits")
    {
        plan_healpix(plan, options);
    }
    if (options.parts)
    {
        plan.parts = part_names(whole.surface());
    }
}

void Output::choose_names(const Options &options, const Input &input)
{
    const std::size_t pictures = cm_surface_picture_count(surface);
    if (names_faces(options.output) && (pictures == 1 || whole.is_texture()))
    {
        refuse_face_mark(options.output, cm_surface_specification(surface), whole.is_texture());
    }
    if (pictures > 1 && is_pipe(options.output))
    {
        throw UsageFailure("OUTPUT is a pipe, which takes one picture, and the faces of a cube are "
                           "six; say --layout 3x2, strip or cross, or --to equirect");
    }
    const bool faces = pictures > 1 && !whole.is_texture() && !options.parts;
    names = whole.file_names(faces ? face_names(options.output)
                                   : std::vector<std::string>{options.output});
    for (const std::string &name : names)
    {
        for (const ImageFile &image : input.files())
        {
            if (same_file(name, image.path()))
            {
                throw UsageFailure("OUTPUT " + in_quotes(name) +
                                   " is the same file as INPUT; give it another name");
            }
        }
    }
}

// What was placed on Earth still is.
void Output::choose_place(const Options &options, const Input &input)
{
    const bool can = plan.format == "tiff" && has_geographic_place(*surface, rotation);
    if (options.georeference && !can)
    {
        throw UsageFailure("--georeference is for TIFF files of equirect or mercator that are not "
                           "turned; OUTPUT is " +
                           surface_text());
    }
    georeferenced = can && (options.georeference || input.is_georeferenced());
}

// Light is written as sRGB where a format has that, and the other way round.
void Output::choose_colors(const Options &options, const Input &input)
{
    const ImageDescription &source = input.description_of_pixels();
    const bool numbers = input.files().front().stored().whole_numbers;
    const bool linear = source.color == CM_IMAGE_COLOR_LINEAR;
    const bool srgb =
        source.color == CM_IMAGE_COLOR_SRGB || (source.color == CM_IMAGE_COLOR_UNKNOWN && numbers);
    colors.channels = channels;
    colors.alpha = source.alpha;
    colors.multiplied = source.alpha >= 0 && source.alpha_multiplied;
    colors.multiply = colors.multiplied || plan.multiply_alpha;
    if (options.stored || options.vector > 0 || options.transfer == CM_TRANSFER_GAMMA)
    {
        return;
    }
    if (linear && is_srgb_format(plan.format))
    {
        colors.recode = Recode::encode;
        plan.description.color = CM_IMAGE_COLOR_SRGB;
        if (colors.multiplied && plan.format == "png")
        {
            colors.multiply = false;
            plan.description.alpha_multiplied = false;
        }
    }
    // of textures only bytes may have sRGB's curve
    const bool light = is_linear_format(plan.format) ||
                       (is_texture(plan.format) && plan.description.type != CM_PIXEL_U8);
    if (srgb && is_texture(plan.format))
    {
        plan.description.color = CM_IMAGE_COLOR_SRGB;
    }
    if (srgb && light)
    {
        colors.recode = Recode::decode;
        plan.description.color = CM_IMAGE_COLOR_LINEAR;
    }
}

// What the engine does to whole numbers it does where they are what it stores.
void Output::check_whole_numbers(const Options &options) const
{
    const bool computes_floats = lines || colors.is_needed();
    const bool is_floats = !is_whole(held_type(plan.format, plan.description.type));
    if (options.dither && is_floats)
    {
        throw UsageFailure("--dither is for whole numbers, and OUTPUT, " +
                           in_quotes(options.output) + ", holds floats; leave it out");
    }
    if (options.dither && computes_floats)
    {
        throw UsageFailure(lines ? "--dither is not for pictures with lines; leave one out"
                                 : "--dither is not for colours that change between light and "
                                   "sRGB, or with alpha; say --stored, or leave it out");
    }
    if (options.vector > 0 && !is_floats && computes_floats)
    {
        throw UsageFailure(lines ? "--vector is not for pictures of whole numbers with lines; "
                                   "leave one out, or let OUTPUT be floats in TIFF or EXR"
                                 : "--vector is not for whole numbers whose alpha changes; let "
                                   "OUTPUT be floats in TIFF or EXR");
    }
}

void Output::choose_values(const Options &options, const Input &input)
{
    const ImageDescription &source = input.description_of_pixels();
    const bool linear = source.color == CM_IMAGE_COLOR_LINEAR;
    values.size = sizeof values;
    values.filter = options.filter;
    values.tolerance = !options.tolerance ? 0 : *options.tolerance > 0 ? *options.tolerance : -1;
    values.transfer =
        linear && options.transfer == CM_TRANSFER_SRGB ? CM_TRANSFER_STORED : options.transfer;
    values.gamma = options.gamma;
    // so many channels are no picture with opacity
    values.alpha = channels > CM_CHANNELS_MAX ? 0 : static_cast<std::uint32_t>(source.alpha + 1);
    values.alpha_multiplied = source.alpha_multiplied ? 1 : 0;
    values.vector = static_cast<std::uint32_t>(options.vector);
    values.dither = options.dither ? 1 : 0;
    if (options.vector > 0 && options.vector + 2 > channels)
    {
        throw UsageFailure("--vector: a vector that begins in channel " +
                           std::to_string(options.vector) + " ends in channel " +
                           std::to_string(options.vector + 2) + ", but INPUT has " +
                           std::to_string(channels));
    }
    const int alpha = source.alpha + 1;
    if (options.vector > 0 && alpha >= options.vector && alpha <= options.vector + 2)
    {
        throw UsageFailure("--vector: channel " + std::to_string(alpha) + " is alpha");
    }
    if (channels > CM_CHANNELS_MAX && options.vector > 0)
    {
        throw Failure("--vector: INPUT has " + std::to_string(channels) + " channels, of which " +
                      std::to_string(CM_CHANNELS_MAX) + " at most can be resampled with a vector");
    }
    const bool floats = lines || colors.is_needed();
    row_type = floats ? CM_PIXEL_FLOAT : held_type(plan.format, plan.description.type);
    check_whole_numbers(options);
}

void Output::make_files(const Options &options, const Input &input)
{
    if (!options.compression.empty())
    {
        set_compression(plan, options.compression);
    }
    if (is_hips_name(options.output))
    {
        cm_image kind = {};
        kind.type = row_type;
        kind.channels = static_cast<std::uint32_t>(channels);
        hips =
            std::make_unique<HipsOutput>(options, *surface, plan, kind, colors.alpha, work.get());
        return;
    }
    for (const std::string &name : names)
    {
        files.push_back(is_pipe(name)
                            ? std::make_unique<AtomicFile>("standard output", options.output_stream)
                            : std::make_unique<AtomicFile>(name));
    }
    check_other_files(options, input, names);
    if (options.sidecar)
    {
        files.push_back(std::make_unique<AtomicFile>(sidecar_name(options.output)));
    }
    if (!options.manifest.empty())
    {
        files.push_back(std::make_unique<AtomicFile>(options.manifest));
    }
}

// ---- pixels

// What the written values are, which may have changed behind resampling.
cm_plan_options Output::written_values() const
{
    cm_plan_options written = values;
    const bool srgb = plan.description.color == CM_IMAGE_COLOR_SRGB &&
                      (is_texture(plan.format) || colors.recode == Recode::encode);
    written.transfer = srgb                              ? CM_TRANSFER_SRGB
                       : colors.recode == Recode::decode ? CM_TRANSFER_STORED
                                                         : values.transfer;
    written.alpha_multiplied = colors.multiply ? 1 : 0;
    return written;
}

// Tile by tile.
void Output::write_hips(const Render &render, int threads)
{
    const auto fill = [&](const cm_hips_window &window, unsigned char *pixels)
    {
        const std::size_t pixel = static_cast<std::size_t>(channels) * channel_bytes(row_type);
        const std::size_t row = pixel * window.width;
        // the window of a picture that as a whole is not there
        cm_image picture = {};
        picture.size = sizeof picture;
        picture.data = reinterpret_cast<void *>(
            reinterpret_cast<std::uintptr_t>(pixels) - window.row * row -
            (std::size_t{window.plane} * window.planes + window.column) * pixel);
        picture.type = row_type;
        picture.width = cm_surface_width(surface);
        picture.height = cm_surface_height(surface);
        picture.channels = static_cast<std::uint32_t>(channels);
        picture.row_stride = static_cast<std::ptrdiff_t>(row);
        const cm_rows rows = {window.plane, window.row, window.width, window.column, window.width};
        render.source.resample(render.plan, {picture}, rows, 1);
        if (colors.is_needed())
        {
            colors.convert(reinterpret_cast<float *>(pixels),
                           std::size_t{window.width} * window.width);
        }
        render.progress.advance(window.width * window.width / cm_surface_width(surface));
    };
    hips->write(fill, threads);
}

// The pictures are all in memory.
void Output::write_whole(const Render &render, int threads)
{
    const int height = static_cast<int>(cm_surface_height(surface));
    std::vector<PixelMemory> held;
    std::vector<cm_image> pictures;
    for (std::size_t i = 0; i < cm_surface_picture_count(surface); ++i)
    {
        held.emplace_back(render.ceiling, row_bytes() * static_cast<std::size_t>(height), "OUTPUT");
        int first = 0;
        for (const int end : work ? bands_of(render, i, threads) : std::vector<int>{height})
        {
            unsigned char *const at =
                held[i].bytes() + row_bytes() * static_cast<std::size_t>(first);
            fill_rows(render, i, {first, end, at}, threads);
            render.progress.advance(end - first);
            first = end;
        }
        cm_image picture = {};
        picture.size = sizeof picture;
        picture.data = held[i].bytes();
        picture.type = row_type;
        picture.width = cm_surface_width(surface);
        picture.height = cm_surface_height(surface);
        picture.channels = static_cast<std::uint32_t>(channels);
        pictures.push_back(picture);
    }
    try
    {
        whole.write(pictures, plan, rotation, written_values(), files, names, georeferenced,
                    threads, render.ceiling);
    }
    catch (const std::bad_alloc &)
    {
        render.ceiling.rethrow();
        throw;
    }
}

void Output::write_pictures(const Render &render, int threads)
{
    if (whole.is_needed())
    {
        write_whole(render, threads);
        return;
    }
    if (!plan.parts.empty())
    {
        write_parts(render, threads);
        return;
    }
    parallel_for(static_cast<int>(names.size()), threads,
                 [&](int i) { write_picture(render, static_cast<std::size_t>(i), threads); });
}

void Output::write(const Options &options, const Input &input, int threads, MemoryCeiling &ceiling,
                   std::FILE *terminal, KeptPlan &kept)
{
    not_finite = input.values().not_finite;
    cut = cut_text(input.values(), plan);
    values.not_finite = not_finite > 0 ? engine_not_finite(options) : CM_NOT_FINITE_SPREAD;
    values.memory = ceiling.functions();
    const cm_plan &geometry =
        kept.get(input.surface(), input.rotation(), *surface, rotation, values);
    const ChannelGroups source(geometry, input.pictures(),
                               cm_surface_picture_count(&input.surface()), row_type, threads,
                               ceiling);
    filter = source.filter();
    const std::int64_t rows = std::int64_t{cm_surface_height(surface)} *
                              static_cast<std::int64_t>(cm_surface_picture_count(surface));
    {
        Progress progress(rows, !options.quiet, terminal);
        const Render render = {ceiling, geometry, source, progress};
        if (hips)
        {
            write_hips(render, threads);
            leave_work(options);
            return;
        }
        if (holds_pictures(render, input))
        {
            compute_all(render, threads);
        }
        write_pictures(render, threads);
        whole_pictures.clear();
    }
    if (options.sidecar)
    {
        write_sidecar();
    }
    if (!options.manifest.empty())
    {
        write_manifest(options, input);
    }
    appear_together(files);
    leave_work(options);
}

// What was kept is needed no longer.
void Output::leave_work(const Options &options)
{
    if (work)
    {
        work->remove();
    }
    else
    {
        WorkFolder::forget(options.output);
    }
}

// ---- what it was

void Output::write_sidecar()
{
    const std::string text = sidecar_text(whole.surface(), rotation, names, cm_filter_name(filter));
    files[names.size()]->write(text.data(), text.size());
}

PictureKind Output::kind() const
{
    static constexpr const char *types[] = {"uint8", "uint16", "half", "float"};
    const cm_surface &shown = whole.surface();
    return {cm_surface_specification(&shown),
            rotation && is_turned(*rotation) ? rotation_text(*rotation) : "0,0,0",
            static_cast<int>(cm_surface_width(&shown)),
            static_cast<int>(cm_surface_height(&shown)),
            channels,
            types[row_type]};
}

void Output::write_manifest(const Options &options, const Input &input)
{
    std::vector<MadePicture> pictures;
    for (std::size_t i = 0; i < names.size(); ++i)
    {
        pictures.push_back({names[i], sum_of_file(files[i]->temporary_name(), names[i])});
    }
    const std::string text =
        manifest_text(options, input, kind(), cm_filter_name(filter), pictures);
    files.back()->write(text.data(), text.size());
}

std::string Output::surface_text() const
{
    return surface_description(whole.surface(), rotation) +
           (plan.alpha_dropped ? ", without alpha" : "") + kept_density;
}

std::string Output::description() const
{
    std::string text = name_list(names) + " (" + surface_text() + "; " + cm_filter_name(filter) +
                       (hips ? hips->description() : whole.description());
    text += plan.parts.empty() ? "" : "; " + std::to_string(plan.parts.size()) + " parts";
    text += colors.recode == Recode::encode   ? "; light written as sRGB"
            : colors.recode == Recode::decode ? "; sRGB written as light"
                                              : "";
    text += not_finite > 0 ? "; " + not_finite_text(not_finite, values.not_finite) : "";
    text += cut + chosen_mapping;
    return text + (lines ? "; " + lines->description() : "") + ")";
}
