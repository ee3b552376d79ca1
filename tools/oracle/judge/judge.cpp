// tools/oracle/judge/judge.cpp - judges a candidate picture: asks for the verdict (picture_verdict.h, or
// samples_verdict.h for several samples per pixel), then which option of the view looks forgotten (judge.h).
#include "tools/oracle/judge/judge.h"

#include <algorithm>
#include <string_view>

#include "pipeline/device/profile.h"
#include "tools/oracle/judge/forgotten.h"
#include "tools/oracle/judge/samples_verdict.h"
#include "tools/oracle/verdict/picture_verdict.h"

namespace strata::oracle {

namespace {

// Fills in the sentence and the leads from the text: lines of leads begin with "  lead: ".
Judgement with_sentences(Judgement judgement) {
    constexpr std::string_view lead = "  lead: ";
    judgement.text = with_forgotten(judgement.text, judgement.forgotten);
    judgement.json = json_with_forgotten(judgement.json, judgement.forgotten);
    std::string_view rest = judgement.text;
    judgement.sentence = rest.substr(0, rest.find('\n'));
    while (!rest.empty()) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        if (line.starts_with(lead)) judgement.leads.emplace_back(line.substr(lead.size()));
        rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    }
    return judgement;
}

}  // namespace

Judgement judge(const peeling::FrameRequest& input, const AskedPicture& picture,
                std::span<const pipeline::DeviceProfile> more) {
    if (input.options.sampling.samples > 1) {
        const SamplesVerdict verdict = judge_samples(input, picture, more);
        Judgement judgement{.is_right = verdict.found.is_right(), .text = to_text(verdict), .json = to_json(verdict)};
        judgement.forgotten = forgotten_options(input, verdict, picture.camera);
        return with_sentences(std::move(judgement));
    }
    const verdict::PictureVerdict verdict =
        verdict::judge_picture(input, {.colors = picture.colors,
                                       .is_form_stated = picture.is_form_stated,
                                       .has_alpha = picture.has_alpha,
                                       .is_frame_linear = input.space == pipeline::ColorSpace::linear,
                                       .algorithm = picture.algorithm,
                                       .more = more,
                                       .progress = picture.progress});
    const verdict::Verdict& found = verdict.found;
    std::vector<std::string> mistakes;
    for (const verdict::CheckedAccount& c : found.explanations)
        mistakes.push_back(description(c.account.rules, found.facts, input.list));
    Judgement judgement{.is_right = found.is_right,
                        .is_undecided = found.is_undecided(),
                        .is_explained = !found.explanations.empty() || found.alpha.state == verdict::AlphaState::wrong,
                        .mistakes = std::move(mistakes),
                        .text = to_text(verdict, input.list),
                        .json = to_json(verdict, input.list, input.profile.name)};
    judgement.forgotten = forgotten_options(input, verdict, picture.camera);
    return with_sentences(std::move(judgement));
}

}  // namespace strata::oracle
