// pipeline/fragments/first_that.h - where a question about rising numbers turns true, sought from where it did last.
#pragma once
#include <algorithm>
#include <cstdint>

namespace strata::pipeline {

// The least k below `size` that `holds`, else `size`; what holds for k holds for all behind it. Of neighbouring passes answers are the
// same or a few numbers apart: steps that double, from `hint` on, which is at most `size`.
template <class Holds>
[[nodiscard]] std::uint32_t first_that(std::uint32_t size, std::uint32_t hint, const Holds& holds) {
    std::uint32_t low = 0, high = size, step = 1;  // the answer lies in [low, high]
    if (hint < size && !holds(hint)) {
        low = hint + 1;
        while (low + step <= size && !holds(low + step - 1)) low += step, step *= 2;
        high = std::min(size, low + step - 1);
    } else {
        high = hint;
        while (high >= step && holds(high - step)) high -= step, step *= 2;
        low = high >= step ? high - step + 1 : 0;
    }
    while (low < high) {
        const std::uint32_t middle = low + (high - low) / 2;
        if (holds(middle))
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

}  // namespace strata::pipeline
