// Tests experiments whose later passes draw something else, or the same in another way, against the experiment without
// that choice, and fragments worked out by hand.
#include <catch2/catch.hpp>
#include <cmath>

#include "peeling/audit/path_pairs.h"
#include "peeling/audit/safe_range.h"
#include "peeling/invariance.h"
#include "peeling/registry.h"
#include "pipeline/frame/captured_fragment.h"
#include "tests/peeling/rendering.h"

namespace {

using namespace strata::testing;
using namespace strata::peeling;
using namespace strata::pipeline;
using strata::rasterizer::DepthPath;

// Four layers at every pixel, and a wall before the last two in every third pixel.
DrawList walled_layers() {
    FragmentScene scene{8, 8};
    for (std::size_t p = 0; p < scene.pixels.size(); ++p) {
        for (const int k : {3, 1, 4, 2})
            scene.pixels[p].fragments.push_back({static_cast<float>(k) / 8.0f, {1, 0.5f, 0.25f, 0.5f}});
        if (p % 3 == 0) scene.pixels[p].opaque = GivenFragment{2.5f / 8.0f, {0, 0, 1, 1}};
    }
    return draw_list(scene);
}

InvarianceCase plain_experiment(const char* algorithm = "front_to_back", DepthFormat format = DepthFormat::d24) {
    InvarianceCase e;
    e.render.width = e.render.height = 8;
    e.render.threads = 1;
    e.render.depth = format;
    e.algorithm = find_algorithm(algorithm);
    return e;
}

Measurement measured(const InvarianceCase& e, const char* profile = "ideal") {
    static const DrawList list = walled_layers();
    return measure(list, {}, *find_profile(profile), e);
}

void check_alike(const Measurement& found, const Measurement& plain) {
    REQUIRE_FALSE(found.refusal);
    CHECK(found.paths == plain.paths);
    CHECK(found.picture == plain.picture);
    CHECK(found.errors.total() == 0);
    CHECK(found.passes == plain.passes);
    CHECK_FALSE(found.advice.epsilon);  // its proof requires a single list
}

}  // namespace

TEST_CASE("later passes that draw the same in another way give the same result without advice") {
    const Measurement plain = measured(plain_experiment());
    REQUIRE(plain.advice.epsilon);
    CHECK(plain.errors.total() == 0);
    CHECK(plain.errors.layers_max == 4);
    CHECK(plain.picture == plain.truth);  // colours are products of halves, which only binary32 represents exactly
    const DrawList again = walled_layers();
    InvarianceCase second_list = plain_experiment();
    second_list.render.second_list = &again;
    check_alike(measured(second_list), plain);
    InvarianceCase second_path = plain_experiment();
    second_path.render.vertex_paths.second = VertexPath::fused;  // identity matrices, so nothing rounds
    check_alike(measured(second_path), plain);
    InvarianceCase second_clamp = plain_experiment();
    second_clamp.render.second_depth_clamp = true;  // nothing crosses near or far
    check_alike(measured(second_clamp), plain);
}

TEST_CASE("an experiment has at most its number of passes and a moved one is compared and not peeled") {
    InvarianceCase short_one = plain_experiment();
    short_one.max_passes = 2;
    const Measurement cut = measured(short_one);
    CHECK(cut.passes == 2);
    CHECK_FALSE(cut.ended);
    InvarianceCase moved = plain_experiment();
    moved.moved_window = {16, 8};
    const Measurement compared = measured(moved);
    CHECK_FALSE(compared.peeled);
    CHECK(compared.paths.fragments == 4 * 64);
    CHECK(compared.paths.differing == 0);  // moved by whole pixels: bit-identical
    CHECK(compared.passes == 0);
    CHECK(compared.picture.codes.empty());
}

TEST_CASE("a peel that compares its own codes rejects an experiment with another depth and returns no figure") {
    InvarianceCase e = plain_experiment("coherent_stencil");
    e.compare = DepthPath::perspective_rq;
    const Measurement m = measured(e);
    REQUIRE(m.refusal);
    CHECK(m.refusal->message(*find_profile("ideal")).find("algorithm coherent_stencil has no other compared depth") !=
          std::string::npos);
    CHECK(m.paths == PathComparison{});
}

