// SPDX-License-Identifier: MIT

#include "image_description.hpp"

#include <algorithm>

namespace
{

ImageTag copy_of(const cm_image_tag &from)
{
    ImageTag tag;
    tag.key = from.key;
    tag.text = from.text;
    tag.type = from.type == nullptr ? "" : from.type;
    if (tag.type.rfind("string", 0) == 0)
    {
        const char *const *const begin = static_cast<const char *const *>(from.data);
        tag.words.assign(begin, begin + from.data_size / sizeof *begin);
    }
    else if (!tag.type.empty())
    {
        const char *const begin = static_cast<const char *>(from.data);
        tag.data.assign(begin, begin + from.data_size);
    }
    return tag;
}

} // namespace

ImageDescription::ImageDescription(const cm_image_description &from)
    : type(from.type), stored_type(from.stored_type), channels(static_cast<int>(from.channels)),
      channel_names(from.channel_names, from.channel_names + from.channels), alpha(from.alpha),
      alpha_multiplied(from.alpha_multiplied), color(from.color),
      compression(from.compression == nullptr ? "" : from.compression)
{
    for (std::size_t i = 0; i < from.tag_count; ++i)
    {
        tags.push_back(copy_of(from.tags[i]));
    }
}

void ImageDescription::set(const std::string &key, const std::string &text)
{
    const auto is_it = [&key](const ImageTag &tag) { return tag.key == key; };
    tags.erase(std::remove_if(tags.begin(), tags.end(), is_it), tags.end());
    ImageTag tag;
    tag.key = key;
    tag.text = text;
    tags.push_back(tag);
}

void ImageDescription::set_number(const std::string &key, int number)
{
    set(key, std::to_string(number));
    tags.back().type = "int";
    const char *const bytes = reinterpret_cast<const char *>(&number);
    tags.back().data.assign(bytes, bytes + sizeof number);
}

DescriptionView::DescriptionView(const ImageDescription &from, const std::string &format, int width,
                                 int height, const std::vector<std::string> &parts)
{
    view.format = format.c_str();
    view.width = static_cast<std::uint32_t>(width);
    view.height = static_cast<std::uint32_t>(height);
    view.channels = static_cast<std::uint32_t>(from.channels);
    view.type = from.type;
    view.stored_type = from.stored_type.empty() ? nullptr : from.stored_type.c_str();
    for (const std::string &name : from.channel_names)
    {
        names.push_back(name.c_str());
    }
    view.channel_names = names.empty() ? nullptr : names.data();
    view.alpha = from.alpha;
    view.alpha_multiplied = from.alpha_multiplied;
    view.color = from.color;
    view.compression = from.compression.empty() ? nullptr : from.compression.c_str();
    for (const ImageTag &tag : from.tags)
    {
        words.emplace_back();
        for (const std::string &word : tag.words)
        {
            words.back().push_back(word.c_str());
        }
        const bool is_text = tag.type.empty();
        const bool is_words = !tag.words.empty();
        tags.push_back({tag.key.c_str(), tag.text.c_str(), is_text ? nullptr : tag.type.c_str(),
                        is_words ? static_cast<const void *>(words.back().data()) : tag.data.data(),
                        is_words ? tag.words.size() * sizeof(const char *) : tag.data.size()});
    }
    for (const std::string &name : parts)
    {
        part_names.push_back(name.c_str());
    }
    view.part_names = part_names.empty() ? nullptr : part_names.data();
    view.part_count = static_cast<std::uint32_t>(part_names.size());
    view.tags = tags.data();
    view.tag_count = tags.size();
}
