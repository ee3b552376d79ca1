// Infers a profile from the answers of another one, and compares both on scenes of a generator that the kit does not
// use.
#pragma once
#include <fmt/format.h>

#include "tools/probe/draw_item.h"
#include "tools/probe/infer.h"
#include "tools/probe/kit.h"
#include "tools/probe/random_profile.h"

namespace strata::probe {

struct RoundTrip {
    DeviceProfile truth{};
    Inference found{};
    Difference unseen{};
    // Unseen scenes that both profiles draw, and those that only one rejects.
    int drawn = 0, refused_by_one = 0;
    [[nodiscard]] bool is_equal() const { return unseen.is_none() && refused_by_one == 0; }
};

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
