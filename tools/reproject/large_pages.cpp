// SPDX-License-Identifier: MIT

#include "large_pages.hpp"

#include <cstdint>
#include <cstdlib>
#include <new>

#include <sys/mman.h>

namespace
{

// Of large pages, of which a program touches fewer for the first time: that costs more than resampling.
constexpr std::size_t large_page = std::size_t{1} << 21;
constexpr std::size_t vector_bytes = 64;

} // namespace

void *allocate_pages(std::size_t size)
{
    const std::size_t alignment = size >= large_page ? large_page : vector_bytes;
    if (size > SIZE_MAX - alignment)
    {
        throw std::bad_alloc();
    }
    const std::size_t whole = (size / alignment + 1) * alignment;
    void *const pointer = std::aligned_alloc(alignment, whole);
    if (pointer == nullptr)
    {
        throw std::bad_alloc();
    }
#if defined(MADV_HUGEPAGE)
    if (alignment == large_page)
    {
        madvise(pointer, whole - large_page, MADV_HUGEPAGE); // only faster
    }
#endif
    return pointer;
}
