// SPDX-License-Identifier: MIT
//
// What files say of the surfaces that they show: tags, metadata of panoramas, rasters, sidecars.

#include "direction_image.hpp"
#include "image_cases.hpp"
#include "picture.hpp"
#include "picture_checks.hpp"
#include "tiff_file.hpp"

#include <cstdint>
#include <cstring>
#include <filesystem>

namespace
{

// The program must succeed, say one line on standard error that matches, and what it did.
Ran warns(const std::string &name, const std::string &expression, const std::string &line)
{
    const Ran ran = run(line);
    result(ran.status == 0 && matches(ran.err, expression) &&
               ran.err.find('\n') == ran.err.size() - 1,
           name, ran.err + ran.out);
    return ran;
}

// ---- what files say

void surface_tags()
{
    make_noise(64, 32, "noise.ppm");
    for (const std::string extension : {"png", "tif", "jpg", "exr", "ppm", "hdr"})
    {
        does(
            "reproject --quiet --to cube:qsc --frame gl --layout cross --rotate 10,20,30 noise.ppm "
            "cross." +
            extension);
        says("a tag in ." + extension,
             "^cross\\." + extension + " \\(cube:qsc, frame gl, cross 64x48, turned by 10,20,30,",
             "reproject cross." + extension + " back." + extension);
        const std::string again = describe_image("back." + extension);
        result(matches(again, "cubemap:surface=equirect;size=64;height=32") &&
                   !matches(again, "cube:qsc|cubemap:rotation"),
               "the tag is the output's own, ." + extension, again);
    }
    warns("what the command line says counts",
          "'cross.png' says that it is cube:qsc;frame=gl;layout=cross;size=16; it is taken as "
          "cube:coupled;",
          "reproject --quiet --from cube cross.png back.png");
    warns("turned otherwise", "turned by 10,20,30; it is taken as turned by 0,0,0",
          "reproject --quiet --from cube:qsc --from-frame gl cross.png back.png");
    fails("a shape that cannot be", 1, "must be 6N x N",
          "reproject --from cube --from-layout strip cross.png made/a.png");
    passes("the same in words", "reproject --quiet --from cube:qsc --from-frame gl --from-rotate "
                                "10,20,30 cross.png back.png");
    does("reproject --quiet noise.ppm face_%f.png");
    fails("one of six", 1, "one of six faces", "reproject face_0.png made/a.png");
    does("reproject --quiet --to cube:qsc noise.ppm other_%f.png");
    std::filesystem::copy_file("other_4.png", "face_4.png",
                               std::filesystem::copy_options::overwrite_existing);
    fails("faces of two cubes", 1,
          "'face_4.png' says that it is cube:qsc;.*, 'face_0.png' cube:coupled;",
          "reproject face_%f.png made/a.png");
    passes("unless the command line says what they are",
           "reproject --quiet --from cube:coupled face_%f.png back.png");
    make_constant(32, 16, 3, "uint8", 0.5f, "scaled.png",
                  {"cubemap:surface=cube:qsc;layout=cross"});
    const Ran ran = warns("a picture that was scaled", "but is 32 x 16; its shape counts",
                          "reproject scaled.png back_%f.png");
    result(matches(ran.out, "^scaled\\.png \\(equirect 32x16"), "is taken by its shape", ran.out);
    make_constant(32, 16, 3, "uint8", 0.5f, "people.tif", {"ImageDescription=Two people"});
    does("reproject --quiet people.tif strip.tif --layout strip");
    does("reproject --quiet strip.tif back.tif");
    const std::string text = describe_image("back.tif");
    result(matches(text, "ImageDescription=Two people\ncubemap:surface=equirect;") &&
               !matches(text, "layout=strip"),
           "what people have written stays", text);
}

// In comments of headers; and where there is no room for any.
void tags_in_headers()
{
    make_noise(64, 32, "noise.ppm");
    make_constant(64, 32, 1, "uint8", 0.5f, "grey.png");
    does("reproject --quiet --layout vcross grey.png grey.pgm");
    says("a tag of grey", "^grey\\.pgm \\(cube:coupled, frame geo, vcross 48x64,",
         "reproject grey.pgm back.png");
    does("reproject --quiet --layout vcross noise.ppm light.pfm");
    fails("PFM has no room for any", 1, "48 x 64, neither 2:1", "reproject light.pfm made/a.png");
    result(
        matches(run_with_input(content_of("noise.ppm"), "reproject --quiet --to equirect - -").out,
                "^P6\n64 32\n255\n"),
        "nor has a pipe");
    does("reproject --quiet --to cube:qsc --layout cross noise.ppm piped.ppm");
    const Ran piped = run_with_input(content_of("piped.ppm"), "reproject - back.png");
    result(matches(piped.out, "^standard input \\(cube:qsc, frame geo, cross 64x48,"),
           "a tag that comes through a pipe", piped.out + piped.err);
}

// Kinds of PNM that the image library reads, which passes over comments.
void tags_in_other_headers()
{
    const std::string tag = "cubemap:surface=equirect;west=0;east=170;south=-90;north=90\n";
    const auto lines_of = [](const std::string &line)
    {
        std::string all;
        for (int i = 0; i < 16; ++i)
        {
            all += line + "\n";
        }
        return all;
    };
    const auto repeated = [](const std::string &word)
    {
        std::string all;
        for (int i = 0; i < 32; ++i)
        {
            all += word;
        }
        return all;
    };
    const std::string coded[][3] = {
        {"P1", "", lines_of(repeated("1 "))},
        {"P2", "100\n", lines_of(repeated("50 "))},
        {"P3", "255\n", lines_of(repeated("1 2 3 "))},
        {"P4", "", lines_of(std::string(3, 'x'))},
        {"P5", "100\n", std::string(std::size_t{32} * 16, 'x')},
        {"P6", "300\n", std::string(std::size_t{32} * 16 * 6, '\1')},
    };
    for (const auto &[kind, maximum, pixels] : coded)
    {
        write_file("other.pnm",
                   kind + "\n# by hand\n32 # across\n# " + tag + "16\n" + maximum + pixels);
        says("a tag of " + kind, "\\(equirect;west=0;east=170 32x16,",
             "reproject other.pnm back_%f.png");
        write_file("other.pnm",
                   kind + "\n32 16\n" + maximum + (maximum.empty() ? "" : "# " + tag) + pixels);
        result(!matches(run("reproject --layout 3x2 other.pnm back.png").out, "west=0"),
               "what stands behind the header of " + kind + " is no tag");
    }
}

// A tag is read whole or not at all, from a file and through a pipe alike, whatever stands before it.
void tags_behind_comments()
{
    const std::string tag = "# cubemap:surface=equirect;west=0;east=170;south=-90;north=90\n";
    const std::string there = "\\(equirect;west=0;east=170 32x16,";
    const std::string pixels(std::size_t{32} * 16 * 3, 'x');
    const std::string comments[] = {"", "\n", "# " + std::string(10000, '-') + "\n"};
    for (const std::string &before : comments)
    {
        const std::string picture = "P6\n" + before + tag + "32 16\n255\n" + pixels;
        write_file("comment.ppm", picture);
        const std::string name = " behind " + std::to_string(before.size()) + " bytes";
        says("a tag of a file" + name, there, "reproject comment.ppm back_%f.png");
        const Ran piped = run_with_input(picture, "reproject --layout 3x2 - back.png");
        result(matches(piped.out, there), "a tag of a pipe" + name, piped.out + piped.err);
    }
    bool whole = true;
    for (std::size_t size = 940; size < 1030; size += 8)
    {
        const Ran piped = run_with_input("P6\n# cubemap:note=" + std::string(size, '-') + "\n" +
                                             tag + "32 16\n255\n" + pixels,
                                         "reproject --layout 3x2 - back.png");
        whole = whole && (matches(piped.out, there) || matches(piped.out, "\\(equirect 32x16,"));
    }
    result(whole, "a tag that does not fit is none");
    // of more lines, or longer ones, the image library reads no header
    for (const std::size_t size : {std::size_t{1000}, std::size_t{9000}})
    {
        write_file("light.hdr", "#?RADIANCE\n# " + std::string(size, '-') + "\n" + tag +
                                    "FORMAT=32-bit_rle_rgbe\n\n-Y 16 +X 32\n" +
                                    std::string(std::size_t{32} * 16 * 4, '\x40'));
        says("a tag of Radiance behind " + std::to_string(size) + " bytes", there,
             "reproject light.hdr back_%f.png");
    }
}

void photo_spheres()
{
    make_constant(40, 20, 3, "uint8", 0.5f, "part.jpg",
                  {"GPano:ProjectionType=equirectangular", "GPano:FullPanoWidthPixels=160",
                   "GPano:FullPanoHeightPixels=80", "GPano:CroppedAreaLeftPixels=80",
                   "GPano:CroppedAreaTopPixels=20", "GPano:CroppedAreaImageWidthPixels=40",
                   "GPano:CroppedAreaImageHeightPixels=20"});
    says("a part of a photo sphere",
         "^part\\.jpg \\(equirect;west=0;east=90;south=0;north=45 40x20,",
         "reproject part.jpg face_%f.png");
    does("reproject --quiet --to equirect --size 64 part.jpg whole.jpg");
    const std::string text = content_of("whole.jpg");
    result(matches(text.substr(text.find("<x:xmpmeta")), "GPano:ProjectionType=.equirectangular.*"
                                                         "GPano:FullPanoWidthPixels=.64"),
           "an equirectangular JPEG is one");
    const std::string face =
        (does("reproject --quiet part.jpg face_%f.jpg"), content_of("face_0.jpg"));
    result(face.find("GPano") == std::string::npos, "a face is none");
}

void georeferences()
{
    const std::vector<float> pixels(32, 0.5f);
    const TiffTag scale = doubles(33550, {10, 10, 0});
    const TiffTag tie = doubles(33922, {0, 0, 0, 20, 50, 0});
    write_tiff("area.tif", 8, 4, pixels, {scale, tie, geo_keys(2, 1, 2048, 4326)});
    says("placed by longitude and latitude",
         "^area\\.tif \\(equirect;west=20;east=100;south=10;north=50 8x4,",
         "reproject --to equirect --size 36 area.tif whole.tif");
    holds("it is where it says",
          []
          {
              check_pixel("whole.tif", 18 + 2, 4, {0.5});
              check_pixel("whole.tif", 18 + 9, 7, {0.5});
              check_pixel("whole.tif", 18 + 1, 4, {0});
              check_pixel("whole.tif", 18 + 5, 3, {0});
          });
    write_tiff("point.tif", 8, 4, pixels, {scale, tie, geo_keys(2, 2, 2048, 4326)});
    says("pixels that are points", "west=15;east=95;south=15;north=55 8x4,",
         "reproject --to equirect --size 36 point.tif out.tif");
    const double turned[] = {45, 0, 0, -180, 0, -45, 0, 90, 0, 0, 0, 0, 0, 0, 0, 1};
    write_tiff(
        "whole.tif", 8, 4, pixels,
        {doubles(34264, {std::begin(turned), std::end(turned)}), geo_keys(2, 1, 2048, 4326)});
    says("the whole Earth", "^whole\\.tif \\(equirect 8x4,", "reproject whole.tif face_%f.tif");
    write_tiff("utm.tif", 8, 4, pixels, {scale, tie, geo_keys(1, 1, 3072, 32632)});
    fails("placed in metres", 1, "by EPSG:32632; make it EPSG:4326 \\(gdalwarp",
          "reproject utm.tif made/a.tif");
    passes("unless --from says what it is", "reproject --quiet --from equirect utm.tif out.tif");
    // a web map of the north-eastern quarter: 20037508.342789244 is pi times the radius
    write_tiff("web.tif", 8, 8, std::vector<float>(64, 0.5f),
               {doubles(33550, {2504688.5428486555, 2504688.5428486555, 0}),
                doubles(33922, {0, 0, 0, 0, 20037508.342789244, 0}), geo_keys(1, 1, 3072, 3857)});
    says("placed as web maps are", "^web\\.tif \\(mercator;west=0;south=0 8x8",
         "reproject --to equirect --size 36 web.tif whole.tif");
    holds("it is where it says",
          []
          {
              check_pixel("whole.tif", 18 + 9, 4, {0.5});
              check_pixel("whole.tif", 9, 4, {0});
              check_pixel("whole.tif", 18 + 9, 12, {0});
          });
}

// A TIFF file of 8 x 4 pixels whose description is a tag, and that may be placed.
void write_tagged(const std::string &name, const std::string &tag, const std::vector<TiffTag> &more)
{
    std::vector<TiffTag> tags = more;
    tags.push_back(text(270, tag));
    write_tiff(name, 8, 4, std::vector<float>(32, 0.5f), tags);
}

const TiffTag part_scale = doubles(33550, {10, 10, 0});
const TiffTag part_tie = doubles(33922, {0, 0, 0, 20, 50, 0});

// What others have cut from a picture of ours, or moved, has our tag all the same.
void contradicted_tags()
{
    const std::string nearest = "reproject --to equirect --size 36 --filter nearest ";
    const std::string part = "\\(equirect;west=20;east=100;south=10;north=50 8x4,";
    const TiffTag degrees = geo_keys(2, 1, 2048, 4326);
    write_tagged("cut.tif", "cubemap:surface=equirect;size=36;height=18",
                 {part_scale, part_tie, degrees});
    const Ran cut = warns("a cut raster is where its georeference has it",
                          "'cut.tif' says that it is equirect;size=36;height=18, and its "
                          "georeference that it is equirect;west=20;.*; the georeference counts",
                          nearest + "cut.tif whole.tif");
    result(matches(cut.out, "^cut\\.tif " + part), "and not the whole", cut.out);
    holds("it is where it says",
          []
          {
              check_pixel("whole.tif", 18 + 2, 4, {0.5});
              check_pixel("whole.tif", 18 + 1, 4, {0});
          });
    write_tagged("moved.tif", "cubemap:surface=equirect;size=8;height=4",
                 {part_scale, part_tie, degrees});
    warns("a moved one, too", "the georeference counts", nearest + "moved.tif whole.tif");
    write_tagged("turned.tif",
                 "cubemap:surface=equirect;size=8;height=4\ncubemap:rotation=10,20,30",
                 {doubles(33550, {45, 45, 0}), doubles(33922, {0, 0, 0, -180, 90, 0}), degrees});
    warns("a turned one", "the georeference counts", nearest + "turned.tif whole.tif");
    write_tagged("same.tif",
                 "cubemap:surface=equirect;west=20;east=100;south=10;north=50.0001;size=8;height=4",
                 {part_scale, part_tie, degrees});
    says("both say the same", "^same\\.tif \\(equirect;west=20;", nearest + "same.tif whole.tif");
    passes("and nobody complains", "reproject --quiet --to equirect --size 36 same.tif whole.tif");
    write_tagged("utm.tif", "cubemap:surface=equirect;size=8;height=4",
                 {part_scale, part_tie, geo_keys(1, 1, 3072, 32632)});
    fails("a raster in metres is not what its tag says", 1, "by EPSG:32632; make it EPSG:4326",
          "reproject utm.tif made/a.tif");
}

// The tag and the georeference of one picture say the same, whatever is rounded.
void agreeing_tags()
{
    make_noise(64, 32, "noise.ppm");
    for (const std::string to :
         {"equirect;size=64", "mercator;size=64",
          "mercator;west=12;east=28;south=42;north=48;size=20",
          "equirect;west=170.123456789;east=193.3333333333;south=-7.77;north=12.34567;size=33"})
    {
        does("reproject --quiet --georeference --to " + to + " noise.ppm both.tif");
        passes("both are written of " + to,
               "reproject --quiet --to equirect --size 64 both.tif out.png");
    }
}

void unknown_units()
{
    const std::string nearest = "reproject --to equirect --size 36 --filter nearest ";
    const std::vector<float> pixels(32, 0.5f);
    write_tiff("bare.tif", 8, 4, pixels, {part_scale, part_tie});
    fails(
        "numbers without keys", 1,
        "'bare.tif' is placed on the Earth by numbers without a system of coordinates; say --from "
        "'equirect;west=20;east=100;south=10;north=50' if they are degrees, or give it a system",
        "reproject bare.tif made/a.tif");
    passes("unless --from says what they are",
           "reproject --quiet --from equirect;west=20;east=100;south=10;north=50 --to equirect "
           "--size 36 bare.tif whole.tif");
    write_tiff("far.tif", 8, 4, pixels, {part_scale, doubles(33922, {0, 0, 0, 4e5, 5e6, 0})});
    fails("those that cannot be degrees", 1, "say --from SPEC, what it covers in degrees, or give",
          "reproject far.tif made/a.tif");
    write_tiff("points.tif", 8, 4, pixels,
               {doubles(33922, {0, 0, 0, 20, 50, 0, 8, 4, 0, 100, 10, 0})});
    fails("several points", 1, "by several points; say --from SPEC",
          "reproject points.tif made/a.tif");
    const TiffTag around = doubles(33922, {0, 0, 0, -180, 90, 0});
    write_tiff("whole.tif", 8, 4, pixels, {doubles(33550, {45, 45, 0}), around});
    says("degrees of the whole sphere are known", "^whole\\.tif \\(equirect 8x4,",
         nearest + "whole.tif out.tif");
    write_tiff("pixels.tif", 8, 4, pixels,
               {doubles(33550, {1, 1, 0}), doubles(33922, {0, 0, 0, 0, 0, 0})});
    says("numbers of pixels place nothing", "^pixels\\.tif \\(equirect 8x4,",
         nearest + "pixels.tif out.tif");
    const std::string ignored = "; they are ignored, unless --from says what it covers";
    const std::string plainly = "reproject --quiet --layout 3x2 ";
    write_tiff("low.tif", 200, 100, std::vector<float>(20000, 0.5f),
               {doubles(33550, {1, 1, 0}), doubles(33922, {0, 0, 0, 0, 100, 0})});
    warns("pixels that are counted from the bottom", "coordinates of pixels.*" + ignored,
          plainly + "low.tif out.tif");
    write_tiff("up.tif", 8, 4, pixels,
               {doubles(34264, {100, 0, 0, 4e5, 0, 100, 0, 5e6, 0, 0, 0, 0, 0, 0, 0, 1})});
    const Ran up = warns("rows that go up", "'up.tif' has coordinates that go up.*" + ignored,
                         "reproject --layout 3x2 up.tif out.tif");
    result(matches(up.out, "^up\\.tif \\(equirect 8x4,"), "are no geography", up.out);
    write_tiff("east.tif", 8, 4, pixels,
               {doubles(33550, {45, 45, 0}), doubles(33922, {0, 0, 0, 0, 90, 0})});
    says("degrees of the whole sphere from 0 to 360",
         "^east\\.tif \\(equirect;west=0;east=360 8x4,", "reproject --layout 3x2 east.tif out.tif");
    fails("metres", 1, "give it the system that they are of \\(gdal_edit.py -a_srs EPSG:CODE\\)",
          "reproject far.tif made/a.tif");
    write_tagged("same.tif",
                 "cubemap:surface=equirect;west=20;east=100;south=10;north=50;size=8;height=4",
                 {part_scale, part_tie});
    says("a tag may say that they are degrees", "^same\\.tif \\(equirect;west=20;east=100;",
         nearest + "same.tif out.tif");
    write_tagged("other.tif", "cubemap:surface=equirect;size=8;height=4", {part_scale, part_tie});
    fails("but not that they are others", 1, "without a system of coordinates",
          "reproject other.tif made/a.tif");
}

void missing_faces()
{
    make_noise(32, 32, "face_0.ppm");
    fails("a name with %f of what is said to be one image", 1,
          "but 'face_0.ppm' is; --from says that it is one image; layout=faces stands for six",
          "reproject --from cube;layout=cross face_%f.ppm made/a.png");
}

// Of a tag whose size is not the picture's.
void sizes_in_tags()
{
    const auto tagged = [](int width, int height, const std::string &specification)
    {
        make_constant(width, height, 3, "uint8", 0.5f, "edited.png",
                      {"cubemap:surface=" + specification});
    };
    tagged(32, 16, "equirect;size=64;height=32");
    warns("a picture that was scaled, or cut to the same shape",
          "'edited.png' says that it is equirect;size=64;height=32, but is 32 x 16; it is taken as "
          "scaled; if it is a part, say --from 'equirect;west=W;east=E;south=S;north=N'",
          "reproject --quiet edited.png back_%f.png");
    tagged(33, 17, "equirect;size=64;height=32");
    warns("edges are rounded when scaled", "taken as scaled",
          "reproject --quiet edited.png back_%f.png");
    tagged(48, 12, "cube:qsc;frame=gl;layout=vcross;size=8");
    fails("what is no layout any more", 1, "neither 2:1", "reproject edited.png made/a.png");
    tagged(36, 48, "cube:qsc;frame=gl;layout=vcross;size=8");
    warns("a cube", "taken as scaled; if it is a part, say --from SPEC",
          "reproject --quiet edited.png back.png");
    tagged(32, 32, "equirect;size=64;height=32");
    fails("a picture that was cut", 1, "neither 2:1 .*say --from equirect if it is that",
          "reproject edited.png made/a.png");
    tagged(32, 16, "equirect;west=0;east=90;south=0;north=90;size=32;height=32");
    warns("a part that was cut", "but is 32 x 16; its shape counts, unless --from says otherwise",
          "reproject --quiet edited.png back_%f.png");
    // as by who cuts a panorama of ours and knows of its fields
    const std::vector<std::string> fields = {
        "GPano:ProjectionType=equirectangular", "GPano:FullPanoWidthPixels=160",
        "GPano:FullPanoHeightPixels=80",        "GPano:CroppedAreaLeftPixels=80",
        "GPano:CroppedAreaTopPixels=20",        "GPano:CroppedAreaImageWidthPixels=40",
        "GPano:CroppedAreaImageHeightPixels=20"};
    std::vector<std::string> both = fields;
    both.emplace_back("ImageDescription=cubemap:surface=equirect;size=160;height=80");
    make_constant(40, 20, 3, "uint8", 0.5f, "part.jpg", both);
    says("fields of a photo sphere that fit", "^part\\.jpg \\(equirect;west=0;east=90;south=0;",
         "reproject part.jpg face_%f.png");
    make_constant(20, 20, 3, "uint8", 0.5f, "part.jpg", fields);
    fails("a photo sphere that was cut by who does not know of them", 1, "neither 2:1",
          "reproject part.jpg made/a.png");
    make_constant(20, 10, 3, "uint8", 0.5f, "part.jpg", fields);
    const Ran small = warns("or scaled", "says that it is equirect;.*, but is 20 x 10; it is taken",
                            "reproject part.jpg face_%f.png");
    result(matches(small.out, "^part\\.jpg \\(equirect;west=0;east=90;south=0;north=45 20x10,"),
           "is where it was", small.out);
}

// Where the file's own tag of the surface is not understood, its georeference counts.
void without_tag(const std::string &name)
{
    std::string content = content_of(name);
    const std::size_t at = content.find("cubemap:surface");
    result(at != std::string::npos, "there is a tag in " + name);
    content.replace(at, 7, "another");
    write_file(name, content);
}

void written_georeferences()
{
    make_noise(64, 32, "noise.ppm");
    const std::string to = "reproject --quiet --georeference --to ";
    does(to + "equirect --size 64 noise.ppm whole.tif");
    without_tag("whole.tif");
    says("the whole Earth", "^whole\\.tif \\(equirect 64x32,", "reproject whole.tif back_%f.png");
    does(to + "equirect;west=10;east=30;south=40;north=50;size=20 noise.ppm part.tif");
    does("reproject --quiet --to equirect --size 64 part.tif part.png");
    without_tag("part.tif");
    says("a part", "^part\\.tif \\(equirect;west=10;east=30;south=40;north=50 20x10,",
         "reproject --to mercator;west=12;east=28;south=42;north=48;size=20 part.tif web.tif");
    without_tag("web.tif");
    says("what had a georeference has one again, of web maps",
         "^web\\.tif \\(mercator;west=12;east=28;south=42;north=48(\\.000000000000*[0-9]*)? 20x",
         "reproject --to equirect --size 64 web.tif back.png");
    does("reproject --quiet --to equirect --size 64 noise.ppm plain.tif");
    without_tag("plain.tif");
    does("reproject --quiet --layout strip plain.tif strip.tif");
    result(content_of("plain.tif").find(bytes_of(std::uint16_t{34735})) == std::string::npos,
           "else there is none");
    fails("of a cube", 2, "OUTPUT is cube:coupled",
          "reproject --georeference noise.ppm made/a_%f.tif");
    fails("of what is turned", 2, "that are not turned",
          "reproject --georeference --rotate 1,2 --to equirect noise.ppm made/a.tif");
    fails("of a format without", 2, "is for TIFF files",
          "reproject --georeference --to equirect noise.ppm made/a.png");
}

// What people have: each is done, or refused in one line with what would help.
void odd_pictures()
{
    make_noise(64, 32, "noise.ppm");
    does("reproject --quiet noise.ppm face_%f.png");
    std::filesystem::remove("face_3.png");
    fails("a face is missing", 1,
          "'face_3.png' cannot be read: No such file or directory; all six faces are needed, "
          "'face_0.png' to 'face_5.png'",
          "reproject face_%f.png made/a.png");
    fails("six faces by the name of none", 1, "'face_0.png' is; 'face_%f.png' stands for six",
          "reproject face.png made/a.png");
    make_constant(16, 16, 1, "uint8", 0.5f, "face_3.png");
    fails("a face of gray", 1, "16 x 16 with 1 channel, .* alike",
          "reproject face_%f.png made/a.png");
    for (const int channels : {1, 2, 5, 70})
    {
        std::vector<std::string> none;
        make_constant(64, 32, channels, "float", 0.25f, "many.tif", none);
        make_constant(16, 16, channels, "float", 0.25f, "wanted.tif", none);
        says(std::to_string(channels) + " channels",
             channels == 1 ? "1 channel, " : "channels, float", "reproject many.tif many_%f.tif");
        if (channels < 64) // what compare takes
        {
            passes("each of them", "compare --max 1e-6 many_4.tif wanted.tif");
        }
        holds("and their values",
              [channels]
              {
                  check_pixel("many_4.tif", 7, 9,
                              std::vector<double>(static_cast<std::size_t>(channels), 0.25));
              });
    }
    fails("more than a format holds", 1, "PNG holds 1 to 4 channels, the image has 70",
          "reproject --to equirect many.tif made/a.png");
    fails("vectors of so many", 1, "64 at most can be resampled with a vector",
          "reproject --to equirect --vector 1 many.tif made/a.tif");
    std::string text = "P6\n300000 150000\n255\n";
    write_file("huge.ppm", text);
    const Ran ran = run("reproject huge.ppm huge.png --to equirect --size 64");
    result(ran.status == 1 && matches(ran.err, "GB of memory"), "135 GB in 24 bytes", ran.err);
}

void sidecars()
{
    make_noise(64, 32, "noise.ppm");
    does("reproject --quiet --sidecar --filter nearest --for opengl noise.ppm sky_%f.png");
    const std::string text = content_of("sky.json");
    result(matches(text, "\"surface\": \"cube:gnomonic;frame=gl;layout=faces;size=16\"") &&
               matches(text, "\"rotation\": \\[90,0,90\\]") &&
               matches(text, "\"sky_0.png\", .*\"sky_5.png\"") &&
               matches(text, "\"filter\": \"nearest\""),
           "a file beside the pictures", text);
    does("reproject --quiet --sidecar noise.ppm --layout strip strip.hdr");
    result(std::filesystem::exists("strip.json"), "for formats without tags, too");
    does("reproject --quiet --sidecar noise.ppm --to cube:qsc --frame gl --layout vcross --rotate "
         "10,20,30 turned.pfm");
    const std::string wanted = "\\(cube:qsc, frame gl, vcross 48x64, turned by 10,20,30,";
    says("and is read again", "^turned\\.pfm " + wanted, "reproject turned.pfm back.png");
    warns("the command line counts more",
          "'turned\\.json' says that 'turned\\.pfm' is cube:qsc;frame=gl;layout=vcross;size=16; it "
          "is taken as cube:coupled;",
          "reproject --quiet --from cube --from-layout vcross turned.pfm back.png");
    std::filesystem::rename("turned.pfm", "other.pfm");
    fails("a file that does not name the picture says nothing", 1, "neither 2:1",
          "reproject other.pfm made/a.png");
    says("unless --from names it", "^other\\.pfm " + wanted,
         "reproject --from turned.json other.pfm back.png");
    says("and --from-rotate says otherwise", "turned by 1,2,3,",
         "reproject --from-rotate 1,2,3 --from turned.json other.pfm back.png");
    const std::string before = content_of("turned.json");
    fails("--sidecar does not replace what --from reads", 2, "'made/../turned.json' is the file of",
          "reproject --sidecar --from turned.json other.pfm made/../turned.png");
    does("reproject --quiet --sidecar noise.ppm six_%f.pfm --frame s2");
    fails("nor what the pictures are known by", 2, "'six.json' is the file that says what INPUT is",
          "reproject --sidecar six_%f.pfm six.png");
    fails("nor does a manifest", 2, "'six.json' is the file that says what INPUT is",
          "reproject --manifest six.json six_%f.pfm made/a.png");
    fails("nor one of six pictures", 2, "'six_3.pfm' is INPUT, too",
          "reproject --manifest six_3.pfm six_%f.pfm made/a.png");
    result(content_of("turned.json") == before, "all of them stay");
    says("of six pictures", "^six_0.pfm .. six_5.pfm \\(cube:coupled, frame s2, 16x16,",
         "reproject six_%f.pfm back.png");
    does("reproject --quiet --to equirect --size 32 noise.ppm turned.pfm");
    warns("a picture that was scaled", "but that is 32 x 16; its shape counts",
          "reproject --quiet turned.pfm back_%f.png");
    does("reproject --quiet --sidecar --layout cross noise.ppm cross.png");
    std::string other = content_of("cross.json");
    other.replace(other.find("coupled"), 7, "qsc");
    write_file("cross.json", other);
    warns("what the picture says counts",
          "'cross\\.png' says that it is cube:coupled;.*, and 'cross\\.json' cube:qsc;",
          "reproject --quiet cross.png back.png");
    write_file("written.json",
               "{\"other\": {\"a\": [[1], {}, null]}, \"note\": \"\\u00e9\\u20ac\\n\",\n"
               " \"surface\":\"cube:qs\\u0063;layout=vcross\", \"rotation\": [ 0, 0.0, -0e1 ] }");
    says("as others write it", "\\(cube:qsc, frame geo, vcross 48x64,",
         "reproject --from written.json --from-frame geo other.pfm back.png");
    write_file("bad.json", "{\"surface\": \"cube:nothing\"}");
    for (const std::string broken : {"", "[]", "{", "{\"a\" 1}", "{\"a\": yes}", "{\"a\": \"\\q\"}",
                                     "{\"a\": \"\\u12\"}", "{\"a\": [1}", "{} 1"})
    {
        write_file("bad.json", broken + "\n");
        fails("JSON that is none: " + broken, 1, "'bad.json' says no surface",
              "reproject --from bad.json noise.ppm made/a.png");
    }
    write_file("bad.json", "{\"surface\": \"cube:nothing\"}");
    fails("a file that says nothing", 1, "'bad.json' says no surface",
          "reproject --from bad.json noise.ppm made/a.png");
    fails("a file that is not there", 1, "'no.json' cannot be read: No such file",
          "reproject --from no.json noise.ppm made/a.png");
    write_file("cross.json", "{\"pictures\": [\"cross.png\"], \"surface\": ");
    passes("a file beside that is none", "reproject --quiet cross.png back.png");
}

} // namespace

const std::vector<Subject> &reproject_tag_subjects()
{
    static const std::vector<Subject> subjects = {{"surface_tags", surface_tags},
                                                  {"tags_in_headers", tags_in_headers},
                                                  {"photo_spheres", photo_spheres},
                                                  {"georeferences", georeferences},
                                                  {"missing_faces", missing_faces},
                                                  {"tags_in_other_headers", tags_in_other_headers},
                                                  {"tags_behind_comments", tags_behind_comments},
                                                  {"contradicted_tags", contradicted_tags},
                                                  {"agreeing_tags", agreeing_tags},
                                                  {"unknown_units", unknown_units},
                                                  {"sizes_in_tags", sizes_in_tags},
                                                  {"written_georeferences", written_georeferences},
                                                  {"odd_pictures", odd_pictures},
                                                  {"sidecars", sidecars}};
    return subjects;
}
