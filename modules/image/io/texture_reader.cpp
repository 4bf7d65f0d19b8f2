// SPDX-License-Identifier: MIT
//
// Textures among the image files: each face is a picture.

#include "image_reader.hpp"
#include "opened_file.hpp"
#include "texture_file.h"

#include <cstring>
#include <vector>

#include <OpenImageIO/imageio.h>

namespace
{

void seek_file(void *context, std::int64_t position)
{
    fseeko(static_cast<std::FILE *>(context), position, SEEK_SET);
}

std::size_t size_of_file(void *context)
{
    std::FILE *const file = static_cast<std::FILE *>(context);
    fseeko(file, 0, SEEK_END);
    const off_t size = ftello(file);
    return size > 0 ? static_cast<std::size_t>(size) : 0;
}

// As in Exif, for rows from above or below, and columns from the left or the right.
std::uint32_t orientation_of(const cm_texture &texture)
{
    const bool left = texture.orientation[0] == 'l';
    const bool up = texture.orientation[1] == 'u';
    return up ? (left ? 3 : 4) : (left ? 2 : 1);
}

class TextureReader final : public cm_image_reader
{
public:
    TextureReader(FilePointer opened, const cm_texture &read, std::uint32_t which);
    void read(const cm_image_region &region, cm_pixel_type type, char *pixels,
              std::ptrdiff_t row_stride) override;

private:
    void load();

    FilePointer file;
    cm_texture texture;
    std::vector<char> face; // of the file's type
    std::vector<cm_image_tag> tags;
};

constexpr const char *channel_names[] = {"R", "G", "B", "A"};

TextureReader::TextureReader(FilePointer opened, const cm_texture &read, std::uint32_t which)
    : file(std::move(opened)), texture(read)
{
    if (which >= texture.faces)
    {
        throw ImageFailure("has no picture " + std::to_string(which) + "; it has " +
                               std::to_string(texture.faces) + ", from 0",
                           CM_ERROR_ARGUMENT);
    }
    description.format = texture.container == CM_TEXTURE_DDS ? "dds" : "ktx2";
    description.width = description.window_width = texture.width;
    description.height = description.window_height = texture.height;
    description.channels = 4;
    description.channel_names = channel_names;
    description.type = cm_texture_type(texture.format);
    description.stored_type = type_of(description.type).c_str();
    description.whole_numbers = description.type == CM_PIXEL_U8 || description.type == CM_PIXEL_U16;
    description.alpha = 3;
    description.alpha_multiplied = texture.alpha_multiplied != 0;
    // plain bytes are what their writer took them for
    description.color = texture.format == CM_TEXTURE_RGBA8        ? CM_IMAGE_COLOR_UNKNOWN
                        : texture.format == CM_TEXTURE_RGBA8_SRGB ? CM_IMAGE_COLOR_SRGB
                                                                  : CM_IMAGE_COLOR_LINEAR;
    description.orientation = orientation_of(texture);
    description.subimage = which;
    description.subimage_count = texture.faces;
    if (texture.surface[0] != '\0')
    {
        tags.push_back({"cubemap:surface", texture.surface, nullptr, nullptr, 0});
    }
    if (texture.rotation[0] != '\0')
    {
        tags.push_back({"cubemap:rotation", texture.rotation, nullptr, nullptr, 0});
    }
    description.tags = tags.data();
    description.tag_count = tags.size();
}

// Faces are read whole, once.
void TextureReader::load()
{
    if (!face.empty())
    {
        return;
    }
    const std::size_t texel = 4 * static_cast<std::size_t>(size_of(description.type));
    const cm_image_stream stream = {file.get(), read_file, nullptr, seek_file, size_of_file};
    char message[CM_IMAGE_MESSAGE] = "";
    std::vector<char> loaded(texel * texture.width * texture.height);
    if (cm_texture_read(&stream, &texture, 0, description.subimage, loaded.data(), 0, message) !=
        CM_OK)
    {
        throw ImageFailure(message);
    }
    face = std::move(loaded);
}

void TextureReader::read(const cm_image_region &region, cm_pixel_type type, char *pixels,
                         std::ptrdiff_t row_stride)
{
    load();
    const std::ptrdiff_t texel = 4 * size_of(description.type);
    const std::ptrdiff_t row = texel * static_cast<std::ptrdiff_t>(texture.width);
    const char *const first = face.data() + static_cast<std::ptrdiff_t>(region.y0) * row +
                              static_cast<std::ptrdiff_t>(region.x0) * texel;
    if (!OIIO::convert_image(4, static_cast<int>(region.x1 - region.x0),
                             static_cast<int>(region.y1 - region.y0), 1, first,
                             type_of(description.type), texel, row, OIIO::AutoStride, pixels,
                             type_of(type), 4 * size_of(type), row_stride, OIIO::AutoStride))
    {
        throw ImageFailure("cannot be read as pixels of another type");
    }
}

} // namespace

// What of DDS is not read here, compressed texels and what is older than Direct3D 10, may be read by others.
ReaderPointer open_texture(const std::string &path, std::uint32_t which)
{
    char begin[4] = "";
    FilePointer file(std::fopen(path.c_str(), "rb"));
    if (!file || std::fread(begin, 1, sizeof begin, file.get()) != sizeof begin ||
        (std::memcmp(begin, "DDS ", 4) != 0 && std::memcmp(begin, "\xabKTX", 4) != 0))
    {
        return nullptr;
    }
    const cm_image_stream stream = {file.get(), read_file, nullptr, seek_file, size_of_file};
    cm_texture texture = {};
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_status status = cm_texture_open(&stream, &texture, message);
    if (status != CM_OK && begin[0] == 'D')
    {
        return nullptr;
    }
    if (status != CM_OK)
    {
        throw ImageFailure(message, status);
    }
    return std::make_unique<TextureReader>(std::move(file), texture, which);
}
