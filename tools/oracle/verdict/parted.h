// tools/oracle/verdict/parted.h - the pixels of a sample, divided into right and wrong ones by the account that comes
// closest; what search.cpp and leads.cpp share.
#pragma once
#include <vector>

#include "tools/oracle/verdict/match.h"
#include "tools/oracle/verdict/rules.h"

namespace strata::oracle::verdict {

using Rules = std::vector<Rule>;

struct PartedPixel {
    const SampledPixel* sampled = nullptr;
    StackedPixel right{};  // by the right structure
};

// The sample's pixels apart: those that the closest account of the right structure calls wrong, and the others.
struct Parted {
    std::vector<PartedPixel> wrong{}, right{};
};

[[nodiscard]] Parted parted(const Sample& sample, const Hypothesis& closest);

// Whether a pixel's structures are the right ones; the division of a peel from both ends aside.
[[nodiscard]] bool is_unchanged(const StackedPixel& made, const PartedPixel& pixel);

// At most `most` of the pixels, evenly chosen.
[[nodiscard]] std::vector<const PartedPixel*> thinned(const std::vector<PartedPixel>& pixels, std::size_t most);

// Each rule by itself.
[[nodiscard]] std::vector<Rules> singles(const std::vector<Rule>& rules);

}  // namespace strata::oracle::verdict
