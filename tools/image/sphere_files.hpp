// SPDX-License-Identifier: MIT
//
// Pictures of the sphere in files: finds out what they are, by the command line, by what the files say of themselves, or by
// their shape. Several files are six faces.

#ifndef CUBEMAP_TOOLS_SPHERE_FILES_HPP
#define CUBEMAP_TOOLS_SPHERE_FILES_HPP

#include "surface_options.hpp"
#include "surface_tags.hpp"
#include "surface_text.hpp"
#include "tools/cli/image_file.hpp"

#include <optional>
#include <string>
#include <vector>

struct SphereOptions
{
    std::string name; // of the file, or of six with %f
    SurfaceOptions from;
    std::string other_frame;       // of a cube of which nobody says the frame; "": geo
    std::string option = "--from"; // which says from.specification, for messages
    // For a comparison: a raster that only GDAL can place is left as it is until open_placed(), and what the command line
    // says counts without a word.
    bool as_it_stands = false;
};

class SphereFiles
{
public:
    // Opens the files, unless they are given. Failure if they are not there, not images, or are no six faces. threads as for
    // ImageFile.
    SphereFiles(SphereOptions options, int threads, std::vector<ImageFile> opened = {});

    // Opens by GDAL, before anything is read, what only that can place on the sphere. Failure if it cannot.
    void open_placed();

    // To be called once. Failure if they are not of the shape that they should have, or nobody knows what they are.
    void find_surface();

    // Does the command line say what they are, or do the files?
    bool is_told() const;

    // Behind find_surface().
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
    // To read them.
    std::vector<ImageFile> &files() noexcept
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

    // The caller takes the files as this, which is not turned: a warning if they say otherwise.
    void take_as(const cm_surface &surface);

    // Lines for people about what is not as it seems.
    const std::vector<std::string> &warnings() const noexcept
    {
        return remarks;
    }

    // "equirect 2048x1024, 3 channels, uint8"
    std::string description() const;

private:
    void open(int threads);
    void open_parts(bool may_be_faces);
    void check_faces() const;
    void check_tags() const;
    void choose_type();
    std::optional<SavedSurface> saved_beside() const;
    std::optional<SavedSurface> find_saved();
    void tell_ignored();
    std::string says(const SavedSurface &saved) const;
    std::optional<std::string> find_place(const std::optional<SavedSurface> &saved) const;
    bool is_there(const SavedSurface &saved, const std::string &place) const;
    bool is_elsewhere(const SavedSurface &saved, const std::string &place);
    bool take_saved(const SavedSurface &saved, bool is_placed);
    void take(const std::string &specification, const std::optional<cm_rotation> &rotation);
    void compare_with(const SavedSurface &saved, const cm_surface &taken,
                      const std::optional<cm_rotation> &rotation);
    std::string cube_by_shape() const;
    std::string layout_by_shape() const;

    SphereOptions asked;
    std::vector<ImageFile> images;
    ImageDescription pixels;
    std::string types; // of pixels, for people
    bool faces = false;
    bool texture = false; // whose format says how faces are
    SurfacePointer sphere;
    std::optional<cm_rotation> turned;
    std::vector<std::string> remarks;
};

#endif
