#include "tools/request/values.h"

#include "peeling/render.h"
#include "tools/request/choices.h"
#include "tools/request/parse.h"

namespace strata::tools {

std::optional<int> to_count(std::string_view text) {
    const auto value = to_int(text);
    return value && *value >= 0 ? value : std::nullopt;
}

std::optional<float> to_share(std::string_view text) {
    const auto value = to_number<float>(text);
    if (!value || *value < 0.0f || *value > 1.0f) return std::nullopt;
    return value;
}

std::optional<std::uint64_t> to_bytes(std::string_view text) {
    constexpr std::string_view suffixes = "KMG";
    const std::size_t suffix = text.empty() ? suffixes.npos : suffixes.find(text.back());
    const unsigned shift = suffix == suffixes.npos ? 0 : 10 * (static_cast<unsigned>(suffix) + 1);
    if (shift > 0) text.remove_suffix(1);
    const auto count = to_int<std::uint64_t>(text);
    // More than 2^64 - 1 bytes is an error: the shift would lose the upper bits.
    if (!count || *count > ~std::uint64_t{0} >> shift) return std::nullopt;
    return *count << shift;
}

// Parses X,Y,W,H.
std::optional<rasterizer::Rect> to_region(std::string_view text) {
    std::vector<int> numbers;
    for (const std::string& part : split(text, ',')) {
        const auto number = to_count(part);
        if (!number || *number > 16384) return std::nullopt;
        numbers.push_back(*number);
    }
    if (numbers.size() != 4 || numbers[2] < 1 || numbers[3] < 1) return std::nullopt;
    return rasterizer::Rect{numbers[0], numbers[1], numbers[0] + numbers[2], numbers[1] + numbers[3]};
}

std::optional<pipeline::Rgba> to_background(std::string_view text) {
    if (text == "none") return pipeline::Rgba{0, 0, 0, 0};
    const auto parts = split(text, ',');
    if (parts.size() != 3 && parts.size() != 4) return std::nullopt;
    pipeline::Rgba color{0, 0, 0, 1};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto value = to_share(parts[i]);
        if (!value) return std::nullopt;
        color[static_cast<pipeline::Rgba::length_type>(i)] = *value;
    }
    return color;
}

std::optional<Size> to_size(std::string_view text) {
    constexpr int max_side = 16384;
    const auto parts = split(text, 'x');
    if (parts.size() != 2) return std::nullopt;
    const auto width = to_int(parts[0]), height = to_int(parts[1]);
    if (!width || !height || *width < 1 || *height < 1 || *width > max_side || *height > max_side) return std::nullopt;
    return Size{*width, *height};
}

std::optional<Orbit> to_orbit(std::string_view text) {
    const auto angles = to_numbers<double>(text, 2);
    if (!angles) return std::nullopt;
    return Orbit{(*angles)[0], (*angles)[1]};
}

std::optional<pipeline::CompareEpsilon> to_epsilon(std::string_view text) {
    constexpr std::string_view unit = "ulp";
    if (text.ends_with(unit)) {
        const auto ulps = to_count(text.substr(0, text.size() - unit.size()));
        return ulps && *ulps <= 1 << 24 ? std::optional(pipeline::CompareEpsilon{0, *ulps}) : std::nullopt;
    }
    const auto absolute = to_number<double>(text);
    if (!absolute || *absolute < 0 || *absolute > 1) return std::nullopt;
    return pipeline::CompareEpsilon{*absolute, 0};
}

std::optional<peeling::VertexPaths> to_vertex_paths(std::string_view text, char separator) {
    const auto parts = split(text, separator);
    const auto choices = vertex_paths();
    const auto first = to_choice(choices, parts.front()), further = to_choice(choices, parts.back());
    if (parts.size() > 2 || !first || !further) return std::nullopt;
    return peeling::VertexPaths{*first, parts.size() == 2 ? std::optional(*further) : std::nullopt};
}

}  // namespace strata::tools
