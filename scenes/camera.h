// scenes/camera.h - makes views from an orbit around a scene's bounds, from a camera file or from a camera of a glTF
// scene.
//
// Rule     gluLookAt and gluPerspective in binary64 with sin and cos of scenes/numbers/elementary.h; matrices
//          column-major, clip depth -1 to 1 unless with_clip_convention converts it.
// Source   scenes/reference/scenes.md 7; GLU 1.3 sections 4.1 and 4.2; glTF 2.0 section 3.10.3 (also infinite far).
// Tests    tests/scenes/camera_test.cpp against wide arithmetic, files/camera_file_test.cpp
#pragma once
#include <string>

#include "rasterizer/base/vector.h"
#include "rasterizer/rules/raster_state.h"
#include "scenes/scene.h"

namespace strata::scenes {

struct LookAt {  // the content of a camera file of the first form
    Vec3d eye{0, 0, 1}, center{0, 0, 0}, up{0, 1, 0};
    double fovy_degrees = 45, near = 0.1, far = 100;
};

[[nodiscard]] pipeline::View look_at(const LookAt& camera, double aspect) noexcept;

// Contains the bounding sphere of the box: the near and far planes are 1.4 and 3.6 radii away. InputError unless
// |elevation| <= 90 and |azimuth| <= 10^6. At elevation +-90 the up vector is the limit of neighbouring elevations. A
// box without extent is framed as if its radius were 1, an empty one as if it were at the origin.
[[nodiscard]] LookAt orbit_camera(const Bounds& bounds, double azimuth_degrees, double elevation_degrees);
[[nodiscard]] pipeline::View orbit_view(const Bounds& bounds, double azimuth_degrees, double elevation_degrees,
                                        double aspect);

// The meaning of clip-space z: the limits of the view volume, and whether near has the greater depth (0 <= z <= w then
// has near at w).
struct ClipConvention {
    rasterizer::ClipDepth clip_depth = rasterizer::ClipDepth::minus_one_to_one;
    rasterizer::DepthOrder depth_order = rasterizer::DepthOrder::less;
    friend bool operator==(const ClipConvention&, const ClipConvention&) = default;
};
// The convention of a view that is drawn in this state. GREATER over a reversed depth range takes a view that is not
// reversed: the range does it. Reversed twice, the farthest surfaces would be drawn.
[[nodiscard]] ClipConvention view_convention(const rasterizer::RasterState& state) noexcept;
// The same volume under another convention: z and w are the third and fourth rows of the projection, in binary64. To 0
// to 1: z' = (z + w) / 2; from it: z' = 2 z - w; near exchanged with far: z' = w - z, or -z where z runs from -w.
[[nodiscard]] pipeline::View with_clip_convention(const pipeline::View& view, const ClipConvention& from,
                                                  const ClipConvention& to);

// The camera's own aspect if it has one, else the image's.
[[nodiscard]] pipeline::View camera_view(const SceneCamera& camera, double image_aspect);

// Reads a camera file of either form (scenes.md 7.3); InputError names the file and the JSON pointer.
[[nodiscard]] pipeline::View load_camera(const std::string& path, double aspect);
[[nodiscard]] pipeline::View parse_camera(const std::string& text, const std::string& name, double aspect);

// {"view":[16],"projection":[16]} in hexadecimal floats: parse_camera gives the same bits back.
[[nodiscard]] std::string to_json(const pipeline::View& view);

}  // namespace strata::scenes
