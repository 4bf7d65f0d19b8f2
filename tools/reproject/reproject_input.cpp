// SPDX-License-Identifier: MIT

#include "reproject_input.hpp"
#include "tools/cli/parallel.hpp"
#include "tools/cli/program.hpp"
#include "tools/cli/progress.hpp"

#include <algorithm>
#include <cstring>
#include <mutex>
#include <utility>

namespace
{

// Is the value at this place NaN or infinite?
bool is_bad(cm_pixel_type type, const unsigned char *values, std::size_t index)
{
    if (type == CM_PIXEL_HALF)
    {
        std::uint16_t bits = 0;
        std::memcpy(&bits, values + index * sizeof bits, sizeof bits);
        return (bits & 0x7c00u) == 0x7c00u;
    }
    std::uint32_t bits = 0;
    std::memcpy(&bits, values + index * sizeof bits, sizeof bits);
    return (bits & 0x7f800000u) == 0x7f800000u;
}

bool is_nan(cm_pixel_type type, const unsigned char *values, std::size_t index)
{
    if (type == CM_PIXEL_HALF)
    {
        std::uint16_t bits = 0;
        std::memcpy(&bits, values + index * sizeof bits, sizeof bits);
        return (bits & 0x3ffu) != 0;
    }
    std::uint32_t bits = 0;
    std::memcpy(&bits, values + index * sizeof bits, sizeof bits);
    return (bits & 0x7fffffu) != 0;
}

// Of a row, by the bits of infinity, of 1 and of the sign.
template <typename Bits, Bits infinity, Bits one>
void count_values(const unsigned char *values, std::size_t size, ValueCounts &counts)
{
    constexpr auto sign = static_cast<Bits>(Bits{1} << (8 * sizeof(Bits) - 1));
    std::uint32_t bad = 0;
    std::uint32_t below = 0;
    std::uint32_t above = 0;
    for (std::size_t i = 0; i < size; ++i)
    {
        Bits bits = 0;
        std::memcpy(&bits, values + i * sizeof bits, sizeof bits);
        bad += (bits & infinity) == infinity ? 1 : 0;
        below += bits > sign && bits < (sign | infinity) ? 1 : 0;
        above += bits > one && bits < infinity ? 1 : 0;
    }
    counts.not_finite += bad;
    counts.below_zero += below;
    counts.above_one += above;
}

// Of a row, those of the vector that begins in a channel.
template <typename Bits, Bits infinity, Bits one>
void count_vector(const unsigned char *values, std::size_t size, std::size_t channels,
                  std::size_t first, ValueCounts &counts)
{
    constexpr auto in_size = static_cast<Bits>(~(Bits{1} << (8 * sizeof(Bits) - 1)));
    ValueCounts own;
    ValueCounts lengths;
    for (std::size_t i = first; i + 3 <= size; i += channels)
    {
        Bits component[3];
        std::memcpy(component, values + i * sizeof(Bits), sizeof component);
        count_values<Bits, infinity, one>(values + i * sizeof(Bits), 3, own);
        for (Bits &bits : component)
        {
            bits &= in_size;
        }
        count_values<Bits, infinity, one>(reinterpret_cast<const unsigned char *>(component), 3,
                                          lengths);
    }
    counts.components_below_zero += own.below_zero;
    counts.components_above_one += own.above_one;
    counts.components_beyond_one += lengths.above_one;
}

// Both of a row. vector: its first channel, counted from 1; 0: there is none.
template <typename Bits, Bits infinity, Bits one>
void count_row(const unsigned char *values, std::size_t size, std::size_t channels, int vector,
               ValueCounts &counts)
{
    count_values<Bits, infinity, one>(values, size, counts);
    if (vector > 0)
    {
        count_vector<Bits, infinity, one>(values, size, channels,
                                          static_cast<std::size_t>(vector) - 1, counts);
    }
}

void add(const ValueCounts &some, ValueCounts &all)
{
    all.not_finite += some.not_finite;
    all.below_zero += some.below_zero;
    all.above_one += some.above_one;
    all.components_below_zero += some.components_below_zero;
    all.components_above_one += some.components_above_one;
    all.components_beyond_one += some.components_beyond_one;
}

} // namespace

Input::Input(const Options &options, int threads, std::vector<ImageFile> opened)
    : SphereFiles({options.input, options.from, options.to.frame, "--from"}, threads,
                  std::move(opened))
{
    find_surface();
    if (options.memory > 0)
    {
        return; // what does not fit goes to files
    }
    check_memory(in_quotes(files().front().path()),
                 std::int64_t{files().front().width()} * files().front().height() *
                     static_cast<std::int64_t>(files().size()),
                 files().front().channels(), channel_bytes(description_of_pixels().type),
                 "; --memory SIZE keeps what is more in a file");
}

std::size_t Input::picture_bytes() const
{
    const ImageFile &first = files().front();
    return static_cast<std::size_t>(first.width()) * static_cast<std::size_t>(first.channels()) *
           channel_bytes(description_of_pixels().type) * static_cast<std::size_t>(first.height());
}

