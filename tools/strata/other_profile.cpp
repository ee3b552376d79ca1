#include "tools/strata/other_profile.h"

#include <fmt/format.h>

#include <vector>

#include "pipeline/device/check.h"
#include "tools/oracle/verdict/match.h"
#include "tools/oracle/verdict/sample.h"

namespace strata::tools {

namespace {

// The right structure's account, by fragments to the bit or off by units in the last place, if it leaves two codes of
// 255 open at most or the picture takes one at most.
std::optional<oracle::verdict::Checked> narrow_account(const oracle::verdict::SceneFragments& scene,
                                                       const oracle::verdict::Colors& candidate,
                                                       oracle::verdict::Sample& sample) {
    using namespace oracle::verdict;
    constexpr double most_open = 2;
    const Storage storage = storage_of(candidate.code());
    auto found = account_for(families(storage, {0, 0x1p-20}, Looseness::definite), {}, scene, candidate, sample);
    if (found && found->possible > most_open && found->observed > 1) found.reset();
    return found;
}

}  // namespace

std::string OtherProfile::sentence(const std::string& given, std::size_t wrong_pixels) const {
    return fmt::format("  by the rules of profile {}; by those of {} it would be wrong at {} pixel{}\n", profile->name,
                       given, wrong_pixels, wrong_pixels == 1 ? "" : "s");
}

std::optional<OtherProfile> right_by_other_profile(const oracle::RunInput& input, std::uint64_t bytes,
                                                   const oracle::verdict::Colors& candidate,
                                                   std::span<const pipeline::DeviceProfile> more) {
    using namespace oracle::verdict;
    constexpr std::size_t most_sampled = 2048;
    std::vector<pipeline::DeviceProfile> all{more.begin(), more.end()};
    const auto& built_in = pipeline::builtin_profiles();
    all.insert(all.end(), built_in.begin(), built_in.end());
    for (const pipeline::DeviceProfile& profile : all) {
        if (profile.name == input.profile.name) continue;
        OtherProfile other{
            .profile = std::make_unique<pipeline::DeviceProfile>(with_origin(profile, input.profile.origin)),
            .fragments = nullptr};
        try {
            other.fragments = std::make_unique<SceneFragments>(
                oracle::RunInput{input.list, input.view, *other.profile, input.options}, bytes);
        } catch (const pipeline::Refused&) {
            continue;
        }
        Sample sample = sampled(*other.fragments, candidate, most_sampled);
        auto right = narrow_account(*other.fragments, candidate, sample);
        if (!right) continue;
        other.verdict = {.is_right = true,
                         .width = other.fragments->width(),
                         .facts = facts_of(*other.fragments, sample),
                         .right = *std::move(right)};
        return other;
    }
    return std::nullopt;
}

}  // namespace strata::tools
