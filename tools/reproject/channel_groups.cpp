// SPDX-License-Identifier: MIT

#include "channel_groups.hpp"
#include "kept_plan.hpp"

#include <algorithm>

namespace
{

constexpr std::uint32_t channels_each = CM_CHANNELS_MAX;

// Some channels of a picture.
cm_image part_of(const cm_image &whole, std::uint32_t first)
{
    const std::size_t sample = cm_pixel_size(whole.type);
    const auto pixel = static_cast<std::ptrdiff_t>(sample * whole.channels);
    cm_image part = whole;
    part.pixel_stride = whole.pixel_stride != 0 ? whole.pixel_stride : pixel;
    part.row_stride = whole.row_stride != 0
                          ? whole.row_stride
                          : part.pixel_stride * static_cast<std::ptrdiff_t>(whole.width);
    // rows that are not there may stand before the memory
    part.data =
        reinterpret_cast<void *>(reinterpret_cast<std::uintptr_t>(whole.data) + first * sample);
    part.channels = std::min(whole.channels - first, channels_each);
    return part;
}

std::vector<cm_image> parts_of(const cm_image *pictures, std::size_t count, std::uint32_t first)
{
    std::vector<cm_image> parts;
    for (std::size_t i = 0; i < count; ++i)
    {
        parts.push_back(part_of(pictures[i], first));
    }
    return parts;
}

} // namespace

ChannelGroups::ChannelGroups(const cm_plan &plan, const cm_image *pictures,
                             std::size_t picture_count, cm_pixel_type type, int threads,
                             MemoryCeiling &ceiling)
{
    for (std::uint32_t first = 0; first < pictures->channels; first += channels_each)
    {
        const std::vector<cm_image> parts = parts_of(pictures, picture_count, first);
        cm_source *made = nullptr;
        const cm_status status =
            cm_source_create(&plan, parts.data(), type, static_cast<unsigned>(threads), &made);
        ceiling.rethrow();
        check_resampling(status);
        groups.emplace_back(made);
    }
}

void ChannelGroups::resample(const cm_plan &plan, const std::vector<cm_image> &to,
                             const cm_rows &rows, int threads) const
{
    for (std::size_t i = 0; i < groups.size(); ++i)
    {
        std::vector<cm_image> parts =
            parts_of(to.data(), to.size(), static_cast<std::uint32_t>(i) * channels_each);
        check_resampling(cm_resample_source(&plan, groups[i].get(), parts.data(), rows,
                                            static_cast<unsigned>(threads)));
    }
}
