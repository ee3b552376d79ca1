// scenes/packs/plain_triangles.cpp - meshes from NumPy arrays and from lists in JSON (plain_triangles.h).
#include "scenes/packs/plain_triangles.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <filesystem>

#include "pipeline/vertices/check_list.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/input_error.h"
#include "rasterizer/rules/primitive.h"
#include "scenes/bounds.h"
#include "scenes/files/strict_json.h"
#include "scenes/files/text_file.h"
#include "scenes/numbers/srgb_encode.h"
#include "scenes/packs/json_fields.h"
#include "scenes/packs/npy.h"

namespace strata::scenes {

namespace {

using nlohmann::json;
using pipeline::Mesh;

constexpr std::size_t most_json_bytes = std::size_t{1} << 28;
constexpr Rgba half_white{1, 1, 1, 0.5f};

// Every three positions are a triangle.
void number_through(Mesh& mesh) {
    mesh.indices.resize(mesh.positions.size() - mesh.positions.size() % 3);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = static_cast<std::uint32_t>(i);
}

// The numbers of each corner's position, 3 or 4; 0 for an array that holds no triangles.
std::size_t coordinates_of(const NumberArray& array) {
    const auto& shape = array.shape;
    if (array.element != Element::f4 || shape.size() != 3 || shape[1] != 3) return 0;
    const std::size_t coordinates = shape[2] > 4 ? shape[2] - 4 : shape[2];
    return coordinates == 3 || coordinates == 4 ? coordinates : 0;
}

Mesh mesh_of_npy(const std::string& path, std::optional<pipeline::View>& view) {
    const NumberArray array = read_npy(path);
    const auto& shape = array.shape;
    const std::size_t coordinates = coordinates_of(array);
    if (coordinates == 0)
        throw InputError(path, "array",
                         "f4 of shape (triangles, 3, N): N = 3 is x y z, 4 is x y z w, 7 or 8 adds r g b a",
                         fmt::format("{} of shape ({})", name(array.element), fmt::join(shape, ", ")));
    Mesh mesh;
    const auto value = [&](std::size_t i) { return std::bit_cast<float>(array.word(i)); };
    const std::size_t width = shape[2];
    const bool has_color = width > coordinates;
    for (std::size_t i = 0; i < array.count(); i += width) {
        mesh.positions.push_back({value(i), value(i + 1), value(i + 2)});
        if (coordinates == 4) mesh.w.push_back(value(i + 3));
        const std::size_t c = i + coordinates;
        mesh.colors.push_back(has_color ? Rgba{value(c), value(c + 1), value(c + 2), value(c + 3)} : half_white);
    }
    number_through(mesh);
    if (coordinates == 4) view = pipeline::View{};
    return mesh;
}

// A row of a list: `count` numbers in the range of `Number`.
template <class Number>
std::vector<Number> row_of(const json& row, std::size_t count, const std::string& file, const std::string& location) {
    if (!row.is_array() || row.size() != count)
        throw InputError(file, location, fmt::format("an array of {} numbers", count), json_in_words(row));
    constexpr bool is_real = std::is_floating_point_v<Number>;
    std::vector<Number> numbers;
    for (const json& value : row) {
        const bool fits = is_real ? value.is_number() && std::isfinite(value.get<float>())
                                  : value.is_number_unsigned() && value.get<std::uint64_t>() <= UINT32_MAX;
        if (!fits)
            throw InputError(file, fmt::format("{}/{}", location, numbers.size()),
                             is_real ? "a number in the range of binary32" : "a whole number from 0 to 4294967295",
                             json_in_words(value));
        numbers.push_back(value.get<Number>());
    }
    return numbers;
}

// Calls `take` for every row of the list.
template <class Number, class Take>
void for_each_row(JsonReader& io, const std::string& key, std::size_t count, const std::string& file, Take take) {
    const json& list = io.at(key);
    if (!list.is_array()) io.fail(key, "an array of arrays");
    for (std::size_t i = 0; i < list.size(); ++i)
        take(row_of<Number>(list[i], count, file, fmt::format("/{}/{}", key, i)));
}

pipeline::Matrix matrix_at(JsonReader& io, const std::string& key, const std::string& file) {
    std::array<double, 16> entries{};
    const auto numbers = row_of<double>(io.at(key), 16, file, "/" + key);
    std::copy(numbers.begin(), numbers.end(), entries.begin());
    return matrix_of(entries);
}

// Rows of one index are points, of two lines, of three triangles; the first row decides.
void read_indices(JsonReader& io, const std::string& path, Mesh& mesh) {
    const json& rows = io.at("indices");
    const bool has_row = rows.is_array() && !rows.empty() && rows[0].is_array();
    const std::size_t corners = has_row ? rows[0].size() : 3;
    if (corners < 1 || corners > 3)
        throw InputError(path, "/indices/0", "an array of 1, 2 or 3 numbers", fmt::format("one of {}", corners));
    mesh.primitive = rasterizer::primitive_of(corners);
    std::size_t number = 0;
    for_each_row<std::uint32_t>(io, "indices", corners, path, [&](const std::vector<std::uint32_t>& row) {
        for (std::size_t i = 0; i < row.size(); ++i)
            if (row[i] >= mesh.positions.size())
                throw InputError(path, fmt::format("/indices/{}/{}", number, i),
                                 fmt::format("less than {}, the number of positions", mesh.positions.size()),
                                 std::to_string(row[i]));
        rasterizer::append_primitive(mesh.indices, row);
        ++number;
    });
}

Mesh mesh_of_json(const std::string& path, std::optional<pipeline::View>& view) {
    const json document = parse_strict_json(read_text_file(path, most_json_bytes), path, "triangles in JSON");
    JsonReader io{document, path, ""};
    Mesh mesh;
    const json& first = io.at("positions");
    const bool is_homogeneous = first.is_array() && !first.empty() && first[0].is_array() && first[0].size() == 4;
    for_each_row<float>(io, "positions", is_homogeneous ? 4 : 3, path, [&](const std::vector<float>& p) {
        mesh.positions.push_back({p[0], p[1], p[2]});
        if (is_homogeneous) mesh.w.push_back(p[3]);
    });
    if (is_homogeneous) view = pipeline::View{};
    if (io.has("colors"))
        for_each_row<float>(io, "colors", 4, path, [&](const std::vector<float>& c) {
            mesh.colors.push_back({c[0], c[1], c[2], c[3]});
        });
    else
        mesh.colors.assign(mesh.positions.size(), half_white);
    if (mesh.colors.size() != mesh.positions.size())
        throw InputError(path, "/colors", fmt::format("{} colours, one per position", mesh.positions.size()),
                         std::to_string(mesh.colors.size()));
    const bool has_indices = io.has("indices"), has_view = io.has("view"), has_projection = io.has("projection");
    if (!has_indices && mesh.positions.size() % 3 != 0)
        throw InputError(path, "/positions", "three per triangle, as there are no indices",
                         std::to_string(mesh.positions.size()));
    if (has_indices)
        read_indices(io, path, mesh);
    else
        number_through(mesh);
    if (has_view || has_projection) view = {matrix_at(io, "view", path), matrix_at(io, "projection", path)};
    io.end();
    return mesh;
}

}  // namespace

bool is_plain_triangles(const std::string& path) { return path.ends_with(".npy") || path.ends_with(".json"); }

bool is_array_of_triangles(const std::string& path) {
    std::error_code error;
    if (!path.ends_with(".npy") || !std::filesystem::is_regular_file(path, error)) return false;
    try {
        return coordinates_of(read_npy(path)) != 0;
    } catch (const InputError&) {
        return false;  // its reader says what is wrong with it
    }
}

Scene load_plain_triangles(const std::string& path, const SceneOptions& options) {
    const FloatEnvironment environment;
    if (options.scene.value_or(0) != 0)
        throw InputError(path, "--scene", "0, the only one", std::to_string(*options.scene));
    Scene scene;
    scene.name = std::filesystem::path(path).stem().string();
    Mesh mesh = path.ends_with(".npy") ? mesh_of_npy(path, scene.own_view) : mesh_of_json(path, scene.own_view);
    mesh.name = "triangles";
    for (Rgba& color : mesh.colors) color = from_encoded(color, options.color_space);
    scene.list.materials = {
        {.name = "triangles", .alpha_mode = pipeline::AlphaMode::blend, .double_sided = true, .unlit = true}};
    scene.list.meshes.push_back(std::move(mesh));
    scene.list.instances.push_back({.mesh = 0, .material = 0});
    pipeline::check(scene.list);
    scene.bounds = bounds_of(scene.list);
    return scene;
}

}  // namespace strata::scenes
