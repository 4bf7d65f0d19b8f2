// SPDX-License-Identifier: MIT

#include "octomap_file.h"

#include "modules/image/io/file_words.h"
#include "modules/octree/block_access.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <cubemap/number.h>

namespace
{

constexpr int octomap_levels = 16;
constexpr int block_level = 3; // of a block of 8 voxels
// Larger voxels that are occupied have no colour, so that a file of some bytes cannot ask for all of memory.
constexpr int largest_colored = 5;
constexpr double standard_low = -2.0;
constexpr double standard_high = 3.5;
constexpr std::uint8_t unknown = 127;

class OctomapFailure : public std::runtime_error
{
public:
    explicit OctomapFailure(const std::string &text, cm_status why = CM_ERROR_DATA)
        : std::runtime_error(text), status(why)
    {
    }
    const cm_status status;
};

void check(cm_status status)
{
    if (status == CM_ERROR_MEMORY)
    {
        throw std::bad_alloc();
    }
    if (status != CM_OK)
    {
        throw OctomapFailure(cm_status_text(status), status);
    }
}

// ---- the head

struct OctomapHead
{
    bool is_binary = false; // .bt
    std::string id;
    std::uint64_t size = 0; // nodes
    double edge = 0;
};

// Words and lines of the text before the data.
class HeadText
{
public:
    explicit HeadText(std::string_view all) : text(all)
    {
    }

    std::string_view line()
    {
        const std::size_t end = text.find('\n', at);
        if (end == std::string_view::npos)
        {
            throw OctomapFailure("ends in its head");
        }
        const std::string_view found = text.substr(at, end - at);
        at = end + 1;
        return found;
    }
    std::size_t place() const
    {
        return at;
    }

private:
    std::string_view text;
    std::size_t at = 0;
};

std::string_view without_blanks(std::string_view text)
{
    const std::size_t begin = text.find_first_not_of(" \t\r");
    const std::size_t end = text.find_last_not_of(" \t\r");
    return begin == std::string_view::npos ? std::string_view()
                                           : text.substr(begin, end - begin + 1);
}

double edge_of(std::string_view word)
{
    double edge = 0;
    if (cm_number_parse(word.data(), word.size(), &edge) == 0 || !(edge > 0) ||
        !std::isnormal(edge))
    {
        throw OctomapFailure("its res is no length above 0");
    }
    return edge;
}

std::uint64_t size_of(std::string_view word)
{
    std::uint64_t size = 0;
    for (const char each : word)
    {
        if (each < '0' || each > '9' || size > 1000000000000000000u)
        {
            throw OctomapFailure("its size is no number of nodes");
        }
        size = 10 * size + static_cast<std::uint64_t>(each - '0');
    }
    return size;
}

OctomapHead read_head(HeadText &text)
{
    OctomapHead head;
    const std::string_view first = text.line();
    head.is_binary = first.rfind("# Octomap OcTree binary file", 0) == 0;
    if (!head.is_binary && first.rfind("# Octomap OcTree file", 0) != 0)
    {
        throw OctomapFailure("is no map of OctoMap");
    }
    bool has_size = false;
    for (;;)
    {
        const std::string_view line = without_blanks(text.line());
        const std::size_t blank = std::min(line.find_first_of(" \t"), line.size());
        const std::string_view key = line.substr(0, blank);
        const std::string_view value = without_blanks(line.substr(blank));
        if (key == "data")
        {
            break;
        }
        if (key == "res")
        {
            head.edge = edge_of(value);
        }
        else if (key == "size")
        {
            head.size = size_of(value);
            has_size = !value.empty();
        }
        else if (key == "id")
        {
            head.id = value;
        }
    }
    if (!has_size || head.edge == 0)
    {
        throw OctomapFailure("has no size or no res in its head");
    }
    return head;
}

// ---- the nodes

struct VoxelValue
{
    std::uint8_t alpha = unknown;
    std::array<std::uint8_t, 3> color = {};
    bool has_color = false;
};

struct NodePlace
{
    std::array<std::int64_t, 3> corner;
    int level;

    NodePlace child(int i) const
    {
        const std::int64_t half = std::int64_t{1} << (level - 1);
        return {{corner[0] + (i & 1) * half, corner[1] + ((i >> 1) & 1) * half,
                 corner[2] + ((i >> 2) & 1) * half},
                level - 1};
    }
};

// Takes voxels in the order of keys, and gives the map whole blocks.
class MapFiller
{
public:
    MapFiller(cm_octree *to, bool colors) : map(to), has_color(colors)
    {
        clear();
    }

    void leaf(const NodePlace &place, const VoxelValue &value)
    {
        if (place.level < block_level)
        {
            put(place, value);
        }
        else if (place.level > block_level && place.level <= largest_colored && value.has_color)
        {
            for (int i = 0; i < 8; ++i)
            {
                leaf(place.child(i), value);
            }
        }
        else if (place.level == block_level && value.has_color)
        {
            put(place, value);
            end_block();
        }
        else
        {
            check(cm_octree_set_cube(map, place.corner.data(), place.level, value.alpha));
        }
    }

