// SPDX-License-Identifier: MIT
//
// Our maps beside OctoMap's, in one run: the same views of 640 x 480 of the analytic room, the same voxels, one thread. OctoMap
// gets the points of each view by insertPointCloud, discretized, with free space, and keeps no colours; ours keeps them. Then
// every voxel of the room where the two disagree is compared with the truth.
//
//   octomap-speed [EDGE [VIEWS [PASSES]]]     0.01 m, 6 views of the walk; 10 passes more of ours and one of OctoMap's, 0: none
//
// Lines are WHAT, OURS, OCTOMAP, apart by tabs; times are of the processor, ms a view. The grid is moved by a part of a voxel, so
// that no wall lies on the border of two. A voxel is right as 1 where a surface crosses it and as 0 where none does; occupied says
// 1, free 0, unknown a half: of two that disagree one is always nearer.

#include "bench/harness/harness.h"
#include "truth/room_views.h"

#include <cubemap/octree.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <octomap/octomap.h>

namespace
{

constexpr double shift_of_grid = 0.37; // of an edge
constexpr int levels = 12;
const char *const state_name[] = {"unknown", "free", "occupied"};

void need(cm_status status)
{
    if (status != CM_OK)
    {
        std::fprintf(stderr, "octomap-speed: %s\n", cm_status_text(status));
        std::exit(1);
    }
}

// The state of each voxel of the truth's grid.
struct StateGrid
{
    const room_truth *truth;
    std::vector<unsigned char> state;

    explicit StateGrid(const room_truth *of)
        : truth(of), state(of->count[0] * of->count[1] * of->count[2], CM_VOXEL_UNKNOWN)
    {
    }

    // A voxel, which may be a large one, by its centre.
    void set(const double centre[3], double edge, unsigned char is)
    {
        std::int64_t low[3], high[3];
        for (int i = 0; i < 3; ++i)
        {
            const double at = (centre[i] - 0.5 * edge - truth->centre[i]) / truth->edge;
            const std::int64_t begin = std::llround(at) - truth->first[i];
            low[i] = std::max<std::int64_t>(begin, 0);
            high[i] = std::min<std::int64_t>(begin + std::llround(edge / truth->edge),
                                             static_cast<std::int64_t>(truth->count[i]));
        }
        for (std::int64_t z = low[2]; z < high[2]; ++z)
        {
            for (std::int64_t y = low[1]; y < high[1]; ++y)
            {
                for (std::int64_t x = low[0]; x < high[0]; ++x)
                {
                    state[index(x, y, z)] = is;
                }
            }
        }
    }

    std::size_t index(std::int64_t x, std::int64_t y, std::int64_t z) const
    {
        const auto row =
            static_cast<std::size_t>(z) * truth->count[1] + static_cast<std::size_t>(y);
        return row * truth->count[0] + static_cast<std::size_t>(x);
    }

    // Calls visit(index, centre) for every voxel.
    template <typename Visit> void each(Visit visit) const
    {
        std::size_t at = 0;
        for (std::size_t z = 0; z < truth->count[2]; ++z)
        {
            for (std::size_t y = 0; y < truth->count[1]; ++y)
            {
                for (std::size_t x = 0; x < truth->count[0]; ++x, ++at)
                {
                    const std::size_t step[3] = {x, y, z};
                    double centre[3];
                    for (int i = 0; i < 3; ++i)
                    {
                        const auto voxel =
                            static_cast<double>(truth->first[i]) + static_cast<double>(step[i]);
                        centre[i] = truth->centre[i] + (voxel + 0.5) * truth->edge;
                    }
                    visit(at, centre);
                }
            }
        }
    }

    static int at(const void *grid, const double point[3])
    {
        const auto &self = *static_cast<const StateGrid *>(grid);
        std::int64_t voxel[3];
        for (int i = 0; i < 3; ++i)
        {
            const double place = (point[i] - self.truth->centre[i]) / self.truth->edge;
            voxel[i] = static_cast<std::int64_t>(std::floor(place)) - self.truth->first[i];
            if (voxel[i] < 0 || voxel[i] >= static_cast<std::int64_t>(self.truth->count[i]))
            {
                return CM_VOXEL_UNKNOWN;
            }
        }
        return self.state[self.index(voxel[0], voxel[1], voxel[2])];
    }
};

int set_own(void *user, const cm_voxel *voxel)
{
    const double centre[3] = {voxel->x, voxel->y, voxel->z};
    static_cast<StateGrid *>(user)->set(centre, voxel->edge, voxel->state);
    return 0;
}

StateGrid grid_of(const cm_octree *map, const room_truth &truth)
{
    StateGrid grid(&truth);
    const double reach[2][3] = {{-10, -10, -10}, {10, 10, 10}};
    need(cm_octree_walk_box(map, reach[0], reach[1], set_own, &grid));
    return grid;
}

StateGrid grid_of(const octomap::OcTree &tree, const room_truth &truth)
{
    StateGrid grid(&truth);
    for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf)
    {
        const double centre[3] = {leaf.getX() + truth.centre[0], leaf.getY() + truth.centre[1],
                                  leaf.getZ() + truth.centre[2]};
        grid.set(centre, leaf.getSize(),
                 tree.isNodeOccupied(*leaf) ? CM_VOXEL_OCCUPIED : CM_VOXEL_FREE);
    }
    return grid;
}

