// SPDX-License-Identifier: MIT
//
// Rows of the output: where bands of them end, computing and keeping them, and writing pictures in bands.

#include "reproject_output.hpp"
#include "tools/image/geo_reference.hpp"
#include "tools/cli/image_file.hpp"
#include "tools/cli/parallel.hpp"

#include <algorithm>
#include <cstring>

namespace
{

// Rows of blocks, which the library computes together.
constexpr int block_rows = 16;
// Rows are computed, then written, in bands. All bands at a time together have about so many bytes, two for each picture.
constexpr std::size_t bands_bytes = std::size_t{12} << 20;
// A picture is so many bands at least, so that the first are written early, where threads have enough to do then.
constexpr int bands_least = 8;
constexpr int rows_each = 4 * block_rows;
// With a source in files, parts of a band of so many rows and columns are computed one after another: what they read is a
// small part of the source, which then stays in memory, and the system maps some pages beside each that is asked for.
constexpr std::uint32_t tile_edge = 1024;
// Squares of them are computed between two looks at how many pages there are. A line of such a square may lie on as many rows
// of the source, of each of which the system maps so many bytes around what is read: near a pole on more.
constexpr std::uint32_t look_edge = 128;
constexpr std::size_t bytes_around = std::size_t{64} << 10;
// Then larger bands are quicker: all at a time together a part of the ceiling, and one at most so many bytes.
constexpr std::uint64_t ceiling_parts = 16;
constexpr std::size_t band_most = std::size_t{32} << 20;
// For how many threads bands are where rows are kept for another run.
constexpr int kept_threads = 4;
// The library keeps a spline's coefficients that are no larger.
constexpr std::uint64_t kept_coefficients = std::uint64_t{32} << 20;

} // namespace

std::size_t Output::row_bytes() const
{
    return cm_surface_width(surface) * static_cast<std::size_t>(channels) * channel_bytes(row_type);
}

// Where bands end: at rows of blocks of the planes, as far as those stand at the same ones.
std::vector<int> Output::band_ends(std::size_t index, std::size_t most_bytes, int threads) const
{
    const int height = static_cast<int>(cm_surface_height(surface));
    const int fitting = static_cast<int>(std::min<std::size_t>(most_bytes / row_bytes(), 1u << 20));
    const int wanted = std::max(threads * rows_each, height / bands_least);
    const int step = std::max(std::min(fitting, wanted) / block_rows, 1) * block_rows;
    std::vector<int> stops = {height};
    for (const PlanePlace &place : places)
    {
        // rows of planes are drawn whole
        if (place.picture == index && place.exchanged() && lines)
        {
            return {height};
        }
        if (place.picture == index)
        {
            stops.push_back(place.first_row());
            stops.push_back(place.end_row());
        }
    }
    std::sort(stops.begin(), stops.end());
    std::vector<int> ends;
    int first = 0;
    for (const int stop : stops)
    {
        for (; first < stop; first = ends.back())
        {
            ends.push_back(std::min(first + step, stop));
        }
    }
    return ends;
}

// What is computed last stays: pages are given back when there are too many.
void Output::compute_tile(const Render &render, const cm_rows &tile,
                          std::vector<cm_image> &pictures, int threads)
{
    for (std::uint32_t down = 0; down < tile.row_count; down += look_edge)
    {
        for (std::uint32_t across = 0; across < tile.column_count; across += look_edge)
        {
            const cm_rows part = {
                tile.plane, tile.first_row + down, std::min(look_edge, tile.row_count - down),
                tile.first_column + across, std::min(look_edge, tile.column_count - across)};
            render.source.resample(render.plan, pictures, part, threads);
            render.ceiling.touched(2 * look_edge * bytes_around);
        }
    }
}

void Output::compute_rows(const Render &render, const cm_rows &rows,
                          std::vector<cm_image> &pictures, int threads)
{
    const bool in_tiles = render.ceiling.in_files() > 0;
    const std::uint32_t down = in_tiles ? tile_edge : rows.row_count;
    const std::uint32_t across = in_tiles ? tile_edge : rows.column_count;
    const std::uint32_t last_row = rows.first_row + rows.row_count;
    const std::uint32_t last_column = rows.first_column + rows.column_count;
    for (std::uint32_t row = rows.first_row; row < last_row; row += down)
    {
        for (std::uint32_t column = rows.first_column; column < last_column; column += across)
        {
            const cm_rows tile = {rows.plane, row, std::min(down, last_row - row), column,
                                  std::min(across, last_column - column)};
            in_tiles ? compute_tile(render, tile, pictures, threads)
                     : render.source.resample(render.plan, pictures, tile, threads);
        }
    }
}

