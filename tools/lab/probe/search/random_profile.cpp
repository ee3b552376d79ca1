// tools/lab/probe/search/random_profile.cpp - draws the values of a random device (random_profile.h), on which tests
// check that `strata infer` finds a profile from its pictures alone.
#include "tools/lab/probe/search/random_profile.h"

#include <fmt/format.h>

#include "tools/lab/probe/kit/random_generator.h"

namespace strata::probe {

namespace {

int random_value(const ProfileField& f, RandomGenerator& random) {
    if (f.key != "raster.guard_band_px") return f.lowest + f.step * random.below((f.highest - f.lowest) / f.step + 1);
    const int power = 512 << random.below(10);
    return power + random.below(power);
}

}  // namespace

DeviceProfile random_profile(int number) {
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
