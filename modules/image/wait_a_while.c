/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "wait_a_while.h"

#if defined(__unix__) || defined(__APPLE__)
#include <time.h>
#endif

void cm_wait_a_while(void)
{
#if defined(__unix__) || defined(__APPLE__)
    const struct timespec millisecond = {0, 1000000};
    nanosleep(&millisecond, NULL);
#endif
}
