// SPDX-License-Identifier: MIT
//
// cubemap-reproject: an image of the sphere from one projection to another.

#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"
#include "reproject_options.hpp"
#include "reproject_output.hpp"

#include <cubemap/version.h>

namespace
{

int reproject(int argc, char **argv)
{
    const Options options = parse_options(argc, argv);
    if (options.help || options.version)
    {
        print(options.help ? help_text() : "cubemap-reproject " + std::string(cm_version()) + "\n");
        return 0;
    }
    guard_temporary_files();
    const int threads = thread_count(options.threads);
    OIIO::attribute("threads", threads);
    OIIO::attribute("exr_threads", threads > 1 ? threads : -1);

    Input input(options);
    Output output(options, input);
    const SphereGrid grid = input.read(options, output.multiply_alpha(), threads);
    output.write(options, input, grid, threads);
    if (!options.quiet)
    {
        std::vector<std::string> names;
        for (const ImageFile &file : input.files())
        {
            names.push_back(file.path());
        }
        print(name_list(names) + " (" + input.description(options) + ") -> " +
              output.description(options) + "\n");
    }
    return 0;
}

} // namespace

int main(int argc, char **argv)
{
    return run_program("cubemap-reproject", [argc, argv] { return reproject(argc, argv); });
}
