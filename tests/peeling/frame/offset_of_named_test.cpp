// Tests polygon offset of named meshes and materials on every profile and depth format, against rational depths: the
// plane of the surface plus m factor + r units for what is named, the plane alone for the rest.
#include <algorithm>
#include <catch2/catch.hpp>

#include "peeling/registry.h"
#include "pipeline/device/check.h"
#include "tests/peeling/rendering.h"
#include "tests/rasterizer/rational.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::rasterizer::OffsetUnit;
using strata::rasterizer::Rational;

constexpr int offset_side = 64;
constexpr std::array<float, 3> wall_plane{0.25f, -0.125f, 0.25f};  // clip z = a x + b y + c; window z is above 1/2
constexpr strata::rasterizer::PolygonOffset towards_the_eye{true, -2, -1000};

// A square in the wall's plane, with its corners in the middle of no pixel.
void add_square(DrawList& list, const std::string& mesh, const std::string& material, float half, AlphaMode mode) {
    Mesh square;
    square.name = mesh;
    square.indices = {0, 1, 2, 0, 2, 3};
    const auto& [a, b, c] = wall_plane;
    for (const auto& [x, y] : {std::pair{-half, -half}, {half, -half}, {half, half}, {-half, half}})
        square.positions.push_back({x, y, a * x + b * y + c});
    const auto number = static_cast<std::uint32_t>(list.meshes.size());
    const Rgba color = mode == AlphaMode::blend ? Rgba{0, 0, 1, 0.5f} : Rgba{1, 1, 0, 1};
    list.meshes.push_back(std::move(square));
    list.materials.push_back(
        {.name = material, .front = color, .back = color, .alpha_mode = mode, .double_sided = true, .unlit = true});
    list.instances.push_back({.mesh = number, .material = number});
}

// Triangles 0 and 1 are the wall's, 2 and 3 the decal's.
DrawList decal_on_wall() {
    DrawList list;
    add_square(list, "wall", "plaster", 0.875f, AlphaMode::opaque);
    add_square(list, "decal", "paint", 0.5f, AlphaMode::blend);
    return list;
}

RenderOptions decal_options(DepthFormat format, std::vector<std::string> names) {
    RenderOptions options;
    options.width = options.height = offset_side;
    options.threads = 1;
    options.depth = format;
    options.raster.polygon_offset = towards_the_eye;
    options.offset_only = std::move(names);
    return options;
}

Rational depth_at(std::uint32_t pixel) {
    const auto at = [](std::uint32_t p) { return Rational{2 * p + 1, offset_side} - 1; };
    const auto& [a, b, c] = wall_plane;
    const Rational y = -at(pixel / offset_side);
    return (Rational{a} * at(pixel % offset_side) + Rational{b} * y + Rational{c} + 1) / 2;
}

Rational greatest_code(DepthFormat format) { return format == DepthFormat::d16 ? 65535 : 16777215; }

// r, of triangles whose greatest depth is from 1/2 to 1.
Rational unit_of(OffsetUnit rule, DepthFormat format) {
    if (rule == OffsetUnit::differences && format == DepthFormat::d16) return Rational{1.01f / 65535.0f};
    const bool by_exponent = rule == OffsetUnit::differences || rule == OffsetUnit::float_exponent;
    if (by_exponent || format == DepthFormat::d32f) return strata::rasterizer::power(-24);
    return (rule == OffsetUnit::two_codes ? 2 : 1) / greatest_code(format);
}

Rational offset_of(const DeviceProfile& profile, DepthFormat format) {
    const Rational per_pixel = Rational{std::max(std::abs(wall_plane[0]), std::abs(wall_plane[1]))} / offset_side;
    return per_pixel * Rational{towards_the_eye.factor} +
           unit_of(profile.raster.offset_unit, format) * Rational{towards_the_eye.units};
}

Rational depth_of(std::uint32_t code, DepthFormat format) {
    return format == DepthFormat::d32f ? Rational{std::bit_cast<float>(code)} : Rational{code} / greatest_code(format);
}

std::vector<CapturedFragment> all_fragments(const DrawList& list, const DeviceProfile& profile, RenderOptions options) {
    options.alpha = 1.0f;  // captures what is opaque, too
    strata::peeling::Renderer renderer{list, {}, profile, options};
    return renderer.fragments(*strata::peeling::find_algorithm("unsorted")).all;
}

