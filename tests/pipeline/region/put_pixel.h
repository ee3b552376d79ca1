// tests/pipeline/region/put_pixel.h - changes one pixel of a target by a quad over the frame.
#pragma once
#include <bit>

#include "pipeline/region/region.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::testing {

// Draws a quad over the whole frame and keeps the fragment of pixel (x, y) in its region. `put(out, i)` writes the
// outputs of fragment i.
template <class Put>
void put_pixel(pipeline::Region& region, const pipeline::PassState& state, int x, int y, const Put& put) {
    using namespace pipeline;
    static_cast<void>(region.full_screen(state, [=](const FragmentBatch& in, const Loads&, Outputs& out) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
            put(out, i);
            if (in.x[i] != x || in.y[i] != y) out.discard(static_cast<int>(i));
        }
    }));
}

// The code of `depth`: its bits in D32F, else the nearest code.
inline std::uint32_t code_of(const pipeline::Region& region, float depth) {
    using namespace rasterizer;
    const DepthFormat format = region.frame().key_request().format;
    return format == DepthFormat::d32f ? std::bit_cast<std::uint32_t>(depth)
                                       : to_depth_code(depth, format, DepthRounding::nearest);
}

inline void put_depth(pipeline::Region& region, pipeline::Target target, int x, int y, float depth) {
    pipeline::PassState state;
    state.depth = {.enabled = true, .func = pipeline::CompareFunc::always, .write = true};
    state.depth_target = target;
    put_pixel(region, state, x, y, [code = code_of(region, depth)](pipeline::Outputs& out, std::size_t i) {
        out.replaces_depth = true;
        out.depth[i] = code;
    });
}

}  // namespace strata::testing
