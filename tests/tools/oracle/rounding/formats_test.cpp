// Tests that the renderer's own pictures, which are right by definition, are called right with every format of
// accumulators and picture.
#include <bit>
#include <catch2/catch.hpp>

#include "tests/tools/oracle/verdict/opened_scene.h"
#include "tools/oracle/search/match.h"

using namespace strata;
using namespace strata::oracle::verdict;
using strata::test::OpenedScene;

namespace {

constexpr pipeline::Format kept_formats[] = {pipeline::Format::rgba8, pipeline::Format::rgba16f,
                                             pipeline::Format::rgba32f};

struct Formats {
    pipeline::Format color{}, back{}, result{};
};

// Formats of the accumulators and of the picture; only dual has a separate back format.
std::vector<Formats> all_of(const std::string& algorithm) {
    std::vector<Formats> all;
    for (const pipeline::Format color : kept_formats)
        for (const pipeline::Format result : kept_formats)
            for (const pipeline::Format back : kept_formats)
                if (back == color || algorithm == "dual") all.push_back({color, back, result});
    return all;
}

// True if the picture is right under a hypothesis without slack, or with that of binary32, and with its given coverage.
bool is_right(const SceneFragments& fragments, const oracle::TargetImage& picture) {
    const Colors colors{picture};
    Sample sample = sampled(fragments, colors, 512);
    const Families definite = families(storage_of(colors.code()), {0, 0x1p-20}, Looseness::definite);
    return account_for(definite, {}, fragments, colors, sample).has_value();
}

// The names of the formats whose pictures are not right in this sense.
std::vector<std::string> not_right_alone(OpenedScene opened) {
    SceneFragments fragments = opened.fragments();
    std::vector<std::string> names;
    for (const peeling::Algorithm& algorithm : peeling::algorithms())
        for (const Formats& f : all_of(algorithm.name)) {
            opened.options.result_format = f.result;
            opened.options.back_format = algorithm.name == "dual" ? std::optional{f.back} : std::nullopt;
            const auto picture = algorithm.exact ? opened.picture(algorithm.name, f.color) : std::nullopt;
            if (!picture) continue;
            if (is_right(fragments, *picture)) continue;
            names.push_back(algorithm.name);
            for (const pipeline::Format format : {f.color, f.back, f.result})
                names.back() += ' ' + std::string{pipeline::info(format).name};
        }
    return names;
}

}  // namespace

TEST_CASE("a picture of an exact algorithm is right with every format of accumulators and picture") {
    OpenedScene opened{"teapot", 32, 24};
    opened.profile = *pipeline::find_profile("geforce8_dx101");
    CHECK(not_right_alone(opened) == std::vector<std::string>{});
    opened.options.alpha = 0.97f;  // the transmittance is small, and is computed as 1 - coverage
    CHECK(not_right_alone(opened) == std::vector<std::string>{});
}

TEST_CASE("a float picture has exactly the values that sums of accumulator codes can have") {
    constexpr double code = 1.0 / 255;
    const Interval fronts{10 * code, 11 * code}, backs{100 * code, 101 * code};
    // A transmittance of 1/3: 10 + 100 / 3, 10 + 101 / 3, and the same with 11.
    Sums sums{.front_unit = code,
              .back_unit = code,
              .front = {fronts, fronts, fronts},
              .back = {backs, backs, backs},
              .weight = Interval::of(85 * code),
              .relative = 0x1p-22};
    const auto holds = [&](double codes) { return sums.hold({codes * code, codes * code, codes * code, 1}); };
    CHECK(sums.count() == 64);
    for (const double codes : {10 + 100 / 3.0, 10 + 101 / 3.0, 11 + 100 / 3.0, 11 + 101 / 3.0}) CHECK(holds(codes));
    for (const double codes : {10 + 100.5 / 3, 10.5 + 100 / 3.0, 43.5, 44.0, 44.1}) CHECK_FALSE(holds(codes));
    // Binary16 values near 100 / 255 are 2^-12 apart.
    sums.back_unit = 0;
    sums.is_back_half = true;
    CHECK(holds(10 + 1608 * 0x1p-12 * 255 / 3));
    CHECK_FALSE(holds(10 + 1608.5 * 0x1p-12 * 255 / 3));
    sums.is_back_half = false;  // binary32: all values in between
    CHECK(holds(10 + 100.5 / 3));
    CHECK_FALSE(holds(10.5 + 100 / 3.0));
}

