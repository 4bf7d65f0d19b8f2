/* SPDX-License-Identifier: MIT
 *
 * The library in C++: objects that end by themselves and move, arrays as spans, errors both ways, and results that are
 * those of the functions of C.
 */
#include "bindings/cpp/cubemap.hpp"

#include <array>
#include <cstdio>
#include <cstring>
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

static void test_errors()
{
    bool is_thrown = false;
    try
    {
        cubemap::mapping mapping("no such mapping");
    }
    catch (const cubemap::error &error)
    {
        char words[256] = "";
        cm_specification_check("no such mapping", words, sizeof words);
        is_thrown = error.status() == CM_ERROR_MAPPING && std::strcmp(error.what(), words) == 0 &&
                    std::strstr(error.what(), "'no such mapping'") != nullptr;
    }
    expect(is_thrown, "an error is thrown with the library's words for this case");
    is_thrown = false;
    try
    {
        cubemap::surface surface("cube:coupled;siz=3", nullptr);
    }
    catch (const cubemap::error &error)
    {
        is_thrown = std::strstr(error.what(), "'siz'") != nullptr;
    }
    expect(is_thrown, "so is that of a surface");
    is_thrown = false;
    try
    {
        const cm_options without_size = {};
        cubemap::mapping mapping("coupled", nullptr, &without_size);
    }
    catch (const cubemap::error &error)
    {
        is_thrown = std::strcmp(error.what(), cm_status_text(error.status())) == 0;
    }
    expect(is_thrown, "where there are none, with those of the status");

    auto made = cubemap::mapping::try_make("no such mapping");
    expect(!made && made.status() == CM_ERROR_MAPPING, "an error is a value");
    auto good = cubemap::mapping::try_make("coupled");
    expect(bool(good) && good->has_bounds() == 1, "what is made can be used in place");

    cm_options without_size = {};
    const char *text = cubemap::status_text(
        cubemap::mapping::try_make("coupled", nullptr, &without_size).status());
    expect(std::strstr(text, "size of a struct") != nullptr, "a size that is missing has a word");

    cubemap::mapping healpix("healpix");
    const double pq[2] = {0.1, 0.2};
    double uv[2] = {7.0, 7.0};
    expect(healpix.try_warp(pq, uv) == CM_ERROR_UNSUPPORTED && uv[0] == 7.0,
           "a method that fails says so");
    is_thrown = false;
    try
    {
        healpix.warp(pq, uv);
    }
    catch (const cubemap::error &)
    {
        is_thrown = true;
    }
    expect(is_thrown, "or throws");
}

static void test_life()
{
    cubemap::mapping one("coupled");
    const cm_mapping *handle = one.get();
    cubemap::mapping two = std::move(one);
    expect(two.get() == handle && one.get() == nullptr, "an object moves, and leaves nothing");
    cubemap::mapping three("tangent");
    three = std::move(two);
    expect(three.get() == handle && two.get() == nullptr,
           "and is assigned, what was there ends, and nothing is left either");
    cubemap::mapping &itself = three;
    three = std::move(itself);
    expect(three.get() == handle, "to itself, too");
    cm_mapping *released = three.release();
    expect(released == handle && three.get() == nullptr, "and is given away");
    cm_mapping_destroy(released);

    const cubemap::grid grid;
    cubemap::mapping_view inside = grid.mapping();
    expect(std::strcmp(inside.describe()->identifier, CM_MAPPING_RECOMMENDED) == 0,
           "a view shows what a grid owns");
    const cubemap::cell_grid cells(grid, CM_CURVE_HILBERT);
    expect(cells.grid().get() == grid.get(), "objects are made of others");
    static_assert(!std::is_copy_constructible_v<cubemap::mapping>, "objects are not copied");
    static_assert(sizeof(cubemap::mapping_view) == sizeof(void *), "a view is a pointer");
    using of_numbers = std::vector<double>;
    static_assert(std::is_convertible_v<of_numbers, cubemap::span<const double>> &&
                      std::is_convertible_v<of_numbers &, cubemap::span<double>> &&
                      !std::is_convertible_v<of_numbers, cubemap::span<double>>,
                  "what ends with the call is read, and not written");
}

static void test_points()
{
    const cubemap::mapping mapping("coupled", cm_frame_find("gl"));
    const double direction[3] = {2.0, 1.0, 0.5};
    double uv[2], of_c[2];
    const std::uint8_t face = mapping.forward(direction, uv);
    expect(face == cm_forward(mapping.get(), direction, of_c) && uv[0] == of_c[0] &&
               uv[1] == of_c[1],
           "one point");

    const std::vector<double> x = {2.0, -1.0, 0.3}, y = {1.0, 0.2, -4.0}, z = {0.5, 0.6, 0.7};
    std::array<double, 3> u{}, v{};
    std::uint8_t faces[3];
    mapping.forward(x, y, z, faces, u, v);
    expect(faces[0] == face && u[0] == uv[0] && v[0] == uv[1], "a vector, an array, and one of C");
    double backwards[3];
    mapping.inverse(faces[2], {u[2], v[2]}, backwards);
    expect(backwards[1] < -0.98, "and back");
    std::array<double, 3> u_threads{}, v_threads{};
    mapping.forward(2u, x, y, z, faces, u_threads, v_threads);
    expect(u == u_threads && v == v_threads, "threads");

    const std::vector<float> xf(x.begin(), x.end()), yf(y.begin(), y.end()), zf(z.begin(), z.end());
    std::vector<float> uf(3), vf(3);
    mapping.forward(xf, yf, zf, faces, uf, vf);
    expect(static_cast<double>(uf[1]) - u[1] < 1e-6 && u[1] - static_cast<double>(uf[1]) < 1e-6,
           "float");
}

