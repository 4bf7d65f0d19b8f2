/* SPDX-License-Identifier: MIT
 *
 * The library in C++17: objects that end by themselves, arrays as spans, errors as exceptions or as values. All is inline
 * and calls the functions of C, whose headers say what they do: the comment above each names it.
 *
 *     cubemap::mapping mapping("coupled");                  throws cubemap::error
 *     auto made = cubemap::mapping::try_make("coupled");    or: a cubemap::result, made.value() if (made)
 *     mapping.forward(x, y, z, face, u, v);                 arrays, vectors, spans, of double or float
 *
 *   objects     NAME owns its object and can be moved, NAME_view does not; both have its methods
 *   arrays      spans, std::span where there is one; the first says how many there are. What is shorter than the function
 *               needs is refused as CM_ERROR_ARGUMENT, before anything is read or written; nobody looks into structs
 *   errors      what returns a cm_status in C throws; its twin that begins with try_ returns it
 *   modules     of the functions of colormap.h a program links cubemap-colormap, of those for pictures cubemap-image, of
 *               those of scene.h cubemap-scene
 *
 * Made by bindings/cpp/make_header.py of bindings/functions.
 */
// clang-format off
#ifndef CUBEMAP_CUBEMAP_HPP
#define CUBEMAP_CUBEMAP_HPP

#include <cubemap/colormap.h>
#include <cubemap/compare.h>
#include <cubemap/cubemap.h>
#include <cubemap/compensate.h>
#include <cubemap/depth_error.h>
#include <cubemap/environment.h>
#include <cubemap/image.h>
#include <cubemap/lens.h>
#include <cubemap/mips.h>
#include <cubemap/octree.h>
#include <cubemap/panorama.h>
#include <cubemap/sim.h>
#include <cubemap/scene.h>
#include <cubemap/texel.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <utility>
#if __cplusplus >= 202002L
#include <span>
#endif

namespace cubemap
{

#if defined(__cpp_lib_span)
template <class T> using span = std::span<T>;
#else
/* Elements one beside the other, which belong to somebody else: of std::span what is needed. */
template <class T> class span
{
public:
    constexpr span() noexcept = default;
    constexpr span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}
    template <std::size_t N> constexpr span(T (&array)[N]) noexcept : data_(array), size_(N) {}
    /* Of what ends with the call only what is read, as std::span has it. */
    template <class C, class = std::enable_if_t<(std::is_lvalue_reference_v<C> || std::is_const_v<T>) && std::is_convertible_v<
                           std::remove_pointer_t<decltype(std::declval<C &>().data())> (*)[], T (*)[]>>>
    constexpr span(C &&container) noexcept : data_(container.data()), size_(container.size()) {}
    constexpr T *data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr T *begin() const noexcept { return data_; }
    constexpr T *end() const noexcept { return data_ + size_; }
    constexpr T &operator[](std::size_t index) const noexcept { return data_[index]; }

private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};
#endif

/* What is thrown: the words of the library, and the status. */
class error : public std::runtime_error
{
public:
    explicit error(cm_status status) : error(status, "") {}
    /* Words for this case, or "". */
    error(cm_status status, const char *words) :
        std::runtime_error(*words != '\0' ? words : cm_status_text(status)), status_(status) {}
    cm_status status() const noexcept { return status_; }

private:
    cm_status status_;
};

/* An object, or why there is none; as std::expected. */
template <class T> class result
{
public:
    result(T &&value) noexcept : value_(std::move(value)), status_(CM_OK) {}
    result(cm_status status) noexcept : value_(static_cast<typename T::handle_type *>(nullptr)), status_(status) {}
    explicit operator bool() const noexcept { return status_ == CM_OK; }
    cm_status status() const noexcept { return status_; }
    T &operator*() noexcept { return value_; }
    T *operator->() noexcept { return &value_; }
    /* Throws what there is instead. */
    T &&value()
    {
        return value([](char *, std::size_t) {});
    }
    /* The same with the words that a function writes. */
    template <class Explain> T &&value(Explain explain)
    {
        if (status_ != CM_OK)
        {
            char words[256] = "";
            explain(words, sizeof words);
            throw error(status_, words);
        }
        return std::move(value_);
    }

private:
    T value_;
    cm_status status_;
};

namespace detail
{

inline void check(cm_status status)
{
    if (status != CM_OK)
    {
        throw error(status);
    }
}

// Of both series, where there are two.
inline std::size_t phase_images(const cm_tof_sensor &sensor)
{
    return static_cast<std::size_t>(sensor.phases < 0 ? 0 : sensor.phases) * (sensor.second_frequency > 0 ? 2 : 1);
}

/* A number of things; C refuses one below 0 itself. */
template <class N> constexpr std::size_t whole(N number) noexcept
{
    return number > N{0} ? static_cast<std::size_t>(number) : 0;
}

/* Is size at least the product of the others? */
constexpr bool holds(std::size_t size, std::size_t factor) noexcept
{
    return size >= factor;
}

template <class... Rest> constexpr bool holds(std::size_t size, std::size_t factor, std::size_t next, Rest... rest) noexcept
{
    return factor == 0 || holds(size / factor, next, static_cast<std::size_t>(rest)...);
}

/* Do three elements of each of n points have room, from stride to stride? Behind a span's end and ahead of its begin nothing does. */
constexpr bool strides(std::size_t size, std::size_t n, std::ptrdiff_t stride) noexcept
{
    return n == 0 || (size >= 3 && stride >= 0 && (stride == 0 || (size - 3) / static_cast<std::size_t>(stride) >= n - 1));
}

constexpr std::size_t sum(span<const std::size_t> numbers) noexcept
{
    std::size_t all = 0;
    for (std::size_t number : numbers)
    {
        all = number < SIZE_MAX - all ? all + number : SIZE_MAX;
    }
    return all;
}

constexpr std::size_t channels(const cm_image *picture) noexcept
{
    return picture != nullptr ? static_cast<std::size_t>(picture->channels) : 0;
}

constexpr std::size_t pixels(const cm_image &picture) noexcept
{
    return static_cast<std::size_t>(picture.width) * picture.height;
}

/* A view that owns what it shows. */
template <class View, class T, void (*destroy)(T *)> class owner : public View
{
public:
    using handle_type = T;
    explicit owner(T *handle) noexcept : View(handle), handle_(handle) {}
    owner(owner &&other) noexcept : View(other), handle_(std::exchange(other.handle_, nullptr))
    {
        static_cast<View &>(other) = View(nullptr);
    }
    owner &operator=(owner &&other) noexcept
    {
        owner moved(std::move(other)); /* so that the other is empty, but for oneself */
        std::swap(static_cast<View &>(*this), static_cast<View &>(moved));
        std::swap(handle_, moved.handle_);
        return *this;
    }
    owner(const owner &) = delete;
    owner &operator=(const owner &) = delete;
    ~owner()
    {
        if (handle_ != nullptr) /* which compilers often know */
        {
            destroy(handle_);
        }
    }

    /* The object goes to the caller, who ends it. */
    T *release() noexcept
    {
        static_cast<View &>(*this) = View(nullptr);
        return std::exchange(handle_, nullptr);
    }

private:
    T *handle_;
};

} // namespace detail

/* A blob that store_view::get fills, and that gives its bytes back. */
struct blob : cm_blob
{
    blob() noexcept : cm_blob{sizeof(cm_blob), 0, 0, nullptr, 0} {}
    blob(const blob &) = delete;
    blob &operator=(const blob &) = delete;
    ~blob() { cm_blob_clear(this); }
};

/* A struct of C with its size set, and zeros else. */
template <class T> T sized() noexcept
{
    T made{};
    made.size = sizeof(T);
    return made;
}

class advice_view;
class advice;
class brdf_view;
class brdf;
class camera_view;
class camera;
class cell_grid_view;
class cell_grid;
class colormap_view;
class colormap;
class depth_pyramid_view;
class depth_pyramid;
class environment_view;
class environment;
class errors_view;
class errors;
class grid_view;
class grid;
class healpix_view;
class healpix;
class latitude_conversion_view;
class latitude_conversion;
class lens_map_view;
class lens_map;
class mapping_view;
class mapping;
class mesh_view;
class mesh;
class mips_view;
class mips;
class motion_view;
class motion;
class octree_view;
class octree;
class plan_view;
class plan;
class pool_view;
class pool;
class raster_view;
class raster;
class rays_view;
class rays;
class region_view;
class region;
class scene_view;
class scene;
class source_view;
class source;
class store_view;
class store;
class surface_view;
class surface;
class tof_scene_view;
class tof_scene;
class trajectory_view;
class trajectory;

/* An object cm_advice that somebody else owns. */
class advice_view
{
public:
    explicit advice_view(const cm_advice *handle) noexcept : handle_(handle) {}
    const cm_advice *get() const noexcept { return handle_; }
    // cm_advice_count
    size_t count() const;
    // cm_advice_qualified
    size_t qualified() const;
    // cm_advice_at
    const cm_advice_candidate * at(size_t index) const;
    // cm_advice_reason
    void reason(size_t index, char *text, size_t size) const;

private:
    const cm_advice *handle_;
};

/* One of one's own: it can be moved, not copied. */
class advice : public detail::owner<advice_view, cm_advice, cm_advice_destroy>
{
public:
    explicit advice(cm_advice *handle) noexcept : owner(handle) {}
    // cm_advise
    static result<advice> try_make(const cm_advice_request &request, const cm_advice_costs &costs);
    advice(const cm_advice_request &request, const cm_advice_costs &costs);
};

/* An object cm_brdf that somebody else owns. */
class brdf_view
{
public:
    explicit brdf_view(const cm_brdf *handle) noexcept : handle_(handle) {}
    const cm_brdf *get() const noexcept { return handle_; }
    // cm_brdf_value
    double value(const double (&normal)[3], const double (&in)[3], const double (&out)[3]) const;
    // cm_brdf_albedo
    double albedo(double theta_in) const;
    // cm_brdf_sample_direction
    double sample_direction(const double (&normal)[3], const double (&out)[3], const double (&u)[3], double
        (&in)[3], double *density) const;
    // cm_brdf_density
    double density(const double (&normal)[3], const double (&in)[3], const double (&out)[3]) const;

private:
    const cm_brdf *handle_;
};

/* One of one's own: it can be moved, not copied. */
class brdf : public detail::owner<brdf_view, cm_brdf, cm_brdf_destroy>
{
public:
    explicit brdf(cm_brdf *handle) noexcept : owner(handle) {}
    // cm_brdf_create_lambert
    static result<brdf> try_lambert();
    static brdf lambert();
    // cm_brdf_create_cook_torrance
    static result<brdf> try_cook_torrance(const cm_cook_torrance &options);
    static brdf cook_torrance(const cm_cook_torrance &options);
    // cm_brdf_create_measured
    static result<brdf> try_measured(span<const cm_brdf_sample> sample);
    static brdf measured(span<const cm_brdf_sample> sample);
};

/* An object cm_camera that somebody else owns. */
class camera_view
{
public:
    explicit camera_view(const cm_camera *handle) noexcept : handle_(handle) {}
    const cm_camera *get() const noexcept { return handle_; }
    // cm_camera_describe
    const cm_camera_options * describe() const;
    // cm_camera_project_array
    void project(span<const double> x, span<const double> y, span<const double> z, span<double> column,
        span<double> row) const;
    // cm_camera_ray_array
    void ray(span<const double> column, span<const double> row, span<double> x, span<double> y, span<double>
        z) const;
    // cm_camera_jacobian
    void jacobian(const double (&point)[3], double (&jacobian)[6]) const;
    // cm_camera_solid_angle
    double solid_angle(double column, double row) const;
    // cm_camera_has_ray
    int has_ray(double column, double row) const;
    // cm_camera_border
    double border(double angle) const;
    // cm_lens_frustum
    cm_status try_lens_frustum(double (&frustum)[4]) const;
    void lens_frustum(double (&frustum)[4]) const;
    // cm_lens_guard
    cm_status try_lens_guard(double delta, double *guard) const;
    void lens_guard(double delta, double *guard) const;
    // cm_lens_move_vertices
    cm_status try_lens_move_vertices(double guard, span<const double> x, span<const double> y, span<const
        double> z, span<double> to_x, span<double> to_y, span<double> to_z) const;
    void lens_move_vertices(double guard, span<const double> x, span<const double> y, span<const double> z,
        span<double> to_x, span<double> to_y, span<double> to_z) const;
    // cm_lens_pinhole
    cm_status try_lens_pinhole(double scale, cm_camera_options *pinhole) const;
    void lens_pinhole(double scale, cm_camera_options *pinhole) const;

private:
    const cm_camera *handle_;
};

/* One of one's own: it can be moved, not copied. */
class camera : public detail::owner<camera_view, cm_camera, cm_camera_destroy>
{
public:
    explicit camera(cm_camera *handle) noexcept : owner(handle) {}
    // cm_camera_create
    static result<camera> try_make(const cm_camera_options *options = nullptr);
    explicit camera(const cm_camera_options *options = nullptr);
};

/* An object cm_cell_grid that somebody else owns. */
class cell_grid_view
{
public:
    explicit cell_grid_view(const cm_cell_grid *handle) noexcept : handle_(handle) {}
    const cm_cell_grid *get() const noexcept { return handle_; }
    // cm_cell_grid_of
    grid_view grid() const;
    // cm_cell_grid_curve
    cm_curve curve() const;
    // cm_cell_grid_is_s2
    int is_s2() const;
    // cm_cell_forward
    cm_cell forward(int level, const double (&normal)[3]) const;
    // cm_cell_forward_lonlat
    cm_cell forward_lonlat(int level, double lon, double lat) const;
    // cm_cell_forward_array
    void forward(int level, span<const double> x, span<const double> y, span<const double> z, span<cm_cell>
        cell) const;
    // cm_cell_forward_lonlat_array
    void forward_lonlat(int level, span<const double> lon, span<const double> lat, span<cm_cell> cell) const;
    // cm_cell_centre
    void centre(cm_cell cell, double (&normal)[3]) const;
    // cm_cell_centre_lonlat
    void centre_lonlat(cm_cell cell, double (&lonlat)[2]) const;
    // cm_cell_centre_array
    void centre(span<const cm_cell> cell, span<double> x, span<double> y, span<double> z) const;
    // cm_cell_centre_lonlat_array
    void centre_lonlat(span<const cm_cell> cell, span<double> lon, span<double> lat) const;
    // cm_cell_corners
    void corners(cm_cell cell, double (&normal)[4][3]) const;
    // cm_cell_corners_lonlat
    void corners_lonlat(cm_cell cell, double (&lonlat)[4][2]) const;
    // cm_cell_bounding_cap
    void bounding_cap(cm_cell cell, double (&normal)[3], double *radius) const;
    // cm_cell_area
    double area(cm_cell cell) const;
    // cm_cell_edge_neighbours
    int edge_neighbours(cm_cell cell, cm_cell (&to)[4]) const;
    // cm_cell_neighbours
    int neighbours(cm_cell cell, cm_cell (&to)[8]) const;
    // cm_cell_neighbours_at
    cm_status try_neighbours_at(cm_cell cell, int level, span<cm_cell> to, size_t *count) const;
    void neighbours_at(cm_cell cell, int level, span<cm_cell> to, size_t *count) const;
    // cm_cover
    cm_status try_cover(region_view region, const cm_cover_options *options, span<cm_cell> to, size_t *count)
        const;
    void cover(region_view region, const cm_cover_options *options, span<cm_cell> to, size_t *count) const;

private:
    const cm_cell_grid *handle_;
};

/* One of one's own: it can be moved, not copied. */
class cell_grid : public detail::owner<cell_grid_view, cm_cell_grid, cm_cell_grid_destroy>
{
public:
    explicit cell_grid(cm_cell_grid *handle) noexcept : owner(handle) {}
    // cm_cell_grid_create
    static result<cell_grid> try_make(grid_view grid, cm_curve curve);
    cell_grid(grid_view grid, cm_curve curve);
    // cm_cell_grid_create_s2
    static result<cell_grid> try_s2(grid_view grid);
    static cell_grid s2(grid_view grid);
};

/* An object cm_colormap that somebody else owns. */
class colormap_view
{
public:
    explicit colormap_view(const cm_colormap *handle) noexcept : handle_(handle) {}
    const cm_colormap *get() const noexcept { return handle_; }
    // cm_colormap_describe
    const cm_colormap_info * describe() const;
    // cm_colormap_parameter
    double parameter(size_t index) const;
    // cm_colormap_stop_count
    size_t stop_count() const;
    // cm_colormap_stop
    void stop(size_t index, double (&place_hue)[2]) const;
    // cm_colormap_specification
    size_t specification(char *text, size_t size) const;
    // cm_colormap_color_at
    void color_at(double t, cm_colormap_color *color) const;
    // cm_colormap_position
    double position(size_t n, size_t index) const;
    // cm_colormap_samples
    void samples(size_t n, span<double> srgb, cm_colormap_clipping *clipping) const;
    // cm_colormap_samples_u8
    void samples_u8(size_t n, span<uint8_t> srgb, cm_colormap_clipping *clipping) const;
    // cm_colormap_length
    double length() const;
    // cm_colormap_corner_count
    size_t corner_count() const;
    // cm_colormap_corner
    double corner(size_t index) const;
    // cm_colormap_inside
    int inside() const;
    // cm_colormap_largest_saturation
    double largest_saturation() const;

private:
    const cm_colormap *handle_;
};

/* One of one's own: it can be moved, not copied. */
class colormap : public detail::owner<colormap_view, cm_colormap, cm_colormap_destroy>
{
public:
    explicit colormap(cm_colormap *handle) noexcept : owner(handle) {}
    // cm_colormap_create
    static result<colormap> try_make(const char *specification);
    explicit colormap(const char *specification);
    // cm_colormap_fit
    result<colormap> try_fit() const;
    colormap fit() const;
};

/* An object cm_depth_pyramid that somebody else owns. */
class depth_pyramid_view
{
public:
    explicit depth_pyramid_view(cm_depth_pyramid *handle) noexcept : handle_(handle) {}
    cm_depth_pyramid *get() const noexcept { return handle_; }
    // cm_depth_pyramid_use_pool
    cm_status try_use_pool(pool_view pool) const;
    void use_pool(pool_view pool) const;
    // cm_depth_pyramid_pixel_count
    size_t pixel_count() const;
    // cm_depth_pyramid_fill
    cm_status try_fill(span<const float> image, unsigned threads) const;
    void fill(span<const float> image, unsigned threads) const;
    // cm_depth_pyramid_last
    uint32_t last() const;
    // cm_depth_pyramid_level
    cm_status try_level(uint32_t level, cm_depth_level *cells) const;
    void level(uint32_t level, cm_depth_level *cells) const;
    // cm_depth_pyramid_bounds
    cm_status try_bounds(uint32_t column, uint32_t row, uint32_t last_column, uint32_t last_row,
        cm_depth_bounds *bounds) const;
    void bounds(uint32_t column, uint32_t row, uint32_t last_column, uint32_t last_row, cm_depth_bounds
        *bounds) const;

private:
    cm_depth_pyramid *handle_;
};

/* One of one's own: it can be moved, not copied. */
class depth_pyramid : public detail::owner<depth_pyramid_view, cm_depth_pyramid, cm_depth_pyramid_destroy>
{
public:
    explicit depth_pyramid(cm_depth_pyramid *handle) noexcept : owner(handle) {}
    // cm_depth_pyramid_create
    static result<depth_pyramid> try_make(uint32_t width, uint32_t height, const char *instructions);
    depth_pyramid(uint32_t width, uint32_t height, const char *instructions);
};

/* An object cm_environment that somebody else owns. */
class environment_view
{
public:
    explicit environment_view(const cm_environment *handle) noexcept : handle_(handle) {}
    const cm_environment *get() const noexcept { return handle_; }
    // cm_environment_size
    uint32_t size() const;
    // cm_environment_channels
    uint32_t channels() const;
    // cm_environment_level_count
    uint32_t level_count() const;
    // cm_environment_project
    cm_status try_project(uint32_t degree, unsigned threads, span<double> coefficients) const;
    void project(uint32_t degree, unsigned threads, span<double> coefficients) const;
    // cm_environment_irradiance
    cm_status try_irradiance(mapping_view mapping, unsigned threads, const cm_image (&to)[6]) const;
    void irradiance(mapping_view mapping, unsigned threads, const cm_image (&to)[6]) const;
    // cm_environment_prefilter
    cm_status try_prefilter(double roughness, const cm_prefilter_options *options, mapping_view mapping, const
        cm_image (&to)[6]) const;
    void prefilter(double roughness, const cm_prefilter_options *options, mapping_view mapping, const cm_image
        (&to)[6]) const;

private:
    const cm_environment *handle_;
};

/* One of one's own: it can be moved, not copied. */
class environment : public detail::owner<environment_view, cm_environment, cm_environment_destroy>
{
public:
    explicit environment(cm_environment *handle) noexcept : owner(handle) {}
    // cm_environment_create
    static result<environment> try_make(mapping_view mapping, const cm_image (&faces)[6], unsigned threads);
    environment(mapping_view mapping, const cm_image (&faces)[6], unsigned threads);
};

/* An object cm_errors that somebody else owns. */
class errors_view
{
public:
    explicit errors_view(cm_errors *handle) noexcept : handle_(handle) {}
    cm_errors *get() const noexcept { return handle_; }
    // cm_errors_add
    cm_status try_add(const cm_image &reference, const cm_image &picture, const cm_image &weights) const;
    void add(const cm_image &reference, const cm_image &picture, const cm_image &weights) const;
    // cm_errors_get
    cm_status try_get(uint32_t channel, cm_error_figures *figures) const;
    void get(uint32_t channel, cm_error_figures *figures) const;

private:
    cm_errors *handle_;
};

/* One of one's own: it can be moved, not copied. */
class errors : public detail::owner<errors_view, cm_errors, cm_errors_destroy>
{
public:
    explicit errors(cm_errors *handle) noexcept : owner(handle) {}
    // cm_errors_create
    static result<errors> try_make(uint32_t channels, const cm_compare_options *options = nullptr);
    explicit errors(uint32_t channels, const cm_compare_options *options = nullptr);
};

/* An object cm_grid that somebody else owns. */
class grid_view
{
public:
    explicit grid_view(const cm_grid *handle) noexcept : handle_(handle) {}
    const cm_grid *get() const noexcept { return handle_; }
    // cm_grid_mapping
    mapping_view mapping() const;
    // cm_grid_ellipsoid
    const cm_ellipsoid * ellipsoid() const;
    // cm_grid_latitude
    cm_latitude latitude() const;
    // cm_grid_rotation
    const cm_rotation * rotation() const;
    // cm_grid_forward_lonlat
    uint8_t forward_lonlat(double lon, double lat, double (&uv)[2]) const;
    // cm_grid_inverse_lonlat
    void inverse_lonlat(uint8_t face, const double (&uv)[2], double (&lonlat)[2]) const;
    // cm_grid_forward
    uint8_t forward(const double (&normal)[3], double (&uv)[2]) const;
    // cm_grid_inverse
    void inverse(uint8_t face, const double (&uv)[2], double (&normal)[3]) const;
    // cm_grid_forward_lonlat_array
    void forward_lonlat(span<const double> lon, span<const double> lat, span<uint8_t> face, span<double> u,
        span<double> v) const;
    // cm_grid_inverse_lonlat_array
    void inverse_lonlat(span<const uint8_t> face, span<const double> u, span<const double> v, span<double>
        lon, span<double> lat) const;
    // cm_grid_forward_array
    void forward(span<const double> x, span<const double> y, span<const double> z, span<uint8_t> face,
        span<double> u, span<double> v) const;
    // cm_grid_inverse_array
    void inverse(span<const uint8_t> face, span<const double> u, span<const double> v, span<double> x,
        span<double> y, span<double> z) const;
    // cm_grid_to_sphere
    void to_sphere(const double (&normal)[3], double (&direction)[3]) const;
    // cm_grid_from_sphere
    void from_sphere(const double (&direction)[3], double (&normal)[3]) const;
    // cm_grid_to_sphere_array
    void to_sphere(span<const double> x, span<const double> y, span<const double> z, span<double> to_x,
        span<double> to_y, span<double> to_z) const;
    // cm_grid_from_sphere_array
    void from_sphere(span<const double> x, span<const double> y, span<const double> z, span<double> to_x,
        span<double> to_y, span<double> to_z) const;
    // cm_grid_area_element
    double area_element(uint8_t face, const double (&uv)[2]) const;
    // cm_grid_area_element_array
    void area_element(span<const uint8_t> face, span<const double> u, span<const double> v, span<double> area)
        const;
    // cm_grid_forward_distortion
    void forward_distortion(const double (&normal)[3], cm_distortion *distortion) const;
    // cm_grid_inverse_distortion
    void inverse_distortion(uint8_t face, const double (&uv)[2], cm_distortion *distortion) const;

private:
    const cm_grid *handle_;
};

/* One of one's own: it can be moved, not copied. */
class grid : public detail::owner<grid_view, cm_grid, cm_grid_destroy>
{
public:
    explicit grid(cm_grid *handle) noexcept : owner(handle) {}
    // cm_grid_create
    static result<grid> try_make(const cm_grid_options *options = nullptr);
    explicit grid(const cm_grid_options *options = nullptr);
};

/* An object cm_healpix that somebody else owns. */
class healpix_view
{
public:
    explicit healpix_view(const cm_healpix *handle) noexcept : handle_(handle) {}
    const cm_healpix *get() const noexcept { return handle_; }
    // cm_healpix_nside
    int64_t nside() const;
    // cm_healpix_order_of
    cm_healpix_order order() const;
    // cm_healpix_instructions
    const char * instructions() const;
    // cm_healpix_pixel_count
    int64_t pixel_count() const;
    // cm_healpix_ring_count
    int64_t ring_count() const;
    // cm_healpix_pixel_from_direction
    cm_status try_pixel_from_direction(const double (&direction)[3], int64_t *pixel) const;
    void pixel_from_direction(const double (&direction)[3], int64_t *pixel) const;
    // cm_healpix_pixel_from_angles
    cm_status try_pixel_from_angles(double theta, double phi, int64_t *pixel) const;
    void pixel_from_angles(double theta, double phi, int64_t *pixel) const;
    // cm_healpix_pixel_from_lonlat
    cm_status try_pixel_from_lonlat(double lon, double lat, int64_t *pixel) const;
    void pixel_from_lonlat(double lon, double lat, int64_t *pixel) const;
    // cm_healpix_direction_from_pixel
    cm_status try_direction_from_pixel(int64_t pixel, double (&direction)[3]) const;
    void direction_from_pixel(int64_t pixel, double (&direction)[3]) const;
    // cm_healpix_angles_from_pixel
    cm_status try_angles_from_pixel(int64_t pixel, double *theta, double *phi) const;
    void angles_from_pixel(int64_t pixel, double *theta, double *phi) const;
    // cm_healpix_lonlat_from_pixel
    cm_status try_lonlat_from_pixel(int64_t pixel, double (&lonlat)[2]) const;
    void lonlat_from_pixel(int64_t pixel, double (&lonlat)[2]) const;
    // cm_healpix_nested_from_ring
    cm_status try_nested_from_ring(int64_t ring, int64_t *nested) const;
    void nested_from_ring(int64_t ring, int64_t *nested) const;
    // cm_healpix_ring_from_nested
    cm_status try_ring_from_nested(int64_t nested, int64_t *ring) const;
    void ring_from_nested(int64_t nested, int64_t *ring) const;
    // cm_healpix_pixel_from_direction_array
    void pixel_from_direction(span<const double> x, span<const double> y, span<const double> z, span<int64_t>
        pixel) const;
    // cm_healpix_pixel_from_angles_array
    void pixel_from_angles(span<const double> theta, span<const double> phi, span<int64_t> pixel) const;
    // cm_healpix_pixel_from_lonlat_array
    void pixel_from_lonlat(span<const double> lon, span<const double> lat, span<int64_t> pixel) const;
    // cm_healpix_direction_from_pixel_array
    void direction_from_pixel(span<const int64_t> pixel, span<double> x, span<double> y, span<double> z)
        const;
    // cm_healpix_angles_from_pixel_array
    void angles_from_pixel(span<const int64_t> pixel, span<double> theta, span<double> phi) const;
    // cm_healpix_lonlat_from_pixel_array
    void lonlat_from_pixel(span<const int64_t> pixel, span<double> lon, span<double> lat) const;
    // cm_healpix_nested_from_ring_array
    cm_status try_nested_from_ring(span<const int64_t> ring, span<int64_t> nested) const;
    void nested_from_ring(span<const int64_t> ring, span<int64_t> nested) const;
    // cm_healpix_ring_from_nested_array
    cm_status try_ring_from_nested(span<const int64_t> nested, span<int64_t> ring) const;
    void ring_from_nested(span<const int64_t> nested, span<int64_t> ring) const;
    // cm_healpix_neighbours
    cm_status try_neighbours(int64_t pixel, int64_t (&neighbour)[8]) const;
    void neighbours(int64_t pixel, int64_t (&neighbour)[8]) const;
    // cm_healpix_boundary
    cm_status try_boundary(int64_t pixel, size_t steps, span<double> x, span<double> y, span<double> z) const;
    void boundary(int64_t pixel, size_t steps, span<double> x, span<double> y, span<double> z) const;
    // cm_healpix_ring_info
    cm_status try_ring_info(int64_t ring, cm_healpix_ring *info) const;
    void ring_info(int64_t ring, cm_healpix_ring *info) const;
    // cm_healpix_ring_from_pixel
    cm_status try_ring_from_pixel(int64_t pixel, int64_t *ring, int64_t *index) const;
    void ring_from_pixel(int64_t pixel, int64_t *ring, int64_t *index) const;
    // cm_healpix_regrade
    cm_status try_regrade(span<const double> map, healpix_view to, span<double> result, const
        cm_healpix_regrade_options *options = nullptr) const;
    void regrade(span<const double> map, healpix_view to, span<double> result, const
        cm_healpix_regrade_options *options = nullptr) const;
    // cm_healpix_regrade_f32
    cm_status try_regrade(span<const float> map, healpix_view to, span<float> result, const
        cm_healpix_regrade_options *options = nullptr) const;
    void regrade(span<const float> map, healpix_view to, span<float> result, const cm_healpix_regrade_options
        *options = nullptr) const;

private:
    const cm_healpix *handle_;
};

