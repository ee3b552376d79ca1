// peeling/registry.cpp - the algorithms, gathered from their files.
//
// Rule     Algorithm::listed says in which order every list and table prints them; those of one number stay as their
//          file names them.
// Tests    tests/peeling/refusals_test.cpp, passes_test.cpp; tests/lint/specification_covers.py: each name has a
//          section in the specification
#include "peeling/registry.h"

#include <algorithm>
#include <span>

namespace strata::peeling {

namespace listing {
std::vector<Algorithm> all_entries();  // listings.cpp, made by the build
}

const std::vector<Algorithm>& algorithms() {
    static const std::vector<Algorithm> all = [] {
        std::vector<Algorithm> found = listing::all_entries();
        std::ranges::stable_sort(found, {}, &Algorithm::listed);
        return found;
    }();
    return all;
}

const Algorithm* find_algorithm(std::string_view name) {
    const auto& all = algorithms();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Algorithm& a) { return a.name == name; });
    return found == all.end() ? nullptr : &*found;
}

// Targets count by their number alone here: their blends are checked by each pass (pipeline/frame/check_pass.h).
pipeline::Verdict refusal(const Algorithm& algorithm, const pipeline::DeviceProfile& profile) {
    if (auto lacking = check(profile, std::span{algorithm.features})) return lacking;
    const std::vector<pipeline::Blend> targets(static_cast<std::size_t>(algorithm.render_targets));
    if (auto lacking = check(profile, std::span{targets})) return lacking;
    return check_samples(profile, algorithm.samples);
}

}  // namespace strata::peeling
