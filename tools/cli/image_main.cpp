// SPDX-License-Identifier: MIT
//
// The start of each image program. PROGRAM_MAIN is the function that the program is.

#include "tools/cli/descriptor.h"
#include "tools/cli/streams.h"
#include "tools/cli/temporary_guard.hpp"

#include <cstdio>

extern "C" int PROGRAM_MAIN(int argc, char **argv, const cm_streams *streams);

int main(int argc, char **argv)
{
    descriptors_keep_closed();
    guard_temporary_files();
    const cm_streams streams = {stdin, stdout, stderr};
#if defined(__GLIBC__)
    // Libraries that decode images write lines of their own there; what they mean is in our messages. The descriptor is as
    // it was.
    std::FILE *const nowhere = std::fopen("/dev/null", "w");
    stderr = nowhere == nullptr ? stderr : nowhere;
#endif
    return PROGRAM_MAIN(argc, argv, &streams);
}
