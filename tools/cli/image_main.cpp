// SPDX-License-Identifier: MIT
//
// The start of each image program. PROGRAM_MAIN is the function that the program is.

#include "tools/cli/streams.h"
#include "tools/cli/temporary_guard.hpp"

extern "C" int PROGRAM_MAIN(int argc, char **argv, const cm_streams *streams);

int main(int argc, char **argv)
{
    guard_temporary_files();
    const cm_streams streams = {stdin, stdout, stderr};
    return PROGRAM_MAIN(argc, argv, &streams);
}
