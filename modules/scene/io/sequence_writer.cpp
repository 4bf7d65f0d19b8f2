// SPDX-License-Identifier: MIT

#include "sequence.h"

#include "camera_file.h"
#include "file_failure.hpp"
#include "picture_file.hpp"
#include "pose_words.hpp"
#include "sequence_folder.hpp"
#include "view_stream.h"

#include "modules/image/io/temporary_name.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include <sys/stat.h>
#include <unistd.h>

struct cm_sequence_writer
{
    virtual ~cm_sequence_writer() = default;
    virtual void put(const cm_view &view, std::size_t &beyond) = 0;
    virtual void finish() = 0;
    virtual const char *folder() const
    {
        return nullptr;
    }
    cm_sequence_loss loss = {sizeof(cm_sequence_loss), 0, 0.0, 0};
};

namespace
{

void check_written(cm_status status, const char *message)
{
    if (status != CM_OK)
    {
        throw FileFailure(status, message);
    }
}

// How the names of folders end that are not complete.
const char *const unfinished = ".sequence";

// A folder beside the one that is wanted, with all that is in it; it goes away if it does not take its name. What programs
// that were killed have left there goes away, too.
class NewFolder
{
public:
    explicit NewFolder(const std::string &path) : target(path)
    {
        while (target.size() > 1 && target.back() == '/')
        {
            target.pop_back();
        }
        struct stat status;
        const bool there = stat(target.c_str(), &status) == 0;
        if (there && (!folder_is_there(target) || !names_in_folder(target).empty()))
        {
            fail_file(target, "exists and is not an empty folder", CM_ERROR_FILE);
        }
        const std::size_t slash = target.find_last_of('/');
        parent = slash == std::string::npos ? "." : target.substr(0, slash + 1);
        remove_left_over_folders(parent, unfinished);
        for (int attempt = 0; descriptor < 0; ++attempt)
        {
            std::string name = path_in(parent, own_temporary_name(attempt, unfinished));
            descriptor = make_temporary_folder(name);
            if (descriptor >= 0)
            {
                temporary =
                    std::move(name); // as it asks for no memory, the folder cannot be forgotten
            }
            else if (errno != EEXIST || attempt == folders_most)
            {
                fail_system(target, "cannot be written");
            }
        }
    }
    ~NewFolder()
    {
        bool gone = temporary.empty();
        for (int times = 0; times < 2 && !gone; ++times)
        {
            try
            {
                std::error_code error;
                std::filesystem::remove_all(temporary, error);
                gone = true;
            }
            catch (const std::bad_alloc &)
            {
                gone = false; // what has just failed may have left memory for this
            }
        }
        if (descriptor >= 0)
        {
            close(descriptor);
        }
    }
    NewFolder(const NewFolder &) = delete;
    NewFolder &operator=(const NewFolder &) = delete;

    const std::string &path() const
    {
        return temporary;
    }
    void make(const char *inner) const
    {
        const std::string path = path_in(temporary, inner);
        if (mkdir(path.c_str(), 0777) != 0)
        {
            fail_system(target, "cannot be written");
        }
    }
    // Does what may fail with a name in the temporary folder; the failure tells the name that was asked for.
    template <typename Body> void by_its_name(const Body &body) const
    {
        try
        {
            body();
        }
        catch (const FileFailure &failure)
        {
            std::string text = failure.what();
            for (std::size_t at = 0;
                 !temporary.empty() && (at = text.find(temporary, at)) != std::string::npos;
                 at += target.size())
            {
                text.replace(at, temporary.size(), target);
            }
            throw FileFailure(failure.status(), text);
        }
    }
    // In place of an empty folder, too.
    void appear()
    {
#ifdef __linux__
        const bool synced = syncfs(descriptor) == 0;
#else
        sync();
        const bool synced = true;
#endif
        if (!synced || std::rename(temporary.c_str(), target.c_str()) != 0)
        {
            fail_system(target, "cannot be written");
        }
        temporary.clear();
        sync_folder(parent);
    }

private:
    static constexpr int folders_most = 999; // of one process at a time

    std::string target;
    std::string parent;
    std::string temporary;
    int descriptor = -1; // of the folder, which is locked as long as it is open
};

class FolderWriter final : public cm_sequence_writer
{
public:
    FolderWriter(const std::string &path, cm_sequence_layout wanted, const cm_camera *of,
                 double scale);
    void put(const cm_view &view, std::size_t &beyond) override;
    void finish() override;
    const char *folder() const override
    {
        return files.path().c_str();
    }

private:
    void store_depth(const cm_view &view, std::size_t &beyond);
    void count_rounded(double units, double exact);
    void write_files(const cm_view &view);
    void write_lists() const;
    void write_tum(const cm_view &view, const std::string &time);
    std::string color_of(const cm_view &view, const std::string &name);

