// SPDX-License-Identifier: MIT
//
// What cubemap-scene says of bad input: one line, with the file and its line, and nothing is written.

#include "image_cases.hpp"

#include "modules/scene/io/sequence.h"
#include "modules/scene/io/view_stream.h"

#include <array>
#include <filesystem>

#include <unistd.h>

namespace
{

const std::string eight_by_six =
    "{\"width\":8,\"height\":6,\"fx\":8,\"fy\":8,\"cx\":3.5,\"cy\":2.5}";
const std::string ahead = " 0.5 -0.5 0.5 -0.5\n"; // along the world's x

// A sequence of two views in each layout.
void make_sequences()
{
    write_file("camera.json", eight_by_six);
    write_file("path.txt", "1 0 0 1.2" + ahead + "2 0.1 0 1.2" + ahead);
    does("scene render room camera.json path.txt -o tum --truth --quiet");
    does("scene convert tum --to open3d -o open --quiet");
    does("scene convert tum --to 7scenes -o seven --quiet");
    std::filesystem::create_directory("made");
}

// The sequence with another file in it: neither info nor convert takes it.
void refuses_file(const std::string &folder, const std::string &file, const std::string &content,
                  const std::string &expression)
{
    const std::string name = folder + "/" + file;
    const bool is_new = !std::filesystem::exists(name);
    const std::string before = is_new ? "" : content_of(name);
    const std::string title = file + ": " + content.substr(0, 30);
    write_file(name, content);
    fails(title + ", told", 1, expression, "scene info " + folder);
    fails(title + ", converted", 1, expression, "scene convert " + folder + " --to tum -o made/x");
    write_file(name, before);
    if (is_new)
    {
        std::filesystem::remove(name);
    }
}

void lists()
{
    make_sequences();
    const std::string first = "1 depth/1.000000.png";
    refuses_file("tum", "depth.txt", first + "\n" + first + "\n", "tum/depth.txt:2: .*not after");
    refuses_file("tum", "depth.txt", first + " more\n", "tum/depth.txt:1: .*3 words");
    refuses_file("tum", "depth.txt", "x" + first + "\n", "tum/depth.txt:1: .*no number");
    refuses_file("tum", "depth.txt", "1e999 depth/1.000000.png\n", "tum/depth.txt:1: .*not finite");
    refuses_file("tum", "depth.txt", "1 absent.png\n2 absent.png\n", "tum: .*2 are absent");
    refuses_file("tum", "depth.txt", first + std::string(1, '\0') + "x\n",
                 "tum/depth.txt:1: a name with a zero byte");
    refuses_file("tum", "rgb.txt", "1 a\n\n0 b\n", "tum/rgb.txt:3: .*not after");
    std::string equal = "# thousands of equal stamps\n";
    for (int i = 0; i < 5000; ++i)
    {
        equal += first + "\n";
    }
    refuses_file("tum", "depth.txt", equal, "tum/depth.txt:3: .*not after");
}

void poses()
{
    make_sequences();
    refuses_file("tum", "groundtruth.txt", "1 0 0 nan 0 0 0 1\n", "groundtruth.txt:1: .*no number");
    refuses_file("tum", "groundtruth.txt", "1 0 0 0 0 0 0 1.0011\n",
                 "groundtruth.txt:1: .*quaternion");
    refuses_file("tum", "groundtruth.txt", "9 0 0 0 0 0 0 1\n", "tum: .*2 have no pose");
    refuses_file("tum", "groundtruth.txt", "", "groundtruth.txt: has no pose");
    write_file("tum/groundtruth.txt", "1 0 0 0 0 0 0 1.0009\n2 0 0 0 0 0 0 0.9991\n");
    passes("nearly of unit length", "scene info tum --json");
    write_file("tum/groundtruth.txt", "1 0 0 0 0 0 0 1.001\n2 0 0 0 0 0 0 0.999\n");
    passes("as far off as may be", "scene info tum --json");
    refuses_file("open", "trajectory.log", "0 0 1\n1 0 0 0\n0 1 0 0\n",
                 "trajectory.log:3: a matrix ends");
    refuses_file("open", "trajectory.log", "0 0 1\n1 0 0 nan\n", "trajectory.log:2: .*no number");
    refuses_file("open", "trajectory.log", "0 0 1\n2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n",
                 "trajectory.log:5: .*no pose");
    refuses_file("open", "trajectory.log", "0 1\n", "trajectory.log:1: .*begins with 3");
    refuses_file("seven", "frame-000001.pose.txt", "1 0 0 0\n0 1 0 0\n0 0 -1 0\n0 0 0 1\n",
                 "frame-000001.pose.txt:4: .*no pose");
    refuses_file("seven", "frame-000001.pose.txt", "1 0 0\n", "frame-000001.pose.txt:1: .*4 num");
    refuses_file("seven", "frame-000001.pose.txt", "", "frame-000001.pose.txt: has no pose");
}

void refused_pictures()
{
    make_sequences();
    const std::string depth = content_of("tum/depth/1.000000.png");
    const std::string truth = content_of("tum/truth/1.000000.exr");
    const std::string name = "depth/1.000000.png";
    for (const std::size_t part : {std::size_t{0}, std::size_t{7}, depth.size() / 2})
    {
        refuses_file("tum", name, depth.substr(0, part), "tum/depth/1.000000.png");
    }
    refuses_file("tum", name, content_of("tum/rgb/1.000000.png"), "000.png: has 3 channels");
    refuses_file("tum", "rgb/1.000000.png", "P5", "tum/rgb/1.000000.png");
    refuses_file("open", "depth_00001.png", "P5 8 6 255\n" + std::string(48, 'x'),
                 "depth_00001.png: .*uint8.*16 bits");
    refuses_file("open", "depth_00001.png", "P5 8 5 65535\n" + std::string(80, 'x'),
                 "depth_00001.png: is 8 x 5 .*camera has 8 x 6");
    refuses_file("seven", "frame-000000.depth.png", "", "frame-000000.depth.png");
    write_file("tum/depth.txt", "1 a.exr\n");
    refuses_file("tum", "a.exr", truth.substr(0, truth.size() / 2), "tum/a.exr");
    refuses_file("tum", "a.exr", truth, "a.exr: has 13 channels");
    write_file("tum/depth.txt", "1 a.npy\n");
    refuses_file("tum", "a.npy", "\x93NUMPY", "a.npy: is no array");
}

void cameras()
{
    make_sequences();
    const auto refuses = [](const std::string &text, const std::string &expression)
    {
        refuses_file("tum", "camera.json", text, "camera.json:" + expression);
        write_file("other.json", text);
        fails("to render, " + text.substr(0, 40), 1, "other.json:" + expression,
              "scene render room other.json path.txt -o made/x");
    };
    const std::string rest = ",\"cx\":3.5,\"cy\":2.5}";
    refuses("", "1: is no JSON");
    refuses("{\"width\":8,\n\"height\":}", "2: is no JSON");
    refuses(eight_by_six + "\n{}", "2: is no JSON");
    refuses("{\"width\":8,\"height\":6,\n\"fx\":0,\"fy\":8" + rest, "2: a focal length of 0");
    refuses("{\"width\":65536,\"height\":32768,\"fx\":8,\"fy\":8" + rest, "1: .*2\\^31 pixels");
    refuses("{\"width\":8.5,\"height\":6,\"fx\":8,\"fy\":8" + rest, "1: .*whole numbers");
    refuses("{\"width\":8,\"height\":6,\"fx\":8,\"fy\":8,\"depth_scale\":0" + rest,
            "1: depth_scale .*greater than 0");
    refuses("{\"width\":8,\"height\":6,\"fx\":8,\"fy\":8,\"distortion\":[0,1e999]" + rest,
            "1: distortion .*finite");
    refuses("{\"width\":8,\"height\":6,\"fx\":8,\"fy\":8,\"k1\":0" + rest,
            "1: a camera has no k1; it may have width, height, fx, .*, size$");
    refuses("{\"width\":8,\"height\":6,\"fx\":8,\"fx\":8,\"fy\":8" + rest, "1: fx is given twice");
    refuses("{\"width\":8,\"height\":6,\n\"fx\":8,\n\"fx\":8,\"fy\":8" + rest,
            "3: fx is given twice");
    refuses("{\"width\":8,\"height\":6,\"fx\":8,\n\"fy\":1e-320" + rest, "2: a focal length of");
    refuses("{\"width\":8,\"height\":6,\"fx\":8,\"fy\":8,\n\"pixel_centre\":2" + rest,
            "2: pixel_centre is 2, not from 0 to 1");
    refuses("{\"width\":8,\"height\":6,\"fx\":8,\"fy\":8,\n\"distortion\":[0,0,0,0,0,0,0,0,0,0,0,0,"
            "1.6]" +
                rest,
            "2: distortion has a tilt");
    refuses("{\"width\":8,\"height\":6,\"fx\":8,\"fy\":8,\n\"depth_scale\":1e-310" + rest,
            "2: depth_scale");
    refuses("{\"width\":8,\n\"height\":6.5,\"fx\":8,\"fy\":8" + rest, "2: .*whole numbers");
    refuses("{\"mapping\":\"coupled\",\n\"frame\":\"geoo\",\"size\":8}", "2: no frame");
    refuses("{\"mapping\":\"coupled\",\n\"size\":18919}", "2: .*18919 x 113514 .*2\\^31 pixels");
    refuses("{\"mapping\":\"azimuthal:equidistant\",\n\"size\":46341}",
            "2: .*46341 x 46341 .*2\\^31 pixels");
    refuses("{\"mapping\":\"coupled\"}", "1: size is missing");
    refuses("{\"mapping\":\"coupled\",\"size\":1e9}", "1: .*2\\^31 pixels");
    refuses("{\"mapping\":\"nothing\",\"size\":8}", "1: mapping: ");
    refuses("{\"mapping\":\"square:radial\",\"size\":8}",
            "1: mapping: square:radial is between a disc and a square.*azimuthal:lambert, border");
    write_file("wide.json", "{\"width\":9,\"height\":6,\"fx\":8,\"fy\":8" + rest);
    fails("another size", 1, "1.000000.png: is 8 x 6 .*camera has 9 x 6",
          "scene info tum --camera wide.json");
    write_file("huge.json", "{\"width\":40000,\"height\":50000,\"fx\":8,\"fy\":8" + rest);
    const double memory =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    if (memory > 100e9)
    {
        return; // they are not
    }
    fails("pictures beyond the memory", 1, "'huge.json': .*GB of memory.*without --truth",
          "scene render room huge.json path.txt -o made/x --truth");
}

// The views of a sequence as a stream.
std::string stream_of_views(const std::string &folder)
{
    std::string bytes;
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_image_stream stream = {&bytes, nullptr,
                                    [](void *to, const void *from, std::size_t count)
                                    {
                                        static_cast<std::string *>(to)->append(
                                            static_cast<const char *>(from), count);
                                        return count;
                                    },
                                    nullptr, nullptr};
    cm_sequence *sequence = nullptr;
    cm_view_writer *writer = nullptr;
    const cm_view *view = nullptr;
    bool good = cm_sequence_open(folder.c_str(), nullptr, &sequence, message) == CM_OK &&
                cm_view_writer_create("it", &stream, cm_sequence_describe(sequence)->camera, 5000,
                                      &writer, message) == CM_OK;
    for (std::size_t i = 0; good && i < cm_sequence_count(sequence); ++i)
    {
        good = cm_sequence_view(sequence, i, &view, message) == CM_OK &&
               cm_view_writer_put(writer, view, message) == CM_OK;
    }
    good = good && cm_view_writer_finish(writer, message) == CM_OK;
    cm_view_writer_destroy(writer);
    cm_sequence_close(sequence);
    result(good, "a stream is made", message);
    return bytes;
}

// While it lives, standard input, which the library reads, is this file; then there is nothing.
class OtherInput
{
public:
    explicit OtherInput(const std::string &name)
    {
        take(name);
    }
    ~OtherInput()
    {
        take("/dev/null");
    }
    OtherInput(const OtherInput &) = delete;
    OtherInput &operator=(const OtherInput &) = delete;

private:
    static void take(const std::string &name)
    {
        if (std::freopen(name.c_str(), "rb", stdin) == nullptr)
        {
            result(false, name + " as standard input");
        }
    }
};

void streams()
{
    make_sequences();
    const std::string bytes = stream_of_views("tum");
    write_file("views", bytes);
    write_file("cut", bytes.substr(0, bytes.size() - 30));
    std::string damaged = bytes;
    damaged[bytes.size() / 2] ^= 1;
    write_file("damaged", damaged);
    write_file("nothing", "");
    {
        const OtherInput views("views");
        says("a stream", "\"layout\": \"stream\", \"views\": 2, .*\"first\": 1, \"last\": 2",
             "scene info - --json");
    }
    {
        const OtherInput views("views");
        passes("a stream becomes a folder", "scene convert - --to tum -o again --quiet");
    }
    result(content_of("again/depth/2.000000.png") == content_of("tum/depth/2.000000.png") &&
               content_of("again/groundtruth.txt") == content_of("tum/groundtruth.txt"),
           "which is the same");
    const std::array<std::array<std::string, 2>, 3> wrong = {
        {{"cut", "standard input: view 1"},
         {"damaged", "standard input: view [01]: .*damaged"},
         {"nothing", "standard input: is no stream"}}};
    for (const auto &[name, expression] : wrong)
    {
        {
            const OtherInput input(name);
            fails(name + ", told", 1, expression, "scene info -");
        }
        const OtherInput input(name);
        fails(name + ", converted", 1, expression, "scene convert - --to tum -o made/x");
    }
    fails("a folder is no standard output", 2, "-o is '-'", "scene convert tum --to tum -o -");
    fails("nor for pictures", 2, "-o is '-'", "scene render room camera.json path.txt -o -");
}

// What people have in such files.
void trajectories()
{
    const std::array<std::string, 3> lines = {"1.0 0 0 1" + ahead, "2.5 1 0 1" + ahead,
                                              "4.0 1 2 1" + ahead};
    std::string plain, spread, other;
    for (const std::string &line : lines)
    {
        plain += line;
        spread += "\n  # a comment\n" + line.substr(0, line.size() - 1) + "  \r\n";
        std::string tabs = line;
        for (char &letter : tabs)
        {
            letter = letter == ' ' ? '\t' : letter;
        }
        other += tabs;
    }
    write_file("plain.txt", plain);
    write_file("spread.txt", "\xef\xbb\xbf# with the mark of UTF-8\r\n" + spread);
    write_file("tabs.txt", other);
    write_file("exponents.txt",
               "+1.0e+0 0E0 .0 1." + ahead + "25e-1 1 0 1" + ahead + "4 1 2 1" + ahead);
    for (const std::string name : {"plain", "spread", "tabs", "exponents"})
    {
        says(name, "\"pairs\": 3, \"ate_rmse\": [0-9.e-]*, .*\"motions\": 2",
             "scene evaluate plain.txt " + name + ".txt --json");
    }
    const auto refuses =
        [](const std::string &name, const std::string &text, const std::string &expression)
    {
        write_file("bad.txt", text);
        fails(name, 1, expression, "scene evaluate plain.txt bad.txt --json");
        fails(name + ", as the truth", 1, expression, "scene evaluate bad.txt plain.txt");
    };
    refuses("unsorted", lines[0] + lines[2] + lines[1], "bad.txt:3: .*2.5 is not after .*4");
    refuses("doubled", "#\n" + lines[0] + lines[0], "bad.txt:3: .*not after");
    refuses("seven numbers", "1 0 0 0 0 0 1\n", "bad.txt:1: .*8 numbers.*7");
    refuses("hexadecimal", "0x1p3 0 0 1" + ahead, "bad.txt:1: \"0x1p3\" is no number");
    refuses("a zero byte", lines[0] + "2" + std::string(1, '\0') + " 0 0 1" + ahead,
            "bad.txt:2: \"2\\?\" is no number");
    refuses("comments alone", "# nothing\n", "bad.txt: has no pose");
    refuses("too far", "1 1e200 0 1" + ahead + "2.5 0 1e300 1" + ahead, "bad.txt");
}

// Files that may have no more than so many bytes are as a full disk is: pictures have room, those of --truth have not.
void full_disks()
{
    write_file("few.json",
               "{\"width\":64,\"height\":48,\"fx\":64,\"fy\":64,\"cx\":31.5,\"cy\":23.5}");
    write_file("one.txt", "1 0 0 1.2" + ahead);
    const SizeLimit limit(4096);
    does("scene render room few.json one.txt -o little --quiet");
    fails("no room for the truth", 1, "'full/truth/1[.0-9]*exr' cannot",
          "scene render room few.json one.txt -o full --truth --quiet");
    result(!std::filesystem::exists("full"), "nothing is left");
}

} // namespace

const std::vector<Subject> &scene_refusal_subjects()
{
    static const std::vector<Subject> subjects = {{"scene_lists", lists},
                                                  {"scene_poses", poses},
                                                  {"scene_pictures", refused_pictures},
                                                  {"scene_cameras", cameras},
                                                  {"scene_streams", streams},
                                                  {"scene_trajectories", trajectories},
                                                  {"scene_full_disks", full_disks}};
    return subjects;
}
