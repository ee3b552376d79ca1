// tests/fuzz/byte_source.h - makes choices from one or two bytes each. After the end of the bytes every choice is the
// first one.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace strata::fuzz {

class ByteSource {
  public:
    explicit ByteSource(std::span<const std::uint8_t> bytes) : bytes_{bytes} {}

    [[nodiscard]] int byte() { return next_ < bytes_.size() ? bytes_[next_++] : 0; }
    [[nodiscard]] int below(int n) { return (n <= 256 ? byte() : two_bytes()) % n; }
    [[nodiscard]] bool one_in(int n) { return below(n) == n - 1; }
    [[nodiscard]] float fraction() { return static_cast<float>(two_bytes()) * 0x1p-16f; }  // [0, 1)

    template <class T, std::size_t n>
    [[nodiscard]] T pick(const std::array<T, n>& choices) {
        return choices[static_cast<std::size_t>(below(static_cast<int>(n)))];
    }

  private:
    [[nodiscard]] int two_bytes() {
        const int low = byte();
        return low + 256 * byte();
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t next_ = 0;
};

}  // namespace strata::fuzz
