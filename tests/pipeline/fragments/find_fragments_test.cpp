// Tests which fragments a selection visits, against a loop that decides for each fragment of a pixel by itself, in
// submission order, whether it is kept.
#include "pipeline/fragments/find_fragments.h"

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "tests/pipeline/fragments/recorded_fragments.h"

// A separate namespace: models of several tests use the same short names, and a unity build joins their files.
namespace strata::testing::find_fragments_model {
namespace {

using namespace pipeline;
using rasterizer::DepthFormat;
using rasterizer::ordered_code;

constexpr std::uint32_t pixels = 70;
constexpr int codes = 9;

struct Tile {
    GivenRecord given;
    SortedLists sorted;
    std::vector<std::uint32_t> entries = std::vector<std::uint32_t>(pixels), more = entries, stored = entries;

    Tile(Random& random, const SortRequest& request) {
        fill_record(random, random_int(random, 0, 25), pixels, codes, all_values, given);
        REQUIRE(sorted.sort(given.record, request, pixels, std::uint64_t{1} << 30));
        for (auto* const plane : {&entries, &more, &stored})
            for (auto& entry : *plane) entry = static_cast<std::uint32_t>(random_int(random, 0, codes));
    }
    // Indices of a pixel's fragments for which `holds` is true, in submission order.
    template <class Holds>
    [[nodiscard]] std::vector<std::uint32_t> indices(std::uint32_t pixel, const Holds& holds) const {
        std::vector<std::uint32_t> found;
        for (std::uint32_t index = 0; index < given.living.size(); ++index)
            if (given.living[index].pixel == pixel && holds(given.living[index])) found.push_back(index);
        return found;
    }
};

// The fragments visited at each pixel, wave after wave; a wave has at most one fragment per pixel.
std::map<std::uint32_t, std::vector<std::uint32_t>> visited(const FragmentWaves& waves) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> all;
    for (std::size_t w = 0; w < waves.waves(); ++w) {
        std::set<std::uint32_t> seen;
        for (std::size_t k = 0; k < waves.wave(w).pixel.size(); ++k) {
            const std::uint32_t pixel = waves.wave(w).pixel[k];
            REQUIRE(seen.insert(pixel).second);
            all[pixel].push_back(index_of(waves.wave(w).entry[k]));
        }
    }
    return all;
}

BoundPlane codes_in(const std::vector<std::uint32_t>& plane, bool includes) {
    return {plane.data(), includes, BoundPlane::Contents::codes, DepthFormat::d24};
}

using Fragment = GivenRecord::Fragment;

}  // namespace

TEST_CASE(
    "nearest visits the first submitted fragment of the least key in an interval if it is before the stored depth") {
    Random random{2321};
    for (int round = 0; round < 60; ++round) {
        Tile tile{random, {}};
        const bool includes = round % 2 == 0, has_far = round % 3 == 0;
        KeyIntervals intervals{.near = codes_in(tile.entries, includes)};
        if (has_far) intervals.far[0] = codes_in(tile.more, round % 5 == 0);
        if (round % 4 == 0) intervals.least = 3, intervals.end = 6;
        for (int pass = 0; pass < 3; ++pass) {  // later searches start where the previous pass found its fragment
            FragmentWaves waves;
            find_nearest(tile.sorted, intervals, {tile.stored.data(), false}, waves);
            auto found = visited(waves);
            std::uint64_t wrong = 0;
            for (std::uint32_t p = 0; p < pixels; ++p) {
                const auto inside = tile.indices(p, [&](const Fragment& f) {
                    const bool is_behind = includes ? f.code >= tile.entries[p] : f.code > tile.entries[p];
                    const bool is_before = !has_far || f.code < tile.more[p] + (round % 5 == 0 ? 1 : 0);
                    return is_behind && is_before && f.code < tile.stored[p] && f.code >= intervals.least &&
                           f.code < intervals.end;
                });
                const auto least =
                    std::ranges::min_element(inside, {}, [&](std::uint32_t k) { return tile.given.living[k].code; });
                const auto expected = least == inside.end() ? std::vector<std::uint32_t>{} : std::vector{*least};
                wrong += found[p] == expected ? 0 : 1;
            }
            CHECK(wrong == 0);
            for (auto& entry : tile.entries) entry = static_cast<std::uint32_t>(random_int(random, 0, codes));
        }
    }
}

