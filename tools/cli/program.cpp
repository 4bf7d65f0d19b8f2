// SPDX-License-Identifier: MIT

#include "program.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <new>

#include <cubemap/number.h>

ArgumentReader::ArgumentReader(int argc, char **argv) : arguments(argv + (argc > 0), argv + argc)
{
}

bool ArgumentReader::next()
{
    if (has_attached)
    {
        throw UsageFailure(current + " takes no value; see --help");
    }
    if (!only_operands && position < arguments.size() && arguments[position] == "--")
    {
        only_operands = true;
        ++position;
    }
    if (position == arguments.size())
    {
        return false;
    }
    current = arguments[position++];
    option = !only_operands && current.size() > 1 && current[0] == '-';
    const std::size_t equals = current.find('=');
    if (option && equals != std::string::npos)
    {
        attached = current.substr(equals + 1);
        current.erase(equals);
        has_attached = true;
    }
    return true;
}

std::string ArgumentReader::value()
{
    if (has_attached)
    {
        has_attached = false;
        return attached;
    }
    if (position == arguments.size())
    {
        throw UsageFailure(current + " needs a value; see --help");
    }
    return arguments[position++];
}

std::int64_t ArgumentReader::whole_number(std::int64_t low, std::int64_t high)
{
    const std::string text = value();
    std::int64_t number = 0;
    const char *const end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, number);
    if (result.ec != std::errc() || result.ptr != end || number < low || number > high)
    {
        throw UsageFailure(current + ": " + in_quotes(text) + " is not a whole number from " +
                           std::to_string(low) + " to " + std::to_string(high));
    }
    return number;
}

double ArgumentReader::not_negative_number()
{
    const std::string text = value();
    const std::optional<double> number = read_number(text);
    if (!number || *number < 0)
    {
        throw UsageFailure(current + ": " + in_quotes(text) + " is not a number of 0 or more");
    }
    return *number;
}

std::size_t ArgumentReader::word(const std::vector<std::string> &words)
{
    const std::string text = value();
    std::string list;
    for (std::size_t i = 0; i < words.size(); ++i)
    {
        if (words[i] == text)
        {
            return i;
        }
        list += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
    }
    throw UsageFailure(current + ": " + in_quotes(text) + " is not " + list);
}

std::optional<double> read_number(const std::string &text)
{
    double number = 0;
    if (cm_number_parse(text.data(), text.size(), &number) == 0 || !std::isfinite(number))
    {
        return std::nullopt;
    }
    return number;
}

std::string in_quotes(const std::string &text)
{
    std::string result = "'" + text + "'";
    for (char &letter : result)
    {
        if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f)
        {
            letter = '?';
        }
    }
    return result;
}

std::string first_line(const std::string &text)
{
    std::string line = text.substr(0, text.find_first_of("\r\n"));
    while (!line.empty() && (line.back() == '.' || line.back() == ' '))
    {
        line.pop_back();
    }
    return line;
}

void print(const cm_streams &streams, const std::string &text)
{
    if (std::fwrite(text.data(), 1, text.size(), streams.out) != text.size() ||
        std::fflush(streams.out) != 0)
    {
        throw Failure(std::string("standard output: ") + std::strerror(errno));
    }
}

int run_program(const std::string &name, const cm_streams &streams,
                const std::function<int()> &body)
{
    std::string text;
    int status = exit_failure;
    try
    {
        return body();
    }
    catch (const Failure &failure)
    {
        text = failure.what();
        status = failure.exit_status();
    }
    catch (const std::bad_alloc &)
    {
        text = "not enough memory; a smaller image or --size needs less";
    }
    catch (const std::exception &exception)
    {
        text = first_line(exception.what());
    }
    // whatever words of a user are in it: nothing that ends the line or that a terminal acts upon
    const auto is_control = [](unsigned char byte) { return byte < ' ' || byte == 0x7f; };
    std::replace_if(text.begin(), text.end(), is_control, '?');
    std::fprintf(streams.err, "%s: %s\n", name.c_str(), text.c_str());
    return status;
}
