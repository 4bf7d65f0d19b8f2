// SPDX-License-Identifier: MIT

#include "number_pattern.hpp"
#include "program.hpp"

#include <filesystem>
#include <regex>

namespace
{

const std::regex &directive()
{
    static const std::regex expression("%(0?)([0-9]?)d");
    return expression;
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
    std::smatch found;
    if (!std::regex_search(name, found, directive()))
    {
        return std::nullopt;
    }
    NumberPattern pattern;
    pattern.before = found.prefix();
    pattern.after = found.suffix();
    pattern.zeros = found[1].length() > 0;
    pattern.width = found[2].length() > 0 ? static_cast<unsigned>(std::stoi(found[2])) : 0;
    if (pattern.after.find('/') != std::string::npos)
    {
        throw UsageFailure(in_quotes(name) + " has its number in the name of a folder; it must be "
                                             "in the name of the file");
    }
    if (std::regex_search(pattern.after, directive()))
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
