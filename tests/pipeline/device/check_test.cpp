// Tests the feature checks of devices. The expected messages and the devices of each feature are written by hand.
#include "pipeline/device/check.h"

#include <array>
#include <catch2/catch.hpp>
#include <set>

#include "rasterizer/base/enum_values.h"

using namespace strata::pipeline;

namespace {

const DeviceProfile& device(std::string_view name) { return *find_profile(name); }

// The message of a rejection, or "" if the device supports the state.
std::string message(std::string_view name, const std::optional<Refusal>& verdict) {
    return verdict ? verdict->message(device(name)) : std::string{};
}

template <class... State>
std::string checked(std::string_view name, const State&... state) {
    return message(name, check(device(name), state...));
}

std::string checked_targets(std::string_view name, const std::vector<Blend>& targets) {
    return message(name, check(device(name), std::span<const Blend>{targets}));
}

}  // namespace

TEST_CASE("independent blending is rejected with the feature and the extension and a workaround") {
    const std::vector<Blend> unequal{blend_mode::max, blend_mode::under};
    CHECK(checked_targets("geforce8", unequal) ==
          "profile geforce8 has no independent blend equations (ARB_draw_buffers_blend); use geforce8_dx101, ideal, "
          "llvmpipe, "
          "llvmpipe_sse, softpipe, swiftshader or direct3d11");
    CHECK(checked_targets("geforce8_dx101", unequal).empty());
    CHECK(checked_targets("ideal", unequal).empty());
}

TEST_CASE("targets that share a blend equation may differ in enable and write mask") {
    Blend masked = blend_mode::max;
    masked.write_mask = 1;
    CHECK(checked_targets("geforce8", {blend_mode::max, blend_mode::replace, masked}).empty());
    Blend tinted = blend_mode::max;
    tinted.constant = {1, 0, 0, 0};
    CHECK_FALSE(checked_targets("geforce8", {blend_mode::max, blend_mode::replace, tinted}).empty());
}

TEST_CASE("separate blending of alpha is rejected where there is one function for all channels") {
    CHECK(checked("geforce3", blend_mode::under) ==
          "profile geforce3 has no separate blend functions for alpha (EXT_blend_func_separate); use geforce8, "
          "geforce8_dx101, ideal, llvmpipe, llvmpipe_sse, softpipe, swiftshader or direct3d11");
    CHECK(checked("geforce3", blend_mode::over).empty());
    CHECK(checked("geforce8", blend_mode::under).empty());
    Blend off = blend_mode::under;
    off.enabled = false;
    CHECK(checked("geforce3", off).empty());
}

TEST_CASE("more render targets than the device has are rejected") {
    CHECK(checked_targets("geforce3", {Blend{}, Blend{}}) ==
          "profile geforce3 has no 2 render targets in one pass (ARB_draw_buffers); use geforce8, geforce8_dx101, "
          "ideal, llvmpipe, llvmpipe_sse, softpipe, swiftshader or direct3d11");
    CHECK(checked_targets("geforce8", std::vector<Blend>(8)).empty());
    CHECK(checked_targets("ideal", std::vector<Blend>(9)) ==
          "profile ideal has no 9 render targets in one pass (ARB_draw_buffers)");
}

TEST_CASE("each device accepts its own depth formats") {
    CHECK(checked("geforce3", DepthFormat::d16).empty());
    CHECK(checked("geforce3", Format::d24s8).empty());
    CHECK(checked("geforce3", Format::d32f) ==
          "profile geforce3 has no float depth buffers (ARB_depth_buffer_float); use geforce8, geforce8_dx101, ideal, "
          "llvmpipe, llvmpipe_sse, softpipe, swiftshader or direct3d11");
    CHECK(checked("geforce8", Format::d16) ==
          "profile geforce8 has no 16-bit depth buffers; use geforce3, ideal, llvmpipe, llvmpipe_sse, softpipe, "
          "swiftshader or direct3d11");
    CHECK(checked("geforce8", Format::d32f).empty());
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f})
        CHECK(checked("ideal", format).empty());
}

TEST_CASE("float render targets are rejected on a device that has only 8-bit ones") {
    for (const Format format : {Format::rgba16f, Format::rgba32f, Format::r16f, Format::r32f, Format::rg32f}) {
        CHECK_FALSE(checked("geforce3", format).empty());
        CHECK(checked("geforce8", format).empty());
    }
    CHECK(checked("geforce3", Format::rgba8).empty());
    CHECK(checked("geforce3", Format::s8).empty());
}

