// tools/oracle/verdict/match.h - does a structure under a hypothesis reach a candidate's pixels: one, some, or all of a
// picture.
//
// Rule     Pixels whose fragments lie at one depth are tried by every rule for ties; the picture has to keep to one of
//          them.
// Tests    tests/tools/oracle/verdict/verdict_test.cpp
#pragma once
#include <optional>

#include "tools/oracle/verdict/account.h"
#include "tools/oracle/verdict/sample.h"
#include "tools/oracle/verdict/structure.h"

namespace strata::oracle::verdict {

using TieMask = std::uint32_t;  // bit n: ties_number(n) holds; bit ties_count: TieRule::other does
inline constexpr TieMask all_ties = (2u << ties_count) - 1;
struct TiesFound {
    TieMask mask = 0;
    Ties ties{};            // the first that holds
    PixelList list{};       // what covers the pixel: at an edge perhaps not what was given
    bool at_edge = false;   // as on a rasterizer that snaps or breaks ties otherwise: covered otherwise, or ...
    bool is_moved = false;  // colours off by their spread
};

// Which rules for ties bring the pixel to the candidate's value; all, where it has no ties.
[[nodiscard]] TiesFound ties_that_hold(const Compositor& compositor, std::span<const Rule> rules, const PixelList& list,
                                       const std::array<double, 4>& value, StackMaker& maker);

// The structures that a pixel of a sample may have: one for each rule for ties that makes a difference there.
struct StackedPixel {
    std::vector<Stack> stacks{};
    std::size_t given = 0;  // so many of them by what covers the pixel as given; the others as TiesFound::at_edge
    std::array<double, 4> value{};  // the candidate's
};
[[nodiscard]] StackedPixel stacked(std::span<const Rule> rules, const SampledPixel& pixel, StackMaker& maker);
// The first of the pixel's structures that reaches its value; null if none does.
[[nodiscard]] const Stack* reaching(const Compositor& compositor, const StackedPixel& pixel, Steps& steps);
[[nodiscard]] bool is_as_given(const StackedPixel& pixel, const Stack& found) noexcept;

// The hypothesis that tells the sample in the fewest bits (pricing.h); of `none`, one that holds for all of it.
enum class Wrong : std::uint8_t { some, none };
[[nodiscard]] std::optional<Hypothesis> best_of(const Families& all, std::span<const Rule> rules, const Sample& sample,
                                                Wrong allowed, const std::optional<Hypothesis>& likely = {});

// Those that leave less open than `wide` on the right structure of the sample.
[[nodiscard]] Families narrower(const Families& all, const Hypothesis& wide, const Sample& sample);

// `examples` gets some of the pixels that are wrong or need another rasterizer. Of `none` an account that is wrong is
// looked at no further than it takes to know that.
[[nodiscard]] Checked check_all(const SceneFragments& scene, const Colors& candidate, const Account& account,
                                Wrong allowed, Sample& examples);

// The best account of the whole picture with these rules, if one holds for every pixel: under `likely`, if that holds.
// Pixels that speak against one are added to the sample.
[[nodiscard]] std::optional<Checked> account_for(const Families& all, const std::vector<Rule>& rules,
                                                 const SceneFragments& scene, const Colors& candidate, Sample& sample,
                                                 const std::optional<Hypothesis>& likely = {});

}  // namespace strata::oracle::verdict
