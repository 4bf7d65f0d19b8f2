// SPDX-License-Identifier: MIT
//
// cubemap-reproject: an image of the sphere from one projection to another.

#include "tools/cli/image_threads.hpp"
#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"
#include "reproject_options.hpp"
#include "reproject_main.h"
#include "reproject_output.hpp"

namespace
{

int reproject(int argc, char **argv, const cm_streams &streams)
{
    const Options options = parse_options(argc, argv, streams);
    if (options.printed)
    {
        return 0;
    }
    const int threads = thread_count(options.threads);
    const ImageThreads image_threads(threads);

    Input input(options);
    Output output(options, input);
    const SphereGrid grid = input.read(options, output.multiply_alpha(), threads);
    output.write(options, input, grid, threads, streams.err);
    if (!options.quiet)
    {
        std::vector<std::string> names;
        for (const ImageFile &file : input.files())
        {
            names.push_back(file.path());
        }
        print(streams, name_list(names) + " (" + input.description(options) + ") -> " +
                           output.description(options) + "\n");
    }
    return 0;
}

} // namespace

int cm_reproject_main(int argc, char **argv, const cm_streams *streams)
{
    return run_program("cubemap-reproject", *streams,
                       [argc, argv, streams] { return reproject(argc, argv, *streams); });
}
