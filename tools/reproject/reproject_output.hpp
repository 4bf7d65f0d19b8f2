// SPDX-License-Identifier: MIT
//
// The output of cubemap-reproject: plans it, computes and writes it.

#ifndef CUBEMAP_TOOLS_REPROJECT_OUTPUT_HPP
#define CUBEMAP_TOOLS_REPROJECT_OUTPUT_HPP

#include "band_queue.hpp"
#include "color_rows.hpp"
#include "hips_output.hpp"
#include "kept_plan.hpp"
#include "output_render.hpp"
#include "pixel_memory.hpp"
#include "plane_place.hpp"
#include "reproject_input.hpp"
#include "surface_lines.hpp"
#include "whole_output.hpp"
#include "work_folder.hpp"
#include "work_manifest.hpp"
#include "tools/cli/image_writer.hpp"
#include "tools/cli/progress.hpp"

class Output
{
public:
    // Decides on all and makes the files, under temporary names. UsageFailure or Failure if that
    // cannot be done.
    Output(const Options &options, const Input &input);

    // Computes and writes the files, and lets them appear. What the filter needs lies where the ceiling has it. The
    // progress is shown on terminal, if it is one. plan is made, unless it is that of pictures like these.
    void write(const Options &options, const Input &input, int threads, MemoryCeiling &ceiling,
               std::FILE *terminal, KeptPlan &plan);

    // Where what is done is kept; NULL: nowhere.
    WorkFolder *kept_work() const noexcept
    {
        return work.get();
    }

    // "face_0.png .. face_5.png (cube:coupled, frame geo, 512x512; bilinear)", after write().
    std::string description() const;
    // Of that, "cube:coupled, frame geo, 512x512"; the names; and "bilinear".
    std::string surface_text() const;
    const std::vector<std::string> &file_names() const noexcept
    {
        return names;
    }
    std::string filter_name() const
    {
        return cm_filter_name(filter);
    }

private:
    using Render = OutputRender;
    using Rows = OutputRows;

    void choose_names(const Options &options, const Input &input);
    void choose_format(const Options &options, const Input &input);
    void choose_place(const Options &options, const Input &input);
    void choose_colors(const Options &options, const Input &input);
    void choose_values(const Options &options, const Input &input);
    void check_whole_numbers(const Options &options) const;
    void make_files(const Options &options, const Input &input);
    void write_hips(const Render &render, int threads);
    void write_pictures(const Render &render, int threads);
    void leave_work(const Options &options);
    void write_whole(const Render &render, int threads);
    cm_plan_options written_values() const;
    void write_picture(const Render &render, std::size_t index, int threads);
    void write_parts(const Render &render, int threads);
    void write_rows(const Render &render, std::size_t index, ImageWriter &writer,
                    const std::vector<int> &ends, int threads, bool own_thread);
    void compute(const Render &render, std::size_t index, const Rows &band, int threads);
    void finish_rows(const PlanePlace &place, const cm_rows &rows, const Rows &band,
                     int threads) const;
    std::vector<int> band_ends(std::size_t index, std::size_t most_bytes, int threads) const;
    std::vector<int> bands_of(const Render &render, std::size_t index, int threads) const;
    static void compute_tile(const Render &render, const cm_rows &tile,
                             std::vector<cm_image> &pictures, int threads);
    static void compute_rows(const Render &render, const cm_rows &rows,
                             std::vector<cm_image> &pictures, int threads);
    void fill_rows(const Render &render, std::size_t index, const Rows &band, int threads);
    bool holds_pictures(const Render &render, const Input &input) const;
    void compute_all(const Render &render, int threads);
    cm_image picture_at(unsigned char *first) const;
    void write_sidecar();
    void write_manifest(const Options &options, const Input &input);
    PictureKind kind() const;
    std::size_t row_bytes() const;

    WholeOutput whole;
    std::unique_ptr<WorkFolder> work; // if what is done is kept
    std::unique_ptr<HipsOutput> hips; // if OUTPUT is such a folder
    const cm_surface *surface;        // whose pixels are computed
    std::optional<cm_rotation> rotation;
    std::vector<PlanePlace> places;
    std::vector<PixelMemory> whole_pictures; // the pictures, where they are computed all at once
    std::string chosen_mapping;              // for people
    std::string kept_density;                // for people
    std::vector<std::string> names;          // of the pictures' files
    std::vector<std::unique_ptr<AtomicFile>> files; // of those, then sidecar and manifest
    ImagePlan plan;
    bool georeferenced = false;
    cm_plan_options values = {};
    cm_pixel_type row_type = CM_PIXEL_FLOAT; // of what is computed
    int channels = 0;
    ColorRows colors;
    std::unique_ptr<SurfaceLines> lines; // if there are to be any
    cm_filter filter = CM_FILTER_AUTO;   // that was taken
    std::int64_t not_finite = 0;
    std::string cut; // for people: values that OUTPUT cannot have
};

#endif
