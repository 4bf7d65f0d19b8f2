// SPDX-License-Identifier: MIT

#include "scene_sequence.hpp"

#include "tools/cli/scene_handle.hpp"
#include "scene_table.h"
#include "tools/cli/program.hpp"

namespace
{

TrajectoryPointer trajectory_of(const std::string &path)
{
    const TimedPoses poses = read_poses(path);
    cm_trajectory *trajectory = nullptr;
    std::size_t wrong = 0;
    const cm_status status = cm_trajectory_create(poses.time.size(), poses.time.data(),
                                                  poses.pose.data(), &trajectory, &wrong);
    if (status != CM_OK)
    {
        throw Failure(in_quotes(path) + ": pose " + std::to_string(wrong + 1) + ": " +
                      cm_status_text(status));
    }
    return TrajectoryPointer(trajectory);
}

std::string evaluation_json(const cm_evaluation &found)
{
    return "{\"pairs\": " + std::to_string(found.pairs) +
           ", \"ate_rmse\": " + json_number(found.ate_rmse) +
           ", \"rpe_translation_rmse\": " + json_number(found.rpe_translation_rmse) +
           ", \"rpe_rotation_rmse_degrees\": " + json_number(found.rpe_rotation_rmse_degrees) +
           ", \"motions\": " + std::to_string(found.motions) +
           ", \"alignment_rank\": " + std::to_string(found.rank) +
           ", \"rank_deficient\": " + (found.is_determined ? "false" : "true") + "}\n";
}

std::string evaluation_text(const cm_evaluation &found)
{
    char text[400];
    std::snprintf(
        text, sizeof text,
        "%zu pairs%s\nATE: %.6g m\nRPE over 1 s, %zu motions: %.6g m, %.6g degrees\n", found.pairs,
        found.is_determined ? "" : "; their positions do not determine the alignment",
        found.ate_rmse, found.motions, found.rpe_translation_rmse, found.rpe_rotation_rmse_degrees);
    return text;
}

} // namespace

int evaluate_scene(int argc, char **argv, const cm_streams &streams)
{
    bool json = false;
    OptionReader reader(scene_evaluate_command, argc, argv, streams);
    while (reader.next() != 0)
    {
        json = true;
    }
    if (reader.printed())
    {
        return 0;
    }
    const std::vector<std::string> names = reader.operands();
    if (names.size() != 2)
    {
        throw UsageFailure("TRUTH.txt and ESTIMATE.txt are needed, " +
                           std::to_string(names.size()) + (names.size() == 1 ? " is" : " are") +
                           " given; see --help");
    }
    const TrajectoryPointer truth = trajectory_of(names[0]);
    const TrajectoryPointer estimate = trajectory_of(names[1]);
    cm_evaluation found = {};
    found.size = sizeof found;
    const cm_status status = cm_trajectory_evaluate(truth.get(), estimate.get(), nullptr, &found);
    if (status == CM_ERROR_RANK)
    {
        throw Failure("no stamp of " + in_quotes(names[1]) + " is within 0.02 s of one of " +
                      in_quotes(names[0]));
    }
    if (status != CM_OK)
    {
        throw Failure(in_quotes(names[0]) + " and " + in_quotes(names[1]) + ": " +
                      cm_status_text(status));
    }
    print(streams, json ? evaluation_json(found) : evaluation_text(found));
    return 0;
}
