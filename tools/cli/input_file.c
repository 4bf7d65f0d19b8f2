/* SPDX-License-Identifier: MIT */
#include "input_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

FILE *open_input(const char *name, cm_failure *failure)
{
    FILE *const file = fopen(name, "r");
    if (file == NULL)
    {
        fail(failure, EXIT_FAILURE, "cannot open %s: %s", name, strerror(errno));
    }
    return file;
}
