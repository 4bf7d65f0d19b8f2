// SPDX-License-Identifier: MIT
//
// --mapping: the mapping of OUTPUT's cube by its name, or the one that suits what is asked, with the reason.

#ifndef CUBEMAP_TOOLS_MAPPING_CHOICE_HPP
#define CUBEMAP_TOOLS_MAPPING_CHOICE_HPP

#include "reproject_input.hpp"

// --mapping in --to, but for auto. UsageFailure if --to or --for say another.
void take_mapping(Options &options);

// The mapping for auto and why, in options.
void choose_mapping(Options &options, const Input &input);

#endif
