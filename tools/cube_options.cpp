// SPDX-License-Identifier: MIT

#include "cube_options.hpp"

namespace
{

const std::vector<std::string> layout_words = {"faces", "strip", "cross"};

} // namespace

CubeLayout read_layout(ArgumentReader &reader)
{
    return static_cast<CubeLayout>(reader.word(layout_words));
}

const cm_frame *read_frame(ArgumentReader &reader)
{
    std::vector<std::string> names;
    for (std::size_t i = 0; i < cm_frame_count(); ++i)
    {
        names.emplace_back(cm_frame_at(i)->identifier);
    }
    return cm_frame_at(reader.word(names));
}

const char *layout_name(CubeLayout layout)
{
    return layout_words[static_cast<std::size_t>(layout)].c_str();
}
