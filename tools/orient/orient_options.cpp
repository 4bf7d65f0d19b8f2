// SPDX-License-Identifier: MIT

#include "orient_options.hpp"
#include "tools/cli/program.hpp"

#include <map>

namespace
{

constexpr int largest_picture_face = 4096;

constexpr const char *help_text =
    R"(Usage: cubemap-orient [OPTION]... MASK

Finds how the base cube is best turned so that what the mask shows suffers least
from a mapping, over all rotations, and prints the orientation and what it gains.
MASK is an equirectangular image, longitude -180 at its left edge, north at the
top, twice as wide as high; how bright a pixel is says how much it counts.

  -m, --mapping SPEC   mapping of the faces (coupled), as cubemap-project --list
                       names them
  --measure WHAT       what is to be least: deformation (the mean of omega, in
                       degrees; the default), isotropy (the mean of D_I), area
                       (the mean of |ln D_A|), scale (the mean of s = a b), edges
                       (the length of the edges of faces over the mask, in km)
  --over WHAT          equal areas of what count alike in means: sphere (the
                       default) or face
  --threshold T        pixels of T or more, of 0 to 1, count fully, others not
  --invert             dark pixels count, bright ones do not
  --resolution DEG     how finely the best is followed, 0.01 to 10 (0.1)
  --boxes N            rotations, in boxes, that the proof may look at (100000, of
                       edges 600000); with more the grid is finer, too
  --evaluate LON,LAT[,ROLL]|NAME
                       do not search: print the measure in this orientation
  --picture FILE       write a picture of the faces: above as they are without
                       rotation, below in the best orientation
  --image FILE         an equirectangular image to be shown in it; else the mask,
                       coloured by the deformation
  --size N             pixels along a face in it (256)
  --threads N          threads to work; 0 (default) takes all processors
  --json               print the result as JSON
  -q, --quiet, --no-progress
                       no progress bar
  --list               print the orientations that have a name
  --help, --version

The orientation is printed as "LON LAT ROLL", in degrees: the middle of the cube's
front is at LON and LAT, and the cube is turned by ROLL about it, anticlockwise
seen from outside.

Example:
  cubemap-orient --picture before-after.png data/land-1440.png
)";

std::string read_mapping(ArgumentReader &reader)
{
    const std::string option = reader.text();
    const std::string specification = reader.value();
    char message[400];
    if (cm_specification_check(specification.c_str(), message, sizeof message) != CM_OK)
    {
        throw UsageFailure(option + ": " + message);
    }
    if (cm_catalogue_find(specification.substr(0, specification.find(':')).c_str()) != nullptr &&
        cm_catalogue_find(specification.substr(0, specification.find(':')).c_str())->kind !=
            CM_KIND_CUBE)
    {
        throw UsageFailure(option + ": " + in_quotes(specification) +
                           " has one face; only a cube can be turned");
    }
    return specification;
}

std::string read_orientation(ArgumentReader &reader)
{
    const std::string option = reader.text();
    const std::string text = reader.value();
    char message[400];
    cm_rotation rotation;
    if (cm_rotation_parse(text.c_str(), &rotation, message, sizeof message) != CM_OK)
    {
        throw UsageFailure(option + ": " + message);
    }
    return text;
}

double read_between(ArgumentReader &reader, double low, double high, const char *range)
{
    const std::string option = reader.text();
    const double number = reader.not_negative_number();
    if (number < low || number > high)
    {
        throw UsageFailure(option + ": it must be " + range);
    }
    return number;
}

using OptionAction = void (*)(ArgumentReader &, OrientOptions &);

const std::map<std::string, OptionAction> &option_actions()
{
    static const OptionAction mapping = [](ArgumentReader &reader, OrientOptions &options)
    { options.mapping = read_mapping(reader); };
    static const OptionAction quiet = [](ArgumentReader &, OrientOptions &options)
    { options.quiet = true; };
    static const std::map<std::string, OptionAction> actions = {
        {"-m", mapping},
        {"--mapping", mapping},
        {"--measure",
         [](ArgumentReader &reader, OrientOptions &options)
         {
             options.measure = static_cast<cm_orient_measure>(
                 reader.word({"deformation", "isotropy", "area", "scale", "edges"}));
         }},
        {"--over",
         [](ArgumentReader &reader, OrientOptions &options) {
             options.over = static_cast<cm_measure>(reader.word({"face", "sphere"}));
         }},
        {"--threshold", [](ArgumentReader &reader, OrientOptions &options)
         { options.threshold = read_between(reader, 0, 1, "from 0 to 1"); }},
        {"--invert", [](ArgumentReader &, OrientOptions &options) { options.invert = true; }},
        {"--resolution", [](ArgumentReader &reader, OrientOptions &options)
         { options.resolution = read_between(reader, 0.01, 10, "from 0.01 to 10 degrees"); }},
        {"--boxes", [](ArgumentReader &reader, OrientOptions &options)
         { options.boxes = static_cast<int>(reader.whole_number(1, 100000000)); }},
        {"--evaluate", [](ArgumentReader &reader, OrientOptions &options)
         { options.evaluate = read_orientation(reader); }},
        {"--picture",
         [](ArgumentReader &reader, OrientOptions &options) { options.picture = reader.value(); }},
        {"--image",
         [](ArgumentReader &reader, OrientOptions &options) { options.image = reader.value(); }},
        {"--size", [](ArgumentReader &reader, OrientOptions &options)
         { options.size = static_cast<int>(reader.whole_number(8, largest_picture_face)); }},
        {"--threads", [](ArgumentReader &reader, OrientOptions &options)
         { options.threads = static_cast<int>(reader.whole_number(0, 1024)); }},
        {"--json", [](ArgumentReader &, OrientOptions &options) { options.json = true; }},
        {"-q", quiet},
        {"--quiet", quiet},
        {"--no-progress", quiet},
        {"--list", [](ArgumentReader &, OrientOptions &options) { options.list = true; }},
        {"--help", [](ArgumentReader &, OrientOptions &options) { options.help = true; }},
        {"--version", [](ArgumentReader &, OrientOptions &options) { options.version = true; }}};
    return actions;
}

} // namespace

const char *orient_help_text()
{
    return help_text;
}

OrientOptions parse_orient_options(int argc, char **argv)
{
    OrientOptions options;
    std::vector<std::string> names;
    ArgumentReader reader(argc, argv);
    while (reader.next())
    {
        const auto action = option_actions().find(reader.text());
        if (!reader.is_option())
        {
            names.push_back(reader.text());
        }
        else if (action != option_actions().end())
        {
            action->second(reader, options);
        }
        else
        {
            throw UsageFailure("there is no option " + in_quotes(reader.text()) + "; see --help");
        }
    }
    if (options.help || options.version || options.list)
    {
        return options;
    }
    if (names.size() != 1)
    {
        throw UsageFailure("one mask is needed, " + std::to_string(names.size()) +
                           (names.size() == 1 ? " is" : " are") + " given; see --help");
    }
    if (!options.image.empty() && options.picture.empty())
    {
        throw UsageFailure("--image is shown in the picture; --picture says where that goes");
    }
    options.mask = names.front();
    return options;
}
