// SPDX-License-Identifier: MIT

#include "distortion_options.hpp"
#include "colors.hpp"
#include "distortion_main.h"
#include "distortion_table.h"
#include "tools/cli/catalogue_name.h"
#include "tools/cli/program.hpp"

#include <cubemap/catalogue.h>

namespace
{

std::string read_mapping(const OptionReader &reader)
{
    const std::string text = reader.text();
    char message[400];
    if (cm_specification_check(text.c_str(), message, sizeof message) != CM_OK)
    {
        throw UsageFailure(reader.name() + ": " + in_quotes(text) + ": " + message +
                           suggestion(nearest_mapping(text.c_str())));
    }
    return text;
}

std::string read_colors(const OptionReader &reader)
{
    check_colors(reader.name(), reader.text());
    return reader.text();
}

ValueRange read_range(OptionReader &reader)
{
    const std::string text = reader.text();
    const std::size_t colon = text.find(':');
    const std::optional<double> low = read_number(text.substr(0, colon));
    const std::optional<double> high =
        colon == std::string::npos ? std::nullopt : read_number(text.substr(colon + 1));
    if (!low || !high || *low < 0 || !(*low < *high))
    {
        reader.refuse("LOW:HIGH, two numbers of 0 or more with LOW below HIGH, such as 0.5:2");
    }
    return {*low, *high};
}

void read_option(int id, OptionReader &reader, DistortionOptions &options)
{
    switch (id)
    {
    case DISTORTION_MAPPING:
        options.mapping = read_mapping(reader);
        break;
    case DISTORTION_FRAME:
        options.frame = cm_frame_at(reader.choice());
        break;
    case DISTORTION_QUANTITY:
        options.quantity = &quantities()[reader.choice()];
        break;
    case DISTORTION_LAYOUT:
        options.layout = static_cast<CubeLayout>(reader.choice());
        break;
    case DISTORTION_FACE:
        options.face = reader.whole_number();
        break;
    case DISTORTION_SIZE:
        options.size = reader.whole_number();
        break;
    case DISTORTION_COLORS:
        options.colors = read_colors(reader);
        break;
    case DISTORTION_REVERSE:
        options.reverse = true;
        break;
    case DISTORTION_RANGE:
        options.range = read_range(reader);
        break;
    case DISTORTION_ISOLINES:
        options.isolines = reader.number();
        break;
    case DISTORTION_VALUES:
        options.values = true;
        break;
    case DISTORTION_LEGEND:
        options.legend = reader.text();
        break;
    case DISTORTION_THREADS:
        options.threads = reader.whole_number();
        break;
    case DISTORTION_QUIET:
        options.quiet = true;
        break;
    default:
        read_overlay_option(id, reader, options.overlay);
        break;
    }
}

// What has an effect only together with something else, or not together with it.
void check_combinations(const DistortionOptions &options)
{
    check_overlay_options(options.overlay, options.isolines.has_value());
    if (options.face && options.layout)
    {
        throw UsageFailure("--face is for a picture of one face, but --layout is for all six");
    }
    if (options.values && (options.overlay.wanted() || options.isolines || options.legend ||
                           options.range || options.reverse || !options.colors.empty()))
    {
        throw UsageFailure("--values writes numbers; colours, --range, --legend and lines are for "
                           "pictures without it");
    }
    if (options.range && options.quantity->middle > 0 && !(options.range->low > 0))
    {
        throw UsageFailure(std::string("--range: LOW must be above 0, for the scale of ") +
                           options.quantity->name + " is logarithmic");
    }
}

// What belongs to the six faces of a cube, before the defaults are set.
void check_faces(DistortionOptions &options)
{
    if (options.mapping.empty())
    {
        return;
    }
    const MappingPointer mapping = make_mapping(options.mapping, *cm_frame_find("geo"));
    options.one_face = face_count(*mapping) == 1;
    if (cm_mapping_describe(mapping.get())->kind == CM_KIND_DISC_SQUARE)
    {
        throw UsageFailure("--mapping: " + in_quotes(options.mapping) +
                           " joins disc and square, not the sphere");
    }
    if (options.one_face && (options.layout || options.face.value_or(0) > 0 || options.frame))
    {
        throw UsageFailure(std::string(options.layout  ? "--layout"
                                       : options.frame ? "--frame"
                                                       : "--face") +
                           " is for the six faces of a cube, but " + options.mapping + " has one");
    }
}

void set_defaults(DistortionOptions &options)
{
    options.mapping = options.mapping.empty() ? CM_MAPPING_RECOMMENDED : options.mapping;
    options.frame = options.frame == nullptr ? cm_frame_find("geo") : options.frame;
    options.quantity = options.quantity == nullptr ? &quantities().front() : options.quantity;
}

} // namespace

DistortionOptions parse_distortion_options(int argc, char **argv, const cm_streams &streams)
{
    DistortionOptions options;
    OptionReader reader(cm_distortion_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        read_option(id, reader, options);
    }
    options.printed = reader.printed();
    if (!options.printed)
    {
        check_faces(options);
    }
    set_defaults(options);
    if (options.printed)
    {
        return options;
    }
    const std::vector<std::string> operands = reader.operands();
    if (operands.size() != 1)
    {
        throw UsageFailure("OUTPUT is needed, " + std::to_string(operands.size()) +
                           " names are given; see --help");
    }
    check_combinations(options);
    options.colors = options.colors.empty() ? options.quantity->colors : options.colors;
    options.output = operands[0];
    return options;
}
