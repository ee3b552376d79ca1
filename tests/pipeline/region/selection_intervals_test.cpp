// Tests selections by every kind of bound, alone and two at a time, on every depth format, and by the compared depth
// where it differs from the stored one. The expected interval is the definition in selection.h, applied to each
// fragment in the pass's own program; the reference is literal execution.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/pipeline/region/both_ways.h"
#include "tests/pipeline/region/changed_states.h"
#include "tests/support/random_numbers.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::rasterizer::max_code;

enum Bound : unsigned {
    behind = 1,
    from = 2,
    behind_value = 4,
    before = 8,
    also_before = 16,
    up_to = 32,
    before_value = 64,
    keys = 128
};
constexpr unsigned near_bounds = behind | from | behind_value;

const FragmentScene& window_scene() {
    static const FragmentScene scene = [] {
        FragmentScene made{16, 16};
        Random random{404};
        for (auto& pixel : made.pixels)
            for (int i = random_int(random, 0, 9); i-- > 0;) {
                const auto depth = static_cast<float>(random_int(random, 0, 16)) / 16.0f;
                pixel.fragments.push_back({depth, random_color(random)});
            }
        return made;
    }();
    return scene;
}

// A value that depends only on the pixel's position, not on the tile. Bounds of values may also be NaN, negative, above
// 1 and between two codes.
std::uint32_t hashed(std::uint16_t x, std::uint16_t y, std::uint32_t salt) {
    std::uint32_t h = (x * 73856093u) ^ (y * 19349663u) ^ (salt * 83492791u);
    h ^= h >> 13;
    h *= 0x5bd1e995u;
    return h ^ h >> 15;
}

float bound_value(std::uint16_t x, std::uint16_t y, std::uint32_t salt) {
    const std::uint32_t h = hashed(x, y, salt);
    switch (h % 9) {
        case 0: return std::numeric_limits<float>::quiet_NaN();
        case 1: return -1.0f;
        case 2: return 2.0f;
        case 3: return 0.0f;
        case 4: return static_cast<float>(h >> 8 & 15) / 16.0f + 0x1p-20f;
        default: return static_cast<float>(h >> 8 & 31) / 32.0f;
    }
}

std::uint32_t as_code(float depth, DepthFormat format) { return to_depth_code(depth, format, DepthRounding::nearest); }

// The stored code as the number that a float target stores for it.
float as_value(std::uint32_t code, DepthFormat format) {
    return format == DepthFormat::d32f ? std::bit_cast<float>(code) : static_cast<float>(depth_value(code, format));
}

// A depth target with a code at every pixel that depends on its position and `salt`.
Target depth_bounds(Region& region, std::uint32_t salt) {
    const Target made = region.make_depth();
    const DepthFormat format = region.frame().key_request().format;
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::always, .write = true};
    state.depth_target = made;
    static_cast<void>(region.full_screen(state, [=](const FragmentBatch& in, const Loads&, Outputs& out) {
        out.replaces_depth = true;
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i)
            out.depth[i] = as_code(static_cast<float>(hashed(in.x[i], in.y[i], salt) >> 8 & 31) / 32.0f, format);
    }));
    return made;
}

Target value_bounds(Region& region, std::uint32_t salt) {
    const Target made = region.make(Format::r32f);
    PassState state;
    state.color[0] = made;
    static_cast<void>(region.full_screen(state, [=](const FragmentBatch& in, const Loads&, Outputs& out) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i)
            out.color[0][0][i] = bound_value(in.x[i], in.y[i], salt);
    }));
    return made;
}

void draw_window(Region& region, unsigned bounds, KeptFragments keeps) {
    const DepthFormat format = region.frame().key_request().format;
    PassState state;
    FragmentSelection& s = state.selection;
    s.keeps = keeps;
    std::vector<std::pair<unsigned, Target>> made;  // in the order of state.reads
    const auto bound = [&](unsigned which, KeyBound& to, std::uint32_t salt) {
        if ((bounds & which) == 0) return;
        const bool is_value = (which & (behind_value | before_value)) != 0;
        to = {is_value ? value_bounds(region, salt) : depth_bounds(region, salt), (which & (from | up_to)) != 0,
              is_value ? 0 : -1};
        state.reads[made.size()] = to.target;
        made.emplace_back(which, to.target);
    };
    for (const auto& [which, salt] : {std::pair{behind, 1u}, {from, 2u}, {behind_value, 6u}})
        bound(which, s.near, salt);
    for (const auto& [which, salt] : {std::pair{before, 3u}, {also_before, 4u}, {up_to, 5u}, {before_value, 8u}})
        bound(which, s.far[s.far[0].exists() ? 1 : 0], salt);
    // Codes of an interval are not raised: a selection of another kind would visit every fragment.
    const std::uint32_t raised = (bounds & behind) != 0 && keeps == KeptFragments::nearest ? 3 : 0;
    state.needs.reference = raised > 0;
    if (raised > 0) s.compared = DepthCompare{.format = format, .epsilon = {.ulps = static_cast<int>(raised)}};
    if ((bounds & keys) != 0) {
        s.least = as_code(0.25f, format);
        s.most = as_code(0.75f, format);
    }
    state.color[0] = region.make(Format::rgba32f);
    if (keeps == KeptFragments::nearest) {
        state.depth = nearest_stays;
        state.depth_target = region.make_depth();
        region.clear(state.depth_target, {.depth = 1.0f});
    } else {
        state.blend[0] = blend_mode::over;
    }
    const FragmentSelection interval = s;
    static_cast<void>(region.draw(state, [=](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        out.color[0] = in.color;
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
            const std::uint32_t code = in.code[i];
            const float value = as_value(code, format);
            bool is_inside = code >= interval.least && code <= interval.most;
            for (std::size_t r = 0; r < made.size(); ++r) {
                const unsigned which = made[r].first;
                const auto read = static_cast<int>(r);
                if (which == behind_value) is_inside &= value > loads.color(read)[0][i];
                if (which == before_value) is_inside &= value < loads.color(read)[0][i];
                if ((which & (behind_value | before_value)) != 0) continue;
                const std::uint32_t stored = loads.depth(read)[i];
                if (which == behind) is_inside &= code > std::min(stored + raised, max_code(format));
                if (which == from) is_inside &= code >= stored;
                if (which == before || which == also_before) is_inside &= code < stored;
                if (which == up_to) is_inside &= code <= stored;
            }
            if (!is_inside) out.discard(static_cast<int>(i));
        }
    }));
    region.publish(region.opaque_color());
}

