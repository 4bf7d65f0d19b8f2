// SPDX-License-Identifier: MIT
//
// The command line of cubemap-compare. Input: an argument a line. The program runs in a folder of
// its own with two images in it, a.ppm and b.ppm, and nothing else can be named.

#include "fuzz_folder.hpp"

#include "tools/compare/compare_main.h"

namespace
{

// The folder with the images, of two pixels each.
class ImageFolder : public FuzzFolder
{
public:
    ImageFolder() : FuzzFolder("fuzz-compare")
    {
        const std::string head = "P6\n2 1\n255\n";
        write("a.ppm", head + "\x01\x02\x03\xff\xfe\xfd");
        write("b.ppm", head + "\x01\x02\x04\xff\xfe\x80");
        keep();
    }
};

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const ImageFolder folder;
    arguments given = read_arguments("cubemap-compare", data, size);
    if (!names_elsewhere(given))
    {
        talk with = {};
        std::FILE *const output = open_memstream(&with.output, &with.output_size);
        std::FILE *const messages = open_memstream(&with.messages, &with.messages_size);
        EXPECT(output != nullptr && messages != nullptr, "no memory");
        const cm_streams streams = {stdin, output, messages};
        folder.enter();
        const int status = cm_compare_main(given.count, given.argument, &streams);
        folder.leave();
        EXPECT(std::fclose(output) == 0 && std::fclose(messages) == 0, "no memory");
        EXPECT(status >= 0 && status <= 2, "exit status %d", status);
        EXPECT(status == 0 ? with.messages_size == 0
                           : is_one_message(with.messages, "cubemap-compare: "),
               "exit status %d: %s", status, with.messages);
        EXPECT(status != 2 || with.output_size == 0, "wrong usage, but: %s", with.output);
        drop_talk(&with);
    }
    drop_arguments(&given);
    return 0;
}
