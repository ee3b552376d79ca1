#include "tests/fuzz/relations.h"

#include <algorithm>
#include <array>
#include <ostream>
#include <random>
#include <set>
#include <string_view>
#include <utility>

#include "peeling/algorithms/algorithm.h"
#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/device/sample_points.h"
#include "tests/fuzz/differential.h"
#include "tests/fuzz/frame_case.h"
#include "tests/support/difference.h"

namespace strata::fuzz {

namespace {

// Moves the viewport by whole tiles of every size. Only for devices whose planes are exact, not stepped from pixel to
// pixel.
inline constexpr int tiles_x = 384, tiles_y = 128;

using pipeline::AlphaMode;
using pipeline::Instance;
using pipeline::Material;
using pipeline::Mesh;

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
           o.vertex_paths == peeling::VertexPaths{} && o.raster.interpolation == rasterizer::Interpolation::sample &&
           !o.sampling.loads_others();
}

// True if fragments tie by the stored or by the exact codes.
bool has_ties(const FrameCase& frame, const peeling::Algorithm& algorithm) {
    peeling::RenderOptions options = frame.options;
    options.keep_layers = false;
    peeling::Renderer renderer{frame.list, frame.view, frame.profile, options};
    std::set<std::array<std::uint32_t, 3>> codes, exact;
    for (const auto& fragment : renderer.fragments(algorithm).all)
        if (!codes.insert({fragment.sample, fragment.pixel, fragment.code}).second ||
            !exact.insert({fragment.sample, fragment.pixel, fragment.exact_code}).second)
            return true;
    return false;
}

// Adds white texels, an offset of 0, a scissor as large as the viewport, and all effects.
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

// True if no two transparent fragments of a pixel have equal depths and the algorithm orders them by depth alone.
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

// Changes the order of the transparent instances and of the triangles in each.
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

using pipeline::DrawList;
using pipeline::Instance;
using pipeline::Mesh;

// Splits every instance into two, one after the other, with half of its triangles each.
void split_meshes(DrawList& list) {
    std::vector<Instance> parts;
    for (const Instance& whole : list.instances) {
        const Mesh mesh = list.meshes[whole.mesh];
        const auto half = static_cast<std::ptrdiff_t>(mesh.indices.size() / 6 * 3);
        Mesh first = mesh, second = mesh;
        first.indices.assign(mesh.indices.begin(), mesh.indices.begin() + half);
        second.indices.assign(mesh.indices.begin() + half, mesh.indices.end());
        for (Mesh* const part : {&first, &second}) {
            if (part->indices.empty()) continue;
            Instance instance = whole;
            instance.mesh = static_cast<std::uint32_t>(list.meshes.size());
            list.meshes.push_back(std::move(*part));
            parts.push_back(instance);
        }
    }
    list.instances = std::move(parts);
}

template <class T>
void take_each(std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
    if (values.empty()) return;
    std::vector<T> taken;
    for (const std::uint32_t i : indices) taken.push_back(values[i]);
    values = std::move(taken);
}

// Gives every triangle separate vertices.
void part_corners(DrawList& list) {
    for (Mesh& mesh : list.meshes) {
        take_each(mesh.positions, mesh.indices);
        take_each(mesh.normals, mesh.indices);
        take_each(mesh.colors, mesh.indices);
        take_each(mesh.texcoords, mesh.indices);
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = static_cast<std::uint32_t>(i);
    }
}

void add_unreferenced(DrawList& list) {
    if (!list.meshes.empty()) list.meshes.push_back(list.meshes.front());
    if (!list.textures.empty()) list.textures.push_back(list.textures.front());
    for (const pipeline::AlphaMode mode : {pipeline::AlphaMode::mask, pipeline::AlphaMode::blend}) {
        pipeline::Material material;
        material.alpha_mode = mode;
        material.texture = static_cast<int>(list.textures.size()) - 1;
        list.materials.push_back(material);
    }
}

// Adds a triangle with three equal corners at the end of each mesh.
void add_points(DrawList& list) {
    for (Mesh& mesh : list.meshes)
        if (!mesh.indices.empty()) mesh.indices.insert(mesh.indices.end(), 3, mesh.indices.back());
}

// Results that must be equal: everything, except that first pixels are moved by whole tiles; everything but counts of
// triangles; or only the picture and its layers.
enum class Stays : std::uint8_t { everything, but_places, but_counts, picture };

struct Relation {
    const char* name;
    bool (*holds_for)(const FrameCase&);
    void (*change)(FrameCase&);
    Stays stays = Stays::everything;
};

template <void (*change)(DrawList&)>
void to_list(FrameCase& frame) {
    change(frame.list);
}

bool always(const FrameCase&) { return true; }

// These two algorithms draw object by object.
bool has_no_objects(const FrameCase& frame) {
    return frame.algorithm != "object_sorted" && frame.algorithm != "batched";
}

// Buckets, shuffles and the masks of stochastic depend on the numbers of triangles, including points.
bool counts_no_triangles(const FrameCase& frame) {
    const peeling::SortRule rule = frame.options.sort.rule;
    return rule != peeling::SortRule::bucket && rule != peeling::SortRule::shuffle && frame.algorithm != "stochastic";
}

constexpr std::array<Relation, 7> relations{
    {{"meshes in two parts", has_no_objects, to_list<split_meshes>},
     {"corners apart", always, to_list<part_corners>},
     {"more that is not referenced", always, to_list<add_unreferenced>},
     {"points added", counts_no_triangles, to_list<add_points>, Stays::but_counts},
     {"state that changes nothing", always, add_idle_state},
     {"viewport moved by whole tiles", can_move, move_by_tiles, Stays::but_places},
     {"another order of triangles", has_order_by_depth, permute_triangles, Stays::picture}}};

// Moves a first pixel on the surface back to its position before the viewport moved.
template <class Count>
void move_back(Count& count) {
    if (count.first_x < 0) return;
    count.first_x -= tiles_x;
    count.first_y -= tiles_y;
}

// Copies the values that must not be compared from the other result.
void forgive(peeling::RenderResult& found, const peeling::RenderResult& expected, Stays stays) {
    if (stays == Stays::everything) return;
    if (stays == Stays::but_places) {
        for (peeling::PixelCount* const count : {&found.audit.ties, &found.audit.misordered, &found.audit.opaque_ties})
            move_back(*count);
        for (pipeline::Diagnostic& one : found.frame.diagnostics) move_back(one);
        return;
    }
    found.frame.counters = expected.frame.counters;
    found.frame.diagnostics = expected.frame.diagnostics;
    found.audit = expected.audit;
    if (stays == Stays::but_counts) return;
    found.frame.passes = expected.frame.passes;
    found.frame.iterations = expected.frame.iterations;
}

// Nodes of the frame, queries that choose a branch and ratios are of all samples; a peel that may never end has a limit
// of passes from the deepest sample.
bool has_samples_of_their_own(const FrameCase& frame) {
    const peeling::RenderOptions& o = frame.options;
    if (o.sampling.samples == 1 || frame.algorithm == "depth_pass" || !compares_what_it_stores(o)) return false;
    const peeling::Algorithm& algorithm = *peeling::find_algorithm(frame.algorithm);
    return !algorithm.stores && !algorithm.compares && !algorithm.whole_frame && !algorithm.shares_nodes &&
           !algorithm.compares_own_codes && o.termination.rule != pipeline::TerminationRule::ratio;
}

FrameCase of_sample(const FrameCase& frame, std::size_t sample) {
    FrameCase own = frame;
    own.options.sampling = {};
    set_sample(own.options.raster, frame.profile.sample_positions, frame.options.sampling.samples, sample);
    return own;
}

}  // namespace

