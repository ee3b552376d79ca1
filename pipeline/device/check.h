// pipeline/device/check.h - checks whether a device has the features that a state needs. State that it cannot run is
// rejected with the feature's name, before the first fragment.
//
// Rule     Every feature has one rule in check.cpp: description, extension, and the profiles that have it. A Refusal
//          names those profiles.
// Source   pipeline/reference/devices.md 5 to 7, 9 and 10.
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
#include "rasterizer/rules/primitive.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::pipeline {

// The features that a pass may need. check.cpp has a rule for each in this order, which a static_assert verifies.
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
    unordered_access,
    logic_op,
};

struct Refusal {
    // The description after "has no": "independent blend equations".
    std::string feature;
    // "ARB_draw_buffers_blend"; empty if there is no extension.
    std::string extension;
    // "use geforce8_dx101 or ideal"; empty if there is no alternative.
    std::string way_out;
    // "dual", if the algorithm is the reason and not the device; it then has the feature on no device.
    std::string algorithm{};
    friend bool operator==(const Refusal&, const Refusal&) = default;

    // "profile geforce3 has no independent blend equations (ARB_draw_buffers_blend); use geforce8_dx101 or ideal", or
    // "algorithm k_buffer has no saved layers; use dual or front_to_back".
    [[nodiscard]] std::string message(const DeviceProfile& profile) const;
};

// Thrown before a pass that the profile cannot run. Callers expect and report it; it is not a programming error. what()
// is the message of Refusal::sentence.
struct Refused : std::runtime_error {
    Refused(const DeviceProfile& profile, Refusal why)
        : std::runtime_error{why.message(profile)}, refusal{std::move(why)} {}
    Refusal refusal;
};

// has: true if the profile has a feature. check: empty if the profile supports the state, else the Refusal of the first
// missing feature.
[[nodiscard]] bool has(const DeviceProfile& profile, Feature feature);
[[nodiscard]] std::optional<Refusal> check(const DeviceProfile& profile, Feature feature);
[[nodiscard]] std::optional<Refusal> check(const DeviceProfile& profile, std::span<const Feature> needed);

// Single pieces of state. A disabled stencil test or blend is never rejected.
[[nodiscard]] std::optional<Refusal> check(const DeviceProfile& profile, DepthFormat format);
[[nodiscard]] std::optional<Refusal> check(const DeviceProfile& profile, Format target);
[[nodiscard]] std::optional<Refusal> check(const DeviceProfile& profile, const StencilTest& state);
[[nodiscard]] std::optional<Refusal> check(const DeviceProfile& profile, const Blend& state);
// All targets of a pass: their number, each blend, and whether different blends are possible. Enables and write masks
// may always differ (EXT_draw_buffers2); equations, factors and constants of the blending targets may differ only with
// independent blending.
[[nodiscard]] std::optional<Refusal> check(const DeviceProfile& profile, std::span<const Blend> targets);
// Lines and points: profiles without a rule for them refuse them.
[[nodiscard]] std::optional<Refusal> check(const DeviceProfile& profile, rasterizer::Primitive primitive);
// The path by which a depth buffer is written; check_reference: the path that a program or a shadow comparison
// compares.
[[nodiscard]] std::optional<Refusal> check(const DeviceProfile& profile, rasterizer::DepthPath written);
[[nodiscard]] std::optional<Refusal> check_reference(const DeviceProfile& profile, rasterizer::DepthPath compared);
// A D32F clear outside 0..1 needs has_unclamped_depth_clear; every other format clamps (formats.md 5.5).
[[nodiscard]] std::optional<Refusal> check_depth_clear(const DeviceProfile& profile, DepthFormat format, float value);
// Limits (devices.md 7): the larger side of the viewport, samples per pixel, texture units of a pass.
[[nodiscard]] std::optional<Refusal> check_size(const DeviceProfile& profile, int width_px, int height_px);
// check_samples: targets whose samples a pass fills itself. check_multisampling: images whose samples have positions; a
// device may support only some of 2, 4 and 8.
[[nodiscard]] std::optional<Refusal> check_samples(const DeviceProfile& profile, int samples);
[[nodiscard]] std::optional<Refusal> check_multisampling(const DeviceProfile& profile, int samples);
// Values at a pixel's centre where the triangle does not cover it: how chips with weights of few bits go on is unknown.
[[nodiscard]] std::optional<Refusal> check_interpolation(const DeviceProfile& profile,
                                                         rasterizer::Interpolation interpolation);
[[nodiscard]] std::optional<Refusal> check_texture_units(const DeviceProfile& profile, int units);

}  // namespace strata::pipeline
