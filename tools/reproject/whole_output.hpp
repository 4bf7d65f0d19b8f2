// SPDX-License-Identifier: MIT
//
// Outputs that are made of all pixels at once: textures, levels of less and less pixels, borders around faces.

#ifndef CUBEMAP_TOOLS_WHOLE_OUTPUT_HPP
#define CUBEMAP_TOOLS_WHOLE_OUTPUT_HPP

#include "memory_ceiling.hpp"
#include "reproject_options.hpp"
#include "tools/image/surface_text.hpp"
#include "tools/cli/atomic_file.hpp"
#include "tools/cli/image_format.hpp"

#include <cubemap/mips.h>

#include <memory>
#include <string>
#include <vector>

class WholeOutput
{
public:
    // From the surface that OUTPUT is to be; texture_format: "dds", "ktx2", or "" for other files. UsageFailure if there are no such levels or
    // borders.
    WholeOutput(const Options &options, SurfacePointer wanted, const std::string &texture_format);

    // Does OUTPUT need this class?
    bool is_needed() const noexcept
    {
        return texture || mips || border > 0;
    }

    // What is to be computed: the surface without borders.
    const cm_surface &computed() const noexcept
    {
        return inner ? *inner : *shown;
    }
    bool is_texture() const noexcept
    {
        return texture;
    }
    // What OUTPUT is.
    const cm_surface &surface() const noexcept
    {
        return *shown;
    }

    // The files, level by level, from those of the pictures.
    std::vector<std::string> file_names(const std::vector<std::string> &pictures) const;

    // The pictures of computed() and what becomes of them. values says what they are. georeferenced: is where they are
    // on Earth to be written? What is more than the pictures lies where the ceiling has it.
    void write(const std::vector<cm_image> &pictures, const ImagePlan &plan,
               const std::optional<cm_rotation> &rotation, const cm_plan_options &values,
               const std::vector<std::unique_ptr<AtomicFile>> &files,
               const std::vector<std::string> &names, bool georeferenced, int threads,
               MemoryCeiling &ceiling) const;

    // ", 10 levels", for people
    std::string description() const;

private:
    struct Level;

    std::uint32_t level_count() const;
    SurfacePointer level_of(const cm_surface &of, std::uint32_t level) const;
    Level make_level(const cm_mips *levels, const std::vector<cm_image> &pictures,
                     std::uint32_t level, cm_pixel_type type, const cm_plan_options &values,
                     int threads, MemoryCeiling &ceiling) const;
    void write_texture(const std::vector<Level> &levels, const ImagePlan &plan,
                       const std::optional<cm_rotation> &rotation, AtomicFile &file,
                       const std::string &name) const;

    SurfacePointer shown;
    SurfacePointer inner;  // if it is another
    std::string container; // of a texture
    bool texture = false;
    bool mips = false;
    std::uint32_t border = 0;
};

#endif