TEST_CASE("a bias is advised only where it moves the stored depth alone") {
    for (const bool writes_quotient : {false, true}) {
        InvarianceCase e = plain_experiment();
        e.write = writes_quotient ? DepthPath::perspective_rq : DepthPath::float32;
        e.compare = DepthPath::perspective_rq;
        const Measurement m = measured(e);
        REQUIRE_FALSE(m.refusal);
        CHECK(m.advice.epsilon.has_value());
        CHECK(m.advice.bias.has_value() == !writes_quotient);
    }
}

namespace {

CapturedFragment given(std::uint32_t pixel, std::uint32_t primitive, std::uint32_t code) {
    CapturedFragment f;
    f.pixel = pixel;
    f.primitive = primitive;
    f.code = code;
    return f;
}

}  // namespace

TEST_CASE("fragments of two splits are paired by their number or a neighbour's in their own pixel only") {
    using Pairs = std::vector<PathPair>;
    const auto pairs = [](const std::vector<CapturedFragment>& a, const std::vector<CapturedFragment>& b) {
        return pair_up(a, b, Match::quad).pairs;
    };
    CHECK(pairs({given(0, 2, 7)}, {given(0, 3, 9)}) == Pairs{{0, 2, 7, 9}});
    CHECK(pairs({given(0, 3, 7)}, {given(0, 2, 9)}) == Pairs{{0, 3, 7, 9}});
    CHECK(pairs({given(0, 2, 7)}, {given(1, 3, 9)}).empty());  // another pixel
    CHECK(pairs({given(0, 2, 7)}, {given(0, 4, 9)}).empty());  // no neighbour
    // 2 has the neighbour 3, but 3 is present itself.
    CHECK(pairs({given(0, 2, 7), given(0, 3, 8)}, {given(0, 3, 9)}) == Pairs{{0, 3, 8, 9}});
    CHECK(pairs({given(0, 2, 7), given(1, 3, 8)}, {given(0, 3, 9)}) == Pairs{{0, 2, 7, 9}});
}

TEST_CASE("an epsilon beyond 1 is not offered as least one and a single layer has no greatest epsilon") {
    // D24: code 0 stored, the far plane compared: a distance of 1, which an epsilon of exactly 1 still covers.
    const std::uint32_t far = 0xffffff;
    const std::vector<std::uint32_t> opaque{far};
    const SafeAbsolute near_far = safe_absolute(std::vector<PathPair>{{0, 0, 0, far}}, opaque, DepthFormat::d24);
    REQUIRE(near_far.lowest);
    CHECK_FALSE(near_far.highest);
    CHECK(near_far.contains(1));
    CHECK(near_far.contains(*near_far.lowest));
    CHECK_FALSE(near_far.contains(std::nextafter(*near_far.lowest, 0.0)));
    // Binary32 depths need not be below 1: a compared 3 is behind 0 by more than any epsilon.
    const auto bits = [](float depth) { return std::bit_cast<std::uint32_t>(depth); };
    const std::vector<std::uint32_t> behind{bits(9.0f)};
    const SafeAbsolute beyond =
        safe_absolute(std::vector<PathPair>{{0, 0, bits(0.0f), bits(3.0f)}}, behind, DepthFormat::d32f);
    CHECK_FALSE(beyond.lowest);
    CHECK_FALSE(beyond.contains(1));
    CHECK_FALSE(beyond.contains(0));
    // And a second layer that is compared so far behind is never lost.
    const SafeAbsolute both =
        safe_absolute(std::vector<PathPair>{{0, 0, bits(0.0f), bits(0.0f)}, {0, 1, bits(0.5f), bits(3.0f)}}, behind,
                      DepthFormat::d32f);
    CHECK_FALSE(both.highest);
    CHECK_FALSE(both.contains(0));
}
