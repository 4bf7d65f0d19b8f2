/* SPDX-License-Identifier: MIT */
#include "optical_flow.h"

#include <stddef.h>

const char *cm_flow_method_name(cm_flow_method method)
{
    static const char *const names[CM_FLOW_METHODS] = {"dis", "farneback", "tvl1", "lk", "rlof"};
    return (unsigned)method < CM_FLOW_METHODS ? names[(unsigned)method] : NULL;
}
