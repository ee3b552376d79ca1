// peeling/frame/check_options.h - checks a frame's options before anything is prepared: invalid values throw, features
// that the device lacks give a Refusal that names them.
//
// Tests    tests/peeling/frame/refusals_test.cpp
#pragma once
#include "peeling/render_options.h"
#include "pipeline/device/check.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::peeling {

// Throws InputError, which names the field, for values that are invalid on every device.
void check_options(const RenderOptions& options);

// window_z and w_buffer follow the rules of the NV2A chip and need vertex depths in buffer units.
[[nodiscard]] std::optional<pipeline::Refusal> check_depth(const pipeline::DeviceProfile& profile,
                                                           const rasterizer::DepthRequest& depth);

// Reversed depth needs float codes (rasterizer/rules/depth_key.h); a light's shadow map would need both orders.
[[nodiscard]] std::optional<pipeline::Refusal> check_order(const RenderOptions& options, pipeline::DepthFormat format,
                                                           bool casts_shadows);

// Programs that run once a pixel: what is not known there, and algorithms that compare what each sample stores, unless
// their lists are of pixels.
[[nodiscard]] std::optional<pipeline::Refusal> check_shading(const pipeline::DeviceProfile& profile,
                                                             const Algorithm& algorithm,
                                                             const rasterizer::DepthRequest& depth,
                                                             const RenderOptions& options);

// True if w (a w buffer) or its logarithm is compared with another path's depth, which has another scale, or the
// reverse.
[[nodiscard]] bool compares_w_with_depth(const rasterizer::DepthRequest& depth) noexcept;

}  // namespace strata::peeling
