// SPDX-License-Identifier: MIT
//
// cubemap-distortion: pictures of what a mapping does to areas, shapes and angles.

#include "distortion_main.h"
#include "distortion_options.hpp"
#include "distortion_picture.hpp"
#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"

namespace
{

int draw_distortion(int argc, char **argv, const cm_streams &streams)
{
    const DistortionOptions options = parse_distortion_options(argc, argv, streams);
    if (options.printed)
    {
        return 0;
    }
    const int threads = thread_count(options.threads);

    DistortionPicture picture(options);
    picture.write(threads, streams.err);
    if (!options.quiet)
    {
        print(streams, picture.report());
    }
    return 0;
}

} // namespace

int cm_distortion_main(int argc, char **argv, const cm_streams *streams)
{
    return run_program("cubemap-distortion", *streams,
                       [argc, argv, streams] { return draw_distortion(argc, argv, *streams); });
}
