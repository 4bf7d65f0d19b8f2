/* SPDX-License-Identifier: MIT
 *
 * Memory that cannot be had. Linked with --wrap=malloc against the static library, so that the test
 * decides what malloc gives.
 */
#include <cubemap/cubemap.h>

#include <stdio.h>
#include <stdlib.h>

void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);

static int exhausted;

void *__wrap_malloc(size_t size)
{
    return exhausted ? NULL : __real_malloc(size);
}

int main(void)
{
    cm_mapping *untouched = NULL;
    cm_mapping *mapping = NULL;
    exhausted = 1;
    cm_status status = cm_mapping_create("coupled", NULL, &mapping);
    exhausted = 0;
    if (status != CM_ERROR_MEMORY || mapping != untouched)
    {
        printf("without memory: status %d (%s)\n", (int)status, cm_status_text(status));
        return 1;
    }
    status = cm_mapping_create("coupled", NULL, &mapping);
    if (status != CM_OK)
    {
        return 1;
    }
    const double percent = 50.0;
    double value = 77.0;
    exhausted = 1;
    status = cm_distortion_percentiles(mapping, CM_QUANTITY_AREA, NULL, 1, &percent, &value, NULL);
    exhausted = 0;
    cm_mapping_destroy(mapping);
    return status == CM_ERROR_MEMORY && value == 77.0 ? 0 : 1;
}