octomap::Pointcloud points_of(const room_picture &picture, const room_truth &truth)
{
    octomap::Pointcloud cloud;
    cloud.reserve(picture.pixels);
    for (std::size_t i = 0; i < picture.pixels; ++i)
    {
        if (picture.measured[i] > 0.0F)
        {
            cloud.push_back(static_cast<float>(picture.point[0][i] - truth.centre[0]),
                            static_cast<float>(picture.point[1][i] - truth.centre[1]),
                            static_cast<float>(picture.point[2][i] - truth.centre[2]));
        }
    }
    return cloud;
}

double insert(octomap::OcTree &tree, const octomap::Pointcloud &cloud, const cm_pose &pose,
              const room_truth &truth)
{
    const octomap::point3d origin(static_cast<float>(pose.position[0] - truth.centre[0]),
                                  static_cast<float>(pose.position[1] - truth.centre[1]),
                                  static_cast<float>(pose.position[2] - truth.centre[2]));
    const double begin = processor_seconds();
    tree.insertPointCloud(cloud, origin, -1.0, false, true);
    return processor_seconds() - begin;
}

double update(cm_octree *map, const cm_view &view)
{
    const double begin = processor_seconds();
    need(cm_octree_update(map, &view, nullptr));
    return processor_seconds() - begin;
}

void print_times(const char *what, const std::vector<double> &ours,
                 const std::vector<double> &theirs)
{
    const timing own = summary(ours.data(), ours.size());
    const timing their = summary(theirs.data(), theirs.size());
    std::printf("%s, median\t%.2f ms\t%.0f ms, %.0f times\n", what, 1e3 * own.median,
                1e3 * their.median, their.median / own.median);
    std::printf("%s, fastest\t%.2f ms\t%.0f ms, %.0f times\n", what, 1e3 * own.best,
                1e3 * their.best, their.best / own.best);
}

void print_errors(const StateGrid &own, const StateGrid &their)
{
    room_errors errors[2] = {};
    for (int i = 0; i < 2; ++i)
    {
        const StateGrid &grid = i == 0 ? own : their;
        room_truth_judge(grid.truth, &grid, StateGrid::at, &errors[i]);
        grid.each(
            [&](std::size_t at, const double *centre)
            {
                if (grid.state[at] == CM_VOXEL_OCCUPIED)
                {
                    room_truth_judge_occupied(grid.truth, centre, &errors[i]);
                }
            });
    }
    const auto share =
        [&](const char *what, std::uint64_t room_errors::*part, std::uint64_t room_errors::*whole)
    {
        double percent[2];
        for (int i = 0; i < 2; ++i)
        {
            percent[i] = 100.0 * static_cast<double>(errors[i].*part) /
                         static_cast<double>(errors[i].*whole);
        }
        std::printf("%s\t%.3f %%\t%.3f %%\n", what, percent[0], percent[1]);
    };
    share("of visible surface voxels are occupied", &room_errors::visible_occupied,
          &room_errors::visible);
    share("of visible surface voxels are free", &room_errors::visible_free, &room_errors::visible);
    share("of voxels that a surface crosses are free", &room_errors::crossed_free,
          &room_errors::crossed);
    share("of occupied voxels are over 1.5 edges from a surface", &room_errors::off,
          &room_errors::occupied);
}

// Who is nearer, and of what kind.
struct Verdict
{
    std::uint64_t nearer[2] = {0, 0}; // ours, OctoMap's
    std::uint64_t kind[3][3][2] = {}; // ours, OctoMap's, crossed

    void add(int own, int their, bool crossed)
    {
        static const double says[] = {0.5, 0.0, 1.0};
        const double truth = crossed ? 1.0 : 0.0;
        ++nearer[std::fabs(says[own] - truth) < std::fabs(says[their] - truth) ? 0 : 1];
        ++kind[own][their][crossed ? 1 : 0];
    }
};

void print_verdict(const StateGrid &own, const StateGrid &their)
{
    Verdict verdict;
    own.each(
        [&](std::size_t at, const double *centre)
        {
            if (own.state[at] != their.state[at])
            {
                verdict.add(own.state[at], their.state[at],
                            room_truth_crossed(own.truth, centre) != 0);
            }
        });
    std::printf("voxels where they disagree: nearer the truth\t%llu\t%llu\n",
                static_cast<unsigned long long>(verdict.nearer[0]),
                static_cast<unsigned long long>(verdict.nearer[1]));
    for (int crossed = 1; crossed >= 0; --crossed)
    {
        for (int i = 0; i < 3; ++i)
        {
            for (int k = 0; k < 3; ++k)
            {
                const auto count = static_cast<unsigned long long>(verdict.kind[i][k][crossed]);
                if (count > 0)
                {
                    std::printf("of those %llu that %s\t%s\t%s\n", count,
                                crossed != 0 ? "a surface crosses" : "none crosses", state_name[i],
                                state_name[k]);
                }
            }
        }
    }
}

