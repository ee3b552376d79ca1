// tools/strata/scene.cpp - strata scene: prints the contents of a model without rendering it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "tools/strata/command.h"
#include "tools/strata/messages.h"
#include "tools/strata/options/options.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

using nlohmann::ordered_json;

struct InspectOptions {
    std::string scene;
    PictureRequest request;
    bool json = false;
};

// The names of glTF.
constexpr std::string_view alpha_mode_name(pipeline::AlphaMode mode) {
    switch (mode) {
        case pipeline::AlphaMode::opaque: return "OPAQUE";
        case pipeline::AlphaMode::mask: return "MASK";
        case pipeline::AlphaMode::blend: break;
    }
    return "BLEND";
}

// Totals over instances: a mesh with two instances counts twice.
struct Drawn {
    std::uint64_t instances = 0, triangles = 0, lines = 0, points = 0;
};

// Counts the instances whose material has this mode; without a mode, all of them.
Drawn drawn(const pipeline::DrawList& list, std::optional<pipeline::AlphaMode> mode) {
    Drawn sum;
    for (const auto& instance : list.instances) {
        if (mode && list.materials[instance.material].alpha_mode != *mode) continue;
        ++sum.instances;
        const pipeline::Mesh& mesh = list.meshes[instance.mesh];
        const rasterizer::Shape shape = shape_of(mesh.primitive);
        std::uint64_t& kind = shape == rasterizer::Shape::line    ? sum.lines
                              : shape == rasterizer::Shape::point ? sum.points
                                                                  : sum.triangles;
        kind += mesh.indices.size() / 3;
    }
    return sum;
}

std::vector<std::string> materials_of(const pipeline::DrawList& list, pipeline::AlphaMode mode) {
    std::vector<std::string> names;
    for (const auto& material : list.materials)
        if (material.alpha_mode == mode) names.push_back(material.name);
    return names;
}

// The names, of masks with the alpha from which they are drawn.
std::vector<std::string> materials_with_cutoffs(const pipeline::DrawList& list, pipeline::AlphaMode mode) {
    if (mode != pipeline::AlphaMode::mask) return materials_of(list, mode);
    std::vector<std::string> texts;
    for (const auto& m : list.materials)
        if (m.alpha_mode == mode)
            texts.push_back(m.front[3] < m.alpha_cutoff ? m.name + ": never drawn"
                                                        : fmt::format("{} from alpha {}", m.name, m.alpha_cutoff));
    return texts;
}

// In the order of the enum.
constexpr std::array alpha_modes{pipeline::AlphaMode::opaque, pipeline::AlphaMode::mask, pipeline::AlphaMode::blend};

// Their kinds, in the order of the file.
std::vector<std::string> lights_of(const pipeline::DrawList& list) {
    std::vector<std::string> kinds;
    for (const pipeline::Light& light : list.lights) kinds.emplace_back(enum_name(light.type));
    return kinds;
}

ordered_json to_json(const scenes::Scene& scene) {
    ordered_json modes = ordered_json::object(), textures = ordered_json::array(), cameras = ordered_json::array();
    for (const auto mode : alpha_modes) {
        const Drawn part = drawn(scene.list, mode);
        modes[std::string(alpha_mode_name(mode))] = {{"instances", part.instances},
                                                     {"triangles", part.triangles},
                                                     {"lines", part.lines},
                                                     {"points", part.points},
                                                     {"materials", materials_of(scene.list, mode)}};
    }
    for (const auto& texture : scene.list.textures) {
        textures.push_back({{"name", texture.name}, {"width", texture.width}, {"height", texture.height}});
    }
    for (const auto& camera : scene.cameras) cameras.push_back(camera.name);
    ordered_json ignored_alpha = ordered_json::array();
    for (const auto& one : scene.opaque_with_alpha)
        ignored_alpha.push_back({{"material", one.material}, {"of", one.of}});
    ordered_json material_names = ordered_json::array();
    for (const auto& material : scene.list.materials) material_names.push_back(material.name);
    // null, because JSON has no empty box.
    ordered_json bounds = nullptr;
    if (!scene.bounds.is_empty()) bounds = {{"lo", components(scene.bounds.lo)}, {"hi", components(scene.bounds.hi)}};
    const Drawn all = drawn(scene.list, std::nullopt);
    return {{"name", scene.name},
            {"scene", scene.scene_index},
            {"scenes", scene.scene_count},
            {"meshes", scene.list.meshes.size()},
            {"materials", scene.list.materials.size()},
            {"material_names", material_names},
            {"instances", all.instances},
            {"triangles", all.triangles},
            {"lines", all.lines},
            {"points", all.points},
            {"alpha_modes", modes},
            {"opaque_with_alpha", ignored_alpha},
            {"textures", textures},
            {"cameras", cameras},
            {"lights", lights_of(scene.list)},
            {"extensions", scene.extensions},
            {"bounds", bounds},
            {"moved_by", components(scene.moved_by)},
            {"warnings", scene.warnings}};
}

std::string with_commas(const std::vector<std::string>& parts) {
    return parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "));
}

// The first names, as in " (wall, pane)". The JSON output has all of them.
std::string in_brackets(std::vector<std::string> names) {
    constexpr std::size_t most = 12;
    if (names.empty()) return "";
    const bool has_more = names.size() > most;
    names.resize(std::min(names.size(), most));
    return fmt::format(" ({}{})", fmt::join(names, ", "), has_more ? ", ..." : "");
}