    // After the last voxel of a block.
    void end_block()
    {
        if (any)
        {
            check(cm_octree_set_block(map, corner.data(), alpha.data(),
                                      has_color ? color.data() : nullptr));
            clear();
        }
    }

private:
    // Voxels of a level are one after another in the order of keys.
    void put(const NodePlace &place, const VoxelValue &value)
    {
        std::size_t first = 0;
        for (int bit = 0; bit < 3; ++bit)
        {
            for (std::size_t axis = 0; axis < 3; ++axis)
            {
                const auto inside = static_cast<std::size_t>(place.corner[axis] & 7);
                first |= ((inside >> bit) & 1) << (3 * static_cast<std::size_t>(bit) + axis);
            }
        }
        const std::size_t count = std::size_t{1} << 3 * place.level;
        std::fill_n(alpha.begin() + static_cast<std::ptrdiff_t>(first), count, value.alpha);
        for (std::size_t i = first; i < first + count; ++i)
        {
            if (value.has_color)
            {
                std::copy(value.color.begin(), value.color.end(), color[i]);
            }
        }
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            corner[axis] = place.corner[axis] & ~std::int64_t{7};
        }
        any = true;
    }

    void clear()
    {
        alpha.fill(unknown);
        std::memset(color.data(), 0, sizeof color);
        any = false;
    }

    cm_octree *map;
    bool has_color;
    bool any = false;
    std::array<std::int64_t, 3> corner = {};
    std::array<std::uint8_t, CM_BLOCK_CELLS> alpha;
    std::array<std::uint8_t[3], CM_BLOCK_CELLS> color;
};

std::uint8_t alpha_of(double log_odds)
{
    const double steps =
        std::round(std::clamp(log_odds, standard_low, standard_high) * 127.0 / 3.5);
    if (log_odds >= 0)
    {
        return static_cast<std::uint8_t>(127 + std::max(1, static_cast<int>(steps)));
    }
    return static_cast<std::uint8_t>(127 + std::min(-1, static_cast<int>(steps)));
}

class OctomapReader
{
public:
    OctomapReader(const OctomapHead &from, const unsigned char *begin, const unsigned char *last,
                  MapFiller &to)
        : head(from), at(begin), end(last), filler(to)
    {
        // times of OcTreeStamped are not written
        value_bytes = head.id == "ColorOcTree" ? 7 : 4;
    }

    void read()
    {
        const std::int64_t half = std::int64_t{1} << (octomap_levels - 1);
        const NodePlace root = {{-half, -half, -half}, octomap_levels};
        if (head.size > 0)
        {
            count(1);
            if (head.is_binary && head.size == 1)
            {
                read_root_leaf(root);
            }
            else
            {
                head.is_binary ? read_bits(root) : read_values(root);
            }
        }
        if (counted != head.size)
        {
            throw OctomapFailure("says it has " + std::to_string(head.size) + " nodes, and has " +
                                 std::to_string(counted));
        }
        if (at != end)
        {
            throw OctomapFailure("goes on behind its last node");
        }
    }

private:
    void count(std::uint64_t nodes)
    {
        counted += nodes;
        if (counted > head.size)
        {
            throw OctomapFailure("has more than the " + std::to_string(head.size) +
                                 " nodes that it says");
        }
    }

    const unsigned char *take(std::size_t bytes)
    {
        if (static_cast<std::size_t>(end - at) < bytes)
        {
            throw OctomapFailure("is cut: it ends within its nodes");
        }
        at += bytes;
        return at - bytes;
    }

    // Bits are of children alone. Where the root has none, all is occupied: OctoMap reads it so, and writes so what is.
    void read_root_leaf(const NodePlace &root)
    {
        const unsigned char *const bytes = take(2);
        count(bytes[0] != 0 || bytes[1] != 0 ? 1 : 0);
        VoxelValue value;
        value.alpha = alpha_of(standard_high);
        filler.leaf(root, value);
    }

    void read_bits(const NodePlace &place)
    {
        if (place.level == 0)
        {
            throw OctomapFailure("has nodes below its finest voxels");
        }
        const unsigned char *const bytes = take(2);
        const unsigned codes = static_cast<unsigned>(bytes[0] | bytes[1] << 8);
        for (int i = 0; i < 8; ++i)
        {
            const unsigned code = (codes >> 2 * i) & 3;
            count(code == 0 ? 0 : 1);
        }
        for (int i = 0; i < 8; ++i)
        {
            const unsigned code = (codes >> 2 * i) & 3;
            if (code == 1 || code == 2)
            {
                VoxelValue value;
                value.alpha = alpha_of(code == 1 ? standard_low : standard_high);
                filler.leaf(place.child(i), value);
            }
            else if (code == 3)
            {
                read_bits(place.child(i));
            }
        }
        if (place.level == block_level)
        {
            filler.end_block();
        }
    }

