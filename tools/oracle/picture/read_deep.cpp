#include "tools/oracle/picture/read_deep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>

#include "rasterizer/base/input_error.h"
#include "scenes/files/image_formats.h"

namespace strata::oracle {

namespace {

using scenes::StoredPart;

constexpr std::size_t most_samples = std::size_t{1} << 26;  // of all layers, padded

// Channels of one type, sample by sample.
struct Channels {
    Code code = Code::single;
    std::vector<scenes::ChannelLayout> places{};

    [[nodiscard]] std::uint32_t word(const StoredPart& part, std::size_t sample, std::size_t channel) const {
        std::uint32_t word = 0;
        std::memcpy(&word, &part.bytes[sample * pixel_bytes(part.header) + places[channel].offset],
                    size_of(places[channel].type));
        return word;
    }
};

Channels channels_of(const StoredPart& part, const std::vector<const char*>& names, const std::string& path) {
    Channels channels;
    for (const char* name : names)
        if (const auto place = find_channel(part.header, name)) channels.places.push_back(*place);
    for (const scenes::ChannelLayout& place : channels.places)
        if (place.type != channels.places[0].type || place.type == scenes::StoredType::word)
            throw InputError(path, "deep part", "channels of one type, HALF or FLOAT", "UINT or several types");
    if (!channels.places.empty() && channels.places[0].type == scenes::StoredType::half) channels.code = Code::half;
    return channels;
}

// The indices of a pixel's samples, nearest first.
std::vector<std::size_t> near_to_far(const StoredPart& part, const Channels& depth, std::size_t first,
                                     std::size_t count) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), first);
    if (depth.places.empty()) return order;
    const auto z = [&](std::size_t sample) {
        const double v = value(depth.code, depth.word(part, sample, 0));
        return v == v ? v : std::numeric_limits<double>::infinity();
    };
    std::ranges::stable_sort(order, {}, z);
    return order;
}

TargetImage empty_target(const StoredPart& part, const Channels& channels, std::size_t layer, Meaning meaning) {
    TargetImage target{.part = fmt::format("layer.{:03}", layer),
                       .name = meaning == Meaning::depth ? "depth" : "color",
                       .meaning = meaning,
                       .code = channels.code,
                       .width = part.header.width,
                       .height = part.header.height,
                       .channels = static_cast<int>(channels.places.size())};
    target.codes.resize(target.pixels() * channels.places.size());
    return target;
}

}  // namespace

std::vector<TargetImage> layers_of_deep(const StoredPart& part, const std::string& path) {
    const Channels color = channels_of(part, {"R", "G", "B", "A"}, path), depth = channels_of(part, {"Z"}, path);
    if (color.places.empty()) throw InputError(path, "deep part", "a channel R, G, B or A", "none of them");
    // A file without any sample has one empty layer.
    const std::size_t layers =
        std::max<std::size_t>(1, part.samples.empty() ? 0 : *std::ranges::max_element(part.samples));
    if (layers * part.samples.size() > most_samples)
        throw InputError(path, "deep part", fmt::format("at most {} samples (layers times pixels)", most_samples),
                         fmt::format("{} layers of {} pixels", layers, part.samples.size()));
    std::vector<TargetImage> colors, depths;
    for (std::size_t layer = 0; layer < layers; ++layer) {
        colors.push_back(empty_target(part, color, layer, Meaning::color));
        if (!depth.places.empty()) depths.push_back(empty_target(part, depth, layer, Meaning::depth));
    }
    std::size_t first = 0;
    for (std::size_t pixel = 0; pixel < part.samples.size(); first += part.samples[pixel++]) {
        const auto order = near_to_far(part, depth, first, part.samples[pixel]);
        for (std::size_t layer = 0; layer < order.size(); ++layer) {
            for (std::size_t c = 0; c < color.places.size(); ++c)
                colors[layer].codes[pixel * color.places.size() + c] = color.word(part, order[layer], c);
            if (!depth.places.empty()) depths[layer].codes[pixel] = depth.word(part, order[layer], 0);
        }
    }
    std::vector<TargetImage> all;
    for (std::size_t layer = 0; layer < layers; ++layer) {
        all.push_back(std::move(colors[layer]));
        if (!depths.empty()) all.push_back(std::move(depths[layer]));
    }
    return all;
}

}  // namespace strata::oracle
