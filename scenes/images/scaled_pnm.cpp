// scenes/images/scaled_pnm.cpp - reads the header and the samples of a PNM file and scales them to its maxval
// (scaled_pnm.h).
#include "scenes/images/scaled_pnm.h"

#include <charconv>

namespace strata::scenes::images {

namespace {

bool is_blank(char c) noexcept { return c == ' ' || (c >= '\t' && c <= '\r'); }

// The next number after whitespace and comments; empty if there is none.
std::optional<std::uint32_t> take_number(std::string_view& text) {
    while (!text.empty() && (is_blank(text[0]) || text[0] == '#'))
        text.remove_prefix(text[0] == '#' ? std::min(text.find('\n'), text.size()) : 1);
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return number;
}

std::optional<std::uint32_t> take_word(std::string_view& text, std::size_t bytes) {
    if (text.size() < bytes) return std::nullopt;
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < bytes; ++i) word = word << 8 | static_cast<unsigned char>(text[i]);
    text.remove_prefix(bytes);
    return word;
}

}  // namespace

std::optional<FileCodes> scaled_pnm(std::string_view bytes, const FileLocation& location, int width, int height,
                                    int channels) {
    const bool is_text = bytes.starts_with("P2") || bytes.starts_with("P3");
    if (!is_text && !bytes.starts_with("P5") && !bytes.starts_with("P6")) return std::nullopt;
    std::string_view rest = bytes.substr(2);
    static_cast<void>(take_number(rest));
    static_cast<void>(take_number(rest));
    const std::uint32_t greatest = take_number(rest).value_or(0);
    if (greatest == 0 || greatest > 65535)
        location.fail("IMAGE_DATA_INVALID", "a maximum value from 1 to 65535", std::to_string(greatest));
    if (greatest == 255) return std::nullopt;
    if (!is_text && !rest.empty()) rest.remove_prefix(1);
    FileCodes stored{.width = width, .height = height, .channels = channels, .bits = greatest < 256 ? 8 : 16};
    const std::size_t count =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(channels);
    const std::uint32_t most = greatest < 256 ? 255 : 65535;
    stored.codes.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto sample = is_text ? take_number(rest) : take_word(rest, greatest < 256 ? 1 : 2);
        if (!sample) return std::nullopt;
        stored.codes.push_back((std::min(*sample, greatest) * most + greatest / 2) / greatest);
    }
    return stored;
}

}  // namespace strata::scenes::images