    NewFolder files;
    cm_sequence_layout layout;
    CameraPointer camera;
    double depth_scale;
    std::size_t count = 0;
    double before = -INFINITY;
    OwnPicture depth;
    std::string depth_list = "# depth maps\n# timestamp filename\n";
    std::string color_list = "# color images\n# timestamp filename\n";
    std::string poses;
};

CameraPointer copy_of_camera(const cm_camera *camera)
{
    cm_camera *copy = nullptr;
    if (cm_camera_create(cm_camera_describe(camera), &copy) != CM_OK)
    {
        throw std::bad_alloc();
    }
    return CameraPointer(copy);
}

FolderWriter::FolderWriter(const std::string &path, cm_sequence_layout wanted, const cm_camera *of,
                           double scale)
    : files(path), layout(wanted), camera(copy_of_camera(of)),
      depth_scale(wanted == CM_SEQUENCE_SEVEN_SCENES ? 1000.0 : scale)
{
    char message[CM_IMAGE_MESSAGE] = "";
    const std::string name = path_in(files.path(), "camera.json");
    files.by_its_name(
        [&]
        {
            check_written(cm_camera_file_write(name.c_str(), camera.get(), depth_scale, message),
                          message);
        });
    if (layout == CM_SEQUENCE_TUM)
    {
        files.make("depth");
        files.make("rgb");
        poses = "# ground truth trajectory\n# timestamp tx ty tz qx qy qz qw\n";
    }
}

// Lengths of the rays of a row; 1 if depth and range are what the camera wants.
void row_factors(const cm_view &view, const cm_camera *camera, std::uint32_t row,
                 std::vector<double> &factor)
{
    const cm_camera_options &options = *cm_camera_describe(camera);
    factor.assign(options.width, 1.0);
    if (view.depth_is_range == 0 || options.mapping != nullptr)
    {
        return;
    }
    std::vector<double> column(options.width);
    std::vector<double> rows(options.width, row + options.pixel_centre);
    std::vector<double> x(options.width);
    std::vector<double> y(options.width);
    std::vector<double> z(options.width);
    for (std::uint32_t i = 0; i < options.width; ++i)
    {
        column[i] = i + options.pixel_centre;
    }
    cm_camera_ray_array(camera, options.width, column.data(), rows.data(), x.data(), y.data(),
                        z.data());
    for (std::uint32_t i = 0; i < options.width; ++i)
    {
        factor[i] = 1.0 / std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
    }
}

// Off by so many units; roundings of doubles and of floats, 2^-23 of the depth, are none of the format's.
void FolderWriter::count_rounded(double units, double exact)
{
    if (units > std::max(1e-3, 0x1p-23 * exact))
    {
        ++loss.rounded;
        loss.most = std::max(loss.most, units / depth_scale);
    }
}

void FolderWriter::store_depth(const cm_view &view, std::size_t &beyond)
{
    const cm_camera_options &options = *cm_camera_describe(camera.get());
    const bool seven = layout == CM_SEQUENCE_SEVEN_SCENES;
    const double most = seven ? 65534.0 : 65535.0;
    const std::uint16_t none = seven ? seven_scenes_none : 0;
    depth.shape(options.width, options.height, 1, CM_PIXEL_U16);
    std::vector<double> factor;
    unsigned char *to = depth.bytes.data();
    for (std::uint32_t row = 0; row < options.height; ++row)
    {
        row_factors(view, camera.get(), row, factor);
        const unsigned char *at = row_of(view.depth, row);
        for (std::uint32_t i = 0; i < options.width; ++i, at += pixel_step(view.depth), to += 2)
        {
            double value = 0.0;
            if (view.depth.type == CM_PIXEL_U16)
            {
                std::uint16_t stored;
                std::memcpy(&stored, at, sizeof stored);
                value = stored;
            }
            else
            {
                float stored;
                std::memcpy(&stored, at, sizeof stored);
                value = static_cast<double>(stored);
            }
            const double exact = value * view.depth_unit * factor[i] * depth_scale;
            const double units = std::floor(exact + 0.5);
            const bool measured = value > 0.0 && std::isfinite(value);
            const bool fits = measured && units >= 1.0 && units <= most;
            beyond += measured && !fits;
            count_rounded(fits ? std::fabs(units - exact) : 0.0, exact);
            const std::uint16_t kept = fits ? static_cast<std::uint16_t>(units) : none;
            std::memcpy(to, &kept, sizeof kept);
        }
    }
}

// Writes the colours if there are any; the name, or nothing.
std::string FolderWriter::color_of(const cm_view &view, const std::string &name)
{
    if (view.color.data == nullptr)
    {
        return "";
    }
    write_picture(path_in(files.path(), name), view.color);
    return name;
}

void FolderWriter::write_tum(const cm_view &view, const std::string &time)
{
    const std::string name = "depth/" + time + ".png";
    write_picture(path_in(files.path(), name), depth.image);
    depth_list += time + " " + name + "\n";
    const std::string color = color_of(view, "rgb/" + time + ".png");
    color_list += color.empty() ? "" : time + " " + color + "\n";
    poses += pose_line(view.time, view.pose);
}

void FolderWriter::write_files(const cm_view &view)
{
    if (layout == CM_SEQUENCE_TUM)
    {
        write_tum(view, time_text(view.time));
    }
    else if (layout == CM_SEQUENCE_OPEN3D)
    {
        const std::string number = std::to_string(count);
        write_picture(path_in(files.path(), numbered("depth_", count, 5, ".png")), depth.image);
        color_of(view, numbered("image_", count, 5, ".png"));
        poses += number + " " + number + " " + std::to_string(count + 1) + "\n" +
                 matrix_lines(view.pose);
    }
    else
    {
        write_picture(path_in(files.path(), numbered("frame-", count, 6, ".depth.png")),
                      depth.image);
        color_of(view, numbered("frame-", count, 6, ".color.png"));
        write_whole(path_in(files.path(), numbered("frame-", count, 6, ".pose.txt")),
                    matrix_lines(view.pose));
    }
}

void FolderWriter::put(const cm_view &view, std::size_t &beyond)
{
    std::string fault = view_fault(view, camera.get());
    if (fault.empty() && view.depth_is_range == 0 &&
        cm_camera_describe(camera.get())->mapping != nullptr)
    {
        fault = "depth along an axis, of a camera that has none";
    }
    if (fault.empty() && !(view.time > before))
    {
        fault = "its time is not after the one before";
    }
    if (!fault.empty())
    {
        throw FileFailure(CM_ERROR_CAMERA, "view " + std::to_string(count) + ": " + fault);
    }
    store_depth(view, beyond);
    files.by_its_name([&] { write_files(view); });
    before = view.time;
    ++count;
}

void FolderWriter::write_lists() const
{
    if (layout == CM_SEQUENCE_TUM)
    {
        write_whole(path_in(files.path(), "depth.txt"), depth_list);
        write_whole(path_in(files.path(), "rgb.txt"), color_list);
        write_whole(path_in(files.path(), "groundtruth.txt"), poses);
    }
    else if (layout == CM_SEQUENCE_OPEN3D)
    {
        write_whole(path_in(files.path(), "trajectory.log"), poses);
    }
}

void FolderWriter::finish()
{
    files.by_its_name([&] { write_lists(); });
    files.appear();
}

std::size_t write_output(void *, const void *bytes, std::size_t count)
{
    return std::fwrite(bytes, 1, count, stdout);
}

class StreamSequenceWriter final : public cm_sequence_writer
{
public:
    StreamSequenceWriter(const cm_camera *camera, double depth_scale)
    {
        const cm_image_stream stream = {nullptr, nullptr, write_output, nullptr, nullptr};
        char message[CM_IMAGE_MESSAGE] = "";
        check_written(cm_view_writer_create("standard output", &stream, camera, depth_scale,
                                            &writer, message),
                      message);
    }
    ~StreamSequenceWriter() override
    {
        cm_view_writer_destroy(writer);
    }
    void put(const cm_view &view, std::size_t &) override
    {
        char message[CM_IMAGE_MESSAGE] = "";
        check_written(cm_view_writer_put(writer, &view, message), message);
    }
    void finish() override
    {
        char message[CM_IMAGE_MESSAGE] = "";
        check_written(cm_view_writer_finish(writer, message), message);
        if (std::fflush(stdout) != 0)
        {
            fail_system("standard output", "cannot be written");
        }
    }

private:
    cm_view_writer *writer = nullptr;
};

} // namespace

