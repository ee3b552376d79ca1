// pipeline/stages/target_handle.h - the handle of a render target in pass state.
#pragma once

namespace strata::pipeline {

// An index into its region's storage; may be copied, swapped and compared. The same index in every region.
struct Target {
    int id = -1;
    [[nodiscard]] constexpr bool exists() const noexcept { return id >= 0; }
    friend constexpr bool operator==(Target, Target) = default;
};

}  // namespace strata::pipeline
