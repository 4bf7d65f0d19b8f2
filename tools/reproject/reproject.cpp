// SPDX-License-Identifier: MIT
//
// cubemap-reproject: an image of the sphere from one projection to another.

#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"
#include "tools/image/face_names.hpp"
#include "part_rules.hpp"
#include "film.hpp"
#include "healpix_rules.hpp"
#include "hips_output.hpp"
#include "mapping_choice.hpp"
#include "reproject_main.h"
#include "reproject_options.hpp"
#include "reproject_output.hpp"
#include "texture_rules.hpp"

#include <cstdio>

namespace
{

int reproject(int argc, char **argv, const cm_streams &streams)
{
    Options options = parse_options(argc, argv, streams);
    if (options.printed)
    {
        return 0;
    }
    take_mapping(options);
    take_texture_rules(options);
    take_healpix_rules(options);
    take_hips_rules(options);
    check_parts(options);
    const int threads = thread_count(options.threads);
    if (is_film(options))
    {
        return reproject_film(options, threads, streams);
    }

    MemoryCeiling ceiling(options.memory, options.output, options.quiet ? nullptr : streams.err);
    Input input(options, threads);
    choose_mapping(options, input);
    Output output(options, input);
    for (const std::string &warning : input.warnings())
    {
        std::fprintf(streams.err, "cubemap-reproject: %s\n", warning.c_str());
    }
    input.read(options, threads, ceiling, streams.err, output.kept_work());
    KeptPlan plan;
    try
    {
        output.write(options, input, threads, ceiling, streams.err, plan);
    }
    catch (const Failure &failure)
    {
        if (!options.resume)
        {
            throw;
        }
        throw Failure(std::string(failure.what()) + "; the same command goes on from what is done",
                      failure.exit_status());
    }
    if (!options.quiet)
    {
        std::vector<std::string> names;
        for (const ImageFile &file : input.files())
        {
            if (names.empty() || names.back() != file.path())
            {
                names.push_back(file.path());
            }
        }
        const cm_streams said = {streams.in, is_pipe(options.output) ? streams.err : streams.out,
                                 streams.err};
        print(said, name_list(names) + " (" + input.description() + ") -> " + output.description() +
                        "\n");
    }
    return 0;
}

} // namespace

int cm_reproject_main(int argc, char **argv, const cm_streams *streams)
{
    return run_program("cubemap-reproject", *streams,
                       [argc, argv, streams] { return reproject(argc, argv, *streams); });
}
