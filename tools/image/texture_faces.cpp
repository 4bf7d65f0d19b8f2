// SPDX-License-Identifier: MIT

#include "texture_faces.hpp"

bool is_texture(const std::string &format)
{
    return format == "dds" || format == "ktx2";
}

SavedSurface texture_surface()
{
    const cm_surface_preset &usual = *cm_surface_preset_find("directx");
    return {usual.specification, usual.rotation, ""};
}

bool has_six_faces(const ImageFile &image)
{
    return image.stored().subimage_count == 6 && is_texture(image.format());
}
