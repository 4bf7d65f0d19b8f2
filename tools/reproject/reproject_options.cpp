// SPDX-License-Identifier: MIT

#include "reproject_options.hpp"
#include "tools/cli/program.hpp"

#include <functional>
#include <map>

#include <cubemap/catalogue.h>

namespace
{

// A mapping of six faces follows "cube:", one of one face stands alone.
cm_kind read_kind(const std::string &option, const std::string &text, const std::string &mapping)
{
    char message[400];
    const bool cube = mapping.size() < text.size();
    const cm_status status = cm_specification_check(mapping.c_str(), message, sizeof message);
    if (status != CM_OK)
    {
        const bool unknown = !cube && status == CM_ERROR_MAPPING;
        throw UsageFailure(option + ": " + in_quotes(text) +
                           (unknown ? " is not equirect, cube or cube:MAPPING, nor a mapping of "
                                      "one face: "
                                    : ": ") +
                           message);
    }
    const MappingPointer made = make_mapping(mapping, *cm_frame_find("geo"));
    return cm_mapping_describe(made.get())->kind;
}

void read_projection(ArgumentReader &reader, std::optional<Kind> &kind, std::string &mapping)
{
    const std::string option = reader.text();
    const std::string text = reader.value();
    if (text == "equirect")
    {
        kind = Kind::equirect;
        return;
    }
    const bool cube = text == "cube" || text.compare(0, 5, "cube:") == 0;
    mapping = text == "cube" ? CM_MAPPING_RECOMMENDED : cube ? text.substr(5) : text;
    const cm_kind found = text == "cube" ? CM_KIND_CUBE : read_kind(option, text, mapping);
    kind = cube ? Kind::cube : Kind::chart;
    if (found == CM_KIND_DISC_SQUARE)
    {
        throw UsageFailure(option + ": " + in_quotes(text) +
                           ": it joins disc and square, not the sphere; a layout has it as a part, "
                           "as in quincuncial:lambert,shirley");
    }
    if (cube != (found == CM_KIND_CUBE))
    {
        throw UsageFailure(option + ": " + in_quotes(text) + ": " + mapping +
                           (cube ? " has one face; say " + mapping
                                 : " is a mapping of the cube; say cube:" + mapping));
    }
}

using OptionAction = std::function<void(ArgumentReader &, Options &)>;

const std::map<std::string, OptionAction> &option_actions()
{
    static const std::map<std::string, OptionAction> actions = {
        {"--from", [](ArgumentReader &reader, Options &options)
         { read_projection(reader, options.from, options.from_mapping); }},
        {"--to", [](ArgumentReader &reader, Options &options)
         { read_projection(reader, options.to, options.to_mapping); }},
        {"--size", [](ArgumentReader &reader, Options &options)
         { options.size = static_cast<int>(reader.whole_number(1, largest_equirect)); }},
        {"--from-layout", [](ArgumentReader &reader, Options &options)
         { options.from_layout = read_layout(reader, options.from_columns); }},
        {"--layout", [](ArgumentReader &reader, Options &options)
         { options.layout = read_layout(reader, options.columns); }},
        {"--from-frame",
         [](ArgumentReader &reader, Options &options) { options.from_frame = read_frame(reader); }},
        {"--frame",
         [](ArgumentReader &reader, Options &options) { options.frame = read_frame(reader); }},
        {"--filter",
         [](ArgumentReader &reader, Options &options) {
             options.filter = static_cast<Filter>(reader.word({"nearest", "bilinear"}));
         }},
        {"--threads", [](ArgumentReader &reader, Options &options)
         { options.threads = static_cast<int>(reader.whole_number(0, 1024)); }},
        {"--quiet", [](ArgumentReader &, Options &options) { options.quiet = true; }},
        {"--help", [](ArgumentReader &, Options &options) { options.help = true; }},
        {"--version", [](ArgumentReader &, Options &options) { options.version = true; }}};
    return actions;
}

void set_defaults(Options &options)
{
    if (options.frame == nullptr)
    {
        options.frame = cm_frame_find("geo");
    }
    if (options.from_frame == nullptr)
    {
        options.from_frame = options.frame;
    }
    for (std::string *mapping : {&options.from_mapping, &options.to_mapping})
    {
        if (mapping->empty())
        {
            *mapping = CM_MAPPING_RECOMMENDED;
        }
    }
}

} // namespace

