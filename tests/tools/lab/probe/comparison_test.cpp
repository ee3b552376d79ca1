// Tests the scores of compared answers. The expected points and pixels are counted by hand from the codes.
#include "tools/lab/probe/search/comparison.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tools/lab/probe/kit/draw_item.h"
#include "tools/lab/probe/kit/kit.h"
#include "tools/lab/probe/search/infer.h"

using namespace strata;
using namespace strata::probe;

namespace {

// Two pixels of rgba8 and their depths.
Answer two_pixels(const std::vector<std::uint32_t>& colors, const std::vector<std::uint32_t>& depths) {
    Answer answer{.color = pipeline::Image{pipeline::Format::rgba8, 2, 1}};
    answer.color.codes.assign(colors.begin(), colors.end());
    if (depths.empty()) return answer;
    answer.depth = pipeline::Image{pipeline::Format::d24, 2, 1};
    answer.depth->codes.assign(depths.begin(), depths.end());
    return answer;
}

constexpr std::uint32_t far_away = 0xffffff;  // the clear value
const std::vector<std::uint32_t> plain{10, 20, 30, 255, 0, 0, 0, 0};

}  // namespace

TEST_CASE("an equal pixel has all points and another one loses a point per bit of its largest channel difference") {
    const Answer own = two_pixels(plain, {5000, far_away});
    // One pixel is off by 1 and by 4: 3 bits. A depth is off by 1,000: 10 bits.
    const Answer other = two_pixels({11, 16, 30, 255, 0, 0, 0, 0}, {6000, far_away});
    const Nearness near = nearness(own, other);
    CHECK(near.color == most_points + 32 - 3);
    CHECK(near.depth == most_points + 32 - 10);
    CHECK(near.coverage == 2 * most_points);
    CHECK(near.equal == 2);
    CHECK(near.places == 4);
    CHECK(most_points > 31);
}

TEST_CASE("a pixel is covered by its depth where there is a depth buffer and otherwise by its colour") {
    const Answer own = two_pixels(plain, {5000, far_away});
    const Difference with_depth = difference(own, two_pixels(plain, {far_away, 7}));
    CHECK(with_depth.coverage == 2);
    CHECK(with_depth.depth == 2);
    CHECK(with_depth.color == 0);
    const Difference without = difference(two_pixels(plain, {}), two_pixels({0, 0, 0, 0, 0, 0, 0, 0}, {}));
    CHECK(without.coverage == 1);
    CHECK(without.color == 1);
    CHECK(without.depth == 0);
    CHECK(nearness(own, two_pixels(plain, {5000, 7})).coverage == most_points);
}

TEST_CASE("NaNs of a float target agree with each other and with no number") {
    Answer own{.color = pipeline::Image{pipeline::Format::rgba32f, 2, 1}};
    Answer other = own;
    own.color.codes[0] = 0x7fc00000u;
    other.color.codes[0] = 0xff800001u;  // a NaN with other bits
    own.color.codes[4] = 0x7f800000u;    // infinity
    other.color.codes[4] = 0x7f800001u;
    CHECK(equal_values(own, other) == std::vector<bool>{true, false});
}

TEST_CASE("a value that explains fewer pixels but more covered ones is reported") {
    // Clipped at the view volume, with the planes of unclipped triangles: what geforce8_dx101 draws, except that
    // nothing is drawn where a device that clips draws nothing.
    DeviceProfile drawn = *pipeline::find_profile("geforce8_dx101");
    drawn.raster.subpixel_bits = 4;
    DeviceProfile covers = drawn;
    covers.raster.clip = rasterizer::ClipVolume::view_volume;
    const std::vector<Item>& items = kit();
    ProbePack pack = answer(drawn, items, {YDirection::down});
    std::uint64_t moved = 0;
    for (const Item& item : items) {
        if (!item.depth || !item.name.starts_with("clip.")) continue;
        Answer& own = *pack.answers[YDirection::down][item.name].answer;
        const Answer cut = *draw_item(covers, item, YDirection::down).answer;
        for (std::size_t i = 0; i < own.depth->codes.size(); ++i) {
            const std::uint32_t cleared = rasterizer::max_code(*item.depth);
            if ((own.depth->codes[i] == cleared) == (cut.depth->codes[i] == cleared)) continue;
            own.depth->codes[i] = cut.depth->codes[i];
            for (std::size_t c = 4 * i; c < 4 * i + 4; ++c) own.color.codes[c] = cut.color.codes[c];
            ++moved;
        }
    }
    REQUIRE(moved > 0);
    const Inference found = infer(pack, items, YDirection::down);
    const auto clip = std::ranges::find(found.fields, "raster.clip", &FieldFinding::key);
    REQUIRE(clip != found.fields.end());
    INFO(clip->value << ": " << clip->reason << ", moved " << moved);
    CHECK(clip->value.starts_with("view_volume"));  // the first of several: both cover the same pixels
    CHECK(clip->state == FieldState::broken);
    CHECK(clip->reason.starts_with("guard_band explains more pixels, but which are covered in "));
}
