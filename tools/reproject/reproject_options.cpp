// SPDX-License-Identifier: MIT

#include "reproject_options.hpp"
#include "reproject_main.h"
#include "reproject_table.h"
#include "tools/image/sidecar.hpp"
#include "tools/image/surface_text.hpp"
#include "tools/cli/byte_size.hpp"
#include "tools/cli/catalogue_name.h"
#include "tools/cli/program.hpp"

#include <cubemap/catalogue.h>

#include <cstring>
#include <filesystem>

namespace
{

// A kind, or a mapping of one face, or one of the cube.
std::string nearest_kind(const std::string &text)
{
    cm_nearest nearest = nearest_mapping(text.c_str());
    cm_nearest kind = cm_nearest_to(text.c_str(), text.find_first_of(":;") == std::string::npos
                                                      ? text.size()
                                                      : text.find_first_of(":;"));
    for (std::size_t i = 0; i < cm_surface_kind_count(); ++i)
    {
        const char *const name = cm_surface_kind_at(i)->identifier;
        cm_nearest_try(&kind, name, std::strlen(name));
    }
    const bool closer =
        kind.best != nullptr && (nearest.best == nullptr || kind.distance < nearest.distance);
    return suggestion(closer ? kind : nearest);
}

// Nothing is wrong with the option if the environment asks for an instruction set that is not there.
void check_instructions(cm_status status, const char *message)
{
    if (status == CM_ERROR_INSTRUCTIONS)
    {
        throw Failure(message);
    }
}

// What a file that --sidecar has written says of the pictures beside it.
void take_sidecar(const std::string &path, SurfaceOptions &from)
{
    const SavedSurface saved = read_sidecar(path);
    from.specification = without_size(saved.specification);
    from.said_rotation = saved.rotation;
}

// The order of HEALPix's pixels, which only files have, goes into order.
std::string read_specification(const OptionReader &reader, std::string &order)
{
    std::string text = reader.text();
    order = take_healpix_order(text);
    char message[400];
    const cm_status status = cm_surface_check(text.c_str(), nullptr, message, sizeof message);
    if (status == CM_OK)
    {
        return text;
    }
    check_instructions(status, message);
    const std::string name = text.substr(0, text.find_first_of(":;"));
    const bool unknown = status == CM_ERROR_MAPPING && !is_cube(text) &&
                         cm_catalogue_find(name.c_str()) == nullptr && name != "azimuthal";
    const std::string mapping = is_cube(text) && text.size() > 5 ? text.substr(5) : text;
    throw UsageFailure(reader.name() + ": " + in_quotes(text) +
                       (unknown ? " is not equirect, cube or cube:MAPPING, nor another kind of "
                                  "image, nor a mapping of one face: "
                                : ": ") +
                       message + (status == CM_ERROR_MAPPING ? nearest_kind(mapping) : ""));
}

std::string read_layout_name(OptionReader &reader)
{
    const std::string text = reader.text();
    const std::string cube = "cube;layout=" + text;
    const bool one_word = text.find(';') == std::string::npos;
    char message[400] = "";
    const cm_status status = cm_surface_check(cube.c_str(), nullptr, message, sizeof message);
    check_instructions(status, message);
    if (one_word && status == CM_OK)
    {
        return text;
    }
    cm_nearest nearest = cm_nearest_to(text.c_str(), text.size());
    for (const char *const *name = cm_reproject_layouts; *name != nullptr; ++name)
    {
        cm_nearest_try(&nearest, *name, std::strlen(*name));
    }
    reader.refuse("faces, strip or cross, cross:north=N,south=N with columns from 0 to 3, vcross, "
                  "column, 3x2, 2x3, eac or eac:pad=N" +
                  suggestion(nearest));
}

cm_rotation read_rotation(const OptionReader &reader)
{
    const std::string text = reader.text();
    char message[400];
    cm_rotation rotation;
    if (cm_rotation_parse(text.c_str(), &rotation, message, sizeof message) != CM_OK)
    {
        throw UsageFailure(reader.name() + ": " + message +
                           suggestion(nearest_name(text.c_str(), orientation_name_at)));
    }
    return rotation;
}

void set_transfer(const OptionReader &reader, cm_transfer transfer, Options &options)
{
    if (options.transfer != CM_TRANSFER_STORED && options.transfer != transfer)
    {
        throw UsageFailure(reader.name() + ": --linear and --gamma are two ways to say how colours "
                                           "are stored; leave one out");
    }
    options.transfer = transfer;
}

// Bytes, from a number with a unit or without one.
std::uint64_t read_size(OptionReader &reader)
{
    const std::optional<std::uint64_t> bytes = read_byte_size(reader.text());
    if (!bytes || *bytes < std::uint64_t{64} * 1024 * 1024)
    {
        reader.refuse("a size of 64M at least, such as 512M or 2G");
    }
    return *bytes;
}

// What the pixels are and how they are mixed.
bool read_value_option(int id, const OptionReader &reader, Options &options)
{
    switch (id)
    {
    case REPROJECT_FILTER:
        options.filter = static_cast<cm_filter>(reader.choice());
        return true;
    case REPROJECT_LINEAR:
        set_transfer(reader, CM_TRANSFER_SRGB, options);
        return true;
    case REPROJECT_GAMMA:
        set_transfer(reader, CM_TRANSFER_GAMMA, options);
        options.gamma = reader.number();
        return true;
    case REPROJECT_STORED:
        options.stored = true;
        return true;
    case REPROJECT_VECTOR:
        options.vector = reader.whole_number();
        return true;
    case REPROJECT_NOT_FINITE:
        options.not_finite = static_cast<NotFinite>(reader.choice());
        return true;
    case REPROJECT_DITHER:
        options.dither = true;
        return true;
    case REPROJECT_TOLERANCE:
        options.tolerance = reader.number();
        return true;
    default:
        return false;
    }
}

bool read_surface_option(int id, OptionReader &reader, Options &options)
{
    std::string order;
    switch (id)
    {
    case REPROJECT_FROM:
        options.from.said_rotation.reset();
        options.from_file.clear();
        if (std::filesystem::path(reader.text()).extension() == ".json")
        {
            options.from_file = reader.text();
            take_sidecar(options.from_file, options.from);
            return true;
        }
        options.from.specification = read_specification(reader, order);
        if (!order.empty())
        {
            throw UsageFailure("--from: a .fits file says its order itself; leave :" + order +
                               " out");
        }
        return true;
    case REPROJECT_TO:
        options.to.specification = read_specification(reader, options.healpix_order);
        return true;
    case REPROJECT_FOR:
        options.preset = cm_surface_preset_at(reader.choice());
        return true;
    case REPROJECT_MAPPING:
        options.mapping = reader.text();
        return true;
    case REPROJECT_LAYOUT:
        options.to.layout = read_layout_name(reader);
        return true;
    case REPROJECT_FROM_LAYOUT:
        options.from.layout = read_layout_name(reader);
        return true;
    case REPROJECT_FRAME:
        options.to.frame = reader.text();
        return true;
    case REPROJECT_FROM_FRAME:
        options.from.frame = reader.text();
        return true;
    case REPROJECT_ROTATE:
        options.to.rotation = read_rotation(reader);
        return true;
    case REPROJECT_FROM_ROTATE:
        options.from.rotation = read_rotation(reader);
        return true;
    default:
        return false;
    }
}

void read_option(int id, OptionReader &reader, Options &options)
{
    switch (id)
    {
    case REPROJECT_GEOREFERENCE:
        options.georeference = true;
        break;
    case REPROJECT_START:
        options.start = reader.whole_number();
        break;
    case REPROJECT_COUNT:
        options.count = reader.whole_number();
        break;
    case REPROJECT_RAW:
        options.raw = read_bare_pictures(reader.text());
        if (!options.raw)
        {
            reader.refuse("WIDTHxHEIGHT:FORMAT, as in 1920x960:rgb24, where FORMAT is one of: " +
                          stream_format_names(true));
        }
        break;
    case REPROJECT_PIPE:
        options.pipe = reader.text();
        break;
    case REPROJECT_SIZE:
        options.size = reader.whole_number();
        break;
    case REPROJECT_KEEP:
        options.keep = reader.choice() == 0 ? Keep::mean : Keep::most;
        break;
    case REPROJECT_COMPRESSION:
        options.compression = reader.text();
        break;
    case REPROJECT_SIDECAR:
        options.sidecar = true;
        break;
    case REPROJECT_MIPS:
        options.mips = true;
        break;
    case REPROJECT_PARTS:
        options.parts = true;
        break;
    case REPROJECT_ORDER:
        options.order = reader.whole_number();
        break;
    case REPROJECT_TILES:
        options.tiles = reader.text();
        break;
    case REPROJECT_CREATOR_DID:
        options.creator_did = reader.text();
        break;
    case REPROJECT_BORDER:
        options.border = reader.whole_number();
        break;
    case REPROJECT_THREADS:
        options.threads = reader.whole_number();
        break;
    case REPROJECT_MEMORY:
        options.memory = read_size(reader);
        break;
    case REPROJECT_RESUME:
        options.resume = true;
        break;
    case REPROJECT_MANIFEST:
        options.manifest = reader.text();
        break;
    case REPROJECT_QUIET:
        options.quiet = true;
        break;
    default:
        if (!read_surface_option(id, reader, options) && !read_value_option(id, reader, options))
        {
            read_overlay_option(id, reader, options.overlay);
        }
        break;
    }
}

// A key of the specification and the option for it.
void check_key(const std::string &option, const std::string &specification, const std::string &key,
               const std::string &value)
{
    if (!value.empty() && !key_of(specification, key).empty())
    {
        throw UsageFailure(option + " is " + in_quotes(value) + ", but " +
                           in_quotes(specification) + " has " + key + "=" +
                           key_of(specification, key) + "; leave one out");
    }
}

// What the program wants, where --rotate says what is ahead.
void take_preset(Options &options)
{
    const cm_surface_preset &preset = *options.preset;
    SurfaceOptions &to = options.to;
    if (!to.specification.empty() || !to.frame.empty() || !to.layout.empty())
    {
        throw UsageFailure(
            "--for " + std::string(preset.identifier) +
            " says what OUTPUT is, as --to, --frame and --layout do; leave those out");
    }
    to.specification = preset.specification;
    to.rotation = to.rotation ? product(preset.rotation, *to.rotation) : preset.rotation;
}

void check_together(const Options &options)
{
    check_key("--frame", options.to.specification, "frame", options.to.frame);
    check_key("--layout", options.to.specification, "layout", options.to.layout);
    check_key("--from-frame", options.from.specification, "frame", options.from.frame);
    check_key("--from-layout", options.from.specification, "layout", options.from.layout);
    if (!options.from.layout.empty() && !options.from.specification.empty() &&
        !is_cube(options.from.specification))
    {
        throw UsageFailure("--from-layout is for a cube, but --from says " +
                           options.from.specification);
    }
    if (options.size && options.keep != Keep::equator)
    {
        throw UsageFailure("--keep chooses a size, and --size says one; leave one out");
    }
}

void check_pipes(const Options &options)
{
    if (options.raw && !is_pipe(options.input))
    {
        throw UsageFailure("--raw says what comes through a pipe, but INPUT is " +
                           in_quotes(options.input) + ", not -");
    }
    if (!options.pipe.empty() && !is_pipe(options.output))
    {
        throw UsageFailure("--pipe says what goes into a pipe, but OUTPUT is " +
                           in_quotes(options.output) + ", not -");
    }
    if (is_pipe(options.output) && options.sidecar)
    {
        throw UsageFailure("--sidecar writes a file beside OUTPUT, which is a pipe; leave one out");
    }
}

} // namespace

