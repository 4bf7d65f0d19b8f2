// SPDX-License-Identifier: MIT

#include "reproject_options.hpp"
#include "reproject_main.h"
#include "reproject_table.h"
#include "tools/cli/catalogue_name.h"
#include "tools/cli/program.hpp"

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
                           message + suggestion(nearest_mapping(mapping.c_str())));
    }
    const MappingPointer made = make_mapping(mapping, *cm_frame_find("geo"));
    return cm_mapping_describe(made.get())->kind;
}

void read_projection(const OptionReader &reader, std::optional<Kind> &kind, std::string &mapping)
{
    const std::string option = reader.name();
    const std::string text = reader.text();
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

void read_option(int id, OptionReader &reader, Options &options)
{
    switch (id)
    {
    case REPROJECT_FROM:
        read_projection(reader, options.from, options.from_mapping);
        break;
    case REPROJECT_TO:
        read_projection(reader, options.to, options.to_mapping);
        break;
    case REPROJECT_SIZE:
        options.size = reader.whole_number();
        break;
    case REPROJECT_LAYOUT:
        options.layout = read_layout(reader, options.columns);
        break;
    case REPROJECT_FROM_LAYOUT:
        options.from_layout = read_layout(reader, options.from_columns);
        break;
    case REPROJECT_FRAME:
        options.frame = cm_frame_at(reader.choice());
        break;
    case REPROJECT_FROM_FRAME:
        options.from_frame = cm_frame_at(reader.choice());
        break;
    case REPROJECT_FILTER:
        options.filter = static_cast<Filter>(reader.choice());
        break;
    case REPROJECT_THREADS:
        options.threads = reader.whole_number();
        break;
    case REPROJECT_QUIET:
        options.quiet = true;
        break;
    default:
        read_overlay_option(id, reader, options.overlay);
        break;
    }
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

Options parse_options(int argc, char **argv, const cm_streams &streams)
{
    Options options;
    OptionReader reader(cm_reproject_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        read_option(id, reader, options);
    }
    set_defaults(options);
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
    check_overlay_options(options.overlay, false);
    options.input = operands[0];
    options.output = operands[1];
    return options;
}
