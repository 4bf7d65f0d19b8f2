/* SPDX-License-Identifier: MIT */
#include "update_round.h"

cm_status cm_update_round(cm_update *update, cm_pool *pool)
{
    (void)update;
    (void)pool;
    return CM_ERROR_UNSUPPORTED;
}
