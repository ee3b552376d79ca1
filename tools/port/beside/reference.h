// tools/port/beside/reference.h - Strata's side of the comparison: the same vertices, its fragments and its pictures.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/device/profile.h"
#include "pipeline/formats/image.h"
#include "rasterizer/set_up/geometry.h"
#include "scenes/scene.h"
#include "tools/port/algorithms/job.h"

namespace strata::port {

// The input of both programs: scene, camera, size. `threads` is for either program; 0: all.
struct Subject {
    scenes::Scene scene;
    pipeline::View view;
    std::optional<float> alpha;  // as --alpha of `strata render`
    FrameSize size;
    int threads = 0;
};

// The vertices of the scene in clip space with their lit colours, by Strata's own transform: both sides start from the
// same bits. Throws InputError for features that the OpenGL program does not draw: textures, MASK, and opaque materials
// without --alpha.
[[nodiscard]] rasterizer::TriangleSoup clip_vertices(const Subject& subject);
// The mesh in the layout of the port's buffers.
[[nodiscard]] IndexedMesh mesh_of(const rasterizer::TriangleSoup& soup);

// The number of fragments of `soup` per pixel under the profile's coverage rules, rows from the top, and the number of
// clipped triangles. No test discards fragments.
struct FragmentCounts {
    std::vector<std::uint32_t> pixels;
    std::uint64_t clipped = 0;
};
[[nodiscard]] FragmentCounts count_fragments(const rasterizer::TriangleSoup& soup,
                                             const pipeline::DeviceProfile& profile, FrameSize size);

// Strata's format with the same bits, and the codes of a picture that was read back.
[[nodiscard]] pipeline::Format strata_format(const PixelFormat& format);
[[nodiscard]] pipeline::Image as_image(const PixelCodes& image);

// Strata's picture for a job.
struct Rendered {
    pipeline::Image image;  // depth: the nearest depth of every pixel; else the colours
    int geometry_passes = 0;
};
// `job` is a name of job_names(). No audit runs. max_passes 0: unlimited.
[[nodiscard]] Rendered render(const Subject& subject, const pipeline::DeviceProfile& profile, const std::string& job,
                              const TargetFormats& formats = {}, int max_passes = 0);

}  // namespace strata::port
