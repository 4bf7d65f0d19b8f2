// SPDX-License-Identifier: MIT
//
// The command line of cubemap-compare. Input: an argument a line. The program runs in a folder of
// its own with two images in it, a.ppm and b.ppm, and nothing else can be named.

#include <fcntl.h>

#include <filesystem>
#include <string>

#include "tools/compare/compare_main.h"

#include "fuzz_arguments.h"
#include "fuzz_streams.h"

namespace
{

// The folder with the images, which is there as long as the program runs.
class Folder
{
public:
    Folder()
    {
        name = (std::filesystem::temp_directory_path() / "fuzz-compare-XXXXXX").string();
        EXPECT(mkdtemp(name.data()) != nullptr, "no folder %s", name.c_str());
        make_image("a.ppm", "\x01\x02\x03\xff\xfe\xfd");
        make_image("b.ppm", "\x01\x02\x04\xff\xfe\x80");
        descriptor = open(name.c_str(), O_RDONLY | O_DIRECTORY);
        before = open(".", O_RDONLY | O_DIRECTORY);
        EXPECT(descriptor >= 0 && before >= 0, "no folder %s", name.c_str());
    }
    ~Folder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(name, ignored);
    }
    Folder(const Folder &) = delete;
    Folder &operator=(const Folder &) = delete;

    // libFuzzer's own names begin where it was started.
    void enter() const
    {
        EXPECT(fchdir(descriptor) == 0, "cannot enter %s", name.c_str());
    }
    void leave() const
    {
        EXPECT(fchdir(before) == 0, "cannot leave %s", name.c_str());
    }

private:
    // two pixels
    void make_image(const char *file, const char *pixels) const
    {
        std::FILE *const stream = std::fopen((name + "/" + file).c_str(), "wb");
        EXPECT(stream != nullptr, "no file in %s", name.c_str());
        std::fprintf(stream, "P6\n2 1\n255\n");
        std::fwrite(pixels, 1, 6, stream);
        EXPECT(std::fclose(stream) == 0, "no room in %s", name.c_str());
    }

    std::string name;
    int descriptor = -1;
    int before = -1;
};

bool names_elsewhere(const arguments &given)
{
    for (int i = 1; i < given.count; ++i)
    {
        if (strchr(given.argument[i], '/') != nullptr)
        {
            return true;
        }
    }
    return false;
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const Folder folder;
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
