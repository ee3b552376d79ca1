// peeling/check_options.h - what a frame asks for, looked at before anything is prepared: nonsense throws, what the
// device lacks is refused by name.
//
// Tests    tests/peeling/refusals_test.cpp
#pragma once
#include "peeling/render_options.h"
#include "pipeline/device/check.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::peeling {

// InputError that names the field, for what no device could mean.
void check_options(const RenderOptions& options);

// window_z and w_buffer are the chip's rules, for vertex depths in buffer units.
[[nodiscard]] pipeline::Verdict check_depth(const pipeline::DeviceProfile& profile,
                                            const rasterizer::DepthRequest& depth);

// A w buffer holds w, every other path a depth of another scale.
[[nodiscard]] bool compares_w_with_depth(const rasterizer::DepthRequest& depth) noexcept;

}  // namespace strata::peeling