void print_memory(cm_octree *map, octomap::OcTree &tree)
{
    cm_octree_count count = {};
    count.size = sizeof count;
    need(cm_octree_count_voxels(map, &count));
    std::printf("memory, as each says\t%.1f MB\t%.1f MB\n", 1e-6 * static_cast<double>(count.bytes),
                1e-6 * static_cast<double>(tree.memoryUsage()));
    need(cm_octree_compact(map));
    tree.prune();
    need(cm_octree_count_voxels(map, &count));
    std::printf("memory, compacted and pruned\t%.1f MB\t%.1f MB\n",
                1e-6 * static_cast<double>(count.bytes),
                1e-6 * static_cast<double>(tree.memoryUsage()));
}

cm_camera *make_camera()
{
    cm_camera_options lens = {};
    lens.size = sizeof lens;
    lens.width = 640;
    lens.height = 480;
    lens.fx = lens.fy = 525.0;
    lens.cx = 319.5;
    lens.cy = 239.5;
    cm_camera *camera = nullptr;
    need(cm_camera_create(&lens, &camera));
    return camera;
}

cm_octree *make_map(double edge)
{
    cm_octree_options options = {};
    options.size = sizeof options;
    options.edge = edge;
    options.levels = levels;
    options.color = 1;
    std::fill(options.centre, options.centre + 3, shift_of_grid * edge);
    cm_octree *map = nullptr;
    need(cm_octree_create(&options, &map));
    return map;
}

// What both are made of.
struct World
{
    cm_scene *scene = nullptr;
    cm_camera *camera = make_camera();
    cm_octree *map;
    octomap::OcTree tree;
    room_picture picture{};
    room_truth truth{};
    std::size_t views;

    World(double edge, std::size_t count) : map(make_map(edge)), tree(edge), views(count)
    {
        const double least[3] = {-3.0, -2.5, 0.0};
        const double greatest[3] = {3.0, 2.5, 3.0};
        need(cm_scene_create_named("room", &scene));
        if (room_picture_make(camera, &picture) == 0 ||
            room_truth_make(scene, edge, cm_octree_describe(map)->centre, least, greatest,
                            &truth) == 0)
        {
            need(CM_ERROR_MEMORY);
        }
    }
    World(const World &) = delete;
    World &operator=(const World &) = delete;
    ~World()
    {
        room_truth_free(&truth);
        room_picture_free(&picture);
        cm_octree_destroy(map);
        cm_camera_destroy(camera);
        cm_scene_destroy(scene);
    }

    // The seconds of each view, into ours or OctoMap's. One after the other, not in turns: in turns ours took many times longer
    // than alone, for a reason that is not known.
    std::vector<double> walk(bool is_ours, std::size_t passes)
    {
        std::vector<double> took;
        for (std::size_t i = 0; i < passes * views; ++i)
        {
            progress("%s, view %zu of %zu", is_ours ? "ours" : "OctoMap", i + 1, passes * views);
            const cm_pose pose = room_pose(i % views, views);
            room_picture_take(scene, camera, &pose, 0.0, 0, &picture);
            room_truth_see(&truth, &picture);
            took.push_back(is_ours ? update(map, room_picture_view(&picture, camera, &pose, 1))
                                   : insert(tree, points_of(picture, truth), pose, truth));
        }
        progress(nullptr);
        return took;
    }
};

void compare(double edge, std::size_t views, std::size_t passes)
{
    World world(edge, views);
    const std::vector<double> own = world.walk(true, 1);
    print_times("a new view", own, world.walk(false, 1));
    {
        const StateGrid states = grid_of(world.map, world.truth);
        const StateGrid their = grid_of(world.tree, world.truth);
        print_errors(states, their);
        print_verdict(states, their);
    }
    if (passes > 0)
    {
        const std::vector<double> again = world.walk(true, passes);
        print_times("a view seen before", again, world.walk(false, 1));
    }
    print_memory(world.map, world.tree);
}

} // namespace

int main(int count, char **word)
{
    name_program("octomap-speed");
    const double edge = count > 1 ? number_of(word[1]) : 0.01;
    const unsigned long views = count > 2 ? std::strtoul(word[2], nullptr, 10) : 6;
    const unsigned long passes = count > 3 ? std::strtoul(word[3], nullptr, 10) : 10;
    if (count > 4 || !(edge > 0.0) || views == 0)
    {
        std::fprintf(stderr, "usage: octomap-speed [EDGE [VIEWS [PASSES]]]\n");
        return 2;
    }
    std::printf("%s; %lu views, voxels of %g m\tlibcubemap\tOctoMap\n", system_cpu(), views, edge);
    compare(edge, views, passes);
    return close_standard_output();
}
