/* SPDX-License-Identifier: MIT
 *
 * Read before the sources of cubemap-project, which then is a function that its harness calls: the
 * end of the program comes back to the harness, and no file is opened.
 */
#ifndef TESTS_FUZZ_PROJECT_AS_FUNCTION_H
#define TESTS_FUZZ_PROJECT_AS_FUNCTION_H

/* With large files, which the build asks for, the C library's header would redirect the new name to
 * its own open64. */
#undef _FILE_OFFSET_BITS

#define main project_main
#define exit project_exit
#define open project_open
#define close project_close

int project_main(int argc, char **argv);

#endif
