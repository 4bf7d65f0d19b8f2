/* SPDX-License-Identifier: MIT
 *
 * The module scene in C++: objects that end by themselves, arrays as spans whose lengths are asked for, errors both ways,
 * and results that are those of the functions of C.
 */
#include "bindings/cpp/cubemap.hpp"

#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

static int failures = 0;

static void expect(bool is_good, const char *what)
{
    if (!is_good)
    {
        std::printf("not ok: %s\n", what);
        failures++;
    }
}

static cubemap::camera small_camera()
{
    auto options = cubemap::sized<cm_camera_options>();
    options.width = 64;
    options.height = 48;
    options.fx = options.fy = 60.0;
    options.cx = 31.5;
    options.cy = 23.5;
    return cubemap::camera(&options);
}

static void test_cameras()
{
    const cubemap::camera camera = small_camera();
    expect(camera.describe()->width == 64, "a camera says what it was made of");
    const std::vector<double> column = {0.0, 31.5, 63.0}, row = {0.0, 23.5, 47.0};
    std::vector<double> x(3), y(3), z(3), back(3), down(3);
    camera.ray(column, row, x, y, z);
    camera.project(x, y, z, back, down);
    expect(x[1] == 0.0 && std::fabs(back[2] - 63.0) < 1e-12 && std::fabs(down[0]) < 1e-12,
           "rays and back");
    bool is_thrown = false;
    try
    {
        camera.ray(column, row, x, y, cubemap::span<double>(z.data(), 2));
    }
    catch (const cubemap::error &error)
    {
        is_thrown = error.status() == CM_ERROR_ARGUMENT;
    }
    expect(is_thrown, "a span that is too short");
    auto none = cubemap::sized<cm_camera_options>();
    expect(cubemap::camera::try_make(&none).status() == CM_ERROR_CAMERA, "no camera, as a value");
}

static void test_depth()
{
    const cubemap::camera camera = small_camera();
    cubemap::rays rays(camera, nullptr);
    cubemap::pool pool(2);
    rays.use_pool(pool);
    expect(rays.pixel_count() == 64u * 48u && pool.threads() == 2, "how many pixels and threads");
    std::vector<float> depth(rays.pixel_count(), 2.0f), range(rays.pixel_count()),
        half(rays.halved_pixel_count());
    rays.to_range(depth, 1, range);
    const double corner[1] = {0.0};
    double x[1], y[1], z[1];
    camera.ray(corner, corner, x, y, z);
    const double wanted = 2.0 * std::sqrt(x[0] * x[0] + y[0] * y[0] + 1.0);
    expect(std::fabs(static_cast<double>(range[0]) - wanted) < 1e-5, "range");
    rays.halve(depth, 0.1, 1, half);
    expect(half.size() == 32u * 24u && half.back() == 2.0f, "half of each side");
    half.pop_back();
    expect(rays.try_halve(depth, 0.1, 1, half) == CM_ERROR_ARGUMENT, "no room for the last pixel");
    range.pop_back();
    expect(rays.try_smooth(depth, 1.0, 0.1, 1, range) == CM_ERROR_ARGUMENT, "nor for the smooth");
    rays.use_pool(cubemap::pool_view(nullptr));

    cubemap::depth_pyramid pyramid(64, 48, nullptr);
    pyramid.fill(depth, 1);
    cm_depth_bounds bounds;
    pyramid.bounds(0, 0, 63, 47, &bounds);
    expect(bounds.least == 2.0f && bounds.has_unmeasured == 0, "bounds");
    depth.pop_back();
    expect(pyramid.try_fill(depth, 1) == CM_ERROR_ARGUMENT, "an image that is too short");

    std::vector<std::uint16_t> stored(6, 5000);
    auto picture = cubemap::sized<cm_image>();
    picture.data = stored.data();
    picture.type = CM_PIXEL_U16;
    picture.width = 3;
    picture.height = 2;
    picture.channels = 1;
    auto limits = cubemap::sized<cm_depth_limits>();
    limits.unit = 1.0 / 5000.0;
    std::vector<float> metres(6);
    cubemap::depth_clean(picture, &limits, 1, metres, nullptr);
    expect(metres[5] == 1.0f, "a picture of depth");
    metres.pop_back();
    expect(cubemap::try_depth_clean(picture, &limits, 1, metres, nullptr) == CM_ERROR_ARGUMENT,
           "which has six pixels");
}

