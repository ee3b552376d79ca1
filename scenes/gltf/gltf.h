// scenes/gltf/gltf.h - glTF 2.0 from memory; from a path it is load_gltf of scene.h. What is supported:
// tools/docs/files.md.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "scenes/scene.h"

namespace strata::scenes {

// Limits of one file's contents once unfolded; scenes.md 9.7.
struct GltfLimits {
    std::uint64_t elements = std::uint64_t{1}
                             << 22;  // vertices and indices, beside 16 for each byte of the file and its buffers
    std::uint64_t texels = std::uint64_t{1} << 28;     // of all textures together
    std::uint64_t instanced = std::uint64_t{1} << 31;  // corners of triangles over all instances
};

// A .gltf or .glb in memory. No file is opened: every uri must be data:. `name` stands for the file in error messages.
[[nodiscard]] Scene load_gltf_bytes(std::span<const std::byte> bytes, const std::string& name,
                                    const SceneOptions& options, const GltfLimits& limits = {});

}  // namespace strata::scenes
