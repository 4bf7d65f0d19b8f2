// SPDX-License-Identifier: MIT
//
// cubemap-tof evaluate: edges and sparsification that are known, and which part of a file is taken.

#include "image_cases.hpp"

#include "modules/image/io/image_io.h"

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace
{

constexpr int wall_pixels = 20;

// A row of floats.
void write_row(const std::string &name, const std::vector<float> &row)
{
    std::ofstream file(name, std::ios::binary);
    file << "Pf\n" << row.size() << " 1\n-1.0\n";
    file.write(reinterpret_cast<const char *>(row.data()),
               static_cast<std::streamsize>(row.size() * sizeof(float)));
}

// An OpenEXR file of such rows, whose parts have these names.
void write_named_parts(const std::string &name, const std::vector<const char *> &names,
                       const std::vector<std::vector<float>> &rows)
{
    cm_image_description description = {};
    description.format = "openexr";
    description.width = static_cast<std::uint32_t>(rows.front().size());
    description.height = description.channels = 1;
    description.type = CM_PIXEL_FLOAT;
    description.alpha = -1;
    description.part_names = names.data();
    description.part_count = static_cast<std::uint32_t>(names.size());
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_image_io &io = *cm_image_io_get(message);
    cm_image_writer *writer = nullptr;
    bool good = io.create(name.c_str(), nullptr, &description, &writer, message) == CM_OK;
    for (const std::vector<float> &row : rows)
    {
        good = good && io.write(writer, 0, 1, CM_PIXEL_FLOAT, row.data(), 0, 0, message) == CM_OK;
    }
    good = good && io.finish(writer, message) == CM_OK;
    io.drop(writer);
    if (!good)
    {
        throw std::runtime_error(name + ": " + message);
    }
}

// A wall, and what is 0, 1, 2 ... cm too far.
void make_wall_rows()
{
    std::vector<float> far, sure, unsure;
    for (int i = 0; i < wall_pixels; ++i)
    {
        far.push_back(static_cast<float>(2 + 0.01 * i));
        sure.push_back(static_cast<float>(-i));
        unsure.push_back(static_cast<float>(i));
    }
    write_row("wall.pfm", std::vector<float>(wall_pixels, 2.0F));
    write_row("far.pfm", far);
    write_row("sure.pfm", sure);
    write_row("unsure.pfm", unsure);
}

// Roots of means of squares: of 0 to 14 cm 8.23, to 9 cm 5.34, to 4 cm 2.45.
void tells_sparsification()
{
    make_wall_rows();
    const std::string good = "tof evaluate far.pfm wall.pfm";
    const std::string best = "at best 0.0823, 0.0534 and 0.0245 m; area between ";
    says("the best confidence, in words",
         "the least sure 25, 50 and 75 %: 0.0823, 0.0534 and 0.0245 m; " + best +
             "0\n20 pixels count",
         good + " --confidence sure.pfm");
    says("and the worst", "0.128, 0.148 and 0.171 m; " + best + "0.821\n",
         good + " --confidence unsure.pfm");
    fails("a confidence that is not there, in words", 1, "'none.pfm' cannot be read",
          good + " --confidence none.pfm");
    fails("and in JSON", 1, "'none.pfm' cannot be read", good + " --confidence none.pfm --json");
    fails("a plot of nothing", 2, "-o DIR needs --confidence", good + " -o made/plot");
    run(good +
        " --confidence sure.pfm -o plots"); // says on standard error where Python cannot draw
    const std::string plot = content_of("plots/sparsification.json");
    result(plot.find("\"x\":[0,0.05,0.1,") != std::string::npos &&
               plot.find("\"name\":\"the worst first\"") != std::string::npos,
           "the plot is there", plot);
}

// A step one pixel late is found; a lone pixel has edges that are none.
void tells_edges()
{
    std::vector<float> truth, measured;
    for (int i = 0; i < wall_pixels; ++i)
    {
        truth.push_back(i < 10 ? 1.0F : 2.0F);
        measured.push_back(i == 3 ? 3.0F : i < 11 ? 1.0F : 2.0F);
    }
    write_row("step.pfm", truth);
    write_row("late.pfm", measured);
    says("edges, in JSON",
         "\"edges\": \\{\"gap\": 0.05, \"reach\": 1, \"measured\": 3, \"true\": 1, "
         "\"precision\": 0.3333333333333333, \"recall\": 1\\}\\}",
         "tof evaluate late.pfm step.pfm --json");
    says(
        "edges, in words",
        "3 pixels are on edges, 1 of them within a pixel of a true one; of 1 true ones 1 are found",
        "tof evaluate late.pfm step.pfm");
    make_wall_rows();
    says("no edges", "\"measured\": 0, \"true\": 0, \"precision\": null, \"recall\": null\\}",
         "tof evaluate far.pfm wall.pfm --json");
}

void takes_parts()
{
    make_wall_rows();
    const std::vector<float> wall(wall_pixels, 2.0F), other(wall_pixels, 3.0F);
    write_named_parts("named.exr", {"beauty"}, {wall});
    says("one part, whatever its name", "bias 0 m", "tof evaluate named.exr wall.pfm");
    write_named_parts("parts.exr", {"depth", "range"}, {other, wall});
    says("of several that of ranges", "bias 0 m", "tof evaluate parts.exr wall.pfm");
    write_named_parts("others.exr", {"left", "right"}, {wall, wall});
    fails("parts without ranges", 1, "'others.exr' has 2 parts, of which none is called range",
          "tof evaluate others.exr wall.pfm");
}

} // namespace

const std::vector<Subject> &tof_evaluate_subjects()
{
    static const std::vector<Subject> subjects = {{"tof_sparsification", tells_sparsification},
                                                  {"tof_edges", tells_edges},
                                                  {"tof_parts", takes_parts}};
    return subjects;
}
