// tools/lab/probe/search/infer.cpp - decides for each field whether the device's answers determine it: inferred, open,
// broken or idle, by the scenes that its other values change (infer.h).
#include "tools/lab/probe/search/infer.h"

#include <fmt/format.h>

#include <algorithm>

#include "rasterizer/base/enum_values.h"

namespace strata::probe {

namespace {

// One of a field's scenes under one of its values: where it equals the device's picture, and where it equals that of
// the inferred profile.
struct ValueMatch {
    std::vector<bool> equal{}, as_found{};
};

bool decides(const Item& item, std::string_view key) {
    return std::ranges::find(item.decides, key) != item.decides.end();
}

template <class Has>
std::vector<std::size_t> items_that(const KitComparison& device, Has has) {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < device.count(); ++i)
        if (has(device.item(i))) numbers.push_back(i);
    return numbers;
}

Contradiction place_of(const Item& item, std::size_t place) {
    const auto width = static_cast<std::size_t>(item.width), area = width * static_cast<std::size_t>(item.height);
    const bool is_depth = place >= area;
    if (is_depth) place -= area;
    return {item.name, is_depth ? "depth" : "color", static_cast<int>(place % width), static_cast<int>(place / width)};
}

// The alternatives to the inferred value. For a guard band: a pixel less, a pixel more, twice as many, and the
// highest value, which means none.
std::vector<int> other_values(const ProfileField& f, int found) {
    std::vector<int> values = searched_values(f, found);
    values.erase(values.begin());
    if (f.key == "raster.guard_band_px")
        for (const int value : {found - 1, found + 1, 2 * found, f.highest})
            if (value >= f.lowest && value <= f.highest && value != found) values.push_back(value);
    return values;
}

class Evidence {
  public:
    Evidence(const KitComparison& device, const DeviceProfile& found) : device_{device}, found_{found} {
        for (std::size_t i = 0; i < device.count(); ++i) {
            drawn_.push_back(device.drawn(found, i));
            equal_.push_back(device.equal(drawn_.back(), i));
        }
    }
    [[nodiscard]] const std::vector<bool>& equal(std::size_t item) const { return equal_[item]; }

    [[nodiscard]] FieldFinding of(const ProfileField& f) {
        FieldFinding finding{.key = std::string{f.key}, .value = pipeline::text_of(f, found_)};
        if (!matters(f.key, found_)) {
            finding.state = FieldState::idle;
            finding.reason = "has no effect next to the other values";
            return finding;
        }
        const std::vector<std::size_t> items =
            items_that(device_, [&](const Item& item) { return decides(item, f.key); });
        if (items.empty()) {
            finding.reason = "the device drew none of its scenes";
            return finding;
        }
        const FieldFinding none = finding;
        count(f, items, finding);
        if (finding.state != FieldState::open) return finding;
        FieldFinding of_all = none;  // other scenes may show what its own do not, next to these values of other fields
        count(f, items_that(device_, [&](const Item& item) { return can_change(f.key, item); }), of_all);
        return of_all.state == FieldState::open ? finding : of_all;
    }

    // The best single change for every item, among those examined by `of`.
    struct Change {
        std::string text{};
        std::uint64_t equal = 0;
    };
    [[nodiscard]] Change nearest(std::size_t item) const {
        const auto found = changes_.find(item);
        return found == changes_.end() ? Change{} : found->second;
    }

  private:
    // k of n for every value, over the positions where at least one of them differs from the inferred one.
    void count(const ProfileField& f, const std::vector<std::size_t>& items, FieldFinding& finding) {
        std::vector<DeviceProfile> others;
        for (const int value : other_values(f, f.value(found_))) {
            DeviceProfile other = found_;
            f.set(other, value);
            if (is_valid(other)) others.push_back(std::move(other));
        }
        if (others.empty()) {
            finding.state = FieldState::idle;
            finding.reason = "no other value goes with the other fields";
            return;
        }
        std::vector<std::uint64_t> agree(others.size());
        for (const std::size_t item : items) {
            std::vector<ValueMatch> hypotheses;
            for (const DeviceProfile& other : others) {
                hypotheses.push_back(hypothesis(other, item));
                note_change(item, hypotheses.back().equal, fmt::format("{}={}", f.key, pipeline::text_of(f, other)));
            }
            count_item(item, hypotheses, agree, finding);
        }
        for (std::size_t v = 0; v < others.size(); ++v)
            finding.runners_up.push_back({pipeline::text_of(f, others[v]), agree[v]});
        std::ranges::stable_sort(finding.runners_up, std::ranges::greater{}, &ValueCount::agree);
        conclude(finding);
        explain_coverage(f, others, items, finding);
    }

    // A value that explains fewer pixels than another, but whose coverage agrees at more pixels, is the one that was
    // chosen (search.cpp).
    void explain_coverage(const ProfileField& f, const std::vector<DeviceProfile>& others,
                          const std::vector<std::size_t>& items, FieldFinding& finding) const {
        if (finding.runners_up.empty() || finding.runners_up.front().agree <= finding.agree) return;
        const ValueCount& best = finding.runners_up.front();
        const auto same = [&](const DeviceProfile& other) { return pipeline::text_of(f, other) == best.value; };
        const DeviceProfile& other = *std::ranges::find_if(others, same);
        std::uint64_t own = 0, its = 0;
        for (const std::size_t item : items) {
            own += coverage_wrong(drawn_[item], item);
            its += coverage_wrong(device_.drawn(other, item), item);
        }
        if (own >= its) return;
        finding.state = FieldState::broken;
        finding.reason =
            fmt::format("{} explains more pixels, but which are covered in {} fewer", best.value, its - own);
    }

