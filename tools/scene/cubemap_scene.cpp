// SPDX-License-Identifier: MIT
//
// cubemap-scene: sequences of depth cameras.

#include "scene_main.h"
#include "scene_render.hpp"
#include "scene_sequence.hpp"
#include "tools/cli/catalogue_name.h"
#include "tools/cli/program.hpp"

namespace
{

using SceneCommand = int (*)(int, char **, const cm_streams &);

struct NamedCommand
{
    const char *name;
    SceneCommand run;
};

constexpr NamedCommand scene_commands[] = {{"render", render_scene},
                                           {"info", tell_scene},
                                           {"convert", convert_scene},
                                           {"evaluate", evaluate_scene}};

const char *scene_command_at(std::size_t index)
{
    return index < std::size(scene_commands) ? scene_commands[index].name : nullptr;
}

int scene(int argc, char **argv, const cm_streams &streams)
{
    const std::string first = argc > 1 ? argv[1] : "";
    for (const NamedCommand &command : scene_commands)
    {
        if (first == command.name)
        {
            return command.run(argc - 1, argv + 1, streams);
        }
    }
    OptionReader reader(cm_scene_command, argc, argv, streams);
    while (reader.next() != 0)
    {
    }
    if (reader.printed())
    {
        return 0;
    }
    const std::vector<std::string> names = reader.operands();
    if (names.empty())
    {
        throw UsageFailure("a command is needed: render, info, convert or evaluate; see --help");
    }
    throw UsageFailure(in_quotes(names.front()) +
                       " is not a command: render, info, convert or evaluate" +
                       suggestion(nearest_name(names.front().c_str(), scene_command_at)));
}

} // namespace

int cm_scene_main(int argc, char **argv, const cm_streams *streams)
{
    return run_program("cubemap-scene", *streams,
                       [argc, argv, streams] { return scene(argc, argv, *streams); });
}
