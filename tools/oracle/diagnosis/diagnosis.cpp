// tools/oracle/diagnosis/diagnosis.cpp - renders the scene with each mistake, compares the pictures and passes with the
// candidate's, and decides which mistake is named (diagnosis.h).
#include "tools/oracle/diagnosis/diagnosis.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "tools/oracle/diagnosis/evidence.h"
#include "tools/oracle/emulations/catalogue.h"

namespace strata::oracle {

namespace {

bool is_same(const Picture& a, const Picture& b) {
    return std::ranges::equal(a.targets, b.targets, {}, &TargetImage::codes, &TargetImage::codes);
}

// True if all pixels of an image are equal: nothing is drawn in it.
bool is_blank(const Picture& picture) {
    return std::ranges::all_of(picture.targets, [](const TargetImage& t) {
        const auto channels = static_cast<std::ptrdiff_t>(t.channels);
        return std::equal(t.codes.begin() + channels, t.codes.end(), t.codes.begin());
    });
}

bool is_allowed(const Finding& f) {
    return !f.mistakes.empty() && std::ranges::all_of(f.mistakes, &Mistake::is_allowed);
}

// True if a finding explains all pixels within one code, and not by accident.
bool is_nearly_whole(const Finding& f, const Diagnosis& d) {
    return f.agreeing != d.pixels && f.nearly == d.pixels &&
           is_evidence(f.mistakes, f.explained, d.differing, d.differing_far);
}

}  // namespace

bool is_evidence(std::span<const Mistake* const> mistakes, std::uint64_t explained, std::uint64_t differing,
                 std::uint64_t differing_far) noexcept {
    const bool is_mistake = mistakes.size() == 1 && !mistakes[0]->is_allowed;
    return 2 * (is_mistake ? std::max(explained, differing_far) : explained) >= differing;
}

MistakeImages::MistakeImages(const MistakeRenderer& mistake_renderer, const ShowProgress& progress,
                             std::span<const Mistake> options)
    : mistake_renderer_{mistake_renderer}, edges_{mistake_renderer.edges()} {
    for (const Mistake& option : options) suspects_.push_back({.mistake = &option});
    for (const Mistake& mistake : catalogue()) suspects_.push_back({.mistake = &mistake});
    for_all(suspects_.size(), progress,
            [&](std::size_t i) { suspects_[i].picture = mistake_renderer.with(*suspects_[i].mistake); });
    for (std::size_t i = 0; i < suspects_.size(); ++i) {
        Suspect& suspect = suspects_[i];
        suspect.like = i;
        suspect.shows = suspect.picture && !is_same(*suspect.picture, mistake_renderer.right());
        if (suspect.shows) suspect.unchanged = agreement(mistake_renderer.right(), *suspect.picture, {});
        for (std::size_t j = 0; suspect.shows && j < i; ++j)
            if (suspects_[j].shows && suspects_[j].like == j && is_same(*suspects_[j].picture, *suspect.picture)) {
                suspect.like = j;
                break;
            }
    }
}

const Picture* MistakeImages::picture_of(const Mistake& mistake) const {
    const auto found = std::ranges::find(suspects_, &mistake, &Suspect::mistake);
    return found->picture ? &*found->picture : nullptr;
}

MistakeImages::Judgement MistakeImages::judge(std::span<const Mistake* const> mistakes, const Picture& candidate,
                                              const Tolerances& tolerances,
                                              const std::vector<PassPicture>* passes) const {
    std::vector<const Mistake*> made;
    for (const Mistake* mistake : mistakes)
        if (picture_of(*mistake) != nullptr) made.push_back(mistake);
    const std::optional<Picture> both = made.size() > 1 ? mistake_renderer_.with(made) : std::nullopt;
    const Picture* picture = made.empty()       ? &mistake_renderer_.right()
                             : made.size() == 1 ? picture_of(*made[0])
                                                : nullptr;
    if (both) picture = &*both;
    if (picture == nullptr) return {};
    Evidence evidence{candidate, tolerances, mistake_renderer_.space()};
    evidence.right_agrees = evidence.agreement_of(mistake_renderer_.right());
    const Finding right = evidence.of({}, mistake_renderer_.right());
    Judgement judged{.finding = evidence.of(made, *picture)};
    const std::uint64_t pixels = evidence.right_agrees.size();
    judged.fits = judged.finding.agreeing == pixels || (right.nearly != pixels && judged.finding.nearly == pixels);
    if (passes == nullptr || !judged.fits) return judged;
    const auto right_passes = mistake_renderer_.compare_passes({}, *passes);
    if (!right_passes || right_passes->targets == 0) return judged;
    judged.finding.passes = mistake_renderer_.compare_passes(made, *passes);
    judged.fits = judged.finding.passes && explains_origin(*judged.finding.passes, *right_passes);
    return judged;
}

bool MistakeImages::shows(const Mistake& mistake) const {
    return std::ranges::find(suspects_, &mistake, &Suspect::mistake)->shows;
}

namespace {

// If no finding explains all pixels exactly, moves the best one that nearly does to the front, options of a correct run
// first. If the correct run is as near, one code is no evidence of a mistake.
void take_nearly_whole(Diagnosis& d, std::uint64_t right_nearly) {
    if (d.findings.front().agreeing == d.pixels) return;
    const auto take = [&](auto is_fitting) {
        const auto found =
            std::ranges::find_if(d.findings, [&](const Finding& f) { return is_nearly_whole(f, d) && is_fitting(f); });
        if (found == d.findings.end()) return false;
        std::rotate(d.findings.begin(), found, found + 1);
        return d.is_nearly = true;
    };
    if (!take(is_allowed) && right_nearly != d.pixels) take([](const Finding&) { return true; });
}

Conclusion conclusion_of(const Diagnosis& d) {
    const Finding& best = d.findings.front();
    if (best.agreeing != d.pixels && !d.is_nearly) return Conclusion::unknown_mistake;
    if (best.mistakes.empty()) return Conclusion::right;
    if (is_allowed(best)) return Conclusion::other_options;
    return best.mistakes.size() == 1 ? Conclusion::one_mistake : Conclusion::two_mistakes;
}

}  // namespace

Diagnosis MistakeImages::diagnose(const Picture& candidate, const Tolerances& tolerances, const ShowProgress& progress,
                                  const std::vector<PassPicture>* passes) const {
    Diagnosis result{.is_blank = is_blank(candidate)};
    Evidence evidence{candidate, tolerances, mistake_renderer_.space()};
    evidence.right_agrees = evidence.agreement_of(mistake_renderer_.right());
    evidence.agrees.resize(suspects_.size());
    const Agreement& right_agrees = evidence.right_agrees;
    result.pixels = right_agrees.size();
    result.differing = static_cast<std::uint64_t>(std::ranges::count(right_agrees, false));
    if (!edges_.empty()) {
        result.at_edges = 0;
        for (std::size_t i = 0; i < edges_.size(); ++i) *result.at_edges += edges_[i] && !right_agrees[i] ? 1 : 0;
    }
    result.findings.push_back(evidence.of({}, mistake_renderer_.right()));
    const std::uint64_t right_nearly = result.findings.front().nearly;
    result.differing_far = result.pixels - right_nearly;
    for (std::size_t i = 0; i < suspects_.size(); ++i) {
        const Suspect& suspect = suspects_[i];
        ++(suspect.shows ? result.tried : suspect.picture ? result.hidden : result.impossible);
        if (!suspect.shows || suspect.like != i) continue;
        evidence.agrees[i] = evidence.agreement_of(*suspect.picture);
        result.findings.push_back(evidence.of({suspect.mistake}, *suspect.picture));
        for (std::size_t j = i + 1; j < suspects_.size(); ++j)
            if (suspects_[j].shows && suspects_[j].like == i)
                result.findings.back().alike.push_back(suspects_[j].mistake);
    }
    const auto is_whole = [&](const Finding& f) { return f.agreeing == result.pixels; };
    const auto rank = [&] {
        std::ranges::stable_sort(result.findings, std::ranges::greater{}, &Finding::agreeing);
        take_nearly_whole(result, right_nearly);
        result.conclusion = conclusion_of(result);
        if (passes != nullptr && result.pixels <= most_pixels_of_pairs) weigh_passes(evidence, *passes, result);
    };
    // An image of one colour is no evidence of two mistakes, unless there are passes.
    const bool shows_pairs = !result.is_blank || passes != nullptr;
    if (shows_pairs && std::ranges::none_of(result.findings, is_whole)) try_pairs(evidence, progress, result);
    rank();
    // The mistake with this image has other passes: two mistakes may also give this image.
    if (result.passes_contradict && result.pairs_tried == 0 && result.differing > 0) {
        try_pairs(evidence, progress, result);
        rank();
    }
    const bool may_be_nearly = passes != nullptr && right_nearly != result.pixels;
    if (may_be_nearly && (result.is_nearly || result.passes_contradict)) weigh_nearly_whole(*passes, result);
    return result;
}

namespace {

constexpr std::size_t most_weighed = 64;  // limit on findings whose passes are rendered again

}  // namespace

void MistakeImages::weigh_nearly_whole(const std::vector<PassPicture>& passes, Diagnosis& d) const {
    if (!d.right_passes || d.right_passes->targets == 0) return;
    std::size_t weighed = 0;
    for (auto f = d.findings.begin(); f != d.findings.end() && weighed < most_weighed; ++f) {
        if (!is_nearly_whole(*f, d)) continue;
        ++weighed;
        f->passes = mistake_renderer_.compare_passes(f->mistakes, passes);
        if (!f->passes || !explains_origin(*f->passes, *d.right_passes)) continue;
        std::rotate(d.findings.begin(), f, f + 1);
        d.is_nearly = true;
        d.passes_contradict = false;
        d.conclusion = conclusion_of(d);
        return;
    }
    d.is_nearly = false;
    d.conclusion = Conclusion::unknown_mistake;
}

void MistakeImages::weigh_passes(const Evidence& evidence, const std::vector<PassPicture>& passes, Diagnosis& d) const {
    d.right_passes = mistake_renderer_.compare_passes({}, passes);
    if (!d.right_passes || d.right_passes->targets == 0 || d.conclusion == Conclusion::unknown_mistake || d.is_nearly)
        return;
    if (d.conclusion == Conclusion::right && d.right_passes->is_whole()) return;
    // Each single mistake with the candidate's image; for the correct image, mistakes that do not change it.
    const auto with_alike = [&](const Mistake* mistake) {
        std::vector<const Mistake*> all{mistake};
        const auto own = std::ranges::find(suspects_, mistake, &Suspect::mistake);
        for (const Suspect& suspect : suspects_)
            if (own->shows && suspect.shows && suspect.like == own->like && suspect.mistake != mistake)
                all.push_back(suspect.mistake);
        return all;
    };
    std::vector<Finding> weighed, rest;
    for (Finding& f : d.findings) {
        if (f.agreeing != d.pixels || weighed.size() >= most_weighed) {
            rest.push_back(std::move(f));
            continue;
        }
        f.alike.clear();
        weighed.push_back(f);
        if (f.mistakes.size() == 1)
            for (const Mistake* mistake : with_alike(f.mistakes[0])) {
                if (mistake == f.mistakes[0]) continue;
                weighed.push_back(f);
                weighed.back().mistakes = {mistake};
            }
        // Mistakes with equal images need not be equal in combination with another.
        if (f.mistakes.size() == 2)
            for (const Mistake* first : with_alike(f.mistakes[0]))
                for (const Mistake* second : with_alike(f.mistakes[1])) {
                    const std::vector<const Mistake*> both{first, second};
                    const auto picture = both == f.mistakes ? std::nullopt : mistake_renderer_.with(both);
                    if (!picture) continue;
                    if (Finding found = evidence.of(both, *picture); found.agreeing == d.pixels)
                        weighed.push_back(std::move(found));
                }
    }
    if (d.conclusion == Conclusion::right)
        for (const Suspect& suspect : suspects_)
            if (suspect.picture && !suspect.shows) {
                weighed.push_back(weighed.front());
                weighed.back().mistakes = {suspect.mistake};
            }
    for_all(weighed.size(), {},
            [&](std::size_t i) { weighed[i].passes = mistake_renderer_.compare_passes(weighed[i].mistakes, passes); });
    const auto rank = [&](const Finding& f) {
        return f.passes ? std::pair{explains_origin(*f.passes, *d.right_passes), f.passes->alike} : std::pair{false, 0};
    };
    std::ranges::stable_sort(weighed, std::ranges::greater{}, rank);
    const Finding& best = weighed.front();
    d.passes_contradict = !rank(best).first;
    std::vector<Finding> ranked{best};
    for (std::size_t i = 1; i < weighed.size(); ++i)
        if (weighed[i].mistakes.size() == 1 && best.mistakes.size() == 1 && weighed[i].passes == best.passes)
            ranked.front().alike.push_back(weighed[i].mistakes.front());
        else
            ranked.push_back(std::move(weighed[i]));
    std::ranges::move(rest, std::back_inserter(ranked));
    d.findings = std::move(ranked);
    d.conclusion = d.passes_contradict ? Conclusion::unknown_mistake : conclusion_of(d);
}

}  // namespace strata::oracle