cm_status cm_sequence_create(const char *folder, cm_sequence_layout layout, const cm_camera *camera,
                             double depth_scale, cm_sequence_writer **writer, char *message)
{
    if (folder == nullptr || camera == nullptr || writer == nullptr ||
        cm_sequence_layout_name(layout) == nullptr || !(depth_scale > 0.0) ||
        !std::isfinite(depth_scale) ||
        (layout == CM_SEQUENCE_STREAM) != (std::strcmp(folder, "-") == 0))
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message,
                        [&]
                        {
                            if (layout == CM_SEQUENCE_STREAM)
                            {
                                *writer = new StreamSequenceWriter(camera, depth_scale);
                            }
                            else
                            {
                                *writer = new FolderWriter(folder, layout, camera, depth_scale);
                            }
                        });
}

const char *cm_sequence_writer_folder(const cm_sequence_writer *writer)
{
    return writer->folder();
}

const cm_sequence_loss *cm_sequence_writer_loss(const cm_sequence_writer *writer)
{
    return &writer->loss;
}

cm_status cm_sequence_write(cm_sequence_writer *writer, const cm_view *view, size_t *beyond,
                            char *message)
{
    if (writer == nullptr || view == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message,
                        [&]
                        {
                            std::size_t found = 0;
                            writer->put(*view, found);
                            writer->loss.beyond += found;
                            if (beyond != nullptr)
                            {
                                *beyond += found;
                            }
                        });
}

cm_status cm_sequence_finish(cm_sequence_writer *writer, char *message)
{
    if (writer == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message, [&] { writer->finish(); });
}

void cm_sequence_drop(cm_sequence_writer *writer)
{
    delete writer;
}