// Dense; the first byte may be of rows that are not there.
cm_image Output::picture_at(unsigned char *first) const
{
    cm_image picture = {};
    picture.size = sizeof picture;
    picture.data = first;
    picture.type = row_type;
    picture.width = cm_surface_width(surface);
    picture.height = cm_surface_height(surface);
    picture.channels = static_cast<std::uint32_t>(channels);
    return picture;
}

// The picture as a whole is not there: only the band's rows are touched.
void Output::compute(const Render &render, std::size_t index, const Rows &band, int threads)
{
    const std::size_t row = row_bytes();
    std::memset(band.bytes, 0, row * static_cast<std::size_t>(band.end - band.first));
    const cm_image picture = picture_at(reinterpret_cast<unsigned char *>(
        reinterpret_cast<std::uintptr_t>(band.bytes) - static_cast<std::size_t>(band.first) * row));
    std::vector<cm_image> pictures(cm_surface_picture_count(surface), picture);
    for (const PlanePlace &place : places)
    {
        const cm_rows rows = place.part(band.first, band.end);
        if (place.picture != index || rows.row_count == 0)
        {
            continue;
        }
        compute_rows(render, rows, pictures, threads);
        if (row_type == CM_PIXEL_FLOAT && (lines || colors.is_needed()))
        {
            finish_rows(place, rows, band, threads);
        }
    }
}

// A spline whose coefficients are large takes less memory if all of the target is asked for at once, and is in memory.
bool Output::holds_pictures(const Render &render, const Input &input) const
{
    const std::uint64_t pixels = std::uint64_t{cm_surface_width(&input.surface())} *
                                 cm_surface_height(&input.surface()) *
                                 cm_surface_picture_count(&input.surface());
    const std::uint64_t coefficients =
        pixels * static_cast<std::uint64_t>(channels) * sizeof(float);
    const std::uint64_t target =
        row_bytes() * cm_surface_height(surface) * cm_surface_picture_count(surface);
    return render.source.filter() == CM_FILTER_BSPLINE5 && render.ceiling.functions() == nullptr &&
           !work && !whole.is_needed() && coefficients > kept_coefficients &&
           target < coefficients - kept_coefficients;
}

void Output::compute_all(const Render &render, int threads)
{
    const int height = static_cast<int>(cm_surface_height(surface));
    const std::size_t bytes = row_bytes() * static_cast<std::size_t>(height);
    std::vector<cm_image> pictures;
    for (std::size_t i = 0; i < cm_surface_picture_count(surface); ++i)
    {
        whole_pictures.emplace_back(bytes);
        std::memset(whole_pictures.back().bytes(), 0, bytes);
        pictures.push_back(picture_at(whole_pictures.back().bytes()));
    }
    render.source.resample(render.plan, pictures, {}, threads);
    for (const PlanePlace &place : places)
    {
        if (row_type == CM_PIXEL_FLOAT && (lines || colors.is_needed()))
        {
            finish_rows(place, place.part(0, height),
                        {0, height, whole_pictures[place.picture].bytes()}, threads);
        }
    }
}

void Output::finish_rows(const PlanePlace &place, const cm_rows &rows, const Rows &band,
                         int threads) const
{
    const std::size_t count = rows.column_count;
    const std::size_t size = static_cast<std::size_t>(channels);
    const std::ptrdiff_t down = static_cast<std::ptrdiff_t>(row_bytes() / sizeof(float));
    const std::ptrdiff_t right = place.right_x * channels + place.right_y * down;
    const PixelChannels meaning = {channels, colors.alpha, colors.multiply};
    float *const all = reinterpret_cast<float *>(band.bytes);
    const auto finish_row = [&](int i)
    {
        const auto row = rows.first_row + static_cast<std::uint32_t>(i);
        const int first = static_cast<int>(rows.first_column);
        const int x = place.left + first * place.right_x + static_cast<int>(row) * place.down_x;
        const int y = place.top + first * place.right_y + static_cast<int>(row) * place.down_y;
        float *const begin = all + (y - band.first) * down + x * channels;
        std::vector<float> pixels(count * size);
        for (std::size_t k = 0; k < count; ++k)
        {
            std::copy_n(begin + static_cast<std::ptrdiff_t>(k) * right, size, &pixels[k * size]);
        }
        if (colors.is_needed())
        {
            colors.convert(pixels.data(), count);
        }
        if (lines)
        {
            lines->draw(place.plane, row, meaning, pixels.data());
        }
        for (std::size_t k = 0; k < count; ++k)
        {
            std::copy_n(&pixels[k * size], size, begin + static_cast<std::ptrdiff_t>(k) * right);
        }
    };
    parallel_for(static_cast<int>(rows.row_count), threads, finish_row);
}

