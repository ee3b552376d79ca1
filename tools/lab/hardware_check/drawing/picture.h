// tools/lab/hardware_check/drawing/picture.h - redraws the pictures that a public test suite drew on the NV2A chip
// (GeForce3 class), from their names: abaire/nxdk_pgraph_tests_golden_results, CC0 1.0.
//
// Rule     A suite's file turns a name into draws, without reading the capture. Scenes that the reference does not
//          describe are reported as not modelled. Pixels of a label (text that the test wrote over its picture) are not
//          compared.
// Source   pipeline/reference/chip-fragment.md, rasterizer/reference/chip-geometry.md,
//          rasterizer/reference/chip-depth.md, by scene.
// Tests    tests/tools/lab/hardware_check/suites_test.cpp
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/device/profile.h"
#include "pipeline/formats/image.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::hardware_check {

inline constexpr int picture_width = 640, picture_height = 480;

// How a capture's bytes are interpreted and compared. Its channels may contain depth words, because the test can only
// save colours.
enum class CaptureFormat : std::uint8_t {
    color,    // r g b a
    drawn,    // only whether a pixel differs from `background`
    depth16,  // a 16-bit depth stored as R5G6B5
    depth24   // a 24-bit depth in A R G, the stencil in B
};

// The tolerated difference; 0 and 0: none. A pixel that differs by more than `units` (1/255 or depth units) is never
// tolerated. No bound is above 250 pixels.
struct Bound {
    std::uint64_t pixels = 0;
    std::uint32_t units = 0;
    friend bool operator==(const Bound&, const Bound&) = default;
};

// The picture that a suite drew for one name, and how it is compared.
struct SuitePicture {
    CaptureFormat reading = CaptureFormat::color;
    // rgba8 for colours; else the depth buffer in its own format.
    pipeline::Image image{};
    // With depth24, if the test has a stencil; else empty.
    pipeline::Image stencil{};
    // The clear colour, r g b a; only for CaptureFormat::drawn.
    std::array<std::uint8_t, 4> background{};
    // Half-open rectangles that are not compared. Label pixels of a colour capture, (255, 255, 255, 0), need none.
    std::vector<rasterizer::Rect> hidden{};
    // A colour that the test drew over its picture and that the picture itself cannot contain: such pixels of a capture
    // are labels, too.
    std::optional<std::array<std::uint8_t, 4>> overdrawn{};
    Bound bound{};
    // The counts that the chip's occlusion queries would return, in order. No capture contains them: they are reported,
    // not compared.
    std::vector<std::uint64_t> reports{};
};

// The reason for a name that its suite does not have; it distinguishes this from a picture that is not modelled.
inline constexpr std::string_view unknown_name_reason = "no picture of this name is known";

// A picture, or the reason why it is not modelled.
struct Drawing {
    std::optional<SuitePicture> picture;
    std::string reason;
};

using Subjects = std::uint8_t;  // a set: bit s for rasterizer::HypothesisSubject s

// One of the test suites. Its function parses a name and draws that picture under a profile.
struct Suite {
    std::string_view name;  // the folder's name
    Drawing (*draw)(std::string_view picture, const pipeline::DeviceProfile& profile);
    // The subjects of undetermined rules on which its pictures depend; 0: none.
    Subjects determines = 0;
    // For a suite whose test loaded images: draws with `textures`, the folder that contains them; `draw` draws without
    // it. Null for other suites.
    Drawing (*draw_with)(std::string_view picture, const pipeline::DeviceProfile& profile,
                         const std::string& textures) = nullptr;
};

[[nodiscard]] std::span<const Suite> suites();
[[nodiscard]] const Suite* find_suite(std::string_view name);  // null if there is none
[[nodiscard]] inline Drawing draw(const Suite& suite, std::string_view picture, const pipeline::DeviceProfile& profile,
                                  const std::string& textures) {
    return suite.draw_with != nullptr ? suite.draw_with(picture, profile, textures) : suite.draw(picture, profile);
}

}  // namespace strata::hardware_check
