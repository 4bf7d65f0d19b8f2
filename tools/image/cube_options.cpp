// SPDX-License-Identifier: MIT

#include "cube_options.hpp"

#include <algorithm>

namespace
{

const std::vector<std::string> layout_words = {"faces", "strip", "cross"};

} // namespace

CubeLayout read_layout(ArgumentReader &reader)
{
    return static_cast<CubeLayout>(reader.word(layout_words));
}

CubeLayout read_layout(ArgumentReader &reader, PolarColumns &columns)
{
    const std::string option = reader.text();
    const std::string text = reader.value();
    const auto word = std::find(layout_words.begin(), layout_words.end(), text);
    columns = {};
    if (word != layout_words.end())
    {
        return static_cast<CubeLayout>(word - layout_words.begin());
    }
    const std::string form = "cross:north=?,south=?";
    bool good = text.size() == form.size();
    for (std::size_t i = 0; good && i < form.size(); ++i)
    {
        good = form[i] == '?' ? text[i] >= '0' && text[i] <= '3' : text[i] == form[i];
    }
    if (!good)
    {
        throw UsageFailure(option + ": " + in_quotes(text) +
                           " is not faces, strip or cross, or cross:north=N,south=N with columns "
                           "from 0 to 3");
    }
    columns = {text[form.find('?')] - '0', text[form.rfind('?')] - '0'};
    return CubeLayout::cross;
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
