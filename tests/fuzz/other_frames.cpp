#include "tests/fuzz/other_frames.h"

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <string_view>
#include <utility>

#include "peeling/registry.h"
#include "peeling/render.h"

namespace strata::fuzz {

using pipeline::AlphaMode;
using pipeline::Instance;
using pipeline::Material;
using pipeline::Mesh;

namespace {

// All other algorithms process fragments not only by depth: in submission order, by object, a limited number, or by two
// depths.
constexpr std::array<std::string_view, 10> by_depth{
    "depth_units", "front_to_back",    "dual",           "dual_independent", "layer_peel",
    "a_buffer",    "coherent_stencil", "coherent_blend", "coherent_ideal",   "depth_pass"};

// std::shuffle's order depends on the standard library.
template <class T, class Random>
void permute(std::vector<T>& values, Random& random) {
    for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[random() % i]);
}

template <class Random>
void permute_triangles_of(Mesh& mesh, Random& random) {
    std::vector<std::array<std::uint32_t, 3>> triangles(mesh.indices.size() / 3);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) triangles[i / 3][i % 3] = mesh.indices[i];
    permute(triangles, random);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = triangles[i / 3][i % 3];
}

bool compares_what_it_stores(const peeling::RenderOptions& o) {
    return !o.reference_path && o.compare_epsilon == pipeline::CompareEpsilon{} && o.quantize_reference &&
           o.vertex_paths == peeling::VertexPaths{};
}

// True if fragments tie by the stored or by the exact codes.
bool has_ties(const FrameCase& frame, const peeling::Algorithm& algorithm) {
    peeling::RenderOptions options = frame.options;
    options.keep_layers = false;
    peeling::Renderer renderer{frame.list, frame.view, frame.profile, options};
    std::set<std::pair<std::uint32_t, std::uint32_t>> codes, exact;
    for (const auto& fragment : renderer.fragments(algorithm).all)
        if (!codes.emplace(fragment.pixel, fragment.code).second ||
            !exact.emplace(fragment.pixel, fragment.exact_code).second)
            return true;
    return false;
}

}  // namespace

void add_idle_state(FrameCase& frame) {
    const int white = static_cast<int>(frame.list.textures.size());
    pipeline::Texture texture;
    texture.width = texture.height = 1;
    texture.texels.assign(4, 255);
    frame.list.textures.push_back(texture);
    for (Material& material : frame.list.materials)
        if (material.texture < 0) material.texture = white;
    auto& raster = frame.options.raster;
    if (!raster.scissor) raster.scissor = {0, 0, frame.options.width, frame.options.height};
    if (!raster.polygon_offset.enabled) raster.polygon_offset = {true, 0, 0};
    frame.ways.back().effects = pipeline::Effects::all;
}

bool can_move(const FrameCase& frame) {
    const rasterizer::RasterRules& rules = frame.profile.raster;
    return rules.plane_rule == rasterizer::PlaneRule::exact &&
           rules.coverage == rasterizer::CoverageRule::snapped_edges &&
           frame.algorithm != "stochastic";  // its masks depend on the pixel's position
}

void move_by_tiles(FrameCase& frame) { frame.options.window_origin = {tiles_x, tiles_y}; }

bool has_order_by_depth(const FrameCase& frame) {
    const peeling::RenderOptions& o = frame.options;
    if (std::find(by_depth.begin(), by_depth.end(), frame.algorithm) == by_depth.end()) return false;
    if (frame.algorithm == "depth_pass") return true;
    // A run is blended in one pass, and the division of a list into runs depends on its order; where each pass rounds
    // once, so do colours.
    const bool rounds_passes = frame.profile.blend_storage != pipeline::BlendStorage::target;
    if (rounds_passes && frame.algorithm.starts_with("coherent_")) return false;
    if (o.termination.rule != pipeline::TerminationRule::exact || o.max_passes != 0 ||
        o.formulation != pipeline::Formulation::resolved || !compares_what_it_stores(o))
        return false;
    const peeling::Algorithm& algorithm = *peeling::find_algorithm(frame.algorithm);
    return !peeling::refusal(algorithm, frame.profile) && !has_ties(frame, algorithm);
}

void permute_triangles(FrameCase& frame) {
    std::mt19937 random{static_cast<std::uint32_t>(frame.list.instances.size())};
    std::vector<Instance*> places;
    std::vector<Instance> moved;
    for (Instance& instance : frame.list.instances) {
        const bool is_transparent =
            frame.options.alpha || frame.list.materials[instance.material].alpha_mode == AlphaMode::blend;
        if (!is_transparent) continue;
        Mesh mesh = frame.list.meshes[instance.mesh];
        permute_triangles_of(mesh, random);
        places.push_back(&instance);
        moved.push_back(instance);
        moved.back().mesh = static_cast<std::uint32_t>(frame.list.meshes.size());
        frame.list.meshes.push_back(std::move(mesh));
    }
    permute(moved, random);
    for (std::size_t i = 0; i < moved.size(); ++i) *places[i] = moved[i];
}

}  // namespace strata::fuzz
