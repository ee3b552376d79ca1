// tools/oracle/diagnosis/scenes_diagnosis.cpp - ranks the mistakes that explain a port's pictures of all scenes
// together (scenes_diagnosis.h).
#include "tools/oracle/diagnosis/scenes_diagnosis.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "rasterizer/base/parallel.h"

namespace strata::oracle {

namespace {

using Mistakes = std::vector<const Mistake*>;

constexpr std::size_t most_of_a_scene = 24;  // limit on findings of one scene that are judged in all others

// The findings that are reported for a scene, or explain all of its pixels there; the correct run first. In the order
// of the scenes' findings.
std::vector<Mistakes> hypotheses(const std::vector<Diagnosis>& scenes) {
    std::vector<Mistakes> all{{}};
    std::set<Mistakes> known{{}};
    const auto add = [&](const Mistakes& mistakes) {
        if (known.insert(mistakes).second) all.push_back(mistakes);
    };
    for (const Diagnosis& d : scenes) {
        std::size_t taken = 0;
        for (const Finding& f : d.findings) {
            const bool is_first = &f == &d.findings.front();
            if (f.mistakes.empty() || (!is_first && f.agreeing != d.pixels) || taken++ == most_of_a_scene) continue;
            add(f.mistakes);
            if (f.mistakes.size() == 1)
                for (const Mistake* other : f.alike) add({other});
        }
    }
    return all;
}

ScenesFinding judged(const Mistakes& mistakes, const std::vector<SceneEvidence>& scenes, const Tolerances& tolerances) {
    ScenesFinding found{.mistakes = mistakes};
    for (const SceneEvidence& scene : scenes) {
        const MistakeImages::Judgement here =
            scene.mistake_images->judge(mistakes, *scene.candidate, tolerances, scene.passes);
        found.fits.push_back(here.fits);
        found.explained += here.finding.explained;
        if (here.fits && here.finding.passes) found.targets_alike += here.finding.passes->alike;
    }
    return found;
}

// A larger rank is better.
auto rank_of(const ScenesFinding& f) {
    return std::tuple{std::ranges::count(f.fits, true), -static_cast<std::ptrdiff_t>(f.mistakes.size()),
                      f.targets_alike, f.explained};
}

// Single mistakes that fit as well as the first finding are listed with it.
void gather_alike(std::vector<ScenesFinding>& findings) {
    ScenesFinding& best = findings.front();
    const auto fits_as_well = [&](const ScenesFinding& f) {
        return &f != &best && f.mistakes.size() == 1 && rank_of(f) == rank_of(best);
    };
    for (const ScenesFinding& f : findings)
        if (best.mistakes.size() == 1 && fits_as_well(f)) best.alike.push_back(f.mistakes[0]);
    const Mistakes alike = best.alike;
    std::erase_if(findings, [&](const ScenesFinding& f) {
        return f.mistakes.size() == 1 && std::ranges::find(alike, f.mistakes[0]) != alike.end();
    });
}

}  // namespace

ScenesDiagnosis diagnose_scenes(const std::vector<SceneEvidence>& scenes, const Tolerances& tolerances,
                                const ShowProgress& progress) {
    ScenesDiagnosis result;
    for (const SceneEvidence& scene : scenes) {
        result.scenes.push_back(scene.mistake_images->diagnose(*scene.candidate, tolerances, {}, scene.passes));
        result.pixels += result.scenes.back().pixels;
        result.differing += result.scenes.back().differing;
        result.differing_far += result.scenes.back().differing_far;
        if (progress) progress(0.8 * static_cast<double>(result.scenes.size()) / static_cast<double>(scenes.size()));
    }
    const std::vector<Mistakes> all = hypotheses(result.scenes);
    result.findings.resize(all.size());
    parallel_for(all.size(), 0, [&](std::size_t i) { result.findings[i] = judged(all[i], scenes, tolerances); });
    std::ranges::stable_sort(result.findings, std::ranges::greater{}, rank_of);
    gather_alike(result.findings);
    const ScenesFinding& best = result.findings.front();
    const bool fits_all = std::ranges::find(best.fits, false) == best.fits.end();
    const bool is_explained =
        fits_all && is_evidence(best.mistakes, best.explained, result.differing, result.differing_far);
    result.conclusion = !is_explained               ? Conclusion::unknown_mistake
                        : best.mistakes.empty()     ? Conclusion::right
                        : best.mistakes.size() == 1 ? Conclusion::one_mistake
                                                    : Conclusion::two_mistakes;
    if (progress) progress(1);
    return result;
}

}  // namespace strata::oracle
