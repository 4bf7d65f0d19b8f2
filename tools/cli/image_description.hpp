// SPDX-License-Identifier: MIT
//
// What an image file says of itself, or is to say: a copy that does not need the file.

#ifndef CUBEMAP_TOOLS_IMAGE_DESCRIPTION_HPP
#define CUBEMAP_TOOLS_IMAGE_DESCRIPTION_HPP

#include "modules/image/io/image_io.h"

#include <string>
#include <vector>

// cm_image_tag with its own memory.
struct ImageTag
{
    std::string key;
    std::string text;
    std::string type;               // "" : text is the value
    std::vector<char> data;         // unless the type is of strings
    std::vector<std::string> words; // of those
};

// cm_image_description with its own memory, without the picture's place and size.
struct ImageDescription
{
    ImageDescription() = default;
    ImageDescription(int channel_count, cm_pixel_type pixel_type)
        : type(pixel_type), channels(channel_count)
    {
    }
    explicit ImageDescription(const cm_image_description &from);

    // A tag with a text; instead of one of that name, if there is one.
    void set(const std::string &key, const std::string &text);
    void set_number(const std::string &key, int number);

    cm_pixel_type type = CM_PIXEL_U8;
    std::string stored_type; // "": that of type
    int channels = 0;
    std::vector<std::string> channel_names; // none: the usual ones
    int alpha = -1;
    bool alpha_multiplied = true;
    cm_image_color color = CM_IMAGE_COLOR_UNKNOWN;
    std::string compression; // "": the format's own
    std::vector<ImageTag> tags;
};

// The same in the words of C: lives no longer than what it is made from, which must not change.
class DescriptionView
{
public:
    // parts: the names of the file's pictures, if it has several.
    DescriptionView(const ImageDescription &from, const std::string &format, int width, int height,
                    const std::vector<std::string> &parts = {});
    DescriptionView(const DescriptionView &) = delete;
    DescriptionView &operator=(const DescriptionView &) = delete;

    const cm_image_description &get() const noexcept
    {
        return view;
    }

private:
    cm_image_description view = {};
    std::vector<const char *> names;
    std::vector<const char *> part_names;
    std::vector<std::vector<const char *>> words;
    std::vector<cm_image_tag> tags;
};

#endif
