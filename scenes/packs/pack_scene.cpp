// scenes/packs/pack_scene.cpp - writes the scene of a pack as JSON and arrays, and reads it back (pack_scene.h).
#include "scenes/packs/pack_scene.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <filesystem>

#include "pipeline/vertices/check_list.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/input_error.h"
#include "scenes/bounds.h"
#include "scenes/files/strict_json.h"
#include "scenes/files/text_file.h"
#include "scenes/inside_folder.h"

namespace strata::scenes {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using pipeline::Instance;
using pipeline::Light;
using pipeline::Material;
using pipeline::Mesh;
using pipeline::Primitive;
using pipeline::ShadowLight;
using pipeline::Texture;

constexpr std::size_t most_manifest_bytes = std::size_t{1} << 28;
constexpr int most_texels_a_side = 16384;

// Sixteen numbers in column-major order.
void matrix(JsonWriter& io, const std::string& key, const pipeline::Matrix& value) {
    const auto entries = entries_of(value);
    io.reals(key, std::span<const double>{entries});
}
void matrix(JsonReader& io, const std::string& key, pipeline::Matrix& value) {
    std::array<double, 16> entries{};
    io.reals(key, std::span<double>{entries});
    value = matrix_of(entries);
}

template <class Io, class M>
void material_fields(Io& io, M& material) {
    io.text("name", material.name);
    io.reals("front", components(material.front));
    io.reals("back", components(material.back));
    io.choice("alpha_mode", material.alpha_mode);
    io.real("alpha_cutoff", material.alpha_cutoff);
    io.whole("texture", material.texture, -1, INT32_MAX);
    io.flag("double_sided", material.double_sided);
    io.flag("unlit", material.unlit);
}

template <class Io, class T>
void texture_fields(Io& io, T& texture) {
    io.text("name", texture.name);
    io.choice("target", texture.target);
    io.choice("filter", texture.filter);
    io.choice("wrap_s", texture.wrap_s);
    io.choice("wrap_t", texture.wrap_t);
    io.flag("decode_srgb", texture.decode_srgb);
}

template <class Io, class T>
void instance_fields(Io& io, T& instance) {
    io.whole("mesh", instance.mesh, 0u, UINT32_MAX);
    io.whole("material", instance.material, 0u, UINT32_MAX);
    matrix(io, "model", instance.model);
    io.flag("arrives_sorted", instance.arrives_sorted);
}

template <class Io, class L>
void light_fields(Io& io, L& light) {
    matrix(io, "view", light.view);
    matrix(io, "projection", light.projection);
    io.whole("size_px", light.size_px, 1, 16384);
    io.real("ambient", light.ambient);
    io.real("offset_factor", light.offset_factor);
    io.real("offset_units", light.offset_units);
    io.flag("percentage_closer", light.percentage_closer);
}

template <class Io, class L>
void lamp_fields(Io& io, L& light) {
    io.choice("type", light.type);
    for (const auto& [key, of] :
         {std::pair{"ambient", &light.ambient}, std::pair{"diffuse", &light.diffuse},
          std::pair{"specular", &light.specular}, std::pair{"position", &light.position},
          std::pair{"direction", &light.direction}, std::pair{"attenuation", &light.attenuation}})
        io.reals(key, components(*of));
    // JSON has no infinity.
    std::optional<float> range = light.range;
    if (!std::isfinite(light.range)) range.reset();
    io.if_any("range", range, [](auto& inner, const std::string& key, auto& value) { inner.real(key, value); });
    if constexpr (!std::is_const_v<L>) light.range = range.value_or(pipeline::Light{}.range);
    io.real("cutoff", light.cutoff);
    io.real("exponent", light.exponent);
}

template <class Io, class V>
void view_fields(Io& io, V& view) {
    matrix(io, "view", view.view);
    matrix(io, "projection", view.projection);
    io.choice("vertex_path", view.vertex_path, std::span<const std::string_view>{pipeline::vertex_path_names});
}

// Vectors of a mesh, one per row.
template <class Vector>
NumberArray rows_of(const std::vector<Vector>& vectors) {
    NumberArray array{.element = Element::f4, .shape = {vectors.size(), static_cast<std::size_t>(Vector::length())}};
    for (const Vector& vector : vectors)
        for (const float value : components(vector)) array.append(std::bit_cast<std::uint32_t>(value));
    return array;
}

// x y z, or x y z w.
NumberArray positions_of(const Mesh& mesh) {
    if (mesh.w.empty()) return rows_of(mesh.positions);
    NumberArray array{.element = Element::f4, .shape = {mesh.positions.size(), 4}};
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        for (const float value : components(mesh.positions[i])) array.append(std::bit_cast<std::uint32_t>(value));
        array.append(std::bit_cast<std::uint32_t>(mesh.w[i]));
    }
    return array;
}

