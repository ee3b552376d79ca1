// tests/tools/lab/hard_cases/broken_peel.h - a peel with a deliberate mistake, for tests that must find it.
#pragma once
#include "peeling/programs/programs.h"
#include "peeling/registry.h"
#include "pipeline/region/region.h"

namespace strata::test {

// Front to back that rejects with < where <= is required: a fragment at the peeled depth is not rejected, so the
// nearest layer is found in every pass. Four passes.
inline void peel_by_less(peeling::Algorithm& algorithm) {
    algorithm.name = "by-less";
    algorithm.resolve_loop = nullptr;
    algorithm.run_with = nullptr;
    algorithm.run = [](pipeline::Region& region) {
        using namespace pipeline;
        const Target result = region.make_color();
        Target peeled = region.make_depth(), nearest = region.make_depth();
        region.copy(region.opaque_color(), result);
        for (int number = 0; number < 4; ++number) {
            region.begin_iteration();
            region.copy(region.opaque_depth(), nearest);
            PassState state;
            state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
            state.depth_target = nearest;
            if (number > 0) state.reads[0] = peeled;
            static_cast<void>(region.draw(state, [number](const FragmentBatch& in, const Loads& loads, Outputs& out) {
                for (std::size_t i = 0; number > 0 && i < peeling::lanes(in); ++i)
                    if (in.code[i] < loads.depth(0)[i]) out.discard(static_cast<int>(i));
            }));
            PassState show;
            show.color[0] = result;
            show.reads = {nearest, region.opaque_depth()};
            static_cast<void>(region.full_screen(show, [](const FragmentBatch& in, const Loads& loads, Outputs& out) {
                out.traced = true;
                for (std::size_t i = 0; i < peeling::lanes(in); ++i) {
                    out.side[i] = loads.depth(0)[i] != loads.depth(1)[i] ? Side::front : Side::none;
                    out.key[i] = loads.depth(0)[i];
                }
            }));
            std::swap(peeled, nearest);
        }
        region.publish(result);
    };
}

}  // namespace strata::test
