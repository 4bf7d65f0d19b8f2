/* SPDX-License-Identifier: MIT
 *
 * The command line of cubemap-project.
 */
#define _GNU_SOURCE

#include "tools/project/project.h"

#include "filter_program.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    check_filter("cubemap-project", cm_project_main, data, size);
    return 0;
}
