// SPDX-License-Identifier: MIT

#include "distortion_options.hpp"
#include "colors.hpp"
#include "tools/cli/program.hpp"

#include <map>

#include <cubemap/catalogue.h>

namespace
{

std::string read_mapping(ArgumentReader &reader)
{
    const std::string option = reader.text();
    const std::string text = reader.value();
    char message[400];
    if (cm_specification_check(text.c_str(), message, sizeof message) != CM_OK)
    {
        throw UsageFailure(option + ": " + in_quotes(text) + ": " + message);
    }
    return text;
}

const Quantity *read_quantity(ArgumentReader &reader)
{
    std::vector<std::string> names;
    for (const Quantity &quantity : quantities())
    {
        names.emplace_back(quantity.name);
    }
    return &quantities()[reader.word(names)];
}

std::string read_colors(ArgumentReader &reader)
{
    const std::string option = reader.text();
    const std::string text = reader.value();
    check_colors(option, text);
    return text;
}

ValueRange read_range(ArgumentReader &reader)
{
    const std::string option = reader.text();
    const std::string text = reader.value();
    const std::size_t colon = text.find(':');
    const std::optional<double> low = read_number(text.substr(0, colon));
    const std::optional<double> high =
        colon == std::string::npos ? std::nullopt : read_number(text.substr(colon + 1));
    if (!low || !high || *low < 0 || !(*low < *high))
    {
        throw UsageFailure(
            option + ": " + in_quotes(text) +
            " is not LOW:HIGH, two numbers of 0 or more with LOW below HIGH, such as "
            "0.5:2");
    }
    return {*low, *high};
}

double read_step(ArgumentReader &reader)
{
    const std::string option = reader.text();
    const double step = reader.not_negative_number();
    if (!(step >= 1e-6))
    {
        throw UsageFailure(option + ": the step must be 1e-6 or more");
    }
    return step;
}

using OptionAction = void (*)(ArgumentReader &, DistortionOptions &);

const std::map<std::string, OptionAction> &option_actions()
{
    static const std::map<std::string, OptionAction> actions = {
        {"-m", [](ArgumentReader &reader, DistortionOptions &options)
         { options.mapping = read_mapping(reader); }},
        {"--mapping", [](ArgumentReader &reader, DistortionOptions &options)
         { options.mapping = read_mapping(reader); }},
        {"--frame", [](ArgumentReader &reader, DistortionOptions &options)
         { options.frame = read_frame(reader); }},
        {"--quantity", [](ArgumentReader &reader, DistortionOptions &options)
         { options.quantity = read_quantity(reader); }},
        {"--layout", [](ArgumentReader &reader, DistortionOptions &options)
         { options.layout = read_layout(reader); }},
        {"--face", [](ArgumentReader &reader, DistortionOptions &options)
         { options.face = static_cast<int>(reader.whole_number(0, 5)); }},
        {"--size", [](ArgumentReader &reader, DistortionOptions &options)
         { options.size = static_cast<int>(reader.whole_number(1, largest_distortion_face)); }},
        {"--colors", [](ArgumentReader &reader, DistortionOptions &options)
         { options.colors = read_colors(reader); }},
        {"--reverse", [](ArgumentReader &, DistortionOptions &options) { options.reverse = true; }},
        {"--range", [](ArgumentReader &reader, DistortionOptions &options)
         { options.range = read_range(reader); }},
        {"--isolines", [](ArgumentReader &reader, DistortionOptions &options)
         { options.isolines = read_step(reader); }},
        {"--values", [](ArgumentReader &, DistortionOptions &options) { options.values = true; }},
        {"--legend", [](ArgumentReader &reader, DistortionOptions &options)
         { options.legend = reader.value(); }},
        {"--threads", [](ArgumentReader &reader, DistortionOptions &options)
         { options.threads = static_cast<int>(reader.whole_number(0, 1024)); }},
        {"--quiet", [](ArgumentReader &, DistortionOptions &options) { options.quiet = true; }},
        {"--help", [](ArgumentReader &, DistortionOptions &options) { options.help = true; }},
        {"--version",
         [](ArgumentReader &, DistortionOptions &options) { options.version = true; }}};
    return actions;
}

void read_option(ArgumentReader &reader, DistortionOptions &options)
{
    const auto action = option_actions().find(reader.text());
    if (action != option_actions().end())
    {
        action->second(reader, options);
        return;
    }
    const auto overlay_action = overlay_option_actions().find(reader.text());
    if (overlay_action == overlay_option_actions().end())
    {
        throw UsageFailure("there is no option " + in_quotes(reader.text()) + "; see --help");
    }
    overlay_action->second(reader, options.overlay);
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
        throw UsageFailure("-m: " + in_quotes(options.mapping) +
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

DistortionOptions parse_distortion_options(int argc, char **argv)
{
    DistortionOptions options;
    std::vector<std::string> operands;
    ArgumentReader reader(argc, argv);
    while (reader.next())
    {
        if (reader.is_option())
        {
            read_option(reader, options);
        }
        else
        {
            operands.push_back(reader.text());
        }
    }
    if (!options.help && !options.version)
    {
        check_faces(options);
    }
    set_defaults(options);
    if (options.help || options.version)
    {
        return options;
    }
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

std::string distortion_help_text()
{
    std::string list;
    for (const Quantity &quantity : quantities())
    {
        std::string line = std::string("  ") + quantity.name;
        line.resize(17, ' ');
        list += line + quantity.symbol + ": " + quantity.meaning + "\n";
    }
    return R"(Usage: cubemap-distortion [OPTION]... OUTPUT

Draws the distortion of a mapping between the sphere and the faces of a cube, a disc
or one square: the colour of each pixel is that of the quantity at its centre. PNG,
JPEG and TIFF; with --values TIFF and EXR.

  -m, --mapping MAPPING NAME, NAME:PRESET or NAME:PARAMETER=VALUE[,...]; without it, )" CM_MAPPING_RECOMMENDED
           R"(
  --frame FRAME         how the faces sit on the axes: geo (without it), gl, fits or s2
  --quantity QUANTITY   what to draw; without it, area
  --layout LAYOUT       faces: six files, %f in the name stands for 0 to 5; strip:
                        6N x N; cross (without it): 4N x 3N, the cube unfolded
  --face N              one face alone, 0 to 5
  --size N              pixels along the edge of a face, to )" +
           std::to_string(largest_distortion_face) + R"(; without it, 256
  --colors SPEC         a colour map, such as sequential-single:hue=140; without it,
                        diverging-lightness or sequential-custom. Sequential scales
                        go from its light end to its dark one
  --reverse             the colours the other way round
  --range LOW:HIGH      the values at the ends of the colours; without it, 0.25:4 times
                        the mean for areas, 0.5:2 for texel-aspect, 1:2 for isotropy,
                        0:40 for deformation. What is beyond has the end's colour,
                        and the program says how much that is
  --isolines STEP       lines at the multiples of STEP, in the quantity's unit
  --legend FILE         a strip of the colours with numbers
  --values              the numbers themselves, in floats, instead of colours
)" + overlay_help_text(DistortionOptions().overlay) +
           R"(  --threads N           threads to use; 0 (without it) is one for each core
  --quiet               neither a progress bar nor lines that say what was done
  --help, --version     print this, or the version, and stop

Quantities:
)" + list + R"(
Examples:
  cubemap-distortion -m gnomonic --range 0.3:3 --legend legend.png area.png
  cubemap-distortion -m qsc --quantity deformation --face 0 --isolines 5 qsc.png
  cubemap-distortion -m healpix --quantity isotropy --graticule 15 cross.png
  cubemap-distortion -m tangent --values --layout strip area.exr
  cubemap-distortion -m peirce --size 512 --graticule 15 peirce.png
)";
}
