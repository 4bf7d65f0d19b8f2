// SPDX-License-Identifier: MIT
//
// Maps that OctoMap itself has written, .bt and .ot, with and without colours or times: each of its leaves is as it says, and there are
// no others.

#include "modules/octree/io/octomap_file.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>

#include <octomap/ColorOcTree.h>
#include <octomap/OcTreeStamped.h>
#include <octomap/octomap.h>

#include <unistd.h>

namespace
{

int failures = 0;

void expect(bool good, const char *what, double x, double y, double z)
{
    if (!good && failures++ < 10)
    {
        std::printf("%s at %g %g %g\n", what, x, y, z);
    }
}

using MapPointer = std::unique_ptr<cm_octree, void (*)(cm_octree *)>;

MapPointer read_map(const std::string &name)
{
    cm_octree *map = nullptr;
    char message[CM_IMAGE_MESSAGE] = "";
    if (cm_octomap_read(name.c_str(), &map, message) != CM_OK)
    {
        std::printf("%s\n", message);
        std::exit(EXIT_FAILURE);
    }
    return {map, cm_octree_destroy};
}

// A ball of points seen from a place, as a scanner does.
template <typename Tree> void fill(Tree &tree)
{
    octomap::Pointcloud cloud;
    for (int i = 0; i < 4000; ++i)
    {
        const double z = -1 + (i + 0.5) / 2000;
        const double around = 2.399963229728653 * i;
        const double r = std::sqrt(1 - z * z);
        cloud.push_back(static_cast<float>(2 * r * std::cos(around)),
                        static_cast<float>(1.5 * r * std::sin(around)), static_cast<float>(z));
    }
    tree.insertPointCloud(cloud, octomap::point3d(0.1f, 0.05f, 0.02f));
    for (int i = 0; i < 3; ++i)
    {
        tree.insertPointCloud(cloud, octomap::point3d(0.4f, 0.05f, 0.02f));
    }
    tree.updateInnerOccupancy();
}

// The states of all leaves, and how many voxels there are.
template <typename Tree> void compare(const Tree &tree, const cm_octree *map)
{
    std::uint64_t occupied = 0, free = 0;
    for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf)
    {
        const double point[3] = {leaf.getX(), leaf.getY(), leaf.getZ()};
        // the middle of a larger one is a corner of ours
        const double aside = 0.25 * tree.getResolution();
        const double inside[3] = {point[0] + aside, point[1] + aside, point[2] + aside};
        const bool is_occupied = tree.isNodeOccupied(*leaf);
        const std::uint64_t many = std::uint64_t{1} << 3 * (16 - leaf.getDepth());
        (is_occupied ? occupied : free) += many;
        expect(cm_octree_at(map, inside, 0, nullptr) ==
                   (is_occupied ? CM_VOXEL_OCCUPIED : CM_VOXEL_FREE),
               "another state", point[0], point[1], point[2]);
    }
    cm_octree_count count = {};
    count.size = sizeof count;
    if (cm_octree_count_voxels(map, &count) != CM_OK || count.occupied != occupied ||
        count.free != free || occupied == 0 || free == 0)
    {
        std::printf("%llu and %llu voxels, not %llu and %llu\n",
                    static_cast<unsigned long long>(count.occupied),
                    static_cast<unsigned long long>(count.free),
                    static_cast<unsigned long long>(occupied),
                    static_cast<unsigned long long>(free));
        ++failures;
    }
}

void compare_colors(const octomap::ColorOcTree &tree, const cm_octree *map)
{
    int colored = 0;
    for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf)
    {
        const double point[3] = {leaf.getX() + 0.01, leaf.getY() + 0.01, leaf.getZ() + 0.01};
        const auto color = leaf->getColor();
        cm_voxel voxel = {};
        cm_octree_at(map, point, 0, &voxel);
        if (tree.isNodeOccupied(*leaf) && leaf->isColorSet())
        {
            ++colored;
            expect(voxel.has_color != 0 && std::abs(voxel.color[0] - color.r) <= 1 &&
                       std::abs(voxel.color[1] - color.g) <= 1 &&
                       std::abs(voxel.color[2] - color.b) <= 1,
                   "another colour", point[0], point[1], point[2]);
        }
    }
    expect(colored > 1000, "too few colours", colored, 0, 0);
}

// A tree of which the root alone is left: both read the same file.
void compare_root(const std::string &name)
{
    {
        std::ofstream file(name, std::ios::binary);
        file << "# Octomap OcTree binary file\nid OcTree\nsize 1\nres 0.05\ndata\n";
        file.write("\0\0", 2);
    }
    octomap::OcTree tree(0.05);
    expect(tree.readBinary(name) && tree.size() == 1, "OctoMap does not read a root alone", 0, 0,
           0);
    const MapPointer map = read_map(name);
    for (const double at : {-1500.0, -0.02, 0.02, 700.0, 1600.0})
    {
        const double point[3] = {at, 0.02, 0.02};
        const bool is_occupied = tree.isNodeOccupied(tree.getRoot()) && std::abs(at) < 0.05 * 32768;
        expect(cm_octree_at(map.get(), point, 0, nullptr) ==
                   (is_occupied ? CM_VOXEL_OCCUPIED : CM_VOXEL_UNKNOWN),
               "another state of a root alone", at, 0.02, 0.02);
    }
    expect(tree.isNodeOccupied(tree.getRoot()), "OctoMap's root is not occupied", 0, 0, 0);
}

} // namespace

int main()
{
    const std::string folder = "/tmp/cubemap-octomap-" + std::to_string(getpid());
    const std::string bits = folder + ".bt", values = folder + ".ot";
    octomap::OcTree tree(0.05);
    fill(tree);
    tree.write(values);
    compare(tree, read_map(values).get());
    tree.writeBinary(bits); // prunes it, and makes its values those of the bounds
    compare(tree, read_map(bits).get());
    octomap::OcTreeStamped stamped(0.05);
    fill(stamped);
    stamped.write(values);
    compare(stamped, read_map(values).get());
    octomap::ColorOcTree colored(0.05);
    fill(colored);
    for (auto leaf = colored.begin_leafs(); leaf != colored.end_leafs(); ++leaf)
    {
        if (colored.isNodeOccupied(*leaf))
        {
            const auto red = static_cast<std::uint8_t>(100 + 40 * leaf.getX());
            colored.setNodeColor(leaf.getKey(), red, 60, 20);
        }
    }
    colored.write(values);
    const MapPointer map = read_map(values);
    compare(colored, map.get());
    compare_colors(colored, map.get());
    compare_root(bits);
    unlink(bits.c_str());
    unlink(values.c_str());
    std::printf("%d failures\n", failures);
    return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
