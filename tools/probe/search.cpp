#include "tools/probe/search.h"

#include <algorithm>
#include <map>

#include "rasterizer/base/input_error.h"
#include "tools/probe/kit.h"

namespace strata::probe {

namespace {

struct Candidate {
    DeviceProfile profile;
    Tally tally{};
};

using Numbers = std::vector<std::size_t>;
using Keys = std::vector<std::string_view>;

bool is_perfect(const Tally& t) { return t.equal == t.all; }

// Coverage is searched before depth and colours: a start whose weights do not go with spans must not keep them out.
DeviceProfile without_weights_of_spans(DeviceProfile profile) {
    rasterizer::RasterRules& rules = profile.raster;
    if (rules.coverage != rasterizer::CoverageRule::float_spans) return profile;
    rules.color = rasterizer::ColorInterpolation::exact_plane;
    if (rules.depth_path == rasterizer::DepthPath::window_z) rules.depth_path = rasterizer::DepthPath::float32;
    return profile;
}

// All valid combinations of the fields from number `next` on. Fields that do not matter keep their values, and one that
// matters because of an earlier one is searched after it.
void combine(const Keys& keys, std::size_t next, DeviceProfile profile, std::vector<DeviceProfile>& to) {
    if (next == keys.size()) {
        profile = without_weights_of_spans(std::move(profile));
        if (is_valid(profile)) to.push_back(std::move(profile));
        return;
    }
    const ProfileField& f = field(keys[next]);
    if (!matters(f.key, profile)) return combine(keys, next + 1, std::move(profile), to);
    for (const int value : searched_values(f, f.value(profile))) {
        f.set(profile, value);
        combine(keys, next + 1, profile, to);
    }
}

// The best of each kind: of equal values of the first two fields. Earlier candidates win ties.
std::vector<Candidate> best_of_kinds(const Keys& keys, const std::vector<Candidate>& all, std::size_t most) {
    std::map<std::pair<int, int>, std::size_t> best;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const int first = field(keys[0]).value(all[i].profile);
        const int second = keys.size() > 1 ? field(keys[1]).value(all[i].profile) : 0;
        const auto [at, is_new] = best.try_emplace({first, second}, i);
        if (!is_new && all[i].tally.equal > all[at->second].tally.equal) at->second = i;
    }
    std::vector<std::size_t> order;
    for (const auto& [kind, i] : best) order.push_back(i);
    std::ranges::sort(order);
    std::ranges::stable_sort(order,
                             [&](std::size_t a, std::size_t b) { return all[a].tally.equal > all[b].tally.equal; });
    std::vector<Candidate> kept;
    for (const std::size_t i : order)
        if (kept.size() < most) kept.push_back(all[i]);
    return kept;
}

// Tries every value of `a` with every value of `b`. True if that gained.
bool improve(const Comparison& device, const Numbers& numbers, const Keys& pair, Candidate& best) {
    std::vector<DeviceProfile> tried;
    combine(pair, 0, best.profile, tried);
    bool gained = false;
    for (DeviceProfile& profile : tried) {
        const Tally tally = device.tally(profile, numbers);
        if (tally.equal <= best.tally.equal) continue;
        best = {std::move(profile), tally};
        gained = true;
    }
    return gained;
}

// Two fields at a time, until no pair gains.
void refine(const Comparison& device, const Numbers& numbers, const Keys& keys, Candidate& best) {
    for (bool gained = true; gained && !is_perfect(best.tally);) {
        gained = false;
        for (std::size_t a = 0; a < keys.size(); ++a)
            for (std::size_t b = a + 1; b < keys.size() && !is_perfect(best.tally); ++b)
                if (matters(keys[a], best.profile) || matters(keys[b], best.profile))
                    gained |= improve(device, numbers, {keys[a], keys[b]}, best);
    }
}

std::vector<Candidate> tallied(const Comparison& device, const Numbers& numbers, std::vector<DeviceProfile> profiles) {
    std::vector<Candidate> all;
    for (DeviceProfile& profile : profiles) {
        const Tally tally = device.tally(profile, numbers);
        all.push_back({std::move(profile), tally});
    }
    return all;
}

// The first of the best.
Candidate best_of(std::vector<Candidate> all) {
    return *std::ranges::max_element(all, {}, [](const Candidate& c) { return c.tally.equal; });
}

// Kinds that go on to all scenes.
constexpr std::size_t most_kinds = 8;

DeviceProfile search_group(const FieldGroup& group, const Comparison& device, const DeviceProfile& start) {
    const Numbers numbers = device.items_of(group.items);
    if (numbers.empty()) return start;
    std::vector<DeviceProfile> combinations;
    combine(group.joint, 0, start, combinations);
    if (combinations.size() <= 64 && group.refined.empty())
        return best_of(tallied(device, numbers, std::move(combinations))).profile;
    const std::vector<Candidate> sifted =
        best_of_kinds(group.joint, tallied(device, {numbers.front()}, std::move(combinations)), most_kinds);
    std::vector<Candidate> finalists;
    for (const Candidate& candidate : sifted) {
        Candidate final{candidate.profile, device.tally(candidate.profile, numbers)};
        refine(device, numbers, group.refined, final);
        // What the sifting scene left open, the others may tell.
        refine(device, numbers, group.joint, final);
        finalists.push_back(final);
        if (is_perfect(final.tally)) break;
    }
    return best_of(std::move(finalists)).profile;
}

// A guard band has thousands of values. The scenes have a triangle for each of some reaches (kit_clip.cpp): with a band
// that is too near some are cut that are whole, so the first of the best reaches is next to the true one. All values there
// are tried.
DeviceProfile search_guard_band(const Comparison& device, const DeviceProfile& start) {
    const Numbers numbers = device.items_of({"clip.guard-band"});
    if (numbers.empty() || !matters("raster.guard_band_px", start)) return start;
    std::vector<int> coarse = guard_reaches();
    coarse.push_back(field("raster.guard_band_px").highest);
    const auto with = [&](int guard) {
        Candidate candidate{start};
        candidate.profile.raster.guard_band_px = guard;
        candidate.tally = device.tally(candidate.profile, numbers);
        return candidate;
    };
    std::size_t nearest = 0;
    Candidate best = with(coarse[0]);
    for (std::size_t i = 1; i < coarse.size(); ++i) {
        Candidate candidate = with(coarse[i]);
        if (candidate.tally.equal > best.tally.equal) {
            best = std::move(candidate);
            nearest = i;
        }
    }
    const int first = coarse[nearest == 0 ? 0 : nearest - 1], last = coarse[std::min(nearest + 1, coarse.size() - 1)];
    for (int guard = first; guard <= last && !is_perfect(best.tally); ++guard) {
        Candidate candidate = with(guard);
        if (candidate.tally.equal > best.tally.equal) best = std::move(candidate);
    }
    return best.profile;
}

}  // namespace

