// Tests the checks of features against an independent table of features: description, extension, and the devices that
// have it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "pipeline/device/check.h"
#include "pipeline/formats/narrow.h"

namespace {

using namespace strata::pipeline;

struct FeatureOfDevices {
    Feature feature;
    std::string_view words, extension,
        owners;  // one letter per profile: 3, 8, 1 (dx101), i, l, s (llvmpipe_sse), p, w (swiftshader), d (direct3d11)
};

constexpr FeatureOfDevices feature_table[] = {
    {Feature::d16, "16-bit depth buffers", "", "3ilspwd"},
    {Feature::d24, "24-bit depth buffers", "", "381ilspwd"},
    {Feature::d32f, "float depth buffers", "ARB_depth_buffer_float", "81ilspwd"},
    {Feature::float_targets, "float render targets that blend", "ARB_color_buffer_float", "81ilspwd"},
    {Feature::unclamped_depth_clear, "unclamped depth clears", "NV_depth_buffer_float", "81ilsp"},
    {Feature::fragment_programs, "fragment programs that discard after a compare", "ARB_fragment_program", "81ilspwd"},
    {Feature::separate_alpha_blend, "separate blend functions for alpha", "EXT_blend_func_separate", "81ilspwd"},
    {Feature::independent_blend, "independent blend equations", "ARB_draw_buffers_blend", "1ilspwd"},
    {Feature::two_sided_stencil, "two-sided stencil", "EXT_stencil_two_side", "81ilspwd"},
    {Feature::depth_clamp, "depth clamping", "ARB_depth_clamp", "381ilspwd"},
    {Feature::depth_replace, "depth replace by texture shaders", "NV_texture_shader", "3i"},
    {Feature::sequential_depth_units, "sequential depth units", "STRATA_depth_units", "381ilspwd"},
    {Feature::ordered_rmw, "ordered read-modify-write of render targets", "STRATA_ordered_rmw", "id"},
    {Feature::signed_blend, "signed blend equations", "", "3"},
    {Feature::d16f, "16-bit float depth buffers", "", "3"},
    {Feature::narrow_surfaces, "surfaces of 15 and 16 bits or without alpha", "", "3"},
    {Feature::d24f, "24-bit float depth buffers", "", "3"},
    {Feature::unordered_access, "buffers that a program writes and changes atomically",
     "ARB_shader_storage_buffer_object", "ilsd"},
    {Feature::logic_op, "logical operations on colours", "", "381ilsp"},
};

constexpr std::array<std::string_view, 9> device_names{"geforce3", "geforce8",    "geforce8_dx101",
                                                       "ideal",    "llvmpipe",    "llvmpipe_sse",
                                                       "softpipe", "swiftshader", "direct3d11"};
constexpr std::string_view device_marks = "381ilspwd";

// "use a, b or c": the devices whose letter is in `owners`.
[[nodiscard]] std::string way_to(std::string_view owners) {
    std::string text;
    for (std::size_t i = 0, left = owners.size(); i < device_names.size(); ++i) {
        if (owners.find(device_marks[i]) == std::string_view::npos) continue;
        text += text.empty() ? "use " : left == 1 ? " or " : ", ";
        text += device_names[i];
        --left;
    }
    return text;
}

[[nodiscard]] const DeviceProfile& device_named(std::string_view name) { return *find_profile(name); }

[[nodiscard]] bool runs(std::string_view name, const auto&... state) { return !check(device_named(name), state...); }

[[nodiscard]] Blend both_terms(BlendEquation equation) {
    Blend blend = blend_mode::sum;
    blend.color.equation = blend.alpha.equation = equation;
    return blend;
}

}  // namespace

TEST_CASE("each feature is accepted on its devices and rejected on others with its extension and a workaround") {
    for (const FeatureOfDevices& row : feature_table)
        for (std::size_t i = 0; i < device_names.size(); ++i) {
            INFO(row.words << " on " << device_names[i]);
            const DeviceProfile& profile = device_named(device_names[i]);
            const bool expected = row.owners.find(device_marks[i]) != std::string_view::npos;
            CHECK(has(profile, row.feature) == expected);
            const std::optional<Refusal> refusal = check(profile, row.feature);
            REQUIRE(refusal.has_value() != expected);
            if (expected) continue;
            CHECK(*refusal == Refusal{std::string{row.words}, std::string{row.extension}, way_to(row.owners)});
        }
}

TEST_CASE("each format of a target requires its own feature") {
    using enum Format;
    for (std::size_t i = 0; i < device_names.size(); ++i) {
        const auto takes = [&](Format format, std::string_view owners) {
            INFO(info(format).name << " on " << device_names[i]);
            CHECK(runs(device_names[i], format) == (owners.find(device_marks[i]) != std::string_view::npos));
        };
        for (const Format format : {rgba8, s8, d24, d24s8}) takes(format, "381ilspwd");
        for (const Format format : {rgba16f, rgba32f, r16f, r32f, rg32f, d32f}) takes(format, "81ilspwd");
        for (const Format format : {x8r8g8b8, x1a7r8g8b8, r5g6b5, x1r5g5b5, d16f, d24f}) takes(format, "3");
        takes(d16, "3ilspwd");
        CHECK(runs(device_names[i], DepthFormat::d16f) == (i == 0));
        CHECK(runs(device_names[i], DepthFormat::d24f) == (i == 0));
    }
}

