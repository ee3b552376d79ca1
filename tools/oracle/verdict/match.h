// tools/oracle/verdict/match.h - does a structure under a hypothesis reach a candidate's pixels: one, some, or all of a picture.
//
// Rule     Pixels whose fragments lie at one depth are tried by every rule for ties; the picture has to keep to one of them.
// Tests    tests/tools/oracle/verdict/verdict_test.cpp
#pragma once
#include <optional>

#include "tools/oracle/verdict/sample.h"
#include "tools/oracle/verdict/structure.h"

namespace strata::oracle::verdict {

[[nodiscard]] bool holds(const Reach& reach, const std::array<double, 4>& value) noexcept;

using TieMask = std::uint32_t;  // bit n: ties_number(n) holds; bit ties_count: TieRule::other does
inline constexpr TieMask all_ties = (2u << ties_count) - 1;
struct TiesFound {
    TieMask mask = 0;
    Ties ties{};       // the first that holds
    PixelList list{};  // what covers the pixel: at an edge perhaps not what was given
    bool at_edge = false;
};

// A structure and how it is rounded; no rules: the right structure.
struct Account {
    std::vector<Rule> rules{};  // applied one after the other
    Hypothesis hypothesis{};
};

// Which rules for ties bring the pixel to the candidate's value; all, where it has no ties.
[[nodiscard]] TiesFound ties_that_hold(const Compositor& compositor, std::span<const Rule> rules, const PixelList& list,
                                       const std::array<double, 4>& value, StackMaker& maker);

// The structures that a pixel of a sample may have: one for each rule for ties that makes a difference there.
struct StackedPixel {
    std::vector<Stack> stacks{};
    std::size_t given = 0;          // so many of them by what covers the pixel as given; the others at an edge
    std::array<double, 4> value{};  // the candidate's
};
[[nodiscard]] StackedPixel stacked(std::span<const Rule> rules, const SampledPixel& pixel, StackMaker& maker);
// The first of the pixel's structures that reaches its value; null if none does.
[[nodiscard]] const Stack* reaching(const Compositor& compositor, const StackedPixel& pixel);

// The hypothesis that tells the sample in the fewest bits (pricing.h); of `none`, one that holds for all of it.
enum class Wrong : std::uint8_t { some, none };
[[nodiscard]] std::optional<Hypothesis> best_of(const Families& all, std::span<const Rule> rules, const Sample& sample,
                                                Wrong allowed, const std::optional<Hypothesis>& likely = {});

// All pixels of a picture by one account.
struct Checked {
    Account account{};
    std::uint64_t pixels = 0, covered = 0;  // covered: by a visible fragment
    Ties ties{};
    bool has_one_tie_rule = true;  // false: fragments at one depth come in an order that changes from pixel to pixel
    std::uint64_t tied = 0;        // pixels whose ties show
    std::uint64_t at_edges = 0;    // pixels that are covered as a rasterizer may that snaps otherwise
    std::uint64_t changed = 0;     // pixels whose structure is not the right one
    std::uint64_t undecided = 0;   // of these, pixels that the right structure may leave, too
    // Codes (of floats: parts of 255) by which a pixel is off the structure's exact result, and could be.
    double observed = 0, possible = 0;
    double bits = 0;                            // of pixels that are not wrong
    std::vector<std::uint32_t> wrong_pixels{};  // row-major, ascending
    [[nodiscard]] bool is_whole() const noexcept { return wrong_pixels.empty(); }
};
// `examples` gets some of the wrong pixels.
[[nodiscard]] Checked check_all(const SceneFragments& scene, const Colors& candidate, const Account& account,
                                Sample& examples);

// The best account of the whole picture with these rules, if one holds for every pixel: under `likely`, if that holds. Pixels that speak against one are
// added to the sample.
[[nodiscard]] std::optional<Checked> account_for(const Families& all, const std::vector<Rule>& rules,
                                                 const SceneFragments& scene, const Colors& candidate, Sample& sample,
                                                 const std::optional<Hypothesis>& likely = {});

}  // namespace strata::oracle::verdict
