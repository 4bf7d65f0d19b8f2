// SPDX-License-Identifier: MIT

#include "blob_frame.hpp"

#include "check_sum.h"

#include "modules/image/io/file_words.h"

#include <cstdlib>
#include <new>

namespace
{

// The first of zstd's numbers for frames that are passed over.
constexpr std::uint32_t skippable_magic = 0x184D2A50u;
// magic, size of the rest, kind, version, bytes of the blob, sum of all that is not the sum
constexpr std::size_t head_bytes = 32;
constexpr std::size_t sum_at = 24;

std::uint64_t sum_of(const cm_store_key &key, const unsigned char *bytes, std::size_t count)
{
    std::uint64_t sum = cm_check_sum(CM_CHECK_SUM_BEGIN, key.bytes, key.count);
    sum = cm_check_sum(sum, bytes, sum_at);
    return cm_check_sum(sum, bytes + head_bytes, count - head_bytes);
}

} // namespace

const std::vector<unsigned char> &BlobFrames::pack(const cm_store_key &key, const cm_blob &blob,
                                                   int level, std::uint64_t &sum)
{
    if (!compressor)
    {
        compressor.reset(ZSTD_createCCtx());
    }
    if (!compressor)
    {
        throw std::bad_alloc();
    }
    packed.resize(head_bytes + ZSTD_compressBound(blob.count));
    ZSTD_CCtx_setParameter(compressor.get(), ZSTD_c_compressionLevel, level);
    ZSTD_CCtx_setParameter(compressor.get(), ZSTD_c_checksumFlag, 1);
    const std::size_t count = ZSTD_compress2(compressor.get(), packed.data() + head_bytes,
                                             packed.size() - head_bytes, blob.data, blob.count);
    if (ZSTD_isError(count))
    {
        throw std::bad_alloc(); // there is room for any result: nothing else can fail
    }
    packed.resize(head_bytes + count);
    cm_file_put_u32(packed.data(), skippable_magic);
    cm_file_put_u32(packed.data() + 4, head_bytes - 8);
    cm_file_put_u32(packed.data() + 8, blob.kind);
    cm_file_put_u32(packed.data() + 12, blob.version);
    cm_file_put_u64(packed.data() + 16, blob.count);
    sum = sum_of(key, packed.data(), packed.size());
    cm_file_put_u64(packed.data() + sum_at, sum);
    return packed;
}

const char *BlobFrames::unpack(const cm_store_key &key, const unsigned char *bytes,
                               std::size_t count, std::uint64_t sum, cm_blob &blob)
{
    if (count < head_bytes || cm_file_u32(bytes) != skippable_magic ||
        cm_file_u32(bytes + 4) != head_bytes - 8)
    {
        return "a blob is damaged: it has no head";
    }
    const std::uint64_t size = cm_file_u64(bytes + 16);
    if (cm_file_u64(bytes + sum_at) != sum || sum_of(key, bytes, count) != sum ||
        size > blob_bytes_most)
    {
        return "a blob is damaged: its check sum is another one";
    }
    if (!expander)
    {
        expander.reset(ZSTD_createDCtx());
    }
    const std::size_t room = static_cast<std::size_t>(size);
    std::unique_ptr<void, decltype(&std::free)> data(std::malloc(room == 0 ? 1 : room), std::free);
    if (!expander || !data)
    {
        throw std::bad_alloc();
    }
    const std::size_t made = ZSTD_decompressDCtx(expander.get(), data.get(), room,
                                                 bytes + head_bytes, count - head_bytes);
    if (ZSTD_isError(made) || made != room)
    {
        return "a blob is damaged: its frame cannot be expanded";
    }
    blob = {sizeof blob, cm_file_u32(bytes + 8), cm_file_u32(bytes + 12), data.release(), room};
    return nullptr;
}
