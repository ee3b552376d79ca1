#include "tools/oracle/reduce/cut_scene.h"

#include <map>

namespace strata::oracle {

using pipeline::DrawList;
using pipeline::Mesh;

std::vector<TriangleName> triangles_of(const DrawList& list) {
    std::vector<TriangleName> all;
    for (std::uint32_t i = 0; i < list.instances.size(); ++i) {
        const std::size_t count = list.meshes[list.instances[i].mesh].indices.size() / 3;
        for (std::uint32_t t = 0; t < count; ++t) all.push_back({i, t});
    }
    return all;
}

namespace {

// Copies vertices on first use.
class MeshCut {
  public:
    MeshCut(const Mesh& from, Mesh& to) : from_{from}, to_{to} {
        to_.name = from.name;
        to_.primitive = from.primitive;
    }

    void add(std::uint32_t triangle) {
        for (std::size_t corner = 0; corner < 3; ++corner)
            to_.indices.push_back(vertex(from_.indices[3 * triangle + corner]));
    }

  private:
    std::uint32_t vertex(std::uint32_t old) {
        const auto [found, is_new] = numbers_.emplace(old, static_cast<std::uint32_t>(to_.positions.size()));
        if (is_new) {
            to_.positions.push_back(from_.positions[old]);
            if (!from_.w.empty()) to_.w.push_back(from_.w[old]);
            if (!from_.normals.empty()) to_.normals.push_back(from_.normals[old]);
            if (!from_.colors.empty()) to_.colors.push_back(from_.colors[old]);
            if (!from_.texcoords.empty()) to_.texcoords.push_back(from_.texcoords[old]);
        }
        return found->second;
    }

    const Mesh& from_;
    Mesh& to_;
    std::map<std::uint32_t, std::uint32_t> numbers_;
};

// The new index of element `old`, which is copied on first use.
template <class T>
std::uint32_t kept(std::uint32_t old, const std::vector<T>& from, std::vector<T>& to,
                   std::map<std::uint32_t, std::uint32_t>& numbers) {
    const auto [found, is_new] = numbers.emplace(old, static_cast<std::uint32_t>(to.size()));
    if (is_new) to.push_back(from[old]);
    return found->second;
}

}  // namespace

DrawList cut(const DrawList& list, std::span<const TriangleName> triangles) {
    DrawList result;
    result.light = list.light;
    result.lights = list.lights;
    std::map<std::uint32_t, std::uint32_t> materials, textures;
    for (std::size_t first = 0; first < triangles.size();) {
        const std::uint32_t number = triangles[first].instance;
        pipeline::Instance instance = list.instances[number];
        Mesh mesh;
        MeshCut cutter{list.meshes[instance.mesh], mesh};
        while (first < triangles.size() && triangles[first].instance == number) cutter.add(triangles[first++].triangle);
        instance.mesh = static_cast<std::uint32_t>(result.meshes.size());
        instance.material = kept(instance.material, list.materials, result.materials, materials);
        result.meshes.push_back(std::move(mesh));
        result.instances.push_back(instance);
    }
    for (pipeline::Material& material : result.materials)
        if (material.texture >= 0)
            material.texture = static_cast<int>(
                kept(static_cast<std::uint32_t>(material.texture), list.textures, result.textures, textures));
    return result;
}

pipeline::View through(const pipeline::View& view, int width, int height, const rasterizer::Rect& part) {
    pipeline::View result = view;
    const double scale_x = static_cast<double>(width) / part.width(),
                 scale_y = static_cast<double>(height) / part.height();
    const double center_x = static_cast<double>(part.x0 + part.x1) / width - 1;
    const double center_y = 1 - static_cast<double>(part.y0 + part.y1) / height;
    for (int c = 0; c < 4; ++c) {
        auto& column = result.projection[c];
        column[0] = (column[0] - center_x * column[3]) * scale_x;
        column[1] = (column[1] - center_y * column[3]) * scale_y;
    }
    return result;
}

}  // namespace strata::oracle