Options parse_options(int argc, char **argv)
{
    Options options;
    std::vector<std::string> operands;
    ArgumentReader reader(argc, argv);
    while (reader.next())
    {
        if (!reader.is_option())
        {
            operands.push_back(reader.text());
            continue;
        }
        const auto overlay_action = overlay_option_actions().find(reader.text());
        if (overlay_action != overlay_option_actions().end())
        {
            overlay_action->second(reader, options.overlay);
            continue;
        }
        const auto action = option_actions().find(reader.text());
        if (action == option_actions().end())
        {
            throw UsageFailure("there is no option " + in_quotes(reader.text()) + "; see --help");
        }
        action->second(reader, options);
    }
    set_defaults(options);
    if (options.help || options.version)
    {
        return options;
    }
    if (operands.size() != 2)
    {
        throw UsageFailure("INPUT and OUTPUT are needed, " + std::to_string(operands.size()) +
                           (operands.size() == 1 ? " name is" : " names are") +
                           " given; see --help");
    }
    check_overlay_options(options.overlay, false);
    options.input = operands[0];
    options.output = operands[1];
    return options;
}

std::string help_text()
{
    return R"(Usage: cubemap-reproject [OPTION]... INPUT OUTPUT

Resamples an image of the sphere from one projection to another: equirectangular,
the six faces of a cube, a disc, as a fisheye lens makes it, or one square.
PNG, JPEG, TIFF, EXR and HDR, with any number of channels and any type of pixel.

  --from SPEC           what INPUT is; without it, its shape tells: 2:1 equirect,
                        6:1 a strip, 4:3 a cross; %f in the name: six faces
  --to SPEC             what OUTPUT is to be; without it, the other of the two
                        SPEC is equirect, cube, or cube:MAPPING, such as
                        cube:tangent:c=1.1823; cube alone is cube:)" CM_MAPPING_RECOMMENDED R"(
                        or azimuthal:NAME, such as azimuthal:equidistant:fov=200,
                        a disc in a square image; or a square of the whole sphere,
                        peirce, quincuncial:AZIMUTHAL,SQUARE,
                        border:AZIMUTHAL,SQUARE, octahedral,
                        octahedral:clarberg or rhealpix
  --size N              pixels along the edge of a face (to )" +
           std::to_string(largest_face) + R"(), or across an
                        equirectangular image (even, to )" +
           std::to_string(largest_equirect) + R"(); without it,
                        the resolution stays the same: at the equator, and of
                        discs and squares in the mean
  --layout LAYOUT       how OUTPUT holds the faces of a cube; without it, faces
  --from-layout LAYOUT  how INPUT does
  --frame FRAME         how the faces sit on the axes; without it, geo
  --from-frame FRAME    the same of INPUT; without it, the same as --frame
  --filter FILTER       bilinear (without it) or nearest
)" + overlay_help_text(Options().overlay) +
           R"(  --threads N           threads to use; 0 (without it) is one for each core
  --quiet               neither a progress bar nor a line that says what was done
  --help, --version     print this, or the version, and stop

Layouts:
  faces                 six files: %f in the name stands for 0 to 5; without it,
                        NAME.EXT stands for NAME_0.EXT to NAME_5.EXT
  strip                 6N x N, the faces in their order
  cross                 4N x 3N, the cube unfolded
  cross:north=N,south=N the same with the uppermost and the lowest face in columns
                        0 to 3 instead of 1, turned; of cube:healpix that is
                        rHEALPix as PROJ has it with lon_0=45

Frames:
  geo                   front right back left top bottom: lon 0, lon 90 E, lon 180,
                        lon 90 W, north, south; a face is drawn with north up
  gl                    +x -x +y -y +z -z, turned as OpenGL, Vulkan and Direct3D
                        store cube maps; +x is lon 0, +y is lon 90 E, +z is north
  fits                  as geo, in the order top front right back left bottom
  s2                    the faces of the S2 library: lon 0, lon 90 E, north, lon 180,
                        lon 90 W, south; no cross

Lines:
  Meridians and parallels, grid and ellipses lie over the resampled image. The cube
  of grid and ellipses is OUTPUT's, else INPUT's, else cube:)" CM_MAPPING_RECOMMENDED R"(.

Examples:
  cubemap-reproject --size 512 earth.jpg face_%f.png
  cubemap-reproject --to cube:qsc --layout cross earth.jpg cross.png
  cubemap-reproject --to cube:gnomonic --graticule 15 --indicatrices 5 \
      --layout cross earth.jpg cross.png
  cubemap-reproject --size 2048 face_%f.png earth-again.png
  cubemap-reproject --from cube --to cube:gnomonic --from-frame geo --frame gl \
      --layout strip face_%f.png sky.exr
  cubemap-reproject --from azimuthal:equidistant:fov=185,lat=0 fisheye.jpg world.jpg
  cubemap-reproject --to peirce --size 1024 earth.jpg peirce.png
)";
}