TEST_CASE("a picture of floats over 8-bit accumulators is called right in few bits") {
    OpenedScene opened{"teapot", 64, 48};
    opened.options.result_format = pipeline::Format::rgba32f;
    const Verdict found = judged(opened, *opened.picture("dual", pipeline::Format::rgba8));
    CHECK(found.is_right);
    CHECK(found.right.at_edges == 0);
    CHECK(found.right.account.hypothesis.front.storage == Storage::unorm8);
    CHECK(found.right.bits < static_cast<double>(found.right.covered) * 3);
}

// A sum front to back that adds ever less must not lose a unit of binary16 with each layer.
TEST_CASE("a picture of halves that are cut is called right at once however many layers it has") {
    OpenedScene opened{"volume-beam:slices=24,order=far", 32, 24};
    opened.profile = *pipeline::find_profile("llvmpipe");
    const auto picture = *opened.picture("layer_peel", pipeline::Format::rgba16f);
    opened.profile = *pipeline::find_profile("geforce8");
    const Verdict found = judged(opened, picture);
    CHECK(found.is_right);
    CHECK(found.right.possible <= 1);
}

// Blends of one pass into a cached tile are rounded once, at its end, so an 8-bit sum may lie between the sums of a
// port that rounds each time.
TEST_CASE("a picture of floats over 8-bit accumulators that are rounded once per pass is called right") {
    OpenedScene opened{"showroom", 48, 36};
    opened.options.background = {0, 0, 0, 1};
    opened.options.result_format = pipeline::Format::rgba32f;
    opened.profile = *pipeline::find_profile("softpipe");
    const auto picture = *opened.picture("coherent_stencil", pipeline::Format::rgba8);
    opened.profile = *pipeline::find_profile("geforce8");
    CHECK(judged(opened, picture).is_right);
}

// All values are within the rounding of halves, but they are none.
TEST_CASE("a picture of floats that are no halves is not right by accumulators of halves") {
    const OpenedScene opened{"volume-beam:slices=8", 48, 36};
    const oracle::TargetImage halves = *opened.picture("a_buffer", pipeline::Format::rgba16f);
    oracle::TargetImage floats = halves;
    floats.code = oracle::Code::single;
    for (std::size_t i = 0; i < floats.codes.size(); ++i)
        floats.codes[i] = oracle::nearest(oracle::Code::single, oracle::value(oracle::Code::half, halves.codes[i]));
    const SceneFragments fragments = opened.fragments();
    // The number of wrong pixels.
    const auto wrong_by_halves = [&](Order order, const oracle::TargetImage& picture) {
        const End end{Storage::half, SourceRounding::any, Rounding::any};
        const End result{Storage::single, SourceRounding::unrounded, Rounding::nearest};
        Sample examples{fragments.setting()};
        const Account account{{}, {.order = order, .front = end, .back = end, .result = result}};
        return check_all(fragments, Colors{picture}, account, WrongPixels::some, examples).wrong_pixels.size();
    };
    CHECK(wrong_by_halves(Order::over, floats) == 0);
    oracle::TargetImage off = floats;
    std::size_t changed = 0;
    for (std::uint32_t& word : off.codes)
        if (std::bit_cast<float>(word) > 0.25f && std::bit_cast<float>(word) < 0.875f) word += 64, ++changed;
    CHECK(changed > 100);
    CHECK(wrong_by_halves(Order::over, off) > 100);
    const oracle::TargetImage exact = *opened.picture("a_buffer", pipeline::Format::rgba32f);
    for (const Order order : {Order::over, Order::over_apart, Order::under, Order::both_ends}) {
        INFO(name(order));
        CHECK(wrong_by_halves(order, exact) > 100);
    }
}
