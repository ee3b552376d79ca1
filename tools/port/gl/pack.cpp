// tools/port/gl/pack.cpp - reads a golden pack's scene and state, refuses state that the port does not draw, and writes
// a candidate (pack.h).
#include "tools/port/gl/pack.h"

#include <fmt/format.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "tools/port/gl/npy.h"

namespace strata::port {

namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

// A parsed manifest.json, and its path for error messages.
struct Manifest {
    std::string folder, file;
    ordered_json json;

    [[noreturn]] void refuse(const std::string& place, const std::string& expected, const std::string& found) const {
        throw std::runtime_error(fmt::format("{}: {}: expected {}, found {}", file, place, expected, found));
    }
    [[nodiscard]] const ordered_json& at(const std::string& place) const {
        const ordered_json::json_pointer pointer(place);
        if (!json.contains(pointer)) refuse(place, "a value", "none");
        return json.at(pointer);
    }
    [[nodiscard]] std::string text(const std::string& place) const {
        if (!at(place).is_string()) refuse(place, "a string", at(place).dump());
        return at(place).get<std::string>();
    }
    [[nodiscard]] int number(const std::string& place) const {
        if (!at(place).is_number_integer()) refuse(place, "an integer", at(place).dump());
        return at(place).get<int>();
    }
    // Component i of a vector; the manifest stores binary32 bits as hex text in "bits".
    [[nodiscard]] float real(const std::string& place, std::size_t i) const {
        const std::string bits = text(fmt::format("{}/bits/{}", place, i));
        return std::bit_cast<float>(static_cast<std::uint32_t>(std::stoul(bits, nullptr, 16)));
    }
    [[nodiscard]] std::string array(const std::string& place) const { return folder + "/" + text(place); }
};

Manifest load(const std::string& folder) {
    Manifest manifest{folder, folder + "/manifest.json", {}};
    std::ifstream stream(manifest.file);
    if (!stream) throw std::runtime_error(manifest.file + ": expected a pack's manifest, found no such file");
    try {
        manifest.json = ordered_json::parse(stream);
    } catch (const ordered_json::parse_error& error) {
        throw std::runtime_error(manifest.file + ": expected JSON, found an error: " + error.what());
    }
    if (manifest.text("/format") != "strata-pack") manifest.refuse("/format", "strata-pack", manifest.text("/format"));
    if (manifest.number("/version") != 1) manifest.refuse("/version", "1", std::to_string(manifest.number("/version")));
    return manifest;
}

// Returns `usual` if the value is null.
PixelFormat format_at(const Manifest& manifest, const std::string& place, const PixelFormat& usual) {
    if (manifest.at(place).is_null()) return usual;
    const PixelFormat* const format = find_format(manifest.text(place));
    if (format == nullptr) manifest.refuse(place, "a format that OpenGL stores", manifest.text(place));
    return *format;
}

bool choice(const Manifest& manifest, const std::string& place, const std::string& no, const std::string& yes) {
    const std::string found = manifest.text(place);
    if (found != no && found != yes) manifest.refuse(place, no + " or " + yes, found);
    return found == yes;
}

// Rejects state that the port does not implement. A missing key means the default.
void check_state(const Manifest& manifest) {
    const ordered_json& state = manifest.at("/state");
    for (const char* const choice : {"depth_path", "reference_path"})
        if (state.contains(choice) && !state.at(choice).is_null())
            manifest.refuse(std::string("/state/") + choice, "null", state.at(choice).dump());
    if (state.contains("algorithm") && !state.at("algorithm").is_null())
        manifest.refuse("/state/algorithm", "none: the port has each algorithm's usual options", "some");
    if (state.contains("options") && state.at("options").contains("line_stipple"))
        manifest.refuse("/state/options/line_stipple", "none: the port has no line stipple", "one");
    // Lit colours are those of the pack's vertices, which have one colour.
    const std::string model = state.value(ordered_json::json_pointer("/options/light_model"), "");
    if (model.find("separate-specular") != std::string::npos)
        manifest.refuse("/state/options/light_model", "no separate-specular: the port has no secondary colours", model);
    const ordered_json& offset = manifest.at("/state/polygon_offset");
    if (offset.is_object() && offset.value("enabled", false))
        manifest.refuse("/state/polygon_offset", "none: the port has no polygon offset", "one");
}

// Of a pack of one sample nothing: the caller names it.
PackSampling sampling_of(const Manifest& manifest) {
    const std::string place = "/state/sampling";
    if (!manifest.json.contains(ordered_json::json_pointer(place + "/all"))) return {};
    const ordered_json& state = manifest.at(place);
    if (state.value("alpha_to_coverage", false) || !state.value("coverage", ordered_json()).is_null() ||
        state.value("mask", 255) != 255)
        manifest.refuse(place, "no sample coverage, mask or alpha to coverage", "some");
    if (manifest.text(place + "/all/resolve") != "box")
        manifest.refuse(place + "/all/resolve", "box", manifest.text(place + "/all/resolve"));
    PackSampling sampling{static_cast<int>(manifest.at(place + "/samples").size()),
                          manifest.text(place + "/interpolation"), manifest.text(place + "/all/loads"),
                          manifest.text(place + "/all/composites")};
    for (const char* const loads : {"/all/loads", "/all/composites"})
        if (manifest.text(place + loads) == "resolved") manifest.refuse(place + loads, "own or zero", "resolved");
    if (sampling.interpolation != "sample" && sampling.loads != "zero")
        manifest.refuse(place + "/all/loads", "zero: programs that run once a pixel load sample 0", sampling.loads);
    return sampling;
}

// Rejects materials for which the port has no shader.
void check_material(const Manifest& manifest, std::uint32_t number) {
    const std::string place = fmt::format("/scene/materials/{}", number);
    const ordered_json& texture = manifest.at(place + "/texture");
    if (!texture.is_null() && texture != -1)
        manifest.refuse(place + "/texture", "none: the port draws no textures", "one");
    if (manifest.text(place + "/alpha_mode") == "mask")
        manifest.refuse(place + "/alpha_mode", "opaque or blend: the port has no alpha test", "mask");
}

void append_vertices(const Manifest& manifest, const std::string& place, IndexedMesh& mesh) {
    const auto clip = read_rows<float>(manifest.array(place + "/clip"), "f4", 4);
    const auto front = read_rows<float>(manifest.array(place + "/front"), "f4", 4);
    const auto back = read_rows<float>(manifest.array(place + "/back"), "f4", 4);
    if (front.size() != clip.size() || back.size() != clip.size())
        manifest.refuse(place, "as many colours as positions", "other numbers");
    const auto four = [](const std::vector<float>& values, std::size_t i) {
        return std::array{values[i], values[i + 1], values[i + 2], values[i + 3]};
    };
    for (std::size_t i = 0; i < clip.size(); i += 4)
        mesh.vertices.push_back({four(clip, i), four(front, i), four(back, i)});
}

// What the primitives of an instance are.
DrawKind kind_of(const Manifest& manifest, std::uint32_t instance) {
    const int mesh = manifest.number(fmt::format("/scene/instances/{}/mesh", instance));
    const std::string place = fmt::format("/scene/meshes/{}/primitive", mesh);
    if (!manifest.json.contains(ordered_json::json_pointer(place))) return DrawKind::triangles;
    const std::string found = manifest.text(place);
    if (found == "lines" || found == "line_strips") return DrawKind::lines;
    if (found != "points") manifest.refuse(place, "lines or points: the port draws no parts of polygons", found);
    return DrawKind::points;
}

// The corners of a primitive that OpenGL is given: a line's are its first end twice and its second, a point's its
// vertex three times.
std::span<const std::uint32_t> given(std::span<const std::uint32_t> three, DrawKind kind) {
    return kind == DrawKind::triangles ? three : three.subspan(kind == DrawKind::lines ? 1 : 2);
}

float size_option(const Manifest& manifest, const std::string& name) {
    const ordered_json::json_pointer place("/state/options/" + name);
    return manifest.json.contains(place) ? std::stof(manifest.json.at(place).get<std::string>()) : 1.0f;
}

// Appends the vertices, then merges consecutive primitives of one kind with equal flags into one draw.
void append_draws(const Manifest& manifest, const std::string& place, IndexedMesh& mesh) {
    constexpr unsigned double_sided = 1, mirrored = 2;
    const auto first_vertex = static_cast<std::uint32_t>(mesh.vertices.size());
    append_vertices(manifest, place, mesh);
    const auto corners = read_rows<std::uint32_t>(manifest.array(place + "/triangles"), "u4", 3);
    const auto flags = read_rows<std::uint8_t>(manifest.array(place + "/flags"), "u1", 1);
    const auto materials = read_rows<std::uint32_t>(manifest.array(place + "/materials"), "u4", 1);
    const auto objects = read_rows<std::uint32_t>(manifest.array(place + "/objects"), "u4", 1);
    if (flags.size() * 3 != corners.size() || materials.size() != flags.size() || objects.size() != flags.size())
        manifest.refuse(place, "flags, a material and an object for each triangle", "another number");
    const bool transparent = choice(manifest, place + "/list", "opaque", "transparent");
    auto kind = DrawKind::triangles;
    for (std::size_t i = 0; i < flags.size(); ++i) {
        if (i == 0 || materials[i] != materials[i - 1]) check_material(manifest, materials[i]);
        if (i == 0 || objects[i] != objects[i - 1]) kind = kind_of(manifest, objects[i]);
        if (i == 0 || flags[i] != flags[i - 1] || kind != mesh.draws.back().kind)
            mesh.draws.push_back({static_cast<std::uint32_t>(mesh.indices.size()), 0, transparent,
                                  (flags[i] & double_sided) != 0, (flags[i] & mirrored) != 0, kind});
        for (const std::uint32_t corner : given(std::span{corners}.subspan(3 * i, 3), kind)) {
            if (corner >= mesh.vertices.size() - first_vertex)
                manifest.refuse(place + "/triangles", "numbers of vertices", std::to_string(corner));
            mesh.indices.push_back(first_vertex + corner);
            ++mesh.draws.back().index_count;
        }
    }
}

}  // namespace

