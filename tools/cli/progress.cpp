// SPDX-License-Identifier: MIT

#include "progress.hpp"

#include <cstdio>
#include <string>

#include <unistd.h>

namespace
{

constexpr int bar_width = 50;
constexpr std::chrono::milliseconds interval(50);

} // namespace

Progress::Progress(std::int64_t steps, bool wanted, std::FILE *terminal)
    : stream(terminal), total(steps > 0 ? steps : 1),
      shown(wanted && fileno(terminal) >= 0 && isatty(fileno(terminal)) != 0),
      last(std::chrono::steady_clock::now())
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
    std::fprintf(stream, "\r[%s] %3d %%", bar.c_str(), static_cast<int>(done * 100 / total));
    std::fflush(stream);
}