template <class Visit>
void for_each_depth(Visit visit) {
    for (const DeviceProfile& profile : builtin_profiles())
        for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f})
            if (!check(profile, format)) visit(profile, format);
}

}  // namespace

TEST_CASE("on every profile the named meshes or materials are at the plane's depth plus the offset and others at it") {
    const DrawList list = decal_on_wall();
    const std::vector<std::string> choices[] = {{}, {"decal"}, {"paint"}, {"wall"}, {"plaster", "decal"}};
    for_each_depth([&](const DeviceProfile& profile, DepthFormat format) {
        const Rational offset = offset_of(profile, format);
        const bool is_float = format == DepthFormat::d24 && profile.depth24 == Depth24::binary32;
        const DepthFormat stored = is_float ? DepthFormat::d32f : format;
        const Rational step = stored == DepthFormat::d32f ? strata::rasterizer::power(-24) : 1 / greatest_code(stored);
        for (const auto& names : choices) {
            INFO(profile.name << ", " << strata::enum_name(format) << ", " << names.size() << " names");
            const auto is_named = [&](const char* mesh, const char* material) {
                return names.empty() || std::ranges::count(names, mesh) + std::ranges::count(names, material) > 0;
            };
            const bool moves[] = {is_named("wall", "plaster"), is_named("decal", "paint")};
            std::uint64_t seen[2] = {}, wrong = 0;
            for (const CapturedFragment& f : all_fragments(list, profile, decal_options(format, names))) {
                const std::uint32_t object = f.primitive / 2;
                const Rational right = depth_at(f.pixel) + (moves[object] ? offset : Rational{0});
                wrong += abs(depth_of(f.code, stored) - right) > 4 * step ? 1 : 0;
                ++seen[object];
            }
            CHECK(abs(offset) > 100 * step);
            CHECK(wrong == 0);
            CHECK(seen[0] == 56 * 56);
            CHECK(seen[1] == 32 * 32);
        }
    });
}

TEST_CASE("what is not named has the bits of a draw without an offset and what is named those of a draw of all") {
    const DrawList list = decal_on_wall();
    for_each_depth([&](const DeviceProfile& profile, DepthFormat format) {
        INFO(profile.name << ", " << strata::enum_name(format));
        RenderOptions without = decal_options(format, {});
        without.raster.polygon_offset = {};
        const auto plain = all_fragments(list, profile, without);
        const auto moved = all_fragments(list, profile, decal_options(format, {}));
        const auto some = all_fragments(list, profile, decal_options(format, {"decal"}));
        REQUIRE(plain.size() == some.size());
        REQUIRE(moved.size() == some.size());
        std::uint64_t wrong = 0;
        for (std::size_t i = 0; i < some.size(); ++i) {
            const CapturedFragment& right = some[i].primitive < 2 ? plain[i] : moved[i];
            wrong += some[i].code == right.code && some[i].shader_z == right.shader_z ? 0 : 1;
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE("a decal with an offset towards the eye is drawn over its wall at every pixel and without one fights it") {
    const DrawList list = decal_on_wall();
    const auto blended = [&](const DeviceProfile& profile, const RenderOptions& options) {
        strata::peeling::Renderer renderer{list, {}, profile, options};
        const RenderResult result = renderer.render(*strata::peeling::find_algorithm("dual"));
        CHECK(result.audit.order_errors == 0u);
        const Image& picture = result.frame.color;
        std::uint64_t pixels = 0;
        for (std::size_t p = 0; p < picture.codes.size(); p += 4) pixels += picture.codes[p + 2] != 0 ? 1 : 0;
        return pixels;
    };
    for (const char* name : {"geforce8", "llvmpipe", "softpipe", "swiftshader"}) {
        const DeviceProfile& profile = *find_profile(name);
        for (const Running& running : all_ways_of_running) {
            INFO(name);
            RenderOptions options = decal_options(DepthFormat::d24, {"decal"});
            options.color_format = Format::rgba8;
            running.apply(options);
            CHECK(blended(profile, options) == 32 * 32);
            options.offset_only.clear();
            CHECK(blended(profile, options) < 32 * 32);
        }
    }
}

TEST_CASE("a name that no drawn mesh or material has is refused") {
    const DrawList list = decal_on_wall();
    CHECK_THROWS_WITH(
        all_fragments(list, *find_profile("geforce8"), decal_options(DepthFormat::d24, {"decal", "decals"})),
        "render options: offset_only: expected the name of a mesh or of a material, found 'decals'");
}
