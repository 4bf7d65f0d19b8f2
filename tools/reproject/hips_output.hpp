// SPDX-License-Identifier: MIT
//
// A folder of HiPS tiles, as sky viewers read them: IVOA Recommendation "HiPS - Hierarchical Progressive Survey", version
// 1.0, section 4.

#ifndef CUBEMAP_TOOLS_HIPS_OUTPUT_HPP
#define CUBEMAP_TOOLS_HIPS_OUTPUT_HPP

#include "reproject_options.hpp"
#include "surface_text.hpp"
#include "tools/cli/image_format.hpp"
#include "modules/image/io/hips.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

// Does the name end as that of a folder?
bool is_hips_name(const std::string &path);

// OUTPUT as tiles, as far as the command line does not say it. UsageFailure if it says what tiles cannot be.
void take_hips_rules(Options &options);

// A surface with the pixels of the tiles, from the one that OUTPUT has without them; else that one.
SurfacePointer hips_surface(const Options &options, SurfacePointer wanted);

// What tiles of such an image are: "png", or "fits" for one channel that is not of bytes.
std::string hips_format(const ImageDescription &source);
void plan_hips(ImagePlan &plan);

class HipsOutput
{
public:
    // Fills dense pixels of a window, in the rows of its plane.
    using Render = std::function<void(const cm_hips_window &, unsigned char *)>;

    // Makes a folder beside the one that is to be. Failure if that cannot be, or is there already.
    HipsOutput(const Options &options, const cm_surface &surface, const ImagePlan &plan,
               cm_pixel_type type, int channels);
    // Removes it unless appear() was called.
    ~HipsOutput();
    HipsOutput(const HipsOutput &) = delete;
    HipsOutput &operator=(const HipsOutput &) = delete;

    // All tiles, the previews and the properties, and the folder gets its name.
    void write(const Render &render, int threads);

    std::string description() const;

private:
    using Pixels = std::vector<unsigned char>;

    Pixels make_tile(std::uint32_t level, std::uint64_t number, const Render &render);
    void add_quarter(const cm_hips_window &parent, std::uint32_t level, std::uint64_t child,
                     const Pixels &from, Pixels &to) const;
    void write_tile(std::uint32_t level, std::uint64_t number, Pixels &pixels);
    void add_to_preview(std::uint64_t number, const cm_image &tile);
    void write_picture(const std::string &name, const cm_image &picture) const;
    void write_preview();
    void write_properties();
    cm_image picture_of(Pixels &pixels, std::uint32_t width, std::uint32_t height) const;
    void appear();

    std::string name;      // as the user gave it, without a stroke at its end
    std::string temporary; // in the same folder
    ImagePlan plan;
    cm_pixel_type type;
    std::uint32_t channels;
    std::uint32_t width; // of a tile
    std::uint32_t order = 0;
    std::uint32_t preview_order;
    std::uint32_t preview_width;
    std::uint32_t preview_columns = 0;
    std::uint32_t preview_rows = 0;
    Pixels preview;
};

#endif
