// SPDX-License-Identifier: MIT
//
// A progress bar on the terminal.

#ifndef CUBEMAP_TOOLS_PROGRESS_HPP
#define CUBEMAP_TOOLS_PROGRESS_HPP

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <mutex>

// Draws a bar on a stream if that is a terminal and the bar is wanted; takes it away at its end.
class Progress
{
public:
    Progress(std::int64_t steps, bool wanted, std::FILE *terminal);
    ~Progress();
    Progress(const Progress &) = delete;
    Progress &operator=(const Progress &) = delete;

    // So many further steps are done. May be called from any thread.
    void advance(std::int64_t steps);

private:
    void draw() const;

    std::FILE *const stream;
    const std::int64_t total;
    const bool shown;
    std::int64_t done = 0;
    std::chrono::steady_clock::time_point last;
    std::mutex mutex;
};

#endif
