// tools/lab/probe/search/comparison.cpp - counts the pixels of a scene at which a profile's coverage, depth and colour
// equal the device's answer (comparison.h).
#include "tools/lab/probe/search/comparison.h"

#include <algorithm>
#include <bit>

#include "tools/lab/probe/kit/draw_item.h"

namespace strata::probe {

namespace {

using pipeline::ChannelType;
using pipeline::Image;

bool is_nan(std::uint32_t code, ChannelType type) {
    if (type == ChannelType::half) return (code & 0x7fffu) > 0x7c00u;
    return type == ChannelType::single && (code & 0x7fffffffu) > 0x7f800000u;
}

// Calls `take` with the number of bits, 0 to 32, by which the codes of each position differ in the worst channel.
void each_place(const Image& a, const Image& b, auto take) {
    const ChannelType type = pipeline::info(a.format).type;
    const auto channels = static_cast<std::size_t>(a.channels());
    for (std::size_t i = 0; i < a.codes.size(); i += channels) {
        int off = 0;
        for (std::size_t c = i; c < i + channels; ++c) {
            const std::uint32_t one = a.codes[c], other = b.codes[c];
            if (one == other || (is_nan(one, type) && is_nan(other, type))) continue;
            off = std::max(off, static_cast<int>(std::bit_width(one > other ? one - other : other - one)));
        }
        take(off);
    }
}

void add_places(const Image& a, const Image& b, std::vector<bool>& places) {
    each_place(a, b, [&](int off) { places.push_back(off == 0); });
}

// Sums up the points of one image.
std::uint64_t points_of(const Image& a, const Image& b, std::uint64_t& equal) {
    std::uint64_t points = 0;
    each_place(a, b, [&](int off) {
        equal += off == 0 ? 1 : 0;
        points += static_cast<std::uint64_t>(off == 0 ? most_points : 32 - off);
    });
    return points;
}

bool is_covered(const Answer& answer, std::size_t pixel) {
    if (answer.depth)
        return answer.depth->codes[pixel] != rasterizer::max_code(pipeline::depth_format(answer.depth->format));
    const auto channels = static_cast<std::size_t>(answer.color.channels());
    const auto* const first = answer.color.codes.data() + pixel * channels;
    return std::any_of(first, first + channels, [](std::uint32_t code) { return code != 0; });
}

// Converts a depth stored as binary32 if the device's answer was read back as codes.
std::optional<Image> as_read(std::optional<Image> drawn, const std::optional<Image>& answer) {
    if (!drawn || drawn->format == answer->format || drawn->format != pipeline::Format::d32f) return drawn;
    const pipeline::DepthFormat format = pipeline::depth_format(answer->format);
    Image codes{answer->format, drawn->width, drawn->height};
    for (std::size_t i = 0; i < codes.codes.size(); ++i)
        codes.codes[i] = rasterizer::to_depth_code(std::bit_cast<float>(drawn->codes[i]), format,
                                                   rasterizer::DepthRounding::nearest);
    return codes;
}

std::size_t place_count(const Answer& answer) {
    const auto area = [](const Image& image) {
        return image.codes.size() / static_cast<std::size_t>(image.channels());
    };
    return area(answer.color) + (answer.depth ? area(*answer.depth) : 0);
}

}  // namespace

std::vector<bool> equal_values(const Answer& a, const Answer& b) {
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

Nearness nearness(const Answer& a, const Answer& b) {
    Nearness result{.places = place_count(a)};
    result.color = points_of(a.color, b.color, result.equal);
    if (a.depth) result.depth = points_of(*a.depth, *b.depth, result.equal);
    const std::size_t area = result.places / (a.depth ? 2 : 1);
    for (std::size_t i = 0; i < area; ++i)
        if (is_covered(a, i) == is_covered(b, i)) result.coverage += most_points;
    return result;
}

KitComparison::KitComparison(const ProbePack& pack, const std::vector<Item>& items, YDirection y) : y_{y} {
    const auto says = pack.device.find("has_d32f");
    reports_float_depth_ = says != pack.device.end() && says->is_boolean() && says->get<bool>();
    const auto found = pack.answers.find(y);
    if (found == pack.answers.end()) return;
    for (const Item& item : items) {
        const auto reply = found->second.find(item.name);
        if (reply != found->second.end() && reply->second.answer) items_.push_back({&item, &*reply->second.answer});
    }
}

std::vector<std::size_t> KitComparison::items_of(const std::vector<std::string_view>& beginnings) const {
    std::vector<std::size_t> numbers;
    for (const std::string_view beginning : beginnings)
        for (std::size_t i = 0; i < items_.size(); ++i)
            if (items_[i].item->name.starts_with(beginning) && std::ranges::find(numbers, i) == numbers.end())
                numbers.push_back(i);
    return numbers;
}

Reply KitComparison::drawn(const DeviceProfile& profile, std::size_t number) const {
    Reply reply = draw_item(profile, *items_[number].item, y_);
    if (reply.answer) reply.answer->depth = as_read(std::move(reply.answer->depth), items_[number].answer->depth);
    return reply;
}

std::vector<bool> KitComparison::equal(const Reply& drawn, std::size_t number) const {
    const Answer& own = *items_[number].answer;
    if (!drawn.answer) return std::vector<bool>(place_count(own), false);
    return equal_values(own, *drawn.answer);
}

Tally KitComparison::tally(const DeviceProfile& profile, const std::vector<std::size_t>& numbers) const {
    Tally sum;
    for (const std::size_t number : numbers) {
        const std::vector<bool> places = equal(drawn(profile, number), number);
        sum += {static_cast<std::uint64_t>(std::ranges::count(places, true)), places.size()};
    }
    return sum;
}

}  // namespace strata::probe
