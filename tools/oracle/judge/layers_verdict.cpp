// tools/oracle/judge/layers_verdict.cpp - asks the verdict for one sample per pixel or for several (layers_verdict.h).
#include "tools/oracle/judge/layers_verdict.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "pipeline/device/profile.h"
#include "rasterizer/base/input_error.h"
#include "tools/oracle/judge/samples_verdict.h"
#include "tools/oracle/verdict/report.h"

namespace strata::oracle {

const TargetImage& colors_of(const Picture& candidate) {
    const auto found = std::ranges::find(candidate.targets, Meaning::color, &TargetImage::meaning);
    if (found == candidate.targets.end())
        throw InputError(candidate.file.empty() ? "candidate" : candidate.file, "targets", "colours", "none");
    return *found;
}

bool LayersVerdict::is_right() const noexcept { return single ? single->is_right() : samples->is_right(); }
bool LayersVerdict::is_undecided() const noexcept { return single && single->found.is_undecided(); }

bool LayersVerdict::is_explained() const noexcept {
    if (!single || is_right()) return false;
    const verdict::Verdict& found = single->found;
    return !found.finding.empty() || !found.explanations.empty() || found.alpha.state == verdict::AlphaState::wrong;
}

bool LayersVerdict::is_by_other_rules() const noexcept {
    return single ? single->other_profile != nullptr : !samples->description.empty();
}

std::uint64_t LayersVerdict::lost_at_ties() const noexcept {
    return single && single->found.equal_to.empty() ? single->found.right.lost_at_ties : 0;
}

const std::vector<std::uint32_t>& LayersVerdict::wrong_colors() const noexcept {
    return single ? single->found.right.wrong_pixels : samples->wrong_pixels;
}

verdict::Colors LayersVerdict::colors() const { return single ? single->formed.colors() : samples->form.colors(); }

std::vector<std::string> LayersVerdict::mistakes(const pipeline::DrawList& list) const {
    std::vector<std::string> all;
    if (!single || is_right()) return all;
    if (!single->found.finding.empty()) all.push_back(single->found.finding);
    for (const verdict::CheckedAccount& c : single->found.explanations)
        if (std::string words = description(c.account.rules, single->found.facts, list);
            std::ranges::find(all, words) == all.end())
            all.push_back(std::move(words));
    return all;
}

std::vector<std::string> LayersVerdict::leads(const pipeline::DrawList& list) const {
    return single ? leads_of(single->found, list) : std::vector<std::string>{};
}

void LayersVerdict::drop_leads() {
    if (single) single->found.leads.clear();
}

std::string LayersVerdict::text(const pipeline::DrawList& list) const {
    return single ? to_text(*single, list) : to_text(*samples);
}

nlohmann::ordered_json LayersVerdict::json(const peeling::FrameRequest& input) const {
    return single ? json_of(*single, input.list, input.profile.name) : json_of(*samples);
}

LayersVerdict judge_layers(const peeling::FrameRequest& input, const AskedPicture& asked) {
    const verdict::PictureQuestion question{.colors = colors_of(asked.candidate),
                                            .is_form_stated = asked.is_form_stated,
                                            .has_alpha = asked.has_alpha,
                                            .is_frame_linear = input.space == pipeline::ColorSpace::linear,
                                            .algorithm = asked.algorithm,
                                            .more = asked.more,
                                            .progress = asked.layers};
    LayersVerdict verdict;
    if (input.options.sampling.samples > 1)
        verdict.samples = judge_samples(input, question);
    else
        verdict.single = judge_picture(input, question);
    return verdict;
}

}  // namespace strata::oracle
