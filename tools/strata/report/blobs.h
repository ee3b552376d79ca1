// tools/strata/report/blobs.h - arrays of numbers within a page: byte planes, zlib's deflate, base64.
//
// Rule     The words of an array are little endian, and all their lowest bytes come first, then all the next ones:
//          neighbours in a picture have the same high bytes, so the planes are small. A blob's number is its place in
//          the page.
// Tests    tests/tools/report_test.cpp unpacks them again
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strata::tools {

class Blobs {
  public:
    // Each answers the blob's number.
    std::size_t add(std::span<const std::uint8_t> values);
    std::size_t add(std::span<const std::uint16_t> values);
    std::size_t add(std::span<const std::uint32_t> values);
    std::size_t add_text(std::string_view text);

    // Characters of all blobs in the page.
    [[nodiscard]] std::size_t size() const noexcept;
    // <script type="text/plain" class="blob">BASE64</script>, one a blob, in their order.
    [[nodiscard]] std::string html() const;

  private:
    std::size_t add_bytes(const std::vector<std::uint8_t>& bytes);
    std::vector<std::string> encoded_;
};

// The characters that `text` would take as a blob.
[[nodiscard]] std::size_t packed_size(std::string_view text);

}  // namespace strata::tools
