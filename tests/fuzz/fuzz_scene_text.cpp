// SPDX-License-Identifier: MIT
//
// Worlds of JSON, as cubemap-scene reads them: a world, or a failure of one line. No mesh that is named is there.

#include "tools/cli/program.hpp"
#include "tools/cli/scene_world.hpp"

#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const std::string text(reinterpret_cast<const char *>(data), size);
    if (text.find("\"/") != std::string::npos || text.find("..") != std::string::npos ||
        text.find('\\') != std::string::npos)
    {
        return 0; // names of files that may be there
    }
    try
    {
        const World world = parse_world("/nowhere/world.json", text);
        EXPECT(cm_scene_count(world.scene.get()) > 0, "an empty world");
    }
    catch (const Failure &failure)
    {
        EXPECT(failure.exit_status() == 1 && is_one_line(failure.what()), "%s", failure.what());
    }
    return 0;
}
