// SPDX-License-Identifier: MIT

#include "other_files.hpp"
#include "tools/cli/program.hpp"
#include "tools/image/sidecar.hpp"

#include <filesystem>
#include <optional>

namespace
{

struct UsedFile
{
    std::string name;
    std::string what; // for people
};

std::filesystem::path place_of(const std::string &name)
{
    std::error_code error;
    const std::filesystem::path place = std::filesystem::weakly_canonical(name, error);
    return error ? std::filesystem::path(name) : place;
}

std::vector<UsedFile> read_files(const Options &options, const Input &input)
{
    std::vector<UsedFile> used;
    for (const ImageFile &file : input.files())
    {
        used.push_back({file.path(), "INPUT"});
    }
    if (!options.from_file.empty())
    {
        used.push_back({options.from_file, "the file of --from"});
    }
    const std::optional<SavedSurface> beside =
        is_pipe(options.input) ? std::nullopt
                               : surface_beside(options.input, input.files().front().path());
    if (beside)
    {
        used.push_back({beside->where, "the file that says what INPUT is"});
    }
    return used;
}

void check_name(const std::string &option, const std::string &name,
                const std::vector<UsedFile> &used, const std::string &cure)
{
    for (const UsedFile &each : used)
    {
        if (place_of(each.name) == place_of(name))
        {
            throw UsageFailure(option + ": " + in_quotes(name) + " is " + each.what + ", too; " +
                               cure);
        }
    }
}

} // namespace

void check_other_files(const Options &options, const Input &input,
                       const std::vector<std::string> &names)
{
    std::vector<UsedFile> used = read_files(options, input);
    const std::string beside = sidecar_name(options.output);
    if (options.sidecar)
    {
        check_name("--sidecar", beside, used, "give OUTPUT another name");
        used.push_back({beside, "the file of --sidecar"});
    }
    for (const std::string &name : names)
    {
        used.push_back({name, "OUTPUT"});
    }
    if (!options.manifest.empty())
    {
        check_name("--manifest", options.manifest, used, "give it another name");
    }
}
