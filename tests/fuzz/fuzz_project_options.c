/* SPDX-License-Identifier: MIT
 *
 * The command line of cubemap-project.
 */
#define _GNU_SOURCE

#include "filter_program.h"

int project_main(int argc, char **argv);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    check_filter("cubemap-project", project_main, data, size);
    return 0;
}
