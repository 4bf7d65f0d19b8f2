// SPDX-License-Identifier: MIT

#include "work_manifest.hpp"
#include "tools/image/json_text.hpp"
#include "tools/cli/program.hpp"

#include <cubemap/version.h>

#include <cstdio>

#include <sys/stat.h>

namespace
{

std::string indented(const std::string &name, const std::string &value)
{
    return "  " + quoted(name) + ": " + value;
}

// Elements on lines of their own.
std::string list_of(const std::vector<std::string> &elements)
{
    std::string text;
    for (const std::string &element : elements)
    {
        text += (text.empty() ? "\n    " : ",\n    ") + element;
    }
    return "[" + text + (text.empty() ? "]" : "\n  ]");
}

// When a file was changed, in seconds since 1970.
std::string time_text(const struct stat &status)
{
#if defined(__APPLE__)
    const struct timespec &time = status.st_mtimespec;
#else
    const struct timespec &time = status.st_mtim;
#endif
    char text[60];
    std::snprintf(text, sizeof text, "%lld.%09ld", static_cast<long long>(time.tv_sec),
                  time.tv_nsec);
    return text;
}

std::string input_text(const std::string &name)
{
    struct stat status = {};
    if (stat(name.c_str(), &status) != 0)
    {
        throw Failure(in_quotes(name) + " is no longer there");
    }
    return "{\"name\": " + quoted(name) + ", \"bytes\": " + std::to_string(status.st_size) +
           ", \"modified\": " + time_text(status) + "}";
}

std::string picture_text(const MadePicture &picture)
{
    char checksum[20];
    std::snprintf(checksum, sizeof checksum, "%08lx",
                  static_cast<unsigned long>(picture.sum.checksum));
    return "{\"name\": " + quoted(picture.name) +
           ", \"bytes\": " + std::to_string(picture.sum.bytes) +
           ", \"crc32\": " + quoted(checksum) + "}";
}

// Members apart by commas, without braces.
std::string members_of(const Options &options, const Input &input, const PictureKind &kind)
{
    std::vector<std::string> words;
    for (const std::string &word : options.words)
    {
        words.push_back(quoted(word));
    }
    std::vector<std::string> inputs;
    for (const ImageFile &image : input.files())
    {
        inputs.push_back(input_text(image.path()));
    }
    return indented("program", quoted("cubemap-reproject " CM_VERSION_STRING)) + ",\n" +
           indented("arguments", list_of(words)) + ",\n" + indented("inputs", list_of(inputs)) +
           ",\n" + indented("surface", quoted(kind.surface)) + ",\n" +
           indented("rotation", "[" + kind.rotation + "]") + ",\n" +
           indented("width", std::to_string(kind.width)) + ",\n" +
           indented("height", std::to_string(kind.height)) + ",\n" +
           indented("channels", std::to_string(kind.channels)) + ",\n" +
           indented("values", quoted(kind.type));
}

} // namespace

std::string work_identity(const Options &options, const Input &input, const PictureKind &kind)
{
    return "{\n" + members_of(options, input, kind) + "\n}\n";
}

std::string manifest_text(const Options &options, const Input &input, const PictureKind &kind,
                          const std::string &filter, const std::vector<MadePicture> &pictures)
{
    std::vector<std::string> outputs;
    for (const MadePicture &picture : pictures)
    {
        outputs.push_back(picture_text(picture));
    }
    return "{\n" + members_of(options, input, kind) + ",\n" + indented("filter", quoted(filter)) +
           ",\n" + indented("outputs", list_of(outputs)) + "\n}\n";
}
