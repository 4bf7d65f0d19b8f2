// SPDX-License-Identifier: MIT

#include "surface_text.hpp"
#include "tools/cli/lower_case.hpp"
#include "tools/cli/program.hpp"

#include <cubemap/catalogue.h>
#include <cmath>
#include <cubemap/number.h>
#include <cubemap/options.h>

#include <algorithm>
#include <new>

namespace
{

// Where ";KEY=" begins, npos if it does not.
std::size_t place_of_key(const std::string &specification, const std::string &key)
{
    return lower_case(specification).find(";" + key + "=");
}

// What a double has of degrees for certain: more digits would be those of rounding.
std::string number_text(double value)
{
    char text[CM_NUMBER_SIZE];
    cm_number_write(value, 15, text);
    return text;
}

} // namespace

std::string head_of(const std::string &specification)
{
    return specification.substr(0, specification.find(';'));
}

std::string kind_of(const std::string &specification)
{
    return lower_case(specification.substr(0, specification.find_first_of(":;")));
}

std::string key_of(const std::string &specification, const std::string &key)
{
    const std::size_t place = place_of_key(specification, key);
    if (place == std::string::npos)
    {
        return "";
    }
    const std::size_t begin = place + key.size() + 2;
    return specification.substr(begin, specification.find(';', begin) - begin);
}

std::string without_key(const std::string &specification, const std::string &key)
{
    std::string rest = specification;
    const std::size_t place = place_of_key(specification, key);
    if (place != std::string::npos)
    {
        rest.erase(place, std::min(rest.find(';', place + 1), rest.size()) - place);
    }
    return rest;
}

std::string without_size(const std::string &specification)
{
    return without_key(without_key(specification, "size"), "height");
}

std::string take_healpix_order(std::string &specification)
{
    const std::string head = head_of(specification);
    for (const std::string ending : {":nest", ":ring"})
    {
        if (kind_of(head) == "healpix" && head.size() > ending.size() &&
            head.compare(head.size() - ending.size(), ending.size(), ending) == 0)
        {
            specification.erase(head.size() - ending.size(), ending.size());
            return ending.substr(1);
        }
    }
    return "";
}

bool is_cube(const std::string &specification)
{
    return kind_of(specification) == "cube";
}

bool is_whole_equirect(const std::string &specification)
{
    const auto has_none = [&specification](const char *key)
    { return place_of_key(specification, key) == std::string::npos; };
    return kind_of(specification) == "equirect" && has_none("west") && has_none("east") &&
           has_none("south") && has_none("north");
}

bool is_chart(const std::string &specification)
{
    const std::string kind = kind_of(specification);
    for (std::size_t i = 0; i < cm_surface_kind_count(); ++i)
    {
        if (kind == cm_surface_kind_at(i)->identifier)
        {
            return false;
        }
    }
    return true;
}

namespace
{

// Without what rounding has left, a tenth of a micrometer on Earth.
std::string angle_text(double degrees)
{
    const double parts = 1e12;
    return number_text(std::round(degrees * parts) / parts + 0.0);
}

} // namespace

std::string rotation_text(const cm_rotation &rotation)
{
    double lon = 0;
    double lat = 0;
    double roll = 0;
    cm_rotation_angles(&rotation, &lon, &lat, &roll);
    return angle_text(lon) + "," + angle_text(lat) + "," + angle_text(roll);
}

bool is_turned(const cm_rotation &rotation)
{
    for (int i = 0; i < 3; ++i)
    {
        for (int j = 0; j < 3; ++j)
        {
            if (rotation.row[i][j] != (i == j ? 1.0 : 0.0))
            {
                return true;
            }
        }
    }
    return false;
}

cm_rotation product(const cm_rotation &first, const cm_rotation &second)
{
    cm_rotation both;
    for (int i = 0; i < 3; ++i)
    {
        for (int j = 0; j < 3; ++j)
        {
            both.row[i][j] = first.row[i][0] * second.row[0][j] +
                             first.row[i][1] * second.row[1][j] +
                             first.row[i][2] * second.row[2][j];
        }
    }
    return both;
}

cm_rotation quotient(const cm_rotation &first, const cm_rotation &second)
{
    cm_rotation back;
    for (int i = 0; i < 3; ++i)
    {
        for (int j = 0; j < 3; ++j)
        {
            back.row[i][j] = second.row[j][i];
        }
    }
    return product(first, back);
}

SurfacePointer make_surface(const std::string &specification, int width, int height,
                            const std::optional<cm_rotation> &rotation, std::string &message)
{
    char text[400] = "";
    if (cm_instructions_check(nullptr, text, sizeof text) != CM_OK)
    {
        throw Failure(text);
    }
    const cm_surface_options options = {sizeof options, static_cast<std::uint32_t>(width),
                                        static_cast<std::uint32_t>(height),
                                        rotation ? &*rotation : nullptr, nullptr};
    cm_surface *made = nullptr;
    const cm_status status = cm_surface_create(specification.c_str(), &options, &made);
    if (status == CM_ERROR_MEMORY)
    {
        throw std::bad_alloc();
    }
    if (status != CM_OK)
    {
        const bool said =
            cm_surface_check(specification.c_str(), &options, text, sizeof text) != CM_OK;
        message = said ? text : cm_status_text(status);
    }
    return SurfacePointer(made);
}

std::string surface_description(const cm_surface &surface,
                                const std::optional<cm_rotation> &rotation)
{
    const std::string specification = cm_surface_specification(&surface);
    const std::string size = std::to_string(cm_surface_width(&surface)) + "x" +
                             std::to_string(cm_surface_height(&surface));
    std::string text = without_size(specification);
    if (is_cube(specification))
    {
        const std::string layout = key_of(specification, "layout");
        text = head_of(specification) + ", frame " + key_of(specification, "frame") + "," +
               (layout == "faces" ? "" : " " + layout);
    }
    text += " " + size;
    return text +
           (rotation && is_turned(*rotation) ? ", turned by " + rotation_text(*rotation) : "");
}
