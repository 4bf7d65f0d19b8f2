/* SPDX-License-Identifier: MIT
 *
 * Every program of tests/programs on a device, against the float kernels in C at the same points. A device is one of
 * run_*.c; judge.c has main.
 */
#ifndef SHADERS_JUDGE_H
#define SHADERS_JUDGE_H

#include <stddef.h>

enum
{
    POINT_FLOATS = 8, /* x y z 0 face u v 0 */
    RESULT_FLOATS = 16,
    POINTS_STEP = 1024 /* their number is a multiple of that */
};

typedef void (*reference_function)(const float *in, float *out);

/* made by tests/programs */
extern const reference_function reference_programs[];

/* What a device is called in the table: with the options of its compiler. NULL behind the last. */
const char *device_name(int device);

/* Does it compute with subnormal numbers, and divide by numbers as great as any? Shading languages need not. */
int device_has_all_floats(int device);

/* Makes it ready; 0 if it is not there, after a line on stderr. */
int device_open(int device, size_t count, const float *points);

/* Runs the program of that number in the folder. 0 after a message if it does not compile or run. */
int device_run(int device, const char *folder, int program, float *results);

void device_close(int device);

/* The text of a file, ended by 0; to be freed. size may be NULL. Ends the program if there is none. */
char *read_text(const char *folder, int program, const char *suffix, size_t *size);

#endif
