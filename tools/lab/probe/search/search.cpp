// tools/lab/probe/search/search.cpp - searches for the best profile group by group: all combinations on the first
// scenes, then single changes on all scenes, then repairs (search.h).
#include "tools/lab/probe/search/search.h"

#include <algorithm>
#include <map>

#include "rasterizer/base/input_error.h"
#include "tools/lab/probe/search/guard_band_search.h"
#include "tools/lab/probe/search/scores.h"

namespace strata::probe {

namespace {

struct ScoredProfile {
    DeviceProfile profile;
    std::uint64_t points = 0;
};

using Keys = std::vector<std::string_view>;

// Coverage is searched before depth and colours: a start whose rules are inconsistent with spans must not exclude them.
DeviceProfile with_rules_of_spans(DeviceProfile profile) {
    rasterizer::RasterRules& rules = profile.raster;
    if (rules.coverage != rasterizer::CoverageRule::float_spans) return profile;
    rules.color = rasterizer::ColorInterpolation::exact_plane;
    rules.y_axis = rasterizer::YAxis::memory;
    if (rules.viewport == rasterizer::ViewportArithmetic::half_pixel_first)
        rules.viewport = rasterizer::ViewportArithmetic::separate;
    if (rules.depth_path == rasterizer::DepthPath::window_z) rules.depth_path = rasterizer::DepthPath::float32;
    if (rules.hypothesis.window_z == rasterizer::WindowZRule::chip)
        rules.hypothesis.window_z = rasterizer::WindowZRule::exact;
    return profile;
}

// All valid combinations of the fields from index `next` on. Fields without effect keep their values, and one that has
// an effect because of an earlier one is searched after it.
void combine(const Keys& keys, std::size_t next, DeviceProfile profile, std::vector<DeviceProfile>& to) {
    if (next == keys.size()) {
        profile = with_rules_of_spans(std::move(profile));
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

// The scenes and the part of their pictures that a search compares.
struct ScoredItems {
    Scores& scores;
    Numbers numbers;
    Part part;
    [[nodiscard]] std::uint64_t points(const DeviceProfile& profile, std::uint64_t bar = 0) const {
        return scores.points(profile, numbers, part, bar);
    }
    [[nodiscard]] bool is_perfect(const ScoredProfile& c) const { return c.points == scores.most(numbers, part); }
};

// The best candidate of each kind, which is given by the values of the first two fields. Earlier candidates win ties.
std::vector<ScoredProfile> best_of_kinds(const Keys& keys, const std::vector<ScoredProfile>& all, std::size_t most) {
    std::map<std::pair<int, int>, std::size_t> best;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const int first = field(keys[0]).value(all[i].profile);
        const int second = keys.size() > 1 ? field(keys[1]).value(all[i].profile) : 0;
        const auto [at, is_new] = best.try_emplace({first, second}, i);
        if (!is_new && all[i].points > all[at->second].points) at->second = i;
    }
    std::vector<std::size_t> order;
    for (const auto& [kind, i] : best) order.push_back(i);
    std::ranges::sort(order);
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return all[a].points > all[b].points; });
    std::vector<ScoredProfile> kept;
    for (const std::size_t i : order)
        if (kept.size() < most) kept.push_back(all[i]);
    return kept;
}

// Tries all values of these fields together. True if one is better.
bool improve(const ScoredItems& view, const Keys& keys, ScoredProfile& best) {
    std::vector<DeviceProfile> tried;
    combine(keys, 0, best.profile, tried);
    bool gained = false;
    for (DeviceProfile& profile : tried) {
        const std::uint64_t points = view.points(profile, best.points);
        if (points <= best.points) continue;
        best = {std::move(profile), points};
        gained = true;
    }
    return gained;
}

// A field that cannot change any of the scenes, or has no effect, need not be tried by itself; together with a second
// one it may have an effect.
bool is_of_use(const ScoredItems& view, std::string_view key) {
    return std::ranges::any_of(view.numbers, [&](std::size_t n) { return view.scores.can_change(key, n); });
}

// One field at a time, until none gains; then two at a time, and again.
void refine(const ScoredItems& view, const Keys& all, ScoredProfile& best) {
    Keys keys;
    for (const std::string_view key : all)
        if (is_of_use(view, key) && std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
    for (bool gained = true; gained && !view.is_perfect(best);) {
        gained = false;
        for (const std::string_view key : keys)
            if (matters(key, best.profile)) gained |= improve(view, {key}, best);
        if (gained) continue;
        for (std::size_t a = 0; a < keys.size(); ++a)
            for (std::size_t b = 0; b < keys.size() && !view.is_perfect(best); ++b)
                if (a != b && matters(keys[a], best.profile) && (a < b || !matters(keys[b], best.profile)))
                    gained |= improve(view, {keys[a], keys[b]}, best);
    }
}

std::vector<ScoredProfile> scored(const ScoredItems& view, std::vector<DeviceProfile> profiles) {
    std::vector<ScoredProfile> all;
    for (DeviceProfile& profile : profiles) {
        const std::uint64_t points = view.points(profile);
        all.push_back({std::move(profile), points});
    }
    return all;
}

// The number of kinds that are continued on all scenes.
constexpr std::size_t most_kinds = 6;

DeviceProfile search_group(const FieldGroup& group, Scores& scores, const DeviceProfile& start) {
    const ScoredItems view{scores, scores.device().items_of(group.items), group.part};
    if (view.numbers.empty()) return start;
    const ScoredItems first{scores, {view.numbers.front()}, group.part};
    std::vector<DeviceProfile> combinations;
    combine(group.joint, 0, start, combinations);
    if (combinations.empty()) return start;
    Keys keys = group.joint;
    keys.insert(keys.end(), group.refined.begin(), group.refined.end());
    ScoredProfile best{start, view.points(start)};
    for (const ScoredProfile& sifted : best_of_kinds(group.joint, scored(first, std::move(combinations)), most_kinds)) {
        ScoredProfile one = sifted;
        refine(first, keys, one);
        one.points = view.points(one.profile);
        refine(view, keys, one);
        if (one.points > best.points) best = std::move(one);
        if (view.is_perfect(best)) break;
    }
    return best.profile;
}

void search_guard_band(const ScoredItems& view, BandSearch& bands, ScoredProfile& best) {
    if (!matters("raster.guard_band_px", best.profile) || view.is_perfect(best)) return;
    best.profile.raster.guard_band_px = bands.best(best.profile, view.numbers, view.part);
    best.points = view.points(best.profile);
}

// A guard band close to the frame clips like the view volume: whether there is one is known only after the search.
DeviceProfile search_clip(const FieldGroup& group, BandSearch& bands, const DeviceProfile& start) {
    Scores& scores = bands.scores;
    const ScoredItems view{scores, scores.device().items_of(group.items), group.part};
    DeviceProfile found = search_group(group, scores, start);
    ScoredProfile best{found, view.points(found)};
    found.raster.clip = rasterizer::ClipVolume::guard_band;
    found.raster.guard_band_px = field("raster.guard_band_px").highest;
    ScoredProfile other{found, view.points(found)};
    search_guard_band(view, bands, other);
    refine(view, group.joint, other);
    search_guard_band(view, bands, other);
    return other.points > best.points ? other.profile : best.profile;
}

// Tries the fields that can change a scene still unexplained after the groups, until the whole kit gains no more.
DeviceProfile repaired(BandSearch& bands, const DeviceProfile& start) {
    Scores& scores = bands.scores;
    ScoredItems all{scores, scores.device().items_of({""}), Part::both};
    ScoredProfile best{start, all.points(start)};
    const auto is_explained = [&](std::size_t n) {
        return scores.points(best.profile, n, Part::both) == scores.most(n, Part::both);
    };
    for (std::uint64_t before = 0; before != best.points && !all.is_perfect(best);) {
        before = best.points;
        // The unexplained scenes come first, because they reveal a worse profile sooner.
        std::ranges::stable_partition(all.numbers, [&](std::size_t n) { return !is_explained(n); });
        ScoredItems wrong{scores, {}, Part::both};
        for (const std::size_t n : all.numbers)
            if (!is_explained(n)) wrong.numbers.push_back(n);
        Keys keys;
        for (const ProfileField* f : probed_fields())
            if (is_of_use(wrong, f->key)) keys.push_back(f->key);
        refine(all, keys, best);
        search_guard_band(all, bands, best);
    }
    return best.profile;
}

// All groups one after another, starting from one device.
ScoredProfile searched_from(BandSearch& bands, DeviceProfile profile) {
    Scores& scores = bands.scores;
    for (const FieldGroup& group : field_groups())
        profile = group.name == "clip" ? search_clip(group, bands, profile) : search_group(group, scores, profile);
    profile = repaired(bands, profile);
    const ScoredItems all{scores, scores.device().items_of({""}), Part::both};
    return {profile, all.points(profile)};
}

constexpr std::size_t most_starts = 3;

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

DeviceProfile covered_first(const KitComparison& device, const DeviceProfile& start) {
    Scores scores{device};
    const Numbers all = device.items_of({""});
    const ScoredItems coverage{scores, all, Part::coverage}, both{scores, all, Part::both};
    std::vector<DeviceProfile> tried{start};
    if (coverage.points(start) == scores.most(all, Part::coverage)) return start;
    combine({"raster.clip", "raster.z_clip", "raster.w_clip", "raster.viewport"}, 0, start, tried);
    return *std::ranges::max_element(tried, {}, [&](const DeviceProfile& profile) {
        return std::pair{coverage.points(profile), both.points(profile)};
    });
}

DeviceProfile searched(const KitComparison& device, const ProbePack& pack) {
    Scores scores{device};
    const ScoredItems all{scores, device.items_of({""}), Part::both};
    std::vector<DeviceProfile> starts;
    for (const DeviceProfile& profile : pipeline::builtin_profiles()) starts.push_back(with_features(profile, pack));
    std::vector<ScoredProfile> ranked = scored(all, std::move(starts));
    std::ranges::stable_sort(ranked, std::ranges::greater{}, &ScoredProfile::points);
    ScoredProfile best = ranked.front();
    BandSearch bands{scores};
    for (std::size_t i = 0; i < std::min(most_starts, ranked.size()) && !all.is_perfect(best); ++i) {
        ScoredProfile found = searched_from(bands, ranked[i].profile);
        if (found.points > best.points) best = std::move(found);
    }
    return all.is_perfect(best) ? best.profile : covered_first(device, best.profile);
}

}  // namespace strata::probe
