// SPDX-License-Identifier: MIT
//
// Rasters that GDAL reads: placed in any way, with values that are missing, and beyond the whole sphere.

#include "image_cases.hpp"
#include "picture.hpp"
#include "picture_checks.hpp"
#include "tiff_file.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace
{

void expect(bool good, const std::string &what)
{
    if (!good)
    {
        throw std::runtime_error(what);
    }
}

bool has_gdal(const std::string &name)
{
    const bool has = open_gdal();
    if (!has)
    {
        result(true, name + " # SKIP GDAL is not built in");
    }
    return has;
}

// GDAL's virtual format over area.img: a system, where it is, a type and what the band has.
void write_virtual(const std::string &name, const std::string &system, const std::string &transform,
                   const std::string &type, const std::string &band)
{
    write_file(name, "<VRTDataset rasterXSize=\"8\" rasterYSize=\"4\"><SRS>" + system +
                         "</SRS><GeoTransform>" + transform +
                         "</GeoTransform><VRTRasterBand dataType=\"" + type + "\" band=\"1\">" +
                         band +
                         "<SimpleSource><SourceFilename relativeToVRT=\"1\">area.img"
                         "</SourceFilename><SourceBand>1</SourceBand></SimpleSource>"
                         "</VRTRasterBand></VRTDataset>\n");
}

void virtual_rasters()
{
    const std::string degrees = "20, 10, 0, 50, 0, -10";
    const std::string nearest = "reproject --to equirect --size 36 --filter nearest ";
    write_virtual("web.vrt", "EPSG:3857", "0, 1000000, 0, 4000000, 0, -1000000", "Byte", "");
    says("web maps", "^web\\.vrt \\(mercator;west=0;east=71\\.8", nearest + "web.vrt out.png");
    write_virtual("moon.vrt", "+proj=longlat +a=1737400 +b=1737400 +no_defs", degrees, "UInt16",
                  "");
    says("another body", "^moon\\.vrt \\(equirect;west=20;.*, 1 channel, uint16\\)",
         nearest + "moon.vrt out.png");
    says("of 16 bits are compared, too", "^maximum  *0 grey levels",
         "compare -m max --surface equirect;west=20;east=100;south=10;north=50 moon.vrt moon.vrt");
    write_virtual("turned.vrt", "EPSG:4326", "20, 5, 5, 50, 5, -5", "Byte", "");
    says("turned rasters", "^turned\\.vrt \\(equirect;west=", nearest + "turned.vrt out.png");
    write_virtual("none.vrt", "EPSG:4326", degrees, "Float32", "<NoDataValue>72</NoDataValue>");
    says("no data is left out", "1 value that is not finite kept", nearest + "none.vrt out.tif");
    write_virtual(
        "colors.vrt", "EPSG:4326", degrees, "Byte",
        "<ColorInterp>Palette</ColorInterp><ColorTable>" +
            []
            {
                std::string entries;
                for (int i = 0; i < 256; ++i)
                {
                    entries += "<Entry c1=\"" + std::to_string(255 - i) + "\" c2=\"" +
                               std::to_string(i) + "\" c3=\"17\" c4=\"255\"/>";
                }
                return entries;
            }() +
            "</ColorTable>");
    says("a palette", "3 channels, uint8", nearest + "colors.vrt out.png");
    holds("is colours",
          [] {
              check_pixel("out.png", 18 + 3, 5, {183 / 255.0, 72 / 255.0, 17 / 255.0});
          });
    write_virtual("far.vrt", "EPSG:32633", "1e12, 1, 0, 1e12, 0, -1", "Byte", "");
    fails("a place that is none", 1, "and it cannot be warped to EPSG:4326",
          "reproject far.vrt made/a.png");
    write_virtual("bare.vrt", "", degrees, "Byte", "");
    fails(
        "a raster in nobody knows what", 1,
        "'bare.vrt' is placed on the Earth by numbers without a system of coordinates; say --from "
        "'equirect;west=20;east=100;south=10;north=50' if",
        "reproject bare.vrt made/a.png");
    write_virtual("nowhere.vrt", "", "0, 1, 0, 0, 0, 1", "Byte", "");
    says("a raster that is not placed", "^nowhere\\.vrt \\(equirect 8x4",
         nearest + "nowhere.vrt out.png");
}

// Of Earth's systems by GDAL, where it is.
void rasters()
{
    if (!has_gdal("rasters"))
    {
        return;
    }
    // from 9 E, 45.15 N: EPSG:32632 has 500 km at its middle, 9 E
    const TiffTag scale = doubles(33550, {10000, 10000, 0});
    const TiffTag tie = doubles(33922, {0, 0, 0, 500000, 5000000, 0});
    write_tiff("utm.tif", 32, 16, std::vector<float>(std::size_t{32} * 16, 0.5f),
               {scale, tie, geo_keys(1, 1, 3072, 32632)});
    write_tiff("tagged.tif", 8, 4, std::vector<float>(32, 0.5f),
               {scale, tie, geo_keys(1, 1, 3072, 32632),
                text(270, "cubemap:surface=equirect;size=8;height=4")});
    says("whatever its tag says", "^tagged\\.tif \\(equirect;west=(8\\.9|9)",
         "reproject --to equirect --size 36 --filter nearest tagged.tif out.tif");
    const std::string part = "equirect;west=8;east=14;south=43;north=46;size=60";
    says("a raster in metres is warped",
         "^utm\\.tif \\(equirect;west=(8\\.9|9).*, 1 channel, float\\)",
         "reproject --filter bilinear --to " + part + " utm.tif part.tif");
    holds("to where it is",
          []
          {
              check_pixel("part.tif", 15, 11, {0.5}); // 9.55 E, 44.85 N
              check_pixel("part.tif", 4, 11, {0});
              check_pixel("part.tif", 15, 4, {0});
          });
    write_tiff("plain.tif", 32, 16, std::vector<float>(std::size_t{32} * 16, 0.5f));
    for (const std::string other : {"utm.tif", "plain.tif"})
    {
        passes("rasters of one size are compared as they stand, in metres, too: " + other,
               "compare --max 0 utm.tif " + other);
    }
    says("on the sphere where they are", "^maximum  *(0\\.?[0-9]*|[0-9.]*e-0[7-9]) ",
         "compare -m max --skip-not-finite --reference-surface " + part + " part.tif utm.tif");
    std::string pixels;
    for (int i = 0; i < 32; ++i)
    {
        pixels += static_cast<char>(8 * i);
    }
    write_file("area.img", pixels);
    write_file("area.hdr",
               "ENVI\nsamples = 8\nlines = 4\nbands = 1\nheader offset = 0\nfile type = ENVI "
               "Standard\ndata type = 1\ninterleave = bsq\nbyte order = 0\nmap info = {Geographic "
               "Lat/Lon, 1, 1, 20, 50, 10, 10, WGS-84}\n");
    says("a format of GDAL alone",
         "^area\\.img \\(equirect;west=20;east=100;south=10;north=50 8x4, 1 channel, uint8\\)",
         "reproject --to equirect --size 36 --filter nearest area.img whole.png");
    says("which are compared, too", "^maximum  *0 grey levels",
         "compare -m max --surface equirect;west=20;east=100;south=10;north=50 area.img area.img");
    holds("and its pixels", [] { check_pixel("whole.png", 18 + 3, 5, {8 * 9 / 255.0}); });
    virtual_rasters();
    write_file("no.img", "nothing");
    fails("what GDAL does not read either", 1,
          "is not an image that can be read: .*, and it is not a raster that GDAL reads",
          "reproject no.img made/a.png");
}

// Bytes that are all the same, in a virtual raster of that size.
void write_even(const std::string &name, int width, int height, const std::string &system,
                const std::string &transform, const std::string &band, char value)
{
    const std::string size = std::to_string(width);
    write_file(name + ".raw", std::string(std::size_t(width) * std::size_t(height), value));
    write_file(name, "<VRTDataset rasterXSize=\"" + size + "\" rasterYSize=\"" +
                         std::to_string(height) + "\"><SRS>" + system + "</SRS><GeoTransform>" +
                         transform +
                         "</GeoTransform><VRTRasterBand dataType=\"Byte\" band=\"1\" "
                         "subClass=\"VRTRawRasterBand\">" +
                         band + "<SourceFilename relativeToVRT=\"1\">" + name +
                         ".raw</SourceFilename><PixelOffset>1</PixelOffset><LineOffset>" + size +
                         "</LineOffset></VRTRasterBand></VRTDataset>\n");
}

// What is shown has that value, and that many pixels at least are shown, and not.
void check_even(const std::string &name, float value, int least)
{
    const Picture picture(name);
    int shown = 0, hidden = 0;
    expect(picture.channels == 2, "channels: " + std::to_string(picture.channels));
    for (int i = 0; i < picture.width * picture.height; ++i)
    {
        const float *const pixel = picture.at(i % picture.width, i / picture.width);
        const bool is_shown = pixel[1] > 0.1f;
        shown += is_shown;
        hidden += pixel[1] == 0;
        expect(!is_shown || std::fabs(pixel[0] - value) < 0.01f,
               "a value of " + std::to_string(pixel[0]) + ", alpha " + std::to_string(pixel[1]));
    }
    expect(shown >= least && hidden >= least,
           std::to_string(shown) + " are shown, " + std::to_string(hidden) + " are not");
}

// No pixel of a raster that turns on the way has what the corners beside it have not.
void gaps()
{
    if (!has_gdal("gaps"))
    {
        return;
    }
    const std::string part = "equirect;west=5;east=30;south=38;north=54;size=250 ";
    write_even("even.vrt", 60, 40, "EPSG:32633", "200000, 15000, 0, 5700000, 0, -15000", "",
               '\xc8');
    for (const std::string filter : {"bilinear", "lanczos3", "bspline5", "ewa"})
    {
        does("reproject --filter " + filter + " --to " + part + "even.vrt even.png");
        holds("nothing of the corners is mixed in by " + filter,
              [] { check_even("even.png", 200 / 255.f, 1000); });
    }
    write_tiff("floats.tif", 60, 40, std::vector<float>(2400, 0.75f),
               {doubles(33550, {15000, 15000, 0}), doubles(33922, {0, 0, 0, 200000, 5700000, 0}),
                geo_keys(1, 1, 3072, 32633)});
    write_even("words.vrt", 60, 40, "EPSG:32633", "200000, 15000, 0, 5700000, 0, -15000", "", 0);
    std::string words = content_of("words.vrt");
    words.replace(words.find("Byte"), 4, "Int16");
    words.replace(words.find("<PixelOffset>1"), 14, "<PixelOffset>2"); // rows overlap, all zeros
    write_file("words.vrt", words);
    does("reproject --filter nearest --not-finite spread --to " + part + "words.vrt words.exr");
    holds("numbers with a sign are values where they are 0",
          []
          {
              const Picture picture("words.exr");
              const auto missing = std::count_if(picture.values.begin(), picture.values.end(),
                                                 [](float value) { return std::isnan(value); });
              expect(missing > 0 && missing < static_cast<long>(picture.values.size()) / 4,
                     std::to_string(missing) + " are missing");
          });
    says("corners of floats are no values", "values that are not finite skipped",
         "reproject --filter lanczos3 --to " + part + "floats.tif floats.exr");
    holds("and are not mixed in",
          []
          {
              const Picture picture("floats.exr");
              for (const float value : picture.values)
              {
                  expect(!(std::fabs(value) > 0.001f && std::fabs(value - 0.75f) > 0.001f),
                         "a value of " + std::to_string(value));
              }
          });
}

// Values that stand for none, whether GDAL alone reads the file or not.
void missing_values()
{
    if (!has_gdal("missing_values"))
    {
        return;
    }
    const std::string wide = "reproject --filter lanczos3 --to equirect --size 144 ";
    std::vector<float> values(36 * 18, 0.5f);
    std::string bytes(36 * 18, '\xc8');
    for (int i = 0; i < 40; ++i)
    {
        values[std::size_t(36 * (7 + i / 10) + 12 + i % 10)] = -9999;
        bytes[std::size_t(36 * (7 + i / 10) + 12 + i % 10)] = 0;
    }
    write_tiff("missing.tif", 36, 18, values,
               {doubles(33550, {10, 10, 0}), doubles(33922, {0, 0, 0, -180, 90, 0}),
                geo_keys(2, 1, 2048, 4326), text(42113, "-9999")});
    says("the value for none of a TIFF file", "40 values that are not finite skipped",
         wide + "missing.tif missing.exr");
    holds("is not mixed",
          []
          {
              const Picture picture("missing.exr");
              for (const float value : picture.values)
              {
                  expect(!(std::fabs(value - 0.5f) > 0.001f) || value == 0,
                         "a value of " + std::to_string(value));
              }
          });
    write_even("bytes.vrt", 36, 18, "EPSG:4326", "-180, 10, 0, 90, 0, -10",
               "<NoDataValue>0</NoDataValue>", 0);
    write_file("bytes.vrt.raw", bytes);
    says("bytes that stand for none", "2 channels, uint8", wide + "bytes.vrt bytes.png");
    holds("are clear", [] { check_even("bytes.png", 200 / 255.f, 200); });
}

// Grids whose first and last column are the same meridian, or whose rows stand on the poles.
void beyond_the_sphere()
{
    if (!has_gdal("beyond_the_sphere"))
    {
        return;
    }
    const std::string nearest = "reproject --to equirect --size 36 --filter nearest ";
    std::vector<float> values;
    for (int i = 0; i < 37 * 18; ++i)
    {
        values.push_back(static_cast<float>(i % 37 % 36));
    }
    const TiffTag degrees = geo_keys(2, 1, 2048, 4326), scale = doubles(33550, {10, 10, 0});
    write_tiff("twice.tif", 37, 18, values,
               {scale, doubles(33922, {0, 0, 0, -180, 90, 0}), degrees});
    says("a column too many", "^twice\\.tif \\(equirect 36x18", nearest + "twice.tif out.exr");
    holds("is left out",
          []
          {
              check_pixel("out.exr", 0, 5, {0});
              check_pixel("out.exr", 35, 5, {35});
          });
    write_tiff("nodes.tif", 37, 19, std::vector<float>(37 * 19, 0.5f),
               {scale, doubles(33922, {0, 0, 0, -185, 95, 0}), degrees});
    says("rows on the poles", "^nodes\\.tif \\(equirect;west=-185;east=175 36x18",
         nearest + "nodes.tif out.exr");
    holds("and all around", [] { check_pixel("out.exr", 0, 0, {0.5}); });
    write_tiff("web.tif", 38, 36, std::vector<float>(38 * 36, 0.5f),
               {doubles(33550, {1113194.9079327357, 1113194.9079327357, 0}),
                doubles(33922, {0, 0, 0, -20037508.342789244, 20037508.342789244, 0}),
                geo_keys(1, 1, 3072, 3857)});
    says("a web map", "^web\\.tif \\(mercator[^ ]* 36x36", nearest + "web.tif out.exr");
    write_even("datum.vrt", 362, 180, "+proj=eqc +datum=WGS84",
               "-20148827.8, 111319.490793, 0, "
               "10018754.2, 0, -111319.490793",
               "", '\xc8');
    says("and what is so when it has been warped", "^datum\\.vrt \\(equirect",
         nearest + "datum.vrt out.png");
}

} // namespace

const std::vector<Subject> &reproject_raster_subjects()
{
    static const std::vector<Subject> subjects = {{"rasters", rasters},
                                                  {"gaps", gaps},
                                                  {"missing_values", missing_values},
                                                  {"beyond_the_sphere", beyond_the_sphere}};
    return subjects;
}
