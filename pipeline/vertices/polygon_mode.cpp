// pipeline/vertices/polygon_mode.cpp - writes each triangle as three primitives (polygon_mode.h).
#include "pipeline/vertices/polygon_mode.h"

namespace strata::pipeline {

DrawList with_polygon_mode(DrawList list, PolygonMode mode) {
    if (mode == PolygonMode::fill) return list;
    const bool is_line = mode == PolygonMode::line;
    for (Mesh& mesh : list.meshes) {
        if (mesh.primitive != Primitive::triangles) continue;
        mesh.primitive = is_line ? Primitive::polygon_lines : Primitive::polygon_points;
        std::vector<std::uint32_t> parts;
        parts.reserve(3 * mesh.indices.size());
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
            // A line is from the second index to the third; a point is the third.
            if (is_line)
                parts.insert(parts.end(), {a, b, c, b, c, a, c, a, b});
            else
                parts.insert(parts.end(), {b, c, a, c, a, b, a, b, c});
        }
        mesh.indices = std::move(parts);
    }
    return list;
}

}  // namespace strata::pipeline