NumberArray triples_of(const std::vector<std::uint32_t>& indices) {
    NumberArray array{.element = Element::u4, .shape = {indices.size() / 3, 3}};
    for (const std::uint32_t index : indices) array.append(index);
    return array;
}

// Reads the arrays named in a manifest.
class Arrays {
  public:
    Arrays(const std::string& folder, const std::string& file) : folder_{folder}, file_{file} {}

    // An array with `width` columns; empty if the manifest has null.
    NumberArray rows(JsonReader& io, const std::string& key, Element element, std::size_t width) const {
        NumberArray array = any(io, key);
        if (array.shape.empty()) return array;
        const bool fits = array.element == element && array.shape.size() == 2 && array.shape[1] == width;
        if (!fits) fail(io, key, fmt::format("{} of shape (n, {})", name(element), width), array);
        return array;
    }

    NumberArray any(JsonReader& io, const std::string& key) const {
        if (io.is_null(key)) return {};
        std::string name;
        io.text(key, name);
        return read_npy(path_inside(folder_, name, file_, io.pointer_of(key)));
    }

    // Reports the array that the manifest names.
    [[noreturn]] void fail(JsonReader& io, const std::string& key, const std::string& expected,
                           const NumberArray& found) const {
        throw InputError(file_, io.pointer_of(key), "an array of " + expected,
                         fmt::format("{} of shape ({})", name(found.element), fmt::join(found.shape, ", ")));
    }

  private:
    const std::string& folder_;
    const std::string& file_;
};

template <class Vector>
std::vector<Vector> vectors_of(const NumberArray& array) {
    std::vector<Vector> vectors(array.shape.empty() ? 0 : array.shape[0]);
    std::size_t at = 0;
    for (Vector& vector : vectors)
        for (float& value : components(vector)) value = std::bit_cast<float>(array.word(at++));
    return vectors;
}

std::vector<std::uint32_t> words_of(const NumberArray& array) {
    std::vector<std::uint32_t> words(array.shape.empty() ? 0 : array.count());
    for (std::size_t i = 0; i < words.size(); ++i) words[i] = array.word(i);
    return words;
}

void write_mesh(JsonWriter& io, const Mesh& mesh, std::size_t number, PackFiles& files) {
    io.text("name", mesh.name);
    const auto add = [&](const std::string& key, const NumberArray& array) {
        const bool has_any = array.shape[0] != 0 || key == "positions" || key == "indices";
        if (has_any)
            io.text(key, files.add(fmt::format("scene/mesh.{:03}.{}.npy", number, key), array));
        else
            io.object[key] = nullptr;
    };
    add("positions", positions_of(mesh));
    add("normals", rows_of(mesh.normals));
    add("colors", rows_of(mesh.colors));
    add("texcoords", rows_of(mesh.texcoords));
    if (mesh.primitive != Primitive::triangles) io.choice("primitive", mesh.primitive);
    add("indices", triples_of(mesh.indices));
}

