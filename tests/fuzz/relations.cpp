#include "tests/fuzz/relations.h"

#include <array>
#include <ostream>

#include "tests/fuzz/differential.h"
#include "tests/fuzz/other_frames.h"
#include "tests/support/difference.h"

namespace strata::fuzz {

namespace {

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

}  // namespace

bool check_relations(std::span<const std::uint8_t> bytes, RelationCounts& held, std::ostream& out) {
    FrameCase frame = make_case(bytes);
    frame.profile = *pipeline::find_profile(frame.profile.name);  // rules of other devices have their own relations
    if (frame.profile.raster.coverage == rasterizer::CoverageRule::float_spans) leave_samples(frame.options.raster);
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
    return true;
}

}  // namespace strata::fuzz