TEST_CASE("signed equations in colour or alpha are accepted only on GeForce3 while blending is on") {
    for (const BlendEquation equation : {BlendEquation::signed_add, BlendEquation::signed_reverse_subtract}) {
        Blend blend = both_terms(equation);
        CHECK(runs("geforce3", blend));
        for (const std::string_view other : {"geforce8", "geforce8_dx101", "ideal", "llvmpipe", "softpipe"})
            CHECK(check(device_named(other), blend)->feature == "signed blend equations");
        for (BlendTerm Blend::*term : {&Blend::color, &Blend::alpha}) {
            Blend one = blend_mode::sum;
            (one.*term).equation = equation;
            CHECK(check(device_named("ideal"), one)->feature == "signed blend equations");
            CHECK(check(device_named("geforce3"), one)->feature == "separate blend functions for alpha");
        }
        blend.enabled = false;
        CHECK(runs("ideal", blend));
    }
    for (const BlendEquation equation : {BlendEquation::add, BlendEquation::subtract, BlendEquation::reverse_subtract,
                                         BlendEquation::min, BlendEquation::max})
        for (const std::string_view name : device_names) CHECK(runs(name, both_terms(equation)));
}

TEST_CASE(
    "limits reject the first number beyond them on either side of a viewport and name the devices that accept it") {
    struct Limits {
        std::string_view device;
        int targets, units, viewport, samples;
    };
    for (const Limits& row : {Limits{"geforce3", 1, 4, 4096, 4},
                              {"geforce8", 8, 16, 8192, 8},
                              {"geforce8_dx101", 8, 16, 8192, 8},
                              {"ideal", 8, 16, 16384, 8},
                              {"llvmpipe", 8, 32, 16384, 4},
                              {"llvmpipe_sse", 8, 32, 16384, 4},
                              {"softpipe", 8, 32, 16384, 1},
                              {"swiftshader", 8, 32, 8192, 4},
                              {"direct3d11", 8, 16, 16384, 8}}) {
        const DeviceProfile& p = device_named(row.device);
        INFO(row.device);
        const auto blends = [](int count) { return std::vector<Blend>(static_cast<std::size_t>(count)); };
        CHECK_FALSE(check(p, std::span<const Blend>{blends(row.targets)}));
        CHECK(check(p, std::span<const Blend>{blends(row.targets + 1)})->extension == "ARB_draw_buffers");
        CHECK_FALSE(check_texture_units(p, row.units));
        CHECK(check_texture_units(p, row.units + 1)->extension == "ARB_multitexture");
        CHECK_FALSE(check_samples(p, row.samples));
        CHECK(check_samples(p, row.samples + 1)->extension == "ARB_multisample");
        CHECK_FALSE(check_size(p, row.viewport, 1));
        CHECK_FALSE(check_size(p, 1, row.viewport));
        CHECK(check_size(p, row.viewport + 1, 1)->extension.empty());
        CHECK(check_size(p, 1, row.viewport + 1));
    }
    const DeviceProfile& geforce3 = device_named("geforce3");
    CHECK(check_texture_units(geforce3, 17)->message(geforce3) ==
          "profile geforce3 has no 17 texture units (ARB_multitexture); use llvmpipe, llvmpipe_sse, softpipe or "
          "swiftshader");
    CHECK(check_samples(geforce3, 8)->message(geforce3) ==
          "profile geforce3 has no 8 samples per pixel (ARB_multisample); use geforce8, geforce8_dx101, ideal or "
          "direct3d11");
    CHECK(check_samples(geforce3, 16)->way_out.empty());
    CHECK(check_size(geforce3, 20000, 7)->feature == "viewport of 20000 x 7 pixels");
}

TEST_CASE("clearing a float depth to NaN or a value outside 0 to 1 requires unclamped depth clears") {
    DeviceProfile clamping = device_named("ideal");
    clamping.has_unclamped_depth_clear = false;
    const float not_a_number = std::numeric_limits<float>::quiet_NaN();
    for (const float value : {-1.0f, -0x1p-149f, std::nextafter(1.0f, 2.0f), 2.0f, not_a_number}) {
        CHECK(check_depth_clear(clamping, DepthFormat::d32f, value)->extension == "NV_depth_buffer_float");
        CHECK_FALSE(check_depth_clear(device_named("ideal"), DepthFormat::d32f, value));
        for (const DepthFormat fixed : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d16f, DepthFormat::d24f})
            CHECK_FALSE(check_depth_clear(clamping, fixed, value));
    }
    for (const float value : {0.0f, -0.0f, 0.5f, 1.0f})
        CHECK_FALSE(check_depth_clear(clamping, DepthFormat::d32f, value));
}

TEST_CASE("several targets are checked one by one and only those that blend must share their factors") {
    const DeviceProfile& p = device_named("geforce8");
    const auto refusal = [&](std::vector<Blend> targets) { return check(p, std::span<const Blend>{targets}); };
    Blend off = blend_mode::under;
    off.enabled = false;
    CHECK_FALSE(refusal({}));
    CHECK_FALSE(refusal({off, blend_mode::max, off, blend_mode::max}));
    CHECK(refusal({off, blend_mode::max, off, blend_mode::under})->extension == "ARB_draw_buffers_blend");
    CHECK(refusal({blend_mode::max, both_terms(BlendEquation::signed_add)})->feature == "signed blend equations");
    Blend other_alpha = blend_mode::max;
    other_alpha.alpha = blend_mode::sum.alpha;
    CHECK(refusal({blend_mode::max, other_alpha})->extension == "ARB_draw_buffers_blend");
    CHECK_FALSE(
        check(device_named("geforce8_dx101"), std::span<const Blend>{std::vector{blend_mode::max, other_alpha}}));
}
