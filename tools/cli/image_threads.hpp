// SPDX-License-Identifier: MIT
//
// How many threads the image library takes while a program runs.

#ifndef CUBEMAP_TOOLS_IMAGE_THREADS_HPP
#define CUBEMAP_TOOLS_IMAGE_THREADS_HPP

// While it lives the image library takes that many threads, afterwards as many as before.
class ImageThreads
{
public:
    explicit ImageThreads(int threads);
    ~ImageThreads();
    ImageThreads(const ImageThreads &) = delete;
    ImageThreads &operator=(const ImageThreads &) = delete;

private:
    int before = 0;
    int exr_before = 0; // OpenEXR has threads of its own
};

#endif
