// tools/oracle/diagnosis/mistake_pairs.cpp - tries pairs of mistakes whose picture may be the candidate's (rule:
// diagnosis.h).
#include <algorithm>
#include <optional>
#include <utility>

#include "tools/oracle/diagnosis/evidence.h"

namespace strata::oracle {

namespace {

// Of rendered pairs, with one sample per pixel; pairs with a mistake of the finished image cost nothing.
constexpr std::size_t most_pairs = 256;

struct TwoSuspects {
    std::size_t first = 0, second = 0;
    // Of the pixels where at most one of the two changes the image: those that differ from the candidate's, and all.
    std::uint64_t against = 0, known = 0;
};

}  // namespace

// True if the second mistake undoes the first almost everywhere, but for rounding: no port has such a pair.
bool MistakeImages::cancels(std::size_t first, std::size_t second, const Picture& both) const {
    const Agreement is_right = agreement(mistake_renderer_.right(), both, {}, Forgiven::one_code);
    std::size_t shown = 0, undone = 0;
    for (std::size_t i = 0; i < is_right.size(); ++i) {
        if (suspects_[first].unchanged[i] || suspects_[second].unchanged[i]) continue;
        ++shown;
        undone += is_right[i] ? 1 : 0;
    }
    return shown > 0 && 2 * undone > shown;
}

void MistakeImages::try_pairs(const Evidence& evidence, const ShowProgress& progress, Diagnosis& result) const {
    if (result.pixels > most_pixels_of_pairs) return;
    std::vector<TwoSuspects> pairs, finished;
    for (std::size_t a = 0; a < suspects_.size(); ++a)
        for (std::size_t b = a + 1; b < suspects_.size(); ++b) {
            if (evidence.agrees[a].empty() || evidence.agrees[b].empty()) continue;
            TwoSuspects pair{a, b};
            for (std::size_t i = 0; i < result.pixels; ++i) {
                const bool a_alone = suspects_[b].unchanged[i], b_alone = suspects_[a].unchanged[i];
                if (!a_alone && !b_alone) continue;
                ++pair.known;
                const Agreement& as = a_alone && b_alone ? evidence.right_agrees : evidence.agrees[a_alone ? a : b];
                pair.against += as[i] ? 0 : 1;
            }
            (suspects_[b].mistake->part == ChangedPart::picture ? finished : pairs).push_back(pair);
        }
    std::ranges::stable_sort(pairs, [](const TwoSuspects& x, const TwoSuspects& y) {
        return std::pair{x.against, y.known} < std::pair{y.against, x.known};
    });
    // If nothing is drawn, all mistakes that draw nothing fit, and pairs fit more easily than single ones. The
    // background gives more evidence.
    pairs.resize(result.is_blank ? 0 : std::min(pairs.size(), most_pairs / mistake_renderer_.samples()));
    pairs.insert(pairs.begin(), finished.begin(), finished.end());
    std::vector<std::optional<Finding>> found(pairs.size());
    for_all(pairs.size(), progress, [&](std::size_t i) {
        const Mistake* const both[] = {suspects_[pairs[i].first].mistake, suspects_[pairs[i].second].mistake};
        const bool is_finished = both[1]->part == ChangedPart::picture;
        const auto picture = is_finished ? std::optional{changed(*suspects_[pairs[i].first].picture, *both[1])}
                                         : mistake_renderer_.with(both);
        if (picture && !cancels(pairs[i].first, pairs[i].second, *picture))
            found[i] = evidence.of({both[0], both[1]}, *picture);
    });
    // A pair that explains no more than one of its two is no finding.
    const auto of_one = [&](const Mistake* mistake) {
        const auto single = std::ranges::find_if(result.findings, [&](const Finding& f) {
            return f.mistakes.size() == 1 && (f.mistakes[0] == mistake || std::ranges::count(f.alike, mistake) > 0);
        });
        return single == result.findings.end() ? 0 : single->agreeing;
    };
    for (std::optional<Finding>& one : found)
        if (one && one->agreeing > std::max(of_one(one->mistakes[0]), of_one(one->mistakes[1])))
            result.findings.push_back(*std::move(one));
    result.pairs_tried = static_cast<int>(pairs.size());
}

}  // namespace strata::oracle
