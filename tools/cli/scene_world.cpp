// SPDX-License-Identifier: MIT

#include "scene_world.hpp"

#include "modules/scene/io/file_failure.hpp"
#include "modules/scene/io/mesh_file.h"
#include "catalogue_name.h"
#include "json_members.hpp"
#include "lower_case.hpp"
#include "program.hpp"
#include "scene_handle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

namespace
{

constexpr std::uint64_t scene_bytes_most = std::uint64_t{1} << 26;

// What the objects of a file have in common.
struct SceneFile
{
    JsonPlace place;
    std::string folder; // of the file, with a slash; "" for here
    const BrdfMaker &maker;

    std::string path_of(const std::string &name) const
    {
        return name[0] == '/' ? name : folder + name;
    }
};

cm_primitive empty_primitive(cm_primitive_kind kind)
{
    cm_primitive made = {};
    made.size = sizeof made;
    made.kind = kind;
    made.pose.rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    made.material = {{1, 1, 1}, 1};
    return made;
}

World empty_scene()
{
    World world;
    cm_scene *scene = nullptr;
    if (cm_scene_create(&scene) != CM_OK)
    {
        throw std::bad_alloc();
    }
    world.scene.reset(scene);
    return world;
}

const cm_mesh *add_mesh(World &world, const std::string &file)
{
    cm_mesh *mesh = nullptr;
    char message[CM_IMAGE_MESSAGE] = "";
    if (cm_mesh_file_read(file.c_str(), nullptr, &mesh, message) != CM_OK)
    {
        throw Failure(message);
    }
    world.meshes.emplace_back(mesh);
    if (cm_mesh_describe(mesh)->triangle_count == 0)
    {
        throw Failure(file + ": has no triangle"); // as the reader names it
    }
    return mesh;
}

// In capitals, too.
bool ends_with(const std::string &text, const std::string &ending)
{
    return text.size() >= ending.size() &&
           lower_case(text.substr(text.size() - ending.size())) == ending;
}

std::string text_of_file(const std::string &path)
{
    std::string text;
    char message[CM_IMAGE_MESSAGE] = "";
    check_scene(guarded_file(message, [&] { text = read_whole(path, scene_bytes_most); }), message);
    return text;
}

// What cubemap/brdf.h does not allow; nullptr if that is nothing.
const char *wrong_of_measured(const std::vector<double> &numbers)
{
    constexpr double right_angle = 90, value_most = 1e30;
    const auto is_raised = [](double theta) { return theta >= 0 && theta <= right_angle; };
    return !is_raised(numbers[0])       ? "a theta_in that is not from 0 to 90 degrees"
           : !is_raised(numbers[1])     ? "a theta_out that is not from 0 to 90 degrees"
           : !std::isfinite(numbers[2]) ? "an azimuth that is not finite"
           : !(numbers[3] >= 0 && numbers[3] <= value_most) ? "a value that is not from 0 to 1e30"
                                                            : nullptr;
}

// Lines of four numbers, theta_in theta_out azimuth in degrees and the value, apart by blanks or commas; # begins a remark.
std::vector<BrdfWord> read_brdf_table(const std::string &path)
{
    constexpr double degree = 3.14159265358979323846 / 180;
    const std::string text = text_of_file(path);
    std::istringstream lines(text.substr(begin_of_text(text)));
    std::vector<BrdfWord> words;
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number)
    {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream parts(line.substr(0, line.find('#')));
        std::vector<double> numbers;
        for (std::string part; parts >> part;)
        {
            numbers.push_back(read_number(part).value_or(std::nan("")));
        }
        if (numbers.empty())
        {
            continue;
        }
        if (numbers.size() != 4 || std::isnan(numbers[0] + numbers[1] + numbers[2] + numbers[3]))
        {
            throw Failure(in_quotes(path) + ":" + std::to_string(number) +
                          ": is not theta_in theta_out azimuth value");
        }
        const char *const wrong = wrong_of_measured(numbers);
        if (wrong != nullptr)
        {
            throw Failure(in_quotes(path) + ":" + std::to_string(number) + ": has " + wrong);
        }
        words.push_back(
            {numbers[0] * degree, numbers[1] * degree, numbers[2] * degree, numbers[3]});
    }
    if (words.empty())
    {
        throw Failure(in_quotes(path) + " has no line of theta_in theta_out azimuth value");
    }
    return words;
}

