// tools/oracle/verdict/opposite_edges.h - whether the pixels that are excused at edges show another coverage.
//
// Rule     The value of an excused pixel is reflected about the middle of what the given fragments allow. Another
//          coverage moves a pixel to one side: a fragment appears or is lost. Errors of another cause are excused
//          because colours may change by as much as within a sixteenth of a pixel, in either direction, so that the
//          reflected value is excused, too. Few pixels decide nothing: the verdict says "right, but for" them.
// Numbers  Pictures of rasterizers with other snapping (geforce3, llvmpipe, softpipe, swiftshader, on a teapot of
//          1024x1024 pixels): 48 to 75 % of the excused pixels are excused either way. Moment-based transparency,
//          which is off by a few codes at pixels with many layers: 98 to 100 %.
// Tests    tests/tools/oracle/verdict/opposite_edges_test.cpp
#pragma once
#include <cstdint>

#include "tools/oracle/search/account.h"

namespace strata::oracle::verdict {

class SceneFragments;
class Colors;

inline constexpr std::uint64_t fewest_excused_edges = 10;  // that decide something

struct ExcusedEdges {
    std::uint64_t all = 0, either_way = 0;  // either_way: the opposite error would be excused, too
    // True if nearly none of the pixels is evidence of another coverage.
    [[nodiscard]] bool show_no_coverage() const noexcept {
        return all >= fewest_excused_edges && 10 * either_way >= 9 * all;
    }
};

// `right`: the account that the picture is right by.
[[nodiscard]] ExcusedEdges excused_edges(const SceneFragments& scene, const Colors& candidate,
                                         const CheckedAccount& right);

}  // namespace strata::oracle::verdict
