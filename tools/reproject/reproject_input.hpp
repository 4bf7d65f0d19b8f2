// SPDX-License-Identifier: MIT
//
// The input of cubemap-reproject: finds out what it is, and reads it.

#ifndef CUBEMAP_TOOLS_REPROJECT_INPUT_HPP
#define CUBEMAP_TOOLS_REPROJECT_INPUT_HPP

#include "memory_ceiling.hpp"
#include "pixel_memory.hpp"
#include "reproject_options.hpp"
#include "surface_tags.hpp"
#include "work_folder.hpp"
#include "surface_text.hpp"

#include <string>
#include <vector>

class Input
{
public:
    // Opens the files, unless they are given. Failure if they are not there, not images, or not of the shape that
    // they should have. threads as for ImageFile.
    Input(const Options &options, int threads, std::vector<ImageFile> opened = {});

    const cm_surface &surface() const noexcept
    {
        return *sphere;
    }
    const std::optional<cm_rotation> &rotation() const noexcept
    {
        return turned;
    }
    const std::vector<ImageFile> &files() const noexcept
    {
        return images;
    }

    // What the files say of themselves; of six that differ in the type of their pixels, the deepest.
    const ImageDescription &description_of_pixels() const noexcept
    {
        return pixels;
    }

    // Do the files say where on Earth they are?
    bool is_georeferenced() const;

    // Lines for people about what is not as it seems.
    const std::vector<std::string> &warnings() const noexcept
    {
        return remarks;
    }

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
    // How many values are NaN or infinite, after read().
    std::int64_t not_finite() const noexcept
    {
        return bad_values;
    }

    // "equirect 2048x1024, 3 channels, uint8"
    std::string description() const;

private:
    void open(const Options &options, int threads);
    std::size_t picture_bytes() const;
    std::vector<bool> allocate(MemoryCeiling &ceiling, WorkFolder *work);
    void open_parts(const Options &options, bool may_be_faces);
    void check_faces() const;
    void check_tags() const;
    void choose_type();
    void find_surface(const Options &options);
    std::optional<SavedSurface> find_saved(const Options &options);
    std::string says(const SavedSurface &saved) const;
    std::optional<std::string> find_place(const std::optional<SavedSurface> &saved) const;
    bool is_there(const SavedSurface &saved, const std::string &place) const;
    bool is_elsewhere(const SavedSurface &saved, const std::string &place);
    bool take_saved(const SavedSurface &saved, const SurfaceOptions &options, bool is_placed);
    void take(const std::string &specification, const std::optional<cm_rotation> &rotation);
    void compare_with(const SavedSurface &saved);
    std::string cube_by_shape(const Options &options) const;
    std::string layout_by_shape(const Options &options) const;
    void read_files(int threads, MemoryCeiling &ceiling, std::FILE *terminal,
                    const std::vector<bool> &there);
    void count_not_finite(int threads);
    [[noreturn]] void refuse_not_finite() const;

    std::vector<ImageFile> images;
    ImageDescription pixels;
    std::string types; // of pixels, for people
    bool faces = false;
    bool texture = false; // whose format says how faces are
    SurfacePointer sphere;
    std::optional<cm_rotation> turned;
    std::vector<std::string> remarks;
    std::vector<PixelMemory> memory;
    std::vector<cm_image> views;
    std::int64_t bad_values = 0;
};

#endif
