// SPDX-License-Identifier: MIT
//
// Memory of the system for whole pictures.

#ifndef CUBEMAP_TOOLS_LARGE_PAGES_HPP
#define CUBEMAP_TOOLS_LARGE_PAGES_HPP

#include <cstddef>

// Bytes of any value, aligned for any vector, for std::free. std::bad_alloc if there is not enough memory.
void *allocate_pages(std::size_t size);

#endif
