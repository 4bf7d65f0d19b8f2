// SPDX-License-Identifier: MIT
//
// The check that a PNG file has its end, before it is read. The input is the file.

#include "modules/image/io/whole_png.h"

#include "fuzz_streams.h"

namespace
{

bool is_whole(const uint8_t *data, size_t size)
{
    set_input(data, size);
    return cm_png_is_whole("/proc/self/fd/0");
}

// Is one of the chunks its end, and whole?
bool has_end(const uint8_t *data, size_t size)
{
    for (size_t at = 8; size - at >= 12;)
    {
        const size_t length = size_t{data[at]} << 24 | size_t{data[at + 1]} << 16 |
                              size_t{data[at + 2]} << 8 | size_t{data[at + 3]};
        if (length > size - at - 12)
        {
            return false;
        }
        if (memcmp(data + at + 4, "IEND", 4) == 0)
        {
            return true;
        }
        at += 12 + length;
    }
    return false;
}

} // namespace

int LLVMFuzzerInitialize(int *, char ***)
{
    replace_descriptors();
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const bool png = size >= 8 && memcmp(data, "\x89PNG\r\n\x1a\n", 8) == 0;
    EXPECT(is_whole(data, size) == (!png || has_end(data, size)), "%zu bytes", size);
    return 0;
}
