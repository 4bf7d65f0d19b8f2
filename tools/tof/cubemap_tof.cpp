// SPDX-License-Identifier: MIT
//
// cubemap-tof: time-of-flight cameras.

#include "tof_command.hpp"
#include "tof_main.h"
#include "tools/cli/catalogue_name.h"
#include "tools/cli/program.hpp"

namespace
{

using TofCommand = int (*)(int, char **, const cm_streams &);

struct NamedTofCommand
{
    const char *name;
    TofCommand run;
};

constexpr NamedTofCommand tof_commands[] = {{"simulate", simulate_tof},
                                            {"evaluate", evaluate_tof},
                                            {"texel", render_texels},
                                            {"reproduce", reproduce_papers}};

constexpr const char *tof_command_list = "simulate, evaluate, texel or reproduce";

const char *tof_command_at(std::size_t index)
{
    return index < std::size(tof_commands) ? tof_commands[index].name : nullptr;
}

int tof(int argc, char **argv, const cm_streams &streams)
{
    const std::string first = argc > 1 ? argv[1] : "";
    for (const NamedTofCommand &command : tof_commands)
    {
        if (first == command.name)
        {
            return command.run(argc - 1, argv + 1, streams);
        }
    }
    OptionReader reader(cm_tof_command, argc, argv, streams);
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
        throw UsageFailure(std::string("a command is needed: ") + tof_command_list +
                           "; see --help");
    }
    throw UsageFailure(in_quotes(names.front()) + " is not a command: " + tof_command_list +
                       suggestion(nearest_name(names.front().c_str(), tof_command_at)));
}

} // namespace

int cm_tof_main(int argc, char **argv, const cm_streams *streams)
{
    return run_program("cubemap-tof", *streams,
                       [argc, argv, streams] { return tof(argc, argv, *streams); });
}
