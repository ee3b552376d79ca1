// scenes/printable.h - escapes untrusted text for a message, which is one line of UTF-8, and for XML and HTML.
//
// Rule     A control character below U+0020 and a byte that is not part of a UTF-8 character become \xNN; U+007F to
//          U+009F, which JSON does not escape and some terminals interpret, become \u00NN. A file name and a
//          command-line argument may contain any byte except 0.
// Source   RFC 3629 4.
// Tests    tests/tools/strata/program/errors_test.cpp, tests/tools/strata/program/messages_test.cpp
#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

namespace strata::scenes {

// The length in bytes of the character at the beginning of `text`; 0 if there is no valid character.
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
    constexpr std::uint32_t least[] = {0x80, 0x800, 0x10000};  // the smallest value that needs that many bytes
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

// Text of more than `most` characters is shortened to `most`, with "..." at the end.
[[nodiscard]] inline std::string shortened(std::string_view text, std::size_t most) {
    std::size_t end = 0, begin_of_dots = 0, count = 0;
    for (; end < text.size(); ++count) {
        if (count == most) return std::string(text.substr(0, begin_of_dots)) + "...";
        end += std::max<std::size_t>(1, utf8_length(text.substr(end)));
        if (count + 4 == most) begin_of_dots = end;
    }
    return std::string(text);
}

// Escapes text for an element or a quoted attribute of XML and HTML: characters that either does not allow are escaped
// as in `printable`, except line ends.
[[nodiscard]] inline std::string markup_text(std::string_view text) {
    std::string safe;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        const char c = i < text.size() ? text[i] : '\0';
        const char* const name = c == '&'    ? "&amp;"
                                 : c == '<'  ? "&lt;"
                                 : c == '>'  ? "&gt;"
                                 : c == '"'  ? "&quot;"
                                 : c == '\n' ? "\n"
                                             : nullptr;
        if (name == nullptr && i < text.size()) continue;
        safe += printable(text.substr(begin, i - begin));
        if (name != nullptr) safe += name;
        begin = i + 1;
    }
    return safe;
}

}  // namespace strata::scenes
