// Tests reversed depth of every kind on every profile and depth format, against planes in rational arithmetic: what is
// drawn shows the nearest surface, and everything else is refused.
#include <algorithm>
#include <catch2/catch.hpp>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "rasterizer/base/enum_values.h"
#include "scenes/camera.h"
#include "tests/rasterizer/rational.h"

namespace {

using namespace strata;
using pipeline::DepthFormat;
using rasterizer::ClipDepth, rasterizer::DepthOrder;
using rasterizer::Rational;

constexpr int crossing_side = 32;
// Depths from 0, near, to 1: a + b x with x from -1 to 1.
constexpr std::array<std::array<float, 2>, 2> crossing_planes{{{0.5f, 0.25f}, {0.5625f, -0.25f}}};

// Two opaque planes that cross, red and green, for a parallel projection whose clip z is twice the depth less 1.
pipeline::DrawList crossing() {
    pipeline::DrawList list;
    for (std::uint32_t i = 0; i < 2; ++i) {
        const auto& [a, b] = crossing_planes[i];
        pipeline::Mesh mesh;
        for (const auto& [x, y] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}})
            mesh.positions.push_back({x, y, 2 * (a + b * x) - 1});
        mesh.indices = {0, 1, 2, 0, 2, 3};
        list.meshes.push_back(std::move(mesh));
        const pipeline::Rgba color{i == 0 ? 1.0f : 0.0f, i == 1 ? 1.0f : 0.0f, 0, 1};
        list.materials.push_back({.name = "", .front = color, .back = color, .double_sided = true, .unlit = true});
        list.instances.push_back({.mesh = i, .material = i});
    }
    return list;
}

struct Convention {
    DepthOrder order;
    float near, far;
    ClipDepth clip;
};

peeling::RenderResult drawn_by(const pipeline::DeviceProfile& profile, DepthFormat format, const Convention& c) {
    static const pipeline::DrawList list = crossing();
    peeling::RenderOptions options;
    options.width = options.height = crossing_side;
    options.threads = 1;
    options.depth = format;
    options.color_format = pipeline::Format::rgba8;
    options.raster.depth_order = c.order;
    options.raster.clip_depth = c.clip;
    options.raster.depth_near = c.near;
    options.raster.depth_far = c.far;
    const pipeline::View view = scenes::with_clip_convention({}, {}, scenes::view_convention(options.raster));
    peeling::Renderer renderer{list, view, profile, options};
    return renderer.render(*peeling::find_algorithm("unsorted"));
}

// Of a plane at the centre of a column's pixels.
Rational crossing_depth(std::size_t plane, int x) {
    const Rational at = Rational{2 * x + 1, crossing_side} - 1;
    return Rational{crossing_planes[plane][0]} + Rational{crossing_planes[plane][1]} * at;
}

// Pixels whose colour is not that of the nearer plane; planes closer than a code of 16 bits are left out.
int wrong_pixels(const pipeline::Image& picture) {
    int wrong = 0;
    for (int y = 0; y < crossing_side; ++y)
        for (int x = 0; x < crossing_side; ++x) {
            const Rational behind = crossing_depth(1, x) - crossing_depth(0, x);
            if (abs(behind) < rasterizer::power(-14)) continue;
            const bool is_red = picture.codes[picture.index(x, y, 0)] == 255;
            wrong += is_red != (behind > 0) ? 1 : 0;
        }
    return wrong;
}

// Codes of the nearest depth that are not the nearest to it, for fixed point and exact depths.
int wrong_codes(const pipeline::Image& depths, bool is_greater) {
    const Rational greatest{static_cast<int>(rasterizer::max_code(pipeline::depth_format(depths.format)))};
    int wrong = 0;
    for (int y = 0; y < crossing_side; ++y)
        for (int x = 0; x < crossing_side; ++x) {
            const Rational nearest = std::min(crossing_depth(0, x), crossing_depth(1, x));
            const Rational window = is_greater ? 1 - nearest : nearest;
            const Rational code{static_cast<int>(depths.codes[depths.index(x, y)])};
            wrong += abs(code - window * greatest) > Rational{1, 2} ? 1 : 0;
        }
    return wrong;
}

}  // namespace

TEST_CASE("whatever is reversed on whatever profile and depth format the nearest surface is drawn or nothing") {
    int drawn = 0, refused = 0;
    for (const pipeline::DeviceProfile& profile : pipeline::builtin_profiles())
        for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f})
            for (const ClipDepth clip : {ClipDepth::minus_one_to_one, ClipDepth::zero_to_one})
                for (const bool is_greater : {false, true})
                    for (const bool is_range_reversed : {false, true}) {
                        const Convention convention{is_greater ? DepthOrder::greater : DepthOrder::less,
                                                    is_range_reversed ? 1.0f : 0.0f, is_range_reversed ? 0.0f : 1.0f,
                                                    clip};
                        const peeling::RenderResult result = drawn_by(profile, format, convention);
                        INFO(profile.name << ", " << enum_name(format) << ", " << enum_name(clip)
                                          << (is_greater ? ", GREATER" : "")
                                          << (is_range_reversed ? ", reversed range" : ""));
                        // LESS over a reversed range is refused.
                        const bool is_possible = !check(profile, format) && (is_greater || !is_range_reversed);
                        CHECK(result.refusal.has_value() == !is_possible);
                        if (result.refusal) {
                            ++refused;
                            continue;
                        }
                        ++drawn;
                        CHECK(wrong_pixels(result.frame.color) == 0);
                        if (profile.name == "ideal" && format != DepthFormat::d32f)
                            CHECK(wrong_codes(result.frame.depth, is_greater) == 0);
                    }
    CHECK(drawn > 60);
    CHECK(refused > 60);
}
