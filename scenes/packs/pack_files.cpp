// scenes/packs/pack_files.cpp - digests, byte sums and the list of a pack's files (pack_files.h).
#include "scenes/packs/pack_files.h"

#include <xxhash.h>

namespace strata::scenes {

namespace {

// 2^61 - 1, a prime, so that a difference of weighted sums can be divided by a byte's difference.
constexpr std::uint64_t prime = (std::uint64_t{1} << 61) - 1;

constexpr std::uint64_t reduced(std::uint64_t x) noexcept { return x >= prime ? x - prime : x; }
constexpr std::uint64_t difference(std::uint64_t a, std::uint64_t b) noexcept { return a >= b ? a - b : a + prime - b; }

}  // namespace

std::string digest_of_bytes(std::string_view bytes) {
    XXH128_canonical_t canonical{};
    XXH128_canonicalFromHash(&canonical, XXH3_128bits(bytes.data(), bytes.size()));
    std::string text;
    for (const unsigned char byte : canonical.digest) {
        text += "0123456789abcdef"[byte >> 4];
        text += "0123456789abcdef"[byte & 15];
    }
    return text;
}

// The weight of a byte is at most 2^32 and its product 2^40, so one subtraction reduces each sum.
ByteSums sums_of(std::string_view bytes) noexcept {
    ByteSums sums;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const std::uint64_t byte = static_cast<unsigned char>(bytes[i]);
        sums.plain = reduced(sums.plain + byte);
        sums.weighted = reduced(sums.weighted + (i + 1) * byte);
    }
    return sums;
}

// One byte changed by d at index i changes the sums by d and (i + 1) d. Both are small compared with the prime, so
// their quotient is that of integers.
std::optional<ChangedByte> changed_byte(std::string_view bytes, const ByteSums& sums) noexcept {
    const ByteSums found = sums_of(bytes);
    const bool has_grown = difference(found.plain, sums.plain) < 256;
    const std::uint64_t step = has_grown ? difference(found.plain, sums.plain) : difference(sums.plain, found.plain);
    const std::uint64_t weighted =
        has_grown ? difference(found.weighted, sums.weighted) : difference(sums.weighted, found.weighted);
    if (step == 0 || step > 255 || weighted % step != 0) return std::nullopt;
    const std::uint64_t place = weighted / step;
    if (place == 0 || place > bytes.size()) return std::nullopt;
    const int is = static_cast<unsigned char>(bytes[place - 1]);
    const int was = has_grown ? is - static_cast<int>(step) : is + static_cast<int>(step);
    if (was < 0 || was > 255) return std::nullopt;
    return ChangedByte{place - 1, static_cast<std::uint8_t>(was), static_cast<std::uint8_t>(is)};
}

const std::string& PackFiles::add(const std::string& name, const NumberArray& array) {
    const std::string bytes = to_npy(array);
    const ByteSums sums = sums_of(bytes);
    list_[name] = {{"type", scenes::name(array.element)},
                   {"shape", array.shape},
                   {"digest", digest_of_bytes(array.bytes)},
                   {"sums", {std::to_string(sums.plain), std::to_string(sums.weighted)}}};
    sink_(name, bytes);
    return name;
}

const std::string& PackFiles::add_text(const std::string& name, const std::string& text) {
    const ByteSums sums = sums_of(text);
    list_[name] = {{"type", "text"},
                   {"shape", {text.size()}},
                   {"digest", digest_of_bytes(text)},
                   {"sums", {std::to_string(sums.plain), std::to_string(sums.weighted)}}};
    sink_(name, text);
    return name;
}

}  // namespace strata::scenes
