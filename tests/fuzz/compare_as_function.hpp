// SPDX-License-Identifier: MIT
//
// Read before the source of cubemap-compare, which then is a function that its harness calls.

#ifndef TESTS_FUZZ_COMPARE_AS_FUNCTION_HPP
#define TESTS_FUZZ_COMPARE_AS_FUNCTION_HPP

#define main compare_main

int compare_main(int argc, char **argv);

#endif