/* One of one's own: it can be moved, not copied. */
class healpix : public detail::owner<healpix_view, cm_healpix, cm_healpix_destroy>
{
public:
    explicit healpix(cm_healpix *handle) noexcept : owner(handle) {}
    // cm_healpix_create
    static result<healpix> try_make(int64_t nside, cm_healpix_order order, const cm_options *options =
        nullptr);
    healpix(int64_t nside, cm_healpix_order order, const cm_options *options = nullptr);
};

/* An object cm_latitude_conversion that somebody else owns. */
class latitude_conversion_view
{
public:
    explicit latitude_conversion_view(const cm_latitude_conversion *handle) noexcept : handle_(handle) {}
    const cm_latitude_conversion *get() const noexcept { return handle_; }
    // cm_latitude_conversion_order
    int order() const;
    // cm_latitude_conversion_error
    double error() const;
    // cm_latitude_conversion_constants
    cm_status try_constants(double (&constants)[13], int *terms) const;
    void constants(double (&constants)[13], int *terms) const;
    // cm_latitude_convert
    double convert(double latitude) const;
    // cm_latitude_convert_direction
    void convert_direction(const double (&from)[3], double (&to)[3]) const;
    // cm_latitude_convert_array
    void convert(span<const double> from, span<double> to) const;
    // cm_latitude_convert_direction_array
    void convert_direction(span<const double> x, span<const double> y, span<const double> z, span<double>
        to_x, span<double> to_y, span<double> to_z) const;

private:
    const cm_latitude_conversion *handle_;
};

/* One of one's own: it can be moved, not copied. */
class latitude_conversion : public detail::owner<latitude_conversion_view, cm_latitude_conversion, cm_latitude_conversion_destroy>
{
public:
    explicit latitude_conversion(cm_latitude_conversion *handle) noexcept : owner(handle) {}
    // cm_latitude_conversion_create
    static result<latitude_conversion> try_make(const cm_ellipsoid &ellipsoid, cm_latitude from, cm_latitude
        to, const cm_latitude_options *options = nullptr);
    latitude_conversion(const cm_ellipsoid &ellipsoid, cm_latitude from, cm_latitude to, const
        cm_latitude_options *options = nullptr);
};

/* An object cm_lens_map that somebody else owns. */
class lens_map_view
{
public:
    explicit lens_map_view(const cm_lens_map *handle) noexcept : handle_(handle) {}
    const cm_lens_map *get() const noexcept { return handle_; }
    // cm_lens_map_unfilled
    size_t unfilled() const;
    // cm_lens_map_pixel_count
    size_t pixel_count() const;
    // cm_lens_map_pinhole_pixel_count
    size_t pinhole_pixel_count() const;
    // cm_lens_map_places
    cm_status try_places(span<double> column, span<double> row) const;
    void places(span<double> column, span<double> row) const;
    // cm_lens_map_color
    cm_status try_color(uint32_t channels, span<const float> from, span<float> to, pool_view pool) const;
    void color(uint32_t channels, span<const float> from, span<float> to, pool_view pool) const;
    // cm_lens_map_depth
    cm_status try_depth(double gap, span<const float> from, span<float> to, pool_view pool) const;
    void depth(double gap, span<const float> from, span<float> to, pool_view pool) const;
    // cm_lens_map_labels
    cm_status try_labels(size_t bytes, const void *from, const void *nothing, void *to, pool_view pool) const;
    void labels(size_t bytes, const void *from, const void *nothing, void *to, pool_view pool) const;
    // cm_lens_map_flow
    cm_status try_flow(span<const float> from, span<float> to, pool_view pool) const;
    void flow(span<const float> from, span<float> to, pool_view pool) const;

private:
    const cm_lens_map *handle_;
};

/* One of one's own: it can be moved, not copied. */
class lens_map : public detail::owner<lens_map_view, cm_lens_map, cm_lens_map_destroy>
{
public:
    explicit lens_map(cm_lens_map *handle) noexcept : owner(handle) {}
    // cm_lens_map_create
    static result<lens_map> try_make(camera_view camera, camera_view pinhole, pool_view pool);
    lens_map(camera_view camera, camera_view pinhole, pool_view pool);
};

/* An object cm_mapping that somebody else owns. */
class mapping_view
{
public:
    explicit mapping_view(const cm_mapping *handle) noexcept : handle_(handle) {}
    const cm_mapping *get() const noexcept { return handle_; }
    // cm_advise_size
    cm_status try_advise_size(double angle, cm_advice_size *size) const;
    void advise_size(double angle, cm_advice_size *size) const;
    // cm_advise_precision
    cm_status try_advise_precision(double metres, cm_advice_precision *precision) const;
    void advise_precision(double metres, cm_advice_precision *precision) const;
    // cm_face_weights
    cm_status try_face_weights(uint8_t face, uint32_t edge, unsigned threads, span<float> weights) const;
    void face_weights(uint8_t face, uint32_t edge, unsigned threads, span<float> weights) const;
    // cm_forward_distortion
    void forward_distortion(const double (&direction)[3], cm_distortion *distortion) const;
    // cm_forward_distortion_f32
    void forward_distortion(const float (&direction)[3], cm_distortion_f32 *distortion) const;
    // cm_inverse_distortion
    void inverse_distortion(uint8_t face, const double (&uv)[2], cm_distortion *distortion) const;
    // cm_inverse_distortion_f32
    void inverse_distortion(uint8_t face, const float (&uv)[2], cm_distortion_f32 *distortion) const;
    // cm_forward_distortion_array
    void forward_distortion(span<const double> x, span<const double> y, span<const double> z, const
        cm_distortion_arrays *distortion) const;
    // cm_forward_distortion_array_f32
    void forward_distortion(span<const float> x, span<const float> y, span<const float> z, const
        cm_distortion_arrays_f32 *distortion) const;
    // cm_inverse_distortion_array
    void inverse_distortion(span<const uint8_t> face, span<const double> u, span<const double> v, const
        cm_distortion_arrays *distortion) const;
    // cm_inverse_distortion_array_f32
    void inverse_distortion(span<const uint8_t> face, span<const float> u, span<const float> v, const
        cm_distortion_arrays_f32 *distortion) const;
    // cm_texel_solid_angles
    cm_status try_texel_solid_angles(uint8_t face, uint32_t size, span<double> angle) const;
    void texel_solid_angles(uint8_t face, uint32_t size, span<double> angle) const;
    // cm_mapping_describe
    const cm_mapping_info * describe() const;
    // cm_mapping_frame
    const cm_frame * frame() const;
    // cm_mapping_parameter
    double parameter(size_t index) const;
    // cm_mapping_has_bounds
    int has_bounds() const;
    // cm_forward
    uint8_t forward(const double (&direction)[3], double (&uv)[2]) const;
    // cm_forward_f32
    uint8_t forward(const float (&direction)[3], float (&uv)[2]) const;
    // cm_inverse
    void inverse(uint8_t face, const double (&uv)[2], double (&direction)[3]) const;
    // cm_inverse_f32
    void inverse(uint8_t face, const float (&uv)[2], float (&direction)[3]) const;
    // cm_forward_lonlat
    uint8_t forward_lonlat(double lon, double lat, double (&uv)[2]) const;
    // cm_inverse_lonlat
    void inverse_lonlat(uint8_t face, const double (&uv)[2], double (&lonlat)[2]) const;
    // cm_forward_lonlat_array
    void forward_lonlat(span<const double> lon, span<const double> lat, span<uint8_t> face, span<double> u,
        span<double> v) const;
    // cm_inverse_lonlat_array
    void inverse_lonlat(span<const uint8_t> face, span<const double> u, span<const double> v, span<double>
        lon, span<double> lat) const;
    // cm_forward_array
    void forward(span<const double> x, span<const double> y, span<const double> z, span<uint8_t> face,
        span<double> u, span<double> v) const;
    // cm_forward_array_f32
    void forward(span<const float> x, span<const float> y, span<const float> z, span<uint8_t> face,
        span<float> u, span<float> v) const;
    // cm_inverse_array
    void inverse(span<const uint8_t> face, span<const double> u, span<const double> v, span<double> x,
        span<double> y, span<double> z) const;
    // cm_inverse_array_f32
    void inverse(span<const uint8_t> face, span<const float> u, span<const float> v, span<float> x,
        span<float> y, span<float> z) const;
    // cm_forward_strided
    void forward_strided(span<const double> xyz, ptrdiff_t stride, span<uint8_t> face, span<double> u,
        span<double> v) const;
    // cm_forward_strided_f32
    void forward_strided(span<const float> xyz, ptrdiff_t stride, span<uint8_t> face, span<float> u,
        span<float> v) const;
    // cm_inverse_strided
    void inverse_strided(span<const uint8_t> face, span<const double> u, span<const double> v, span<double>
        xyz, ptrdiff_t stride) const;
    // cm_inverse_strided_f32
    void inverse_strided(span<const uint8_t> face, span<const float> u, span<const float> v, span<float> xyz,
        ptrdiff_t stride) const;
    // cm_forward_jacobian
    void forward_jacobian(const double (&direction)[3], double (&jacobian)[6]) const;
    // cm_forward_jacobian_f32
    void forward_jacobian(const float (&direction)[3], float (&jacobian)[6]) const;
    // cm_inverse_jacobian
    void inverse_jacobian(uint8_t face, const double (&uv)[2], double (&jacobian)[6]) const;
    // cm_inverse_jacobian_f32
    void inverse_jacobian(uint8_t face, const float (&uv)[2], float (&jacobian)[6]) const;
    // cm_forward_jacobian_array
    void forward_jacobian(span<const double> x, span<const double> y, span<const double> z, double *const
        (&jacobian)[6]) const;
    // cm_forward_jacobian_array_f32
    void forward_jacobian(span<const float> x, span<const float> y, span<const float> z, float *const
        (&jacobian)[6]) const;
    // cm_inverse_jacobian_array
    void inverse_jacobian(span<const uint8_t> face, span<const double> u, span<const double> v, double *const
        (&jacobian)[6]) const;
    // cm_inverse_jacobian_array_f32
    void inverse_jacobian(span<const uint8_t> face, span<const float> u, span<const float> v, float *const
        (&jacobian)[6]) const;
    // cm_warp
    cm_status try_warp(const double (&pq)[2], double (&uv)[2]) const;
    void warp(const double (&pq)[2], double (&uv)[2]) const;
    // cm_warp_f32
    cm_status try_warp(const float (&pq)[2], float (&uv)[2]) const;
    void warp(const float (&pq)[2], float (&uv)[2]) const;
    // cm_unwarp
    cm_status try_unwarp(const double (&uv)[2], double (&pq)[2]) const;
    void unwarp(const double (&uv)[2], double (&pq)[2]) const;
    // cm_unwarp_f32
    cm_status try_unwarp(const float (&uv)[2], float (&pq)[2]) const;
    void unwarp(const float (&uv)[2], float (&pq)[2]) const;
    // cm_warp_array
    cm_status try_warp(span<const double> p, span<const double> q, span<double> u, span<double> v) const;
    void warp(span<const double> p, span<const double> q, span<double> u, span<double> v) const;
    // cm_warp_array_f32
    cm_status try_warp(span<const float> p, span<const float> q, span<float> u, span<float> v) const;
    void warp(span<const float> p, span<const float> q, span<float> u, span<float> v) const;
    // cm_unwarp_array
    cm_status try_unwarp(span<const double> u, span<const double> v, span<double> p, span<double> q) const;
    void unwarp(span<const double> u, span<const double> v, span<double> p, span<double> q) const;
    // cm_unwarp_array_f32
    cm_status try_unwarp(span<const float> u, span<const float> v, span<float> p, span<float> q) const;
    void unwarp(span<const float> u, span<const float> v, span<float> p, span<float> q) const;
    // cm_warp_jacobian
    cm_status try_warp_jacobian(const double (&pq)[2], double (&jacobian)[4]) const;
    void warp_jacobian(const double (&pq)[2], double (&jacobian)[4]) const;
    // cm_warp_jacobian_f32
    cm_status try_warp_jacobian(const float (&pq)[2], float (&jacobian)[4]) const;
    void warp_jacobian(const float (&pq)[2], float (&jacobian)[4]) const;
    // cm_warp_jacobian_array
    cm_status try_warp_jacobian(span<const double> p, span<const double> q, double *const (&jacobian)[4])
        const;
    void warp_jacobian(span<const double> p, span<const double> q, double *const (&jacobian)[4]) const;
    // cm_warp_jacobian_array_f32
    cm_status try_warp_jacobian(span<const float> p, span<const float> q, float *const (&jacobian)[4]) const;
    void warp_jacobian(span<const float> p, span<const float> q, float *const (&jacobian)[4]) const;
    // cm_mapping_tier
    cm_tier tier() const;
    // cm_mapping_instructions
    const char * instructions() const;
    // cm_orient
    cm_status try_orient(const cm_mask &mask, const cm_orient_options *options, cm_orient_result *result)
        const;
    void orient(const cm_mask &mask, const cm_orient_options *options, cm_orient_result *result) const;
    // cm_orient_value
    cm_status try_orient_value(const cm_mask &mask, const cm_orient_options *options, const cm_rotation
        &rotation, double *value) const;
    void orient_value(const cm_mask &mask, const cm_orient_options *options, const cm_rotation &rotation,
        double *value) const;
    // cm_distortion_statistics
    cm_status try_distortion_statistics(cm_quantity quantity, const cm_statistics_options *options,
        cm_statistics *statistics) const;
    void distortion_statistics(cm_quantity quantity, const cm_statistics_options *options, cm_statistics
        *statistics) const;
    // cm_distortion_percentiles
    cm_status try_distortion_percentiles(cm_quantity quantity, const cm_statistics_options *options,
        span<const double> percent, span<double> value, span<double> doubt) const;
    void distortion_percentiles(cm_quantity quantity, const cm_statistics_options *options, span<const double>
        percent, span<double> value, span<double> doubt) const;
    // cm_forward_array_threads
    void forward(unsigned threads, span<const double> x, span<const double> y, span<const double> z,
        span<uint8_t> face, span<double> u, span<double> v) const;
    // cm_forward_array_threads_f32
    void forward(unsigned threads, span<const float> x, span<const float> y, span<const float> z,
        span<uint8_t> face, span<float> u, span<float> v) const;
    // cm_inverse_array_threads
    void inverse(unsigned threads, span<const uint8_t> face, span<const double> u, span<const double> v,
        span<double> x, span<double> y, span<double> z) const;
    // cm_inverse_array_threads_f32
    void inverse(unsigned threads, span<const uint8_t> face, span<const float> u, span<const float> v,
        span<float> x, span<float> y, span<float> z) const;
    // cm_forward_strided_threads
    void forward_strided(unsigned threads, span<const double> xyz, ptrdiff_t stride, span<uint8_t> face,
        span<double> u, span<double> v) const;
    // cm_forward_strided_threads_f32
    void forward_strided(unsigned threads, span<const float> xyz, ptrdiff_t stride, span<uint8_t> face,
        span<float> u, span<float> v) const;
    // cm_inverse_strided_threads
    void inverse_strided(unsigned threads, span<const uint8_t> face, span<const double> u, span<const double>
        v, span<double> xyz, ptrdiff_t stride) const;
    // cm_inverse_strided_threads_f32
    void inverse_strided(unsigned threads, span<const uint8_t> face, span<const float> u, span<const float> v,
        span<float> xyz, ptrdiff_t stride) const;
    // cm_forward_jacobian_array_threads
    void forward_jacobian(unsigned threads, span<const double> x, span<const double> y, span<const double> z,
        double *const (&jacobian)[6]) const;
    // cm_forward_jacobian_array_threads_f32
    void forward_jacobian(unsigned threads, span<const float> x, span<const float> y, span<const float> z,
        float *const (&jacobian)[6]) const;
    // cm_inverse_jacobian_array_threads
    void inverse_jacobian(unsigned threads, span<const uint8_t> face, span<const double> u, span<const double>
        v, double *const (&jacobian)[6]) const;
    // cm_inverse_jacobian_array_threads_f32
    void inverse_jacobian(unsigned threads, span<const uint8_t> face, span<const float> u, span<const float>
        v, float *const (&jacobian)[6]) const;

private:
    const cm_mapping *handle_;
};

/* One of one's own: it can be moved, not copied. */
class mapping : public detail::owner<mapping_view, cm_mapping, cm_mapping_destroy>
{
public:
    explicit mapping(cm_mapping *handle) noexcept : owner(handle) {}
    // cm_mapping_create
    static result<mapping> try_make(const char *specification, const cm_frame *frame = nullptr);
    explicit mapping(const char *specification, const cm_frame *frame = nullptr);
    // cm_mapping_create_with
    static result<mapping> try_make(const char *specification, const cm_frame *frame, const cm_options
        *options);
    mapping(const char *specification, const cm_frame *frame, const cm_options *options);
};

/* An object cm_mesh that somebody else owns. */
class mesh_view
{
public:
    explicit mesh_view(const cm_mesh *handle) noexcept : handle_(handle) {}
    const cm_mesh *get() const noexcept { return handle_; }
    // cm_mesh_describe
    const cm_mesh_options * describe() const;
    // cm_mesh_bounds
    void bounds(double (&least)[3], double (&greatest)[3]) const;

private:
    const cm_mesh *handle_;
};

/* One of one's own: it can be moved, not copied. */
class mesh : public detail::owner<mesh_view, cm_mesh, cm_mesh_destroy>
{
public:
    explicit mesh(cm_mesh *handle) noexcept : owner(handle) {}
    // cm_mesh_create
    static result<mesh> try_make(const cm_mesh_options &options);
    explicit mesh(const cm_mesh_options &options);
};

/* An object cm_mips that somebody else owns. */
class mips_view
{
public:
    explicit mips_view(const cm_mips *handle) noexcept : handle_(handle) {}
    const cm_mips *get() const noexcept { return handle_; }
    // cm_mips_count
    uint32_t count() const;
    // cm_mips_pictures
    const cm_image * pictures(uint32_t level) const;

private:
    const cm_mips *handle_;
};

/* One of one's own: it can be moved, not copied. */
class mips : public detail::owner<mips_view, cm_mips, cm_mips_destroy>
{
public:
    explicit mips(cm_mips *handle) noexcept : owner(handle) {}
    // cm_mips_create
    static result<mips> try_make(surface_view surface, const cm_image *pictures, const cm_plan_options
        *options, unsigned threads);
    mips(surface_view surface, const cm_image *pictures, const cm_plan_options *options, unsigned threads);
};

/* An object cm_motion that somebody else owns. */
class motion_view
{
public:
    explicit motion_view(const cm_motion *handle) noexcept : handle_(handle) {}
    const cm_motion *get() const noexcept { return handle_; }
    // cm_motion_at
    cm_status try_at(double time, cm_motion_state *state) const;
    void at(double time, cm_motion_state *state) const;
    // cm_motion_inertial
    cm_status try_inertial(const cm_inertial_options *options, span<double> stamp, span<double> acceleration,
        span<double> rate, size_t *count) const;
    void inertial(const cm_inertial_options *options, span<double> stamp, span<double> acceleration,
        span<double> rate, size_t *count) const;

private:
    const cm_motion *handle_;
};

/* One of one's own: it can be moved, not copied. */
class motion : public detail::owner<motion_view, cm_motion, cm_motion_destroy>
{
public:
    explicit motion(cm_motion *handle) noexcept : owner(handle) {}
    // cm_motion_create
    static result<motion> try_make(trajectory_view trajectory);
    explicit motion(trajectory_view trajectory);
};

/* An object cm_octree that somebody else owns. */
class octree_view
{
public:
    explicit octree_view(cm_octree *handle) noexcept : handle_(handle) {}
    cm_octree *get() const noexcept { return handle_; }
    // cm_octree_describe
    const cm_octree_options * describe() const;
    // cm_octree_update
    cm_status try_update(const cm_view &view, pool_view pool) const;
    void update(const cm_view &view, pool_view pool) const;
    // cm_octree_update_points
    cm_status try_update_points(const double (&origin)[3], size_t n, span<const float> xyz, span<const
        uint8_t> rgb) const;
    void update_points(const double (&origin)[3], size_t n, span<const float> xyz, span<const uint8_t> rgb)
        const;
    // cm_octree_merge
    cm_status try_merge(octree_view from, const cm_pose &pose) const;
    void merge(octree_view from, const cm_pose &pose) const;
    // cm_octree_compact
    cm_status try_compact() const;
    void compact() const;
    // cm_octree_at
    int at(const double (&point)[3], int level, cm_voxel *voxel) const;
    // cm_octree_ray
    int ray(const double (&origin)[3], const double (&direction)[3], double far, cm_voxel *voxel) const;
    // cm_octree_nearest
    int nearest(const double (&point)[3], double radius, cm_voxel *voxel) const;
    // cm_octree_walk_ray
    cm_status try_walk_ray(const double (&origin)[3], const double (&direction)[3], double far, cm_voxel_job
        job, void *user) const;
    void walk_ray(const double (&origin)[3], const double (&direction)[3], double far, cm_voxel_job job, void
        *user) const;
    // cm_octree_walk_box
    cm_status try_walk_box(const double (&least)[3], const double (&greatest)[3], cm_voxel_job job, void
        *user) const;
    void walk_box(const double (&least)[3], const double (&greatest)[3], cm_voxel_job job, void *user) const;
    // cm_octree_walk_changes
    cm_status try_walk_changes(uint64_t since, cm_voxel_job job, void *user) const;
    void walk_changes(uint64_t since, cm_voxel_job job, void *user) const;
    // cm_octree_step
    uint64_t step() const;
    // cm_octree_extract
    cm_status try_extract(int level, span<cm_voxel> voxel, size_t *count) const;
    void extract(int level, span<cm_voxel> voxel, size_t *count) const;
    // cm_octree_count_voxels
    cm_status try_count_voxels(cm_octree_count *count) const;
    void count_voxels(cm_octree_count *count) const;
    // cm_octree_save
    cm_status try_save(store_view store, const void *user_data, size_t count) const;
    void save(store_view store, const void *user_data, size_t count) const;
    // cm_octree_user_data
    const void * user_data(size_t *count) const;
    // cm_octree_render
    cm_status try_render(camera_view camera, const cm_pose &pose, const cm_octree_shading &shading, cm_image
        *color, cm_image *depth) const;
    void render(camera_view camera, const cm_pose &pose, const cm_octree_shading &shading, cm_image *color,
        cm_image *depth) const;
    // cm_hull_carve
    cm_status try_carve_hull(span<const cm_view> masks, int outside_survives, pool_view pool) const;
    void carve_hull(span<const cm_view> masks, int outside_survives, pool_view pool) const;

private:
    cm_octree *handle_;
};

/* One of one's own: it can be moved, not copied. */
class octree : public detail::owner<octree_view, cm_octree, cm_octree_destroy>
{
public:
    explicit octree(cm_octree *handle) noexcept : owner(handle) {}
    // cm_octree_create
    static result<octree> try_make(const cm_octree_options &options);
    explicit octree(const cm_octree_options &options);
    // cm_octree_load
    static result<octree> try_load(store_view store, const cm_octree_options &options);
    static octree load(store_view store, const cm_octree_options &options);
};

/* An object cm_plan that somebody else owns. */
class plan_view
{
public:
    explicit plan_view(const cm_plan *handle) noexcept : handle_(handle) {}
    const cm_plan *get() const noexcept { return handle_; }
    // cm_plan_write
    cm_status try_write(char *text, size_t size, size_t *length) const;
    void write(char *text, size_t size, size_t *length) const;
    // cm_resample_source
    cm_status try_resample_source(source_view source, cm_image *to, cm_rows rows, unsigned threads) const;
    void resample_source(source_view source, cm_image *to, cm_rows rows, unsigned threads) const;
    // cm_resample
    cm_status try_resample(const cm_image *from, cm_image *to, cm_rows rows) const;
    void resample(const cm_image *from, cm_image *to, cm_rows rows) const;

private:
    const cm_plan *handle_;
};

/* One of one's own: it can be moved, not copied. */
class plan : public detail::owner<plan_view, cm_plan, cm_plan_destroy>
{
public:
    explicit plan(cm_plan *handle) noexcept : owner(handle) {}
    // cm_plan_create
    static result<plan> try_make(surface_view from, surface_view to, const cm_plan_options *options =
        nullptr);
    plan(surface_view from, surface_view to, const cm_plan_options *options = nullptr);
    // cm_plan_read
    static result<plan> try_read(span<const char> text, const char *instructions);
    static plan read(span<const char> text, const char *instructions);
};

/* An object cm_pool that somebody else owns. */
class pool_view
{
public:
    explicit pool_view(cm_pool *handle) noexcept : handle_(handle) {}
    cm_pool *get() const noexcept { return handle_; }
    // cm_pool_threads
    unsigned threads() const;
    // cm_pool_run
    void run(size_t n, size_t least, cm_job job, void *user) const;

private:
    cm_pool *handle_;
};

/* One of one's own: it can be moved, not copied. */
class pool : public detail::owner<pool_view, cm_pool, cm_pool_destroy>
{
public:
    explicit pool(cm_pool *handle) noexcept : owner(handle) {}
    // cm_pool_create
    static result<pool> try_make(unsigned threads);
    explicit pool(unsigned threads);
};

/* An object cm_raster that somebody else owns. */
class raster_view
{
public:
    explicit raster_view(cm_raster *handle) noexcept : handle_(handle) {}
    cm_raster *get() const noexcept { return handle_; }
    // cm_raster_use_pool
    cm_status try_use_pool(pool_view pool) const;
    void use_pool(pool_view pool) const;
    // cm_raster_pixel_count
    size_t pixel_count() const;
    // cm_raster_clear
    void clear() const;
    // cm_raster_triangles
    cm_status try_triangles(const cm_pose *pose, const cm_triangles &triangles, unsigned threads) const;
    void triangles(const cm_pose *pose, const cm_triangles &triangles, unsigned threads) const;
    // cm_raster_discs
    cm_status try_discs(const cm_pose *pose, const cm_discs &discs, unsigned threads) const;
    void discs(const cm_pose *pose, const cm_discs &discs, unsigned threads) const;
    // cm_raster_points
    cm_status try_points(const cm_pose *pose, const cm_points &points, unsigned threads) const;
    void points(const cm_pose *pose, const cm_points &points, unsigned threads) const;
    // cm_raster_read
    cm_status try_read(span<float> image, span<uint32_t> id) const;
    void read(span<float> image, span<uint32_t> id) const;
    // cm_raster_weights
    cm_status try_weights(const cm_pose *pose, const cm_triangles &triangles, span<float> second, span<float>
        third) const;
    void weights(const cm_pose *pose, const cm_triangles &triangles, span<float> second, span<float> third)
        const;

private:
    cm_raster *handle_;
};

/* One of one's own: it can be moved, not copied. */
class raster : public detail::owner<raster_view, cm_raster, cm_raster_destroy>
{
public:
    explicit raster(cm_raster *handle) noexcept : owner(handle) {}
    // cm_raster_create
    static result<raster> try_make(camera_view camera, double nearest, const char *instructions);
    raster(camera_view camera, double nearest, const char *instructions);
};

/* An object cm_rays that somebody else owns. */
class rays_view
{
public:
    explicit rays_view(cm_rays *handle) noexcept : handle_(handle) {}
    cm_rays *get() const noexcept { return handle_; }
    // cm_rays_use_pool
    cm_status try_use_pool(pool_view pool) const;
    void use_pool(pool_view pool) const;
    // cm_rays_pixel_count
    size_t pixel_count() const;
    // cm_rays_halved_pixel_count
    size_t halved_pixel_count() const;
    // cm_depth_to_range
    cm_status try_to_range(span<const float> depth, unsigned threads, span<float> range) const;
    void to_range(span<const float> depth, unsigned threads, span<float> range) const;
    // cm_depth_from_range
    cm_status try_from_range(span<const float> range, unsigned threads, span<float> depth) const;
    void from_range(span<const float> range, unsigned threads, span<float> depth) const;
    // cm_depth_make_maps
    cm_status try_make_maps(span<const float> image, unsigned threads, const cm_depth_maps &maps) const;
    void make_maps(span<const float> image, unsigned threads, const cm_depth_maps &maps) const;
    // cm_depth_smooth
    cm_status try_smooth(span<const float> from, double pixels, double metres, unsigned threads, span<float>
        to) const;
    void smooth(span<const float> from, double pixels, double metres, unsigned threads, span<float> to) const;
    // cm_depth_halve
    cm_status try_halve(span<const float> from, double gap, unsigned threads, span<float> to) const;
    void halve(span<const float> from, double gap, unsigned threads, span<float> to) const;

private:
    cm_rays *handle_;
};

/* One of one's own: it can be moved, not copied. */
class rays : public detail::owner<rays_view, cm_rays, cm_rays_destroy>
{
public:
    explicit rays(cm_rays *handle) noexcept : owner(handle) {}
    // cm_rays_create
    static result<rays> try_make(camera_view camera, const char *instructions);
    rays(camera_view camera, const char *instructions);
};

/* An object cm_region that somebody else owns. */
class region_view
{
public:
    explicit region_view(const cm_region *handle) noexcept : handle_(handle) {}
    const cm_region *get() const noexcept { return handle_; }
    // cm_region_contains
    int contains(const double (&normal)[3]) const;

private:
    const cm_region *handle_;
};

