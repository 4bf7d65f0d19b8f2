// SPDX-License-Identifier: MIT
//
// Writing the formats of stream_format.hpp, by the same functions as image files.

#ifndef CUBEMAP_TOOLS_STREAM_WRITER_HPP
#define CUBEMAP_TOOLS_STREAM_WRITER_HPP

#include "modules/image/io/image_io.h"

// create, write, finish and drop; the others are NULL. The format of the description is a name of stream_format.hpp; rows
// are of the type that the format holds, or of floats.
const cm_image_io &stream_writing();

#endif
