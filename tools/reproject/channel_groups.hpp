// SPDX-License-Identifier: MIT
//
// Pictures of more channels than the engine takes at a time, as several of fewer, in the same memory.

#ifndef CUBEMAP_TOOLS_REPROJECT_CHANNEL_GROUPS_HPP
#define CUBEMAP_TOOLS_REPROJECT_CHANNEL_GROUPS_HPP

#include "memory_ceiling.hpp"

#include <cubemap/image.h>

#include <memory>
#include <vector>

class ChannelGroups
{
public:
    // Pictures of a surface, of any number of channels, made ready for a plan; what is resampled is of type. The
    // pictures must stay as they are. What the plan's filter needs lies where the ceiling has it.
    ChannelGroups(const cm_plan &plan, const cm_image *pictures, std::size_t picture_count,
                  cm_pixel_type type, int threads, MemoryCeiling &ceiling);

    // As cm_resample_source, of all channels.
    void resample(const cm_plan &plan, const std::vector<cm_image> &to, const cm_rows &rows,
                  int threads) const;

    // Of the first channels.
    cm_filter filter() const noexcept
    {
        return cm_source_filter(groups.front().get());
    }

private:
    struct Deleter
    {
        void operator()(cm_source *owned) const noexcept
        {
            cm_source_destroy(owned);
        }
    };

    std::vector<std::unique_ptr<cm_source, Deleter>> groups;
};

#endif
