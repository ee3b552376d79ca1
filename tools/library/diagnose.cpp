// tools/library/diagnose.cpp - finds the mistake in a picture of a scene, in one call.
#include "strata/diagnose.h"

#include <algorithm>

#include "rasterizer/base/input_error.h"
#include "tools/oracle/mistakes/catalogue.h"
#include "tools/oracle/mistakes/diagnosis_report.h"

namespace strata {
inline namespace v0_1 {

namespace {

std::vector<std::string> names_of_all(const std::vector<const oracle::Mistake*>& mistakes) {
    std::vector<std::string> names;
    for (const oracle::Mistake* mistake : mistakes) names.emplace_back(mistake->name);
    return names;
}

}  // namespace

std::string Diagnosed::verdict() const { return std::string{oracle::name(diagnosis.verdict)}; }

std::vector<std::string> Diagnosed::mistakes() const {
    if (diagnosis.verdict == oracle::Verdict::unknown_mistake) return {};
    return names_of_all(diagnosis.findings.at(0).mistakes);
}

std::vector<std::string> Diagnosed::alike() const {
    if (diagnosis.verdict == oracle::Verdict::unknown_mistake) return {};
    return names_of_all(diagnosis.findings.at(0).alike);
}

std::string Diagnosed::text() const { return oracle::to_text(diagnosis, comparison); }
std::string Diagnosed::json() const { return oracle::to_json(diagnosis, comparison); }

Diagnosed diagnose(const Scene& scene, const Picture& candidate, const Algorithm& algorithm,
                   const DeviceProfile& profile, const RenderOptions& options, const Tolerances& tolerances,
                   const Multisampling& sampling) {
    if (candidate.targets.empty()) throw InputError("candidate", "targets", "at least one", "none");
    RenderOptions of_candidate = options;
    of_candidate.width = candidate.targets[0].width;
    of_candidate.height = candidate.targets[0].height;
    const bool has_depth = std::ranges::find(candidate.targets, oracle::Meaning::depth, &oracle::Target::meaning) !=
                           candidate.targets.end();
    const View view = scene.view(of_candidate.width, of_candidate.height);
    const oracle::MistakeRenderer mistake_renderer{{scene.list(), view, profile, of_candidate, sampling},
                                                   algorithm,
                                                   has_depth ? oracle::Depths::made : oracle::Depths::left_out};
    const oracle::MistakeImages mistake_images{mistake_renderer};
    return {mistake_images.diagnose(candidate, tolerances), compare(mistake_renderer.right(), candidate, tolerances)};
}

}  // namespace v0_1
}  // namespace strata
