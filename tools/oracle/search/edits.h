// tools/oracle/search/edits.h - finds the mistake that gives the value of each pixel of a wrong picture.
//
// Rule     Mistakes are tried at each pixel under the verdict's hypothesis, explanations first, then leads. A pixel is
//          assigned to the first one that gives its value. For a single pixel all mistakes that give different layers
//          are reported; if no rule gives its value, a subset and order of its layers that would.
// Tests    tests/tools/oracle/search/edits_test.cpp
#pragma once
#include <optional>
#include <string>

#include "tools/oracle/fragments/sample.h"
#include "tools/oracle/rounding/composite.h"
#include "tools/oracle/verdict/verdict.h"

namespace strata::oracle::verdict {

struct EditCount {
    std::vector<Rule> rules{};
    std::uint64_t pixels = 0;
};
struct EditMap {
    // Any other number n means edits[n - 1].
    static constexpr std::uint8_t right = 0, wrong_alpha = 254, unexplained = 255;
    int width = 0, height = 0;
    std::vector<EditCount> edits{};
    std::uint64_t not_explained = 0;
    std::vector<std::uint8_t> of_pixel{};  // row-major from the top
};
[[nodiscard]] EditMap edit_map(const SceneFragments& scene, const Colors& candidate, const Verdict& verdict);

struct PixelEdit {
    std::vector<Rule> rules{};  // empty: no rule fits
    // If no rule fits: indices of the visible layers that are composited, near to far.
    std::vector<std::size_t> chosen{};
    ReachableColor reach{};
};
struct PixelEdits {
    SampledPixel pixel{};
    Hypothesis hypothesis{};
    ReachableColor right{};
    bool is_right = false;          // alpha, too
    std::optional<double> alpha{};  // the candidate's, where the verdict tells something of alpha
    bool has_wrong_alpha = false;
    std::vector<PixelEdit> edits{};
    std::string
        surface{};  // if no edit gives the value, in words: the opaque surface that would; "": none, or not asked
};
[[nodiscard]] PixelEdits edits_at(const SceneFragments& scene, const Colors& candidate, const Verdict& verdict, int x,
                                  int y);

[[nodiscard]] std::string to_text(const PixelEdits& edits, const Verdict& verdict, const pipeline::DrawList& list);
[[nodiscard]] std::string to_json(const PixelEdits& edits, const Verdict& verdict, const pipeline::DrawList& list);

}  // namespace strata::oracle::verdict
