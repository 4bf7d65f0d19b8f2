// SPDX-License-Identifier: MIT
//
// The tags of TIFF files that say where on Earth their pixels are. The input is a byte, the number of the picture, and the
// file.

#include "modules/image/io/geo_tags.h"

#include "fuzz_streams.h"

#include <cstdlib>

namespace
{

// All of an array can be read, and there is one if it has a count.
template <typename Number> void read_all(const Number *numbers, size_t count)
{
    EXPECT((numbers == nullptr) == (count == 0), "%zu numbers", count);
    volatile Number last{};
    for (size_t i = 0; i < count; ++i)
    {
        last = numbers[i];
    }
    (void)last;
}

} // namespace

int LLVMFuzzerInitialize(int *, char ***)
{
    replace_descriptors();
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size == 0)
    {
        return 0;
    }
    set_input(data + 1, size - 1);
    const bool cut = cm_geo_tags_are_cut("/proc/self/fd/0", data[0] % 4);
    set_input(data + 1, size - 1);
    cm_image_geo_tags *const tags = cm_geo_tags_read("/proc/self/fd/0", data[0] % 4);
    if (tags != nullptr)
    {
        read_all(tags->scale, tags->scale_count);
        read_all(tags->tie_points, tags->tie_point_count);
        read_all(tags->transformation, tags->transformation_count);
        read_all(tags->keys, tags->key_count);
        read_all(tags->numbers, tags->number_count);
        EXPECT(tags->texts == nullptr || strlen(tags->texts) <= size, "%zu bytes", size);
        EXPECT(tags->no_data == nullptr || strlen(tags->no_data) <= size, "%zu bytes", size);
    }
    std::free(tags);
    if (cut) // there is a head, and a directory with an entry
    {
        EXPECT(size > 8 + 2 + 12, "%zu bytes", size);
    }
    return 0;
}