/* One of one's own: it can be moved, not copied. */
class region : public detail::owner<region_view, cm_region, cm_region_destroy>
{
public:
    explicit region(cm_region *handle) noexcept : owner(handle) {}
    // cm_region_cap
    static result<region> try_cap(const double (&normal)[3], double radius);
    static region cap(const double (&normal)[3], double radius);
    // cm_region_cap_lonlat
    static result<region> try_cap_lonlat(double lon, double lat, double radius);
    static region cap_lonlat(double lon, double lat, double radius);
    // cm_region_box
    static result<region> try_box(double west, double south, double east, double north);
    static region box(double west, double south, double east, double north);
    // cm_region_polygon
    static result<region> try_polygon(span<const size_t> ring_length, span<const double> lonlat);
    static region polygon(span<const size_t> ring_length, span<const double> lonlat);
};

/* An object cm_scene that somebody else owns. */
class scene_view
{
public:
    explicit scene_view(cm_scene *handle) noexcept : handle_(handle) {}
    cm_scene *get() const noexcept { return handle_; }
    // cm_texel_render
    cm_status try_texel_render(const cm_pose &pose, const cm_texel_options &options, pool_view pool, const
        cm_texel_image &image) const;
    void texel_render(const cm_pose &pose, const cm_texel_options &options, pool_view pool, const
        cm_texel_image &image) const;
    // cm_scene_add
    cm_status try_add(const cm_primitive &primitive, uint32_t *id) const;
    void add(const cm_primitive &primitive, uint32_t *id) const;
    // cm_scene_count
    size_t count() const;
    // cm_scene_at
    const cm_primitive * at(uint32_t id) const;
    // cm_scene_cast_array
    void cast(span<const double> origin_x, span<const double> origin_y, span<const double> origin_z,
        span<const double> direction_x, span<const double> direction_y, span<const double> direction_z, const
        cm_hit_arrays *hit) const;

private:
    cm_scene *handle_;
};

/* One of one's own: it can be moved, not copied. */
class scene : public detail::owner<scene_view, cm_scene, cm_scene_destroy>
{
public:
    explicit scene(cm_scene *handle) noexcept : owner(handle) {}
    // cm_scene_create
    static result<scene> try_make();
    explicit scene();
    // cm_scene_create_named
    static result<scene> try_named(const char *name);
    static scene named(const char *name);
};

/* An object cm_source that somebody else owns. */
class source_view
{
public:
    explicit source_view(const cm_source *handle) noexcept : handle_(handle) {}
    const cm_source *get() const noexcept { return handle_; }
    // cm_source_filter
    cm_filter filter() const;

private:
    const cm_source *handle_;
};

/* One of one's own: it can be moved, not copied. */
class source : public detail::owner<source_view, cm_source, cm_source_destroy>
{
public:
    explicit source(cm_source *handle) noexcept : owner(handle) {}
    // cm_source_create
    static result<source> try_make(plan_view plan, const cm_image *from, cm_pixel_type target_type, unsigned
        threads);
    source(plan_view plan, const cm_image *from, cm_pixel_type target_type, unsigned threads);
};

/* An object cm_store that somebody else owns. */
class store_view
{
public:
    explicit store_view(cm_store *handle) noexcept : handle_(handle) {}
    cm_store *get() const noexcept { return handle_; }
    // cm_store_get
    cm_status try_get(const cm_store_key &key, uint32_t kind, uint32_t newest, cm_blob *blob) const;
    void get(const cm_store_key &key, uint32_t kind, uint32_t newest, cm_blob *blob) const;
    // cm_store_put
    cm_status try_put(const cm_store_key &key, const cm_blob &blob) const;
    void put(const cm_store_key &key, const cm_blob &blob) const;
    // cm_store_remove
    cm_status try_remove(const cm_store_key &key) const;
    void remove(const cm_store_key &key) const;
    // cm_store_next
    cm_status try_next(const cm_store_key *after, unsigned char (&key)[255], size_t *count) const;
    void next(const cm_store_key *after, unsigned char (&key)[255], size_t *count) const;
    // cm_store_commit
    cm_status try_commit() const;
    void commit() const;
    // cm_store_rollback
    cm_status try_rollback() const;
    void rollback() const;
    // cm_store_message
    const char * message() const;

private:
    cm_store *handle_;
};

/* One of one's own: it can be moved, not copied. */
class store : public detail::owner<store_view, cm_store, cm_store_destroy>
{
public:
    explicit store(cm_store *handle) noexcept : owner(handle) {}
    // cm_store_create
    static result<store> try_make(const cm_store_methods &methods, void *context);
    store(const cm_store_methods &methods, void *context);
    // cm_store_create_in_memory
    static result<store> try_in_memory();
    static store in_memory();
};

/* An object cm_surface that somebody else owns. */
class surface_view
{
public:
    explicit surface_view(const cm_surface *handle) noexcept : handle_(handle) {}
    const cm_surface *get() const noexcept { return handle_; }
    // cm_surface_specification
    const char * specification() const;
    // cm_surface_picture_count
    size_t picture_count() const;
    // cm_surface_width
    uint32_t width() const;
    // cm_surface_height
    uint32_t height() const;
    // cm_surface_plane_count
    size_t plane_count() const;
    // cm_surface_plane_width
    uint32_t plane_width() const;
    // cm_surface_plane_height
    uint32_t plane_height() const;
    // cm_surface_pixel
    cm_status try_pixel(uint32_t plane, uint32_t column, uint32_t row, uint32_t *picture, uint32_t
        *picture_column, uint32_t *picture_row) const;
    void pixel(uint32_t plane, uint32_t column, uint32_t row, uint32_t *picture, uint32_t *picture_column,
        uint32_t *picture_row) const;
    // cm_surface_mapping
    mapping_view mapping() const;
    // cm_surface_positions
    void positions(span<const double> x, span<const double> y, span<const double> z, span<uint8_t> plane,
        span<double> column, span<double> row) const;
    // cm_surface_directions
    void directions(span<const uint8_t> plane, span<const double> column, span<const double> row, span<double>
        x, span<double> y, span<double> z) const;
    // cm_sample
    cm_status try_sample(const cm_image *pictures, cm_filter filter, span<const double> x, span<const double>
        y, span<const double> z, span<float> out) const;
    void sample(const cm_image *pictures, cm_filter filter, span<const double> x, span<const double> y,
        span<const double> z, span<float> out) const;
    // cm_border
    cm_status try_border(const cm_image *pictures, uint32_t border, const cm_plan_options *options, unsigned
        threads, cm_image *to) const;
    void border(const cm_image *pictures, uint32_t border, const cm_plan_options *options, unsigned threads,
        cm_image *to) const;
    // cm_panorama_of_surface
    cm_status try_panorama_of_surface(cm_panorama *panorama) const;
    void panorama_of_surface(cm_panorama *panorama) const;

private:
    const cm_surface *handle_;
};

/* One of one's own: it can be moved, not copied. */
class surface : public detail::owner<surface_view, cm_surface, cm_surface_destroy>
{
public:
    explicit surface(cm_surface *handle) noexcept : owner(handle) {}
    // cm_surface_create
    static result<surface> try_make(const char *specification, const cm_surface_options *options = nullptr);
    explicit surface(const char *specification, const cm_surface_options *options = nullptr);
};

/* An object cm_tof_scene that somebody else owns. */
class tof_scene_view
{
public:
    explicit tof_scene_view(const cm_tof_scene *handle) noexcept : handle_(handle) {}
    const cm_tof_scene *get() const noexcept { return handle_; }
    // cm_tof_scene_count
    size_t count() const;
    // cm_tof_simulate
    cm_status try_simulate(const cm_tof_sensor &sensor, span<const cm_tof_light> light, trajectory_view
        trajectory, double time, const cm_tof_options *options, pool_view pool, cm_tof_result *result) const;
    void simulate(const cm_tof_sensor &sensor, span<const cm_tof_light> light, trajectory_view trajectory,
        double time, const cm_tof_options *options, pool_view pool, cm_tof_result *result) const;
    // cm_tof_plan
    cm_status try_plan(const cm_tof_sensor &sensor, span<const cm_tof_light> light, trajectory_view
        trajectory, double time, double limit, const cm_tof_options *most, pool_view pool, cm_tof_options
        *chosen, cm_budget *budget) const;
    void plan(const cm_tof_sensor &sensor, span<const cm_tof_light> light, trajectory_view trajectory, double
        time, double limit, const cm_tof_options *most, pool_view pool, cm_tof_options *chosen, cm_budget
        *budget) const;
    // cm_tof_find_truth
    cm_status try_find_truth(camera_view camera, trajectory_view trajectory, double time, double next, double
        before, pool_view pool, cm_tof_truth *truth) const;
    void find_truth(camera_view camera, trajectory_view trajectory, double time, double next, double before,
        pool_view pool, cm_tof_truth *truth) const;

private:
    const cm_tof_scene *handle_;
};

/* One of one's own: it can be moved, not copied. */
class tof_scene : public detail::owner<tof_scene_view, cm_tof_scene, cm_tof_scene_destroy>
{
public:
    explicit tof_scene(cm_tof_scene *handle) noexcept : owner(handle) {}
    // cm_tof_scene_create
    static result<tof_scene> try_make(scene_view scene);
    explicit tof_scene(scene_view scene);
};

/* An object cm_trajectory that somebody else owns. */
class trajectory_view
{
public:
    explicit trajectory_view(const cm_trajectory *handle) noexcept : handle_(handle) {}
    const cm_trajectory *get() const noexcept { return handle_; }
    // cm_trajectory_count
    size_t count() const;
    // cm_trajectory_at
    cm_status try_at(size_t index, double *stamp, cm_pose *pose) const;
    void at(size_t index, double *stamp, cm_pose *pose) const;
    // cm_trajectory_nearest
    cm_status try_nearest(double time, double apart, size_t *index) const;
    void nearest(double time, double apart, size_t *index) const;
    // cm_trajectory_interpolate
    cm_status try_interpolate(double time, cm_pose *pose) const;
    void interpolate(double time, cm_pose *pose) const;
    // cm_trajectory_associate
    cm_status try_associate(trajectory_view b, double apart, span<size_t> index_a, span<size_t> index_b,
        size_t *count) const;
    void associate(trajectory_view b, double apart, span<size_t> index_a, span<size_t> index_b, size_t *count)
        const;
    // cm_trajectory_evaluate
    cm_status try_evaluate(trajectory_view estimate, const cm_evaluation_options *options, cm_evaluation
        *evaluation) const;
    void evaluate(trajectory_view estimate, const cm_evaluation_options *options, cm_evaluation *evaluation)
        const;

private:
    const cm_trajectory *handle_;
};

/* One of one's own: it can be moved, not copied. */
class trajectory : public detail::owner<trajectory_view, cm_trajectory, cm_trajectory_destroy>
{
public:
    explicit trajectory(cm_trajectory *handle) noexcept : owner(handle) {}
    // cm_trajectory_create
    static result<trajectory> try_make(span<const double> stamp, span<const cm_pose> pose, size_t *wrong);
    trajectory(span<const double> stamp, span<const cm_pose> pose, size_t *wrong);
};

inline size_t advice_view::count() const { return cm_advice_count(get()); }
inline size_t advice_view::qualified() const { return cm_advice_qualified(get()); }
inline const cm_advice_candidate * advice_view::at(size_t index) const { return cm_advice_at(get(), index); }
inline void advice_view::reason(size_t index, char *text, size_t size) const { cm_advice_reason(get(), index,
    text, size); }
inline result<advice> advice::try_make(const cm_advice_request &request, const cm_advice_costs &costs) {
    cm_advice *made_object = nullptr; const cm_status status = cm_advise(&request, &costs, &made_object);
    return status == CM_OK ? result<advice>(advice(made_object)) : result<advice>(status); }
inline advice::advice(const cm_advice_request &request, const cm_advice_costs &costs) :
    advice(try_make(request, costs).value()) {}
inline double brdf_view::value(const double (&normal)[3], const double (&in)[3], const double (&out)[3]) const
    { return cm_brdf_value(get(), normal, in, out); }
inline double brdf_view::albedo(double theta_in) const { return cm_brdf_albedo(get(), theta_in); }
inline double brdf_view::sample_direction(const double (&normal)[3], const double (&out)[3], const double
    (&u)[3], double (&in)[3], double *density) const { return cm_brdf_sample_direction(get(), normal, out, u,
    in, density); }
inline double brdf_view::density(const double (&normal)[3], const double (&in)[3], const double (&out)[3])
    const { return cm_brdf_density(get(), normal, in, out); }
inline result<brdf> brdf::try_lambert() { cm_brdf *made_object = nullptr; const cm_status status =
    cm_brdf_create_lambert(&made_object); return status == CM_OK ? result<brdf>(brdf(made_object)) :
    result<brdf>(status); }
inline brdf brdf::lambert() { return try_lambert().value(); }
inline result<brdf> brdf::try_cook_torrance(const cm_cook_torrance &options) { cm_brdf *made_object = nullptr;
    const cm_status status = cm_brdf_create_cook_torrance(&options, &made_object); return status == CM_OK ?
    result<brdf>(brdf(made_object)) : result<brdf>(status); }
inline brdf brdf::cook_torrance(const cm_cook_torrance &options) { return try_cook_torrance(options).value();
    }
inline result<brdf> brdf::try_measured(span<const cm_brdf_sample> sample) { cm_brdf *made_object = nullptr;
    const cm_status status = cm_brdf_create_measured(sample.size(), sample.data(), &made_object); return
    status == CM_OK ? result<brdf>(brdf(made_object)) : result<brdf>(status); }
