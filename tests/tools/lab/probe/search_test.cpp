// Tests the search for a profile on pictures drawn by known profiles.
#include "tools/lab/probe/search/search.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/tools/lab/probe/round_trip.h"
#include "tools/lab/probe/kit/draw_item.h"
#include "tools/lab/probe/kit/kit.h"

using namespace strata;
using namespace strata::probe;

namespace {

// The profile with another value of the field, if a device can have it.
std::optional<DeviceProfile> turned(const DeviceProfile& profile, const ProfileField& f) {
    DeviceProfile other = profile;
    f.set(other, f.value(profile) == f.lowest ? f.highest : f.lowest);
    if (f.key == "raster.guard_band_px") f.set(other, 512 + f.value(profile) / 2);
    if (!is_valid(other)) return std::nullopt;
    return other;
}

}  // namespace

TEST_CASE("three random devices are inferred from their answers alone") {
    const std::vector<Item> unseen = unseen_scenes(100, 20);
    for (const int number : {2, 4, 6}) {
        const RoundTrip trip = round_trip(random_profile(number), unseen, YDirection::down);
        INFO("profile " << number << other_values_of(trip));
        CHECK(trip.is_equal());
        CHECK(trip.found.profile.origin == pipeline::Origin::lower_left);
        CHECK(trip.found.profile.raster.tie_rule == trip.truth.raster.tie_rule);
        CHECK(trip.drawn > 0);
        CHECK(trip.found.tally.equal == trip.found.tally.all);
    }
}

TEST_CASE("two random devices have no open field with another value that a picture shows") {
    const std::vector<Item> unseen = unseen_scenes(2200, 20);
    for (const int number : {150, 152}) {
        const RoundTrip trip = round_trip(random_profile(number), unseen, YDirection::up);
        INFO("profile " << number);
        CHECK(trip.open_but_visible == std::vector<std::string>{});
        CHECK(trip.found.tally.equal == trip.found.tally.all);
    }
}

TEST_CASE(
    "where a device draws is decided before what it draws so that the clip volume that covers its pixels is found") {
    // Clipped at the view volume, with the planes of unclipped triangles; no built-in profile does this.
    DeviceProfile device = *pipeline::find_profile("geforce8_dx101");
    device.raster.subpixel_bits = 4;
    device.origin = pipeline::Origin::lower_left;
    std::vector<Item> items;
    for (const Item& item : kit())
        if (item.name.starts_with("coverage.s") || item.name == "clip.sides" || item.name == "clip.all-d24")
            items.push_back(item);
    ProbePack pack = answer(device, items, {YDirection::down});
    DeviceProfile covers = device;
    covers.raster.clip = rasterizer::ClipVolume::view_volume;
    for (const Item& item : items) {
        Answer& own = *pack.answers[YDirection::down][item.name].answer;
        const Answer covered = *draw_item(covers, item, YDirection::down).answer;
        if (!item.depth) continue;
        const std::uint32_t cleared = rasterizer::max_code(*item.depth);
        for (std::size_t i = 0; i < own.depth->codes.size(); ++i) {
            if (own.depth->codes[i] != cleared && covered.depth->codes[i] != cleared) continue;
            own.depth->codes[i] = covered.depth->codes[i];
            for (std::size_t c = 4 * i; c < 4 * i + 4; ++c) own.color.codes[c] = covered.color.codes[c];
        }
    }
    const DeviceProfile found = covered_first({pack, items, YDirection::down}, device);
    CHECK(found.raster.clip != rasterizer::ClipVolume::guard_band);
    Difference sum;
    for (const Item& item : items)
        sum += difference(*pack.answers[YDirection::down][item.name].answer,
                          *draw_item(found, item, YDirection::down).answer);
    CHECK(sum.coverage == 0);
}

TEST_CASE("a field that is irrelevant or cannot change a scene changes no bit of it") {
    for (int number = 0; number < 8; ++number) {
        const DeviceProfile profile = random_profile(number);
        for (const Item& item : kit()) {
            if (item.width > 128 || item.name == "color.slivers") continue;  // only small scenes, for speed
            const Reply drawn = draw_item(profile, item, YDirection::down);
            for (const ProfileField* f : probed_fields()) {
                const std::optional<DeviceProfile> other = turned(profile, *f);
                if (!other) continue;
                // Skips a field that matters under either value: a value can enable other fields.
                if (can_change(f->key, item) && (matters(f->key, profile) || matters(f->key, *other))) continue;
                INFO("profile " << number << ", " << item.name << ", " << f->key);
                const Reply again = draw_item(*other, item, YDirection::down);
                CHECK(drawn.answer == again.answer);
            }
        }
    }
}