// Where rows are kept they are the same for any number of threads.
std::vector<int> Output::bands_of(const Render &render, std::size_t index, int threads) const
{
    const int counted = work ? kept_threads : threads;
    const int pictures = static_cast<int>(names.size());
    const std::size_t at_once = static_cast<std::size_t>(std::min(pictures, counted));
    const std::uint64_t share = render.ceiling.in_files() > 0 ? render.ceiling.bytes() : 0;
    const std::size_t together =
        std::max<std::size_t>(bands_bytes, static_cast<std::size_t>(share / ceiling_parts));
    return band_ends(index, std::min(together / 2 / at_once, band_most),
                     std::max(1, counted / pictures));
}

void Output::fill_rows(const Render &render, std::size_t index, const Rows &band, int threads)
{
    const std::size_t size = row_bytes() * static_cast<std::size_t>(band.end - band.first);
    if (!whole_pictures.empty())
    {
        std::memcpy(band.bytes,
                    whole_pictures[index].bytes() +
                        row_bytes() * static_cast<std::size_t>(band.first),
                    size);
        return;
    }
    if (work && work->load(index, band.first, band.end, band.bytes, size))
    {
        return;
    }
    compute(render, index, band, threads);
    if (work)
    {
        work->store(index, band.first, band.end, band.bytes, size);
    }
}

// Of bands with these ends, one is computed while another is written, by a thread of its own.
void Output::write_rows(const Render &render, std::size_t index, ImageWriter &writer,
                        const std::vector<int> &ends, int threads, bool own_thread)
{
    int most_rows = 0;
    for (std::size_t i = 0; i < ends.size(); ++i)
    {
        most_rows = std::max(most_rows, ends[i] - (i == 0 ? 0 : ends[i - 1]));
    }
    const auto write_band = [&](const RowBand &band)
    {
        writer.write(band.first, band.end, row_type, band.pixels.bytes(), channels);
        render.progress.advance(band.end - band.first);
    };
    BandQueue queue(render.ceiling, row_bytes() * static_cast<std::size_t>(most_rows),
                    own_thread && ends.size() > 1, write_band);
    for (std::size_t i = 0; i < ends.size(); ++i)
    {
        RowBand &band = queue.take();
        band.first = i == 0 ? 0 : ends[i - 1];
        band.end = ends[i];
        fill_rows(render, index, {band.first, band.end, band.pixels.bytes()}, threads);
        queue.give();
    }
    queue.finish();
}

void Output::write_picture(const Render &render, std::size_t index, int threads)
{
    if (work && work->is_complete(index))
    {
        files[index]->take(work->picture_name(index));
        render.progress.advance(cm_surface_height(surface));
        return;
    }
    ImageWriter writer(plan, static_cast<int>(cm_surface_width(surface)),
                       static_cast<int>(cm_surface_height(surface)), names[index], *files[index]);
    write_rows(render, index, writer, bands_of(render, index, threads),
               std::max(1, threads / static_cast<int>(names.size())), threads > 1);
    writer.close();
    if (georeferenced)
    {
        write_geographic_place(*surface, names[index], *files[index]);
    }
    files[index]->finish();
    if (work && files[index]->keep_as(work->picture_name(index)))
    {
        work->complete(index);
    }
}

// All faces into one file, one after another.
void Output::write_parts(const Render &render, int threads)
{
    ImageWriter writer(plan, static_cast<int>(cm_surface_width(surface)),
                       static_cast<int>(cm_surface_height(surface)), names.front(), *files.front());
    for (std::size_t i = 0; i < plan.parts.size(); ++i)
    {
        write_rows(render, i, writer, bands_of(render, i, threads), threads, threads > 1);
    }
    writer.close();
    files.front()->finish();
}
