#include "tools/lab/hardware_check/drawing/splits.h"

namespace strata::hardware_check {
namespace {

using rasterizer::Primitive;

// Sides opposite corner 1 and 2 of (0, k, k + 1) start at vertex 0: inside, except at the ends of the fan.
std::vector<OutlinedTriangle> fan(std::uint32_t count, bool hides_inner) {
    std::vector<OutlinedTriangle> all;
    for (std::uint32_t k = 1; k + 1 < count; ++k)
        all.push_back({{0, k, k + 1}, hides_inner ? (k + 2 < count ? 2u : 0u) | (k > 1 ? 4u : 0u) : 0u});
    return all;
}

std::vector<Triple> segments(Topology topology, std::uint32_t count) {
    std::vector<Triple> all;
    const std::uint32_t step = topology == Topology::lines ? 2 : 1;
    for (std::uint32_t i = 0; i + 1 < count; i += step) all.push_back({i, i, i + 1});
    if (topology == Topology::line_loop && count > 1) all.push_back({count - 1, count - 1, 0});
    return all;
}

std::vector<Triple> sides(const std::vector<OutlinedTriangle>& triangles) {
    std::vector<Triple> all;
    for (const auto& [corner, inner] : triangles)
        for (std::size_t i = 0; i < 3; ++i)
            if ((inner >> i & 1) == 0) all.push_back({corner[i], corner[(i + 1) % 3], corner[(i + 2) % 3]});
    return all;
}

}  // namespace

std::vector<OutlinedTriangle> split(Topology topology, std::uint32_t count) {
    std::vector<OutlinedTriangle> all;
    switch (topology) {
        case Topology::triangles:
            for (std::uint32_t i = 0; i + 2 < count; i += 3) all.push_back({{i, i + 1, i + 2}});
            break;
        case Topology::triangle_strip:
            for (std::uint32_t i = 0; i + 2 < count; ++i)
                all.push_back({i % 2 == 0 ? Triple{i, i + 1, i + 2} : Triple{i + 1, i, i + 2}});
            break;
        case Topology::triangle_fan: return fan(count, false);
        case Topology::polygon: return fan(count, true);
        case Topology::quads:
            for (std::uint32_t i = 0; i + 3 < count; i += 4) {
                all.push_back({{i, i + 1, i + 2}, 2u});
                all.push_back({{i, i + 2, i + 3}, 4u});
            }
            break;
        case Topology::quad_strip:
            for (std::uint32_t i = 0; i + 3 < count; i += 2) {
                all.push_back({{i, i + 1, i + 2}, 1u});
                all.push_back({{i + 2, i + 1, i + 3}, 4u});
            }
            break;
        default: break;
    }
    return all;
}

namespace {

SplitDraw draw_of(const std::vector<Triple>& triples, const std::vector<ClipVertex>& vertices, Primitive primitive) {
    SplitDraw draw{{}, primitive};
    draw.soup.vertices.assign(vertices.begin(), vertices.end());
    for (const Triple& t : triples) draw.soup.indices.insert(draw.soup.indices.end(), t.begin(), t.end());
    return draw;
}

}  // namespace

SplitDraw split_draw(const std::vector<OutlinedTriangle>& triangles, const std::vector<ClipVertex>& vertices,
                     PolygonMode mode) {
    if (mode == PolygonMode::line) return draw_of(sides(triangles), vertices, Primitive::polygon_lines);
    std::vector<Triple> triples;
    for (const OutlinedTriangle& t : triangles) triples.push_back(t.corner);
    return draw_of(triples, vertices, Primitive::triangles);
}

SplitDraw split_draw(Topology topology, const std::vector<ClipVertex>& vertices, PolygonMode mode) {
    const auto count = static_cast<std::uint32_t>(vertices.size());
    if (topology > Topology::line_strip) return split_draw(split(topology, count), vertices, mode);
    if (topology != Topology::points) return draw_of(segments(topology, count), vertices, Primitive::lines);
    std::vector<Triple> triples;
    for (std::uint32_t i = 0; i < count; ++i) triples.push_back({i, i, i});
    return draw_of(triples, vertices, Primitive::points);
}

}  // namespace strata::hardware_check
