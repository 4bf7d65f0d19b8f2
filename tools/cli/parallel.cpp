// SPDX-License-Identifier: MIT

#include "parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace
{

class Loop
{
public:
    Loop(int end, const std::function<void(int)> &function) : count(end), body(function)
    {
    }

    void work() noexcept
    {
        for (int i = next++; i < count && !failed; i = next++)
        {
            try
            {
                body(i);
            }
            catch (...)
            {
                const std::lock_guard<std::mutex> lock(mutex);
                if (!failed.exchange(true))
                {
                    failure = std::current_exception();
                }
            }
        }
    }

    void rethrow() const
    {
        if (failure)
        {
            std::rethrow_exception(failure);
        }
    }

private:
    const int count;
    const std::function<void(int)> &body;
    std::atomic<int> next{0};
    std::atomic<bool> failed{false};
    std::mutex mutex;
    std::exception_ptr failure;
};

} // namespace

int thread_count(int requested)
{
    return requested > 0 ? requested
                         : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void parallel_for(int count, int threads, const std::function<void(int)> &body)
{
    Loop loop(count, body);
    std::vector<std::thread> helpers;
    try
    {
        for (int i = 1; i < std::min(threads, count); ++i)
        {
            helpers.emplace_back(&Loop::work, &loop);
        }
    }
    catch (const std::system_error &)
    {
        // The system gives no more threads: those that run do all the work.
    }
    loop.work();
    for (std::thread &helper : helpers)
    {
        helper.join();
    }
    loop.rethrow();
}
