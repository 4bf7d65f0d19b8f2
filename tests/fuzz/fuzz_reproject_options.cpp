// SPDX-License-Identifier: MIT
//
// The command line of cubemap-reproject, and the names that it makes of its operands. Input: an
// argument a line.

#include "tools/cli/image_writer.hpp"
#include "tools/cli/program.hpp"
#include "tools/reproject/reproject_input.hpp"
#include "tools/reproject/reproject_options.hpp"
#include "tools/reproject/reproject_table.h"
#include "tools/image/face_names.hpp"

#include <set>

#include "fuzz_arguments.h"

namespace
{

void check_usage_message(const UsageFailure &failure)
{
    EXPECT(failure.exit_status() == exit_usage && is_one_line(failure.what()) &&
               *failure.what() != '\0',
           "'%s'", failure.what());
}

void check_names(const std::string &name)
{
    const std::vector<std::string> names = face_names(name);
    EXPECT(names.size() == 6 && std::set<std::string>(names.begin(), names.end()).size() == 6,
           "the six names of '%s' are not different", name.c_str());
    for (const std::string &one : names)
    {
        EXPECT(!names_faces(one), "'%s'", one.c_str());
    }
    EXPECT(!name_list(names).empty(), "no list of names");
}

void check_format(const std::string &name)
{
    try
    {
        const std::string format = output_format(name);
        EXPECT(std::set<std::string>({"png", "jpeg", "tiff", "openexr", "hdr"}).count(format) == 1,
               "'%s'", format.c_str());
    }
    catch (const UsageFailure &failure)
    {
        check_usage_message(failure);
    }
}

// What the command line says of a surface is one, or nothing.
void check_surface(const SurfaceOptions &surface)
{
    const std::string &text = surface.specification;
    EXPECT(text.empty() || cm_surface_check(text.c_str(), nullptr, nullptr, 0) == CM_OK,
           "surface '%s'", text.c_str());
    EXPECT(surface.frame.empty() || cm_frame_find(surface.frame.c_str()) != nullptr, "frame '%s'",
           surface.frame.c_str());
    const std::string cube = "cube;layout=" + surface.layout;
    EXPECT(surface.layout.empty() || cm_surface_check(cube.c_str(), nullptr, nullptr, 0) == CM_OK,
           "layout '%s'", surface.layout.c_str());
    EXPECT(!surface.rotation || cm_rotation_check(&*surface.rotation) == CM_OK, "a rotation");
    const std::string head = head_of(text);
    EXPECT(text.compare(0, head.size(), head) == 0 &&
               without_key(text, "size").size() <= text.size(),
           "'%s'", text.c_str());
}

void check_options(const Options &options)
{
    check_surface(options.from);
    check_surface(options.to);
    EXPECT(cm_filter_name(options.filter) != nullptr, "no filter");
    EXPECT(!options.size || (*options.size >= 1 && *options.size <= REPROJECT_EQUIRECT_MAX),
           "size %d", *options.size);
    const OverlayOptions &lines = options.overlay;
    EXPECT(lines.indicatrices || !lines.indicatrices_radius || options.printed, "a radius alone");
    EXPECT(!lines.graticule || (*lines.graticule >= 0.0099 && *lines.graticule <= 180),
           "%g degrees", *lines.graticule);
    EXPECT(!lines.grid || *lines.grid >= 1, "grid %d", *lines.grid);
    EXPECT(lines.line_width >= 0.1 && lines.line_width <= 100, "line width %g", lines.line_width);
    EXPECT(options.threads >= 0 && options.threads <= 1024, "%d threads", options.threads);
    check_names(options.input);
    check_names(options.output);
    check_format(options.output);
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static std::FILE *const null = std::fopen("/dev/null", "w");
    const cm_streams nowhere = {stdin, null, null};
    arguments given = read_arguments("cubemap-reproject", data, size);
    try
    {
        check_options(parse_options(given.count, given.argument, nowhere));
    }
    catch (const UsageFailure &failure)
    {
        check_usage_message(failure);
    }
    drop_arguments(&given);
    return 0;
}