DeviceProfile with_features(DeviceProfile profile, const ProbePack& pack) {
    for (const auto& [key, value] : pack.device.items()) {
        const auto fields = pipeline::profile_fields();
        const auto found = std::ranges::find(fields, std::string_view{key}, &ProfileField::key);
        const std::string place = "/probe/device/" + key;
        if (found == fields.end() || !(key.starts_with("has_") || key.starts_with("max_")))
            throw InputError("candidate.json", place, "a feature or a limit of a profile", key);
        const bool is_boolean = found->kind == pipeline::FieldKind::boolean;
        if (is_boolean ? !value.is_boolean() : !value.is_number_integer())
            throw InputError("candidate.json", place, is_boolean ? "true or false" : "a whole number", value.dump());
        const int number = is_boolean ? int{value.get<bool>()} : value.get<int>();
        found->set(profile, std::clamp(number, found->lowest, found->highest));
    }
    return profile;
}

DeviceProfile searched(const Comparison& device, const ProbePack& pack) {
    std::vector<DeviceProfile> starts;
    for (const DeviceProfile& profile : pipeline::builtin_profiles()) starts.push_back(with_features(profile, pack));
    DeviceProfile profile = best_of(tallied(device, device.items_of({""}), std::move(starts))).profile;
    for (const FieldGroup& group : field_groups()) profile = search_group(group, device, profile);
    return search_guard_band(device, profile);
}

}  // namespace strata::probe