    [[nodiscard]] std::uint64_t coverage_wrong(const Reply& drawn, std::size_t item) const {
        const Answer& own = device_.answer(item);
        return drawn.answer ? difference(own, *drawn.answer).coverage : own.color.codes.size();
    }

    [[nodiscard]] ValueMatch hypothesis(const DeviceProfile& profile, std::size_t item) const {
        const Reply drawn = device_.drawn(profile, item);
        ValueMatch result{.equal = device_.equal(drawn, item)};
        if (drawn.answer && drawn_[item].answer)
            result.as_found = equal_values(*drawn.answer, *drawn_[item].answer);
        else
            result.as_found.assign(result.equal.size(), false);
        return result;
    }

    void count_item(std::size_t item, const std::vector<ValueMatch>& others, std::vector<std::uint64_t>& agree,
                    FieldFinding& finding) const {
        const std::vector<bool>& own = equal_[item];
        for (std::size_t place = 0; place < own.size(); ++place) {
            if (std::ranges::all_of(others, [&](const ValueMatch& h) { return h.as_found[place]; })) continue;
            ++finding.places;
            finding.agree += own[place] ? 1 : 0;
            if (!own[place] && !finding.broken) finding.broken = place_of(device_.item(item), place);
            for (std::size_t v = 0; v < others.size(); ++v) agree[v] += others[v].equal[place] ? 1 : 0;
        }
    }

    static void conclude(FieldFinding& finding) {
        if (finding.places == 0) {
            finding.reason = "every pixel that the device drew is the same by all its values";
            return;
        }
        if (!finding.runners_up.empty() && finding.runners_up.front().agree >= finding.agree) {
            finding.reason = finding.runners_up.front().value + " explains as many pixels";
            return;
        }
        finding.state = finding.agree < finding.places ? FieldState::broken : FieldState::inferred;
    }

    void note_change(std::size_t item, const std::vector<bool>& equal, const std::string& text) {
        const auto agrees = static_cast<std::uint64_t>(std::ranges::count(equal, true));
        Change& best = changes_[item];
        if (agrees > best.equal) best = {text, agrees};
    }

    const KitComparison& device_;
    const DeviceProfile& found_;
    std::vector<Reply> drawn_{};
    std::vector<std::vector<bool>> equal_{};
    std::map<std::size_t, Change> changes_{};
};

std::vector<FieldFinding> findings(Evidence& evidence, const ProbePack& pack, const DeviceProfile& profile) {
    std::vector<FieldFinding> all;
    for (const ProfileField* f : probed_fields()) all.push_back(evidence.of(*f));
    for (const Unprobed& f : unprobed_fields())
        all.push_back({.key = std::string{f.key},
                       .value = pipeline::text_of(field(f.key), profile),
                       .state = FieldState::unprobed,
                       .reason = std::string{f.reason}});
    for (const ProfileField& f : pipeline::profile_fields()) {
        if (!is_reported(f.key)) continue;
        const bool is_feature = f.key.starts_with("has_") || f.key.starts_with("max_");
        const bool is_stated = !is_feature || pack.device.contains(std::string{f.key});
        all.push_back({.key = std::string{f.key},
                       .value = pipeline::text_of(f, profile),
                       .state = is_stated ? FieldState::stated : FieldState::open,
                       .reason = is_stated ? "" : "the driver did not say"});
    }
    return all;
}

std::vector<Unexplained> unexplained(const KitComparison& device, const Evidence& evidence) {
    std::vector<Unexplained> all;
    for (std::size_t i = 0; i < device.count(); ++i) {
        const std::vector<bool>& equal = evidence.equal(i);
        const auto wrong = std::ranges::find(equal, false);
        if (wrong == equal.end()) continue;
        Unexplained one{.item = device.item(i).name,
                        .tally = {static_cast<std::uint64_t>(std::ranges::count(equal, true)), equal.size()},
                        .first = place_of(device.item(i), static_cast<std::size_t>(wrong - equal.begin()))};
        const auto change = evidence.nearest(i);
        if (change.equal > one.tally.equal) {
            one.nearest = change.text;
            one.left = one.tally.all - change.equal;
        }
        all.push_back(std::move(one));
    }
    return all;
}

}  // namespace

Inference infer(const ProbePack& pack, const std::vector<Item>& items, YDirection y) {
    const KitComparison device{pack, items, y};
    Inference result{.profile = searched(device, pack), .orientation = y};
    // The search begins with a built-in device, whose values of unprobed fields say nothing about this one.
    for (const Unprobed& f : unprobed_fields()) field(f.key).set(result.profile, field(f.key).value(DeviceProfile{}));
    result.profile.origin = origin_of(y);
    result.profile.name = "inferred";
    result.profile.description = fmt::format("inferred from the answers of: {}", pack.made_by).substr(0, 1000);
    Evidence evidence{device, result.profile};
    result.fields = findings(evidence, pack, result.profile);
    result.unexplained = unexplained(device, evidence);
    for (std::size_t i = 0; i < device.count(); ++i) {
        const std::vector<bool>& equal = evidence.equal(i);
        result.tally += {static_cast<std::uint64_t>(std::ranges::count(equal, true)), equal.size()};
    }
    if (const auto found = pack.answers.find(y); found != pack.answers.end())
        for (const auto& [item, reply] : found->second)
            if (!reply.answer) result.missing.emplace_back(item, reply.refusal);
    return result;
}

std::string_view name(FieldState state) noexcept { return enum_name(state); }

}  // namespace strata::probe