inline brdf brdf::measured(span<const cm_brdf_sample> sample) { return try_measured(sample).value(); }
inline const cm_camera_options * camera_view::describe() const { return cm_camera_describe(get()); }
inline void camera_view::project(span<const double> x, span<const double> y, span<const double> z,
    span<double> column, span<double> row) const { detail::check(detail::holds(y.size(), x.size()) &&
    detail::holds(z.size(), x.size()) && detail::holds(column.size(), x.size()) && detail::holds(row.size(),
    x.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_camera_project_array(get(), x.size(), x.data(), y.data(),
    z.data(), column.data(), row.data()); }
inline void camera_view::ray(span<const double> column, span<const double> row, span<double> x, span<double>
    y, span<double> z) const { detail::check(detail::holds(row.size(), column.size()) &&
    detail::holds(x.size(), column.size()) && detail::holds(y.size(), column.size()) &&
    detail::holds(z.size(), column.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_camera_ray_array(get(),
    column.size(), column.data(), row.data(), x.data(), y.data(), z.data()); }
inline void camera_view::jacobian(const double (&point)[3], double (&jacobian)[6]) const {
    cm_camera_jacobian(get(), point, jacobian); }
inline double camera_view::solid_angle(double column, double row) const { return cm_camera_solid_angle(get(),
    column, row); }
inline int camera_view::has_ray(double column, double row) const { return cm_camera_has_ray(get(), column,
    row); }
inline double camera_view::border(double angle) const { return cm_camera_border(get(), angle); }
inline cm_status camera_view::try_lens_frustum(double (&frustum)[4]) const { return cm_lens_frustum(get(),
    frustum); }
inline void camera_view::lens_frustum(double (&frustum)[4]) const { detail::check(cm_lens_frustum(get(),
    frustum)); }
inline cm_status camera_view::try_lens_guard(double delta, double *guard) const { return cm_lens_guard(get(),
    delta, guard); }
inline void camera_view::lens_guard(double delta, double *guard) const { detail::check(cm_lens_guard(get(),
    delta, guard)); }
inline cm_status camera_view::try_lens_move_vertices(double guard, span<const double> x, span<const double> y,
    span<const double> z, span<double> to_x, span<double> to_y, span<double> to_z) const { return
    detail::holds(y.size(), x.size()) && detail::holds(z.size(), x.size()) && detail::holds(to_x.size(),
    x.size()) && detail::holds(to_y.size(), x.size()) && detail::holds(to_z.size(), x.size()) ?
    cm_lens_move_vertices(get(), guard, x.size(), x.data(), y.data(), z.data(), to_x.data(), to_y.data(),
    to_z.data()) : CM_ERROR_ARGUMENT; }
inline void camera_view::lens_move_vertices(double guard, span<const double> x, span<const double> y,
    span<const double> z, span<double> to_x, span<double> to_y, span<double> to_z) const {
    detail::check(detail::holds(y.size(), x.size()) && detail::holds(z.size(), x.size()) &&
    detail::holds(to_x.size(), x.size()) && detail::holds(to_y.size(), x.size()) && detail::holds(to_z.size(),
    x.size()) ? cm_lens_move_vertices(get(), guard, x.size(), x.data(), y.data(), z.data(), to_x.data(),
    to_y.data(), to_z.data()) : CM_ERROR_ARGUMENT); }
inline cm_status camera_view::try_lens_pinhole(double scale, cm_camera_options *pinhole) const { return
    cm_lens_pinhole(get(), scale, pinhole); }
inline void camera_view::lens_pinhole(double scale, cm_camera_options *pinhole) const {
    detail::check(cm_lens_pinhole(get(), scale, pinhole)); }
inline result<camera> camera::try_make(const cm_camera_options *options) { cm_camera *made_object = nullptr;
    const cm_status status = cm_camera_create(options, &made_object); return status == CM_OK ?
    result<camera>(camera(made_object)) : result<camera>(status); }
inline camera::camera(const cm_camera_options *options) : camera(try_make(options).value()) {}
inline grid_view cell_grid_view::grid() const { return grid_view(cm_cell_grid_of(get())); }
inline cm_curve cell_grid_view::curve() const { return cm_cell_grid_curve(get()); }
inline int cell_grid_view::is_s2() const { return cm_cell_grid_is_s2(get()); }
inline cm_cell cell_grid_view::forward(int level, const double (&normal)[3]) const { return
    cm_cell_forward(get(), level, normal); }
inline cm_cell cell_grid_view::forward_lonlat(int level, double lon, double lat) const { return
    cm_cell_forward_lonlat(get(), level, lon, lat); }
inline void cell_grid_view::forward(int level, span<const double> x, span<const double> y, span<const double>
    z, span<cm_cell> cell) const { detail::check(detail::holds(y.size(), x.size()) && detail::holds(z.size(),
    x.size()) && detail::holds(cell.size(), x.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_cell_forward_array(get(), level, x.size(), x.data(), y.data(), z.data(), cell.data()); }
inline void cell_grid_view::forward_lonlat(int level, span<const double> lon, span<const double> lat,
    span<cm_cell> cell) const { detail::check(detail::holds(lat.size(), lon.size()) &&
    detail::holds(cell.size(), lon.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_cell_forward_lonlat_array(get(),
    level, lon.size(), lon.data(), lat.data(), cell.data()); }
inline void cell_grid_view::centre(cm_cell cell, double (&normal)[3]) const { cm_cell_centre(get(), cell,
    normal); }
inline void cell_grid_view::centre_lonlat(cm_cell cell, double (&lonlat)[2]) const {
    cm_cell_centre_lonlat(get(), cell, lonlat); }
inline void cell_grid_view::centre(span<const cm_cell> cell, span<double> x, span<double> y, span<double> z)
    const { detail::check(detail::holds(x.size(), cell.size()) && detail::holds(y.size(), cell.size()) &&
    detail::holds(z.size(), cell.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_cell_centre_array(get(),
    cell.size(), cell.data(), x.data(), y.data(), z.data()); }
inline void cell_grid_view::centre_lonlat(span<const cm_cell> cell, span<double> lon, span<double> lat) const
    { detail::check(detail::holds(lon.size(), cell.size()) && detail::holds(lat.size(), cell.size()) ? CM_OK :
    CM_ERROR_ARGUMENT); cm_cell_centre_lonlat_array(get(), cell.size(), cell.data(), lon.data(), lat.data());
    }
inline void cell_grid_view::corners(cm_cell cell, double (&normal)[4][3]) const { cm_cell_corners(get(), cell,
    normal); }
inline void cell_grid_view::corners_lonlat(cm_cell cell, double (&lonlat)[4][2]) const {
    cm_cell_corners_lonlat(get(), cell, lonlat); }
inline void cell_grid_view::bounding_cap(cm_cell cell, double (&normal)[3], double *radius) const {
    cm_cell_bounding_cap(get(), cell, normal, radius); }
inline double cell_grid_view::area(cm_cell cell) const { return cm_cell_area(get(), cell); }
inline int cell_grid_view::edge_neighbours(cm_cell cell, cm_cell (&to)[4]) const { return
    cm_cell_edge_neighbours(get(), cell, to); }
inline int cell_grid_view::neighbours(cm_cell cell, cm_cell (&to)[8]) const { return cm_cell_neighbours(get(),
    cell, to); }
inline cm_status cell_grid_view::try_neighbours_at(cm_cell cell, int level, span<cm_cell> to, size_t *count)
    const { return cm_cell_neighbours_at(get(), cell, level, to.size(), to.data(), count); }
inline void cell_grid_view::neighbours_at(cm_cell cell, int level, span<cm_cell> to, size_t *count) const {
    detail::check(cm_cell_neighbours_at(get(), cell, level, to.size(), to.data(), count)); }
inline cm_status cell_grid_view::try_cover(region_view region, const cm_cover_options *options, span<cm_cell>
    to, size_t *count) const { return cm_cover(get(), region.get(), options, to.size(), to.data(), count); }
inline void cell_grid_view::cover(region_view region, const cm_cover_options *options, span<cm_cell> to,
    size_t *count) const { detail::check(cm_cover(get(), region.get(), options, to.size(), to.data(), count));
    }
inline result<cell_grid> cell_grid::try_make(grid_view grid, cm_curve curve) { cm_cell_grid *made_object =
    nullptr; const cm_status status = cm_cell_grid_create(grid.get(), curve, &made_object); return status ==
    CM_OK ? result<cell_grid>(cell_grid(made_object)) : result<cell_grid>(status); }
inline cell_grid::cell_grid(grid_view grid, cm_curve curve) : cell_grid(try_make(grid, curve).value()) {}
inline result<cell_grid> cell_grid::try_s2(grid_view grid) { cm_cell_grid *made_object = nullptr; const
    cm_status status = cm_cell_grid_create_s2(grid.get(), &made_object); return status == CM_OK ?
    result<cell_grid>(cell_grid(made_object)) : result<cell_grid>(status); }
inline cell_grid cell_grid::s2(grid_view grid) { return try_s2(grid).value(); }
inline const cm_colormap_info * colormap_view::describe() const { return cm_colormap_describe(get()); }
inline double colormap_view::parameter(size_t index) const { return cm_colormap_parameter(get(), index); }
inline size_t colormap_view::stop_count() const { return cm_colormap_stop_count(get()); }
inline void colormap_view::stop(size_t index, double (&place_hue)[2]) const { cm_colormap_stop(get(), index,
    place_hue); }
inline size_t colormap_view::specification(char *text, size_t size) const { return
    cm_colormap_specification(get(), text, size); }
inline void colormap_view::color_at(double t, cm_colormap_color *color) const { cm_colormap_color_at(get(), t,
    color); }
inline double colormap_view::position(size_t n, size_t index) const { return cm_colormap_position(get(), n,
    index); }
inline void colormap_view::samples(size_t n, span<double> srgb, cm_colormap_clipping *clipping) const {
    detail::check(detail::holds(srgb.size(), detail::whole(n), 3) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_colormap_samples(get(), n, srgb.data(), clipping); }
inline void colormap_view::samples_u8(size_t n, span<uint8_t> srgb, cm_colormap_clipping *clipping) const {
    detail::check(detail::holds(srgb.size(), detail::whole(n), 3) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_colormap_samples_u8(get(), n, srgb.data(), clipping); }
inline double colormap_view::length() const { return cm_colormap_length(get()); }
inline size_t colormap_view::corner_count() const { return cm_colormap_corner_count(get()); }
inline double colormap_view::corner(size_t index) const { return cm_colormap_corner(get(), index); }
inline int colormap_view::inside() const { return cm_colormap_inside(get()); }
inline double colormap_view::largest_saturation() const { return cm_colormap_largest_saturation(get()); }
inline result<colormap> colormap::try_make(const char *specification) { cm_colormap *made_object = nullptr;
    const cm_status status = cm_colormap_create(specification, &made_object); return status == CM_OK ?
    result<colormap>(colormap(made_object)) : result<colormap>(status); }
inline colormap::colormap(const char *specification) : colormap(try_make(specification).value([&](char *words,
    std::size_t size) { cm_colormap_check(specification, words, size); })) {}
inline result<colormap> colormap::try_fit() const { cm_colormap *made_object = nullptr; const cm_status status
    = cm_colormap_fit(get(), &made_object); return status == CM_OK ? result<colormap>(colormap(made_object)) :
    result<colormap>(status); }
inline colormap colormap::fit() const { return try_fit().value(); }
inline cm_status depth_pyramid_view::try_use_pool(pool_view pool) const { return
    cm_depth_pyramid_use_pool(get(), pool.get()); }
inline void depth_pyramid_view::use_pool(pool_view pool) const {
    detail::check(cm_depth_pyramid_use_pool(get(), pool.get())); }
inline size_t depth_pyramid_view::pixel_count() const { return cm_depth_pyramid_pixel_count(get()); }
inline cm_status depth_pyramid_view::try_fill(span<const float> image, unsigned threads) const { return
    detail::holds(image.size(), cm_depth_pyramid_pixel_count(get())) ? cm_depth_pyramid_fill(get(),
    image.data(), threads) : CM_ERROR_ARGUMENT; }
inline void depth_pyramid_view::fill(span<const float> image, unsigned threads) const {
    detail::check(detail::holds(image.size(), cm_depth_pyramid_pixel_count(get())) ?
    cm_depth_pyramid_fill(get(), image.data(), threads) : CM_ERROR_ARGUMENT); }
inline uint32_t depth_pyramid_view::last() const { return cm_depth_pyramid_last(get()); }
inline cm_status depth_pyramid_view::try_level(uint32_t level, cm_depth_level *cells) const { return
    cm_depth_pyramid_level(get(), level, cells); }
inline void depth_pyramid_view::level(uint32_t level, cm_depth_level *cells) const {
    detail::check(cm_depth_pyramid_level(get(), level, cells)); }
inline cm_status depth_pyramid_view::try_bounds(uint32_t column, uint32_t row, uint32_t last_column, uint32_t
    last_row, cm_depth_bounds *bounds) const { return cm_depth_pyramid_bounds(get(), column, row, last_column,
    last_row, bounds); }
inline void depth_pyramid_view::bounds(uint32_t column, uint32_t row, uint32_t last_column, uint32_t last_row,
    cm_depth_bounds *bounds) const { detail::check(cm_depth_pyramid_bounds(get(), column, row, last_column,
    last_row, bounds)); }
inline result<depth_pyramid> depth_pyramid::try_make(uint32_t width, uint32_t height, const char
    *instructions) { cm_depth_pyramid *made_object = nullptr; const cm_status status =
    cm_depth_pyramid_create(width, height, instructions, &made_object); return status == CM_OK ?
    result<depth_pyramid>(depth_pyramid(made_object)) : result<depth_pyramid>(status); }
inline depth_pyramid::depth_pyramid(uint32_t width, uint32_t height, const char *instructions) :
    depth_pyramid(try_make(width, height, instructions).value()) {}
inline uint32_t environment_view::size() const { return cm_environment_size(get()); }
inline uint32_t environment_view::channels() const { return cm_environment_channels(get()); }
inline uint32_t environment_view::level_count() const { return cm_environment_level_count(get()); }
inline cm_status environment_view::try_project(uint32_t degree, unsigned threads, span<double> coefficients)
    const { return detail::holds(coefficients.size(), detail::whole(degree) + 1, detail::whole(degree) + 1,
    cm_environment_channels(get())) ? cm_environment_project(get(), degree, threads, coefficients.data()) :
    CM_ERROR_ARGUMENT; }
inline void environment_view::project(uint32_t degree, unsigned threads, span<double> coefficients) const {
    detail::check(detail::holds(coefficients.size(), detail::whole(degree) + 1, detail::whole(degree) + 1,
    cm_environment_channels(get())) ? cm_environment_project(get(), degree, threads, coefficients.data()) :
    CM_ERROR_ARGUMENT); }
inline cm_status environment_view::try_irradiance(mapping_view mapping, unsigned threads, const cm_image
    (&to)[6]) const { return cm_environment_irradiance(get(), mapping.get(), threads, to); }
inline void environment_view::irradiance(mapping_view mapping, unsigned threads, const cm_image (&to)[6])
    const { detail::check(cm_environment_irradiance(get(), mapping.get(), threads, to)); }
inline cm_status environment_view::try_prefilter(double roughness, const cm_prefilter_options *options,
    mapping_view mapping, const cm_image (&to)[6]) const { return cm_environment_prefilter(get(), roughness,
    options, mapping.get(), to); }
inline void environment_view::prefilter(double roughness, const cm_prefilter_options *options, mapping_view
    mapping, const cm_image (&to)[6]) const { detail::check(cm_environment_prefilter(get(), roughness,
    options, mapping.get(), to)); }
inline result<environment> environment::try_make(mapping_view mapping, const cm_image (&faces)[6], unsigned
    threads) { cm_environment *made_object = nullptr; const cm_status status =
    cm_environment_create(mapping.get(), faces, threads, &made_object); return status == CM_OK ?
    result<environment>(environment(made_object)) : result<environment>(status); }
inline environment::environment(mapping_view mapping, const cm_image (&faces)[6], unsigned threads) :
    environment(try_make(mapping, faces, threads).value()) {}
inline cm_status errors_view::try_add(const cm_image &reference, const cm_image &picture, const cm_image
    &weights) const { return cm_errors_add(get(), &reference, &picture, &weights); }
inline void errors_view::add(const cm_image &reference, const cm_image &picture, const cm_image &weights)
    const { detail::check(cm_errors_add(get(), &reference, &picture, &weights)); }
inline cm_status errors_view::try_get(uint32_t channel, cm_error_figures *figures) const { return
    cm_errors_get(get(), channel, figures); }
inline void errors_view::get(uint32_t channel, cm_error_figures *figures) const {
    detail::check(cm_errors_get(get(), channel, figures)); }
inline result<errors> errors::try_make(uint32_t channels, const cm_compare_options *options) { cm_errors
    *made_object = nullptr; const cm_status status = cm_errors_create(channels, options, &made_object); return
    status == CM_OK ? result<errors>(errors(made_object)) : result<errors>(status); }
inline errors::errors(uint32_t channels, const cm_compare_options *options) : errors(try_make(channels,
    options).value()) {}
inline mapping_view grid_view::mapping() const { return mapping_view(cm_grid_mapping(get())); }
inline const cm_ellipsoid * grid_view::ellipsoid() const { return cm_grid_ellipsoid(get()); }
inline cm_latitude grid_view::latitude() const { return cm_grid_latitude(get()); }
inline const cm_rotation * grid_view::rotation() const { return cm_grid_rotation(get()); }
inline uint8_t grid_view::forward_lonlat(double lon, double lat, double (&uv)[2]) const { return
    cm_grid_forward_lonlat(get(), lon, lat, uv); }
inline void grid_view::inverse_lonlat(uint8_t face, const double (&uv)[2], double (&lonlat)[2]) const {
    cm_grid_inverse_lonlat(get(), face, uv, lonlat); }
inline uint8_t grid_view::forward(const double (&normal)[3], double (&uv)[2]) const { return
    cm_grid_forward(get(), normal, uv); }
inline void grid_view::inverse(uint8_t face, const double (&uv)[2], double (&normal)[3]) const {
    cm_grid_inverse(get(), face, uv, normal); }
inline void grid_view::forward_lonlat(span<const double> lon, span<const double> lat, span<uint8_t> face,
    span<double> u, span<double> v) const { detail::check(detail::holds(lat.size(), lon.size()) &&
    detail::holds(face.size(), lon.size()) && detail::holds(u.size(), lon.size()) && detail::holds(v.size(),
    lon.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_grid_forward_lonlat_array(get(), lon.size(), lon.data(),
    lat.data(), face.data(), u.data(), v.data()); }
inline void grid_view::inverse_lonlat(span<const uint8_t> face, span<const double> u, span<const double> v,
    span<double> lon, span<double> lat) const { detail::check(detail::holds(u.size(), face.size()) &&
    detail::holds(v.size(), face.size()) && detail::holds(lon.size(), face.size()) &&
    detail::holds(lat.size(), face.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_grid_inverse_lonlat_array(get(),
    face.size(), face.data(), u.data(), v.data(), lon.data(), lat.data()); }
inline void grid_view::forward(span<const double> x, span<const double> y, span<const double> z, span<uint8_t>
    face, span<double> u, span<double> v) const { detail::check(detail::holds(y.size(), x.size()) &&
    detail::holds(z.size(), x.size()) && detail::holds(face.size(), x.size()) && detail::holds(u.size(),
    x.size()) && detail::holds(v.size(), x.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_grid_forward_array(get(),
    x.size(), x.data(), y.data(), z.data(), face.data(), u.data(), v.data()); }
inline void grid_view::inverse(span<const uint8_t> face, span<const double> u, span<const double> v,
    span<double> x, span<double> y, span<double> z) const { detail::check(detail::holds(u.size(), face.size())
    && detail::holds(v.size(), face.size()) && detail::holds(x.size(), face.size()) && detail::holds(y.size(),
    face.size()) && detail::holds(z.size(), face.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_grid_inverse_array(get(), face.size(), face.data(), u.data(), v.data(), x.data(), y.data(), z.data());
    }
inline void grid_view::to_sphere(const double (&normal)[3], double (&direction)[3]) const {
    cm_grid_to_sphere(get(), normal, direction); }
inline void grid_view::from_sphere(const double (&direction)[3], double (&normal)[3]) const {
    cm_grid_from_sphere(get(), direction, normal); }
inline void grid_view::to_sphere(span<const double> x, span<const double> y, span<const double> z,
    span<double> to_x, span<double> to_y, span<double> to_z) const { detail::check(detail::holds(y.size(),
    x.size()) && detail::holds(z.size(), x.size()) && detail::holds(to_x.size(), x.size()) &&
    detail::holds(to_y.size(), x.size()) && detail::holds(to_z.size(), x.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_grid_to_sphere_array(get(), x.size(), x.data(), y.data(), z.data(), to_x.data(), to_y.data(),
    to_z.data()); }
inline void grid_view::from_sphere(span<const double> x, span<const double> y, span<const double> z,
    span<double> to_x, span<double> to_y, span<double> to_z) const { detail::check(detail::holds(y.size(),
    x.size()) && detail::holds(z.size(), x.size()) && detail::holds(to_x.size(), x.size()) &&
    detail::holds(to_y.size(), x.size()) && detail::holds(to_z.size(), x.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_grid_from_sphere_array(get(), x.size(), x.data(), y.data(), z.data(), to_x.data(), to_y.data(),
    to_z.data()); }
inline double grid_view::area_element(uint8_t face, const double (&uv)[2]) const { return
    cm_grid_area_element(get(), face, uv); }
inline void grid_view::area_element(span<const uint8_t> face, span<const double> u, span<const double> v,
    span<double> area) const { detail::check(detail::holds(u.size(), face.size()) && detail::holds(v.size(),
    face.size()) && detail::holds(area.size(), face.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_grid_area_element_array(get(), face.size(), face.data(), u.data(), v.data(), area.data()); }
inline void grid_view::forward_distortion(const double (&normal)[3], cm_distortion *distortion) const {
    cm_grid_forward_distortion(get(), normal, distortion); }
inline void grid_view::inverse_distortion(uint8_t face, const double (&uv)[2], cm_distortion *distortion)
    const { cm_grid_inverse_distortion(get(), face, uv, distortion); }
inline result<grid> grid::try_make(const cm_grid_options *options) { cm_grid *made_object = nullptr; const
    cm_status status = cm_grid_create(options, &made_object); return status == CM_OK ?
    result<grid>(grid(made_object)) : result<grid>(status); }
inline grid::grid(const cm_grid_options *options) : grid(try_make(options).value()) {}
inline int64_t healpix_view::nside() const { return cm_healpix_nside(get()); }
inline cm_healpix_order healpix_view::order() const { return cm_healpix_order_of(get()); }
inline const char * healpix_view::instructions() const { return cm_healpix_instructions(get()); }
inline int64_t healpix_view::pixel_count() const { return cm_healpix_pixel_count(get()); }
inline int64_t healpix_view::ring_count() const { return cm_healpix_ring_count(get()); }
inline cm_status healpix_view::try_pixel_from_direction(const double (&direction)[3], int64_t *pixel) const {
    return cm_healpix_pixel_from_direction(get(), direction, pixel); }
inline void healpix_view::pixel_from_direction(const double (&direction)[3], int64_t *pixel) const {
    detail::check(cm_healpix_pixel_from_direction(get(), direction, pixel)); }
inline cm_status healpix_view::try_pixel_from_angles(double theta, double phi, int64_t *pixel) const { return
    cm_healpix_pixel_from_angles(get(), theta, phi, pixel); }
inline void healpix_view::pixel_from_angles(double theta, double phi, int64_t *pixel) const {
    detail::check(cm_healpix_pixel_from_angles(get(), theta, phi, pixel)); }
inline cm_status healpix_view::try_pixel_from_lonlat(double lon, double lat, int64_t *pixel) const { return
    cm_healpix_pixel_from_lonlat(get(), lon, lat, pixel); }
inline void healpix_view::pixel_from_lonlat(double lon, double lat, int64_t *pixel) const {
    detail::check(cm_healpix_pixel_from_lonlat(get(), lon, lat, pixel)); }
inline cm_status healpix_view::try_direction_from_pixel(int64_t pixel, double (&direction)[3]) const { return
    cm_healpix_direction_from_pixel(get(), pixel, direction); }
inline void healpix_view::direction_from_pixel(int64_t pixel, double (&direction)[3]) const {
    detail::check(cm_healpix_direction_from_pixel(get(), pixel, direction)); }
inline cm_status healpix_view::try_angles_from_pixel(int64_t pixel, double *theta, double *phi) const { return
    cm_healpix_angles_from_pixel(get(), pixel, theta, phi); }
inline void healpix_view::angles_from_pixel(int64_t pixel, double *theta, double *phi) const {
    detail::check(cm_healpix_angles_from_pixel(get(), pixel, theta, phi)); }
inline cm_status healpix_view::try_lonlat_from_pixel(int64_t pixel, double (&lonlat)[2]) const { return
    cm_healpix_lonlat_from_pixel(get(), pixel, lonlat); }
inline void healpix_view::lonlat_from_pixel(int64_t pixel, double (&lonlat)[2]) const {
    detail::check(cm_healpix_lonlat_from_pixel(get(), pixel, lonlat)); }
inline cm_status healpix_view::try_nested_from_ring(int64_t ring, int64_t *nested) const { return
    cm_healpix_nested_from_ring(get(), ring, nested); }
inline void healpix_view::nested_from_ring(int64_t ring, int64_t *nested) const {
    detail::check(cm_healpix_nested_from_ring(get(), ring, nested)); }
inline cm_status healpix_view::try_ring_from_nested(int64_t nested, int64_t *ring) const { return
    cm_healpix_ring_from_nested(get(), nested, ring); }
inline void healpix_view::ring_from_nested(int64_t nested, int64_t *ring) const {
    detail::check(cm_healpix_ring_from_nested(get(), nested, ring)); }
inline void healpix_view::pixel_from_direction(span<const double> x, span<const double> y, span<const double>
    z, span<int64_t> pixel) const { detail::check(detail::holds(y.size(), x.size()) && detail::holds(z.size(),
    x.size()) && detail::holds(pixel.size(), x.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_healpix_pixel_from_direction_array(get(), x.size(), x.data(), y.data(), z.data(), pixel.data()); }
inline void healpix_view::pixel_from_angles(span<const double> theta, span<const double> phi, span<int64_t>
    pixel) const { detail::check(detail::holds(phi.size(), theta.size()) && detail::holds(pixel.size(),
    theta.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_healpix_pixel_from_angles_array(get(), theta.size(),
    theta.data(), phi.data(), pixel.data()); }
inline void healpix_view::pixel_from_lonlat(span<const double> lon, span<const double> lat, span<int64_t>
    pixel) const { detail::check(detail::holds(lat.size(), lon.size()) && detail::holds(pixel.size(),
    lon.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_healpix_pixel_from_lonlat_array(get(), lon.size(),
    lon.data(), lat.data(), pixel.data()); }
inline void healpix_view::direction_from_pixel(span<const int64_t> pixel, span<double> x, span<double> y,
    span<double> z) const { detail::check(detail::holds(x.size(), pixel.size()) && detail::holds(y.size(),
    pixel.size()) && detail::holds(z.size(), pixel.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_healpix_direction_from_pixel_array(get(), pixel.size(), pixel.data(), x.data(), y.data(), z.data()); }
inline void healpix_view::angles_from_pixel(span<const int64_t> pixel, span<double> theta, span<double> phi)
    const { detail::check(detail::holds(theta.size(), pixel.size()) && detail::holds(phi.size(), pixel.size())
    ? CM_OK : CM_ERROR_ARGUMENT); cm_healpix_angles_from_pixel_array(get(), pixel.size(), pixel.data(),
    theta.data(), phi.data()); }
inline void healpix_view::lonlat_from_pixel(span<const int64_t> pixel, span<double> lon, span<double> lat)
    const { detail::check(detail::holds(lon.size(), pixel.size()) && detail::holds(lat.size(), pixel.size()) ?
    CM_OK : CM_ERROR_ARGUMENT); cm_healpix_lonlat_from_pixel_array(get(), pixel.size(), pixel.data(),
    lon.data(), lat.data()); }
inline cm_status healpix_view::try_nested_from_ring(span<const int64_t> ring, span<int64_t> nested) const {
    return detail::holds(nested.size(), ring.size()) ? cm_healpix_nested_from_ring_array(get(), ring.size(),
    ring.data(), nested.data()) : CM_ERROR_ARGUMENT; }
inline void healpix_view::nested_from_ring(span<const int64_t> ring, span<int64_t> nested) const {
    detail::check(detail::holds(nested.size(), ring.size()) ? cm_healpix_nested_from_ring_array(get(),
    ring.size(), ring.data(), nested.data()) : CM_ERROR_ARGUMENT); }
inline cm_status healpix_view::try_ring_from_nested(span<const int64_t> nested, span<int64_t> ring) const {
    return detail::holds(ring.size(), nested.size()) ? cm_healpix_ring_from_nested_array(get(), nested.size(),
    nested.data(), ring.data()) : CM_ERROR_ARGUMENT; }
inline void healpix_view::ring_from_nested(span<const int64_t> nested, span<int64_t> ring) const {
    detail::check(detail::holds(ring.size(), nested.size()) ? cm_healpix_ring_from_nested_array(get(),
    nested.size(), nested.data(), ring.data()) : CM_ERROR_ARGUMENT); }
inline cm_status healpix_view::try_neighbours(int64_t pixel, int64_t (&neighbour)[8]) const { return
    cm_healpix_neighbours(get(), pixel, neighbour); }
inline void healpix_view::neighbours(int64_t pixel, int64_t (&neighbour)[8]) const {
    detail::check(cm_healpix_neighbours(get(), pixel, neighbour)); }
inline cm_status healpix_view::try_boundary(int64_t pixel, size_t steps, span<double> x, span<double> y,
    span<double> z) const { return detail::holds(x.size(), 4, detail::whole(steps)) && detail::holds(y.size(),
    4, detail::whole(steps)) && detail::holds(z.size(), 4, detail::whole(steps)) ? cm_healpix_boundary(get(),
    pixel, steps, x.data(), y.data(), z.data()) : CM_ERROR_ARGUMENT; }
inline void healpix_view::boundary(int64_t pixel, size_t steps, span<double> x, span<double> y, span<double>
    z) const { detail::check(detail::holds(x.size(), 4, detail::whole(steps)) && detail::holds(y.size(), 4,
    detail::whole(steps)) && detail::holds(z.size(), 4, detail::whole(steps)) ? cm_healpix_boundary(get(),
    pixel, steps, x.data(), y.data(), z.data()) : CM_ERROR_ARGUMENT); }
inline cm_status healpix_view::try_ring_info(int64_t ring, cm_healpix_ring *info) const { return
    cm_healpix_ring_info(get(), ring, info); }
inline void healpix_view::ring_info(int64_t ring, cm_healpix_ring *info) const {
    detail::check(cm_healpix_ring_info(get(), ring, info)); }
inline cm_status healpix_view::try_ring_from_pixel(int64_t pixel, int64_t *ring, int64_t *index) const {
    return cm_healpix_ring_from_pixel(get(), pixel, ring, index); }
inline void healpix_view::ring_from_pixel(int64_t pixel, int64_t *ring, int64_t *index) const {
    detail::check(cm_healpix_ring_from_pixel(get(), pixel, ring, index)); }
inline cm_status healpix_view::try_regrade(span<const double> map, healpix_view to, span<double> result, const
    cm_healpix_regrade_options *options) const { return detail::holds(map.size(), 12,
    detail::whole(cm_healpix_nside(get())), detail::whole(cm_healpix_nside(get()))) &&
    detail::holds(result.size(), 12, detail::whole(cm_healpix_nside(to.get())),
    detail::whole(cm_healpix_nside(to.get()))) ? cm_healpix_regrade(get(), map.data(), to.get(),
    result.data(), options) : CM_ERROR_ARGUMENT; }
inline void healpix_view::regrade(span<const double> map, healpix_view to, span<double> result, const
    cm_healpix_regrade_options *options) const { detail::check(detail::holds(map.size(), 12,
    detail::whole(cm_healpix_nside(get())), detail::whole(cm_healpix_nside(get()))) &&
    detail::holds(result.size(), 12, detail::whole(cm_healpix_nside(to.get())),
    detail::whole(cm_healpix_nside(to.get()))) ? cm_healpix_regrade(get(), map.data(), to.get(),
    result.data(), options) : CM_ERROR_ARGUMENT); }
inline cm_status healpix_view::try_regrade(span<const float> map, healpix_view to, span<float> result, const
    cm_healpix_regrade_options *options) const { return detail::holds(map.size(), 12,
    detail::whole(cm_healpix_nside(get())), detail::whole(cm_healpix_nside(get()))) &&
    detail::holds(result.size(), 12, detail::whole(cm_healpix_nside(to.get())),
    detail::whole(cm_healpix_nside(to.get()))) ? cm_healpix_regrade_f32(get(), map.data(), to.get(),
    result.data(), options) : CM_ERROR_ARGUMENT; }
inline void healpix_view::regrade(span<const float> map, healpix_view to, span<float> result, const
    cm_healpix_regrade_options *options) const { detail::check(detail::holds(map.size(), 12,
    detail::whole(cm_healpix_nside(get())), detail::whole(cm_healpix_nside(get()))) &&
    detail::holds(result.size(), 12, detail::whole(cm_healpix_nside(to.get())),
    detail::whole(cm_healpix_nside(to.get()))) ? cm_healpix_regrade_f32(get(), map.data(), to.get(),
    result.data(), options) : CM_ERROR_ARGUMENT); }
inline result<healpix> healpix::try_make(int64_t nside, cm_healpix_order order, const cm_options *options) {
    cm_healpix *made_object = nullptr; const cm_status status = cm_healpix_create(nside, order, options,
    &made_object); return status == CM_OK ? result<healpix>(healpix(made_object)) : result<healpix>(status); }
inline healpix::healpix(int64_t nside, cm_healpix_order order, const cm_options *options) :
    healpix(try_make(nside, order, options).value()) {}
inline int latitude_conversion_view::order() const { return cm_latitude_conversion_order(get()); }
inline double latitude_conversion_view::error() const { return cm_latitude_conversion_error(get()); }
inline cm_status latitude_conversion_view::try_constants(double (&constants)[13], int *terms) const { return
    cm_latitude_conversion_constants(get(), constants, terms); }
inline void latitude_conversion_view::constants(double (&constants)[13], int *terms) const {
    detail::check(cm_latitude_conversion_constants(get(), constants, terms)); }
inline double latitude_conversion_view::convert(double latitude) const { return cm_latitude_convert(get(),
    latitude); }
inline void latitude_conversion_view::convert_direction(const double (&from)[3], double (&to)[3]) const {
    cm_latitude_convert_direction(get(), from, to); }
inline void latitude_conversion_view::convert(span<const double> from, span<double> to) const {
    detail::check(detail::holds(to.size(), from.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_latitude_convert_array(get(), from.size(), from.data(), to.data()); }
inline void latitude_conversion_view::convert_direction(span<const double> x, span<const double> y, span<const
    double> z, span<double> to_x, span<double> to_y, span<double> to_z) const {
    detail::check(detail::holds(y.size(), x.size()) && detail::holds(z.size(), x.size()) &&
    detail::holds(to_x.size(), x.size()) && detail::holds(to_y.size(), x.size()) && detail::holds(to_z.size(),
    x.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_latitude_convert_direction_array(get(), x.size(), x.data(),
    y.data(), z.data(), to_x.data(), to_y.data(), to_z.data()); }
inline result<latitude_conversion> latitude_conversion::try_make(const cm_ellipsoid &ellipsoid, cm_latitude
    from, cm_latitude to, const cm_latitude_options *options) { cm_latitude_conversion *made_object = nullptr;
    const cm_status status = cm_latitude_conversion_create(&ellipsoid, from, to, options, &made_object);
    return status == CM_OK ? result<latitude_conversion>(latitude_conversion(made_object)) :
    result<latitude_conversion>(status); }
inline latitude_conversion::latitude_conversion(const cm_ellipsoid &ellipsoid, cm_latitude from, cm_latitude
    to, const cm_latitude_options *options) : latitude_conversion(try_make(ellipsoid, from, to,
    options).value()) {}
inline size_t lens_map_view::unfilled() const { return cm_lens_map_unfilled(get()); }
inline size_t lens_map_view::pixel_count() const { return cm_lens_map_pixel_count(get()); }
inline size_t lens_map_view::pinhole_pixel_count() const { return cm_lens_map_pinhole_pixel_count(get()); }
inline cm_status lens_map_view::try_places(span<double> column, span<double> row) const { return
    detail::holds(column.size(), cm_lens_map_pixel_count(get())) && detail::holds(row.size(),
    cm_lens_map_pixel_count(get())) ? cm_lens_map_places(get(), column.data(), row.data()) :
    CM_ERROR_ARGUMENT; }
inline void lens_map_view::places(span<double> column, span<double> row) const {
    detail::check(detail::holds(column.size(), cm_lens_map_pixel_count(get())) && detail::holds(row.size(),
    cm_lens_map_pixel_count(get())) ? cm_lens_map_places(get(), column.data(), row.data()) :
    CM_ERROR_ARGUMENT); }
inline cm_status lens_map_view::try_color(uint32_t channels, span<const float> from, span<float> to, pool_view
    pool) const { return detail::holds(from.size(), cm_lens_map_pinhole_pixel_count(get()),
    detail::whole(channels)) && detail::holds(to.size(), cm_lens_map_pixel_count(get()),
    detail::whole(channels)) ? cm_lens_map_color(get(), channels, from.data(), to.data(), pool.get()) :
    CM_ERROR_ARGUMENT; }
inline void lens_map_view::color(uint32_t channels, span<const float> from, span<float> to, pool_view pool)
    const { detail::check(detail::holds(from.size(), cm_lens_map_pinhole_pixel_count(get()),
    detail::whole(channels)) && detail::holds(to.size(), cm_lens_map_pixel_count(get()),
    detail::whole(channels)) ? cm_lens_map_color(get(), channels, from.data(), to.data(), pool.get()) :
    CM_ERROR_ARGUMENT); }
inline cm_status lens_map_view::try_depth(double gap, span<const float> from, span<float> to, pool_view pool)
    const { return detail::holds(from.size(), cm_lens_map_pinhole_pixel_count(get())) &&
    detail::holds(to.size(), cm_lens_map_pixel_count(get())) ? cm_lens_map_depth(get(), gap, from.data(),
    to.data(), pool.get()) : CM_ERROR_ARGUMENT; }
inline void lens_map_view::depth(double gap, span<const float> from, span<float> to, pool_view pool) const {
    detail::check(detail::holds(from.size(), cm_lens_map_pinhole_pixel_count(get())) &&
    detail::holds(to.size(), cm_lens_map_pixel_count(get())) ? cm_lens_map_depth(get(), gap, from.data(),
    to.data(), pool.get()) : CM_ERROR_ARGUMENT); }
inline cm_status lens_map_view::try_labels(size_t bytes, const void *from, const void *nothing, void *to,
    pool_view pool) const { return cm_lens_map_labels(get(), bytes, from, nothing, to, pool.get()); }
inline void lens_map_view::labels(size_t bytes, const void *from, const void *nothing, void *to, pool_view
    pool) const { detail::check(cm_lens_map_labels(get(), bytes, from, nothing, to, pool.get())); }
inline cm_status lens_map_view::try_flow(span<const float> from, span<float> to, pool_view pool) const {
    return detail::holds(from.size(), cm_lens_map_pinhole_pixel_count(get()), 2) && detail::holds(to.size(),
    cm_lens_map_pixel_count(get()), 2) ? cm_lens_map_flow(get(), from.data(), to.data(), pool.get()) :
    CM_ERROR_ARGUMENT; }
inline void lens_map_view::flow(span<const float> from, span<float> to, pool_view pool) const {
    detail::check(detail::holds(from.size(), cm_lens_map_pinhole_pixel_count(get()), 2) &&
    detail::holds(to.size(), cm_lens_map_pixel_count(get()), 2) ? cm_lens_map_flow(get(), from.data(),
    to.data(), pool.get()) : CM_ERROR_ARGUMENT); }
inline result<lens_map> lens_map::try_make(camera_view camera, camera_view pinhole, pool_view pool) {
    cm_lens_map *made_object = nullptr; const cm_status status = cm_lens_map_create(camera.get(),
    pinhole.get(), pool.get(), &made_object); return status == CM_OK ? result<lens_map>(lens_map(made_object))
    : result<lens_map>(status); }
inline lens_map::lens_map(camera_view camera, camera_view pinhole, pool_view pool) : lens_map(try_make(camera,
    pinhole, pool).value()) {}
inline cm_status mapping_view::try_advise_size(double angle, cm_advice_size *size) const { return
    cm_advise_size(get(), angle, size); }
inline void mapping_view::advise_size(double angle, cm_advice_size *size) const {
    detail::check(cm_advise_size(get(), angle, size)); }
inline cm_status mapping_view::try_advise_precision(double metres, cm_advice_precision *precision) const {
    return cm_advise_precision(get(), metres, precision); }
inline void mapping_view::advise_precision(double metres, cm_advice_precision *precision) const {
    detail::check(cm_advise_precision(get(), metres, precision)); }
inline cm_status mapping_view::try_face_weights(uint8_t face, uint32_t edge, unsigned threads, span<float>
    weights) const { return detail::holds(weights.size(), detail::whole(edge), detail::whole(edge)) ?
    cm_face_weights(get(), face, edge, threads, weights.data()) : CM_ERROR_ARGUMENT; }
inline void mapping_view::face_weights(uint8_t face, uint32_t edge, unsigned threads, span<float> weights)
    const { detail::check(detail::holds(weights.size(), detail::whole(edge), detail::whole(edge)) ?
    cm_face_weights(get(), face, edge, threads, weights.data()) : CM_ERROR_ARGUMENT); }
inline void mapping_view::forward_distortion(const double (&direction)[3], cm_distortion *distortion) const {
    cm_forward_distortion(get(), direction, distortion); }
inline void mapping_view::forward_distortion(const float (&direction)[3], cm_distortion_f32 *distortion) const
    { cm_forward_distortion_f32(get(), direction, distortion); }
inline void mapping_view::inverse_distortion(uint8_t face, const double (&uv)[2], cm_distortion *distortion)
    const { cm_inverse_distortion(get(), face, uv, distortion); }
inline void mapping_view::inverse_distortion(uint8_t face, const float (&uv)[2], cm_distortion_f32
    *distortion) const { cm_inverse_distortion_f32(get(), face, uv, distortion); }
inline void mapping_view::forward_distortion(span<const double> x, span<const double> y, span<const double> z,
    const cm_distortion_arrays *distortion) const { detail::check(detail::holds(y.size(), x.size()) &&
    detail::holds(z.size(), x.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_forward_distortion_array(get(),
    x.size(), x.data(), y.data(), z.data(), distortion); }
inline void mapping_view::forward_distortion(span<const float> x, span<const float> y, span<const float> z,
    const cm_distortion_arrays_f32 *distortion) const { detail::check(detail::holds(y.size(), x.size()) &&
    detail::holds(z.size(), x.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_forward_distortion_array_f32(get(),
    x.size(), x.data(), y.data(), z.data(), distortion); }
inline void mapping_view::inverse_distortion(span<const uint8_t> face, span<const double> u, span<const
    double> v, const cm_distortion_arrays *distortion) const { detail::check(detail::holds(u.size(),
    face.size()) && detail::holds(v.size(), face.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_inverse_distortion_array(get(), face.size(), face.data(), u.data(), v.data(), distortion); }
inline void mapping_view::inverse_distortion(span<const uint8_t> face, span<const float> u, span<const float>
    v, const cm_distortion_arrays_f32 *distortion) const { detail::check(detail::holds(u.size(), face.size())
    && detail::holds(v.size(), face.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_inverse_distortion_array_f32(get(), face.size(), face.data(), u.data(), v.data(), distortion); }
inline cm_status mapping_view::try_texel_solid_angles(uint8_t face, uint32_t size, span<double> angle) const {
    return detail::holds(angle.size(), detail::whole(size), detail::whole(size)) ?
    cm_texel_solid_angles(get(), face, size, angle.data()) : CM_ERROR_ARGUMENT; }
inline void mapping_view::texel_solid_angles(uint8_t face, uint32_t size, span<double> angle) const {
    detail::check(detail::holds(angle.size(), detail::whole(size), detail::whole(size)) ?
    cm_texel_solid_angles(get(), face, size, angle.data()) : CM_ERROR_ARGUMENT); }
inline const cm_mapping_info * mapping_view::describe() const { return cm_mapping_describe(get()); }
inline const cm_frame * mapping_view::frame() const { return cm_mapping_frame(get()); }
inline double mapping_view::parameter(size_t index) const { return cm_mapping_parameter(get(), index); }
inline int mapping_view::has_bounds() const { return cm_mapping_has_bounds(get()); }
inline uint8_t mapping_view::forward(const double (&direction)[3], double (&uv)[2]) const { return
    cm_forward(get(), direction, uv); }
inline uint8_t mapping_view::forward(const float (&direction)[3], float (&uv)[2]) const { return
    cm_forward_f32(get(), direction, uv); }
inline void mapping_view::inverse(uint8_t face, const double (&uv)[2], double (&direction)[3]) const {
    cm_inverse(get(), face, uv, direction); }
inline void mapping_view::inverse(uint8_t face, const float (&uv)[2], float (&direction)[3]) const {
    cm_inverse_f32(get(), face, uv, direction); }
inline uint8_t mapping_view::forward_lonlat(double lon, double lat, double (&uv)[2]) const { return
    cm_forward_lonlat(get(), lon, lat, uv); }
inline void mapping_view::inverse_lonlat(uint8_t face, const double (&uv)[2], double (&lonlat)[2]) const {
    cm_inverse_lonlat(get(), face, uv, lonlat); }
inline void mapping_view::forward_lonlat(span<const double> lon, span<const double> lat, span<uint8_t> face,
    span<double> u, span<double> v) const { detail::check(detail::holds(lat.size(), lon.size()) &&
    detail::holds(face.size(), lon.size()) && detail::holds(u.size(), lon.size()) && detail::holds(v.size(),
    lon.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_forward_lonlat_array(get(), lon.size(), lon.data(),
    lat.data(), face.data(), u.data(), v.data()); }
inline void mapping_view::inverse_lonlat(span<const uint8_t> face, span<const double> u, span<const double> v,
    span<double> lon, span<double> lat) const { detail::check(detail::holds(u.size(), face.size()) &&
    detail::holds(v.size(), face.size()) && detail::holds(lon.size(), face.size()) &&
    detail::holds(lat.size(), face.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_inverse_lonlat_array(get(),
    face.size(), face.data(), u.data(), v.data(), lon.data(), lat.data()); }
inline void mapping_view::forward(span<const double> x, span<const double> y, span<const double> z,
    span<uint8_t> face, span<double> u, span<double> v) const { detail::check(detail::holds(y.size(),
    x.size()) && detail::holds(z.size(), x.size()) && detail::holds(face.size(), x.size()) &&
    detail::holds(u.size(), x.size()) && detail::holds(v.size(), x.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_forward_array(get(), x.size(), x.data(), y.data(), z.data(), face.data(), u.data(), v.data()); }
inline void mapping_view::forward(span<const float> x, span<const float> y, span<const float> z, span<uint8_t>
    face, span<float> u, span<float> v) const { detail::check(detail::holds(y.size(), x.size()) &&
    detail::holds(z.size(), x.size()) && detail::holds(face.size(), x.size()) && detail::holds(u.size(),
    x.size()) && detail::holds(v.size(), x.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_forward_array_f32(get(),
    x.size(), x.data(), y.data(), z.data(), face.data(), u.data(), v.data()); }
inline void mapping_view::inverse(span<const uint8_t> face, span<const double> u, span<const double> v,
    span<double> x, span<double> y, span<double> z) const { detail::check(detail::holds(u.size(), face.size())
    && detail::holds(v.size(), face.size()) && detail::holds(x.size(), face.size()) && detail::holds(y.size(),
    face.size()) && detail::holds(z.size(), face.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_inverse_array(get(),
    face.size(), face.data(), u.data(), v.data(), x.data(), y.data(), z.data()); }
inline void mapping_view::inverse(span<const uint8_t> face, span<const float> u, span<const float> v,
    span<float> x, span<float> y, span<float> z) const { detail::check(detail::holds(u.size(), face.size()) &&
    detail::holds(v.size(), face.size()) && detail::holds(x.size(), face.size()) && detail::holds(y.size(),
    face.size()) && detail::holds(z.size(), face.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_inverse_array_f32(get(), face.size(), face.data(), u.data(), v.data(), x.data(), y.data(), z.data()); }
inline void mapping_view::forward_strided(span<const double> xyz, ptrdiff_t stride, span<uint8_t> face,
    span<double> u, span<double> v) const { detail::check(detail::strides(xyz.size(), face.size(), stride) &&
    detail::holds(u.size(), face.size()) && detail::holds(v.size(), face.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_forward_strided(get(), face.size(), xyz.data(), stride, face.data(), u.data(), v.data()); }
inline void mapping_view::forward_strided(span<const float> xyz, ptrdiff_t stride, span<uint8_t> face,
    span<float> u, span<float> v) const { detail::check(detail::strides(xyz.size(), face.size(), stride) &&
    detail::holds(u.size(), face.size()) && detail::holds(v.size(), face.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_forward_strided_f32(get(), face.size(), xyz.data(), stride, face.data(), u.data(), v.data()); }
inline void mapping_view::inverse_strided(span<const uint8_t> face, span<const double> u, span<const double>
    v, span<double> xyz, ptrdiff_t stride) const { detail::check(detail::holds(u.size(), face.size()) &&
    detail::holds(v.size(), face.size()) && detail::strides(xyz.size(), face.size(), stride) ? CM_OK :
    CM_ERROR_ARGUMENT); cm_inverse_strided(get(), face.size(), face.data(), u.data(), v.data(), xyz.data(),
    stride); }
inline void mapping_view::inverse_strided(span<const uint8_t> face, span<const float> u, span<const float> v,
    span<float> xyz, ptrdiff_t stride) const { detail::check(detail::holds(u.size(), face.size()) &&
    detail::holds(v.size(), face.size()) && detail::strides(xyz.size(), face.size(), stride) ? CM_OK :
    CM_ERROR_ARGUMENT); cm_inverse_strided_f32(get(), face.size(), face.data(), u.data(), v.data(),
    xyz.data(), stride); }
inline void mapping_view::forward_jacobian(const double (&direction)[3], double (&jacobian)[6]) const {
    cm_forward_jacobian(get(), direction, jacobian); }
inline void mapping_view::forward_jacobian(const float (&direction)[3], float (&jacobian)[6]) const {
    cm_forward_jacobian_f32(get(), direction, jacobian); }
inline void mapping_view::inverse_jacobian(uint8_t face, const double (&uv)[2], double (&jacobian)[6]) const {
    cm_inverse_jacobian(get(), face, uv, jacobian); }
inline void mapping_view::inverse_jacobian(uint8_t face, const float (&uv)[2], float (&jacobian)[6]) const {
    cm_inverse_jacobian_f32(get(), face, uv, jacobian); }
inline void mapping_view::forward_jacobian(span<const double> x, span<const double> y, span<const double> z,
    double *const (&jacobian)[6]) const { detail::check(detail::holds(y.size(), x.size()) &&
    detail::holds(z.size(), x.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_forward_jacobian_array(get(), x.size(),
    x.data(), y.data(), z.data(), jacobian); }
inline void mapping_view::forward_jacobian(span<const float> x, span<const float> y, span<const float> z,
    float *const (&jacobian)[6]) const { detail::check(detail::holds(y.size(), x.size()) &&
    detail::holds(z.size(), x.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_forward_jacobian_array_f32(get(),
    x.size(), x.data(), y.data(), z.data(), jacobian); }
inline void mapping_view::inverse_jacobian(span<const uint8_t> face, span<const double> u, span<const double>
    v, double *const (&jacobian)[6]) const { detail::check(detail::holds(u.size(), face.size()) &&
    detail::holds(v.size(), face.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_inverse_jacobian_array(get(),
    face.size(), face.data(), u.data(), v.data(), jacobian); }
inline void mapping_view::inverse_jacobian(span<const uint8_t> face, span<const float> u, span<const float> v,
    float *const (&jacobian)[6]) const { detail::check(detail::holds(u.size(), face.size()) &&
    detail::holds(v.size(), face.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_inverse_jacobian_array_f32(get(),
    face.size(), face.data(), u.data(), v.data(), jacobian); }
inline cm_status mapping_view::try_warp(const double (&pq)[2], double (&uv)[2]) const { return cm_warp(get(),
    pq, uv); }
inline void mapping_view::warp(const double (&pq)[2], double (&uv)[2]) const { detail::check(cm_warp(get(),
    pq, uv)); }
inline cm_status mapping_view::try_warp(const float (&pq)[2], float (&uv)[2]) const { return
    cm_warp_f32(get(), pq, uv); }
inline void mapping_view::warp(const float (&pq)[2], float (&uv)[2]) const { detail::check(cm_warp_f32(get(),
    pq, uv)); }
inline cm_status mapping_view::try_unwarp(const double (&uv)[2], double (&pq)[2]) const { return
    cm_unwarp(get(), uv, pq); }
inline void mapping_view::unwarp(const double (&uv)[2], double (&pq)[2]) const {
    detail::check(cm_unwarp(get(), uv, pq)); }
inline cm_status mapping_view::try_unwarp(const float (&uv)[2], float (&pq)[2]) const { return
    cm_unwarp_f32(get(), uv, pq); }
inline void mapping_view::unwarp(const float (&uv)[2], float (&pq)[2]) const {
    detail::check(cm_unwarp_f32(get(), uv, pq)); }
inline cm_status mapping_view::try_warp(span<const double> p, span<const double> q, span<double> u,
    span<double> v) const { return detail::holds(q.size(), p.size()) && detail::holds(u.size(), p.size()) &&
    detail::holds(v.size(), p.size()) ? cm_warp_array(get(), p.size(), p.data(), q.data(), u.data(), v.data())
    : CM_ERROR_ARGUMENT; }
inline void mapping_view::warp(span<const double> p, span<const double> q, span<double> u, span<double> v)
    const { detail::check(detail::holds(q.size(), p.size()) && detail::holds(u.size(), p.size()) &&
    detail::holds(v.size(), p.size()) ? cm_warp_array(get(), p.size(), p.data(), q.data(), u.data(), v.data())
    : CM_ERROR_ARGUMENT); }
inline cm_status mapping_view::try_warp(span<const float> p, span<const float> q, span<float> u, span<float>
    v) const { return detail::holds(q.size(), p.size()) && detail::holds(u.size(), p.size()) &&
    detail::holds(v.size(), p.size()) ? cm_warp_array_f32(get(), p.size(), p.data(), q.data(), u.data(),
    v.data()) : CM_ERROR_ARGUMENT; }
inline void mapping_view::warp(span<const float> p, span<const float> q, span<float> u, span<float> v) const {
    detail::check(detail::holds(q.size(), p.size()) && detail::holds(u.size(), p.size()) &&
    detail::holds(v.size(), p.size()) ? cm_warp_array_f32(get(), p.size(), p.data(), q.data(), u.data(),
    v.data()) : CM_ERROR_ARGUMENT); }
inline cm_status mapping_view::try_unwarp(span<const double> u, span<const double> v, span<double> p,
    span<double> q) const { return detail::holds(v.size(), u.size()) && detail::holds(p.size(), u.size()) &&
    detail::holds(q.size(), u.size()) ? cm_unwarp_array(get(), u.size(), u.data(), v.data(), p.data(),
    q.data()) : CM_ERROR_ARGUMENT; }
inline void mapping_view::unwarp(span<const double> u, span<const double> v, span<double> p, span<double> q)
    const { detail::check(detail::holds(v.size(), u.size()) && detail::holds(p.size(), u.size()) &&
    detail::holds(q.size(), u.size()) ? cm_unwarp_array(get(), u.size(), u.data(), v.data(), p.data(),
    q.data()) : CM_ERROR_ARGUMENT); }
inline cm_status mapping_view::try_unwarp(span<const float> u, span<const float> v, span<float> p, span<float>
    q) const { return detail::holds(v.size(), u.size()) && detail::holds(p.size(), u.size()) &&
    detail::holds(q.size(), u.size()) ? cm_unwarp_array_f32(get(), u.size(), u.data(), v.data(), p.data(),
    q.data()) : CM_ERROR_ARGUMENT; }
inline void mapping_view::unwarp(span<const float> u, span<const float> v, span<float> p, span<float> q) const
    { detail::check(detail::holds(v.size(), u.size()) && detail::holds(p.size(), u.size()) &&
    detail::holds(q.size(), u.size()) ? cm_unwarp_array_f32(get(), u.size(), u.data(), v.data(), p.data(),
    q.data()) : CM_ERROR_ARGUMENT); }
inline cm_status mapping_view::try_warp_jacobian(const double (&pq)[2], double (&jacobian)[4]) const { return
    cm_warp_jacobian(get(), pq, jacobian); }
inline void mapping_view::warp_jacobian(const double (&pq)[2], double (&jacobian)[4]) const {
    detail::check(cm_warp_jacobian(get(), pq, jacobian)); }
inline cm_status mapping_view::try_warp_jacobian(const float (&pq)[2], float (&jacobian)[4]) const { return
    cm_warp_jacobian_f32(get(), pq, jacobian); }
inline void mapping_view::warp_jacobian(const float (&pq)[2], float (&jacobian)[4]) const {
    detail::check(cm_warp_jacobian_f32(get(), pq, jacobian)); }
inline cm_status mapping_view::try_warp_jacobian(span<const double> p, span<const double> q, double *const
    (&jacobian)[4]) const { return detail::holds(q.size(), p.size()) ? cm_warp_jacobian_array(get(), p.size(),
    p.data(), q.data(), jacobian) : CM_ERROR_ARGUMENT; }
inline void mapping_view::warp_jacobian(span<const double> p, span<const double> q, double *const
    (&jacobian)[4]) const { detail::check(detail::holds(q.size(), p.size()) ? cm_warp_jacobian_array(get(),
    p.size(), p.data(), q.data(), jacobian) : CM_ERROR_ARGUMENT); }
inline cm_status mapping_view::try_warp_jacobian(span<const float> p, span<const float> q, float *const
    (&jacobian)[4]) const { return detail::holds(q.size(), p.size()) ? cm_warp_jacobian_array_f32(get(),
    p.size(), p.data(), q.data(), jacobian) : CM_ERROR_ARGUMENT; }
inline void mapping_view::warp_jacobian(span<const float> p, span<const float> q, float *const (&jacobian)[4])
    const { detail::check(detail::holds(q.size(), p.size()) ? cm_warp_jacobian_array_f32(get(), p.size(),
    p.data(), q.data(), jacobian) : CM_ERROR_ARGUMENT); }
inline cm_tier mapping_view::tier() const { return cm_mapping_tier(get()); }
inline const char * mapping_view::instructions() const { return cm_mapping_instructions(get()); }
inline cm_status mapping_view::try_orient(const cm_mask &mask, const cm_orient_options *options,
    cm_orient_result *result) const { return cm_orient(get(), &mask, options, result); }
inline void mapping_view::orient(const cm_mask &mask, const cm_orient_options *options, cm_orient_result
    *result) const { detail::check(cm_orient(get(), &mask, options, result)); }
inline cm_status mapping_view::try_orient_value(const cm_mask &mask, const cm_orient_options *options, const
    cm_rotation &rotation, double *value) const { return cm_orient_value(get(), &mask, options, &rotation,
    value); }
inline void mapping_view::orient_value(const cm_mask &mask, const cm_orient_options *options, const
    cm_rotation &rotation, double *value) const { detail::check(cm_orient_value(get(), &mask, options,
    &rotation, value)); }
inline cm_status mapping_view::try_distortion_statistics(cm_quantity quantity, const cm_statistics_options
    *options, cm_statistics *statistics) const { return cm_distortion_statistics(get(), quantity, options,
    statistics); }
inline void mapping_view::distortion_statistics(cm_quantity quantity, const cm_statistics_options *options,
    cm_statistics *statistics) const { detail::check(cm_distortion_statistics(get(), quantity, options,
    statistics)); }
inline cm_status mapping_view::try_distortion_percentiles(cm_quantity quantity, const cm_statistics_options
    *options, span<const double> percent, span<double> value, span<double> doubt) const { return
    detail::holds(value.size(), percent.size()) && (doubt.data() == nullptr || detail::holds(doubt.size(),
    percent.size())) ? cm_distortion_percentiles(get(), quantity, options, percent.size(), percent.data(),
    value.data(), doubt.data()) : CM_ERROR_ARGUMENT; }
inline void mapping_view::distortion_percentiles(cm_quantity quantity, const cm_statistics_options *options,
    span<const double> percent, span<double> value, span<double> doubt) const {
    detail::check(detail::holds(value.size(), percent.size()) && (doubt.data() == nullptr ||
    detail::holds(doubt.size(), percent.size())) ? cm_distortion_percentiles(get(), quantity, options,
    percent.size(), percent.data(), value.data(), doubt.data()) : CM_ERROR_ARGUMENT); }
inline void mapping_view::forward(unsigned threads, span<const double> x, span<const double> y, span<const
    double> z, span<uint8_t> face, span<double> u, span<double> v) const {
    detail::check(detail::holds(y.size(), x.size()) && detail::holds(z.size(), x.size()) &&
    detail::holds(face.size(), x.size()) && detail::holds(u.size(), x.size()) && detail::holds(v.size(),
    x.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_forward_array_threads(get(), threads, x.size(), x.data(),
    y.data(), z.data(), face.data(), u.data(), v.data()); }
inline void mapping_view::forward(unsigned threads, span<const float> x, span<const float> y, span<const
    float> z, span<uint8_t> face, span<float> u, span<float> v) const { detail::check(detail::holds(y.size(),
    x.size()) && detail::holds(z.size(), x.size()) && detail::holds(face.size(), x.size()) &&
    detail::holds(u.size(), x.size()) && detail::holds(v.size(), x.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_forward_array_threads_f32(get(), threads, x.size(), x.data(), y.data(), z.data(), face.data(),
    u.data(), v.data()); }
inline void mapping_view::inverse(unsigned threads, span<const uint8_t> face, span<const double> u, span<const
    double> v, span<double> x, span<double> y, span<double> z) const { detail::check(detail::holds(u.size(),
    face.size()) && detail::holds(v.size(), face.size()) && detail::holds(x.size(), face.size()) &&
    detail::holds(y.size(), face.size()) && detail::holds(z.size(), face.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_inverse_array_threads(get(), threads, face.size(), face.data(), u.data(), v.data(), x.data(), y.data(),
    z.data()); }
inline void mapping_view::inverse(unsigned threads, span<const uint8_t> face, span<const float> u, span<const
    float> v, span<float> x, span<float> y, span<float> z) const { detail::check(detail::holds(u.size(),
    face.size()) && detail::holds(v.size(), face.size()) && detail::holds(x.size(), face.size()) &&
    detail::holds(y.size(), face.size()) && detail::holds(z.size(), face.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_inverse_array_threads_f32(get(), threads, face.size(), face.data(), u.data(), v.data(), x.data(),
    y.data(), z.data()); }
inline void mapping_view::forward_strided(unsigned threads, span<const double> xyz, ptrdiff_t stride,
    span<uint8_t> face, span<double> u, span<double> v) const { detail::check(detail::strides(xyz.size(),
    face.size(), stride) && detail::holds(u.size(), face.size()) && detail::holds(v.size(), face.size()) ?
    CM_OK : CM_ERROR_ARGUMENT); cm_forward_strided_threads(get(), threads, face.size(), xyz.data(), stride,
    face.data(), u.data(), v.data()); }
inline void mapping_view::forward_strided(unsigned threads, span<const float> xyz, ptrdiff_t stride,
    span<uint8_t> face, span<float> u, span<float> v) const { detail::check(detail::strides(xyz.size(),
    face.size(), stride) && detail::holds(u.size(), face.size()) && detail::holds(v.size(), face.size()) ?
    CM_OK : CM_ERROR_ARGUMENT); cm_forward_strided_threads_f32(get(), threads, face.size(), xyz.data(),
    stride, face.data(), u.data(), v.data()); }
inline void mapping_view::inverse_strided(unsigned threads, span<const uint8_t> face, span<const double> u,
    span<const double> v, span<double> xyz, ptrdiff_t stride) const { detail::check(detail::holds(u.size(),
    face.size()) && detail::holds(v.size(), face.size()) && detail::strides(xyz.size(), face.size(), stride) ?
    CM_OK : CM_ERROR_ARGUMENT); cm_inverse_strided_threads(get(), threads, face.size(), face.data(), u.data(),
    v.data(), xyz.data(), stride); }
inline void mapping_view::inverse_strided(unsigned threads, span<const uint8_t> face, span<const float> u,
    span<const float> v, span<float> xyz, ptrdiff_t stride) const { detail::check(detail::holds(u.size(),
    face.size()) && detail::holds(v.size(), face.size()) && detail::strides(xyz.size(), face.size(), stride) ?
    CM_OK : CM_ERROR_ARGUMENT); cm_inverse_strided_threads_f32(get(), threads, face.size(), face.data(),
    u.data(), v.data(), xyz.data(), stride); }
inline void mapping_view::forward_jacobian(unsigned threads, span<const double> x, span<const double> y,
    span<const double> z, double *const (&jacobian)[6]) const { detail::check(detail::holds(y.size(),
    x.size()) && detail::holds(z.size(), x.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_forward_jacobian_array_threads(get(), threads, x.size(), x.data(), y.data(), z.data(), jacobian); }
inline void mapping_view::forward_jacobian(unsigned threads, span<const float> x, span<const float> y,
    span<const float> z, float *const (&jacobian)[6]) const { detail::check(detail::holds(y.size(), x.size())
    && detail::holds(z.size(), x.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_forward_jacobian_array_threads_f32(get(), threads, x.size(), x.data(), y.data(), z.data(), jacobian); }
inline void mapping_view::inverse_jacobian(unsigned threads, span<const uint8_t> face, span<const double> u,
    span<const double> v, double *const (&jacobian)[6]) const { detail::check(detail::holds(u.size(),
    face.size()) && detail::holds(v.size(), face.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_inverse_jacobian_array_threads(get(), threads, face.size(), face.data(), u.data(), v.data(), jacobian);
    }
inline void mapping_view::inverse_jacobian(unsigned threads, span<const uint8_t> face, span<const float> u,
    span<const float> v, float *const (&jacobian)[6]) const { detail::check(detail::holds(u.size(),
    face.size()) && detail::holds(v.size(), face.size()) ? CM_OK : CM_ERROR_ARGUMENT);
    cm_inverse_jacobian_array_threads_f32(get(), threads, face.size(), face.data(), u.data(), v.data(),
    jacobian); }
inline result<mapping> mapping::try_make(const char *specification, const cm_frame *frame) { cm_mapping
    *made_object = nullptr; const cm_status status = cm_mapping_create(specification, frame, &made_object);
    return status == CM_OK ? result<mapping>(mapping(made_object)) : result<mapping>(status); }
inline mapping::mapping(const char *specification, const cm_frame *frame) : mapping(try_make(specification,
    frame).value([&](char *words, std::size_t size) { cm_specification_check(specification, words, size); }))
    {}
inline result<mapping> mapping::try_make(const char *specification, const cm_frame *frame, const cm_options
    *options) { cm_mapping *made_object = nullptr; const cm_status status =
    cm_mapping_create_with(specification, frame, options, &made_object); return status == CM_OK ?
    result<mapping>(mapping(made_object)) : result<mapping>(status); }
inline mapping::mapping(const char *specification, const cm_frame *frame, const cm_options *options) :
    mapping(try_make(specification, frame, options).value([&](char *words, std::size_t size) {
    cm_specification_check(specification, words, size); })) {}
inline const cm_mesh_options * mesh_view::describe() const { return cm_mesh_describe(get()); }
inline void mesh_view::bounds(double (&least)[3], double (&greatest)[3]) const { cm_mesh_bounds(get(), least,
    greatest); }
inline result<mesh> mesh::try_make(const cm_mesh_options &options) { cm_mesh *made_object = nullptr; const
    cm_status status = cm_mesh_create(&options, &made_object); return status == CM_OK ?
    result<mesh>(mesh(made_object)) : result<mesh>(status); }
inline mesh::mesh(const cm_mesh_options &options) : mesh(try_make(options).value()) {}
inline uint32_t mips_view::count() const { return cm_mips_count(get()); }
inline const cm_image * mips_view::pictures(uint32_t level) const { return cm_mips_pictures(get(), level); }
inline result<mips> mips::try_make(surface_view surface, const cm_image *pictures, const cm_plan_options
    *options, unsigned threads) { cm_mips *made_object = nullptr; const cm_status status =
    cm_mips_create(surface.get(), pictures, options, threads, &made_object); return status == CM_OK ?
    result<mips>(mips(made_object)) : result<mips>(status); }
inline mips::mips(surface_view surface, const cm_image *pictures, const cm_plan_options *options, unsigned
    threads) : mips(try_make(surface, pictures, options, threads).value()) {}
inline cm_status motion_view::try_at(double time, cm_motion_state *state) const { return cm_motion_at(get(),
    time, state); }
inline void motion_view::at(double time, cm_motion_state *state) const { detail::check(cm_motion_at(get(),
    time, state)); }
inline cm_status motion_view::try_inertial(const cm_inertial_options *options, span<double> stamp,
    span<double> acceleration, span<double> rate, size_t *count) const { return
    detail::holds(acceleration.size(), stamp.size(), 3) && detail::holds(rate.size(), stamp.size(), 3) ?
    cm_motion_inertial(get(), options, stamp.size(), stamp.data(), acceleration.data(), rate.data(), count) :
    CM_ERROR_ARGUMENT; }
inline void motion_view::inertial(const cm_inertial_options *options, span<double> stamp, span<double>
    acceleration, span<double> rate, size_t *count) const { detail::check(detail::holds(acceleration.size(),
    stamp.size(), 3) && detail::holds(rate.size(), stamp.size(), 3) ? cm_motion_inertial(get(), options,
    stamp.size(), stamp.data(), acceleration.data(), rate.data(), count) : CM_ERROR_ARGUMENT); }
inline result<motion> motion::try_make(trajectory_view trajectory) { cm_motion *made_object = nullptr; const
    cm_status status = cm_motion_create(trajectory.get(), &made_object); return status == CM_OK ?
    result<motion>(motion(made_object)) : result<motion>(status); }
inline motion::motion(trajectory_view trajectory) : motion(try_make(trajectory).value()) {}
inline const cm_octree_options * octree_view::describe() const { return cm_octree_describe(get()); }
inline cm_status octree_view::try_update(const cm_view &view, pool_view pool) const { return
    cm_octree_update(get(), &view, pool.get()); }
inline void octree_view::update(const cm_view &view, pool_view pool) const {
    detail::check(cm_octree_update(get(), &view, pool.get())); }
inline cm_status octree_view::try_update_points(const double (&origin)[3], size_t n, span<const float> xyz,
    span<const uint8_t> rgb) const { return detail::holds(xyz.size(), detail::whole(n), 3) &&
    detail::holds(rgb.size(), detail::whole(n), 3) ? cm_octree_update_points(get(), origin, n, xyz.data(),
    rgb.data()) : CM_ERROR_ARGUMENT; }
inline void octree_view::update_points(const double (&origin)[3], size_t n, span<const float> xyz, span<const
    uint8_t> rgb) const { detail::check(detail::holds(xyz.size(), detail::whole(n), 3) &&
    detail::holds(rgb.size(), detail::whole(n), 3) ? cm_octree_update_points(get(), origin, n, xyz.data(),
    rgb.data()) : CM_ERROR_ARGUMENT); }
inline cm_status octree_view::try_merge(octree_view from, const cm_pose &pose) const { return
    cm_octree_merge(get(), from.get(), &pose); }
inline void octree_view::merge(octree_view from, const cm_pose &pose) const {
    detail::check(cm_octree_merge(get(), from.get(), &pose)); }
inline cm_status octree_view::try_compact() const { return cm_octree_compact(get()); }
inline void octree_view::compact() const { detail::check(cm_octree_compact(get())); }
inline int octree_view::at(const double (&point)[3], int level, cm_voxel *voxel) const { return
    cm_octree_at(get(), point, level, voxel); }
inline int octree_view::ray(const double (&origin)[3], const double (&direction)[3], double far, cm_voxel
    *voxel) const { return cm_octree_ray(get(), origin, direction, far, voxel); }
inline int octree_view::nearest(const double (&point)[3], double radius, cm_voxel *voxel) const { return
    cm_octree_nearest(get(), point, radius, voxel); }
inline cm_status octree_view::try_walk_ray(const double (&origin)[3], const double (&direction)[3], double
    far, cm_voxel_job job, void *user) const { return cm_octree_walk_ray(get(), origin, direction, far, job,
    user); }
inline void octree_view::walk_ray(const double (&origin)[3], const double (&direction)[3], double far,
    cm_voxel_job job, void *user) const { detail::check(cm_octree_walk_ray(get(), origin, direction, far, job,
    user)); }
inline cm_status octree_view::try_walk_box(const double (&least)[3], const double (&greatest)[3], cm_voxel_job
    job, void *user) const { return cm_octree_walk_box(get(), least, greatest, job, user); }
inline void octree_view::walk_box(const double (&least)[3], const double (&greatest)[3], cm_voxel_job job,
    void *user) const { detail::check(cm_octree_walk_box(get(), least, greatest, job, user)); }
inline cm_status octree_view::try_walk_changes(uint64_t since, cm_voxel_job job, void *user) const { return
    cm_octree_walk_changes(get(), since, job, user); }
inline void octree_view::walk_changes(uint64_t since, cm_voxel_job job, void *user) const {
    detail::check(cm_octree_walk_changes(get(), since, job, user)); }
inline uint64_t octree_view::step() const { return cm_octree_step(get()); }
inline cm_status octree_view::try_extract(int level, span<cm_voxel> voxel, size_t *count) const { return
    cm_octree_extract(get(), level, voxel.size(), voxel.data(), count); }
inline void octree_view::extract(int level, span<cm_voxel> voxel, size_t *count) const {
    detail::check(cm_octree_extract(get(), level, voxel.size(), voxel.data(), count)); }
inline cm_status octree_view::try_count_voxels(cm_octree_count *count) const { return
    cm_octree_count_voxels(get(), count); }
inline void octree_view::count_voxels(cm_octree_count *count) const {
    detail::check(cm_octree_count_voxels(get(), count)); }
inline cm_status octree_view::try_save(store_view store, const void *user_data, size_t count) const { return
    cm_octree_save(get(), store.get(), user_data, count); }
inline void octree_view::save(store_view store, const void *user_data, size_t count) const {
    detail::check(cm_octree_save(get(), store.get(), user_data, count)); }
inline const void * octree_view::user_data(size_t *count) const { return cm_octree_user_data(get(), count); }
inline cm_status octree_view::try_render(camera_view camera, const cm_pose &pose, const cm_octree_shading
    &shading, cm_image *color, cm_image *depth) const { return cm_octree_render(get(), camera.get(), &pose,
    &shading, color, depth); }
inline void octree_view::render(camera_view camera, const cm_pose &pose, const cm_octree_shading &shading,
    cm_image *color, cm_image *depth) const { detail::check(cm_octree_render(get(), camera.get(), &pose,
    &shading, color, depth)); }
inline cm_status octree_view::try_carve_hull(span<const cm_view> masks, int outside_survives, pool_view pool)
    const { return cm_hull_carve(get(), masks.size(), masks.data(), outside_survives, pool.get()); }
inline void octree_view::carve_hull(span<const cm_view> masks, int outside_survives, pool_view pool) const {
    detail::check(cm_hull_carve(get(), masks.size(), masks.data(), outside_survives, pool.get())); }
inline result<octree> octree::try_make(const cm_octree_options &options) { cm_octree *made_object = nullptr;
    const cm_status status = cm_octree_create(&options, &made_object); return status == CM_OK ?
    result<octree>(octree(made_object)) : result<octree>(status); }
inline octree::octree(const cm_octree_options &options) : octree(try_make(options).value()) {}
inline result<octree> octree::try_load(store_view store, const cm_octree_options &options) { cm_octree
    *made_object = nullptr; const cm_status status = cm_octree_load(store.get(), &options, &made_object);
    return status == CM_OK ? result<octree>(octree(made_object)) : result<octree>(status); }
inline octree octree::load(store_view store, const cm_octree_options &options) { return try_load(store,
    options).value(); }
inline cm_status plan_view::try_write(char *text, size_t size, size_t *length) const { return
    cm_plan_write(get(), text, size, length); }
inline void plan_view::write(char *text, size_t size, size_t *length) const {
    detail::check(cm_plan_write(get(), text, size, length)); }
inline cm_status plan_view::try_resample_source(source_view source, cm_image *to, cm_rows rows, unsigned
    threads) const { return cm_resample_source(get(), source.get(), to, rows, threads); }
inline void plan_view::resample_source(source_view source, cm_image *to, cm_rows rows, unsigned threads) const
    { detail::check(cm_resample_source(get(), source.get(), to, rows, threads)); }
inline cm_status plan_view::try_resample(const cm_image *from, cm_image *to, cm_rows rows) const { return
    cm_resample(get(), from, to, rows); }
inline void plan_view::resample(const cm_image *from, cm_image *to, cm_rows rows) const {
    detail::check(cm_resample(get(), from, to, rows)); }
inline result<plan> plan::try_make(surface_view from, surface_view to, const cm_plan_options *options) {
    cm_plan *made_object = nullptr; const cm_status status = cm_plan_create(from.get(), to.get(), options,
    &made_object); return status == CM_OK ? result<plan>(plan(made_object)) : result<plan>(status); }
inline plan::plan(surface_view from, surface_view to, const cm_plan_options *options) : plan(try_make(from,
    to, options).value()) {}
inline result<plan> plan::try_read(span<const char> text, const char *instructions) { cm_plan *made_object =
    nullptr; const cm_status status = cm_plan_read(text.data(), text.size(), instructions, &made_object);
    return status == CM_OK ? result<plan>(plan(made_object)) : result<plan>(status); }
inline plan plan::read(span<const char> text, const char *instructions) { return try_read(text,
    instructions).value(); }
inline unsigned pool_view::threads() const { return cm_pool_threads(get()); }
inline void pool_view::run(size_t n, size_t least, cm_job job, void *user) const { cm_pool_run(get(), n,
    least, job, user); }
inline result<pool> pool::try_make(unsigned threads) { cm_pool *made_object = nullptr; const cm_status status
    = cm_pool_create(threads, &made_object); return status == CM_OK ? result<pool>(pool(made_object)) :
    result<pool>(status); }
inline pool::pool(unsigned threads) : pool(try_make(threads).value()) {}
inline cm_status raster_view::try_use_pool(pool_view pool) const { return cm_raster_use_pool(get(),
    pool.get()); }
inline void raster_view::use_pool(pool_view pool) const { detail::check(cm_raster_use_pool(get(),
    pool.get())); }
inline size_t raster_view::pixel_count() const { return cm_raster_pixel_count(get()); }
inline void raster_view::clear() const { cm_raster_clear(get()); }
inline cm_status raster_view::try_triangles(const cm_pose *pose, const cm_triangles &triangles, unsigned
    threads) const { return cm_raster_triangles(get(), pose, &triangles, threads); }
inline void raster_view::triangles(const cm_pose *pose, const cm_triangles &triangles, unsigned threads) const
    { detail::check(cm_raster_triangles(get(), pose, &triangles, threads)); }
inline cm_status raster_view::try_discs(const cm_pose *pose, const cm_discs &discs, unsigned threads) const {
    return cm_raster_discs(get(), pose, &discs, threads); }
inline void raster_view::discs(const cm_pose *pose, const cm_discs &discs, unsigned threads) const {
    detail::check(cm_raster_discs(get(), pose, &discs, threads)); }
inline cm_status raster_view::try_points(const cm_pose *pose, const cm_points &points, unsigned threads) const
    { return cm_raster_points(get(), pose, &points, threads); }
inline void raster_view::points(const cm_pose *pose, const cm_points &points, unsigned threads) const {
    detail::check(cm_raster_points(get(), pose, &points, threads)); }
inline cm_status raster_view::try_read(span<float> image, span<uint32_t> id) const { return (image.data() ==
    nullptr || detail::holds(image.size(), cm_raster_pixel_count(get()))) && (id.data() == nullptr ||
    detail::holds(id.size(), cm_raster_pixel_count(get()))) ? cm_raster_read(get(), image.data(), id.data()) :
    CM_ERROR_ARGUMENT; }
inline void raster_view::read(span<float> image, span<uint32_t> id) const { detail::check((image.data() ==
    nullptr || detail::holds(image.size(), cm_raster_pixel_count(get()))) && (id.data() == nullptr ||
    detail::holds(id.size(), cm_raster_pixel_count(get()))) ? cm_raster_read(get(), image.data(), id.data()) :
    CM_ERROR_ARGUMENT); }
inline cm_status raster_view::try_weights(const cm_pose *pose, const cm_triangles &triangles, span<float>
    second, span<float> third) const { return detail::holds(second.size(), cm_raster_pixel_count(get())) &&
    detail::holds(third.size(), cm_raster_pixel_count(get())) ? cm_raster_weights(get(), pose, &triangles,
    second.data(), third.data()) : CM_ERROR_ARGUMENT; }
inline void raster_view::weights(const cm_pose *pose, const cm_triangles &triangles, span<float> second,
    span<float> third) const { detail::check(detail::holds(second.size(), cm_raster_pixel_count(get())) &&
    detail::holds(third.size(), cm_raster_pixel_count(get())) ? cm_raster_weights(get(), pose, &triangles,
    second.data(), third.data()) : CM_ERROR_ARGUMENT); }
inline result<raster> raster::try_make(camera_view camera, double nearest, const char *instructions) {
    cm_raster *made_object = nullptr; const cm_status status = cm_raster_create(camera.get(), nearest,
    instructions, &made_object); return status == CM_OK ? result<raster>(raster(made_object)) :
    result<raster>(status); }
inline raster::raster(camera_view camera, double nearest, const char *instructions) : raster(try_make(camera,
    nearest, instructions).value()) {}
inline cm_status rays_view::try_use_pool(pool_view pool) const { return cm_rays_use_pool(get(), pool.get()); }
inline void rays_view::use_pool(pool_view pool) const { detail::check(cm_rays_use_pool(get(), pool.get())); }
inline size_t rays_view::pixel_count() const { return cm_rays_pixel_count(get()); }
inline size_t rays_view::halved_pixel_count() const { return cm_rays_halved_pixel_count(get()); }
inline cm_status rays_view::try_to_range(span<const float> depth, unsigned threads, span<float> range) const {
    return detail::holds(depth.size(), cm_rays_pixel_count(get())) && detail::holds(range.size(),
    cm_rays_pixel_count(get())) ? cm_depth_to_range(get(), depth.data(), threads, range.data()) :
    CM_ERROR_ARGUMENT; }
inline void rays_view::to_range(span<const float> depth, unsigned threads, span<float> range) const {
    detail::check(detail::holds(depth.size(), cm_rays_pixel_count(get())) && detail::holds(range.size(),
    cm_rays_pixel_count(get())) ? cm_depth_to_range(get(), depth.data(), threads, range.data()) :
    CM_ERROR_ARGUMENT); }
inline cm_status rays_view::try_from_range(span<const float> range, unsigned threads, span<float> depth) const
    { return detail::holds(range.size(), cm_rays_pixel_count(get())) && detail::holds(depth.size(),
    cm_rays_pixel_count(get())) ? cm_depth_from_range(get(), range.data(), threads, depth.data()) :
    CM_ERROR_ARGUMENT; }
inline void rays_view::from_range(span<const float> range, unsigned threads, span<float> depth) const {
    detail::check(detail::holds(range.size(), cm_rays_pixel_count(get())) && detail::holds(depth.size(),
    cm_rays_pixel_count(get())) ? cm_depth_from_range(get(), range.data(), threads, depth.data()) :
    CM_ERROR_ARGUMENT); }
inline cm_status rays_view::try_make_maps(span<const float> image, unsigned threads, const cm_depth_maps
    &maps) const { return detail::holds(image.size(), cm_rays_pixel_count(get())) ? cm_depth_make_maps(get(),
    image.data(), threads, &maps) : CM_ERROR_ARGUMENT; }
inline void rays_view::make_maps(span<const float> image, unsigned threads, const cm_depth_maps &maps) const {
    detail::check(detail::holds(image.size(), cm_rays_pixel_count(get())) ? cm_depth_make_maps(get(),
    image.data(), threads, &maps) : CM_ERROR_ARGUMENT); }
inline cm_status rays_view::try_smooth(span<const float> from, double pixels, double metres, unsigned threads,
    span<float> to) const { return detail::holds(from.size(), cm_rays_pixel_count(get())) &&
    detail::holds(to.size(), cm_rays_pixel_count(get())) ? cm_depth_smooth(get(), from.data(), pixels, metres,
    threads, to.data()) : CM_ERROR_ARGUMENT; }
inline void rays_view::smooth(span<const float> from, double pixels, double metres, unsigned threads,
    span<float> to) const { detail::check(detail::holds(from.size(), cm_rays_pixel_count(get())) &&
    detail::holds(to.size(), cm_rays_pixel_count(get())) ? cm_depth_smooth(get(), from.data(), pixels, metres,
    threads, to.data()) : CM_ERROR_ARGUMENT); }
inline cm_status rays_view::try_halve(span<const float> from, double gap, unsigned threads, span<float> to)
    const { return detail::holds(from.size(), cm_rays_pixel_count(get())) && detail::holds(to.size(),
    cm_rays_halved_pixel_count(get())) ? cm_depth_halve(get(), from.data(), gap, threads, to.data()) :
    CM_ERROR_ARGUMENT; }
inline void rays_view::halve(span<const float> from, double gap, unsigned threads, span<float> to) const {
    detail::check(detail::holds(from.size(), cm_rays_pixel_count(get())) && detail::holds(to.size(),
    cm_rays_halved_pixel_count(get())) ? cm_depth_halve(get(), from.data(), gap, threads, to.data()) :
    CM_ERROR_ARGUMENT); }
inline result<rays> rays::try_make(camera_view camera, const char *instructions) { cm_rays *made_object =
    nullptr; const cm_status status = cm_rays_create(camera.get(), instructions, &made_object); return status
    == CM_OK ? result<rays>(rays(made_object)) : result<rays>(status); }
inline rays::rays(camera_view camera, const char *instructions) : rays(try_make(camera, instructions).value())
    {}
inline int region_view::contains(const double (&normal)[3]) const { return cm_region_contains(get(), normal);
    }
inline result<region> region::try_cap(const double (&normal)[3], double radius) { cm_region *made_object =
    nullptr; const cm_status status = cm_region_cap(normal, radius, &made_object); return status == CM_OK ?
    result<region>(region(made_object)) : result<region>(status); }
inline region region::cap(const double (&normal)[3], double radius) { return try_cap(normal, radius).value();
    }
inline result<region> region::try_cap_lonlat(double lon, double lat, double radius) { cm_region *made_object =
    nullptr; const cm_status status = cm_region_cap_lonlat(lon, lat, radius, &made_object); return status ==
    CM_OK ? result<region>(region(made_object)) : result<region>(status); }
inline region region::cap_lonlat(double lon, double lat, double radius) { return try_cap_lonlat(lon, lat,
    radius).value(); }
inline result<region> region::try_box(double west, double south, double east, double north) { cm_region
    *made_object = nullptr; const cm_status status = cm_region_box(west, south, east, north, &made_object);
    return status == CM_OK ? result<region>(region(made_object)) : result<region>(status); }
inline region region::box(double west, double south, double east, double north) { return try_box(west, south,
    east, north).value(); }
inline result<region> region::try_polygon(span<const size_t> ring_length, span<const double> lonlat) {
    cm_region *made_object = nullptr; const cm_status status = detail::holds(lonlat.size(),
    detail::sum(ring_length), 2) ? cm_region_polygon(ring_length.size(), ring_length.data(), lonlat.data(),
    &made_object) : CM_ERROR_ARGUMENT; return status == CM_OK ? result<region>(region(made_object)) :
    result<region>(status); }
inline region region::polygon(span<const size_t> ring_length, span<const double> lonlat) { return
    try_polygon(ring_length, lonlat).value(); }
inline cm_status scene_view::try_texel_render(const cm_pose &pose, const cm_texel_options &options, pool_view
    pool, const cm_texel_image &image) const { return cm_texel_render(get(), &pose, &options, pool.get(),
    &image); }
inline void scene_view::texel_render(const cm_pose &pose, const cm_texel_options &options, pool_view pool,
    const cm_texel_image &image) const { detail::check(cm_texel_render(get(), &pose, &options, pool.get(),
    &image)); }
inline cm_status scene_view::try_add(const cm_primitive &primitive, uint32_t *id) const { return
    cm_scene_add(get(), &primitive, id); }
inline void scene_view::add(const cm_primitive &primitive, uint32_t *id) const {
    detail::check(cm_scene_add(get(), &primitive, id)); }
inline size_t scene_view::count() const { return cm_scene_count(get()); }
inline const cm_primitive * scene_view::at(uint32_t id) const { return cm_scene_at(get(), id); }
inline void scene_view::cast(span<const double> origin_x, span<const double> origin_y, span<const double>
    origin_z, span<const double> direction_x, span<const double> direction_y, span<const double> direction_z,
    const cm_hit_arrays *hit) const { detail::check(detail::holds(origin_y.size(), origin_x.size()) &&
    detail::holds(origin_z.size(), origin_x.size()) && detail::holds(direction_x.size(), origin_x.size()) &&
    detail::holds(direction_y.size(), origin_x.size()) && detail::holds(direction_z.size(), origin_x.size()) ?
    CM_OK : CM_ERROR_ARGUMENT); cm_scene_cast_array(get(), origin_x.size(), origin_x.data(), origin_y.data(),
    origin_z.data(), direction_x.data(), direction_y.data(), direction_z.data(), hit); }
inline result<scene> scene::try_make() { cm_scene *made_object = nullptr; const cm_status status =
    cm_scene_create(&made_object); return status == CM_OK ? result<scene>(scene(made_object)) :
    result<scene>(status); }
inline scene::scene() : scene(try_make().value()) {}
inline result<scene> scene::try_named(const char *name) { cm_scene *made_object = nullptr; const cm_status
    status = cm_scene_create_named(name, &made_object); return status == CM_OK ?
    result<scene>(scene(made_object)) : result<scene>(status); }
inline scene scene::named(const char *name) { return try_named(name).value(); }
inline cm_filter source_view::filter() const { return cm_source_filter(get()); }
inline result<source> source::try_make(plan_view plan, const cm_image *from, cm_pixel_type target_type,
    unsigned threads) { cm_source *made_object = nullptr; const cm_status status =
    cm_source_create(plan.get(), from, target_type, threads, &made_object); return status == CM_OK ?
    result<source>(source(made_object)) : result<source>(status); }
inline source::source(plan_view plan, const cm_image *from, cm_pixel_type target_type, unsigned threads) :
    source(try_make(plan, from, target_type, threads).value()) {}
inline cm_status store_view::try_get(const cm_store_key &key, uint32_t kind, uint32_t newest, cm_blob *blob)
    const { return cm_store_get(get(), &key, kind, newest, blob); }
inline void store_view::get(const cm_store_key &key, uint32_t kind, uint32_t newest, cm_blob *blob) const {
    detail::check(cm_store_get(get(), &key, kind, newest, blob)); }
inline cm_status store_view::try_put(const cm_store_key &key, const cm_blob &blob) const { return
    cm_store_put(get(), &key, &blob); }
inline void store_view::put(const cm_store_key &key, const cm_blob &blob) const {
    detail::check(cm_store_put(get(), &key, &blob)); }
inline cm_status store_view::try_remove(const cm_store_key &key) const { return cm_store_remove(get(), &key);
    }
inline void store_view::remove(const cm_store_key &key) const { detail::check(cm_store_remove(get(), &key)); }
inline cm_status store_view::try_next(const cm_store_key *after, unsigned char (&key)[255], size_t *count)
    const { return cm_store_next(get(), after, key, count); }
inline void store_view::next(const cm_store_key *after, unsigned char (&key)[255], size_t *count) const {
    detail::check(cm_store_next(get(), after, key, count)); }
inline cm_status store_view::try_commit() const { return cm_store_commit(get()); }
inline void store_view::commit() const { detail::check(cm_store_commit(get())); }
inline cm_status store_view::try_rollback() const { return cm_store_rollback(get()); }
inline void store_view::rollback() const { detail::check(cm_store_rollback(get())); }
inline const char * store_view::message() const { return cm_store_message(get()); }
inline result<store> store::try_make(const cm_store_methods &methods, void *context) { cm_store *made_object =
    nullptr; const cm_status status = cm_store_create(&methods, context, &made_object); return status == CM_OK
    ? result<store>(store(made_object)) : result<store>(status); }
inline store::store(const cm_store_methods &methods, void *context) : store(try_make(methods,
    context).value()) {}
inline result<store> store::try_in_memory() { cm_store *made_object = nullptr; const cm_status status =
    cm_store_create_in_memory(&made_object); return status == CM_OK ? result<store>(store(made_object)) :
    result<store>(status); }
inline store store::in_memory() { return try_in_memory().value(); }
inline const char * surface_view::specification() const { return cm_surface_specification(get()); }
inline size_t surface_view::picture_count() const { return cm_surface_picture_count(get()); }
inline uint32_t surface_view::width() const { return cm_surface_width(get()); }
inline uint32_t surface_view::height() const { return cm_surface_height(get()); }
inline size_t surface_view::plane_count() const { return cm_surface_plane_count(get()); }
inline uint32_t surface_view::plane_width() const { return cm_surface_plane_width(get()); }
inline uint32_t surface_view::plane_height() const { return cm_surface_plane_height(get()); }
inline cm_status surface_view::try_pixel(uint32_t plane, uint32_t column, uint32_t row, uint32_t *picture,
    uint32_t *picture_column, uint32_t *picture_row) const { return cm_surface_pixel(get(), plane, column,
    row, picture, picture_column, picture_row); }
inline void surface_view::pixel(uint32_t plane, uint32_t column, uint32_t row, uint32_t *picture, uint32_t
    *picture_column, uint32_t *picture_row) const { detail::check(cm_surface_pixel(get(), plane, column, row,
    picture, picture_column, picture_row)); }
inline mapping_view surface_view::mapping() const { return mapping_view(cm_surface_mapping(get())); }
inline void surface_view::positions(span<const double> x, span<const double> y, span<const double> z,
    span<uint8_t> plane, span<double> column, span<double> row) const { detail::check(detail::holds(y.size(),
    x.size()) && detail::holds(z.size(), x.size()) && detail::holds(plane.size(), x.size()) &&
    detail::holds(column.size(), x.size()) && detail::holds(row.size(), x.size()) ? CM_OK :
    CM_ERROR_ARGUMENT); cm_surface_positions(get(), x.size(), x.data(), y.data(), z.data(), plane.data(),
    column.data(), row.data()); }
inline void surface_view::directions(span<const uint8_t> plane, span<const double> column, span<const double>
    row, span<double> x, span<double> y, span<double> z) const { detail::check(detail::holds(column.size(),
    plane.size()) && detail::holds(row.size(), plane.size()) && detail::holds(x.size(), plane.size()) &&
    detail::holds(y.size(), plane.size()) && detail::holds(z.size(), plane.size()) ? CM_OK :
    CM_ERROR_ARGUMENT); cm_surface_directions(get(), plane.size(), plane.data(), column.data(), row.data(),
    x.data(), y.data(), z.data()); }
inline cm_status surface_view::try_sample(const cm_image *pictures, cm_filter filter, span<const double> x,
    span<const double> y, span<const double> z, span<float> out) const { return detail::holds(y.size(),
    x.size()) && detail::holds(z.size(), x.size()) && detail::holds(out.size(), x.size(),
    detail::channels(pictures)) ? cm_sample(get(), pictures, filter, x.size(), x.data(), y.data(), z.data(),
    out.data()) : CM_ERROR_ARGUMENT; }
inline void surface_view::sample(const cm_image *pictures, cm_filter filter, span<const double> x, span<const
    double> y, span<const double> z, span<float> out) const { detail::check(detail::holds(y.size(), x.size())
    && detail::holds(z.size(), x.size()) && detail::holds(out.size(), x.size(), detail::channels(pictures)) ?
    cm_sample(get(), pictures, filter, x.size(), x.data(), y.data(), z.data(), out.data()) :
    CM_ERROR_ARGUMENT); }
inline cm_status surface_view::try_border(const cm_image *pictures, uint32_t border, const cm_plan_options
    *options, unsigned threads, cm_image *to) const { return cm_border(get(), pictures, border, options,
    threads, to); }
inline void surface_view::border(const cm_image *pictures, uint32_t border, const cm_plan_options *options,
    unsigned threads, cm_image *to) const { detail::check(cm_border(get(), pictures, border, options, threads,
    to)); }
inline cm_status surface_view::try_panorama_of_surface(cm_panorama *panorama) const { return
    cm_panorama_of_surface(get(), panorama); }
inline void surface_view::panorama_of_surface(cm_panorama *panorama) const {
    detail::check(cm_panorama_of_surface(get(), panorama)); }
inline result<surface> surface::try_make(const char *specification, const cm_surface_options *options) {
    cm_surface *made_object = nullptr; const cm_status status = cm_surface_create(specification, options,
    &made_object); return status == CM_OK ? result<surface>(surface(made_object)) : result<surface>(status); }
inline surface::surface(const char *specification, const cm_surface_options *options) :
    surface(try_make(specification, options).value([&](char *words, std::size_t size) {
    cm_surface_check(specification, options, words, size); })) {}
inline size_t tof_scene_view::count() const { return cm_tof_scene_count(get()); }
inline cm_status tof_scene_view::try_simulate(const cm_tof_sensor &sensor, span<const cm_tof_light> light,
    trajectory_view trajectory, double time, const cm_tof_options *options, pool_view pool, cm_tof_result
    *result) const { return cm_tof_simulate(get(), &sensor, light.data(), light.size(), trajectory.get(),
    time, options, pool.get(), result); }
inline void tof_scene_view::simulate(const cm_tof_sensor &sensor, span<const cm_tof_light> light,
    trajectory_view trajectory, double time, const cm_tof_options *options, pool_view pool, cm_tof_result
    *result) const { detail::check(cm_tof_simulate(get(), &sensor, light.data(), light.size(),
    trajectory.get(), time, options, pool.get(), result)); }
inline cm_status tof_scene_view::try_plan(const cm_tof_sensor &sensor, span<const cm_tof_light> light,
    trajectory_view trajectory, double time, double limit, const cm_tof_options *most, pool_view pool,
    cm_tof_options *chosen, cm_budget *budget) const { return cm_tof_plan(get(), &sensor, light.data(),
    light.size(), trajectory.get(), time, limit, most, pool.get(), chosen, budget); }
inline void tof_scene_view::plan(const cm_tof_sensor &sensor, span<const cm_tof_light> light, trajectory_view
    trajectory, double time, double limit, const cm_tof_options *most, pool_view pool, cm_tof_options *chosen,
    cm_budget *budget) const { detail::check(cm_tof_plan(get(), &sensor, light.data(), light.size(),
    trajectory.get(), time, limit, most, pool.get(), chosen, budget)); }
inline cm_status tof_scene_view::try_find_truth(camera_view camera, trajectory_view trajectory, double time,
    double next, double before, pool_view pool, cm_tof_truth *truth) const { return cm_tof_find_truth(get(),
    camera.get(), trajectory.get(), time, next, before, pool.get(), truth); }
inline void tof_scene_view::find_truth(camera_view camera, trajectory_view trajectory, double time, double
    next, double before, pool_view pool, cm_tof_truth *truth) const { detail::check(cm_tof_find_truth(get(),
    camera.get(), trajectory.get(), time, next, before, pool.get(), truth)); }
inline result<tof_scene> tof_scene::try_make(scene_view scene) { cm_tof_scene *made_object = nullptr; const
    cm_status status = cm_tof_scene_create(scene.get(), &made_object); return status == CM_OK ?
    result<tof_scene>(tof_scene(made_object)) : result<tof_scene>(status); }
inline tof_scene::tof_scene(scene_view scene) : tof_scene(try_make(scene).value()) {}
inline size_t trajectory_view::count() const { return cm_trajectory_count(get()); }
inline cm_status trajectory_view::try_at(size_t index, double *stamp, cm_pose *pose) const { return
    cm_trajectory_at(get(), index, stamp, pose); }
inline void trajectory_view::at(size_t index, double *stamp, cm_pose *pose) const {
    detail::check(cm_trajectory_at(get(), index, stamp, pose)); }
inline cm_status trajectory_view::try_nearest(double time, double apart, size_t *index) const { return
    cm_trajectory_nearest(get(), time, apart, index); }
inline void trajectory_view::nearest(double time, double apart, size_t *index) const {
    detail::check(cm_trajectory_nearest(get(), time, apart, index)); }
inline cm_status trajectory_view::try_interpolate(double time, cm_pose *pose) const { return
    cm_trajectory_interpolate(get(), time, pose); }
inline void trajectory_view::interpolate(double time, cm_pose *pose) const {
    detail::check(cm_trajectory_interpolate(get(), time, pose)); }
inline cm_status trajectory_view::try_associate(trajectory_view b, double apart, span<size_t> index_a,
    span<size_t> index_b, size_t *count) const { return detail::holds(index_b.size(), index_a.size()) ?
    cm_trajectory_associate(get(), b.get(), apart, index_a.size(), index_a.data(), index_b.data(), count) :
    CM_ERROR_ARGUMENT; }
inline void trajectory_view::associate(trajectory_view b, double apart, span<size_t> index_a, span<size_t>
    index_b, size_t *count) const { detail::check(detail::holds(index_b.size(), index_a.size()) ?
    cm_trajectory_associate(get(), b.get(), apart, index_a.size(), index_a.data(), index_b.data(), count) :
    CM_ERROR_ARGUMENT); }
inline cm_status trajectory_view::try_evaluate(trajectory_view estimate, const cm_evaluation_options *options,
    cm_evaluation *evaluation) const { return cm_trajectory_evaluate(get(), estimate.get(), options,
    evaluation); }
inline void trajectory_view::evaluate(trajectory_view estimate, const cm_evaluation_options *options,
    cm_evaluation *evaluation) const { detail::check(cm_trajectory_evaluate(get(), estimate.get(), options,
    evaluation)); }
inline result<trajectory> trajectory::try_make(span<const double> stamp, span<const cm_pose> pose, size_t
    *wrong) { cm_trajectory *made_object = nullptr; const cm_status status = detail::holds(pose.size(),
    stamp.size()) ? cm_trajectory_create(stamp.size(), stamp.data(), pose.data(), &made_object, wrong) :
    CM_ERROR_ARGUMENT; return status == CM_OK ? result<trajectory>(trajectory(made_object)) :
    result<trajectory>(status); }
inline trajectory::trajectory(span<const double> stamp, span<const cm_pose> pose, size_t *wrong) :
    trajectory(try_make(stamp, pose, wrong).value()) {}

// cm_precision_name
inline const char * precision_name(cm_precision precision) { return cm_precision_name(precision); }
// cm_limit_name
inline const char * limit_name(cm_limit limit) { return cm_limit_name(limit); }
// cm_advise_terms
inline cm_status try_advise_terms(const cm_ellipsoid &ellipsoid, cm_latitude from, cm_latitude to, double
    metres, cm_advice_terms *terms) { return cm_advise_terms(&ellipsoid, from, to, metres, terms); }
inline void advise_terms(const cm_ellipsoid &ellipsoid, cm_latitude from, cm_latitude to, double metres,
    cm_advice_terms *terms) { detail::check(cm_advise_terms(&ellipsoid, from, to, metres, terms)); }
// cm_brdf_goniometer
inline void brdf_goniometer(double alpha, double beta, double gamma, cm_brdf_sample *sample) {
    cm_brdf_goniometer(alpha, beta, gamma, sample); }
// cm_budget_limit_error
inline cm_status try_budget_limit_error(cm_budget *budget, double limit) { return
    cm_budget_limit_error(budget, limit); }
inline void budget_limit_error(cm_budget *budget, double limit) { detail::check(cm_budget_limit_error(budget,
    limit)); }
// cm_budget_limit_cost
inline cm_status try_budget_limit_cost(cm_budget *budget, double limit) { return cm_budget_limit_cost(budget,
    limit); }
inline void budget_limit_cost(cm_budget *budget, double limit) { detail::check(cm_budget_limit_cost(budget,
    limit)); }
// cm_budget_sum
inline cm_status try_budget_sum(cm_budget *budget) { return cm_budget_sum(budget); }
inline void budget_sum(cm_budget *budget) { detail::check(cm_budget_sum(budget)); }
// cm_budget_json
inline cm_status try_budget_json(const cm_budget &budget, char *text, size_t size, size_t *length) { return
    cm_budget_json(&budget, text, size, length); }
inline void budget_json(const cm_budget &budget, char *text, size_t size, size_t *length) {
    detail::check(cm_budget_json(&budget, text, size, length)); }
// cm_smoothness_name
inline const char * smoothness_name(cm_smoothness smoothness) { return cm_smoothness_name(smoothness); }
// cm_catalogue_count
inline size_t catalogue_count() { return cm_catalogue_count(); }
// cm_catalogue_at
inline const cm_mapping_info * catalogue_at(size_t index) { return cm_catalogue_at(index); }
// cm_catalogue_find
inline const cm_mapping_info * catalogue_find(const char *name) { return cm_catalogue_find(name); }
// cm_specification_check
inline cm_status try_specification_check(const char *specification, char *message, size_t message_size) {
    return cm_specification_check(specification, message, message_size); }
inline void specification_check(const char *specification, char *message, size_t message_size) {
    detail::check(cm_specification_check(specification, message, message_size)); }
// cm_curve_name
inline const char * curve_name(cm_curve curve) { return cm_curve_name(curve); }
// cm_curve_find
inline cm_status try_curve_find(const char *name, cm_curve *curve) { return cm_curve_find(name, curve); }
inline void curve_find(const char *name, cm_curve *curve) { detail::check(cm_curve_find(name, curve)); }
// cm_cell_is_valid
inline int cell_is_valid(cm_cell cell) { return cm_cell_is_valid(cell); }
// cm_cell_level
inline int cell_level(cm_cell cell) { return cm_cell_level(cell); }
// cm_cell_face
inline uint8_t cell_face(cm_cell cell) { return cm_cell_face(cell); }
// cm_cell_parent
inline cm_cell cell_parent(cm_cell cell, int level) { return cm_cell_parent(cell, level); }
// cm_cell_child
inline cm_cell cell_child(cm_cell cell, int which) { return cm_cell_child(cell, which); }
// cm_cell_first_leaf
inline cm_cell cell_first_leaf(cm_cell cell) { return cm_cell_first_leaf(cell); }
// cm_cell_last_leaf
inline cm_cell cell_last_leaf(cm_cell cell) { return cm_cell_last_leaf(cell); }
// cm_cell_contains
inline int cell_contains(cm_cell cell, cm_cell other) { return cm_cell_contains(cell, other); }
// cm_cell_intersects
inline int cell_intersects(cm_cell cell, cm_cell other) { return cm_cell_intersects(cell, other); }
// cm_cell_common_parent
inline cm_cell cell_common_parent(cm_cell cell, cm_cell other) { return cm_cell_common_parent(cell, other); }
// cm_cell_index
inline uint64_t cell_index(cm_cell cell) { return cm_cell_index(cell); }
// cm_cell_at_index
inline cm_cell cell_at_index(int level, uint64_t index) { return cm_cell_at_index(level, index); }
// cm_cell_advance
inline cm_cell cell_advance(cm_cell cell, int64_t steps) { return cm_cell_advance(cell, steps); }
// cm_cell_from_place
inline cm_cell cell_from_place(cm_curve curve, const cm_cell_place &place) { return cm_cell_from_place(curve,
    &place); }
// cm_cell_to_place
inline cm_status try_cell_to_place(cm_curve curve, cm_cell cell, cm_cell_place *place) { return
    cm_cell_to_place(curve, cell, place); }
inline void cell_to_place(cm_curve curve, cm_cell cell, cm_cell_place *place) {
    detail::check(cm_cell_to_place(curve, cell, place)); }
// cm_cell_square
inline cm_status try_cell_square(cm_curve curve, cm_cell cell, uint8_t *face, double (&low)[2], double
    (&high)[2]) { return cm_cell_square(curve, cell, face, low, high); }
inline void cell_square(cm_curve curve, cm_cell cell, uint8_t *face, double (&low)[2], double (&high)[2]) {
    detail::check(cm_cell_square(curve, cell, face, low, high)); }
// cm_cell_token
inline cm_status try_cell_token(cm_cell cell, char *text, size_t size) { return cm_cell_token(cell, text,
    size); }
inline void cell_token(cm_cell cell, char *text, size_t size) { detail::check(cm_cell_token(cell, text,
    size)); }
// cm_cell_parse
inline cm_status try_cell_parse(const char *text, cm_cell *cell, char *message, size_t message_size) { return
    cm_cell_parse(text, cell, message, message_size); }
inline void cell_parse(const char *text, cm_cell *cell, char *message, size_t message_size) {
    detail::check(cm_cell_parse(text, cell, message, message_size)); }
// cm_cell_union_normalise
inline size_t cell_union_normalise(span<cm_cell> cells) { return cm_cell_union_normalise(cells.size(),
    cells.data()); }
// cm_cell_union_contains
inline int cell_union_contains(span<const cm_cell> cells, cm_cell cell) { return
    cm_cell_union_contains(cells.size(), cells.data(), cell); }
// cm_cell_union_intersects
inline int cell_union_intersects(span<const cm_cell> cells, cm_cell cell) { return
    cm_cell_union_intersects(cells.size(), cells.data(), cell); }
// cm_colormap_count
inline size_t colormap_count() { return cm_colormap_count(); }
// cm_colormap_at
inline const cm_colormap_info * colormap_at(size_t index) { return cm_colormap_at(index); }
// cm_colormap_find
inline const cm_colormap_info * colormap_find(const char *name) { return cm_colormap_find(name); }
// cm_colormap_check
inline cm_status try_colormap_check(const char *specification, char *message, size_t message_size) { return
    cm_colormap_check(specification, message, message_size); }
inline void colormap_check(const char *specification, char *message, size_t message_size) {
    detail::check(cm_colormap_check(specification, message, message_size)); }
// cm_colormap_largest_chroma
inline double colormap_largest_chroma(double lightness, double hue) { return
    cm_colormap_largest_chroma(lightness, hue); }
// cm_colormap_luv_from_lch
inline void colormap_luv_from_lch(const double (&lch)[3], double (&luv)[3]) { cm_colormap_luv_from_lch(lch,
    luv); }
// cm_colormap_lch_from_luv
inline void colormap_lch_from_luv(const double (&luv)[3], double (&lch)[3]) { cm_colormap_lch_from_luv(luv,
    lch); }
// cm_colormap_linear_from_luv
inline void colormap_linear_from_luv(const double (&luv)[3], double (&linear)[3]) {
    cm_colormap_linear_from_luv(luv, linear); }
// cm_colormap_luv_from_linear
inline void colormap_luv_from_linear(const double (&linear)[3], double (&luv)[3]) {
    cm_colormap_luv_from_linear(linear, luv); }
// cm_colormap_srgb_from_linear
inline void colormap_srgb_from_linear(const double (&linear)[3], double (&srgb)[3]) {
    cm_colormap_srgb_from_linear(linear, srgb); }
// cm_colormap_linear_from_srgb
inline void colormap_linear_from_srgb(const double (&srgb)[3], double (&linear)[3]) {
    cm_colormap_linear_from_srgb(srgb, linear); }
// cm_colormap_ucs_from_linear
inline void colormap_ucs_from_linear(const double (&linear)[3], double (&ucs)[3]) {
    cm_colormap_ucs_from_linear(linear, ucs); }
// cm_colormap_linear_from_ucs
inline void colormap_linear_from_ucs(const double (&ucs)[3], double (&linear)[3]) {
    cm_colormap_linear_from_ucs(ucs, linear); }
// cm_colormap_lab_from_linear
inline void colormap_lab_from_linear(const double (&linear)[3], double (&lab)[3]) {
    cm_colormap_lab_from_linear(linear, lab); }
// cm_colormap_ciede2000
inline double colormap_ciede2000(const double (&one)[3], const double (&other)[3]) { return
    cm_colormap_ciede2000(one, other); }
// cm_colormap_cam16
inline void colormap_cam16(const double (&xyz)[3], const cm_colormap_viewing *viewing, cm_colormap_appearance
    *appearance) { cm_colormap_cam16(xyz, viewing, appearance); }
// cm_psnr
inline double psnr(double mse, double peak) { return cm_psnr(mse, peak); }
// cm_compare_errors
inline cm_status try_compare_errors(const cm_image &reference, const cm_image &picture, const
    cm_compare_options *options, cm_error_figures *figures) { return cm_compare_errors(&reference, &picture,
    options, figures); }
inline void compare_errors(const cm_image &reference, const cm_image &picture, const cm_compare_options
    *options, cm_error_figures *figures) { detail::check(cm_compare_errors(&reference, &picture, options,
    figures)); }
// cm_compare_values
inline cm_status try_compare_values(size_t n, uint32_t channels, span<const float> reference, span<const
    float> picture, const cm_compare_options *options, cm_error_figures *figures) { return
    detail::holds(reference.size(), detail::whole(n), detail::whole(channels)) &&
    detail::holds(picture.size(), detail::whole(n), detail::whole(channels)) ? cm_compare_values(n, channels,
    reference.data(), picture.data(), options, figures) : CM_ERROR_ARGUMENT; }
inline void compare_values(size_t n, uint32_t channels, span<const float> reference, span<const float>
    picture, const cm_compare_options *options, cm_error_figures *figures) {
    detail::check(detail::holds(reference.size(), detail::whole(n), detail::whole(channels)) &&
    detail::holds(picture.size(), detail::whole(n), detail::whole(channels)) ? cm_compare_values(n, channels,
    reference.data(), picture.data(), options, figures) : CM_ERROR_ARGUMENT); }
// cm_ssim
inline cm_status try_ssim(const cm_image &reference, const cm_image &picture, const cm_compare_options
    *options, cm_map_figures *figures, const cm_image *map, span<double> channel_means) { return
    (channel_means.data() == nullptr || detail::holds(channel_means.size(), detail::channels(&reference))) ?
    cm_ssim(&reference, &picture, options, figures, map, channel_means.data()) : CM_ERROR_ARGUMENT; }
inline void ssim(const cm_image &reference, const cm_image &picture, const cm_compare_options *options,
    cm_map_figures *figures, const cm_image *map, span<double> channel_means) {
    detail::check((channel_means.data() == nullptr || detail::holds(channel_means.size(),
    detail::channels(&reference))) ? cm_ssim(&reference, &picture, options, figures, map,
    channel_means.data()) : CM_ERROR_ARGUMENT); }
// cm_flip
inline cm_status try_flip(const cm_image &reference, const cm_image &picture, const cm_compare_options
    *options, cm_map_figures *figures, const cm_image *map) { return cm_flip(&reference, &picture, options,
    figures, map); }
inline void flip(const cm_image &reference, const cm_image &picture, const cm_compare_options *options,
    cm_map_figures *figures, const cm_image *map) { detail::check(cm_flip(&reference, &picture, options,
    figures, map)); }
// cm_flip_hdr
inline cm_status try_flip_hdr(const cm_image &reference, const cm_image &picture, const cm_compare_options
    *options, cm_map_figures *figures, const cm_image *map) { return cm_flip_hdr(&reference, &picture,
    options, figures, map); }
inline void flip_hdr(const cm_image &reference, const cm_image &picture, const cm_compare_options *options,
    cm_map_figures *figures, const cm_image *map) { detail::check(cm_flip_hdr(&reference, &picture, options,
    figures, map)); }
// cm_equirect_weights
inline cm_status try_equirect_weights(uint32_t width, span<float> weights) { return cm_equirect_weights(width,
    static_cast<uint32_t>(weights.size()), weights.data()); }
inline void equirect_weights(uint32_t width, span<float> weights) { detail::check(cm_equirect_weights(width,
    static_cast<uint32_t>(weights.size()), weights.data())); }
// cm_sphere_points
inline cm_status try_sphere_points(uint64_t n, uint64_t first, span<double> x, span<double> y, span<double> z)
    { return detail::holds(y.size(), x.size()) && detail::holds(z.size(), x.size()) ? cm_sphere_points(n,
    first, x.size(), x.data(), y.data(), z.data()) : CM_ERROR_ARGUMENT; }
inline void sphere_points(uint64_t n, uint64_t first, span<double> x, span<double> y, span<double> z) {
    detail::check(detail::holds(y.size(), x.size()) && detail::holds(z.size(), x.size()) ? cm_sphere_points(n,
    first, x.size(), x.data(), y.data(), z.data()) : CM_ERROR_ARGUMENT); }
// cm_difference_map
inline cm_status try_difference_map(const cm_image &reference, const cm_image &picture, unsigned threads,
    const cm_image *map) { return cm_difference_map(&reference, &picture, threads, map); }
inline void difference_map(const cm_image &reference, const cm_image &picture, unsigned threads, const
    cm_image *map) { detail::check(cm_difference_map(&reference, &picture, threads, map)); }
// cm_draw_map
inline cm_status try_draw_map(const cm_image &map, double low, double high, cm_map_color color, void *user,
    const cm_image *to, uint64_t *beyond) { return cm_draw_map(&map, low, high, color, user, to, beyond); }
inline void draw_map(const cm_image &map, double low, double high, cm_map_color color, void *user, const
    cm_image *to, uint64_t *beyond) { detail::check(cm_draw_map(&map, low, high, color, user, to, beyond)); }
// cm_compensation_name
inline const char * compensation_name(cm_compensation scheme) { return cm_compensation_name(scheme); }
// cm_compensation_flows
inline cm_status try_compensation_flows(cm_compensation scheme, uint32_t channels, span<cm_flow_pair> pair,
    size_t *count) { return cm_compensation_flows(scheme, channels, pair.size(), pair.data(), count); }
inline void compensation_flows(cm_compensation scheme, uint32_t channels, span<cm_flow_pair> pair, size_t
    *count) { detail::check(cm_compensation_flows(scheme, channels, pair.size(), pair.data(), count)); }
// cm_compensate
inline cm_status try_compensate(const cm_compensation_input &input, cm_compensation scheme, pool_view pool,
    span<float> corrected) { return detail::holds(corrected.size(), detail::whole(input.channels),
    detail::whole(input.width), detail::whole(input.height)) ? cm_compensate(&input, scheme, pool.get(),
    corrected.data()) : CM_ERROR_ARGUMENT; }
inline void compensate(const cm_compensation_input &input, cm_compensation scheme, pool_view pool, span<float>
    corrected) { detail::check(detail::holds(corrected.size(), detail::whole(input.channels),
    detail::whole(input.width), detail::whole(input.height)) ? cm_compensate(&input, scheme, pool.get(),
    corrected.data()) : CM_ERROR_ARGUMENT); }
// cm_flow_warp
inline cm_status try_flow_warp(uint32_t width, uint32_t height, span<const float> picture, span<const float>
    flow, double part, span<float> moved, span<float> coverage) { return detail::holds(picture.size(),
    detail::whole(height), detail::whole(width)) && detail::holds(flow.size(), detail::whole(height),
    detail::whole(width), 2) && detail::holds(moved.size(), detail::whole(height), detail::whole(width)) &&
    (coverage.data() == nullptr || detail::holds(coverage.size(), detail::whole(height),
    detail::whole(width))) ? cm_flow_warp(width, height, picture.data(), flow.data(), part, moved.data(),
    coverage.data()) : CM_ERROR_ARGUMENT; }
inline void flow_warp(uint32_t width, uint32_t height, span<const float> picture, span<const float> flow,
    double part, span<float> moved, span<float> coverage) { detail::check(detail::holds(picture.size(),
    detail::whole(height), detail::whole(width)) && detail::holds(flow.size(), detail::whole(height),
    detail::whole(width), 2) && detail::holds(moved.size(), detail::whole(height), detail::whole(width)) &&
    (coverage.data() == nullptr || detail::holds(coverage.size(), detail::whole(height),
    detail::whole(width))) ? cm_flow_warp(width, height, picture.data(), flow.data(), part, moved.data(),
    coverage.data()) : CM_ERROR_ARGUMENT); }
// cm_compensate_pixelwise
inline cm_status try_compensate_pixelwise(const cm_compensation_input &input, double threshold, span<float>
    corrected, size_t *changed) { return detail::holds(corrected.size(), detail::whole(input.channels),
    detail::whole(input.width), detail::whole(input.height)) ? cm_compensate_pixelwise(&input, threshold,
    corrected.data(), changed) : CM_ERROR_ARGUMENT; }
inline void compensate_pixelwise(const cm_compensation_input &input, double threshold, span<float> corrected,
    size_t *changed) { detail::check(detail::holds(corrected.size(), detail::whole(input.channels),
    detail::whole(input.width), detail::whole(input.height)) ? cm_compensate_pixelwise(&input, threshold,
    corrected.data(), changed) : CM_ERROR_ARGUMENT); }
// cm_channel_gradient
inline cm_status try_channel_gradient(uint32_t width, uint32_t height, span<const float> picture, span<float>
    gradient) { return detail::holds(picture.size(), detail::whole(height), detail::whole(width)) &&
    detail::holds(gradient.size(), detail::whole(height), detail::whole(width)) ? cm_channel_gradient(width,
    height, picture.data(), gradient.data()) : CM_ERROR_ARGUMENT; }
inline void channel_gradient(uint32_t width, uint32_t height, span<const float> picture, span<float> gradient)
    { detail::check(detail::holds(picture.size(), detail::whole(height), detail::whole(width)) &&
    detail::holds(gradient.size(), detail::whole(height), detail::whole(width)) ? cm_channel_gradient(width,
    height, picture.data(), gradient.data()) : CM_ERROR_ARGUMENT); }
// cm_channel_census
inline cm_status try_channel_census(uint32_t width, uint32_t height, span<const float> picture, span<uint8_t>
    census) { return detail::holds(picture.size(), detail::whole(height), detail::whole(width)) &&
    detail::holds(census.size(), detail::whole(height), detail::whole(width)) ? cm_channel_census(width,
    height, picture.data(), census.data()) : CM_ERROR_ARGUMENT; }
inline void channel_census(uint32_t width, uint32_t height, span<const float> picture, span<uint8_t> census) {
    detail::check(detail::holds(picture.size(), detail::whole(height), detail::whole(width)) &&
    detail::holds(census.size(), detail::whole(height), detail::whole(width)) ? cm_channel_census(width,
    height, picture.data(), census.data()) : CM_ERROR_ARGUMENT); }
// cm_channel_normalize
inline cm_status try_channel_normalize(uint32_t width, uint32_t height, span<const float> picture, double
    most, span<float> to) { return detail::holds(picture.size(), detail::whole(height), detail::whole(width))
    && detail::holds(to.size(), detail::whole(height), detail::whole(width)) ? cm_channel_normalize(width,
    height, picture.data(), most, to.data()) : CM_ERROR_ARGUMENT; }
inline void channel_normalize(uint32_t width, uint32_t height, span<const float> picture, double most,
    span<float> to) { detail::check(detail::holds(picture.size(), detail::whole(height), detail::whole(width))
    && detail::holds(to.size(), detail::whole(height), detail::whole(width)) ? cm_channel_normalize(width,
    height, picture.data(), most, to.data()) : CM_ERROR_ARGUMENT); }
// cm_channel_normalize_locally
inline cm_status try_channel_normalize_locally(uint32_t width, uint32_t height, span<const float> picture,
    uint32_t radius, span<float> to) { return detail::holds(picture.size(), detail::whole(height),
    detail::whole(width)) && detail::holds(to.size(), detail::whole(height), detail::whole(width)) ?
    cm_channel_normalize_locally(width, height, picture.data(), radius, to.data()) : CM_ERROR_ARGUMENT; }
inline void channel_normalize_locally(uint32_t width, uint32_t height, span<const float> picture, uint32_t
    radius, span<float> to) { detail::check(detail::holds(picture.size(), detail::whole(height),
    detail::whole(width)) && detail::holds(to.size(), detail::whole(height), detail::whole(width)) ?
    cm_channel_normalize_locally(width, height, picture.data(), radius, to.data()) : CM_ERROR_ARGUMENT); }
// cm_channel_equalize
inline cm_status try_channel_equalize(uint32_t width, uint32_t height, span<const float> picture, uint32_t
    bins, span<float> to) { return detail::holds(picture.size(), detail::whole(height), detail::whole(width))
    && detail::holds(to.size(), detail::whole(height), detail::whole(width)) ? cm_channel_equalize(width,
    height, picture.data(), bins, to.data()) : CM_ERROR_ARGUMENT; }
inline void channel_equalize(uint32_t width, uint32_t height, span<const float> picture, uint32_t bins,
    span<float> to) { detail::check(detail::holds(picture.size(), detail::whole(height), detail::whole(width))
    && detail::holds(to.size(), detail::whole(height), detail::whole(width)) ? cm_channel_equalize(width,
    height, picture.data(), bins, to.data()) : CM_ERROR_ARGUMENT); }
// cm_channel_equalize_locally
inline cm_status try_channel_equalize_locally(uint32_t width, uint32_t height, span<const float> picture,
    uint32_t tiles, double limit, span<float> to) { return detail::holds(picture.size(),
    detail::whole(height), detail::whole(width)) && detail::holds(to.size(), detail::whole(height),
    detail::whole(width)) ? cm_channel_equalize_locally(width, height, picture.data(), tiles, limit,
    to.data()) : CM_ERROR_ARGUMENT; }
inline void channel_equalize_locally(uint32_t width, uint32_t height, span<const float> picture, uint32_t
    tiles, double limit, span<float> to) { detail::check(detail::holds(picture.size(), detail::whole(height),
    detail::whole(width)) && detail::holds(to.size(), detail::whole(height), detail::whole(width)) ?
    cm_channel_equalize_locally(width, height, picture.data(), tiles, limit, to.data()) : CM_ERROR_ARGUMENT);
    }
// cm_cap_radius
inline double cap_radius(const cm_ellipsoid &ellipsoid, double metres) { return cm_cap_radius(&ellipsoid,
    metres); }
// cm_depth_clean
inline cm_status try_depth_clean(const cm_image &picture, const cm_depth_limits *limits, unsigned threads,
    span<float> depth, cm_depth_count *count) { return detail::holds(depth.size(), detail::pixels(picture)) ?
    cm_depth_clean(&picture, limits, threads, depth.data(), count) : CM_ERROR_ARGUMENT; }
inline void depth_clean(const cm_image &picture, const cm_depth_limits *limits, unsigned threads, span<float>
    depth, cm_depth_count *count) { detail::check(detail::holds(depth.size(), detail::pixels(picture)) ?
    cm_depth_clean(&picture, limits, threads, depth.data(), count) : CM_ERROR_ARGUMENT); }
// cm_depth_halve_camera
inline cm_status try_depth_halve_camera(const cm_camera_options &from, cm_camera_options *to) { return
    cm_depth_halve_camera(&from, to); }
inline void depth_halve_camera(const cm_camera_options &from, cm_camera_options *to) {
    detail::check(cm_depth_halve_camera(&from, to)); }
// cm_depth_error_local
inline cm_status try_depth_error_local(span<const float> depth, span<const float> truth, span<float> error) {
    return detail::holds(truth.size(), depth.size()) && detail::holds(error.size(), depth.size()) ?
    cm_depth_error_local(depth.size(), depth.data(), truth.data(), error.data()) : CM_ERROR_ARGUMENT; }
inline void depth_error_local(span<const float> depth, span<const float> truth, span<float> error) {
    detail::check(detail::holds(truth.size(), depth.size()) && detail::holds(error.size(), depth.size()) ?
    cm_depth_error_local(depth.size(), depth.data(), truth.data(), error.data()) : CM_ERROR_ARGUMENT); }
// cm_depth_error_measure
inline cm_status try_depth_error_measure(span<const float> depth, span<const float> truth, cm_depth_error
    *error) { return detail::holds(truth.size(), depth.size()) ? cm_depth_error_measure(depth.size(),
    depth.data(), truth.data(), error) : CM_ERROR_ARGUMENT; }
inline void depth_error_measure(span<const float> depth, span<const float> truth, cm_depth_error *error) {
    detail::check(detail::holds(truth.size(), depth.size()) ? cm_depth_error_measure(depth.size(),
    depth.data(), truth.data(), error) : CM_ERROR_ARGUMENT); }
// cm_depth_error_quantiles
inline cm_status try_depth_error_quantiles(span<const float> depth, span<const float> truth, span<const
    double> fraction, span<double> quantile) { return detail::holds(truth.size(), depth.size()) &&
    detail::holds(quantile.size(), fraction.size()) ? cm_depth_error_quantiles(depth.size(), depth.data(),
    truth.data(), fraction.size(), fraction.data(), quantile.data()) : CM_ERROR_ARGUMENT; }
inline void depth_error_quantiles(span<const float> depth, span<const float> truth, span<const double>
    fraction, span<double> quantile) { detail::check(detail::holds(truth.size(), depth.size()) &&
    detail::holds(quantile.size(), fraction.size()) ? cm_depth_error_quantiles(depth.size(), depth.data(),
    truth.data(), fraction.size(), fraction.data(), quantile.data()) : CM_ERROR_ARGUMENT); }
// cm_depth_error_bad
inline cm_status try_depth_error_bad(span<const float> depth, span<const float> truth, span<const double>
    limit, span<double> ratio) { return detail::holds(truth.size(), depth.size()) &&
    detail::holds(ratio.size(), limit.size()) ? cm_depth_error_bad(depth.size(), depth.data(), truth.data(),
    limit.size(), limit.data(), ratio.data()) : CM_ERROR_ARGUMENT; }
inline void depth_error_bad(span<const float> depth, span<const float> truth, span<const double> limit,
    span<double> ratio) { detail::check(detail::holds(truth.size(), depth.size()) &&
    detail::holds(ratio.size(), limit.size()) ? cm_depth_error_bad(depth.size(), depth.data(), truth.data(),
    limit.size(), limit.data(), ratio.data()) : CM_ERROR_ARGUMENT); }
// cm_depth_error_temporal
inline cm_status try_depth_error_temporal(size_t frames, span<const float> depth, span<float> mean,
    span<float> deviation) { return detail::holds(depth.size(), detail::whole(frames), mean.size()) &&
    (deviation.data() == nullptr || detail::holds(deviation.size(), mean.size())) ?
    cm_depth_error_temporal(frames, mean.size(), depth.data(), mean.data(), deviation.data()) :
    CM_ERROR_ARGUMENT; }
inline void depth_error_temporal(size_t frames, span<const float> depth, span<float> mean, span<float>
    deviation) { detail::check(detail::holds(depth.size(), detail::whole(frames), mean.size()) &&
    (deviation.data() == nullptr || detail::holds(deviation.size(), mean.size())) ?
    cm_depth_error_temporal(frames, mean.size(), depth.data(), mean.data(), deviation.data()) :
    CM_ERROR_ARGUMENT); }
// cm_depth_error_slope
inline cm_status try_depth_error_slope(float *const (&normal)[3], float *const (&truth)[3], span<float> angle)
    { return cm_depth_error_slope(angle.size(), normal, truth, angle.data()); }
inline void depth_error_slope(float *const (&normal)[3], float *const (&truth)[3], span<float> angle) {
    detail::check(cm_depth_error_slope(angle.size(), normal, truth, angle.data())); }
// cm_depth_error_plane
inline cm_status try_depth_error_plane(size_t n, float *const (&point)[3], cm_depth_plane *plane) { return
    cm_depth_error_plane(n, point, plane); }
inline void depth_error_plane(size_t n, float *const (&point)[3], cm_depth_plane *plane) {
    detail::check(cm_depth_error_plane(n, point, plane)); }
// cm_depth_error_edges
inline cm_status try_depth_error_edges(uint32_t width, uint32_t height, span<const float> depth, span<const
    float> truth, double gap, uint32_t reach, cm_depth_edges *edges) { return detail::holds(depth.size(),
    detail::whole(height), detail::whole(width)) && detail::holds(truth.size(), detail::whole(height),
    detail::whole(width)) ? cm_depth_error_edges(width, height, depth.data(), truth.data(), gap, reach, edges)
    : CM_ERROR_ARGUMENT; }
inline void depth_error_edges(uint32_t width, uint32_t height, span<const float> depth, span<const float>
    truth, double gap, uint32_t reach, cm_depth_edges *edges) { detail::check(detail::holds(depth.size(),
    detail::whole(height), detail::whole(width)) && detail::holds(truth.size(), detail::whole(height),
    detail::whole(width)) ? cm_depth_error_edges(width, height, depth.data(), truth.data(), gap, reach, edges)
    : CM_ERROR_ARGUMENT); }
// cm_depth_error_sparsify
inline cm_status try_depth_error_sparsify(span<const float> depth, span<const float> truth, span<const float>
    confidence, cm_sparsification_measure measure, span<const double> fraction, span<double> error,
    span<double> oracle, double *area) { return detail::holds(truth.size(), depth.size()) &&
    detail::holds(confidence.size(), depth.size()) && (error.data() == nullptr || detail::holds(error.size(),
    fraction.size())) && (oracle.data() == nullptr || detail::holds(oracle.size(), fraction.size())) ?
    cm_depth_error_sparsify(depth.size(), depth.data(), truth.data(), confidence.data(), measure,
    fraction.size(), fraction.data(), error.data(), oracle.data(), area) : CM_ERROR_ARGUMENT; }
inline void depth_error_sparsify(span<const float> depth, span<const float> truth, span<const float>
    confidence, cm_sparsification_measure measure, span<const double> fraction, span<double> error,
    span<double> oracle, double *area) { detail::check(detail::holds(truth.size(), depth.size()) &&
    detail::holds(confidence.size(), depth.size()) && (error.data() == nullptr || detail::holds(error.size(),
    fraction.size())) && (oracle.data() == nullptr || detail::holds(oracle.size(), fraction.size())) ?
    cm_depth_error_sparsify(depth.size(), depth.data(), truth.data(), confidence.data(), measure,
    fraction.size(), fraction.data(), error.data(), oracle.data(), area) : CM_ERROR_ARGUMENT); }
// cm_depth_error_checkerboard
inline double depth_error_checkerboard(double distance, double spacing, double focal_length, double
    corner_error) { return cm_depth_error_checkerboard(distance, spacing, focal_length, corner_error); }
// cm_direction_from_lonlat
inline void direction_from_lonlat(double lon, double lat, double (&direction)[3]) {
    cm_direction_from_lonlat(lon, lat, direction); }
// cm_lonlat_from_direction
inline void lonlat_from_direction(const double (&direction)[3], double (&lonlat)[2]) {
    cm_lonlat_from_direction(direction, lonlat); }
// cm_direction_from_lonlat_array
inline void direction_from_lonlat(span<const double> lon, span<const double> lat, span<double> x, span<double>
    y, span<double> z) { detail::check(detail::holds(lat.size(), lon.size()) && detail::holds(x.size(),
    lon.size()) && detail::holds(y.size(), lon.size()) && detail::holds(z.size(), lon.size()) ? CM_OK :
    CM_ERROR_ARGUMENT); cm_direction_from_lonlat_array(lon.size(), lon.data(), lat.data(), x.data(), y.data(),
    z.data()); }
// cm_lonlat_from_direction_array
inline void lonlat_from_direction(span<const double> x, span<const double> y, span<const double> z,
    span<double> lon, span<double> lat) { detail::check(detail::holds(y.size(), x.size()) &&
    detail::holds(z.size(), x.size()) && detail::holds(lon.size(), x.size()) && detail::holds(lat.size(),
    x.size()) ? CM_OK : CM_ERROR_ARGUMENT); cm_lonlat_from_direction_array(x.size(), x.data(), y.data(),
    z.data(), lon.data(), lat.data()); }
// cm_ellipsoid_count
inline size_t ellipsoid_count() { return cm_ellipsoid_count(); }
// cm_ellipsoid_at
inline const cm_ellipsoid * ellipsoid_at(size_t index) { return cm_ellipsoid_at(index); }
// cm_ellipsoid_find
inline const cm_ellipsoid * ellipsoid_find(const char *identifier) { return cm_ellipsoid_find(identifier); }
// cm_ellipsoid_parse
inline cm_status try_ellipsoid_parse(const char *text, cm_ellipsoid *ellipsoid, char *message, size_t
    message_size) { return cm_ellipsoid_parse(text, ellipsoid, message, message_size); }
inline void ellipsoid_parse(const char *text, cm_ellipsoid *ellipsoid, char *message, size_t message_size) {
    detail::check(cm_ellipsoid_parse(text, ellipsoid, message, message_size)); }
// cm_ellipsoid_check
inline cm_status try_ellipsoid_check(const cm_ellipsoid &ellipsoid) { return cm_ellipsoid_check(&ellipsoid); }
inline void ellipsoid_check(const cm_ellipsoid &ellipsoid) { detail::check(cm_ellipsoid_check(&ellipsoid)); }
// cm_ellipsoid_area
inline double ellipsoid_area(const cm_ellipsoid &ellipsoid) { return cm_ellipsoid_area(&ellipsoid); }
// cm_ellipsoid_authalic_radius
inline double ellipsoid_authalic_radius(const cm_ellipsoid &ellipsoid) { return
    cm_ellipsoid_authalic_radius(&ellipsoid); }
// cm_harmonics_count
inline size_t harmonics_count(uint32_t degree) { return cm_harmonics_count(degree); }
// cm_harmonics_basis
inline cm_status try_harmonics_basis(uint32_t degree, span<const double> x, span<const double> y, span<const
    double> z, span<double> value) { return detail::holds(y.size(), x.size()) && detail::holds(z.size(),
    x.size()) && detail::holds(value.size(), x.size(), detail::whole(degree) + 1, detail::whole(degree) + 1) ?
    cm_harmonics_basis(degree, x.size(), x.data(), y.data(), z.data(), value.data()) : CM_ERROR_ARGUMENT; }
inline void harmonics_basis(uint32_t degree, span<const double> x, span<const double> y, span<const double> z,
    span<double> value) { detail::check(detail::holds(y.size(), x.size()) && detail::holds(z.size(), x.size())
    && detail::holds(value.size(), x.size(), detail::whole(degree) + 1, detail::whole(degree) + 1) ?
    cm_harmonics_basis(degree, x.size(), x.data(), y.data(), z.data(), value.data()) : CM_ERROR_ARGUMENT); }
// cm_harmonics_evaluate
inline cm_status try_harmonics_evaluate(uint32_t degree, uint32_t channels, span<const double> coefficients,
    span<const double> x, span<const double> y, span<const double> z, span<double> value) { return
    detail::holds(coefficients.size(), detail::whole(degree) + 1, detail::whole(degree) + 1,
    detail::whole(channels)) && detail::holds(y.size(), x.size()) && detail::holds(z.size(), x.size()) &&
    detail::holds(value.size(), x.size(), detail::whole(channels)) ? cm_harmonics_evaluate(degree, channels,
    coefficients.data(), x.size(), x.data(), y.data(), z.data(), value.data()) : CM_ERROR_ARGUMENT; }
inline void harmonics_evaluate(uint32_t degree, uint32_t channels, span<const double> coefficients, span<const
    double> x, span<const double> y, span<const double> z, span<double> value) {
    detail::check(detail::holds(coefficients.size(), detail::whole(degree) + 1, detail::whole(degree) + 1,
    detail::whole(channels)) && detail::holds(y.size(), x.size()) && detail::holds(z.size(), x.size()) &&
    detail::holds(value.size(), x.size(), detail::whole(channels)) ? cm_harmonics_evaluate(degree, channels,
    coefficients.data(), x.size(), x.data(), y.data(), z.data(), value.data()) : CM_ERROR_ARGUMENT); }
// cm_harmonics_cosine_lobe
inline cm_status try_harmonics_cosine_lobe(uint32_t degree, span<double> factor) { return
    detail::holds(factor.size(), detail::whole(degree) + 1) ? cm_harmonics_cosine_lobe(degree, factor.data())
    : CM_ERROR_ARGUMENT; }
inline void harmonics_cosine_lobe(uint32_t degree, span<double> factor) {
    detail::check(detail::holds(factor.size(), detail::whole(degree) + 1) ? cm_harmonics_cosine_lobe(degree,
    factor.data()) : CM_ERROR_ARGUMENT); }
// cm_harmonics_ggx_lobe
inline cm_status try_harmonics_ggx_lobe(uint32_t degree, double roughness, span<double> factor) { return
    detail::holds(factor.size(), detail::whole(degree) + 1) ? cm_harmonics_ggx_lobe(degree, roughness,
    factor.data()) : CM_ERROR_ARGUMENT; }
inline void harmonics_ggx_lobe(uint32_t degree, double roughness, span<double> factor) {
    detail::check(detail::holds(factor.size(), detail::whole(degree) + 1) ? cm_harmonics_ggx_lobe(degree,
    roughness, factor.data()) : CM_ERROR_ARGUMENT); }
// cm_harmonics_window_factors
inline cm_status try_harmonics_window_factors(cm_harmonics_window window, double width, uint32_t degree,
    span<double> factor) { return detail::holds(factor.size(), detail::whole(degree) + 1) ?
    cm_harmonics_window_factors(window, width, degree, factor.data()) : CM_ERROR_ARGUMENT; }
inline void harmonics_window_factors(cm_harmonics_window window, double width, uint32_t degree, span<double>
    factor) { detail::check(detail::holds(factor.size(), detail::whole(degree) + 1) ?
    cm_harmonics_window_factors(window, width, degree, factor.data()) : CM_ERROR_ARGUMENT); }
// cm_harmonics_scale
inline cm_status try_harmonics_scale(uint32_t degree, uint32_t channels, span<const double> factor,
    span<double> coefficients) { return detail::holds(factor.size(), detail::whole(degree) + 1) &&
    detail::holds(coefficients.size(), detail::whole(degree) + 1, detail::whole(degree) + 1,
    detail::whole(channels)) ? cm_harmonics_scale(degree, channels, factor.data(), coefficients.data()) :
    CM_ERROR_ARGUMENT; }
inline void harmonics_scale(uint32_t degree, uint32_t channels, span<const double> factor, span<double>
    coefficients) { detail::check(detail::holds(factor.size(), detail::whole(degree) + 1) &&
    detail::holds(coefficients.size(), detail::whole(degree) + 1, detail::whole(degree) + 1,
    detail::whole(channels)) ? cm_harmonics_scale(degree, channels, factor.data(), coefficients.data()) :
    CM_ERROR_ARGUMENT); }
// cm_harmonics_rotate
inline cm_status try_harmonics_rotate(uint32_t degree, uint32_t channels, const cm_rotation &rotation,
    span<const double> from, span<double> to) { return detail::holds(from.size(), detail::whole(degree) + 1,
    detail::whole(degree) + 1, detail::whole(channels)) && detail::holds(to.size(), detail::whole(degree) + 1,
    detail::whole(degree) + 1, detail::whole(channels)) ? cm_harmonics_rotate(degree, channels, &rotation,
    from.data(), to.data()) : CM_ERROR_ARGUMENT; }
inline void harmonics_rotate(uint32_t degree, uint32_t channels, const cm_rotation &rotation, span<const
    double> from, span<double> to) { detail::check(detail::holds(from.size(), detail::whole(degree) + 1,
    detail::whole(degree) + 1, detail::whole(channels)) && detail::holds(to.size(), detail::whole(degree) + 1,
    detail::whole(degree) + 1, detail::whole(channels)) ? cm_harmonics_rotate(degree, channels, &rotation,
    from.data(), to.data()) : CM_ERROR_ARGUMENT); }
// cm_harmonics_json
inline cm_status try_harmonics_json(uint32_t degree, uint32_t channels, span<const double> coefficients, char
    *text, size_t size, size_t *length) { return detail::holds(coefficients.size(), detail::whole(degree) + 1,
    detail::whole(degree) + 1, detail::whole(channels)) ? cm_harmonics_json(degree, channels,
    coefficients.data(), text, size, length) : CM_ERROR_ARGUMENT; }
inline void harmonics_json(uint32_t degree, uint32_t channels, span<const double> coefficients, char *text,
    size_t size, size_t *length) { detail::check(detail::holds(coefficients.size(), detail::whole(degree) + 1,
    detail::whole(degree) + 1, detail::whole(channels)) ? cm_harmonics_json(degree, channels,
    coefficients.data(), text, size, length) : CM_ERROR_ARGUMENT); }
// cm_harmonics_faces
inline cm_status try_harmonics_faces(uint32_t degree, uint32_t channels, span<const double> coefficients,
    mapping_view mapping, unsigned threads, const cm_image (&to)[6]) { return
    detail::holds(coefficients.size(), detail::whole(degree) + 1, detail::whole(degree) + 1,
    detail::whole(channels)) ? cm_harmonics_faces(degree, channels, coefficients.data(), mapping.get(),
    threads, to) : CM_ERROR_ARGUMENT; }
inline void harmonics_faces(uint32_t degree, uint32_t channels, span<const double> coefficients, mapping_view
    mapping, unsigned threads, const cm_image (&to)[6]) { detail::check(detail::holds(coefficients.size(),
    detail::whole(degree) + 1, detail::whole(degree) + 1, detail::whole(channels)) ?
    cm_harmonics_faces(degree, channels, coefficients.data(), mapping.get(), threads, to) :
    CM_ERROR_ARGUMENT); }
// cm_brdf_integrate
inline cm_status try_brdf_integrate(cm_brdf_shadowing shadowing, double cosine, double roughness,
    cm_brdf_terms *terms) { return cm_brdf_integrate(shadowing, cosine, roughness, terms); }
inline void brdf_integrate(cm_brdf_shadowing shadowing, double cosine, double roughness, cm_brdf_terms *terms)
    { detail::check(cm_brdf_integrate(shadowing, cosine, roughness, terms)); }
// cm_brdf_table
inline cm_status try_brdf_table(cm_brdf_shadowing shadowing, unsigned threads, const cm_image *to) { return
    cm_brdf_table(shadowing, threads, to); }
inline void brdf_table(cm_brdf_shadowing shadowing, unsigned threads, const cm_image *to) {
    detail::check(cm_brdf_table(shadowing, threads, to)); }
// cm_brdf_multiple
inline double brdf_multiple(const cm_brdf_terms &terms, double f0) { return cm_brdf_multiple(&terms, f0); }
// cm_frame_count
inline size_t frame_count() { return cm_frame_count(); }
// cm_frame_at
inline const cm_frame * frame_at(size_t index) { return cm_frame_at(index); }
// cm_frame_find
inline const cm_frame * frame_find(const char *identifier) { return cm_frame_find(identifier); }
// cm_frame_check
inline cm_status try_frame_check(const cm_frame *frame = nullptr) { return cm_frame_check(frame); }
inline void frame_check(const cm_frame *frame = nullptr) { detail::check(cm_frame_check(frame)); }
// cm_healpix_check
inline cm_status try_healpix_check(int64_t nside, cm_healpix_order order, char *message, size_t message_size)
    { return cm_healpix_check(nside, order, message, message_size); }
inline void healpix_check(int64_t nside, cm_healpix_order order, char *message, size_t message_size) {
    detail::check(cm_healpix_check(nside, order, message, message_size)); }
// cm_pixel_size
inline size_t pixel_size(cm_pixel_type type) { return cm_pixel_size(type); }
// cm_surface_check
inline cm_status try_surface_check(const char *specification, const cm_surface_options *options, char
    *message, size_t message_size) { return cm_surface_check(specification, options, message, message_size); }
inline void surface_check(const char *specification, const cm_surface_options *options, char *message, size_t
    message_size) { detail::check(cm_surface_check(specification, options, message, message_size)); }
// cm_surface_kind_count
inline size_t surface_kind_count() { return cm_surface_kind_count(); }
// cm_surface_kind_at
inline const cm_surface_kind * surface_kind_at(size_t index) { return cm_surface_kind_at(index); }
// cm_surface_preset_count
inline size_t surface_preset_count() { return cm_surface_preset_count(); }
// cm_surface_preset_at
inline const cm_surface_preset * surface_preset_at(size_t index) { return cm_surface_preset_at(index); }
// cm_surface_preset_find
inline const cm_surface_preset * surface_preset_find(const char *identifier) { return
    cm_surface_preset_find(identifier); }
// cm_healpix_arrange
inline cm_status try_healpix_arrange(int64_t nside, cm_healpix_order order, int to_list, size_t pixel_size,
    const void *from, void *to) { return cm_healpix_arrange(nside, order, to_list, pixel_size, from, to); }
inline void healpix_arrange(int64_t nside, cm_healpix_order order, int to_list, size_t pixel_size, const void
    *from, void *to) { detail::check(cm_healpix_arrange(nside, order, to_list, pixel_size, from, to)); }
// cm_filter_name
inline const char * filter_name(cm_filter filter) { return cm_filter_name(filter); }
// cm_latitude_name
inline const char * latitude_name(cm_latitude latitude) { return cm_latitude_name(latitude); }
// cm_latitude_find
inline cm_status try_latitude_find(const char *name, cm_latitude *latitude) { return cm_latitude_find(name,
    latitude); }
inline void latitude_find(const char *name, cm_latitude *latitude) { detail::check(cm_latitude_find(name,
    latitude)); }
// cm_number_read
inline size_t number_read(span<const char> text, double *value) { return cm_number_read(text.data(),
    text.size(), value); }
// cm_number_parse
inline int number_parse(span<const char> text, double *value) { return cm_number_parse(text.data(),
    text.size(), value); }
// cm_number_write
inline size_t number_write(double value, int digits, char (&text)[32]) { return cm_number_write(value, digits,
    text); }
// cm_number_write_shortest
inline size_t number_write_shortest(double value, char (&text)[32]) { return cm_number_write_shortest(value,
    text); }
// cm_instructions_count
inline size_t instructions_count() { return cm_instructions_count(); }
// cm_instructions_at
inline const char * instructions_at(size_t index) { return cm_instructions_at(index); }
// cm_instructions_check
inline cm_status try_instructions_check(const char *name, char *message, size_t message_size) { return
    cm_instructions_check(name, message, message_size); }
inline void instructions_check(const char *name, char *message, size_t message_size) {
    detail::check(cm_instructions_check(name, message, message_size)); }
// cm_orient_measure_name
inline const char * orient_measure_name(size_t index) { return cm_orient_measure_name(index); }
// cm_orient_measure_find
inline int orient_measure_find(const char *name) { return cm_orient_measure_find(name); }
// cm_rotation_from_angles
inline cm_status try_rotation_from_angles(double lon, double lat, double roll, cm_rotation *rotation) { return
    cm_rotation_from_angles(lon, lat, roll, rotation); }
inline void rotation_from_angles(double lon, double lat, double roll, cm_rotation *rotation) {
    detail::check(cm_rotation_from_angles(lon, lat, roll, rotation)); }
// cm_rotation_angles
inline cm_status try_rotation_angles(const cm_rotation &rotation, double *lon, double *lat, double *roll) {
    return cm_rotation_angles(&rotation, lon, lat, roll); }
inline void rotation_angles(const cm_rotation &rotation, double *lon, double *lat, double *roll) {
    detail::check(cm_rotation_angles(&rotation, lon, lat, roll)); }
// cm_rotation_check
inline cm_status try_rotation_check(const cm_rotation &rotation) { return cm_rotation_check(&rotation); }
inline void rotation_check(const cm_rotation &rotation) { detail::check(cm_rotation_check(&rotation)); }
// cm_rotate
inline void rotate(const cm_rotation &rotation, const double (&from)[3], double (&to)[3]) {
    cm_rotate(&rotation, from, to); }
// cm_rotate_back
inline void rotate_back(const cm_rotation &rotation, const double (&from)[3], double (&to)[3]) {
    cm_rotate_back(&rotation, from, to); }
// cm_rotation_parse
inline cm_status try_rotation_parse(const char *text, cm_rotation *rotation, char *message, size_t
    message_size) { return cm_rotation_parse(text, rotation, message, message_size); }
inline void rotation_parse(const char *text, cm_rotation *rotation, char *message, size_t message_size) {
    detail::check(cm_rotation_parse(text, rotation, message, message_size)); }
// cm_orientation_count
inline size_t orientation_count() { return cm_orientation_count(); }
// cm_orientation_at
inline const cm_orientation * orientation_at(size_t index) { return cm_orientation_at(index); }
// cm_orientation_find
inline const cm_orientation * orientation_find(const char *identifier) { return
    cm_orientation_find(identifier); }
// cm_panorama_check
inline cm_status try_panorama_check(const cm_panorama &panorama) { return cm_panorama_check(&panorama); }
inline void panorama_check(const cm_panorama &panorama) { detail::check(cm_panorama_check(&panorama)); }
// cm_panorama_read
inline cm_status try_panorama_read(span<const char> text, cm_panorama *panorama) { return
    cm_panorama_read(text.data(), text.size(), panorama); }
inline void panorama_read(span<const char> text, cm_panorama *panorama) {
    detail::check(cm_panorama_read(text.data(), text.size(), panorama)); }
// cm_panorama_write
inline cm_status try_panorama_write(const cm_panorama &panorama, char *text, size_t size) { return
    cm_panorama_write(&panorama, text, size); }
inline void panorama_write(const cm_panorama &panorama, char *text, size_t size) {
    detail::check(cm_panorama_write(&panorama, text, size)); }
// cm_panorama_surface
inline cm_status try_panorama_surface(const cm_panorama &panorama, uint32_t width, uint32_t height, char
    *specification, size_t size, cm_rotation *rotation) { return cm_panorama_surface(&panorama, width, height,
    specification, size, rotation); }
inline void panorama_surface(const cm_panorama &panorama, uint32_t width, uint32_t height, char
    *specification, size_t size, cm_rotation *rotation) { detail::check(cm_panorama_surface(&panorama, width,
    height, specification, size, rotation)); }
// cm_pose_check
inline cm_status try_pose_check(const cm_pose &pose) { return cm_pose_check(&pose); }
inline void pose_check(const cm_pose &pose) { detail::check(cm_pose_check(&pose)); }
// cm_pose_apply
inline void pose_apply(const cm_pose &pose, const double (&world)[3], double (&camera)[3]) {
    cm_pose_apply(&pose, world, camera); }
// cm_pose_apply_back
inline void pose_apply_back(const cm_pose &pose, const double (&camera)[3], double (&world)[3]) {
    cm_pose_apply_back(&pose, camera, world); }
// cm_pose_compose
inline void pose_compose(const cm_pose &outer, const cm_pose &inner, cm_pose *product) {
    cm_pose_compose(&outer, &inner, product); }
// cm_pose_invert
inline void pose_invert(const cm_pose &pose, cm_pose *inverse) { cm_pose_invert(&pose, inverse); }
// cm_pose_between
inline void pose_between(const cm_pose &from, const cm_pose &to, cm_pose *between) { cm_pose_between(&from,
    &to, between); }
// cm_pose_exp
inline void pose_exp(const double (&twist)[6], cm_pose *pose) { cm_pose_exp(twist, pose); }
// cm_pose_log
inline void pose_log(const cm_pose &pose, double (&twist)[6]) { cm_pose_log(&pose, twist); }
// cm_pose_angle
inline double pose_angle(const cm_pose &pose) { return cm_pose_angle(&pose); }
// cm_pose_interpolate
inline void pose_interpolate(const cm_pose &from, const cm_pose &to, double t, cm_pose *pose) {
    cm_pose_interpolate(&from, &to, t, pose); }
// cm_pose_adjoint
inline void pose_adjoint(const cm_pose &pose, double (&adjoint)[36]) { cm_pose_adjoint(&pose, adjoint); }
// cm_pose_transport
inline void pose_transport(const cm_pose &pose, const double (&covariance)[36], double (&transported)[36]) {
    cm_pose_transport(&pose, covariance, transported); }
// cm_pose_quaternion
inline void pose_quaternion(const cm_pose &pose, double (&quaternion)[4]) { cm_pose_quaternion(&pose,
    quaternion); }
// cm_pose_from_quaternion
inline cm_status try_pose_from_quaternion(const double (&position)[3], const double (&quaternion)[4], cm_pose
    *pose) { return cm_pose_from_quaternion(position, quaternion, pose); }
inline void pose_from_quaternion(const double (&position)[3], const double (&quaternion)[4], cm_pose *pose) {
    detail::check(cm_pose_from_quaternion(position, quaternion, pose)); }
// cm_random_block
inline void random_block(uint64_t seed, uint32_t view, uint32_t pixel, uint32_t sample, uint32_t block,
    uint32_t (&words)[4]) { cm_random_block(seed, view, pixel, sample, block, words); }
// cm_random_uniform
inline double random_uniform(uint64_t seed, uint32_t view, uint32_t pixel, uint32_t sample) { return
    cm_random_uniform(seed, view, pixel, sample); }
// cm_random_normal
inline double random_normal(uint64_t seed, uint32_t view, uint32_t pixel, uint32_t sample) { return
    cm_random_normal(seed, view, pixel, sample); }
// cm_random_poisson
inline double random_poisson(uint64_t seed, uint32_t view, uint32_t pixel, uint32_t sample, double mean) {
    return cm_random_poisson(seed, view, pixel, sample, mean); }
// cm_random_uniform_array
inline void random_uniform(uint64_t seed, uint32_t view, uint32_t first, uint32_t sample, span<double> value)
    { cm_random_uniform_array(seed, view, first, sample, value.size(), value.data()); }
// cm_random_normal_array
inline void random_normal(uint64_t seed, uint32_t view, uint32_t first, uint32_t sample, span<double> value) {
    cm_random_normal_array(seed, view, first, sample, value.size(), value.data()); }
// cm_random_poisson_array
inline void random_poisson(uint64_t seed, uint32_t view, uint32_t first, uint32_t sample, span<const double>
    mean, span<double> count) { detail::check(detail::holds(count.size(), mean.size()) ? CM_OK :
    CM_ERROR_ARGUMENT); cm_random_poisson_array(seed, view, first, sample, mean.size(), mean.data(),
    count.data()); }
// cm_tof_frame_time
inline double tof_frame_time(const cm_tof_sensor &sensor) { return cm_tof_frame_time(&sensor); }
// cm_tof_reconstruct
inline cm_status try_tof_reconstruct(const cm_tof_sensor &sensor, span<const float> charge_a, span<const
    float> charge_b, span<float> distance, span<float> amplitude, span<float> intensity, span<uint8_t> flags)
    { return detail::holds(charge_a.size(), detail::phase_images(sensor), distance.size()) &&
    detail::holds(charge_b.size(), detail::phase_images(sensor), distance.size()) &&
    detail::holds(amplitude.size(), distance.size()) && detail::holds(intensity.size(), distance.size()) &&
    detail::holds(flags.size(), distance.size()) ? cm_tof_reconstruct(&sensor, distance.size(),
    charge_a.data(), charge_b.data(), distance.data(), amplitude.data(), intensity.data(), flags.data()) :
    CM_ERROR_ARGUMENT; }
inline void tof_reconstruct(const cm_tof_sensor &sensor, span<const float> charge_a, span<const float>
    charge_b, span<float> distance, span<float> amplitude, span<float> intensity, span<uint8_t> flags) {
    detail::check(detail::holds(charge_a.size(), detail::phase_images(sensor), distance.size()) &&
    detail::holds(charge_b.size(), detail::phase_images(sensor), distance.size()) &&
    detail::holds(amplitude.size(), distance.size()) && detail::holds(intensity.size(), distance.size()) &&
    detail::holds(flags.size(), distance.size()) ? cm_tof_reconstruct(&sensor, distance.size(),
    charge_a.data(), charge_b.data(), distance.data(), amplitude.data(), intensity.data(), flags.data()) :
    CM_ERROR_ARGUMENT); }
// cm_tof_noise_of_distance
inline double tof_noise_of_distance(const cm_tof_sensor &sensor, double signal, double ambient) { return
    cm_tof_noise_of_distance(&sensor, signal, ambient); }
// cm_quantity_name
inline const char * quantity_name(size_t index) { return cm_quantity_name(index); }
// cm_quantity_find
inline int quantity_find(const char *name) { return cm_quantity_find(name); }
// cm_status_text
inline const char * status_text(cm_status status) { return cm_status_text(status); }
// cm_blob_clear
inline void blob_clear(cm_blob *blob) { cm_blob_clear(blob); }
// cm_texel_linearise
inline cm_status try_texel_linearise(double near, double far, span<const float> z_buffer, span<float> depth) {
    return detail::holds(depth.size(), z_buffer.size()) ? cm_texel_linearise(near, far, z_buffer.size(),
    z_buffer.data(), depth.data()) : CM_ERROR_ARGUMENT; }
inline void texel_linearise(double near, double far, span<const float> z_buffer, span<float> depth) {
    detail::check(detail::holds(depth.size(), z_buffer.size()) ? cm_texel_linearise(near, far,
    z_buffer.size(), z_buffer.data(), depth.data()) : CM_ERROR_ARGUMENT); }
// cm_texel_complete
inline cm_status try_texel_complete(cm_texel_options *options) { return cm_texel_complete(options); }
inline void texel_complete(cm_texel_options *options) { detail::check(cm_texel_complete(options)); }
// cm_texel_places
inline cm_status try_texel_places(const cm_texel_options &options, double *column, double *row, double *x,
    double *y) { return cm_texel_places(&options, column, row, x, y); }
inline void texel_places(const cm_texel_options &options, double *column, double *row, double *x, double *y) {
    detail::check(cm_texel_places(&options, column, row, x, y)); }
// cm_texel_sample
inline cm_status try_texel_sample(const cm_texel_options &options, const float *canvas, float *depth) { return
    cm_texel_sample(&options, canvas, depth); }
inline void texel_sample(const cm_texel_options &options, const float *canvas, float *depth) {
    detail::check(cm_texel_sample(&options, canvas, depth)); }
// cm_texel_points
inline cm_status try_texel_points(const cm_texel_options &options, const float *depth, const cm_texel_image
    &image) { return cm_texel_points(&options, depth, &image); }
inline void texel_points(const cm_texel_options &options, const float *depth, const cm_texel_image &image) {
    detail::check(cm_texel_points(&options, depth, &image)); }
// cm_texel_matrix
inline cm_status try_texel_matrix(const cm_pose &base, const cm_pose &scan, double unit, double (&matrix)[16])
    { return cm_texel_matrix(&base, &scan, unit, matrix); }
inline void texel_matrix(const cm_pose &base, const cm_pose &scan, double unit, double (&matrix)[16]) {
    detail::check(cm_texel_matrix(&base, &scan, unit, matrix)); }
// cm_threads_available
inline unsigned threads_available() { return cm_threads_available(); }
// cm_run_threads
inline void run_threads(unsigned threads, size_t n, size_t least, cm_job job, void *user) {
    cm_run_threads(threads, n, least, job, user); }
// cm_pose_align
inline cm_status try_pose_align(size_t n, span<const double> from, span<const double> to, cm_pose *motion, int
    *rank, int *is_determined) { return detail::holds(from.size(), detail::whole(n), 3) &&
    detail::holds(to.size(), detail::whole(n), 3) ? cm_pose_align(n, from.data(), to.data(), motion, rank,
    is_determined) : CM_ERROR_ARGUMENT; }
inline void pose_align(size_t n, span<const double> from, span<const double> to, cm_pose *motion, int *rank,
    int *is_determined) { detail::check(detail::holds(from.size(), detail::whole(n), 3) &&
    detail::holds(to.size(), detail::whole(n), 3) ? cm_pose_align(n, from.data(), to.data(), motion, rank,
    is_determined) : CM_ERROR_ARGUMENT); }
// cm_version
inline const char * version() { return cm_version(); }
// cm_scene_name_at
inline const char * scene_name_at(size_t index) { return cm_scene_name_at(index); }

} // namespace cubemap

#endif
