/* SPDX-License-Identifier: MIT
 *
 * Points and triangles as PLY. What is wrong is said in one line; corners are points that there are.
 */
#include "modules/scene/io/ply_file.h"

#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    cm_ply ply = {.point_count = 0};
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_status status =
        cm_ply_parse("file", size == 0 ? (const uint8_t *)"" : data, size, &ply, message);
    if (status != CM_OK)
    {
        EXPECT(ply.position == NULL && strncmp(message, "file:", 5) == 0 && is_one_line(message),
               "%d: %s", (int)status, message);
        return 0;
    }
    for (size_t i = 0; i < 3 * ply.triangle_count; i++)
    {
        EXPECT(ply.corner[i] < ply.point_count, "corner %zu", i);
    }
    EXPECT(ply.point_count == 0 || ply.position != NULL, "no positions");
    /* to their ends, where the sanitizer watches */
    if (ply.point_count > 0)
    {
        const size_t last = 3 * ply.point_count - 1;
        volatile double read = ply.position[last];
        read = ply.normal != NULL ? (double)ply.normal[last] : read;
        read = ply.color != NULL ? (double)ply.color[last] : read;
        (void)read;
    }
    cm_ply_clear(&ply);
    return 0;
}
