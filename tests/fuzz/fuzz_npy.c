/* SPDX-License-Identifier: MIT
 *
 * Depth images as NPY. What is wrong is said in one line; what is read has all of its numbers.
 */
#include "modules/scene/io/npy_file.h"

#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    cm_image picture = {.size = 0};
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_status status =
        cm_npy_parse("file", size == 0 ? (const uint8_t *)"" : data, size, &picture, message);
    if (status != CM_OK)
    {
        EXPECT(picture.data == NULL && strncmp(message, "file:", 5) == 0 && is_one_line(message),
               "%d: %s", (int)status, message);
        return 0;
    }
    const size_t bytes = (size_t)picture.width * picture.height * cm_pixel_size(picture.type);
    unsigned sum = 0;
    for (size_t i = 0; i < bytes; i++)
    {
        sum += ((unsigned char *)picture.data)[i];
    }
    EXPECT(picture.channels == 1 && sum <= 255 * bytes, "%u", sum);
    free(picture.data);
    return 0;
}
