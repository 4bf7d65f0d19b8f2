// SPDX-License-Identifier: MIT
//
// Bands of rows that one thread computes while another writes those before.

#ifndef CUBEMAP_TOOLS_BAND_QUEUE_HPP
#define CUBEMAP_TOOLS_BAND_QUEUE_HPP

#include "memory_ceiling.hpp"
#include "pixel_memory.hpp"

#include <array>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

struct RowBand
{
    int first = 0; // rows of the picture
    int end = 0;
    PixelMemory pixels;
};

class BandQueue
{
public:
    // Each band has room for so many bytes. write is called for one band after another, in their order, by a thread
    // of its own, or in give() if there is to be none.
    BandQueue(MemoryCeiling &ceiling, std::size_t bytes, bool own_thread,
              std::function<void(const RowBand &)> write);
    // What was not written is dropped.
    ~BandQueue();
    BandQueue(const BandQueue &) = delete;
    BandQueue &operator=(const BandQueue &) = delete;

    // A band to fill, as soon as one is free. Throws what write has thrown.
    RowBand &take();
    // The band of the last take() is filled.
    void give();
    // All bands are written. Throws what write has thrown.
    void finish();

private:
    static constexpr std::size_t count = 2;

    void work();
    void rethrow();

    std::array<RowBand, count> bands;
    std::function<void(const RowBand &)> write_band;
    std::mutex mutex;
    std::condition_variable changed;
    std::size_t given = 0; // bands so far
    std::size_t written = 0;
    bool over = false;
    std::exception_ptr failure;
    std::thread writer;
};

#endif
