#include "tools/oracle/picture/codes.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "pipeline/formats/half.h"
#include "rasterizer/base/enum_values.h"

namespace strata::oracle {

namespace {

// The bit width of an integer type; 0 for floats.
constexpr unsigned integer_bits(Code code) noexcept {
    switch (code) {
        case Code::unorm8: return 8;
        case Code::unorm10: return 10;
        case Code::unorm16: return 16;
        case Code::unorm24: return 24;
        case Code::integer: return 32;
        case Code::half:
        case Code::single: break;
    }
    return 0;
}

constexpr bool is_float(Code code) noexcept { return code == Code::half || code == Code::single; }
constexpr bool is_unorm(Code code) noexcept { return !is_float(code) && code != Code::integer; }

// True if all values of `integer`, rounded to `wide`, are distinct.
constexpr bool distinguishes(Code wide, Code integer) noexcept {
    return is_unorm(integer) &&
           (wide == Code::single || (wide == Code::half && (integer == Code::unorm8 || integer == Code::unorm10)));
}

// Maps floats to integers in ascending order: neighbours differ by 1, and -0 and +0 are distinct.
std::int64_t ordered(StoredCode stored) noexcept {
    if (!is_float(stored.code)) return stored.word;
    const std::uint32_t sign = stored.code == Code::half ? 0x8000u : 0x80000000u;
    const std::int64_t magnitude = stored.word & (sign - 1);
    return (stored.word & sign) != 0 ? -magnitude - 1 : magnitude;
}

}  // namespace

std::string_view name(Code code) noexcept { return enum_name(code); }

double value(Code code, std::uint32_t word) noexcept {
    if (code == Code::half) return pipeline::half_to_float(static_cast<std::uint16_t>(word));
    if (code == Code::single) return std::bit_cast<float>(word);
    if (code == Code::integer) return word;
    return word / static_cast<double>((std::uint64_t{1} << integer_bits(code)) - 1);
}

std::uint32_t nearest(Code code, double v) noexcept {
    const auto single = static_cast<float>(v);
    if (code == Code::single) return std::bit_cast<std::uint32_t>(single);
    if (code == Code::half) return pipeline::to_half(single, pipeline::HalfRounding::nearest_even);
    const auto greatest = static_cast<double>((std::uint64_t{1} << integer_bits(code)) - 1);
    const double scaled = code == Code::integer ? v : v * greatest;
    if (!(scaled > 0)) return 0;
    return static_cast<std::uint32_t>(std::min(std::floor(scaled + 0.5), greatest));
}

bool is_equal(StoredCode reference, StoredCode candidate) noexcept {
    if (reference.code == candidate.code) return reference.word == candidate.word;
    // Plain integers, as from NumPy files, are compared as codes.
    if (reference.code == Code::integer || candidate.code == Code::integer) return reference.word == candidate.word;
    const double r = value(reference.code, reference.word), c = value(candidate.code, candidate.word);
    if (distinguishes(candidate.code, reference.code)) return nearest(candidate.code, r) == candidate.word;
    if (distinguishes(reference.code, candidate.code)) return nearest(reference.code, c) == reference.word;
    if (is_unorm(reference.code) && is_unorm(candidate.code)) {
        const std::uint64_t of_reference = (std::uint64_t{1} << integer_bits(reference.code)) - 1;
        const std::uint64_t of_candidate = (std::uint64_t{1} << integer_bits(candidate.code)) - 1;
        return reference.word * of_candidate == candidate.word * of_reference;
    }
    return r == c;
}

std::uint32_t distance(StoredCode reference, StoredCode candidate) noexcept {
    constexpr std::uint32_t beyond = ~0u;
    if (is_equal(reference, candidate)) return 0;
    const double c = value(candidate.code, candidate.word);
    if (std::isnan(c) || std::isnan(value(reference.code, reference.word))) return beyond;
    const bool shares_codes = reference.code == candidate.code || candidate.code == Code::integer;
    const StoredCode mine{reference.code, shares_codes ? candidate.word : nearest(reference.code, c)};
    const std::int64_t apart = std::abs(ordered(reference) - ordered(mine));
    return static_cast<std::uint32_t>(std::clamp<std::int64_t>(apart, 1, beyond - 1));
}

}  // namespace strata::oracle
