// SPDX-License-Identifier: MIT

#include "vision.h"

__attribute__((visibility("default"))) const cm_vision *cm_vision_entry(uint32_t version)
{
    static const cm_vision table = {CM_VISION_VERSION, sizeof(cm_vision), cm_flow_find,
                                    cm_checkerboard_calibrate};
    return version == CM_VISION_VERSION ? &table : nullptr;
}