static void test_worlds()
{
    cubemap::scene scene;
    auto ball = cubemap::sized<cm_primitive>();
    ball.kind = CM_PRIMITIVE_SPHERE;
    ball.first[2] = 3.0;
    ball.radius = 1.0;
    std::uint32_t id = 7;
    scene.add(ball, &id);
    expect(id == 0 && scene.count() == 1 && scene.at(0)->radius == 1.0, "a world of a ball");
    const std::vector<double> zero(1, 0.0), one(1, 1.0);
    double distance[1];
    auto hit = cubemap::sized<cm_hit_arrays>();
    hit.distance = distance;
    scene.cast(zero, zero, zero, zero, zero, one, &hit);
    expect(std::fabs(distance[0] - 2.0) < 1e-12, "a ray meets it");
    ball.radius = -1.0;
    expect(scene.try_add(ball, &id) == CM_ERROR_RANGE, "no ball");
    expect(cubemap::scene::named(cubemap::scene_name_at(0)).count() > 0, "a world with a name");
    expect(cubemap::scene::try_named("nothing").status() == CM_ERROR_ARGUMENT, "and without");

    const std::vector<double> corner = {-1, -1, 2, 1, -1, 2, 0, 1, 2};
    const std::vector<std::uint32_t> index = {0, 1, 2};
    auto options = cubemap::sized<cm_mesh_options>();
    options.vertex_count = 3;
    options.position = corner.data();
    options.triangle_count = 1;
    options.index = index.data();
    const cubemap::mesh mesh(options);
    double least[3], greatest[3];
    mesh.bounds(least, greatest);
    expect(least[0] == -1.0 && greatest[2] == 2.0 && mesh.describe()->vertex_count == 3, "a mesh");

    const cubemap::camera camera = small_camera();
    cubemap::raster raster(camera, 0.0, nullptr);
    auto triangles = cubemap::sized<cm_triangles>();
    triangles.vertex_count = 3;
    triangles.position = corner.data();
    triangles.triangle_count = 1;
    triangles.first_id = 5;
    raster.triangles(nullptr, triangles, 1);
    std::vector<float> image(raster.pixel_count());
    std::vector<std::uint32_t> ids(raster.pixel_count());
    raster.read(image, ids);
    expect(image[24 * 64 + 32] == 2.0f && ids[24 * 64 + 32] == 5, "drawn");
    raster.read({}, ids);
    raster.clear();
    raster.read(image, {});
    expect(std::isnan(image[24 * 64 + 32]), "and gone");
    ids.pop_back();
    expect(raster.try_read(image, ids) == CM_ERROR_ARGUMENT, "ids that are too few");
}

