#include "pipeline/convert.h"

#include <bit>
#include <cassert>

#include "pipeline/half.h"
#include "pipeline/unorm8.h"

namespace strata::pipeline {
namespace {

using rasterizer::Lanes;

template <HalfRounding rounding>
void encode_half(const Lanes<float>& values, Lanes<std::uint32_t>& codes, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) codes[i] = to_half<rounding>(values[i]);
}

}  // namespace

void decode(ChannelType type, const Lanes<std::uint32_t>& codes, Lanes<float>& values, int count) noexcept {
    const auto n = static_cast<std::size_t>(count);
    switch (type) {
        case ChannelType::unorm8:  // the conversion to int is exact and has a vector form, that of unsigned has none
            for (std::size_t i = 0; i < n; ++i)
                values[i] = static_cast<float>(static_cast<std::int32_t>(codes[i])) / 255.0f;
            return;
        case ChannelType::half:
            for (std::size_t i = 0; i < n; ++i) values[i] = half_to_float(static_cast<std::uint16_t>(codes[i]));
            return;
        case ChannelType::single:
            for (std::size_t i = 0; i < n; ++i) values[i] = std::bit_cast<float>(codes[i]);
            return;
        case ChannelType::depth:
        case ChannelType::stencil: break;
    }
    assert(!"depth and stencil targets have no colour channels");
}

void encode(ChannelType type, HalfRounding rounding, const Lanes<float>& values, Lanes<std::uint32_t>& codes,
            int count) noexcept {
    const auto n = static_cast<std::size_t>(count);
    switch (type) {
        case ChannelType::unorm8:
            for (std::size_t i = 0; i < n; ++i) codes[i] = to_unorm8(values[i]);
            return;
        case ChannelType::half:
            if (rounding == HalfRounding::nearest_even)
                return encode_half<HalfRounding::nearest_even>(values, codes, n);
            return encode_half<HalfRounding::toward_zero>(values, codes, n);
        case ChannelType::single:
            for (std::size_t i = 0; i < n; ++i) codes[i] = std::bit_cast<std::uint32_t>(values[i]);
            return;
        case ChannelType::depth:
        case ChannelType::stencil: break;
    }
    assert(!"depth and stencil targets have no colour channels");
}

}  // namespace strata::pipeline
