// Infers a profile from the answers of another one, and compares both on scenes of a generator that the kit does not
// use.
#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "tests/tools/lab/probe/random_profile.h"
#include "tools/lab/probe/kit/draw_item.h"
#include "tools/lab/probe/kit/kit.h"
#include "tools/lab/probe/kit/random_generator.h"
#include "tools/lab/probe/search/infer.h"

namespace strata::probe {

// The number behind NAME= among the arguments.
inline int setting(int argc, char** argv, const char* name, int otherwise) {
    const std::size_t length = std::strlen(name);
    for (int i = 1; i < argc; ++i)
        if (std::strncmp(argv[i], name, length) == 0 && argv[i][length] == '=') return std::atoi(argv[i] + length + 1);
    return otherwise;
}

struct RoundTrip {
    DeviceProfile truth{};
    Inference found{};
    Difference unseen{};
    // Of the unseen scenes with other state (`varied`).
    std::vector<std::string> open_but_visible{};
    // Unseen scenes that both profiles draw, and those that only one rejects.
    int drawn = 0, refused_by_one = 0;
    [[nodiscard]] bool is_equal() const { return unseen.is_none() && refused_by_one == 0; }
};

// The scene with another clear value, which is near the middle of two codes, another depth range and polygon offset.
inline Item varied(Item item, int number) {
    RandomGenerator random{static_cast<std::uint64_t>(number) + 50'000};
    for (float& channel : item.clear) channel = (static_cast<float>(random.below(255)) + 0.5f) / 255.0f;
    item.depth_near = random.below(2) == 0 ? 0.0f : 0.125f;
    item.depth_far = random.below(2) == 0 ? 1.0f : 0.875f;
    const float units = static_cast<float>(1 << random.below(26));
    for (Draw& draw : item.draws) draw.offset = {true, 0, random.below(2) == 0 ? units : -units};
    return item;
}

// The keys of open fields that have another equally good value, with which one of the scenes looks different.
inline std::vector<std::string> open_but_visible(const Inference& found, const std::vector<Item>& scenes,
                                                 YDirection y) {
    std::vector<std::string> keys;
    const auto is_visible = [&](const ProfileField& f, int value) {
        DeviceProfile other = found.profile;
        f.set(other, value);
        return is_valid(other) && std::ranges::any_of(scenes, [&](const Item& item) {
                   return draw_item(found.profile, item, y).answer != draw_item(other, item, y).answer;
               });
    };
    for (const FieldFinding& finding : found.fields) {
        if (finding.state != FieldState::open || is_reported(finding.key)) continue;
        const ProfileField& f = field(finding.key);
        const auto is_possible = [&](int value) {
            DeviceProfile other = found.profile;
            f.set(other, value);
            const auto runner_up =
                std::ranges::find(finding.runners_up, pipeline::text_of(f, other), &ValueCount::value);
            return runner_up != finding.runners_up.end() && runner_up->agree >= finding.agree;
        };
        for (const int value : searched_values(f, f.value(found.profile)))
            if (is_possible(value) && is_visible(f, value)) {
                keys.push_back(finding.key);
                break;
            }
    }
    return keys;
}

// `y` is the y direction of the device's frame; the device's origin is set to match.
inline RoundTrip round_trip(const DeviceProfile& device, const std::vector<Item>& unseen, YDirection y) {
    RoundTrip trip{.truth = with_origin(device, origin_of(y)), .found = infer(answer(device, kit(), {y}), kit(), y)};
    for (const Item& item : unseen) {
        const Reply a = draw_item(trip.truth, item, y), b = draw_item(trip.found.profile, item, y);
        if (a.answer.has_value() != b.answer.has_value()) ++trip.refused_by_one;
        if (!a.answer || !b.answer) continue;
        ++trip.drawn;
        trip.unseen += difference(*a.answer, *b.answer);
    }
    std::vector<Item> others;
    for (std::size_t i = 0; i < unseen.size(); ++i) others.push_back(varied(unseen[i], static_cast<int>(i)));
    trip.open_but_visible = open_but_visible(trip.found, others, y);
    return trip;
}

// Fields with an effect whose inferred value differs. If all pictures are equal, the values are equivalent.
inline std::string other_values_of(const RoundTrip& trip) {
    std::string text;
    for (const ProfileField* f : probed_fields()) {
        const DeviceProfile& found = trip.found.profile;
        if (!matters(f->key, trip.truth) && !matters(f->key, found)) continue;
        if (f->value(trip.truth) == f->value(found)) continue;
        text += fmt::format(" {}={}({})", f->key, pipeline::text_of(*f, trip.truth), pipeline::text_of(*f, found));
    }
    return text;
}

}  // namespace strata::probe
