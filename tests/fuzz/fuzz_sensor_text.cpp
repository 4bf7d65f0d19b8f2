// SPDX-License-Identifier: MIT
//
// SENSOR.json, as cubemap-tof reads it: a camera with its lights, or a failure of one line.

#include "tools/cli/program.hpp"
#include "tools/tof/tof_sensor.hpp"

#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const std::string text(reinterpret_cast<const char *>(data), size);
    try
    {
        const TofSensor made = parse_tof_sensor("sensor.json", text);
        EXPECT(made.camera != nullptr && made.sensor.camera == made.camera.get(), "no camera");
        EXPECT(!made.light.empty() && made.sensor.phases >= 3 && made.sensor.exposure > 0,
               "%zu lights, %d phases", made.light.size(), made.sensor.phases);
        EXPECT(made.mask.size() == std::size_t{made.sensor.mask_columns} * made.sensor.mask_rows,
               "a mask of %zu", made.mask.size());
    }
    catch (const Failure &failure)
    {
        EXPECT(failure.exit_status() == 1 && is_one_line(failure.what()), "%s", failure.what());
    }
    return 0;
}
