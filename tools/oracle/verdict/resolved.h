// tools/oracle/verdict/resolved.h - decides whether a picture with several samples per pixel, which were resolved by
// their mean, is right apart from rounding.
//
// Rule     A pixel is right if its value is in the mean of the intervals that the right structure has at its samples,
//          with half a code of the resolve. One hypothesis and one rule for equal depths must hold for the whole
//          picture. Samples are stored in the picture's format or in floats. If all colours are right, alpha is
//          compared with the mean of what the layers of the samples leave, with one code per blend. No mistakes are
//          searched: diagnose names them.
// Source   GL 4.6 18.3.1: the resolve's filter is not specified; the mean is what profiles have (ResolveRule).
// Tests    tests/tools/oracle/verdict/resolved_test.cpp
#pragma once
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "tools/oracle/fragments/form.h"
#include "tools/oracle/fragments/sample.h"
#include "tools/oracle/rounding/hypothesis.h"
#include "tools/oracle/search/alpha.h"

namespace strata::oracle::verdict {

struct ResolvedVerdict {
    Hypothesis hypothesis{};  // of the samples; the one with the fewest wrong pixels, then with the narrowest intervals
    int width = 0;            // of the picture
    std::uint64_t pixels = 0, at_edges = 0;     // at_edges: pixels whose samples have different fragments
    std::vector<std::uint32_t> wrong_pixels{};  // row-major, ascending
    std::uint64_t wrong_at_edges = 0;
    double possible = 0;     // the widest interval, in codes of the picture (floats: 1/255)
    AlphaChecked alpha{};    // no mistake is named
    std::string equal_to{};  // the algorithm whose picture this is; "": none, or not asked
    // Of judge_samples (judge/samples_verdict.h), empty else: how the picture was read, what it was judged by ("the
    // rules of profile llvmpipe with --origin lower-left"), and a line of text if these are others than those given.
    Formed form{};
    std::string by{}, description{};
    [[nodiscard]] bool is_right() const noexcept { return wrong_pixels.empty() && alpha.state != AlphaState::wrong; }
};

// The fragments of every sample, all kept in memory.
using Samples = std::vector<std::unique_ptr<SceneFragments>>;

[[nodiscard]] ResolvedVerdict judge_resolved(const Samples& samples, const Colors& candidate);
// The same if the picture is right, in less time if it is not. `doubtful`: pixels that are compared first, by number.
// `within`: the part of the picture that the samples hold and that is compared.
[[nodiscard]] std::optional<ResolvedVerdict> right_resolved(const Samples& samples, const Colors& candidate,
                                                            const std::vector<std::uint32_t>& doubtful,
                                                            const std::optional<rasterizer::Rect>& within = {});

// The pixels that are wrong, by their colours or else by their alpha.
[[nodiscard]] const std::vector<std::uint32_t>& wrong_pixels(const ResolvedVerdict& verdict);

[[nodiscard]] std::string to_text(const ResolvedVerdict& verdict);
[[nodiscard]] nlohmann::ordered_json json_of(const ResolvedVerdict& verdict);

}  // namespace strata::oracle::verdict
