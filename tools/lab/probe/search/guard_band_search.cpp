#include "tools/lab/probe/search/guard_band_search.h"

#include <algorithm>

#include "tools/lab/probe/kit/kit.h"

namespace strata::probe {

// The smallest reach (kit.h) whose triangle the device drew differently than without a guard band, and the one before:
// the band is between them. Triangles that are not clipped agree in every pixel; a clipped one may, too, by chance, so
// the band may be smaller.
BandSearch::Bracket BandSearch::bracket(DeviceProfile profile) const {
    const KitComparison& device = scores.device();
    const std::vector<int> reaches = guard_reaches();
    std::size_t first = reaches.size();
    profile.raster.guard_band_px = field("raster.guard_band_px").highest;
    for (const std::size_t n : device.items_of({"clip.guard-band"})) {
        const std::vector<bool> equal = device.equal(device.drawn(profile, n), n);
        const auto width = static_cast<std::size_t>(device.item(n).width);
        for (std::size_t place = 0; place < equal.size(); ++place) {
            const std::size_t row = place / width % reaches.size();
            const std::size_t reach = device.orientation() == YDirection::down ? row : reaches.size() - 1 - row;
            if (!equal[place]) first = std::min(first, reach);
        }
    }
    const int whole = first > 0 ? reaches[first - 1] : 0;
    return {whole, first < reaches.size() ? reaches[first] : field("raster.guard_band_px").highest};
}

// Only the correct guard band explains all triangles that it clips, and a value close to it explains no more than a
// distant one, so all values are tried.
int BandSearch::best(const DeviceProfile& profile, const Numbers& numbers, Part part) {
    Numbers bands = scores.device().items_of({"clip.guard-band"});
    if (bands.empty()) bands = numbers;
    int found = profile.raster.guard_band_px;
    std::uint64_t points = scores.points(profile, numbers, part), sifted = scores.points(profile, bands, part);
    const auto [whole, cut] = bracket(profile);
    const int first = std::max(512, cut - cut / 4);
    const std::size_t before = scores.drawn(), most = before + scenes_left;
    const std::uint64_t perfect = scores.most(numbers, part);
    const auto step = [whole = whole](int value) { return value > whole ? 1 : 1 + value / 131'072; };
    for (int value = cut; value >= first; value -= step(value)) {
        if (scores.drawn() >= most || points == perfect) break;
        DeviceProfile tried = profile;
        tried.raster.guard_band_px = value;
        const std::uint64_t of_bands = scores.points(tried, bands, part, sifted);
        if (of_bands <= sifted) continue;
        const std::uint64_t of_all = scores.points(tried, numbers, part, points);
        if (of_all <= points) continue;
        sifted = of_bands;
        points = of_all;
        found = value;
    }
    scenes_left -= std::min(scenes_left, scores.drawn() - before);
    return found;
}

}  // namespace strata::probe
