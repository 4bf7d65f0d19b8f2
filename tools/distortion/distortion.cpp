// SPDX-License-Identifier: MIT
//
// cubemap-distortion: pictures of what a mapping does to areas, shapes and angles.

#include "distortion_options.hpp"
#include "distortion_picture.hpp"
#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"

#include <cubemap/version.h>

namespace
{

int draw_distortion(int argc, char **argv)
{
    const DistortionOptions options = parse_distortion_options(argc, argv);
    if (options.help || options.version)
    {
        print(options.help ? distortion_help_text()
                           : "cubemap-distortion " + std::string(cm_version()) + "\n");
        return 0;
    }
    guard_temporary_files();
    const int threads = thread_count(options.threads);
    OIIO::attribute("threads", threads);
    OIIO::attribute("exr_threads", threads > 1 ? threads : -1);

    DistortionPicture picture(options);
    picture.write(threads);
    if (!options.quiet)
    {
        print(picture.report());
    }
    return 0;
}

} // namespace

int main(int argc, char **argv)
{
    return run_program("cubemap-distortion", [argc, argv] { return draw_distortion(argc, argv); });
}
