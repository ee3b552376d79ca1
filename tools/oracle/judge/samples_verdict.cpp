// tools/oracle/judge/samples_verdict.cpp - judges a resolved picture, and if it is wrong under the given sampling,
// tries other shadings and sample positions (samples_verdict.h).
#include "tools/oracle/judge/samples_verdict.h"

#include <limits>
#include <utility>
#include <vector>

#include "pipeline/device/check.h"
#include "pipeline/device/sample_points.h"
#include "tools/oracle/picture/pairs.h"
#include "tools/oracle/verdict/equal_picture.h"
#include "tools/oracle/verdict/other_rules.h"
#include "tools/oracle/verdict/picture_verdict.h"

namespace strata::oracle {

using verdict::Formed;
using verdict::OtherRules;
using verdict::PictureQuestion;
using verdict::ResolvedVerdict;
using verdict::SceneFragments;

verdict::Samples samples_by(const OtherRules& rules, const peeling::FrameRequest& input,
                            const std::optional<rasterizer::Rect>& within) {
    const int count = input.options.sampling.samples;
    if (auto lacking = pipeline::check_multisampling(rules.profile, count))
        throw pipeline::Refused{rules.profile, *std::move(lacking)};
    verdict::Samples samples;
    for (int number = 0; number < count; ++number) {
        peeling::RenderOptions options = within ? verdict::scissored(input.options, *within) : input.options;
        options.raster.interpolation = rules.interpolation;
        pipeline::set_sample(options.raster, rules.profile.sample_positions, count, static_cast<std::size_t>(number));
        options.sampling = {};
        samples.push_back(std::make_unique<SceneFragments>(input.on(rules.profile, options),
                                                           std::numeric_limits<std::uint64_t>::max()));
    }
    return samples;
}

namespace {

// The ways to read the picture's colours.
std::vector<Formed> forms_of(const PictureQuestion& asked) {
    const std::optional<TargetImage> codes = verdict::in_codes(asked.colors);
    const TargetImage& colors = codes ? *codes : asked.colors;
    std::vector<Formed> forms;
    auto multiplied = colors.alpha_form == AlphaForm::straight ? premultiplied(colors) : std::nullopt;
    const verdict::ChannelUse use{.has_alpha = asked.has_alpha,
                                  .is_encoded = asked.is_frame_linear && colors.holds_encoded};
    if (!multiplied || !asked.is_form_stated)
        forms.push_back({.target = colors, .use = use, .is_chosen = multiplied.has_value()});
    if (multiplied) forms.push_back({.target = *std::move(multiplied), .use = use, .is_chosen = !asked.is_form_stated});
    if (multiplied) forms.back().use.is_divided = true;
    return forms;
}

bool is_better(const ResolvedVerdict& a, const ResolvedVerdict& b) {
    return std::pair{a.wrong_pixels.size(), a.alpha.wrong_pixels.size()} <
           std::pair{b.wrong_pixels.size(), b.alpha.wrong_pixels.size()};
}

}  // namespace

std::optional<ResolvedVerdict> right_samples_by(const OtherRules& rules, const peeling::FrameRequest& input,
                                                const verdict::Colors& candidate,
                                                const std::vector<std::uint32_t>& wrong) {
    if (pipeline::sample_points(rules.profile.sample_positions, input.options.sampling.samples).empty())
        return std::nullopt;
    try {
        const rasterizer::Rect part = verdict::most_wrong(wrong, candidate.width());
        if (!right_resolved(samples_by(rules, input, part), candidate, wrong, part)) return std::nullopt;
        return right_resolved(samples_by(rules, input), candidate, wrong);
    } catch (const pipeline::Refused&) {
        return std::nullopt;
    }
}

ResolvedVerdict judge_samples(const peeling::FrameRequest& input, const PictureQuestion& question) {
    ResolvedVerdict verdict;
    const verdict::Samples given = samples_by({"", input.profile, input.options.raster.interpolation}, input);
    for (Formed& form : forms_of(question)) {
        ResolvedVerdict found = judge_resolved(given, form.colors());
        if (!verdict.form.target.codes.empty() && !is_better(found, verdict)) continue;
        verdict = std::move(found);
        verdict.form = std::move(form);
        verdict.by = "the rules of profile " + input.profile.name;
        if (verdict.is_right()) return verdict;
    }
    const rasterizer::Rect part = verdict::most_wrong(wrong_pixels(verdict), question.colors.width);
    if (const std::string name = equal_algorithm(input, question, part); !name.empty()) {
        verdict.equal_to = name;
        verdict.wrong_pixels.clear();
        verdict.wrong_at_edges = 0;
        verdict.alpha.state = verdict::AlphaState::absent;
        verdict.alpha.wrong_pixels.clear();
        return verdict;
    }
    // Rules decide about coverage and colours: another alpha has another cause.
    const std::vector<std::uint32_t> wrong = verdict.wrong_pixels;
    if (wrong.empty()) return verdict;
    const std::vector<OtherRules> others = verdict::other_rules(input, question.more);
    for (const OtherRules& other : others) {
        const auto tried = static_cast<double>(&other - others.data());
        if (question.progress) question.progress(tried / static_cast<double>(others.size()));
        auto found = right_samples_by(other, input, verdict.form.colors(), wrong);
        if (!found) continue;
        found->form = std::move(verdict.form);
        found->by = other.name;
        found->description = description(other, input.profile.name, wrong.size());
        return *std::move(found);
    }
    return verdict;
}

}  // namespace strata::oracle
