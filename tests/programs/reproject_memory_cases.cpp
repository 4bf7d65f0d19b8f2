// SPDX-License-Identifier: MIT
//
// Pictures that do not fit into what the program may take of memory, work that was interrupted, and manifests.

#include "direction_image.hpp"
#include "image_cases.hpp"
#include "picture.hpp"

#include "tools/cli/progress.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <zlib.h>

namespace
{

// As little as can be asked for, so that all pixels are in files.
const std::string least = " --memory 64M ";

// TIFF and EXR note when they were written: their pixels are compared.
bool same_picture(const std::string &one, const std::string &other)
{
    if (std::filesystem::path(one).extension() == ".png")
    {
        return same_content(one, other);
    }
    const Picture first(one);
    const Picture second(other);
    return first.width == second.width && first.height == second.height &&
           first.values == second.values;
}

// ---- a ceiling

// The pictures have the same bytes, whether pixels are in memory or in files.
void same_output(const std::string &name, const std::string &arguments,
                 const std::string &extension)
{
    std::filesystem::create_directories("free");
    std::filesystem::create_directories("below");
    does("reproject --quiet " + arguments + " free/%f." + extension);
    does("reproject --quiet" + least + arguments + " below/%f." + extension);
    bool same = true;
    for (int face = 0; face < 6; ++face)
    {
        const std::string file = "/" + std::to_string(face) + "." + extension;
        same = same && same_picture("free" + file, "below" + file);
    }
    result(same && names_in("below") == names_in("free"), name, names_in("below"));
    std::filesystem::remove_all("free");
    std::filesystem::remove_all("below");
}

void ceiling_filters()
{
    make_noise(512, 256, "noise.ppm");
    make_direction_image(equirect_shape, 512, "floats.tif");
    for (const std::string filter : {"auto", "bilinear", "bspline5", "ewa"})
    {
        same_output("bytes below a ceiling, " + filter,
                    "--size 96 --filter " + filter + " noise.ppm", "png");
    }
    same_output("floats below a ceiling, bspline5",
                "--size 160 --filter bspline5 --threads 3 floats.tif", "tif");
    same_output("floats below a ceiling, ewa", "--size 40 --filter ewa floats.tif", "exr");
}

// A spline's coefficients of more than 32 MiB are made some rows at a time: with a ceiling they are kept, in memory or in
// files, and the pictures have the same bytes. With lines there are floats between.
void large_splines()
{
    make_noise(2400, 1200, "noise.ppm");
    same_output("a large spline", "--size 100 --filter bspline5 noise.ppm", "png");
    same_output("a large spline, threads and lines",
                "--size 100 --filter bspline5 --threads 3 --graticule 30 noise.ppm", "png");
    does("reproject --quiet --to equirect --size 64 --filter bspline5 noise.ppm free.png");
    does("reproject --quiet --to equirect --size 64 --filter bspline5 --memory 1T noise.ppm a.png");
    result(same_content("free.png", "a.png"), "a large spline to one picture", "");
}

// Of compressed strips, and a picture that must be turned; of six files.
void ceiling_files()
{
    make_constant(600, 300, 3, "uint16", 0.5f, "zip.tif", {"compression=zip"});
    make_constant(500, 250, 4, "half", 0.25f, "zip.exr", {"compression=zip"});
    make_constant(400, 200, 3, "uint8", 0.25f, "turned.tif", {"Orientation=3"});
    make_noise(128, 128, "noise.ppm");
    for (const std::string name : {"zip.tif", "zip.exr", "turned.tif"})
    {
        same_output("below a ceiling: " + name, "--size 64 --filter bilinear --stored " + name,
                    "tif");
    }
    for (int face = 0; face < 6; ++face)
    {
        std::filesystem::copy_file("noise.ppm", "n" + std::to_string(face) + ".ppm");
    }
    does("reproject --quiet --filter bilinear n%f.ppm free.png");
    does("reproject --quiet --filter bilinear" + least + "n%f.ppm below.png");
    result(same_content("free.png", "below.png"), "six files below a ceiling");
}

// Where the target is larger than what is computed at once, on faces that stand turned, too.
void ceiling_tiles()
{
    make_noise(512, 256, "noise.ppm");
    for (const std::string target : {"--to equirect --size 1100 --filter catmull-rom",
                                     "--layout eac --size 1030 --filter nearest"})
    {
        does("reproject --quiet " + target + " noise.ppm free.tif");
        does("reproject --quiet" + least + target + " noise.ppm below.tif");
        result(same_picture("free.tif", "below.tif"), "in parts below a ceiling: " + target);
    }
}

void ceiling_lines()
{
    make_noise(512, 256, "noise.ppm");
    // faces that stand turned, whose lines need the picture as a whole
    does("reproject --quiet --layout eac --size 64 --graticule 30 noise.ppm free.png");
    does("reproject --quiet" + least + "--layout eac --size 64 --graticule 30 noise.ppm below.png");
    result(same_content("free.png", "below.png"), "lines over turned faces below a ceiling");
}

void ceiling_talk()
{
    make_noise(512, 256, "noise.ppm");
    std::filesystem::create_directory("made");
    const Ran ran = run("reproject --filter bspline5" + least + "noise.ppm made/%f.png");
    result(ran.status == 0 &&
               matches(ran.err,
                       "^cubemap-reproject: a temporary file in folder '.*', with [0-9.]+ GB "
                       "free, will hold the pixels of 'noise.ppm', 0.4 MB$") &&
               matches(ran.err, "will hold what the filter needs, [0-9.]+ MB$"),
           "temporary files are told beforehand", ran.err);
    result(names_in("made") == "0.png 1.png 2.png 3.png 4.png 5.png ", "nothing is left of them",
           names_in("made"));
    const Ran roomy = run("reproject --memory 1T noise.ppm made/%f.png");
    result(roomy.status == 0 && roomy.err.empty(), "no files where all fits", roomy.err);
    std::filesystem::remove_all("made");
    for (const std::string size : {"", "0", "-1G", "63M", "1X", "G", "2GG", "1e9", "nan", "2 G"})
    {
        fails("--memory " + size, 2, "64M at least",
              Words{"reproject", "--memory", size, "noise.ppm", "made/a.png"});
    }
    for (const std::string size : {"64", "65536K", "0.5g", "1GB", "1GiB", "0.001T"})
    {
        const Ran good = run(Words{"reproject", "--quiet", "--memory", size, "noise.ppm", "a.png"});
        result(good.status == 0, "--memory " + size, good.err);
    }
}

void ceiling_without_room()
{
    make_noise(512, 256, "noise.ppm");
    {
        const SizeLimit limit(100000);
        fails("a temporary file that is too large", 1,
              "takes no temporary file of 0.4 MB: File too",
              words_of("reproject --quiet" + least + "noise.ppm made/a.png"));
    }
    {
        const SizeLimit limit(1000000);
        fails("a temporary file of the filter that is too large", 1,
              "takes no temporary file of [0-9.]+ MB: File too",
              words_of("reproject --quiet --filter bspline5" + least + "noise.ppm made/a.png"));
    }
    setenv("TMPDIR", "/nonesuch", 1);
    fails("a temporary file where no folder is", 1, "folder '/nonesuch' takes no temporary file",
          words_of("reproject --quiet" + least + "noise.ppm made/a.png"));
    unsetenv("TMPDIR");
}

// ---- interrupted work

const std::string resumed = "reproject --quiet --resume --filter bspline5 --size 192 noise.ppm ";

// Whatever has ended the work: a file that may not be longer stands for it.
void interrupt(unsigned most_bytes, const std::string &output)
{
    const SizeLimit limit(most_bytes);
    const Ran ran = run(resumed + output);
    result(ran.status == 1 && matches(ran.err, "the same command goes on from what is done"),
           "interrupted at " + std::to_string(most_bytes) + " bytes", ran.err);
}

void resume()
{
    make_noise(1024, 512, "noise.ppm");
    std::filesystem::create_directory("whole");
    std::filesystem::create_directory("made");
    does("reproject --quiet --filter bspline5 --size 192 noise.ppm whole/%f.png");
    does(resumed + "whole/resumed_%f.png");
    result(same_content("whole/3.png", "whole/resumed_3.png") &&
               !std::filesystem::exists("whole/resumed_%f.png.resume"),
           "work that nothing interrupts leaves no folder", names_in("whole"));
    for (const unsigned most : {20000u, 60000u, 100000u})
    {
        interrupt(most, "made/%f.png");
    }
    result(names_in("made") == "%f.png.resume ", "only what is done is left", names_in("made"));
    does(resumed + "--threads 1 made/%f.png");
    bool same = true;
    for (const std::string face : {"0", "1", "2", "3", "4", "5"})
    {
        same = same && same_content("whole/" + face + ".png", "made/" + face + ".png");
    }
    result(same, "resumed work has the same bytes");
    result(names_in("made") == "0.png 1.png 2.png 3.png 4.png 5.png ", "and leaves nothing else",
           names_in("made"));
}

// The files below a folder, and what is in them.
std::map<std::string, std::string> contents(const std::string &folder)
{
    std::map<std::string, std::string> all;
    for (const auto &entry : std::filesystem::recursive_directory_iterator(folder))
    {
        if (entry.is_regular_file())
        {
            all[entry.path().lexically_relative(folder).string()] = content_of(entry.path());
        }
    }
    return all;
}

// Interrupted by a folder that is in the way, in place of a tile's file.
void resume_tiles()
{
    make_noise(256, 128, "noise.ppm");
    setenv("SOURCE_DATE_EPOCH", "1700000000", 1);
    const std::string own = "reproject --quiet --filter bspline5 --size 16 --order 4 --threads 2 ";
    does(own + "noise.ppm whole/");
    std::filesystem::create_directories("sky.resume/tiles/Norder4/Dir0/Npix1500.png");
    const Ran ran = run(own + "--resume noise.ppm sky/");
    result(ran.status == 1 && matches(ran.err, "the same command goes on from what is done"),
           "tiles that are interrupted", ran.err);
    std::filesystem::remove("sky.resume/tiles/Norder4/Dir0/Npix1500.png");
    const std::string journal = content_of("sky.resume/journal");
    result(matches(journal, "^rows 0 0 1 [0-9]+$"), "tiles are in the journal", journal);
    const std::string kept = "sky.resume/tiles/Norder4/Dir0/Npix2.png";
    const auto before = std::filesystem::last_write_time(kept);
    // of these one is not what was written, and one is gone
    write_file("sky.resume/tiles/Norder4/Dir0/Npix9.png", "no tile");
    std::filesystem::remove("sky.resume/tiles/Norder3/Dir0/Npix5.png");
    does(own + "--resume noise.ppm sky/");
    // whose title is the folder's name
    for (const char *folder : {"sky", "whole"})
    {
        std::filesystem::remove(std::string(folder) + "/properties");
    }
    result(contents("sky") == contents("whole"), "resumed tiles have the same bytes");
    result(std::filesystem::last_write_time("sky/Norder4/Dir0/Npix2.png") == before,
           "what was done was not done again");
    result(!std::filesystem::exists("sky.resume"), "and leave nothing else");
    unsetenv("SOURCE_DATE_EPOCH");
}

// Of what is made of all pixels at once, rows are kept before that.
void resume_whole()
{
    make_noise(1024, 512, "noise.ppm");
    std::filesystem::create_directory("made");
    for (const std::string words :
         {"--size 192 noise.ppm made/a.dds", "--size 192 --mips noise.ppm made/a.ktx2",
          "--size 192 --border 3 --layout 3x2 noise.ppm made/a.png",
          "--size 192 --parts noise.ppm made/a.exr"})
    {
        const std::string copy = "whole" + std::filesystem::path(words).extension().string();
        const std::string own = "reproject --quiet --filter bspline5 ";
        const std::string name = words.substr(words.rfind(' ') + 1);
        does(own + words);
        std::filesystem::rename(name, copy);
        {
            const SizeLimit limit(500000);
            const Ran ran = run(own + "--resume " + words);
            result(ran.status == 1 && matches(content_of(name + ".resume/journal"), "^rows 0 0 "),
                   "interrupted: " + words, ran.err);
        }
        does(own + "--resume " + words);
        const bool exr = copy == "whole.exr";
        bool same = exr || same_content(name, copy);
        for (unsigned i = 0; exr && i < 6; ++i)
        {
            same = (i == 0 || same) && Picture(name, i).values == Picture(copy, i).values;
        }
        result(same && !std::filesystem::exists(name + ".resume"), "resumed: " + words);
    }
}

// What INPUT was decoded to is not decoded again: other pixels in a file of the same size and time are not seen.
void resume_source()
{
    make_noise(1024, 512, "noise.ppm");
    const std::string own = "reproject --quiet --filter bspline5 --to equirect --size 64 ";
    does(own + "noise.ppm whole.png");
    {
        const SizeLimit limit(2000000); // of which the pixels need less, and the filter more
        const Ran ran = run(own + "--resume" + least + "noise.ppm a.png");
        result(ran.status == 1 && matches(content_of("a.png.resume/journal"), "^source 0 1572864$"),
               "interrupted behind the decoding", ran.err);
    }
    const auto time = std::filesystem::last_write_time("noise.ppm");
    make_turned("noise.ppm", 1024, 512, "noise.ppm");
    std::filesystem::last_write_time("noise.ppm", time);
    does(own + "--resume" + least + "noise.ppm a.png");
    result(same_content("whole.png", "a.png") && !std::filesystem::exists("a.png.resume"),
           "decoded pixels are kept");
}

std::string journal()
{
    return content_of("a.png.resume/journal");
}

// A journal that says too much, and rows that are not what it says.
void resume_damaged()
{
    make_noise(1024, 512, "noise.ppm");
    does("reproject --quiet --filter bspline5 --to equirect --size 1024 noise.ppm whole.png");
    const std::string command = "reproject --quiet --resume --filter bspline5 --to equirect "
                                "--size 1024 noise.ppm a.png";
    {
        const SizeLimit limit(1000000);
        run(command);
    }
    const std::string rows = content_of("a.png.resume/rows-0");
    const std::string lines = journal();
    result(matches(lines, "^rows 0 0 [0-9]+ [0-9]+$"), "rows are in the journal", lines);
    std::string damaged = rows;
    damaged[1000] = static_cast<char>(damaged[1000] ^ 1);
    write_file("a.png.resume/rows-0", damaged);
    write_file("a.png.resume/journal",
               lines +
                   "picture 0 12345\nrows 99 0 1 1\nnonsense\n\nrows 0 256 512 77\nrows 0 96 1");
    does(command);
    result(same_content("whole.png", "a.png"), "what does not have its checksum is done again");
    result(!std::filesystem::exists("a.png.resume"), "then the folder is gone");
}

void resume_refuses()
{
    make_noise(1024, 512, "noise.ppm");
    make_noise(512, 256, "small.ppm");
    const auto begin = []
    {
        const SizeLimit limit(150000);
        run("reproject --quiet --resume --layout strip --size 192 noise.ppm a.png");
    };
    begin();
    fails("resumed with another option", 1,
          "is of other work: it has .*size=192.* where this has .*size=96",
          "reproject --quiet --resume --layout strip --size 96 noise.ppm a.png");
    fails("resumed with another input", 1, "is of other work: it has .*noise.ppm",
          "reproject --quiet --resume --layout strip --size 192 small.ppm a.png");
    make_turned("noise.ppm", 1024, 512, "other.ppm");
    std::filesystem::rename("other.ppm", "noise.ppm");
    fails("resumed with an input that was changed", 1, "is of other work: it has .*modified",
          "reproject --quiet --resume --layout strip --size 192 noise.ppm a.png");
    result(std::filesystem::exists("a.png.resume"), "refusing changes nothing");
    does("reproject --quiet --layout strip --size 192 noise.ppm a.png");
    result(!std::filesystem::exists("a.png.resume"), "an output that is complete needs no folder");
    std::filesystem::create_directory("a.png.resume");
    write_file("a.png.resume/notes.txt", "mine");
    fails("a folder of somebody else", 1, "has 'notes.txt', which no interrupted work has left",
          "reproject --quiet --resume --layout strip noise.ppm a.png");
    does("reproject --quiet --layout strip noise.ppm a.png");
    result(content_of("a.png.resume/notes.txt") == "mine", "stays");
    std::filesystem::remove_all("a.png.resume");
    write_file("a.png.resume", "mine");
    fails("a file in place of the folder", 1, "a.png.resume'.*(cannot|Not a directory)",
          "reproject --quiet --resume --layout strip noise.ppm a.png");
}

// ---- how long it takes

void remaining_time()
{
    result(time_left(0.5, 1.9).empty() && time_left(0.001, 60).empty(), "no time left too early");
    result(time_left(0.5, 10) == " 0:10 left" && time_left(0.25, 30.2) == " 1:31 left" &&
               time_left(1.0, 30) == " 0:00 left",
           "minutes and seconds", time_left(0.5, 10) + time_left(0.25, 30.2));
    result(time_left(0.1, 1000) == " 2:30:00 left" && time_left(0.01, 1e9) == " 99:59:59 left",
           "hours", time_left(0.1, 1000) + time_left(0.01, 1e9));
}

// ---- manifests

void manifest()
{
    make_noise(256, 128, "noise.ppm");
    does("reproject --quiet --size 32 --filter bilinear --manifest all.json noise.ppm f_%f.png");
    const std::string text = content_of("all.json");
    const std::string face = content_of("f_4.png");
    char sum[20];
    std::snprintf(
        sum, sizeof sum, "%08lx",
        crc32(0, reinterpret_cast<const Bytef *>(face.data()), static_cast<uInt>(face.size())));
    result(matches(text, "^    \\{\"name\": \"f_4.png\", \"bytes\": " +
                             std::to_string(face.size()) + ", \"crc32\": \"" + sum + "\"\\},$"),
           "a manifest has sizes and checksums", text);
    result(matches(text, "^  \"surface\": \"cube:coupled;.*size=32\",$") &&
               matches(text, "^  \"filter\": \"bilinear\",$") &&
               matches(text, "^    \"--filter=bilinear\",$") &&
               matches(text, "^    \\{\"name\": \"noise.ppm\", \"bytes\": 98319, "),
           "what, of what and how", text);
    fails("a manifest in place of OUTPUT", 2, "'made/../made/a.png' is OUTPUT, too",
          "reproject --layout strip --manifest made/../made/a.png noise.ppm made/a.png");
    fails("a manifest in place of INPUT", 2, "is INPUT, too",
          "reproject --layout strip --manifest ./noise.ppm noise.ppm made/a.png");
    fails("a manifest in place of the sidecar", 2, "is the file of --sidecar, too",
          "reproject --layout strip --sidecar --manifest made/a.json noise.ppm made/a.png");
    fails("a manifest that cannot be written", 1, "'made/none/a.json' cannot be written",
          "reproject --quiet --manifest made/none/a.json noise.ppm made/%f.png");
}

} // namespace

const std::vector<Subject> &reproject_memory_subjects()
{
    static const std::vector<Subject> subjects = {{"ceiling_filters", ceiling_filters},
                                                  {"large_splines", large_splines},
                                                  {"ceiling_files", ceiling_files},
                                                  {"ceiling_tiles", ceiling_tiles},
                                                  {"ceiling_lines", ceiling_lines},
                                                  {"ceiling_talk", ceiling_talk},
                                                  {"ceiling_without_room", ceiling_without_room},
                                                  {"resume", resume},
                                                  {"resume_tiles", resume_tiles},
                                                  {"resume_whole", resume_whole},
                                                  {"resume_source", resume_source},
                                                  {"resume_damaged", resume_damaged},
                                                  {"resume_refuses", resume_refuses},
                                                  {"remaining_time", remaining_time},
                                                  {"manifest", manifest}};
    return subjects;
}