void read_positions(JsonReader& io, Mesh& mesh, const Arrays& arrays) {
    const NumberArray array = arrays.any(io, "positions");
    const bool is_homogeneous = array.shape.size() == 2 && array.shape[1] == 4;
    if (!is_homogeneous) {
        mesh.positions = vectors_of<Vec3>(arrays.rows(io, "positions", Element::f4, 3));
        return;
    }
    for (std::size_t i = 0; i < array.count() && array.element == Element::f4; i += 4) {
        const auto value = [&](std::size_t c) { return std::bit_cast<float>(array.word(i + c)); };
        mesh.positions.push_back({value(0), value(1), value(2)});
        mesh.w.push_back(value(3));
    }
    if (array.element != Element::f4) arrays.fail(io, "positions", "f4 of shape (n, 3) or (n, 4)", array);
}

void read_mesh(JsonReader& io, Mesh& mesh, const Arrays& arrays) {
    io.text("name", mesh.name);
    read_positions(io, mesh, arrays);
    mesh.normals = vectors_of<Vec3>(arrays.rows(io, "normals", Element::f4, 3));
    mesh.colors = vectors_of<Rgba>(arrays.rows(io, "colors", Element::f4, 4));
    mesh.texcoords = vectors_of<Vec2>(arrays.rows(io, "texcoords", Element::f4, 2));
    if (io.has("primitive")) io.choice("primitive", mesh.primitive);
    mesh.indices = words_of(arrays.rows(io, "indices", Element::u4, 3));
}

void write_texture(JsonWriter& io, const Texture& texture, std::size_t number, PackFiles& files) {
    texture_fields(io, texture);
    NumberArray texels{.element = Element::u1,
                       .shape = {static_cast<std::size_t>(texture.height), static_cast<std::size_t>(texture.width), 4},
                       .bytes = {texture.texels.begin(), texture.texels.end()}};
    io.text("texels", files.add(fmt::format("scene/texture.{:03}.npy", number), texels));
}

void read_texture(JsonReader& io, Texture& texture, const Arrays& arrays) {
    texture_fields(io, texture);
    const NumberArray texels = arrays.any(io, "texels");
    const bool fits = texels.element == Element::u1 && texels.shape.size() == 3 && texels.shape[2] == 4 &&
                      texels.shape[0] >= 1 && texels.shape[0] <= most_texels_a_side && texels.shape[1] >= 1 &&
                      texels.shape[1] <= most_texels_a_side;
    if (!fits) arrays.fail(io, "texels", "u1 of shape (rows, columns, 4), at most 16384 rows and columns", texels);
    texture.height = static_cast<int>(texels.shape[0]);
    texture.width = static_cast<int>(texels.shape[1]);
    texture.texels.assign(texels.bytes.begin(), texels.bytes.end());
}

}  // namespace

std::string pack_folder(const std::string& path) {
    constexpr std::string_view manifest = "manifest.json";
    std::string folder = path.ends_with(manifest) ? path.substr(0, path.size() - manifest.size()) : path;
    while (folder.size() > 1 && folder.back() == '/') folder.pop_back();
    return folder.empty() ? "." : folder;
}

std::string pack_profile(const std::string& folder) {
    return path_inside(folder, "profile.json", folder + "/manifest.json", "profile");
}

bool is_pack(const std::string& path) {
    std::error_code unreadable;
    return std::filesystem::is_regular_file(pack_folder(path) + "/manifest.json", unreadable);
}

json read_manifest(const std::string& folder) {
    const std::string file = folder + "/manifest.json";
    json manifest =
        parse_strict_json(read_text_file(file, most_manifest_bytes), file, "the manifest of a pack in JSON");
    if (!manifest.is_object()) throw InputError(file, "/", "an object", json_in_words(manifest));
    const auto expect = [&](const char* key, const json& expected) {
        const auto found = manifest.find(key);
        if (found == manifest.end() || *found != expected)
            throw InputError(file, std::string{"/"} + key, expected.dump(),
                             found == manifest.end() ? "no such key" : json_in_words(*found));
    };
    expect("format", "strata-pack");
    expect("version", pack_version);
    return manifest;
}

