#include "tools/oracle/mistakes/diagnosis.h"

#include <algorithm>
#include <atomic>

#include "rasterizer/base/parallel.h"
#include "tools/oracle/mistakes/catalogue.h"
#include "tools/oracle/pairs.h"

namespace strata::oracle {

namespace {

using Agreement = std::vector<bool>;  // a pixel an entry

// Which pixels of the candidate are those of `picture`.
Agreement agreement(const Picture& picture, const Picture& candidate, const Tolerances& tolerances) {
    const Pairing pairing = pair_targets(picture, candidate);
    Agreement all(pairing.pairs[0].reference->pixels(), true);
    for (const Pair& pair : pairing.pairs) {
        const bool is_depth = pair.reference->meaning == Meaning::depth;
        const std::uint32_t forgiven = is_depth ? tolerances.depth_codes : tolerances.color_codes;
        const bool has_one_code =
            pair.reference->code == pair.candidate->code && pair.reference->channels == pair.candidate->channels;
        const auto channels = static_cast<std::size_t>(pair.reference->channels);
        const auto has_equal_words = [&](std::size_t i) {
            const auto at = [&](const Target& t) {
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

bool is_same(const Picture& a, const Picture& b) {
    return std::ranges::equal(a.targets, b.targets, {}, &Target::codes, &Target::codes);
}

Finding finding(std::vector<const Mistake*> mistakes, const Agreement& agrees, const Agreement& right_agrees) {
    Finding found{.mistakes = std::move(mistakes)};
    for (std::size_t i = 0; i < agrees.size(); ++i) {
        found.agreeing += agrees[i] ? 1 : 0;
        found.explained += agrees[i] && !right_agrees[i] ? 1 : 0;
        found.contradicted += !agrees[i] && right_agrees[i] ? 1 : 0;
    }
    return found;
}

// body(i) for i below count, on all cores.
void for_all(std::size_t count, const ShowProgress& progress, const std::function<void(std::size_t)>& body) {
    std::atomic<std::size_t> done = 0;
    parallel_for(count, 0, [&](std::size_t i) {
        body(i);
        if (progress) progress(static_cast<double>(++done) / static_cast<double>(count));
    });
}

constexpr std::size_t most_pairs = 256;  // that are rendered; those of finished pictures cost nothing
constexpr std::size_t most_pixels_of_pairs = std::size_t{1} << 21;

}  // namespace

struct Lineup::Evidence {
    const Picture& candidate;
    const Tolerances& tolerances;
    const Agreement& right_agrees;
    std::vector<Agreement> agrees;  // of each suspect that shows
};

Lineup::Lineup(const Laboratory& laboratory, const ShowProgress& progress) : laboratory_{laboratory} {
    for (const Mistake& mistake : catalogue()) suspects_.push_back({.mistake = &mistake});
    for_all(suspects_.size(), progress,
            [&](std::size_t i) { suspects_[i].picture = laboratory.with(*suspects_[i].mistake); });
    for (std::size_t i = 0; i < suspects_.size(); ++i) {
        Suspect& suspect = suspects_[i];
        suspect.like = i;
        suspect.shows = suspect.picture && !is_same(*suspect.picture, laboratory.right());
        if (suspect.shows) suspect.unchanged = agreement(laboratory.right(), *suspect.picture, {});
        for (std::size_t j = 0; suspect.shows && j < i; ++j)
            if (suspects_[j].shows && suspects_[j].like == j && is_same(*suspects_[j].picture, *suspect.picture)) {
                suspect.like = j;
                break;
            }
    }
}

const Picture* Lineup::picture_of(const Mistake& mistake) const {
    const auto found = std::ranges::find(suspects_, &mistake, &Suspect::mistake);
    return found->picture ? &*found->picture : nullptr;
}

bool Lineup::shows(const Mistake& mistake) const {
    return std::ranges::find(suspects_, &mistake, &Suspect::mistake)->shows;
}

Diagnosis Lineup::diagnose(const Picture& candidate, const Tolerances& tolerances, const ShowProgress& progress) const {
    Diagnosis result;
    const Agreement right_agrees = agreement(laboratory_.right(), candidate, tolerances);
    result.pixels = right_agrees.size();
    result.differing = static_cast<std::uint64_t>(std::ranges::count(right_agrees, false));
    result.findings.push_back(finding({}, right_agrees, right_agrees));
    Evidence evidence{candidate, tolerances, right_agrees, std::vector<Agreement>(suspects_.size())};
    for (std::size_t i = 0; i < suspects_.size(); ++i) {
        const Suspect& suspect = suspects_[i];
        ++(suspect.shows ? result.tried : suspect.picture ? result.hidden : result.impossible);
        if (!suspect.shows || suspect.like != i) continue;
        evidence.agrees[i] = agreement(*suspect.picture, candidate, tolerances);
        result.findings.push_back(finding({suspect.mistake}, evidence.agrees[i], right_agrees));
        for (std::size_t j = i + 1; j < suspects_.size(); ++j)
            if (suspects_[j].shows && suspects_[j].like == i)
                result.findings.back().alike.push_back(suspects_[j].mistake);
    }
    const auto is_whole = [&](const Finding& f) { return f.agreeing == result.pixels; };
    if (std::ranges::none_of(result.findings, is_whole)) try_pairs(evidence, progress, result);
    std::ranges::stable_sort(result.findings, std::ranges::greater{}, &Finding::agreeing);
    const Finding& best = result.findings.front();
    result.verdict = !is_whole(best)             ? Verdict::none_of_mine
                     : best.mistakes.empty()     ? Verdict::right
                     : best.mistakes.size() == 1 ? Verdict::one_mistake
                                                 : Verdict::two_mistakes;
    return result;
}

namespace {

struct TwoSuspects {
    std::size_t first = 0, second = 0;
    std::uint64_t against = 0,
                  known = 0;  // pixels where at most one of the two shows: those that are not the candidate's, and all
};

}  // namespace

void Lineup::try_pairs(const Evidence& evidence, const ShowProgress& progress, Diagnosis& result) const {
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
            (suspects_[b].mistake->place == Place::picture ? finished : pairs).push_back(pair);
        }
    std::ranges::stable_sort(pairs, [](const TwoSuspects& x, const TwoSuspects& y) {
        return std::pair{x.against, y.known} < std::pair{y.against, x.known};
    });
    pairs.resize(std::min(pairs.size(), most_pairs));
    pairs.insert(pairs.begin(), finished.begin(), finished.end());
    std::vector<std::optional<Finding>> found(pairs.size());
    for_all(pairs.size(), progress, [&](std::size_t i) {
        const Mistake* const both[] = {suspects_[pairs[i].first].mistake, suspects_[pairs[i].second].mistake};
        const bool is_finished = both[1]->place == Place::picture;
        const auto picture =
            is_finished ? std::optional{changed(*suspects_[pairs[i].first].picture, *both[1])} : laboratory_.with(both);
        if (picture)
            found[i] = finding({both[0], both[1]}, agreement(*picture, evidence.candidate, evidence.tolerances),
                               evidence.right_agrees);
    });
    for (std::optional<Finding>& one : found)
        if (one) result.findings.push_back(*std::move(one));
    result.pairs_tried = static_cast<int>(pairs.size());
}

}  // namespace strata::oracle
