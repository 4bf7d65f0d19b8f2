// SPDX-License-Identifier: MIT
//
// The output of cubemap-reproject: plans it, computes and writes it.

#ifndef CUBEMAP_TOOLS_REPROJECT_OUTPUT_HPP
#define CUBEMAP_TOOLS_REPROJECT_OUTPUT_HPP

#include "tools/cli/image_writer.hpp"
#include "tools/image/overlay.hpp"
#include "tools/cli/progress.hpp"
#include "reproject_input.hpp"

#include <functional>

class Output
{
public:
    // Decides on all and makes the files, under temporary names. UsageFailure or Failure if that
    // cannot be done.
    Output(const Options &options, const Input &input);

    // Must the colours of the input be multiplied by its alpha first?
    bool multiply_alpha() const noexcept
    {
        return plan.multiply_alpha;
    }

    // Computes and writes the files, and lets them appear. The progress is shown on terminal, if it
    // is one.
    void write(const Options &options, const Input &input, const SphereGrid &grid, int threads,
               std::FILE *terminal);

    // "face_0.png .. face_5.png (cube:coupled, frame geo, 512x512, uint8)"
    std::string description(const Options &options) const;

private:
    struct Render; // what all of the rows have in common

    void choose_projection(const Options &options, const Input &input);
    void choose_overlay(const Options &options, const OIIO::ImageSpec &source);
    void choose_names(const Options &options, const Input &input);
    std::function<void(int plane, int row, float *pixels)> line_drawer() const;
    void write_picture(const Render &render, std::size_t index, int threads);

    Kind kind = Kind::cube;
    std::unique_ptr<Projection> sphere;
    std::optional<CubeLayout> layout; // of a cube
    std::vector<PictureLayout> pictures;
    std::vector<std::string> names; // of their files
    std::vector<std::unique_ptr<AtomicFile>> files;
    ImagePlan plan;
    std::unique_ptr<Overlay> overlay; // of lines, if there are to be any
    LineStyle line_style = {};
    PixelChannels line_channels = {};
};

#endif
