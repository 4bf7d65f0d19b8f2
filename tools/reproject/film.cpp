// SPDX-License-Identifier: MIT

#include "film.hpp"
#include "mapping_choice.hpp"
#include "reproject_output.hpp"
#include "tools/cli/number_pattern.hpp"
#include "tools/cli/parallel.hpp"
#include "tools/cli/picture_stream.hpp"
#include "tools/cli/program.hpp"
#include "tools/image/face_names.hpp"

#include <chrono>
#include <cstdio>
#include <future>
#include <memory>
#include <set>
#include <system_error>
#include <utility>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace
{

// The number of the first picture of a pipe, as ffmpeg counts.
constexpr int first_of_pipe = 1;

// What one picture needs is what the next one needs: memory that is given back to the system must be cleared again.
void keep_freed_memory()
{
#if defined(__GLIBC__)
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, -1);
    mallopt(M_TOP_PAD, 1 << 20);
#endif
}

// A picture that was read, and what is to become of it.
struct FilmPicture
{
    Options options;
    std::unique_ptr<Input> input;
};

// The names of INPUT's files in their order, or what comes through a pipe.
class FilmSource
{
public:
    FilmSource(const Options &wanted, const cm_streams &streams, MemoryCeiling &pixels);

    // Opens and reads the next one; nothing behind the last. The failure names it. threads as for ImageFile, and to
    // read with.
    std::unique_ptr<FilmPicture> next(int file_threads, int threads);

    // How many there are; 0 if nobody knows.
    std::int64_t count() const noexcept
    {
        return input ? last - first + 1 : 0;
    }

private:
    void find_numbers();

    const Options &options;
    MemoryCeiling &ceiling;
    std::optional<NumberPattern> input;
    std::optional<NumberPattern> output;
    std::unique_ptr<PictureStream> stream;
    int first = first_of_pipe;
    int last = INT32_MAX;
    int number;
    std::string chosen; // what OUTPUT is, for all as for the first picture
};

FilmSource::FilmSource(const Options &wanted, const cm_streams &streams, MemoryCeiling &pixels)
    : options(wanted), ceiling(pixels), input(number_pattern(wanted.input)),
      output(number_pattern(wanted.output))
{
    if (is_pipe(options.input))
    {
        stream = std::make_unique<PictureStream>(streams.in, options.raw);
        first = options.start.value_or(first_of_pipe);
        last = options.count ? first + *options.count - 1 : last;
    }
    else
    {
        find_numbers();
    }
    number = first;
}

// All that are there, without a gap, or those that are asked for.
void FilmSource::find_numbers()
{
    NumberPattern files = *input;
    if (names_faces(options.input))
    {
        files = *number_pattern(face_names(options.input).front());
    }
    const std::set<int> present = present_numbers(files);
    if (present.empty())
    {
        throw Failure("there is no file " + in_quotes(files.name(options.start.value_or(1))) +
                      ", nor one with another number in its place");
    }
    first = options.start.value_or(*present.begin());
    last = options.count ? first + *options.count - 1 : std::max(first, *present.rbegin());
    for (int i = first; i <= last; ++i)
    {
        if (present.count(i) == 0)
        {
            const auto next = present.upper_bound(i);
            const auto another = next == present.end() ? *present.rbegin() : *next;
            throw Failure(in_quotes(files.name(i)) + " is missing among pictures " +
                          std::to_string(first) + " to " + std::to_string(last) + "; " +
                          in_quotes(files.name(another)) +
                          " is there: --start and --count say which are meant");
        }
    }
}

std::unique_ptr<FilmPicture> FilmSource::next(int file_threads, int threads)
{
    if (number > last)
    {
        return nullptr;
    }
    auto picture = std::make_unique<FilmPicture>();
    picture->options = options;
    picture->options.quiet = true;
    picture->options.output = output ? output->name(number) : options.output;
    try
    {
        std::vector<ImageFile> opened;
        if (stream)
        {
            std::optional<ImageFile> came = stream->next();
            if (!came)
            {
                return nullptr;
            }
            opened.push_back(std::move(*came));
        }
        else
        {
            picture->options.input = input->name(number);
        }
        picture->input = std::make_unique<Input>(picture->options, file_threads, std::move(opened));
        if (chosen.empty())
        {
            choose_mapping(picture->options, *picture->input);
            chosen = picture->options.to.specification;
        }
        picture->options.to.specification = chosen;
        picture->input->read(picture->options, threads, ceiling, nullptr);
    }
    catch (const Failure &failure)
    {
        throw Failure("picture " + std::to_string(number) + ": " + failure.what(),
                      failure.exit_status());
    }
    ++number;
    return picture;
}

// What must be the same in all: sizes of a film do not change.
std::string kind_of_picture(const Input &input)
{
    const ImageDescription &pixels = input.description_of_pixels();
    return std::string(cm_surface_specification(&input.surface())) + ", " +
           std::to_string(pixels.channels) + (pixels.channels == 1 ? " channel, " : " channels, ") +
           pixels.stored_type;
}

// What was done so far.
struct Done
{
    std::int64_t count = 0;
    std::string kind;
    std::string first_names[2];
    std::string last_names[2];
    std::string source;
    std::string target;
    std::set<std::string> filters;

    std::string text(double seconds) const;

    // What a failure says of the pictures before the one that failed.
    std::string before() const;
};

std::string from_to(const std::string &first, const std::string &last)
{
    return first == last ? first : first + " .. " + last;
}