// One object of a list, as far as it is read.
class PrimitiveReader
{
public:
    cm_primitive made;

    // members has what objects of this kind have; all may have more.
    PrimitiveReader(const SceneFile &from, const std::string &path, const cJSON *json,
                    cm_primitive_kind kind, std::vector<std::string> names)
        : made(empty_primitive(kind)), file(from), members(from.place, path, json)
    {
        names.insert(names.end(), {"color", "reflectance", "motion", "brdf"});
        members.check_only(names);
        members.take_numbers("color", Range::part_with_zero, made.material.color, 3);
        members.take_number("reflectance", Range::part_with_zero, made.material.reflectance);
    }

    void place(const char *key, double to[3])
    {
        members.need_numbers(key, Range::any, to, 3);
    }

    void radius()
    {
        made.radius = members.number("radius", Range::above_zero);
    }

    // A mesh's file and how it stands.
    void standing(World &world)
    {
        std::array<double, 3> position = {0, 0, 0};
        std::array<double, 4> quaternion = {0, 0, 0, 1};
        members.take_numbers("position", Range::any, position.data(), position.size());
        members.take_numbers("quaternion", Range::any, quaternion.data(), quaternion.size());
        const std::string name = members.word("file", "the name of a mesh");
        if (cm_pose_from_quaternion(position.data(), quaternion.data(), &made.pose) != CM_OK)
        {
            members.fail("quaternion", " is more than 1e-3 off length 1");
        }
        made.mesh = add_mesh(world, file.path_of(name));
    }

    // How it moves: key frames, or a file of them.
    void motion(World &world)
    {
        const cJSON *const keys = members.find("motion");
        if (keys == nullptr)
        {
            return;
        }
        const TimedPoses poses =
            cJSON_IsString(keys) ? read_poses(file.path_of(keys->valuestring)) : poses_of(keys);
        cm_trajectory *moved = nullptr;
        std::size_t wrong = 0;
        const cm_status status = cm_trajectory_create(poses.time.size(), poses.time.data(),
                                                      poses.pose.data(), &moved, &wrong);
        if (status == CM_ERROR_MEMORY)
        {
            throw std::bad_alloc();
        }
        if (status != CM_OK)
        {
            const cJSON *const key = cJSON_GetArrayItem(keys, static_cast<int>(wrong));
            file.place.fail(key == nullptr ? keys : key,
                            members.name_of("motion") + " has no times, or times that do not grow");
        }
        world.motions.emplace_back(moved);
        made.motion = moved;
    }

    // How it scatters light, where somebody asks for that; what is written is checked in any case.
    void brdf(World &world)
    {
        const cJSON *const json = members.find("brdf");
        if (json == nullptr)
        {
            return;
        }
        const BrdfDescription description = brdf_of(json);
        if (file.maker)
        {
            const std::shared_ptr<const cm_brdf> scattering = file.maker(description);
            if (scattering == nullptr)
            {
                members.fail("brdf", " has numbers outside their ranges");
            }
            world.brdfs.push_back(scattering);
            made.brdf = scattering.get();
        }
    }

    void add(World &world)
    {
        motion(world);
        brdf(world);
        const cm_status status = cm_scene_add(world.scene.get(), &made, nullptr);
        if (status == CM_ERROR_MEMORY)
        {
            throw std::bad_alloc();
        }
        if (status != CM_OK)
        {
            members.fail_whole(wrong_of(made));
        }
    }

private:
    // Are these eight numbers?
    static bool read_key(const cJSON *key, std::array<double, 8> &number)
    {
        if (!cJSON_IsArray(key) || cJSON_GetArraySize(key) != static_cast<int>(number.size()))
        {
            return false;
        }
        const cJSON *each = key->child;
        for (double &value : number)
        {
            if (!cJSON_IsNumber(each) || !std::isfinite(each->valuedouble))
            {
                return false;
            }
            value = each->valuedouble;
            each = each->next;
        }
        return true;
    }