Options parse_options(int argc, char **argv, const cm_streams &streams)
{
    Options options;
    OptionReader reader(cm_reproject_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        read_option(id, reader, options);
        const bool same_output = id == REPROJECT_THREADS || id == REPROJECT_MEMORY ||
                                 id == REPROJECT_RESUME || id == REPROJECT_MANIFEST ||
                                 id == REPROJECT_QUIET;
        if (!same_output)
        {
            options.words.push_back(reader.as_written());
        }
    }
    options.printed = reader.printed();
    if (options.printed)
    {
        return options;
    }
    const std::vector<std::string> operands = reader.operands();
    if (operands.size() != 2)
    {
        throw UsageFailure("INPUT and OUTPUT are needed, " + std::to_string(operands.size()) +
                           (operands.size() == 1 ? " name is" : " names are") +
                           " given; see --help");
    }
    if (!options.from.rotation)
    {
        options.from.rotation = options.from.said_rotation;
    }
    check_overlay_options(options.overlay, false);
    check_together(options);
    if (options.preset != nullptr)
    {
        take_preset(options);
    }
    options.input = operands[0];
    options.output = operands[1];
    options.output_stream = streams.out;
    check_pipes(options);
    options.words.insert(options.words.end(), operands.begin(), operands.end());
    return options;
}
