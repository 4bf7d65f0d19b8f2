// SPDX-License-Identifier: MIT
//
// A progress bar on the terminal.

#ifndef CUBEMAP_TOOLS_PROGRESS_HPP
#define CUBEMAP_TOOLS_PROGRESS_HPP

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <string>

// Draws a bar on a stream if that is a terminal and the bar is wanted, with the time that is left once two seconds have
// gone; takes it away at its end.
class Progress
{
public:
    Progress(std::int64_t steps, bool wanted, std::FILE *terminal);
    ~Progress();
    Progress(const Progress &) = delete;
    Progress &operator=(const Progress &) = delete;

    // So many further steps are done. May be called from any thread. Failure if a signal is put off.
    void advance(std::int64_t steps);

private:
    void draw() const;

    std::FILE *const stream;
    const std::int64_t total;
    const bool shown;
    std::int64_t done = 0;
    const std::chrono::steady_clock::time_point begin;
    std::chrono::steady_clock::time_point last;
    std::mutex mutex;
};

// " 1:05 left", " 2:03:09 left" if a part of all, from 0 to 1, took so many seconds; "" as long as nobody can tell.
std::string time_left(double part, double seconds);

#endif