std::string Done::text(double seconds) const
{
    char speed[64];
    std::snprintf(speed, sizeof speed, "%.3g a second",
                  seconds > 0 ? static_cast<double>(count) / seconds : 0.0);
    std::string names;
    for (const std::string &filter : filters)
    {
        names += (names.empty() ? "" : " and ") + filter;
    }
    return from_to(first_names[0], last_names[0]) + " (" + source + ") -> " +
           from_to(first_names[1], last_names[1]) + " (" + target + "; " + names + "), " +
           std::to_string(count) + (count == 1 ? " picture, " : " pictures, ") + speed + "\n";
}

std::string Done::before() const
{
    return count == 0   ? ""
           : count == 1 ? "; the picture before it is written"
                        : "; the " + std::to_string(count) + " pictures before it are written";
}

class FilmLoop
{
public:
    FilmLoop(const Options &wanted, int thread_number, const cm_streams &where)
        : options(wanted), threads(thread_number), streams(where),
          ceiling(options.memory, options.output, options.quiet ? nullptr : streams.err),
          source(options, streams, ceiling),
          progress(source.count(), !options.quiet && source.count() > 0, streams.err)
    {
    }

    // All of them.
    void run();

    const Done &result() const noexcept
    {
        return done;
    }

private:
    void write_all();
    void write(const FilmPicture &picture);
    void check_alike(const FilmPicture &picture) const;

    const Options &options;
    const int threads;
    const cm_streams &streams;
    MemoryCeiling ceiling;
    FilmSource source;
    Progress progress;
    KeptPlan plan;
    Done done;
};

void FilmLoop::run()
{
    try
    {
        write_all();
    }
    catch (const Failure &failure)
    {
        throw Failure(failure.what() + done.before(), failure.exit_status());
    }
}

void FilmLoop::write_all()
{
    std::unique_ptr<FilmPicture> picture = source.next(threads, threads);
    if (!picture)
    {
        throw Failure("standard input has no picture; PPM, PGM, PAM or PFM is needed, or --raw "
                      "says what it is");
    }
    while (picture)
    {
        // the next one is read meanwhile
        std::future<std::unique_ptr<FilmPicture>> ahead;
        try
        {
            ahead = std::async(std::launch::async, [this] { return source.next(0, threads); });
        }
        catch (const std::system_error &)
        {
            // The system gives no more threads.
        }
        write(*picture);
        picture = ahead.valid() ? ahead.get() : source.next(0, threads);
    }
}

void FilmLoop::check_alike(const FilmPicture &picture) const
{
    const std::string kind = kind_of_picture(*picture.input);
    if (done.count > 0 && kind != done.kind)
    {
        throw Failure(in_quotes(picture.input->files().front().path()) + " is " + kind +
                      ", and the pictures before it are " + done.kind +
                      "; the pictures of a film must be alike");
    }
    const bool alone = !is_pipe(options.output) && !number_pattern(options.output);
    if (done.count > 0 && alone)
    {
        throw Failure("standard input has more than one picture, and OUTPUT is one file; a number "
                      "in its name, as in cube_%04d.png, takes them all");
    }
}

void FilmLoop::write(const FilmPicture &picture)
{
    check_alike(picture);
    Output output(picture.options, *picture.input);
    if (done.count == 0)
    {
        for (const std::string &warning : picture.input->warnings())
        {
            std::fprintf(streams.err, "cubemap-reproject: %s\n", warning.c_str());
        }
    }
    output.write(picture.options, *picture.input, threads, ceiling, streams.err, plan);
    if (done.count == 0)
    {
        done.kind = kind_of_picture(*picture.input);
        done.source = picture.input->description();
        done.target = output.surface_text();
        done.first_names[0] = picture.input->files().front().path();
        done.first_names[1] = output.file_names().front();
    }
    done.last_names[0] = picture.input->files().back().path();
    done.last_names[1] = output.file_names().back();
    done.filters.insert(output.filter_name());
    ++done.count;
    progress.advance(1);
}

} // namespace

bool is_film(const Options &options)
{
    const bool input = number_pattern(options.input).has_value();
    const bool output = number_pattern(options.output).has_value();
    const bool pipe = is_pipe(options.input);
    if (input && !output && !is_pipe(options.output))
    {
        throw UsageFailure(
            "INPUT has a number in its name, for many pictures, and OUTPUT has none; "
            "give it one, as in cube_%04d.png");
    }
    if (output && !input && !pipe)
    {
        throw UsageFailure(
            "OUTPUT has a number in its name, for many pictures, and INPUT has none");
    }
    if ((options.start || options.count) && !input && !pipe)
    {
        throw UsageFailure(std::string(options.start ? "--start" : "--count") +
                           " is for films: INPUT with a number in its name, as in "
                           "frame_%04d.png, or -");
    }
    if (options.resume && (input || pipe || is_pipe(options.output)))
    {
        throw UsageFailure("--resume is for one picture in files; of a film, --start says where to "
                           "go on");
    }
    if (!options.manifest.empty() && (input || pipe || is_pipe(options.output)))
    {
        throw UsageFailure("--manifest is for one picture in files, not for films and pipes");
    }
    return input || pipe;
}

int reproject_film(const Options &options, int threads, const cm_streams &streams)
{
    keep_freed_memory();
    const auto begin = std::chrono::steady_clock::now();
    std::string text;
    {
        FilmLoop loop(options, threads, streams);
        loop.run();
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
        text = loop.result().text(taken.count());
    }
    if (!options.quiet)
    {
        print({streams.in, is_pipe(options.output) ? streams.err : streams.out, streams.err}, text);
    }
    return 0;
}