ordered_json scene_json(const Scene& scene, pipeline::ColorSpace space, PackFiles& files) {
    JsonWriter io;
    io.text("name", scene.name);
    io.choice("color_space", space);
    const auto numbered = [&](auto write) {
        return [&files, write, number = std::size_t{0}](JsonWriter& inner, const auto& value) mutable {
            write(inner, value, number++, files);
        };
    };
    io.list("meshes", scene.list.meshes, numbered(write_mesh));
    io.list("materials", scene.list.materials, material_fields<JsonWriter, const Material>);
    io.list("textures", scene.list.textures, numbered(write_texture));
    io.list("instances", scene.list.instances, instance_fields<JsonWriter, const Instance>);
    io.optional("light", scene.list.light, [](JsonWriter& outer, const std::string& key, const ShadowLight& light) {
        outer.nested(key, light, light_fields<JsonWriter, const ShadowLight>);
    });
    if (!scene.list.lights.empty()) io.list("lights", scene.list.lights, lamp_fields<JsonWriter, const Light>);
    return std::move(io.object);
}

ordered_json view_json(const pipeline::View& view) {
    JsonWriter io;
    view_fields(io, view);
    return std::move(io.object);
}

pipeline::ColorSpace color_space_of(const std::string& folder, const json& manifest) {
    const std::string file = folder + "/manifest.json";
    JsonReader top{manifest, file, ""};
    JsonReader io{top.at("scene"), file, "/scene"};
    pipeline::ColorSpace space{};
    io.choice("color_space", space);
    return space;
}

Scene read_pack_scene(const std::string& folder, const json& manifest) {
    const std::string file = folder + "/manifest.json";
    const Arrays arrays{folder, file};
    JsonReader top{manifest, file, ""};
    Scene scene;
    JsonReader io{top.at("scene"), file, "/scene"};
    io.text("name", scene.name);
    pipeline::ColorSpace space{};
    io.choice("color_space", space);
    io.list("meshes", scene.list.meshes, [&](JsonReader& inner, Mesh& mesh) { read_mesh(inner, mesh, arrays); });
    io.list("materials", scene.list.materials, material_fields<JsonReader, Material>);
    io.list("textures", scene.list.textures,
            [&](JsonReader& inner, Texture& texture) { read_texture(inner, texture, arrays); });
    io.list("instances", scene.list.instances, instance_fields<JsonReader, Instance>);
    io.optional("light", scene.list.light, [](JsonReader& outer, const std::string& key, ShadowLight& light) {
        outer.nested(key, light, light_fields<JsonReader, ShadowLight>);
    });
    if (io.has("lights")) io.list("lights", scene.list.lights, lamp_fields<JsonReader, Light>);
    io.end();
    top.nested("view", scene.own_view.emplace(), view_fields<JsonReader, pipeline::View>);
    return scene;
}

Scene load_pack(const std::string& path, const SceneOptions& options) {
    const FloatEnvironment environment;
    const std::string folder = pack_folder(path);
    const json manifest = read_manifest(folder);
    if (options.scene.value_or(0) != 0)
        throw InputError(path, "--scene", "0, the only one", std::to_string(*options.scene));
    if (options.color_space != color_space_of(folder, manifest))
        throw InputError(path, "--color-space", "the colour space in which the pack's colours are stored",
                         "the other colour space");
    Scene scene = read_pack_scene(folder, manifest);
    for (Material& material : scene.list.materials) material.unlit |= !options.light;
    pipeline::check(scene.list);
    scene.bounds = bounds_of(scene.list);
    return scene;
}

}  // namespace strata::scenes
