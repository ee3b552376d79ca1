// tools/oracle/verdict/other_rules.cpp - lists the rules that a right port may follow without saying so, each with its
// words for the verdict (other_rules.h).
#include "tools/oracle/verdict/other_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "pipeline/device/sample_points.h"
#include "rasterizer/base/enum_values.h"

namespace strata::oracle::verdict {

using pipeline::DeviceProfile;
using pipeline::Origin;
using rasterizer::Interpolation;

namespace {

constexpr std::string_view shading_option(Interpolation interpolation) {
    switch (interpolation) {
        case Interpolation::sample: return "--shading sample";
        case Interpolation::centre: return "--shading pixel";
        case Interpolation::centroid: break;
    }
    return "--shading pixel --interpolate centroid";
}

class Lister {
  public:
    explicit Lister(const peeling::FrameRequest& given) : given_{given} {}

    // Adds the rules of a profile with either origin and every shading, but for those given.
    void add(const std::string& name, const DeviceProfile& profile) {
        const Interpolation own = given_.options.raster.interpolation;
        for (const Interpolation interpolation :
             {own, Interpolation::sample, Interpolation::centre, Interpolation::centroid}) {
            const bool is_own = interpolation == own;
            if (!is_own && !has_shadings()) continue;
            for (const Origin origin : {given_.profile.origin, other_origin()}) {
                OtherRules rules{name, with_origin(profile, origin), interpolation};
                const auto with = [&](std::string_view option) {
                    rules.name += fmt::format("{}{}", rules.name == name ? " with " : " ", option);
                };
                if (origin != given_.profile.origin)
                    with(origin == Origin::lower_left ? "--origin lower-left" : "--origin upper-left");
                if (!is_own) with(shading_option(interpolation));
                if (!is_known(rules)) all.push_back(std::move(rules));
            }
        }
    }

    std::vector<OtherRules> all{};

  private:
    // Programs that load other samples than their own have one shading.
    [[nodiscard]] bool has_shadings() const {
        return given_.options.sampling.samples > 1 && !given_.options.sampling.loads_others();
    }
    [[nodiscard]] Origin other_origin() const {
        return given_.profile.origin == Origin::lower_left ? Origin::upper_left : Origin::lower_left;
    }
    [[nodiscard]] bool is_known(const OtherRules& rules) const {
        return (rules.profile == given_.profile && rules.interpolation == given_.options.raster.interpolation) ||
               std::ranges::any_of(all, [&](const OtherRules& known) {
                   return known.profile == rules.profile && known.interpolation == rules.interpolation;
               });
    }

    const peeling::FrameRequest& given_;
};

}  // namespace

std::vector<OtherRules> other_rules(const peeling::FrameRequest& given, std::span<const DeviceProfile> more) {
    Lister lister{given};
    lister.add("the rules of profile " + given.profile.name, given.profile);
    const int samples = given.options.sampling.samples;
    using pipeline::SamplePositions;
    for (const SamplePositions positions : enum_values<SamplePositions>) {
        if (samples == 1 || pipeline::sample_points(positions, samples).empty()) continue;
        DeviceProfile profile = given.profile;
        profile.sample_positions = positions;
        const auto name = enum_name(positions);
        lister.add(fmt::format("the sample positions \"{}\"", name), profile);
    }
    for (const DeviceProfile& profile : more) lister.add("the rules of profile " + profile.name, profile);
    for (const DeviceProfile& profile : pipeline::builtin_profiles())
        if (profile.name != given.profile.name) lister.add("the rules of profile " + profile.name, profile);
    return lister.all;
}

std::string description(const OtherRules& rules, const std::string& given, std::size_t wrong_pixels) {
    const std::string those = rules.profile.name == given ? "those given" : "those of " + given;
    return fmt::format("  by {}; by {} it would be wrong at {} pixel{}\n", rules.name, those, wrong_pixels,
                       wrong_pixels == 1 ? "" : "s");
}

rasterizer::Rect most_wrong(const std::vector<std::uint32_t>& wrong_pixels, int width) {
    constexpr std::size_t few_wrong = 16;  // they may all be at edges that other rules explain in part
    const int side = wrong_pixels.size() <= few_wrong ? 8 : 32;
    std::map<std::pair<int, int>, std::size_t> count;
    for (const std::uint32_t pixel : wrong_pixels) {
        const int at = static_cast<int>(pixel);
        ++count[{at / width / side, at % width / side}];
    }
    const auto most = std::ranges::max_element(count, {}, [](const auto& square) { return square.second; });
    const auto [y, x] = most->first;
    return {x * side, y * side, (x + 1) * side, (y + 1) * side};
}

peeling::RenderOptions scissored(peeling::RenderOptions options, const rasterizer::Rect& part) {
    auto& scissor = options.raster.scissor;
    scissor = scissor ? rasterizer::intersection(*scissor, part) : part;
    return options;
}

}  // namespace strata::oracle::verdict