bool check_relations(std::span<const std::uint8_t> bytes, RelationCounts& held, std::ostream& out) {
    FrameCase frame = make_case(bytes);
    frame.profile = *pipeline::find_profile(frame.profile.name);  // rules of other devices have their own relations
    if (frame.profile.raster.coverage == rasterizer::CoverageRule::float_spans)
        leave_samples(frame.options.raster), frame.options.sampling = {};
    const peeling::RenderResult expected = run(frame, frame.ways.front());
    for (const Relation& relation : relations) {
        if (expected.outcome == peeling::Outcome::refused && relation.stays == Stays::picture) continue;
        if (!relation.holds_for(frame)) continue;
        FrameCase other = frame;
        relation.change(other);
        peeling::RenderResult found = run(other, other.ways.back());
        forgive(found, expected, relation.stays);
        const std::string what = testing::difference(found, expected);
        if (what.empty()) {
            ++held[relation.name];
            continue;
        }
        out << relation.name << ": another " << what << " of\n";
        print(out, frame.ways.back());
        out << '\n';
        print(out, frame);
        return false;
    }
    if (!has_samples_of_their_own(frame) || expected.outcome == peeling::Outcome::refused) return true;
    for (std::size_t sample = 0; sample < expected.frame.samples.size(); ++sample) {
        const peeling::RenderResult own = run(of_sample(frame, sample), frame.ways.back());
        if (own.frame.color == expected.frame.samples[sample]) continue;
        out << "sample " << sample << " of a frame is not the frame of that sample alone:\n";
        print(out, frame);
        return false;
    }
    ++held["samples alone"];
    return true;
}

}  // namespace strata::fuzz