static void test_others()
{
    const cubemap::healpix healpix(64, CM_HEALPIX_NESTED);
    std::int64_t pixel = -1, neighbours[8];
    const double direction[3] = {0.1, 0.2, 0.3};
    healpix.pixel_from_direction(direction, &pixel);
    healpix.neighbours(pixel, neighbours);
    expect(pixel >= 0 && neighbours[0] != pixel, "pixels");

    const cubemap::region region = cubemap::region::cap_lonlat(0.1, 0.2, 0.05);
    expect(region.contains({0.9, 0.09, 0.2}) == 1, "a region of a factory");
    const cubemap::colormap map("sequential-single");
    expect(cubemap::colormap::try_make("nothing").status() == CM_ERROR_MAPPING,
           "a map that is none");
    const cubemap::colormap fitted = map.fit();
    std::vector<double> samples(3 * 16);
    fitted.samples(16, samples, nullptr);
    expect(samples[0] >= 0.0 && samples[47] <= 1.0 && fitted.inside() == 1, "colours");
    const cubemap::surface from("equirect;size=64"), to("cube:coupled;size=16");
    const cubemap::plan plan(from, to);
    std::size_t length = 0;
    expect(plan.try_write(nullptr, 0, &length) == CM_ERROR_SPACE && length > 0, "pictures");
    expect(std::strcmp(cubemap::version(), CM_VERSION_STRING) == 0, "what is in no class");
}

template <class Call> static bool is_refused(Call call)
{
    try
    {
        call();
    }
    catch (const cubemap::error &error)
    {
        return error.status() == CM_ERROR_ARGUMENT;
    }
    return false;
}

/* What is too short by one element is refused, and nothing is written; what is long enough is not. */
static void test_lengths()
{
    const cubemap::mapping mapping("coupled");
    const std::vector<double> x = {2.0, -1.0, 0.3}, y = {1.0, 0.2, -4.0}, z = {0.5, 0.6, 0.7};
    std::vector<double> u(3, 7.0), v(3), few(2);
    std::vector<std::uint8_t> face(3);
    expect(is_refused([&] { mapping.forward(x, y, few, face, u, v); }) && u[0] == 7.0,
           "a short input");
    expect(is_refused([&] { mapping.forward(x, y, z, face, u, few); }) && u[0] == 7.0,
           "a short output");
    expect(is_refused([&] { mapping.inverse(face, u, few, u, v, v); }), "of the inverse");
    mapping.forward(few, x, y, face, u, v);
    expect(u[0] != 7.0 && u[2] == 7.0, "longer ones are good");

    const std::vector<double> xyz = {2.0, 1.0, 0.5, -1.0, 0.2, 0.6, 0.3, -4.0};
    expect(is_refused([&] { mapping.forward_strided(xyz, 3, face, u, v); }), "points of three");
    expect(is_refused([&] { mapping.forward_strided(xyz, -3, face, u, v); }), "backwards");
    mapping.forward_strided(cubemap::span<const double>(xyz.data(), 6), 3,
                            cubemap::span<std::uint8_t>(face.data(), 2), u, v);
    double uv[2];
    mapping.forward({-1.0, 0.2, 0.6}, uv);
    expect(u[1] == uv[0] && v[1] == uv[1], "two are there");

    std::vector<double> factor(3, 7.0), many(16);
    expect(cubemap::try_harmonics_cosine_lobe(3, factor) == CM_ERROR_ARGUMENT && factor[0] == 7.0,
           "factors of degree 3");
    expect(cubemap::try_harmonics_cosine_lobe(2, factor) == CM_OK && factor[0] != 7.0, "of 2");
    factor.resize(4);
    expect(cubemap::try_harmonics_scale(3, 1, factor, many) == CM_OK, "16 coefficients");
    expect(cubemap::try_harmonics_scale(3, 2, factor, many) == CM_ERROR_ARGUMENT, "not 32");
    const std::vector<std::size_t> rings = {3};
    const std::vector<double> corners(5);
    expect(cubemap::region::try_polygon(rings, corners).status() == CM_ERROR_ARGUMENT,
           "a corner of one number");
    std::vector<double> map(12);
    const cubemap::healpix one(1, CM_HEALPIX_RING), two(2, CM_HEALPIX_RING);
    expect(one.try_regrade(map, two, map, nullptr) == CM_ERROR_ARGUMENT, "a map of 48 pixels");
    expect(one.try_regrade(map, one, map, nullptr) == CM_OK, "of 12");
}

int main()
{
    test_lengths();
    test_errors();
    test_life();
    test_points();
    test_others();
    std::printf("%d failures\n", failures);
    return failures == 0 ? 0 : 1;
}
