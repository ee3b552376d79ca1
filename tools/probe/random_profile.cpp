#include "tools/probe/random_profile.h"

#include <fmt/format.h>

#include "tools/probe/dice.h"

namespace strata::probe {

namespace {

int random_value(const ProfileField& f, Dice& dice) {
    if (f.key != "raster.guard_band_px") return f.lowest + f.step * dice.below((f.highest - f.lowest) / f.step + 1);
    const int power = 256 << dice.below(11);
    return power + dice.below(power);
}

}  // namespace

DeviceProfile random_profile(int number) {
    Dice dice{static_cast<std::uint64_t>(number) + 70'000};
    const auto& devices = pipeline::builtin_profiles();
    DeviceProfile profile = devices[static_cast<std::size_t>(dice.below(static_cast<int>(devices.size())))];
    const std::string features = profile.name;
    do {
        for (const ProfileField* f : probed_fields()) f->set(profile, random_value(*f, dice));
    } while (!is_valid(profile));
    profile.name = fmt::format("random{}", number);
    profile.description = fmt::format("rules at random, features and limits of {}", features);
    return profile;
}

}  // namespace strata::probe
