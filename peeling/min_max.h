// peeling/min_max.h - the min-max depth of dual peeling: (-near, far) in two binary32 channels under MAX blending.
// Bavoil and Myers 2008, "Render Targets"; E9. Cleared to (-1, -1), which is near = 1 > far = -1: a pixel with nothing to peel.
#pragma once
#include "peeling/programs.h"

namespace strata::peeling {

inline constexpr pipeline::ClearValue empty_min_max{.color = {-1, -1, 0, 0}};

// A fragment's place against the peeled range, as 0 or ~0 a lane.
struct PeelLanes {
    pipeline::Lanes<std::uint32_t> is_near, is_far, is_between;
};

inline namespace strict {

// z beyond the opaque surface, before `near` or behind `far`: skipped, no lane set. near == far counts as near.
inline void classify(const pipeline::FragmentBatch& in, const pipeline::ColorLanes& min_max,
                     const pipeline::Lanes<std::uint32_t>& opaque, PeelLanes& place) noexcept {
    for (std::size_t i = 0; i < lanes(in); ++i) {
        const float z = in.shader_z[i], near = -min_max[0][i], far = min_max[1][i];
        const bool inside = z < std::bit_cast<float>(opaque[i]) && z >= near && z <= far;
        const bool is_near = inside && z == near, is_far = inside && z == far && z != near;
        place.is_near[i] = is_near ? ~0u : 0u;
        place.is_far[i] = is_far ? ~0u : 0u;
        place.is_between[i] = inside && !is_near && !is_far ? ~0u : 0u;
    }
}

// (-z, z) where the mask is set, else (-1, -1), which MAX ignores.
inline void write_min_max(const pipeline::FragmentBatch& in, const pipeline::Lanes<std::uint32_t>& mask,
                          pipeline::ColorLanes& out) noexcept {
    for (std::size_t i = 0; i < lanes(in); ++i) {
        const float z = in.shader_z[i];
        out[0][i] = mask[i] != 0 ? -z : -1.0f;
        out[1][i] = mask[i] != 0 ? z : -1.0f;
    }
}

}  // namespace strict

// The first pass of both dual algorithms: the nearest and farthest visible depth of every pixel.
inline void initialize(pipeline::Region& region, pipeline::Target min_max) {
    using namespace pipeline;
    region.clear(min_max, empty_min_max);
    PassState state;
    state.color[0] = min_max;
    state.blend[0] = blend_mode::max;
    state.reads[0] = region.opaque_depth();
    state.needs = {.shader_z = true, .code = false, .exact_code = false, .color = false, .texcoord = false, .facing = false};
    static_cast<void>(region.draw(state, [](const FragmentBatch& in, const Loads& own, Outputs& out) {
        Lanes<std::uint32_t> visible;
        for (std::size_t i = 0; i < lanes(in); ++i)
            visible[i] = in.shader_z[i] < std::bit_cast<float>(own.depth(0)[i]) ? ~0u : 0u;
        write_min_max(in, visible, out.color[0]);
    }));
}

}  // namespace strata::peeling
