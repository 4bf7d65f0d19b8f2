// SPDX-License-Identifier: MIT

#include "scene_world.hpp"

#include "modules/scene/io/parsed_json.hpp"
#include "modules/scene/io/mesh_file.h"
#include "catalogue_name.h"
#include "program.hpp"
#include "scene_handle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <sstream>

namespace
{

constexpr std::streamoff largest_scene_file = 1 << 26;

struct SceneNames
{
    std::string file;
    std::string folder; // of the file, with a slash; "" for here
    const BrdfMaker *maker;
};

[[noreturn]] void fail_scene(const std::string &file, const std::string &what)
{
    throw Failure(in_quotes(file) + ": " + what);
}

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
        throw Failure(in_quotes(file) + " has no triangle in it");
    }
    return mesh;
}

bool ends_with(const std::string &text, const std::string &ending)
{
    return text.size() >= ending.size() &&
           text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

std::string text_of_file(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    file.seekg(0, std::ios::end);
    const std::streamoff size = file.tellg();
    if (!file || size < 0)
    {
        throw Failure(in_quotes(path) + " cannot be read");
    }
    if (size > largest_scene_file)
    {
        throw Failure(in_quotes(path) + " is too long for a scene");
    }
    std::string text(static_cast<std::size_t>(size), '\0');
    file.seekg(0);
    file.read(text.data(), size);
    if (!file)
    {
        throw Failure(in_quotes(path) + " cannot be read");
    }
    return text;
}

// Lines of four numbers, theta_in theta_out azimuth in degrees and the value, apart by blanks or commas; # begins a remark.
std::vector<BrdfWord> read_brdf_table(const std::string &path)
{
    constexpr double degree = 3.14159265358979323846 / 180;
    std::istringstream lines(text_of_file(path));
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
    PrimitiveReader(const SceneNames &from, std::string list_name, int number, const cJSON *json)
        : names(from), where(std::move(list_name) + "[" + std::to_string(number) + "]"),
          object(json)
    {
        if (!cJSON_IsObject(object))
        {
            fail_scene(names.file, where + " is no object");
        }
    }

    // A member of another object.
    PrimitiveReader(const SceneNames &from, std::string name, const cJSON *json)
        : names(from), where(std::move(name)), object(json)
    {
        if (!cJSON_IsObject(object))
        {
            fail_scene(names.file, where + " is no object");
        }
    }

    // As check_members, where colours mean nothing.
    void check_only(const std::vector<std::string> &known) const
    {
        for (const cJSON *each = object->child; each != nullptr; each = each->next)
        {
            if (std::find(known.begin(), known.end(), each->string) == known.end())
            {
                fail_scene(names.file, where + " has " + in_quotes(each->string) +
                                           ", which means nothing there");
            }
        }
    }

    // Every member has a meaning.
    void check_members(const std::vector<std::string> &known) const
    {
        static const std::array<std::string, 4> of_all = {"color", "reflectance", "motion", "brdf"};
        for (const cJSON *each = object->child; each != nullptr; each = each->next)
        {
            if (std::find(known.begin(), known.end(), each->string) == known.end() &&
                std::find(of_all.begin(), of_all.end(), each->string) == of_all.end())
            {
                fail_scene(names.file, where + " has " + in_quotes(each->string) +
                                           ", which means nothing there");
            }
        }
    }

    std::size_t numbers(const char *key, double *to, std::size_t count, bool needed) const
    {
        const cJSON *const list = cJSON_GetObjectItemCaseSensitive(object, key);
        if (list == nullptr && !needed)
        {
            return 0;
        }
        const std::string wanted = " is not " + std::to_string(count) + " numbers";
        if (!cJSON_IsArray(list) || static_cast<std::size_t>(cJSON_GetArraySize(list)) != count)
        {
            fail_scene(names.file, where + "." + key + wanted);
        }
        const cJSON *each = list->child;
        for (std::size_t i = 0; i < count; ++i, each = each->next)
        {
            if (!cJSON_IsNumber(each) || !std::isfinite(each->valuedouble))
            {
                fail_scene(names.file, where + "." + key + wanted);
            }
            to[i] = each->valuedouble;
        }
        return count;
    }

    void number(const char *key, double *to, bool needed) const
    {
        const cJSON *const item = cJSON_GetObjectItemCaseSensitive(object, key);
        if (item == nullptr && !needed)
        {
            return;
        }
        if (!cJSON_IsNumber(item) || !std::isfinite(item->valuedouble))
        {
            fail_scene(names.file, where + "." + key + " is not a number");
        }
        *to = item->valuedouble;
    }

    void material(cm_material &to) const
    {
        numbers("color", to.color, 3, false);
        number("reflectance", &to.reflectance, false);
    }

    // A mesh's file and how it stands.
    void standing(World &world, cm_primitive &to) const
    {
        const cJSON *const file = cJSON_GetObjectItemCaseSensitive(object, "file");
        std::array<double, 3> position = {0, 0, 0};
        std::array<double, 4> quaternion = {0, 0, 0, 1};
        numbers("position", position.data(), 3, false);
        numbers("quaternion", quaternion.data(), 4, false);
        if (!cJSON_IsString(file))
        {
            fail_scene(names.file, where + ".file is not the name of a mesh");
        }
        if (cm_pose_from_quaternion(position.data(), quaternion.data(), &to.pose) != CM_OK)
        {
            fail_scene(names.file, where + ".quaternion is not of length 1, or more than 1e-3 off");
        }
        const std::string name = file->valuestring;
        to.mesh = add_mesh(world, path_of(name));
    }

    // How it moves: key frames, or a file of them.
    void motion(World &world, cm_primitive &to) const
    {
        const cJSON *const keys = cJSON_GetObjectItemCaseSensitive(object, "motion");
        if (keys == nullptr)
        {
            return;
        }
        const TimedPoses poses =
            cJSON_IsString(keys) ? read_poses(path_of(keys->valuestring)) : poses_of(keys);
        cm_trajectory *made = nullptr;
        const cm_status status = cm_trajectory_create(poses.time.size(), poses.time.data(),
                                                      poses.pose.data(), &made, nullptr);
        if (status == CM_ERROR_MEMORY)
        {
            throw std::bad_alloc();
        }
        if (status != CM_OK)
        {
            fail_scene(names.file, where + ".motion has no times, or times that do not grow");
        }
        world.motions.emplace_back(made);
        to.motion = made;
    }

    // How it scatters light, where somebody asks for that; what is written is checked in any case.
    void brdf(World &world, cm_primitive &to) const
    {
        const cJSON *const json = cJSON_GetObjectItemCaseSensitive(object, "brdf");
        if (json == nullptr)
        {
            return;
        }
        const BrdfDescription description = brdf_of(json);
        if (*names.maker)
        {
            const std::shared_ptr<const cm_brdf> made = (*names.maker)(description);
            if (made == nullptr)
            {
                fail_scene(names.file, where + ".brdf has numbers outside their ranges");
            }
            world.brdfs.push_back(made);
            to.brdf = made.get();
        }
    }

    void add(World &world, const cm_primitive &given) const
    {
        cm_primitive made = given;
        motion(world, made);
        brdf(world, made);
        const cm_status status = cm_scene_add(world.scene.get(), &made, nullptr);
        if (status == CM_ERROR_MEMORY)
        {
            throw std::bad_alloc();
        }
        if (status != CM_OK)
        {
            fail_scene(names.file, where + wrong_of(made));
        }
    }

private:
    std::string path_of(const std::string &name) const
    {
        return name[0] == '/' ? name : names.folder + name;
    }

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
            if (!cJSON_IsNumber(each))
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
        bool is_list = cJSON_IsArray(keys) != 0;
        for (const cJSON *key = is_list ? keys->child : nullptr; key != nullptr && is_list;
             key = key->next)
        {
            std::array<double, 8> number = {};
            cm_pose pose;
            is_list = read_key(key, number) &&
                      cm_pose_from_quaternion(number.data() + 1, number.data() + 4, &pose) == CM_OK;
            poses.time.push_back(number[0]);
            poses.pose.push_back(pose);
        }
        if (!is_list)
        {
            fail_scene(names.file, where + ".motion is neither a file nor a list of [t, x, y, z, "
                                           "qx, qy, qz, qw]");
        }
        return poses;
    }

    BrdfDescription brdf_of(const cJSON *json) const
    {
        const PrimitiveReader reader(names, where + ".brdf", json);
        const cJSON *const kind = cJSON_GetObjectItemCaseSensitive(json, "kind");
        const std::string name = cJSON_IsString(kind) ? kind->valuestring : "";
        BrdfDescription made;
        if (name == "cook-torrance")
        {
            made.kind = BrdfDescription::Kind::CookTorrance;
            reader.check_only({"kind", "diffuse", "specular", "roughness", "eta", "absorption"});
            reader.number("diffuse", &made.diffuse, false);
            reader.number("specular", &made.specular, false);
            reader.number("roughness", &made.roughness, true);
            reader.number("eta", &made.eta, true);
            reader.number("absorption", &made.absorption, false);
        }
        else if (name == "measured")
        {
            made.kind = BrdfDescription::Kind::Measured;
            reader.check_only({"kind", "file"});
            const cJSON *const file = cJSON_GetObjectItemCaseSensitive(json, "file");
            if (!cJSON_IsString(file))
            {
                fail_scene(names.file, where + ".brdf.file is not the name of a table");
            }
            made.measured = read_brdf_table(path_of(file->valuestring));
        }
        else if (name == "lambert")
        {
            reader.check_only({"kind"});
        }
        else
        {
            fail_scene(names.file, where + ".brdf.kind is not lambert, cook-torrance or measured");
        }
        return made;
    }

    static std::string wrong_of(const cm_primitive &made)
    {
        const double *const color = made.material.color;
        const auto is_part = [](double value) { return value >= 0 && value <= 1; };
        if (!is_part(color[0]) || !is_part(color[1]) || !is_part(color[2]) ||
            !is_part(made.material.reflectance))
        {
            return " has a color or reflectance outside 0..1";
        }
        static const char *const wrong[] = {" has no normal", " has a min that is not below max",
                                            " has a radius that is not above 0",
                                            " has no axis, or a radius that is not above 0",
                                            " is no mesh"};
        return wrong[made.kind];
    }

    const SceneNames &names;
    std::string where;
    const cJSON *object;
};

