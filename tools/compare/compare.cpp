// SPDX-License-Identifier: MIT
//
// cubemap-compare: how far two images of the same size are from each other.

#include "compare_main.h"
#include "compare_report.hpp"
#include "tools/cli/program.hpp"

#include <cstdio>

namespace
{

int compare(int argc, char **argv, const cm_streams &streams)
{
    const CompareOptions options = parse_compare_options(argc, argv, streams);
    if (options.printed)
    {
        return 0;
    }
    if (options.difference)
    {
        check_difference_name(*options.difference, options.names);
    }
    Pictures pictures =
        read_pictures(options.names[0], options.names[1],
                      {options.reference_surface, options.surface}, options.threads);
    const Measured measured = measure(options, pictures);
    if (options.difference)
    {
        draw_difference(options, pictures);
    }
    if (!options.quiet)
    {
        for (const std::string &warning : pictures.warnings)
        {
            std::fprintf(streams.err, "cubemap-compare: %s\n", warning.c_str());
        }
        print(streams, report(options, pictures, measured));
    }
    check_limits(options, pictures, measured);
    return 0;
}

} // namespace

int cm_compare_main(int argc, char **argv, const cm_streams *streams)
{
    return run_program("cubemap-compare", *streams,
                       [argc, argv, streams] { return compare(argc, argv, *streams); });
}