// The number of significant digits, from 6, that shows each side of the box to a hundredth of its length.
int digits_of(const scenes::Bounds& bounds) {
    int digits = 6;
    for (std::size_t i = 0; i < 3; ++i) {
        const double side = bounds.hi[i] - bounds.lo[i];
        const double largest = std::max(std::abs(bounds.lo[i]), std::abs(bounds.hi[i]));
        if (side > 0) digits = std::max(digits, static_cast<int>(std::ceil(std::log10(largest / side))) + 3);
    }
    return std::min(digits, 17);
}

// For the terminal. The JSON output has all digits.
std::string bounds_text(const scenes::Bounds& bounds) {
    if (bounds.is_empty()) return "empty";
    const int digits = digits_of(bounds);
    const auto point = [&](const Vec3d& p) {
        return fmt::format("({:.{}g}, {:.{}g}, {:.{}g})", p[0], digits, p[1], digits, p[2], digits);
    };
    return point(bounds.lo) + " to " + point(bounds.hi);
}

// "leaf (texture), pane (factor, vertex colours)".
std::string ignored_alpha_text(const scenes::Scene& scene) {
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < scene.opaque_with_alpha.size(); ++i) {
        const auto& one = scene.opaque_with_alpha[i];
        const bool is_further = i > 0 && scene.opaque_with_alpha[i - 1].material == one.material;
        if (is_further)
            parts.back().insert(parts.back().size() - 1, ", " + one.of);
        else
            parts.push_back(fmt::format("{} ({})", one.material, one.of));
    }
    return fmt::format("{}: drawn with alpha 1, because the mode is OPAQUE; MASK or BLEND in the file keeps the alpha",
                       with_commas(parts));
}

// "1728", "8000 lines", "12 and 3 points".
std::string counts_text(const Drawn& part) {
    std::vector<std::string> counts;
    if (part.triangles > 0 || part.lines + part.points == 0) counts.push_back(std::to_string(part.triangles));
    if (part.lines > 0) counts.push_back(fmt::format("{} lines", part.lines));
    if (part.points > 0) counts.push_back(fmt::format("{} points", part.points));
    return fmt::format("{}", fmt::join(counts, " and "));
}

// The properties of the scene as a table, one per line.
std::string describe(const scenes::Scene& scene) {
    const Drawn all = drawn(scene.list, std::nullopt);
    std::vector<std::string> textures, cameras;
    for (const auto& t : scene.list.textures)
        textures.push_back(fmt::format("{} {}x{}", t.name.empty() ? "unnamed" : t.name, t.width, t.height));
    for (const auto& camera : scene.cameras) cameras.push_back(camera.name);
    Table table{{{scene.name}, {fmt::format("scene {} of {}", scene.scene_index, scene.scene_count)}}, {}};
    table.rows.push_back({"meshes", fmt::format("{}, drawn {} times", scene.list.meshes.size(), all.instances)});
    table.rows.push_back({"triangles", std::to_string(all.triangles)});
    if (all.lines > 0) table.rows.push_back({"lines", std::to_string(all.lines)});
    if (all.points > 0) table.rows.push_back({"points", std::to_string(all.points)});
    for (const auto mode : alpha_modes) {
        const Drawn part = drawn(scene.list, mode);
        table.rows.push_back(
            {fmt::format("  {}", alpha_mode_name(mode)),
             fmt::format("{}{}", counts_text(part), in_brackets(materials_with_cutoffs(scene.list, mode)))});
    }
    table.rows.push_back({"materials", fmt::format("{}", scene.list.materials.size())});
    if (!scene.opaque_with_alpha.empty()) table.rows.push_back({"alpha lost", ignored_alpha_text(scene)});
    table.rows.push_back({"textures", with_commas(textures)});
    table.rows.push_back({"cameras", with_commas(cameras)});
    if (!scene.list.lights.empty()) table.rows.push_back({"lights", with_commas(lights_of(scene.list))});
    table.rows.push_back({"extensions", with_commas(scene.extensions)});
    table.rows.push_back({"bounds", bounds_text(scene.bounds)});
    if (scene.moved_by != Vec3d{0, 0, 0})
        table.rows.push_back(
            {"moved by", fmt::format("({}, {}, {})", scene.moved_by[0], scene.moved_by[1], scene.moved_by[2])});
    table.rows.push_back({"warnings", scene.warnings.empty() ? "none" : scene.warnings.front()});
    for (std::size_t i = 1; i < scene.warnings.size(); ++i) table.rows.push_back({"", scene.warnings[i]});
    return to_text(table);
}

// Warns, with advice, if nothing of the scene would be rendered.
void warn_of_empty(const std::string& path, const scenes::Scene& scene) {
    const Drawn all = drawn(scene.list, std::nullopt);
    if (all.triangles + all.lines + all.points > 0) return;
    say_warning(path + ": nothing would be drawn, because the scene has no triangles, lines or points; " +
                (scene.scene_count > 1
                     ? fmt::format("--scene N, 0 to {}, chooses another scene of the file", scene.scene_count - 1)
                     : std::string("export its meshes, or try a built-in scene: strata list scenes shows them")));
}

}  // namespace

Command add_scene(CLI::App& root) {
    auto* app =
        root.add_subcommand("scene", "show what a model holds: meshes, alpha modes, textures, cameras, warnings");
    const auto options = std::make_shared<InspectOptions>();
    add_scene_options(*app, options->scene, options->request);
    app->add_flag("--json", options->json, "one JSON document instead of the text");
    app->footer(footer("  strata scene teapot\n  strata scene volume-beam:slices=16 --json\n"));
    return {app, [options] {
                const scenes::Scene scene = scenes::load_scene(options->scene, options->request.scene_options);
                print(options->json ? to_json(scene).dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n'
                                    : describe(scene));
                warn_of_empty(options->scene, scene);
                return 0;
            }};
}

}  // namespace strata::tools