void read_plane(const PrimitiveReader &reader, World &world)
{
    cm_primitive made = empty_primitive(CM_PRIMITIVE_PLANE);
    reader.check_members({"point", "normal"});
    reader.numbers("point", made.first, 3, true);
    reader.numbers("normal", made.second, 3, true);
    reader.material(made.material);
    reader.add(world, made);
}

void read_box(const PrimitiveReader &reader, World &world)
{
    cm_primitive made = empty_primitive(CM_PRIMITIVE_BOX);
    reader.check_members({"min", "max"});
    reader.numbers("min", made.first, 3, true);
    reader.numbers("max", made.second, 3, true);
    reader.material(made.material);
    reader.add(world, made);
}

void read_sphere(const PrimitiveReader &reader, World &world)
{
    cm_primitive made = empty_primitive(CM_PRIMITIVE_SPHERE);
    reader.check_members({"centre", "radius"});
    reader.numbers("centre", made.first, 3, true);
    reader.number("radius", &made.radius, true);
    reader.material(made.material);
    reader.add(world, made);
}

void read_cylinder(const PrimitiveReader &reader, World &world)
{
    cm_primitive made = empty_primitive(CM_PRIMITIVE_CYLINDER);
    reader.check_members({"from", "to", "radius"});
    reader.numbers("from", made.first, 3, true);
    reader.numbers("to", made.second, 3, true);
    reader.number("radius", &made.radius, true);
    reader.material(made.material);
    reader.add(world, made);
}

