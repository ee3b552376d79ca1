// tools/bench/mesa/reference.h - Strata's side of the comparison: the same vertices, the fragments and the pictures.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/device/profile.h"
#include "pipeline/formats/image.h"
#include "rasterizer/set_up/geometry.h"
#include "scenes/scene.h"
#include "tools/bench/mesa/objects.h"

namespace strata::mesa {

struct Subject {
    scenes::Scene scene;
    pipeline::View view;
    std::optional<float> alpha;  // as --alpha of `strata render`
    Size size;
    int threads = 0;
};

// InputError for what the OpenGL program does not draw: textures, MASK, and opaque materials without --alpha.
[[nodiscard]] rasterizer::TriangleSoup clip_vertices(const Subject& subject);

// Fragments of every pixel, rows from the top.
[[nodiscard]] std::vector<std::uint32_t> count_fragments(const rasterizer::TriangleSoup& soup,
                                                         const pipeline::DeviceProfile& profile, Size size);

struct Rendered {
    pipeline::Image image;  // depth: the nearest depth of every pixel; else the colours
    int geometry_passes = 0;
};
[[nodiscard]] Rendered render(const Subject& subject, const pipeline::DeviceProfile& profile, const std::string& job);

}  // namespace strata::mesa
