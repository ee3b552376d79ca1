// tools/library/diagnose.cpp - the verdict on a picture of a scene, and the mistake in it, in one call each.
#include "strata/diagnose.h"

#include <algorithm>

#include "rasterizer/base/input_error.h"
#include "tools/oracle/diagnosis/diagnosis_report.h"
#include "tools/oracle/emulations/catalogue.h"
#include "tools/oracle/judge/diagnose_picture.h"

namespace strata {
inline namespace v0_1 {

namespace {

std::vector<std::string> names_of_all(const std::vector<const oracle::Mistake*>& mistakes) {
    std::vector<std::string> names;
    for (const oracle::Mistake* mistake : mistakes) names.emplace_back(mistake->name);
    return names;
}

}  // namespace

bool Diagnosed::is_right() const noexcept {
    using enum oracle::Conclusion;
    const oracle::Conclusion found = diagnosis.conclusion;
    return found == right || found == other_options || found == right_structure;
}

std::string Diagnosed::verdict() const { return std::string{oracle::name(diagnosis.conclusion)}; }

std::vector<std::string> Diagnosed::mistakes() const {
    if (is_right() || diagnosis.conclusion == oracle::Conclusion::unknown_mistake) return {};
    return names_of_all(diagnosis.findings.at(0).mistakes);
}

std::vector<std::string> Diagnosed::alike() const {
    if (is_right() || diagnosis.conclusion == oracle::Conclusion::unknown_mistake) return {};
    return names_of_all(diagnosis.findings.at(0).alike);
}

std::string Diagnosed::text() const { return oracle::to_text(diagnosis, comparison); }
std::string Diagnosed::json() const { return oracle::to_json(diagnosis, comparison); }

Diagnosed diagnose(const Scene& scene, const Picture& candidate, const Algorithm& algorithm,
                   const DeviceProfile& profile, const RenderOptions& options, const Tolerances& tolerances) {
    if (candidate.targets.empty()) throw InputError("candidate", "targets", "at least one", "none");
    RenderOptions of_candidate = options;
    of_candidate.width = candidate.targets[0].width;
    of_candidate.height = candidate.targets[0].height;
    const View view = scene.view(of_candidate.width, of_candidate.height, of_candidate.raster);
    auto found = oracle::diagnose_picture({.input = {scene.list(), view, profile, of_candidate, scene.space()},
                                           .algorithm = algorithm,
                                           .candidate = candidate,
                                           .tolerances = tolerances});
    return {std::move(found.found), std::move(found.comparison), std::move(found.options)};
}

Judgement judge(const Scene& scene, const Picture& candidate, const DeviceProfile& profile,
                const RenderOptions& options) {
    const auto colors = std::ranges::find(candidate.targets, oracle::Meaning::color, &oracle::TargetImage::meaning);
    if (colors == candidate.targets.end()) throw InputError("candidate", "targets", "colours", "none");
    RenderOptions of_candidate = options;
    of_candidate.width = colors->width;
    of_candidate.height = colors->height;
    const View view = scene.view(of_candidate.width, of_candidate.height, of_candidate.raster);
    return oracle::judge({scene.list(), view, profile, of_candidate, scene.space()}, {*colors});
}

}  // namespace v0_1
}  // namespace strata
