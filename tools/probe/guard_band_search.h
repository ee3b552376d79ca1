// tools/probe/guard_band_search.h - the guard band that explains a device's triangles best, within a bound of work.
//
// Rule     All values between the first triangle that is seen to be cut and the one before are tried, downwards, then
//          those below to three quarters, there beyond 131,072 pixels every second or so. A value is drawn on the
//          scenes of guard bands first, and on the others only if it explains more of those than the best so far.
// Numbers  A search tries fewer than 60,000 values. All searches of one inference draw at most `most_band_scenes`
//          scenes, and those of one value more: what is best by then stays.
// Tests    tests/tools/probe/guard_band_search_test.cpp
#pragma once
#include "tools/probe/scores.h"

namespace strata::probe {

// Some ten seconds.
inline constexpr std::size_t most_band_scenes = 60'000;

struct BandSearch {
    Scores& scores;
    // Scenes that may still be drawn, over all searches.
    std::size_t scenes_left = most_band_scenes;

    // Returns the profile's own band if none is better on these scenes, or if no scene is left.
    [[nodiscard]] int best(const DeviceProfile& profile, const Numbers& numbers, Part part);

  private:
    // Reaches of two triangles of the kit, in pixels: the farthest that is whole, and the next.
    struct Bracket {
        int whole, cut;
    };
    [[nodiscard]] Bracket bracket(DeviceProfile profile) const;
};

}  // namespace strata::probe
