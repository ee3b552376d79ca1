// tools/strata/options/printable.h - text from outside as it may stand in a sentence: one line of UTF-8.
//
// Rule     A control character below U+0020 and a byte that is no part of a UTF-8 character become \xNN; U+007F to U+009F, which JSON does
//          not escape and some terminals obey, become \u00NN. A file's name and a word of the
//          command line may hold any byte but 0. Source   RFC 3629 4. Tests    tests/tools/errors_test.cpp
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace strata::tools {

// The number of bytes of the character at the beginning of `text`; 0 if no character is there.
[[nodiscard]] constexpr std::size_t utf8_length(std::string_view text) noexcept {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<std::uint8_t>(text[i]) : 0u; };
    const std::uint32_t first = byte(0);
    if (first < 0x80) return text.empty() ? 0 : 1;
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    std::uint32_t code = first & (0x7fu >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0u) != 0x80u) return 0;
        code = code << 6 | (byte(i) & 0x3fu);
    }
    constexpr std::uint32_t least[] = {0x80, 0x800, 0x10000};  // below it fewer bytes would do
    const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
    const bool is_character = first >= 0xc2 && first <= 0xf4 && code >= least[length - 2] && code <= 0x10ffff;
    return is_character && !is_surrogate ? length : 0;
}

[[nodiscard]] inline std::string printable(std::string_view text) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string shown;
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        const auto first = static_cast<std::uint8_t>(text.front());
        const bool is_delete = first == 0x7f,
                   is_c1 = length == 2 && first == 0xc2 && static_cast<std::uint8_t>(text[1]) < 0xa0;
        const auto last = static_cast<std::uint8_t>(text[is_c1 ? 1 : 0]);
        if (is_delete || is_c1)
            shown += {'\\', 'u', '0', '0', digits[last >> 4], digits[last & 15u]};
        else if (length == 0 || first < 0x20)
            shown += {'\\', 'x', digits[first >> 4], digits[first & 15u]};
        else
            shown += text.substr(0, length);
        text.remove_prefix(length == 0 ? 1 : length);
    }
    return shown;
}

}  // namespace strata::tools
