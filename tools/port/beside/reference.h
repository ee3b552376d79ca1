// tools/port/beside/reference.h - Strata's side of the comparison: the same vertices, the fragments and the pictures.
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

// The picture that both programs draw: scene, camera, pixels. `threads` are those of either side; 0: all that there
// are.
struct Subject {
    scenes::Scene scene;
    pipeline::View view;
    std::optional<float> alpha;  // as --alpha of `strata render`
    Size size;
    int threads = 0;
};

// The vertices of the scene in clip space with their lit colours, by Strata's own transform: both
// sides start from the same bits. Throws InputError for what the OpenGL program does not draw:
// textures, MASK, and opaque materials without --alpha.
[[nodiscard]] rasterizer::TriangleSoup clip_vertices(const Subject& subject);
// As the port's own buffers hold them.
[[nodiscard]] Mesh mesh_of(const rasterizer::TriangleSoup& soup);

// How many fragments of `soup` each pixel has under the profile's coverage rules, rows from the
// top, and how many triangles were cut. No test drops any fragment.
struct FragmentCounts {
    std::vector<std::uint32_t> pixels;
    std::uint64_t clipped = 0;
};
[[nodiscard]] FragmentCounts count_fragments(const rasterizer::TriangleSoup& soup,
                                             const pipeline::DeviceProfile& profile, Size size);

// The format of Strata that stores the same bits, and the codes of a picture that was read back.
[[nodiscard]] pipeline::Format strata_format(const Format& format);
[[nodiscard]] pipeline::Image as_image(const Image& image);

// Strata's picture of a job.
struct Rendered {
    pipeline::Image image;  // depth: the nearest depth of every pixel; else the colours
    int geometry_passes = 0;
};
// `job` is a name of job_names(). No audit runs. max_passes 0: to the end.
[[nodiscard]] Rendered render(const Subject& subject, const pipeline::DeviceProfile& profile, const std::string& job,
                              const TargetFormats& formats = {}, int max_passes = 0);

}  // namespace strata::port