TEST_CASE("by a compared depth the nearest code behind a bound is visited however much both depths differ") {
    Random random{2322};
    for (int round = 0; round < 120; ++round) {
        Tile tile{random, {}};
        DepthCompare compare{.format = DepthFormat::d24, .has_reference = true};
        if (round % 3 == 1) compare.epsilon.ulps = 2;
        if (round % 3 == 2) compare.quantizes = false;
        KeyIntervals intervals;
        if (round % 4 == 0) intervals.far[0] = codes_in(tile.more, false);
        if (round % 5 == 0) intervals.least = 3;
        FragmentWaves waves;
        find_nearest_behind(tile.sorted, tile.given.record, compare, intervals, tile.entries.data(),
                            {tile.stored.data(), false}, waves);
        auto found = visited(waves);
        std::uint64_t wrong = 0;
        for (std::uint32_t p = 0; p < pixels; ++p) {
            const auto inside = tile.indices(p, [&](const Fragment& f) {
                return compare.is_behind(f.reference_code, f.reference_z, tile.entries[p]) && f.code < tile.stored[p] &&
                       (round % 4 != 0 || f.code < tile.more[p]) && f.code >= intervals.least;
            });
            const auto least =
                std::ranges::min_element(inside, {}, [&](std::uint32_t k) { return tile.given.living[k].code; });
            const auto expected = least == inside.end() ? std::vector<std::uint32_t>{} : std::vector{*least};
            wrong += found[p] == expected ? 0 : 1;
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("an unquantised compared depth is tested however far it is from the fragment's code") {
    GivenRecord given;
    given.record.start(all_values, std::uint64_t{1} << 20);
    const auto batch = std::make_unique<rasterizer::FragmentBatch>();
    batch->count = 1;
    batch->pixel[0] = batch->primitive[0] = 0;
    batch->code[0] = batch->reference_code[0] = 1000;
    batch->reference_z[0] = 5000;  // in the buffer's units
    given.record.append(*batch, rasterizer::Lanes<std::uint32_t>{~0u});
    given.record.finish();
    SortedLists sorted;
    REQUIRE(sorted.sort(given.record, {}, 1, std::uint64_t{1} << 20));
    const std::uint32_t behind = 3000, stored = 0xffffff;
    for (const bool quantizes : {false, true}) {
        FragmentWaves waves;
        find_nearest_behind(sorted, given.record,
                            {.format = DepthFormat::d24, .has_reference = true, .quantizes = quantizes}, {}, &behind,
                            {&stored, false}, waves);
        CHECK(visited(waves).size() == (quantizes ? 0u : 1u));
    }
}

TEST_CASE("all fragments of an interval are visited in submission order unless they are more than half") {
    Random random{2323};
    int kept = 0, declined = 0;
    for (int round = 0; round < 120; ++round) {
        Tile tile{random, {}};
        if (round % 5 == 0) std::ranges::fill(tile.entries, 1u);  // nearly all entries
        if (round % 5 == 0) std::ranges::fill(tile.more, codes - 1u);
        const KeyIntervals intervals{.near = codes_in(tile.entries, true),
                                     .far = {codes_in(tile.more, round % 2 == 0), {}}};
        FragmentWaves waves;
        const bool finds = find_intervals(tile.sorted, intervals, waves);
        std::uint64_t inside = 0, wrong = 0;
        auto found = visited(waves);
        for (std::uint32_t p = 0; p < pixels; ++p) {
            const auto expected = tile.indices(p, [&](const Fragment& f) {
                return f.code >= tile.entries[p] && f.code < tile.more[p] + (round % 2 == 0 ? 1 : 0);
            });
            inside += expected.size();
            wrong += found[p] == (finds ? expected : std::vector<std::uint32_t>{}) ? 0 : 1;
        }
        CHECK(wrong == 0);
        CHECK(finds == (2 * inside <= tile.given.living.size()));
        ++(finds ? kept : declined);
    }
    CHECK(kept > 10);
    CHECK(declined > 2);
}

TEST_CASE("bounds that are binary32 depths or values of codes omit no fragment") {
    Random random{2324};
    constexpr auto value = [](std::uint32_t code) {
        return static_cast<float>(rasterizer::depth_value(code, DepthFormat::d24));
    };
    std::uint64_t wrong = 0, wide = 0;
    for (int round = 0; round < 40; ++round) {
        Tile tile{random, {}};
        std::vector<std::uint32_t> values(pixels);
        for (std::uint32_t p = 0; p < pixels; ++p) {
            const float odd[]{-1.0f, 2.0f, 0.0f, std::numeric_limits<float>::quiet_NaN(), 0x1p-24f * 2.6f};
            const int which = random_int(random, 0, 9);
            values[p] = std::bit_cast<std::uint32_t>(which < 5 ? odd[which] : value(tile.entries[p]));
        }
        const BoundPlane bound{values.data(), false, BoundPlane::Contents::values, DepthFormat::d24};
        for (std::uint32_t p = 0; p < pixels; ++p)
            for (std::uint32_t code = 0; code < codes; ++code) {
                const auto stored = std::bit_cast<float>(values[p]);
                wrong += value(code) > stored && code < bound.first_behind(p) ? 1 : 0;
                wrong += value(code) < stored && code >= bound.end_before(p) ? 1 : 0;
                wide += value(code) < stored && code >= bound.first_behind(p) ? 1 : 0;
            }
        std::vector<std::uint32_t> depths(pixels);
        for (auto& depth : depths) depth = std::bit_cast<std::uint32_t>(random_float(random, -1, 1));
        const BoundPlane depth{depths.data(), false, BoundPlane::Contents::depths, DepthFormat::d32f};
        for (std::uint32_t p = 0; p < pixels; ++p)
            wrong += depth.key(p) == ordered_code(std::bit_cast<float>(depths[p])) ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(wide < 40 * pixels);
}

namespace {

struct Ends {
    std::set<std::uint32_t> needed, may;  // fragments that must be visited, and all that may be visited
};

// All fragments at the ends must be visited, and of those in between one with the least and one with the greatest key.
// If all fragments inside are at the near end and `one_outside`, exactly one fragment from outside is visited as well.
template <class IsNear, class IsFar, class IsInside>
Ends ends_at(const Tile& tile, std::uint32_t p, bool one_outside, const IsInside& is_inside, const IsNear& is_near,
             const IsFar& is_far) {
    Ends ends;
    std::vector<std::uint32_t> between, outside;
    bool is_near_alone = true;
    for (const std::uint32_t index : tile.indices(p, [](const Fragment&) { return true; })) {
        const Fragment& f = tile.given.living[index];
        if (!is_inside(f)) {
            outside.push_back(index);
        } else if (is_near(f) || is_far(f)) {
            is_near_alone &= is_near(f);
            ends.needed.insert(index);
        } else {
            between.push_back(index);
        }
    }
    const auto by_z = [&](std::uint32_t k) { return ordered_code(tile.given.living[k].shader_z); };
    if (!between.empty()) {
        ends.needed.insert(*std::ranges::min_element(between, {}, by_z));
        // the last one with the greatest key
        ends.needed.insert(*std::ranges::max_element(between, std::ranges::less_equal{}, by_z));
    }
    if (one_outside && between.empty() && is_near_alone) ends.may.insert(outside.begin(), outside.end());
    return ends;
}

bool is_right(const std::vector<std::uint32_t>& found, const Ends& ends) {
    const std::set<std::uint32_t> all{found.begin(), found.end()};
    if (all.size() != found.size() || !std::ranges::includes(all, ends.needed)) return false;
    return all.size() == ends.needed.size() + (ends.may.empty() ? 0 : 1) &&
           std::ranges::all_of(all, [&](std::uint32_t k) { return ends.needed.contains(k) || ends.may.contains(k); });
}

// Ranges of shader depths, some of them empty, and opaque surfaces.
struct Ranges {
    std::vector<std::uint32_t> near = std::vector<std::uint32_t>(pixels), far = near, surface = near;
    Ranges(Random& random, const Tile& tile) {
        for (std::uint32_t p = 0; p < pixels; ++p) {
            const auto all = tile.indices(p, [](const Fragment&) { return true; });
            const auto any = [&] {
                return all.empty() ? 0.5f : tile.given.living[all[random() % all.size()]].shader_z;
            };
            near[p] = std::bit_cast<std::uint32_t>(p % 16 == 5 ? std::numeric_limits<float>::quiet_NaN() : -any());
            far[p] = std::bit_cast<std::uint32_t>(any());
            surface[p] = std::bit_cast<std::uint32_t>(random_int(random, 0, 2) == 0 ? any() : 2.0f);
        }
    }
    [[nodiscard]] KeyIntervals intervals() const {
        return {.far = {BoundPlane{surface.data(), false, BoundPlane::Contents::depths, DepthFormat::d32f}, {}},
                .range_near = near.data(),
                .range_far = far.data()};
    }
};

}  // namespace

TEST_CASE("for a range of depths both ends and their neighbours are visited") {
    Random random{2325};
    std::uint64_t wrong = 0, alone = 0;
    for (int round = 0; round < 60; ++round) {
        Tile tile{random, {.key = DepthKey::shader_z}};
        const Ranges ranges{random, tile};
        FragmentWaves waves;
        find_ends(tile.sorted, ranges.intervals(), round % 2 == 0, waves);
        auto found = visited(waves);
        for (std::uint32_t p = 0; p < pixels; ++p) {
            const float near = -std::bit_cast<float>(ranges.near[p]), far = std::bit_cast<float>(ranges.far[p]);
            const auto is_inside = [&](const Fragment& f) {
                return f.shader_z >= near && f.shader_z <= far && f.shader_z < std::bit_cast<float>(ranges.surface[p]);
            };
            float first = 2, last = -2;
            for (const std::uint32_t k : tile.indices(p, is_inside)) {
                first = std::min(first, tile.given.living[k].shader_z);
                last = std::max(last, tile.given.living[k].shader_z);
            }
            const Ends ends = ends_at(
                tile, p, round % 2 == 0, is_inside, [&](const Fragment& f) { return f.shader_z == first; },
                [&](const Fragment& f) { return f.shader_z == last; });
            wrong += is_right(found[p], ends) ? 0 : 1;
            for (const float end : {first, last}) {  // whose target keeps the last value
                std::vector<std::uint32_t> tied = found[p];
                std::erase_if(tied, [&](std::uint32_t k) { return tile.given.living[k].shader_z != end; });
                wrong += std::ranges::is_sorted(tied) ? 0 : 1;
            }
            alone += ends.may.empty() ? 0 : 1;
        }
    }
    CHECK(wrong == 0);
    CHECK(alone > 50);
}

TEST_CASE("a group has all fragments of an interval's first depth in submission order, and the first one behind them") {
    Random random{2327};
    std::uint64_t wrong = 0, tied = 0, behind = 0;
    for (int round = 0; round < 60; ++round) {
        Tile tile{random, {.key = DepthKey::shader_z}};
        const Ranges ranges{random, tile};
        KeyIntervals intervals = ranges.intervals();
        intervals.range_far = nullptr;
        if (round % 4 == 0) intervals.range_near = nullptr;
        for (int pass = 0; pass < 2; ++pass) {  // the second search starts where the first one found its group
            FragmentWaves waves;
            find_groups(tile.sorted, intervals, waves);
            auto found = visited(waves);
            for (std::uint32_t p = 0; p < pixels; ++p) {
                const float near = round % 4 == 0 ? -2.0f : -std::bit_cast<float>(ranges.near[p]);
                auto inside = tile.indices(p, [&](const Fragment& f) {
                    return f.shader_z >= near && f.shader_z < std::bit_cast<float>(ranges.surface[p]);
                });
                const auto z = [&](std::uint32_t k) { return tile.given.living[k].shader_z; };
                std::ranges::stable_sort(inside, {}, z);
                std::size_t end = 0;
                while (end < inside.size() && z(inside[end]) == z(inside[0])) ++end;
                tied += end > 1 ? 1 : 0;
                behind += end < inside.size() ? 1 : 0;
                inside.resize(std::min(inside.size(), end + 1));
                wrong += found[p] == inside ? 0 : 1;
            }
        }
    }
    CHECK(wrong == 0);
    CHECK(tied > 50);
    CHECK(behind > 50);
}

TEST_CASE("for a range of compared depths the ends are those that reach it within an epsilon") {
    Random random{2326};
    std::uint64_t wrong = 0;
    for (int round = 0; round < 60; ++round) {
        Tile tile{random, {.key = DepthKey::shader_z}};
        const DepthCompare compare{.format = DepthFormat::d32f,
                                   .epsilon = {.absolute = round % 2 == 0 ? 0.125 : 0.0},
                                   .has_reference = true,
                                   .quantizes = round % 3 != 0};
        const Ranges ranges{random, tile};
        FragmentWaves waves;
        find_ends_compared(tile.sorted, tile.given.record, compare, ranges.intervals(), round % 4 < 2, waves);
        auto found = visited(waves);
        for (std::uint32_t p = 0; p < pixels; ++p) {
            const double near = -std::bit_cast<float>(ranges.near[p]), far = std::bit_cast<float>(ranges.far[p]);
            const auto reaches = [&](double least, double most) { return !compare.exceeds(least, most); };
            const auto z = [&](const Fragment& f) { return compare.own(f.reference_z); };
            const Ends ends = ends_at(
                tile, p, round % 4 < 2,
                [&](const Fragment& f) {
                    return near <= far && reaches(near, z(f)) && reaches(z(f), far) &&
                           f.shader_z < std::bit_cast<float>(ranges.surface[p]);
                },
                [&](const Fragment& f) { return reaches(z(f), near); },
                [&](const Fragment& f) { return reaches(far, z(f)); });
            wrong += is_right(found[p], ends) ? 0 : 1;
            wrong += std::ranges::is_sorted(found[p]) ? 0 : 1;
        }
    }
    CHECK(wrong == 0);
}

}  // namespace strata::testing::find_fragments_model
