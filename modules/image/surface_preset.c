/* SPDX-License-Identifier: MIT
 *
 * Conventions of programs. Cube maps of all graphics interfaces share one table (OpenGL 4.6 core, table 8.19; Vulkan
 * 1.3, 16.5.4; Direct3D 11.3, 7.18.11): the frame gl. Its pictures are upright, and not mirrored, seen from inside with
 * x to the right, y up and z ahead. What differs is how a program's axes stand in that.
 */
#include <cubemap/image.h>

#include <string.h>

/* Rows: where the surface's x, y and z are; ahead is x of the Earth, right y, up z. */
#define Z_AHEAD                                                                                    \
    {                                                                                              \
        {                                                                                          \
            {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0},                                                      \
            {                                                                                      \
                1.0, 0.0, 0.0                                                                      \
            }                                                                                      \
        }                                                                                          \
    }
#define Y_IS_RIGHT                                                                                 \
    {                                                                                              \
        {                                                                                          \
            {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0},                                                      \
            {                                                                                      \
                0.0, 0.0, 1.0                                                                      \
            }                                                                                      \
        }                                                                                          \
    }
#define X_IS_BEHIND                                                                                \
    {                                                                                              \
        {                                                                                          \
            {-1.0, 0.0, 0.0}, {0.0, 0.0, 1.0},                                                     \
            {                                                                                      \
                0.0, 1.0, 0.0                                                                      \
            }                                                                                      \
        }                                                                                          \
    }

#define CUBE_MAP "cube:gnomonic;frame=gl;layout=faces"

static const cm_surface_preset presets[] = {
    {"opengl", "six faces +x -x +y -y +z -z, y up, +z ahead and +x to the right",
     "OpenGL 4.6 core, table 8.19", CUBE_MAP, Z_AHEAD},
    {"vulkan", "six faces +x -x +y -y +z -z, y up, +z ahead and +x to the right",
     "Vulkan 1.3, 16.5.4 Cube map face selection", CUBE_MAP, Z_AHEAD},
    {"directx", "six faces +x -x +y -y +z -z, y up, +z ahead and +x to the right",
     "Direct3D 11.3 functional specification, 7.18.11", CUBE_MAP, Z_AHEAD},
    {"unity", "six faces +x -x +y -y +z -z, y up, +z ahead and +x to the right",
     "Unity manual, Cubemaps: left-handed, y up, z forward", CUBE_MAP, Z_AHEAD},
    {"unreal", "six faces +x -x +y -y +z -z, z up, +x ahead and +y to the right",
     "Unreal Engine 4.26, Creating Cubemaps: how faces are turned", CUBE_MAP, Y_IS_RIGHT},
    {"threejs", "six faces px nx py ny pz nz, y up, nx ahead and pz to the right",
     "three.js, CubeTexture.js (x is mirrored) and equirectUv (the middle is +x of the world)",
     CUBE_MAP, X_IS_BEHIND},
    {"youtube", "equi-angular cube of 3 x 2 faces, the lower row turned",
     "FFmpeg, filter v360, eac, which has 2 pixels of pad: layout=eac:pad=2",
     "cube:tangent;frame=geo;layout=eac", Y_IS_RIGHT},
};

size_t cm_surface_preset_count(void)
{
    return sizeof presets / sizeof *presets;
}

const cm_surface_preset *cm_surface_preset_at(size_t index)
{
    return index < cm_surface_preset_count() ? &presets[index] : NULL;
}

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c + ('a' - 'A')) : c;
}

const cm_surface_preset *cm_surface_preset_find(const char *identifier)
{
    for (size_t i = 0; identifier != NULL && i < cm_surface_preset_count(); i++)
    {
        size_t k = 0;
        const char *own = presets[i].identifier;
        while (own[k] != '\0' && lower(identifier[k]) == own[k])
        {
            k++;
        }
        if (own[k] == '\0' && identifier[k] == '\0')
        {
            return &presets[i];
        }
    }
    return NULL;
}
