// tools/strata/report/blobs.h - arrays of numbers embedded in an HTML page: split into byte planes, compressed with
// zlib's deflate, encoded as base64.
//
// Rule     The elements of an array are little endian. All their lowest bytes are stored first, then all the next ones:
//          neighbouring pixels mostly have equal high bytes, so these planes compress well. A blob's number is its
//          index in the page.
// Tests    tests/tools/strata/report/report_test.cpp unpacks the blobs again
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strata::tools {

class Blobs {
  public:
    // Each add function returns the number of the blob.
    std::size_t add(std::span<const std::uint8_t> values);
    std::size_t add(std::span<const std::uint16_t> values);
    std::size_t add(std::span<const std::uint32_t> values);
    std::size_t add_text(std::string_view text);

    // Number of characters of all blobs in the page.
    [[nodiscard]] std::size_t size() const noexcept;
    // One element <script type="text/plain" class="blob">BASE64</script> per blob, in their order.
    [[nodiscard]] std::string html() const;

  private:
    std::size_t add_bytes(const std::vector<std::uint8_t>& bytes);
    std::vector<std::string> encoded_;
};

// Number of characters that `text` would have as a blob.
[[nodiscard]] std::size_t packed_size(std::string_view text);

}  // namespace strata::tools
