// Does the kit show every rule that other scenes show? probe_reach [first=0] [count=8]: for that many random devices
// and each value of each field, prints what changes one of 40 unseen scenes and no scene of the kit; exits with status
// 1 if there is anything.
#include <fmt/format.h>

#include "rasterizer/base/numerics.h"
#include "tests/tools/lab/probe/round_trip.h"

using namespace strata::probe;

namespace {

// A device, and what it draws of some scenes.
struct Drawn {
    const DeviceProfile& device;
    YDirection y;
    const std::vector<Item>& items;
    std::vector<Reply> replies{};

    Drawn(const DeviceProfile& d, YDirection direction, const std::vector<Item>& all)
        : device{d}, y{direction}, items{all} {
        for (const Item& item : items) replies.push_back(draw_item(device, item, y));
    }
    [[nodiscard]] bool shows(std::string_view key, const DeviceProfile& other) const {
        for (std::size_t i = 0; i < items.size(); ++i)
            if (can_change(key, items[i]) && draw_item(other, items[i], y).answer != replies[i].answer) return true;
        return false;
    }
};

// The number of values of fields that only the unseen scenes show.
int missed_values(int number, const std::vector<Item>& unseen) {
    const auto y = number % 2 == 0 ? YDirection::up : YDirection::down;
    const DeviceProfile device = with_origin(random_profile(number), origin_of(y));
    const Drawn elsewhere{device, y, unseen}, in_kit{device, y, kit()};
    int missed = 0;
    for (const ProfileField* f : probed_fields()) {
        if (!matters(f->key, device)) continue;
        for (const int value : searched_values(*f, f->value(device))) {
            DeviceProfile other = device;
            f->set(other, value);
            if (value == f->value(device) || !is_valid(other) || !elsewhere.shows(f->key, other)) continue;
            if (in_kit.shows(f->key, other)) continue;
            ++missed;
            fmt::print("device {} ({}): no scene of the kit shows {}={}\n", number, device.description, f->key,
                       strata::pipeline::text_of(*f, other));
        }
    }
    return missed;
}

}  // namespace

int main(int argc, char** argv) {
    const int first = setting(argc, argv, "first", 0), count = setting(argc, argv, "count", 8);
    std::vector<Item> unseen = unseen_scenes(100, 20);
    for (int i = 0; i < 20; ++i) unseen.push_back(varied(unseen[static_cast<std::size_t>(i)], i));
    int missed = 0;
    for (int number = first; number < first + count; ++number) missed += missed_values(number, unseen);
    fmt::print("{} devices: {} values that the kit does not show\n", count, missed);
    return missed == 0 ? 0 : 1;
}
