// SPDX-License-Identifier: MIT
//
// A loop over several threads.

#ifndef CUBEMAP_TOOLS_PARALLEL_HPP
#define CUBEMAP_TOOLS_PARALLEL_HPP

#include <functional>

// The number of threads that a request stands for: 0 means one for each core.
int thread_count(int requested);

// Calls body(i) once for each i in 0 ... count - 1, from at most that many threads, the caller's
// own among them. An exception of body stops the loop and comes out of this call.
void parallel_for(int count, int threads, const std::function<void(int)> &body);

#endif
