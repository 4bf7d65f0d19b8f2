// SPDX-License-Identifier: MIT
//
// A blob as bytes: a skippable frame of zstd (RFC 8878, section 3.1.2) with kind, version, size and check sum, then one frame
// of zstd with the blob. The program zstd -d makes the blob of them.

#ifndef CUBEMAP_MODULES_SCENE_BLOB_FRAME_HPP
#define CUBEMAP_MODULES_SCENE_BLOB_FRAME_HPP

#include <cubemap/store.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <zstd.h>

// Larger blobs are refused: SQLite takes 10^9 bytes.
constexpr std::size_t blob_bytes_most = 900000000;

class BlobFrames
{
public:
    BlobFrames() = default;

    // The bytes for a blob under a key, and their sum; std::bad_alloc.
    const std::vector<unsigned char> &pack(const cm_store_key &key, const cm_blob &blob, int level,
                                           std::uint64_t &sum);
    // The blob of bytes, whose data are from malloc; null if all is well, else what is wrong. std::bad_alloc.
    const char *unpack(const cm_store_key &key, const unsigned char *bytes, std::size_t count,
                       std::uint64_t sum, cm_blob &blob);

private:
    std::vector<unsigned char> packed;
    std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> compressor{nullptr, ZSTD_freeCCtx};
    std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> expander{nullptr, ZSTD_freeDCtx};
};

#endif
