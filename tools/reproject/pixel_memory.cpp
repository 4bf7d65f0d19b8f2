// SPDX-License-Identifier: MIT

#include "pixel_memory.hpp"
#include "large_pages.hpp"
#include "memory_ceiling.hpp"

#include <cstdlib>

PixelMemory::PixelMemory(std::size_t size) : memory(allocate_pages(size))
{
}

PixelMemory::PixelMemory(MemoryCeiling &ceiling, std::size_t size, const std::string &what,
                         const std::string &kept)
    : memory(ceiling.allocate(size, what, kept), Deleter(&ceiling, size))
{
}

void PixelMemory::Deleter::operator()(void *owned) const noexcept
{
    if (ceiling != nullptr)
    {
        ceiling->release(owned, size);
    }
    else
    {
        std::free(owned);
    }
}
