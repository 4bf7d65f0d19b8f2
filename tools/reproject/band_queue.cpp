// SPDX-License-Identifier: MIT

#include "band_queue.hpp"

#include <system_error>
#include <utility>

namespace
{

// Bands that are no larger stay in memory, whatever the ceiling.
constexpr std::size_t in_memory = std::size_t{32} << 20;

} // namespace

BandQueue::BandQueue(MemoryCeiling &ceiling, std::size_t bytes, bool own_thread,
                     std::function<void(const RowBand &)> write)
    : write_band(std::move(write))
{
    for (std::size_t i = 0; i < (own_thread ? count : 1); ++i)
    {
        bands[i].pixels =
            bytes > in_memory ? PixelMemory(ceiling, bytes, "a band of rows") : PixelMemory(bytes);
    }
    try
    {
        if (own_thread)
        {
            writer = std::thread(&BandQueue::work, this);
        }
    }
    catch (const std::system_error &)
    {
        // The system gives no more threads: give() writes.
    }
}

BandQueue::~BandQueue()
{
    {
        const std::lock_guard<std::mutex> lock(mutex);
        over = true;
        given = written;
    }
    changed.notify_all();
    if (writer.joinable())
    {
        writer.join();
    }
}

void BandQueue::work()
{
    std::unique_lock<std::mutex> lock(mutex);
    while (true)
    {
        changed.wait(lock, [this] { return over || (given > written && !failure); });
        if (over)
        {
            return;
        }
        const RowBand &band = bands[written % count];
        lock.unlock();
        std::exception_ptr thrown;
        try
        {
            write_band(band);
        }
        catch (...)
        {
            thrown = std::current_exception();
        }
        lock.lock();
        failure = thrown;
        ++written;
        changed.notify_all();
    }
}

void BandQueue::rethrow()
{
    if (failure)
    {
        std::rethrow_exception(failure);
    }
}

RowBand &BandQueue::take()
{
    if (!writer.joinable())
    {
        return bands[0];
    }
    std::unique_lock<std::mutex> lock(mutex);
    changed.wait(lock, [this] { return failure || given - written < count; });
    rethrow();
    return bands[given % count];
}

void BandQueue::give()
{
    if (!writer.joinable())
    {
        write_band(bands[0]);
        return;
    }
    {
        const std::lock_guard<std::mutex> lock(mutex);
        ++given;
    }
    changed.notify_all();
}

void BandQueue::finish()
{
    if (writer.joinable())
    {
        std::unique_lock<std::mutex> lock(mutex);
        changed.wait(lock, [this] { return failure || given == written; });
        rethrow();
    }
}
