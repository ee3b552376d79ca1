#include "tools/probe/comparison.h"

#include <algorithm>

#include "tools/probe/draw_item.h"

namespace strata::probe {

namespace {

using pipeline::ChannelType;
using pipeline::Image;

bool is_nan(std::uint32_t code, ChannelType type) {
    if (type == ChannelType::half) return (code & 0x7fffu) > 0x7c00u;
    return type == ChannelType::single && (code & 0x7fffffffu) > 0x7f800000u;
}

void add_places(const Image& a, const Image& b, std::vector<bool>& places) {
    const ChannelType type = pipeline::info(a.format).type;
    const auto channels = static_cast<std::size_t>(a.channels());
    for (std::size_t i = 0; i < a.codes.size(); i += channels) {
        bool same = true;
        for (std::size_t c = i; c < i + channels; ++c)
            same = same && (a.codes[c] == b.codes[c] || (is_nan(a.codes[c], type) && is_nan(b.codes[c], type)));
        places.push_back(same);
    }
}

bool is_covered(const Answer& answer, std::size_t pixel) {
    if (answer.depth)
        return answer.depth->codes[pixel] != rasterizer::max_code(pipeline::depth_format(answer.depth->format));
    const auto channels = static_cast<std::size_t>(answer.color.channels());
    const auto* const first = answer.color.codes.data() + pixel * channels;
    return std::any_of(first, first + channels, [](std::uint32_t code) { return code != 0; });
}

std::size_t place_count(const Answer& answer) {
    const auto area = [](const Image& image) {
        return image.codes.size() / static_cast<std::size_t>(image.channels());
    };
    return area(answer.color) + (answer.depth ? area(*answer.depth) : 0);
}

}  // namespace

std::vector<bool> equal_places(const Answer& a, const Answer& b) {
    std::vector<bool> places;
    places.reserve(place_count(a));
    add_places(a.color, b.color, places);
    if (a.depth) add_places(*a.depth, *b.depth, places);
    return places;
}

Difference difference(const Answer& a, const Answer& b) {
    std::vector<bool> color, depth;
    add_places(a.color, b.color, color);
    if (a.depth) add_places(*a.depth, *b.depth, depth);
    const auto differ = [](const std::vector<bool>& equal) {
        return static_cast<std::uint64_t>(std::ranges::count(equal, false));
    };
    Difference result{.pixels = color.size(), .depth = differ(depth), .color = differ(color)};
    for (std::size_t i = 0; i < color.size(); ++i)
        if (is_covered(a, i) != is_covered(b, i)) ++result.coverage;
    return result;
}

Comparison::Comparison(const ProbePack& pack, const std::vector<Item>& items, YDirection y) : y_{y} {
    const auto found = pack.answers.find(y);
    if (found == pack.answers.end()) return;
    for (const Item& item : items) {
        const auto reply = found->second.find(item.name);
        if (reply != found->second.end() && reply->second.answer) items_.push_back({&item, &*reply->second.answer});
    }
}

std::vector<std::size_t> Comparison::items_of(const std::vector<std::string_view>& beginnings) const {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < items_.size(); ++i)
        if (std::ranges::any_of(beginnings, [&](std::string_view b) { return items_[i].item->name.starts_with(b); }))
            numbers.push_back(i);
    return numbers;
}

Reply Comparison::drawn(const DeviceProfile& profile, std::size_t number) const {
    return draw_item(profile, *items_[number].item, y_);
}

std::vector<bool> Comparison::equal(const Reply& drawn, std::size_t number) const {
    const Answer& own = *items_[number].answer;
    if (!drawn.answer) return std::vector<bool>(place_count(own), false);
    return equal_places(own, *drawn.answer);
}

Tally Comparison::tally(const DeviceProfile& profile, const std::vector<std::size_t>& numbers) const {
    Tally sum;
    for (const std::size_t number : numbers) {
        const std::vector<bool> places = equal(drawn(profile, number), number);
        sum += {static_cast<std::uint64_t>(std::ranges::count(places, true)), places.size()};
    }
    return sum;
}

}  // namespace strata::probe
