// SPDX-License-Identifier: MIT
//
// Specifications of surfaces as texts, and surfaces that destroy themselves.

#ifndef CUBEMAP_TOOLS_SURFACE_TEXT_HPP
#define CUBEMAP_TOOLS_SURFACE_TEXT_HPP

#include <cubemap/image.h>

#include <memory>
#include <optional>
#include <string>

struct SurfaceDeleter
{
    void operator()(cm_surface *owned) const noexcept
    {
        cm_surface_destroy(owned);
    }
};

using SurfacePointer = std::unique_ptr<cm_surface, SurfaceDeleter>;

// What stands before the keys: "cube:qsc". What stands before the colon in that: "cube", in lower case.
std::string head_of(const std::string &specification);
std::string kind_of(const std::string &specification);

// The value of a key, "" if it is not there.
std::string key_of(const std::string &specification, const std::string &key);

// The specification without a key, and without those of a picture's size.
std::string without_key(const std::string &specification, const std::string &key);
std::string without_size(const std::string &specification);

// Takes ":nest" or ":ring" from the end of "healpix:NSIDE", "" if there is none.
std::string take_healpix_order(std::string &specification);

bool is_cube(const std::string &specification);

// Is it an equirectangular image of the whole sphere?
bool is_whole_equirect(const std::string &specification);

// Is it a mapping of one face, not a kind of its own?
bool is_chart(const std::string &specification);

// "lon,lat,roll", and whether there is any.
std::string rotation_text(const cm_rotation &rotation);
bool is_turned(const cm_rotation &rotation);

// What turns as second does, or back, and then as first.
cm_rotation product(const cm_rotation &first, const cm_rotation &second);
cm_rotation quotient(const cm_rotation &first, const cm_rotation &second);

// A surface of pictures of this size, 0: as the specification says. nullptr if there is none, and then what is
// wrong in message. Failure if the instruction set that the environment asks for is not there.
SurfacePointer make_surface(const std::string &specification, int width, int height,
                            const std::optional<cm_rotation> &rotation, std::string &message);

// For people: "cube:coupled, frame geo, 16x16", "equirect 64x32".
std::string surface_description(const cm_surface &surface,
                                const std::optional<cm_rotation> &rotation);

#endif
