// SPDX-License-Identifier: MIT
//
// A folder of HiPS tiles, as sky viewers read them: IVOA Recommendation "HiPS - Hierarchical Progressive Survey", version
// 1.0, section 4.

#ifndef CUBEMAP_TOOLS_HIPS_OUTPUT_HPP
#define CUBEMAP_TOOLS_HIPS_OUTPUT_HPP

#include "reproject_options.hpp"
#include "tools/image/surface_text.hpp"
#include "work_folder.hpp"
#include "tools/cli/image_format.hpp"
#include "tools/cli/temporary_guard.hpp"
#include "modules/image/io/hips.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

// Does the name end as that of a folder?
bool is_hips_name(const std::string &path);

// OUTPUT as tiles, as far as the command line does not say it. UsageFailure if it says what tiles cannot be.
void take_hips_rules(Options &options);

// A surface with the pixels of the tiles, from the one that OUTPUT has without them; else that one.
SurfacePointer hips_surface(const Options &options, SurfacePointer wanted);

// What tiles of such an image are: "png", "jpeg" or "fits". UsageFailure if it cannot be what the command line says.
std::string hips_format(const Options &options, const ImageDescription &source);
void plan_hips(ImagePlan &plan);

class HipsOutput
{
public:
    // Fills dense pixels of a window, in the rows of its plane.
    using Render = std::function<void(const cm_hips_window &, unsigned char *)>;

    // Tiles are made in a folder beside the one that is to be, or in `work`, where it stays until it is complete; NULL:
    // there is none. Failure if that cannot be, or is there already. kind has the type and the channels of pixels; of those,
    // alpha is opacity, -1: none is.
    HipsOutput(const Options &options, const cm_surface &surface, const ImagePlan &plan,
               const cm_image &kind, int alpha, WorkFolder *work);
    // Removes it unless appear() was called, or it is in `work`.
    ~HipsOutput();
    HipsOutput(const HipsOutput &) = delete;
    HipsOutput &operator=(const HipsOutput &) = delete;

    // Makes the folder, all tiles, the previews and the properties, and the folder gets its name.
    void write(const Render &render, int threads);

    std::string description() const;

private:
    using Pixels = std::vector<unsigned char>;

    Pixels make_tile(std::uint32_t level, std::uint64_t number, const Render &render);
    void add_quarter(const cm_hips_window &parent, std::uint32_t level, std::uint64_t child,
                     const Pixels &from, Pixels &to) const;
    void write_tile(std::uint32_t level, std::uint64_t number, Pixels &pixels);
    void preview_tile(std::uint64_t number, Pixels &pixels);
    std::uint32_t sum_of_tiles(std::uint32_t level, std::uint64_t number) const;
    void store_tiles(std::uint32_t level, std::uint64_t number, Pixels pixels);
    bool load_tiles(std::uint32_t level, std::uint64_t number, Pixels &pixels);
    std::string tile_path(std::uint32_t level, std::uint64_t number) const;
    void check_folder(const std::filesystem::path &path) const;
    void make_temporary(const std::filesystem::path &path);
    void write_picture(const std::string &name, const cm_image &picture) const;
    void write_preview();
    void write_properties();
    cm_image picture_of(Pixels &pixels, std::uint32_t width, std::uint32_t height) const;
    void appear();

    std::string name;                // as the user gave it, without a stroke at its end
    std::optional<SignalsHeld> held; // behind which the folder is gone, or has its name
    std::string temporary;           // in the same folder
    int descriptor = -1;             // of that, which is locked
    std::string creator_did;         // "": nobody says
    ImagePlan plan;
    WorkFolder *work; // where what is done is kept, if anywhere
    cm_pixel_type type;
    std::uint32_t channels;
    int weighing;        // the channel by which colours are weighed; -1: none
    std::uint32_t width; // of a tile
    std::uint32_t order = 0;
    std::uint32_t preview_order;
    std::uint32_t preview_width;
    std::uint32_t preview_columns = 0;
    std::uint32_t preview_rows = 0;
    Pixels preview;
};

#endif
