// SPDX-License-Identifier: MIT
//
// The input of cubemap-reproject: what it is, and its pixels.

#ifndef CUBEMAP_TOOLS_REPROJECT_INPUT_HPP
#define CUBEMAP_TOOLS_REPROJECT_INPUT_HPP

#include "memory_ceiling.hpp"
#include "pixel_memory.hpp"
#include "reproject_options.hpp"
#include "tools/image/sphere_files.hpp"
#include "work_folder.hpp"

#include <string>
#include <vector>

// How many values of floats are so; of others none.
struct ValueCounts
{
    std::int64_t not_finite = 0;
    std::int64_t below_zero = 0; // and finite
    std::int64_t above_one = 0;  // and finite
    // Of these, the components of a vector, and those of them whose size is above 1: whole numbers cannot have them.
    std::int64_t components_below_zero = 0;
    std::int64_t components_above_one = 0;
    std::int64_t components_beyond_one = 0;
};

class Input : public SphereFiles
{
public:
    // Opens the files, unless they are given, and finds their surface. Failure if they are not there, not images, or not
    // of the shape that they should have. threads as for ImageFile.
    Input(const Options &options, int threads, std::vector<ImageFile> opened = {});

    // The pixels, in the type of description_of_pixels(), which lie where the ceiling has them and must not outlive it.
    // The progress is shown on terminal, if it is one. work: where pixels that lie in files are kept for another run, and
    // may be from an earlier one; NULL: nowhere. Failure if a file turns out to be damaged.
    void read(const Options &options, int threads, MemoryCeiling &ceiling, std::FILE *terminal,
              WorkFolder *work = nullptr);

    // Of the surface, after read().
    const cm_image *pictures() const noexcept
    {
        return views.data();
    }
    // After read().
    const ValueCounts &values() const noexcept
    {
        return counts;
    }

private:
    std::size_t picture_bytes() const;
    std::vector<bool> allocate(MemoryCeiling &ceiling, WorkFolder *work);
    void read_files(int threads, MemoryCeiling &ceiling, std::FILE *terminal,
                    const std::vector<bool> &there);
    void count_all(int vector, int threads);
    [[noreturn]] void refuse_not_finite() const;

    std::vector<PixelMemory> memory;
    std::vector<cm_image> views;
    ValueCounts counts;
};

#endif
