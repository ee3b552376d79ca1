// tools/port/gl/mesh.h - the triangles that the port (the same algorithms as a program for OpenGL, which tests drivers)
// draws: clip-space vertices with their colours, and draw calls. A Vertex is uploaded byte by byte.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace strata::port {

struct Vertex {
    std::array<float, 4> clip{}, front{}, back{};
};

// Consecutive triangles with one state.
struct DrawRange {
    std::uint32_t first_index = 0, index_count = 0;
    bool transparent = true, double_sided = true;
    bool mirrored = false;  // the model's matrix reverses the winding
};

struct IndexedMesh {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<DrawRange> draws;
};

}  // namespace strata::port
