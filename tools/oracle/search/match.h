// tools/oracle/search/match.h - tests whether a structure under a hypothesis reaches the values of a candidate: at one
// pixel, in a sample, or in the whole picture.
//
// Rule     If fragments of a pixel have equal depths, every rule for ties is tried; one rule must hold for the whole
//          picture.
// Tests    tests/tools/oracle/verdict/verdict_test.cpp
#pragma once
#include <limits>
#include <optional>

#include "tools/oracle/fragments/sample.h"
#include "tools/oracle/rules/structure.h"
#include "tools/oracle/search/account.h"

namespace strata::oracle::verdict {

using TieMask = std::uint32_t;  // bit n: ties_number(n) holds; bit ties_count: TieHandling::other holds
inline constexpr TieMask all_ties = (2u << ties_count) - 1;
struct MatchingTies {
    TieMask mask = 0;
    Ties ties{};            // the first rule that holds
    PixelList list{};       // the fragments that were used: at an edge possibly not the given ones
    bool at_edge = false;   // needs a rasterizer with other snapping or another tie rule: with other coverage, or ...
    bool is_moved = false;  // with colours changed by up to their spreads
    bool has_close_depths = false;  // at_edge, but depths within two codes alone are ordered or merged otherwise
};

// The rules for ties under which the pixel has the candidate's value; all rules if it has no ties.
[[nodiscard]] MatchingTies matching_ties(const Compositor& compositor, std::span<const Rule> rules,
                                         const PixelList& list, const std::array<double, 4>& value, StackMaker& maker);

// The structures that a sampled pixel may have: one per rule for ties with a different result there.
struct StackedPixel {
    std::vector<Stack> stacks{};
    std::size_t given = 0;  // number of structures with the given coverage; the others need MatchingTies::at_edge
    std::array<double, 4> value{};  // the candidate's
};
[[nodiscard]] StackedPixel stacked(std::span<const Rule> rules, const SampledPixel& pixel, StackMaker& maker);
// The first structure of the pixel that reaches its value; null if there is none.
[[nodiscard]] const Stack* reaching(const Compositor& compositor, const StackedPixel& pixel, Steps& steps);
// The same for a pixel that many hypotheses are asked about.
struct ReachedStack {
    const Stack* stack = nullptr;  // null: none
    ReachableColor reach{};
};
class AskedPixel {
  public:
    explicit AskedPixel(const StackedPixel& pixel) : pixel_{&pixel}, known_(pixel.stacks.size()) { ask_all(); }
    [[nodiscard]] const StackedPixel& pixel() const noexcept { return *pixel_; }
    [[nodiscard]] ReachedStack reached(const Compositor& compositor, Steps& steps);
    // Forgets structures before the first that this hypothesis reaches, as it includes all that are asked next.
    [[nodiscard]] ReachedStack narrowed(const Compositor& widest, Steps& steps);

  private:
    void ask_all();

    const StackedPixel* pixel_;
    std::vector<KnownEnds> known_;
    std::vector<std::uint32_t> asked_{};
};
[[nodiscard]] bool is_as_given(const StackedPixel& pixel, const Stack& found) noexcept;

// The hypothesis that describes the sample in the fewest bits (pricing.h); with Wrong::none it must hold for every
// pixel.
enum class WrongPixels : std::uint8_t { some, none };
[[nodiscard]] std::optional<Hypothesis> best_of(const Families& all, std::span<const Rule> rules, const Sample& sample,
                                                WrongPixels allowed, const std::optional<Hypothesis>& likely = {});

// Of these hypotheses, those that hold for every pixel of the sample under the right structure.
[[nodiscard]] Families holding(const Families& all, const Sample& sample);

// The hypotheses whose intervals for the right structure of the sample are clearly narrower than those of `wide`.
[[nodiscard]] Families narrower(const Families& all, const Hypothesis& wide, const Sample& sample);

// Checks an account against the whole picture. `examples` receives some of the pixels that are wrong or need another
// rasterizer. With Wrong::none the check stops soon after the account has failed.
[[nodiscard]] CheckedAccount check_all(const SceneFragments& scene, const Colors& candidate, const Account& account,
                                       WrongPixels allowed, Sample& examples);

// The best account of the whole picture with these rules, if one holds for every pixel. `likely` is tried first. Pixels
// that contradict an account are added to the sample; after `most_rejected` hypotheses that are contradicted the rules
// are given up.
[[nodiscard]] std::optional<CheckedAccount> account_for(const Families& all, const std::vector<Rule>& rules,
                                                        const SceneFragments& scene, const Colors& candidate,
                                                        Sample& sample, const std::optional<Hypothesis>& likely = {},
                                                        int most_rejected = std::numeric_limits<int>::max());

}  // namespace strata::oracle::verdict
