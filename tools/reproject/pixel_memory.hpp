// SPDX-License-Identifier: MIT
//
// Memory for the pixels of whole pictures.

#ifndef CUBEMAP_TOOLS_PIXEL_MEMORY_HPP
#define CUBEMAP_TOOLS_PIXEL_MEMORY_HPP

#include <cstddef>
#include <memory>
#include <string>

class MemoryCeiling;

class PixelMemory
{
public:
    PixelMemory() = default;
    // Bytes of any value, aligned for any vector. std::bad_alloc if there is not enough memory.
    explicit PixelMemory(std::size_t size);
    // Those of a ceiling, which must outlive them.
    PixelMemory(MemoryCeiling &ceiling, std::size_t size, const std::string &what,
                const std::string &kept = "");

    unsigned char *bytes() const noexcept
    {
        return static_cast<unsigned char *>(memory.get());
    }

private:
    class Deleter
    {
    public:
        Deleter() noexcept
        {
        }
        Deleter(MemoryCeiling *of, std::size_t bytes) noexcept : ceiling(of), size(bytes)
        {
        }
        void operator()(void *owned) const noexcept;

    private:
        MemoryCeiling *ceiling = nullptr; // none: std::free
        std::size_t size = 0;
    };
    std::unique_ptr<void, Deleter> memory;
};

#endif