    void read_values(const NodePlace &place)
    {
        const unsigned char *const bytes = take(value_bytes + 1);
        const unsigned children = bytes[value_bytes];
        if (children == 0)
        {
            filler.leaf(place, value_of(bytes));
            return;
        }
        if (place.level == 0)
        {
            throw OctomapFailure("has nodes below its finest voxels");
        }
        for (int i = 0; i < 8; ++i)
        {
            if ((children >> i & 1) != 0)
            {
                count(1);
                read_values(place.child(i));
            }
        }
        if (place.level == block_level)
        {
            filler.end_block();
        }
    }

    VoxelValue value_of(const unsigned char *bytes) const
    {
        const std::uint32_t bits = cm_file_u32(bytes);
        float log_odds = 0;
        static_assert(sizeof bits == sizeof log_odds, "floats of 32 bits");
        std::memcpy(&log_odds, &bits, sizeof bits);
        if (!std::isfinite(log_odds))
        {
            throw OctomapFailure("has a value that is not finite");
        }
        VoxelValue value;
        value.alpha = alpha_of(static_cast<double>(log_odds));
        if (head.id == "ColorOcTree" && value.alpha > unknown)
        {
            std::copy(bytes + 4, bytes + 7, value.color.begin());
            value.has_color = true; // white, if it was given none
        }
        return value;
    }

    const OctomapHead &head;
    const unsigned char *at;
    const unsigned char *end;
    MapFiller &filler;
    std::size_t value_bytes;
    std::uint64_t counted = 0;
};

using OctreeOwner = std::unique_ptr<cm_octree, void (*)(cm_octree *)>;

OctreeOwner empty_map(const OctomapHead &head)
{
    cm_octree_options options = {};
    options.size = sizeof options;
    options.edge = head.edge;
    options.levels = octomap_levels;
    options.rule = CM_OCTREE_LOG_ODDS;
    options.hit = 0.85; // of the probabilities 0.7 and 0.4
    options.miss = -0.4;
    options.low = standard_low;
    options.high = standard_high;
    options.color = !head.is_binary && head.id == "ColorOcTree" ? 1 : 0;
    cm_octree *map = nullptr;
    const cm_status status = cm_octree_create(&options, &map);
    if (status == CM_ERROR_RANGE)
    {
        throw OctomapFailure("its res is no edge of a map");
    }
    check(status);
    return OctreeOwner(map, cm_octree_destroy);
}

cm_octree *read_map(const unsigned char *bytes, std::size_t count)
{
    HeadText text(std::string_view(reinterpret_cast<const char *>(bytes), count));
    const OctomapHead head = read_head(text);
    if (!head.is_binary && head.id != "OcTree" && head.id != "ColorOcTree" &&
        head.id != "OcTreeStamped")
    {
        throw OctomapFailure("is a tree '" + head.id.substr(0, 40) +
                                 "', not OcTree, ColorOcTree or OcTreeStamped",
                             CM_ERROR_UNSUPPORTED);
    }
    OctreeOwner map = empty_map(head);
    const auto filler =
        std::make_unique<MapFiller>(map.get(), cm_octree_describe(map.get())->color != 0);
    OctomapReader(head, bytes + text.place(), bytes + count, *filler).read();
    check(cm_octree_compact(map.get()));
    return map.release();
}

std::vector<unsigned char> content_of(const char *path)
{
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
    {
        throw OctomapFailure("is a folder", CM_ERROR_FILE);
    }
    std::ifstream file(path, std::ios::binary);
    file.seekg(0, std::ios::end);
    const std::streamoff size = file.tellg();
    if (!file || size < 0)
    {
        throw OctomapFailure("cannot be read", CM_ERROR_FILE);
    }
    std::vector<unsigned char> bytes(static_cast<std::size_t>(size));
    file.seekg(0);
    if (size > 0 && !file.read(reinterpret_cast<char *>(bytes.data()), size))
    {
        throw OctomapFailure("cannot be read", CM_ERROR_FILE);
    }
    return bytes;
}

// Failures of body as a status and a message.
template <typename Body> cm_status tell_failure(const char *name, char *message, const Body &body)
{
    try
    {
        body();
        return CM_OK;
    }
    catch (const std::bad_alloc &)
    {
        (void)cm_file_fail(message, "%s: there is no memory for it", name);
        return CM_ERROR_MEMORY;
    }
    catch (const OctomapFailure &failure)
    {
        (void)cm_file_fail(message, "%s: %s", name, failure.what());
        return failure.status;
    }
    catch (const std::exception &)
    {
        (void)cm_file_fail(message, "%s: cannot be read", name);
        return CM_ERROR_FILE;
    }
}

} // namespace

cm_status cm_octomap_parse(const char *name, const void *bytes, size_t count, cm_octree **octree,
                           char *message)
{
    if (name == nullptr || (bytes == nullptr && count > 0) || octree == nullptr ||
        message == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return tell_failure(name, message,
                        [&]
                        { *octree = read_map(static_cast<const unsigned char *>(bytes), count); });
}

cm_status cm_octomap_read(const char *path, cm_octree **octree, char *message)
{
    if (path == nullptr || octree == nullptr || message == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return tell_failure(path, message,
                        [&]
                        {
                            const std::vector<unsigned char> bytes = content_of(path);
                            *octree = read_map(bytes.data(), bytes.size());
                        });
}
