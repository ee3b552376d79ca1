#include "tools/strata/samples_verdict.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "pipeline/device/check.h"
#include "pipeline/device/sample_points.h"
#include "rasterizer/base/enum_values.h"
#include "tools/oracle/pairs.h"

namespace strata::tools {

using oracle::verdict::Formed;
using oracle::verdict::ResolvedVerdict;
using oracle::verdict::SceneFragments;
using pipeline::DeviceProfile;

namespace {

// The fragments of each sample by the rules of the profile.
oracle::verdict::Samples samples_of(const oracle::RunInput& input, const DeviceProfile& profile) {
    const int count = input.sampling.samples;
    if (auto lacking = pipeline::check_multisampling(profile, count))
        throw pipeline::Refused{profile, *std::move(lacking)};
    oracle::verdict::Samples samples;
    for (int number = 0; number < count; ++number) {
        peeling::RenderOptions options = input.options;
        pipeline::set_sample(options.raster, profile.sample_positions, count, static_cast<std::size_t>(number));
        samples.push_back(std::make_unique<SceneFragments>(oracle::RunInput{input.list, input.view, profile, options},
                                                           std::numeric_limits<std::uint64_t>::max()));
    }
    return samples;
}

// The ways to read the picture's colours.
std::vector<Formed> forms_of(const SamplesPicture& picture) {
    std::vector<Formed> forms;
    const bool may_be_straight = picture.colors.alpha_form == oracle::AlphaForm::straight;
    auto multiplied = may_be_straight ? premultiplied(picture.colors) : std::nullopt;
    const oracle::verdict::ChannelUse use{.has_alpha = picture.has_alpha};
    if (!multiplied || !picture.is_form_stated)
        forms.push_back({.target = picture.colors, .use = use, .is_chosen = multiplied.has_value()});
    if (multiplied)
        forms.push_back({.target = *std::move(multiplied), .use = use, .is_chosen = !picture.is_form_stated});
    if (multiplied) forms.back().use.is_divided = true;
    return forms;
}

bool is_better(const ResolvedVerdict& a, const ResolvedVerdict& b) {
    return std::pair{a.wrong_pixels.size(), a.alpha.wrong_pixels.size()} <
           std::pair{b.wrong_pixels.size(), b.alpha.wrong_pixels.size()};
}

struct OtherRules {
    std::string name;
    DeviceProfile profile;
};

// The profiles that differ from the given one, and the given one with other sample positions.
std::vector<OtherRules> other_rules(const DeviceProfile& given, std::span<const DeviceProfile> more) {
    std::vector<OtherRules> all;
    const auto add_profile = [&](const DeviceProfile& profile) {
        if (profile.name != given.name)
            all.push_back({"the rules of profile " + profile.name, with_origin(profile, given.origin)});
    };
    for (const DeviceProfile& profile : more) add_profile(profile);
    for (const DeviceProfile& profile : pipeline::builtin_profiles()) add_profile(profile);
    using pipeline::SamplePositions;
    for (const SamplePositions positions : enum_values<SamplePositions>) {
        if (positions == given.sample_positions) continue;
        const auto name = enum_names<SamplePositions>[static_cast<std::size_t>(positions)];
        all.push_back({fmt::format("the sample positions \"{}\"", name), given});
        all.back().profile.sample_positions = positions;
    }
    return all;
}

}  // namespace

SamplesVerdict judge_samples(const oracle::RunInput& input, const SamplesPicture& picture,
                             std::span<const DeviceProfile> more) {
    SamplesVerdict verdict{.given = input.profile.name};
    const oracle::verdict::Samples given = samples_of(input, input.profile);
    for (Formed& form : forms_of(picture)) {
        ResolvedVerdict found = judge_resolved(given, form.colors());
        if (!verdict.form.target.codes.empty() && !is_better(found, verdict.found)) continue;
        verdict.found = std::move(found);
        verdict.form = std::move(form);
        if (verdict.found.is_right()) return verdict;
    }
    // Rules decide about coverage and colours: another alpha has another cause.
    const std::vector<std::uint32_t> wrong = verdict.found.wrong_pixels;
    if (wrong.empty()) return verdict;
    for (const OtherRules& other : other_rules(input.profile, more)) {
        if (pipeline::sample_points(other.profile.sample_positions, input.sampling.samples).empty()) continue;
        try {
            auto found = right_resolved(samples_of(input, other.profile), verdict.form.colors(), wrong);
            if (!found) continue;
            verdict.wrong_by_given = wrong.size();
            verdict.found = *std::move(found);
            verdict.by = other.name;
            return verdict;
        } catch (const pipeline::Refused&) {
        }
    }
    return verdict;
}

std::string to_text(const SamplesVerdict& verdict) {
    std::string text = to_text(verdict.found, verdict.form.target.width) + verdict.form.description();
    if (!verdict.by.empty())
        text += fmt::format("  by {}; by those of {} it would be wrong at {} pixel{}\n", verdict.by, verdict.given,
                            verdict.wrong_by_given, verdict.wrong_by_given == 1 ? "" : "s");
    return text;
}

std::string to_json(const SamplesVerdict& verdict) {
    auto document = nlohmann::ordered_json::parse(to_json(verdict.found, verdict.form.target.width));
    if (verdict.form.is_chosen) document["colors"] = verdict.form.use.is_divided ? "straight" : "premultiplied";
    document["rules"] = verdict.by.empty() ? "the rules of profile " + verdict.given : verdict.by;
    return document.dump(2) + '\n';
}

}  // namespace strata::tools
