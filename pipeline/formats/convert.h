// pipeline/formats/convert.h - converts a batch of colour channels between the codes that a target stores and binary32.
// The rules are in unorm8.h and half.h; binary32 channels are copied bit for bit. `scalar` is the definition; the
// functions outside it are the same loops compiled for the selected instruction set (stages_simd.cpp). Tests:
// tests/pipeline/formats/convert_test.cpp, tests/pipeline/stages/simd_stages_test.cpp
#pragma once
#include <bit>
#include <cassert>
#include <cstdint>

#include "pipeline/formats/color_rounding.h"
#include "pipeline/formats/format.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {

// Converts lanes [0, count), and writes scratch values up to the next multiple of 16; `type` is unorm8, half or single.
void decode(ChannelType type, const rasterizer::Lanes<std::uint32_t>& codes, rasterizer::Lanes<float>& values,
            int count) noexcept;
void encode(ChannelType type, ColorRounding rounding, const rasterizer::Lanes<float>& values,
            rasterizer::Lanes<std::uint32_t>& codes, int count) noexcept;

inline namespace strict {
namespace scalar {

// The rounding is a template argument, so that the loop has no branch.
template <HalfRounding rounding>
void encode_half(const float* __restrict values, std::uint32_t* __restrict codes, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) codes[i] = to_half<rounding>(values[i]);
}

template <UnormRounding rounding>
void encode_unorm8(const float* __restrict values, std::uint32_t* __restrict codes, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) codes[i] = to_unorm8<rounding>(values[i]);
}

// The type is selected once per batch; each case is a loop that compilers vectorize.
inline void decode(ChannelType type, const std::uint32_t* __restrict codes, float* __restrict values,
                   std::size_t count) noexcept {
    switch (type) {
        case ChannelType::unorm8:
            for (std::size_t i = 0; i < count; ++i) values[i] = unorm8_value(codes[i]);
            return;
        case ChannelType::half:
            for (std::size_t i = 0; i < count; ++i) values[i] = half_to_float(static_cast<std::uint16_t>(codes[i]));
            return;
        case ChannelType::single:
            for (std::size_t i = 0; i < count; ++i) values[i] = std::bit_cast<float>(codes[i]);
            return;
        case ChannelType::unorm10:
        case ChannelType::depth:
        case ChannelType::stencil: break;
    }
    assert(!"packed formats have packed.h; depth and stencil targets have no colour channels");
}

inline void encode(ChannelType type, ColorRounding rounding, const float* __restrict values,
                   std::uint32_t* __restrict codes, std::size_t count) noexcept {
    switch (type) {
        case ChannelType::unorm8:
            if (rounding.unorm == UnormRounding::half_up)
                return encode_unorm8<UnormRounding::half_up>(values, codes, count);
            return encode_unorm8<UnormRounding::product_even>(values, codes, count);
        case ChannelType::half:
            if (rounding.half == HalfRounding::nearest_even)
                return encode_half<HalfRounding::nearest_even>(values, codes, count);
            if (rounding.half == HalfRounding::toward_zero)
                return encode_half<HalfRounding::toward_zero>(values, codes, count);
            return encode_half<HalfRounding::no_infinity>(values, codes, count);
        case ChannelType::single:
            for (std::size_t i = 0; i < count; ++i) codes[i] = std::bit_cast<std::uint32_t>(values[i]);
            return;
        case ChannelType::unorm10:
        case ChannelType::depth:
        case ChannelType::stencil: break;
    }
    assert(!"packed formats have packed.h; depth and stencil targets have no colour channels");
}

}  // namespace scalar
}  // namespace strict
}  // namespace strata::pipeline
