// SPDX-License-Identifier: MIT
//
// What the image programs share: failures with their exit status, reading options, the last
// resort around all.

#ifndef CUBEMAP_TOOLS_PROGRAM_HPP
#define CUBEMAP_TOOLS_PROGRAM_HPP

#include "nearest.h"
#include "option_table.h"

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

// Goes through a command line by the program's table of options.
class OptionReader
{
public:
    // All of these must outlive the reader.
    OptionReader(const cm_command &command, int argc, char **argv, const cm_streams &streams);

    // Goes to the next option: its id; 0 behind the last, and where --help or the like was printed.
    // UsageFailure if it is wrong. A whole number must be written in digits, any number be finite.
    int next();

    // Was something printed, so that nothing else is to be done?
    bool printed() const noexcept
    {
        return nothing_else;
    }

    // The option's argument, and what it stands for.
    std::string text() const
    {
        return reader.text;
    }
    double number() const noexcept
    {
        return reader.number;
    }
    int whole_number() const noexcept
    {
        return static_cast<int>(reader.number);
    }
    std::size_t choice() const noexcept
    {
        return reader.choice;
    }

    // The option as a user writes it: --NAME.
    std::string name() const;

    // The same with its argument, if it has one: --NAME=TEXT.
    std::string as_written() const;

    // UsageFailure: "--NAME is 'TEXT', not WHAT".
    [[noreturn]] void refuse(const std::string &what);

    // Behind the last option.
    std::vector<std::string> operands() const;

private:
    void check_number();

    cm_option_reader reader;
    const cm_streams &output;
    bool nothing_else = false;
};

// "; did you mean WORD?"; "" if no word is like what was written.
std::string suggestion(const cm_nearest &nearest);

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
