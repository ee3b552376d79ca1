// pipeline/convert.h - a batch of colour channels between the codes that a target stores and binary32.
// The rules stand in unorm8.h and half.h; binary32 channels pass with every bit kept.
// Tests: tests/pipeline/convert_test.cpp
#pragma once
#include <cstdint>

#include "pipeline/format.h"
#include "pipeline/profile.h"
#include "rasterizer/fragment_batch.h"

namespace strata::pipeline {

// Lanes [0, count); `type` is unorm8, half or single.
void decode(ChannelType type, const rasterizer::Lanes<std::uint32_t>& codes, rasterizer::Lanes<float>& values,
            int count) noexcept;
void encode(ChannelType type, HalfRounding rounding, const rasterizer::Lanes<float>& values,
            rasterizer::Lanes<std::uint32_t>& codes, int count) noexcept;

}  // namespace strata::pipeline
