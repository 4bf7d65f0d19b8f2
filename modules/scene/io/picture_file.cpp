// SPDX-License-Identifier: MIT

#include "picture_file.hpp"

#include "file_failure.hpp"
#include "npy_file.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>

namespace
{

const cm_image_io &pictures_io()
{
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_image_io *const io = cm_image_io_get(message);
    if (io == nullptr)
    {
        throw FileFailure(CM_ERROR_FILE, message);
    }
    return *io;
}

void check_picture_size(const std::string &path, const cm_camera_options &camera,
                        std::uint32_t width, std::uint32_t height)
{
    if (width != camera.width || height != camera.height)
    {
        fail_file(path, "is " + std::to_string(width) + " x " + std::to_string(height) +
                            " pixels; the camera has " + std::to_string(camera.width) + " x " +
                            std::to_string(camera.height));
    }
}

class OpenPicture
{
public:
    OpenPicture(const std::string &file, const cm_camera_options &camera)
        : path(file), io(pictures_io())
    {
        char message[CM_IMAGE_MESSAGE] = "";
        check(io.open(path.c_str(), 0, &reader, message), message);
        try
        {
            check_picture_size(path, camera, description().width, description().height);
            if (description().channels > CM_CHANNELS_MAX)
            {
                fail_file(path, "has more channels than a picture has");
            }
        }
        catch (...)
        {
            io.close(reader);
            throw;
        }
    }
    ~OpenPicture()
    {
        io.close(reader);
    }
    OpenPicture(const OpenPicture &) = delete;
    OpenPicture &operator=(const OpenPicture &) = delete;

    const cm_image_description &description() const
    {
        return *io.describe(reader);
    }
    void read(cm_pixel_type type, OwnPicture &picture)
    {
        const cm_image_description &all = description();
        picture.shape(all.width, all.height, all.channels, type);
        const cm_image_region whole = {0, 0, all.width, all.height};
        char message[CM_IMAGE_MESSAGE] = "";
        check(io.read(reader, &whole, type, picture.image.data, 0, message), message);
    }

private:
    void check(cm_status status, const char *message) const
    {
        if (status == CM_ERROR_MEMORY)
        {
            throw std::bad_alloc();
        }
        if (status != CM_OK)
        {
            throw FileFailure(CM_ERROR_DATA, path + " " + message);
        }
    }

    std::string path;
    const cm_image_io &io;
    cm_image_reader *reader = nullptr;
};

// In capitals, too.
bool ends_like(const std::string &path, std::string_view end)
{
    const auto is_like = [](char letter, unsigned char other)
    { return letter == static_cast<char>(std::tolower(other)); };
    return path.size() >= end.size() &&
           std::equal(end.rbegin(), end.rend(), path.rbegin(), is_like);
}

void read_npy_depth(const std::string &path, const cm_camera_options &camera, OwnPicture &picture)
{
    char message[CM_IMAGE_MESSAGE] = "";
    cm_image image = {};
    const cm_status status = cm_npy_read(path.c_str(), &image, message);
    if (status != CM_OK)
    {
        throw FileFailure(status, message);
    }
    const std::unique_ptr<void, decltype(&std::free)> data(image.data, std::free);
    check_picture_size(path, camera, image.width, image.height);
    picture.shape(image.width, image.height, 1, image.type);
    std::memcpy(picture.image.data, image.data, picture.bytes.size());
}

void check_there(const std::string &path)
{
    if (!file_is_there(path))
    {
        fail_file(path, "is not there", CM_ERROR_FILE);
    }
}

} // namespace

void read_depth(const std::string &path, const cm_camera_options &camera, OwnPicture &picture)
{
    check_there(path);
    if (ends_like(path, ".npy"))
    {
        read_npy_depth(path, camera, picture);
        return;
    }
    OpenPicture file(path, camera);
    const cm_image_description &all = file.description();
    if (all.channels != 1)
    {
        fail_file(path, "has " + std::to_string(all.channels) + " channels; depth has one");
    }
    const bool real = !all.whole_numbers;
    if (!real && all.type != CM_PIXEL_U16)
    {
        fail_file(path, std::string("has numbers of type ") +
                            (all.stored_type == nullptr ? "?" : all.stored_type) +
                            "; depth needs 16 bits or floating point");
    }
    file.read(real ? CM_PIXEL_FLOAT : CM_PIXEL_U16, picture);
}

void read_color(const std::string &path, const cm_camera_options &camera, OwnPicture &picture)
{
    check_there(path);
    OpenPicture file(path, camera);
    const cm_pixel_type type = file.description().type;
    file.read(type == CM_PIXEL_HALF ? CM_PIXEL_FLOAT : type, picture);
}

void write_picture(const std::string &path, const cm_image &image)
{
    const cm_image_io &io = pictures_io();
    cm_image_description description = {};
    description.format = "png";
    description.width = image.width;
    description.height = image.height;
    description.channels = image.channels;
    description.type = image.type == CM_PIXEL_U16 ? CM_PIXEL_U16 : CM_PIXEL_U8;
    description.alpha = image.channels == 2 || image.channels == 4
                            ? static_cast<std::int32_t>(image.channels) - 1
                            : -1;
    description.orientation = 1;
    char message[CM_IMAGE_MESSAGE] = "";
    cm_image_writer *writer = nullptr;
    cm_status status = io.create(path.c_str(), nullptr, &description, &writer, message);
    if (status == CM_OK)
    {
        status = io.write(writer, 0, image.height, image.type, image.data, image.pixel_stride,
                          image.row_stride, message);
    }
    if (status == CM_OK)
    {
        status = io.finish(writer, message);
    }
    io.drop(writer);
    if (status != CM_OK)
    {
        throw FileFailure(status == CM_ERROR_MEMORY ? status : CM_ERROR_FILE, path + " " + message);
    }
}
