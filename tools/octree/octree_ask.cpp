// SPDX-License-Identifier: MIT
//
// cubemap-octree query and ray: a line of numbers, a line of what is there.

#include "octree_command.hpp"
#include "octree_map.hpp"
#include "octree_table.h"

#include <array>
#include <cmath>
#include <cstring>

namespace
{

constexpr std::size_t longest_question = 4096;

struct AskOptions
{
    std::string map;
    std::uint64_t memory = 0;
    int level = 0;
    double far = 0;
    bool printed = false;
};

AskOptions parse_ask_options(const cm_command &command, int argc, char **argv,
                             const cm_streams &streams)
{
    AskOptions options;
    OptionReader reader(command, argc, argv, streams);
    while (const int id = reader.next())
    {
        switch (id)
        {
        case OCTREE_LEVEL:
            options.level = reader.whole_number();
            break;
        case OCTREE_FAR:
            options.far = reader.number();
            break;
        default:
            options.memory = read_memory(reader);
            break;
        }
    }
    options.printed = reader.printed();
    if (!options.printed)
    {
        options.map = needed_operands(reader, 1, "MAP").front();
    }
    return options;
}

// Lines of standard input, without their ends.
class QuestionReader
{
public:
    explicit QuestionReader(std::FILE *from) : file(from)
    {
    }

    bool next()
    {
        line.clear();
        int letter = std::getc(file); // bytes of 0, which are no number, end no line
        while (letter != EOF && letter != '\n' && line.size() <= longest_question)
        {
            line.push_back(static_cast<char>(letter));
            letter = std::getc(file);
        }
        if (std::ferror(file) != 0)
        {
            throw Failure("standard input cannot be read");
        }
        if (letter == EOF && line.empty())
        {
            return false;
        }
        ++number;
        if (line.size() > longest_question)
        {
            wrong("is too long");
        }
        while (!line.empty() && (line.back() == '\n' || line.back() == '\r'))
        {
            line.pop_back();
        }
        return true;
    }

    // Of a blank line or a comment nothing is asked.
    bool is_question() const
    {
        const std::size_t begin = line.find_first_not_of(" \t");
        return begin != std::string::npos && line[begin] != '#';
    }

    template <std::size_t count> std::array<double, count> numbers(const char *wanted) const
    {
        std::array<double, count> found = {};
        std::size_t at = 0;
        for (double &each : found)
        {
            const std::size_t begin = line.find_first_not_of(" \t,", at);
            at = begin == std::string::npos ? begin : line.find_first_of(" \t,", begin);
            const std::optional<double> value = begin == std::string::npos
                                                    ? std::nullopt
                                                    : read_number(line.substr(begin, at - begin));
            if (!value)
            {
                wrong(std::string("is not ") + wanted);
            }
            each = *value;
        }
        if (at != std::string::npos && line.find_first_not_of(" \t,", at) != std::string::npos)
        {
            wrong(std::string("is not ") + wanted);
        }
        return found;
    }

    std::string line;

private:
    [[noreturn]] void wrong(const std::string &what) const
    {
        throw Failure("standard input, line " + std::to_string(number) + ": " +
                      in_quotes(line.substr(0, 60)) + " " + what);
    }

    std::FILE *file;
    std::uint64_t number = 0;
};

// Answers in pieces. What was answered before a wrong line is written.
class AnswerWriter
{
public:
    explicit AnswerWriter(const cm_streams &to) : streams(to)
    {
    }
    void add(const std::string &line)
    {
        text += line + "\n";
        if (text.size() >= 1 << 16)
        {
            flush();
        }
    }
    void flush()
    {
        print(streams, text);
        text.clear();
    }

private:
    const cm_streams &streams;
    std::string text;
};

std::string color_words(const cm_voxel &voxel)
{
    return " " + std::to_string(voxel.color[0]) + " " + std::to_string(voxel.color[1]) + " " +
           std::to_string(voxel.color[2]);
}

template <typename Answer> void answer_all(const cm_streams &streams, const Answer &answer)
{
    QuestionReader questions(streams.in);
    AnswerWriter answers(streams);
    try
    {
        while (questions.next())
        {
            answers.add(questions.is_question() ? answer(questions) : questions.line);
        }
    }
    catch (const Failure &)
    {
        answers.flush();
        throw;
    }
    answers.flush();
}

// ---- parts of a map that are read when they are asked for

int pass_by(void *, const cm_voxel *)
{
    return 0;
}

// An answer of nothing cannot say that a part of the map could not be read; walks over the same places can.
void check_around(const OctreeMap &open, const AskOptions &options,
                  const std::array<double, 3> &point)
{
    if (open.store == nullptr)
    {
        return;
    }
    const double reach = std::ldexp(cm_octree_describe(open.map.get())->edge, options.level);
    std::array<double, 3> least = point, greatest = point;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
        least[axis] -= reach;
        greatest[axis] += reach;
    }
    check_map(cm_octree_walk_box(open.map.get(), least.data(), greatest.data(), pass_by, nullptr),
              in_quotes(options.map), open.store.get());
}

void check_along(const OctreeMap &open, const AskOptions &options, const std::array<double, 6> &ray)
{
    if (open.store != nullptr)
    {
        check_map(cm_octree_walk_ray(open.map.get(), ray.data(), ray.data() + 3, options.far,
                                     pass_by, nullptr),
                  in_quotes(options.map), open.store.get());
    }
}

} // namespace

int query_octree(int argc, char **argv, const cm_streams &streams)
{
    const AskOptions options = parse_ask_options(octree_query_command, argc, argv, streams);
    if (options.printed)
    {
        return 0;
    }
    const OctreeMap open = open_map(options.map, options.memory);
    check_level(options.level, open.map.get(), options.map);
    answer_all(streams,
               [&](const QuestionReader &question)
               {
                   static const char *const states[] = {"unknown ", "free ", "occupied "};
                   const auto point = question.numbers<3>("three numbers x y z");
                   cm_voxel voxel = {};
                   const int state =
                       cm_octree_at(open.map.get(), point.data(), options.level, &voxel);
                   if (voxel.edge == 0)
                   {
                       check_around(open, options, point);
                   }
                   return states[state] + json_number(voxel.edge) + color_words(voxel);
               });
    return 0;
}

int cast_octree_rays(int argc, char **argv, const cm_streams &streams)
{
    const AskOptions options = parse_ask_options(octree_ray_command, argc, argv, streams);
    if (options.printed)
    {
        return 0;
    }
    const OctreeMap open = open_map(options.map, options.memory);
    answer_all(streams,
               [&](const QuestionReader &question)
               {
                   const auto ray = question.numbers<6>("six numbers ox oy oz dx dy dz");
                   cm_voxel voxel = {};
                   const int met = cm_octree_ray(open.map.get(), ray.data(), ray.data() + 3,
                                                 options.far, &voxel);
                   if (met == 0)
                   {
                       check_along(open, options, ray);
                   }
                   return met != 0 ? json_number(voxel.distance) + color_words(voxel)
                                   : std::string("none");
               });
    return 0;
}
