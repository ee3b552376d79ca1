// pipeline/stages/stage_lanes.h - builds the argument structs of the stage kernels from a batch's lanes and a target's
// planes.
#pragma once
#include <cstdint>

#include "pipeline/stages/target_storage.h"

namespace strata::pipeline {

// The single channel of a depth or stencil plane.
[[nodiscard]] inline Texels codes_in(Plane plane) noexcept { return {plane, 1, 32}; }

[[nodiscard]] inline PixelLanes lanes_of(const FragmentBatch& batch) noexcept {
    return {batch.pixel.data(), static_cast<std::size_t>(batch.count)};
}

[[nodiscard]] inline std::uint64_t count_lanes(const Lanes<std::uint32_t>& mask, int count) noexcept {
    return count_lanes(mask.data(), static_cast<std::size_t>(count));
}

[[nodiscard]] inline std::uint64_t pixel_bytes(const TargetStorage& target) {
    return static_cast<std::uint64_t>(info(target.format()).bytes_per_pixel);
}

inline constexpr auto every_lane = [] {
    Lanes<std::uint32_t> lanes{};
    lanes.fill(~0u);
    return lanes;
}();

}  // namespace strata::pipeline
