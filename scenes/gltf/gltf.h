// scenes/gltf/gltf.h - loads glTF 2.0 from memory; for a path use load_gltf of scene.h. What is supported:
// tools/docs/files.md.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "scenes/scene.h"

namespace strata::scenes {

// Limits of one file's expanded contents; scenes/reference/scenes.md 9.7.
struct GltfLimits {
    std::uint64_t elements = std::uint64_t{1}
                             << 22;  // vertices and indices, in addition to 16 per byte of the file and its buffers
    std::uint64_t texels = std::uint64_t{1} << 28;     // of all textures together
    std::uint64_t instanced = std::uint64_t{1} << 31;  // corners of triangles, over all instances
};

// A .gltf or .glb in memory. No file is opened: every uri must be data:. `name` is used as the file name in error
// messages.
[[nodiscard]] Scene load_gltf_bytes(std::span<const std::byte> bytes, const std::string& name,
                                    const SceneOptions& options, const GltfLimits& limits = {});

}  // namespace strata::scenes
