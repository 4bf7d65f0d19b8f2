// SPDX-License-Identifier: MIT
//
// cubemap-distortion: pictures of what a mapping does to areas, shapes and angles.

#include "distortion_main.h"
#include "distortion_options.hpp"
#include "distortion_picture.hpp"
#include "tools/cli/image_threads.hpp"
#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"

#include <cubemap/version.h>

namespace
{

int draw_distortion(int argc, char **argv, const cm_streams &streams)
{
    const DistortionOptions options = parse_distortion_options(argc, argv);
    if (options.help || options.version)
    {
        print(streams, options.help ? distortion_help_text()
                                    : "cubemap-distortion " + std::string(cm_version()) + "\n");
        return 0;
    }
    const int threads = thread_count(options.threads);
    const ImageThreads image_threads(threads);

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
