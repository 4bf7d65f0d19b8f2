// SPDX-License-Identifier: MIT

#include "cube_options.hpp"

#include "cube_table.h"

#include <cstring>

CubeLayout read_layout(OptionReader &reader, PolarColumns &columns)
{
    const std::string text = reader.text();
    columns = {};
    for (std::size_t i = 0; cm_layout_names[i] != nullptr; ++i)
    {
        if (text == cm_layout_names[i])
        {
            return static_cast<CubeLayout>(i);
        }
    }
    const std::string form = "cross:north=?,south=?";
    bool good = text.size() == form.size();
    for (std::size_t i = 0; good && i < form.size(); ++i)
    {
        good = form[i] == '?' ? text[i] >= '0' && text[i] <= '3' : text[i] == form[i];
    }
    if (!good)
    {
        cm_nearest nearest = cm_nearest_to(text.c_str(), text.size());
        for (const char *const *name = cm_layout_names; *name != nullptr; ++name)
        {
            cm_nearest_try(&nearest, *name, std::strlen(*name));
        }
        reader.refuse("faces, strip or cross, or cross:north=N,south=N with columns from 0 to 3" +
                      suggestion(nearest));
    }
    columns = {text[form.find('?')] - '0', text[form.rfind('?')] - '0'};
    return CubeLayout::cross;
}

const char *layout_name(CubeLayout layout)
{
    return cm_layout_names[static_cast<std::size_t>(layout)];
}
