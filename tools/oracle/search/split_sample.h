// tools/oracle/search/split_sample.h - divides the pixels of a sample into right and wrong ones under the closest
// account; shared by search.cpp and leads.cpp.
#pragma once
#include <vector>

#include "tools/oracle/rules/rules.h"
#include "tools/oracle/search/match.h"

namespace strata::oracle::verdict {

using Rules = std::vector<Rule>;

struct SplitPixel {
    const SampledPixel* sampled = nullptr;
    StackedPixel right{};  // under the right structure
    // For each hypothesis of SplitSample::noted: how the right structure reaches the pixel.
    enum class Reached : std::uint8_t { no, as_given, at_edge };
    std::vector<Reached> reached{};
};

// The sampled pixels that are wrong under the closest account of the right structure, and the others.
struct SplitSample {
    std::vector<SplitPixel> wrong{}, right{};
    // True if no account of the right structure is known: then rules need not change the pixels of `wrong`.
    bool has_no_account = false;
    std::vector<Hypothesis> noted{};
};

[[nodiscard]] SplitSample split_by_account(const Sample& sample, const Hypothesis& closest);

// True if the pixel's structures are the right ones; the position of the division of a peel from both ends is not
// compared.
[[nodiscard]] bool is_unchanged(const StackedPixel& made, const SplitPixel& pixel);

[[nodiscard]] SplitPixel::Reached how_reached(const Compositor& compositor, const StackedPixel& pixel, Steps& steps);

// Notes how the right structure reaches the wrong pixels under each hypothesis, unless the limit of work is reached.
void note(SplitSample& parts, const std::vector<Hypothesis>& each, const Setting& setting);

// At most `most` of the pixels, at even distances.
[[nodiscard]] std::vector<const SplitPixel*> thinned(const std::vector<SplitPixel>& pixels, std::size_t most);

// One set of rules per rule.
[[nodiscard]] std::vector<Rules> singles(const std::vector<Rule>& rules);

}  // namespace strata::oracle::verdict
