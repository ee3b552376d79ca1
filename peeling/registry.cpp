// peeling/registry.cpp - the list of all algorithms, collected from their files.
//
// Rule     Algorithm::listed determines the order in every list and table; algorithms with one number stay in the order
//          of their file.
// Tests    tests/peeling/passes_test.cpp, frame/refusals_test.cpp; tests/lint/specification_covers.py: each name has a
//          section in the specification
#include "peeling/registry.h"

#include <algorithm>
#include <span>

namespace strata::peeling {

namespace listing {
std::vector<Algorithm> all_entries();  // in listings.cpp, which the build generates
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

// Only the number of targets is checked here: each pass checks their blend states (pipeline/frame/check_pass.h).
std::optional<pipeline::Refusal> refusal(const Algorithm& algorithm, const pipeline::DeviceProfile& profile) {
    if (auto lacking = check(profile, std::span{algorithm.features})) return lacking;
    const std::vector<pipeline::Blend> targets(static_cast<std::size_t>(algorithm.render_targets));
    if (auto lacking = check(profile, std::span{targets})) return lacking;
    return check_samples(profile, algorithm.samples);
}

std::function<void(pipeline::Region&)> body_of(const Algorithm& algorithm, const ListingInputs& inputs) {
    if (algorithm.body) return algorithm.body;
    const bool has_tail = inputs.options.tail.value_or(Tail::none) != Tail::none;
    return [&algorithm, inputs, has_tail](pipeline::Region& region) {
        if (algorithm.resolve_loop != nullptr && !has_tail && algorithm.resolve_loop(region)) return;
        if (algorithm.run_with != nullptr) return algorithm.run_with(region, inputs);
        algorithm.run(region);
    };
}

}  // namespace strata::peeling
