#include "tests/fuzz/relations.h"

#include <array>
#include <ostream>

#include "tests/fuzz/differential.h"
#include "tests/support/difference.h"

namespace strata::fuzz {

namespace {

using pipeline::DrawList;
using pipeline::Instance;
using pipeline::Mesh;

// Every instance as two, one behind the other, with half of its triangles each.
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

// No two triangles share a corner.
void part_corners(DrawList& list) {
    for (Mesh& mesh : list.meshes) {
        take_each(mesh.positions, mesh.indices);
        take_each(mesh.normals, mesh.indices);
        take_each(mesh.colors, mesh.indices);
        take_each(mesh.texcoords, mesh.indices);
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = static_cast<std::uint32_t>(i);
    }
}

void add_what_nobody_names(DrawList& list) {
    if (!list.meshes.empty()) list.meshes.push_back(list.meshes.front());
    if (!list.textures.empty()) list.textures.push_back(list.textures.front());
    for (const pipeline::AlphaMode mode : {pipeline::AlphaMode::mask, pipeline::AlphaMode::blend}) {
        pipeline::Material material;
        material.alpha_mode = mode;
        material.texture = static_cast<int>(list.textures.size()) - 1;
        list.materials.push_back(material);
    }
}

// Behind each mesh's triangles one whose three corners are one.
void add_points(DrawList& list) {
    for (Mesh& mesh : list.meshes)
        if (!mesh.indices.empty()) mesh.indices.insert(mesh.indices.end(), 3, mesh.indices.back());
}

struct Relation {
    const char* name;
    void (*change)(DrawList&);
    bool parts_objects = false, counts_triangles = false;  // what counts triangles may change
};

constexpr std::array<Relation, 4> relations{{{"meshes in two parts", split_meshes, true, false},
                                             {"corners apart", part_corners, false, false},
                                             {"more that nobody names", add_what_nobody_names, false, false},
                                             {"points added", add_points, false, true}}};

// object_sorted and batched draw object by object. Buckets and shuffles look at all triangles, points included.
bool holds_for(const Relation& relation, const FrameCase& frame) {
    using peeling::SortRule;
    const SortRule rule = frame.options.sort.rule;
    if (relation.parts_objects && (frame.algorithm == "object_sorted" || frame.algorithm == "batched")) return false;
    return !relation.counts_triangles || (rule != SortRule::bucket && rule != SortRule::shuffle);
}

}  // namespace

int check_relations(std::span<const std::uint8_t> bytes, std::ostream& out) {
    const FrameCase frame = make_case(bytes);
    const peeling::RenderResult expected = run(frame, frame.ways.front());
    int held = 0;
    for (const Relation& relation : relations) {
        if (!holds_for(relation, frame)) continue;
        FrameCase other = frame;
        relation.change(other.list);
        peeling::RenderResult found = run(other, frame.ways.back());
        if (relation.counts_triangles) {
            found.frame.counters = expected.frame.counters;
            found.frame.diagnostics = expected.frame.diagnostics;
            found.audit = expected.audit;
        }
        const std::string what = testing::difference(found, expected);
        if (what.empty()) {
            ++held;
            continue;
        }
        out << relation.name << ": another " << what << " of\n";
        print(out, frame.ways.back());
        out << '\n';
        print(out, frame);
        return 0;
    }
    return held;
}

}  // namespace strata::fuzz
