// SPDX-License-Identifier: MIT
//
// What the image programs share: failures with their exit status, reading arguments, the last
// resort around all.

#ifndef CUBEMAP_TOOLS_PROGRAM_HPP
#define CUBEMAP_TOOLS_PROGRAM_HPP

#include "tools/cli/streams.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

inline constexpr int exit_failure = 1;
inline constexpr int exit_usage = 2;

// Ends the program with one line on stderr. The text says what is wrong with which argument or
// file and what would be right; no full stop.
class Failure : public std::runtime_error
{
public:
    explicit Failure(const std::string &text, int exit_status = exit_failure)
        : std::runtime_error(text), status(exit_status)
    {
    }

    int exit_status() const noexcept
    {
        return status;
    }

private:
    int status;
};

class UsageFailure : public Failure
{
public:
    explicit UsageFailure(const std::string &text) : Failure(text, exit_usage)
    {
    }
};

// Goes through a command line: "--name value", "--name=value", operands, and "--" after which all
// are operands.
class ArgumentReader
{
public:
    ArgumentReader(int argc, char **argv);

    // Goes to the next option or operand; false after the last. UsageFailure if the option before
    // was given a value that nobody asked for.
    bool next();

    bool is_option() const noexcept
    {
        return option;
    }

    // The option's name with its dashes, or the operand.
    const std::string &text() const noexcept
    {
        return current;
    }

    // The option's value; UsageFailure if there is none.
    std::string value();

    // The option's value as a whole number from low to high; UsageFailure if it is not one.
    std::int64_t whole_number(std::int64_t low, std::int64_t high);

    // The option's value as a finite number that is not negative; UsageFailure if it is not one.
    double not_negative_number();

    // The index of the option's value among these words; UsageFailure if it is none of them.
    std::size_t word(const std::vector<std::string> &words);

private:
    std::vector<std::string> arguments;
    std::size_t position = 0;
    std::string current;
    std::string attached; // VALUE of --name=VALUE
    bool option = false;
    bool has_attached = false;
    bool only_operands = false;
};

// The finite number that the whole text is, with a point in every locale.
std::optional<double> read_number(const std::string &text);

// "'name'", with control characters replaced by '?', so that a message stays on one line.
std::string in_quotes(const std::string &text);

// The first line of a library's message, without a full stop at its end.
std::string first_line(const std::string &text);

// Writes to standard output and flushes; Failure if that cannot be done.
void print(const cm_streams &streams, const std::string &text);

// Runs body; an exception becomes a line "NAME: TEXT" on standard error. Returns the
// exit status.
int run_program(const std::string &name, const cm_streams &streams,
                const std::function<int()> &body);

#endif
