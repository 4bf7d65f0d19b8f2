/* SPDX-License-Identifier: MIT
 *
 * The command line of cubemap-latitude.
 */
#define _GNU_SOURCE

#include "tools/latitude/cubemap_latitude.h"

#include "filter_program.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    check_filter("cubemap-latitude", cm_latitude_main, data, size);
    return 0;
}
