// SPDX-License-Identifier: MIT

#include "truth_file.h"

#include <cstdio>

#ifdef HAVE_OPENEXR

#include <cstring>
#include <new>
#include <string>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>

namespace
{

constexpr std::uint16_t half_one = 0x3c00;

// Bytes go where the caller says; what it does not take ends the writing.
class StreamOfImage : public Imf::OStream
{
public:
    explicit StreamOfImage(const cm_image_stream &to) : OStream("the stream"), stream(to)
    {
    }

    void write(const char *bytes, int count) override
    {
        const auto size = static_cast<std::size_t>(count);
        if (stream.write(stream.context, bytes, size) != size)
        {
            throw std::runtime_error("not all bytes of the truth could be written");
        }
        at += size;
    }
    std::uint64_t tellp() override
    {
        return at;
    }
    void seekp(std::uint64_t place) override
    {
        stream.seek(stream.context, static_cast<std::int64_t>(place));
        at = place;
    }

private:
    const cm_image_stream &stream;
    std::uint64_t at = 0;
};

struct TruthChannel
{
    const char *name;
    Imf::PixelType type;
    const void *values;
};

struct TruthPart
{
    const char *name;
    std::vector<TruthChannel> channels;
};

// The parts, and what had to be made for them.
class TruthParts
{
public:
    TruthParts(std::size_t count, const cm_tof_truth &truth, const std::uint8_t *flags)
        : pixels(count)
    {
        add_position(truth.position);
        add_three("normal", truth.normal);
        add_one("object", Imf::UINT, truth.object);
        add_one("shape", Imf::UINT, truth.shape);
        add_one("triangle", Imf::UINT, truth.triangle);
        add_one("depth", Imf::FLOAT, truth.depth);
        add_one("range", Imf::FLOAT, truth.range);
        add_three("flow_next", truth.flow_next);
        add_three("flow_before", truth.flow_before);
        add_effects(flags);
    }
    const std::vector<TruthPart> &all() const noexcept
    {
        return parts;
    }

private:
    void add(TruthPart &&part)
    {
        if (!part.channels.empty())
        {
            parts.push_back(std::move(part));
        }
    }
    void add_one(const char *name, Imf::PixelType type, const void *values)
    {
        if (values != nullptr)
        {
            add({name, {{"Y", type, values}}});
        }
    }
    void add_three(const char *name, float *const *values)
    {
        TruthPart part = {name, {}};
        for (int k = 0; k < 3; ++k)
        {
            if (values[k] != nullptr)
            {
                part.channels.push_back({axes[k], Imf::FLOAT, values[k]});
            }
        }
        add(std::move(part));
    }
    void add_position(double *const *values)
    {
        TruthPart part = {"position", {}};
        for (int k = 0; k < 3; ++k)
        {
            if (values[k] != nullptr)
            {
                position[k].assign(values[k], values[k] + pixels);
                part.channels.push_back({axes[k], Imf::FLOAT, position[k].data()});
            }
        }
        add(std::move(part));
    }
    void add_effects(const std::uint8_t *flags)
    {
        struct NamedEffect
        {
            const char *name;
            unsigned flag;
        };
        static constexpr NamedEffect effects[] = {{"flying", CM_TOF_FLYING},
                                                  {"motion", CM_TOF_MOTION},
                                                  {"multipath", CM_TOF_MULTIPATH},
                                                  {"nothing", CM_TOF_NOTHING},
                                                  {"saturated", CM_TOF_SATURATED}};
        TruthPart part = {"effects", {}};
        for (const NamedEffect &effect : effects)
        {
            if (flags != nullptr)
            {
                masks.emplace_back(pixels);
                for (std::size_t i = 0; i < pixels; ++i)
                {
                    masks.back()[i] = (flags[i] & effect.flag) != 0 ? half_one : std::uint16_t{0};
                }
                part.channels.push_back({effect.name, Imf::HALF, masks.back().data()});
            }
        }
        add(std::move(part));
    }

    static constexpr const char *axes[3] = {"X", "Y", "Z"};
    std::size_t pixels;
    std::vector<float> position[3];
    std::vector<std::vector<std::uint16_t>> masks;
    std::vector<TruthPart> parts;
};

std::size_t bytes_of(Imf::PixelType type)
{
    return type == Imf::HALF ? 2 : 4;
}

Imf::Header header_of(const TruthPart &part, int width, int height)
{
    Imf::Header header(width, height);
    header.setName(part.name);
    header.setType(Imf::SCANLINEIMAGE);
    header.compression() =
        part.channels.front().type == Imf::FLOAT ? Imf::NO_COMPRESSION : Imf::RLE_COMPRESSION;
    for (const TruthChannel &channel : part.channels)
    {
        header.channels().insert(channel.name, Imf::Channel(channel.type));
    }
    return header;
}

void write_part(Imf::MultiPartOutputFile &file, int index, const TruthPart &part, int width,
                int height)
{
    Imf::FrameBuffer buffer;
    for (const TruthChannel &channel : part.channels)
    {
        const std::size_t bytes = bytes_of(channel.type);
        // the library takes what it reads as what it might write
        char *const values = const_cast<char *>(static_cast<const char *>(channel.values));
        buffer.insert(channel.name, Imf::Slice(channel.type, values, bytes,
                                               bytes * static_cast<std::size_t>(width)));
    }
    Imf::OutputPart output(file, index);
    output.setFrameBuffer(buffer);
    output.writePixels(height);
}

void write_parts(const cm_image_stream &stream, int width, int height,
                 const std::vector<TruthPart> &parts)
{
    std::vector<Imf::Header> headers;
    for (const TruthPart &part : parts)
    {
        headers.push_back(header_of(part, width, height));
    }
    StreamOfImage to(stream);
    Imf::MultiPartOutputFile file(to, headers.data(), static_cast<int>(headers.size()));
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
        write_part(file, static_cast<int>(i), parts[i], width, height);
    }
}

} // namespace

#endif

namespace
{

cm_status fail_truth(cm_status status, const char *what, char *message)
{
    if (message != nullptr)
    {
        std::snprintf(message, CM_IMAGE_MESSAGE, "%s", what);
    }
    return status;
}

} // namespace

cm_status cm_truth_file_write(const cm_image_stream *stream, uint32_t width, uint32_t height,
                              const cm_tof_truth *truth, const uint8_t *flags, char *message)
{
    if (stream == nullptr || truth == nullptr || truth->size != sizeof *truth || width == 0 ||
        height == 0 || width > INT32_MAX || height > INT32_MAX)
    {
        return fail_truth(CM_ERROR_ARGUMENT, cm_status_text(CM_ERROR_ARGUMENT), message);
    }
#ifdef HAVE_OPENEXR
    try
    {
        const TruthParts parts(std::size_t{width} * height, *truth, flags);
        if (parts.all().empty())
        {
            return fail_truth(CM_ERROR_ARGUMENT, "there is no truth to write", message);
        }
        write_parts(*stream, static_cast<int>(width), static_cast<int>(height), parts.all());
        return CM_OK;
    }
    catch (const std::bad_alloc &)
    {
        return fail_truth(CM_ERROR_MEMORY, "more memory is needed than there is", message);
    }
    catch (const std::exception &failure)
    {
        return fail_truth(CM_ERROR_FILE, failure.what(), message);
    }
#else
    (void)flags;
    return fail_truth(CM_ERROR_UNSUPPORTED, "this was built without OpenEXR, which truth needs",
                      message);
#endif
}
