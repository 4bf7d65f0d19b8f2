// SPDX-License-Identifier: MIT
//
// Pixels and colours as numbers, for the shell tests of pictures. See usage() below.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>

#include <cubemap/colormap.h>

namespace
{

// As they are stored: "WIDTH HEIGHT CHANNELS\n", and then the values as floats of this machine.
void write_pixels(const std::string &name)
{
    OIIO::ImageSpec request;
    request.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(name, &request);
    if (!input)
    {
        throw std::runtime_error(name + ": " + OIIO::geterror());
    }
    const OIIO::ImageSpec &spec = input->spec();
    std::vector<float> pixels(std::size_t(spec.width) * std::size_t(spec.height) *
                              std::size_t(spec.nchannels));
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, pixels.data()))
    {
        throw std::runtime_error(name + ": " + input->geterror());
    }
    std::printf("%d %d %d\n", spec.width, spec.height, spec.nchannels);
    std::fwrite(pixels.data(), sizeof(float), pixels.size(), stdout);
}

// Reads places, and writes the red, green and blue of each.
void write_colors(const char *specification)
{
    cm_colormap *map = nullptr;
    if (cm_colormap_create(specification, &map) != CM_OK)
    {
        throw std::runtime_error(std::string(specification) + ": not a colour map");
    }
    double place = 0;
    while (std::scanf("%lf", &place) == 1)
    {
        cm_colormap_color color;
        cm_colormap_color_at(map, place, &color);
        std::printf("%.9g %.9g %.9g\n", color.srgb[0], color.srgb[1], color.srgb[2]);
    }
    cm_colormap_destroy(map);
}

int usage()
{
    std::fputs("picture_pixels pixels FILE\n"
               "picture_pixels colors SPECIFICATION <PLACES\n",
               stderr);
    return 2;
}

} // namespace

int main(int argc, char **argv)
{
    try
    {
        if (argc != 3)
        {
            return usage();
        }
        if (std::strcmp(argv[1], "pixels") == 0)
        {
            write_pixels(argv[2]);
            return EXIT_SUCCESS;
        }
        if (std::strcmp(argv[1], "colors") == 0)
        {
            write_colors(argv[2]);
            return EXIT_SUCCESS;
        }
        return usage();
    }
    catch (const std::exception &exception)
    {
        std::fprintf(stderr, "picture_pixels: %s\n", exception.what());
        return EXIT_FAILURE;
    }
}
