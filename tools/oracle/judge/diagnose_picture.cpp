// tools/oracle/judge/diagnose_picture.cpp - decides what made a picture: first the emulated mistakes, then the layers'
// verdict where no emulation gives it (diagnose_picture.h).
#include "tools/oracle/judge/diagnose_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/device/profile.h"
#include "tools/oracle/emulations/allowed_options.h"
#include "tools/oracle/judge/judge.h"
#include "tools/oracle/picture/stored_like.h"

namespace strata::oracle {

namespace {

// True if emulations decide, so that the layers need not be asked.
bool is_decided(const DiagnosisQuestion& question, const Diagnosis& found) {
    const bool is_exact =
        found.findings.front().agreeing == found.pixels && !found.passes_contradict && !found.is_nearly;
    if (!is_exact) return false;
    // The layers of an approximate algorithm are not in order, so that they cannot contradict.
    return found.conclusion == Conclusion::right || found.conclusion == Conclusion::other_options ||
           !question.algorithm.exact;
}

bool has_layers(const peeling::FrameRequest& input) {
    return input.options.sampling.samples == 1 ||
           (!input.options.sampling.loads_others() && input.options.sampling.resolve == pipeline::Resolve::box);
}

// What the layers say of a picture.
Judgement layers_of(const DiagnosisQuestion& question, const TargetImage& colors) {
    return judge(question.input,
                 {colors, question.is_form_stated, question.tolerances.channels == ColorChannels::all,
                  question.algorithm.exact ? &question.algorithm : nullptr, question.camera, question.layers},
                 question.more);
}

// Of an approximate algorithm: the structure of its own picture, if the candidate has it, too; else "".
std::string own_structure(const DiagnosisQuestion& question, const Judgement& layers, const Picture& right) {
    if (question.algorithm.exact || layers.mistakes.empty()) return "";
    const Judgement own = layers_of(question, right.targets[0]);
    for (const std::string& mistake : layers.mistakes)
        if (std::ranges::find(own.mistakes, mistake) != own.mistakes.end()) return mistake;
    return "";
}

void ask_layers(const DiagnosisQuestion& question, const Picture& right, Diagnosis& found) {
    const auto colors = std::ranges::find(question.candidate.targets, Meaning::color, &TargetImage::meaning);
    if (found.is_blank || question.passes != nullptr || colors == question.candidate.targets.end() ||
        !has_layers(question.input) || is_decided(question, found))
        return;
    const Judgement layers = layers_of(question, *colors);
    const bool is_exact = found.findings.front().agreeing == found.pixels && !found.passes_contradict;
    const bool is_single = is_exact && found.findings.front().mistakes.size() == 1;
    found.structure_json = layers.json;
    if (const std::string own = own_structure(question, layers, right); !own.empty()) {
        found.structure = fmt::format("right but for rounding: {}, as {} does\n", own, question.algorithm.name);
        found.conclusion = Conclusion::right_structure;
    } else if (layers.is_right || (!is_single && (layers.is_explained || layers.is_undecided))) {
        found.structure = layers.text;
        found.conclusion = layers.is_right ? Conclusion::right_structure : Conclusion::unknown_mistake;
    } else if (is_single) {
        found.by_layers = layers.mistakes;
    } else if (!is_exact && !found.is_nearly) {
        found.forgotten = layers.forgotten;
        found.leads = layers.leads;
    }
    if (!found.structure.empty()) found.is_nearly = false;
}

}  // namespace

PictureDiagnosis diagnose_picture(const DiagnosisQuestion& question, const ShowProgress& emulations,
                                  const ShowProgress& pairs) {
    const MistakeRenderer renderer{question.input, question.algorithm,
                                   has_depth(question.candidate) ? Depths::made : Depths::left_out, question.limit};
    PictureDiagnosis result{.options = std::make_shared<const std::vector<Mistake>>(
                                allowed_options(question.algorithm, renderer.right_run(), question.more))};
    const MistakeImages images{renderer, emulations, *result.options};
    result.found = images.diagnose(question.candidate, question.tolerances, pairs, question.passes);
    ask_layers(question, renderer.right(), result.found);
    result.right = stored_like(renderer.right(), question.candidate, question.input.space);
    result.comparison = compare(result.right, question.candidate, question.tolerances);
    return result;
}

}  // namespace strata::oracle
