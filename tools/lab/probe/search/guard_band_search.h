// tools/lab/probe/search/guard_band_search.h - finds the guard band that explains a device's triangles best, with
// limited work.
//
// Rule     All values between the first triangle that is clipped and the one before are tried, in descending order,
//          then those below down to three quarters; there, beyond 131,072 pixels, about every second. A value is drawn
//          on the scenes of guard bands first, and on the others only if it explains more of those than the best so
//          far.
// Numbers  A search tries fewer than 60,000 values. All searches of one inference draw at most `most_band_scenes`
//          scenes, plus those of one value: the best value so far is then the result.
// Tests    tests/tools/lab/probe/guard_band_search_test.cpp
#pragma once
#include "tools/lab/probe/search/scores.h"

namespace strata::probe {

// About ten seconds.
inline constexpr std::size_t most_band_scenes = 60'000;

struct BandSearch {
    Scores& scores;
    // Number of scenes that may still be drawn, over all searches.
    std::size_t scenes_left = most_band_scenes;

    // Returns the profile's own band if none is better on these scenes, or if the number of scenes is used up.
    [[nodiscard]] int best(const DeviceProfile& profile, const Numbers& numbers, Part part);

  private:
    // Reaches of two triangles of the kit, in pixels: the largest that is not clipped, and the next.
    struct Bracket {
        int whole, cut;
    };
    [[nodiscard]] Bracket bracket(DeviceProfile profile) const;
};

}  // namespace strata::probe
