// tools/oracle/program/steps/entries.cpp - all entries, and the functions that several of them use (entries.h).
#include "tools/oracle/program/steps/entries.h"

#include <algorithm>
#include <cmath>

namespace strata::oracle::program {

double encoded(double l) noexcept {
    l = std::clamp(l, 0.0, 1.0);
    return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
}

double decoded(double e) noexcept {
    e = std::clamp(e, 0.0, 1.0);
    return e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4);
}

double in_bits(double v, double bits) noexcept {
    const double codes = std::exp2(bits) - 1;
    return std::floor(std::clamp(v, 0.0, 1.0) * codes + 0.5) / codes;
}

const std::vector<const StepEntry*>& entries() {
    static const std::vector<const StepEntry*> all = [] {
        std::vector<const StepEntry*> made;
        for (const auto& table : {list_entries(), value_entries(), order_entries(), background_entries(),
                                  fold_entries(), sum_entries(), finish_entries()})
            for (const StepEntry& entry : table) made.push_back(&entry);
        return made;
    }();
    return all;
}

}  // namespace strata::oracle::program