static void test_poses()
{
    const double twist[6] = {1.0, 2.0, 3.0, 0.1, -0.2, 0.3};
    cm_pose pose, inverse, product;
    cubemap::pose_exp(twist, &pose);
    cubemap::pose_invert(pose, &inverse);
    cubemap::pose_compose(pose, inverse, &product);
    expect(cubemap::try_pose_check(pose) == CM_OK && cubemap::pose_angle(product) < 1e-7, "poses");
    double back[6];
    cubemap::pose_log(pose, back);
    expect(std::fabs(back[5] - 0.3) < 1e-14, "exp and log");

    const std::vector<double> stamps = {0.0, 1.0, 2.0};
    std::vector<cm_pose> poses = {product, pose, product};
    const cubemap::trajectory trajectory(stamps, poses, nullptr);
    cm_pose between;
    trajectory.interpolate(1.0, &between);
    expect(trajectory.count() == 3 && std::memcmp(&between, &pose, sizeof pose) == 0, "in time");
    std::size_t wrong = 0;
    const std::vector<double> late = {0.0, 2.0, 1.0};
    expect(cubemap::trajectory::try_make(late, poses, &wrong).status() == CM_ERROR_DATA &&
               wrong == 2,
           "stamps that are none");
    poses.pop_back();
    expect(cubemap::trajectory::try_make(stamps, poses, nullptr).status() == CM_ERROR_ARGUMENT,
           "a pose too few");
    std::size_t index_a[3], index_b[3], count = 0;
    trajectory.associate(trajectory, 0.1, index_a, index_b, &count);
    expect(count == 3 && index_a[2] == 2 && index_b[2] == 2, "pairs");
    const cubemap::motion motion(trajectory);
    auto state = cubemap::sized<cm_motion_state>();
    motion.at(1.0, &state);
    expect(std::fabs(state.pose.position[0] - pose.position[0]) < 1e-12, "a curve through them");

    std::vector<double> value(3), mean(3, 4.0);
    cubemap::random_uniform(1, 2, 3, 4, value);
    expect(value[2] == cubemap::random_uniform(1, 2, 5, 4), "random numbers of places");
    cubemap::random_poisson(1, 2, 3, 4, mean, value);
    expect(value[1] == cubemap::random_poisson(1, 2, 4, 4, 4.0), "and counts");
}

static void count_elements(std::size_t begin, std::size_t end, void *user)
{
    static_cast<std::atomic<std::size_t> *>(user)->fetch_add(end - begin);
}

static void test_stores()
{
    cubemap::store store = cubemap::store::in_memory();
    const cm_store_key key = {"key", 3};
    char bytes[] = "bytes";
    auto put = cubemap::sized<cm_blob>();
    put.kind = 1;
    put.data = bytes;
    put.count = 5;
    store.put(key, put);
    store.commit();
    for (int i = 0; i < 2; i++) /* each blob gives its bytes back */
    {
        cubemap::blob got;
        store.get(key, 1, 0, &got);
        expect(got.count == 5 && std::memcmp(got.data, "bytes", 5) == 0, "a blob");
    }
    cubemap::blob none;
    expect(store.try_get(key, 2, 0, &none) == CM_ERROR_DATA && none.data == nullptr, "of its kind");
    unsigned char first[CM_STORE_KEY_MAX];
    std::size_t count = 0;
    store.next(nullptr, first, &count);
    expect(count == 3 && std::memcmp(first, "key", 3) == 0, "keys in their order");
    store.remove(key);
    store.rollback();
    store.next(nullptr, first, &count);
    expect(count == 3, "what was not committed is undone");

    std::atomic<std::size_t> elements{0};
    cubemap::pool(2).run(1000, 10, count_elements, &elements);
    expect(elements == 1000, "work for a pool");

    cm_budget_entry entries[2] = {cubemap::sized<cm_budget_entry>(),
                                  cubemap::sized<cm_budget_entry>()};
    entries[0].contribution = 1.0;
    entries[0].cost = 1.0;
    entries[1].contribution = 0.01;
    entries[1].cost = 10.0;
    auto budget = cubemap::sized<cm_budget>();
    budget.count = 2;
    budget.entry = entries;
    cubemap::budget_limit_error(&budget, 0.1);
    std::size_t length = 0;
    expect(entries[0].is_kept == 1 && entries[1].is_kept == 0 &&
               cubemap::try_budget_json(budget, nullptr, 0, &length) == CM_ERROR_SPACE &&
               length > 0,
           "a budget");
}

int main()
{
    test_cameras();
    test_depth();
    test_worlds();
    test_poses();
    test_stores();
    std::printf("%d failures\n", failures);
    return failures == 0 ? 0 : 1;
}
