/* SPDX-License-Identifier: MIT
 *
 * Read before the sources of a filter, cubemap-project or cubemap-latitude, which then is a function called
 * FILTER_MAIN: the end of the program comes back to its harness (filter_program.h), and no file is opened.
 */
#ifndef TESTS_FUZZ_FILTER_AS_FUNCTION_H
#define TESTS_FUZZ_FILTER_AS_FUNCTION_H

/* With large files, which the build asks for, the C library's header would redirect the new name to
 * its own open64. */
#undef _FILE_OFFSET_BITS

#define main FILTER_MAIN
#define exit filter_exit
#define open filter_open
#define close filter_close

int FILTER_MAIN(int argc, char **argv);

#endif
