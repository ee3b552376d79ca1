#include "tools/oracle/diagnosis/evidence.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "rasterizer/base/parallel.h"
#include "tools/oracle/picture/pairs.h"
#include "tools/oracle/picture/stored_like.h"

namespace strata::oracle {

Agreement agreement(const Picture& picture, const Picture& candidate, const Tolerances& tolerances, Forgiven beside) {
    const Pairing pairing = pair_targets(picture, candidate);
    Agreement all(pairing.pairs[0].reference->pixels(), true);
    for (const TargetPair& pair : pairing.pairs) {
        const bool is_depth = pair.reference->meaning == Meaning::depth;
        const bool has_one_code =
            pair.reference->code == pair.candidate->code && pair.reference->channels == pair.candidate->channels;
        const std::uint32_t more = beside == Forgiven::one_code && has_one_code ? 1 : 0;
        const std::uint32_t forgiven = is_depth ? tolerances.depth_codes : tolerances.color_codes + more;
        const auto channels = static_cast<std::size_t>(pair.reference->channels);
        const auto has_equal_words = [&](std::size_t i) {
            const auto at = [&](const TargetImage& t) {
                return t.codes.begin() + static_cast<std::ptrdiff_t>(i * channels);
            };
            return has_one_code &&
                   std::equal(at(*pair.reference), at(*pair.reference) + pair.reference->channels, at(*pair.candidate));
        };
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = all[i] && (has_equal_words(i) || pair.distance_at(i) <= forgiven);
    }
    return all;
}

namespace {

// `nearly` is the agreement with a tolerance of one more code.
Finding finding(std::vector<const Mistake*> mistakes, const Agreement& agrees, const Agreement& nearly,
                const Agreement& right_agrees) {
    Finding found{.mistakes = std::move(mistakes)};
    found.nearly = static_cast<std::uint64_t>(std::ranges::count(nearly, true));
    for (std::size_t i = 0; i < agrees.size(); ++i) {
        found.agreeing += agrees[i] ? 1 : 0;
        found.explained += agrees[i] && !right_agrees[i] ? 1 : 0;
        found.contradicted += !agrees[i] && right_agrees[i] ? 1 : 0;
    }
    return found;
}

}  // namespace

Agreement MistakeImages::Evidence::agreement_of(const Picture& picture) const {
    return agreement(stored_like(picture, candidate, space), candidate, tolerances);
}

Finding MistakeImages::Evidence::of(std::vector<const Mistake*> mistakes, const Picture& picture) const {
    const Picture stored = stored_like(picture, candidate, space);
    return finding(std::move(mistakes), agreement(stored, candidate, tolerances),
                   agreement(stored, candidate, tolerances, Forgiven::one_code), right_agrees);
}

void for_all(std::size_t count, const ShowProgress& progress, const std::function<void(std::size_t)>& body) {
    std::atomic<std::size_t> done = 0;
    parallel_for(count, 0, [&](std::size_t i) {
        body(i);
        if (progress) progress(static_cast<double>(++done) / static_cast<double>(count));
    });
}

}  // namespace strata::oracle
