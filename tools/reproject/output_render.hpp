// SPDX-License-Identifier: MIT
//
// What is computed of an output, and from what.

#ifndef CUBEMAP_TOOLS_OUTPUT_RENDER_HPP
#define CUBEMAP_TOOLS_OUTPUT_RENDER_HPP

#include "channel_groups.hpp"
#include "tools/cli/progress.hpp"

// What all of the rows have in common.
struct OutputRender
{
    MemoryCeiling &ceiling;
    const cm_plan &plan;
    const ChannelGroups &source;
    Progress &progress;
};

// Rows from first to before end of a picture, where they are to go.
struct OutputRows
{
    int first;
    int end;
    unsigned char *bytes;
};

#endif