TEST_CASE("two-sided stencil and unclamped depth clears are rejected where they are missing") {
    CHECK(checked("geforce3", StencilTest{true, true, {}, {}}) ==
          "profile geforce3 has no two-sided stencil (EXT_stencil_two_side); use geforce8, geforce8_dx101, ideal, "
          "llvmpipe, "
          "llvmpipe_sse, softpipe, swiftshader or direct3d11");
    CHECK(checked("geforce3", StencilTest{true, false, {}, {}}).empty());
    CHECK(checked("geforce3", StencilTest{false, true, {}, {}}).empty());
    DeviceProfile clamping = device("geforce8");
    clamping.has_unclamped_depth_clear = false;
    CHECK(check_depth_clear(clamping, DepthFormat::d32f, -1.0f));
    CHECK_FALSE(check_depth_clear(clamping, DepthFormat::d32f, 1.0f));
    CHECK_FALSE(check_depth_clear(clamping, DepthFormat::d24, -1.0f));  // fixed-point formats clamp
    CHECK_FALSE(check_depth_clear(device("geforce8"), DepthFormat::d32f, -1.0f));
}

TEST_CASE("sizes and samples and texture units beyond the device's are rejected with the number") {
    CHECK(message("geforce3", check_size(device("geforce3"), 4097, 10)) ==
          "profile geforce3 has no viewport of 4097 x 10 pixels; use geforce8, geforce8_dx101, ideal, llvmpipe, "
          "llvmpipe_sse, softpipe, swiftshader or direct3d11");
    CHECK_FALSE(check_size(device("geforce3"), 4096, 4096));
    CHECK(check_size(device("geforce8"), 10, 8193)->way_out ==
          "use ideal, llvmpipe, llvmpipe_sse, softpipe or direct3d11");
    CHECK(check_samples(device("geforce3"), 8));
    CHECK_FALSE(check_samples(device("geforce8"), 8));
    CHECK(check_texture_units(device("geforce3"), 5));
}

TEST_CASE("only texture shaders replace a depth and only programs write r/q and every device compares it") {
    using strata::rasterizer::DepthPath;
    for (const char* profile : {"geforce3", "geforce8", "ideal"}) {
        for (const DepthPath path : {DepthPath::float32, DepthPath::float32_plane, DepthPath::exact})
            CHECK(checked(profile, path).empty());
        CHECK_FALSE(check_reference(device(profile), DepthPath::perspective_rq));
    }
    CHECK(checked("geforce3", DepthPath::depth_replace).empty());
    CHECK(checked("ideal", DepthPath::depth_replace).empty());
    CHECK(checked("geforce8", DepthPath::depth_replace) ==
          "profile geforce8 has no depth replace by texture shaders (NV_texture_shader); use geforce3 or ideal");
    CHECK(check_reference(device("geforce8"), DepthPath::depth_replace)->extension == "NV_texture_shader");
    CHECK(checked("geforce8", DepthPath::perspective_rq).empty());
    CHECK(checked("geforce3", DepthPath::perspective_rq) ==
          "profile geforce3 has no fragment programs that write a depth (ARB_fragment_program); use depth path "
          "depth_replace, which writes the same depth");
}

TEST_CASE("of several missing features the first is named and the ideal device misses none") {
    constexpr std::array needed{Feature::d24, Feature::fragment_programs, Feature::ordered_rmw};
    CHECK(check(device("geforce3"), needed)->extension == "ARB_fragment_program");
    CHECK(check(device("geforce8"), needed)->extension == "STRATA_ordered_rmw");
    CHECK_FALSE(check(device("ideal"), needed));
    // Features of the NV2A's own blending and surfaces, which no other device has.
    const std::set<Feature> nv2a{Feature::signed_blend, Feature::d16f, Feature::narrow_surfaces, Feature::d24f};
    for (const Feature feature : strata::enum_values<Feature>)
        CHECK(has(device("ideal"), feature) == !nv2a.contains(feature));
}

TEST_CASE(
    "an extension of the emulator is available on every profile and ordered read-modify-write on ideal and direct3d11 "
    "only") {
    for (const DeviceProfile& profile : builtin_profiles()) {
        CHECK(has(profile, Feature::sequential_depth_units));
        CHECK(has(profile, Feature::ordered_rmw) == (profile.name == "ideal" || profile.name == "direct3d11"));
    }
}

TEST_CASE("a pass that is rejected throws Refused with its message") {
    const Refused refused{device("geforce8"), {"fog", "EXT_fog_coord", ""}};
    CHECK(std::string{refused.what()} == "profile geforce8 has no fog (EXT_fog_coord)");
    CHECK(refused.refusal.feature == "fog");
}
