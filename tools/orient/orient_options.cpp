// SPDX-License-Identifier: MIT

#include "orient_options.hpp"
#include "orient_main.h"
#include "orient_table.h"
#include "tools/cli/catalogue_name.h"
#include "tools/cli/program.hpp"

namespace
{

std::string read_mapping(const OptionReader &reader)
{
    const std::string specification = reader.text();
    char message[400];
    if (cm_specification_check(specification.c_str(), message, sizeof message) != CM_OK)
    {
        throw UsageFailure(reader.name() + ": " + message +
                           suggestion(nearest_mapping(specification.c_str())));
    }
    const cm_mapping_info *const info =
        cm_catalogue_find(specification.substr(0, specification.find(':')).c_str());
    if (info != nullptr && info->kind != CM_KIND_CUBE)
    {
        throw UsageFailure(reader.name() + ": " + in_quotes(specification) +
                           " has one face; only a cube can be turned");
    }
    return specification;
}

std::string read_orientation(const OptionReader &reader)
{
    const std::string text = reader.text();
    char message[400];
    cm_rotation rotation;
    if (cm_rotation_parse(text.c_str(), &rotation, message, sizeof message) != CM_OK)
    {
        throw UsageFailure(reader.name() + ": " + message +
                           suggestion(nearest_name(text.c_str(), orientation_name_at)));
    }
    return text;
}

void read_option(int id, const OptionReader &reader, OrientOptions &options)
{
    switch (id)
    {
    case ORIENT_MAPPING:
        options.mapping = read_mapping(reader);
        break;
    case ORIENT_MEASURE:
        options.measure = static_cast<cm_orient_measure>(reader.choice());
        break;
    case ORIENT_OVER:
        options.over = static_cast<cm_measure>(reader.choice());
        break;
    case ORIENT_THRESHOLD:
        options.threshold = reader.number();
        break;
    case ORIENT_INVERT:
        options.invert = true;
        break;
    case ORIENT_RESOLUTION:
        options.resolution = reader.number();
        break;
    case ORIENT_BOXES:
        options.boxes = reader.whole_number();
        break;
    case ORIENT_EVALUATE:
        options.evaluate = read_orientation(reader);
        break;
    case ORIENT_PICTURE:
        options.picture = reader.text();
        break;
    case ORIENT_IMAGE:
        options.image = reader.text();
        break;
    case ORIENT_SIZE:
        options.size = reader.whole_number();
        break;
    case ORIENT_THREADS:
        options.threads = reader.whole_number();
        break;
    case ORIENT_JSON:
        options.json = true;
        break;
    case ORIENT_QUIET:
        options.quiet = true;
        break;
    default:
        options.list = true;
        break;
    }
}

} // namespace

OrientOptions parse_orient_options(int argc, char **argv, const cm_streams &streams)
{
    OrientOptions options;
    OptionReader reader(cm_orient_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        read_option(id, reader, options);
    }
    options.printed = reader.printed();
    if (options.printed || options.list)
    {
        return options;
    }
    const std::vector<std::string> names = reader.operands();
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
