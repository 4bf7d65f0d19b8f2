// SPDX-License-Identifier: MIT

#include "program.hpp"
#include "option_text.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <new>

#include <cubemap/number.h>

OptionReader::OptionReader(const cm_command &command, int argc, char **argv,
                           const cm_streams &streams)
    : reader(cm_options_begin(&command, argc, argv, &streams)), output(streams)
{
}

int OptionReader::next()
{
    const int id = cm_options_next(&reader);
    if (id == CM_OPTIONS_WRONG)
    {
        throw UsageFailure(reader.message);
    }
    if (id == CM_OPTIONS_PRINTED)
    {
        print(output, "");
        nothing_else = true;
    }
    if (id <= 0)
    {
        return 0;
    }
    check_number();
    return id;
}

void OptionReader::check_number()
{
    const bool whole = reader.option->kind == CM_OPTION_WHOLE;
    if (!whole && reader.option->kind != CM_OPTION_NUMBER)
    {
        return;
    }
    const std::string digits = text();
    if (whole ? digits.find_first_not_of("0123456789") != std::string::npos
              : !std::isfinite(reader.number))
    {
        char range[OPTION_RANGE_MAX];
        option_range(reader.option, range);
        refuse(range);
    }
}

std::string OptionReader::name() const
{
    return std::string("--") + reader.option->name;
}

std::string OptionReader::as_written() const
{
    return name() + (reader.text == nullptr ? std::string() : "=" + text());
}

void OptionReader::refuse(const std::string &what)
{
    cm_options_refuse(&reader, what.c_str());
    throw UsageFailure(reader.message);
}

std::vector<std::string> OptionReader::operands() const
{
    return std::vector<std::string>(reader.operands, reader.operands + reader.operand_count);
}

std::string suggestion(const cm_nearest &nearest)
{
    char text[200] = "";
    cm_nearest_append(&nearest, text, sizeof text);
    return text;
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
        std::fflush(streams.out) != 0 || std::ferror(streams.out) != 0)
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