// Room for the pixels. Which pictures' are there already?
std::vector<bool> Input::allocate(MemoryCeiling &ceiling, WorkFolder *work)
{
    const ImageFile &first = files().front();
    std::vector<bool> there;
    for (std::size_t i = 0; i < files().size(); ++i)
    {
        const bool kept = work != nullptr && work->has_source(i, picture_bytes());
        memory.emplace_back(ceiling, picture_bytes(),
                            "the pixels of " + in_quotes(files()[i].path()),
                            work != nullptr ? work->source_name(i) : "");
        there.push_back(kept && ceiling.is_in_file(memory.back().bytes()));
        cm_image view = {};
        view.size = sizeof view;
        view.data = memory.back().bytes();
        view.type = description_of_pixels().type;
        view.width = static_cast<std::uint32_t>(first.width());
        view.height = static_cast<std::uint32_t>(first.height());
        view.channels = static_cast<std::uint32_t>(first.channels());
        views.push_back(view);
    }
    return there;
}

void Input::read(const Options &options, int threads, MemoryCeiling &ceiling, std::FILE *terminal,
                 WorkFolder *work)
{
    const std::vector<bool> there = allocate(ceiling, work);
    read_files(threads, ceiling, options.quiet ? nullptr : terminal, there);
    for (std::size_t i = 0; work != nullptr && i < files().size(); ++i)
    {
        if (!there[i] && !work->source_name(i).empty() && ceiling.is_in_file(memory[i].bytes()))
        {
            ceiling.bring_to_disk(memory[i].bytes());
            work->note_source(i, picture_bytes());
        }
    }
    const auto has_floats = [](const ImageFile &image) { return !image.stored().whole_numbers; };
    if (std::any_of(files().begin(), files().end(), has_floats))
    {
        count_all(options.vector, threads);
    }
    if (counts.not_finite > 0 && options.not_finite == NotFinite::refuse)
    {
        refuse_not_finite();
    }
}

void Input::read_files(int threads, MemoryCeiling &ceiling, std::FILE *terminal,
                       const std::vector<bool> &there)
{
    const bool in_bands = ceiling.in_files() > 0;
    const std::ptrdiff_t row =
        files().front().width() * files().front().channels() *
        static_cast<std::ptrdiff_t>(channel_bytes(description_of_pixels().type));
    std::int64_t rows = 0;
    for (std::size_t i = 0; i < files().size(); ++i)
    {
        rows += there[i] ? 0 : files()[i].stored().height;
    }
    if (rows == 0)
    {
        return;
    }
    Progress progress(rows, in_bands && terminal != nullptr, terminal);
    const auto read_file = [&](int i)
    {
        ImageFile &image = files()[static_cast<std::size_t>(i)];
        if (there[static_cast<std::size_t>(i)])
        {
            return;
        }
        unsigned char *const to = memory[static_cast<std::size_t>(i)].bytes();
        if (in_bands)
        {
            image.read_in_bands(description_of_pixels().type, to, row,
                                [&](int done)
                                {
                                    ceiling.touched(static_cast<std::size_t>(done * row));
                                    progress.advance(done);
                                });
        }
        else
        {
            image.read_as(description_of_pixels().type, to, row);
        }
    };
    parallel_for(static_cast<int>(files().size()), threads, read_file);
}

void Input::count_all(int vector, int threads)
{
    const cm_pixel_type type = description_of_pixels().type;
    const auto channels = static_cast<std::size_t>(files().front().channels());
    const std::size_t row = static_cast<std::size_t>(files().front().width()) * channels;
    const int rows = files().front().height();
    counts = ValueCounts();
    std::mutex lock;
    for (const PixelMemory &picture : memory)
    {
        const auto count = [&](int i)
        {
            const unsigned char *const at =
                picture.bytes() + static_cast<std::size_t>(i) * row * channel_bytes(type);
            ValueCounts own;
            if (type == CM_PIXEL_HALF)
            {
                count_row<std::uint16_t, 0x7c00, 0x3c00>(at, row, channels, vector, own);
            }
            else
            {
                count_row<std::uint32_t, 0x7f800000, 0x3f800000>(at, row, channels, vector, own);
            }
            const std::lock_guard<std::mutex> held(lock);
            add(own, counts);
        };
        parallel_for(rows, threads, count);
    }
}

void Input::refuse_not_finite() const
{
    const std::size_t channels = static_cast<std::size_t>(files().front().channels());
    const std::size_t columns = static_cast<std::size_t>(files().front().width());
    const std::size_t values =
        columns * channels * static_cast<std::size_t>(files().front().height());
    std::size_t picture = 0;
    std::size_t i = 0;
    while (!is_bad(description_of_pixels().type, memory[picture].bytes(), i))
    {
        picture += i + 1 == values ? 1 : 0;
        i = i + 1 == values ? 0 : i + 1;
    }
    const ImageFile &image = files()[picture];
    throw Failure(
        in_quotes(image.path()) + " has " +
        (is_nan(description_of_pixels().type, memory[picture].bytes(), i) ? "a NaN"
                                                                          : "an infinite value") +
        " at x = " + std::to_string(i / channels % columns) +
        ", y = " + std::to_string(i / channels / columns) + ", channel " +
        image.channel_name(static_cast<int>(i % channels)) + "; --not-finite skip leaves it out");
}