void read_mesh_object(const PrimitiveReader &reader, World &world)
{
    cm_primitive made = empty_primitive(CM_PRIMITIVE_MESH);
    reader.check_members({"file", "position", "quaternion"});
    reader.material(made.material);
    reader.standing(world, made);
    reader.add(world, made);
}

} // namespace

World parse_world(const std::string &name, const std::string &text, const BrdfMaker &maker)
{
    using Read = void (*)(const PrimitiveReader &, World &);
    static const std::map<std::string, Read> lists = {{"planes", read_plane},
                                                      {"boxes", read_box},
                                                      {"spheres", read_sphere},
                                                      {"cylinders", read_cylinder},
                                                      {"meshes", read_mesh_object}};
    std::size_t line = 0;
    const JsonPointer json = parse_json_object(text, line);
    if (json == nullptr)
    {
        throw Failure(in_quotes(name) + ":" + std::to_string(line) + ": is no JSON object");
    }
    const SceneNames names = {name, name.substr(0, name.rfind('/') + 1), &maker};
    World world = empty_scene();
    for (const cJSON *list = json->child; list != nullptr; list = list->next)
    {
        const auto kind = lists.find(list->string);
        if (kind == lists.end() || !cJSON_IsArray(list))
        {
            fail_scene(name, in_quotes(list->string) +
                                 " is not a list of planes, boxes, spheres, cylinders or meshes");
        }
        int number = 0;
        for (const cJSON *each = list->child; each != nullptr; each = each->next)
        {
            kind->second(PrimitiveReader(names, list->string, number++, each), world);
        }
    }
    if (cm_scene_count(world.scene.get()) == 0)
    {
        fail_scene(name, "has nothing in it");
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
