// SPDX-License-Identifier: MIT
//
// The pictures of cubemap-distortion: plans, computes and writes them.

#ifndef CUBEMAP_TOOLS_DISTORTION_PICTURE_HPP
#define CUBEMAP_TOOLS_DISTORTION_PICTURE_HPP

#include "colors.hpp"
#include "distortion_options.hpp"
#include "distortion_rows.hpp"
#include "tools/cli/image_writer.hpp"
#include "tools/image/overlay.hpp"
#include "tools/cli/progress.hpp"

#include <cmath>
#include <mutex>

class DistortionPicture
{
public:
    // Decides on all and makes the files, under temporary names. UsageFailure or Failure if that
    // cannot be done.
    explicit DistortionPicture(const DistortionOptions &wanted);

    // Computes and writes the files, and lets them appear. The progress is shown on terminal, if it
    // is one.
    void write(int threads, std::FILE *terminal);

    // What the pictures are, as in their metadata: "tangent, frame geo, area (D_A): 0.74 to 1.37 ..."
    std::string description() const;

    // Lines for people: the description and the files, and what is not as one would expect.
    std::string report() const;

private:
    // What is found at the pixels' centres.
    struct Survey
    {
        double low = HUGE_VAL;
        double high = -HUGE_VAL;
        double below = 0; // how many are below the range of colours, and above
        double above = 0;
        double count = 0;
    };

    void choose_names();
    void survey(int threads, Progress &progress);
    void add_to_survey(const std::vector<double> &values);
    std::string out_of_range() const;
    ImagePlan plan() const;
    void write_picture(std::size_t index, int threads, Progress &progress);
    void draw_row(const PictureLayout &picture, int row, float *pixels) const;
    void draw_plane_row(int face, int row, float *pixels) const;
    void draw_lines(int face, int row, const std::vector<double> &values, float *pixels) const;
    void write_legend();

    const DistortionOptions &options;
    DistortionRows rows;
    Colors colors;
    ColorScale scale;
    std::unique_ptr<Overlay> overlay;
    std::vector<PictureLayout> pictures;
    std::vector<std::string> names; // of their files, and at the end that of the legend
    std::vector<std::unique_ptr<AtomicFile>> files;
    std::mutex mutex;
    Survey found;
};

#endif
