// Suites Stencil: Stencil_<zpass operation>[_ST][_DT][_ZB] and Stencil_func: <function>[_ZB].
// pipeline/reference/chip-fragment.md 4.
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/shapes.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

using pipeline::CompareFunc;
using pipeline::DrawState;
using pipeline::StencilFace;
using pipeline::StencilOp;
using pipeline::StencilTest;
using pipeline::Surface;

// The clear word of depth, a code of 24 bits.
constexpr std::uint32_t far_depth = 0x00ffff;

// A stencil test with `face` for front and back alike.
StencilTest stencil_test(const StencilFace& face) { return {.enabled = true, .front = face, .back = face}; }

// With _ZB the picture shows depth words with the stencil below them.
SuitePicture finished(const Surface& surface, bool shows_depth) {
    if (!shows_depth) return {.image = surface.color()};
    return {.reading = CaptureFormat::depth24, .image = surface.depth(), .stencil = surface.stencil()};
}

// A black window with this stencil.
Surface cleared(const pipeline::DeviceProfile& profile, std::uint8_t stencil) {
    Surface surface{profile, {}};
    surface.clear_color(unpack(0xff000000));
    surface.clear_depth(far_depth);
    surface.clear_stencil(stencil);
    return surface;
}

// A square of 80 pixels whose stencil becomes `value`. The test sets it by INVERT under the write mask 7F and the
// operation in a name; here the result is drawn with REPLACE.
struct Patch {
    float x, y;
    std::uint8_t value;
};

void draw_patch(Surface& surface, const Patch& patch) {
    DrawState state;
    state.stencil = stencil_test({.ref = patch.value, .pass = StencilOp::replace});
    surface.draw(state, box({patch.x, patch.y, patch.x + 80, patch.y + 80}, 0xff0000ff));
}

}  // namespace

Drawing draw_stencil(std::string_view name, const pipeline::DeviceProfile& profile) {
    const bool shows_depth = take_last(name, "_ZB");
    const bool tests_depth = take_last(name, "_DT"), tests_stencil = take_last(name, "_ST");
    if (name != "Stencil_ZERO" && name != "Stencil_REPLACE") return unknown_name;
    const bool zeroes = name == "Stencil_ZERO";
    const std::uint8_t ref = zeroes ? 0 : 1;
    Surface surface = cleared(profile, zeroes ? 0xff : 0x00);
    surface.draw({}, box({220, 140, 420, 340}, 0xffff0000));
    // The square in the middle: only the stencil is written, and its depth test always passes.
    DrawState tested{.color_mask = 0};
    if (tests_stencil)
        tested.stencil = stencil_test({.ref = ref, .pass = zeroes ? StencilOp::zero : StencilOp::replace});
    tested.depth = {.enabled = tests_depth, .func = CompareFunc::always, .write = false};
    surface.draw(tested, box({270, 190, 370, 290}, 0xffffffff));
    // Green shows where the stencil became `ref`.
    surface.draw({.stencil = stencil_test({.func = CompareFunc::equal, .ref = ref})},
                 box({220, 140, 420, 340}, 0xff00ff00));
    return {finished(surface, shows_depth), {}};
}

Drawing draw_stencil_func(std::string_view name, const pipeline::DeviceProfile& profile) {
    const bool shows_depth = take_last(name, "_ZB");
    const auto func = compare_func(name);
    if (!func) return unknown_name;
    Surface surface = cleared(profile, 0);
    // Stencil values of the two rows of patches, around the reference 7F and at both ends of the range.
    constexpr std::uint8_t upper[] = {0x00, 0x7e, 0x7f, 0x80, 0xff}, lower[] = {0xff, 0x00, 0x00, 0xff};
    for (std::size_t k = 0; k < std::size(upper); ++k)
        draw_patch(surface, {125.0f + 81.0f * static_cast<float>(k), 44, upper[k]});
    for (std::size_t k = 0; k < std::size(lower); ++k)
        draw_patch(surface, {125.0f + 81.0f * static_cast<float>(k), 286, lower[k]});
    // Alpha is masked and stays that of the clear.
    surface.draw({.stencil = stencil_test({.func = *func, .ref = 0x7f}), .color_mask = 7},
                 box({120, 40, 530, 450}, 0xff00bf00));
    return {finished(surface, shows_depth), {}};
}

}  // namespace strata::hardware_check
