// tools/oracle/verdict/exchanged_depths.h - whether layers of nearly equal depth are exchanged in one direction, as by
// a depth bias.
//
// Rule     Of neighbours at most `close_codes` apart a pixel may show that they are exchanged, or that they are not.
//          Surfaces are instances with one facing, or of one surface the triangles that are submitted earlier. Depths
//          of another precision exchange some of the pairs, in both directions. A bias of one surface exchanges all
//          pairs in which it is the nearer one, or all in which it is the farther one, and none of the others.
// Numbers  10 pixels or more in two pairs of triangles or more; 5 % exceptions: by chance, with half of the pairs
//          exchanged, 1 of 1000 pictures.
// Tests    tests/tools/oracle/verdict/exchanged_depths_test.cpp
#pragma once
#include <compare>
#include <cstdint>
#include <optional>

#include "tools/oracle/search/account.h"

namespace strata::oracle::verdict {

class SceneFragments;
class Colors;

// What distinguishes the fragments of a pair: their instances, their facings, or else the order of their triangles.
struct PairedSurface {
    std::uint32_t instance = 0;
    bool is_front_facing = false, is_later = false;
    friend auto operator<=>(const PairedSurface&, const PairedSurface&) = default;
};

struct ExchangedDepths {
    std::uint64_t pairs = 0;            // that are exchanged, at all pixels
    PairedSurface nearer{}, farther{};  // by the given depths
};

// The surfaces whose pairs are exchanged at the most pixels, if the exchanges have a direction. `right`: the account
// that the picture is right by.
[[nodiscard]] std::optional<ExchangedDepths> exchanged_depths(const SceneFragments& scene, const Colors& candidate,
                                                              const CheckedAccount& right);

}  // namespace strata::oracle::verdict
