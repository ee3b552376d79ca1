// tools/library/diagnose.cpp - the verdict on a picture of a scene, and the mistake in it, in one call each.
#include "strata/diagnose.h"

#include <algorithm>

#include "rasterizer/base/input_error.h"
#include "tools/library/check_light.h"
#include "tools/oracle/diagnosis/diagnosis_report.h"
#include "tools/oracle/emulations/catalogue.h"
#include "tools/oracle/judge/picture_diagnosis.h"

namespace strata {
inline namespace v0_1 {

namespace {

std::vector<std::string> names_of_all(const std::vector<const oracle::Mistake*>& mistakes) {
    std::vector<std::string> names;
    for (const oracle::Mistake* mistake : mistakes) names.emplace_back(mistake->name);
    return names;
}

}  // namespace

bool Diagnosed::is_right() const noexcept { return judgement.is_right; }

std::string Diagnosed::verdict() const { return std::string{oracle::name(diagnosis.conclusion)}; }

std::vector<std::string> Diagnosed::mistakes() const {
    if (is_right() || diagnosis.conclusion == oracle::Conclusion::unknown_mistake) return {};
    return names_of_all(diagnosis.findings.at(0).mistakes);
}

std::vector<std::string> Diagnosed::alike() const {
    if (is_right() || diagnosis.conclusion == oracle::Conclusion::unknown_mistake) return {};
    return names_of_all(diagnosis.findings.at(0).alike);
}

std::string Diagnosed::sentence() const { return judgement.sentence; }
std::string Diagnosed::text() const { return judgement.text; }
std::string Diagnosed::json() const { return judgement.json; }

namespace {

Judgement judged(const Scene& scene, const oracle::AskedPicture& asked, const DeviceProfile& profile,
                 RenderOptions options, oracle::Effort effort) {
    check_light(scene, options);
    const oracle::TargetImage& size = asked.candidate.targets[0];
    options.width = size.width;
    options.height = size.height;
    const View view = scene.view(options.width, options.height, options.raster);
    Judgement found = oracle::judge({scene.list(), view, profile, options, scene.space()}, asked, effort);
    found.layers.reset();  // it refers to the view
    return found;
}

}  // namespace

Diagnosed diagnose(const Scene& scene, const Picture& candidate, const Algorithm& algorithm,
                   const DeviceProfile& profile, const RenderOptions& options, const Tolerances& tolerances) {
    if (candidate.targets.empty()) throw InputError("candidate", "targets", "at least one", "none");
    Judgement found = judged(scene, {.candidate = candidate, .algorithm = &algorithm, .tolerances = tolerances},
                             profile, options, oracle::Effort::all);
    Diagnosed result{.diagnosis = found.emulations->found, .comparison = found.emulations->comparison};
    result.judgement = std::move(found);
    return result;
}

Judgement judge(const Scene& scene, const Picture& candidate, const DeviceProfile& profile,
                const RenderOptions& options, const Algorithm* algorithm) {
    if (candidate.targets.empty()) throw InputError("candidate", "targets", "colours", "none");
    return judged(scene, {.candidate = candidate, .algorithm = algorithm}, profile, options, oracle::Effort::single);
}

}  // namespace v0_1
}  // namespace strata