std::string window_difference(DepthFormat format, unsigned bounds, KeptFragments keeps) {
    TestFrame test{window_scene(), "ideal"};
    test.frame.depth.format = format;
    test.frame.replay = {std::uint64_t{1} << 20, {}};
    const Body body = [&](Region& region) { draw_window(region, bounds, keeps); };
    const Instruments checks{.check_selections = true};
    const RunResult literal = run_one_way(test.frame, body, Execution::literal, {});
    const std::string checked = difference_of(literal, run_one_way(test.frame, body, Execution::replay, checks));
    return checked + difference_of(literal, run_one_way(test.frame, body, Execution::replay, {}));
}

}  // namespace

TEST_CASE("an interval is the fragments between its bounds for every kind of bound in every depth format", "[slow]") {
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f})
        for (unsigned a = 1; a <= keys; a *= 2)
            for (unsigned b = a; b <= keys; b *= 2)
                for (const KeptFragments keeps : {KeptFragments::interval, KeptFragments::nearest}) {
                    if (a != b && ((a | b) & near_bounds) == (a | b)) continue;  // at most one near bound
                    INFO("format " << static_cast<int>(format) << ", bounds " << (a | b));
                    CHECK(window_difference(format, a | b, keeps) == "");
                }
}

namespace {

// Triangles in perspective whose depth by a quotient differs from the stored one by a few codes.
struct TwoDepths {
    TriangleScene scene = random_triangles(2052, 30);
    PreparedDraw transparent;
    Frame frame;
    TwoDepths() {
        const DeviceProfile& ideal = *find_profile("ideal");
        strata::rasterizer::RasterState raster;
        raster.viewport = {0, 0, 32, 32};
        raster.depth_format = DepthFormat::d24;
        transparent =
            prepare(scene.list, scene.view, raster, ideal,
                    {.selection = Selection::transparent, .depth_quotient = true, .tile_size = 8, .threads = 1});
        frame.profile = &ideal;
        frame.transparent = &transparent;
        frame.depth = {strata::rasterizer::DepthPath::float32, DepthFormat::d24,
                       strata::rasterizer::DepthPath::perspective_rq};
        frame.replay = {std::uint64_t{1} << 20, {.reference = true}};
        frame.background = {0, 0, 0, 0};
    }
};

std::string reference_difference(const Changed& change, std::uint64_t bytes = std::uint64_t{1} << 20) {
    TwoDepths two;
    two.frame.replay.bytes = bytes;
    const Body body = [&](Region& region) {
        PassState state;
        state.depth = nearest_stays;
        state.depth_target = region.make_depth();
        region.copy(region.opaque_depth(), state.depth_target);
        state.color[0] = region.make_color();
        const Target peeled = region.make_depth();
        region.clear(peeled, {.depth = 0.4f});
        state.reads = {peeled, region.opaque_depth()};
        state.needs.reference = true;
        state.selection = {
            .keeps = KeptFragments::nearest,
            .near = KeyBound::beyond(peeled),
            .compared = DepthCompare{.format = DepthFormat::d24, .epsilon = {.ulps = 2}, .has_reference = true}};
        change(state, region);
        const FragmentSelection interval = state.selection;
        static_cast<void>(region.draw(state, [=](const FragmentBatch& in, const Loads& loads, Outputs& out) {
            out.color[0] = in.color;
            for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i)
                if (in.reference_code[i] <= loads.depth(0)[i] + 2 || in.code[i] > interval.most ||
                    (interval.far[0].exists() && in.code[i] >= loads.depth(1)[i] + (interval.far[0].includes ? 1 : 0)))
                    out.discard(static_cast<int>(i));
        }));
        region.publish(region.opaque_color());
    };
    return difference_of(run_one_way(two.frame, body, Execution::literal, {}),
                         run_one_way(two.frame, body, Execution::replay, {}));
}

}  // namespace

TEST_CASE("a selection by the compared depth keeps the nearest fragment behind its bound and within the others") {
    for (const Change& change : changes()) {
        if (std::string_view{change.name}.starts_with("targets of two")) continue;
        INFO(change.name);
        CHECK(reference_difference(change.make) == "");
    }
    const std::vector<Changed> bounds{
        [](PassState& s, Region& r) { s.selection.far[0] = KeyBound::beyond(r.opaque_depth()); },
        [](PassState& s, Region& r) { s.selection.far[0] = KeyBound::at(r.opaque_depth()); },
        [](PassState& s, Region&) { s.selection.most = 0xd00000; }};
    for (std::size_t k = 0; k < bounds.size(); ++k) {
        INFO("bound " << k);
        CHECK(reference_difference(bounds[k]) == "");
        CHECK(reference_difference(bounds[k], 0) == "");
    }
}
