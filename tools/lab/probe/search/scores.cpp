// tools/lab/probe/search/scores.cpp - counts the pixels that a profile explains, and draws a scene again only if a
// field that can change it changed (scores.h).
#include "tools/lab/probe/search/scores.h"

#include <algorithm>

namespace strata::probe {

namespace {

std::uint64_t part_of(const Nearness& n, Part part) {
    switch (part) {
        case Part::coverage: return n.coverage;
        case Part::depth: return n.depth;
        case Part::color: return n.color;
        case Part::both: break;
    }
    return n.depth + n.color;
}

}  // namespace

Scores::Scores(const KitComparison& device) : device_{device} {
    for (std::size_t i = 0; i < device.count(); ++i) {
        std::vector<const ProfileField*>& fields = fields_.emplace_back();
        for (const ProfileField* f : probed_fields())
            if (probe::can_change(f->key, device.item(i))) fields.push_back(f);
    }
    for (std::size_t i = 0; i < device.count(); ++i) known_.emplace_back(&memory_);
    refuses_float_depth_ =
        device.reports_float_depth() && std::ranges::none_of(device.items_of({""}), [&](std::size_t n) {
            return device.item(n).depth == DepthFormat::d32f;
        });
}

const Nearness& Scores::of(const DeviceProfile& profile, std::size_t number) {
    std::pmr::vector<int> key;
    for (const ProfileField* f : fields_[number]) key.push_back(matters(f->key, profile) ? f->value(profile) : -1);
    const auto [at, is_new] = known_[number].try_emplace(std::move(key));
    if (!is_new) return at->second;
    ++drawn_;
    const Reply reply = device_.drawn(profile, number);
    if (reply.answer) at->second = nearness(device_.answer(number), *reply.answer);
    return at->second;
}

std::uint64_t Scores::points(const DeviceProfile& profile, std::size_t number, Part part) {
    const std::uint64_t points = part_of(of(profile, number), part);
    // One point less is enough to decide where nothing else distinguishes the two.
    const bool is_alike = profile.raster.depth_path == rasterizer::DepthPath::window_z || !refuses_float_depth_;
    return !is_alike && part == Part::both && device_.item(number).depth && points > 0 ? points - 1 : points;
}

std::uint64_t Scores::points(const DeviceProfile& profile, const Numbers& numbers, Part part, std::uint64_t bar) {
    std::uint64_t sum = 0, ahead = most(numbers, part);
    for (const std::size_t number : numbers) {
        ahead -= most(number, part);
        sum += points(profile, number, part);
        if (sum + ahead <= bar) return bar;
    }
    return sum;
}

std::uint64_t Scores::most(std::size_t number, Part part) const {
    const Item& item = device_.item(number);
    const auto area = static_cast<std::uint64_t>(item.width) * static_cast<std::uint64_t>(item.height);
    const std::uint64_t depth = item.depth ? area : 0;
    const std::uint64_t places = part == Part::both ? area + depth : part == Part::depth ? depth : area;
    return places * most_points;
}

std::uint64_t Scores::most(const Numbers& numbers, Part part) const {
    std::uint64_t sum = 0;
    for (const std::size_t number : numbers) sum += most(number, part);
    return sum;
}

bool Scores::can_change(std::string_view key, std::size_t number) const {
    return std::ranges::find(fields_[number], key, &ProfileField::key) != fields_[number].end();
}

}  // namespace strata::probe