    TimedPoses poses_of(const cJSON *keys) const
    {
        TimedPoses poses;
        if (!cJSON_IsArray(keys))
        {
            fail_motion(keys);
        }
        for (const cJSON *key = keys->child; key != nullptr; key = key->next)
        {
            std::array<double, 8> number = {};
            cm_pose pose;
            if (!read_key(key, number))
            {
                fail_motion(key);
            }
            if (cm_pose_from_quaternion(number.data() + 1, number.data() + 4, &pose) != CM_OK)
            {
                file.place.fail(key, members.name_of("motion") +
                                         " has a quaternion that is more than 1e-3 off length 1");
            }
            poses.time.push_back(number[0]);
            poses.pose.push_back(pose);
        }
        return poses;
    }

    [[noreturn]] void fail_motion(const cJSON *item) const
    {
        file.place.fail(item, members.name_of("motion") +
                                  " is neither a file nor a list of [t, x, y, z, qx, qy, qz, qw]");
    }

    // Ranges are those of cm_cook_torrance.
    static void read_facets(JsonMembers &parts, BrdfDescription &read)
    {
        constexpr double least_roughness = 0.01, index_most = 1e6, rounding = 1e-12;
        read.diffuse = parts.number("diffuse", Range::part_with_zero);
        read.specular = parts.number("specular", Range::part_with_zero);
        read.roughness = parts.number("roughness", Range::above_zero, least_roughness, 1);
        read.eta = parts.number("eta", Range::above_zero, 0, index_most);
        read.absorption = parts.number("absorption", Range::zero_or_more, 0, index_most);
        if (read.diffuse + read.specular > 1 + rounding)
        {
            parts.fail("specular", " is more than diffuse leaves of 1");
        }
    }

    BrdfDescription brdf_of(const cJSON *json) const
    {
        JsonMembers parts(file.place, members.name_of("brdf"), json);
        const std::string wanted = "lambert, cook-torrance or measured";
        const std::string name = parts.word("kind", wanted);
        BrdfDescription read;
        if (name == "cook-torrance")
        {
            read.kind = BrdfDescription::Kind::CookTorrance;
            parts.check_only({"kind", "diffuse", "specular", "roughness", "eta", "absorption"});
            read_facets(parts, read);
        }
        else if (name == "measured")
        {
            read.kind = BrdfDescription::Kind::Measured;
            parts.check_only({"kind", "file"});
            read.measured =
                read_brdf_table(file.path_of(parts.word("file", "the name of a table")));
        }
        else if (name == "lambert")
        {
            parts.check_only({"kind"});
        }
        else
        {
            parts.fail("kind", " is not " + wanted);
        }
        return read;
    }

    // Why the library does not take it, whose radius is above 0.
    static const char *wrong_of(const cm_primitive &given)
    {
        const double *const a = given.first;
        const double *const b = given.second;
        if (given.kind == CM_PRIMITIVE_PLANE && b[0] == 0 && b[1] == 0 && b[2] == 0)
        {
            return " has no normal";
        }
        if (given.kind == CM_PRIMITIVE_BOX && !(a[0] < b[0] && a[1] < b[1] && a[2] < b[2]))
        {
            return " has a min that is not below max";
        }
        if (given.kind == CM_PRIMITIVE_CYLINDER && std::equal(a, a + 3, b))
        {
            return " has no axis: from and to are the same";
        }
        return " has numbers that are too large";
    }

    const SceneFile &file;
    JsonMembers members;
};

