// tools/oracle/verdict/edits.h - what a wrong picture composited at each of its pixels: the mistakes that give their
// values.
//
// Rule     Mistakes are held against pixels under the verdict's hypothesis, the findings first, then the leads; a pixel
//          belongs to the first that gives its value and changes its layers. Of one pixel all are told that make other
//          layers of it, and where no rule gives its value, which of its layers, in which order, would.
// Tests    tests/tools/oracle/verdict/edits_test.cpp
#pragma once
#include <optional>

#include "tools/oracle/verdict/composite.h"
#include "tools/oracle/verdict/sample.h"
#include "tools/oracle/verdict/verdict.h"

namespace strata::oracle::verdict {

struct EditCount {
    std::vector<Rule> rules{};
    std::uint64_t pixels = 0;
};
struct EditMap {
    static constexpr std::uint8_t right = 0, unexplained = 255;  // every other number n stands for edits[n - 1]
    int width = 0, height = 0;
    std::vector<EditCount> edits{};
    std::uint64_t not_explained = 0;
    std::vector<std::uint8_t> of_pixel{};  // row-major from the top
};
[[nodiscard]] EditMap edit_map(const SceneFragments& scene, const Colors& candidate, const Verdict& verdict);

struct PixelEdit {
    std::vector<Rule> rules{};          // empty: of no rule
    std::vector<std::size_t> chosen{};  // of no rule: numbers of the visible layers that are composited, near to far
    Reach reach{};
};
struct PixelEdits {
    SampledPixel pixel{};
    Hypothesis hypothesis{};
    Reach right{};
    bool is_right = false;
    std::vector<PixelEdit> edits{};
};
[[nodiscard]] PixelEdits edits_at(const SceneFragments& scene, const Colors& candidate, const Verdict& verdict, int x,
                                  int y);

[[nodiscard]] std::string to_text(const PixelEdits& edits, const Verdict& verdict, const pipeline::DrawList& list);
[[nodiscard]] std::string to_json(const PixelEdits& edits, const Verdict& verdict, const pipeline::DrawList& list);

}  // namespace strata::oracle::verdict
