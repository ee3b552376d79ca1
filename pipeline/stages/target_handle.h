// pipeline/stages/target_handle.h - a render target as state names it.
#pragma once

namespace strata::pipeline {

// A handle into its region's storage: copy it, swap it, compare it. The same number in every region.
struct Target {
    int id = -1;
    [[nodiscard]] constexpr bool exists() const noexcept { return id >= 0; }
    friend constexpr bool operator==(Target, Target) = default;
};

}  // namespace strata::pipeline
