// scenes/procedural/hard_cases/build_case.h - functions that build hard cases from corners in pixels, quads, planes and
// colours.
//
// Numbers  A corner's clip coordinates are 2 x / width - 1, 1 - 2 y / height and 2 depth - 1, computed in binary64 and
//          rounded once. Frames have sides that are powers of two, so all three are exact for the pixels and depths
//          that the cases use.
#pragma once
#include <array>

#include "scenes/procedural/hard_cases/hard_case.h"

namespace strata::scenes::hard {

// A corner in the window: x and y in pixels from the left and the top, and window depth in 0 to 1.
struct CaseCorner {
    double x = 0, y = 0, depth = 0.5;
};

// Window depth as a plane: its value at the window's top left corner, and its slopes per pixel.
struct Tilt {
    double start = 0.5, right = 0, down = 0;
    [[nodiscard]] double at(double x, double y) const noexcept { return start + right * x + down * y; }
};

struct CaseBox {
    double left = 0, top = 0, right = 0, bottom = 0;
};

// The diagonal along which a quad is split into triangles.
enum class Diagonal : std::uint8_t { falling, rising };

[[nodiscard]] CaseBox whole(const CaseScene& scene) noexcept;
[[nodiscard]] pipeline::Vec3 position(const CaseScene& scene, const CaseCorner& corner) noexcept;

// Adds one triangle to the transparent mesh.
void add(CaseScene& scene, const std::array<CaseCorner, 3>& corners, const pipeline::Rgba& color);
// Adds one triangle with the given positions.
void add(pipeline::Mesh& mesh, const std::array<pipeline::Vec3, 3>& positions, const pipeline::Rgba& color);
// Adds two triangles that cover the box.
void add_quad(CaseScene& scene, const CaseBox& box, const Tilt& depth, const pipeline::Rgba& color,
              Diagonal diagonal = Diagonal::falling);
void add_opaque_quad(CaseScene& scene, const CaseBox& box, const Tilt& depth, const pipeline::Rgba& color);

// A view whose w is the distance from the eye, without far plane: window depth is 1 - near / w.
[[nodiscard]] pipeline::View perspective_view(double near);
// The same with a far plane: window depth is (1 - near / w) far / (far - near).
[[nodiscard]] pipeline::View perspective_view(double near, double far);
// The position that such a view shows at window position (x, y) and distance `w`.
[[nodiscard]] pipeline::Vec3 point_at_window(const CaseScene& scene, double x, double y, double w) noexcept;
// A quad over the whole frame at distance `w`.
void add_facing_quad(CaseScene& scene, double w, const pipeline::Rgba& color);

// Colours of the wheel, alpha 0.5: consecutive ones differ in every channel.
[[nodiscard]] pipeline::Rgba color_of(int number, float alpha = 0.5f) noexcept;

// The cases of the files of this folder.
[[nodiscard]] std::span<const HardCase> plane_cases();
[[nodiscard]] std::span<const HardCase> order_cases();
[[nodiscard]] std::span<const HardCase> sliver_cases();
[[nodiscard]] std::span<const HardCase> sample_cases();
[[nodiscard]] std::span<const HardCase> clip_cases();
[[nodiscard]] std::span<const HardCase> depth_range_cases();
[[nodiscard]] std::span<const HardCase> layer_cases();
[[nodiscard]] std::span<const HardCase> alpha_cases();
[[nodiscard]] std::span<const HardCase> input_cases();
[[nodiscard]] std::span<const HardCase> frame_cases();

}  // namespace strata::scenes::hard
