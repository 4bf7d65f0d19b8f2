// SPDX-License-Identifier: MIT
//
// What cubemap-reproject writes beside pictures one by one: textures, levels, borders.

#include "direction_image.hpp"
#include "image_cases.hpp"
#include "picture.hpp"

#include "modules/image/io/texture_file.h"

#include <cubemap/healpix.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace
{

// ---- textures, as they are in the file

std::size_t read_text(void *context, void *bytes, std::size_t count)
{
    return std::fread(bytes, 1, count, static_cast<std::FILE *>(context));
}

void seek_text(void *context, std::int64_t position)
{
    std::fseek(static_cast<std::FILE *>(context), static_cast<long>(position), SEEK_SET);
}

std::size_t size_of_text(void *context)
{
    std::fseek(static_cast<std::FILE *>(context), 0, SEEK_END);
    return static_cast<std::size_t>(std::ftell(static_cast<std::FILE *>(context)));
}

struct Texture
{
    explicit Texture(const std::string &name) : file(std::fopen(name.c_str(), "rb"))
    {
        char message[CM_IMAGE_MESSAGE] = "no file";
        if (file == nullptr || cm_texture_open(&stream(), &of, message) != CM_OK)
        {
            throw std::runtime_error(name + " " + message);
        }
    }
    ~Texture()
    {
        std::fclose(file);
    }
    Texture(const Texture &) = delete;
    Texture &operator=(const Texture &) = delete;

    const cm_image_stream &stream()
    {
        opened = {file, read_text, nullptr, seek_text, size_of_text};
        return opened;
    }

    std::vector<float> floats(std::uint32_t level, std::uint32_t face)
    {
        const std::size_t edge = std::max(of.width >> level, 1u);
        std::vector<float> values(4 * edge * edge);
        char message[CM_IMAGE_MESSAGE] = "";
        if (of.format != CM_TEXTURE_RGBA32F ||
            cm_texture_read(&stream(), &of, level, face, values.data(), 0, message) != CM_OK)
        {
            throw std::runtime_error(std::string("not floats: ") + message);
        }
        return values;
    }

    std::FILE *file;
    cm_image_stream opened = {};
    cm_texture of = {};
};

// The texture's level and face has the picture's pixels, and alpha 1.
void check_level(Texture &texture, std::uint32_t level, std::uint32_t face, const std::string &name)
{
    const Picture picture(name);
    const std::vector<float> values = texture.floats(level, face);
    const std::size_t pixels = values.size() / 4;
    if (pixels != std::size_t(picture.width) * std::size_t(picture.height))
    {
        throw std::runtime_error(name + " has another size");
    }
    for (std::size_t i = 0; i < pixels; ++i)
    {
        if (std::memcmp(&values[4 * i], &picture.values[3 * i], 3 * sizeof(float)) != 0 ||
            values[4 * i + 3] < 1 || values[4 * i + 3] > 1)
        {
            throw std::runtime_error(name + ": pixel " + std::to_string(i) + " differs");
        }
    }
}

// A container's faces are those of --for directx, its levels the files that other formats have.
void check_texture(const std::string &extension)
{
    does("reproject --quiet --mips equirect.tif sky." + extension);
    holds("faces and levels of ." + extension,
          [&]
          {
              Texture texture("sky." + extension);
              if (texture.of.faces != 6 || texture.of.levels != 7 || texture.of.width != 64)
              {
                  throw std::runtime_error("not 6 faces of 64 pixels with 7 levels");
              }
              for (std::uint32_t level = 0; level < 7; ++level)
              {
                  const std::string mark = level == 0 ? "" : "_m" + std::to_string(level);
                  for (std::uint32_t face = 0; face < 6; ++face)
                  {
                      check_level(texture, level, face,
                                  "face_" + std::to_string(face) + mark + ".tif");
                  }
              }
          });
    says("." + extension + " as INPUT",
         "^sky\\." + extension +
             " \\(cube:gnomonic, frame gl, 64x64, turned by 90,0,90, 4 channels, float\\)",
         "reproject --filter bilinear sky." + extension + " back.tif");
    does("reproject --quiet --filter bilinear face_%f.tif same.tif");
    holds("." + extension + " and its faces are the same sphere",
          []
          {
              const Picture back("back.tif");
              const Picture same("same.tif");
              for (std::size_t i = 0; i < same.values.size(); ++i)
              {
                  if (std::fabs(back.values[i / 3 * 4 + i % 3] - same.values[i]) > 1e-6f)
                  {
                      throw std::runtime_error("value " + std::to_string(i));
                  }
              }
          });
    does("reproject --quiet --to equirect equirect.tif whole." + extension);
    says("a picture in ." + extension,
         "^whole\\." + extension + " \\(equirect 256x128, 4 channels, float\\)",
         "reproject whole." + extension + " face_again_%f.exr");
}

void textures()
{
    make_direction_image(equirect_shape, 256, "equirect.tif");
    does("reproject --quiet --mips --for directx equirect.tif face_%f.tif");
    holds("the files are the faces of Direct3D's table, y up",
          []
          {
              // face 0, +x, is what is to the right of what is ahead: longitude 90 E; +y is north
              const Picture right("face_0.tif");
              const Picture up("face_2.tif");
              if (right.at(32, 32)[1] < 0.99f || up.at(32, 32)[2] < 0.99f)
              {
                  throw std::runtime_error("another face");
              }
          });
    check_texture("dds");
    check_texture("ktx2");
}

cm_texture_format format_in(const std::string &name)
{
    return Texture(name).of.format;
}

// A program that is there and prints what matches.
void peer(const std::string &name, const std::string &is_there, const std::string &command,
          const std::string &expression)
{
    if (std::system((is_there + " >/dev/null 2>&1").c_str()) != 0)
    {
        return;
    }
    const int status = std::system((command + " >peer.txt 2>&1").c_str());
    const std::string text = content_of("peer.txt");
    result(status == 0 && matches(text, expression), name, text);
}

void texture_values()
{
    make_noise(64, 32, "noise.ppm");
    does("reproject --quiet --mips noise.ppm noise.dds");
    does("reproject --quiet --mips noise.ppm noise.ktx2");
    does("reproject --quiet --stored noise.ppm stored.dds");
    make_constant(32, 16, 3, "uint16", 0.5f, "grey16.png");
    make_constant(32, 16, 3, "half", 0.5f, "half.exr");
    make_constant(32, 16, 3, "float", 0.5f, "light.hdr");
    does("reproject --quiet grey16.png grey16.ktx2");
    does("reproject --quiet half.exr half.ktx2");
    does("reproject --quiet light.hdr light.dds");
    result(format_in("noise.dds") == CM_TEXTURE_RGBA8_SRGB &&
               format_in("noise.ktx2") == CM_TEXTURE_RGBA8_SRGB &&
               format_in("stored.dds") == CM_TEXTURE_RGBA8 &&
               format_in("grey16.ktx2") == CM_TEXTURE_RGBA16 &&
               format_in("half.ktx2") == CM_TEXTURE_RGBA16F &&
               format_in("light.dds") == CM_TEXTURE_RGBA32F,
           "formats come from the pixels' types and colours");
    // 0.5 of sRGB is 0.214 of light
    does("reproject --quiet --stored --to equirect grey16.ktx2 grey.tif");
    holds("16 bits hold light",
          []
          {
              const double value = Picture("grey.tif").first(3, 3);
              if (std::fabs(value - 0.21404) > 1e-4)
              {
                  throw std::runtime_error(std::to_string(value));
              }
          });
    does("reproject --quiet noise.ktx2 back.png");
    does("reproject --quiet --for directx noise.ppm f_%f.png");
    peer("libmagic knows the DDS file", "file --version", "file -b noise.dds",
         "^Microsoft DirectDraw Surface .*16 x 16, DXGI format: R8G8B8A8_UNORM_SRGB");
    peer("libmagic knows the KTX file", "file --version", "file -b noise.ktx2",
         "^Khronos KTX2 texture, 16 x 16, 6 faces, 5 mipmaps, R8G8B8A8_SRGB");
    const std::string python = "/usr/bin/python3 -c 'from PIL import Image";
    peer("Pillow reads the first face", python + "'",
         python + "; print(Image.open(\"noise.dds\").convert(\"RGB\").tobytes() == "
                  "Image.open(\"f_0.png\").tobytes())'",
         "^True$");
}

struct WrongOutput
{
    const char *name;
    int status;
    const char *words;
    const char *arguments;
};

constexpr WrongOutput wrong_outputs[] = {
    {"another frame in a texture", 2, "frame gl, not geo", "--frame geo noise.ppm made/a.dds"},
    {"a strip in a texture", 2, "leave the layout strip out",
     "--layout strip noise.ppm made/a.ktx2"},
    {"an unfolded cube in a texture", 2, "one picture, or six faces",
     "--for youtube noise.ppm made/a.ktx2"},
    {"a border in a texture", 2, "leave the border out", "--border 1 noise.ppm made/a.dds"},
    {"five channels in a texture", 1, "1 to 4 channels", "five.tif made/a.dds"},
    {"a texture's compression", 2, "one way only", "--compression zip noise.ppm made/a.dds"},
    {"a border of a cross", 2, "layouts faces, strip",
     "--border 1 --layout cross noise.ppm made/a.png"},
    {"a border that is said twice", 2, "leave one out",
     "--border 1 --layout strip:border=2 noise.ppm made/a.png"},
    {"a border of a globe", 2, "OUTPUT is equirect",
     "--border 1 --to equirect noise.ppm made/a.png"},
    {"a border that is too wide", 2, "--border", "--border 129 noise.ppm made/a.png"},
    {"levels of places in pixels", 2, "--mips",
     "--mips --to fisheye;size=16;radius=7 noise.ppm made/a.png"},
    {"levels into a pipe", 2, "a file for each level", "--mips --to equirect noise.ppm -"},
    {"half a DDS file", 1, "cut.dds' .*(ends|read)", "cut.dds made/a.png"},
    {"half a KTX file", 1, "cut.ktx2' .*ends", "cut.ktx2 made/a.png"},
    {"no KTX file of that version", 1, "version 2.0", "old.ktx2 made/a.png"},
};

void refusals()
{
    make_noise(64, 32, "noise.ppm");
    make_constant(32, 16, 5, "float", 0.5f, "five.tif");
    for (const std::string extension : {"dds", "ktx2"})
    {
        does("reproject --quiet noise.ppm whole." + extension);
        const std::string whole = content_of("whole." + extension);
        write_file("cut." + extension, whole.substr(0, whole.size() / 2));
    }
    write_file("old.ktx2", "\xabKTX 11\xbb\r\n\x1a\n" + std::string(200, '\0'));
    for (const WrongOutput &each : wrong_outputs)
    {
        fails(each.name, each.status, each.words, std::string("reproject ") + each.arguments);
    }
    const SizeLimit limit(1000);
    fails("a full disk and a texture", 1, "cannot be written: File too large",
          "reproject noise.ppm made/a.dds");
    fails("a full disk and levels", 1, "cannot be written: File too large",
          "reproject --mips --size 64 noise.ppm made/a_%f.tif");
}

// ---- borders

// A pixel of a face of gnomonic in the frame geo, or beyond it, is the direction of its centre.
void check_border(const std::string &name, int face, int edge, int border)
{
    static constexpr int outward[6][3] = {{1, 0, 0},  {0, 1, 0}, {-1, 0, 0},
                                          {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    const Picture picture(name);
    if (picture.width != edge + 2 * border || picture.height != picture.width)
    {
        throw std::runtime_error(name + " has another size");
    }
    for (int row = 0; row < picture.height; ++row)
    {
        for (int column = 0; column < picture.width; ++column)
        {
            const double u = 2 * (column - border + 0.5) / edge - 1;
            const double v = 1 - 2 * (row - border + 0.5) / edge;
            const int *const out = outward[face];
            // to the right is east, and of the poles longitude 90 E; up is north, and of the poles towards, or from,
            // longitude 180
            const double side[3] = {face < 4 ? -out[1] * u : -out[2] * v, face < 4 ? out[0] * u : u,
                                    face < 4 ? v : 0.0};
            const double length = std::sqrt(1 + u * u + v * v);
            for (int i = 0; i < 3; ++i)
            {
                const double wanted = (out[i] + side[i]) / length;
                const double found = static_cast<double>(picture.at(column, row)[i]);
                if (!(std::fabs(found - wanted) < 2e-3))
                {
                    throw std::runtime_error(name + " at " + std::to_string(column) + ", " +
                                             std::to_string(row) + ": " + std::to_string(found) +
                                             ", not " + std::to_string(wanted));
                }
            }
        }
    }
}

void borders()
{
    make_direction_image(equirect_shape, 512, "equirect.tif");
    does("reproject --quiet --border 5 --mips --to cube:gnomonic equirect.tif face_%f.tif");
    for (int face = 0; face < 6; ++face)
    {
        const std::string begin = "face_" + std::to_string(face);
        holds("what is around face " + std::to_string(face),
              [&] { check_border(begin + ".tif", face, 128, 5); });
    }
    holds("what is around a smaller one",
          []
          {
              const Picture third("face_0_m3.tif");
              const Picture inner("face_0.tif");
              if (third.width != 16 + 10 || inner.width != 128 + 10)
              {
                  throw std::runtime_error("another size");
              }
          });
    says("faces with borders as INPUT", "\\(cube:gnomonic, frame geo, faces:border=5 138x138,",
         "reproject --filter bilinear face_%f.tif back.tif");
    holds("and they are the same sphere",
          [] { check_direction_image(equirect_shape, "back.tif", 3e-3, 1e-4); });
    says("a level is a cube, too", "\\(cube:gnomonic, frame geo, faces:border=5 42x42,",
         "reproject --filter bilinear face_%f_m2.tif small.tif");
    holds("of the same sphere",
          [] { check_direction_image(equirect_shape, "small.tif", 3e-2, 2e-3); });
    for (const std::string layout : {"strip", "column", "3x2", "2x3"})
    {
        does("reproject --quiet --border 3 --size 64 --to cube:qsc --layout " + layout +
             " equirect.tif one.tif");
        does("reproject --quiet --filter bilinear one.tif back.tif");
        holds("borders in a " + layout,
              [] { check_direction_image(equirect_shape, "back.tif", 6e-3, 4e-4); });
    }
}

// ---- levels

void levels()
{
    make_noise(64, 32, "noise.ppm");
    says("how many levels", "level_m6.png \\(equirect 64x32; nearest; 7 levels\\)",
         "reproject --mips --to equirect noise.ppm level.png");
    says("a level says what it is", "^level_m2\\.png \\(equirect 16x8,",
         "reproject level_m2.png again.tif");
    says("levels of HEALPix", "^map_m1\\.tif \\(healpix:8 96x8,",
         (does("reproject --quiet --mips --to healpix:16 noise.ppm map.tif"),
          "reproject map_m1.tif again.tif"));
    does("reproject --quiet --mips --layout strip noise.ppm strip.exr");
    says("levels of a strip", "^strip_m2\\.exr \\(cube:coupled, frame geo, strip 24x4,",
         "reproject strip_m2.exr again.exr");
    says("a size that is no power of two, in a texture", "48x48, turned .*; 5 levels",
         "reproject --mips --size 48 noise.ppm noise.dds");
}

// What goes with outputs that are written at once.
void together()
{
    make_noise(64, 32, "noise.ppm");
    does("reproject --quiet --mips --to equirect --georeference --manifest made.json noise.ppm "
         "level.tif");
    const std::string manifest = content_of("made.json");
    result(manifest.find("\"level.tif\"") != std::string::npos &&
               manifest.find("\"level_m6.tif\"") != std::string::npos,
           "a manifest has all levels", manifest);
    for (const std::string name : {"level.tif", "level_m3.tif"})
    {
        // the tag 34735, GeoKeyDirectory
        result(content_of(name).find("\xaf\x87") != std::string::npos, "is on Earth: " + name);
    }
    does("reproject --quiet --mips --memory 1G --manifest made.json noise.ppm sky.ktx2");
    does("reproject --quiet --mips noise.ppm free.ktx2");
    result(content_of("sky.ktx2") == content_of("free.ktx2"), "a texture below a ceiling");
    result(content_of("made.json").find("cube:gnomonic") != std::string::npos, "and its manifest",
           content_of("made.json"));
}

// ---- the mapping

void mappings()
{
    make_noise(64, 32, "noise.ppm");
    // faces of 16 pixels: of all mappings the longest pixel is that which is the shortest
    const Ran ran = does("reproject --mapping auto noise.ppm face_%f.png");
    const std::size_t at = ran.out.find("; mapping ");
    const std::string chosen = at == std::string::npos
                                   ? ""
                                   : ran.out.substr(at + 10, ran.out.find(',', at + 10) - at - 10);
    result(matches(ran.out, "\\(cube:" + chosen + ", frame geo, 16x16; .*whose longest pixel"),
           "a mapping, and why", ran.out);
    const auto size_of = [](const std::string &mapping)
    {
        does("reproject --quiet --keep max --mapping " + mapping + " noise.ppm size_%f.png");
        return Picture("size_0.png").width;
    };
    const int best = size_of(chosen);
    for (const char *mapping : {"gnomonic", "tangent", "coupled", "qsc", "unicube", "s2", "slice"})
    {
        result(size_of(mapping) * 1.05 >= best, std::string("needs no fewer pixels: ") + mapping);
    }
    // QSC has 1.109 pixels a radian and half an edge at least, beside its diagonals, where it has a crease: 2 * 64 / (2 pi) / 1.109
    result(size_of("qsc") == 19, "nothing is measured across a crease",
           std::to_string(size_of("qsc")));
    says("for labels", "\\(cube:[a-z-]+, .*; nearest; mapping [a-z-]+, of equal areas",
         "reproject --mapping auto --filter nearest noise.ppm label_%f.png");
    says("for a texture", "\\(cube:gnomonic, .*mapping gnomonic, which graphics",
         "reproject --mapping auto noise.ppm sky.ktx2");
    says("for YouTube's layout",
         "\\(cube:tangent, frame geo, eac .*mapping tangent, which the layout",
         "reproject --mapping auto --layout eac noise.ppm eac.png");
    says("from a cube", "\\(cube:qsc, frame gl, strip .*mapping qsc, that of INPUT",
         (does("reproject --quiet --mapping qsc noise.ppm cube_%f.png"),
          "reproject --mapping auto --frame gl --layout strip cube_%f.png strip.png"));
    fails("a mapping of something else", 2, "--to equirect says another",
          "reproject --mapping qsc --to equirect noise.ppm made/a.png");
    fails("a mapping of a program", 2, "--for unity says another",
          "reproject --mapping qsc --for unity noise.ppm made/a.png");
    fails("nearly a mapping", 2, "did you mean gnomonic",
          "reproject --mapping gnomnic noise.ppm made/a.png");
}

// ---- maps of HEALPix

void healpix_files()
{
#ifdef HAVE_CFITSIO
    make_noise(64, 32, "noise.ppm");
    does("reproject --quiet --filter bilinear --to healpix:16 noise.ppm picture.exr");
    for (const std::string order : {"", ":ring", ":nest"})
    {
        does("reproject --quiet --filter bilinear --to healpix:16" + order + " noise.ppm map.fits");
        does("reproject --quiet --to healpix:16 --stored map.fits again.tif");
        does("reproject --quiet --to healpix:16 --stored --filter bilinear noise.ppm direct.tif");
        passes("a FITS file, healpix:16" + order, "compare --max 0.003 again.tif direct.tif");
        const std::string head = content_of("map.fits").substr(0, 5760);
        result(matches(head, order == ":nest" ? "ORDERING= 'NESTED" : "ORDERING= 'RING"),
               "its order, healpix:16" + order);
    }
    says("a size of its own, and RING", "-> own\\.fits \\(healpix:16 192x16;",
         "reproject noise.ppm own.fits");
    does("reproject --quiet --rotate 10,20,30 noise.ppm turned.fits");
    says("how it stands",
         "^turned\\.fits \\(healpix:16 192x16, turned by 10,20,30, 3 channels, float",
         "reproject turned.fits back.png");
    does("reproject --quiet --to healpix:16:nest noise.ppm whole.fits");
    does("reproject --quiet --resume --to healpix:16:nest noise.ppm resumed.fits");
    passes("a FITS file of a run that can be resumed", "compare --max 0 whole.fits resumed.fits");
    fails("FITS of something else", 2, "map of HEALPix",
          "reproject --to equirect noise.ppm made/a.fits");
    fails("levels in FITS", 2, "has no levels", "reproject --mips noise.ppm made/a.fits");
    fails("an order that NSIDE has not", 1, "NSIDE 15 is no power of two",
          "reproject --to healpix:15:nest noise.ppm made/a.fits");
    const SizeLimit limit(1000);
    fails("a full disk and FITS", 1, "cannot be written: File too large",
          "reproject noise.ppm made/a.fits");
#endif
    make_noise(64, 32, "noise.ppm");
    fails("an order without FITS", 2, "only .fits files have an order",
          "reproject --to healpix:16:nest noise.ppm made/a.tif");
    fails("an order of INPUT", 2, "leave :ring out",
          "reproject --from healpix:16:ring noise.ppm made/a.tif");
}

} // namespace

const std::vector<Subject> &reproject_output_subjects()
{
    static const std::vector<Subject> subjects = {
        {"textures", textures}, {"texture_values", texture_values},
        {"refusals", refusals}, {"borders", borders},
        {"levels", levels},     {"together", together},
        {"mappings", mappings}, {"healpix_files", healpix_files}};
    return subjects;
}
