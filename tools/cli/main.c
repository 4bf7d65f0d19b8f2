/* SPDX-License-Identifier: MIT
 *
 * The main of every program. Compiled for each with MAIN, the function that it is, and NAME, as people call it.
 */
#include "descriptor.h"
#include "streams.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#ifdef __cplusplus
extern "C"
#endif
    int
    MAIN(int argc, char **argv, const cm_streams *streams);

int main(int argc, char **argv)
{
    descriptors_keep_closed();
    const cm_streams streams = {stdin, stdout, stderr};
    const int status = MAIN(argc, argv, &streams);
    /* what does not arrive may show only now */
    if (fclose(stdout) != 0 && status == EXIT_SUCCESS)
    {
        fprintf(stderr, NAME ": cannot write to standard output: %s\n", strerror(errno));
        return EXIT_FAILURE;
    }
    return status;
}
