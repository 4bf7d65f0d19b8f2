/* SPDX-License-Identifier: MIT
 *
 * The command line of cubemap-latitude.
 */
#define _GNU_SOURCE

#include "filter_program.h"

int latitude_main(int argc, char **argv);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    check_filter("cubemap-latitude", latitude_main, data, size);
    return 0;
}
