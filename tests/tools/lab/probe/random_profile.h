// tests/tools/lab/probe/random_profile.h - random devices: every rule that affects a pixel of the kit has a random
// value.
//
// Rule     Features and limits are those of a built-in device, because a driver reports them. Powers of two are equally
//          likely for a guard band; every other field has any of its values. Values are drawn until all are consistent
//          (fields.h).
#pragma once
#include <fmt/format.h>

#include "tools/lab/probe/kit/random_generator.h"
#include "tools/lab/probe/search/fields.h"

namespace strata::probe {

inline int random_value(const ProfileField& f, RandomGenerator& random) {
    if (f.key != "raster.guard_band_px") return f.lowest + f.step * random.below((f.highest - f.lowest) / f.step + 1);
    const int power = 512 << random.below(10);
    return power + random.below(power);
}

// A given number gives the same profile on every computer.
inline DeviceProfile random_profile(int number) {
    // unseen_scene adds 9,000: the two sequences differ for every pair of small numbers.
    RandomGenerator random{static_cast<std::uint64_t>(number) + 70'000};
    const auto& devices = pipeline::builtin_profiles();
    DeviceProfile profile = devices[static_cast<std::size_t>(random.below(static_cast<int>(devices.size())))];
    const std::string features = profile.name;
    do {
        for (const ProfileField* f : probed_fields()) f->set(profile, random_value(*f, random));
    } while (!is_valid(profile));
    profile.name = fmt::format("random{}", number);
    profile.description = fmt::format("rules at random, features and limits of {}", features);
    return profile;
}

}  // namespace strata::probe
