#include "tools/oracle/mistakes/diagnosis.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <utility>

#include "rasterizer/base/parallel.h"
#include "tools/oracle/mistakes/catalogue.h"
#include "tools/oracle/pairs.h"
#include "tools/oracle/stored_like.h"

namespace strata::oracle {

namespace {

using Agreement = std::vector<bool>;  // one entry per pixel

// Codes of colours that are accepted in addition to the tolerances, if both images have codes of one type.
enum class Forgiven : std::uint8_t { none, one_code };

// The pixels of the candidate that are equal to those of `picture`.
Agreement agreement(const Picture& picture, const Picture& candidate, const Tolerances& tolerances,
                    Forgiven beside = Forgiven::none) {
    const Pairing pairing = pair_targets(picture, candidate);
    Agreement all(pairing.pairs[0].reference->pixels(), true);
    for (const Pair& pair : pairing.pairs) {
        const bool is_depth = pair.reference->meaning == Meaning::depth;
        const bool has_one_code =
            pair.reference->code == pair.candidate->code && pair.reference->channels == pair.candidate->channels;
        const std::uint32_t more = beside == Forgiven::one_code && has_one_code ? 1 : 0;
        const std::uint32_t forgiven = is_depth ? tolerances.depth_codes : tolerances.color_codes + more;
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

// True if all pixels of an image are equal: nothing is drawn in it.
bool is_blank(const Picture& picture) {
    return std::ranges::all_of(picture.targets, [](const Target& t) {
        const auto channels = static_cast<std::ptrdiff_t>(t.channels);
        return std::equal(t.codes.begin() + channels, t.codes.end(), t.codes.begin());
    });
}

// Calls body(i) for all i below count, on all cores.
void for_all(std::size_t count, const ShowProgress& progress, const std::function<void(std::size_t)>& body) {
    std::atomic<std::size_t> done = 0;
    parallel_for(count, 0, [&](std::size_t i) {
        body(i);
        if (progress) progress(static_cast<double>(++done) / static_cast<double>(count));
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

// Of rendered pairs, with one sample per pixel; pairs with a mistake of the finished image cost nothing.
constexpr std::size_t most_pairs = 256;
constexpr std::size_t most_pixels_of_pairs = std::size_t{1} << 21;

}  // namespace

bool is_evidence(std::span<const Mistake* const> mistakes, std::uint64_t explained, std::uint64_t differing,
                 std::uint64_t differing_far) noexcept {
    const bool is_mistake = mistakes.size() == 1 && !mistakes[0]->is_allowed;
    return 2 * (is_mistake ? std::max(explained, differing_far) : explained) >= differing;
}

struct MistakeImages::Evidence {
    const Picture& candidate;
    const Tolerances& tolerances;
    pipeline::ColorSpace space;  // of the images
    Agreement right_agrees{};
    std::vector<Agreement> agrees{};  // of each suspect that changes the image

    [[nodiscard]] Agreement agreement_of(const Picture& picture) const {
        return agreement(stored_like(picture, candidate, space), candidate, tolerances);
    }
    [[nodiscard]] Finding of(std::vector<const Mistake*> mistakes, const Picture& picture) const {
        const Picture stored = stored_like(picture, candidate, space);
        return finding(std::move(mistakes), agreement(stored, candidate, tolerances),
                       agreement(stored, candidate, tolerances, Forgiven::one_code), right_agrees);
    }
};

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

Verdict verdict_of(const Diagnosis& d) {
    const Finding& best = d.findings.front();
    if (best.agreeing != d.pixels && !d.is_nearly) return Verdict::unknown_mistake;
    if (best.mistakes.empty()) return Verdict::right;
    if (is_allowed(best)) return Verdict::other_options;
    return best.mistakes.size() == 1 ? Verdict::one_mistake : Verdict::two_mistakes;
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
        result.verdict = verdict_of(result);
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
        d.verdict = verdict_of(d);
        return;
    }
    d.is_nearly = false;
    d.verdict = Verdict::unknown_mistake;
}

void MistakeImages::weigh_passes(const Evidence& evidence, const std::vector<PassPicture>& passes, Diagnosis& d) const {
    d.right_passes = mistake_renderer_.compare_passes({}, passes);
    if (!d.right_passes || d.right_passes->targets == 0 || d.verdict == Verdict::unknown_mistake || d.is_nearly) return;
    if (d.verdict == Verdict::right && d.right_passes->is_whole()) return;
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
    if (d.verdict == Verdict::right)
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
    d.verdict = d.passes_contradict ? Verdict::unknown_mistake : verdict_of(d);
}

namespace {

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
