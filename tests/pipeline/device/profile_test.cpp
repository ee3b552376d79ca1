// Tests the built-in profiles and the table of their fields against values written by hand from
// pipeline/reference/devices.md.
#include "pipeline/device/profile.h"

#include <catch2/catch.hpp>
#include <set>

#include "pipeline/device/profile_fields.h"

using namespace strata::pipeline;
using namespace strata::rasterizer;

TEST_CASE("the built-in profiles are three GeForces plus ideal plus four software drivers plus Direct3D 11") {
    std::vector<std::string> names;
    for (const DeviceProfile& profile : builtin_profiles()) names.push_back(profile.name);
    CHECK(names == std::vector<std::string>{"geforce3", "geforce8", "geforce8_dx101", "ideal", "llvmpipe",
                                            "llvmpipe_sse", "softpipe", "swiftshader", "direct3d11"});
    CHECK(find_profile("geforce4") == nullptr);
}

// pipeline/reference/devices.md 2.
TEST_CASE("geforce3 has the numbers that captures of an NV2A show") {
    const DeviceProfile& p = *find_profile("geforce3");
    CHECK(p.raster.subpixel_bits == 4);
    CHECK(p.raster.snap == Snap::toward_zero);
    CHECK(p.raster.z_clip == ZClip::per_fragment);
    CHECK(p.raster.w_divide == WDivide::reciprocal);
    CHECK(p.raster.window_z == WindowZ::buffer_units);
    CHECK(p.raster.depth_path == DepthPath::window_z);
    CHECK(p.raster.depth_rounding == DepthRounding::floor);
    CHECK(p.raster.color == ColorInterpolation::weights_8bit);
    CHECK(p.raster.interpolation.vertex_color_bits == 14);
    CHECK(p.raster.interpolation.texture_coordinates == CoordinateRule::cut_weights);
    CHECK(p.alpha_test == AlphaTestPrecision::unorm8);
    CHECK((p.has_d16 && p.has_d24 && !p.has_d32f));
    CHECK_FALSE(
        (p.has_float_targets || p.has_separate_alpha_blend || p.has_two_sided_stencil || p.has_fragment_programs));
    CHECK(p.max_render_targets == 1);
}

TEST_CASE("geforce8 follows Direct3D 10.0 and shares one blend equation among its eight targets") {
    const DeviceProfile& p = *find_profile("geforce8");
    CHECK(p.raster.subpixel_bits == 8);
    CHECK(p.raster.snap == Snap::nearest_even);
    CHECK(p.raster.depth_path == DepthPath::float32);
    CHECK(p.raster.depth_rounding == DepthRounding::nearest);
    CHECK((!p.has_d16 && p.has_d24 && p.has_d32f && p.has_unclamped_depth_clear));
    CHECK_FALSE(p.has_independent_blend);
    CHECK(p.max_render_targets == 8);
    DeviceProfile with_independent_blend = p;
    with_independent_blend.has_independent_blend = true;
    with_independent_blend.name = "geforce8_dx101";
    with_independent_blend.description = find_profile("geforce8_dx101")->description;
    CHECK(with_independent_blend == *find_profile("geforce8_dx101"));
}

TEST_CASE("ideal computes depth exactly and keeps denormals and has room for every frame that rasterizes") {
    const DeviceProfile& p = *find_profile("ideal");
    CHECK(p.raster.depth_path == DepthPath::exact);
    CHECK(p.denormals == DenormalRule::keep);
    CHECK((p.has_d16 && p.has_d24 && p.has_d32f && p.has_ordered_rmw));
    CHECK(p.max_viewport_px == 16384);
}

// The fragments themselves are compared with Mesa's by tools/lab/bench/side_by_side.py.
TEST_CASE("llvmpipe snaps x * (1 / w) to 8 subpixel bits and ties belong to bottom and left edges") {
    const DeviceProfile& p = *find_profile("llvmpipe");
    CHECK(p.raster.subpixel_bits == 8);
    CHECK(p.raster.snap == Snap::nearest_even);
    CHECK(p.raster.w_divide == WDivide::reciprocal);
    CHECK(p.raster.viewport == ViewportArithmetic::fused_given);
    CHECK(p.raster.tie_rule == TieRule::bottom_left);
    CHECK(p.raster.plane_origin == PlaneOrigin::unsnapped);
    CHECK(p.raster.depth_path == DepthPath::float32);
    CHECK((p.has_d32f && p.has_float_targets && p.has_independent_blend && !p.has_ordered_rmw));
    for (const ProfileEntry& e : describe(p)) CHECK(e.source.starts_with("["));
}

TEST_CASE("each field of a profile has one row with a source on every device and returns the value that was set") {
    std::set<std::string_view> keys;
    DeviceProfile profile;
    for (const ProfileField& field : profile_fields()) {
        INFO(field.key);
        CHECK(keys.insert(field.key).second);
        for (const std::string_view source : field.source) CHECK_FALSE(source.empty());
        CHECK((field.kind != FieldKind::choice || static_cast<int>(field.choices.size()) == field.highest + 1));
        for (int value = field.lowest; value <= field.highest; value += field.highest > 100 ? 997 : field.step) {
            const DeviceProfile before = profile;
            field.set(profile, value);
            CHECK(field.value(profile) == value);
            for (const ProfileField& other : profile_fields())
                if (other.key != field.key) CHECK(other.value(profile) == other.value(before));
        }
        for (const DeviceProfile& builtin : builtin_profiles()) {
            CHECK(field.value(builtin) >= field.lowest);
            CHECK(field.value(builtin) <= field.highest);
            CHECK((field.value(builtin) - field.lowest) % field.step == 0);
        }
    }
}

// A field without a row would keep its default here.
TEST_CASE("the rows of the table make the complete profile") {
    for (const DeviceProfile& original : builtin_profiles()) {
        DeviceProfile copy;
        copy.name = original.name;
        copy.description = original.description;
        for (const ProfileField& field : profile_fields()) field.set(copy, field.value(original));
        CHECK(copy == original);
    }
    CHECK(profile_fields().size() ==
          85);  // 28 rules of rasterization, 14 of its hypotheses, 43 fields of DeviceProfile
}

TEST_CASE("a description names the source of each value and a changed number is attributed to the user") {
    DeviceProfile profile = *find_profile("geforce3");
    const auto entry = [&](std::string_view key) {
        for (const ProfileEntry& e : describe(profile))
            if (e.key == key) return e.value + ", " + e.source;
        return std::string{};
    };
    CHECK(entry("raster.subpixel_bits") == "4, [M] coverage.md 1.2: hardware tests on NV2A; the minimum OpenGL allows");
    CHECK(entry("raster.depth_rounding") == "floor, [M] chip-depth.md 1.3: NV2A floors integer depth");
    CHECK(entry("has_d32f").starts_with("false, [M]"));
    profile.raster.subpixel_bits = 12;
    CHECK(entry("raster.subpixel_bits") == "12, the profile's own file");
    CHECK(describe(*find_profile("ideal")).front().source == "ideal: no device");
}