void read_plane(const SceneFile &file, const std::string &path, const cJSON *json, World &world)
{
    PrimitiveReader reader(file, path, json, CM_PRIMITIVE_PLANE, {"point", "normal"});
    reader.place("point", reader.made.first);
    reader.place("normal", reader.made.second);
    reader.add(world);
}

void read_box(const SceneFile &file, const std::string &path, const cJSON *json, World &world)
{
    PrimitiveReader reader(file, path, json, CM_PRIMITIVE_BOX, {"min", "max"});
    reader.place("min", reader.made.first);
    reader.place("max", reader.made.second);
    reader.add(world);
}

void read_sphere(const SceneFile &file, const std::string &path, const cJSON *json, World &world)
{
    PrimitiveReader reader(file, path, json, CM_PRIMITIVE_SPHERE, {"centre", "radius"});
    reader.place("centre", reader.made.first);
    reader.radius();
    reader.add(world);
}

void read_cylinder(const SceneFile &file, const std::string &path, const cJSON *json, World &world)
{
    PrimitiveReader reader(file, path, json, CM_PRIMITIVE_CYLINDER, {"from", "to", "radius"});
    reader.place("from", reader.made.first);
    reader.place("to", reader.made.second);
    reader.radius();
    reader.add(world);
}

void read_mesh_object(const SceneFile &file, const std::string &path, const cJSON *json,
                      World &world)
{
    PrimitiveReader reader(file, path, json, CM_PRIMITIVE_MESH, {"file", "position", "quaternion"});
    reader.standing(world);
    reader.add(world);
}

} // namespace

World parse_world(const std::string &name, const std::string &text, const BrdfMaker &maker)
{
    using Read = void (*)(const SceneFile &, const std::string &, const cJSON *, World &);
    static const std::map<std::string, Read> lists = {{"planes", read_plane},
                                                      {"boxes", read_box},
                                                      {"spheres", read_sphere},
                                                      {"cylinders", read_cylinder},
                                                      {"meshes", read_mesh_object}};
    const JsonPointer json = parse_json_file(name, text);
    const SceneFile file = {{name, text, json.get()}, name.substr(0, name.rfind('/') + 1), maker};
    std::set<std::string> seen;
    World world = empty_scene();
    for (const cJSON *list = json->child; list != nullptr; list = list->next)
    {
        const auto kind = lists.find(list->string);
        if (kind == lists.end() || !cJSON_IsArray(list))
        {
            file.place.fail(list,
                            in_quotes(list->string) +
                                " is not a list of planes, boxes, spheres, cylinders or meshes");
        }
        if (!seen.insert(kind->first).second)
        {
            file.place.fail(list, kind->first + " is given twice");
        }
        int number = 0;
        for (const cJSON *each = list->child; each != nullptr; each = each->next)
        {
            kind->second(file, kind->first + "[" + std::to_string(number++) + "]", each, world);
        }
    }
    if (cm_scene_count(world.scene.get()) == 0)
    {
        throw Failure(in_quotes(name) + ": has nothing in it");
    }
    return world;
}

World load_world(const std::string &scene, const BrdfMaker &maker)
{
    World world;
    cm_scene *named = nullptr;
    if (cm_scene_create_named(scene.c_str(), &named) == CM_OK)
    {
        world.scene.reset(named);
        return world;
    }
    if (ends_with(scene, ".json"))
    {
        return parse_world(scene, text_of_file(scene), maker);
    }
    if (!ends_with(scene, ".gltf") && !ends_with(scene, ".glb") && !ends_with(scene, ".obj"))
    {
        throw UsageFailure("SCENE is " + in_quotes(scene) +
                           ", neither room, corridor or spheres nor a .json, .gltf, .glb or .obj" +
                           suggestion(nearest_name(scene.c_str(), cm_scene_name_at)));
    }
    world = empty_scene();
    cm_primitive made = empty_primitive(CM_PRIMITIVE_MESH);
    made.mesh = add_mesh(world, scene);
    if (cm_scene_add(world.scene.get(), &made, nullptr) != CM_OK)
    {
        throw std::bad_alloc();
    }
    return world;
}
