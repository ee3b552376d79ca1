// tests/specification/line.h - formats one case as a line of text.
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>

namespace strata::specification {

class Line {
  public:
    explicit Line(std::ostream& out) : out_{out} {}
    ~Line() { out_ << '\n'; }
    Line(const Line&) = delete;
    Line& operator=(const Line&) = delete;

    Line& word(std::string_view text) {
        if (!is_first_) out_ << ' ';
        is_first_ = false;
        out_ << text;
        return *this;
    }
    Line& integer(std::int64_t value) { return word(std::to_string(value)); }
    Line& bits(float value) { return hexadecimal(std::bit_cast<std::uint32_t>(value), 8); }
    Line& half(std::uint32_t code) { return hexadecimal(code, 4); }
    Line& answer() { return word("->"); }

  private:
    Line& hexadecimal(std::uint32_t value, int digits) {
        std::array<char, 8> text{};
        for (int i = digits - 1; i >= 0; --i, value >>= 4)
            text[static_cast<std::size_t>(i)] = "0123456789abcdef"[value & 15];
        return word({text.data(), static_cast<std::size_t>(digits)});
    }

    std::ostream& out_;
    bool is_first_ = true;
};

}  // namespace strata::specification
