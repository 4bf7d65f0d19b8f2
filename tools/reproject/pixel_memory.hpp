// SPDX-License-Identifier: MIT
//
// Memory for the pixels of whole pictures.

#ifndef CUBEMAP_TOOLS_PIXEL_MEMORY_HPP
#define CUBEMAP_TOOLS_PIXEL_MEMORY_HPP

#include <cstddef>
#include <memory>

class PixelMemory
{
public:
    PixelMemory() = default;
    // Bytes of any value, aligned for any vector. std::bad_alloc if there is not enough memory.
    explicit PixelMemory(std::size_t size);

    unsigned char *bytes() const noexcept
    {
        return static_cast<unsigned char *>(memory.get());
    }

private:
    struct Deleter
    {
        void operator()(void *owned) const noexcept;
    };
    std::unique_ptr<void, Deleter> memory;
};

#endif
