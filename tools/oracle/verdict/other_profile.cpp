// tools/oracle/verdict/other_profile.cpp - judges a wrong picture again with the rules of other profiles and the other
// origin (other_profile.h).
#include "tools/oracle/verdict/other_profile.h"

#include <algorithm>
#include <mutex>

#include "pipeline/device/check.h"
#include "tools/oracle/fragments/sample.h"
#include "tools/oracle/search/match.h"

namespace strata::oracle::verdict {

namespace {

Families definite(const Colors& candidate) {
    return families(storage_of(candidate.code()), {0, 0x1p-20}, Looseness::definite, candidate.use().is_divided);
}

// The explanation of the candidate as a right picture, with fragments that are equal or differ by a few units in the
// last place. It is returned only if it leaves at most two codes of 255 or few values possible, or if the candidate
// contains at most one code.
std::optional<CheckedAccount> narrow_account(const Families& some, const SceneFragments& scene, const Colors& candidate,
                                             Sample& sample) {
    constexpr double most_open = 2, most_bits = 4;  // codes; bits per pixel
    auto found = account_for(some, {}, scene, candidate, sample);
    if (!found || found->possible <= most_open || found->observed <= 1) return found;
    // For floats, the possible values may be far from the exact result and still be few.
    const bool are_few =
        !has_codes(storage_of(candidate.code())) && found->bits <= most_bits * static_cast<double>(found->covered);
    if (!are_few) found.reset();
    return found;
}

// So few wrong pixels may all be at edges, where the other profile explains some and another rasterizer the others.
constexpr std::size_t few_wrong = 16;

Sample sample_of(const SceneFragments& scene, const Colors& candidate, const auto& is_chosen) {
    Sample sample{scene.setting()};
    std::mutex mutex;
    scene.for_each_tile([&](const TileLists& tile) {
        for (std::size_t p = 0; p < tile.rect.area(); ++p) {
            const PixelList list = scene.at(tile, p);
            if (!is_chosen(list.x, list.y)) continue;
            const std::scoped_lock lock{mutex};
            sample.add(list, candidate.at(list.x, list.y));
        }
    });
    sample.sort();
    return sample;
}

// True if a definite hypothesis explains the rectangle. A hypothesis that fails there fails for the whole picture, so
// the rest need not be rendered.
bool may_be_right(const peeling::FrameRequest& input, std::uint64_t bytes, const Colors& candidate,
                  const rasterizer::Rect& rect) {
    const peeling::RenderOptions options = scissored(input.options, rect);
    const SceneFragments part{input.with(options), bytes};
    const Sample sample = sample_of(
        part, candidate, [&](int x, int y) { return x >= rect.x0 && x < rect.x1 && y >= rect.y0 && y < rect.y1; });
    return best_of(definite(candidate), {}, sample, WrongPixels::none).has_value();
}

// As right_narrowly, under these hypotheses.
std::optional<Verdict> right_under(const Families& some, const SceneFragments& scene, const Colors& candidate) {
    constexpr std::size_t most_sampled = 2048;
    Sample sample = sampled(scene, candidate, most_sampled);
    auto right = narrow_account(some, scene, candidate, sample);
    if (!right) return std::nullopt;
    Verdict verdict{
        .is_right = true, .width = scene.width(), .facts = facts_of(scene, sample), .right = *std::move(right)};
    verdict.alpha = check_alpha(scene, candidate, verdict.right.account.hypothesis);
    verdict.is_right = verdict.alpha.state != AlphaState::wrong;
    return verdict;
}

}  // namespace

std::string OtherProfile::description(const std::string& given, std::size_t wrong_pixels) const {
    return verdict::description(rules, given, wrong_pixels);
}

std::optional<Verdict> right_narrowly(const SceneFragments& scene, const Colors& candidate) {
    return right_under(definite(candidate), scene, candidate);
}

std::optional<OtherProfile> right_by_rules(const peeling::FrameRequest& input, OtherRules rules,
                                           const Colors& candidate, const std::vector<std::uint32_t>& wrong_pixels) {
    const std::uint64_t bytes = input.options.fragment_memory;
    OtherProfile other{.profile = std::make_unique<pipeline::DeviceProfile>(rules.profile), .fragments = nullptr};
    other.rules = std::move(rules);
    const peeling::FrameRequest by_other = input.on(*other.profile, input.options);
    try {
        if (!wrong_pixels.empty() &&
            !may_be_right(by_other, bytes, candidate, most_wrong(wrong_pixels, candidate.width())))
            return std::nullopt;
        other.fragments = std::make_unique<SceneFragments>(by_other, bytes);
    } catch (const pipeline::Refused&) {
        return std::nullopt;
    }
    auto right = right_narrowly(*other.fragments, candidate);
    if (!right && !wrong_pixels.empty() && wrong_pixels.size() <= few_wrong) {
        other.fragments->find_coverages();
        const auto is_wrong = [&](int x, int y) {
            return std::ranges::find(wrong_pixels, static_cast<std::uint32_t>(y * candidate.width() + x)) !=
                   wrong_pixels.end();
        };
        const Families held = holding(definite(candidate), sample_of(*other.fragments, candidate, is_wrong));
        if (!held.empty()) right = right_under(held, *other.fragments, candidate);
    }
    if (!right) return std::nullopt;
    other.verdict = *std::move(right);
    return other;
}

std::optional<OtherProfile> right_by_other_profile(const peeling::FrameRequest& input, const Colors& candidate,
                                                   const std::vector<std::uint32_t>& wrong_pixels,
                                                   std::span<const pipeline::DeviceProfile> more) {
    for (OtherRules& rules : other_rules(input, more))
        if (auto other = right_by_rules(input, std::move(rules), candidate, wrong_pixels)) return other;
    return std::nullopt;
}

}  // namespace strata::oracle::verdict
