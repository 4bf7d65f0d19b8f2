// SPDX-License-Identifier: MIT

#include "progress.hpp"
#include "temporary_guard.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <unistd.h>

namespace
{

constexpr int bar_width = 50;
constexpr std::chrono::milliseconds interval(50);

// Before so many seconds nobody wants to know, and nobody can tell.
constexpr double seconds_least = 2;

} // namespace

std::string time_left(double part, double seconds)
{
    if (seconds < seconds_least || part < 0.01)
    {
        return "";
    }
    const double left = std::min(seconds / part - seconds, 359999.0);
    const int whole = static_cast<int>(std::ceil(left));
    char text[40];
    if (whole >= 3600)
    {
        std::snprintf(text, sizeof text, " %d:%02d:%02d left", whole / 3600, whole / 60 % 60,
                      whole % 60);
    }
    else
    {
        std::snprintf(text, sizeof text, " %d:%02d left", whole / 60, whole % 60);
    }
    return text;
}

Progress::Progress(std::int64_t steps, bool wanted, std::FILE *terminal)
    : stream(terminal), total(steps > 0 ? steps : 1),
      shown(wanted && fileno(terminal) >= 0 && isatty(fileno(terminal)) != 0),
      begin(std::chrono::steady_clock::now()), last(begin)
{
    if (shown)
    {
        draw();
    }
}

Progress::~Progress()
{
    if (shown)
    {
        std::fputs("\r\033[K", stream);
        std::fflush(stream);
    }
}

void Progress::advance(std::int64_t steps)
{
    check_held_signal();
    if (!shown)
    {
        return;
    }
    const std::lock_guard<std::mutex> lock(mutex);
    done += steps;
    const auto now = std::chrono::steady_clock::now();
    if (now - last >= interval)
    {
        last = now;
        draw();
    }
}

void Progress::draw() const
{
    const int filled = static_cast<int>(done * bar_width / total);
    const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                            std::string(static_cast<std::size_t>(bar_width - filled), '.');
    const std::chrono::duration<double> gone = last - begin;
    const double part = static_cast<double>(done) / static_cast<double>(total);
    std::fprintf(stream, "\r[%s] %3d %%%s\033[K", bar.c_str(), static_cast<int>(done * 100 / total),
                 time_left(part, gone.count()).c_str());
    std::fflush(stream);
}
