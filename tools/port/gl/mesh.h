// tools/port/gl/mesh.h - the triangles, lines and points that the port (the same algorithms as a program for OpenGL,
// which tests drivers) draws: clip-space vertices with their colours, and draw calls. A Vertex is uploaded byte by
// byte.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace strata::port {

struct Vertex {
    std::array<float, 4> clip{}, front{}, back{};
};

enum class DrawKind : std::uint8_t { triangles, lines, points };

// Consecutive primitives with one state.
struct DrawRange {
    std::uint32_t first_index = 0, index_count = 0;
    bool transparent = true, double_sided = true;
    bool mirrored = false;  // the model's matrix reverses the winding
    DrawKind kind = DrawKind::triangles;
};

struct IndexedMesh {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<DrawRange> draws;
    float line_width = 1.0f, point_size = 1.0f;
};

}  // namespace strata::port