Pack read_pack(const std::string& folder) {
    const Manifest manifest = load(folder);
    Pack pack;
    pack.size = {manifest.number("/state/width"), manifest.number("/state/height")};
    pack.formats = {format_at(manifest, "/state/color_format", rgba8), format_at(manifest, "/state/depth", d32f)};
    for (std::size_t i = 0; i < 4; ++i) pack.background[i] = manifest.real("/state/background", i);
    pack.zero_to_one = choice(manifest, "/state/clip_depth", "minus_one_to_one", "zero_to_one");
    pack.is_reversed = manifest.at("/state").value("depth_order", "less") == "greater";
    check_state(manifest);
    pack.sampling = sampling_of(manifest);
    pack.mesh.line_width = size_option(manifest, "line_width");
    pack.mesh.point_size = size_option(manifest, "point_size");
    for (std::size_t i = 0; i < manifest.at("/draws").size(); ++i)
        append_draws(manifest, fmt::format("/draws/{}", i), pack.mesh);
    for (std::size_t i = 0; i < manifest.at("/results").size(); ++i)
        pack.algorithms.push_back(manifest.text(fmt::format("/results/{}/algorithm", i)));
    return pack;
}

void write_candidate(const std::string& folder, const std::string& made_by, const std::vector<Candidate>& candidates) {
    if (fs::exists(folder)) throw std::runtime_error(folder + ": expected no such folder, found one");
    const fs::path made = folder + ".part";
    fs::remove_all(made);
    for (const Candidate& candidate : candidates) {
        const fs::path place = made / candidate.algorithm;
        fs::create_directories(place);
        write_npy(place / "picture.npy", candidate.picture);
        for (std::size_t i = 0; i < candidate.record.layers.size(); ++i) {
            write_npy(place / fmt::format("layer.{:03}.color.npy", i), candidate.record.layers[i][0]);
            write_npy(place / fmt::format("layer.{:03}.depth.npy", i), candidate.record.layers[i][1]);
        }
        for (std::size_t i = 0; i < candidate.record.passes.size(); ++i) {
            const fs::path pass = place / fmt::format("pass.{:03}", i);
            fs::create_directories(pass);
            for (const NamedPicture& target : candidate.record.passes[i].targets)
                write_npy(pass / (target.name + ".npy"), target.image);
        }
    }
    std::ofstream(made / "candidate.json")
        << ordered_json{{"format", "strata-candidate"}, {"version", 1}, {"made_by", made_by}}.dump(2) << "\n";
    fs::rename(made, folder);
}

}  // namespace strata::port
