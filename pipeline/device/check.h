// pipeline/device/check.h - what a device lacks. State that it cannot run is refused by name, before the first
// fragment.
//
// Rule     Every feature has one rule in check.cpp: words, extension, and who has it. A refusal names the profiles
//          that do. State of the era that no algorithm here needs (fog, colour sum, dither, logic op) is refused on
//          every profile.
// Source   devices.md 5 to 7, 9 and 10.
// Tests    tests/pipeline/device/check_test.cpp
#pragma once
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "pipeline/device/profile.h"
#include "pipeline/device/state.h"
#include "pipeline/formats/format.h"

namespace strata::pipeline {

// The features that a pass may need of a device. check.cpp has a rule for each, in this order: a static_assert
// compares.
enum class Feature : std::uint8_t {
    d16,
    d24,
    d32f,
    float_targets,
    unclamped_depth_clear,
    fragment_programs,
    separate_alpha_blend,
    independent_blend,
    two_sided_stencil,
    depth_clamp,
    depth_replace,
    sequential_depth_units,
    ordered_rmw,
    signed_blend,
    d16f,
    narrow_surfaces,
    d24f,
};

// State of the era that no profile has (fragment-stages.md 12).
enum class UnsupportedState : std::uint8_t { fog, color_sum, dither, logic_op };

struct Refusal {
    // In words, as it stands after "has no": "independent blend equations".
    std::string feature;
    // "ARB_draw_buffers_blend"; empty where no extension is meant.
    std::string extension;
    // "use geforce8_dx101 or ideal"; empty where there is none.
    std::string way_out;
    friend bool operator==(const Refusal&, const Refusal&) = default;

    // "profile geforce3 has no independent blend equations (ARB_draw_buffers_blend); use geforce8_dx101 or ideal"
    [[nodiscard]] std::string sentence(const DeviceProfile& profile) const;
};

// Thrown by a pass that its profile cannot run; an outcome of the run, never a crash. what() is the sentence.
struct Refused : std::runtime_error {
    Refused(const DeviceProfile& profile, Refusal why)
        : std::runtime_error{why.sentence(profile)}, refusal{std::move(why)} {}
    Refusal refusal;
};

// Empty: the profile can do it.
using Verdict = std::optional<Refusal>;

// Whether the profile has a feature; `check` gives the refusal if it has not, and of several features that of the
// first that is missing.
[[nodiscard]] bool has(const DeviceProfile& profile, Feature feature);
[[nodiscard]] Verdict check(const DeviceProfile& profile, Feature feature);
[[nodiscard]] Verdict check(const DeviceProfile& profile, std::span<const Feature> needed);

// Single pieces of state. A stencil test or a blend that is off is never refused.
[[nodiscard]] Verdict check(const DeviceProfile& profile, UnsupportedState state);
[[nodiscard]] Verdict check(const DeviceProfile& profile, DepthFormat format);
[[nodiscard]] Verdict check(const DeviceProfile& profile, Format target);
[[nodiscard]] Verdict check(const DeviceProfile& profile, const StencilTest& state);
[[nodiscard]] Verdict check(const DeviceProfile& profile, const Blend& state);
// All targets of a pass: their number, each blend, and whether unequal ones are possible. Enables and write masks may
// always differ (EXT_draw_buffers2); equations, factors and constants of the targets that blend only with independent
// blending.
[[nodiscard]] Verdict check(const DeviceProfile& profile, std::span<const Blend> targets);
// The path that a depth buffer is written by, or the one that a program or a shadow comparison compares.
[[nodiscard]] Verdict check(const DeviceProfile& profile, rasterizer::DepthPath written);
[[nodiscard]] Verdict check_reference(const DeviceProfile& profile, rasterizer::DepthPath compared);
// A D32F clear outside 0..1 needs has_unclamped_depth_clear; every other format clamps (formats.md 5.5).
[[nodiscard]] Verdict check_depth_clear(const DeviceProfile& profile, DepthFormat format, float value);
// Limits: the larger side of the viewport, samples of a pixel, units that a pass names (devices.md 7).
[[nodiscard]] Verdict check_size(const DeviceProfile& profile, int width_px, int height_px);
// Targets whose samples a pass fills itself, and pictures whose samples have positions: of 2, 4 or 8 a device may have
// some alone.
[[nodiscard]] Verdict check_samples(const DeviceProfile& profile, int samples);
[[nodiscard]] Verdict check_multisampling(const DeviceProfile& profile, int samples);
[[nodiscard]] Verdict check_texture_units(const DeviceProfile& profile, int units);

}  // namespace strata::pipeline
