// Tests the search for a guard band against the device's own value, with a count of the scenes that are drawn.
#include "tools/lab/probe/search/guard_band_search.h"

#include <catch2/catch.hpp>

#include "tools/lab/probe/kit/draw_item.h"
#include "tools/lab/probe/kit/kit.h"

using namespace strata;
using namespace strata::probe;

namespace {

DeviceProfile with_band(int pixels) {
    DeviceProfile profile = *pipeline::find_profile("geforce8_dx101");
    profile.raster.guard_band_px = pixels;
    return profile;
}

std::vector<Item> guard_band_scenes() {
    std::vector<Item> items = kit();
    std::erase_if(items, [](const Item& item) { return !item.name.starts_with("clip.guard-band"); });
    return items;
}

// Changes the depths in all rows of triangles that reach farther out than `pixels`, so that no profile explains them.
void spoil_beyond(ProbePack& pack, int pixels) {
    const std::vector<int> reaches = guard_reaches();
    for (auto& [name, reply] : pack.answers[YDirection::down])
        for (std::size_t i = 0; i < reply.answer->depth->codes.size(); ++i)
            if (reaches[i / 8] > pixels) reply.answer->depth->codes[i] ^= 0x55;
}

}  // namespace

TEST_CASE("a guard band is found exactly from the triangles that it clips") {
    const std::vector<Item> items = guard_band_scenes();
    for (const int band : {600, 811, 200'001}) {
        const ProbePack pack = answer(with_band(band), items, {YDirection::down});
        const KitComparison device{pack, items, YDirection::down};
        Scores scores{device};
        BandSearch search{scores};
        CHECK(search.best(with_band(16384), device.items_of({""}), Part::both) == band);
        CHECK(search.scenes_left ==
              most_band_scenes - scores.drawn() + items.size());  // excludes the scenes drawn before the search
    }
}

TEST_CASE("the search for a guard band that nothing explains ends when its scenes are drawn") {
    const std::vector<Item> items = guard_band_scenes();
    ProbePack pack = answer(with_band(5000), items, {YDirection::down});
    spoil_beyond(pack, 5000);
    const KitComparison device{pack, items, YDirection::down};
    Scores scores{device};
    BandSearch search{scores, 100};
    const Numbers all = device.items_of({""});
    const int found = search.best(with_band(16384), all, Part::both);
    CHECK(search.scenes_left == 0);
    CHECK(scores.drawn() >= 100);
    CHECK(scores.drawn() <= 100 + 2 * items.size());  // the scenes of the start and of the last value
    const std::size_t drawn = scores.drawn();
    CHECK(search.best(with_band(found), all, Part::both) == found);
    CHECK(scores.drawn() <= drawn + items.size());
}
