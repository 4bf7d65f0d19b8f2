// SPDX-License-Identifier: MIT

#include "number_pattern.hpp"
#include "program.hpp"

#include <filesystem>

namespace
{

// Where %d, %4d or %04d stands in a name, and how long it is; npos if it has none.
struct Directive
{
    std::size_t begin = std::string::npos;
    std::size_t length = 0;
    bool zeros = false;
    unsigned width = 0;
};

bool is_digit(char letter)
{
    return letter >= '0' && letter <= '9';
}

Directive find_directive(const std::string &name)
{
    for (std::size_t begin = name.find('%'); begin != std::string::npos;
         begin = name.find('%', begin + 1))
    {
        Directive found;
        std::size_t at = begin + 1;
        found.zeros = at < name.size() && name[at] == '0';
        at += found.zeros ? 1 : 0;
        if (at < name.size() && is_digit(name[at]))
        {
            found.width = static_cast<unsigned>(name[at++] - '0');
        }
        if (at < name.size() && name[at] == 'd')
        {
            found.begin = begin;
            found.length = at + 1 - begin;
            return found;
        }
    }
    return {};
}

// The number that such a name has, -1 if it has none.
int number_of(const NumberPattern &pattern, const std::string &name)
{
    const std::size_t ends = pattern.before.size() + pattern.after.size();
    if (name.size() <= ends || name.compare(0, pattern.before.size(), pattern.before) != 0)
    {
        return -1;
    }
    std::string digits = name.substr(pattern.before.size(), name.size() - ends);
    digits.erase(0, digits.find_first_not_of(' '));
    if (digits.empty() || digits.size() > 9 ||
        digits.find_first_not_of("0123456789") != std::string::npos)
    {
        return -1;
    }
    const int number = std::stoi(digits);
    return pattern.name(number) == name ? number : -1;
}

} // namespace

std::string NumberPattern::name(int number) const
{
    const std::string digits = std::to_string(number);
    const std::size_t fill = digits.size() < width ? width - digits.size() : 0;
    return before + std::string(fill, zeros ? '0' : ' ') + digits + after;
}

std::optional<NumberPattern> number_pattern(const std::string &name)
{
    const Directive found = find_directive(name);
    if (found.begin == std::string::npos)
    {
        return std::nullopt;
    }
    NumberPattern pattern;
    pattern.before = name.substr(0, found.begin);
    pattern.after = name.substr(found.begin + found.length);
    pattern.zeros = found.zeros;
    pattern.width = found.width;
    if (pattern.after.find('/') != std::string::npos)
    {
        throw UsageFailure(in_quotes(name) + " has its number in the name of a folder; it must be "
                                             "in the name of the file");
    }
    if (find_directive(pattern.after).begin != std::string::npos)
    {
        throw UsageFailure(in_quotes(name) + " has two numbers; one is needed");
    }
    return pattern;
}

std::set<int> present_numbers(const NumberPattern &pattern)
{
    const std::filesystem::path begin(pattern.before);
    const std::filesystem::path folder = begin.parent_path().empty() ? "." : begin.parent_path();
    NumberPattern file = pattern;
    file.before = begin.filename().string();
    std::set<int> numbers;
    std::error_code error;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error))
    {
        const int number = number_of(file, entry->path().filename().string());
        if (number >= 0)
        {
            numbers.insert(number);
        }
    }
    return numbers;
}
